"""What a study reads, by content: an edit is seen whatever the clock says, and a comment changes nothing."""

import hashlib
import json
import time
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

import yaml

from rocking.errors import ConfigurationError
from rocking.records.catalogue import CatalogueRecord
from rocking.records.fetch import local_files
from rocking.structures import Structure, load_structures
from rocking.study.settings import Settings
from rocking.tables import write_whole

_SETTLED = 2.0
"""s; a file that changed more recently may change again without its times telling, so its hash is not kept."""


class ContentHashes:
    """The sha256 of files. store: a file that keeps them from run to run, for as long as a file's size and times stay.

    The time of the last change (ctime), which no program can set, stands among them.
    """

    def __init__(self, store: Path | None = None) -> None:
        self._store = store
        self._known = _stored(store) if store else {}
        self._kept: dict[str, list[object]] = {}

    def of(self, path: Path) -> str:
        """Return the sha256 of the file at `path`, "" where it cannot be read."""
        try:
            status = path.stat()
            marks = [status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino]
            known = self._known.get(str(path))
            found = str(known[-1]) if known and known[:-1] == marks else _sha256(path)
        except OSError:
            return ""
        if time.time() - status.st_ctime > _SETTLED:
            self._kept[str(path)] = [*marks, found]
        return found

    def save(self) -> None:
        """Keep what is known of the files that were asked for, if the folder of the store is there."""
        if self._store and self._store.parent.is_dir() and self._kept != self._known:
            write_whole(self._store, json.dumps(self._kept).encode())


def files_sha256(records: Iterable[CatalogueRecord], settings: Settings, hashes: ContentHashes) -> str:
    """Return one hash for the files on this machine from which `records` are read, StationXML among them."""
    files = {p for record in records for p in local_files(record, settings.mirror)}
    lines = [f"{path}\0{hashes.of(path)}" for path in sorted(files)]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def structures_sha256(path: Path) -> str:
    """Return a hash of what the structure list says, whatever its comments and its layout."""
    said = yaml.safe_load(path.read_text(encoding="utf-8"))
    return hashlib.sha256(json.dumps(said, sort_keys=True, default=str).encode()).hexdigest()


def planned_structures(path: Path, sha256: str) -> Mapping[str, Structure]:
    """Return the structures of a list, which must be those that were planned.

    Raises ConfigurationError when the list was edited since.
    """
    structures = load_structures(path)
    if structures_sha256(path) != sha256:
        raise ConfigurationError(
            f"{path}: the structures changed while the study ran; start the study again."
        )
    return structures


def check_files(records: Iterable[CatalogueRecord], settings: Settings, sha256: str) -> None:
    """Raise ConfigurationError when the files of `records` are not those that were planned."""
    if files_sha256(records, settings, ContentHashes()) != sha256:
        raise ConfigurationError(
            f"{settings.catalogue}: a file of a record changed while the study ran; start the study again."
        )


def _sha256(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _stored(store: Path) -> dict[str, list[object]]:
    with suppress(OSError, ValueError):
        found = json.loads(store.read_text(encoding="utf-8"))
        if isinstance(found, dict) and all(
            isinstance(marks, list) and len(marks) == 5 for marks in found.values()
        ):
            return found
    return {}
