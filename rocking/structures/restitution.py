"""Restitution of the impact at φ = 0: a number, or the momentum balance by name.

Every momentum balance here is one equation. Just before the impact the bodies move with the velocity field u
of one mechanism, just after with η times the field v of the other; the impulses act where the new mechanism
turns and do no work on it, so ⟨η v − u, v⟩ = 0 in the mass inner product and η = ⟨u, v⟩ / ⟨v, v⟩. For a
block this is Housner's 1 − 1.5 sin²α, for the mid-height wall (1 − 4.5 sin²α)/(1 + 3 sin²α), for the frame
Makris and Vassiliou's value.
"""

import warnings
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureError, StructureWarning
from rocking.quantities import within

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


def check_restitution(value: Restitution, names: tuple[str, ...], one_sided: bool = False) -> None:
    """Raise StructureError unless `value` is None, one of `names`, or a number in [0, 1].

    A one-sided body must have the number: what it leans on takes part in the impact, and no name covers that.
    """
    if one_sided and (value is None or isinstance(value, str)):
        raise StructureError(
            f"restitution is {value!r}, but a one-sided body needs its own number between 0 and 1; give it."
        )
    if isinstance(value, str):
        if value not in names:
            raise StructureError(
                f"restitution is {value!r}, but must be a number from 0 to 1 or one of {', '.join(names)}."
            )
    elif value is not None:
        within(StructureError, "restitution", value, 0, 1)


def resolve_restitution(
    value: Restitution, default: float | str, balances: Mapping[str, Callable[[], float]]
) -> float:
    """Return η in [0, 1]: `value`, or `default` when it is None; a name stands for one of `balances`.

    A balance below zero is not physical (the body would not reach the other side): η becomes 0 and a
    StructureWarning says so.
    """
    chosen = default if value is None else value
    if not isinstance(chosen, str):
        return float(chosen)
    balance = balances[chosen]()
    if balance >= 0:
        return min(balance, 1.0)
    warnings.warn(
        f"restitution by {chosen} balance is {balance:.4g} for this geometry, which is not physical; 0 is "
        "used instead (the structure is too squat to rock from side to side), so give a measured value.",
        StructureWarning,
        stacklevel=4,
    )
    return 0.0
