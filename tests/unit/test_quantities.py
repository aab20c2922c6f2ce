"""The one g, and the doors of units."""

import math
from functools import partial

import numpy as np
import pytest
from scipy.constants import g

from rocking.errors import RecordError, StructureError
from rocking.quantities import (
    GRAVITY,
    acceleration_factor,
    counted,
    escaped,
    finite,
    four_digits,
    instance,
    listed,
    percent,
    percents,
    positive,
    shown,
    velocity_unit,
    whole,
    within,
)
from tests.refusals import refused


def test_gravity_is_the_standard_one():
    assert g == GRAVITY


@pytest.mark.parametrize(("unit", "factor"), [
    ("m/s2", 1.0), ("mm/s2", 1e-3), ("um/s2", 1e-6), ("nm/s2", 1e-9), ("ft/s2", 0.3048), ("in/s2", 0.0254),
    ("%g", g / 100), ("g/10", g / 10), ("g", g), ("cm/s²", 0.01), ("cm/s/s", 0.01), ("GAL", 0.01), ("m/s**2", 1.0),
    ("mg", g / 1000), ("4.71e-6 m/s2", 4.71e-6), ("2 gal", 0.02), ("metres per second squared", 1.0), ("µm/s²", 1e-6),
    ("centimeters/sec/sec", 0.01), ("m s⁻²", 1.0), ("m/(s^2)", 1.0), ("cms/s/s", 0.01), ("inch/sec2", 0.0254),
    ("см/с²", 0.01), ("ガル", 0.01), ("gals", 0.01), ("G's", g), ("gravity", g), ("milli-g", g / 1000),
    ("% g", g / 100),
])  # fmt: skip
def test_spellings(unit, factor):
    assert acceleration_factor(unit) == pytest.approx(factor, rel=1e-15)


@pytest.mark.parametrize("unit", ["furlong", "0 m/s2", "1e999 g", "m/s", "counts", ""])
def test_an_unknown_unit_is_refused_with_the_known_ones(unit):
    with refused(RecordError, "unit", unit):
        acceleration_factor(unit)


@pytest.mark.parametrize(("unit", "known"), [
    ("m/s", "m/s"), ("CM/SEC", "cm/s"), ("cm_s", "cm/s"), (" mm_per_sec ", "mm/s"), ("m/s2", None), ("km/h", None),
])  # fmt: skip
def test_units_of_velocity(unit, known):
    assert velocity_unit(unit) == known


@pytest.mark.parametrize(("check", "allowed", "others"), [
    (finite, (-1, 0, 2.5), (True, "1", b"1", None, 10**400, math.inf, -math.inf, [1])),
    (positive, (1e-300, 3), (0, -1, False)),
    (partial(within, low=-1.0, high=2.0), (-1, 0, 2), (-1.001, 2.001)),
    (lambda _, field, value: whole(field, value, 2, 5), (2, 3.0, 5), (1, 6, 2.5, "3")),
])  # fmt: skip
def test_what_a_check_lets_in_is_a_number_and_the_rest_is_refused_by_name(check, allowed, others):
    for value in allowed:
        assert check(StructureError, "width", value) == value
    for value in others:
        with refused(StructureError, "width", value):
            check(StructureError, "width", value)


@pytest.mark.parametrize(("value", "text"), [
    pytest.param(10**5000, "a number of thousands of digits", id="huge"), (np.eye(2), "array([[1., 0.], [0., 1.]])"),
    ("a" * 98, repr("a" * 98)), ("a" * 99, f"'{'a' * 99}… (101 characters)"),
])  # fmt: skip
def test_a_value_is_repeated_in_one_line_as_far_as_there_is_room(value, text):
    assert shown(value) == text


def test_what_is_of_another_type_is_refused_with_its_type():
    instance(RecordError, "record", 1.0, float)
    for value, kinds, words in (
        (1, (str,), "record is an int, but must be a str."),
        ([1], (Exception, str), "record is a list, but must be an Exception or str; give one of its items."),
        ((), (ArithmeticError,), "record is a tuple, but must be an ArithmeticError; give one of its items."),
    ):
        with refused(RecordError, "record", value) as caught:
            instance(RecordError, "record", value, *kinds)
        assert str(caught.value) == words


def test_what_a_terminal_shows_has_no_control_characters_but_ends_of_lines_and_tabs():
    assert escaped("a\tb\n\x1b[0m\u202e\x7f") == "a\tb\n\\x1b[0m\\u202e\\x7f"


def test_numbers_in_sentences():
    assert (four_digits(1234.56, "m"), four_digits(0.00012345)) == ("1235 m", "0.0001234")
    assert (counted(1, "impact"), counted(0, "impact"), counted(2, "impact")) == (
        "1 impact",
        "0 impacts",
        "2 impacts",
    )


@pytest.mark.parametrize(("share", "printed"), [
    (0.0, "0"), (1e-9, "0"), (0.0004, "0"), (0.0005, "0.05"), (0.004, "0.4"), (0.06, "6"), (0.094, "9"), (0.096, "10"),
    (0.1, "10"), (1.0, "100"),
])  # fmt: skip
def test_a_share_in_percent_has_one_digit_below_ten_and_is_whole_from_there_on(share, printed):
    assert percent(share) == printed


def test_a_range_of_shares_is_one_number_where_all_are_printed_alike():
    assert percents(0.2, 0.6, 0.11) == "11–60\u00a0%"
    assert percents(0.112, 0.114) == percents(0.11) == "11\u00a0%"


def test_names_beyond_the_most_are_counted_even_if_it_is_one():
    assert listed(["a", "b"], most=2) == "a, b"
    assert listed(["a", "b", "c"], most=2) == "a, b and 1 other"
    assert listed(["a", "b,", "c", "d"], most=2) == "a; b, and 2 others"
