"""Two bodies of a wall that bulge between a foot and a held point above them (theory: section 12.3)."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rocking.structures.linkage import (
    Contacts,
    Hung,
    Linkage,
    Motion,
    MotionState,
    Parts,
    UnknownContacts,
    cross,
    keeps_last,
)

_MARGIN = 0.9
"""Share of the reach of either body that the motion may use: where one of them lies flat the linkage locks."""


class Chain(Linkage):
    """A lower body that turns about its foot, an upper one hinged to it, and perhaps one that stays upright on top.

    hinges: of the lower body on what stands still, and between the two bodies. held: the point of the upper body that
    only moves up and down; None: the upper body does not turn, and moves with its hinge. bodies: (k,) the body of each
    part: 0 the lower one, 1 the upper one, 2 what stays upright and rises with `held`, about which the upper body turns
    against it. forwards: whether the lower body turns towards the side of rocking; it kicks back where it does not.
    guided: whether the loads move up and down only.
    """

    def __init__(
        self,
        hinges: tuple[complex, complex],
        held: complex | None,
        parts: Parts,
        hung: Sequence[Hung] = (),
        *,
        bodies: Sequence[int] = (0, 1),
        forwards: bool = True,
        guided: bool = False,
    ) -> None:
        self._foot, self._hinge = hinges
        self._is_held = held is not None
        self._held = self._hinge + 1j if held is None else held
        self._lower = self._hinge - self._foot
        self._upper = self._held - self._hinge
        self._turn = -1.0 if forwards else 1.0
        self._guided = guided
        self._hang(parts, hung)
        self._bodies = np.array([*bodies, *(bodies[each.part] for each in self.loads)])
        self.unit = float(self.masses.sum())

        # Neither arm may come to lie flat; from the reach of the upper one follows how far the lower one may lean.
        reach = abs(self._upper)
        across = self._upper.real
        if forwards:
            farthest = min(-_MARGIN * reach, across - _MARGIN * (reach + across))
        else:
            farthest = max(_MARGIN * reach, across + _MARGIN * (reach - across))
        if not self._is_held:
            farthest = self._turn * np.inf
        lean = (self._lower.real + across - farthest) / abs(self._lower)
        lying = np.arccos(np.clip(lean, -_MARGIN, _MARGIN))
        self.end_rotation = float(min(abs(lying - np.angle(self._lower)), np.pi / 2))

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Motion:
        """Return the bodies at `rotation` ≥ 0, any shape; hinges at the foot, between the bodies and where it is held.

        With arms l₀ and l₁ turned by a₀ = ∓φ and a₁, Re(l₀ + l₁) stays what it is at rest; a₁ = 0 where none is held.
        """
        lower = self._lower * np.exp(1j * self._turn * rotation)
        # Re l₀ moves by −2 Im(…) of the half angle, without cancellation
        shift = (
            self._is_held
            * (
                2j * self._lower * np.sin(self._turn * rotation / 2) * np.exp(0.5j * self._turn * rotation)
            ).real
        )
        across = self._upper.real - shift
        up = np.sqrt(self._upper.imag**2 + shift * (self._upper.real + across))
        upper = across + 1j * up
        angle = np.angle(upper * self._upper.conjugate())
        spin = -self._is_held * self._turn * lower.imag / up
        bend = -self._is_held * (lower.real + spin**2 * across) / up

        hinge = self._foot + lower
        held = hinge + upper
        one = np.ones_like(up)
        turning = 1j * self._turn
        rolling = 1j * bend - spin**2
        turns = np.array([self._turn * rotation * one, angle, 0 * one])
        spins = np.array([self._turn * one, spin, 0 * one])
        slopes = np.array([0 * one, bend, 0 * one])
        moved = np.array([0 * lower, hinge - self._hinge, 1j * (held - self._held).imag])
        velocities = np.array([0 * lower, turning * lower, 1j * (turning * lower + 1j * spin * upper).imag])
        accelerations = np.array([0 * lower, -lower, 1j * (-lower + rolling * upper).imag])

        of = self._bodies
        fixed = np.array([self._foot, self._hinge, self._held])[of]
        arms = (self.rest - fixed).reshape(-1, *(1,) * one.ndim) * np.exp(1j * turns[of])
        motion = Motion(
            hinges=np.array([self._foot + 0 * lower, hinge, held]),
            angles=turns[of],
            spins=spins[of],
            spin_slopes=slopes[of],
            centroids=fixed.reshape(-1, *(1,) * one.ndim) + moved[of] + arms,
            velocities=velocities[of] + 1j * spins[of] * arms,
            accelerations=accelerations[of] + (1j * slopes[of] - spins[of] ** 2) * arms,
        )
        return self._guided_loads(motion) if self._guided and self.loads else motion

    def _guided_loads(self, motion: Motion) -> Motion:
        """The motion where the loads, which are its last parts, rise with their bearings and move to no side."""
        loads = slice(-len(self.loads), None)
        centroids, velocities, accelerations = (
            each.copy() for each in (motion.centroids, motion.velocities, motion.accelerations)
        )
        starts = self.rest[loads].reshape(-1, *(1,) * (centroids.ndim - 1))
        centroids[loads] = starts.real + 1j * centroids[loads].imag
        velocities[loads] = 1j * velocities[loads].imag
        accelerations[loads] = 1j * accelerations[loads].imag
        return replace(motion, centroids=centroids, velocities=velocities, accelerations=accelerations)

    def contacts(self, state: MotionState) -> Contacts:
        """Return the contact forces at foot and hinge, per mass of all that moves."""
        motion, forces, _, above = self._balanced(state)
        at_hinge = -(forces[1] + above)
        thrusts = np.stack([at_hinge - forces[0], at_hinge]) / self.unit
        upper = int(np.argmax(self._bodies == 1))
        joint = 1j * np.exp(1j * (motion.angles[0] + motion.angles[upper]) / 2)
        return Contacts.resolved(("foot", "hinge"), thrusts, np.stack([1j + 0 * joint, joint]))

    def holding(self, state: MotionState, stop: float | None = None) -> np.ndarray:
        """Return the forces that hold it back sideways, (2, k), in the unit of the masses times m/s².

        At the point that is held, and at the height `stop` [m] of the body that stays upright on top, where something
        keeps it from turning; 0 there without such a body. Against the side of rocking positive.
        """
        motion, forces, couple, above = self._balanced(state)
        turned_back = np.zeros_like(couple)
        if stop is not None and (self._bodies == 2).any():
            turned_back = -couple / (stop - motion.hinges[2].imag)
        return np.stack([forces[2].real - above.real - turned_back, turned_back])

    def _balanced(self, state: MotionState) -> tuple[Motion, list[np.ndarray], np.ndarray, np.ndarray]:
        """The motion, the forces on the three bodies, the couple on the third about what is held, and the force on the
        upper body there.

        What holds the upper body gives a horizontal force alone, which follows from its balance about the hinge.
        """
        if not self._is_held:
            raise UnknownContacts("the couple by which the slab keeps the wall upright is not known.")
        motion = self.motion(state.rotation)
        forces, couples = self.dalembert(state)
        places = motion.centroids.copy()
        if self._guided:
            for place, each in enumerate(self.loads, start=forces.shape[0] - len(self.loads)):
                forces[place] = 1j * forces[place].imag  # the floor holds them sideways
                places[place] = each.start + self.carried(each.part, each.start, motion).moved
        _, hinge, held = motion.hinges
        on_body = [forces[self._bodies == body].sum(axis=0) for body in range(3)]

        def about(point: np.ndarray, body: int) -> np.ndarray:
            own = self._bodies == body
            result: np.ndarray = (cross(places[own] - point, forces[own]) + couples[own]).sum(axis=0)
            return result

        carried = 1j * on_body[2].imag
        moment = about(hinge, 1) + cross(held - hinge, carried)
        above = carried + moment / (held - hinge).imag
        return motion, on_body, about(held, 2), above
