"""The linear rocking block under a sine between two phases, by scipy's DOP853; it shares no code with the product.

x'' = x − s − u on the side s = ±1, in units of p and of the uplift acceleration, and x' → η x' as x passes through 0.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

AT_REST = 1e-6
"""Velocity below which the block is at rest while the ground holds it: what it would still turn is its square."""
AFTER = 40.0
"""Time after the pulse by which a block that does not come back is far beyond recall."""


def largest_rotation(eta: float, a: float, omega: float, phase: float, cycles: float) -> float:
    """Return max |x|, inf where it overturns. phase: of the sine as it begins, rad."""
    end = 2 * math.pi * cycles / omega

    def push(t: float) -> float:
        return a * math.sin(omega * t + phase)

    time = x = velocity = largest = 0.0
    side = flights_after = 0
    while flights_after < 2:  # each impact takes energy, so that what comes later is no larger
        shaken = time < end
        if side == 0:
            if not shaken:
                return largest
            time, side = _lifted(push, time, end)
            if side == 0:
                return largest
        flights_after += not shaken

        def motion(t, y, side=side, shaken=shaken):
            return [y[1], y[0] - side - (push(t) if shaken else 0.0)]

        def landing(t, y, side=side):
            return side * y[0]

        def turning(t, y, side=side):
            return side * y[1]

        landing.terminal, landing.direction, turning.direction = True, -1, -1
        flight = solve_ivp(
            motion,
            (time, end if shaken else time + AFTER),
            [x, velocity],
            "DOP853",
            events=[landing, turning],
            rtol=1e-11,
            atol=1e-15,
            max_step=min(0.1, max(abs(velocity) / 3, 5e-3)),  # shorter than any flight, lest it land unseen
        )
        largest = max([largest, *(side * y[0] for y in flight.y_events[1]), side * flight.y[0, -1] * shaken])
        time = float(flight.t[-1])
        if flight.t_events[0].size:
            x, velocity, side = 0.0, eta * float(flight.y[1, -1]), -side
            if abs(velocity) < AT_REST and (time >= end or abs(push(time)) < 1):
                velocity, side = 0.0, 0
        elif shaken:
            x, velocity = (float(value) for value in flight.y[:, -1])
            time = end
        else:
            return math.inf
    return largest


def _lifted(push, time: float, end: float) -> tuple[float, int]:
    """When a block at rest is lifted by `end`, and to which side; 0 where it is not."""
    if abs(push(time)) > 1:
        return time, -1 if push(time) > 0 else 1
    times = np.linspace(time, end, 20001)
    above = np.flatnonzero(np.abs([push(t) for t in times]) > 1)
    if not above.size:
        return end, 0
    first = above[0]
    when = brentq(lambda t: abs(push(t)) - 1, times[first - 1], times[first], xtol=1e-15)
    return when, -1 if push(times[first]) > 0 else 1
