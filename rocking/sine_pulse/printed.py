"""Eqs. 15 and 16 as the paper prints them, evaluated so that they keep their digits."""

import math

from rocking.errors import PulseError
from rocking.pulses.pulse import Pulse
from rocking.quantities import finite, positive
from rocking.sine_pulse.maximum import check_ratios, sides_under
from rocking.structures.mechanism import EquivalentBlock

_LARGEST_EXPONENT = 709.0
"""exp of more than this leaves the range of doubles."""


def printed_maximum(equivalent_block: EquivalentBlock, pulse: Pulse) -> float:
    """Return φ_max/φ_cr by Eq. 15 exactly as the paper prints it: 1 − √(1 − η² (1 − D₀)).

    For a block that measures the rotation otherwise, a positive value is read back as φ/φ_cr.
    nan where the radicand is negative, which the paper reads as overturning; 0.0 where the pulse lifts nothing
    (a ≤ 1), where Eq. 16 is not defined. It may be negative, and it is wrong outside the regime
    `Regime.PRINTED_EXACT`; `predict_maximum` is not. For a block with two different sides it takes
    the side that the pulse lifts first, as if the other were the same; for a one-sided block its only side, as if the
    pulse's first half lifted it.

    >>> from rocking import EquivalentBlock, Pulse, predict_maximum, printed_maximum
    >>> block = EquivalentBlock(2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9)
    >>> pulse = Pulse(amplitude=4.0, circular_frequency=12.0)
    >>> round(printed_maximum(block, pulse), 3), round(predict_maximum(block, pulse).rotation_ratio, 3)
    (0.329, 0.323)
    """
    first, second = sides_under(equivalent_block, pulse)
    side = first if first.exists else second
    if side.amplitude_ratio <= 1:
        return 0.0
    eta = side.restitution
    drop = 0.0 if eta == 0 else eta**2 * pulse_end_energy(side.frequency_ratio, side.amplitude_ratio)
    if drop > 1:
        return math.nan
    root = math.sqrt(1 - drop)
    maximum = drop / (1 + root) if drop > -1 else 1 - root
    own = equivalent_block.sides[-1 if first.exists and pulse.amplitude >= 0 else 0]
    return own.rotation_ratio(maximum) if maximum > 0 else maximum


def pulse_end_energy(frequency_ratio: float, amplitude_ratio: float) -> float:
    """Return 1 − D₀: the squared velocity x'² with which a block that rocks at the pulse's end will land.

    D₀ = (x − 1)² − x'² at the end of the pulse, for x = φ/φ_cr and time p t (Eq. 16).
    frequency_ratio: ω = ω_g/p > 0. amplitude_ratio: a = a_g/(gλ) > 1. ± inf where the value leaves the range of doubles
    (ω < 0.009). The relative error stays below 1e-11 for ω from 1e-3 to 1e6 and a from 1 + 1e-12 to 1e6, except beside
    the zeros of 1 − D₀ and of √(a² − 1) − ω, where terms cancel: it grows as 1e-15 times the largest term over the sum.
    Raises PulseError for an argument that is not finite or out of range.
    """
    omega = positive(PulseError, "frequency_ratio", frequency_ratio)
    a = finite(PulseError, "amplitude_ratio", amplitude_ratio)
    if not a > 1:
        raise PulseError(
            f"amplitude_ratio is {amplitude_ratio!r}, but must exceed 1 for the pulse to lift the block."
        )
    check_ratios(omega, a)
    # s = √(a² − 1), the slope of a sin θ where it reaches 1, and asin(1/a) written so that it keeps its digits
    s = math.sqrt((a - 1) * (a + 1))
    exponent = (2 * math.pi - math.atan2(1.0, s)) / omega
    if exponent < 1:
        # a − s cosh T + ω sinh T freed of its cancellations: a − s = 1/(a + s)
        bracket = 1 / (a + s) - 2 * s * math.sinh(exponent / 2) ** 2 + omega * math.sinh(exponent)
    else:
        bracket = a + _times_exponential((omega - s) / 2, exponent) - (omega + s) / 2 * math.exp(-exponent)
    return 1 / (omega**2 + 1) + 2 * a * (omega / (omega**2 + 1)) ** 2 * bracket


def _times_exponential(factor: float, exponent: float) -> float:
    if factor == 0:
        return 0.0
    if exponent + math.log(abs(factor)) > _LARGEST_EXPONENT:
        return math.copysign(math.inf, factor)
    half = math.exp(exponent / 2)
    return factor * half * half
