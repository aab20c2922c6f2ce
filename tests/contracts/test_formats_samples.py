"""Each text format from a small file made here: values, one recogniser, truncation, line ends, foreign characters."""

import inspect
import re
import time

import made_files
import numpy as np
import pytest
from made_files import (
    MADE,
    MADE_BINARY,
    MADE_REFUSED,
    OF_OBSPY,
    OTHER_KINDS,
    STEP,
    TRUE,
    N,
    content_of,
    format_of,
    read_text,
)

from rocking.errors import RecordError, UnknownFormatError
from rocking.records import Accelerogram
from rocking.records.formats import FORMATS, Format
from rocking.records.kinds import RecordKind
from rocking.records.read import read_content, recognise
from tests.refusals import refused

WARNED = {
    "GeoNet V1A/V2A": RecordKind.CHANNELS_OF_GEONET,
    "UNAM/CICESE: repeated last line": RecordKind.LINES_SURPLUS,
}
"""What a made file leaves out or holds twice: of the others nothing is said."""
MEAN_REMOVED = {"BHRC", "K-NET/KiK-net", "SAC", "Kinemetrics EVT"}


@pytest.mark.parametrize("form", FORMATS, ids=lambda form: form.name)
def test_every_format_has_a_made_sample(form: Format) -> None:
    """The recipe for a format ends here: without a sample in made_files.py its name fails."""
    made = {format_of(label) for label in MADE | MADE_BINARY | MADE_REFUSED} | set(OF_OBSPY)
    assert form.name in made, f"{form.name}: write a maker of a small file into tests/contracts/made_files.py"


@pytest.mark.parametrize("name", MADE_REFUSED)
def test_what_is_no_acceleration_is_recognised_and_refused(name: str) -> None:
    text, *named = MADE_REFUSED[name]
    assert recognise(text.encode()).name == format_of(name)
    with refused(RecordError, *named):
        read_text(text)


@pytest.mark.parametrize("word", OTHER_KINDS)
def test_what_is_no_record_is_known_and_refused(word: str) -> None:
    with pytest.raises(UnknownFormatError, match=word):
        read_text(OTHER_KINDS[word])


def read_made(name: str, text: str) -> list[Accelerogram]:
    return read_text(text, MADE[name][2])


@pytest.mark.parametrize("name", MADE | MADE_BINARY)
def test_values_step_and_one_recogniser(name: str) -> None:
    _, digit, options = (MADE | MADE_BINARY)[name]
    content = content_of(name)
    recognised = [form for form in FORMATS if form.recognise(content)]
    owners = [form for form in recognised if not form.yields] or recognised
    assert [form.name for form in owners] == [format_of(name)]
    records = read_content(content, "made", options)
    record = next(r for r in records if not r.vertical)
    warned = [warning.kind for one_record in records for warning in one_record.warnings]
    assert warned == ([WARNED[name]] * len(records) if name in WARNED else [])
    expected = TRUE - TRUE.mean() if name in MEAN_REMOVED else TRUE
    assert record.time_step == pytest.approx(STEP, rel=1e-12)
    assert np.abs(record.acceleration - expected).max() <= 1.01 * digit


@pytest.mark.parametrize("name", MADE)
def test_blanks_after_the_first_words_take_no_time(name: str) -> None:
    """A pattern that tries each of 40 000 blanks against all others takes seconds; a linear one, milliseconds."""
    line = content_of(name).partition(b"\n")[0]
    for words in list(re.finditer(rb"\S+", line))[:4]:
        started = time.process_time()
        for form in FORMATS:
            form.recognise(line[: words.end()] + b" " * 40_000)
        assert time.process_time() - started < 1


@pytest.mark.parametrize("name", MADE)
def test_a_cut_file_is_refused(name: str) -> None:
    """Cut anywhere in the numbers; a table without a declared length is refused where the cut leaves a row unequal."""
    lines = MADE[name][0]().split("\n")
    first = next(i for i, line in enumerate(lines) if line and i > len(lines) - 4)
    cut = "\n".join(lines[: first - 2]) + "\n"
    if name in ("columns of numbers", "JMA CSV"):
        cut = cut.rsplit(",", 1)[0]
    with pytest.raises(RecordError) as caught:
        read_made(name, cut)
    assert caught.value.places == ("made",) and caught.value.field


