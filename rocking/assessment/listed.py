"""The list of structures in a file, YAML or CSV: structures, their variants and supports, read into scenes.

A variant is a structure with some values changed, and stands behind the one that it is of. In CSV each row is an entry,
and each column a key. The list is read safely, all defects stand in one message, and each size is remembered as it was
typed.
"""

import json
import re
import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from rocking.assessment.scene import KEYS as CHECK_KEYS
from rocking.assessment.scene import Scene, check_terms, check_terms_schema
from rocking.described import kind_in_words
from rocking.errors import ConfigurationError, StructureError, StructureWarning
from rocking.floors.place import GROUND, TYPE_NAME, Place, place_from_config, place_schema
from rocking.quantities import shown
from rocking.remarks import Kind
from rocking.structures.structure_list import (
    LONGEST_KEY,
    NAME,
    TYPES,
    definitions,
    nearest,
    structure_from_config,
)
from rocking.tables import read_edited
from rocking.tables.yaml_file import read_yaml, scalar_value

_LONGEST_NAME = 200
"""Characters of the name of a structure: what a table and a page still show."""
_HEAD = "# Written from rocking/structures by `make schema`; edit the structure's own file instead.\n"
_VARIANTS = {
    "type": "array",
    "minItems": 1,
    "items": {
        "type": "object",
        "required": ["name"],
        "minProperties": 2,
        "properties": {"name": {**NAME, "description": "Name behind that of the structure and a colon"}},
    },
    "description": "The same structure with other values: of each a name and the keys that change; null takes one away",
}
_STANDS_ON = {
    "type": "string",
    "minLength": 1,
    "description": "Name of the support of this list that carries the structure; left out: the ground",
}


def scenes_schema() -> dict[str, object]:
    """Return the JSON schema (draft 7) of a list; a definition for each form of each type, and one of a support."""
    of_entries = definitions({**check_terms_schema(), "stands_on": _STANDS_ON, "variants": _VARIANTS})
    of_entries[TYPE_NAME] = place_schema(NAME)
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Structures to assess",
        "type": "array",
        "minItems": 1,
        "items": {"oneOf": [{"$ref": f"#/definitions/{name}"} for name in of_entries]},
        "definitions": of_entries,
    }


def scenes_schema_file() -> str:
    """Return the schema as the YAML file of the workflow."""
    plain = json.loads(json.dumps(scenes_schema()))  # no part twice, which YAML would write as an anchor
    result: str = _HEAD + yaml.safe_dump(plain, sort_keys=False, allow_unicode=True, width=110)
    return result


def load_scenes(path: str | Path) -> dict[str, Scene]:
    """Return the scenes that a file lists, by name, in its order.

    A YAML file is a list of mappings, each with a `name` of its own; those of type support carry others, which name
    them by `stands_on`. The variants of a structure follow it, each as "structure: variant". A CSV file has an entry a
    row, without variants; see `_rows`. Raises ConfigurationError with every defect at once, one a line; warns with a
    StructureWarning of a size beyond its plausible range.
    """
    defects: list[str] = []
    path = Path(path)
    entries = _rows(path, defects) if path.suffix.lower() == ".csv" else _entries(path, defects)
    places: dict[str, Place | None] = {}
    scenes: dict[str, Scene] = {}
    names: list[object] = []
    for where, entry, texts, base in sorted(entries, key=lambda each: not _is_support(each.values)):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        if run_together := _run_together(entry):
            key, _, value = run_together.partition(":")
            defects.append(f"{where}: {run_together} has no blank behind its colon; write {key}: {value}.")
            names.append(name)
            continue
        if not isinstance(name, str) or not name.strip():
            hint = "give it" if name is None else "write it in quotation marks"
            given = "missing" if name is None else shown(name)
            defects.append(f"{where}: name is {given}, but must be a text of its own; {hint}.")
        elif len(name) > _LONGEST_NAME:
            defects.append(
                f"{where}: name has {len(name)} characters, but may have {_LONGEST_NAME}; shorten it."
            )
        elif name in names:
            defects.append(f"{where}: the name is already taken by another structure; give each its own.")
        names.append(name)
        try:
            if _is_support(entry):
                places[str(name)] = None  # known, though it has a defect of its own
                places[str(name)] = place_from_config(entry)
            else:
                scene = scenes[str(name)] = _scene(str(name), entry, texts, places, where)
                if base in scenes and replace(scene, name=base) == scenes[base]:
                    defects.append(
                        f"{where}: it changes nothing; give a key with another value, or remove it."
                    )
                scenes[str(name)] = replace(scene, variant_of=base)
        except (ConfigurationError, StructureError) as error:
            defects.append(f"{where}: {error}")
    carrying = {str(each.values.get("stands_on")) for each in entries if isinstance(each.values, Mapping)}
    for idle in places.keys() - carrying:
        defects.append(
            f"{path}: support {_repeated(idle)} carries nothing; name it by stands_on, or remove it."
        )
    if not scenes and not defects:
        defects.append(f"{path}: the file lists supports only; add a structure.")
    if defects:
        raise ConfigurationError("\n".join(defects))
    return scenes


