"""Drawings move rigidly, keep their supports, and fall as the mechanism's gravity says."""

import numpy as np
import pytest

from rocking.structures.arch import Arch
from rocking.structures.block import Block, RigidBody
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


@pytest.mark.parametrize("name", STRUCTURES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_parts_move_rigidly_about_hinges_that_are_points_of_them(name, sign):
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
    for hinges, parts in (
        (structure.hinges(sign * 1e-300), at_rest),
        (structure.hinges(rotation), displaced),
    ):
        corners = np.concatenate(parts)
        assert all(np.linalg.norm(corners - hinge, axis=1).min() < 1e-12 for hinge in hinges)
