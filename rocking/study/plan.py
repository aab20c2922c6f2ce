"""The plan of a study before its first job: settings checked, inputs read, jobs shared out."""

import hashlib
import json
import math
import os
import stat
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from rocking.errors import ConfigurationError, RockingError
from rocking.records.catalogue import CatalogueRecord, load_catalogue, repeated
from rocking.records.fetch import fill_hashes, filled, local_files
from rocking.records.folder import unlisted
from rocking.records.read import LARGEST_FILE
from rocking.structures import Structure, load_structures
from rocking.study.settings import Settings, named_files, read_settings
from rocking.tables import write_whole
from rocking.tables.yaml_file import read_yaml

Found = TypeVar("Found")

_HASHES = Path(".snakemake") / "rocking_hashes.json"
"""Beside what snakemake remembers of a study; it may be removed at any time."""
JOBS = Path(".snakemake") / "rocking_jobs.lock"
"""Held by every job of a study while it works, in the folder of the study."""
_SETTLED = 2.0
"""s; a file that changed more recently may change again without its times telling, so its hash is not kept."""


@dataclass(frozen=True)
class Plan:
    """What a study will do. records: by identifier, in catalogue order. jobs: identifiers by job."""

    settings: Settings
    records: Mapping[str, CatalogueRecord]
    jobs: Mapping[str, tuple[str, ...]]
    settings_sha256: str
    """Names the settings that change a number, the structure list and the package, in every row."""
    structures_sha256: str
    package_sha256: str
    hashes: "ContentHashes"

    @property
    def doubts(self) -> tuple[str, ...]:
        """What to tell the user before the run, one sentence each."""
        new = unlisted(Path(self.settings.catalogue))
        return (*repeated(self.records.values()), *new, *self._left())

    def _left(self) -> Iterator[str]:
        """Folders of results whose record left the catalogue."""
        for report in sorted(Path(self.settings.results).glob("*/report.pdf")):
            if (folder := report.parent).name not in {*self.records, "summary", "fragility"}:
                yield f"{folder} is of a record that is not in the catalogue any more; remove it if you do not need it."

    def begin(self) -> None:
        """Write the hashes that the catalogue leaves blank: the files are checked against them from now on."""
        fill_hashes(self.settings.catalogue, self.settings.mirror)

    def params(self, *jobs: str) -> dict[str, Any]:
        """Return what the results of `jobs`, or of all, depend on: snakemake remembers and compares it."""
        names = [name for job in jobs for name in self.jobs[job]] if jobs else list(self.records)
        records = [self.records[name] for name in names]
        return {
            "records": names,
            "records_sha256": records_sha256(records),
            "files_sha256": files_sha256(records, self.settings, self.hashes),
            "structures_sha256": self.structures_sha256,
            "settings_sha256": self.settings_sha256,
            "package_sha256": self.package_sha256,
        }


def make_plan(config: Mapping[str, Any]) -> Plan:
    """Check `config`, the catalogue and the structures it names, and share out the records; write nothing.

    Raises ConfigurationError with every defect of the three, and of the place for the results, in one message.
    """
    defects: list[str] = []
    settings = _collect(defects, lambda: read_settings(config)) or named_files(config)
    listed = _collect(defects, lambda: load_catalogue(settings.catalogue)) or ()
    records = [filled(record, settings.mirror) for record in listed]
    structures = _collect(defects, lambda: load_structures(settings.structures))
    _collect(defects, lambda: check_writable(Path(settings.results)))
    if defects or structures is None:
        raise ConfigurationError("\n".join(defects))
    numbers, described = package_sha256(reports=False), structures_sha256(structures)
    return Plan(
        settings=settings,
        records={record.id: record for record in records},
        jobs=share_out((record.id for record in records), settings.records_per_job),
        settings_sha256=settings_sha256(settings, described, numbers),
        structures_sha256=described,
        package_sha256=package_sha256() if settings.reports else numbers,
        hashes=ContentHashes(_HASHES),
    )


def check_config_file(path: Path) -> dict[str, Any]:
    """Return what a config.yaml says. Raises ConfigurationError, also where snakemake would be silent or hang."""
    said, _ = read_yaml(path, ConfigurationError, "file of settings")
    if not isinstance(said or {}, dict):
        raise ConfigurationError(
            f"{path}: the file holds {type(said).__name__}, but must hold settings; mend it."
        )
    return said or {}


