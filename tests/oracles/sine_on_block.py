"""The linear rocking block under one full sine, flight by flight in closed form; it shares no code with the product.

x'' = p² (x − s − u) on the side s = ±1, with u = a sin ωt while the pulse lasts, and x' → η x' as x passes through 0.
"""

import math

import numpy as np
from scipy.optimize import brentq


def largest_rotation(p: float, eta: float, a: float, omega: float) -> float:
    """Return max |x|, inf where it overturns. p, omega: rad/s. a: amplitude over gλ; a > 1."""
    end = 2 * math.pi / omega
    response = p**2 * a / (p**2 + omega**2)
    time = math.asin(1 / a) / omega
    side = -1.0  # ground that accelerates in the positive direction lifts the negative side
    x = velocity = largest = 0.0
    flights_after = 0
    while flights_after < 2:  # the energy falls with each impact, so later ones are no larger
        flights_after += time >= end
        shaken = response if time < end else 0.0
        above = x - side - shaken * math.sin(omega * time)
        slope = (velocity - shaken * omega * math.cos(omega * time)) / p

        def place(t, time=time, side=side, shaken=shaken, above=above, slope=slope):
            tau = p * (t - time)
            return side + above * np.cosh(tau) + slope * np.sinh(tau) + shaken * np.sin(omega * t)

        def speed(t, time=time, shaken=shaken, above=above, slope=slope):
            tau = p * (t - time)
            still = above * np.sinh(tau) + slope * np.cosh(tau)
            return p * still + shaken * omega * np.cos(omega * t)

        last = end if time < end else time + 40 / p
        # Not at the start, where x is rounding: a flight shorter than a thousandth of the pulse would be missed.
        times = np.linspace(time, last, 20001)[20:]
        places = side * place(times)
        back = np.flatnonzero(places < 0)
        stop = back[0] if back.size else times.size - 1
        largest = max(largest, places[: stop + 1].max())
        turns = np.flatnonzero(np.diff(np.sign(speed(times[: stop + 1]))))
        for turn in turns:
            top = brentq(speed, times[turn], times[turn + 1], xtol=1e-15)
            largest = max(largest, side * float(place(top)))
        if not back.size and time >= end:
            return math.inf
        if back.size:
            time = brentq(place, times[stop - 1], times[stop], xtol=1e-15)
            velocity = eta * float(speed(time))
            side = -side
            x = 0.0
        else:
            x, velocity, time = float(place(end)), float(speed(end)), end
    return largest
