"""The exact response of an equivalent block to a record: no time-stepping error, only event times are iterated."""

from collections.abc import Sequence

import numpy as np

from rocking.motion import linear_kernel as kernel
from rocking.motion.forcing import Forcing
from rocking.motion.nonlinear import concluded, initial_arc, logged_run, states, with_history
from rocking.motion.response import Response
from rocking.motion.table import linear_table
from rocking.quantities import GRAVITY
from rocking.structures.mechanism import EquivalentBlock

_LARGEST_GROWTH = 50.0
"""Largest p Δt for which exp(p Δt) leaves the exact update its digits."""


def solvable_exactly(block: EquivalentBlock, forcing: Forcing) -> bool:
    """Whether the closed form per sample holds: a sampled record, no vertical component, a sane p Δt."""
    frequency = max(each.frequency_parameter for each in block.sides)
    return (
        forcing.ground.circular_frequency == 0
        and not forcing.vertical
        and frequency * forcing.ground.time_step <= _LARGEST_GROWTH
    )


def follow_exactly(
    block: EquivalentBlock, forcing: Forcing, start: tuple[float, float, int], history: bool
) -> Response:
    """Follow the block through a record. start: rotation, rate outward, side (0: at rest)."""
    sides, state = block.sides, (0.0, 0.0, 0)
    if start[2]:
        own = sides[0 if start[2] > 0 else -1]
        arc, speed, sign = initial_arc(linear_table(block), *start)
        state = (arc / own.critical_arc, speed / own.velocity_scale, sign)
    peaks = np.empty((2, 2))
    (status, impacts, uplift, last_side, steps, _), log = logged_run(
        kernel.rock_linear,
        (
            blocks_of(block),
            samples_of(sides, forcing),
            forcing.factor,
            (sides[0].restitution, sides[-1].restitution),
            kernel.State(*state),
            False,
            peaks,
        ),
        forcing.samples if history else 0,
    )
    ratios = [sides[k].rotation_ratio(float(peaks[0, k])) for k in (0, -1)]
    response = concluded(status, ratios, peaks[1], impacts, uplift, last_side, steps, 0.0, 0.0)
    return with_history(response, *states(linear_table(block), log), 0.0) if history else response


def blocks_of(block: EquivalentBlock) -> kernel.Blocks:
    """What the kernel takes of a block."""
    sides = block.sides
    return kernel.Blocks(
        frequency=np.array([each.frequency_parameter for each in sides]),
        push=np.array([1 / (GRAVITY * each.uplift_multiplier) for each in sides]),
        span=np.array([each.critical_arc for each in sides]),
        one_sided=block.one_sided,
    )


def samples_of(sides: Sequence[EquivalentBlock], forcing: Forcing) -> kernel.Samples:
    """What the kernel takes of a record, for these sides of a block."""
    ground, time_step = forcing.ground.horizontal, forcing.ground.time_step
    takeable = np.empty((len(sides), 2, ground.size))
    for k, side in enumerate(sides):
        kernel.takeback(ground, time_step, side.frequency_parameter, 1, takeable[k, 0])
        kernel.takeback(ground, time_step, side.frequency_parameter, -1, takeable[k, 1])
    return kernel.Samples(ground, time_step, takeable)
