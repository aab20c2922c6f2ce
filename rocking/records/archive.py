"""Archive: a zip file of records, whose members are called `archive.zip/member`, as if it were a folder."""

import os
import zipfile
from functools import lru_cache
from pathlib import Path

from rocking.errors import RecordError
from rocking.records.formats.format import plain
from rocking.tables import read_start

ENDING = ".zip"
ZIPPED = b"PK\x03\x04"
"""The begin of a zip file."""
_MOST_MEMBERS = 1000
"""Members of an archive that are read; a whole event of a large network has fewer."""
_LARGEST_WHOLE = 2**30
"""Bytes of all members, unpacked."""


def is_archive(path: Path) -> bool:
    """Whether a zip file lies at `path`, called so."""
    return path.suffix.lower() == ENDING and read_start(path, len(ZIPPED)) == ZIPPED


def archive_of(path: Path) -> Path | None:
    """Return the archive of which `path` names a member, None where it names none."""
    if ENDING not in str(path).lower():
        return None
    return next((parent for parent in path.parents if is_archive(parent)), None)


def members(archive: Path) -> tuple[str, ...]:
    """Return the names of the files in `archive`, sorted, without those that systems add.

    Raises RecordError where it is damaged, is a workbook, holds too much, or names a path that leads out of it.
    """
    opened = _opened(archive)
    names = [each.filename for each in opened.infolist() if not each.is_dir()]
    if "[Content_Types].xml" in names:
        raise RecordError("this is a workbook or a document; save the sheet as CSV.")
    if len(names) > _MOST_MEMBERS:
        raise RecordError(
            f"the archive holds {len(names)} files, more than {_MOST_MEMBERS}; unpack it, or part it."
        )
    size = sum(each.file_size for each in opened.infolist())
    if size > _LARGEST_WHOLE:
        raise RecordError(f"the archive unpacks to {size} bytes, more than {_LARGEST_WHOLE}; unpack it.")
    for name in names:
        parts = name.split("/")
        if name.startswith("/") or "\\" in name or ":" in name or {"", ".", ".."} & set(parts):
            raise RecordError(
                f"the archive names a file {plain(name)[:60]!r}, which leads out of it; unpack it with care."
            )
    hidden = (".", "__MACOSX")  # with which begins what systems and programs put there
    return tuple(
        sorted(name for name in set(names) if not any(p.startswith(hidden) for p in name.split("/")))
    )


def member_bytes(path: Path, archive: Path, largest: int) -> bytes:
    """Return the bytes of the member of `archive` that `path` names, at most `largest`.

    Raises RecordError where there is none, or it is larger, cannot be unpacked, or is an archive.
    """
    name = path.relative_to(archive).as_posix()
    called = plain(f"{archive.name}/{name}")
    if name not in members(archive):
        raise RecordError(f"{called}: the archive holds no such file; mend the name.")
    opened = _opened(archive)
    entry = opened.getinfo(name)
    try:
        with opened.open(entry) as stream:
            content = stream.read(largest + 1)
    except Exception as error:  # zipfile raises what it likes: RuntimeError of what is encrypted
        raise RecordError(
            f"{called}: the file cannot be unpacked, {error}; unpack the archive yourself."
        ) from None
    if len(content) > largest:
        raise RecordError(f"{called}: the file is larger than {largest} bytes, the most that is read.")
    if content.startswith(ZIPPED):
        raise RecordError(f"{called}: this is an archive within an archive; unpack it.")
    return content


def _opened(archive: Path) -> zipfile.ZipFile:
    """Return the archive, opened once for all its members. Raises RecordError where it is damaged."""
    try:
        state = archive.stat()
        return _opened_once(str(archive), state.st_mtime_ns, state.st_size, os.getpid())
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError) as error:
        raise RecordError(f"damaged zip archive, {error}; fetch it again.") from None


@lru_cache(maxsize=4)
def _opened_once(path: str, changed: int, size: int, process: int) -> zipfile.ZipFile:
    """Return the archive at `path` as it is: `changed` and `size` are its state, and each process has its own."""
    return zipfile.ZipFile(path)
