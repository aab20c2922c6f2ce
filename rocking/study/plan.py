"""The plan of a study before its first job: settings checked, inputs read, jobs shared out."""

import hashlib
import json
import math
import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from rocking.errors import ConfigurationError, RockingError
from rocking.records.catalogue import CatalogueRecord, load_catalogue, repeated
from rocking.records.fetch import fill_hashes, filled
from rocking.structures import load_structures
from rocking.study.config_file import named_files, read_settings
from rocking.study.inputs import ContentHashes, files_sha256, structures_sha256
from rocking.study.settings import Settings

Found = TypeVar("Found")


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
    hashes: ContentHashes

    @property
    def doubts(self) -> tuple[str, ...]:
        """What to tell the user before the run, one sentence each."""
        return repeated(self.records.values())

    def begin(self) -> None:
        """Write the hashes that the catalogue leaves blank: the files are checked against them from now on."""
        fill_hashes(self.settings.catalogue, self.settings.mirror)

    def job(self, name: str) -> tuple[CatalogueRecord, ...]:
        """The records of one job."""
        return tuple(self.records[identifier] for identifier in self.jobs[name])

    def records_sha256(self, name: str | None = None) -> str:
        """Return one hash for the catalogue rows of one job, or of all."""
        return records_sha256(self.records.values() if name is None else self.job(name))

    def files_sha256(self, *names: str) -> str:
        """Return one hash for their contents."""
        records = (record for name in names for record in self.job(name))
        return files_sha256(records, self.settings, self.hashes)


_HASHES = Path(".snakemake") / "rocking_hashes.json"
"""Beside what snakemake remembers of a study; it may be removed at any time."""

_CHANGE_NO_NUMBER = (
    "reports/",
    *("study/cli.", "study/config_file.", "study/explore.", "study/inputs.", "study/launch.", "study/locks."),
    *("study/outcome.", "study/progress.", "study/record_reports.", "study/single_record."),
    *("study/summary_report.", "study/workspace."),
)
"""Source whose edit leaves every number of a table as it is."""


def make_plan(config: Mapping[str, Any]) -> Plan:
    """Check `config`, the catalogue and the structures it names, and share out the records; write nothing.

    Raises ConfigurationError with every defect of the three, and of the place for the results, in one message.
    """
    defects: list[str] = []
    settings = _collect(defects, lambda: read_settings(config)) or named_files(config)
    structures = Path(settings.structures)
    listed = _collect(defects, lambda: load_catalogue(settings.catalogue)) or ()
    records = [filled(record, settings.mirror) for record in listed]
    _collect(defects, lambda: load_structures(structures))
    _collect(defects, lambda: check_writable(Path(settings.results)))
    if defects:
        raise ConfigurationError("\n".join(defects))
    package, described = package_sha256(leave_out=_CHANGE_NO_NUMBER), structures_sha256(structures)
    return Plan(
        settings=settings,
        records={record.id: record for record in records},
        jobs=share_out((record.id for record in records), settings.records_per_job),
        settings_sha256=settings_sha256(settings, described, package),
        structures_sha256=described,
        package_sha256=package,
        hashes=ContentHashes(_HASHES),
    )


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
    text = "\0".join((json.dumps(settings.numbers(), sort_keys=True), structures, package))
    return hashlib.sha256(text.encode()).hexdigest()


def package_sha256(leave_out: Sequence[str] = ()) -> str:
    """Return one hash for the source of this package, without what lies below the names in `leave_out`."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix in _SOURCE and not name.startswith(tuple(leave_out)):
            digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


_SOURCE = {".py", ".csv", ".typ", ".yaml", ".mplstyle", ".html", ".css", ".js"}


def records_sha256(records: Iterable[CatalogueRecord]) -> str:
    """Return one hash for catalogue rows, in their order."""
    return hashlib.sha256("\n".join(map(repr, records)).encode()).hexdigest()


def planned_records(
    catalogue: Path, identifiers: Collection[str] | None, sha256: str
) -> tuple[CatalogueRecord, ...]:
    """Return the rows of `catalogue`, those of `identifiers` or all, which must be those that were planned.

    Raises ConfigurationError when the catalogue was edited since.
    """
    rows = load_catalogue(catalogue)
    records = tuple(row for row in rows if identifiers is None or row.id in identifiers)
    if records_sha256(records) != sha256:
        raise ConfigurationError(
            f"{catalogue}: the catalogue changed while the study ran; start the study again."
        )
    return records


def share_out(identifiers: Iterable[str], size: int | None = None) -> dict[str, tuple[str, ...]]:
    """Share out records to jobs by a hash of their identifier, so that adding one record changes one job.

    size: about how many records a job takes; None chooses about the square root of their number, but more rather than
    start more than eight jobs, and at most 200, so that neither starting a job nor losing one costs much: a start costs
    as much as twenty records. The number of jobs is a power of two; only where it doubles, every job changes.
    Returns the identifiers of each job that has any, in their order, by the name of the job.
    """
    identifiers = tuple(identifiers)
    number = len(identifiers)
    wanted = number / size if size else max(min(number**0.5, _FEW_JOBS), number / _MANY_RECORDS)
    count = 1 << max(0, (math.ceil(wanted) - 1).bit_length())
    shared: dict[str, list[str]] = {}
    for identifier in identifiers:
        place = int.from_bytes(hashlib.sha256(identifier.encode()).digest()[:4], "big") % count
        shared.setdefault(f"{place:05d}_of_{count:05d}", []).append(identifier)
    return {name: tuple(shared[name]) for name in sorted(shared)}


_FEW_JOBS, _MANY_RECORDS = 8, 200


def _collect(defects: list[str], load: Callable[[], Found]) -> Found | None:
    try:
        return load()
    except RockingError as error:
        defects.append(str(error))
        return None
