"""A body held by ties that yield, break and go slack, followed by scipy from positions and energy alone.

Each tie is a small machine of its own: elastic, yielding (its plastic elongation is integrated), slack or broken, each
change an event of `solve_ivp`. Nothing here knows of I, J, G, B, of arcs, or that a largest rotation is enough.
"""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev
from scipy.integrate import solve_ivp

GRAVITY = 9.80665
_DEGREE = 40


@dataclass(frozen=True)
class Held:
    """One side. places(φ): masses, inertias, x, y, angles, arrays. points(φ): how far the point of each tie has moved.

    Positions are interpolated by Chebyshev polynomials over `domain` [rad], of which the derivatives are taken.
    """

    places: Callable[[float], tuple[np.ndarray, ...]]
    points: Callable[[float], np.ndarray]
    domain: tuple[float, float] = (-0.01, 0.4)

    @cached_property
    def series(self):
        """Chebyshev coefficients of I, dI/dφ, lifted weight per g, push per ü_g, then of u and of du/dφ of the ties."""
        low, high = self.domain
        scale, nodes = 2 / (high - low), chebyshev.chebpts1(_DEGREE + 1)
        angles = (nodes / scale) + (low + high) / 2
        masses, inertias = self.places(angles[0])[:2]

        def slopes(values):
            return scale * chebyshev.chebval(
                nodes, chebyshev.chebder(chebyshev.chebfit(nodes, values, _DEGREE))
            )

        x, y, turn = (slopes(np.array([self.places(a)[n] for a in angles])) for n in (2, 3, 4))
        u = np.array([self.points(a) for a in angles])
        inertia = masses @ (x**2 + y**2) + inertias @ turn**2
        rows = [inertia, slopes(inertia[:, None])[0], masses @ y, masses @ x, *u.T]
        rows += [*slopes(u)] if u.size else []
        return chebyshev.chebfit(nodes, np.array(rows).T, _DEGREE)

    def terms(self, phi):
        """I, dI/dφ, lifted weight, push, u and du/dφ of the ties."""
        low, high = self.domain
        values = chebyshev.chebval((2 * phi - low - high) / (high - low), self.series)
        ties = (values.size - 4) // 2
        return (*values[:4], values[4 : 4 + ties], values[4 + ties :])


@dataclass
class TiedBody:
    """Sides by sign (a sign that is not there is a wall to lean on), a tie's law, and what happens to each."""

    sides: dict[int, Held]
    stiffness: float
    pretension: float
    strength: float
    elongation: float
    restitution: float
    count: int
    plastic: np.ndarray = field(init=False)
    mode: list = field(init=False)

    def __post_init__(self):
        self.plastic, self.mode = np.zeros(self.count), ["elastic"] * self.count
        self.pieces, self.events = [], []

    def tension(self, n, u, plastic):
        if self.mode[n] in ("broken", "slack"):
            return 0.0
        if self.mode[n] == "yield":
            return self.strength
        return self.pretension + self.stiffness * (u - plastic)

    def follow(self, ground, vertical, stops: Sequence[float]):
        """Follow ü_g(t) and ü_v(t) from rest, from one of `stops` to the next."""
        phi, rate, sign = 0.0, 0.0, 1
        for start, end in itertools.pairwise(stops):
            now = start
            while now < end:
                now, phi, rate, sign = self._fly(now, end, phi, rate, sign, ground, vertical)

    def at(self, times):
        """Signed rotations at `times`."""
        found = np.full(len(times), np.nan)
        for sign, solved in self.pieces:
            inside = (times >= solved.t[0]) & (times <= solved.t[-1])
            if inside.any():
                found[inside] = sign * solved.sol(times[inside])[0]
        return found

    def _fly(self, now, end, phi, rate, sign, ground, vertical):
        held, count = self.sides[sign], self.count if sign in self.sides and sign > 0 else 0

        def slope(time, y):
            inertia, bend, weight, push, u, pull = held.terms(y[0])
            ties = sum(self.tension(n, u[n], y[2 + n]) * pull[n] for n in range(count))
            force = bend / 2 * y[1] ** 2 + weight * (GRAVITY + vertical(time)) + sign * push * ground(time)
            grows = [pull[n] * y[1] if count and self.mode[n] == "yield" else 0.0 for n in range(self.count)]
            return [y[1], -(force + ties) / inertia, *grows]

        marks = []

        def event(function, direction, name):
            """What ends the flight where it passes zero upwards (1) or downwards (−1); not where the flight starts."""

            def mark(t, y):
                return function(t, y) if t > now else -direction

            mark.terminal, mark.direction, mark.name = True, direction, name
            marks.append(mark)

        event(lambda t, y: y[0], -1, ("land", 0))
        for n in range(count):

            def taut(t, y, n=n):
                return self.pretension + self.stiffness * (held.terms(y[0])[4][n] - y[2 + n])

            if self.mode[n] == "elastic":
                event(lambda t, y, taut=taut: taut(t, y) - self.strength, 1, ("yield", n))
                event(taut, -1, ("slack", n))
            elif self.mode[n] == "slack":
                event(taut, 1, ("elastic", n))
            elif self.mode[n] == "yield":
                event(lambda t, y: y[1], -1, ("elastic", n))
                event(lambda t, y, n=n: y[2 + n] - self.elongation, 1, ("broken", n))
        solved = solve_ivp(
            slope, (now, end), [phi, rate, *self.plastic], "DOP853", events=marks, dense_output=True, rtol=1e-11,
            atol=1e-14, max_step=0.02,
        )  # fmt: skip
        self.pieces.append((sign, solved))
        now, (phi, rate, *plastic) = solved.t[-1], solved.y[:, -1]
        self.plastic = np.array(plastic)
        for mark, times in zip(marks, solved.t_events, strict=True):
            if times.size:
                name, n = mark.name
                self.events.append((now, *mark.name))
                if name == "land":
                    return self._impact(now, rate, sign)
                self.mode[n] = "broken" if name == "yield" and self.elongation == 0 else name
        return now, phi, rate, sign

    def _impact(self, now, rate, sign):
        sign = -sign if -sign in self.sides else sign
        return now, 0.0, self.restitution * abs(rate), sign