def _run_together(entry: object) -> str:
    """The first key of an entry that YAML read with its value, for want of a blank behind the colon; "" for none."""
    if not isinstance(entry, Mapping):
        return ""
    keys = (str(key) for key, value in entry.items() if value is None)
    return next((key for key in keys if re.fullmatch(r"\w+:\S.{,60}", key)), "")


def _repeated(name: object) -> str:
    """The name of an entry as a sentence repeats it: without quotes, and of a long one only the begin."""
    is_short = isinstance(name, str) and len(name) <= LONGEST_KEY
    return str(name) if is_short else shown(name)


class _Entry(NamedTuple):
    """One entry of a list: where it stands in words, its values and their texts as typed.

    base: the name of the structure that it is a variant of; "" of one that is none.
    """

    where: str
    values: Any
    texts: Mapping[str, str]
    base: str = ""


def _entries(path: Path, defects: list[str]) -> list[_Entry]:
    """The entries of a structure list, the variants of each behind it. What is no variant is added to the defects."""
    entries, node = read_yaml(path, ConfigurationError, "structure list")
    if entries == []:
        raise ConfigurationError(f"{path}: the list is empty, but must hold one structure at least.")
    if not isinstance(entries, list):
        raise ConfigurationError(
            f"{path}: the file holds {kind_in_words(entries)}, but must hold a list of structures, each "
            "behind a dash, as in - {name: pier, type: block, breadth_m: 2, height_m: 9}."
        )
    found = []
    for number, (entry, of_entry) in enumerate(zip(entries, node.value, strict=True), start=1):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        where = f"{path}: structure {number}" + (f" ({_repeated(name)})" if name else "")
        texts = _texts(of_entry)
        if not isinstance(entry, Mapping) or "variants" not in entry or _is_support(entry):
            found.append(_Entry(where, entry, texts))
            continue
        variants = entry["variants"]
        entry = {key: value for key, value in entry.items() if key != "variants"}
        texts.pop("variants", None)
        found.append(_Entry(where, entry, texts))
        if not isinstance(variants, list) or not variants:
            defects.append(
                f"{where}: variants is {shown(variants)}, but must be a list, each of it a name and the keys that "
                "change, as in - {name: thicker, thickness_m: 0.4}."
            )
            continue
        (nodes,) = (value.value for key, value in of_entry.value if key.value == "variants")
        for place, (changes, of_changes) in enumerate(zip(variants, nodes, strict=True), start=1):
            of_variant = changes.get("name") if isinstance(changes, Mapping) else None
            if not isinstance(of_variant, str) or not of_variant.strip():
                defects.append(
                    f"{where}, variant {place}: it is {shown(changes)}, but must have a name of its own, a text, and "
                    "the keys that change."
                )
                continue
            changed = {**entry, **changes, "name": f"{name}: {of_variant}"}
            # What is null is taken away, so that another type may have other keys.
            values = {key: value for key, value in changed.items() if value is not None}
            own = {key: text for key, text in (texts | _texts(of_changes)).items() if key in values}
            found.append(
                _Entry(f"{where}, variant {place} ({_repeated(of_variant)})", values, own, str(name))
            )
    return found


