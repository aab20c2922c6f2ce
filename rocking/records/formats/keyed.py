"""Formats whose header is lines of "KEY: value": DYNA and AFAD, RESORCE, CWB, JMA."""

import re
from datetime import datetime, timedelta
from itertools import takewhile

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import (
    check_duration,
    coordinates,
    corner,
    distance,
    mapping,
    numeric,
    optional,
    optional_number,
    place_of,
    required,
    typed_magnitude,
    valued,
)
from rocking.records.formats.sampling import even_step
from rocking.records.formats.text import count, fields, in_columns, is_number, lines, numbers, period, whole
from rocking.records.instrument import azimuth, is_vertical
from rocking.records.plausibility import agree_with_header

_DYNA_KEY = re.compile(r"[A-Z][A-Z0-9_/^]*:")
_DYNA_HEADER, _AFAD_HEADER, _RESORCE_HEADER, _CWB_HEADER = 100, 40, 20, 60
"""Lines of the longest headers."""
_JAPAN = timedelta(hours=9)
_TIME = re.compile(r"(\d{4})/?(\d\d)/?(\d\d)[_ T](\d\d):?(\d\d):?(\d\d(?:\.\d{1,6})?)\d*")
_REFILTERED = "AAD_"
"""What the lines begin with that AFAD puts above a header after filtering the samples anew (Kahramanmaraş 2023)."""


def _is_dyna(content: bytes) -> bool:
    above = takewhile(lambda line: line.startswith(_REFILTERED), lines(content, _DYNA_HEADER))
    head = content[sum(len(line) + 1 for line in above) :][:8000]
    return head.startswith(b"EVENT_NAME:") and b"\nSAMPLING_INTERVAL_S:" in head


