"""The edges of the allowed: each with the reason for the result expected."""

import numpy as np
import pytest
from motion_cases import with_restitution
from scipy.constants import g

from rocking.motion import integrate
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Arch, Block, EquivalentBlock, Outcome, Wall

SHAPE = np.convolve(np.random.default_rng(0).normal(size=400), np.hanning(15), "same")
SHAPE = SHAPE / np.abs(SHAPE).max()

BLOCK, LINEAR = (
    Block(1.0, 0.2).mechanism(),
    EquivalentBlock(frequency_parameter=2.7, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9),
)
BOTH = pytest.mark.parametrize("structure", [BLOCK, LINEAR], ids=["block", "linear"])


def shaken(structure, strength, tolerance=1e-8):
    """The response to noise whose peak is `strength` times the uplift acceleration."""
    return integrate(
        structure, Accelerogram(strength * g * structure.uplift_multiplier * SHAPE, 0.01), tolerance
    )


def test_slenderness_down_to_one_in_ten_thousand():
    """A slender block approaches its linear block as α → 0 with an error of order α²."""
    mechanism = Block(1.0, 1e-4, restitution=0.8).mechanism()
    block = EquivalentBlock(
        frequency_parameter=mechanism.positive.frequency_parameter,
        critical_rotation=1e-4,
        acceleration_scale=1e-4 / np.tan(1e-4),
        restitution=0.8,
    )
    nonlinear, linear = shaken(mechanism, 1.4), shaken(block, 1.4)
    assert 0 < linear.rotation_ratio < np.inf
    assert nonlinear.rotation_ratio == pytest.approx(linear.rotation_ratio, rel=1e-6)  # α² = 1e-8, amplified


@BOTH
def test_amplitude_at_the_uplift_acceleration(structure):
    level = g * structure.uplift_multiplier
    for motion in (
        lambda a: Pulse(amplitude=a, circular_frequency=6.0),
        lambda a: Accelerogram(a * SHAPE, 0.01),
    ):
        below, above = (integrate(structure, motion(level * (1 + d))) for d in (-1e-12, 1e-12))
        assert below.outcome is Outcome.NO_UPLIFT
        assert below.rotation_ratio == 0
        assert above.outcome is Outcome.ROCKS
        assert 0 < above.rotation_ratio < 1e-10


@BOTH
def test_alternating_ten_g(structure):
    """± 10 g at 200 Hz moves the ground by 10 g Δt²/8 = 0.3 mm: a block of two metres rattles and stands."""
    samples = 10 * g * (-1.0) ** np.arange(2000)
    response = integrate(structure, Accelerogram(samples, 0.005))
    assert response.outcome is Outcome.ROCKS
    assert 0 < response.rotation_ratio < 0.5
    assert response.impacts > 100


@pytest.mark.parametrize(
    "structure",
    [
        Arch(10.0, 1.07478038 * 1.0001, np.pi, restitution=0.9),  # λ is nearly nothing, φ_cr 6e-6 rad
        *(Wall(3 / (1 + k), 3 * k / (1 + k), 0.2, restitution=0.8) for k in (0.01, 0.1, 1.0, 10.0, 100.0)),
    ],
)
def test_thin_arch_and_hinge_from_low_to_high_keep_the_tolerance(structure):
    mechanism = structure.mechanism()
    response, tight = (shaken(mechanism, 1.2, tolerance=tolerance) for tolerance in (1e-8, 1e-12))
    assert response.outcome is tight.outcome
    assert response.rotation_ratio == pytest.approx(tight.rotation_ratio, rel=1e-7)


@BOTH
def test_zeno_chain_of_a_hundred_thousand_impacts_ends_in_rest(structure):
    """Each impact keeps η² of the energy, E/E_cr ≈ 2 x − x²; rest at 1e-14 of it: ln(E/1e-14)/(−2 ln η) impacts."""
    start = 0.02
    structure = with_restitution(structure, 0.9999, 0.9999)
    # Flights last (2/p) acosh(1/(1 − x)); their sum over the chain is finite, and the record outlasts it.
    record = Accelerogram(np.zeros(200_000), 0.05)
    response = integrate(structure, record, 1e-6, history=True, initial_rotation=start)
    ratio = start / 0.2
    expected = np.log((2 * ratio - ratio**2) / 1e-14) / (-2 * np.log(0.9999))
    assert response.impacts > 1e5
    assert response.impacts == pytest.approx(expected, rel=1e-3)
    assert response.rotation[-1] == 0
    assert response.times[-1] < record.duration
    assert response.outcome is Outcome.ROCKS
