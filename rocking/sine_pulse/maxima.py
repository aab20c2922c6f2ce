"""Many blocks under many sine pulses at a call: largest rotations, margins to overturning, amplitudes that overturn."""

from collections.abc import Sequence

import numpy as np

from rocking.errors import PulseError
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.sine_pulse import kernel
from rocking.sine_pulse.ratios import check_ratios
from rocking.structures.mechanism import EquivalentBlock


def predict_maxima(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of every block under every pulse, as `predict_maximum` does: exactly.

    inf where it overturns, 0 where it does not lift, nan where `predict_maximum` says it is unresolved.
    Raises PulseError for a pulse and a block that differ beyond measure.
    """
    peaks, _ = _followed(blocks, pulses)
    ratios = np.empty(peaks.shape[:2])
    for block, row, own in zip(blocks, ratios, peaks, strict=True):
        np.maximum(
            block.sides[0].rotation_ratios(own[:, 0]), block.sides[-1].rotation_ratios(own[:, 1]), out=row
        )
    return ratios


def overturning_margins(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> np.ndarray:
    """Return `Maximum.overturning_margin`, (m, n), of every block under every pulse: negative where it overturns."""
    return _followed(blocks, pulses)[1]


def overturning_amplitudes(
    blocks: Sequence[EquivalentBlock], circular_frequencies: Sequence[float] | np.ndarray, polarity: int = 1
) -> np.ndarray:
    """Return the smallest amplitude [m/s²], (m, n), of one full sine at which each block overturns.

    circular_frequencies: ω_g, rad/s, (n,). polarity: 1, or −1 for a sine that begins in the negative direction.
    inf where a thousand times the uplift acceleration does not overturn the block. Sought upwards from the uplift
    acceleration in steps of 2 %, then halved to 1e-9: a range of overturning narrower than that can be missed, and
    above it the block may stand again. Raises PulseError.
    """
    frequencies = np.asarray(circular_frequencies, dtype=float)
    if frequencies.ndim != 1 or not np.all((frequencies > 0) & np.isfinite(frequencies)):
        raise PulseError(
            "circular_frequencies must be a one-dimensional array of finite numbers greater than 0."
        )
    if polarity not in (1, -1):
        raise PulseError(f"polarity is {polarity!r}, but must be 1 or -1.")
    positive, negative = _rows(blocks)
    _check(positive, negative, frequencies, np.zeros(1))
    amplitudes = np.empty((len(blocks), frequencies.size))
    kernel.thresholds(positive, negative, -polarity, frequencies, amplitudes)
    return amplitudes


def _followed(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> tuple[np.ndarray, np.ndarray]:
    """The largest x of both sides, (m, n, 2), positive first, and the margins (m, n)."""
    positive, negative = _rows(blocks)
    frequencies = np.array([pulse.circular_frequency for pulse in pulses])
    amplitudes = np.array([pulse.amplitude for pulse in pulses])
    _check(positive, negative, frequencies, np.abs(amplitudes))
    shape = len(blocks), len(pulses)
    peaks, margins = np.empty((*shape, 2)), np.empty(shape)
    # A positive ground acceleration rocks the block to its negative side.
    signs = np.where(amplitudes < 0, 1, -1)
    kernel.courses(positive, negative, signs, frequencies, np.abs(amplitudes), peaks, margins)
    return peaks, margins


def _rows(blocks: Sequence[EquivalentBlock]) -> tuple[np.ndarray, np.ndarray]:
    """(m, 6) p, gλ, η, velocity scale, end and existence, of the positive and of the negative side of each block."""
    positive = np.array([_row(block.sides[0], True) for block in blocks]).reshape(-1, 6)
    negative = np.array([_row(block.sides[-1], not block.one_sided) for block in blocks]).reshape(-1, 6)
    return positive, negative


def _row(block: EquivalentBlock, exists: bool) -> tuple[float, ...]:
    uplift = GRAVITY * block.uplift_multiplier
    return (
        block.frequency_parameter,
        uplift,
        block.restitution,
        block.velocity_scale,
        block.end,
        float(exists),
    )


def _check(
    positive: np.ndarray, negative: np.ndarray, frequencies: np.ndarray, amplitudes: np.ndarray
) -> None:
    rows = np.concatenate([positive, negative])
    if not rows.size or not frequencies.size:
        return
    lowest, highest = frequencies.min() / rows[:, 0].max(), frequencies.max() / rows[:, 0].min()
    check_ratios((float(lowest), float(highest)), float(amplitudes.max() / rows[:, 1].min()))
