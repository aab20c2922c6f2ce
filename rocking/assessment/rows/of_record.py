"""The rows of the tables of what becomes of the structures under one record, and all the tables of a record."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar, get_args

import numpy as np

from rocking.assessment.decide import Decision, Severity, Verdict, severity
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import (
    BOTH_COMPONENTS,
    POLARITIES,
    Acts,
    Agreement,
    Method,
    acts,
    agreement,
    within_factor_two,
)
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows.of_inputs import (
    COMPONENT,
    RECORD,
    STRUCTURE,
    SUPPORT_PERIOD,
    ComponentRow,
    Identified,
    Identity,
    PulseRow,
    ReadComponent,
    RecordRow,
    pulses_found,
)
from rocking.catalogue.place import Coordinates
from rocking.errors import RockingError, one_structure
from rocking.floors.place import FloorMeasures
from rocking.sine_pulse import Regime
from rocking.structures.linkage import Reaction
from rocking.structures.structure import Candidate
from rocking.tables import Columns, Row, column, row
from rocking.warnings import Kind, RockingWarning

if TYPE_CHECKING:  # else who reads a table would load numba
    from rocking.assessment.case import (
        CaseResult,
        PeriodResult,
        Prediction,
        RecordResult,
        Variation,
    )
    from rocking.assessment.cracks import FollowedCrack
    from rocking.assessment.motions import Component
    from rocking.motion.response import ModelCheck, Response
    from rocking.structures.mechanism import Side

PEAK_SIDE = "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift"


@dataclass(frozen=True)
class OfStructure(Identified):
    """Anything about one structure under one component of one record. period_result: its result over all components."""

    period_result: "PeriodResult"


C = TypeVar("C", bound=OfStructure)
of_structure = Columns(OfStructure)


@row()
class CaseRow(ComponentRow[C]):
    """A row about one structure under one component of one record."""

    structure: str = of_structure(STRUCTURE, lambda of: of.period_result.structure)
    support_period_s: float | None = of_structure(
        SUPPORT_PERIOD, lambda of: of.period_result.support_period_s
    )

    @property
    def case(self) -> tuple[str, str, float | None]:
        """Component, structure and period of its support."""
        return self.component, self.structure, self.support_period_s


@row()
class DecidedRow(CaseRow[C]):
    """A row about a case that says what becomes of the structure over all components."""

    verdict: Verdict = of_structure(f"The verdict: {', '.join(Verdict)}", lambda of: of.period_result.verdict)
    overturning_share: float = of_structure(
        "Largest share that overturns, of the members of each crack and the stacks that make the verdict; 0 or 1 of a "
        "single run; empty where unknown",
        lambda of: of.period_result.decision.share,
    )


@dataclass(frozen=True)
class PredictedCase(Identified):
    """The closed form of one structure under one component."""

    structure: str
    prediction: "Prediction"


of_predicted_case = Columns(PredictedCase)
of_predicted = of_predicted_case.part(lambda of: of.prediction)


@row("predictions")
class PredictionRow(ComponentRow[PredictedCase]):
    """One row per structure and component: the closed form of its equivalent block, before anything is integrated."""

    structure: str = of_predicted_case(STRUCTURE, lambda of: of.structure)
    predicted_rotation_ratio: float = of_predicted(
        "Rotation ratio of the equivalent block under the pulse",
        lambda predicted: predicted.maximum.rotation_ratio,
    )
    regime: Regime = of_predicted("Regime of the closed form", lambda predicted: predicted.maximum.regime)
    pulse_rank: int = of_predicted(
        "Rank of the pulse that predicts among those of its method", lambda predicted: predicted.pulse_rank
    )
    amplitude_ratio: float = of_predicted(
        "Amplitude ratio a = a_g/(gλ) of the pulse",
        lambda predicted: predicted.amplitude_ratio,
        equation="Eq. 16",
    )
    frequency_ratio: float = of_predicted(
        "Circular frequency of the pulse over p",
        lambda predicted: predicted.frequency_ratio,
        equation="Eq. 16",
    )


# What became of it ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class ComparedCase(OfStructure):
    """One case that gave a result."""

    case: "CaseResult"

    @cached_property
    def side(self) -> "Side":
        """The side of the mechanism of the row's crack that the pulse lifts first; without a pulse the positive one."""
        from rocking.assessment.cracks import cracked  # as above: it loads what integrates

        sides = cracked(self.period_result.scene.structure, self.case.crack).mechanism().sides
        prediction = self.case.prediction
        return sides[-1 if prediction is not None and prediction.pulse.amplitude > 0 else 0]

    @property
    def bearing_displacement(self) -> float:
        """How far it moves below a floor, beam or vault under the record, m; nan where it overturns or is not known."""
        from rocking.assessment.cracks import cracked  # as above: it loads what integrates

        response = self.case.response
        if response is None or not math.isfinite(response.rotation_ratio):
            return math.nan
        body = cracked(self.period_result.scene.structure, self.case.crack)
        place = -1 if response.peak_side < 0 else 0
        reached = response.rotation_ratio * body.mechanism().sides[place].critical_rotation
        return float(body.linkages[place].moved_from_bearings(reached))

    @property
    def acts(self) -> Acts | None:
        """When the pulse acts beside the fall of the integration."""
        prediction, response = self.case.prediction, self.case.response
        if prediction is None or response is None:
            return None
        pulse = prediction.pulse
        p = prediction.block.frequency_parameter
        return acts(
            start=pulse.start_time, end=pulse.end_time, fall=response.fall_time, frequency_parameter=p
        )


