"""The ensemble: what becomes of a structure when all that is not known varies within stated ranges.

Each cause is uniform in its range and independent of the others. What the causes are is an assumption, not a
measurement; the ensemble says how sure an answer can be if they are right.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from rocking.assessment.design import SIZES, lattice
from rocking.assessment.verdict import NEGLIGIBLE, Verdict, verdict
from rocking.errors import ConfigurationError
from rocking.motion.integration import Rocking, reduce
from rocking.motion.members import Members, integrate_members
from rocking.pulses.components import rotated
from rocking.quantities import check_settings, setting
from rocking.records import Accelerogram, rotd
from rocking.records.vertical import aligned
from rocking.structures import EquivalentBlock, Mechanism

FIRST, MOST_NEAR_A_LIMIT = 16, 256
"""Members with which an ensemble begins, and those it grows to where its verdict is not clear."""
UNANIMOUS = 64
"""Members of which none overturns, or none stands, that settle a verdict."""
LATTICE_ERROR = 4.0
"""Members times the error of a probability that 95 in 100 cases stay below; see rocking.calibration.ensembles."""
_STRATA = 8
"""Parts of its range between which the share of a continuous cause is measured."""


@dataclass(frozen=True)
class EnsembleSettings:
    """What is not known of a case, and how much of it a verdict bears. Raises ConfigurationError."""

    members: int = setting(
        64,
        "members of an ensemble, taken up to the next of 16, 64, 256, 1024 and 4096; 0: none",
        ge=0,
        le=4096,
    )
    amplitude_range: float = setting(
        0.05, "the ground motion is known to plus or minus this share", ge=0, le=0.9
    )
    restitution_range: float = setting(
        0.05, "the restitution is known to plus or minus this much", ge=0, le=1
    )
    polarity: bool = setting(
        True, "whether the sign of the motion is unknown to a structure with unlike sides"
    )
    risk: float = setting(
        0.05, "largest probability of the opposite under which a structure stands or overturns", gt=0, le=0.45
    )

    def __post_init__(self) -> None:
        check_settings(ConfigurationError, self)

    @property
    def size(self) -> int:
        """Members of the design that is used; 0 for none."""
        return next(size for size in (0, *SIZES) if size >= self.members)


@dataclass(frozen=True, eq=False)
class GroundMotions:
    """What the ground may have done: at least one horizontal motion by direction and processing, and the vertical one.

    All have the same samples. The members are shared out evenly to directions and to processings, and half of them
    feel the vertical motion where there is one.
    """

    horizontal: Mapping[tuple[str, str], Accelerogram]
    vertical: Accelerogram | None = None

    @classmethod
    def of(cls, accelerogram: Accelerogram, vertical: Accelerogram | None = None) -> "GroundMotions":
        """One component as it is."""
        return cls({(accelerogram.component, ""): accelerogram}, vertical)

    @classmethod
    def of_pair(
        cls, first: Accelerogram, second: Accelerogram, vertical: Accelerogram | None = None
    ) -> "GroundMotions":
        """Both horizontal components, and the direction in which their acceleration peaks. Raises RecordError."""
        worst = rotated(first, second, np.radians(rotd(first, second).azimuth))
        size = worst.acceleration.size
        motions = [replace(each, acceleration=each.acceleration[:size]) for each in (first, second)]
        names = (first.component or "first", second.component or "second", worst.component)
        horizontal = {(name, ""): motion for name, motion in zip(names, [*motions, worst], strict=True)}
        return cls(horizontal, None if vertical is None else aligned(vertical, worst))

    @cached_property
    def directions(self) -> tuple[str, ...]:
        """The names of the directions."""
        return tuple(dict.fromkeys(direction for direction, _ in self.horizontal))

    @cached_property
    def processings(self) -> tuple[str, ...]:
        """The names of the processings."""
        return tuple(dict.fromkeys(processing for _, processing in self.horizontal))


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """The largest rotation ratio of every member, (m,): inf overturns, 0 does not lift, nan failed.

    causes: value of each cause that varied, by member, (m,). nominal: rotation ratio of the case as given.
    risk: largest probability of the opposite that a verdict bears.
    """

    rotation_ratios: np.ndarray
    causes: Mapping[str, np.ndarray]
    nominal: float
    risk: float
    reasons: Mapping[int, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        return (
            f"<Ensemble: {self.verdict}, overturns in {self.overturning} of {self.members}, largest rotation "
            f"{self.low:.3g} to {self.high:.3g} of the critical one>"
        )

    @property
    def members(self) -> int:
        """Members that could be followed."""
        return self._known.size

    @property
    def failed(self) -> int:
        """Members that could not."""
        return self.rotation_ratios.size - self._known.size

    @cached_property
    def overturning(self) -> int:
        """Members that overturn."""
        return int(np.isinf(self._known).sum())

    @property
    def overturning_probability(self) -> float:
        """Share of members that overturn; nan without members."""
        return self.overturning / self.members if self.members else float("nan")

    @property
    def uplift_probability(self) -> float:
        """Share of members that lift; nan without members."""
        return float((self._known > 0).mean()) if self.members else float("nan")

    @property
    def low(self) -> float:
        """5 % quantile of the rotation ratio."""
        return self._quantile(0.05)

    @property
    def median(self) -> float:
        """Median of the rotation ratio."""
        return self._quantile(0.5)

    @property
    def high(self) -> float:
        """95 % quantile of the rotation ratio; inf where more than 5 % overturn."""
        return self._quantile(0.95)

    @property
    def verdict(self) -> Verdict:
        """What can be said of the structure."""
        if self.members and np.all(self._known <= NEGLIGIBLE):
            return Verdict.STANDS
        return verdict(self.overturning_probability, self.probability_error, self.risk)

    @property
    def probability_error(self) -> float:
        """How far the probability may lie from that of very many members; none where so many agree that it is small.

        Of a lattice the error falls with the members themselves, not with their root. No member of 64 or more that
        differs counts as none that does.
        """
        unanimous = self.members >= UNANIMOUS and self.overturning in (0, self.members)
        return 0.0 if unanimous else LATTICE_ERROR / max(self.members, 1)

    @cached_property
    def shares(self) -> dict[str, float]:
        """Share of the variance of the rotation ratio (1 where it overturns) that each cause explains by itself."""
        known = ~np.isnan(self.rotation_ratios)
        answer = np.minimum(self._known, 1.0)
        return {name: _share(answer, values[known]) for name, values in self.causes.items()}

    @cached_property
    def _known(self) -> np.ndarray:
        return self.rotation_ratios[~np.isnan(self.rotation_ratios)]

    def _quantile(self, share: float) -> float:
        """Linear between the members, taken at the middles of equal parts of probability; inf beside one that is."""
        if not self.members:
            return float("nan")
        ordered = np.sort(self._known)
        place = np.clip(share * ordered.size - 0.5, 0, ordered.size - 1)
        below, above = ordered[int(np.floor(place))], ordered[int(np.ceil(place))]
        between = place - np.floor(place)
        return float(below if between == 0 or below == above else below + between * (above - below))


def ensemble(
    structure: Rocking,
    motions: GroundMotions,
    settings: EnsembleSettings | None = None,
    *,
    nominal: float = float("nan"),
    tolerance: float = 1e-6,
) -> Ensemble:
    """Follow `structure` through the members of its ensemble, the same ones at every call.

    It ends after FIRST members that all rest, and grows to MOST_NEAR_A_LIMIT where those asked for leave a verdict in
    doubt that more may settle. Raises MotionError as `integrate` does.
    """
    settings = settings or EnsembleSettings()
    reduced = reduce(structure)
    points = lattice(max(settings.size, MOST_NEAR_A_LIMIT), CAUSES)
    found = drawn(reduced, motions, points[:FIRST], settings, nominal=nominal, tolerance=tolerance)
    for size in (settings.size, MOST_NEAR_A_LIMIT):
        done = found.rotation_ratios.size
        wanted = not np.all(found.rotation_ratios <= NEGLIGIBLE) if done == FIRST else _near_a_limit(found)
        if size > done and wanted:
            more = drawn(reduced, motions, points[done:size], settings, nominal=nominal, tolerance=tolerance)
            found = _joined(found, more)
    return found


CAUSES = 6
"""Coordinates of a point of the design: amplitude, restitution, polarity, direction, processing, vertical."""


def _near_a_limit(found: Ensemble) -> bool:
    opposite = min(found.overturning_probability, 1 - found.overturning_probability)
    return found.verdict is Verdict.UNDECIDED and opposite - found.probability_error <= found.risk


def drawn(
    structure: Rocking,
    motions: GroundMotions,
    points: np.ndarray,
    settings: EnsembleSettings,
    *,
    nominal: float = float("nan"),
    tolerance: float = 1e-6,
) -> Ensemble:
    """Return the members at `points`, (m, 6) in (0, 1): one column for each cause, used where it varies."""
    reduced = reduce(structure)
    amplitude, restitution, polarity, direction, processing, vertical = points.T
    factor = 1 + settings.amplitude_range * (2 * amplitude - 1)
    own = np.array([side.restitution for side in (_sides(reduced)[0], _sides(reduced)[-1])])
    offset = settings.restitution_range * (2 * restitution - 1)
    eta = np.clip(own + offset[:, None], 0.0, 1.0)
    unlike = settings.polarity and not reduced.symmetric
    sign = np.where((polarity < 0.5) & unlike, -1.0, 1.0)
    acts = (vertical < 0.5) if motions.vertical is not None else np.zeros(len(points), dtype=bool)
    along = _chosen(direction, motions.directions)
    done = _chosen(processing, motions.processings)
    ratios = np.full(len(points), np.nan)
    reasons: dict[int, str] = {}
    for key, motion in motions.horizontal.items():
        rows = np.flatnonzero((along == key[0]) & (done == key[1]))
        if not rows.size:
            continue
        members = Members(factor[rows], sign[rows], acts[rows], eta[rows])
        responses = integrate_members(reduced, motion, members, tolerance, vertical=motions.vertical)
        ratios[rows] = responses.rotation_ratio
        reasons |= {int(rows[k]): reason for k, reason in responses.reasons.items()}
    varied = {
        "amplitude": (settings.amplitude_range > 0, factor),
        "restitution": (settings.restitution_range > 0, offset),
        "polarity": (unlike, sign),
        "direction": (len(motions.directions) > 1, along),
        "processing": (len(motions.processings) > 1, done),
        "vertical": (motions.vertical is not None, acts),
    }
    causes = {name: values for name, (varies, values) in varied.items() if varies}
    return Ensemble(ratios, causes, nominal, settings.risk, reasons)


def _sides(reduced: Mechanism | EquivalentBlock) -> Sequence[Any]:
    if isinstance(reduced, Mechanism):
        return reduced.sides
    return (reduced,) if reduced.other_side is None else (reduced, reduced.other_side)


def _chosen(places: np.ndarray, names: Sequence[str]) -> np.ndarray:
    return np.array(names)[np.minimum((places * len(names)).astype(int), len(names) - 1)]


def _joined(first: Ensemble, more: Ensemble) -> Ensemble:
    count = first.rotation_ratios.size
    return Ensemble(
        np.concatenate([first.rotation_ratios, more.rotation_ratios]),
        {name: np.concatenate([values, more.causes[name]]) for name, values in first.causes.items()},
        first.nominal,
        first.risk,
        {**first.reasons, **{count + k: reason for k, reason in more.reasons.items()}},
    )


def _share(answer: np.ndarray, values: np.ndarray) -> float:
    """The variance between the groups of a cause over the whole, less what chance alone would put there (ω²)."""
    total = float(((answer - answer.mean()) ** 2).sum())
    if answer.size < 2 * _STRATA or total == 0:
        return 0.0
    kinds, group = np.unique(values, return_inverse=True)
    if values.dtype.kind == "f" and kinds.size > _STRATA:
        group = np.argsort(np.argsort(values, kind="stable")) * _STRATA // values.size
    counts = np.bincount(group)
    means = np.bincount(group, answer) / counts
    between = float((counts * (means - answer.mean()) ** 2).sum())
    within = (total - between) / (answer.size - counts.size)
    return float(np.clip((between - (counts.size - 1) * within) / total, 0.0, 1.0))
