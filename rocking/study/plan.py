"""The plan of a study before its first job: settings, catalogue and structures read and checked."""

import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, TypeVar

from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.scene import Scene, load_scenes
from rocking.catalogue.catalogue import CatalogueRecord, load_catalogue, repeated
from rocking.catalogue.files import answers_of, files_by_name, fill_hashes, local_files, with_hashes
from rocking.catalogue.folder import unlisted
from rocking.described import kind_in_words
from rocking.errors import ConfigurationError, RockingError
from rocking.hashes import sha256_of_bytes
from rocking.quantities import shown
from rocking.records.formats.layouts import NAME as ANSWERS
from rocking.records.formats.layouts import Layouts
from rocking.records.read import LARGEST_FILE
from rocking.remarks import Remark
from rocking.study.contents import ContentHashes
from rocking.study.folder import REMEMBERED, check_own, results_folder, stands_inside
from rocking.study.kept import made_by_hand
from rocking.study.kinds import StudyKind
from rocking.study.made_from import made_from, records_of, what_changed
from rocking.study.outputs import kept_of, outcome_of
from rocking.study.product import KEPT
from rocking.study.products import PRODUCTS
from rocking.study.settings import Settings, file_settings, named_files, read_settings
from rocking.tables.yaml_file import read_yaml

T = TypeVar("T")

JOBS = REMEMBERED / "rocking_jobs.lock"
"""Locked by every job of a study while it works, in the folder of the study."""
_NAMED = 8
"""Remarks on settings and structures that the terminal shows; remarks.csv holds all."""
_ON_PAGES = (AssessmentKind.HELD_AT_CEILING,)
"""Remarks on what a structure is taken for, which stand on its pages and ask nothing of who starts a run."""
_MOST_BATCHES = 8
_MANY = 200
_FEW = 24
"""Records worth a batch: the start of a process costs as much as twenty records without reports."""


def study_remarks(settings: Settings, scenes: Mapping[str, Scene]) -> tuple[Remark, ...]:
    """Return what there is to say of the settings and the structures of a study before it meets a record."""
    level = settings.design_spectrum.remark
    of_scenes = [remark for scene in scenes.values() for remark in scene.remarks]
    return (*([level] if level else []), *of_scenes)


