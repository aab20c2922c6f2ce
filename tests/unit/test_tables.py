"""Tables: what stands in a cell, that rows come back as they went, and that a file appears whole or not at all."""

import csv
import errno
import io
import json
import math
import os
from enum import StrEnum
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocking import tables
from rocking.errors import RockingError
from rocking.tables import Row, cell, column, frame, read_rows, row, write_rows, write_whole
from tests.refusals import refused
from tests.unit.assessment.made_rows import filled


class Colour(StrEnum):
    RED = "red hot"
    BLUE = "blue"


@row()
class Head(Row):
    """What both kinds of row share."""

    record: str = column("Whose row it is")
    sha256: str = column("Where it comes from", last=True)


@row("made", "Made for a test")
class MadeRow(Head):
    """One of each type."""

    speed_rad_s: float = column("How fast", equation="Eq. 1")
    count: int = column("How many")
    missing_count: int | None = column("How many, where it is known")
    holds: bool | None = column("Whether it holds")
    colour: Colour = column("Which colour")
    other_colour: Colour | None = column("Which other colour")
    flags: tuple[str, ...] = column("What is doubtful")


def made(record: str = "one", speed: float = 1.0, **others) -> MadeRow:
    return filled(MadeRow, record=record, **{"speed_rad_s": speed, "count": 1, "colour": Colour.RED} | others)


TEXT = st.text(max_size=12) | st.text("=+-@\t\r\n'\\u\x00\u2028n", max_size=6)
ROWS = st.builds(
    MadeRow,
    record=TEXT,
    sha256=TEXT,
    speed_rad_s=st.floats(allow_nan=False),
    count=st.integers(-(2**60), 2**60),
    missing_count=st.none() | st.integers(0, 2**60),
    flags=st.lists(TEXT.filter(lambda text: text and ";" not in text), max_size=3).map(tuple),
)


@pytest.mark.parametrize(("value", "text"), [
    (None, ""), (True, "true"), (math.nan, ""), (math.inf, "INF"), (-math.inf, "-INF"), (7, "7"), (-7.5, "-7.5"),
    (0.1 + 0.2, "0.30000000000000004"), (np.float64(0.5), "0.5"), (Colour.RED, "red hot"), (("one", "two"), "one; two"),
    ("=1+1", "'=1+1"), ("@SUM(A1)", "'@SUM(A1)"), ("-NS", "'-NS"), ("\t=1", "'\\u0009=1"), ("'quoted'", "'quoted'"),
    ("two\nlines", "two\\u000alines"), ("C:\\records", "C:\\\\records"),
])  # fmt: skip
def test_a_cell_says_what_the_value_is(value: object, text: str) -> None:
    assert cell(value) == text


@given(st.lists(ROWS, max_size=4))
def test_what_is_written_is_read_again_row_by_row_and_as_a_frame(tmp_path_factory, rows) -> None:
    path = tmp_path_factory.mktemp("made") / "made.csv"
    write_rows(MadeRow, rows, path)
    assert list(read_rows(MadeRow, path)) == rows
    table = frame(MadeRow, path)
    pd.testing.assert_frame_equal(table, frame(MadeRow, rows))
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) == len(rows) + 1, "a row is one line"
    for line in csv.DictReader(io.StringIO(text)):
        assert not line["record"].startswith(("=", "+", "-", "@", "\t", "\r"))


def test_a_frame_has_the_type_of_each_column(tmp_path: Path) -> None:
    rows = [made(speed=math.inf, holds=True), made(speed=math.nan, missing_count=3)]
    write_rows(MadeRow, rows, tmp_path / "made.csv")
    table = frame(MadeRow, tmp_path / "made.csv")
    kinds = ["str", "float64", "int64", "Int64", "boolean", "category", "category", "str", "str"]
    assert [str(kind) for kind in table.dtypes] == kinds
    assert math.isinf(table["speed_rad_s"][0]) and math.isnan(table["speed_rad_s"][1])
    assert table["holds"].isna().tolist() == [False, True]
    assert list(frame(MadeRow, tmp_path / "made.csv", ["count"])) == ["count"]
    assert frame(MadeRow, []).dtypes.equals(table.dtypes)


def test_a_row_of_another_class_is_refused_and_nothing_is_written(tmp_path: Path) -> None:
    with refused(RockingError, "row", "Head"):
        write_rows(MadeRow, [made(), Head(record="", sha256="")], tmp_path / "made.csv")  # type: ignore[list-item]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("old", "new", "field", "value"), [
    ("count,", "", "columns", ["count"]),
    ("count,", "many,", "columns", ["count", "many"]),
    ("2.5", "fast", "speed_rad_s", "fast"),
    (",17,", ",1.5,", "count", "1.5"),
    (",true,", ",yes,", "holds", "yes"),
    ("blue", "green", "colour", "green"),
    (",blue,", ",,", "colour", ""),
    ("\ntwo", "\n1,2\ntwo", "cells", 2),
])  # fmt: skip
def test_a_defect_is_one_sentence_with_its_place(
    tmp_path: Path, old: str, new: str, field: str, value: object
) -> None:
    path = tmp_path / "made.csv"
    write_rows(MadeRow, [made(), made("two", 2.5, count=17, holds=True, colour=Colour.BLUE)], path)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    for reader in (read_rows, frame):
        with refused(RockingError, field, value) as caught:
            list(reader(MadeRow, path))
        assert str(caught.value).startswith(f"{path}, line {1 if field == 'columns' else 3}")


def test_of_many_strange_columns_the_first_six_are_named(tmp_path: Path) -> None:
    path = tmp_path / "made.csv"
    write_rows(MadeRow, [made()], path)
    head, *others = path.read_text().split("\n")
    path.write_text("\n".join([",".join([head, "b", "a", "e", "d", "c", "g", "f"]), *others]))
    with refused(RockingError, "columns", list("abcdefg")):
        list(read_rows(MadeRow, path))


