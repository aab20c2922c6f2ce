"""Structures that carry loads and a row of ties: how a file describes these, how they must be, what is said of them."""

import math
import warnings
from abc import abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np

from rocking.errors import DoesNotStandError, StructureError, StructureWarning
from rocking.quantities import GRAVITY
from rocking.structures.crackable import CrackedAtHeight
from rocking.structures.drawing import Mark, plane
from rocking.structures.fields import Value
from rocking.structures.held_wall import LEAST_STIFFNESS, Chain, HeldWall, Hold, Load, Opening, Storey, TieRow
from rocking.structures.kinds import StructureKind
from rocking.structures.leaves import Leaf, Leaved
from rocking.structures.linkage import (
    GRIPPED,
    STILL,
    Linkage,
    MotionState,
    Reaction,
    Restraint,
    UnknownContacts,
    inset,
)
from rocking.structures.mechanism import Tie
from rocking.structures.stack import (
    ROUGH,
    Course,
    Held,
    Stack,
    Stop,
    course_at,
    courses_between,
    joints_between,
    loaded,
)
from rocking.structures.structure import Candidate, Mechanisms, Structure
from rocking.warnings import Phrase, RockingWarning

UnitWeight = Annotated[float, Value("Weight of the masonry", 20.0, "kN/m³", (8, 30), bounds={"ge": 1e-6})]
Eccentricity = Annotated[
    float,
    Value("Distance of the bearing inwards from the middle of the wall", 0.05, "m", (-1, 1), bounds={}),
]
TopSlab = Annotated[
    Literal["hinged", "flat"],
    Value(
        "Whether the uppermost load rests on a bearing or as a slab that stays flat",
        "hinged",
        phrase="{value} top slab",
    ),
]


_SAME = 1e-6
"""Share of the height within which a joint is one at which something changes."""


FAR_APART = 3.0
"""Lengths of a unit between two ties beyond which the wall may fall between them: in limit analysis in three dimensions
the least λ is that of a wall held all along up to there, and goes down to that of the triangle beyond."""


