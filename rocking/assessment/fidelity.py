"""What must be computed to say whether a structure overturns under a record: the first of these that settles it.

1. Nothing: |ü_g| / (g + ü_v) never exceeds λ, so it stays at rest. Exact.
2. Peak velocity: from p PGV/(gλ) the structure stands, where the estimate's 90 % interval lies within the risk
   (rocking.assessment.tiers). Of a structure unlike those of the calibration, and with vertical motion, it says
   nothing.
3. Block on record at five scales, where an ensemble would follow: whether it stands or overturns, likewise. It costs
   twice as much as the mechanism once, but a fortieth of an ensemble.
4. Mechanism on record, which settles what happens as given.
5. The ensemble, where one is asked for, which ends after 16 members that all stay far from overturning.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from rocking.assessment import intensity
from rocking.assessment.intensity import NUDGES
from rocking.assessment.method import Method
from rocking.assessment.tiers import Estimate, Tier, TierFit, shipped_tiers
from rocking.errors import StructureError
from rocking.motion.forcing import forcing_of
from rocking.motion.integration import integrate
from rocking.motion.members import Members, integrate_members
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Mechanism, Outcome


@dataclass(frozen=True)
class Answer:
    """What answered, with which largest rotation over the critical one, and why nothing dearer was asked.

    rotation_ratio: nan where a tier says that it stands. response: None without an integration. estimate: of a tier,
    where one answered.
    """

    method: Method
    rotation_ratio: float
    outcome: Outcome
    response: Response | None
    reason: str = ""
    estimate: Estimate | None = None


def stays_at_rest(
    mechanism: Mechanism, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> bool:
    """Whether the ground never reaches the uplift acceleration, whatever its phase with the vertical component."""
    return forcing_of(accelerogram, vertical).excitation <= mechanism.uplift_multiplier


def cheapest_answer(
    mechanism: Mechanism,
    record: Accelerogram,
    *,
    risk: float = 0.01,
    tolerance: float = 1e-6,
    vertical: Accelerogram | None = None,
    history: bool = False,
    ensemble_follows: bool = False,
    fits: Mapping[Tier, TierFit] | None = None,
) -> Answer:
    """Return the first answer that settles whether `mechanism` overturns; the mechanism's own where nothing else does.

    risk: largest probability of the opposite; 0: only what is exact. tolerance, history: of the integration.
    ensemble_follows: whether what is not settled costs an ensemble too. fits: other tiers than those that the package
    ships. Raises MotionError as `integrate` does.
    """
    if stays_at_rest(mechanism, record, vertical):
        still = Response(0.0, Outcome.NO_UPLIFT)
        reason = "the ground never reaches the uplift acceleration"
        return Answer(Method.NOTHING_TO_INTEGRATE, 0.0, Outcome.NO_UPLIFT, still, reason)
    if vertical is None and risk > 0:
        fits = fits or shipped_tiers()
        estimate = estimate_from_velocity(mechanism, record, fits)
        if estimate is not None and estimate.high <= risk:
            return _settled(estimate, Method.PEAK_VELOCITY, "p PGV/(gλ)", risk)
        estimate = _from_block(mechanism, record, fits) if ensemble_follows else None
        if estimate is not None and (estimate.high <= risk or estimate.low >= 1 - risk):
            return _settled(estimate, Method.BLOCK_ON_RECORD, f"the block at {len(NUDGES)} scales", risk)
    whole = integrate(mechanism, record, tolerance, history=history, vertical=vertical)
    reason = f"{'the block' if ensemble_follows else 'the peak velocity'} does not settle it"
    return Answer(Method.MECHANISM_ON_RECORD, whole.rotation_ratio, whole.outcome, whole, reason)


def estimate_from_velocity(
    mechanism: Mechanism, record: Accelerogram, fits: Mapping[Tier, TierFit] | None = None
) -> Estimate | None:
    """Return the share that overturns, from p PGV/(gλ); None of a structure unlike those of the calibration."""
    try:
        own, block = intensity.of_structure(mechanism), mechanism.equivalent_block("rest")
    except StructureError:
        return None
    return (fits or shipped_tiers())[Tier.PEAK_VELOCITY].estimate(own | intensity.of_velocity(record, block))


def _from_block(mechanism: Mechanism, record: Accelerogram, fits: Mapping[Tier, TierFit]) -> Estimate | None:
    """What the block under the record at NUDGES says; None of a structure unlike those of the calibration."""
    fit = fits[Tier.BLOCK_AT_FIVE_SCALES]
    try:
        own, block = intensity.of_structure(mechanism), mechanism.equivalent_block("rest")
    except StructureError:
        return None
    if fit.unlike(own):
        return None
    ratios = integrate_members(block, record, Members(NUDGES)).rotation_ratio
    return fit.estimate(own | intensity.from_nudged(ratios))


def _settled(estimate: Estimate, method: Method, by: str, risk: float) -> Answer:
    overturns = estimate.share > 0.5
    outcome = Outcome.OVERTURNS if overturns else Outcome.ROCKS
    reason = f"{by} settles it at a risk of {100 * risk:g} %"
    return Answer(method, math.inf if overturns else math.nan, outcome, None, reason, estimate)
