"""The ensemble: what becomes of a structure when its uncertain inputs, the causes, vary within their ranges.

Each cause is uniform in its range and independent of the others. The ranges are assumptions, not measurements; the
ensemble says how sure an answer can be if they are right. A cause is either chance, which no survey of the structure
can remove, or ignorance, which a measurement can.

The points stand on rank-1 lattices, the smaller ones contained in the larger. To add a cause, put it into CAUSES with
the next component of the generating vector by the criterion stated there, and let `drawn` use its values.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property, lru_cache, partial
from typing import NamedTuple

import numpy as np

from rocking.assessment.decide import CrackFacts
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import SIZES, EnsembleSettings
from rocking.errors import MotionError
from rocking.motion.integration import LARGEST_TOLERANCE, LEAST_TOLERANCE, Rocking, Runs, follow_runs, reduce
from rocking.motion.table import forcing_of
from rocking.quantities import within
from rocking.structures.mechanism import EquivalentBlock, Mechanism


class Origin(StrEnum):
    """Why an input is not known."""

    CHANCE = "chance"
    """It is another at the next earthquake."""
    IGNORANCE = "ignorance"
    """It has one value, which a measurement or a better record would tell."""


@dataclass(frozen=True)
class Range:
    """A few values, each as likely as the others, and all those within ± `half_width` of them."""

    values: tuple[object, ...]
    half_width: float = 0.0

    @property
    def varies(self) -> bool:
        """Whether it holds more than one value."""
        return len(self.values) > 1 or self.half_width > 0

    def at(self, coordinates: np.ndarray) -> np.ndarray:
        """Return the values (m,) at coordinates (m,) in (0, 1)."""
        drawn: np.ndarray = np.array(self.values)[(coordinates * len(self.values)).astype(int)]
        return drawn + self.half_width * (2 * coordinates - 1) if self.half_width else drawn


@dataclass(frozen=True, eq=False)
class Situation:
    """The case on which the ranges of the causes depend."""

    structure: Mechanism | EquivalentBlock
    motions: GroundMotions
    settings: EnsembleSettings

    @classmethod
    def of(
        cls, structure: Mechanism | EquivalentBlock, motions: GroundMotions, settings: EnsembleSettings
    ) -> "Situation":
        """Return the situation with the structure's own range of the restitution where it states one."""
        own = structure.restitution_range if isinstance(structure, Mechanism) else None
        if own is not None:
            settings = replace(settings, restitution_range=own)
        return cls(structure, motions, settings)


@dataclass(frozen=True)
class Cause:
    """One input that is not known.

    range_in: its range in a situation. generator: its component of the generating vector of the lattices.
    """

    name: str
    origin: Origin
    generator: int
    range_in: Callable[[Situation], Range]


CAUSES = (
    # A factor on the ground motion, the vertical component included.
    Cause("amplitude", Origin.IGNORANCE, 1, lambda case: Range((1.0,), case.settings.amplitude_range)),
    # A difference from the restitution of the structure.
    Cause(
        "restitution", Origin.IGNORANCE, 182667, lambda case: Range((0.0,), case.settings.restitution_range)
    ),
    # The sign of the horizontal motion changes nothing for a structure with two sides alike.
    Cause(
        "polarity",
        Origin.CHANCE,
        469891,
        lambda case: Range(
            (-1.0, 1.0) if case.settings.polarity and not case.structure.symmetric else (1.0,)
        ),
    ),
    Cause("direction", Origin.CHANCE, 377, lambda case: Range(case.motions.directions)),
    Cause("processing", Origin.IGNORANCE, 1723, lambda case: Range(case.motions.processings)),
    # Half of the members feel the vertical motion where there is one.
    Cause(
        "vertical",
        Origin.IGNORANCE,
        1677,
        lambda case: Range((False,) if case.motions.vertical is None else (True, False)),
    ),
)
"""Every cause, in the order of the coordinates of a point.

Amplitude, restitution and polarity have the first components of the vector exod2_base2_m20 of Cools, Kuo & Nuyens
(2006), Constructing embedded lattice rules for multivariate integration, SIAM J. Sci. Comput. 28, 2162-2188, published
before any record here was seen. Its next component is that of the amplitude again at 64 points, so the others,
direction, processing and vertical, follow from the same criterion for SIZES: of all numbers, one after the other, the
one whose pairs with those before it have the least worst-case error (unanchored Sobolev space, order 2), relative to
the best at each size, at the worst size. No record takes part in it, so every site is left out of the choice."""
_SHIFT = 0.5 / 64 + 0.5 / SIZES[-1]
"""Shift of all points: the first coordinate of the 64 that are usual stands in the middle of its strata, but for half a
step of the largest lattice, which leaves no point of it on a border."""


