"""The decision: what becomes of a structure under a motion, with all uncertain inputs considered.

`decide` is the only place where a verdict is decided. It is given facts alone, and what it returns is what every table,
report and line prints: a verdict, the share behind it and its interval, the reason, the warnings and what would say
more.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from enum import StrEnum

from rocking.assessment.kinds import AssessmentKind
from rocking.quantities import percents
from rocking.warnings import Kind, RockingWarning

UNANIMOUS = 64
"""Members of which none overturns, or none stands, that settle a verdict."""
FAR = 0.3
"""Rotation ratio that fewer members must all stay below to settle that the structure stands."""
ONE_RUN = "one run"
"""The share, in words, of what was followed once, without an ensemble."""
LATTICE_ERROR = 4.0
"""Members times the error of a probability that all but few cases stay below; `calibrate_ensemble` counts them."""


class Verdict(StrEnum):
    """The verdict on a structure under a ground motion, with all uncertain inputs considered.

    Examples
    --------
    >>> [str(verdict) for verdict in rocking.Verdict][:3]
    ['stands', 'probably stands', 'uncertain']
    """

    STANDS = "stands"
    PROBABLY_STANDS = "probably stands"
    UNCERTAIN = "uncertain"
    PROBABLY_OVERTURNS = "probably overturns"
    OVERTURNS = "overturns"
    CANNOT_BE_TOLD = "cannot be told"
    """It could not be computed, or what was computed leaves out what may decide."""
    CANNOT_OVERTURN = "cannot overturn"
    """It stands under this motion, and no other makes what holds it fail."""

    @property
    def stays_up(self) -> bool:
        """Whether the structure stays up, because this motion does not overturn it or because none can."""
        return self in (Verdict.STANDS, Verdict.CANNOT_OVERTURN)

    @property
    def is_sure(self) -> bool:
        """Whether the verdict is final: it stays up, or it overturns."""
        return self.stays_up or self is Verdict.OVERTURNS

    @property
    def predicate(self) -> str:
        """It as what a sentence says of a structure."""
        return "is uncertain" if self is Verdict.UNCERTAIN else str(self)

    @property
    def badness(self) -> int:
        """The place from the safest, 0, to the worst."""
        return len(ORDER) - 1 - ORDER.index(self)


ORDER = (
    Verdict.OVERTURNS,
    Verdict.PROBABLY_OVERTURNS,
    Verdict.CANNOT_BE_TOLD,
    Verdict.UNCERTAIN,
    Verdict.PROBABLY_STANDS,
    Verdict.STANDS,
    Verdict.CANNOT_OVERTURN,
)
"""The worst verdict first."""


def worse(*verdicts: Verdict) -> Verdict:
    """Return the worst of several verdicts."""
    return max(verdicts, key=lambda verdict: verdict.badness)


def better(*verdicts: Verdict) -> Verdict:
    """Return the safest of several verdicts."""
    return min(verdicts, key=lambda verdict: verdict.badness)


def share_error(*, falls: int, members: int, farthest: float = math.inf) -> float:
    """Return the most by which the share of `members` that fall differs from that of very many.

    It is inversely proportional to the number of members, not to its root, because they are points of a lattice. It
    counts as none where UNANIMOUS members or more agree, or where fewer all stay FAR from overturning. farthest:
    largest rotation ratio.
    """
    many_agree = members >= UNANIMOUS and falls in (0, members)
    return 0.0 if many_agree or farthest <= FAR else LATTICE_ERROR / max(members, 1)


def step(*, falls: int, members: int, farthest: float = math.inf, risk: float = 0.05) -> Verdict:
    """Return the verdict of `members` of which `falls` overturn: where the error counts, it counts on the unsafe side.

    risk: largest probability of the opposite outcome.

    >>> [str(step(falls, 64)) for falls in (0, 1, 20, 41, 64)]
    ['stands', 'probably stands', 'uncertain', 'probably overturns', 'overturns']
    """
    error = (
        share_error(falls=falls, members=members, farthest=farthest) * members
    )  # in members, so that no edge depends on rounding
    if falls + error <= risk * members:
        return Verdict.STANDS
    if members - falls + error <= risk * members:
        return Verdict.OVERTURNS
    tripled = 3 * falls + 1.5 * error
    if tripled <= members:
        return Verdict.PROBABLY_STANDS
    return Verdict.UNCERTAIN if tripled < 2 * members else Verdict.PROBABLY_OVERTURNS


@dataclass(frozen=True)
class CrackFacts:
    """The fate of the members with one crack.

    name: of the crack; "" where only one may form. falls: of those `followed`, that overturn. failed: members that
    could not be followed. farthest: largest rotation ratio of those followed; nan without any. slides_at: acceleration
    [g] at which its joint slides before it lifts, under a motion that reaches so far; nan of one that lifts. counts:
    whether it takes part in the verdict; otherwise it is reported along with the known crack. bulges: whether it is the
    bulge of a held wall, which may form wherever that is cracked. part: the leaf that falls alone, "" of the whole
    structure. Raises ValueError.
    """

    name: str
    falls: int
    followed: int
    failed: int = 0
    farthest: float = math.nan
    _: KW_ONLY
    slides_at: float = math.nan
    counts: bool = True
    bulges: bool = False
    part: str = ""

    def __post_init__(self) -> None:
        if not 0 <= self.falls <= self.followed or self.failed < 0:
            counts = f"{self.falls} falls, {self.followed} followed, {self.failed} failed"
            raise ValueError(
                f"crack {self.name!r}: {counts}, but must be 0 ≤ falls ≤ followed and failed ≥ 0."
            )
        if math.isnan(self.farthest) == (self.followed > 0) or (self.farthest == math.inf) != (
            self.falls > 0
        ):
            raise ValueError(
                f"crack {self.name!r}: farthest {self.farthest}, but must be inf where a member falls, nan where none "
                "was followed."
            )

    @property
    def slides(self) -> bool:
        """Whether its joint slides before it lifts."""
        return not math.isnan(self.slides_at)

    @property
    def members(self) -> int:
        """Members that were followed or failed."""
        return self.followed + self.failed

    @property
    def share(self) -> float:
        """Share of the members that overturn, those that failed counted as falling; nan without members."""
        return (self.falls + self.failed) / self.members if self.members else math.nan

    @property
    def count(self) -> str:
        """Members that overturn, of how many: "12 of 64", "12 to 14 of 64" where two failed."""
        up_to = f" to {self.falls + self.failed}" if self.failed else ""
        return f"{self.falls}{up_to} of {self.members}"

    def step(self, risk: float) -> Verdict:
        """Return the verdict of its members, those that failed counted as falling."""
        return step(
            falls=self.falls + self.failed,
            members=self.members,
            farthest=self.farthest if not self.failed else math.inf,
            risk=risk,
        )

    @property
    def share_error(self) -> float:
        """The most by which the share differs from that of very many members."""
        return share_error(
            falls=self.falls + self.failed,
            members=self.members,
            farthest=math.inf if self.failed else self.farthest,
        )

    def is_near_an_edge(self, risk: float) -> bool:
        """Whether one of the four edges between verdicts lies within the error, so that more members may change it."""
        edges = risk, 1 / 3, 2 / 3, 1 - risk  # those of `step`
        return self.share_error > 0 and any(abs(self.share - edge) <= self.share_error for edge in edges)

    def step_at_worst(self, risk: float) -> Verdict:
        """Return the verdict of its members if so many more overturn as the error of their share covers."""
        falls = self.falls + self.failed + math.ceil(self.share_error * self.members)
        return step(falls=min(falls, self.members), members=self.members, risk=risk)

    def step_of_followed(self, risk: float) -> Verdict:
        """Return the verdict of those that were followed alone.

        Where members failed, so few falls that the error of the share holds them all bear out no verdict of falling.
        """
        if not self.followed:
            return Verdict.UNCERTAIN
        verdict = step(falls=self.falls, members=self.followed, farthest=self.farthest, risk=risk)
        return better(verdict, Verdict.UNCERTAIN) if self.failed and self.falls <= LATTICE_ERROR else verdict

    def severity(self, risk: float) -> tuple[int, float, float]:
        """Key by which the worst of several comes last: the verdict, the share that overturns, then the rotation."""
        farthest = -1.0 if math.isnan(self.farthest) else self.farthest
        return self.step(risk).badness, -1.0 if math.isnan(self.share) else self.share, farthest


_PLACES: dict[Kind, int] = {kind: place for place, kind in enumerate(AssessmentKind)}


@dataclass(frozen=True, kw_only=True)
class Limit:
    """What one kind of evidence sets against a verdict: no safer than `at_best`.

    warning: for which. settles: what would say more of it, besides contact dynamics. lifted_by: runs of contact
    dynamics from which on these say instead; inf where they follow nothing of it. at_rest: whether it acts before
    anything lifts. value: the number behind it; nan without one.
    """

    warning: RockingWarning
    at_best: Verdict = Verdict.PROBABLY_STANDS
    settles: tuple[RockingWarning, ...] = ()
    lifted_by: float = UNANIMOUS
    at_rest: bool = False
    value: float = math.nan

    @classmethod
    def untold(cls, warning: RockingWarning) -> "Limit":
        """Return that of a doubt in which nothing can be told of what does not fall, until contact dynamics ran."""
        return cls(warning=warning, at_best=Verdict.CANNOT_BE_TOLD, lifted_by=1, at_rest=True)

    @property
    def is_untold(self) -> bool:
        """Whether nothing can be told of what does not fall."""
        return self.at_best is Verdict.CANNOT_BE_TOLD

    @property
    def by_contacts(self) -> bool:
        """Whether contact dynamics would tell more of it."""
        return math.isfinite(self.lifted_by)


_MISSING = Limit(
    warning=RockingWarning(AssessmentKind.COMPONENT_MISSING),
    at_best=Verdict.CANNOT_BE_TOLD,
    settles=(RockingWarning(AssessmentKind.COMPONENT),),
    lifted_by=math.inf,
    at_rest=True,
)
"""Of a structure a component of which gave no result."""


@dataclass(frozen=True, kw_only=True)
class Facts:
    """The facts that are known of one structure under one motion, but for the evidence against its mechanisms.

    cracks: those that were followed, first the one that is known or that statics chooses. rests: whether nothing can
    lift. run_ratio: largest rotation ratio of single runs, where no members were followed; nan without one.
    never_overturns_because: why no motion can overturn it with a crack that counts; "" where one can. slides_at: the
    acceleration [g] at which its joints slide where none of its cracks that count lifts before, and the motion reaches
    it; else nan. top: what its top needs and does not get, so that it slips; None where it holds, or there is none.
    stacks: stacks of courses that fall in contact dynamics, of how many; None where none was followed. as_stones: as
    what chain of stones it is followed then, "as voussoirs"; "" where as a stack of courses. stackable: whether
    contact dynamics can follow it and has not done so yet. settling: what would reduce the disagreement of the members.
    failures: why components gave no result. risk: largest probability of the outcome opposite to "stands" or
    "overturns". Raises ValueError.
    """

    cracks: tuple[CrackFacts, ...] = ()
    rests: bool = False
    run_ratio: float = math.nan
    never_overturns_because: str = ""
    slides_at: float = math.nan
    top: RockingWarning | None = None
    stacks: tuple[int, int] | None = None
    as_stones: str = ""
    stackable: bool = True
    settling: tuple[RockingWarning, ...] = ()
    failures: tuple[str, ...] = ()
    risk: float = 0.05

    def __post_init__(self) -> None:
        if self.stacks is not None and not 0 <= self.stacks[0] <= self.stacks[1] != 0:
            raise ValueError(f"stacks {self.stacks}, but must be those that fall, of at least one.")
        if not 0 < self.risk < 0.5:
            raise ValueError(f"risk {self.risk}, but must be above 0 and below 0.5.")

    @property
    def runs(self) -> int:
        """Runs of contact dynamics."""
        return self.stacks[1] if self.stacks else 0

    @property
    def slides_throughout(self) -> bool:
        """Whether every crack that counts slides before it lifts, and the motion reaches so far."""
        return not math.isnan(self.slides_at) and all(crack.slides for crack in self.counting)

    @property
    def counting(self) -> tuple[CrackFacts, ...]:
        """The cracks that count, and of them those that lift before they slide, where there are any."""
        counting = tuple(crack for crack in self.cracks if crack.counts)
        return tuple(crack for crack in counting if not crack.slides) or counting

    @property
    def followed(self) -> tuple[CrackFacts, ...]:
        """Those of them that have members."""
        return tuple(crack for crack in self.counting if crack.members)

    @property
    def governing(self) -> CrackFacts | None:
        """The worst crack of them; the first among equals, None without members."""
        return max(self.followed, key=lambda crack: crack.severity(self.risk), default=None)


@dataclass(frozen=True)
class Decision:
    """The fate of a structure, as every table and report prints it.

    Parameters
    ----------
    verdict : Verdict
        The verdict.
    share : float
        Largest share that overturns, among the members of the cracks and the stacks that make the verdict; of a
        single run 0 or 1, nan where none can be said.
    interval : tuple of (float, float)
        Interval of the share, from the first crack to the worst, with what failed or is not known; nan where
        nothing is known.
    why : str
        The reason, in words.
    warnings : tuple of RockingWarning, optional
        What may make it worse than said.
    would_settle : tuple of RockingWarning, optional
        What would tell more.
    other_model : RockingWarning or None, default None
        How many fall by the model that does not make the share: contact dynamics, or the mechanism.

    Examples
    --------
    >>> decision = rocking.Decision(rocking.Verdict.UNCERTAIN, 0.5, (0.5, 0.5), "32 of 64 members overturn")
    >>> print(decision.verdict, decision.share)
    uncertain 0.5
    """

    verdict: Verdict
    share: float
    interval: tuple[float, float]
    why: str
    warnings: tuple[RockingWarning, ...] = ()
    would_settle: tuple[RockingWarning, ...] = ()
    other_model: RockingWarning | None = None

    @property
    def warning(self) -> RockingWarning | None:
        """How many fall by the other model, else what would say more of a verdict not sure, else what may make it
        worse; None without any.
        """
        first = (self.other_model,) if self.other_model else ()
        would_settle = () if self.verdict.is_sure else self.would_settle
        return next(iter((*first, *would_settle, *self.warnings)), None)

    @property
    def share_in_words(self) -> str:
        """The share as it is printed: "31 %", "0–100 %", "at least 31 %", "one run"; "" where nothing is known."""
        low, high = self.interval
        if math.isnan(low) or self.verdict is Verdict.CANNOT_OVERTURN:
            return ""
        one_run = any(warning.kind is AssessmentKind.ENSEMBLE for warning in self.would_settle)
        if one_run and low == high and self.verdict.badness <= Verdict.UNCERTAIN.badness:
            return ONE_RUN  # but not where stacks add to it, or say worse
        if self._is_a_least_share:
            return f"at least {percents(low)}" if low else ""
        return percents(low, high)

    @property
    def odds(self) -> str:
        """The share in tenths, where it is neither about 0 nor about 1 nor a range: "3 in 10 fall"; else ""."""
        low, high = self.interval
        tenths = 0 if math.isnan(low) or low != high or self.share_in_words == ONE_RUN else round(10 * low)
        return f"{tenths} in 10 fall" if 0 < tenths < 10 else ""

    @property
    def share_in_a_cell(self) -> str:
        """The share as a cell with little room prints it: "≥ 31 %" where it is only the least."""
        if self._is_a_least_share and self.share_in_words:
            return f"≥ {percents(self.interval[0])}"
        return self.share_in_words

    @property
    def _is_a_least_share(self) -> bool:
        """Whether only the lower end of the share is known."""
        return math.isnan(self.share) and self.interval[1] == 1


Severity = tuple[int, float, float, float]
"""Key of a case by which the worst of several comes last."""


def severity(decision: Decision, *, factor: float = math.nan, rotation_ratio: float = math.nan) -> Severity:
    """Return the key of a case: its verdict, its share, the smallest reserve, then the largest rotation.

    Every order by what is worst is of this key. factor: on the motion, at which 5 % of the members overturn; nan where
    none is known, which counts as large. rotation_ratio: as recorded.
    """
    share = decision.interval[0] if math.isnan(decision.share) else decision.share
    return (
        decision.verdict.badness,
        -1.0 if math.isnan(share) else share,
        -math.inf if math.isnan(factor) else -factor,
        -1.0 if math.isnan(rotation_ratio) else rotation_ratio,
    )


def worst_first(cases: Iterable[tuple[str, Severity]]) -> list[str]:
    """Return the names, of records or structures, by the worst case of each; of equals the larger sum of shares first.

    cases: their name and key. The first of equals stays first.
    """
    worst: dict[str, Severity] = {}
    shares: dict[str, float] = {}
    for name, key in cases:
        worst[name] = max(key, worst.get(name, key))
        shares[name] = shares.get(name, 0.0) + max(key[1], 0.0)
    return sorted(worst, key=lambda name: (worst[name], shares[name]), reverse=True)


def decide(facts: Facts, limits: Iterable[Limit] = ()) -> Decision:
    """Return the decision on `facts`, and on what evidence sets against them.

    The step of a crack is the verdict of its members (`step`), those that failed counted as falling. The first row of 1
    to 7 whose test holds names the verdict of the mechanisms; rows 8 to 10 make it worse, and never safer.

    ===  ================================================================  =============================================
    row  facts                                                             verdict
    ===  ================================================================  =============================================
    1    no crack that counts can overturn, nothing limits that            cannot overturn
    2    nothing can lift                                                  stands; only what acts at rest limits it
    3    every crack that counts slides before it lifts, and the motion    cannot be told
         reaches so far, and no stones were followed
    4    no result at all                                                  cannot be told
    5    one run: stands up to FAR / else                                  probably stands / uncertain
    6    cracks that count                                                 step of the worst one, but no worse than
                                                                           uncertain where the first (probably) stands,
                                                                           no worse than probably overturns where the
                                                                           first does not overturn; of a held wall the
                                                                           worse of that and the step of its bulge
    7    a crack without one member, or only with the members that failed  cannot be told
         does it (probably) overturn
    8    limits that the runs of contact dynamics do not lift              no safer than each
    9    contact dynamics ran                                              no safer than its step
    10   a limit at which nothing can be told, or a component is missing   cannot be told, unless it falls anyway
    ===  ================================================================  =============================================

    A crack that slides first is left out where another lifts; where its members would make a worse verdict, that is a
    warning with every verdict better than probably overturns.
    A further limit, failure or fall never makes the verdict safer, nor the share smaller. The share is the largest of
    the cracks that count and the stacks, members that failed counted as falling: at it, the members of the crack or
    the stacks that make the verdict have a step no safer than it. The share is of one model, and the mark of the other
    is given next to it. Row 5 and limits are of the verdict, not of the share. Under row 7 the share is empty, and its
    interval reaches from the members that fall to those that fall or failed; under row 10 from the share at least to
    1.
    """
    evidence = list(limits)
    several = sorted(
        [*evidence, *([_MISSING] if facts.failures else [])], key=lambda limit: _PLACES[limit.warning.kind]
    )
    acting = [
        limit for limit in several if facts.runs < limit.lifted_by and (limit.at_rest or not facts.rests)
    ]
    untold = [limit for limit in acting if limit.is_untold]
    limiting = [limit for limit in acting if not limit.is_untold]
    alone, ends = _of_mechanisms(facts, is_limited=any(limit.at_rest for limit in evidence))
    warnings = [*alone.warnings, *(limit.warning for limit in untold)]
    if any(limit.by_contacts for limit in untold) and not facts.stackable:
        warnings.append(RockingWarning(AssessmentKind.NO_STACK))
    if ends:
        return replace(alone, warnings=_in_order(warnings))

    if facts.stacks is not None:
        alone = _with_stacks(facts, alone)
    why = alone.why
    share = alone.share
    interval = alone.interval
    if alone.verdict is Verdict.OVERTURNS:
        return replace(alone, warnings=_in_order(warnings), would_settle=())
    # 8
    verdict = worse(alone.verdict, *(limit.at_best for limit in limiting))
    warnings += [limit.warning for limit in limiting]
    would_settle = (*alone.would_settle, *_settling(facts, limiting))
    # 9
    if facts.stacks is not None:
        fallen, runs = facts.stacks
        of_stacks = step(falls=fallen, members=runs, risk=facts.risk)
        if of_stacks.badness > verdict.badness and runs < UNANIMOUS and not fallen:
            # More runs of which none falls would say more.
            would_settle = (*would_settle, RockingWarning(AssessmentKind.CONTACT_DYNAMICS))
        verdict = worse(verdict, of_stacks)
    # 10: a mechanism that stands says nothing of what it does not follow.
    if verdict.badness < Verdict.PROBABLY_OVERTURNS.badness:
        warnings += _left_out(facts)
        if untold:
            verdict = Verdict.CANNOT_BE_TOLD
            interval = interval[0], 1.0
            not_followed = [str(limit.warning) for limit in untold if limit is not _MISSING]
            why = "; ".join([*not_followed, *facts.failures, why])
            would_settle = _settling(facts, untold)
    return Decision(
        verdict,
        math.nan if verdict is Verdict.CANNOT_BE_TOLD else share,
        interval,
        why,
        _in_order(warnings),
        would_settle,
        other_model=alone.other_model,
    )


def _with_stacks(facts: Facts, alone: Decision) -> Decision:
    """The decision on the mechanisms with the larger share of both models, and the count of the other one."""
    assert facts.stacks is not None
    fallen, runs = facts.stacks
    followed_as = f"runs {facts.as_stones}" if facts.as_stones else "stacks of courses"
    counted = f"{fallen} of {runs} {followed_as} fall in contact dynamics"
    share = fallen / runs
    members = facts.governing.count if facts.governing else f"{alone.share:.0f} of 1"
    other_model = None
    if share < alone.share:
        other_model = RockingWarning.of(AssessmentKind.STACKS_FALL, falls=fallen, runs=runs)
    elif share > alone.share:
        other_model = RockingWarning.of(AssessmentKind.MECHANISM_FALLS, members=members)
    why = f"{alone.why}; {counted}"
    largest = max(share, alone.share)
    interval = alone.interval if largest == alone.share else (share, share)
    return replace(alone, share=largest, interval=interval, why=why, other_model=other_model)


def _settling(facts: Facts, limits: Sequence[Limit]) -> tuple[RockingWarning, ...]:
    """What would tell more of what limits a verdict: first contact dynamics, where it can follow it and has not."""
    asked = facts.stackable and facts.stacks is None and any(limit.by_contacts for limit in limits)
    contact_dynamics = [RockingWarning(AssessmentKind.CONTACT_DYNAMICS)] if asked else []
    return (*contact_dynamics, *(warning for limit in limits for warning in limit.settles))


def _in_order(warnings: Iterable[RockingWarning]) -> tuple[RockingWarning, ...]:
    """The warnings in the order in which their kinds are declared."""
    return tuple(sorted(warnings, key=lambda warning: _PLACES[warning.kind]))


def _left_out(facts: Facts) -> tuple[RockingWarning, ...]:
    """That a crack that slides first was left out, whose members would make a worse verdict."""
    return (RockingWarning(AssessmentKind.SLIDES_FIRST),) if _worse_left_out(facts) else ()


def _of_mechanisms(facts: Facts, *, is_limited: bool) -> tuple[Decision, bool]:
    """Rows 1 to 7: the decision on the mechanisms, and whether nothing can make it worse.

    is_limited: whether anything acts against what cannot overturn.
    """
    worse_other = _worse_than_known(facts)
    warnings = (RockingWarning(AssessmentKind.OTHER_CRACK_WORSE),) if worse_other else ()
    unknown = math.nan, math.nan
    would_settle: tuple[RockingWarning, ...]
    # 1, 2, 3: what follows without any member.
    if facts.never_overturns_because and not is_limited:
        why = facts.never_overturns_because
        would_settle = (RockingWarning(AssessmentKind.TIE_STRENGTH),)
        warnings = (*warnings, *_left_out(facts))
        return Decision(Verdict.CANNOT_OVERTURN, 0.0, (0.0, 0.0), why, warnings, would_settle), True
    if facts.rests:
        why = "the ground never reaches the uplift acceleration"
        return Decision(Verdict.STANDS, 0.0, (0.0, 0.0), why, warnings), False
    sliding = ""
    if facts.slides_throughout:
        at = f"slides before it lifts, at {facts.slides_at:.2g} g"
        sliding = at if facts.slides_at else "slides apart at rest"
    if sliding and not (facts.as_stones and facts.stacks):
        by_stones = facts.as_stones and facts.stackable and facts.stacks is None
        would_settle = (RockingWarning(AssessmentKind.FRICTION),)
        would_settle += (RockingWarning(AssessmentKind.CONTACT_DYNAMICS),) if by_stones else ()
        return Decision(Verdict.CANNOT_BE_TOLD, math.nan, unknown, sliding, warnings, would_settle), True
    if facts.governing is not None:
        of_members = _of_members(facts, facts.governing, worse_other)
        why = f"{sliding}; {of_members.why}" if sliding else of_members.why
        return replace(of_members, why=why, warnings=(*warnings, *of_members.warnings)), False
    if math.isnan(facts.run_ratio):  # 4
        why = "; ".join(facts.failures) or "no component gave a result"
        would_settle = (RockingWarning(AssessmentKind.INPUT),)
        return Decision(Verdict.CANNOT_BE_TOLD, math.nan, unknown, why, warnings, would_settle), True
    # 5: one run, whose scatter nobody knows.
    verdict = Verdict.PROBABLY_STANDS if facts.run_ratio <= FAR else Verdict.UNCERTAIN
    share = float(facts.run_ratio == math.inf)
    why = "one run as recorded, without an ensemble"
    would_settle = (RockingWarning(AssessmentKind.ENSEMBLE),)
    return Decision(
        verdict, share, (share, share), f"{sliding}; {why}" if sliding else why, warnings, would_settle
    ), False


def _of_members(facts: Facts, governing: CrackFacts, worse_other: CrackFacts | None) -> Decision:
    """Rows 6 and 7: the worst crack; statics' own keeps a verdict in it."""
    followed = facts.followed
    verdict = _envelope((crack, crack.step(facts.risk)) for crack in followed)
    would_settle = facts.settling
    # Not that of the worst step: by their error fewer members may have the worse verdict and the smaller share.
    share = max(crack.share for crack in followed)
    why = _counted(facts, worse_other)
    left_out = _worse_left_out(facts)
    if left_out is not None:
        would = f"the {left_out.name} would overturn {left_out.count}"
        why = f"{why}; {would} if it did not slide first, at {left_out.slides_at:.2g} g"
    if facts.top is not None:
        why = f"{why}; {facts.top.brief}"
        would_settle = (*would_settle, RockingWarning(AssessmentKind.TIE_THE_TOP))
    of_part = [crack for crack in followed if crack.part == governing.part]
    first = next((crack for crack in of_part if not crack.bulges), governing)
    disagree = not governing.bulges and governing.step(facts.risk) is not first.step(facts.risk)
    ends = {governing, first} if disagree else {governing}
    interval = min(crack.falls / crack.members for crack in ends), share
    # 7: failed members count as falling, but alone they make nothing fall.
    falls_without = _envelope((crack, crack.step_of_followed(facts.risk)) for crack in followed)
    open_ = verdict.badness >= Verdict.PROBABLY_OVERTURNS.badness or not all(
        crack.followed for crack in followed
    )
    if open_ and falls_without.badness < Verdict.PROBABLY_OVERTURNS.badness:
        verdict = Verdict.CANNOT_BE_TOLD
        would_settle = (RockingWarning(AssessmentKind.TOLERANCE),)
    failed = (
        (RockingWarning(AssessmentKind.MEMBERS_FAILED),) if any(crack.failed for crack in followed) else ()
    )
    return Decision(verdict, share, interval, why, failed, would_settle)


