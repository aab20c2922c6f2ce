"""TradeSettings: how much is tried where error is measured against time."""

from dataclasses import dataclass, field

from rocking.assessment.settings import AssessmentSettings
from rocking.errors import ConfigurationError
from rocking.quantities import check_settings, setting


@dataclass(frozen=True)
class TradeSettings:
    """How much is tried with scipy; all else is tried on whole records.

    Raises ConfigurationError when a value is outside what is allowed.
    """

    cases: int = setting(6, "records times structures that are also given to scipy", ge=1, le=10_000)
    samples: int = setting(
        300, "of the strongest stretch of each record, which scipy is given", ge=10, le=100_000
    )
    budget_s: float = setting(60.0, "processor time that scipy may take for one case", "s", ge=1, le=1e6)
    assessment: AssessmentSettings = field(default_factory=AssessmentSettings)

    def __post_init__(self) -> None:
        check_settings(ConfigurationError, self)
