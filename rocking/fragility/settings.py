"""The settings of the fragility of a study."""

from dataclasses import dataclass

from rocking.described import check_described, described
from rocking.errors import ConfigurationError
from rocking.fragility.measures import INTENSITY_MEASURES, MEASURES_IN_WORDS


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
