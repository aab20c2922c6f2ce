"""The decision: its table row by row, beside an oracle that shares no code with it, and what never makes it safer."""

import itertools
import math
from dataclasses import dataclass, fields, replace
from fractions import Fraction

import numpy as np
import pytest

from rocking.assessment import decide as decides
from rocking.assessment.decide import (
    ORDER,
    CrackFacts,
    Limit,
    Verdict,
    may_change,
    severity,
    step,
    worst_first,
)
from rocking.assessment.kinds import AssessmentKind
from rocking.warnings import Kind, RockingWarning

OPEN, THROWN = RockingWarning(AssessmentKind.CONTACTS_OPEN), RockingWarning(AssessmentKind.COURSES_THROWN)
SAFEST_FIRST = (
    "cannot overturn",
    "stands",
    "probably stands",
    "uncertain",
    "cannot be told",
    "probably overturns",
    "overturns",
)


@dataclass(frozen=True, kw_only=True)
class Facts(decides.Facts):
    """Facts of the mechanisms with what evidence has found, in one object."""

    friction_needed: float = math.nan
    warnings: tuple[RockingWarning, ...] = ()
    held: bool = False
    beyond: Kind | None = None
    anchors_slide: bool = False
    needs_stones: bool = False

    @property
    def limits(self):
        found = [Limit.untold(warning) for warning in self.warnings]
        if self.held and self.beyond:
            at_rest = self.beyond is AssessmentKind.TIES_GIVE
            found.append(Limit(warning=RockingWarning(self.beyond), at_rest=at_rest))
        if not math.isnan(self.friction_needed):
            settles = (RockingWarning(AssessmentKind.FRICTION),)
            found.append(Limit(warning=RockingWarning(AssessmentKind.FRICTION_SHORT), settles=settles))
        if self.needs_stones:
            found.append(Limit(warning=RockingWarning(AssessmentKind.STONES_TELL), lifted_by=1))
        if self.anchors_slide:
            kind, settles = AssessmentKind.ANCHOR_GIVES, (RockingWarning(AssessmentKind.ANCHORS),)
            found.append(
                Limit(warning=RockingWarning(kind), settles=settles, lifted_by=math.inf, at_rest=True)
            )
        return found

    @property
    def of_mechanisms(self):
        return decides.Facts(
            **{attribute.name: getattr(self, attribute.name) for attribute in fields(decides.Facts)}
        )


def decide(facts):
    return decides.decide(facts.of_mechanisms, facts.limits)


def crack(falls, members=64, failed=0, farthest=0.8, name="hinge", *, slides_at=math.nan, counts=True):
    """A crack of so many members, of which some failed and some of the others fall."""
    followed = members - failed
    farthest = math.nan if not followed else math.inf if falls else farthest
    return CrackFacts(name, falls, followed, failed, farthest, slides_at=slides_at, counts=counts)


def word(**facts):
    return str(decide(Facts(**facts)).verdict)


def kinds(warnings):
    return [warning.kind for warning in warnings]


# The step -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("members", "ends"),
    [(16, (-1, 3, 8, 16, 16)), (64, (0, 19, 40, 63, 64)), (256, (8, 83, 168, 247, 256))],
)
def test_the_counts_at_which_the_words_change(members, ends):
    """The last count of each word; of 16 none overturns and none stands for sure unless all stay far."""
    words = ("stands", "probably stands", "uncertain", "probably overturns", "overturns")
    for falls in range(members + 1):
        expected = next(word for word, end in zip(words, ends, strict=True) if falls <= end)
        assert str(step(falls=falls, members=members)) == expected


def test_sixteen_members_that_all_stay_far_stand():
    assert str(step(falls=0, members=16, farthest=0.3)) == "stands"
    assert str(step(falls=0, members=16, farthest=0.31)) == "probably stands"


@pytest.mark.parametrize(
    ("falls", "near"), [(0, False), (1, True), (7, True), (8, False), (17, False), (18, True)]
)
def test_more_members_are_asked_for_near_an_edge(falls, near):
    """e is 1/16 of 64 members, so that 5 % is near up to 7 falls and 1/3 from 18 on."""
    assert crack(falls).is_near_an_edge(0.05) is near
    assert crack(64 - falls).is_near_an_edge(0.05) is near


def test_sixteen_members_are_near_an_edge_unless_all_stay_far():
    assert all(crack(falls, 16).is_near_an_edge(0.05) for falls in range(17))
    assert not crack(0, 16, farthest=0.3).is_near_an_edge(0.05)


