"""What a terminal shows of a command that takes a while."""

import io

import numpy as np
import pytest

import rocking
from rocking.progress import bar


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_what_is_gone_through_is_as_it_was_with_a_bar_or_without(monkeypatch: pytest.MonkeyPatch) -> None:
    for stream in (Terminal(), io.StringIO()):
        monkeypatch.setattr("sys.__stderr__", stream)
        assert list(bar([3, 1, 2], "file")) == [3, 1, 2]
        assert ("of 3 files" in stream.getvalue()) == stream.isatty()
    assert "\n" not in stream.getvalue(), "it leaves no line behind"


def test_a_fragility_and_a_strengthening_show_how_far_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = Terminal()
    monkeypatch.setattr("sys.__stderr__", stream)
    times = 0.01 * np.arange(400)
    records = [
        rocking.Accelerogram(
            rocking.Pulse(amplitude=3.0, circular_frequency=omega, start_time=0.5).acceleration(times),
            0.01,
            station=f"{omega}",
        )
        for omega in np.linspace(4.0, 8.0, 6)
    ]
    block = rocking.Block(2.0, 0.2)
    rocking.fragility(records, block, levels=[0.5, 1.0], ensemble=None)
    assert "of 6 records" in stream.getvalue()
    rocking.strengthen(records, block, "breadth", between=(1.0, 3.0))
    assert "of 1 rounds" in stream.getvalue()
