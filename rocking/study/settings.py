"""The settings of a study: those of each part of the package, and what is the study's own.

Each says its type, unit, bounds and meaning where it is declared. rocking.study.config_file reads them from a file, and
writes the JSON schema and the shipped config.yaml from them.
"""

from dataclasses import asdict, dataclass
from typing import Any, Literal

from rocking.assessment.settings import AssessmentSettings, FragilitySettings
from rocking.described import check_described, described
from rocking.errors import ConfigurationError
from rocking.records.processing import Processing


@dataclass(frozen=True)
class StudyProcessing(Processing):
    """Which records are processed, and how."""

    apply: Literal["raw", "always", "never"] = described(
        "raw", "raw: records whose file says they are uncorrected; always: all; never: none"
    )


@dataclass(frozen=True)
class StudyFragility(FragilitySettings):
    """What fragility is measured with, and when."""

    in_every_run: bool = described(False, "measure it in every run")


@dataclass(frozen=True)
class StudyTrade:
    """When error is measured against time."""

    in_summary: bool = described(False, "measure it in every run, and draw it in summary.pdf")

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)


@dataclass(frozen=True)
class Settings(AssessmentSettings):
    """What a study is made with; the names and their units are the keys of config.yaml."""

    catalogue: str = described("records/catalogue.csv", "which accelerograms, one row each")
    structures: str = described("structures.yaml", "which structures, SI units and degrees")
    results: str = described("results", "folder of the results")
    mirror: str | None = described(None, "folder that already holds the files of remote records")
    processing: StudyProcessing = StudyProcessing(pre_event=1.0, baseline="linear", taper=0.02, high_pass=0.1)
    vertical: bool = described(False, "let the vertical component act too, where a record has one")
    candidates: int = described(
        11, "heights tried for the hinge of a wall or the crack of a spire; 0: none", ge=0, le=1000
    )
    processing_variants: bool = described(
        True, "also meet the record with other baselines and corner frequencies"
    )
    fragility: StudyFragility = StudyFragility()
    trade: StudyTrade = StudyTrade()
    reports: bool = described(True, "PDF reports; the tables are written either way")
    histories: bool = described(
        False, "rotation histories of every response too, as histories.csv of each record"
    )
    records_per_job: int | None = described(
        None, "about; null: the square root of their number, an eighth of it from 64, 200 from 1600", ge=1
    )

    def numbers(self) -> dict[str, Any]:
        """The settings that change a number of a table."""
        return {name: value for name, value in self.mapping().items() if name not in _NO_NUMBER}

    def mapping(self) -> dict[str, Any]:
        """All settings by their names."""
        return asdict(self)


_NO_NUMBER = {"catalogue", "structures", "results", "mirror", "fragility", "trade", "reports"}
_NO_NUMBER |= {"histories", "records_per_job"}

EXAMPLE = Settings(structures="workflow/structures.yaml")
"""The settings of the shipped example, whose structures stand beside its rules."""
