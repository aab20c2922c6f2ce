"""Restitution of the impact at φ = 0: a number, or the momentum balance by name.

Every momentum balance here is one equation. Just before the impact the bodies move with the velocity field u
of one mechanism, just after with η times the field v of the other; the impulses act where the new mechanism
turns and do no work on it, so ⟨η v − u, v⟩ = 0 in the mass inner product and η = ⟨u, v⟩ / ⟨v, v⟩. For a
block this is Housner's 1 − 1.5 sin²α, for the mid-height wall (1 − 4.5 sin²α)/(1 + 3 sin²α), for the frame
Makris and Vassiliou's value.
"""

import warnings
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureWarning

Restitution = float | str | None
"""η in [0, 1], the name of a balance, or None for the structure's default."""


def momentum_balance(masses: ArrayLike, inertias: ArrayLike, before: ArrayLike, after: ArrayLike) -> float:
    """Return η = ⟨u, v⟩ / ⟨v, v⟩, which may be negative.

    masses, inertias (about each centre of mass): (k,). before, after: (k, 3) velocities (vx, vy, ω) of the
    bodies' centres of mass for a unit angular velocity of arrival and of departure.
    """
    weights = np.stack([masses, masses, inertias], axis=1)
    arriving, leaving = np.asarray(before), np.asarray(after)
    return float((weights * arriving * leaving).sum() / (weights * leaving * leaving).sum())


def resolve_restitution(value: Restitution, default: float | str, balance: Callable[[], float]) -> float:
    """Return η in [0, 1]: `value`, or `default` when it is None; a name stands for `balance`.

    A balance below zero is not physical (the body would not reach the other side): η becomes 0 and a
    StructureWarning says so.
    """
    chosen = default if value is None else value
    if not isinstance(chosen, str):
        return float(chosen)
    found = balance()
    if found >= 0:
        return min(found, 1.0)
    warnings.warn(
        f"restitution by {chosen} balance is {found:.4g} for this geometry, which is not physical; 0 is "
        "used instead (the structure is too squat to rock from side to side), so give a measured value.",
        StructureWarning,
        stacklevel=4,
    )
    return 0.0
