"""PulseSettings: the band that is searched and how many pulses are reported."""

from dataclasses import dataclass

from rocking.errors import PulseError
from rocking.quantities import check_settings, setting


@dataclass(frozen=True)
class PulseSettings:
    """What is searched in a record, and how much of it is reported.

    Frequencies in Hz are those of the band of 1/T. Raises PulseError when a value is outside what is allowed.
    """

    lowest_frequency: float = setting(0.15, "lowest frequency of the pulses sought", "Hz", gt=0)
    highest_frequency: float = setting(5.0, "highest frequency of the pulses sought", "Hz", gt=0)
    per_octave: int = setting(24, "frequencies scanned in one octave", ge=4, le=200)
    candidates: int = setting(10, "maxima of the scan that are refined", ge=1)
    alternatives: int = setting(5, "pulses reported, the dominant one among them", ge=1)
    pursuit: int = setting(3, "pulses of the pursuit sequence", ge=1)
    overlap: float = setting(0.5, "common over joint time from which two pulses count as one", gt=0)
    samples_per_cycle: float = setting(8.0, "fewest samples that can carry one cycle", gt=0)

    def __post_init__(self) -> None:
        check_settings(PulseError, self)
        if self.highest_frequency <= self.lowest_frequency:
            raise PulseError(
                f"highest_frequency is {self.highest_frequency:g} Hz, but must be above lowest_frequency "
                f"({self.lowest_frequency:g} Hz)."
            )
