"""The parts of the compiled integration, each against what it claims: power series, roots, first crossings, proofs."""

import itertools
import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from rocking.motion import nonlinear_kernel
from rocking.motion.nonlinear_kernel import Ground, Member, Sides
from tests.parts import callable_parts

kernel = callable_parts(nonlinear_kernel)
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
@pytest.mark.parametrize("square", [0.0, 2.3])
def test_the_series_of_a_step_solves_the_equation_of_motion(side: int, square: float) -> None:
    for _ in range(20):
        k, j = int(RNG.integers(2)), int(RNG.integers(3))
        u, v, a0, a1, g0, g1 = RNG.normal(size=6).tolist()
        # A sine keeps a'' = −ω² a; samples are straight.
        push = [a0, a1]
        for n in range(2, 7):
            push.append(-square * push[n - 2] / (n * (n - 1)))
        expected = series(k, j, u, v, side, push, [g0, g1])
        found = np.array(kernel._series(PIECES, k, j, u, v, side, a0, a1, g0, g1, square, None, None))
        scale = 1e-11 * np.maximum.accumulate(np.abs(expected))
        assert (np.abs(found - expected) <= scale).all()
        if square == 0:
            short = kernel._short_series(PIECES, k, j, u, v, side * a0, side * a1, g0, g1, None, None, side)
            assert (np.abs(np.array(short) - expected[:6]) <= scale[:6]).all()


def test_displacement_speed_and_acceleration_are_one_polynomial() -> None:
    for _ in range(20):
        x, t = tuple(RNG.normal(size=8).tolist()), float(RNG.uniform(0, 1.5))
        way = Polynomial([0.0, *x])
        for function, degree in ((kernel._displacement, 0), (kernel._speed, 1), (kernel._acceleration, 2)):
            assert function(x, t) == pytest.approx(way.deriv(degree)(t) if degree else way(t), rel=1e-11)


def steps(count: int):
    """Random steps whose terms shrink: series, length, and the real zeros of the speed within."""
    for _ in range(count):
        h = 10 ** RNG.uniform(-1, 0.5)
        x = (
            RNG.normal(size=8)
            * 10 ** RNG.uniform(-1, 1, size=8)
            / np.array([math.factorial(n) for n in range(1, 9)])
        )
        zeros = Polynomial([0.0, *x]).deriv().roots()
        real = np.sort(zeros[np.abs(zeros.imag) < 1e-12].real)
        yield tuple(x.tolist()), h, real[(real > 0) & (real < h)]


def test_a_step_called_monotone_turns_once_at_most() -> None:
    found = [(kernel._monotone(x, h), zeros.size) for x, h, zeros in steps(3000)]
    assert all(size <= 1 for monotone, size in found if monotone)
    proved = sum(monotone for monotone, _ in found)
    turning = sum(monotone and size == 1 for monotone, size in found)
    assert proved > 900 and turning > 100 and any(size > 1 for _, size in found)


def test_the_way_within_a_step_is_bounded() -> None:
    """By the first four terms, the rest being small where a step is accurate."""
    for x, h, _ in steps(50):
        x = (*x[:4], 0.0, 0.0, 0.0, 0.0)
        way = max(abs(kernel._displacement(x, t)) for t in np.linspace(0, h, 200))
        assert way <= kernel._travel(x, h) * (1 + 1e-12)
    # Where all terms push one way the bound is the way itself.
    x = (1.0, 0.5, 0.25, 0.125, 0.0, 0.0, 0.0, 0.0)
    assert kernel._travel(x, 0.7) == pytest.approx(kernel._displacement(x, 0.7), rel=1e-14)


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
    near = np.tile([1.0, 1.0, 1.0, 1.0, 0.0, 0.0, np.inf], (2, 1))
    known = {
        "pieces": np.zeros((2, 1, 16)), "grid": np.zeros((2, 9)), "lift": np.array([[0.2, 0.8], [0.3, 1.1]]),
        "hold": zero, "critical": zero[:, 0], "end": zero[:, 0], "rest_speed": zero[:, 0],
        "longest_step": zero[:, 0], "near": near, "one_sided": one_sided,
    }  # fmt: skip
    return Sides(**(known | changes))


