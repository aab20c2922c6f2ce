"""What a history of rocking says: when it lands, and how much of its speed each reversal on still ground keeps."""

import math
from itertools import pairwise

import numpy as np

VISIBLE = 0.02
"""Largest excursions, over the critical rotation, from which a restitution is read."""


def landings(times: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Return when the rotation changes sign: (k,) s, on straight lines between the samples (n,)."""
    before, after = rotation[:-1], rotation[1:]
    at = np.flatnonzero(np.sign(before) * np.sign(after) < 0)
    share = before[at] / (before[at] - after[at])
    return times[at] + share * (times[at + 1] - times[at])


def restitution(
    times: np.ndarray, rotation: np.ndarray, energy: np.ndarray, still: float, critical: float
) -> float:
    """Return √(E₂/E₁) of the first two visible excursions at rest angle 0 after `still` [s]; nan: there are not two.

    Between two excursions lies one reversal; what energy it keeps is the square of its restitution (theory: section 1).
    rotation [rad], energy: (n,) each at `times` [s].
    """
    ends = np.flatnonzero(np.sign(rotation[:-1]) * np.sign(rotation[1:]) < 0) + 1
    peaks = [a + int(np.abs(rotation[a:b]).argmax()) for a, b in pairwise(ends)]
    seen = [at for at in peaks if times[at] > still and abs(rotation[at]) > VISIBLE * critical]
    if len(seen) < 2 or abs(rotation[seen[0]]) >= critical:
        return math.nan
    return math.sqrt(energy[seen[1]] / energy[seen[0]])
