"""Formats of single networks: DYNA and AFAD, RESORCE, ESD, CWB, UNAM, JMA, CSMNC, GeoNet, USGS SMC, EMOD3D."""

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.direction import Direction
from rocking.records.formats import text
from rocking.records.formats.format import (
    Format,
    Layout,
    Options,
    check_equal,
    in_blocks,
    key,
    keyed,
    optional,
    optional_number,
    parted,
    site,
    typed_magnitude,
    universal,
)
from rocking.records.formats.text import NUMBER, iso_date
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import agree_with_velocity, refuse_other_quantity
from rocking.remarks import Remark


def _in_zone(time: str, zone: str) -> str:
    """Return a time of a header with the zone that the format gives it, "" where the header gives no time."""
    return f"{time} {zone}" if time else ""


_DYNA = Layout("", keyed(
    samples="NDATA", step="SAMPLING_INTERVAL_S", duration="DURATION_S", component="STREAM", station="STATION_CODE",
    network="NETWORK", latitude="STATION_LATITUDE_DEGREE", longitude="STATION_LONGITUDE_DEGREE",
    elevation="STATION_ELEVATION_M", distance="EPICENTRAL_DISTANCE_KM", high_pass="LOW_CUT_FREQUENCY_HZ",
    peak="PGA_CM/S^2", peak_time="TIME_PGA_S", start="DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS",
    quantity="DATA_TYPE", unit="UNITS",
), peak_unit="cm/s2")  # fmt: skip
_DYNA_END = re.compile(r"(?!AAD_|[A-Z][A-Z0-9_/^]*:)")
_DYNA_FIRST = re.compile(r"(?:AAD_.*\n)*EVENT_NAME:(?:.*\n){1,100}?SAMPLING_INTERVAL_S:")
"""AFAD puts lines AAD_ above a header after filtering the samples anew (Kahramanmaraş 2023)."""
_DYNA_HEADER = 200  # lines of the longest header, of this format and of the next four
_AFAD_HEADER = 40
_RESORCE_HEADER = 20
_CWB_HEADER = 60
_ESD_HEADER = 100
_UNAM_HEADER = 160
_WORD = r"([\w/^*]*)"


def _read_dyna(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _DYNA_END.match, "of numbers", _DYNA_HEADER)
    is_filtered_anew = head.startswith("AAD_")
    head = re.sub("^AAD_", "", head, flags=re.M)
    date = iso_date(optional(key("EVENT_DATE_YYYYMMDD"), head))
    scales = f"Mw={optional(key('MAGNITUDE_W'), head)} ML={optional(key('MAGNITUDE_L'), head)}"
    facts: dict[str, Any] = typed_magnitude(scales)
    facts["event"] = f"{optional(key('EVENT_NAME'), head)} {date}"
    facts["event_time"] = f"{date} {optional(key('EVENT_TIME_HHMMSS'), head)}"
    if is_filtered_anew:  # the peak that the header states is that of the samples before
        facts["peak"] = 0.0
    return _DYNA.series(head, rows, options, **facts)


_AFAD = Layout("gal", keyed(
    samples="NUMBER OF DATA", step="SAMPLING INTERVAL (SEC)", station="STATION ID", event="EARTHQUAKE DATE",
    event_time="EARTHQUAKE DATE", magnitude="EARTHQUAKE MAGNITUDE", place="STATION COORDINATES",
    elevation="STATION ALTITUDE (M)",
), half_digit=5e-7, code="TK")  # fmt: skip


def _directions(line: str) -> list[str]:
    """Return the names of the columns that `line` heads, all of them directions, or none."""
    labels = line.split()
    return labels if len(labels) > 1 and all(Direction.of(label).is_known for label in labels) else []


def _read_afad(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _directions, "names the columns (N-S, E-W, U-D)", _AFAD_HEADER)
    labels = _directions(rows[0])
    table = text.table(rows[1:], len(labels))
    _, notes = text.whole(table[:, 0], _AFAD.count(head), per_line=1)
    line = optional(r"^(.*PGA.*:.*)", head)
    peaks = [optional_number(rf"\({re.escape(label)}\)\s*({NUMBER})", line) for label in labels]
    is_processed = "RAW" not in line
    return _AFAD.channels(head, table, labels, options, peaks=peaks, warnings=notes, processed=is_processed)


