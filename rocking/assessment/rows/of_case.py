"""Rows about a structure under a component: largest rotations, prediction beside integration, ensemble, history."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import final

import numpy as np

from rocking.assessment.assess import Case, Prediction
from rocking.assessment.ensemble import Ensemble
from rocking.assessment.method import Method
from rocking.assessment.rows import meanings
from rocking.assessment.rows.shared import CaseRow, Identity
from rocking.assessment.variations import CrackResponse, Variant, governing
from rocking.assessment.verdict import (
    Agreement,
    Verdict,
    agreement,
    ratio,
    ratio_in_words,
    within_factor_two,
)
from rocking.motion.response import UNKNOWN, Response
from rocking.sine_pulse import Regime
from rocking.structures import Mechanism, Outcome
from rocking.tables import Row, column, row

_NONE = math.nan
_SHARE = (
    "Share of the variance of the rotation (1 where it overturns) that {} explains; empty where it is fixed"
)


@row("maxima", "One row per structure and method, closed form or integration: the largest rotation")
@final
class MaximumRow(CaseRow):
    """The largest rotation of one case by one method."""

    method: Method = column(meanings.METHOD)
    processing: str = column(
        "What was done to the record besides what the record table says; empty for the record as it is used",
        default="",
    )
    rotation_ratio: float = column(meanings.ROTATION_RATIO)
    rotation_rad: float = column("Largest rotation; INF if it overturns", default=_NONE)
    outcome: Outcome | None = column("no uplift, rocks, overturns or failed", default=None)
    error: float = column(
        "Rotation ratio over that of the mechanism on the record, minus 1, where both rock", default=_NONE
    )
    regime: Regime | None = column(meanings.REGIME, default=None)
    impacts: int | None = column("Number of impacts", default=None)
    pulse_rank: int | None = column(
        "Of a closed form: rank of the pulse among those that its method offers", default=None
    )
    amplitude_ratio: float = column(
        "Of a closed form: a = a_g / (g times uplift multiplier)", equation="Eq. 16", default=_NONE
    )
    frequency_ratio: float = column(
        "Of a closed form: circular frequency of the pulse over frequency parameter",
        equation="Eq. 16",
        default=_NONE,
    )
    peak_side: int | None = column(meanings.PEAK_SIDE, default=None)
    peak_time_s: float = column("Time of the largest rotation after the first sample", default=_NONE)
    uplift_time_s: float = column("Time of the first uplift after the first sample", default=_NONE)
    tolerance: float = column("Relative tolerance of the integration; 0 for an exact solution", default=_NONE)
    steps: int | None = column("Steps taken", default=None)
    friction_needed: float = column(
        "Largest friction coefficient a contact needs while rocking; INF where a contact is not pressed",
        default=_NONE,
    )
    slides: bool | None = column(
        "Whether that exceeds the friction coefficient of the settings: the model does not hold", default=None
    )
    bounces: bool | None = column(
        "Whether a contact would have to pull: the model does not hold", default=None
    )
    contacts_unknown: str = column(
        "Why nothing is known of the contacts; empty where something is", default=""
    )
    ties: str = column(
        "Which ties yield or break on the way to the largest rotation; empty where none does", default=""
    )
    warning: str = column("What the model leaves out under this motion; empty for nothing", default="")
    reason: str = column("Why it failed, if it did", default="")


@row(
    "comparison",
    "One row per structure: the closed form under the dominant pulse beside the integration of the whole record",
)
@final
class ComparisonRow(CaseRow):
    """One case: the prediction beside the integration, and what answered."""

    predicted_rotation_ratio: float = column("Exact maximum of the equivalent block under the dominant pulse")
    integrated_rotation_ratio: float = column(
        "Nonlinear mechanism under the whole record; empty where something cheaper settled the verdict"
    )
    prediction_over_integration: float = column("Predicted over integrated rotation ratio, where both rock")
    prediction_in_words: str = column(
        "How the prediction stands to the integration; empty where one is missing"
    )
    within_factor_two: bool | None = column("Whether that ratio lies between 1/2 and 2, where both rock")
    agreement: Agreement = column(
        "Rest, rocking or overturning in the closed form and in the integration: same outcome, too low or too high"
    )
    regime: Regime | None = column(meanings.REGIME)
    answer_method: Method = column("What settled the verdict: the mechanism on the record, or with auto less")
    answer_outcome: Outcome = column("What that says: no uplift, rocks, overturns or failed")
    answer_reason: str = column("Why that one settled it, where fidelity: auto chose it")
    overturning_estimate: float = column(
        "Estimate of the share of members that overturn, from p PGV/(gλ), calibrated on real records; empty where an "
        "ensemble ran or the structure is unlike those of the calibration"
    )
    overturning_estimate_low: float = column("Lower end of its 90 % interval")
    overturning_estimate_high: float = column("Upper end of its 90 % interval")

    @property
    def spared(self) -> bool:
        """Whether something cheaper than the full integration answered."""
        return self.answer_method is not Method.MECHANISM_ON_RECORD


@row(
    "ensemble",
    "One row per structure: what becomes of it when what is not known varies; component 'both' for all directions",
)
@final
class EnsembleRow(CaseRow):
    """The ensemble of one case."""

    verdict: Verdict = column("stands, overturns or undecided, from the share and the risk beside it")
    overturning_share: float = column("Share of the members that overturn")
    overturning_members: int = column("Members that overturn")
    members: int = column("Members that were followed")
    failed_members: int = column("Members that could not be followed")
    crack: str = column(meanings.CRACK, default="")
    elsewhere_crack: str = column(meanings.ELSEWHERE, default="")
    elsewhere_overturning_members: int | None = column(
        "Members that overturn where it cracks there", default=None
    )
    elsewhere_members: int | None = column("Members that were followed there", default=None)
    uplift_share: float = column("Share of the members that lift")
    rotation_ratio_low: float = column("5 % quantile of largest rotation over critical rotation")
    rotation_ratio_median: float = column("Median of largest rotation over critical rotation")
    rotation_ratio_high: float = column(
        "95 % quantile of largest rotation over critical rotation; INF if it overturns"
    )
    risk: float = column("Largest probability of the opposite that the verdict may bear")
    amplitude_range: float = column("The motion varied by plus or minus this share")
    restitution_range: float = column(
        "The restitution varied by plus or minus this much, that of the structure or else of the settings"
    )
    amplitude_share: float = column(_SHARE.format("the amplitude"))
    restitution_share: float = column(_SHARE.format("the restitution"))
    polarity_share: float = column(_SHARE.format("the sign of the motion"))
    direction_share: float = column(_SHARE.format("the direction"))
    processing_share: float = column(_SHARE.format("the processing of the record"))
    vertical_share: float = column(_SHARE.format("the vertical motion"))
    worst_direction: str = column("Direction in which it rotates most on average; empty with one direction")
    worst_polarity: str = column(
        "Sign of the motion with which it rotates most on average: as recorded or reversed; empty where it has no part"
    )
    worst_processing: str = column(
        "Processing under which it rotates most on average; empty with one processing", default=""
    )


@row(
    "candidates",
    "One row per crack that may form, as a hinge of a wall at another height: the governing one is marked",
)
@final
class CandidateRow(CaseRow):
    """One crack that may form."""

    description: str = column("What opens, and where")
    position_m: float = column(
        "Height of the hinge or of the crack above the base; empty where none tells it"
    )
    predicted_rotation_ratio: float = column("Exact maximum of its equivalent block under the dominant pulse")
    integrated_rotation_ratio: float = column("Its mechanism under the whole record")
    governs_pulse: bool = column("Whether it rotates most under the pulse; the lowest of those that overturn")
    governs_record: bool = column(
        "Whether it rotates most under the record; the lowest of those that overturn"
    )


_NOT_RUN = Response(math.nan, Outcome.FAILED)


def maximum_rows(identity: Identity, case: Case, friction_coefficient: float) -> Iterator[MaximumRow]:
    """Yield the row of each closed form, and of each integration."""
    reference = case.responses.get(Method.MECHANISM_ON_RECORD, _NOT_RUN).rotation_ratio
    if case.prediction is not None:
        yield from _closed_forms(identity, case, case.prediction, reference)
    for method, response in case.responses.items():
        on_record = method is Method.MECHANISM_ON_RECORD
        check = case.check if on_record else UNKNOWN
        yield MaximumRow(
            **identity.columns,
            structure=case.structure,
            method=method,
            rotation_ratio=response.rotation_ratio,
            rotation_rad=_rotation(case.mechanism, response.rotation_ratio, response.peak_side),
            outcome=response.outcome,
            error=math.nan if on_record else ratio(response.rotation_ratio, reference) - 1,
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
            warning=response.warning,
            reason=response.reason,
        )


def _closed_forms(
    identity: Identity, case: Case, prediction: Prediction, reference: float
) -> Iterator[MaximumRow]:
    """Eq. 15 as printed, and the exact closed form."""
    maximum = prediction.maximum
    shared = identity.columns | {
        "structure": case.structure,
        "pulse_rank": prediction.rank,
        "amplitude_ratio": prediction.amplitude_ratio,
        "frequency_ratio": prediction.frequency_ratio,
    }
    yield MaximumRow(
        **shared,
        method=Method.PRINTED,
        rotation_ratio=prediction.printed,
        rotation_rad=prediction.printed * prediction.block.critical_rotation,
        error=ratio(prediction.printed, reference) - 1,
    )
    yield MaximumRow(
        **shared,
        method=Method.CLOSED_FORM,
        rotation_ratio=maximum.rotation_ratio,
        rotation_rad=_rotation(case.mechanism, maximum.rotation_ratio, maximum.peak_side),
        outcome=maximum.outcome,
        error=ratio(maximum.rotation_ratio, reference) - 1,
        regime=maximum.regime,
        impacts=maximum.impacts,
    )


def _rotation(mechanism: Mechanism, rotation_ratio: float, side: int) -> float:
    """The rotation in rad that `rotation_ratio` means on `side` (+1 or −1) of `mechanism`."""
    return rotation_ratio * mechanism.sides[0 if side >= 0 else -1].critical_rotation


def processing_rows(identity: Identity, structure: str, variants: Iterable[Variant]) -> Iterator[MaximumRow]:
    """Yield the row of each processing of the record for one structure."""
    for variant in variants:
        yield MaximumRow(
            **identity.columns,
            structure=structure,
            method=Method.MECHANISM_ON_RECORD,
            processing=variant.processing,
            rotation_ratio=variant.rotation_ratio,
            outcome=variant.outcome,
        )


def comparison_row(identity: Identity, case: Case) -> ComparisonRow:
    """Return the row of one case: the closed form beside the integration of the whole record."""
    reference = case.responses.get(Method.MECHANISM_ON_RECORD, _NOT_RUN)
    prediction, estimate = case.prediction, case.estimate
    predicted = prediction.maximum.rotation_ratio if prediction else math.nan
    integrated = reference.rotation_ratio
    return ComparisonRow(
        **identity.columns,
        structure=case.structure,
        predicted_rotation_ratio=predicted,
        integrated_rotation_ratio=integrated,
        prediction_over_integration=ratio(predicted, integrated),
        prediction_in_words=ratio_in_words(predicted, integrated),
        within_factor_two=within_factor_two(predicted, integrated),
        agreement=agreement(predicted, integrated),
        regime=prediction.maximum.regime if prediction else None,
        answer_method=case.answer.method,
        answer_outcome=case.answer.outcome,
        answer_reason=case.answer.reason,
        overturning_estimate=estimate.share if estimate else math.nan,
        overturning_estimate_low=estimate.low if estimate else math.nan,
        overturning_estimate_high=estimate.high if estimate else math.nan,
    )


def ensemble_row(identity: Identity, structure: str, ensemble: Ensemble, component: str = "") -> EnsembleRow:
    """Return the row of one ensemble. component: instead of the one of `identity`."""
    shown = identity.columns | ({"component": component} if component else {})
    shown |= {
        f"{name}_share": ensemble.shares.get(name, float("nan"))
        for name in ("amplitude", "restitution", "polarity", "direction", "processing", "vertical")
    }
    elsewhere = ensemble.elsewhere
    return EnsembleRow(
        **shown,
        structure=structure,
        verdict=ensemble.verdict,
        overturning_share=ensemble.overturning_share,
        overturning_members=ensemble.overturning,
        members=ensemble.members,
        failed_members=ensemble.failed,
        crack=ensemble.crack,
        elsewhere_crack=elsewhere.crack if elsewhere else "",
        elsewhere_overturning_members=elsewhere.overturning if elsewhere else None,
        elsewhere_members=elsewhere.members if elsewhere else None,
        uplift_share=ensemble.uplift_share,
        rotation_ratio_low=ensemble.low,
        rotation_ratio_median=ensemble.median,
        rotation_ratio_high=ensemble.high,
        risk=ensemble.settings.risk,
        amplitude_range=ensemble.settings.amplitude_range,
        restitution_range=ensemble.settings.restitution_range,
        worst_direction=_worst(ensemble, "direction"),
        worst_polarity={"1.0": "as recorded", "-1.0": "reversed"}.get(_worst(ensemble, "polarity"), ""),
        worst_processing=_worst(ensemble, "processing"),
    )


def _worst(ensemble: Ensemble, cause: str) -> str:
    values = ensemble.causes.get(cause)
    if values is None:
        return ""
    capped = np.minimum(ensemble.rotation_ratios, 1.0)
    means = {str(name): float(np.nanmean(capped[values == name])) for name in np.unique(values)}
    return max(means, key=means.__getitem__)


def candidate_rows(
    identity: Identity, structure: str, candidates: Sequence[CrackResponse]
) -> Iterator[CandidateRow]:
    """Yield the row of each crack that may form in one structure."""
    on_pulse = governing([candidate.predicted for candidate in candidates])
    on_record = governing([candidate.integrated for candidate in candidates])
    for place, candidate in enumerate(candidates):
        yield CandidateRow(
            **identity.columns,
            structure=structure,
            description=candidate.description,
            position_m=candidate.position,
            predicted_rotation_ratio=candidate.predicted,
            integrated_rotation_ratio=candidate.integrated,
            governs_pulse=place == on_pulse,
            governs_record=place == on_record,
        )


@row(
    "histories",
    "One row per component, structure and step: the rotation as it was integrated, until it overturns",
)
class HistoryRow(Row):
    """One step of one response."""

    record: str = column(meanings.RECORD)
    component: str = column(meanings.COMPONENT)
    structure: str = column(meanings.STRUCTURE)
    time_s: float = column("Time after the first sample")
    rotation_rad: float = column("Rotation, signed by the side; zero before uplift")
    angular_velocity_rad_s: float = column("Its derivative, after the impact where there is one")


def history_rows(record: str, responses: Mapping[tuple[str, str], Response]) -> Iterator[HistoryRow]:
    """Yield the history of each response by component and structure, as maxima.csv sums it up.

    A response without a history has no rows.
    """
    for (component, structure), response in responses.items():
        if response.times is None or response.rotation is None or response.angular_velocity is None:
            continue
        steps = (response.times, response.rotation, response.angular_velocity)
        for time, rotation, velocity in zip(*(each.tolist() for each in steps), strict=True):
            yield HistoryRow(
                record=record,
                component=component,
                structure=structure,
                time_s=time,
                rotation_rad=rotation,
                angular_velocity_rad_s=velocity,
            )
