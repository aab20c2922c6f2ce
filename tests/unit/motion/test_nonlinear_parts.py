"""The parts of the compiled integration, each against what it claims: power series, roots, first crossings, proofs."""

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from rocking.motion import nonlinear_kernel
from rocking.motion.nonlinear_kernel import GroundSamples, Member, Sides
from tests.parts import callable_parts

kernel = callable_parts(nonlinear_kernel)
FACTORIALS = np.array([math.factorial(n) for n in range(1, 9)])
RNG = np.random.default_rng(5)
PIECES = RNG.normal(size=(2, 3, 16))


def powers(k: int, j: int, which: int, u: float) -> Polynomial:
    """G̃ (which 0) or B̃ (1) of a piece by powers of the distance from the place u."""
    return Polynomial(PIECES[k, j, which::2])(Polynomial([u, 1.0]))


def series(k, j, u, v, side, push, gravity) -> np.ndarray:
    """Taylor coefficients 1 to 8 of q from q'' = −G̃(q) (g + ü_v) − s B̃(q) ü_g, one after the other."""
    moments = powers(k, j, 0, u), powers(k, j, 1, u)
    arc = np.array([0.0, v])
    for n in range(7):
        way = Polynomial(arc)
        force = -moments[0](way) * Polynomial(gravity) - side * moments[1](way) * Polynomial(push)
        arc = np.append(arc, np.append(force.coef, np.zeros(9))[n] / ((n + 1) * (n + 2)))
    return arc[1:]


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("kind", ["line", "sine", "curve"])
def test_the_series_of_a_step_solves_the_equation_of_motion(side: int, kind: str) -> None:
    """A sine keeps a'' = −ω² a and goes on, lines join samples, and a curve ends with its fifth power."""
    for _ in range(20):
        k, j = int(RNG.integers(2)), int(RNG.integers(3))
        u, v, a0, a1, g0, g1 = RNG.normal(size=6).tolist()
        push = [a0, a1, *RNG.normal(size=4).tolist(), 0.0]
        for n in range(2, 7):
            if kind != "curve":
                square = 2.3 if kind == "sine" else 0.0
                push[n] = -square * push[n - 2] / (n * (n - 1))
        expected = series(k, j, u, v, side, push, [g0, g1])
        found, alone = kernel._series(PIECES, k, j, u, v, side, a0, a1, g0, g1, tuple(push[2:]), None, None)
        scale = 1e-11 * np.maximum.accumulate(np.abs(expected))
        assert (np.abs(np.array(found) - expected) <= scale).all()
        if kind == "sine":
            continue
        bent = tuple(side * item for item in push[2:]) if kind == "curve" else None
        short, (fifth, sixth, beyond) = kernel._short_series(
            PIECES, k, j, u, v, side * a0, side * a1, g0, g1, None, None, side, bent
        )
        assert (np.abs(np.array(short[:6]) - expected[:6]) <= scale[:6]).all()
        # What the ground pushes by itself, B̃ at the place times each power of the time, is left out of the bounds.
        pushed = side * powers(k, j, 1, u)(0.0) * np.array(push)
        assert short[6] == pytest.approx(-pushed[5] / 42, rel=1e-9, abs=1e-15)
        assert alone == pytest.approx(-pushed[5] / 42, rel=1e-9, abs=1e-15)
        assert fifth == pytest.approx(abs(expected[4] + pushed[3] / 20), rel=1e-7, abs=1e-11)
        assert sixth == pytest.approx(abs(expected[5] + pushed[4] / 30), rel=1e-7, abs=1e-11)
        assert beyond >= 0


def steps(count: int):
    """Random steps whose terms shrink: series, length, and the real zeros of the speed within."""
    for _ in range(count):
        h = 10 ** RNG.uniform(-1, 0.5)
        x = RNG.normal(size=8) * 10 ** RNG.uniform(-1, 1, size=8) / FACTORIALS
        zeros = Polynomial([0.0, *x]).deriv().roots()
        real = np.sort(zeros[np.abs(zeros.imag) < 1e-12].real)
        yield tuple(x.tolist()), h, real[(real > 0) & (real < h)]


