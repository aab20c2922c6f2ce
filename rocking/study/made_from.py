"""What each product of a study is made from: the one table that says what depends on what.

A product is a record ("records/a"), a batch of records without reports ("batches/00"), the summary, the checks, the
fragility or the trade. Its job is handed the settings that its line names, and no others. From the line follow the
things that its seal holds; where one of them changes, the product is computed again.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from platform import python_version
from typing import Protocol

from rocking.assessment.scene import Scene
from rocking.errors import RockingError
from rocking.hashes import sha256_of
from rocking.records.catalogue import CatalogueRecord, load_catalogue
from rocking.records.files import with_hashes
from rocking.study.contents import ContentHashes
from rocking.study.seals import Seals
from rocking.study.settings import (
    NUMBERS,
    Settings,
    StudyDesign,
    StudyFragility,
    package_sha256,
    structure_hashes,
)

Things = Mapping[str, str]
"""What a product is made from: each thing in words, with its hash."""


class Inputs(Protocol):
    """What a study reads, as `Plan` holds it: see there for each of these."""

    @property
    def settings(self) -> Settings: ...
    @property
    def records(self) -> Mapping[str, CatalogueRecord]: ...
    @property
    def scenes(self) -> Mapping[str, Scene]: ...
    @property
    def contents(self) -> ContentHashes: ...
    @property
    def batches(self) -> Mapping[str, tuple[str, ...]]: ...
    @property
    def seals(self) -> Seals: ...
    def files(self, records: Iterable[str]) -> Mapping[str, str]: ...
    def files_of(self, record: CatalogueRecord) -> Mapping[str, str]: ...


PLACES = ("catalogue", "structures", "results", "mirror")
"""The settings that say where something lies: what lies there counts, and every job is handed them."""
_TOLD = ("study", "client", "project_number", "author", "date", "display_units")
_LEVEL = tuple(f"design_spectrum.{name}" for name in StudyDesign.LEVEL)
_CURVES = tuple(f"fragility.{each.name}" for each in fields(StudyFragility) if each.name != "in_every_run")
"""When the fragility is measured is no part of it."""


@dataclass(frozen=True)
class Line:
    """One line of the table.

    settings: names of settings and of whole sections; section.name is one setting of a section. files: settings that
    name a file whose content counts. pool: whether the records count from which sets are drawn. terms: whether what the
    structures say for the checks of a code counts. curves: whether the checks, the fragility and the trade that
    stand beside it count. documents: whether it holds a document whatever the settings say.
    """

    settings: tuple[str, ...]
    files: tuple[str, ...] = ()
    pool: bool = False
    terms: bool = False
    curves: bool = False
    documents: bool = True

    def handed(self, settings: Settings) -> Settings:
        """Return the settings of which a job can read those of this line alone."""
        return settings.restricted((*self.settings, *PLACES))


TABLE: Mapping[str, Line] = {
    "records": Line(
        (*NUMBERS, *_TOLD, "reports", "details", "figures", "histories", *_LEVEL),
        files=("design_spectrum.points",),
        documents=False,
    ),
    "batches": Line((*NUMBERS, "reports", "histories"), documents=False),
    "summary": Line(
        (
            *NUMBERS,
            *_TOLD,
            "reports",
            "figures",
            "histories",
            "records_per_job",
            "design_spectrum",
            "fragility",
            "trade",
        ),
        files=("design_spectrum.points",),
        curves=True,
        documents=False,
    ),
    "checks": Line(
        (*NUMBERS, *_TOLD, "language", "figures", "design_spectrum"),
        files=("design_spectrum.points",),
        pool=True,
        terms=True,
    ),
    "fragility": Line((*NUMBERS, *_CURVES, "figures"), files=("fragility.hazard",)),
    "trade": Line((*NUMBERS, "figures")),
}
"""By the kind of product. All are made from the records and their files, the structures in their order, this package
and the libraries as well; a record and a batch from their own records alone, the others from all in their order."""


def things_of(product: str, plan: Inputs) -> Things:
    """Return what a product is made from, each thing in words with its hash."""
    line = TABLE[product.partition("/")[0]]
    records = records_of(product, plan)
    settings = plan.settings.told_in(line.settings)
    things = {f"setting {key}": sha256_of(value) for key, value in settings.items()}
    things |= {
        "the package": package_sha256(reports=line.documents or plan.settings.reports),
        "the libraries": sha256_of(sorted(versions().items())),
        "the structures": sha256_of(*structure_hashes(plan.scenes).items()),
        "the records": sha256_of(*(plan.records[each] for each in records)),
        "the files of the records": sha256_of(*plan.files(records).items()),
    }
    for key in line.files:
        path = plan.settings.told_in([key])[key]
        if path:
            things[str(path)] = plan.contents.of(Path(path))
    if line.terms:
        things["the terms of the checks"] = sha256_of(
            *((name, each.terms) for name, each in plan.scenes.items())
        )
    if line.pool and plan.settings.design_spectrum.pool:
        things |= _pool(Path(plan.settings.design_spectrum.pool), plan)
    if line.curves:
        # By hand or in every run; of those made by hand, as they are when the summary is made.
        design = plan.settings.design_spectrum
        in_every_run = {
            "checks": bool(design.ag or design.points),
            "fragility": plan.settings.fragility.in_every_run,
            "trade": plan.settings.trade.in_summary,
        }
        for each, always in in_every_run.items():
            holds = always or not plan.seals.why_again(each)
            key_of = plan.seals.key if always else plan.seals.contents_of
            things[f"the {each}"] = key_of(each) if holds else ""
    return things


def records_of(product: str, plan: Inputs) -> tuple[str, ...]:
    """Return the identifiers of the records of a product: its own, or all of the study."""
    kind, _, name = product.partition("/")
    if kind == "records":
        return (name,)
    return plan.batches[name] if kind == "batches" else tuple(plan.records)


def _pool(catalogue: Path, plan: Inputs) -> Things:
    """The records of another catalogue, and their files; one that cannot be read is told when it is used."""
    things = {str(catalogue): plan.contents.of(catalogue)}
    try:
        rows = load_catalogue(catalogue)
    except RockingError:
        return things
    mirror = plan.settings.mirror
    hashes = [pair for row in rows for pair in plan.files_of(with_hashes(row, mirror)).items()]
    return things | {"the files of the pool": sha256_of(*hashes)}


_LIBRARIES = ("rocking", "obspy", "numpy", "scipy", "pandas", "matplotlib", "numba", "snakemake", "typst")


@cache
def versions() -> dict[str, str]:
    """Return the versions of Python and of the libraries that are installed, by their names."""
    found = {"python": python_version()}
    for library in _LIBRARIES:
        try:
            found[library] = version(library)
        except PackageNotFoundError:
            continue
    return found
