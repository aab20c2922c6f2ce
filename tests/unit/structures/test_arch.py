"""The arch: limit analysis by two routes, exact derivatives, limits, refusals."""

import itertools

import numpy as np
import pytest
from kinematic_onset import kinematic_onset
from scipy.optimize import brentq, linprog

from rocking.errors import StructureError, StructureWarning
from rocking.structures.arch import Arch
from rocking.structures.arch_mechanism import (
    NoMechanism,
    TooThin,
    maximum_thickness,
    minimum_thickness,
    static_onset,
)
from rocking.structures.arch_ring import EXTRADOS, INTRADOS, Ring

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
def test_voussoir_routes_agree_with_each_other_and_with_a_linear_programme(voussoirs, thickness, embrace):
    ring = Ring(thickness, np.radians(embrace), voussoirs)
    static = static_onset(ring)
    assert static.multiplier == pytest.approx(kinematic_onset(ring).multiplier, rel=1e-12)
    sections = np.tile(ring.sections(), 2)
    rows = ring.gaps(sections, np.repeat([INTRADOS, EXTRADOS], voussoirs + 1))
    solved = linprog([0, 0, 0, -1], A_ub=-rows[:, :4], b_ub=rows[:, 4], bounds=[(None, None)] * 4)
    assert static.multiplier == pytest.approx(solved.x[3], rel=1e-7)  # the solver's own feasibility tolerance


def test_voussoirs_converge_to_the_continuous_arch_from_above():
    continuous = static_onset(Ring(0.15, np.radians(157.5))).multiplier
    errors = [
        static_onset(Ring(0.15, np.radians(157.5), n)).multiplier - continuous for n in (10, 40, 160, 640)
    ]
    assert all(error > 0 for error in errors)
    # λ is quadratic in the distance of a hinge from its place, at most half a joint: at least 4² per factor
    # of 4 on average; hinge positions relative to the joints scatter, so first against last only.
    assert errors[-1] < errors[0] / 64


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


def test_a_single_block_hinge_at_the_springing_is_not_a_mechanism():
    """A and B on the left springing is a ring that slides there: refused, though a thrust line has its limit."""
    with pytest.raises(NoMechanism):
        static_onset(Ring(0.3, np.radians(120), 3))


@pytest.mark.parametrize("embrace", [100.0, 140.0, 157.5, 180.0, 210.0])
@pytest.mark.parametrize("excess", [1.0001, 1.000001])
def test_onset_is_found_just_above_the_minimum_thickness(embrace, excess):
    ring = Ring(minimum_thickness(np.radians(embrace)) * excess, np.radians(embrace))
    static = static_onset(ring)
    assert 0 < static.multiplier < 1e-3
    assert static.multiplier == pytest.approx(kinematic_onset(ring).multiplier, abs=1e-9)
    arch = Arch(1.0, ring.thickness, ring.embrace_angle)
    assert 0 < arch.mechanism().critical_rotation < 1e-3


def test_thrust_line_stays_inside_the_ring_at_onset():
    arch = Arch(1.0, 0.17, np.radians(165))
    unknowns = np.array([*arch.onset.reaction, arch.onset.multiplier, 1.0])
    sections = np.linspace(-arch.embrace_angle / 2, arch.embrace_angle / 2, 2001)
    for contact in (INTRADOS, EXTRADOS):
        assert (arch.ring.gaps(sections, np.full(2001, contact)) @ unknowns).min() > -1e-12


@pytest.mark.parametrize(
    "thickness, embrace, voussoirs",
    [
        (0.12, 180, None),
        (0.15, 157.5, 7),
        (0.35, 180, None),
        (0.3, 120, None),
        (0.05, 60, None),
        (0.5, 200, None),
    ],
)
def test_slopes_are_the_derivatives(thickness, embrace, voussoirs):
    side = Arch(1.0, thickness, np.radians(embrace), voussoirs).mechanism().positive
    rotation = np.linspace(0.02, 0.98, 25) * side.end_rotation
    for name in ("inertia", "gravity"):
        function, slope = getattr(side, name), getattr(side, f"{name}_slope")(rotation)
        step = 1e-3 * side.end_rotation  # an eighth-order difference: truncation and rounding both near 1e-12
        weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
        terms = [
            w * (function(rotation + k * step) - function(rotation - k * step)) for k, w in weights.items()
        ]
        np.testing.assert_allclose(slope, sum(terms) / step, rtol=1e-8, atol=1e-9 * np.abs(slope).max())


