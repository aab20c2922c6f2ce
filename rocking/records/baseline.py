"""Adaptive baseline: the drift of velocity before and after shaking is fitted and bridged, as at the USGS.

After the PRISM processing of the U.S. Geological Survey (Jones, Kalkan & Stephens 2017, OFR 2017-1008): a line is
fitted to the velocity before shaking, a polynomial of low degree to that after it, and a smooth bridge joins the two;
the acceleration of that drift is subtracted.
"""

import numpy as np

from rocking.errors import RecordError

_CANDIDATES = 20
_DEGREES = (1, 2)
_FEWEST = 64


def adaptive_baseline(acceleration: np.ndarray, time_step: float) -> tuple[np.ndarray, str]:
    """Return (corrected acceleration (n,), the sentence that says what was removed).

    Onset and end of shaking are where 0.1 % and 95 % of the squared acceleration have passed; the end is moved among
    20 places up to 85 % of what remains, each tried with degrees 1 and 2; the drift that leaves the smallest
    displacement wins.
    Raises RecordError for fewer than 64 samples or a record without motion.
    """
    if acceleration.size < _FEWEST or not np.any(acceleration):
        raise RecordError(
            f"the adaptive baseline needs motion and at least {_FEWEST} samples, got {acceleration.size}."
        )
    velocity = time_step * (np.cumsum(acceleration) - (acceleration + acceleration[0]) / 2)
    share = np.cumsum(acceleration**2)
    onset = max(8, int(np.searchsorted(share, 1e-3 * share[-1])))
    strong = max(onset + 16, int(np.searchsorted(share, 0.95 * share[-1])))
    last = strong + int(0.85 * (acceleration.size - strong))
    ends = np.unique(np.linspace(strong, min(last, acceleration.size - 16), _CANDIDATES).astype(int))
    tried = [(end, degree) for end in ends if end > onset + 8 for degree in _DEGREES]
    drifts = [_drift(velocity, onset, end, degree) for end, degree in tried] or [np.zeros_like(velocity)]
    best = int(np.argmin([_wandering(velocity - drift, time_step) for drift in drifts]))
    if not tried:
        return acceleration, "Adaptive baseline left the record as it is: shaking lasts to its end."
    end, degree = tried[best]
    sentence = (
        f"Adaptive baseline: drift of velocity fitted before {onset * time_step:g} s and after {end * time_step:g} s "
        f"(degree {degree}), bridged between, and its acceleration removed."
    )
    return acceleration - np.gradient(drifts[best], time_step), sentence


def _drift(velocity: np.ndarray, onset: int, end: int, degree: int) -> np.ndarray:
    """Return the drift (n,): a line before the onset, a polynomial after the end, a cubic Hermite bridge between."""
    index = np.linspace(-1, 1, velocity.size)
    before = np.polynomial.Polynomial.fit(index[:onset], velocity[:onset], 1)
    after = np.polynomial.Polynomial.fit(index[end:], velocity[end:], degree)
    drift = np.where(np.arange(velocity.size) < onset, before(index), after(index))
    a, b = index[onset], index[end]
    s = (index[onset:end] - a) / (b - a)
    slopes = before.deriv()(a) * (b - a), after.deriv()(b) * (b - a)
    drift[onset:end] = (
        (1 + 2 * s) * (1 - s) ** 2 * before(a)
        + s * (1 - s) ** 2 * slopes[0]
        + s**2 * (3 - 2 * s) * after(b)
        + s**2 * (s - 1) * slopes[1]
    )
    return drift


def _wandering(velocity: np.ndarray, time_step: float) -> float:
    """Return the largest displacement, m: a drift left in the velocity makes it larger than the ground's own."""
    return float(np.abs(time_step * np.cumsum(velocity)).max())
