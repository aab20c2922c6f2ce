"""The masonry wall that bends out of plane about a hinge at any height (Fig. 2; theory: section 4), loads and ties.

x is measured from the middle of the wall, outwards (to the right) positive; the positive side bends outwards.
"""

from collections import Counter
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np

from rocking.errors import SizeError, StructureError
from rocking.quantities import finite
from rocking.structures.crackable import unplaced
from rocking.structures.drawing import Mark, Path, span
from rocking.structures.fields import (
    OneSided,
    OptionalUnitWeight,
    Value,
    form_made_by,
    length,
    restitution_value,
    stated,
)
from rocking.structures.held_wall import Hold, Load, Opening, Storey
from rocking.structures.leaves import Leaf
from rocking.structures.linkage import HIGHEST_SHARE, Restitution
from rocking.structures.stack import ROUGH, Course, Stack, counted_courses, slab
from rocking.structures.tied import Eccentricity, Tied, TopSlab, UnitWeight

_BEARING = 0.02
"""Breadth of a bearing in a stack, over the thickness of the wall: a hinge has none."""


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


@stated
@dataclass(frozen=True, repr=False)
class Wall(Tied):
    """A wall between floor and ceiling, cracked into two blocks, with what it bears and holds; forces per metre of it.

    Base and top follow the ground, and the top support slides vertically. The rotation φ is that of the lower
    block. A wall that stands free at its top is a `Block`.

    Examples
    --------
    >>> rocking.Wall(lower_height=1.6, upper_height=1.6, thickness=0.25).mechanism()
    Mechanism(λ = 0.3125, φ_cr = 0.155 rad, p = 4.262 rad/s, η = 0.8332)
    >>> rocking.Wall(1.6, 1.6, 0.25, unit_weight=20e3, top_load=10e3).mechanism()
    Mechanism(λ = 0.6055, φ_cr = 0.1337 rad, p = 6.372 rad/s, η = 0.6759)
    """

    type_name: ClassVar[str] = "wall"
    crack_name: ClassVar[str] = "hinge"
    statics_chooses: ClassVar[bool] = True
    lowest_crack: ClassVar[float] = 1 - HIGHEST_SHARE
    _of_loads: ClassVar[tuple[str, ...]] = (
        "top_load",
        "eccentricity",
        "top_slab",
        "load_held",
        "top_friction",
    )
    _described_as: ClassVar[dict[str, str]] = {
        "of_size": "Wall held at floor and ceiling, by its height, and perhaps that of a hinge",
        "": "Wall held at floor and ceiling, by the heights below and above its hinge",
    }

    lower_height: Annotated[float, length("Height below the hinge", 2.0, (0.2, 57), "h₁")]
    upper_height: Annotated[float, length("Height above the hinge", 1.5, (0.1, 57), "h₂")]
    thickness: Thickness
    _: KW_ONLY
    unit_weight: OptionalUnitWeight = None
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
        said = ", but must be given for a wall that bears or holds something, whose forces follow from it; give it."
        self._demand(self.unit_weight or not (self.top_load or self.tie_heights), "unit_weight", said)
        self._check_eccentricity(self.eccentricity, self.thickness)
        self._check_ties()
        if self.opening is None:
            if self.top_load or self.tie_heights or self.compressive_strength is not None:
                self.mechanism()  # one that its load pushes over, or its weight crushes, is refused at birth
            self._check_leaves()
            if self.slips and self.tie_heights and not isinstance(self.restitution, float):
                self._check_restitution()

    def _alone(self, leaf: Leaf) -> Self:
        """A leaf between the same supports; of one that bears nothing these hold the top."""
        loads = self._loads_on(leaf, [self.thickness])
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
        hinge_height: HingeHeight = None,
        *,
        unit_weight: float | None = None,
        crack: KnownCrack = None,
        **options: Any,
    ) -> Self:
        """Return the wall of that height and thickness [m], hinged where it is typed, or else where statics puts it.

        Raises StructureError for a hinge outside the wall, or a crack that is known, but not where.
        """
        form_made_by(cls, "of_size").check(height=height)
        if hinge_height is None and crack is not None:
            raise unplaced("hinge_height")
        typed = height / 2 if hinge_height is None else hinge_height
        hinge = finite(StructureError, "hinge_height", typed, "m")
        if not 0 < hinge < height:
            said = f" m, but must lie inside the wall, between 0 and its height of {height!r} m."
            raise SizeError.of("hinge_height", repr(hinge), said)
        wall = cls(hinge, height - hinge, thickness, unit_weight=unit_weight, crack=crack, **options)
        return wall if hinge_height is not None else wall.cracked_by_statics()

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

    def _placed(self, height: float) -> dict[str, Any]:
        return {"lower_height": height, "upper_height": self.height - height}

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
        }

    @property
    def symmetric(self) -> bool:
        """Whether no tie and no bearing off the middle distinguishes the sides."""
        bears_off_the_middle = self.top_load and self.top_slab == "hinged" and self.eccentricity != 0
        return not self.tie_heights and not bears_off_the_middle

    @property
    def _storeys(self) -> tuple[Storey]:
        # One whose weight is not known counts as if it weighed 1 N per metre.
        weight = 1 / self.height if self.unit_weight is None else self.unit_weight * self.thickness
        return (Storey(0.0, self.height, -self.thickness / 2, self.thickness / 2, weight),)

    @property
    def _loads(self) -> tuple[Load, ...]:
        is_flat = self.top_slab == "flat"
        across = 0.0 if is_flat else -self.eccentricity
        edge = self._slab_edge(self.thickness, self.top_load) if is_flat else 0.0
        load = Load(across, self.height, self.top_load, rides=False, slab=edge, moves=not self.load_held)
        return (load,) if self.top_load else ()

    @property
    def _holds(self) -> list[Hold]:
        pull = self._tie.yield_force
        ties = Counter(self._tie_levels)
        # A tie at the top holds what friction does not; a top without a load is held by what the type says.
        at_top = sum([pull] * ties.pop(self.height, 0))
        coefficient = self.joints.friction if self.top_friction is None else self.top_friction
        friction = coefficient * self.top_load if self.slips else np.inf
        holds = [Hold(height, "tie", number * pull, 0.0) for height, number in sorted(ties.items())]
        return [*holds, Hold(self.height, "top", friction + at_top, friction)]

    @property
    def slips(self) -> bool:
        """Whether it is friction that holds its top."""
        return self.top_load > 0

    @property
    def _described_opening(self) -> Opening:
        return Opening(foot=0.0, hinge=self.lower_height, hold=self.height)

    def opened(self, opening: Opening) -> Self:
        return replace(self, crack="known", opening=opening, **self._as_one_leaf)

    def stack(self, courses: int | None = None) -> Stack:
        """Return its two blocks where the hinge is known and no tie holds it, else courses; below what loads it."""
        holds_within = [hold for hold in self.held_wall.holds if hold.kind != "top"]
        if courses is None and self.crack_is_known and not holds_within:
            wall = self._storey_courses(1, cuts=[self.lower_height])
        else:
            wall = self._storey_courses(counted_courses(courses))
        return self._stacked(list(wall), ROUGH if self.top_friction is None else self.top_friction)

    def _slab(self, load: Load) -> Course:
        if self.top_slab == "flat":
            self._check_slab("load_held")
        half = (3.0 if self.top_slab == "flat" else _BEARING) * self.thickness / 2
        return slab(load.x - half, load.x + half, load.z, load.weight, guided=True)


@stated
@dataclass(frozen=True, repr=False)
class LoadedWall(Wall):
    """A `Wall` of which the weight is known, so that it may bear loads and hang on ties.

    Examples
    --------
    >>> rocking.LoadedWall(1.6, 1.6, 0.25, unit_weight=20e3, top_load=10e3).mechanism()
    Mechanism(λ = 0.6055, φ_cr = 0.1337 rad, p = 6.372 rad/s, η = 0.6759)
    """

    type_name: ClassVar[str] = "loaded_wall"
    _described_as: ClassVar[dict[str, str]] = {
        "of_size": "Wall between supports with a load on top and ties; forces per metre of wall"
    }

    unit_weight: UnitWeight = field(kw_only=False)

    @classmethod
    def of_size(  # type: ignore[override]
        cls,
        height: Height,
        thickness: Thickness,
        unit_weight: UnitWeight,
        hinge_height: HingeHeight = None,
        *,
        crack: KnownCrack = None,
        **options: Any,
    ) -> Self:
        """Return the wall of that height, thickness [m] and weight [N/m³]; see `Wall.of_size`."""
        return super().of_size(
            height, thickness, hinge_height, unit_weight=unit_weight, crack=crack, **options
        )
