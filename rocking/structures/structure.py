"""Every structure: mechanism, bodies, drawing, contacts, capacity, and the mechanisms that may form, in their order."""

import math
import warnings
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, fields, replace
from functools import cached_property
from itertools import chain
from operator import attrgetter
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple, Self

import numpy as np

from rocking.errors import SizeError, StructureError, StructureWarning
from rocking.quantities import GRAVITY, within
from rocking.structures.capacity import StaticCapacity, StaticCurve
from rocking.structures.description import Description
from rocking.structures.drawing import Dimension, Mark, Path, plane
from rocking.structures.fields import PlainSignature, Value, constructor
from rocking.structures.joints import USUAL, Joints
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import (
    STILL,
    Contacts,
    Kinematics,
    Linkage,
    MotionState,
    Reaction,
    Restitution,
    UnknownContacts,
    momentum_balance,
)
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.stack import Course, Held, Stack, stops_behind
from rocking.structures.stones import Stones
from rocking.warnings import Phrase, RockingWarning

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from rocking.structures.held_wall import HeldWall, Opening


AS_DESCRIBED = "as described"
"""The description of the one mechanism of what does not crack."""
CRACKS = 11
"""Number of mechanisms that are followed where more than one may form."""
TYPED_LOWER = 0.05
"""Difference by which a typed restitution may lie below that of the geometry before both are followed."""
TYPED_ABOVE = 0.02
"""Difference by which a typed restitution may lie above that of the geometry, as more than rounding, unwarned."""


