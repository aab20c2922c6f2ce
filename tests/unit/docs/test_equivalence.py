"""The measured equivalence against time integration and closed forms."""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from docs.paper.equivalence import block_overturning_time, natural_period, overturning_time
from rocking.quantities import GRAVITY
from rocking.structures.arch import Arch
from rocking.structures.block import Block, RigidBody, Spire
from rocking.structures.frame import Frame
from rocking.structures.mechanism import Mechanism
from rocking.structures.wall import Wall

STRUCTURES = {
    "block": Block(2.0, 0.25),
    "wall": Wall(1.5, 2.5, 0.4),
    "arch": Arch(5.0, 1.0, np.radians(165)),
    "rigid body": RigidBody(0.3, 0.5, 2.0, 1.4),
    "spire": Spire(3.0, 12.0, 0.3),
    "frame": Frame(Block(3.0, 0.15), 3, 0.5),
}


def time_until(side, start, stop, acceleration):
    """Time to travel from rest at rotation `start` to `stop` under a constant ü_g, by event-located integration."""
    mechanism = Mechanism(side)

    def rate(_, state):
        return [state[1], float(mechanism.angular_acceleration(max(state[0], 0.0), state[1], acceleration))]

    def arrived(_, state):
        return state[0] - stop

    arrived.terminal = True
    solution = solve_ivp(rate, (0, 100), [start, 0.0], "DOP853", events=arrived, rtol=1e-12, atol=1e-14)
    return solution.t_events[0][0]


@pytest.mark.parametrize("name", STRUCTURES)
def test_period_and_overturning_time_by_time_integration(name):
    """The quadratures promise 1e-8; the integration is good for 1e-10 where the motion starts from a finite force."""
    for side in STRUCTURES[name].mechanism().sides:
        amplitude = 0.6 * side.critical_rotation
        period = 4 * time_until(side, amplitude, 0.0, 0.0)
        assert natural_period(side, amplitude) == pytest.approx(period, rel=1e-8)
        push = -1.4 * side.uplift_multiplier * GRAVITY
        time = time_until(side, 0.0, side.critical_rotation, push)
        assert overturning_time(side, 1.4) == pytest.approx(time, rel=1e-8)


def test_a_push_that_gravity_outdoes_on_the_way_never_overturns():
    """G first grows: 0.3 (1 + 8 x)(1 − x) with x = φ/φ_cr, under a constant I of 2 and B of 0.7.

    The push a gλ does more than gravity takes up to x if a > 1 + 7 x/2 − 8 x²/3, at most 2.1484375 at x = 21/32.
    """
    side = dataclasses.replace(
        Block(2.0, 0.2).mechanism().positive,
        inertia=lambda r: 2.0 + 0 * r,
        inertia_slope=lambda r: 0 * r,
        gravity=lambda r: 0.3 * (1 + 8 * r / 0.3) * (1 - r / 0.3),
        gravity_slope=lambda r: 7 - 16 * r / 0.3,
        ground=lambda r: 0.7 + 0 * r,
        critical_rotation=0.3,
        end_rotation=1.0,
    )
    limit = 2.1484375
    for share in (1e-1, 1e-4, 1e-8):
        assert overturning_time(side, limit * (1 - share)) == np.inf
        assert 0 < overturning_time(side, limit * (1 + share)) < np.inf
    time = time_until(side, 0.0, side.critical_rotation, -2.2 * side.uplift_multiplier * GRAVITY)
    assert overturning_time(side, 2.2) == pytest.approx(time, rel=1e-8)


def test_the_scales_of_the_arch_are_conservative_and_not():
    """a_sc overturns too early, a_sc,alt too late, the mean in between (section 3.2 and Fig. 7 of the paper)."""
    side = Arch(1.0, 0.15, np.pi).mechanism().positive
    for ratio in (1.2, 2.0, 5.0):
        early, between, late = (
            block_overturning_time(side, ratio, scale) for scale in ("linearised", "mean", "uplift")
        )
        assert early < overturning_time(side, ratio) < late
        assert early < between < late
