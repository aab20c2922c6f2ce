"""The reserve: by how much a record may be stronger before a structure falls under it.

There is no first factor at which a structure falls: most stand again at a somewhat larger one, so that it would move
with the step of the search. The share of the members of an ensemble that overturn is smooth, and the reserve is the
factors on the record at which it reaches 5, 50 and 95 %.

Factors are tried at levels, never by bisection: the first at which any member lifts, and then each STEP times the one
before. Few members meet few levels up to the limit, and all of them the levels next to where the share crosses 5, 50
and 95 %. The curve is the rising one nearest to the shares (isotonic regression, each level with the same weight).
"""

import math

import numpy as np

from rocking.assessment.causes import Situation, draw, lattice
from rocking.assessment.ensemble import followed_at
from rocking.assessment.ground_motions import GroundMotions
from rocking.assessment.reserve import Reserve
from rocking.assessment.settings import EnsembleSettings
from rocking.motion.forcing import forcing_of
from rocking.structures import Mechanism

STEP = 1.06
"""Factor between two levels."""
COARSE = 5
"""Levels from one to the next that few members meet: 1.06⁵ = 1.34."""
FEW = 16
"""Members that meet the coarse levels."""
MEMBERS = 64
"""Members that meet the levels next to a crossing."""
SHARES = (0.05, 0.5, 0.95)
"""Shares of the members that overturn at the low, the median and the high factor."""
NEXT = (3, 2, 4)
"""Levels that all members meet next to each of these crossings. The curve is flattest at its ends, where few members
decide, and at the high end those that stand again have to be seen above the crossing too."""
TOLERANCE = 1e-4
"""Tolerance of the integration, relative to the largest rotation: that of an outcome, far below a STEP."""
ROUNDS = 3
"""Rounds of refinement at the most: a crossing may move when all members are asked."""


def reserve(
    mechanism: Mechanism,
    motions: GroundMotions,
    settings: EnsembleSettings | None = None,
    *,
    points: np.ndarray | None = None,
) -> Reserve:
    """Return the reserve of one mechanism under `motions`, the vertical one scaled with the horizontal ones.

    settings: ranges of the causes, and the largest factor that is tried. points: of the members, MEMBERS by default. A
    member that cannot be followed counts as one that overturns. Raises MotionError as `integrate` does.
    """
    settings = settings or EnsembleSettings()
    search = _Search(mechanism, motions, settings, lattice(MEMBERS) if points is None else points)
    if not search.levels.size:
        return Reserve(math.nan, math.nan, math.nan, settings.reserve)
    search.try_coarse_levels()
    for _ in range(ROUNDS):
        if not search.refine():
            break
    low, median, high = search.crossings()
    return Reserve(low, median, high, settings.reserve)


class _Search:
    """The state of the search for a reserve.

    levels: (k,) ascending factors. falls: (k, m) whether a member overturns at a level; nan where that was not tried.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        motions: GroundMotions,
        settings: EnsembleSettings,
        points: np.ndarray,
    ) -> None:
        self.mechanism = mechanism
        self.motions = motions
        self.values = draw(Situation.of(mechanism, motions, settings), points)
        self.levels = _levels(mechanism, motions, settings, self.values["amplitude"])
        self.falls = np.full((self.levels.size, len(points)), np.nan)

    def try_at(self, places: list[int], members: slice) -> None:
        """Follow `members` at the levels at `places`."""
        values = {name: each[members] for name, each in self.values.items()}
        ratios = followed_at(
            self.mechanism, self.motions, values, self.levels[places], tolerance=TOLERANCE
        ).rotation_ratios
        self.falls[places, members] = np.isinf(ratios) | np.isnan(ratios)

    def try_coarse_levels(self) -> None:
        """Follow few members at every COARSE level up to the limit: they may stand again where all fell before."""
        last = self.levels.size - 1
        self.try_at([*range(0, last, COARSE), last], slice(0, FEW))

    def refine(self) -> bool:
        """Follow all members at the levels next to each crossing; return whether there were any left to follow."""
        logs = np.log(self.levels)
        open_levels = set()
        for crossing, count in zip(self.crossings(), NEXT, strict=True):
            if not math.isnan(crossing):
                nearest = np.argsort(np.abs(logs - math.log(crossing)), kind="stable")
                open_levels |= set(nearest[:count].tolist())
        places = sorted(place for place in open_levels if np.isnan(self.falls[place]).any())
        if places:
            self.try_at(places, slice(None))
        return bool(places)

    def crossings(self) -> list[float]:
        """Return the factors at which the rising curve nearest to the shares reaches SHARES; nan where it does not."""
        from scipy.optimize import (
            isotonic_regression,  # half a second, which who asks for no reserve would pay
        )

        logs = np.log(self.levels)
        tried = np.isfinite(self.falls).any(axis=1)
        # Between levels that were tried the share is interpolated, so that each level has the same weight.
        shares = np.interp(logs, logs[tried], np.nanmean(self.falls[tried], axis=1))
        rising = isotonic_regression(shares).x
        return [_crossing(logs, rising, share) for share in SHARES]


def _levels(
    mechanism: Mechanism, motions: GroundMotions, settings: EnsembleSettings, amplitude: np.ndarray
) -> np.ndarray:
    """The levels, from the lowest factor at which any member lifts up to the limit of the settings; the limit last."""
    excitations = [forcing_of(motion, motions.vertical).excitation for motion in motions.horizontal.values()]
    strongest = max(excitations) * float(amplitude.max())
    if not strongest > 0:
        return np.array([])
    lowest = mechanism.uplift_multiplier / strongest if math.isfinite(strongest) else settings.reserve / 100
    if not lowest < settings.reserve:
        return np.array([])
    count = math.ceil(math.log(settings.reserve / lowest) / math.log(STEP))
    return np.append(lowest * STEP ** np.arange(count), settings.reserve)


def _crossing(logs: np.ndarray, rising: np.ndarray, share: float) -> float:
    """The level at which a curve that rises at `logs` reaches `share`, linear in between; nan where it does not."""
    above = int(np.searchsorted(rising, share - 1e-9))  # but for rounding
    if above == rising.size:
        return math.nan
    if above == 0:
        return math.exp(logs[0])
    rise = rising[above] - rising[above - 1]
    part = (share - rising[above - 1]) / rise
    return math.exp(logs[above - 1] + part * (logs[above] - logs[above - 1]))
