"""The conclusion on a structure: its order, its warning, and the sentence on all of them."""

import math
from collections.abc import Sequence
from dataclasses import replace

import pytest

from rocking.assessment.conclusion import Conclusion, conclusion_in_words, conclusions, fallen_in_one_run
from rocking.assessment.decide import Decision, Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.reserve import Reserve
from rocking.warnings import Kind, RockingWarning
from tests.unit.assessment.made_rows import compared, decided


def of(
    word: Verdict,
    integrated: float = 0.5,
    *,
    warnings: Sequence[Kind] = (),
    would_settle: Sequence[Kind] = (),
    other_model: RockingWarning | None = None,
) -> Conclusion:
    """The conclusion on a structure of that word that rotates so far as recorded."""
    unknown = math.nan, math.nan
    warnings = tuple(map(RockingWarning, warnings)), tuple(map(RockingWarning, would_settle))
    decision = Decision(word, math.nan, unknown, "", *warnings, other_model=other_model)
    return Conclusion(decided(decision), compared("EW", integrated))


@pytest.mark.parametrize(
    ("conclusion", "kind"),
    [
        (of(Verdict.UNCERTAIN, would_settle=(AssessmentKind.RESTITUTION,)), AssessmentKind.RESTITUTION),
        # The mark of the model that does not make the share comes before all.
        (
            of(
                Verdict.UNCERTAIN,
                would_settle=(AssessmentKind.CRACK,),
                other_model=RockingWarning.of(AssessmentKind.STACKS_FALL, falls=3, runs=24),
            ),
            AssessmentKind.STACKS_FALL,
        ),
        (
            of(Verdict.OVERTURNS, math.inf, would_settle=(AssessmentKind.RESTITUTION,)),
            AssessmentKind.STRENGTHEN,
        ),
        (of(Verdict.STANDS, warnings=(AssessmentKind.OTHER_CRACK_WORSE,)), AssessmentKind.OTHER_CRACK_WORSE),
        (of(Verdict.PROBABLY_OVERTURNS), AssessmentKind.STANDS_AS_RECORDED),
        (of(Verdict.PROBABLY_STANDS, math.inf), AssessmentKind.FALLS_AS_RECORDED),
        (of(Verdict.UNCERTAIN), AssessmentKind.NOTHING_DECIDES),
        (of(Verdict.STANDS), AssessmentKind.NOTHING_TO_DO),
    ],
)
def test_what_to_do_comes_before_what_explains_the_word(conclusion, kind):
    assert conclusion.warning.kind is kind


def test_a_contact_that_slides_is_told_by_what_it_needs_as_it_lifts_and_at_most():
    """The largest alone is of an instant, and would call a slender pier one that slides."""
    made = of(Verdict.STANDS)
    slides = replace(compared("EW", 0.5), slides=True, lifting_friction=0.22, required_friction=1.84)
    assert replace(made, case=slides).warning.brief == "slides below μ 0.22–1.8"
    # What was followed on the friction that it has needs no word on it.
    followed = replace(made, case=slides, row=replace(made.row, stack_falls=0, stack_runs=18))
    assert followed.warning.kind is AssessmentKind.NOTHING_TO_DO
    moves = replace(compared("EW", 0.5), bearing_displacement_m=0.1)
    assert replace(made, case=moves).warning == RockingWarning.of(AssessmentKind.FLOORS_MOVE, moved_m=0.1)
    lost = replace(slides, required_friction=math.inf)
    assert replace(made, case=lost).warning.kind is AssessmentKind.CONTACTS_OPEN


def test_the_friction_that_limits_a_word_stands_beside_it():
    """Of all directions, before what else there is to do; without a comparison it is told without figures."""
    limited = of(Verdict.PROBABLY_STANDS)
    limited = replace(limited, row=replace(limited.row, friction_needed=0.67))
    known = replace(limited, case=replace(compared("EW", 0.5), lifting_friction=0.49))
    assert known.warning == RockingWarning.of(AssessmentKind.CONTACT_SLIDES, lifting=0.49, largest=0.67)
    assert replace(limited, case=None).warning == RockingWarning(AssessmentKind.FRICTION_SHORT)


