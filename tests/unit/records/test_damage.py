"""Damage that header or structure tell of: refused or warned of, never read in silence."""

import gzip
import re
import struct

import made_files
import numpy as np
import pytest
from made_files import MADE, STEP, TRUE, N, by_obspy, read_text

from rocking.errors import RecordError, UndeclaredError
from rocking.records import Accelerogram
from rocking.records.formats import Options
from rocking.records.formats.dialect import plain
from rocking.records.formats.format import check_duration
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import agree_with_velocity
from rocking.records.read import LARGEST_FILE, read_content, unpack
from rocking.warnings import Kind, RockingWarning
from tests.refusals import refused


def made(name: str) -> str:
    return MADE[name][0]()


IN_MM = Options(unit="mm/s2")


def test_a_duration_is_checked_to_its_last_digit() -> None:
    """n steps or n - 1, and half of what the print rounds; a tenth of a step more is too much."""
    cases = (0.4, 0.005, 39, 41), (0.4, 0.05, 34, 46), (102, 0.0, 10199, 10201)
    for duration, rounding, low, high in cases:
        for samples in (low, high):
            check_duration(duration, samples, 0.01, 1.001, rounding)
        for samples in (low - 1, high + 1):
            with refused(RecordError, "duration"):
                check_duration(duration, samples, 0.01, 1.001, rounding)


RMS = np.sqrt(np.mean(TRUE**2)) / 9.80665


@pytest.mark.parametrize(("name", "old", "new", "told"), [
    ("CSMIP V1/V2", "123.6W", "123.6W  (3 Chns of  3 at Sta)", RecordKind.CHANNELS_UNLIKE_HEADER),
    # A digit of a scale factor: real headers agree with their samples to 2e-5 beyond their last digit.
    ("K-NET/KiK-net", "2000(gal)", "2010(gal)", RecordKind.PEAK_UNLIKE_HEADER),
    ("K-NET/KiK-net", "2000(gal)", "2001(gal)", None),
    ("RENADIC", "\nRMS\n", f"\nRMS ACCEL OF COMPLETE RECORD ={1.5 * RMS:6.3f} G\n",
     RecordKind.MEAN_SQUARE_UNLIKE_HEADER),
    ("RENADIC", "\nRMS\n", f"\nRMS ACCEL OF COMPLETE RECORD ={RMS:6.3f} G\n", None),
    ("USGS SMC", "station = Made", "station = Made 12th Fl", RecordKind.IN_A_STRUCTURE),
    ("DYNA (ESM, ITACA, AFAD)", "STATION_CODE: X", "STATION_CODE:  12th Fl", RecordKind.IN_A_STRUCTURE),
    ("K-NET/KiK-net", "MADE01", "MADE01 12th Fl", RecordKind.IN_A_STRUCTURE),
    ("PEER AT2", "Station", "Station 12th Fl", RecordKind.IN_A_STRUCTURE),
    ("AFAD/NSMN text", "0921", "0921 12th Fl", RecordKind.IN_A_STRUCTURE),
])  # fmt: skip
def test_what_a_header_tells_is_warned_of(name: str, old: str, new: str, told: Kind | None) -> None:
    warnings = read_text(made(name).replace(old, new, 1))[0].warnings
    assert told in {warning.kind for warning in warnings} if told else not warnings