def _read_dyna(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    anew = sum(1 for _ in takewhile(lambda line: line.startswith(_REFILTERED), text))
    length = anew + sum(1 for _ in takewhile(_DYNA_KEY.match, text[anew : anew + _DYNA_HEADER]))
    pairs = mapping(text[anew:length]) | mapping([line.removeprefix(_REFILTERED) for line in text[:anew]])
    kind = valued(pairs, "DATA_TYPE")
    if kind.upper() != "ACCELERATION":
        raise RecordError(f"DATA_TYPE is {kind!r}, but must be ACCELERATION; use the ACC file of the record.")
    declared = count("NDATA", valued(pairs, "NDATA"))
    values, notes = whole(numbers("\n".join(text[length:])), declared, per_line=1)
    high_pass = corner(optional_number(r"^\s*([\d.]+)", pairs.get("LOW_CUT_FREQUENCY_HZ", "")))
    start = _TIME.fullmatch(pairs.get("DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS", ""))
    record = options.accelerogram(
        valued(pairs, "UNITS"),
        values,
        numeric(pairs, "SAMPLING_INTERVAL_S"),
        component=pairs.get("STREAM", ""),
        station=pairs.get("STATION_CODE", ""),
        network=pairs.get("NETWORK", ""),
        warnings=notes,
        event=f"{pairs.get('EVENT_NAME', '')} {pairs.get('EVENT_DATE_YYYYMMDD', '')}".strip(),
        start_time="{}-{}-{}T{}:{}:{}Z".format(*start.groups()) if start else "",
        **typed_magnitude(f"Mw={pairs.get('MAGNITUDE_W', '')} ML={pairs.get('MAGNITUDE_L', '')}"),
        event_time=f"{pairs.get('EVENT_DATE_YYYYMMDD', '')} {pairs.get('EVENT_TIME_HHMMSS', '')}".strip(),
        **coordinates(
            f"{pairs.get('STATION_LATITUDE_DEGREE')}N {pairs.get('STATION_LONGITUDE_DEGREE')}E",
            pairs.get("STATION_ELEVATION_M", ""),
        ),
        epicentral_distance=distance(pairs.get("EPICENTRAL_DISTANCE_KM", "")),
        processed=high_pass is not None,
        high_pass_frequency=high_pass,
    )
    if pairs.get("DURATION_S"):
        check_duration("DURATION_S", pairs["DURATION_S"], declared, record.time_step)
    # The peak that the header states is that of the samples before they were filtered anew.
    peak = None if anew else optional_number(r"^\s*(-?[\d.]+)", pairs.get("PGA_CM/S^2", ""))
    at = optional_number(r"^\s*(-?[\d.]+)", pairs.get("TIME_PGA_S", ""))
    return [agree_with_header(record, peak, "cm/s2", half_digit=5e-4, at=at)]


def _directions(line: str) -> list[str]:
    """Return the names of the columns that `line` heads, all of them directions, or none."""
    labels = line.split()
    return labels if len(labels) > 1 and all(azimuth(x) is not None or is_vertical(x) for x in labels) else []


def _read_afad(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    what = f"names the columns (N-S, E-W, U-D) in the first {_AFAD_HEADER}"
    at = place_of(text[:_AFAD_HEADER], _directions, what)
    pairs = mapping(text[:at])
    labels = _directions(text[at])
    table = in_columns(numbers("\n".join(text[at + 1 :])), len(labels))
    declared = count("NUMBER OF DATA", valued(pairs, "NUMBER OF DATA"))
    _, notes = whole(table[:, 0], declared, per_line=1)
    peaks = next((key for key in pairs if "PGA" in key), "")
    records = []
    for component, values in zip(labels, table.T, strict=True):
        record = options.accelerogram(
            "gal",
            values,
            numeric(pairs, "SAMPLING INTERVAL (SEC)"),
            component=component,
            warnings=notes,
            station=pairs.get("STATION ID", ""),
            event=pairs.get("EARTHQUAKE DATE", ""),
            network="TK",
            **typed_magnitude(pairs.get("EARTHQUAKE MAGNITUDE", "")),
            event_time=pairs.get("EARTHQUAKE DATE", ""),
            **coordinates(pairs.get("STATION COORDINATES", ""), pairs.get("STATION ALTITUDE (M)", "")),
            processed="RAW" not in peaks,
        )
        stated = optional_number(rf"\({re.escape(component)}\)\s*(-?[\d.]+)", pairs.get(peaks, ""))
        records.append(agree_with_header(record, stated, "gal", half_digit=5e-7))
    return records


_RESORCE_TITLE = re.compile(r"(Acc[a-z]*tion|Velocity|Displacement) time series in (\S+)", re.I)
_RESORCE_WIDTH, _RESORCE_PER_LINE = 14, 5


def _is_resorce(content: bytes) -> bool:
    text = lines(content, _RESORCE_HEADER)
    return text[0].startswith("Event Date & Time") and any(map(_RESORCE_TITLE.match, text))


def _read_resorce(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = place_of(text[:_RESORCE_HEADER], _RESORCE_TITLE.match, "names the time series and its unit")
    kind = text[at].split()[0].lower()
    if not kind.startswith("acc"):
        raise RecordError(f"this RESORCE file holds {kind}, not acceleration; use the .acc file.")
    pairs = mapping(text[:at])
    declared = count("Number of Data", valued(pairs, "NUMBER OF DATA"))
    values, notes = whole(fields(text[at + 1 :], _RESORCE_WIDTH), declared, _RESORCE_PER_LINE)
    cuts = pairs.get("FILTER CUT-OFF FREQUENCY (HZ)", "")
    record = options.accelerogram(
        "m/s2",
        values,
        numeric(pairs, "TIME INCREMENT (S)"),
        component=pairs.get("ORIENTATION", ""),
        warnings=notes,
        station=pairs.get("STATION CODE / NAME", ""),
        event=pairs.get("EVENT DATE & TIME", ""),
        processed=bool(cuts),
        high_pass_frequency=corner(optional_number(r"^\s*([\d.]+)", cuts)),
    )
    return [agree_with_header(record, optional_number(r"(.*)", pairs.get("PGA (M/S/S)", "")), "m/s2")]


def _read_cwb(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    what = f"#Data: in the first {_CWB_HEADER}"
    at = place_of(text[:_CWB_HEADER], lambda line: line.startswith("#Data:"), what)
    pairs = mapping([line.removeprefix("#") for line in text[:at]])
    unit = valued(pairs, "AMPLITUDEUNIT")
    if not unit.lower().startswith("gal"):
        raise RecordError(f"AmplitudeUnit is {unit!r}, but must be gal.")
    labels = re.findall(r"([A-Z])\(", valued(pairs, "DATASEQUENCE"))
    table = in_columns(fields(text[at + 1 :], 10), len(labels) + 1)
    step = _cwb_step(table[:, 0], pairs)
    extremes = "\n".join(f"{key[-1]}:{value}" for key, value in pairs.items() if "MAX" in key)
    records = []
    for component, values in zip(labels, table.T[1:], strict=True):
        record = options.accelerogram(
            "gal",
            values,
            step,
            component=component,
            station=pairs.get("STATIONCODE", ""),
            event=pairs.get("ORIGIN TIME(GMT+08)", ""),
            network="TW",
            **typed_magnitude(
                " ".join(f"{key[9:]}={text}" for key, text in pairs.items() if key[:9] == "MAGNITUDE")
            ),
            event_time=pairs.get("ORIGIN TIME(GMT+08)", ""),
            **coordinates(f"{pairs.get('STATIONLATITUDE(N)')}N {pairs.get('STATIONLONGITUDE(E)')}E"),
        )
        ends = re.split(r"[~\s:]+", optional(rf"({re.escape(component)}:.*)", extremes))[1:]
        peak = max((abs(float(text)) for text in ends if is_number(text)), default=None)
        records.append(agree_with_header(record, peak, "gal", half_digit=5e-4))
    return records


def _cwb_step(times: np.ndarray, pairs: dict[str, str]) -> float:
    """Return the step of the times, s, after checking it and the length against the header."""
    step = even_step(times)
    rate = numeric(pairs, "SAMPLERATE(HZ)")
    if step is None or abs(step * rate - 1) > 1e-3:
        raise RecordError(f"SampleRate is {rate:g} Hz, but the times are not spaced so; the file is damaged.")
    check_duration("RecordLength(sec)", valued(pairs, "RECORDLENGTH(SEC)"), times.size, step, rounding=0.0)
    return step


_JMA_HEADER, _JMA_NAMES = 7, "NS,EW,UD"


def _is_jma(content: bytes) -> bool:
    return content.startswith(b"SITE CODE=") and lines(content, _JMA_HEADER)[-1].strip() == _JMA_NAMES


def _read_jma(content: bytes, options: Options) -> list[Accelerogram]:
    """Times are Japanese; the header gives no number of samples."""
    text = lines(content)
    head = "\n".join(text[:_JMA_HEADER])
    unit = required("the unit", r"^\s*UNIT\s*=\s*(\w+)", head)[1]
    rate = required("the sampling rate", r"^\s*SAMPLING RATE\s*=\s*([\d.]+)\s*Hz", head)[1]
    begin = optional(r"^\s*INITIAL TIME\s*=\s*([\d ]+)", head)
    rows = text[_JMA_HEADER:]
    labels = _JMA_NAMES.split(",")
    if broken := next((row for row in rows if row.strip() and row.count(",") != len(labels) - 1), ""):
        raise RecordError(f"a line of the samples is {broken[:40]!r}, but must hold {len(labels)} numbers.")
    table = in_columns(numbers("\n".join(rows).replace(",", " ")), len(labels))
    station = optional(r"^SITE CODE=\s*([\x21-\x7e]+)", head)
    try:
        start = f"{(datetime.strptime(begin, '%Y %m %d %H %M %S') - _JAPAN).isoformat()}Z"
    except (ValueError, OverflowError):
        start = ""
    return [
        options.accelerogram(
            unit,
            values,
            period("SAMPLING RATE", rate),
            component=label,
            station=station,
            network="JMA",
            start_time=start,
        )
        for label, values in zip(labels, table.T, strict=True)
    ]


DYNA = Format("DYNA (ESM, ITACA, AFAD)", "ESM and ITACA (ORFEUS, INGV), AFAD",
    "EVENT_NAME: at the start, or below lines AAD_, and SAMPLING_INTERVAL_S: below", _is_dyna, _read_dyna,
    "DYNA")  # fmt: skip
AFAD = Format("AFAD/NSMN text", "AFAD, Turkey", "first line STRONG GROUND MOTION RECORDS OF TURKIYE",
    re.compile(r"STRONG GROUND MOTION RECORDS OF T", re.I), _read_afad, "AFAD")  # fmt: skip
RESORCE = Format("RESORCE", "RESORCE and SHARE, Europe",
    "Event Date & Time at the start and a line that names the time series", _is_resorce, _read_resorce,
    "RESORCE")  # fmt: skip
CWB = Format("CWB", "Central Weather Bureau, Taiwan", "first line #Earthquake Information",
    re.compile(r"#Earthquake Information"), _read_cwb, "CWB")  # fmt: skip
JMA = Format("JMA CSV", "Japan Meteorological Agency",
    "SITE CODE= at the start and a seventh line NS,EW,UD", _is_jma, _read_jma)  # fmt: skip
