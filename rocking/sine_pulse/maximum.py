"""The exact largest rotation of an equivalent block under one full sine pulse, in every regime.

The block is followed flight by flight: closed form between impacts, one scalar root per impact. After the pulse the
energy (x − 1)² − x'² is conserved in each flight, so what is left is algebra. Nothing is assumed monotone, and a
rotation beyond φ_cr during the pulse is not overturning: the pulse may bring the block back.
"""

import math
from dataclasses import dataclass
from enum import StrEnum

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import kernel
from rocking.sine_pulse.ratios import Ratios, first_and_second
from rocking.structures.mechanism import EquivalentBlock
from rocking.structures.outcome import Outcome

_EQUAL = 1 + 1e-12
"""Of rotations that are equal to within this the first counts."""


class Regime(StrEnum):
    """How the block reaches its largest rotation."""

    NO_UPLIFT = "no uplift"
    PRINTED_EXACT = "Eq. 15 exact"
    AFTER_FIRST_IMPACT = "maximum after the first impact"
    CONTACT_DURING_PULSE = "contact during the pulse"
    BEFORE_FIRST_IMPACT = "maximum before the first impact"
    OVERTURNS_WITHOUT_IMPACT = "overturns without impact"
    OVERTURNS_AFTER_IMPACTS = "overturns after impacts"
    UNRESOLVED = "unresolved"

    @property
    def sentence(self) -> str:
        """One sentence for the reader."""
        return _SENTENCES[self]


_SENTENCES = {
    Regime.NO_UPLIFT: "The pulse never reaches the uplift acceleration, so the structure does not rock.",
    Regime.PRINTED_EXACT: "The structure stays off the ground until the pulse ends and is largest after its first "
    "impact, which is the one course of events for which Eq. 15 is exact.",
    Regime.AFTER_FIRST_IMPACT: "The structure stays off the ground until the pulse ends and is largest after an "
    "impact; Eq. 15 does not hold, because the two sides differ or the pulse's first half lifts nothing.",
    Regime.CONTACT_DURING_PULSE: "The structure touches the ground before the pulse ends, so Eq. 15 does not hold.",
    Regime.BEFORE_FIRST_IMPACT: "The largest rotation comes before the first impact, so Eq. 15 does not hold.",
    Regime.OVERTURNS_WITHOUT_IMPACT: "The structure overturns on the side it first rocks to, without any impact.",
    Regime.OVERTURNS_AFTER_IMPACTS: "The structure overturns after one or more impacts.",
    Regime.UNRESOLVED: f"More than {kernel.MOST_IMPACTS} impacts follow each other during the pulse without dying out, "
    "because the restitution is so close to 1; a restitution of at most 0.999 can be followed.",
}


@dataclass(frozen=True, repr=False)
class Maximum:
    """Largest rotation of an equivalent block under a pulse.

    rotation_ratio: largest φ/φ_cr over both sides, each with its own φ_cr; inf if it overturns, 0 without uplift, nan
    if unresolved. outcome: an Outcome, FAILED only where the regime is unresolved.
    impacts: how many impacts come before the largest rotation, or before it overturns; those of a chain that dies out
    are counted only until it is proved to die out. peak_side: +1 or −1, the side of the largest rotation or of the
    overturning; 0 without uplift. Of rotations that are equal to within 1e-12 the first counts.
    overturning_margin: smallest 1 − x − x' (x = φ/φ_cr, time p t) at the start of a flight after the pulse; 1 when it
    rests by then, negative when it overturns, −inf when it does so beyond recall during the pulse. 0 is the border.
    """

    rotation_ratio: float
    outcome: Outcome
    regime: Regime
    impacts: int = 0
    peak_side: int = 0
    overturning_margin: float = 1.0

    def __repr__(self) -> str:
        return f"Maximum({self.outcome.of(self.rotation_ratio)}, regime: {self.regime})"


def predict_maximum(equivalent_block: EquivalentBlock, pulse: Pulse) -> Maximum:
    """Return the exact largest rotation of `equivalent_block` under `pulse`, with the regime that it belongs to.

    Exact to rounding in every regime, times the sensitivity of the motion itself, which grows without bound at the
    borders of overturning and where a contact just grazes. A chain of ever smaller impacts during the pulse is at
    rest once it is proved to die out before the ground can lift the block again, or once its energy is below 1e-24 of
    what overturns. `rocking.predict_maxima` does the same for many.
    """
    first, second = first_and_second(equivalent_block, pulse)
    blocks = equivalent_block.sides[0], equivalent_block.sides[-1]
    if pulse.amplitude > 0:
        blocks = blocks[1], blocks[0]
    course = kernel.course(
        _side(first or second, blocks[0], first), _side(second or first, blocks[1], second)
    )
    one_shape = equivalent_block.other_side is None and first is not None
    return _maximum(course, blocks, 1 if pulse.amplitude < 0 else -1, one_shape)


def _side(ratios: Ratios | None, block: EquivalentBlock, own: Ratios | None) -> kernel.Side:
    """What the kernel takes of a side; of one that does not exist, the other's numbers."""
    assert ratios is not None
    return kernel.Side(
        ratios.frequency_ratio,
        ratios.amplitude_ratio,
        ratios.restitution,
        ratios.velocity_scale,
        block.end,
        own is not None,
    )


def _maximum(
    course: kernel.Course, blocks: tuple[EquivalentBlock, EquivalentBlock], first_side: int, one_shape: bool
) -> Maximum:
    """blocks: of the side that the pulse's first half lifts, and of the other. first_side: the sign of the former.

    one_shape: whether the pulse's first half lifts the block and what it lands on next is the same again, as Eq. 15
    takes for granted.
    """
    if course.unresolved:
        return Maximum(math.nan, Outcome.FAILED, Regime.UNRESOLVED, course.impacts, 0, math.nan)
    then = course.peak_impacts
    if max(then) < 0:
        return Maximum(0.0, Outcome.NO_UPLIFT, Regime.NO_UPLIFT)
    early = 0 if then[1] < 0 or 0 <= then[0] <= then[1] else 1
    late = 1 - early
    sizes = course.peaks
    if blocks[0] is not blocks[1]:
        sizes = blocks[0].rotation_ratio(sizes[0]), blocks[1].rotation_ratio(sizes[1])
    index = late if then[late] >= 0 and sizes[late] > sizes[early] * _EQUAL else early
    ratio = sizes[index] if blocks[0] is not blocks[1] else blocks[0].rotation_ratio(sizes[index])
    overturns = ratio == math.inf
    return Maximum(
        rotation_ratio=ratio,
        outcome=Outcome.OVERTURNS if overturns else Outcome.ROCKS,
        regime=_regime(overturns, then[index], course.contacts, one_shape),
        impacts=then[index],
        peak_side=first_side if index == 0 else -first_side,
        overturning_margin=course.margin,
    )


def _regime(overturns: bool, impacts: int, contacts: int, one_shape: bool) -> Regime:
    if overturns:
        return Regime.OVERTURNS_AFTER_IMPACTS if impacts else Regime.OVERTURNS_WITHOUT_IMPACT
    if contacts:
        return Regime.CONTACT_DURING_PULSE
    if not impacts:
        return Regime.BEFORE_FIRST_IMPACT
    return Regime.PRINTED_EXACT if one_shape else Regime.AFTER_FIRST_IMPACT
