"""Whether the model held along a response."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocking.motion import integrate
from rocking.motion.response import check_model, lifting_friction
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, Frame, RigidBody
from rocking.structures.unknown_geometry import as_structure

STEP = 0.005
RECORD = Accelerogram(
    Pulse(amplitude=3.0, circular_frequency=2 * np.pi / 0.8, start_time=1.0).acceleration(
        np.arange(2000) * STEP
    ),
    STEP,
)


def _check(structure, record=RECORD):
    return check_model(structure, integrate(structure, record, history=True), record)


@pytest.mark.parametrize("slenderness", [0.1, 0.2, 0.3])
def test_a_block_needs_at_least_the_friction_that_lifts_it(slenderness):
    # At uplift, φ = 0, the ground pushes with λ m g = tan α · m g and the weight presses with m g
    check = _check(Block(2.0, slenderness), RECORD.scaled(slenderness / 0.2))
    assert check.required_friction >= math.tan(slenderness) * (1 - 1e-9)
    # what lifts it lies at its edge: the reaction leans by tan α
    assert check.lifting_friction == pytest.approx(math.tan(slenderness), rel=1e-9)
    assert check.slides(check.required_friction * 1.01) is False
    assert check.slides(check.required_friction * 0.99) is True


def test_nothing_is_claimed_without_motion_or_where_forces_are_not_known():
    still = _check(Block(2.0, 0.2), RECORD.scaled(0.1))
    assert math.isnan(still.required_friction) and still.bounces is None
    assert still.reason == "nothing rocks below the critical rotation"
    frame = _check(Frame(Block(2.0, 0.2), 3, 0.2))
    assert math.isnan(frame.required_friction)
    assert frame.slides(0.5) is None
    assert frame.reason == "contact forces of a frame are statically indeterminate"
    silent = check_model(Block(2.0, 0.2), integrate(Block(2.0, 0.2), RECORD), RECORD)
    assert silent.reason == "the response keeps no history"


@pytest.mark.parametrize("sides", [(1, -1), (-1, 1), (1, 1)])
@pytest.mark.parametrize("strong", [0, 2])
def test_where_it_lifts_and_lands_the_contact_is_asked_on_the_side_to_which_it_goes_on(sides, strong):
    """A history at hand: φ = 0, aside, φ = 0, aside, with all of the ground's push at one of the zeros.

    About a corner I φ'' = R (a cos α − g sin α) with I = 4/3 R², and the corner bears a − R φ'' cos α and
    g + R φ'' sin α for each unit of mass.
    """
    slenderness, semi_diagonal = 0.2, 2.0
    block = Block(semi_diagonal, slenderness)
    sine, cosine = math.sin(slenderness), math.cos(slenderness)
    push = 2.0 * GRAVITY * math.tan(slenderness)
    weight = 0.8 * GRAVITY  # of ground that falls with 0.2 g
    thrust = 0.75 * (push * cosine - weight * sine)
    expected = (push - thrust * cosine) / (weight + thrust * sine)
    first, second = sides
    ground = np.zeros(4)
    ground[strong] = -push * (first if strong == 0 else second)
    record = Accelerogram(ground, 1.0)
    response = replace(
        integrate(block, RECORD, history=True),
        times=np.arange(4.0),
        rotation=np.array([0.0, 0.05 * first, 0.0, 0.05 * second]),
        angular_velocity=np.zeros(4),
    )
    # it is asked at 1e-12 of the critical rotation instead of at 0
    found = check_model(block, response, record, Accelerogram(np.full(4, weight - GRAVITY), 1.0))
    assert found.required_friction == pytest.approx(expected, rel=1e-9)


def test_the_friction_that_lifts_is_that_of_the_side_that_lifts_first():
    for left, right in ((0.3, 0.5), (0.5, 0.3)):
        assert lifting_friction(RigidBody(left, right, 2.0, 1.4)) == pytest.approx(0.15, rel=1e-9)
    frame = Frame(Block(2.0, 0.2), 3, 0.2)
    assert lifting_friction(frame) == frame.mechanism().uplift_multiplier, "the mean over all its joints"
    assert lifting_friction(as_structure(frame.mechanism())) == 0.0, "whose joints are not known"
