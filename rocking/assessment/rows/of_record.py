"""Rows about a record: what was read, its pulses, and what failed."""

import math
from collections.abc import Sequence

import numpy as np

from rocking.assessment.assess import Failure
from rocking.assessment.rows.identity import Identity
from rocking.pulses import PulseAnalysis, PulseEvidence
from rocking.pulses.interval import PulseInterval
from rocking.records import Accelerogram
from rocking.records.processing import displacement, velocity
from rocking.tables import Row

_NONE = (math.nan, math.nan)


def record_row(identity: Identity, licence: str, vertical: Accelerogram | None = None) -> Row:
    """The row of the record table for one component."""
    accelerogram = identity.accelerogram
    return (
        identity.head
        | {
            "event": accelerogram.event,
            "station": accelerogram.station,
            "file": accelerogram.source.path,
            "format": accelerogram.source.format,
            "unit": accelerogram.source.unit,
            "licence": licence,
            "vertical_component": vertical.component or "not named" if vertical else None,
            "vertical_peak_acceleration_m_s2": vertical.peak_acceleration if vertical else None,
            "samples": accelerogram.acceleration.size,
            "time_step_s": accelerogram.time_step,
            "duration_s": accelerogram.duration,
            "peak_acceleration_m_s2": accelerogram.peak_acceleration,
            "peak_velocity_m_s": float(np.abs(velocity(accelerogram)).max()),
            "peak_displacement_m": float(np.abs(displacement(accelerogram)).max()),
            "high_pass_frequency_hz": accelerogram.high_pass_frequency,
            "processing": accelerogram.processing,
            "warnings": accelerogram.warnings,
        }
        | identity.provenance
    )


def pulse_rows(
    identity: Identity,
    analysis: PulseAnalysis | None,
    interval: PulseInterval | None,
    candidates: Sequence[PulseEvidence] = (),
) -> list[Row]:
    """The rows of the pulses table: ranked alternatives, the dominant pulse first, then the pursuit sequence.

    candidates: the pulses that predict; those that are not among the alternatives follow.
    """
    if analysis is None:
        return []
    others = [evidence for evidence in candidates if evidence not in analysis.ranked]
    kinds = {"alternative": analysis.ranked, "sequence": analysis.sequence, "predicting": others}
    return [
        _pulse_row(identity, analysis, interval, kind, rank, evidence)
        for kind, pulses in kinds.items()
        for rank, evidence in enumerate(pulses, start=1)
    ]


def _pulse_row(
    identity: Identity,
    analysis: PulseAnalysis,
    interval: PulseInterval | None,
    kind: str,
    rank: int,
    evidence: PulseEvidence,
) -> Row:
    pulse = evidence.pulse
    dominant = kind == "alternative" and rank == 1
    amplitude, period = (interval.amplitude, interval.period) if dominant and interval else (_NONE, _NONE)
    return (
        identity.head
        | {
            "kind": kind,
            "rank": rank,
            "amplitude_m_s2": pulse.amplitude,
            "amplitude_low_m_s2": amplitude[0],
            "amplitude_high_m_s2": amplitude[1],
            "circular_frequency_rad_s": pulse.circular_frequency,
            "period_s": pulse.period,
            "period_low_s": period[0],
            "period_high_s": period[1],
            "start_time_s": pulse.start_time,
            "gain_m2_s3": evidence.gain,
            "gain_ratio": evidence.gain / analysis.evidence.gain,
            "explained_energy": evidence.explained_energy,
            "effective_length_m": evidence.effective_length,
            "flags": analysis.flags if dominant else (),
        }
        | identity.provenance
    )


def failure_row(record: str, component: str, failure: Failure) -> Row:
    """The row of the failures table."""
    return {
        "record": record,
        "component": component,
        "structure": failure.structure,
        "stage": failure.stage,
        "message": failure.message,
    }