of_case = Columns(ComparedCase)
of_row_side = of_case.part(lambda of: of.side)
of_printed = of_case.optional(lambda of: of.case.prediction.printed if of.case.prediction else None)
of_prediction = of_case.optional(lambda of: of.case.prediction)
of_response = of_case.optional(lambda of: of.case.response)
of_block_response = of_case.optional(lambda of: of.case.responses.get(Method.BLOCK_ON_RECORD))
of_pulse_response = of_case.optional(lambda of: of.case.responses.get(Method.MECHANISM_ON_PULSE))
of_own_crack = of_case.optional(lambda of: of.case.statics)
of_check = of_case.part(lambda of: of.case.check)


_FIRST = (
    "record",
    "structure",
    "component",
    "printed_rotation_ratio",
    "predicted_rotation_ratio",
    "block_on_record_rotation_ratio",
    "integrated_rotation_ratio",
    "overturning_share",
    "verdict",
)
"""What is asked; the paper's equation, the closed form, the block and the integration; and what comes of it."""


@row("comparison", first=_FIRST)
class ComparisonRow(DecidedRow[ComparedCase]):
    """One row per structure: the closed form under the dominant pulse and the integration of the whole record.

    The columns from the impacts on are those of the integration.
    """

    predicted_rotation_ratio: float = of_case(
        "Rotation ratio of the equivalent block under the pulse", lambda of: of.case.predicted_rotation_ratio
    )
    integrated_rotation_ratio: float = of_case(
        "Rotation ratio of the mechanism under the record", lambda of: of.case.integrated_rotation_ratio
    )
    within_factor_two: bool | None = of_case(
        "Whether their ratio lies between 1/2 and 2",
        lambda of: within_factor_two(
            predicted=of.case.predicted_rotation_ratio, integrated=of.case.integrated_rotation_ratio
        ),
    )
    agreement: Agreement = of_case(
        "Closed form against integration: same outcome, too low or too high",
        lambda of: agreement(
            predicted=of.case.predicted_rotation_ratio, integrated=of.case.integrated_rotation_ratio
        ),
    )
    printed_rotation_ratio: float = of_printed(
        "Rotation ratio of the paper's block under the pulse, as printed; INF where the radicand is negative, which is "
        "the paper's overturning; it may be negative, and holds in its regime alone",
        lambda printed: printed.rotation_ratio,
        equation="Eq. 15",
    )
    printed_holds: bool | None = of_printed(
        "Whether Eq. 15 holds there: no contact before the pulse ends, and largest, or overturning, after the first "
        "impact; or nothing lifts it",
        lambda printed: printed.holds,
    )
    regime: Regime | None = of_prediction(
        "Regime of the closed form", lambda closed_form: closed_form.maximum.regime
    )
    uplift_multiplier: float = of_row_side(
        "Uplift acceleration in g of the mechanism of the row",
        lambda side: side.uplift_multiplier,
        equation="Eq. 7",
    )
    frequency_parameter_rad_s: float = of_row_side(
        "p of that mechanism, linearised about its critical rotation: that of the paper's block",
        lambda side: side.frequency_parameter,
        equation="Eq. 11",
    )
    critical_rotation_rad: float = of_row_side(
        "Critical rotation of that mechanism", lambda side: side.critical_rotation
    )
    restitution: float = of_row_side(
        "Its ratio of angular velocities after and before an impact", lambda side: side.restitution
    )
    block_on_record_rotation_ratio: float = of_block_response(
        "Rotation ratio of the block under the record", lambda response: response.rotation_ratio
    )
    mechanism_on_pulse_rotation_ratio: float = of_pulse_response(
        "Rotation ratio of the mechanism under the pulse", lambda response: response.rotation_ratio
    )
    pulse_rank: int | None = of_prediction(
        "Rank of the pulse that predicts among those of its method",
        lambda closed_form: closed_form.pulse_rank,
    )
    amplitude_ratio: float = of_prediction(
        "Amplitude ratio a = a_g/(gλ) of the pulse",
        lambda closed_form: closed_form.amplitude_ratio,
        equation="Eq. 16",
    )
    frequency_ratio: float = of_prediction(
        "Circular frequency of the pulse over p",
        lambda closed_form: closed_form.frequency_ratio,
        equation="Eq. 16",
    )
    impacts: int | None = of_response(
        "Number of impacts in the integration", lambda response: response.impacts
    )
    crack: str = of_case(
        "Crack to which the row belongs, where it is not the structure's own but the one that governs",
        lambda of: of.case.crack,
    )
    statics_predicted_rotation_ratio: float = of_own_crack(
        "In such a row, the closed form with the structure's own crack",
        lambda case: case.predicted_rotation_ratio,
    )
    statics_integrated_rotation_ratio: float = of_own_crack(
        "Likewise the mechanism under the record", lambda case: case.integrated_rotation_ratio
    )
    bearing_displacement_m: float = of_case(
        "Largest distance that it moves sideways below a floor, beam or vault under the record, from the bearing of "
        "this; empty where it overturns",
        lambda of: of.bearing_displacement,
    )
    peak_time_s: float = of_response(
        "Time of the largest rotation after the first sample", lambda response: response.peak_time
    )
    fall_time_s: float = of_response(
        "Time at which it passes its critical rotation where it overturns",
        lambda response: response.fall_time,
    )
    pulse_acts: Acts | None = of_case(
        "Whether the pulse acts before, during or after that fall; empty without one. After it predicted none",
        lambda of: of.acts,
    )
    fragile: bool | None = of_response(
        "Whether a change of 1 % in the ground motion, or chaotic motion, decides the outcome",
        lambda response: response.fragile,
    )
    lifting_friction: float = of_check(
        "Friction that a contact needs as the structure lifts", lambda check: check.lifting_friction
    )
    required_friction: float = of_check(
        "Largest friction that a contact needs; INF where it carries no pressure",
        lambda check: check.required_friction,
    )
    slides: bool | None = of_case(
        "Whether a contact needs more friction than it has while it rocks",
        lambda of: of.case.check.slides(of.period_result.scene.structure.joints.friction),
    )
    bounces: bool | None = of_check(
        "Whether a contact lifts off, so that the model fails", lambda check: check.bounces
    )
    ties: str = of_check(
        "Which ties yield or break on the way to the largest rotation", lambda check: check.ties
    )

    @property
    def sees_fall(self) -> bool:
        """Whether the closed form falls with the integration, by a pulse that begins before the fall."""
        both_fall = self.predicted_rotation_ratio == self.integrated_rotation_ratio == math.inf
        return both_fall and self.pulse_acts is not Acts.AFTER