@lru_cache(maxsize=16)
def lattice(size: int) -> np.ndarray:
    """Return `size` points in (0, 1), one coordinate for each of CAUSES, read-only.

    size: one of SIZES. The points of a smaller lattice come first. A point k has the coordinates k z/size modulo 1 with
    the generating vector z, moved by _SHIFT. Those of the lattice of a quarter the size come first.
    """
    order = np.arange(SIZES[0])
    while order.size < size:
        order = np.append(4 * order, np.setdiff1d(np.arange(4 * order.size), 4 * order))
    generator = np.array([cause.generator for cause in CAUSES])
    points: np.ndarray = (order[:, None] * (generator % size) % size / size + _SHIFT) % 1.0
    points.setflags(write=False)
    return points


@dataclass(frozen=True, eq=False, kw_only=True)
class CauseValues:
    """The value of each of CAUSES by member, (m,) each."""

    amplitude: np.ndarray
    restitution: np.ndarray
    polarity: np.ndarray
    direction: np.ndarray
    processing: np.ndarray
    vertical: np.ndarray

    def of_members(self, places: np.ndarray) -> "CauseValues":
        """Return those of some members, by their places (k,)."""
        return CauseValues(**{cause.name: getattr(self, cause.name)[places] for cause in CAUSES})


def draw(situation: Situation, points: np.ndarray) -> CauseValues:
    """Return the values of members at `points`, (m, c) in (0, 1): one coordinate for each of CAUSES."""
    return CauseValues(
        **{
            cause.name: cause.range_in(situation).at(coordinates)
            for cause, coordinates in zip(CAUSES, points.T, strict=True)
        }
    )


