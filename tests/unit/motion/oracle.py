"""An independent integrator: scipy's DOP853 on I, J, G, B themselves, restarted at every sample and event.

Written from the equation of motion alone; it shares no code and no idea with the product (other variable, other
method, events of scipy's own, no table). Slow, and meant to be.
"""

import numpy as np
from scipy.constants import g
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


class Oracle:
    """Follows a mechanism (its `sides`, `one_sided`) through a piecewise linear acceleration."""

    def __init__(self, mechanism, rtol=1e-13, steps=8):
        self.mechanism, self.rtol, self.steps = mechanism, rtol, steps  # at least so many in a sample
        self.peaks = {1: 0.0, -1: 0.0}
        self.impacts, self.overturned = 0, False

    def side(self, s):
        return self.mechanism.sides[0 if s > 0 else -1]

    def acceleration(self, s, rotation, velocity, ground, vertical):
        """phi'' = (-s B ü_g - G (g + ü_v) - J phi'^2) / I with J = I'/2."""
        side = self.side(s)
        pull = -s * side.at("ground", rotation) * ground - side.at("gravity", rotation) * (g + vertical)
        return (pull - side.at("inertia_slope", rotation) / 2 * velocity**2) / side.at("inertia", rotation)

    def run(self, ground, step, vertical=None, after=None):
        """Integrate; returns (largest ratio or inf, impacts). after: seconds of still ground that follow."""
        vertical = np.zeros(len(ground)) if vertical is None else vertical
        state = 0, 0.0, 0.0
        intervals = [(step, ground[i : i + 2], vertical[i : i + 2]) for i in range(len(ground) - 1)]
        after = 20 / self.side(1).frequency_parameter if after is None else after
        for interval in intervals + [(after / 40, (0.0, 0.0), (0.0, 0.0))] * 40:
            state = self.interval(state, *interval)
            if self.overturned:
                return np.inf, self.impacts
        return max(self.peaks[s] / self.side(s).critical_rotation for s in (1, -1)), self.impacts

    def interval(self, state, span, ground, vertical):
        """Advance (side, rotation, velocity) by span seconds over linear accelerations."""
        side, rotation, velocity = state
        now = 0.0

        def push(t):
            return [a[0] + (a[1] - a[0]) * t / span for a in (ground, vertical)]

        while now < span:
            if side == 0:
                now, side = self.lift(now, span, push)
                if side == 0:
                    return 0, 0.0, 0.0
                rotation = velocity = 0.0
            now, rotation, velocity, landed = self.fly(side, rotation, velocity, now, span, push)
            if self.overturned:
                break
            if landed:
                side, rotation, velocity = self.impact(side, velocity)
        return side, rotation, velocity

    def lift(self, now, span, push):
        """The instant from `now` on at which the ground lifts the structure, and to which side; `span`, 0 if none."""

        def excess(t, s):
            return self.acceleration(s, 0.0, 0.0, *push(t))

        instants = []
        for s in (1,) if self.mechanism.one_sided else (1, -1):
            if excess(now, s) > 0:
                instants.append((now, s))
            elif excess(span, s) > 0:
                instants.append((brentq(excess, now, span, (s,), xtol=1e-15), s))
        return min(instants, default=(span, 0))

    def fly(self, s, rotation, velocity, now, span, push):
        """Follow one flight to its landing, its loss or `span`: time, rotation, velocity, whether it landed."""

        def event(function, direction, terminal):
            """What passes zero upwards (1) or downwards (-1); not where the flight starts."""

            def mark(t, y):
                return function(y) if t > now else -direction

            mark.direction, mark.terminal = direction, terminal
            return mark

        end = self.side(s).end_rotation
        landing, loss = event(lambda y: y[0], -1, True), event(lambda y: y[0] - end, 1, True)
        crest = event(lambda y: y[1], -1, False)
        # A flight may be short and low: its own size sets the absolute tolerance.
        size = rotation + abs(velocity) * (span - now) + 1e-9 * self.side(s).critical_rotation
        atol = 1e-3 * self.rtol * size * np.array([1, 1 / (span - now)])
        solved = solve_ivp(
            lambda t, y: [y[1], self.acceleration(s, *y, *push(t))], (now, span), [rotation, velocity], "DOP853",
            events=(landing, loss, crest), rtol=self.rtol, atol=atol, max_step=(span - now) / self.steps
        )  # fmt: skip
        landings, losses, crests = solved.y_events
        self.peaks[s] = max(self.peaks[s], *(top for top, _ in crests), 0.0)
        self.overturned = len(losses) > 0
        if len(landings):
            return solved.t[-1], 0.0, min(landings[0][1], 0.0), True
        return solved.t[-1], *solved.y[:, -1], False

    def impact(self, s, velocity):
        self.impacts += 1
        kept = -self.side(s).restitution * velocity
        s = s if self.mechanism.one_sided else -s
        scale = self.side(s).critical_rotation * self.side(s).frequency_parameter
        return (0, 0.0, 0.0) if kept <= 1e-7 * scale else (s, 0.0, kept)
