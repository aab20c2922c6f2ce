"""A fault of the package in one structure, wherever it strikes: it is named, and costs nothing else anything."""

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from unittest.mock import Mock

import pytest

from rocking.assessment.rows import (
    CapacityRow,
    ComparisonRow,
    FailureRow,
    StructureRow,
    VerdictRow,
    rows_of_record,
)
from rocking.structures import Block
from rocking.study.documents import made_or_failed
from rocking.study.outputs import outputs_of
from rocking.study.summary import summarise
from rocking.study.summary_tables import write_summary
from rocking.tables import csv_lines, read_rows
from tests.unit.study.made_jobs import keep_nothing, outcomes_in, worked
from tests.unit.study.test_job import _record, _study

FUNCTIONS = {
    "rocking.assessment.assessor": ("compute_prediction", "crack_named", "cracked"),
    "rocking.assessment.one_case": ("check_model", "ensemble_over_cracks", "other_cracks"),
    StructureRow.__module__: ("crushing",),
    rows_of_record.__module__: ("mechanism_rows",),
}
METHODS = ("mechanism", "candidates", "contact_forces", "capacity_curve")
PLACES = [
    *((module, name) for module, names in FUNCTIONS.items() for name in names),
    *(("Block", name) for name in METHODS),
]
PIER = Block.of_size(0.7, 2.0)
BLOCK = Block.of_size(0.5, 3.0)


def _is_of_pier(argument: object) -> bool:
    if isinstance(argument, Block):
        return argument.breadth == PIER.breadth
    if hasattr(argument, "critical_rotation"):
        return bool(argument.critical_rotation == PIER.mechanism().critical_rotation)
    inner = getattr(argument, "structure", "")
    return inner == "pier" or (isinstance(inner, Block) and _is_of_pier(inner))


@pytest.mark.parametrize(("module", "name"), PLACES)
def test_a_fault_in_one_structure_is_named_and_costs_no_other(
    module: str, name: str, tmp_path: Path, monkeypatch
) -> None:
    """Predict, integrate, variations, reserve, rows and tables of the summary: the rows of the others are the same."""
    record = _record(tmp_path)
    alone = worked([record], _study(block=BLOCK), tmp_path / "alone")
    (expected,) = outcomes_in(alone.results, [record])
    assert PIER.mechanism()

    owner = Block if module == "Block" else import_module(module)
    kept = getattr(owner, name)

    def fails(*arguments, **values):
        if any(map(_is_of_pier, arguments[:2])):
            raise ZeroDivisionError("division by zero")
        return kept(*arguments, **values)

    monkeypatch.setattr(owner, name, fails)
    both = worked([record], _study(block=BLOCK, pier=PIER), tmp_path / "both")
    outcomes = list(outcomes_in(both.results, [record]))
    write_summary(outcomes, both.study, both.results / "summary")

    for row_class in (ComparisonRow, VerdictRow):
        of_block = [row for row in outcomes[0].rows[row_class] if row.structure == "block"]
        assert list(csv_lines(row_class, of_block)) == list(csv_lines(row_class, expected.rows[row_class]))
    tables = {
        row_class: list(read_rows(row_class, both.results / "summary" / row_class.table.file_name))
        for row_class in (StructureRow, CapacityRow, FailureRow)
    }
    assert all(
        any(row.structure == "block" for row in tables[row_class])
        for row_class in (StructureRow, CapacityRow)
    )
    told = [row for row in tables[FailureRow] if "ZeroDivisionError" in row.message]
    assert told and {row.structure for row in told} <= {"pier", ""}
    assert all("pier" in row.message for row in told)


@pytest.mark.parametrize(
    ("place", "file"),
    [
        ("rocking.reports.summary.summary_data", "summary.pdf"),
        ("rocking.reports.explore.explore_page", "study.html"),
        ("rocking.study.summary.workbook", "study.xlsx"),
        ("rocking.reports.scatter.prediction_scatter", "prediction_against_integration.svg"),
    ],
)
def test_a_page_never_costs_a_summary(place, file, tmp_path: Path, monkeypatch) -> None:
    results = tmp_path / "results"
    study = _study(block=BLOCK)
    study = replace(study, settings=replace(study.settings, reports=True))
    job = worked([_record(tmp_path)], study, results)
    keep_nothing(results, "map")

    def fails(*_arguments, **_values):
        raise KeyError("kind that_has_no_sentence")

    monkeypatch.setattr(place, fails)
    summarise(job)
    files = list(outputs_of("summary", job.plan.settings).values())
    assert {path.name for path in files} >= {"summary.pdf", "study.html", "study.xlsx", "verdicts.csv", file}
    assert all(path.stat().st_size > 0 for path in files)
    (fault,) = read_rows(FailureRow, results / "summary" / "failures.csv")
    assert fault.message.startswith("a fault of rocking") and f" {file} (KeyError" in fault.message
    assert list(read_rows(ComparisonRow, results / "summary" / "comparison.csv"))


def test_a_report_that_cannot_be_made_costs_its_record_nothing(tmp_path: Path, monkeypatch) -> None:
    record = _record(tmp_path)
    study = _study(block=BLOCK)
    study = replace(study, settings=replace(study.settings, reports=True))

    def fails(*_arguments, **_values):
        raise KeyError("kind that_has_no_sentence")

    monkeypatch.setattr("rocking.reports.record.page_one", fails)
    job = worked([record], study, tmp_path / "results")
    (outcome,) = outcomes_in(job.results, [record])
    (fault,) = outcome.rows[FailureRow]
    assert (fault.record, fault.stage) == (record.id, "document")
    assert fault.message.startswith("a fault of rocking in report.pdf (KeyError")
    for of_the_machine in (OSError, MemoryError):
        with pytest.raises(of_the_machine):
            made_or_failed(tmp_path / "report.pdf", Mock(side_effect=of_the_machine), job.log)
    assert outcome.rows[ComparisonRow] and outcome.rows[VerdictRow]
    assert (job.results / record.id / "report.pdf").read_bytes().startswith(b"%PDF")
