"""AssessmentSettings: what a comparison of prediction and integration is made with."""

from dataclasses import dataclass, field
from typing import Literal

from rocking.assessment.ensemble import EnsembleSettings
from rocking.errors import ConfigurationError
from rocking.pulses import DEFAULT_PULSE_METHOD, PULSE_METHODS, PulseSettings
from rocking.quantities import check_settings, setting
from rocking.structures.mechanism import Scale

"""From which order statistics are an interval at all."""


@dataclass(frozen=True)
class AssessmentSettings:
    """What a comparison is made with. Raises ConfigurationError when a value is outside what is allowed.

    fidelity: auto stops at the first method that settles whether a structure overturns to fidelity_risk.
    """

    acceleration_scale: Scale = setting(
        "rest",
        "of the equivalent block: rest (exact as it lifts, in arc length), or linearised about the critical rotation "
        "with uplift (a_sc,alt), linearised (a_sc) or mean",
    )
    tolerance: float = setting(
        1e-6, "of the nonlinear integration, relative to the critical rotation", ge=1e-13, le=0.1
    )
    pulse: PulseSettings = field(default_factory=PulseSettings)
    ensemble: EnsembleSettings = field(default_factory=EnsembleSettings)
    friction_coefficient: float = setting(0.6, "beyond which a contact is said to slide", gt=0)
    pulse_choice: str = setting(
        DEFAULT_PULSE_METHOD,
        "pulse that predicts: energy (explains most of the record), demand (of the first five the one that turns the "
        "structure farthest) or velocity (sine of the velocity pulse)",
        one_of=tuple(PULSE_METHODS),
    )
    fidelity: Literal["full", "auto"] = setting(
        "full",
        "full: every method, to compare them; auto: per case what settles the verdict, where no PDF reports are made",
    )
    fidelity_risk: float = setting(
        0.01, "for auto: largest probability of a wrong verdict with which it stops; 0: none", ge=0, le=0.2
    )

    def __post_init__(self) -> None:
        check_settings(ConfigurationError, self)
