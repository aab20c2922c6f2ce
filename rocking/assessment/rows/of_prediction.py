"""Rows about the closed forms of a structure under the pulse of a component."""

import math
from collections.abc import Iterator
from typing import Any, final

from rocking.assessment.assess import Case
from rocking.assessment.method import Method
from rocking.assessment.rows import meanings
from rocking.assessment.rows.shared import CaseRow, Identity, rotation
from rocking.assessment.tiers import Expectation
from rocking.sine_pulse import Regime
from rocking.structures.outcome import Outcome
from rocking.tables import column, row


@row(
    "predictions",
    "One row per structure and closed form: the equivalent block under the dominant pulse",
)
@final
class PredictionRow(CaseRow):
    """One closed form of one case."""

    method: Method = column(meanings.METHOD)
    pulse_rank: int = column("Rank of the pulse among those that its method offers")
    acceleration_scale_choice: str = column(
        "rest (exact at rest), linearised (a_sc), uplift (a_sc,alt) or mean"
    )
    frequency_parameter_rad_s: float = column(meanings.FREQUENCY_PARAMETER, equation="Eq. 11")
    critical_rotation_rad: float = column("Critical rotation")
    acceleration_scale: float = column("Acceleration scale of the equivalent block", equation="Eqs. 11, 13")
    uplift_multiplier: float = column("Uplift acceleration of the equivalent block in g", equation="Eq. 12")
    restitution: float = column(meanings.RESTITUTION, equation="Eq. 2")
    amplitude_ratio: float = column("a = a_g / (g times uplift multiplier)", equation="Eq. 16")
    frequency_ratio: float = column(
        "Circular frequency of the pulse over frequency parameter", equation="Eq. 16"
    )
    rotation_ratio: float = column(meanings.ROTATION_RATIO)
    rotation_rad: float = column(meanings.ROTATION)
    overturning_probability: float = column(meanings.PROBABILITY)
    overturning_probability_low: float = column("Lower end of its 90 % interval")
    overturning_probability_high: float = column("Upper end of its 90 % interval")
    expected_rotation_ratio_low: float = column(
        "5 % quantile of the rotation ratio of the mechanism under records that are alike in the same"
    )
    expected_rotation_ratio_high: float = column("95 % quantile of it; INF if it overturns")
    in_words: str = column("Both, in words, or why neither is given", default="")
    outcome: Outcome | None = column(meanings.OUTCOME, default=None)
    regime: Regime | None = column(meanings.REGIME, default=None)
    impacts: int | None = column(meanings.IMPACTS, default=None)


def prediction_rows(identity: Identity, case: Case, acceleration_scale: str) -> Iterator[PredictionRow]:
    """Yield the rows of Eq. 15 as printed and of the exact closed form; none without a pulse."""
    prediction = case.prediction
    if prediction is None:
        return
    block, maximum = prediction.block, prediction.maximum
    shared = identity.columns | {
        "structure": case.structure,
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
    yield PredictionRow(
        **shared,
        method=Method.PRINTED,
        rotation_ratio=prediction.printed,
        rotation_rad=prediction.printed * block.critical_rotation,
        **expected_columns(None),
    )
    yield PredictionRow(
        **shared,
        method=Method.CLOSED_FORM,
        rotation_ratio=maximum.rotation_ratio,
        rotation_rad=rotation(case.mechanism, maximum.rotation_ratio, maximum.peak_side),
        **expected_columns(case.expectation),
        in_words=str(case.expectation or case.unexpected),
        outcome=maximum.outcome,
        regime=maximum.regime,
        impacts=maximum.impacts,
    )


def expected_columns(found: Expectation | None) -> dict[str, Any]:
    """The columns of an expectation, empty without one."""
    return {
        "overturning_probability": found.probability if found else math.nan,
        "overturning_probability_low": found.probability_low if found else math.nan,
        "overturning_probability_high": found.probability_high if found else math.nan,
        "expected_rotation_ratio_low": found.rotation_low if found else math.nan,
        "expected_rotation_ratio_high": found.rotation_high if found else math.nan,
    }
