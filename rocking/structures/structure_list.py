"""The types of structure there are, and the door through which a file brings them in.

Degrees, metres and kilonewtons outside, SI and radians inside. A YAML list is read safely, all defects stand in one
message, and each size is remembered as it was typed. The JSON schema follows from the forms of the types.
"""

import json
import warnings
from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import yaml

from rocking.described import kind_in_words
from rocking.errors import ConfigurationError, StructureError, StructureWarning
from rocking.quantities import shown
from rocking.structures.check_terms import KEYS as CHECK_KEYS
from rocking.structures.check_terms import CheckTerms, check_terms, check_terms_schema
from rocking.structures.fields import Form, article
from rocking.structures.standing import GROUND, TYPE_NAME, NamedSupport, support_from_config, support_schema
from rocking.structures.structure import Structure, typed_text
from rocking.tables.yaml_file import read_yaml

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
)


TYPES: dict[str, type[Structure]] = {each.type_name: each for each in map(resolve_name, _CLASSES)}
"""The classes by the `type` of a structure list."""


def structure_from_config(mapping: Mapping[str, object], texts: Mapping[str, str] | None = None) -> Structure:
    """Return the structure that `mapping` describes: its type, the keys of one of the type's forms, perhaps a name.

    Lengths in m (keys …_m), angles in degrees (keys …_deg). texts: the values as they were typed, by key, for the
    structure's description. Raises ConfigurationError when a key is unknown or missing, and StructureError when the
    geometry cannot stand.

    >>> rocking.structure_from_config({"type": "block", "breadth_m": 2.0, "height_m": 9.0}).mechanism()
    Mechanism(λ = 0.2222, φ_cr = 0.2187 rad, p = 1.263 rad/s, η = 0.9294)
    """
    if not isinstance(mapping, Mapping):
        raise ConfigurationError(
            f"a structure is {shown(mapping)}, but must be a mapping with a type and its sizes."
        )
    kind = mapping.get("type")
    if not isinstance(kind, str) or kind not in TYPES:
        raise ConfigurationError(
            f"type is {shown(kind)}, but must be one of {', '.join(TYPES)}{_nearest(kind, TYPES)}."
        )
    values = {
        key: value
        for key, value in mapping.items()
        if key not in ("type", "name", "stands_on") and value is not None
    }
    form = _form(kind, values, [key for key in mapping if key not in ("type", "name")])
    arguments: dict[str, Any] = {
        form.keys[key].name: form.keys[key].inward(value) for key, value in values.items()
    }
    make: Callable[..., Structure] = getattr(TYPES[kind], form.make) if form.make else TYPES[kind]
    try:
        structure = make(**arguments)
    except StructureError as error:
        raise type(error)(_by_key(str(error), form, values, arguments)) from None
    structure.typed(values, {key: typed_text(value) for key, value in values.items()} | dict(texts or {}))
    return structure


def _by_key(sentence: str, form: Form, values: Mapping[str, object], arguments: Mapping[str, object]) -> str:
    """Return a sentence on an attribute as one on the key of the file, and its value as it was typed."""
    for key, value in values.items():
        field = form.keys[key]
        begin = f"{field.name} is {shown(arguments[field.name])}"
        if field.is_as_typed and sentence.startswith(begin):
            return f"{key} is {shown(value)}{sentence.removeprefix(begin)}"
    return sentence


