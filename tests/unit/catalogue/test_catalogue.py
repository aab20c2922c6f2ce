"""The catalogue: every defect in one message, files found and checked, components chosen."""

import contextlib
import dataclasses
import hashlib
import http.server
import itertools
import os
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

import rocking
from rocking import Arch, extract_pulses, integrate, predict_maximum
from rocking.catalogue import CatalogueRecord, files, load_catalogue, open_station
from rocking.catalogue.catalogue import catalogue_text, repeated
from rocking.catalogue.files import download, path_of, with_hashes
from rocking.catalogue.listing import listing_text
from rocking.described import described_values
from rocking.earthquakes.sample import earthquakes_of, stations_of
from rocking.errors import CatalogueError, RecordError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.folders import list_folder
from tests.refusals import refused

ROWS = (f"{i / 100},{i % 5},{i % 7},{i % 3}\n" for i in range(50))
TABLE = "time,NS (gal),EW (gal),UD (gal)\n" + "".join(ROWS)
SHA = hashlib.sha256(TABLE.encode()).hexdigest()
SHIPPED = Path(__file__).parents[3] / "records"


def catalogue_from_folder(folder, **declared):
    """Rows of the files that can be used, and (file, reason) of the others."""
    listed, rows = list_folder(folder, **declared)
    return rows, [(file.file, file.refusal) for file in listed if file.refusal]


def fetch(record, mirror=None):
    """Where the one file of a record lies."""
    return path_of(record, *record.files, mirror)


def write(folder: Path, *rows: dict[str, str]) -> Path:
    path = folder / "catalogue.csv"
    path.write_text(catalogue_text(rows), encoding="utf-8")
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "table.csv").write_bytes(TABLE.encode())
    return tmp_path


def row(**changes: str) -> dict[str, str]:
    return {"id": "one", "file": "table.csv", "sha256": SHA, **changes}


def test_horizontal_components_scaled_and_named(folder: Path) -> None:
    earthquake = {"magnitude": "6.7", "epicentral_distance_km": "0", "event": "Now"}
    path = write(folder, row(scale_factor="2", station="Here", high_pass_hz="0.1", **earthquake))
    (record,) = load_catalogue(path)
    north, east = open_station(record).horizontal
    assert (north.magnitude, north.epicentral_distance) == (6.7, 0.0)
    assert (north.component, east.component) == ("NS", "EW")
    assert north.acceleration[3] == pytest.approx(2 * 0.03) and north.scale_factor == 2
    assert (north.station, north.event, north.high_pass_frequency) == ("Here", "Now", 0.1)


def test_components_by_name_and_in_the_order_given(folder: Path) -> None:
    (record,) = load_catalogue(write(folder, row(component="UD; NS")))
    vertical, horizontal = open_station(record).horizontal
    assert (vertical.component, horizontal.component) == ("UD", "NS") and not horizontal.warnings
    assert vertical.warnings[-1] == RockingWarning(RecordKind.VERTICAL_AS_HORIZONTAL, "UD")
    for cells, field, value in (
        ({"component": "XX"}, "component", "XX"),
        ({"file": "obspy:none.AT2", "sha256": ""}, "file", "none.AT2"),
    ):
        (record,) = load_catalogue(write(folder, row(**cells)))
        with refused(RecordError, field, value):
            open_station(record)


