"""The catalogue of a folder, made again: what was read is kept by content, renamed files are known, cells are typed."""

import hashlib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rocking.catalogue import listing, load_catalogue
from rocking.catalogue.catalogue import catalogue_text, read_rows
from rocking.catalogue.folder import catalogue_of_folder
from rocking.catalogue.readings import STORE
from rocking.records.kinds import RecordKind
from rocking.study.workspace import write_catalogue
from rocking.warnings import RockingWarning

ROWS = "".join(f"{i / 100},{i % 5},{i % 7}\n" for i in range(400))
TABLE = "time,NS (gal),EW (gal)\n" + ROWS


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for number in range(3):
        (tmp_path / f"r{number}.csv").write_text(TABLE.replace("3.5,", f"3.5,{number}"))
    return tmp_path


@pytest.fixture
def reads(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the files that are read, as they are."""
    names: list[str] = []
    before = listing.read_raw

    def noted(raw: bytes, path: Path, options: Any) -> Any:
        names.append(path.name)
        return before(raw, path, options)

    monkeypatch.setattr(listing, "read_raw", noted)
    return names


def again(folder: Path) -> str:
    return write_catalogue(folder, folder / "catalogue.csv", None, None)


def test_a_file_is_read_once_for_its_content(folder: Path, reads: list[str]) -> None:
    first = again(folder)
    assert sorted(reads) == ["r0.csv", "r1.csv", "r2.csv"] and "3 of them new" in first
    table = first.split("\n\n")[0]
    reads.clear()
    second = again(folder)
    assert not reads and second.split("\n\n")[0] == table and "0 of them new" in second
    (folder / "r1.csv").write_text(TABLE.replace("1,", "2,", 1))
    again(folder)
    assert reads == ["r1.csv"]


def test_what_is_doubtful_of_a_file_is_kept_with_its_values(folder: Path, reads: list[str]) -> None:
    (folder / "loud.csv").write_text(
        "time,NS (g),EW (g)\n" + "".join(f"{i / 100},{4 * (i % 2)},{i % 3}\n" for i in range(99))
    )
    first, second = (catalogue_of_folder(folder, keeps_readings=True).files for _ in range(2))
    assert len(reads) == 4
    assert [file.warnings for file in second] == [file.warnings for file in first]
    (rare,) = (
        warning for file in second for warning in file.warnings if warning.kind is RecordKind.PEAK_RARE
    )
    assert rare.about == "NS" and rare["peak_g"] == pytest.approx(4.0)


def _cut(text: str) -> str:
    return text[:-30]


def _of_another_version(text: str) -> str:
    return json.dumps(json.loads(text) | {"version": "0" * 64})


def _edited(text: str) -> str:
    return text.replace("NS", "EW")


def _of_other_types(text: str) -> str:
    """The checksum is right, but a number is a text."""
    store = json.loads(text)
    store["readings"] = store["readings"].replace('"samples":400', '"samples":"400"')
    return _sealed(store)


def _of_unknown_warnings(text: str) -> str:
    """The checksum is right, but the catalogue of warnings holds no such kind."""
    store = json.loads(text)
    readings = json.loads(store["readings"])
    for reading in readings.values():
        reading["warnings"] = [{"kind": "strange", "about": "", "values": []}]
    store["readings"] = json.dumps(readings)
    return _sealed(store)


def _sealed(store: dict[str, Any]) -> str:
    return json.dumps(store | {"sha256": hashlib.sha256(store["readings"].encode()).hexdigest()})


def _foreign(_: str) -> str:
    return "[" * 100_000


def _pickle(_: str) -> str:
    return "cos\nsystem\n(S'true'\ntR."


@pytest.mark.parametrize(
    "damage",
    [_cut, _of_another_version, _edited, _of_other_types, _of_unknown_warnings, _foreign, _pickle],
)
def test_a_store_that_is_not_ours_is_ignored_with_a_line(
    folder: Path, reads: list[str], damage: Callable[[str], str]
) -> None:
    first = again(folder)
    table = first.split("\n\n")[0]
    (folder / STORE).write_text(damage((folder / STORE).read_text()))
    reads.clear()
    second = again(folder)
    assert len(reads) == 3 and second.split("\n\n")[0] == table
    assert f"{STORE}: " in second and "read again" in second
    reads.clear()
    assert "read again" not in again(folder) and not reads


def test_a_pipe_in_its_place_is_not_waited_for(folder: Path, reads: list[str]) -> None:
    os.mkfifo(folder / STORE)
    assert "it is no regular file; give the path of a file; every file is read again." in again(folder)
    assert len(reads) == 3


def test_a_renamed_file_is_known_by_its_content(folder: Path) -> None:
    again(folder)
    ids = [record.id for record in load_catalogue(folder / "catalogue.csv")]
    (folder / "r1.csv").rename(folder / "=new name.csv")
    text = again(folder)
    assert "r1: the file r1.csv is now =new name.csv, by its content; the row names it." in text
    assert "0 of them new" in text and "its file is not there" not in text
    records = load_catalogue(folder / "catalogue.csv")
    assert [record.id for record in records] == ids and records[1].file == "./=new name.csv"
    assert "is now" not in again(folder)


def test_a_copy_is_no_new_name(folder: Path) -> None:
    again(folder)
    (folder / "copy.csv").write_bytes((folder / "r1.csv").read_bytes())
    text = again(folder)
    assert "is now" not in text and "1 of them new" in text
    assert str(RockingWarning.of(RecordKind.CONTENT_REPEATED, original="copy.csv")) in text


def test_a_typed_cell_clears_its_request(folder: Path) -> None:
    (folder / "bare.txt").write_text("".join(f"{i % 7}\n" for i in range(500)))
    assert "bare.txt: one series in ?, 1 a line" in again(folder)
    path = folder / "catalogue.csv"

    def typed(**cells: str) -> str:
        rows = [row | (cells if row["id"] == "bare" else {}) for _, row in read_rows(path)]
        path.write_text(catalogue_text(rows), encoding="utf-8")
        text = again(folder)
        (row,) = (row for _, row in read_rows(path) if row["id"] == "bare")
        assert "Fill in, in" not in text or not row["time_step_s"]
        return row["note"]

    assert typed(note="mine. Fill in unit and time_step_s. Yes") == "mine. Fill in unit and time_step_s. Yes"
    assert typed(unit="gal") == "mine. Fill in time_step_s. Yes"
    assert typed(time_step_s="0.01") == "mine. Yes"


def test_rows_that_could_be_one_are_told(folder: Path) -> None:
    for name in ("ELC000", "ELC090"):
        rows = "".join(f"{i / 100:.2f},{i % (3 + len(name[3:].strip('0')))}\n" for i in range(400))
        (folder / f"{name}.csv").write_text(rows)
    cells = {"unit": "gal"}
    rows_apart = [{"id": name, "file": f"{name}.csv", **cells} for name in ("ELC000", "ELC090")]
    (folder / "catalogue.csv").write_text(catalogue_text(rows_apart))
    text = again(folder)
    assert (
        "ELC000.csv;ELC090.csv are components of one station: name them all in the row ELC000 and ELC090"
        in text
    )
    assert [row["file"] for _, row in read_rows(folder / "catalogue.csv")][:2] == ["ELC000.csv", "ELC090.csv"]
