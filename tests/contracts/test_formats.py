"""The formats as promised: one reader reads each real file of the manifest rightly, or refuses it by name."""

import csv
import itertools
from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError, UnknownFormatError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram, read
from rocking.records.formats import FORMATS, Options
from rocking.records.kinds import RecordKind
from rocking.records.read import bare_text, read_content
from rocking.signal.processing import displacement, velocity
from tests.refusals import refused

pytestmark = pytest.mark.real_records

REFUSED = {"VT2": "quantity", "V3": "format", "xml": "format"}
"""Files that hold no acceleration, by the end of their name, and what of them is refused."""

TRUNCATED = {
    "HEC000_truncated.AT2": 4531,
    "HEC090_truncated.AT2": 4531,
    "KOBE_NS1_wrong_header.AT2": 10102,
}
"""File → samples that it declares, of which it holds fewer."""
SERIES_STEP = {"Cosmos12TimeSeriesTest.v1": 0.01, "us1000hyfh_akbmrp_AKBMR--n.1000hyfh.BNZ.--.acc.V2c": 0.005}
"""Step of a resampled COSMOS series, s: the manifest lists the recorder's. The same headers state lengths of 70 and
210 s and peaks at 27.85 and 76.215 s, where 7000 and 42000 samples have them with these steps alone."""


def declared(row: dict[str, str]) -> dict:
    """Return what the caller has to declare because the file does not: known from the source, not from the file."""
    if row["file"].endswith((".time_g.csv", ".sac")):
        return {"unit": "g"}
    if "test_motion" in row["file"]:
        return {"unit": "m/s2"}
    if row["note"].startswith("bare numbers"):
        return {"unit": "g", "time_step": float(row["dt"])}
    return {}


@pytest.fixture(scope="module")
def series(real_records: Path, manifest) -> dict[str, tuple[list[dict[str, str]], list[Accelerogram]]]:
    """File → its rows, and what is read from it, of each that holds acceleration and is whole."""
    files: dict[str, list[dict[str, str]]] = {}
    for row in manifest:
        if not row["file"].endswith((*REFUSED, *TRUNCATED)):
            files.setdefault(row["file"], []).append(row)
    return {file: (rows, read(real_records / file, **declared(rows[0]))) for file, rows in files.items()}


def test_every_channel_agrees_with_the_manifest(series) -> None:
    wrong, channels = [], 0
    for file, (rows, records) in series.items():
        assert len(records) == len(rows), file
        for record, row in zip(records, rows, strict=True):
            channels += 1
            # The uneven record: the manifest gives the film's median step, its note the 0.005 s of npts and PGA.
            step = 0.005 if "resampled 0.005 s" in row["note"] else float(row["dt"])
            step = SERIES_STEP.get(Path(file).name, step)
            # 0.5 % is what is asked for; the manifest prints PGA to 1e-5 g, so half a digit on top.
            peak = pytest.approx(float(row["pga_g"]), rel=0.005, abs=0.5e-5)
            same = record.acceleration.size == int(row["npts"]) and abs(record.time_step - step) <= 1e-9
            if not (same and record.peak_acceleration / GRAVITY == peak):
                wrong.append(f"{file} {row['component']}: {record}, not {row}")
    assert not wrong and channels >= 140


def more(real_records: Path) -> list[dict[str, str]]:
    """The rows of the second list of samples."""
    with (real_records / "manifest_more.tsv").open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream, delimiter="\t"))


WITHOUT_SAMPLE = {
    "ASDF station",
    "ESD",
    "USC Volume 2",
    "GSE",
    "SLIST or TSPAIR",
    "WIN",
    "SEISAN",
    "REFTEK 130",
}
"""Formats of which none lies here: one whose layout is on the page of its database (isesd.hi.is, "Datafile Format"),
one of which two files are in the repository usgs/groundmotion-processing
(017m30bt.s0a, 274o42pv.s0a of tests/data, commit 97fa3e74), and those whose files obspy installs, which
tests/contracts/test_by_obspy.py reads."""


def test_exactly_one_format_recognises_each_file(real_records: Path, manifest: list[dict[str, str]]) -> None:
    matrix = {}
    for file in sorted({row["file"] for row in [*manifest, *more(real_records)]}):
        content = bare_text((real_records / file).read_bytes())
        recognised = [form for form in FORMATS if form.recognise(content)]
        owners = [form for form in recognised if not form.yields] or recognised
        matrix[file] = [form.name for form in owners]
    of_none = {file for file in matrix if REFUSED.get(file.rsplit(".", 1)[-1]) == "format"}
    assert {file for file, names in matrix.items() if len(names) != 1} <= of_none
    assert {names[0] for file, names in matrix.items() if file not in of_none} == {
        form.name for form in FORMATS
    } - WITHOUT_SAMPLE


