"""What the tiers rest on: fitted to the mechanism under real records, judged by leaving sites out."""

import hashlib
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from rocking.assessment.tiers import Tier, TierBand, TierCovariance, TierFit, TierTerm
from rocking.calibration.tier_cases import TierCase, tier_cases
from rocking.records import Accelerogram
from rocking.tables import Row, column, row, write_rows

RIDGE = 1e-5
"""Penalty on standardised coefficients per case: keeps those finite that no case contradicts."""
CLASSES = 30
"""Of location, between which the band steps."""
REPLICATES = 500
BINS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0)


@row("tier_scores", "One row per tier and measure on sites left out, with a 90 % interval by resampling sites")
class TierScore(Row):
    """One measure of one tier."""

    tier: Tier = column("What is known of a case")
    measure: str = column("What was measured")
    value: float = column("Its value")
    value_low: float = column("5 % quantile over resampled sites")
    value_high: float = column("95 % quantile over resampled sites")
    cases: int = column("Cases behind it")
    sites: int = column("Sites behind it")


@row("tier_reliability", "One row per tier and class of probability: said and found, on sites left out")
class TierReliability(Row):
    """One class of one tier."""

    tier: Tier = column("What is known of a case")
    probability_from: float = column("Lower edge of the class")
    probability_to: float = column("Upper edge of the class")
    said: float = column("Mean probability in it")
    found: float = column("Share that overturns")
    found_low: float = column("5 % quantile of that over resampled sites")
    found_high: float = column("95 % quantile of that over resampled sites")
    cases: int = column("Cases in it")
    sites: int = column("Sites in it")


def known(cases: Sequence[TierCase], tier: Tier) -> np.ndarray:
    """(n, k) of the terms that `tier` takes."""
    return np.array([[case.measures[term] for term in tier.terms] for case in cases])


def fit_tier(tier: Tier, terms: np.ndarray, ratios: np.ndarray, sites: np.ndarray) -> TierFit:
    """Fit one tier to terms (n, k), rotation ratios (n,) of the mechanism (inf: overturns) and sites (n,)."""
    centre, spread = terms.mean(axis=0), terms.std(axis=0)
    spread = np.where(spread > 0, spread, 1.0)
    design = np.column_stack([np.ones(len(terms)), (terms - centre) / spread])
    coefficients, covariance = logistic(design, np.isinf(ratios), sites)
    bare = TierFit(tier, centre, spread, coefficients, covariance, np.zeros(1), np.zeros((1, 3)))
    edges, bands = _bands(bare.location(terms), ratios / bare.anchor(terms))
    return TierFit(tier, centre, spread, coefficients, covariance, edges, bands)


