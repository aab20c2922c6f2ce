"""Ties that yield, break and go slack: scipy's own events, energy, limits, words."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from loaded import facade_lagrangian, wall_lagrangian
from mpmath import mpf
from tied import Held, TiedBody

from rocking.motion import integrate
from rocking.motion.response import check_model
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Facade, LoadedWall
from rocking.structures.linkage import MotionState
from rocking.structures.mechanism import Mechanism, Tie

FACADE = Facade(
    (3.2, 2.8), (0.6, 0.5), 20e3, (10e3, 5e3), 0.05, tie_heights=(3.1, 5.8), tie_stiffness=3e5,
    tie_strength=6e3, tie_plastic_elongation=0.03, restitution=0.85,
)  # fmt: skip
TIGHTENED = replace(FACADE, behind="cross_walls", restitution=0.6, tie_pretension=2e3)
WALL = LoadedWall(
    2.0, 1.4, 0.3, 19e3, top_load=9e3, tie_heights=(1.5, 2.6), tie_stiffness=4e5, tie_strength=6e3,
    tie_plastic_elongation=0.015, restitution=0.85,
)  # fmt: skip
UNTIED = {"tie_heights": (), "tie_stiffness": 0.0, "tie_strength": None, "tie_plastic_elongation": 0.0}


def held(structure, sign):
    """Where masses and points of ties are on one side, seen in the mirror on the negative one."""
    facade = isinstance(structure, Facade)
    lagrangian = (facade_lagrangian if facade else wall_lagrangian)(structure, sign)
    mirror = [1, 1, sign if facade else 1, 1, 1]

    def places(phi):
        return np.array(lagrangian.places(mpf(phi)), dtype=float).T * np.array(mirror)[:, None]

    return Held(places, lambda phi: np.array(lagrangian.stretches(mpf(phi)), dtype=float))


def oracle(structure):
    signs = (1,) if structure.one_sided else (1, -1)
    return TiedBody(
        {sign: held(structure, sign) for sign in signs}, structure.tie_stiffness, structure.tie_pretension,
        np.inf if structure.tie_strength is None else structure.tie_strength, structure.tie_plastic_elongation,
        structure.restitution, len(structure.tie_heights),
    )  # fmt: skip


NEVER_LETS_GO = {"tie_strength": None, "tie_plastic_elongation": 0.0, "tie_stiffness": 2e5}
MOTIONS = {
    "façade": (FACADE, 3.2, 5.0),
    "façade, brittle": (replace(FACADE, tie_plastic_elongation=0.0), 3.0, 6.0),
    "façade, yields without end": (replace(FACADE, tie_plastic_elongation=9.0), 3.6, 5.0),
    "façade, tightened": (TIGHTENED, 4.0, 6.0),
    "wall": (WALL, 12.0, 8.0),
    "wall, brittle": (replace(WALL, tie_plastic_elongation=0.0), 11.0, 9.0),
}


@pytest.mark.parametrize("case", MOTIONS)
def test_every_flight_is_that_of_scipys_own_events(case):
    """Under one sine and after it: rotations at every state, and what has yielded and broken."""
    structure, amplitude, omega = MOTIONS[case]
    pulse = Pulse(amplitude=-amplitude, circular_frequency=omega)
    found = integrate(structure, pulse, 1e-11, history=True)
    lift = GRAVITY * structure.mechanism().positive.uplift_multiplier
    start = np.arcsin(lift / amplitude) / omega
    end = min(found.times[-1], start + 3.0, *found.times[np.abs(found.rotation) > 0.35])
    body = oracle(structure)

    def push(time):
        return -amplitude * np.sin(omega * time) if time < pulse.period else 0.0

    body.follow(push, lambda time: 0.0, [start, pulse.period, end])
    inside = (found.times > start) & (found.times <= end)
    expected, ours = body.at(found.times[inside]), found.rotation[inside]
    assert np.isfinite(expected).all() and inside.sum() > 30
    # scipy at 1e-11 over some tens of steps, and the growth of errors on the way to overturning
    np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-9)
    happened = {name for _, name, _ in body.events}
    assert "yield" in happened
    said = structure.tie_events(ours.max())
    for n, height in enumerate(structure.tie_heights):
        assert (f"tie at {height:g} m breaks" in said) == (body.mode[n] == "broken")
        assert (f"tie at {height:g} m yields" in said) == (body.plastic[n] > 0 and body.mode[n] != "broken")


def test_a_side_that_cannot_overturn_moves_as_any_other():
    """Flights of a wall on unbreakable ties against scipy's; inwards, where no tie holds it, it is the free wall."""
    both_ways = replace(WALL, **NEVER_LETS_GO)
    structure = replace(both_ways, one_sided=True)
    mechanism = structure.mechanism()
    assert not mechanism.can_overturn
    assert "cannot overturn" in repr(mechanism)
    assert both_ways.mechanism().can_overturn
    free = replace(WALL, **UNTIED).mechanism().sides[-1].critical_rotation
    assert both_ways.mechanism().negative.critical_rotation == pytest.approx(free, rel=1e-12)
    rotations = np.linspace(0, mechanism.positive.end_rotation, 2001)
    assert mechanism.positive.gravity(rotations).min() > 0
    pulse = Pulse(amplitude=-12.0, circular_frequency=8.0)
    found = integrate(structure, pulse, 1e-11, history=True)
    assert found.outcome == "rocks"
    start = np.arcsin(GRAVITY * mechanism.positive.uplift_multiplier / 12.0) / 8.0
    end = min(found.times[-1], start + 1.5)
    body = oracle(structure)
    body.follow(
        lambda time: -12.0 * np.sin(8.0 * time) if time < pulse.period else 0.0,
        lambda time: 0.0,
        [start, pulse.period, end],
    )
    inside = (found.times > start) & (found.times <= end)
    assert found.rotation[inside].max() > 0.01
    # scipy at 1e-11 over some tens of steps
    np.testing.assert_allclose(found.rotation[inside], body.at(found.times[inside]), rtol=0, atol=1e-9)


