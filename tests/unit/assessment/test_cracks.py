"""Cracks that may form, each followed where that of statics stands, candidates over the height, and processing."""

import math
from dataclasses import replace
from functools import partial
from unittest.mock import Mock

import numpy as np
import pytest

import rocking
from rocking.assessment import contacts
from rocking.assessment.assessor import Assessor
from rocking.assessment.cracks import crack_named, cracks, ensemble_over_cracks, slides_at
from rocking.assessment.decide import Verdict, decide
from rocking.assessment.ensemble import ensemble
from rocking.assessment.evidence import walls
from rocking.assessment.evidence.walls import tie_swing
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import GroundMotions, Motion, processed
from rocking.assessment.one_case import (
    compute_case,
    other_cracks,
    other_processings,
    predict,
)
from rocking.assessment.rows import rows_of_record
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.fragility.curves import fragility
from rocking.motion import integrate
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Arch, Block, Facade, LoadedWall, Spire, Wall
from rocking.structures.joints import Joints
from rocking.structures.structure import AS_DESCRIBED
from tests.unit.assessment.made_rows import component_of

STEP, TIMES = 0.01, np.arange(0, 4, 0.01)
SPIRE = Spire(width=3.0, height=15.0, wall_thickness=0.3)
WALL = Wall.of_size(6.0, 0.4, 3.0)
LOW_WALL = Wall(2.0, 2.0, 0.3)
ROUGH = Joints(5.0)
"""Joints that nothing lets slide, so that something else limits a word."""
PULSE = Pulse(amplitude=2.5, circular_frequency=2 * np.pi / 0.9, start_time=3.0)
SINE = Accelerogram(PULSE.acceleration(np.arange(2000) * STEP), STEP)
assess = partial(rocking.assess, settings=AssessmentSettings(ensemble=EnsembleSettings(reserve=0)))


def record(amplitude: float, period: float = 0.9) -> Accelerogram:
    wave = np.sin(2 * np.pi * TIMES / period) * np.exp(-(((TIMES - 1.5) / 0.8) ** 2))
    return Accelerogram(amplitude * wave / np.abs(wave).max(), STEP)


@pytest.mark.parametrize(
    ("structure", "expected"),
    [(WALL, {Verdict.STANDS, Verdict.OVERTURNS}), (SPIRE, {Verdict.CANNOT_BE_TOLD})],
)
def test_the_verdict_and_every_number_are_those_of_all_cracks_followed_one_by_one(structure, expected):
    """The oracle follows every crack in full; a spire, which tapers, never stands once it has lifted."""
    seen = set()
    for severity in (1.5, 3.5, 5.0, 14.0):
        motion = record(severity * structure.static_multiplier * 9.80665)
        assessment = assess(motion, structure)
        motions = GroundMotions.of(motion)
        alone = {crack.description: ensemble(crack.mechanism, motions) for crack in cracks(structure)}
        words = {name: one_part.facts().step(0.05) for name, one_part in alone.items()}
        of_statics = words[cracks(structure)[0].description]
        worst = max(words.values(), key=lambda word: word.badness)
        if of_statics in (Verdict.STANDS, Verdict.PROBABLY_STANDS):
            worst = min(worst, Verdict.UNCERTAIN, key=lambda word: word.badness)
        elif of_statics is not Verdict.OVERTURNS:
            worst = min(worst, Verdict.PROBABLY_OVERTURNS, key=lambda word: word.badness)
        (case,) = assessment.cases.values()
        # Of its members alone: friction, and how far a held wall turns, are not asked of cracks one by one.
        passed_over = (AssessmentKind.FRICTION_SHORT, AssessmentKind.HELD_BEYOND)
        limits = [limit for limit in case.limits if limit.warning.kind not in passed_over]
        without = decide(replace(case.facts(structure), stacks=None), limits)
        if structure.joints.courses_taper and worst.badness < Verdict.PROBABLY_OVERTURNS.badness:
            assert without.verdict is Verdict.CANNOT_BE_TOLD
            assert without.why.startswith("courses above a rocking body may be thrown; ")
        else:
            assert without.verdict is worst
        assert assessment.crack in alone or not assessment.crack
        if of_statics is not Verdict.OVERTURNS:
            largest = max(part.overturning_share for part in alone.values())
            # 64 members beside the many to which an ensemble near an edge grows
            share = assessment.ensembles.governing.ensemble.overturning_share
            assert share == pytest.approx(largest, abs=1 / 32)
        seen.add(without.verdict)
    assert expected <= seen