def ground(horizontal, vertical=None, step=0.1, omega=0.0, gravity=10.0) -> Ground:
    horizontal = np.asarray(horizontal, float)
    vertical = np.zeros_like(horizontal) if vertical is None else np.asarray(vertical, float)
    strongest = np.maximum.accumulate(np.abs(horizontal)[::-1])[::-1].copy()
    lightest = np.minimum.accumulate(vertical[::-1])[::-1].copy()
    return Ground(horizontal, vertical, strongest, lightest, step, omega, gravity)


MEMBER = Member(1.0, 1.0, (0.9, 0.8))


@pytest.mark.parametrize("one_sided", [False, True])
def test_the_first_uplift_is_the_first_crossing(one_sided: bool) -> None:
    """The positive side lifts where −0.8 ü_g > 0.2 (g + ü_v), the negative where 1.1 ü_g > 0.3 (g + ü_v)."""
    rng, sides, lifted = np.random.default_rng(3), plain_sides(one_sided), []
    for _ in range(300):
        motion = ground(rng.normal(size=6) * 2.5, rng.normal(size=6) * 2)
        member = Member(float(rng.choice([-1.0, 0.7, 1.3])), float(rng.choice([0.0, 1.0])), (1.0, 1.0))
        start, offset = int(rng.integers(4)), float(rng.choice([0.0, 0.03]))
        i, tau, side = kernel._uplift(sides, motion, member, start, offset, (0.0, 0.0))
        times = np.linspace(start * 0.1 + offset, 0.5, 40_001)
        push = member.horizontal * np.interp(times, np.arange(6) * 0.1, motion.horizontal)
        weight = 10 + member.vertical * np.interp(times, np.arange(6) * 0.1, motion.vertical)
        positive, negative = -0.8 * push - 0.2 * weight, 1.1 * push - 0.3 * weight
        margin = positive if one_sided else np.maximum(positive, negative)
        first = np.flatnonzero(margin > 0)
        assert (side == 0) == (first.size == 0)
        if side:
            assert i * 0.1 + tau == pytest.approx(times[first[0]], abs=2e-5)
            assert side == (1 if one_sided or positive[first[0]] >= negative[first[0]] else -1)
        lifted.append(side)
    assert lifted.count(1) > 50 and lifted.count(0) > 20 and (one_sided or lifted.count(-1) > 50)


@pytest.mark.parametrize("one_sided", [False, True])
def test_the_first_uplift_under_a_sine(one_sided: bool) -> None:
    sides, omega, seen = plain_sides(one_sided), 3.0, set()
    for amplitude, tau in itertools.product(
        (-9.0, -2.6, -2.0, 0.0, 2.0, 2.6, 2.7, 9.0), (0.0, 0.2, 0.7, 1.5, 2.0)
    ):
        found, side = kernel._uplift_sine(sides, amplitude, omega, 10.0, tau, (0.0, 0.0))
        times = np.linspace(tau, 2 * math.pi / omega, 40_001)
        push = amplitude * np.sin(omega * times)
        positive, negative = -0.8 * push - 2.0, 1.1 * push - 3.0
        margin = positive if one_sided else np.maximum(positive, negative)
        first = np.flatnonzero(margin > 1e-12)
        assert (side == 0) == (first.size == 0), (amplitude, tau)
        if side:
            assert found == pytest.approx(times[first[0]], abs=1e-4)
            assert side == (1 if positive[first[0]] > 0 else -1)
        seen.add(side)
    assert seen == ({0, 1} if one_sided else {0, 1, -1})


def dies(speed: float, samples=(0.0, 2.0), tau=0.0, best=np.inf, **near) -> bool:
    """Whether a chain is proved to end: g = 10, G̃ = B̃ = 1 near rest, η = 0.8."""
    values = {"arc": 1.0, "least": 1.0, "largest": 1.0, "push": 1.0, "bend": 0.0, "push_bend": 0.0} | near
    sides = plain_sides(near=np.tile([*values.values(), np.inf], (2, 1)))
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


def test_a_chain_that_could_grow_higher_than_the_peaks_is_followed() -> None:
    """It rises v²/2d at most, d = 8."""
    speed = 0.05
    rise = speed**2 / 16
    assert dies(speed, best=1.001 * rise) and not dies(speed, best=0.999 * rise)
    assert dies(speed, arc=1.001 * rise) and not dies(speed, arc=0.999 * rise)


