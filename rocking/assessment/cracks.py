"""Cracks: the mechanisms of a structure that may form, the ensemble of each that is followed, and which one governs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from rocking.assessment.ensemble import Ensemble, design, drawn, ensemble
from rocking.assessment.ground_motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.verdict import Verdict
from rocking.structures import Mechanism, Structure
from rocking.structures.structure import CRACKS

IN_DOUBT = 0.3
"""Rotation ratio of a member beyond which it is in doubt that a mechanism other than that of statics stands."""


@dataclass(frozen=True)
class Crack:
    """A mechanism that may form.

    description: what opens, in words; "" of a structure with one mechanism. position: its height [m]; nan without one.
    """

    description: str
    position: float
    mechanism: Mechanism


@dataclass(frozen=True, eq=False)
class FollowedCrack:
    """The ensemble of one crack; description and position [m] as those of `Crack`."""

    description: str
    position: float
    ensemble: Ensemble

    @property
    def severity(self) -> tuple[float, float]:
        """Key by which the worst of several comes last: the share that overturns, then the rotation."""
        values = (self.ensemble.overturning_share, self.ensemble.rotation_ratio_high)
        share, rotation = (-1.0 if math.isnan(value) else value for value in values)
        return share, rotation

    @property
    def count(self) -> str:
        """Members that overturn, of how many: "12 of 64"."""
        return f"{self.ensemble.overturning_members} of {self.ensemble.members}"


@dataclass(frozen=True, eq=False, repr=False)
class CrackEnsembles:
    """The ensemble of every crack that was followed, the one that is given or that statics chooses first.

    The crack that governs gives every number of the case. It is the worst: of the largest share of members that
    overturn, then of the largest rotation. Statics decides only where no other crack contradicts it. A crack that is
    `given` by whoever described the structure is meant: it governs, and what else may form is told beside it.
    """

    followed: tuple[FollowedCrack, ...]
    given: bool = False

    def __repr__(self) -> str:
        return f"<CrackEnsembles: {self.verdict}, {len(self.followed)} followed, {self.governing.ensemble!r}>"

    @property
    def statics(self) -> FollowedCrack:
        """The crack of least λ, which statics chooses, or the only one."""
        return self.followed[0]

    @cached_property
    def governing(self) -> FollowedCrack:
        """The crack that is given, else the worst; that of statics among equals."""
        return self.followed[0] if self.given else self.worst

    @cached_property
    def worst(self) -> FollowedCrack:
        """The worst crack of all that were followed; the first among equals."""
        return max(self.followed, key=lambda each: each.severity)

    @property
    def beside(self) -> FollowedCrack | None:
        """The crack told beside the one that governs: that of statics, or the worst beside a given one; or None."""
        other = self.worst if self.given else self.statics
        return None if other is self.governing else other

    @property
    def verdict(self) -> Verdict:
        """That of the crack given or of statics, but undecided where statics stands and another crack does not."""
        of_statics = self.statics.ensemble.verdict
        if of_statics is not Verdict.STANDS or self.given:
            return of_statics
        others_stand = all(each.ensemble.verdict is Verdict.STANDS for each in self.followed)
        return Verdict.STANDS if others_stand else Verdict.UNDECIDED

    @property
    def disagree(self) -> bool:
        """Whether statics stands and the crack that governs does not."""
        governing = self.governing.ensemble.verdict
        return self.statics.ensemble.verdict is Verdict.STANDS and governing is not Verdict.STANDS

    @property
    def why(self) -> str:
        """The reason for the verdict: how many members overturn, and with which crack."""
        governing = self.governing
        crack = f" with the {governing.description}" if governing.description else ""
        words = f"{governing.count} members overturn{crack}"
        if self.given and self.beside is not None:
            return (
                f"{words} as given; should the {self.beside.description} form instead, {self.beside.count} do"
            )
        if governing is not self.statics:
            words += f", {self.statics.count} with the {self.statics.description} of statics"
        return f"the cracks disagree: {words}" if self.disagree else words


@lru_cache(maxsize=256)
def cracks(structure: Structure | Mechanism) -> tuple[Crack, ...]:
    """Return the mechanisms that may form; first the one that is given, or that statics chooses."""
    if isinstance(structure, Mechanism):
        return (Crack("", math.nan, structure),)
    return tuple(
        Crack(each.description, each.position, each.structure.mechanism())
        for each in structure.candidates(CRACKS)
    )


def ensemble_over_cracks(
    structure: Structure | Mechanism,
    motions: GroundMotions,
    settings: AssessmentSettings,
    *,
    verdict_only: bool = False,
    exhaustive: bool = False,
) -> CrackEnsembles:
    """Return the ensembles of the cracks that may govern.

    Where the crack that statics chooses overturns, it says all. Otherwise every crack that `screened` leaves in doubt
    is followed in full. exhaustive: every crack is followed, whatever the screen says; docs/pages/validation.md counts
    what it misses. verdict_only: as `ensemble` takes it. Raises MotionError as `integrate` does.
    """
    first, *others = cracks(structure)
    given = isinstance(structure, Structure) and structure.crack_is_given
    of_statics = ensemble(
        first.mechanism, motions, settings.ensemble, tolerance=settings.tolerance, verdict_only=verdict_only
    )
    statics = FollowedCrack(first.description if others else "", first.position, of_statics)
    if not others or isinstance(structure, Mechanism) or of_statics.verdict is Verdict.OVERTURNS:
        return CrackEnsembles((statics,), given)
    doubtful = (
        others
        if exhaustive
        else screened(others, of_statics, motions, settings, first.mechanism.uplift_multiplier)
    )
    in_full = [
        FollowedCrack(each.description, each.position, _alone(each, motions, settings)) for each in doubtful
    ]
    return CrackEnsembles((statics, *in_full), given)


def screened(
    others: Sequence[Crack],
    of_statics: Ensemble,
    motions: GroundMotions,
    settings: AssessmentSettings,
    lifted_at: float = 0.0,
) -> list[Crack]:
    """Return those of the `others` that may not stand, the worst first.

    Each meets three members of the ensemble of statics, or of the crack given: the two that rotate most, and the middle
    one. One that turns beyond IN_DOUBT of its critical rotation there, or cannot be followed, is left in doubt. Where
    all members rest, only what lifts below `lifted_at`, the λ of the first crack, may rock.
    """
    if np.all(of_statics.rotation_ratios == 0):
        others = [each for each in others if each.mechanism.uplift_multiplier < lifted_at]
    order = np.argsort(-of_statics.rotation_ratios, kind="stable")
    few = design(settings.ensemble)[order[[0, 1, order.size // 2]]]
    severity = {}
    for each in others:
        members = drawn(each.mechanism, motions, few, settings.ensemble, tolerance=settings.tolerance)
        ratios = np.nan_to_num(members.rotation_ratios, nan=np.inf, posinf=np.inf)
        if ratios.max() > IN_DOUBT:
            severity[each] = int(np.isinf(ratios).sum()), float(ratios.min())
    return sorted(severity, key=severity.__getitem__, reverse=True)


def _alone(crack: Crack, motions: GroundMotions, settings: AssessmentSettings) -> Ensemble:
    """The ensemble of one crack beside that of statics, which decides where more members may."""
    return ensemble(
        crack.mechanism,
        motions,
        settings.ensemble,
        tolerance=settings.tolerance,
        verdict_only=True,
        grows=False,
    )
