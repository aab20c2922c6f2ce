"""Response: what an integration says. ModelCheck: whether the model held along it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rocking.errors import MotionError
from rocking.quantities import counted, shown
from rocking.structures.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
import math

from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.structures.bodies import UnknownContacts
from rocking.structures.structure import largest_so_far


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """Largest rotation of a structure under a ground motion, and what is needed to trust it.

    rotation_ratio: largest φ/φ_cr over the sides; inf if it overturns, 0 without uplift, nan if it failed.
    outcome: an Outcome; reason: one sentence when it is FAILED, else "".
    impacts: how many times φ = 0 was reached. uplift_time: s of the first uplift (nan if none).
    peak_time: s from the first sample to the largest rotation (nan if overturned or never lifted).
    peak_side: +1 or −1, the side of the largest rotation or of the overturning; 0 without uplift.
    sensitivity: d ln φ_max / d ln a, the percent by which the largest rotation changes when the ground
    motion is scaled by one percent (nan unless it rocks, or if it was not asked for).
    fragile: whether ± `fragility_change` of the ground motion flips the verdict; None if not asked for.
    steps: integration steps taken. tolerance: the one asked for; 0.0 for the exact linear response.
    With history: times (k,) s, rotation (k,) rad signed, angular_velocity (k,) rad/s signed.
    """

    rotation_ratio: float
    outcome: Outcome
    impacts: int = 0
    peak_time: float = np.nan
    uplift_time: float = np.nan
    peak_side: int = 0
    sensitivity: float = np.nan
    fragile: bool | None = None
    steps: int = 0
    tolerance: float = 0.0
    reason: str = ""
    times: np.ndarray | None = None
    rotation: np.ndarray | None = None
    angular_velocity: np.ndarray | None = None

    def __repr__(self) -> str:
        if self.outcome is Outcome.FAILED:
            return f"Response(failed: {self.reason})"
        said = [self.outcome.of(self.rotation_ratio)]
        if self.outcome is Outcome.ROCKS:
            said.append(f"largest at {shown(self.peak_time, 's')}")
        if self.outcome is not Outcome.NO_UPLIFT:
            said.append(counted(self.impacts, "impact"))
        if self.times is not None:
            said.append(f"history of {counted(self.times.size, 'step')}")
        return f"Response({', '.join(said)})"

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the rotation against time, on `axes` or on new ones, and return the axes.

        Raises MotionError without a history.
        """
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)

    def frame(self) -> "DataFrame":
        """Return a pandas frame of the history: time_s, rotation_rad, angular_velocity_rad_s.

        Raises MotionError without a history.
        """
        from pandas import DataFrame

        if self.times is None:
            raise MotionError(
                "the history of the response is not there; integrate with history=True to keep it."
            )
        columns = {
            "time_s": self.times,
            "rotation_rad": self.rotation,
            "angular_velocity_rad_s": self.angular_velocity,
        }
        return DataFrame(columns)


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
