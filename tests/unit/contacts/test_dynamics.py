"""Stacks of rigid courses by contact dynamics, held against mechanisms, closed forms, energy, statics and symmetry."""

from dataclasses import replace

import numpy as np
import pytest

from rocking import (
    Accelerogram,
    Block,
    Facade,
    Frame,
    LoadedWall,
    MotionError,
    Pulse,
    RigidBody,
    Spire,
    StructureError,
    Wall,
    integrate,
)
from rocking.contacts.dynamics import follow_stack
from rocking.quantities import GRAVITY
from rocking.structures.joints import Joints
from rocking.structures.stack import Course, Stack, courses_between, joined
from tests.refusals import refused

HINGED = LoadedWall.of_size(3.2, 0.35, 18e3, 1.6, top_load=1000.0, top_slab="flat", crack="known")
FIRM = Joints(5.0)
"""Joints in which no anchor of a tie slides out."""
BEARING = {"top_load": 3000.0, "eccentricity": 0.05, "crack": "known"}
TIE = {"tie_heights": (6.0,), "tie_stiffness": 50e3, "tie_strength": 40e3}
YIELDING = {
    "tie_heights": (6.0,),
    "tie_stiffness": 500e3,
    "tie_strength": 5e3,
    "tie_plastic_elongation": 0.5,
}


def bodies_of(structure) -> Stack:
    """The bodies of its mechanism: of a wall that is held all courses joined, which open between its holds else."""
    stack = structure.stack()
    if not isinstance(structure, Facade) or not structure.tie_heights:
        return stack
    return Stack((joined(stack.courses),), tuple(replace(fastening, course=0) for fastening in stack.held))


def sampled(pulse: Pulse) -> Accelerogram:
    """The pulse in a hundred samples, and still ground."""
    step = pulse.period / 100
    samples = pulse.acceleration(np.arange(101) * step)
    return Accelerogram(np.append(samples, np.zeros(2)), step)


@pytest.mark.parametrize(
    "structure",
    [
        Block.of_size(0.8, 4.0),
        Wall(1.6, 1.6, 0.35, crack="known"),
        HINGED,
        LoadedWall.of_size(3.2, 0.35, 18e3, 1.6, **BEARING),
        LoadedWall.of_size(3.2, 0.35, 18e3, 1.6, load_held=True, **BEARING),
        Facade(
            (3.5, 3.0), (0.6, 0.5), 20e3, floor_loads=(12e3, 6e3), thrust=1e3, crack_storey=1, crack="known"
        ),
        Facade((3.5, 3.0), (0.6, 0.6), 20e3, crack_storey=1, crack="known", **TIE).on_joints(FIRM),
        Facade((3.5, 3.0), (0.6, 0.6), 20e3, crack_storey=1, crack="known", **YIELDING).on_joints(FIRM),
    ],
    ids=[
        "block",
        "wall",
        "slab",
        "bearing",
        "weight only",
        "façade with floors",
        "façade with a tie",
        "façade with a tie that yields",
    ],
)
def test_bodies_turn_as_their_mechanism_where_all_joints_close_at_once(structure):
    """Its error is of first order: uplift and impact come within a step, and exp(p t) ≤ 5 from there on."""
    mechanism = structure.mechanism()
    amplitude = 1.8 * mechanism.uplift_multiplier * GRAVITY
    motion = sampled(
        Pulse(amplitude=amplitude, circular_frequency=5 * mechanism.positive.frequency_parameter)
    )
    exact = integrate(structure, motion, history=True)
    largest, fastest = np.abs(exact.rotation).max(), np.abs(exact.angular_velocity).max()
    errors = []
    for step in (8e-4, 2e-4, 5e-5):
        followed = follow_stack(bodies_of(structure), motion, step)
        assert not followed.falls
        assert np.sign(followed.turns[0]) == exact.peak_side
        error = abs(followed.largest_turns[0] - largest)
        assert error < 10 * step * fastest
        errors.append(error)
    assert errors[2] < errors[0] / 4


