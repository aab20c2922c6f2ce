"""What a cheap figure is worth: the probability that the mechanism overturns, and a band of its rotation, given it.

Each tier is a logistic regression on the intensity measures it knows, fitted by `snakemake calibrate` to the mechanism
under real records; its tables lie beside this file. The interval of a probability is that of the fit, by resampling
sites in the large (a sandwich of their scores). It says nothing of what is not known of a case: that is the ensemble's.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from pathlib import Path

import numpy as np

from rocking.assessment.verdict import NEGLIGIBLE
from rocking.tables import Row, column, read_rows, row

STRUCTURE = ("restitution", "restoring_defect", "forcing_defect")
"""Known of every structure before any motion."""
NORMAL_95 = 1.6449
"""95 % quantile of the normal distribution."""
SURE = 0.01
"""Probabilities below, and above its complement, are printed as such."""


class Tier(StrEnum):
    """What is known of a case."""

    CLOSED_FORM = "closed form"
    SINE = "most dangerous sine"
    PEAK_VELOCITY = "peak velocity"
    CLOSED_FORM_AND_PEAKS = "closed form and peaks"
    SEVEN_FIGURES = "seven figures"
    BLOCK = "block on record"
    BLOCK_AT_FIVE_SCALES = "block at five scales"

    @property
    def terms(self) -> tuple[str, ...]:
        """The measures it takes, of rocking.assessment.intensity."""
        return (*_KNOWN[self], *STRUCTURE)

    @property
    def follows_the_block(self) -> bool:
        """Whether its band is around the rotation of the block."""
        return "block" in _KNOWN[self]


_KNOWN: Mapping[Tier, tuple[str, ...]] = {
    Tier.CLOSED_FORM: ("pulse",),
    Tier.SINE: ("sine",),
    Tier.PEAK_VELOCITY: ("peak_velocity",),
    Tier.CLOSED_FORM_AND_PEAKS: ("pulse", "peak_velocity", "peak_acceleration", "frequency_ratio"),
    Tier.SEVEN_FIGURES: (
        "pulse",
        "peak_velocity",
        "peak_acceleration",
        "frequency_ratio",
        "sine",
        "velocity_change",
        "push",
    ),
    Tier.BLOCK: ("block", "block_overturns"),
    Tier.BLOCK_AT_FIVE_SCALES: (
        "block",
        "block_overturns",
        "block_high",
        "block_overturning_share",
        "block_never_overturns",
        "block_always_overturns",
    ),
}


@row("tiers", "One row per tier and term: the logistic regression of overturning, and what it rests on")
class TierTerm(Row):
    """One term of one tier; the intercept is the term without a name."""

    tier: Tier = column("What is known of a case")
    term: str = column("Intensity measure or property of the structure; empty for the intercept")
    centre: float = column("Subtracted from the term")
    spread: float = column("What it is then divided by")
    least: float = column("Its smallest value behind the fit")
    largest: float = column("Its largest value behind the fit")
    coefficient: float = column("Of the log odds of overturning")
    records: int = column("Components behind the fit")
    sites: int = column("Independent sites behind the fit")
    cases: int = column("Components times structures times factors that lift")
    records_sha256: str = column("SHA-256 of the hashes of the records' files, sorted")


@row("tier_covariances", "One row per tier and pair of terms: how well the coefficients are known")
class TierCovariance(Row):
    """One entry on or below the diagonal."""

    tier: Tier = column("What is known of a case")
    term: str = column("Term; empty for the intercept")
    other_term: str = column("The other term")
    covariance: float = column("Of their coefficients, with sites as what is independent")


@row("tier_bands", "One row per tier and class of location: the band of the mechanism's rotation")
class TierBand(Row):
    """The band from one location up to that of the next row."""

    tier: Tier = column("What is known of a case")
    location_from: float = column(
        "Log odds of overturning, or log of the block's rotation ratio where the tier has it"
    )
    low: float = column("5 % quantile of the rotation ratio, over the block's where the tier has it")
    median: float = column("Its median")
    high: float = column("Its 95 % quantile; INF: overturns")


@dataclass(frozen=True)
class Expectation:
    """What a tier says of a case.

    probability: that the mechanism overturns; probability_low, probability_high: its 90 % interval. rotation_low,
    rotation_median, rotation_high: 5, 50 and 95 % of φ_max/φ_cr; inf overturns.
    """

    tier: Tier
    probability: float
    probability_low: float
    probability_high: float
    rotation_low: float
    rotation_median: float
    rotation_high: float

    def __str__(self) -> str:
        return f"{self.in_words}, {self.band_in_words}"

    @property
    def in_words(self) -> str:
        """The probability as "overturns with 30 % (18–45)"."""
        return probability_in_words(self.probability, self.probability_low, self.probability_high)

    @property
    def band_in_words(self) -> str:
        """The band as "between 0.05 and 0.4 φ_cr"."""
        return band_in_words(self.rotation_low, self.rotation_high)


def probability_in_words(probability: float, low: float = math.nan, high: float = math.nan) -> str:
    """Say a probability of overturning with its interval: "overturns with 30 % (18–45)"; "" for nan."""
    if math.isnan(probability):
        return ""
    if probability < SURE:
        return f"overturns with less than {_percent(SURE)} %"
    if probability > 1 - SURE:
        return f"overturns with more than {_percent(1 - SURE)} %"
    interval = "" if math.isnan(low + high) else f" ({_percent(low)}–{_percent(high)})"
    return f"overturns with {_percent(probability)} %{interval}"


def band_in_words(low: float, high: float) -> str:
    """Say a band of the rotation ratio: "between 0.05 and 0.4 φ_cr"; "" for nan."""
    if math.isnan(low) or math.isnan(high):
        return ""
    if low == math.inf:
        return "overturns"
    if high <= NEGLIGIBLE:
        return "at rest"
    if high == math.inf:
        return (
            "anything from rest to overturning"
            if low <= NEGLIGIBLE
            else f"at least {low:.1g} φ_cr, or overturns"
        )
    return f"at most {high:.1g} φ_cr" if low <= NEGLIGIBLE else f"between {_two(low, high)} φ_cr"


@dataclass(frozen=True, eq=False)
class TierFit:
    """One fitted tier. centre, spread, least, largest: (k,) of the terms. coefficients: (k + 1,) and their covariance
    (k + 1, k + 1), intercept first.

    edges: (m,) ascending locations at which the classes of the band begin; bands: (m, 3) low, median and high.
    """

    tier: Tier
    centre: np.ndarray
    spread: np.ndarray
    least: np.ndarray
    largest: np.ndarray
    coefficients: np.ndarray
    covariance: np.ndarray
    edges: np.ndarray
    bands: np.ndarray

    def knows(self, measures: Mapping[str, float]) -> bool:
        """Whether structures like this one are behind the fit."""
        values = np.array([measures[term] for term in STRUCTURE])
        slack = 0.05 * (self.largest[-len(values) :] - self.least[-len(values) :])
        inside = (values >= self.least[-len(values) :] - slack) & (
            values <= self.largest[-len(values) :] + slack
        )
        return bool(inside.all())

    def design(self, known: np.ndarray) -> np.ndarray:
        """(n, k + 1) of the terms (n, k): an intercept, and what is centred and scaled."""
        return np.column_stack([np.ones(len(known)), (known - self.centre) / self.spread])

    def log_odds(self, known: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Log odds of overturning (n,) of terms (n, k), and their standard error."""
        design = self.design(known)
        variance = np.einsum("ij,jk,ik->i", design, self.covariance, design)
        return design @ self.coefficients, np.sqrt(np.maximum(variance, 0.0))

    def probabilities(self, known: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of overturning (n,), and the ends of its 90 % interval."""
        odds, error = self.log_odds(known)
        middle, low, high = (1 / (1 + np.exp(-(odds + k * NORMAL_95 * error))) for k in (0, -1, 1))
        return middle, low, high

    def settled(self, known: np.ndarray, risk: float) -> tuple[np.ndarray, np.ndarray]:
        """Whether the case of each terms (n, k) stands, and whether it overturns, at the worse end of the interval."""
        odds, error = self.log_odds(known)
        limit = math.log(risk / (1 - risk))
        return odds + NORMAL_95 * error <= limit, odds - NORMAL_95 * error >= -limit

    def rotations(self, known: np.ndarray) -> np.ndarray:
        """(n, 3) low, median and high of the rotation ratio."""
        place = np.searchsorted(self.edges, self.location(known), side="right") - 1
        return self.bands[np.maximum(place, 0)] * self.anchor(known)[:, None]

    def location(self, known: np.ndarray) -> np.ndarray:
        """What the band is looked up by."""
        return np.log(self.anchor(known)) if self.tier.follows_the_block else self.log_odds(known)[0]

    def anchor(self, known: np.ndarray) -> np.ndarray:
        """What the band is a multiple of: the rotation ratio of the block (1 where it overturns), or 1."""
        if not self.tier.follows_the_block:
            return np.ones(len(known))
        terms = self.tier.terms
        overturns = known[:, terms.index("block_overturns")] > 0
        return np.where(overturns, OVERTURNED, np.exp(known[:, terms.index("block")]))


OVERTURNED = 10.0
"""Stands for the rotation ratio of a block that overturns."""


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


def _percent(share: float) -> str:
    return f"{100 * share:.0f}"


def _two(low: float, high: float) -> str:
    digits = 1 if high > 1.5 * low else 2
    return f"{low:.{digits}g} and {high:.{digits}g}"
