"""What goes wrong: broken records, bad input, and a folder that cannot be written."""

import csv
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from rocking.assessment.rows import FailureRow
from rocking.products.fragility.rows import FragilitySummaryRow
from rocking.products.trade.rows import TradeRow
from rocking.study.kept import kept_in
from rocking.study.outputs import kept_of
from rocking.tables import read_table

HEAD = "MADE FOR A TEST\nNowhere, 1/1/2000, A, H1\nACCELERATION TIME SERIES IN UNITS OF G\n"


def _at2(line: str, values: str) -> bytes:
    return f"{HEAD}{line}\n{values}\n".encode()


GOOD_VALUES = "0.01 -0.02 0.03 -0.01 0.0 " * 20
GOOD = _at2("NPTS=   100, DT= 0.01 SEC", GOOD_VALUES)
BROKEN = {
    "unknown_format": ({"content": b"Dear colleague,\nhere is the record you asked for.\n"}, "format"),
    "empty_file": ({"content": b""}, "empty"),
    "cut_off": ({"content": _at2("NPTS=   200, DT= 0.01 SEC", GOOD_VALUES)}, "200"),
    "not_a_number": ({"content": _at2("NPTS=   100, DT= 0.01 SEC", "NaN " + GOOD_VALUES[5:])}, "NaN"),
    "time_stands_still": ({"content": _at2("NPTS=   100, DT= 0.00 SEC", GOOD_VALUES)}, "time_step is 0"),
    "no_unit": ({"content": b"0.00 0.1\n0.01 0.2\n0.02 -0.1\n0.03 0.1\n", "unit": ""}, "unit"),
    "another_version": ({"content": GOOD, "sha256": "0" * 64}, "sha256"),
    "lost_file": ({"content": b"", "file": "nobody_has_it.AT2"}, "nobody_has_it"),
    "no_such_component": ({"content": GOOD, "component": "X;Y"}, "component"),
    "pickle": (
        {"content": b"\x80\x04\x95\x1b\x00\x00\x00obspy.core.stream\x94\x8c\x06Stream"},
        "no reader recognises",
    ),
}


@pytest.fixture(scope="module")
def with_broken(start, tmp_path_factory: pytest.TempPathFactory):
    """The study of three good records and ten broken ones, after its run."""
    study = start.copy_to(tmp_path_factory.mktemp("broken") / "study")
    for name, (cells, _) in BROKEN.items():
        study.add(name, **cells)
    study.run(status=1)
    return study


def test_each_broken_record_is_one_row_that_says_why(with_broken) -> None:
    with (with_broken.results / "summary" / "failures.csv").open(newline="") as stream:
        rows = {row["record"]: row for row in csv.DictReader(stream)}
    assert set(rows) == set(BROKEN)
    for name, (_, word) in BROKEN.items():
        message = rows[name]["message"]
        assert rows[name]["stage"] == "read"
        assert word.lower() in message.lower() and "Traceback" not in message and "\n" not in message, message


def test_broken_records_change_no_byte_of_the_good_ones(with_broken, finished) -> None:
    for name in ("good_1", "good_2", "good_3"):
        expected = finished.rows_of(name)
        assert expected["pulses.csv"] and expected["comparison.csv"]
        assert with_broken.rows_of(name) == expected