def stacks() -> dict[str, Stack]:
    spire = Spire(width=3.0, height=15.0, wall_thickness=0.25)
    return {
        "block": Block.of_size(0.6, 4.0).stack(),
        "drums": Block.of_size(0.6, 4.0).stack(5),
        "spire": spire.stack(),
        "wall below a slab": LoadedWall.of_size(3.2, 0.25, 18e3, top_load=8e3, top_slab="flat").stack(4),
        "wall": Wall(1.6, 1.6, 0.25).stack(),
    }


@pytest.mark.parametrize("name", stacks())
def test_free_motion_gains_no_energy_but_what_the_step_lets_it(name):
    """A contact pushes over half a step while its point still moves along: a gain of second order in the step."""
    stack, gains = stacks()[name], []
    free = np.array([not other_course.guided for other_course in stack.courses])
    count = len(stack.courses)
    start = np.zeros((count, 3))
    start[:, 0] = 0.5 * np.linspace(0, 1, count + 1)[1:] * free
    start[:, 2] = 0.3 * (-1.0) ** np.arange(count) * free
    for step in (1e-3, 2.5e-4):
        still = Accelerogram(np.zeros(round(4 / step)), step)
        response = follow_stack(stack, still, step, history=True, initial_velocity=start)
        masses = np.array([course.mass for course in stack.courses])
        inertias = np.array([one_course.inertia for one_course in stack.courses])
        places, velocities = response.places, response.velocities
        moving = masses * (velocities[..., :2] ** 2).sum(axis=-1) + inertias * velocities[..., 2] ** 2
        energy = (moving / 2 + masses * GRAVITY * places[..., 1]).sum(axis=1)
        given = (masses * (start[:, :2] ** 2).sum(axis=-1) + inertias * start[:, 2] ** 2).sum() / 2
        assert not response.falls
        assert energy.max() <= given * (1 + 1e-9)
        assert energy[-1] < 0.5 * given
        gains.append(np.diff(energy).max() / given)
    assert gains[1] < 1e-3
    assert gains[1] < max(gains[0], 1e-5)


@pytest.mark.parametrize(
    "structure",
    [
        Block.of_size(0.6, 4.0),
        Spire(3.0, 15.0, crack_height=0.0, crack="known"),
        HINGED,
        Wall(1.6, 1.6, 0.25, crack="known"),
    ],
)
@pytest.mark.parametrize("share", [0.97, 1.03])
def test_it_opens_under_a_steady_push_where_limit_analysis_has_it(structure, share):
    push = share * structure.mechanism().uplift_multiplier * GRAVITY
    steady = Accelerogram(np.concatenate([np.linspace(0, push, 2000), np.full(1000, push)]), 1e-3)
    response = follow_stack(structure.stack(), steady, 1e-3)
    assert (response.largest_turns.max() > 1e-4) == (share > 1)


def test_courses_lift_together_where_each_joint_would_alone():
    """λ of a free-standing stack is the least over its joints of the lever over the height of what stands on it."""
    levels, widths = [0.0, 0.8, 2.0, 3.0], [0.9, 0.8, 0.3, 0.3]
    stack = Stack(courses_between(levels, [(-width / 2, width / 2) for width in widths], 1.0, [1.0] * 3))
    above = [joined(stack.courses[place:]) for place in range(3)]
    least = min(-part.bottom[0] / (part.centre[1] - part.base) for part in above)
    for share, lifts in ((0.97, False), (1.03, True)):
        push = np.linspace(0, share * least * GRAVITY, 3000)
        assert (follow_stack(stack, Accelerogram(push, 1e-3), 1e-3).largest_turns.max() > 1e-4) == lifts