RATIO_COLUMNS = {
    Method.CLOSED_FORM: "predicted_rotation_ratio",
    Method.BLOCK_ON_RECORD: "block_on_record_rotation_ratio",
    Method.MECHANISM_ON_PULSE: "mechanism_on_pulse_rotation_ratio",
    Method.MECHANISM_ON_RECORD: "integrated_rotation_ratio",
}
"""The columns of the comparison with the largest rotation by method, over the critical one; INF if it overturns."""


of_decision = of_structure.part(lambda of: of.period_result.decision)
of_ensemble = of_structure.part(lambda of: of.period_result.ensemble)
of_statics = of_structure.optional(
    lambda of: of.period_result.ensembles.reported_statics if of.period_result.ensembles else None
)
of_reserve = of_structure.optional(lambda of: of.period_result.reserve)
of_stacks = of_structure.optional(lambda of: of.period_result.stacks)


@row("verdicts")
class VerdictRow(DecidedRow[OfStructure]):
    """One row per record and structure: the decision over all components, and the numbers of the crack that governs.

    The component is that of the governing case. decision, reserve: what the row prints; the reserve is None where it
    was not computed.
    """

    decision: Decision = of_structure.kept(lambda of: of.period_result.decision)
    reserve: Reserve | None = of_structure.kept(lambda of: of.period_result.reserve)
    share_low: float = of_decision(
        "Least share that overturns, over the cracks and what failed or is not known",
        lambda decision: decision.interval[0],
    )
    share_high: float = of_decision(
        "Largest share that overturns, likewise", lambda decision: decision.interval[1]
    )
    why: str = of_decision("Reason for the verdict", lambda decision: decision.why)
    warnings: tuple[Kind, ...] = of_decision(
        "Kinds of warning: what may make it worse",
        lambda decision: tuple(warning.kind for warning in decision.warnings),
    )
    would_settle: tuple[Kind, ...] = of_decision(
        "What would settle it, by kind",
        lambda decision: tuple(warning.kind for warning in decision.would_settle),
    )
    overturning_members: int = of_ensemble(
        "Number of members that overturn", lambda ensemble: ensemble.overturning_members
    )
    members: int = of_ensemble(
        "Number of members that were followed; 0 without an ensemble", lambda ensemble: ensemble.members
    )
    failed_members: int = of_ensemble(
        "Number of members whose integration failed", lambda ensemble: ensemble.failed_members
    )
    crack: str = of_structure(
        "Crack that governs, to which the numbers belong; empty where only one may form",
        lambda of: of.period_result.crack,
    )
    statics_crack: str = of_statics(
        "Crack of statics where another governs; of a known crack, the worst other",
        lambda crack: crack.description,
    )
    statics_overturning_members: int | None = of_statics(
        "Members that overturn with that crack", lambda crack: crack.ensemble.overturning_members
    )
    statics_members: int | None = of_statics(
        "Number of members with that crack", lambda crack: crack.ensemble.members
    )
    rotation_ratio_low: float = of_ensemble(
        "5 % quantile of largest rotation over critical rotation",
        lambda ensemble: ensemble.rotation_ratio_low,
    )
    rotation_ratio_median: float = of_ensemble(
        "Median of largest rotation over critical rotation", lambda ensemble: ensemble.rotation_ratio_median
    )
    rotation_ratio_high: float = of_ensemble(
        "95 % quantile of the same ratio; INF if it overturns", lambda ensemble: ensemble.rotation_ratio_high
    )
    rotation_ratio: float = of_structure(
        "Largest rotation over critical rotation as recorded; INF if it overturns",
        lambda of: of.period_result.rotation_ratio,
    )
    friction_needed: float = of_structure(
        "Friction coefficient that a contact needs while it rocks, where it has less, of what (probably) stands",
        lambda of: of.period_result.friction_needed,
    )
    direction: str = of_structure(
        "Direction of the largest rotation; empty where there is only one",
        lambda of: of.period_result.direction,
    )
    polarity: str = of_ensemble(
        "Sign of the motion of the largest rotation: as recorded, reversed; or empty",
        lambda ensemble: POLARITIES.get(ensemble.worst("polarity"), ""),
    )
    peak_side: int | None = of_structure(PEAK_SIDE, lambda of: of.period_result.peak_side)
    reserve_low: float = of_reserve(
        "Factor on the record at which 5 % of the members or of the runs of contact dynamics fall; empty: not reached",
        lambda reserve: reserve.low,
    )
    reserve_median: float = of_reserve(
        "Factor on the record at which half of these fall; empty: not reached",
        lambda reserve: reserve.median,
    )
    reserve_high: float = of_reserve(
        "Factor on the record at which 95 % of these fall; empty: not reached",
        lambda reserve: reserve.high,
    )
    reserve_limit: float = of_reserve(
        "Largest factor on the record that was tried; empty without a reserve (on a support it is searched for on the "
        "ground and at the worst period)",
        lambda reserve: reserve.limit,
    )
    reserve_warnings: tuple[Kind, ...] = of_structure(
        "Kinds of warning for which the reserve may be too high: what neither members nor runs follow",
        lambda of: (
            tuple(warning.kind for warning in of.period_result.reserve_warnings)
            if of.period_result.reserve
            else ()
        ),
    )
    decided_by: str = of_structure(
        "What decides where the members disagree, with its share of the variance",
        lambda of: of.period_result.decided_by,
    )
    stack_falls: int | None = of_stacks(
        "Stacks of courses, or chains of stones, that fall in contact dynamics; empty: not run",
        lambda stacks: stacks.falls,
    )
    stack_runs: int | None = of_stacks(
        "Stacks or chains that were followed, over amplitudes, time steps and directions",
        lambda stacks: stacks.runs,
    )

    @property
    def severity(self) -> Severity:
        """Key by which the worst of several comes last."""
        factor = self.reserve.low if self.reserve else math.nan
        return severity(self.decision, factor=factor, rotation_ratio=self.rotation_ratio)


