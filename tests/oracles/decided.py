"""The decision as one walk through its table, as it was before evidence became limits, to compare `decide` with."""

import math
from dataclasses import dataclass

from rocking.assessment.decide import (
    FAR,
    UNANIMOUS,
    Decision,
    Facts,
    Verdict,
    _counted,
    _envelope,
    _worse_left_out,
    _worse_than_known,
    step,
    worse,
)
from rocking.assessment.kinds import AssessmentKind
from rocking.warnings import Kind, RockingWarning


@dataclass(frozen=True, kw_only=True)
class AllFacts(Facts):
    """Facts of mechanisms and evidence together."""

    friction_needed: float = math.nan
    warnings: tuple[RockingWarning, ...] = ()
    held: bool = False
    beyond: Kind | None = None
    anchors_slide: bool = False
    needs_stones: bool = False


def decide(facts: AllFacts) -> Decision:
    """Return the decision, row after row."""
    risk = facts.risk
    followed = facts.followed
    governing = facts.governing
    unsettled = facts.warnings if facts.stacks is None else ()
    missing = (RockingWarning(AssessmentKind.COMPONENT_MISSING),) if facts.failures else ()
    worse_other = _worse_than_known(facts)
    warnings = (
        *unsettled,
        *missing,
        *([RockingWarning(AssessmentKind.OTHER_CRACK_WORSE)] if worse_other else []),
    )
    sliding = _slides_throughout(facts)
    crack_left_out = _worse_left_out(facts)
    left_out = (RockingWarning(AssessmentKind.SLIDES_FIRST),) if crack_left_out else ()
    asks_for_stacks = facts.stackable and facts.stacks is None
    contact_dynamics = (RockingWarning(AssessmentKind.CONTACT_DYNAMICS),) if asks_for_stacks else ()
    if unsettled and not facts.stackable:
        warnings = (*warnings, RockingWarning(AssessmentKind.NO_STACK))
    would_settle: tuple[RockingWarning, ...]

    # 1, 2, 3: what follows without any member.
    if facts.never_overturns_because and not facts.warnings and not facts.anchors_slide:
        would_settle = (RockingWarning(AssessmentKind.TIE_STRENGTH),)
        return Decision(
            Verdict.CANNOT_OVERTURN,
            0.0,
            (0.0, 0.0),
            facts.never_overturns_because,
            (*warnings, *left_out),
            would_settle,
        )
    # What swings on ties that give may fall though its mechanism, which takes them as rigid, rests: rows 8b and 9.
    if facts.rests and facts.beyond is not AssessmentKind.TIES_GIVE:
        why = "the ground never reaches the uplift acceleration"
        if facts.anchors_slide:
            warnings = (*warnings, RockingWarning(AssessmentKind.ANCHOR_GIVES))
        word = Verdict.PROBABLY_STANDS if facts.anchors_slide else Verdict.STANDS
        would_settle = (RockingWarning(AssessmentKind.ANCHORS),) if facts.anchors_slide else ()
        return Decision(word, 0.0, (0.0, 0.0), why, (*warnings, *left_out), would_settle)
    if sliding and not (facts.as_stones and facts.stacks):
        would_settle = (
            RockingWarning(AssessmentKind.FRICTION),
            *(contact_dynamics if facts.as_stones else ()),
        )
        return Decision(
            Verdict.CANNOT_BE_TOLD, math.nan, (math.nan, math.nan), sliding, warnings, would_settle
        )

    # 4
    if governing is None and math.isnan(facts.run_ratio):
        why = "; ".join(facts.failures) or "no component gave a result"
        would_settle = (RockingWarning(AssessmentKind.INPUT),)
        return Decision(Verdict.CANNOT_BE_TOLD, math.nan, (math.nan, math.nan), why, warnings, would_settle)

    if governing is None:
        # 5: one run, whose scatter nobody knows.
        word = Verdict.PROBABLY_STANDS if facts.run_ratio <= FAR else Verdict.UNCERTAIN
        why = "one run as recorded, without an ensemble"
        would_settle = (RockingWarning(AssessmentKind.ENSEMBLE),)
        share = float(facts.run_ratio == math.inf)
        interval = share, share
    else:
        # 6: the worst crack; statics' own keeps a word in it.
        word = _envelope((crack, crack.step(risk)) for crack in followed)
        would_settle = facts.settling
        # Not that of the worst step: by their error fewer members may have the worse word and the smaller share.
        share = max(crack.share for crack in followed)
        why = _counted(facts, worse_other)
        if crack_left_out:
            would = f"the {crack_left_out.name} would overturn {crack_left_out.count}"
            why = f"{why}; {would} if it did not slide first, at {crack_left_out.slides_at:.2g} g"
        if facts.top is not None:
            why = f"{why}; {facts.top.brief}"
            would_settle = (*would_settle, RockingWarning(AssessmentKind.TIE_THE_TOP))
        of_part = [crack for crack in followed if crack.part == governing.part]
        first = next((crack for crack in of_part if not crack.bulges), governing)
        disagree = not governing.bulges and governing.step(risk) is not first.step(risk)
        ends = {governing, first} if disagree else {governing}
        interval = min(crack.falls / crack.members for crack in ends), share
        # 7: failed members count as falling, but alone they make nothing fall.
        falls_without = _envelope((crack, crack.step_of_followed(risk)) for crack in followed)
        open_ = word.badness >= Verdict.PROBABLY_OVERTURNS.badness or not all(
            crack.followed for crack in followed
        )
        if open_ and falls_without.badness < Verdict.PROBABLY_OVERTURNS.badness:
            word = Verdict.CANNOT_BE_TOLD
            would_settle = (RockingWarning(AssessmentKind.TOLERANCE),)
        if any(crack.failed for crack in followed):
            warnings = (*warnings, RockingWarning(AssessmentKind.MEMBERS_FAILED))

    if sliding:
        why = f"{sliding}; {why}"
    if facts.stacks is not None:
        fallen, runs = facts.stacks
        followed_as = f"runs {facts.as_stones}" if facts.as_stones else "stacks of courses"
        why = f"{why}; {fallen} of {runs} {followed_as} fall in contact dynamics"
        # since then: the interval is that of the model of the larger share
        interval = interval if fallen / runs <= share else (fallen / runs, fallen / runs)
        share = max(share, fallen / runs)

    # 8
    if word is Verdict.OVERTURNS:
        return Decision(word, share, interval, why, warnings)
    # 8b, 9: what bounds the step of the mechanism.
    limits = [RockingWarning(facts.beyond)] if facts.held and facts.beyond else []
    slides = not math.isnan(facts.friction_needed)
    if slides:
        limits.append(RockingWarning(AssessmentKind.FRICTION_SHORT))
    if facts.needs_stones and facts.stacks is None:
        limits.append(RockingWarning(AssessmentKind.STONES_TELL))
    if limits and (facts.stacks is None or facts.stacks[1] < UNANIMOUS):
        word = worse(word, Verdict.PROBABLY_STANDS)
        warnings = (*warnings, *limits)
        would_settle = (
            *would_settle,
            *contact_dynamics,
            *([RockingWarning(AssessmentKind.FRICTION)] if slides else []),
        )
    if facts.anchors_slide:
        word = worse(word, Verdict.PROBABLY_STANDS)
        warnings = (*warnings, RockingWarning(AssessmentKind.ANCHOR_GIVES))
        would_settle = (*would_settle, RockingWarning(AssessmentKind.ANCHORS))
    if facts.stacks is not None:
        of_stacks = step(falls=fallen, members=runs, risk=risk)
        if of_stacks.badness > word.badness and runs < UNANIMOUS and not fallen:
            would_settle = (
                *would_settle,
                RockingWarning(AssessmentKind.CONTACT_DYNAMICS),
            )  # more runs of which none falls would say more
        word = worse(word, of_stacks)
    if word.badness < Verdict.PROBABLY_OVERTURNS.badness:
        warnings = (*warnings, *left_out)
    # 10: a mechanism that stands says nothing of what it does not follow.
    if (unsettled or missing) and word.badness < Verdict.PROBABLY_OVERTURNS.badness:
        reasons = [*map(str, unsettled), *facts.failures]
        would_settle = contact_dynamics if unsettled else ()
        would_settle += (RockingWarning(AssessmentKind.COMPONENT),) if missing else ()
        at_least = interval[0], 1.0
        return Decision(
            Verdict.CANNOT_BE_TOLD, math.nan, at_least, "; ".join([*reasons, why]), warnings, would_settle
        )
    # 11
    printed = math.nan if word is Verdict.CANNOT_BE_TOLD else share
    return Decision(word, printed, interval, why, warnings, would_settle)


def _slides_throughout(facts: AllFacts) -> str:
    """Where every crack that counts slides before it lifts, and the motion reaches so far, in words; else ""."""
    if math.isnan(facts.slides_at) or not all(crack.slides for crack in facts.counting):
        return ""
    return (
        f"slides before it lifts, at {facts.slides_at:.2g} g" if facts.slides_at else "slides apart at rest"
    )
