"""A described value: type, unit, bounds and meaning said once, for settings, structures, catalogue and columns.

pydantic decides what a type and its bounds allow, and strictly: neither a text nor a truth is a number. It also writes
the JSON schema, from which the sentences of an error are made. It is imported only where a value is not its default.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, is_dataclass, replace
from difflib import get_close_matches
from functools import cache, cached_property
from operator import ge, gt, le, lt
from types import MappingProxyType, NoneType
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin, get_type_hints

from rocking.errors import RockingError
from rocking.quantities import shown

T = TypeVar("T")

_IN_KEYS = str.maketrans({"/": "_", "²": "2", "³": "3", "°": "deg", "H": "h"})
"""A unit as the key of a value ends in it."""


_COMPARED = {"gt": gt, "ge": ge, "lt": lt, "le": le}
_HUGE = 1e300
"""Beyond it a whole number may be no number with a point."""


@dataclass(frozen=True)
class Described:
    """The declaration of one value.

    name: of the attribute. kind: its type. unit: of the value in a file, in which its key ends. one_of: gives the names
    that are allowed, where a registry holds them. bounds: any of gt, ge, lt, le, of a text the pattern that it matches
    and examples. default: ... where there is none. more: what some kinds of values say besides; of a choice, formerly:
    today's names by those of earlier versions.
    """

    name: str
    kind: Any
    meaning: str
    unit: str = ""
    one_of: Callable[[], tuple[str, ...]] | None = None
    bounds: Mapping[str, Any] = field(default_factory=dict)
    default: Any = ...
    more: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def _end(self) -> str:
        return f"_{self.unit.translate(_IN_KEYS)}" if self.unit else ""

    @cached_property
    def key(self) -> str:
        """The name in a file: with the unit at its end."""
        return self.name if self.name.endswith(self._end) else self.name + self._end

    @cached_property
    def attribute(self) -> str:
        """The name without the unit."""
        return self.name.removesuffix(self._end)

    @cached_property
    def holds(self) -> Any:
        """The type of a value that is not None."""
        kind = self.kind
        if self.optional:
            kind = next(choice for choice in get_args(self.kind) if choice is not NoneType)
        return get_origin(kind) or kind

    @cached_property
    def item(self) -> Any:
        """The type of each value of a tuple."""
        return get_args(self.kind)[0]

    @cached_property
    def optional(self) -> bool:
        """Whether it may be None."""
        return NoneType in get_args(self.kind)

    @cached_property
    def _adapter(self) -> Any:
        from pydantic import ConfigDict, Field, TypeAdapter  # takes 0.1 s, and defaults need no check

        kind: Any = Literal[self.one_of()] if self.one_of else self.kind
        limits: dict[str, Any] = dict(self.bounds)
        is_text = str in (kind, *get_args(kind))
        if is_text and self.default != "":
            limits["min_length"] = 1  # a text is empty only where that is its default
        config = ConfigDict(strict=True, allow_inf_nan=False)
        return TypeAdapter(Annotated[kind, Field(**limits)], config=config)

    @cached_property
    def schema(self) -> dict[str, Any]:
        """The JSON schema of the value."""
        return dict(self._adapter.json_schema())

    @property
    def must(self) -> str:
        """The values that are allowed, in words: "a number above 0 and up to 0.5 or null"."""
        return _words(self.schema)

    def checked(self, value: Any) -> Any:
        """Return an allowed value with the type of its description: 1 as 1.0 where a number is asked for.

        Raises ValueError for another: "-1 s, but must be a number above 0 or null."
        """
        is_the_default = type(value) is type(self.default) and value == self.default
        if is_the_default:
            return value
        if self._is_plainly_allowed(value):
            return float(value) if type(value) is int and self.holds is float else value
        try:
            return self._adapter.validate_python(value)
        except ValueError:
            raise ValueError(f"{shown(value)}{self.demand(value)}") from None

    def _is_plainly_allowed(self, value: object) -> bool:
        """Whether it is seen without pydantic, which takes 0.11 s to import, that a value of plain type is allowed."""
        if self.one_of is not None:
            return type(value) is str and value in self.one_of()
        if self.optional and (value is None or len(get_args(self.kind)) > 2):
            return value is None
        if self.holds is Literal:
            return type(value) is str and value in get_args(self.kind)
        if self.holds is bool:
            return type(value) is bool
        if self.holds is str:
            return type(value) is str and value != "" and not self.bounds
        if self.holds not in (int, float) or type(value) not in (int, self.holds):
            return False
        number: Any = value
        within = (_COMPARED[name](number, bound) for name, bound in self.bounds.items() if name in _COMPARED)
        return self.bounds.keys() <= _COMPARED.keys() and -_HUGE < number < _HUGE and all(within)

    def demand(self, value: object) -> str:
        """Return the end of the sentence on a `value` that is not allowed: " m, but must be a number above 0."."""
        unit = f" {self.unit}" if self.unit and type(value) in (int, float) else ""
        hint = number_hint(value) if "number" in self.must else ""
        if isinstance(value, str) and value in self.more.get("formerly", {}):
            hint = f"; write {self.more['formerly'][value]}"
        if self.must.startswith("a list") and type(value) in (int, float):
            hint = f"; write [{shown(value)}]"
        return f"{unit}, but must be {self.must}{hint}."


def described(
    default: Any,
    meaning: str,
    unit: str = "",
    *,
    one_of: Callable[[], tuple[str, ...]] | None = None,
    gt: float | None = None,
    ge: float | None = None,
    lt: float | None = None,
    le: float | None = None,
    pattern: str | None = None,
    examples: Sequence[str] | None = None,
    **more: object,
) -> Any:
    """Declare a field of a frozen dataclass with all there is to say of its value; see Described."""
    possible = {"gt": gt, "ge": ge, "lt": lt, "le": le, "pattern": pattern, "examples": examples}
    bounds = {name: bound for name, bound in possible.items() if bound is not None}
    facts = {"meaning": meaning, "unit": unit, "one_of": one_of, "bounds": bounds, "more": more}
    return field(default=default, metadata=facts)


@cache
def described_values(kind: Any) -> Mapping[str, Described]:
    """Return the descriptions of the fields of a dataclass, by their name."""
    hints = get_type_hints(kind, include_extras=True)
    return {
        part.name: Described(part.name, hints[part.name], default=part.default, **part.metadata)
        for part in fields(kind)
        if "bounds" in part.metadata
    }


@cache
def _keys(kind: Any) -> frozenset[str]:
    """The keys of a dataclass of described values."""
    return frozenset(value.key for value in described_values(kind).values())


@cache
def parts_of(kind: Any) -> tuple[str, ...]:
    """Return the names of the fields of a dataclass whose default is a dataclass of described values."""
    return tuple(part.name for part in fields(kind) if is_dataclass(part.default))


def check_described(error: type[RockingError], made: Any) -> None:
    """Check every described value of the frozen dataclass `made` by its type and bounds.

    A part of its own must be of the class of its default. Raises `error` naming the first field that is wrong.
    """
    kind = made.__class__
    for name, declared in described_values(kind).items():
        value = getattr(made, name)
        try:
            object.__setattr__(made, name, declared.checked(value))
        except ValueError as wrong:
            raise error(f"{name} is {wrong}", **{name: value}) from None
    for name in parts_of(kind):
        part = getattr(made, name)
        expected = type(getattr(kind, name))
        if not isinstance(part, expected):
            raise error(f"{name} is {shown(part)}, but must be a {expected.__name__}.", **{name: part})


def read_described(
    default: T,
    mapping: object,
    defects: list[str],
    above: str = "",
    interpret: Callable[[Any], Any] = lambda value: value,
    beside: Mapping[str, Any] = MappingProxyType({}),
) -> T:
    """Return `default`, a dataclass of described values, with the values that `mapping` gives by their keys.

    A field whose default is a dataclass is a mapping of its own. above: what stands before a key in a sentence.
    interpret: gives what a text means that is not allowed as it stands. beside: the parts beside this one by their
    name, of which one may have a key that stands here by mistake. Each defect adds a sentence to `defects`: the key,
    its value and what is allowed.
    """
    kind: Any = type(default)
    allowed = {value.key: value for value in described_values(kind).values()}
    parts = {name: getattr(default, name) for name in parts_of(kind)}
    names = [*allowed, *parts]
    if not isinstance(mapping, Mapping):
        defects.append(
            f"{above.rstrip('.')} is {shown(mapping)}, but must be a mapping of {', '.join(names)}."
        )
        return default
    values = {}
    before = len(defects)
    for key, value in mapping.items():
        if key in parts:
            values[key] = read_described(parts[key], value, defects, f"{above}{key}.", interpret, parts)
        elif key not in allowed:
            defects.append(above + _nothing_has_the_name(key, value, names, {**beside, **parts}))
        else:
            try:
                values[allowed[key].name] = _meant(allowed[key], value, interpret)
            except ValueError as refusal:
                defects.append(f"{above}{key} is {refusal}")

    has_defects = len(defects) > before
    if has_defects:
        return default
    try:
        return replace(default, **values)  # type: ignore[type-var]
    except RockingError as wrong:  # values that are allowed each, but not together
        defects.append(f"{above}{wrong}")
        return default


def _meant(description: Described, value: Any, interpret: Callable[[Any], Any]) -> Any:
    """Return an allowed value, of a text also what it means. Raises ValueError on the value as it stands."""
    try:
        return description.checked(value)
    except ValueError:
        if not isinstance(value, str):
            raise
        with suppress(ValueError):
            return description.checked(interpret(value))
        raise


def _nothing_has_the_name(key: object, value: object, names: Sequence[str], parts: Mapping[str, Any]) -> str:
    """Return the sentence on a key that is none of `names`, with the one that may be meant.

    parts: by their name those that may have such a key.
    """
    name = str(key)
    in_a_part = [f"{part}.{key}" for part, default in parts.items() if key in _keys(default.__class__)]
    near = in_a_part or get_close_matches(name[:_LONGEST_NAME], names, n=1, cutoff=0.6)
    if value is None and name.isdigit():
        hint = "a comma parts the entries within braces; write a number with a point, as in 6.4."
    elif near:
        hint = f"did you mean {near[0]}?"
    else:
        hint = f"the names are {', '.join(names)}."
    printed = name if len(name) <= _LONGEST_NAME else shown(key)
    return f"{printed} is {shown(value)}, but nothing has this name; {hint}"


def kind_in_words(value: object) -> str:
    """Return what a value of YAML is, in words: "a list"."""
    kinds = {dict: "a mapping", list: "a list", str: "a text", bool: "a truth", NoneType: "nothing"}
    return kinds.get(type(value), "a number")


def number_hint(value: object) -> str:
    """Return the end of a sentence on a text that stands for a number, what to write instead, "" for another value."""
    if not isinstance(value, str):
        return ""
    text = value.strip()
    if _IN_QUOTES.fullmatch(text):
        return "; write the number without quotation marks"
    if _WITH_COMMA.fullmatch(text):
        return f"; a number is written with a point, {text.replace(',', '.')}"
    with_unit = _WITH_UNIT.fullmatch(text)
    if with_unit:
        # Not the number itself: that of "300 cm" would be read in another unit.
        return f"; write the number alone, without {with_unit['unit']!r}, in the unit asked for"
    return ""


_IN_QUOTES = re.compile(r"[-+]?(\d{1,12}(\.\d{0,12})?|\.\d{1,12})([eE][-+]?\d{1,3})?")
_WITH_COMMA = re.compile(r"[-+]?\d{1,12},\d{1,12}([eE][-+]?\d{1,3})?")
_WITH_UNIT = re.compile(
    r"[-+]?(\d{1,12}([.,]\d{0,12})?|[.,]\d{1,12})([eE][-+]?\d{1,3})?\s?(?P<unit>[a-zA-Zµ°%][a-zA-Zµ°%²³/^*0-9-]{0,9})"
)
_LONGEST_NAME = 80
"""Characters of a name that is compared with those that exist, and repeated as it is."""


def _words(schema: Mapping[str, Any]) -> str:
    """The values that a JSON schema allows, in words."""
    examples = schema.get("examples")
    if examples:
        bare = {key: value for key, value in schema.items() if key != "examples"}
        return _words(bare).replace("a text that is not empty", f"a text like {' or '.join(examples)}", 1)
    options = schema.get("anyOf") or schema.get("oneOf")
    if options:
        return " or ".join(map(_words, options))
    names = schema.get("enum") or ([schema["const"]] if "const" in schema else None)
    if names:
        return " or ".join("null" if name is None else str(name) for name in names)
    if schema["type"] == "array":
        return f"a list, each of it {_words(schema['items'])}"
    kind = _TYPES[schema["type"]]
    if "minLength" in schema:
        kind += " that is not empty"
    return kind + _limits(schema)


def _limits(schema: Mapping[str, Any]) -> str:
    """The bounds of a number in a JSON schema: " from 0 to 1", " above 0 and up to 0.5", or nothing."""
    if "minimum" in schema and "maximum" in schema:
        return f" from {schema['minimum']:g} to {schema['maximum']:g}"
    limits = [f"{words} {schema[name]:g}" for name, words in _LIMITS.items() if name in schema]
    return f" {' and '.join(limits)}" if limits else ""


_TYPES = {
    "integer": "a whole number",
    "number": "a number",
    "boolean": "true or false",
    "string": "a text",
    "null": "null",
}
_LIMITS = {
    "exclusiveMinimum": "above",
    "minimum": "of at least",
    "exclusiveMaximum": "below",
    "maximum": "up to",
}
