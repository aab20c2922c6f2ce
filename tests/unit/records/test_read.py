"""Reading: the front door, what it refuses, and the plain columns."""

import contextlib
import gzip
import hashlib
import pickle
import subprocess
import sys
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rocking.errors import RecordError, UnknownFormatError
from rocking.records import read
from rocking.records.formats import FORMATS, Options
from rocking.records.kinds import RecordKind
from rocking.records.read import LARGEST_FILE, read_content
from tests.refusals import refused


def at2(values: list[str], npts: int | None = None, dt: str = ".0100", unit: str = "UNITS OF G") -> str:
    head = f"PEER NGA STRONG MOTION DATABASE RECORD\nQuake, 1/2/1999, Station, 45\nACCELERATION TIME SERIES IN {unit}\n"
    return f"{head}NPTS= {len(values) if npts is None else npts}, DT= {dt} SEC\n" + " ".join(values) + "\n"


def written(tmp_path: Path, text: str | bytes, name: str = "record.AT2") -> Path:
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_a_record_knows_its_file_and_gzip_is_unpacked(tmp_path: Path) -> None:
    plain = written(tmp_path, at2(["0.1", "-.2E+00", "3e-1"]))
    packed = written(tmp_path, gzip.compress(plain.read_bytes(), mtime=0), "record.AT2.gz")
    for path in (plain, packed):
        (record,) = read(path)
        assert np.allclose(record.acceleration, np.array([0.1, -0.2, 0.3]) * 9.80665, rtol=1e-15)
        assert (record.source.path, record.source.format, record.source.unit) == (str(path), "PEER AT2", "g")
        assert record.source.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.parametrize(("content", "named"), [
    (b"", ("size", 0)),
    (b"\n \r\n", ("size", 0)),
    (at2(["0.1"] * 30, npts=3), ("samples", 3)),
    (at2(["0.1", "nan"]), ("samples", 'nan')),
    (at2(["0.1", "1.2.3"]), ("samples", '1.2.3')),
    (at2(["0.1", "1e999"]), ("samples",)),
    (at2(["0.1", "0.2"], dt="0.0"), ("time_step", 0.0)),
    (at2(["0.1", "0.2"], dt="1.0.1"), ("DT", '1.0.1')),
    (at2(["0.1", "0.2"], unit="UNKNOWN"), ("unit",)),
    (at2(["100", "818"]), ("peak", 'peak acceleration is 818 g')),
    (at2(["0.1"]), ("samples", 1)),
])  # fmt: skip
def test_bad_files_get_one_sentence_that_names_them(tmp_path: Path, content, named: tuple) -> None:
    with refused(RecordError, *named) as caught:
        read(written(tmp_path, content))
    assert str(caught.value).startswith("record.AT2: ") and str(caught.value).count("record.AT2") == 1
    assert "\n" not in str(caught.value)


def test_an_unknown_file_is_told_what_was_looked_for(tmp_path: Path) -> None:
    with pytest.raises(UnknownFormatError) as caught:
        read(written(tmp_path, "once upon a time\nthere was a record", "tale.txt"))
    assert len(str(caught.value)) <= 300 and "'once upon a time'" in str(caught.value)
    with pytest.raises(UnknownFormatError) as long:
        read(written(tmp_path, "x" * 900 + "\n", "n" * 250))
    assert len(str(long.value)) <= 300
    assert caught.value.details == tuple(f"{form.name}: no {form.signature}" for form in FORMATS)


class _Trap:
    """Unpickling this appends to the path of modules."""

    def __reduce__(self):
        return (sys.path.append, ("executed by a pickle",))


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
@pytest.mark.parametrize("prefix", [b"", b"# obspy.core.stream\n"])
def test_a_pickle_is_never_opened(tmp_path: Path, protocol: int, prefix: bytes) -> None:
    payload = prefix + pickle.dumps({"obspy.core.stream": _Trap()}, protocol=protocol)
    with pytest.raises(RecordError):
        read(written(tmp_path, payload))
    with pytest.raises(RecordError):
        read(written(tmp_path, gzip.compress(payload)))
    assert "executed by a pickle" not in sys.path


