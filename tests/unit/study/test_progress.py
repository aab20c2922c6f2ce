"""What is read from logs while they grow, and what is said of it."""

import os
from pathlib import Path

from rocking.study.progress import NewLines, Progress, finished_rule, line_writer, planned_jobs

SCHEDULER = """Building DAG of jobs...
Job stats:
job                      count
---------------------  -------
compile                      1
assess_00000_of_00002        1
all                          1
total                        3

Select jobs to execute...
[Sat Nov 21 18:22:58 2026]
Finished jobid: 2 (Rule: assess_00000_of_00002)
"""


def test_lines_are_told_once_and_only_when_they_are_whole(tmp_path: Path) -> None:
    log = tmp_path / "assess_a.log"
    log.write_text("of an older run\n")
    os.utime(log, (1, 1))
    lines = NewLines(tmp_path, "*.log")
    assert list(lines) == []
    with log.open("w") as stream:
        print("first", file=stream)
        stream.write("half of the sec")
        stream.flush()
        assert list(lines) == [("assess_a", "first")]
        print("ond", file=stream, flush=True)
        assert list(lines) == [("assess_a", "half of the second")]
    assert list(lines) == []


def test_the_plan_of_snakemake_is_read_from_its_log() -> None:
    assert planned_jobs(SCHEDULER) == {"compile": 1, "assess_00000_of_00002": 1, "all": 1}
    assert planned_jobs(SCHEDULER.partition("total")[0]) == {}, "the table is not whole yet"
    assert [rule for line in SCHEDULER.splitlines() if (rule := finished_rule(line))] == [
        "assess_00000_of_00002"
    ]


def test_elsewhere_than_on_a_terminal_there_are_plain_lines(capsys) -> None:
    progress = Progress({"assess_a": 2, "report_a": 2}, width=6)
    progress.plan({"assess_a": 1, "report_a": 1, "trade": 1})
    progress.told("assess_a", "one: rests: pier")
    progress.told("report_a", "one: report written")
    progress.told("trade", "1 of 12: one, pier: 14 runs")
    progress.told("trade", "something else")
    progress.finished("trade")
    progress.close()
    assert capsys.readouterr().out == "one     rests: pier\ntrade: 1 of 12: one, pier: 14 runs\n"


def test_a_line_stands_in_the_log_when_it_is_written(tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.write_text("of an older run\n")
    add = line_writer(log)
    for said in ("1 of 2: first", "2 of 2: second"):
        add(said)
        assert log.read_text().splitlines()[-1] == said
    assert len(log.read_text().splitlines()) == 2
