"""Magnitude, distance and place: what headers say of them."""

import pytest

from rocking.records import read
from rocking.records.formats.format import typed_magnitude
from rocking.records.formats.text import day_of, iso_date

SAID = {
    "formats_esm_dyna/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC":
        (4.6, "ML", 88.1, "2019-07-28T16:09:08", (37.6349, 22.7293, 34.0)),  # M_W is empty
    "formats_afad/20101114230825_3104_ap_RawAcc_E.asc":
        (5.1, "ML", 45.79, "2010-11-14T23:08:25.75", (36.69293, 36.48852, 260.0)),
    "formats_afad/20170720223109_0921.txt": (6.5, "Mw", None, "2017-07-20T22:31:09Z", (37.8747, 27.59223, 66.0)),
    "formats_geonet/20161113_110259_WTMC_20.V2A":
        (7.82, "Mw", 9.0, "2016-11-13T11:02:56Z", (-42.6194444, 173.0536111, None)),
    "formats_smc/0111a.smc": (7.1, "Mw", 89.0, "1989-10-18T00:04", (37.728, -122.385, None)),
    "formats_bhrc/5529-1.V1": (6.1, "Mw", None, "2012-08-11T12:23:16", (37.498, 44.999, 1417.0)),
    "formats_cwb/1-EAS.dat": (6.0, "ML", None, "2018-02-06T23:50:42+08:00", (22.381, 120.857, None)),
    "formats_csmnc/ua0001.dat": (4.0, "Ms", None, "2012-01-03T15:39:57+08:00", (39.7, 77.599, None)),
    "formats_knet/AOM0011801241951.EW": (6.2, "", None, "2018-01-24T19:51:00+09:00", (41.5267, 140.9244, 39.0)),
    "formats_unam/ACAC1709.191": (7.1, "M", None, "2017-09-19T18:14:40Z", (16.84851, -99.85157, 13.0)),
    "formats_cosmos/Cosmos12TimeSeriesTest.v1":
        (4.8, "Mw", 45.03, "2005-06-16T20:53:26.1Z", (34.046, -117.035, 15.0)),
    "formats_jma/Q4149CF2.csv": (6.5, "", None, "", (32.6476, 130.6842, None)),
    "formats_resorce/16833_H1.cor.acc": (None, "", None, "2009-04-06T01:32:39", (None, None, None)),
    "formats_csmip/CE89146.V2": (None, "", None, "2012-02-13T13:06:45-08:00", (40.941, -123.633, None)),
    "formats_mseed_stationxml/CI.CLC..HNE.mseed": (None, "", None, "", (35.81574, -117.59751, 775.0)),
    "northridge1994_rinaldi/RSN1063_NORTHR_RRS228.AT2": (None, "", None, "1994-01-17", (None, None, None)),
    "suites/fema_p695_far_field/01.AT2": (None, "", None, "1994-01-17T12:31", (None, None, None)),
}  # fmt: skip
"""By hand from the headers: magnitude, scale, distance [km], time of the earthquake, place of the station."""


@pytest.mark.real_records
@pytest.mark.parametrize("file", SAID)
def test_what_a_header_says(real_records, file):
    found = read(real_records / file)[0]
    kilometres = None if found.epicentral_distance is None else found.epicentral_distance / 1000
    magnitude, scale, distance, when, place = SAID[file]
    assert (found.magnitude, kilometres) == pytest.approx((magnitude, distance))
    assert (found.magnitude_type, found.event_time) == (scale, when)
    assert (found.latitude, found.longitude, found.elevation) == pytest.approx(place)


@pytest.mark.parametrize(("text", "found"), [
    ("/mb=6.1/Mw=7.1", (7.1, "Mw")), ("mb 6.1 Ms 6.9 ML 6.4", (6.9, "Ms")), ("5.2 (Ml)", (5.2, "ML")),
    ("mb      Ms      Mw6.1   M        ML", (6.1, "Mw")), ("6.2", (6.2, "")), ("Mw= ML=4.6", (4.6, "ML")),
    ("0", (None, "")), ("-999", (None, "")), ("32767", (None, "")),
])  # fmt: skip
def test_a_moment_magnitude_comes_before_one_of_body_waves(text, found):
    assert tuple(typed_magnitude(text).values()) == found


@pytest.mark.parametrize(("text", "found"), [
    ("20190728 160908", "2019-07-28T16:09:08"), ("2010/11/14 23:08:25.75", "2010-11-14T23:08:25.75"),
    ("2017/07/20 22:31:09 (GMT)", "2017-07-20T22:31:09Z"), ("2018/02/06-23:50:42", "2018-02-06T23:50:42"),
    ("1989 10 18 0004", "1989-10-18T00:04"), ("2016 November 13 11:02:56 UT", "2016-11-13T11:02:56Z"),
    ("Mon Feb 13, 2012 13:06:45.0 PST", "2012-02-13T13:06:45-08:00"), ("13-Nov-2016", "2016-11-13"),
    ("06/16/2005, 20:53:26.1 UTC", "2005-06-16T20:53:26.1Z"), ("1/17/94, 12:31", "1994-01-17T12:31"),
    ("10/15/79 2316", "1979-10-15T23:16"), ("28/10/1983", "1983-10-28"), ("2/9/1971", "1971-02-09"),
    ("2018/01/24 19:51:00 +0900", "2018-01-24T19:51:00+09:00"), ("1/2/29", "2029-01-02"), ("1/2/30", "1930-01-02"),
])  # fmt: skip
def test_a_date_is_one_whatever_its_spelling(text, found):
    assert iso_date(text) == found == iso_date(found)
    assert day_of(found) == found[:10]


@pytest.mark.parametrize(
    "text", ["", "Loma Prieta", "31/31/1999", "20240230", "01/01/2025, 1979", "2018-01-24 19:51 CST", "3104"]
)
def test_what_is_no_date_stays_as_it_is(text):
    assert iso_date(text) == text == day_of(text)