_RESORCE_TITLE = re.compile(r"(Acc[a-z]*tion|Velocity|Displacement) time series in (\S+)", re.I)
_RESORCE_FIRST = re.compile(
    rf"Event Date & Time(?:.*\n){{1,{_RESORCE_HEADER}}}?(?i:{_RESORCE_TITLE.pattern})"
)
_RESORCE = Layout("m/s2", {"network": r"^Network\s*:\s*(\S+)", "quantity": r"^(\w+) time series in \S"} | keyed(
    samples="NUMBER OF DATA", step="TIME INCREMENT (S)", component="ORIENTATION", station="STATION CODE / NAME",
    event="EVENT DATE & TIME", event_time="EVENT DATE & TIME", high_pass="FILTER CUT-OFF FREQUENCY (HZ)",
    peak="PGA (M/S/S)",
), per_line=5, width=14)  # fmt: skip


def _read_resorce(content: bytes, options: Options) -> list[Accelerogram]:
    title = "names the time series and its unit"
    head, rows = parted(content, _RESORCE_TITLE.match, title, _RESORCE_HEADER)
    return _RESORCE.series(f"{head}\n{rows[0]}", rows[1:], options)


_ESD_SECTION = re.compile(r"[ \t]*->[ \t]*(un)?corrected[ \t]+(\w+)", re.I)
_ESD_FIRST = re.compile(
    rf"[ \t]*file:.*\n[ \t]*earthquake code:(?:.*\n){{1,{_ESD_HEADER}}}?{_ESD_SECTION.pattern}", re.I
)
_ESD = Layout("m/s2", {
    "unit": r"^[ \t]*units:[ \t]*([^,;\s]+)", "high_pass": r"band-?pass[ -]?filter[ ]*\(([\d.]+)",
    "corrected": r"^[ \t]*->[ \t]*(corrected)", "step": key("SAMPLING PERIOD", r"([\d.]+)"),
    "duration": key("RECORD LENGTH", r"([\d.]+)"),
} | keyed(
    samples="NUMBER OF SAMPLES", component="ORIENTATION OF TRANSDUCER", station="STATION CODE", event="EARTHQUAKE CODE",
), per_line=10, width=13)  # fmt: skip
_ESD_START = re.compile(r"(?im)^[ \t]*time of first sample:[ \t]*(\d\d)\.(\d\d)\.(\d{4}) +([\d:.]+) *UTC")


def _read_esd(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _ESD_SECTION.match, "that begins with ->", _ESD_HEADER)
    begins = [at for at, row in enumerate(rows) if row.lstrip().startswith(("->", "STOP"))]
    ends = [*begins[1:], len(rows)]
    sections = [rows[begin:end] for begin, end in zip(begins, ends, strict=True)]
    of_motion = [lines for lines in sections if re.match(r"\s*-> *corrected acc", lines[0], re.I)]
    if len(of_motion) != 1:
        held = ", ".join(lines[0].strip(" \t->")[:40] for lines in sections)
        raise RecordError.naming(
            "quantity", held, f"the file holds {held}; use the file of corrected acceleration (.cor)."
        )
    (title, *numbers) = of_motion[0]
    start = _ESD_START.search(head)
    facts = {"start_time": universal("{2}-{1}-{0} {3}".format(*start.groups()), 0.0)} if start else {}
    (record,) = _ESD.series(f"{head}\n{title}", numbers, options, **facts)
    velocity = [lines[1:] for lines in sections if re.match(r"\s*-> *corrected vel", lines[0], re.I)]
    return [agree_with_velocity(record, text.fields(velocity[0], 13)) if velocity else record]


_CWB = Layout("gal", {"unit": key("AMPLITUDEUNIT", _WORD)} | keyed(
    duration="RECORDLENGTH(SEC)", rate="SAMPLERATE(HZ)", station="STATIONCODE",
    event_time="ORIGIN TIME(GMT+08)", latitude="STATIONLATITUDE(N)", longitude="STATIONLONGITUDE(E)",
    channels="DATASEQUENCE",
), mandatory=("duration", "rate"), duration_digits=0.0, half_digit=5e-4, code="TW")  # fmt: skip


