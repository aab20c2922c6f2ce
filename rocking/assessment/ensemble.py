"""The ensemble: what becomes of a structure when its uncertain inputs, the causes, vary within stated ranges.

Each cause is uniform in its range and independent of the others. The ranges are assumptions, not measurements; the
ensemble says how sure an answer can be if they are right. Its members stand at the points of a deterministic design:
rank-1 lattices, the smaller ones contained in the larger.
"""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache, partial
from types import MappingProxyType

import numpy as np

from rocking.assessment.settings import SIZES, EnsembleSettings
from rocking.assessment.verdict import NEGLIGIBLE, Verdict, verdict
from rocking.errors import MotionError, RecordError
from rocking.motion.forcing import forcing_of
from rocking.motion.integration import TOLERANCES, Rocking, reduce
from rocking.motion.members import follow_factors
from rocking.quantities import within
from rocking.records import Accelerogram
from rocking.records.processing import process, variants
from rocking.records.rotation import aligned, rotate
from rocking.structures import Mechanism

CAUSES = ("amplitude", "restitution", "polarity", "direction", "processing", "vertical")
"""The causes: each is a coordinate of a point of the design."""
FIRST = 16
"""Members with which an ensemble begins."""
MOST_NEAR_A_LIMIT = 256
"""Members that an ensemble grows to where its verdict is not clear."""
UNANIMOUS = 64
"""Members of which none overturns, or none stands, that settle a verdict."""
FAR = 0.3
"""Rotation ratio that fewer members must all stay below to settle that the structure stands. The target `calibrate`
measures how many verdicts this changes, on sites that took no part in any fit."""
LATTICE_ERROR = 4.0
"""Members times the error of a probability that all but few cases stay below; `calibrate_ensemble` counts them."""
LEAST_LOSS = 1e-3
"""Share of the velocity that a member loses at an impact at least, unless the structure states less: without a loss it
would rock through millions of impacts below any rotation that matters, until the integration fails."""
AS_IT_IS = "unchanged"
"""Name of the processing that leaves a record as it is."""
DIRECTIONS = 8
"""Directions of the motion of two components, spread evenly over half a turn; the other half is that of the sign. The
target `calibrate_ensemble` holds their verdicts against draws over three times as many directions."""


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """The members of a structure under the ground motions that one record stands for.

    rotation_ratios: largest rotation over critical rotation of every member, (m,); inf overturns, 0 does not lift, nan
    failed. causes: value of each cause that varied, by member, (m,). settings: the ranges, with the structure's own
    range of the restitution. rotation_ratio: of the run as recorded, nan without one. reasons: why members failed, by
    their place. crack: what opens, as statics chooses it, where the structure does not say where it is cracked.
    elsewhere: the ensemble of another crack that may form and does not stand, where this one stands.
    """

    rotation_ratios: np.ndarray
    causes: Mapping[str, np.ndarray]
    settings: EnsembleSettings
    rotation_ratio: float = float("nan")
    reasons: Mapping[int, str] = field(default_factory=dict)
    crack: str = ""
    elsewhere: "Ensemble | None" = None

    def __repr__(self) -> str:
        return (
            f"<Ensemble: {self.verdict}, overturns in {self.overturning_members} of {self.members}, largest rotation "
            f"{self.rotation_ratio_low:.3g} to {self.rotation_ratio_high:.3g} of the critical one>"
        )

    @cached_property
    def _followed(self) -> np.ndarray:
        return self.rotation_ratios[~np.isnan(self.rotation_ratios)]

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
        """Share of members that overturn; nan without members."""
        return self.overturning_members / self.members if self.members else float("nan")

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
        """The quantile between the members at the middles of equal parts of probability; inf beside inf."""
        if not self.members:
            return float("nan")
        place = np.clip(share * self.members - 0.5, 0, self.members - 1)
        return float(np.interp(place, np.arange(self.members), np.sort(self._followed)))

    @property
    def verdict(self) -> Verdict:
        """The verdict on the structure: undecided, too, where it stands only with the crack that statics chooses."""
        alone = verdict(self.overturning_share, self.probability_error, self.settings.risk)
        return Verdict.UNDECIDED if alone is Verdict.STANDS and self.elsewhere is not None else alone

    @property
    def probability_error(self) -> float:
        """The most by which the share of members that overturn differs from that of very many members.

        It falls with the number of members itself, as they stand on a lattice, not with its root. It counts as none
        where UNANIMOUS members or more agree, or where fewer all stay FAR from overturning.
        """
        many = self.members >= UNANIMOUS and self.overturning_members in (0, self.members)
        return 0.0 if many or self.far else LATTICE_ERROR / max(self.members, 1)

    @property
    def far(self) -> bool:
        """Whether all members stay far from overturning."""
        return bool(self.members and self._followed.max() <= FAR)

    def followed_by(self, more: "Ensemble") -> "Ensemble":
        """Return the ensemble of these members and of `more`, of the same causes."""
        reasons = {self.rotation_ratios.size + place: reason for place, reason in more.reasons.items()}
        return replace(
            self,
            rotation_ratios=np.append(self.rotation_ratios, more.rotation_ratios),
            causes={name: np.append(each, more.causes[name]) for name, each in self.causes.items()},
            reasons={**self.reasons, **reasons},
        )

    def worst(self, cause: str) -> str:
        """Return the value of `cause` with which it rotates most on average; "" of a cause that did not vary."""
        if (values := self.causes.get(cause)) is None:
            return ""
        capped = np.minimum(self.rotation_ratios, 1.0)
        means = {str(name): float(np.nanmean(capped[values == name])) for name in np.unique(values)}
        return max(means, key=means.__getitem__)


