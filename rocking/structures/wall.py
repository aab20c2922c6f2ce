"""The masonry wall that bends out of plane about a hinge at any height (Fig. 2; theory: section 4)."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import finite, length
from rocking.structures.bars import Bodies, cross
from rocking.structures.contacts import Contacts, MotionState, dalembert, resolved
from rocking.structures.drawing import Path, plane, rectangle, span, turned
from rocking.structures.fields import ONE_SIDED, Form, length_field, restitution_field
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.restitution import Restitution, momentum_balance, resolve_restitution
from rocking.structures.structure import HIGHEST_SHARE, Structure
from rocking.structures.wall_linkage import WallLinkage

Applied = tuple[int, np.ndarray, np.ndarray]
"""A force on a block (0 lower, 1 upper): where it acts and what it is, (k,) complex each."""

_THICKNESS = length_field("thickness", "Thickness", 0.25, (0.05, 5), "t")


@dataclass(frozen=True)
class Wall(Structure):
    """A wall cracked into two blocks; base and top follow the ground, the top support slides vertically.

    lower_height, upper_height: h₁ below and h₂ above the hinge, m. thickness: 2b, m. The rotation φ is the
    lower block's. restitution: η in [0, 1] or "momentum" (the default): the impulses at the hinges of the
    mirrored mechanism do no work on it. For equal blocks that is (1 − 4.5 sin²α)/(1 + 3 sin²α), which
    reaches 0 at sin²α = 2/9; squatter walls get 0 and a StructureWarning. one_sided: it leans on cross walls and bends
    outwards only, thrown back at every impact; it needs a number.
    Raises StructureError when it cannot stand.
    """

    type_name: ClassVar[str] = "wall"
    moved: ClassVar[str] = "hinge height"
    forms: ClassVar[tuple[Form, ...]] = (
        Form(
            "Wall by its height and that of its hinge",
            (
                length_field("height", "Height between the supports", 3.2, (0.5, 60), "h"),
                length_field("hinge_height", "Height of the hinge above the base", 1.6, (0.2, 57), "h₁"),
                _THICKNESS,
                restitution_field("momentum"),
                ONE_SIDED,
            ),
            make="hinged_at",
        ),
        Form(
            "Wall by the heights below and above its hinge",
            (
                length_field("lower_height", "Height below the hinge", 2.0, (0.2, 57), "h₁"),
                length_field("upper_height", "Height above the hinge", 1.5, (0.1, 57), "h₂"),
                _THICKNESS,
                restitution_field("momentum"),
                ONE_SIDED,
            ),
        ),
    )

    lower_height: float
    upper_height: float
    thickness: float
    restitution: Restitution = None
    one_sided: bool = False

    @classmethod
    def hinged_at(
        cls,
        height: float,
        hinge_height: float,
        thickness: float,
        restitution: Restitution = None,
        one_sided: bool = False,
    ) -> "Wall":
        """Return the wall of that total height whose hinge lies at `hinge_height` [m] above the base."""
        height = length("height", height)
        hinge = finite(StructureError, "hinge_height", hinge_height, "m")
        if not 0 < hinge < height:
            raise StructureError(
                f"hinge_height is {hinge!r} m, but must lie inside the wall, "
                f"between 0 and its height of {height!r} m."
            )
        return cls(hinge, height - hinge, thickness, restitution, one_sided)

    @property
    def height(self) -> float:
        """h₁ + h₂, m."""
        return self.lower_height + self.upper_height

    @property
    def hinge_height(self) -> float:
        """h₁, m."""
        return self.lower_height

    def _build(self) -> Mechanism:
        linkage = self.linkage
        return Mechanism(
            Side(
                inertia=linkage.inertia,
                inertia_slope=linkage.inertia_slope,
                gravity=linkage.gravity,
                gravity_slope=linkage.gravity_slope,
                ground=linkage.ground,
                critical_rotation=linkage.slenderness,
                end_rotation=linkage.end_rotation,
                restitution=resolve_restitution(
                    self.restitution, "momentum", lambda: momentum_balance(*self.impact())
                ),
            ),
            one_sided=self.one_sided,
        )

    @cached_property
    def linkage(self) -> WallLinkage:
        """The two blocks as a linkage on the side of positive rotation."""
        return WallLinkage(self.lower_height, self.upper_height, self.thickness)

    def impact(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return what `momentum_balance` takes: the mirrored mechanism continues the same turn.

        Velocities (vx, vy, clockwise ω) at φ = 0.
        """
        h1, h2, t = self.lower_height, self.upper_height, self.thickness
        ratio = h1 / h2
        lower = [h1 / 2, t / 2, 1.0]
        upper = [h1 / 2, t + ratio * t / 2, -ratio]
        inertias = [h1 * (h1**2 + t**2) / 12, h2 * (h2**2 + t**2) / 12]
        before = np.array([lower, upper])
        return np.array([h1, h2]), np.array(inertias), before, before * [1.0, -1.0, 1.0]

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        bars, motion = self.linkage.bars, self.linkage.motion(rotation)
        return Bodies(bars.masses, bars.inertias, motion.centroids, motion.angles)

    def contacts(self, state: MotionState) -> Contacts:
        return self.contacts_under(state, ())

    def contacts_under(self, state: MotionState, loads: Iterable[Applied]) -> Contacts:
        """Return the contact forces with more forces on the blocks, per mass of the wall.

        The top support carries no vertical force: the thrust at the hinge follows from the upper block alone.
        """
        motion = self.linkage.motion(state.rotation)
        forces, couples = dalembert(self.linkage.bars, motion, state, state.pull)
        for body, point, force in loads:
            forces[body] += force
            couples[body] += cross(point - motion.centroids[body], force)
        _, hinge, top = motion.hinges
        turning = cross(motion.centroids[1] - top, forces[1]) + couples[1]
        arm = hinge - top
        across = (arm.real * -forces[1].imag + turning) / arm.imag
        at_hinge = across - 1j * forces[1].imag
        joint = 1j * np.exp(1j * (motion.angles[0] + motion.angles[1]) / 2)
        return resolved(
            ("base", "hinge"), np.stack([at_hinge - forces[0], at_hinge]), np.stack([1j + 0 * joint, joint])
        )

    def candidate_positions(self, count: int) -> np.ndarray:
        """Hinge heights that stay a share of the height away from base and top."""
        return self.height * np.linspace(1 - HIGHEST_SHARE, HIGHEST_SHARE, count)

    def candidates(self, positions: Iterable[float]) -> "dict[float, Structure]":
        """Return this wall hinged at each of `positions` [m] above the base instead, by height."""
        heights, given = map(float, positions), (self.thickness, self.restitution, self.one_sided)
        walls = {z: Wall.hinged_at(self.height, z, *given) for z in heights}
        return {z: replace(wall, restitution_range=self.restitution_range) for z, wall in walls.items()}

    def _outline(self, rotation: float) -> list[np.ndarray]:
        half, psi = self.thickness / 2, self.linkage.motion(rotation).angles[1]
        base, hinge, _ = self._hinges(rotation)
        lower = rectangle(-half, half, 0.0, self.lower_height)
        upper = hinge + rectangle(0.0, 2 * half, 0.0, self.upper_height)
        return [turned(lower, base, rotation), turned(upper, hinge, -psi)]

    def _hinges(self, rotation: float) -> np.ndarray:
        """Right corner of the base, left edge at the hinge, right corner of the top."""
        return plane(self.linkage.motion(rotation).hinges)

    def _dimensions(self) -> dict[str, Path]:
        half, crack, top, apart = self.thickness / 2, self.lower_height, self.height, 0.06 * self.height
        left, right = np.array([-apart, 0.0]), np.array([apart, 0.0])
        return {
            "height": span([-half, 0.0], [-half, top], left),
            "hinge_height": span([half, 0.0], [half, crack], right),
            "lower_height": span([half, 0.0], [half, crack], right),
            "upper_height": span([half, crack], [half, top], right),
            "thickness": span([-half, top], [half, top], [0.0, apart]),
        }
