"""The masonry wall that bends out of plane about a hinge at any height (Fig. 2; theory: section 4), loads and ties.

x is measured from the middle of the wall, outwards (to the right) positive; the positive side bends outwards.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureError
from rocking.quantities import finite
from rocking.structures.bodies import (
    Bars,
    Bodies,
    Contacts,
    LinkedBars,
    Motion,
    MotionState,
    Restitution,
    carried,
    cross,
    dalembert,
    keeps_last,
    momentum_balance,
    on_side,
    resolve_restitution,
    resolved,
)
from rocking.structures.drawing import Mark, Path, plane, rectangle, span, turned
from rocking.structures.fields import OneSided, Value, length, restitution_value
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.structure import HIGHEST_SHARE, Crackable, Structure
from rocking.structures.tied import (
    Eccentricity,
    Tied,
    TopSlab,
    UnitWeight,
    check_eccentricity,
    loaded_side,
)
from rocking.structures.ties import Attached, ConstantForce, LoadedForm, PointMotion, Tie

_LINKAGE_MARGIN = 0.9
"""Share of the reach of the shorter half that the motion may use: the linkage locks at 1, where ψ' is
infinite, and by 0.9 the hinge has moved so far past the upright position that the wall has fallen."""


class WallLinkage(LinkedBars):
    """The two blocks of a wall, per mass of the wall."""

    def __init__(self, lower_height: float, upper_height: float, thickness: float) -> None:
        self.slenderness = float(np.arctan2(thickness, lower_height))
        self._upper_slenderness = np.arctan2(thickness, upper_height)
        self._half_thickness = thickness / 2
        self._lower_half = lower_height / 2
        self._upper_half = upper_height / 2
        heights = np.array([lower_height, upper_height])
        diagonals = np.hypot(heights, thickness) / 2
        masses = heights / heights.sum()
        self.bars = Bars(masses, self.motion(0.0).centroids, masses * diagonals**2 / 3)
        reach = min(1.0, diagonals[1] / diagonals[0])
        lying = np.pi / 2
        self.end_rotation = float(min(lying, self.slenderness + np.arcsin(_LINKAGE_MARGIN * reach)))

    def _position(self, rotation: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """S and C of the lower half diagonal, ψ' and ψ''."""
        sine, cosine = np.sin(rotation), np.cos(rotation)
        across = self._half_thickness * cosine - self._lower_half * sine
        up = self._lower_half * cosine + self._half_thickness * sine
        # R₂² − S² = (h₂/2)² + (b − S)(b + S), without the cancellation of a flat upper block
        moved = 2 * self._half_thickness * np.sin(np.asarray(rotation) / 2) ** 2 + self._lower_half * sine
        upper_up = np.sqrt(self._upper_half**2 + moved * (self._half_thickness + across))
        ratio = up / upper_up
        return across, up, ratio, across * (1 - ratio**2) / upper_up

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Motion:
        """Return the blocks at `rotation` ≥ 0, any shape; hinges at the base, between the blocks and at the top.

        The lower block turns clockwise about its right bottom corner, the upper one back about the left edge.
        """
        across, up, ratio, curvature = self._position(rotation)
        lower, upper = -across + 1j * up, across + 1j * up / ratio
        base = self._half_thickness + np.zeros_like(lower)
        psi = self._upper_slenderness - np.arctan2(upper.real, upper.imag)
        one = np.ones_like(across)
        return Motion(
            hinges=np.stack([base, base + 2 * lower, base + 2 * lower + 2 * upper]),
            angles=np.stack([-np.asarray(rotation) * one, psi]),
            spins=np.stack([-one, ratio]),
            spin_slopes=np.stack([0 * one, curvature]),
            centroids=np.stack([base + lower, base + 2 * lower + upper]),
            velocities=np.stack([-1j * lower, -2j * lower + 1j * ratio * upper]),
            accelerations=np.stack([-lower, -2 * lower + (1j * curvature - ratio**2) * upper]),
        )


Applied = tuple[int, np.ndarray, np.ndarray]
"""A force on a block (0 lower, 1 upper): where it acts and what it is, (k,) complex each."""

Height = Annotated[float, length("Height between the supports", 3.2, (0.5, 60), "h")]
HingeHeight = Annotated[
    float | None,
    length("Height of the hinge above the base; left out: where statics puts it", 1.6, (0.2, 57), "h₁"),
]
Thickness = Annotated[float, length("Thickness", 0.25, (0.05, 5), "t")]
Balanced = Annotated[Restitution, restitution_value("momentum")]


