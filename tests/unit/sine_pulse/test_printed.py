"""Eqs. 15 and 16 and the single flight against 50-digit arithmetic."""

import math

import mpmath as mp
import numpy as np
import pytest
from scipy.constants import g

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import kernel, printed_maximum, pulse_end_energy
from rocking.structures.mechanism import EquivalentBlock
from tests.parts import callable_parts

PARTS = callable_parts(kernel)
LONGEST_TIME, flight, land = PARTS.LONGEST_TIME, PARTS.flight, PARTS.land

LARGEST_DOUBLE = mp.mpf(2) ** 1024

RANDOM = np.random.default_rng(20160104)
RANDOM_POINTS = list(
    zip(10 ** RANDOM.uniform(-3, 6, 2000), 1 + 10 ** RANDOM.uniform(-12, 6, 2000), strict=True)
)


def exact(omega: float, a: float) -> tuple[mp.mpf, mp.mpf, mp.mpf]:
    """D₀ as Eq. 16 prints it, 1 − D₀, and the largest term, with digits to spare for every cancellation."""
    with mp.workdps(60):
        w, b = mp.mpf(float(omega)), mp.mpf(float(a))
        s = mp.sqrt(b * b - 1)
        big = mp.exp((2 * mp.pi - mp.asin(1 / b)) / w)
        factor = (w / (w * w + 1)) ** 2
        terms = (w * w, -2 * b * b, mp.mpf(1), (s + w) * b / big, (s - w) * b * big)
        measure = factor * mp.fsum(terms)
        return measure, 1 - measure, factor * (s + w) * b * big


def test_pulse_end_energy_keeps_eleven_digits() -> None:
    """Relative error ≤ 1e-11; beside a zero, where |value| is below 1e-4 of the terms, ≤ 1e-15 of the terms."""
    beside = 0
    for omega, a in RANDOM_POINTS:
        value, (_, truth, growth) = (
            pulse_end_energy(frequency_ratio=omega, amplitude_ratio=a),
            exact(omega, a),
        )
        if abs(truth) >= LARGEST_DOUBLE:
            assert value == math.copysign(math.inf, truth), (omega, a)
            continue
        error = abs(mp.mpf(value) - truth)
        if error > mp.mpf("1e-11") * abs(truth):
            beside += 1
            scale = max(growth, mp.mpf(1)) if abs(truth) < mp.mpf("1e-4") * max(growth, 1) else mp.mpf(0)
            assert error <= mp.mpf("4e-15") * scale, (omega, a, value, truth)
    assert beside <= len(RANDOM_POINTS) // 500


@pytest.mark.parametrize("eta", [0.0, 0.3, 0.9, 1.0])
def test_printed_maximum_is_equation_15_or_nan(eta: float) -> None:
    block = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.25, acceleration_scale=0.8, restitution=eta
    )
    refused = 0
    for omega in np.geomspace(0.1, 1e4, 23):
        for a in 1 + np.geomspace(1e-3, 30, 19):
            pulse = Pulse(amplitude=a * g * block.uplift_multiplier, circular_frequency=omega * 2.0)
            # what the block and the pulse as stored say a and ω are
            ratio = pulse.amplitude / (g * block.uplift_multiplier)
            _, energy, _ = exact(pulse.circular_frequency / 2.0, ratio)
            with mp.workdps(60):
                radicand = 1 - mp.mpf(eta) ** 2 * energy
                truth = 1 - mp.sqrt(radicand)
            value = printed_maximum(block, pulse)
            refused += math.isnan(value)
            if radicand < 0 or math.isnan(value):
                assert radicand < 0, (omega, a)
                assert math.isnan(value), (omega, a)
            else:
                # 1e-10: the division that gives a back loses a digit, and √ loses it again beside a zero radicand
                assert value == pytest.approx(float(truth), rel=1e-10, abs=0 if eta else 1e-300), (omega, a)
    assert refused > 0 or eta < 0.9
    assert printed_maximum(block, Pulse(amplitude=0.1, circular_frequency=3.0)) == 0.0


def precise_flight(omega: mp.mpf, a: mp.mpf):
    """x(τ) = 1 − a sin(ωτ)/(1+ω²) + A e^τ + B e^−τ from rest at ωτ = asin(1/a), and its derivative."""
    start = mp.asin(1 / a) / omega
    c, s = a / (1 + omega**2), mp.sqrt(a * a - 1)
    level, slope = -1 + c / a, omega * c * s / a
    up, down = (level + slope) / 2, (level - slope) / 2

    def x(t):
        return 1 - c * mp.sin(omega * (start + t)) + up * mp.exp(t) + down * mp.exp(-t)

    def velocity(t):
        return -c * omega * mp.cos(omega * (start + t)) + up * mp.exp(t) - down * mp.exp(-t)

    return x, velocity


EXTREMES = [
    (1.0, 1 + 1e-9), (1e-3, 1 + 1e-7), (1e-3, 1 + 1e-12), (1e4, 1.001), (1e6, 1.2), (30.0, 1.5), (4.0, 1.05)
]  # fmt: skip


@pytest.mark.parametrize(("omega", "a"), EXTREMES)
def test_first_flight_keeps_its_digits_when_it_is_tiny(omega: float, a: float) -> None:
    """Height and landing of the first flight against 60 digits, to 1e-11 of their own size (1e-18 at the least)."""
    s = math.sqrt((a - 1) * (a + 1))
    start = math.atan2(1.0, s)
    longest = min((2 * math.pi - start) / omega, LONGEST_TIME)
    contact, landed, _, speed, peak = land(flight(omega, a, start, 0.0, 0.0, s), longest)
    assert contact
    with mp.workdps(60):
        x, velocity = precise_flight(mp.mpf(omega), mp.mpf(a))
        time = mp.findroot(x, mp.mpf(landed) * mp.mpf("1.0000001"))
        top = mp.findroot(velocity, mp.mpf(landed) * mp.mpf("0.75"))
        assert 0 < top < time
        assert landed == pytest.approx(float(time), rel=1e-11)
        assert peak == pytest.approx(float(x(top)), rel=1e-11)
        assert speed == pytest.approx(float(velocity(time)), rel=1e-11)
