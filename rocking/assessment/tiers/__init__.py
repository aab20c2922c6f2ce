"""What a cheap figure is worth: the probability that the mechanism overturns, and a band of its rotation, given it.

Each tier is a logistic regression on the intensity measures it knows, fitted by `snakemake calibrate` to the ensembles
of mechanisms under real records; its tables lie in this folder. The interval of a probability is that of the fit, by
resampling sites in the large (a sandwich of their scores).
"""

from rocking.assessment.tiers.expectation import Expectation
from rocking.assessment.tiers.fit import TierFit
from rocking.assessment.tiers.rows import TierBand, TierCovariance, TierTerm
from rocking.assessment.tiers.shipped import expect, read_tiers, shipped_tiers, unlike
from rocking.assessment.tiers.tier import STRUCTURE, Tier

__all__ = [
    "STRUCTURE",
    "Expectation",
    "Tier",
    "TierBand",
    "TierCovariance",
    "TierFit",
    "TierTerm",
    "expect",
    "read_tiers",
    "shipped_tiers",
    "unlike",
]