@dataclass(frozen=True)
class Wall(Crackable):
    """A wall cracked into two blocks; base and top follow the ground, the top support slides vertically.

    lower_height, upper_height: h₁ below and h₂ above the hinge, m. thickness: 2b, m. The rotation φ is the
    lower block's. restitution: η in [0, 1] or "momentum" (the default): the impulses at the hinges of the
    mirrored mechanism do no work on it. For equal blocks that is (1 − 4.5 sin²α)/(1 + 3 sin²α), which
    reaches 0 at sin²α = 2/9; squatter walls get 0 and a StructureWarning. one_sided: it leans on cross walls and bends
    outwards only, thrown back at every impact; it needs a number.
    Raises StructureError when it cannot stand.

    >>> rocking.Wall(lower_height=1.6, upper_height=1.6, thickness=0.25).mechanism()
    Mechanism(λ = 0.3125, φ_cr = 0.155 rad, p = 4.262 rad/s, η = 0.8332)
    """

    type_name: ClassVar[str] = "wall"
    crack_name: ClassVar[str] = "hinge"
    described_as: ClassVar[dict[str, str]] = {
        "of_size": "Wall by its height, and that of its hinge where it is known",
        "": "Wall by the heights below and above its hinge",
    }

    lower_height: Annotated[float, length("Height below the hinge", 2.0, (0.2, 57), "h₁")]
    upper_height: Annotated[float, length("Height above the hinge", 1.5, (0.1, 57), "h₂")]
    thickness: Thickness
    restitution: Balanced = None
    one_sided: OneSided = False

    @classmethod
    def of_size(
        cls,
        height: Height,
        thickness: Thickness,
        hinge_height: HingeHeight = None,
        restitution: Balanced = None,
        one_sided: OneSided = False,
    ) -> "Wall":
        """Return the wall of that height and thickness [m], hinged where statics puts the hinge or as it is given.

        Restitution by momentum is then that of the wall hinged at mid-height: next to a support it is not physical.
        """
        given = height / 2 if hinge_height is None else hinge_height
        wall = cls.hinged_at(height, given, thickness, restitution, one_sided)
        return wall if hinge_height is not None else wall.cracked_by_statics()

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
        cls.check_values("of_size", height=height)
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
        restitution = resolve_restitution(
            self.restitution, "momentum", lambda: momentum_balance(*self.impact())
        )
        side = Side.of(linkage, linkage.slenderness, linkage.end_rotation, restitution)
        return Mechanism(side, one_sided=self.one_sided)

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

    def _crack_heights(self, count: int) -> np.ndarray:
        """Hinges that stay a share of the height away from base and top."""
        return self.height * np.linspace(1 - HIGHEST_SHARE, HIGHEST_SHARE, count)

    def cracked_at(self, height: float) -> "Wall":
        return replace(self, lower_height=height, upper_height=self.height - height)

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

    >>> rocking.LoadedWall(1.6, 1.6, 0.25, unit_weight=20e3, top_load=10e3).mechanism()
    Mechanism(λ = 0.6055, φ_cr = 0.1337 rad, p = 6.372 rad/s, η = 0.6759)
    """

    type_name: ClassVar[str] = "loaded_wall"
    crack_name: ClassVar[str] = "hinge"
    described_as: ClassVar[dict[str, str]] = {
        "of_size": "Wall between supports with a load on top and ties; forces per metre of wall"
    }

    lower_height: float
    upper_height: float
    thickness: float
    unit_weight: UnitWeight
    top_load: Annotated[float, Value("Load on top of the wall", 10.0, "kN/m", (0, 500), "N")] = 0.0
    eccentricity: Eccentricity = 0.0
    top_slab: TopSlab = "hinged"
    load_held: Annotated[
        bool,
        Value(
            "Whether only the weight of the load acts, not its mass", False, phrase="load that does not move"
        ),
    ] = False
    restitution: Balanced = None

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("lower_height", "upper_height", "thickness"):
            object.__setattr__(self, name, getattr(self.wall, name))
        check_eccentricity(self.eccentricity, self.thickness)
        self._check_ties(self.height)
        self.mechanism()  # one that its load pushes over is refused at birth

    @classmethod
    def of_size(
        cls,
        height: Height,
        thickness: Thickness,
        unit_weight: UnitWeight,
        hinge_height: HingeHeight = None,
        **options: float | tuple[float, ...] | str | None,
    ) -> "LoadedWall":
        """Return the wall of that height and thickness [m], hinged as `Wall.of_size`; options as for the class."""
        given = height / 2 if hinge_height is None else hinge_height
        wall = cls.hinged_at(height, given, thickness, unit_weight, **options)
        return wall if hinge_height is not None else wall.cracked_by_statics()

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
        """Return what hangs on the wall on one side, in units of its weight."""
        linkage, unit = self.wall.linkage, self.weight
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
        form = self.wall.linkage
        bare = form.inertia, form.inertia_slope, form.gravity, form.gravity_slope, form.ground
        return LoadedForm(bare, self.attached(mirrored), 1.0)

    def _side(self, mirrored: bool) -> Side:
        restitution = resolve_restitution(
            self.restitution, "momentum", lambda: self._momentum_balance(mirrored)
        )
        return loaded_side(self._form(mirrored), self.wall.linkage.end_rotation, restitution)

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
        return self._form(mirrored=False).held_work(np.asarray(rotation, dtype=float))

    def contacts(self, state: MotionState) -> Contacts:
        sides = [
            self.wall.contacts_under(state, self._applied(state, mirrored)) for mirrored in (False, True)
        ]
        return on_side(state, *sides)

    def _applied(self, state: MotionState, mirrored: bool) -> Iterable[Applied]:
        """What hangs on the wall as forces on its blocks, per mass of the wall."""
        for each in self.attached(mirrored):
            assert isinstance(each.path, OnBlock)
            point, force = each.acting(state)
            yield each.path.block, point, force

    def tie_stretches(self, rotation: float) -> dict[float, float]:
        return {
            each.path.start.imag: float(each.path(np.asarray(max(rotation, 0.0))).moved.real)
            for each in self.attached()
            if isinstance(each.force, Tie) and isinstance(each.path, OnBlock)
        }

    def _crack_heights(self, count: int) -> np.ndarray:
        return self.wall._crack_heights(count)

    def cracked_at(self, height: float) -> "LoadedWall":
        return replace(self, lower_height=height, upper_height=self.height - height)

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
