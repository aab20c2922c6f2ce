"""The largest rotation of an equivalent block under a sine pulse: exact in every regime, and as printed.

The block is followed flight by flight: closed form between impacts, one scalar root per impact. After the pulse the
energy (x − 1)² − x'² is conserved in each flight, so what is left is algebra. Nothing is assumed monotone, and a
rotation beyond φ_cr during the pulse is not overturning: the pulse may bring the block back.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from rocking import sine_pulse
from rocking.errors import PulseError, StructureError
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY, finite, kind_of, positive, within
from rocking.structures import Outcome
from rocking.structures.mechanism import PRINTED_SCALE, EquivalentBlock, Mechanism

LARGEST_RATIO = 1e12
"""Beyond this a frequency or amplitude ratio is a mistake of units, and its square leaves no digits for the block."""
_EQUAL = 1 + 1e-12
"""The ratio of two rotations up to which they count as equal, and the first is taken."""


class Regime(StrEnum):
    """The way in which the block reaches its largest rotation.

    Examples
    --------
    >>> from rocking import Regime
    >>> Regime.BEFORE_FIRST_IMPACT.sentence
    'The largest rotation comes before the first impact, so Eq. 15 does not hold.'
    """

    NO_UPLIFT = "no uplift"
    PRINTED_EXACT = "regime of Eq. 15"
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
    Regime.NO_UPLIFT: "The pulse never reaches the uplift acceleration: the structure does not rock under this pulse.",
    Regime.PRINTED_EXACT: "The structure stays off the ground until the pulse ends and is largest after its first "
    "impact, which is the one course of events for which Eq. 15 is exact.",
    Regime.AFTER_FIRST_IMPACT: "The structure stays off the ground until the pulse ends and is largest after an "
    "impact; Eq. 15 does not hold, because the two sides differ, the pulse's first half lifts nothing, or it is no "
    "full sine.",
    Regime.CONTACT_DURING_PULSE: "The structure touches the ground before the pulse ends, so Eq. 15 does not hold.",
    Regime.BEFORE_FIRST_IMPACT: "The largest rotation comes before the first impact, so Eq. 15 does not hold.",
    Regime.OVERTURNS_WITHOUT_IMPACT: "The structure overturns on the side it first rocks to, without any impact.",
    Regime.OVERTURNS_AFTER_IMPACTS: "The structure overturns after one or more impacts.",
    Regime.UNRESOLVED: "More than 10000 impacts follow each other during the pulse without dying out, "
    "because the restitution is so close to 1; a somewhat smaller one can be followed.",
}


@dataclass(frozen=True, repr=False, kw_only=True)
class Maximum:
    """Largest rotation of an equivalent block under a pulse.

    Parameters
    ----------
    rotation_ratio : float
        Largest φ/φ_cr over both sides, each with its own φ_cr; inf if it overturns, 0 without uplift, nan if
        unresolved.
    outcome : Outcome
        What becomes of the block; FAILED only where the regime is unresolved.
    regime : Regime
        The way in which the block reaches its largest rotation.
    impacts : int, default 0
        How many impacts come before the largest rotation, or before it overturns; those of a chain that dies
        out are counted only until it is proved to die out.
    peak_side : int, default 0
        +1 or −1, the side of the largest rotation or of the overturning; 0 without uplift. Of rotations that
        are equal to within 1e-12 the first counts.
    overturning_margin : float, default 1.0
        Smallest 1 − x − x' (x = φ/φ_cr, time p t) at the start of a flight after the pulse; 1 when it rests
        by then, negative when it overturns, −inf when it does so beyond recall during the pulse. 0 is the
        border.

    Examples
    --------
    >>> from rocking import EquivalentBlock, Pulse, predict_maximum
    >>> block = EquivalentBlock(
    ...     frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9
    ... )
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


class _Peak(NamedTuple):
    """The largest rotation to one side over the critical one, and the number of impacts before it."""

    side: int
    ratio: float
    impacts: int


class _SideRow(NamedTuple):
    """One side of a block as the kernel reads it: p [rad/s], gλ [m/s²], η, velocity scale, end, and if it rocks so."""

    frequency_parameter: float
    uplift_acceleration: float
    restitution: float
    velocity_scale: float
    end: float
    exists: bool


