"""Rows about a record: what was read, its pulses, what failed, and how long it took."""

import math
from collections.abc import Iterator, Sequence
from typing import Any, final

from rocking.assessment.horizontal_motion import HorizontalMotion, horizontal_motions
from rocking.assessment.rows import meanings
from rocking.assessment.rows.shared import ComponentRow, Identity
from rocking.pulses import Pulse, PulseAnalysis, PulseEvidence
from rocking.records import Accelerogram
from rocking.records.measures import record_measures
from rocking.tables import Row, column, row


@row("record", "One row per component: what was read and what was done to it before use")
class RecordRow(ComponentRow):
    """One component of a record as it was used."""

    event: str = column("Earthquake")
    magnitude: float | None = column(
        "Magnitude of the earthquake, where file or catalogue know it", default=None
    )
    epicentral_distance_m: float | None = column(
        "Distance to the epicentre, where file or catalogue give it", default=None
    )
    magnitude_type: str = column("Scale of the magnitude, where the file says it", default="")
    event_time: str = column("Time or date of the earthquake, as the file prints it", default="")
    station: str = column("Recording station")
    station_latitude_deg: float | None = column("Latitude of the station, north", default=None)
    station_longitude_deg: float | None = column("Longitude of the station, east", default=None)
    station_elevation_m: float | None = column("Elevation of the station above the sea", default=None)
    start_time: str = column(
        "Time of the first sample, as the file states it; empty where it does not", default=""
    )
    file: str = column("File the record was read from")
    format: str = column("Format that recognised the file")
    unit: str = column("Unit of the numbers in the file")
    licence: str = column("Licence of the record, as the catalogue declares it")
    vertical_component: str = column("Vertical component that acts too; empty where none does")
    vertical_peak_acceleration_m_s2: float = column("Largest magnitude of the vertical acceleration")
    samples: int = column("Number of samples")
    time_step_s: float = column("Time step")
    duration_s: float = column("Time from the first to the last sample")
    peak_acceleration_m_s2: float = column("Largest magnitude of the acceleration")
    peak_velocity_m_s: float = column("Largest magnitude of the velocity by trapezoid")
    peak_displacement_m: float = column("Largest magnitude of the displacement by trapezoid")
    arias_intensity_m_s: float = column("Arias intensity", equation="π/(2g) ∫a² dt")
    significant_duration_s: float = column("Time between 5 and 95 % of the Arias intensity (D5–95)")
    rotd50_peak_acceleration_m_s2: float = column(
        "Median over all directions of the peak acceleration of the pair of components; empty for one alone"
    )
    rotd100_peak_acceleration_m_s2: float = column(
        "Largest peak acceleration of the pair of components in any direction; empty for one alone"
    )
    velocity_pulse_period_s: float = column(
        "Period T_p of the velocity pulse (Shahi & Baker 2014) of the pair of components, or of one alone"
    )
    velocity_pulse_centre_time_s: float = column("Middle of the velocity pulse after the first sample")
    velocity_pulse_peak_velocity_m_s: float = column("Peak velocity along the axis of the velocity pulse")
    velocity_pulse_orientation_rad: float = column(
        "Axis of the velocity pulse, from the first of the pair towards the second; 0 for one component alone"
    )
    velocity_pulse_azimuth_deg: float = column(
        "Axis of the velocity pulse clockwise from north, 0 to 180, where the components know theirs",
        unit="°",
    )
    velocity_pulse_indicator: float = column("Pulse indicator of Shahi & Baker (2014)")
    velocity_pulse_like: bool | None = column(
        "Whether their criterion calls the motion pulse-like", default=None
    )
    pulse_period_ratio: float = column("Period of the dominant sine pulse over T_p")
    pulse_periods_unlike: bool | None = column("Whether the two differ by more than a factor 2", default=None)
    high_pass_frequency_hz: float | None = column("Corner of the high-pass known to have been applied")
    processing: tuple[str, ...] = column("Steps applied to the numbers of the file, in order")
    warnings: tuple[str, ...] = column("What the reader noticed")


@row("pulses", "One row per sine pulse of acceleration; rank 1 of kind alternative is the dominant pulse")
@final
class PulseRow(ComponentRow):
    """One sine pulse that was found in a component."""

    kind: str = column(
        "alternative: ranked on the record; sequence: pursued on the residual of the pulses before it; "
        "predicting: the pulse that predicts, where it is no alternative"
    )
    rank: int = column("Place in its kind, from 1")
    amplitude_m_s2: float = column("Signed amplitude a_g")
    circular_frequency_rad_s: float = column("Circular frequency of the pulse")
    period_s: float = column("Period of the pulse")
    start_time_s: float = column("Start of the pulse after the first sample")
    gain_m2_s3: float = column("Energy gain of the matched filter")
    gain_ratio: float = column("Energy gain over that of the dominant pulse")
    explained_energy: float = column(
        "Share of the record's acceleration energy that the pulse explains (EVa)"
    )
    effective_length_m: float = column("Amplitude times period squared")
    flags: tuple[str, ...] = column("What makes the pulse doubtful")

    @property
    def ranked(self) -> bool:
        """Whether it is one of the ranked alternatives."""
        return self.kind == "alternative"

    @property
    def pulse(self) -> Pulse:
        """The pulse itself."""
        return Pulse(self.amplitude_m_s2, self.circular_frequency_rad_s, self.start_time_s)


