"""UNAM (Mexico) standard file of acceleration, version 2, which CICESE writes too: columns in gal."""

import re

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import check_duration, check_equal, mapping, typed_magnitude, valued
from rocking.records.formats.text import count, fields, in_columns, is_number, lines, number, whole
from rocking.records.instrument import azimuth, is_vertical, other_quantity
from rocking.records.plausibility import agree_with_header

_HEADER = 160
_DATA = "DATOS DE ACELERACION"
_RULE = re.compile(r"[-+]{20,}")
_ORIENTATION = "ORIENTACION"
_REPEATED = 2
"""Surplus lines that some files of the network end in."""


def _recognise(content: bytes) -> bool:
    return any(line.startswith("ARCHIVO ESTANDAR DE ACELERACI") for line in lines(content, 12))


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = next((i for i, line in enumerate(text[:_HEADER]) if line.startswith(_DATA)), None)
    rules = [
        i for i, line in enumerate(text[: _HEADER + 10]) if at is not None and i > at and _RULE.match(line)
    ]
    if at is None or len(rules) < 2:
        raise RecordError(
            f"no heading {_DATA} above two rules in the first {_HEADER} lines; the file is cut."
        )
    pairs = mapping(text[:at])
    unit = valued(pairs, "UNIDADES DE LOS DATOS")
    if not unit.lower().startswith("gal"):
        quantity = f": a file of {word}" if (word := other_quantity(unit)) else ""
        raise RecordError(f"UNIDADES DE LOS DATOS is {unit!r}, but must be Gal{quantity}.")
    channels = [i for i, label in enumerate(_listed(pairs, _ORIENTATION)) if label.strip(" ;")]
    table, notes = _table(text[rules[1] + 1 :], pairs, channels)
    return [_record(i, table[:, at], notes, pairs, options) for at, i in enumerate(channels)]


def _table(rows: list[str], pairs: dict[str, str], channels: list[int]):
    """Return (samples (n, channels), warnings)."""
    form = re.search(r"(\d+)F(\d+)", valued(pairs, "FORMATO DATOS (FORTRAN,10 CAMPOS/DATO)"))
    width = max(1, int(form[2])) if form else 10
    values = fields(rows, width)
    table = in_columns(values, len(channels))
    declared = {text for i in channels if (text := _at(pairs, "NUM. TOTAL DE MUESTRAS", i))}
    if len(declared) > 1:
        raise RecordError(
            f"the channels declare {', '.join(sorted(declared))} samples, but must be equally long."
        )
    samples = count("NUM. TOTAL DE MUESTRAS", next(iter(declared), ""))
    table, notes = _without_repeats(table, samples)
    _, surplus = whole(table[:, 0], samples, per_line=1)
    return table, notes + surplus


def _without_repeats(table: np.ndarray, declared: int) -> tuple[np.ndarray, tuple[str, ...]]:
    """Return `table` without one or two surplus lines at its end that repeat the lines before, and a warning if so."""
    surplus = len(table) - declared
    if not 1 <= surplus <= _REPEATED or declared < 2:
        return table, ()
    last, before = table[declared:], table[declared - surplus : declared]
    if not (np.array_equal(last, before) or np.all(last == table[declared - 1])):
        return table, ()
    many = "lines repeat" if surplus > 1 else "line repeats"
    sentence = (
        f"The header declares {declared} samples; the {surplus} surplus {many} the end and {{}} left out."
    )
    return table[:declared], (sentence.format("are" if surplus > 1 else "is"),)


def _record(i: int, values, notes, pairs: dict[str, str], options: Options) -> Accelerogram:
    step = number("INTERVALO DE MUESTREO", _at(pairs, "INTERVALO DE MUESTREO", i))
    rate, thinned = _at(pairs, "VEL. DE MUESTREO", i), pairs.get("FACTOR DE DECIMACION", "1")
    if rate:
        factor = float(thinned) if is_number(thinned) else 1.0
        check_equal("the interval", step, factor / max(1e-9, number("VEL. DE MUESTREO", rate)))
    record = options.accelerogram(
        "gal",
        values,
        step,
        component=_component(_listed(pairs, _ORIENTATION)[i]),
        station=pairs.get("CLAVE DE LA ESTACION", ""),
        event=pairs.get("FECHA DEL SISMO [GMT]", ""),
        **typed_magnitude(pairs.get("MAGNITUD(ES)", "")),
        event_time=f"{pairs.get('FECHA DEL SISMO [GMT]', '')} {pairs.get('HORA EPICENTRO (GMT)', '')}".strip(),
        warnings=notes,
    )
    if duration := _at(pairs, "DURACION DEL REGISTRO", i):
        check_duration("DURACION DEL REGISTRO", duration, len(values), record.time_step)
    peak, place = _at(pairs, "ACEL. MAX.(GAL)", i), _at(pairs, "ACEL. MAX.,", i)
    return agree_with_header(
        record,
        float(peak) if is_number(peak) else None,
        "gal",
        half_digit=5e-5,
        at=(float(place) - 1) * record.time_step if is_number(place) else None,
    )


def _component(label: str) -> str:
    """Return the direction of a label like "N90E", "N90E;" or "V;+": bearing and sense, of which one may be blank."""
    parts = [part.strip() for part in label.split(";") if part.strip()]
    return next((part for part in parts if azimuth(part) is not None or is_vertical(part)), parts[-1])


def _listed(pairs: dict[str, str], key: str) -> list[str]:
    """Return the parts of the values like "/V/N00E/N90E" of channels 1 to 6 and 7 to 12, "" where there is none."""
    found: list[str] = []
    for block in ("C1-C6", "C7-C12"):
        value = next((text for name, text in pairs.items() if name.startswith(key) and block in name), "")
        found += [part.strip() for part in (value.split("/")[1:] + [""] * 6)[:6]]
    return found


def _at(pairs: dict[str, str], key: str, channel: int) -> str:
    return _listed(pairs, key)[channel]


UNAM = Format("UNAM/CICESE", "Instituto de Ingeniería UNAM and CICESE, Mexico",
    "line ARCHIVO ESTANDAR DE ACELERACION in the first 12", _recognise, _read, "UNAM")  # fmt: skip
