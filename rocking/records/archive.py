"""Archive: a zip or tar file of records, whose members are called `archive.zip/member`, as if it were a folder.

An archive within an archive is a folder in it: `event.tar/knt.tar.gz/AOM001.EW`. A workspace of gmprocess (HDF5) is an
archive of stations.
"""

import gzip
import io
import os
import tarfile
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path, PurePosixPath
from typing import Any

from rocking.errors import RecordError
from rocking.records.formats.format import plain
from rocking.records.obspy import workspace
from rocking.tables import read_start

_WORKSPACES = ".h5", ".hdf5", ".hdf", ".asdf"
ENDINGS = ".zip", ".tar", ".tar.gz", ".tgz", *_WORKSPACES
_MARKS: Mapping[str, tuple[int, bytes]] = {
    ".zip": (0, b"PK\x03\x04"),
    ".tar": (257, b"ustar"),
    ".tar.gz": (0, b"\x1f\x8b"),
    ".tgz": (0, b"\x1f\x8b"),
    **dict.fromkeys(_WORKSPACES, (0, workspace.MARK)),
}
"""Where a file that is called so has which bytes."""
_MOST_MEMBERS = 10_000
"""Members of an archive that are read; a whole event of a large network has fewer."""
_LARGEST_WHOLE = 2**30
"""Bytes of all members, unpacked."""
_LARGEST_NESTED = 2**28
"""Bytes of an archive within another one."""
_DEEPEST = 3
"""Archives one in another."""
_LARGEST_TAR = 2**29
"""Bytes of a packed tar file, which is unpacked as one."""


def ending_of(name: str) -> str:
    """Return the ending by which a file is called an archive, "" where it is not."""
    return next((end for end in ENDINGS if name.lower().endswith(end)), "")


def is_archive(path: Path) -> bool:
    """Whether an archive lies at `path`, called so."""
    ending = ending_of(path.name)
    return bool(ending) and _is_marked(ending, read_start(path, 512))


def _is_marked(ending: str, head: bytes) -> bool:
    at, mark = _MARKS[ending]
    return head[at : at + len(mark)] == mark


def archive_of(path: Path) -> Path | None:
    """Return the archive on this machine of which `path` names a member, None where it names none."""
    if not any(ending_of(part) for part in path.parts[:-1]):
        return None
    return next((parent for parent in path.parents if is_archive(parent)), None)


def members(archive: Path) -> tuple[str, ...]:
    """Return the names of the files in `archive` and in archives in it, sorted, without those that systems add.

    Raises RecordError where it is damaged, is a workbook, holds too much, or names a path that leads out of it.
    """
    names: list[str] = []
    waiting = [("", 1)]
    while waiting:
        place, depth = waiting.pop()
        packed = _packed(archive, place)
        for name in packed.names:
            whole = f"{place}/{name}" if place else name
            if name in packed.passed_over:
                continue
            if depth < _DEEPEST and ending_of(name) and _is_nested(packed, name):
                waiting.append((whole, depth + 1))
            else:
                names.append(whole)
        if len(names) > _MOST_MEMBERS:
            raise RecordError(
                f"the archive holds {len(names)} files, more than {_MOST_MEMBERS}; unpack it, or part it.",
                files=len(names),
            )
    return tuple(sorted(names))


def _is_nested(packed: "_Packed", name: str) -> bool:
    try:
        return _is_marked(ending_of(name), packed.start(name, 512))
    except RecordError:
        return False


def member_bytes(path: Path, archive: Path, largest: int) -> bytes:
    """Return the bytes of the member of `archive` that `path` names, at most `largest`.

    Raises RecordError where there is none, or it is larger, cannot be unpacked, or is an archive too deep in others.
    """
    name = path.relative_to(archive).as_posix()
    called = plain(f"{archive.name}/{name}")
    place, rest = _place_in(archive, name)
    packed = _packed(archive, place)
    if rest not in packed.names:
        raise RecordError(f"{called}: the archive holds no such file; correct the name.", file=name)
    content = packed.whole(rest, largest, called)
    ending = ending_of(rest)
    if ending and _is_marked(ending, content[:512]):
        raise RecordError(f"{called}: this is an archive, {_DEEPEST} deep in others; unpack it.", file=name)
    return content


def _place_in(archive: Path, name: str) -> tuple[str, str]:
    """Return the archive within `archive` that a member lies in, "" for itself, and the name of the member there."""
    place = ""
    rest = name
    for _ in range(_DEEPEST - 1):
        packed = _packed(archive, place)
        parents = [
            parent.as_posix() for parent in PurePosixPath(rest).parents if parent.as_posix() in packed.names
        ]
        inner = next((parent for parent in parents if ending_of(parent)), "")
        if not inner:
            break
        place = f"{place}/{inner}" if place else inner
        rest = rest.removeprefix(f"{inner}/")
    return place, rest


@dataclass(frozen=True)
class _Packed:
    """An opened archive: the names of its files, those of systems left out, and what reads the start of one of them.

    passed_over: those that are read only where they are named: raw motion that is in the archive processed as well.
    """

    names: frozenset[str]
    start_of: Callable[[str, int], bytes]
    passed_over: frozenset[str] = frozenset()

    def start(self, name: str, size: int, called: str = "") -> bytes:
        """Return the first bytes of a member. Raises RecordError where it cannot be unpacked."""
        try:
            return self.start_of(name, size)
        except RecordError as error:
            raise RecordError(f"{called or plain(name)}: {error}", **{error.field: error.value}) from None
        except Exception as error:  # zipfile raises what it likes: RuntimeError of what is encrypted
            raise RecordError(
                f"{called or plain(name)}: the file cannot be unpacked, {error}; unpack the archive yourself.",
                file=name,
            ) from error

    def whole(self, name: str, largest: int, called: str = "") -> bytes:
        """Return a member. Raises RecordError where it is larger than allowed, or cannot be unpacked."""
        content = self.start(name, largest + 1, called)
        if len(content) > largest:
            raise RecordError(
                f"{called or plain(name)}: the file is larger than {largest} bytes, the most that is read.",
                size=len(content),
            )
        return content


