"""The decision: what becomes of a structure under a motion, with all uncertain inputs considered.

`decide` is the only place where a verdict is decided. It is given facts alone, and what it returns is what every table,
report and line prints: a word, the share behind it and its interval, the reason, what is doubtful and what would tell
more.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass
from enum import StrEnum

from rocking.assessment.kinds import AssessmentKind
from rocking.quantities import percents
from rocking.remarks import Kind, Remark

UNANIMOUS = 64
"""Members of which none overturns, or none stands, that settle a verdict."""
FAR = 0.3
"""Rotation ratio that fewer members must all stay below to settle that the structure stands."""
LATTICE_ERROR = 4.0
"""Members times the error of a probability that all but few cases stay below; `calibrate_ensemble` counts them."""
BEYOND = 0.4
"""Share of the critical rotation beyond which a chain of a held wall may fall though its mechanism stands (theory:
section on ties)."""


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


def worse(*words: Verdict) -> Verdict:
    """Return the worst of several verdicts."""
    return max(words, key=lambda word: word.badness)


def better(*words: Verdict) -> Verdict:
    """Return the safest of several verdicts."""
    return min(words, key=lambda word: word.badness)


def share_error(*, falls: int, members: int, farthest: float = math.inf) -> float:
    """Return the most by which the share of `members` that fall differs from that of very many.

    It is inversely proportional to the number of members, not to its root, because they are points of a lattice. It
    counts as none where UNANIMOUS members or more agree, or where fewer all stay FAR from overturning. farthest:
    largest rotation ratio.
    """
    many_agree = members >= UNANIMOUS and falls in (0, members)
    return 0.0 if many_agree or farthest <= FAR else LATTICE_ERROR / max(members, 1)


def step(*, falls: int, members: int, farthest: float = math.inf, risk: float = 0.05) -> Verdict:
    """Return the word of `members` of which `falls` overturn: where the error counts, it counts on the unsafe side.

    risk: largest probability of the opposite outcome.

    >>> [str(step(falls, 64)) for falls in (0, 1, 20, 41, 64)]
    ['stands', 'probably stands', 'uncertain', 'probably overturns', 'overturns']
    """
    error = (
        share_error(falls=falls, members=members, farthest=farthest) * members
    )  # in members, so that no edge hangs on rounding
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
    could not be followed. farthest: largest rotation ratio of those followed; nan without any. slides: whether its
    joint slides before it lifts, under a motion that reaches so far. counts: whether it takes part in the word;
    otherwise it is reported along with the known crack. bulges: whether it is the bulge of a held wall, which may
    form wherever that is cracked. part: the leaf that falls alone, "" of the whole structure. Raises ValueError.
    """

    name: str
    falls: int
    followed: int
    failed: int = 0
    farthest: float = math.nan
    _: KW_ONLY
    slides: bool = False
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
        """Return the word of its members, those that failed counted as falling."""
        return step(
            falls=self.falls + self.failed,
            members=self.members,
            farthest=self.farthest if not self.failed else math.inf,
            risk=risk,
        )

    def is_near_an_edge(self, risk: float) -> bool:
        """Whether one of the four edges between words lies within the error, so that more members may change it."""
        error = share_error(
            falls=self.falls + self.failed,
            members=self.members,
            farthest=math.inf if self.failed else self.farthest,
        )
        edges = risk, 1 / 3, 2 / 3, 1 - risk  # those of `step`
        return error > 0 and any(abs(self.share - edge) <= error for edge in edges)

    def step_of_followed(self, risk: float) -> Verdict:
        """Return the word of those that were followed alone.

        Where members failed, so few falls that the error of the share holds them all bear out no word of falling.
        """
        if not self.followed:
            return Verdict.UNCERTAIN
        word = step(falls=self.falls, members=self.followed, farthest=self.farthest, risk=risk)
        return better(word, Verdict.UNCERTAIN) if self.failed and self.falls <= LATTICE_ERROR else word

    def severity(self, risk: float) -> tuple[int, float, float]:
        """Key by which the worst of several comes last: the word, the share that overturns, then the rotation."""
        farthest = -1.0 if math.isnan(self.farthest) else self.farthest
        return self.step(risk).badness, -1.0 if math.isnan(self.share) else self.share, farthest


