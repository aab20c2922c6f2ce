"""What a person is told of a run and of records: each case in its group, worst component and ensemble included."""

import io
import math
from pathlib import Path

import pytest

from rocking.assessment.fate import fates
from rocking.assessment.rows.of_record import ComparisonRow, EnsembleRow, FailureRow
from rocking.assessment.verdict import Verdict
from rocking.structures import Outcome
from rocking.study import terminal
from rocking.study.terminal import Progress, closing_lines, line_writer, paths_to_read, record_line


def _case(record: str, structure: str, ratio: float) -> ComparisonRow:
    known = {
        "record": record,
        "structure": structure,
        "integrated_rotation_ratio": ratio,
        "answer_outcome": Outcome.at(ratio),
    }
    return ComparisonRow(**dict.fromkeys(ComparisonRow.table.column_names) | known)


def _ensemble(
    record: str, structure: str, verdict: Verdict, overturning: int, component: str = "EW"
) -> EnsembleRow:
    known = {
        "record": record,
        "component": component,
        "structure": structure,
        "verdict": verdict,
        "overturning_members": overturning,
        "overturning_share": overturning / 64,
        "members": 64,
        "rotation_ratio_high": 0.5,
    }
    return EnsembleRow(**dict.fromkeys(EnsembleRow.table.column_names) | known)


def _failure(record: str, structure: str, message: str) -> FailureRow:
    return FailureRow(record=record, component="", structure=structure, stage="", message=message)


def test_the_worst_component_counts() -> None:
    cases = [
        *(_case("a", "pier", 0.5), _case("a", "pier", math.inf)),
        *(_case("a", "wall", 0.25), _case("a", "wall", 0.0005), _case("a", "arch", 0.0)),
    ]
    assert record_line(fates(cases), []) == "overturns: pier; stands: wall 0.25, arch"


def test_undecided_is_ordered_by_share_and_counted_where_there_is_much_of_it() -> None:
    cases = [_case("a", name, 0.25) for name in ("pier", "wall", "arch")]
    ensembles = [
        _ensemble("a", "pier", Verdict.UNDECIDED, 5),
        _ensemble("a", "wall", Verdict.UNDECIDED, 60),
        _ensemble("a", "arch", Verdict.STANDS, 0),
    ]
    assert record_line(fates(cases, ensembles), []) == (
        "undecided: wall (60 of 64), pier (5 of 64); stands: arch 0.25"
    )
    many = [_ensemble("a", f"pier {number}", Verdict.UNDECIDED, 5) for number in range(7)]
    cases += [_case("a", each.structure, 0.25) for each in many]
    assert (
        record_line(fates(cases, ensembles + many), []) == "undecided: 9, in verdicts.csv; stands: arch 0.25"
    )


def test_a_failure_stands_first_without_repeating_the_record() -> None:
    failures = [_failure("a", "wall", "it cannot stand."), _failure("a", "", "a: it cannot be read.")]
    line = record_line(fates([_case("a", "pier", 0.5)]), failures)
    assert line == "failed: wall: it cannot stand. it cannot be read.; stands: pier 0.5"


def test_the_table_at_the_end_counts_what_overturns_and_what_is_undecided_apart() -> None:
    cases = [
        *(_case("a", "pier", math.inf), _case("b", "pier", math.inf)),
        *(_case("a", "wall", math.inf), _case("b", "wall", 0.1), _case("b", "arch", 0.1)),
    ]
    doubts = [_ensemble("a", "pier", Verdict.UNDECIDED, 60)]
    lines = list(closing_lines(fates(cases, doubts), [_failure("c", "", "not read.")]))
    assert [line.split() for line in lines[2:4]] == [["pier", "1", "1", "b,", "a?"], ["wall", "1", "0", "a"]]
    assert lines[4:] == ["1 record failed, wholly or in part: c"]


def test_nothing_overturns() -> None:
    assert list(closing_lines(fates([_case("a", "pier", 0.1)]), [])) == [
        "Every structure stands under 1 record."
    ]
    failed = FailureRow(
        record="a", component="", structure="pier", stage="responses", message="it cannot stand."
    )
    assert list(closing_lines(fates([], failures=[failed]), []))[2].endswith("a–")


def test_the_paths_are_those_that_exist(tmp_path: Path) -> None:
    summary = tmp_path / "summary"
    summary.mkdir()
    assert list(paths_to_read(tmp_path, [])) == [f"Summary: {summary}"]
    for name in ("summary.pdf", "explore.html"):
        (summary / name).touch()
    assert list(paths_to_read(tmp_path, [])) == [
        f"Page to explore: {summary / 'explore.html'}",
        f"Summary: {summary / 'summary.pdf'}",
    ]


def test_what_is_sent_stands_in_the_log_and_on_the_terminal(tmp_path: Path) -> None:
    (tmp_path / "assess_a.log").write_text("of an older run\n")
    stream = io.StringIO()
    with Progress({"assess_a": 2}, stream).followed():
        line_writer(tmp_path / "assess_a.log")("one: rests: pier")
        line_writer(tmp_path / "trade.log")("1 of 12: one, pier: 14 runs")
    line_writer(tmp_path / "trade.log")("first")  # nobody reads any more, and nobody waits for it
    assert (tmp_path / "assess_a.log").read_text() == "one: rests: pier\n"
    assert stream.getvalue().splitlines() == ["one: rests: pier", "trade: 1 of 12: one, pier: 14 runs"]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_on_a_terminal_it_says_how_far_it_has_come(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(terminal, "fitting", lambda line, stream: line)
    progress = Progress({"assess_a": 40}, stream := Terminal())
    progress.tell_plan(["assess_a", "summarise"])
    assert stream.getvalue().endswith("0 of 40 records")
    progress._began -= 600  # ten minutes for the first record
    progress.tell_line("assess_a", "one: stands: pier")
    assert stream.getvalue().endswith("1 of 40 records, about 390 min left")