@pytest.mark.parametrize("content", [None, b"\xff\xfe", b"record,speed_rad_s\n"])
def test_what_is_no_table_is_refused_in_a_sentence(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "made.csv"
    if content is not None:
        path.write_bytes(content)
    for reader in (read_rows, frame):
        with pytest.raises(RockingError) as caught:
            list(reader(MadeRow, path))
        assert caught.value.field in ("file", "columns")


def test_a_writer_that_is_interrupted_or_killed_leaves_the_old_file(tmp_path: Path) -> None:
    """What a killed one left beside it is removed by the next."""
    path = tmp_path / "made.csv"
    write_rows(MadeRow, [made("old")], path)
    (tmp_path / ".made.csv.abc123.part").write_text("half")
    (tmp_path / ".other.csv.abc123.part").write_text("somebody else's")

    def rows():
        yield made("new")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_rows(MadeRow, rows(), path)
    assert [row.record for row in read_rows(MadeRow, path)] == ["old"]
    assert sorted(entry.name for entry in tmp_path.iterdir()) == [".other.csv.abc123.part", "made.csv"]


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="asks Linux which file a number stands for")
def test_files_written_together_appear_when_the_disk_has_them_all(tmp_path: Path, monkeypatch) -> None:
    """What the system is asked for, in its order: to sync a file or folder, or to give a file its name."""
    steps: list[tuple[str, str]] = []
    sync, replace = os.fsync, os.replace

    def syncing(handle: int) -> None:
        steps.append(("sync", Path(os.readlink(f"/proc/self/fd/{handle}")).name))
        sync(handle)

    def naming(temporary: Path, path: Path) -> None:
        steps.append(("name", Path(path).name))
        replace(temporary, path)

    monkeypatch.setattr(os, "fsync", syncing)
    monkeypatch.setattr(os, "replace", naming)
    with tables.written_together():
        for name in ("a.csv", "b.csv"):
            write_whole(tmp_path / name, name.encode())
        assert not list(tmp_path.glob("*.csv")) and not steps
    assert [what for what, _ in steps] == ["sync", "sync", "name", "name", "sync"]
    assert steps[-1] == ("sync", tmp_path.name)
    assert [(tmp_path / name).read_bytes() for name in ("a.csv", "b.csv")] == [b"a.csv", b"b.csv"]
    monkeypatch.setattr(tables.files, "ThreadPoolExecutor", Mock(side_effect=RuntimeError))
    with tables.written_together():
        write_whole(tmp_path / "c.csv", b"c")
        write_whole(tmp_path / "d.csv", b"d")
    assert [what for what, _ in steps[5:]] == ["sync", "sync", "name", "name", "sync"]


def test_a_disk_that_takes_no_more_is_named_in_a_sentence(tmp_path: Path, monkeypatch) -> None:
    def full(handle: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with refused(RockingError, "file", "made.csv"):
        write_whole(tmp_path / "made.csv", b"x" * 5000)
    with refused(RockingError, "file", "made.csv"), tables.written_together():
        write_whole(tmp_path / "made.csv", b"x" * 5000)
    assert list(tmp_path.iterdir()) == []
    with refused(RockingError, "file", "made.csv"):
        write_whole(Path(__file__) / "made.csv", b"x")


def test_a_data_package_describes_each_column_once() -> None:
    package = json.loads(tables.data_package("study", {MadeRow: ["x/made.csv", "y/made.csv"]}))
    (resource,) = package["resources"]
    fields = {field["name"]: field for field in resource["schema"].pop("fields")}
    assert package == {"profile": "tabular-data-package", "name": "study", "resources": [{
        "name": "made", "path": ["x/made.csv", "y/made.csv"], "profile": "tabular-data-resource",
        "description": "Made for a test", "schema": {"missingValues": ["", "nan"]},
    }]}  # fmt: skip
    assert list(fields) == next(csv.reader(tables.csv_lines(MadeRow, []))) and list(fields)[-1] == "sha256"
    speed = {"type": "number", "description": "How fast", "unit": "rad/s", "equation": "Eq. 1"}
    assert fields["speed_rad_s"] == {"name": "speed_rad_s", **speed}
    kinds = [fields[name]["type"] for name in ("count", "missing_count", "holds", "colour", "flags")]
    assert kinds == ["integer", "integer", "boolean", "string", "string"]


def test_a_disk_that_fails_after_the_renaming_is_told_in_words(tmp_path: Path, monkeypatch) -> None:
    """The second thing that the disk is asked for is the folder, when the temporary file is already gone."""
    synced = os.fsync
    asked: list[int] = []

    def failing(handle: int) -> None:
        asked.append(handle)
        if len(asked) == 2:
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        synced(handle)

    monkeypatch.setattr(os, "fsync", failing)
    with refused(RockingError, "file", "table.csv"):
        write_whole(tmp_path / "table.csv", b"content")
    assert not list(tmp_path.glob(".*"))


MISTAKEN = """
from rocking.tables import Row, column, row

@row("made")
class Made(Row):
    number: int = column("Number")

Made(number=3)
Made(number="one")
"""


@pytest.mark.slow
def test_mypy_refuses_a_cell_of_another_type(tmp_path: Path) -> None:
    from mypy import api

    (tmp_path / "made.py").write_text(MISTAKEN, encoding="utf-8")
    said, _, status = api.run([str(tmp_path / "made.py")])  # with the cache of `make check`
    assert status == 1 and said.count("error:") == 1, said
    assert '9: error: Argument "number" to "Made" has incompatible type "str"; expected "int"' in said