@pytest.mark.parametrize("structure", [WALL, SPIRE, Arch(5.0, 0.8, np.radians(150))])
def test_no_crack_is_followed_beyond_doubt_and_none_by_more_than_its_ensemble(structure):
    doubted = []
    for severity in (1.01, 1.5, 2.5, 3.5, 5.0, 8.0, 200.0):
        motions = GroundMotions.of(record(severity * structure.static_multiplier * 9.80665))
        followed = ensemble_over_cracks(structure, motions, AssessmentSettings()).followed
        doubted.append(len(followed) - 1)
        assert len({crack.description for crack in followed}) == len(followed) <= len(cracks(structure))
    assert doubted[0] == 0, "what hardly lifts leaves no other crack in doubt"
    assert doubted[-1] == 0, "what overturns by statics already needs no other crack"
    assert max(doubted) > 0


def test_the_counts_that_are_told_of_two_cracks_are_not_of_members_that_leave_their_words_open():
    """With 16 members asked for, the crack of statics and all that may change the word grow by the same rule."""
    settings = AssessmentSettings(ensemble=EnsembleSettings(members=16))
    both = 0
    structure = WALL
    for severity in (2.0, 2.5, 3.0, 3.5, 4.0, 5.0):
        motions = GroundMotions.of(record(severity * structure.static_multiplier * 9.80665))
        ensembles = ensemble_over_cracks(structure, motions, settings)
        both += ensembles.governing is not ensembles.followed[0]
        for case in (ensembles.followed[0], *ensembles.deciding):
            assert case.ensemble.members == 1024 or not case.facts.is_near_an_edge(
                case.ensemble.settings.risk
            )
    assert both


def test_a_crack_that_is_known_decides_and_what_falls_beside_it_is_told():
    """Hinged at mid-height the wall stands where it falls with the hinge that statics chooses.

    Its members are those of that mechanism alone; typed without being known it takes no other one away.
    """
    typed = Wall.of_size(6.0, 0.4, 3.0)
    motion = record(1.2 * typed.mechanism().uplift_multiplier * 9.80665)
    known = assess(motion, replace(typed, crack="known"))
    alone = assess(motion, typed.mechanism())
    assert (known.verdict, known.overturning_members) == (alone.verdict, alone.overturning_members)
    assert np.array_equal(known.rotation_ratios, alone.rotation_ratios)
    of_typed, of_statics = (assess(motion, case) for case in (typed, Wall.of_size(6.0, 0.4)))
    assert of_typed.overturning_members >= of_statics.overturning_members > known.overturning_members
    assert of_typed.verdict is of_statics.verdict
    assert of_typed.verdict.badness > known.verdict.badness
    assert known.statics.ensemble.overturning_members == of_typed.overturning_members
    assert known.statics_crack == of_typed.crack
    assert [one_warning.kind for one_warning in known.decision.warnings] == [AssessmentKind.OTHER_CRACK_WORSE]
    assert [warning.kind for warning in of_typed.decision.warnings] == [AssessmentKind.HELD_BEYOND]


def test_a_body_that_needs_more_friction_than_it_has_slides_as_the_ground_reaches_that_friction():
    """Coulomb: μ g below tan α g, and never on more friction than tan α."""
    block = Block.of_size(1.0, 1.25)
    slide = [slides_at(cracks(block.on_joints(Joints(friction)))[0]) for friction in (0.3, 0.6, 0.81)]
    assert slide == pytest.approx([0.3, 0.6, math.nan], nan_ok=True)


def test_what_slides_first_is_followed_as_if_it_lifted_and_makes_no_word():
    """Its count is that of its mechanism alone; on joints that let nothing slide it takes part in the word."""
    friction = 0.5
    wall = WALL.on_joints(Joints(friction))
    slides = cracks(wall)[0]
    settings = AssessmentSettings()
    in_doubt = 0
    for severity in (1.6, 1.8, 2.0, 3.5):
        motions = GroundMotions.of(record(severity * wall.static_multiplier * 9.80665))
        ensembles = ensemble_over_cracks(wall, motions, settings)
        assert slides.description not in [crack.description for crack in ensembles.followed]
        for left_out in ensembles.left_out:
            assert left_out.slides_at == pytest.approx(
                slides.mechanism.uplift_multiplier * friction / 0.596, rel=2e-3
            )
            alone = ensemble(slides.mechanism, motions, settings.ensemble, grows=False)
            assert left_out.facts.count == alone.facts().count
        in_doubt += len(ensembles.left_out)
        on_rough = ensemble_over_cracks(WALL.on_joints(ROUGH), motions, settings)
        assert on_rough.followed[0].description == slides.description and not on_rough.left_out
    assert in_doubt