def test_a_crack_is_within_reach_where_its_own_count_may_still_change_the_word():
    """By the most by which the share of 64 members differs from that of very many, 4 of them; 0 and 64 are settled."""

    def reach(*falls, bulges=False):
        several = [crack(fall, name=str(place)) for place, fall in enumerate(falls)]
        several[-1] = replace(several[-1], bulges=bulges)
        return [may_change(Facts(cracks=tuple(several)), own) for own in several]

    assert reach(40, 39, 36) == [True, True, False]  # uncertain, up to 40 of 64
    assert reach(0, 18, 2) == [False, True, False]
    # beside one of statics that stands, a crack makes nothing worse than uncertain, but a bulge does
    assert reach(0, 39, 40) == [False, False, False]
    assert reach(0, 30, 40, bulges=True) == [False, False, True]
    assert reach(50, 64, 62) == [False, False, False]  # no worse than one that is worse by far


# The rows -----------------------------------------------------------------------------------------------------


def test_1_what_nothing_overturns_cannot_overturn():
    held = Facts(cracks=(crack(0),), never_overturns_because="stays tied", failures=("component X is cut",))
    decision = decide(held)
    assert str(decision.verdict) == "cannot overturn"
    assert decision.why == "stays tied"
    assert kinds(decision.would_settle) == [AssessmentKind.TIE_STRENGTH]
    assert decision.share_in_words == ""
    assert (
        word(cracks=(crack(0),), never_overturns_because="stays tied", warnings=(OPEN,)) == "cannot be told"
    )


def test_2_what_nothing_lifts_stands():
    decision = decide(Facts(cracks=(crack(0, farthest=0.0),), rests=True))
    assert (str(decision.verdict), decision.share, decision.share_in_words) == ("stands", 0.0, "0\u00a0%")
    # but for ties that give, of which stacks tell
    gives = Facts(cracks=(crack(0, farthest=0.0),), rests=True, held=True, beyond=AssessmentKind.TIES_GIVE)
    assert decide(gives).verdict is Verdict.PROBABLY_STANDS
    assert kinds(decide(gives).warnings) == [AssessmentKind.TIES_GIVE]
    assert decide(replace(gives, stacks=(0, 64))).verdict is Verdict.STANDS
    assert decide(replace(gives, stacks=(24, 64))).verdict is Verdict.UNCERTAIN


def test_3_what_slides_first_cannot_be_told():
    decision = decide(Facts(cracks=(crack(0, slides_at=0.6),), slides_at=0.6))
    assert str(decision.verdict) == "cannot be told"
    assert decision.why == "slides before it lifts, at 0.6 g"
    assert kinds(decision.would_settle) == [AssessmentKind.FRICTION]
    assert math.isnan(decision.share) and decision.share_in_words == ""
    # a motion that does not reach so far lets nothing slide
    assert word(cracks=(crack(0),)) == "stands"


def test_3_the_stones_of_what_slides_first_tell_and_its_mechanism_makes_nothing_safer():
    """Their runs are on the friction that it has; a stack of courses ends no row 3."""
    slides = Facts(cracks=(crack(0, slides_at=0.2),), slides_at=0.2, as_stones="as voussoirs")
    assert decide(slides).verdict is Verdict.CANNOT_BE_TOLD
    assert kinds(decide(slides).would_settle) == [AssessmentKind.FRICTION, AssessmentKind.CONTACT_DYNAMICS]
    assert kinds(decide(replace(slides, stackable=False)).would_settle) == [AssessmentKind.FRICTION]
    for stacks, falls, expected in (
        ((0, 24), 0, "probably stands"),
        ((0, 64), 0, "stands"),
        ((24, 24), 0, "probably overturns"),
        ((0, 64), 40, "uncertain"),
        ((0, 64), 64, "overturns"),
    ):
        cracks = (crack(falls, slides_at=0.2),)
        told = decide(replace(slides, cracks=cracks, stacks=stacks))
        assert str(told.verdict) == expected
        assert "slides before it lifts, at 0.2 g; " in told.why and "did not" not in told.why
        assert AssessmentKind.SLIDES_FIRST not in kinds(told.warnings)
        assert f"{stacks[0]} of {stacks[1]} runs as voussoirs fall in contact dynamics" in told.why
        assert told.share == max(stacks[0] / stacks[1], falls / 64)
    as_stack = replace(slides, as_stones="", stacks=(0, 64))
    assert decide(as_stack).verdict is Verdict.CANNOT_BE_TOLD
    assert decide(replace(slides, slides_at=0.0)).why == "slides apart at rest"


