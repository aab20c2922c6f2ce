"""Case: one motion, one structure, one result; and what became of a structure over all components of a record.

What becomes of a structure is decided by `decide` from the facts that are gathered here. Tables, reports, the page to
explore, the terminal and `rocking.assess` ask for that decision, or read the row that it was written into.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from rocking.assessment.contacts import ContactShare, stackable
from rocking.assessment.cracks import (
    CrackEnsembles,
    cracks,
    decided_by,
    loses_seat_at,
    never_overturns_because,
    worth_measuring,
)
from rocking.assessment.decide import Decision, Facts, Limit, Severity, Verdict, decide, severity
from rocking.assessment.ensemble import NO_MEMBERS, Ensemble
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import BOTH_COMPONENTS, Method
from rocking.assessment.motions import Component, ComponentPulses, MovingSupport, by_name, on_support
from rocking.assessment.reserve import Reserve
from rocking.assessment.scene import Scene, periods_in_words
from rocking.motion.response import UNKNOWN, ModelCheck, Response
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.sine_pulse import AsPrinted, Maximum
from rocking.structures import EquivalentBlock, Outcome, Structure
from rocking.structures.structure import Candidate
from rocking.structures.tied import held
from rocking.warnings import RockingWarning

DECISIVE = ("responses", "directions")
"""Stages whose failure leaves a structure without a result; the others only leave out a comparison."""


@dataclass(frozen=True)
class Failure:
    """A stage that gave no result, and why."""

    stage: str
    message: str


@dataclass(frozen=True)
class Prediction:
    """The closed forms of one structure under one pulse.

    block: equivalent block of the settings, under which `maximum` was found. pulse_rank: of the pulse among those that
    its method offers. printed: what the source paper's equations say; None under a pulse that is no full sine.
    """

    block: EquivalentBlock
    pulse: Pulse
    pulse_rank: int
    maximum: Maximum
    printed: AsPrinted | None

    @property
    def side(self) -> EquivalentBlock:
        """The side of the block that the pulse lifts first."""
        # Positive acceleration lifts the negative side first.
        starts_negative = self.block.other_side is not None and self.pulse.amplitude > 0
        return self.block.sides[-1 if starts_negative else 0]

    @property
    def amplitude_ratio(self) -> float:
        """Amplitude ratio a = |a_g|/(gλ) on that side (Eq. 16)."""
        return abs(self.pulse.amplitude) / (GRAVITY * self.side.uplift_multiplier)

    @property
    def frequency_ratio(self) -> float:
        """Frequency ratio ω_g/p on that side (Eq. 16)."""
        return self.pulse.circular_frequency / self.side.frequency_parameter


@dataclass(frozen=True, kw_only=True)
class Variation:
    """A case with another crack or another processing of the record: its rotation ratios under record and pulse.

    predicted_rotation_ratio: nan without a pulse. crack, position: what opens, in words, and its height, m. counts:
    whether it takes part in the verdict, as of `Candidate`.
    """

    integrated_rotation_ratio: float
    predicted_rotation_ratio: float = math.nan
    crack: str = ""
    position: float = math.nan
    processing: str = ""
    counts: bool = True


@dataclass(frozen=True, eq=False, kw_only=True)
class CaseResult:
    """The result of one structure under one motion.

    component: name of the motion. structure: "" of a case that nobody named. prediction: None without a pulse.
    responses: by method. check: whether the model held along the response of the mechanism to the record. ensembles: of
    the cracks that were followed; None where none ran. reserve: of the crack that governs; None where it was not
    computed; a store keeps it apart, as only what is printed has one. slides_at: acceleration [g] at which its joints
    slide before they lift, where the motion reaches it; else nan. limits: what evidence sets against the verdict of its
    mechanisms. crack: to which prediction, responses and check belong; "" where it is that of the structure. statics:
    the case of that one, where another crack governs. variations: other cracks, then other processings. seat_lost:
    whether a member, or the run, moves so far below a floor, beam or vault that this loses its bearing, and counts as
    fallen.
    """

    component: str
    structure: str = ""
    prediction: Prediction | None = None
    responses: Mapping[Method, Response] = field(default_factory=dict)
    check: ModelCheck = UNKNOWN
    ensembles: CrackEnsembles | None = None
    reserve: Reserve | None = None
    slides_at: float = math.nan
    crack: str = ""
    statics: "CaseResult | None" = None
    seat_lost: bool = False
    limits: tuple[Limit, ...] = ()
    contact: ContactShare | None = None
    variations: tuple[Variation, ...] = ()
    failures: tuple[Failure, ...] = ()

    @property
    def kept(self) -> "CaseResult":
        """The part of it that a store keeps: the same for the same input, whenever and wherever it is computed.

        Without the histories, without the prediction, which a pulse gives at once, and without the times it took.
        """
        responses = {
            method: replace(response, times=None, rotation=None, angular_velocity=None)
            for method, response in self.responses.items()
        }
        return replace(self, prediction=None, responses=responses, reserve=None)

    def losing_seats(self, body: Structure, support_loss: float) -> "CaseResult":
        """Return it with each member, or its run, that moves by `support_loss` [m] below a floor counted as fallen."""
        if not math.isfinite(support_loss):
            return self
        lost_at = {
            candidate.description: loses_seat_at(candidate.structure, support_loss)
            for candidate in cracks(body)
        }
        own = lost_at.get(self.crack, loses_seat_at(body, support_loss))
        case = replace(self, seat_lost=self.integrated_rotation_ratio > own)
        if self.ensembles is None:
            return case
        beyond = [
            replace(crack, ensemble=crack.ensemble.overturning_beyond(lost_at.get(crack.description, own)))
            for crack in self.ensembles.followed
        ]
        more = any(
            after.ensemble.overturning_members > before.ensemble.overturning_members
            for before, after in zip(self.ensembles.followed, beyond, strict=True)
        )
        return replace(
            case, ensembles=replace(self.ensembles, followed=tuple(beyond)), seat_lost=case.seat_lost or more
        )

    @property
    def predicted_rotation_ratio(self) -> float:
        """Rotation ratio of the closed form; nan without a pulse."""
        return self.prediction.maximum.rotation_ratio if self.prediction else math.nan

    @property
    def response(self) -> Response | None:
        """The integration of the mechanism under the record; None of a pair, and where the case failed."""
        return self.responses.get(Method.MECHANISM_ON_RECORD)

    @property
    def integrated_rotation_ratio(self) -> float:
        """Rotation ratio of the mechanism on the record; nan of a pair, and where the case failed."""
        return self.response.rotation_ratio if self.response else math.nan

    def largest_of_part(self, part: str | None) -> float:
        """Return the largest of its runs in which a part falls by itself, a leaf or "" for all of it; None: of any."""
        if self.ensembles is not None:
            of_part = [crack for crack in self.ensembles.followed if part is None or crack.part == part]
            of_each = [crack.ensemble.rotation_ratios for crack in of_part]
            ratios = [ratio for ratios_of_crack in of_each for ratio in ratios_of_crack.tolist()]
            return max((ratio for ratio in ratios if not math.isnan(ratio)), default=math.nan)
        return self.response.rotation_ratio if self.response else 0.0

    def facts(self, body: Structure, failures: tuple[str, ...] = ()) -> Facts:
        """Return the facts of this case from which, with its limits, the decision follows.

        body: the structure. failures: why other components are missing.
        """
        other_runs = [
            variation.integrated_rotation_ratio
            for variation in self.variations
            if variation.crack and variation.counts
        ]
        runs = [ratio for ratio in (self.integrated_rotation_ratio, *other_runs) if not math.isnan(ratio)]
        rests = (
            self.response is not None and self.response.outcome is Outcome.NO_UPLIFT and not any(other_runs)
        )
        if self.ensembles is not None:
            followed = [crack for crack in self.ensembles.followed if crack.counts]
            rests = all(bool((crack.ensemble.rotation_ratios == 0).all()) for crack in followed)
        typed = cracks(body).counting[0].mechanism.restitution_range is not None
        wall = held(body)
        restraints = wall.restraints if wall else ()
        tops = (restraint for restraint in restraints if restraint.kind == "top" and restraint.lets_go)
        own = self.ensembles.facts if self.ensembles else Facts()
        return replace(
            own,
            # What slides apart does not have to lift.
            rests=rests and not (body.joints.fall_by_sliding and not math.isnan(self.slides_at)),
            run_ratio=math.inf if self.seat_lost else max(runs, default=math.nan),
            never_overturns_because="" if self.seat_lost else never_overturns_because(body),
            slides_at=own.slides_at if math.isnan(self.slides_at) else self.slides_at,
            top=next((top.warning for top in tops), None),
            stacks=(self.contact.falls, self.contact.runs) if self.contact and self.contact.runs else None,
            as_stones=body.joints.as_stones,
            stackable=self.contact is None and stackable(body),
            settling=(
                *([RockingWarning(AssessmentKind.SEATS)] if self.seat_lost else []),
                *(worth_measuring(self.ensembles, restitution_is_typed=typed) if self.ensembles else ()),
            ),
            failures=failures,
        )

    def decision(self, body: Structure, failures: tuple[str, ...] = ()) -> Decision:
        """Return the decision on it. body: the structure. failures: why other components are missing."""
        return decide(self.facts(body, failures), self.limits)

    @property
    def friction_needed(self) -> float:
        """The friction coefficient that a contact needs while it rocks, where it has less; else nan.

        Of what was followed as stones nan: these stand or slide on what they have.
        """
        runs = self.contact.runs if self.contact else 0
        short = (limit for limit in self.limits if limit.warning.kind is AssessmentKind.FRICTION_SHORT)
        return next((limit.value for limit in short if not (runs and limit.lifted_by == 1)), math.nan)

    @property
    def overturns(self) -> bool:
        """Whether the single run overturns."""
        return self.response is not None and self.response.outcome is Outcome.OVERTURNS

    @property
    def failure(self) -> Failure | None:
        """Why there is no result; None where there is one."""
        return next((failure for failure in self.failures if failure.stage in DECISIVE), None)

    @property
    def severity(self) -> tuple[bool, float]:
        """Key by which the worst of several components comes last."""
        ratio = self.integrated_rotation_ratio
        return self.overturns, -1.0 if math.isnan(ratio) else ratio


@dataclass(frozen=True, eq=False, repr=False)
class PeriodResult:
    """The result of one structure under one record, all components and directions considered.

    The case over all directions decides, where it has an ensemble. Otherwise each component is decided, with those that
    gave no result counted as missing, and the worst one counts. Every count, share and quantile is that of the crack
    that governs.

    cases: by component, those that failed too. directions: the case of the pair; None of one component, or without
    ensembles. support: of those along the axis of its place; None on the ground. decision: what becomes of it.
    decided_on: name of the component that decides, or `BOTH_COMPONENTS`; "" where none gave a result.
    """

    scene: Scene
    cases: Mapping[str, CaseResult]
    directions: CaseResult | None
    support: MovingSupport | None
    decision: Decision
    decided_on: str

    @classmethod
    def of(
        cls,
        scene: Scene,
        cases: Mapping[str, CaseResult],
        directions: CaseResult | None = None,
        support: MovingSupport | None = None,
    ) -> "PeriodResult":
        """Return the result with what is decided on these cases."""
        deciding, decision = _decided(scene.structure, cases, directions)
        return cls(scene, cases, directions, support, decision, deciding)

    @property
    def structure(self) -> str:
        """Name of the structure."""
        return self.scene.name

    @property
    def support_period_s(self) -> float | None:
        """First period of the support, s; 0 on the ground below one, None where the place has no support."""
        if not self.scene.place.supports:
            return None
        return self.support.first_period if self.support else 0.0

    @property
    def every_case(self) -> list[CaseResult]:
        """The cases of the components, then that of the pair."""
        return [*self.cases.values(), *([self.directions] if self.directions else [])]

    @cached_property
    def worst(self) -> CaseResult | None:
        """The case of the component that overturns, then rotates, most; None where no component gave a result."""
        answered = [case for case in self.cases.values() if case.response is not None]
        return max(answered, key=lambda case: case.severity, default=None)

    def check_of(self, candidate: Candidate) -> ModelCheck | None:
        """Return the contacts along the run of one of its mechanisms under the worst component as recorded.

        None where that one was not followed alone.
        """
        case = self.worst
        if case is not None and case.crack:
            if candidate.description == case.crack:
                return case.check
            case = case.statics
        return case.check if case is not None and candidate.is_own_of(self.scene.structure) else None

    @property
    def deciding(self) -> CaseResult | None:
        """The case that decides; None where no component gave a result."""
        return self.directions if self.decided_on == BOTH_COMPONENTS else self.cases.get(self.decided_on)

    @property
    def decisive(self) -> CaseResult | None:
        """The case whose ensemble decides; None without an ensemble."""
        return self.deciding if self.deciding is not None and self.deciding.ensembles is not None else None

    @property
    def friction_needed(self) -> float:
        """The friction coefficient that a contact needs, where it has less, of what (probably) stands; else nan."""
        return self.deciding.friction_needed if self.deciding is not None else math.nan

    @property
    def ensemble(self) -> Ensemble:
        """The ensemble of the crack that governs; one without members where none ran."""
        return self.ensembles.governing.ensemble if self.ensembles else NO_MEMBERS

    @property
    def ensembles(self) -> CrackEnsembles | None:
        """The ensembles of every crack that was followed; None without any."""
        return self.decisive.ensembles if self.decisive else None

    @property
    def reserve(self) -> Reserve | None:
        """The factors on the record at which 5, 50 and 95 % of the members overturn; None where it was not computed."""
        return self.decisive.reserve if self.decisive else None

    @property
    def reserve_warnings(self) -> tuple[RockingWarning, ...]:
        """Why the reserve may be too high: what neither its members nor its contact dynamics follow."""
        failed = (AssessmentKind.MEMBERS_FAILED, AssessmentKind.COMPONENT_MISSING)
        warnings = [warning for warning in self.decision.warnings if warning.kind in failed]
        body = self.scene.structure
        # Stacks whose ties yield at their anchors take seconds a run, and are followed at the record itself alone.
        wall = held(body)
        if wall and math.isfinite(wall.anchors_slide_at):
            warnings.append(RockingWarning(AssessmentKind.ANCHOR_GIVES))
        if not stackable(body):
            warnings += [
                limit.warning for case in self.every_case for limit in case.limits if limit.is_untold
            ]
            opens = any(case.check.bounces for case in self.every_case)
            warnings += [RockingWarning(AssessmentKind.CONTACTS_OPEN)] if opens else []
            warnings += [RockingWarning(AssessmentKind.COURSES_THROWN)] if body.joints.courses_taper else []
            warnings += [RockingWarning(AssessmentKind.STONES_TELL)] if body.joints.need_stones else []
        return tuple(sorted(set(warnings), key=lambda warning: warning.kind))

    @property
    def reserve_in_words(self) -> str:
        """The reserve, where it was computed, and why it may be too high."""
        words = str(self.reserve)
        if self.reserve_warnings:
            reasons = " and ".join(map(str, self.reserve_warnings))
            words = f"{words}; this is the reserve of the mechanism alone, and too high where {reasons}"
        return words

    @property
    def component(self) -> str:
        """The component of the case that decides, or `BOTH_COMPONENTS`."""
        deciding = self.decisive or self.worst or next(iter(self.cases.values()))
        return deciding.component

    @cached_property
    def _fallen_crack(self) -> str:
        """A crack that overturns in a single run, where there is no ensemble; "" where none does."""
        variations = (
            variation for case in self.cases.values() for variation in case.variations if variation.counts
        )
        fallen = (
            variation.crack
            for variation in variations
            if variation.crack and math.isinf(variation.integrated_rotation_ratio)
        )
        return next(fallen, "")

    @property
    def decided_by(self) -> str:
        """The input that decides whether it overturns, in words with its share; "" where the members agree."""
        if self.ensembles is None or self.decision.verdict.is_sure:
            return ""
        return decided_by(self.ensembles)

    @property
    def stacks(self) -> ContactShare | None:
        """The share of contact dynamics over all components together; None where it followed nothing."""
        shares = [case.contact for case in self.every_case if case.contact is not None]
        falls = sum(share.falls for share in shares)
        runs = sum(share.runs for share in shares)
        return ContactShare(falls=falls, runs=runs) if runs else None

    @property
    def verdict(self) -> Verdict:
        """The verdict on the structure."""
        return self.decision.verdict

    @property
    def severity(self) -> Severity:
        """Key by which the worst of several comes last."""
        factor = self.reserve.low if self.reserve else math.nan
        return severity(self.decision, factor=factor, rotation_ratio=self.rotation_ratio)

    @property
    def crack(self) -> str:
        """The crack that governs, to which all numbers belong; "" where only one may form."""
        return self.ensembles.governing.description if self.ensembles else self._fallen_crack

    @property
    def rotation_ratio(self) -> float:
        """Largest rotation over critical rotation as recorded, the worst component; inf if it overturns."""
        return self.worst.integrated_rotation_ratio if self.worst else math.nan

    @property
    def direction(self) -> str:
        """Direction of the largest rotation; "" where there is one only."""
        of_members = self.ensemble.worst("direction")
        if of_members or self.worst is None:
            return of_members
        answered = [case for case in self.cases.values() if case.response is not None]
        return self.worst.component if len(answered) > 1 else ""

    @property
    def peak_side(self) -> int | None:
        """Side of the largest rotation or of the overturning, 1 or -1; 0 without uplift, None without integration."""
        response = self.worst.response if self.worst else None
        return response.peak_side if response else None


def _decided(
    body: Structure, cases: Mapping[str, CaseResult], directions: CaseResult | None
) -> tuple[str, Decision]:
    """The name of the component that decides, "" where none gave a result; and the decision."""
    if directions is not None and directions.ensembles is not None:
        # All directions are one: what a component lacks takes nothing away.
        return BOTH_COMPONENTS, directions.decision(body)
    answered = {name: case for name, case in cases.items() if case.response is not None}
    if not answered:
        first = [case.failure.message for case in cases.values() if case.failure][:1]
        return "", decide(Facts(failures=tuple(first)))
    both = [*cases.values(), *([directions] if directions else [])]
    missing = tuple(
        f"the component {case.component or 'not named'} gave no result: {case.failure.message}"
        for case in both
        if case.failure
    )
    decided = [(name, case.decision(body, missing)) for name, case in answered.items()]
    return max(decided, key=lambda pair: (severity(pair[1]), *_rotation_severity(answered[pair[0]])))


@dataclass(frozen=True, eq=False)
class SceneResult:
    """The results of one scene under one record, along the axis of its place: the ground, then every period.

    The verdicts over the periods of a support are listed side by side and not mixed: a share of periods would be no
    probability. Where one of them has to represent all, it is the worst.
    """

    scene: Scene
    periods: tuple[PeriodResult, ...]

    @property
    def worst(self) -> PeriodResult:
        """The result of the period that is worst; the first among equals.

        The result on the ground is there for comparison only, and does not decide for a structure on a support.
        """
        carried = [period_result for period_result in self.periods if period_result.support_period_s]
        return max(carried or self.periods, key=lambda period_result: period_result.severity)

    @property
    def sentence(self) -> str:
        """The verdicts over the periods of a support: "parapet on roof stands on the ground, overturns …"."""
        verdicts = {period.support_period_s or 0.0: period.verdict for period in self.periods}
        return f"{self.scene.name} on {self.scene.place.name} {periods_in_words(verdicts)}"


@dataclass(frozen=True, eq=False, kw_only=True)
class RecordResult:
    """The results of all structures under one record.

    components: those that could be opened, as they acted. scenes: by the name of the structure. failures: of what
    concerns no single structure, by component ("" for all). durations: CPU time of each stage, s. floors: the pulses of
    the components as they arrive on each support that carries a structure, whose samples `components_on` makes.
    """

    record: str
    components: tuple[Component, ...] = ()
    scenes: Mapping[str, SceneResult] = field(default_factory=dict)
    failures: tuple[tuple[str, Failure], ...] = ()
    durations: Mapping[str, float] = field(default_factory=dict)
    floors: Mapping[MovingSupport, tuple[ComponentPulses, ...]] = field(default_factory=dict)

    def components_on(self, support: MovingSupport | None) -> tuple[Component, ...]:
        """Return the components as they arrive on a support; None: on the ground."""
        if support is None:
            return self.components
        return on_support(support, self.components, self.floors[support])

    def components_under(self, period_result: PeriodResult) -> dict[str, Component]:
        """Return the components as a structure meets them, by the names of the components."""
        return by_name(
            self.components_on(period_result.support if period_result.support in self.floors else None)
        )

    @cached_property
    def periods(self) -> list[PeriodResult]:
        """The results of all scenes, each along the axis of its place."""
        return [period_result for scene in self.scenes.values() for period_result in scene.periods]

    @property
    def carried(self) -> list[SceneResult]:
        """The results of the scenes on a support."""
        return [structure for structure in self.scenes.values() if structure.scene.place.supports]

    @cached_property
    def worst_first(self) -> list[PeriodResult]:
        """The results of all scenes, the worst first."""
        return sorted(self.periods, key=lambda period_result: period_result.severity, reverse=True)

    @property
    def worst_periods(self) -> list[PeriodResult]:
        """The result of each scene, of one on a support that of the worst period; the worst first."""
        worst = (structure.worst for structure in self.scenes.values())
        return sorted(worst, key=lambda period_result: period_result.severity, reverse=True)

    @property
    def names(self) -> list[str]:
        """The names of the components, in their order; keys of the other mappings."""
        return list(by_name(self.components))

    @property
    def accelerograms(self) -> list[Accelerogram]:
        """The components."""
        return [component.accelerogram for component in self.components]

    @property
    def responses(self) -> dict[tuple[str, str, float | None], Response]:
        """The integrations of the mechanisms under the record, by component, structure and period of its support."""
        return {
            (component, period_result.structure, period_result.support_period_s): case.response
            for component in self.names
            for period_result, case in self.cases(component)
            if case.response is not None
        }

    def cases(self, component: str) -> list[tuple[PeriodResult, CaseResult]]:
        """Return the cases of one component, or of `BOTH_COMPONENTS`, in the order of the structures."""
        if component == BOTH_COMPONENTS:
            return [(period, period.directions) for period in self.periods if period.directions is not None]
        return [(period, period.cases[component]) for period in self.periods if component in period.cases]


def _rotation_severity(case: CaseResult) -> tuple[float, bool, float]:
    """Key by which the worst of several cases with one decision comes last."""
    high = case.ensembles.governing.ensemble.rotation_ratio_high if case.ensembles else math.nan
    return -1.0 if math.isnan(high) else high, *case.severity
