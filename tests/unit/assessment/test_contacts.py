"""Where one degree of freedom does not tell whether a structure stands, and what contact dynamics then says."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import rocking
from rocking import Accelerogram, Arch, ArchOnPiers, Block, Frame, LoadedWall, Spire, Verdict, Wall
from rocking.assessment.contacts import (
    MOST_RUNS,
    RUNS,
    ContactShare,
    contact_share,
    draws_of_parts,
    stackable,
)
from rocking.assessment.decide import Decision, decide, step
from rocking.assessment.evidence.bodies import friction_needed, why_open
from rocking.assessment.evidence.runs import Friction
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import GroundMotions, Motion, ground_motions
from rocking.assessment.one_case import compute_case
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.contacts.dynamics import follow_stack
from rocking.errors import MotionError, StructureError
from rocking.quantities import GRAVITY
from rocking.structures.joints import Joints
from rocking.structures.stack import STEP
from rocking.structures.structure import Candidate
from rocking.structures.unknown_geometry import as_structure

CONTACT = AssessmentSettings(fidelity="contact")
DEFAULT = AssessmentSettings()
SPIRE = Spire(width=3.0, height=15.0, wall_thickness=0.25)
# Three walls that stand as mechanisms, and whose two blocks fall under their slab in LMGC90 too: size, hinge, thickness
# [m], load [N/m], record, samples that are kept, factor.
FALLING_WALLS = {
    "Erzincan": (
        (2.5494, 2.0906, 0.2169, 8051.0),
        "erzincan1992/RSN821_ERZINCAN_ERZ-EW.AT2",
        slice(0, 2400),
        5.036,
    ),
    "Newhall": (
        (3.4297, 1.9630, 0.42959, 21609.0),
        "northridge1994_newhall/RSN1044_NORTHR_NWH360.AT2",
        slice(0, None),
        3.445,
    ),
    "Bolu": (
        (2.9505, 1.2954, 0.3592, 16966.0),
        "suites/fema_p695_far_field/06.AT2",
        slice(380, None),
        3.792,
    ),
}


def without_stacks(assessment) -> Decision:
    """The decision on the same facts had contact dynamics not been asked."""
    (case,) = assessment.cases.values()
    return decide(replace(case.facts(assessment.body), stacks=None, stackable=True), case.limits)


def sine(amplitude: float, period: float = 0.6) -> Accelerogram:
    """Three cycles."""
    times = np.arange(0, 3 * period, 0.005)
    return Accelerogram(np.append(amplitude * np.sin(2 * np.pi * times / period), np.zeros(10)), 0.005)


@pytest.mark.parametrize("name", FALLING_WALLS)
def test_walls_whose_contacts_open_and_whose_blocks_fall_do_not_stand(name, real_records):
    (height, hinge, thickness, load), path, kept, factor = FALLING_WALLS[name]
    # The joints of its stack hold as much.
    size = height, thickness, 18e3, hinge
    wall = LoadedWall.of_size(*size, top_load=load, top_slab="flat", top_friction=5.0, crack="known")
    whole = rocking.read(real_records / path)[0]
    motion = replace(whole, acceleration=whole.acceleration[kept]).scaled(factor)
    followed = rocking.assess(motion, wall)
    assert followed.overturning_members == 0
    alone = without_stacks(followed)
    assert alone.verdict is Verdict.CANNOT_BE_TOLD
    assert alone.why.startswith("contacts open; 0 of ")
    assert alone.share_in_words == "", "none of its members overturns, of which nothing follows"
    assert followed.verdict in (Verdict.UNCERTAIN, Verdict.PROBABLY_OVERTURNS)
    assert followed.stacks.falls > followed.stacks.runs / 2
    assert followed.stacks.runs <= RUNS
    assert f"{followed.stacks.falls} of {followed.stacks.runs} stacks of courses fall" in followed.why
    assert followed.reserve.low <= followed.reserve.median <= 1.0, "it is that of what falls"


def test_a_spire_that_lifts_never_stands_by_its_mechanisms_alone():
    least = SPIRE.static_multiplier * GRAVITY
    for crack in (None, "known"):
        spire = replace(SPIRE, crack_height=0.0, crack=crack)
        settings = AssessmentSettings(ensemble=EnsembleSettings(reserve=0))
        rests = rocking.assess(sine(0.9 * least), spire, settings=settings)
        lifts = rocking.assess(sine(1.3 * least, 0.1), spire, settings=settings)
        assert rests.verdict is Verdict.STANDS
        assert lifts.overturning_members == 0
        assert without_stacks(lifts).verdict is Verdict.CANNOT_BE_TOLD
        assert without_stacks(lifts).why.startswith("courses above a rocking body may be thrown; 0 of ")


@pytest.mark.process
def test_few_runs_of_contact_dynamics_let_a_spire_probably_stand_and_many_let_it_stand():
    """The last six of 24 are not followed where none falls before: six falls change no word."""
    motion = sine(1.3 * SPIRE.static_multiplier * GRAVITY, 0.1)
    without_reserve = EnsembleSettings(reserve=0)
    probably = rocking.assess(motion, SPIRE, settings=AssessmentSettings(ensemble=without_reserve))
    assert probably.verdict is Verdict.PROBABLY_STANDS
    assert (probably.stacks.falls, probably.stacks.runs) == (0, 18)
    assert [warning.kind for warning in probably.decision.would_settle] == [AssessmentKind.CONTACT_DYNAMICS]
    stands = rocking.assess(motion, SPIRE, settings=CONTACT)
    assert stands.verdict is Verdict.STANDS
    assert (stands.stacks.falls, stands.stacks.runs) == (0, 64)
    falls = rocking.assess(sine(2 * SPIRE.static_multiplier * GRAVITY, 0.9), SPIRE)
    assert falls.stacks.falls != 0
    assert falls.verdict is Verdict.PROBABLY_OVERTURNS


def test_contact_dynamics_is_asked_where_it_cannot_be_told_and_of_a_held_wall_that_turns_far(monkeypatch):
    """Not where the members are uncertain, and with fidelity: quick never; with contact by all runs.

    Whether it is asked, and by how many runs, is all that counts here, of joints that nothing lets slide.
    """
    without_reserve = EnsembleSettings(reserve=0)
    monkeypatch.setattr(
        "rocking.assessment.evidence.asked.contact_share",
        lambda *arguments: ContactShare(falls=0, runs=arguments[-1]),
    )
    wall = rocking.Facade(
        (3.2,),
        (0.4,),
        19e3,
        floor_loads=(1e4,),
        behind="cross_walls",
        restitution=0.5,
        tie_heights=(3.2,),
        tie_stiffness=2e7,
        anchor_height=3.2,
    )
    words = []
    for severity, period in ((1.2, 0.4), (1.6, 0.4), (4.0, 0.25), (2.1, 0.4)):
        motion = sine(severity * wall.static_multiplier * GRAVITY, period)
        few, many = (
            rocking.assess(
                motion, wall.on_joints(Joints(5.0)), settings=replace(case, ensemble=without_reserve)
            )
            for case in (AssessmentSettings(), CONTACT)
        )
        words.append(without_stacks(few).verdict)
        far = words[-1] is Verdict.PROBABLY_STANDS
        assert (few.stacks, many.stacks) == (None, ContactShare(falls=0, runs=MOST_RUNS) if far else None)
    assert words == [
        Verdict.STANDS,
        Verdict.PROBABLY_STANDS,
        Verdict.UNCERTAIN,
        Verdict.PROBABLY_OVERTURNS,
    ]
    quick = AssessmentSettings(fidelity="quick")
    lifts = Motion((sine(1.3 * SPIRE.static_multiplier * GRAVITY, 0.1),))
    assert compute_case(CaseInputs(motion=lifts, structure=SPIRE, settings=quick)).contact is None


@pytest.mark.parametrize("runs", [RUNS, MOST_RUNS])
@pytest.mark.parametrize("risk", [0.05, 0.2])
def test_those_that_were_followed_say_what_all_would(runs, risk):
    """Whatever falls and stands in turn, and wherever the rest can no longer change the word."""
    for followed in range(1, runs + 1):
        for falls in range(followed + 1):
            ends = {step(falls=falls + more, members=runs, risk=risk) for more in (0, runs - followed)}
            if len(ends) == 1:
                assert {step(falls=falls, members=followed, risk=risk)} == ends, (falls, followed)


def test_without_an_ensemble_the_single_run_is_doubted_too():
    settings = AssessmentSettings(ensemble=EnsembleSettings(members=0))
    motion = sine(1.3 * SPIRE.static_multiplier * GRAVITY, 0.1)
    case = compute_case(CaseInputs(motion=Motion((motion,)), structure=SPIRE, settings=settings))
    assert [limit.warning.kind for limit in case.limits] == [AssessmentKind.COURSES_THROWN]


def test_what_keeps_its_contacts_or_rests_is_not_doubted():
    motions = GroundMotions.of(sine(1.5, 0.3))
    assert why_open(Block.of_size(0.8, 4.0), motions, 0.1, DEFAULT) is None
    assert why_open(Wall(1.6, 1.6, 0.25), motions, 0.0, DEFAULT) is None
    assert why_open(as_structure(Block.of_size(0.8, 4.0).mechanism()), motions, 0.1, DEFAULT) is None


def test_only_what_contact_dynamics_can_follow_is_advised_to_it():
    """Where it is asked all the same it follows nothing, and says why."""
    motions = GroundMotions.of(sine(1.0))
    facade = rocking.Facade((3.5, 3.0), (0.6, 0.5), 20e3)
    for structure, can in (
        (Wall(1.6, 1.6, 0.25), True),
        (Wall(1.6, 1.6, 0.25, crack="known"), True),
        (SPIRE, True),
        (facade, True),
        (replace(facade, crack="known", crack_storey=2), False),
        (replace(facade, behind="cross_walls", restitution=0.5), True),
        (Block.of_size(0.8, 4.0), False),
        (rocking.Frame(Block.of_size(1.1, 8.0), 4, 0.3), False),
        (rocking.Frame(Block.of_size(1.1, 8.0), 2, 0.3), True),
        (Arch(8.0, 1.1, 2.6), True),
        (ArchOnPiers(5.0, 0.8, np.pi, pier_width=1.5, pier_height=4.0), True),
        (as_structure(Block.of_size(0.8, 4.0).mechanism()), False),
    ):
        assert stackable(structure) is can
        if not can:
            assert contact_share(structure, motions).runs == 0


def test_directions_share_the_steps_and_unlike_sides_meet_both_signs(monkeypatch):
    both = GroundMotions.of(replace(sine(1.0), component="EW"), replace(sine(0.5), component="NS"))
    wall = Wall(1.6, 1.6, 0.25, crack="known")
    facade = rocking.Facade((3.5, 3.0), (0.6, 0.5), 20e3)
    one = GroundMotions.of(sine(1.0))
    followed = []

    def noted(stack, motion, step, vertical):
        lifted = vertical.peak_acceleration if vertical else 0.0
        followed.append((motion.component, np.sign(motion.acceleration[10]), step, lifted))
        return False

    monkeypatch.setattr("rocking.assessment.contacts._falls", noted)
    monkeypatch.setattr("rocking.assessment.contacts.step_of", lambda *_, **__: object())  # none is left out
    for structure, motions, ways, signs in (
        (wall, both, 8, 1),
        (facade, both, 8, 2),
        (wall, one, 1, 1),
        (facade, one, 2, 2),
    ):
        for runs in (24, 64):
            followed.clear()
            assert contact_share(structure, motions, runs=runs).runs == runs
            assert len({other_crack[:2] for other_crack in followed}) == ways
            assert len({crack[0] for crack in followed}) == ways // signs
            assert [one_crack[2] for one_crack in followed].count(STEP) == pytest.approx(runs * 7 / 8, abs=1)
            assert {of_crack[3] for of_crack in followed} == {0.0}
    followed.clear()
    lifting = GroundMotions.of(sine(1.0), vertical=sine(0.3))  # which no draw of an amplitude changes
    contact_share(wall, lifting)
    draws_of_parts(wall, lifting, DEFAULT, 1)[0][0].falls(2.0)
    assert [lift for *_, lift in followed] == pytest.approx([0.3] * RUNS + [0.6], rel=1e-3)


def test_no_step_is_longer_than_the_one_that_was_measured_and_one_is_half_of_it(monkeypatch):
    """An error of first order shows between a step and its half; longer steps than STEP were held against nothing."""
    steps = []

    def noted(stack, motion, step, **others):
        steps.append(step)
        return follow_stack(stack, motion, step, **others)

    monkeypatch.setattr("rocking.assessment.contacts.follow_stack", noted)
    monkeypatch.setattr("rocking.assessment.contacts.step_of", lambda *_, **__: object())  # none is left out
    wall = Wall(1.6, 1.6, 0.25, crack="known")
    contact_share(wall, GroundMotions.of(sine(1.0)))
    assert wall.stack().longest_step >= STEP
    assert sorted(steps) == pytest.approx(3 * [STEP / 2] + 21 * [STEP])


def test_a_spire_is_followed_with_few_and_many_courses_unless_it_says_how_many(monkeypatch):
    followed = []

    def noted(stack, motion, step, vertical):
        followed.append((len(stack.courses), round(motion.peak_acceleration, 6), step))
        return False

    monkeypatch.setattr("rocking.assessment.contacts._falls", noted)
    monkeypatch.setattr("rocking.assessment.contacts.step_of", lambda *_, **__: object())  # none is left out
    motions = GroundMotions.of(sine(2.0))
    contact_share(SPIRE, motions)
    for courses in (6, 12):
        own = [crack for crack in followed if crack[0] == courses]
        peaks = {peak for _, peak, _ in own}
        assert len(own) == len(peaks) == 12  # every other two amplitudes
        assert min(peaks) < 0.92 * 2.0 and max(peaks) > 1.08 * 2.0
        assert len({step for _, _, step in own}) == 2  # both steps
    followed.clear()
    contact_share(replace(SPIRE, courses=9), motions)
    assert {courses for courses, _, _ in followed} == {9}


def test_what_needs_more_friction_than_the_study_has_slides_and_does_not_fall():
    """A body on ground that gives it no more than μ g, below the λ g at which it lifts, never rocks (Coulomb)."""
    front = rocking.Facade((3.0,), (0.6,), 19e3)
    times = np.arange(0, 5, 0.005)
    to_and_fro = 8.0 * np.sin(2 * np.pi * times / 0.8) * np.exp(-(((times - 2.5) / 0.8) ** 2))
    motions = GroundMotions.of(Accelerogram(to_and_fro, 0.005))
    slippery, rough = (front.on_joints(Joints(value)) for value in (0.15, 0.9))
    assert front.static_multiplier == pytest.approx(0.2)
    assert contact_share(slippery, motions).falls == 0
    assert contact_share(rough, motions).falls > 0


def test_a_tie_that_is_too_stiff_for_the_usual_step_is_followed_at_a_shorter_one():
    tie = {"tie_heights": (3.0,), "tie_stiffness": 1e9, "tie_strength": 5e3}
    front = rocking.Facade((3.6,), (0.4,), 18e3, restitution=0.6, behind="cross_walls", **tie)
    assert front.stack().longest_step < STEP
    share = contact_share(front, GroundMotions.of(sine(3.0)), runs=2)
    assert share.runs


def test_an_impact_that_keeps_little_by_balance_is_doubted_and_a_typed_one_is_not():
    """By hand: what stands on the hinge rises on both sides, so that a flat load of W h₁²/(3 (1+ψ)² t²) leaves 0."""
    height, hinge, thickness = 3.2, 1.6, 0.25
    weight = 20e3 * height * thickness
    nothing_kept = weight * hinge**2 / (3 * 2**2 * thickness**2)
    motions = GroundMotions.of(sine(0.5, 0.1))
    kinds = {}
    for share in (0.3, 0.9):
        wall = LoadedWall.of_size(
            height, thickness, 20e3, hinge, top_load=share * nothing_kept, top_slab="flat", crack="known"
        )
        kept = wall.mechanism().restitution
        kinds[kept < 0.3] = why_open(wall, motions, 0.05, DEFAULT)
        assert why_open(replace(wall, restitution=kept), motions, 0.05, DEFAULT) is None
    assert kinds == {False: None, True: AssessmentKind.IMPACT_OPENS}


def test_what_cannot_be_followed_may_open(monkeypatch):
    def lost(*_, **__):
        raise MotionError("the integration ends at 0.2 s.")

    motions = GroundMotions.of(sine(1.5, 0.3))
    wall = Wall(1.6, 1.6, 0.25)
    assert why_open(wall, motions, 0.05, DEFAULT) is None
    monkeypatch.setattr("rocking.assessment.evidence.bodies.integrate", lost)
    assert why_open(wall, motions, 0.05, DEFAULT) is AssessmentKind.CONTACTS_OPEN


def test_a_mechanism_that_cannot_be_followed_is_doubted_alone_once_the_motion_reaches_it(monkeypatch):
    """That of least λ may be the one that forms; what counts is followed all the same, and is weaker no longer."""
    wall = rocking.Facade(
        (3.37, 3.04),
        (0.4, 0.4),
        18e3,
        tie_heights=(6.37,),
        tie_stiffness=6e6,
        anchor_height=3.2,  # so that the anchors hold what the tie gets
        behind="cross_walls",
        restitution=0.7,
    )
    weakest = wall.mechanisms()[0]
    assert weakest.bulges
    lost = StructureError("its inertia is not smooth.")
    monkeypatch.setattr(
        Candidate, "refused", property(lambda one: lost if one.description == weakest.description else None)
    )
    wall = replace(wall)  # nothing that it kept
    assert wall.candidates()
    assert all(candidate.description != weakest.description for candidate in wall.candidates())
    unfollowed = [AssessmentKind.NOT_FOLLOWED]
    for share, expected in ((0.9, []), (0.97, unfollowed), (1.2, unfollowed)):
        motion = sine(share * weakest.uplift_multiplier * GRAVITY)
        case = compute_case(
            CaseInputs(motion=Motion((motion,)), structure=wall, settings=AssessmentSettings())
        )
        assert [limit.warning.kind for limit in case.limits if limit.is_untold] == expected
        assert (case.contact is not None) == bool(expected)  # its stack may fall in any mechanism
        word = decide(replace(case.facts(wall), stacks=None), case.limits).verdict
        assert (word is Verdict.CANNOT_BE_TOLD) == bool(expected)


# Friction -----------------------------------------------------------------------------------------------------


def friction_of_a_block(block: Block, record: Accelerogram) -> float:
    """The largest ratio of the forces at the corner of a block that turns, by Newton's laws of its centre of mass."""
    response = rocking.integrate(block, record, history=True)
    ground = np.interp(response.times, record.times, record.acceleration, right=0.0)
    turned = response.rotation != 0
    side = np.sign(response.rotation[turned])
    left = block.slenderness - np.abs(
        response.rotation[turned]
    )  # from the vertical to the line to the centre
    velocity = response.angular_velocity[turned]
    push = -side * ground[turned]
    radius = block.semi_diagonal
    turning = 0.75 * (push * np.cos(left) - GRAVITY * np.sin(left)) / radius
    along = side * radius * (np.cos(left) * turning + np.sin(left) * velocity**2) + ground[turned]
    up = radius * (np.sin(left) * turning - np.cos(left) * velocity**2) + GRAVITY
    return float(np.max(np.abs(along) / up))


