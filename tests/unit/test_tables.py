"""Tables: what stands in a cell, and that a file appears whole or not at all."""

import csv
import io
import json
import math
import subprocess
import sys
import weakref
from enum import StrEnum
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocking.errors import RockingError
from rocking.tables import (
    Column,
    Table,
    csv_cells,
    csv_lines,
    data_package,
    read_rows,
    write_table,
    write_whole,
)

TABLE = Table("made", "Made for a test", (Column("a", "string", "A"), Column("b", "number", "B", "Eq. 1")))


class Colour(StrEnum):
    RED = "red hot"


@pytest.mark.parametrize(
    ("value", "cell"),
    [
        (None, ""),
        (True, "true"),
        (math.nan, ""),
        (math.inf, "INF"),
        (-math.inf, "-INF"),
        (0.1 + 0.2, "0.30000000000000004"),
        (Colour.RED, "red hot"),
        (("one", "two"), "one; two"),
        (7, "7"),
    ],
)
def test_a_cell_says_what_the_value_is(value: object, cell: str) -> None:
    assert csv_cells(TABLE, {"a": value, "b": 1})["a"] == cell


@given(st.text(st.characters(codec="utf-8", exclude_characters="\x00\r")), st.floats(allow_nan=False))
def test_what_is_written_is_read_again(text: str, number: float) -> None:
    lines = list(csv_lines(TABLE, [{"a": text, "b": number}]))
    (row,) = csv.DictReader(io.StringIO("".join(lines), newline=""))
    assert row["a"] == text
    assert float(row["b"]) == number


@pytest.mark.parametrize("row", [{"a": 1}, {"a": 1, "b": 2, "c": 3}])
def test_a_row_of_other_columns_is_refused_and_nothing_is_written(
    tmp_path: Path, row: dict[str, object]
) -> None:
    with pytest.raises(RockingError, match=r"made\.csv: a row and the table differ in the columns"):
        write_table(TABLE, [{"a": 1, "b": 2}, row], tmp_path / "made.csv")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_writer_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "made.csv"
    write_table(TABLE, [{"a": "old", "b": 1}], path)

    def rows():
        yield {"a": "new", "b": 2}
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_table(TABLE, rows(), path)
    assert read_rows(path) == [{"a": "old", "b": "1"}]
    assert [entry.name for entry in tmp_path.iterdir()] == ["made.csv"]


def test_what_a_killed_writer_left_is_removed_by_the_next(tmp_path: Path) -> None:
    (tmp_path / ".made.csv.abc123.part").write_text("half")
    (tmp_path / ".other.csv.abc123.part").write_text("somebody else's")
    write_table(TABLE, [], tmp_path / "made.csv")
    assert sorted(entry.name for entry in tmp_path.iterdir()) == [".other.csv.abc123.part", "made.csv"]


def test_a_disk_that_takes_no_more_is_said_in_a_sentence(tmp_path: Path) -> None:
    """The system stops the child at 1000 bytes a file, as a full disk would."""
    child = f"""
import resource, signal
from pathlib import Path
from rocking.errors import RockingError
from rocking.tables import write_whole
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
try:
    write_whole(Path({str(tmp_path)!r}) / "made.csv", b"x" * 5000)
except RockingError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", child], capture_output=True, text=True, check=True)
    assert (
        done.stdout.strip()
        == f"{tmp_path / 'made.csv'} cannot be written: File too large; mend that, then start again."
    )
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_a_file_is_said_in_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    with pytest.raises(RockingError, match=r"made\.csv cannot be written: (Not a directory|File exists)"):
        write_whole(tmp_path / "taken" / "made.csv", b"")


def test_memory_does_not_grow_with_the_rows(tmp_path: Path) -> None:
    """A generator of rows is never held whole: each is dropped before the next but one is made."""

    class Cell(str):
        __slots__ = ("__weakref__",)

    alive: list[weakref.ref[Cell]] = []

    def rows():
        for number in range(100):
            cell = Cell(number)
            alive.append(weakref.ref(cell))
            yield {"a": cell, "b": 0}
            assert sum(ref() is not None for ref in alive) <= 2

    write_table(TABLE, rows(), tmp_path / "made.csv")
    assert len(read_rows(tmp_path / "made.csv")) == 100


def test_a_data_package_describes_each_column_once() -> None:
    package = json.loads(data_package("study", {"made": (TABLE, ["x/made.csv", "y/made.csv"])}))
    (resource,) = package["resources"]
    assert resource["path"] == ["x/made.csv", "y/made.csv"]
    assert resource["schema"]["fields"] == [
        {"name": "a", "type": "string", "description": "A"},
        {"name": "b", "type": "number", "description": "B", "equation": "Eq. 1"},
    ]
