"""Parts of buildings by the names of practice: rows over block, rigid_body and spire, without classes of their own.

Each is a height and the thickness over which it rocks; its breadth across shows its front.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from rocking.errors import SizeError
from rocking.structures.block import Block, RigidBody, Spire
from rocking.structures.crackable import USUAL_WEIGHT
from rocking.structures.facade import Facade, behind_leaf
from rocking.structures.fields import Field, Form, constructor, field_of, length
from rocking.structures.leaves import Leaf, Leaved
from rocking.structures.structure import Structure

Sizes = Mapping[str, Any]
"""Sizes in SI by name: height, thickness, breadth and, of a chimney, wall_thickness; None where left out."""
_SIZES = ("height", "thickness", "breadth", "wall_thickness")


@dataclass(frozen=True, repr=False)
class FreeWall(Block, Leaved):
    """A block whose leaves may part, which a file describes as one of the rows."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check_leaves()

    @property
    def _sections(self) -> tuple[tuple[float, float, float, float], ...]:
        return ((0.0, self.height, -self.breadth / 2, self.breadth / 2),)

    def _alone(self, leaf: Leaf) -> Structure:
        options: dict[str, Any] = {**_of_leaf(self), **self._stands_as(leaf)}
        if self.bonder_heights:
            return _bonded(self.height, leaf, self.bonder_heights, options)
        return Block.of_size(leaf.thickness, self.height, **options)


