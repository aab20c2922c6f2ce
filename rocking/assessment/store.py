"""Store: the results of a record's cases, kept by fingerprint, so that what did not change is not computed again.

A file holds a record. It is JSON, which is decoded by the types of the result classes alone: whatever somebody writes
into it can become numbers and texts of a result, and never a program. A file of another version of the computation, or
one whose content is not what was written, counts as none.
"""

import json
import types
import typing
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np

from rocking.errors import RockingError
from rocking.hashes import sha256_of_bytes, sha256_of_sources
from rocking.tables import read_whole, write_whole

T = TypeVar("T")

LARGEST = 200_000_000
"""Bytes of the largest file that is read."""
_WINGS = ("records", "floors", "structures", "pulses", "sine_pulse", "motion", "contacts", "assessment")
"""The parts of the package on which a result depends."""
_LIBRARIES = ("numpy", "scipy", "numba")


@cache
def computation_version() -> str:
    """Return one hash for everything that computes a result: sources of this package and versions of libraries."""
    root = Path(__file__).parents[1]
    paths = [path for wing in _WINGS for path in (root / wing).rglob("*") if path.suffix in (".py", ".json")]
    libraries = [f"{library} {version(library)}" for library in _LIBRARIES]
    return sha256_of_sources(root, [*paths, root / "quantities.py"], *libraries)


class RecordStore:
    """The results of one record in a file; `save` writes those that were used, and drops the others.

    tell: takes a sentence where the file is ignored. timings: the file for the times that the results took, which
    differs between two runs of the same input; None keeps no times.
    """

    def __init__(
        self, path: Path, tell: Callable[[str], object] = lambda _: None, timings: Path | None = None
    ) -> None:
        self._path = path
        self._timings = timings
        self._durations = _durations_in(timings) if timings is not None else {}
        self._before: Mapping[str, Any] = {}
        self._now: dict[str, Any] = {}
        if path.is_file():
            try:
                self._before = _opened(path)
            except (RockingError, ValueError, KeyError, TypeError, AttributeError) as error:
                tell(f"{path}: what was kept is ignored and recomputed, because {error or 'it is damaged'}.")

    def find(self, kind: type[T], fingerprint: str) -> T | None:
        """Return the `kind` that was kept by this fingerprint; None where there is none that can be read."""
        kept = self._before.get(fingerprint)
        if kept is None:
            return None
        try:
            result: T = decoded(kind, kept)
        except (ValueError, KeyError, TypeError, AttributeError, RockingError):
            return None
        self._now[fingerprint] = kept
        return result

    def durations(self, fingerprint: str) -> Mapping[str, float]:
        """Return the CPU time of each stage that computed what is kept, s; {} where it is not known."""
        return self._durations.get(fingerprint, {})

    def keep(self, fingerprint: str, result: object, durations: Mapping[str, float]) -> None:
        """Keep a result by its fingerprint, and the CPU time of each stage that computed it, s."""
        self._now[fingerprint] = encoded(result)
        self._durations[fingerprint] = dict(durations)

    def save(self) -> None:
        """Write the file, if it holds something else than before."""
        if self._now.keys() == self._before.keys():
            return
        content = json.dumps(self._now, separators=(",", ":")).encode()
        head = f"{computation_version()} {sha256_of_bytes(content)}\n"
        write_whole(self._path, [head.encode(), content])
        if self._timings is not None:
            own = {each: self._durations[each] for each in self._now if each in self._durations}
            write_whole(self._timings, json.dumps(own).encode())


def _durations_in(path: Path) -> dict[str, dict[str, float]]:
    """The times in a file, by fingerprint and stage; none where it is missing or damaged."""
    try:
        content = json.loads(read_whole(path, LARGEST, RockingError))
        return {
            fingerprint: {stage: float(duration) for stage, duration in stages.items()}
            for fingerprint, stages in content.items()
        }
    except (RockingError, OSError, ValueError, TypeError, AttributeError):
        return {}


def _opened(path: Path) -> Mapping[str, Any]:
    """The entries of a file. Raises ValueError, with the reason as a clause, where it is not to be used."""
    head, _, content = read_whole(path, LARGEST, RockingError).partition(b"\n")
    made_by, _, sha256 = head.decode("ascii", "replace").partition(" ")
    if made_by != computation_version():
        raise ValueError("another version of the computation made it")
    if sha256_of_bytes(content) != sha256:
        raise ValueError("its content is not what was written")
    entries = json.loads(content)
    if not isinstance(entries, dict):
        raise ValueError("it holds no results")
    return entries


def encoded(value: object) -> Any:
    """Return what JSON can hold of a result: a dataclass by its fields, an array as a list."""
    if isinstance(value, Enum):
        return value.value
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return [[encoded(key), encoded(each)] for key, each in value.items()]
    if isinstance(value, tuple | list):
        return [encoded(each) for each in value]
    if is_dataclass(value):
        return {each.name: encoded(getattr(value, each.name)) for each in fields(value) if each.init}
    raise TypeError(f"a {type(value).__name__} cannot be kept")


def decoded(kind: Any, value: Any) -> Any:
    """Return the `kind`, a type as annotations state it, of which `value` is what `encoded` gave.

    Raises ValueError, KeyError or TypeError where it is not.
    """
    origin = get_origin(kind)
    parts = get_args(kind)
    if origin in (typing.Union, types.UnionType):
        if value is None:
            return None
        kinds = [each for each in parts if each is not type(None)]
        if len(kinds) > 1:  # texts and numbers, which JSON tells apart
            if type(value) not in kinds:
                raise ValueError(value)
            return value
        return decoded(kinds[0], value)
    if origin is tuple:
        if parts[1:] == (...,):
            return tuple(decoded(parts[0], each) for each in value)
        return tuple(decoded(part, each) for part, each in zip(parts, value, strict=True))
    if origin is not None and issubclass(origin, Mapping):
        return {decoded(parts[0], key): decoded(parts[1], each) for key, each in value}
    if origin is typing.Literal:
        if value not in parts:
            raise ValueError(value)
        return value
    if kind is np.ndarray:
        array = np.array(value)
        array.flags.writeable = False
        return array
    if isinstance(kind, type) and is_dataclass(kind):
        hints = _hints(kind)
        made: Callable[..., Any] = kind
        return made(**{name: decoded(hints[name], each) for name, each in value.items()})
    if kind is float:
        return float(value)
    return kind(value)


@cache
def _hints(kind: type) -> dict[str, Any]:
    return get_type_hints(kind)
