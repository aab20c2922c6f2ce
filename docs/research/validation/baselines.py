"""What a prediction must beat: a threshold, logistic regressions, and one block under the pulse or the record."""

from dataclasses import dataclass

import numpy as np

from docs.research.tier_fit import logistic


@dataclass(frozen=True)
class Logistic:
    """P = 1/(1 + exp(−(a + b ln measure)))."""

    intercept: float
    slope: float

    def probability(self, measure: np.ndarray) -> np.ndarray:
        """P, (n,)."""
        return 1 / (1 + np.exp(-(self.intercept + self.slope * np.log(measure))))


def fit_threshold(measure: np.ndarray, outcomes: np.ndarray) -> float:
    """Return the measure beyond which "overturns" is right most often; the middle of its gap, the lowest of several."""
    order = np.argsort(measure, kind="stable")
    values, ends = measure[order], outcomes[order]
    right = np.concatenate([[0], np.cumsum(~ends)]) + np.concatenate([np.cumsum(ends[::-1])[::-1], [0]])
    best = int(np.argmax(right))
    below = values[best - 1] if best > 0 else 0.0
    above = values[best] if best < values.size else 2 * values[-1]
    return float(np.sqrt(below * above)) if below > 0 else float(above / 2)


def fit_logistic(measure: np.ndarray, outcomes: np.ndarray) -> Logistic:
    """Return the regression of largest likelihood; a ridge of 1e-4 keeps it finite where the outcomes separate."""
    logarithm = np.log(measure)
    centre, many = logarithm.mean(), measure.size
    design = np.column_stack([np.ones(many), logarithm - centre])
    (intercept, slope), _ = logistic(design, outcomes, np.arange(many), ridge=2e-4 / many)
    return Logistic(float(intercept - slope * centre), float(slope))


def single_best(overturns: np.ndarray, outcomes: np.ndarray) -> int:
    """Index of the candidate with most verdicts right; the median one of several. overturns: (n, m)."""
    wrong = (overturns != outcomes[:, None]).sum(axis=0)
    best = np.flatnonzero(wrong == wrong.min())
    return int(best[best.size // 2])
