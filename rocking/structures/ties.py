"""The tie that holds a structure back: elastic, brittle or yielding until it breaks.

A tie pulls only. Its force depends on how far its point has moved
and on how far it ever was. Since its point moves outwards all the time with the rotation φ, the largest rotation so far
is all that a side has to remember, whatever the number of ties.
"""

from dataclasses import dataclass, replace

import numpy as np

from rocking.structures.equivalent_block import Function


@dataclass(frozen=True)
class Tie:
    """A tie that stays horizontal, being long: force `pretension` + `stiffness` · u up to `strength`.

    u ≥ 0 is how far its point moved towards the side of rocking. At its strength it yields, by `plastic_elongation` [m]
    until it breaks; 0 is brittle. Unloading is elastic, with the plastic elongation taken off u, and where that leaves
    no tension it is slack. A side on which it would slacken from the start has no tie.
    """

    stiffness: float
    pretension: float = 0.0
    strength: float = np.inf
    plastic_elongation: float = 0.0

    @property
    def yield_stretch(self) -> float:
        """u at which it reaches its strength, m."""
        if np.isinf(self.strength):
            return np.inf
        return (self.strength - self.pretension) / self.stiffness

    @property
    def rupture_stretch(self) -> float:
        """u beyond which it is broken, m."""
        return self.yield_stretch + self.plastic_elongation

    def over(self, unit: float) -> "Tie":
        """The same tie with its forces in multiples of `unit`."""
        return replace(
            self,
            stiffness=self.stiffness / unit,
            pretension=self.pretension / unit,
            strength=self.strength / unit,
        )

    def tension(self, stretch: np.ndarray, largest: np.ndarray | None = None) -> np.ndarray:
        """The force at u = `stretch`, where u was `largest` at most before; None: never beyond `stretch`."""
        elastic = self.pretension + self.stiffness * stretch
        if np.isinf(self.strength):
            return elastic
        largest = stretch if largest is None else np.maximum(stretch, largest)
        plastic = np.maximum(largest - self.yield_stretch, 0.0)
        force = np.clip(elastic - self.stiffness * plastic, 0.0, self.strength)
        return np.where(largest > self.rupture_stretch, 0.0, force)

    def slope(self, stretch: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
        """Derivative of T du/dφ with φ, from those of u; beyond yield that of the force it keeps."""
        stiffness = np.where(stretch <= self.yield_stretch, self.stiffness, 0.0)
        return self.tension(stretch) * acceleration + stiffness * velocity**2


@dataclass(frozen=True)
class SideTie:
    """A tie on one side of a mechanism: u [m] and du/dφ as functions of the rotation, which grow with it.

    The forces of `tie` are in the unit of the side's G per m, so that the tie adds T(u) du/dφ to G.
    """

    tie: Tie
    stretch: Function
    stretch_slope: Function

    def moment(self, rotation: np.ndarray, largest: np.ndarray) -> np.ndarray:
        """Return what it adds to G at `rotation`, the largest rotation so far being `largest` [rad]."""
        force = self.tie.tension(self.stretch(rotation), self.stretch(largest))
        return force * self.stretch_slope(rotation)

    def bends(self, end_rotation: float) -> list[float]:
        """Return the rotations below `end_rotation` at which it yields and breaks, rad."""
        stretches = self.tie.yield_stretch, self.tie.rupture_stretch
        bends = [self.rotation(stretch, end_rotation) for stretch in stretches]
        return [bend for bend in bends if bend < np.inf]

    def rotation(self, stretch: float, end_rotation: float) -> float:
        """Return the rotation [rad] at which u is `stretch`; inf beyond `end_rotation`."""
        from scipy.optimize import brentq  # slow to import, and needed by ties with a strength only

        def beyond(rotation: float) -> float:
            return float(self.stretch(np.asarray(rotation))) - stretch

        if stretch <= 0:
            return 0.0
        if not beyond(end_rotation) > 0:
            return np.inf
        return float(brentq(beyond, 0.0, end_rotation, xtol=1e-18, rtol=1e-15))
