"""What moves so far below what it carries that this loses its bearing counts as fallen."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocking import Accelerogram, Block, Facade, Verdict
from rocking.assessment.assessor import Assessor
from rocking.assessment.case import CaseResult
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack, loses_seat_at
from rocking.assessment.ensemble import Ensemble
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import Method
from rocking.assessment.motions import GroundMotions
from rocking.assessment.reserve import reserve_of_members
from rocking.assessment.scene import CheckTerms, Scene
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.motion.response import Response
from rocking.structures import Outcome

FRONT = Facade((3.0,), (0.5,), 20e3, floor_loads=(5e3,), crack="known", crack_storey=1)


def test_a_floor_loses_its_bearing_where_the_top_has_moved_so_far():
    """By hand: a point of the top, at the middle of .5 m, turns about the toe: u = h sin φ + b (1 − cos φ)/2."""
    side = FRONT.mechanism().positive
    for phi in (0.02, 0.1):
        by_hand = 3.0 * np.sin(phi) + 0.25 * (1 - np.cos(phi))
        assert FRONT.linkages[0].moved_from_bearings(phi) == pytest.approx(by_hand, rel=1e-12)
    loss = FRONT.linkages[0].moved_from_bearings(0.4 * side.critical_rotation)
    assert loses_seat_at(FRONT, loss) == pytest.approx(0.4, rel=1e-4)
    assert loses_seat_at(FRONT, 2.0) == math.inf
    bare = replace(FRONT, floor_loads=())
    assert bare.linkages[0].moved_from_bearings(0.1) == 0 and loses_seat_at(bare, 1e-6) == math.inf
    assert loses_seat_at(Block.of_size(0.5, 3.0), 1e-6) == math.inf


@pytest.mark.parametrize("members", [0, 64])
def test_a_front_that_stands_falls_once_its_floor_is_said_to_lose_a_short_bearing(members):
    times = np.arange(0, 4, 0.01)
    swing = 1.35 * FRONT.static_multiplier * 9.80665 * np.sin(2 * np.pi * times / 0.5) * (times < 3)
    motion = Accelerogram(swing, 0.01)
    settings = AssessmentSettings(ensemble=EnsembleSettings(members=members))
    found = {}
    for loss in (math.inf, 1e-4):
        scene = Scene("front", FRONT, terms=CheckTerms(support_loss=loss))
        result = Assessor(settings).assess("record", (motion,), {"front": scene})
        found[loss] = result
    without, lost = (result.scenes["front"].worst for result in found.values())
    assert without.verdict in (Verdict.STANDS, Verdict.PROBABLY_STANDS)
    assert lost.verdict in (Verdict.OVERTURNS, Verdict.PROBABLY_OVERTURNS, Verdict.UNCERTAIN)
    if members:
        assert lost.verdict is Verdict.OVERTURNS
    else:
        assert AssessmentKind.SEATS in {warning.kind for warning in lost.cases[""].facts(FRONT).settling}


@pytest.mark.parametrize(
    "run, members, lost", [(0.1, 0.1, False), (0.1, 0.5, True), (0.5, 0.1, True), (0.5, 0.5, True)]
)
def test_a_bearing_is_lost_under_the_run_or_a_member_that_moves_so_far(run, members, lost):
    """At 0.4 of the critical rotation; of four members two turn as far as said."""
    loss = FRONT.linkages[0].moved_from_bearings(0.4 * FRONT.mechanism().positive.critical_rotation)
    response = Response(rotation_ratio=run, outcome=Outcome.ROCKS)
    several = Ensemble(np.array([0.1, members, members, math.inf]), {}, EnsembleSettings())
    followed = CrackEnsembles((FollowedCrack("as described", 0.0, several),))
    case = CaseResult(component="", responses={Method.MECHANISM_ON_RECORD: response}, ensembles=followed)
    found = case.losing_seats(FRONT, loss)
    assert found.seat_lost is lost
    assert found.ensembles.followed[0].ensemble.overturning_members == (3 if members > 0.4 else 1)
    assert case.losing_seats(FRONT, math.inf) is case


def test_the_reserve_counts_what_loses_its_bearing():
    """Its factors are those of the rotation that each member reaches: of a half as large a bearing none is larger."""
    times = np.arange(0, 4, 0.01)
    swing = 0.6 * FRONT.static_multiplier * 9.80665 * np.sin(2 * np.pi * times / 0.8) * (times < 3)
    motions = GroundMotions.of(Accelerogram(swing, 0.01))
    settings = EnsembleSettings(members=16, reserve=8.0)
    loss = FRONT.linkages[0].moved_from_bearings(0.1 * FRONT.mechanism().positive.critical_rotation)
    overturns, loses = (
        reserve_of_members(FRONT.mechanism(), motions, settings, falls_beyond=loses_seat_at(FRONT, seat))
        for seat in (math.inf, loss)
    )
    assert loses.median < 0.97 * overturns.median and loses.low <= overturns.low
    assert reserve_of_members(FRONT.mechanism(), motions, settings) == overturns
