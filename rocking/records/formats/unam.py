"""UNAM (Mexico) standard file of acceleration, version 2, which CICESE writes too: columns in gal."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import mapping, valued
from rocking.records.formats.text import count, fields, is_number, lines, number, whole
from rocking.records.plausibility import agree_with_header

_HEADER = 160
_DATA = "DATOS DE ACELERACION"
_RULE = re.compile(r"[-+]{20,}")


def _recognise(content: bytes) -> bool:
    return any(line.startswith("ARCHIVO ESTANDAR DE ACELERACI") for line in lines(content, 12))


def _read(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = next((i for i, line in enumerate(text[:_HEADER]) if line.startswith(_DATA)), None)
    rules = [
        i for i, line in enumerate(text[: _HEADER + 10]) if at is not None and i > at and _RULE.match(line)
    ]
    if at is None or len(rules) < 2:
        raise RecordError(
            f"{name}: no heading {_DATA} above two rules in the first {_HEADER} lines; the file is cut."
        )
    pairs = mapping(text[:at])
    unit = valued(name, pairs, "UNIDADES DE LOS DATOS")
    if not unit.lower().startswith("gal"):
        raise RecordError(f"{name}: UNIDADES DE LOS DATOS is {unit!r}, but must be Gal.")
    table, told, labels = _table(text[rules[1] + 1 :], pairs, name)
    return [_record(i, label, table[:, i], told, pairs, name, options) for i, label in enumerate(labels)]


def _table(rows: list[str], pairs: dict[str, str], name: str):
    """Return (samples (n, channels), warnings, directions)."""
    labels = _listed(pairs, "ORIENTACION C1-C6 (RUMBO;ORIENTACION)")
    form = re.search(r"(\d+)F(\d+)", valued(name, pairs, "FORMATO DATOS (FORTRAN,10 CAMPOS/DATO)"))
    width = max(1, int(form[2])) if form else 10
    values = fields(name, [row for row in rows if row.strip()], width)
    if not labels or values.size % len(labels):
        raise RecordError(
            f"{name}: {values.size} numbers do not fill the {len(labels)} channels named; it is truncated."
        )
    declared = _listed(pairs, "NUM. TOTAL DE MUESTRAS, C1-C6")
    if len(set(declared)) > 1:
        raise RecordError(
            f"{name}: the channels declare {', '.join(declared)} samples, but must be equally long."
        )
    table = values.reshape(-1, len(labels))
    _, told = whole(
        name, table[:, 0], count(name, "NUM. TOTAL DE MUESTRAS", (declared or [""])[0]), per_line=1
    )
    return table, told, labels


def _record(
    i: int, label: str, values, told, pairs: dict[str, str], name: str, options: Options
) -> Accelerogram:
    component = label.split(";")[-1].strip()
    step = number(
        name, "INTERVALO DE MUESTREO", (_listed(pairs, "INTERVALO DE MUESTREO, C1-C6 (S)") + [""] * 9)[i]
    )
    record = accelerogram(
        name,
        UNAM.name,
        options.unit_of(name, "gal"),
        values,
        options.time_step_of(name, step),
        component=component,
        station=pairs.get("CLAVE DE LA ESTACION", ""),
        event=pairs.get("FECHA DEL SISMO [GMT]", ""),
        warnings=told,
    )
    peaks = _listed(pairs, "ACEL. MAX.(GAL), C1-C6")
    stated = float(peaks[i]) if i < len(peaks) and is_number(peaks[i]) else None
    agree_with_header(record, stated, "gal", half_digit=5e-5)
    return record


def _listed(pairs: dict[str, str], key: str) -> list[str]:
    """Return the parts of a value like "/V/N00E/N90E"."""
    return [part.strip() for part in pairs.get(key, "").split("/")[1:]]


UNAM = Format("UNAM/CICESE", "line ARCHIVO ESTANDAR DE ACELERACION in the first 12", _recognise, _read)
