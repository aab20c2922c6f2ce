"""The rows of the tables of what becomes of the structures under one record, and all the tables of a record."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, get_args

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
    Identity,
    PulseRow,
    RecordRow,
    pulse_rows,
    record_row,
)
from rocking.catalogue.place import Coordinates
from rocking.errors import RockingError, one_structure
from rocking.sine_pulse import Regime
from rocking.tables import Row, column, row
from rocking.warnings import Kind, RockingWarning

if TYPE_CHECKING:  # else who reads a table would load numba
    from rocking.assessment.case import (
        CaseResult,
        PeriodResult,
        Prediction,
        RecordResult,
    )
    from rocking.motion.response import Response
    from rocking.structures import Structure

PEAK_SIDE = "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift"


@row()
class CaseRow(ComponentRow):
    """A row about one structure under one component of one record."""

    structure: str = column(STRUCTURE)
    support_period_s: float | None = column(SUPPORT_PERIOD)

    @property
    def case(self) -> tuple[str, str, float | None]:
        """Component, structure and period of its support."""
        return self.component, self.structure, self.support_period_s


@row()
class DecidedRow(CaseRow):
    """A row about a case that says what becomes of the structure over all components."""

    verdict: Verdict = column(f"The verdict: {', '.join(Verdict)}")
    overturning_share: float = column(
        "Largest share that overturns, of the members of each crack and the stacks that make the verdict; 0 or 1 of a "
        "single run; empty where unknown"
    )


def _of_structure(identity: Identity, period_result: "PeriodResult") -> dict[str, Any]:
    """The cells of a `CaseRow`, by name."""
    place = {"structure": period_result.structure, "support_period_s": period_result.support_period_s}
    return {**vars(identity), **place}


def _of_decided(identity: Identity, period_result: "PeriodResult") -> dict[str, Any]:
    """The cells of a `DecidedRow`, by name."""
    decided = {"verdict": period_result.verdict, "overturning_share": period_result.decision.share}
    return {**_of_structure(identity, period_result), **decided}


@row("predictions")
class PredictionRow(ComponentRow):
    """One row per structure and component: the closed form of its equivalent block, before anything is integrated."""

    structure: str = column(STRUCTURE)
    predicted_rotation_ratio: float = column("Rotation ratio of the equivalent block under the pulse")
    regime: Regime = column("Regime of the closed form")
    pulse_rank: int = column("Rank of the pulse that predicts among those of its method")
    amplitude_ratio: float = column("Amplitude ratio a = a_g/(gλ) of the pulse", equation="Eq. 16")
    frequency_ratio: float = column("Circular frequency of the pulse over p", equation="Eq. 16")


def prediction_row(identity: Identity, structure: str, prediction: "Prediction") -> PredictionRow:
    """Return the row of the closed form of one structure under one component."""
    return PredictionRow(
        **vars(identity),
        structure=structure,
        predicted_rotation_ratio=prediction.maximum.rotation_ratio,
        regime=prediction.maximum.regime,
        pulse_rank=prediction.pulse_rank,
        amplitude_ratio=prediction.amplitude_ratio,
        frequency_ratio=prediction.frequency_ratio,
    )


# What became of it ----------------------------------------------------------------------------------------


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
class ComparisonRow(DecidedRow):
    """One row per structure: the closed form under the dominant pulse and the integration of the whole record.

    The columns from the impacts on are those of the integration.
    """

    predicted_rotation_ratio: float = column("Rotation ratio of the equivalent block under the pulse")
    integrated_rotation_ratio: float = column("Rotation ratio of the mechanism under the record")
    within_factor_two: bool | None = column("Whether their ratio lies between 1/2 and 2")
    agreement: Agreement = column("Closed form against integration: same outcome, too low or too high")
    printed_rotation_ratio: float = column(
        "Rotation ratio of the paper's block under the pulse, as printed; INF where the radicand is negative, which is "
        "the paper's overturning; it may be negative, and holds in its regime alone",
        equation="Eq. 15",
    )
    printed_holds: bool | None = column(
        "Whether Eq. 15 holds there: no contact before the pulse ends, and largest, or overturning, after the first "
        "impact; or nothing lifts it"
    )
    regime: Regime | None = column("Regime of the closed form")
    uplift_multiplier: float = column(
        "Uplift acceleration in g of the mechanism of the row", equation="Eq. 7"
    )
    frequency_parameter_rad_s: float = column(
        "p of that mechanism, linearised about its critical rotation: that of the paper's block",
        equation="Eq. 11",
    )
    critical_rotation_rad: float = column("Critical rotation of that mechanism")
    restitution: float = column("Its ratio of angular velocities after and before an impact")
    block_on_record_rotation_ratio: float = column("Rotation ratio of the block under the record")
    mechanism_on_pulse_rotation_ratio: float = column("Rotation ratio of the mechanism under the pulse")
    pulse_rank: int | None = column("Rank of the pulse that predicts among those of its method")
    amplitude_ratio: float = column("Amplitude ratio a = a_g/(gλ) of the pulse", equation="Eq. 16")
    frequency_ratio: float = column("Circular frequency of the pulse over p", equation="Eq. 16")
    impacts: int | None = column("Number of impacts in the integration")
    crack: str = column(
        "Crack to which the row belongs, where it is not the structure's own but the one that governs"
    )
    statics_predicted_rotation_ratio: float = column(
        "In such a row, the closed form with the structure's own crack"
    )
    statics_integrated_rotation_ratio: float = column("Likewise the mechanism under the record")
    bearing_displacement_m: float = column(
        "Largest distance that it moves sideways below a floor, beam or vault under the record, from the bearing of "
        "this; empty where it overturns"
    )
    peak_time_s: float = column("Time of the largest rotation after the first sample")
    fall_time_s: float = column("Time at which it passes its critical rotation where it overturns")
    pulse_acts: Acts | None = column(
        "Whether the pulse acts before, during or after that fall; empty without one. After it predicted none"
    )
    fragile: bool | None = column(
        "Whether a change of 1 % in the ground motion, or chaotic motion, decides the outcome"
    )
    lifting_friction: float = column("Friction that a contact needs as the structure lifts")
    required_friction: float = column(
        "Largest friction that a contact needs; INF where it carries no pressure"
    )
    slides: bool | None = column("Whether a contact needs more friction than it has while it rocks")
    bounces: bool | None = column("Whether a contact lifts off, so that the model fails")
    ties: str = column("Which ties yield or break on the way to the largest rotation")

    @property
    def sees_fall(self) -> bool:
        """Whether the closed form falls with the integration, by a pulse that begins before the fall."""
        both_fall = self.predicted_rotation_ratio == self.integrated_rotation_ratio == math.inf
        return both_fall and self.pulse_acts is not Acts.AFTER


def comparison_row(identity: Identity, period_result: "PeriodResult", case: "CaseResult") -> ComparisonRow:
    """Return the row of one case that gave a result."""
    from rocking.assessment.cracks import cracked  # as above: it loads what integrates

    body = cracked(period_result.scene.structure, case.crack)
    response, prediction, check = case.response, case.prediction, case.check
    assert response is not None
    # The side that the pulse lifts first; without a pulse the positive one.
    side = body.mechanism().sides[-1 if prediction and prediction.pulse.amplitude > 0 else 0]
    printed = prediction.printed if prediction else None
    block = case.responses.get(Method.BLOCK_ON_RECORD)
    under_pulse = case.responses.get(Method.MECHANISM_ON_PULSE)
    both = {"predicted": case.predicted_rotation_ratio, "integrated": case.integrated_rotation_ratio}
    return ComparisonRow(
        **_of_decided(identity, period_result),
        predicted_rotation_ratio=case.predicted_rotation_ratio,
        integrated_rotation_ratio=case.integrated_rotation_ratio,
        within_factor_two=within_factor_two(**both),
        agreement=agreement(**both),
        printed_rotation_ratio=printed.rotation_ratio if printed else math.nan,
        printed_holds=printed.holds if printed else None,
        regime=prediction.maximum.regime if prediction else None,
        uplift_multiplier=side.uplift_multiplier,
        frequency_parameter_rad_s=side.frequency_parameter,
        critical_rotation_rad=side.critical_rotation,
        restitution=side.restitution,
        block_on_record_rotation_ratio=block.rotation_ratio if block else math.nan,
        mechanism_on_pulse_rotation_ratio=under_pulse.rotation_ratio if under_pulse else math.nan,
        pulse_rank=prediction.pulse_rank if prediction else None,
        amplitude_ratio=prediction.amplitude_ratio if prediction else math.nan,
        frequency_ratio=prediction.frequency_ratio if prediction else math.nan,
        impacts=response.impacts,
        crack=case.crack,
        statics_predicted_rotation_ratio=case.statics.predicted_rotation_ratio if case.statics else math.nan,
        statics_integrated_rotation_ratio=case.statics.integrated_rotation_ratio
        if case.statics
        else math.nan,
        bearing_displacement_m=_moved_from_bearing(body, response),
        peak_time_s=response.peak_time,
        fall_time_s=response.fall_time,
        pulse_acts=_acts(prediction, response.fall_time),
        fragile=response.fragile,
        lifting_friction=check.lifting_friction,
        required_friction=check.required_friction,
        slides=check.slides(period_result.scene.structure.joints.friction),
        bounces=check.bounces,
        ties=check.ties,
    )


def _moved_from_bearing(body: "Structure", response: "Response") -> float:
    """How far it moves below a floor, beam or vault under the record, m; nan where it overturns."""
    if not math.isfinite(response.rotation_ratio):
        return math.nan
    place = -1 if response.peak_side < 0 else 0
    reached = response.rotation_ratio * body.mechanism().sides[place].critical_rotation
    return float(body.linkages[place].moved_from_bearings(reached))


def _acts(prediction: "Prediction | None", fall_time: float) -> Acts | None:
    """When the pulse of a prediction acts relative to the fall of the integration."""
    if prediction is None:
        return None
    pulse = prediction.pulse
    return acts(
        start=pulse.start_time,
        end=pulse.end_time,
        fall=fall_time,
        frequency_parameter=prediction.block.frequency_parameter,
    )


RATIO_COLUMNS = {
    Method.CLOSED_FORM: "predicted_rotation_ratio",
    Method.BLOCK_ON_RECORD: "block_on_record_rotation_ratio",
    Method.MECHANISM_ON_PULSE: "mechanism_on_pulse_rotation_ratio",
    Method.MECHANISM_ON_RECORD: "integrated_rotation_ratio",
}
"""The columns of the comparison with the largest rotation by method, over the critical one; INF if it overturns."""


@row("verdicts")
class VerdictRow(DecidedRow):
    """One row per record and structure: the decision over all components, and the numbers of the crack that governs.

    The component is that of the governing case. decision, reserve: what the row prints; the reserve is None where it
    was not computed.
    """

    decision: Decision
    reserve: Reserve | None
    share_low: float = column("Least share that overturns, over the cracks and what failed or is not known")
    share_high: float = column("Largest share that overturns, likewise")
    why: str = column("Reason for the verdict")
    warnings: tuple[Kind, ...] = column("Kinds of warning: what may make it worse")
    would_settle: tuple[Kind, ...] = column("What would settle it, by kind")
    overturning_members: int = column("Number of members that overturn")
    members: int = column("Number of members that were followed; 0 without an ensemble")
    failed_members: int = column("Number of members whose integration failed")
    crack: str = column("Crack that governs, to which the numbers belong; empty where only one may form")
    statics_crack: str = column("Crack of statics where another governs; of a known crack, the worst other")
    statics_overturning_members: int | None = column("Members that overturn with that crack")
    statics_members: int | None = column("Number of members with that crack")
    rotation_ratio_low: float = column("5 % quantile of largest rotation over critical rotation")
    rotation_ratio_median: float = column("Median of largest rotation over critical rotation")
    rotation_ratio_high: float = column("95 % quantile of the same ratio; INF if it overturns")
    rotation_ratio: float = column("Largest rotation over critical rotation as recorded; INF if it overturns")
    friction_needed: float = column(
        "Friction coefficient that a contact needs while it rocks, where it has less, of what (probably) stands"
    )
    direction: str = column("Direction of the largest rotation; empty where there is only one")
    polarity: str = column("Sign of the motion of the largest rotation: as recorded, reversed; or empty")
    peak_side: int | None = column(PEAK_SIDE)
    reserve_low: float = column(
        "Factor on the record at which 5 % of the members or of the runs of contact dynamics fall; empty: not reached"
    )
    reserve_median: float = column("Factor on the record at which half of these fall; empty: not reached")
    reserve_high: float = column("Factor on the record at which 95 % of these fall; empty: not reached")
    reserve_limit: float = column(
        "Largest factor on the record that was tried; empty without a reserve (on a support it is searched for on the "
        "ground and at the worst period)"
    )
    reserve_warnings: tuple[Kind, ...] = column(
        "Kinds of warning for which the reserve may be too high: what neither members nor runs follow"
    )
    decided_by: str = column("What decides where the members disagree, with its share of the variance")
    stack_falls: int | None = column(
        "Stacks of courses, or chains of stones, that fall in contact dynamics; empty: not run"
    )
    stack_runs: int | None = column(
        "Stacks or chains that were followed, over amplitudes, time steps and directions"
    )

    @property
    def severity(self) -> Severity:
        """Key by which the worst of several comes last."""
        factor = self.reserve.low if self.reserve else math.nan
        return severity(self.decision, factor=factor, rotation_ratio=self.rotation_ratio)


def verdict_row(identity: Identity, period_result: "PeriodResult") -> VerdictRow:
    """Return the row of the decision over all components."""
    decision, ensemble, reserve = period_result.decision, period_result.ensemble, period_result.reserve
    ensembles, stacks = period_result.ensembles, period_result.stacks
    statics = ensembles.reported_statics if ensembles else None
    warnings = period_result.reserve_warnings if reserve else ()
    return VerdictRow(
        **_of_decided(identity, period_result),
        decision=decision,
        reserve=reserve,
        share_low=decision.interval[0],
        share_high=decision.interval[1],
        why=decision.why,
        warnings=tuple(warning.kind for warning in decision.warnings),
        would_settle=tuple(warning.kind for warning in decision.would_settle),
        overturning_members=ensemble.overturning_members,
        members=ensemble.members,
        failed_members=ensemble.failed_members,
        crack=period_result.crack,
        statics_crack=statics.description if statics else "",
        statics_overturning_members=statics.ensemble.overturning_members if statics else None,
        statics_members=statics.ensemble.members if statics else None,
        rotation_ratio_low=ensemble.rotation_ratio_low,
        rotation_ratio_median=ensemble.rotation_ratio_median,
        rotation_ratio_high=ensemble.rotation_ratio_high,
        rotation_ratio=period_result.rotation_ratio,
        friction_needed=period_result.friction_needed,
        direction=period_result.direction,
        polarity=POLARITIES.get(ensemble.worst("polarity"), ""),
        peak_side=period_result.peak_side,
        reserve_low=reserve.low if reserve else math.nan,
        reserve_median=reserve.median if reserve else math.nan,
        reserve_high=reserve.high if reserve else math.nan,
        reserve_limit=reserve.limit if reserve else math.nan,
        reserve_warnings=tuple(warning.kind for warning in warnings),
        decided_by=period_result.decided_by,
        stack_falls=stacks.falls if stacks else None,
        stack_runs=stacks.runs if stacks else None,
    )


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


@row("supports")
class SupportRow(DecidedRow):
    """One row per component and structure on a support: the motion there, and the verdict over all components."""

    support: str = column("Name of the support in the list")
    floor_peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration on the support")
    amplification: float = column("Peak acceleration on the support over that of the ground")
    floor_spectral_acceleration_m_s2: float = column("5 % floor spectrum at the period of the support")
    code_spectral_acceleration_m_s2: float = column(
        "The same by the code's formula from the ground's spectrum", equation="C7.2.5"
    )


def support_rows(result: "RecordResult", identities: Mapping[str, Identity]) -> Iterator[SupportRow]:
    """Yield the row of every structure on a support under each component. identities: of the components, by name."""
    for period_result in (period_result for scene in result.carried for period_result in scene.periods):
        if period_result.support is not None and period_result.support not in result.floors:
            continue  # the record could not be taken there, as the table of failures says
        place = period_result.scene.place
        for component, floor in result.components_under(period_result).items():
            ground = (floor.ground or floor).accelerogram
            period = period_result.support_period_s or 0.0
            measures = place.measures(period, ground=ground, there=floor.accelerogram)
            yield SupportRow(
                **_of_decided(identities[component], period_result),
                support=place.name,
                floor_peak_acceleration_m_s2=measures.peak_acceleration,
                amplification=measures.amplification,
                floor_spectral_acceleration_m_s2=measures.spectral_acceleration,
                code_spectral_acceleration_m_s2=measures.code_spectral_acceleration,
            )


@row("variations")
class VariationRow(CaseRow):
    """One row per crack that may form, and one per processing of the record: the case with this changed alone."""

    crack: str = column("Crack and its place; empty for the crack of the list")
    position_m: float = column("Height of the crack above the base; empty where it has none")
    processing: str = column("Processing of the record; empty for that of the settings")
    predicted_rotation_ratio: float = column("Rotation ratio of its equivalent block under the pulse")
    integrated_rotation_ratio: float = column("Rotation ratio of its mechanism under the record")


def variation_rows(
    identity: Identity, period_result: "PeriodResult", case: "CaseResult"
) -> Iterator[VariationRow]:
    """Yield the row of each variation of a case."""
    for variation in case.variations:
        yield VariationRow(
            **_of_structure(identity, period_result),
            crack=variation.crack,
            position_m=variation.position,
            processing=variation.processing,
            predicted_rotation_ratio=variation.predicted_rotation_ratio,
            integrated_rotation_ratio=variation.integrated_rotation_ratio,
        )


# What comes with the results ---------------------------------------------------------------------------------------


@row("mechanisms")
class MechanismRow(CaseRow):
    """One row per mechanism in which a structure may fall, and per height at which something holds it back.

    Forces are N per metre of wall, against what moves outwards positive.
    """

    mechanism: str = column("What it does, in words")
    crack: str = column("What opens and where, as in the other tables")
    counts: bool = column("Whether it takes part in the verdict, where it is followed")
    governs: bool = column("Whether it governs, so that the numbers of verdicts.csv are its own")
    static_multiplier: float = column(
        "Acceleration in g at which limit analysis lets it start, with ties at the force at which they yield"
    )
    frequency_parameter_rad_s: float = column("p; empty where its motion cannot be followed")
    critical_rotation_rad: float = column("Critical rotation, likewise")
    overturning_members: int | None = column("Members that overturn in it; empty where it was not followed")
    members: int | None = column("Members that were followed in it")
    hold: str = column("What holds it at a height: tie, floor or top; empty: nothing")
    hold_height_m: float = column("That height above the ground")
    hold_force_at_rest_n_per_m: float = column(
        "Force there as the mechanism starts; empty where ties keep it shut"
    )
    largest_hold_force_n_per_m: float = column(
        "Largest force there over the motion as recorded, without the impacts of the wall; with them it is about 2.8 "
        "times the static force (1.9 to 4.8 in eight of ten walls)"
    )


def mechanism_rows(identity: Identity, period_result: "PeriodResult") -> Iterator[MechanismRow]:
    """Yield the rows of every mechanism of a structure, one for each of its holds; none without a result."""
    if period_result.worst is None:
        return
    from rocking.assessment.cracks import mechanisms_of  # as above: it loads what integrates

    ensembles = period_result.ensembles
    followed = {crack.description: crack for crack in ensembles.followed} if ensembles else {}
    family = mechanisms_of(period_result.scene.structure)
    for candidate in family:
        only = candidate is family[0]  # which has no name where no other one may form
        own = followed.get(candidate.description) or (followed.get("") if only else None)
        check = period_result.check_of(candidate)
        forces = check.holding if check else ()
        starts = math.isfinite(candidate.uplift_multiplier)
        for place, hold in enumerate(candidate.reactions or (None,)):
            yield MechanismRow(
                **_of_structure(identity, period_result),
                mechanism=candidate.name,
                crack=candidate.description,
                counts=candidate.counts,
                governs=candidate.description == period_result.crack or (only and not period_result.crack),
                static_multiplier=candidate.uplift_multiplier,
                frequency_parameter_rad_s=math.nan
                if candidate.refusal
                else candidate.side.frequency_parameter,
                critical_rotation_rad=candidate.critical_rotation,
                overturning_members=own.ensemble.overturning_members if own else None,
                members=own.ensemble.members if own else None,
                hold=hold.kind if hold else "",
                hold_height_m=hold.height if hold else math.nan,
                hold_force_at_rest_n_per_m=float(hold.force[0]) if hold and starts else math.nan,
                largest_hold_force_n_per_m=forces[place] if hold and place < len(forces) else math.nan,
            )


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


def identities_of(result: "RecordResult", settings_sha256: str) -> dict[str, Identity]:
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
                    comparison.append(comparison_row(identity, period_result, case))
                variations += variation_rows(identity, period_result, case)
            failures += [
                _failed(identity, period_result, failure.stage, failure.message) for failure in case.failures
            ]
    verdicts = []
    mechanisms: list[MechanismRow] = []
    for period_result in result.periods:
        identity = by_component[period_result.worst.component] if period_result.worst else identities[0]
        with _as_failures(failures, identity, period_result):
            identity = replace(identity, component=period_result.component)
            verdicts.append(verdict_row(identity, period_result))
        with _as_failures(failures, identity, period_result):
            mechanisms += mechanism_rows(identity, period_result)
    components = list(zip(identities, result.components, strict=True))
    return RecordRows(
        record=[record_row(*component, licence, epicentre) for component in components],
        pulses=[row for component in components for row in pulse_rows(*component)],
        comparison=comparison,
        variations=variations,
        failures=failures,
        warnings=_warned(result, vertical),
        timings=[
            TimingRow(record=record, stage=stage, duration_s=cpu) for stage, cpu in result.durations.items()
        ],
        verdicts=verdicts,
        mechanisms=mechanisms,
        supports=[*support_rows(result, by_component)],
    )
