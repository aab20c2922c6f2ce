"""How good probabilities are against what happened, and how well each score is known: by drawing earthquakes anew."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from rocking.earthquakes.sample import REPLICATES, ClusterSample
from rocking.tables import Row, column, row

STATED, HAPPENED = "stated", "happened"
"""Measures of one class of a reliability diagram: its mean probability, and the share of its cases that overturned."""
Labels = Sequence[object] | np.ndarray
"""Of each case what is independent: an input motion, a drawn sample, a case."""
Measure = Callable[[np.ndarray], float]
"""A score of some of the cases, by index, with repeats; nan where they tell none."""
Measured = Measure | Sequence[float] | np.ndarray
"""A measure, or a value of each case (nan: it does not count), whose mean is the measure."""
Prediction = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""Probabilities (k,) of the last cases (k,) after a fit to the first (m,), both by index."""


@row(
    "scores",
    "One row per subject, part of the cases and measure, with a 90 % interval by resampling earthquakes",
)
class Score(Row):
    """One measure of one subject."""

    subject: str = column("What was judged: a tier, a method, an ensemble, a code")
    part: str = column("Cases on which it was judged")
    measure: str = column("What was measured")
    value: float = column("Its value on all cases of the part")
    value_low: float = column("Lower end of its 90 % interval, by earthquake")
    value_high: float = column("Upper end of that interval")
    sites: int = column("Sites behind it; of a shake table: input motions; of codes: cases")
    earthquakes: int = column("Earthquakes of these sites; of what has none, as many as there are")
    cases: int = column("Cases behind it")


def scored(
    subject: str,
    part: str,
    measures: Mapping[str, Measured],
    sample: ClusterSample | Labels,
    replicates: int = REPLICATES,
) -> Iterator[Score]:
    """Yield every measure of the cases (n,), with its interval, and how many sites, earthquakes and cases count.

    sample: the site and the earthquake of each case, or labels (n,) of what is independent.
    """
    drawn = sample if isinstance(sample, ClusterSample) else ClusterSample.scattered(list(map(str, sample)))
    every = np.arange(drawn.of_record.size)
    for name, rows in measures.items():
        measure = rows if callable(rows) else mean(rows)
        low, high = interval_of(rows, measure, drawn, replicates)
        counting = every if callable(rows) else np.flatnonzero(~np.isnan(np.asarray(rows, dtype=float)))
        behind = drawn.of_records(counting)
        yield Score(
            subject=subject,
            part=part,
            measure=name,
            value=measure(every),
            value_low=low,
            value_high=high,
            sites=behind.count,
            earthquakes=behind.earthquakes,
            cases=counting.size,
        )


def interval_of(
    given: Measured, measure: Measure, sample: ClusterSample, replicates: int = REPLICATES
) -> tuple[float, float]:
    """Return the 90 % interval of a measure of cases that are the records of a sample.

    Where all or none of the cases that count show something, no draw tells how often others do: the bounds are then
    those of a share, of which each site counts once.
    """
    values = np.array([np.nan]) if callable(given) else np.asarray(given, dtype=float)
    counts = ~np.isnan(values)
    if np.unique(values[counts]).tolist() in ([0.0], [1.0]):
        tried = np.bincount(sample.of_record, weights=counts, minlength=sample.count) > 0
        shown = tried * values[counts][0]
        bounds = sample.share_bounds(shown, tried=tried.astype(float))
        return float(bounds[0]), float(bounds[1])
    low, high = sample.interval(lambda weights: measure(rows_of(weights, sample)), replicates)
    is_share = bool(counts.any()) and values[counts].min() >= 0 and values[counts].max() <= 1
    return (low, min(high, 1.0)) if is_share else (low, high)


def rows_of(weights: np.ndarray, sample: ClusterSample) -> np.ndarray:
    """Return the cases of stations that are drawn so often, (s,), each case as often as its station."""
    return np.repeat(np.arange(sample.of_record.size), weights[sample.of_record].astype(int))


