"""The causes that decide where members disagree: the share of the variance of overturning that each one explains.

Overturning is 1 or 0 of each member. What explains a share of its variance decides so much of the outcome: who knew it
would know by so much more whether the structure falls. A share is that of an analysis of variance with one factor, less
what as many groups would explain by accident (ε², Kelley 1935). The rest lies in causes together: outcomes of a rocking
body flip between neighbouring values of several inputs, and no single one decides.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from rocking.assessment.causes import CAUSES, Origin
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack
from rocking.remarks import Kind, Remark

BINS = 4
"""Parts into which the range of a cause with all values in between is cut: 16 of 64 members each."""
DECIDES = 0.5
"""Share of the variance from which one thing is said to decide."""
CRACK = "which crack opens"
_WORDS = {
    "amplitude": "the amplitude of the motion",
    "restitution": "the restitution",
    "polarity": "the sign of the motion",
    "direction": "the direction of the motion",
    "processing": "the processing of the record",
    "vertical": "the vertical motion",
}


@dataclass(frozen=True)
class Deciding:
    """One thing that an outcome depends on. share: of the variance of overturning that it explains, 0 to 1."""

    name: str
    share: float
    origin: Origin

    @property
    def words(self) -> str:
        """Its name and share: "the restitution (62 %)"."""
        return f"{_WORDS.get(self.name, self.name)} ({100 * self.share:.0f} %)"


def deciding(ensembles: CrackEnsembles) -> list[Deciding]:
    """Return what the outcome depends on, the largest share first; [] where all members agree.

    The causes are those of the crack that governs; which crack opens is asked of those that count, of which one forms.
    """
    governing = ensembles.governing.ensemble
    falls = np.isinf(governing.rotation_ratios)
    known = ~np.isnan(governing.rotation_ratios)
    shares = [
        Deciding(cause.name, explained(falls[known], groups[known]), cause.origin)
        for cause in CAUSES
        if cause.name in governing.causes
        for groups in [_groups(governing.causes[cause.name])]
    ]
    cracked = [each for each in ensembles.followed if each.counts and not each.bulges]
    counting = [each for each in cracked if not each.of_geometry]
    if len(cracked) > len(counting):
        typed_or_not = _explained_by_crack([counting[0], cracked[-1]])
        shares.append(Deciding("restitution", typed_or_not, Origin.IGNORANCE))
    if len(counting) > 1:
        shares.append(Deciding(CRACK, _explained_by_crack(counting), Origin.IGNORANCE))
    some = [each for each in shares if each.share > 0]
    return sorted(some, key=lambda each: each.share, reverse=True)


def decided_by(ensembles: CrackEnsembles) -> str:
    """Return in words what decides: one thing, or that none does by itself; "" where all members agree."""
    largest = deciding(ensembles)
    if not largest:
        unanimous = ensembles.governing.ensemble.overturning_share in (0.0, 1.0)
        return "" if unanimous else "nothing decides by itself"
    first = largest[0]
    if first.share >= DECIDES:
        return f"decided by {first.words}"
    return f"nothing decides by itself, most {first.words}"


_TELLS = 0.2
"""Share of the variance of overturning from which on knowing one input better is worth a measurement."""
_KINDS = {"restitution": Kind.RESTITUTION, "processing": Kind.PROCESSING, CRACK: Kind.CRACK}


def would_tell(ensembles: CrackEnsembles, restitution_is_typed: bool = False) -> tuple[Remark, ...]:
    """Return what would tell most of a case: the first of what is not known, if it explains _TELLS at least.

    restitution_is_typed: whether whoever described the structure gave its range, and so knows it no better.
    """
    governing = ensembles.governing
    if governing.of_geometry and governing.ensemble.overturning_share > 0 and not restitution_is_typed:
        return (Remark(Kind.RESTITUTION),)
    worth = (
        Remark(_KINDS[each.name])
        for each in deciding(ensembles)
        if each.origin is Origin.IGNORANCE and each.share >= _TELLS and each.name in _KINDS
        if not (restitution_is_typed and each.name == "restitution")
    )
    return tuple(worth)[:1]


def explained(falls: np.ndarray, groups: np.ndarray) -> float:
    """Return the share of the variance of `falls` (m,) between `groups` (m,), ε², at least 0; 0 where all agree."""
    values = falls.astype(float)
    total = float(((values - values.mean()) ** 2).sum()) if values.size else 0.0
    names = np.unique(groups)
    if total == 0 or not 1 < names.size < values.size:
        return 0.0
    within = sum(float(((own - own.mean()) ** 2).sum()) for own in (values[groups == name] for name in names))
    by_accident = (names.size - 1) * within / (values.size - names.size)
    return max(0.0, (total - within - by_accident) / total)


def _groups(values: np.ndarray) -> np.ndarray:
    """The group of each member: its value, or where that is a number of an interval the part in which it lies."""
    if values.dtype.kind != "f" or np.unique(values).size <= BINS:
        return values
    edges = np.linspace(values.min(), values.max(), BINS + 1)[1:-1]
    return np.searchsorted(edges, values)


def _explained_by_crack(followed: Iterable[FollowedCrack]) -> float:
    falls = []
    groups = []
    for place, each in enumerate(followed):
        ratios = each.ensemble.rotation_ratios
        own = np.isinf(ratios[~np.isnan(ratios)])
        falls.append(own)
        groups.append(np.full(own.size, place))
    return explained(np.concatenate(falls), np.concatenate(groups))
