"""What a terminal shows of a command that takes a while."""

import io

import pytest

from rocking.study.progress import bar


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_what_is_gone_through_is_as_it_was_with_a_bar_or_without(monkeypatch: pytest.MonkeyPatch) -> None:
    for stream in (Terminal(), io.StringIO()):
        monkeypatch.setattr("sys.__stderr__", stream)
        assert list(bar([3, 1, 2], "file")) == [3, 1, 2]
        assert ("of 3 files" in stream.getvalue()) == stream.isatty()
    assert "\n" not in stream.getvalue(), "it leaves no line behind"