@dataclass(frozen=True, repr=False)
class Gable(RigidBody, Leaved):
    """The body of a gable whose leaves may part, which a file describes as a row."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check_leaves()

    @property
    def _sections(self) -> tuple[tuple[float, float, float, float], ...]:
        return ((0.0, self._outline_height, -self.left, self.right),)

    def _alone(self, leaf: Leaf) -> Structure:
        options: dict[str, Any] = {**_of_leaf(self), **self._stands_as(leaf)}
        height = self._outline_height
        if self.bonder_heights:
            return _bonded(height, leaf, self.bonder_heights, {**options, "narrows": True})
        body: dict[str, Any] = _triangle({"height": height, "thickness": leaf.thickness})
        return RigidBody(**body, **options)


def _of_leaf(wall: Block | RigidBody) -> dict[str, Any]:
    """The options of a wall that each of its leaves has."""
    names = ("restitution_range", "compressive_strength", "unit_weight", "lean")
    return {name: getattr(wall, name) for name in names if hasattr(wall, name)}


def _bonded(height: float, leaf: Leaf, heights: tuple[float, ...], options: dict[str, Any]) -> Facade:
    """A leaf that bonders hold at `heights` [m] and whose top is free."""
    weight = options.pop("unit_weight") or USUAL_WEIGHT
    return Facade((height,), (leaf.thickness,), weight, held_at=heights, **behind_leaf(options))


@dataclass(frozen=True)
class BuildingPart(Form):
    """A row: a type that is described by its own sizes and made of a class.

    arguments: those of `made_of` from the sizes. front: the shape seen from the front.
    """

    arguments: Callable[[Sizes], Mapping[str, object]] = field(kw_only=True)
    front: Literal["rectangle", "triangle"] = field(kw_only=True)

    def construct(self, **values: Any) -> Structure:
        """Return the structure of sizes and options by name, in SI; raises StructureError where it cannot stand."""
        sizes = {key.name: values.pop(key.name, None) for key in self.fields if key.name in _SIZES}
        self.check(**{name: size for name, size in sizes.items() if size is not None})
        structure: Structure = super().construct(**self.arguments(sizes), **values)
        return structure

    def front_of(self, sizes: Sizes) -> np.ndarray:
        """Return its front (k, 2), m, to the right of the section; (0, 2) where its breadth is not known."""
        height = sizes["height"]
        breadth = sizes.get("breadth")
        if breadth is None and self.front == "rectangle":
            return np.empty((0, 2))
        # A gable of which nobody said how broad it is: under a roof of 45°.
        across = 2 * height if breadth is None else breadth
        left = 1.5 * sizes["thickness"] + 0.15 * height
        corners = [[left, 0.0], [left + across, 0.0], [left + across, height], [left, height]]
        if self.front == "triangle":
            corners[2:] = [[left + across / 2, height]]
        return np.array(corners)

    def __reduce__(self) -> tuple[Any, ...]:
        return building_part, (self.type_name,)


def building_part(name: str) -> BuildingPart:
    """Return the row of that type."""
    return PARTS[name]


def _wide(sizes: Sizes) -> dict[str, object]:
    """The arguments of a block."""
    return {"breadth": sizes["thickness"], "height": sizes["height"]}


def _triangle(sizes: Sizes) -> dict[str, object]:
    """The arguments of a body as thick all over, its front a triangle: centre of mass at h/3, inertia h²/18 + t²/12."""
    half = sizes["thickness"] / 2
    height = sizes["height"]
    return {
        "left": half,
        "right": half,
        "centre_height": height / 3,
        "inertia": height**2 / 18 + half**2 / 3,
        "height": height,
        "section": half * height,
    }


def _shaft(sizes: Sizes) -> dict[str, object]:
    """The arguments of a rectangular shaft of its outer sizes, solid or with a flue."""
    thickness = sizes["thickness"]
    height = sizes["height"]
    breadth = sizes["breadth"] or thickness
    walls = sizes["wall_thickness"]
    area = breadth * thickness
    second_moment = area * thickness**2 / 12
    if walls is not None:
        flue = thickness - 2 * walls
        across = breadth - 2 * walls
        if min(flue, across) <= 0:
            raise SizeError.of(
                "wall_thickness",
                repr(walls),
                f" m, but must be less than half the smaller outer size, "
                f"{min(thickness, breadth) / 2!r} m; leave it out for a solid chimney.",
            )
        area -= across * flue
        second_moment -= across * flue**3 / 12
    return {
        "left": thickness / 2,
        "right": thickness / 2,
        "centre_height": height / 2,
        "inertia": height**2 / 12 + second_moment / area,
        "section": area / breadth * height,
    }


def _pyramid(sizes: Sizes) -> dict[str, object]:
    """The arguments of a solid pyramid, whose breadth does not change how it rocks over its thickness."""
    return {"width": sizes["thickness"], "height": sizes["height"], "plan": "square"}


def _part(
    name: str,
    meaning: str,
    made_of: type[Structure],
    arguments: Callable[[Sizes], Mapping[str, object]],
    *,
    height: tuple[float, float, float],
    thickness: tuple[float, float, float],
    breadth: tuple[float, float, float],
    breadth_meaning: str = "Length across, for the drawing of its front",
    more: tuple[Field, ...] = (),
    crack: float | None = None,
    front: Literal["rectangle", "triangle"] = "rectangle",
) -> BuildingPart:
    """Return a row; of each size an example and the usual range, m. Its options are those of the class.

    crack: an example of the height of its crack, m.
    """
    across = next(size for kind, size in _ACROSS.items() if issubclass(made_of, kind))
    sizes = (
        field_of("height", float, length("Height", height[0], height[1:], "h")),
        field_of(
            "thickness",
            float,
            length("Thickness, over which it rocks", thickness[0], thickness[1:], "t", dimension=across),
        ),
        field_of(
            "breadth",
            float | None,
            length(breadth_meaning, breadth[0], breadth[1:], "b", dimension="front"),
            None,
        ),
    )
    own = {*_SIZES, *arguments({"height": 2.0, "thickness": 0.5, "breadth": 1.0, "wall_thickness": None})}
    options = tuple(
        replace(option, value=replace(option.value, example=crack))
        if option.name == "crack_height"
        else option
        for option in constructor(made_of).fields
        if not option.required and option.name not in own
    )
    return BuildingPart(
        name,
        meaning,
        (*sizes, *more, *options),
        made_of,
        "of_size" if issubclass(made_of, Block) else "",
        arguments=arguments,
        front=front,
    )


_ACROSS: dict[type[Structure], str] = {Block: "breadth", RigidBody: "base", Spire: "width"}
"""The dimension over which a body of a class rocks."""
_FLUE = field_of(
    "wall_thickness",
    float | None,
    length("Thickness of its walls about the flue; left out: solid", 0.12, (0.05, 1)),
    None,
)

PARTS: dict[str, BuildingPart] = {
    part.type_name: part
    for part in (
        _part(
            "free_wall",
            "Wall that stands free, held by nothing at its top, such as a boundary wall",
            FreeWall,
            _wide,
            height=(2.0, 0.3, 20),
            thickness=(0.3, 0.05, 3),
            breadth=(3.0, 0.2, 200),
        ),
        _part(
            "parapet",
            "Parapet, a wall free at its top along the edge of a roof or a balcony",
            FreeWall,
            _wide,
            height=(1.0, 0.2, 4),
            thickness=(0.25, 0.05, 1),
            breadth=(3.0, 0.2, 200),
        ),
        _part(
            "chimney",
            "Rectangular chimney by its outer sizes, solid or with a flue",
            RigidBody,
            _shaft,
            height=(2.5, 0.3, 40),
            thickness=(0.6, 0.1, 5),
            breadth=(0.9, 0.1, 5),
            breadth_meaning="Outer length across, of which the walls about the flue are a part; left out: square",
            more=(_FLUE,),
        ),
        _part(
            "gable",
            "Gable, a triangular wall that falls out of its plane, held by no roof",
            Gable,
            _triangle,
            height=(3.0, 0.5, 15),
            thickness=(0.4, 0.05, 2),
            breadth=(7.0, 0.5, 40),
            front="triangle",
        ),
        _part(
            "buttress",
            "Buttress alone, as a rectangular block, that falls along its thickness",
            Block,
            _wide,
            height=(5.0, 0.5, 40),
            thickness=(1.2, 0.1, 8),
            breadth=(0.8, 0.1, 8),
        ),
        _part(
            "pinnacle",
            "Pinnacle, a solid pyramid; with a base that rocks it may fall where alone it stands",
            Spire,
            _pyramid,
            height=(3.0, 0.3, 20),
            thickness=(0.7, 0.1, 5),
            breadth=(0.7, 0.1, 5),
            crack=1.0,
            front="triangle",
        ),
    )
}
"""The rows by their type."""
