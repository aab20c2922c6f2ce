"""Verdicts, methods, and how a prediction stands to the integration: each word and threshold is defined here once.

A structure rests, rocks or overturns. It rests up to `NEGLIGIBLE` of its critical rotation, lifted or not: whether a
rotation is exactly zero hangs on the last digit of the uplift acceleration, and a tremor below a thousandth of the
critical rotation, far below what any scatter of restitution or amplitude does, can neither harm nor decide anything. A
threshold of zero would count each such tremor that a prediction leaves out as uplift missed. Predicted over integrated
rotation, in contrast, is given wherever both are lifted and stay up: without the smallest predictions, the share that
lies within a factor two would look better than it is.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable
from enum import StrEnum

NEGLIGIBLE = 1e-3
"""Largest rotation over critical rotation at which a structure counts as resting."""
CLOSE = 0.1
"""Relative difference up to which the words are "within 10 %"."""


class Verdict(StrEnum):
    """The verdict on a structure under a ground motion, with all uncertain inputs considered.

    >>> [str(verdict) for verdict in rocking.Verdict]
    ['stands', 'overturns', 'undecided', 'unknown', 'cannot overturn']
    """

    STANDS = "stands"
    OVERTURNS = "overturns"
    UNDECIDED = "undecided"
    UNKNOWN = "unknown"
    """Nothing could be computed."""
    CANNOT_OVERTURN = "cannot overturn"
    """It stands under this motion, and what holds it lets go under no other."""

    @property
    def stays_up(self) -> bool:
        """Whether the structure stays up, because this motion does not overturn it or because none can."""
        return self in (Verdict.STANDS, Verdict.CANNOT_OVERTURN)


ORDER = (
    Verdict.OVERTURNS,
    Verdict.UNDECIDED,
    Verdict.UNKNOWN,
    Verdict.STANDS,
    Verdict.CANNOT_OVERTURN,
)
"""The worst verdict first; what could not be computed may overturn."""
BOTH_COMPONENTS = "both"
"""In place of a component: all directions of a record."""
POLARITIES = {"1.0": "as recorded", "-1.0": "reversed"}
"""The sign of a motion in words."""


class Judgement(ABC):
    """A verdict with its counts, as a result decides it or as a row of verdicts holds it; and the words for both."""

    __slots__ = ()

    @property
    @abstractmethod
    def structure(self) -> str:
        """Name of the structure."""

    @property
    @abstractmethod
    def support_period_s(self) -> float | None:
        """First period of the support, s; 0 on the ground below one, None where the structure has no support."""

    @property
    @abstractmethod
    def verdict(self) -> Verdict:
        """The verdict on the structure."""

    @property
    @abstractmethod
    def why(self) -> str:
        """The reason for the verdict."""

    @property
    @abstractmethod
    def members(self) -> int:
        """Number of members of the ensemble that decides; 0 without one."""

    @property
    @abstractmethod
    def overturning_members(self) -> int:
        """Number of members that overturn."""

    @property
    @abstractmethod
    def overturning_share(self) -> float:
        """Share of the members that overturn; of a single run 0 or 1."""

    @property
    @abstractmethod
    def rotation_ratio(self) -> float:
        """Largest rotation over critical rotation as recorded; inf if it overturns."""

    @property
    @abstractmethod
    def rotation_ratio_low(self) -> float:
        """5 % quantile of the rotation ratio of the members."""

    @property
    @abstractmethod
    def rotation_ratio_high(self) -> float:
        """95 % quantile of the rotation ratio of the members."""

    @property
    @abstractmethod
    def crack(self) -> str:
        """The crack that governs; "" where only one may form."""

    @property
    @abstractmethod
    def statics_crack(self) -> str:
        """The crack that statics chooses, where another one governs; "" elsewhere."""

    @property
    @abstractmethod
    def statics_members(self) -> int | None:
        """Members with that crack; None where there is none."""

    @property
    @abstractmethod
    def statics_overturning_members(self) -> int | None:
        """Members that overturn with that crack; None where there is none."""

    @property
    @abstractmethod
    def stack_falls(self) -> int | None:
        """Stacks of courses that fall in contact dynamics; None where none was followed."""

    @property
    @abstractmethod
    def stack_runs(self) -> int | None:
        """Stacks of courses that contact dynamics followed; None where none was."""

    @property
    def severity(self) -> tuple[float, ...]:
        """Key by which the worst of several comes last: verdict, then share of members, then rotation."""
        share = -1.0 if math.isnan(self.overturning_share) else self.overturning_share
        rotation = -1.0 if math.isnan(self.rotation_ratio) else self.rotation_ratio
        return (-ORDER.index(self.verdict), share, rotation)

    @property
    def count(self) -> str:
        """Members that overturn, of how many: "12 of 64"; "" without an ensemble."""
        return f"{self.overturning_members} of {self.members}" if self.members else ""

    @property
    def one_crack_falls(self) -> bool:
        """Whether every member falls with the crack that governs, and that of statics leaves it undecided."""
        all_fall = self.members > 0 and self.overturning_members == self.members
        return self.verdict is Verdict.UNDECIDED and all_fall and bool(self.statics_members)

    @property
    def counts(self) -> str:
        """Members that overturn, of each crack where `count` alone would contradict the verdict.

        "64 of 64 with the hinge at 5.16 m, 28 of 256 with the hinge at 5.7 m".
        """
        if not self.one_crack_falls:
            return self.count
        of_statics = f"{self.statics_overturning_members} of {self.statics_members}"
        return f"{self.count} with the {self.crack}, {of_statics} with the {self.statics_crack}"

    @property
    def counts_in_brief(self) -> str:
        """`counts` where there is no room for the cracks: "64 of 64, by statics 28 of 256"."""
        if not self.one_crack_falls:
            return self.count
        return f"{self.count}, by statics {self.statics_overturning_members} of {self.statics_members}"


def worst_first(judgements: Iterable[tuple[str, Judgement]]) -> list[str]:
    """Return the names, of records or structures, by the shares of members that overturn, summed over all of a name."""
    shares: dict[str, float] = {}
    for name, judgement in judgements:
        share = judgement.overturning_share
        known = 0.0 if math.isnan(share) else share
        shares[name] = shares.get(name, 0.0) + known
    return sorted(shares, key=shares.__getitem__, reverse=True)


class Method(StrEnum):
    """The method by which a largest rotation was computed."""

    PRINTED = "printed"
    """Eq. 15 of the source paper with its block: linearised about the critical rotation, scale a_sc (Eq. 11)."""
    PRINTED_UPLIFT = "printed, a_sc,alt"
    """Eq. 15 with the paper's other block, whose scale a_sc,alt keeps the true uplift (Eq. 13)."""
    CLOSED_FORM = "closed form"
    BLOCK_ON_RECORD = "block on record"
    MECHANISM_ON_PULSE = "mechanism on pulse"
    MECHANISM_ON_RECORD = "mechanism on record"
    PEAK_VELOCITY = "peak velocity"
    """The probability of overturning that p PGV/(gλ) gives is beyond doubt; the rotation is its median."""
    NOTHING_TO_INTEGRATE = "nothing to integrate"
    """The ground never reaches the uplift acceleration, so the rotation is zero exactly."""