def test_the_worst_period_stands_for_a_support_and_the_others_are_its_warning():
    """The ground below it stands for comparison only."""
    shares = {0.0: 1.0, 0.2: 0.25, 0.3: 0.75, 0.4: 0.5}
    rows = [
        decided(Decision(Verdict.UNCERTAIN, share, (share, share), ""), support_period_s=period)
        for period, share in shares.items()
    ]
    (conclusion,) = conclusions(rows, [])
    assert conclusion.row.support_period_s == 0.3
    assert conclusion.warning["share"] == "25–50\u00a0%"


def test_of_equal_shares_the_one_of_less_reserve_is_worse():
    rows = [
        decided(
            Decision(Verdict.STANDS, 0.0, (0.0, 0.0), ""),
            Reserve(low=low, median=math.nan, high=math.nan, limit=3.0),
            structure=name,
        )
        for name, low in (("none", math.nan), ("more", 2.0), ("less", 1.5))
    ]
    assert [conclusion.row.structure for conclusion in conclusions(rows, [])] == ["less", "more", "none"]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ((), "No structure was assessed."),
        (("overturns", "overturns"), "All 2 structures overturn or probably do."),
        (("cannot be told", "cannot be told"), "What becomes of all 2 structures cannot be told."),
        (("uncertain", "stands"), "None of 2 structures overturns or probably does; 1 is uncertain."),
        (
            ("uncertain", "uncertain", "cannot be told"),
            "None of 3 structures overturns or probably does; 2 are uncertain, 1 cannot be told.",
        ),
        (("cannot be told", "stands"), "None of 2 structures overturns or probably does; 1 cannot be told."),
        (
            ("overturns", "probably overturns", "cannot be told", "cannot be told", "stands"),
            "2 of 5 structures overturn or probably do; 2 cannot be told.",
        ),
    ],
)
def test_one_sentence_says_it_of_all(words, sentence):
    assert conclusion_in_words({str(n): Verdict(word) for n, word in enumerate(words)}) == sentence


@pytest.mark.parametrize("share", [0.0, 0.04, 0.05, 0.3, 0.5, 0.94, 0.95, 1.0])
def test_a_reserve_never_contradicts_the_share_at_the_record_itself(share):
    """What overturns there has a factor of 1 at most, what does not one of 1 at least, or none."""
    for found in (
        Reserve(low=0.8, median=1.1, high=2.6, limit=3.0),
        Reserve(low=1.2, median=math.nan, high=math.nan, limit=3.0),
        Reserve(low=0.2, median=0.3, high=0.4, limit=3.0),
    ):
        held = found.held_to(share)
        for reached, factor, before in zip(
            (0.05, 0.5, 0.95),
            (held.low, held.median, held.high),
            (found.low, found.median, found.high),
            strict=True,
        ):
            assert factor <= 1 if share >= reached else not factor < 1
            assert factor in (1.0, before) or math.isnan(before)


def test_without_an_ensemble_what_falls_in_its_one_run_is_counted():
    words = dict.fromkeys("abcd", Verdict.UNCERTAIN) | {"e": Verdict.STANDS}
    assert conclusion_in_words(words, fallen={"a", "b"}) == (
        "2 of 5 structures fall in their one run, without an ensemble; 2 are uncertain."
    )
    assert conclusion_in_words(words | {"a": Verdict.OVERTURNS}, fallen={"b"}).startswith(
        "1 of 5 structures overturns"
    )
    one_run = (RockingWarning(AssessmentKind.ENSEMBLE),)
    made = [
        Conclusion(
            decided(Decision(word, share, (share, share), "", (), settled), structure=name),
            compared("EW", 2.0),
        )
        for name, word, share, settled in (
            ("falls", Verdict.UNCERTAIN, 1.0, one_run),
            ("stands", Verdict.UNCERTAIN, 0.0, one_run),
            ("all fall", Verdict.OVERTURNS, 1.0, ()),
        )
    ]
    assert fallen_in_one_run(made) == {"falls"}
