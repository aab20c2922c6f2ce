"""What the tiers rest on: fitted to the ensembles of mechanisms under real records, judged by leaving sites out.

Each member of a case counts as an outcome that a tier is judged by, so that even the true share of a case leaves a
score: what cannot be known of it.
"""

import hashlib
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np

from rocking.assessment.tiers import Tier, TierBand, TierCovariance, TierFit, TierTerm
from rocking.calibration.answers import AnswerScore, answer_scores, try_answers
from rocking.calibration.tier_cases import TierCase, independent, tier_cases
from rocking.calibration.tier_fit import fit_tier, known, logistic, ratios_of, shares_of, sites_of
from rocking.records import Accelerogram
from rocking.tables import Row, column, row, write_rows

REPLICATES = 500
BINS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0)


@row(
    "tier_scores", "One row per tier and measure on sites left out, with a 90 % interval by resampling sites"
)
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
    found: float = column("Share of the members that overturn")
    found_low: float = column("5 % quantile of that over resampled sites")
    found_high: float = column("95 % quantile of that over resampled sites")
    cases: int = column("Cases in it")
    sites: int = column("Sites in it")


def left_out(tier: Tier, cases: Sequence[TierCase]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return what `tier` says of each case when fitted without its site.

    Log odds (n,), their error (n,) and the band of the rotation (n, 3)."""
    terms, ratios, sites = known(cases, tier), ratios_of(cases), sites_of(cases)
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
    ratios, sites = ratios_of(cases), sites_of(cases)
    fallen = shares_of(ratios)
    draws = _draws(sites, replicates)
    for tier in Tier:
        odds, _, rotations = left_out(tier, cases)
        shares = 1 / (1 + np.exp(-odds))
        inside = ((ratios >= rotations[:, :1]) & (ratios <= rotations[:, 2:])).mean(axis=1)
        measures: dict[str, Callable[[np.ndarray], float]] = {
            "Brier skill": lambda rows, p=shares: _skill(p[rows], fallen[rows]),  # type: ignore[misc]
            "Brier skill of who knew the shares": lambda rows: _skill(fallen[rows], fallen[rows]),
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
    """Return the slope of a logistic regression of the shares that overturned on the log odds said; 1 is right."""
    kept = np.clip(odds, -12, 12)
    coefficients, _ = logistic(np.column_stack([np.ones(kept.size), kept]), fallen, np.arange(kept.size))
    return float(coefficients[1])


def write_tiers(
    records: Iterable[tuple[str, Accelerogram]], folder: Path, replicates: int = REPLICATES
) -> list[TierScore]:
    """Fit and judge every tier on `records`; write its tables into `folder` and return the scores.

    tiers.csv, tier_covariances.csv and tier_bands.csv are what the package ships.
    """
    counted = list(independent(records))
    cases = list(tier_cases(counted))
    ratios, sites = ratios_of(cases), sites_of(cases)
    fits = {tier: fit_tier(tier, known(cases, tier), ratios, sites) for tier in Tier}
    hashes = sorted({record.source.sha256 for _, _, record in counted})
    sha256 = hashlib.sha256("\n".join(hashes).encode()).hexdigest()
    for row_class, rows in (
        (TierTerm, [r for fit in fits.values() for r in _terms(fit, cases, sha256)]),
        (TierCovariance, [r for fit in fits.values() for r in _covariances(fit)]),
        (TierBand, [r for fit in fits.values() for r in _band_rows(fit)]),
    ):
        write_rows(row_class, rows, folder / row_class.table.file_name)  # type: ignore[arg-type]
    scores, reliability = [], []
    for found, classes in tier_scores(cases, replicates):
        scores += found
        reliability += classes
    write_rows(TierScore, scores, folder / TierScore.table.file_name)
    answers = answer_scores(list(try_answers(counted, cases)), replicates)
    write_rows(AnswerScore, answers, folder / AnswerScore.table.file_name)
    write_rows(TierReliability, reliability, folder / TierReliability.table.file_name)
    return scores


def _terms(fit: TierFit, cases: Sequence[TierCase], sha256: str) -> Iterator[TierTerm]:
    names = ("", *fit.tier.terms)
    numbers = [
        np.r_[first, rest]
        for first, rest in ((0, fit.centre), (1, fit.spread), (1, fit.least), (1, fit.largest))
    ]
    for name, centre, spread, least, largest, coefficient in zip(
        names, *numbers, fit.coefficients, strict=True
    ):
        yield TierTerm(
            tier=fit.tier,
            term=name,
            centre=float(centre),
            spread=float(spread),
            least=float(least),
            largest=float(largest),
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
    """Brier skill over all members: what they differ from the share of their case by counts too."""
    base = fallen.mean()
    missed = np.mean((shares - fallen) ** 2 + fallen * (1 - fallen))
    return float(1 - missed / (base * (1 - base))) if 0 < base < 1 else math.nan


def _draws(sites: np.ndarray, replicates: int) -> list[np.ndarray]:
    """Rows of the cases of as many sites, drawn with repetition."""
    rng, names = np.random.default_rng(0), np.unique(sites)
    rows = [np.flatnonzero(sites == name) for name in names]
    return [
        np.concatenate([rows[place] for place in rng.integers(names.size, size=names.size)])
        for _ in range(replicates)
    ]