def test_the_crack_that_governs_is_found_by_its_description():
    several = cracks(WALL)
    assert len(several) > 3
    assert all(crack_named(WALL, part.description) is part for part in several)
    assert crack_named(WALL, AS_DESCRIBED) is several[0]


def test_beside_a_known_crack_that_overturns_the_worst_other_is_told_and_followed_no_farther():
    """With the one that statics chooses all members fall, too; a stronger motion does not change what is said of it."""
    typed = Wall.of_size(6.0, 0.4, 3.0, crack="known")
    for factor in (6.0, 12.0):
        known = assess(record(factor * typed.mechanism().uplift_multiplier * 9.80665), typed)
        assert known.verdict is Verdict.OVERTURNS and known.decision.warnings == ()
        assert known.crack == typed.crack_in_words
        first, *beside = known.ensembles.followed
        assert first.description == typed.crack_in_words and not any(neighbour.counts for neighbour in beside)
        *before, last = (one_neighbour.facts.step(0.05) for one_neighbour in beside)
        assert last is Verdict.OVERTURNS and Verdict.OVERTURNS not in before
        assert known.statics is beside[-1] and len(beside) < len(cracks(typed)) - 1


@pytest.mark.parametrize("fidelity", ["standard", "quick"])
def test_a_single_run_of_a_typed_crack_that_rests_says_nothing_of_the_others(fidelity):
    """Without an ensemble, too: what statics chooses lifts below it."""
    lifts = WALL.mechanism().uplift_multiplier
    motion = record(0.5 * (lifts + WALL.static_multiplier) * 9.80665)
    settings = AssessmentSettings(fidelity=fidelity, ensemble=EnsembleSettings(members=0))
    result = Assessor(settings).assess("r", [motion], on_the_ground({"wall": WALL}))
    (station,) = result.periods
    assert station.decision.verdict is not Verdict.STANDS
    known = Assessor(settings).assess("r", [motion], on_the_ground({"wall": replace(WALL, crack="known")}))
    assert known.periods[0].decision.verdict is Verdict.STANDS


def test_quick_rests_only_where_every_crack_does():
    """As typed the wall rests; the hinge that statics chooses lifts. It decides where none is known."""
    typed = WALL.mechanism().uplift_multiplier
    assert WALL.static_multiplier < 0.999 * typed
    motion = record(0.5 * (typed + WALL.static_multiplier) * 9.80665)
    settings = AssessmentSettings(fidelity="quick")
    for crack, rests in ((None, False), ("known", True)):
        wall = replace(WALL, crack=crack)
        case = compute_case(CaseInputs(motion=Motion((motion,)), structure=wall, settings=settings))
        assert (case.ensembles is None) is rests


def test_the_governed_fragility_is_never_below_that_of_statics():
    records = [record(1.0, period) for period in (0.5, 0.8, 1.2)]
    usual = {"levels": np.geomspace(0.2, 3.0, 8), "stations": list("abc")}
    plain, governed = (fragility(records, SPIRE, over_cracks=over, **usual) for over in (False, True))
    assert np.all(governed.probability >= plain.probability) and governed.median <= plain.median


def test_the_middle_candidate_is_the_wall_itself():
    variations = other_cracks(LOW_WALL, SINE, PULSE, 5, AssessmentSettings())
    middle = variations[2]
    assert middle.position == pytest.approx(2.0)
    assert middle.integrated_rotation_ratio == integrate(LOW_WALL, SINE, 1e-9).rotation_ratio


def test_variations_are_followed_at_the_tolerance_at_which_a_fragile_run_is_repeated():
    """A word may hang on one of them, and none is asked whether it is fragile."""
    motion = record(12.0, 0.5)
    at_settings, strictly = (integrate(LOW_WALL, motion, value).rotation_ratio for value in (1e-3, 1e-9))
    assert at_settings != strictly
    settings = AssessmentSettings(tolerance=1e-3)
    assert other_cracks(LOW_WALL, motion, None, 5, settings)[2].integrated_rotation_ratio == strictly
    (processing,) = other_processings(LOW_WALL, {"high-pass 0.2 Hz": motion}, settings)
    assert processing.integrated_rotation_ratio == strictly


