"""The arch: limit analysis by two routes, exact derivatives, limits, refusals."""

import itertools

import numpy as np
import pytest
from kinematic_onset import kinematic_onset

from rocking.errors import StructureWarning
from rocking.structures.arch import Arch
from rocking.structures.arch_mechanism import FourBar, NoMechanism, TooThin, limiting_thickness, static_onset
from rocking.structures.arch_ring import Bars, Ring

SMOOTH = itertools.product((0.108, 0.12, 0.15, 0.2, 0.28, 0.31, 0.35), (120, 135, 150, 165, 180), [None])
BLOCKS = itertools.product([0.15], [120, 157.5], [5, 7, 12, 31, 40])


CASES = [(0.2, 180, 7), (0.1, 100, None), *SMOOTH, *BLOCKS]
OFTEN = CASES[:2] + CASES[2::3]


@pytest.mark.parametrize(
    "thickness, embrace, voussoirs",
    [pytest.param(*case, marks=() if case in OFTEN else pytest.mark.slow) for case in CASES],
)
def test_static_and_kinematic_multipliers_agree(thickness, embrace, voussoirs):
    ring = Ring(thickness=thickness, embrace_angle=np.radians(embrace), voussoirs=voussoirs)
    static, kinematic = static_onset(ring), kinematic_onset(ring)
    assert static.multiplier == pytest.approx(kinematic.multiplier, abs=1e-9)
    # A multiplier is flat in the hinges at its minimum, so they are known to the root of its rounding only.
    np.testing.assert_allclose(static.hinges, kinematic.hinges, atol=1e-6)


def test_multiplier_and_embrace_angle_share_one_invariant():
    """With A inside the ring, atan λ + β/2 depends on t/r only."""
    values = [
        np.arctan(static_onset(Ring(thickness=0.15, embrace_angle=b)).multiplier) + b / 2
        for b in np.radians((158, 165, 172, 180))
    ]
    np.testing.assert_allclose(values, values[0], rtol=1e-12)


@pytest.mark.parametrize("embrace, bound", [(180.0, 0.293914827), (157.5, 0.156568144)])
def test_hinge_a_reaches_the_springing(embrace, bound):
    """The bounds are where λ is stationary in A at the springing, solved with thirty digits by virtual work alone."""
    rings = [Ring(thickness=bound + d, embrace_angle=np.radians(embrace)) for d in (-1e-5, 1e-5)]
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
        motion = arch.linkages[0].motion(0.0)
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


def test_bars_that_lock_before_they_are_in_line_are_followed_until_just_before():
    """B turns about A at 1 m and away from D, as far from A: |BD|² = 2 + 2 sin φ, and no longer than BC + CD."""
    hinges = np.array([0, 1j, -0.8 + 0.5j, -1])
    bars = Bars(np.ones(3), (hinges[1:] + hinges[:-1]) / 2, np.full(3, 0.1))
    locked = np.arcsin(np.abs(np.diff(hinges)[1:]).sum() ** 2 / 2 - 1)
    assert 0.95 * locked < FourBar(hinges, bars, 1.0, 3.0, np.zeros(4)).end_rotation < locked


@pytest.mark.slow
def test_bounds_of_thickness_are_sharp():
    embrace = np.radians(120)
    least, most = (
        limiting_thickness(Ring(thickness=1.0, embrace_angle=embrace), failure)
        for failure in (TooThin, NoMechanism)
    )
    with pytest.raises(TooThin):
        static_onset(Ring(thickness=least * (1 - 1e-9), embrace_angle=embrace))
    with pytest.raises(NoMechanism):
        static_onset(Ring(thickness=most * (1 + 1e-9), embrace_angle=embrace))
    assert static_onset(Ring(thickness=least * (1 + 1e-9), embrace_angle=embrace)).multiplier > 0
    assert static_onset(Ring(thickness=most * (1 - 1e-6), embrace_angle=embrace)).multiplier > 0
