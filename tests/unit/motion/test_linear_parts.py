"""The parts of the compiled exact response, each against arbitrary precision, a matrix exponential or a fine grid."""

import mpmath
import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from rocking.motion import linear_kernel
from rocking.motion.linear_kernel import Blocks
from tests.parts import callable_parts

kernel = callable_parts(linear_kernel)


@pytest.mark.parametrize("y", [1e-3, 0.05, 0.4, 0.999, 1.001, 3.0])
def test_weights_are_the_integrals_of_a_linear_drive(y: float) -> None:
    """q' = q + d and r' = −r − d, d from d₀ to d₁: each weight is ∫ exp(±(y − s)) times the share of that end."""
    with mpmath.workdps(30):
        y_ = mpmath.mpf(y)
        shares = [lambda s: 1 - s / y_, lambda s: s / y_]
        up = [mpmath.quad(lambda s, w=w: mpmath.exp(y_ - s) * w(s), [0, y_]) for w in shares]
        down = [mpmath.quad(lambda s, w=w: mpmath.exp(s - y_) * w(s), [0, y_]) for w in shares]
        expected = [mpmath.exp(y_), mpmath.exp(-y_), *up, *down]
    # what cancels between two weights of the same end costs digits as y gets small
    assert kernel._weights(y) == pytest.approx([float(value) for value in expected], rel=1e-15 / min(y, 0.1))


@pytest.mark.parametrize("y", [0.02, 0.7, 0.999, 1.001, 2.5])
def test_the_exact_step_is_the_matrix_exponential(y: float) -> None:
    rng = np.random.default_rng(1)
    for x, w, drive, ramp in rng.normal(size=(10, 4)).tolist():
        matrix = np.array([[0, 1, 0, 0], [1, 0, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0.0]])
        after = expm(matrix * y) @ [x, w, drive, ramp]
        found = kernel._exact(x, w, drive, ramp, y)
        assert found == pytest.approx((after[0], after[1], after[0] + after[2]), rel=1e-12, abs=1e-13)


def test_events_within_a_sample_are_those_on_a_fine_grid() -> None:
    """The first contact from above, and the largest turn before it."""
    rng, landed, turned = np.random.default_rng(2), 0, 0
    for _ in range(800):
        span = float(rng.choice([0.3, 1.5]))
        x, w = float(rng.uniform(0, 0.5)), float(rng.normal() * 0.8)
        drive, ramp = float(rng.normal() * 2), float(rng.normal() * 4)
        grid = np.linspace(0, span, 1501)
        states = np.array([kernel._exact(x, w, drive, ramp, float(y))[:2] for y in grid[::10]])
        places = grid[::10]
        below = np.flatnonzero(states[1:, 0] <= 0) + 1
        end = below[0] if below.size else places.size - 1
        turns = [k for k in range(end) if states[k, 1] > 0 >= states[k + 1, 1]]
        landing, peak, at = kernel._sample_events(x, w, drive, ramp, span)
        close = np.abs(states[1:, 0]).min() < 3e-3 or np.abs(np.diff(np.sign(states[:, 1]))).sum() > 2
        if close:  # the grid cannot tell a touch from a miss
            continue
        assert (landing > 0) == bool(below.size)
        if below.size:
            assert places[end - 1] <= landing <= places[end]
            assert abs(kernel._exact(x, w, drive, ramp, landing)[0]) < 1e-14 * max(1, abs(drive) + abs(ramp))
            landed += 1
        assert (peak > 0) == bool(turns)
        if turns:
            assert places[turns[0]] <= at <= places[turns[0] + 1]
            top = kernel._exact(x, w, drive, ramp, at)
            assert top[0] == pytest.approx(peak, rel=1e-14) and abs(top[1]) < 1e-13 * max(
                1, abs(drive) + abs(ramp)
            )
            turned += 1
    assert landed > 60 and turned > 60


MIRRORED = Blocks(np.array([2.0]), np.array([0.5]), np.array([0.2]), False)


def dies(speed: float, samples=(0.0, 0.5), tau=0.0, best=np.inf) -> bool:
    """Whether a chain of the block p = 2, φ_cr = 0.2, gλ = 2, η = 0.8 is proved to end."""
    return bool(
        kernel._dies_out(
            MIRRORED, np.array(samples), 1.0, 0.1, (0.7, 0.8), 0, tau, speed, np.array([best, best])
        )
    )


@pytest.mark.parametrize("tau", [0.0, 0.03])
def test_a_chain_of_impacts_is_over_when_its_flights_fit_into_the_time(tau: float) -> None:
    """d = φ_cr p² (1 − 1/16 − 0.25) = 0.55; Δ = 0.8 · 0.25/0.1 · 2v/d in time and p² v²/2d by rising."""
    d = 0.55

    def over(v: float) -> float:
        change = 2 * 2 * v / d + 4 * v * v / (2 * d)
        return 2 * v / d / (1 - 0.8 * (1 + change / (2 * d))) - (0.1 - tau)

    limit = brentq(over, 1e-6, 0.01)
    assert dies(0.9999 * limit, tau=tau) and not dies(1.0001 * limit, tau=tau)


def test_a_chain_that_could_grow_higher_than_the_peaks_is_followed() -> None:
    """It rises v²/2d at most; 1/16 of φ_cr is where the bounds end."""
    speed = 0.003
    share = speed**2 / 1.1 / 0.2
    assert dies(speed, best=1.001 * share) and not dies(speed, best=0.999 * share)
    assert not dies(1e-9, samples=(0.0, 1.88)) and dies(1e-9, samples=(1.87, 1.87))
