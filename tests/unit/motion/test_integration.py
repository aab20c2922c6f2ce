"""The front door: what it accepts, what it says, what it refuses."""

from dataclasses import replace

import numpy as np
import pytest
from motion_cases import MECHANISMS, bisected, noise
from scipy.constants import g

from rocking.errors import MotionError
from rocking.motion import integrate
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Block, Facade, Outcome
from tests.refusals import refused

BLOCK = Block(1.0, 0.25, restitution=0.85)
RECORD = noise(1, 300, 0.01, 1.6 * g * BLOCK.mechanism().uplift_multiplier)


STILL, SLOW = Accelerogram(np.zeros(299), 0.01), Accelerogram(np.zeros(300), 0.02)


@pytest.mark.parametrize(
    "structure, motion, settings, field",
    [
        (BLOCK, RECORD, {"vertical": STILL}, "vertical"),
        (BLOCK, RECORD, {"vertical": SLOW}, "vertical"),
        (BLOCK, Pulse(amplitude=3.0, circular_frequency=6.0), {"vertical": STILL}, "vertical"),
        (BLOCK, RECORD, {"vertical": [0.0]}, "vertical"),
        (BLOCK, RECORD, {"initial_rotation": np.nan}, "initial_rotation"),
        (BLOCK, RECORD, {"initial_velocity": np.nan}, "initial_velocity"),
        (MECHANISMS["one side"], RECORD, {"initial_rotation": -0.01}, "initial_rotation"),
        (BLOCK, RECORD, {"initial_rotation": 2.0}, "initial_rotation"),
        ("a block", RECORD, {}, "structure"),
        (BLOCK, 3.0, {}, "motion"),
    ],
)
def test_what_cannot_be_followed_is_refused(structure, motion, settings, field):
    values = {"structure": structure, "motion": motion} | settings
    with refused(MotionError, field, values[field]):
        integrate(structure, motion, **settings)


@pytest.mark.parametrize("name", MECHANISMS)
@pytest.mark.parametrize("kind", ["mechanism", "equivalent block"])
def test_history_is_the_motion(name, kind):
    """An audit of every event: gap never negative, peaks and impacts as counted, η at each impact."""
    mechanism = MECHANISMS[name]
    structure = mechanism if kind == "mechanism" else mechanism.equivalent_block()
    record = noise(5, 400, 0.01, 1.4 * g * max(side.uplift_multiplier for side in mechanism.sides))
    silent, spoken = integrate(structure, record), integrate(structure, record, history=True)
    assert (silent.times, silent.rotation_ratio) == (None, spoken.rotation_ratio)
    times, rotation, velocity = spoken.times, spoken.rotation, spoken.angular_velocity
    assert np.all(np.diff(times) >= 0)
    assert np.all(np.isfinite(rotation)) and np.all(np.isfinite(velocity))
    if mechanism.one_sided:
        assert rotation.min() >= 0
    else:
        assert rotation.min() < 0 < rotation.max()

    landed = np.flatnonzero((np.diff(times) == 0) & (rotation[1:] == 0) & (velocity[:-1] != 0))
    assert landed.size == pytest.approx(spoken.impacts, abs=2)  # the last one may be followed by rest
    before, after = velocity[landed], velocity[landed + 1]
    eta = np.where(before < 0, mechanism.sides[0].restitution, mechanism.sides[-1].restitution)
    sign = -1 if mechanism.one_sided else 1
    assert after == pytest.approx(sign * eta * before, rel=1e-9)

    if spoken.outcome is Outcome.ROCKS:
        scale = {s: mechanism.sides[0 if s > 0 else -1].critical_rotation for s in (1, -1)}
        ratios = np.where(rotation >= 0, rotation / scale[1], -rotation / scale[-1])
        k = np.argmax(ratios)
        assert ratios[k] == pytest.approx(spoken.rotation_ratio, rel=1e-12)
        assert times[k] == pytest.approx(spoken.peak_time, abs=1e-12)
        assert np.sign(rotation[k]) == spoken.peak_side
        assert velocity[k] == pytest.approx(0, abs=1e-9)


def test_first_uplift_is_where_the_acceleration_crosses():
    """The straight line between two samples crosses λ g at a place that a hand can compute."""
    level = g * BLOCK.mechanism().uplift_multiplier
    record = Accelerogram(np.array([0.0, 0.4, 0.8, 1.6, 0.0, 0.0]) * level, 0.1)
    for structure in (BLOCK, BLOCK.mechanism().equivalent_block("uplift")):
        response = integrate(structure, record)
        assert response.uplift_time == pytest.approx(0.225, rel=1e-12)
        assert response.peak_side == -1  # thrown back against the ground's acceleration
        told = integrate(structure, record, history=True)
        (at) = np.flatnonzero(told.times == told.uplift_time)
        assert told.rotation[at] == told.angular_velocity[at] == 0