@row("failures", "One row per record or structure that gave no result, and why")
class FailureRow(Row):
    """Something that gave no result."""

    record: str = column(meanings.RECORD)
    component: str = column(meanings.COMPONENT)
    structure: str = column(meanings.STRUCTURE)
    stage: str = column("Stage that failed")
    message: str = column("What is wrong, what is allowed and what to do")


@row("timings", "One row per record and stage; differs between runs of the same input")
class TimingRow(Row):
    """CPU time of one stage."""

    record: str = column(meanings.RECORD)
    stage: str = column("Stage, or a method, whose time is part of that of the stage responses")
    duration_s: float = column("CPU time")


def record_row(
    identity: Identity,
    licence: str,
    vertical: Accelerogram | None = None,
    motion: HorizontalMotion | None = None,
    dominant: Pulse | None = None,
) -> RecordRow:
    """Return the row of one component; `vertical` acts with it, `motion` is that of the pair it belongs to.

    motion: None makes that of the component alone. dominant: its sine pulse of largest energy gain.
    """
    accelerogram = identity.accelerogram
    measures = record_measures(accelerogram)
    return RecordRow(
        **identity.columns,
        event=accelerogram.event,
        station=accelerogram.station,
        start_time=accelerogram.start_time,
        file=accelerogram.source.path,
        format=accelerogram.source.format,
        unit=accelerogram.source.unit,
        licence=licence,
        vertical_component=vertical.component or "not named" if vertical else "",
        vertical_peak_acceleration_m_s2=vertical.peak_acceleration if vertical else math.nan,
        samples=accelerogram.acceleration.size,
        time_step_s=accelerogram.time_step,
        duration_s=accelerogram.duration,
        peak_acceleration_m_s2=accelerogram.peak_acceleration,
        peak_velocity_m_s=measures.peak_velocity,
        peak_displacement_m=measures.peak_displacement,
        arias_intensity_m_s=measures.arias_intensity,
        significant_duration_s=measures.significant_duration,
        magnitude=accelerogram.magnitude,
        epicentral_distance_m=accelerogram.epicentral_distance,
        magnitude_type=accelerogram.magnitude_type,
        event_time=accelerogram.event_time,
        station_latitude_deg=accelerogram.latitude,
        station_longitude_deg=accelerogram.longitude,
        station_elevation_m=accelerogram.elevation,
        **_motion_columns(motion or horizontal_motions([accelerogram])[0], dominant),
        high_pass_frequency_hz=accelerogram.high_pass_frequency,
        processing=accelerogram.processing,
        warnings=accelerogram.warnings,
    )


def _motion_columns(motion: HorizontalMotion, dominant: Pulse | None) -> dict[str, Any]:
    pulse, rotd = motion.velocity_pulse, motion.rotd
    return {
        "rotd50_peak_acceleration_m_s2": rotd.rotd50 if rotd else math.nan,
        "rotd100_peak_acceleration_m_s2": rotd.rotd100 if rotd else math.nan,
        "velocity_pulse_period_s": pulse.period if pulse else math.nan,
        "velocity_pulse_centre_time_s": pulse.centre_time if pulse else math.nan,
        "velocity_pulse_peak_velocity_m_s": pulse.peak_velocity if pulse else math.nan,
        "velocity_pulse_orientation_rad": pulse.orientation if pulse else math.nan,
        "velocity_pulse_azimuth_deg": math.nan if motion.azimuth is None else motion.azimuth,
        "velocity_pulse_indicator": pulse.indicator if pulse else math.nan,
        "velocity_pulse_like": pulse.pulse_like if pulse else None,
        "pulse_period_ratio": dominant.period / pulse.period if pulse and dominant else math.nan,
        "pulse_periods_unlike": motion.is_unlike(dominant),
    }


def pulse_rows(
    identity: Identity, analysis: PulseAnalysis | None, candidates: Sequence[PulseEvidence] = ()
) -> Iterator[PulseRow]:
    """Yield the rows of the ranked alternatives, the dominant pulse first, then those of the pursuit sequence.

    candidates: the pulses that predict; those that are not among the alternatives follow.
    """
    if analysis is None:
        return
    others = [evidence for evidence in candidates if evidence not in analysis.ranked]
    kinds = {"alternative": analysis.ranked, "sequence": analysis.sequence, "predicting": others}
    for kind, found in kinds.items():
        for rank, evidence in enumerate(found, start=1):
            pulse, dominant = evidence.pulse, kind == "alternative" and rank == 1
            yield PulseRow(
                **identity.columns,
                kind=kind,
                rank=rank,
                amplitude_m_s2=pulse.amplitude,
                circular_frequency_rad_s=pulse.circular_frequency,
                period_s=pulse.period,
                start_time_s=pulse.start_time,
                gain_m2_s3=evidence.gain,
                gain_ratio=evidence.gain / analysis.evidence.gain,
                explained_energy=evidence.explained_energy,
                effective_length_m=evidence.effective_length,
                flags=analysis.flags if dominant else (),
            )
