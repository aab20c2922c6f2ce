"""The catalogue: every defect in one message, files found and checked, components chosen."""

import csv
import hashlib
import os
from pathlib import Path

import numpy as np
import pytest

from rocking.errors import CatalogueError, RecordError
from rocking.quantities import GRAVITY
from rocking.records import CatalogueRecord, load_catalogue, open_record, vertical_of
from rocking.records.catalogue import COLUMNS, catalogue_from_folder, write_catalogue_rows
from rocking.records.fetch import fetch, source_address

TABLE = "time,NS (gal),EW (gal),UD (gal)\n" + "".join(
    f"{i / 100},{i % 5},{i % 7},{i % 3}\n" for i in range(50)
)
SHA = hashlib.sha256(TABLE.encode()).hexdigest()
SHIPPED = Path(__file__).parents[3] / "records"


def write(folder: Path, *rows: dict[str, str], columns: tuple[str, ...] = COLUMNS) -> Path:
    path = folder / "catalogue.csv"
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, restval="")
        writer.writeheader()
        writer.writerows(rows)
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "table.csv").write_bytes(TABLE.encode())
    return tmp_path


def row(**changes: str) -> dict[str, str]:
    return {"id": "one", "file": "table.csv", "sha256": SHA, **changes}


def test_horizontal_components_scaled_and_named(folder: Path) -> None:
    path = write(folder, row(scale_factor="2", station="Here", event="Now", high_pass_hz="0.1"))
    (record,) = load_catalogue(path)
    north, east = open_record(record)
    assert (north.component, east.component) == ("NS", "EW")
    assert north.acceleration[3] == pytest.approx(2 * 0.03) and north.scale_factor == 2
    assert (north.station, north.event, north.high_pass_frequency) == ("Here", "Now", 0.1)


def test_components_by_name_and_in_the_order_given(folder: Path) -> None:
    (record,) = load_catalogue(write(folder, row(component="UD; NS")))
    assert [a.component for a in open_record(record)] == ["UD", "NS"]
    (record,) = load_catalogue(write(folder, row(component="XX")))
    with pytest.raises(RecordError, match=r"one \(table.csv\): .*'XX', but the file holds NS, EW, UD"):
        open_record(record)


def test_the_vertical_can_be_named(folder: Path) -> None:
    (record,) = load_catalogue(write(folder, row(vertical_component="EW")))
    assert [a.component for a in open_record(record)] == ["NS"]
    from rocking.records import read

    assert vertical_of(read(folder / "table.csv"), record).component == "EW"


def test_all_defects_stand_in_one_message(folder: Path) -> None:
    bad = [
        row(id="a/b"), row(id="x" * 81), row(id="con"), row(id="same"), row(id="SAME"),
        row(id="..", scale_factor="1_0"),
        row(id="unit", unit="furlong"), row(id="step", time_step_s="0"), row(id="scale", scale_factor="0"),
        row(id="nan", high_pass_hz="nan"), row(id="sha", sha256="ABC"), row(id="out", file="../table.csv"),
        row(id="abs", file="/etc/passwd"), row(id="drive", file="c:\\x"), row(id="none", file=""),
        row(id="repo", source_repository="x", source_path="../y", source_commit="main"),
    ]  # fmt: skip
    with pytest.raises(CatalogueError) as caught:
        load_catalogue(write(folder, *bad))
    said = str(caught.value)
    for part in ("'a/b'", "x" * 81, "'con'", "'same' stands 2 times", "'1_0'", "'furlong'", "time_step_s is 0.0",
                 "scale_factor is 0", "'nan'", "'ABC'", "'../table.csv'", "'/etc/passwd'", "'c:", "file is missing",
                 "source_repository is 'x'", "source_path is '../y'", "source_commit is 'main'"):  # fmt: skip
        assert part in said


@pytest.mark.parametrize(("text", "message"), [
    ("", "column 'id' is missing"),
    ("id,file,sha256\n", "no rows"),
    ("id,file,sha256,colour\n1,2,3,4\n", "column 'colour' is not known"),
    ("id,id,file,sha256\n1,1,2,3\n", "column 'id' stands 2 times"),
    ("id,file\n1,2\n", "column 'sha256' is missing"),
    ("id,file,sha256\n1,2,3,4\n", "more cells"),
    ('id,file,sha256\n"1,2,3\n', "cannot be read"),
    (b"id,file,sha256\n\xff\xfe,2,3\n", "UTF-8"),
])  # fmt: skip
def test_files_that_are_no_catalogue(tmp_path: Path, text: str | bytes, message: str) -> None:
    path = tmp_path / "catalogue.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(CatalogueError, match=message):
        load_catalogue(path)


def test_a_missing_catalogue(tmp_path: Path) -> None:
    with pytest.raises(CatalogueError, match="cannot be read"):
        load_catalogue(tmp_path / "none.csv")


def test_the_hash_is_checked_before_use(folder: Path) -> None:
    (record,) = load_catalogue(write(folder, row()))
    (folder / "table.csv").write_text(TABLE.replace("1,", "2,", 1))
    with pytest.raises(RecordError, match=r"one: .*table\.csv has sha256 .* another version"):
        open_record(record)