@dataclass(frozen=True, repr=False)
class Tied(CrackedAtHeight, Leaved):
    """A structure with a row of equal ties, in SI and per metre of wall, each of which pulls inwards only.

    Rods have the stiffness E A/(L s), the strength f_y A/s and the pretension T/s. Ties hold each leaf without bonders
    as they hold the wall; a leaf that goes inwards alone is held by none.
    _of_loads: the fields that say what bears on it.
    opening: of one of its `mechanisms()`, in which alone it moves; held_at: the heights at which the rest of a wall
    holds this leaf of it to both sides, m; files give neither.
    """

    _of_loads: ClassVar[tuple[str, ...]]
    _as_one_leaf: ClassVar[dict[str, Any]] = {**Leaved._as_one_leaf, "loaded_leaf": None}
    tie_heights: Annotated[
        tuple[float, ...], Value("Heights of the ties above the ground", [1.6], "m", (0.2, 60), "z")
    ] = field(default=(), kw_only=True)
    tie_stiffness: Annotated[
        float, Value("Stiffness of each tie per metre of wall, kN/m per m", 50.0, "kN/m²", (1, 1e5), "k")
    ] = field(default=0.0, kw_only=True)
    tie_pretension: Annotated[
        float,
        Value("Force of each tie at rest; needs a wall that cannot move inwards", 0.0, "kN/m", (0, 200), "T"),
    ] = field(default=0.0, kw_only=True)
    tie_strength: Annotated[
        float | None,
        Value(
            "Force at which each tie yields, or breaks where no plastic elongation is given; elastic without it",
            40.0,
            "kN/m",
            (1, 500),
            "F",
            bounds={"gt": 0, "le": 1e30},
        ),
    ] = field(default=None, kw_only=True)
    tie_plastic_elongation: Annotated[
        float,
        Value(
            "By how much each tie yields at its strength before it breaks; 0 is brittle", 0.05, "m", (0, 0.5)
        ),
    ] = field(default=0.0, kw_only=True)
    tie_spacing: Annotated[
        float | None,
        Value(
            "Distance between the ties of a row along the wall; beyond three times the unit_length it may fall between "
            "them. Left out: they are taken to hold it all along",
            2.0,
            "m",
            (0.3, 12),
            phrase="ties every {value}",
            bounds={"ge": 0.05, "le": 1000},
        ),
    ] = field(default=None, kw_only=True)
    unit_length: Annotated[
        float | None,
        Value(
            "Length of the units of the masonry along the wall; needed with a tie_spacing",
            0.4,
            "m",
            (0.1, 1.5),
            bounds={"ge": 0.01, "le": 100},
        ),
    ] = field(default=None, kw_only=True)
    held_between: Annotated[
        Literal["floor"] | None,
        Value(
            "What holds the wall between its ties: floor, a stiff floor or a ring beam at their height",
            "floor",
            phrase="a {value} between its ties",
        ),
    ] = field(default=None, kw_only=True)
    rod_diameter: Annotated[
        float | None,
        Value(
            "Diameter of a steel rod, in place of stiffness, strength and pretension per metre; needs rod_length and "
            "tie_spacing",
            None,
            "mm",
            (10, 60),
            bounds={"ge": 1, "le": 1000},
        ),
    ] = field(default=None, kw_only=True)
    rod_length: Annotated[
        float | None,
        Value("Free length of a rod between its anchors", None, "m", (1, 40), bounds={"ge": 0.1, "le": 1000}),
    ] = field(default=None, kw_only=True)
    rod_yield_stress: Annotated[
        float | None,
        Value(
            "Stress at which a rod yields; elastic without it",
            None,
            "MPa",
            (150, 600),
            bounds={"ge": 1, "le": 5000},
        ),
    ] = field(default=None, kw_only=True)
    rod_modulus: Annotated[
        float,
        Value("Modulus of elasticity of a rod", None, "GPa", (60, 210), bounds={"ge": 1, "le": 1000}),
    ] = field(default=200e9, kw_only=True)
    rod_pretension: Annotated[
        float, Value("Force of a rod at rest; needs a wall that cannot move inwards", None, "kN", (0, 200))
    ] = field(default=0.0, kw_only=True)
    anchor_height: Annotated[
        float,
        Value(
            "Height of the masonry that the anchor of each tie grips, by whose friction it holds",
            None,
            "m",
            (0.1, 2),
            bounds={"gt": 0, "le": 1000},
        ),
    ] = field(default=GRIPPED, kw_only=True)
    anchor_width: Annotated[
        float | None,
        Value(
            "Length along the wall of the masonry that each anchor grips, its plate and the spread that a study names; "
            "left out: the unit_length of the masonry, and all of it where a floor holds it between its ties",
            None,
            "m",
            (0.1, 3),
            bounds={"gt": 0, "le": 1000},
        ),
    ] = field(default=None, kw_only=True)
    loaded_leaf: Annotated[
        Literal["inner", "outer"] | None,
        Value(
            "Leaf on which loads and thrusts bear; left out: the inner one",
            "inner",
            phrase="loads on the {value} leaf",
        ),
    ] = field(default=None, kw_only=True)
    opening: Opening | None = field(default=None, kw_only=True)
    held_at: tuple[float, ...] = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        self._spread_rods()

    def _spread_rods(self) -> None:
        """Take stiffness, strength and pretension per metre from the rods, where these are described."""
        rods = {"rod_diameter": self.rod_diameter, "rod_length": self.rod_length}
        if not any((*rods.values(), self.rod_yield_stress, self.rod_pretension)):
            return
        for name, value in (rods | {"tie_spacing": self.tie_spacing}).items():
            said = ", but a rod needs rod_diameter, rod_length and the tie_spacing; give it."
            self._demand(value is not None, name, said)
        assert self.rod_diameter and self.rod_length and self.tie_spacing
        area = math.pi * self.rod_diameter**2 / 4
        per_metre: dict[str, float | None] = {
            "tie_stiffness": self.rod_modulus * area / (self.rod_length * self.tie_spacing),
            "tie_strength": self.rod_yield_stress and self.rod_yield_stress * area / self.tie_spacing,
            "tie_pretension": self.rod_pretension / self.tie_spacing,
        }
        for name, value in per_metre.items():
            given = getattr(self, name)
            follows = value is not None and math.isclose(given or 0.0, value, rel_tol=1e-9)
            self._demand(not given or follows, name, ", but follows from the rods; leave it out.")
            object.__setattr__(self, name, value)

    def _moves(self, mirrored: bool) -> Opening:
        """How it opens to one side; what is described as it is described."""
        if self.opening is not None and self.opening.outwards != mirrored:
            return self.opening
        other = self.opening and self.held_wall.other_way(self.opening)
        return other or replace(self._opens, outwards=not mirrored)

    def _linkage(self, mirrored: bool) -> Linkage:
        way = self._moves(mirrored)
        return self.held_wall.linkage(way, self._opens, self.held_wall.hung(way, self._opens))

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        return self.held_wall.outlines(self._opens)

    def without_ties(self) -> Self | None:
        """Return the same wall with no tie, None of what has none; raises StructureError where it falls so."""
        return replace(self, **_NO_TIES) if self.tie_heights else None

    @property
    def ties_apart(self) -> bool:
        """Whether its ties stand so far apart along the wall that it may fall between them (theory: section 13.2)."""
        if self.tie_spacing is None or self.unit_length is None or self.held_between:
            return False
        return self.tie_spacing > FAR_APART * self.unit_length

    @property
    def _gripped_share(self) -> float:
        """The share of the length of the wall that the anchors of a row grip (theory: section 13.3)."""
        width = self.anchor_width or (None if self.held_between else self.unit_length)
        return 1.0 if width is None or self.tie_spacing is None else min(1.0, width / self.tie_spacing)

    def _slab_edge(self, thickness: float, load: float) -> float:
        """Distance of the edge on which a slab of that `load` [N/m] lies from the middle of its wall, m."""
        return thickness / 2 - inset(pressing=load, strength=self.compressive_strength, breadth=thickness)

    def _check_slab(self, name: str) -> None:
        """Refuse a stack below a flat slab whose mass, as its field of that name says, something else holds."""
        said = " under a flat slab, but contact dynamics needs the mass of a slab; leave it out, or choose another "
        self._demand(not getattr(self, name), name, said + "fidelity than contact.")

    def _check_plane(self) -> None:
        """Refuse a stack, which is plane, of a wall that may fall between its ties."""
        if self.ties_apart:
            raise StructureError(
                "tie_spacing lets the wall fall between its ties, where a plane stack of courses holds it all along, "
                "so that contact dynamics cannot follow it; choose another fidelity than contact.",
                tie_spacing=self.tie_spacing,
            )

    @property
    def assumptions(self) -> tuple[RockingWarning, ...]:
        """What is taken for granted of how far apart its ties stand, and how rods are spread over the metre."""
        assumed = []
        if self.tie_heights and self.tie_spacing is None and not self.held_between:
            assumed.append(RockingWarning(StructureKind.TIES_ALL_ALONG))
        if self.rod_diameter and self.rod_length and self.tie_spacing:
            rods: dict[str, float] = {
                "diameter_mm": self.rod_diameter * 1e3,
                "length_m": self.rod_length,
                "spacing_m": self.tie_spacing,
                "stiffness_kN_m2": self.tie_stiffness / 1e3,
                "strength_kN_m": (self.tie_strength or math.inf) / 1e3,
            }
            assumed.append(RockingWarning.of(StructureKind.RODS_SPREAD, "", **rods))
        return (*super().assumptions, *assumed)

    @cached_property
    def held_wall(self) -> HeldWall:
        """The wall as limit analysis sees it: its masonry, what bears on it and what holds it."""
        return HeldWall(
            self._storeys,
            self._loads,
            tuple(sorted(self._with_bonders(self._holds))),
            self._thrusts,
            row=TieRow(self._tie, self._tie_levels, self.ties_apart, self.anchor_height, self._gripped_share),
            backed=self._leans,
            strength=self.compressive_strength,
            lean=self._aside,
            joints=self.joints,
        )

    @property
    @abstractmethod
    def _storeys(self) -> tuple[Storey, ...]:
        """Its masonry from the ground up."""

    @property
    @abstractmethod
    def _loads(self) -> tuple[Load, ...]:
        """What bears on it."""

    @property
    @abstractmethod
    def _holds(self) -> list[Hold]:
        """What holds it other than bonders."""

    @property
    def _thrusts(self) -> tuple[tuple[float, float], ...]:
        """The height [m] and the force outwards [N/m] of what pushes it."""
        return ()

    @property
    def _aside(self) -> float:
        """How far it stands out of plumb outwards, per height."""
        return 0.0

    @property
    def _sections(self) -> tuple[tuple[float, float, float, float], ...]:
        return tuple((storey.low, storey.high, storey.left, storey.right) for storey in self._storeys)

    @abstractmethod
    def opened(self, opening: Opening) -> Self:
        """Return this wall where it opens so and nowhere else."""

    @cached_property
    def _mechanisms(self) -> Mechanisms:
        others = self._bulges if self.crack_is_known or self._is_one_bulge else self._family
        family = [candidate for candidate in others if candidate.sign >= 0 or not self.symmetric]
        alone = [leaf.named(leaf.structure.mechanisms()) for leaf in self.leaves_alone]
        return self.candidates().counting.of_all.with_family(family, alone)

    @cached_property
    def _bulges(self) -> Mechanisms:
        """Those of the family in which it opens at a hinge that cracks elsewhere leave out, by their λ.

        A crack that is known says where the wall is cracked, not that what holds it keeps it from bulging.
        """
        if self._is_one_bulge or not self.held_wall.holds:
            return Mechanisms()
        own = self._described_opening
        span = (own.foot, own.hold) if own else None

        def bulges(candidate: Candidate) -> bool:
            opening = candidate.opening
            if opening is None:
                return False
            elsewhere = opening.hinge is not None and (opening.foot, opening.hold) != span
            return elsewhere or candidate.kind in ("between", "slips")

        return Mechanisms(filter(bulges, self._family))

    @property
    def _is_one_bulge(self) -> bool:
        """Whether it can do nothing but bulge between its foot and a top that stays where it is."""
        held = self.tie_heights or self.held_at or self.held_wall.top_may_slip
        return self._described_opening is not None and not held

    def _places(self, count: int) -> list[float]:
        """Joints over the height, and those at which something changes: feet of storeys, and what holds it."""
        stops = np.array(
            [height for height in self.held_wall.stops if height >= self.lowest_crack * self.height]
        )
        near = _SAME * self.height
        within = [place for place in super()._places(count) if not (np.abs(stops - place) < near).any()]
        return [*within, *stops.tolist()]

    def _cracked(self, count: int) -> Mechanisms:
        cracked = super()._cracked(count)
        self._check_restitution()
        return cracked

    def _check_restitution(self) -> None:
        """Refuse what bulges with no restitution of the geometry: it may fall so, and no record could say whether."""
        for bulge in self._bulges:
            if bulge.refused is not None and bulge.refused.field == "restitution":
                raise bulge.refused

    @property
    def _limit(self) -> float | None:
        if not (self.tie_heights or self.held_at):
            return None
        if self.held_wall.is_bonded(self._opens):
            return math.inf
        inwards = [side.uplift_multiplier for side in self.mechanism().sides[1:]]
        return min([self.held_wall.multiplier(self._opens), *inwards])

    @cached_property
    def _family(self) -> Mechanisms:
        wall = self.held_wall
        family = []
        for opening, multiplier in wall.family():
            if not multiplier > 0:
                raise DoesNotStandError(
                    f"the structure does not stand: at rest it {wall.name(opening)}; correct its loads or its sizes."
                )
            place = opening.foot if opening.hinge is None else opening.hinge
            what = "crack" if opening.hinge is None else "hinge"
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", StructureWarning)  # nobody asked for its restitution
                opened = self.opened(opening)
            sign = 1 if opening.outwards else -1
            name = wall.name(opening)
            is_named = opening.hinge is not None or opening.between or wall.slip(opening) != 0
            words = Phrase(f"{what} at {{height:.4g}} m", height=float(place))
            if is_named:
                words = Phrase("{opens} ({does})", opens=words, does=name)
            family.append(Candidate(words, place, opened, name=name, limit=multiplier, sign=sign))
        return Mechanisms(family)

    @property
    def lets_go(self) -> bool:
        """Whether no tie without a strength has to stretch for it to move outwards as it opens."""
        return math.isfinite(self.held_wall.multiplier(self._opens))

    def reactions(self, state: MotionState | None = None) -> tuple[Reaction, ...]:
        """Return the force of everything that holds it sideways, N per metre, over k states.

        None: as it starts to fall outwards, at rest under λ (theory: section 12.4). Positive where it holds the wall
        back. What stretches pulls as its tie does; what the mechanism takes for rigid gives what the balance of the
        bodies asks for. A floor that rests on the top and is held sideways asks for its own inertia as well.
        Raises UnknownContacts where the bodies do not determine them.

        >>> wall = rocking.LoadedWall.of_size(3.6, 0.35, 18e3, 2.4, top_load=40e3, top_slab="flat", restitution=0.5)
        >>> [(each.kind, each.height, round(float(each.force[0]))) for each in wall.reactions()]
        [('top', 3.6, 19705)]
        """
        if state is None:
            pushed = -self.mechanism().positive.uplift_multiplier * GRAVITY
            state = MotionState.of(self.mechanism(), 0.0, 0.0, ground=pushed)
        found = [self._held_back(state, mirrored) for mirrored in (False, True)[: len(self.linkages)]]
        is_positive = state.sign > 0
        return tuple(
            first._replace(force=np.where(is_positive, first.force, other.force))
            for first, other in zip(found[0], found[-1], strict=True)
        )

    @cached_property
    def restraints(self) -> tuple[Restraint, ...]:
        """The ties and the top, each with what it needs as the weakest mechanism that it holds back starts."""
        wall = self.held_wall
        found = []
        for hold in wall.holds:
            held = [candidate for candidate in self.mechanisms() if self._holds_back(hold, candidate)]
            if not held or hold.kind == "floor":
                continue
            # What is taken to hold has to bear the crack that is described, too, which may ask for more.
            asked = held[:1]
            if hold.kind == "top" and not hold.gives:
                asked += [candidate for candidate in held if candidate.position == self.crack_position]
            each = [
                (candidate.name, reaction)
                for candidate in asked
                for reaction in candidate.reactions
                if (reaction.kind, reaction.height) == (hold.kind, hold.height)
            ]
            name, reaction = max(each, key=lambda asking: float(asking[1].force[0]))
            friction = hold.inwards if hold.kind == "top" else 0.0
            of_ties = hold.outwards - friction if np.isfinite(friction) else 0.0
            pressing = sum(load.weight for load in wall.loads if load.z == hold.height)
            coefficient = friction / pressing if pressing else 0.0
            found.append(
                Restraint(
                    kind=hold.kind,
                    height=hold.height,
                    holds=name,
                    needed=float(reaction.force[0]),
                    friction=friction,
                    coefficient=coefficient if hold.kind == "top" else wall.joints.friction,
                    ties=of_ties,
                    weight=sum(storey.total for storey in wall.storeys),
                    grip=wall.grip(hold.height) if hold.kind == "tie" else math.inf,
                    spacing=self.tie_spacing if hold.kind == "tie" else None,
                )
            )
        return tuple(found)

    @cached_property
    def anchors_slide_at(self) -> float:
        """The acceleration [g] at which what the anchor of a tie grips slides out of the wall (theory: section 13.3).

        inf where the wall around each anchor gives what the tie needs at rest, and where there is no tie.
        """
        if not any(
            restraint.kind == "tie" and restraint.needed > restraint.grip for restraint in self.restraints
        ):
            return math.inf
        return self.held_wall.anchors_slide_at

    @property
    def does(self) -> str:
        """How it falls, in words: "bulges between foot and tie"."""
        return self.held_wall.name(self._opens)

    @property
    def _opens(self) -> Opening:
        """How it opens: as one of the family, or as it is described."""
        return self.opening or self._described_opening or Opening(foot=self.crack_position)

    def _holds_back(self, hold: Hold, candidate: Candidate) -> bool:
        """Whether a hold of the wall stops the upper body of a mechanism, of it or a leaf, that falls outwards."""
        wall = held(candidate.structure)
        if wall is None or wall._opens.is_triangle:
            return False
        if not any((own.kind, own.height) == (hold.kind, hold.height) for own in wall.held_wall.holds):
            return False  # bonders hold a leaf in place of the ties of its wall
        return wall._opens.outwards and wall._opens.hold == hold.height and not candidate.refusal

    def _held_back(self, state: MotionState, mirrored: bool) -> list[Reaction]:
        """What each hold gives on one side, in the order of `held_wall.holds`."""
        wall = self.held_wall
        way = self._moves(mirrored)
        if way.is_triangle:
            raise UnknownContacts("what the ties take as the wall falls between them is not known.")
        linkage: Linkage = self.linkages[-1 if mirrored else 0]
        above = [hold.height for hold in wall.holds if way.hold is not None and hold.height > way.hold]
        stop = max(above, default=wall.height)
        gives = np.zeros((2, state.rotation.size))
        if isinstance(linkage, Chain):
            gives = linkage.holding(state, stop if way.upright else None) / GRAVITY
        reactions = []
        heights = [hung.start.imag for hung in linkage.hung if hung.tie]
        for hold in wall.holds:
            force = np.zeros(state.rotation.size)
            if hold.height == way.hold:
                force = gives[0]
            elif way.upright and hold.height == stop:
                force = gives[1]
            for tie, height in zip(linkage.ties, heights, strict=True):
                if abs(height - hold.height) < 1e-9 * wall.height:
                    pull = tie.tie.tension(tie.stretch(state.rotation), tie.stretch(state.largest))
                    force = force + pull * linkage.unit
            reactions.append(Reaction(hold.kind, hold.height, force))
        return reactions

    @property
    def _described_opening(self) -> Opening | None:
        """How it opens as it is described, where that is a bulge; None: as one body."""
        return None

    def tie_events(self, rotation: float) -> str:
        """Return which ties have yielded or broken once a signed `rotation` [rad] was reached, in words; "" if none."""
        tie = self._tie
        events = []
        tied = [hung for hung in self.linkages[0].hung if hung.tie]
        for hung, side_tie in zip(tied, self.linkages[0].ties, strict=True):
            if hung.kind != "tie":
                continue
            height = hung.start.imag
            stretch = float(side_tie.stretch(np.asarray(max(rotation, 0.0))))
            if (
                stretch >= (1 - 1e-9) * tie.rupture_stretch
            ):  # where it overturns as the tie breaks, to rounding
                events.append(f"the tie at {height:.6g} m breaks")
            elif stretch > tie.yield_stretch:
                plastic = f"{stretch - tie.yield_stretch:.3g} m of {tie.plastic_elongation:.6g} m"
                events.append(f"the tie at {height:.6g} m yields by {plastic}")
        return "; ".join(events)

    def marks(self, rotation: float = 0.0) -> tuple[Mark, ...]:
        linkage, motion = self._posed(rotation)
        mirrored = rotation < 0
        size = 0.15 * self.height
        marks = []
        way = self._moves(mirrored)
        anchorage = float(np.vstack(self.outline())[:, 0].min()) - 2 * size
        for hung in self.held_wall.hung(way, self._opens):
            if hung.kind == "friction":
                continue
            stays = hung.part == STILL or (
                way.between and hung.kind == "tie"
            )  # the ties stand next to the section
            shift = 0j if stays else linkage.carried(hung.part, hung.start, motion).moved
            head = plane(np.asarray(hung.start + shift), mirrored)
            tail = {"load": [0.0, size], "thrust": [-size, 0.0], "tie": [anchorage - head[0], 0.0]}[hung.kind]
            text = f"{(abs(hung.force) + hung.mass) / 1e3:.6g} kN/m"
            if hung.kind == "tie":
                text = f"{self.tie_stiffness / 1e3:.6g} kN/m²"
                if self.tie_strength is not None:
                    end = "yields" if self.tie_plastic_elongation else "breaks"
                    text += f", {end} at {self.tie_strength / 1e3:.6g} kN/m"
            marks.append(Mark(hung.kind, text, np.array([head + tail, head])))
        behind = anchorage + 2 * size
        marks += [
            Mark("support", "", np.array([[behind - size / 2, height], [behind, height]]))
            for height in self.held_at
        ]
        return (*super().marks(rotation), *marks)

    @cached_property
    def _tie_levels(self) -> tuple[float, ...]:
        """The heights of the ties, m, each that of a top or of another tie where it is one but for rounding.

        What is at the foot but for rounding holds nothing, and is left out.
        """
        levels = [0.0, *(top for _, top, _, _ in self._sections)]
        first = len(levels)
        for height in self.tie_heights:
            levels.append(next((level for level in levels if self._is_at(level, height)), height))
        return tuple(level for level in levels[first:] if level)

    def _is_at(self, level: float, height: float) -> bool:
        """Whether two heights [m] are one but for rounding, between which no part is thick enough to move by itself."""
        return abs(level - height) < _SAME * self.height

    def _with_bonders(self, holds: Iterable[Hold]) -> list[Hold]:
        """What holds a leaf in addition to the rest of its wall, which gives to neither side where it does."""
        others = [
            hold for hold in holds if not any(self._is_at(hold.height, height) for height in self.held_at)
        ]
        return [*others, *(Hold(height, "bonder", math.inf, math.inf) for height in self.held_at)]

    def _storey_courses(
        self, number: int, foot: float = 0.0, cuts: Sequence[float] = ()
    ) -> tuple[Course, ...]:
        """Its courses above `foot` [m], each storey in as many as its share of the height asks, or one more.

        They end where something holds it, and at `cuts` [m].
        """
        made: list[Course] = []
        weight = getattr(self, "unit_weight", None)
        density = 1.0 if weight is None else weight / GRAVITY
        held = [hold.height for hold in self.held_wall.holds]
        for storey in self._storeys:
            low = max(storey.low, foot)
            if storey.high <= low:
                continue
            stops = [height for height in (*held, *cuts) if low < height < storey.high]
            share = (storey.high - low) / self.height
            levels = joints_between([low, *stops, storey.high], number * share)
            sides = (storey.left, storey.right)
            faces = [(sides[0] + self._aside * level, sides[1] + self._aside * level) for level in levels]
            one = storey._replace(weight=1.0)
            breadths = [one.cut(*ends).total / (ends[1] - ends[0]) for ends in pairwise(levels)]
            made += courses_between(levels, faces, density, breadths)
        return tuple(made)

    def _outer(self, height: float) -> tuple[float, float]:
        """The point of the outer face at a height [m]."""
        return self._storeys[-1].right + self._aside * height, height

    @abstractmethod
    def _slab(self, load: Load) -> Course:
        """A load as a body on top of its courses: one that stays flat, or that only rises."""

    def _stacked(self, body: list[Course], of_slab: float = ROUGH) -> Stack:
        """The stack of its courses with what bears on them, pushes and holds them; of_slab: friction under a slab."""
        self._check_plane()
        foot = body[0].base
        held: list[Held] = []
        slabs: list[Course] = []
        for load in self._loads:
            point = (load.x + self._aside * load.z, load.z)
            place = course_at(body, load.z)
            if not load.weight or load.z <= foot:
                continue
            if load.slab or (load.moves and not load.rides):
                slabs.append(self._slab(load))
            elif load.rides:
                body[place] = loaded(body[place], point, load.weight / GRAVITY)
            else:
                held.append(Held(place, point, force=(0.0, -load.weight)))
        for height, thrust in self._thrusts:
            if height > foot:
                held.append(Held(course_at(body, height), self._outer(height), force=(thrust, 0.0)))
        held += self._held_in(body)
        is_held = not slabs and any(hold.kind == "top" for hold in self.held_wall.holds)
        top = (0.0, self.height) if is_held else None
        return Stack((*body, *slabs), tuple(held), top, of_slab if slabs else ROUGH)

    def _held_in(self, courses: Sequence[Course]) -> list[Held]:
        """What holds its courses: ties, what they lean on, floors behind them, and bonders."""
        restitution = self.mechanism().positive.restitution
        foot = courses[0].base
        held = [
            Held(course_at(courses, height), self._outer(height), tie=self.held_wall.anchored(height))
            for height in self._tie_levels
            if height > foot
        ]
        held += self._behind(courses)
        storey = sum(course.mass for course in courses) / len(self._storeys)
        for hold in self.held_wall.holds:
            place = course_at(courses, hold.height)
            mass = courses[place].mass
            if hold.kind in ("tie", "floor") and hold.inwards and hold.height > foot:
                stop = Stop.of_mass(mass, restitution, thrown=max(storey, mass))
                held.append(Held(place, (courses[place].top[0], hold.height), stop=stop))
        for height in self.held_at:
            # A bonder is a stop inwards and a tie as stiff outwards.
            place = course_at(courses, height)
            stop = Stop.of_mass(courses[place].mass, restitution)
            tie = Tie(stiffness=stop.stiffness)
            held.append(Held(place, (self._storeys[0].right, height), tie=tie))
            held.append(Held(place, (self._storeys[0].left, height), stop=stop))
        return held

    def _bears(self, leaf: Leaf) -> bool:
        """Whether the loads bear on a leaf."""
        return leaf.name == f"{self.loaded_leaf or 'inner'} leaf"

    def _loads_on(self, leaf: Leaf, thicknesses: Iterable[float]) -> dict[str, Any]:
        """The fields of what bears on a leaf. thicknesses: of the wall where its loads bear, m."""
        if not self._bears(leaf):
            return {key.name: key.default for key in fields(self) if key.name in self._of_loads}
        loads = {name: getattr(self, name) for name in self._of_loads}
        return loads | {"eccentricity": self._eccentricity_on(leaf, thicknesses, loads["eccentricity"])}

    def _ties_of(self, leaf: Leaf) -> dict[str, Any]:
        """The fields by which the ties of the wall hold a leaf: outwards, tightened where it cannot go inwards."""
        ties = {name: getattr(self, name) for name in _NO_TIES} | _RODS_SPREAD
        leans = leaf.moves == "outwards" or (leaf.is_inner and self._leans)
        if not leans:
            ties["tie_pretension"] = 0.0
        pulls = ties["tie_stiffness"] or ties["tie_pretension"]
        # That bonders alone hold a leaf which they hold is on the safe side.
        if leaf.moves == "inwards" or not pulls or self.bonder_heights:
            return _NO_TIES
        return ties

    def _eccentricity_on(self, leaf: Leaf, thicknesses: Iterable[float], eccentricity: float) -> float:
        """Return how far inwards of the middle of a leaf the loads bear, m.

        Where they bear on the wall, if that is one place of the leaf; else at its middle. thicknesses: of the wall
        where loads bear, m.
        """
        asides = {
            (thickness - leaf.thickness) / 2 * (1 if leaf.is_inner else -1) for thickness in thicknesses
        }
        if not eccentricity or len(asides) != 1:
            return 0.0
        on_leaf = eccentricity - asides.pop()
        if abs(on_leaf) > leaf.thickness / 2:
            return 0.0
        return on_leaf * (-1 if leaf.moves == "inwards" else 1)

    @cached_property
    def _tie(self) -> Tie:
        """Each tie."""
        strength = np.inf if self.tie_strength is None else self.tie_strength
        return Tie(
            stiffness=self.tie_stiffness,
            pretension=self.tie_pretension,
            strength=strength,
            plastic_elongation=self.tie_plastic_elongation,
        )

    def _check_eccentricity(self, value: float, thickness: float) -> None:
        """Refuse a bearing beyond the edge of a wall of that thickness [m]."""
        said = f" m, but must lie within half the thickness, {thickness / 2!r} m, for the load to bear on the wall."
        self._demand(abs(value) <= thickness / 2, "eccentricity", said)

    def _check_inside(self, name: str, value: float) -> None:
        """Refuse a height above the ground [m] that is not on the wall."""
        said = f" m, but must lie on the wall, above 0 and up to {self.height:.6g} m."
        self._demand(0 < value <= self.height, name, said, value)

    def _check_ties(self) -> None:
        """Refuse ties that do not hang together."""
        demand = self._demand
        stiffness = self.tie_stiffness
        pretension = self.tie_pretension
        strength = self.tie_strength
        for height in self.tie_heights:
            self._check_inside("tie_heights", height)
        if self.tie_heights:
            self._check_inside("anchor_height", self.anchor_height)
        said = f", but must be 0 or at least {LEAST_STIFFNESS!r} N/m², below which a tie holds nothing."
        demand(not 0 < stiffness < LEAST_STIFFNESS, "tie_stiffness", said)
        said = ", but must be at least the pretension of the tie (tie_pretension)."
        demand(strength is None or strength >= pretension, "tie_strength", said)
        said = ", but must be greater than 0 for a tie with a tie_strength; give it."
        demand(strength is None or stiffness, "tie_stiffness", said, 0)
        said = " m, but needs a tie_strength at which the tie yields; give it."
        demand(strength is not None or not self.tie_plastic_elongation, "tie_plastic_elongation", said)
        for name in ("tie_spacing", "unit_length", "held_between"):
            said = f", but {name} says how ties hold the wall along its length, and tie_heights is empty; give it."
            demand(getattr(self, name) is None or self.tie_heights, name, said)
        said = ", but a tie_spacing needs the length of the units of the masonry, or held_between: floor; give it."
        demand(self.tie_spacing is None or self.unit_length or self.held_between, "unit_length", said)
        for name in ("unit_length", "anchor_width"):
            said = f", but {name} needs the distance between the ties of a row; give it."
            demand(getattr(self, name) is None or self.tie_spacing, "tie_spacing", said)
        said = ", but says which of its leaves bears its loads; give the thickness of each, leaves_m."
        demand(self.loaded_leaf is None or self.leaves, "loaded_leaf", said)
        said = ", but must say where the ties are; give it."
        demand(self.tie_heights or not (stiffness or pretension), "tie_heights", said)
        said = ", but must be greater than 0 for ties to hold; give it."
        demand(stiffness or pretension or not self.tie_heights, "tie_stiffness", said, 0)
        said = (
            ", but must be 0 unless the wall cannot move inwards (one_sided, or behind: cross_walls of a façade): "
            "moving inwards, a tightened tie goes slack."
        )
        demand(not pretension or self.one_sided, "tie_pretension", said)


def held(structure: Structure) -> Tied | None:
    """Return a structure as the wall that ties, floors or its top may hold, which says what they do; else None."""
    return structure if isinstance(structure, Tied) else None


_RODS_SPREAD: dict[str, Any] = {key.name: key.default for key in fields(Tied) if key.name.startswith("rod_")}
"""The fields of rods that are spread over the metre already."""
_NO_TIES: dict[str, Any] = _RODS_SPREAD | {
    key.name: key.default
    for key in fields(Tied)
    if key.name.startswith(("tie_", "anchor_")) or key.name in ("unit_length", "held_between")
}
"""The fields of a wall without ties."""