def reliability(
    subject: str,
    part: str,
    probability: np.ndarray,
    outcomes: np.ndarray,
    sample: ClusterSample | Labels,
    edges: Sequence[float],
) -> Iterator[Score]:
    """Yield what was STATED and what HAPPENED in the classes between `edges` that hold a case; (n,) in [0, 1]."""
    place = np.clip(np.searchsorted(edges, probability, side="right") - 1, 0, len(edges) - 2)
    for which in np.unique(place).tolist():
        own = place == which
        called = f"{part}, {edges[which]:g} to {edges[which + 1]:g} stated"
        measures = {STATED: probability[own], HAPPENED: outcomes[own]}
        part_of = sample.of_records(own) if isinstance(sample, ClusterSample) else np.asarray(sample)[own]
        yield from scored(subject, called, measures, part_of)


def left_out(labels: np.ndarray, predict: Prediction) -> np.ndarray:
    """Return the probability (n,) of each case from a fit that never saw a case of its label (n,)."""
    stated = np.empty(len(labels))
    for label in np.unique(labels):
        out = labels == label
        stated[out] = predict(np.flatnonzero(~out), np.flatnonzero(out))
    return stated


def drawn_from(pool: np.ndarray) -> Callable[[np.random.Generator, int], np.ndarray]:
    """Return what draws so many of the stations whose values or curves (n, ...) are `pool`, with repetition."""
    return lambda rng, count: rng.choice(pool, count)


def mean(values: Sequence[float] | np.ndarray, statistic: Callable[..., float] = np.mean) -> Measure:
    """Return the mean of `values` (n,), or another statistic, as a measure; cases of nan do not count."""
    counted = np.asarray(values, dtype=float)

    def measure(rows: np.ndarray) -> float:
        finite = counted[rows]
        finite = finite[~np.isnan(finite)]
        return float(statistic(finite)) if finite.size else math.nan

    return measure


def median(values: Sequence[float] | np.ndarray, share: float = 0.5) -> Measure:
    """Return the median of `values` (n,), or another quantile, as a measure; cases of nan do not count."""
    return mean(values, partial(np.quantile, q=share, method="higher"))


def share_of(part: Sequence[float] | np.ndarray, whole: Sequence[float] | np.ndarray) -> Measure:
    """Return the sum of a part (n,) over that of the whole (n,) as a measure."""
    parts = np.asarray(part, dtype=float)
    wholes = np.asarray(whole, dtype=float)
    return lambda rows: float(parts[rows].sum() / wholes[rows].sum()) if wholes[rows].any() else math.nan


def logit_slope(odds: np.ndarray, outcomes: np.ndarray) -> Measure:
    """Slope of the logistic regression of the outcomes, or shares, on the log odds stated (Cox 1958); 1 is right."""
    design = np.column_stack([np.ones(odds.size), np.clip(odds, -12, 12)])

    def measure(rows: np.ndarray) -> float:
        return float(logistic(design[rows], outcomes[rows])[1])

    return measure


def logistic(design: np.ndarray, outcomes: np.ndarray, ridge: float = 1e-5) -> np.ndarray:
    """Return the coefficients (k,) of a logistic regression by Newton's method.

    design: (n, k), its first column ones. outcomes: (n,) in [0, 1]; a share counts as that much of a case that
    overturned beside the rest of one that did not. ridge: penalty on the coefficients after the first, per case; it
    keeps those finite that no case contradicts.
    """
    penalty = ridge * len(design) * np.r_[0.0, np.ones(design.shape[1] - 1)]
    coefficients = np.zeros(design.shape[1])
    for _ in range(100):
        shares = 1 / (1 + np.exp(-design @ coefficients))
        weights = np.maximum(shares * (1 - shares), 1e-12)
        curvature = (design * weights[:, None]).T @ design + np.diag(penalty)
        step = np.linalg.solve(curvature, design.T @ (outcomes - shares) - penalty * coefficients)
        coefficients = coefficients + step * (4.0 / max(4.0, np.abs(step).max()))
        if np.abs(step).max() < 1e-10:
            break
    return coefficients