def test_all_defects_stand_in_one_message(folder: Path) -> None:
    bad = [
        row(id="a/b"), row(id="x" * 81), row(id="con"), row(id="same"), row(id="SAME"),
        row(id="..", scale_factor="1_0"),
        row(id="unit", unit="furlong"), row(id="step", time_step_s="0"), row(id="scale", scale_factor="0"),
        row(id="quake", magnitude="11"), row(id="far", epicentral_distance_km="-3"), row(id="big", magnitude="big"),
        row(id="nan", high_pass_hz="nan"), row(id="sha", sha256="ABC"), row(id="out", file="../table.csv"),
        row(id="abs", file="/etc/passwd"), row(id="drive", file="c:\\x"), row(id="none", file=""),
        row(id="repo", source_repository="x", source_path="../y", source_commit="main"),
        row(id="hashes", file="a.csv;b.csv"), row(id="fetched", source_repository="a/b", sha256=""),
        row(id="paths", file="a.csv;b.csv", source_repository="../..", source_path="z"),
        row(id="twice", scale_factor="2", scale_to="pga 0.3 g"), row(id="leads", inventory="../x.xml"),
    ]  # fmt: skip
    with pytest.raises(CatalogueError) as caught:
        load_catalogue(write(folder, *bad))
    said = str(caught.value)
    for part in ("'a/b'", "x" * 81, "'con'", "'same' occurs 2 times", "'1_0'", "'furlong'", "time_step_s is 0.0 s",
                 "scale_factor is 0", "'nan'", "'ABC'", "'../table.csv'", "'/etc/passwd'", "'c:", "file is missing",
                 "source_repository is 'x'", "source_path is '../y'", "source_commit is 'main'", "magnitude is 11",
                 "epicentral_distance_km is -3", "magnitude is 'big'", "sha256 holds 1 hashes for 2 files",
                 "sha256 is missing; a file that is fetched", "source_repository is '../..'", "source_path is 'z'",
                 "scale_factor is 2 together with scale_to 'pga 0.3 g'", "inventory is '../x.xml'",
                 ):  # fmt: skip
        assert part in said


def test_a_thousand_defects_are_counted_and_forty_told(folder: Path) -> None:
    with refused(CatalogueError, "catalogue") as caught:
        load_catalogue(write(folder, *(row(id=f"bad id {number}") for number in range(1000))))
    assert str(caught.value).count(" | ") == 40


@pytest.mark.parametrize(("text", "field"), [
    ("", "columns"),
    ("id,file,sha256\n", "catalogue"),
    ("id,file,sha256,colour\n1,2,3,4\n", "columns"),
    ("id,id,file,sha256\n1,1,2,3\n", "columns"),
    ("id,sha256\n1,2\n", "columns"),
    ("id,file,sha256\n1,2,3,4\n", "columns"),
    ('id,file,sha256\n"1,2,3\n', "file"),
    (b"id,file,sha256\n\xff\xfe,2,3\n", "file"),
])  # fmt: skip
def test_files_that_are_no_catalogue(tmp_path: Path, text: str | bytes, field: str) -> None:
    path = tmp_path / "catalogue.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with refused(CatalogueError, field):
        load_catalogue(path)


def test_the_mirror_comes_first_and_links_may_not_leave_it(folder: Path, tmp_path_factory) -> None:
    mirror, outside = (tmp_path_factory.mktemp(name) for name in ("mirror", "outside"))
    (record,) = load_catalogue(write(folder, row()))
    (mirror / "table.csv").write_bytes(TABLE.encode())
    assert fetch(record, mirror) == mirror / "table.csv"
    (mirror / "table.csv").unlink()
    assert fetch(record, mirror) == folder / "table.csv"
    (outside / "table.csv").write_bytes(TABLE.encode())
    os.symlink(outside / "table.csv", mirror / "table.csv")
    with refused(RecordError, "file", "table.csv"):
        fetch(record, mirror)
    (record,) = load_catalogue(write(folder, row(file="lost.csv")))
    with refused(RecordError, "file", "lost.csv"):
        fetch(record)


def remote(folder: Path, **changes: str) -> CatalogueRecord:
    source = {"source_repository": "own/er", "source_path": "a b/t.csv", "source_commit": "0" * 40}
    (record,) = load_catalogue(write(folder, row(file="far.csv", **source, **changes)))
    return record


class _Answer(http.server.BaseHTTPRequestHandler):
    """Serves what `served` yields, and counts the questions."""

    served = staticmethod(lambda: iter([TABLE.encode()]))
    asked: ClassVar[list[str]] = []

    def do_GET(self) -> None:
        self.asked.append(self.path)
        self.send_response(200)
        self.end_headers()
        with contextlib.suppress(OSError):
            for piece in self.served():
                self.wfile.write(piece)

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@pytest.fixture
def answer(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[type[_Answer]]:
    """A server of this machine in the place of the one that records come from."""
    pytest.importorskip("pooch")
    monkeypatch.setattr(_Answer, "asked", [])
    monkeypatch.setenv("no_proxy", "127.0.0.1")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr("time.sleep", lambda _: None)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), _Answer) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}"
        monkeypatch.setattr(files, "_RAW", f"{address}/{{repository}}/{{commit}}/{{path}}")
        yield _Answer
        server.shutdown()


