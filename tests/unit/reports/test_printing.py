"""How cells are printed."""

import math

import pytest

from rocking.assessment.decide import ORDER, CrackFacts, Facts, Limit, decide
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.rows import PulseRow
from rocking.quantities import listed
from rocking.reports import printing
from rocking.warnings import RockingWarning


@pytest.mark.parametrize(
    ("value", "digits", "printed"),
    [
        (0.4321987, 3, "0.432"),
        (-1.9995, 3, "−2.00"),
        (1e-06, 3, "1.00×10⁻⁶"),
        (123456.7, 3, "123457"),
        (1234567.0, 3, "1.23×10⁶"),
        (100.2, 3, "100"),
        (math.inf, 3, "∞"),
        (None, 3, "–"),
        (math.nan, 3, "–"),
    ],
)
def test_a_number_keeps_its_significant_digits(value, digits, printed):
    assert printing.number(value, digits) == printed


@pytest.mark.parametrize(
    ("value", "printed"),
    [(math.inf, "overturns"), (0.0, "rests"), (4.1e-4, "rests"), (0.5, "0.500"), (math.nan, "–")],
)
def test_a_ratio_says_what_became_of_the_structure(value, printed):
    assert printing.ratio(value) == printed


def test_a_column_has_the_heading_unit_and_digits_of_its_field():
    columns = printing.columns_of(PulseRow, "component=auto start_time_s gain_m2_s3 gain_ratio rank")
    heads = ["Component", "Start time [s]", "Gain [m²/s³]", "Gain ratio [-]", "Rank"]
    assert [column[0] for column in columns] == heads
    assert [column[1] for column in columns] == ["auto", "0.8", "0.8", "0.8", "0.8"]
    assert "".join(side for *_, side, _ in columns) == "lrrrr"


def crack(falls: int) -> CrackFacts:
    """A crack with which so many of 64 members overturn."""
    return CrackFacts("hinge", falls, 64, farthest=math.inf if falls else 0.8)


@pytest.mark.parametrize(
    ("facts", "limits", "printed"),
    [
        (Facts(cracks=(crack(62),)), (), "△ 97 %"),
        (Facts(cracks=(crack(64),)), (), "▲ 100 %"),
        (Facts(cracks=(crack(0), crack(30))), (), "≈ 0–47 %"),
        (
            Facts(cracks=(crack(8),)),
            (Limit.untold(RockingWarning(AssessmentKind.CONTACTS_OPEN)),),
            "? ≥ 12 %",
        ),
        (Facts(cracks=(crack(0),), stacks=(20, 24)), (), "△ 83 %"),
        (Facts(failures=("No.",)), (), "?"),
        (Facts(cracks=(crack(0),), never_overturns_because="stays tied"), (), "■"),
        (Facts(run_ratio=0.2), (), "○ one run"),
    ],
)
def test_a_cell_holds_the_sign_and_the_share_of_its_decision(facts, limits, printed):
    assert printing.cell_text(decide(facts, limits)).replace("\u00a0", " ") == printed


def _contrast(one: str, other: str) -> float:
    """The contrast of two colours, 1 to 21 (WCAG 2)."""

    def luminance(colour: str) -> float:
        parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
        linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)


def test_each_verdict_has_a_sign_of_its_own_and_is_read_on_its_colour():
    assert list(printing.LOOKS) == list(ORDER)
    signs, fills, inks, _ = zip(*printing.LOOKS.values(), strict=True)
    assert len(set(signs)) == len(set(fills)) == len(ORDER)
    assert all(_contrast(fill, ink) >= 4.5 for fill, ink in zip(fills, inks, strict=True))


def test_names_in_a_row_are_told_apart():
    assert listed(["arch", "wall"]) == "arch, wall"
    assert listed(["nave, bay 7", "wall", "pier"], most=2) == "nave, bay 7; wall and 1 other"
