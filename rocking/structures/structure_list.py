"""The types of structure there are, and the structure that an entry of a list describes.

Degrees, metres and kilonewtons outside, SI and radians inside; each size is remembered as it was typed. The JSON schema
follows from the forms of the types.
"""

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from pkgutil import resolve_name
from typing import Any

from rocking.errors import ConfigurationError, SizeError
from rocking.quantities import shown
from rocking.structures.building_parts import PARTS
from rocking.structures.fields import Form, article, forms, remember_as_typed, typed_text
from rocking.structures.other_names import answer
from rocking.structures.structure import Structure

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


TYPES: dict[str, tuple[Form, ...]] = {
    **{each.type_name: forms(each) for each in map(resolve_name, _CLASSES)},
    **{name: (each,) for name, each in PARTS.items()},
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
            f"a structure is {shown(mapping)}, but must be a mapping with a type and its sizes."
        )
    kind = mapping.get("type")
    if not isinstance(kind, str) or kind not in TYPES:
        known = answer(kind)
        hint = f" ({known.words})" if known else nearest(kind, TYPES, _ALIKE)
        given = "missing" if kind is None else shown(kind)
        raise ConfigurationError(f"type is {given}, but must be one of {', '.join(TYPES)}{hint}.")
    values = {
        key: value for key, value in mapping.items() if key not in ("type", "name") and value is not None
    }
    form = _form(kind, values, [key for key in mapping if key not in ("type", "name")])
    arguments: dict[str, Any] = {
        form.keys[key].name: form.keys[key].inward(value) for key, value in values.items()
    }
    try:
        structure: Structure = form.construct(**arguments)
    except SizeError as error:
        # By the key of the file, and as it was typed; of a list it is the one value that is wrong.
        key = next((key for key, field in form.keys.items() if field.name == error.field), error.field)
        typed = values.get(key)
        value = error.shown if typed is None or isinstance(typed, list | tuple) else shown(typed)
        raise SizeError.of(key, value, error.said) from None
    remember_as_typed(
        structure, form, values, {key: typed_text(value) for key, value in values.items()} | dict(texts or {})
    )
    return structure


def _form(kind: str, values: Mapping[str, object], keys_typed: Iterable[str]) -> Form:
    """The form of `kind` that the keys of `values` fill; ConfigurationError names what is unknown, missing or too much.

    keys_typed: those of `values`, and those whose value was left blank.
    """
    of_kind = TYPES[kind]
    allowed = {key for form in of_kind for key in form.keys}
    for key in keys_typed:
        if key not in allowed:
            keys = ", ".join(sorted(allowed))
            if str(key).isdigit() and key not in values:
                raise ConfigurationError(
                    f"{key} is not a key of {article(kind)}: a comma parts the entries within braces; write a number "
                    f"with a point, as in 3.{key}."
                )
            name = str(key) if len(str(key)) <= LONGEST_KEY else shown(key)
            raise ConfigurationError(
                f"{name} is not a key of {article(kind)}{nearest(key, allowed)}; use {keys}."
            )
    form = max(of_kind, key=lambda form: len(set(form.required) & values.keys()))
    missing = [key for key in form.required if key not in values]
    if missing:
        raise ConfigurationError(
            f"{article(kind)} needs {' and '.join(missing)}; give {'it' if len(missing) == 1 else 'them'}."
        )
    foreign = [key for key in values if key not in form.keys]
    if foreign:
        raise ConfigurationError(
            f"{article(kind)} is given {' and '.join(foreign)} beside {' and '.join(form.required)}; give one set."
        )
    return form


LONGEST_KEY = 80
"""Characters of a key that is compared with those that exist, and repeated as it is."""


def nearest(word: object, allowed: Iterable[str], likeness: float = 0.5) -> str:
    nearest = get_close_matches(str(word)[:LONGEST_KEY], list(allowed), n=1, cutoff=likeness)
    return f" (did you mean {nearest[0]}?)" if nearest else ""


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
    for each in form.fields:
        unit = f", {each.unit}" if each.unit else ""
        low, high = each.value.usual or (None, None)
        usual = f"; usually {low:g} to {high:g}" if each.unit and each.value.usual else ""
        properties[each.key] = {**each.schema, "description": f"{each.meaning}{unit}{usual}"}
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
