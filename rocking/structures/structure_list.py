"""The types of structure there are, and the structure that an entry of a list describes.

Degrees, metres and kilonewtons outside, SI and radians inside; the structure describes itself as it was typed. The JSON
schema follows from the forms of the types.
"""

from collections.abc import Mapping
from dataclasses import replace
from pkgutil import resolve_name

from rocking.errors import ConfigurationError
from rocking.quantities import shown
from rocking.structures.building_parts import PARTS
from rocking.structures.description import Description, nearest
from rocking.structures.fields import Form, form_made_by, forms
from rocking.structures.other_names import answer
from rocking.structures.structure import Structure
from rocking.structures.wall import Wall

_CLASSES = (
    "rocking.structures.block.Block",
    "rocking.structures.wall.Wall",
    "rocking.structures.arch.Arch",
    "rocking.structures.frame.Frame",
    "rocking.structures.block.Spire",
    "rocking.structures.block.RigidBody",
    "rocking.structures.facade.Facade",
    "rocking.structures.wall.LoadedWall",
    "rocking.structures.arch.ArchOnPiers",
    "rocking.structures.capacity_curve.CapacityCurve",
)


def _cavity_wall() -> Form:
    """The form of a wall whose leaves have to be given."""
    form = form_made_by(Wall, "of_size")
    fields = tuple(replace(key, default=...) if key.name == "leaves" else key for key in form.fields)
    meaning = "Wall of two or three leaves, held at floor and ceiling, each of which may fall alone"
    return replace(form, type_name="cavity_wall", meaning=meaning, fields=fields)


TYPES: dict[str, tuple[Form, ...]] = {
    **{kind.type_name: forms(kind) for kind in map(resolve_name, _CLASSES)},
    "cavity_wall": (_cavity_wall(),),
    **{name: (part,) for name, part in PARTS.items()},
}
"""The forms of each `type` of a structure list."""
_ALIKE = 0.8
"""Likeness of the letters of two types from which one is taken for the other misspelt."""


def structure_from_config(mapping: Mapping[str, object], texts: Mapping[str, str] | None = None) -> Structure:
    """Return the structure that `mapping` describes: its type, the keys of one of the type's forms, perhaps a name.

    Lengths in m (keys …_m), angles in degrees (keys …_deg).

    Parameters
    ----------
    mapping : mapping of str to object
        Type, keys of one of the forms of the type, and perhaps a name.
    texts : mapping of str to str or None, optional
        The values as they were typed, by key, for the structure's description.

    Returns
    -------
    Structure
        The structure.

    Raises
    ------
    ConfigurationError
        When a key is unknown or missing.
    StructureError
        When the geometry cannot stand.

    Examples
    --------
    >>> rocking.structure_from_config({"type": "block", "breadth_m": 2.0, "height_m": 9.0}).mechanism()
    Mechanism(λ = 0.2222, φ_cr = 0.2187 rad, p = 1.263 rad/s, η = 0.9294)
    """
    if not isinstance(mapping, Mapping):
        raise ConfigurationError(
            f"a structure is {shown(mapping)}, but must be a mapping with a type and its sizes.",
            structure=mapping,
        )
    kind = mapping.get("type")
    if not isinstance(kind, str) or kind not in TYPES:
        known = answer(kind)
        hint = f" ({known.words})" if known else nearest(kind, TYPES, _ALIKE)
        given = "missing" if kind is None else shown(kind)
        raise ConfigurationError(f"type is {given}, but must be one of {', '.join(TYPES)}{hint}.", type=kind)
    structure: Structure = Description.read(TYPES[kind], mapping, texts or {}).structure()
    return structure


NAME = {
    "type": "string",
    "minLength": 1,
    "description": "Name of the structure in every table; each its own",
}
"""The schema of the name of an entry."""


def definitions(more: Mapping[str, object]) -> dict[str, dict[str, object]]:
    """Return the JSON schema (draft 7) of an entry in each form of each type, by name. more: keys that all may have."""
    return {
        kind if len(of_kind) == 1 else f"{kind}_{number}": _definition(kind, form, more)
        for kind, of_kind in TYPES.items()
        for number, form in enumerate(of_kind, start=1)
    }


def _definition(kind: str, form: Form, more: Mapping[str, object]) -> dict[str, object]:
    properties = {}
    for key in form.fields:
        unit = f", {key.unit}" if key.unit else ""
        low, high = key.value.usual or (None, None)
        usual = f"; usually {low:g} to {high:g}" if key.unit and key.value.usual else ""
        properties[key.key] = {**key.schema, "description": f"{key.meaning}{unit}{usual}"}
    return {
        "description": form.meaning,
        "type": "object",
        "additionalProperties": False,
        "required": ["name", "type", *form.required],
        "properties": {
            "name": NAME,
            "type": {"const": kind},
            **properties,
            **more,
        },
        "examples": [{"name": f"my {kind}", "type": kind, **form.example}],
    }
