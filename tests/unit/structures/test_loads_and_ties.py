"""Façades and walls with loads, thrusts and ties: an oracle in positions and energy, limits, energy, refusals."""

from dataclasses import replace

import numpy as np
import pytest
from loaded import facade_lagrangian, wall_lagrangian

from rocking.quantities import GRAVITY
from rocking.structures import Block, Facade, Frame, LoadedWall, RigidBody, Wall
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import MotionState

TIES = {"tie_heights": (3.4, 6.4), "tie_stiffness": 8e3}
THRUST = {"thrust": 1.5e3, "thrust_height": 7.0}
LOADS = {"floor_loads": (12e3, 10e3, 5e3), "eccentricity": 0.1}
FACADE = Facade((3.5, 3.0, 2.5), (0.6, 0.5, 0.4), 20e3, **LOADS, **TIES, **THRUST, crack_storey=2)
LOADED = LoadedWall(
    2.0,
    1.4,
    0.3,
    19e3,
    top_load=9e3,
    eccentricity=0.08,
    tie_heights=(1.5, 2.6),
    tie_stiffness=20e3,
    restitution=0.5,
)


TIGHT = {"restitution": 0.5}
CASES = {
    "façade": (FACADE, facade_lagrangian),
    "façade, loads held": (replace(FACADE, loads_held=True), facade_lagrangian),
    "façade under a flat slab": (replace(FACADE, top_slab="flat"), facade_lagrangian),
    "façade, tightened": (
        replace(FACADE, **TIGHT, behind="cross_walls", tie_pretension=2e3),
        facade_lagrangian,
    ),
    "wall": (LOADED, wall_lagrangian),
    "wall, load held": (replace(LOADED, load_held=True), wall_lagrangian),
    "wall under a flat slab": (replace(LOADED, top_slab="flat"), wall_lagrangian),
    "wall, tightened": (replace(LOADED, **TIGHT, one_sided=True, tie_pretension=1e3), wall_lagrangian),
}


SIDES = [
    (case, sign)
    for case, (structure, _) in CASES.items()
    for sign in ((1.0,) if structure.mechanism().one_sided else (1.0, -1.0))
]


@pytest.mark.parametrize(("case", "sign"), SIDES)
def test_acceleration_is_that_of_positions_and_energy(case, sign):
    structure, lagrangian = CASES[case]
    mechanism = structure.mechanism()
    oracle = lagrangian(structure, sign)
    side = mechanism.sides[0 if sign > 0 else -1]
    for share, velocity, ground in ((0.05, 0.3, 1.7), (0.7, -0.8, -2.5)):
        rotation = share * min(side.critical_rotation, 0.4)
        # the façade's own coordinates keep x; the wall's oracle is mirrored with the side
        push = ground if lagrangian is facade_lagrangian else sign * ground
        expected = sign * oracle.acceleration(rotation, velocity, push, GRAVITY)
        found = mechanism.angular_acceleration(sign * rotation, sign * velocity, ground)
        assert float(found) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_places_velocities_and_accelerations_are_slopes_of_one_another(name):
    step = 1e-5
    for linkage in CASES[name][0].linkages:
        before, here, after = (linkage.motion(np.array([0.02 + k * step])) for k in (-1, 0, 1))
        slopes = (
            (after.centroids - before.centroids) / (2 * step),
            (after.velocities - before.velocities) / (2 * step),
        )
        np.testing.assert_allclose(slopes[0], here.velocities, rtol=1e-6, atol=1e-8)
        np.testing.assert_allclose(slopes[1], here.accelerations, rtol=1e-6, atol=1e-8)


def test_without_loads_a_facade_is_a_block_and_a_loaded_wall_a_wall():
    """To 1e-12, at zero and in the limit of vanishing loads and stiffness."""
    block, wall = Block.of_size(0.6, 6.0).mechanism(), Wall(2.0, 1.4, 0.3).mechanism()
    soft = {"tie_heights": (1.0,), "tie_stiffness": 1e-11}
    cases = [
        (Facade((6.0,), (0.6,), 20e3, **one_case), block)
        for one_case in ({}, soft | {"floor_loads": (1e-11,)})
    ]
    cases += [(LoadedWall(2.0, 1.4, 0.3, 19e3, **case), wall) for case in ({}, soft, {"top_load": 1e-11})]
    for structure, expected in cases:
        found = structure.mechanism()
        at = np.linspace(0, 1, 7) * expected.critical_rotation
        for side in found.sides:
            for name in ("inertia", "inertia_slope", "gravity", "gravity_slope", "ground"):
                values, bare = getattr(side, name)(at), getattr(expected.positive, name)(at)
                np.testing.assert_allclose(values, bare, rtol=0, atol=1e-12 * max(1, np.abs(bare).max()))
            assert side.critical_rotation == pytest.approx(expected.critical_rotation, rel=1e-12)
            assert side.restitution == pytest.approx(expected.restitution, rel=1e-12)