@pytest.mark.parametrize("amplitude", [5.0, 8.0])
def test_the_friction_that_a_rocking_block_needs_is_that_of_its_centre_of_mass(amplitude):
    block = Block.of_size(0.9, 2.0)
    record = sine(amplitude, 0.4)
    motions = ground_motions(Motion((record,)), processing=False)
    needed = friction_of_a_block(block, record)
    assert 0.45 < needed < 2
    less, more = (block.on_joints(Joints(factor * needed)) for factor in (0.98, 1.02))
    assert friction_needed([less], motions, AssessmentSettings()) == pytest.approx(needed, rel=0.01)
    assert np.isnan(friction_needed([more], motions, AssessmentSettings()))


@pytest.mark.parametrize("as_stones, runs", [("", 64), ("as voussoirs", 1)])
def test_one_run_of_stones_says_what_sixty_four_stacks_do_of_a_friction_that_is_short(
    as_stones, runs, monkeypatch
):
    monkeypatch.setattr("rocking.assessment.evidence.runs.friction_needed", lambda *_: 0.9)
    monkeypatch.setattr("rocking.assessment.evidence.runs.cracked", lambda structure, name: structure)
    asked = SimpleNamespace(
        structure=SimpleNamespace(joints=Joints(0.5, as_stones=as_stones)),
        counting=[SimpleNamespace(description="crack")],
        sliding=(),
        case=SimpleNamespace(ensembles=None),
        motions=None,
        settings=None,
    )
    limit = Friction().look(asked)
    assert (limit.warning.kind, limit.value, limit.lifted_by) == (AssessmentKind.FRICTION_SHORT, 0.9, runs)


