"""Results: every table of a study as a data frame."""

from pathlib import Path

import pytest

import rocking
from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES, StructureRow, TimedStage, TimingRow
from rocking.errors import RockingError
from rocking.study.cli import main
from rocking.study.results import cases_of, part, remove_copies, remove_other_cases
from rocking.tables import read_rows, write_rows


def _timing(record: str) -> TimingRow:
    return TimingRow.of(TimedStage(record, "read", 0.5))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for each in SUMMARY_TABLES:
        if each is not TimingRow:
            write_rows(each, [], tmp_path / "summary" / each.table.file_name)
    for number, record in enumerate(("b", "a")):
        folder = part(tmp_path, f"0000{number}_of_00002")
        for each in RECORD_TABLES:
            write_rows(each, [_timing(record)] if each is TimingRow else [], folder / each.table.file_name)
    return tmp_path


def test_a_table_of_the_summary_is_an_attribute(folder: Path) -> None:
    results = rocking.open_results(folder)
    assert tuple(results.structures) == StructureRow.table.column_names
    assert {"comparison", "variations", "trade"} <= set(dir(results))


def test_what_is_not_there_is_said(folder: Path) -> None:
    results = rocking.open_results(folder)
    with pytest.raises(AttributeError, match="no table 'sums'"):
        _ = results.sums
    with pytest.raises(RockingError, match=r"holds no trade\.csv"):
        _ = results.trade
    with pytest.raises(RockingError, match="must be one of"):
        results.table("sums")
    with pytest.raises(RockingError, match="is no folder"):
        rocking.open_results(folder / "nowhere")


def test_the_tables_of_a_record_are_written_where_they_are_asked_for(folder: Path, capsys) -> None:
    assert main(["tables", str(folder), "a"]) == 0
    assert capsys.readouterr().out == f"{folder / 'a'}\n"
    assert [row.record for row in read_rows(TimingRow, folder / "a" / "timings.csv")] == ["a"]
    assert len(rocking.open_results(folder).write_record("b", folder / "elsewhere")) == len(RECORD_TABLES)
    assert main(["tables", str(folder), "c"]) == 1
    assert "holds no tables of 'c'" in capsys.readouterr().err


def test_the_tables_of_records_assessed_one_by_one_are_gathered(tmp_path: Path) -> None:
    for record in ("b", "a"):
        write_rows(TimingRow, [_timing(record)], tmp_path / record / "timings.csv")
    assert rocking.open_results(tmp_path).timings["record"].tolist() == ["a", "b"]


def test_cases_of_other_records_are_removed_by_whichever_run_comes_first(tmp_path: Path) -> None:
    for record in ("kept", "gone", "removed meanwhile"):
        path = cases_of(tmp_path, record)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()

    class Records(set[str]):
        """The records of the study; while it is asked, another run removes a file."""

        def __contains__(self, name: object) -> bool:
            cases_of(tmp_path, "removed meanwhile").unlink(missing_ok=True)
            return super().__contains__(name)

    remove_other_cases(tmp_path, Records({"kept"}))
    assert [each.stem for each in cases_of(tmp_path, "").parent.iterdir()] == ["kept"]


def test_of_the_tables_of_one_record_those_are_removed_that_there_are(tmp_path: Path) -> None:
    """An earlier version wrote fewer of them, and a user may have removed some."""
    write_rows(TimingRow, [_timing("a")], tmp_path / TimingRow.table.file_name)
    (tmp_path / "report.pdf").touch()
    remove_copies(tmp_path)
    assert [each.name for each in tmp_path.iterdir()] == ["report.pdf"]
