"""The settings of a study: those of each part of the package, and what is the study's own.

Each says its type, unit, bounds and meaning where it is declared. config.yaml is read and checked as a whole, and
written, with its JSON schema, from these. After a change: make schema. Every row names them by a hash.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, fields, is_dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import yaml

from rocking.assessment.settings import AssessmentSettings, Heading
from rocking.described import (
    Described,
    check_described,
    described,
    described_values,
    parts_of,
    read_described,
)
from rocking.errors import ConfigurationError, RecordError
from rocking.hashes import sha256_of, sha256_of_sources
from rocking.quantities import GRAVITY
from rocking.reports.pages import Fact, PageSettings
from rocking.signal.processing import Processing
from rocking.signal.scaling import ScalingTarget
from rocking.structures.joints import USUAL, Joints
from rocking.structures.kinds import StructureKind
from rocking.structures.structure import CRACKS
from rocking.tables.yaml_file import scalar_value
from rocking.warnings import RockingWarning

if TYPE_CHECKING:
    from rocking.assessment.scene import Scene
    from rocking.codes.design_spectrum import DesignSpectrum

_LARGEST_USUAL = 0.6
"""a_g beyond which a warning asks for the unit, g: what maps of hazard give for rock lies below nearly everywhere."""


@dataclass(frozen=True)
class StudyDesign:
    """The design level of a study; without ag and without points there is none."""

    heading: ClassVar[Heading] = Heading.DESIGN
    changes_numbers: ClassVar[bool] = False  # of the tables of records

    ag: float | None = described(
        None, "peak acceleration a_g on rock; null: no design level", "g", gt=0, le=3
    )
    f0: float | None = described(None, "amplification F0 of NTC 2018", gt=0, le=10)
    tc_star: float | None = described(None, "period T_C* of NTC 2018", "s", gt=0, le=3)
    soil: Literal["A", "B", "C", "D", "E"] = described("A", "ground type of NTC 2018: A (rock), B, C, D or E")
    topography: float = described(1.0, "topographic factor S_T", ge=1.0, le=1.4)
    points: str | None = described(
        None,
        "in place of ag_g: CSV file of the spectrum, with columns period_s and acceleration_m_s2 or acceleration_g",
        is_file=True,
    )
    damping: float = described(0.05, "damping ratio of the spectrum", ge=0, le=0.5)

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
        given = {"f0": self.f0, "tc_star_s": self.tc_star}
        if self.ag is not None and self.points is not None:
            raise ConfigurationError(
                f"points is {self.points!r} together with ag_g = {self.ag:g}, but one of the two must be null."
            )
        for name, value in given.items():
            if self.ag is not None and value is None:
                raise ConfigurationError(f"{name} is missing, but must be given with ag_g.")
            if self.ag is None and value is not None:
                raise ConfigurationError(f"ag_g is missing, but must be given with {name}.")

    @property
    def is_given(self) -> bool:
        """Whether there is a design level."""
        return self.points is not None or self.ag is not None

    @property
    def warning(self) -> RockingWarning | None:
        """A warning on an a_g beyond what codes map, as one that was typed in m/s² is; None within."""
        if self.ag is None or self.ag <= _LARGEST_USUAL:
            return None
        return RockingWarning.of(
            StructureKind.SIZE_UNUSUAL,
            "design_spectrum.ag_g",
            value=self.ag,
            low=0.0,
            high=_LARGEST_USUAL,
            unit=" g",
            type="a design level",
        )

    def spectrum(self) -> "DesignSpectrum | None":
        """Return the spectrum; None where there is no design level. Raises ConfigurationError for its points."""
        if not self.is_given:
            return None
        from rocking.codes.design_spectrum import DesignSpectrum

        if self.points is not None:
            return DesignSpectrum.read(Path(self.points), self.damping)
        assert self.ag is not None and self.f0 is not None and self.tc_star is not None  # checked at birth
        return DesignSpectrum.ntc(
            self.ag * GRAVITY, self.f0, self.tc_star, self.soil, self.topography, self.damping
        )


@dataclass(frozen=True)
class StudyChecks:
    """The checks at the design level, and the sets of records that represent it."""

    heading: ClassVar[Heading] = Heading.CHECKS
    changes_numbers: ClassVar[bool] = False

    limit_state: Literal["SLV", "SLC"] = described(
        "SLV", "limit state of the checks: SLV (life safety) or SLC (collapse)"
    )
    confidence_factor: float = described(
        1.35,
        "confidence factor FC of the checks; 1.35 (LC1) unless a compressive_strength is given",
        ge=1,
        le=2,
    )
    behaviour_factor: float = described(2.0, "behaviour factor q of the linear check", ge=1, le=5)
    stations: int = described(20, "stations of a set", ge=1, le=1000)
    least_factor: float = described(0.25, "least factor on a record of a set", gt=0)
    largest_factor: float = described(4.0, "largest factor on a record of a set", gt=0)
    shortest_period: float = described(
        0.15, "shortest period at which the mean spectrum of a set must fit the target", "s", gt=0
    )
    longest_period: float = described(2.0, "longest period at which it must fit", "s", gt=0, le=10)
    seed: int = described(0, "random seed of the sets", ge=0)
    least_others: float = described(
        0.5,
        "least share of the sets of other stations that must meet the dynamic check, by the lower end of its interval, "
        "for it to be called met",
        ge=0,
        le=1,
    )
    pool: str | None = described(
        None, "catalogue from which sets of records are drawn; null: that of the study", is_file=True
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
        if self.shortest_period >= self.longest_period:
            raise ConfigurationError(
                f"shortest_period_s is {self.shortest_period:g} s, but must be below longest_period_s, "
                f"{self.longest_period:g} s."
            )
        if self.least_factor >= self.largest_factor:
            raise ConfigurationError(
                f"least_factor is {self.least_factor:g}, but must be below largest_factor, "
                f"{self.largest_factor:g}."
            )


@dataclass(frozen=True)
class StudyProcessing(Processing):
    """The processing of the records, and the choice of those that need it."""

    heading: ClassVar[Heading] = Heading.PROCESSING

    apply: Literal["raw", "always", "never"] = described(
        "raw", "which records are processed: raw ones, whose file says so; always; never"
    )


@dataclass(frozen=True)
class StudyFragility:
    """The intensity measure and levels of fragility, and the studies that compute it."""

    heading: ClassVar[Heading] = Heading.FRAGILITY
    changes_numbers: ClassVar[bool] = False

    intensity_measure: str = described(
        "pgv",
        "measure of the levels: pgv [m/s], pga [g], p_pgv [-], arias [m/s], cav [m/s], SA(T), AvgSA(T1,T2), "
        "Sa_avg2(T), Sa_avg3(T) [g], FIV3(T) [m/s]; AvgSA and FIV3 alone: at the periods of the structure",
    )
    members: bool = described(True, "whether a case counts by the share of its members that overturn")
    largest_factor: float = described(
        10.0,
        "largest factor on a record; what cannot reach a level within it is left out of that level",
        ge=1,
        le=1e6,
    )
    hazard: str | None = described(
        None,
        "CSV of a hazard curve: of OpenQuake, or with the columns annual_rate and levels with their unit, such as "
        "level_g, ascending; or null",
        is_file=True,
    )
    in_every_run: bool = described(False, "whether every run computes the fragility")

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
        if self.intensity_measure != "pgv":
            # A study without a fragility has no need of it.
            from rocking.fragility.measures import check_name

            check_name(self.intensity_measure)


@dataclass(frozen=True)
class StudyTrade:
    """When error is measured against time."""

    heading: ClassVar[Heading] = Heading.TRADE
    changes_numbers: ClassVar[bool] = False

    in_summary: bool = described(False, "whether every run measures the trade and draws it in summary.pdf")

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)


@dataclass(frozen=True)
class Settings(AssessmentSettings):
    """The settings of a study; the names and their units are the keys of config.yaml."""

    study: str | None = described(
        "", "title of the study", heading=Heading.ABOUT, printed_as="study", changes_numbers=False
    )
    client: str | None = described(
        "", "client of the study", heading=Heading.ABOUT, printed_as="client", changes_numbers=False
    )
    project_number: str | None = described(
        "", "number of the project", heading=Heading.ABOUT, printed_as="project number", changes_numbers=False
    )
    author: str | None = described(
        "", "author of the study", heading=Heading.ABOUT, printed_as="author", changes_numbers=False
    )
    date: str | None = described(
        "",
        "date of the reports, as they print it",
        heading=Heading.ABOUT,
        printed_as="date",
        changes_numbers=False,
    )
    catalogue: str = described(
        "records/catalogue.csv",
        "catalogue of the records, one row per station",
        heading=Heading.RECORDS,
        is_file=True,
        changes_numbers=False,
    )
    structures: str = described(
        "structures.yaml",
        "list of the structures, YAML, CSV or XLSX, in metres and degrees",
        heading=Heading.RECORDS,
        is_file=True,
        changes_numbers=False,
    )
    results: str = described(
        "results", "folder of the results", heading=Heading.RECORDS, changes_numbers=False
    )
    mirror: str | None = described(
        None,
        "folder that already holds the files of remote records",
        heading=Heading.RECORDS,
        changes_numbers=False,
    )
    unnamed_events: Literal["one", "each"] = described(
        "one",
        "what records that name no earthquake count as in every interval: one earthquake all together, from which "
        "nothing follows for others, or each of its own, where you know that they are",
        heading=Heading.RECORDS,
    )
    processing: StudyProcessing = StudyProcessing(pre_event=1.0, baseline="linear", taper=0.02, high_pass=0.1)
    scale_to: str | None = described(
        None,
        "peak to which each record is scaled, by one factor on all its components: the larger horizontal one, as in "
        "pga 0.35 g or pgv 50 cm/s; null: as the catalogue says",
        pattern=r"^\s*[Pp][Gg][AaVv]\s+[0-9.]+([eE][-+]?[0-9]+)?\s*[A-Za-z].*$",
        examples=["pga 0.35 g", "pgv 50 cm/s"],
        heading=Heading.PROCESSING,
    )
    friction_coefficient: float = described(
        USUAL.friction, "friction coefficient beyond which a contact slides", gt=0, le=10
    )
    vertical: bool = described(False, "whether the vertical component acts as well, where a record has one")
    candidates: int = described(
        CRACKS, "number of heights tried for the hinge of a wall or the crack of a spire", ge=0, le=1000
    )
    processing_variants: bool = described(True, "whether other baselines and corner frequencies are tried")
    design_spectrum: StudyDesign = StudyDesign()
    checks: StudyChecks = StudyChecks()
    fragility: StudyFragility = StudyFragility()
    trade: StudyTrade = StudyTrade()
    reports: bool = described(
        True,
        "whether PDF reports are written in addition to the tables; without them a run makes no map, which rocking map "
        "then does",
        heading=Heading.OUTPUT,
        changes_numbers=False,
    )
    display_units: Literal["SI", "g and cm"] = described(
        "SI",
        "how reports show accelerations, velocities and displacements: in SI units as the tables do, or in g and cm",
        heading=Heading.OUTPUT,
        changes_numbers=False,
    )
    figures: Literal["none", "svg", "png", "svg and png"] = described(
        "none",
        "figures of each PDF in an archive next to it (report_figures.zip): none, svg, png (200 dpi) or svg and png",
        heading=Heading.OUTPUT,
        changes_numbers=False,
    )
    language: Literal["en", "it"] = described(
        "en",
        "language of structures.pdf, the pages to sign: en or it; all other documents and tables are English",
        heading=Heading.OUTPUT,
        changes_numbers=False,
    )
    histories: bool = described(
        False,
        "whether each record gets histories.csv, the rotation of every response",
        heading=Heading.OUTPUT,
        changes_numbers=False,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.scale_to:
            try:
                ScalingTarget.parse(self.scale_to)
            except RecordError as error:
                raise ConfigurationError(str(error)) from None

    def only(self, names: Iterable[str]) -> "Settings":
        """Return these settings with no others than `names`, of settings and sections: to read another one fails."""
        known = frozenset(names)
        made = _Handed(**{name: getattr(self, name) for name in known})
        object.__setattr__(made, "_known", known)
        return made

    def knows(self, name: str) -> bool:
        """Whether it holds the setting, or section of settings, of this name."""
        return name in vars(self).get("_known", _NAMES)

    @property
    def joints(self) -> Joints:
        """The joints of every structure of the study."""
        return Joints(self.friction_coefficient)

    @classmethod
    def changing_numbers(cls) -> list[str]:
        """Return the names of the settings, and of the sections, that change a number of a table."""
        return [setting.name for setting in fields(cls) if _said_of(setting.name, "changes_numbers", True)]

    def values_of(self, names: Iterable[str]) -> dict[str, Any]:
        """Return the values of some settings by their names, those of a section as section.name.

        names: of settings and sections; section.name is one setting of a section.
        """
        chosen: dict[str, Any] = {}
        for name in names:
            top, _, part = name.partition(".")
            value = getattr(self, top)
            if part:
                chosen[name] = getattr(value, part)
            elif is_dataclass(value):
                chosen |= {
                    f"{name}.{setting.name}": getattr(value, setting.name) for setting in fields(value)
                }
            else:
                chosen[name] = value
        return chosen

    def mapping(self) -> dict[str, Any]:
        """All settings by their names, and below "about" what every report prints of the study, by its label."""
        values = {
            name: asdict(value) if is_dataclass(value) else value  # type: ignore[arg-type]
            for name, value in vars(self).items()
        }
        return values | {"about": {fact.label: fact.text for fact in self.facts}}

    @property
    def facts(self) -> tuple[Fact, ...]:
        """What every report prints of the study; what was left blank is left out."""
        labels = {
            name: setting.more.get("printed_as", "") for name, setting in described_values(Settings).items()
        }
        printed = ((label, getattr(self, name)) for name, label in labels.items() if label)
        return tuple(Fact(label=label, text=str(value)) for label, value in printed if value)

    @property
    def for_pages(self) -> PageSettings:
        """What documents print of them: in English, but for the pages to sign."""
        return PageSettings(
            about=self.facts,
            language="en",
            date=self.date,
            display_units=self.display_units,
            tolerance=self.tolerance,
            acceleration_scale=self.acceleration_scale,
        )

    @property
    def for_pages_to_sign(self) -> PageSettings:
        """What the pages to sign print of them."""
        return replace(self.for_pages, language=self.language)


def _said_of(name: str, what: str, otherwise: Any) -> Any:
    """The extra facts that a setting, or a section of settings, declares besides its type and meaning."""
    values = described_values(Settings)
    if name in values:
        return values[name].more.get(what, otherwise)
    return getattr(getattr(Settings, name), what, otherwise)


@cache
def file_settings() -> tuple[str, ...]:
    """Return the names of the settings that name a file which must be there; of a section as section.name."""
    own = [name for name, setting in described_values(Settings).items() if setting.more.get("is_file")]
    for part in parts_of(Settings):
        values = described_values(getattr(Settings, part).__class__)
        own += [f"{part}.{name}" for name, setting in values.items() if setting.more.get("is_file")]
    return tuple(own)


def layout() -> dict[Heading, list[str]]:
    """Return the names of the settings below each heading of config.yaml, as they are declared."""
    by_heading: dict[Heading, list[str]] = {heading: [] for heading in Heading}
    for name in _entries(Settings()):
        by_heading[_said_of(name, "heading", Heading.METHOD)].append(name)
    return by_heading


EXAMPLE = Settings(structures="config/structures.yaml", trade=StudyTrade(in_summary=True))
"""The settings of the shipped example, whose structures lie next to it, and whose summary shows the trade."""


def read_settings(config: Mapping[str, Any]) -> Settings:
    """Return the settings in `config`, the mapping of a config.yaml; one that is left out gets its default.

    A text says what it would in the file: so values come from snakemake --config. Raises ConfigurationError with every
    defect, one a line: the setting, its value, and what is allowed.
    """
    defects: list[str] = []
    settings = read_described(Settings(), config, defects, "setting ", scalar_value)
    if defects:
        raise ConfigurationError("\n".join(defects))
    return settings


def named_files(config: Mapping[str, Any]) -> Settings:
    """Return the default settings but for the files and folders that a defective `config` names all the same."""
    names = ("catalogue", "structures", "results")
    return Settings(
        **{name: config[name] for name in names if isinstance(config.get(name), str) and config[name]}
    )


def json_schema(section: Any = None) -> dict[str, Any]:
    """Return the JSON schema of config.yaml, for editors and for other programs; section: of this part alone."""
    head = {"$schema": "http://json-schema.org/draft-07/schema#", "title": "Settings of a study"}
    return {
        **({"description": " ".join((section.__doc__ or "").split())} if section else head),
        "type": "object",
        "additionalProperties": False,
        "properties": {
            key: json_schema(value)
            if description is None
            else {**description.schema, "description": _meaning(description), "default": value}
            for key, (description, value) in _entries(section or Settings()).items()
        },
    }


def schema_file() -> str:
    """Return the text of workflow/schemas/config.schema.yaml: the schema, and what writes it."""
    result: str = "# Written from rocking.study.settings by: make schema\n" + yaml.safe_dump(
        json_schema(), sort_keys=False, allow_unicode=True, width=117
    )
    return result


def commented_yaml(settings: Settings) -> str:
    """Return `settings` as a config.yaml in which every line says what it sets."""
    lines = ["# Every setting with its unit. What is left out keeps the value that it has here."]
    lines += ["# Paths are relative to the folder in which the study runs."]
    for heading, names in layout().items():
        lines += ["", f"# {heading} ".ljust(105, "-"), *_yaml_lines(settings, names)]
    return "\n".join([*lines, ""])


CHANGED_FIRST = (
    *("study", "catalogue", "structures", "scale_to", "vertical", "friction_coefficient"),
    *("design_spectrum.ag_g", "design_spectrum.f0", "design_spectrum.tc_star_s", "design_spectrum.soil"),
)
"""The settings that a study of one's own changes first, as config.yaml names them."""