def test_remote_files_come_by_commit_and_hash(folder: Path, tmp_path: Path, answer: type[_Answer]) -> None:
    record = remote(folder)
    path = fetch(record)
    assert path.read_text() == TABLE and answer.asked == [f"/own/er/{'0' * 40}/a%20b/t.csv"]
    fetch(record)
    assert len(answer.asked) == 1
    unchecked = download("t.csv", "own/er", "0" * 40, "a b/t.csv")
    assert unchecked != path and unchecked.read_text() == TABLE
    with refused(RecordError, "file", "far.csv"):
        fetch(dataclasses.replace(record, sha256="0" * 64))


def test_a_download_ends_at_a_size_and_after_a_time(folder, tmp_path: Path, answer, monkeypatch) -> None:
    monkeypatch.setattr(answer, "served", staticmethod(lambda: itertools.repeat(b"0" * 2**20)))
    with refused(RecordError, "file", "far.csv"):
        fetch(remote(folder))
    assert not [path for path in (tmp_path / "cache").rglob("*") if path.is_file()]
    monkeypatch.setattr(files, "LONGEST_DOWNLOAD", 0.2)
    pause = threading.Event()
    monkeypatch.setattr(answer, "served", lambda _: (pause.wait(0.05) or b"0" for _ in range(1000)))
    with refused(RecordError, "file", "far.csv"):
        fetch(remote(folder))


def test_the_shipped_catalogue_opens_offline() -> None:
    records = load_catalogue(SHIPPED / "catalogue.csv")
    opened = {record.id: open_station(record).horizontal for record in records}
    assert sum(len(channels) for channels in opened.values()) == 7
    # A block of slenderness 0.2 lifts at 0.203 g: every record shipped makes it rock.
    assert min(a.peak_acceleration for channels in opened.values() for a in channels) > 0.21 * GRAVITY
    assert all(record.licence for record in records)
    assert {record.id: record.scale_factor for record in records if record.scale_factor != 1} == {
        "synthetic_strong_pulse": 0.85
    }


def test_the_shipped_records_make_the_arches_rock_as_their_readme_says() -> None:
    """Closed form and integration under Loma Prieta agree, and the scaled pulse knocks over none of Fig. 8."""
    records = {
        one_record.id: open_station(one_record).horizontal
        for one_record in load_catalogue(SHIPPED / "catalogue.csv")
    }
    (along,) = (record for record in records["APEEL_1989"] if record.component == "43")
    pulse = extract_pulses(along).dominant
    for radius, (closed, integrated) in {
        10: (0.76, 0.62),
        12: (0.51, 0.48),
        15: (0.36, 0.36),
        20: (0.25, 0.25),
    }.items():
        arch = Arch(radius, 0.105 * radius, np.radians(157.5), restitution=0.9)
        block = arch.mechanism().equivalent_block()
        # as the README prints them
        assert predict_maximum(block, pulse).rotation_ratio == pytest.approx(closed, abs=0.006)
        assert integrate(arch, along).rotation_ratio == pytest.approx(integrated, abs=0.006)
    (weakened,) = records["synthetic_strong_pulse"]
    for radius in (10, 15):
        arch = Arch(radius, 0.15 * radius, np.radians(157.5), restitution=0.9)
        assert 0.2 < integrate(arch, weakened).rotation_ratio < 0.8


@pytest.mark.real_records
def test_the_near_fault_catalogue_opens_from_the_mirror(real_records: Path, manifest) -> None:
    records = load_catalogue(SHIPPED / "near_fault.csv")
    listed = {row["file"]: row for row in manifest}
    assert len(records) >= 50 and all(record.is_remote for record in records)
    for record in records:
        (channel,) = open_station(record, real_records).horizontal
        stated = float(listed[record.file]["pga_g"]) * GRAVITY
        assert not channel.vertical and abs(channel.peak_acceleration / stated - 1) < 0.005
    rows = (row for row in manifest if row["role"] in ("pulse", "non-pulse") and "UP" not in row["component"])
    wanted = {row["file"] for row in rows if not row["file"].endswith("VT2")}
    assert {record.file for record in records} == wanted


