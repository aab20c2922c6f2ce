"""The course of an equivalent block under a sine pulse in plain Python: the oracle of the compiled one.

It is what the product was before it was compiled, kept as it was.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from interpreted_flight import LONGEST_TIME, Flight, Landing

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse.kernel import MOST_IMPACTS, REST_ENERGY
from rocking.sine_pulse.maximum import Maximum, Regime
from rocking.sine_pulse.ratios import Ratios, first_and_second
from rocking.structures.mechanism import EquivalentBlock
from rocking.structures.outcome import Outcome

_PULSE_END = 2 * math.pi


def interpreted_maximum(equivalent_block: EquivalentBlock, pulse: Pulse) -> Maximum:
    """What `predict_maximum` returns."""
    first, second = first_and_second(equivalent_block, pulse)
    one_shape = equivalent_block.other_side is None and first is not None
    first_side = 1 if pulse.amplitude < 0 else -1
    positive, negative = equivalent_block.sides[0], equivalent_block.sides[-1]
    read_back = (positive, negative) if first_side > 0 else (negative, positive)
    return _maximum_of(
        first, second, first_side, one_shape, (read_back[0].rotation_ratio, read_back[1].rotation_ratio)
    )


def _maximum_of(
    first: Ratios | None,
    second: Ratios | None,
    first_side: int,
    one_shape: bool,
    read_back: tuple[Callable[[float], float], Callable[[float], float]] = (float, float),
) -> Maximum:
    """Return the maximum from the ratios of the side that the pulse's first half lifts, and of the other one.

    first_side: the sign of the first one's rotation. one_shape: whether the pulse's first half lifts the block and what
    it lands on next is the same again, as Eq. 15 takes for granted. read_back: φ/φ_cr of x on the first side and on the
    other.
    """
    course = _Course((first, second))
    course.follow()
    return course.maximum(first_side, one_shape, read_back)


@dataclass
class _Course:
    """The course of events: sides[0] is lifted by the pulse's first half, sides[1] by its second."""

    sides: tuple[Ratios | None, Ratios | None]
    impacts: int = 0
    contacts_in_pulse: int = 0
    peaks: list[float] = field(default_factory=lambda: [0.0, 0.0])
    peak_impacts: list[int] = field(default_factory=lambda: [-1, -1])
    margin: float = 1.0
    unresolved: bool = False
    overturned: bool = False

    def follow(self) -> None:
        """Follow the block from rest at the pulse's start to its last relevant flight."""
        start = self._next_uplift(0.0)
        while start is not None:
            rest = self._rock(*start)
            start = None if rest is None else self._next_uplift(rest)

    def maximum(
        self,
        first_side: int,
        one_shape: bool,
        read_back: tuple[Callable[[float], float], Callable[[float], float]],
    ) -> Maximum:
        """Return what was found; `first_side` is the sign of sides[0]."""
        if self.unresolved:
            return Maximum(math.nan, Outcome.FAILED, Regime.UNRESOLVED, self.impacts, 0, math.nan)
        if max(self.peak_impacts) < 0:
            return Maximum(0.0, Outcome.NO_UPLIFT, Regime.NO_UPLIFT)
        ratios = [read(peak) for read, peak in zip(read_back, self.peaks, strict=True)]
        index = self._larger(ratios)
        impacts, ratio = self.peak_impacts[index], ratios[index]
        overturns = math.isinf(ratio)
        return Maximum(
            rotation_ratio=ratio,
            outcome=Outcome.OVERTURNS if overturns else Outcome.ROCKS,
            regime=self._regime(overturns, impacts, one_shape),
            impacts=impacts,
            peak_side=first_side if index == 0 else -first_side,
            overturning_margin=-math.inf if overturns and not self.overturned else self.margin,
        )

    def _larger(self, ratios: list[float]) -> int:
        """The side of the larger ratio; of two that are equal, that which was reached first."""
        early = min((0, 1), key=lambda k: (self.peak_impacts[k] < 0, self.peak_impacts[k]))
        late = 1 - early
        return late if self.peak_impacts[late] >= 0 and ratios[late] > ratios[early] * (1 + 1e-12) else early

    def _regime(self, overturns: bool, impacts: int, one_shape: bool) -> Regime:
        if overturns:
            return Regime.OVERTURNS_AFTER_IMPACTS if impacts else Regime.OVERTURNS_WITHOUT_IMPACT
        if self.contacts_in_pulse:
            return Regime.CONTACT_DURING_PULSE
        if not impacts:
            return Regime.BEFORE_FIRST_IMPACT
        return Regime.PRINTED_EXACT if one_shape else Regime.AFTER_FIRST_IMPACT

    def _next_uplift(self, phase: float) -> tuple[float, int] | None:
        """Return the phase, at or after `phase`, and the index of the side at which a resting block is lifted."""
        starts = []
        for index, side in enumerate(self.sides):
            if side is None or side.amplitude_ratio <= 1:
                continue
            start, end = index * math.pi + side.uplift_phase, (index + 1) * math.pi - side.uplift_phase
            if phase < end:
                starts.append((max(phase, start), index))
        return min(starts, default=None)

    def _rock(self, phase: float, index: int) -> float | None:
        """Follow the block from rest until it rests again; return that phase, or None when nothing more can come."""
        velocity = 0.0
        while True:
            flight = self._flight(phase, index, velocity)
            landing = self._land(flight)
            self._record(landing.peak, index)
            if not landing.contact:
                self._after_pulse(index, landing)
                return None
            phase += flight.omega * landing.time
            self.impacts += 1
            self.contacts_in_pulse += 1
            index, velocity = self._impact(index, -landing.velocity)
            if velocity * velocity <= REST_ENERGY:
                return phase
            rest = self._settles(phase, index, velocity)
            if rest is not None:
                return rest
            if self.impacts >= MOST_IMPACTS:
                self.unresolved = True
                return None

    def _flight(self, phase: float, index: int, velocity: float) -> Flight:
        side = self._side(index)
        amplitude = side.amplitude_ratio * (1 - 2 * index)
        if velocity == 0 and phase == index * math.pi + side.uplift_phase:
            excess, slope = 0.0, side.uplift_slope
        else:
            excess, slope = amplitude * math.sin(phase) - 1, amplitude * math.cos(phase)
        return Flight(side.frequency_ratio, amplitude, phase, velocity, excess, slope)

    def _land(self, flight: Flight) -> Landing:
        remaining = max(0.0, (_PULSE_END - flight.phase) / flight.omega)
        duration = min(remaining, LONGEST_TIME)
        landing = flight.hop(duration, self._unseen()) or flight.land(duration)
        if landing.contact or duration == remaining:
            return landing
        return landing._replace(velocity=math.inf)

    def _unseen(self) -> float:
        """The x below which a peak on either side cannot be the largest rotation."""
        one, other = self.sides
        return max(self.peaks) if one is None or other is None or one == other else min(self.peaks)

    def _impact(self, index: int, speed: float) -> tuple[int, float]:
        """Return the side and the velocity after landing on side `index` with `speed`."""
        old = self._side(index)
        other = self.sides[1 - index]
        new, following = (old, index) if other is None else (other, 1 - index)
        return following, old.restitution * speed * old.velocity_scale / new.velocity_scale

    def _record(self, peak: float, index: int) -> None:
        if self.peak_impacts[index] < 0 or peak > self.peaks[index] * (1 + 1e-12):
            self.peaks[index], self.peak_impacts[index] = peak, self.impacts

    def _after_pulse(self, index: int, end: Landing) -> None:
        """Follow the free motion from the pulse's end: x − 1 + x' > 0 overturns, else (x − 1)² − x'² is conserved."""
        x, velocity = end.position, end.velocity
        if self._falls(x + velocity, index):
            return
        energy = x * (2 - x) + velocity * velocity
        if velocity > 0:
            self._record(_free_peak(energy), index)
        for _ in range(2):
            self.impacts += 1
            index, velocity = self._impact(index, math.sqrt(max(energy, 0.0)))
            if self._falls(velocity, index):
                return
            energy = velocity * velocity
            self._record(_free_peak(energy), index)

    def _falls(self, unstable: float, index: int) -> bool:
        """Record whether the block overturns on side `index`, given x + x' in free motion."""
        self.margin = min(self.margin, 1 - unstable)
        if unstable > 1:
            self._record(math.inf, index)
            self.overturned = True
        return self.overturned

    def _settles(self, phase: float, index: int, velocity: float) -> float | None:
        """Return a phase by which the chain of impacts is proved to be over, or None if that is not proved.

        Halfway to the next uplift, d bounds 1 − f on both sides from below. A flight launched with v² ≤ d²/2 has
        x'' ≤ −d/2: it lasts 4v/d at most, rises v²/d at most, and lands with at most v √(1 + 8aωv/d²), so two flights
        multiply the velocity by ρ² = η₁η₂ (1 + 8aωv/d²) at most. If ρ² < 1 the times of all flights sum to
        8v/(d (1 − ρ²)). The chain is over if that ends in time and v²/d does not exceed the peak on record.
        """
        sides = [side for side in self.sides if side is not None]
        following = self._next_uplift(phase)
        end = _PULSE_END if following is None else phase + (following[0] - phase) / 2
        least = min(1 - _largest_force(side.amplitude_ratio, phase, end) for side in sides)
        scale = self._side(index).velocity_scale
        v = velocity * max(scale / side.velocity_scale for side in sides)
        if least <= 0 or v * v > least * least / 2 or v * v / least > self._unseen():
            return None
        omega = max(side.frequency_ratio for side in sides)
        steepest = max(side.amplitude_ratio * side.frequency_ratio for side in sides)
        shrink = sides[0].restitution * sides[-1].restitution * (1 + 8 * steepest * v / least**2)
        over = shrink < 1 and phase + 8 * omega * v / (least * (1 - shrink)) <= end
        return end if over else None

    def _side(self, index: int) -> Ratios:
        side = self.sides[index]
        assert side is not None
        return side


def _free_peak(energy: float) -> float:
    """1 − √(1 − (1 − D)) for 1 − D = `energy` ≤ 1, without cancellation."""
    return energy / (1 + math.sqrt(max(1 - energy, 0.0)))


def _largest_force(amplitude_ratio: float, start: float, end: float) -> float:
    """Return the largest a |sin θ| for θ in [start, end], rad."""
    for crest in (math.pi / 2, 3 * math.pi / 2):
        if start < crest < end:
            return amplitude_ratio
    return amplitude_ratio * max(abs(math.sin(start)), abs(math.sin(end)))
