"""rocking run as a person meets it: what it prints, how it ends, and where the rest is."""

import fcntl
import os
import pty
import struct
import subprocess
import sys
import termios
from pathlib import Path

import pytest


@pytest.mark.slow
def test_a_record_that_failed_has_its_line_and_ends_in_status_1_after_the_table(finished, tmp_path) -> None:
    """To stderr goes a line for each record that was computed; the rest stands in the log."""
    study = finished.copy_to(tmp_path / "study")
    study.add("broken", b"no record")
    done = study.rocking("run", str(study.folder), status=1)
    log = study.results / "summary" / "logs" / "run.log"
    assert str(log) in done.stdout and "Finished jobid" in log.read_text()
    lines = done.stderr.splitlines()
    assert [line.partition(":")[0] for line in lines] == ["broken"], "the others were there already"
    assert "failed: " in lines[0] and "no reader recognises" in lines[0]
    for text in ("3 records, ", "1 record failed, wholly or in part: broken", f"Open    {log.parents[1]}"):
        assert text in done.stdout
    assert "\r" not in done.stdout and "jobid" not in done.stdout
    assert len(done.stdout.splitlines()) < 24


@pytest.mark.slow
def test_a_terminal_shows_the_line_of_a_record_before_an_outcome_whose_lines_fit(
    finished, tmp_path: Path
) -> None:
    """And nothing is imported from the folder of the study."""
    study = finished.copy_to(tmp_path / "study")
    for module in ("yaml", "psutil", "numpy"):
        (study.folder / f"{module}.py").write_text("open('imported', 'w')\nraise SystemExit(7)\n")
    name = "broken_record_with_a_name_that_is_long_enough_to_fill_the_line"
    study.add(name, b"no record")
    ours, theirs = pty.openpty()
    command = [str(Path(sys.executable).with_name("rocking")), "run", "."]
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 60, 0, 0))
    process = subprocess.Popen(command, stdout=theirs, stderr=theirs, **study.surroundings)
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 65536):
            shown += piece
    except OSError:  # how Linux says that the other end was closed
        pass
    assert process.wait() == 1
    assert not (study.folder / "imported").exists()
    text = shown.decode()
    _, line, outcome = text.partition(f"{name}: failed: ")
    assert line and "1 record failed" in outcome, "as the record ends, before the outcome"
    cut = [line for line in outcome.splitlines() if line.endswith("…")]
    assert cut and all(len(line) <= 60 for line in cut)


@pytest.mark.slow
def test_a_long_target_shows_how_far_it_is(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    done = study.rocking("run", str(study.folder), "trade")
    assert "trade: 1 of 3: good_" in done.stderr and "trade: 3 of 3: good_" in done.stderr