def test_the_mirror_comes_first_and_links_may_not_leave_it(
    folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    mirror, outside = tmp_path_factory.mktemp("mirror"), tmp_path_factory.mktemp("outside")
    (record,) = load_catalogue(write(folder, row()))
    (mirror / "table.csv").write_bytes(TABLE.encode())
    assert fetch(record, mirror) == mirror / "table.csv"
    (mirror / "table.csv").unlink()
    assert fetch(record, mirror) == folder / "table.csv"
    (outside / "table.csv").write_bytes(TABLE.encode())
    os.symlink(outside / "table.csv", mirror / "table.csv")
    with pytest.raises(RecordError, match="leads out of"):
        fetch(record, mirror)


def test_a_file_that_is_nowhere(folder: Path) -> None:
    path = write(folder, row(file="lost.csv"))
    with pytest.raises(CatalogueError, match=r"one: file 'lost\.csv' is neither"):
        load_catalogue(path, mirror=folder)
    (record,) = load_catalogue(path)
    with pytest.raises(RecordError, match=r"one: file 'lost\.csv' is not in"):
        fetch(record)


def remote(folder: Path, **changes: str) -> CatalogueRecord:
    source = {"source_repository": "own/er", "source_path": "a b/t.csv", "source_commit": "0" * 40}
    (record,) = load_catalogue(write(folder, row(file="far.csv", **source, **changes)))
    return record


def test_remote_files_come_by_commit_and_hash(
    folder: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    pooch = pytest.importorskip("pooch")
    record = remote(folder)
    assert source_address(record) == f"https://raw.githubusercontent.com/own/er/{'0' * 40}/a%20b/t.csv"
    asked = []

    def served(text: str):
        def download(url: str, output: str, *_: object, **__: object) -> None:
            asked.append(url)
            Path(output).write_bytes(text.encode())

        return download

    monkeypatch.setattr(pooch.downloaders, "HTTPDownloader", lambda **_: served(TABLE))
    monkeypatch.setattr("pooch.core.choose_downloader", lambda *_, **__: served(TABLE))
    path = fetch(record, cache=tmp_path / "cache")
    assert path.read_text() == TABLE and asked == [source_address(record)]
    fetch(record, cache=tmp_path / "cache")
    assert len(asked) == 1


def test_a_remote_file_that_does_not_come(
    folder: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    pytest.importorskip("pooch")

    def fail(*_: object, **__: object) -> None:
        raise OSError("no network here")

    monkeypatch.setattr("pooch.core.choose_downloader", lambda *_, **__: fail)
    monkeypatch.setattr("time.sleep", lambda _: None)
    with pytest.raises(
        RecordError, match=r"one: file 'far\.csv' cannot be fetched from https.*no network here"
    ):
        fetch(remote(folder), cache=tmp_path / "cache")


def test_the_shipped_catalogue_opens_offline() -> None:
    records = load_catalogue(SHIPPED / "catalogue.csv")
    opened = {record.id: open_record(record) for record in records}
    assert sum(len(channels) for channels in opened.values()) == 7
    # A block of slenderness 0.2 lifts at 0.203 g: every record shipped makes it rock.
    assert min(a.peak_acceleration for channels in opened.values() for a in channels) > 0.21 * GRAVITY
    scaled = {record.id for record in records if record.scale_factor != 1}
    assert scaled == {"AKT013_1996_scaled", "STNA_2002_scaled"}
    assert all("multiplied by" in record.note for record in records if record.id in scaled)


@pytest.mark.real_records
def test_the_near_fault_catalogue_opens_from_the_mirror(
    real_records: Path, manifest: list[dict[str, str]]
) -> None:
    records = load_catalogue(SHIPPED / "near_fault.csv", mirror=real_records)
    listed = {row["file"]: row for row in manifest}
    assert len(records) >= 50 and all(record.is_remote for record in records)
    for record in records:
        (channel,) = open_record(record, real_records)
        stated = float(listed[record.file]["pga_g"]) * GRAVITY
        assert not channel.vertical and abs(channel.peak_acceleration / stated - 1) < 0.005
    wanted = {
        r["file"]
        for r in manifest
        if r["role"] in ("pulse", "non-pulse") and r["component"].strip("-") != "UP"
    }
    assert {record.file for record in records} == {file for file in wanted if not file.endswith("VT2")}


def test_a_catalogue_from_a_folder(folder: Path) -> None:
    (folder / "sub").mkdir()
    (folder / "sub" / "table.csv").write_bytes(TABLE.encode())
    (folder / "plain.txt").write_text("\n".join(f"{np.sin(i):.5f}" for i in range(30)))
    (folder / "notes.md").write_text("once upon a time")
    (folder / "broken.AT2").write_text("X\nY\nACCELERATION IN UNITS OF G\nNPTS= 9, DT= .01\n 1 2\n")
    rows, unread = catalogue_from_folder(folder, unit="g", time_step=0.02)
    assert [r["id"] for r in rows] == ["plain", "table", "table_2"]
    assert {file for file, _ in unread} == {"notes.md", "broken.AT2"}
    declared = {r["file"]: (r.get("unit", ""), r.get("time_step_s", "")) for r in rows}
    assert declared == {"plain.txt": ("g", "0.02"), "table.csv": ("", ""), "sub/table.csv": ("", "")}
    (folder / "catalogue.csv").write_text(write_catalogue_rows(rows), encoding="utf-8")
    assert [len(open_record(record)) for record in load_catalogue(folder / "catalogue.csv")] == [1, 2, 2]
    assert catalogue_from_folder(folder, unit="g", time_step=0.02) == (rows, unread)  # not its own catalogue
    with pytest.raises(RecordError, match="no folder"):
        catalogue_from_folder(folder / "none")


def test_a_file_name_that_a_catalogue_would_refuse_is_named_as_unread(tmp_path):
    (tmp_path / "a:b.txt").write_text("\n".join(f"{i * 0.01:.2f} {i % 7}" for i in range(100)))
    rows, unread = catalogue_from_folder(tmp_path, unit="m/s2")
    assert rows == []
    assert [name for name, _ in unread] == ["a:b.txt"]
    assert "rename" in unread[0][1]