def _form(kind: str, values: Mapping[str, object], keys_typed: Iterable[str]) -> Form:
    """The form of `kind` that the keys of `values` fill; ConfigurationError names what is unknown, missing or too much.

    keys_typed: those of `values`, and those whose value was left blank.
    """
    forms = TYPES[kind].forms()
    allowed = {key for form in forms for key in form.keys}
    for key in keys_typed:
        if key not in allowed:
            keys = ", ".join(sorted(allowed))
            if str(key).isdigit() and key not in values:
                raise ConfigurationError(
                    f"{key} is not a key of {article(kind)}: a comma parts the entries within braces; write a number "
                    f"with a point, as in 3.{key}."
                )
            name = str(key) if len(str(key)) <= _LONGEST_KEY else shown(key)
            raise ConfigurationError(
                f"{name} is not a key of {article(kind)}{_nearest(key, allowed)}; use {keys}."
            )
    form = max(forms, key=lambda form: len(set(form.required) & values.keys()))
    missing = [key for key in form.required if key not in values]
    if missing:
        raise ConfigurationError(f"{article(kind)} needs {' and '.join(missing)}; give it.")
    foreign = [key for key in values if key not in form.keys]
    if foreign:
        raise ConfigurationError(
            f"{article(kind)} is given {' and '.join(foreign)} beside {' and '.join(form.required)}; give one set."
        )
    return form


_LONGEST_NAME = 200
"""Characters of the name of a structure: what a table and a page still show."""
_LONGEST_KEY = 80
"""Characters of a key that is compared with those that exist, and repeated as it is."""


def _nearest(word: object, allowed: Iterable[str]) -> str:
    nearest = get_close_matches(str(word)[:_LONGEST_KEY], list(allowed), n=1, cutoff=0.5)
    return f" (did you mean {nearest[0]}?)" if nearest else ""


_HEAD = "# Written from rocking/structures by `make schema`; edit the structure's own file instead.\n"
_NAME = {
    "type": "string",
    "minLength": 1,
    "description": "Name of the structure in every table; each its own",
}
_STANDS_ON = {
    "type": "string",
    "minLength": 1,
    "description": "Name of the support of this list that carries the structure; left out: the ground",
}


def structures_schema() -> dict[str, object]:
    """Return the schema (draft 7); a definition for each form of each type."""
    definitions = {
        kind if len(each.forms()) == 1 else f"{kind}_{number}": _definition(kind, form)
        for kind, each in TYPES.items()
        for number, form in enumerate(each.forms(), start=1)
    }
    definitions[TYPE_NAME] = support_schema(_NAME)
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Structures to assess",
        "type": "array",
        "minItems": 1,
        "items": {"oneOf": [{"$ref": f"#/definitions/{name}"} for name in definitions]},
        "definitions": definitions,
    }


def structures_schema_file() -> str:
    """Return the schema as the YAML file of the workflow."""
    plain = json.loads(json.dumps(structures_schema()))  # no part twice, which YAML would write as an anchor
    result: str = _HEAD + yaml.safe_dump(plain, sort_keys=False, allow_unicode=True, width=110)
    return result


def _definition(kind: str, form: Form) -> dict[str, object]:
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
            "name": _NAME,
            "type": {"const": kind},
            **properties,
            **check_terms_schema(),
            "stands_on": _STANDS_ON,
        },
        "examples": [
            {"name": f"my {kind}", "type": kind, **{each.key: each.value.example for each in form.fields}}
        ],
    }


def load_structures(path: str | Path) -> dict[str, Structure]:
    """Return the structures listed in a YAML file, by name, in its order.

    The file is a list of mappings, each with a `name` of its own; those of type support carry others, which name them
    by `stands_on`. A structure on a support is returned once on the ground and once for each period of the support, by
    the names of its `standing`. Raises ConfigurationError with every defect at once, one a line; warns with a
    StructureWarning of a size beyond its plausible range.
    """
    entries, texts_of = _entries(Path(path))
    defects: list[str] = []
    supports: dict[str, NamedSupport | None] = {}
    structures: dict[str, Structure] = {}
    names: list[object] = []
    numbered = list(enumerate(zip(entries, texts_of, strict=True), start=1))
    for number, (entry, texts) in sorted(numbered, key=lambda each: not _is_support(each[1][0])):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        where = f"{path}: structure {number}" + (f" ({_repeated(name)})" if name else "")
        if not isinstance(name, str) or not name.strip():
            hint = "give it" if name is None else "write it in quotation marks"
            defects.append(f"{where}: name is {shown(name)}, but must be a text of its own; {hint}.")
        elif len(name) > _LONGEST_NAME:
            defects.append(
                f"{where}: name has {len(name)} characters, but may have {_LONGEST_NAME}; shorten it."
            )
        elif name in names:
            defects.append(f"{where}: the name is already taken by another structure; give each its own.")
        names.append(name)
        try:
            if _is_support(entry):
                supports[str(name)] = None
                supports[str(name)] = support_from_config(entry)
            else:
                structures |= _where_it_stands(str(name), entry, texts, supports, where)
        except (ConfigurationError, StructureError) as error:
            defects.append(f"{where}: {error}")
    carrying = {str(entry.get("stands_on")) for entry in entries if isinstance(entry, Mapping)}
    for idle in supports.keys() - carrying:
        defects.append(
            f"{path}: support {_repeated(idle)} carries nothing; name it by stands_on, or remove it."
        )
    if not structures and not defects:
        defects.append(f"{path}: the file lists supports only; add a structure.")
    if defects:
        raise ConfigurationError("\n".join(defects))
    return structures


