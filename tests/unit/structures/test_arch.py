"""The arch: limit analysis by two routes, exact derivatives, limits, refusals."""

import itertools

import numpy as np
import pytest
from kinematic_onset import kinematic_onset
from scipy.optimize import linprog

from rocking.errors import StructureWarning
from rocking.structures.arch import Arch
from rocking.structures.arch_mechanism import (
    NoMechanism,
    TooThin,
    maximum_thickness,
    minimum_thickness,
    static_onset,
)
from rocking.structures.arch_ring import Ring

GRID = list(
    itertools.product((0.108, 0.12, 0.15, 0.2, 0.28, 0.31, 0.35), (120.0, 135.0, 150.0, 165.0, 180.0))
)


@pytest.mark.parametrize("thickness, embrace", GRID)
def test_static_and_kinematic_multipliers_agree(thickness, embrace):
    ring = Ring(thickness, np.radians(embrace))
    static, kinematic = static_onset(ring), kinematic_onset(ring)
    assert static.multiplier == pytest.approx(kinematic.multiplier, abs=1e-9)
    # A multiplier is flat in the hinges at its minimum, so they are known to the root of its rounding only.
    np.testing.assert_allclose(static.hinges, kinematic.hinges, atol=1e-6)


@pytest.mark.parametrize("voussoirs", [3, 7, 12, 31])
@pytest.mark.parametrize("thickness, embrace", [(0.15, 157.5), (0.2, 180.0), (0.15, 120.0)])
def test_voussoir_routes_agree_with_each_other(voussoirs, thickness, embrace):
    ring = Ring(thickness, np.radians(embrace), voussoirs)
    assert static_onset(ring).multiplier == pytest.approx(kinematic_onset(ring).multiplier, rel=1e-12)


def test_multiplier_and_embrace_angle_share_one_invariant():
    """With A inside the ring, atan λ + β/2 depends on t/r only."""
    values = [
        np.arctan(static_onset(Ring(0.15, b)).multiplier) + b / 2 for b in np.radians((158, 165, 172, 180))
    ]
    np.testing.assert_allclose(values, values[0], rtol=1e-12)


@pytest.mark.parametrize("embrace, bound", [(180.0, 0.293914827), (157.5, 0.156568144)])
def test_hinge_a_reaches_the_springing(embrace, bound):
    """The bounds are where λ is stationary in A at the springing, solved with thirty digits by virtual work alone."""
    rings = [Ring(bound + d, np.radians(embrace)) for d in (-1e-5, 1e-5)]
    for route in (static_onset, kinematic_onset):
        before, after = (route(ring).hinges[0] for ring in rings)
        assert 1e-5 < before < 4e-5
        assert after == 0.0


def test_momentum_balance_against_a_sum_over_many_small_masses():
    arch = Arch(1.0, 0.15, np.pi)
    ring, hinges = arch.ring, arch.onset.hinges - np.pi / 2
    radii = np.sqrt(np.linspace(0.925**2, 1.075**2, 402))
    sections = np.linspace(-np.pi / 2, np.pi / 2, 4001)
    middle, radius = np.meshgrid((sections[1:] + sections[:-1]) / 2, (radii[1:] + radii[:-1]) / 2)
    points = radius * np.exp(1j * (np.pi / 2 - middle))

    def field(section, point):
        motion = arch.linkage.motion(0.0)
        pivots = ring.contact_points(hinges, np.array([1, -1, 1, -1]))
        velocity = np.zeros_like(point)
        at_hinge = [0, 1j * motion.spins[0] * (pivots[1] - pivots[0]), 0]
        for bar, base in enumerate((pivots[0], pivots[1], pivots[3])):
            inside = (section > hinges[bar]) & (section < hinges[bar + 1])
            velocity += inside * (at_hinge[bar] + 1j * motion.spins[bar] * (point - base))
        return velocity

    arriving, mirrored = field(middle, points), -field(-middle, -points.conj()).conj()
    expected = -(arriving.conj() * mirrored).real.sum() / (np.abs(mirrored) ** 2).sum()
    with pytest.warns(StructureWarning, match="leaves the ring"):
        balance = arch._momentum_balance(False)
    assert balance == pytest.approx(expected, rel=1e-3)  # midpoint rule, hinges inside cells


