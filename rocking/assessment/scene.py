"""Scene: a structure at a place under the terms of a code, and the list in a file that it is read from, YAML or CSV.

Everything above a single case works on scenes. Along the periods of a support verdicts are listed side by side and not
mixed: a share of periods would be no probability. In a list, a variant is a structure with some values changed, and
follows the one that it is of. In CSV each row is an entry, and each column a key. The list is read safely, all
defects are in one message, and each size is remembered as it was typed.
"""

import json
import math
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from rocking.assessment.decide import Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.described import kind_in_words
from rocking.errors import ConfigurationError, StructureError, StructureWarning
from rocking.floors.place import GROUND, TYPE_NAME, Place, place_from_config, place_schema
from rocking.hashes import sha256_of
from rocking.quantities import finite, listed, shown
from rocking.structures import Mechanism, Structure
from rocking.structures.description import LONGEST_KEY, nearest
from rocking.structures.joints import Joints
from rocking.structures.kinds import StructureKind
from rocking.structures.structure_list import (
    NAME,
    TYPES,
    definitions,
    structure_from_config,
)
from rocking.structures.unknown_geometry import as_structure
from rocking.tables import read_edited
from rocking.tables.yaml_file import read_yaml, scalar_value
from rocking.warnings import RockingWarning

CHECK_KEYS = {
    "elastic_period_s": "For the checks of the code: period T_0 of a part that is free to vibrate, s (C8.7.1.7); "
    "left out: it is tied rigidly to what carries it",
    "support_loss_m": "Horizontal displacement at which what it carries falls, m: in the verdict below each floor, "
    "beam or vault, in the checks of the code of the corner that moves farthest; left out: nothing does",
}
"""Keys of an entry of a structure list, whatever its type, with their meaning: the fields of `CheckTerms`."""


@dataclass(frozen=True, kw_only=True)
class CheckTerms:
    """elastic_period: T_0, s; 0 of what is tied rigidly. support_loss: m; inf where nothing falls."""

    elastic_period: float = 0.0
    support_loss: float = math.inf


def check_terms(mapping: Mapping[str, object]) -> CheckTerms:
    """Return the check terms of an entry of a structure list. Raises ConfigurationError unless they are above 0.

    >>> check_terms({"type": "block", "elastic_period_s": 0.11}).elastic_period
    0.11
    """
    given: dict[str, float] = {}
    for key, term in zip(CHECK_KEYS, fields(CheckTerms), strict=True):
        if mapping.get(key) is None:
            continue
        unit = key[-1]
        number: Any = mapping[key]
        value = finite(ConfigurationError, key, number, unit)
        if not value > 0:
            raise ConfigurationError(
                f"{key} is {value:g} {unit}, but must be greater than 0; leave it out where there is none."
            )
        given[term.name] = value
    return CheckTerms(**given)


TAKEN_AS = {
    "wall": AssessmentKind.HELD_AT_CEILING,
    "cavity_wall": AssessmentKind.HELD_AT_CEILING,
    "pinnacle": AssessmentKind.ON_STILL_BASE,
}
"""What a structure is taken for by its type in a file, of those that may be meant otherwise."""


@dataclass(frozen=True)
class Scene:
    """One structure of a list, where it stands, and what its list says for the checks of a code.

    name: in the list, in every table and report. place: the ground, or a support whose periods are an axis of the
    result. variant_of: the name of the structure of which it is a variant; "" of one that is none.
    """

    name: str
    structure: Structure
    place: Place = GROUND
    terms: CheckTerms = field(default_factory=CheckTerms)
    variant_of: str = ""

    @cached_property
    def sha256(self) -> str:
        """Hash of what the list says of the structure and of its support."""
        return sha256_of(self.structure.described.entry, self.place)

    @property
    def warnings(self) -> tuple[RockingWarning, ...]:
        """What there is to say of it before it meets a record: sizes that are unusual, and what it is taken for.

        A restitution below that of the geometry is none of them: both are followed, and reported where it matters.
        """
        sizes = [
            replace(warning, about=f"{self.name}: {warning.about}")
            for warning in self.structure.described.warnings
        ]
        above = [
            replace(caution, about=self.name)
            for caution in self.structure.cautions
            if caution.kind is StructureKind.RESTITUTION_ABOVE
        ]
        heavy = self.place.warning(self.name) if self.place.supports else None
        taken_as = TAKEN_AS.get(self.structure.described.type_name)
        taken = RockingWarning(taken_as, self.name) if taken_as else None
        return (*sizes, *above, *filter(None, (heavy, taken)))


def variants_of(scenes: Mapping[str, Scene]) -> dict[str, list[str]]:
    """Return the names of the variants of each structure that has some."""
    groups: dict[str, list[str]] = {}
    for name, scene in scenes.items():
        if scene.variant_of:
            groups.setdefault(scene.variant_of, []).append(name)
    return groups


