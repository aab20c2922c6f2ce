"""What obspy reads, it reads for us: its own test files, each read as obspy reads it or refused in one sentence."""

import io
from pathlib import Path

import made_files
import numpy as np
import obspy
import pytest
from made_files import OF_OBSPY, STEP, TRUE, by_obspy, of_obspy

from rocking import from_obspy
from rocking.errors import RecordError, UndeclaredError
from rocking.records import read
from rocking.records.formats import Options
from rocking.records.kinds import RecordKind
from rocking.records.read import read_content, recognise
from tests.refusals import refused

FOLDERS = {
    "nied": 1, "gse2": 9, "ascii": 12, "win": 14, "seisan": 10, "css": 0, "reftek": 4, "kinemetrics": 3, "sac": 9,
}  # fmt: skip
"""Folder of obspy → how many of its test files are read, where their unit is declared.

The others are texts about stations and events, files that are damaged on purpose or have gaps, tables of CSS, whose
samples lie in other files, and arrays of numpy.
"""
NAMES = {"GSE": ("GSE2", "GSE1"), "SLIST or TSPAIR": ("SLIST", "TSPAIR"), "WIN": ("WIN",), "SEISAN": ("SEISAN",),
         "REFTEK 130": ("REFTEK130",)}  # fmt: skip


def of_obspys_own(content: bytes, name: str) -> obspy.Stream:
    """The stream as obspy reads the content by one of its names of the format."""
    for form in NAMES[name]:
        try:
            return obspy.read(io.BytesIO(content), format=form, check_compression=False)
        except Exception:
            continue
    raise AssertionError(name)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("folder", FOLDERS)
def test_its_own_files_are_read_or_refused_in_one_sentence(folder: str) -> None:
    files = sorted((Path(obspy.__file__).parent / "io" / folder / "tests" / "data").rglob("*"))
    count = 0
    for path in filter(Path.is_file, files):
        try:
            # In so small a unit no count is beyond what the ground does.
            records = read(path, unit=None if folder in ("nied", "kinemetrics") else "nm/s2")
        except RecordError as error:
            assert "\n" not in str(error) and str(error).endswith("."), path.name
            continue
        count += 1
        if records[0].source.format not in NAMES or path.suffix == ".gz":
            continue
        stream = of_obspys_own(path.read_bytes(), records[0].source.format)
        order = [trace.id for trace in stream]
        stream = sorted(stream.merge(method=0), key=lambda trace: order.index(trace.id))
        assert [one_record.acceleration.size for one_record in records] == [
            trace.stats.npts for trace in stream
        ]
        for record, trace in zip(records, stream, strict=True):
            counts = np.ma.getdata(trace.data).astype(float)
            # A product rounds in its last digit.
            assert np.allclose(record.acceleration, 1e-9 * counts, rtol=1e-14, atol=0), path.name
    assert count == FOLDERS[folder]


@pytest.mark.parametrize("name", OF_OBSPY)
def test_each_is_recognised_by_one_reader_and_asks_for_its_response(name: str) -> None:
    content = of_obspy(OF_OBSPY[name])
    assert recognise(content).name == name
    with refused(UndeclaredError, "unit"):
        read_content(content, "f", Options(folder=Path("/nowhere")))


@pytest.mark.parametrize("form", ["GSE1", "GSE2", "CSS", "NNSA_KB_CORE"])
def test_the_calibration_of_gse_and_css_leads_to_a_displacement_and_is_not_applied(form: str) -> None:
    """GSE 2.0, IMS 1.0 and CSS 3.0: "calib" is in nm of ground displacement a count, at the period "calper"."""
    counts = np.round(1000 * TRUE).astype(np.int32)
    header = {"station": "MADE", "channel": "HNE", "delta": STEP, "calib": 0.5, "_format": form}
    (record,) = from_obspy(obspy.Trace(counts, header), unit="mm/s2")
    assert np.allclose(record.acceleration, counts / 1000)
    assert [warning.kind for warning in record.warnings] == [RecordKind.CALIBRATION_NOT_APPLIED]


