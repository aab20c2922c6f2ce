"""The rows of the tables of one record: each class says what its columns are, a function beside it fills them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rocking.assessment.reserve import Reserve
from rocking.assessment.rows.meanings import (
    COMPONENT,
    OVERTURNING_SHARE,
    PEAK_SIDE,
    RECORD,
    RECORD_SHA256,
    SCALE_FACTOR,
    STRUCTURE,
    VERDICT,
)
from rocking.assessment.verdict import (
    BOTH_COMPONENTS,
    POLARITIES,
    Agreement,
    Judgement,
    Method,
    Verdict,
    agreement,
    ratio,
    ratio_in_words,
    within_factor_two,
)
from rocking.floors.spectrum import FLOOR_DAMPING, floor_spectrum, has_code_spectrum, spectrum_of
from rocking.pulses import Pulse, PulseEvidence
from rocking.pulses.analysis import worth
from rocking.records import Accelerogram
from rocking.records.measures import record_measures
from rocking.remarks import Kind
from rocking.sine_pulse import Regime
from rocking.structures import Outcome, Structure
from rocking.tables import Row, column, row, write_tables, written_together

if TYPE_CHECKING:  # else who reads a table would load numba
    from rocking.assessment.case import CaseResult, Failure, RecordResult, StationResult
    from rocking.assessment.component import Component
    from rocking.assessment.cracks import CrackEnsembles
    from rocking.assessment.variations import Variation
    from rocking.motion.response import Response


@row()
class ComponentRow(Row):
    """A row about one component of one record; without more columns, what names and hashes all of them share."""

    record: str = column(RECORD)
    component: str = column(COMPONENT)
    scale_factor: float = column(SCALE_FACTOR, last=True)
    record_sha256: str = column(RECORD_SHA256, last=True)
    settings_sha256: str = column("SHA-256 of settings, structures and package behind the row", last=True)


def identity_of(record: str, accelerogram: Accelerogram, settings_sha256: str) -> ComponentRow:
    """Return what every row about a component of `record` holds."""
    return ComponentRow(
        record=record,
        component=accelerogram.component,
        scale_factor=accelerogram.scale_factor,
        record_sha256=accelerogram.source.sha256,
        settings_sha256=settings_sha256,
    )


@row()
class CaseRow(ComponentRow):
    """A row about one structure under one component of one record."""

    structure: str = column(STRUCTURE)

    @property
    def case(self) -> tuple[str, str]:
        """Component and structure."""
        return self.component, self.structure


@row()
class MembersRow(CaseRow):
    """A row about the members of the ensemble that speaks for a case."""

    verdict: Verdict = column(VERDICT)
    overturning_members: int = column("Number of members that overturn")
    members: int = column("Number of members; 0 without an ensemble")
    overturning_share: float = column(OVERTURNING_SHARE)
    crack: str = column("Crack that governs, to which the numbers belong; empty where only one may form")
    statics_crack: str = column(
        "Crack of statics where another governs; beside a crack that is given, the worst other"
    )
    statics_overturning_members: int | None = column("Members that overturn with that crack")
    statics_members: int | None = column("Number of members with that crack")
    rotation_ratio_low: float = column("5 % quantile of largest rotation over critical rotation")
    rotation_ratio_median: float = column("Median of largest rotation over critical rotation")
    rotation_ratio_high: float = column("95 % quantile of the same ratio; INF if it overturns")


@row("record")
class RecordRow(ComponentRow):
    """One row per component: what was read and what was done to it before use."""

    event: str = column("Earthquake")
    magnitude: float | None = column("Magnitude of the earthquake; empty where nothing states it")
    epicentral_distance_m: float | None = column("Distance to the epicentre; empty where nothing states it")
    magnitude_type: str = column("Scale of the magnitude; empty where nothing states it")
    event_time: str = column(
        "Date of the earthquake, and its time as far as the file says it, ISO 8601 in the zone of the file"
    )
    station: str = column("Recording station")
    station_latitude_deg: float | None = column("Latitude of the station, north")
    station_longitude_deg: float | None = column("Longitude of the station, east")
    start_time: str = column("Time of the first sample, as the file states it")
    file: str = column("File of the record")
    format: str = column("Format of the file")
    unit: str = column("Unit of the numbers in the file")
    licence: str = column("Licence of the record, as the catalogue declares it")
    vertical_component: str = column("Vertical component that acts as well; empty where none acts")
    vertical_peak_acceleration_m_s2: float = column("Largest magnitude of the vertical acceleration")
    samples: int = column("Number of samples")
    time_step_s: float = column("Time step")
    duration_s: float = column("Time from the first to the last sample")
    peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration")
    peak_velocity_m_s: float = column("Largest magnitude of the velocity, by the trapezoidal rule")
    peak_displacement_m: float = column("Largest magnitude of the displacement, by the same rule")
    arias_intensity_m_s: float = column("Arias intensity", equation="π/(2g) ∫a² dt")
    significant_duration_s: float = column("Time between 5 and 95 % of the Arias intensity (D5–95)")
    rotd50_peak_acceleration_m_s2: float = column("Peak acceleration of the pair, median over directions")
    rotd100_peak_acceleration_m_s2: float = column("Peak acceleration of the pair, largest over directions")
    velocity_pulse_period_s: float = column("Period T_p of the velocity pulse (Shahi & Baker 2014)")
    velocity_pulse_peak_velocity_m_s: float = column("Peak velocity along the axis of the velocity pulse")
    velocity_pulse_orientation_rad: float = column("Axis of the velocity pulse, from the first component")
    velocity_pulse_azimuth_deg: float = column("Axis of the velocity pulse, clockwise from north")
    velocity_pulse_indicator: float = column("Pulse indicator of Shahi & Baker (2014)")
    velocity_pulse_like: bool | None = column("Whether Shahi & Baker call the motion pulse-like")
    pulse_period_ratio: float = column("Period of the dominant sine pulse over T_p")
    pulse_periods_unlike: bool | None = column("Whether these periods differ by more than a factor of 2")
    high_pass_frequency_hz: float | None = column("Corner of the high-pass that the file or catalogue states")
    processing: tuple[str, ...] = column("Steps applied to the numbers of the file, in order")
    warnings: tuple[str, ...] = column("Warnings of the reader about the file")


@row("pulses")
class PulseRow(ComponentRow):
    """One row per sine pulse of acceleration; rank 1 of kind alternative is the dominant pulse."""

    kind: str = column(
        "alternative: ranked on the record; sequence: pursued on the residual of the pulses before it; "
        "predicting: the pulse that predicts, where it is no alternative"
    )
    rank: int = column("Rank among the pulses of its kind, from 1")
    amplitude_m_s2: float = column("Signed amplitude a_g of the pulse")
    circular_frequency_rad_s: float = column("Circular frequency of the pulse")
    period_s: float = column("Period of the pulse")
    start_time_s: float = column("Start of the pulse after the first sample")
    gain_m2_s3: float = column("Energy gain of the matched filter")
    gain_ratio: float = column("Energy gain over that of the dominant pulse")
    explained_energy: float = column("Share of the acceleration energy that the pulse explains (EVa)")
    same_outcome_share: float = column("Share of cases with such pulses that end as the integration does")
    effective_length_m: float = column("Length scale: amplitude times period squared")
    flags: tuple[str, ...] = column("Reasons to doubt the pulse")

    @property
    def ranked(self) -> bool:
        """Whether it is one of the ranked alternatives."""
        return self.kind == "alternative"

    @property
    def pulse(self) -> Pulse:
        """The pulse itself."""
        return Pulse(self.amplitude_m_s2, self.circular_frequency_rad_s, self.start_time_s)


@row("comparison")
class ComparisonRow(CaseRow):
    """One row per structure: the closed form under the dominant pulse beside the integration of the whole record.

    The columns from the impacts to the warning are those of the integration.
    """

    predicted_rotation_ratio: float = column("Rotation ratio of the equivalent block under the pulse")
    integrated_rotation_ratio: float = column("Rotation ratio of the mechanism under the record")
    prediction_over_integration: float = column("Predicted over integrated rotation ratio, where both rock")
    prediction_in_words: str = column("Prediction beside integration, in words")
    within_factor_two: bool | None = column("Whether their ratio lies between 1/2 and 2")
    agreement: Agreement = column("Closed form against integration: same outcome, too low or too high")
    regime: Regime | None = column("Regime of the closed form")
    predicted_arc_ratio: float = column(
        "The same in the x of the block: its arc over the critical one, or the rotation ratio where it is linearised"
    )
    block_frequency_parameter_rad_s: float = column("p of the block that predicts, of the side lifted first")
    block_acceleration_scale: float = column("Acceleration scale φ_cr/λ of the block on that side")
    block_uplift_multiplier: float = column("Uplift acceleration of the block in g on that side")
    block_restitution: float = column("Ratio of angular velocities of the block after and before an impact")
    printed_rotation_ratio: float = column(
        "Rotation ratio by the source paper: its block with the scale a_sc", equation="Eqs. 11, 15"
    )
    printed_uplift_rotation_ratio: float = column(
        "Rotation ratio by the source paper: its block with the scale a_sc,alt", equation="Eqs. 13, 15"
    )
    block_on_record_rotation_ratio: float = column("Rotation ratio of the block under the record")
    mechanism_on_pulse_rotation_ratio: float = column("Rotation ratio of the mechanism under the pulse")
    pulse_rank: int | None = column("Rank of the pulse that predicts among those of its method")
    amplitude_ratio: float = column("Amplitude ratio a = a_g/(gλ) of the pulse", equation="Eq. 16")
    frequency_ratio: float = column("Circular frequency of the pulse over p", equation="Eq. 16")
    impacts: int | None = column("Number of impacts in the integration")
    peak_side: int | None = column(PEAK_SIDE)
    peak_time_s: float = column("Time of the largest rotation after the first sample")
    fragile: bool | None = column(
        "Whether a change of the ground motion by 1 % decides the outcome, or chaos does"
    )
    tolerance: float = column("Tolerance of the integration: a fragile run is repeated at 1e-9; 0: exact")
    required_friction: float = column("Largest friction that a contact needs; INF without pressure")
    slides: bool | None = column("Whether a contact slides, so that the model fails")
    bounces: bool | None = column("Whether a contact lifts off, so that the model fails")
    ties: str = column("Which ties yield or break on the way to the largest rotation")
    warning: str = column("Warning about what the model leaves out; or empty")
    answer_method: Method = column("Method that settled the verdict; see the setting fidelity")
    answer_outcome: Outcome = column("Outcome of that method: no uplift, rocks or overturns")
    answer_reason: str = column("Reason why that method sufficed, with fidelity: auto")
    overturning_estimate: float = column("Overturning share by p PGV/(gλ), where no ensemble ran")
    overturning_estimate_low: float = column("Lower end of the 90 % interval of the estimate")
    overturning_estimate_high: float = column("Upper end of the 90 % interval of the estimate")


RATIO_COLUMNS = {
    Method.PRINTED: "printed_rotation_ratio",
    Method.PRINTED_UPLIFT: "printed_uplift_rotation_ratio",
    Method.CLOSED_FORM: "predicted_rotation_ratio",
    Method.BLOCK_ON_RECORD: "block_on_record_rotation_ratio",
    Method.MECHANISM_ON_PULSE: "mechanism_on_pulse_rotation_ratio",
    Method.MECHANISM_ON_RECORD: "integrated_rotation_ratio",
}
"""The columns of the comparison with the largest rotation by method, over the critical one; INF if it overturns."""


@row("ensemble")
class EnsembleRow(MembersRow):
    """One row per structure: its ensemble over the uncertain inputs; component 'both' for all directions."""

    failed_members: int = column("Number of members whose integration failed")
    risk: float = column("Largest probability of an opposite outcome in a verdict")
    amplitude_range: float = column("Range of the amplitude: plus or minus this share")
    restitution_range: float = column("Range of the restitution: plus or minus this number")
    worst_direction: str = column("Direction of the largest mean rotation; empty with one")
    worst_polarity: str = column("Sign of the largest mean rotation: as recorded, reversed")
    worst_processing: str = column("Processing of the largest mean rotation; empty with one")


@row("verdicts")
class VerdictRow(MembersRow, Judgement):
    """One row per record and structure: the verdict over all components, its count and its reason.

    The component is that of the governing case.
    """

    rotation_ratio: float = column("Largest rotation over critical rotation as recorded; INF if it overturns")
    direction: str = column("Direction of the largest rotation; empty with one")
    polarity: str = column("Sign of the motion of the largest rotation: as recorded, reversed; or empty")
    peak_side: int | None = column(PEAK_SIDE)
    reserve_low: float = column("Factor on the record at which 5 % of the members overturn; empty: none")
    reserve_median: float = column("Factor on the record at which half of the members overturn; empty: none")
    reserve_high: float = column("Factor on the record at which 95 % of the members overturn; empty: none")
    reserve_limit: float = column(
        "Largest factor on the record that was tried; empty without a reserve (on a support, but at its worst period)"
    )
    reserve_doubts: tuple[Kind, ...] = column(
        "Kinds of doubt for which the reserve may be too high: it is that of the mechanism alone"
    )
    decided_by: str = column("What decides an undecided case, with its share of the variance")
    why: str = column("Reason for the verdict")
    stack_falls: int | None = column("Stacks of courses that fall in contact dynamics; empty: not asked")
    stack_runs: int | None = column("Stacks that were followed, over amplitudes, time steps and directions")

    @property
    def reserve(self) -> Reserve | None:
        """The reserve, whose factors are nan where they were not reached; None where it was not sought."""
        if math.isnan(self.reserve_limit):
            return None
        return Reserve(self.reserve_low, self.reserve_median, self.reserve_high, self.reserve_limit)


@row("supports")
class SupportRow(CaseRow):
    """One row per component and structure on a support: the motion there, and the verdict over all components."""

    listed_structure: str = column("Name of the structure in the list, without its period")
    support: str = column("Name of the support in the list")
    support_period_s: float = column("First period T_b of the support; 0 on the ground")
    support_damping_ratio: float = column("Damping ratio of the first mode of the support")
    support_participation: float = column("Participation Γψ of the first mode where the structure stands")
    support_modes: int = column("Number of modes of the support; 0 on the ground")
    floor_peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration on the support")
    amplification: float = column("Peak acceleration on the support over that of the ground")
    floor_spectral_acceleration_m_s2: float = column("5 % floor spectrum at the period of the support")
    code_spectral_acceleration_m_s2: float = column(
        "The same by the code's formula from the ground's spectrum", equation="C7.2.5"
    )
    floor_pulse_amplitude_m_s2: float = column("Signed amplitude of the dominant sine on the support")
    floor_pulse_period_s: float = column("Period of the dominant sine on the support")
    verdict: Verdict = column(VERDICT)
    overturning_share: float = column(OVERTURNING_SHARE)


@row("variations")
class VariationRow(CaseRow):
    """One row per crack that may form, and one per processing of the record: the case with this changed alone."""

    crack: str = column("Crack and its place; empty for the crack of the list")
    position_m: float = column("Height of the crack above the base; empty where it has none")
    processing: str = column("Processing of the record; empty for that of the settings")
    predicted_rotation_ratio: float = column("Rotation ratio of its equivalent block under the pulse")
    integrated_rotation_ratio: float = column("Rotation ratio of its mechanism under the record")


@row("histories")
class HistoryRow(Row):
    """One row per component, structure and step: the rotation as it was integrated, until it overturns."""

    record: str = column(RECORD)
    component: str = column(COMPONENT)
    structure: str = column(STRUCTURE)
    time_s: float = column("Time after the first sample")
    rotation_rad: float = column("Rotation, signed by the side; zero before uplift")
    angular_velocity_rad_s: float = column("Angular velocity, at an impact the one after it")


@row("failures")
class FailureRow(Row):
    """One row per record or structure that gave no result, and why."""

    record: str = column(RECORD)
    component: str = column(COMPONENT)
    structure: str = column(STRUCTURE)
    stage: str = column("Stage that failed")
    message: str = column("Sentence: what is wrong, what is allowed, what to do")


@row("timings")
class TimingRow(Row):
    """One row per record and stage; differs between runs of the same input."""

    record: str = column(RECORD)
    stage: str = column("Stage of the work, or a method within the stage responses")
    duration_s: float = column("CPU time")


# Whole on purpose: a row, column by column.
def record_row(identity: ComponentRow, component: "Component", licence: str) -> RecordRow:
    """Return the row of one component: what was read, done and measured."""
    accelerogram = component.accelerogram
    vertical = component.vertical
    vertical_component = ""
    vertical_peak_acceleration = math.nan
    if vertical:
        vertical_component = vertical.component or "not named"
        vertical_peak_acceleration = vertical.peak_acceleration
    measures = record_measures(accelerogram)
    pulse = component.motion.velocity_pulse
    velocity_pulse_peak_velocity = pulse.peak_velocity if pulse else math.nan
    rotd = component.motion.rotd
    dominant = component.analysis.dominant if component.analysis else None
    pulse_period_ratio = math.nan
    pulse_periods_unlike = None
    if pulse and dominant:
        pulse_period_ratio = dominant.period / pulse.period
        pulse_periods_unlike = pulse.is_unlike(dominant)
    return RecordRow(
        record=identity.record,
        component=identity.component,
        event=accelerogram.event,
        magnitude=accelerogram.magnitude,
        epicentral_distance_m=accelerogram.epicentral_distance,
        magnitude_type=accelerogram.magnitude_type,
        event_time=accelerogram.event_time,
        station=accelerogram.station,
        station_latitude_deg=accelerogram.latitude,
        station_longitude_deg=accelerogram.longitude,
        start_time=accelerogram.start_time,
        file=accelerogram.source.path,
        format=accelerogram.source.format,
        unit=accelerogram.source.unit,
        licence=licence,
        vertical_component=vertical_component,
        vertical_peak_acceleration_m_s2=vertical_peak_acceleration,
        samples=accelerogram.acceleration.size,
        time_step_s=accelerogram.time_step,
        duration_s=accelerogram.duration,
        peak_acceleration_m_s2=measures.peak_acceleration,
        peak_velocity_m_s=measures.peak_velocity,
        peak_displacement_m=measures.peak_displacement,
        arias_intensity_m_s=measures.arias_intensity,
        significant_duration_s=measures.significant_duration,
        rotd50_peak_acceleration_m_s2=rotd.rotd50 if rotd else math.nan,
        rotd100_peak_acceleration_m_s2=rotd.rotd100 if rotd else math.nan,
        velocity_pulse_period_s=pulse.period if pulse else math.nan,
        velocity_pulse_peak_velocity_m_s=velocity_pulse_peak_velocity,
        velocity_pulse_orientation_rad=pulse.orientation if pulse else math.nan,
        velocity_pulse_azimuth_deg=_or_nan(component.motion.velocity_pulse_azimuth),
        velocity_pulse_indicator=pulse.indicator if pulse else math.nan,
        velocity_pulse_like=pulse.pulse_like if pulse else None,
        pulse_period_ratio=pulse_period_ratio,
        pulse_periods_unlike=pulse_periods_unlike,
        high_pass_frequency_hz=accelerogram.high_pass_frequency,
        processing=accelerogram.processing,
        warnings=accelerogram.warnings,
        scale_factor=identity.scale_factor,
        record_sha256=identity.record_sha256,
        settings_sha256=identity.settings_sha256,
    )


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def pulse_rows(identity: ComponentRow, component: "Component") -> Iterator[PulseRow]:
    """Yield the rows of the ranked alternatives, the dominant pulse first, then those of the pursuit sequence.

    Pulses that predict, but are not among the alternatives, follow.
    """
    analysis = component.analysis
    if analysis is None:
        return
    others = [evidence for evidence in component.candidates if evidence not in analysis.ranked]
    kinds: dict[str, Sequence[PulseEvidence]] = {
        "alternative": analysis.ranked,
        "sequence": analysis.sequence,
        "predicting": others,
    }
    for kind, pulses in kinds.items():
        for rank, evidence in enumerate(pulses, start=1):
            dominant = evidence is analysis.evidence and kind == "alternative"
            pulse = evidence.pulse
            same_outcome_share = worth(evidence.explained_energy)
            gain_ratio = evidence.gain / analysis.evidence.gain
            yield PulseRow(
                record=identity.record,
                component=identity.component,
                kind=kind,
                rank=rank,
                amplitude_m_s2=pulse.amplitude,
                circular_frequency_rad_s=pulse.circular_frequency,
                period_s=pulse.period,
                start_time_s=pulse.start_time,
                gain_m2_s3=evidence.gain,
                gain_ratio=gain_ratio,
                explained_energy=evidence.explained_energy,
                same_outcome_share=same_outcome_share,
                effective_length_m=evidence.effective_length,
                flags=analysis.flags if dominant else (),
                scale_factor=identity.scale_factor,
                record_sha256=identity.record_sha256,
                settings_sha256=identity.settings_sha256,
            )


# Whole on purpose: a row, column by column.
def comparison_row(identity: ComponentRow, case: "CaseResult", friction_coefficient: float) -> ComparisonRow:
    """Return the row of one case that gave a result: the closed form beside the integration of the whole record."""
    assert case.answer is not None
    predicted = case.predicted_rotation_ratio
    integrated = case.integrated_rotation_ratio
    prediction_over_integration = ratio(predicted, integrated)
    prediction_in_words = ratio_in_words(predicted, integrated)
    by_method = {method: response.rotation_ratio for method, response in case.responses.items()}
    block_on_record = by_method.get(Method.BLOCK_ON_RECORD, math.nan)
    mechanism_on_pulse = by_method.get(Method.MECHANISM_ON_PULSE, math.nan)
    prediction = case.prediction
    block = prediction.side if prediction else None
    response = case.response
    estimate = case.overturning_estimate
    return ComparisonRow(
        record=identity.record,
        component=identity.component,
        structure=case.structure,
        predicted_rotation_ratio=predicted,
        integrated_rotation_ratio=integrated,
        prediction_over_integration=prediction_over_integration,
        prediction_in_words=prediction_in_words,
        within_factor_two=within_factor_two(predicted, integrated),
        agreement=agreement(predicted, integrated),
        regime=prediction.maximum.regime if prediction else None,
        predicted_arc_ratio=prediction.largest_x if prediction else math.nan,
        block_frequency_parameter_rad_s=block.frequency_parameter if block else math.nan,
        block_acceleration_scale=block.acceleration_scale if block else math.nan,
        block_uplift_multiplier=block.uplift_multiplier if block else math.nan,
        block_restitution=block.restitution if block else math.nan,
        printed_rotation_ratio=prediction.printed_rotation_ratio if prediction else math.nan,
        printed_uplift_rotation_ratio=prediction.printed_uplift_rotation_ratio if prediction else math.nan,
        block_on_record_rotation_ratio=block_on_record,
        mechanism_on_pulse_rotation_ratio=mechanism_on_pulse,
        pulse_rank=prediction.pulse_rank if prediction else None,
        amplitude_ratio=prediction.amplitude_ratio if prediction else math.nan,
        frequency_ratio=prediction.frequency_ratio if prediction else math.nan,
        impacts=response.impacts if response else None,
        peak_side=response.peak_side if response else None,
        peak_time_s=response.peak_time if response else math.nan,
        fragile=response.fragile if response else None,
        tolerance=response.tolerance if response else math.nan,
        required_friction=case.check.required_friction,
        slides=case.check.slides(friction_coefficient),
        bounces=case.check.bounces,
        ties=case.check.ties,
        warning=response.warning if response else "",
        answer_method=case.answer.method,
        answer_outcome=case.answer.outcome,
        answer_reason=case.answer.reason,
        overturning_estimate=estimate.share if estimate else math.nan,
        overturning_estimate_low=estimate.low if estimate else math.nan,
        overturning_estimate_high=estimate.high if estimate else math.nan,
        scale_factor=identity.scale_factor,
        record_sha256=identity.record_sha256,
        settings_sha256=identity.settings_sha256,
    )


def ensemble_row(identity: ComponentRow, structure: str, ensembles: "CrackEnsembles") -> EnsembleRow:
    """Return the row of the ensemble of the crack that governs."""
    governing = ensembles.governing
    ensemble = governing.ensemble
    statics = ensembles.beside
    statics_crack = statics.description if statics else ""
    worst_direction = ensemble.worst("direction")
    worst_polarity = POLARITIES.get(ensemble.worst("polarity"), "")
    worst_processing = ensemble.worst("processing")
    return EnsembleRow(
        record=identity.record,
        component=identity.component,
        structure=structure,
        verdict=ensembles.verdict,
        overturning_members=ensemble.overturning_members,
        members=ensemble.members,
        overturning_share=ensemble.overturning_share,
        crack=governing.description,
        statics_crack=statics_crack,
        statics_overturning_members=statics.ensemble.overturning_members if statics else None,
        statics_members=statics.ensemble.members if statics else None,
        rotation_ratio_low=ensemble.rotation_ratio_low,
        rotation_ratio_median=ensemble.rotation_ratio_median,
        rotation_ratio_high=ensemble.rotation_ratio_high,
        failed_members=ensemble.failed_members,
        risk=ensemble.settings.risk,
        amplitude_range=ensemble.settings.amplitude_range,
        restitution_range=ensemble.settings.restitution_range,
        worst_direction=worst_direction,
        worst_polarity=worst_polarity,
        worst_processing=worst_processing,
        scale_factor=identity.scale_factor,
        record_sha256=identity.record_sha256,
        settings_sha256=identity.settings_sha256,
    )


def verdict_row(identity: ComponentRow, station: "StationResult") -> VerdictRow:
    """Return what became of one structure. identity: of the component that rotates most."""
    reserve = station.reserve
    return VerdictRow(
        record=identity.record,
        component=station.component,
        structure=station.structure,
        verdict=station.verdict,
        overturning_members=station.overturning_members,
        members=station.members,
        overturning_share=station.overturning_share,
        crack=station.crack,
        statics_crack=station.statics_crack,
        statics_overturning_members=station.statics_overturning_members,
        statics_members=station.statics_members,
        rotation_ratio_low=station.rotation_ratio_low,
        rotation_ratio_median=station.rotation_ratio_median,
        rotation_ratio_high=station.rotation_ratio_high,
        rotation_ratio=station.rotation_ratio,
        direction=station.direction,
        polarity=station.polarity,
        peak_side=station.peak_side,
        reserve_low=reserve.low if reserve else math.nan,
        reserve_median=reserve.median if reserve else math.nan,
        reserve_high=reserve.high if reserve else math.nan,
        reserve_limit=reserve.limit if reserve else math.nan,
        reserve_doubts=tuple(each.kind for each in station.reserve_doubts) if reserve else (),
        decided_by=station.decided_by,
        why=station.why,
        stack_falls=station.stack_falls,
        stack_runs=station.stack_runs,
        scale_factor=identity.scale_factor,
        record_sha256=identity.record_sha256,
        settings_sha256=identity.settings_sha256,
    )


# Whole on purpose: a row, column by column.
def support_rows(result: "RecordResult", identities: Mapping[str, ComponentRow]) -> Iterator[SupportRow]:
    """Yield the rows of every structure on a support. identities: what rows about a component hold, by its name."""
    for structure, station in result.stations.items():
        standing = station.body.standing if isinstance(station.body, Structure) else None
        if standing is None:
            continue
        if standing.support is not None and standing.support not in result.floors:
            continue  # the record could not be taken there, as the table of failures says
        for component, floor in result.components_under(structure).items():
            ground = (floor.ground or floor).accelerogram
            identity = identities[component]
            mode = standing.support.modes[0] if standing.support else None
            pulse = floor.analysis.evidence.pulse if floor.analysis else None
            floor_pulse_period = pulse.period if pulse else math.nan
            peak = floor.accelerogram.peak_acceleration
            amplification = peak / ground.peak_acceleration if ground.peak_acceleration else math.nan
            floor_spectral_acceleration = math.nan
            code_spectral_acceleration = math.nan
            if standing.support is not None:
                spectrum = spectrum_of(floor.accelerogram)
                floor_spectral_acceleration = spectrum(standing.period, FLOOR_DAMPING)
            if standing.support is not None and has_code_spectrum(standing.support):
                places = np.array([standing.period])
                by_code = floor_spectrum(standing.support, places, FLOOR_DAMPING, spectrum_of(ground))
                code_spectral_acceleration = by_code[0]
            yield SupportRow(
                record=identity.record,
                component=identity.component,
                structure=structure,
                listed_structure=standing.listed_structure,
                support=standing.place,
                support_period_s=standing.period,
                support_damping_ratio=mode.damping_ratio if mode else math.nan,
                support_participation=mode.participation if mode else math.nan,
                support_modes=len(standing.support.modes) if standing.support else 0,
                floor_peak_acceleration_m_s2=peak,
                amplification=amplification,
                floor_spectral_acceleration_m_s2=floor_spectral_acceleration,
                code_spectral_acceleration_m_s2=code_spectral_acceleration,
                floor_pulse_amplitude_m_s2=pulse.amplitude if pulse else math.nan,
                floor_pulse_period_s=floor_pulse_period,
                verdict=station.verdict,
                overturning_share=station.overturning_share,
                scale_factor=identity.scale_factor,
                record_sha256=identity.record_sha256,
                settings_sha256=identity.settings_sha256,
            )


def variation_row(identity: ComponentRow, structure: str, variation: "Variation") -> VariationRow:
    """Return the row of one case with another crack or another processing."""
    return VariationRow(
        record=identity.record,
        component=identity.component,
        structure=structure,
        crack=variation.crack,
        position_m=variation.position,
        processing=variation.processing,
        predicted_rotation_ratio=variation.predicted_rotation_ratio,
        integrated_rotation_ratio=variation.integrated_rotation_ratio,
        scale_factor=identity.scale_factor,
        record_sha256=identity.record_sha256,
        settings_sha256=identity.settings_sha256,
    )


def failure_row(record: str, component: str, structure: str, failure: "Failure") -> FailureRow:
    """Return the row of what gave no result. component, structure: "" for all."""
    return FailureRow(
        record=record,
        component=component,
        structure=structure,
        stage=failure.stage,
        message=failure.message,
    )


def history_rows(record: str, responses: Mapping[tuple[str, str], "Response"]) -> Iterator[HistoryRow]:
    """Yield the history of each response by component and structure; of one without a history there are no rows."""
    for (component, structure), response in responses.items():
        if response.times is None or response.rotation is None or response.angular_velocity is None:
            continue
        steps = zip(
            response.times.tolist(),
            response.rotation.tolist(),
            response.angular_velocity.tolist(),
            strict=True,
        )
        for time, rotation, angular_velocity in steps:
            yield HistoryRow(
                record=record,
                component=component,
                structure=structure,
                time_s=time,
                rotation_rad=rotation,
                angular_velocity_rad_s=angular_velocity,
            )


@dataclass(frozen=True)
class RecordRows:
    """The rows of every table of one record."""

    record: Sequence[RecordRow] = ()
    pulses: Sequence[PulseRow] = ()
    comparison: Sequence[ComparisonRow] = ()
    ensemble: Sequence[EnsembleRow] = ()
    variations: Sequence[VariationRow] = ()
    failures: Sequence[FailureRow] = ()
    timings: Sequence[TimingRow] = ()
    verdicts: Sequence[VerdictRow] = ()
    supports: Sequence[SupportRow] = ()

    @property
    def tables(self) -> dict[type[Row], Sequence[Row]]:
        """The rows by their class."""
        return {
            RecordRow: self.record,
            PulseRow: self.pulses,
            ComparisonRow: self.comparison,
            EnsembleRow: self.ensemble,
            VariationRow: self.variations,
            SupportRow: self.supports,
            FailureRow: self.failures,
            TimingRow: self.timings,
            VerdictRow: self.verdicts,
        }

    def write(self, folder: Path) -> None:
        """Write every table into `folder`, all or none."""
        with written_together():
            write_tables(self.tables, folder)


RECORD_TABLES: tuple[type[Row], ...] = tuple(RecordRows().tables)
"""The rows of every table of one record."""


# Whole on purpose: the tables of a record, one after another.
def rows_of_record(
    result: "RecordResult", settings_sha256: str = "", licence: str = "", friction_coefficient: float = 0.6
) -> RecordRows:
    """Return what the tables hold of a record.

    settings_sha256: names settings, structures and package. friction_coefficient: beyond which a contact slides.
    """
    record = result.record
    identities = [identity_of(record, each, settings_sha256) for each in result.accelerograms]
    by_component = dict(zip(result.names, identities, strict=True))
    comparison: list[ComparisonRow] = []
    ensemble: list[EnsembleRow] = []
    variations: list[VariationRow] = []
    failures = [failure_row(record, component, "", failure) for component, failure in result.failures]
    if identities:
        by_component[BOTH_COMPONENTS] = replace(identities[0], component=BOTH_COMPONENTS)
    for component, identity in by_component.items():
        for case in result.cases(component):
            if case.answer is not None:
                comparison.append(comparison_row(identity, case, friction_coefficient))
            if case.ensembles is not None:
                ensemble.append(ensemble_row(identity, case.structure, case.ensembles))
            variations += [variation_row(identity, case.structure, each) for each in case.variations]
            failures += [
                failure_row(record, identity.component, case.structure, each) for each in case.failures
            ]
    verdicts = [
        verdict_row(by_component[station.worst.component] if station.worst else identities[0], station)
        for station in result.stations.values()
    ]
    timings = [
        TimingRow(record=record, stage=stage, duration_s=duration)
        for stage, duration in result.durations.items()
    ]
    return RecordRows(
        record=[
            record_row(identity, component, licence)
            for identity, component in zip(identities, result.components, strict=True)
        ],
        pulses=[
            each
            for identity, component in zip(identities, result.components, strict=True)
            for each in pulse_rows(identity, component)
        ],
        comparison=comparison,
        ensemble=ensemble,
        variations=variations,
        failures=failures,
        timings=timings,
        verdicts=verdicts,
        supports=list(support_rows(result, by_component)),
    )