def test_a_catalogue_from_a_folder(folder: Path) -> None:
    (folder / "sub").mkdir()
    named(folder / "sub", "table.csv")
    named(folder, "plain.txt", "\n".join(f"{np.sin(i):.5f}" for i in range(30)))
    (folder / "notes.md").write_text("once upon a time")
    (folder / "broken.AT2").write_text("X\nY\nACCELERATION IN UNITS OF G\nNPTS= 9, DT= .01\n 1 2\n")
    rows, unread = catalogue_from_folder(folder, unit="g", time_step=0.02)
    assert [r["id"] for r in rows] == ["plain", "table", "table_2"]
    assert {file for file, _ in unread} == {"notes.md", "broken.AT2"}
    declared = {r["file"]: (r.get("unit", ""), r.get("time_step_s", "")) for r in rows}
    assert declared == {"plain.txt": ("g", "0.02"), "table.csv": ("", ""), "sub/table.csv": ("", "")}
    assert [len(open_station(record).horizontal) for record in load_catalogue(write(folder, *rows))] == [
        1,
        2,
        2,
    ]
    assert catalogue_from_folder(folder, unit="g", time_step=0.02) == (rows, unread)  # not its own catalogue
    with refused(RecordError, "folder"):
        catalogue_from_folder(folder / "none")


def named(folder: Path, name: str | bytes, text: str = TABLE) -> None:
    with open(os.path.join(os.fsencode(folder), os.fsencode(name)), "wb") as stream:
        stream.write(text.encode("latin-1"))


@pytest.mark.parametrize(
    "name",
    ["a:b.txt", " a.csv", "a.csv ", b"\xff\xfe.csv", "two\nlines.csv", "cr\rcell.csv", "semi;colon.csv"],
)
def test_a_name_that_a_catalogue_would_refuse_is_unread(tmp_path: Path, name: str | bytes) -> None:
    named(tmp_path, name)
    named(tmp_path, "good.csv")
    rows, unread = catalogue_from_folder(tmp_path)
    assert [row["file"] for row in rows] == ["good.csv"] and len(unread) == 1
    assert "rename" in unread[0][1] and unread[0][0].isprintable()
    unread[0][0].encode("utf-8")


def test_ids_that_a_catalogue_writes_are_ids_that_it_loads(tmp_path: Path) -> None:
    odd = ["<&>{x}.csv", "=cmd.csv", "@x.csv", "-y.csv", "x..at2", "con.csv", "summary.csv", "...csv", "dots....csv",
           "Übung #1.csv", "a" * 200 + ".csv", "x.csv.gz.txt", "'quoted\".csv", "semi_colon,comma.csv"]  # fmt: skip
    for name in odd:
        named(tmp_path, name)
    (tmp_path / "sub").mkdir()
    named(tmp_path / "sub", "CON.csv")
    rows, unread = catalogue_from_folder(tmp_path)
    assert [name for name, _ in unread] == [] and len(rows) == len([n for n in odd if n[0] != "."]) + 1
    assert all(len(open_station(record).horizontal) == 2 for record in load_catalogue(write(tmp_path, *rows)))
    assert not any(row["file"][0] in "=+-@" for row in rows)


def test_control_characters_of_a_header_stay_in_the_file(tmp_path: Path) -> None:
    head = "PEER NGA RECORD\nQu\0ake\x1b[2J, 1/2/99, =HYPERLINK(1)\x07, 0\x0045\n"
    named(tmp_path, "odd.AT2", f"{head}ACCELERATION IN UNITS OF G\nNPTS= 3, DT= .01 SEC\n .1 .2 .3\n")
    (row,), _ = catalogue_from_folder(tmp_path)
    assert all(cell.isprintable() for cell in row.values()) and row["station"] == "HYPERLINK(1)"
    (record,) = load_catalogue(write(tmp_path, row))
    (channel,) = open_station(record).horizontal
    assert all(text.isprintable() for text in (channel.component, channel.station, channel.event))


