"""The door through which structures come in from a mapping: degrees and metres outside, SI and radians inside."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from difflib import get_close_matches
from typing import Any

from rocking.errors import ConfigurationError
from rocking.structures.fields import RESTITUTION_RANGE, Form, article
from rocking.structures.registry import TYPES
from rocking.structures.structure import Structure, typed_text


def structure_from_config(mapping: Mapping[str, object], texts: Mapping[str, str] | None = None) -> Structure:
    """Return the structure that `mapping` describes: its type, the keys of one of the type's forms, perhaps a name.

    Lengths in m (keys …_m), angles in degrees (keys …_deg). texts: the values as they were typed, by key, for the
    structure's description. Raises ConfigurationError when a key is unknown or missing, and StructureError when the
    geometry cannot stand.
    """
    if not isinstance(mapping, Mapping):
        raise ConfigurationError(
            f"a structure is {mapping!r}, but must be a mapping with a type and its sizes."
        )
    kind = mapping.get("type")
    if not isinstance(kind, str) or kind not in TYPES:
        raise ConfigurationError(
            f"type is {kind!r}, but must be one of {', '.join(TYPES)}{_nearest(kind, TYPES)}."
        )
    given = {
        key: value for key, value in mapping.items() if key not in ("type", "name") and value is not None
    }
    form = _form(kind, given)
    arguments: dict[str, Any] = {
        form.keys[key].parameter: form.keys[key].inward(value) for key, value in given.items()
    }
    known = arguments.pop(RESTITUTION_RANGE.parameter, None)
    make: Callable[..., Structure] = getattr(TYPES[kind], form.make) if form.make else TYPES[kind]
    structure = make(**arguments)
    if known is not None:
        structure = replace(structure, restitution_range=known)
    structure.typed(given, {key: typed_text(value) for key, value in given.items()} | dict(texts or {}))
    return structure


def _form(kind: str, given: Mapping[str, object]) -> Form:
    """The form of `kind` that the keys `given` fill; ConfigurationError names what is unknown, missing or too much."""
    forms = TYPES[kind].forms
    allowed = {key for form in forms for key in form.keys}
    for key in given:
        if key not in allowed:
            keys = ", ".join(sorted(allowed))
            raise ConfigurationError(
                f"{key} is not a key of {article(kind)}{_nearest(key, allowed)}; use {keys}."
            )
    form = max(forms, key=lambda form: len(set(form.required) & given.keys()))
    missing = [key for key in form.required if key not in given]
    if missing:
        raise ConfigurationError(f"{article(kind)} needs {' and '.join(missing)}; give it.")
    foreign = [key for key in given if key not in form.keys]
    if foreign:
        raise ConfigurationError(
            f"{article(kind)} is given {' and '.join(foreign)} beside {' and '.join(form.required)}; give one set."
        )
    return form


def _nearest(word: object, allowed: Iterable[str]) -> str:
    found = get_close_matches(str(word), list(allowed), n=1, cutoff=0.5)
    return f" (did you mean {found[0]}?)" if found else ""
