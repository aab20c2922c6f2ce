"""SHA-256 of what bytes, files and objects say: how a record is known by its content, and a result by its input."""

import hashlib
from collections.abc import Iterable
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Protocol, runtime_checkable

import numpy as np


def sha256_of_bytes(*parts: bytes) -> str:
    """Return the hash, in hexadecimal digits, of `parts` one after another."""
    digest = hashlib.sha256()
    for part in parts:
        digest.update(part)
    return digest.hexdigest()


def sha256_of(*contents: object) -> str:
    """Return one hash for what `contents` say, by their `repr`."""
    return sha256_of_bytes("\n".join(map(repr, contents)).encode())


@runtime_checkable
class Fingerprinted(Protocol):
    """An object that says by a hash of its own what it is known by."""

    @property
    def fingerprint(self) -> str:
        """The hash."""


def sha256_of_content(value: object) -> str:
    """Return one hash for the class of a dataclass and every one of its fields, down to numbers and texts.

    A field that is `Fingerprinted` stands for its fingerprint. Raises TypeError for a value whose content nothing
    tells, as a function, so that none is left out of the hash.
    """
    return sha256_of(_content(value))


def _content(value: object) -> object:
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, np.ndarray | np.generic):
        return value.dtype.str, value.shape, sha256_of_bytes(value.tobytes())
    if isinstance(value, tuple | list):
        return tuple(_content(item) for item in value)
    if is_dataclass(value) and not isinstance(value, type):
        of_fields = []
        for field in fields(value):
            item = getattr(value, field.name)
            of_fields.append(
                (field.name, item.fingerprint if isinstance(item, Fingerprinted) else _content(item))
            )
        kind = type(value)
        return kind.__module__, kind.__qualname__, tuple(of_fields)
    raise TypeError(f"the content of a {type(value).__name__} cannot be hashed")


def sha256_of_file(path: Path) -> str:
    """Return the hash of the file at `path`, read piece by piece. Raises OSError."""
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def sha256_of_sources(root: Path, paths: Iterable[Path], *more: str) -> str:
    """Return one hash for the names below `root` and the contents of the files at `paths`, and for the texts `more`."""
    parts = [text.encode() + b"\0" for text in more]
    for path in sorted(paths):
        parts.append(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return sha256_of_bytes(*parts)
