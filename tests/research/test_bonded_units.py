"""Units in three dimensions: a block overturns as Housner's does, a wall stands up to the load of limit analysis."""

import numpy as np
import pytest
from bonded import BondedWall

from docs.research.bonded_units import BondedUnits, follow_units

pytestmark = pytest.mark.slow  # it compiles a kernel of its own

G = 9.80665
DENSITY = 18e3 / G


def housner(acceleration, step, height, breadth):
    """Whether a rigid block overturns: its full equation, with the balance of angular momentum at an impact."""
    radius, alpha = np.hypot(height, breadth) / 2, np.arctan2(breadth, height)
    kept = 1 - 1.5 * np.sin(alpha) ** 2
    angle = rate = side = 0.0
    fine = 2e-4
    for ground in np.interp(
        np.arange(0, 6, fine), step * np.arange(len(acceleration)), acceleration, right=0.0
    ):
        if side == 0:
            if abs(ground) <= G * np.tan(alpha):
                continue
            side = -np.sign(ground)
        lever = alpha * side - angle
        rate -= fine * 0.75 / radius * (G * np.sin(lever) + ground * np.cos(lever))
        angle += fine * rate
        if angle * side < 0 and rate * side < 0:
            side, rate = -side, rate * kept
        if abs(angle) > np.pi / 2:
            return True
    return False


def least(overturns, low, high):
    for _ in range(8):
        middle = (low + high) / 2
        low, high = (low, middle) if overturns(middle) else (middle, high)
    return high


@pytest.mark.parametrize("period", [0.5, 0.8])
def test_one_unit_overturns_where_the_block_of_housner_does(period):
    times = np.arange(0, period + 0.01, 0.005)
    sine = G * 0.2 * np.sin(2 * np.pi * times / period) * (times < period)
    block = BondedUnits(1.0, 2.0, 0.4, (1.0, 2.0), DENSITY, friction=5.0, stiffness=2e10)
    expected = least(lambda factor: housner(factor * sine, 0.005, 2.0, 0.4), 1.0, 5.0)
    found = least(lambda factor: follow_units(block, factor * sine, 0.005).falls, 1.0, 5.0)
    assert found == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize(
    ("length", "ties", "lowest"),
    [(6.0, (), 0.95), (3.0, (0.0, 3.0), 0.8), (6.0, (1.5, 4.5), 0.8)],
)
def test_a_wall_stands_up_to_the_load_of_limit_analysis(length, ties, lowest):
    """Limit analysis, whose friction dilates, is from above: by nothing without ties, by 11 % with them."""
    limit = BondedWall(length, 3.2, 0.4, (1.0, 0.4), 18.0, 5.0, ties).multiplier()
    wall = BondedUnits(
        length,
        3.2,
        0.4,
        (1.0, 0.4),
        DENSITY,
        load=5e3,
        rides=False,
        ties=tuple((along, 3.2) for along in ties),
        tie_stiffness=6e7,
    )
    slowly = np.minimum(np.arange(0, 5, 0.01) / 1.5, 1.0)
    pushed = [follow_units(wall, -share * limit * G * slowly, 0.01).falls for share in (lowest, 1.03)]
    assert pushed == [False, True]


def test_cross_walls_hold_a_wall_inwards_and_not_outwards():
    pulse = -0.8 * G * np.sin(np.pi * np.arange(0, 1.01, 0.01) / 0.2) * (np.arange(0, 1.01, 0.01) < 0.2)
    leans = BondedUnits(2.0, 2.0, 0.4, (1.0, 2.0), DENSITY, behind="cross_walls", restitution=0.5)
    free = BondedUnits(2.0, 2.0, 0.4, (1.0, 2.0), DENSITY)
    assert follow_units(leans, pulse, 0.01).farthest == pytest.approx(
        follow_units(free, pulse, 0.01).farthest, rel=0.2
    )
    assert follow_units(leans, -pulse, 0.01).farthest < 0.5 * follow_units(leans, pulse, 0.01).farthest