@pytest.mark.parametrize(("name", "old", "new"), [
    ("DYNA (ESM, ITACA, AFAD)", "UNITS", f"DURATION_S: {2 * N * STEP}\nUNITS"),
    ("GeoNet V1A/V2A", "    Duration", f"    Duration {2 * N * STEP:.2f} s"),
    ("CSMNC", " SEC\nPRE-EVENT", f" SEC    DURATION: {2 * N * STEP:.2f} SEC\nPRE-EVENT"),
    ("UNAM/CICESE", f"/{N * STEP:.2f}/{N * STEP:.2f}", f"/{2 * N * STEP:.2f}/{2 * N * STEP:.2f}"),
    ("UNAM/CICESE", "/100/100", "/200/200"),
    ("CWB", "SampleRate(Hz): 100", "SampleRate(Hz): 50"),
    ("CSMIP V1/V2: of 1983", "INTERVALS OF    0.010", "INTERVALS OF    0.020"),
    ("CSMIP V1/V2: of 1983", f"  {N} POINTS OF INSTRUMENT", f"  {N + 8} POINTS OF INSTRUMENT"),
    ("USC Volume 2", "INTERVALS OF    0.010", "INTERVALS OF    0.020"),
    ("USC Volume 2", f"  {N}  INSTRUMENT", f"  {N + 8}  INSTRUMENT"),
    ("CSMIP V1/V2: raw", f"LENGTH = {N * STEP:.3f}", f"LENGTH = {2 * N * STEP:.3f}"),
    ("RENADIC", f"LENGTH = {N * STEP:.3f}", f"LENGTH = {2 * N * STEP:.3f}"),
    ("USC Volume 1", f"LENGTH = {N * STEP:.3f}", f"LENGTH = {2 * N * STEP:.3f}"),
])  # fmt: skip
def test_a_header_that_contradicts_itself_is_refused(name: str, old: str, new: str) -> None:
    text = made(name)
    assert old in text
    with pytest.raises(RecordError) as caught:
        read_text(text.replace(old, new, 1))
    assert caught.value.field in ("duration", "the step", "the interval", "the number of points")


@pytest.mark.parametrize(("name", "old", "new", "named"), [
    ("USGS SMC", "1.0000000E+02", "0.0000000E+00", ("rate", 0.0)),
    ("USGS SMC", "1.0000000E+02", "1.0000000E+06", ("rate", 1e6)),
    ("UNAM/CICESE", f"V\n{'-' * 79}", "V\n", ("header", "DATOS DE ACELERACION")),
    ("UNAM/CICESE", "DATOS DE ACELERACION:", "DATOS:", ("header", "begins with DATOS DE ACELERACION")),
    ("RENADIC", "/&  END OF DATA\n", "/&  END OF DATA\nmore\n", ("lines", 1)),
    ("BHRC", "0.400", "9" * 60, ("time_step", 2.5e58)),
])  # fmt: skip
def test_what_no_recorder_writes_is_refused_by_name(name: str, old: str, new: str, named: tuple) -> None:
    text = made(name)
    assert old in text
    with refused(RecordError, *named):
        read_text(text.replace(old, new, 1))


def test_the_rate_of_bhrc_is_held_against_its_step() -> None:
    for rate, told in (
        ("    50.000", RockingWarning.of(RecordKind.RATE_UNLIKE_STEP, rate_hz=50.0, time_step_s=0.01)),
        ("    ******", RockingWarning.of(RecordKind.RATE_NO_NUMBER, rate="******")),
        ("     0.500", None),  # no rate of a recorder
    ):
        assert read_text(made("BHRC").replace("   100.000", rate, 1))[0].warnings == ((told,) if told else ())


@pytest.mark.parametrize(("text", "declared", "named"), [
    ("0\n1\n2\n3\n", {"unit": "g", "time_step": 1e-8}, ("time_step", 1e-8)),
    ("0\n1\n2\n3\n", {"unit": "g", "time_step": 20.0}, ("time_step", None)),
    ("t,a (g)\n0,1\n1e-8,2\n2e-8,3\n3e-8,1\n", {}, ("times",)),
    ("t,a (g)\n0,1\n1,2\n1,3\n2,1\n", {}, ("times", 1.0)),
    ("t,NS,EW (g)\n0,1,2\n0.01,2,3\n0.02,1\n", {}, ("columns", 2)),
    (made("PEER AT2").partition("NPTS")[0] + "NPTS= 3, DT= 0.01 SEC\n1 2-3\n", {}, ("samples", None)),
    ("", {}, ("size", 0)),
])  # fmt: skip
def test_a_text_without_times_or_numbers_of_a_record_is_refused_by_name(
    text: str, declared: dict, named: tuple
) -> None:
    with refused(RecordError, *named):
        read_text(text, **declared)


