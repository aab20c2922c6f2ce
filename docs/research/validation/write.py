"""The validation as tables: scores with paired intervals, reliability, confusion, failures, and what was identified."""

import itertools
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import logit

from docs.research import scores
from docs.research.identification import PARAMETERS, BlockPrior, Identification, overturning_table
from docs.research.validation.campaign import Campaign
from docs.research.validation.predictions import (
    IDENTIFIED,
    TABLE_PRIOR,
    TABLE_PROCESSING,
    Measured,
    identified,
    left_out,
    measure,
)
from docs.research.validation.report import validation_report
from docs.research.validation.rows import (
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
from docs.research.validation.source import SPECIMENS
from docs.research.validation.specimen import Specimen, specimen_from_mesh
from rocking.records.processing import process
from rocking.tables import Row, write_tables, write_whole

SPEED_CLASSES = (0.0, 0.1, 0.2, 0.3, 0.4, 0.6, np.inf)
"""Edges of the classes of peak velocity, m/s."""
RESAMPLES = 2000
"""Draws of an interval."""
NINETY_FIVE = (0.025, 0.975)
"""Levels of the paired intervals."""
EDGES = (0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0)
"""Of the classes of a reliability diagram."""
LOGIT_LIMITS = (0.01, 0.99)
"""Between which a probability is kept before its logit is taken."""
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
    write_tables(rows, folder, "rocking-validation")
    write_whole(folder / "validation.pdf", validation_report(folder))
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
    outcomes, motions = measured.outcomes(specimen), measured.motions
    draws, every = scores.resampled(motions, RESAMPLES), np.arange(outcomes.size)
    for method, values in probability.items():
        columns: dict[str, Any] = {}
        for name, score in _scores(values, probability[IDENTIFIED], outcomes).items():
            low, high = scores.interval(score, draws, NINETY_FIVE)
            columns |= {name: score(every), f"{name}_low": low, f"{name}_high": high}
        said = values > 0.5
        yield ScoreRow(
            specimen=specimen,
            method=method,
            tests=outcomes.size,
            motions=len(set(motions)),
            **columns,
            missed=int((outcomes & ~said).sum()),
            false=int((~outcomes & said).sum()),
            calibration_slope=scores.calibration_slope(values, outcomes),
            logit_slope=scores.logit_slope(logit(np.clip(values, *LOGIT_LIMITS)), outcomes),
        )


def _scores(values: np.ndarray, ours: np.ndarray, outcomes: np.ndarray) -> dict[str, scores.Measure]:
    """The scores of probabilities (n,), and what `ours` gains in them, by the names of their columns."""

    def right(said: np.ndarray, rows: np.ndarray) -> float:
        return scores.accuracy(said[rows], outcomes[rows])

    def missed_by(said: np.ndarray, rows: np.ndarray) -> float:
        return scores.brier(said[rows], outcomes[rows])

    return {
        "accuracy": lambda rows: right(values, rows),
        "brier": lambda rows: missed_by(values, rows),
        "accuracy_gain": lambda rows: right(ours, rows) - right(values, rows),
        "brier_gain": lambda rows: missed_by(values, rows) - missed_by(ours, rows),
    }


def reliability_rows(measured: Measured, specimen: int, probability: np.ndarray) -> Iterator[ReliabilityRow]:
    """Yield the reliability diagram of the identified population."""
    draws = scores.resampled(measured.motions, RESAMPLES)
    for each in scores.reliability(probability, measured.outcomes(specimen), EDGES, draws):
        yield ReliabilityRow(
            specimen=specimen,
            tests=each.rows.size,
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
            sharpness=found.mixture.sharpness,
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
