"""The parts of the compiled exact response, each against arbitrary precision, a matrix exponential or a fine grid."""

import mpmath
import numpy as np
import pytest
from scipy.linalg import expm

from rocking.motion import linear_kernel
from tests.parts import callable_parts

kernel = callable_parts(linear_kernel)


@pytest.mark.parametrize("y", [1e-3, 0.05, 0.4, 0.999, 1.001, 3.0])
def test_weights_are_the_integrals_of_a_linear_drive(y: float) -> None:
    """q' = q + d and r' = −r − d, d from d₀ to d₁: each weight is ∫ exp(±(y − s)) times the share of that end."""
    with mpmath.workdps(30):
        y_ = mpmath.mpf(y)
        shares = [lambda s: 1 - s / y_, lambda s: s / y_]
        up = [mpmath.quad(lambda s, w=w: mpmath.exp(y_ - s) * w(s), [0, y_]) for w in shares]
        down = [mpmath.quad(lambda s, w=w: mpmath.exp(s - y_) * w(s), [0, y_]) for w in shares]
        expected = [mpmath.exp(y_), mpmath.exp(-y_), *up, *down]
    # what cancels between two weights of the same end costs digits as y gets small
    assert kernel._weights(y) == pytest.approx([float(value) for value in expected], rel=1e-15 / min(y, 0.1))


@pytest.mark.parametrize("y", [0.02, 0.7, 0.999, 1.001, 2.5])
def test_the_exact_step_is_the_matrix_exponential(y: float) -> None:
    rng = np.random.default_rng(1)
    for x, w, drive, ramp in rng.normal(size=(10, 4)).tolist():
        matrix = np.array([[0, 1, 0, 0], [1, 0, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0.0]])
        after = expm(matrix * y) @ [x, w, drive, ramp]
        found = kernel._exact(x, w, drive, ramp, y)
        assert found == pytest.approx((after[0], after[1], after[0] + after[2]), rel=1e-12, abs=1e-13)
