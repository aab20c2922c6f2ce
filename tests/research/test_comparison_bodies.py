"""The structures as separate bodies: what they weigh, how they lift in LMGC90, and what is read off their histories."""

import math
from itertools import pairwise

import numpy as np
import pytest

from docs.research.comparison import lmgc90
from docs.research.comparison.bodies import properties, rigid_bodies
from docs.research.comparison.cases import structures
from docs.research.comparison.runs import landings, limit_of_runs, restitution
from docs.research.reference import reference_landings
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram


def test_properties_of_a_known_polygon():
    """A rectangle: area b h, centre, gyration (b² + h²)/12."""
    area, centroid, gyration = properties(np.array([[1.0, 2.0], [4.0, 2.0], [4.0, 4.0], [1.0, 4.0]]))
    assert (area, centroid) == (pytest.approx(6.0), pytest.approx(2.5 + 3j))
    assert gyration == pytest.approx((9 + 4) / 12)


def test_the_voussoirs_have_the_centroids_of_the_bars():
    """Three, two and two of them are the bars AB, BC and CD, whose sectors are integrated elsewhere."""
    arch = structures()["arch"]
    bodies = rigid_bodies(arch)
    assert bodies.hinges == ((0, 3, 5, 7), (7, 4, 2, 0))
    areas, centroids, _ = zip(*map(properties, bodies.polygons[1:-1]), strict=True)
    assert areas == pytest.approx([areas[0]] * 7)
    bars = arch.bodies(0.0)
    for bar, (first, end) in enumerate(((0, 3), (3, 5), (5, 7))):
        assert np.mean(centroids[first:end]) == pytest.approx(bars.centres[bar], abs=1e-12)


def test_neighbours_share_the_joints_of_the_arch():
    """Two corners with every neighbour, a thickness apart; on an abutment both lie on one of its edges."""
    arch = structures()["arch"]
    left, *voussoirs, right = (polygon @ [1, 1j] for polygon in rigid_bodies(arch).polygons)
    for one, other in pairwise(voussoirs):
        shared = one[np.abs(one[:, None] - other).min(axis=1) < 1e-12]
        assert abs(shared[0] - shared[1]) == pytest.approx(arch.thickness)
    for abutment, voussoir in ((left, voussoirs[0]), (right, voussoirs[-1])):
        along = np.roll(abutment, -1) - abutment
        beside = (along.conj() * (voussoir[:, None] - abutment)).imag / np.abs(along)
        assert max((np.abs(beside) < 1e-12).sum(axis=0)) == 2
        assert (beside.min(axis=1) < 1e-12).all(), "it overlaps"


def test_the_beam_weighs_what_the_frame_says():
    frame = structures()["frame"]
    masses, _ = rigid_bodies(frame).masses()
    assert masses[0] == 0
    assert masses[-1] == pytest.approx(frame.beam_mass_ratio * masses[1:-1].sum())


def test_restitution_and_landings_of_a_history_that_is_known():
    """Half waves whose energy is the square of their height, each 0.8 of the one before."""
    times = np.linspace(0, 4, 4001)
    rotation = 0.1 * 0.8 ** np.floor(times) * np.sin(np.pi * times) * (times < 3.999)
    assert landings(times + 1e-4, rotation)[:3] == pytest.approx([1.0, 2.0, 3.0], abs=2e-3)
    assert restitution(times, rotation, rotation**2, 0.9, 1.0) == pytest.approx(0.8)
    assert math.isnan(restitution(times, rotation, rotation**2, 2.9, 1.0))


def _pushed(multiplier: float) -> float:
    """Largest rotation in critical ones after 0.4 s of constant acceleration."""
    arch = structures()["arch"]
    given = {
        "acceleration": [multiplier * GRAVITY] * 81,
        "time_step": 0.005,
        "frequency_parameter": 1e9,
        "critical_rotation": arch.mechanism().critical_rotation,
    }
    bodies = rigid_bodies(arch)
    _, turns, _ = lmgc90.follow(given, bodies, 1e-3)
    assert bodies.outside_hinges(turns[-1]) < (0.02 if multiplier > 0.37 else 1)
    return float(np.abs(bodies.rotation(turns)).max()) / given["critical_rotation"]


def test_the_arch_of_lmgc90_lifts_where_limit_analysis_says():
    """Oppenheim's arch: λ = 0.370; between 0.98 and 1.02 of it the hinges of the mechanism open."""
    pytest.importorskip("compas_lmgc90", reason="install the extra compare to run this test")
    assert structures()["arch"].mechanism().uplift_multiplier == pytest.approx(0.370009738022)
    assert _pushed(0.98 * 0.37) < 1e-3
    assert _pushed(1.02 * 0.37) > 1e-2


def test_the_frame_of_lmgc90_keeps_what_angular_momentum_keeps():
    """Inelastic shocks at the new pivots: (1 − 1.5 sin²α + 3γ cos 2α)/(1 + 3γ), to first order in the time step."""
    pytest.importorskip("compas_lmgc90", reason="install the extra compare to run this test")
    mechanism = structures()["frame"].mechanism()
    step = 0.01
    pulse = np.append(np.sin(np.arange(51) * 2 * np.pi / 50), 0.0) * 2 * mechanism.uplift_multiplier * GRAVITY
    given = {
        "structure": "frame",
        "acceleration": pulse.tolist(),
        "time_step": step,
        "frequency_parameter": mechanism.positive.frequency_parameter,
        "critical_rotation": mechanism.critical_rotation,
    }
    answer = limit_of_runs(lmgc90.runs(given), "")
    truth, _ = reference_landings(mechanism, Accelerogram(pulse, step))
    alpha, gamma = math.atan(0.5 / 4.0), 1.0
    kept = (1 - 1.5 * math.sin(alpha) ** 2 + 3 * gamma * math.cos(2 * alpha)) / (1 + 3 * gamma)
    # A first-order method at three steps: a percent of η, a few of φ.
    assert answer.restitution == pytest.approx(kept, abs=0.015)
    assert answer.rotation_ratio == pytest.approx(truth, rel=0.05)