def test_courses_that_stay_together_are_the_body_between_their_outer_faces():
    """Three lengths of one trapezium above the foot of a stack beside the trapezium itself, by Gauss's points."""
    levels = [0.5, 1.0, 2.0, 2.6]
    faces = [(-0.6 + 0.1 * z, 0.5 - 0.05 * z) for z in levels]
    body = joined(courses_between(levels, faces, 2e3, [0.8] * 3))
    (whole,) = courses_between([0.5, 2.6], [faces[0], faces[-1]], 2e3, [0.8])
    assert (body.bottom, body.top, body.base, body.height) == (whole.bottom, whole.top, 0.5, 2.6 - 0.5)
    found = (body.mass, *body.centre, body.inertia)
    assert found == pytest.approx((whole.mass, *whole.centre, whole.inertia), rel=1e-12)


def test_a_body_that_is_known_by_its_centre_of_mass_is_one_course():
    (course,) = RigidBody(left=0.3, right=0.5, centre_height=2.0, inertia=1.4).stack().courses
    face = (-0.3, 0.5)
    assert course == Course(
        bottom=face, top=face, base=0.0, height=4.0, mass=1.0, centre=(0.0, 2.0), inertia=1.4
    )


@pytest.mark.parametrize("slab", ["hinged", "flat"])
def test_the_courses_of_a_wall_carry_its_floors(slab):
    """18 kN/m³ · 6 m · .4 m, 8 kN/m at 3 m and 5 kN/m at 6 m, both .05 m inside of the middle; a slab has its own."""
    loads = {"floor_loads": (8e3, 5e3), "eccentricity": 0.05, "top_slab": slab}
    wall = Facade((3.0, 3.0), (0.4, 0.4), 18e3, crack_storey=1, crack="known", **loads)
    body, *slabs = wall.stack().courses
    laid = wall.stack().at_rest
    assert laid.softness == 0 and np.isinf(laid.drops).all(), (
        "nothing of a stack gives, and its courses fall by turning"
    )
    weights, heights = np.array([43.2e3, 8e3, 5e3]), np.array([3.0, 3.0, 6.0])
    if slab == "flat":
        (above,) = slabs
        assert (above.base, above.upright, above.bottom) == (6.0, True, (-0.4, 0.0))
        assert above.mass == pytest.approx(5e3 / GRAVITY)
        weights, heights = weights[:2], heights[:2]
    across = np.array([-0.2, -0.25, -0.25])[: weights.size]
    centre = np.array([weights @ across, weights @ heights]) / weights.sum()
    assert body.mass == pytest.approx(weights.sum() / GRAVITY)
    assert body.centre == pytest.approx(centre)
    apart = (across - centre[0]) ** 2 + (heights - centre[1]) ** 2
    own = weights[0] * (0.4**2 + 6.0**2) / 12
    assert body.inertia == pytest.approx((own + weights @ apart) / GRAVITY)


def test_a_mirrored_motion_turns_it_the_other_way():
    motion = sampled(Pulse(amplitude=8.0, circular_frequency=5.0))
    stack = Spire(width=3.0, height=15.0).stack()
    one, other = (follow_stack(stack, motion.scaled(sign), 1e-3, history=True) for sign in (1, -1))
    # roundings differ and grow from impact to impact: within the pulse they stay far below 1e-6
    assert one.places[:100] == pytest.approx(other.places[:100] * [-1, 1, -1], abs=1e-6)
    assert np.abs(one.places[:100, :, 2]).max() > 1e-3


def test_ground_that_rises_ever_faster_is_more_gravity():
    """A vertical of 0.21 g and 1.21 of the motion in 1/1.1 of the time: the same course of places, sooner."""
    motion, stack = (
        sampled(Pulse(amplitude=8.0, circular_frequency=5.0)),
        Spire(width=3.0, height=15.0).stack(),
    )
    sooner = replace(motion, acceleration=1.21 * motion.acceleration, time_step=motion.time_step / 1.1)
    rising = replace(sooner, acceleration=np.full_like(motion.acceleration, 0.21 * GRAVITY))
    one = follow_stack(stack, motion, motion.time_step / 16, history=True)
    other = follow_stack(stack, sooner, sooner.time_step / 16, vertical=rising, history=True)
    assert one.places[:90] == pytest.approx(other.places[:90], abs=1e-6)
    assert np.abs(one.places[:90, :, 2]).max() > 1e-3


