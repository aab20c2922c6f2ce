"""Walls whose leaves may part: what is said of them, and each leaf as a structure of its own (theory: section 13.1)."""

import warnings
from abc import abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from typing import Annotated, Any, ClassVar, Literal, NamedTuple

import numpy as np

from rocking.errors import DoesNotStandError, StructureWarning
from rocking.structures.drawing import Dimension, Mark, plane, rectangle, span
from rocking.structures.fields import Value, length
from rocking.structures.kinds import StructureKind
from rocking.structures.structure import LeafAlone, Structure
from rocking.warnings import RockingWarning

LEAVES = {2: ("outer leaf", "inner leaf"), 3: ("outer leaf", "middle leaf", "inner leaf")}
"""What leaves are called from outside in, by their number."""
_SAME = 1e-9
"""Share of a size below which two are the same."""


class Leaf(NamedTuple):
    """One leaf of a wall.

    thickness: m. is_inner: whether it is the innermost one, behind which stands what stands behind the wall. moves: to
    both sides, or only away from its neighbour.
    """

    name: str
    thickness: float
    is_inner: bool
    moves: Literal["both ways", "outwards", "inwards"]


@dataclass(frozen=True, repr=False)
class Leaved(Structure):
    """A wall whose leaves may part, so that each is one more way in which it falls.

    leaves: the thickness of each from outside in, m, two or three; () for one leaf. bonders: the heights above the
    ground at which through-stones hold each leaf, m, or their spacing, counted down from the top, so that the uppermost
    part stands free over all of it. thrown_back: the restitution of the impact of a leaf on the one next to it; None:
    each rocks both ways, with the restitution of its own geometry.
    """

    _as_one_leaf: ClassVar[dict[str, Any]] = {"leaves": (), "bonders": None, "thrown_back": None}

    leaves: Annotated[
        tuple[float, ...],
        length(
            "Thickness of each leaf of the masonry from outside in, two or three, where they may part; left out: it is "
            "taken as one leaf",
            [0.12, 0.12],
            (0.05, 1.5),
            "l",
        ),
    ] = field(default=(), kw_only=True)
    bonders: Annotated[
        float | tuple[float, ...] | None,
        length(
            "Heights above the ground at which bonders (through-stones) hold each leaf, or one spacing of theirs, "
            "counted down from the top; needs leaves",
            0.8,
            (0.2, 20),
            phrase="bonders every or at {value}",
        ),
    ] = field(default=None, kw_only=True)
    thrown_back: Annotated[
        float | None,
        Value(
            "Restitution of the impact of a leaf on the one next to it, which throws it back; left out: each leaf "
            "rocks both ways",
            0.5,
            usual=(0.1, 1),
            bounds={"ge": 0, "le": 1},
        ),
    ] = field(default=None, kw_only=True)

    @property
    @abstractmethod
    def _sections(self) -> tuple[tuple[float, float, float, float], ...]:
        """The rectangles of its section from the ground up: foot, top, inner and outer face, m."""

    @abstractmethod
    def _alone(self, leaf: Leaf) -> Structure:
        """Return a leaf as a structure of its own, which stands as the wall does but for its thickness and loads."""

    @property
    def _leans(self) -> bool:
        """Whether something stands behind it all along, so that nothing of it falls inwards."""
        return bool(self.one_sided)

    @property
    def _leaf_top(self) -> float:
        return self._sections[-1][1]

    @property
    def bonder_heights(self) -> tuple[float, ...]:
        """The heights above the ground at which bonders hold its leaves, m."""
        if not isinstance(self.bonders, float):
            return tuple(sorted(set(self.bonders or ())))
        top = self._leaf_top
        count = int(np.ceil(top / self.bonders * (1 - _SAME))) - 1
        return tuple(top - self.bonders * place for place in range(count, 0, -1))

    def _check_leaves(self) -> None:
        """Refuse leaves that are no part of the wall, and what is said of none."""
        if not self.leaves:
            for name in ("bonders", "thrown_back"):
                said = ", but says what holds the leaves of a wall; give the thickness of each, leaves_m."
                self._demand(getattr(self, name) is None, name, said)
            return
        leaves = list(self.leaves)
        said = " m, but must be two or three thicknesses, from outside in; leave it out for one leaf."
        self._demand(len(leaves) in LEAVES, "leaves", said, leaves)
        thinnest = min(outer - inner for _, _, inner, outer in self._sections)
        said = f" m, but must add up to no more than the thickness of the wall, {thinnest:.6g} m."
        self._demand(sum(leaves) <= thinnest * (1 + _SAME), "leaves", said, leaves)
        top = self._leaf_top
        said = f" m, but must be a spacing below the height of the wall, {top:.6g} m, or a list of heights."
        self._demand(not isinstance(self.bonders, float) or self.bonders < top, "bonders", said)
        said = f" m, but must lie on the wall, above 0 and up to {top:.6g} m."
        for height in self.bonder_heights:
            self._demand(0 < height <= top * (1 + _SAME), "bonders", said, height)
        _ = self.leaves_alone  # one that is pushed over at rest is refused at birth

    @cached_property
    def leaves_alone(self) -> tuple[LeafAlone, ...]:
        alone = []
        names = LEAVES.get(len(self.leaves), ())
        for name, thickness in zip(names, self.leaves, strict=False):
            leaf = Leaf(name, thickness, name == names[-1], "both ways")
            if self.thrown_back is not None:
                if name == "middle leaf" or (leaf.is_inner and self._leans):
                    continue  # it cannot leave its place
                leaf = leaf._replace(moves="inwards" if leaf.is_inner else "outwards")
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", StructureWarning)  # nobody asked for its restitution
                    structure = self._alone(leaf)
                    structure.mechanism()
                alone.append(LeafAlone(name, structure))
            except DoesNotStandError as wrong:
                raise DoesNotStandError(
                    f"leaves is {list(self.leaves)!r} m, but the {name} alone does not stand under its loads at rest; "
                    "correct its loads or its sizes.",
                    leaves=self.leaves,
                ) from wrong
        return tuple(alone)

    def _stands_as(self, leaf: Leaf) -> dict[str, Any]:
        """The options of a leaf that say how it rocks: away from its neighbour, as the wall does, or freely."""
        if leaf.moves != "both ways":
            return {"one_sided": True, "restitution": self.thrown_back}
        if leaf.is_inner and self._leans:
            return {"one_sided": True, "restitution": self._given_restitution}
        return {"one_sided": False, "restitution": None}

    @property
    def assumptions(self) -> tuple[RockingWarning, ...]:
        """What is taken for granted, and that its leaves do not part where nothing is said of them."""
        if self.leaves or "leaves" not in {key.name for key in self.described.form.fields}:
            return super().assumptions
        thicknesses = sorted({outer - inner for _, _, inner, outer in self._sections}, reverse=True)
        shown = ", ".join(f"{thickness:.4g}" for thickness in thicknesses)
        return (*super().assumptions, RockingWarning.of(StructureKind.ONE_LEAF, "", thickness=shown))

    def marks(self, rotation: float = 0.0) -> tuple[Mark, ...]:
        """Return also, at rest, the faces between its leaves and the bonders that hold these."""
        if rotation or not self.leaves:
            return super().marks(rotation)
        marks = []
        for foot, top, inner, outer in self._sections:
            faces = [face for pair in self._faces(inner, outer) for face in pair]
            marks += [Mark("leaf", "", np.array([[face, foot], [face, top]])) for face in faces[1:-1]]
            marks += [
                Mark("bonder", "", np.array([[inner, height], [outer, height]]))
                for height in self.bonder_heights
                if foot < height <= top
            ]
        return (*super().marks(rotation), *marks)

    def _faces(self, inner: float, outer: float) -> list[tuple[float, float]]:
        """The outer and the inner face of each leaf from outside in, m; what the wall is thicker lies between them."""
        gap = (outer - inner - sum(self.leaves)) / (len(self.leaves) - 1)
        faces = []
        for thickness in self.leaves:
            faces.append((outer, outer - thickness))
            outer -= thickness + gap
        return faces

    def dimensions(self) -> tuple[Dimension, ...]:
        """Return also that of the thickness of each leaf, one below the other as their letters are broader."""
        if not self.leaves:
            return super().dimensions()
        _, _, inner, outer = self._sections[0]
        faces = self._faces(inner, outer)
        apart = -0.06 * self._leaf_top
        of_leaves = [
            span([low, 0.0], [high, 0.0], [0.0, place * apart])
            for place, (high, low) in enumerate(faces, start=1)
        ]
        return self.described.dimensions({**self._dimensions(), "leaves": of_leaves})


def parts_of(structure: Structure) -> tuple[LeafAlone, ...]:
    """Return what falls by itself: the structure, under no name, and each of its leaves that may part."""
    return LeafAlone("", structure), *structure.leaves_alone


def beside(structure: Structure, leaf: str) -> list[np.ndarray]:
    """Return the outlines (k, 2) of its other leaves at rest, m, as a leaf of that name sees them alone."""
    alone = dict(structure.leaves_alone).get(leaf)
    if alone is None or not isinstance(structure, Leaved):
        return []
    place = LEAVES[len(structure.leaves)].index(leaf)
    own_face = max(float(outline[:, 0].max()) for outline in alone.outline())
    outlines = []
    for foot, top, inner, outer in structure._sections:
        faces = structure._faces(inner, outer)
        aside = own_face - faces[place][0]
        outlines += [
            plane(rectangle(low + aside, high + aside, foot, top))
            for number, (high, low) in enumerate(faces)
            if number != place
        ]
    return outlines
