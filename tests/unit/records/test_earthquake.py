"""Magnitude and distance: what headers say of them, and what a catalogue adds."""

import hashlib
from pathlib import Path

import pytest

from rocking.errors import CatalogueError
from rocking.records import load_catalogue, open_record, read
from rocking.records.formats.header import distance, magnitude

TABLE = b"time,NS\n0.00,0.1\n0.01,0.3\n0.02,0.2\n0.03,0.1\n"
SHA = hashlib.sha256(TABLE).hexdigest()
SAID = {
    "formats_esm_dyna/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC": (
        4.6,
        88.1,
    ),  # M_W empty, M_L and distance printed
    "formats_afad/20101114230825_3104_ap_RawAcc_E.asc": (5.1, 45.79),
    "formats_afad/20170720223109_0921.txt": (6.5, None),
    "formats_geonet/20161113_110259_WTMC_20.V2A": (7.82, 9.0),
    "formats_smc/0111a.smc": (7.1, 89.0),
    "formats_bhrc/5529-1.V1": (6.1, None),  # the scales without a number stand before M_w
    "formats_cwb/1-EAS.dat": (6.0, None),
    "formats_csmnc/ua0001.dat": (4.0, None),
    "formats_knet/AOM0011801241951.EW": (6.2, None),
    "formats_unam/ACAC1709.191": (7.1, None),
    "northridge1994_rinaldi/RSN1063_NORTHR_RRS228.AT2": (None, None),
}


@pytest.mark.real_records
@pytest.mark.parametrize("file", SAID)
def test_what_a_header_says(real_records, file):
    found = read(real_records / file)[0]
    kilometres = None if found.epicentral_distance is None else found.epicentral_distance / 1000
    assert (found.magnitude, kilometres) == pytest.approx(SAID[file])


@pytest.mark.parametrize(
    ("texts", "found"),
    [
        (("", "5.1"), 5.1),
        (("/M=7.1",), 7.1),
        (("6.5 Mw", "6.2"), 6.5),
        (("0", "-999"), None),
        (("32767",), None),
    ],
)
def test_a_magnitude_is_the_first_that_is_one(texts, found):
    assert magnitude(*texts) == found


@pytest.mark.parametrize(
    ("text", "found"), [("88.1", 88100.0), ("9", 9000.0), ("-999", None), ("32767", None), ("", None)]
)
def test_a_distance_is_one_on_this_earth(text, found):
    assert distance(text) == found


def catalogue(folder: Path, cells: str) -> Path:
    (folder / "table.csv").write_bytes(TABLE)
    path = folder / "catalogue.csv"
    head = "id,file,sha256,unit,magnitude,epicentral_distance_km"
    path.write_text(f"{head}\none,table.csv,{SHA},m/s2,{cells}\n", encoding="utf-8")
    return path


def test_a_catalogue_says_what_the_file_does_not(tmp_path):
    (record,) = load_catalogue(catalogue(tmp_path, "6.7,0"))
    (found,) = open_record(record)
    assert (found.magnitude, found.epicentral_distance) == (6.7, 0.0)


@pytest.mark.parametrize(
    ("cells", "field"),
    [("11,5", "magnitude is 11"), ("6,-3", "epicentral_distance_km is -3"), ("big,5", "magnitude is 'big'")],
)
def test_what_no_earthquake_has_is_refused(tmp_path, cells, field):
    with pytest.raises(CatalogueError, match=field):
        load_catalogue(catalogue(tmp_path, cells))