def _read_cwb(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, re.compile("#Data:").match, "begins with #Data:", _CWB_HEADER)
    head = re.sub("^#", "", head, flags=re.M)
    labels = re.findall(r"([A-Z])\(", _CWB.required("channels", head))
    scales = re.findall(r"^Magnitude\((\w+)\)(:.*)", head, re.I | re.M)  # lines like "Magnitude(Mw):7.6"
    facts = typed_magnitude(" ".join(scale + value for scale, value in scales))
    lines = (optional(rf"^.*MAX.*\b{label}\s*:(.*)", head) for label in labels)
    extremes = (re.findall(NUMBER, line, re.I) for line in lines)  # the greatest and the least
    facts["peaks"] = [max((abs(float(each)) for each in two), default=None) for two in extremes]
    facts["event_time"] = _in_zone(_CWB.text("event_time", head), "+08:00")
    facts["event"] = facts["event_time"]

    table = text.table(rows[1:], len(labels) + 1, width=10)
    times = table[:, 0]
    samples = table[:, 1:]
    return _CWB.channels(head, samples, labels, options, step=text.only_even_step(times), **facts)


_UNAM = Layout("gal", {
    "place": r"^COORDENADAS DE LA ESTACION\s*:(.*\n.*)", "unit": key("UNIDADES DE LOS DATOS", _WORD),
} | keyed(
    samples="NUM. TOTAL DE MUESTRAS", step="INTERVALO DE MUESTREO", duration="DURACION DEL REGISTRO (S)",
    station="CLAVE DE LA ESTACION", event="FECHA DEL SISMO [GMT]", magnitude="MAGNITUD(ES)", elevation="ALTITUD (MSNM)",
    peak="ACEL. MAX.(GAL)", orientation="ORIENTACION",
), half_digit=5e-5)  # fmt: skip
_DATA = "DATOS DE ACELERACION"
_RULE = re.compile(r"[-+]{20,}")
_OF_CHANNELS = re.compile(r"^(.*?),? C(?:1-C6|(7-C12)).*?:(.*)")
_REPEATED = 2  # surplus lines that some files of the network end in


def _read_unam(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, re.compile(_DATA, re.I).match, f"begins with {_DATA}", _UNAM_HEADER)
    rules = [i for i, line in enumerate(rows[:10]) if _RULE.match(line)]
    if len(rules) < 2:
        raise RecordError.naming("header", _DATA, f"no heading {_DATA} above two rules; the file is cut.")
    every = (_of_channel(head.split("\n"), channel) for channel in range(12))
    heads = [own for own in every if _UNAM.text("orientation", own).strip(" ;")]
    sizes = sorted({_UNAM.text("samples", own) for own in heads} - {""})
    if len(sizes) != 1:
        raise RecordError.naming(
            "samples", sizes, f"the channels declare {sizes} samples, but must be equally long."
        )
    samples = text.count("NUM. TOTAL DE MUESTRAS", sizes[0])
    width = optional_number(r"^FORMATO DATOS.*\d+F(\d+)", head)
    table = text.table(rows[rules[1] + 1 :], len(heads), max(1, int(width or 10)))
    table, notes = _without_repeats(table, samples)
    _, surplus = text.whole(table[:, 0], samples, per_line=1)
    channels = zip(heads, table.T, strict=True)
    return [_unam_channel(own, values, options, notes + surplus) for own, values in channels]


def _unam_channel(head: str, values: np.ndarray, options: Options, notes: tuple[Remark, ...]) -> Accelerogram:
    step = text.number("INTERVALO DE MUESTREO", _UNAM.required("step", head))
    keys = "VEL. DE MUESTREO", "FACTOR DE DECIMACION", "ACEL. MAX."
    rate, decimation, place = (optional_number(key(name) + "$", head) for name in keys)
    if rate is not None:
        check_equal("the interval", step, (decimation or 1.0) / max(1e-9, rate))
    parts = [part.strip() for part in _UNAM.text("orientation", head).split(";") if part.strip()]
    directions = (part for part in parts if Direction.of(part).is_known)
    facts: dict[str, Any] = {"warnings": notes}
    if place is not None:  # the number of a sample; what is not whole is a time
        facts["peak_time"] = (place - 1) * step if place == int(place) else place
    # Some of the network's members cut the peak off instead of rounding it.
    printed = _UNAM.text("peak", head).split()
    facts["peak_digit"] = 10.0 ** -len(printed[0].partition(".")[2]) if printed else 0.0
    # Of bearing and sense, "N90E;" or "V;+", one may be blank.
    facts["component"] = next(directions, parts[-1])
    origin = _in_zone(optional(key("HORA EPICENTRO (GMT)"), head), "GMT")
    facts["event_time"] = f"{_UNAM.text('event', head)} {origin}"
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


