"""Identities and limits that the prediction under one sine pulse must keep."""

import math
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.constants import g
from scipy.optimize import brentq

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import Regime, predict_maximum, printed_maximum
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock

BLOCK = EquivalentBlock(
    frequency_parameter=2.0, critical_rotation=0.25, acceleration_scale=0.8, restitution=0.9
)
AMPLITUDES = st.floats(-1, 1.5).map(lambda power: 10**power)
FREQUENCIES = st.floats(-0.7, 2).map(lambda power: 10**power)
RESTITUTIONS = st.floats(0, 0.95)


def on(block: EquivalentBlock, a: float, omega: float) -> Pulse:
    return Pulse(
        amplitude=a * g * block.uplift_multiplier, circular_frequency=omega * block.frequency_parameter
    )


@given(AMPLITUDES, FREQUENCIES, RESTITUTIONS)
def test_reversed_pulse_gives_the_mirrored_answer(a: float, omega: float, eta: float) -> None:
    block = replace(BLOCK, restitution=eta)
    here, there = predict_maximum(block, on(block, a, omega)), predict_maximum(block, on(block, -a, omega))
    assert here == replace(there, peak_side=-there.peak_side)


@given(AMPLITUDES, FREQUENCIES, RESTITUTIONS)
def test_another_side_that_is_the_same_changes_nothing_but_the_name_of_a_regime(
    a: float, omega: float, eta: float
) -> None:
    block = replace(BLOCK, restitution=eta)
    one = predict_maximum(block, on(block, a, omega))
    two = predict_maximum(replace(block, other_side=block), on(block, a, omega))
    if one.regime is Regime.PRINTED_EXACT:
        two = replace(two, regime=Regime.PRINTED_EXACT)
    assert one == two


@given(AMPLITUDES, FREQUENCIES, RESTITUTIONS, st.floats(0.1, 10), st.floats(0.01, 1), st.floats(0.1, 3))
def test_only_the_two_ratios_and_restitution_matter(
    a: float, omega: float, eta: float, p: float, critical: float, scale: float
) -> None:
    """In x = φ/φ_cr and p t every block is one problem. 1e-9: rounding of a and ω, magnified near overturning."""
    one = replace(BLOCK, restitution=eta)
    two = EquivalentBlock(
        frequency_parameter=p, critical_rotation=critical, acceleration_scale=scale, restitution=eta
    )
    first, second = predict_maximum(one, on(one, a, omega)), predict_maximum(two, on(two, a, omega))
    assume(abs(first.overturning_margin) > 1e-6 and abs(a - 1) > 1e-6)
    assert first.outcome is second.outcome
    assert first.rotation_ratio == pytest.approx(second.rotation_ratio, rel=1e-9)


@given(st.floats(0.45, 1.2).map(lambda power: 10**power), st.floats(1.5, 8.0), st.floats(0.65, 0.95))
@settings(
    suppress_health_check=[HealthCheck.filter_too_much], max_examples=settings.default.max_examples // 2
)
def test_equation_15_holds_exactly_in_its_regime(a: float, omega_over_a: float, eta: float) -> None:
    """To 1e-12 where it is well conditioned: d(1 − √(1 − y))/dy grows as 1/√(1 − y) towards overturning.

    Its regime is narrow: strong, brief pulses on a block that loses little, of which one in two is in it.
    """
    omega = omega_over_a * a
    block = replace(BLOCK, restitution=eta)
    pulse = on(block, a, omega)
    predicted = predict_maximum(block, pulse)
    assume(predicted.regime is Regime.PRINTED_EXACT)
    gap = max(1 - predicted.rotation_ratio, 1e-12)
    assert printed_maximum(block, pulse) == pytest.approx(predicted.rotation_ratio, rel=1e-12 / gap)


def test_equation_15_holds_for_a_one_sided_block_lifted_by_the_first_half() -> None:
    """Thrown back or thrown over: the rebound has the same height."""
    block = replace(BLOCK, one_sided=True)
    found = predict_maximum(block, on(block, -3.0, 5.0))
    assert (found.regime, found.peak_side, found.impacts) == (Regime.PRINTED_EXACT, 1, 1)
    assert printed_maximum(block, on(block, -3.0, 5.0)) == pytest.approx(found.rotation_ratio, rel=1e-12)


@given(AMPLITUDES, FREQUENCIES)
def test_no_restitution_leaves_no_rebound(a: float, omega: float) -> None:
    block = replace(BLOCK, restitution=0.0)
    found = predict_maximum(block, on(block, a, omega))
    assert found.regime not in (Regime.PRINTED_EXACT, Regime.AFTER_FIRST_IMPACT)


@given(st.floats(1.001, 100))
def test_a_pulse_of_infinite_length_overturns_whatever_it_lifts(a: float) -> None:
    """ω → 0: the force grows slower than the block falls, once it has had the time √(2(a − 1))/ω > 1 to do so."""
    found = predict_maximum(BLOCK, on(BLOCK, a, 1e-3))
    assert found.regime is Regime.OVERTURNS_WITHOUT_IMPACT


@pytest.mark.parametrize("omega", [1e3, 1e4, 1e5, 1e6])
def test_a_short_pulse_displaces_the_block_by_its_double_integral(omega: float) -> None:
    """ω → ∞, η = 0, a = 8: without time to fall x ω² at the pulse's end is ∬(a sin θ − 1), from θ = asin(1/a).

    That block is off the ground when the pulse ends, moving down. The error is of order 1/ω².
    """
    a = 8.0
    block = replace(BLOCK, restitution=0.0)
    start = math.asin(1 / a)
    slope = math.sqrt(a * a - 1)

    def velocity(theta: float) -> float:
        return slope - a * math.cos(theta) - (theta - start)

    top = brentq(velocity, 2.0, 2 * math.pi, xtol=1e-14)
    height = slope * (top - start) - a * (math.sin(top) - math.sin(start)) - (top - start) ** 2 / 2
    found = predict_maximum(block, on(block, a, omega))
    assert found.regime is Regime.BEFORE_FIRST_IMPACT
    assert found.rotation_ratio * omega**2 == pytest.approx(height, rel=20 / omega**2 + 1e-11)


@given(AMPLITUDES, FREQUENCIES, RESTITUTIONS)
def test_one_sided_block_pushed_to_its_wall_first_waits_for_the_second_half(
    a: float, omega: float, eta: float
) -> None:
    """It leaves its wall only where the second half exceeds λ, and always to the positive side."""
    block = replace(BLOCK, restitution=eta, one_sided=True)
    found = predict_maximum(block, on(block, a, omega))
    assert found.peak_side in (0, 1)
    lifts = abs(on(block, a, omega).amplitude) > g * block.uplift_multiplier
    assert (found.outcome is Outcome.NO_UPLIFT) == (not lifts)
