"""The block that is exact at rest: its identities, its map, its defects, and what it says of the mechanism."""

import numpy as np
import pytest
from straight import straight

from rocking.motion import integrate
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Arch, Block, EquivalentBlock, Mechanism, Wall

BLOCK, WALL = Block(1.52, 0.165, restitution=0.85), Wall(1.5, 1.5, 0.4)
ARCH = Arch(10.0, 1.5, np.deg2rad(157.5), restitution=0.9)
STRUCTURES = {"block": BLOCK, "wall": WALL, "arch": ARCH, "unequal wall": Wall(1.0, 2.0, 0.3)}
TWO_SIDES = Mechanism(WALL.mechanism().positive, STRUCTURES["unequal wall"].mechanism().positive)


def test_a_linear_mechanism_is_its_own_block():
    plain = EquivalentBlock(
        frequency_parameter=2.3, critical_rotation=0.17, acceleration_scale=0.17 / 0.21, restitution=0.9
    )
    block = Mechanism(straight(plain)).equivalent_block()
    assert block.frequency_parameter == pytest.approx(2.3, rel=1e-12)
    assert block.uplift_multiplier == pytest.approx(0.21, rel=1e-12)
    assert block.critical_arc == pytest.approx(0.17, rel=1e-12)
    x = np.linspace(0, 4.9, 50)
    assert block.rotation_ratios(x) == pytest.approx(x, rel=1e-12, abs=0)
    for pulse in (
        Pulse(amplitude=4.0, circular_frequency=6.0),
        Pulse(amplitude=7.0, circular_frequency=14.0),
        Pulse(amplitude=-5.0, circular_frequency=9.0),
    ):
        found, expected = predict_maximum(block, pulse), predict_maximum(plain, pulse)
        assert found.rotation_ratio == pytest.approx(expected.rotation_ratio, rel=1e-12)
        for name in ("regime", "impacts", "peak_side"):
            assert getattr(found, name) == getattr(expected, name)


def test_defects_of_the_table():
    """The table of the theory, section 9, to its printed digits."""
    expected = {
        (0.002, 0.01): BLOCK,
        (0.010, 0.09): Block(2.0, 0.4),
        (0.051, 0.13): WALL,
        (0.019, 0.06): Wall(2.0, 1.0, 0.3),  # 5.5 % is printed as 6
        (0.019, 0.12): ARCH,
        (0.006, 0.18): Arch(10.0, 1.5, np.deg2rad(140)),
        (0.015, 0.07): Arch(10.0, 1.0, np.deg2rad(150)),
        (0.072, 0.30): Arch(10.0, 1.5, np.deg2rad(120)),
    }
    for (restoring, forcing), structure in expected.items():
        defects = structure.mechanism().block_defects
        assert defects.restoring == pytest.approx(restoring, abs=5.001e-4)
        assert defects.forcing == pytest.approx(forcing, abs=0.006)
    assert TWO_SIDES.block_defects == STRUCTURES["unequal wall"].mechanism().block_defects
    assert (
        Mechanism(
            straight(
                EquivalentBlock(
                    frequency_parameter=2.0, critical_rotation=0.1, acceleration_scale=0.5, restitution=0.9
                )
            )
        ).block_defects.restoring
        < 1e-14
    )


def crests(structure, start):
    """The first two crests after the release from a rotation: of the other side, and of the first one again."""
    still = Accelerogram(np.zeros(1000), 0.002)
    rotation = integrate(structure, still, 1e-11, history=True, initial_rotation=start).rotation
    size = np.abs(rotation)
    crest = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    return rotation[crest[:2]]


def test_small_rocking_on_two_unlike_sides_is_that_of_the_mechanism():
    """The difference vanishes in proportion to the rotation; η is that of the angular velocity on both."""
    errors = []
    for share in (0.04, 0.02, 0.01):
        start = share * TWO_SIDES.positive.critical_rotation
        ours, theirs = (crests(structure, start) for structure in (TWO_SIDES.equivalent_block(), TWO_SIDES))
        assert (np.sign(theirs) == (-1, 1)).all()
        errors.append(np.abs(ours / theirs - 1).max())
    assert errors[0] < 0.02
    assert np.array(errors[1:]) / errors[:-1] == pytest.approx([0.5, 0.5], abs=0.1)
