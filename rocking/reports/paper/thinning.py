"""A trace of many samples as a printer can show it."""

import math

import numpy as np

RESOLVED = 25.4 / 300
"""What a printer and an eye tell apart, mm."""


def thinned(times: np.ndarray, values: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the envelope of a trace that is `width` mm wide: least and largest value of each stretch, in order.

    A stretch is no wider than what is resolved, so that no peak is lost or moved by more than that; a trace of few
    samples stays as it is.
    """
    size = values.size
    stretch = math.ceil(size * RESOLVED / width)
    if stretch < 3:
        return times, values
    padded = np.pad(values, (0, -size % stretch), mode="edge").reshape(-1, stretch)
    begins = np.arange(len(padded)) * stretch
    kept = np.unique(np.concatenate([begins + padded.argmin(axis=1), begins + padded.argmax(axis=1)]))
    return times[kept], values[kept]
