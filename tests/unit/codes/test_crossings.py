"""The level at which a demand reaches a capacity beside the roots of polynomials, piece by piece."""

import numpy as np
import pytest

from rocking import DesignSpectrum
from rocking.codes.crossings import Crossings
from rocking.codes.floor_demand import FloorDemand

G = 9.80665
F0 = 2.5
TO_ROUNDING = 1e-12


def first_level_on_soil_d(capacity: float) -> float:
    """The least a_g with a_g S_S(a_g) = capacity, S_S = 2.4 − 1.5 F0 a_g/g between 1.8 and .9."""
    slope = 1.5 * F0 / G
    full_until, least_from = (2.4 - 1.8) / slope, (2.4 - 0.9) / slope
    pieces = [
        (0.0, full_until, [1.8, -capacity]),
        (full_until, least_from, [-slope, 2.4, -capacity]),
        (least_from, np.inf, [0.9, -capacity]),
    ]
    roots = [
        root.real
        for low, high, polynomial in pieces
        for root in np.roots(polynomial)
        if abs(root.imag) < 1e-12 and low <= root.real <= high
    ]
    return min(roots)


@pytest.mark.parametrize("level", [0.5, 3.0, 25.0])
def test_the_first_level_is_found_where_soft_soil_reaches_a_capacity_three_times(level):
    """The peak on soil D rises to .96 g/F0, falls to .9 g/F0 and rises again, wherever the search begins."""
    capacities = np.array([0.1, 0.5, 0.88, 0.9, 0.91, 0.93, 0.95, 0.959, 0.961, 1.0, 3.0]) * G / F0
    floor = FloorDemand(DesignSpectrum.ntc(level, F0, 0.35, "D"))
    crossings = Crossings.of(lambda _, levels: floor.peak(levels), capacities, level)
    found = crossings.levels(np.arange(capacities.size))
    expected = [first_level_on_soil_d(float(capacity)) for capacity in capacities]
    assert found == pytest.approx(expected, rel=TO_ROUNDING)
    assert (crossings.low <= found).all()
    assert (found <= crossings.high).all()


def test_what_bears_nothing_is_reached_at_once_and_what_bears_all_never():
    capacities = np.array([0.0, 2.0, np.inf])
    crossings = Crossings.of(lambda _, levels: 4.0 * levels, capacities, 1.0)
    assert crossings.levels(np.array([2, 0, 1])) == pytest.approx([np.inf, 0.0, 0.5], rel=TO_ROUNDING)
    assert crossings.levels(np.array([2, 0])).tolist() == [np.inf, 0.0]


def test_a_guess_that_is_far_off_is_mended():
    """A demand that grows with the cube of the level, and one that grows with its root, from a far level."""
    powers = np.array([3.0, 0.5])
    capacities = np.array([8e-6, 5e-2])
    crossings = Crossings.of(lambda places, levels: levels ** powers[places, None], capacities, 100.0)
    assert crossings.levels(np.array([0, 1])) == pytest.approx([2e-2, 2.5e-3], rel=TO_ROUNDING)
