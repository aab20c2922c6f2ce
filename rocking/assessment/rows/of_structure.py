"""Rows about a structure under a record: predictions, integrations, and the two side by side."""

import math

from rocking.assessment.assess import Case, Prediction, ratio, verdict
from rocking.assessment.method import Method
from rocking.assessment.rows.identity import Identity
from rocking.motion.contact_check import UNKNOWN
from rocking.motion.response import Response
from rocking.pulses.reliability import reliability_of, shipped_reliability
from rocking.structures import Mechanism
from rocking.structures.outcome import Outcome
from rocking.tables import Row

_NOT_RUN = Response(math.nan, Outcome.FAILED)


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


def rotation(mechanism: Mechanism, rotation_ratio: float, side: int) -> float:
    """Return the rotation in rad that `rotation_ratio` means on `side` (+1 or −1) of `mechanism`."""
    return rotation_ratio * mechanism.sides[0 if side >= 0 else -1].critical_rotation
