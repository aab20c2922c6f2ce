"""The one g, and the doors of units."""

import pytest
from scipy.constants import g

from rocking.errors import RecordError
from rocking.quantities import GRAVITY, acceleration_factor, listed, percent, percents
from tests.refusals import refused


def test_gravity_is_the_standard_one():
    assert g == GRAVITY


@pytest.mark.parametrize(
    ("unit", "factor"),
    [("g", g), ("cm/s²", 0.01), ("cm/s/s", 0.01), ("GAL", 0.01), ("m/s**2", 1.0), ("mg", g / 1000)],
)
def test_spellings(unit, factor):
    assert acceleration_factor(unit) == factor


def test_an_unknown_unit_is_refused_with_the_known_ones():
    with refused(RecordError, "unit", "furlong"):
        acceleration_factor("furlong")


@pytest.mark.parametrize(
    ("share", "printed"),
    [
        (0.0, "0"),
        (1e-9, "0"),
        (0.0004, "0"),
        (0.0005, "0.05"),
        (0.004, "0.4"),
        (0.06, "6"),
        (0.094, "9"),
        (0.096, "10"),
        (0.1, "10"),
        (1.0, "100"),
    ],
)
def test_a_share_in_percent_has_one_digit_below_ten_and_is_whole_from_there_on(share, printed):
    assert percent(share) == printed


def test_a_range_of_shares_is_one_number_where_all_are_printed_alike():
    assert percents(0.2, 0.6, 0.11) == "11–60\u00a0%"
    assert percents(0.112, 0.114) == percents(0.11) == "11\u00a0%"


def test_names_beyond_the_most_are_counted_even_if_it_is_one():
    assert listed(["a", "b"], most=2) == "a, b"
    assert listed(["a", "b", "c"], most=2) == "a, b and 1 other"
    assert listed(["a", "b,", "c", "d"], most=2) == "a; b, and 2 others"