def first_yaml(settings: Settings) -> str:
    """Return the settings that a user changes first as a config.yaml that says where all others are listed."""
    lines = [
        "# The settings that studies change most. Every other one keeps its default until it is written here: all"
    ]
    lines += [
        "# stand on the page Settings of the documentation (docs/pages/settings.md), each with its unit."
    ]
    lines += ["# Paths are relative to the folder in which the study runs.", ""]
    names = [name for name in CHANGED_FIRST if "." not in name]
    lines += _yaml_lines(settings, names)
    below: dict[str, list[str]] = {}
    for top, _, key in (name.partition(".") for name in CHANGED_FIRST if "." in name):
        below.setdefault(top, []).append(key)
    for top, keys in below.items():
        lines += [f"{top}:", *_yaml_lines(getattr(settings, top), keys, "  ")]
    return "\n".join([*lines, ""])


def _yaml_lines(section: Any, names: Iterable[str] = (), indent: str = "") -> Iterator[str]:
    entries = _entries(section)
    for key in names or entries:
        description, value = entries[key]
        if description is None:
            yield f"{indent}{key}:"
            yield from _yaml_lines(value, indent=indent + "  ")
        else:
            optional = description.optional and "null" not in description.meaning and value != ""
            scalar = yaml.safe_dump(value).splitlines()[0]
            yield f"{indent}{key}: {scalar} ".ljust(48) + f"# {_meaning(description)}{', or null' * optional}"


