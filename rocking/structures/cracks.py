"""Cracks: the ways in which a structure may fall (`Candidate`), and their order, which is made here alone."""

import math
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from itertools import chain
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple

from rocking.errors import StructureError, StructureWarning
from rocking.quantities import GRAVITY
from rocking.remarks import Phrase
from rocking.structures.linkage import Reaction, UnknownContacts
from rocking.structures.mechanism import Mechanism, Side

if TYPE_CHECKING:
    from rocking.structures.held_wall import HeldWall, Opening
    from rocking.structures.structure import Structure

AS_DESCRIBED = "as described"
"""The description of the one mechanism of what does not crack."""
CRACKS = 11
"""Number of mechanisms that are followed where more than one may form."""


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
    structure: "Structure"
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
    def falls_between_ties(self) -> bool:
        """Whether it falls between two ties of a row."""
        return self.opening is not None and self.opening.between

    @property
    def slips(self) -> bool:
        """Whether it is its top that slips under what lies on it."""
        wall: HeldWall | None = getattr(self.structure, "held_wall", None)
        return self.opening is not None and wall is not None and bool(wall.slip(self.opening))

    @property
    def bulges(self) -> bool:
        """Whether a held wall bulges in it, or slips below its top, which it may wherever it is cracked."""
        return self.opening is not None

    @property
    def stays_shut(self) -> bool:
        """Whether a tie without a strength would have to stretch for it to open outwards."""
        return not getattr(self.structure, "lets_go", True)

    @property
    def multiplier(self) -> float:
        """λ of its mechanism."""
        return self.mechanism.uplift_multiplier

    @property
    def uplift_multiplier(self) -> float:
        """λ of limit analysis, with ties at the force at which they yield; without ties where its motion begins."""
        return self.multiplier if self.limit is None else self.limit

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
        if self.refusal:
            return ()
        wall = self.structure
        try:
            if self.sign >= 0:
                return wall.reactions()
            least = -1e-12 * self.side.end_rotation
            return wall.reactions([least], [0.0], ground=[self.side.uplift_multiplier * GRAVITY])
        except UnknownContacts:
            return ()

    @property
    def side(self) -> Side:
        """The side to which it falls; of two alike the positive one."""
        return self.mechanism.sides[-1 if self.sign < 0 else 0]

    def is_own_of(self, structure: "Structure") -> bool:
        """Whether it is the mechanism that a structure has as it is described."""
        if self.refusal:
            return False
        one, other = self.mechanism, structure.mechanism()
        alike = math.isclose(one.uplift_multiplier, other.uplift_multiplier, rel_tol=1e-6)
        return alike and math.isclose(one.critical_rotation, other.critical_rotation, rel_tol=1e-3)

    def is_as(self, other: "Candidate") -> bool:
        """Whether it and another one are one mechanism, whose hinge two searches place a little apart."""
        if self.structure is other.structure or self.description == other.description:
            return True
        return not other.refusal and self.is_own_of(other.structure)


class LeafAlone(NamedTuple):
    """A leaf by its name, "outer leaf", as a structure of its own."""

    name: str
    structure: "Structure"

    def candidates(self, count: int) -> tuple[Candidate, ...]:
        """Return what may form of it, as of its wall."""
        return self.named(self.structure.candidates(count))

    def mechanisms(self) -> tuple[Candidate, ...]:
        """Return every mechanism of it, as of its wall."""
        return self.named(self.structure.mechanisms())

    def named(self, candidates: Iterable[Candidate]) -> tuple[Candidate, ...]:
        """Return mechanisms of the leaf as those of the wall, which name it."""
        return tuple(map(self._named, candidates))

    def _named(self, candidate: Candidate) -> Candidate:
        alone = Phrase("{part} alone", part=self.name)
        opens = Phrase("{alone}, {opens}", alone=alone, opens=candidate.description)
        description = alone if candidate.description == AS_DESCRIBED else opens
        does = Phrase("{alone} {does}", alone=alone, does=candidate.name)
        return replace(candidate, description=description, name=does, part=self.name)


