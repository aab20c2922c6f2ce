"""A response that is chaotic: what its nominal run can say, and what many of its neighbours can."""

import numpy as np
import pytest
from motion_cases import noise

from rocking.motion import Members, integrate, integrate_members
from rocking.structures import Block

BLOCK = Block.of_size(breadth=0.5, height=3.0, restitution=0.96)
RECORD = noise(3, 6000, 0.01, 2.6)
"""A minute, in which the block meets hundreds of impacts and overturns in about two of three neighbours."""
COUNT = 250


def share(tolerance: float) -> float:
    """Share of overturnings among motions that differ by 1e-6 at most."""
    factors = 1 + 1e-6 * np.random.default_rng(4).uniform(-1, 1, COUNT)
    return float(integrate_members(BLOCK, RECORD, Members(factors), tolerance).overturns.mean())


def test_any_tolerance_gives_the_same_share_of_overturnings() -> None:
    """So no tolerance settles the verdict, but a looser one does not shift it either.

    Binomial: four standard errors of the difference of two shares near 0.65 among 250 are 0.17.
    """
    shares = [share(tolerance) for tolerance in (1e-12, 1e-9, 1e-6)]
    assert np.ptp(shares) <= 0.17
    assert 0.4 <= np.mean(shares) <= 0.9


@pytest.mark.parametrize("structure", [BLOCK, BLOCK.mechanism().equivalent_block()], ids=["block", "linear"])
def test_a_run_that_cannot_be_repeated_is_called_fragile(structure) -> None:
    """Whatever it says, and though neighbours ± 1 % away may agree with it by chance."""
    factors = 1 + 1e-6 * np.random.default_rng(5).uniform(-1, 1, 20)
    runs = [integrate(structure, RECORD.scaled(factor), sensitivity=True) for factor in factors]
    rocks = [run for run in runs if run.outcome == "rocks"]
    assert rocks and all(run.fragile for run in rocks)
