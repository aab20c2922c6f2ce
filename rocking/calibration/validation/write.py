"""The validation as tables: scores with paired intervals, reliability, confusion, failures, and what was identified."""

import itertools
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np

from rocking.assessment.rows.of_validation import (
    ROW_CLASSES,
    ConfusionRow,
    FailureRow,
    IdentifiedRow,
    MemberRow,
    PredictionRow,
    ReliabilityRow,
    ScoreRow,
    TimingRow,
)
from rocking.calibration.identification import PARAMETERS, BlockPrior, Identification, overturning_table
from rocking.calibration.validation import scores
from rocking.calibration.validation.campaign import Campaign
from rocking.calibration.validation.predictions import (
    IDENTIFIED,
    TABLE_PRIOR,
    TABLE_PROCESSING,
    Measured,
    identified,
    left_out,
    measure,
)
from rocking.calibration.validation.source import SPECIMENS
from rocking.calibration.validation.specimen import Specimen, specimen_from_mesh
from rocking.records.processing import process
from rocking.tables import Row, data_package, write_rows, write_whole

SPEED_CLASSES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.6, np.inf)
"""Edges of the classes of peak velocity, m/s."""
TIMED = 40
"""Tests on which the time of a prediction is measured, spread evenly."""


def write_validation(
    catalogue: Path,
    mirror: Path | None,
    folder: Path,
    workers: int | None = None,
    tell: Callable[[str], None] = lambda line: None,
) -> None:
    """Write every table of the validation and its description into `folder`; `tell` is given lines for a log.

    catalogue: records/shake_table.csv. mirror: a folder of the campaign, or beside one (`Campaign.open`).
    """
    campaign = Campaign.open(catalogue, mirror)
    measured = measure(campaign, TABLE_PRIOR, workers, tell)
    rows: dict[type[Row], list[Row]] = {kind: [] for kind in ROW_CLASSES}
    for specimen in range(1, len(SPECIMENS) + 1):
        probability = left_out(measured, specimen)
        final = identified(measured, specimen)
        body = specimen_from_mesh(campaign.mesh_text(specimen))
        rows[PredictionRow] += prediction_rows(measured, specimen, probability)
        rows[ScoreRow] += score_rows(measured, specimen, probability)
        rows[ReliabilityRow] += reliability_rows(measured, specimen, probability[IDENTIFIED])
        rows[ConfusionRow] += confusion_rows(measured, specimen, probability[IDENTIFIED])
        rows[FailureRow] += failure_rows(measured, specimen, probability[IDENTIFIED])
        rows[IdentifiedRow] += identified_rows(measured.prior, specimen, final, body)
        rows[MemberRow] += member_rows(specimen, final)
        rows[TimingRow].append(timing_row(campaign, specimen, final))
    for kind in ROW_CLASSES:
        write_rows(kind, rows[kind], folder / kind.table.file_name)
    resources = {kind.table.name: (kind.table, kind.table.file_name) for kind in ROW_CLASSES}
    write_whole(folder / "datapackage.json", data_package("rocking-validation", resources))
    unlisted = f" {len(campaign.unlisted)} tests are not in the catalogue." if campaign.unlisted else ""
    tell(f"{len(campaign.tests)} tests of {campaign.folder}.{unlisted}")


def prediction_rows(
    measured: Measured, specimen: int, probability: Mapping[str, np.ndarray]
) -> Iterator[PredictionRow]:
    """Yield what every method said of every test."""
    for method, values in probability.items():
        for k, test in enumerate(measured.tests):
            yield PredictionRow(
                specimen=specimen,
                method=method,
                test=test.number,
                motion=test.motion,
                peak_acceleration_m_s2=float(measured.peak_acceleration[k]),
                peak_velocity_m_s=float(measured.peak_velocity[k]),
                probability=float(values[k]),
                overturned=test.overturned[specimen - 1],
            )


def score_rows(
    measured: Measured, specimen: int, probability: Mapping[str, np.ndarray]
) -> Iterator[ScoreRow]:
    """Yield the scores of every method, with intervals and gains paired by the motions drawn."""
    outcomes, motions = measured.outcomes(specimen), measured.motions.tolist()
    ours = probability[IDENTIFIED]
    for method, values in probability.items():

        def right(rows: np.ndarray, values: np.ndarray = values) -> float:
            return scores.accuracy(values[rows], outcomes[rows])

        def missed_by(rows: np.ndarray, values: np.ndarray = values) -> float:
            return scores.brier(values[rows], outcomes[rows])

        def more_right(rows: np.ndarray, values: np.ndarray = values) -> float:
            return scores.accuracy(ours[rows], outcomes[rows]) - scores.accuracy(values[rows], outcomes[rows])

        def nearer(rows: np.ndarray, values: np.ndarray = values) -> float:
            return scores.brier(values[rows], outcomes[rows]) - scores.brier(ours[rows], outcomes[rows])

        every = np.arange(outcomes.size)
        bounds = [scores.interval(each, motions) for each in (right, missed_by, more_right, nearer)]
        said = values > 0.5
        yield ScoreRow(
            specimen=specimen,
            method=method,
            tests=outcomes.size,
            motions=len(set(motions)),
            accuracy=right(every),
            accuracy_low=bounds[0][0],
            accuracy_high=bounds[0][1],
            brier=missed_by(every),
            brier_low=bounds[1][0],
            brier_high=bounds[1][1],
            missed=int((outcomes & ~said).sum()),
            false=int((~outcomes & said).sum()),
            accuracy_gain=more_right(every),
            accuracy_gain_low=bounds[2][0],
            accuracy_gain_high=bounds[2][1],
            brier_gain=nearer(every),
            brier_gain_low=bounds[3][0],
            brier_gain_high=bounds[3][1],
            calibration_slope=scores.calibration_slope(values, outcomes),
            logit_slope=scores.logit_slope(values, outcomes),
        )


