"""What stands on a support: its motion against a general solver, its limits, and the coupled system of two bodies."""

import math
from itertools import product

import numpy as np
import pytest
from coupled import Cases, largest_rotations
from scipy.integrate import solve_ivp

from rocking.errors import RecordError
from rocking.floors.kinds import FloorKind
from rocking.floors.support import INTERPOLATION_ERROR, RINGING, Mode, Support
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Block
from tests.refusals import refused

STEP = 0.01


def noise(seed=1, size=120):
    return Accelerogram(np.random.default_rng(seed).normal(0.0, 2.0, size), STEP, component="HNE")


def smooth(seed, cycles=9, seconds=4.0):
    """Sines of .5 to 4 Hz under one envelope, as strong motion is, m/s²."""
    rng = np.random.default_rng(seed)
    times = np.arange(round(seconds / STEP)) * STEP
    waves = sum(
        np.sin(2 * np.pi * rng.uniform(0.5, 4.0) * times + rng.uniform(0, 6.3)) for _ in range(cycles)
    )
    return Accelerogram(waves * np.sin(np.pi * times / seconds) ** 2, STEP, component="HNE")


def by_solver(support, record, after, finer):
    """The motion of the support by a general solver that starts anew at each sample of the record."""
    ground = np.append(record.acceleration, np.zeros(after))
    places = np.arange(finer + 1) / finer
    rigid = 1 - sum(mode.participation for mode in support.modes)
    motion = rigid * np.interp(
        np.arange((ground.size - 1) * finer + 1) / finer, np.arange(ground.size), ground
    )
    for mode in support.modes:
        omega, damping = 2 * math.pi / mode.period, mode.damping_ratio
        state = np.zeros(2)
        for k in range(ground.size - 1):

            def rates(t, y, k=k, omega=omega, damping=damping):
                a = ground[k] + (ground[k + 1] - ground[k]) * t / STEP
                return y[1], -2 * damping * omega * y[1] - omega**2 * y[0] - a

            found = solve_ivp(
                rates, (0, STEP), state, method="DOP853", rtol=1e-13, atol=1e-16, t_eval=places * STEP
            )
            absolute = -2 * damping * omega * found.y[1] - omega**2 * found.y[0]
            last = slice(None) if k == ground.size - 2 else slice(None, -1)
            motion[k * finer : (k + 1) * finer + 1][last] += mode.participation * absolute[last]
            state = found.y[:, -1]
    return motion


@pytest.mark.parametrize(
    "modes",
    [
        [Mode(period=0.3, damping_ratio=0.05, participation=1.3)],
        [Mode(period=0.05, damping_ratio=0.0, participation=1.0)],
        [Mode(period=1.2, damping_ratio=0.6, participation=-0.4)],
        [
            Mode(period=0.9, damping_ratio=0.03, participation=1.6),
            Mode(period=0.15, damping_ratio=0.05, participation=-0.7),
        ],  # a tower
    ],
)
def test_against_a_general_solver(modes):
    support, record = Support(tuple(modes)), noise()
    floor = support.motion(record)
    finer = round(record.time_step / floor.time_step)
    expected = by_solver(support, record, 10, finer)
    assert floor.acceleration.size > expected.size
    # the solver's own error, some 1e-11 m/s², is what is left
    assert floor.acceleration[: expected.size] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    "mode",
    [
        Mode(period=0.0, damping_ratio=0.05, participation=1.3),
        Mode(period=0.3, damping_ratio=0.05, participation=0.0),
    ],
)
def test_a_rigid_or_a_still_mode_gives_the_ground(mode):
    record, block = smooth(3), Block(semi_diagonal=0.5, slenderness=0.25)
    floor = Support((mode,)).motion(record)
    assert floor.acceleration == pytest.approx(record.acceleration, abs=1e-12)
    ours, grounds = (integrate(block, case).rotation_ratio for case in (floor, record))
    assert ours == pytest.approx(grounds, rel=1e-12)


def test_a_stiffer_support_comes_nearer_to_the_ground():
    # What a mode of short period has more than the ground is the jump of a' at each sample, rung by 1/ω.
    record = smooth(3)
    jumps = np.abs(np.diff(record.acceleration, n=2, prepend=0.0, append=0.0)).sum() / STEP
    for period in (0.2, 0.1, 0.05, 0.025):
        floor = Support((Mode(period=period, damping_ratio=0.1, participation=1.0),)).motion(record)
        finer = round(STEP / floor.time_step)
        beyond = np.abs(floor.acceleration[: record.acceleration.size * finer : finer] - record.acceleration)
        assert beyond.max() <= jumps * period / (2 * math.pi)


