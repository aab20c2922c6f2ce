"""One flight of the equivalent block under a sine: the exact motion from φ = 0 to the next contact or the pulse's end.

On one side, with x = φ/φ_cr, time t in units of 1/p and the forcing f = a sin θ (a signed: positive where the ground
lifts this side), θ = θ₀ + ωt, the block obeys x'' = x − 1 + f (Eq. 10), and from x = 0, x' = v

    x = P (cosh t − 1) + Q sinh t + [f₀ (1 − cos ωt) − k sin ωt] / (1 + ω²) ,   k = a cos θ₀ ,
    P = (f₀ − 1 − ω²) / (1 + ω²) ,   Q = v + ωk / (1 + ω²) .

The zeros of x' are isolated exactly. With the homogeneous part h = P sinh t + Q cosh t and c = a cos θ,
(x'/c)' has the sign of r = h'c + ωhf, and r' = (1 + ω²) h c: between zeros of h and c, r is monotonic; between those
of r as well, x'/c is; between those of x', x is. No sampling, so no extreme and no contact can be missed.
"""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

LONGEST_TIME = 60.0
"""Flight time, in 1/p, after which e^t outweighs every term of the pulse by more than doubles can hold."""

_SHORT = 0.3
_VERY_SHORT = 1e-3
"""Below these values of max(t, ωt) the motion is summed as a power series of 14 and of 8 terms."""

_CONVERGED = 1e-10
"""A Newton step of this relative size is the last: the error after it is its square."""

_QUARTERS = (math.pi / 2, 3 * math.pi / 2)


class Landing(NamedTuple):
    """How a flight ends: `contact` or not, at time t (1/p), with position x and velocity x'; its highest peak."""

    contact: bool
    time: float
    position: float
    velocity: float
    peak: float


