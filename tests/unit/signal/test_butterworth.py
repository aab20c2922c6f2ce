"""The filters of processing against those of scipy.signal, which the package no longer imports for them."""

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from rocking.signal.butterworth import filtered

NOISE = np.random.default_rng(1).normal(size=400)


@pytest.mark.parametrize("kind", ["highpass", "lowpass"])
@pytest.mark.parametrize("order", range(1, 11))
def test_a_filter_is_that_of_scipy_to_the_last_bit(order: int, kind: str) -> None:
    for corner in (0.001, 0.02, 0.1, 0.37, 0.5, 0.8):
        expected = sosfiltfilt(butter(order, corner, kind, output="sos"), NOISE, padlen=0)
        got = filtered(NOISE, order, corner, is_high=kind == "highpass")
        np.testing.assert_array_equal(got, expected)
