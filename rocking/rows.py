"""Rows of the result tables, made from what was computed. The columns stand in rocking.columns."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from rocking.comparison import (
    Assessment,
    AssessmentSettings,
    Case,
    Failure,
    Method,
    Prediction,
    ratio,
    verdict,
)
from rocking.model_check import UNKNOWN
from rocking.motion.response import Response
from rocking.outcome import Outcome
from rocking.pulses import PulseAnalysis, PulseEvidence
from rocking.pulses.interval import PulseInterval
from rocking.pulses.reliability import reliability_of, shipped_reliability
from rocking.records import Accelerogram
from rocking.records.processing import displacement, velocity
from rocking.structures import Mechanism
from rocking.tables import Row
from rocking.variations import Candidate, Variant, governing


@dataclass(frozen=True)
class Identity:
    """Which record, component and settings a row belongs to."""

    record: str
    accelerogram: Accelerogram
    settings_sha256: str

    @property
    def head(self) -> dict[str, object]:
        """The first columns of every row."""
        return {"record": self.record, "component": self.accelerogram.component}

    @property
    def provenance(self) -> dict[str, object]:
        """The last columns of every row."""
        return {
            "scale_factor": self.accelerogram.scale_factor,
            "record_sha256": self.accelerogram.source.sha256,
            "settings_sha256": self.settings_sha256,
        }


def all_rows(
    identity: Identity,
    assessment: Assessment,
    settings: AssessmentSettings,
    licence: str,
    vertical: Accelerogram | None = None,
) -> dict[str, list[Row]]:
    """The rows that one assessment gives, by name of the table."""
    cases = assessment.cases
    return {
        "record": [record_row(identity, licence, vertical)],
        "pulses": pulse_rows(identity, assessment.analysis, assessment.interval),
        "predictions": [
            row for case in cases for row in prediction_rows(identity, case, settings.acceleration_scale)
        ],
        "responses": [
            row for case in cases for row in response_rows(identity, case, settings.friction_coefficient)
        ],
        "comparison": [comparison_row(identity, case) for case in cases],
        "failures": [
            failure_row(identity.record, assessment.accelerogram.component, failure)
            for failure in assessment.failures
        ],
    }


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
    identity: Identity, analysis: PulseAnalysis | None, interval: PulseInterval | None
) -> list[Row]:
    """The rows of the pulses table: ranked alternatives, the dominant pulse first, then the pursuit sequence."""
    if analysis is None:
        return []
    kinds = {"alternative": analysis.ranked, "sequence": analysis.sequence}
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


def prediction_rows(identity: Identity, case: Case, acceleration_scale: str) -> list[Row]:
    """The rows of the predictions table: Eq. 15 as printed, and the exact closed form."""
    if case.prediction is None:
        return []
    prediction, maximum = case.prediction, case.prediction.maximum
    printed = _prediction_head(identity, case, prediction, Method.PRINTED, acceleration_scale) | {
        "rotation_ratio": prediction.printed,
        "rotation_rad": prediction.printed * prediction.block.critical_rotation,
        "rotation_ratio_low": None,
        "rotation_ratio_high": None,
        "outcome": None,
        "regime": None,
        "impacts": None,
    }
    exact = _prediction_head(identity, case, prediction, Method.CLOSED_FORM, acceleration_scale) | {
        "rotation_ratio": maximum.rotation_ratio,
        "rotation_rad": rotation(case.mechanism, maximum.rotation_ratio, maximum.peak_side),
        "rotation_ratio_low": prediction.low,
        "rotation_ratio_high": prediction.high,
        "outcome": maximum.outcome,
        "regime": maximum.regime,
        "impacts": maximum.impacts,
    }
    return [row | {"light": prediction.light} | identity.provenance for row in (printed, exact)]


def _prediction_head(
    identity: Identity, case: Case, prediction: Prediction, method: Method, acceleration_scale: str
) -> dict[str, object]:
    block = prediction.block
    return identity.head | {
        "structure": case.structure,
        "method": method,
        "pulse_rank": prediction.rank,
        "acceleration_scale_choice": acceleration_scale,
        "frequency_parameter_rad_s": block.frequency_parameter,
        "critical_rotation_rad": block.critical_rotation,
        "acceleration_scale": block.acceleration_scale,
        "uplift_multiplier": block.uplift_multiplier,
        "restitution": block.restitution,
        "amplitude_ratio": prediction.amplitude_ratio,
        "frequency_ratio": prediction.frequency_ratio,
    }


def response_rows(identity: Identity, case: Case, friction_coefficient: float) -> list[Row]:
    """The rows of the responses table: one for each integration."""
    return [
        _response_row(identity, case, method, response, friction_coefficient)
        for method, response in case.responses.items()
    ]


def _response_row(
    identity: Identity, case: Case, method: Method, response: Response, friction_coefficient: float
) -> Row:
    check = case.check if method is Method.MECHANISM_ON_RECORD else UNKNOWN
    return (
        identity.head
        | {
            "structure": case.structure,
            "method": method,
            "rotation_ratio": response.rotation_ratio,
            "rotation_rad": rotation(case.mechanism, response.rotation_ratio, response.peak_side),
            "outcome": response.outcome,
            "impacts": response.impacts,
            "peak_side": response.peak_side,
            "peak_time_s": response.peak_time,
            "uplift_time_s": response.uplift_time,
            "sensitivity": response.sensitivity,
            "fragile": response.fragile,
            "tolerance": response.tolerance,
            "steps": response.steps,
            "friction_needed": check.friction_needed,
            "slides": check.slides(friction_coefficient),
            "bounces": check.bounces,
            "reason": response.reason,
        }
        | identity.provenance
    )


def comparison_row(identity: Identity, case: Case) -> Row:
    """The row of the comparison table: the closed form beside the integration of the whole record."""
    reference = case.responses.get(Method.MECHANISM_ON_RECORD, _NOT_RUN)
    prediction, answer = case.prediction, case.answer
    predicted = prediction.maximum.rotation_ratio if prediction else math.nan
    error_ratio = ratio(predicted, reference.rotation_ratio)
    on_pulse = case.responses.get(Method.MECHANISM_ON_PULSE)
    on_block = case.responses.get(Method.BLOCK_ON_RECORD)
    return (
        identity.head
        | {
            "structure": case.structure,
            **_reliability(prediction),
            "printed_rotation_ratio": prediction and prediction.printed,
            "predicted_rotation_ratio": predicted,
            "pulse_rotation_ratio": on_pulse and on_pulse.rotation_ratio,
            "block_rotation_ratio": on_block and on_block.rotation_ratio,
            "integrated_rotation_ratio": reference.rotation_ratio,
            "answer_rotation_ratio": answer.rotation_ratio,
            "answer_method": answer.level,
            "prediction_over_integration": error_ratio,
            "within_factor_two": None if math.isnan(error_ratio) else 0.5 <= error_ratio <= 2,
            "verdict": verdict(predicted, reference.rotation_ratio),
            "regime": prediction and prediction.maximum.regime,
            "light": prediction and prediction.light,
            "sensitivity": reference.sensitivity,
            "fragile": reference.fragile,
        }
        | identity.provenance
    )


def _reliability(prediction: Prediction | None) -> dict[str, object]:
    """What the shipped calibration says of predictions like this one."""
    row = prediction and reliability_of(shipped_reliability(), prediction.light, prediction.frequency_ratio)
    overturnings = row.overturnings_found + row.overturnings_missed if row else 0
    return {
        "reliability_within_factor_two": row.within_factor_2 if row else math.nan,
        "reliability_overturnings_found": row.overturnings_found / overturnings
        if row and overturnings
        else math.nan,
        "reliability_records": row.records if row else 0,
    }


def candidate_rows(identity: Identity, structure: str, found: Sequence[Candidate]) -> list[Row]:
    """The rows of the candidates table of one structure."""
    on_pulse = governing([candidate.predicted for candidate in found])
    on_record = governing([candidate.integrated for candidate in found])
    return [
        identity.head
        | {
            "structure": structure,
            "position_m": candidate.position,
            "predicted_rotation_ratio": candidate.predicted,
            "integrated_rotation_ratio": candidate.integrated,
            "governs_pulse": place == on_pulse,
            "governs_record": place == on_record,
        }
        | identity.provenance
        for place, candidate in enumerate(found)
    ]


def processing_rows(identity: Identity, structure: str, found: Iterable[Variant]) -> list[Row]:
    """The rows of the processing table of one structure."""
    return [
        identity.head
        | {
            "structure": structure,
            "processing": variant.processing,
            "peak_acceleration_m_s2": variant.peak_acceleration,
            "rotation_ratio": variant.rotation_ratio,
            "outcome": variant.outcome,
        }
        | identity.provenance
        for variant in found
    ]


def failure_row(record: str, component: str, failure: Failure) -> Row:
    """The row of the failures table."""
    return {
        "record": record,
        "component": component,
        "structure": failure.structure,
        "stage": failure.stage,
        "message": failure.message,
    }


_NONE = (math.nan, math.nan)
_NOT_RUN = Response(math.nan, Outcome.FAILED)


def rotation(mechanism: Mechanism, rotation_ratio: float, side: int) -> float:
    """Return the rotation in rad that `rotation_ratio` means on `side` (+1 or −1) of `mechanism`."""
    return rotation_ratio * mechanism.sides[0 if side >= 0 else -1].critical_rotation