def test_under_a_flat_slab_a_facade_is_a_column_of_a_frame():
    column = Block.of_size(0.6, 6.0)
    frame = Frame(column, 2, 0.4).mechanism()
    facade = Facade((6.0,), (0.6,), 20e3, floor_loads=(0.4 * 20e3 * 3.6,), top_slab="flat").mechanism()
    for side in facade.sides:
        for name in ("uplift_multiplier", "critical_rotation", "frequency_parameter", "restitution"):
            assert getattr(side, name) == pytest.approx(getattr(frame.positive, name), rel=1e-12)


def test_the_beam_of_a_frame_is_drawn_over_all_columns_with_its_mass():
    *columns, beam = Frame(Block.of_size(1.0, 8.0), 3, 0.3).outline()
    sides = np.vstack(columns)[:, 0]
    left, base, right, top = *beam.min(axis=0), *beam.max(axis=0)
    assert (left, base, right) == pytest.approx((sides.min(), 8.0, sides.max()))
    assert (right - left) * (top - base) == pytest.approx(0.3 * 3 * 8.0)


@pytest.mark.parametrize("rotation", [0.0, 0.05, -0.05])
def test_marks_point_as_forces_do(rotation):
    """Loads down on the wall, the thrust outwards against it, ties from behind it to its outer face."""
    outlines = [outline @ [1, 1j] for outline in FACADE.outline(rotation)]
    behind = np.concatenate(outlines).real.min()
    marks = FACADE.marks(rotation)
    assert np.ptp([mark.line[0, 0] for mark in marks if mark.kind == "tie"]) < 1e-12, "one anchorage"
    for mark in marks:
        tail, head = mark.line
        across, down = head - tail
        assert across == 0 > down if mark.kind == "load" else across > 0 == down
        assert mark.kind != "tie" or tail[0] < behind
    # (kind, value) at (x, z) at rest, each load 0.1 m behind the middle of its storey; what is above the crack turns
    acting = {
        (-0.35, 6.5): ("load", "10 kN/m"),
        (-0.30, 9.0): ("load", "5 kN/m"),
        (0.0, 7.0): ("thrust", "1.5 kN/m"),
        (0.0, 3.4): ("tie", "8 kN/m²"),
        (0.0, 6.4): ("tie", "8 kN/m²"),
    }
    assert [(mark.kind, mark.text) for mark in marks] == list(acting.values())
    hinge = complex(-0.5 if rotation < 0 else 0.0, 3.5)
    places = np.array([complex(*place) for place in acting])
    turned = np.where(places.imag > 3.5, hinge + np.exp(-1j * rotation) * (places - hinge), places)
    assert [complex(*mark.line[1]) for mark in marks] == pytest.approx(turned.tolist(), abs=1e-12)
    for outline, thickness, low, high in zip(
        outlines, (0.6, 0.5, 0.4), (0, 3.5, 6.5), (3.5, 6.5, 9), strict=True
    ):
        corners = np.array([-thickness + 1j * low, 1j * low, 1j * high, -thickness + 1j * high])
        turns = hinge + np.exp(-1j * rotation) * (corners - hinge) if low else corners
        assert outline == pytest.approx(turns, abs=1e-12)


def second_derivative(path, step=4e-3):
    """Of a function of time at 0, by central differences of eighth order; truncation near 1e-13."""
    weights = {0: -205 / 72, 1: 8 / 5, 2: -1 / 5, 3: 8 / 315, 4: -1 / 560}
    return sum(weights[abs(k)] * path(k * step) for k in range(-4, 5)) / step**2


BODIES = {
    "block": Block(2.0, 0.2),
    "body": RigidBody(0.3, 0.5, 2.0, 1.4),
    "mirrored body": RigidBody(0.5, 0.3, 2.0, 1.4),
    **{name: case[0] for name, case in CASES.items() if name.startswith("façade")},
}


@pytest.mark.parametrize("name", BODIES)
def test_the_toe_carries_mass_times_acceleration_and_what_hangs_on_it(name):
    """Σ m (a + g) of the moving masses, differentiated along a motion, plus held weights and ties, less the thrust."""
    body, ground, vertical = BODIES[name], 1.7, -0.9
    sign = -1.0 if name.startswith("mirrored") else 1.0

    def rotation(time):
        return 0.05 + 0.02 * np.sin(3 * (time + 0.3))

    speed, turn = 0.06 * np.cos(0.9), -0.18 * np.sin(0.9)
    seen = RigidBody(0.3, 0.5, 2.0, 1.4) if sign < 0 else body
    masses = seen.linkages[0].masses
    pushed = masses @ (
        second_derivative(lambda time: seen.linkages[0].motion(rotation(time)).centroids)
        + ground
        + 1j * (vertical + GRAVITY)
    )
    if isinstance(body, Facade):
        held = sum(body.floor_loads[1:]) if body.loads_held else 0.0
        stretch = 2.9 * np.sin(rotation(0.0))  # the upper tie is 2.9 m above the crack, on the outer face
        tie = body.tie_pretension + body.tie_stiffness * stretch
        # bodies are in weights: forces times g
        pushed += 1j * held * (GRAVITY + vertical) + GRAVITY * tie - body.thrust * (GRAVITY + vertical)
    signed = sign * rotation(0.0), sign * speed, sign * turn, sign * ground
    found = body.contact_forces(MotionState.of(body.mechanism(), *signed, vertical))
    assert found.normal[0, 0] == pytest.approx(pushed.imag / masses.sum(), abs=1e-8)
    assert found.tangential[0, 0] == pytest.approx(pushed.real / masses.sum(), abs=1e-8)


