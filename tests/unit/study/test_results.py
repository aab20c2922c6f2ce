"""Results: every table of a study as a data frame."""

from pathlib import Path

import pytest

import rocking
from rocking.assessment.rows import SUMMARY_TABLES, StructureRow, TimingRow
from rocking.errors import RockingError
from rocking.tables import write_rows


def _timing(record: str) -> TimingRow:
    return TimingRow(record=record, stage="read", duration_s=0.5)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for each in SUMMARY_TABLES:
        if each is not TimingRow:
            write_rows(each, [], tmp_path / "summary" / each.table.file_name)
    for record in ("b", "a"):
        write_rows(TimingRow, [_timing(record)], tmp_path / record / "timings.csv")
    return tmp_path


def test_a_table_of_the_summary_is_an_attribute(folder: Path) -> None:
    results = rocking.open_results(folder)
    assert tuple(results.structures) == StructureRow.table.column_names
    assert {"comparison", "responses", "trade"} <= set(dir(results))


def test_a_table_of_the_records_is_gathered(folder: Path) -> None:
    results = rocking.open_results(str(folder))
    assert results.timings["record"].tolist() == ["a", "b"]
    assert list(results.table("timings", ["duration_s"])) == ["duration_s"]


def test_what_is_not_there_is_said(folder: Path) -> None:
    results = rocking.open_results(folder)
    with pytest.raises(AttributeError, match="no table 'verdicts'"):
        _ = results.verdicts
    with pytest.raises(RockingError, match=r"holds no responses\.csv"):
        _ = results.responses
    with pytest.raises(RockingError, match="must be one of"):
        results.table("verdicts")
    with pytest.raises(RockingError, match="is no folder"):
        rocking.open_results(folder / "nowhere")
