"""Masses that turn as one about a toe, with weights, thrusts and ties on them; the toe is the origin of the plane."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from rocking.quantities import GRAVITY
from rocking.structures.attachments import Attached, ConstantForce, LoadedForm
from rocking.structures.bars import Bodies
from rocking.structures.contacts import Contacts, MotionState, corner
from rocking.structures.mechanism import Side
from rocking.structures.ties import PointMotion, Tie


class Held(NamedTuple):
    """What hangs on a body at a `point` (at rest, complex, m): a `force`, or a weight `mass` that moves along."""

    point: complex
    force: ConstantForce | Tie | None
    mass: float = 0.0


@dataclass(frozen=True)
class Turning:
    """The path of a point that turns clockwise about the origin; `start`: where it is at rest."""

    start: complex

    def __call__(self, rotation: np.ndarray) -> PointMotion:
        """Return its motion at `rotation` [rad], any shape."""
        turn = np.exp(-1j * np.asarray(rotation, dtype=float))
        # e^(−iφ) − 1 without cancellation
        moved = -2j * np.sin(np.asarray(rotation) / 2) * np.exp(-0.5j * np.asarray(rotation))
        return PointMotion(self.start * moved, -1j * self.start * turn, -self.start * turn)


@dataclass(frozen=True, eq=False)
class TurningBody:
    """weights (k,), centres (k,) complex and inertias (k,) about them (weight times m²) of rigid parts; what is held.

    The centre of mass lies to the left of the toe, above it; it turns clockwise, to the right.
    """

    weights: np.ndarray
    centres: np.ndarray
    inertias: np.ndarray
    held: tuple[Held, ...]

    @cached_property
    def masses(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Weights, centres and inertias of all that moves, the masses held among them."""
        moving = [each for each in self.held if each.mass]
        return (
            np.append(self.weights, [each.mass for each in moving]),
            np.append(self.centres, [each.point for each in moving]),
            np.append(self.inertias, np.zeros(len(moving))),
        )

    @cached_property
    def form(self) -> LoadedForm:
        """I, I', G, G' and B, divided by the static moment |Σ W r| of the moving masses about the toe."""
        weights, centres, inertias = self.masses
        moment = complex(weights @ centres)
        size, slenderness = abs(moment), float(np.arctan2(-moment.real, moment.imag))
        inertia = float(inertias.sum() + weights @ np.abs(centres) ** 2)
        bare = (
            lambda phi: np.full_like(phi, inertia, dtype=float),
            lambda phi: np.zeros_like(phi, dtype=float),
            lambda phi: size * np.sin(slenderness - phi),
            lambda phi: -size * np.cos(slenderness - phi),
            lambda phi: size * np.cos(slenderness - phi),
        )
        forces = tuple(Attached(Turning(each.point), each.force) for each in self.held if each.force)
        return LoadedForm(bare, forces, size)

    def side(self, restitution: float) -> Side:
        """Return the side of rocking about the toe, until the body lies."""
        return self.form.side(np.pi / 2, restitution)

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        """Return all that moves; see Structure.bodies."""
        weights, centres, inertias = self.masses
        turn = np.exp(-1j * np.asarray(rotation, dtype=float))
        places = np.multiply.outer(centres, turn)
        return Bodies(weights, inertias, places, -np.asarray(rotation) + 0 * places.real)

    def impact_on(self, other: "TurningBody") -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return what `momentum_balance` takes of the impact from this toe to that of `other`, the mirror image."""
        weights, centres, inertias = self.masses
        arriving, leaving = -1j * centres, 1j * other.masses[1].conj()
        spins = -np.ones(weights.size)
        before, after = (np.stack([speed.real, speed.imag, spins], axis=1) for speed in (arriving, leaving))
        return weights, inertias, before, after

    def contacts(self, state: MotionState) -> Contacts:
        """Return the force at the toe, per mass of all that moves; ties pull back, weights press, thrusts push."""
        weights, centres, _ = self.masses
        total = weights.sum()
        centre = complex(weights @ centres) / total
        found = corner(-centre.real, centre.imag, state)
        pressed, pushed = np.zeros(state.rotation.shape), np.zeros(state.rotation.shape)
        for each in self.held:
            if isinstance(each.force, ConstantForce):
                pressed = pressed - each.force.vector.imag / total * state.pull.imag
                pushed = pushed - each.force.vector.real / total * state.pull.imag
            elif isinstance(each.force, Tie):
                path = Turning(each.point)
                tension = each.force.tension(path(state.rotation).moved.real, path(state.largest).moved.real)
                pushed = pushed + tension / total * GRAVITY
        return Contacts(found.names, found.normal + pressed, found.tangential + pushed)
