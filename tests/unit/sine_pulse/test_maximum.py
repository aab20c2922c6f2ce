"""The exact maximum under one sine pulse against step-by-step integration that shares no code with it."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.constants import g
from scipy.integrate import solve_ivp

from rocking.errors import PulseError
from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import Maximum, Regime, predict_maximum
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock

SYMMETRIC = EquivalentBlock(2.0, 0.25, 0.8, 0.9)
ASYMMETRIC = EquivalentBlock(1.7, 0.30, 0.9, 0.85, other_side=EquivalentBlock(2.4, 0.18, 0.7, 0.95))
ONE_SIDED = EquivalentBlock(2.2, 0.2, 1.1, 0.7, one_sided=True)


def pulse_on(block: EquivalentBlock, a: float, omega: float) -> Pulse:
    """The pulse of amplitude ratio a and frequency ratio ω on the block's positive side."""
    return Pulse(a * g * block.uplift_multiplier, omega * block.frequency_parameter)


def with_restitution(restitution: float) -> EquivalentBlock:
    return EquivalentBlock(2.0, 0.25, 0.8, restitution)


class Oracle:
    """DOP853 in rad and s with events for contact and peak, restarted at each; overturning by a rotation of 20 φ_cr.

    A block at rest is left there until the ground lifts it. An impact that leaves less than 1e-9 of p φ_cr is rest.
    """

    def __init__(self, block: EquivalentBlock, pulse: Pulse) -> None:
        self.block, self.pulse = block, pulse
        self.peak, self.impacts, self.peak_impacts, self.peak_side = 0.0, 0, 0, 0
        self.rests = 0

    def constants(self, s: int) -> EquivalentBlock:
        return self.block.other_side if s < 0 and self.block.other_side else self.block

    def lift(self, s: int, t: float) -> float:
        """φ''/(p² φ_cr) at φ = 0."""
        b = self.constants(s)
        inside = 0 <= t <= self.pulse.period
        ground = self.pulse.amplitude * math.sin(self.pulse.circular_frequency * t) if inside else 0.0
        return -1 - s * b.acceleration_scale / b.critical_rotation * ground / g

    def uplift(self, t: float) -> tuple[float, int] | None:
        """The next instant a fine grid, then bisection, finds a side lifted."""
        sides = (1,) if self.block.one_sided else (1, -1)
        grid = np.linspace(t, self.pulse.period, 4001) if t < self.pulse.period else []
        for low, high in pairwise(grid):
            for s in sides:
                if self.lift(s, low) > 0:
                    return float(low), s
                if self.lift(s, high) > 0:
                    for _ in range(60):
                        middle = (low + high) / 2
                        low, high = (low, middle) if self.lift(s, middle) > 0 else (middle, high)
                    return float(high), s
        return None

    def leg(self, s: int, start: float, end: float, state: np.ndarray, events: bool):
        b = self.constants(s)
        p2, scale = b.frequency_parameter**2, b.critical_rotation

        def motion(t, y):
            return [y[1], p2 * (y[0] + scale * self.lift(s, t))]

        contact = lambda t, y: y[0]  # noqa: E731
        crest = lambda t, y: y[1]  # noqa: E731
        fallen = lambda t, y: y[0] - 20 * scale  # noqa: E731
        contact.terminal = fallen.terminal = True
        contact.direction, crest.direction = -1, -1
        step = min(0.02 / b.frequency_parameter, 0.02 * self.pulse.period)
        return solve_ivp(
            motion, (start, end), state, "DOP853", events=(contact, crest, fallen) if events else None,
            rtol=1e-12, atol=1e-15, max_step=step if events else np.inf
        )  # fmt: skip

    def record(self, s: int, rotation: float) -> None:
        ratio = rotation / self.constants(s).critical_rotation
        if ratio > self.peak * (1 + 1e-8):  # equal peaks: the first
            self.peak = ratio
            self.peak_impacts, self.peak_side = self.impacts, s

    def run(self) -> "Oracle":
        lifted, t, s, state = False, 0.0, 0, np.zeros(2)
        after = 0
        while after < 3:
            if not lifted:
                start = self.uplift(t)
                if start is None:
                    return self
                (t, s), state, lifted = start, np.zeros(2), True
            b, period = self.constants(s), self.pulse.period
            while self.lift(s, t) >= 0 and t < period:  # pushed up: no contact is possible from here to there
                end = min(period, t + 0.01 * period)
                out = self.leg(s, t, end, state, events=False)
                t, state = end, out.y[:, -1]
            horizon = period if t < period else t + 60 / b.frequency_parameter
            out = self.leg(s, t, horizon, state, events=True)
            for crest in out.y_events[1]:
                self.record(s, crest[0])
            t, state = out.t[-1], out.y[:, -1]
            if state[0] > 19.9 * b.critical_rotation:
                self.peak, self.peak_impacts, self.peak_side = math.inf, self.impacts, s
                return self
            if out.t_events[0].size:
                self.impacts += 1
                after += t > period
                speed = b.restitution * abs(state[1])
                s = s if self.block.one_sided else -s
                lifted = speed > 1e-9 * b.frequency_parameter * b.critical_rotation
                self.rests += not lifted
                state = np.array([0.0, speed])
        return self