def worst_period_each(verdicts: Iterable[VerdictRow]) -> list[VerdictRow]:
    """Return the verdicts, of each record and structure on a support that of the worst period only; the worst first.

    The place on the ground below a support serves comparison only.
    """
    shown: dict[tuple[str, str], VerdictRow] = {}
    for verdict in sorted(
        verdicts, key=lambda verdict: (verdict.support_period_s != 0, verdict.severity), reverse=True
    ):
        shown.setdefault((verdict.record, verdict.structure), verdict)
    return sorted(shown.values(), key=lambda verdict: verdict.severity, reverse=True)


def counted_cases(
    comparison: Iterable[ComparisonRow], verdicts: Iterable[VerdictRow]
) -> Iterator[ComparisonRow]:
    """Yield the cases that are counted: of a structure on a support those at the period that its verdict takes.

    Its other periods, and the ground below it, are the same structure under the same record once more.
    """
    taken = {(row.record, row.structure): row.support_period_s for row in worst_period_each(verdicts)}
    for case in comparison:
        if taken.get((case.record, case.structure), case.support_period_s) == case.support_period_s:
            yield case


@dataclass(frozen=True)
class CarriedStructure(OfStructure):
    """One structure on a support of the list, under one component: where it stands and the motion there."""

    floor: "Component"

    @cached_property
    def measures(self) -> FloorMeasures:
        """The motion on the support over that of the ground."""
        ground = (self.floor.ground or self.floor).accelerogram
        period = self.period_result.support_period_s or 0.0
        return self.period_result.scene.place.measures(period, ground=ground, there=self.floor.accelerogram)


