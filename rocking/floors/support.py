"""Support: what carries a structure above the ground, and the motion of a record as it arrives there.

A support is linear. Its modes follow the ground each for itself, and what stands on it feels the sum of their absolute
accelerations. What it leaves out, a building that yields, torsion, what the structure gives back, says
docs/pages/supports.md.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rocking.errors import RecordError
from rocking.floors.kinds import FloorKind
from rocking.quantities import finite
from rocking.signal.accelerogram import SHORTEST_STEP, Accelerogram
from rocking.warnings import RockingWarning

INTERPOLATION_ERROR = 1e-4
"""Largest error of straight lines between the samples of a floor's motion, over its peak. A rotation is up to ten times
as sensitive as its motion where the case is well conditioned, and then still right to a thousandth."""

RINGING = 1e-3
"""Share of the peak of a floor's motion below which its ringing after the record is left out: what the peak can just
overturn it cannot lift, and what still rocks then it changes by no more than a thousandth."""

LONGEST_RINGING = 120.0
"""s; a support of less damping than this can spend is cut off here, and a warning says at what level."""

MOST_SAMPLES = 5_000_000
"""The largest number of samples of a floor's motion; the longest record on the stiffest allowed support needs fewer."""

_LONGEST_PERIOD = 20.0
"""Period, s, of a mode. The highest towers swing in ten; on what swings in 450 (ms, typed as s) nothing would move."""
_LARGEST_PARTICIPATION = 20.0
"""Largest |Γψ| of a mode: ten times that of the top of a tower, and less than one typed in %."""
_LARGEST_DAMPING = 0.999
"""Above it the two exponentials of a mode can no longer be distinguished; critical damping itself is refused."""


@dataclass(frozen=True, kw_only=True)
class Mode:
    """One mode of what carries the structure, as it is felt where the structure stands.

    Parameters
    ----------
    period : float
        Undamped period, s; 0 of a mode that is rigid.
    damping_ratio : float
        Share of the critical damping.
    participation : float
        Γψ, the participation factor times the shape of the mode at the height of the support; negative where
        the mode moves against the ground there.

    Raises
    ------
    RecordError
        For what is out of range.

    Examples
    --------
    >>> rocking.Mode(period=0.3, damping_ratio=0.05, participation=1.3).circular_frequency.__round__(2)
    20.94
    """

    period: float
    damping_ratio: float
    participation: float

    def __post_init__(self) -> None:
        period = finite(RecordError, "period", self.period, "s")
        if period < 0:
            raise RecordError(
                f"period is {self.period!r} s, but must be above 0, or 0 for a mode that is rigid.",
                period=self.period,
            )
        if period > _LONGEST_PERIOD:
            raise RecordError(
                f"period is {self.period!r} s, but must be at most {_LONGEST_PERIOD:g} s, longer than that of "
                "any building; give it in seconds.",
                period=self.period,
            )
        damping = finite(RecordError, "damping_ratio", self.damping_ratio)
        if not 0 <= damping < _LARGEST_DAMPING:
            raise RecordError(
                f"damping_ratio is {self.damping_ratio!r}, but must be a share of the critical one from 0 to below 1.",
                damping_ratio=self.damping_ratio,
            )
        object.__setattr__(self, "period", period)
        object.__setattr__(self, "damping_ratio", damping)
        participation = finite(RecordError, "participation", self.participation)
        if abs(participation) > _LARGEST_PARTICIPATION:
            raise RecordError(
                f"participation is {self.participation!r}, but must be from -{_LARGEST_PARTICIPATION:g} to "
                f"{_LARGEST_PARTICIPATION:g}; give Γψ as a factor, and not in %.",
                participation=self.participation,
            )
        object.__setattr__(self, "participation", participation)

    @property
    def circular_frequency(self) -> float:
        """Undamped, rad/s; inf of a rigid mode."""
        return 2 * math.pi / self.period if self.period else math.inf

    @property
    def follows_the_ground(self) -> bool:
        """Whether what stands on it feels the ground's own acceleration of this mode."""
        return self.period == 0 or self.participation == 0