def test_a_block_whose_corner_needs_more_friction_than_it_has_only_probably_stands():
    """It lifts before it slides, and needs more while it rocks; the pages say how much."""
    block = Block.of_size(0.9, 2.0).on_joints(Joints(0.5))
    record = sine(8.0, 0.4)
    needed = friction_of_a_block(block, record)
    assert 0.45 < 0.5 < needed
    limited = rocking.assess(record, block)
    assert (limited.verdict, limited.overturning_share) == (Verdict.PROBABLY_STANDS, 0.0)
    assert limited.friction_needed == pytest.approx(needed, rel=0.01)
    assert AssessmentKind.FRICTION in [warning.kind for warning in limited.decision.would_settle]
    firm = rocking.assess(record, block.on_joints(Joints(1.1 * needed)))
    assert firm.verdict is Verdict.STANDS
    assert np.isnan(firm.friction_needed)
    quick = AssessmentSettings(fidelity="quick")
    case = compute_case(CaseInputs(motion=Motion((record,)), structure=block, settings=quick))
    assert case.decision(block).verdict is Verdict.PROBABLY_STANDS, "as every path to a word has it"


@pytest.mark.slow
def test_an_arch_that_needs_more_friction_stands_as_its_voussoirs_do():
    """On 0.5 and more, where none fell that stands as a mechanism; with fill, or on less, nobody has shown it."""
    whole = rocking.read("records/20161113_110259_WTMC_20.V2A")[0]
    record = replace(whole, acceleration=whole.acceleration[2350:2650])  # its strongest shaking
    arch = Arch(radius=15.0, thickness=2.25, embrace_angle=np.radians(157.5))
    without_reserve = EnsembleSettings(reserve=0)
    less, more = (
        rocking.assess(
            record, arch.on_joints(Joints(value)), settings=AssessmentSettings(ensemble=without_reserve)
        )
        for value in (0.495, 0.505)
    )
    (case,) = more.cases.values()
    assert case.check.slides(0.505)
    assert more.verdict is Verdict.STANDS and np.isnan(more.friction_needed)
    assert less.verdict is Verdict.PROBABLY_STANDS
    assert less.stacks == ContactShare(falls=0, runs=18), "as voussoirs, which say what their friction does"
    assert np.isnan(less.friction_needed)
    assert AssessmentKind.FRICTION_SHORT not in [warning.kind for warning in less.decision.warnings]
    assert arch.joints.stand_on_friction == 0.5
    assert replace(arch, fill_depth=0.2).joints.stand_on_friction == np.inf
    piers = ArchOnPiers(5.0, 0.8, np.pi, pier_width=1.5, pier_height=4.0)
    assert piers.joints.stand_on_friction == Block(2.0, 0.2).joints.stand_on_friction == np.inf


