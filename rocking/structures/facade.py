"""The façade that leans out as one rigid body above a crack, with floors, ties and thrusts on it (theory: section 2).

x = 0 is the outer face, x < 0 the building; the positive side rocks outwards about the outer toe of the crack.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import counted, whole
from rocking.structures.crackable import unplaced
from rocking.structures.drawing import Path, span
from rocking.structures.fields import Lean, Value, restitution_value, stated
from rocking.structures.held_wall import Hold, Load, Opening, Storey
from rocking.structures.kinds import StructureKind
from rocking.structures.leaves import Leaf
from rocking.structures.linkage import Restitution
from rocking.structures.stack import MOST_COURSES, Course, Stack, counted_courses, joined, slab
from rocking.structures.tied import Eccentricity, Tied, TopSlab, UnitWeight
from rocking.warnings import RockingWarning

_MOST_STOREYS = 50
_SIZES = {"ge": 1e-4, "le": 1000}


@stated
@dataclass(frozen=True, repr=False)
class Facade(Tied):
    """Storeys stacked as one rigid body, flush outside, that rocks above the crack at the foot of one storey.

    All forces are per metre of façade. It may crack at any joint unless a crack is known.

    Examples
    --------
    >>> rocking.Facade((3.5, 3.0), (0.6, 0.5), unit_weight=20e3, restitution=0.8).mechanism().positive
    Side(λ = 0.08993, φ_cr = 0.08969 rad, p = 1.521 rad/s, η = 0.8)
    """

    type_name: ClassVar[str] = "facade"
    crack_name: ClassVar[str] = "crack"
    _of_loads: ClassVar[tuple[str, ...]] = (
        "floor_loads",
        "eccentricity",
        "top_slab",
        "loads_held",
        "thrust",
        "thrust_height",
    )
    _described_as: ClassVar[dict[str, str]] = {
        "": "Façade of one storey or several with floor loads, ties and thrust; forces per metre of façade"
    }

    storey_heights: Annotated[
        tuple[float, ...],
        Value("Height of each storey from the ground up", [3.5, 3.0], "m", (0.5, 30), "h", bounds=_SIZES),
    ]
    thicknesses: Annotated[
        tuple[float, ...],
        Value("Thickness of each storey, flush outside", [0.6, 0.5], "m", (0.1, 5), "t", bounds=_SIZES),
    ]
    unit_weight: UnitWeight
    floor_loads: Annotated[
        tuple[float, ...],
        Value("Load of the floor or roof on top of each storey", [12.0, 6.0], "kN/m", (0, 200), "N"),
    ] = ()
    eccentricity: Eccentricity = 0.0
    loads_held: Annotated[
        bool,
        Value(
            "Whether the rest of the building holds the mass of the loads, so that only their weight acts",
            False,
            phrase="loads held sideways",
        ),
    ] = False
    top_slab: TopSlab = "hinged"
    thrust: Annotated[
        float, Value("Horizontal thrust of a vault or roof outwards", 0.2, "kN/m", (0, 100), "H")
    ] = 0.0
    thrust_height: Annotated[
        float | None, Value("Height of the thrust above the ground", 6.0, "m", (0, 60))
    ] = None
    crack_storey: Annotated[
        int | None,
        Value("Storey at whose foot it cracks; 1 is the ground floor", 1, usual=(1, 12), bounds={"ge": 1}),
    ] = None
    crack_height: Annotated[
        float | None,
        Value(
            "Height of the crack above the ground, where it is no foot of a storey", 1.2, "m", (0, 60), "z"
        ),
    ] = field(default=None, kw_only=True)
    restitution: Annotated[Restitution, restitution_value("momentum")] = None
    behind: Annotated[
        Literal["nothing", "floors", "cross_walls"] | None,
        Value(
            "What stands behind it: nothing, floors that hold it inwards at the top of each storey that bears one, or "
            "cross_walls that hold it inwards everywhere",
            "nothing",
            phrase="{value} behind",
        ),
    ] = field(default=None, kw_only=True)
    inward_restitution: Annotated[
        float | None,
        Value(
            "Restitution of the impact that ends rocking inwards, where it differs",
            0.8,
            usual=(0.1, 1),
            bounds={"ge": 0, "le": 1},
        ),
    ] = None

    lean: Lean = field(default=0.0, kw_only=True)
    narrows: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check_storeys()
        self._check_ties()
        if self.opening is not None:
            return
        self._check_leaves()
        self.mechanism()  # one that is pushed over at rest is refused at birth
        grows = any(above > below for below, above in pairwise(self.thicknesses))
        if not self.crack_is_known and (self.thrust or grows):
            self.candidates()  # and one that is with another crack
            self.mechanisms()

    def _check_storeys(self) -> None:
        heights = self.storey_heights
        thicknesses = self.thicknesses
        loads = self.floor_loads
        if len(heights) > _MOST_STOREYS:
            raise StructureError(
                f"storey_heights has {len(heights)} values, but must have {_MOST_STOREYS} at most.",
                storey_heights=heights,
            )
        for name, values in (("thicknesses", thicknesses), ("floor_loads", loads or heights)):
            if len(values) != len(heights):
                raise StructureError(
                    f"{name} has {counted(len(values), 'value')}, but must have {len(heights)}, one for each storey.",
                    **{name: values},
                )
        bearing = [t for load, t in zip(loads, thicknesses, strict=False) if load]
        self._check_eccentricity(self.eccentricity, min(bearing or thicknesses))
        if self.crack_storey is not None:
            object.__setattr__(
                self, "crack_storey", whole("crack_storey", self.crack_storey, 1, len(heights))
            )
        if self.crack_is_known and self.crack_storey is None and self.crack_height is None:
            raise unplaced("crack_storey or crack_height")
        if self.thrust_height is not None:
            self._check_inside("thrust_height", self.thrust_height)
        # A crack_storey of 1 with a crack_height was once the default, and still occurs in files.
        if self.crack_height is not None and self.crack_storey not in (None, 1):
            raise StructureError(
                f"crack_height is {self.crack_height!r} m and crack_storey {self.crack_storey}, but one crack is "
                "meant; give one of them.",
                crack_height=self.crack_height,
            )
        said = f" m, but must lie on the façade, from 0 to below its height of {self.height:.6g} m."
        self._demand((self.crack_height or 0.0) < self.height, "crack_height", said)
        behind = self.behind if self.behind != "nothing" else None
        self._demand(
            behind is None or isinstance(self.restitution, float),
            "restitution",
            f", but must be a number between 0 and 1 for a façade with {str(behind).replace('_', ' ')} behind, which "
            "take part in the impact; give it.",
        )

    @cached_property
    def one_sided(self) -> bool:
        """Whether it moves outwards only as it opens here, as something behind stops it."""
        if self.behind in (None, "nothing"):
            return False
        return self.held_wall.other_way(self._opens) is None

    @property
    def _leans(self) -> bool:
        return self.behind == "cross_walls"

    def _alone(self, leaf: Leaf) -> "Facade":
        """A leaf of one thickness over all storeys; floors behind the wall hold the inner one alone."""
        held_at = self.bonder_heights
        if leaf.moves == "inwards":
            held_at = (*held_at, *(hold.height for hold in self.held_wall.holds if hold.inwards == np.inf))
        bearing = [t for load, t in zip(self.floor_loads, self.thicknesses, strict=False) if load]
        loads = self._loads_on(leaf, bearing)
        if leaf.moves == "inwards":
            loads |= {"thrust": 0.0, "thrust_height": None}
        # Its cracks are those of the wall, but that bonders leave it others.
        cracked = {"crack": None, "crack_storey": None, "crack_height": None} if held_at else {}
        return replace(
            self,
            thicknesses=(leaf.thickness,) * len(self.thicknesses),
            held_at=tuple(sorted(set(held_at))),
            **(self._as_one_leaf | loads | self._ties_of(leaf) | cracked),
            **self._stands_as(leaf),
        )

    def _stands_as(self, leaf: Leaf) -> dict[str, Any]:
        """Behind the inner leaf stands what does behind the wall; a leaf that only leaves another leans on it."""
        if leaf.is_inner and leaf.moves == "both ways" and self.behind in ("floors", "cross_walls"):
            as_wall = {"behind": self.behind, "restitution": self.restitution}
        else:
            as_wall = behind_leaf(super()._stands_as(leaf))
        return {**as_wall, "inward_restitution": None}

    @property
    def height(self) -> float:
        """The height of all storeys, m."""
        return float(sum(self.storey_heights))

    @property
    def crack_position(self) -> float:
        """Height of the crack above the ground, m; where none is typed that of the ground floor."""
        if self.crack_height is not None:
            return self.crack_height
        return 0.0 if self.crack_storey is None else float(self.levels[self.crack_storey - 1])

    @cached_property
    def levels(self) -> np.ndarray:
        """The foot of each storey and the top, (n + 1,) m above the ground."""
        return np.concatenate([[0.0], np.cumsum(self.storey_heights)])

    @property
    def symmetric(self) -> bool:
        """False: inside and outside differ."""
        return False

    @property
    def _leaves_out(self) -> RockingWarning | None:
        """A warning where floors stand behind it through which the model lets it rock."""
        if self.behind or not (any(self.floor_loads) or self.tie_heights):
            return None
        return RockingWarning(StructureKind.FLOORS_BEHIND)

    @property
    def _storeys(self) -> tuple[Storey, ...]:
        narrows = 1.0 - self.narrows
        return tuple(
            Storey(low, high, -thickness, 0.0, self.unit_weight * thickness, narrows)
            for (low, high), thickness in zip(pairwise(self.levels.tolist()), self.thicknesses, strict=True)
        )

    @property
    def _loads(self) -> tuple[Load, ...]:
        loads = []
        last = len(self.storey_heights) - 1
        rides = not self.loads_held
        levels = self.levels.tolist()
        for storey, load in enumerate(self.floor_loads):
            middle = -self.thicknesses[storey] / 2
            if storey == last and self.top_slab == "flat":
                edge = self._slab_edge(self.thicknesses[storey], load)
                loads.append(Load(middle, levels[storey + 1], load, rides, edge, rides))
            elif load:
                loads.append(Load(middle - self.eccentricity, levels[storey + 1], load, rides, moves=rides))
        return tuple(loads)

    @property
    def _holds(self) -> list[Hold]:
        levels = self.levels.tolist()
        bears = self.floor_loads if any(self.floor_loads) else [1.0] * len(self.storey_heights)
        floors = [level for level, load in zip(levels[1:], bears, strict=True) if load]
        if self.behind != "floors":
            floors = []
        holds = [
            Hold(height, "tie", ties * self._tie.yield_force, np.inf if height in floors else 0.0)
            for height, ties in Counter(self._tie_levels).items()
        ]
        return holds + [
            Hold(level, "floor", 0.0, np.inf) for level in floors if level not in self._tie_levels
        ]

    @property
    def _thrusts(self) -> tuple[tuple[float, float], ...]:
        height = self.height if self.thrust_height is None else self.thrust_height
        return ((height, self.thrust),) if self.thrust else ()

    @property
    def _aside(self) -> float:
        return float(np.tan(self.lean))

    def opened(self, opening: Opening) -> "Facade":
        cracked = self._cracked_there_only.cracked_at(opening.foot)
        as_one_body = opening.hinge is None and not opening.between
        return cracked if as_one_body else replace(cracked, opening=opening)

    def _impact(self, mirrored: bool) -> float:
        if mirrored and self.inward_restitution is not None:
            return self.inward_restitution
        return super()._impact(mirrored)

    @property
    def _given_restitution(self) -> Restitution:
        # Between and above its floors it hits nothing behind: the number is that of the floors.
        rocks_freely = self.behind == "floors" and not self.one_sided
        return None if rocks_freely else self.restitution

    def stack(self, courses: int | None = None) -> Stack:
        """Return all above the crack as one body where it is known and nothing holds the wall, else courses.

        They end at the feet of storeys and where something holds the wall; of a wall that is held there are by default
        COURSES a storey, as it bulges within one.
        """
        bulges = bool(self.held_wall.holds)
        if courses is None and self.crack_is_known and self.opening is None and not bulges:
            body = [joined(list(self._storey_courses(1, self.crack_position)))]
        else:
            storeys = len(self.storey_heights) if bulges and courses is None else 1
            number = min(storeys * counted_courses(courses), MOST_COURSES // 2)
            body = list(self._storey_courses(number))
        return self._stacked(body)

    def _slab(self, load: Load) -> Course:
        self._check_slab("loads_held")
        aside = self._aside * load.z
        return slab(aside - self.thicknesses[-1], aside, load.z, load.weight, upright=True)

    def _placed(self, height: float) -> dict[str, Any]:
        foot = np.flatnonzero(self.levels[:-1] == height)
        if foot.size:
            return {"crack_storey": int(foot[0]) + 1, "crack_height": None}
        return {"crack_storey": None, "crack_height": height}

    def _dimensions(self) -> dict[str, list[Path]]:
        levels = self.levels
        apart = [0.12 * self.height, 0.0]
        middles = zip(self.thicknesses, (levels[1:] + levels[:-1]) / 2, strict=True)
        paths: dict[str, list[Path]] = {
            "storey_heights": [span([0.0, low], [0.0, high], apart) for low, high in pairwise(levels)],
            "thicknesses": [span([-thickness, z], [0.0, z]) for thickness, z in middles],
        }
        if self.crack_height:
            paths["crack_height"] = [span([0.0, 0.0], [0.0, self.crack_height], [0.06 * self.height, 0.0])]
        return paths


def behind_leaf(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options of a leaf alone as a façade takes them: the leaf that it leans on stands behind it."""
    others = {name: value for name, value in options.items() if name != "one_sided"}
    return {"behind": "cross_walls" if options["one_sided"] else None, **others}
