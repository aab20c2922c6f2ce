"""The anchored block under one sine, beside what Makris & Zhang say of it in words.

"While for most of the frequency range, anchored blocks survive higher accelerations than free-standing blocks, there
is a short frequency range where the opposite happens" (PEER Report 1999/06, abstract; figures could not be read). The
block is held at each corner, which rises by u = 4 b sin(θ/2) as it rocks about the other, by a restrainer that breaks
at 0.4 of its weight after an elastic stretch of 2 mm.
"""

import numpy as np

from rocking.motion import Members, integrate_members
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.structures import Block, Mechanism, Side
from rocking.structures.mechanism import SideTie, Tie

HALF_BREADTH, HALF_HEIGHT = 0.2, 0.6
FREE = Block.of_size(2 * HALF_BREADTH, 2 * HALF_HEIGHT).mechanism()


def anchored(strength: float, stretch: float) -> Mechanism:
    """strength: over the weight. The block's G is that of a weight of 1 at the semi-diagonal, divided by it."""
    unit, side = np.hypot(HALF_BREADTH, HALF_HEIGHT), FREE.positive
    tie = SideTie(
        Tie(stiffness=strength / stretch / unit, pretension=0.0, strength=strength / unit),
        lambda phi: 4 * HALF_BREADTH * np.sin(phi / 2),
        lambda phi: 2 * HALF_BREADTH * np.cos(phi / 2),
    )

    def on_the_way_out(phi):
        return side.gravity(phi) + tie.moment(phi, phi)

    return Mechanism(
        Side(
            inertia=side.inertia, inertia_slope=side.inertia_slope, gravity=on_the_way_out,
            gravity_slope=side.gravity_slope, ground=side.ground, critical_rotation=side.critical_rotation,
            end_rotation=side.end_rotation, restitution=side.restitution, ties=(tie,), untied_gravity=side.gravity,
        )
    )  # fmt: skip


def least_overturning(mechanism: Mechanism, frequency: float) -> float:
    """Over gλ, to one part in a hundred."""
    scales = np.geomspace(1, 15, 270)
    pulse = Pulse(amplitude=GRAVITY * FREE.uplift_multiplier, circular_frequency=frequency)
    ratios = integrate_members(mechanism, pulse, Members(scales)).rotation_ratio
    return float(scales[np.argmax(np.isinf(ratios))]) if np.isinf(ratios).any() else np.inf


def test_anchors_help_at_most_frequencies_and_harm_in_a_short_range():
    frequencies = FREE.positive.frequency_parameter * np.linspace(1.5, 8, 27)
    held = anchored(0.4, 0.002)
    free = np.array([least_overturning(FREE, frequency) for frequency in frequencies])
    tied = np.array([least_overturning(held, frequency) for frequency in frequencies])
    helps, harms = tied > 1.005 * free, tied < 0.995 * free
    assert helps.sum() > 0.5 * frequencies.size
    assert 0 < harms.sum() <= helps.sum() / 2
