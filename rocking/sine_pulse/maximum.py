"""The exact largest rotation of an equivalent block under one full sine pulse, in every regime: of one or of many.

The block is followed flight by flight: closed form between impacts, one scalar root per impact. After the pulse the
energy (x − 1)² − x'² is conserved in each flight, so what is left is algebra. Nothing is assumed monotone, and a
rotation beyond φ_cr during the pulse is not overturning: the pulse may bring the block back.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rocking.errors import PulseError, StructureError
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY, within
from rocking.sine_pulse import kernel
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock

LARGEST_RATIO = 1e12
"""Beyond this a frequency or amplitude ratio is a mistake of units, and its square leaves no digits for the block."""
_EQUAL = 1 + 1e-12
"""Of rotations that are equal to within this the first counts."""


class Regime(StrEnum):
    """How the block reaches its largest rotation.

    >>> from rocking import Regime
    >>> Regime.BEFORE_FIRST_IMPACT.sentence
    'The largest rotation comes before the first impact, so Eq. 15 does not hold.'
    """

    NO_UPLIFT = "no uplift"
    PRINTED_EXACT = "Eq. 15 exact"
    AFTER_FIRST_IMPACT = "maximum after the first impact"
    CONTACT_DURING_PULSE = "contact during the pulse"
    BEFORE_FIRST_IMPACT = "maximum before the first impact"
    OVERTURNS_WITHOUT_IMPACT = "overturns without impact"
    OVERTURNS_AFTER_IMPACTS = "overturns after impacts"
    UNRESOLVED = "unresolved"

    @property
    def sentence(self) -> str:
        """One sentence for the reader."""
        return _SENTENCES[self]


_SENTENCES = {
    Regime.NO_UPLIFT: "The pulse never reaches the uplift acceleration, so the structure does not rock.",
    Regime.PRINTED_EXACT: "The structure stays off the ground until the pulse ends and is largest after its first "
    "impact, which is the one course of events for which Eq. 15 is exact.",
    Regime.AFTER_FIRST_IMPACT: "The structure stays off the ground until the pulse ends and is largest after an "
    "impact; Eq. 15 does not hold, because the two sides differ or the pulse's first half lifts nothing.",
    Regime.CONTACT_DURING_PULSE: "The structure touches the ground before the pulse ends, so Eq. 15 does not hold.",
    Regime.BEFORE_FIRST_IMPACT: "The largest rotation comes before the first impact, so Eq. 15 does not hold.",
    Regime.OVERTURNS_WITHOUT_IMPACT: "The structure overturns on the side it first rocks to, without any impact.",
    Regime.OVERTURNS_AFTER_IMPACTS: "The structure overturns after one or more impacts.",
    Regime.UNRESOLVED: f"More than {kernel.MOST_IMPACTS} impacts follow each other during the pulse without dying out, "
    "because the restitution is so close to 1; a restitution of at most 0.999 can be followed.",
}


@dataclass(frozen=True, repr=False)
class Maximum:
    """Largest rotation of an equivalent block under a pulse.

    rotation_ratio: largest φ/φ_cr over both sides, each with its own φ_cr; inf if it overturns, 0 without uplift, nan
    if unresolved. outcome: an Outcome, FAILED only where the regime is unresolved.
    impacts: how many impacts come before the largest rotation, or before it overturns; those of a chain that dies out
    are counted only until it is proved to die out. peak_side: +1 or −1, the side of the largest rotation or of the
    overturning; 0 without uplift. Of rotations that are equal to within 1e-12 the first counts.
    overturning_margin: smallest 1 − x − x' (x = φ/φ_cr, time p t) at the start of a flight after the pulse; 1 when it
    rests by then, negative when it overturns, −inf when it does so beyond recall during the pulse. 0 is the border.

    >>> from rocking import EquivalentBlock, Pulse, predict_maximum
    >>> block = EquivalentBlock(2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9)
    >>> predict_maximum(block, Pulse(amplitude=4.0, circular_frequency=12.0)).impacts
    1
    """

    rotation_ratio: float
    outcome: Outcome
    regime: Regime
    impacts: int = 0
    peak_side: int = 0
    overturning_margin: float = 1.0

    def __repr__(self) -> str:
        return f"Maximum({self.outcome.of(self.rotation_ratio)}, regime: {self.regime})"


def predict_maximum(equivalent_block: EquivalentBlock, pulse: Pulse) -> Maximum:
    """Return the exact largest rotation of `equivalent_block` under `pulse`, with the regime that it belongs to.

    Exact to rounding in every regime, times the sensitivity of the motion itself, which grows without bound at the
    borders of overturning and where a contact just grazes. A chain of ever smaller impacts during the pulse is at
    rest once it is proved to die out before the ground can lift the block again, or once its energy is below 1e-24 of
    what overturns. `rocking.predict_maxima` does the same for many. Raises PulseError.

    >>> from rocking import Block, Pulse, predict_maximum
    >>> block = Block(semi_diagonal=2.0, slenderness=0.2).mechanism().equivalent_block()
    >>> predict_maximum(block, Pulse(amplitude=3.0, circular_frequency=9.0)).regime
    <Regime.CONTACT_DURING_PULSE: 'contact during the pulse'>
    """
    first, second = sides_under(equivalent_block, pulse)
    blocks = equivalent_block.sides[0], equivalent_block.sides[-1]
    if pulse.amplitude > 0:
        blocks = blocks[1], blocks[0]
    one_shape = equivalent_block.other_side is None and first.exists
    return _maximum(kernel.course(first, second), blocks, 1 if pulse.amplitude < 0 else -1, one_shape)


def sides_under(block: EquivalentBlock, pulse: Pulse) -> tuple[kernel.Side, kernel.Side]:
    """Return the side that the first half of the pulse rocks the block to, then the other.

    Ground that accelerates in the positive direction rocks the block to its negative side.
    """
    if not isinstance(block, EquivalentBlock):
        raise StructureError(
            f"equivalent_block is a {type(block).__name__}, but must be an EquivalentBlock; a structure's is "
            "structure.mechanism().equivalent_block()."
        )
    if not isinstance(pulse, Pulse):
        raise PulseError(
            f"pulse is a {type(pulse).__name__}, but must be a Pulse; that of a record is "
            "extract_pulses(record).dominant."
        )
    positive, negative = (
        kernel.Side(
            pulse.circular_frequency / side.frequency_parameter,
            abs(pulse.amplitude) / (GRAVITY * side.uplift_multiplier),
            side.restitution,
            side.velocity_scale,
            side.end,
            exists,
        )
        for side, exists in ((block.sides[0], True), (block.sides[-1], not block.one_sided))
    )
    for side in (positive, negative):
        check_ratios(side.frequency_ratio, side.amplitude_ratio)
    return (negative, positive) if pulse.amplitude > 0 else (positive, negative)


def check_ratios(frequency_ratio: float, amplitude_ratio: float) -> None:
    """Raise PulseError when the frequency ratio ω, or the amplitude ratio a, lies outside LARGEST_RATIO."""
    if not 1 / LARGEST_RATIO <= frequency_ratio <= LARGEST_RATIO:
        raise PulseError(
            f"ω_g/p, the pulse's circular_frequency over the block's frequency_parameter, is {frequency_ratio!r}, "
            f"but must lie between {1 / LARGEST_RATIO:g} and {LARGEST_RATIO:g}."
        )
    if not amplitude_ratio <= LARGEST_RATIO:
        raise PulseError(
            f"a_g/(gλ), the pulse's amplitude over the block's uplift acceleration, is {amplitude_ratio!r}, "
            f"but must be at most {LARGEST_RATIO:g}."
        )


def _maximum(
    course: kernel.Course, blocks: tuple[EquivalentBlock, EquivalentBlock], first_side: int, one_shape: bool
) -> Maximum:
    """blocks: of the side that the pulse's first half lifts, and of the other. first_side: the sign of the former.

    one_shape: whether the pulse's first half lifts the block and what it lands on next is the same again, as Eq. 15
    takes for granted.
    """
    if course.unresolved:
        return Maximum(math.nan, Outcome.FAILED, Regime.UNRESOLVED, course.impacts, 0, math.nan)
    then = course.peak_impacts
    if max(then) < 0:
        return Maximum(0.0, Outcome.NO_UPLIFT, Regime.NO_UPLIFT)
    early = 0 if then[1] < 0 or 0 <= then[0] <= then[1] else 1
    late = 1 - early
    sizes = course.peaks
    if blocks[0] is not blocks[1]:
        sizes = blocks[0].rotation_ratio(sizes[0]), blocks[1].rotation_ratio(sizes[1])
    index = late if then[late] >= 0 and sizes[late] > sizes[early] * _EQUAL else early
    ratio = sizes[index] if blocks[0] is not blocks[1] else blocks[0].rotation_ratio(sizes[index])
    overturns = ratio == math.inf
    return Maximum(
        rotation_ratio=ratio,
        outcome=Outcome.OVERTURNS if overturns else Outcome.ROCKS,
        regime=_regime(overturns, then[index], course.contacts, one_shape),
        impacts=then[index],
        peak_side=first_side if index == 0 else -first_side,
        overturning_margin=course.margin,
    )


def _regime(overturns: bool, impacts: int, contacts: int, one_shape: bool) -> Regime:
    if overturns:
        return Regime.OVERTURNS_AFTER_IMPACTS if impacts else Regime.OVERTURNS_WITHOUT_IMPACT
    if contacts:
        return Regime.CONTACT_DURING_PULSE
    if not impacts:
        return Regime.BEFORE_FIRST_IMPACT
    return Regime.PRINTED_EXACT if one_shape else Regime.AFTER_FIRST_IMPACT


def predict_maxima(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of every block under every pulse, as `predict_maximum` does: exactly.

    inf where it overturns, 0 where it does not lift, nan where `predict_maximum` says it is unresolved.
    Raises PulseError for a pulse and a block that differ beyond measure.

    >>> from rocking import EquivalentBlock, Pulse, predict_maxima
    >>> block = EquivalentBlock(2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9)
    >>> predict_maxima([block], [Pulse(1.0, 9.0), Pulse(9.0, 3.0)]).tolist()
    [[0.0, inf]]
    """
    peaks, _ = _followed(blocks, pulses)
    ratios = np.empty(peaks.shape[:2])
    for block, row, own in zip(blocks, ratios, peaks, strict=True):
        np.maximum(
            block.sides[0].rotation_ratios(own[:, 0]), block.sides[-1].rotation_ratios(own[:, 1]), out=row
        )
    return ratios


