"""PulseMethod: a way to say which pulse of a record predicts. The methods there are stand in rocking.pulses.methods."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rocking.errors import PulseError
from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.pulse import Pulse

Demand = Callable[[Pulse], float]
"""A prediction of the rotation ratio φ_max/φ_cr under one pulse; infinite where the structure overturns."""


@dataclass(frozen=True)
class PulseMethod:
    """Which pulses may stand for a record; of several, each structure meets the one of largest demand.

    name: its value of the setting pulse.choice. description: one clause for the reader.
    candidates: the pulses that may stand for a record, the best first; raises PulseError where there is none.
    """

    name: str
    description: str
    candidates: Callable[[PulseAnalysis], tuple[PulseEvidence, ...]]


def predicting_pulse(candidates: Sequence[PulseEvidence], demand: Demand) -> PulseEvidence:
    """Return the candidate of largest demand; of equal demands the first. Raises PulseError without a candidate."""
    if not candidates:
        raise PulseError(
            "There is no pulse to predict with, but at least one is needed; check the pulse method."
        )
    if len(candidates) == 1:
        return candidates[0]
    return max(candidates, key=lambda evidence: demand(evidence.pulse))
