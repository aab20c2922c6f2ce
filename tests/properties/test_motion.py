"""What the equation of motion itself promises, whatever the structure and the ground motion."""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from motion_cases import with_restitution
from scipy.constants import g
from scipy.integrate import quad

from rocking.motion import integrate
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Arch, Block, EquivalentBlock, Outcome, Wall

BLOCK = Block(1.0, 0.25, restitution=0.85).mechanism()
WALL = Wall(2.0, 3.0, 0.5, restitution=0.8).mechanism()
ARCH = Arch(10.0, 1.5, np.deg2rad(157.5), restitution=0.9).mechanism()
VOUSSOIRS = Arch(10.0, 1.5, np.deg2rad(157.5), voussoirs=7, restitution=0.9).mechanism()
MECHANISMS = {"block": BLOCK, "wall": WALL, "arch": ARCH, "voussoirs": VOUSSOIRS}
SEEDS = st.integers(0, 2**31)
FEW = settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])


def noise(seed: int, mechanism, strength: float = 1.5, count: int = 200, step: float = 0.02) -> Accelerogram:
    """Smoothed noise with a peak of `strength` times the uplift acceleration."""
    samples = np.convolve(np.random.default_rng(seed).normal(size=count), np.hanning(12), "same")
    return Accelerogram(samples * strength * g * mechanism.uplift_multiplier / np.abs(samples).max(), step)


def energy(side, rotation: float, velocity: float) -> float:
    """½ I φ'² + g ∫ G dφ from 0 to φ, by the mechanism's own functions and adaptive quadrature."""
    lifted, _ = quad(lambda r: side.at("gravity", r), 0, rotation, epsabs=1e-16, epsrel=1e-13)
    return side.at("inertia", rotation) * velocity**2 / 2 + g * lifted


@pytest.mark.parametrize("name", ["block", "arch"])
def test_energy_drift_over_ten_thousand_impacts(name):
    """η = 1, still ground: the speed of landing is the same to 1e-9 at impact 10 000 as at the first."""
    mechanism = with_restitution(MECHANISMS[name], 1.0, 1.0)
    period = 4 / mechanism.positive.frequency_parameter * np.arccosh(1 / 0.8)
    record = Accelerogram(np.zeros(1000), 5600 * period / 999)
    start = 0.2 * mechanism.critical_rotation
    response = integrate(mechanism, record, 1e-12, history=True, initial_rotation=start)
    assert response.impacts >= 10_000
    landing = response.angular_velocity[(response.rotation == 0) & (response.angular_velocity != 0)]
    assert np.abs(landing / landing[0]) ** 2 == pytest.approx(np.ones(landing.size), abs=1e-9)


@pytest.mark.parametrize("name", ["block", "arch"])
def test_free_period_of_the_equivalent_block(name):
    """Housner's T = (4/p) acosh(1/(1 − x₀)) is exact on the linearised block."""
    mechanism = with_restitution(MECHANISMS[name], 1.0, 1.0)
    record = Accelerogram(np.zeros(2000), 0.01)
    block, start = mechanism.equivalent_block("linearised"), 0.5 * mechanism.critical_rotation
    response = integrate(block, record, 1e-10, history=True, initial_rotation=start)
    landed = np.unique(response.times[response.rotation == 0])
    period = 4 / mechanism.positive.frequency_parameter * np.arccosh(2)
    assert landed[2] - landed[0] == pytest.approx(period, rel=1e-12)


@pytest.mark.parametrize("name", MECHANISMS)
@FEW
@given(seed=SEEDS)
def test_inserted_samples_change_nothing(name, seed):
    """A straight line sampled more often is the same forcing: no peak changes by more than 1e-8."""
    mechanism = MECHANISMS[name]
    record = noise(seed, mechanism)
    times = np.linspace(0, record.duration, 5 * (record.acceleration.size - 1) + 1)
    fine = Accelerogram(np.interp(times, record.times, record.acceleration), record.time_step / 5)
    for structure in (mechanism, mechanism.equivalent_block()):
        coarse, dense = integrate(structure, record, 1e-9, sensitivity=True), integrate(structure, fine, 1e-9)
        assume(not abs(coarse.sensitivity) > 100)  # else the rounding of the inserted samples alone shows
        assert coarse.outcome is dense.outcome
        assert dense.rotation_ratio == pytest.approx(coarse.rotation_ratio, rel=1e-8)


@pytest.mark.parametrize("name", MECHANISMS)
@FEW
@given(seed=SEEDS)
def test_mirrored_records_give_mirrored_responses(name, seed):
    """To the last bit: every operation is odd in the side."""
    mechanism = MECHANISMS[name]
    record = noise(seed, mechanism)
    for structure in (mechanism, mechanism.equivalent_block()):
        here, there = integrate(structure, record), integrate(structure, record.scaled(-1.0))
        assert (here.rotation_ratio, here.impacts) == (there.rotation_ratio, there.impacts)
        assert here.peak_side == -there.peak_side
    pulse = Pulse(amplitude=1.3 * g * mechanism.uplift_multiplier, circular_frequency=5.0)
    here, there = (
        integrate(mechanism, pulse),
        integrate(mechanism, Pulse(amplitude=-pulse.amplitude, circular_frequency=5.0)),
    )
    assert (here.rotation_ratio, here.peak_side) == (there.rotation_ratio, -there.peak_side)