CONTACTS = (
    AssessmentKind.CONTACTS_OPEN,
    AssessmentKind.COURSES_THROWN,
    AssessmentKind.IMPACT_OPENS,
    AssessmentKind.NOT_FOLLOWED,
)
"""Doubts that contact dynamics settles."""


@dataclass(frozen=True, kw_only=True)
class Facts:
    """The facts that are known of one structure under one motion.

    cracks: those that were followed, first the one that is known or that statics chooses. rests: whether nothing can
    lift. run_ratio: largest rotation ratio of single runs, where no members were followed; nan without one.
    never_overturns_because: why no motion can overturn it with a crack that counts; "" where one can. slides_at: the
    least acceleration [g] at which the joints of a crack that counts slide before it lifts, where the motion reaches
    it; else nan. friction_needed: the coefficient that a contact needs while it rocks, where it has less; else nan.
    doubts: what one degree of freedom does not follow. held: whether it is a wall that is held above its foot, and
    beyond: HELD_BEYOND where some chain of it goes beyond BEYOND of its critical rotation in any member, TIES_GIVE
    where only one that its ties hold does, under the motion that these let through. anchors_slide: whether the motion
    reaches the acceleration at which what the anchor of a tie grips slides out, which neither mechanisms nor stacks
    follow. top: what its top needs and does not get, so that it slips; None where it holds, or there is none. stacks:
    stacks of courses that fall in contact dynamics, of how many; None where none was followed. as_stones: as what chain
    of stones it is followed then, "as voussoirs"; "" where as a stack of courses. needs_stones: whether only its stones
    may say that it stands. stackable: whether contact dynamics can follow it and has not done so yet. remarks: what
    would reduce the disagreement of the members. failures: why components gave no result. risk: largest probability of
    the outcome opposite to "stands" or "overturns". Raises ValueError.
    """

    cracks: tuple[CrackFacts, ...] = ()
    rests: bool = False
    run_ratio: float = math.nan
    never_overturns_because: str = ""
    slides_at: float = math.nan
    friction_needed: float = math.nan
    doubts: tuple[Remark, ...] = ()
    held: bool = False
    beyond: Kind | None = None
    anchors_slide: bool = False
    top: Remark | None = None
    stacks: tuple[int, int] | None = None
    as_stones: str = ""
    needs_stones: bool = False
    stackable: bool = True
    remarks: tuple[Remark, ...] = ()
    failures: tuple[str, ...] = ()
    risk: float = 0.05

    def __post_init__(self) -> None:
        if self.stacks is not None and not 0 <= self.stacks[0] <= self.stacks[1] != 0:
            raise ValueError(f"stacks {self.stacks}, but must be those that fall, of at least one.")
        if odd := [str(doubt.kind) for doubt in self.doubts if doubt.kind not in CONTACTS]:
            raise ValueError(f"doubts {odd}, but must be of {[str(kind) for kind in CONTACTS]}.")
        if not 0 < self.risk < 0.5:
            raise ValueError(f"risk {self.risk}, but must be above 0 and below 0.5.")

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
    word : Verdict
        The verdict.
    share : float
        Largest share that overturns, among the members of the cracks and the stacks that make the word; of a
        single run 0 or 1, nan where none can be said.
    interval : tuple of (float, float)
        Interval of the share, from the first crack to the worst, with what failed or is not known; nan where
        nothing is known.
    why : str
        The reason, in words.
    doubts : tuple of Remark, optional
        What may make it worse than said.
    would_settle : tuple of Remark, optional
        What would tell more.

    Examples
    --------
    >>> decision = rocking.Decision(rocking.Verdict.UNCERTAIN, 0.5, (0.5, 0.5), "32 of 64 members overturn")
    >>> print(decision.word, decision.share)
    uncertain 0.5
    """

    word: Verdict
    share: float
    interval: tuple[float, float]
    why: str
    doubts: tuple[Remark, ...] = ()
    would_settle: tuple[Remark, ...] = ()

    @property
    def share_in_words(self) -> str:
        """The share as it is printed: "31 %", "0–100 %", "at least 31 %", "one run"; "" where nothing is known."""
        low, high = self.interval
        if math.isnan(low) or self.word is Verdict.CANNOT_OVERTURN:
            return ""
        one_run = any(remark.kind is AssessmentKind.ENSEMBLE for remark in self.would_settle)
        if one_run and low == high and self.word.badness <= Verdict.UNCERTAIN.badness:
            return "one run"  # but not where stacks add to it, or say worse
        if self._is_a_least_share:
            return f"at least {percents(low)}" if low else ""
        return percents(low, high)

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

    @property
    def share_low(self) -> float:
        """The lower end of the interval of the share."""
        return self.interval[0]

    @property
    def share_high(self) -> float:
        """Its upper end."""
        return self.interval[1]


Severity = tuple[int, float, float, float]
"""Key of a case by which the worst of several comes last."""


def severity(decision: Decision, *, factor: float = math.nan, rotation_ratio: float = math.nan) -> Severity:
    """Return the key of a case: its word, its share, the smallest reserve, then the largest rotation.

    Every order by what is worst is of this key. factor: on the motion, at which 5 % of the members overturn; nan where
    none is known, which counts as large. rotation_ratio: as recorded.
    """
    share = decision.interval[0] if math.isnan(decision.share) else decision.share
    return (
        decision.word.badness,
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


def decide(facts: Facts) -> Decision:
    """Return the decision on `facts`.

    The step of a crack is the word of its members (`step`), those that failed counted as falling. The first row whose
    test holds ends, but for rows 5 to 7, which name a step, and rows 8b and 9, which limit it.

    ===  ================================================================  =============================================
    row  facts                                                             word
    ===  ================================================================  =============================================
    1    no crack that counts can overturn, no doubt                       cannot overturn
    2    nothing can lift, and its ties do not give                        stands; probably stands where the anchor of
                                                                           a tie slides out
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
    8    the step is overturns                                             overturns
    8b   a held wall some chain of which goes beyond BEYOND, as the        no safer than probably stands
         motion comes or as its ties let it through; or a contact that
         needs more friction than it has while it rocks; and fewer than
         UNANIMOUS runs of contact dynamics, which are on that friction;
         or an arch on piers that was not followed as stones; or the
         anchor of a tie that slides out, which no stack follows
    9    contact dynamics ran                                              the worse of its step and that of the members
    10   contacts open, an impact may open them or courses may be thrown   cannot be told
         and contact dynamics did not run, or a component is missing; and
         it does not (probably) overturn
    11   else                                                              the step
    ===  ================================================================  =============================================

    A crack that slides first and is left out is reported as a doubt with every word better than probably overturns.
    A further doubt, failure or fall never makes the word safer, nor the share smaller. The share is the largest among
    the cracks that count and the stacks, members that failed counted as falling: at it, the members of the crack or the
    stacks that make the word have a step no safer than the word. Rows 5 and 8b and doubts limit the word, not the
    share. Under row 7 the share is empty, and its interval reaches from the members that fall to those that fall or
    failed; under row 10 from the share at least to 1.
    """
    risk = facts.risk
    followed = facts.followed
    governing = facts.governing
    unsettled = facts.doubts if facts.stacks is None else ()
    missing = (Remark(AssessmentKind.COMPONENT_MISSING),) if facts.failures else ()
    worse_other = _worse_than_known(facts)
    doubts = (*unsettled, *missing, *([Remark(AssessmentKind.OTHER_CRACK_WORSE)] if worse_other else []))
    sliding = _slides_throughout(facts)
    none_left = sliding and not facts.rests
    left_out = () if none_left or math.isnan(facts.slides_at) else (Remark(AssessmentKind.SLIDES_FIRST),)
    asks_for_stacks = facts.stackable and facts.stacks is None
    contact_dynamics = (Remark(AssessmentKind.CONTACT_DYNAMICS),) if asks_for_stacks else ()
    if unsettled and not facts.stackable:
        doubts = (*doubts, Remark(AssessmentKind.NO_STACK))
    would_settle: tuple[Remark, ...]

    # 1, 2, 3: what follows without any member.
    if facts.never_overturns_because and not facts.doubts and not facts.anchors_slide:
        would_settle = (Remark(AssessmentKind.TIE_STRENGTH),)
        return Decision(
            Verdict.CANNOT_OVERTURN,
            0.0,
            (0.0, 0.0),
            facts.never_overturns_because,
            (*doubts, *left_out),
            would_settle,
        )
    # What swings on ties that give may fall though its mechanism, which takes them as rigid, rests: rows 8b and 9.
    if facts.rests and facts.beyond is not AssessmentKind.TIES_GIVE:
        why = "the ground never reaches the uplift acceleration"
        if facts.anchors_slide:
            doubts = (*doubts, Remark(AssessmentKind.ANCHOR_GIVES))
        word = Verdict.PROBABLY_STANDS if facts.anchors_slide else Verdict.STANDS
        would_settle = (Remark(AssessmentKind.ANCHORS),) if facts.anchors_slide else ()
        return Decision(word, 0.0, (0.0, 0.0), why, (*doubts, *left_out), would_settle)
    if sliding and not (facts.as_stones and facts.stacks):
        would_settle = (Remark(AssessmentKind.FRICTION), *(contact_dynamics if facts.as_stones else ()))
        return Decision(Verdict.CANNOT_BE_TOLD, math.nan, (math.nan, math.nan), sliding, doubts, would_settle)

    # 4
    if governing is None and math.isnan(facts.run_ratio):
        why = "; ".join(facts.failures) or "no component gave a result"
        would_settle = (Remark(AssessmentKind.INPUT),)
        return Decision(Verdict.CANNOT_BE_TOLD, math.nan, (math.nan, math.nan), why, doubts, would_settle)

    if governing is None:
        # 5: one run, whose scatter nobody knows.
        word = Verdict.PROBABLY_STANDS if facts.run_ratio <= FAR else Verdict.UNCERTAIN
        why = "one run as recorded, without an ensemble"
        would_settle = (Remark(AssessmentKind.ENSEMBLE),)
        share = float(facts.run_ratio == math.inf)
        interval = share, share
    else:
        # 6: the worst crack; statics' own keeps a word in it.
        word = _envelope((crack, crack.step(risk)) for crack in followed)
        would_settle = facts.remarks
        # Not that of the worst step: by their error fewer members may have the worse word and the smaller share.
        share = max(crack.share for crack in followed)
        why = _counted(facts, worse_other)
        if left_out:
            why = f"{why}; another crack slides first, at {facts.slides_at:.2g} g"
        if facts.top is not None:
            why = f"{why}; {facts.top.brief}"
            would_settle = (*would_settle, Remark(AssessmentKind.TIE_THE_TOP))
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
            would_settle = (Remark(AssessmentKind.TOLERANCE),)
        if any(crack.failed for crack in followed):
            doubts = (*doubts, Remark(AssessmentKind.MEMBERS_FAILED))

    if sliding:
        why = f"{sliding}; {why}"
    if facts.stacks is not None:
        fallen, runs = facts.stacks
        followed_as = f"runs {facts.as_stones}" if facts.as_stones else "stacks of courses"
        why = f"{why}; {fallen} of {runs} {followed_as} fall in contact dynamics"
        share = max(share, fallen / runs)
        interval = interval[0], share

    # 8
    if word is Verdict.OVERTURNS:
        return Decision(word, share, interval, why, doubts)
    # 8b, 9: what bounds the step of the mechanism.
    limits = [Remark(facts.beyond)] if facts.held and facts.beyond else []
    slides = not math.isnan(facts.friction_needed)
    if slides:
        limits.append(Remark(AssessmentKind.FRICTION_SHORT))
    if facts.needs_stones and facts.stacks is None:
        limits.append(Remark(AssessmentKind.STONES_TELL))
    if limits and (facts.stacks is None or facts.stacks[1] < UNANIMOUS):
        word = worse(word, Verdict.PROBABLY_STANDS)
        doubts = (*doubts, *limits)
        would_settle = (
            *would_settle,
            *contact_dynamics,
            *([Remark(AssessmentKind.FRICTION)] if slides else []),
        )
    if facts.anchors_slide:
        word = worse(word, Verdict.PROBABLY_STANDS)
        doubts = (*doubts, Remark(AssessmentKind.ANCHOR_GIVES))
        would_settle = (*would_settle, Remark(AssessmentKind.ANCHORS))
    if facts.stacks is not None:
        of_stacks = step(falls=fallen, members=runs, risk=risk)
        if of_stacks.badness > word.badness and runs < UNANIMOUS and not fallen:
            would_settle = (
                *would_settle,
                Remark(AssessmentKind.CONTACT_DYNAMICS),
            )  # more runs of which none falls would say more
        if of_stacks is not word:
            interval = min(interval[0], fallen / runs), interval[1]
        word = worse(word, of_stacks)
    if word.badness < Verdict.PROBABLY_OVERTURNS.badness:
        doubts = (*doubts, *left_out)
    # 10: a mechanism that stands says nothing of what it does not follow.
    if (unsettled or missing) and word.badness < Verdict.PROBABLY_OVERTURNS.badness:
        reasons = [*map(str, unsettled), *facts.failures]
        would_settle = contact_dynamics if unsettled else ()
        would_settle += (Remark(AssessmentKind.COMPONENT),) if missing else ()
        at_least = interval[0], 1.0
        return Decision(
            Verdict.CANNOT_BE_TOLD, math.nan, at_least, "; ".join([*reasons, why]), doubts, would_settle
        )
    # 11
    printed = math.nan if word is Verdict.CANNOT_BE_TOLD else share
    return Decision(word, printed, interval, why, doubts, would_settle)


def _slides_throughout(facts: Facts) -> str:
    """Where every crack that counts slides before it lifts, and the motion reaches so far, in words; else ""."""
    if math.isnan(facts.slides_at) or not all(crack.slides for crack in facts.counting):
        return ""
    return (
        f"slides before it lifts, at {facts.slides_at:.2g} g" if facts.slides_at else "slides apart at rest"
    )


def _envelope(words: Iterable[tuple[CrackFacts, Verdict]]) -> Verdict:
    """The word of all that may form: the worst of its parts, each of which falls by itself."""
    of_parts: dict[str, list[tuple[CrackFacts, Verdict]]] = {}
    for crack, word in words:
        of_parts.setdefault(crack.part, []).append((crack, word))
    return worse(*map(_envelope_of_part, of_parts.values()))


def _envelope_of_part(each_with_word: Sequence[tuple[CrackFacts, Verdict]]) -> Verdict:
    """The word of one part: of the cracks only one opens, but a held wall may bulge with any of them."""
    of_bulges = [word for crack, word in each_with_word if crack.bulges]
    of_cracks = [word for crack, word in each_with_word if not crack.bulges]
    if not of_cracks:
        return worse(Verdict.STANDS, *of_bulges)
    # The one that statics chooses comes first, which is the likeliest to form: others limit its word, no more.
    worst = worse(*of_cracks)
    if of_cracks[0] in (Verdict.STANDS, Verdict.PROBABLY_STANDS):
        worst = better(worst, Verdict.UNCERTAIN)
    elif of_cracks[0] is not Verdict.OVERTURNS:
        worst = better(worst, Verdict.PROBABLY_OVERTURNS)
    return worse(worst, *of_bulges)


def _worse_than_known(facts: Facts) -> CrackFacts | None:
    """The worst crack other than the known one, where its word is worse."""
    others = [crack for crack in facts.cracks if not crack.counts and crack.members and not crack.slides]
    worst = max(others, key=lambda crack: crack.severity(facts.risk), default=None)
    if worst is None or facts.governing is None:
        return None
    if worst.step(facts.risk).badness <= facts.governing.step(facts.risk).badness:
        return None
    return worst


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