def test_8b_only_its_stones_let_an_arch_on_piers_stand():
    piers = Facts(cracks=(crack(0),), as_stones="as voussoirs", needs_stones=True)
    alone = decide(piers)
    assert str(alone.verdict) == "probably stands"
    assert AssessmentKind.STONES_TELL in kinds(alone.warnings)
    assert AssessmentKind.CONTACT_DYNAMICS in kinds(alone.would_settle)
    assert word(cracks=(crack(0, farthest=0.0),), rests=True, needs_stones=True) == "stands"
    for runs, expected in ((24, "probably stands"), (64, "stands")):
        told = decide(replace(piers, stacks=(0, runs)))
        assert str(told.verdict) == expected
        assert AssessmentKind.STONES_TELL not in kinds(told.warnings)


def test_3_a_crack_that_slides_first_is_left_out_where_another_is_left():
    upper = crack(48, name="hinge at 3.04 m", slides_at=0.14)
    assert word(cracks=(crack(0, name="base"), upper)) == "stands"
    would = "the hinge at 3.04 m would overturn 48 of 64 if it did not slide first, at 0.14 g"
    for falls, is_worse, doubted in (
        (0, True, True),
        (20, True, True),
        (41, False, False),
        (64, False, False),
    ):
        left = decide(Facts(cracks=(crack(falls, name="base"), upper)))
        assert (AssessmentKind.SLIDES_FIRST in kinds(left.warnings)) is doubted
        assert (would in left.why) is is_worse
    # one that would do no worse is a property of the structure, of which the decision says nothing
    like = decide(Facts(cracks=(crack(20, name="base"), replace(upper, falls=30, farthest=math.inf))))
    assert not like.warnings and "slide" not in like.why
    at_rest = decide(Facts(cracks=(crack(0), upper), rests=True))
    assert kinds(at_rest.warnings) == [AssessmentKind.SLIDES_FIRST]
    beside = crack(64, name="upper", counts=False)
    assert word(cracks=(crack(0, slides_at=0.6), beside), slides_at=0.6) == "cannot be told"


def test_4_without_a_result_it_cannot_be_told():
    decision = decide(Facts(failures=("the motion is too long",)))
    assert (str(decision.verdict), decision.why) == ("cannot be told", "the motion is too long")
    assert kinds(decision.would_settle) == [AssessmentKind.INPUT]
    assert word() == "cannot be told"


@pytest.mark.parametrize(
    ("ratio", "expected"),
    [(0.3, "probably stands"), (0.31, "uncertain"), (math.inf, "uncertain")],
)
def test_5_one_run_is_never_sure(ratio, expected):
    decision = decide(Facts(run_ratio=ratio))
    assert str(decision.verdict) == expected
    assert decision.share_in_words == "one run"
    assert kinds(decision.would_settle) == [AssessmentKind.ENSEMBLE]


@pytest.mark.parametrize(
    ("first", "worst", "expected"),
    [
        (0, 64, "uncertain"),
        (10, 64, "uncertain"),
        (0, 10, "probably stands"),
        (30, 64, "probably overturns"),
        (30, 35, "uncertain"),
        (50, 64, "probably overturns"),
        (64, 0, "overturns"),
    ],
)
def test_6_the_worst_crack_decides_within_what_statics_leaves(first, worst, expected):
    assert word(cracks=(crack(first), crack(worst, name="upper"))) == expected


def test_6_cracks_whose_words_differ_have_a_range():
    decision = decide(Facts(cracks=(crack(0), crack(63, name="upper"))))
    assert decision.interval == (0.0, 63 / 64)
    assert decision.share == 63 / 64
    assert decision.share_in_words == "0–98\u00a0%"
    assert "63 of 64 members overturn with the upper, 0 of 64 with the hinge of statics" in decision.why
    alike = decide(Facts(cracks=(crack(21), crack(30, name="upper"))))
    assert alike.interval == (30 / 64, 30 / 64)


def test_6_a_known_crack_decides_alone_and_a_worse_one_is_a_doubt_beside_it():
    upper = crack(64, name="upper", counts=False)
    decision = decide(Facts(cracks=(crack(0), upper)))
    assert (str(decision.verdict), decision.share) == ("stands", 0.0)
    assert kinds(decision.warnings) == [AssessmentKind.OTHER_CRACK_WORSE]
    assert "the known crack; with the upper 64 of 64 would" in decision.why


