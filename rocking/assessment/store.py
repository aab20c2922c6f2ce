"""Store: the results of a record's cases, kept by fingerprint, so that what did not change is not computed again.

A file holds a record. It is JSON, which is decoded by the types of the result classes alone: whatever somebody writes
into it can become numbers and texts of a result, and never a program. A file of another version of the computation, or
one whose content is not what was written, counts as none.
"""

import json
import types
import typing
from collections.abc import Callable, Mapping, Sequence
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
from rocking.warnings import Kind, kind_of

T = TypeVar("T")

LARGEST = 200_000_000
"""Bytes of the largest file that is read."""
_WINGS = (
    *("signal", "records", "catalogue", "floors", "structures", "pulses", "sine_pulse", "motion", "contacts"),
    "assessment",
)
"""The parts of the package on which a result depends."""
_LIBRARIES = ("numpy", "scipy", "numba")
_PLAIN = {bool, int, float, str}
"""What JSON holds as it is, without a look at what else it might be."""


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
    differs between two runs of the same input; None keeps no times. former: of the steps before this one, in which
    results are looked up as well.
    """

    def __init__(
        self,
        path: Path,
        tell: Callable[[str], object] = lambda _: None,
        timings: Path | None = None,
        former: Sequence["RecordStore"] = (),
    ) -> None:
        self._path = path
        self._former = former
        self._timings = timings
        self._durations = _durations_in(timings) if timings is not None else {}
        self._before: Mapping[str, Any] = {}
        self._now: dict[str, Any] = {}
        if path.is_file():
            try:
                self._before = _opened(path)
            except (RockingError, ValueError, KeyError, TypeError, AttributeError) as error:
                tell(
                    f"{path}: the cached results are ignored and recomputed, because {error or 'it is damaged'}."
                )

    def find(self, kind: type[T], fingerprint: str) -> T | None:
        """Return the `kind` that was kept by this fingerprint; None where there is none that can be read."""
        kept = self._before.get(fingerprint)
        if kept is None:
            found = (store.find(kind, fingerprint) for store in self._former)
            return next((result for result in found if result is not None), None)
        try:
            result: T = decoded(kind, kept)
        except (ValueError, KeyError, TypeError, AttributeError, RockingError):
            return None
        self._now[fingerprint] = kept
        return result

    def durations(self, fingerprint: str) -> Mapping[str, float]:
        """Return the CPU time of each stage that computed what is kept, s; {} where it is not known."""
        found = (store.durations(fingerprint) for store in self._former)
        return self._durations.get(fingerprint) or next(filter(None, found), {})

    def keep(self, fingerprint: str, result: object, durations: Mapping[str, float]) -> None:
        """Keep a result by its fingerprint, and the CPU time of each stage that computed it, s."""
        self._now[fingerprint] = encoded(result)
        self._durations[fingerprint] = dict(durations)

    def save(self) -> None:
        """Write the file, where none stands or it holds something else than before."""
        if self._path.is_file() and self._now.keys() == self._before.keys():
            return
        content = json.dumps(self._now, separators=(",", ":")).encode()
        head = f"{computation_version()} {sha256_of_bytes(content)}\n"
        write_whole(self._path, [head.encode(), content])
        if self._timings is not None:
            own = {
                fingerprint: self._durations[fingerprint]
                for fingerprint in self._now
                if fingerprint in self._durations
            }
            write_whole(self._timings, json.dumps(own).encode())

    def stand(self) -> None:
        """Write the files where none stand, and leave those that do: what failed now may be mended."""
        if not self._path.is_file() or (self._timings is not None and not self._timings.is_file()):
            self.save()


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
    if value is None or type(value) in _PLAIN:
        return value
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return [[encoded(key), encoded(item)] for key, item in value.items()]
    if isinstance(value, tuple | list):
        return [encoded(item) for item in value]
    if is_dataclass(value):
        return {field.name: encoded(getattr(value, field.name)) for field in fields(value) if field.init}
    raise TypeError(f"a {type(value).__name__} cannot be kept")


def decoded(kind: Any, value: Any) -> Any:
    """Return the `kind`, a type as annotations state it, of which `value` is what `encoded` gave.

    Raises ValueError, KeyError or TypeError where it is not.
    """
    return decoder(kind)(value)


@cache
def decoder(kind: Any) -> Callable[[Any], Any]:
    """Return what `decoded` does with a value of `kind`: of thousands the annotation is read once."""
    origin = get_origin(kind)
    parts = get_args(kind)
    if origin in (typing.Union, types.UnionType):
        kinds = [kind for kind in parts if kind is not type(None)]

        def of_texts_and_numbers(value: Any) -> Any:  # which JSON distinguishes
            if type(value) not in kinds:
                raise ValueError(value)
            return value

        of_value = decoder(kinds[0]) if len(kinds) == 1 else of_texts_and_numbers
        return lambda value: None if value is None else of_value(value)
    if origin is tuple and parts[1:] == (...,):
        of_each = decoder(parts[0])
        return lambda value: tuple([of_each(item) for item in value])
    if origin is tuple:
        of_places = [decoder(part) for part in parts]
        return lambda value: tuple(of(item) for of, item in zip(of_places, value, strict=True))
    if origin is not None and issubclass(origin, Mapping):
        of_key, of_item = map(decoder, parts)
        return lambda value: {of_key(key): of_item(item) for key, item in value}
    if kind is np.ndarray:

        def array_of(value: Any) -> np.ndarray:
            array = np.array(value)
            array.flags.writeable = False
            return array

        return array_of
    if isinstance(kind, type) and is_dataclass(kind):
        of_fields: dict[str, Callable[[Any], Any]] = {}
        made: Callable[..., Any] = kind

        def made_of(value: Any) -> Any:
            if not of_fields:  # not before, as a case holds others of its own kind
                hints = get_type_hints(kind)
                of_fields.update((field.name, decoder(hints[field.name])) for field in fields(kind))
            return made(**{name: of_fields[name](item) for name, item in value.items()})

        return made_of
    made_by: Callable[[Any], Any] = kind_of if kind is Kind else kind
    return made_by