def test_still_ground_ahead_of_a_motion_changes_neither_its_course_nor_its_end():
    stack, motion = (
        Spire(width=3.0, height=15.0).stack(),
        sampled(Pulse(amplitude=4.0, circular_frequency=5.0)),
    )
    count = round(5.0 / motion.time_step)
    later = Accelerogram(np.append(np.zeros(count), motion.acceleration), motion.time_step)
    step = motion.time_step / 16
    one, other = follow_stack(stack, motion, step), follow_stack(stack, later, step)
    assert not one.falls and not other.falls
    assert other.largest_turns == pytest.approx(one.largest_turns, rel=1e-3)  # roundings grow at impacts
    assert one.largest_turns.max() > 1e-4
    assert abs(other.steps - one.steps) * step < 0.5  # s; five seconds of still ground are not followed


def test_a_body_that_slides_is_slowed_by_friction_alone():
    """Under a steady a > μ g a squat block lags by (a − μ g) t²/2."""
    block = Block.of_size(2.0, 1.0).stack()
    slippery = Stack(block.courses, friction=0.2)
    push = 0.5 * GRAVITY
    response = follow_stack(slippery, Accelerogram(np.full(1001, push), 1e-3), 1e-3, history=True)
    lag = -response.places[999, 0, 0]
    assert lag == pytest.approx(
        (push - 0.2 * GRAVITY) / 2, rel=2e-3
    )  # of first order in the step of 1e-3 of 1 s
    assert np.abs(response.places[:1000, 0, 2]).max() < 1e-6


@pytest.mark.parametrize("share", [0.98, 1.02])
def test_a_body_at_rest_slides_from_the_push_that_friction_bears(share):
    """Nothing is solved while it rests: the bound of that is μ g."""
    slippery = Stack(Block.of_size(2.0, 1.0).stack().courses, friction=0.2)
    push = share * 0.2 * GRAVITY
    steady = Accelerogram(np.concatenate([np.linspace(0, push, 2000), np.full(1000, push)]), 1e-3)
    response = follow_stack(slippery, steady, 1e-3, history=True)
    assert (np.abs(response.places[:2999, 0, 0]).max() > 1e-4) == (share > 1)


def test_between_two_pulses_a_stack_rests_and_the_second_finds_it_as_the_first_did():
    """Drums that settle exactly come to the second pulse as if it were the first."""
    stack = LoadedWall.of_size(3.2, 0.25, 18e3, top_load=8e3, top_slab="flat").stack(4)
    pulse = sampled(Pulse(amplitude=8.0, circular_frequency=15.0))
    count = pulse.acceleration.size
    pause = np.zeros(round(20.0 / pulse.time_step))
    twice = Accelerogram(
        np.concatenate([pulse.acceleration, pause, pulse.acceleration, pause]), pulse.time_step
    )
    step = pulse.time_step / 16
    history = follow_stack(stack, twice, step, history=True)
    turns = np.abs(history.places[..., 2]).max(axis=1)
    one, other = turns[: count + pause.size].max(), turns[count + pause.size :].max()
    assert one > 1e-3
    assert other == pytest.approx(one, rel=1e-2)  # the courses come to rest within microns of where they were