@dataclass(frozen=True)
class Plan:
    """The work of a study before it begins.

    records: by identifier, in catalogue order. scenes: the structures by name, in the order of the list. contents: the
    hashes of the files that are read. by_name: whether the files of records are taken to be where the catalogue says,
    with the hashes that it states, because they lie on another machine.
    """

    settings: Settings
    records: Mapping[str, CatalogueRecord]
    scenes: Mapping[str, Scene]
    contents: ContentHashes
    by_name: bool = False

    @property
    def doubts(self) -> tuple[Remark, ...]:
        """The warnings before the run."""
        of_study = [
            remark for remark in study_remarks(self.settings, self.scenes) if remark.kind not in _ON_PAGES
        ]
        more = len(of_study) - _NAMED
        return (
            *of_study[:_NAMED],
            *([Remark.of(StudyKind.REMARKS_MORE, number=more)] if more > 0 else []),
            *repeated(self.records.values()),
            *unlisted(Path(self.settings.catalogue)),
            *self._outdated,
        )

    @property
    def _outdated(self) -> list[Remark]:
        """What was made by hand and does not hold any more; a run leaves it out, and removes it."""
        others = (product.name for product in PRODUCTS if product.name not in self.products)
        made = {name: self.changed_since(name) for name in others}
        return [
            Remark.of(StudyKind.OUTDATED, product, why=f"changed: {why}")
            for product, why in made.items()
            if why
        ]

    @cached_property
    def products(self) -> tuple[str, ...]:
        """The products that a whole run makes, each by the name of its rule, and of its record or batch."""
        settings = self.settings
        kind, names = ("record", self.records) if self.makes_reports else ("batch", self.batches)
        return (
            *(f"{kind}/{name}" for name in names),
            *(product.name for product in PRODUCTS if product.in_every_run(settings)),
            "summary",
        )

    @cached_property
    def products_of_summary(self) -> tuple[str, ...]:
        """The products over all records that the summary shows: of the plan, and by hand where they still hold."""
        return tuple(
            product.name
            for product in PRODUCTS
            if product.name in self.products or self._holds_by_hand(product.name)
        )

    def _holds_by_hand(self, product: str) -> bool:
        made = not self.by_name and made_by_hand(kept_of(Path(self.settings.results), product))
        return bool(made) and not self.changed_since(product)

    def changed_since(self, product: str) -> str:
        """Return what has changed since a product was made by hand, as a list in words.

        "" where nothing has, and where it was not.
        """
        before = made_by_hand(kept_of(Path(self.settings.results), product))
        return what_changed(before, made_from(product, self)) if before else ""

    def outcomes(self) -> dict[str, Path]:
        """Return the file that keeps the outcome of each record, in catalogue order; a batch has one for all of it."""
        results = Path(self.settings.results)
        if self.makes_reports:
            return {record: outcome_of(results, record) for record in self.records}
        batch_of = {record: name for name, records in self.batches.items() for record in records}
        return {record: outcome_of(results, record, batch_of[record]) for record in self.records}

    def fill_hashes(self) -> None:
        """Write the hashes that the catalogue leaves blank: the files are checked against them from now on.

        A catalogue outside the folder of the study stays as it is.
        """
        if stands_inside(Path(self.settings.catalogue)):
            fill_hashes(self.settings.catalogue, self.settings.mirror)

    def files_of(self, record: CatalogueRecord) -> dict[str, str]:
        """Return the sha256 of each file from which a record is read.

        Raises ConfigurationError where the files lie on another machine, and the catalogue does not state theirs.
        """
        if self.by_name:
            hashes = files_by_name(record)
            if "" in hashes.values() or self.settings.mirror:
                raise ConfigurationError(
                    f"{self.settings.catalogue}: record {record.id} is read on another machine, so that its sha256 "
                    "must stand in the catalogue, and its files in the folder of it; run the study once where they "
                    "lie, without mirror.",
                    sha256=record.sha256,
                )
            inventory = record.folder / record.inventory if record.inventory else None
            return {**hashes, **({str(inventory): self.contents.of(inventory)} if inventory else {})}
        return {str(path): self.contents.of(path) for path in local_files(record, self.settings.mirror)}

    def answers_of(self, record: CatalogueRecord) -> dict[str, str]:
        """Return the hash of the answer by which each table of a record is read."""
        if self.by_name:
            answers = record.folder / ANSWERS
            return {str(answers): self.contents.of(answers)} if answers.is_file() else {}
        return answers_of(record, self.settings.mirror)

    @property
    def makes_reports(self) -> bool:
        """Whether each record has files of its own, so that it is a job of its own."""
        return self.settings.reports or self.settings.histories

    @cached_property
    def batches(self) -> dict[str, tuple[str, ...]]:
        """The identifiers of each batch of records, by its name."""
        return batches_of(self.records, self.settings.records_per_job)


def make_plan(config: Mapping[str, Any], by_name: bool = False) -> Plan:
    """Check `config`, the catalogue with its layouts, and the structures it names; write nothing.

    by_name: see Plan.
    Raises ConfigurationError with every defect of these, and of the place for the results, in one message.
    """
    defects: list[str] = []

    def attempt(load: Callable[..., T], *arguments: Any) -> T | None:
        try:
            return load(*arguments)
        except RockingError as error:
            defects.append(str(error))
            return None

    settings = attempt(read_settings, config) or named_files(config)
    missing = dict(missing_files(settings))
    defects += missing.values()
    catalogue = () if "catalogue" in missing else attempt(load_catalogue, settings.catalogue) or ()
    attempt(Layouts(Path(settings.catalogue).parent).check)
    scenes = {} if "structures" in missing else attempt(load_scenes, settings.structures) or {}
    attempt(_check_results, settings)
    if "design_spectrum.points" not in missing:
        attempt(settings.design_spectrum.spectrum)
    if defects:
        raise ConfigurationError("\n".join(defects))
    records = {record.id: with_hashes(record, settings.mirror) for record in catalogue}
    contents = ContentHashes(Path(settings.results) / KEPT / "contents.json", LARGEST_FILE)
    return Plan(settings, records, scenes, contents, by_name)