def logistic(design: np.ndarray, outcomes: np.ndarray, groups: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the coefficients (k,) of a logistic regression by Newton's method, and their covariance (k, k).

    design: (n, k), its first column ones. groups: (n,), what is independent: the covariance is the sandwich of their
    scores (Liang & Zeger 1986).
    """
    penalty = RIDGE * len(design) * np.r_[0.0, np.ones(design.shape[1] - 1)]
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
    """Classes of about equal numbers by location, and in each the 5, 50 and 95 % quantile, widened to a case."""
    edges = np.unique(np.quantile(location, np.arange(CLASSES) / CLASSES, method="lower"))
    place = np.searchsorted(edges, location, side="right") - 1
    bands = []
    for k in range(edges.size):
        inside = ratios[place == k]
        bands.append(
            [
                np.quantile(inside, share, method=method)
                for share, method in ((0.05, "lower"), (0.5, "nearest"), (0.95, "higher"))
            ]
        )
    return edges, np.array(bands)


def left_out(tier: Tier, cases: Sequence[TierCase]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what `tier` says of each case when fitted without its site: probability and error (n,), rotations (n, 3)."""
    terms, ratios, sites = known(cases, tier), _ratios(cases), _sites(cases)
    odds, errors, rotations = np.empty(len(cases)), np.empty(len(cases)), np.empty((len(cases), 3))
    for site in np.unique(sites):
        out = sites == site
        fit = fit_tier(tier, terms[~out], ratios[~out], sites[~out])
        odds[out], errors[out] = fit.log_odds(terms[out])
        rotations[out] = fit.rotations(terms[out])
    return odds, errors, rotations


def tier_scores(
    cases: Sequence[TierCase], replicates: int = REPLICATES
) -> Iterator[tuple[list[TierScore], list[TierReliability]]]:
    """Yield the scores and the reliability of each tier on sites left out."""
    ratios, sites = _ratios(cases), _sites(cases)
    fallen = np.isinf(ratios).astype(float)
    draws = _draws(sites, replicates)
    for tier in Tier:
        odds, errors, rotations = left_out(tier, cases)
        shares = 1 / (1 + np.exp(-odds))
        inside = ((ratios >= rotations[:, 0]) & (ratios <= rotations[:, 2])).astype(float)
        measures: dict[str, Callable[[np.ndarray], float]] = {
            "Brier skill": lambda rows, p=shares: _skill(p[rows], fallen[rows]),  # type: ignore[misc]
            "calibration slope": lambda rows, z=odds: calibration_slope(z[rows], fallen[rows]),  # type: ignore[misc]
            "share inside the 5-95 % band": lambda rows, i=inside: float(i[rows].mean()),  # type: ignore[misc]
        }
        scores = [
            TierScore(
                tier=tier,
                measure=name,
                value=measure(np.arange(len(cases))),
                value_low=float(np.quantile(values, 0.05)),
                value_high=float(np.quantile(values, 0.95)),
                cases=len(cases),
                sites=len(set(sites)),
            )
            for name, measure in measures.items()
            for values in [[measure(rows) for rows in draws]]
        ]
        yield scores, list(_reliability(tier, shares, fallen, sites, draws))


def calibration_slope(odds: np.ndarray, fallen: np.ndarray) -> float:
    """Return the slope of a logistic regression of what happened on the log odds that were said; 1 is right."""
    kept = np.clip(odds, -12, 12)
    coefficients, _ = logistic(np.column_stack([np.ones(kept.size), kept]), fallen, np.arange(kept.size))
    return float(coefficients[1])


def write_tiers(records: Iterable[tuple[str, Accelerogram]], folder: Path) -> list[TierScore]:
    """Fit and judge every tier on `records`; write its tables into `folder` and return the scores.

    tiers.csv, tier_covariances.csv and tier_bands.csv are what the package ships.
    """
    hashes: list[str] = []

    def noted() -> Iterator[tuple[str, Accelerogram]]:
        for name, record in records:
            hashes.append(record.source.sha256)
            yield name, record

    cases = list(tier_cases(noted()))
    ratios, sites = _ratios(cases), _sites(cases)
    fits = {tier: fit_tier(tier, known(cases, tier), ratios, sites) for tier in Tier}
    sha256 = hashlib.sha256("\n".join(sorted(set(hashes))).encode()).hexdigest()
    for row_class, rows in (
        (TierTerm, [r for fit in fits.values() for r in _terms(fit, cases, sha256)]),
        (TierCovariance, [r for fit in fits.values() for r in _covariances(fit)]),
        (TierBand, [r for fit in fits.values() for r in _band_rows(fit)]),
    ):
        write_rows(row_class, rows, folder / row_class.table.file_name)  # type: ignore[arg-type]
    scores, reliability = [], []
    for found, classes in tier_scores(cases):
        scores += found
        reliability += classes
    write_rows(TierScore, scores, folder / TierScore.table.file_name)
    write_rows(TierReliability, reliability, folder / TierReliability.table.file_name)
    return scores


def _terms(fit: TierFit, cases: Sequence[TierCase], sha256: str) -> Iterator[TierTerm]:
    names = ("", *fit.tier.terms)
    centres, spreads = np.r_[0.0, fit.centre], np.r_[1.0, fit.spread]
    for name, centre, spread, coefficient in zip(names, centres, spreads, fit.coefficients, strict=True):
        yield TierTerm(
            tier=fit.tier,
            term=name,
            centre=float(centre),
            spread=float(spread),
            coefficient=float(coefficient),
            records=len({case.record for case in cases}),
            sites=len({case.site for case in cases}),
            cases=len(cases),
            records_sha256=sha256,
        )


def _covariances(fit: TierFit) -> Iterator[TierCovariance]:
    names = ("", *fit.tier.terms)
    for i, name in enumerate(names):
        for k, other in enumerate(names[: i + 1]):
            yield TierCovariance(
                tier=fit.tier, term=name, other_term=other, covariance=float(fit.covariance[i, k])
            )


def _band_rows(fit: TierFit) -> Iterator[TierBand]:
    for edge, (low, median, high) in zip(fit.edges, fit.bands, strict=True):
        yield TierBand(
            tier=fit.tier, location_from=float(edge), low=float(low), median=float(median), high=float(high)
        )


def _reliability(
    tier: Tier, shares: np.ndarray, fallen: np.ndarray, sites: np.ndarray, draws: Sequence[np.ndarray]
) -> Iterator[TierReliability]:
    place = np.clip(np.searchsorted(BINS, shares, side="right") - 1, 0, len(BINS) - 2)
    for k in range(len(BINS) - 1):
        rows = place == k
        if not rows.any():
            continue
        resampled = [fallen[draw][rows[draw]].mean() for draw in draws if rows[draw].any()]
        yield TierReliability(
            tier=tier,
            probability_from=BINS[k],
            probability_to=BINS[k + 1],
            said=float(shares[rows].mean()),
            found=float(fallen[rows].mean()),
            found_low=float(np.quantile(resampled, 0.05)),
            found_high=float(np.quantile(resampled, 0.95)),
            cases=int(rows.sum()),
            sites=len(set(sites[rows])),
        )


def _skill(shares: np.ndarray, fallen: np.ndarray) -> float:
    base = fallen.mean()
    return float(1 - np.mean((shares - fallen) ** 2) / (base * (1 - base))) if 0 < base < 1 else math.nan


def _draws(sites: np.ndarray, replicates: int) -> list[np.ndarray]:
    """Rows of the cases of as many sites, drawn with repetition."""
    rng, names = np.random.default_rng(0), np.unique(sites)
    rows = [np.flatnonzero(sites == name) for name in names]
    return [
        np.concatenate([rows[place] for place in rng.integers(names.size, size=names.size)])
        for _ in range(replicates)
    ]


def _ratios(cases: Sequence[TierCase]) -> np.ndarray:
    return np.array([case.rotation_ratio for case in cases])


def _sites(cases: Sequence[TierCase]) -> np.ndarray:
    return np.array([case.site for case in cases])
