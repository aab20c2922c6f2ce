"""The settings of an assessment."""

from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar, Literal

from rocking.described import check_described, described
from rocking.errors import ConfigurationError
from rocking.pulses import PULSE_METHODS, PulseSettings
from rocking.structures.equivalent_block import Scale


class Heading(StrEnum):
    """The headings of config.yaml, in their order; each setting says below which one it stands."""

    ABOUT = "Printed on the first page of every report; each may stay blank"
    RECORDS = "Records and structures"
    PROCESSING = "Processing, stated in every report"
    METHOD = "Method"
    ENSEMBLE = "Ensemble: the uncertain inputs of a case vary within these ranges"
    DESIGN = "Design level, drawn with the spectra of the records"
    CHECKS = (
        "Checks of the Italian code at the design level, and the sets of records for them: rocking checks"
    )
    FRAGILITY = "Fragility from all records of the study: rocking fragility"
    TRADE = "Trade of error for time: rocking trade"
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
    polarity: bool = described(
        True, "whether the sign of the motion varies, where the two sides of a structure differ"
    )
    processing: bool = described(True, "whether the processing of a raw record varies")
    risk: float = described(0.05, "largest probability of the outcome opposite to a verdict", gt=0, le=0.45)
    reserve: float = described(
        3.0,
        "largest factor on the record up to which the reserve is searched for; 0: no reserve",
        ge=0,
        le=30,
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
        "pulse that predicts: energy (explains most of the record), demand (of the best five the one that rotates the "
        "structure most) or velocity (sine of the velocity pulse)",
        one_of=lambda: tuple(PULSE_METHODS),
    )


@dataclass(frozen=True)
class AssessmentSettings:
    """The settings of every method. Raises ConfigurationError when a value is outside what is allowed.

    fidelity: standard follows as 24 stacks of rigid courses what cannot be told else, as contacts open or courses may
    be thrown; contact as 64, and also walls that something holds and that turn far. quick follows no stacks, compares
    no methods, and lets an ensemble end after 16 members that all stay far from overturning.
    """

    acceleration_scale: Scale = described(
        "exact_at_rest",
        "equivalent block: exact_at_rest (as it lifts, in arc length), or linearised about the critical rotation "
        "with uplift (a_sc,alt), linearised (a_sc) or mean",
    )
    tolerance: float = described(
        1e-6, "tolerance of the integration, relative to the largest rotation", ge=1e-13, le=0.1
    )
    pulse: PredictingPulse = PredictingPulse()
    ensemble: EnsembleSettings = EnsembleSettings()
    fidelity: Literal["quick", "standard", "contact"] = described(
        "standard",
        "standard runs every method, to compare them, and contact dynamics where the verdict cannot be told otherwise "
        "(24 runs: at best probably stands); quick runs the mechanism alone, as far as the verdict needs it, where no "
        "PDFs are made; contact is standard with 64 runs, which may say stands, and also follows held walls that "
        "rotate far, and arches",
        formerly={"full": "standard", "auto": "quick"},
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
