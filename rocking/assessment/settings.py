"""The settings of an assessment, of a fragility, and of the design level with its checks."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import StrEnum
from pathlib import Path
from typing import Any, ClassVar, Literal

from rocking.assessment.intensity import INTENSITY_MEASURES, MEASURES_IN_WORDS
from rocking.described import check_described, described
from rocking.errors import ConfigurationError
from rocking.pulses import PULSE_METHODS, PulseSettings
from rocking.quantities import GRAVITY
from rocking.records.design_spectrum import SOILS, TOPOGRAPHIES, DesignSpectrum
from rocking.structures.equivalent_block import Scale


class Heading(StrEnum):
    """The headings of config.yaml, in their order; each setting says below which one it stands."""

    ABOUT = "Told on the first page of every report; each may stay blank"
    RECORDS = "Records and structures"
    PROCESSING = "Processing, told in every report"
    METHOD = "Method"
    ENSEMBLE = "Ensemble: the uncertain inputs of a case vary within these ranges"
    DESIGN = "Design level and the checks of the Italian code: snakemake checks"
    FRAGILITY = "Fragility from all records of the study: snakemake fragility"
    TRADE = "Trade of error for time: snakemake trade"
    OUTPUT = "Output"


SIZES = (16, 64, 256, 1024, 4096)
"""Numbers of points that a design may have; each is contained in the next."""


@dataclass(frozen=True)
class EnsembleSettings:
    """The ranges of the uncertain inputs, and the risk that a verdict bears. Raises ConfigurationError."""

    heading: ClassVar[Heading] = Heading.ENSEMBLE

    members: int = described(
        64, "number of members, rounded up to 16, 64, 256, 1024 or 4096; 0: no ensemble", ge=0, le=4096
    )
    amplitude_range: float = described(0.05, "uncertainty of the amplitude, ± this share", ge=0, le=0.9)
    restitution_range: float = described(
        0.05, "uncertainty of the restitution, ±, where a structure states none", ge=0, le=1
    )
    polarity: bool = described(True, "whether the sign of the motion varies, for unlike sides")
    processing: bool = described(True, "whether the processing of a raw record varies")
    risk: float = described(0.05, "largest probability of the outcome opposite to a verdict", gt=0, le=0.45)
    reserve: float = described(
        3.0, "largest factor on the record up to which the reserve is sought; 0: no reserve", ge=0, le=30
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)

    @property
    def size(self) -> int:
        """Members of the design that is used; 0 for none."""
        return next(size for size in (0, *SIZES) if size >= self.members)


@dataclass(frozen=True)
class PredictingPulse(PulseSettings):
    """The search for pulses, and the choice of the one that predicts."""

    choice: str = described(
        next(iter(PULSE_METHODS)),
        "pulse that predicts: energy (explains most of the record), demand (of the first five the one that turns the "
        "structure farthest) or velocity (sine of the velocity pulse)",
        one_of=lambda: tuple(PULSE_METHODS),
    )


@dataclass(frozen=True)
class AssessmentSettings:
    """The settings of every method. Raises ConfigurationError when a value is outside what is allowed.

    fidelity: auto stops at the first method that settles whether a structure overturns to fidelity_risk. contact
    follows as stacks of rigid courses what is undecided, has contacts that open, or tapers in courses.
    """

    acceleration_scale: Scale = described(
        "rest",
        "equivalent block: rest (exact as it lifts, in arc length), or linearised about the critical rotation "
        "with uplift (a_sc,alt), linearised (a_sc) or mean",
    )
    tolerance: float = described(
        1e-6, "tolerance of the integration, relative to the largest rotation", ge=1e-13, le=0.1
    )
    pulse: PredictingPulse = PredictingPulse()
    ensemble: EnsembleSettings = EnsembleSettings()
    friction_coefficient: float = described(0.6, "friction coefficient beyond which a contact slides", gt=0)
    fidelity: Literal["full", "auto", "contact"] = described(
        "full",
        "full runs every method, to compare them; auto runs what settles the verdict of a case, where no PDFs are "
        "made; contact is full, with contact dynamics of what stays undecided",
    )
    fidelity_risk: float = described(
        0.01, "largest probability of a wrong verdict with which fidelity: auto stops; 0: none", ge=0, le=0.2
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)


@dataclass(frozen=True)
class FragilitySettings:
    """The settings of a study's fragility. Raises ConfigurationError when a value is outside what is allowed."""

    intensity_measure: str = described(
        "pgv", f"measure of the levels: {MEASURES_IN_WORDS}", one_of=lambda: tuple(INTENSITY_MEASURES)
    )
    members: bool = described(True, "whether a case counts by the share of its members that overturn")
    largest_factor: float = described(
        10.0,
        "largest factor on a record; what cannot reach a level within it is left out of that level",
        ge=1,
        le=1e6,
    )
    hazard: str | None = described(
        None, "CSV of a hazard curve with the columns intensity and annual_rate, ascending, or null"
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)


