"""What jobs report of their progress, in their log and on the terminal."""

import io
import re
from pathlib import Path

import pytest

from rocking.study.progress import Progress, bar, line_writer, send_error


def test_what_is_sent_stands_in_the_log_and_on_the_terminal(tmp_path: Path) -> None:
    (tmp_path / "assess_a.log").write_text("of an older run\n")
    stream = io.StringIO()
    with Progress(2, 1, stream).followed():
        line_writer(tmp_path / "assess_a.log", "record")("one: rests: pier")
        line_writer(tmp_path / "trade.log", "trade")("1 of 12: one, pier: 14 runs")
    line_writer(tmp_path / "trade.log", "trade")("first")  # nobody reads any more, and nobody waits for it
    assert (tmp_path / "assess_a.log").read_text() == "one: rests: pier\n"
    assert stream.getvalue().splitlines() == ["one: rests: pier", "trade: 1 of 12: one, pier: 14 runs"]


def test_the_log_holds_the_error_that_ends_a_job(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    line_writer(log := tmp_path / "fragility.log", "fragility")("1 of 2: pier")
    try:
        raise ZeroDivisionError("by nothing")
    except ZeroDivisionError as error:
        send_error(type(error), error, error.__traceback__)
    told, *trace = log.read_text().splitlines()
    assert told == "1 of 2: pier"
    assert trace[-1] == "ZeroDivisionError: by nothing"
    assert "its log says where" in capsys.readouterr().err


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_on_a_terminal_a_bar_says_how_far_it_has_come(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rocking.study.progress.columns_of", lambda stream: 60)
    progress = Progress(40, 2, stream := Terminal())
    progress.count_jobs({"batch": 2, "summary": 1})
    assert re.search(r"\r\x1b\[K0 of 40 records .* \? left$", stream.getvalue())
    progress._began -= 600  # ten minutes for the first record
    progress.show_line("batch", "one: stands: pier")
    *_, line, shown = stream.getvalue().split("\n")
    assert line.endswith("one: stands: pier")
    assert re.search(r"\r\x1b\[K1 of 40 records .* 6:30:0\d left$", shown)
    assert len(shown.removeprefix("\r\x1b[K")) < 60


def test_a_job_that_counts_itself_has_a_bar_and_plain_lines_elsewhere(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As a fragility does, of which there is one job; without a terminal no character moves the line."""
    monkeypatch.setattr("rocking.study.progress.columns_of", lambda stream: 60 if stream.isatty() else 0)
    told = []
    for stream in (Terminal(), io.StringIO()):
        progress = Progress(40, 2, stream)
        progress.count_jobs({"fragility": 1})
        progress.show_line("fragility", "3 of 12: pier", 3, 12)
        told.append(stream.getvalue())
    assert "3 of 12 parts" in told[0]
    assert told[1] == "fragility: 3 of 12: pier\n"


def test_the_line_of_the_compilation_moves_and_stands_twice_where_no_line_can(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("rocking.study.progress.columns_of", lambda stream: 60 if stream.isatty() else 0)
    shown = []
    for stream in (Terminal(), io.StringIO()):
        progress = Progress(4, 0, stream)
        for line, is_last in (("3 s", False), ("4 s", False), ("5 s", False), ("Compiled in 6 s.", True)):
            progress.show_line("compile", line, int(is_last), 1)
        shown.append(stream.getvalue())
    assert shown[0].split("\n")[0].split("\r\x1b[K") == ["", "3 s", "4 s", "5 s", "Compiled in 6 s."]
    assert shown[0].count("\n") == 1
    assert shown[1] == "3 s\nCompiled in 6 s.\n"


def test_what_is_gone_through_is_as_it_was_with_a_bar_or_without(monkeypatch: pytest.MonkeyPatch) -> None:
    for stream in (Terminal(), io.StringIO()):
        monkeypatch.setattr("sys.__stderr__", stream)
        assert list(bar([3, 1, 2], "file")) == [3, 1, 2]
        assert ("of 3 files" in stream.getvalue()) == stream.isatty()
    assert "\n" not in stream.getvalue(), "it leaves no line behind"
