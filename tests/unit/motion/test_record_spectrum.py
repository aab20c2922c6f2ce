"""The record spectrum against one response at a time, and what it refuses."""

import numpy as np
import pytest
from motion_cases import noise

from rocking.errors import MotionError
from rocking.motion import integrate
from rocking.motion.batch import rocking_spectrum
from rocking.structures import EquivalentBlock

RECORD = noise(3, 800, 0.01, 4.0)


def test_spectrum_equals_the_responses():
    """Each cell is the equivalent block of that p and λ; φ_cr itself does not matter, so 0.7 is as good as any.

    The two round 1/(gλ) differently, and by the end of the record some cells answer a change of the amplitude ten
    million times over. So the difference is held against what a change of 16 roundings does to the response itself.
    """
    frequencies, multipliers = np.linspace(0.5, 6, 7), np.linspace(0.05, 0.5, 9)
    ratios = rocking_spectrum(RECORD, frequencies, multipliers, 0.85)
    assert ratios.shape == (7, 9)
    nudged = [RECORD.scaled(1 + sign * 16 * np.finfo(float).eps) for sign in (-1, 1)]
    for i, p in enumerate(frequencies):
        for j, multiplier in enumerate(multipliers):
            block = EquivalentBlock(p, 0.7, 0.7 / multiplier, 0.85)
            alone = integrate(block, RECORD).rotation_ratio
            around = [integrate(block, record).rotation_ratio for record in nudged]
            spread = max(abs(each - alone) for each in around) if np.isfinite(alone) else 0.0
            assert ratios[i, j] == pytest.approx(alone, rel=1e-12, abs=spread)
    assert np.isinf(ratios).any() and (ratios == 0).any() and ((ratios > 0) & (ratios < 1)).any()


def test_spectrum_is_the_same_on_any_number_of_threads():
    frequencies, multipliers = np.linspace(0.5, 6, 5), np.linspace(0.05, 0.5, 5)
    one, two = (rocking_spectrum(RECORD, frequencies, multipliers, 0.85, workers=n) for n in (1, 2))
    assert np.array_equal(one, two)


@pytest.mark.parametrize("values", [[0.0], [-1.0], [np.nan], [[1.0]]])
def test_values_that_are_not_positive_are_refused(values):
    with pytest.raises(MotionError, match="frequency_parameters must be"):
        rocking_spectrum(RECORD, np.array(values), np.array([0.2]), 0.9)
    with pytest.raises(MotionError, match="uplift_multipliers must be"):
        rocking_spectrum(RECORD, np.array([2.0]), np.array(values), 0.9)


def test_other_settings_are_refused_with_their_bound():
    with pytest.raises(MotionError, match=r"restitution is 1\.5, but must lie between 0 and 1"):
        rocking_spectrum(RECORD, np.array([2.0]), np.array([0.2]), 1.5)
    with pytest.raises(MotionError, match="must stay below 5000"):
        rocking_spectrum(RECORD, np.array([6000.0]), np.array([0.2]), 0.9)
