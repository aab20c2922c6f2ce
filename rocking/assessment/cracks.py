"""Cracks: the mechanisms of a structure that may form, the ensemble of each that is followed, which one governs, and
what decides where members disagree.

Overturning is 1 or 0 of each member. What explains a share of its variance decides so much of the outcome: who knew it
would know by so much more whether the structure falls. A share is that of an analysis of variance with one factor, less
what as many groups would explain by accident (ε², Kelley 1935). The rest lies in causes together: outcomes of a rocking
body flip between neighbouring values of several inputs, and no single one decides.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property, lru_cache, partial

import numpy as np

from rocking.assessment.decide import CrackFacts, Facts, Verdict, may_change
from rocking.assessment.ensemble import CAUSES, Ensemble, Origin, design, drawn, ensemble, grown
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.motion.response import lifting_friction
from rocking.motion.table import table_of
from rocking.structures import Structure
from rocking.structures.crackable import crushing
from rocking.structures.structure import CRACKS, Candidate, Mechanisms
from rocking.warnings import RockingWarning

_SEATS = 65
"""Rotations up to the critical one at which it is asked how far floors have moved, with lines between them."""
IN_DOUBT = 0.3
"""Rotation ratio of a member beyond which it is in doubt that a mechanism other than that of statics stands."""
FAR_FROM_DOUBT = IN_DOUBT / 2
"""Rotation ratio of its equivalent block up to which a mechanism is not followed itself, which saves its table: half of
what is in doubt, as a mechanism may rotate more than its block."""


@dataclass(frozen=True, eq=False)
class FollowedCrack:
    """What following one candidate under the motions found, without the structure, so that it can be kept in a file.

    description, position [m], counts, bulges, of_geometry, part: as of `Candidate`. slides_at: acceleration [g] at
    which it slides before it lifts, under a motion that reaches so far; nan of one that lifts.
    """

    description: str
    position: float
    ensemble: Ensemble
    _: KW_ONLY
    slides_at: float = math.nan
    counts: bool = True
    bulges: bool = False
    of_geometry: bool = False
    part: str = ""

    @classmethod
    def of(cls, candidate: Candidate, ensemble: Ensemble, *, slides: bool) -> "FollowedCrack":
        """Return what the ensemble of a candidate found of it. slides: whether the motion lets it slide first."""
        return cls(
            candidate.description,
            candidate.position,
            ensemble,
            slides_at=slides_at(candidate) if slides else math.nan,
            counts=candidate.counts,
            bulges=candidate.bulges,
            of_geometry=candidate.of_geometry,
            part=candidate.part,
        )

    @cached_property
    def facts(self) -> CrackFacts:
        """The facts of it from which the decision follows."""
        of_members = self.ensemble.facts(self.description)
        return replace(
            of_members,
            slides_at=self.slides_at,
            counts=self.counts,
            bulges=self.bulges,
            part=self.part,
        )


@dataclass(frozen=True, eq=False)
class CrackEnsembles:
    """The ensemble of every crack that was followed, the one that is known or that statics chooses first.

    The crack that governs gives every number of the case: the worst of those that count (`decide.Facts`). Along
    with a known crack others are reported, and only the bulge of a held wall counts as it does. left_out: those that
    count, slide before they lift and may not stand, where another lifts: of them only the decision knows.
    """

    followed: tuple[FollowedCrack, ...]
    left_out: tuple[FollowedCrack, ...] = ()

    @cached_property
    def facts(self) -> Facts:
        """The facts of the cracks alone from which the decision follows."""
        risk = self.followed[0].ensemble.settings.risk
        of_each = tuple(crack.facts for crack in (*self.followed, *self.left_out))
        return Facts(cracks=of_each, risk=risk)

    @cached_property
    def governing(self) -> FollowedCrack:
        """The worst crack that counts; that of statics among equals."""
        governing = self.facts.governing
        return self.followed[self.facts.cracks.index(governing) if governing else 0]

    @property
    def deciding(self) -> list[FollowedCrack]:
        """The crack that governs, then those whose own count may still change the verdict."""
        reach = [crack for crack in self.followed if may_change(self.facts, crack.facts)]
        return [self.governing, *reach]

    @property
    def reported_statics(self) -> FollowedCrack | None:
        """The crack reported with the one that governs: that of statics, or the worst but a known one; or None."""
        others = [crack for crack in self.followed if not crack.counts]
        other = max(others, key=lambda crack: crack.facts.severity(self.facts.risk), default=self.followed[0])
        return None if other is self.governing else other


@lru_cache(maxsize=256)
def cracks(structure: Structure) -> Mechanisms:
    """Return the mechanisms that may form; first the one that is known, or that statics chooses.

    Where a restitution is typed far below that of the geometry, the first one comes once more with that of the
    geometry: a typed restitution that dissipates more energy than the geometry implies needs a measurement to be relied
    upon. Those of leaves that may part are those of each leaf; of what is weakest they come first.
    """
    alone = {leaf.name: leaf for leaf in structure.leaves_alone}
    return Mechanisms(
        candidate
        for part, own in structure.candidates(CRACKS).parts.items()
        for candidate in (alone[part].named(cracks(alone[part].structure)) if part else own.with_geometry)
    )


@lru_cache(maxsize=256)
def mechanisms_of(structure: Structure) -> Mechanisms:
    """Return every mechanism: those that may be followed, and behind them those that statics alone lists."""
    forming = cracks(structure)
    listed = (
        candidate
        for candidate in structure.mechanisms()
        if not any(_alike(candidate, own) for own in forming)
    )
    return Mechanisms((*forming, *listed))


def _alike(one: Candidate, other: Candidate) -> bool:
    """Whether two are one mechanism, whose hinge two searches place a little apart."""
    if one.structure is other.structure or one.description == other.description:
        return True
    return not other.refusal and one.is_own_of(other.structure)


@lru_cache(maxsize=256)
def crushing_factor(structure: Structure) -> float | None:
    """Return the static multiplier over that of weak masonry; None of what states its strength or would not stand."""
    crushed = crushing(structure)
    return None if crushed is None else structure.static_multiplier / crushed.static_multiplier


def prepare_structure(structure: Structure, settings: AssessmentSettings, *, vertical: bool) -> None:
    """Let a structure compute what every record needs of it alone: mechanisms, tables, blocks and what crushing does.

    vertical: whether it meets a vertical motion. Raises RockingError as what follows it does.
    """
    forming = cracks(structure)
    for candidate in forming:
        _lifting_friction(candidate.structure)
    for mechanism in (structure.mechanism(), *(candidate.mechanism for candidate in forming)):
        table_of(mechanism, vertical)
        if mechanism.can_overturn:
            table_of(mechanism.equivalent_block(settings.acceleration_scale))
            table_of(mechanism.equivalent_block("uplift"))
    mechanisms_of(structure)
    crushing_factor(structure)


def loses_seat_at(structure: Structure, support_loss: float) -> float:
    """Return the least share of the critical rotation at which it has moved by `support_loss` [m] below a floor.

    inf where it overturns before.
    """
    lost = math.inf
    for side, linkage in zip(structure.mechanism().sides, structure.linkages, strict=False):
        shares = np.linspace(0.0, min(1.0, side.end_rotation / side.critical_rotation), _SEATS)
        moved = linkage.moved_from_bearings(shares * side.critical_rotation)
        place = int(np.argmax(moved >= support_loss))
        if moved[place] >= support_loss:
            ends = slice(place - 1, place + 1)
            lost = min(lost, float(np.interp(support_loss, moved[ends], shares[ends])))
    return lost


def weakest_not_followed(structure: Structure) -> Candidate | None:
    """Return the mechanism of least λ where its motion cannot be followed, and so does not count; None where it can.

    Of a leaf that may part that leaf is asked.
    """
    least = cracks(structure).counting.least_multiplier
    own = structure.mechanisms().of_all
    return next((listed for listed in own if listed.refusal and listed.uplift_multiplier < least), None)


def never_overturns_because(structure: Structure) -> str:
    """Return why no mechanism that counts can overturn, in words; "" where one can, or where that is not known."""
    reasons = [candidate.mechanism.never_overturns_because for candidate in cracks(structure).counting]
    if not all(reasons):
        return ""
    one_can = any(
        candidate.refusal or candidate.mechanism.can_overturn for candidate in structure.mechanisms()
    )
    return "" if one_can else reasons[0]


def crack_named(structure: Structure, description: str) -> Candidate:
    """Return the crack of this description; the first one where none has it, as where only one may form."""
    several = cracks(structure)
    return several.described(description) or several[0]


def cracked(structure: Structure, description: str) -> Structure:
    """Return the structure with the crack of this description; itself where none of its cracks has it."""
    crack = crack_named(structure, description)
    return crack.structure if description and crack.description == description else structure


def ensemble_over_cracks(
    structure: Structure, motions: GroundMotions, settings: AssessmentSettings
) -> CrackEnsembles:
    """Return the ensembles of the cracks that may govern, of the structure and of each leaf that may part.

    Leaves are followed each by itself, the weakest part first, until one overturns. Of each part: where the crack that
    statics chooses overturns, it says all; where one that is known does, the others are followed only until one of
    them overturns, too, so that the worst of them can be reported. Otherwise the bulge of a held wall is followed in
    full, and every crack that `screened` leaves in doubt; the one that then governs, and those whose count may still
    change the verdict (`decide.may_change`), with as many members as these need. A crack other than a bulge that
    slides before it lifts is left out where one that counts is left, and followed all the same where it is in doubt:
    the decision says what it would do. docs/pages/validation.md counts what the screen misses. With fidelity: quick
    only as many members are followed as the verdict needs. Raises MotionError as `integrate` does.
    """
    every = cracks(structure)
    parts: list[CrackEnsembles] = []
    for own in every.parts.values():
        parts.append(_of_part(own, motions, settings, is_named=len(every) > 1))
        if parts[-1].followed[0].facts.step(settings.ensemble.risk) is Verdict.OVERTURNS:
            break
    if len(parts) == 1:
        return parts[0]
    followed = tuple(crack for part in parts for crack in part.followed)
    return CrackEnsembles(followed, tuple(crack for part in parts for crack in part.left_out))


def _of_part(
    several: Mechanisms,
    motions: GroundMotions,
    settings: AssessmentSettings,
    *,
    is_named: bool,
) -> CrackEnsembles:
    """The ensembles of the cracks of one part that may govern it; is_named: whether anything else may form."""
    counting = several.counting
    sliding = sliding_first(several, motions)
    lifting = Mechanisms(candidate for candidate in counting if candidate not in sliding) or counting
    left_out = [candidate for candidate in counting if candidate not in lifting]
    first, *others = *lifting, *(candidate for candidate in several if not candidate.counts)
    of_statics = ensemble(
        first.mechanism,
        motions,
        settings.ensemble,
        tolerance=settings.tolerance,
        verdict_only=settings.fidelity == "quick",
    )
    named = first if is_named or first.bulges else replace(first, description="")
    statics = FollowedCrack.of(named, of_statics, slides=first in sliding)
    risk = settings.ensemble.risk
    settled = statics.facts.step(risk) is Verdict.OVERTURNS
    if settled:
        others = [candidate for candidate in others if not candidate.counts]
        left_out = []

    def in_doubt(several: Sequence[Candidate]) -> list[Candidate]:
        rest = Mechanisms(several)
        lifted_at = first.mechanism.uplift_multiplier
        return [*rest.bulges, *screened(rest.cracks, of_statics, motions, settings, lifted_at)]

    def followed(candidate: Candidate) -> FollowedCrack:
        of_one = ensemble(
            candidate.mechanism,
            motions,
            settings.ensemble,
            tolerance=settings.tolerance,
            verdict_only=True,
            grows=False,
        )
        return FollowedCrack.of(candidate, of_one, slides=candidate in sliding)

    mechanisms = {}
    for candidate in in_doubt(others):
        crack = followed(candidate)
        mechanisms[crack] = candidate.mechanism
        if settled and crack.facts.step(risk) is Verdict.OVERTURNS:
            break
    ensembles = CrackEnsembles((statics, *mechanisms), tuple(map(followed, in_doubt(left_out))))
    # Another crack may govern, or come within reach, once one has its members; each grows once.
    while growing := [crack for crack in ensembles.deciding if crack in mechanisms]:
        own = growing[0]
        more = grown(
            own.ensemble, mechanisms.pop(own), motions, settings.ensemble, tolerance=settings.tolerance
        )
        grew = replace(own, ensemble=more)
        ensembles = replace(
            ensembles, followed=tuple(grew if crack is own else crack for crack in ensembles.followed)
        )
    return ensembles


def sliding_first(several: Mechanisms, motions: GroundMotions) -> Mechanisms:
    """Return those of the mechanisms that may form that slide before they lift, under motions that reach so far.

    A bulge whose joints slide instead is no safer for it: it is none of them where anything that counts lifts, or
    nothing but bulges may form.
    """
    sliding = Mechanisms(candidate for candidate in several if slides_first(candidate, motions))
    some_lift = any(candidate not in sliding for candidate in several.counting)
    return sliding.cracks if some_lift or not several.counting.cracks else sliding


def slides_first(candidate: Candidate, motions: GroundMotions) -> bool:
    """Whether a mechanism slides before it lifts, under motions that reach so far."""
    level = slides_at(candidate)
    return motions.excitation > level  # not where it is nan


def slides_at(candidate: Candidate) -> float:
    """Return the acceleration [g] at which a joint slides before a mechanism lifts; nan where none does.

    By statics of all joints, where the structure knows it; else until it lifts the forces of the joints of the
    mechanism are taken to grow with the acceleration. Of one with a joint that nothing presses statics knows no such
    level: it is no mechanism that forms.
    """
    of_all_joints = candidate.structure.slides_at()
    if not math.isnan(of_all_joints):
        return of_all_joints
    needed = _lifting_friction(candidate.structure)
    friction = candidate.structure.joints.friction
    if not friction < needed < math.inf:
        return math.nan
    return candidate.mechanism.uplift_multiplier * friction / needed


_lifting_friction = lru_cache(maxsize=1024)(lifting_friction)


def screened(
    others: Sequence[Candidate],
    of_statics: Ensemble,
    motions: GroundMotions,
    settings: AssessmentSettings,
    lifted_at: float,
) -> list[Candidate]:
    """Return those of the `others` that may not stand, the worst first.

    Each meets three members of the ensemble of statics, or of the crack that is known: the two that rotate most, and
    the middle one. One that turns beyond IN_DOUBT of its critical rotation there, or cannot be followed, is left in
    doubt; one without ties whose block stays FAR_FROM_DOUBT is not. Where all members rest, only what lifts below
    `lifted_at`, the λ of the first crack, may rock.
    """
    if np.all(of_statics.rotation_ratios == 0):
        others = [candidate for candidate in others if candidate.mechanism.uplift_multiplier < lifted_at]
    order = np.argsort(-of_statics.rotation_ratios, kind="stable")
    few = design(settings.ensemble)[order[[0, 1, order.size // 2]]]
    follow = partial(
        drawn, motions=motions, points=few, settings=settings.ensemble, tolerance=settings.tolerance
    )
    severity = {}
    for candidate in others:
        if candidate.mechanism.can_overturn and not candidate.mechanism.tied:
            block = follow(candidate.mechanism.equivalent_block("uplift"))
            if block.rotation_ratios.max() <= FAR_FROM_DOUBT:  # not of a member that failed
                continue
        ratios = np.nan_to_num(follow(candidate.mechanism).rotation_ratios, nan=np.inf, posinf=np.inf)
        if ratios.max() > IN_DOUBT:
            severity[candidate] = int(np.isinf(ratios).sum()), float(ratios.min())
    return sorted(severity, key=severity.__getitem__, reverse=True)


BINS = 4
"""Parts into which the range of a cause with all values in between is cut: 16 of 64 members each."""
DECIDES = 0.5
"""Share of the variance from which one thing is said to decide."""
CRACK = "which crack opens"
_WORDS = {
    "amplitude": "the amplitude of the motion",
    "restitution": "the restitution",
    "polarity": "the sign of the motion",
    "direction": "the direction of the motion",
    "processing": "the processing of the record",
    "vertical": "the vertical motion",
}


@dataclass(frozen=True)
class Deciding:
    """One thing that an outcome depends on. share: of the variance of overturning that it explains, 0 to 1."""

    name: str
    share: float
    origin: Origin

    @property
    def words(self) -> str:
        """Its name and share: "the restitution (62 %)"."""
        return f"{_WORDS.get(self.name, self.name)} ({100 * self.share:.0f} %)"


def deciding(ensembles: CrackEnsembles) -> list[Deciding]:
    """Return what the outcome depends on, the largest share first; [] where all members agree.

    The causes are those of the crack that governs; which crack opens is a cause too, among those that count, of which
    one forms.
    """
    governing = ensembles.governing.ensemble
    falls = np.isinf(governing.rotation_ratios)
    known = ~np.isnan(governing.rotation_ratios)
    shares = []
    for cause in (cause for cause in CAUSES if cause.name in governing.causes):
        groups = governing.causes[cause.name]
        if groups.dtype.kind == "f" and np.unique(groups).size > BINS:
            # Numbers of an interval go by the part of it in which they lie.
            groups = np.searchsorted(np.linspace(groups.min(), groups.max(), BINS + 1)[1:-1], groups)
        shares.append(Deciding(cause.name, explained(falls[known], groups[known]), cause.origin))
    of_part = [crack for crack in ensembles.followed if crack.part == ensembles.governing.part]
    cracked = [crack for crack in of_part if crack.counts and not crack.bulges]
    counting = [crack for crack in cracked if not crack.of_geometry]
    if len(cracked) > len(counting):
        typed_or_not = _explained_by_crack([counting[0], cracked[-1]])
        shares.append(Deciding("restitution", typed_or_not, Origin.IGNORANCE))
    if len(counting) > 1:
        shares.append(Deciding(CRACK, _explained_by_crack(counting), Origin.IGNORANCE))
    some = [deciding_cause for deciding_cause in shares if deciding_cause.share > 0]
    return sorted(some, key=lambda deciding_cause: deciding_cause.share, reverse=True)


def decided_by(ensembles: CrackEnsembles) -> str:
    """Return in words what decides: one thing, or that none does by itself; "" where all members agree."""
    largest = deciding(ensembles)
    if not largest:
        unanimous = ensembles.governing.ensemble.overturning_share in (0.0, 1.0)
        return "" if unanimous else "nothing decides on its own"
    first = largest[0]
    if first.share >= DECIDES:
        return f"decided by {first.words}"
    return f"nothing decides on its own, most {first.words}"


_WORTH_MEASURING = 0.2
"""Share of the variance of overturning from which on knowing one input better is worth a measurement."""
_KINDS = {
    "restitution": AssessmentKind.RESTITUTION,
    "processing": AssessmentKind.PROCESSING,
    CRACK: AssessmentKind.CRACK,
}


def worth_measuring(ensembles: CrackEnsembles, *, restitution_is_typed: bool) -> tuple[RockingWarning, ...]:
    """Return the unknown whose measurement would help most: the first one, if it explains _WORTH_MEASURING at least.

    restitution_is_typed: whether the description gives its range, so that it is not known any better.
    """
    governing = ensembles.governing
    if governing.of_geometry and governing.ensemble.overturning_share > 0 and not restitution_is_typed:
        return (RockingWarning(AssessmentKind.RESTITUTION),)
    worth = (
        RockingWarning(_KINDS[cause.name])
        for cause in deciding(ensembles)
        if cause.origin is Origin.IGNORANCE and cause.share >= _WORTH_MEASURING and cause.name in _KINDS
        if not (restitution_is_typed and cause.name == "restitution")
    )
    return tuple(worth)[:1]


def explained(falls: np.ndarray, groups: np.ndarray) -> float:
    """Return the share of the variance of `falls` (m,) between `groups` (m,), ε², at least 0; 0 where all agree."""
    values = falls.astype(float)
    total = float(((values - values.mean()) ** 2).sum()) if values.size else 0.0
    names = np.unique(groups)
    if total == 0 or not 1 < names.size < values.size:
        return 0.0
    within = sum(float(((own - own.mean()) ** 2).sum()) for own in (values[groups == name] for name in names))
    by_accident = (names.size - 1) * within / (values.size - names.size)
    return max(0.0, (total - within - by_accident) / total)


def _explained_by_crack(followed: Iterable[FollowedCrack]) -> float:
    falls = []
    groups = []
    for place, crack in enumerate(followed):
        ratios = crack.ensemble.rotation_ratios
        own = np.isinf(ratios[~np.isnan(ratios)])
        falls.append(own)
        groups.append(np.full(own.size, place))
    return explained(np.concatenate(falls), np.concatenate(groups))