@pytest.mark.parametrize("thickness, embrace", [(0.12, 180), (0.35, 180), (0.3, 120)])
def test_linkage_keeps_its_bars_and_closes(thickness, embrace):
    linkage = Arch(1.0, thickness, np.radians(embrace)).linkage
    rotation = np.linspace(0, linkage.straightening(), 30)
    motion = linkage.motion(rotation)
    bars = np.diff(linkage.hinges)[:, None] * np.exp(1j * motion.angles)
    np.testing.assert_allclose(bars.sum(axis=0), linkage.hinges[3] - linkage.hinges[0], rtol=1e-13)
    a_b_c = (bars[0, -1].conjugate() * bars[1, -1]).imag
    assert abs(a_b_c) < 1e-12, "A, B and C are in line at the end"


def test_potential_energy_is_the_integral_of_gravity():
    arch = Arch(2.0, 0.3, np.radians(170))
    side, linkage = arch.mechanism().positive, arch.linkage
    nodes, weights = np.polynomial.legendre.leggauss(40)
    half = side.critical_rotation / 2
    heights = linkage.motion(np.array([0.0, 2 * half])).centroids.imag
    work = (weights * side.gravity(half * (nodes + 1))).sum() * half
    assert work == pytest.approx(linkage.bars.masses @ (heights[:, 1] - heights[:, 0]), rel=1e-12)


def test_continuity_where_hinge_a_reaches_the_springing():
    below, above = (Arch(1.0, 0.293914827 + d, np.pi).mechanism() for d in (-1e-6, 1e-6))
    assert above.critical_rotation == pytest.approx(below.critical_rotation, rel=1e-4)
    assert above.positive.frequency_parameter == pytest.approx(below.positive.frequency_parameter, rel=1e-4)


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
    assert arch.momentum_balance() == pytest.approx(expected, rel=1e-3)  # midpoint rule, hinges inside cells


def test_restitution_of_the_arch():
    assert Arch(1.0, 0.15, np.pi).mechanism().restitution == 0.9
    with pytest.warns(StructureWarning, match="leaves the ring"):
        arch = Arch(1.0, 0.15, np.pi, restitution="unsafe momentum")
        assert arch.mechanism().restitution == arch.momentum_balance()


def test_bounds_of_thickness_are_sharp():
    embrace = np.radians(120)
    least, most = minimum_thickness(embrace), maximum_thickness(embrace)
    with pytest.raises(TooThin):
        static_onset(Ring(least * (1 - 1e-9), embrace))
    with pytest.raises(NoMechanism):
        static_onset(Ring(most * (1 + 1e-9), embrace))
    assert static_onset(Ring(least * (1 + 1e-9), embrace)).multiplier > 0
    assert static_onset(Ring(most * (1 - 1e-6), embrace)).multiplier > 0


def test_minimum_thickness_is_where_the_kinematic_multiplier_vanishes():
    embrace = np.radians(150)
    vanishing = brentq(lambda t: kinematic_onset(Ring(t, embrace)).multiplier, 0.04, 0.08, xtol=1e-12)
    assert minimum_thickness(embrace) == pytest.approx(vanishing, abs=1e-9)


@pytest.mark.parametrize(
    "make, message",
    [
        (
            lambda: Arch(10.0, 1.0, np.pi),
            r"thickness is 1.0 m.*stands only above a thickness of 1.07478038 m",
        ),
        (
            lambda: Arch(10.0, 2.0, 0.5),
            r"28.6479°\) has a four-hinge mechanism only below a thickness of 0.2121",
        ),
        (lambda: Arch(10.0, 21.0, 2.0), "less than twice the radius of 10.0 m"),
        (
            lambda: Arch(10.0, 1.5, 6.3),
            "embrace_angle is",
        ),
        (lambda: Arch(-10.0, 1.5, 3.0), "radius is"),
        (lambda: Arch(10.0, 1.5, 3.0, 2), "voussoirs is 2, but must be a whole number from 3 to 1000"),
        (lambda: Arch(10.0, 1.5, 3.0, restitution="housner"), "restitution is 'housner'.*unsafe momentum"),
        (
            lambda: Arch(10.0, 1.5, 3.0, restitution="momentum"),
            "restitution is 'momentum', but .* on the unsafe side; give a number, .* 'unsafe momentum' to take it",
        ),
    ],
)
def test_bad_geometry_is_refused_with_its_bound(make, message):
    with pytest.raises(StructureError, match=message):
        make()
