"""The reference solution: scipy's own integrators on I, J, G and B themselves, against which error is measured.

Written from the equation of motion (theory: section 1, "One standard form"); it shares nothing with rocking.motion.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from rocking import Accelerogram, Mechanism, MotionError
from rocking.quantities import GRAVITY

STEPS_PER_SAMPLE = 2
"""Least steps between two samples of the reference, so that no hop hides inside a step."""
REST_SPEED = 1e-7
"""An impact that leaves less than this, in units of p φ_cr, leaves the structure at rest."""
STILL = 20.0
"""How long still ground is followed after the record, in units of 1/p."""
STILL_LANDINGS = 3
"""Landings on still ground after which each side has had its largest flight: impacts only take energy away."""


def landings(
    mechanism: Mechanism,
    record: Accelerogram,
    method: str = "DOP853",
    tolerance: float = 1e-12,
    *,
    restart: bool = True,
) -> tuple[float, np.ndarray]:
    """Return φ_max/φ_cr, inf if it overturns, and (k, 2) time [s] and speed of arrival [rad/s] of every landing.

    restart: at every sample and every impact, as of the reference. Else as one writes it with `solve_ivp`: the record
    interpolated, an event at each impact, no step longer than a sample, and overturning a rotation past the end of the
    mechanism.
    """
    if mechanism.remembers:
        raise MotionError(
            "the structure has ties that yield or break, but the reference solution knows elastic ones only; leave "
            "their strength out."
        )
    return _Run(mechanism, record, method, tolerance, restart).answer()


class _Run:
    """One mechanism through one record; `sides` holds +1 and −1, or +1 alone for a one-sided structure."""

    def __init__(
        self, mechanism: Mechanism, record: Accelerogram, method: str, tolerance: float, restart: bool
    ) -> None:
        self.method, self.tolerance, self.restart = method, tolerance, restart
        self.ground: list[float] = record.acceleration.tolist()
        self.step = record.time_step
        self.duration = record.duration
        self.sides = {1: mechanism.positive}
        if not mechanism.one_sided:
            self.sides[-1] = mechanism.negative or mechanism.positive
        self.peak = 0.0

    def answer(self) -> tuple[float, np.ndarray]:
        """Follow the motion; return its largest rotation ratio, and time and speed of every landing (k, 2)."""
        samples = range(1, len(self.ground) - 1) if self.restart else ()
        still = STILL / min(side.frequency_parameter for side in self.sides.values())
        now, sign, state, still_landings = 0.0, 0, (0.0, 0.0), 0
        arrivals: list[tuple[float, float]] = []
        for until in (*(k * self.step for k in samples), self.duration, self.duration + still):
            while now < until and self.peak < math.inf and still_landings < STILL_LANDINGS:
                if sign == 0:
                    now, sign = self._lift(now, until)
                    if sign == 0:
                        break
                now, state, landed = self._fly(sign, state, now, until)
                if landed:
                    arrivals.append((now, -state[1]))
                    still_landings += until > self.duration
                    speed = self.sides[sign].restitution * max(-state[1], 0.0)
                    sign = -sign if -sign in self.sides else sign
                    side, state = self.sides[sign], (0.0, speed)
                    if speed <= REST_SPEED * side.critical_rotation * side.frequency_parameter:
                        sign, state = 0, (0.0, 0.0)
        return self.peak, np.array(arrivals, dtype=float).reshape(-1, 2)

    def _acceleration(self, time: float) -> float:
        place = min(int(time / self.step), len(self.ground) - 2)
        before, after = self.ground[place], self.ground[place + 1]
        return before + (after - before) * (time / self.step - place)

    def _lift(self, now: float, until: float) -> tuple[float, int]:
        """Return when and to which side the ground lifts a structure at rest; side 0: not before `until`."""
        if until > self.duration:
            return until, 0
        inside = np.arange(math.floor(now / self.step) + 1, math.ceil(until / self.step)) * self.step
        times = np.concatenate([[now], inside[(inside > now) & (inside < until)], [until]])
        ground = np.array([self._acceleration(time) for time in times])
        lifts = []
        for sign, side in self.sides.items():
            excess = -sign * ground - side.uplift_multiplier * GRAVITY
            first = int(np.argmax(excess > 0))
            if excess[first] > 0:
                low = max(first - 1, 0)
                share = 0.0 if first == 0 else excess[low] / (excess[low] - excess[first])
                lifts.append((float(times[low] + share * (times[first] - times[low])), sign))
        return min(lifts, default=(until, 0))

    def _fly(
        self, sign: int, state: tuple[float, float], now: float, until: float
    ) -> tuple[float, tuple[float, float], bool]:
        """Return time, rotation and rate at the landing, or at `until`, and whether it landed."""
        side, span = self.sides[sign], min(until - now, self.step)
        size = state[0] + abs(state[1]) * span + 1e-9 * side.critical_rotation
        still = until > self.duration

        def slope(time: float, y: np.ndarray) -> list[float]:
            """φ'' = −(s B ü_g + G g + J φ'²) / I, J = I'/2."""
            rotation, velocity = y
            ground = 0.0 if still else self._acceleration(time)
            push = sign * side.at("ground", rotation) * ground
            slowing = side.at("inertia_slope", rotation) / 2 * velocity**2
            pull = push + side.at("gravity", rotation) * GRAVITY + slowing
            return [velocity, -pull / side.at("inertia", rotation)]

        landing = _Event(lambda time, y: y[0] if time > now else side.critical_rotation, True, -1)
        turn = _Event(lambda _, y: y[1], False, -1)
        end = _Event(lambda _, y: y[0] - side.end_rotation, True, 0)
        solved = solve_ivp(
            slope,
            (now, until),
            state,
            self.method,
            events=(landing, turn, end),
            rtol=self.tolerance,
            atol=1e-3 * self.tolerance * size * np.array([1, 1 / span]),
            max_step=self.step / (STEPS_PER_SAMPLE if self.restart else 1),
        )
        down, turns, ends = solved.y_events
        peaks = [state[0], solved.y[0, -1], *(y[0] for y in turns)]
        self.peak = (
            math.inf if len(ends) else max(self.peak, *(peak / side.critical_rotation for peak in peaks))
        )
        rate = float(solved.y[1, -1])
        if len(down):
            return float(solved.t[-1]), (0.0, rate), True
        return until, (float(solved.y[0, -1]), rate), False


@dataclass(frozen=True)
class _Event:
    """An event of `solve_ivp`: where `value` crosses 0 in a direction; terminal: the integration ends there."""

    value: Callable[[float, np.ndarray], float]
    terminal: bool
    direction: int

    def __call__(self, time: float, state: np.ndarray) -> float:
        return self.value(time, state)