def test_bounds_of_thickness_are_sharp():
    embrace = np.radians(120)
    least, most = minimum_thickness(embrace), maximum_thickness(embrace)
    with pytest.raises(TooThin):
        static_onset(Ring(least * (1 - 1e-9), embrace))
    with pytest.raises(NoMechanism):
        static_onset(Ring(most * (1 + 1e-9), embrace))
    assert static_onset(Ring(least * (1 + 1e-9), embrace)).multiplier > 0
    assert static_onset(Ring(most * (1 - 1e-6), embrace)).multiplier > 0


def multiplier_by_programme(arch, hinges=None):
    """Livesley's programme of free voussoirs: the largest λ at which the thrust leaves no joint on the wrong side.

    hinges: the only joints that may open, the first and the third beyond the intrados, the others beyond the extrados;
    None: every joint to both sides. Shares nothing with the product.
    """
    count, half = arch.voussoirs, arch.embrace_angle / 2
    joints, t = np.linspace(-half, half, count + 1), arch.thickness
    inner, outer = arch.radius - t / 2, arch.radius + t / 2
    each = arch.embrace_angle / count
    weight = each * (outer**2 - inner**2) / 2
    distance = (outer**3 - inner**3) / 3 * 2 * np.sin(each / 2) / weight
    # unknowns: force (x, y) and couple about the middle of each joint on what lies to its right, then λ
    equal, right_side = np.zeros((3 * count, 3 * (count + 1) + 1)), np.zeros(3 * count)
    for k in range(count):
        centre = distance * np.array([np.sin(joints[k] + each / 2), np.cos(joints[k] + each / 2)])
        for joint, sign in ((k, 1.0), (k + 1, -1.0)):
            x, y = arch.radius * np.sin(joints[joint]), arch.radius * np.cos(joints[joint])
            own = slice(3 * joint, 3 * joint + 3)
            equal[3 * k : 3 * k + 3, own] += sign * np.array([[1, 0, 0], [0, 1, 0], [-y, x, 1]])
        equal[3 * k : 3 * k + 3, -1] = weight * np.array([1, 0, -centre[1]])
        right_side[3 * k : 3 * k + 3] = weight * np.array([0, 1, centre[0]])
    rows = []
    for joint, angle in enumerate(joints):
        normal = np.array([np.cos(angle), -np.sin(angle)]) * t / 2
        for side in (1.0, -1.0):
            place = None if hinges is None else np.flatnonzero(np.isclose(hinges, angle + half))
            if place is None or (place.size and (place[0] % 2 == 0) == (side > 0)):
                rows.append(np.zeros(equal.shape[1]))
                rows[-1][3 * joint : 3 * joint + 3] = [-normal[0], -normal[1], side]
    aim = np.zeros(equal.shape[1])
    aim[-1] = -1.0
    found = linprog(aim, np.array(rows), np.zeros(len(rows)), equal, right_side, bounds=(None, None))
    return found.x[-1]


@pytest.mark.parametrize("voussoirs, thickness, embrace", [(7, 1.5, 157.5), (12, 1.4, 170.0)])
def test_other_mechanisms_have_the_multiplier_of_a_linear_programme(voussoirs, thickness, embrace):
    """To the tolerance of the solver; none is weaker than the one that statics chooses."""
    arch = Arch(10.0, thickness, np.radians(embrace), voussoirs)
    static, *others = arch.candidates(9)
    assert static.multiplier == pytest.approx(multiplier_by_programme(arch), rel=1e-7)
    assert len(others) == 8
    for each in (static, *others):
        hinges = each.structure.onset.hinges
        assert each.multiplier == pytest.approx(multiplier_by_programme(arch, hinges), rel=1e-7)
        assert each.multiplier >= static.multiplier
