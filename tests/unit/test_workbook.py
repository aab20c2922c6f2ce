"""A workbook holds what the tables hold, cell by cell with its type, and the same bytes each time."""

import math
import re
import zipfile
from io import BytesIO
from xml.etree import ElementTree

import pytest

from rocking.tables import Row, column, row
from rocking.tables.workbook import workbook

SPACE = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


@row("cases", "Made for a test")
class CaseRow(Row):
    """One of each type."""

    record: str = column("Whose row it is")
    rotation_rad: float = column("How far it turns")
    count: int | None = column("How many")
    holds: bool | None = column("Whether it holds")
    flags: tuple[str, ...] = column("What is doubtful")


ROWS = [
    CaseRow(record="=1+1", rotation_rad=0.25, count=3, holds=True, flags=("a", "b")),
    CaseRow(record="http://x", rotation_rad=math.inf, count=None, holds=False, flags=()),
    CaseRow(record="\x07bell", rotation_rad=math.nan, count=-(2**40), holds=None, flags=("one",)),
]


def _made(rows: list[CaseRow] = ROWS) -> bytes:
    return workbook({CaseRow: rows}, "A study")


def _cells(content: bytes, sheet: int) -> dict[str, tuple[str, str]]:
    """Type and text of each cell, as the file format writes them: an oracle that knows nothing of the writer."""
    with zipfile.ZipFile(BytesIO(content)) as book:
        root = ElementTree.fromstring(book.read(f"xl/worksheets/sheet{sheet}.xml"))
    cells = root.iter(f"{SPACE}c")
    return {cell.get("r", ""): (cell.get("t", "n"), "".join(cell.itertext())) for cell in cells}


def _texts(place: str, *texts: str) -> dict[str, tuple[str, str]]:
    return {f"{column}{place}": ("inlineStr", text) for column, text in zip("ABCDE", texts, strict=True)}


def test_every_cell_has_its_type_and_every_head_its_unit() -> None:
    assert _cells(_made(), 2) == {
        **_texts("1", "record", "rotation [rad]", "count", "holds", "flags"),
        "A2": ("inlineStr", "=1+1"), "B2": ("n", "0.25"), "C2": ("n", "3"), "D2": ("b", "1"),
        "E2": ("inlineStr", "a; b"), "A3": ("inlineStr", "http://x"), "B3": ("inlineStr", "INF"), "D3": ("b", "0"),
        "A4": ("inlineStr", r"\x07bell"), "C4": ("n", str(-(2**40))), "E4": ("inlineStr", "one"),
    }  # fmt: skip


def test_the_first_sheet_says_what_each_column_means() -> None:
    assert _cells(_made(), 1) == {
        **_texts("1", "Sheet", "Column", "Column of the CSV", "Unit", "Meaning"),
        **_texts("2", "cases", "record", "record", "", "Whose row it is"),
        **_texts("3", "cases", "rotation [rad]", "rotation_rad", "rad", "How far it turns"),
        **_texts("4", "cases", "count", "count", "", "How many"),
        **_texts("5", "cases", "holds", "holds", "", "Whether it holds"),
        **_texts("6", "cases", "flags", "flags", "", "What is doubtful"),
    }


@pytest.mark.parametrize(("sheet", "kept"), [(1, {"ySplit": "1"}), (2, {"xSplit": "1", "ySplit": "1"})])
def test_heads_stay_in_sight_and_of_a_table_its_first_column(sheet: int, kept: dict[str, str]) -> None:
    with zipfile.ZipFile(BytesIO(_made())) as book:
        root = ElementTree.fromstring(book.read(f"xl/worksheets/sheet{sheet}.xml"))
    (pane,) = root.iter(f"{SPACE}pane")
    assert {key: value for key, value in pane.items() if key.endswith("Split")} == kept


@pytest.mark.parametrize(("rows", "filtered"), [(ROWS, "A1:E4"), ([], "A1:E1")])
def test_the_filter_covers_the_rows_and_no_line_below_them(rows: list[CaseRow], filtered: str) -> None:
    with zipfile.ZipFile(BytesIO(_made(rows))) as book:
        root = ElementTree.fromstring(book.read("xl/worksheets/sheet2.xml"))
    assert [item.get("ref") for item in root.iter(f"{SPACE}autoFilter")] == [filtered]


def test_the_heads_are_bold_above_a_thin_line() -> None:
    with zipfile.ZipFile(BytesIO(_made())) as book:
        styles = ElementTree.fromstring(book.read("xl/styles.xml"))
        sheet = ElementTree.fromstring(book.read("xl/worksheets/sheet2.xml"))
    forms = styles.findall(f"{SPACE}cellXfs/{SPACE}xf")
    head = forms[int(next(sheet.iter(f"{SPACE}c")).get("s", "0"))]
    font = styles.findall(f"{SPACE}fonts/{SPACE}font")[int(head.get("fontId", "0"))]
    border = styles.findall(f"{SPACE}borders/{SPACE}border")[int(head.get("borderId", "0"))]
    below = border.find(f"{SPACE}bottom")
    assert font.find(f"{SPACE}b") is not None
    assert below is not None and below.get("style") == "thin"


def test_no_cell_is_a_formula_and_nothing_in_it_changes_between_two_runs() -> None:
    first = _made()
    with zipfile.ZipFile(BytesIO(first)) as book:
        texts = [book.read(name).decode() for name in book.namelist()]
    assert not any(re.search("<f>|\x07", text) for text in texts)
    assert _made() == first


def test_a_table_that_no_sheet_holds_is_left_out_and_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rocking.tables.workbook.MOST_ROWS", 2)
    content = _made()
    assert "cases has more rows than a sheet holds; read cases.csv." in _cells(content, 1)["A2"][1]
    with zipfile.ZipFile(BytesIO(content)) as book:
        assert "xl/worksheets/sheet2.xml" not in book.namelist()


def test_it_opens_on_the_sheet_that_is_asked_for() -> None:
    """The sheets count from 0, that of the columns first."""
    for opens_on, place in ((None, None), (CaseRow, "1")):
        with zipfile.ZipFile(BytesIO(workbook({CaseRow: ROWS}, opens_on=opens_on))) as book:
            root = ElementTree.fromstring(book.read("xl/workbook.xml"))
        (view,) = root.iter(f"{SPACE}workbookView")
        assert view.get("activeTab") == place