FIRST = 16
"""Members with which an ensemble begins."""
GROWTH = (64, 256, 1024)
"""Members that an ensemble grows to in turn while fewer leave its verdict open. At 256 the error still covers 3 % of
the shares about each edge, and nearly all verdicts that very many members changed lay there
(docs/research/stability.py)."""
LEAST_LOSS = 1e-3
"""Share of the velocity that a member loses at an impact at least, unless the structure states less: without a loss it
would rock through millions of impacts below any rotation that matters, until the integration fails."""


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """The members of a structure under the ground motions that one record stands for.

    rotation_ratios: largest rotation over critical rotation of every member, (m,); inf overturns, 0 does not lift, nan
    failed. causes: value of each cause that varied, by member, (m,). settings: the ranges, with the structure's own
    range of the restitution. reasons: why members failed, by their place.
    """

    rotation_ratios: np.ndarray
    causes: Mapping[str, np.ndarray]
    settings: EnsembleSettings
    reasons: Mapping[int, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        return (
            f"<Ensemble: overturns in {self.overturning_members} of {self.members}, largest rotation "
            f"{self.rotation_ratio_low:.3g} to {self.rotation_ratio_high:.3g} of the critical one>"
        )

    @cached_property
    def _followed(self) -> np.ndarray:
        followed: np.ndarray = self.rotation_ratios[~np.isnan(self.rotation_ratios)]
        return followed

    @property
    def members(self) -> int:
        """Members that could be followed."""
        return self._followed.size

    @property
    def failed_members(self) -> int:
        """Members that could not."""
        return self.rotation_ratios.size - self.members

    @cached_property
    def overturning_members(self) -> int:
        """Members that overturn."""
        return int(np.isinf(self._followed).sum())

    @property
    def overturning_share(self) -> float:
        """Share of the members that overturn, those that failed counted as falling; nan without members."""
        return self.facts().share

    @property
    def rotation_ratio_low(self) -> float:
        """5 % quantile of the rotation ratio."""
        return self._quantile(0.05)

    @property
    def rotation_ratio_median(self) -> float:
        """Median of the rotation ratio."""
        return self._quantile(0.5)

    @property
    def rotation_ratio_high(self) -> float:
        """95 % quantile of the rotation ratio; inf where more than 5 % overturn."""
        return self._quantile(0.95)

    def _quantile(self, share: float) -> float:
        """The quantile between the members at the middles of equal parts of probability; inf next to inf."""
        if not self.members:
            return float("nan")
        places = np.arange(self.members)
        place = np.clip(share * self.members - 0.5, 0, self.members - 1)
        return float(np.interp(place, places, np.sort(self._followed)))

    def facts(self, name: str = "") -> CrackFacts:
        """Return the facts of these members from which the decision follows. name: of their crack."""
        return CrackFacts(
            name=name,
            falls=self.overturning_members,
            followed=self.members,
            failed=self.failed_members,
            farthest=float(self._followed.max()) if self.members else np.nan,
        )

    def overturning_beyond(self, rotation_ratio: float) -> "Ensemble":
        """Return it with each member that rotates further counted as one that overturns."""
        ratios = np.where(self.rotation_ratios > rotation_ratio, np.inf, self.rotation_ratios)
        return replace(self, rotation_ratios=ratios)

    def followed_by(self, more: "Ensemble") -> "Ensemble":
        """Return the ensemble of these members and of `more`, of the same causes."""
        before = self.rotation_ratios.size
        reasons = {before + place: reason for place, reason in more.reasons.items()}
        return replace(
            self,
            rotation_ratios=np.append(self.rotation_ratios, more.rotation_ratios),
            causes={name: np.append(values, more.causes[name]) for name, values in self.causes.items()},
            reasons={**self.reasons, **reasons},
        )

    def worst(self, cause: str) -> str:
        """Return the value of `cause` with which it rotates most on average; "" of a cause that did not vary."""
        values = self.causes.get(cause)
        if values is None:
            return ""
        # What overturns counts as a rotation to the critical one, so that one fall does not outweigh all others.
        capped = np.minimum(self.rotation_ratios, 1.0)
        means = {str(value): float(np.nanmean(capped[values == value])) for value in np.unique(values)}
        return max(means, key=means.__getitem__)


NO_MEMBERS = Ensemble(np.empty(0), {}, EnsembleSettings())
"""The ensemble of what was followed without one."""


def design(settings: EnsembleSettings) -> np.ndarray:
    """Return the points of the members in the order in which they are followed, the last of GROWTH at least."""
    return lattice(max(settings.size, GROWTH[-1]))


def ensemble(
    structure: Rocking,
    motions: GroundMotions,
    settings: EnsembleSettings | None = None,
    *,
    tolerance: float = 1e-6,
    verdict_only: bool = False,
    grows: bool = True,
) -> Ensemble:
    """Follow `structure` through the members of its ensemble, the same ones at every call.

    It ends after FIRST members where they all rest. Unless `grows` is False, it grows from the number in the settings
    as `grown` says. verdict_only: it also ends after FIRST members where they all stay far from overturning, which
    settles the verdict but says less of the quantiles. Raises MotionError as `integrate` does.
    """
    settings = settings or EnsembleSettings()
    points = design(settings)
    follow = partial(drawn, structure, motions, settings=settings, tolerance=tolerance)

    members = follow(points[:FIRST])
    rest = bool(np.all(members.rotation_ratios <= NEGLIGIBLE))
    if rest or (verdict_only and not members.facts().share_error):
        return members

    followed = max(settings.size, FIRST)
    if followed > FIRST:
        members = members.followed_by(follow(points[FIRST:followed]))
    return grown(members, structure, motions, settings, tolerance=tolerance) if grows else members


def grown(
    members: Ensemble,
    structure: Rocking,
    motions: GroundMotions,
    settings: EnsembleSettings,
    *,
    tolerance: float,
) -> Ensemble:
    """Return the ensemble with the members of GROWTH that its verdict needs.

    structure, motions, settings, tolerance: those of the `members` so far.
    """
    points = design(settings)
    for size in GROWTH:
        followed = members.rotation_ratios.size
        if followed < size and members.facts().is_near_an_edge(settings.risk):
            more = drawn(structure, motions, points[followed:size], settings, tolerance=tolerance)
            members = members.followed_by(more)
    return members


def drawn(
    structure: Rocking,
    motions: GroundMotions,
    points: np.ndarray,
    settings: EnsembleSettings,
    *,
    tolerance: float = 1e-6,
) -> Ensemble:
    """Return the members at `points`, (m, c) in (0, 1): one coordinate for each of CAUSES, used where it varies."""
    reduced = reduce(structure)
    tolerance = within(MotionError, "tolerance", tolerance, low=LEAST_TOLERANCE, high=LARGEST_TOLERANCE)
    situation = Situation.of(reduced, motions, settings)
    values = draw(situation, points)
    followed = followed_at(reduced, motions, values, np.ones(1), tolerance=tolerance)
    varied = {cause.name: getattr(values, cause.name) for cause in CAUSES if cause.range_in(situation).varies}
    return Ensemble(followed.rotation_ratios[0], varied, situation.settings, reasons=followed.reasons)


class Followed(NamedTuple):
    """Members that were followed at several factors on the motion.

    rotation_ratios: (k, m) by factor and member. reasons: why a member failed, by its place.
    """

    rotation_ratios: np.ndarray
    reasons: dict[int, str]


def followed_at(
    structure: Mechanism | EquivalentBlock,
    motions: GroundMotions,
    values: CauseValues,
    factors: np.ndarray,
    *,
    tolerance: float,
) -> Followed:
    """Follow members with these `values` at `factors` (k,) on the motion, the vertical component included."""
    horizontal = values.amplitude * values.polarity
    vertical = values.amplitude * values.vertical
    own_restitution = np.array([structure.sides[0].restitution, structure.sides[-1].restitution])
    # A structure that states a smaller loss than the least keeps its own.
    most = np.maximum(own_restitution, 1 - LEAST_LOSS)
    restitution = np.clip(own_restitution + values.restitution[:, None], 0.0, most)

    ratios = np.full((factors.size, horizontal.size), np.nan)
    reasons: dict[int, str] = {}
    for direction, processing in motions.horizontal:
        is_own = (values.direction == direction) & (values.processing == processing)
        own = np.flatnonzero(is_own)
        if not own.size:
            continue
        # Every factor with every member that meets this motion: one run each, factor by factor.
        along = np.outer(factors, horizontal[own]).ravel()
        lift = None
        if motions.vertical is not None:
            lift = np.outer(factors, vertical[own]).ravel()
        of_runs = np.tile(restitution[own], (factors.size, 1))
        forcing = forcing_of(motions.horizontal[direction, processing], motions.vertical)
        responses = follow_runs(structure, forcing, Runs(along, lift, of_runs), tolerance)
        ratios[:, own] = responses.rotation_ratio.reshape(factors.size, own.size)
        for run, reason in responses.reasons.items():
            member = int(own[run % own.size])
            reasons[member] = reason
    return Followed(ratios, reasons)
