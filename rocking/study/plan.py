"""A study before its first job: settings, catalogue and structures, checked, and what each rule is made from."""

import csv
import os
import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cache, lru_cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from platform import python_version
from typing import Any, TypeVar
from urllib.parse import quote

from rocking.assessment.conclusion import to_check
from rocking.assessment.rows import FailureRow, WarningRow
from rocking.assessment.scene import Scene, load_scenes
from rocking.assessment.settings import Heading
from rocking.catalogue.catalogue import CatalogueRecord, load_catalogue, repeated
from rocking.catalogue.files import answers_of, files_by_name, local_files, with_hashes
from rocking.catalogue.folder import unlisted
from rocking.described import kind_in_words
from rocking.errors import ConfigurationError, RockingError
from rocking.hashes import sha256_of, sha256_of_file
from rocking.quantities import counted, shown
from rocking.records.formats.layouts import NAME as ANSWERS
from rocking.records.formats.layouts import Layouts
from rocking.study.folder import check_links, results_folder
from rocking.study.outputs import outcome_of
from rocking.study.product import TOLD
from rocking.study.products import BY_NAME, PRODUCTS
from rocking.study.settings import (
    NUMBERS,
    Settings,
    file_settings,
    layout,
    named_files,
    package_sha256,
    read_settings,
    structure_hashes,
)
from rocking.tables import read_rows
from rocking.tables.yaml_file import read_yaml
from rocking.warnings import RockingWarning

T = TypeVar("T")

_PLAIN = " ./,+=()[]'_-"
"""Next to letters and digits, what a param holds as it is: --report prints params, and no text of a study is markup."""
_DOCUMENTS = (*NUMBERS, *TOLD, "reports", "figures", "histories", "design_spectrum")
_READ = ("processing", "scale_to", "vertical")
MADE_FROM: Mapping[str, tuple[str, ...]] = {
    "read": _READ,
    "pulses": (*_READ, "pulse"),
    "predict": (*_READ, "pulse", "acceleration_scale", "friction_coefficient"),
    "integrate": (*NUMBERS, "reports", "histories"),
    "report": _DOCUMENTS,
    "summary": _DOCUMENTS,
    **{product.name: (*NUMBERS, *product.settings) for product in PRODUCTS},
}
"""The settings, and sections of settings, that each rule is made from. The steps of a record get no others."""


def study_warnings(settings: Settings, scenes: Mapping[str, Scene]) -> tuple[RockingWarning, ...]:
    """Return what there is to say of the settings and the structures of a study before it meets a record."""
    level = settings.design_spectrum.warning
    of_scenes = [warning for scene in scenes.values() for warning in scene.warnings]
    return (*([level] if level else []), *of_scenes)