@dataclass(frozen=True, repr=False)
class Structure(ABC):
    """A geometry that reduces to a Mechanism. Subclasses are frozen dataclasses checked at birth.

    restitution_range: its restitution is known to plus or minus this much; None: as the settings say. joints: what all
    its joints have alike; what they may do follows from its geometry, by `_joints_do`.

    type_name: the `type` in a file. _described_as: what each constructor that a file may use describes, by the name of
    its class method, "" for the class itself. _usual_restitution: where none is given. _contacts_unknown: why no
    contact forces are known; "" where the moving parts give them.
    """

    __signature__ = PlainSignature()
    type_name: ClassVar[str] = ""
    _described_as: ClassVar[dict[str, str]] = {}
    _usual_restitution: ClassVar[float | str] = "momentum"
    _contacts_unknown: ClassVar[str] = ""

    restitution_range: Annotated[
        float | None,
        Value(
            "The restitution is known to plus or minus this much; left out: as the settings of the ensemble say",
            0.1,
            usual=(0, 0.3),
            phrase="restitution known to ± {value}",
            bounds={"ge": 0, "le": 1},
        ),
    ] = field(default=None, kw_only=True)
    joints: Joints = field(default=USUAL, kw_only=True)

    def __post_init__(self) -> None:
        """Check each value that is not the default by what its type says of it, and say what its joints may do."""
        object.__setattr__(self, "joints", Joints(self.joints.friction, **self._joints_do))
        for key in constructor(type(self)).fields:
            value = getattr(self, key.name)
            if value is not key.default:
                object.__setattr__(self, key.name, key.in_si(value))
        # As it is typed: whether a façade is, follows from its geometry, which is checked later.
        if vars(self).get("one_sided"):
            self._demand(
                isinstance(self._given_restitution, float),
                "restitution",
                ", but a one-sided body needs its own number between 0 and 1, as what it leans on takes part in the "
                "impact; give it.",
            )

    def _demand(self, is_so: object, name: str, said: str, value: object = None) -> None:
        """Refuse its field of that name, or one `value` of it, unless something is so; said: from the unit on."""
        wrong = getattr(self, name) if value is None else value
        if not is_so:
            shown = "missing" if wrong is None else "empty" if wrong == () else repr(wrong)
            raise SizeError.of(name, shown, said)

    def __repr__(self) -> str:
        """The description, and the first warning on unusual values."""
        return " ".join(
            [f"{type(self).__name__}({self.description})", *map(str, self.described.warnings[:1])]
        )

    @property
    def _joints_do(self) -> dict[str, Any]:
        """The fields of its joints that follow from its geometry, where they are not the default."""
        return {}

    def slides_at(self) -> float:
        """Return the acceleration [g] at which its joints slide before any mechanism of it lifts.

        0 where it slides apart at rest; nan where it lifts first, or where statics knows no more of its joints than
        its mechanisms do.
        """
        return math.nan

    def mechanism(self) -> Mechanism:
        """Return the structure in standard form; the same object at every call."""
        return self._mechanism

    def __getstate__(self) -> dict[str, Any]:
        """The fields and its description as typed: the rest is computed again after a copy or in another process."""
        saved = [*(field.name for field in fields(self)), "_described"]
        return {name: self.__dict__[name] for name in saved if name in self.__dict__}

    @property
    def one_sided(self) -> bool:
        """Whether it rocks to the positive side only, as it leans on something; a key of types that may."""
        return False

    @property
    def does(self) -> str:
        """How it falls, in words: "overturns"; of a wall that is held "bulges between foot and tie"."""
        return "overturns"

    @property
    def symmetric(self) -> bool:
        """Whether the negative side is the mirror image of the positive one."""
        return True

    def on_joints(self, joints: Joints) -> Self:
        """Return it on these joints; it describes itself as it did."""
        return (
            self
            if joints.friction == self.joints.friction
            else self.described.describes(replace(self, joints=joints))
        )

    @property
    def cautions(self) -> tuple[RockingWarning, ...]:
        """What its model leaves out or takes for granted, and a typed restitution unlike that of the geometry."""
        cautions = [*([] if self._leaves_out is None else [self._leaves_out]), *self.assumptions]
        typed = self._typed_restitutions.values()
        has_balance = not self.one_sided and isinstance(self._usual_restitution, str)
        if has_balance and typed:
            balanced = self.restitution_of_geometry
            most = max(self._momentum_balance(mirrored) for mirrored in (False, True))
            if balanced is not None:
                cautions.append(
                    RockingWarning.of(StructureKind.RESTITUTION_TYPED, typed=min(typed), own=balanced[0])
                )
            elif max(typed) - most > TYPED_ABOVE:
                cautions.append(
                    RockingWarning.of(StructureKind.RESTITUTION_ABOVE, typed=max(typed), own=max(most, 0.0))
                )
        return tuple(cautions)

    @property
    def assumptions(self) -> tuple[RockingWarning, ...]:
        """What is taken for granted where its description says nothing of it."""
        return ()

    @property
    def _leaves_out(self) -> RockingWarning | None:
        """What the model of this structure leaves out; None where nothing."""
        return None

    @cached_property
    def linkages(self) -> tuple[Linkage, ...]:
        """The moving parts on the positive side; then, seen in the mirror, on the negative one where that differs."""
        positive = self._linkage(mirrored=False)
        if self.symmetric or self.one_sided:
            return (positive,)
        return positive, self._linkage(mirrored=True)

    def outline(self, rotation: float = 0.0) -> list[np.ndarray]:
        """Return the rigid parts at a signed `rotation` [rad] as polygons (k, 2) in m, x to the right, y up."""
        linkage, motion = self._posed(rotation)
        polygons = []
        for part, corners in self._seen(rotation < 0):
            shift = 0.0 if part == STILL else linkage.carried(part, corners, motion).moved
            polygons.append(plane(corners + shift, rotation < 0))
        return polygons

    def _seen(self, mirrored: bool) -> list[tuple[int, np.ndarray]]:
        """The outlines at rest as the linkage of one side sees them."""
        if not mirrored or self.symmetric:
            return self._parts()
        return [(part, -corners.conj()) for part, corners in self._parts()]

    def hinges(self, rotation: float = 0.0) -> np.ndarray:
        """Return the contact points (k, 2) in m at a signed `rotation` [rad]; at rest those of the positive side."""
        return plane(self._posed(rotation)[1].hinges, rotation < 0)

    def _posed(self, rotation: float) -> tuple[Linkage, Kinematics]:
        """The moving parts of the side of a signed `rotation` [rad], and where they are."""
        sides = self.mechanism().sides
        lowest = 0.0 if self.one_sided else -sides[-1].end_rotation
        rotation = within(
            StructureError, "rotation", rotation, low=lowest, high=sides[0].end_rotation, unit="rad"
        )
        linkage = self.linkages[-1 if rotation < 0 else 0]
        return linkage, linkage.motion(abs(rotation))

    def plot(self, rotation: float = 0.0, axes: "Axes | None" = None, *, dimensions: bool = False) -> "Axes":
        """Draw the parts to scale at a signed `rotation` [rad], on `axes` or on new ones, and return the axes.

        dimensions: also draw the lines of its sizes, each with its letter, about the structure at rest.
        """
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes, rotation=rotation, dimensions=dimensions)

    def static_capacity(self, side: int = 1) -> StaticCapacity:
        """Return what the positive (1) or negative (−1) side bears, by virtual work; the same object at every call.

        Raises StructureError for a side to which it does not rock.
        """
        mechanism = self.mechanism()
        if side not in (1, -1) or (side == -1 and mechanism.one_sided):
            raise StructureError(
                f"side is {side!r}, but must be 1, or -1 where the structure rocks to both sides.", side=side
            )
        known: dict[int, StaticCapacity] = self.__dict__.setdefault("_capacities", {})
        if side not in known:
            place = 0 if side > 0 else -1
            moving = [outline for outline in self._seen(side < 0) if outline[0] != STILL]
            known[side] = StaticCapacity.of(mechanism.sides[place], self.linkages[place], moving, side < 0)
        return known[side]

    def capacity_curve(self, side: int = 1, count: int = 41) -> StaticCurve:
        """Return the curve of the positive (1) or negative (−1) side at `count` equal steps of rotation.

        Where ties yield or break on the way there is a point more, and just beyond it another.
        Raises StructureError for a side to which it does not rock, or fewer than two points.
        """
        if count < 2:
            raise StructureError(
                f"count is {count!r}, but must be 2 points or more; correct it.", count=count
            )
        return self.static_capacity(side).curve(count)

    def contact_forces(self, state: MotionState) -> Contacts:
        """Return the contact forces in motion; at rest a single body carries the ground's whole acceleration.

        The joints of a wall or an arch at rest are statically indeterminate and their forces nan. Tangential forces are
        positive towards the side it rocks to.
        Raises UnknownContacts, in words, where they are not known (a frame's are indeterminate).
        """
        if self._contacts_unknown:
            raise UnknownContacts(self._contacts_unknown)
        positive = self.linkages[0].contacts(state)
        negative = self.linkages[-1].contacts(state)
        is_positive = state.sign > 0
        unknown = np.where(state.resting & (len(positive.names) > 1), np.nan, 0.0)
        return Contacts(
            positive.names,
            np.where(is_positive, positive.normal, negative.normal) + unknown,
            np.where(is_positive, positive.tangential, negative.tangential) + unknown,
        )

    def stack(self, courses: int | None = None) -> Stack:
        """Return it as rigid courses for contact dynamics; raises StructureError where that has no meaning.

        courses: their number; None: the bodies of the mechanism where the crack is known, else COURSES.
        """
        raise StructureError(
            f"a {self.type_name} is not a stack of courses, so that contact dynamics cannot follow it; choose another "
            "fidelity than contact."
        )

    def stones(self, voussoirs: int | None = None) -> Stones:
        """Return it as a chain of stones between two grounds; raises StructureError where it is none.

        voussoirs: their number; None: its own, or 21.
        """
        raise StructureError(
            f"a {self.type_name} is not a chain of stones between two grounds; an arch, or a frame of two columns, is."
        )

    def _behind(self, courses: Sequence[Course]) -> tuple[Held, ...]:
        """The stops of what its courses lean on, all along their inner faces; none where it is free."""
        return stops_behind(courses, self.mechanism().positive.restitution) if self.one_sided else ()

    def dimensions(self) -> tuple[Dimension, ...]:
        """Return the dimension lines of the sizes it was described by, at rest; of a list, one for each value."""
        return self.described.dimensions(self._dimensions())

    def marks(self, rotation: float = 0.0) -> tuple[Mark, ...]:
        """Return the loads, thrusts, ties and supports on it at a signed `rotation` [rad]."""
        return ()

    def candidates(self, count: int = CRACKS) -> "Mechanisms":
        """Return the mechanisms that may form, `count` or one more; the first decides, the others by their λ.

        The first is the one that statics chooses, of least λ; where the crack is known that one, and the others do not
        count. One, the structure as described, of what does not crack. A wall that is held above its foot may bulge
        wherever it is cracked: its bulge of least λ counts as well, and comes first where it is weaker. The same
        objects at every call, as they keep what they compute.
        """
        known: dict[int, Mechanisms] = self.__dict__.setdefault("_candidates", {})
        if count not in known:
            alone = [leaf.named(leaf.structure.candidates(count)) for leaf in self.leaves_alone]
            known[count] = self._ranked(count).with_leaves(alone)
        return known[count]

    def _ranked(self, count: int) -> "Mechanisms":
        """What may form of all of it as one body, `count` or one more; the first decides."""
        return Mechanisms([Candidate(AS_DESCRIBED, np.nan, self)])

    def mechanisms(self) -> "Mechanisms":
        """Return every mechanism in which it may fall, by their λ of limit analysis (theory: section 12).

        Of a wall that is held at several heights they are the cracks of `candidates`, and one by each further name of
        the family; where the crack is known that one, and its bulges. The same objects at every call.
        """
        return self._mechanisms

    @property
    def _mechanisms(self) -> "Mechanisms":
        return self.candidates()

    @property
    def leaves_alone(self) -> "tuple[LeafAlone, ...]":
        """Its leaves that may part, each as a structure of its own; () of what has one."""
        return ()

    @cached_property
    def static_multiplier(self) -> float:
        """The least λ of its mechanisms by limit analysis, g, in which ties pull with the force at which they yield."""
        return self.mechanisms()[0].uplift_multiplier

    @property
    def description(self) -> str:
        """The description in words with units: "breadth 0.6 m, height 6.0 m"."""
        return self.described.words

    @property
    def described(self) -> Description:
        """What it says of itself in a file: as it was typed, or else in the first of its forms."""
        typed: Description | None = self.__dict__.get("_described")
        return typed or Description.of(self)

    @cached_property
    def _mechanism(self) -> Mechanism:
        """I, J, G, B of the moving parts."""
        built = Mechanism(*self._sides, one_sided=self.one_sided, restitution_range=self.restitution_range)
        object.__setattr__(built, "structure", self)  # what it is built again from after pickling
        return built

    @property
    def _sides(self) -> tuple[Side, ...]:
        """The side of rocking of each of its linkages."""
        linkages = zip((False, True), self.linkages, strict=False)
        return tuple(linkage.side(self._impact(mirrored)) for mirrored, linkage in linkages)

    @property
    def _given_restitution(self) -> Restitution:
        """The restitution of the description; None where it gives none.

        Asked for by name, because not every structure has the field: one that did here would have to be the first
        parameter of each.
        """
        own: Restitution = getattr(self, "restitution", None)
        return own

    @property
    def _typed_restitutions(self) -> dict[str, float]:
        """The restitutions that its description gives as numbers, by their keys."""
        given = {"restitution": self._given_restitution}
        given["inward_restitution"] = getattr(self, "inward_restitution", None)
        return {key: number for key, number in given.items() if isinstance(number, float)}

    @property
    def restitution_is_typed(self) -> bool:
        """Whether its restitution is a number of the description, not that of a balance of momentum."""
        own = self._given_restitution
        return not isinstance(self._usual_restitution if own is None else own, str)

    @cached_property
    def restitution_of_geometry(self) -> tuple[float, Self] | None:
        """η by its balance of momentum, and the structure with it, where the typed number is lower by TYPED_LOWER.

        None of what leans on something, which takes part in the impact, and of what has no such balance.
        """
        typed = self._typed_restitutions
        if self.one_sided or not typed or not isinstance(self._usual_restitution, str):
            return None
        try:
            of_sides = [self._momentum_balance(mirrored) for mirrored in (False, True)]
            own = {"restitution": min(of_sides), "inward_restitution": of_sides[1]}
            if "inward_restitution" in typed:
                own["restitution"] = of_sides[0]
            raised: dict[str, Any] = {
                key: own[key] for key, number in typed.items() if own[key] - number > TYPED_LOWER
            }
            if not raised:
                return None
            least = min(raised.values())
            # None is the balance of each side; a type that asks for a number gets the least of both
            optional = {own_field.name for own_field in fields(self) if own_field.default is None}
            if "restitution" in raised and "restitution" in optional:
                raised["restitution"] = None
            return least, replace(self, **raised)
        except StructureError:  # a bulge of it may have none
            return None

    def _impact(self, mirrored: bool) -> float:
        """η of the impact that ends rocking on one side: the number, or that of a balance where it is a name."""
        own = self._given_restitution
        chosen = self._usual_restitution if own is None else own
        if not isinstance(chosen, str):
            return float(chosen)
        ratio = self._momentum_balance(mirrored)
        if ratio < 0:
            warnings.warn(
                f"restitution by {chosen} balance is {ratio:.4g} for this geometry, which is not physical; 0 is "
                "used instead (the structure is too squat to rock from side to side), so give a measured value.",
                StructureWarning,
                stacklevel=3,
            )
        return min(max(ratio, 0.0), 1.0)

    def _momentum_balance(self, mirrored: bool) -> float:
        """η by the balance of momentum as the structure arrives from one side and leaves to the other.

        Raises StructureError where the same bodies do not move to both sides.
        """
        arriving = self.linkages[0]
        leaving = self.linkages[-1]
        if mirrored:
            arriving, leaving = leaving, arriving
        if arriving.masses.shape != leaving.masses.shape or not np.allclose(
            arriving.masses, leaving.masses, rtol=1e-9
        ):
            # what moves as one body to one side parts where it moves to the other, so that no body keeps its momentum
            raise StructureError(
                "the restitution is not given, but other bodies move to one side than to the other, so that no balance "
                "of momentum gives it; give a number between 0 and 1.",
                restitution=self._given_restitution,
            )
        before = arriving.motion(0.0)
        after = leaving.motion(0.0)
        return momentum_balance(
            arriving.masses,
            arriving.inertias,
            (before.velocities, before.spins),
            (after.velocities, after.spins),
        )

    @abstractmethod
    def _linkage(self, mirrored: bool) -> Linkage:
        """The moving parts on the positive side, or, as the mirror image shows them, on the negative one."""

    @abstractmethod
    def _parts(self) -> list[tuple[int, np.ndarray]]:
        """The outlines (k,), complex, at rest, each with the number of the part of the linkage, or STILL."""

    def _dimensions(self) -> Mapping[str, Path | list[Path]]:
        """The dimension of each parameter that a drawing can show, or of each value of a list."""
        return {}


