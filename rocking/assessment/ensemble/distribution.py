"""Ensemble: what is not known of a case, and the distribution of the largest rotation over its members."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rocking.assessment.verdict import NEGLIGIBLE, Verdict, verdict
from rocking.described import check_described, described
from rocking.errors import ConfigurationError

SIZES = (16, 64, 256, 1024, 4096)
"""Numbers of points that a design may have; each is contained in the next."""


@dataclass(frozen=True)
class EnsembleSettings:
    """What is not known of a case, and how much of it a verdict bears. Raises ConfigurationError."""

    members: int = described(
        64,
        "members of an ensemble, taken up to the next of 16, 64, 256, 1024 and 4096; 0: none",
        ge=0,
        le=4096,
    )
    amplitude_range: float = described(
        0.05, "the ground motion is known to plus or minus this share", ge=0, le=0.9
    )
    restitution_range: float = described(
        0.05,
        "the restitution is known to plus or minus this much, where a structure does not say its own",
        ge=0,
        le=1,
    )
    polarity: bool = described(
        True, "whether the sign of the motion is unknown to a structure with unlike sides"
    )
    processing: bool = described(
        True, "whether baseline and corner frequency of a record are unknown whose file says that it is raw"
    )
    risk: float = described(
        0.05, "largest probability of the opposite under which a structure stands or overturns", gt=0, le=0.45
    )

    def __post_init__(self) -> None:
        check_described(ConfigurationError, self)

    @property
    def size(self) -> int:
        """Members of the design that is used; 0 for none."""
        return next(size for size in (0, *SIZES) if size >= self.members)


UNANIMOUS = 64
"""Members of which none overturns, or none stands, that settle a verdict."""
FAR = 0.3
"""Largest rotation ratio of fewer members up to which they settle that it stands: of 16 on the sites for choosing, no
case up to it overturned in more than 2 % of 64. docs/research measures what it does on all sites."""
LATTICE_ERROR = 4.0
"""Members times the error of a probability that 95 in 100 cases stay below; see docs/research/ensembles.py."""
_STRATA = 8
"""Parts of its range between which the share of a continuous cause is measured."""


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """The largest rotation ratio of every member, (m,): inf overturns, 0 does not lift, nan failed.

    causes: value of each cause that varied, by member, (m,). nominal: rotation ratio of the case as given.
    settings: what varied by how much, with the structure's own range of the restitution.
    """

    rotation_ratios: np.ndarray
    causes: Mapping[str, np.ndarray]
    nominal: float
    settings: EnsembleSettings
    reasons: Mapping[int, str] = field(default_factory=dict)
    crack: str = ""
    """What opens, as statics chooses it, where the structure does not say where it is cracked."""
    elsewhere: "Ensemble | None" = None
    """That of another crack that may form and does not stand, where this one stands."""

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
    def overturning_share(self) -> float:
        """Share of members that overturn; nan without members."""
        return self.overturning / self.members if self.members else float("nan")

    @property
    def uplift_share(self) -> float:
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
        """What can be said of the structure: undecided, too, where it stands only as statics lets it crack."""
        alone = self._verdict
        return Verdict.UNDECIDED if alone is Verdict.STANDS and self.elsewhere is not None else alone

    @property
    def _verdict(self) -> Verdict:
        """That of this mechanism alone."""
        if self.members and np.all(self._known <= NEGLIGIBLE):
            return Verdict.STANDS
        return verdict(self.overturning_share, self.probability_error, self.settings.risk)

    @property
    def probability_error(self) -> float:
        """How far the probability may lie from that of very many members; none where so many agree that it is small.

        Of a lattice the error falls with the members themselves, not with their root. No member of UNANIMOUS or more
        that differs counts as none that does, and so do fewer that all stay FAR from overturning.
        """
        many = self.members >= UNANIMOUS and self.overturning in (0, self.members)
        return 0.0 if many or self.far else LATTICE_ERROR / max(self.members, 1)

    @property
    def far(self) -> bool:
        """Whether all members stay far from overturning."""
        return bool(self.members and self._known.max() <= FAR)

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