@FEW
@given(seed=SEEDS, scale=st.floats(0.01, 100))
def test_similar_structures_under_time_scaled_records(seed, scale):
    """Lengths times k and times times √k leave φ/φ_cr as it is."""
    wall = Wall(2.0 * scale, 3.0 * scale, 0.5 * scale, restitution=0.8)
    for one, other in ((BLOCK, Block(scale, 0.25, restitution=0.85)), (WALL, wall)):
        record = noise(seed, one)
        scaled = Accelerogram(record.acceleration, record.time_step * np.sqrt(scale))
        small, large = integrate(one, record, 1e-10), integrate(other, scaled, 1e-10)
        assert small.outcome is large.outcome
        assert large.rotation_ratio == pytest.approx(small.rotation_ratio, rel=1e-7)


@FEW
@given(seed=SEEDS, p=st.floats(0.5, 10), critical=st.floats(1e-3, 1.0), scale=st.floats(0.1, 3.0))
def test_every_equivalent_block_is_the_universal_one(seed, p, critical, scale):
    """In x = φ/φ_cr, p t and ü_g/(g λ) only η remains."""
    one, other = (
        EquivalentBlock(
            frequency_parameter=1.0, critical_rotation=1.0, acceleration_scale=1.0, restitution=0.8
        ),
        EquivalentBlock(
            frequency_parameter=p, critical_rotation=critical, acceleration_scale=scale, restitution=0.8
        ),
    )
    record = noise(seed, one, step=0.05)
    same = Accelerogram(record.acceleration * other.uplift_multiplier, record.time_step / p)
    here, there = integrate(one, record), integrate(other, same)
    assert here.outcome is there.outcome
    assert there.rotation_ratio == pytest.approx(here.rotation_ratio, rel=1e-8)


@pytest.mark.parametrize("name", MECHANISMS)
@pytest.mark.parametrize("tolerance", [1e-6, 1e-9])
def test_time_reversal(name, tolerance):
    """η = 1: the record played backwards, velocity reversed, returns to the start within 100 tolerances."""
    mechanism = with_restitution(MECHANISMS[name], 1.0, 1.0)
    record = noise(3, mechanism, 0.3, count=150)
    start = 0.3 * mechanism.critical_rotation
    there = integrate(mechanism, record, tolerance, history=True, initial_rotation=start)
    last = np.flatnonzero(np.isclose(there.times, record.duration, rtol=0, atol=1e-9))[-1]
    state = {"initial_rotation": there.rotation[last], "initial_velocity": -there.angular_velocity[last]}
    backwards = Accelerogram(record.acceleration[::-1], record.time_step)
    back = integrate(mechanism, backwards, tolerance, history=True, **state)
    assert there.impacts > 2
    end = np.flatnonzero(np.isclose(back.times, record.duration, rtol=0, atol=1e-9))[-1]
    assert back.rotation[end] == pytest.approx(start, rel=100 * tolerance)
    speed = start * mechanism.positive.frequency_parameter
    assert back.angular_velocity[end] == pytest.approx(0, abs=100 * tolerance * speed)


@FEW
@given(seed=SEEDS)
def test_impact_work_balance(seed):
    """Over a whole record: energy at rest again is zero, so the work of the ground is what the impacts took."""
    coarse = noise(seed, BLOCK, 1.3)
    samples = np.append(coarse.acceleration, 0.0)  # ends at rest, without a jump
    times = np.linspace(0, samples.size - 1, 40 * (samples.size - 1) + 1)
    record = Accelerogram(np.interp(times, np.arange(samples.size), samples), coarse.time_step / 40)
    response = integrate(BLOCK, record, 1e-10, history=True)
    assume(response.outcome is Outcome.ROCKS)
    side = BLOCK.positive
    velocity, instant = response.angular_velocity, np.diff(response.times) == 0
    landed = np.flatnonzero(instant & (response.rotation[1:] == 0) & (velocity[:-1] != 0))
    lost = sum(energy(side, 0.0, velocity[k]) * (1 - BLOCK.restitution**2) for k in landed)
    last = energy(side, abs(response.rotation[-1]), velocity[-1])
    assert lost > 0
    assert lost + last == pytest.approx(work_of_ground(side, response, record), rel=1e-4)


def work_of_ground(side, response, record) -> float:
    """∫ −B ü_g dφ along the signed path, by the trapezoid over the history, whose 0.5 ms err by about (p Δt)²."""
    acceleration = np.interp(response.times, record.times, record.acceleration, right=0.0)
    force = -np.cos(0.25 - np.abs(response.rotation)) * acceleration
    assert side.at("ground", 0.0) == pytest.approx(np.cos(0.25), rel=1e-12)
    return float(np.sum((force[1:] + force[:-1]) / 2 * np.diff(response.rotation)))
