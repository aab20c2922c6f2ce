"""Fragility: the probability that a structure overturns, or turns far, at a level of shaking."""

from rocking.assessment.fragility.analysis import IncrementalDynamicAnalysis, incremental_dynamic_analysis
from rocking.assessment.fragility.curve import Fragility, fragility_of
from rocking.assessment.fragility.front import fragility
from rocking.assessment.fragility.intensity import INTENSITY_MEASURES, IntensityMeasure
from rocking.assessment.fragility.lognormal import fit_lognormal
from rocking.assessment.fragility.multifidelity import MultiFidelityAnalysis, multi_fidelity_analysis
from rocking.assessment.fragility.purchase import Purchase, purchases

__all__ = [
    "INTENSITY_MEASURES",
    "Fragility",
    "IncrementalDynamicAnalysis",
    "IntensityMeasure",
    "MultiFidelityAnalysis",
    "Purchase",
    "fit_lognormal",
    "fragility",
    "fragility_of",
    "incremental_dynamic_analysis",
    "multi_fidelity_analysis",
    "purchases",
]