@dataclass(frozen=True)
class Support:
    """The support of a structure: the modes of a building, a tower or a façade where the structure stands.

    What is left of the ground's motion, 1 − Σ Γψ, is felt as it is, as if by modes that are rigid.

    Parameters
    ----------
    modes : tuple of Mode
        Its modes, one at least.

    Raises
    ------
    RecordError
        Without a mode.

    Examples
    --------
    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> floor = rocking.Support((rocking.Mode(period=0.3, damping_ratio=0.05, participation=1.3),)).motion(record)
    >>> round(floor.peak_acceleration / record.peak_acceleration, 2)
    1.23
    """

    modes: tuple[Mode, ...]

    def __post_init__(self) -> None:
        modes = tuple(self.modes) if isinstance(self.modes, Sequence) else (self.modes,)
        if not modes or not all(isinstance(mode, Mode) for mode in modes):
            raise RecordError(f"modes is {self.modes!r}, but must hold at least one Mode.", modes=self.modes)
        object.__setattr__(self, "modes", modes)

    def __str__(self) -> str:
        return "; ".join(
            f"T_b = {mode.period:.4g} s, damping {mode.damping_ratio:.4g}, Γψ = {mode.participation:.4g}"
            for mode in self.modes
        )

    @property
    def first_period(self) -> float:
        """Period of the first mode, s."""
        return self.modes[0].period

    def sampling(self, records: Sequence[Accelerogram]) -> "FloorSampling":
        """Return the samples that the motions of the support under the components of one record have in common.

        Parameters
        ----------
        records : sequence of Accelerogram
            Components with the same number of samples and the same time step; vertical ones ask for no samples.

        Returns
        -------
        FloorSampling
            Number of samples to each of the record, and of still ones after it.

        Raises
        ------
        RecordError
            When a period is below two samples of the record, and for components that do not fit together.
        """
        _check_alike(records)
        for mode in self._swinging:
            _check_sampled(mode, records[0].time_step)
        common = AS_THE_GROUND
        for record in records if self._swinging else ():
            if not record.vertical:
                own = _sampling(record, [_Ringing.under(mode, record) for mode in self._swinging])
                common = FloorSampling(max(common.finer, own.finer), max(common.after, own.after))
        return common

    def motion(self, record: Accelerogram, sampling: tuple[int, int] | None = None) -> Accelerogram:
        """Return the absolute acceleration of the support under `record`, with a sentence on it in its history.

        A vertical record passes as it is, at the time step of the others, and still after their end.

        Parameters
        ----------
        record : Accelerogram
            One component of the ground.
        sampling : tuple of (int, int) or None, optional
            What `sampling` returns for all components of the record; None for those that this one needs.

        Returns
        -------
        Accelerogram
            The motion where the structure stands.

        Raises
        ------
        RecordError
            When a period is below two samples of the record.
        """
        finer, after = sampling or self.sampling((record,))
        if not after:
            return record
        modes = [] if record.vertical else self._swinging
        ringing = [_Ringing.under(mode, record) for mode in modes]
        motion = _finer(record.acceleration, ringing, finer, after)
        step = record.time_step / finer
        if record.vertical:
            alike = f"Taken {finer} times as fine, with {after} samples of still ground, as the horizontal."
            return record.processed_by(motion, alike, time_step=step)
        sentence = (
            f"Taken to a support of {self}: {finer} times as fine as the record, and {after * record.time_step:.4g} s "
            "of still ground after it."
        )
        made = record.processed_by(motion, sentence, time_step=step, smooth_steps=finer)
        left = sum(mode.level(after) for mode in ringing)
        if left <= 2 * RINGING * made.peak_acceleration:
            return made
        share = left / made.peak_acceleration
        return made.warned(
            RockingWarning.of(FloorKind.STILL_RINGING, share=float(share), after_s=after * record.time_step)
        )

    def motions(self, records: Sequence[Accelerogram]) -> tuple[Accelerogram, ...]:
        """Return the motion of the support under each component of one record, sample by sample alike.

        Parameters
        ----------
        records : sequence of Accelerogram
            Components with the same number of samples and the same time step. Vertical ones pass as they are, at the
            time step of the others, and still after their end.

        Returns
        -------
        tuple of Accelerogram
            The motion under each component, in their order.

        Raises
        ------
        RecordError
            When a period is below two samples of the record, and for components that do not fit together.
        """
        sampling = self.sampling(records)
        return tuple(self.motion(record, sampling) for record in records)

    @property
    def _swinging(self) -> list[Mode]:
        """The modes whose motion is another than that of the ground."""
        return [mode for mode in self.modes if not mode.follows_the_ground]