def _rows(path: Path, defects: list[str]) -> list[_Entry]:
    """The entries of a structure list in CSV: a row each, keys as columns; an empty cell is not given.

    A cell means what it would in YAML. A list is parted by semicolons. Where semicolons part the cells, as in
    spreadsheets of countries of decimal commas, lists stand in quotation marks, which these write themselves.
    """
    of_types = [each for of_kind in TYPES.values() for form in of_kind for each in form.fields]
    lists = {each.key for each in of_types if each.is_list}
    texts = {"name", "type", "stands_on", *(each.key for each in of_types if each.kind is str)}
    of_support = place_schema(NAME)["properties"]
    assert isinstance(of_support, dict)
    keys = ("name", "type", *(each.key for each in of_types), *of_support, "stands_on", *CHECK_KEYS)
    columns = [key for key in dict.fromkeys(keys) if key != "modes"]
    numbers = [key for key in columns if key not in texts]
    found = []
    for line, row in read_edited(path, ConfigurationError, columns, ("name", "type"), numbers):
        cells = {key: cell.strip() for key, cell in row.items() if cell.strip()}
        if not cells:
            continue
        name = cells.get("name")
        where = f"{path}: line {line}" + (f" ({_repeated(name)})" if name else "")
        values: dict[str, object] = dict(cells)
        for key in cells.keys() - texts:
            parts = [part.strip() for part in cells[key].split(";") if part.strip()]
            each = [scalar_value(part) for part in parts]
            if key in lists and not all(isinstance(value, int | float) for value in each):
                defects.append(
                    f"{where}: {key} is {shown(cells[key])}, but must be numbers parted by semicolons, as in 3.4; 3.0."
                )
            values[key] = each if key in lists or len(each) != 1 else each[0]
            cells[key] = ", ".join(parts)
        found.append(_Entry(where, values, cells))
    if not found:
        raise ConfigurationError(f"{path}: the list is empty, but must hold one structure at least.")
    return found


def _is_support(entry: object) -> bool:
    return isinstance(entry, Mapping) and entry.get("type") == TYPE_NAME


def _scene(
    name: str,
    entry: Any,
    texts: Mapping[str, str],
    places: Mapping[str, Place | None],
    where: str,
) -> Scene:
    """The scene of an entry, which is no support. places: by name; None for one that has a defect of its own.

    Warns of each size beyond its plausible range, and of a structure that is heavy for its support.
    """
    of_scene = {}
    if isinstance(entry, Mapping):
        of_scene = {key: entry[key] for key in ("stands_on", *CHECK_KEYS) if entry.get(key) is not None}
        entry = {key: value for key, value in entry.items() if key not in of_scene}
        texts = {key: text for key, text in texts.items() if key not in of_scene}
    terms = check_terms(of_scene)
    structure = structure_from_config(entry, texts)

    known = {**places, GROUND.name: GROUND}
    stands_on = of_scene.get("stands_on", GROUND.name)
    if not isinstance(stands_on, str) or stands_on not in known:
        names = [GROUND.name, *map(_repeated, places)]
        use = f"use one of {', '.join(names)}" if places else f"leave it out for {GROUND.name}"
        raise ConfigurationError(
            f"stands_on is {shown(stands_on)}, but no support of the list has this name{nearest(stands_on, places)}; "
            f"{use}, or add the support."
        )
    place = known[stands_on] or GROUND

    heavy = place.warning(name) if place.supports else None
    # What lies below that of the geometry is followed beside it, and reported where it matters.
    above = [each for each in structure.cautions if each.kind is Kind.RESTITUTION_ABOVE]
    for remark in filter(None, (*structure.described.remarks, *above, heavy)):
        warnings.warn(f"{where}: {remark}", StructureWarning, stacklevel=3)
    return Scene(name, structure, place, terms)


def _texts(node: yaml.Node) -> dict[str, str]:
    """The scalars and the lists of scalars of a mapping, as they were typed."""
    texts = {}
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        each = value.value if isinstance(value, yaml.SequenceNode) else [value]
        if isinstance(value, yaml.ScalarNode | yaml.SequenceNode):
            texts[key.value] = ", ".join(one.value for one in each if isinstance(one, yaml.ScalarNode))
    return texts
