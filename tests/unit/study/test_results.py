"""Results: every table of a study as a data frame."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

import rocking
from rocking.assessment.decide import Decision, Verdict
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import (
    RECORD_TABLES,
    SUMMARY_TABLES,
    StructureRow,
    TimingRow,
    VerdictRow,
)
from rocking.errors import RockingError
from rocking.study.kept import Kept, keep, kept_in
from rocking.study.outputs import STEPS, former_files, outcome_of, outputs_of, remove, store_of
from rocking.study.settings import Settings
from rocking.tables import read_rows, write_rows
from rocking.warnings import RockingWarning, every_kind
from tests.refusals import refused
from tests.unit.assessment.made_rows import case, station, verdicts


def _timing(record: str) -> TimingRow:
    return TimingRow(record=record, stage="read", duration_s=0.5)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for row_class in SUMMARY_TABLES:
        rows = [_timing("b"), _timing("a")] if row_class is TimingRow else []
        write_rows(row_class, rows, tmp_path / "summary" / row_class.table.file_name)
    return tmp_path


def test_a_table_of_the_summary_is_an_attribute(folder: Path) -> None:
    results = rocking.open_results(folder)
    assert tuple(results.structures) == StructureRow.table.column_names
    assert {"comparison", "variations", "trade"} <= set(dir(results))
    assert repr(results).startswith(f"Results('{folder}'): record, pulses, ")


@pytest.mark.parametrize(
    "reserve", [None, Reserve(low=1.2, median=math.nan, high=math.nan, limit=3.0)], ids=["none", "sought"]
)
def test_an_outcome_keeps_the_decision_with_the_values_of_its_warnings(tmp_path: Path, reserve) -> None:
    """Of every kind in the catalogue; a row read back from its print raised ValueError for each that has values."""
    warnings = tuple(
        RockingWarning.of(
            kind, "pier", **{name: 0.1 * place for place, name in enumerate(kind.value_names, start=1)}
        )
        for kind in every_kind().values()
    )
    assert sum(bool(warning.values) for warning in warnings) > 20
    decision = Decision(
        Verdict.UNCERTAIN, 1 / 3, (0.0, 2 / 3), "32 of 64 members overturn", warnings, warnings
    )
    (of_station,) = verdicts([station(case("EW", 0.3, falls=32))])
    row = replace(of_station, decision=decision, reserve=reserve)
    path = outcome_of(tmp_path, "a")
    keep(path, Kept({row_class: [] for row_class in RECORD_TABLES} | {VerdictRow: [row]}))
    (kept,) = kept_in(path, [VerdictRow]).rows[VerdictRow]
    assert kept.decision == decision
    assert repr(kept.reserve) == repr(reserve)
    assert repr(kept) == repr(row)


def test_what_a_row_carries_beside_its_columns_is_not_read_from_its_print(tmp_path: Path) -> None:
    write_rows(VerdictRow, [], tmp_path / "verdicts.csv")
    with pytest.raises(TypeError):
        list(read_rows(VerdictRow, tmp_path / "verdicts.csv"))


def test_what_is_not_there_is_said(folder: Path) -> None:
    results = rocking.open_results(folder)
    with pytest.raises(AttributeError, match="no table 'sums'"):
        _ = results.sums
    with refused(RockingError, "file", "trade.csv"):
        _ = results.trade
    with refused(RockingError, "table", "sums"):
        results.table("sums")
    with refused(RockingError, "folder"):
        rocking.open_results(folder / "nowhere")
    (folder / "study").mkdir()
    (folder / "study" / "results").symlink_to(folder)
    with pytest.raises(RockingError, match=f"tables of a record; name {folder / 'study' / 'results'}."):
        rocking.open_results(folder / "study")


def test_the_tables_of_records_assessed_one_by_one_are_gathered(tmp_path: Path) -> None:
    for record in ("b", "a"):
        write_rows(TimingRow, [_timing(record)], tmp_path / record / "timings.csv")
    assert rocking.open_results(tmp_path).timings["record"].tolist() == ["a", "b"]


# fmt: off
OURS = (
    "summary/structures.pdf", "summary/code_checks.csv", "gone/report.pdf", "gone/histories.csv", "kept/histories.csv",
    ".kept/outcomes/gone.json", ".kept/rows/checks.json", "summary/logs/checks.log", "summary/logs/report/gone.log",
)
"""Files of products that the study does not make, and of records that it does not hold."""
OF_A_USER = (
    "notes.txt", "summary/notes.pdf", "gone/notes.csv", "gone/deep/report.pdf", "summary/deep/record.csv",
    "mine.pdf", "fragility/my.csv", ".kept/mine.json", "a b/report.pdf", "summary/logs/run.log",
    "summary/logs/fragility.log", "summary/logs/record/kept.log",
    "fragility/fragility.xml",
)
# fmt: on


def test_what_no_product_owns_any_more_goes_and_no_file_of_a_user_does(tmp_path: Path) -> None:
    settings = Settings(results=str(tmp_path / "results"), figures="svg")
    owned = [path for rule in ("trade", "summary") for path in outputs_of(rule, settings).values()]
    owned += [path for step in STEPS for path in outputs_of(step, settings, "kept").values()]
    owned += [store_of(tmp_path / "results", "integrate", "other")]
    ours, of_a_user = ([tmp_path / "results" / name for name in names] for names in (OURS, OF_A_USER))
    for path in (*owned, *ours, *of_a_user):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    former = former_files(settings, ["trade"], ["kept", "other"])
    assert former == sorted(ours)
    remove(tmp_path / "results", former)
    left = {path for path in (tmp_path / "results").rglob("*") if path.is_file()}
    assert left == {*owned, *of_a_user}
    assert (tmp_path / "results" / "gone" / "notes.csv").is_file()
