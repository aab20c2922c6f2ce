"""PulseSettings: the band that is searched and how many pulses are reported."""

from dataclasses import dataclass

from rocking.errors import PulseError
from rocking.quantities import positive


@dataclass(frozen=True)
class PulseSettings:
    """What is searched in a record, and how much of it is reported.

    lowest_frequency, highest_frequency: Hz, the band of 1/T. per_octave: frequencies scanned in one octave.
    candidates: maxima of the scan that are refined. alternatives: pulses reported, the dominant one among them.
    pursuit: pulses of the pursuit sequence. overlap: two pulses whose common time divided by their joint time
    reaches this count as one. samples_per_cycle: the fewest samples that can carry one cycle.
    Raises PulseError when a value is outside what is allowed.
    """

    lowest_frequency: float = 0.15
    highest_frequency: float = 5.0
    per_octave: int = 24
    candidates: int = 10
    alternatives: int = 5
    pursuit: int = 3
    overlap: float = 0.5
    samples_per_cycle: float = 8.0

    def __post_init__(self) -> None:
        for name in ("lowest_frequency", "highest_frequency", "overlap", "samples_per_cycle"):
            object.__setattr__(self, name, positive(PulseError, name, getattr(self, name)))
        for name in ("per_octave", "candidates", "alternatives", "pursuit"):
            _counted(name, getattr(self, name))
        if self.highest_frequency <= self.lowest_frequency:
            raise PulseError(
                f"highest_frequency is {self.highest_frequency:g} Hz, but must be above lowest_frequency "
                f"({self.lowest_frequency:g} Hz)."
            )


def _counted(name: str, value: int) -> None:
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise PulseError(f"{name} is {value!r}, but must be a whole number of at least 1.")