@pytest.mark.parametrize("case", ["façade", "façade, tightened"])
def test_vertical_motion_changes_weights_and_not_ties(case):
    """A record with its vertical component against scipy, restarted at every sample."""
    structure, step = MOTIONS[case][0], 0.05
    rng = np.random.default_rng(3)
    horizontal, vertical = rng.uniform(-4, 4, 40), rng.uniform(-6, 6, 40)
    horizontal[:4], vertical[:4] = [0.0, -3.5, -4.5, -4.0], 0.0
    record, lift = Accelerogram(horizontal, step), Accelerogram(vertical, step)
    found = integrate(structure, record, 1e-11, history=True, vertical=lift)
    times = np.arange(40) * step
    start = found.uplift_time
    body = oracle(structure)
    stops = [start, *times[times > start]]
    until = stops[-1] if found.outcome == "rocks" else found.times[-1]
    stops = [stop for stop in stops if stop < until] + [until]
    body.follow(*(lambda time, a=a: np.interp(time, times, a) for a in (horizontal, vertical)), stops)
    inside = (found.times > start) & (found.times <= until)
    assert inside.sum() > 20
    np.testing.assert_allclose(found.rotation[inside], body.at(found.times[inside]), rtol=0, atol=1e-8)


@pytest.mark.parametrize("heights", [(3.1,), (3.1, 5.8)], ids=["one tie", "two ties"])
@pytest.mark.parametrize("where", ["outwards", "inwards", "both ways"])
def test_a_pretension_holds_back_the_side_of_its_tie_alone(heights, where):
    """Uplift under a ramp each way: where push · a is weight · g and the pull of the pretension, by the oracle."""
    structure = replace(TIGHTENED, tie_heights=heights)
    tightened = structure.mechanism().positive
    free = replace(TIGHTENED, **UNTIED, tie_pretension=0.0).mechanism().positive
    sides = {"outwards": (tightened, free), "inwards": (free, tightened), "both ways": (tightened, None)}
    positive, negative = sides[where]
    mechanism = Mechanism(positive, negative)
    growth, times = 4.0, np.arange(200) * 0.01
    _, _, weight, push, _, pull = held(structure, 1).terms(0.0)
    for sign, side in ((1, positive), (-1, negative or positive)):
        hold = structure.tie_pretension * pull.sum() if side is tightened else 0.0
        expected = (weight * GRAVITY + hold) / push / growth
        response = integrate(mechanism, Accelerogram(-sign * growth * times, 0.01))
        # the oracle takes its slopes from polynomials of degree 40
        assert response.uplift_time == pytest.approx(expected, rel=1e-10), sign


