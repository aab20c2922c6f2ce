"""A response that is chaotic: what its nominal run can say, and what many of its neighbours can."""

import numpy as np
import pytest

from rocking.motion import Members, integrate, integrate_members
from rocking.records import CatalogueRecord, open_record
from rocking.records.accelerogram import Accelerogram
from rocking.records.processing import UNPROCESSED_DEFAULT, process
from rocking.structures import Block

BLOCK = Block.of_size(breadth=0.5, height=3.0)
COUNT = 500


@pytest.fixture(scope="module")
def record() -> Accelerogram:
    """The K-NET sample of obspy, multiplied by 80 and processed: 59 s, η = 0.96, 600 impacts."""
    row = CatalogueRecord("AKT013", "obspy:test.knet", scale_factor=80.0)
    return process(open_record(row)[0], UNPROCESSED_DEFAULT)


def share(record: Accelerogram, spread: float, tolerance: float) -> float:
    """Share of overturnings among motions that differ by `spread` at most."""
    factors = 1 + spread * np.random.default_rng(4).uniform(-1, 1, COUNT)
    return float(integrate_members(BLOCK, record, Members(factors), tolerance).overturns.mean())


def test_any_tolerance_gives_the_same_share_of_overturnings(record: Accelerogram) -> None:
    """Nine in ten of its neighbours overturn, be they 1e-12 or 1 % away and followed to 1e-6 or to 1e-12.

    So no tolerance settles the verdict, but a looser one does not shift it either. Binomial: four standard errors of
    the difference of two shares near 0.91 among 500 are 0.072.
    """
    shares = [share(record, *case) for case in ((1e-12, 1e-12), (1e-6, 1e-9), (1e-6, 1e-6), (1e-2, 1e-6))]
    assert np.ptp(shares) <= 0.072
    assert 0.85 <= np.mean(shares) <= 0.97


def test_a_run_that_stands_by_chance_is_called_fragile(record: Accelerogram) -> None:
    """Two neighbours ± 1 % away both stand by chance in one run of a hundred."""
    factors = 1 + 1e-6 * np.random.default_rng(5).uniform(-1, 1, 60)
    runs = [integrate(BLOCK, record.scaled(factor), sensitivity=True) for factor in factors]
    standing = [run.fragile for run in runs if run.outcome == "rocks"]
    assert standing and all(standing)
