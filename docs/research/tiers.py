"""What the tiers rest on: fitted to the ensembles of mechanisms under real records, judged by leaving sites out.

Each member of a case counts as an outcome that a tier is judged by, so that even the true share of a case leaves a
score: what cannot be known of it.
"""

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from docs.research import scores
from docs.research.answers import AnswerScore, answer_scores, try_answers
from docs.research.tier_cases import TierCase, independent, tier_cases
from docs.research.tier_fit import fit_tier, known, ratios_of, shares_of, sites_of
from rocking.assessment.tiers import Tier, TierBand, TierCovariance, TierFit, TierTerm
from rocking.records import Accelerogram
from rocking.tables import Row, column, row, write_tables

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
    draws = scores.resampled(sites, replicates)
    counts = {"cases": len(cases), "sites": len(set(sites))}
    for tier in Tier:
        odds, _, rotations = left_out(tier, cases)
        measures = _measures(odds, rotations, ratios)
        yield (
            [
                TierScore(tier=tier, measure=name, **scores.scored(measure, len(cases), draws), **counts)
                for name, measure in measures.items()
            ],
            [
                TierReliability(
                    tier=tier,
                    probability_from=each.probability_from,
                    probability_to=each.probability_to,
                    said=each.stated,
                    found=each.observed,
                    found_low=each.low,
                    found_high=each.high,
                    cases=each.rows.size,
                    sites=len(set(sites[each.rows])),
                )
                for each in scores.reliability(1 / (1 + np.exp(-odds)), fallen, BINS, draws)
            ],
        )


def _measures(odds: np.ndarray, rotations: np.ndarray, ratios: np.ndarray) -> dict[str, scores.Measure]:
    """What a tier is judged by: log odds (n,) and bands (n, 3) that it says, rotation ratios (n, m) of the members."""
    shares, fallen = 1 / (1 + np.exp(-odds)), shares_of(ratios)
    inside = ((ratios >= rotations[:, :1]) & (ratios <= rotations[:, 2:])).mean(axis=1)
    return {
        "Brier skill": lambda rows: scores.brier_skill(shares[rows], fallen[rows]),
        "Brier skill of who knew the shares": lambda rows: scores.brier_skill(fallen[rows], fallen[rows]),
        "calibration slope": lambda rows: scores.logit_slope(odds[rows], fallen[rows]),
        "share inside the 5-95 % band": lambda rows: float(inside[rows].mean()),
    }


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
    found, classes = (
        list(chain.from_iterable(each)) for each in zip(*tier_scores(cases, replicates), strict=True)
    )
    tables: Mapping[type[Row], Iterable[Row]] = {
        TierTerm: [row for fit in fits.values() for row in _terms(fit, cases, sha256)],
        TierCovariance: [row for fit in fits.values() for row in _covariances(fit)],
        TierBand: [row for fit in fits.values() for row in _bands(fit)],
        TierScore: found,
        TierReliability: classes,
        AnswerScore: answer_scores(list(try_answers(counted, cases)), replicates),
    }
    write_tables(tables, folder)
    return found


def _terms(fit: TierFit, cases: Sequence[TierCase], sha256: str) -> Iterator[TierTerm]:
    counts = {
        "records": len({case.record for case in cases}),
        "sites": len({case.site for case in cases}),
        "cases": len(cases),
    }
    of_intercept = {"centre": 0, "spread": 1, "least": 1, "largest": 1}
    numbers = {name: np.r_[first, getattr(fit, name)] for name, first in of_intercept.items()}
    numbers["coefficient"] = fit.coefficients
    for k, term in enumerate(("", *fit.tier.terms)):
        own: dict[str, Any] = {name: float(values[k]) for name, values in numbers.items()}
        yield TierTerm(tier=fit.tier, term=term, **own, **counts, records_sha256=sha256)


def _covariances(fit: TierFit) -> Iterator[TierCovariance]:
    names = ("", *fit.tier.terms)
    for i, name in enumerate(names):
        for k, other in enumerate(names[: i + 1]):
            yield TierCovariance(
                tier=fit.tier, term=name, other_term=other, covariance=float(fit.covariance[i, k])
            )


def _bands(fit: TierFit) -> Iterator[TierBand]:
    for edge, (low, median, high) in zip(fit.edges.tolist(), fit.bands.tolist(), strict=True):
        yield TierBand(tier=fit.tier, location_from=edge, low=low, median=median, high=high)
