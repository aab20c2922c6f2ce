"""Thresholds and examples of the block under one sine pulse, each with its source."""

import math
from collections.abc import Callable

import mpmath as mp
import pytest
from scipy.constants import g

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import Maximum, Regime, kernel, predict_maximum, printed_maximum
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock
from tests.parts import callable_parts

PARTS = callable_parts(kernel)
flight, state = PARTS.flight, PARTS.state

BLOCK = EquivalentBlock(
    frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=0.8, restitution=0.9
)


def on_block(a: float, omega: float) -> Pulse:
    return Pulse(
        amplitude=a * g * BLOCK.uplift_multiplier, circular_frequency=omega * BLOCK.frequency_parameter
    )


def predicted(a: float, omega: float) -> Maximum:
    return predict_maximum(BLOCK, on_block(a, omega))


def threshold(overturns: Callable[[float], bool], low: float, high: float) -> float:
    assert overturns(high) and not overturns(low)
    while high - low > 1e-13 * high:
        middle = (low + high) / 2
        low, high = (low, middle) if overturns(middle) else (middle, high)
    return (low + high) / 2


def overturns(a: float, omega: float) -> bool:
    return predicted(a, omega).outcome is Outcome.OVERTURNS


def test_overturning_of_the_linear_block_under_one_sine_has_a_safe_island() -> None:
    """η = 0.9, ω = 5: falls between 3.01 and 3.02, safe again between 6.31 and 6.32, falls for good above 7.17."""
    verdicts = {a: overturns(a, 5.0) for a in (3.01, 3.02, 6.31, 6.32, 7.16, 7.17)}
    assert verdicts == {3.01: False, 3.02: True, 6.31: True, 6.32: False, 7.16: False, 7.17: True}
    assert all(overturns(3.02 + 0.01 * i, 5.0) for i in range(330))
    assert not any(overturns(6.32 + 0.01 * i, 5.0) for i in range(85))
    assert all(overturns(7.17 * 1.1**i, 5.0) for i in range(100))


def test_overturning_without_impact_meets_its_closed_form() -> None:
    """x + x' = 1 at the pulse's end, solved here in 30 digits: 7.168129 for ω = 5.

    With z = x − 1 + x', z' = z + a sin ωτ and z = −1 at uplift: z e^{−τ} adds up ∫ a sin(ωτ) e^{−τ} dτ, elementary.
    """
    with mp.workdps(30):

        def unstable(a):
            omega = mp.mpf(5)
            start, end = mp.asin(1 / a) / omega, 2 * mp.pi / omega
            return a * mp.quad(lambda t: mp.sin(omega * t) * mp.exp(start - t), [start, end / 2, end]) - 1

        exact = float(mp.findroot(unstable, (7.0, 7.3)))
    assert threshold(lambda a: overturns(a, 5.0), 7.0, 7.3) == pytest.approx(exact, rel=1e-11)
    assert exact == pytest.approx(7.168129, abs=5e-7)


@pytest.mark.parametrize(("omega", "a"), [(1, 1.322397), (3, 2.293872), (6, 3.788155), (10, 5.786522)])
def test_half_sine_overturning_without_impact(omega: float, a: float) -> None:
    """The flight stopped at half the pulse, where the ground becomes still: x + x' = 1 at the threshold."""

    def falls(amplitude: float) -> bool:
        slope = math.sqrt((amplitude - 1) * (amplitude + 1))
        start = math.atan2(1.0, slope)
        x, velocity, _ = state(flight(omega, amplitude, start, 0.0, 0.0, slope), (math.pi - start) / omega)
        return x + velocity > 1

    assert threshold(falls, 1.0001, 20.0) == pytest.approx(a, abs=5e-7)


@pytest.mark.parametrize(
    ("a", "omega", "printed", "true", "regime"),
    [
        (3.0, 2.5, 0.43, math.inf, Regime.OVERTURNS_WITHOUT_IMPACT),
        (10.0, 6.0, 0.46, math.inf, Regime.OVERTURNS_WITHOUT_IMPACT),
        (1.5, 4.0, 0.76, 0.45, Regime.CONTACT_DURING_PULSE),
    ],
)
def test_where_the_printed_equation_is_dangerous(
    a: float, omega: float, printed: float, true: float, regime: Regime
) -> None:
    """Three examples at η = 0.9, each to the two digits that are given."""
    assert printed_maximum(BLOCK, on_block(a, omega)) == pytest.approx(printed, abs=0.005)
    found = predicted(a, omega)
    assert found.rotation_ratio == pytest.approx(true, abs=0.005)
    assert found.regime is regime
    # at ω = 8 and a from 20 on the block is beyond φ_cr when the pulse ends, and 1 − D₀ < 0
    assert printed_maximum(BLOCK, on_block(20.0, 8.0)) < 0 or printed_maximum(BLOCK, on_block(24.0, 8.0)) < 0
