"""The shake table: every method's probability of overturning, from fits that never saw the motion of the test."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.special import logit

from docs.research import scores
from docs.research.identification import BlockPrior, blocks_of, fit_mixture, overturning_table
from docs.research.report import publish
from docs.research.scores import Score
from docs.research.shake_table import SPECIMENS, Campaign
from docs.research.sites import Tell
from rocking.errors import PulseError
from rocking.pulses import Pulse, extract_pulses
from rocking.records.processing import Processing, process, velocity
from rocking.sine_pulse import predict_maxima
from rocking.tables import Row, column, row

TABLE_PROCESSING = Processing(baseline="linear", low_pass=30.0, time_step=0.01)
"""What the measured motions of the table go through: the sensor's offset, of up to 0.02 g, is a seventh of λ."""
VELOCITY_PROCESSING = Processing(baseline="linear", high_pass=0.1, low_pass=30.0, time_step=0.01)
"""What they go through before they are integrated to a velocity."""
NO_PULSE = Pulse(1e-9, 1.0, 0.0)
"""Overturns nothing: stands for the pulse of a motion that has none."""
IDENTIFIED = "identified population"
PRIOR = BlockPrior((0.03, 0.2), (2.5, 9.0), side_ratio=1.6, restitution=(0.6, 0.99), size=4096)
"""What is tried: λ from a third of what one expects of a boulder on its end, p from half to twice the boulder's."""
EDGES = (0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0)
"""Of the classes of a reliability diagram."""
ABOUT = (
    "Each specimen is a rigid body on two contact lines, with its own uplift multiplier λ on each side, one frequency "
    "parameter p and one restitution η, none of which is published. Blocks spread evenly over wide ranges are followed "
    "through the measured motion of the table; their weights are a mixing distribution of largest likelihood, stopped "
    "early. Where to stop is chosen among the motions of the fit alone, and everything is done anew for each motion "
    "left out, the baselines included. The settings among which it chooses, and those of the published verdicts, were "
    "chosen on these tests. Gains are paired; one is sure where its interval lies above 0."
)

