"""The rows of the tables of one record: each class says what its columns are, and `of` fills them by name."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rocking.assessment.verdict import (
    Agreement,
    Method,
    Verdict,
    agreement,
    ratio,
    ratio_in_words,
    within_factor_two,
)
from rocking.errors import PulseError, RecordError
from rocking.motion.response import Response
from rocking.pulses import Pulse, PulseAnalysis, PulseEvidence, VelocityPulse, velocity_pulse
from rocking.records import Accelerogram, RotD, rotd
from rocking.records.measures import record_measures
from rocking.records.rotation import azimuth_of_axis
from rocking.sine_pulse import Regime
from rocking.structures import Outcome
from rocking.tables import Row, column, row

if TYPE_CHECKING:  # else who reads a table would load numba
    from rocking.assessment.assess import Case
    from rocking.assessment.ensemble import Ensemble

RECORD = "Identifier of the record in the catalogue"
COMPONENT = "Component of the ground motion, as the file names it"
STRUCTURE = "Name of the structure in the structure list"
SCALE_FACTOR = "Factor of the catalogue on the accelerations of the file"
RECORD_SHA256 = "SHA-256 of the file the record was read from"
PEAK_SIDE = "Side of the largest rotation or of the overturning: 1, -1, or 0 without uplift"


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
    sha256 = accelerogram.source.sha256
    return ComponentRow.of(accelerogram, record=record, record_sha256=sha256, settings_sha256=settings_sha256)


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

    verdict: Verdict = column("stands, overturns, undecided, or unknown: a component failed")
    overturning_members: int = column("Number of members that overturn")
    members: int = column("Number of members; 0 without an ensemble")
    overturning_share: float = column("Share of the members that overturn; of a single run 0 or 1")
    crack: str = column("Crack of least λ, which statics chooses; empty where only one may form")
    elsewhere_crack: str = column("Another crack, with which the structure does not stand")
    elsewhere_overturning_members: int | None = column("Members that overturn with that crack")
    elsewhere_members: int | None = column("Members with that crack; 0 for a single run")
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
    event_time: str = column("Time or date of the earthquake, as the file prints it")
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
    printed_rotation_ratio: float = column("Rotation ratio of the block as printed", equation="Eq. 15")
    block_on_record_rotation_ratio: float = column("Rotation ratio of the block under the record")
    mechanism_on_pulse_rotation_ratio: float = column("Rotation ratio of the mechanism under the pulse")
    pulse_rank: int | None = column("Rank of the pulse that predicts among those of its method")
    amplitude_ratio: float = column("Amplitude ratio a = a_g/(gλ) of the pulse", equation="Eq. 16")
    frequency_ratio: float = column("Circular frequency of the pulse over p", equation="Eq. 16")
    impacts: int | None = column("Number of impacts in the integration")
    peak_side: int | None = column(PEAK_SIDE)
    peak_time_s: float = column("Time of the largest rotation after the first sample")
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
    Method.CLOSED_FORM: "predicted_rotation_ratio",
    Method.BLOCK_ON_RECORD: "block_on_record_rotation_ratio",
    Method.MECHANISM_ON_PULSE: "mechanism_on_pulse_rotation_ratio",
    Method.MECHANISM_ON_RECORD: "integrated_rotation_ratio",
}
"""Where the largest rotation of each method stands in the comparison, over the critical one; INF if it overturns."""


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


@dataclass(frozen=True)
class HorizontalMotion:
    """The motion of a pair of horizontal components, or of one that stands alone.

    velocity_pulse: None where the motion is still or too short for one. velocity_pulse_azimuth: of its axis, degrees
    clockwise from north in [0, 180); None where a component does not state its own. rotd: None of one component alone.
    """

    velocity_pulse: VelocityPulse | None
    velocity_pulse_azimuth: float | None
    rotd: RotD | None


def horizontal_motions(accelerograms: Sequence[Accelerogram]) -> list[HorizontalMotion]:
    """Return the motion that each of the horizontal components of a record belongs to.

    Two components that share time step and start are a pair; fewer, more or others stand each alone.
    """
    if len(accelerograms) == 2:
        first, second = accelerograms
        with suppress(RecordError):  # two that do not belong together stand alone
            pair = _motion(first, second, rotd(first, second))
            return [pair, pair]
    return [_motion(accelerogram) for accelerogram in accelerograms]


def _motion(
    first: Accelerogram, second: Accelerogram | None = None, peaks: RotD | None = None
) -> HorizontalMotion:
    try:
        pulse = velocity_pulse(first, second)
    except PulseError:  # the motion holds none, which is no failure of the record
        return HorizontalMotion(None, None, peaks)
    azimuth = (
        first.azimuth if second is None else azimuth_of_axis(first.azimuth, second.azimuth, pulse.orientation)
    )
    return HorizontalMotion(pulse, None if azimuth is None else azimuth % 180, peaks)


def record_row(
    identity: ComponentRow,
    accelerogram: Accelerogram,
    licence: str,
    vertical: Accelerogram | None,
    motion: HorizontalMotion,
    dominant: Pulse | None,
) -> RecordRow:
    """Return the row of one component; `vertical` acts with it, `motion` is that of the pair it belongs to.

    dominant: its sine pulse of largest energy gain.
    """
    pulse = motion.velocity_pulse
    return RecordRow.of(
        identity,
        accelerogram,
        accelerogram.source,
        record_measures(accelerogram),
        motion,
        file=accelerogram.source.path,
        licence=licence,
        samples=accelerogram.acceleration.size,
        station_latitude_deg=accelerogram.latitude,
        station_longitude_deg=accelerogram.longitude,
        vertical_component=vertical and (vertical.component or "not named"),
        vertical_peak_acceleration_m_s2=vertical and vertical.peak_acceleration,
        rotd50_peak_acceleration_m_s2=motion.rotd and motion.rotd.rotd50,
        rotd100_peak_acceleration_m_s2=motion.rotd and motion.rotd.rotd100,
        velocity_pulse_like=pulse and pulse.pulse_like,
        pulse_period_ratio=pulse and dominant and dominant.period / pulse.period,
        pulse_periods_unlike=pulse and dominant and pulse.is_unlike(dominant),
    )


def pulse_rows(
    identity: ComponentRow, analysis: PulseAnalysis | None, candidates: Sequence[PulseEvidence] = ()
) -> Iterator[PulseRow]:
    """Yield the rows of the ranked alternatives, the dominant pulse first, then those of the pursuit sequence.

    candidates: the pulses that predict; those that are not among the alternatives follow.
    """
    if analysis is None:
        return
    others = [evidence for evidence in candidates if evidence not in analysis.ranked]
    kinds = {"alternative": analysis.ranked, "sequence": analysis.sequence, "predicting": others}
    for kind, pulses in kinds.items():
        for rank, evidence in enumerate(pulses, start=1):
            yield PulseRow.of(
                identity,
                evidence,
                evidence.pulse,
                kind=kind,
                rank=rank,
                gain_ratio=evidence.gain / analysis.evidence.gain,
                flags=analysis.flags if evidence is analysis.evidence and kind == "alternative" else (),
            )


def comparison_row(identity: ComponentRow, case: "Case", friction_coefficient: float) -> ComparisonRow:
    """Return the row of one case: the closed form beside the integration of the whole record."""
    ratios = case.predicted_rotation_ratio, case.integrated_rotation_ratio
    by_method = {RATIO_COLUMNS[method]: each.rotation_ratio for method, each in case.responses.items()}
    prediction = case.prediction
    estimate = case.overturning_estimate
    return ComparisonRow.of(
        identity,
        by_method,
        case,
        prediction,
        case.responses.get(Method.MECHANISM_ON_RECORD),
        case.check,
        prediction_over_integration=ratio(*ratios),
        prediction_in_words=ratio_in_words(*ratios),
        within_factor_two=within_factor_two(*ratios),
        agreement=agreement(*ratios),
        regime=prediction and prediction.maximum.regime,
        slides=case.check.slides(friction_coefficient),
        overturning_estimate=estimate and estimate.share,
    )


def ensemble_row(identity: ComponentRow, structure: str, ensemble: "Ensemble") -> EnsembleRow:
    """Return the row of one ensemble."""
    return EnsembleRow.of(
        identity,
        ensemble,
        ensemble.settings,
        structure=structure,
        worst_direction=ensemble.worst("direction"),
        worst_polarity={"1.0": "as recorded", "-1.0": "reversed"}.get(ensemble.worst("polarity"), ""),
        worst_processing=ensemble.worst("processing"),
    )


def history_rows(record: str, responses: Mapping[tuple[str, str], Response]) -> Iterator[HistoryRow]:
    """Yield the history of each response by component and structure; of one without a history there are no rows."""
    for (component, structure), response in responses.items():
        if response.times is not None:
            for step in response.frame().to_dict("records"):
                yield HistoryRow.of(record=record, component=component, structure=structure, **step)
