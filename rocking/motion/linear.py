"""The exact response of an equivalent block to a record: no time-stepping error, only event times are iterated."""

import numpy as np

from rocking.motion import kernel
from rocking.motion.forcing import Forcing
from rocking.motion.nonlinear import concluded, logged_run, with_history
from rocking.motion.response import Response
from rocking.quantities import GRAVITY
from rocking.structures.mechanism import EquivalentBlock

_LARGEST_GROWTH = 50.0
"""Largest p Δt for which exp(p Δt) leaves the exact update its digits."""


def solvable_exactly(block: EquivalentBlock, forcing: Forcing) -> bool:
    """Whether the closed form per sample holds: a sampled record, no vertical component, a sane p Δt."""
    frequency = max(each.frequency_parameter for each in _sides(block))
    return (
        forcing.frequency == 0 and not forcing.vertical and frequency * forcing.time_step <= _LARGEST_GROWTH
    )


def follow_exactly(
    block: EquivalentBlock, forcing: Forcing, start: tuple[float, float, int], history: bool
) -> Response:
    """Follow the block through a record. start: rotation, rate outward, side (0: at rest)."""
    sides = _sides(block)
    frequency = np.array([each.frequency_parameter for each in sides])
    push = np.array([each.acceleration_scale / (GRAVITY * each.critical_rotation) for each in sides])
    span = np.array([each.critical_rotation for each in sides])
    restitution = np.array([each.restitution for each in sides])
    takeable = np.empty((2, forcing.ground.size))
    kernel.takeback(forcing.ground, forcing.time_step, frequency[0], 1, takeable[0])
    kernel.takeback(forcing.ground, forcing.time_step, frequency[-1], -1, takeable[1])
    rotation, velocity, sign = start
    own = 0 if sign > 0 else -1
    state = (rotation / span[own], velocity / (span[own] * frequency[own]), sign)
    ground, ones = forcing.ground, np.ones(forcing.ground.size)
    found, log = logged_run(
        kernel.rock_linear,
        (
            frequency,
            push,
            span,
            restitution,
            block.one_sided,
            ground,
            ones,
            takeable,
            forcing.time_step,
            *state,
        ),
        forcing.ground.size if history else 0,
    )
    status, best, when, impacts, uplift, last_side, steps, _ = found
    response = concluded(status, best.tolist(), when, impacts, uplift, last_side, steps, 0.0, 0.0)
    return with_history(response, log[:, 0], log[:, 1], log[:, 2], 0.0) if history else response


def _sides(block: EquivalentBlock) -> tuple[EquivalentBlock, ...]:
    return (block,) if block.other_side is None else (block, block.other_side)