def _entries(section: Any) -> dict[str, tuple[Described | None, Any]]:
    """The declaration (None: a section of its own) and the value of each key of a section."""
    kind = section.__class__
    values = described_values(kind).items()
    return {name: (None, getattr(section, name)) for name in parts_of(kind)} | {
        description.key: (description, getattr(section, name)) for name, description in values
    }


def _meaning(description: Described) -> str:
    return f"{description.meaning}, {description.unit}" if description.unit else description.meaning


# What every row names -----------------------------------------------------------------------------------


class _Handed(Settings):
    """The settings that one step is handed. At its default another one would be read as if the study had set it so."""

    def __getattribute__(self, name: str) -> Any:
        if name in _NAMES and not self.knows(name):
            raise LookupError(f"the setting {name} is read in a step that is not made from it (MADE_FROM).")
        return super().__getattribute__(name)


_NAMES = frozenset(setting.name for setting in fields(Settings))
NUMBERS = tuple(Settings.changing_numbers())
"""The settings, and the sections of settings, that change a number of a table."""
_SOURCE = {".py", ".csv", ".json", ".po", ".typ", ".yaml", ".mplstyle", ".html", ".css", ".js"}


def structure_hashes(scenes: Mapping[str, "Scene"]) -> dict[str, str]:
    """Return one hash for what each structure says of itself and its support, by its name."""
    return {name: scene.sha256 for name, scene in scenes.items()}


def settings_sha256(settings: Settings, scenes: Mapping[str, "Scene"]) -> str:
    """Return the hash that every row names: of the settings that change a number, the structures and the package."""
    numbers = settings.values_of(filter(settings.knows, NUMBERS))
    return sha256_of(*numbers.items(), *structure_hashes(scenes).items(), package_sha256())


@cache
def package_sha256() -> str:
    """Return one hash for the source of this package, on which every job depends."""
    root = Path(__file__).parents[1]
    return sha256_of_sources(root, (path for path in root.rglob("*") if path.suffix in _SOURCE))
