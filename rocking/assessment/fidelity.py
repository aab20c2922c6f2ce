"""What must be computed to say whether a structure overturns under a record: the first of these that settles it.

1. Nothing: |ü_g| / (g + ü_v) never exceeds λ, so it stays at rest. Exact.
2. Peak velocity: from p PGV/(gλ) the structure overturns, or stands, with a probability whose 90 % interval lies within
   the risk (rocking.assessment.tiers). Of a structure unlike those of the calibration, and with vertical motion, it
   says nothing.
3. Block on record at five scales, where an ensemble would follow: likewise. It costs twice as much as the mechanism
   once, so it is left out where the mechanism is the last that is asked, but a fortieth of an ensemble.
4. Mechanism on record, which settles what happens as given.
5. The ensemble, where one is asked for: it settles what can be said with all that is not known.

The closed form takes no part: it settles hardly more than the peak velocity, and costs a search for the pulse.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from rocking.assessment import intensity
from rocking.assessment.intensity import NUDGES, Shape
from rocking.assessment.method import Method
from rocking.assessment.tiers import Expectation, Tier, TierFit, expect, shipped_tiers, unlike
from rocking.errors import StructureError
from rocking.motion.forcing import forcing_of
from rocking.motion.integration import integrate
from rocking.motion.members import Members, integrate_members
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.structures.outcome import Outcome

_GRID = np.linspace(-4.0, 4.0, 1601)
"""ln of p PGV/(gλ) among which the limits are sought."""


@dataclass(frozen=True)
class Answer:
    """What answered, with which largest rotation over the critical one, and why nothing dearer was asked.

    response: None without an integration. expectation: of a tier, where one answered.
    """

    method: Method
    rotation_ratio: float
    outcome: Outcome
    response: Response | None
    reason: str = ""
    expectation: Expectation | None = None


@dataclass(frozen=True, eq=False)
class Limits:
    """What the peak velocity settles for one mechanism at one risk.

    per_velocity: p/(gλ), s/m. stands, overturns: p PGV/(gλ) up to which it stands and from which it overturns; −inf and
    inf: never. expected: what the tier says, (n, 6), at each ln of p PGV/(gλ) of the grid.
    """

    per_velocity: float
    stands: float
    overturns: float
    expected: np.ndarray

    def settle(self, peak_velocity: float) -> Expectation | None:
        """What the tier says of a peak velocity [m/s] that settles the verdict, to the grid's step; None otherwise."""
        severity = self.per_velocity * peak_velocity
        if self.stands < severity < self.overturns:
            return None
        place = round((math.log(max(severity, 1e-9)) - _GRID[0]) / (_GRID[1] - _GRID[0]))
        return Expectation(Tier.PEAK_VELOCITY, *self.expected[min(max(place, 0), _GRID.size - 1)].tolist())


def stays_at_rest(
    mechanism: Mechanism, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> bool:
    """Whether the ground never reaches the uplift acceleration, whatever its phase with the vertical component."""
    return forcing_of(accelerogram, vertical).excitation <= mechanism.uplift_multiplier


def cheapest_answer(
    mechanism: Mechanism,
    shape: Shape,
    *,
    risk: float = 0.01,
    tolerance: float = 1e-6,
    vertical: Accelerogram | None = None,
    history: bool = False,
    ensemble_follows: bool = False,
    limits: Limits | None = None,
    fits: Mapping[Tier, TierFit] | None = None,
) -> Answer:
    """Return the first answer that settles whether `mechanism` overturns; the mechanism's own where nothing else does.

    shape: of the record. risk: largest probability of the opposite; 0: only what is exact. tolerance, history: of the
    integration. ensemble_follows: whether what is not settled costs an ensemble too. limits, fits: of other tiers than
    those that the package ships. Raises MotionError as `integrate` does.
    """
    record = shape.accelerogram
    if stays_at_rest(mechanism, record, vertical):
        still = Response(0.0, Outcome.NO_UPLIFT)
        reason = "the ground never reaches the uplift acceleration"
        return Answer(Method.NOTHING_TO_INTEGRATE, 0.0, Outcome.NO_UPLIFT, still, reason)
    if vertical is None and risk > 0:
        found = (limits or limits_of(mechanism, risk)).settle(shape.peak_velocity)
        if found is not None:
            return _settled(found, Method.PEAK_VELOCITY, "p PGV/(gλ)", risk)
        found = settled_by_block(mechanism, record, risk, fits) if ensemble_follows else None
        if found is not None:
            return _settled(found, Method.BLOCK_ON_RECORD, f"the block at {len(NUDGES)} scales", risk)
    whole = integrate(mechanism, record, tolerance, history=history, vertical=vertical)
    reason = f"{'the block' if ensemble_follows else 'the peak velocity'} does not settle it"
    return Answer(Method.MECHANISM_ON_RECORD, whole.rotation_ratio, whole.outcome, whole, reason)


def settled_by_block(
    mechanism: Mechanism,
    record: Accelerogram,
    risk: float,
    fits: Mapping[Tier, TierFit] | None = None,
) -> Expectation | None:
    """What the block under the record at NUDGES says where that settles the verdict; None otherwise."""
    try:
        block, own = mechanism.equivalent_block("rest"), intensity.of_structure(mechanism)
    except StructureError:
        return None
    if unlike(Tier.BLOCK_AT_FIVE_SCALES, own, fits):
        return None
    ratios = integrate_members(block, record, Members(NUDGES)).rotation_ratio
    found = expect(Tier.BLOCK_AT_FIVE_SCALES, own | intensity.from_nudged(ratios), fits)
    return found if found and (found.probability_high <= risk or found.probability_low >= 1 - risk) else None


def limits_of(mechanism: Mechanism, risk: float) -> Limits:
    """Return the limits of a mechanism, remembered as long as it lives."""
    known = _REMEMBERED.setdefault(mechanism, {})
    if risk not in known:
        known[risk] = find_limits(mechanism, risk, shipped_tiers())
    return known[risk]


_REMEMBERED: WeakKeyDictionary[Mechanism, dict[float, Limits]] = WeakKeyDictionary()
_NEVER = Limits(0.0, -math.inf, math.inf, np.empty((0, 6)))


def find_limits(mechanism: Mechanism, risk: float, fits: Mapping[Tier, TierFit]) -> Limits:
    """Return the limits that follow from the tiers; none for a structure unlike all behind them."""
    fit = fits[Tier.PEAK_VELOCITY]
    try:
        block, own = mechanism.equivalent_block("rest"), intensity.of_structure(mechanism)
    except StructureError:
        return _NEVER
    if fit.unlike(own):
        return _NEVER
    terms = np.array([[z, *(own[name] for name in fit.tier.terms[1:])] for z in _GRID])
    stands, overturns = fit.settled(terms, risk)
    most = _GRID[stands].max(initial=-math.inf) if stands[0] else -math.inf
    least = _GRID[overturns].min(initial=math.inf) if overturns[-1] else math.inf
    expected = np.column_stack([*fit.probabilities(terms), fit.rotations(terms)])
    return Limits(
        intensity.per_velocity(block),
        math.exp(most) if most > -math.inf else -math.inf,
        math.exp(least),
        expected,
    )


def _settled(found: Expectation, method: Method, by: str, risk: float) -> Answer:
    overturns = found.probability > 0.5
    ratio = math.inf if overturns else min(found.rotation_median, 1.0)
    outcome = Outcome.OVERTURNS if overturns else Outcome.ROCKS
    return Answer(method, ratio, outcome, None, f"{by} settles it at a risk of {100 * risk:g} %", found)
