"""The reference of `snakemake compare` against the tests' own integrator, with which it shares no code."""

import numpy as np
import pytest
from motion_cases import MECHANISMS, noise
from oracle import Oracle
from scipy.constants import g

from docs.research.reference import event_landings, reference_landings
from rocking.errors import MotionError
from rocking.records import Accelerogram
from rocking.structures import Block


def record_for(mechanism, seed, times):
    lift = g * max(side.uplift_multiplier for side in mechanism.sides)
    return noise(seed, 60, 0.02, times * lift)


@pytest.mark.parametrize("name", [name for name in MECHANISMS if name != "arch"])
def test_reference_equals_the_oracle(name):
    """Both at 1e-12 or tighter; the flights of 60 samples amplify errors a few hundred times at most."""
    mechanism = MECHANISMS[name]
    record = record_for(mechanism, 4, 1.2 if name == "two sides" else 1.8)
    expected, impacts = Oracle(mechanism).run(record.acceleration, record.time_step)
    assert impacts >= 2
    assert 0.001 < expected < np.inf
    assert reference_landings(mechanism, record)[0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("method", ["RK45", "DOP853"])
def test_events_converge_to_the_reference(method):
    """Each thousandfold tolerance brings it closer; at 1e-9 the kinks that no step meets leave less than 1e-5."""
    mechanism = MECHANISMS["block"]
    record = record_for(mechanism, 3, 2.0)
    truth, _ = reference_landings(mechanism, record)
    errors = [abs(event_landings(mechanism, record, method, rtol)[0] / truth - 1) for rtol in (1e-3, 1e-9)]
    assert errors[1] < min(errors[0] / 10, 1e-5)
    with pytest.raises(MotionError, match="budget"):
        reference_landings(mechanism, record, budget=1e-6)


def test_a_block_that_is_pushed_for_ever_overturns():
    """A constant 1.5 λ g exceeds what gravity restores at any rotation below the end of the mechanism."""
    block = Block(0.5, 0.2).mechanism()
    record = Accelerogram(np.full(300, -1.5 * block.uplift_multiplier * g), 0.02)
    assert reference_landings(block, record)[0] == np.inf
    assert event_landings(block, record, "RK45", 1e-6)[0] == np.inf
