"""The sha256 of the files that a study reads, kept from run to run, so that a plan reads only what was touched."""

import json
import math
import os
import stat
import time
from contextlib import suppress
from pathlib import Path

from rocking.errors import RockingError
from rocking.hashes import sha256_of_file
from rocking.tables import read_whole, write_whole

_LARGEST_STORE = 500_000_000
"""Bytes of it that are read; a hundred thousand files take about 25 million."""
_SETTLED = 2.0
"""s; a file that changed more recently may change again within the same time stamp, so its hash is not kept."""

Mark = list[int]
"""Inode, size, and times of the last change of a file in ns: of its content, and of anything (ctime), which no program
can set. Two files of one mark are taken for the same."""


def mark_of(status: os.stat_result) -> Mark:
    """Return the mark of a file."""
    return [status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns]


class ContentHashes:
    """The sha256 of files, which the file `store` keeps for as long as their marks stay.

    To lose the store costs time alone. largest: bytes of a file that is looked at; None for whatever size.
    """

    def __init__(self, store: Path | None = None, largest: int | None = None) -> None:
        self._store = store
        self._largest = math.inf if largest is None else largest
        self._before: dict[str, str] = {}
        self._now: dict[str, str] = {}
        if store:
            with suppress(RockingError, ValueError, TypeError, RecursionError):
                self._before = dict(json.loads(read_whole(store, _LARGEST_STORE, RockingError)))

    def of(self, path: Path) -> str:
        """Return the sha256 of the file at `path`, "" for another kind of file, or one that is too large."""
        try:
            status = path.stat()
            if not stat.S_ISREG(status.st_mode) or status.st_size > self._largest:
                return ""
            mark = f"{path} {mark_of(status)}"
            if (sha256 := self._before.get(mark)) is None:
                sha256 = sha256_of_file(path)
        except OSError:
            return ""
        if time.time() - status.st_ctime > _SETTLED:
            self._now[mark] = sha256
        return sha256

    def save(self) -> None:
        """Keep the hashes of the files that were asked for, if the folder of the store is there."""
        if self._store and self._store.parent.is_dir() and self._now != self._before:
            write_whole(self._store, json.dumps(self._now).encode())
