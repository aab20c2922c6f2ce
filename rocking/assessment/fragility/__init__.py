"""Fragility: the probability that a structure overturns, or turns far, at a level of shaking."""

from rocking.assessment.fragility.analysis import (
    IncrementalDynamicAnalysis,
    fragility,
    incremental_dynamic_analysis,
)
from rocking.assessment.fragility.curve import Fragility, fit_lognormal, fragility_of

__all__ = [
    "Fragility",
    "IncrementalDynamicAnalysis",
    "fit_lognormal",
    "fragility",
    "fragility_of",
    "incremental_dynamic_analysis",
]
