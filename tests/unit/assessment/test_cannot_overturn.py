"""What cannot overturn: a verdict of its own, what it says, and what is left out of it, in words."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rocking
from rocking.assessment.decide import ORDER, Verdict
from rocking.assessment.rows import structure_rows
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.errors import StructureError
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, LoadedWall, Wall
from rocking.structures.kinds import StructureKind
from tests.made_structures import HELD
from tests.refusals import refused

ALONE = HELD.mechanism()
FREE_INWARDS = replace(HELD, one_sided=False)
SPECTRUM = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)


def record(amplitude: float) -> Accelerogram:
    return Accelerogram(
        Pulse(amplitude=amplitude, circular_frequency=6.0, start_time=0.2).acceleration(
            np.arange(600) * 0.01
        ),
        0.01,
        station="made",
    )


def test_it_is_the_verdict_where_the_structure_stands_and_nothing_can_let_it_fall():
    assessed = rocking.assess(record(8.0), ALONE)
    untied = replace(HELD, tie_heights=(), tie_stiffness=0.0)
    assert assessed.verdict is Verdict.CANNOT_OVERTURN
    # uplift does not feel an elastic tie without pretension
    assert f"lifts at {untied.mechanism().uplift_multiplier:.3g} g" in assessed.why
    assert "without a tie_strength" in assessed.why
    assert assessed.overturning_members == 0
    assert assessed.rotation_ratio > 0
    assert assessed.reserve is None


def test_a_wall_that_may_bulge_below_its_tie_can_overturn():
    """No tie that holds one body for good keeps the wall from opening between its foot and the tie."""
    assert not HELD.mechanism().can_overturn
    low, high = (rocking.assess(record(value), HELD) for value in (8.0, 60.0))
    assert low.verdict is not Verdict.CANNOT_OVERTURN
    assert high.verdict is Verdict.OVERTURNS
    assert "bulges between" in high.crack


def test_a_side_without_ties_still_falls():
    assessed = rocking.assess(record(8.0), FREE_INWARDS)
    assert assessed.verdict is Verdict.OVERTURNS
    assert assessed.response.peak_side == -1


def test_a_tie_that_may_break_lets_it_fall():
    """The same wall whose tie breaks below what holds it is no case of it."""
    weak = replace(HELD, tie_strength=1e3)
    assert weak.mechanism().can_overturn
    assert rocking.assess(record(8.0), weak).verdict is Verdict.OVERTURNS


def test_a_crack_that_can_fall_is_followed_instead_of_those_that_cannot():
    """A tie of 100 kN/m² holds this wall for good above mid-height, and not where the hinge opens far below it."""
    softer = replace(HELD, tie_stiffness=1e5)
    assert not softer.cracked_at(1.9).mechanism().can_overturn
    assert softer.cracked_at(0.5).mechanism().can_overturn
    followed = replace(softer, crack=None).candidates()
    assert followed
    assert all(crack.structure.mechanism().can_overturn for crack in followed)
    stronger = replace(HELD, tie_stiffness=2e5, crack=None)
    (bulge,) = (
        candidate for candidate in stronger.candidates() if candidate.structure.mechanism().can_overturn
    )
    assert "bulges between" in bulge.name


def test_it_is_the_mildest_verdict():
    assert ORDER[-1] is Verdict.CANNOT_OVERTURN
    assert Verdict.CANNOT_OVERTURN.stays_up


def test_the_nonlinear_check_is_that_of_the_bulge():
    checked = rocking.check(HELD, SPECTRUM)
    untied = rocking.check(replace(HELD, tie_heights=(), tie_stiffness=0.0), SPECTRUM)
    assert checked.linear.capacity == pytest.approx(untied.linear.capacity, rel=1e-9)
    assert "bulges between" in checked.nonlinear.mechanism
    assert checked.warning.kind is StructureKind.TIE_MUST_BEAR


def test_what_it_carries_may_fall_though_it_cannot():
    """The limit displacement is then where the support is lost, whatever d₀."""
    checked = rocking.check(HELD, SPECTRUM, support_loss=0.05)
    point = checked.limit
    assert checked.nonlinear is not None
    assert "carries falls" in str(point.reason)
    assert point.displacement == pytest.approx(0.05 * checked.governing.static.displacement_factor)


def test_it_has_no_fragility():
    with refused(StructureError, "structure", ALONE.never_overturns_because):
        rocking.fragility([record(4.0), record(5.0)], ALONE, stations=["a", "b"], levels=[0.2, 0.6])


@pytest.mark.parametrize("crack", [pytest.param(None, marks=pytest.mark.slow), "known"])
def test_the_verdict_and_the_fragility_ask_the_same_cracks(crack):
    """A hinge that is typed below a tie: no record may stand as a word says where a curve says that none can fall."""
    wall = LoadedWall.of_size(3.2, 0.25, 20e3, 1.9, tie_heights=(3.0,), tie_stiffness=5e5, crack=crack)
    settings = AssessmentSettings(ensemble=EnsembleSettings(reserve=0))
    word = rocking.assess(record(3.0), wall, settings=settings).verdict
    try:
        rocking.fragility([record(4.0), record(5.0)], wall, stations=["a", "b"], levels=[0.2, 0.6])
    except StructureError as refusal:
        assert "cannot overturn" in str(refusal)
        assert word is Verdict.CANNOT_OVERTURN
    else:
        assert word is not Verdict.CANNOT_OVERTURN


def test_its_row_has_no_block():
    (row,) = structure_rows({"held": HELD})
    assert np.isnan([row.critical_rotation_rad, row.frequency_parameter_rad_s]).all()
    assert row.uplift_multiplier == pytest.approx(HELD.mechanism().uplift_multiplier)


@pytest.mark.slow
def test_a_structure_without_a_block_has_a_row_beside_the_others():
    """A wall ten times as broad as high has no block exact at rest; its row leaves that out, and names the others."""
    flat, block = structure_rows(
        {"flat": Wall.of_size(3.0, 30.0, restitution=0.5), "block": Block.of_size(1.0, 6.0)}
    )
    assert math.isnan(flat.frequency_parameter_at_rest_rad_s) and math.isnan(flat.restoring_defect)
    assert flat.critical_rotation_rad > 0.0
    own = math.sqrt(3 * GRAVITY / (4 * math.hypot(1.0, 6.0) / 2))  # Housner (1963): p² = 3g/(4R)
    assert block.frequency_parameter_rad_s == pytest.approx(own, rel=1e-12)