class Flight:
    """The motion from φ = 0 at phase θ₀ with velocity v ≥ 0. excess: f₀ − 1. slope: k = a cos θ₀."""

    def __init__(
        self, omega: float, amplitude: float, phase: float, velocity: float, excess: float, slope: float
    ) -> None:
        self.omega, self.amplitude, self.phase, self.velocity = omega, amplitude, phase, velocity
        self.excess, self.force, self.slope = excess, 1 + excess, slope
        self.series: list[float] = []
        self.share = 1 / (1 + omega * omega)
        self.cosine = (excess - omega * omega) * self.share
        self.sine = velocity + omega * slope * self.share

    def state(self, t: float) -> tuple[float, float, float]:
        """Return x, x', x'' at time t ≥ 0."""
        u = self.omega * t
        if t < _SHORT and u < _SHORT:
            return self._series(t, 8 if t < _VERY_SHORT and u < _VERY_SHORT else 14)
        sinh, half, sin, versine = math.sinh(t), math.sinh(t / 2), math.sin(u), 2 * math.sin(u / 2) ** 2
        rise = 2 * half * half
        f0, k = self.force, self.slope
        x = self.cosine * rise + self.sine * sinh + self.share * (f0 * versine - k * sin)
        forced = self.omega * self.share * (f0 * sin - k * (1 - versine))
        velocity = self.cosine * sinh + self.sine * (1 + rise) + forced
        return x, velocity, x - 1 + f0 * (1 - versine) + k * sin

    def _series(self, t: float, terms: int) -> tuple[float, float, float]:
        """Sum the power series and its derivatives (Horner), which loses no digits for short flights."""
        if len(self.series) < terms:
            self.series = self._coefficients(terms)
        x = velocity = half = 0.0
        for coefficient in reversed(self.series):
            half = half * t + velocity
            velocity = velocity * t + x
            x = x * t + coefficient
        return x, velocity, 2 * half

    def _coefficients(self, terms: int) -> list[float]:
        """yₙ/n! with y₀ = 0, y₁ = v, y₂ = f₀ − 1 and y₍ₙ₊₂₎ = yₙ + f⁽ⁿ⁾."""
        y, following, square, factorial = self.velocity, self.excess, -self.omega * self.omega, 1.0
        odd, even = self.slope * self.omega, self.force * square
        series = [0.0]
        for n in range(1, terms):
            factorial *= n
            series.append(y / factorial)
            y, following, odd, even = following, y + odd, even, odd * square
        return series

    def land(self, duration: float) -> Landing:
        """Follow the flight for `duration` (1/p) at most, or to its first contact."""
        low, rising, peak, x, velocity = 0.0, True, 0.0, 0.0, self.velocity
        for high in self._nodes(duration):
            x, velocity, _ = self.state(high)
            if rising and velocity < 0:
                low = root(self._velocity, low, high)
                peak, rising = max(peak, self.state(low)[0]), False
            elif not rising and velocity > 0:
                turn = root(lambda t: _negated(self._velocity(t)), low, high)
                if self.state(turn)[0] <= 0:
                    return self._contact(low, turn, peak)
                low, rising = turn, True
            if not rising and x <= 0:
                return self._contact(low, high, peak)
            low = high
        return Landing(False, duration, x, velocity, max(peak, x))

    def hop(self, duration: float, peak: float) -> Landing | None:
        """Follow a short flight whose acceleration is proved negative throughout; None if it cannot be proved.

        With d = 1 − f₀ > 0, f changing by at most d/2 and x ≤ d/4 within the time 8v/d, x'' ≤ −d/4 there: the flight
        lands within that time, no higher than 2v²/d, and is in the air at v/d, since x'' ≥ −3d/2 as well.
        The peak is sought only where it can exceed `peak`.
        """
        d, v = -self.excess, self.velocity
        if d <= 0 or v * v > d * d / 8:
            return None
        latest = 8 * v / d
        if latest > duration or abs(self.amplitude) * self.omega * latest > d / 2:
            return None
        if 2 * v * v / d > peak:
            peak = self.state(root(self._velocity, 0.0, latest, v / d))[0]
        bend = 2 * v / (3 * d * d) * (v + self.omega * self.slope)
        return self._contact(v / d, latest, peak, 2 * v / d * (1 + bend))

    def _contact(self, low: float, high: float, peak: float, guess: float | None = None) -> Landing:
        time = root(self._position, low, high, guess)
        return Landing(True, time, 0.0, self.state(time)[1], peak)

    def _position(self, t: float) -> tuple[float, float]:
        x, velocity, _ = self.state(t)
        return x, velocity

    def _velocity(self, t: float) -> tuple[float, float]:
        _, velocity, acceleration = self.state(t)
        return velocity, acceleration

    def _nodes(self, duration: float) -> Iterator[float]:
        """Yield, ascending, times between which x'/cos θ is monotonic; the last is `duration`."""
        quarters = ((quarter - self.phase) / self.omega for quarter in _QUARTERS)
        breaks = sorted(t for t in (*quarters, self._homogeneous_turn()) if 0 < t < duration)
        low, before = 0.0, self._monotony(0.0)[0]
        for high in (*breaks, duration):
            after = self._monotony(high)[0]
            if before * after < 0:
                yield root(self._monotony if before > 0 else lambda t: _negated(self._monotony(t)), low, high)
            yield high
            low, before = high, after

    def _homogeneous_turn(self) -> float:
        """The time at which P sinh t + Q cosh t vanishes; nan if it never does."""
        p, q = self.cosine, self.sine
        return math.atanh(-q / p) if abs(q) < abs(p) else math.nan

    def _monotony(self, t: float) -> tuple[float, float]:
        """r and r' of the module's docstring."""
        u = self.omega * t
        sinh, cosh, sin, cos = math.sinh(t), math.cosh(t), math.sin(u), math.cos(u)
        h, rate = self.cosine * sinh + self.sine * cosh, self.cosine * cosh + self.sine * sinh
        c, f = self.slope * cos - self.force * sin, self.force * cos + self.slope * sin
        return rate * c + self.omega * h * f, h * c / self.share


def root(
    function: Callable[[float], tuple[float, float]], low: float, high: float, guess: float | None = None
) -> float:
    """Return where `function` (value and slope) falls through zero between low (value > 0) and high (value < 0).

    Newton's iteration, kept inside the bracket and replaced by bisection where it does not halve the value.
    """
    t, last = (low + high) / 2 if guess is None else guess, math.inf
    for _ in range(200):
        value, slope = function(t)
        if value > 0:
            low = t
        else:
            high = t
        newton = t - value / slope if slope else math.nan
        if abs(newton - t) <= _CONVERGED * t:
            return min(max(newton, low), high)
        bisect = not low <= newton <= high or abs(value) > last / 2
        t, last = (low + high) / 2 if bisect else newton, abs(value)
        if high - low <= 4e-16 * high:
            break
    return t


def _negated(pair: tuple[float, float]) -> tuple[float, float]:
    return -pair[0], -pair[1]
