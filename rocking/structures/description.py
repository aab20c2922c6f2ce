"""What a structure says in a file and in words: which of its forms, and the values of its keys as they were typed."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from itertools import pairwise
from typing import Any, NamedTuple, Self, TypeVar

import numpy as np

from rocking.errors import ConfigurationError, SizeError, StructureError
from rocking.quantities import shown
from rocking.structures.drawing import Dimension, Path, span
from rocking.structures.fields import Field, Form, constructor, forms
from rocking.structures.kinds import StructureKind
from rocking.warnings import RockingWarning

S = TypeVar("S")
"""A structure: its class stands above this module, as each describes itself."""

NOT_KEYS = ("type", "name")
"""What an entry of a list holds in addition to the keys of a form."""
LONGEST_KEY = 80
"""Characters of a key that is compared with those that exist, and repeated as it is."""
_ROCKS_OVER = ("thickness", "breadth", "width", "column_breadth")
"""The names of the size over which a body rocks, the first that it has; the breadth of a wall is its length across."""
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


class Given(NamedTuple):
    """One value of a description: its field, the value in the unit of a file, and how it would be typed."""

    field: Field
    value: Any
    text: str


@dataclass(frozen=True)
class Description:
    """What one structure says of itself: the form in which it is described, and the values of its keys.

    It is read from an entry of a list, or made of a structure; from it follow the structure, the entry, the words of a
    report and the dimension lines of a drawing.
    """

    form: Form
    values: tuple[Given, ...]

    @classmethod
    def read(cls, of_type: Sequence[Form], entry: Mapping[str, object], texts: Mapping[str, str]) -> Self:
        """Return the description that an entry of a list gives.

        of_type: the forms of its type. texts: the values as they were typed, by key, where they are known. What is
        blank, or an empty list, counts as left out. Raises ConfigurationError for a key that is unknown, missing or too
        much.
        """
        keys = [key for key in entry if key not in NOT_KEYS]
        given = {key: entry[key] for key in keys if entry[key] is not None}
        values = {key: value for key, value in given.items() if not isinstance(value, list) or value}
        form = _form(of_type, keys, values)
        typed = [
            Given(field, values[key], texts.get(key, _typed(values[key])))
            for key, field in form.keys.items()
            if key in values
        ]
        return cls(form, tuple(typed))

    @classmethod
    def of(cls, structure: Any) -> Self:
        """Return the description of a structure in the first of its forms, without options that are not given."""
        kind: Any = type(structure)
        form = forms(kind)[0]
        defaults = {field.name: field.default for field in constructor(kind).fields}
        values = []
        for field in form.fields:
            value = getattr(structure, field.name)
            is_an_option_given = value is not None and value != defaults.get(field.name)
            if field.required or is_an_option_given:
                outside = field.outward(value)
                values.append(Given(field, outside, _typed(outside, "{:.6g}")))
        return cls(form, tuple(values))

    def structure(self) -> Any:
        """Return the structure that it describes; raises StructureError, by key and as typed, where it cannot stand."""
        arguments = {given.field.name: given.field.inward(given.value) for given in self.values}
        keys = {field.name: field.key for field in self.form.fields if "_" in field.name}

        def keyed(sentence: str) -> str:
            return re.sub(r"\w+", lambda word: keys.get(word[0], word[0]), sentence)

        try:
            made = self.form.construct(**arguments)
        except SizeError as error:
            # By the key of the file, and as it was typed; of a list it is the one value that is wrong.
            key = next((field.key for field in self.form.fields if field.name == error.field), error.field)
            typed = self.entry.get(key)
            value = error.shown if typed is None or isinstance(typed, list | tuple) else shown(typed)
            raise SizeError.of(key, value, keyed(error.said)) from None
        except StructureError as error:
            error.args = (keyed(str(error)),)
            raise
        return self.describes(made)

    def describes(self, structure: S) -> S:
        """Return a structure that was just made, which from now on describes itself so."""
        object.__setattr__(structure, "_described", self)
        return structure

    @property
    def type_name(self) -> str:
        """The `type` in a file."""
        return self.form.type_name

    @property
    def entry(self) -> dict[str, object]:
        """The entry of a structure list that describes it, without a name."""
        return {"type": self.type_name, **{given.field.key: given.value for given in self.values}}

    @property
    def words(self) -> str:
        """The description in words with units: "breadth 0.6 m, height 6.0 m"."""
        shown = [given for given in self.values if given.value is not False]
        return ", ".join(given.field.phrased(given.text) for given in shown)

    @property
    def size(self) -> str:
        """Its sizes in short, as they were typed: "0.6 × 6.0 m", "10 × 1.5 m, 157.5°"."""
        by_unit: dict[str, list[str]] = {}
        for given in self.values:
            if given.field.required and given.field.unit:
                by_unit.setdefault(given.field.suffix, []).append(given.text)
        return ", ".join(" × ".join(texts) + unit for unit, texts in by_unit.items())

    @property
    def warnings(self) -> tuple[RockingWarning, ...]:
        """A warning on each size beyond its plausible range, and on a body that is broader than it is tall."""
        unusual = []
        for given in self.values:
            low, high = given.field.value.usual or (-np.inf, np.inf)
            values = given.value if isinstance(given.value, list | tuple) else [given.value]
            beyond = [
                value for value in values if isinstance(value, int | float) and not low <= value <= high
            ]
            if beyond:
                usual = {"value": beyond[0], "low": float(low), "high": float(high)}
                words = {"unit": given.field.suffix, "type": article(self.form.type_name)}
                unusual.append(
                    RockingWarning.of(StructureKind.SIZE_UNUSUAL, given.field.key, **usual, **words)
                )
        sizes = {given.field.name: given for given in self.values}
        if "storey_heights" in sizes and _are_levels(sizes["storey_heights"].value):
            storeys = sizes["storey_heights"]
            total = float(sum(storeys.value))
            unusual.append(
                RockingWarning.of(
                    StructureKind.LEVELS_TYPED, storeys.field.key, typed=storeys.text, total_m=total
                )
            )
        heights = [sizes[name] for name in ("height", "column_height") if name in sizes]
        across = [sizes[name] for name in _ROCKS_OVER if name in sizes]
        if heights and across and across[0].value > heights[0].value:
            names = {
                "height": heights[0].field.key,
                "height_m": heights[0].value,
                "across_m": across[0].value,
            }
            unusual.append(RockingWarning.of(StructureKind.BROADER_THAN_TALL, across[0].field.key, **names))
        return tuple(unusual)

    @property
    def front(self) -> np.ndarray:
        """The outline of its front (k, 2), m, next to the section; (0, 2) where its form knows none."""
        return self.form.front_of({given.field.name: given.value for given in self.values})

    def dimensions(self, paths: Mapping[str, Path | list[Path]]) -> tuple[Dimension, ...]:
        """Return the dimension line of each size, where `paths` by its name run; of a list one for each value."""
        lines = []
        paths = dict(paths)
        front = self.front
        if len(front):
            paths["front"] = span(front[0], front[1], [0.0, -0.06 * front[:, 1].max()])
        for given in self.values:
            letter = given.field.value.letter
            unit = given.field.suffix
            path = paths.get(given.field.value.dimension or given.field.name, [])
            if not isinstance(path, list):
                lines.append(Dimension(letter, given.text + unit, *path))
                continue
            # A drawing may show fewer dimensions than the list has values.
            shown = zip(given.text.split(", "), path, strict=False)
            for number, (text, own_path) in enumerate(shown, start=1):
                numbered = letter + str(number).translate(_SUBSCRIPTS)
                lines.append(Dimension(numbered, text + unit, *own_path))
        return tuple(lines)


def _are_levels(heights: Sequence[float]) -> bool:
    """Whether heights of storeys, m, may be levels above the ground: each is the one before plus a usual storey."""
    low, high = _USUAL_STOREY
    return len(heights) > 1 and all(low <= above - below <= high for below, above in pairwise(heights))


_LONGEST_LIST = 400
"""Letters of all keys of a type up to which a refusal lists them."""
_USUAL_STOREY = (2.2, 4.8)


def _form(of_type: Sequence[Form], keys_typed: Iterable[str], values: Mapping[str, object]) -> Form:
    """The form that the keys of `values` fill; ConfigurationError names what is unknown, missing or too much.

    keys_typed: those of `values`, and those whose value was left blank.
    """
    kind = article(of_type[0].type_name)
    allowed = {key for form in of_type for key in form.keys}
    for key in keys_typed:
        if key not in allowed:
            keys = ", ".join(sorted(allowed))
            if len(keys) > _LONGEST_LIST:
                required = sorted({key for form in of_type for key in form.required})
                keys = f"{', '.join(required)} or another of those in docs/pages/structures.md"
            if str(key).isdigit() and key not in values:
                raise ConfigurationError(
                    f"{key} is not a key of {kind}: a comma parts the entries within braces; write a number "
                    f"with a point, as in 3.{key}.",
                    **{str(key): None},
                )
            name = str(key) if len(str(key)) <= LONGEST_KEY else shown(key)
            raise ConfigurationError(
                f"{name} is not a key of {kind}{nearest(key, allowed)}; use {keys}.",
                **{str(key): values.get(key)},
            )
    form = max(of_type, key=lambda form: len(set(form.required) & values.keys()))
    missing = [key for key in form.required if key not in values]
    if missing:
        raise ConfigurationError(
            f"{kind} needs {' and '.join(missing)}; give {'it' if len(missing) == 1 else 'them'}.",
            **{missing[0]: None},
        )
    foreign = [key for key in values if key not in form.keys]
    if foreign:
        raise ConfigurationError(
            f"{kind} is given {' and '.join(foreign)} beside {' and '.join(form.required)}; give one set.",
            **{foreign[0]: values[foreign[0]]},
        )
    return form


def nearest(word: object, allowed: Iterable[str], likeness: float = 0.7) -> str:
    """Return the one of `allowed` that is most like a `word`, as a question that follows it; "" if none is."""
    nearest = get_close_matches(str(word)[:LONGEST_KEY], list(allowed), n=1, cutoff=likeness)
    return f" (did you mean {nearest[0]}?)" if nearest else ""


def article(kind: str) -> str:
    """Return `kind` with its article, in words."""
    name = kind.replace("_", " ")
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def _typed(value: object, number: str = "{}") -> str:
    """A value as it would be typed, a float by the format `number`: "6", "momentum", "3.5, 3.2"."""
    if isinstance(value, list | tuple):
        return ", ".join(_typed(one, number) for one in value)
    return number.format(value) if isinstance(value, float) else str(value)
