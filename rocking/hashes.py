"""SHA-256 of what bytes, files and objects say: how a record is known by its content, and a result by its input."""

import hashlib
from collections.abc import Iterable
from pathlib import Path


def sha256_of_bytes(*parts: bytes) -> str:
    """Return the hash, in hexadecimal digits, of `parts` one after another."""
    digest = hashlib.sha256()
    for part in parts:
        digest.update(part)
    return digest.hexdigest()


def sha256_of(*contents: object) -> str:
    """Return one hash for what `contents` say, by their `repr`."""
    return sha256_of_bytes("\n".join(map(repr, contents)).encode())


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