@pytest.mark.parametrize("restitution", [0.9, 0.7, 0.5])
def test_what_stands_behind_throws_back_with_its_restitution(restitution):
    """Of two flights from ω each turns to cos(α − φ) − cos α ~ ω²; a stop takes milliseconds."""
    block = Block.of_size(0.6, 4.0, one_sided=True, restitution=restitution)
    (course,) = block.stack().courses
    across, up = course.centre
    thrown = 0.25 * np.array([[up, 0.3 - across, 1.0]])  # outwards, about the outer edge
    still = Accelerogram(np.zeros(8000), 1e-3)
    turns = follow_stack(block.stack(), still, 2e-4, history=True, initial_velocity=thrown).places[:, 0, 2]
    landing = int(np.flatnonzero(turns[1:] <= 0)[0]) + 1
    risen = [
        np.cos(block.slenderness - peak) - np.cos(block.slenderness)
        for peak in (turns[:landing].max(), turns[landing:].max())
    ]
    assert turns.min() > -1e-3
    assert np.sqrt(risen[1] / risen[0]) == pytest.approx(restitution, abs=0.05)


def test_a_bulge_opens_between_elastic_holds_where_limit_analysis_has_it():
    """A wall on cross walls with a tie at each of its two levels: first order, as the ties give by microns."""
    wall = Facade(
        (3.0, 3.0),
        (0.3, 0.3),
        18e3,
        behind="cross_walls",
        restitution=0.5,
        tie_heights=(3.0, 6.0),
        tie_stiffness=3e7,
    ).on_joints(FIRM)
    assert wall.mechanisms()[0].name.startswith("bulges between")
    # of the joints that the courses have
    _, least = wall.held_wall.family([course.base for course in wall.stack().courses])[0]
    for share, lifts in ((0.9, False), (1.1, True)):
        push = -share * least * GRAVITY
        steady = Accelerogram(np.concatenate([np.linspace(0, push, 4000), np.full(2000, push)]), 1e-3)
        stack = wall.stack()
        assert (follow_stack(stack, steady, 5e-4).largest_turns.max() > 1e-2) == lifts


def test_floors_behind_hold_inwards_and_nothing_outwards():
    """Twice the push that turns a free wall over, to either side."""
    free = Facade((3.0, 3.0), (0.4, 0.4), 18e3, floor_loads=(8e3, 8e3))
    held = replace(free, behind="floors", restitution=0.5)
    push = 2 * free.static_multiplier * GRAVITY
    steady = Accelerogram(np.concatenate([np.linspace(0, push, 1000), np.full(4000, push)]), 1e-3)
    falls = [
        [follow_stack(wall.stack(6), steady.scaled(sign), 5e-4).falls for sign in (1, -1)]
        for wall in (free, held)
    ]
    assert falls == [[True, True], [False, True]]


def test_the_mass_of_a_spire_is_in_its_courses():
    spire = Spire(width=3.0, height=15.0, wall_thickness=0.25, crack_height=4.0, crack="known")
    body = joined(spire.stack(7).courses)
    linkage = spire.linkages[0]
    assert body.centre[1] == pytest.approx(linkage.rest[0].imag, rel=1e-12)
    assert body.inertia / body.mass == pytest.approx(linkage.inertias[0] / linkage.masses[0], rel=1e-12)


def test_a_spire_has_the_courses_that_it_states():
    assert len(Spire(3.0, 15.0, courses=9).stack().courses) == 9
    assert len(Spire(3.0, 15.0, courses=9).stack(4).courses) == 4
    assert len(Spire(3.0, 15.0).stack().courses) == 6


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Spire(3.0, 15.0, courses=41), "courses is 41, but must be"),
        (lambda: Spire(3.0, 15.0).stack(41), "courses is 41, but must be"),
        (lambda: Frame(Block.of_size(0.5, 4.0), 2, 1.0).stack(), "a stack of courses"),
    ],
)
def test_what_is_no_stack_is_refused_in_one_sentence(make, words):
    with pytest.raises(StructureError, match=words):
        make()


def test_a_step_that_is_too_long_is_refused_in_one_sentence():
    with refused(MotionError, "step", 0.02):
        follow_stack(Spire(3.0, 15.0).stack(), sampled(Pulse(amplitude=3.0, circular_frequency=5.0)), 0.02)