def test_6_a_bulge_counts_beside_a_known_crack():
    """It forms wherever the wall is cracked, so that the worse of the two is that of the wall, in whatever order."""
    bulge, stands = (replace(crack(value, name="bulge"), bulges=True) for value in (64, 0))
    beside = crack(64, name="upper", counts=False)
    for cracks in ((bulge, crack(0), beside), (crack(0), bulge, beside)):
        decision = decide(Facts(cracks=cracks))
        assert (str(decision.verdict), decision.interval) == ("overturns", (1.0, 1.0))
        assert kinds(decision.warnings) == []
    assert word(cracks=(stands, crack(64))) == "overturns"
    assert word(cracks=(stands, crack(0), crack(64, name="upper"))) == "uncertain"


def test_7_failed_members_count_as_falling():
    assert word(cracks=(crack(0, 65, failed=1),)) == "probably stands"
    assert word(cracks=(crack(0, failed=30),)) == "uncertain"


def test_7_a_crack_without_one_member_cannot_be_told():
    assert word(cracks=(crack(0, failed=64),)) == "cannot be told"
    assert word(cracks=(crack(0), crack(0, failed=64, name="upper"))) == "cannot be told"
    assert word(cracks=(crack(60), crack(0, failed=64, name="upper"))) == "probably overturns"
    assert word(cracks=(crack(0, failed=64),), stacks=(24, 24)) == "probably overturns"


def test_7_members_that_failed_make_nothing_fall():
    """63 of 64 fail: neither stands it, as it did without them, nor does it fall."""
    decision = decide(Facts(cracks=(crack(0, failed=63, farthest=0.2),)))
    assert str(decision.verdict) == "cannot be told"
    assert decision.interval == (0.0, 63 / 64)
    assert kinds(decision.warnings) == [AssessmentKind.MEMBERS_FAILED]
    assert kinds(decision.would_settle) == [AssessmentKind.TOLERANCE]
    assert math.isnan(decision.share)


def test_8_members_that_fall_decide_whatever_else_is_doubtful():
    facts = {"warnings": (OPEN,), "failures": ("component Y is cut",), "stacks": (0, 64)}
    assert word(cracks=(crack(64),), **facts) == "overturns"
    assert word(cracks=(crack(64, 66, failed=2),)) == "overturns"


@pytest.mark.parametrize(("runs", "expected"), [(24, "probably stands"), (64, "stands")])
def test_8b_a_held_wall_that_turns_far_needs_contact_dynamics_of_many_runs(runs, expected):
    far = {"cracks": (crack(0),), "held": True, "beyond": AssessmentKind.HELD_BEYOND}
    assert word(**far) == "probably stands"
    assert word(cracks=(crack(0),), held=True) == "stands"
    assert word(**far, stacks=(0, runs)) == expected


@pytest.mark.parametrize(
    ("runs", "expected"), [(None, "probably stands"), (24, "probably stands"), (64, "stands")]
)
def test_8b_a_contact_that_needs_more_friction_than_it_has_limits_the_word(runs, expected):
    """Lifted by many runs of contact dynamics, which are on that friction; the share is left."""
    slides = Facts(cracks=(crack(0),), friction_needed=0.7, stacks=None if runs is None else (0, runs))
    decision = decide(slides)
    assert (str(decision.verdict), decision.share) == (expected, 0.0)
    limited = expected != "stands"
    assert (AssessmentKind.FRICTION_SHORT in kinds(decision.warnings)) is limited
    assert (AssessmentKind.FRICTION in kinds(decision.would_settle)) is limited


@pytest.mark.parametrize("far", [{"warnings": (OPEN,)}, {"held": True, "beyond": AssessmentKind.TIES_GIVE}])
def test_contact_dynamics_is_advised_only_where_it_may_still_tell(far):
    """Not where it ran often enough already, nor of what it cannot follow, of which a doubt says so."""
    facts = Facts(cracks=(crack(0),), **far)
    assert kinds(decide(facts).would_settle) == [AssessmentKind.CONTACT_DYNAMICS]
    cannot = decide(replace(facts, stackable=False))
    assert cannot.would_settle == ()
    assert cannot.verdict is decide(facts).verdict
    told = [RockingWarning(AssessmentKind.NO_STACK)] if facts.warnings else []
    assert [warning for warning in cannot.warnings if warning not in decide(facts).warnings] == told
    assert decide(replace(facts, stacks=(0, 64))).would_settle == ()