def _without_repeats(table: np.ndarray, declared: int) -> tuple[np.ndarray, tuple[Remark, ...]]:
    """Return `table` without one or two surplus lines at its end that repeat the lines before, and a warning if so."""
    surplus = len(table) - declared
    if not 1 <= surplus <= _REPEATED or declared < 2:
        return table, ()
    last = table[declared:]
    before = table[declared - surplus : declared]
    if not (np.array_equal(last, before) or np.all(last == table[declared - 1])):
        return table, ()
    remark = Remark.of(RecordKind.LINE_SURPLUS, declared=declared)
    if surplus > 1:
        remark = Remark.of(RecordKind.LINES_SURPLUS, declared=declared, lines=surplus)
    return table[:declared], (remark,)


_JMA = Layout("", {
    "rate": r"^\s*SAMPLING RATE\s*=\s*([\d.]+)\s*Hz", "station": r"^SITE CODE=\s*([\x21-\x7e]+)",
    "latitude": r"^\s*LAT\.=\s*(.*)", "longitude": r"^\s*LON\.=\s*(.*)", "unit": r"^\s*UNIT\s*=\s*(\w+)",
    "start": r"^\s*INITIAL TIME\s*=\s*([\d ]+)", "magnitude": r"^SITE CODE=(?:[^,]*,){4}\s*([\d.]+)",
}, ahead=9.0, code="JMA")  # fmt: skip
_JMA_HEADER = 7
_JMA_NAMES = "NS,EW,UD"
_JMA_FIRST = re.compile(rf"SITE CODE=(?:.*\n){{6}}[ \t]*{_JMA_NAMES}[ \t]*(?:\n|\Z)")


def _read_jma(content: bytes, options: Options) -> list[Accelerogram]:
    """The header gives no number of samples."""
    head, rows = parted(content, _JMA_HEADER)
    labels = _JMA_NAMES.split(",")
    if broken := next((row for row in rows if row.strip() and row.count(",") != len(labels) - 1), ""):
        raise RecordError.naming(
            "samples",
            broken,
            f"a line of the samples is {broken[:40]!r}, but must hold {len(labels)} numbers.",
        )
    table = text.table([row.replace(",", " ") for row in rows], len(labels))
    return _JMA.channels(head, table, labels, options)


_CSMNC = Layout("cm/s2", {
    "samples": r"^NO\. OF POINTS:\s*(\S+)", "step": r"EQUALLY SPACED INTERVALS OF:\s*(\S+)",
    "duration": r"\bDURATION:\s*([\d.]+)", "component": r"^COMP\.\s*(\S+)", "station": r"^STATION:\s*(\S+)",
    "event": r"\A(?:.*\n){2}[ \t]*(.{,60})", "event_time": r"^\d+ +(\d{4}-\d\d-\d\d [\d:]+ \w+)",
    "magnitude": r"^MAGNITUDE\s+([\d.]+.*)", "place": r"^STATION:\s*\S+\s+(.*)",
    "peak": r"^PEAK VALUE:\s*(-?[\d.]+)", "peak_time": r"^PEAK VALUE:.*?\bAT\s+([\d.]+)\s*SEC",
    "corrected": r"^(CORRECTED) ", "quantity": r"^(?:UN)?CORRECTED (\w+)\s+UNIT:",
    "unit": r"^(?:UN)?CORRECTED \w+\s+UNIT:\s*(\S+)",
}, duration_digits=1.0, per_line=8, width=13)  # fmt: skip
_CSMNC_HEADER = 16
_CSMNC_FIRST = re.compile(r"(?=(?:.*\n){0,15}NO\. OF POINTS:)(?:.*\n){0,15}OBSERVING POINT:")


def _read_csmnc(content: bytes, options: Options) -> list[Accelerogram]:
    return _CSMNC.series(*parted(content, _CSMNC_HEADER), options)


