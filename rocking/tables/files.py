"""Files that appear whole or not at all, and after the disk has them."""

import errno
import glob
import os
import stat
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from rocking.errors import ConfigurationError, RockingError


@contextmanager
def regular_file(path: Path) -> Iterator[BinaryIO]:
    """Open the regular file at `path` for reading: the one door by which the package reads what a user put there.

    Raises OSError for whatever cannot be opened, and for a pipe or a device, which it does not wait for.
    """
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        os.close(handle)
        raise OSError(errno.EINVAL, "it is no regular file")
    with os.fdopen(handle, "rb") as stream:
        yield stream


def read_whole(path: Path, largest: int, error: type[RockingError], name: str = "") -> bytes:
    """Return the bytes of a regular file of at most `largest` bytes, which is opened once.

    name: what the message calls it (default: its path). Raises `error` for whatever cannot be opened or is larger; a
    pipe or a device is refused without waiting for it.
    """
    name = name or str(path)
    try:
        with regular_file(path) as stream:
            content = stream.read(largest + 1)
    except (OSError, ValueError) as reason:
        why = getattr(reason, "strerror", None) or reason
        sentence = f"{name}: the file cannot be opened, {why}; give the path of a file."
        raise error(sentence, file=path.name) from None
    if len(content) > largest:
        sentence = f"{name}: the file is larger than {largest} bytes, the most that is read."
        raise error(sentence, size=len(content))
    return content


def read_start(path: Path, size: int) -> bytes:
    """Return the first `size` bytes of a regular file, all of a shorter one, and none of what cannot be opened."""
    try:
        with regular_file(path) as stream:
            return stream.read(size)
    except (OSError, ValueError):
        return b""


def write_whole(path: Path, content: bytes | Iterable[bytes]) -> None:
    """Write `content`, or its pieces, to `path` through a temporary file in its folder, so that it appears whole."""
    with whole(path) as stream:
        stream.writelines([content] if isinstance(content, bytes) else content)


@dataclass(frozen=True)
class Document:
    """A kind of file that is written where a user says.

    name: in a message; ending: of the name of the file; is_own: whether the content of a file was written as this kind.
    """

    name: str
    ending: str
    is_own: Callable[[bytes], bool]


_LARGEST_REPLACED = 2**28
"""Bytes of a file that is looked at before it is replaced; a larger one is no document of this package."""


def check_target(path: str | Path, document: Document) -> Path:
    """Return the path at which a user wants a document, before any work is done for it.

    Raises ConfigurationError for a name with another ending, and where a file exists there that was not written as this
    kind of document: it may be an input, also one that the shell put there for a pattern.
    """
    path = Path(path)
    if os.path.lexists(path):
        content = b"" if path.is_dir() else read_start(path, _LARGEST_REPLACED)
        if not document.is_own(content):
            raise ConfigurationError(
                f"{path} exists and is no {document.name} written by rocking, so it is not replaced; name another file "
                "(the shell puts every file that a pattern like *.smc matches in its place).",
                file=path.name,
            )
    if path.suffix.lower() != document.ending:
        raise ConfigurationError(
            f"{path} is to hold a {document.name}; give a name that ends in {document.ending}.",
            file=path.name,
        )
    return path


@contextmanager
def whole(path: Path) -> Iterator[BinaryIO]:
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for remnant_of_a_kill in path.parent.glob(f".{glob.escape(path.name)}.*.part"):
            remnant_of_a_kill.unlink(missing_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    except OSError as error:
        raise _unwritten(path, error) from error
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
        os.chmod(temporary, 0o644)
        written = {path: Path(temporary)}
        if (group := _TOGETHER.get()) is None:
            _put_in_place(written)
        else:
            group |= written
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError) and error.filename in (None, temporary):
            raise _unwritten(path, error) from error
        raise


_TOGETHER: ContextVar[dict[Path, Path] | None] = ContextVar("_TOGETHER", default=None)
"""The files that wait for the end of written_together, with their temporary ones."""


@contextmanager
def written_together() -> Iterator[None]:
    """Let the files that are written within appear at its end, when the disk has them all; none after an error.

    The disk takes them side by side: to wait for it after each of the nine tables of a record takes ten times as long.
    """
    waiting: dict[Path, Path] = {}
    before = _TOGETHER.set(waiting)
    try:
        yield
        _put_in_place(waiting)
    except OSError as error:
        raise _unwritten(next(iter(waiting), Path()), error) from error
    finally:
        _TOGETHER.reset(before)
        for temporary in waiting.values():
            temporary.unlink(missing_ok=True)


def _put_in_place(written: Mapping[Path, Path]) -> None:
    """Rename temporary files, after the disk has them: else a power cut may leave a name with nothing behind it."""
    if len(written) == 1:
        _sync(*written.values())
    elif written:
        try:
            with ThreadPoolExecutor(len(written)) as threads:
                list(threads.map(_sync, written.values()))
        except RuntimeError:  # where memory is short, no thread can start
            for temporary in written.values():
                _sync(temporary)
    for path, temporary in written.items():
        os.replace(temporary, path)
    for folder in {path.parent for path in written}:
        _sync(folder)


def _sync(path: Path) -> None:
    """Wait until the disk holds a file, or the names in a folder."""
    handle = os.open(os.fspath(path), os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _unwritten(path: Path, error: OSError) -> RockingError:
    reason = error.strerror or str(error)
    sentence = f"{path} cannot be written: {reason}; correct that, then start again."
    return RockingError(sentence, file=path.name)
