"""What became of a structure: four outcomes, each with the sentence a reader is told."""

from enum import StrEnum


class Outcome(StrEnum):
    """Outcome of a prediction or an integration."""

    NO_UPLIFT = "no uplift"
    ROCKS = "rocks"
    OVERTURNS = "overturns"
    FAILED = "failed"

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