of_support = Columns(CarriedStructure)
of_floor_measures = of_support.part(lambda of: of.measures)


@row("supports")
class SupportRow(DecidedRow[CarriedStructure]):
    """One row per component and structure on a support: the motion there, and the verdict over all components."""

    support: str = of_support("Name of the support in the list", lambda of: of.period_result.scene.place.name)
    floor_peak_acceleration_m_s2: float = of_floor_measures(
        "Largest magnitude of the acceleration on the support", lambda measures: measures.peak_acceleration
    )
    amplification: float = of_floor_measures(
        "Peak acceleration on the support over that of the ground", lambda measures: measures.amplification
    )
    floor_spectral_acceleration_m_s2: float = of_floor_measures(
        "5 % floor spectrum at the period of the support", lambda measures: measures.spectral_acceleration
    )
    code_spectral_acceleration_m_s2: float = of_floor_measures(
        "The same by the code's formula from the ground's spectrum",
        lambda measures: measures.code_spectral_acceleration,
        equation="C7.2.5",
    )


def structures_carried(
    result: "RecordResult", identities: Mapping[str, Identity]
) -> Iterator[CarriedStructure]:
    """Yield every structure on a support under each component. identities: of the components, by name."""
    for period_result in (period_result for scene in result.carried for period_result in scene.periods):
        if period_result.support is not None and period_result.support not in result.floors:
            continue  # the record could not be taken there, as the table of failures says
        for component, floor in result.components_under(period_result).items():
            yield CarriedStructure(identities[component], period_result, floor)


@dataclass(frozen=True)
class VariedCase(OfStructure):
    """One case with another crack or another processing."""

    variation: "Variation"


of_variation = Columns(VariedCase)


