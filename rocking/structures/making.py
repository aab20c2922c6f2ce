"""Making: constructors and class methods of structures show plain types, and refuse misfits in one sentence."""

from abc import ABCMeta
from collections.abc import Callable, Iterable
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin

from rocking.errors import StructureError
from rocking.structures.fields import constructor


def plain_signature(function: Callable[..., Any]) -> Signature:
    """Return the signature with plain types, for a reader: what is said of each value stands in the documentation."""
    own = signature(function)
    plain = [each.replace(annotation=_plain(each)) for each in own.parameters.values()]
    return own.replace(parameters=plain, return_annotation=Signature.empty)


def _plain(parameter: Parameter) -> Any:
    """The type of a parameter without what is said beside it; none of options, which are those of the constructor."""
    if parameter.kind is Parameter.VAR_KEYWORD:
        return Parameter.empty
    hint = parameter.annotation
    return get_args(hint)[0] if get_origin(hint) is Annotated else hint


def plainly_refusing(make: Callable[..., Any]) -> Callable[..., Any]:
    """Return the class method `make`, which makes a structure, with a sentence for arguments that it does not take.

    Options that it hands on to the constructor are those of the type that its signature names.
    """
    own = signature(make)
    options = [_option_names(each) for each in own.parameters.values() if each.kind is Parameter.VAR_KEYWORD]
    values = [each for each in own.parameters.values() if each.kind is not Parameter.VAR_KEYWORD][1:]
    needed = [each.name for each in values if each.default is Parameter.empty]
    others = [each.name for each in values if each.name not in needed] + [*sum(options, start=())]
    taken = {*needed, *others}

    @wraps(make)
    def made(cls: type, *given: Any, **named: Any) -> Any:
        mismatch = ""
        unknown = [name for name in named if name not in taken]
        if unknown:
            mismatch = f"got an unexpected keyword argument {unknown[0]!r}"
        else:
            try:
                return make(cls, *given, **named)
            except TypeError:
                mismatch = mismatched(own, cls, *given, **named)
                if not mismatch:
                    raise
        sentence = refusal(f"{cls.__name__}.{make.__name__}", mismatch, needed, others)
        raise StructureError(f"{sentence}.") from None

    made.__signature__ = plain_signature(make)  # type: ignore[attr-defined]
    return made


def _option_names(parameter: Parameter) -> tuple[str, ...]:
    """The names that `**options: Unpack[...]` stands for."""
    (of_type,) = get_args(parameter.annotation) or (object,)
    return tuple(getattr(of_type, "__annotations__", ()))


def mismatched(own: Signature, *given: Any, **named: Any) -> str:
    """Why the arguments do not fit a signature, as Python says it; "" where they do."""
    try:
        own.bind(*given, **named)
    except TypeError as mismatch:
        return str(mismatch)
    return ""


def refusal(what: str, mismatch: str, needed: Iterable[str], others: Iterable[str]) -> str:
    """The sentence on arguments that do not fit, without its full stop."""
    return f"{what}: {mismatch}, but it takes {', '.join(needed)}, and may be given {', '.join(others)}"


class PlainlyMade(ABCMeta):
    """The kind of class that every structure is: its constructor shows plain types, and refuses in one sentence."""

    def __setattr__(cls, name: str, value: Any) -> None:
        if name == "__init__":  # which the dataclass makes when the class stands already
            value.__signature__ = plain_signature(value)
        super().__setattr__(name, value)

    @property
    def __signature__(cls) -> Signature:
        own = signature(cls.__init__)  # type: ignore[misc]
        return own.replace(parameters=[*own.parameters.values()][1:])

    if not TYPE_CHECKING:  # a type checker looks at the constructor itself

        def __call__(cls, *given: Any, **named: Any) -> Any:
            try:
                return super().__call__(*given, **named)
            except TypeError:
                mismatch = mismatched(cls.__signature__, *given, **named)
                if not mismatch:
                    raise
            raise StructureError(cls._how_it_is_made(mismatch))

    def _how_it_is_made(cls, mismatch: str) -> str:
        """The sentence on arguments that do not fit, which the `mismatch` of Python tells."""
        takes = constructor(cls)
        needed = [each.name for each in takes.fields if each.required]
        others = [each.name for each in takes.fields if not each.required]
        sentence = refusal(cls.__name__, mismatch, needed, others)
        made = [f"{cls.__name__}.{make}{signature(getattr(cls, make))}" for make in cls._other_makes()]
        return f"{sentence}; or use {made[0]}." if made else f"{sentence}."

    def _other_makes(cls) -> list[str]:
        """The class methods by which a file may describe it."""
        return [make for make in cls.__dict__.get("described_as", {}) if make]