def test_lines_between_samples_hold_the_motion():
    support, record = Support((Mode(period=0.1, damping_ratio=0.05, participation=1.3),)), smooth(5)
    floor = support.motion(record)
    finer = round(STEP / floor.time_step)
    exact = by_solver(support, record, 2, 4 * finer)
    lines = np.interp(np.arange(exact.size) / 4, np.arange(floor.acceleration.size), floor.acceleration)
    assert np.abs(lines - exact).max() <= INTERPOLATION_ERROR * floor.peak_acceleration
    # and the record's own samples would not
    coarse = np.interp(
        np.arange(exact.size) / (4 * finer), np.arange(exact.size // (4 * finer) + 1), exact[:: 4 * finer]
    )
    assert np.abs(coarse - exact).max() > 20 * INTERPOLATION_ERROR * floor.peak_acceleration


def test_it_rings_on_until_that_cannot_matter():
    record = noise()
    for damping in (0.02, 0.1):
        floor = Support((Mode(period=0.5, damping_ratio=damping, participation=1.3),)).motion(record)
        last = round(0.5 / floor.time_step)
        # of one period the largest is within a cycle's decay of the envelope
        assert np.abs(floor.acceleration[-last:]).max() <= 1.2 * RINGING * floor.peak_acceleration * math.exp(
            2 * math.pi * damping
        )
        assert not floor.warnings
    undamped = Support((Mode(period=0.5, damping_ratio=0.0, participation=1.3),)).motion(record)
    assert undamped.warnings[-1].kind is FloorKind.STILL_RINGING


def test_components_share_their_samples_and_the_vertical_passes():
    first, second = noise(1), noise(2)
    vertical = Accelerogram(noise(4).acceleration, STEP, vertical=True)
    support = Support((Mode(period=0.2, damping_ratio=0.05, participation=1.3),))
    floors = support.motions((first, second, vertical))
    assert len({(floor.acceleration.size, floor.time_step) for floor in floors}) == 1
    finer = round(STEP / floors[2].time_step)
    own = floors[2].acceleration[::finer]
    assert np.array_equal(own[: vertical.acceleration.size], vertical.acceleration)
    assert not np.any(own[vertical.acceleration.size :])
    assert support.motion(vertical) is vertical
    # linear: the motion of the sum is the sum of the motions
    both = Accelerogram(first.acceleration + second.acceleration, STEP)
    together = support.motions((both, second))[0]
    places = np.arange(vertical.acceleration.size)
    total, parts = (
        [np.interp(places * STEP, record.times, record.acceleration) for record in group]
        for group in ((together,), floors[:2])
    )
    assert total[0] == pytest.approx(sum(parts), abs=1e-9)


def test_its_history_names_the_support():
    floor = Support((Mode(period=0.3, damping_ratio=0.05, participation=1.3),)).motion(noise())
    assert "T_b = 0.3 s, damping 0.05, Γψ = 1.3" in floor.processing[-1]
    assert floor.component == "HNE"


BODIES = [(0.8, 0.3), (0.4, 0.2), (1.5, 0.15), (2.5, 0.2), (4.0, 0.12)]
"""Half diagonal, m, and slenderness, rad."""


@pytest.mark.parametrize(
    "bodies, seconds",
    [(BODIES[:2], 1.0), pytest.param(BODIES, 4.0, marks=pytest.mark.slow)],
    ids=["two", "all"],
)
@pytest.mark.process
def test_rotation_of_the_coupled_system(bodies, seconds):
    """At a mass ratio of 1e-9 the body no longer pushes the support, and 1e-3 of the rotation is asked for."""
    record = smooth(8, seconds=seconds)
    periods, factors = (0.12, 0.2, 0.35, 0.6), (0.6, 1.2)
    rows, ours = [], []
    for (size, slenderness), period, factor in product(bodies, periods, factors):
        block = Block(semi_diagonal=size, slenderness=slenderness)
        floor = Support((Mode(period=period, damping_ratio=0.05, participation=1.0),)).motion(
            record.scaled(factor)
        )
        low, ratio, high = (
            integrate(block, floor.scaled(value)).rotation_ratio for value in (0.999, 1.0, 1.001)
        )
        # Well conditioned: a thousandth of the motion changes the rotation by less than a hundredth.
        if 0.01 < ratio < 1 and max(abs(low - ratio), abs(high - ratio)) < 0.01 * ratio:
            restitution = block.mechanism().sides[0].restitution
            rows.append((size, slenderness, restitution, period, 0.05, 1e-9, factor))
            ours.append(ratio)
    assert len(rows) >= 3 * len(bodies)
    theirs = largest_rotations(Cases(*np.array(rows).T), record.acceleration, STEP, seconds=2 * seconds)
    assert ours == pytest.approx(theirs, rel=1e-3)


@pytest.mark.parametrize(
    ("mode", "sentence"),
    [
        ((-0.1, 0.05, 1.0), "period is -0.1 s, but must be above 0, or 0 for a mode that is rigid."),
        (("0.3", 0.05, 1.0), "period is '0.3', but must be a number."),
        ((450.0, 0.05, 1.0), "period is 450.0 s, but must be at most 20 s, longer than that of any building"),
        ((0.3, -0.01, 1.0), "damping_ratio is -0.01, but must be"),
        ((0.3, 1.0, 1.0), "damping_ratio is 1.0, but must be"),
        ((0.3, 0.05, math.nan), "participation is nan, but must be a finite number."),
        ((0.3, 0.05, 150.0), "participation is 150.0, but must be from -20 to 20; give Γψ as a factor"),
        ((0.3, 0.05, None), "participation is None, but must be a number."),
    ],
)
def test_modes_that_cannot_be(mode, sentence):
    with pytest.raises(RecordError) as raised:
        Mode(period=mode[0], damping_ratio=mode[1], participation=mode[2])
    assert str(raised.value).startswith(sentence)


def test_supports_that_cannot_be():
    with refused(RecordError, "modes", ()):
        Support(())
    with refused(RecordError, "period", 0.015):
        Support((Mode(period=0.015, damping_ratio=0.05, participation=1.0),)).motion(noise())
    with refused(RecordError, "records"):
        Support((Mode(period=0.3, damping_ratio=0.05, participation=1.0),)).motions(
            (noise(), noise(2, size=100))
        )
    with pytest.raises(RecordError, match="samples, but may take 5000000; cut the record"):
        Support((Mode(period=0.02, damping_ratio=0.05, participation=1.0),)).motion(noise(size=100_000))
