"""The masonry wall that bends out of plane about a hinge at any height (Fig. 2; theory: section 4), loads and ties.

x is measured from the middle of the wall, outwards (to the right) positive; the positive side bends outwards.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Annotated, Any, ClassVar, Literal, Self, TypedDict, Unpack

import numpy as np

from rocking.errors import SizeError, StructureError
from rocking.quantities import GRAVITY, finite
from rocking.structures.crackable import USUAL_WEIGHT, CrackedAtHeight, unplaced
from rocking.structures.drawing import Mark, Path, rectangle, span
from rocking.structures.fields import (
    OneSided,
    OptionalUnitWeight,
    Value,
    form_made_by,
    length,
    restitution_value,
)
from rocking.structures.held_wall import HeldWall, Hold, Load, Opening, Storey
from rocking.structures.leaves import Leaf, Leaved
from rocking.structures.linkage import (
    HIGHEST_SHARE,
    Contacts,
    Hung,
    Kinematics,
    Linkage,
    MotionState,
    Parts,
    Restitution,
    Restraint,
    cross,
    inset,
    keeps_last,
)
from rocking.structures.mechanism import Tie
from rocking.structures.stack import (
    ROUGH,
    Course,
    Held,
    Stack,
    counted_courses,
    course_at,
    courses_between,
    joints_between,
    slab,
)
from rocking.structures.tied import (
    LEAST_STIFFNESS,
    Eccentricity,
    Tied,
    TopSlab,
    UnitWeight,
    check_eccentricity,
)

_GRIPS = 1e-3
"""Movement back over which the friction at a top that has slipped comes to nothing, m."""
_BEARING = 0.02
"""Breadth of a bearing in a stack, over the thickness of the wall: a hinge has none."""
_LINKAGE_MARGIN = 0.9
"""Share of the reach of the shorter half that the motion may use: the linkage locks at 1, where ψ' is
infinite, and by 0.9 the hinge has moved so far past the upright position that the wall has fallen."""


class WallLinkage(Linkage):
    """The two blocks of a wall of that `weight`, lower and upper; loads with a mass move up and down only."""

    def __init__(
        self,
        *,
        lower_height: float,
        upper_height: float,
        thickness: float,
        weight: float = 1.0,
        hung: Sequence[Hung] = (),
    ) -> None:
        self._half_thickness = thickness / 2
        self._lower_half = lower_height / 2
        self._upper_half = upper_height / 2
        self._upper_slenderness = np.arctan2(thickness, upper_height)
        heights = np.array([lower_height, upper_height])
        diagonals = np.hypot(heights, thickness) / 2
        masses = weight * (heights / heights.sum())
        centres = [1j * lower_height / 2, 1j * (lower_height + upper_height / 2)]
        self._hang(Parts(masses, centres, masses * diagonals**2 / 3), hung)
        self.unit = weight
        slenderness = float(np.arctan2(thickness, lower_height))
        self.critical = None if self.hung else slenderness
        reach = min(1.0, diagonals[1] / diagonals[0])
        self.end_rotation = float(min(np.pi / 2, slenderness + np.arcsin(_LINKAGE_MARGIN * reach)))

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Kinematics:
        """Return the blocks at `rotation` ≥ 0, any shape; hinges at the base, between the blocks and at the top.

        The lower block turns clockwise about its right bottom corner, the upper one back about the left edge.
        """
        # S and C of the lower half diagonal, ψ' and ψ''
        sine = np.sin(rotation)
        cosine = np.cos(rotation)
        across = self._half_thickness * cosine - self._lower_half * sine
        up = self._lower_half * cosine + self._half_thickness * sine
        # R₂² − S² = (h₂/2)² + (b − S)(b + S), without the cancellation of a flat upper block
        offset = 2 * self._half_thickness * np.sin(rotation / 2) ** 2 + self._lower_half * sine
        upper_up = np.sqrt(self._upper_half**2 + offset * (self._half_thickness + across))
        ratio = up / upper_up
        curvature = across * (1 - ratio**2) / upper_up
        lower = -across + 1j * up
        upper = across + 1j * up / ratio
        base = self._half_thickness + np.zeros_like(lower)
        psi = self._upper_slenderness - np.arctan2(upper.real, upper.imag)
        one = np.ones_like(across)
        blocks = Kinematics(
            hinges=np.array([base, base + 2 * lower, base + 2 * lower + 2 * upper]),
            angles=np.array([-np.asarray(rotation) * one, psi]),
            spins=np.array([-one, ratio]),
            spin_slopes=np.array([0 * one, curvature]),
            centroids=np.array([base + lower, base + 2 * lower + upper]),
            velocities=np.array([-1j * lower, -2j * lower + 1j * ratio * upper]),
            accelerations=np.array([-lower, -2 * lower + (1j * curvature - ratio**2) * upper]),
        )
        return self._loaded(blocks) if self.loads else blocks

    def _loaded(self, blocks: Kinematics) -> Kinematics:
        """The motion with that of the loads on the top, each of which rises with its bearing and moves to no side."""
        carried = [self.carried(1, load.start, blocks) for load in self.loads]
        # Upwards only: the imaginary part.
        places = [
            load.start + 1j * np.imag(point.moved) for load, point in zip(self.loads, carried, strict=True)
        ]
        velocities = [1j * np.imag(point.velocity) for point in carried]
        accelerations = [1j * np.imag(point.acceleration) for point in carried]
        # No load turns.
        still = np.zeros((len(carried), *blocks.spins.shape[1:]))
        return replace(
            blocks,
            angles=np.concatenate([blocks.angles, still]),
            spins=np.concatenate([blocks.spins, still]),
            spin_slopes=np.concatenate([blocks.spin_slopes, still]),
            centroids=np.array([*blocks.centroids, *places]),
            velocities=np.array([*blocks.velocities, *velocities]),
            accelerations=np.array([*blocks.accelerations, *accelerations]),
        )

    def contacts(self, state: MotionState) -> Contacts:
        """Return the contact forces per mass of the wall.

        The top support carries no vertical force: the thrust at the hinge follows from the upper block alone.
        """
        motion = self.motion(state.rotation)
        forces, couples = self.dalembert(state)
        for load, force in zip(self.loads, forces[2:], strict=True):
            bearing = load.start + self.carried(1, load.start, motion).moved
            pressing = 1j * force.imag  # the floor holds the load sideways
            forces[1] += pressing
            couples[1] += cross(bearing - motion.centroids[1], pressing)
        _, hinge, top = motion.hinges
        turning = cross(motion.centroids[1] - top, forces[1]) + couples[1]
        arm = hinge - top
        across = (arm.real * -forces[1].imag + turning) / arm.imag
        at_hinge = across - 1j * forces[1].imag
        joint = 1j * np.exp(1j * (motion.angles[0] + motion.angles[1]) / 2)
        thrusts = np.stack([at_hinge - forces[0], at_hinge]) / self.unit
        return Contacts.resolved(("base", "hinge"), thrusts, np.stack([1j + 0 * joint, joint]))


Height = Annotated[float, length("Height between the supports", 3.2, (0.5, 60), "h")]
HingeHeight = Annotated[
    float | None,
    length(
        "Height above the base of a hinge, one of those that may form unless crack is known; left out: where statics "
        "puts it, from 0.05 to 0.95 of the height",
        1.6,
        (0.2, 57),
        "h₁",
    ),
]
Thickness = Annotated[float, length("Thickness", 0.25, (0.05, 5), "t")]
Balanced = Annotated[Restitution, restitution_value("momentum")]


KnownCrack = Literal["known"] | None
"""See `Crackable`."""


class WallOptions(TypedDict, total=False):
    """The options of a wall besides its sizes; see `Wall`."""

    restitution_range: float | None
    compressive_strength: float | None
    unit_weight: float | None
    leaves: tuple[float, ...]
    bonders: float | tuple[float, ...] | None
    thrown_back: float | None


class LoadedWallOptions(TypedDict, total=False):
    """The options of a loaded wall besides its sizes; see `LoadedWall`."""

    top_load: float
    eccentricity: float
    top_slab: Literal["hinged", "flat"]
    load_held: bool
    restitution: Restitution
    tie_heights: tuple[float, ...]
    tie_stiffness: float
    tie_pretension: float
    tie_strength: float | None
    tie_plastic_elongation: float
    tie_spacing: float | None
    unit_length: float | None
    held_between: Literal["floor"] | None
    rod_diameter: float | None
    rod_length: float | None
    rod_yield_stress: float | None
    rod_modulus: float
    rod_pretension: float
    one_sided: bool
    restitution_range: float | None
    compressive_strength: float | None
    top_friction: float | None
    leaves: tuple[float, ...]
    bonders: float | tuple[float, ...] | None
    thrown_back: float | None
    loaded_leaf: Literal["inner", "outer"] | None


@dataclass(frozen=True, repr=False)
class CrackedWall(CrackedAtHeight, Leaved):
    """A wall cracked into two blocks; base and top follow the ground, the top support slides vertically."""

    crack_name: ClassVar[str] = "hinge"
    statics_chooses: ClassVar[bool] = True
    lowest_crack: ClassVar[float] = 1 - HIGHEST_SHARE

    lower_height: Annotated[float, length("Height below the hinge", 2.0, (0.2, 57), "h₁")]
    upper_height: Annotated[float, length("Height above the hinge", 1.5, (0.1, 57), "h₂")]
    thickness: Thickness

    @classmethod
    def _heights(cls, height: float, hinge_height: float | None, crack: KnownCrack) -> tuple[float, float]:
        """The heights below and above the hinge [m], in the middle where none is typed.

        Raises StructureError for a hinge outside the wall, or a crack that is known, but not where.
        """
        form_made_by(cls, "of_size").check(height=height)
        if hinge_height is None:
            if crack is not None:
                raise unplaced("hinge_height")
            return height / 2, height / 2
        hinge = finite(StructureError, "hinge_height", hinge_height, "m")
        if not 0 < hinge < height:
            raise SizeError.of(
                "hinge_height",
                repr(hinge),
                f" m, but must lie inside the wall, between 0 and its height of {height!r} m.",
            )
        return hinge, height - hinge

    @property
    def height(self) -> float:
        """h₁ + h₂, m."""
        return self.lower_height + self.upper_height

    @property
    def hinge_height(self) -> float:
        """h₁, m."""
        return self.lower_height

    @property
    def crack_position(self) -> float:
        """Height of the hinge, m."""
        return self.lower_height

    @property
    def total_height(self) -> float:
        """h₁ + h₂, m."""
        return self.height

    def _linkage(self, mirrored: bool) -> Linkage:
        return WallLinkage(
            lower_height=self.lower_height, upper_height=self.upper_height, thickness=self.thickness
        )

    def stack(self, courses: int | None = None) -> Stack:
        """Return its two blocks where the hinge is known, else so many courses, held sideways at the top."""
        wall = self._wall_courses(courses, 1.0)
        return Stack(wall, self._behind(wall), top_held_at=(0.0, self.height))

    @property
    def _holds_within(self) -> tuple[float, ...]:
        """The heights between foot and top at which something holds it, m: it may bulge between any two."""
        return ()

    def _wall_courses(self, courses: int | None, density: float) -> tuple[Course, ...]:
        """The wall itself. density: mass per m³."""
        if courses is None and self.crack_is_known and not self._holds_within:
            levels = [0.0, self.lower_height, self.height]
        else:
            levels = joints_between([0.0, *self._holds_within, self.height], counted_courses(courses))
        number = len(levels) - 1
        faces = [(-self.thickness / 2, self.thickness / 2)] * (number + 1)
        return courses_between(levels, faces, density, [1.0] * number)

    def _placed(self, height: float) -> dict[str, Any]:
        return {"lower_height": height, "upper_height": self.height - height}

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        half = self.thickness / 2
        hinge = self.lower_height
        return [(0, rectangle(-half, half, 0.0, hinge)), (1, rectangle(-half, half, hinge, self.height))]

    def marks(self, rotation: float = 0.0) -> tuple[Mark, ...]:
        """Return also the floor and the ceiling, which hold it sideways on both faces; the ceiling moves up with it."""
        face = self.thickness / 2
        end = face + 0.1 * self.height
        ceiling = float(self.hinges(rotation)[-1, 1])
        held = [
            Mark("support", text, np.array([[sign * end, height], [sign * face, height]]))
            for height in (0.0, ceiling)
            for sign, text in ((-1, ""), (1, "held"))
        ]
        return (*super().marks(rotation), *held)

    def _dimensions(self) -> dict[str, Path | list[Path]]:
        half = self.thickness / 2
        crack = self.lower_height
        top = self.height
        apart = 0.06 * self.height
        left = np.array([-apart, 0.0])
        right = np.array([apart, 0.0])
        return {
            "height": span([-half, 0.0], [-half, top], left),
            "hinge_height": span([half, 0.0], [half, crack], right),
            "lower_height": span([half, 0.0], [half, crack], right),
            "upper_height": span([half, crack], [half, top], right),
            "thickness": span([-half, top], [half, top], [0.0, apart]),
            **self._leaf_dimensions(),
        }

    @property
    def _sections(self) -> tuple[tuple[float, float, float, float], ...]:
        return ((0.0, self.height, -self.thickness / 2, self.thickness / 2),)


@dataclass(frozen=True, repr=False)
class Wall(CrackedWall):
    """A wall held at floor and ceiling, cracked into two blocks.

    Base and top follow the ground, and the top support slides vertically. The rotation φ is that of the lower
    block. A wall that stands free at its top is a `Block`.

    Parameters
    ----------
    lower_height : float
        Height h₁ below the hinge, m.
    upper_height : float
        Height h₂ above the hinge, m.
    thickness : float
        Thickness 2b, m.
    restitution : float, str or None, optional
        η in [0, 1] or "momentum" (the default): the impulses at the hinges of the mirrored mechanism do no
        work on it. For equal blocks that is (1 − 4.5 sin²α)/(1 + 3 sin²α), which reaches 0 at sin²α = 2/9;
        squatter walls get 0 and a StructureWarning.
    one_sided : bool, default False
        Whether it leans on cross walls and bends outwards only, thrown back at every impact; it needs a
        restitution number.
    restitution_range : float or None, optional
        η is known to plus or minus this much; None: as the settings of the ensemble say.
    leaves : tuple of float, optional
        Thickness of each leaf from outside in, m, two or three, which may part; () for one leaf.
    bonders : float, tuple of float or None, optional
        Heights above the ground at which through-stones hold each leaf, m, or one spacing, counted down from
        the top; None: nothing does.
    thrown_back : float or None, optional
        η of the impact of a leaf on the one beside it, in [0, 1]; None: each leaf rocks both ways.
    compressive_strength : float or None, optional
        Compressive strength of the masonry, Pa, at which the edges of joints crush, so that hinges move in;
        None: they do not crush. Needs `unit_weight`.
    crack : {'known'} or None, optional
        "known" where a survey or a joint says that it is cracked at the place above, which then decides;
        None: it may crack there or elsewhere, and each place counts.
    unit_weight : float or None, optional
        Weight of the masonry per volume, N/m³.

    Raises
    ------
    StructureError
        When it cannot stand.

    Examples
    --------
    >>> rocking.Wall(lower_height=1.6, upper_height=1.6, thickness=0.25).mechanism()
    Mechanism(λ = 0.3125, φ_cr = 0.155 rad, p = 4.262 rad/s, η = 0.8332)
    """

    type_name: ClassVar[str] = "wall"
    _described_as: ClassVar[dict[str, str]] = {
        "of_size": "Wall held at floor and ceiling, by its height, and perhaps that of a hinge",
        "": "Wall held at floor and ceiling, by the heights below and above its hinge",
    }

    restitution: Balanced = None
    one_sided: OneSided = False
    unit_weight: OptionalUnitWeight = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._stand_crushed()
        self._check_leaves()

    def _alone(self, leaf: Leaf) -> CrackedWall:
        """A leaf between the same supports, between which bonders may hold it."""
        options: dict[str, Any] = {
            "restitution_range": self.restitution_range,
            "compressive_strength": self.compressive_strength,
            **self._stands_as(leaf),
        }
        heights = self.lower_height, self.upper_height
        if not self.bonder_heights:
            return Wall(*heights, leaf.thickness, crack=self.crack, unit_weight=self.unit_weight, **options)
        weight = self.unit_weight or USUAL_WEIGHT
        return LoadedWall(*heights, leaf.thickness, weight, held_at=self.bonder_heights, **options)

    def _linkage(self, mirrored: bool) -> Linkage:
        if self.compressive_strength is None:
            return super()._linkage(mirrored)
        return self._masonry.linkage(self._opening, self._opening, ())

    @property
    def _masonry(self) -> HeldWall:
        """The wall as limit analysis sees it; of weight 1 per metre where none is given."""
        half = self.thickness / 2
        top = self.height
        weight = 1 / top if self.unit_weight is None else self.unit_weight * self.thickness
        masonry = (Storey(0.0, top, -half, half, weight),)
        return HeldWall(masonry, (), (Hold(top, "top", np.inf, np.inf),), strength=self.compressive_strength)

    @property
    def _opening(self) -> Opening:
        return Opening(foot=0.0, hinge=self.lower_height, hold=self.height)

    @property
    def does(self) -> str:
        return self._masonry.name(self._opening)

    def restraints(self) -> tuple[Restraint, ...]:
        """Return the top, with what it needs as the wall starts: R = (λ S_h + M_h⁻)/(H − h), of one hold."""
        wall = self._masonry
        _, inner, lever = wall.joint(self.lower_height)
        moment = wall.multiplier(self._opening) * lever + inner
        needed = moment / (self.height - self.lower_height)
        weight = 1.0 if self.unit_weight is None else self.unit_weight * self.thickness * self.height
        taken = Restraint(
            kind="top",
            height=self.height,
            holds=wall.name(self._opening),
            needed=needed,
            friction=np.inf,
            coefficient=np.inf,
            weight=weight,
        )
        return (taken,)

    @classmethod
    def of_size(
        cls,
        height: Height,
        thickness: Thickness,
        hinge_height: HingeHeight = None,
        restitution: Restitution = None,
        one_sided: bool = False,
        *,
        crack: KnownCrack = None,
        **options: Unpack[WallOptions],
    ) -> Self:
        """Return the wall of that height and thickness [m], hinged where it is typed, or else where statics puts it."""
        lower, upper = cls._heights(height, hinge_height, crack)
        wall = cls(lower, upper, thickness, restitution, one_sided, crack=crack, **options)
        return wall if hinge_height is not None else wall.cracked_by_statics()

    @classmethod
    def hinged_at(
        cls,
        height: float,
        hinge_height: float,
        thickness: float,
        restitution: Restitution = None,
        one_sided: bool = False,
        *,
        crack: KnownCrack = None,
        **options: Unpack[WallOptions],
    ) -> Self:
        """Return the wall of that total height whose hinge lies at `hinge_height` [m] above the base."""
        hinge = finite(StructureError, "hinge_height", hinge_height, "m")
        return cls.of_size(height, thickness, hinge, restitution, one_sided, crack=crack, **options)


@dataclass(frozen=True, repr=False)
class LoadedWall(CrackedWall, Tied):
    """A wall cracked into two blocks between supports, as `Wall`, with what hangs on it; forces per metre of wall.

    Parameters
    ----------
    lower_height : float
        Height below the hinge, m.
    upper_height : float
        Height above the hinge, m.
    thickness : float
        Thickness, m.
    unit_weight : float
        Weight of the masonry per volume, N/m³.
    top_load : float, default 0.0
        Load of the floor or the walls above, N/m.
    eccentricity : float, default 0.0
        Distance of the load inwards from the middle of the wall, m.
    top_slab : {'hinged', 'flat'}, default 'hinged'
        Whether the load comes by a "hinged" bearing, or by a slab that stays "flat" and rests on the edge in
        contact.
    load_held : bool, default False
        Whether only the weight of the load acts; otherwise its mass moves up and down with the top.
    restitution : float, str or None, optional
        η in [0, 1] or "momentum" (the default).
    restitution_range : float or None, optional
        η is known to plus or minus this much; None: as the settings of the ensemble say.
    leaves : tuple of float, optional
        Thickness of each leaf from outside in, m, two or three, which may part; () for one leaf.
    bonders : float, tuple of float or None, optional
        Heights above the ground at which through-stones hold each leaf, m, or one spacing, counted down from
        the top; None: nothing does.
    thrown_back : float or None, optional
        η of the impact of a leaf on the one beside it, in [0, 1]; None: each leaf rocks both ways.
    compressive_strength : float or None, optional
        Compressive strength of the masonry, Pa, at which the edges of joints crush, so that hinges move in;
        None: they do not crush. Needs `unit_weight`.
    crack : {'known'} or None, optional
        "known" where a survey or a joint says that it is cracked at the place above, which then decides;
        None: it may crack there or elsewhere, and each place counts.
    tie_heights : tuple of float, optional
        Heights of the ties above the ground, m.
    tie_stiffness : float, default 0.0
        Stiffness of each tie per metre of wall, N/m².
    tie_pretension : float, default 0.0
        Force of each tie at rest per metre of wall, N/m; needs `one_sided`.
    tie_strength : float or None, optional
        Force per metre of wall at which each tie yields, or breaks where no plastic elongation is given, N/m;
        None: elastic.
    tie_plastic_elongation : float, default 0.0
        Elongation by which each tie yields at its strength before it breaks, m; 0 is brittle.
    tie_spacing : float or None, optional
        Distance between the ties of a row along the wall, m; None: they are taken to hold it all along.
        Beyond three times `unit_length` it may fall between them.
    unit_length : float or None, optional
        Length of the units of the masonry along the wall, m; needed with `tie_spacing`.
    held_between : {'floor'} or None, optional
        "floor" where a stiff floor or a ring beam holds the wall all along between its ties; None: nothing
        does.
    rod_diameter : float or None, optional
        Diameter of a steel rod, m, in place of stiffness, strength and pretension per metre; needs
        `rod_length` and `tie_spacing`.
    rod_length : float or None, optional
        Free length of a rod between its anchors, m.
    rod_yield_stress : float or None, optional
        Stress at which a rod yields, Pa; None: elastic.
    rod_modulus : float, default 200000000000.0
        Modulus of elasticity of a rod, Pa.
    rod_pretension : float, default 0.0
        Force of a rod at rest, N; needs `one_sided`.
    anchor_height : float, default 0.2
        Height of the masonry that the anchor of each tie grips, by whose friction it holds, m.
    loaded_leaf : {'inner', 'outer'} or None, optional
        The leaf on which loads bear; None: the inner one.
    opening : Opening or None, optional
        Which of its mechanisms this is alone; None of a structure as it is listed.
    held_at : tuple of float, optional
        Heights at which the rest of a wall holds this leaf of it, m; () of a structure as it is listed.
    one_sided : bool, default False
        Whether it bends outwards only; needs a restitution number.
    top_friction : float or None, optional
        Friction coefficient between load and wall, by which the load holds the top; None: that of all its
        joints. A top without a load is held.

    Raises
    ------
    StructureError
        When it cannot stand.

    Examples
    --------
    >>> rocking.LoadedWall(1.6, 1.6, 0.25, unit_weight=20e3, top_load=10e3).mechanism()
    Mechanism(λ = 0.6055, φ_cr = 0.1337 rad, p = 6.372 rad/s, η = 0.6759)
    """

    type_name: ClassVar[str] = "loaded_wall"
    loads_rise_only: ClassVar[bool] = True
    _described_as: ClassVar[dict[str, str]] = {
        "of_size": "Wall between supports with a load on top and ties; forces per metre of wall"
    }

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
    one_sided: OneSided = field(default=False, kw_only=True)
    top_friction: Annotated[
        float | None,
        Value(
            "Friction coefficient between the wall and what lies on it, which holds its top; left out: "
            "friction_coefficient of the settings",
            0.6,
            usual=(0.2, 1.0),
            bounds={"ge": 0, "le": 10},
        ),
    ] = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        check_eccentricity(value=self.eccentricity, thickness=self.thickness)
        self._check_ties()
        if self.opening is None:
            self.mechanism()  # one that its load pushes over is refused at birth
            self._check_leaves()
            if self.slips and self.tie_heights and not isinstance(self.restitution, float):
                self._check_restitution()

    def _alone(self, leaf: Leaf) -> "LoadedWall":
        """A leaf between the same supports; of one that bears nothing these hold the top."""
        loads: dict[str, Any] = {
            "top_load": 0.0,
            "eccentricity": 0.0,
            "top_friction": None,
            "load_held": False,
        }
        loads["top_slab"] = "hinged"
        if self._bears(leaf):
            loads |= {name: getattr(self, name) for name in loads}
            loads["eccentricity"] = self._eccentricity_on(leaf, [self.thickness], self.eccentricity)
        return replace(
            self,
            thickness=leaf.thickness,
            crack=None if self.bonder_heights else self.crack,
            held_at=self.bonder_heights,
            **(self._as_one_leaf | loads | self._ties_of(leaf) | self._stands_as(leaf)),
        )

    @classmethod
    def of_size(
        cls,
        height: Height,
        thickness: Thickness,
        unit_weight: UnitWeight,
        hinge_height: HingeHeight = None,
        *,
        crack: KnownCrack = None,
        **options: Unpack[LoadedWallOptions],
    ) -> Self:
        """Return the wall of that height and thickness [m], hinged as `Wall.of_size`; options as for the class."""
        lower, upper = cls._heights(height, hinge_height, crack)
        wall = cls(lower, upper, thickness, unit_weight, crack=crack, **options)
        return wall if hinge_height is not None else wall.cracked_by_statics()

    @classmethod
    def hinged_at(
        cls,
        height: float,
        hinge_height: float,
        thickness: float,
        unit_weight: float,
        *,
        crack: KnownCrack = None,
        **options: Unpack[LoadedWallOptions],
    ) -> Self:
        """Return the wall of that total height whose hinge lies at `hinge_height` [m] above the base."""
        hinge = finite(StructureError, "hinge_height", hinge_height, "m")
        return cls.of_size(height, thickness, unit_weight, hinge, crack=crack, **options)

    @property
    def _holds_within(self) -> tuple[float, ...]:
        return tuple(
            sorted({height for height in (*self.tie_heights, *self.held_at) if height < self.height})
        )

    @property
    def symmetric(self) -> bool:
        """Whether no tie and no bearing off the middle distinguishes the sides."""
        bears_off_the_middle = self.top_load and self.top_slab == "hinged" and self.eccentricity != 0
        return not self.tie_heights and not bears_off_the_middle

    @cached_property
    def held_wall(self) -> HeldWall:
        half = self.thickness / 2
        top = self.height
        ties = Counter(height for height in self.tie_heights if height < top)
        holds = [
            Hold(height, "tie", number * self._yield_force, 0.0) for height, number in sorted(ties.items())
        ]
        # A tie at the top holds what friction does not; a top without a load is held by what the type says.
        friction = self._friction if self.slips else np.inf
        at_top = sum(self._yield_force for height in self.tie_heights if height == top)
        slab = self.top_slab == "flat"
        across = 0.0 if slab else -self.eccentricity
        load = Load(across, top, self.top_load, rides=False, slab=self._slab_edge * slab)
        return HeldWall(
            (Storey(0.0, top, -half, half, self.unit_weight * self.thickness),),
            (load,) if self.top_load else (),
            tuple(sorted(self._with_bonders([*holds, Hold(top, "top", friction + at_top, friction)]))),
            backed=self.one_sided,
            strength=self.compressive_strength,
            ties_apart=self.ties_apart,
            gripped=self.anchor_height,
            joints=self.joints,
        )

    @property
    def slips(self) -> bool:
        """Whether it is friction that holds its top."""
        return self.top_load > 0

    @property
    def _top_friction(self) -> float:
        """The friction coefficient of what lies on it: its own, or that of all its joints."""
        return self.joints.friction if self.top_friction is None else self.top_friction

    @property
    def _friction(self) -> float:
        """The force by which friction holds its top, N per metre."""
        return self._top_friction * self.top_load

    @property
    def _slab_edge(self) -> float:
        """Distance of the edge on which a slab lies from the middle of the wall, m."""
        return self.thickness / 2 - inset(
            pressing=self.top_load, strength=self.compressive_strength, breadth=self.thickness
        )

    @property
    def _described_opening(self) -> Opening:
        return Opening(foot=0.0, hinge=self.lower_height, hold=self.height)

    def opened(self, opening: Opening) -> Self:
        return replace(self, crack="known", opening=opening, **self._as_one_leaf)

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        return super()._parts() if self.opening is None else self.held_wall.outlines(self.opening)

    def _linkage(self, mirrored: bool) -> Linkage:
        opened = self._opened_linkage(mirrored)
        if opened is not None:
            return opened
        if self.compressive_strength is not None:
            hinge = replace(self._described_opening, outwards=not mirrored)
            return self.held_wall.linkage(hinge, hinge, self._hung(mirrored), guided=True)
        weight = self.unit_weight * self.height * self.thickness
        return WallLinkage(
            lower_height=self.lower_height,
            upper_height=self.upper_height,
            thickness=self.thickness,
            weight=weight,
            hung=self._hung(mirrored),
        )

    def stack(self, courses: int | None = None) -> Stack:
        """Return its two blocks where the hinge is known and no tie holds it, else courses; below what loads it."""
        self._check_plane()
        wall = self._wall_courses(courses, self.unit_weight / GRAVITY)
        half = self.thickness / 2
        top = (-self.eccentricity, self.height)
        held = tuple(
            Held(course_at(wall, height), (half, height), tie=self._tie) for height in self.tie_heights
        )
        held += (*self._bonded(wall, half, -half), *self._behind(wall))
        if not self.top_load:
            return Stack(wall, held, top_held_at=(0.0, self.height))
        if self.load_held and self.top_slab == "flat":
            raise StructureError(
                "load_held is true under a flat slab, but contact dynamics needs the mass of a slab; leave load_held "
                "out, or choose another fidelity than contact.",
                load_held=True,
            )
        if self.load_held:
            weight = Held(len(wall) - 1, top, force=(0.0, -self.top_load))
            return Stack(wall, (*held, weight), top_held_at=(0.0, self.height))
        edges = (-3 * half, 3 * half)
        if self.top_slab == "hinged":
            edges = (top[0] - _BEARING * half, top[0] + _BEARING * half)
        floor = slab(*edges, self.height, self.top_load, guided=True)
        own = ROUGH if self.top_friction is None else self.top_friction
        return Stack((*wall, floor), held, friction=own)

    def _hung(self, mirrored: bool) -> list[Hung]:
        half = self.thickness / 2
        outwards = -1.0 if mirrored else 1.0
        hung = []
        way = self._way(mirrored)
        # The upper body leans back; a slab rests on the edge that rises, the bearing of a hinge lies inwards.
        lean = -outwards if way is None else way.lean_of_top
        slip = 0.0 if way is None else self.held_wall.slip(way)
        if self.top_load:
            across = -lean * self._slab_edge if self.top_slab == "flat" else -self.eccentricity
            bearing = complex(outwards * across, self.height)
            # What a top slips under stays behind: it is carried, and not moved.
            stays = self.load_held or bool(slip)
            hung.append(self._load(bearing, self._part_at(self.height), self.top_load, stays))
        if self._friction >= LEAST_STIFFNESS * _GRIPS and slip * outwards > 0:
            # It resists from the first movement on, until the wall has left what lies on it.
            slides = Tie(
                stiffness=self._friction / _GRIPS,
                pretension=self._friction,
                strength=self._friction,
                plastic_elongation=self.thickness,
            )
            start = complex(outwards * half, self.height)
            hung.append(Hung("friction", start, self._part_at(self.height), tie=slides))
        for height in self.tie_heights:
            start = complex(outwards * half, height)
            hung.append(Hung("tie", start, self._part_at(height), tie=self._tie_on(height, mirrored)))
        return hung

    def _part_at(self, height: float) -> int:
        """The part, from 0, to which what acts at `height` [m] belongs."""
        if self.opening is not None:
            return self.held_wall.part_at(self.opening, height)
        return 0 if height <= self.lower_height else 1