def missing_files(settings: Settings) -> Iterator[tuple[str, str]]:
    """Yield each setting that names a file that is not there, and the sentence that says so."""
    named = settings.values_of(file_settings())
    for name, value in named.items():
        if not value or os.path.lexists(value):
            continue
        folder, file = os.path.split(Path.cwd() / value)
        names = os.listdir(folder) if os.path.isdir(folder) else []
        near = [
            near for near in get_close_matches(file, names, n=1) if Path(near).suffix == Path(file).suffix
        ]
        hint = "write its path from the folder of the study"
        if near:
            hint = f"did you mean {Path(value).with_name(near[0])}?"
        elif name == "catalogue":
            hint = f"there is no catalogue yet: put records into {folder}, then: rocking catalogue {folder}"
        yield name, f"setting {name} is {shown(value)}, but no such file is in {Path.cwd()}; {hint}"


def plan_of_job(config: Mapping[str, Any], product: str, by_name: bool = False) -> Plan:
    """Return the plan as the job of one product needs it: read again, and of no other record the files.

    Raises ConfigurationError or CatalogueError for what was edited since.
    """
    settings = read_settings(config)
    records = {record.id: record for record in load_catalogue(settings.catalogue)}
    contents = ContentHashes(None, LARGEST_FILE)
    plan = Plan(settings, records, scenes_of(settings.structures, contents), contents, by_name)
    own = records_of(product, plan)
    if gone := [name for name in own if name not in records]:
        raise ConfigurationError(
            f"{settings.catalogue}: record {gone[0]} is not in it any more; start the study again.",
            record=gone[0],
        )
    return replace(
        plan, records=records | {name: with_hashes(records[name], settings.mirror) for name in own}
    )


def scenes_of(path: str | Path, contents: ContentHashes) -> Mapping[str, Scene]:
    """Return the scenes of a list, those that this process has read where its content is the same.

    What their structures have computed a job need not compute again that is forked from a process which had them.
    """
    sha256 = contents.of(Path(path))
    return _listed(path, sha256) if sha256 else load_scenes(path)


@lru_cache(maxsize=1)
def _listed(path: str | Path, _sha256: str) -> Mapping[str, Scene]:
    """The scenes of a list of this content."""
    return load_scenes(path)


def config_file(folder: Path) -> Path | None:
    """Return the path of the settings of a study, in a clone of the shipped example; None where there are none."""
    paths = (folder / "config.yaml", folder / "config" / "config.yaml")
    return next((path for path in paths if os.path.lexists(path)), None)


def check_config_file(path: Path) -> dict[str, Any]:
    """Return what a config.yaml says. Raises ConfigurationError, also where snakemake would be silent or hang."""
    content, _ = read_yaml(path, ConfigurationError, "file of settings", 100_000)
    if not isinstance(content or {}, dict):
        kind = kind_in_words(content)
        raise ConfigurationError(
            f"{path}: the file holds {kind}, but must hold settings, as tolerance: 1e-6, with a blank behind each "
            "colon."
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
            f"setting results: nothing can be written in {folder}; correct its permissions or name another folder."
        )
    check_own(results)


def batches_of(identifiers: Iterable[str], size: int | None = None) -> dict[str, tuple[str, ...]]:
    """Return the identifiers of each batch, in their order, by the name of the batch.

    size: about how many records a batch takes; None chooses 24, but more rather than start more than eight batches, and
    at most 200. A hash of the identifier chooses the batch, and their number is a power of two, so that one record more
    changes one batch, or all where that number doubles.
    """
    identifiers = tuple(identifiers)
    number = len(identifiers)
    least = number / size if size else max(min(number / _FEW, _MOST_BATCHES), number / _MANY)
    count = 1 << max(0, (math.ceil(least) - 1).bit_length())
    batches: dict[str, list[str]] = {}
    for identifier in identifiers:
        place = int(sha256_of_bytes(identifier.encode())[:8], 16) % count
        batches.setdefault(f"{place:05d}_of_{count:05d}", []).append(identifier)
    return {name: tuple(batches[name]) for name in sorted(batches)}