@lru_cache(maxsize=2)  # the two components of a record
def processed(accelerogram: Accelerogram) -> Mapping[str, Accelerogram]:
    """Return the record after each variant of the processing, by name, but for those that do not fit the record.

    The one AS_IT_IS is the same object. The variants are computed once.
    """
    records = {}
    for name, processing in variants().items():
        with suppress(RecordError):
            records[name] = process(accelerogram, processing)
    return MappingProxyType(records)


@dataclass(frozen=True, eq=False)
class GroundMotions:
    """What the ground may have done: at least one horizontal motion by direction and processing, and the vertical one.

    All have the same samples. The members are shared out evenly to directions and to processings, and half of them
    feel the vertical motion where there is one.
    """

    horizontal: Mapping[tuple[str, str], Accelerogram]
    vertical: Accelerogram | None = None

    @classmethod
    def of(
        cls, *components: Accelerogram, vertical: Accelerogram | None = None, processing: bool = False
    ) -> "GroundMotions":
        """Return the motions of one component, or of two and the directions between them, DIRECTIONS in all.

        vertical: with one component it must have the same samples. processing: whether raw components enter after each
        variant of their processing. Raises RecordError for components that do not belong together.
        """
        raw = all(each.source.path and each.processed is False for each in components)
        variants_of = [processed(each) if processing and raw else {"": each} for each in components]
        names = [name for name in variants_of[0] if all(name in each for each in variants_of)]
        ends = {0: components[0].component or "first", DIRECTIONS // 2: components[-1].component or "second"}
        horizontal = {}
        for name in names:
            first, *others = (each[name] for each in variants_of)
            if not others:
                horizontal[first.component, name] = first
            for second in others:
                for place in range(DIRECTIONS):
                    motion = rotate(first, second, angle=np.pi * place / DIRECTIONS)
                    horizontal[ends.get(place, motion.component), name] = motion
        if vertical is not None and len(components) > 1:
            vertical = aligned(vertical, next(iter(horizontal.values())))
        return cls(horizontal, vertical)

    def scaled(self, factor: float) -> "GroundMotions":
        """Return the motions with the horizontal ones multiplied by `factor`."""
        horizontal = {each: motion.scaled(factor) for each, motion in self.horizontal.items()}
        return replace(self, horizontal=horizontal)


_GENERATOR = (1, 182667, 469891, 377, 1723, 1677)
"""Amplitude, restitution and polarity have the first components of the vector exod2_base2_m20 of Cools, Kuo & Nuyens
(2006), Constructing embedded lattice rules for multivariate integration, SIAM J. Sci. Comput. 28, 2162-2188, published
before any record here was seen. Its next component is that of the amplitude again at 64 points, so the others,
direction, processing and vertical, follow from the same criterion for SIZES: of all numbers, one after the other, the
one whose pairs with those before it have the least worst-case error (unanchored Sobolev space, order 2), relative to
the best at each size, at the worst size. No record takes part in it, so every site is left out of the choice."""
_SHIFT = 0.5 / 64 + 0.5 / SIZES[-1]
"""Of all points: the first coordinate of the 64 that are usual stands in the middle of its strata, but for half a step
of the largest lattice, which leaves no point of it on a border."""


@lru_cache(maxsize=16)
def lattice(size: int) -> np.ndarray:
    """Return `size` points in (0, 1), (size, 6), read-only; the first of them are those of a smaller lattice.

    size: one of SIZES. A point k has the coordinates k z/size modulo 1 with the generating vector z, moved by _SHIFT.
    Those of the lattice of a quarter the size come first.
    """
    order = np.arange(SIZES[0])
    while order.size < size:
        order = np.append(4 * order, np.setdiff1d(np.arange(4 * order.size), 4 * order))
    points = (order[:, None] * (np.array(_GENERATOR) % size) % size / size + _SHIFT) % 1.0
    points.setflags(write=False)
    return points


def design(settings: EnsembleSettings) -> np.ndarray:
    """Return the points of the members in the order in which they are followed, MOST_NEAR_A_LIMIT at least."""
    return lattice(max(settings.size, MOST_NEAR_A_LIMIT))


def ensemble(
    structure: Rocking,
    motions: GroundMotions,
    settings: EnsembleSettings | None = None,
    *,
    tolerance: float = 1e-6,
    verdict_only: bool = False,
    whether_it_stands: bool = False,
) -> Ensemble:
    """Follow `structure` through the members of its ensemble, the same ones at every call.

    It ends after FIRST members where they all rest. It grows from the number in the settings to MOST_NEAR_A_LIMIT
    members where that may settle an undecided verdict. verdict_only: it also ends after FIRST members where they all
    stay far from overturning, which settles the verdict but says less of the quantiles. whether_it_stands: it also
    ends where so many of FIRST overturn that the structure does not stand, and never grows. Raises MotionError as
    `integrate` does.
    """
    settings = settings or EnsembleSettings()
    points = design(settings)
    follow = partial(drawn, structure, motions, settings=settings, tolerance=tolerance)
    members = follow(points[:FIRST])
    quick = verdict_only or whether_it_stands
    falls = members.overturning_share - members.probability_error > settings.risk
    if (
        np.all(members.rotation_ratios <= NEGLIGIBLE)
        or (quick and members.far)
        or (whether_it_stands and falls)
    ):
        return members
    usual = max(settings.size, FIRST)
    if usual > FIRST:
        members = members.followed_by(follow(points[FIRST:usual]))
    opposite = min(members.overturning_share, 1 - members.overturning_share)
    near_a_limit = (
        members.verdict is Verdict.UNDECIDED and opposite - members.probability_error <= settings.risk
    )
    if near_a_limit and usual < MOST_NEAR_A_LIMIT and not whether_it_stands:
        members = members.followed_by(follow(points[usual:MOST_NEAR_A_LIMIT]))
    return members


def drawn(
    structure: Rocking,
    motions: GroundMotions,
    points: np.ndarray,
    settings: EnsembleSettings,
    *,
    tolerance: float = 1e-6,
) -> Ensemble:
    """Return the members at `points`, (m, 6) in (0, 1): one column for each of CAUSES, used where it varies."""
    reduced = reduce(structure)
    tolerance = within(MotionError, "tolerance", tolerance, *TOLERANCES)
    if isinstance(reduced, Mechanism) and reduced.restitution_range is not None:
        settings = replace(settings, restitution_range=reduced.restitution_range)
    amplitude = 1 + settings.amplitude_range * (2 * points[:, 0] - 1)
    offset = settings.restitution_range * (2 * points[:, 1] - 1)
    own = np.array([reduced.sides[0].restitution, reduced.sides[-1].restitution])
    restitution = np.clip(own + offset[:, None], 0.0, np.maximum(own, 1 - LEAST_LOSS))
    unlike = settings.polarity and not reduced.symmetric
    polarity = np.where(points[:, 2] < 0.5, -1.0, 1.0) if unlike else np.ones(len(points))
    directions, processings = (list(dict.fromkeys(each)) for each in zip(*motions.horizontal, strict=True))
    direction = np.array(directions)[(points[:, 3] * len(directions)).astype(int)]
    processing = np.array(processings)[(points[:, 4] * len(processings)).astype(int)]
    lifted = np.where(points[:, 5] < 0.5, amplitude, 0.0)
    varies = {
        "amplitude": amplitude if settings.amplitude_range else None,
        "restitution": offset if settings.restitution_range else None,
        "polarity": polarity if unlike else None,
        "direction": direction if len(directions) > 1 else None,
        "processing": processing if len(processings) > 1 else None,
        "vertical": lifted > 0 if motions.vertical is not None else None,
    }
    causes = {name: values for name, values in varies.items() if values is not None}
    ratios = np.full(len(points), np.nan)
    reasons: dict[int, str] = {}
    for (along, variant), motion in motions.horizontal.items():
        rows = np.flatnonzero((direction == along) & (processing == variant))
        if rows.size:
            forcing = forcing_of(motion, motions.vertical)
            lift = None if motions.vertical is None else lifted[rows]
            factors = amplitude[rows] * polarity[rows], lift, restitution[rows]
            responses = follow_factors(reduced, forcing, *factors, tolerance)
            ratios[rows] = responses.rotation_ratio
            reasons |= {int(rows[k]): reason for k, reason in responses.reasons.items()}
    return Ensemble(ratios, causes, settings, reasons=reasons)
