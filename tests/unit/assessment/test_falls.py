"""What falls: mechanisms where the decision trusts them, contact dynamics where it asks for it, and else two ends."""

import math
from unittest.mock import Mock
from xml.etree import ElementTree

import numpy as np
import pytest

import rocking
from rocking.assessment.contacts import contact_share
from rocking.assessment.cracks import cracks
from rocking.assessment.falls import (
    APART,
    DRAWS,
    RESERVE_APART,
    RESERVE_DRAWS,
    STONES_DRAWS,
    Falls,
    Model,
    _Rising,
    _Stones,
    falls_along,
    reserve,
)
from rocking.assessment.motions import GroundMotions
from rocking.assessment.reserve import reserve_of_members
from rocking.assessment.settings import AssessmentSettings
from rocking.fragility.hazard import Hazard
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, Structure, structure_from_config

SETTINGS = AssessmentSettings()
SLIDER = Block.of_size(1.6, 2.0)
"""It slides at 0.6 g, before it lifts."""
SPIRE: Structure = structure_from_config(
    {"type": "spire", "width_m": 2.2, "height_m": 10.0, "wall_thickness_m": 0.25}
)
PIERS: Structure = structure_from_config(
    {
        "type": "arch_on_piers",
        "radius_m": 4.0,
        "thickness_m": 0.7,
        "embrace_angle_deg": 150,
        "pier_width_m": 1.4,
        "pier_height_m": 4.0,
    }
)


FRONT: Structure = structure_from_config(
    {
        "type": "facade",
        "storey_heights_m": [3.4, 3.0],
        "thicknesses_m": [0.45, 0.4],
        "unit_weight_kN_m3": 18,
        "floor_loads_kN_m": [8, 6],
        "behind": "cross_walls",
        "restitution": 0.5,
        "tie_heights_m": [6.0],
        "tie_stiffness_kN_m2": 20000,
    }
)


def shaken(peak_g: float, period: float = 0.8) -> Accelerogram:
    """Three cycles that swell and fade."""
    times = np.arange(600) * 0.01
    shape = np.sin(2 * np.pi * times / period) * np.exp(-(((times - 3) / 1.0) ** 2))
    return Accelerogram(peak_g * 9.80665 * shape / np.abs(shape).max(), 0.01)


def under(structure: Structure, peak_g: float, ratios: list[float], contacts: bool = True) -> Falls:
    (told,) = falls_along(
        structure, SETTINGS, shaken(peak_g), np.ones(1), np.array([ratios]), contacts=contacts
    )
    assert told is not None
    return told


def test_members_tell_of_a_body_that_nothing_is_in_doubt_of():
    slender = Block.of_size(0.6, 4.0)
    assert under(slender, 0.5, [0.2, math.inf, 0.4, 0.1]) == Falls(0.25, 0.25, Model.MECHANISM)


def test_what_slides_first_stands_or_falls_and_the_decision_cannot_tell_either():
    motion = shaken(2.0)
    assert under(SLIDER, 2.0, [0.3, 0.2]) == Falls(0.0, 1.0, Model.NONE)
    assert str(rocking.assess(motion, SLIDER).verdict) == "cannot be told"
    assert under(SLIDER, 0.3, [0.0, 0.0]) == Falls(0.0, 0.0, Model.MECHANISM), "it neither slides nor lifts"


def test_courses_that_may_be_thrown_are_followed_and_all_of_them():
    motions = GroundMotions.of(shaken(0.5))
    runs = contact_share(SPIRE, motions, SETTINGS, DRAWS, until_sure=False)
    assert runs.runs == DRAWS, "none is left out once the word is sure"
    share = runs.falls / runs.runs
    assert under(SPIRE, 0.5, [0.1, 0.2]) == Falls(share, share, Model.CONTACTS)
    assert under(SPIRE, 0.5, [0.1, 0.2], contacts=False) == Falls(0.0, 1.0, Model.NONE)
    assert under(SPIRE, 0.5, [math.inf, math.inf]) == Falls(1.0, 1.0, Model.MECHANISM)


def test_a_wall_whose_anchors_slide_out_is_followed_as_stacks_also_at_rest():
    motions = GroundMotions.of(shaken(0.8))
    assert motions.excitation > FRONT.anchors_slide_at
    runs = contact_share(FRONT, motions, SETTINGS, DRAWS, until_sure=False)
    assert runs.falls
    share = runs.falls / runs.runs
    assert under(FRONT, 0.8, [0.0, 0.1]) == Falls(share, share, Model.CONTACTS)
    assert under(FRONT, 0.8, [0.0, 0.0]).low == share
    assert under(FRONT, 0.8, [0.0, 0.1], contacts=False) == Falls(0.0, 0.0, Model.MECHANISM)