def _repeated(name: object) -> str:
    """The name of an entry as a sentence repeats it: without quotes, and of a long one only the begin."""
    is_short = isinstance(name, str) and len(name) <= _LONGEST_KEY
    return str(name) if is_short else shown(name)


def _entries(path: Path) -> tuple[list[Any], list[Mapping[str, str]]]:
    """The entries of a structure list, and the text of each of their values as it was typed."""
    entries, node = read_yaml(path, ConfigurationError, "structure list")
    if entries == []:
        raise ConfigurationError(f"{path}: the list is empty, but must hold one structure at least.")
    if not isinstance(entries, list):
        raise ConfigurationError(
            f"{path}: the file holds {kind_in_words(entries)}, but must hold a list of structures, each "
            "behind a dash, as in - {name: pier, type: block, breadth_m: 2, height_m: 9}."
        )
    return entries, [_texts(each) for each in node.value]


def _is_support(entry: object) -> bool:
    return isinstance(entry, Mapping) and entry.get("type") == TYPE_NAME


def _where_it_stands(
    name: str,
    entry: Any,
    texts: Mapping[str, str],
    supports: Mapping[str, NamedSupport | None],
    where: str,
) -> dict[str, Structure]:
    """The structure of an entry by its name; on a support once for each way in which it stands there.

    supports: None for one that has a defect of its own. Warns of each size beyond its plausible range.
    """
    place = None
    own = entry
    terms = CheckTerms()
    if isinstance(entry, Mapping):
        place = entry.get("stands_on")
        terms = check_terms(entry)
        apart = {key for key in ("stands_on", *CHECK_KEYS) if entry.get(key) is not None}
        own = {key: value for key, value in entry.items() if key not in apart}
        texts = {key: text for key, text in texts.items() if key not in apart}
    structure = structure_from_config(own, texts)
    if terms != CheckTerms():
        structure = structure.checked_with(terms)
    remarks = list(structure.remarks)
    structures = {name: structure}
    if place is not None and place != GROUND:
        if not isinstance(place, str) or place not in supports:
            listed = ", ".join([GROUND, *map(_repeated, supports)])
            raise ConfigurationError(
                f"stands_on is {shown(place)}, but no support of the list has this name{_nearest(place, supports)}; "
                f"use one of {listed}, or add the support."
            )
        support = supports[place]
        standings = support.standings(name) if support else ()
        structures = {each.name: structure.standing_on(each) for each in standings}
        remarks += [standings[-1].warning] if standings and standings[-1].warning else []
    for remark in remarks:
        warnings.warn(f"{where}: {remark}", StructureWarning, stacklevel=3)
    return structures


def _texts(node: yaml.Node) -> dict[str, str]:
    """The scalars and the lists of scalars of a mapping, as they were typed."""
    texts = {}
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        each = value.value if isinstance(value, yaml.SequenceNode) else [value]
        if isinstance(value, yaml.ScalarNode | yaml.SequenceNode):
            texts[key.value] = ", ".join(one.value for one in each if isinstance(one, yaml.ScalarNode))
    return texts
