"""What falls: the share of the ways in which a structure may meet a motion that fells it, as the decision would say.

Members of mechanisms answer first. Where the decision would not trust them, contact dynamics follows some draws; where
that cannot tell either, the share has two ends: that of the mechanisms, and 1.
"""

import math
from bisect import bisect_left
from dataclasses import dataclass
from enum import StrEnum
from functools import cache, cached_property
from typing import NamedTuple

import numpy as np

from rocking.assessment.contacts import contact_share, signs, stackable
from rocking.assessment.cracks import counting_cracks, sliding_first, weakest_not_followed
from rocking.assessment.evidence.bodies import why_open
from rocking.assessment.evidence.walls import anchors_slide
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.structures.leaves import parts_of

DRAWS = 6
"""Runs of contact dynamics of one motion: of many records, whose spread is larger than that of draws."""
STONES_DRAWS = 3
"""Chains of stones of one motion and sign, whose runs cost a hundredfold."""
APART = 1.06
"""Ratio of the factors at which chains of stones are followed: outcomes flip within it."""
RUNGS = 64
"""Factors from first uplift on, up to 40 times it."""


class Model(StrEnum):
    """What the share of falls is of."""

    MECHANISM = "mechanism"
    CONTACTS = "contact dynamics"
    NONE = "cannot be told"


class Falls(NamedTuple):
    """The share that falls under a motion: between its ends, which are equal where it can be told. by: whose it is."""

    low: float
    high: float
    by: Model


def falls_along(
    structure: Structure,
    settings: AssessmentSettings,
    record: Accelerogram,
    factors: np.ndarray,
    rotation_ratios: np.ndarray,
    *,
    contacts: bool = True,
) -> list[Falls | None]:
    """Return what falls at factors (k,) on a record; None where one is nan.

    rotation_ratios: (k, m) of the members with the crack that governs. contacts: whether contact dynamics is asked
    where the decision would ask for it.
    """
    stones = _Stones(structure, record, settings) if contacts and structure.joints.as_stones else None
    return [
        None
        if math.isnan(factor)
        else _falls_at(structure, settings, record.scaled(factor), members, factor, stones, contacts)
        for factor, members in zip(factors.tolist(), rotation_ratios, strict=True)
    ]


def _falls_at(
    structure: Structure,
    settings: AssessmentSettings,
    scaled: Accelerogram,
    rotation_ratios: np.ndarray,
    factor: float,
    stones: "_Stones | None",
    contacts: bool,
) -> Falls:
    """What falls at one factor, at which the record is `scaled`. rotation_ratios: (m,) of the members."""
    motions = GroundMotions.of(scaled)
    share = float(np.isinf(rotation_ratios).mean())
    largest = float(rotation_ratios.max())
    counting = counting_cracks(structure)
    sliding = sliding_first(counting, motions)
    # Where nothing lifts it stands, unless it slides apart: rows 2 and 3 of the decision.
    if all(crack in sliding for crack in counting) and (structure.joints.fall_by_sliding or largest > 0):
        return Falls(0.0, 1.0, Model.NONE)
    told = Falls(share, share, Model.MECHANISM)
    if contacts and share < 1 and anchors_slide(structure, motions):
        plane = contact_share(structure.held_all_along, motions, settings, DRAWS, until_sure=False)
        if plane.runs and (more := max(share, plane.falls / plane.runs)):
            return Falls(more, more, Model.CONTACTS)
    if share == 1 or not largest > 0:
        return told
    of_contacts = math.nan
    if structure.joints.as_stones:
        if not (structure.joints.need_stones or share > 0):
            return told
        if stones is not None:
            of_contacts = stones.share_at(factor)
    elif not _is_in_doubt(structure, motions, largest, settings):
        return told
    elif contacts and stackable(structure):
        runs = contact_share(structure, motions, settings, DRAWS, until_sure=False)
        of_contacts = runs.falls / runs.runs if runs.runs else math.nan
    if math.isnan(of_contacts):
        return Falls(share, 1.0, Model.NONE)
    worse = max(share, of_contacts)
    return Falls(worse, worse, Model.CONTACTS)


@dataclass(eq=False)
class _Stones:
    """The chains of stones of one structure at any factor on one record.

    A run of them costs a hundredfold of a stack's. So the factor at which the first of them falls is halved for along
    RUNGS of a ladder that begins where the first mechanism lifts, the second, and so on; each falls from there on.
    """

    structure: Structure
    record: Accelerogram
    settings: AssessmentSettings

    def share_at(self, factor: float) -> float:
        """Return the share that falls at a factor; nan where they cannot be followed."""
        rungs = self._rungs
        return float(np.mean(factor >= self._lifts * APART ** (rungs - 0.5))) if rungs.size else math.nan

    @property
    def _lifts(self) -> float:
        """The factor at which the first mechanism lifts."""
        least = min(crack.uplift_multiplier for crack in counting_cracks(self.structure))
        return least / GroundMotions.of(self.record).excitation

    @cached_property
    def _rungs(self) -> np.ndarray:
        """The first rung at which one, two, ... of all draws fall; none where they cannot be followed."""
        draws = STONES_DRAWS * len(signs(self.structure, self.settings))

        @cache
        def shares(rung: int) -> float:
            motions = GroundMotions.of(self.record.scaled(self._lifts * APART**rung))
            runs = contact_share(self.structure, motions, self.settings, draws, until_sure=False)
            return runs.falls / runs.runs if runs.runs else math.nan

        if math.isnan(shares(RUNGS // 2)):
            return np.empty(0)
        every = np.arange(1, draws + 1) / draws
        return np.array([bisect_left(range(RUNGS), share - 1e-9, key=shares) for share in every])


def _is_in_doubt(
    structure: Structure, motions: GroundMotions, largest: float, settings: AssessmentSettings
) -> bool:
    """Whether the decision would not leave what lifts to its members: evidence that only contact dynamics settles.

    A mechanism that cannot be followed, courses that may be thrown, contacts that open. largest: rotation ratio of all.
    """
    reached = motions.excitation * (1 + settings.ensemble.amplitude_range)
    for _, part in parts_of(structure):
        unknown = weakest_not_followed(part)
        if unknown is not None and reached > unknown.uplift_multiplier:
            return True
        if part.joints.courses_taper or why_open(part, motions, largest, settings) is not None:
            return True
    return False