def may_change(facts: Facts, crack: CrackFacts) -> bool:
    """Return whether the verdict of the cracks may get worse by the error of the share of one of them."""
    if not crack.is_near_an_edge(facts.risk):
        return False
    steps = [(other, other.step(facts.risk)) for other in facts.followed]
    at_worst = [
        (other, other.step_at_worst(facts.risk) if other is crack else verdict) for other, verdict in steps
    ]
    return _envelope(at_worst).badness > _envelope(steps).badness


def _envelope(of_cracks: Iterable[tuple[CrackFacts, Verdict]]) -> Verdict:
    """The verdict of all that may form: the worst of its parts, each of which falls by itself."""
    of_parts: dict[str, list[tuple[CrackFacts, Verdict]]] = {}
    for crack, verdict in of_cracks:
        of_parts.setdefault(crack.part, []).append((crack, verdict))
    return worse(*map(_envelope_of_part, of_parts.values()))


def _envelope_of_part(each_with_verdict: Sequence[tuple[CrackFacts, Verdict]]) -> Verdict:
    """The verdict of one part: of the cracks only one opens, but a held wall may bulge with any of them."""
    of_bulges = [verdict for crack, verdict in each_with_verdict if crack.bulges]
    of_cracks = [verdict for crack, verdict in each_with_verdict if not crack.bulges]
    if not of_cracks:
        return worse(Verdict.STANDS, *of_bulges)
    # The one that statics chooses comes first, which is the likeliest to form: others limit its verdict, no more.
    worst = worse(*of_cracks)
    if of_cracks[0] in (Verdict.STANDS, Verdict.PROBABLY_STANDS):
        worst = better(worst, Verdict.UNCERTAIN)
    elif of_cracks[0] is not Verdict.OVERTURNS:
        worst = better(worst, Verdict.PROBABLY_OVERTURNS)
    return worse(worst, *of_bulges)