_GEONET = Layout("mm/s2", {
    "samples": r"^Number of points\s+(\S+)", "step": r"(?:intervals of|data at)\s+([\d.]+)\s*s",
    "duration": r"\bDuration\s+([\d.]+)", "component": r"^Component\s+(\S+)", "station": r"^Site\s+(\S+)",
    "event": r"^(\d{4} \w+ \d+)\s", "event_time": r"^(\d{4} \w+ \d+\s+[\d:]+(?: UT)?)", "place": r"^Site\s+\S+\s+(.*)",
    "magnitude": r"^Epicentre\b.*\b(M[A-Za-z]?\s+[\d.]+)", "distance": r"^Epicentre\b.*\bDist\s+([\d.]+)\s*km",
    "high_pass": r"transition bands are\s+([\d.]+)", "peak": r"^Acceleration:\s+peak\s+(\S+)\s+mm/s/s",
    "peak_time": r"^Acceleration:\s+peak\s+\S+\s+mm/s/s at\s+([\d.]+)\s*s", "corrected": r"\A(corrected)",
    "rms": r"^Acceleration:.*\brms\s+([\d.]+)",
}, mandatory=("peak",), code="NZ")  # fmt: skip
_GEONET_BLOCK = re.compile(r"(Un)?corrected accelerogram\s", re.I)
_GEONET_FIRST = re.compile(rf"(?i:{_GEONET_BLOCK.pattern}).*\nSite ")
_TEXT = 16
_HEADER = 26
_PER_LINE = 10
_WIDTH = 8
_PREPENDED = 31
"""Place in the integer header of the number of samples put before the first digitised one, from which times count.

After GNS accelerogram data files, Standard Format (2008).
"""


def _geonet_channel(block: list[str], options: Options, total: int) -> Accelerogram:
    note = Remark.of(RecordKind.CHANNELS_OF_GEONET, held=total)
    head = "\n".join(block[:_TEXT])
    samples = _GEONET.count(head)
    rows = [row for row in block[_HEADER:] if row.strip()]
    # A corrected file goes on with velocity and displacement.
    size = len(rows) // 3 if len(rows) == 3 * -(-samples // _PER_LINE) else len(rows)
    values = text.filled(rows[:size], samples, _PER_LINE, _WIDTH)
    unit = optional(r"readings in units of\s+([\d.]+)\s*mm/s/s", head) or "1"
    factor = text.number("raw unit", unit)
    integers = " ".join(block[_TEXT : _TEXT + 4]).split()
    at = _GEONET.number("peak_time", head)
    if at is not None and len(integers) == 40 and integers[_PREPENDED].isdecimal():
        at += int(integers[_PREPENDED]) * text.number("the step", _GEONET.required("step", head))
    notes = (note,) if total % 3 else ()
    record = _GEONET.channel(head, values * factor, options, warnings=notes, peak_time=at)
    if size == len(rows):
        return record
    return agree_with_velocity(record, text.filled(rows[size : 2 * size], samples, _PER_LINE, _WIDTH) / 1000)


_SMC = Layout("cm/s2", {
    "component": r"component\s*=\s*(\S+)", "station": r"station\s*=\s*(.*?)\s*component",
    "event": r"^\s+\d{4}\s+\d+\s+\d+\s+\d{4}\s+(.*)$", "distance": r"epicentral dist\s*=\s*([\d.]+)",
    "corrected": r"\A(2) ", "event_time": r"^\s+(\d{4}\s+\d+\s+\d+\s+\d{4}) ",
})  # fmt: skip
_SMC_FIRST = re.compile(
    r"(?i)[0-6] (UNKNOWN|(UN)?CORRECTED ACC|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)(?:.*\n){11}"
    r"[ \t]*(?:\S+[ \t]+){7}\S+[ \t]*(?:\n|\Z)"
)
"""The first line, and below ten more the first one of integers."""
_SMC_TEXT = 11
_SMC_INTEGERS = 6  # lines below the text at which the integers of the header end
_SMC_REALS = 16  # and the reals
_COMMENTS = 15
_SAMPLES = 16
_RATE = 1  # places in the real header; the time of an extreme stands before its value
_LARGEST = 29
_SMALLEST = 31
_CORNER = 32
_PLACE = slice(10, 13)  # places in the real header of latitude, longitude and elevation of the station
_MISSING = 1.69e38


