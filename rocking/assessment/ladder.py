"""Ladder: the search for the reserve, over amplitudes at which the members of an ensemble are followed.

A run of a member at a factor depends on the product of that factor and the member's own amplitude, and on its other
causes. So every run counts for all factors whose range of amplitudes holds its product. Runs therefore lie on rungs of
a ladder of amplitudes, evenly spaced in their logarithm, from the one at which the structure lifts up to the limit; the
rung k has the other causes of the point k of a lattice, which goes on periodically. The share of the members that
overturn at a factor is the mean over the amplitudes of the ensemble there, each run representing those nearest to it.

Few rungs are followed first, then those next to the factors at which the share crosses 5, 50 and 95 %, and next to runs
that fall or stand where most do not: never by bisection. The curve is the rising one nearest to the shares (isotonic
regression over factors evenly spaced in their logarithm).
"""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rocking.assessment.ensemble import CAUSES, Situation, draw, followed_at
from rocking.assessment.motions import GroundMotions
from rocking.assessment.reserve import SHARES, Reserve
from rocking.assessment.settings import EnsembleSettings
from rocking.structures import Mechanism

RUNGS = 1024
"""Rungs within a factor of e: 102 within an amplitude of ± 5 %."""
LATTICE = 1024
"""Points of the lattice that the rungs take their other causes from, one after the other and again from the first."""
COARSE = 16
"""Every so many rungs are followed first, over the whole ladder: a structure may stand again where it fell before."""
LEAST_WIDTH = 0.03
"""The amplitudes that count for a factor reach at least so far to both sides, as a share of it, also where the ensemble
has but one amplitude."""
FACTORS = 0.02
"""Step, in the logarithm, of the factors at which the share is looked at."""
TOLERANCE = 1e-4
"""Tolerance of the integration, relative to the largest rotation: that of an outcome, far below a step of FACTORS."""
ROUNDS = 3
"""Rounds of each stage at the most: a crossing may move when more rungs are followed."""


class Stage(NamedTuple):
    """One stage of the search: the rungs that are followed in addition to those of the stages before.

    spacing: every so many of them. margin: how far beyond the amplitudes that count for a crossing, and around: how far
    from a run that falls below the median factor or stands above it, both in the logarithm of the amplitude. shares:
    the places in SHARES of those whose crossings count.
    """

    spacing: int
    margin: float
    around: float
    shares: tuple[int, ...] = (0, 1, 2)


STAGES = (Stage(8, 0.1, 0.2), Stage(2, 0.05, 0.0), Stage(1, 0.05, 0.0, shares=(2,)))
"""The high factor needs twice the rungs: there the share rises most slowly, and a few runs that stand move it."""


def reserve(
    mechanism: Mechanism,
    motions: GroundMotions,
    settings: EnsembleSettings | None = None,
    *,
    falls_beyond: float = math.inf,
    shift: np.ndarray | None = None,
) -> Reserve:
    """Return the reserve of one mechanism under `motions`, the vertical one scaled with the horizontal ones.

    settings: ranges of the causes, and the largest factor that is tried. falls_beyond: rotation ratio beyond which a
    member counts as fallen, as what bears on it has lost its seat. shift: (c,) in [0, 1), one for each of CAUSES,
    by which the points of the lattice are moved, for another sample of the same ensemble; none by default. A member
    that cannot be followed counts as one that overturns. Raises MotionError as `integrate` does.
    """
    settings = settings or EnsembleSettings()
    strongest = motions.excitation
    if not strongest > 0:  # still ground
        lowest = math.inf
    elif math.isfinite(strongest):
        lowest = mechanism.uplift_multiplier / strongest  # below which nothing lifts
    else:
        lowest = settings.reserve / 100
    if not lowest < settings.reserve:
        return Reserve(low=math.nan, median=math.nan, high=math.nan, limit=settings.reserve)
    moved = np.zeros(len(CAUSES)) if shift is None else shift
    ladder = _Ladder(mechanism, motions, settings, lowest, moved, falls_beyond)
    coarse = np.arange(ladder.falls.size) % COARSE == 0
    coarse[-1] = True
    ladder.follow(coarse)
    for stage in STAGES:
        for _ in range(ROUNDS):
            if not ladder.follow(ladder.worth_following(stage)):
                break
    low, median, high = ladder.crossings()
    return Reserve(low=low, median=median, high=high, limit=settings.reserve)


