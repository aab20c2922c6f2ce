"""A tier fitted: a logistic regression of overturning with a covariance by site, and bands by location."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from docs.research.tier_cases import TierCase
from rocking.assessment.tiers import Tier, TierFit

RIDGE = 1e-5
"""Penalty on standardised coefficients per case: keeps those finite that no case contradicts."""
CLASSES = 30
"""Of location, between which the band steps."""


def known(cases: Sequence[TierCase], tier: Tier) -> np.ndarray:
    """(n, k) of the terms that `tier` takes."""
    return np.array([[case.measures[term] for term in tier.terms] for case in cases])


def fit_tier(tier: Tier, terms: np.ndarray, ratios: np.ndarray, sites: np.ndarray) -> TierFit:
    """Fit one tier to terms (n, k), rotation ratios (n, m) of the members of each case (inf: overturns) and sites (n,).

    The share of a case that overturns is what its probability is fitted to, one case weighing as much as another.
    """
    centre, spread = terms.mean(axis=0), terms.std(axis=0)
    spread = np.where(spread > 0, spread, 1.0)
    design = np.column_stack([np.ones(len(terms)), (terms - centre) / spread])
    coefficients, covariance = logistic(design, shares_of(ratios), sites)
    least, largest = terms.min(axis=0), terms.max(axis=0)
    fit = TierFit(
        tier, centre, spread, least, largest, coefficients, covariance, np.zeros(1), np.zeros((1, 3))
    )
    edges, bands = _bands(fit.location(terms), ratios / fit.anchor(terms)[:, None])
    return replace(fit, edges=edges, bands=bands)


def logistic(
    design: np.ndarray, outcomes: np.ndarray, groups: np.ndarray, ridge: float = RIDGE
) -> tuple[np.ndarray, np.ndarray]:
    """Return the coefficients (k,) of a logistic regression by Newton's method, and their covariance (k, k).

    design: (n, k), its first column ones. outcomes: (n,) in [0, 1]; a share counts as that much of a case that
    overturned beside the rest of one that did not. groups: (n,), what is independent: the covariance is the sandwich of
    their scores (Liang & Zeger 1986). ridge: penalty on the coefficients after the first, per case.
    """
    penalty = ridge * len(design) * np.r_[0.0, np.ones(design.shape[1] - 1)]
    found = np.zeros(design.shape[1])
    for _ in range(100):
        shares = 1 / (1 + np.exp(-design @ found))
        weights = np.maximum(shares * (1 - shares), 1e-12)
        curvature = (design * weights[:, None]).T @ design + np.diag(penalty)
        step = np.linalg.solve(curvature, design.T @ (outcomes - shares) - penalty * found)
        found = found + step * min(1.0, 4.0 / np.abs(step).max()) if np.abs(step).max() > 0 else found
        if np.abs(step).max() < 1e-10:
            break
    inverse = np.linalg.inv(curvature)
    scores = design * (outcomes - shares)[:, None]
    _, places = np.unique(groups, return_inverse=True)
    summed = np.zeros((places.max() + 1, design.shape[1]))
    np.add.at(summed, places, scores)
    many = len(summed)
    return found, inverse @ (summed.T @ summed * many / max(many - 1, 1)) @ inverse


def _bands(location: np.ndarray, ratios: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Classes of about equal numbers by location (n,), and in each the 5, 50 and 95 % quantile of all members (n, m).

    A quantile between two members is the outer one.
    """
    edges = np.unique(np.quantile(location, np.arange(CLASSES) / CLASSES, method="lower"))
    place = np.searchsorted(edges, location, side="right") - 1
    bands = []
    for k in range(edges.size):
        inside = ratios[place == k]
        bands.append(
            [
                np.quantile(inside, 0.05, method="lower"),
                np.quantile(inside, 0.5, method="nearest"),
                np.quantile(inside, 0.95, method="higher"),
            ]
        )
    return edges, np.array(bands)


def ratios_of(cases: Sequence[TierCase]) -> np.ndarray:
    """(n, m) of the members of each case."""
    return np.array([case.rotation_ratios for case in cases])


def shares_of(ratios: np.ndarray) -> np.ndarray:
    """(n,) of the members that overturn."""
    return np.isinf(ratios).mean(axis=1)


def sites_of(cases: Sequence[TierCase]) -> np.ndarray:
    return np.array([case.site for case in cases])