@dataclass(frozen=True)
class Plan:
    """A study before it begins, of which the rules of the workflow ask what a job reads and what it is made from.

    records: by identifier, in catalogue order. by_name: whether the files of records are taken to be where the
    catalogue says, with the hashes that it states, because they lie on another machine.
    """

    settings: Settings
    records: Mapping[str, CatalogueRecord]
    by_name: bool = False

    @property
    def scenes(self) -> Mapping[str, Scene]:
        """The structures by name, in the order of the list."""
        return scenes_of(self.settings.structures)

    @property
    def results(self) -> Path:
        """The folder of the results."""
        return Path(self.settings.results)

    @property
    def products(self) -> tuple[str, ...]:
        """The products over all records that every run makes, and the summary shows."""
        return tuple(product.name for product in PRODUCTS if product.in_every_run(self.settings))

    @property
    def outcomes(self) -> list[Path]:
        """The file of the outcome of each record, in catalogue order."""
        return [outcome_of(self.results, record) for record in self.records]

    @property
    def warnings(self) -> tuple[str, ...]:
        """What has to be checked before the run."""
        of_study = WarningRow.of_study(study_warnings(self.settings, self.scenes))
        of_catalogue = (*repeated(self.records.values()), *unlisted(Path(self.settings.catalogue)))
        return (*to_check(of_study), *map(str, of_catalogue))

    def of(self, record: str) -> "Plan":
        """Return what the job of one record needs of it.

        Raises ConfigurationError for a record that the catalogue does not have.
        """
        if record not in self.records:
            raise ConfigurationError(
                f"{self.settings.catalogue}: it has no record {record}; ask for one that it has.",
                record=record,
            )
        return replace(self, records={record: self.records[record]})

    # What a job reads ------------------------------------------------------------------------------------

    @property
    def listed(self) -> list[str]:
        """The files by which every job knows the study: the catalogue first, the structures, and what these name."""
        catalogue = Path(self.settings.catalogue)
        answers = [str(path) for path in [catalogue.with_name(ANSWERS)] if path.is_file()]
        return [str(catalogue), *answers, self.settings.structures, *_curves(Path(self.settings.structures))]

    def files_of(self, record: CatalogueRecord) -> list[str]:
        """Return the files from which a record is read.

        Raises ConfigurationError where they lie on another machine, and the catalogue does not state their hashes.
        """
        if not self.by_name:
            return list(map(str, local_files(record, self.settings.mirror)))
        hashes = files_by_name(record)
        if "" in hashes.values() or self.settings.mirror:
            raise ConfigurationError(
                f"{self.settings.catalogue}: record {record.id} is read on another machine, so that its sha256 must "
                "stand in the catalogue, and its files in the folder of it; list it where they lie, without mirror: "
                "rocking catalogue.",
                sha256=record.sha256,
            )
        return [*hashes, *([str(record.folder / record.inventory)] if record.inventory else [])]

    def files(self, rule: str, record: str = "") -> list[str]:
        """Return the further files that a job reads: of its records, and those that its settings name."""
        product = BY_NAME.get(rule)
        of_rule = [name for name in file_settings() if {name, name.partition(".")[0]} & {*MADE_FROM[rule]}]
        named = self.settings.values_of(of_rule)
        rows = [self.of(record).records[record]] if rule == "read" else []
        if product and (product.opens_records or product.pool):
            pool = named.get(product.pool)
            rows += _rows_of(pool) if pool else self.records.values()
        files = [file for row in rows for file in self.files_of(row)]
        return [*dict.fromkeys([*filter(None, named.values()), *files])]

    # What it is made from --------------------------------------------------------------------------------

    def params(self, rule: str) -> dict[str, str]:
        """Return what all jobs of a rule are made from, by name: settings with their values, contents as hashes."""
        product = BY_NAME.get(rule)
        chosen = self.settings.values_of(MADE_FROM[rule])
        made_from = {name.replace(".", "_"): _in_print(name, value) for name, value in chosen.items()}
        made_from["package"] = package_sha256()[:16]
        made_from["libraries"] = ", ".join(f"{name} {number}" for name, number in versions().items())
        if rule not in ("read", "pulses"):
            made_from["structures_sha256"] = sha256_of(*structure_hashes(self.scenes).items())[:16]
        if rule == "summary":
            made_from["products"] = ", ".join(self.products)
        if product and product.pool:
            terms = ((name, scene.terms) for name, scene in self.scenes.items())
            made_from["terms_of_structures"] = sha256_of(*terms)[:16]
        return {
            name: f"{name}: {value}" for name, value in made_from.items()
        }  # snakemake compares values alone

    def contents(self, rule: str, record: str = "") -> str:
        """Return one hash for the rows of the records of a job, the contents of `files` and how tables are read.

        What a step of a record takes from the steps before it snakemake itself knows by its date.
        """
        rows = [] if record else [*self.records.values()]
        if rule == "read":
            rows = [self.of(record).records[record]]
        files = [] if rule == "summary" else self.files(rule, record)
        opens = rule == "read" or (rule in BY_NAME and BY_NAME[rule].opens_records)
        answers = [self.answers_of(row) for row in rows] if opens else []
        hashes = files_by_name(rows[0]) if self.by_name and rule == "read" else {}
        contents = [(file, hashes.get(file) or _content(file)) for file in files]
        return sha256_of(*rows, *contents, *answers)[:16]

    def answers_of(self, record: CatalogueRecord) -> dict[str, str]:
        """Return the hash of the answer by which each table of a record is read."""
        if not self.by_name:
            return answers_of(record, self.settings.mirror)
        answers = record.folder / ANSWERS
        return {str(answers): _content(str(answers))}


def _curves(structures: Path) -> list[str]:
    """The files of capacity curves that a list of structures names; that of its schema is a URL, and none of them."""
    text = structures.read_text(encoding="utf-8", errors="replace")
    if structures.suffix.lower() == ".csv":
        named = [row.get("file") or "" for row in csv.DictReader(text.splitlines())]
    else:
        named = re.findall(r"""\bfile["']?\s*:(?!//)\s*["']?([^,}"'\n#]+)""", text)
    return [name for name in dict.fromkeys(map(str.strip, named)) if os.path.isfile(name)]


