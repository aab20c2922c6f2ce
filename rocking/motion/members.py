"""Many responses of one structure to one ground motion in one compiled call: the members of an ensemble."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rocking.errors import MotionError
from rocking.motion import runs
from rocking.motion.forcing import Forcing, GroundMotion, forcing_of
from rocking.motion.integration import TOLERANCES, Rocking, Runs, failure, follow, reduce, solvable_exactly
from rocking.motion.table import SideTable
from rocking.quantities import kind_of, within
from rocking.records.accelerogram import Accelerogram
from rocking.structures.mechanism import EquivalentBlock, Mechanism

Values = float | Sequence[float] | np.ndarray


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Members:
    """The inputs that vary between the members of an ensemble; each argument one value for all, or one per member (m,).

    scale_factor: of the ground motion, vertical component included, > 0. polarity: +1, or −1 for the horizontal motion
    reversed. vertical: whether the vertical component acts. restitution: η, (m,) or one per side (m, 2), positive side
    first; None takes the structure's own. Kept as arrays (m,) and (m, 2).
    Raises MotionError for a value out of range, or for arguments that do not fit each other.

    >>> from rocking import Members
    >>> Members(scale_factor=[0.9, 1.0, 1.1], restitution=0.85).count
    3
    """

    scale_factor: np.ndarray
    polarity: np.ndarray
    vertical: np.ndarray
    restitution: np.ndarray | None

    def __init__(
        self,
        scale_factor: Values = 1.0,
        polarity: Values = 1.0,
        vertical: Values = True,
        restitution: Values | Sequence[Sequence[float]] | None = None,
    ) -> None:
        columns = {
            "scale_factor": (scale_factor, float),
            "polarity": (polarity, float),
            "vertical": (vertical, bool),
        }
        arrays = {name: np.atleast_1d(np.asarray(*column)) for name, column in columns.items()}
        if restitution is not None:
            eta = np.atleast_1d(np.asarray(restitution, dtype=float))
            arrays["restitution"] = eta if eta.ndim == 2 else np.stack([eta, eta], axis=-1)
        size = max(array.shape[0] for array in arrays.values())
        for name, array in arrays.items():
            shape = (size, 2) if name == "restitution" else (size,)
            if array.ndim != len(shape) or array.shape[0] not in (1, size) or array.shape[1:] != shape[1:]:
                raise MotionError(f"{name} has the shape {array.shape}, but must hold one value or {size}.")
            object.__setattr__(self, name, np.array(np.broadcast_to(array, shape)))
        if restitution is None:
            object.__setattr__(self, "restitution", None)
        for name, allowed, holds in (
            ("scale_factor", "be greater than 0", lambda values: values > 0),
            ("polarity", "be 1 or -1", lambda values: np.abs(values) == 1),
            ("restitution", "lie between 0 and 1", lambda values: (values >= 0) & (values <= 1)),
        ):
            values = arrays.get(name, np.ones(1))
            wrong = values[~(holds(values) & np.isfinite(values))]  # type: ignore[no-untyped-call]
            if wrong.size:
                raise MotionError(f"{name} holds {wrong[0]!s}, but every value must {allowed}.")

    def __repr__(self) -> str:
        low = self.scale_factor.min()
        high = self.scale_factor.max()
        return f"<Members: {self.count}, scaled by {low:.4g} to {high:.4g}>"

    @property
    def count(self) -> int:
        """The number of members."""
        return self.scale_factor.size


class MemberResponses(NamedTuple):
    """The members' responses, (m,) each.

    rotation_ratio: largest φ/φ_cr over the sides; inf overturns, 0 without uplift, nan failed. peak_side: +1 or −1, the
    side of the largest rotation; 0 without uplift, and unknown where it overturns. reasons: by member that failed.

    >>> from rocking import Block, Members, Pulse, integrate_members
    >>> block, pulse = Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0)
    >>> integrate_members(block, pulse, Members(scale_factor=[0.5, 1.0])).lifted.tolist()
    [False, True]
    """

    rotation_ratio: np.ndarray
    peak_side: np.ndarray
    reasons: dict[int, str]

    @property
    def lifted(self) -> np.ndarray:
        """Whether the structure rocks at all."""
        result: np.ndarray = self.rotation_ratio != 0
        return result

    @property
    def overturns(self) -> np.ndarray:
        """Whether it overturns."""
        return np.isposinf(self.rotation_ratio)


def integrate_members(
    structure: Rocking,
    motion: GroundMotion,
    members: Members,
    tolerance: float = 1e-6,
    *,
    vertical: Accelerogram | None = None,
) -> MemberResponses:
    """Follow `structure` through `motion` once for every member, in one compiled call that lets other threads run.

    Each result is that of `integrate` with the scaled motion, within `tolerance`; an EquivalentBlock without vertical
    motion is solved exactly. Raises MotionError as `integrate` does for a setting that is wrong for every member; a
    member that cannot be followed is nan, with its reason.

    >>> from rocking import Block, Members, Pulse, integrate_members
    >>> block, pulse = Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0)
    >>> integrate_members(block, pulse, Members(scale_factor=[0.5, 1.0, 9.0])).overturns.tolist()
    [False, False, True]
    """
    if not isinstance(members, Members):
        raise MotionError(f"members is {kind_of(members)}, but must be Members, as Members([0.9, 1.0, 1.1]).")
    tolerance = within(MotionError, "tolerance", tolerance, *TOLERANCES)
    forcing = forcing_of(motion, vertical)
    lift = np.where(members.vertical, members.scale_factor, 0.0) if forcing.vertical else None
    several = Runs(members.scale_factor * members.polarity, lift, members.restitution)
    return follow_runs(reduce(structure), forcing, several, tolerance)


def follow_runs(
    reduced: Mechanism | EquivalentBlock, forcing: Forcing, several: Runs, tolerance: float
) -> MemberResponses:
    """`integrate_members` of what is prepared already."""
    lift = several.lift
    if isinstance(reduced, Mechanism) and not lift.any():
        # Without a run that lifts it needs no table, which takes longer than the runs; what is close is left to them.
        largest = np.abs(several.horizontal).max(initial=0.0) * forcing.excitation
        if largest < (1 - 1e-9) * reduced.uplift_multiplier:
            return MemberResponses(np.zeros(lift.size), np.zeros(lift.size, int), {})
    if solvable_exactly(reduced, forcing) and 0 < np.count_nonzero(lift) < lift.size:
        # Members with and without vertical motion each go their own way.
        ratio = np.empty(lift.size)
        side = np.empty(lift.size, int)
        reasons: dict[int, str] = {}
        for places in (np.flatnonzero(lift == 0), np.flatnonzero(lift)):
            some = follow_runs(reduced, forcing, several.at(places), tolerance)
            ratio[places] = some.rotation_ratio
            side[places] = some.peak_side
            reasons |= {int(places[k]): reason for k, reason in some.reasons.items()}
        return MemberResponses(ratio, side, reasons)
    return concluded(*follow(reduced, forcing, several, tolerance))


def concluded(sides: Sequence[SideTable | EquivalentBlock], results: np.ndarray) -> MemberResponses:
    """Return what the results (m, 9) of a kernel say; sides: one where they are mirrored."""
    status = results[:, runs.STATUS]
    reasons = {}
    arcs = np.where(status == runs.ROCKS, results[:, runs.PEAKS : runs.PEAKS + 2].T, 0.0)
    if len(sides) == 1:
        one, other = sides[0].rotation_ratios(arcs)
    else:
        one, other = (each.rotation_ratios(own) for each, own in zip(sides, arcs, strict=True))
    ratio = np.maximum(one, other)
    side = np.where(one >= other, 1, -1)
    side[status == 0] = 0
    if status.max(initial=runs.ROCKS) > runs.ROCKS:
        ratio[status == runs.OVERTURNS] = np.inf  # as it is where it passed the end of the mechanism
        failed = np.flatnonzero(status > runs.OVERTURNS)
        ratio[failed] = np.nan
        side[failed] = 0
        reasons = {int(k): str(failure(*results[k, [runs.STATUS, runs.IMPACTS]])) for k in failed}
    return MemberResponses(ratio, side, reasons)
