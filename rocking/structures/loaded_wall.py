"""The wall between two supports with a load on top of it and ties on its outer face (theory: section 4).

x is measured from the middle of the wall, outwards (to the right) positive; the positive side bends outwards.
"""

from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.attachments import Attached, ConstantForce, LoadedForm
from rocking.structures.bars import Bodies, carried
from rocking.structures.contacts import Contacts, MotionState, on_side
from rocking.structures.drawing import Mark, Path, span
from rocking.structures.fields import (
    ONE_SIDED,
    Form,
    flag_field,
    length_field,
    number_field,
    restitution_field,
)
from rocking.structures.load_fields import (
    ECCENTRICITY,
    TOP_SLAB,
    UNIT_WEIGHT,
    check_eccentricity,
)
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.restitution import Restitution, momentum_balance, resolve_restitution
from rocking.structures.structure import Structure
from rocking.structures.tie_fields import Tied, tie_fields
from rocking.structures.ties import PointMotion, Tie
from rocking.structures.wall import Applied, Wall
from rocking.structures.wall_linkage import WallLinkage


@dataclass(frozen=True)
class OnBlock:
    """The path of a point fixed to a block of a wall (0 lower, 1 upper); `start`: where it is at rest, complex, m."""

    linkage: WallLinkage
    block: int
    start: complex

    def __call__(self, rotation: np.ndarray) -> PointMotion:
        """Return its motion at `rotation` [rad], any shape."""
        return PointMotion(*carried(self.linkage.bars, self.linkage.motion(rotation), self.block, self.start))