def test_a_stack_is_followed_on_the_friction_that_its_courses_have():
    """With fidelity: standard by 24 runs, which may find that it slides apart; contact by 64, which may clear it."""
    wall = Wall(2.0, 1.0, 0.5, crack="known", joints=Joints(0.35))
    motion = Accelerogram(sine(7.0, 0.3).acceleration[:130], 0.005)
    without_reserve = AssessmentSettings(ensemble=EnsembleSettings(reserve=0))
    few, many = (
        rocking.assess(motion, wall, settings=replace(without_reserve, fidelity=choice))
        for choice in ("standard", "contact")
    )
    assert few.friction_needed == many.friction_needed > 0.35
    assert few.verdict is Verdict.PROBABLY_STANDS
    assert few.stacks is not None and few.stacks.runs <= RUNS
    assert many.stacks == ContactShare(falls=0, runs=MOST_RUNS)
    assert many.verdict is Verdict.STANDS
    assert AssessmentKind.FRICTION_SHORT not in [warning.kind for warning in many.decision.warnings]


# Stones -------------------------------------------------------------------------------------------------------


def words_of(structure, motion, **settings) -> tuple[str, ContactShare | None]:
    without_reserve = EnsembleSettings(reserve=0)
    told = rocking.assess(
        motion, structure, settings=AssessmentSettings(ensemble=without_reserve, **settings)
    )
    return str(told.verdict), told.stacks


