"""Whether the model held along a response: no contact slid, none opened."""

import math
from dataclasses import dataclass

import numpy as np

from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.structures.bodies import UnknownContacts
from rocking.structures.structure import largest_so_far


@dataclass(frozen=True)
class ModelCheck:
    """The contacts of a structure along one response, up to its critical rotation.

    friction_needed: largest friction coefficient that any contact needs while it rocks; inf where one is not pressed,
    nan where `reason` says why nothing is known of it. bounces: whether a contact would open, or None.
    reason: why nothing is known, in words; "" where it is. ties: which ties yield or break on the way to the largest
    rotation to the positive side, in words; "" where none does.
    """

    friction_needed: float
    bounces: bool | None
    reason: str = ""
    ties: str = ""

    def slides(self, friction_coefficient: float) -> bool | None:
        """Whether a contact needs more friction than `friction_coefficient`; None where the forces are not known."""
        return None if math.isnan(self.friction_needed) else self.friction_needed > friction_coefficient


def unknown(reason: str) -> ModelCheck:
    """Return the check of which nothing is known, for a `reason`."""
    return ModelCheck(math.nan, None, reason)


UNKNOWN = unknown("contact forces are found along the mechanism on the record only")
_NO_HISTORY = unknown("the response keeps no history")
_NO_MOTION = unknown("nothing rocks below the critical rotation")


def check_model(
    structure: Structure, response: Response, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> ModelCheck:
    """Return what the contacts of `structure` need along `response`, which must hold its history."""
    times, rotation, velocity = response.times, response.rotation, response.angular_velocity
    if times is None or rotation is None or velocity is None:
        return _NO_HISTORY
    rocks = (rotation != 0) & (np.abs(rotation) <= structure.mechanism().critical_rotation)
    if not rocks.any():
        return _NO_MOTION
    ground = _at(accelerogram, times[rocks])
    lift = 0.0 if vertical is None else _at(vertical, times[rocks])
    try:
        so_far = largest_so_far(rotation)[rocks]
        contacts = structure.contact_history(rotation[rocks], velocity[rocks], ground, lift, so_far)
    except UnknownContacts as why:
        return unknown(str(why))
    largest = min(float(rotation.max()), structure.mechanism().positive.end_rotation)
    return ModelCheck(
        float(np.max(contacts.friction_needed)),
        bool(contacts.opens.any()),
        ties=structure.tie_events(largest),
    )


def _at(accelerogram: Accelerogram, times: np.ndarray) -> np.ndarray:
    """The ground acceleration is linear between samples and zero after the last."""
    return np.interp(times, accelerogram.times, accelerogram.acceleration, right=0.0)
