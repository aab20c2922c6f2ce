"""Formats whose header is lines of "KEY: value": DYNA and AFAD, RESORCE, CWB, UNAM."""

import re
from collections.abc import Callable, Sequence
from itertools import takewhile
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import (
    NUMBER,
    Layout,
    check_equal,
    key,
    keyed,
    optional,
    optional_number,
    required,
    typed_magnitude,
)
from rocking.records.formats.sampling import even_step
from rocking.records.formats.text import count, fields, in_columns, lines, number, numbers, whole
from rocking.records.instrument import azimuth, is_vertical, other_quantity

_DYNA = Layout("", keyed(
    samples="NDATA", step="SAMPLING_INTERVAL_S", duration="DURATION_S", component="STREAM", station="STATION_CODE",
    network="NETWORK", latitude="STATION_LATITUDE_DEGREE", longitude="STATION_LONGITUDE_DEGREE",
    elevation="STATION_ELEVATION_M", distance="EPICENTRAL_DISTANCE_KM", high_pass="LOW_CUT_FREQUENCY_HZ",
    peak="PGA_CM/S^2", peak_time="TIME_PGA_S", start="DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS",
), peak_unit="cm/s2", half_digit=5e-4)  # fmt: skip
_DYNA_KEY = re.compile(r"[A-Z][A-Z0-9_/^]*:")
_DYNA_HEADER, _AFAD_HEADER, _RESORCE_HEADER, _CWB_HEADER, _UNAM_HEADER = 100, 40, 20, 60, 160
"""Lines of the longest headers."""
_REFILTERED = "AAD_"
"""What the lines begin with that AFAD puts above a header after filtering the samples anew (Kahramanmaraş 2023)."""


def _refiltered(text: list[str]) -> int:
    return sum(1 for _ in takewhile(lambda line: line.startswith(_REFILTERED), text))


def _place_of(text: Sequence[str], is_sought: Callable[[str], object], what: str) -> int:
    """Return the place of the first line that `is_sought`. Raises RecordError: no line `what`."""
    at = next((i for i, line in enumerate(text) if is_sought(line)), None)
    if at is None:
        raise RecordError(f"no line {what}; the file is cut.")
    return at


def _is_dyna(content: bytes) -> bool:
    text = lines(content, _DYNA_HEADER)
    head = "\n".join(text[_refiltered(text) :])
    return head.startswith("EVENT_NAME:") and "\nSAMPLING_INTERVAL_S:" in head


