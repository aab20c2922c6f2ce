"""Whether the model held along a response."""

import math

import numpy as np
import pytest

from rocking.motion import integrate
from rocking.motion.response import check_model
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Block, Frame

STEP = 0.005
RECORD = Accelerogram(Pulse(3.0, 2 * np.pi / 0.8, 1.0).acceleration(np.arange(2000) * STEP), STEP)


def _check(structure, record=RECORD):
    return check_model(structure, integrate(structure, record, history=True), record)


@pytest.mark.parametrize("slenderness", [0.1, 0.2, 0.3])
def test_a_block_needs_at_least_the_friction_that_lifts_it(slenderness):
    # At uplift, φ = 0, the ground pushes with λ m g = tan α · m g and the weight presses with m g
    check = _check(Block(2.0, slenderness), RECORD.scaled(slenderness / 0.2))
    assert check.required_friction >= math.tan(slenderness) * (1 - 1e-9)
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
