"""Drawings move rigidly, keep their supports, and fall as the mechanism's gravity says."""

import numpy as np
import pytest

from rocking.errors import StructureError
from rocking.structures.arch import Arch
from rocking.structures.block import Block, RigidBody
from rocking.structures.drawing import turned
from rocking.structures.frame import Frame
from rocking.structures.spire import Spire
from rocking.structures.wall import Wall

STRUCTURES = {
    "block": Block(2.0, 0.25),
    "wall": Wall(1.5, 2.5, 0.4),
    "arch": Arch(5.0, 1.0, np.radians(165)),
    "voussoir arch": Arch(5.0, 1.0, np.radians(165), 9),
    "rigid body": RigidBody(0.3, 0.5, 2.0, 1.4),
    "cracked spire": Spire(3.0, 12.0, 0.3, crack_height=4.0),
    "frame": Frame(Block(3.0, 0.15), 3, 0.5),
    "bare frame": Frame(Block(3.0, 0.15), 2, 0.0),
}


def area_and_centroid(polygon):
    x, y = polygon.T
    turn = x * np.roll(y, -1) - np.roll(x, -1) * y
    area = turn.sum() / 2
    moment = np.array([((x + np.roll(x, -1)) * turn).sum(), ((y + np.roll(y, -1)) * turn).sum()])
    return area, moment / (6 * area)


@pytest.mark.parametrize("name", STRUCTURES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_parts_move_rigidly(name, sign):
    structure = STRUCTURES[name]
    rotation = sign * 0.7 * structure.mechanism().critical_rotation
    at_rest, displaced = structure.outline(sign * 1e-300), structure.outline(rotation)
    assert len(at_rest) == len(displaced)
    for before, after in zip(at_rest, displaced, strict=True):
        for shift in (1, 2):
            np.testing.assert_allclose(
                np.linalg.norm(after - np.roll(after, shift, axis=0), axis=1),
                np.linalg.norm(before - np.roll(before, shift, axis=0), axis=1),
                atol=1e-12,
            )


@pytest.mark.parametrize("name", STRUCTURES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_hinges_are_points_of_the_parts(name, sign):
    structure = STRUCTURES[name]
    for rotation in (sign * 1e-300, sign * 0.7 * structure.mechanism().critical_rotation):
        corners = np.concatenate(structure.outline(rotation))
        for hinge in structure.hinges(rotation):
            assert np.linalg.norm(corners - hinge, axis=1).min() < 1e-12


@pytest.mark.parametrize("name", ["wall", "block", "arch", "voussoir arch", "frame"])
def test_potential_energy_of_the_drawing_is_the_mechanisms(name):
    """Height of the drawn area against ∫ G dφ, by one factor at all rotations (a mass)."""
    structure = STRUCTURES[name]
    side = structure.mechanism().positive
    nodes, weights = np.polynomial.legendre.leggauss(30)

    def drawn(rotation):
        return sum(area * centre[1] for area, centre in map(area_and_centroid, structure.outline(rotation)))

    def work(rotation):
        return (weights * side.gravity(rotation / 2 * (nodes + 1))).sum() * rotation / 2

    shares = np.array([0.3, 0.7, 1.0, 1.3]) * side.critical_rotation
    factors = np.array([(drawn(share) - drawn(0.0)) / work(share) for share in shares])
    # Arcs are drawn by chords of two degrees: their area and its height are short by about 1e-4.
    np.testing.assert_allclose(factors, factors[0], rtol=1e-3 if "arch" in name else 1e-10)


def test_drawing_of_a_symmetric_structure_mirrors():
    wall = STRUCTURES["wall"]
    for one, other in zip(wall.outline(0.1), wall.outline(-0.1), strict=True):
        np.testing.assert_array_equal(one * [-1, 1], other)
    np.testing.assert_array_equal(wall.hinges(0.1) * [-1, 1], wall.hinges(-0.1))


def test_an_off_centre_body_turns_about_its_other_corner():
    body = STRUCTURES["rigid body"]
    np.testing.assert_array_equal(body.hinges(0.1), [[0.5, 0.0]])
    np.testing.assert_array_equal(body.hinges(-0.1), [[-0.3, 0.0]])


def test_thrust_line_of_the_arch_touches_the_hinges_and_stays_inside():
    arch = STRUCTURES["arch"]
    line = arch.thrust_line(4001)
    radii = np.linalg.norm(line, axis=1)
    assert radii.min() > 4.5 - 1e-9
    assert radii.max() < 5.5 + 1e-9
    for hinge in arch.hinges(0.0):
        assert np.linalg.norm(line - hinge, axis=1).min() < 5.0 * np.radians(165) / 4000


@pytest.mark.parametrize("rotation", [2.0, -2.0])
def test_a_rotation_beyond_the_end_is_refused(rotation):
    with pytest.raises(StructureError, match=r"rotation is .*2.0 rad, but must lie between"):
        STRUCTURES["block"].outline(rotation)


def test_a_one_sided_body_is_not_drawn_behind_its_support():
    with pytest.raises(StructureError, match="must lie between 0"):
        Block(2.0, 0.2, 0.5, one_sided=True).outline(-0.1)


def test_turning_is_clockwise():
    np.testing.assert_allclose(turned([[0.0, 1.0]], np.zeros(2), np.pi / 2), [[1.0, 0.0]], atol=1e-15)
