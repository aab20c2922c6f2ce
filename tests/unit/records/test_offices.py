"""What an office has: catalogues that a European spreadsheet saved, workbooks, and families of like files."""

import csv
import io
from pathlib import Path

import made_files
import numpy as np
import pytest
from openpyxl import Workbook

from rocking.catalogue import listing, load_catalogue, open_station, readings
from rocking.catalogue.listing import listing_text
from rocking.errors import CatalogueError, RecordError
from rocking.records import read
from rocking.records.kinds import RecordKind
from rocking.records.sheet import table_of_workbook
from rocking.study.workspace import write_catalogue
from rocking.warnings import RockingWarning
from tests.folders import list_folder
from tests.refusals import refused

TIMES = 0.01 * np.arange(300)
MOTION = np.sin(7.3 * TIMES) * np.exp(-0.4 * TIMES)


def european(path: Path, rows: list[dict[str, str]], encoding: str) -> Path:
    """A catalogue as such a spreadsheet saves it: semicolons between the cells, and commas in the numbers."""
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, list(rows[0]), delimiter=";", lineterminator="\r\n")
    writer.writeheader()
    writer.writerows(rows)
    path.write_bytes(text.getvalue().encode(encoding))
    return path


@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp1252"])
def test_a_catalogue_with_semicolons_and_decimal_commas(tmp_path: Path, encoding: str) -> None:
    np.savetxt(tmp_path / "n.txt", MOTION)
    np.savetxt(tmp_path / "e.txt", MOTION[::-1])
    row = {"id": "both", "file": "n.txt;e.txt", "component": "N;E", "unit": "m/s2", "time_step_s": "0,01",
           "scale_factor": "", "scale_to": "pga 0,35 g", "station": "Düzce"}  # fmt: skip
    path = european(tmp_path / "catalogue.csv", [row], encoding)
    (record,) = load_catalogue(path)
    assert (record.time_step, record.scale_to, record.station) == (0.01, "pga 0.35 g", "Düzce")
    north, _ = open_station(record).horizontal
    assert north.component == "N" and north.acceleration.size == MOTION.size
    assert "0 of them new" in write_catalogue(tmp_path, path, None, None)


def test_a_defect_of_a_whole_column_is_told_once(tmp_path: Path) -> None:
    rows = [{"id": f"r{i}", "file": f"{i}.txt", "unit": "furlong"} for i in range(131)]
    path = european(tmp_path / "catalogue.csv", rows, "utf-8")
    with pytest.raises(CatalogueError) as caught:
        load_catalogue(path)
    assert str(caught.value).count("furlong") == 1 and "and 128 others" in str(caught.value)


def workbook(path: Path, rows: list[list[object]], *titles: str) -> Path:
    book = Workbook()
    for place, title in enumerate(titles or ("Sheet1",)):
        sheet = book.active if not place else book.create_sheet()
        sheet.title = title
        for row in rows:
            sheet.append(row)
    book.save(path)
    return path


def test_a_workbook_with_times_and_units_is_read(tmp_path: Path) -> None:
    numbers = [[t, a, 2 * a] for t, a in zip(TIMES.round(6).tolist(), MOTION.tolist(), strict=True)]
    rows = [["Made earthquake"], [], ["Time (s)", "NS (cm/s2)", "Up (cm/s2)"], *numbers]
    north, up = read(workbook(tmp_path / "made.xlsx", rows))
    assert (north.component, up.vertical, north.time_step) == ("NS", True, 0.01)
    assert np.allclose(north.acceleration, MOTION / 100, atol=1e-12)
    listed, _ = list_folder(tmp_path)
    assert [file.refusal for file in listed] == [""]


def test_a_workbook_may_have_its_units_below_the_names_and_a_spectrum_in_further_columns(
    tmp_path: Path,
) -> None:
    series = list(zip(TIMES.round(6).tolist(), MOTION.tolist(), strict=True))
    spectrum = [[0.1, 0.5], [0.2, 0.7]]
    numbers = [[t, a, None, *(spectrum[at] if at < 2 else [])] for at, (t, a) in enumerate(series)]
    heads = [["Time", "NS", None, "Period", "Sa"], ["(s)", "(cm/s2)", None, "(s)", "(g)"]]
    (record,) = read(workbook(tmp_path / "made.xlsx", [*heads, *numbers]))
    assert (record.component, record.time_step) == ("NS", 0.01)
    assert np.allclose(record.acceleration, MOTION / 100, atol=1e-12)


@pytest.mark.parametrize(("head", "titles"), [
    (["Time (s)", "NS", "UD"], ["one"]), (["Time (s)", "NS (g)", "UD (g)"], ["one", "two"]), (["a", "b", "c"], ["one"]),
])  # fmt: skip
def test_a_workbook_that_leaves_something_open_is_to_be_saved_as_csv(
    tmp_path: Path, head: list[str], titles: list[str]
) -> None:
    numbers = [[t, a, 2 * a] for t, a in zip(TIMES.tolist(), MOTION.tolist(), strict=True)]
    with refused(RecordError, "sheets"):
        read(workbook(tmp_path / "made.xlsx", [head, *numbers], *titles))