@pytest.mark.slow
def test_a_fault_in_the_trade_or_the_fragility_stops_nothing_and_is_kept_as_a_row(start, tmp_path) -> None:
    """Planted in a copy of the package: under one record in the trade, and of one structure in the fragility."""
    tree = shutil.copytree(start.tree, tmp_path / "tree")
    for file, before, planted in (
        (
            "products/trade/measure.py",
            "    case = case.held_against(motions)\n",
            "[0 for record in motions.horizontal.values() if 'good_1' in record.source.path and record.dt_min]",
        ),
        (
            "fragility/curves.py",
            "    check_name(intensity_measure)\n",
            "structure.hinge_height is None and 1 // 0",
        ),
    ):
        path = tree / "rocking" / file
        source = path.read_text()
        assert source.count(before) == 1
        path.write_text(source.replace(before, f"    {planted}\n{before}"))
    study = replace(start.copy_to(tmp_path / "study"), tree=tree)
    study.run("trade", "fragility", "--config", "fragility={members: false}")
    rows = {
        name: kept_in(kept_of(study.results, name), [FailureRow]).rows[FailureRow]
        for name in ("trade", "fragility")
    }
    told = {(name, row.record, row.structure): row.message for name in rows for row in rows[name]}
    assert set(told) == {
        ("trade", "good_1", "block"),
        ("trade", "good_1", "wall"),
        ("fragility", "", "block"),
    }
    for (name, *_), message in told.items():
        assert message.startswith("a fault of rocking") and f"results/summary/logs/{name}.log" in message
        assert "Traceback" in (study.results / "summary" / "logs" / f"{name}.log").read_text()
    (trade,) = {
        row.cases for row in read_table(TradeRow, study.results / "summary") if row.structure == "wall"
    }
    assert trade == 2, "records"
    curves = read_table(FragilitySummaryRow, study.results / "fragility")
    assert {row.structure for row in curves} == {"wall"}


def test_bad_input_is_refused_at_once_before_anything_is_written(start, tmp_path: Path) -> None:
    study = start.copy_to(tmp_path / "study")
    rows = study.rows()
    study.write_catalogue([*rows, rows[0], rows[1] | {"id": "../outside"}, rows[2] | {"id": "a/b"}])
    structures = study.folder / "structures.yaml"
    structures.write_text(structures.read_text().replace("thickness_m", "thicknes_m"))
    with (study.folder / "config.yaml").open("a") as stream:
        stream.write("tollerance: 1.0e-5\n")
    told = study.run(status=1)
    for named in ("good_1", "../outside", "a/b", "thicknes_m", "thickness_m", "tollerance"):
        assert named in told, f"{named} is not named in\n{told}"
    assert not study.results.exists()
    assert not (tmp_path / "outside").exists()


@contextmanager
def _small_disk(folder: Path) -> Iterator[list[str]]:
    """Mount a disk of 24 kB in memory on a folder; what is handed back is the command that enlarges it."""
    mount = ["mount", "-t", "tmpfs", "-o", "size=24k", "tmpfs", str(folder)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("a disk can only be mounted by root")
    try:
        yield ["mount", "-o", "remount,size=50m", str(folder)]
    finally:
        subprocess.run(["umount", str(folder)], check=True, capture_output=True)


def test_a_full_disk_is_said_and_leaves_nothing_half_written(finished, start, tmp_path) -> None:
    study = start.copy_to(tmp_path / "study")
    study.write_catalogue(study.rows()[:1])
    study.results.mkdir()
    with _small_disk(study.results) as enlarge:
        assert "No space left on device" in study.run(status=1)
        assert not study.unfinished()
        expected = finished.rows_of("good_1")
        subprocess.run(enlarge, check=True, capture_output=True)
        study.run()
        assert study.rows_of("good_1") == expected
        assert (study.results / "summary" / "record.csv").read_text().count("\n") == 2, "head and one record"


@pytest.mark.slow
def test_a_limit_on_the_size_of_files_is_said_and_harms_nothing(finished, start, tmp_path) -> None:
    """Of 6 kB, in blocks of 512 bytes: a job writes more than that into one table."""
    study = start.copy_to(tmp_path / "study")
    limit = ("sh", "-c", 'ulimit -f 12; exec "$@"', "sh")
    done = study.rocking("run", str(study.folder), before=limit, status=1)
    assert "File too large" in done.stdout + done.stderr
    assert not study.unfinished()
    study.rocking("run", str(study.folder))
    assert study.tables() == finished.tables()
