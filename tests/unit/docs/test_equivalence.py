"""The measured equivalence against time integration and closed forms."""

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from docs.paper.equivalence import (
    block_overturning_time,
    block_period,
    natural_period,
    overturning_time,
    uplift_ratio,
)
from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.arch import Arch
from rocking.structures.block import Block, RigidBody
from rocking.structures.frame import Frame
from rocking.structures.mechanism import Mechanism
from rocking.structures.spire import Spire
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


@pytest.mark.parametrize("ratio", [1e-3, 0.3, 0.9, 0.999])
def test_period_of_the_block_against_arbitrary_precision(ratio):
    side = Block(1.7, 0.3).mechanism().positive
    with mpmath.workdps(30):
        alpha, amplitude = mpmath.mpf(0.3), mpmath.mpf(0.3) * mpmath.mpf(ratio)
        inertia = mpmath.mpf(4) / 3 * mpmath.mpf(1.7)

        def rate(u):
            phi = amplitude * (1 - u**2)
            energy = mpmath.cos(alpha - amplitude) - mpmath.cos(alpha - phi)
            return 2 * amplitude * u / mpmath.sqrt(2 * GRAVITY * energy / inertia) if u else mpmath.mpf(0)

        period = 4 * mpmath.quad(rate, [mpmath.mpf(10) ** -12, 0.1, 0.5, 1])
    assert natural_period(side, 0.3 * ratio) == pytest.approx(float(period), rel=1e-8)


def test_quadrature_of_the_linear_block_gives_its_closed_forms():
    """A side whose functions are linear already: every ratio is 1."""
    side = Block(2.0, 0.2).mechanism().positive
    linear = type(side)(
        inertia=lambda r: 2.0 + 0 * r,
        inertia_slope=lambda r: 0 * r,
        gravity=lambda r: 0.3 - r,
        gravity_slope=lambda r: -1 + 0 * r,
        ground=lambda r: 0.7 + 0 * r,
        critical_rotation=0.3,
        end_rotation=1.0,
        restitution=0.9,
    )
    assert uplift_ratio(linear) == pytest.approx(1.0, rel=1e-14)
    for ratio in (0.01, 0.5, 0.99):
        assert natural_period(linear, 0.3 * ratio) == pytest.approx(block_period(linear, ratio), rel=1e-8)
    for ratio in (1.001, 2.0, 50.0):
        for scale in ("linearised", "uplift", "mean"):
            expected = block_overturning_time(linear, ratio, scale)
            assert overturning_time(linear, ratio) == pytest.approx(expected, rel=1e-8)


def stiffening():
    """A side whose gravity moment first grows: 0.3 (1 + 8 x)(1 − x) with x = φ/φ_cr, under a constant B of 0.7.

    The push a gλ does more than gravity takes up to x if a > 1 + 7 x/2 − 8 x²/3, at most 2.1484375 at x = 21/32.
    """
    side = Block(2.0, 0.2).mechanism().positive
    return type(side)(
        inertia=lambda r: 2.0 + 0 * r,
        inertia_slope=lambda r: 0 * r,
        gravity=lambda r: 0.3 * (1 + 8 * r / 0.3) * (1 - r / 0.3),
        gravity_slope=lambda r: 7 - 16 * r / 0.3,
        ground=lambda r: 0.7 + 0 * r,
        critical_rotation=0.3,
        end_rotation=1.0,
        restitution=0.9,
    )


@pytest.mark.parametrize("share", [1e-1, 1e-4, 1e-8])
def test_a_push_that_gravity_outdoes_on_the_way_never_overturns(share):
    limit = 2.1484375
    assert overturning_time(stiffening(), limit * (1 - share)) == np.inf
    assert 0 < overturning_time(stiffening(), limit * (1 + share)) < np.inf


def test_a_push_that_just_outdoes_gravity_takes_the_time_of_the_integration():
    side = stiffening()
    time = time_until(side, 0.0, side.critical_rotation, -2.2 * side.uplift_multiplier * GRAVITY)
    assert overturning_time(side, 2.2) == pytest.approx(time, rel=1e-8)


def test_period_approaches_housners_quadratically_in_slenderness():
    """Housner 1963: T = (4/p) acosh(1/(1 − θ₀/α)) in the slender limit; the observed order of the error in α is 2."""
    sides = [Block(2.0, slenderness).mechanism().positive for slenderness in (0.2, 0.1, 0.05)]
    errors = [
        1 - block_period(side, 0.5) / natural_period(side, 0.5 * side.critical_rotation) for side in sides
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(orders, 2.0, atol=0.02)  # the next term is α⁴: an order error of about α²


def test_uplift_ratio_of_block_and_wall():
    assert uplift_ratio(Block(2.0, 0.25).mechanism().positive) == pytest.approx(
        0.25 / np.tan(0.25), rel=1e-14
    )
    wall = Wall(2.0, 2.0, 0.4).mechanism().positive
    assert uplift_ratio(wall) == pytest.approx(np.arctan(0.2) / 0.2, rel=1e-13)


def test_the_scales_of_the_arch_are_conservative_and_not():
    """a_sc overturns too early, a_sc,alt too late, the mean in between (section 3.2 and Fig. 7 of the paper)."""
    side = Arch(1.0, 0.15, np.pi).mechanism().positive
    for ratio in (1.2, 2.0, 5.0):
        times = (block_overturning_time(side, ratio, scale) for scale in ("linearised", "mean", "uplift"))
        early, between, late = times
        assert early < overturning_time(side, ratio) < late
        assert early < between < late


def test_times_near_their_limits():
    side = Wall(2.0, 2.0, 0.4).mechanism().positive
    assert block_overturning_time(side, 1 + 1e-9, "uplift") > overturning_time(side, 1.5)
    # λ_lin > λ never happens for a wall, so its linearised block lifts wherever the wall does
    assert np.isfinite(block_overturning_time(side, 1 + 1e-9))
    assert block_period(side, 1e-12) < 1e-4
    thick = Arch(1.0, 0.15, np.pi).mechanism().positive
    assert overturning_time(thick, 1 + 1e-6) < np.inf


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda side: natural_period(side, side.critical_rotation), "must lie between 0 and 1"),
        (lambda side: overturning_time(side, 1.0), "must exceed 1"),
        (lambda side: overturning_time(side, 0.5), "must lie between 1"),
        (lambda side: block_overturning_time(side, 2.0, "best"), "scale is 'best'"),
    ],
)
def test_values_out_of_range_are_refused(call, message):
    with pytest.raises(StructureError, match=message):
        call(Block(2.0, 0.2).mechanism().positive)