def test_sensitivity_against_a_wide_difference():
    """d ln φ_max / d ln a from an independent, fourth-order five-point difference of ten times the spacing."""
    for structure in (BLOCK.mechanism(), BLOCK.mechanism().equivalent_block()):
        found = integrate(structure, RECORD, sensitivity=True)
        step = 1e-4
        motions = [RECORD.scaled(np.exp(k * step)) for k in (-2, -1, 1, 2)]
        logs = [np.log(integrate(structure, motion, 1e-12).rotation_ratio) for motion in motions]
        truth = (logs[0] - 8 * logs[1] + 8 * logs[2] - logs[3]) / (12 * step)
        assert found.sensitivity == pytest.approx(truth, rel=1e-3)
        assert found.fragile is False


def test_fragile_verdicts_are_marked():
    """Half a percent on either side of the threshold found by bisection; two percent away it is not fragile."""

    def scaled(factor):
        return Pulse(amplitude=factor * g, circular_frequency=6.0)

    threshold = bisected(0.3, 5.0, lambda a: integrate(BLOCK, scaled(a)).outcome is Outcome.OVERTURNS)
    for factor, fragile in ((0.98, False), (0.995, True), (1.005, True)):
        response = integrate(BLOCK, scaled(threshold * factor), sensitivity=True)
        assert response.fragile is fragile
    assert integrate(BLOCK, scaled(threshold * 0.98), sensitivity=True, fragile_change=0.03).fragile is True
    assert integrate(BLOCK, scaled(threshold)).fragile is None


TIED = Facade(
    (3.2, 2.8), (0.6, 0.5), 20e3, (10e3, 5e3), 0.05, tie_heights=(3.1, 5.8), tie_stiffness=3e5, tie_strength=6e3,
    tie_plastic_elongation=0.03, restitution=0.85
)  # fmt: skip


@pytest.mark.parametrize("velocity", [-1e-3, -0.05, -0.3])
def test_a_tie_that_has_yielded_gives_back_no_more_than_its_elastic_energy(velocity):
    """A start inwards on the yielding tie lands alike, be the still ground sampled or a sine of next to nothing."""
    side = TIED.mechanism().positive
    stretched = max(tie.rotation(tie.tie.yield_stretch, side.end_rotation) for tie in side.ties) * 1.05
    start, arrivals = {"initial_rotation": stretched, "initial_velocity": velocity}, []
    for still in (Accelerogram(np.zeros(5000), 0.0005), Pulse(amplitude=1e-9, circular_frequency=6.0)):
        told = integrate(TIED, still, 1e-11, history=True, **start)
        arrivals.append(told.angular_velocity[(told.rotation == 0) & (told.angular_velocity != 0)][0])
    assert arrivals[0] == pytest.approx(arrivals[1], rel=1e-8)


@pytest.mark.parametrize("pretension", [0.0, 2e3])
def test_a_flight_back_against_ties_that_do_not_yield_lands_with_the_energy_it_had(pretension):
    """I ω²/2 = g ∫ G dφ from where it starts at rest, G with the pull of the ties."""
    wall = replace(TIED, tie_pretension=pretension, behind="cross_walls")
    side = wall.mechanism().positive
    start = 0.9 * min(tie.rotation(tie.tie.yield_stretch, side.end_rotation) for tie in side.ties)
    told = integrate(wall, STILL, 1e-11, history=True, initial_rotation=start)
    landing = told.angular_velocity[(told.rotation == 0) & (told.angular_velocity != 0)][0]
    nodes, weights = np.polynomial.legendre.leggauss(30)
    rotations = start * (nodes + 1) / 2
    fallen = start / 2 * weights @ side.gravity(rotations)
    assert side.at("inertia", 0.0) * landing**2 / 2 == pytest.approx(g * fallen, rel=1e-8)


def test_where_gravity_is_taken_away_the_response_says_that_bodies_would_fly():
    for share, says in ((0.9, False), (1.1, True)):
        lift = Accelerogram(np.where(np.arange(300) == 150, -share * g, 0.0), 0.01)
        assert bool(integrate(BLOCK, RECORD, vertical=lift).warning) is says
        assert bool(integrate(BLOCK.mechanism().equivalent_block(), RECORD, vertical=lift).warning) is says