def test_times_rounded_in_print_are_even_and_uneven_ones_are_resampled(tmp_path: Path) -> None:
    even = "".join(f"{i / 128:.3f} {0.01 * i - 1:.2f}\n" for i in range(200))
    (record,) = read(written(tmp_path, even, "r.txt"), unit="g")
    assert record.time_step == pytest.approx(1 / 128, rel=1e-4) and not record.warnings
    times = np.cumsum(np.where(np.arange(200) % 3, 0.01, 0.013))
    uneven = "".join(f"{t:.4f} {np.sin(t):.6f}\n" for t in times)
    (record,) = read(written(tmp_path, uneven, "r.txt"), unit="g")
    told = record.warnings[0]
    assert told.kind is RecordKind.UNEVEN and record.processing == (str(told),)
    slow = 0.01 * np.arange(400) * (1 + 1e-5 * np.arange(400))
    slowing = "".join(f"{t:.6f} {np.sin(t):.6f}\n" for t in slow)
    assert read(written(tmp_path, slowing, "s.txt"), unit="g")[0].warnings[0].kind is RecordKind.UNEVEN
    # linear interpolation of sin between points 0.013 s apart errs by h²/8; the print rounds to 5e-7
    truth = np.sin(times[0] + np.arange(record.acceleration.size) * record.time_step)
    assert np.abs(record.acceleration / 9.80665 - truth).max() < 0.013**2 / 8 + 1e-6


@pytest.mark.parametrize(("text", "named"), [
    ("0.00 1\n0.01 2\n0.02 3\n0.02 1\n0.03 -1\n0.04 2\n0.05 3\n0.06 1\n", ("times", 0.02)),
    ("time,a(g)\n0.00,1\n0.01,\n0.02,3\n", ("format",)),
    ("time,a(g)\n0.00,1\n0.01,2,3\n0.02,3\n", ("format", 'time,a(g)')),
    ("t,NS,EW\n0,5,6\n1,8,9\n2,2\n", ("columns", 2)),
    ("E\n7\n9\n1 2\n", ("format",)),
    ("1\n" * 40 + "1 2\n" + "3\n", ("columns", 2)),
    ("1 2 3\n" * 40 + "1 2\n" + "3 3 3\n", ("columns", 2)),
    ("time,a(inches)\n0.00,1\n0.01,2\n0.02,3\n", ("layout",)),
])  # fmt: skip
def test_bad_tables(tmp_path: Path, text: str, named: tuple) -> None:
    with refused(RecordError, *named):
        read(written(tmp_path, text, "r.csv"), time_step=None if "," in text and "time" in text else 0.01)


def test_wrapped_series_and_single_column(tmp_path: Path) -> None:
    values = 0.1 * np.sin(np.arange(23))
    wrapped = "\n".join(" ".join(f"{v:.7E}" for v in values[i : i + 5]) for i in range(0, 23, 5))
    single = "\n".join(f"{v:.7E}" for v in values)
    for text in (wrapped, single, "# made\n" + single, "acc\n" + single, "\ufeff" + single):
        (record,) = read(written(tmp_path, text, "r.txt"), unit="m/s2", time_step=0.01)
        assert np.allclose(record.acceleration, values, atol=1e-8)


def test_declarations_are_checked(tmp_path: Path) -> None:
    path = written(tmp_path, at2(["0.1", "0.2"]))
    bad: list[tuple[str, Any]] = [
        ("unit", "furlong"), ("unit", "gal"), ("time_step", 0.02), ("time_step", -1), ("response", "partly"),
    ]  # fmt: skip
    for field, value in bad:
        with refused(RecordError, field, value):
            read(path, **{field: value})
    assert read(path, unit="G", time_step=0.01)[0].time_step == 0.01


