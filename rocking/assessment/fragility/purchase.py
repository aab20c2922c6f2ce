"""Which runs to buy for an interval of the median: of the mechanism alone, or of it and its block."""

import math
from dataclasses import dataclass

from rocking.assessment.fragility.multifidelity import MultiFidelityAnalysis
from rocking.assessment.fragility.settings import FEWEST_RUNS
from rocking.errors import ConfigurationError

_A_STATION = 2
"""Least runs for each: with fewer, single corrections of large weight make an interval far too wide now and then."""


@dataclass(frozen=True)
class Purchase:
    """method: scaling, in fewer stations, or multi-fidelity. stations: that are followed. cpu: processor time, s."""

    method: str
    stations: int
    mechanism_runs: int
    cpu: float

    def __str__(self) -> str:
        return (
            f"{self.method}: {self.mechanism_runs} runs of the mechanism under {self.stations} stations, "
            f"{self.cpu:.2g} s of processor time"
        )


def purchases(pilot: MultiFidelityAnalysis, interval_ratio: float) -> tuple[Purchase, ...]:
    """Return what gives an interval of the median whose end is `interval_ratio` times its beginning, cheapest first.

    pilot: a multi-fidelity analysis with few runs. What the records leave open is taken from the block, which was
    followed in every case; the squared width beyond it falls with the runs, so that one pilot tells it for any number.
    Both widths scatter from pilot to pilot. Raises ConfigurationError for a ratio up to 1, or one that the records do
    not allow, and says how many stations would.
    """
    if not interval_ratio > 1:
        raise ConfigurationError(f"interval_ratio is {interval_ratio!r}, but must be greater than 1.")
    wanted = math.log(interval_ratio)
    of_records, found = (_width(each.fragility().interval) for each in (pilot.block, pilot))
    stations, cases = len(set(pilot.block.stations)), pilot.rotation_ratios.size
    share = (of_records / wanted) ** 2
    if share >= 1:
        raise ConfigurationError(
            f"interval_ratio is {interval_ratio:g}, but {stations} stations allow no less than "
            f"{math.exp(of_records):.3g}; give about {math.ceil(stations * share)} stations or ask for more."
        )
    each = pilot.mechanism_seconds / pilot.mechanism_runs
    some = max(2, math.ceil(stations * share))
    fewer = Purchase("scaling", some, round(cases * some / stations), cases * some / stations * each)
    sampled = pilot.mechanism_runs * max(found**2 - of_records**2, 0.0) / (wanted**2 - of_records**2)
    runs = max(FEWEST_RUNS, _A_STATION * stations, math.ceil(sampled))
    if runs >= cases:
        return (fewer,)
    few = Purchase("multi-fidelity", stations, runs, pilot.block_seconds + runs * each)
    return tuple(sorted((fewer, few), key=lambda bought: bought.cpu))


def _width(interval: tuple[float, float]) -> float:
    return math.log(interval[1] / interval[0])