def test_cosmos_has_the_step_of_its_series() -> None:
    """Real value 34 is the recorder's step, 62 that of the series in ms (COSMOS format 1.20): one may be resampled."""
    text = made("COSMOS V1/V2")
    assert f"{STEP / 2:13.6f}" in text and read_text(text)[0].time_step == STEP
    (record,) = read_text(text.replace(f"{1000 * STEP:13.6f}", f"{-999:13.6f}", 1))
    assert record.time_step == STEP / 2
    assert RockingWarning.of(RecordKind.LENGTH_UNLIKE_HEADER, stated_s=0.4, lasts_s=0.2) in record.warnings


@pytest.mark.parametrize(("name", "old", "new"), [
    ("DYNA (ESM, ITACA, AFAD)", r"TIME_PGA_S: [\d.]+", "TIME_PGA_S: {:.3f}"),
    ("GeoNet V1A/V2A", r"mm/s/s at [\d.]+ s", "mm/s/s at {:.3f} s"),
    ("CSMNC", r"AT [\d.]+ SEC", "AT {:.3f} SEC"),
    ("CSMIP V1/V2", r"at  [\d.]+ sec", "at  {:.3f} sec"),
    ("USC Volume 2", r"SEC AT    [\d.]+ ", "SEC AT    {:.3f} "),
    ("COSMOS V1/V2", r"(10\.000000 +0\.400000 +[-\d.]+) +[\d.]+", r"\1{:13.6f}"),
    ("USGS SMC", r"5\.0000000E-02", "{:.7E}"),
    ("UNAM/CICESE", r"MUESTRA( +): /\d+/", r"MUESTRA\1: /{1:.0f}/"),  # the number of a sample, from 1 on
    ("UNAM/CICESE", r"MUESTRA( +): /\d+/", r"MUESTRA\1: /{0:.3f}/"),  # what is not whole is a time
])  # fmt: skip
def test_a_peak_out_of_its_place_is_warned_of(name: str, old: str, new: str) -> None:
    """Lines missing in one place and repeated in another leave the count as it was, not the time of the peak."""
    place = float(np.abs(TRUE).argmax()) * STEP
    text = made(name)

    def told(at: float) -> tuple[RockingWarning, ...]:
        return read_text(re.sub(old, new.format(at, at / STEP + 1), text, count=1))[0].warnings

    known = set(told(place))
    assert RecordKind.PEAK_ELSEWHERE not in {part.kind for part in known}
    (new_one,) = set(told(place + 12 * STEP)) - known
    assert new_one.kind is RecordKind.PEAK_ELSEWHERE
    assert (new_one["stated_s"], new_one["time_s"]) == pytest.approx((place + 12 * STEP, place))


def test_a_volume_2_whose_velocity_states_no_unit_is_read_without_that_check() -> None:
    text = made("USC Volume 2")
    announced = f"{N} POINTS OF VEL DATA EQUALLY SPACED AT   {STEP:.3f} SEC."
    assert f"{announced}  IN UNITS CM/SEC\n" in text
    (record,) = read_text(text.replace(f"{announced}  IN UNITS CM/SEC\n", f"{announced}\n"))
    assert record.acceleration == pytest.approx(TRUE, abs=1e-5)


COUNTS = np.round(1e4 * np.sin(np.arange(4000) / 30)).astype(np.int32)


@pytest.mark.parametrize(("word", "field"), [(1, "depmin"), (2, "depmax"), (6, "e"), (56, "depmen")])
def test_sac_is_held_to_its_extremes_and_its_end(word: int, field: str) -> None:
    """Words 1, 2, 6 and 56 of the header are DEPMIN, DEPMAX, E and DEPMEN (SAC manual)."""
    content = bytearray(by_obspy("SAC", (COUNTS / 1e4).astype(np.float32)))
    assert read_content(bytes(content), "made", Options(unit="m/s2"))
    with refused(UndeclaredError, "unit"):
        read_content(bytes(content), "made", Options())
    (value,) = struct.unpack_from("<f", content, 4 * word)
    struct.pack_into("<f", content, 4 * word, 1.01 * value + (word == 56))
    with refused(RecordError, field):
        read_content(bytes(content), "made", Options(unit="m/s2"))