def test_a_step_called_monotone_turns_once_at_most() -> None:
    found = [(kernel._monotone(x, h), zeros.size) for x, h, zeros in steps(3000)]
    assert all(size <= 1 for monotone, size in found if monotone)
    proved = sum(monotone for monotone, _ in found)
    turning = sum(monotone and size == 1 for monotone, size in found)
    assert proved > 900 and turning > 100 and any(size > 1 for _, size in found)


def test_turns_and_landings_are_the_zeros() -> None:
    turned = landed = 0
    for plain, h, zeros in steps(2000):
        x = tuple(map(np.float64, plain))  # which divide by zero as compiled numbers do
        if zeros.size != 1 or not kernel._monotone(x, h):
            continue
        speed, pull, arc = x[0], kernel._speed(x, h), float(RNG.uniform(0, 0.3))
        new = arc + kernel._displacement(x, h)
        turn, landing = kernel._events(x, h, arc, speed, new, pull)
        assert turn == pytest.approx(zeros[0], rel=1e-9)
        turned += 1
        heights = Polynomial([arc, *x]).roots()
        down = np.sort([z.real for z in heights if abs(z.imag) < 1e-12 and 0 < z.real <= h])
        # from above the ground to below it, or through it and up again
        first = next((z for z in down if kernel._speed(x, z) < 0), None)
        assert (landing < 0) == (first is None)
        if first is not None:
            assert landing == pytest.approx(first, rel=1e-9)
            landed += 1
    assert turned > 200 and landed > 50


def plain_sides(one_sided: bool = False, **changes) -> Sides:
    """Sides that need no table: G̃(0) = 0.2 and 0.3, B̃(0) = 0.8 and 1.1."""
    zero = np.zeros((2, 1))
    near = np.tile([1.0, 1.0, 1.0, 1.0, 0.0, 0.0, np.inf, 0.0], (2, 1))
    known = {
        "pieces": np.zeros((2, 1, 16)), "grid": np.zeros((2, 9)), "lift": np.array([[0.2, 0.8], [0.3, 1.1]]),
        "hold": zero, "critical": zero[:, 0], "end": zero[:, 0], "rest_speed": zero[:, 0],
        "longest_step": zero[:, 0], "near": near, "one_sided": one_sided
    }  # fmt: skip
    return Sides(**(known | changes))


def ground(horizontal, vertical=None, step=0.1, omega=0.0, gravity=10.0) -> GroundSamples:
    horizontal = np.asarray(horizontal, float)
    vertical = np.zeros_like(horizontal) if vertical is None else np.asarray(vertical, float)
    strongest = np.maximum.accumulate(np.abs(horizontal)[::-1])[::-1].copy()
    lightest = np.minimum.accumulate(vertical[::-1])[::-1].copy()
    return GroundSamples(horizontal, vertical, strongest, lightest, step, omega, gravity)


MEMBER = Member(1.0, 1.0, (0.9, 0.8))


def dies(speed: float, samples=(0.0, 2.0), tau=0.0, best=np.inf, **near) -> bool:
    """Whether a chain is proved to end: g = 10, G̃ = B̃ = 1 near rest, η = 0.8."""
    values = {"arc": 1.0, "least": 1.0, "largest": 1.0, "push": 1.0, "bend": 0.0, "push_bend": 0.0} | near
    held = values.pop("tie_bend", 0.0)
    sides = plain_sides(near=np.tile([*values.values(), np.inf, held], (2, 1)))
    member = Member(1.0, 1.0, (0.7, 0.8))
    return bool(kernel._dies_out(sides, ground(samples), member, 0, tau, speed, np.array([best, best])))


