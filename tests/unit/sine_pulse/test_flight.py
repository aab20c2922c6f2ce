"""One flight against dense sampling of the same solution written with exponentials."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from rocking.sine_pulse import kernel
from tests.parts import callable_parts

PARTS = callable_parts(kernel)
LONGEST_TIME, flight, hop, land = PARTS.LONGEST_TIME, PARTS.flight, PARTS.hop, PARTS.land

DIPS = [
    (2.033704303603342, -6.683606473145201, 1.3536943479767614, 3.197877471384934),
    (8.413793502077286, 2.6159021015403194, 0.12788559379137132, 0.007680445078786414),
    (7.070124398487417, -1.7533268069814267, 3.2904788095436777, 0.017388851545216105),
    (10.864502389891182, -15.24315397041872, 2.4643073217353706, 0.2599046387736875),
]
"""ω, a, θ₀, v of flights whose formula dips below zero and rises again before x'/cos θ turns."""


def random_flights(count: int) -> list[tuple[float, float, float, float]]:
    """ω, a, θ₀, v with x'' < 0 at the start, where an impact can be, or v large."""
    generator = np.random.default_rng(7)
    flights = []
    while len(flights) < count:
        omega, amplitude = 10 ** generator.uniform(-1.3, 1.3), 10 ** generator.uniform(-0.2, 1.3)
        phase, velocity = generator.uniform(0, 2 * math.pi), 10 ** generator.uniform(-2, 1)
        if (2 * math.pi - phase) / omega < 12:  # beyond, e^t outgrows the digits of the formula below
            flights.append((omega, amplitude * generator.choice([-1, 1]), phase, velocity))
    return flights


def sampled(omega: float, a: float, phase: float, velocity: float) -> tuple[float | None, float]:
    """The first contact, if any, and the largest x before it, from 20 000 samples; contact refined by bisection."""
    end = (2 * math.pi - phase) / omega
    c = a / (1 + omega**2)
    level, slope = -1 + c * math.sin(phase), velocity + omega * c * math.cos(phase)

    def x(t):
        forced = 1 - c * np.sin(phase + omega * t)
        return forced + (level + slope) / 2 * np.exp(t) + (level - slope) / 2 * np.exp(-t)

    times = np.linspace(0, end, 20_001)[1:]
    values = x(times)
    below = np.flatnonzero(values < 0)
    if below.size == 0:
        return None, values.max()
    first = below[0]
    if first == 0:
        return None, math.nan  # lands within one sample: not told apart
    return brentq(x, times[first - 1], times[first], xtol=1e-15, rtol=1e-14), values[:first].max()


@pytest.mark.parametrize("flights", [500, pytest.param(1500, marks=pytest.mark.slow)])
@pytest.mark.parametrize("follow", ["land", "hop"])
def test_no_contact_and_no_peak_is_missed(follow: str, flights: int) -> None:
    """`hop` may decline a flight, `land` takes all. A sampled maximum is at most the peak, and close to it."""
    followed = 0
    for omega, a, phase, velocity in DIPS + random_flights(flights):
        contact, highest = sampled(omega, a, phase, velocity)
        if math.isnan(highest):
            continue
        end = min((2 * math.pi - phase) / omega, LONGEST_TIME)
        course = flight(omega, a, phase, velocity, a * math.sin(phase) - 1, a * math.cos(phase))
        taken, landing = (True, land(course, end)) if follow == "land" else hop(course, end, 0.0)
        if not taken:
            continue
        followed += 1
        where = (omega, a, phase, velocity, landing)
        landed, time, _, speed, peak = landing
        assert landed == (contact is not None), where
        # the sampling misses a parabola's top by (20 000)⁻² of the flight's own scale, more where few samples see it
        samples = 20_000 * (1 if contact is None else contact / end)
        assert highest * (1 - 1e-9) <= peak <= highest * (1 + 40 / samples**2 + 1e-6), where
        if contact is not None:
            # 1e-15 of x, times what a grazing contact makes of it
            graze = 1e-13 * max(1.0, abs(a)) / abs(speed)
            assert time == pytest.approx(contact, rel=1e-10, abs=graze), where
    assert followed > flights * (0.86 if follow == "land" else 0.03)