def history(structure, motion):
    found = integrate(structure, motion, 1e-12, history=True)
    return found.rotation.max(), found.rotation.min(), found.impacts


def test_limits_of_the_strength():
    """Without end: the elastic tie. Next to none, or far too stiff and brittle: no tie. No elongation: brittle."""

    def alike(structure, expected, pulse, rel):
        critical = expected.mechanism().critical_rotation
        assert structure.mechanism().critical_rotation == pytest.approx(critical, rel=1e-12)
        assert history(structure, pulse) == pytest.approx(history(expected, pulse), rel=rel)

    elastic = replace(FACADE, tie_strength=None, tie_plastic_elongation=0.0, tie_stiffness=3e3)
    alike(replace(elastic, tie_strength=1e30), elastic, Pulse(amplitude=-1.9, circular_frequency=5.0), 1e-12)
    brittle = replace(FACADE, tie_plastic_elongation=0.0)
    for change in ({"tie_strength": 1e-12}, {"tie_strength": 1e-6, "tie_stiffness": 1e9}):
        alike(
            replace(brittle, **change),
            replace(FACADE, **UNTIED),
            Pulse(amplitude=-1.3, circular_frequency=5.0),
            1e-9,
        )
    alike(
        replace(FACADE, tie_plastic_elongation=1e-13),
        brittle,
        Pulse(amplitude=-3.0, circular_frequency=6.0),
        1e-9,
    )


@pytest.mark.parametrize("structure", [FACADE, WALL], ids=["façade", "wall"])
def test_acceleration_and_capacity_know_the_ties(structure):
    """φ'' before and after yielding from scipy's oracle; the load multiplier holds still what the curve says."""
    mechanism, body = structure.mechanism(), oracle(structure)
    held = body.sides[1]
    for rotation, largest in ((0.004, 0.004), (0.006, 0.012), (0.02, 0.02), (0.02, 0.2)):
        inertia, bend, weight, push, u, pull = held.terms(rotation)
        before = held.points(largest)
        tie = Tie(
            stiffness=structure.tie_stiffness,
            pretension=0.0,
            strength=structure.tie_strength,
            plastic_elongation=structure.tie_plastic_elongation,
        )
        plastic = np.maximum(before - tie.strength / tie.stiffness, 0.0)
        force = np.clip(tie.stiffness * (u - plastic), 0.0, tie.strength)
        force[plastic > tie.plastic_elongation] = 0.0
        expected = -(bend / 2 * 0.09 + weight * (GRAVITY + 0.4) + push * 1.1 + force @ pull) / inertia
        found = mechanism.angular_acceleration(rotation, 0.3, 1.1, 0.4, largest)
        assert float(found) == pytest.approx(expected, rel=1e-9)
    curve = structure.capacity_curve()
    still = mechanism.angular_acceleration(curve.rotation[1:], 0.0, -curve.multiplier[1:] * GRAVITY)
    np.testing.assert_allclose(still, 0.0, atol=1e-9 * GRAVITY)
    side = mechanism.positive
    assert {bend for bend in side.bends if bend < side.critical_rotation} <= set(curve.rotation)
    assert curve.multiplier.max() > 1.5 * curve.multiplier[0], "the ties' share of the capacity is in it"


