"""The parts of the pages that the code itself knows: formats, settings, structures, tables, equations."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

import rocking
from docs.site.drawings import forms
from rocking.assessment.rows.of_folder import PER_RECORD
from rocking.assessment.rows.of_record import HistoryRow
from rocking.assessment.rows.of_study import SUMMARY_TABLES, SpectrumRow
from rocking.quantities import ACCELERATION_UNITS
from rocking.records.formats import FORMATS
from rocking.structures.fields import Form
from rocking.tables import Table


def formats(_: Path) -> str:
    """The formats that are read, where each comes from, and what it is recognised by."""
    rows = ((form.name, form.origin, form.sought, "yes" if form.plugin else "") for form in FORMATS)
    return table(("format", "origin", "recognised by", "offered to obspy"), rows)


def units(_: Path) -> str:
    """The units that may be declared."""
    return ", ".join(f"`{unit}`" for unit in ACCELERATION_UNITS) + "."


def settings(workflow: Path) -> str:
    """Every setting with its meaning, what is allowed, and its default."""
    schema = _yaml(workflow / "schemas" / "config.schema.yaml")
    defaults = _yaml(workflow / "config.yaml")
    rows = _setting_rows(schema["properties"], defaults)
    return table(("setting", "meaning", "allowed", "default"), rows)


def structures(_: Path) -> str:
    """The drawing and the keys of every form of every type of structure."""
    return "\n\n".join(_structure(*form) for form in forms())


def tables(_: Path) -> str:
    """Every column of every table."""
    known = dict.fromkeys((*PER_RECORD, HistoryRow, *SUMMARY_TABLES, SpectrumRow))
    return "\n\n".join(_table_section(described.table) for described in known)


def equations(_: Path) -> str:
    """The equations that the paper prints with a slip, with the numbers that decide."""
    from docs.paper.equations import (
        equation_rows,  # compiles the integration, which only this needs
    )

    head = ("Eq.", "quantity", "by the printed form", "by the corrected form", "decides")
    body = (
        (
            row.equation,
            row.quantity,
            *map(_figure, (row.printed_number, row.corrected_number, row.deciding_number)),
        )
        for row in equation_rows()
    )
    return table(head, body)


def pulse_methods(_: Path) -> str:
    """The pulse methods of the registry, the default first."""
    from rocking.pulses import PULSE_METHODS

    return table(
        ("choice", "the pulse that predicts"), ((m.name, m.description) for m in PULSE_METHODS.values())
    )


def blocks(_: Path) -> str:
    """The largest error of each equivalent block over a figure of the paper."""
    from docs.paper.report import equivalence_figures

    head = ("figure", "structure", "quantity", "block", "largest error")
    shown: dict[tuple[str, ...], float] = {}
    for figure in equivalence_figures():
        for row in figure.rows:
            block = _BLOCKS[figure.name[-1]].get(row.panel)
            if block:
                key = (figure.name[-1], row.curve, row.y_quantity.partition(",")[0], block)
                shown[key] = max(shown.get(key, 0.0), abs(row.y - 1))
    return table(head, ((*key, f"{100 * error:.1f} %") for key, error in shown.items() if _shown(key[1])))


_PERIODS = {"a": "linearised", "c": "exact at rest"}
_TIMES = {"a": "a_sc", "b": "a_sc,alt", "c": "exact at rest"}
_BLOCKS = {"3": _PERIODS, "6": _PERIODS, "4": _TIMES, "7": _TIMES}
"""Block of each panel, by the figure of the paper."""


def _shown(curve: str) -> bool:
    """The curves of the slender, the usual and the stocky structure; the figures show all."""
    return curve in ("α = 0.1 rad", "α = 0.3 rad", "t/r = 0.13", "t/r = 0.25")


def regimes(_: Path) -> str:
    """The regimes of the closed form."""
    from rocking.sine_pulse import Regime

    return table(("regime", "meaning"), ((regime.value, regime.sentence) for regime in Regime))


TOPICS = {
    "records": ("records",),
    "structures": ("structures",),
    "pulses": ("pulses", "sine_pulse"),
    "motion": ("motion",),
    "assessment": ("assessment",),
    "studies": ("study", "reports", "errors"),
}
"""Page of the Python names: the parts of the package from which they come."""


def api(topic: str) -> str:
    """The public names of a topic, for mkdocstrings to describe."""
    modules = ((getattr(rocking, name).__module__, name) for name in rocking.__all__)
    return "\n\n".join(
        f"::: {module}.{name}" for module, name in modules if module.split(".")[1] in TOPICS[topic]
    )


GENERATED: Mapping[str, Callable[[Path], str]] = {
    part.__name__: part
    for part in (
        formats,
        units,
        settings,
        structures,
        tables,
        equations,
        pulse_methods,
        blocks,
        regimes,
    )
} | {f"api_{topic}": lambda _, topic=topic: api(topic) for topic in TOPICS}
"""What may stand behind `generated:` in a page."""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a Markdown table; a bar inside a cell is escaped."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(
        f"| {' | '.join(' '.join(cell.split()).replace('|', '&#124;') for cell in line)} |" for line in lines
    )


def _figure(value: float) -> str:
    return f"{value:.5g}".replace("inf", "overturns")


def _yaml(path: Path) -> dict[str, Any]:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def _setting_rows(
    properties: Mapping[str, Any], defaults: Mapping[str, Any], above: str = ""
) -> Iterator[Sequence[str]]:
    for name, schema in properties.items():
        if "properties" in schema:
            yield from _setting_rows(schema["properties"], defaults[name], f"{above}{name}.")
        else:
            default = json.dumps(defaults[name]).strip('"')
            yield f"`{above}{name}`", schema.get("description", ""), allowed(schema), f"`{default}`"


def allowed(schema: Mapping[str, Any]) -> str:
    """Return in words what a JSON schema allows of one value."""
    if "oneOf" in schema:
        return " or ".join(allowed(choice) for choice in schema["oneOf"])
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    kinds = schema.get("type", "any")
    first, *others = [kinds] if isinstance(kinds, str) else kinds
    words = f"{_KINDS.get(first, first)} {_bounds(schema)}".strip()
    return ", or ".join([words, *(f"`{other}`" for other in others)])


_KINDS = {"boolean": "`true` or `false`", "string": "text", "integer": "whole number"}


def _bounds(schema: Mapping[str, Any]) -> str:
    if "minimum" in schema and "maximum" in schema:
        return f"from {schema['minimum']:g} to {schema['maximum']:g}"
    signs = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
    return " and ".join(f"{sign} {schema[name]:g}" for name, sign in signs.items() if name in schema)


def _structure(drawing: str, kind: str, form: Form) -> str:
    head = ("key", "letter", "meaning", "allowed", "usual", "")
    rows = (
        (
            f"`{key}`",
            field.said.letter,
            field.meaning,
            field.must,
            ""
            if field.said.usual is None
            else f"{field.said.usual[0]:g} to {field.said.usual[1]:g}{field.suffix}",
            "required" if field.required else "",
        )
        for key, field in form.keys.items()
    )
    picture = f"![{form.meaning}](figures/{drawing}.svg)"
    return f"### `type: {kind}` — {form.meaning}\n\n{picture}\n\n{table(head, rows)}"


def _table_section(described: Table) -> str:
    rows = ((f"`{c.name}`", c.type, c.unit, c.meaning, c.more["equation"]) for c in described.columns)
    body = table(("column", "type", "unit", "meaning", "equation"), rows)
    return f"## {described.file_name}\n\n{described.description}.\n\n{body}"
