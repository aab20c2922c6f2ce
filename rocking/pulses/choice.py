"""The optional choice of a pulse by what it does to a structure, instead of by what it explains of the record."""

from collections.abc import Callable

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.pulse import Pulse

Demand = Callable[[Pulse], float]
"""A prediction of the rotation ratio φ_max/φ_cr under one pulse; infinite where the structure overturns."""
CHOSEN_AMONG = 5
"""Best-ranked pulses among which the largest demand is sought."""


def chosen_by_demand(analysis: PulseAnalysis, demand: Demand, among: int = CHOSEN_AMONG) -> PulseEvidence:
    """Return the pulse of largest predicted rotation among the first; of equal demands the better ranked."""
    return max(analysis.ranked[:among], key=lambda evidence: demand(evidence.pulse))
