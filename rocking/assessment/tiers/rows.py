"""The rows of the tables that hold the fitted tiers."""

from rocking.assessment.tiers.tier import Tier
from rocking.tables import Row, column, row


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
