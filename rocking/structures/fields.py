"""What a structure is described by in a file: keys with unit, bounds, meaning and plausible range.

A structure's file lists its forms; the loader, the JSON schema and the documentation follow from them.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from rocking.errors import ConfigurationError, StructureError
from rocking.quantities import LENGTHS, finite, not_negative, positive, whole, within

_KILO = ("kN", "kN/m", "kN/m²", "kN/m³")
_INWARD: dict[str, Callable[[Any], Any]] = {
    "°": np.radians,
    **dict.fromkeys(_KILO, lambda value: 1e3 * value),
}
_OUTWARD: dict[str, Callable[[Any], Any]] = {
    "°": np.degrees,
    **dict.fromkeys(_KILO, lambda value: value / 1e3),
}
"""From the unit of the file to SI and back; units that are not here are SI."""

_IN_KEYS = str.maketrans({"/": "_", "²": "2", "³": "3", "°": "deg"})
"""A unit as the key of a value ends in it."""

PHRASE = "{name} {value}"


@dataclass(frozen=True)
class Field:
    """One key of a structure in a file.

    parameter: of the constructor, and the attribute that gives the value back in SI. meaning: for the documentation.
    example: a value for a structure that stands. unit: of the file, in which the key ends; lengths m, angles °,
    forces kN. usual: plausible range in that unit; beyond it a remark, not a refusal. letter: in drawings.
    phrase: how the description says it, of {name} and {value}, which has its unit.
    schema: the JSON schema of the value. required: whether the form needs it.
    """

    parameter: str
    meaning: str
    example: object
    schema: Mapping[str, Any] = field(repr=False)
    unit: str = ""
    usual: tuple[float, float] | None = None
    letter: str = ""
    phrase: str = PHRASE
    required: bool = True

    @property
    def key(self) -> str:
        """As in the file: the parameter and its unit."""
        return f"{self.parameter}_{self.unit.translate(_IN_KEYS)}" if self.unit else self.parameter

    def inward(self, value: object) -> object:
        """Return a value of the file as the constructor takes it: in SI and radians, a list as a tuple."""
        if self.schema.get("type") == "boolean" and not isinstance(value, bool):
            raise ConfigurationError(f"{self.key} is {value!r}, but must be true or false.")
        if self.schema.get("type") != "array":
            return self._converted(value)
        if not isinstance(value, list | tuple):
            raise ConfigurationError(f"{self.key} is {value!r}, but must be a list of numbers.")
        return tuple(self._converted(each) for each in value)

    def checked(self, value: Any) -> Any:
        """Return a value in SI as a structure keeps it: floats, and a list as a tuple, within the schema's bounds.

        Raises StructureError naming the parameter. Angles are held against bounds of their own by the structure.
        """
        if self.schema.get("type") == "array":
            if not isinstance(value, tuple | list) or (self.required and not value):
                raise StructureError(f"{self.parameter} is {value!r}, but must be a list of numbers.")
            return tuple(self._bounded(each, self.schema["items"]) for each in value)
        if self.schema.get("type") == "integer":
            return whole(self.parameter, value, self.schema["minimum"], self.schema["maximum"])
        if "oneOf" in self.schema:
            number, named = self.schema["oneOf"]
            if not isinstance(value, str):
                return self._bounded(value, number)
            if value not in named["enum"]:
                names = ", ".join(named["enum"])
                raise StructureError(
                    f"{self.parameter} is {value!r}, but must be a number from 0 to 1 or one of {names}."
                )
        if "enum" in self.schema and value not in self.schema["enum"]:
            raise StructureError(
                f"{self.parameter} is {value!r}, but must be one of {', '.join(self.schema['enum'])}."
            )
        return self._bounded(value, self.schema) if self.schema.get("type") == "number" else value

    def _bounded(self, value: Any, bounds: Mapping[str, Any]) -> float:
        unit = self.unit.replace("kN", "N")
        if self.unit == "°":
            return finite(StructureError, self.parameter, value, "rad")
        if "exclusiveMinimum" in bounds or bounds.get("minimum", 0) > 0:
            value = positive(StructureError, self.parameter, value, unit)
        if "maximum" in bounds:
            return within(
                StructureError, self.parameter, value, bounds.get("minimum", 0), bounds["maximum"], unit
            )
        if "minimum" in bounds:
            return not_negative(self.parameter, value, unit)
        return finite(StructureError, self.parameter, value, unit)

    def _converted(self, value: object) -> object:
        if self.unit not in _INWARD:
            return value
        return float(_INWARD[self.unit](finite(StructureError, self.key, value, self.unit)))  # type: ignore[arg-type]

    def outward(self, value: Any) -> object:
        """Return an attribute in SI as a file gives it."""
        if isinstance(value, tuple):
            return [self.outward(each) for each in value]
        return float(_OUTWARD[self.unit](value)) if self.unit in _OUTWARD else value

    def said(self, text: str) -> str:
        """Return the phrase of the description for the value written `text`."""
        return self.phrase.format(name=self.parameter.replace("_", " "), value=text + self.suffix)

    @property
    def suffix(self) -> str:
        """The unit as it follows a number."""
        return self.unit if self.unit in ("", "°") else f" {self.unit}"

    def remark(self, kind: str, value: object) -> str:
        """Return the sentence on a value (of the file) beyond the plausible range, or nothing."""
        if self.usual is None:
            return ""
        low, high = self.usual
        values = value if isinstance(value, list | tuple) else [value]
        beyond = [each for each in values if isinstance(each, int | float) and not low <= each <= high]
        if not beyond:
            return ""
        return (
            f"{self.key} is {beyond[0]:.6g}{self.suffix}, but is usually between {low:g} and {high:g}{self.suffix} for "
            f"{article(kind)}; check the unit."
        )


@dataclass(frozen=True)
class Form:
    """One way to describe a structure in a file.

    meaning: for the documentation. fields: its keys; those that every structure may have follow. make: name of the
    class method that takes their parameters as keywords; the class itself when "".
    """

    meaning: str
    fields: tuple[Field, ...]
    make: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "fields", (*self.fields, RESTITUTION_RANGE))

    @property
    def keys(self) -> dict[str, Field]:
        """The fields by key."""
        return {each.key: each for each in self.fields}

    @property
    def required(self) -> tuple[str, ...]:
        """The keys that must be given."""
        return tuple(each.key for each in self.fields if each.required)


def number_field(
    parameter: str,
    meaning: str,
    unit: str,
    example: object,
    usual: tuple[float, float],
    letter: str = "",
    bounds: Mapping[str, float] = MappingProxyType({"minimum": 0}),
    *,
    required: bool = False,
    phrase: str = PHRASE,
) -> Field:
    """Return the field of a number, or of a list of them where `example` is one; bounds: of the JSON schema."""
    schema: dict[str, object] = {"type": "number", **bounds}
    if isinstance(example, list):
        schema = {"type": "array", "minItems": 1, "items": schema}
    return Field(parameter, meaning, example, schema, unit, usual, letter, phrase, required)


def length_field(
    parameter: str,
    meaning: str,
    example: float,
    usual: tuple[float, float],
    letter: str = "",
    *,
    required: bool = True,
    phrase: str = PHRASE,
) -> Field:
    """Return the field of a length in m."""
    bounds = {"minimum": LENGTHS[0], "maximum": LENGTHS[1]}
    return number_field(
        parameter, meaning, "m", example, usual, letter, bounds, required=required, phrase=phrase
    )


def count_field(
    parameter: str, meaning: str, example: int, bounds: tuple[int, int], required: bool = True
) -> Field:
    """Return the field of a whole number."""
    schema = {"type": "integer", "minimum": bounds[0], "maximum": bounds[1]}
    return Field(
        parameter, meaning, example, schema, usual=bounds, phrase="{value} {name}", required=required
    )


def choice_field(parameter: str, meaning: str, choices: Iterable[str], phrase: str = PHRASE) -> Field:
    """Return the optional field of one word out of `choices`, the first of them the default."""
    allowed = list(choices)
    return Field(parameter, meaning, allowed[0], {"enum": allowed}, phrase=phrase, required=False)


def flag_field(parameter: str, meaning: str, phrase: str) -> Field:
    """Return the optional field of a yes or no."""
    return Field(parameter, meaning, False, {"type": "boolean"}, phrase=phrase, required=False)


def restitution_field(*balances: str, required: bool = False) -> Field:
    """Return the field of a restitution: a number, or the name of one of `balances`."""
    number: dict[str, object] = {"type": "number", "minimum": 0, "maximum": 1}
    schema = {"oneOf": [number, {"enum": list(balances)}]} if balances else number
    meaning = "Ratio of angular velocities after and before an impact"
    meaning += ", or the name of a balance" * bool(balances)
    return Field("restitution", meaning, 0.9, schema, usual=(0.1, 1), letter="η", required=required)


RESTITUTION_RANGE = number_field(
    "restitution_range",
    "The restitution is known to plus or minus this much; left out: as the settings of the ensemble say",
    "",
    0.1,
    (0, 0.3),
    bounds={"minimum": 0, "maximum": 1},
    phrase="restitution known to ± {value}",
)
"""How well the restitution is known, of every structure."""

ONE_SIDED = flag_field(
    "one_sided", "Rocks away from what it leans on only; needs a restitution number", "one-sided"
)
"""Whether a structure leans on something."""


def article(kind: str) -> str:
    """Return `kind` with its article, in words."""
    name = kind.replace("_", " ")
    return f"{'an' if name[0] in 'aeiou' else 'a'} {name}"
