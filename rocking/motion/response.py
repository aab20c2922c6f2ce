"""Response: what an integration says. ModelCheck: whether the model held along it."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rocking.drawn import Drawn
from rocking.errors import MotionError
from rocking.quantities import GRAVITY, counted, four_digits
from rocking.records import Accelerogram
from rocking.structures import Outcome, Structure
from rocking.structures.linkage import MotionState, UnknownContacts, largest_so_far
from rocking.structures.tied import held
from rocking.warnings import RockingWarning

if TYPE_CHECKING:
    from pandas import DataFrame


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Response(Drawn):
    """Largest rotation of a structure under a ground motion, and what is needed to trust it.

    Parameters
    ----------
    rotation_ratio : float
        Largest φ/φ_cr over the sides; inf if it overturns, 0 without uplift, nan if it failed.
    outcome : Outcome
        What becomes of the structure.
    impacts : int, default 0
        How many times φ = 0 was reached.
    peak_time : float, default nan
        Time from the first sample to the largest rotation, s; nan if it overturned or never lifted.
    fall_time : float, default nan
        Time at which it first passes its critical rotation where it overturns, s; nan else, and without a
        history.
    uplift_time : float, default nan
        Time of the first uplift, s; nan without one.
    peak_side : int, default 0
        +1 or −1, the side of the largest rotation or of the overturning; 0 without uplift.
    sensitivity : float, default nan
        d ln φ_max / d ln a, the percent by which the largest rotation changes when the ground motion is
        scaled by one percent; nan unless it rocks, or if it was not asked for. Of a chaotic response, which
        `fragile` is true, it is the slope between two neighbours and no measure of what may come.
    fragile : bool or None, optional
        Whether ± `fragile_change` of the ground motion flips the verdict, or the run is not reproducible:
        one of two others, at a tolerance of 1e-9 and with the motion scaled by 1 ± 1e-9, differs by more than
        1e-5. The run is then repeated at 1e-9, and its number is one of many. None if not asked for.
    steps : int, default 0
        Integration steps taken.
    tolerance : float, default 0.0
        The tolerance asked for, or 1e-9 where a fragile run was repeated; a fragile response of many impacts
        may miss it; 0.0 of an exact response.
    reason : str, default ''
        One sentence where the outcome is FAILED, else empty.
    warning : RockingWarning or None, optional
        Where the vertical motion takes away all of gravity, else None.
    times : ndarray or None, optional
        (k,) times of the history, s; None without one.
    rotation : ndarray or None, optional
        (k,) rotation of the history, rad, signed; `plot` draws it, with `relative=True` over the critical one,
        and raises MotionError without a history.
    angular_velocity : ndarray or None, optional
        (k,) angular velocity of the history, rad/s, signed.
    critical_rotations : tuple of (float, float), default (nan, nan)
        Critical rotation of the positive and of the negative side, rad; nan of a response that was not
        integrated.

    Examples
    --------
    >>> from rocking import Block, Pulse, integrate
    >>> integrate(Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0))
    Response(rocks to 0.3188 φ_cr, largest at 1.018 s, 1 impact)
    """

    rotation_ratio: float
    outcome: Outcome
    impacts: int = 0
    peak_time: float = np.nan
    fall_time: float = np.nan
    uplift_time: float = np.nan
    peak_side: int = 0
    sensitivity: float = np.nan
    fragile: bool | None = None
    steps: int = 0
    tolerance: float = 0.0
    reason: str = ""
    warning: RockingWarning | None = None
    times: np.ndarray | None = None
    rotation: np.ndarray | None = None
    angular_velocity: np.ndarray | None = None
    critical_rotations: tuple[float, float] = (math.nan, math.nan)

    def __repr__(self) -> str:
        if self.outcome is Outcome.FAILED:
            return f"Response(failed: {self.reason})"
        words = [self.outcome.of(self.rotation_ratio)]
        if self.outcome is Outcome.ROCKS:
            words.append(f"largest at {four_digits(self.peak_time, 's')}")
        if self.outcome is not Outcome.NO_UPLIFT:
            words.append(counted(self.impacts, "impact"))
        if self.times is not None:
            words.append(f"history of {counted(self.times.size, 'step')}")
        return f"Response({', '.join(words)})"

    @property
    def relative_rotation(self) -> np.ndarray | None:
        """(k,) rotation of the history over the critical rotation of its side, signed; None without a history."""
        if self.rotation is None:
            return None
        positive, negative = self.critical_rotations
        return self.rotation / np.where(self.rotation < 0, negative, positive)

    def frame(self) -> "DataFrame":
        """Return a pandas frame of the history: time_s, rotation_rad, angular_velocity_rad_s.

        Raises MotionError without a history.
        """
        from pandas import DataFrame  # which takes half a second to import

        if self.times is None:
            raise MotionError(
                "the history of the response is not there; integrate with history=True to keep it.",
                history=False,
            )
        columns = {"time_s": self.times, "rotation_rad": self.rotation}
        return DataFrame(columns | {"angular_velocity_rad_s": self.angular_velocity})


@dataclass(frozen=True)
class ModelCheck:
    """The contacts of a structure along one response, up to its critical rotation.

    required_friction: largest friction coefficient that any contact needs while it rocks; inf where one is not pressed,
    nan where `reason` says why nothing is known of it. bounces: whether a contact would open, or None. reason: why
    nothing is known, in words; "" where it is. ties: which ties yield or break on the way to the largest rotation to
    the positive side, in words; "" where none does. lifting_friction: what a contact needs as the structure lifts.
    holding: the largest force of each of the structure's `reactions()`, N per metre; () where nothing holds it.
    """

    required_friction: float = math.nan
    bounces: bool | None = None
    reason: str = ""
    ties: str = ""
    lifting_friction: float = math.nan
    holding: tuple[float, ...] = ()

    def slides(self, friction_coefficient: float) -> bool | None:
        """Whether a contact needs more friction than `friction_coefficient`; None where the forces are not known."""
        return None if math.isnan(self.required_friction) else self.required_friction > friction_coefficient


UNKNOWN = ModelCheck(reason="contact forces are found along the mechanism on the record only")


def check_model(
    structure: Structure, response: Response, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> ModelCheck:
    """Return what the contacts of `structure` need along `response`, which must hold its history.

    Instants of uplift and landing, φ = 0, count too: on the side to which it goes on.

    >>> from rocking import Block, integrate, read
    >>> from rocking.motion.response import check_model
    >>> record = read("records/synthetic_strong_pulse.AT2")[0]
    >>> block = Block(semi_diagonal=2.0, slenderness=0.2)
    >>> check_model(block, integrate(block, record, history=True), record).bounces
    False
    """
    times = response.times
    rotation = response.rotation
    velocity = response.angular_velocity
    if times is None or rotation is None or velocity is None:
        return ModelCheck(reason="the response keeps no history")
    critical = structure.mechanism().critical_rotation
    # Where it is 0 before it rocks on: a hair to the side to which it does.
    places = np.where(rotation == 0, rotation.size - 1, np.arange(rotation.size))
    following = rotation[np.minimum.accumulate(places[::-1])[::-1]]
    turned = np.where(rotation == 0, 1e-12 * critical * np.sign(following), rotation)
    rocks = (turned != 0) & (np.abs(turned) <= critical)
    if not rocks.any():
        return ModelCheck(reason="nothing rocks below the critical rotation")
    # Linear between samples, and zero after the last.
    ground, lift = (
        0.0 if motion is None else np.interp(times[rocks], motion.times, motion.acceleration, right=0.0)
        for motion in (accelerogram, vertical)
    )
    wall = held(structure)
    try:
        so_far = largest_so_far(turned)[rocks]
        state = MotionState.of(
            structure.mechanism(), turned[rocks], velocity[rocks], None, ground, lift, so_far
        )
        contacts = structure.contact_forces(state)
        reactions = wall.reactions(state) if wall else ()
    except UnknownContacts as why:
        return ModelCheck(reason=str(why))
    largest = min(float(rotation.max()), structure.mechanism().positive.end_rotation)
    return ModelCheck(
        float(np.max(contacts.required_friction)),
        bool(contacts.opens.any()),
        ties=wall.tie_events(largest) if wall else "",
        lifting_friction=lifting_friction(structure),
        holding=tuple(float(reaction.force.max()) for reaction in reactions),
    )


def lifting_friction(structure: Structure) -> float:
    """Return the largest friction that a joint needs as it lifts, to the side to which it does so first.

    λ, the mean over all joints on the ground, where the mechanism alone does not determine the forces of each; 0 where
    no joint is known.

    >>> from rocking import Block
    >>> from rocking.motion.response import lifting_friction
    >>> round(lifting_friction(Block.of_size(breadth=1.0, height=4.0)), 12)
    0.25
    """
    if not structure.linkages:
        return 0.0
    sides = structure.mechanism().sides
    side = min(sides, key=lambda side: side.uplift_multiplier)
    sign = 1.0 if side is sides[0] else -1.0
    ground = np.array([-sign * side.uplift_multiplier * GRAVITY])
    least = np.array([1e-12 * side.end_rotation])
    try:
        state = MotionState.of(structure.mechanism(), sign * least, 0.0, ground=ground, largest=least)
        contacts = structure.contact_forces(state)
    except UnknownContacts:
        return side.uplift_multiplier
    return float(np.nanmax(contacts.required_friction))