class _Followed(NamedTuple):
    """Blocks (m) under pulses (n): the largest x of both sides, (m, n, 2), positive first, and the margins (m, n)."""

    peaks: np.ndarray
    margins: np.ndarray


def predict_maximum(equivalent_block: EquivalentBlock, pulse: Pulse) -> Maximum:
    """Return the exact largest rotation of `equivalent_block` under `pulse`, with the regime that it belongs to.

    Exact to rounding in every regime, times the sensitivity of the motion itself, which grows without bound
    at the borders of overturning and where a contact just grazes. A chain of ever smaller impacts during the
    pulse is at rest once it is proved to die out before the ground can lift the block again, or once its
    energy is below 1e-24 of what overturns. `rocking.predict_maxima` does the same for many.

    Parameters
    ----------
    equivalent_block : EquivalentBlock
        The block.
    pulse : Pulse
        The pulse.

    Returns
    -------
    Maximum
        Largest rotation, outcome and regime.

    Raises
    ------
    PulseError
        For a pulse and a block that differ beyond measure.

    Examples
    --------
    >>> from rocking import Block, Pulse, predict_maximum
    >>> block = Block(semi_diagonal=2.0, slenderness=0.2).mechanism().equivalent_block()
    >>> predict_maximum(block, Pulse(amplitude=3.0, circular_frequency=9.0)).regime
    <Regime.CONTACT_DURING_PULSE: 'contact during the pulse'>
    """
    sides = sides_under(equivalent_block, pulse)
    course = sine_pulse.kernel.course(*sides, *pulse.phases)
    if course.unresolved:
        return Maximum(
            rotation_ratio=math.nan,
            outcome=Outcome.FAILED,
            regime=Regime.UNRESOLVED,
            impacts=course.impacts,
            peak_side=0,
            overturning_margin=math.nan,
        )

    first_side = 1 if pulse.amplitude < 0 else -1
    peaks = []
    for side, x, impacts in zip((first_side, -first_side), course.peaks, course.peak_impacts, strict=True):
        never_lifts = impacts < 0
        if not never_lifts:
            own = equivalent_block.sides[0 if side > 0 else -1]
            peaks.append(_Peak(side, own.rotation_ratio(x), impacts))
    if not peaks:
        return Maximum(rotation_ratio=0.0, outcome=Outcome.NO_UPLIFT, regime=Regime.NO_UPLIFT)

    # Of the two sides the one whose peak came first counts, unless the other's is larger.
    earliest = min(peaks, key=lambda peak: peak.impacts)
    largest = max(peaks, key=lambda peak: peak.ratio)
    peak = largest if largest.ratio > earliest.ratio * _EQUAL else earliest

    # Eq. 15 takes for granted that the first half lifts the block and that what it lands on next is the same.
    is_as_printed = equivalent_block.other_side is None and sides[0].exists and pulse.is_full_sine
    return Maximum(
        rotation_ratio=peak.ratio,
        outcome=Outcome.OVERTURNS if peak.ratio == math.inf else Outcome.ROCKS,
        regime=_regime(peak, course.contacts, is_as_printed),
        impacts=peak.impacts,
        peak_side=peak.side,
        overturning_margin=course.margin,
    )


def _regime(peak: _Peak, touches_ground_in_pulse: bool, is_as_printed: bool) -> Regime:
    """The regime of a block that lifts. is_as_printed: whether block and pulse are what Eq. 15 is written for."""
    if peak.ratio == math.inf:  # it does not come back
        return Regime.OVERTURNS_AFTER_IMPACTS if peak.impacts else Regime.OVERTURNS_WITHOUT_IMPACT
    if touches_ground_in_pulse:
        return Regime.CONTACT_DURING_PULSE
    if not peak.impacts:
        return Regime.BEFORE_FIRST_IMPACT
    return Regime.PRINTED_EXACT if is_as_printed else Regime.AFTER_FIRST_IMPACT


