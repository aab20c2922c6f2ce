"""The error of the equivalent block, measured for a side without ties by quadrature (Figs. 3, 4, 6 and 7).

Energy gives φ'² = 2E/I, so a time is the integral of sqrt(I/2E) over φ. It is singular where the motion turns or
starts; φ = φ₀(1 − u²) or φ = φ_cr u² takes the singularity out, and the energy is itself an integral of G and B.
No time stepping anywhere.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from rocking.errors import StructureError
from rocking.quantities import GRAVITY, within
from rocking.structures.equivalent_block import Scale
from rocking.structures.mechanism import Mechanism, Side

_NODES, _WEIGHTS = (values / 2 for values in np.polynomial.legendre.leggauss(80))
_NODES = _NODES + 0.5
"""Gauss nodes on [0, 1] for the work of the smooth G and B: exact to rounding for every shipped structure."""


def uplift_ratio(side: Side) -> float:
    """Return λ_lin/λ = φ_cr/(a_sc λ) (Eqs. 7 and 12)."""
    return side.critical_rotation / (side.acceleration_scale * side.uplift_multiplier)


@cache
def natural_period(side: Side, amplitude: float) -> float:
    """Return the period [s] of free rocking without loss from a rotation `amplitude` [rad].

    Four times the time from φ₀ to 0, as if both sides were alike.
    """
    _check_amplitude(amplitude / side.critical_rotation)

    fallen = amplitude * _NODES**2
    work = (
        side.gravity(amplitude - np.outer(fallen, _NODES)) @ _WEIGHTS
    )  # energy released, per g and per fallen
    rates = 2 * np.sqrt(amplitude * side.inertia(amplitude - fallen) / (2 * GRAVITY * work))
    return float(4 * _WEIGHTS @ rates)


def block_period(side: Side, amplitude_ratio: float, scale: Scale = "linearised") -> float:
    """Return the period [s] of an equivalent block at φ₀/φ_cr: (4/p) acosh(1/(1 − x)) (Housner 1963).

    x is φ₀/φ_cr, or for the block exact at rest its arc over that of φ_cr.
    """
    _check_amplitude(amplitude_ratio)
    block = Mechanism(side).equivalent_block(scale)
    x = amplitude_ratio
    if block.rotation_map is not None:
        x = block.rotation_map.arc(amplitude_ratio * block.critical_rotation) / block.critical_arc
    return float(4 / block.frequency_parameter * np.arccosh(1 / (1 - x)))


@cache
def overturning_time(side: Side, acceleration_ratio: float) -> float:
    """Return the time [s] from rest to φ_cr under a constant ü_g of `acceleration_ratio` · gλ; inf if never."""
    _check_acceleration(acceleration_ratio)
    push = acceleration_ratio * side.uplift_multiplier
    critical = side.critical_rotation

    def work(u: float) -> float:
        """Done by the push less taken by gravity, per g and per rotation reached."""
        reached = critical * u**2 * _NODES
        return float(_WEIGHTS @ (push * side.ground(reached) - side.gravity(reached)))

    def rate(u: float) -> float:
        return 2 * math.sqrt(critical * side.at("inertia", critical * u**2) / (2 * GRAVITY * work(u)))

    if _least(work) <= 0:
        return np.inf
    # A push that just outdoes gravity passes slowly where it nearly does not: the quadrature adapts to the place.
    return float(quad(rate, 0.0, 1.0, epsabs=0.0, epsrel=1e-10, limit=200)[0])


def block_overturning_time(side: Side, acceleration_ratio: float, scale: Scale = "linearised") -> float:
    """Return the same time [s] of an equivalent block; inf if it does not lift."""
    _check_acceleration(acceleration_ratio)
    block = Mechanism(side).equivalent_block(scale)
    excess = acceleration_ratio * side.uplift_multiplier / block.uplift_multiplier - 1
    return float(np.arccosh(1 + 1 / excess) / block.frequency_parameter) if excess > 0 else np.inf


def _least(work: Callable[[float], float]) -> float:
    """Return the smallest of a smooth function on [0, 1]."""
    places = np.linspace(0.0, 1.0, 33)
    values = [work(u) for u in places]
    near = int(np.argmin(values))
    between = places[max(near - 1, 0)], places[min(near + 1, 32)]
    return min(values[near], float(minimize_scalar(work, bounds=between, method="bounded").fun))


def _check_amplitude(ratio: float) -> None:
    if not 0 < ratio < 1:
        raise StructureError(
            f"amplitude is {ratio!r} of the critical rotation, but must lie between 0 and 1."
        )


def _check_acceleration(ratio: float) -> None:
    if within(StructureError, "acceleration_ratio", ratio, low=1, high=1e9) == 1:
        raise StructureError(
            f"acceleration_ratio is {ratio!r}, but must exceed 1, at which the structure lifts."
        )
