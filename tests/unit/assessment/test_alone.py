"""A mechanism alone is followed as the structure that it is of, and tells nothing of contacts that nobody knows."""

import numpy as np
import pytest

import rocking
from rocking.assessment.cracks import cracks
from rocking.errors import StructureError
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures.linkage import MotionState, UnknownContacts
from rocking.structures.unknown_geometry import as_structure

BLOCK = rocking.Block(2.0, 0.2)
SHAKEN = Accelerogram(
    Pulse(amplitude=3.0, circular_frequency=5.0, start_time=0.5).acceleration(np.arange(600) * 0.01), 0.01
)


def test_its_members_are_those_of_its_structure():
    of_structure = rocking.assess(SHAKEN, BLOCK, members=16)
    alone = rocking.assess(SHAKEN, BLOCK.mechanism(), members=16)
    np.testing.assert_array_equal(alone.rotation_ratios, of_structure.rotation_ratios)
    assert 0 < alone.rotation_ratio == of_structure.rotation_ratio
    (case,) = alone.cases.values()
    assert case.check.bounces is None and not case.limits
    (case,) = of_structure.cases.values()
    assert case.check.bounces is False


def test_what_needs_a_geometry_is_refused():
    alone = as_structure(BLOCK.mechanism())
    assert as_structure(BLOCK) is BLOCK
    with pytest.raises(UnknownContacts):
        alone.contact_forces(MotionState.of(alone.mechanism(), 0.01, 0.1))
    with pytest.raises(StructureError):
        alone.stack()


def test_two_mechanisms_alone_are_not_taken_for_one_another():
    """What is kept of one by its equality is not that of another."""
    slender, stout = (as_structure(rocking.Block(2.0, value).mechanism()) for value in (0.2, 0.4))
    assert slender != stout
    multipliers = [cracks(case)[0].mechanism.uplift_multiplier for case in (slender, stout)]
    assert multipliers == pytest.approx(np.tan([0.2, 0.4]), rel=1e-12)