def sides_under(block: EquivalentBlock, pulse: Pulse) -> list["sine_pulse.kernel.PulseSide"]:
    """Return the side that the first half of the pulse rocks the block to, then the other.

    Ground that accelerates in the positive direction rocks the block to its negative side.
    """
    if not isinstance(block, EquivalentBlock):
        raise StructureError(
            f"equivalent_block is {kind_of(block)}, but must be an EquivalentBlock; a structure's is "
            "structure.mechanism().equivalent_block().",
            equivalent_block=block,
        )
    if not isinstance(pulse, Pulse):
        raise PulseError(
            f"pulse is {kind_of(pulse)}, but must be a Pulse; that of a record is "
            "extract_pulses(record).dominant.",
            pulse=pulse,
        )
    sides = []
    for row in _rows_of(block):
        frequency_ratio = pulse.circular_frequency / row.frequency_parameter
        amplitude_ratio = abs(pulse.amplitude) / row.uplift_acceleration
        check_ratios(frequency_ratio=frequency_ratio, amplitude_ratio=amplitude_ratio)
        side = sine_pulse.kernel.PulseSide(
            frequency_ratio, amplitude_ratio, row.restitution, row.velocity_scale, row.end, row.exists
        )
        sides.append(side)
    return sides[::-1] if pulse.amplitude > 0 else sides


@lru_cache(maxsize=4096)
def _rows_of(block: EquivalentBlock) -> tuple[_SideRow, _SideRow]:
    """The positive and the negative side, which are the same one where they do not differ."""
    rows = [
        _SideRow(
            frequency_parameter=side.frequency_parameter,
            uplift_acceleration=GRAVITY * side.uplift_multiplier,
            restitution=side.restitution,
            velocity_scale=side.velocity_scale,
            end=side.end,
            exists=True,
        )
        for side in block.sides
    ]
    return rows[0], rows[-1]._replace(exists=not block.one_sided)


def check_ratios(*, frequency_ratio: float, amplitude_ratio: float) -> None:
    """Raise PulseError when the frequency ratio ω, or the amplitude ratio a, lies outside LARGEST_RATIO."""
    if not 1 / LARGEST_RATIO <= frequency_ratio <= LARGEST_RATIO:
        raise PulseError(
            f"ω_g/p, the pulse's circular_frequency over the block's frequency_parameter, is {frequency_ratio!r}, "
            f"but must lie between {1 / LARGEST_RATIO:g} and {LARGEST_RATIO:g}.",
            frequency_ratio=frequency_ratio,
        )
    if not amplitude_ratio <= LARGEST_RATIO:
        raise PulseError(
            f"a_g/(gλ), the pulse's amplitude over the block's uplift acceleration, is {amplitude_ratio!r}, "
            f"but must be at most {LARGEST_RATIO:g}.",
            amplitude_ratio=amplitude_ratio,
        )


