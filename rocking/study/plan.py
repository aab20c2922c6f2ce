"""The plan of a study before its first job: settings checked, inputs read, jobs shared out."""

import math
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar

from rocking.assessment.listed import load_scenes
from rocking.assessment.scene import Scene
from rocking.described import kind_in_words
from rocking.errors import ConfigurationError, RockingError
from rocking.hashes import sha256_of, sha256_of_bytes, sha256_of_sources
from rocking.records.catalogue import CatalogueRecord, load_catalogue, repeated
from rocking.records.files import fill_hashes, local_files, with_hashes
from rocking.records.folder import unlisted
from rocking.records.read import LARGEST_FILE
from rocking.study.folder import REMEMBERED, check_own, results_folder, stands_inside
from rocking.study.hashes import ContentHashes
from rocking.study.settings import Settings, named_files, read_settings
from rocking.tables.yaml_file import read_yaml

T = TypeVar("T")

JOBS = REMEMBERED / "rocking_jobs.lock"
"""Held by every job of a study while it works, in the folder of the study."""
_HASHES = REMEMBERED / "rocking_hashes.json"
"""Beside what snakemake remembers of a study; it may be removed at any time."""
_SOURCE = {".py", ".csv", ".json", ".typ", ".yaml", ".mplstyle", ".html", ".css", ".js"}
_MOST_JOBS = 8
_MANY = 200
_FEW = {True: 12, False: 24}
"""Records worth a job with and without reports: a start costs as much as twenty records without them."""


@dataclass(frozen=True)
class Plan:
    """The work of a study before it begins.

    records: by identifier, in catalogue order. jobs: identifiers by job. structure_hashes: one hash for what each
    structure says, by its name.
    """

    settings: Settings
    records: Mapping[str, CatalogueRecord]
    jobs: Mapping[str, tuple[str, ...]]
    settings_sha256: str
    structures_sha256: str
    package_sha256: str
    hashes: ContentHashes
    structure_hashes: Mapping[str, str] = field(default_factory=dict)

    @property
    def doubts(self) -> tuple[str, ...]:
        """The warnings before the run, one sentence each; folders of records that left the catalogue too."""
        names = {*self.records, "summary", "fragility"}
        folders = (report.parent for report in sorted(Path(self.settings.results).glob("*/report.pdf")))
        former = "{} is of a record that is not in the catalogue any more; remove it if you do not need it."
        return (
            *repeated(self.records.values()),
            *unlisted(Path(self.settings.catalogue)),
            *(former.format(folder) for folder in folders if folder.name not in names),
        )

    def fill_hashes(self) -> None:
        """Write the hashes that the catalogue leaves blank: the files are checked against them from now on.

        A catalogue outside the folder of the study stays as it is.
        """
        if stands_inside(Path(self.settings.catalogue)):
            fill_hashes(self.settings.catalogue, self.settings.mirror)

    @cached_property
    def _files(self) -> dict[str, dict[str, str]]:
        """Those of each record, looked at once."""
        mirror = self.settings.mirror
        return {
            name: {str(path): self.hashes.of(path) for path in local_files(record, mirror)}
            for name, record in self.records.items()
        }

    def files(self, records: Iterable[str]) -> dict[str, str]:
        """Return the sha256 of each file on this machine from which `records` are read; "" where it is not there."""
        return dict(sorted(pair for record in records for pair in self._files[record].items()))

    def params(self, *jobs: str) -> dict[str, Any]:
        """Return what the results of `jobs`, or of all, depend on: snakemake remembers and compares it."""
        names = [name for job in jobs for name in self.jobs[job]] if jobs else list(self.records)
        return {
            "records": names,
            "records_sha256": sha256_of(*(self.records[name] for name in names)),
            "files_sha256": sha256_of(*self.files(names).items()),
            "structures_sha256": self.structures_sha256,
            "settings_sha256": self.settings_sha256,
            "package_sha256": self.package_sha256,
        }

    def made_from(self, job: str) -> str:
        """Return one hash for everything on which the files of a job depend."""
        settings = self.settings
        shown = (settings.about, settings.display_units) if settings.reports else ()
        return sha256_of(*self.params(job).items(), shown, settings.reports, settings.histories)

    @property
    def fragility_made_from(self) -> str:
        """One hash for everything on which the fragility of the study depends."""
        return sha256_of(*self.params().items(), self.settings.fragility)

    @property
    def trade_made_from(self) -> str:
        """One hash for everything on which the trade of accuracy for time depends."""
        return sha256_of(*self.params().items(), self.settings.trade)

    @property
    def summary_made_from(self) -> str:
        """One hash for everything on which the files over all records depend."""
        return sha256_of(*self.params().items(), self.settings)


