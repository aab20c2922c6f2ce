"""The description of a structure in a file: the parameters of its constructors, with unit, bounds and meaning.

A class says it in the type of each parameter: `height: Annotated[float, length("Height", 4.0, (0.1, 100), "h")]`. The
loader, the checks at birth, the JSON schema and the documentation follow from there.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, reduce
from inspect import Parameter, Signature, signature
from operator import or_
from types import NoneType
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin, get_type_hints

import numpy as np
from annotated_types import Interval, MinLen

from rocking.described import Described
from rocking.errors import SizeError, StructureError
from rocking.quantities import LENGTHS, finite, shown

Kind = TypeVar("Kind")
_SI = {
    "°": np.pi / 180,
    "kN": 1e3,
    "kN/m": 1e3,
    "kN/m²": 1e3,
    "kN/m³": 1e3,
    "MPa": 1e6,
    "GPa": 1e9,
    "mm": 1e-3,
}
"""The value of a unit of the file in SI; units that are not here are SI."""
_MOST = 1e9
"""The most that a number may be in the unit of the file where nothing less is stated: beyond it the powers of numbers,
of which inertias are made, are no numbers any more."""


@dataclass(frozen=True, eq=False)
class Value:
    """The declaration of a parameter in addition to its type.

    example: of a structure that stands; None of what stands in place of other parameters. unit: of the file; lengths m,
    angles °, forces kN. usual: plausible range in that unit; beyond it a warning, not a refusal. letter: in drawings.
    phrase: how the description says it, of {name} and {value}, which has its unit. bounds: any of ge, gt, le, lt.
    names: of what may stand in place of a number. dimension: the line of a drawing that measures it, where that has
    another name than the parameter.
    """

    meaning: str
    example: object = None
    unit: str = ""
    usual: tuple[float, float] | None = None
    letter: str = ""
    phrase: str = "{name} {value}"
    bounds: Mapping[str, float] = field(default_factory=lambda: {"ge": 0})
    names: tuple[str, ...] = ()
    dimension: str = ""

    def __repr__(self) -> str:
        """What `help` shows of it after its type."""
        return ", ".join(filter(None, (self.meaning, self.unit)))


class PlainSignature:
    """The signature of a class by the types of its parameters alone, without what is declared with them."""

    def __get__(self, _: object, kind: type) -> Signature:
        """Return the signature by which `help` shows the class."""
        of_init = signature(kind.__init__)  # type: ignore[misc]
        hints = get_type_hints(kind.__init__)  # type: ignore[misc]
        _self, *every = of_init.parameters.values()
        parameters = [
            parameter for parameter in every if parameter.name != "joints"
        ]  # which `on_joints` gives
        return Signature(
            [parameter.replace(annotation=hints.get(parameter.name, Any)) for parameter in parameters]
        )


def length(meaning: str, example: float, usual: tuple[float, float], letter: str = "", **more: Any) -> Value:
    """Return what is said of a length in m."""
    low, high = LENGTHS
    return Value(meaning, example, "m", usual, letter, bounds={"ge": low, "le": high}, **more)


def count(meaning: str, example: int, low: int, high: int) -> Value:
    """Return what is said of a whole number."""
    return Value(meaning, example, usual=(low, high), phrase="{value} {name}", bounds={"ge": low, "le": high})


def restitution_value(*balances: str) -> Value:
    """Return what is said of a restitution: a number, or the name of one of `balances`."""
    meaning = "Ratio of angular velocities after and before an impact"
    meaning += ", or the name of a balance" * bool(balances)
    return Value(meaning, 0.9, usual=(0.1, 1), letter="η", bounds={"ge": 0, "le": 1}, names=balances)


RestitutionNumber = Annotated[float, restitution_value()]
OneSided = Annotated[
    bool,
    Value("Rocks away from what it leans on only; needs a restitution number", False, phrase="one-sided"),
]


Lean = Annotated[
    float,
    Value(
        "Angle by which it stands out of plumb, outwards (to the right) positive",
        0.0,
        "°",
        (-2, 2),
        phrase="{value} out of plumb",
        bounds={"ge": -10, "le": 10},
    ),
]


CompressiveStrength = Annotated[
    float | None,
    Value(
        "Compressive strength of the masonry, at which the edges of joints crush and hinges move in; left out: they "
        "do not crush",
        2.0,
        "MPa",
        (0.5, 100),
        "f",
        phrase="compressive strength {value}",
        bounds={"ge": 1e-3},
    ),
]
OptionalUnitWeight = Annotated[
    float | None,
    Value(
        "Weight of the masonry; needed where a compressive strength is given",
        20.0,
        "kN/m³",
        (8, 30),
        bounds={"ge": 1e-6},
    ),
]


@dataclass(frozen=True)
class Field(Described):
    """One key of a structure in a file: a parameter with what is said of it; see Value."""

    value: Value = field(kw_only=True)

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is ...

    @property
    def is_list(self) -> bool:
        """Whether it holds several numbers, and never one."""
        kinds = {allowed.get("type") for allowed in self.schema.get("anyOf", [self.schema])}
        return "array" in kinds and "number" not in kinds

    @property
    def options(self) -> tuple[str, ...]:
        """The words that may be its value, or stand in place of a number."""
        kinds = (self.kind, *get_args(self.kind))
        return tuple(word for kind in kinds if get_origin(kind) is Literal for word in get_args(kind))

    @property
    def suffix(self) -> str:
        """The unit as it follows a number."""
        return self.unit if self.unit in ("", "°") else f" {self.unit}"

    def inward(self, value: object) -> object:
        """Return a value of the file as the constructor takes it: in SI and radians, a list as a tuple."""
        if isinstance(value, list | tuple):
            return tuple(self.inward(item) for item in value)
        if self.unit not in _SI:
            return value
        return _SI[self.unit] * finite(StructureError, self.key, value, self.unit)  # type: ignore[arg-type]

    def outward(self, value: Any) -> Any:
        """Return an attribute in SI as a file gives it."""
        if isinstance(value, list | tuple):
            return [self.outward(item) for item in value]
        number = isinstance(value, float | int) and not isinstance(value, bool)
        return float(value / _SI[self.unit]) if self.unit in _SI and number else value

    def in_si(self, value: Any) -> Any:
        """Return a value in SI as a structure keeps it; raises StructureError for another than is allowed."""
        if isinstance(value, list):
            value = tuple(value)
        elif isinstance(value, np.generic | np.ndarray) and value.ndim == 0:
            value = value.item()
        whole = isinstance(value, float) and value.is_integer() and int in (self.kind, *get_args(self.kind))
        outside = self.outward(int(value) if whole else value)
        if self.unit == "°" and isinstance(outside, float):
            outside = float(f"{outside:.13g}")  # an angle that came from degrees may be off by its last digit
        try:
            checked = self.checked(tuple(outside) if isinstance(outside, list) else outside)
        except ValueError:
            raise SizeError.of(self.name, shown(outside), self.demand(outside)) from None
        if self.unit not in _SI:
            return checked
        return tuple(map(float, value)) if isinstance(value, tuple) else float(value)

    @property
    def phrase(self) -> str:
        """How the description says it, of {value}, which has its unit."""
        return self.value.phrase.replace("{name}", self.name.replace("_", " "))

    def phrased(self, text: str) -> str:
        """Return the phrase of the description for the value written `text`."""
        return self.phrase.format(value=text + self.suffix)


@dataclass(frozen=True)
class Form:
    """One way to describe a structure in a file.

    type_name: the `type` in a file. meaning: for the documentation. made_of: the class of the structure. make: name of
    its class method that takes the parameters as keywords; the class itself when "". fields: its keys.
    """

    type_name: str
    meaning: str
    fields: tuple[Field, ...]
    made_of: Any
    make: str = ""

    def check(self, **values: object) -> None:
        """Check `values` by name, in SI, by what their types say; raises StructureError."""
        for key in self.fields:
            if key.name in values:
                key.in_si(values[key.name])

    def construct(self, **values: Any) -> Any:
        """Return the structure of `values` by name, in SI; raises StructureError where it cannot stand."""
        make = getattr(self.made_of, self.make) if self.make else self.made_of
        return make(**values)

    def front_of(self, sizes: Mapping[str, Any]) -> np.ndarray:
        """Return the outline of the front of that size (k, 2), m; (0, 2) for what its section shows alone."""
        return np.empty((0, 2))

    @classmethod
    def of(cls, kind: Any, make: str, meaning: str) -> "Form":
        """Return the form of a structure's class `kind` that its constructor takes, or its class method `make`.

        Such a method also passes on the options of the constructor.
        """
        parameters = dict(signature(kind).parameters)
        hints = get_type_hints(kind, include_extras=True)
        if make:
            method = getattr(kind, make)
            hints = get_type_hints(method, include_extras=True) | hints
            options = {
                n: parameter
                for n, parameter in parameters.items()
                if parameter.default is not Parameter.empty
            }
            parameters = dict(signature(method).parameters) | options
        parameters["restitution_range"] = parameters.pop("restitution_range")  # the last word
        described = []
        for name, parameter in parameters.items():
            for value in getattr(hints.get(name), "__metadata__", ()):
                if isinstance(value, Value):
                    described.append(field_of(name, hints[name].__origin__, value, parameter.default))
        return cls(kind.type_name, meaning, tuple(described), kind, make)

    @property
    def keys(self) -> dict[str, Field]:
        """The fields by key."""
        return {key.key: key for key in self.fields}

    @property
    def example(self) -> dict[str, object]:
        """An entry by key, without what only stands in place of other keys, and so has no example."""
        return {key.key: key.value.example for key in self.fields if key.value.example is not None}

    @property
    def required(self) -> tuple[str, ...]:
        """The keys that must be given."""
        return tuple(key.key for key in self.fields if key.required)


_IN_SI = {"°": "rad", "mm": "m", "MPa": "Pa", "GPa": "Pa"}
"""What a unit of the file is in SI; a k at its head goes."""


_RAISES = "    Raises\n    ------\n    StructureError\n        When it cannot stand.\n\n"


def stated(kind: type[Kind]) -> type[Kind]:
    """Let the docstring of a class state its parameters, in SI, as their types do, and what it raises."""
    hints = get_type_hints(kind, include_extras=True)
    entries = ["    Parameters\n    ----------\n"]
    for name, parameter in signature(kind).parameters.items():
        default = parameter.default
        meaning = "Of what a structure makes of itself alone; no file gives it"
        for value in getattr(hints[name], "__metadata__", ()):
            if isinstance(value, str):
                meaning = value
                continue
            unit = _IN_SI.get(value.unit, value.unit.removeprefix("k"))
            meaning = ", ".join(filter(None, (value.meaning, value.letter, unit)))
        known = "" if default is Parameter.empty else f", default {default!r}" if default else ", optional"
        entries.append(f"    {name} : {_in_words(hints[name])}{known}\n        {meaning}.\n")
    described = kind.__doc__ or ""
    if "    Raises\n" not in described:
        described = described.replace("    Examples\n", f"{_RAISES}    Examples\n")
    before, raises, after = described.partition("    Raises\n")
    kind.__doc__ = "".join([before, *entries, "\n", raises, after])
    return kind


def _in_words(hint: Any) -> str:
    """A type for a docstring: "tuple of float or None"."""
    hint = hint.__origin__ if get_origin(hint) is Annotated else hint
    if get_origin(hint) is Literal:
        return f"{{{', '.join(map(repr, get_args(hint)))}}}"
    if get_origin(hint) is tuple:
        return f"tuple of {_in_words(get_args(hint)[0])}"
    options = get_args(hint) or (hint,)
    words = ("None" if option is NoneType else option.__name__ for option in options if not get_args(option))
    return " or ".join([*(_in_words(option) for option in options if get_args(option)), *words])


def _bounded(bounds: Mapping[str, float]) -> Mapping[str, float]:
    """The bounds of a number, with an upper one where none is stated."""
    return bounds if bounds.keys() & {"lt", "le"} else {**bounds, "le": _MOST}


@cache
def constructor(kind: Any) -> Form:
    """Return the form of the constructor of a structure's class, whether or not a file may use it."""
    return Form.of(kind, "", "")