def test_the_vertical_component_acts_on_every_candidate():
    vertical = record(3.0, 0.4)
    motion = record(12.0, 0.5)
    middle = other_cracks(LOW_WALL, motion, None, 5, AssessmentSettings(), vertical)[2]
    with_it, without = (integrate(LOW_WALL, motion, 1e-9, vertical=case) for case in (vertical, None))
    assert middle.integrated_rotation_ratio == with_it.rotation_ratio
    assert 0 < with_it.rotation_ratio != without.rotation_ratio


def test_a_higher_hinge_lifts_earlier():
    # λ = 2 tan α₁ falls as the lower block grows, so a shaking that leaves low hinges shut opens high ones.
    variations = other_cracks(LOW_WALL, SINE.scaled(0.8), None, 9, AssessmentSettings())
    lifted = [variation.integrated_rotation_ratio > 0 for variation in variations]
    assert lifted == sorted(lifted)
    assert lifted[-1]
    assert not lifted[0]


def test_processing_that_changes_nothing_changes_no_answer():
    records = processed(SINE)
    block = Block(2.0, 0.2)
    assert "unchanged" in records
    variations = other_processings(block, records, AssessmentSettings())
    ratios = {variation.processing: variation.integrated_rotation_ratio for variation in variations}
    assert ratios["unchanged"] == integrate(block, SINE, 1e-9).rotation_ratio
    assert ratios["high-pass 0.2 Hz"] != ratios["unchanged"]


@pytest.mark.parametrize(("several", "amplitude"), [(1, 2.0), (2, 1.5), (2, 3.0)])
def test_a_row_of_the_comparison_speaks_of_the_crack_that_governs_alone(several, amplitude):
    """Of one component and of two that make a pair; the numbers are those of the structure that is cracked there."""
    wall = Wall.of_size(6.0, 0.4)
    motions = [replace(record(amplitude), component=name) for name in ("EW", "NS")[:several]]
    assessor = Assessor(AssessmentSettings(ensemble=EnsembleSettings(reserve=0)))
    result = assessor.assess("r", motions, on_the_ground({"wall": wall}))
    (station,) = result.periods
    crack = station.ensembles.governing.description
    statics, *_ = wall.candidates()
    assert crack != statics.description, "another crack than that of statics governs"
    (body,) = (candidate.structure for candidate in wall.candidates() if candidate.description == crack)
    block = body.mechanism().equivalent_block("exact_at_rest")
    rows = rows_of_record(result).comparison
    assert len(rows) == several
    for row, motion in zip(rows, motions, strict=True):
        assert row.crack == crack
        assert row.integrated_rotation_ratio == integrate(body, motion).rotation_ratio
        assert row.block_on_record_rotation_ratio == integrate(block, motion, 1e-9).rotation_ratio
        omega = component_of(motion, AssessmentSettings().pulse).analysis.dominant.circular_frequency
        assert row.frequency_ratio == omega / block.frequency_parameter
        assert row.statics_integrated_rotation_ratio == integrate(statics.structure, motion).rotation_ratio
        pulses = component_of(motion, AssessmentSettings().pulse).candidates
        for own, told in (
            (body, row.predicted_rotation_ratio),
            (statics.structure, row.statics_predicted_rotation_ratio),
        ):
            assert told == predict(own.mechanism(), pulses).maximum.rotation_ratio
    assert station.rotation_ratio == rows[0].integrated_rotation_ratio


@pytest.mark.parametrize("crack", ["known", None])
def test_a_wall_falls_as_it_bulges_below_the_tie_that_holds_it_for_good(crack):
    """About its foot it stands. The same wall between supports, hinged where statics puts it, is the oracle."""
    front = Facade(
        (3.2, 3.2),
        (0.4, 0.4),
        19e3,
        floor_loads=(1e4, 1e4),
        behind="cross_walls",
        restitution=0.7,
        tie_heights=(6.4,),
        tie_stiffness=2e7,
        crack_storey=1,
        crack=crack,
    )
    times = np.arange(0, 12, STEP)
    motion = Accelerogram(np.where(times < 3, 8 * np.sin(6 * times), 0.0), STEP)
    span = LoadedWall.of_size(6.4, 0.4, 19e3, top_load=1e4, one_sided=True, restitution=0.7)
    about_its_foot, between_supports = (assess(motion, case) for case in (front.mechanism(), span))
    assert (about_its_foot.verdict, about_its_foot.overturning_members) == (Verdict.STANDS, 0)
    assessed = assess(motion, front)
    assert assessed.verdict is between_supports.verdict is Verdict.OVERTURNS
    assert assessed.overturning_members == between_supports.overturning_members == 64
    assert assessed.crack == "hinge at 4.822 m (bulges between foot and tie)"


