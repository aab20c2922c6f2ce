"""Single runs within 1e-9 of a limit of overturning, where a run at 1e-6 may end on the wrong side."""

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from motion_cases import bisected, noise
from scipy.constants import g

from rocking.assessment.one_case import other_processings
from rocking.assessment.settings import AssessmentSettings
from rocking.motion import Response, integrate
from rocking.records import Accelerogram
from rocking.structures import Block, Outcome, Structure, Wall

of_cases = pytest.mark.parametrize("count", [40, pytest.param(200, marks=pytest.mark.slow)])


def overturns(structure: Structure, motion: Accelerogram, tolerance: float) -> bool:
    return integrate(structure, motion, tolerance).outcome is Outcome.OVERTURNS


@dataclass(frozen=True)
class Case:
    """A structure under a motion close to a limit of it, and what becomes of it.

    loosely, strictly, exactly: whether it overturns at 1e-6, at 1e-9 and at 1e-12, at which the limit was sought.
    asked: the run at 1e-6 that is asked whether it is fragile.
    """

    structure: Structure
    motion: Accelerogram
    loosely: bool
    strictly: bool
    exactly: bool
    asked: Response


def made_structure(rng: np.random.Generator) -> Structure:
    restitution = rng.uniform(0.5, 0.95)
    if rng.random() < 1 / 3:
        return Wall(
            rng.uniform(1.5, 3.0), rng.uniform(1.5, 3.0), rng.uniform(0.25, 0.6), restitution=restitution
        )
    one_sided = rng.random() < 0.5
    return Block(rng.uniform(0.5, 4.0), rng.uniform(0.1, 0.35), restitution=restitution, one_sided=one_sided)


@cache
def made_case(seed: int) -> Case:
    """A motion by a share of 3e-12 to 1e-9 below or above a strength at which the structure begins to overturn."""
    rng = np.random.default_rng(seed)
    structure = made_structure(rng)
    lift = g * max(side.uplift_multiplier for side in structure.mechanism().sides)
    count = int(rng.integers(60, 240))
    record = noise(seed, count, 0.02, lift, int(rng.integers(5, 30)))

    factor = 1.1
    while not overturns(structure, record.scaled(factor), 1e-12):
        factor *= 1.1
    limit = bisected(factor / 1.1, factor, lambda item: overturns(structure, record.scaled(item), 1e-12))

    distance = rng.choice([-1, 1]) * 10 ** rng.uniform(-11.5, -9)
    motion = record.scaled(limit * (1 + distance))
    loosely, strictly, exactly = (overturns(structure, motion, value) for value in (1e-6, 1e-9, 1e-12))
    asked = integrate(structure, motion, 1e-6, repeat_fragile=True)
    return Case(structure, motion, loosely, strictly, exactly, asked)


@of_cases
def test_a_run_on_the_wrong_side_of_a_limit_is_called_fragile_and_repeats_itself(count):
    """So within 1e-9 of any limit, also where the next one is less than 1 % away.

    Measured: 20 of the 200 end on the wrong side at 1e-6, and none of them where it is asked.
    """
    cases = list(map(made_case, range(count)))
    misled = sum(this_case.loosely is not this_case.strictly for this_case in cases)
    assert misled >= count / 40, "else the cases do not test it"
    assert all(one_case.asked.fragile for one_case in cases)
    assert all(other_case.asked.tolerance == 1e-9 for other_case in cases)
    assert [case.asked.outcome is Outcome.OVERTURNS for case in cases] == [case.strictly for case in cases]


@of_cases
def test_the_strict_side_of_a_limit_is_the_true_one(count):
    """None of the 200 is wrong at 1e-9, whose errors of 2e-12 (docs/pages/validation.md) may turn the nearest ones."""
    wrong = sum(number.strictly is not number.exactly for number in map(made_case, range(count)))
    assert wrong <= count / 100


@of_cases
def test_a_run_with_another_processing_ends_on_the_strict_side(count):
    for case in map(made_case, range(count)):
        (other,) = other_processings(case.structure, {"other": case.motion}, AssessmentSettings())
        assert math.isinf(other.integrated_rotation_ratio) is case.strictly