def test_more_runs_are_advised_where_none_of_few_falls_and_the_members_all_stand():
    facts = Facts(cracks=(crack(0),), warnings=(OPEN,))
    assert kinds(decide(replace(facts, stacks=(0, 18))).would_settle) == [AssessmentKind.CONTACT_DYNAMICS]
    assert decide(replace(facts, stacks=(1, 19))).would_settle == ()


@pytest.mark.parametrize(
    ("members", "fallen", "runs", "expected"),
    [
        (0, 0, 24, "probably stands"),
        (0, 0, 64, "stands"),
        (20, 0, 64, "uncertain"),
        (0, 20, 24, "probably overturns"),
        (0, 24, 24, "probably overturns"),
        (0, 64, 64, "overturns"),
        (50, 0, 6, "probably overturns"),
    ],
)
def test_9_contact_dynamics_may_only_make_it_worse(members, fallen, runs, expected):
    decision = decide(Facts(cracks=(crack(members),), warnings=(THROWN,), stacks=(fallen, runs)))
    assert str(decision.verdict) == expected
    assert f"{fallen} of {runs} stacks" in decision.why


def test_9_the_share_is_of_one_model_and_the_mark_of_the_other_stands_next_to_it():
    for falls, stacks, share, other in (
        (0, (20, 24), 20 / 24, "as a mechanism 0 of 64 fall"),
        (50, (3, 24), 50 / 64, "in contact dynamics 3 of 24 runs fall"),
        (50, (0, 24), 50 / 64, "in contact dynamics 0 of 24 runs fall"),
        (0, (0, 24), 0.0, "None"),
    ):
        decision = decide(Facts(cracks=(crack(falls),), stacks=stacks))
        assert (decision.share, decision.interval, str(decision.other_model)) == (
            share,
            (share, share),
            other,
        )
        assert "–" not in decision.share_in_words
        assert decision.why.startswith(f"{falls} of 64 members overturn")


# The share ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("falls", "stacks", "share"),
    [(0, (20, 24), 20 / 24), (50, (0, 64), 50 / 64), (64, (0, 64), 1.0), (62, (24, 24), 1.0)],
)
def test_the_share_is_the_largest_of_members_and_stacks(falls, stacks, share):
    assert decide(Facts(cracks=(crack(falls),), stacks=stacks)).share == share


def test_the_share_takes_the_stacks_of_what_the_members_overturn_already():
    """One more member brings "overturns" about, and takes nothing from the share of the stacks."""
    facts = [Facts(cracks=(crack(falls, 256),), stacks=(24, 24)) for falls in (247, 248)]
    assert [str(decide(one_fact).verdict) for one_fact in facts] == ["probably overturns", "overturns"]
    assert [decide(fact).share for fact in facts] == [1.0, 1.0]


def test_a_further_fall_of_a_crack_of_few_members_takes_nothing_from_the_share():
    """3, then 4 of 16 beside 19 of 64: the few make the word by their error, the many have the larger share."""
    few = [Facts(cracks=(crack(falls, 16), crack(19, name="upper"))) for falls in (3, 4)]
    assert [str(decide(one_member).verdict) for one_member in few] == ["probably stands", "uncertain"]
    assert [decide(member).share for member in few] == [19 / 64, 19 / 64]
    assert decide(few[1]).interval == (16 / 64, 19 / 64)


def test_what_limits_the_word_leaves_the_share():
    """A held wall whose chains go far, and a single run."""
    far = decide(Facts(cracks=(crack(0),), held=True, beyond=AssessmentKind.HELD_BEYOND))
    assert (str(far.verdict), far.share) == ("probably stands", 0.0)
    alone = decide(Facts(run_ratio=math.inf))
    assert (str(alone.verdict), alone.share, alone.share_in_words) == ("uncertain", 1.0, "one run")


def test_a_single_run_is_no_share_of_the_stacks_beside_it():
    beside = decide(Facts(run_ratio=0.1, stacks=(14, 14)))
    assert (str(beside.verdict), beside.share, beside.share_in_words) == (
        "probably overturns",
        1.0,
        "100\u00a0%",
    )
    assert str(beside.other_model) == "as a mechanism 0 of 1 fall"
    assert decide(Facts(run_ratio=math.inf, stacks=(14, 14))).share_in_words == "100\u00a0%"