@pytest.mark.parametrize("step", [0.005, 0.01])
def test_what_a_tie_keeps_shut_caps_no_word(step):
    """Above a tie inside its storey the front falls under three cycles of .6 s, however the pulse is sampled.

    All eight stacks of courses fall at .8 g; in a safe island about 1.2 g some of one crack stand, all of the next.
    """
    front = Facade(
        (3.6,),
        (0.4,),
        18e3,
        floor_loads=(3e3,),
        restitution=0.6,
        behind="cross_walls",
        tie_heights=(3.0,),
        tie_stiffness=2e7,
    )
    times = np.arange(0, 6, step)
    cycles = 9.80665 * np.sin(2 * np.pi * times / 0.6) * (times < 1.8)
    for amplitude, expected in ((0.8, Verdict.PROBABLY_OVERTURNS), (1.2, Verdict.PROBABLY_OVERTURNS)):
        assessed = assess(Accelerogram(amplitude * cycles, step), front)
        assert assessed.verdict is expected
        assert assessed.overturning_share > 0.7


def test_a_held_wall_that_turns_far_only_probably_stands():
    """Row 8b: beyond 0.4 φ_cr of any mechanism, in any member; what its contacts need is left out."""
    front = Facade(
        (3.2,),
        (0.4,),
        19e3,
        behind="cross_walls",
        restitution=0.5,
        tie_heights=(3.2,),
        tie_stiffness=2e7,
        anchor_height=3.2,  # so that the anchors hold what the tie gets
    )
    words = {}
    for amplitude in (4.0, 5.0):
        assessed = assess(record(amplitude, 0.6), front)
        (case,) = assessed.cases.values()
        limits = [limit for limit in case.limits if limit.warning.kind is not AssessmentKind.FRICTION_SHORT]
        decision = decide(replace(case.facts(front), stacks=None), limits)
        farthest = float(np.nanmax(assessed.rotation_ratios))
        if farthest <= 1:
            words[farthest > 0.4] = decision.verdict, [warning.kind for warning in decision.warnings]
    assert words[False][0] is Verdict.STANDS
    assert words[True][0] is Verdict.PROBABLY_STANDS and AssessmentKind.HELD_BEYOND in words[True][1]


def test_a_wall_whose_ties_swing_with_the_motion_only_probably_stands(monkeypatch):
    """A harmonic of the period with which it swings on them grows by 1/(2 ξ): what is held rigidly never lifts."""
    held = Facade(
        (3.2,),
        (0.4,),
        19e3,
        floor_loads=(1e4,),
        behind="cross_walls",
        restitution=0.5,
        tie_heights=(3.2,),
        tie_stiffness=3e6,
    )
    mass = (19e3 * 0.4 * 3.2 / 3 + 1e4) / 9.80665  # of a rod about its foot, and of the floor on its end
    assert tie_swing(held)[0] == pytest.approx(2 * np.pi * np.sqrt(mass / 3e6), rel=1e-12)
    amplitude = 0.7 * held.static_multiplier * 9.80665
    times = np.arange(0, 6, STEP)
    stiff = replace(held, tie_stiffness=300 * 3e6)
    for wall, period, ties_give in (
        (held, tie_swing(held)[0], True),
        (held, 20 * tie_swing(held)[0], False),
        (stiff, tie_swing(held)[0], False),
    ):
        motion = Accelerogram(amplitude * np.sin(2 * np.pi * times / period) * (times < 5), STEP)
        motions = GroundMotions.of(motion)
        assert rocking.integrate(wall.mechanisms()[0].structure, motion).rotation_ratio == 0
        assert walls.ties_give(wall, motions, AssessmentSettings()) is ties_give
    monkeypatch.setattr(walls, "integrate_members", Mock(side_effect=rocking.MotionError("not followed.")))
    assert walls.ties_give(stiff, motions, AssessmentSettings())


