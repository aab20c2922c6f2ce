"""What each product of a study is made from: the one table that says what depends on what.

A product is a record ("record/a"), a batch of records without reports ("batch/00"), the summary, or one of those over
all records that it shows (`rocking.study.products`). Its job gets the settings that its line names, and no others.
From the line follow the files that its rule declares as input, and the params of the rule: a line of text for each
thing that it is made from, a setting with its value, the content of a file with its hash. Snakemake makes a product
again where a param is another one than when it was made, and says which.
"""

from collections.abc import Iterable, Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from platform import python_version
from typing import Any, Protocol
from urllib.parse import quote

from rocking.assessment.scene import Scene
from rocking.assessment.settings import Heading
from rocking.catalogue.catalogue import CatalogueRecord, load_catalogue
from rocking.errors import ConfigurationError, RockingError
from rocking.hashes import sha256_of
from rocking.study.contents import ContentHashes
from rocking.study.product import TOLD, Line
from rocking.study.products import BY_NAME, PRODUCTS
from rocking.study.settings import (
    NUMBERS,
    OTHER_SECTIONS,
    Settings,
    folder_sha256,
    layout,
    package_sha256,
    structure_hashes,
)


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
    def products_of_summary(self) -> tuple[str, ...]: ...
    def files_of(self, record: CatalogueRecord) -> Mapping[str, str]: ...
    def answers_of(self, record: CatalogueRecord) -> Mapping[str, str]: ...


PLACES = ("catalogue", "structures", "results", "mirror")
"""The settings that say where something lies: what lies there counts, and every job gets them."""
_PLAIN = " ./,+=()[]'_-"
"""Beside letters and digits, what a param holds as it is: --report prints params, and no text of a study is markup."""


TABLE: Mapping[str, Line] = {
    "record": Line(
        (*TOLD, "reports", "figures", "histories", "design_spectrum"),
        files=("design_spectrum.points",),
        documents=False,
    ),
    "batch": Line(("reports", "histories"), documents=False),
    "summary": Line(
        (*TOLD, "reports", "figures", "histories", "records_per_job", *OTHER_SECTIONS),
        files=("design_spectrum.points",),
        opens_records=False,
        shows=True,
        documents=False,
    ),
    **{product.name: product.made_from for product in PRODUCTS},
}
"""By the kind of product, which is the name of its rule. All are made from the settings that change a number, the rows
of the catalogue, the structures in their order, this package and the libraries as well; a record and a batch from their
own records alone, the others from all in their order."""


def settings_for(kind: str, settings: Settings) -> Settings:
    """Return the settings of which a job of this kind can read those of its line alone."""
    return settings.restricted((*NUMBERS, *TABLE[kind].settings, *PLACES))


def made_from(product: str, plan: Inputs) -> tuple[str, ...]:
    """Return what a product is made from, a line of text for each thing."""
    return (*of_kind(product.partition("/")[0], plan), *of_records(product, plan))


def of_records(product: str, plan: Inputs) -> tuple[str, ...]:
    """Return the last OF_RECORDS lines of `made_from`: the records of a product, their files, and those of the pool."""
    line = TABLE[product.partition("/")[0]]
    records = [plan.records[record] for record in records_of(product, plan)]
    files = _hashes(plan, records) if line.opens_records else {}
    return (
        _named("catalogue", *records),
        _contents_of("files", files),
        _contents_of("pool", _others(plan, line)),
    )


OF_RECORDS = 3


def what_changed(before: Iterable[str], now: Iterable[str]) -> str:
    """Return the names of the things that differ between two of `made_from`, as a list in words; "" for none."""
    lines = set(before) ^ set(now)
    return ", ".join(sorted({line.partition(" = ")[0].partition(": ")[0] for line in lines}))


def inputs_of(product: str, plan: Inputs) -> dict[str, list[str]]:
    """Return the files that a product is made from by what they are; those of records and of the pool are "files".

    Raises ConfigurationError for a record that the catalogue does not have.
    """
    line = TABLE[product.partition("/")[0]]
    settings = plan.settings
    if product.startswith("record/") and product.removeprefix("record/") not in plan.records:
        raise ConfigurationError(
            f"{settings.catalogue}: it has no record {product.removeprefix('record/')}; ask for one that it has."
        )
    files: dict[str, None] = {}
    if line.opens_records:
        for record in records_of(product, plan):
            files |= dict.fromkeys(plan.files_of(plan.records[record]))
    for catalogue in _catalogues(line, settings):
        files[catalogue] = None
        for row in _rows_of(catalogue):
            files |= dict.fromkeys(plan.files_of(row))
    named = [path for path in settings.values_of(line.files).values() if path]
    return {
        "catalogue": [settings.catalogue],
        "structures": [settings.structures],
        "files": [*named, *files],
    }