@pytest.mark.parametrize("found", [{"cracks": (crack(0),), "stacks": (0, 64)}, {"cracks": (), "rests": True}])
def test_8b_what_anchors_let_go_probably_stands_at_best_whatever_the_runs(found):
    decision = decide(Facts(anchors_slide=True, **found))
    assert (str(decision.verdict), decision.share, decision.interval) == ("probably stands", 0.0, (0.0, 0.0))
    assert kinds(decision.warnings) == [AssessmentKind.ANCHOR_GIVES]
    assert kinds(decision.would_settle) == [AssessmentKind.ANCHORS]
    assert word(cracks=(crack(50),), anchors_slide=True) == "probably overturns"


def test_severity_is_the_word_then_the_share_then_the_reserve_then_the_rotation():
    """What is not known counts as least; of several cases of a name the worst counts, then the sum of their shares."""
    told, untold = decide(Facts(cracks=(crack(12),))), decide(Facts(cracks=(crack(12),), warnings=(OPEN,)))
    nothing = decide(Facts(cracks=()))
    assert severity(told, factor=1.5, rotation_ratio=0.4) == (told.verdict.badness, 12 / 64, -1.5, 0.4)
    assert severity(untold) == (untold.verdict.badness, 12 / 64, -math.inf, -1.0)
    assert severity(nothing) == (nothing.verdict.badness, -1.0, -math.inf, -1.0)
    cases = [("a", severity(told)), ("b", severity(told)), ("b", severity(told)), ("c", severity(untold))]
    cases += [
        ("d", severity(told)),
        ("d", severity(nothing)),
        ("e", severity(told)),
        ("e", (0, -1.0, 0.0, 0.0)),
    ]
    assert worst_first(cases) == ["c", "d", "b", "a", "e"]


def test_10_a_doubt_leaves_only_the_least_share():
    decision = decide(Facts(cracks=(crack(12),), warnings=(OPEN,)))
    assert str(decision.verdict) == "cannot be told"
    assert decision.interval == (12 / 64, 1.0)
    assert decision.share_in_words == "at least 19\u00a0%"
    assert kinds(decision.would_settle) == [AssessmentKind.CONTACT_DYNAMICS]
    assert decision.why == "contacts open; 12 of 64 members overturn with the hinge"
    either = decide(Facts(cracks=(crack(0), crack(30, name="upper")), warnings=(OPEN,)))
    assert either.interval == (0.0, 1.0)


def test_10_a_missing_component_is_not_settled_by_contact_dynamics():
    missing = {"failures": ("the component X gave no result: too short",), "stacks": (0, 64)}
    decision = decide(Facts(cracks=(crack(0),), **missing))
    assert str(decision.verdict) == "cannot be told"
    assert kinds(decision.warnings) == [AssessmentKind.COMPONENT_MISSING]
    assert kinds(decision.would_settle) == [AssessmentKind.COMPONENT]
    assert "too short" in decision.why
    assert word(cracks=(crack(50),), **missing) == "probably overturns"


def test_11_tells_what_decides():
    decision = decide(Facts(cracks=(crack(30),), settling=(RockingWarning(AssessmentKind.RESTITUTION),)))
    assert kinds(decision.would_settle) == [AssessmentKind.RESTITUTION]
    assert decision.share_in_words == "47\u00a0%"


# At birth -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("made", "field"),
    [
        (lambda: CrackFacts("a", 3, 2, farthest=math.inf), "3 falls, 2 followed"),
        (lambda: CrackFacts("a", 0, 2, -1, farthest=0.1), "-1 failed"),
        (lambda: CrackFacts("a", 1, 2, farthest=0.1), "farthest 0.1"),
        (lambda: CrackFacts("a", 0, 2), "farthest nan"),
        (lambda: Facts(stacks=(3, 2)), "stacks"),
        (lambda: Facts(stacks=(0, 0)), "stacks"),
        (lambda: Facts(risk=0.5), "risk"),
    ],
)
def test_facts_that_contradict_themselves_are_refused(made, field):
    with pytest.raises(ValueError, match=field):
        made()


def test_the_order_of_badness_is_that_of_the_table():
    assert tuple(map(str, reversed(ORDER))) == SAFEST_FIRST


# Drawn facts --------------------------------------------------------------------------------------------------


