"""The tiers that the package ships, read from the tables beside this file."""

from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path

import numpy as np

from rocking.assessment.tiers.expectation import Expectation
from rocking.assessment.tiers.fit import TierFit
from rocking.assessment.tiers.rows import TierBand, TierCovariance, TierTerm
from rocking.assessment.tiers.tier import Tier
from rocking.tables import read_rows


def expect(
    tier: Tier, measures: Mapping[str, float], fits: Mapping[Tier, TierFit] | None = None
) -> Expectation | None:
    """Return what `tier` says of a case whose intensity measures are known; None of a structure unlike all behind it.

    fits: by tier; None: those that the package ships. Raises KeyError where a measure is missing.
    """
    fit = (fits or shipped_tiers())[tier]
    if not fit.knows(measures):
        return None
    known = np.array([[measures[term] for term in tier.terms]])
    shares = (float(each[0]) for each in fit.probabilities(known))
    return Expectation(tier, *shares, *fit.rotations(known)[0].tolist())


def unlike(tier: Tier, measures: Mapping[str, float], fits: Mapping[Tier, TierFit] | None = None) -> str:
    """Say why `tier` says nothing of a structure, as TierFit.unlike does; "" where it says something."""
    return (fits or shipped_tiers())[tier].unlike(measures)


@lru_cache(maxsize=1)
def shipped_tiers() -> dict[Tier, TierFit]:
    """Return the tiers that the package ships, made by `snakemake calibrate` from real records."""
    return read_tiers(Path(__file__).parent)


def read_tiers(folder: Path) -> dict[Tier, TierFit]:
    """Return the tiers whose tables lie in `folder`. Raises RockingError for another table."""
    terms = list(read_rows(TierTerm, folder / TierTerm.table.file_name))
    covariances = list(read_rows(TierCovariance, folder / TierCovariance.table.file_name))
    bands = list(read_rows(TierBand, folder / TierBand.table.file_name))
    return {
        tier: _fit(
            tier,
            [each for each in terms if each.tier is tier],
            [each for each in covariances if each.tier is tier],
            [each for each in bands if each.tier is tier],
        )
        for tier in dict.fromkeys(each.tier for each in terms)
    }


def _fit(
    tier: Tier, terms: list[TierTerm], covariances: Iterable[TierCovariance], bands: list[TierBand]
) -> TierFit:
    places = {row.term: k for k, row in enumerate(terms)}
    covariance = np.zeros((len(terms), len(terms)))
    for each in covariances:
        i, k = places[each.term], places[each.other_term]
        covariance[i, k] = covariance[k, i] = each.covariance
    return TierFit(
        tier,
        np.array([row.centre for row in terms[1:]]),
        np.array([row.spread for row in terms[1:]]),
        np.array([row.least for row in terms[1:]]),
        np.array([row.largest for row in terms[1:]]),
        np.array([row.coefficient for row in terms]),
        covariance,
        np.array([row.location_from for row in bands]),
        np.array([[row.low, row.median, row.high] for row in bands]),
    )