@pytest.mark.parametrize("case", [case for case in CASES if case.startswith("wall")])
def test_the_lower_block_is_in_balance_under_the_force_at_the_hinge(case):
    """The hinge's force comes from the upper block; the moments of the lower one about the base must then vanish."""
    wall, _ = CASES[case]
    rotation, speed, ground = 0.04, 0.25, 1.3
    turn = float(wall.mechanism().angular_acceleration(rotation, speed, ground))
    found = wall.contact_forces(MotionState.of(wall.mechanism(), rotation, speed, turn, ground))
    motion = wall.linkages[0].motion(rotation)
    thrust = complex(found.normal[1, 0], found.tangential[1, 0]) * 1j * np.exp(0.5j * motion.angles[:2].sum())
    base, hinge = motion.hinges[:2]
    mass, radius = wall.lower_height / wall.height, np.hypot(wall.lower_height, wall.thickness) / 2
    arm = motion.centroids[0] - base
    # clockwise turn: the centre moves with −iφ'·arm
    acceleration = -1j * turn * arm - speed**2 * arm
    inertial = -mass * (acceleration + ground + 1j * GRAVITY)
    couple = mass * (wall.lower_height**2 + wall.thickness**2) / 12 * turn

    def moment(at, force):
        return (at - base).real * force.imag - (at - base).imag * force.real

    total = moment(motion.centroids[0], inertial) + couple + moment(hinge, -thrust)
    for height in wall.tie_heights:
        if height <= wall.lower_height:
            point = base + 1j * height * np.exp(-1j * rotation)
            force = wall.tie_pretension + wall.tie_stiffness * (point.real - wall.thickness / 2)
            total += moment(point, complex(-force * GRAVITY / wall.linkages[0].unit))
    assert abs(total) < 1e-10 * GRAVITY * radius


def test_a_wall_a_bulge_of_which_has_no_balance_relies_on_what_is_typed():
    ties = {"tie_heights": (2.9,), "tie_stiffness": 1e6, "tie_strength": 20e3}
    wall = LoadedWall.of_size(6.0, 0.35, 18e3, top_load=40e3, restitution=0.5, **ties)
    assert wall.restitution_of_geometry is None


@pytest.mark.parametrize("aside", [1e-9, -1e-9, 1e-7])
def test_a_tie_is_where_the_top_is_but_for_rounding(aside):
    """Between two heights that differ by rounding nothing moves by itself; at the foot a tie holds nothing."""
    of_size = {"tie_stiffness": 50e3, "tie_strength": 20e3, "restitution": 0.5}
    top = LoadedWall(1.6, 1.6, 0.25, 20e3, tie_heights=(3.2,), **of_size)
    beside = LoadedWall(1.6, 1.6, 0.25, 20e3, tie_heights=(3.2 - abs(aside),), **of_size)
    expected = [mechanism.uplift_multiplier for mechanism in top.mechanisms()]
    assert [mechanism.uplift_multiplier for mechanism in beside.mechanisms()] == pytest.approx(expected)
    front = Facade((3.2, 3.0), (0.5, 0.5), 20e3, tie_heights=(3.2 + aside,), **of_size)
    at_floor = replace(front, tie_heights=(3.2,))
    assert front.static_multiplier == at_floor.static_multiplier
    for wall in (top, front):
        at_foot = replace(wall, tie_heights=(abs(aside),))
        assert at_foot.static_multiplier == pytest.approx(wall.without_ties().static_multiplier)


def test_each_restitution_that_is_typed_below_its_balance_is_asked_again_alone():
    """The balance of a façade without loads is the same to both sides: 1 − 3 sin² α/2 of a slender block."""
    alpha = np.arctan2(0.5, 6.5)
    balance = 1 - 1.5 * np.sin(alpha) ** 2
    low = {"restitution": 0.5, "inward_restitution": 0.3}
    for typed in ({"restitution": 0.5, "inward_restitution": 0.995}, {"inward_restitution": 0.3}, low):
        front = Facade((3.5, 3.0), (0.5, 0.5), 20e3, **typed)
        own, livelier = front.restitution_of_geometry
        assert own == pytest.approx(balance)
        outwards = typed.get("restitution")
        expected = [balance if outwards is None else max(outwards, balance)]
        expected.append(max(typed["inward_restitution"], balance))
        assert [side.restitution for side in livelier.mechanism().sides] == pytest.approx(expected)
        assert front.cautions[-1].kind is StructureKind.RESTITUTION_TYPED
    near = (Facade((3.5, 3.0), (0.5, 0.5), 20e3, restitution=balance - apart) for apart in (0.049, 0.051))
    assert [wall.restitution_of_geometry is None for wall in near] == [True, False]
