"""The tiers that the package ships, read from the tables beside this file."""

from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path

import numpy as np

from rocking.assessment.tiers.expectation import Expectation
from rocking.assessment.tiers.fit import TierFit
from rocking.assessment.tiers.rows import TierBand, TierCovariance, TierTerm
from rocking.assessment.tiers.tier import Tier
from rocking.tables import read_table


def expect(
    tier: Tier, measures: Mapping[str, float], fits: Mapping[Tier, TierFit] | None = None
) -> Expectation | None:
    """Return what `tier` says of a case whose intensity measures are known; None of a structure unlike all behind it.

    fits: by tier; None: those that the package ships. Raises KeyError where a measure is missing.
    """
    fit = (fits or shipped_tiers())[tier]
    if fit.unlike(measures):
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
    terms, bands = read_table(TierTerm, folder), read_table(TierBand, folder)
    covariances = read_table(TierCovariance, folder)
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
    properties = ("centre", "spread", "least", "largest")
    return TierFit(
        tier=tier,
        **{name: np.array([getattr(row, name) for row in terms[1:]]) for name in properties},
        coefficients=np.array([row.coefficient for row in terms]),
        covariance=covariance,
        edges=np.array([row.location_from for row in bands]),
        bands=np.array([[row.low, row.median, row.high] for row in bands]),
    )