def test_the_peak_is_looked_at_before_a_mean_is_removed() -> None:
    """Counts around 9000 m/s² would seem a record of 1 m/s² once their mean is gone."""
    with refused(RecordError, "mean"):
        read_content(by_obspy("SAC", (9000 + COUNTS / 1e4).astype(np.float32)), "made", Options(unit="m/s2"))


def test_miniseed_cut_within_a_record_is_refused() -> None:
    """Also one of records of two lengths."""
    short, long = (by_obspy("MSEED", COUNTS, reclen=size, encoding="STEIM2") for size in (512, 4096))
    assert read_content(short, "made", IN_MM)[0].acceleration.size == 4000
    mixed = long + by_obspy("MSEED", COUNTS[:200], reclen=512)
    assert read_content(mixed, "made", IN_MM)
    for cut in (short[:-1], short[:-100], short[:-511], mixed[:-1]):
        with refused(RecordError, "record"):
            read_content(cut, "made", IN_MM)


def test_miniseed_blocks_that_come_twice_are_told() -> None:
    """The last blocks overwritten by earlier ones: the record is shorter, without a gap."""
    content = by_obspy("MSEED", COUNTS, reclen=512, encoding="STEIM2")
    whole = read_content(content, "made", IN_MM)[0].warnings
    assert {warning.kind for warning in whole} <= {
        RecordKind.VELOCITY_RARE
    }  # of a tone that is made to be loud
    blocks = [content[i : i + 512] for i in range(0, len(content), 512)]
    (record,) = read_content(b"".join(blocks[:-3] + blocks[:3]), "made", IN_MM)
    assert record.acceleration.size < 4000
    assert RecordKind.BLOCKS_OVERLAP in {warning.kind for warning in record.warnings}
    assert all(
        one_warning["after"] != 1
        for one_warning in record.warnings
        if one_warning.kind is RecordKind.BLOCKS_LEAP
    )
    (record,) = read_content(b"".join([*blocks[:4], *blocks[3:]]), "made", IN_MM)
    assert RockingWarning.of(RecordKind.BLOCKS_LEAP, before=4, after=4) in record.warnings


def test_miniseed_that_fails_its_own_check_is_refused() -> None:
    content = bytearray(by_obspy("MSEED", COUNTS, reclen=512, encoding="STEIM2"))
    content[64 + 80] ^= 0x40  # a difference within the first record: its last sample is not the one it states
    with refused(RecordError, "format", "MSEED"):
        read_content(bytes(content), "made", IN_MM)


def test_miniseed_that_unpacks_to_too_much_is_refused() -> None:
    """Millions of samples of stillness fit into few megabytes; the heads of all blocks tell before one is unpacked."""
    content = by_obspy("MSEED", np.zeros(2_100_000, np.int32), reclen=4096, encoding="STEIM2") * 2
    assert len(content) < LARGEST_FILE
    with refused(RecordError, "samples", 4_200_000):
        read_content(content, "made", Options(unit="gal"))


def test_evt_frames_are_summed_and_in_order() -> None:
    content = made_files.evt()
    frame = (len(content) - 2056) // 4
    first = content[2056 : 2056 + frame]
    flipped = content[:-3] + bytes([content[-3] ^ 1]) + content[-2:]
    swapped = content[:2056] + content[2056 + frame : 2056 + 2 * frame] + first + content[2056 + 2 * frame :]
    last = 2056 + 3 * frame
    for damaged, at in (
        (flipped, last),
        (swapped, 2056 + frame),
        (content[:-20], last),
        (2 * content, len(content)),
        (content + b"more", len(content)),
    ):
        with refused(RecordError, "frame", at):
            read_content(damaged, "made", Options())
    assert read_content(content + b"\0" * 50, "made", Options())[0].acceleration.size == N


def test_every_member_of_a_gzip_file_is_read() -> None:
    text = made("PEER AT2").encode()
    packed = gzip.compress(text[:400]) + gzip.compress(text[400:]) + b"\0" * 100
    assert unpack(packed, "made") == text
    for damaged in (packed + b"more", packed[:-150]):
        with refused(RecordError, "format", "gzip"):
            unpack(damaged, "made")
    with refused(RecordError, "size", LARGEST_FILE + 1):
        unpack(gzip.compress(b"1" * LARGEST_FILE) + gzip.compress(b"2\n"), "made")