Fitted = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Probabilities (k,) of tests (k,) after a fit to the tests (n,), both by index."""


@row("predictions", "One row per specimen, method and test, its motion left out of the fit")
class PredictionRow(Row):
    """One method on one test."""

    specimen: int = column("Number of the specimen")
    method: str = column("How the prediction was made")
    test: int = column("Number of the test")
    motion: str = column("Input motion, which the table played scaled")
    probability: float = column("Predicted probability of overturning; 0 or 1 where the method knows no more")
    overturned: bool = column("Whether it overturned")


@dataclass(frozen=True, eq=False)
class Measured:
    """The tests as every method sees them: those of the campaign with peak_acceleration and peak_velocity as measured.

    In m/s² and m/s. overturns: (n, m) verdict of each candidate block on the record. pulse_overturns: (n, m) the same
    in closed form under the dominant pulse.
    """

    tests: pd.DataFrame
    parameters: np.ndarray
    overturns: np.ndarray
    pulse_overturns: np.ndarray

    def outcomes(self, specimen: int) -> np.ndarray:
        """(n,) whether specimen 1 or 2 overturned."""
        return self.tests[f"overturned_specimen_{specimen}"].to_numpy()


def write_validation(catalogue: Path, mirror: Path | None, folder: Path, tell: Tell) -> None:
    """Write every table of the validation and its report into `folder`.

    catalogue: records/shake_table.csv. mirror: a folder of the campaign, or beside one (`Campaign.open`).
    """
    measured = measure(Campaign.open(catalogue, mirror), PRIOR, tell)
    tests = measured.tests
    motions = tests.motion.tolist()
    counts = {"cases": len(motions), "sites": len(set(motions))}
    rows: list[Score] = []
    predictions: list[PredictionRow] = []
    for specimen in SPECIMENS:
        probability, outcomes = left_out(measured, specimen), measured.outcomes(specimen)
        part, ours = f"specimen {specimen}", probability[IDENTIFIED]
        for method, values in probability.items():
            rows += scores.scored(method, part, _measures(values, ours, outcomes), motions)
            facts = zip(tests.test.tolist(), motions, values.tolist(), outcomes.tolist(), strict=True)
            for test, motion, stated, fell in facts:
                about = {"specimen": specimen, "method": method, "test": test, "motion": motion}
                predictions.append(PredictionRow(**about, probability=stated, overturned=fell))
        rows += scores.reliability(part, "motions left out", ours, outcomes, motions, EDGES)
        population = fit_mixture(measured.parameters, measured.overturns, outcomes, motions)
        for name, (low, middle, high) in population.ranges().items():
            about = {"subject": name, "part": f"{part}, 5 to 95 % of the population of all motions"}
            ends = {"value": middle, "value_low": low, "value_high": high}
            rows.append(Score(measure="median of the population", **about, **ends, **counts))
    subtitle = (
        f"{len(tests)} tests of two granite specimens under {counts['sites']} input motions, each motion left out of "
        "the fit that predicts it."
    )
    tables = {Score: rows, PredictionRow: predictions}
    publish(folder, "Validation against shake-table tests", subtitle, tables, [{"text": ABOUT}])


def measure(campaign: Campaign, prior: BlockPrior, tell: Tell) -> Measured:
    """Follow every candidate through every measured motion, one motion in memory at a time."""
    parameters = prior.parameters()
    blocks = blocks_of(parameters)
    peaks, verdicts, pulses = [], [], []
    for count, number in enumerate(campaign.tests.test, start=1):
        tell(f"{count} of {len(campaign.tests)}: test {number}")
        table_motion = campaign.table_motion(number)
        motion = process(table_motion, TABLE_PROCESSING)
        speed = velocity(process(table_motion, VELOCITY_PROCESSING))
        peaks.append((motion.peak_acceleration, float(np.abs(speed).max())))
        verdicts.append(overturning_table(blocks, [motion])[0])
        try:
            pulses.append(extract_pulses(motion).dominant)
        except PulseError:
            pulses.append(NO_PULSE)
    acceleration, speeds = np.array(peaks).T
    tests = campaign.tests.assign(peak_acceleration=acceleration, peak_velocity=speeds)
    return Measured(tests, parameters, np.array(verdicts), np.isinf(predict_maxima(blocks, pulses)).T)


def left_out(measured: Measured, specimen: int) -> Mapping[str, np.ndarray]:
    """Return by method the probability of overturning (n,) of every test, its motion left out of the fit."""
    motions = measured.tests.motion.to_numpy()
    probability = {}
    for name, fitted in methods(measured, specimen).items():
        probability[name] = np.empty(motions.size)
        for motion in np.unique(motions):
            out = motions == motion
            probability[name][out] = fitted(np.flatnonzero(~out), np.flatnonzero(out))
    start = f"specimen_{specimen}_"
    for name, verdicts in measured.tests.items():
        if str(name).startswith(start):  # not fitted here
            published = str(name).removeprefix(start).replace("_", " ")
            probability[f"published {published}"] = verdicts.to_numpy(float)
    return probability


def methods(measured: Measured, specimen: int) -> Mapping[str, Fitted]:
    """Return every method by its name: the population, and what it must beat."""
    tests, outcomes = measured.tests, measured.outcomes(specimen)

    def population(kept: np.ndarray, out: np.ndarray) -> np.ndarray:
        motions = tests.motion.to_numpy()[kept].tolist()
        mixture = fit_mixture(measured.parameters, measured.overturns[kept], outcomes[kept], motions)
        return mixture.probability(measured.overturns[out])

    def one_block(verdicts: np.ndarray) -> Fitted:
        """The candidate with most verdicts right, the median one of several."""

        def fitted(kept: np.ndarray, out: np.ndarray) -> np.ndarray:
            wrong = (verdicts[kept] != outcomes[kept, None]).sum(axis=0)
            best = np.flatnonzero(wrong == wrong.min())
            return verdicts[out, best[best.size // 2]].astype(float)

        return fitted

    def threshold(values: pd.Series) -> Fitted:
        of = values.to_numpy()
        return lambda kept, out: (of[out] > fit_threshold(of[kept], outcomes[kept])).astype(float)

    def logistic(values: pd.Series) -> Fitted:
        logs = np.log(values.to_numpy())

        def fitted(kept: np.ndarray, out: np.ndarray) -> np.ndarray:
            design = np.column_stack([np.ones(logs.size), logs - logs[kept].mean()])
            ridge = 2e-4 / kept.size  # keeps the fit finite where the outcomes separate
            coefficients, _ = scores.logistic(design[kept], outcomes[kept], np.arange(kept.size), ridge)
            return 1 / (1 + np.exp(-design[out] @ coefficients))

        return fitted

    return {
        IDENTIFIED: population,
        "one block on the record": one_block(measured.overturns),
        "closed form on the dominant pulse": one_block(measured.pulse_overturns),
        "threshold on peak velocity, nominal": threshold(tests.nominal_peak_velocity),
        "threshold on peak velocity, measured": threshold(tests.peak_velocity),
        "logistic regression on peak velocity": logistic(tests.peak_velocity),
        "logistic regression on peak acceleration": logistic(tests.peak_acceleration),
    }


def fit_threshold(values: np.ndarray, outcomes: np.ndarray) -> float:
    """Return the value beyond which "overturns" is right most often; the middle of its gap, the lowest of several."""
    ranked = np.sort(values)
    limits = np.r_[ranked[0] / 2, np.sqrt(ranked[1:] * ranked[:-1]), 2 * ranked[-1]]
    return float(limits[np.argmax([np.sum((values > limit) == outcomes) for limit in limits])])


def _measures(values: np.ndarray, ours: np.ndarray, outcomes: np.ndarray) -> Mapping[str, scores.Measured]:
    """The measures of probabilities (n,), and what `ours` gains in them, paired."""
    right, ours_right = ((each > 0.5) == outcomes for each in (values, ours))
    missed_by, ours_missed_by = ((each - outcomes) ** 2 for each in (values, ours))
    return {
        "accuracy": right,
        "Brier score": missed_by,
        "gain of the population in accuracy": ours_right * 1.0 - right,
        "gain of the population in Brier score": missed_by - ours_missed_by,
        "missed overturnings": np.where(outcomes, values <= 0.5, 0.0),
        "false overturnings": np.where(outcomes, 0.0, values > 0.5),
        "slope of the logit": scores.logit_slope(logit(np.clip(values, 0.01, 0.99)), outcomes.astype(float)),
    }