@pytest.mark.parametrize("name", MADE)
@pytest.mark.parametrize("token", ["nan", "inf", "1_0", "x", "1.#I"])
def test_what_is_no_number_is_refused(name: str, token: str) -> None:
    lines = MADE[name][0]().rstrip("\n").split("\n")
    at = max(i for i, line in enumerate(lines) if line.strip() and line.strip()[0] in "-.0123456789")
    old = lines[at].replace(",", " ").split()[-1][-4:]
    lines[at] = lines[at][: lines[at].rindex(old)] + token.rjust(4)
    with pytest.raises(RecordError):
        read_made(name, "\n".join(lines) + "\n")


@pytest.mark.parametrize(("code", "component", "azimuth", "borehole"), [
    ("1", "NS", 0.0, True), ("2", "EW", 90.0, True), ("3", "UD", None, True),
    ("4", "NS", 0.0, False), ("5", "EW", 90.0, False), ("6", "UD", None, False),
])  # fmt: skip
def test_the_directions_of_kiknet(code: str, component: str, azimuth: float | None, borehole: bool) -> None:
    """1 to 3 are at the bottom of the hole, 4 to 6 at the surface (NIED, KiK-net format)."""
    (record,) = read_made("K-NET/KiK-net", made_files.knet().replace("E-W", code))
    assert (record.component, record.azimuth, record.borehole) == (component, azimuth, borehole)
    assert record.vertical == (component == "UD")


STATES_PEAK = [name for name, (make, *_) in MADE.items() if "stated" in inspect.signature(make).parameters]


@pytest.mark.parametrize("name", STATES_PEAK)
def test_a_peak_that_contradicts_the_header_is_refused(name: str) -> None:
    make = MADE[name][0]
    with refused(RecordError, "peak"):
        read_made(name, make(10.0))
    with refused(RecordError, "peak"):
        read_made(name, make(1.02))


@pytest.mark.parametrize(("name", "old", "new", "named"), [
    ("PEER AT2", "ACCELERATION TIME SERIES IN UNITS OF G", "DISPLACEMENT TIME SERIES IN UNITS OF CM",
     ("quantity", 'displacement')),
    ("COSMOS V1/V2", " acceleration pts, approx 1 secs, units=cm/sec2(04)",
     " velocity pts, approx 1 secs, units=cm/s(05)", ("channels", 0)),
    ("USGS SMC", "2 CORRECTED ACCELEROGRAM", "3 VELOCITY", ("quantity", '3 VELOCITY')),
    ("DYNA (ESM, ITACA, AFAD)", "DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY", ("quantity", 'VELOCITY')),
    ("RESORCE", "Accelaration time series in m/s/s", "Velocity time series in m/s", ("quantity", 'Velocity')),
    ("CSMNC", "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC", "CORRECTED VELOCITY UNIT: CM/SEC",
     ("quantity", 'VELOCITY')),
    ("CSMNC", "UNIT: CM/SEC/SEC", "UNIT: G", ("unit", 'G')),
    ("UNAM/CICESE", ": Gal (cm/s/s)", ": cm/s", ("quantity", 'velocity')),
    ("CWB", "gal. DCoffset(corr)", "count", ("unit", 'count')),
    ("CSMIP V1/V2", "in cm/sec2. (8f10.6)", "in parsecs. (8f10.6)", ("unit", 'parsecs')),
    ("COSMOS V1/V2", "units=cm/sec2(04)", "units=parsecs(99)", ("unit", 'parsecs')),
    ("COSMOS V1/V2", "units=cm/sec2(04)", "units=m/s2(04)", ("unit", 'm/s2')),
    ("COSMOS V1/V2", " acceleration pts", " velocity pts", ("quantity", 'velocity')),
    ("CSMIP V1/V2: of 1983", "POINTS OF ACCEL", "POINTS OF VELOC", ("header", 'POINTS OF ACC DATA')),
    ("PEER AT2", "DATABASE RECORD\nQuake, 1/2/1999, Station, 45\nACCELERATION",
     "ACCELEROGRAM\nQuake, 1/2/1999, Station, 45\nVELOCITY", ("quantity", 'velocity')),
    ("PEER AT2", "PEER", "STRONG GROUND MOTION RECORDS OF TURKIYE\nPEER", ("format", "PEER AT2, AFAD/NSMN text")),
    ("PEER AT2", "DT= 0.01", "DT= 1e-9", ("time_step", 1e-9)),
    ("K-NET/KiK-net", "100Hz", "1e101Hz", ("the rate", "1e101")),
    ("UNAM/CICESE", f"{'-' * 79}\n CANAL", "x\n CANAL", ("header", "DATOS DE ACELERACION")),
    ("USGS SMC", "1.0000000E+02", "-1.000000E+02", ("rate", -100.0)),
    ("USGS SMC", "  1.7000000E+38\n", "\n", ("header", (48, 41))),
])  # fmt: skip
def test_other_quantities_units_and_numbers_that_cannot_be_are_refused_by_name(
    name: str, old: str, new: str, named: tuple
) -> None:
    text = MADE[name][0]()
    assert old in text
    with refused(RecordError, *named):
        read_made(name, text.replace(old, new))


