"""How cells are printed."""

import pytest

from rocking.reports import printing


@pytest.mark.parametrize(
    ("text", "digits", "printed"),
    [
        ("0.4321987", 3, "0.432"),
        ("-1.9995", 3, "−2.00"),
        ("1e-06", 3, "1.00×10⁻⁶"),
        ("123456.7", 3, "123457"),
        ("1234567", 3, "1.23×10⁶"),
        ("100.2", 3, "100"),
        ("INF", 3, "∞"),
        ("", 3, "–"),
        ("nan", 3, "–"),
    ],
)
def test_a_number_keeps_its_significant_digits(text, digits, printed):
    assert printing.number(text, digits) == printed


@pytest.mark.parametrize(
    ("text", "printed"), [("INF", "overturns"), ("0.0", "no uplift"), ("0.5", "0.500"), ("", "–")]
)
def test_a_ratio_says_what_became_of_the_structure(text, printed):
    assert printing.ratio(text) == printed


def test_a_chosen_number_has_no_trailing_zeros():
    assert [printing.given(text) for text in ("12.5", "1.0", "1e-06", "")] == ["12.5", "1", "1×10⁻⁶", "–"]


def test_counts_are_words_up_to_twelve():
    assert printing.counted(1, "case") == "one case"
    assert printing.counted(0, "case") == "no cases"
    assert printing.counted(13, "case") == "13 cases"


def test_sizes_carry_their_units_and_defaults_are_left_out():
    text = (
        "Arch(radius=10.0, thickness=1.5, embrace_angle=2.748893571891069, voussoirs=None, restitution=None)"
    )
    assert printing.geometry(text) == "radius 10 m, thickness 1.5 m, embrace angle 2.749 rad"


def test_a_geometry_without_sizes_stands_as_it_is():
    assert printing.geometry("something else") == "something else"