def test_a_chain_may_gain_what_moments_vary_over_its_rise() -> None:
    """Flat ground of 2: Δ = (10 |G̃'| + 2 |B̃'|) v²/2d, here 16 v², or 32 v²; ρ = 0.8 (1 + Δ/16)."""
    for near, growth in (({"bend": 25.6}, 16.0), ({"push_bend": 128.0}, 16.0), ({"bend": 51.2}, 32.0)):

        def time(v: float, growth: float = growth) -> float:
            return 2 * v / 8 / (1 - 0.8 * (1 + growth * v**2 / 16))

        speeds = np.linspace(0.01, 0.4, 400)
        limit = speeds[[0 < time(v) < 0.1 for v in speeds]].max()
        assert dies(0.99 * limit, samples=(2.0, 2.0), **near)
        assert not dies(limit + 0.002, samples=(2.0, 2.0), **near)


def test_ground_that_can_lift_proves_nothing() -> None:
    assert not dies(1e-9, samples=(10.0, 0.0)) and dies(1e-9, samples=(9.9, 9.9))
    assert not dies(1e-9, samples=(0.0, 9.9), least=0.98) and not dies(1e-9, samples=(0.0, 9.9), push=1.02)


def test_the_strongest_push_to_come_is_measured_against_the_lightest_weight() -> None:
    motion, member = ground([1.0, -4.0, 2.0, 0.5], [0.0, 1.0, -2.0, 0.0]), Member(-0.5, 2.0, (0.9, 0.9))
    assert [kernel._excitation(motion, member, i) for i in range(4)] == pytest.approx(
        [2 / 6, 2 / 6, 1 / 6, 0.0]
    )
    assert kernel._excitation(motion, Member(0.1, 5.0, (0.9, 0.9)), 0) == np.inf
    assert kernel._over(motion, 3) and not kernel._over(motion, 2)
    sine = ground([3.0], omega=2.0)
    assert kernel._over(sine, 1) and not kernel._over(sine, 0)


@pytest.mark.parametrize("k", [0, 1])
def test_overturning_is_proved_where_nothing_to_come_can_hold_it(k: int) -> None:
    """hold is the acceleration over gravity that cannot bring the side back: at 3/10 it needs more than 3 of 10."""
    grid = np.zeros((2, 9))
    grid[:, 5] = 1.0  # one piece
    sides = plain_sides(grid=grid, hold=np.array([[0.3], [0.25]]), end=np.array([1.0, 1.0]))
    strength = 10 * sides.hold[k, 0]
    for factor, proved in ((0.999, True), (1.001, False)):
        motion = ground([0.0, -strength * factor, 1.0])
        for arc, speed, lost in ((0.5, 0.1, proved), (1.0, 0.1, True), (0.5, -0.1, False)):
            outward = kernel.Motion(0, 0.0, arc, speed, 1, arc, 0.1)
            assert kernel._lost(sides, kernel.memory(None), motion, MEMBER, k, outward) == lost


def test_what_drives_a_step() -> None:
    """Straight between samples; a sine with its slope; still ground at the end."""
    member, motion = Member(2.0, 0.5, (0.9, 0.9)), ground([1.0, 3.0, 2.0], [0.0, 1.0, 4.0])
    assert kernel._drive(motion, member, 1, 0.025) == pytest.approx((5.5, -20.0, 10.875, 15.0, 0.0))
    assert kernel._drive(motion, member, 2, 0.025) == (0.0, 0.0, 10.0, 0.0, 0.0)
    push, rate, weight, change, square = kernel._drive(ground([3.0], omega=2.0), member, 0, 0.4)
    assert (push, rate) == pytest.approx((6 * math.sin(0.8), 12 * math.cos(0.8)), rel=1e-14)
    assert (weight, change, square) == (10.0, 0.0, 4.0)


@pytest.mark.parametrize("room", [0, 2, 5])
def test_a_history_is_written_as_far_as_there_is_room(room: int) -> None:
    log, logged = np.full((room, 3), np.nan), 0
    for n in range(4):
        logged = kernel._write(log, logged, float(n), 10.0 * n, -1.0 * n)
    assert logged == (4 if room else 0), "how much room was needed"
    assert log[: min(room, 4)].tolist() == [[n, 10 * n, -n] for n in range(min(room, 4))]


def test_a_short_step_keeps_its_promises() -> None:
    """What it calls plain turns nowhere, stays in its piece, and has a tail within the tolerance."""
    plain = 0
    for x, h, _ in steps(3000):
        x, h = x[:6], h / 3
        arc, room = 0.8, 0.3
        accepted, new, pull = kernel._eventless(x, h, 0.1, arc, room, 1.0, 1.0, 1e-2)
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