class Agreement(StrEnum):
    """The agreement of a prediction with the integration."""

    SAME = "same outcome"
    """Both rest, both rock or both overturn."""
    TOO_LOW = "too low"
    """The prediction says less than happens: the unsafe side."""
    TOO_HIGH = "too high"
    """The prediction says more than happens."""
    UNKNOWN = "unknown"
    """One of the two is missing."""


def verdict(probability: float, error: float, risk: float) -> Verdict:
    """Return the verdict of a probability of overturning that is sure to ± `error`.

    risk: largest probability of the opposite outcome. A probability that may lie on either side of a limit decides
    nothing.
    """
    if math.isnan(probability):
        return Verdict.UNKNOWN
    if probability + error <= risk:
        return Verdict.STANDS
    return Verdict.OVERTURNS if 1 - probability + error <= risk else Verdict.UNDECIDED


def rests(rotation_ratio: float) -> bool:
    """Whether a structure with this largest rotation ratio rests; False for nan."""
    return rotation_ratio <= NEGLIGIBLE


def rocks(rotation_ratio: float) -> bool:
    """Whether a structure with this largest rotation ratio rocks and stays up; False for nan."""
    return NEGLIGIBLE < rotation_ratio < math.inf


def agreement(predicted: float, integrated: float) -> Agreement:
    """Compare two rotation ratios (inf: overturns, nan: missing)."""
    if math.isnan(predicted) or math.isnan(integrated):
        return Agreement.UNKNOWN
    difference = _severity(predicted) - _severity(integrated)
    return Agreement.SAME if difference == 0 else Agreement.TOO_HIGH if difference > 0 else Agreement.TOO_LOW


def ratio(predicted: float, integrated: float) -> float:
    """Return predicted over integrated rotation ratio where both are lifted and stay up, else nan."""
    return predicted / integrated if 0 < predicted < math.inf and 0 < integrated < math.inf else math.nan


def ratio_in_words(predicted: float, integrated: float) -> str:
    """Say how a predicted rotation ratio stands to the integrated one: "20 × too low", "within 10 %".

    Two digits at the most; "" where one of them is missing.
    """
    if math.isnan(predicted) or math.isnan(integrated):
        return ""
    if words := _WORDS.get((_severity(predicted), _severity(integrated))):
        return words
    factor = max(predicted / integrated, integrated / predicted)
    if factor <= 1 + CLOSE:
        return f"within {CLOSE:.0%}".replace("%", " %")
    digits = f"{factor:.1f}" if factor < 10 else f"{float(f'{factor:.2g}'):.0f}"
    return f"{digits} × too {'high' if predicted > integrated else 'low'}"


_WORDS = {
    (0, 0): "both at rest",
    (0, 1): "misses the rocking",
    (0, 2): "misses the overturning",
    (1, 0): "rocks instead of resting",
    (1, 2): "misses the overturning",
    (2, 0): "overturns instead of resting",
    (2, 1): "overturns instead of rocking",
    (2, 2): "both overturn",
}
"""The agreement by predicted and integrated severity: rests, rocks, overturns."""


def within_factor_two(predicted: float, integrated: float) -> bool | None:
    """Whether two rotation ratios lie within a factor two of each other; None where they have no ratio."""
    quotient = ratio(predicted, integrated)
    return None if math.isnan(quotient) else 0.5 <= quotient <= 2


def _severity(rotation_ratio: float) -> int:
    return 0 if rests(rotation_ratio) else 1 if rocks(rotation_ratio) else 2