def test_contacts_remember_what_yielded():
    """Horizontal force at the toe, which carries what the ties do not: less of it once they are broken."""
    found = FACADE.contact_forces(
        MotionState.of(FACADE.mechanism(), [0.006, 0.006], [0.0, 0.0], largest=[0.006, 0.3])
    )
    assert found.tangential[0, 0] < found.tangential[0, 1] - 0.01 * GRAVITY
    record = Accelerogram(-3.2 * np.sin(np.arange(400) / 20), 0.01)
    response = integrate(FACADE, record, history=True)
    assert check_model(FACADE, response, record).ties == FACADE.tie_events(response.rotation.max())
    assert FACADE.tie_events(response.rotation.max()) != ""


def test_the_critical_rotation_is_where_the_way_out_loses_its_hold():
    """Broken before the free wall's: the free wall's. Broken behind it: there, at once. Yielding: further out."""
    bare = replace(FACADE, **UNTIED).mechanism().critical_rotation
    assert FACADE.mechanism().critical_rotation == pytest.approx(bare, rel=1e-12)
    late = replace(FACADE, tie_heights=(5.8,), tie_plastic_elongation=1.2 * bare * 5.8)
    side = late.mechanism().positive
    yields = replace(late, tie_plastic_elongation=50.0).mechanism().positive
    assert bare < side.critical_rotation <= yields.critical_rotation
    within, beyond = (side.at("gravity", share * side.critical_rotation) for share in (0.999, 1))
    assert beyond <= 0 < within
    assert yields.at("gravity", yields.critical_rotation) == pytest.approx(0.0, abs=1e-12)
    assert side.frequency_parameter > 0 and yields.frequency_parameter > 0


@pytest.mark.parametrize("stiffness", [4e5, 4e7, 4e9])
def test_the_defect_of_the_block_knows_a_tie_that_breaks_at_once(stiffness):
    """However early it breaks, it held until then: its defect is that of a tie that yields by a hair first."""
    brittle, hair = (
        replace(WALL, tie_stiffness=stiffness, tie_plastic_elongation=value)
        .mechanism()
        .block_defects.restoring
        for value in (0.0, 1e-9)
    )
    assert 0.1 < brittle == pytest.approx(hair, rel=1e-3)


@pytest.mark.parametrize("height", [3.4, 3.4 - 1e-9, 1e-9])
def test_a_tie_where_nothing_moves_does_nothing(height):
    """At the top that the floor holds, or at the foot: its motion is rounding, and its strength holds nothing back."""
    free, still = replace(WALL, **UNTIED), replace(WALL, tie_heights=(height,))
    found, expected = (
        history(case, Pulse(amplitude=-6.0, circular_frequency=8.0))[:2] for case in (still, free)
    )
    assert expected[0] > 1e-3
    assert found == pytest.approx(expected, rel=1e-6)  # what a strength of .07 weights does over 1e-9 m
    assert still.tie_events(found[0]) == ""


@pytest.mark.parametrize("share", [0.09, 0.12, 0.15])
def test_a_tie_tells_by_how_much_it_yielded(share):
    """How far its point goes, h sin φ but for the small way back about the toe, less what it stretches elastically."""
    rotation = share * FACADE.mechanism().critical_rotation
    (height, _), yields = FACADE.tie_heights, FACADE.tie_strength / FACADE.tie_stiffness
    expected = height * math.sin(rotation) - yields
    assert 0 < expected < FACADE.tie_plastic_elongation
    (told, whole) = re.search(
        r"tie at 3.1 m yields by (\S+) m of (\S+) m", FACADE.tie_events(rotation)
    ).groups()
    assert float(told) == pytest.approx(
        expected, abs=2e-4
    )  # b (1 - cos φ) of the toe's 0.6 m, and three digits
    assert float(whole) == FACADE.tie_plastic_elongation