@dataclass(frozen=True, repr=False)
class LoadedWall(Tied):
    """A wall cracked into two blocks between supports, as `Wall`, with what hangs on it; forces per metre of wall.

    lower_height, upper_height, thickness: m. unit_weight: of the masonry, N/m³. top_load: of floor or walls above,
    N/m, at `eccentricity` inwards from the middle, m, on a "hinged" bearing, or by a slab that stays "flat" and rests
    on the edge in contact. load_held: only its weight acts; otherwise its mass moves up and down with the top.
    restitution: η in [0, 1] or "momentum" (the default). Ties and one_sided: as `Tied`.
    Raises StructureError when it cannot stand.
    """

    type_name: ClassVar[str] = "loaded_wall"
    moved: ClassVar[str] = "hinge height"
    forms: ClassVar[tuple[Form, ...]] = (
        Form(
            "Wall between supports with a load on top and ties; forces per metre of wall",
            (
                length_field("height", "Height between the supports", 3.2, (0.5, 60), "h"),
                length_field("hinge_height", "Height of the hinge above the base", 1.9, (0.2, 57), "h₁"),
                length_field("thickness", "Thickness", 0.25, (0.05, 5), "t"),
                UNIT_WEIGHT,
                number_field("top_load", "Load on top of the wall", "kN/m", 10.0, (0, 500), "N"),
                ECCENTRICITY,
                TOP_SLAB,
                flag_field(
                    "load_held",
                    "Whether only the weight of the load acts, not its mass",
                    "load that does not move",
                ),
                *tie_fields(1.6, 50.0),
                restitution_field("momentum"),
                ONE_SIDED,
            ),
            make="hinged_at",
        ),
    )

    lower_height: float
    upper_height: float
    thickness: float
    unit_weight: float
    top_load: float = 0.0
    eccentricity: float = 0.0
    top_slab: Literal["hinged", "flat"] = "hinged"
    load_held: bool = False
    restitution: Restitution = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("lower_height", "upper_height", "thickness"):
            object.__setattr__(self, name, getattr(self.wall, name))
        check_eccentricity(self.eccentricity, self.thickness)
        self._check_ties(self.height)
        self.mechanism()  # one that its load pushes over is refused at birth

    @classmethod
    def hinged_at(
        cls,
        height: float,
        hinge_height: float,
        thickness: float,
        unit_weight: float,
        **options: float | tuple[float, ...] | str | None,
    ) -> "LoadedWall":
        """Return the wall of that total height whose hinge lies at `hinge_height` [m]; options as for the class."""
        wall = Wall.hinged_at(height, hinge_height, thickness, 0.5)
        return cls(wall.lower_height, wall.upper_height, thickness, unit_weight, **options)  # type: ignore[arg-type]

    @cached_property
    def wall(self) -> Wall:
        """The wall alone."""
        return Wall(self.lower_height, self.upper_height, self.thickness, self.restitution, self.one_sided)

    @property
    def height(self) -> float:
        """h₁ + h₂, m."""
        return self.wall.height

    @property
    def hinge_height(self) -> float:
        """h₁, m."""
        return self.lower_height

    @property
    def weight(self) -> float:
        """Of the masonry, N/m."""
        return self.unit_weight * self.height * self.thickness

    def _bearing(self, mirrored: bool) -> complex:
        """Where the load rests, on the side seen."""
        if self.top_slab == "flat":
            return complex(self.thickness / 2, self.height)
        return complex(self.eccentricity if mirrored else -self.eccentricity, self.height)

    def attached(self, mirrored: bool = False) -> tuple[Attached, ...]:
        """Return what hangs on the wall on one side, in units of its weight times R₁."""
        linkage, unit = self.wall.linkage, self.weight * self.wall.linkage.lower_diagonal
        found = []
        if self.top_load:
            path, load = OnBlock(linkage, 1, self._bearing(mirrored)), self.top_load / unit
            moving = Attached(path, None, load, sideways=False)
            found.append(Attached(path, ConstantForce(-1j * load)) if self.load_held else moving)
        if mirrored or not (self.tie_stiffness or self.tie_pretension):
            return tuple(found)
        tie = self._tie(unit)
        for height in self.tie_heights:
            block = 0 if height <= self.lower_height else 1
            found.append(Attached(OnBlock(linkage, block, complex(self.thickness / 2, height)), tie))
        return tuple(found)

    def _form(self, mirrored: bool) -> LoadedForm:
        linkage = self.wall.linkage
        bare = (
            linkage.inertia,
            linkage.inertia_slope,
            linkage.gravity,
            linkage.gravity_slope,
            linkage.ground,
        )
        return LoadedForm(bare, self.attached(mirrored), 1.0)

    def _side(self, mirrored: bool) -> Side:
        restitution = resolve_restitution(
            self.restitution, "momentum", lambda: self._momentum_balance(mirrored)
        )
        return self._form(mirrored).side(self.wall.linkage.end_rotation, restitution)

    def _build(self) -> Mechanism:
        tied = bool(self.tie_heights) and bool(self.tie_stiffness or self.tie_pretension)
        outward = self._side(mirrored=False)
        if self.one_sided:
            return Mechanism(outward, one_sided=True)
        if not tied and (self.eccentricity == 0 or self.top_slab == "flat" or not self.top_load):
            return Mechanism(outward)
        return Mechanism(outward, self._side(mirrored=True))

    def _momentum_balance(self, mirrored: bool) -> float:
        """That of the wall with the load's mass, which moves up and down only."""
        masses, inertias, before, after = self.wall.impact()
        if self.top_load and not self.load_held:
            rises = [
                float(OnBlock(self.wall.linkage, 1, self._bearing(side))(np.asarray(0.0)).velocity.imag)
                for side in (mirrored, not mirrored)
            ]
            masses = np.append(masses, self.top_load / (self.unit_weight * self.thickness))
            inertias = np.append(inertias, 0.0)
            before = np.vstack([before, [0.0, rises[0], 0.0]])
            after = np.vstack([after, [0.0, -rises[1], 0.0]])
        return momentum_balance(masses, inertias, before, after)

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        found = self.wall.bodies(rotation)
        if not self.top_load or self.load_held:
            return found
        bearing = self._bearing(mirrored=False)
        risen = OnBlock(self.wall.linkage, 1, bearing)(np.asarray(rotation, dtype=float)).moved.imag
        return Bodies(
            np.append(found.masses, self.top_load / self.weight),
            np.append(found.inertias, 0.0),
            np.concatenate([found.centres, np.asarray(bearing + 1j * risen)[None]]),
            np.concatenate([found.turns, 0 * np.asarray(risen)[None]]),
        )

    def held_work(self, rotation: float | np.ndarray) -> np.ndarray:
        work = self._form(mirrored=False).held_work(np.asarray(rotation, dtype=float))
        return work * self.wall.linkage.lower_diagonal

    def contacts(self, state: MotionState) -> Contacts:
        sides = [
            self.wall.contacts_under(state, self._applied(state, mirrored)) for mirrored in (False, True)
        ]
        return on_side(state, *sides)

    def _applied(self, state: MotionState, mirrored: bool) -> Iterable[Applied]:
        """What hangs on the wall as forces on its blocks, per mass of the wall."""
        factor = self.wall.linkage.lower_diagonal
        for each in self.attached(mirrored):
            assert isinstance(each.path, OnBlock)
            point = each.path(state.rotation)
            if isinstance(each.force, Tie):
                tension = each.force.tension(point.moved.real, each.path(state.largest).moved.real)
                force = -tension * GRAVITY + 0j
            elif isinstance(each.force, ConstantForce):
                force = each.force.vector * state.pull.imag
            else:
                rise = point.velocity.imag * state.acceleration + point.acceleration.imag * state.velocity**2
                force = -1j * each.mass * (rise + state.pull.imag)
            yield each.path.block, each.path.start + point.moved, force * factor

    def tie_stretches(self, rotation: float) -> dict[float, float]:
        return {
            each.path.start.imag: float(each.path(np.asarray(max(rotation, 0.0))).moved.real)
            for each in self.attached()
            if isinstance(each.force, Tie) and isinstance(each.path, OnBlock)
        }

    def candidate_positions(self, count: int) -> np.ndarray:
        return self.wall.candidate_positions(count)

    def candidates(self, positions: Iterable[float]) -> "dict[float, Structure]":
        """Return this wall hinged at each of `positions` [m] above the base instead, by height.

        A height at which its ties let it find no unstable equilibrium is left out.
        """
        found: dict[float, Structure] = {}
        for z in map(float, positions):
            with suppress(StructureError):
                found[z] = replace(self, lower_height=z, upper_height=self.height - z)
        return found

    def _outline(self, rotation: float) -> list[np.ndarray]:
        return self.wall._outline(rotation)

    def _hinges(self, rotation: float) -> np.ndarray:
        return self.wall._hinges(rotation)

    def _mirrored(self) -> "Structure":
        return self.wall

    def _dimensions(self) -> dict[str, Path]:
        drawn = self.wall._dimensions()
        if self.eccentricity and self.top_load and self.top_slab == "hinged":
            bearing = [-self.eccentricity, self.height]
            drawn["eccentricity"] = span([0.0, self.height], bearing, [0.0, -0.03 * self.height])
        return drawn

    def marks(self, rotation: float = 0.0) -> tuple[Mark, ...]:
        size, flip = 0.15 * self.height, np.array([-1.0 if rotation < 0 else 1.0, 1.0])

        def line(block: int, start: complex, tail: complex) -> np.ndarray:
            point = start + OnBlock(self.wall.linkage, block, start)(np.asarray(abs(rotation))).moved
            return np.array([[each.real, each.imag] for each in (point + tail, point)]) * flip

        drawn = []
        if self.top_load:
            text = f"{self.top_load / 1e3:.6g} kN/m"
            drawn.append(Mark("load", text, line(1, self._bearing(rotation < 0), 1j * size)))
        for height in self.tie_heights if rotation >= 0 else ():
            block = 0 if height <= self.lower_height else 1
            tail = complex(-self.thickness - 3 * size, 0.0)
            drawn.append(Mark("tie", self._tie_text, line(block, complex(self.thickness / 2, height), tail)))
        return tuple(drawn)