def test_an_arch_on_piers_stands_by_its_stones_alone():
    """24 of them say at best that it probably does, 64 that it does; an arch alone stands by its mechanism."""
    piers = ArchOnPiers(4.0, 0.7, np.radians(150), 7, pier_width=1.6, pier_height=3.0)
    arch = Arch(4.0, 0.7, np.radians(150), 7)
    motion = sine(1.2 * piers.static_multiplier * GRAVITY, 0.2)
    assert words_of(piers, motion) == ("probably stands", ContactShare(falls=0, runs=18))
    assert words_of(piers, motion, fidelity="contact") == ("stands", ContactShare(falls=0, runs=64))
    quick = AssessmentSettings(fidelity="quick")
    case = compute_case(CaseInputs(motion=Motion((motion,)), structure=piers, settings=quick))
    assert case.contact is None
    assert case.decision(piers).verdict is Verdict.PROBABLY_STANDS
    rests = sine(0.9 * piers.static_multiplier * GRAVITY, 0.2)
    assert words_of(piers, rests, fidelity="contact") == ("stands", None)
    motion = sine(1.2 * arch.static_multiplier * GRAVITY, 0.2)
    assert words_of(arch, motion) == ("stands", None)


def test_an_arch_that_slides_first_is_told_by_its_stones():
    """On 0.4 it slides before it lifts: a short motion moves it little, a long and strong one takes it down."""
    arch = Arch(5.0, 0.9, np.radians(150), 11, joints=Joints(0.4))
    slides_at = arch.slides_at()
    for factor, period, falls in ((1.1, 0.1, False), (5.0, 0.9, True)):
        word, stones = words_of(arch, sine(factor * slides_at * GRAVITY, period))
        assert (stones.falls > 0) is falls
        assert word == "probably stands" or falls
        assert word in ("probably overturns", "overturns") or not falls


def test_a_portal_that_does_not_stand_is_followed_as_columns_and_beam():
    portal = Frame(Block.of_size(1.0, 8.0), 2, 0.3)
    for factor, expected in ((1.5, False), (4.0, True)):
        told = rocking.assess(
            sine(factor * portal.static_multiplier * GRAVITY, 1.2 if expected else 0.2),
            portal,
            settings=AssessmentSettings(ensemble=EnsembleSettings(reserve=0, members=16)),
        )
        if told.verdict is not Verdict.OVERTURNS:
            assert (told.stacks is not None) is (told.verdict is not Verdict.STANDS)
        if told.stacks is not None:
            assert "runs as columns and beam fall" in told.why