@dataclass(frozen=True)
class DesignSettings:
    """The design level of a study and the checks at it. Raises ConfigurationError when a value is out of range.

    Without ag and without points there is none.
    """

    ag: float | None = described(
        None, "peak acceleration a_g on rock; null: no design level", "g", gt=0, le=3
    )
    f0: float | None = described(None, "amplification F0 of NTC 2018", gt=0, le=10)
    tc_star: float | None = described(None, "period T_C* of NTC 2018", "s", gt=0, le=3)
    soil: str = described(
        "A", "soil of NTC 2018, from A (rock) to B, C, D and E", one_of=lambda: tuple(SOILS)
    )
    topography: float = described(1.0, "topographic factor S_T", ge=TOPOGRAPHIES[0], le=TOPOGRAPHIES[1])
    points: str | None = described(
        None, "instead: CSV of the spectrum, period_s and acceleration_m_s2 or acceleration_g"
    )
    damping: float = described(0.05, "damping of the spectrum, share of the critical one", ge=0, le=0.5)
    limit_state: Literal["SLV", "SLC"] = described(
        "SLV", "limit state of the checks: SLV (life safety) or SLC (collapse)"
    )
    confidence_factor: float = described(
        1.35, "FC of the checks; 1.35, that of LC1, unless crushing decides", ge=1, le=2
    )
    behaviour_factor: float = described(2.0, "q of the linear check", ge=1, le=5)
    stations: int = described(20, "stations of a set", ge=1, le=1000)
    least_factor: float = described(0.25, "least factor on a record of a set", gt=0)
    largest_factor: float = described(4.0, "largest factor on a record of a set", gt=0)
    shortest_period: float = described(0.15, "from which on the mean spectrum of a set counts", "s", gt=0)
    longest_period: float = described(2.0, "up to which it counts", "s", gt=0, le=10)
    seed: int = described(0, "of the draw of the sets", ge=0)

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
        given = {"f0": self.f0, "tc_star_s": self.tc_star}
        if self.ag is not None and self.points is not None:
            raise ConfigurationError(
                f"points is {self.points!r} beside ag_g = {self.ag:g}, but one of the two must be null."
            )
        for name, value in given.items():
            if self.ag is not None and value is None:
                raise ConfigurationError(f"{name} is missing, but must be given with ag_g.")
            if self.ag is None and value is not None:
                raise ConfigurationError(f"ag_g is missing, but must be given with {name}.")
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

    @classmethod
    def told(cls, mapping: Mapping[str, Any]) -> "DesignSettings":
        """Return the settings that a mapping of all of a study's tells; without any the default."""
        own = mapping.get("design_spectrum") or {}
        names = {each.name for each in fields(cls)}
        return cls(**{name: value for name, value in own.items() if name in names})

    def spectrum(self) -> DesignSpectrum | None:
        """Return the spectrum; None where there is no design level. Raises ConfigurationError for its points."""
        if self.points is not None:
            return DesignSpectrum.read(Path(self.points), self.damping)
        if self.ag is None or self.f0 is None or self.tc_star is None:
            return None
        return DesignSpectrum.ntc(
            self.ag * GRAVITY, self.f0, self.tc_star, self.soil, self.topography, self.damping
        )