def overturning_margins(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> np.ndarray:
    """Return `Maximum.overturning_margin`, (m, n), of every block under every pulse: negative where it overturns.

    >>> from rocking import EquivalentBlock, Pulse, overturning_margins
    >>> block = EquivalentBlock(2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9)
    >>> (overturning_margins([block], [Pulse(3.0, 9.0), Pulse(9.0, 3.0)]) < 0).tolist()
    [[False, True]]
    """
    return _followed(blocks, pulses)[1]


def overturning_amplitudes(
    blocks: Sequence[EquivalentBlock], circular_frequencies: Sequence[float] | np.ndarray, polarity: int = 1
) -> np.ndarray:
    """Return the smallest amplitude [m/s²], (m, n), of one full sine at which each block overturns.

    circular_frequencies: ω_g, rad/s, (n,). polarity: 1, or −1 for a sine that begins in the negative direction.
    inf where a thousand times the uplift acceleration does not overturn the block. Sought upwards from the uplift
    acceleration in steps of 2 %, then halved to 1e-9: a range of overturning narrower than that can be missed, and
    above it the block may stand again. Raises PulseError.

    >>> from rocking import EquivalentBlock, overturning_amplitudes
    >>> block = EquivalentBlock(2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9)
    >>> overturning_amplitudes([block], [5.0, 10.0]).round(3).tolist()
    [[2.548, 5.92]]
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
    rows = [
        (
            side.frequency_parameter,
            GRAVITY * side.uplift_multiplier,
            side.restitution,
            side.velocity_scale,
            side.end,
            float(exists),
        )
        for block in blocks
        for side, exists in ((block.sides[0], True), (block.sides[-1], not block.one_sided))
    ]
    both = np.array(rows).reshape(-1, 2, 6)
    return both[:, 0].copy(), both[:, 1].copy()


def _check(
    positive: np.ndarray, negative: np.ndarray, frequencies: np.ndarray, amplitudes: np.ndarray
) -> None:
    rows = np.concatenate([positive, negative])
    if rows.size and frequencies.size:
        largest = float(amplitudes.max() / rows[:, 1].min())
        check_ratios(float(frequencies.min() / rows[:, 0].max()), largest)
        check_ratios(float(frequencies.max() / rows[:, 0].min()), largest)


def pulse_spectrum(
    frequency_ratios: np.ndarray, amplitude_ratios: np.ndarray, restitution: float
) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of every symmetric equivalent block under one full sine pulse, exactly.

    frequency_ratios: ω = ω_g/p in [1e-12, 1e12], (m,). amplitude_ratios: a = |a_g|/(gλ) in [0, 1e12], (n,).
    restitution: η in [0, 1].
    inf where the block overturns, 0 where it does not lift, nan where `predict_maximum` says it is unresolved.
    Raises PulseError or StructureError.
    """
    frequencies = _axis("frequency_ratios", frequency_ratios, 1 / LARGEST_RATIO)
    amplitudes = _axis("amplitude_ratios", amplitude_ratios, 0.0)
    eta = within(StructureError, "restitution", restitution, 0, 1)
    side = np.array([[1.0, 1.0, eta, 1.0, math.inf, 1.0]])  # p = gλ = 1
    omegas, strengths = (each.ravel() for each in np.meshgrid(frequencies, amplitudes, indexing="ij"))
    peaks, margins = np.empty((1, omegas.size, 2)), np.empty((1, omegas.size))
    kernel.courses(side, side, np.ones(omegas.size, dtype=int), omegas, strengths, peaks, margins)
    return peaks[0].max(axis=1).reshape(frequencies.size, amplitudes.size)


def _axis(field: str, values: np.ndarray, lowest: float) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or array.size == 0:
        raise PulseError(f"{field} has the shape {array.shape}, but must be a list of at least one number.")
    wrong = array[~((array >= lowest) & (array <= LARGEST_RATIO))]
    if wrong.size:
        raise PulseError(
            f"{field} holds {wrong[0]!s}, but every value must lie between {lowest:g} and {LARGEST_RATIO:g}."
        )
    return array
