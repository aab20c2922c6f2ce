"""The proof that a chain of impacts is over before the pulse can lift the block again, at its limits."""

import math

import pytest
from scipy.optimize import brentq

from rocking.sine_pulse import kernel
from rocking.sine_pulse.kernel import PulseSide
from tests.parts import callable_parts

_settles = callable_parts(kernel)._settles


def side(frequency: float, amplitude: float, restitution: float, scale: float = 1.0) -> PulseSide:
    return PulseSide(frequency, amplitude, restitution, scale, math.inf, True)


def limit(d: float, omega: float, steepest: float, restitution: float, room: float) -> float:
    """The v at which 8ωv/(d (1 − ρ²)) fills the phase that is left, ρ² = η₁η₂ (1 + 8aωv/d²)."""

    def over(v: float) -> float:
        shrink = restitution * (1 + 8 * steepest * v / d**2)
        return 8 * omega * v / d - room * (1 - shrink)

    return brentq(over, 0.0, 1.0, xtol=1e-15)


ALIKE = side(2.0, 0.5, 0.5)


def test_a_pulse_that_lifts_no_more_leaves_its_rest() -> None:
    """From 11π/6 on 0.5 |sin θ| stays below 1/4: d = 3/4. By hand: 64/3 v = π/6 (3/4 − 32/9 v), v = 0.016931."""
    phase, v = 11 * math.pi / 6, limit(0.75, 2.0, 1.0, 0.25, math.pi / 6)
    assert v == pytest.approx(math.pi / 8 / (64 / 3 + 16 * math.pi / 27), rel=1e-12)
    for sides in ((ALIKE, ALIKE), (ALIKE, ALIKE._replace(exists=False))):
        assert _settles(sides, phase, 0, v * 0.9999, 1.0, 2 * math.pi) == 2 * math.pi
        assert _settles(sides, phase, 0, v * 1.0001, 1.0, 2 * math.pi) == -1


def test_the_chain_must_end_halfway_to_the_next_uplift() -> None:
    """a = 2 lifts the second side at 7π/6: from π on that leaves π/12, in which 2 |sin θ| stays below 2 sin π/12."""
    one, d = side(1.0, 2.0, 0.6), 1 - 2 * math.sin(math.pi / 12)
    v = limit(d, 1.0, 2.0, 0.36, math.pi / 12)
    assert _settles((one, one), math.pi, 1, v * 0.9999, 1.0, 2 * math.pi) == pytest.approx(
        13 * math.pi / 12, rel=1e-14
    )
    assert _settles((one, one), math.pi, 1, v * 1.0001, 1.0, 2 * math.pi) == -1


def test_of_two_unlike_sides_the_worse_counts() -> None:
    """The speed of the side with the smaller scale, the faster pulse, the steeper force, both restitutions."""
    first, second, phase = side(1.0, 0.5, 0.5, 2.0), side(2.0, 0.3, 0.6, 1.0), 11 * math.pi / 6
    v = limit(0.75, 2.0, 0.6, 0.3, math.pi / 6)
    for index, share in ((0, 0.5), (1, 1.0)):
        assert _settles((first, second), phase, index, share * v * 0.9999, 1.0, 2 * math.pi) == 2 * math.pi
        assert _settles((first, second), phase, index, share * v * 1.0001, 1.0, 2 * math.pi) == -1


def test_a_chain_that_may_rise_above_the_peaks_is_followed() -> None:
    """It rises v²/d at most."""
    phase, v = 11 * math.pi / 6, 0.01
    assert _settles((ALIKE, ALIKE), phase, 0, v, 1.0001 * v * v / 0.75, 2 * math.pi) == 2 * math.pi
    assert _settles((ALIKE, ALIKE), phase, 0, v, 0.9999 * v * v / 0.75, 2 * math.pi) == -1