class FloorSampling(NamedTuple):
    """The samples of a motion of a support.

    finer: their number to each sample of the record. after: samples of still ground after the record, by its time step;
    0 where the support moves as the ground, on its samples.
    """

    finer: int
    after: int


AS_THE_GROUND = FloorSampling(finer=1, after=0)


@dataclass(frozen=True, eq=False)
class _Ringing:
    """One mode under one record whose acceleration is linear within each sample and still one sample after its end.

    With the pole λ = ω(−ξ + i√(1 − ξ²)) and q' = λq − a, the displacement to the ground is Im q/ω_d. Within a sample,
    where a' is constant, q'' = λ(λq − a) − a' is exactly q''₀ e^{λs}, and Im q''/ω_d is what the absolute acceleration
    of the mode has more than the ground's (Nigam & Jennings 1969, in complex form): no error of discretisation is left.

    step: of the record, s. excess: Γψ q''/ω_d at the start of each of the n samples and after
    them, complex, (n + 1,).
    """

    mode: Mode
    step: float
    pole: complex
    excess: np.ndarray

    @classmethod
    def under(cls, mode: Mode, record: Accelerogram) -> "_Ringing":
        from scipy.signal import lfilter  # which takes half a second to import

        step = record.time_step
        pole = mode.circular_frequency * complex(-mode.damping_ratio, math.sqrt(1 - mode.damping_ratio**2))
        slope = np.diff(record.acceleration, append=0.0) / step
        # From one sample to the next, p = λq − a gains the integral of −a' e^{λs}; it starts at −a₀.
        gained = np.empty(slope.size + 1, dtype=complex)
        gained[0] = -record.acceleration[0]
        np.multiply(slope, -np.expm1(pole * step) / pole, out=gained[1:])
        excess = pole * lfilter([1.0], [1.0, -np.exp(pole * step)], gained)
        excess[:-1] -= slope
        excess *= mode.participation / pole.imag
        return cls(mode, step, pole, excess)

    def still(self, after: int) -> np.ndarray:
        """Return the excess at the starts of the first `after` still samples, complex, (after,)."""
        return np.asarray(self.excess[-1] * np.exp(self.pole * self.step * np.arange(after)))

    def within_sample(self, finer: int) -> np.ndarray:
        """Return what the excess at the start of a sample is multiplied by at `finer` places within it, complex."""
        return np.asarray(np.exp(self.pole * self.step / finer * np.arange(finer)))

    def level(self, after: int) -> float:
        """Return the most that the mode can reach any more, `after` samples after the record, m/s²."""
        left = math.exp(self.pole.real * self.step * (after - 1))
        return float(abs(self.excess[-1])) * left

    def time_to(self, level: float) -> float:
        """Return the time from the first still sample until it rings below `level` [m/s²], s; inf without damping."""
        excess = self.level(1) / level
        if excess <= 1:
            return 0.0
        return math.log(excess) / -self.pole.real if self.pole.real else math.inf

    @property
    def curvature(self) -> float:
        """The most that the second derivative of the floor's motion can be, m/s⁴."""
        largest = float(np.abs(self.excess).max())
        return self.mode.circular_frequency**2 * largest


