"""The page of public names, from their signatures and docstrings."""

import inspect
from collections.abc import Iterator
from dataclasses import is_dataclass
from enum import EnumType
from functools import cached_property
from html import escape
from importlib import import_module

MODULES = (
    "rocking",
    "rocking.records",
    "rocking.pulses",
    "rocking.structures",
    "rocking.sine_pulse",
    "rocking.motion",
)
"""Where public names stand; a name is described where it is met first."""

_WIDTH = 90
"""Letters of a signature that stand on one line."""


def python_names() -> str:
    """Return the Markdown of every public name of MODULES."""
    seen: set[int] = set()
    return "\n\n".join(_module(name, seen) for name in MODULES)


def _module(name: str, seen: set[int]) -> str:
    module = import_module(name)
    found = [(public, getattr(module, public)) for public in module.__all__]
    new = [(public, value) for public, value in found if id(value) not in seen]
    seen |= {id(value) for _, value in new}
    parts = [f"## {name}", _docstring(module), *(_described(name, *pair) for pair in new)]
    return "\n\n".join(parts)


def _described(module: str, name: str, value: object) -> str:
    head = f"### {name}\n\n<code>from {module} import {name}</code>"
    if not callable(value):
        return f"{head}\n\n{_preformatted(repr(value))}"
    if isinstance(value, EnumType):
        members = ", ".join(f"`{member.name}`" for member in value)  # type: ignore[var-annotated]
        return f"{head}\n\n{_docstring(value)}\n\nOne of {members}."
    parts = [head, _preformatted(_signature(name, value)), _docstring(value)]
    if inspect.isclass(value):
        parts += _members(value)
    return "\n\n".join(part for part in parts if part)


def _signature(name: str, value) -> str:
    if inspect.isclass(value) and not is_dataclass(value):
        return name
    signature = inspect.signature(value)
    text = f"{name}{signature}".removesuffix(" -> None")
    if len(text) < _WIDTH:
        return text
    lines = [f"    {parameter}," for parameter in signature.parameters.values()]
    kinds = [parameter.kind for parameter in signature.parameters.values()]
    if inspect.Parameter.KEYWORD_ONLY in kinds:
        lines.insert(kinds.index(inspect.Parameter.KEYWORD_ONLY), "    *,")
    return "\n".join([f"{name}(", *lines, f"){text.rpartition(')')[2]}"])


def _members(owner: type) -> Iterator[str]:
    for name, member in inspect.getmembers(owner):
        if name.startswith("_") or name not in _own_names(owner):
            continue
        if isinstance(member, property | cached_property):
            yield f"#### .{name}\n\n{_docstring(member)}"
        elif inspect.isroutine(member) and member.__doc__:
            yield f"#### .{name}\n\n{_preformatted(_signature(name, member))}\n\n{_docstring(member)}"


def _own_names(owner: type) -> set[str]:
    ours = (base for base in owner.__mro__ if base.__module__.startswith("rocking"))
    return {name for base in ours for name in vars(base)}


def _docstring(value: object) -> str:
    text = inspect.getdoc(value) or ""
    return f'<div class="docstring">{escape(text).replace(chr(10) * 2, "<br><br>")}</div>' if text else ""


def _preformatted(text: str) -> str:
    return f"<pre><code>{escape(text)}</code></pre>"