def drawn(chance):
    """Facts of any kind: a case with up to three cracks or single runs, with what may go wrong.

    chance: gives the next number between 0 and 1.
    """

    def one_of(*values):
        return values[int(chance() * len(values))]

    cracks = []
    for place in range(one_of(0, 1, 2, 3)):
        members = one_of(16, 64, 256)
        failed = one_of(0, 0, 0, 1, 5, members // 2, members - 1, members)
        falls = min(one_of(0, 1, members, int(chance() * members)), members - failed)
        farthest = one_of(0.0, 0.2, 0.3, 0.8)
        level = 0.6 if chance() < 0.1 else math.nan
        cracks.append(crack(falls, members, failed, farthest, f"crack {place}", slides_at=level))
    if chance() < 0.2:  # one is known, beside which a bulge may count
        cracks = [
            replace(one_crack, counts=not place or chance() < 0.3) for place, one_crack in enumerate(cracks)
        ]
    if cracks and chance() < 0.2:
        bulge = int(chance() * len(cracks))
        cracks[bulge] = replace(cracks[bulge], counts=True, bulges=True)
    runs = one_of(6, 24, 64)
    fallen = one_of(0, 1, runs, int(chance() * runs))
    made = Facts(
        cracks=tuple(cracks),
        rests=chance() < 0.03,
        run_ratio=one_of(math.nan, 0.1, 0.5, math.inf),
        never_overturns_because="stays tied" if chance() < 0.05 else "",
        slides_at=0.6 if chance() < 0.1 else math.nan,
        friction_needed=one_of(0.7, math.inf) if chance() < 0.1 else math.nan,
        warnings=one_of((), (), (), (OPEN,), (THROWN,)),
        held=chance() < 0.3,
        beyond=AssessmentKind.HELD_BEYOND if chance() < 0.3 else None,
        stacks=(fallen, runs) if chance() < 0.3 else None,
        failures=("component X is cut",) if chance() < 0.1 else (),
    )
    # What rests was neither followed as stacks nor doubted.
    return replace(made, stacks=None, warnings=(), failures=()) if made.rests else made


def numbers(seed):
    """A function that gives numbers between 0 and 1, one after another, drawn many at a time."""
    random = np.random.default_rng(seed)
    return itertools.chain.from_iterable(random.random(10_000).tolist() for _ in itertools.count()).__next__


# The table of the specification once more, in its own words and in fractions.
def oracle(facts):
    """The word of the table, by somebody who has not seen the code."""

    def word_of(falls, members, far):
        error = Fraction(0) if far or (members >= 64 and falls in (0, members)) else Fraction(4, members)
        share = Fraction(falls, members)
        if share + error <= Fraction(1, 20):
            return 1
        if 1 - share + error <= Fraction(1, 20):
            return 6
        return 2 if share + error / 2 <= Fraction(1, 3) else 3 if share + error / 2 < Fraction(2, 3) else 5

    def with_failed(case):
        return word_of(
            case.falls + case.failed, case.followed + case.failed, not case.failed and case.farthest <= 0.3
        )

    def without_failed(one_case):
        if one_case.followed == 0:
            return 3
        word = word_of(one_case.falls, one_case.followed, one_case.farthest <= 0.3)
        return min(word, 3) if one_case.failed and one_case.falls <= 4 else word

    def of_all(way):
        words = [way(one_number) for one_number in count if not one_number.bulges]
        return max([of_cracks(words) if words else 1, *(way(number) for number in count if number.bulges)])

    def of_cracks(words):
        if words[0] <= 2:
            return min(max(words), 3)
        return max(words) if words[0] == 6 else min(max(words), 5)

    count = [crack for crack in facts.cracks if crack.counts]
    count = [one_number for one_number in count if not one_number.slides] or count
    if facts.never_overturns_because and not facts.warnings:
        return SAFEST_FIRST[0]
    if facts.rests:
        return SAFEST_FIRST[1]
    if facts.slides_at == 0.6 and not [other_number for other_number in count if not other_number.slides]:
        return SAFEST_FIRST[4]
    if count:
        borne_out = of_all(without_failed)
        place = of_all(with_failed)
        if borne_out < 5 and (place >= 5 or any(number.followed == 0 for number in count)):
            place = 4
    elif math.isnan(facts.run_ratio):
        return SAFEST_FIRST[4]
    else:
        place = 2 if facts.run_ratio <= 0.3 else 3
    if place == 6:
        return SAFEST_FIRST[6]
    limited = (facts.held and facts.beyond) or facts.friction_needed > 0.6
    if limited and not (facts.stacks and facts.stacks[1] >= 64):
        place = max(place, 2)
    if facts.stacks:
        place = max(place, word_of(*facts.stacks, False))
    if place < 4 and (facts.failures or (facts.warnings and not facts.stacks)):
        return SAFEST_FIRST[4]
    return SAFEST_FIRST[place]


def test_the_decision_is_that_of_the_table():
    chance = numbers(51)
    met = set()
    for _ in range(3_000):
        facts = drawn(chance)
        assert str(decide(facts).verdict) == oracle(facts), facts
        met.add(str(decide(facts).verdict))
    assert met == set(SAFEST_FIRST)


def share_of_the_table(facts):
    """The largest share of the cracks that count and of the stacks; None where there is none, as of a single run."""
    count = [crack for crack in facts.cracks if crack.counts]
    count = [number for number in count if not number.slides] or count
    of_each = [
        Fraction(one_number.falls + one_number.failed, one_number.followed + one_number.failed)
        for one_number in count
    ]
    if not of_each or facts.rests or (facts.never_overturns_because and not facts.warnings):
        return None
    return max([*of_each, *([Fraction(*facts.stacks)] if facts.stacks else [])])


@pytest.mark.parametrize("draws", [2_000, pytest.param(50_000, marks=pytest.mark.slow)])
def test_the_share_stands_on_the_word(draws):
    """At it, those that make the word have a step no safer than the word; but of one run, a held wall and doubts."""
    chance = numbers(62)
    by_stacks = met = 0
    for _ in range(draws):
        facts = drawn(chance)
        decision = decide(facts)
        share = share_of_the_table(facts)
        if share is None or math.isnan(decision.share):
            continue
        assert decision.share == float(share), facts
        assert decision.interval[0] <= decision.share == decision.interval[1]
        if (facts.held and facts.beyond) or facts.friction_needed > 0:
            continue
        groups = [
            (crack.falls + crack.failed, crack.members, math.inf if crack.failed else crack.farthest)
            for crack in facts.followed
        ]
        groups += [(*facts.stacks, math.inf)] if facts.stacks else []
        makes = max(
            groups,
            key=lambda group: (step(falls=group[0], members=group[1], farthest=group[2]).badness, -group[1]),
        )
        falls = math.ceil(share * makes[1])
        farthest = makes[2] if falls == makes[0] else math.inf
        assert step(falls=falls, members=makes[1], farthest=farthest).badness >= decision.verdict.badness, (
            facts
        )
        met += 1
        by_stacks += bool(facts.stacks) and share == Fraction(*facts.stacks)
    assert by_stacks > draws / 50 and met > draws / 3


def worsened(facts, chance):
    """The facts with one thing gone worse: a doubt, a component, a member or a stack more."""
    ways = [{"failures": (*facts.failures, "component Y is cut")}, {"beyond": AssessmentKind.TIES_GIVE}]
    ways.append({"friction_needed": 0.8})
    ways += [{"warnings": (*facts.warnings, case)} for case in (OPEN, THROWN) if case not in facts.warnings]
    if not math.isnan(facts.run_ratio):
        ways.append({"run_ratio": math.inf})
    if facts.stacks and facts.stacks[0] < facts.stacks[1]:
        ways.append({"stacks": (facts.stacks[0] + 1, facts.stacks[1])})
    for place, crack in enumerate(facts.cracks):
        falls, followed, failed = crack.falls, crack.followed, crack.failed
        worse = [(falls, followed, failed + 1, crack.farthest)]
        if falls < followed:
            left = crack.farthest if followed > 1 else math.nan
            worse += [(falls, followed - 1, failed + 1, left), (falls + 1, followed, failed, math.inf)]
        for counts in worse:
            falls, followed, failed, farthest = counts
            other = replace(crack, falls=falls, followed=followed, failed=failed, farthest=farthest)
            ways.append({"cracks": (*facts.cracks[:place], other, *facts.cracks[place + 1 :])})
    return replace(facts, **ways[int(chance() * len(ways))])


@pytest.mark.parametrize("draws", [2_000, pytest.param(50_000, marks=pytest.mark.slow)])
def test_a_further_doubt_failure_or_fall_never_makes_a_word_safer_nor_a_share_smaller(draws):
    chance = numbers(8)
    changed = grown = 0
    for _ in range(draws):
        facts = drawn(chance)
        worse = worsened(facts, chance)
        before, after = (SAFEST_FIRST.index(decide(case).verdict) for case in (facts, worse))
        assert after >= before, (facts, worse)
        changed += after > before
        first, then = decide(facts), decide(worse)
        assert not then.share < first.share, (facts, worse)  # where both are known
        grown += then.share > first.share
    assert changed > draws / 50 and grown > draws / 50
