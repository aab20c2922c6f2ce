"""Roots and minima against scipy's, and against what is known of the functions themselves."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from rocking.structures.searches import minimum, root

SMOOTH = {
    "cosine": (lambda x: math.cos(x), 0.3, 2.9),
    "line": (lambda x: 3 * x - 1, -4.0, 2.0),
    "steep": (lambda x: math.expm1(20 * x) - 1, -1.0, 2.0),
    "flat": (lambda x: (x - 0.7) ** 9, -1.0, 2.0),
    "step": (lambda x: 1.0 if x > 0.1234 else -2.0, 0.0, 1.0),
    "pole": (lambda x: 1 / x - 1e-3, 1.0, 1e6),
}
VALLEYS = {
    "parabola": lambda x: (x - 0.3) ** 2,
    "skew": lambda x: x**4 - x + 0.1 * math.sin(5 * x),
    "edge": lambda x: x,
    "kink": lambda x: abs(x - 0.618),
    "nowhere": lambda x: math.inf if x < 0.8 else x**2,
    "waves": lambda x: math.cos(9 * x),
}


@pytest.mark.parametrize("name", SMOOTH)
def test_a_root_lies_where_the_sign_changes(name):
    function, low, high = SMOOTH[name]
    found = root(function, low, high, absolute=1e-16, relative=1e-15)
    around = 2e-15 * max(abs(found), 1e-16 / 1e-15)
    assert function(found) == 0 or function(found - around) * function(found + around) <= 0
    if name != "flat":  # within some 1e-36 of zero every place is a root of that one
        assert found == pytest.approx(brentq(function, low, high, xtol=1e-16, rtol=1e-15), rel=4e-15)


def test_few_values_are_asked_for_on_the_way_to_a_root():
    asked = []
    root(lambda x: asked.append(x) or math.cos(x), 0.3, 2.9, absolute=1e-16, relative=1e-15)
    assert len(asked) <= 12  # of halves alone it would be more than 50


@pytest.mark.parametrize("name", VALLEYS)
@pytest.mark.parametrize("accuracy", [1e-3, 1e-7])
def test_a_minimum_is_sought_at_the_places_of_scipy(name, accuracy):
    ours, theirs = [], []
    with np.errstate(invalid="ignore"):
        found = minimum(lambda x: ours.append(x) or VALLEYS[name](x), -0.4, 1.9, accuracy)
        known = minimize_scalar(
            lambda x: theirs.append(x) or VALLEYS[name](x),
            bounds=(-0.4, 1.9),
            method="bounded",
            options={"xatol": accuracy},
        )
    assert ours == pytest.approx(theirs, rel=1e-12)
    assert found == (pytest.approx(known.x, rel=1e-12), pytest.approx(known.fun, rel=1e-12))