@row("variations")
class VariationRow(CaseRow[VariedCase]):
    """One row per crack that may form, and one per processing of the record: the case with this changed alone."""

    crack: str = of_variation(
        "Crack and its place; empty for the crack of the list", lambda of: of.variation.crack
    )
    position_m: float = of_variation(
        "Height of the crack above the base; empty where it has none", lambda of: of.variation.position
    )
    processing: str = of_variation(
        "Processing of the record; empty for that of the settings", lambda of: of.variation.processing
    )
    predicted_rotation_ratio: float = of_variation(
        "Rotation ratio of its equivalent block under the pulse",
        lambda of: of.variation.predicted_rotation_ratio,
    )
    integrated_rotation_ratio: float = of_variation(
        "Rotation ratio of its mechanism under the record", lambda of: of.variation.integrated_rotation_ratio
    )


# What comes with the results ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class CandidateCase(OfStructure):
    """One mechanism of a structure, and one of the heights at which something holds it; None where nothing does.

    governs: whether the numbers of the case are its own. followed: its members; None where statics alone lists it.
    check: along its run as recorded; None where that was not followed. place: of the hold, from 0.
    """

    candidate: Candidate
    governs: bool
    followed: "FollowedCrack | None" = None
    check: "ModelCheck | None" = None
    hold: Reaction | None = None
    place: int = 0

    @property
    def at_rest(self) -> float:
        """The force of the hold as the mechanism starts, N per metre; nan where it never does."""
        starts = math.isfinite(self.candidate.uplift_multiplier)
        return float(self.hold.force[0]) if self.hold is not None and starts else math.nan

    @property
    def largest(self) -> float:
        """The largest force of the hold over the motion, N per metre; nan where it was not followed."""
        forces = self.check.holding if self.check else ()
        return forces[self.place] if self.hold is not None and self.place < len(forces) else math.nan


of_candidate_case = Columns(CandidateCase)
of_candidate = of_candidate_case.part(lambda of: of.candidate)
of_side = of_candidate_case.optional(lambda of: None if of.candidate.refusal else of.candidate.side)
of_members = of_candidate_case.optional(lambda of: of.followed.ensemble if of.followed else None)
of_hold = of_candidate_case.optional(lambda of: of.hold)


@row("mechanisms")
class MechanismRow(CaseRow[CandidateCase]):
    """One row per mechanism in which a structure may fall, and per height at which something holds it back.

    Forces are N per metre of wall, against what moves outwards positive.
    """

    mechanism: str = of_candidate("What it does, in words", lambda candidate: candidate.name)
    crack: str = of_candidate(
        "What opens and where, as in the other tables", lambda candidate: candidate.description
    )
    counts: bool = of_candidate(
        "Whether it takes part in the verdict, where it is followed", lambda candidate: candidate.counts
    )
    governs: bool = of_candidate_case(
        "Whether it governs, so that the numbers of verdicts.csv are its own", lambda of: of.governs
    )
    static_multiplier: float = of_candidate(
        "Acceleration in g at which limit analysis lets it start, with ties at the force at which they yield",
        lambda candidate: candidate.uplift_multiplier,
    )
    frequency_parameter_rad_s: float = of_side(
        "p; empty where its motion cannot be followed", lambda side: side.frequency_parameter
    )
    critical_rotation_rad: float = of_candidate(
        "Critical rotation, likewise", lambda candidate: candidate.critical_rotation
    )
    overturning_members: int | None = of_members(
        "Members that overturn in it; empty where it was not followed",
        lambda ensemble: ensemble.overturning_members,
    )
    members: int | None = of_members("Members that were followed in it", lambda ensemble: ensemble.members)
    hold: str = of_hold(
        "What holds it at a height: tie, floor or top; empty: nothing", lambda hold: hold.kind
    )
    hold_height_m: float = of_hold("That height above the ground", lambda hold: hold.height)
    hold_force_at_rest_n_per_m: float = of_candidate_case(
        "Force there as the mechanism starts; empty where ties keep it shut", lambda of: of.at_rest
    )
    largest_hold_force_n_per_m: float = of_candidate_case(
        "Largest force there over the motion as recorded, without the impacts of the wall; with them it is about 2.8 "
        "times the static force (1.9 to 4.8 in eight of ten walls)",
        lambda of: of.largest,
    )