@pytest.mark.parametrize("share", [0.5, 0.95])
def test_a_wall_at_rest_on_ties_that_give_only_probably_stands(share):
    """The ground never reaches the λ of a wall held rigidly, but the wall swings on its ties and then falls.

    At .95 λ the stacks of the whole wall that contact dynamics follows show it, of masonry rough enough that its
    anchors do not slide out first: these take up the swing.
    """
    wall = Facade(
        (3.2,),
        (0.4,),
        19e3,
        floor_loads=(1e4,),
        behind="cross_walls",
        restitution=0.5,
        tie_heights=(3.2,),
        tie_stiffness=1e6,
        anchor_height=3.2,
    ).on_joints(Joints(0.9))
    times = np.arange(0, 6, STEP)
    swing = np.sin(2 * np.pi * times / tie_swing(wall)[0]) * (times < 5)
    motion = Accelerogram(share * wall.static_multiplier * 9.80665 * swing, STEP)
    assessed = assess(motion, wall)
    assert np.all(assessed.rotation_ratios == 0)
    assert assessed.decision.verdict is Verdict.PROBABLY_STANDS
    assert [warning.kind for warning in assessed.decision.warnings] == [AssessmentKind.TIES_GIVE]
    assert AssessmentKind.CONTACT_DYNAMICS in [warning.kind for warning in assessed.decision.would_settle]
    stacks = contacts.contact_share(wall, GroundMotions.of(motion), AssessmentSettings(), 8)
    assert (stacks.falls > 0) is (share == 0.95)
    unmoved = assess(motion, replace(wall, tie_stiffness=1e9)).decision
    assert (unmoved.verdict, unmoved.warnings) == (Verdict.STANDS, ())


def test_ties_that_give_are_told_beside_the_word():
    wall = Facade(
        (3.2,),
        (0.4,),
        19e3,
        behind="cross_walls",
        restitution=0.5,
        tie_heights=(3.2,),
        tie_stiffness=2e6,
        anchor_height=3.2,
    )
    times = np.arange(0, 6, STEP)
    swing = np.sin(2 * np.pi * times / tie_swing(wall)[0]) * (times < 5)
    motion = Accelerogram(1.02 * wall.static_multiplier * 9.80665 * swing, STEP)
    decision = assess(motion, wall.on_joints(ROUGH)).decision
    assert decision.verdict is Verdict.PROBABLY_STANDS
    assert [warning.kind for warning in decision.warnings] == [AssessmentKind.TIES_GIVE]
    unmoved = assess(motion, replace(wall, tie_stiffness=1e9, joints=ROUGH)).decision
    assert (unmoved.verdict, unmoved.warnings) == (Verdict.STANDS, ())


def test_a_restitution_typed_far_below_that_of_the_geometry_is_followed_beside_it():
    """Where the two differ the share is a range, and a measurement of the restitution would tell."""
    typed = Block.of_size(0.5, 4.0, restitution=0.6)
    own = replace(typed, restitution=None)
    assert own.mechanism().restitution == pytest.approx(
        1 - 1.5 * np.sin(np.arctan2(0.5, 4.0)) ** 2, rel=1e-12
    )
    times = np.arange(0, 12, STEP)
    wave = np.sin(2 * np.pi * times / 1.2) * np.exp(-(((times - 5) / 2.5) ** 2))
    verdicts = set()
    for amplitude in (1.0, 2.0, 3.0, 5.0):
        motion = Accelerogram(amplitude * wave, STEP)
        both, livelier = (assess(motion, one_case) for one_case in (typed, own))
        verdicts.add(both.verdict)
        if livelier.overturning_members:
            assert both.crack == "restitution 0.98 of its geometry"
            assert both.overturning_members == livelier.overturning_members
            assert [warning.kind for warning in both.decision.would_settle] == [AssessmentKind.RESTITUTION]
            assert both.decision.interval[0] < both.decision.interval[1] == livelier.overturning_share
        else:
            assert both.verdict is livelier.verdict
    assert Verdict.UNCERTAIN in verdicts
    near = replace(typed, restitution=own.mechanism().restitution - 0.049)
    leans = replace(typed, one_sided=True)
    assert [len(cracks(case)) for case in (near, leans)] == [1, 1]
