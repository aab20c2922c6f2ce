"""Arches under fill and on piers: limits, brute virtual work over all hinges, motion of free bars, refusals."""

import dataclasses
import itertools

import numpy as np
import pytest
from free_bars import BOTH, FILLED, ONE, SMOOTH, UNDER_FILL, multiplier, pier_box, places_of

from rocking.structures import Arch
from rocking.structures.arch import ArchOnPiers


@pytest.mark.parametrize("arch", [FILLED, ONE, BOTH], ids=["fill", "one pier", "both piers"])
def test_no_mechanism_of_all_joints_and_feet_is_weaker(arch):
    """The static multiplier is the smallest over all alternating hinges, by virtual work of masses from quadrature."""
    half = arch.embrace_angle / 2
    joints = [float(angle) for angle in np.linspace(-half, half, arch.voussoirs + 1)]
    if isinstance(arch, ArchOnPiers):
        joints = ["left", *joints, "right"]
    found = {tuple(four): multiplier(arch, four) for four in itertools.combinations(joints, 4)}
    assert arch.onset.multiplier == pytest.approx(min(found.values()), rel=1e-9)


@pytest.mark.parametrize("arch", [FILLED, SMOOTH, ONE, BOTH, UNDER_FILL])
def test_the_linkage_starts_at_the_static_multiplier(arch):
    assert arch.mechanism().uplift_multiplier == pytest.approx(arch.onset.multiplier, rel=1e-9)
    assert multiplier(arch, places_of(arch)) == pytest.approx(arch.onset.multiplier, rel=1e-9)


def test_without_fill_and_on_stout_piers_an_arch_is_an_arch():
    plain = Arch(10.0, 1.5, np.radians(157.5))
    others = (
        Arch(10.0, 1.5, np.radians(157.5), fill_depth=0.2, fill_density_ratio=0.0),
        ArchOnPiers(10.0, 1.5, np.radians(157.5), pier_width=30.0, pier_height=5.0),
    )
    for other in others:
        for name in ("uplift_multiplier", "critical_rotation", "frequency_parameter", "acceleration_scale"):
            expected = getattr(plain.mechanism().positive, name)
            assert getattr(other.mechanism().positive, name) == pytest.approx(expected, rel=1e-11)
    assert others[1].onset.hinges == pytest.approx(plain.onset.hinges, abs=1e-9)


@pytest.mark.parametrize("arch", [UNDER_FILL, dataclasses.replace(ONE, voussoirs=None)])
def test_thrust_line_runs_from_foot_to_foot_inside_arch_and_piers(arch):
    line = arch.thrust_line(2001)
    ring = np.linalg.norm(line[1:-1], axis=1)
    assert ring.min() > arch.radius - arch.thickness / 2 - 1e-9
    assert ring.max() < arch.radius + arch.thickness / 2 + 1e-9
    for end, side in ((0, -1), (-1, 1)):
        left, low, width, _ = pier_box(arch, side)
        assert left - 1e-9 <= line[end, 0] <= left + width + 1e-9
        assert line[end, 1] == pytest.approx(low)
    for hinge in arch.hinges(0.0):
        assert np.linalg.norm(line - hinge, axis=1).min() < 1e-2


@pytest.mark.parametrize(
    "arch",
    [FILLED, ONE, UNDER_FILL, Arch(10.0, 1.5, np.radians(157.5), 7), Arch(10.0, 1.4, np.radians(170), 12)],
    ids=["fill", "one pier", "piers under fill", "7 voussoirs", "12 voussoirs"],
)
def test_other_mechanisms_have_the_multiplier_of_virtual_work(arch):
    """Of masses from quadrature, with fill and with piers that turn or stand still."""
    found = arch.candidates(6)
    assert len(found) >= 4
    for row in found:
        assert row.mechanism.uplift_multiplier == pytest.approx(
            multiplier(arch, places_of(row.structure)), rel=1e-9
        )


@pytest.mark.parametrize("arch", [ONE, BOTH], ids=["one pier", "both piers"])
def test_piers_are_drawn_joined_to_the_arch_they_carry(arch):
    for rotation in (0.0, 0.5 * arch.mechanism().critical_rotation):
        left, right, *ring = arch.outline(rotation)
        assert all(np.linalg.norm(np.vstack(ring) - pier[3], axis=1).min() < 1e-9 for pier in (left, right))


def test_a_pier_may_turn_about_its_springing_alone():
    """Hinge C at the springing leaves no ring to the pier; λ and φ_cr of another's derivation."""
    arch = ArchOnPiers(5.0, 0.8, np.radians(90), pier_width=1.5, pier_height=4.0)
    assert arch.mechanism().uplift_multiplier == pytest.approx(0.0484, abs=5e-5)
    assert arch.mechanism().uplift_multiplier == pytest.approx(multiplier(arch, places_of(arch)), rel=1e-9)