def make_plan(config: Mapping[str, Any]) -> Plan:
    """Check `config`, the catalogue and the structures it names, and share out the records; write nothing.

    Raises ConfigurationError with every defect of the three, and of the place for the results, in one message.
    """
    defects: list[str] = []

    def attempt(load: Callable[..., T], *arguments: Any) -> T | None:
        try:
            return load(*arguments)
        except RockingError as error:
            defects.append(str(error))
            return None

    settings = attempt(read_settings, config) or named_files(config)
    catalogue = attempt(load_catalogue, settings.catalogue) or ()
    scenes = attempt(load_scenes, settings.structures) or {}
    attempt(_check_results, settings)
    attempt(settings.design_spectrum.spectrum)
    if defects:
        raise ConfigurationError("\n".join(defects))
    records = {record.id: with_hashes(record, settings.mirror) for record in catalogue}
    return Plan(
        settings=settings,
        records=records,
        jobs=share_out(records, settings.records_per_job, settings.reports),
        settings_sha256=settings_sha256(settings, scenes),
        structures_sha256=structures_sha256(scenes),
        package_sha256=package_sha256(reports=settings.reports),
        hashes=ContentHashes(_HASHES, LARGEST_FILE),
        structure_hashes=structure_hashes(scenes),
    )


def workflow_folder() -> Path:
    """Return the folder that holds Snakefile and workflow/: inside an installed package, or the clone."""
    package = Path(__file__).parents[1]
    return package / "shipped" if (package / "shipped" / "Snakefile").is_file() else package.parent


def config_file(folder: Path) -> Path | None:
    """Return the path of the settings of a study, in a clone of the shipped example; None where there are none."""
    paths = (folder / "config.yaml", folder / "workflow" / "config.yaml")
    return next((path for path in paths if os.path.lexists(path)), None)


def check_config_file(path: Path) -> dict[str, Any]:
    """Return what a config.yaml says. Raises ConfigurationError, also where snakemake would be silent or hang."""
    content, _ = read_yaml(path, ConfigurationError, "file of settings", 100_000)
    if not isinstance(content or {}, dict):
        kind = kind_in_words(content)
        raise ConfigurationError(
            f"{path}: the file holds {kind}, but must hold settings, as tolerance: 1e-6."
        )
    return content or {}


def _check_results(settings: Settings) -> None:
    """Make sure that the results can be written where the settings put them, and that nothing leads elsewhere."""
    results = results_folder(settings.results, settings.catalogue, settings.structures)
    folder = next(path for path in (results.absolute(), *results.absolute().parents) if path.exists())
    if not folder.is_dir():
        raise ConfigurationError(f"setting results: {folder} is a file, but must be a folder.")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise ConfigurationError(
            f"setting results: nothing can be written in {folder}; mend its permissions or name another folder."
        )
    check_own(results)


def structure_hashes(scenes: Mapping[str, Scene]) -> dict[str, str]:
    """Return one hash for what each structure says of itself and its support, by its name."""
    return {name: sha256_of(each.structure.as_config(), each.place) for name, each in scenes.items()}


def structures_sha256(scenes: Mapping[str, Scene]) -> str:
    """Return one hash for what a structure list says, whatever its comments and its layout."""
    return sha256_of(
        *((name, each.structure.as_config(), each.place, each.terms) for name, each in scenes.items())
    )


def settings_sha256(settings: Settings, scenes: Mapping[str, Scene]) -> str:
    """Return the hash that every row names: of the settings that change a number, the structures and the package."""
    return sha256_of(settings.numbers(), structures_sha256(scenes), package_sha256(reports=False))


_SPOKEN = {f"study/{name}.py" for name in ("cli", "run", "terminal", "workspace")}
"""The files that start a study and talk about it: they change nothing that a job writes."""


def package_sha256(reports: bool = True) -> str:
    """Return one hash for the source of this package that a job depends on.

    reports: with that of the reports, which changes no number.
    """
    root = Path(__file__).parents[1]
    paths = []
    for path in root.rglob("*"):
        name = path.relative_to(root).as_posix()
        if name in _SPOKEN or (name.startswith("reports/") and not reports):
            continue
        if path.suffix in _SOURCE:
            paths.append(path)
    return sha256_of_sources(root, paths)


def share_out(
    identifiers: Iterable[str], size: int | None = None, reports: bool = True, work: float = 1.0
) -> dict[str, tuple[str, ...]]:
    """Return the identifiers of each job, in their order, by the name of the job.

    size: about how many records a job takes; None chooses twelve, or 24 without reports, but more rather than start
    more than eight jobs, and at most 200. A hash of the identifier chooses the job, and their number is a power of two,
    so that one record more changes one job, or all where that number doubles. work: what is left to do of a record, as
    a share of the whole.
    """
    identifiers = tuple(identifiers)
    number = len(identifiers)
    few = number * work / _FEW[reports]
    least = number / size if size else max(min(few, _MOST_JOBS), number / _MANY)
    return jobs_of(identifiers, 1 << max(0, (math.ceil(least) - 1).bit_length()))


def jobs_of(identifiers: Iterable[str], count: int) -> dict[str, tuple[str, ...]]:
    """Return the identifiers of each of `count` jobs, by the name of the job; one that has none is left out."""
    jobs: dict[str, list[str]] = {}
    for identifier in identifiers:
        place = int(sha256_of_bytes(identifier.encode())[:8], 16) % count
        jobs.setdefault(f"{place:05d}_of_{count:05d}", []).append(identifier)
    return {name: tuple(jobs[name]) for name in sorted(jobs)}
