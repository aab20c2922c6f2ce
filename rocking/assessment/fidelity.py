"""The cheapest method that the evidence supports for one structure under one record, by a rule that is written down.

The first that applies answers:

1. Nothing to integrate: |ü_g| / (g + ü_v) never exceeds λ. Exact.
2. Closed form: the light is not red, and the equivalent block overturns under the dominant pulse with an overturning
   margin of at most −`closed_form_margin`. It answers "overturns", which cannot err on the unsafe side. No rotation
   is ever taken from it: of those that it predicts for real records under a green light, 29 % lie within 20 % of the
   mechanism's and 43 % lie lower.
3. Block on record, once the known error of the equivalent block is at most `known_error`: it overturns, or it turns
   no further than `rotation_ratio`, with a sensitivity d ln φ_max / d ln a of at most `sensitivity` either way and a
   verdict that survives ± `NUDGE` of the ground motion. A motion that is sensitive to its amplitude is as sensitive to
   what distinguishes the block from the mechanism.
4. Mechanism on record.

The band from the interval of the pulse takes no part: it costs more than the integration that it would spare.
Nothing was calibrated with vertical ground motion, so with it only 1 and 4 apply.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rocking.assessment.method import Method
from rocking.motion.forcing import forcing_of
from rocking.motion.integration import integrate
from rocking.motion.response import Response
from rocking.pulses import Light
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.sine_pulse import Maximum
from rocking.structures import EquivalentBlock, Mechanism
from rocking.structures.outcome import Outcome
from rocking.tables import Row, column, read_rows, row

NUDGE = 0.03
"""Relative change of the ground motion that the verdict of a rocking block must survive."""


LADDER = (Method.NOTHING_TO_INTEGRATE, Method.CLOSED_FORM, Method.BLOCK_ON_RECORD, Method.MECHANISM_ON_RECORD)
"""What may answer, from the cheapest to the dearest."""


@row("fidelity", "One row per tolerance and risk: how far the cheap methods are trusted")
class Limits(Row):
    """How far the cheap methods are trusted, for one tolerance and one risk, and what that rests on."""

    tolerance: float = column("Relative error of the rotation that counts as right")
    risk: float = column("Largest share of unsafe answers")
    closed_form_margin: float = column(
        "Least overturning margin, negated, at which the closed form may say overturns; INF: never"
    )
    known_error: float = column("Largest known error of an equivalent block that may answer; 0: none may")
    rotation_ratio: float = column(
        "Largest rotation over critical rotation that a block may answer; 0: overturning only"
    )
    sensitivity: float = column("Largest magnitude of its d ln(largest rotation) / d ln(ground acceleration)")
    answers: int = column(
        "Answers of the closed form and the block on the half of the sites that the limits were chosen on"
    )
    right: float = column("Share of them that were right")
    unsafe: float = column("Share of them that were unsafe")


LIMITS = tuple(read_rows(Limits, Path(__file__).with_suffix(".csv")))
"""Made by `snakemake calibrate_fidelity` from the real records of records/near_fault.csv."""


@dataclass(frozen=True)
class Answer:
    """What answered, and its largest rotation over the critical one; response is None for the closed form."""

    method: Method
    rotation_ratio: float
    outcome: Outcome
    response: Response | None

    @property
    def integrated(self) -> Method:
        """The integration that `response` stands for: of a structure at rest, that of the mechanism."""
        return self.method if self.method is Method.BLOCK_ON_RECORD else Method.MECHANISM_ON_RECORD


def limits_for(tolerance: float, risk: float, table: Sequence[Limits] = LIMITS) -> Limits | None:
    """Return the limits calibrated for the largest tolerance and risk that do not exceed those asked for, or None."""
    rows = [row for row in table if row.tolerance <= tolerance and row.risk <= risk]
    return max(rows, key=lambda row: (row.tolerance, row.risk), default=None)


def known_error(mechanism: Mechanism, block: EquivalentBlock) -> float:
    """Return how far `block` misses `mechanism` as it lifts: the largest |ln| of two ratios, over the sides.

    The restoring acceleration at rest, g G(0)/I(0) over the block's, and the uplift multiplier of one over the other's.
    The rotation of a structure that turns little and soon is wrong by about as much. A block exact at rest misses by
    its two defects instead.
    """
    if block.rotation_map is not None:
        defects = mechanism.block_defects
        return max(defects.restoring, abs(math.log1p(defects.forcing)))
    misses = []
    for side, each in zip(mechanism.sides, block.sides, strict=True):
        restoring = GRAVITY * side.at("gravity", 0.0) / side.at("inertia", 0.0)
        misses.append(abs(math.log(restoring / (each.frequency_parameter**2 * each.critical_rotation))))
        misses.append(abs(math.log(each.uplift_multiplier / side.uplift_multiplier)))
    return max(misses)


def stays_at_rest(
    mechanism: Mechanism, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> bool:
    """Whether the ground never reaches the uplift acceleration, whatever its phase with the vertical component."""
    return forcing_of(accelerogram, vertical).excitation <= mechanism.uplift_multiplier


def closed_form_stands(light: Light, margin: float, limits: Limits) -> bool:
    """Whether step 2 applies. margin: Maximum.overturning_margin, negative where the block overturns."""
    return light is not Light.RED and margin < 0 and margin <= -limits.closed_form_margin


def block_stands(rotation_ratio: float, sensitivity: float, fragile: bool, limits: Limits) -> bool:
    """Whether step 3 applies to a block whose known error does."""
    if math.isinf(rotation_ratio):
        return True
    rocks = 0 < rotation_ratio <= limits.rotation_ratio
    return rocks and not fragile and abs(sensitivity) <= limits.sensitivity


def cheapest_answer(
    mechanism: Mechanism,
    block: EquivalentBlock,
    accelerogram: Accelerogram,
    closed_form: tuple[Light, Maximum] | None,
    limits: Limits | None,
    *,
    integration_tolerance: float = 1e-6,
    fragility_change: float = 0.01,
    vertical: Accelerogram | None = None,
) -> Answer:
    """Return the answer of the cheapest method that `limits` trust; of the mechanism where they trust none.

    closed_form: light and exact maximum of `block` under the dominant pulse, None without a pulse. limits: None trusts
    nothing but rest. The response of the mechanism carries its history, its sensitivity, and whether `fragility_change`
    of the ground motion flips its verdict; so does that of a block that rocks, with the larger of it and `NUDGE`.
    """
    if stays_at_rest(mechanism, accelerogram, vertical):
        return Answer(Method.NOTHING_TO_INTEGRATE, 0.0, Outcome.NO_UPLIFT, Response(0.0, Outcome.NO_UPLIFT))
    if limits is not None and vertical is None:
        nudge = max(fragility_change, NUDGE)
        cheap = _cheap_answer(mechanism, block, accelerogram, closed_form, limits, nudge)
        if cheap is not None:
            return cheap
    whole = integrate(
        mechanism,
        accelerogram,
        integration_tolerance,
        history=True,
        vertical=vertical,
        sensitivity=True,
        fragility_change=fragility_change,
    )
    return Answer(Method.MECHANISM_ON_RECORD, whole.rotation_ratio, whole.outcome, whole)


def _cheap_answer(
    mechanism: Mechanism,
    block: EquivalentBlock,
    accelerogram: Accelerogram,
    closed_form: tuple[Light, Maximum] | None,
    limits: Limits,
    nudge: float,
) -> Answer | None:
    if closed_form is not None:
        light, maximum = closed_form
        if closed_form_stands(light, maximum.overturning_margin, limits):
            return Answer(Method.CLOSED_FORM, math.inf, Outcome.OVERTURNS, None)
    if known_error(mechanism, block) > limits.known_error:
        return None
    found = integrate(block, accelerogram)
    if 0 < found.rotation_ratio <= limits.rotation_ratio:
        found = integrate(block, accelerogram, sensitivity=True, fragility_change=nudge)
    if not block_stands(found.rotation_ratio, found.sensitivity, found.fragile is not False, limits):
        return None
    return Answer(Method.BLOCK_ON_RECORD, found.rotation_ratio, found.outcome, found)
