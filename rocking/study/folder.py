"""The folder of a study: which paths in it a run may write, lock or delete, and how its logs and locks are opened.

A study may come from somebody else. So whatever a run writes lies inside its folder once links are resolved, there is
no link below the folder of the results or below what snakemake remembers, and no pipe for which a run would wait.
"""

import fcntl
import os
import re
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from rocking.errors import ConfigurationError

REMEMBERED = Path(".snakemake")
"""The folder in which snakemake and this package remember a study; it may be removed at any time."""
_PLAIN = re.compile(r"\w[\w .,+@=()~-]*(/\w[\w .,+@=()~-]*)*")
"""A path of plain characters on one line; snakemake takes braces for wildcards, and scripts hold paths as text."""
_LONGEST = 200
"""Characters of the folder of the results; with the names below it a path stays under what systems allow, 4096."""


def results_folder(name: str, *inputs: str) -> Path:
    """Return the folder of the results that the setting `results` names, seen from the folder of the study.

    inputs: files that the user wrote, which may not lie within it. Raises ConfigurationError where it is not inside the
    study after links are resolved, or where its name is more than one line of plain characters.
    """
    given = Path(name)
    path = given.relative_to(Path.cwd()) if given.is_relative_to(Path.cwd()) else given
    if not path.is_absolute() and not (_PLAIN.fullmatch(path.as_posix()) and len(name) <= _LONGEST):
        raise ConfigurationError(
            f"setting results is {name[:_LONGEST]!r}, but must be a folder inside the study, in letters, digits, "
            f"spaces and . , + - _ @ = ( ) ~ on one line of at most {_LONGEST} characters; give it another name.",
            results=name,
        )
    resolved = real(path)
    if not stands_inside(path):
        raise ConfigurationError(
            f"setting results is {name!r}, which leads to {resolved}, but must be a folder inside the study, "
            f"{Path.cwd()}; name one there.",
            results=name,
        )
    for file in inputs:
        if resolved in real(Path(file)).parents:
            raise ConfigurationError(
                f"setting results is {name!r}, but {file} lies within it; name a folder of its own for the results.",
                results=name,
            )
    return path


def real(path: Path) -> Path:
    """Return `path` once links are resolved; a link that leads to itself stays one, where `Path.resolve` raises."""
    return Path(os.path.realpath(path))


def stands_inside(path: Path) -> bool:
    """Return whether `path`, seen from the folder of the study, lies inside it once links are resolved."""
    return real(Path.cwd()) in real(path).parents


def check_own(results: Path) -> None:
    """Make sure that in the folders that a run writes stand only folders and files of their own.

    Raises ConfigurationError naming the first link, pipe or device there, before anything is opened.
    """
    for folder in (REMEMBERED, results):
        if folder.is_symlink() and not stands_inside(folder):
            raise ConfigurationError(f"{folder}: {_LINK}", path=str(folder))
        for entry in _entries(folder):
            if entry.is_symlink():
                raise ConfigurationError(f"{entry.path}: {_LINK}", path=entry.path)
            if not (entry.is_dir() or entry.is_file()):
                raise ConfigurationError(
                    f"{entry.path}: it is neither a file nor a folder, and a run would wait for it; remove it."
                )


_LINK = "it is a link, through which a run would write or delete elsewhere; remove it."


def _entries(folder: Path) -> Iterator[os.DirEntry[str]]:
    """Yield everything below `folder`, and follow no link."""
    waiting = [os.fspath(folder)]
    while waiting:
        place = waiting.pop()
        try:
            with os.scandir(place) as found:
                entries = list(found)
        except FileNotFoundError:
            continue  # not made yet, or removed by a job that is under way
        except OSError as error:
            raise ConfigurationError(
                f"{place}: it cannot be looked into, {error.strerror}; correct that."
            ) from None
        yield from entries
        waiting += [entry.path for entry in entries if entry.is_dir(follow_symlinks=False)]


def new_log(path: Path) -> BinaryIO:
    """Open a log that begins anew: a file of its own, whatever stood at `path`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.unlink(missing_ok=True)
    return os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND, 0o644), "wb")


def locked(path: Path, how: int) -> int:
    """Return a handle that holds the lock at `path` until it is closed; how: of fcntl.flock.

    Raises ConfigurationError where a link, a pipe or a device stands there, BlockingIOError where another process holds
    the lock and `how` does not wait.
    """
    path.parent.mkdir(exist_ok=True)
    if path.is_symlink():
        raise ConfigurationError(f"{path}: {_LINK}", path=str(path))
    handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o644)
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        os.close(handle)
        raise ConfigurationError(
            f"{path}: it is no file, but must be one, which a run locks; remove it.", file=path.name
        )
    fcntl.flock(handle, how)
    return handle