def _check_alike(records: Sequence[Accelerogram]) -> None:
    size = records[0].acceleration.size
    step = records[0].time_step
    for record in records:
        if record.acceleration.size != size or abs(record.time_step / step - 1) > 1e-9:
            raise RecordError(
                f"the components hold {size} samples at {step:g} s and {record.acceleration.size} at "
                f"{record.time_step:g} s, but a support needs the same ones; cut or resample one of them.",
                records=records,
            )


def _check_sampled(mode: Mode, time_step: float) -> None:
    if mode.period < 2 * time_step:
        raise RecordError(
            f"period of the support is {mode.period:g} s, but must be at least two samples of the record, "
            f"{2 * time_step:g} s; give a finer record, or the period 0 for a support that is rigid.",
            period=mode.period,
        )


def _sampling(record: Accelerogram, ringing: Sequence[_Ringing]) -> FloorSampling:
    """Return the samples that the floor's motion under one component needs.

    A line between two samples h apart departs from a motion by at most h²/8 times its largest second derivative. Steps
    below SHORTEST_STEP, which a support of less than .02 s would ask for, are not made.
    """
    step = record.time_step
    at_samples = record.acceleration + sum(mode.excess[:-1].imag for mode in ringing)
    peak = float(np.abs(at_samples).max())
    if peak == 0:
        return FloorSampling(finer=1, after=1)
    coarse = step**2 / 8 * sum(mode.curvature for mode in ringing) / (INTERPOLATION_ERROR * peak)
    finer = max(1, min(math.ceil(math.sqrt(coarse)), int(step / SHORTEST_STEP)))
    allowed = RINGING * peak / len(ringing)
    quiet = max(mode.time_to(allowed) for mode in ringing)
    after = 1 + math.ceil(min(quiet, LONGEST_RINGING) / step)
    number = (record.acceleration.size + after) * finer
    if number > MOST_SAMPLES:
        raise RecordError(
            f"the motion of the support takes {number} samples, but may take {MOST_SAMPLES}; cut the record, or give a "
            "longer period or more damping.",
            samples=number,
        )
    return FloorSampling(finer, after)


def _finer(acceleration: np.ndarray, ringing: Sequence[_Ringing], finer: int, after: int) -> np.ndarray:
    """Return the absolute acceleration of the support, m/s², ((n − 1 + after) finer + 1,).

    acceleration: of the ground, (n,) m/s², linear between its samples, and still from one sample after its end. Each
    value is a sum of what its sample starts with, (ground, its slope, and both parts of each mode's excess), weighted
    by its place within the sample: one product of two matrices.
    """
    ground = np.append(acceleration, np.zeros(after))
    starts = np.empty((2 + 2 * len(ringing), ground.size - 1))
    weights = np.empty((len(starts), finer))
    starts[0] = ground[:-1]
    weights[0] = 1.0
    np.subtract(ground[1:], ground[:-1], out=starts[1])
    weights[1] = np.arange(finer) / finer
    last = ground[-1]
    for row, mode in zip(range(2, len(starts), 2), ringing, strict=True):
        still = mode.still(after)
        during = mode.excess.size - 1
        for place, part in ((row, "imag"), (row + 1, "real")):
            starts[place, :during] = getattr(mode.excess[:-1], part)
            starts[place, during:] = getattr(still[:-1], part)
        within_sample = mode.within_sample(finer)
        weights[row] = within_sample.real
        weights[row + 1] = within_sample.imag
        last += still[-1].imag
    motion = np.empty((ground.size - 1) * finer + 1)
    np.matmul(starts.T, weights, out=motion[:-1].reshape(-1, finer))
    motion[-1] = last
    motion.flags.writeable = False
    return motion
