"""The door through which structures come in from a file: degrees and metres outside, SI and radians inside."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from rocking.errors import ConfigurationError, StructureError
from rocking.quantities import finite
from rocking.structures.arch import Arch
from rocking.structures.block import Block
from rocking.structures.frame import Frame
from rocking.structures.rigid_body import RigidBody
from rocking.structures.spire import Spire
from rocking.structures.structure import Structure
from rocking.structures.wall import Wall


@dataclass(frozen=True)
class Form:
    """One way to describe a structure: `make` takes the values of `required` and `optional` keys as keywords.

    Both map a key of the file to a parameter of `make`. Keys that end in _deg are turned into radians.
    """

    make: Callable[..., Structure]
    required: Mapping[str, str]
    optional: Mapping[str, str]

    @property
    def keys(self) -> dict[str, str]:
        """All keys with their parameters."""
        return {**self.required, **self.optional}


def _frame(column_breadth: float, column_height: float, **options: Any) -> Frame:
    return Frame(Block.of_size(column_breadth, column_height), **options)


_RESTITUTION = {"restitution": "restitution"}
_SINGLE = {**_RESTITUTION, "one_sided": "one_sided"}

FORMS: dict[str, tuple[Form, ...]] = {
    "block": (
        Form(Block.of_size, {"breadth_m": "breadth", "height_m": "height"}, _SINGLE),
        Form(Block, {"semi_diagonal_m": "semi_diagonal", "slenderness_deg": "slenderness"}, _SINGLE),
    ),
    "wall": (
        Form(
            Wall.hinged_at,
            {"height_m": "height", "hinge_height_m": "hinge_height", "thickness_m": "thickness"},
            _RESTITUTION,
        ),
        Form(
            Wall,
            {"lower_height_m": "lower_height", "upper_height_m": "upper_height", "thickness_m": "thickness"},
            _RESTITUTION,
        ),
    ),
    "arch": (
        Form(
            Arch,
            {"radius_m": "radius", "thickness_m": "thickness", "embrace_angle_deg": "embrace_angle"},
            {"voussoirs": "voussoirs", **_RESTITUTION},
        ),
    ),
    "frame": (
        Form(
            _frame,
            {
                "column_breadth_m": "column_breadth",
                "column_height_m": "column_height",
                "columns": "columns",
                "beam_mass_ratio": "beam_mass_ratio",
            },
            _RESTITUTION,
        ),
    ),
    "spire": (
        Form(
            Spire,
            {"width_m": "width", "height_m": "height"},
            {
                "wall_thickness_m": "wall_thickness",
                "plan": "plan",
                "crack_height_m": "crack_height",
                **_SINGLE,
            },
        ),
    ),
    "rigid_body": (
        Form(
            RigidBody,
            {
                "left_m": "left",
                "right_m": "right",
                "centre_height_m": "centre_height",
                "inertia_m2": "inertia",
            },
            _SINGLE,
        ),
    ),
}
"""The ways to describe each type of structure; the schema of the workflow says the same and a test compares them."""


def structure_from_config(mapping: Mapping[str, object]) -> Structure:
    """Return the structure that `mapping` describes: its type, the keys of one of FORMS, and perhaps a name.

    Lengths in m (keys …_m), angles in degrees (keys …_deg). Raises ConfigurationError when a key is unknown or missing,
    and StructureError when the geometry cannot stand.
    """
    if not isinstance(mapping, Mapping):
        raise ConfigurationError(
            f"a structure is {mapping!r}, but must be a mapping with a type and its sizes."
        )
    kind = mapping.get("type")
    if not isinstance(kind, str) or kind not in FORMS:
        raise ConfigurationError(
            f"type is {kind!r}, but must be one of {', '.join(FORMS)}{_nearest(kind, FORMS)}."
        )
    given = {
        key: value for key, value in mapping.items() if key not in ("type", "name") and value is not None
    }
    form = _form(kind, given)
    return form.make(**{form.keys[key]: _inside(key, value) for key, value in given.items()})


def _form(kind: str, given: Mapping[str, object]) -> Form:
    """The form of `kind` that the keys `given` fill; ConfigurationError names what is unknown, missing or too much."""
    forms = FORMS[kind]
    allowed = {key for form in forms for key in form.keys}
    for key in given:
        if key not in allowed:
            keys = ", ".join(sorted(allowed))
            raise ConfigurationError(
                f"{key} is not a key of {_article(kind)}{_nearest(key, allowed)}; use {keys}."
            )
    form = max(forms, key=lambda form: len(form.required.keys() & given.keys()))
    missing = [key for key in form.required if key not in given]
    if missing:
        raise ConfigurationError(f"{_article(kind)} needs {' and '.join(missing)}; give it.")
    foreign = [key for key in given if key not in form.keys]
    if foreign:
        raise ConfigurationError(
            f"{_article(kind)} is given {' and '.join(foreign)} beside {' and '.join(form.required)}; give one set."
        )
    return form


def _inside(key: str, value: Any) -> object:
    if key == "one_sided" and not isinstance(value, bool):
        raise ConfigurationError(f"one_sided is {value!r}, but must be true or false.")
    return np.radians(finite(StructureError, key, value, "°")) if key.endswith("_deg") else value


def _nearest(word: object, allowed: Iterable[str]) -> str:
    found = get_close_matches(str(word), list(allowed), n=1, cutoff=0.5)
    return f" (did you mean {found[0]}?)" if found else ""


def _article(kind: str) -> str:
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"


def load_structures(path: str | Path) -> dict[str, Structure]:
    """Return the structures listed in a YAML file, by name, in its order.

    The file is a list of mappings, each with a `name` of its own. Raises ConfigurationError with every defect at once,
    one a line.
    """
    entries = _entries(Path(path))
    structures: dict[str, Structure] = {}
    names: list[object] = []
    defects = []
    for number, entry in enumerate(entries, start=1):
        name = entry.get("name") if isinstance(entry, Mapping) else None
        where = f"{path}: structure {number}" + (f" ({name})" if name else "")
        if not isinstance(name, str) or not name.strip():
            defects.append(f"{where}: name is {name!r}, but must be a text of its own.")
        elif name in names:
            defects.append(f"{where}: the name is already taken by another structure; give each its own.")
        names.append(name)
        try:
            structures[str(name)] = structure_from_config(entry)
        except (ConfigurationError, StructureError) as error:
            defects.append(f"{where}: {error}")
    if defects:
        raise ConfigurationError("\n".join(defects))
    return structures


def _entries(path: Path) -> list[Any]:
    try:
        entries = yaml.load(path.read_text(encoding="utf-8"), _StrictLoader)
    except OSError as error:
        raise ConfigurationError(f"{path}: the structure list cannot be read ({error.strerror}).") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ConfigurationError(
            f"{path}: the structure list is not valid YAML ({' '.join(str(error).split())})."
        ) from None
    if not isinstance(entries, list) or not entries:
        raise ConfigurationError(
            f"{path}: the file holds {type(entries).__name__}, but must hold a list of structures."
        )
    return entries


class _StrictLoader(yaml.SafeLoader):
    """The safe loader, but a key given twice is a defect rather than silently the last one."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[object, object]:
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        for key in keys:
            if keys.count(key) > 1:
                raise yaml.constructor.ConstructorError(
                    None, None, f"key {key!r} is given twice", node.start_mark
                )
        return super().construct_mapping(node, deep)