def test_a_huge_file_is_refused_before_it_is_read(tmp_path: Path) -> None:
    for name in ("huge.csv", "huge.AT2"):
        with (tmp_path / name).open("wb") as stream:
            stream.truncate(2**40)  # a terabyte of nothing
    rows, unread = catalogue_from_folder(tmp_path)
    assert rows == [] and all("larger than" in reason for _, reason in unread) and len(unread) == 2
    with refused(CatalogueError, "size"):
        load_catalogue(tmp_path / "huge.csv")


def test_every_file_is_listed_with_what_it_is(folder: Path) -> None:
    bare = "\n".join(f"{0.3 * np.sin(i):.5f}" for i in range(300))
    named(folder, "bare.txt", bare)
    named(folder, "loud.csv", "time,HHN (g)\n" + "".join(f"{i / 100},{3.5 * (i % 2)}\n" for i in range(200)))
    up = "".join(f"{i / 100},{np.sin(i):.3f}\n" for i in range(200))
    named(folder, "quake-UP.csv", f"time,a (g)\n{up}")
    both = "".join(f"{i / 100},{i % 2},{4 * (i % 2)}\n" for i in range(99))
    named(folder, "mixed.csv", f"time,NS (g),EW (g)\n{both}")
    named(folder, "tale.txt", "once upon a time\n")
    (folder / "link.AT2").symlink_to(Path(rocking.__file__).parents[1] / "records/synthetic_strong_pulse.AT2")
    listed = {found.file: found for found in list_folder(folder)[0]}
    assert listed["link.AT2"].refusal == "it is a link that leads out of the folder; copy the file instead."
    table = listed["table.csv"]
    assert [channel.component for channel in table.channels] == ["NS", "EW", "UD"]
    assert [channel.samples for channel in table.channels] == [50, 50, 50]
    # 0, 1, 2, 3, 4 gal again and again have a mean of 2: by the trapezoidal rule 2 cm/s² for 0.49 s
    assert table.channels[0].time_step == 0.01 and table.channels[0].peak_acceleration == "0.00408"
    assert float(table.channels[0].peak_velocity) == pytest.approx(0.0098, rel=0.03)
    assert listed["bare.txt"].record == "bare" and listed["bare.txt"].blanks == ("unit", "time_step_s")
    notes = {row["id"]: row["note"] for row in list_folder(folder)[1]}
    assert notes["bare"] == "columns of numbers. Fill in unit and time_step_s."
    kinds = {name: [warning.kind for warning in file.warnings] for name, file in listed.items()}
    assert {RecordKind.CHANNEL_OF_VELOCITY, RecordKind.PEAK_RARE} <= set(kinds["loud.csv"])
    assert not kinds["table.csv"]
    (rare,) = (
        one_warning
        for one_warning in listed["mixed.csv"].warnings
        if one_warning.kind is RecordKind.PEAK_RARE
    )
    assert rare.about == "EW" and rare["peak_g"] == pytest.approx(4.0)
    assert RockingWarning.of(RecordKind.VERTICAL_BY_NAME, word="UP") in listed["quake-UP.csv"].warnings
    assert listed["tale.txt"].refusal.startswith("no reader recognises")


def test_the_table_of_a_folder_never_wraps_and_refusals_stand_below_it(folder: Path) -> None:
    long = "a_name_of_a_station_that_is_much_too_long_for_any_line_of_any_terminal"
    named(folder, f"{long}.csv")
    named(folder, "bare.txt", "\n".join(f"{0.3 * np.sin(i):.5f}" for i in range(300)))
    named(folder, "tale.txt", "once upon a time\n")
    for width in (72, 80, 120):
        text = listing_text(list_folder(folder)[0], width)
        table, fill, warnings, refused = text.split("\n\n")
        lines = table.splitlines()
        assert len(lines) == 1 + 3 + 1 + 3 and max(map(len, lines)) <= width and "0.00408" in table
        assert "tale.txt" not in table and refused.startswith("Not read:\n  tale.txt: no reader recognises")
        assert (
            fill
            == "Answer once, in layouts.csv:\n  bare.txt: one series in ?, 1 a line; 300 rows; 1 file with peaks 0.3"
        )
        assert warnings.startswith("To know:\n  table.csv: Its content is that of a_name")