def test_a_chain_of_impacts_is_over_when_its_flights_fit_into_the_time() -> None:
    """d = 10 − 2 = 8, Δ = 2/0.1 · 2v/d = 5 v, ρ = 0.8 (1 + 5v/16): 2v/8/(1 − ρ) = 0.1 at v = 0.02/0.275."""
    limit = 0.02 / 0.275
    assert dies(0.999 * limit) and not dies(1.001 * limit)
    # With 0.02 s gone there are 0.08 left: v (0.25 + 0.08 · 0.25) = 0.016.
    limit = 0.016 / 0.27
    assert dies(0.999 * limit, tau=0.02) and not dies(1.001 * limit, tau=0.02)
    # Two samples, of which the second is flat: the same bounds hold for 0.2 s. v (0.25 + 0.05) = 0.04.
    limit = 0.04 / 0.3
    assert dies(0.999 * limit, samples=(0.0, 2.0, 2.0)) and not dies(1.001 * limit, samples=(0.0, 2.0, 2.0))


def test_a_chain_is_followed_where_restoring_changes_with_the_place() -> None:
    """Δ = 5 v + (400 · 10 + 2 000 · 2 + 8 000) v²/16: 0.25 v = 0.1 (0.2 − 0.05 Δ), and in 5 v² + 0.275 v = 0.02."""
    limit = (math.sqrt(0.275**2 + 4 * 5 * 0.02) - 0.275) / 10
    bends = {"bend": 400.0, "push_bend": 2000.0, "tie_bend": 8000.0}
    assert dies(0.999 * limit, **bends) and not dies(1.001 * limit, **bends)


def test_a_chain_that_could_grow_higher_than_the_peaks_is_followed() -> None:
    """It rises v²/2d at most, d = 8."""
    speed = 0.05
    rise = speed**2 / 16
    assert dies(speed, best=1.001 * rise) and not dies(speed, best=0.999 * rise)
    assert dies(speed, arc=1.001 * rise) and not dies(speed, arc=0.999 * rise)


@pytest.mark.parametrize("k", [0, 1])
def test_overturning_is_proved_where_nothing_to_come_can_hold_it(k: int) -> None:
    """hold is the acceleration over gravity that cannot bring the side back: at 3/10 it needs more than 2.4 of 8.

    Both components are doubled, so that gravity is 10 − 2 · 1 at the least.
    """
    grid = np.zeros((2, 9))
    grid[:, 5] = 1.0  # one piece
    sides = plain_sides(grid=grid, hold=np.array([[0.3], [0.25]]), end=np.array([1.0, 1.0]))
    strength = 8 * sides.hold[k, 0] / 2
    member = Member(2.0, 2.0, (0.9, 0.8))
    for factor, proved in ((0.999, True), (1.001, False)):
        motion = ground([0.0, -strength * factor, 0.5], [0.0, 0.0, -1.0])
        for arc, speed, lost in ((0.5, 0.1, proved), (1.0, 0.1, True), (0.5, -0.1, False)):
            outward = kernel.RockingState(0, 0.0, arc, speed, 1, arc, 0.1)
            assert kernel._lost(sides, np.zeros((2, 8)), motion, member, k, outward) == lost


def test_a_short_step_keeps_its_promises() -> None:
    """What it calls plain turns nowhere, stays in its piece, and has a tail within the tolerance."""
    plain = 0
    for x, h, _ in steps(3000):
        x, h = x[:7], h / 3
        arc, room = 0.8, 0.3
        bounds = abs(x[4]), abs(x[5]), abs(x[6])
        accurate, quiet, new, pull, spare = kernel._eventless(
            tuple(x), bounds, h, 0.1, arc, room, 1.0, 1.0, 1e-2
        )
        accepted = accurate and quiet
        assert accurate or not spare
        way = Polynomial([arc, *x])
        assert (new, pull) == pytest.approx((way(h), way.deriv()(h)), rel=1e-9, abs=1e-12)
        if not accepted:
            continue
        plain += 1
        speeds, arcs = way.deriv()(np.linspace(0, h, 60)), way(np.linspace(0, h, 60))
        assert (speeds * x[0] > 0).all() and np.abs(arcs - arc).max() <= room
        farthest, fastest = max(1.0, new), max(1.0, abs(pull))
        assert abs(x[5]) * h**6 <= 1e-3 * farthest and 6 * abs(x[5]) * h**5 <= 1e-3 * fastest
    assert 100 < plain < 2900