def test_a_sheet_of_eight_rows_holds_a_series_and_of_seven_none(tmp_path: Path) -> None:
    rows = [["Time (s)", "NS (g)"], *([t, a] for t, a in zip(TIMES.tolist(), MOTION.tolist(), strict=True))]
    text = table_of_workbook(workbook(tmp_path / "made.xlsx", rows[:9]).read_bytes())
    assert len(text.splitlines()) == 9
    with refused(RecordError, "sheets", ()):
        table_of_workbook(workbook(tmp_path / "made.xlsx", rows[:8]).read_bytes())


def test_damaged_workbooks_and_other_archives_are_refused_in_a_sentence(tmp_path: Path) -> None:
    whole = workbook(tmp_path / "made.xlsx", [["Time (s)", "NS (g)"], [0.0, 0.1]]).read_bytes()
    for cut in range(0, len(whole), len(whole) // 40):
        for content in (whole[:cut], whole[:cut] + b"\xff" * 20 + whole[cut + 20 :]):
            (tmp_path / "cut.xlsx").write_bytes(content)
            with pytest.raises(RecordError) as caught:
                read(tmp_path / "cut.xlsx")
            assert "call it so" not in str(caught.value)


def test_files_of_one_family_share_a_line(tmp_path: Path) -> None:
    for place in range(30):
        (tmp_path / f"note{place:02}.txt").write_text(f"Dear colleague {place},\nhere it is.\n")
    listed, _ = list_folder(tmp_path)
    text = listing_text(listed, width=100)
    assert (
        text.count("Dear colleague") == text.count("Dear colleague 0") == 1
        and "note00.txt, note01.txt, note02.txt and 27 others: " in text
    )


def test_a_unit_that_is_declared_for_a_folder_fills_the_rows_that_asked(tmp_path: Path) -> None:
    """Else the second run says nothing any more, and the study fails for want of it."""
    np.savetxt(tmp_path / "a.txt", np.column_stack([TIMES, MOTION]))
    target = tmp_path / "catalogue.csv"
    assert "Answer once" in write_catalogue(tmp_path, target, None, None)
    write_catalogue(tmp_path, target, "m/s2", None)
    (record,) = load_catalogue(target)
    assert record.unit == "m/s2" and "Fill in" not in record.note
    assert open_station(record).horizontal[0].acceleration.size == MOTION.size


def test_a_fault_of_ours_costs_no_other_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "good.AT2").write_text(made_files.peer())
    (tmp_path / "strange.AT2").write_text(made_files.peer().replace("Station", "Strange"))

    def read_or_break(raw: bytes, *rest: object):
        if b"Strange" in raw:
            raise ZeroDivisionError("made for a test")
        return listing.read_for_listing(raw, *rest)

    monkeypatch.setattr(readings, "read_for_listing", read_or_break)
    listed, rows = list_folder(tmp_path)
    assert [row["file"] for row in rows] == ["good.AT2"]
    (strange,) = (file for file in listed if file.file == "strange.AT2")
    log = tmp_path / ".rocking_faults.log"
    assert strange.refusal == (
        f"a fault of rocking in this file (ZeroDivisionError: made for a test); please report it, with {log}."
    )
    assert "read_or_break" in log.read_text() and "Traceback" in log.read_text()


def test_nothing_is_decided_by_the_words_of_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With every sentence in words that nobody knows, the same rows, joins and refusals come out."""
    for name, (make, *_) in made_files.MADE.items():
        (tmp_path / f"{''.join(filter(str.isalnum, name))}.txt").write_text(make(), encoding="latin-1")
    (tmp_path / "only_up.txt").write_text("".join(f"{value:.6f}\n" for value in MOTION))
    for name in ("a_N.txt", "a_E.txt", "a_copy_E.txt"):
        np.savetxt(tmp_path / name, np.column_stack([TIMES, MOTION if "N" in name else MOTION[::-1]]))

    def found() -> tuple[list[object], list[object]]:
        listed, rows = list_folder(tmp_path, unit="m/s2", time_step=0.01)
        files = [(file.file, file.record, file.companions, file.direction, [warning.kind for warning in file.warnings],
                  file.separation and file.separation.kind, bool(file.refusal)) for file in listed]  # fmt: skip
        return files, [{key: cell for key, cell in row.items() if key != "note"} for row in rows]

    before = found()
    assert len({kind for file in before[0] for kind in file[4]}) > 3
    for kind in RecordKind:
        words = "".join(f"{{{name}}}" for name in kind.value_names)
        monkeypatch.setattr(kind, "sentence", f"xyzzy{words}")
    assert str(RockingWarning(RecordKind.WARNING_OF_OBSPY, values=(("text", "a"),))) == "xyzzya"
    assert found() == before
