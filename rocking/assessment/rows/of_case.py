"""Rows about a structure under a component: predictions, integrations, both side by side, and their variations."""

import math
from collections.abc import Iterator
from typing import final

from rocking.assessment.assess import Case
from rocking.assessment.method import Method
from rocking.assessment.rows import meanings
from rocking.assessment.rows.of_prediction import PredictionRow, expected_columns
from rocking.assessment.rows.shared import CaseRow, Identity, rotation
from rocking.assessment.verdict import Agreement, agreement, ratio, ratio_in_words, within_factor_two
from rocking.motion.response import UNKNOWN, Response
from rocking.sine_pulse import Regime
from rocking.structures.outcome import Outcome
from rocking.tables import column, row


@row("responses", "One row per structure and integration")
@final
class ResponseRow(CaseRow):
    """One integration of one case."""

    method: Method = column(meanings.METHOD)
    rotation_ratio: float = column(meanings.ROTATION_RATIO)
    rotation_rad: float = column(meanings.ROTATION)
    outcome: Outcome = column(meanings.OUTCOME)
    impacts: int = column(meanings.IMPACTS)
    peak_side: int = column(meanings.PEAK_SIDE)
    peak_time_s: float = column("Time of the largest rotation after the first sample")
    uplift_time_s: float = column("Time of the first uplift after the first sample")
    tolerance: float = column("Relative tolerance of the integration; 0 for an exact solution")
    steps: int = column("Steps taken")
    friction_needed: float = column(
        "Largest friction coefficient a contact needs while rocking; INF where a contact is not pressed"
    )
    slides: bool | None = column(
        "Whether that exceeds the friction coefficient of the settings: the model does not hold"
    )
    bounces: bool | None = column("Whether a contact would have to pull: the model does not hold")
    contacts_unknown: str = column("Why nothing is known of the contacts; empty where it is")
    ties: str = column("Which ties yield or break on the way to the largest rotation")
    reason: str = column("Why it failed, if it did")


@row(
    "comparison",
    "One row per structure: the closed form under the dominant pulse beside the integration of the whole record",
)
class ComparisonRow(CaseRow):
    """One case: what every method says of it."""

    printed_rotation_ratio: float = column(
        "Eq. 15 as the paper prints it; empty where its radicand is negative", equation="Eq. 15"
    )
    predicted_rotation_ratio: float = column("Exact maximum of the equivalent block under the dominant pulse")
    pulse_rotation_ratio: float = column("Nonlinear mechanism under the dominant pulse")
    block_rotation_ratio: float = column("Equivalent block under the whole record")
    integrated_rotation_ratio: float = column("Nonlinear mechanism under the whole record")
    answer_rotation_ratio: float = column(
        "Of the mechanism under the record, or of what settles the verdict before it with fidelity: auto"
    )
    answer_method: Method = column("Which method that was")
    answer_reason: str = column("Why that one settled it, where fidelity: auto chose it")
    overturning_probability: float = column(meanings.PROBABILITY)
    overturning_probability_low: float = column("Lower end of its 90 % interval")
    overturning_probability_high: float = column("Upper end of its 90 % interval")
    expected_rotation_ratio_low: float = column(
        "5 % quantile of the rotation ratio of the mechanism under records that are alike in the same"
    )
    expected_rotation_ratio_high: float = column("95 % quantile of it; INF if it overturns")
    prediction_over_integration: float = column("Predicted over integrated rotation ratio, where both rock")
    prediction_in_words: str = column(
        "How the prediction stands to the integration; empty where one is missing"
    )
    within_factor_two: bool | None = column("Whether that ratio lies between 1/2 and 2, where both rock")
    agreement: Agreement = column(
        "Rest, rocking or overturning in the closed form and in the integration: same outcome, too low or too high"
    )
    regime: Regime | None = column(meanings.REGIME)

    @property
    def spared(self) -> bool:
        """Whether a cheaper method than the full integration answered."""
        return math.isnan(self.integrated_rotation_ratio) and not math.isnan(self.answer_rotation_ratio)

    @property
    def found_rotation_ratio(self) -> float:
        """The rotation ratio of the full integration, or of what answered in its stead."""
        return self.answer_rotation_ratio if self.spared else self.integrated_rotation_ratio


@row("maxima", "One row per record, component, structure and method")
class MaximumRow(CaseRow):
    """The largest rotation of one case by one method."""

    method: Method = column(meanings.METHOD)
    rotation_ratio: float = column(meanings.ROTATION_RATIO)
    rotation_rad: float = column(meanings.ROTATION)
    outcome: Outcome | None = column(meanings.OUTCOME)
    regime: Regime | None = column(meanings.REGIME)
    error: float = column("Rotation ratio over that of the mechanism on the record, minus 1, where both rock")


def response_rows(identity: Identity, case: Case, friction_coefficient: float) -> Iterator[ResponseRow]:
    """Yield the row of each integration."""
    for method, response in case.responses.items():
        check = case.check if method is Method.MECHANISM_ON_RECORD else UNKNOWN
        yield ResponseRow(
            **identity.columns,
            structure=case.structure,
            method=method,
            rotation_ratio=response.rotation_ratio,
            rotation_rad=rotation(case.mechanism, response.rotation_ratio, response.peak_side),
            outcome=response.outcome,
            impacts=response.impacts,
            peak_side=response.peak_side,
            peak_time_s=response.peak_time,
            uplift_time_s=response.uplift_time,
            tolerance=response.tolerance,
            steps=response.steps,
            friction_needed=check.friction_needed,
            slides=check.slides(friction_coefficient),
            bounces=check.bounces,
            contacts_unknown=check.reason,
            ties=check.ties,
            reason=response.reason,
        )


_NOT_RUN = Response(math.nan, Outcome.FAILED)


def comparison_row(identity: Identity, case: Case) -> ComparisonRow:
    """Return the row of one case: the closed form beside the integration of the whole record."""
    reference = case.responses.get(Method.MECHANISM_ON_RECORD, _NOT_RUN)
    prediction = case.prediction
    predicted = prediction.maximum.rotation_ratio if prediction else math.nan
    integrated = reference.rotation_ratio
    return ComparisonRow(
        **identity.columns,
        structure=case.structure,
        printed_rotation_ratio=prediction.printed if prediction else math.nan,
        predicted_rotation_ratio=predicted,
        pulse_rotation_ratio=case.responses.get(Method.MECHANISM_ON_PULSE, _NOT_RUN).rotation_ratio,
        block_rotation_ratio=case.responses.get(Method.BLOCK_ON_RECORD, _NOT_RUN).rotation_ratio,
        integrated_rotation_ratio=integrated,
        answer_rotation_ratio=case.answer.rotation_ratio,
        answer_method=case.answer.method,
        answer_reason=case.answer.reason,
        **expected_columns(case.expectation),
        prediction_over_integration=ratio(predicted, integrated),
        prediction_in_words=ratio_in_words(predicted, integrated),
        within_factor_two=within_factor_two(predicted, integrated),
        agreement=agreement(predicted, integrated),
        regime=prediction.maximum.regime if prediction else None,
    )


def maximum_row(method: PredictionRow | ResponseRow, comparison: ComparisonRow) -> MaximumRow:
    """Return what one method says of the case of `comparison`."""
    error = ratio(method.rotation_ratio, comparison.integrated_rotation_ratio) - 1
    same = {name: getattr(method, name) for name in MaximumRow.table.column_names if hasattr(method, name)}
    return MaximumRow(
        **{"regime": None} | same,
        error=math.nan if method.method is Method.MECHANISM_ON_RECORD else error,
    )