@pytest.mark.parametrize("separator", [";", "; ", "\t", "   "])
def test_decimal_commas_are_read_where_something_else_parts_the_columns(separator: str) -> None:
    rows = "".join(f"{i * STEP:.3f}{separator}{v:.5f}\n".replace(".", ",") for i, v in enumerate(TRUE))
    for head in ["", f"Zeit[s]{separator}acc NS (m/s2)\n"][: 1 + bool(separator.strip(" "))]:
        (record,) = read_text(head + rows, unit="m/s2")
        assert record.time_step == STEP and np.abs(record.acceleration - TRUE).max() < 6e-6


@pytest.mark.parametrize("text", [
    "\n".join(f"{v:.4f}".replace(".", ",") for v in TRUE),
    "\n".join(f"{a:.4f},{b:.4f}".replace(".", ",") for a, b in TRUE.reshape(-1, 2)),
    "\n".join(f"{i * STEP:.2f};{v:.4f}".replace("0.", "0,", i % 2) for i, v in enumerate(TRUE)),
])  # fmt: skip
def test_commas_that_may_be_either_are_refused(text: str) -> None:
    """A column of 1800 samples was read as 7200, or as two columns."""
    with pytest.raises(RecordError) as caught:
        read_text(text + "\n", unit="m/s2", time_step=STEP)
    assert caught.value.field in ("decimals", "format")


@pytest.mark.parametrize(("text", "read_as"), [
    ("1,25\n1,50\n1,75\n", None), ("0,1\n2,2\n3,7\n", None), ("3,1\n2,2\n1,7\n", None), ("0,1\n1,2\n", None),
    ("0,1\n1,2\n2,7\n", "0,1\n1,2\n2,7\n"), ("t,a\n1,25\n1,5\n", "t,a\n1,25\n1,5\n"), ("1, 5\n3, 6\n", "1, 5\n3, 6\n"),
    ("0.00,1\n0.01,2\n", "0.00,1\n0.01,2\n"), ("1,5 2.5\n", "1,5 2.5\n"), ("1,5;2.5\n", None),
    ("1,5 2,5\n", "1.5 2.5\n"), (",5;-1,25\n", ".5;-1.25\n"), ("1,5E+1\t-2,5\n", "1.5E+1\t-2.5\n"),
    ('"1,5";" 2,5 "\n', "1.5;2.5\n"), ('"1.000,5";"2,5"\n', '"1.000,5";2.5\n'), ('"a","b"\n', '"a","b"\n'),
    ("1.5D+01 2.5d02\n", "1.5E+01 2.5E02\n"), ("1.D-3\n", "1.E-3\n"), ("A.D. 2.D\n", "A.D. 2.D\n"),
])  # fmt: skip
def test_a_comma_parts_columns_or_decimals_or_may_do_either(text: str, read_as: str | None) -> None:
    """First numbers of rows that rise evenly are times, whose comma parts columns."""
    found = plain(text.encode())
    assert (found and found.decode()) == read_as


def test_a_gap_is_not_bridged_by_a_line() -> None:
    rows = [f"{i * STEP:.3f} {v:.5f}\n" for i, v in enumerate(TRUE)]
    (one,) = read_text("".join(rows[:10] + rows[11:]), unit="m/s2")
    assert one.acceleration.size == N and one.warnings[0].kind is RecordKind.UNEVEN
    with refused(RecordError, "times", (0.09, 0.16)):
        read_text("".join(rows[:10] + rows[16:]), unit="m/s2")


