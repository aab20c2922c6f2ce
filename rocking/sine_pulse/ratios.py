"""Ratios: what one side of an equivalent block and a pulse are to each other, without dimensions."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rocking.errors import PulseError
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.structures.mechanism import EquivalentBlock

LARGEST_RATIO = 1e12
"""Beyond this a frequency or amplitude ratio is a mistake of units, and its square leaves no digits for the block."""


def check_ratios(frequencies: Sequence[float], amplitude: float) -> None:
    """Raise PulseError when one of the frequency ratios ω, or the amplitude ratio a, lies outside LARGEST_RATIO."""
    for ratio in frequencies:
        if not 1 / LARGEST_RATIO <= ratio <= LARGEST_RATIO:
            raise PulseError(
                f"ω_g/p, the pulse's circular_frequency over the block's frequency_parameter, is {ratio!r}, "
                f"but must lie between {1 / LARGEST_RATIO:g} and {LARGEST_RATIO:g}."
            )
    if not amplitude <= LARGEST_RATIO:
        raise PulseError(
            f"a_g/(gλ), the pulse's amplitude over the block's uplift acceleration, is {amplitude!r}, "
            f"but must be at most {LARGEST_RATIO:g}."
        )


@dataclass(frozen=True, slots=True)
class Ratios:
    """One side of a block under one pulse.

    frequency_ratio: ω = ω_g/p. amplitude_ratio: a = |a_g|/(gλ). restitution: η of the impact that ends rocking here.
    velocity_scale: the block's, which turns dx/d(pt) into an angular velocity.
    Raises PulseError when a ratio lies outside LARGEST_RATIO.
    """

    frequency_ratio: float
    amplitude_ratio: float
    restitution: float
    velocity_scale: float = 1.0

    def __post_init__(self) -> None:
        check_ratios([self.frequency_ratio], self.amplitude_ratio)

    @property
    def uplift_slope(self) -> float:
        """s = √(a² − 1), the slope of a sin θ where it reaches 1."""
        a = self.amplitude_ratio
        return math.sqrt((a - 1) * (a + 1))

    @property
    def uplift_phase(self) -> float:
        """asin(1/a), rad, written so that it keeps its digits near a = 1."""
        return math.atan2(1.0, self.uplift_slope)


def ratios(block: EquivalentBlock, pulse: Pulse) -> Ratios:
    """Return the ratios of the positive side of `block`."""
    return Ratios(
        frequency_ratio=pulse.circular_frequency / block.frequency_parameter,
        amplitude_ratio=abs(pulse.amplitude) / (GRAVITY * block.uplift_multiplier),
        restitution=block.restitution,
        velocity_scale=block.velocity_scale,
    )


def first_and_second(block: EquivalentBlock, pulse: Pulse) -> tuple[Ratios | None, Ratios | None]:
    """Return the side the first half of the pulse rocks to, then the other; None where a one-sided block leans.

    Ground that accelerates in the positive direction rocks the block to its negative side.
    """
    positive = ratios(block, pulse)
    negative: Ratios | None = positive
    if block.other_side is not None:
        negative = ratios(block.other_side, pulse)
    elif block.one_sided:
        negative = None
    return (negative, positive) if pulse.amplitude > 0 else (positive, negative)