def _worse_than_known(facts: Facts) -> CrackFacts | None:
    """The worst crack other than the known one, where its verdict is worse."""
    return _worse(facts, (crack for crack in facts.cracks if not crack.counts and not crack.slides))


def _worse_left_out(facts: Facts) -> CrackFacts | None:
    """The worst crack that slides first where another lifts, where its verdict would be worse."""
    return _worse(facts, (crack for crack in facts.cracks if crack.counts and crack.slides))


def _worse(facts: Facts, others: Iterable[CrackFacts]) -> CrackFacts | None:
    """The worst of others than make the verdict, where its own is worse than that of the crack that governs."""
    with_members = (crack for crack in others if crack.members)
    worst = max(with_members, key=lambda crack: crack.severity(facts.risk), default=None)
    if worst is None or facts.governing is None:
        return None
    is_worse = worst.step(facts.risk).badness > facts.governing.step(facts.risk).badness
    return worst if is_worse else None


def _counted(facts: Facts, worse_other: CrackFacts | None) -> str:
    """The count of members that overturn, and with which crack."""
    governing = facts.governing
    assert governing is not None
    first = facts.followed[0]
    with_crack = f" with the {governing.name}" if governing.name else ""
    words = f"{governing.count} members overturn{with_crack}"
    if worse_other is not None:
        words += f", the known crack; with the {worse_other.name} {worse_other.count} would"
    elif governing is not first:
        words += f", {first.count} with the {first.name} of statics"
    if governing.failed:
        words += f"; {governing.failed} could not be followed"
    return words