def test_what_is_not_acceleration_is_refused_by_name(real_records: Path, manifest) -> None:
    files = {row["file"] for row in manifest if row["file"].endswith(tuple(REFUSED))}
    assert len(files) == 5
    for file in files:
        with pytest.raises(RecordError) as caught:
            read(real_records / file)
        assert caught.value.field == REFUSED[file.rsplit(".", 1)[1]]
        assert isinstance(caught.value, UnknownFormatError) == (caught.value.field == "format")


@pytest.mark.parametrize("name", TRUNCATED)
def test_broken_files_are_refused(real_records: Path, name: str) -> None:
    with refused(RecordError, "samples", TRUNCATED[name]):
        read(real_records / "broken_samples" / name)


WARNED = {
    "ANLA196.AT2": {RecordKind.IN_A_STRUCTURE},
    "RSN77_SFERN_PUL164.AT2": {RecordKind.IN_A_STRUCTURE},
    "RSN960_LOS270_one_extra.AT2": {RecordKind.SAMPLES_SURPLUS},
    "ARL360_odd_header.at2": {RecordKind.LINE_ENDS_DOUBLED},
    "RSN10591_ComalTX11-10-20_IU.CCM.BH1.10.AT2": {RecordKind.PEAK_TINY, RecordKind.CHANNEL_OF_VELOCITY},
    "RSN175_IMPVALL.H_H-E12140_ASCE7_Matched.AT2": {RecordKind.MATCHED_TO_SPECTRUM},
    "Cosmos12TimeSeriesTest.v1": {RecordKind.IN_A_STRUCTURE},
    "20161113_110259_WTMC_20.V1A": {RecordKind.PEAK_RARE},
    "017m30cc.y0a": {RecordKind.UNEVEN_FILM},
    "RioDell_CHAN001.V2": {RecordKind.IN_A_STRUCTURE, RecordKind.CHANNELS_UNLIKE_HEADER},
}
"""All that real files are warned of: peaks, lengths, rates and counts of every other header agree with its samples."""


def test_no_real_file_is_warned_of_without_reason(series) -> None:
    assert series
    for file, (_, records) in series.items():
        kinds = {warning.kind for record in records for warning in record.warnings}
        assert kinds == WARNED.get(Path(file).name, set()), file


def test_rinaldi_velocity_is_peers_own(real_records: Path) -> None:
    """0.03 cm/s is asked for; PEER integrated before rounding the acceleration to 7 digits and with g = 9.81."""
    folder = real_records / "northridge1994_rinaldi"
    (record,) = read(folder / "RSN1063_NORTHR_RRS228.AT2")
    lines = (folder / "RSN1063_NORTHR_RRS228.VT2").read_text().splitlines()[4:]
    published = np.array(" ".join(lines).split(), dtype=float)
    assert published.size == record.acceleration.size
    assert np.abs(100 * velocity(record) - published).max() < 0.03
    assert np.abs(displacement(record)).max() < 1.0


def test_formats_of_the_second_list_agree_with_it(real_records: Path) -> None:
    """AFAD's files of 2023, EMOD3D and JMA; the unit of EMOD3D stands in no file. PGA has four digits."""
    rows = more(real_records)
    assert rows
    for row in rows:
        unit = "g" if "emod3d" in row["file"] else None
        records = {record.component: record for record in read(real_records / row["file"], unit=unit)}
        record = records[row["component"]]
        assert (record.time_step, record.acceleration.size) == (float(row["dt"]), int(row["npts"]))
        assert record.peak_acceleration / GRAVITY == pytest.approx(float(row["pga_g"]), abs=6e-5)
        assert not record.warnings


DRESSED = {
    "^Z": lambda text: text + b"\x1a",
    "NUL": lambda text: text + bytes(700),
    "BOM": lambda text: b"\xef\xbb\xbf" + text,
    "CRLF": lambda text: b"\r\n".join([*text.splitlines(), b""]),
    "CR": lambda text: b"\r".join([*text.splitlines(), b""]),
    "blank lines": lambda text: text.rstrip() + b"\n \n\t\n\n",
}


@pytest.mark.parametrize("of_each_file", [1, pytest.param(len(DRESSED), marks=pytest.mark.slow)])
def test_what_programs_put_around_a_text_changes_nothing(
    real_records: Path, series, of_each_file: int
) -> None:
    """25 of 26 texts were refused for a ^Z at their end. In turn: `of_each_file` of the dresses for each text."""
    tried = 0
    turn = itertools.cycle(DRESSED.items())
    for file, (rows, records) in series.items():
        content = (real_records / file).read_bytes()
        if b"\0" in content[:512] or content.startswith(b"\x1f\x8b") or not file.startswith("formats_"):
            continue
        for name, dress in itertools.islice(turn, of_each_file):
            after = read_content(dress(content), "f", Options(**declared(rows[0])))
            assert [r.sha256 for r in records] == [r.sha256 for r in after], (file, name)
            tried += 1
    assert tried > 30 * of_each_file