def test_film_is_evened_out_but_for_a_gap_and_its_peak_is_its_own() -> None:
    """Points of film stand where the trace bends; the peak is compared as digitised, not as interpolated."""
    times = np.cumsum(np.where(np.arange(N) % 3, 0.004, 0.013)) - 0.013
    values = TRUE / 0.980665

    def film(times: np.ndarray) -> str:
        pairs = made_files.columns(np.column_stack([times, values]).ravel(), 10, "7.3f")
        text = made_files.csmip_film().replace(made_files.columns(made_files.pairs(), 10, "7.3f"), pairs)
        return text.replace(f"LENGTH = {N * STEP:.3f}", f"LENGTH = {times[-1]:.3f}")

    (record,) = read_text(film(times))
    assert record.time_step == 0.005 and record.warnings[0].kind is RecordKind.UNEVEN_FILM
    even = np.interp(np.arange(record.acceleration.size) * 0.005, np.round(times, 3), TRUE)
    assert np.abs(record.acceleration - even).max() < 1e-3
    with refused(RecordError, "times", (0.134, 0.447)):
        read_text(film(times + 0.3 * (np.arange(N) > 20)))


@pytest.mark.parametrize(("name", "text"), [
    ("kobe.VT2", "1.0\n150.0\n-99.0\n3.0\n"),
    ("made", "velocity in cm/s\n4 0.01\n1.0\n150.0\n-99.0\n3.0\n"),
    ("made", "# velocity, cm/s\n0.00 1.0\n0.01 150.0\n0.02 -99.0\n"),
    ("made", "time,vel NS (cm/s)\n0.00,1.0\n0.01,150.0\n0.02,-99.0\n"),
    ("made", "PEER NGA RECORD\nQuake, 1/2/99, Here, 045\nUNITS OF CM/S\nNPTS= 3, DT= .01 SEC\n1.0 150.0 -99.0\n"),
])  # fmt: skip
def test_a_velocity_file_is_called_so_and_no_unit_is_offered(name: str, text: str) -> None:
    with pytest.raises(RecordError) as caught:
        read_content(text.encode(), name, Options(unit="g"))
    assert "velocity" in str(caught.value.value)
    assert "divided" not in str(caught.value)


def test_of_lines_that_repeat_the_end_no_more_than_two_are_left_out() -> None:
    text = made("UNAM/CICESE")
    with refused(RecordError, "samples", 40):
        read_text(text + 3 * (text.rstrip("\n").rsplit("\n", 1)[1] + "\n"))


def test_channels_have_names_of_their_own() -> None:
    rows = "".join(f"{i / 100},{i % 5},{i % 7},{i % 3}\n" for i in range(9))
    text = f"time,NS (gal),NS (gal),(gal)\n{rows}"
    assert [r.component for r in read_text(text)] == ["NS (channel 1)", "NS (channel 2)", "channel 3"]
    assert [r.azimuth for r in read_text(text)] == [0.0, 0.0, None]


def test_a_velocity_that_contradicts_its_acceleration_is_warned_of() -> None:
    text = made("CSMIP V1/V2: of 1983")
    head, rest = text.split("VELOC DATA EQUALLY", 1)
    velocity = np.array(rest.split("\n", 1)[1].split(f" {N} POINTS", 1)[0].split(), dtype=float)
    before, turned = (made_files.columns(values, 8, "10.3f") for values in (velocity, velocity[::-1]))
    other = text.replace(before, turned)
    assert head and other != text and not read_text(text)[0].warnings
    assert read_text(other)[0].warnings[0].kind is RecordKind.VELOCITY_UNLIKE


def test_a_velocity_that_is_still_but_for_its_last_digit_is_no_damage() -> None:
    """Most of the record rests, so that the usual error of a step is nought, and a few steps are off by rounding."""
    times = np.arange(2000) * 0.01
    pulse = np.sin(9 * times) * np.exp(-times) * (times < 8)
    velocity = np.concatenate([[0.0], np.cumsum((pulse[1:] + pulse[:-1]) / 2) * 0.01])
    record = Accelerogram(pulse, 0.01)
    rounded = np.round(velocity, 5)
    assert agree_with_velocity(record, rounded).warnings == ()
    rounded[1200:] += 2e-4
    (stray,) = agree_with_velocity(record, rounded).warnings
    assert stray.kind is RecordKind.VELOCITY_UNLIKE_THERE
    assert stray["time_s"] == pytest.approx(12, abs=0.02)
