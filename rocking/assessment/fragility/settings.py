"""FragilitySettings: what the fragility of a study is measured with."""

from dataclasses import dataclass

from rocking.assessment.intensity import INTENSITY_MEASURES, MEASURES_IN_WORDS
from rocking.described import check_described, described
from rocking.errors import ConfigurationError


@dataclass(frozen=True)
class FragilitySettings:
    """What fragility is measured with. Raises ConfigurationError when a value is outside what is allowed."""

    intensity_measure: str = described(
        "pgv",
        f"of the levels: {MEASURES_IN_WORDS}",
        one_of=lambda: tuple(INTENSITY_MEASURES),
    )
    members: bool = described(
        True, "whether each case is an ensemble, with the ranges above, instead of itself"
    )
    hazard: str | None = described(
        None, "CSV of a hazard curve with the columns intensity and annual_rate, ascending, or null"
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