class _Ladder:
    """The runs from which a reserve is read.

    amplitudes: (n,) ascending factors on the motion. falls: (n,) whether the run of a rung overturns, 1 or 0; nan where
    it was not followed.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        motions: GroundMotions,
        settings: EnsembleSettings,
        lowest: float,
        shift: np.ndarray,
        falls_beyond: float = math.inf,
    ) -> None:
        self.mechanism = mechanism
        self.motions = motions
        self.lowest = lowest
        self.falls_beyond = falls_beyond
        self.width = max(settings.amplitude_range, LEAST_WIDTH)
        highest = settings.reserve * (1 + self.width)
        rungs = np.arange(math.ceil(RUNGS * math.log(highest / lowest)) + 1)
        self.logs = math.log(lowest) + (rungs + shift[0]) / RUNGS
        self.amplitudes = np.exp(self.logs)
        self.falls = np.full(rungs.size, np.nan)

        generator = np.array([cause.generator % LATTICE for cause in CAUSES])
        points = (rungs[:, None] * generator % LATTICE / LATTICE + 0.5 / LATTICE + shift) % 1.0
        drawn = draw(Situation.of(mechanism, motions, settings), points)
        self.values = replace(drawn, amplitude=self.amplitudes)

        first = math.log(lowest / (1 + self.width))
        last = math.log(settings.reserve)
        self.log_factors = np.append(np.arange(first, last, FACTORS), last)

    def follow(self, wanted: np.ndarray) -> bool:
        """Follow the rungs that are wanted (n,) and were not followed yet; return whether there were any."""
        places = np.flatnonzero(wanted & np.isnan(self.falls))
        if not places.size:
            return False
        values = self.values.of_members(places)
        followed = followed_at(self.mechanism, self.motions, values, np.ones(1), tolerance=TOLERANCE)
        ratios = followed.rotation_ratios[0]
        self.falls[places] = np.isinf(ratios) | np.isnan(ratios) | (ratios > self.falls_beyond)
        return True

    def worth_following(self, stage: Stage) -> np.ndarray:
        """Return which rungs (n,) a stage needs."""
        wanted = np.zeros(self.falls.size, dtype=bool)
        crossings = self.crossings()
        for crossing in (crossings[place] for place in stage.shares):
            if not math.isnan(crossing):
                first = math.log(crossing * (1 - self.width)) - stage.margin
                last = math.log(crossing * (1 + self.width)) + stage.margin
                wanted |= (self.logs > first) & (self.logs < last)
        if stage.around:
            median = crossings[1]
            above = np.zeros(self.falls.size, dtype=bool) if math.isnan(median) else self.amplitudes > median
            unlike = np.where(above, self.falls == 0, self.falls == 1)
            for place in np.flatnonzero(unlike):
                wanted |= np.abs(self.logs - self.logs[place]) < stage.around
        asked: np.ndarray = wanted & (np.arange(self.falls.size) % stage.spacing == 0)
        return asked

    def crossings(self) -> list[float]:
        """Return the factors at which the rising curve nearest to the shares reaches SHARES; nan where it does not."""
        from scipy.optimize import (
            isotonic_regression,  # takes half a second, and is needed here only
        )

        followed = np.flatnonzero(np.isfinite(self.falls))
        between = (self.logs[followed][1:] + self.logs[followed][:-1]) / 2
        edges = np.exp([math.log(self.lowest), *between, self.logs[followed[-1]]])
        # The amplitudes up to each edge at which it overturns: those within a range are a difference of two.
        overturning = np.append(0.0, np.cumsum(self.falls[followed] * np.diff(edges)))
        factors = np.exp(self.log_factors)
        low, high = (
            np.interp(factors * side, edges, overturning) for side in (1 - self.width, 1 + self.width)
        )
        rising = isotonic_regression((high - low) / (2 * self.width * factors)).x
        crossings = []
        for share in SHARES:
            above = int(np.searchsorted(rising, share - 1e-9))  # but for rounding
            if above == rising.size:
                crossings.append(math.nan)
            elif above == 0:
                crossings.append(math.exp(self.log_factors[0]))
            else:
                below = self.log_factors[above - 1]
                part = (share - rising[above - 1]) / (rising[above] - rising[above - 1])
                crossings.append(math.exp(below + part * (self.log_factors[above] - below)))
        return crossings