@cache
def forms(kind: Any) -> tuple[Form, ...]:
    """Return the ways to describe a structure of a class in a file; the first is that of one made otherwise."""
    return tuple(Form.of(kind, make, meaning) for make, meaning in kind._described_as.items())


def form_made_by(kind: Any, make: str) -> Form:
    """Return the form of a structure's class that its class method `make` takes in a file."""
    return next(form for form in forms(kind) if form.make == make)


def field_of(name: str, hint: Any, value: Value, default: Any = Parameter.empty) -> Field:
    """Return the key of a parameter of that type, its default `Parameter.empty` where it must be given."""
    required = default is Parameter.empty

    def kind_of(hint: Any) -> Any:
        if hint in (float, int):
            return Annotated[hint, Interval(**_bounded(value.bounds))]
        if hint is str:
            return Literal[value.names] if value.names else None
        if get_origin(hint) is tuple:
            return Annotated[tuple[kind_of(float), ...], MinLen(int(required))]  # type: ignore[misc]
        return hint

    if hint is str and not value.names:
        return Field(name, str, value.meaning, value.unit, default=... if required else default, value=value)
    options = get_args(hint) if NoneType in get_args(hint) else (hint,)
    kinds = [kind_of(option) for option in options if option is not NoneType]
    kind: Any = reduce(or_, [kind_of_option for kind_of_option in kinds if kind_of_option is not None])
    return Field(name, kind, value.meaning, value.unit, default=... if required else default, value=value)