def reliability_rows(measured: Measured, specimen: int, probability: np.ndarray) -> Iterator[ReliabilityRow]:
    """Yield the reliability diagram of the identified population."""
    outcomes = measured.outcomes(specimen)
    for each in scores.reliability(probability, outcomes, measured.motions.tolist()):
        yield ReliabilityRow(
            specimen=specimen,
            tests=each.tests,
            stated=each.stated,
            observed=each.observed,
            observed_low=each.low,
            observed_high=each.high,
        )


def confusion_rows(measured: Measured, specimen: int, probability: np.ndarray) -> Iterator[ConfusionRow]:
    """Yield right and wrong verdicts by class of peak velocity."""
    outcomes, said = measured.outcomes(specimen), probability > 0.5
    for low, high in itertools.pairwise(SPEED_CLASSES):
        inside = (measured.peak_velocity >= low) & (measured.peak_velocity < high)
        if inside.any():
            yield ConfusionRow(
                specimen=specimen,
                lowest_peak_velocity_m_s=low,
                highest_peak_velocity_m_s=high,
                stood=int((inside & ~outcomes & ~said).sum()),
                overturned=int((inside & outcomes & said).sum()),
                missed=int((inside & outcomes & ~said).sum()),
                false=int((inside & ~outcomes & said).sum()),
            )


def failure_rows(measured: Measured, specimen: int, probability: np.ndarray) -> Iterator[FailureRow]:
    """Yield the tests whose verdict was wrong, the surest first."""
    outcomes = measured.outcomes(specimen)
    contradicted = contradictions(measured.peak_velocity, outcomes, measured.motions)
    right = (measured.overturns == outcomes[:, None]).mean(axis=1)
    wrong = np.flatnonzero((probability > 0.5) != outcomes)
    for k in wrong[np.argsort(-np.abs(probability[wrong] - 0.5), kind="stable")]:
        test = measured.tests[k]
        yield FailureRow(
            specimen=specimen,
            test=test.number,
            motion=test.motion,
            peak_velocity_m_s=float(measured.peak_velocity[k]),
            probability=float(probability[k]),
            overturned=bool(outcomes[k]),
            contradicted=bool(contradicted[k]),
            candidates_right=float(right[k]),
        )


def contradictions(measure: np.ndarray, outcomes: np.ndarray, motions: np.ndarray) -> np.ndarray:
    """Return (n,) whether a test overturned while a stronger one of its motion stood, or stood while a weaker fell."""
    same = motions[:, None] == motions
    weaker = same & (measure[:, None] < measure)
    pair = weaker & outcomes[:, None] & ~outcomes
    return pair.any(axis=1) | pair.any(axis=0)


def identified_rows(
    prior: BlockPrior, specimen: int, found: Identification, body: Specimen
) -> Iterator[IdentifiedRow]:
    """Yield the ranges of the parameters beside those that the mesh allows."""
    ranges = found.ranges()
    multipliers = [ranges[name][1] for name in PARAMETERS[:2]]
    tried = prior.parameters()
    mesh = {
        PARAMETERS[0]: body.uplift_multiplier(),
        PARAMETERS[1]: body.uplift_multiplier(),
        PARAMETERS[2]: body.frequency_parameter(float(np.mean(multipliers))),
        PARAMETERS[3]: body.restitution(multipliers[0], multipliers[1]),
    }
    for k, name in enumerate(PARAMETERS):
        low, median, high = ranges[name]
        yield IdentifiedRow(
            specimen=specimen,
            parameter=name,
            low=low,
            median=median,
            high=high,
            prior_low=float(tried[:, k].min()),
            prior_high=float(tried[:, k].max()),
            mesh_low=mesh[name][0],
            mesh_high=mesh[name][1],
        )


def member_rows(specimen: int, found: Identification) -> Iterator[MemberRow]:
    """Yield the blocks that predictions follow."""
    distinct, count = np.unique(found.members, return_counts=True)
    for j, many in zip(distinct.tolist(), count.tolist(), strict=True):
        positive, negative, frequency, restitution = found.parameters()[j].tolist()
        yield MemberRow(
            specimen=specimen,
            share=many / found.members.size,
            uplift_multiplier_positive=positive,
            uplift_multiplier_negative=negative,
            frequency_parameter_rad_s=frequency,
            restitution=restitution,
            unexplained=found.mixture.unexplained,
            iterations=found.mixture.iterations,
        )


def timing_row(campaign: Campaign, specimen: int, found: Identification) -> TimingRow:
    """Measure the processor time of predictions, all members together, of motions that are processed already."""
    chosen = np.unique(np.linspace(0, len(campaign.tests) - 1, TIMED).astype(int))
    motions = [process(campaign.table_motion(campaign.tests[k]), TABLE_PROCESSING) for k in chosen]
    blocks = [found.candidates[j] for j in np.unique(found.members)]
    spent: list[float] = []
    for _ in range(3):
        start = time.process_time()
        overturning_table(blocks, motions, workers=1)
        spent.append((time.process_time() - start) / len(motions))
    return TimingRow(specimen=specimen, tests=len(motions), members=len(blocks), duration_s=float(min(spent)))