def candidate_cases(period_result: "PeriodResult", identity: Identity) -> Iterator[CandidateCase]:
    """Yield every mechanism of a structure with each of its holds, and what was found of it; none without a result."""
    if period_result.worst is None:
        return
    from rocking.assessment.cracks import mechanisms_of  # as above: it loads what integrates

    followed = (
        {crack.description: crack for crack in period_result.ensembles.followed}
        if period_result.ensembles
        else {}
    )
    family = mechanisms_of(period_result.scene.structure)
    for candidate in family:
        only = candidate is family[0]  # which has no name where no other one may form
        own = followed.get(candidate.description) or (followed.get("") if only else None)
        governs = candidate.description == period_result.crack or (only and not period_result.crack)
        check = period_result.check_of(candidate)
        for place, hold in enumerate(candidate.reactions or (None,)):
            yield CandidateCase(identity, period_result, candidate, governs, own, check, hold, place)


@row()
class AnyCaseRow(Row):
    """A row about a case, which may not have begun; of each of the first three "" for all."""

    record: str = column(RECORD, default="")
    component: str = column(COMPONENT, default="")
    structure: str = column(STRUCTURE, default="")
    support_period_s: float | None = column(SUPPORT_PERIOD, default=None)


@row("histories")
class HistoryRow(AnyCaseRow):
    """One row per component, structure and step: the rotation as it was integrated, until it overturns."""

    time_s: float = column("Time after the first sample")
    rotation_rad: float = column("Rotation, signed by the side; zero before uplift")
    angular_velocity_rad_s: float = column("Angular velocity, at an impact the one after it")


def history_rows(
    record: str, responses: Mapping[tuple[str, str, float | None], "Response"]
) -> Iterator[HistoryRow]:
    """Yield the history of each of `RecordResult.responses`; of one without a history there are no rows."""
    for (component, structure, period), response in responses.items():
        if response.times is None or response.rotation is None or response.angular_velocity is None:
            continue
        along = np.array((response.times, response.rotation, response.angular_velocity))
        for time, rotation, angular_velocity in along.T.tolist():
            yield HistoryRow(
                record=record,
                component=component,
                structure=structure,
                support_period_s=period,
                time_s=time,
                rotation_rad=rotation,
                angular_velocity_rad_s=angular_velocity,
            )


@row("failures")
class FailureRow(AnyCaseRow):
    """One row per record or structure that gave no result, and why."""

    stage: str = column("Stage that failed")
    message: str = column("Sentence: what is wrong, what is allowed, what to do")


@row("warnings")
class WarningRow(Row):
    """One row per warning on a record, a structure or a setting; those of the study itself name no record."""

    record: str = column(f"{RECORD}; empty: of the study itself")
    about: str = column("What it is about: a component, a structure, a size of it or a setting")
    kind: Kind = column("Kind of the warning")
    sentence: str = column("The warning in words")

    @classmethod
    def on(cls, warning: RockingWarning, record: str = "", about: str = "") -> "WarningRow":
        """Return the row of a warning. about: where this is not what the warning itself says."""
        return cls(record=record, about=about or warning.about, kind=warning.kind, sentence=str(warning))

    @classmethod
    def of_study(cls, warnings: Iterable[RockingWarning]) -> "list[WarningRow]":
        """Return the rows of what there is to say of a study before it meets a record."""
        return [cls.on(warning) for warning in warnings]


@row("timings")
class TimingRow(Row):
    """One row per record and stage; differs between runs of the same input."""

    record: str = column(RECORD)
    stage: str = column("Stage of the work, or a method within the stage responses")
    duration_s: float = column("CPU time")


@dataclass(frozen=True)
class RecordRows:
    """The rows of every table of one record."""

    record: Sequence[RecordRow] = ()
    pulses: Sequence[PulseRow] = ()
    comparison: Sequence[ComparisonRow] = ()
    variations: Sequence[VariationRow] = ()
    mechanisms: Sequence[MechanismRow] = ()
    supports: Sequence[SupportRow] = ()
    failures: Sequence[FailureRow] = ()
    warnings: Sequence[WarningRow] = ()
    timings: Sequence[TimingRow] = ()
    verdicts: Sequence[VerdictRow] = ()

    @property
    def tables(self) -> dict[type[Row], Sequence[Row]]:
        """The rows by their class."""
        return {kind: getattr(self, kind.table.name) for kind in RECORD_TABLES}


RECORD_TABLES: tuple[type[Row], ...] = tuple(get_args(rows.type)[0] for rows in fields(RecordRows))
"""The rows of every table of one record, after which the fields of `RecordRows` are named."""