@pytest.mark.parametrize(("form", "processed"), [
    *((form, False) for form in ("GSE2", "MSEED", "SLIST", "TSPAIR", "WIN", "SEISAN", "REFTEK130", "SAC", "KNET")),
    ("KINEMETRICS_EVT", False), ("", None), ("PICKLE", None), ("AH", None),
])  # fmt: skip
def test_what_a_recorder_wrote_and_nobody_changed_is_not_processed(form: str, processed: bool | None) -> None:
    trace = obspy.Trace(TRUE.copy(), {"channel": "HNE", "delta": STEP, "_format": form})
    assert from_obspy(trace, unit="m/s2")[0].processed is processed
    assert from_obspy(trace.copy().trim(trace.stats.starttime + 0.1), unit="m/s2")[0].processed is processed
    assert from_obspy(trace.detrend("linear"), unit="m/s2")[0].processed is None


@pytest.mark.parametrize("form", ["SLIST", "TSPAIR"])
def test_the_unit_of_a_list_of_samples(form: str) -> None:
    content = by_obspy(form).replace(b"FLOAT, ", b"FLOAT, Counts")
    (record,) = read_content(content.replace(b"Counts", b"M/S**2"), "f", Options())
    assert np.abs(record.acceleration - TRUE).max() < 1e-7 and record.time_step == STEP
    with refused(RecordError, "quantity", "velocity"):
        read_content(content.replace(b"Counts", b"M/S"), "f", Options())
    with refused(UndeclaredError, "unit"):
        read_content(content.replace(b"Counts", b"VOLTS"), "f", Options())


@pytest.mark.parametrize(("form", "a_line"), [("SLIST", 4), ("TSPAIR", 1)])
def test_a_list_of_samples_that_is_cut_is_refused(form: str, a_line: int) -> None:
    """obspy reads what is left without a word. Of 40 samples, six a line, the last holds four."""
    content = by_obspy(form)
    cut = content[: content.rindex(b"\n", 0, -2) + 1]
    head = content.partition(b"\n")[0].replace(b" 40 samples", b" 0 samples") + b"\n"
    for text, samples in ((cut, 40 - a_line), (head, 0)):
        with refused(RecordError, "samples", samples):
            read_content(text, "f", Options(unit="m/s2"))


def test_a_file_of_win_without_a_second_is_refused() -> None:
    """obspy joins the seconds before and after."""
    whole = made_files.win()
    (record,) = read_content(whole, "f", Options(unit="mm/s2"))
    assert np.abs(record.acceleration - TRUE).max() <= 5.1e-4 and record.time_step == 0.1
    block = len(whole) // 4
    with refused(RecordError, "seconds", 3):
        read_content(whole[:block] + whole[2 * block :], "f", Options(unit="mm/s2"))
    with refused(RecordError, "seconds", 4):
        read_content(whole[: 3 * block + 20], "f", Options(unit="mm/s2"))
    of_another_channel = whole[: block + 10] + b"\xb1" + whole[block + 11 :]
    with refused(RecordError, "samples"):
        read_content(of_another_channel, "f", Options(unit="mm/s2"))


def test_where_a_channel_of_win_points_is_in_doubt() -> None:
    """Its four hexadecimal digits number the channel: "0090" is no azimuth."""
    (record,) = read_content(made_files.win(), "f", Options(unit="mm/s2"))
    assert record.azimuth is None and RecordKind.DIRECTION_UNKNOWN in {
        warning.kind for warning in record.warnings
    }


def test_text_in_place_of_samples_is_refused() -> None:
    content = of_obspy("mseed/tests/data/encoding/smallASCII_bigEndian.mseed")
    with refused(RecordError, "channel", "XX.TEST..BHE"):
        read_content(content, "f", Options(unit="m/s2"))


def test_a_line_that_would_end_the_process_is_refused() -> None:
    """The decoder of compressed samples copies lines whole: two that have become one are longer than its place."""
    content = of_obspy("gse2/tests/data/loc_RJOB20050831023349.z")
    lines = content.split(b"\n")
    lines[20] += lines.pop(21) + lines.pop(21)
    with refused(RecordError, "line", 240):
        read_content(b"\n".join(lines), "f", Options(unit="nm/s2"))


@pytest.mark.parametrize("place", range(4, 10))
def test_a_time_of_win_that_is_none_is_refused(place: int) -> None:
    content = bytearray(made_files.win())
    second_block = len(content) // 4
    content[second_block + place] = 0xDE
    content[2 * second_block + place] = 0xDE
    with pytest.raises(RecordError):
        read_content(bytes(content), "f", Options(unit="mm/s2"))