def test_of_an_arch_on_piers_only_its_stones_may_say_that_it_stands():
    assert under(PIERS, 0.5, [0.1, math.inf], contacts=False) == Falls(0.5, 1.0, Model.NONE)


def test_stones_fall_from_the_middle_of_their_rung_on(monkeypatch):
    stones = _Stones(PIERS, shaken(0.4), SETTINGS)
    stones._rungs = np.array([0, 3])
    lifts = cracks(PIERS).counting.least_multiplier * GRAVITY / shaken(0.4).peak_acceleration
    places = (-0.51, -0.49, 2.49, 2.51)
    assert [stones.share_at(lifts * APART**place) for place in places] == [0.0, 0.5, 0.5, 1.0]
    monkeypatch.setattr(
        "rocking.assessment.falls.draws_of_parts", Mock(side_effect=rocking.StructureError("no."))
    )
    assert math.isnan(_Stones(PIERS, shaken(0.4), SETTINGS).share_at(1.0))


@pytest.mark.process
def test_stones_fall_from_the_factor_on_at_which_they_do_when_followed_by_themselves():
    """At each factor as many of them as fall there, within a rung."""
    record = shaken(0.4)
    factors = np.array([0.3, 0.7, 1.4])
    along = falls_along(PIERS, SETTINGS, record, factors, np.full((3, 1), 0.1))
    found = [told.low for told in along if told is not None]
    shares = []
    for factor in factors.tolist():
        near = []
        for side in (1 / APART, 1.0, APART):
            motions = GroundMotions.of(record.scaled(factor * side))
            runs = contact_share(PIERS, motions, SETTINGS, STONES_DRAWS, until_sure=False)
            near.append(runs.falls / runs.runs)
        shares.append((min(near), max(near)))
    assert all(low <= share <= high for share, (low, high) in zip(found, shares, strict=True))
    assert found[0] == 0.0 < found[-1]


@pytest.fixture(scope="module")
def slider_curve() -> rocking.Fragility:
    records = [shaken(1.0, period) for period in (0.5, 0.8, 1.2)]
    return rocking.fragility(
        records, SLIDER, levels=[0.1, 0.5, 1.0, 2.0], stations=list("abc"), events=list("ABC")
    )


def test_a_curve_with_two_ends_is_called_the_lower_one_and_gives_no_rate(slider_curve):
    """A curve of 0 alone would say that what slides never falls."""
    upper = slider_curve.upper
    assert slider_curve.probability.max() == 0 and upper is not None and upper.probability.max() == 1
    assert "mechanism alone, the lower end" in repr(slider_curve)
    assert slider_curve.interval == (upper.interval[0], math.inf)
    assert math.isnan(slider_curve.dispersion) and math.isnan(slider_curve.lognormal_median)
    rate = slider_curve.annual_rate(
        Hazard(np.array([0.1, 1.0, 4.0]), np.array([1e-2, 1e-3, 1e-5]), unit="m/s")
    )
    assert math.isnan(rate.value) and rate.low == 0 < rate.high


def test_openquake_gets_the_safe_end_with_its_reason(slider_curve, tmp_path):
    slider_curve.to_nrml(tmp_path / "curve.xml", name="slider")
    root = ElementTree.parse(tmp_path / "curve.xml").getroot()
    space = {"n": "http://openquake.org/xmlns/nrml/0.5"}
    poes = root.find(".//n:poes", space).text.split()
    assert [float(value) for value in poes] == pytest.approx(
        slider_curve.upper.probability.tolist(), abs=1e-9
    )
    assert "upper ends, in which what cannot be told falls" in root.find(".//n:description", space).text


def test_a_question_whose_answer_rises_is_asked_between_its_answers_alone():
    asked = []
    rising = _Rising(lambda factor: asked.append(factor) or factor >= 0.05)
    assert [rising(factor) for factor in (0.04, 0.06, 0.03, 7.0, 0.05)] == [False, True, False, True, True]
    assert asked == [0.04, 0.06, 0.05]


def test_the_reserve_of_a_spire_is_where_its_stacks_fall():
    """Followed one after the other at factors on the motion: first one of them falls, then half, then all."""
    record = shaken(0.2)
    motions = GroundMotions.of(record)
    found = reserve(SPIRE, cracks(SPIRE).counting[0], motions, SETTINGS)
    assert math.isnan(reserve_of_members(SPIRE.mechanism(), motions).low), (
        "its mechanism stands up to the limit"
    )
    assert found.low <= found.median <= found.high < found.limit
    near = RESERVE_APART**0.5
    for share, factor in ((0.05, found.low), (0.5, found.median), (0.95, found.high)):
        falling = []
        for side in (1 / near, near):
            runs = contact_share(
                SPIRE, motions.scaled(factor * side), SETTINGS, RESERVE_DRAWS, until_sure=False
            )
            falling.append(runs.falls / runs.runs >= share)
        assert falling == [False, True]
