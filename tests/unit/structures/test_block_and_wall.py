"""Block and wall against their closed forms."""

import numpy as np
import pytest

from rocking.errors import StructureWarning
from rocking.quantities import GRAVITY
from rocking.structures.block import Block
from rocking.structures.wall import Wall

WALLS = [(2.0, 2.0, 0.3), (1.0, 3.0, 0.3), (3.0, 1.0, 0.3), (0.7, 4.0, 0.3)]


@pytest.mark.parametrize("slenderness", [0.05, 0.2, 0.5])
def test_block_is_housners(slenderness):
    mechanism = Block(2.0, slenderness).mechanism()
    side = mechanism.positive
    assert mechanism.uplift_multiplier == pytest.approx(np.tan(slenderness), rel=1e-14)
    assert mechanism.critical_rotation == slenderness
    assert side.frequency_parameter == pytest.approx(np.sqrt(3 * GRAVITY / 8), rel=1e-14)
    assert side.acceleration_scale == pytest.approx(1.0, rel=1e-14)
    assert mechanism.restitution == pytest.approx(1 - 1.5 * np.sin(slenderness) ** 2, rel=1e-14)


@pytest.mark.parametrize("h1, h2, thickness", WALLS)
def test_wall_has_the_closed_form_parameters(h1, h2, thickness):
    mechanism = Wall(h1, h2, thickness, restitution=0.9).mechanism()
    x, ratio = h2 / h1, np.hypot(h1, thickness) / np.hypot(h2, thickness)
    sum_ = 1 + 2 * x + x * ratio
    lower_diagonal = np.hypot(h1, thickness) / 2
    assert mechanism.uplift_multiplier == pytest.approx(2 * thickness / h1, rel=1e-14)
    assert mechanism.critical_rotation == pytest.approx(np.arctan(thickness / h1), rel=1e-14)
    squared = 3 * GRAVITY / (4 * lower_diagonal) * sum_ / (1 + x)
    assert mechanism.positive.frequency_parameter == pytest.approx(np.sqrt(squared), rel=1e-14)
    assert mechanism.positive.acceleration_scale == pytest.approx((1 + x) / sum_, rel=1e-14)
    # nine tenths of where it locks, or lying
    end, reach = mechanism.positive.end_rotation, 0.9 * min(1, 1 / ratio)
    assert end == np.pi / 2 or np.sin(end - mechanism.critical_rotation) == pytest.approx(reach, rel=1e-12)


def test_wall_momentum_balance_never_goes_negative():
    alpha = np.arcsin(np.sqrt(2 / 9)) + 1e-3
    with pytest.warns(StructureWarning, match="not physical"):
        assert Wall(1.0, 1.0, np.tan(alpha)).mechanism().restitution == 0.0
