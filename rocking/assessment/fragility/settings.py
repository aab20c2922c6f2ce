"""FragilitySettings: what the fragility of a study is measured with."""

from dataclasses import dataclass

from rocking.assessment.fragility.intensity import INTENSITY_MEASURES
from rocking.described import check_described, described
from rocking.errors import ConfigurationError

FEWEST_RUNS = 20
"""Of a multi-fidelity sample; with fewer the scatter of its corrections says nothing."""


@dataclass(frozen=True)
class FragilitySettings:
    """What fragility is measured with. Raises ConfigurationError when a value is outside what is allowed."""

    intensity_measure: str = described(
        "pgv",
        "of the levels: pga [g], pgv [m/s], p_pgv (p·PGV/(gλ)), pulse (its amplitude over gλ) or sa1 [g]",
        one_of=lambda: tuple(INTENSITY_MEASURES),
    )
    members: bool = described(
        True, "whether each case is an ensemble, with the ranges above, instead of itself"
    )
    mechanism_runs: int | None = described(
        None,
        "multi-fidelity: runs of each structure's mechanism, drawn where its block is in doubt; null: every case",
        ge=FEWEST_RUNS,
    )
    hazard: str | None = described(
        None, "CSV of a hazard curve with the columns intensity and annual_rate, ascending, or null"
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)
