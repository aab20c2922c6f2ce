"""The drawing of every form of every structure, with the letters of its dimensions, made from the registry."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from rocking.reports.style import styled
from rocking.structures import Structure
from rocking.structures.fields import Form
from rocking.structures.structure_list import TYPES, structure_from_config

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SEEN_ROTATION, _MOST_ROTATION = 0.12, 0.3
"""Rotation that can be seen in a small drawing, and beyond which a structure is hard to recognise, rad."""


def forms() -> Iterator[tuple[str, str, Form]]:
    """Yield the name of the drawing, the type and the form, of every form of every type."""
    for name, of_type in TYPES.items():
        for place, form in enumerate(of_type):
            yield f"structure_{name}_{place + 1}", name, form


@styled
def drawing(kind: str, form: Form) -> Figure:
    """Return the structure of the form's examples, at rest, measured, and displaced next to that.

    What a file holds is drawn by the first form of its type.
    """
    from matplotlib.figure import Figure  # not needed where only the forms are

    form = TYPES[kind][0] if "file" in form.keys else form
    example = {field.key: field.value.example for field in form.fields if field.required or field.unit}
    if "restitution" in form.keys:  # no balance gives that of a wall which friction and ties hold
        example |= {"restitution": 0.5}
    structure = structure_from_config({"type": kind, **example})
    figure = Figure(figsize=(6.4, 2.9), layout="constrained")
    rest, displaced = figure.subplots(1, 2)
    structure.plot(axes=rest, dimensions=True)
    structure.plot(seen_rotation(structure), axes=displaced)
    for axes in (rest, displaced):
        axes.axis("off")
    return figure


def seen_rotation(structure: Structure) -> float:
    """Return the rotation of a drawing that shows the mechanism, rad: a share of φ_cr, more where it is small."""
    side = structure.mechanism().positive
    visible = min(max(0.6 * side.critical_rotation, _SEEN_ROTATION), _MOST_ROTATION)
    return min(visible, 0.8 * side.end_rotation)
