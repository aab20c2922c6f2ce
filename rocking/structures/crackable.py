"""What crushes at its joints or cracks: a structure of masonry, and one that may open elsewhere than described."""

import math
import warnings
from abc import abstractmethod
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

import numpy as np

from rocking.errors import DoesNotStandError, StructureError, StructureWarning
from rocking.structures.fields import CompressiveStrength, Value
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import HIGHEST_SHARE
from rocking.structures.structure import CRACKS, Candidate, Mechanisms, Structure
from rocking.warnings import Phrase, RockingWarning

USUAL_WEIGHT = 20e3
"""Weight of masonry where none is given, N/m³."""
WEAK_MASONRY = 2e6
"""Compressive strength of weak masonry, Pa, of which reports say what it would change."""


@dataclass(frozen=True, repr=False)
class Crushable(Structure):
    """A structure of masonry whose joints crush at their edges, so that its hinges move in (theory: section 12.8).

    compressive_strength: f_c, Pa; None: nothing crushes. It needs the `unit_weight` of the masonry, N/m³.
    """

    compressive_strength: CompressiveStrength = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.compressive_strength is not None:
            self._demand(
                getattr(self, "unit_weight", None) is not None,
                "unit_weight",
                ", but must be given with a compressive_strength, for what presses on the joints follows from it; give "
                "both, or none.",
            )

    def _stand_crushed(self) -> None:
        """Refuse what its own weight crushes; called once its other values are checked."""
        if self.compressive_strength is not None:
            self.mechanism()


def crushing(structure: Structure, strength: float = WEAK_MASONRY) -> Structure | None:
    """Return a structure of masonry that crushes at a `strength` [Pa], of a usual weight where none is given.

    None of what is not of masonry, states its own strength, or does not stand so.
    """
    if not isinstance(structure, Crushable) or structure.compressive_strength is not None:
        return None
    weight = getattr(structure, "unit_weight", None) or USUAL_WEIGHT
    values: dict[str, Any] = {"compressive_strength": strength, "unit_weight": weight}
    try:
        return replace(structure, **values)
    except StructureError:
        return None


@dataclass(frozen=True, repr=False)
class Crackable(Crushable):
    """A structure that may open somewhere else than where it is described.

    crack_name: what its candidates move ("hinge", "crack"). statics_chooses: whether codes check the mechanism of least
    λ alone, as between supports limit analysis finds it; otherwise every crack that may open is a mechanism of its own.
    _as_one_leaf: the values of its fields with which its leaves do not part.
    crack: "known" where it exists at the place of its description (a survey, a joint): it decides, and what another
    one would do is reported as well. None, the default: the place of the description is one of those at which it may
    crack, and each of them counts.
    """

    crack_name: ClassVar[str]
    statics_chooses: ClassVar[bool] = False
    _as_one_leaf: ClassVar[dict[str, Any]] = {}

    crack: Annotated[
        Literal["known"] | None,
        Value(
            "known where it is cracked at the place above (a survey, a joint), which then decides; left out: it may "
            "crack there or elsewhere, and each place counts",
            "known",
            phrase="{name} {value}",
        ),
    ] = field(default=None, kw_only=True)

    @property
    @abstractmethod
    def crack_position(self) -> float:
        """Height of the crack of its description above the base, m; nan where a height does not locate it."""

    @property
    @abstractmethod
    def crack_in_words(self) -> str:
        """The crack of its description, in words: "hinge at 1.6 m"."""

    @property
    def crack_is_known(self) -> bool:
        """Whether it is known how it opens, so that this decides and not what statics chooses."""
        return self.crack == "known"

    @property
    def known_crack(self) -> RockingWarning | None:
        """That its crack is known, and at what height where one locates it; None of one that may crack anywhere."""
        if not self.crack_is_known:
            return None
        if not math.isfinite(self.crack_position):
            return RockingWarning(StructureKind.CRACK_KNOWN)
        return RockingWarning.of(StructureKind.CRACK_KNOWN_AT, height_m=float(self.crack_position))

    @property
    def _bulges(self) -> Mechanisms:
        """What may form of a held wall wherever it is cracked, by their λ."""
        return Mechanisms()

    def _ranked(self, count: int) -> Mechanisms:
        return self._cracked(count).with_bulges(self._bulges, is_known=self.crack_is_known)

    def _cracked(self, count: int) -> Mechanisms:
        """The cracks of it that may form, `count` or one more; first the one that is known, or that statics chooses."""
        others = self._may_form(count)
        if not self.crack_is_known:
            for candidate in others:
                if candidate.position == self.crack_position and _alike(candidate.structure, self):
                    # one object, so that it is integrated once
                    candidate.structure.__dict__["_mechanism"] = self.mechanism()
            return others
        own = Candidate(self.crack_in_words, self.crack_position, self, limit=self._limit)
        not_counting = (
            replace(candidate, counts=False)
            for candidate in others
            if candidate.description != own.description
        )
        return Mechanisms([own, *not_counting])

    @property
    def _limit(self) -> float | None:
        """Its λ by limit analysis, in which ties pull with the force at which they yield; None without ties."""
        return None

    @abstractmethod
    def _may_form(self, count: int) -> Mechanisms:
        """The mechanisms that may form, by their λ."""


