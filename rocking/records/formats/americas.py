"""Formats of networks of the Americas: UNAM and CICESE, USGS SMC."""

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.records.direction import Direction
from rocking.records.formats import text
from rocking.records.formats.format import (
    WORD,
    Format,
    Layout,
    Options,
    check_equal,
    key,
    keyed,
    optional,
    optional_number,
    parted,
    site,
    typed_magnitude,
)
from rocking.records.kinds import RecordKind
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

_UNAM = Layout("gal", {
    "place": r"^COORDENADAS DE LA ESTACION\s*:(.*\n.*)", "unit": key("UNIDADES DE LOS DATOS", WORD),
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
    head, rows = parted(content, re.compile(_DATA, re.I).match, f"begins with {_DATA}")
    rules = [i for i, line in enumerate(rows[:10]) if _RULE.match(line)]
    if len(rules) < 2:
        raise RecordError(f"no heading {_DATA} above two rules; the file is cut.", header=_DATA)
    every = (_of_channel(head.split("\n"), channel) for channel in range(12))
    heads = [own for own in every if _UNAM.text("orientation", own).strip(" ;")]
    sizes = sorted({_UNAM.text("samples", own) for own in heads} - {""})
    if len(sizes) != 1:
        raise RecordError(f"the channels declare {sizes} samples, but must be equally long.", samples=sizes)
    samples = text.count("NUM. TOTAL DE MUESTRAS", sizes[0])
    width = optional_number(r"^FORMATO DATOS.*\d+F(\d+)", head)
    table = text.table(rows[rules[1] + 1 :], len(heads), max(1, int(width or 10)))
    table, notes = _without_repeats(table, samples)
    _, surplus = text.whole(table[:, 0], samples, per_line=1)
    channels = zip(heads, table.T, strict=True)
    return [_unam_channel(own, values, options, notes + surplus) for own, values in channels]


def _unam_channel(
    head: str, values: np.ndarray, options: Options, notes: tuple[RockingWarning, ...]
) -> Accelerogram:
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
    origin = optional(key("HORA EPICENTRO (GMT)"), head)
    facts["event_time"] = f"{_UNAM.text('event', head)} {origin and f'{origin} GMT'}"
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


def _without_repeats(table: np.ndarray, declared: int) -> tuple[np.ndarray, tuple[RockingWarning, ...]]:
    """Return `table` without one or two surplus lines at its end that repeat the lines before, and a warning if so."""
    surplus = len(table) - declared
    if not 1 <= surplus <= _REPEATED or declared < 2:
        return table, ()
    last = table[declared:]
    before = table[declared - surplus : declared]
    if not (np.array_equal(last, before) or np.all(last == table[declared - 1])):
        return table, ()
    return table[:declared], (RockingWarning.of(RecordKind.LINES_SURPLUS, declared=declared, lines=surplus),)


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
_RATE = 1  # places in the real header; the time of an extreme precedes its value
_LARGEST = 29
_SMALLEST = 31
_CORNER = 32
_PLACE = slice(10, 13)  # places in the real header of latitude, longitude and elevation of the station
_MISSING = 1.69e38


def _read_smc(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _SMC_TEXT)
    kind = head.partition("\n")[0].strip()
    if kind[:1] not in ("0", "1", "2"):
        raise RecordError(f"this SMC file is of kind {kind[:40]!r}, not of acceleration.", quantity=kind)
    integers = text.fields(rows[:_SMC_INTEGERS], 10)
    reals = text.fields(rows[_SMC_INTEGERS:_SMC_REALS], 15)
    if integers.size < 48 or reals.size < 50:
        raise RecordError(
            f"the header holds {integers.size} integers and {reals.size} reals, not 48 and 50.",
            header=(integers.size, reals.size),
        )
    counts = (f"{integers[at]:.0f}" for at in (_COMMENTS, _SAMPLES))
    comments, samples = (text.count("a count in the header", size) for size in counts)
    first = _SMC_REALS + comments
    body = [row for row in rows[first:] if row.strip()]
    is_film = kind[:1] == "1"
    seam = next((at for at, row in enumerate(body) if row.startswith("|")), None) if is_film else None
    own = body if seam is None else body[:seam]
    if any(not row.startswith("|") for row in rows[_SMC_REALS:first]) or any(row[0] == "|" for row in own):
        raise RecordError(
            f"the header declares {comments} lines of comment, but others begin with |.", comments=comments
        )
    width = text.column_width(own[0]) if own else 10
    numbers = text.fields(own, width)
    if is_film and (points := _smc_points(numbers, samples, is_cut=seam is not None)) is not None:
        times, values, notes = points
        return [_SMC.through(head, times, values, options, warnings=notes, **_smc_facts(head, reals))]
    rate = float(reals[_RATE])
    if not 0 < rate < 1e6:
        raise RecordError(
            f"samples per second is {rate:g}, but must be greater than 0 and below 1e6.", rate=rate
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

    # The time of an extreme precedes it.
    extremes = [(abs(reals[at]), reals[at - 1]) for at in (_LARGEST, _SMALLEST) if abs(reals[at]) < _MISSING]
    peak, peak_time = max(extremes, default=(None, 0.0))
    facts["peak"] = peak
    facts["peak_time"] = float(peak_time) if 0 < peak_time < _MISSING else None

    corner = reals[_CORNER]
    facts["high_pass_frequency"] = float(corner) if 0 < corner < 100 else None
    return facts


_SMC_TAIL = 8
"""Numbers of a line of four points that follows the last one in most files of film, of another trace."""


def _smc_points(
    numbers: np.ndarray, samples: int, is_cut: bool
) -> tuple[np.ndarray, np.ndarray, tuple[RockingWarning, ...]] | None:
    """Return (times s, accelerations, warnings) of points of film, None of an uncorrected file of even samples.

    Every other number of such a file is a time: they rise from first to last, as no acceleration does. The header
    counts points or numbers, without the last line where that is of another trace. is_cut: whether a line of comment
    parted the numbers from more of them. Times are printed so coarsely that some points share one.
    """
    notes: tuple[RockingWarning, ...] = (
        (RockingWarning.of(RecordKind.SEAM_CUT, declared=samples),) if is_cut else ()
    )
    if numbers.size == samples + _SMC_TAIL or numbers.size == 2 * samples + _SMC_TAIL:
        numbers = numbers[:-_SMC_TAIL]
        notes = (RockingWarning.of(RecordKind.SEAM_CUT, declared=samples),)
    is_counted = is_cut or samples in (numbers.size, numbers.size // 2)
    if numbers.size % 2 or numbers.size < 8 or not is_counted:
        return None
    times, values = numbers.reshape(-1, 2).T
    if times[0] < 0 or np.diff(times).min() < 0:
        return None
    instants, place, points = np.unique(times, return_inverse=True, return_counts=True)
    return instants, np.bincount(place, weights=values) / points, notes


UNAM = Format(
    "UNAM/CICESE",
    "Instituto de Ingeniería UNAM and CICESE, Mexico",
    "line ARCHIVO ESTANDAR DE ACELERACION in the first 12",
    re.compile(r"(?i)(?:.*\n){0,11}ARCHIVO ESTANDAR DE ACELERACI"),
    _read_unam,
    "UNAM",
)
SMC = Format(
    "USGS SMC",
    "U.S. Geological Survey",
    "first line like 2 CORRECTED ACCELEROGRAM above ten text lines and integers",
    _SMC_FIRST,
    _read_smc,
    "USGS_SMC",
)