def on_joints(scenes: Mapping[str, Scene], joints: Joints) -> dict[str, Scene]:
    """Return the scenes with their structures on these joints."""
    return {
        name: replace(scene, structure=scene.structure.on_joints(joints)) for name, scene in scenes.items()
    }


def on_the_ground(structures: Mapping[str, Structure | Mechanism]) -> dict[str, Scene]:
    """Return the scenes of structures that no list puts anywhere, by name."""
    return {name: Scene(name, as_structure(structure)) for name, structure in structures.items()}


def periods_in_words(verdicts: Mapping[float, Verdict]) -> str:
    """Return the verdicts by the period [s] of a support, 0 of the ground, in intervals: one need not change once only.

    "stands on a building of T_b ≤ 0.25 s, is uncertain at T_b 0.3 s, overturns from 0.36 s on (tried to 0.6 s)".
    """
    groups = [
        (verdict, [period for period, _ in many])
        for verdict, many in groupby(sorted(verdicts.items()), lambda pair: pair[1])
    ]
    last = len(groups) - 1
    return ", ".join(
        f"{verdict.predicate} {_interval(periods, place == last)}"
        for place, (verdict, periods) in enumerate(groups)
    )


def _interval(periods: Sequence[float], is_last: bool) -> str:
    """The interval in which one verdict holds; periods: ascending, 0 of the ground."""
    first = periods[0]
    end = periods[-1]
    if end == 0:
        return "on the ground"
    if first == 0:
        whatever = "on the ground and " if is_last else ""
        return f"{whatever}on a building of T_b ≤ {end:.3g} s"
    if first == end:
        return f"at T_b {first:.3g} s"
    return f"from {first:.3g} s on (tried to {end:.3g} s)" if is_last else f"from {first:.3g} to {end:.3g} s"


def placed(structure: str, support_period: float | None) -> str:
    """Return the name of a structure with the period [s] of its support: "parapet, T_b 0.25 s"; 0: its ground."""
    if support_period is None or math.isnan(support_period):
        return structure
    return f"{structure}, T_b {support_period:.3g} s" if support_period else f"{structure}, on the ground"


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
    above_0 = {"type": "number", "exclusiveMinimum": 0}
    checks = {key: {**above_0, "description": meaning} for key, meaning in CHECK_KEYS.items()}
    of_entries = definitions({**checks, "stands_on": _STANDS_ON, "variants": _VARIANTS})
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


def load_scenes(path: str | Path, content: bytes | None = None) -> dict[str, Scene]:
    """Return the scenes that a file lists, by name, in its order; content: of a list in YAML that lies in no file.

    A YAML file is a list of mappings, each with a `name` of its own; those of type support carry others, which name
    them by `stands_on`. The variants of a structure follow it, each as "structure: variant". A CSV file, or
    the first sheet of an XLSX file, has an entry a row, without variants; see `_rows`. What there is to say of one is
    its `Scene.warnings`. Raises ConfigurationError with every defect at once, one a line.
    """
    defects: list[str] = []
    path = Path(path)
    is_table = content is None and path.suffix.lower() in (".csv", ".xlsx")
    entries = _rows(path, defects) if is_table else _entries(path, defects, content)
    places: dict[str, Place | None] = {}
    scenes: dict[str, Scene] = {}
    names: list[object] = []
    for where, entry, texts, base in sorted(entries, key=lambda entry: not _is_support(entry.values)):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        unvalued = (
            [str(key) for key, value in entry.items() if value is None] if isinstance(entry, Mapping) else []
        )
        if run_together := [key for key in unvalued if re.fullmatch(r"\w+:\S.{,60}", key)][:1]:
            # YAML reads such a key with its value, and no value.
            key, _, value = run_together[0].partition(":")
            defects.append(f"{where}: {run_together[0]} has no blank behind its colon; write {key}: {value}.")
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
        elif taken := [other for other in names if isinstance(other, str) and _alike(other) == _alike(name)]:
            unlike = "" if name in taken else f", {shown(taken[0])}, but for blanks and capitals"
            defects.append(
                f"{where}: the name is already taken by another structure{unlike}; give each its own."
            )
        names.append(name)
        try:
            if _is_support(entry):
                places[str(name)] = None  # known, though it has a defect of its own
                places[str(name)] = place_from_config(entry)
            else:
                scene = scenes[str(name)] = _scene(str(name), entry, texts, places)
                if base and base in scenes and replace(scene, name=base) == scenes[base]:
                    defects.append(
                        f"{where}: it changes nothing; give a key with another value, or remove it."
                    )
                scenes[str(name)] = replace(scene, variant_of=base)
        except (ConfigurationError, StructureError) as error:
            defects.append(f"{where}: {error}")
    carrying = {str(entry.values.get("stands_on")) for entry in entries if isinstance(entry.values, Mapping)}
    for idle in places.keys() - carrying:
        defects.append(
            f"{path}: support {_repeated(idle)} carries nothing; name it by stands_on, or remove it."
        )
    if defects:
        raise ConfigurationError("\n".join(defects))
    return scenes