def folder_of(copy: str, named: str) -> str:
    """Return the folder in which `copy` is the file that the study calls `named`: "" where it is no copy."""
    own, name = Path(copy).parts, Path(named).parts
    if own[len(own) - len(name) :] != name:
        raise ValueError(f"{copy} is no copy of {named}")
    return str(Path(*own[: len(own) - len(name)])) if own != name else ""


def check_failures(table: Path) -> None:
    """Raise RockingError where something that was asked for gave no result, so that the command ends with status 1."""
    if failures := [*read_rows(FailureRow, table)]:
        raise RockingError(
            f"{counted(len(failures), 'row')} of {table} say what gave no result, and why; all else stands"
        )


def not_ahead(paths: Iterable[str]) -> list[str]:
    """Return the paths of files that are not dated ahead of the clock, and in which snakemake reads no variables.

    Behind an input that is dated in the future it would remove what a job wrote. The contents count all the same.
    """
    now = time.time()
    plain = (path for path in paths if not set(path) & set("{}<>"))
    return [path for path in plain if not os.path.exists(path) or os.stat(path).st_mtime <= now]


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
    missing = dict(missing_files(settings, ("catalogue", "structures")))
    defects += missing.values()
    catalogue = () if "catalogue" in missing else attempt(load_catalogue, settings.catalogue) or ()
    attempt(lambda: Layouts(Path(settings.catalogue).parent).rows)
    if "structures" not in missing:
        attempt(scenes_of, settings.structures)
    attempt(_check_results, settings)
    if defects:
        raise ConfigurationError("\n".join(defects))
    records = {record.id: with_hashes(record, settings.mirror) for record in catalogue}
    return Plan(settings, records, by_name)


def check_files(settings: Settings) -> None:
    """Raise ConfigurationError where a file that a setting names is not there, or holds no design spectrum."""
    if missing := [sentence for _, sentence in missing_files(settings)]:
        raise ConfigurationError("\n".join(missing))
    settings.design_spectrum.spectrum()


def missing_files(settings: Settings, names: Iterable[str] = ()) -> Iterator[tuple[str, str]]:
    """Yield each setting, or each of `names`, that names a file that is not there, and the sentence that says so."""
    named = settings.values_of(names or file_settings())
    for name, value in named.items():
        if not value or os.path.lexists(value):
            continue
        folder, file = os.path.split(Path.cwd() / value)
        others = os.listdir(folder) if os.path.isdir(folder) else []
        near = [
            near for near in get_close_matches(file, others, n=1) if Path(near).suffix == Path(file).suffix
        ]
        hint = "write its path from the folder of the study"
        if near:
            hint = f"did you mean {Path(value).with_name(near[0])}?"
        elif name == "catalogue":
            hint = f"there is no catalogue yet: put records into {folder}, then: rocking catalogue {folder}"
        yield name, f"setting {name} is {shown(value)}, but no such file is in {Path.cwd()}; {hint}"


def scenes_of(path: str) -> Mapping[str, Scene]:
    """Return the scenes of a list, those that this process has read where its content is the same.

    What their structures have computed a job need not compute again that is forked from a process which had them.
    """
    return _listed(path, _content(path)) if os.path.isfile(path) else load_scenes(path)


@lru_cache(maxsize=1)
def _listed(path: str, _sha256: str) -> Mapping[str, Scene]:
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
    check_links(Path(".snakemake"), results)


def _content(path: str) -> str:
    """The sha256 of a file; "" of one that cannot be read."""
    try:
        status = os.stat(path)
        return _sha256(path, status.st_ino, status.st_size, status.st_mtime_ns, status.st_ctime_ns)
    except OSError:
        return ""


@cache
def _sha256(path: str, *_mark: int) -> str:
    """The sha256 of a file, read once for all jobs that read it; mark: what changes with its content."""
    return sha256_of_file(Path(path))


def _in_print(name: str, value: Any) -> str:
    """The value of a setting as a param; of what a study says about itself the hash."""
    return sha256_of(value)[:16] if name in _about() else quote(repr(value), safe=_PLAIN)


@cache
def _about() -> frozenset[str]:
    return frozenset(layout()[Heading.ABOUT])


def _rows_of(catalogue: str) -> tuple[CatalogueRecord, ...]:
    """The rows of another catalogue; one that cannot be read is reported where it is used."""
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