@pytest.mark.process
def test_reading_at2_needs_no_heavy_library(tmp_path: Path) -> None:
    path = written(tmp_path, at2(["0.1", "0.2"]))
    code = (
        "import sys; from rocking.records import read; read(sys.argv[1]); "
        "print(*sorted({'obspy', 'pandas', 'numba', 'matplotlib', 'scipy.signal', 'pooch'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""


WORST = {
    "columns": (b"", b"12\n"),
    "pairs": (b"", b"1 2\n"),
    "one number": (b"", b"1"),
    "blanks": (b"x", b" "),
    "line ends": (b"x", b"\r"),
    "commas": (b"", b","),
    "headers": (b"", b"Corrected accelerogram 1\nSite x\n"),
    "announcements": (
        b"Corrected accelerogram 1 Chan 1\n",
        b"9 points of accel data equally spaced at 1 sec, in g. (8f10.6)\n",
    ),
}


@pytest.mark.parametrize("share", [0.1, pytest.param(1.0, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", WORST)
def test_the_worst_content_of_the_largest_size_takes_no_more_than_500_mb(name: str, share: float) -> None:
    """A share of that size takes as much of the memory."""
    first, repeated = WORST[name]
    content = first + repeated * int((share * LARGEST_FILE - len(first)) / len(repeated))
    tracemalloc.start()
    try:
        with contextlib.suppress(RecordError):
            read_content(content, name, Options(unit="mg", time_step=0.01))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < share * 500 * 2**20


def test_an_archive_and_a_file_of_many_members_are_refused_at_once(tmp_path: Path) -> None:
    (tmp_path / "records.zip").write_bytes(b"PK\x03\x04" + b"\0" * 100)
    with refused(RecordError, "format", "zip archive"):
        read(tmp_path / "records.zip")
    (tmp_path / "many.gz").write_bytes(gzip.compress(b"") * 100_000)
    with refused(RecordError, "size", 0):
        read(tmp_path / "many.gz")
    (tmp_path / "other.dat").write_bytes(b"of a format that only obspy reads\n" * 3)
    with refused(RecordError, "format", "of a format that only obspy reads"):
        read(tmp_path / "other.dat")


SERIES = "\n".join(f"{value:.6f}" for value in np.sin(np.arange(300) * 0.1)) + "\n"


@pytest.mark.parametrize(
    ("name", "component"),
    [
        ("ELC-UP.txt", "UP"),
        ("kobe.UD", "UD"),
        ("x_HNZ.csv", "HNZ"),
        ("vertical.txt", "vertical"),
        ("RSN6_V.dat", "V"),
    ],
)
def test_a_bare_series_is_vertical_where_its_file_is_called_so(tmp_path: Path, name, component) -> None:
    (record,) = read(written(tmp_path, SERIES, name), unit="m/s2", time_step=0.01)
    assert record.vertical
    assert RecordKind.VERTICAL_BY_NAME in {warning.kind for warning in record.warnings}


@pytest.mark.parametrize(
    "name",
    [
        "v1.txt",
        "elc_500.txt",
        "backup.txt",
        "Soup.csv",
        "ELC180.txt",
        "up_scaled.txt",
        "Z1.csv",
        "ZETA.txt",
        "kobe_scaled_up.csv",
    ],
)
def test_other_names_say_nothing_of_a_vertical(tmp_path: Path, name) -> None:
    (record,) = read(written(tmp_path, SERIES, name), unit="m/s2", time_step=0.01)
    assert not record.vertical


def test_the_content_of_a_file_goes_before_its_name(tmp_path: Path) -> None:
    (record,) = read(
        written(tmp_path, "# Component: NS\n" + SERIES, "elc_up.txt"), unit="m/s2", time_step=0.01
    )
    assert (record.component, record.azimuth, record.vertical) == ("NS", 0.0, False)