def by_multiplier(cracked: Sequence[Candidate]) -> list[Candidate]:
    """Return cracks by their λ; of those equal but for rounding, as all along a solid spire, the lowest comes first."""
    return sorted(cracked, key=lambda candidate: float(f"{candidate.uplift_multiplier:.9g}"))


def ranked(
    cracked: Iterable[Candidate], bulges: Sequence[Candidate], *, is_known: bool
) -> tuple[Candidate, ...]:
    """Return the cracks of one body in their order, with what a held wall does besides wherever it is cracked.

    That is its bulge of least λ whose motion can be followed, what falls as its top slips (theory: section 12.6), and
    what falls between ties. Each comes first where limit analysis, in which ties pull with the force at which they
    yield, finds it weaker than every crack. Unless it is known, a crack that ties keep shut for good is left out, as
    far as something else is left, and one below a top that slips before: what would hold it there does not.
    """
    every_crack = list(cracked)
    followed = [bulge for bulge in bulges if not bulge.refusal]
    between = [bulge for bulge in followed if bulge.falls_between_ties][:1]
    at_ties = [bulge for bulge in followed if not bulge.falls_between_ties]
    slipping = [bulge for bulge in at_ties if bulge.slips][:1]
    bulging = [bulge for bulge in at_ties if not bulge.slips][:1]
    counting = [crack for crack in every_crack if crack.counts]
    not_counting = [
        crack for crack in every_crack if not crack.counts and math.isfinite(crack.uplift_multiplier)
    ]
    if not is_known:
        opens = [crack for crack in counting if math.isfinite(crack.uplift_multiplier)]
        counting = opens if opens or followed else counting
        if any(bulge.mechanism.can_overturn for bulge in (*bulging, *slipping, *between)):
            counting = [crack for crack in counting if crack.mechanism.can_overturn]
        if slipping:
            slips_at = slipping[0].uplift_multiplier
            counting = [crack for crack in counting if crack.uplift_multiplier <= slips_at]
    for bulge in (*bulging, *slipping, *between):
        is_weakest = all(bulge.uplift_multiplier < crack.uplift_multiplier for crack in counting)
        counting.insert(0 if is_weakest else len(counting), bulge)
    return (*counting, *not_counting)


def of_parts(
    together: tuple[Candidate, ...], alone: Sequence[tuple[Candidate, ...]]
) -> tuple[Candidate, ...]:
    """Return what may form of a wall whose leaves may part, alone or all as one body; the weakest part comes first."""
    if not alone:
        return together
    named = [
        replace(candidate, description="all leaves together")
        if candidate.description == AS_DESCRIBED
        else candidate
        for candidate in together
    ]
    return tuple(chain(*sorted([named, *alone], key=lambda part: part[0].uplift_multiplier)))


def every(
    cracked: Sequence[Candidate], family: Iterable[Candidate], alone: Iterable[Iterable[Candidate]]
) -> tuple[Candidate, ...]:
    """Return every mechanism by its λ: cracks, what else is in the family of a held wall, and those of each leaf."""
    further = [
        listed
        for listed in family
        if not any(_places_as_well(own, listed) or own.structure is listed.structure for own in cracked)
    ]
    return tuple(sorted((*cracked, *further, *chain(*alone)), key=attrgetter("uplift_multiplier")))


def _places_as_well(own: Candidate, listed: Candidate) -> bool:
    """Whether a crack is a mechanism of the family, which that places where λ is least, or a weaker one."""
    return own.name == listed.name and own.uplift_multiplier <= (1 + 1e-6) * listed.uplift_multiplier


def with_geometry(several: tuple[Candidate, ...]) -> tuple[Candidate, ...]:
    """Return what may form of one part, last the first crack once more where its restitution is typed too low."""
    first = next((candidate for candidate in several if candidate.counts and not candidate.bulges), None)
    balanced = None if first is None else first.structure.restitution_of_geometry
    if first is None or balanced is None:
        return several
    own, with_own = balanced
    livelier = replace(
        first,
        description=f"restitution {own:.2f} of its geometry",
        structure=with_own,
        of_geometry=True,
    )
    if len(several) == 1:
        typed = first.mechanism.restitution
        several = (replace(first, description=Phrase("restitution {typed:.2f} as typed", typed=typed)),)
    return (*several, livelier)
