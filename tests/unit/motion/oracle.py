"""An independent integrator: scipy's DOP853 on I, J, G, B themselves, restarted at every sample and event.

Written from the equation of motion alone; it shares no code and no idea with the product (other variable, other
method, events by bracketing the dense output, no table). Slow, and meant to be.
"""

import numpy as np
from scipy.constants import g
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


class Oracle:
    """Follows a mechanism (its `sides`, `one_sided`) through a piecewise linear acceleration."""

    def __init__(self, mechanism, rtol=1e-13, probes=24):
        self.mechanism, self.rtol, self.probes = mechanism, rtol, probes
        self.peaks = {1: 0.0, -1: 0.0}
        self.impacts, self.overturned, self.lost = 0, False, []

    def side(self, s):
        return self.mechanism.sides[0 if s > 0 else -1]

    def acceleration(self, s, rotation, velocity, ground, vertical):
        """phi'' = (-s B ü_g - G (g + ü_v) - J phi'^2) / I with J = I'/2."""
        side = self.side(s)
        pull = -s * side.at("ground", rotation) * ground - side.at("gravity", rotation) * (g + vertical)
        return (pull - side.at("inertia_slope", rotation) / 2 * velocity**2) / side.at("inertia", rotation)

    def run(self, ground, step, vertical=None, after=None, state=(0, 0.0, 0.0)):
        """Integrate; returns (largest ratio or inf, impacts). after: seconds of still ground that follow."""
        vertical = np.zeros(len(ground)) if vertical is None else vertical
        state = tuple(state)
        for i in range(len(ground) - 1):
            state = self.interval(state, step, ground[i : i + 2], vertical[i : i + 2])
            if self.overturned:
                return np.inf, self.impacts
        longest = after if after is not None else 20 / self.side(1).frequency_parameter
        pieces = 40
        for _ in range(pieces):
            state = self.interval(state, longest / pieces, (0.0, 0.0), (0.0, 0.0))
            if self.overturned:
                return np.inf, self.impacts
        return max(self.peaks[s] / self.side(s).critical_rotation for s in (1, -1)), self.impacts

    def interval(self, state, span, ground, vertical):
        """Advance (side, rotation, velocity) by span seconds over linear accelerations."""
        side, rotation, velocity = state
        now = 0.0
        while now < span:
            if side == 0:
                now, side = self.lift(now, span, ground, vertical)
                if side == 0:
                    return 0, 0.0, 0.0
                rotation = velocity = 0.0
            now, rotation, velocity, landed = self.fly(side, rotation, velocity, now, span, ground, vertical)
            if self.overturned:
                break
            if landed:
                side, rotation, velocity = self.impact(side, velocity)
        return side, rotation, velocity

    def lift(self, now, span, ground, vertical):
        def excess(s, t):
            a = ground[0] + (ground[1] - ground[0]) * t / span
            v = vertical[0] + (vertical[1] - vertical[0]) * t / span
            return self.acceleration(s, 0.0, 0.0, a, v)

        found = []
        for s in (1,) if self.mechanism.one_sided else (1, -1):
            if excess(s, now) > 0:
                found.append((now, s))
            elif excess(s, span) > 0:
                found.append((brentq(lambda t, s=s: excess(s, t), now, span, xtol=1e-15), s))
        return min(found) if found else (span, 0)

    def fly(self, s, rotation, velocity, now, span, ground, vertical):
        def slope(t, y):
            a = ground[0] + (ground[1] - ground[0]) * t / span
            v = vertical[0] + (vertical[1] - vertical[0]) * t / span
            return [y[1], self.acceleration(s, y[0], y[1], a, v)]

        scale = self.side(s).critical_rotation

        def solve(until):
            # A flight may be short and low: its own size sets the absolute tolerance.
            size = rotation + abs(velocity) * (until - now) + 1e-9 * scale
            return solve_ivp(
                slope, (now, until), [rotation, velocity], "DOP853", dense_output=True,
                rtol=self.rtol, atol=[1e-3 * self.rtol * size, 1e-3 * self.rtol * size / (until - now)]
            )  # fmt: skip

        whole = solve(span)
        times = np.linspace(now, whole.t[-1], self.probes + 1)
        heights, speeds = whole.sol(times)
        self._climb(s, whole, times, heights, speeds)
        for k in range(1, times.size):
            left, right = heights[k - 1], heights[k]
            low, high = times[k - 1], times[k]
            if right > 0 and speeds[k - 1] < 0 < speeds[k]:  # a minimum between two probes
                high = brentq(lambda t: whole.sol(t)[1], low, high, xtol=1e-16)
                right = whole.sol(high)[0]
            if right > 0:
                if right > self.side(s).end_rotation:
                    self.overturned = True
                    return high, right, speeds[k], False
                continue
            if k == 1 and left <= 0:  # leaves the ground: the landing lies after the highest point
                if speeds[0] > 0 > speeds[1]:
                    low = brentq(lambda t: whole.sol(t)[1], low, high, xtol=1e-16)
                    left = whole.sol(low)[0]
                    self.peaks[s] = max(self.peaks[s], left)
                if left <= 0:
                    return high, 0.0, min(speeds[k], 0.0), True
            landing = brentq(lambda t: whole.sol(t)[0], low, high, xtol=1e-16, rtol=1e-15)
            arrival = solve(landing).y[1, -1] if landing > now else whole.sol(landing)[1]
            return landing, 0.0, min(arrival, 0.0), True
        return span, whole.y[0, -1], whole.y[1, -1], False

    def _climb(self, s, whole, times, heights, speeds):
        for k in range(1, times.size):
            if heights[k] <= 0 and heights[k - 1] <= 0 and k > 1:
                return
            if speeds[k - 1] > 0 >= speeds[k]:
                top = brentq(lambda t: whole.sol(t)[1], times[k - 1], times[k], xtol=1e-16)
                self.peaks[s] = max(self.peaks[s], float(whole.sol(top)[0]))
            if heights[k] <= 0 and speeds[k] < 0:
                return

    def impact(self, s, velocity):
        self.impacts += 1
        kept = -self.side(s).restitution * velocity
        s = s if self.mechanism.one_sided else -s
        scale = self.side(s).critical_rotation * self.side(s).frequency_parameter
        return (0, 0.0, 0.0) if kept <= 1e-7 * scale else (s, 0.0, kept)
