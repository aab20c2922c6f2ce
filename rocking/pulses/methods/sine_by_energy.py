"""The sine that explains most of the record's acceleration energy, the same for every structure."""

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.method import PulseMethod


def _candidates(analysis: PulseAnalysis) -> tuple[PulseEvidence, ...]:
    return (analysis.evidence,)


METHOD = PulseMethod("energy", "the sine that explains most of the record's acceleration energy", _candidates)
