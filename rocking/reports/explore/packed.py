"""Numbers as a page carries them: 16-bit integers in base64 with one scale, which loses 1/32767 of the largest."""

import base64
import math

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures import Structure

Packed = dict[str, object]

BINS = 600
"""Points of a trace on the page."""
FRAMES = 24
"""Drawings of a structure for each side; between two of them the page interpolates."""
_MOST, _FARTHEST = 32767, 1.2
_BEYOND = 3.0
"""Times the critical rotation up to which a structure is drawn, but no further than _FARTHEST [rad]."""


def packed(values: ArrayLike) -> Packed:
    """Return `values`, any shape, flattened into a scale and base64 of little-endian 16-bit integers."""
    flat = np.asarray(values, dtype=float).ravel()
    scale = float(np.abs(flat).max(initial=0.0)) / _MOST or 1.0
    whole = np.round(flat / scale).astype("<i2")
    return {"scale": scale, "data": base64.b64encode(whole.tobytes()).decode()}


def number(value: float) -> float | str | None:
    """Return `value` as JSON can hold it: null for nan, "inf" for infinity, else six digits."""
    if math.isnan(value):
        return None
    return "inf" if math.isinf(value) else float(f"{value:.6g}")


def extremes(times: np.ndarray, values: np.ndarray, begin: float, end: float) -> np.ndarray:
    """Return the value farthest from zero in each of BINS equal stretches of [begin, end] s, (BINS,): peaks stay.

    A stretch without a sample takes the value interpolated at its middle.
    """
    edges = np.linspace(begin, end, BINS + 1)
    shown = np.interp((edges[:-1] + edges[1:]) / 2, times, values)
    inside = (times >= begin) & (times <= end)
    place = np.minimum(np.searchsorted(edges, times[inside], side="right") - 1, BINS - 1)
    chosen = values[inside]
    order = np.argsort(np.abs(chosen), kind="stable")
    full = np.full(BINS, np.nan)
    full[place[order]] = chosen[order]  # the last one written, the farthest, stays
    return np.where(np.isnan(full), shown, full)


def drawings(structure: Structure) -> Packed:
    """Return the outline and the hinges of `structure` at FRAMES rotations of each side that it has.

    rotations: rad, signed. parts: points of each part, by frame. hinges: their number, by frame. points: x and y [m] of
    the parts and then of the hinges, frame by frame.
    """
    mechanism = structure.mechanism()
    sides = [(1, mechanism.sides[0])] + ([] if mechanism.one_sided else [(-1, mechanism.sides[-1])])
    rotations = [
        sign * float(share) * min(0.98 * side.end_rotation, _BEYOND * side.critical_rotation, _FARTHEST)
        for sign, side in sides
        for share in np.linspace(1e-6, 1.0, FRAMES)
    ]
    frames = [(structure.outline(each), structure.hinges(each)) for each in rotations]
    points = [np.asarray(part) for outline, hinges in frames for part in (*outline, hinges)]
    return {
        "rotations": rotations,
        "parts": [[len(part) for part in outline] for outline, _ in frames],
        "hinges": [len(hinges) for _, hinges in frames],
        "points": packed(np.vstack(points)),
    }