def check_writable(results: Path) -> None:
    """Raise ConfigurationError when no folder can be made, or nothing be written, at `results`."""
    there = next(path for path in (results.absolute(), *results.absolute().parents) if path.exists())
    if not there.is_dir():
        raise ConfigurationError(f"setting results: {there} is a file, but must be a folder.")
    if not os.access(there, os.W_OK | os.X_OK):
        raise ConfigurationError(
            f"setting results: nothing can be written in {there}; mend its permissions or name another folder."
        )


def settings_sha256(settings: Settings, structures: str, package: str) -> str:
    """Return one hash for the settings that change a number, and those of the structure list and the package."""
    return _sha256(json.dumps(settings.numbers(), sort_keys=True), structures, package)


def structures_sha256(structures: Mapping[str, Structure]) -> str:
    """Return one hash for what a structure list says, whatever its comments and its layout."""
    return _sha256(json.dumps({name: each.as_config() for name, each in structures.items()}, default=str))


def records_sha256(records: Iterable[CatalogueRecord]) -> str:
    """Return one hash for catalogue rows, in their order."""
    return _sha256(*map(repr, records))


def files_sha256(records: Iterable[CatalogueRecord], settings: Settings, hashes: "ContentHashes") -> str:
    """Return one hash for the files on this machine from which `records` are read, StationXML among them."""
    files = {p for record in records for p in local_files(record, settings.mirror)}
    return _sha256(*(f"{path}\0{hashes.of(path)}" for path in sorted(files)))


def package_sha256(reports: bool = True) -> str:
    """Return one hash for the source of this package. reports: with that of the reports, which changes no number."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix in _SOURCE and (reports or not name.startswith("reports/")):
            digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


_SOURCE = {".py", ".csv", ".json", ".typ", ".yaml", ".mplstyle", ".html", ".css", ".js"}


class ContentHashes:
    """The sha256 of files. store: a file that keeps them from run to run, for as long as a file's size and times stay.

    The time of the last change (ctime), which no program can set, stands among them.
    """

    def __init__(self, store: Path | None = None) -> None:
        self._store = store
        self._known = _stored(store) if store else {}
        self._kept: dict[str, list[object]] = {}

    def of(self, path: Path) -> str:
        """Return the sha256 of the file at `path`, "" for what no reader takes: another kind of file, or too large."""
        try:
            status = path.stat()
            if not stat.S_ISREG(status.st_mode) or status.st_size > LARGEST_FILE:
                return ""
            marks = [status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino]
            known = self._known.get(str(path))
            if known and known[:-1] == marks:
                found = str(known[-1])
            else:
                with path.open("rb") as stream:
                    found = hashlib.file_digest(stream, "sha256").hexdigest()
        except OSError:
            return ""
        if time.time() - status.st_ctime > _SETTLED:
            self._kept[str(path)] = [*marks, found]
        return found

    def save(self) -> None:
        """Keep what is known of the files that were asked for, if the folder of the store is there."""
        if self._store and self._store.parent.is_dir() and self._kept != self._known:
            write_whole(self._store, json.dumps(self._kept).encode())


def share_out(identifiers: Iterable[str], size: int | None = None) -> dict[str, tuple[str, ...]]:
    """Share out records to jobs by a hash of their identifier, so that adding one record changes one job.

    size: about how many records a job takes; None chooses eight, but more rather than start more than eight jobs, and
    at most 200, so that neither starting a job nor losing one costs much: a start costs as much as twenty records
    without reports. The number of jobs is a power of two; only where it doubles, every job changes.
    Returns the identifiers of each job that has any, in their order, by the name of the job.
    """
    identifiers = tuple(identifiers)
    number = len(identifiers)
    wanted = number / size if size else max(min(number / _FEW, _FEW), number / _MANY)
    count = 1 << max(0, (math.ceil(wanted) - 1).bit_length())
    shared: dict[str, list[str]] = {}
    for identifier in identifiers:
        place = int.from_bytes(hashlib.sha256(identifier.encode()).digest()[:4], "big") % count
        shared.setdefault(f"{place:05d}_of_{count:05d}", []).append(identifier)
    return {name: tuple(shared[name]) for name in sorted(shared)}


_FEW, _MANY = 8, 200


def _sha256(*texts: str) -> str:
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()


def _stored(store: Path) -> dict[str, list[object]]:
    with suppress(OSError, ValueError):
        found = json.loads(store.read_text(encoding="utf-8"))
        if isinstance(found, dict) and all(
            isinstance(marks, list) and len(marks) == 5 for marks in found.values()
        ):
            return found
    return {}


def _collect(defects: list[str], load: Callable[[], Found]) -> Found | None:
    try:
        return load()
    except RockingError as error:
        defects.append(str(error))
        return None
