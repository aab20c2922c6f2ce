"""Every method's probability of overturning, test by test, from fits that never saw the motion of the test."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from docs.research.identification import (
    MEMBERS,
    BlockPrior,
    Identification,
    identification_of,
    overturning_table,
)
from docs.research.tier_cases import dominant_pulse
from docs.research.validation.baselines import fit_logistic, fit_threshold, single_best
from docs.research.validation.campaign import Campaign, TableTest
from rocking.pulses import Pulse
from rocking.records.processing import Processing, process, velocity
from rocking.sine_pulse import predict_maxima
from rocking.structures import EquivalentBlock

TABLE_PROCESSING = Processing(baseline="linear", low_pass=30.0, time_step=0.01)
"""What the measured motions of the table go through: the sensor's offset, of up to 0.02 g, is a seventh of λ."""
VELOCITY_PROCESSING = Processing(baseline="linear", high_pass=0.1, low_pass=30.0, time_step=0.01)
"""What they go through before they are integrated to a velocity."""
IDENTIFIED = "identified population"
TABLE_PRIOR = BlockPrior(
    uplift_multiplier=(0.03, 0.2),
    frequency_parameter=(2.5, 9.0),
    side_ratio=1.6,
    restitution=(0.6, 0.99),
    size=4096,
)
"""What is tried: λ from a third of what one expects of a boulder on its end, p from half to twice the mesh's."""

Fitted = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Probabilities (k,) of tests (k,) after a fit to the tests (n,), both by index."""


@dataclass(frozen=True, eq=False)
class Measured:
    """The tests as every method sees them. peak_acceleration, peak_velocity: (n,) m/s², m/s, of the table as measured.

    overturns: (n, m) verdict of each candidate block on the record. pulse_overturns: (n, m) the same in closed form
    under the dominant pulse.
    """

    tests: tuple[TableTest, ...]
    prior: BlockPrior
    candidates: tuple[EquivalentBlock, ...]
    peak_acceleration: np.ndarray
    peak_velocity: np.ndarray
    overturns: np.ndarray
    pulse_overturns: np.ndarray

    @property
    def motions(self) -> np.ndarray:
        """(n,) label of the input motion."""
        return np.array([test.motion for test in self.tests])

    def outcomes(self, specimen: int) -> np.ndarray:
        """(n,) whether specimen 1 or 2 overturned."""
        return np.array([test.overturned[specimen - 1] for test in self.tests])


def measure(
    campaign: Campaign,
    prior: BlockPrior,
    workers: int | None = None,
    tell: Callable[[str], None] = lambda line: None,
) -> Measured:
    """Follow every candidate through every measured motion, one motion in memory at a time.

    tell: is given a line as each test begins.
    """
    candidates = prior.blocks()
    peaks, verdicts, pulses = [], [], []
    for number, test in enumerate(campaign.tests, start=1):
        tell(f"{number} of {len(campaign.tests)}: test {test.number}")
        table_motion = campaign.table_motion(test)
        motion = process(table_motion, TABLE_PROCESSING)
        speed = velocity(process(table_motion, VELOCITY_PROCESSING))
        peaks.append((motion.peak_acceleration, float(np.abs(speed).max())))
        verdicts.append(overturning_table(candidates, [motion], workers=workers)[0])
        pulses.append(dominant_pulse(motion))
    closed = pulse_verdicts(candidates, pulses)
    acceleration, speeds = np.array(peaks).T
    return Measured(campaign.tests, prior, candidates, acceleration, speeds, np.array(verdicts), closed)


def left_out(measured: Measured, specimen: int) -> Mapping[str, np.ndarray]:
    """Return by method the probability of overturning (n,) of every test, its motion left out of the fit."""
    motions = measured.motions
    found = {name: np.empty(motions.size) for name in _methods(measured, specimen)}
    for name, fitted in _methods(measured, specimen).items():
        for motion in np.unique(motions):
            out = motions == motion
            found[name][out] = fitted(np.flatnonzero(~out), np.flatnonzero(out))
    return found | published(measured.tests, specimen)


def identified(measured: Measured, specimen: int, tests: np.ndarray | None = None) -> Identification:
    """Return the identification of a specimen from some of the tests, by index; all if None."""
    kept = np.arange(len(measured.tests)) if tests is None else tests
    return identification_of(
        measured.overturns[kept],
        measured.outcomes(specimen)[kept],
        measured.motions[kept].tolist(),
        measured.candidates,
        TABLE_PROCESSING,
        MEMBERS,
    )


def published(tests: Sequence[TableTest], specimen: int) -> dict[str, np.ndarray]:
    """Return the verdicts of other codes, 0 or 1, by their names; they were not fitted here."""
    names = tests[0].published[specimen - 1]
    return {
        f"published {name.replace('_', ' ')}": np.array(
            [float(test.published[specimen - 1][name]) for test in tests]
        )
        for name in names
    }


def _methods(measured: Measured, specimen: int) -> Mapping[str, Fitted]:
    outcomes = measured.outcomes(specimen)
    stated = np.array([test.peak_velocity for test in measured.tests])

    def population(kept: np.ndarray, out: np.ndarray) -> np.ndarray:
        found = identified(measured, specimen, kept)
        share = measured.overturns[np.ix_(out, found.members)].mean(axis=1)
        return found.mixture.of_share(share)

    def one_block(verdicts: np.ndarray) -> Fitted:
        return lambda kept, out: verdicts[out, single_best(verdicts[kept], outcomes[kept])].astype(float)

    def threshold(values: np.ndarray) -> Fitted:
        return lambda kept, out: (values[out] > fit_threshold(values[kept], outcomes[kept])).astype(float)

    def logistic(values: np.ndarray) -> Fitted:
        return lambda kept, out: fit_logistic(values[kept], outcomes[kept]).probability(values[out])

    return {
        IDENTIFIED: population,
        "one block on the record": one_block(measured.overturns),
        "closed form on the dominant pulse": one_block(measured.pulse_overturns),
        "threshold on peak velocity, nominal": threshold(stated),
        "threshold on peak velocity, measured": threshold(measured.peak_velocity),
        "logistic regression on peak velocity": logistic(measured.peak_velocity),
        "logistic regression on peak acceleration": logistic(measured.peak_acceleration),
    }


def pulse_verdicts(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse | None]) -> np.ndarray:
    """Return (n, m) whether each block overturns under each pulse, in closed form; none does without a pulse."""
    found = np.zeros((len(pulses), len(blocks)), dtype=bool)
    known = [k for k, pulse in enumerate(pulses) if pulse is not None]
    if known:
        found[known] = np.isinf(predict_maxima(blocks, [pulse for pulse in pulses if pulse is not None])).T
    return found