def unplaced(fields: str) -> StructureError:
    """Return the error of a crack that is known where nothing says where it is. fields: one of which has to say it."""
    return StructureError(
        f"crack is 'known', but {fields} is missing, which says where; give it, or leave crack out, so that every "
        "place counts.",
        crack="known",
    )


@dataclass(frozen=True, repr=False)
class CrackedAtHeight(Crackable):
    """A structure that opens along a horizontal section, at whatever height."""

    lowest_crack: ClassVar[float] = 0.0
    """Share of the height from which on it may open."""

    if TYPE_CHECKING:

        @property
        def height(self) -> float:
            """Height of the structure, of which the shares are taken, m."""

    @abstractmethod
    def _placed(self, height: float) -> dict[str, Any]:
        """The fields of its description that say that it is cracked at `height` [m] above its base, by name."""

    def cracked_at(self, height: float) -> Self:
        """Return this structure cracked at `height` [m] above its base."""
        return replace(self, **self._placed(height))

    @property
    def crack_in_words(self) -> str:
        return self._in_words(self.crack_position)

    def _in_words(self, height: float) -> str:
        return Phrase(f"{self.crack_name} at {{height:.4g}} m", height=float(height))

    def _places(self, count: int) -> list[float]:
        """The heights above the base [m] at which it may open, `count` over its height at least."""
        shares = np.linspace(self.lowest_crack, HIGHEST_SHARE, count)
        return [float(height) for height in self.height * shares]

    def _may_form(self, count: int) -> Mechanisms:
        """Each has its own momentum balance where no restitution is given.

        Where λ has its least value between two of the heights, the height of that is one more. Where ties hold it, λ is
        that of limit analysis. A crack at which what
        holds the structure leaves no mechanism is left out, and one with which it cannot overturn where with another
        one it can. Raises DoesNotStandError where it falls at rest with one of them and its crack is not known.
        """
        heights = sorted({*self._places(count), float(self.crack_position)})
        formed = [candidate for candidate in map(self._candidate, heights) if candidate]
        cracked = [
            candidate for candidate in formed if candidate.structure.mechanism().can_overturn
        ] or formed
        ranked = Mechanisms.by_multiplier(cracked)
        least = cracked.index(ranked[0])
        low = cracked[max(least - 1, 0)].position
        high = cracked[min(least + 1, len(cracked) - 1)].position
        weakest = self._weakest_between(low, high) if low < high else None
        # What is weaker by less than that is the same crack.
        if weakest and weakest.uplift_multiplier < (1 - 1e-5) * ranked[0].uplift_multiplier:
            return Mechanisms([weakest, *ranked])
        return ranked

    def _weakest_between(self, low: float, high: float) -> Candidate | None:
        """The candidate of least λ between two heights [m]."""
        from scipy.optimize import minimize_scalar  # slow to import, and needed here only

        def multiplier(height: float) -> float:
            candidate = self._candidate(height)
            return candidate.uplift_multiplier if candidate else np.inf

        accuracy = {"xatol": 1e-3 * (high - low)}
        with np.errstate(invalid="ignore"):  # λ is infinite where a crack leaves no mechanism
            least = minimize_scalar(multiplier, bounds=(low, high), method="bounded", options=accuracy)
        return self._candidate(float(least.x))

    @cached_property
    def _cracked_there_only(self) -> Self:
        """This structure with its crack known, from which those cracked elsewhere are made; its leaves together."""
        return replace(self, crack="known", **self._placed(self.crack_position), **self._as_one_leaf)

    def _candidate(self, height: float) -> Candidate | None:
        try:
            with warnings.catch_warnings():
                # a crack next to a support may keep nothing of an impact: nobody asked for that one
                warnings.simplefilter("ignore", StructureWarning)
                structure = self._cracked_there_only.cracked_at(height)
                structure.mechanism()
        except DoesNotStandError:
            if self.crack_is_known:
                return None  # it stands: it is not cracked there
            raise DoesNotStandError(
                f"the structure does not stand with the {self._in_words(height)}: what acts on it at rest turns it "
                "over; correct its loads or its sizes, or say by crack: known that it is cracked where it is described."
            ) from None
        except StructureError as wrong:
            if wrong.field == "restitution":
                raise  # it opens there, and only how it meets its foot again is not known
            return None
        return Candidate(self._in_words(height), height, structure, limit=structure._limit)

    def cracked_by_statics(self) -> Self:
        """Return this structure cracked where statics chooses."""
        return replace(self, crack=None).cracked_at(self._may_form(CRACKS)[0].position)


def _alike(one: Structure, other: Structure) -> bool:
    """Whether the mechanisms of two structures lift, overturn and lose at impacts alike."""
    first, second = (
        [
            (side.uplift_multiplier, side.critical_rotation, side.restitution)
            for side in structure.mechanism().sides
        ]
        for structure in (one, other)
    )
    return first == second
