"""What jobs and scheduler send, and what a person is told of it."""

import json
import os
from pathlib import Path

import pytest

from rocking.study.progress import PIPE, Progress, line_writer


def test_elsewhere_than_on_a_terminal_there_are_plain_lines(capsys: pytest.CaptureFixture[str]) -> None:
    progress = Progress({"assess_a": 2}, width=6)
    for told in (
        {"planned": {"assess_a": 1, "summarise": 1}},
        {"begun": "compile"},
        {"job": "assess_a", "line": "one: rests: pier"},
        {"job": "trade", "line": "1 of 12: one, pier: 14 runs"},
        {"finished": "trade"},
        {"error": "it broke"},
    ):
        progress(told)
    progress.close()
    compiling, *lines = capsys.readouterr().out.splitlines()
    assert "compiled" in compiling and lines == ["one     rests: pier", "trade: 1 of 12: one, pier: 14 runs"]
    assert progress.errors == ["it broke"]


def test_on_a_terminal_it_says_how_far_it_has_come(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    progress = Progress({"assess_a": 40}, width=3)
    progress({"planned": {"assess_a": 1}})
    progress._began -= 600  # ten minutes for the first record
    progress({"job": "assess_a", "line": "one: stands: pier"})
    assert capsys.readouterr().out.endswith("1 of 40 records, about 390 min left")


def test_a_line_stands_in_the_log_and_comes_through_the_pipe(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    os.mkfifo(tmp_path / "pipe")
    monkeypatch.setenv(PIPE, str(tmp_path / "pipe"))
    (tmp_path / "job.log").write_text("of an older run\n")
    with (tmp_path / "pipe").open("r+b", buffering=0) as pipe:
        line_writer(tmp_path / "job.log")("first")
        assert json.loads(pipe.read(1000)) == {"job": "job", "line": "first"}
    line_writer(tmp_path / "job.log")("first")  # nobody reads any more, and nobody waits for it
    assert (tmp_path / "job.log").read_text() == "first\n"
