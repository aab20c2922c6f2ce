"""A response that is chaotic says so."""

import numpy as np
import pytest
from motion_cases import noise

from rocking.motion import integrate
from rocking.structures import Block

BLOCK = Block.of_size(breadth=0.5, height=3.0, restitution=0.96)
RECORD = noise(3, 6000, 0.01, 2.6)
"""A minute, in which the block meets hundreds of impacts and overturns in about two of three neighbours."""


@pytest.mark.parametrize("structure", [BLOCK, BLOCK.mechanism().equivalent_block()], ids=["block", "linear"])
def test_a_run_that_cannot_be_repeated_is_called_fragile(structure) -> None:
    """Whatever it says, and though neighbours ± 1 % away may agree with it by chance."""
    factors = 1 + 1e-6 * np.random.default_rng(5).uniform(-1, 1, 20)
    runs = [integrate(structure, RECORD.scaled(factor), sensitivity=True) for factor in factors]
    rocks = [run for run in runs if run.outcome == "rocks"]
    assert rocks and all(run.fragile for run in rocks)
