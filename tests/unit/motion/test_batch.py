"""Many structures in one call are the same structures one at a time."""

import math

import numpy as np
import pytest

from rocking.motion import integrate, integrate_batch
from rocking.records import Accelerogram
from rocking.structures import Block, EquivalentBlock, RigidBody

STEP = 0.01
TIMES = np.arange(800) * STEP
RECORD = Accelerogram(
    3.2 * np.sin(np.pi * TIMES / 8) ** 2 * (np.sin(6 * TIMES) + 0.4 * np.sin(17 * TIMES + 1)), STEP
)


def two_sided(p: float, other_p: float, first: float, second: float, eta: float) -> EquivalentBlock:
    return EquivalentBlock(
        p, 0.1, 0.1 / first, eta, other_side=EquivalentBlock(other_p, 0.12, 0.12 / second, 0.85)
    )


BLOCKS = [
    two_sided(p, other_p, first, second, eta)
    for p, other_p in ((2.0, 2.0), (4.0, 3.0))
    for first, second in ((0.08, 0.1), (0.2, 0.15), (0.3, 0.9), (0.9, 0.3), (0.9, 0.9))
    for eta in (0.8, 0.95)
] + [
    Block(1.5, 0.2).mechanism().equivalent_block(),
    RigidBody(0.2, 0.3, 1.0, 0.4, restitution=0.9).mechanism().equivalent_block(),
]


def test_many_blocks_are_the_blocks_one_by_one():
    found = integrate_batch(BLOCKS, RECORD)[:, 0]
    alone = np.array([integrate(block, RECORD).rotation_ratio for block in BLOCKS])
    assert np.isinf(alone).any()
    assert (alone == 0).any()
    assert ((alone > 0) & (alone < 1)).any()
    assert found == pytest.approx(alone, rel=1e-12)


def test_the_scale_of_the_record_counts():
    found = integrate_batch(BLOCKS, RECORD, [0.7])[:, 0]
    assert found == pytest.approx(integrate_batch(BLOCKS, RECORD.scaled(0.7))[:, 0], rel=1e-12)


def test_a_block_on_one_side_goes_another_way_to_the_same_end():
    leaning = EquivalentBlock(3.0, 0.2, 1.0, 0.7, one_sided=True)
    found = integrate_batch([leaning, BLOCKS[0]], RECORD)[0, 0]
    assert not math.isnan(found)
    assert found == pytest.approx(integrate(leaning, RECORD).rotation_ratio, rel=1e-12)
