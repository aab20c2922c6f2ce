"""The sine, of the best-ranked of the record, that turns the structure farthest."""

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.method import PulseMethod

CANDIDATES = 5
"""Best-ranked sines among which the largest demand is sought."""


def _candidates(analysis: PulseAnalysis) -> tuple[PulseEvidence, ...]:
    return analysis.ranked[:CANDIDATES]


METHOD = PulseMethod(
    "demand", f"of the {CANDIDATES} best-ranked sines the one that turns the structure farthest", _candidates
)
