"""What became of a structure: four outcomes, each with the sentence a reader is told."""

import math
from enum import StrEnum


class Outcome(StrEnum):
    """Outcome of a prediction or an integration.

    >>> rocking.integrate(rocking.Block(2.0, 0.2), rocking.Pulse(3.0, 8.0)).outcome
    <Outcome.ROCKS: 'rocks'>
    """

    NO_UPLIFT = "no uplift"
    ROCKS = "rocks"
    OVERTURNS = "overturns"
    FAILED = "failed"

    @classmethod
    def at(cls, rotation_ratio: float) -> "Outcome":
        """The outcome of a largest rotation over the critical one: inf overturns, 0 does not lift."""
        if math.isinf(rotation_ratio):
            return cls.OVERTURNS
        return cls.ROCKS if rotation_ratio > 0 else cls.NO_UPLIFT

    @property
    def sentence(self) -> str:
        """One sentence for the reader."""
        return _SENTENCES[self]

    def of(self, rotation_ratio: float) -> str:
        """The outcome in a few words; one that rocks with its largest rotation over φ_cr."""
        return f"rocks to {rotation_ratio:.4g} φ_cr" if self is Outcome.ROCKS else str(self)


_SENTENCES = {
    Outcome.NO_UPLIFT: "The ground acceleration never reaches the uplift acceleration.",
    Outcome.ROCKS: "The structure rocks and returns to rest.",
    Outcome.OVERTURNS: "The structure overturns.",
    Outcome.FAILED: "No result could be computed; the reason stands beside it.",
}