@pytest.mark.parametrize("name", ["COSMOS V1/V2", "CSMIP V1/V2", "GeoNet V1A/V2A", "BHRC", "RENADIC"])
def test_channels_of_unequal_length_are_all_read(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    first = MADE[name][0]()
    monkeypatch.setattr(made_files, "N", 23)
    monkeypatch.setattr(made_files, "TRUE", TRUE[:23])
    assert [record.acceleration.size for record in read_made(name, first + MADE[name][0]())] == [40, 23]


COUNTED = {
    "NPTS", "a count in the header", "number of points", "the number of points", "number of samples", "samples",
    "the number of samples", "format", "header", "layout",
}  # fmt: skip
"""What a refused count may be called, by the words of its format, or what cannot be told without it."""


@pytest.mark.parametrize(
    "name", sorted(MADE.keys() - {"K-NET/KiK-net", "CWB", "columns of numbers", "JMA CSV"})
)
@pytest.mark.parametrize("declared", ["0", "1", "-4", "1e99", "9.5"])
def test_a_count_that_cannot_be_is_refused(name: str, declared: str) -> None:
    """The four left out declare a duration, or nothing."""
    text = MADE[name][0]()
    at = next(m for m in re.finditer(rf"(?<![\d.-]){N}(?![\d.])", text) if m.start() > 3)
    with pytest.raises(RecordError) as caught:
        read_made(name, text[: at.start()] + declared + text[at.end() :])
    assert caught.value.field in COUNTED


A_LINE = {
    "PEER AT2": 8, "PEER AT2: of 2008": 8, "USGS SMC": 8, "DYNA (ESM, ITACA, AFAD)": 1, "EMOD3D text": 6, "RESORCE": 5,
    "ESD": 10, "AFAD/NSMN text": 1, "CSMNC": 8, "columns of numbers: titled": 1, "columns of numbers: two headers": 8,
    **dict.fromkeys(("COSMOS V1/V2", "CSMIP V1/V2", "USC Volume 1", "RENADIC", "BHRC", "UNAM/CICESE"), 0),
}  # fmt: skip
"""The most numbers of a line, by the description of the format; 0 where the end of a channel is marked."""


@pytest.mark.parametrize("name", A_LINE)
def test_one_line_of_numbers_more_than_declared_is_told_and_more_refused(name: str) -> None:
    text = MADE[name][0]()
    at = next(m for m in re.finditer(rf"(?<![\d.-]){N}(?![\d.])", text) if m.start() > 3)

    def declaring(count: int) -> list[Accelerogram]:
        return read_made(name, f"{text[: at.start()]}{count:2d}{text[at.end() :]}")

    kinds = {warning.kind for record in declaring(N - A_LINE[name]) for warning in record.warnings}
    assert (RecordKind.SAMPLES_SURPLUS in kinds) == (A_LINE[name] > 0)
    with refused(RecordError, "samples"):
        declaring(N - A_LINE[name] - 1)


@pytest.mark.parametrize(("name", "field"), [
    *((name, "duration") for name in ("RENADIC", "BHRC", "USC Volume 1", "CSMIP V1/V2: film")),
    *((name, "the duration") for name in ("DYNA (ESM, ITACA, AFAD)", "UNAM/CICESE", "CWB")),
])  # fmt: skip
def test_a_duration_that_is_no_number_is_refused(name: str, field: str) -> None:
    text = re.sub(r"(?<=[ :/])0\.40{0,2}(?!\d)", "0.4.0", MADE[name][0](), count=1)
    with refused(RecordError, field, "0.4.0"):
        read_made(name, text)