def read_structures(path: str | Path) -> dict[str, Structure]:
    """Return the structures that a file lists in YAML, CSV or XLSX, by name, each as it stands on the ground.

    Those that stand on a support, whose motion they would lose, are left out with a StructureWarning.

    Parameters
    ----------
    path : str or Path
        List of structures, YAML, CSV or XLSX, in the units of a study.

    Returns
    -------
    dict of str to Structure
        The structures by name.

    Raises
    ------
    ConfigurationError
        With every defect.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore")
    ...     structures = rocking.read_structures("config/structures.yaml")
    >>> list(structures)[:2]
    ['arch 10 m', 'arch 15 m']
    """
    scenes = load_scenes(path)
    if carried := [name for name, scene in scenes.items() if scene.place != GROUND]:
        warnings.warn(
            f"{path}: structures on a support are left out, {listed(carried)}: a structure alone does not hold the "
            "motion there, which rocking.Support gives.",
            StructureWarning,
            stacklevel=2,
        )
    return {name: scene.structure for name, scene in scenes.items() if scene.place == GROUND}


def _alike(name: str) -> str:
    """A name as a reader tells it from others: whatever its blanks and capitals."""
    return " ".join(name.split()).casefold()


def _repeated(name: object) -> str:
    """The name of an entry as a sentence repeats it: without quotes, and of a long one only the begin."""
    is_short = isinstance(name, str) and len(name) <= LONGEST_KEY
    return str(name) if is_short else shown(name)


class _Entry(NamedTuple):
    """One entry of a list: its place in the file in words, its values and their texts as typed.

    base: the name of the structure that it is a variant of; "" of one that is none.
    """

    where: str
    values: Any
    texts: Mapping[str, str]
    base: str = ""


def _entries(path: Path, defects: list[str], content: bytes | None) -> list[_Entry]:
    """The entries of a structure list, the variants of each behind it. What is no variant is added to the defects."""
    entries, node = read_yaml(path, ConfigurationError, "structure list", content=content)
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


_NOTE = "note"
"""The column of a structure list in CSV for what its writer wants to remember, as # is in YAML."""
_NOTHING = ("", "-", "–", "—")
"""What is in a cell that holds nothing."""


def _rows(path: Path, defects: list[str]) -> list[_Entry]:
    """The entries of a structure list in CSV: a row each, keys as columns; an empty cell, or a dash, is not given.

    A cell means what it would in YAML. A list is parted by semicolons. Where semicolons part the cells, as in
    spreadsheets of countries of decimal commas, lists are in quotation marks, which these write themselves.
    """
    of_types = [field for of_kind in TYPES.values() for form in of_kind for field in form.fields]
    lists = {field.key for field in of_types if field.is_list}
    texts = {"name", "type", "stands_on", *(field.key for field in of_types if field.kind is str)}
    of_support = place_schema(NAME)["properties"]
    assert isinstance(of_support, dict)
    keys = ("name", "type", *(field.key for field in of_types), *of_support, "stands_on", *CHECK_KEYS)
    columns = [key for key in dict.fromkeys(keys) if key != "modes"] + [_NOTE]
    numbers = [key for key in columns if key not in texts]
    found = []
    for line, row in read_edited(path, ConfigurationError, columns, ("name", "type"), numbers):
        cells = {
            key: cell.strip() for key, cell in row.items() if cell.strip() not in _NOTHING and key != _NOTE
        }
        if not cells:
            continue
        name = cells.get("name")
        where = f"{path}: line {line}" + (f" ({_repeated(name)})" if name else "")
        values: dict[str, object] = dict(cells)
        for key in cells.keys() - texts:
            parts = [part.strip() for part in cells[key].split(";") if part.strip()]
            typed = [scalar_value(part) for part in parts]
            if key in lists and not all(isinstance(value, int | float) for value in typed):
                defects.append(
                    f"{where}: {key} is {shown(cells[key])}, but must be numbers parted by semicolons, as in 3.4; 3.0."
                )
            values[key] = typed if key in lists or len(typed) != 1 else typed[0]
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
) -> Scene:
    """The scene of an entry, which is no support. places: by name; None for one that has a defect of its own."""
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
    return Scene(name, structure, known[stands_on] or GROUND, terms)


def _texts(node: yaml.Node) -> dict[str, str]:
    """The scalars and the lists of scalars of a mapping, as they were typed."""
    texts = {}
    for key, value in node.value if isinstance(node, yaml.MappingNode) else ():
        members = value.value if isinstance(value, yaml.SequenceNode) else [value]
        if isinstance(value, yaml.ScalarNode | yaml.SequenceNode):
            texts[key.value] = ", ".join(one.value for one in members if isinstance(one, yaml.ScalarNode))
    return texts