def check(block: EquivalentBlock, pulse: Pulse) -> Maximum:
    """Prediction equals integration. 1e-8: rtol 1e-12 times the growth e^{p t} ≤ e^9 within the pulses used here."""
    found, true = predict_maximum(block, pulse), Oracle(block, pulse).run()
    where = f"{block} {pulse} {found}"
    assert found.rotation_ratio == pytest.approx(true.peak, rel=1e-8), where
    assert found.peak_side == true.peak_side, where
    # a chain of impacts that dies out has no number of impacts
    assert found.impacts == true.peak_impacts or (true.rests and found.impacts < true.peak_impacts), where
    assert (found.overturning_margin < 0) == (found.outcome is Outcome.OVERTURNS), where
    return found


AMPLITUDES = (0.9, 1.02, 1.2, 1.5, 1.9, 2.4, 3.0, 4.5, 7.0, 10.0, 16.0)


@pytest.mark.parametrize("eta", [0.0, 0.5, 0.9])
@pytest.mark.parametrize("omega", [0.7, 1.3, 2.5, 4.0, 6.0, 11.0])
def test_symmetric_block_equals_integration(omega: float, eta: float) -> None:
    block = with_restitution(eta)
    regimes = {check(block, pulse_on(block, a, omega)).regime for a in AMPLITUDES}
    assert len(regimes) >= 3 and Regime.NO_UPLIFT in regimes and Regime.AFTER_FIRST_IMPACT not in regimes


@pytest.mark.parametrize("block", [ASYMMETRIC, ONE_SIDED], ids=["asymmetric", "one-sided"])
@pytest.mark.parametrize("sign", [1, -1])
def test_other_blocks_equal_integration(block: EquivalentBlock, sign: int) -> None:
    regimes = {
        check(block, pulse_on(block, sign * a, omega)).regime
        for omega in (1.5, 4.0, 7.0)
        for a in (0.8, 1.1, 1.3, 1.8, 2.5, 4.0, 6.0)
    }
    assert len(regimes) >= 4


def test_different_sides_largest_after_the_first_impact_have_their_own_regime() -> None:
    found = check(ASYMMETRIC, pulse_on(ASYMMETRIC, 2.5, 7.0))
    assert found.regime is Regime.AFTER_FIRST_IMPACT


@pytest.mark.parametrize(("eta", "a", "omega"), [(0.0, 1.5, 4.0), (0.7, 1.015, 0.2)])
def test_rest_during_the_pulse_then_uplift_again(eta: float, a: float, omega: float) -> None:
    """With η = 0 the first contact brings rest; with ω = 0.2 and a just above 1 a Zeno chain does."""
    block = with_restitution(eta)
    found = check(block, pulse_on(block, a, omega))
    assert found.regime is Regime.CONTACT_DURING_PULSE
    assert eta or found.overturning_margin < 1  # it is in the air when the pulse ends


def test_short_hop_on_a_side_with_a_small_critical_rotation_is_the_largest() -> None:
    """The pulse lifts only the large side, barely; what is a small hop there is a large share of the other's φ_cr."""
    small = EquivalentBlock(6.0, 0.008, 0.008 / 8.0, 0.4)
    block = EquivalentBlock(2.0, 0.3, 1.0, 0.5, other_side=small)
    found = check(block, pulse_on(block, -1.02, 6.0))
    assert (found.peak_side, found.impacts) == (-1, 1)


@pytest.mark.parametrize("a", [0.0, 0.5, 1.0, 1 - 1e-12])
def test_no_uplift_at_or_below_the_uplift_acceleration(a: float) -> None:
    found = predict_maximum(SYMMETRIC, pulse_on(SYMMETRIC, a, 3.0))
    assert found == Maximum(0.0, Outcome.NO_UPLIFT, Regime.NO_UPLIFT, 0, 0, 1.0)


def test_restitution_too_close_to_one_for_a_slow_pulse_is_said_and_not_guessed() -> None:
    found = predict_maximum(with_restitution(1.0), pulse_on(SYMMETRIC, 1.0000001, 1e-3))
    assert (found.outcome, found.regime) == (Outcome.FAILED, Regime.UNRESOLVED)
    assert math.isnan(found.rotation_ratio)
    assert "restitution" in found.regime.sentence


def test_ratios_that_no_structure_has_are_refused_with_the_bound() -> None:
    with pytest.raises(
        PulseError, match=r"circular_frequency over .* is 5\d+.0, but must lie between 1e-12 and"
    ):
        predict_maximum(SYMMETRIC, Pulse(10.0, 1e15))
    with pytest.raises(PulseError, match=r"amplitude over .* must be at most 1e\+12"):
        predict_maximum(SYMMETRIC, Pulse(1e200, 1.0))


@pytest.mark.parametrize("eta", [0.0, 1e-9, 0.9, 0.999])
def test_every_ratio_within_the_bounds_has_an_answer(eta: float) -> None:
    block = with_restitution(eta)
    for omega in (1e-11, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e11):
        for a in (1 + 3e-16, 1 + 1e-12, 1 + 1e-6, 1.3, 10.0, 1e6, 1e11):
            found = predict_maximum(block, pulse_on(block, a, omega))
            assert found.rotation_ratio >= 0, (a, omega)
            assert found.outcome is not Outcome.FAILED, (a, omega)