def predict_maxima(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of every block under every pulse, as `predict_maximum` does: exactly.

    inf where it overturns, 0 where it does not lift, nan where `predict_maximum` says it is unresolved.

    Parameters
    ----------
    blocks : sequence of EquivalentBlock
        (m,) equivalent blocks.
    pulses : sequence of Pulse
        (n,) pulses.

    Returns
    -------
    ndarray
        (m, n) largest φ/φ_cr of every block under every pulse; inf where it overturns, 0 without uplift, nan
        where it is unresolved.

    Raises
    ------
    PulseError
        For a pulse and a block that differ beyond measure.

    Examples
    --------
    >>> from rocking import EquivalentBlock, Pulse, predict_maxima
    >>> block = EquivalentBlock(
    ...     frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9
    ... )
    >>> weak = Pulse(amplitude=1.0, circular_frequency=9.0)
    >>> strong = Pulse(amplitude=9.0, circular_frequency=3.0)
    >>> predict_maxima([block], [weak, strong]).tolist()
    [[0.0, inf]]
    """
    peaks = _followed(blocks, pulses).peaks
    ratios = np.empty(peaks.shape[:2])
    for place, block in enumerate(blocks):
        to_positive = block.sides[0].rotation_ratios(peaks[place, :, 0])
        to_negative = block.sides[-1].rotation_ratios(peaks[place, :, 1])
        ratios[place] = np.maximum(to_positive, to_negative)
    return ratios


def overturning_margins(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> np.ndarray:
    """Return `Maximum.overturning_margin`, (m, n), of every block under every pulse: negative where it overturns.

    Parameters
    ----------
    blocks : sequence of EquivalentBlock
        (m,) equivalent blocks.
    pulses : sequence of Pulse
        (n,) pulses.

    Returns
    -------
    ndarray
        (m, n) margins, negative where the block overturns.

    Raises
    ------
    PulseError
        For a pulse and a block that differ beyond measure.

    Examples
    --------
    >>> from rocking import EquivalentBlock, Pulse, overturning_margins
    >>> block = EquivalentBlock(
    ...     frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9
    ... )
    >>> weak = Pulse(amplitude=3.0, circular_frequency=9.0)
    >>> strong = Pulse(amplitude=9.0, circular_frequency=3.0)
    >>> (overturning_margins([block], [weak, strong]) < 0).tolist()
    [[False, True]]
    """
    return _followed(blocks, pulses).margins


def overturning_amplitudes(
    blocks: Sequence[EquivalentBlock], circular_frequencies: Sequence[float] | np.ndarray, polarity: int = 1
) -> np.ndarray:
    """Return the smallest amplitude [m/s²], (m, n), of one full sine at which each block overturns.

    Searched for upwards from the uplift acceleration in steps of 2 %, then halved to 1e-9: a range of overturning
    narrower than that can be missed, and above it the block may stand again.

    Parameters
    ----------
    blocks : sequence of EquivalentBlock
        (m,) equivalent blocks.
    circular_frequencies : sequence of float or ndarray
        (n,) ω_g of the sine, rad/s.
    polarity : int, default 1
        1, or −1 for a sine that begins in the negative direction.

    Returns
    -------
    ndarray
        (m, n) amplitudes, m/s²; inf where a thousand times the uplift acceleration does not overturn the
        block.

    Raises
    ------
    PulseError
        For a pulse and a block that differ beyond measure.

    Examples
    --------
    >>> from rocking import EquivalentBlock, overturning_amplitudes
    >>> block = EquivalentBlock(
    ...     frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9
    ... )
    >>> overturning_amplitudes([block], [5.0, 10.0]).round(3).tolist()
    [[2.548, 5.92]]
    """
    frequencies = np.asarray(circular_frequencies, dtype=float)
    if frequencies.ndim != 1 or not np.all((frequencies > 0) & np.isfinite(frequencies)):
        raise PulseError(
            "circular_frequencies must be a one-dimensional array of finite numbers greater than 0.",
            circular_frequencies=frequencies,
        )
    if polarity not in (1, -1):
        raise PulseError(f"polarity is {polarity!r}, but must be 1 or -1.", polarity=polarity)
    rows = _rows(blocks, frequencies, np.zeros(1))
    amplitudes = np.empty((len(blocks), frequencies.size))
    sine_pulse.kernel.thresholds(rows, -polarity, frequencies, amplitudes)
    return amplitudes


def _followed(blocks: Sequence[EquivalentBlock], pulses: Sequence[Pulse]) -> _Followed:
    """Follow every block under every pulse."""
    frequencies = np.array([pulse.circular_frequency for pulse in pulses])
    amplitudes = np.array([pulse.amplitude for pulse in pulses])
    rows = _rows(blocks, frequencies, np.abs(amplitudes))
    peaks = np.empty((len(blocks), len(pulses), 2))
    margins = np.empty((len(blocks), len(pulses)))
    # A positive ground acceleration rocks the block to its negative side.
    signs = np.where(amplitudes < 0, 1, -1)
    begins, ends = np.array([pulse.phases for pulse in pulses]).reshape(-1, 2).T.copy()
    sine_pulse.kernel.courses(rows, signs, frequencies, np.abs(amplitudes), begins, ends, peaks, margins)
    return _Followed(peaks, margins)


def _rows(blocks: Sequence[EquivalentBlock], frequencies: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    """(m, 2, 6) `_rows_of` each block, checked under all pulses."""
    of_blocks = [_rows_of(block) for block in blocks]
    rows = np.array(of_blocks, dtype=float).reshape(-1, 2, len(_SideRow._fields))
    if rows.size and frequencies.size:
        sides = [side for both in of_blocks for side in both]
        stiffest = max(side.frequency_parameter for side in sides)
        softest = min(side.frequency_parameter for side in sides)
        weakest = min(side.uplift_acceleration for side in sides)
        largest_amplitude_ratio = float(amplitudes.max()) / weakest
        check_ratios(
            frequency_ratio=float(frequencies.min()) / stiffest, amplitude_ratio=largest_amplitude_ratio
        )
        check_ratios(
            frequency_ratio=float(frequencies.max()) / softest, amplitude_ratio=largest_amplitude_ratio
        )
    return rows


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
    eta = within(StructureError, "restitution", restitution, low=0, high=1)
    rows = np.tile([1.0, 1.0, eta, 1.0, math.inf, 1.0], (1, 2, 1))  # p = gλ = 1
    omegas, strengths = (axis.ravel() for axis in np.meshgrid(frequencies, amplitudes, indexing="ij"))
    peaks = np.empty((1, omegas.size, 2))
    margins = np.empty((1, omegas.size))
    begins, ends = (np.full(omegas.size, phase) for phase in sine_pulse.kernel.FULL_SINE)
    signs = np.ones(omegas.size, dtype=int)
    sine_pulse.kernel.courses(rows, signs, omegas, strengths, begins, ends, peaks, margins)
    result: np.ndarray = peaks[0].max(axis=1).reshape(frequencies.size, amplitudes.size)
    return result


def _axis(field: str, values: np.ndarray, lowest: float) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or array.size == 0:
        raise PulseError(
            f"{field} has the shape {array.shape}, but must be a list of at least one number.",
            **{field: array},
        )
    wrong = array[~((array >= lowest) & (array <= LARGEST_RATIO))]
    if wrong.size:
        raise PulseError(
            f"{field} holds {wrong[0]!s}, but every value must lie between {lowest:g} and {LARGEST_RATIO:g}.",
            **{field: float(wrong[0])},
        )
    return array


def printed_maximum(equivalent_block: EquivalentBlock, pulse: Pulse) -> float:
    """Return φ_max/φ_cr by Eq. 15 exactly as the paper prints it: 1 − √(1 − η² (1 − D₀)).

    For a block that measures the rotation otherwise, a positive value is read back as φ/φ_cr. nan where the
    radicand is negative, which the paper reads as overturning; 0.0 where the pulse lifts nothing (a ≤ 1),
    where Eq. 16 is not defined. It may be negative, and it is wrong outside the regime
    `Regime.PRINTED_EXACT`; `predict_maximum` is not. For a block with two different sides it takes the side
    that the pulse lifts first, as if the other were the same; for a one-sided block its only side, as if the
    pulse's first half lifted it.

    Parameters
    ----------
    equivalent_block : EquivalentBlock
        The block.
    pulse : Pulse
        One full sine.

    Returns
    -------
    float
        φ_max/φ_cr as printed.

    Raises
    ------
    PulseError
        For a pulse that is no full sine.

    Examples
    --------
    >>> from rocking import EquivalentBlock, Pulse, predict_maximum, printed_maximum
    >>> block = EquivalentBlock(
    ...     frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9
    ... )
    >>> pulse = Pulse(amplitude=4.0, circular_frequency=12.0)
    >>> round(printed_maximum(block, pulse), 3), round(predict_maximum(block, pulse).rotation_ratio, 3)
    (0.329, 0.323)
    """
    first, second = sides_under(equivalent_block, pulse)
    if not pulse.is_full_sine:
        raise PulseError(
            f"{pulse!r} is no full sine, for which alone Eq. 15 is printed; use predict_maximum.", pulse=pulse
        )
    side = first if first.exists else second
    if side.amplitude_ratio <= 1:
        return 0.0
    eta = side.restitution
    drop = (
        0.0
        if eta == 0
        else eta**2
        * pulse_end_energy(frequency_ratio=side.frequency_ratio, amplitude_ratio=side.amplitude_ratio)
    )
    if drop > 1:
        return math.nan
    root = math.sqrt(1 - drop)
    # Of a small drop 1 − √(1 − drop) would lose its digits.
    maximum = drop / (1 + root) if drop > -1 else 1 - root
    own = equivalent_block.sides[-1 if first.exists and pulse.amplitude >= 0 else 0]
    return own.rotation_ratio(maximum) if maximum > 0 else maximum


@dataclass(frozen=True)
class AsPrinted:
    """The closed form of the source paper for one mechanism under one sine: Eqs. 15 and 16 as printed, and its block.

    block: that of section 4, with λ of Eq. 7 and p of Eq. 11. rotation_ratio: by Eq. 15, inf where its radicand is
    negative, which the paper reads as overturning; it may be negative. regime: that of this block, exactly. holds:
    whether Eq. 15 does, which gives no warning where not: the block makes no contact before the pulse ends, and is
    largest, or overturns, after the first impact; or nothing lifts it.
    """

    block: EquivalentBlock
    rotation_ratio: float
    regime: Regime
    holds: bool


def predict_as_printed(mechanism: Mechanism, pulse: Pulse) -> AsPrinted | None:
    """Return what the source paper predicts for a mechanism under one full sine; None under another pulse.

    >>> from rocking import Pulse, Wall
    >>> from rocking.sine_pulse import predict_as_printed
    >>> printed = predict_as_printed(Wall(1.6, 1.6, 0.25).mechanism(), Pulse(amplitude=4.0, circular_frequency=16.0))
    >>> round(printed.rotation_ratio, 3), printed.holds
    (0.578, False)
    """
    if not pulse.is_full_sine:
        return None
    block = mechanism.equivalent_block(PRINTED_SCALE)
    ratio = printed_maximum(block, pulse)
    exact = predict_maximum(block, pulse)
    holds = exact.regime in (Regime.PRINTED_EXACT, Regime.NO_UPLIFT)
    if exact.regime is Regime.OVERTURNS_AFTER_IMPACTS and exact.impacts == 1 and block.other_side is None:
        sides = sides_under(block, pulse)
        touches = sine_pulse.kernel.course(*sides, *pulse.phases).contacts
        holds = sides[0].exists and not touches
    return AsPrinted(block, math.inf if math.isnan(ratio) else ratio, exact.regime, holds)


def pulse_end_energy(*, frequency_ratio: float, amplitude_ratio: float) -> float:
    """Return 1 − D₀: the squared velocity x'² with which a block that rocks at the pulse's end will land.

    D₀ = (x − 1)² − x'² at the end of the pulse, for x = φ/φ_cr and time p t (Eq. 16).
    frequency_ratio: ω = ω_g/p > 0. amplitude_ratio: a = a_g/(gλ) > 1. ± inf where the value leaves the range of doubles
    (ω < 0.009). The relative error stays below 1e-11 for ω from 1e-3 to 1e6 and a from 1 + 1e-12 to 1e6, except next to
    the zeros of 1 − D₀ and of √(a² − 1) − ω, where terms cancel: it grows as 1e-15 times the largest term over the sum.
    Raises PulseError for an argument that is not finite or out of range.
    """
    omega = positive(PulseError, "frequency_ratio", frequency_ratio)
    a = finite(PulseError, "amplitude_ratio", amplitude_ratio)
    if not a > 1:
        raise PulseError(
            f"amplitude_ratio is {amplitude_ratio!r}, but must exceed 1 for the pulse to lift the block.",
            amplitude_ratio=amplitude_ratio,
        )
    check_ratios(frequency_ratio=omega, amplitude_ratio=a)
    # s = √(a² − 1), the slope of a sin θ where it reaches 1, and asin(1/a) written so that it keeps its digits
    s = math.sqrt((a - 1) * (a + 1))
    exponent = (2 * math.pi - math.atan2(1.0, s)) / omega
    if exponent < 1:
        # a − s cosh T + ω sinh T freed of its cancellations: a − s = 1/(a + s)
        bracket = 1 / (a + s) - 2 * s * math.sinh(exponent / 2) ** 2 + omega * math.sinh(exponent)
    else:
        with np.errstate(over="ignore"):
            half = float(np.exp(exponent / 2))  # twice, as the product with a small factor may be finite
        growing = (omega - s) / 2 * half * half if omega != s else 0.0
        bracket = a + growing - (omega + s) / 2 * math.exp(-exponent)
    return 1 / (omega**2 + 1) + 2 * a * (omega / (omega**2 + 1)) ** 2 * bracket
