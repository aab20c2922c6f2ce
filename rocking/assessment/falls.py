"""What falls: the share of the ways in which a structure may meet a motion that fells it, as the decision would say.

Members of mechanisms answer first. Where the decision would not trust them, contact dynamics follows some draws; where
that cannot tell either, the share has two ends: that of the mechanisms, and 1.
"""

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import NamedTuple

import numpy as np

from rocking.assessment.contacts import (
    AMPLITUDES,
    Draw,
    contact_share,
    draws_of_parts,
    signs,
    stackable,
)
from rocking.assessment.cores import in_order
from rocking.assessment.cracks import cracks, loses_seat_at
from rocking.assessment.evidence import cannot_be_told
from rocking.assessment.evidence.asked import Asked
from rocking.assessment.evidence.walls import anchors_slide, held_all_along
from rocking.assessment.motions import GroundMotions
from rocking.assessment.reserve import SHARES, Reserve, reserve_of_members
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.structures.structure import Candidate

DRAWS = 6
"""Runs of contact dynamics at one factor on one motion of many records, whose spread is larger than that of draws."""
RESERVE_DRAWS = 8
"""Runs at one factor on all motions of the record of a reserve, of which one is more than 5 %."""
RESERVE_APART = 1.1
"""Ratio of these factors, as near to each other as those of members scatter from sample to sample."""
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
    motions = GroundMotions.of(record)
    found: list[Falls | None] = []
    for factor, members in zip(factors.tolist(), rotation_ratios, strict=True):
        if math.isnan(factor):
            found.append(None)
            continue
        asked = Asked.of_run(structure, motions.scaled(factor), settings, float(members.max()))
        found.append(_falls_at(asked, members, factor, stones, contacts))
    return found


def _falls_at(
    asked: Asked, rotation_ratios: np.ndarray, factor: float, stones: "_Stones | None", contacts: bool
) -> Falls:
    """What falls at one factor, under whose motions it is asked. rotation_ratios: (m,) of the members."""
    structure, motions, settings = asked.structure, asked.motions, asked.settings
    share = float(np.isinf(rotation_ratios).mean())
    rests = not rotation_ratios.max() > 0
    # Where nothing lifts it stands, unless it slides apart: rows 2 and 3 of the decision.
    if asked.slides_throughout and not (rests and not structure.joints.fall_by_sliding):
        return Falls(0.0, 1.0, Model.NONE)
    by_members = Falls(share, share, Model.MECHANISM)
    if contacts and share < 1 and anchors_slide(structure, motions):
        plane = contact_share(held_all_along(structure), motions, settings, DRAWS, until_sure=False)
        if plane.runs and (more := max(share, plane.falls / plane.runs)):
            return Falls(more, more, Model.CONTACTS)
    if share == 1 or rests or not _asks_contacts(asked, share):
        return by_members
    of_contacts = math.nan
    if structure.joints.as_stones:
        if stones is not None:
            of_contacts = stones.share_at(factor)
    elif contacts and stackable(structure):
        runs = contact_share(structure, motions, settings, DRAWS, until_sure=False)
        of_contacts = runs.falls / runs.runs if runs.runs else math.nan
    if math.isnan(of_contacts):
        return Falls(share, 1.0, Model.NONE)
    worse = max(share, of_contacts)
    return Falls(worse, worse, Model.CONTACTS)


def _asks_contacts(asked: Asked, share: float) -> bool:
    """Whether the decision would ask stones or stacks of what lifts, of whose members a share falls."""
    if asked.structure.joints.as_stones:
        return asked.structure.joints.need_stones or share > 0
    return cannot_be_told(asked)