def test_a_file_under_two_names_is_told_where_it_comes_again(folder: Path) -> None:
    named(folder, "again.csv")
    listed, rows = list_folder(folder)
    assert [file.file for file in listed if file.warnings] == ["table.csv"]
    assert listed[1].warnings == (RockingWarning.of(RecordKind.CONTENT_REPEATED, original="again.csv"),)
    assert ["again.csv" in row["note"] for row in rows] == [False, True]


def test_rows_that_are_one_motion_are_told() -> None:
    """Again under another name it is; another component, factor or content of the same name it is not."""

    def told(**cells: Any) -> tuple[RockingWarning, ...]:
        first = CatalogueRecord("one", "a.csv", SHA, component="NS;EW")
        return repeated([first, dataclasses.replace(first, **({"id": "two", "file": "b.csv"} | cells))])

    again = RockingWarning.of(
        RecordKind.RECORD_REPEATED, "two", file="b.csv", other="one", other_file="a.csv"
    )
    assert told() == (again,)
    assert len(told(component="")) == len(told(component="UD;EW")) == 1
    for other in ({"component": "UD"}, {"scale_factor": 2.0}, {"sha256": "1" * 64}, {"sha256": ""}):
        assert told(**other) == ()
    for name in ("catalogue.csv", "near_fault.csv", "fema_p695.csv"):
        assert repeated(load_catalogue(SHIPPED / name)) == ()


def test_a_row_added_by_hand_needs_no_hash_until_it_is_read(folder: Path) -> None:
    (folder / "up.csv").write_bytes(TABLE.encode())
    path = folder / "mine.csv"
    path.write_text('id,file,note\nold,table.csv,"a, b"\nnew,table.csv; up.csv,x\nlost,none.csv,\n')
    assert len(open_station(load_catalogue(path)[0]).horizontal) == 2
    records = {record.id: with_hashes(record) for record in load_catalogue(path)}
    assert records["old"].sha256 == SHA and records["new"].sha256 == f"{SHA};{SHA}"
    assert records["lost"].sha256 == ""
    (folder / "table.csv").write_text(TABLE.replace("1,", "2,", 1))
    with refused(RecordError, "sha256"):
        open_station(records["old"])


def test_the_readme_of_the_records_describes_every_column() -> None:
    text = (SHIPPED / "README.md").read_text(encoding="utf-8")
    described = [
        f"| `{value.key}` | {value.meaning} |" for value in described_values(CatalogueRecord).values()
    ]
    assert [line for line in text.splitlines() if line.startswith("| `")] == described


def test_no_motion_of_the_lists_of_the_research_is_of_two_sites() -> None:
    """One file in two catalogues is one earthquake and one station, whatever its header calls them."""
    rows = [
        record for name in ("near_fault.csv", "fema_p695.csv") for record in load_catalogue(SHIPPED / name)
    ]
    named = [Accelerogram(np.zeros(2), 0.01, station=row.station, event=row.event) for row in rows]
    earthquakes = earthquakes_of(named)
    stations = stations_of(named, earthquakes)
    sites: dict[str, set[tuple[str, str]]] = {}
    for row, earthquake, station in zip(rows, earthquakes, stations, strict=True):
        sites.setdefault(row.sha256, set()).add((earthquake, station))
    assert {name: own for name, own in sites.items() if len(own) > 1} == {}


@pytest.mark.parametrize(
    ("event", "found"),
    [("", "1994-01-17T12:31"), ("Northridge 1994-01-16", "1994-01-17T12:31"), ("EQ 6/28/92", "1992-06-28")],
)
def test_a_day_of_the_row_overrides_that_of_the_file(folder: Path, event: str, found: str) -> None:
    """One day apart is another zone."""
    values = "\n".join(" ".join(["0.01"] * 5) for _ in range(200))
    head = "PEER STRONG MOTION DATABASE RECORD\nNORTHRIDGE 1/17/94 12:31, HERE, 009\n"
    (folder / "a.AT2").write_text(f"{head}ACCELERATION IN UNITS OF G\nNPTS= 1000, DT= .01 SEC\n{values}\n")
    (record,) = load_catalogue(write(folder, {"id": "one", "file": "a.AT2", "event": event}))
    assert [channel.event_time for channel in open_station(record).horizontal] == [found]
