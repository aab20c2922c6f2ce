"""Rigid bodies that rock about a corner (theory: section 2): rectangular block (Housner 1963), spire, any other."""

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np

from rocking.errors import StructureError
from rocking.structures.crackable import CrackedAtHeight, Crushable, unplaced
from rocking.structures.drawing import Path, rectangle, span, swept
from rocking.structures.fields import (
    Lean,
    OneSided,
    OptionalUnitWeight,
    Value,
    count,
    form_made_by,
    length,
    restitution_value,
    stated,
)
from rocking.structures.linkage import PRESSED, STILL, Parts, Restitution, Turning, check_pressed, inset
from rocking.structures.stack import MOST_COURSES, Course, Stack, counted_courses, courses_between

Balanced = Annotated[Restitution, restitution_value("momentum", "housner")]


@stated
@dataclass(frozen=True, repr=False)
class Block(Crushable):
    """A homogeneous rectangular block that rocks about its two bottom corners.

    Its "momentum" and "housner" are the same balance, 1 − 1.5 sin²α, the default. A one-sided block leans on something
    that no balance of the block alone describes, so it needs a number.

    Examples
    --------
    >>> rocking.Block(semi_diagonal=2.0, slenderness=0.2).mechanism()
    Mechanism(λ = 0.2027, φ_cr = 0.2 rad, p = 1.918 rad/s, η = 0.9408)
    """

    type_name: ClassVar[str] = "block"
    _described_as: ClassVar[dict[str, str]] = {
        "of_size": "Rectangular block by its size",
        "": "Rectangular block by half its diagonal and its slenderness",
    }

    semi_diagonal: Annotated[
        float, length("Half the diagonal", 2.0, (0.05, 50), "R", phrase="semi-diagonal {value}")
    ]
    slenderness: Annotated[
        float,
        Value(
            "Angle between the vertical and the diagonal", 10.0, "°", (1, 45), "α", bounds={"gt": 0, "lt": 90}
        ),
    ]
    restitution: Balanced = None
    one_sided: OneSided = False
    unit_weight: OptionalUnitWeight = field(default=None, kw_only=True)
    lean: Lean = field(default=0.0, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.lean:
            self.mechanism()  # one that leans beyond its foot is refused at birth
        self._stand_crushed()

    @classmethod
    def of_size(
        cls,
        breadth: Annotated[float, length("Breadth", 0.6, (0.02, 20), "b")],
        height: Annotated[float, length("Height", 4.0, (0.1, 100), "h")],
        restitution: Restitution = None,
        one_sided: bool = False,
        **options: Any,
    ) -> Self:
        """Return the block of that breadth and height [m]; the others as for the class."""
        form_made_by(cls, "of_size").check(breadth=breadth, height=height)
        half = np.hypot(breadth, height) / 2
        slenderness = np.arctan2(breadth, height)
        return cls(half, slenderness, restitution, one_sided, **options)

    @property
    def symmetric(self) -> bool:
        """Whether it stands in plumb."""
        return not self.lean

    @property
    def breadth(self) -> float:
        """2R sin α, m."""
        result: float = 2 * self.semi_diagonal * np.sin(self.slenderness)
        return result

    @property
    def height(self) -> float:
        """2R cos α, m."""
        result: float = 2 * self.semi_diagonal * np.cos(self.slenderness)
        return result

    def _linkage(self, mirrored: bool) -> Turning:
        inertia = (self.breadth**2 + self.height**2 * (1 + np.tan(self.lean) ** 2)) / 12
        weight = (self.unit_weight or 0.0) * self.breadth * self.height
        aside = inset(pressing=weight, strength=self.compressive_strength, breadth=self.breadth)
        centre = (1j + np.tan(-self.lean if mirrored else self.lean)) * self.height / 2
        return Turning(
            self.breadth / 2 - aside,
            Parts([1.0], [centre], [inertia]),
            slenderness=None if aside or self.lean else self.slenderness,
        )

    def _edges(self, level: float) -> tuple[float, float]:
        """The faces at a level, m."""
        aside = float(np.tan(self.lean)) * level
        return aside - self.breadth / 2, aside + self.breadth / 2

    def stack(self, courses: int | None = None) -> Stack:
        """Return it as one body, or as so many drums."""
        number = 1 if courses is None else counted_courses(courses)
        levels = np.linspace(0.0, self.height, number + 1).tolist()
        drums = courses_between(levels, [self._edges(level) for level in levels], 1.0, [1.0] * number)
        return Stack(drums, self._behind(drums))

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        outline = rectangle(-self.breadth / 2, self.breadth / 2, 0.0, self.height)
        return [(0, outline + np.tan(self.lean) * outline.imag)]

    def _dimensions(self) -> dict[str, Path | list[Path]]:
        half = self.breadth / 2
        height = self.height
        apart = 0.06 * self.height
        foot = np.array([half, 0.0])
        return {
            "breadth": span([-half, height], [half, height], [0.0, apart]),
            "height": span([-half, 0.0], [-half, height], [-apart, 0.0]),
            "semi_diagonal": span(foot, [0.0, height / 2]),
            "slenderness": swept(foot, 0.7 * self.semi_diagonal, -self.slenderness, 0.0),
        }


@stated
@dataclass(frozen=True, repr=False)
class RigidBody(Crushable):
    """A body known by its centre of mass and inertia; it rocks about the right corner on the positive side.

    Its outline is not known, so each side is followed until the centre of mass is level with the corner. "momentum" and
    "housner" are one balance, of angular momentum about the corner to come, which differs from side to side.

    Examples
    --------
    >>> body = rocking.RigidBody(left=0.4, right=0.6, centre_height=1.5, inertia=1.0)
    >>> body.mechanism().negative
    Side(λ = 0.2667, φ_cr = 0.2606 rad, p = 2.113 rad/s, η = 0.8338)
    """

    type_name: ClassVar[str] = "rigid_body"
    _described_as: ClassVar[dict[str, str]] = {
        "": "Any body by its centre of mass and its inertia about it per mass"
    }

    left: Annotated[float, length("Distance of the left corner", 0.4, (0.01, 20), "l")]
    right: Annotated[float, length("Distance of the right corner", 0.6, (0.01, 20), "r")]
    centre_height: Annotated[float, length("Height of the centre of mass", 2.0, (0.05, 50), "z")]
    inertia: Annotated[
        float,
        Value(
            "Inertia about the centre of mass per mass",
            1.5,
            "m²",
            (1e-4, 1e3),
            bounds={"ge": 1e-8, "le": 1e10},
        ),
    ]
    restitution: Balanced = None
    one_sided: OneSided = False
    height: Annotated[
        float | None,
        length("Height of its outline; left out: twice that of the centre of mass", 4.0, (0.05, 100), "h"),
    ] = field(default=None, kw_only=True)
    unit_weight: OptionalUnitWeight = field(default=None, kw_only=True)
    section: Annotated[
        float | None,
        Value(
            "Volume per metre of the edge about which it turns; needed where a compressive strength is given",
            4.0,
            "m²",
            (1e-3, 1e3),
            bounds={"ge": 1e-8, "le": 1e10},
        ),
    ] = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        said = f" m, but must be above the centre of mass, at {self.centre_height!r} m."
        self._demand(self.height is None or self.height > self.centre_height, "height", said)
        self._demand(
            self.compressive_strength is None or self.section is not None,
            "section",
            ", but must be given with a compressive_strength, for what presses on the edge follows from it; give the "
            "volume per metre of that edge, m².",
        )
        self._stand_crushed()

    @property
    def symmetric(self) -> bool:
        """Whether the centre of mass is in the middle."""
        return self.left == self.right

    def _linkage(self, mirrored: bool) -> Turning:
        """Until the centre of mass is level with the corner."""
        corner = self.left if mirrored else self.right
        pressing = (self.unit_weight or 0.0) * (self.section or 0.0)
        # The other edge may lie wherever it does: what is pressed ends below the centre of mass, or it does not stand.
        corner -= inset(pressing=pressing, strength=self.compressive_strength, breadth=2 * corner)
        centre = 1j * self.centre_height
        end = np.arctan2(corner, self.centre_height) + np.pi / 2
        return Turning(corner, Parts([1.0], [centre], [self.inertia]), end_rotation=float(end))

    def stack(self, courses: int | None = None) -> Stack:
        """Return it as one body, as high as twice its centre of mass, for its courses are not known."""
        if courses not in (None, 1):
            raise StructureError(
                f"courses is {courses!r}, but must be 1 for a body that is known by its centre of mass only; leave "
                "it out.",
                courses=courses,
            )
        face = (-self.left, self.right)
        body = Course(
            bottom=face,
            top=face,
            base=0.0,
            height=2 * self.centre_height,
            mass=1.0,
            centre=(0.0, self.centre_height),
            inertia=self.inertia,
        )
        return Stack((body,), self._behind((body,)))

    @property
    def _outline_height(self) -> float:
        return 2 * self.centre_height if self.height is None else self.height

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        """A parallelogram with these corners, about this centre of mass, for want of the true outline."""
        top = 1j * self._outline_height
        return [(0, np.array([-self.left, self.right, self.left + top, -self.right + top]))]

    def _dimensions(self) -> dict[str, Path | list[Path]]:
        apart = np.array([0.0, -0.12 * self.centre_height])
        centre = [0.0, self.centre_height]
        return {
            "left": span([-self.left, 0.0], [0.0, 0.0], apart),
            "right": span([0.0, 0.0], [self.right, 0.0], 2 * apart),
            "centre_height": span([0.0, 0.0], centre),
            "base": span([-self.left, 0.0], [self.right, 0.0], apart),
            "height": span([-self.left, 0.0], [-self.left, self._outline_height], apart[::-1]),
        }


_SECTION = {"circular": np.pi, "square": 4.0}
"""Area of a horizontal section over the square of its half width."""
_SECTION_SPREAD = {"circular": 1 / 4, "square": 1 / 3}
"""Mean square of one horizontal coordinate over a section, in squares of its half width."""


def _strip(plan: str, half_width: float, depth: float) -> np.ndarray:
    """Area of a section up to a `depth` [m] from its edge, m², and its first moment about that edge, m³."""
    depth = min(max(depth, 0.0), 2 * half_width)
    if plan == "square":
        return 2 * half_width * np.array([depth, depth**2 / 2])
    angle = np.arccos(1 - depth / half_width)
    area = half_width**2 * (angle - np.sin(2 * angle) / 2)
    about_centre = 2 / 3 * (half_width * np.sin(angle)) ** 3
    return np.array([area, half_width * area - about_centre])


@stated
@dataclass(frozen=True, repr=False)
class Spire(CrackedAtHeight):
    """A cone (plan "circular") or a square pyramid ("square") that rocks about the edge of a horizontal crack.

    Raises
    ------
    StructureError
        When it cannot stand, or the crack lies outside it.

    Examples
    --------
    >>> rocking.Spire(width=3.0, height=15.0, wall_thickness=0.25, crack_height=5.0).mechanism()
    Mechanism(λ = 0.3383, φ_cr = 0.3262 rad, p = 1.458 rad/s, η = 0.861)
    """

    type_name: ClassVar[str] = "spire"
    crack_name: ClassVar[str] = "crack"
    _described_as: ClassVar[dict[str, str]] = {
        "": "Cone or square pyramid, solid or hollow, that rocks above a horizontal crack"
    }

    width: Annotated[float, length("Diameter or side at the base", 3.0, (0.2, 20), "b")]
    height: Annotated[float, length("Height of the whole spire", 15.0, (0.5, 100), "h")]
    wall_thickness: Annotated[
        float | None, length("Horizontal thickness of the wall of a hollow one", 0.25, (0.05, 3), "t")
    ] = None
    plan: Annotated[
        Literal["circular", "square"],
        Value("Shape of a horizontal section", "circular", phrase="{value} plan"),
    ] = "circular"
    crack_height: Annotated[
        float | None, Value("Height of the crack above the base", 5.0, "m", (0, 95), "z")
    ] = None
    restitution: Balanced = None
    one_sided: OneSided = False
    courses: Annotated[
        int | None,
        count("Number of courses of the masonry, for contact dynamics; left out: 6", 10, 1, MOST_COURSES),
    ] = None
    unit_weight: OptionalUnitWeight = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        said = (
            f" m, but must be less than half the width, {self.width / 2!r} m; leave it out for a solid spire."
        )
        self._demand((self.wall_thickness or 0.0) < self.width / 2, "wall_thickness", said)
        if self.crack_is_known and self.crack_height is None:
            raise unplaced("crack_height")
        said = f" m, but must lie on the spire, from 0 to below its height of {self.height!r} m."
        self._demand(self.crack_position < self.height, "crack_height", said)
        self._stand_crushed()

    @property
    def crack_position(self) -> float:
        """Height of the crack, m; the foot where none is given."""
        return 0.0 if self.crack_height is None else self.crack_height

    @property
    def half_width(self) -> float:
        """Half the width at the crack, m."""
        return self.width / 2 * (1 - self.crack_position / self.height)

    def _linkage(self, mirrored: bool) -> Turning:
        """All above the crack, until the flank lies on the ground."""
        above = self._course(self.crack_position, self.height)
        return Turning(
            self.half_width - self._pressed_inset(above.mass) + 1j * self.crack_position,
            Parts([1.0], [1j * above.centre[1]], [above.inertia / above.mass]),
            end_rotation=float(np.pi - np.arctan2(2 * self.height, self.width)),
        )

    def _pressed_inset(self, volume: float) -> float:
        """How far the edge of the crack moves in below a `volume` [m³], m: to the middle of what is pressed."""
        if self.compressive_strength is None or self.unit_weight is None:
            return 0.0
        from scipy.optimize import brentq  # slow to import, and needed here only

        outer = self.half_width
        inner = max(outer - (outer if self.wall_thickness is None else self.wall_thickness), 0.0)
        area = _SECTION[self.plan]
        pressed = self.unit_weight * volume / (PRESSED * self.compressive_strength)
        check_pressed(pressed=pressed, whole=area * (outer**2 - inner**2))

        def strip(depth: float) -> np.ndarray:
            hollow = _strip(self.plan, inner, depth - (outer - inner)) if inner else np.zeros(2)
            solid: np.ndarray = (
                _strip(self.plan, outer, depth) - hollow - np.array([0.0, (outer - inner) * hollow[0]])
            )
            return solid

        depth = brentq(lambda depth: strip(depth)[0] - pressed, 0.0, 2 * outer, xtol=1e-15, rtol=1e-14)
        found = strip(depth)
        return float(found[1] / found[0])

    @property
    def _joints_do(self) -> dict[str, Any]:
        return {"courses_taper": True, "courses_are_given": self.courses is not None}

    def stack(self, courses: int | None = None) -> Stack:
        """Return the courses above the crack where it is known, else all of them; their number as given, or its own."""
        number = counted_courses(self.courses if courses is None else courses)
        foot = self.crack_position if self.crack_is_known else 0.0
        levels = np.linspace(foot, self.height, number + 1)
        courses_above = tuple(self._course(*ends) for ends in pairwise(levels.tolist()))
        return Stack(courses_above, self._behind(courses_above))

    def _course(self, low: float, high: float) -> Course:
        """The part between two heights [m]; its mass is its volume."""
        slope = self.width / (2 * self.height)
        half_widths = [slope * (self.height - level) for level in (low, high)]
        moments = self._slice(low, high, 0.0)
        if self.wall_thickness is not None:
            moments = moments - self._slice(low, high, self.wall_thickness)
        mass, first, second, across = moments
        centre = first / mass
        inertia = (second + across) / mass - centre**2
        bottom, top = ((-half, half) for half in half_widths)
        return Course(
            bottom=bottom,
            top=top,
            base=low,
            height=high - low,
            mass=float(mass),
            centre=(0.0, float(low + centre)),
            inertia=float(mass * inertia),
        )

    def _slice(self, low: float, high: float, inset: float) -> np.ndarray:
        """Volume and integrals of z, z² (from `low`) and x² of the solid whose surface lies `inset` [m] inwards."""
        slope = self.width / (2 * self.height)
        end = min(high, self.height - inset / slope)
        if end <= low:
            return np.zeros(4)
        nodes, weights = np.polynomial.legendre.leggauss(3)  # exact for the polynomials of degree 4 here
        z = (end - low) / 2 * (nodes + 1)
        areas = (
            (end - low) / 2 * weights * _SECTION[self.plan] * (slope * (self.height - low - z) - inset) ** 2
        )
        squares = (slope * (self.height - low - z) - inset) ** 2 * _SECTION_SPREAD[self.plan]
        return np.array([areas.sum(), areas @ z, areas @ z**2, areas @ squares])

    def _placed(self, height: float) -> dict[str, Any]:
        return {"crack_height": height}

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        base = self.width / 2
        half = self.half_width
        crack = 1j * self.crack_position
        top = np.array([-half + crack, half + crack, 1j * self.height])
        still = np.array([-base, base, half + crack, -half + crack])
        return [(STILL, still), (0, top)][0 if self.crack_position else 1 :]

    def _dimensions(self) -> dict[str, Path]:
        half = self.width / 2
        apart = 0.06 * self.height
        paths = {
            "width": span([-half, 0.0], [half, 0.0], [0.0, -apart]),
            "height": span([-half, 0.0], [-half, self.height], [-apart, 0.0]),
        }
        if self.crack_height:
            paths["crack_height"] = span([half, 0.0], [half, self.crack_height], [apart, 0.0])
        if self.wall_thickness is not None:
            paths["wall_thickness"] = span([half - self.wall_thickness, 0.0], [half, 0.0])
        return paths
