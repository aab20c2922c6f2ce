"""Adaptive baseline: the drift of velocity before and after shaking is fitted and bridged, as at the USGS.

After the PRISM processing of the U.S. Geological Survey (Jones, Kalkan & Stephens 2017, OFR 2017-1008): a line is
fitted to the velocity before shaking, a polynomial of low degree to that after it, and a smooth bridge joins the two;
the acceleration of that drift is subtracted.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from rocking.errors import RecordError

_CANDIDATES = 20
_DEGREES = (1, 2)
_FEWEST = 64
_LEFT = 16
"""Samples after shaking, at least: fewer say nothing of a drift."""


def adaptive_baseline(acceleration: np.ndarray, time_step: float) -> tuple[np.ndarray, str]:
    """Return (corrected acceleration (n,), the sentence that says what was removed).

    Onset and end of shaking are where 0.1 % and 95 % of the squared acceleration have passed; the end is moved among
    20 places up to 85 % of what remains, each tried with degrees 1 and 2; the drift that leaves the smallest
    displacement wins. At least 8 samples are taken as rest before the onset, and 16 as shaking;
    where fewer than 16 are left after it, the record stays as it is.
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
    if strong > acceleration.size - _LEFT:
        return acceleration, "Adaptive baseline left the record as it is: shaking lasts to its end."
    last = min(strong + int(0.85 * (acceleration.size - strong)), acceleration.size - _LEFT)
    tried = np.unique(np.linspace(strong, last, _CANDIDATES).astype(int)).tolist()
    end, degree, drift = min(
        _drifts(velocity, onset, tried), key=lambda found: _wandering(velocity - found[-1], time_step)
    )
    sentence = (
        f"Adaptive baseline: drift of velocity fitted before {onset * time_step:g} s and after {end * time_step:g} s "
        f"(degree {degree}), bridged between, and its acceleration removed."
    )
    return acceleration - np.gradient(drift, time_step), sentence


def _drifts(velocity: np.ndarray, onset: int, ends: Sequence[int]) -> Iterator[tuple[int, int, np.ndarray]]:
    """Yield end, degree and drift (n,) for each end and, of each end, for each degree.

    The drift is a line before the onset, a polynomial after the end, and a cubic Hermite bridge between.
    """
    (known, slope), _ = _fitted(velocity[:onset])
    height = known[-1] + slope
    for end in ends:
        width = end - onset
        s = np.arange(width) / width
        begun = (1 + 2 * s) * (1 - s) ** 2 * height + s * (1 - s) ** 2 * (slope * width)
        reach, lean = s**2 * (3 - 2 * s), s**2 * (s - 1) * width
        for degree, (after, rise) in zip(_DEGREES, _fitted(velocity[end:]), strict=True):
            yield end, degree, np.concatenate([known, begun + reach * after[0] + lean * rise, after])


def _fitted(values: np.ndarray) -> list[tuple[np.ndarray, float]]:
    """Return the least-squares polynomial of each degree through `values` (k,), and its slope at the first, per sample.

    In Legendre's polynomials of these places, which are orthogonal, so that a degree only adds its own term.
    """
    x = np.linspace(-1, 1, values.size)
    square = (x * x).sum()  # sums, because a dot product of many samples wakes a thread on every core
    bow = x * x - square / x.size
    first, second = float((x * values).sum() / square), float((bow * values).sum() / (bow * bow).sum())
    line = values.mean() + first * x
    per_sample = 2 / (x.size - 1)
    return [(line, first * per_sample), (line + second * bow, (first - 2 * second) * per_sample)]


def _wandering(velocity: np.ndarray, time_step: float) -> float:
    """Return the largest displacement, m: a drift left in the velocity makes it larger than the ground's own."""
    course = np.cumsum(velocity)
    return time_step * max(float(course.max()), -float(course.min()))