def records_of(product: str, plan: Inputs) -> tuple[str, ...]:
    """Return the identifiers of the records of a product: its own, or all of the study."""
    kind, _, name = product.partition("/")
    if kind == "record":
        return (name,)
    return plan.batches[name] if kind == "batch" else tuple(plan.records)


def of_kind(kind: str, plan: Inputs) -> tuple[str, ...]:
    """Return the first lines of `made_from`: what all products of a kind are made from."""
    line = TABLE[kind]
    settings = plan.settings
    reports = line.documents or settings.reports
    lines = [
        f"{key} = {_shown(key, value)}"
        for key, value in settings.values_of((*NUMBERS, *line.settings)).items()
    ]
    lines.append(_named("package", package_sha256(reports=reports)))
    lines += [f"{library}: {installed}" for library, installed in sorted(versions().items())]
    lines.append(_named("structures", *structure_hashes(plan.scenes).items()))
    for key, path in settings.values_of(line.files).items():
        lines.append(_contents_of(f"file of {key}", {path: plan.contents.of(Path(path))} if path else {}))
    if line.terms:
        lines.append(_named("terms", *((name, scene.terms) for name, scene in plan.scenes.items())))
    if kind in BY_NAME:
        lines.append(_named("source of the product", folder_sha256(BY_NAME[kind].source)))
    if line.shows:
        lines.append(f"products: {', '.join(plan.products_of_summary)}")
        sources = ((name, folder_sha256(BY_NAME[name].source)) for name in plan.products_of_summary)
        lines.append(_named("source of the products", *sources))
    return tuple(lines)


def _shown(key: str, value: Any) -> str:
    """The value of a setting on one line; of what a study says about itself the hash."""
    return sha256_of(value)[:16] if key in _about() else quote(repr(value), safe=_PLAIN)


@cache
def _about() -> frozenset[str]:
    return frozenset(layout()[Heading.ABOUT])


def _named(name: str, *values: object) -> str:
    return f"{name}: {sha256_of(*values)[:16]}"


def _contents_of(name: str, hashes: Mapping[str, str]) -> str:
    """The contents of files by their paths."""
    shown = (f"{quote(path, safe=_PLAIN)} {sha256[:16] or 'missing'}" for path, sha256 in hashes.items())
    text = "; ".join(shown)
    return f"{name}: {text}" if len(hashes) <= _FEW else _named(f"{len(hashes)} {name}", text)


_FEW = 8
"""Files that are named one by one: each output of a product keeps what it was made from."""


def _hashes(plan: Inputs, records: Iterable[CatalogueRecord]) -> dict[str, str]:
    """The contents of the files of records, and the answers by which their tables are read."""
    hashes: dict[str, str] = {}
    for record in records:
        hashes |= {**plan.files_of(record), **plan.answers_of(record)}
    return dict(sorted(hashes.items()))


def _catalogues(line: Line, settings: Settings) -> list[str]:
    """The other catalogues that the settings of a line name."""
    return [path for path in settings.values_of(line.catalogues).values() if path]


def _others(plan: Inputs, line: Line) -> dict[str, str]:
    """These catalogues, and the files of their records; one that cannot be read is reported when it is used."""
    hashes: dict[str, str] = {}
    for catalogue in _catalogues(line, plan.settings):
        hashes |= {catalogue: plan.contents.of(Path(catalogue))} | _hashes(plan, _rows_of(catalogue))
    return hashes


def _rows_of(catalogue: str) -> tuple[CatalogueRecord, ...]:
    try:
        return load_catalogue(catalogue)
    except RockingError:
        return ()


_LIBRARIES = (
    *("rocking", "h5py", "llvmlite", "matplotlib", "numba", "numpy", "obspy", "openpyxl", "pandas"),
    *("pydantic", "pyyaml", "scipy", "snakemake", "typst", "xlsxwriter"),
)
"""All that this package declares, but for what loads, fetches and counts: none of these can change a result; and what
compiles the kernels."""


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