@dataclass(eq=False)
class _Stones:
    """The chains of stones of one structure at any factor on one record.

    A run of them costs a hundredfold of a stack's. So the factor at which each of them first falls is halved for along
    RUNGS of a ladder that begins where the first mechanism lifts; it falls from there on.
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
        return GroundMotions.of(self.record).lift_at(cracks(self.structure).counting.least_multiplier)

    @cached_property
    def _rungs(self) -> np.ndarray:
        """The rung at which each draw first falls; none where they cannot be followed."""
        number = STONES_DRAWS * len(signs(self.structure, self.settings))

        def first_rung(draw: Draw) -> int:
            return bisect_left(range(RUNGS), True, key=lambda rung: draw.falls(self._lifts * APART**rung))

        try:
            (draws,) = draws_of_parts(self.structure, GroundMotions.of(self.record), self.settings, number)
            return np.array([first_rung(draw) for draw in draws])
        except RockingError:
            return np.empty(0)


@dataclass
class _Rising:
    """A question whose answer turns from no to yes as a factor grows, and is asked again between the two alone."""

    ask: Callable[[float], bool]
    cost: float = 0.0
    no: float = 0.0
    yes: float = math.inf

    def __call__(self, factor: float) -> bool:
        if self.no < factor < self.yes:
            if self.ask(factor):
                self.yes = factor
            else:
                self.no = factor
        return factor >= self.yes


def _as_many(draws: Sequence[_Rising], factor: float, number: int) -> bool:
    """Whether so many of the draws, the strongest first, fall at a factor: those that may end it are asked first."""
    likeliest = draws if 2 * number <= len(draws) else draws[::-1]
    unknown_last = sorted(likeliest, key=lambda draw: (draw.no < factor < draw.yes, draw.cost))
    falls = 0
    with closing(in_order(lambda draw: draw(factor), unknown_last)) as in_turn:
        for followed, it_falls in enumerate(in_turn, start=1):
            falls += it_falls
            if falls >= number or falls + len(draws) - followed < number:
                break
    return falls >= number


def reserve(
    structure: Structure,
    crack: Candidate,
    motions: GroundMotions,
    settings: AssessmentSettings,
    *,
    support_loss: float = math.inf,
    share: float = math.nan,
) -> Reserve:
    """Return the factors on the motions at which 5, 50 and 95 % fall: of the members with the crack that governs, or of
    the runs of contact dynamics where the decision would ask for them and more of these fall.

    The larger share of both is reached at the lesser factor, so that contact dynamics is first asked at that of the
    members, and most often no further. support_loss: horizontal displacement at which what bears on the structure
    falls, m. share: that falls under the motions themselves, which no factor contradicts; nan where it is not known.
    Raises MotionError as `integrate` does, and where contact dynamics is asked and cannot follow it.
    """
    falls_beyond = loses_seat_at(crack.structure, support_loss)
    of_members = reserve_of_members(crack.mechanism, motions, settings.ensemble, falls_beyond=falls_beyond)
    least = math.inf
    if stackable(structure):
        least = motions.lift_at(cracks(structure).counting.least_multiplier) / AMPLITUDES[1]
    if math.isinf(least):
        return of_members.held_to(share)

    @_Rising
    def is_asked(factor: float) -> bool:
        return _asks_contacts(Asked.of_run(structure, motions.scaled(factor), settings, math.inf), 0.0)

    parts = [
        [
            _Rising(draw.falls, 1 / draw.step)
            for draw in sorted(draws, key=lambda draw: draw.strength, reverse=True)
        ]
        for draws in draws_of_parts(structure, motions, settings, RESERVE_DRAWS)
    ]

    def reaches(factor: float, number: int) -> bool:
        return is_asked(factor) and any(_as_many(draws, factor, number) for draws in parts)

    factors = []
    for reached, factor in zip(SHARES, (of_members.low, of_members.median, of_members.high), strict=True):
        last = of_members.limit if math.isnan(factor) else factor
        if share >= reached:
            last = min(last, 1.0)
        elif share < reached:
            least = max(least, 1.0)
        rungs = math.ceil(math.log(last / least) / math.log(RESERVE_APART))
        number = math.ceil(reached * RESERVE_DRAWS)
        if rungs > 0 and reaches(last, number):
            tried = [last * RESERVE_APART ** (rung - rungs) for rung in range(rungs + 1)]
            # Where the one falls after which as many have fallen, and from there to where as many do.
            place = min(rungs, *(bisect_left(tried, True, key=draws[number - 1]) for draws in parts))
            while not reaches(tried[place], number):
                place += 1
            while place and reaches(tried[place - 1], number):
                place -= 1
            factor = least = last * RESERVE_APART ** (place - rungs - 0.5)
        factors.append(factor)
    low, median, high = factors
    return Reserve(low=low, median=median, high=high, limit=of_members.limit).held_to(share)
