"""What falls: the share of the ways in which a structure may meet a motion that fells it, as the decision would say.

Members of mechanisms answer first. Where the decision would not trust them, contact dynamics follows some draws; where
that cannot tell either, the share has two ends: that of the mechanisms, and 1.
"""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from rocking.assessment.contacts import contact_share, stackable
from rocking.assessment.cracks import counting_cracks, sliding_first, weakest_not_followed
from rocking.assessment.decide import FAR
from rocking.assessment.evidence.bodies import why_open
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.structures import Structure
from rocking.structures.leaves import parts_of

DRAWS = 6
"""Runs of contact dynamics of one motion: of many records, whose spread is larger than that of draws."""


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


def falls_under(
    structure: Structure,
    motions: GroundMotions,
    rotation_ratios: np.ndarray,
    settings: AssessmentSettings,
    *,
    contacts: bool = True,
) -> Falls:
    """Return what falls under some motions.

    rotation_ratios: (m,) of the members, each with the crack that turns it farthest. contacts: whether contact dynamics
    is asked where the decision would ask for it; a chain of stones is not followed, as its runs cost a hundredfold.
    """
    share = float(np.isinf(rotation_ratios).mean())
    largest = float(rotation_ratios.max())
    counting = counting_cracks(structure)
    sliding = sliding_first(counting, motions)
    # Where nothing lifts it stands, unless it slides apart: rows 2 and 3 of the decision.
    if all(crack in sliding for crack in counting) and (structure.falls_by_sliding or largest > 0):
        return Falls(0.0, 1.0, Model.NONE)
    told = Falls(share, share, Model.MECHANISM)
    if share == 1 or not largest > 0:
        return told
    if structure.as_stones:
        asks = structure.needs_stones or largest > FAR
        return Falls(share, 1.0, Model.NONE) if asks else told
    if not _is_in_doubt(structure, motions, largest, settings):
        return told
    if contacts and stackable(structure):
        runs = contact_share(structure, motions, settings, DRAWS, until_sure=False)
        if runs.runs:
            worse = max(share, runs.falls / runs.runs)
            return Falls(worse, worse, Model.CONTACTS)
    return Falls(share, 1.0, Model.NONE)


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
        if part.tapers or why_open(part, motions, largest, settings) is not None:
            return True
    return False
