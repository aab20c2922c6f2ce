"""The table against direct evaluation of the mechanism's own functions."""

import numpy as np
import pytest
from motion_cases import MECHANISMS

from rocking.errors import MotionError
from rocking.motion import nonlinear_kernel
from rocking.motion.table import ACCURACY, table_of
from rocking.quantities import GRAVITY
from rocking.structures import Arch, Facade, Wall
from rocking.structures.mechanism import Mechanism, Side
from tests.parts import callable_parts
from tests.refusals import refused

_place = callable_parts(nonlinear_kernel)._place

EXTREMES = {
    "arch just above its minimum thickness": Arch(10.0, 1.07478038 * 1.0001, np.pi, restitution=0.9),
    "wall with a low hinge": Wall(0.03, 3.0, 0.3, restitution=0.8),
    "wall with a high hinge": Wall(3.0, 0.03, 0.02, restitution=0.8),
}
ALL = MECHANISMS | {name: structure.mechanism() for name, structure in EXTREMES.items()}


def evaluated(table, k, arc):
    """G̃ and B̃ of side k at each arc, by the pieces that the kernel would take."""
    pieces, grid = table.kernel.pieces, table.kernel.grid
    values = []
    for q in arc:
        j, centre, _ = _place(grid, k, q)
        powers = (q - centre) ** np.arange(8)
        values.append((powers @ pieces[k, j, 0::2], powers @ pieces[k, j, 1::2]))
    return np.array(values).T


@pytest.mark.parametrize("name", ALL)
def test_table_equals_direct_evaluation(name):
    """G̃ = G/√(I I(0)) and B̃ likewise, to 1e-12 of their maximum: the bound the table promises."""
    mechanism = ALL[name]
    table = table_of(mechanism)
    for k, side in enumerate(mechanism.sides):
        own = table.sides[k]
        rotation = np.concatenate([
            np.linspace(0, side.critical_rotation, 101),
            np.linspace(0, float(own.rotation(np.array(own.end))) * (1 - 1e-12), 101)
        ])  # fmt: skip
        found = evaluated(table, k, np.vectorize(own.arc)(rotation))
        scale = np.sqrt(side.inertia(rotation) * side.at("inertia", 0.0))
        for values, function in zip(found, (side.gravity, side.ground), strict=True):
            truth = function(rotation) / scale
            assert np.abs(values - truth).max() <= ACCURACY * np.abs(truth).max()


@pytest.mark.parametrize("name", ALL)
def test_hold_bounds_every_rotation_further_out(name):
    side, own = ALL[name].positive, table_of(ALL[name]).sides[0]
    rotation = np.linspace(0, float(own.rotation(np.array(own.end))), 501)
    balance = -side.gravity(rotation) / np.abs(side.ground(rotation))
    grid = table_of(ALL[name]).kernel.grid
    least = np.minimum.accumulate(balance[::-1])[::-1]
    for q, lowest in zip(np.vectorize(own.arc)(rotation), least, strict=True):
        j, _, _ = _place(grid, 0, q)
        assert own.kernel.hold[0, j] <= lowest + 1e-12


BRACED = Facade((6.0,), (0.6,), 20e3, tie_heights=(5.0,), tie_stiffness=3e5, tie_strength=6e3)


@pytest.mark.parametrize("name", [*ALL, "tied facade"])
def test_bounds_near_rest_hold_there(name):
    """Of G̃, B̃, their slopes and that of the pull of ties, g T D̃, over an arc that is a small part of φ_cr."""
    mechanism = (ALL | {"tied facade": BRACED.mechanism()})[name]
    table = table_of(mechanism)
    for k, side in enumerate(mechanism.sides):
        arc, least, largest, push, slope, push_slope, speed, tie_slope = table.kernel.near[k]
        assert 0 < arc < 0.1 * table.kernel.critical[k]
        arcs = np.linspace(0.0, arc, 301)
        gravity, ground = evaluated(table, k, arcs)
        assert least <= gravity.min() and gravity.max() <= largest and np.abs(ground).max() <= push
        for values, bound in ((gravity, slope), (ground, push_slope)):
            assert np.abs(np.diff(values)).max() <= bound * arcs[1] + 1e-15
        assert speed**2 / 2 == pytest.approx(GRAVITY * max(least, 0.0) * arc)
        rotations = table.sides[k].rotation(arcs)
        scale = np.sqrt(side.inertia(rotations) * side.at("inertia", 0.0))
        for tie in side.ties:
            pull = GRAVITY * tie.tie.tension(tie.stretch(rotations)) * tie.stretch_slope(rotations) / scale
            assert np.abs(np.diff(pull)).max() <= tie_slope * arcs[1]


def test_functions_with_a_kink_are_refused():
    def gravity(rotation):
        return 0.2 - rotation + 0.05 * np.abs(rotation - 0.1)

    ones = np.ones_like
    side = Side(
        inertia=ones,
        inertia_slope=np.zeros_like,
        gravity=gravity,
        gravity_slope=lambda r: -ones(r),
        ground=ones,
        critical_rotation=0.2,
        end_rotation=1.0,
        restitution=0.9,
    )
    with refused(MotionError, "mechanism"):
        table_of(Mechanism(side))


@pytest.mark.parametrize("name", MECHANISMS)
def test_rotations_of_arcs_are_those_of_the_integral_one_as_many(name):
    """q = ∫ √(I/I(0)) dφ, its slope and its inverse, to 1e-13; one rotation ratio is that of many to the last bit."""
    mechanism = MECHANISMS[name]
    for side, own in zip(mechanism.sides, table_of(mechanism).sides, strict=True):
        arcs = np.append(np.random.default_rng(5).uniform(0, own.end, 200), [0.0, 1e-9 * own.end])
        rotations = own.rotation(arcs)
        stretch = np.sqrt(side.inertia(rotations) / side.at("inertia", 0.0))
        assert own.slope(arcs) * stretch == pytest.approx(1, abs=1e-12)
        nodes, weights = np.polynomial.legendre.leggauss(40)
        inner = np.sqrt(side.inertia(rotations[:, None] * (nodes + 1) / 2) / side.at("inertia", 0.0))
        assert rotations * (inner @ weights / 2) == pytest.approx(arcs, rel=1e-13)
        assert [own.rotation_ratio(arc) for arc in arcs.tolist()] == own.rotation_ratios(arcs).tolist()


def test_the_frequency_of_a_taut_tie_is_that_of_a_spring_on_a_turning_block():
    """ω² = k z²/I about the toe, at rest, where the tie at height z is stretched fastest."""
    inertia = 20e3 / GRAVITY * 6.0 * 0.6 * (6.0**2 + 0.6**2) / 3
    law = table_of(BRACED.mechanism()).kernel.ties.law[0, 0]
    assert law[nonlinear_kernel.SQUARE] == pytest.approx(3e5 * 5.0**2 / inertia, rel=1e-12)
