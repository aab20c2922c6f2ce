"""Reserve: the factor by which a record may be stronger before a structure overturns.

There is no first factor at which a structure falls: most stand again at a somewhat larger one, so that it would move
with the step of the search. The share of the members of an ensemble that overturn is smooth, and the reserve is the
factors on the record at which it reaches 5, 50 and 95 %, or that of the runs of contact dynamics does (`falls.py`). It
is computed for a structure on the ground, and on a support at the worst of its periods.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from rocking.assessment.settings import EnsembleSettings
from rocking.structures import Mechanism

if TYPE_CHECKING:
    from rocking.assessment.motions import GroundMotions

SHARES = (0.05, 0.5, 0.95)
"""Shares of the members that overturn at the low, the median and the high factor."""
RUNGS = 1024
"""Rungs of the ladder of amplitudes within a factor of e, which are also the points of the lattice that the rungs take
their other causes from, one after the other and again from the first: 102 within an amplitude of ± 5 %."""
ROUNDS = 3
"""Rounds of each stage of the search at the most: a crossing may move when more rungs are followed."""


class Stage(NamedTuple):
    """One stage of the search, never by bisection: the rungs that are followed in addition to those before.

    spacing: every so many of them. margin: how far beyond the amplitudes that count for a crossing, and around: how far
    from a run that falls below the median factor or stands above it, both in the logarithm of the amplitude. shares:
    the places in SHARES of those whose crossings count.
    """

    spacing: int
    margin: float
    around: float = 0.0
    shares: tuple[int, ...] = (0, 1, 2)


SEARCH = (Stage(16, math.inf), Stage(8, 0.1, 0.2), Stage(2, 0.05), Stage(1, 0.05, shares=(2,)))
"""First the whole ladder, as a structure may stand again where it fell before. The high factor needs twice the rungs:
there the share rises most slowly, and a few runs that stand move it."""
LEAST_WIDTH = 0.03
"""The amplitudes that count for a factor reach at least so far to both sides, as a share of it, also where the ensemble
has but one amplitude."""
FACTORS = 0.02
"""Step, in the logarithm, of the factors at which the share is looked at."""
TOLERANCE = 1e-4
"""Tolerance of the integration, relative to the largest rotation: that of an outcome, far below a step of FACTORS."""


@dataclass(frozen=True, kw_only=True)
class Reserve:
    """The factors on a record at which 5, 50 and 95 % fall, of the members or of the runs of contact dynamics.

    nan where fewer overturn at every factor up to the `limit`.

    Parameters
    ----------
    low : float
        Factor at which 5 % of the members overturn.
    median : float
        Factor at which half of them do.
    high : float
        Factor at which 95 % of them do.
    limit : float
        Largest factor that was tried.

    Examples
    --------
    >>> print(rocking.Reserve(low=0.8, median=1.1, high=np.nan, limit=3.0))
    5 % of members fall at 0.8 ×, half at 1.1 × this record, fewer than 95 % up to 3 ×
    >>> print(rocking.Reserve(low=np.nan, median=np.nan, high=np.nan, limit=3.0))
    fewer than 5 % of members fall up to 3 × this record
    """

    low: float
    median: float
    high: float
    limit: float

    def held_to(self, share: float) -> "Reserve":
        """Return the reserve that does not contradict the `share` of members that overturn under the record itself.

        A share that is reached there has a factor of 1 at most, another one of 1 at least: the factors come of a curve
        through members of many records, which need not pass through that share. nan: it is not known.
        """
        if math.isnan(share):
            return self
        # Of a factor beyond the limit, which is nan, fmin gives 1 and maximum nan.
        low, median, high = (
            float(np.fmin(factor, 1.0) if share >= reached else np.maximum(factor, 1.0))
            for reached, factor in zip(SHARES, (self.low, self.median, self.high), strict=True)
        )
        return Reserve(low=low, median=median, high=high, limit=self.limit)

    @property
    def in_figures(self) -> str:
        """The factors at which 5 % and half of the members overturn: "0.28–0.54", "2.5–3+" or "3+"."""
        beyond = f"{self.limit:g}+"
        low, median = (
            beyond if math.isnan(factor) else f"{factor:.0f}" if factor >= 10 else f"{factor:#.2g}"
            for factor in (self.low, self.median)
        )
        return low if low == median else f"{low}–{median}"

    def __str__(self) -> str:
        if math.isnan(self.low):
            return f"fewer than 5 % of members fall up to {self.limit:g} × this record"
        words = f"5 % of members fall at {self.low:.2g} ×"
        if math.isnan(self.median):
            return f"{words}, fewer than half up to {self.limit:g} × this record"
        words = f"{words}, half at {self.median:.2g} × this record"
        if math.isnan(self.high):
            return f"{words}, fewer than 95 % up to {self.limit:g} ×"
        return f"{words}, 95 % at {self.high:.2g} ×"


def reserve_of_members(
    mechanism: Mechanism,
    motions: "GroundMotions",
    settings: EnsembleSettings | None = None,
    *,
    falls_beyond: float = math.inf,
    shift: np.ndarray | None = None,
) -> Reserve:
    """Return the reserve of one mechanism under `motions`, the vertical one scaled with the horizontal ones.

    A run of a member at a factor depends on the product of that factor and the member's own amplitude, and on its other
    causes. So runs lie on a ladder of amplitudes, evenly spaced in their logarithm, from the one at which the structure
    lifts up to the limit, and each counts for all factors whose range of amplitudes holds it.

    settings: ranges of the causes, and the largest factor that is tried. falls_beyond: rotation ratio beyond which a
    member counts as fallen, as what bears on it has lost its seat. shift: (c,) in [0, 1), one for each of CAUSES,
    by which the points of the lattice are moved, for another sample of the same ensemble; none by default. A member
    that cannot be followed counts as one that overturns. Raises MotionError as `integrate` does.
    """
    from rocking.assessment.ensemble import (
        CAUSES,
        Situation,
        draw,
        followed_at,
    )  # which compile; a table has no need

    settings = settings or EnsembleSettings()
    lowest = motions.lift_at(mechanism.uplift_multiplier)  # below which nothing lifts
    if not lowest < settings.reserve:
        return Reserve(low=math.nan, median=math.nan, high=math.nan, limit=settings.reserve)
    moved = np.zeros(len(CAUSES)) if shift is None else shift
    width = max(settings.amplitude_range, LEAST_WIDTH)
    rungs = np.arange(math.ceil(RUNGS * math.log(settings.reserve * (1 + width) / lowest)) + 1)
    logs = math.log(lowest) + (rungs + moved[0]) / RUNGS
    generator = np.array([cause.generator % RUNGS for cause in CAUSES])
    points = (rungs[:, None] * generator % RUNGS / RUNGS + 0.5 / RUNGS + moved) % 1.0
    values = replace(draw(Situation.of(mechanism, motions, settings), points), amplitude=np.exp(logs))
    last = math.log(settings.reserve)
    log_factors = np.append(np.arange(math.log(lowest / (1 + width)), last, FACTORS), last)

    falls = np.full(rungs.size, np.nan)
    crossings = [math.nan] * len(SHARES)
    for stage in (stage for stage in SEARCH for _ in range(ROUNDS)):
        wanted = _worth_following(stage, logs, falls, crossings, width)
        places = np.flatnonzero(wanted & np.isnan(falls))
        if places.size:
            members = values.of_members(places)
            (ratios,) = followed_at(
                mechanism, motions, members, np.ones(1), tolerance=TOLERANCE
            ).rotation_ratios
            falls[places] = np.isnan(ratios) | np.isinf(ratios) | (ratios > falls_beyond)
            crossings = _crossings(logs, falls, math.log(lowest), width, log_factors)
    low, median, high = crossings
    return Reserve(low=low, median=median, high=high, limit=settings.reserve)


def _worth_following(
    stage: Stage, logs: np.ndarray, falls: np.ndarray, crossings: Sequence[float], width: float
) -> np.ndarray:
    """Which rungs (n,) a stage needs; see `_crossings` for the others."""
    of_stage = np.arange(logs.size) % stage.spacing == 0
    if math.isinf(stage.margin):
        of_stage[-1] = True
        return np.asarray(of_stage)
    wanted = np.zeros(logs.size, dtype=bool)
    for crossing in (crossings[place] for place in stage.shares):
        # Those next to a crossing that is not reached are none.
        first, last = (
            math.log(crossing * (1 - width)) - stage.margin,
            math.log(crossing * (1 + width)) + stage.margin,
        )
        wanted |= (logs > first) & (logs < last)
    median = crossings[1]
    above = logs > (math.inf if math.isnan(median) else math.log(median))
    for place in np.flatnonzero(np.where(above, falls == 0, falls == 1)):
        wanted |= np.abs(logs - logs[place]) < stage.around
    return np.asarray(wanted & of_stage)


def _crossings(
    logs: np.ndarray, falls: np.ndarray, lowest: float, width: float, log_factors: np.ndarray
) -> list[float]:
    """The factors at which the rising curve nearest to the shares reaches SHARES; nan where it does not.

    logs: (n,) of the amplitudes. falls: (n,) whether the run of each overturns, 1 or 0; nan where it was not followed.
    lowest: of the logarithms at which any falls. width: of the amplitudes that count for a factor, to both sides.
    """
    followed = np.flatnonzero(np.isfinite(falls))
    between = (logs[followed][1:] + logs[followed][:-1]) / 2
    edges = np.exp([lowest, *between, logs[followed[-1]]])
    # The amplitudes up to each edge at which it overturns: those within a range are a difference of two.
    overturning = np.append(0.0, np.cumsum(falls[followed] * np.diff(edges)))
    factors = np.exp(log_factors)
    low, high = (np.interp(factors * side, edges, overturning) for side in (1 - width, 1 + width))
    rising = rising_curve((high - low) / (2 * width * factors), np.ones(factors.size))
    crossings = []
    for share in SHARES:
        above = int(np.searchsorted(rising, share - 1e-9))  # but for rounding
        if above == rising.size:
            crossings.append(math.nan)
        elif above == 0:
            crossings.append(math.exp(log_factors[0]))
        else:
            below = log_factors[above - 1]
            part = (share - rising[above - 1]) / (rising[above] - rising[above - 1])
            crossings.append(math.exp(below + part * (log_factors[above] - below)))
    return crossings


def rising_curve(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Return the curve (n,) that never falls and is nearest to `values` (n,) in squares weighted by `weights` (n,).

    By pooling adjacent violators (Barlow et al. 1972), as scipy.optimize.isotonic_regression, whose import takes longer
    than the rest of the reserve.
    """
    pools: list[tuple[float, float, int]] = []  # the mean, the weight and the number of values of each
    for value, weight in zip(values, weights, strict=True):
        mean, total, number = value, weight, 1
        while pools and pools[-1][0] >= mean:
            mean_before, weight_before, number_before = pools.pop()
            mean = (mean_before * weight_before + mean * total) / (weight_before + total)
            total += weight_before
            number += number_before
        pools.append((mean, total, number))
    means, _, numbers = zip(*pools, strict=True)
    return np.repeat(means, numbers)