@dataclass(frozen=True)
class Candidate:
    """One mechanism that may form: a `structure` whose crack is known, at `position` [m] above the base.

    description: in words, "hinge at 2.56 m". position: nan where no height describes it, as of an arch's hinges.
    name: what it does, "bulges between foot and tie". limit: its λ by limit analysis, in which a tie pulls with the
    force at which it yields; None where it has no such tie. sign: of the rotation to the side to which it falls; 0:
    both sides. counts: whether it takes part in the verdict; otherwise it is reported along with the known crack.
    of_geometry: whether it is another candidate once more, with the restitution of the geometry in place of a lower one
    that is typed. part: the leaf that falls alone, "outer leaf"; "" where all of the structure does.
    """

    description: str
    position: float
    structure: Structure
    _: KW_ONLY
    name: str = ""
    limit: float | None = None
    sign: int = 0
    counts: bool = True
    of_geometry: bool = False
    part: str = ""

    def __post_init__(self) -> None:
        """Take the name of what its structure does, where it has none of its own."""
        object.__setattr__(self, "name", self.name or self.structure.does)

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism itself; the same object at every call."""
        return self.structure.mechanism()

    @property
    def opening(self) -> "Opening | None":
        """How a held wall opens in it, where that is no crack of its description."""
        own: Opening | None = getattr(self.structure, "opening", None)
        return own

    @property
    def bulges(self) -> bool:
        """Whether a held wall bulges in it, or slips below its top, which it may wherever it is cracked."""
        return self.opening is not None

    @cached_property
    def kind(self) -> Literal["cracks", "bulges", "slips", "between"]:
        """What it is one of: cracks, or of a held wall bulges, a top that slips, and what falls between ties."""
        if self.opening is None:
            return "cracks"
        if self.opening.between:
            return "between"
        wall: HeldWall | None = getattr(self.structure, "held_wall", None)
        return "slips" if wall and wall.slip(self.opening) else "bulges"

    @property
    def uplift_multiplier(self) -> float:
        """λ of limit analysis, with ties at the force at which they yield; without ties where its motion begins."""
        return self.mechanism.uplift_multiplier if self.limit is None else self.limit

    @property
    def critical_rotation(self) -> float:
        """φ_cr of its mechanism to its side, rad; nan where its motion cannot be followed, as `refusal` says."""
        return math.nan if self.refusal else self.side.critical_rotation

    @cached_property
    def refused(self) -> StructureError | None:
        """Why its motion cannot be followed; None where it can."""
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", StructureWarning)  # nobody asked for its restitution
                for side in self.structure.mechanism().sides:
                    _ = side.arc
        except StructureError as wrong:
            return wrong
        return None

    @property
    def refusal(self) -> str:
        """Why its motion cannot be followed, in a sentence; "" where it can."""
        return str(self.refused or "")

    @property
    def reactions(self) -> tuple[Reaction, ...]:
        """What holds it back as it starts to its side, N per metre; () of what cannot be followed or is not known."""
        asked: Callable[..., tuple[Reaction, ...]] | None = getattr(self.structure, "reactions", None)
        if self.refusal or asked is None:
            return ()
        try:
            if self.sign >= 0:
                return asked()
            least = -1e-12 * self.side.end_rotation
            pushed = self.side.uplift_multiplier * GRAVITY
            return asked(MotionState.of(self.mechanism, least, 0.0, ground=pushed))
        except UnknownContacts:
            return ()

    @property
    def side(self) -> Side:
        """The side to which it falls; of two alike the positive one."""
        return self.mechanism.sides[-1 if self.sign < 0 else 0]

    def is_own_of(self, structure: Structure) -> bool:
        """Whether it is the mechanism that a structure has as it is described."""
        if self.refusal:
            return False
        one, other = self.mechanism, structure.mechanism()
        alike = math.isclose(one.uplift_multiplier, other.uplift_multiplier, rel_tol=1e-6)
        return alike and math.isclose(one.critical_rotation, other.critical_rotation, rel_tol=1e-3)


class LeafAlone(NamedTuple):
    """A leaf by its name, "outer leaf", as a structure of its own."""

    name: str
    structure: Structure

    def named(self, candidates: Iterable[Candidate]) -> "Mechanisms":
        """Return mechanisms of the leaf as those of the wall, which name it."""
        return Mechanisms(map(self._named, candidates))

    def _named(self, candidate: Candidate) -> Candidate:
        alone = Phrase("{part} alone", part=self.name)
        opens = Phrase("{alone}, {opens}", alone=alone, opens=candidate.description)
        description = alone if candidate.description == AS_DESCRIBED else opens
        does = Phrase("{alone} {does}", alone=alone, does=candidate.name)
        return replace(candidate, description=description, name=does, part=self.name)


class Mechanisms(tuple[Candidate, ...]):
    """Mechanisms in which a structure may fall, in their order: the first one decides."""

    __slots__ = ()

    @property
    def counting(self) -> "Mechanisms":
        """Those that take part in the verdict."""
        return Mechanisms(one for one in self if one.counts)

    @property
    def followed(self) -> "Mechanisms":
        """Those whose motion can be followed."""
        return Mechanisms(one for one in self if not one.refusal)

    @property
    def cracks(self) -> "Mechanisms":
        """Those that open at a crack."""
        return Mechanisms(one for one in self if not one.bulges)

    @property
    def bulges(self) -> "Mechanisms":
        """What a held wall does wherever it is cracked."""
        return Mechanisms(one for one in self if one.bulges)

    @property
    def parts(self) -> "dict[str, Mechanisms]":
        """Those of each part, in their order: of all of it as one body, "", and of each leaf that falls alone."""
        names = dict.fromkeys(one.part for one in self)
        return {name: Mechanisms(one for one in self if one.part == name) for name in names}

    @property
    def of_all(self) -> "Mechanisms":
        """Those of all of it as one body."""
        return self.parts.get("", Mechanisms())

    @property
    def least_multiplier(self) -> float:
        """The least λ of limit analysis."""
        return min(one.uplift_multiplier for one in self)

    def described(self, description: str) -> Candidate | None:
        """Return the one of this description; None where none has it."""
        return next((one for one in self if one.description == description), None)

    @classmethod
    def by_multiplier(cls, cracked: Iterable[Candidate]) -> "Mechanisms":
        """Return cracks by their λ; of equal ones but for rounding, as along a solid spire, the lowest comes first."""
        return cls(sorted(cracked, key=lambda one: float(f"{one.uplift_multiplier:.9g}")))

    def with_bulges(self, bulges: "Mechanisms", *, is_known: bool) -> "Mechanisms":
        """Return the cracks of one body in their order, with what a held wall also does wherever it is cracked.

        That is its bulge of least λ whose motion can be followed, what falls as its top slips (theory: section 12.6),
        and what falls between ties. Each comes first where limit analysis, in which ties pull with the force at which
        they yield, finds it weaker than every crack. Unless it is known, a crack that ties keep shut for good is left
        out, as far as something else is left, and one below a top that slips before: what would hold it there does not.
        """
        first = {one.kind: one for one in reversed(bulges.followed)}
        further = [first[kind] for kind in ("bulges", "slips", "between") if kind in first]
        counting = list(self.counting)
        others = [one for one in self if not one.counts and math.isfinite(one.uplift_multiplier)]
        if not is_known:
            opens = [one for one in counting if math.isfinite(one.uplift_multiplier)]
            counting = opens if opens or further else counting
            if any(one.mechanism.can_overturn for one in further):
                counting = [one for one in counting if one.mechanism.can_overturn]
            if "slips" in first:
                slips_at = first["slips"].uplift_multiplier
                counting = [one for one in counting if one.uplift_multiplier <= slips_at]
        for bulge in further:
            is_weakest = all(bulge.uplift_multiplier < one.uplift_multiplier for one in counting)
            counting.insert(0 if is_weakest else len(counting), bulge)
        return Mechanisms((*counting, *others))

    def with_leaves(self, alone: "Sequence[Mechanisms]") -> "Mechanisms":
        """Return them with those of each leaf that may part, the weakest part first."""
        if not alone:
            return self
        together = Mechanisms(
            replace(one, description="all leaves together") if one.description == AS_DESCRIBED else one
            for one in self
        )
        return Mechanisms(chain(*sorted([together, *alone], key=lambda part: part[0].uplift_multiplier)))

    def with_family(self, family: Iterable[Candidate], alone: "Iterable[Mechanisms]") -> "Mechanisms":
        """Return every mechanism by its λ: cracks, what else is in the family of a held wall, and those of its leaves.

        A crack stands for that of the family of its name, which that places where λ is least, or for a stronger one.
        """

        def is_listed(listed: Candidate) -> bool:
            enough = (1 + 1e-6) * listed.uplift_multiplier
            return any(
                one.structure is listed.structure
                or (one.name == listed.name and one.uplift_multiplier <= enough)
                for one in self
            )

        further = (listed for listed in family if not is_listed(listed))
        return Mechanisms(sorted((*self, *further, *chain(*alone)), key=attrgetter("uplift_multiplier")))

    @property
    def with_geometry(self) -> "Mechanisms":
        """Those of one part, last the first crack once more where its restitution is typed too low."""
        first = next(iter(self.counting.cracks), None)
        balanced = None if first is None else first.structure.restitution_of_geometry
        if first is None or balanced is None:
            return self
        own, with_own = balanced
        words = f"restitution {own:.2f} of its geometry"
        livelier = replace(first, description=words, structure=with_own, of_geometry=True)
        if len(self) > 1:
            return Mechanisms((*self, livelier))
        typed = Phrase("restitution {typed:.2f} as typed", typed=first.mechanism.restitution)
        return Mechanisms((replace(first, description=typed), livelier))