@contextmanager
def _as_failures(
    failures: list[FailureRow], identity: Identity, period_result: "PeriodResult"
) -> Iterator[None]:
    """Add why the rows of one structure that are made within could not be, to `failures`."""
    try:
        with one_structure(period_result.structure):
            yield
    except RockingError as error:
        failures.append(_failed(identity, period_result, "rows", str(error)))


def _failed(identity: Identity, period_result: "PeriodResult", stage: str, message: str) -> FailureRow:
    """The row of a failure of one structure under one component."""
    return FailureRow(
        record=identity.record,
        component=identity.component,
        structure=period_result.structure,
        support_period_s=period_result.support_period_s,
        stage=stage,
        message=message,
    )


def _warned(result: "RecordResult", vertical: bool) -> list[WarningRow]:
    """The warnings on the files of a record and on what was integrated under it, each once."""
    record = result.record
    warned = [
        WarningRow.on(warning, record, warning.about or name)
        for name, accelerogram in zip(result.names, result.accelerograms, strict=True)
        for warning in accelerogram.warnings
    ]
    if vertical and result.components and not any(component.vertical for component in result.components):
        warned.append(
            WarningRow.on(RockingWarning(AssessmentKind.VERTICAL_MISSING, record), record, "vertical")
        )
    warned += [
        WarningRow.on(response.warning, record, structure)
        for (_, structure, _), response in result.responses.items()
        if response.warning
    ]
    return list(dict.fromkeys(warned))


def identities_of(result: "RecordResult", settings_sha256: str = "") -> dict[str, Identity]:
    """Return what the rows about each component of a record name, by the name of the component."""
    identities = [
        Identity(
            record=result.record,
            component=accelerogram.component,
            record_sha256=accelerogram.source.sha256,
            settings_sha256=settings_sha256,
        )
        for accelerogram in result.accelerograms
    ]
    return dict(zip(result.names, identities, strict=True))


def rows_of_record(
    result: "RecordResult",
    settings_sha256: str = "",
    licence: str = "",
    vertical: bool = False,
    epicentre: Coordinates | None = None,
) -> RecordRows:
    """Return what the tables hold of a record.

    settings_sha256: names settings, structures and package.
    vertical: whether its vertical component is asked for. licence, epicentre: as the catalogue declares them.
    """
    record = result.record
    by_component = identities_of(result, settings_sha256)
    identities = [*by_component.values()]
    comparison: list[ComparisonRow] = []
    variations: list[VariationRow] = []
    failures = [
        FailureRow(record=record, component=component, stage=failure.stage, message=failure.message)
        for component, failure in result.failures
    ]
    if identities:
        by_component[BOTH_COMPONENTS] = replace(identities[0], component=BOTH_COMPONENTS)
    for component, identity in by_component.items():
        for period_result, case in result.cases(component):
            with _as_failures(failures, identity, period_result):
                if case.response is not None:
                    compared = ComparedCase(identity, period_result, case)
                    comparison.append(ComparisonRow.of(compared))
                variations += [
                    VariationRow.of(VariedCase(identity, period_result, variation))
                    for variation in case.variations
                ]
            failures += [
                _failed(identity, period_result, failure.stage, failure.message) for failure in case.failures
            ]
    verdicts = []
    mechanisms: list[MechanismRow] = []
    for period_result in result.periods:
        identity = by_component[period_result.worst.component] if period_result.worst else identities[0]
        with _as_failures(failures, identity, period_result):
            identity = replace(identity, component=period_result.component)
            verdicts.append(VerdictRow.of(OfStructure(identity, period_result)))
        with _as_failures(failures, identity, period_result):
            mechanisms += [MechanismRow.of(case) for case in candidate_cases(period_result, identity)]
    components = list(zip(identities, result.components, strict=True))
    return RecordRows(
        record=[RecordRow.of(ReadComponent(*component, licence, epicentre)) for component in components],
        pulses=[PulseRow.of(found) for component in components for found in pulses_found(*component)],
        comparison=comparison,
        variations=variations,
        failures=failures,
        warnings=_warned(result, vertical),
        timings=[
            TimingRow(record=record, stage=stage, duration_s=cpu) for stage, cpu in result.durations.items()
        ],
        verdicts=verdicts,
        mechanisms=mechanisms,
        supports=[SupportRow.of(support) for support in structures_carried(result, by_component)],
    )
