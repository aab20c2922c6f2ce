"""The settings of a study as one typed tree: every setting once, with its type, unit, bounds, meaning and default.

What belongs to a part of the package is declared there and only placed here. rocking.study.config_file reads it from a
file, and writes the JSON schema and the shipped config.yaml from it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, is_dataclass
from typing import Any, Literal

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility.settings import FragilitySettings
from rocking.assessment.settings import AssessmentSettings
from rocking.pulses import PulseSettings
from rocking.quantities import setting
from rocking.records.processing import UNPROCESSED_DEFAULT, Processing
from rocking.structures.mechanism import Scale

_KEEP = object()


def _own(
    default: Any, meaning: str, unit: str = "", *, heading: str = "", numbers: bool = True, **bounds: float
) -> Any:
    """A setting of the study itself. heading: of the settings from here on. numbers: whether it changes any."""
    made = setting(default, meaning, unit, one_of=(), **bounds)
    return _placed(made, heading=heading, numbers=numbers)


def _of(part: type, name: str, *, default: Any = _KEEP, heading: str = "", numbers: bool = True) -> Any:
    """The setting `name` that a part of the package declares."""
    declared = next(each for each in fields(part) if each.name == name)
    made = setting(declared.default if default is _KEEP else default, "")
    return _placed(made, **declared.metadata, part=part, name=name, heading=heading, numbers=numbers)


def _placed(made: Any, **said: Any) -> Any:
    return field(default=made.default, metadata={**made.metadata, **said})


def _raw(name: str) -> Any:
    return _of(Processing, name, default=getattr(UNPROCESSED_DEFAULT, name))


@dataclass(frozen=True)
class ProcessingSettings:
    """Which records are processed, and how."""

    apply: Literal["raw", "always", "never"] = _own(
        "raw", "raw: records whose file says they are uncorrected; always: all; never: none"
    )
    pre_event_s: float | None = _raw("pre_event")
    baseline: Literal["none", "linear", "adaptive"] = _raw("baseline")
    taper: float = _raw("taper")
    high_pass_hz: float | None = _raw("high_pass")
    low_pass_hz: float | None = _raw("low_pass")


@dataclass(frozen=True)
class DominantPulseSettings:
    """Which pulse is sought and chosen."""

    lowest_frequency_hz: float = _of(PulseSettings, "lowest_frequency")
    highest_frequency_hz: float = _of(PulseSettings, "highest_frequency")
    frequencies_per_octave: int = _of(PulseSettings, "per_octave")
    choice: str = _of(AssessmentSettings, "pulse_choice")


@dataclass(frozen=True)
class StudyEnsembleSettings:
    """What is not known of a case."""

    members: int = _of(EnsembleSettings, "members")
    amplitude_range: float = _of(EnsembleSettings, "amplitude_range")
    restitution_range: float = _of(EnsembleSettings, "restitution_range")
    polarity: bool = _of(EnsembleSettings, "polarity")
    processing: bool = _of(EnsembleSettings, "processing")
    risk: float = _of(EnsembleSettings, "risk")


@dataclass(frozen=True)
class StudyFragilitySettings:
    """What fragility is measured with."""

    intensity_measure: str = _of(FragilitySettings, "intensity_measure", numbers=False)
    members: bool = _of(FragilitySettings, "members", numbers=False)
    mechanism_runs: int | None = _of(FragilitySettings, "mechanism_runs", numbers=False)
    hazard: str | None = _of(FragilitySettings, "hazard", numbers=False)
    in_every_run: bool = _own(False, "measure it in every run", numbers=False)


@dataclass(frozen=True)
class StudyTradeSettings:
    """When error is measured against time."""

    in_summary: bool = _own(False, "measure it in every run, and draw it in summary.pdf", numbers=False)


def _section(kind: type, heading: str = "") -> Any:
    return field(default_factory=kind, metadata={"heading": heading})


@dataclass(frozen=True)
class Settings:
    """What a study is made with; the names are the keys of config.yaml. Checked by rocking.study.config_file."""

    catalogue: str = _own(
        "records/catalogue.csv",
        "which accelerograms, one row each",
        heading="Records and structures",
        numbers=False,
    )
    structures: str = _own("structures.yaml", "which structures, SI units and degrees", numbers=False)
    results: str = _own("results", "folder of the results", numbers=False)
    mirror: str | None = _own(None, "folder that already holds the files of remote records", numbers=False)
    processing: ProcessingSettings = _section(ProcessingSettings, "Processing, told in every report")
    acceleration_scale: Scale = _of(AssessmentSettings, "acceleration_scale", heading="Method")
    tolerance: float = _of(AssessmentSettings, "tolerance")
    vertical: bool = _own(False, "let the vertical component act too, where a record has one")
    friction_coefficient: float = _of(AssessmentSettings, "friction_coefficient")
    pulse: DominantPulseSettings = _section(DominantPulseSettings)
    candidates: int = _own(
        11, "heights tried for the hinge of a wall or the crack of a spire; 0: none", ge=0, le=1000
    )
    processing_variants: bool = _own(True, "also meet the record with other baselines and corner frequencies")
    fidelity: Literal["full", "auto"] = _of(AssessmentSettings, "fidelity")
    fidelity_risk: float = _of(AssessmentSettings, "fidelity_risk")
    ensemble: StudyEnsembleSettings = _section(
        StudyEnsembleSettings, "Ensemble: what is not known of a case varies within these ranges"
    )
    fragility: StudyFragilitySettings = _section(
        StudyFragilitySettings, "Fragility from all records of the study: snakemake fragility"
    )
    trade: StudyTradeSettings = _section(StudyTradeSettings, "Trade of error for time: snakemake trade")
    reports: bool = _own(
        True, "PDF reports; the tables are written either way", heading="Output", numbers=False
    )
    histories: bool = _own(
        False, "rotation histories of every response too, as histories.csv of each record", numbers=False
    )
    records_per_job: int | None = _own(
        None,
        "about; null: the square root of their number, an eighth of it from 64, 200 from 1600",
        numbers=False,
        ge=1,
    )

    @property
    def assessment(self) -> AssessmentSettings:
        """What a record is compared with."""
        return AssessmentSettings(
            **self._values(AssessmentSettings),
            pulse=PulseSettings(**self._values(PulseSettings)),
            ensemble=EnsembleSettings(**self._values(EnsembleSettings)),
        )

    @property
    def raw_processing(self) -> Processing:
        """How raw records are processed."""
        return Processing(**self._values(Processing))

    @property
    def fragility_analysis(self) -> FragilitySettings:
        """What the target fragility measures with."""
        return FragilitySettings(**self._values(FragilitySettings))

    def numbers(self) -> dict[str, Any]:
        """The settings that change a number of a table, by their full name."""
        return {leaf.path: leaf.value for leaf in _leaves(self) if leaf.said["numbers"]}

    def mapping(self) -> dict[str, Any]:
        """The whole tree as the mapping that config.yaml would hold."""
        return asdict(self)

    def _values(self, part: type) -> dict[str, Any]:
        return {leaf.said["name"]: leaf.value for leaf in _leaves(self) if leaf.said.get("part") is part}


@dataclass(frozen=True)
class _Leaf:
    """One setting in the tree: its full name, what is said of it, and its value."""

    path: str
    said: Mapping[str, Any]
    value: Any


def _leaves(section: Any, above: str = "") -> Iterator[_Leaf]:
    for each in fields(section):
        value = getattr(section, each.name)
        if is_dataclass(value):
            yield from _leaves(value, f"{above}{each.name}.")
        else:
            yield _Leaf(above + each.name, each.metadata, value)


EXAMPLE = Settings(structures="workflow/structures.yaml")
"""The settings of the shipped example, whose structures stand beside its rules."""