def _packed(archive: Path, place: str) -> _Packed:
    """Return the archive, or the one at `place` in it, opened once for all its members.

    Raises RecordError where it is damaged, or holds what is not allowed.
    """
    try:
        state = archive.stat()
        return _opened_once(str(archive), place, state.st_mtime_ns, state.st_size, os.getpid())
    except (RecordError, MemoryError, AttributeError, NameError):  # the last two are faults of ours
        raise
    except Exception as error:  # the libraries raise what they like of an archive that is damaged
        ending = ending_of(place or archive.name)
        kind = "HDF5" if ending in _WORKSPACES else "zip" if ending == ".zip" else "tar"
        raise RecordError(
            f"damaged {kind} archive, {error}; fetch it again.", format=f"{kind} archive"
        ) from error


@lru_cache(maxsize=8)
def _opened_once(path: str, place: str, _changed: int, _size: int, _process: int) -> _Packed:
    """Return the archive at `path`, once for each state of it (when it changed, its size) and each process."""
    if not place:
        return _of_content(path, path)
    outer, rest = _place_in(Path(path), place)
    return _of_content(_packed(Path(path), outer).whole(rest, _LARGEST_NESTED), rest)


def _of_content(source: str | bytes, name: str) -> _Packed:
    """Return the archive at a path, or in bytes."""
    if name.lower().endswith(".zip"):
        return _of_zip(zipfile.ZipFile(source if isinstance(source, str) else io.BytesIO(source)))
    if ending_of(name) in _WORKSPACES:
        return _of_workspace(source)
    if not name.lower().endswith(".tar"):
        with gzip.open(source if isinstance(source, str) else io.BytesIO(source)) as packed:
            source = packed.read(_LARGEST_TAR + 1)
        if len(source) > _LARGEST_TAR:
            raise RecordError(
                f"the archive unpacks to more than {_LARGEST_TAR} bytes; unpack it.", size=len(source)
            )
    return _of_tar(source)


def _of_zip(archive: zipfile.ZipFile) -> _Packed:
    def start_of(name: str, size: int) -> bytes:
        with archive.open(name) as stream:
            return stream.read(size)

    sizes = {entry.filename: entry.file_size for entry in archive.infolist() if not entry.is_dir()}
    return _Packed(_checked(sizes), start_of)


def _of_tar(source: str | bytes) -> _Packed:
    """Its files lie in it as they are, so that none of it stays open."""
    end = Path(source).stat().st_size if isinstance(source, str) else len(source)
    stream = None if isinstance(source, str) else io.BytesIO(source)
    with tarfile.open(source if isinstance(source, str) else None, "r:", stream) as archive:
        entries = [entry for entry in archive.getmembers() if entry.isreg() and not entry.issparse()]
    if end % tarfile.BLOCKSIZE or any(entry.offset_data + entry.size > end for entry in entries):
        raise tarfile.ReadError("it is cut")
    places = {entry.name.removeprefix("./"): (entry.offset_data, entry.size) for entry in entries}

    def start_of(name: str, size: int) -> bytes:
        at, whole = places[name]
        if isinstance(source, bytes):
            return source[at : at + min(size, whole)]
        with Path(source).open("rb") as opened:
            opened.seek(at)
            return opened.read(min(size, whole))

    return _Packed(_checked({name: size for name, (_, size) in places.items()}), start_of)


def _of_workspace(source: str | bytes) -> _Packed:
    """Its stations are its files; it is opened anew for each, so that it does not stay open."""

    def opened() -> Any:
        return workspace.opened(source if isinstance(source, str) else io.BytesIO(source))

    def start_of(name: str, size: int) -> bytes:
        with opened() as file:
            return workspace.station_content(file, name, size)[:size]

    with opened() as file:
        names, passed_over = workspace.stations(file)
    return _Packed(_checked(dict.fromkeys(names, 0)), start_of, passed_over)


def _checked(sizes: Mapping[str, int]) -> frozenset[str]:
    """Return the names of the files of an archive, by their sizes in bytes, without those that systems add.

    Raises RecordError where it is a workbook, holds too much, or names a path that leads out of it.
    """
    if "[Content_Types].xml" in sizes:
        raise RecordError("this is a workbook or a document; save the sheet as CSV.", format="workbook")
    if (size := sum(sizes.values())) > _LARGEST_WHOLE:
        raise RecordError(
            f"the archive unpacks to {size} bytes, more than {_LARGEST_WHOLE}; unpack it.", size=size
        )
    for name in sizes:
        parts = name.split("/")
        if name.startswith("/") or "\\" in name or ":" in name or {"", ".", ".."} & set(parts):
            raise RecordError(
                f"the archive names a file {plain(name)[:60]!r}, which leads out of it; unpack it with care.",
                file=name,
            )
    hidden = (".", "__MACOSX")  # with which begins what systems and programs put there
    return frozenset(name for name in sizes if not any(part.startswith(hidden) for part in name.split("/")))
