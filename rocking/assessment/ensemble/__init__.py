"""The ensemble: what becomes of a structure when all that is not known varies within stated ranges.

Each cause is uniform in its range and independent of the others. What the causes are is an assumption, not a
measurement; the ensemble says how sure an answer can be if they are right.
"""

from rocking.assessment.ensemble.distribution import Ensemble, EnsembleSettings
from rocking.assessment.ensemble.ground_motions import GroundMotions, processed
from rocking.assessment.ensemble.members import CAUSES, drawn, ensemble, lattice

__all__ = [
    "CAUSES",
    "Ensemble",
    "EnsembleSettings",
    "GroundMotions",
    "drawn",
    "ensemble",
    "lattice",
    "processed",
]
