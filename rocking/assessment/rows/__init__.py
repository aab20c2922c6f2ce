"""Rows of the result tables, made from what was computed. The columns stand in rocking.assessment.columns."""

from rocking.assessment.assess import Assessment, AssessmentSettings
from rocking.assessment.rows.identity import Identity
from rocking.assessment.rows.of_record import failure_row, pulse_rows, record_row
from rocking.assessment.rows.of_structure import comparison_row, prediction_rows, response_rows, rotation
from rocking.assessment.rows.of_variations import candidate_rows, processing_rows
from rocking.records import Accelerogram
from rocking.tables import Row

__all__ = [
    "Identity",
    "all_rows",
    "candidate_rows",
    "comparison_row",
    "failure_row",
    "prediction_rows",
    "processing_rows",
    "pulse_rows",
    "record_row",
    "response_rows",
    "rotation",
]


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
        "pulses": pulse_rows(identity, assessment.analysis, assessment.interval, assessment.candidates),
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
