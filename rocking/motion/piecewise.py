"""Functions as polynomials on equal pieces of an interval."""

from collections.abc import Callable

import numpy as np

DEGREE = 7
ACCURACY = 1e-12
"""Largest error of a table, relative to the largest magnitude of the quantity."""

ROOM = 0.25
"""A piece is accurate up to this share of its width beyond its ends; a step goes no further."""

AIM = 2e-14
"""Error at which no more pieces are made, relative likewise."""

_MOST_PIECES = 4096
_NODES = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
_PROBES = np.linspace(-0.99, 0.99, 16)


def fitted(
    functions: Callable[[np.ndarray], np.ndarray],
    start: float,
    end: float,
    largest: np.ndarray,
    least: np.ndarray | float = 0.0,
) -> np.ndarray | None:
    """Polynomials (f, m, 8) of f functions on m equal pieces of [start, end], good to ROOM beyond its ends, or None.

    Pieces are halved, as often at once as the order of the error, DEGREE + 1, says is surely needed, until the error is
    AIM of the zone's own maximum, or no longer falls because it is the rounding of the functions themselves; it must
    then be within ACCURACY of `largest` (f,), the maxima over the whole side. Maxima below `least` (f,) count as that.
    """
    best, best_error, good, count = None, np.inf, False, 2
    while count <= _MOST_PIECES:
        powers, errors, zone = _fit(functions, start, end, count)
        if not np.all(np.isfinite(errors)):
            return None
        error = (errors / np.maximum(zone, least)).max()
        if error < best_error:
            best, best_error, good = (
                powers,
                error,
                bool(np.all(errors <= ACCURACY * np.maximum(largest, least))),
            )
        elif good:
            break
        if best_error <= AIM:
            break
        count <<= max(1, int(np.log2(error / AIM) / (DEGREE + 1)))
    return best if good else None


def _fit(
    functions: Callable[[np.ndarray], np.ndarray], start: float, end: float, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Interpolate on `count` pieces; also the largest error between the nodes, and the largest value, (f,) each."""
    half = (end - start) / count / 2
    centres = start + (2 * np.arange(count)[:, None] + 1) * half
    low = np.maximum(start - centres, -(1 + 2 * ROOM) * half) / half
    high = np.minimum(end - centres, (1 + 2 * ROOM) * half) / half
    places, probes = ((low + high) / 2 + (high - low) / 2 * each for each in (_NODES, _PROBES))
    found = functions(centres + half * np.concatenate([places, probes], axis=1))
    values, between = found[..., : _NODES.size], found[..., _NODES.size :]
    powers = np.linalg.solve(places[..., None] ** np.arange(DEGREE + 1), np.moveaxis(values, 0, -1))
    powers = np.moveaxis(powers, -1, 0)
    fit = np.einsum("fmp,mqp->fmq", powers, probes[..., None] ** np.arange(DEGREE + 1))
    errors = np.abs(fit - between).max(axis=(1, 2))
    return powers / half ** np.arange(DEGREE + 1), errors, np.abs(values).max(axis=(1, 2))
