"""The rocking spectrum of one full sine pulse: the largest rotation over ω = ω_g/p and a = a_g/(gλ)."""

import numpy as np

from rocking.errors import PulseError, StructureError
from rocking.quantities import within
from rocking.sine_pulse import kernel
from rocking.sine_pulse.ratios import LARGEST_RATIO


def pulse_spectrum(
    frequency_ratios: np.ndarray, amplitude_ratios: np.ndarray, restitution: float
) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of every symmetric equivalent block under one full sine pulse, exactly.

    frequency_ratios: ω = ω_g/p in [1e-12, 1e12], (m,). amplitude_ratios: a = |a_g|/(gλ) in [0, 1e12], (n,).
    restitution: η in [0, 1].
    inf where the block overturns, 0 where it does not lift, nan where `predict_maximum` says it is unresolved.
    Raises PulseError or StructureError.
    """
    frequencies = _axis("frequency_ratios", frequency_ratios, 1 / LARGEST_RATIO)
    amplitudes = _axis("amplitude_ratios", amplitude_ratios, 0.0)
    eta = within(StructureError, "restitution", restitution, 0, 1)
    ratios = np.empty((frequencies.size, amplitudes.size))
    kernel.spectrum(np.ascontiguousarray(frequencies), np.ascontiguousarray(amplitudes), eta, ratios)
    return ratios


def _axis(field: str, values: np.ndarray, lowest: float) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or array.size == 0:
        raise PulseError(f"{field} has the shape {array.shape}, but must be a list of at least one number.")
    wrong = array[~((array >= lowest) & (array <= LARGEST_RATIO))]
    if wrong.size:
        raise PulseError(
            f"{field} holds {wrong[0]!s}, but every value must lie between {lowest:g} and {LARGEST_RATIO:g}."
        )
    return array