def _read_dyna(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    anew = _refiltered(text)
    length = anew + sum(1 for _ in takewhile(_DYNA_KEY.match, text[anew : anew + _DYNA_HEADER]))
    head = "\n".join(line.removeprefix(_REFILTERED) for line in text[:length])
    kind = required("DATA_TYPE", key("DATA_TYPE"), head)[1].strip()
    if kind.upper() != "ACCELERATION":
        raise RecordError(f"DATA_TYPE is {kind!r}, but must be ACCELERATION; use the ACC file of the record.")
    values, notes = whole(numbers("\n".join(text[length:])), _DYNA.count(head), per_line=1)
    date = optional(key("EVENT_DATE_YYYYMMDD"), head)
    scales = f"Mw={optional(key('MAGNITUDE_W'), head)} ML={optional(key('MAGNITUDE_L'), head)}"
    facts: dict[str, Any] = {"warnings": notes, **typed_magnitude(scales)}
    facts["event"] = f"{optional(key('EVENT_NAME'), head)} {date}"
    facts["event_time"] = f"{date} {optional(key('EVENT_TIME_HHMMSS'), head)}"
    if anew:  # the peak that the header states is that of the samples before they were filtered anew
        facts["peak"] = 0.0
    unit = required("UNITS", key("UNITS"), head)[1].strip()
    return [_DYNA.channel(head, values, options, unit=unit, **facts)]


_AFAD = Layout("gal", keyed(
    samples="NUMBER OF DATA", step="SAMPLING INTERVAL (SEC)", station="STATION ID", event="EARTHQUAKE DATE",
    event_time="EARTHQUAKE DATE", magnitude="EARTHQUAKE MAGNITUDE", place="STATION COORDINATES",
    elevation="STATION ALTITUDE (M)",
), half_digit=5e-7, code="TK")  # fmt: skip


def _directions(line: str) -> list[str]:
    """Return the names of the columns that `line` heads, all of them directions, or none."""
    labels = line.split()
    return labels if len(labels) > 1 and all(azimuth(x) is not None or is_vertical(x) for x in labels) else []


def _read_afad(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = _place_of(text[:_AFAD_HEADER], _directions, "names the columns (N-S, E-W, U-D)")
    head = "\n".join(text[:at])
    labels = _directions(text[at])
    table = in_columns(numbers("\n".join(text[at + 1 :])), len(labels))
    _, notes = whole(table[:, 0], _AFAD.count(head), per_line=1)
    peaks = optional(r"^(.*PGA.*:.*)", head)
    stated = [optional_number(rf"\({re.escape(label)}\)\s*{NUMBER}", peaks) for label in labels]
    facts: dict[str, Any] = {"warnings": notes, "processed": "RAW" not in peaks, "peaks": stated}
    return _AFAD.channels(head, table, labels, options, **facts)


_RESORCE = Layout("m/s2", {"network": r"^Network\s*:\s*(\S+)"} | keyed(
    samples="NUMBER OF DATA", step="TIME INCREMENT (S)", component="ORIENTATION", station="STATION CODE / NAME",
    event="EVENT DATE & TIME", event_time="EVENT DATE & TIME", high_pass="FILTER CUT-OFF FREQUENCY (HZ)",
    peak="PGA (M/S/S)",
))  # fmt: skip
_RESORCE_TITLE = re.compile(r"(Acc[a-z]*tion|Velocity|Displacement) time series in (\S+)", re.I)
_RESORCE_WIDTH, _RESORCE_PER_LINE = 14, 5


def _is_resorce(content: bytes) -> bool:
    text = lines(content, _RESORCE_HEADER)
    return text[0].startswith("Event Date & Time") and any(map(_RESORCE_TITLE.match, text))


def _read_resorce(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = _place_of(text[:_RESORCE_HEADER], _RESORCE_TITLE.match, "names the time series and its unit")
    kind = text[at].split()[0].lower()
    if not kind.startswith("acc"):
        raise RecordError(f"this RESORCE file holds {kind}, not acceleration; use the .acc file.")
    head = "\n".join(text[:at])
    values, notes = whole(fields(text[at + 1 :], _RESORCE_WIDTH), _RESORCE.count(head), _RESORCE_PER_LINE)
    return [_RESORCE.channel(head, values, options, warnings=notes)]


_CWB = Layout("gal", keyed(
    duration="RECORDLENGTH(SEC)", rate="SAMPLERATE(HZ)", station="STATIONCODE", event="ORIGIN TIME(GMT+08)",
    event_time="ORIGIN TIME(GMT+08)", latitude="STATIONLATITUDE(N)", longitude="STATIONLONGITUDE(E)",
), needed=("duration",), duration_digits=0.0, half_digit=5e-4, code="TW")  # fmt: skip


def _read_cwb(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = _place_of(text[:_CWB_HEADER], re.compile("#Data:").match, "begins with #Data:")
    head = "\n".join(line.removeprefix("#") for line in text[:at])
    unit = optional(key("AMPLITUDEUNIT"), head)
    if not unit.lower().startswith("gal"):
        raise RecordError(f"AmplitudeUnit is {unit!r}, but must be gal.")
    labels = re.findall(r"([A-Z])\(", required("DataSequence", key("DATASEQUENCE"), head)[1])
    table = in_columns(fields(text[at + 1 :], 10), len(labels) + 1)
    step = even_step(table[:, 0])
    rate = number("SampleRate", _CWB.declared("rate", head))
    if step is None or abs(step * rate - 1) > 1e-3:
        raise RecordError(
            f"SampleRate is {rate:g} Hz, but the times are not spaced so; the file is damaged; fetch it again."
        )
    magnitudes = re.findall(r"^Magnitude\((\w+)\)(:.*)", head, re.I | re.M)
    extremes = [re.findall(NUMBER, optional(rf"^.*MAX.*\b{label}\s*:(.*)", head), re.I) for label in labels]
    facts = typed_magnitude(" ".join(scale + value for scale, value in magnitudes))
    facts["peaks"] = [max((abs(float(text)) for text in ends), default=None) for ends in extremes]
    return _CWB.channels(head, table[:, 1:], labels, options, step=step, **facts)


_UNAM = Layout("gal", {"place": r"^COORDENADAS DE LA ESTACION\s*:(.*\n.*)"} | keyed(
    samples="NUM. TOTAL DE MUESTRAS", step="INTERVALO DE MUESTREO", duration="DURACION DEL REGISTRO (S)",
    station="CLAVE DE LA ESTACION", event="FECHA DEL SISMO [GMT]", magnitude="MAGNITUD(ES)", elevation="ALTITUD (MSNM)",
    peak="ACEL. MAX.(GAL)",
), half_digit=5e-5)  # fmt: skip
_DATA = "DATOS DE ACELERACION"
_RULE = re.compile(r"[-+]{20,}")
_OF_CHANNELS = re.compile(r"^(.*?),? C(?:1-C6|(7-C12)).*?:(.*)")
_REPEATED = 2  # surplus lines that some files of the network end in


def _is_unam(content: bytes) -> bool:
    return any(line.startswith("ARCHIVO ESTANDAR DE ACELERACI") for line in lines(content, 12))


def _read_unam(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = _place_of(text[:_UNAM_HEADER], re.compile(_DATA).match, f"begins with {_DATA}")
    rules = [i for i, line in enumerate(text[: _UNAM_HEADER + 10]) if i > at and _RULE.match(line)]
    if len(rules) < 2:
        raise RecordError(f"no heading {_DATA} above two rules; the file is cut.")
    head = text[:at]
    unit = optional(key("UNIDADES DE LOS DATOS"), "\n".join(head))
    if not unit.lower().startswith("gal"):
        quantity = f": a file of {word}" if (word := other_quantity(unit)) else ""
        raise RecordError(f"UNIDADES DE LOS DATOS is {unit!r}, but must be Gal{quantity}.")
    every = (_of_channel(head, channel) for channel in range(12))
    heads = [own for own in every if optional(key("ORIENTACION"), own).strip(" ;")]
    declared = sorted({_UNAM.text("samples", own) for own in heads} - {""})
    if len(declared) != 1:
        raise RecordError(f"the channels declare {declared} samples, but must be equally long.")
    samples = count("NUM. TOTAL DE MUESTRAS", declared[0])
    width = optional_number(r"^FORMATO DATOS.*\d+F(\d+)", "\n".join(head))
    table = in_columns(fields(text[rules[1] + 1 :], max(1, int(width or 10))), len(heads))
    table, notes = _without_repeats(table, samples)
    _, surplus = whole(table[:, 0], samples, per_line=1)
    columns = zip(heads, table.T, strict=True)
    return [_unam_channel(own, values, options, notes + surplus) for own, values in columns]


def _unam_channel(head: str, values: np.ndarray, options: Options, notes: tuple[str, ...]) -> Accelerogram:
    step = number("INTERVALO DE MUESTREO", _UNAM.declared("step", head))
    keys = "VEL. DE MUESTREO", "FACTOR DE DECIMACION", "ACEL. MAX."
    rate, thinned, place = (optional_number(key(name) + "$", head) for name in keys)
    if rate is not None:
        check_equal("the interval", step, (thinned or 1.0) / max(1e-9, rate))
    parts = [part.strip() for part in optional(key("ORIENTACION"), head).split(";") if part.strip()]
    directions = (part for part in parts if azimuth(part) is not None or is_vertical(part))
    facts: dict[str, Any] = {"warnings": notes, "peak_time": None if place is None else (place - 1) * step}
    # Of bearing and sense, "N90E;" or "V;+", one may be blank.
    facts["component"] = next(directions, parts[-1])
    facts["event_time"] = f"{_UNAM.text('event', head)} {optional(key('HORA EPICENTRO (GMT)'), head)}"
    return _UNAM.channel(head, values, options, step=step, **facts)


def _of_channel(head: Sequence[str], channel: int) -> str:
    """Return the header of one of channels 0 to 11: of values like "/V/N00E/N90E", C1-C6 or C7-C12, its own."""
    own = []
    for line in head:
        if match := _OF_CHANNELS.match(line):
            values = [*match[3].split("/")[1:], *[""] * 6]
            if bool(match[2]) == (channel > 5):
                own.append(f"{match[1]}: {values[channel % 6].strip()}")
        else:
            own.append(line)
    return "\n".join(own)


def _without_repeats(table: np.ndarray, declared: int) -> tuple[np.ndarray, tuple[str, ...]]:
    """Return `table` without one or two surplus lines at its end that repeat the lines before, and a warning if so."""
    surplus = len(table) - declared
    if not 1 <= surplus <= _REPEATED or declared < 2:
        return table, ()
    last, before = table[declared:], table[declared - surplus : declared]
    if not (np.array_equal(last, before) or np.all(last == table[declared - 1])):
        return table, ()
    what = "line repeats the end and is" if surplus == 1 else "lines repeat the end and are"
    sentence = f"The header declares {declared} samples; the {surplus} surplus {what} left out."
    return table[:declared], (sentence,)


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
UNAM = Format("UNAM/CICESE", "Instituto de Ingeniería UNAM and CICESE, Mexico",
    "line ARCHIVO ESTANDAR DE ACELERACION in the first 12", _is_unam, _read_unam, "UNAM")  # fmt: skip