def _read_smc(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _SMC_TEXT)
    kind = head.partition("\n")[0].strip()
    if kind[:1] not in ("0", "1", "2"):
        raise RecordError.naming(
            "quantity", kind, f"this SMC file is of kind {kind[:40]!r}, not of acceleration."
        )
    integers = text.fields(rows[:_SMC_INTEGERS], 10)
    reals = text.fields(rows[_SMC_INTEGERS:_SMC_REALS], 15)
    if integers.size < 48 or reals.size < 50:
        raise RecordError.naming(
            "header",
            (integers.size, reals.size),
            f"the header holds {integers.size} integers and {reals.size} reals, not 48 and 50.",
        )
    counts = (f"{integers[at]:.0f}" for at in (_COMMENTS, _SAMPLES))
    remarks, samples = (text.count("a count in the header", size) for size in counts)
    first = _SMC_REALS + remarks
    body = [row for row in rows[first:] if row.strip()]
    is_film = kind[:1] == "1"
    seam = next((at for at, row in enumerate(body) if row.startswith("|")), None) if is_film else None
    own = body if seam is None else body[:seam]
    if any(not row.startswith("|") for row in rows[_SMC_REALS:first]) or any(row[0] == "|" for row in own):
        raise RecordError.naming(
            "comments", remarks, f"the header declares {remarks} lines of comment, but others begin with |."
        )
    width = text.column_width(own[0]) if own else 10
    numbers = text.fields(own, width)
    if is_film and (points := _smc_points(numbers, samples, is_cut=seam is not None)) is not None:
        times, values, notes = points
        return [_SMC.through(head, times, values, options, warnings=notes, **_smc_facts(head, reals))]
    rate = float(reals[_RATE])
    if not 0 < rate < 1e6:
        raise RecordError.naming(
            "rate", rate, f"samples per second is {rate:g}, but must be greater than 0 and below 1e6."
        )
    values, notes = text.whole(numbers, samples, 80 // width)
    return [_SMC.channel(head, values, options, step=1 / rate, warnings=notes, **_smc_facts(head, reals))]


def _smc_facts(head: str, reals: np.ndarray) -> dict[str, Any]:
    """The facts of the real header of an SMC file, as arguments of Layout.channel()."""
    # "Moment Mag=6.7   Ml=6.4" as "Mw=6.7 Ml=6.4".
    scales = optional(r"^Moment (Mag.*)", head).replace("Mag", "Mw")
    facts: dict[str, Any] = typed_magnitude(" ".join(scales.split()))

    place = (real if abs(real) < _MISSING else None for real in reals[_PLACE].tolist())
    facts |= site(*place)

    # The time of an extreme stands before it.
    extremes = [(abs(reals[at]), reals[at - 1]) for at in (_LARGEST, _SMALLEST) if abs(reals[at]) < _MISSING]
    peak, peak_time = max(extremes, default=(None, 0.0))
    facts["peak"] = peak
    facts["peak_time"] = float(peak_time) if 0 < peak_time < _MISSING else None

    corner = reals[_CORNER]
    facts["high_pass_frequency"] = float(corner) if 0 < corner < 100 else None
    return facts


_SMC_TAIL = 8
"""Numbers of a line of four points that stands behind the last one in most files of film, of another trace."""


def _smc_points(
    numbers: np.ndarray, samples: int, is_cut: bool
) -> tuple[np.ndarray, np.ndarray, tuple[Remark, ...]] | None:
    """Return (times s, accelerations, remarks) of points of film, None of an uncorrected file of even samples.

    Every other number of such a file is a time: they rise from first to last, as no acceleration does. The header
    counts points or numbers, without the last line where that is of another trace. is_cut: whether a line of comment
    parted the numbers from more of them. Times are printed so coarsely that some points share one.
    """
    notes: tuple[Remark, ...] = (Remark.of(RecordKind.SEAM_CUT, declared=samples),) if is_cut else ()
    if numbers.size == samples + _SMC_TAIL or numbers.size == 2 * samples + _SMC_TAIL:
        numbers = numbers[:-_SMC_TAIL]
        notes = (Remark.of(RecordKind.SEAM_CUT, declared=samples),)
    is_counted = is_cut or samples in (numbers.size, numbers.size // 2)
    if numbers.size % 2 or numbers.size < 8 or not is_counted:
        return None
    times, values = numbers.reshape(-1, 2).T
    if times[0] < 0 or np.diff(times).min() < 0:
        return None
    instants, place, points = np.unique(times, return_inverse=True, return_counts=True)
    return instants, np.bincount(place, weights=values) / points, notes


_EMOD3D_FIRST = re.compile(
    r"(?i)[ \t]*\S+[ \t]+\S.*\n[ \t]*(\d+)[ \t]+(\d\.\d+e[-+]\d\d)"
    r"([ \t]+-?\d+){2}([ \t]+-?\d\.\d+e[-+]\d\d){4}[ \t]*\n"
)
"""Station and component above number of samples, step, hours and minutes, and four reals."""
_EMOD3D = Layout("", {
    "station": r"\A\s*(\S+)", "component": r"\A\s*\S+\s+(\S+)", "samples": r"^\s*(\d+)\s+\d\.\d+e",
    "step": r"^\s*\d+\s+(\d\.\d+e\S+)",
}, per_line=6)  # fmt: skip


def _read_emod3d(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, 2)
    refuse_other_quantity(options.file, head)
    return _EMOD3D.series(head, rows, options, processed=None)


DYNA = Format(
    "DYNA (ESM, ITACA, AFAD)",
    "ESM and ITACA (ORFEUS, INGV), AFAD",
    "EVENT_NAME: at the start, or below lines AAD_, and SAMPLING_INTERVAL_S: below",
    _DYNA_FIRST,
    _read_dyna,
    "DYNA",
)
AFAD = Format(
    "AFAD/NSMN text",
    "AFAD, Turkey",
    "first line STRONG GROUND MOTION RECORDS OF TURKIYE",
    re.compile(r"STRONG GROUND MOTION RECORDS OF T", re.I),
    _read_afad,
    "AFAD",
)
RESORCE = Format(
    "RESORCE",
    "RESORCE and SHARE, Europe",
    "Event Date & Time at the start and a line that names the time series",
    _RESORCE_FIRST,
    _read_resorce,
    "RESORCE",
)
ESD = Format(
    "ESD",
    "European Strong-Motion Database (ISESD), corrected files",
    "keys file and earthquake code at the start and a line that begins with -> corrected",
    _ESD_FIRST,
    _read_esd,
)
CWB = Format(
    "CWB",
    "Central Weather Bureau, Taiwan",
    "first line #Earthquake Information, or #StationCode: as on the disc of 1999",
    re.compile(r"#(Earthquake Information|StationCode\s*:)"),
    _read_cwb,
    "CWB",
)
UNAM = Format(
    "UNAM/CICESE",
    "Instituto de Ingeniería UNAM and CICESE, Mexico",
    "line ARCHIVO ESTANDAR DE ACELERACION in the first 12",
    re.compile(r"(?i)(?:.*\n){0,11}ARCHIVO ESTANDAR DE ACELERACI"),
    _read_unam,
    "UNAM",
)
JMA = Format(
    "JMA CSV",
    "Japan Meteorological Agency",
    "SITE CODE= at the start and a seventh line NS,EW,UD",
    _JMA_FIRST,
    _read_jma,
)
CSMNC = Format(
    "CSMNC",
    "China Strong Motion Networks Centre",
    "lines OBSERVING POINT: and NO. OF POINTS: in the first 16",
    _CSMNC_FIRST,
    _read_csmnc,
    "CSMNC",
)
GEONET = Format(
    "GeoNet V1A/V2A",
    "GeoNet (GNS Science), New Zealand",
    "first line Corrected or Uncorrected accelerogram above a Site line",
    _GEONET_FIRST,
    in_blocks(_GEONET_BLOCK, _geonet_channel),
    "GEONET",
)
SMC = Format(
    "USGS SMC",
    "U.S. Geological Survey",
    "first line like 2 CORRECTED ACCELEROGRAM above ten text lines and integers",
    _SMC_FIRST,
    _read_smc,
    "USGS_SMC",
)
EMOD3D = Format(
    "EMOD3D text",
    "EMOD3D and ucgmsim, simulated and observed motion",
    "station and component above samples, step and six more numbers",
    _EMOD3D_FIRST,
    _read_emod3d,
)
