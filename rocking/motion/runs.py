"""The parts that both kernels share: their compilation, the endings of a run, and the history that is written down.

numba compiles a kernel again only when the kernel's own file changes: after a change here both must be touched.
"""

import math
from typing import Any

import numpy as np
from numba import njit

ROCKS, OVERTURNS, TOO_MANY_IMPACTS, NOT_FINITE = 1, 2, 3, 4
"""The endings of a run; 0 is no uplift."""

REST_ENERGY = 1e-14
"""Rocking ends at an impact that leaves less than this share of the energy that reaches φ_cr.

The next flight would rise to about half this share of φ_cr, less than ten roundings of φ_cr."""

SETTLED = 1e-10
"""A root has converged when Newton's method moves it by less than this share: the next move would be its square."""

IMPACT_LIMIT = 5_000_000

STATUS, IMPACTS, UPLIFT, SIDE, STEPS, PEAKS, TIMES, COLUMNS = 0, 1, 2, 3, 4, 5, 7, 9
"""Columns of the results: how the run ended, impacts, the time of uplift, the last side, steps, and by side (positive
first) the largest arc and its time; how many columns there are."""

INSTANT, PAUSE = 1e-14, 1e-9
"""A landing sooner than INSTANT after an uplift is a rounding: it rests for PAUSE. Both are shares of a sample."""

LOOK_AHEAD = 100
"""Samples over which a chain of impacts is examined for its end."""

# Contraction to fused multiply-adds changes roundings only; infinities and NaN keep their meaning. Without numba's
# counting of references, which took a fifth of the time, nothing may allocate an array: scratch arrays are handed in,
# filled element by element, for an array expression compiles hundreds of functions of its own. Only what Python calls
# gets a wrapper for it: the wrappers would take a third of the time of compiling.
_OPTIONS: dict[str, Any] = {
    "cache": True,
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract"},
    "_nrt": False,
    "no_cfunc_wrapper": True,
}
_INNER: dict[str, Any] = {**_OPTIONS, "no_cpython_wrapper": True}
entry = njit(**_OPTIONS)
compiled = njit(**_INNER)
part = njit(forceinline=True, **_INNER)
"""The compiler of functions called from one place: inlined there, so that nothing is handed over by way of memory."""


@compiled
def write(log, time, arc, speed):
    """Write one line of history where there is room; the first row counts how much room was needed."""
    if log.shape[0] > 0:
        line = int(log[0, 0]) + 1
        log[0, 0] = line
        if line < log.shape[0]:
            log[line, 0], log[line, 1], log[line, 2] = time, arc, speed


@compiled
def keep(best, log, side, peak, span, time):
    """Keep a peak where it is the largest of its side, and write it down; span: the arc per unit of it."""
    slot = 0 if side > 0 else 1
    if peak > best[0, slot]:
        best[0, slot], best[1, slot] = peak, time
    write(log, time, side * peak * span, 0.0)


@compiled
def forget(best, side, arc):
    """Begin `best`, (2, 2): the largest arc of the positive and of the negative side, and their times."""
    best[0, 0] = best[0, 1] = 0.0
    best[1, 0] = best[1, 1] = math.nan
    if side != 0:
        slot = 0 if side > 0 else 1
        best[0, slot], best[1, slot] = arc, 0.0


@compiled
def conclude(row, status, impacts, uplift, side, steps, best):
    """Write a row of the results."""
    row[STATUS], row[IMPACTS], row[UPLIFT], row[SIDE], row[STEPS] = status, impacts, uplift, side, steps
    for slot in range(2):
        row[PEAKS + slot], row[TIMES + slot] = best[0, slot], best[1, slot]


@compiled
def crossing(positive, negative, next_positive, next_negative):
    """The share of an interval after which the first of two margins is positive, and its side; side 0 if none is."""
    to_positive = positive / (positive - next_positive) if next_positive > 0 else 2.0
    to_negative = negative / (negative - next_negative) if next_negative > 0 else 2.0
    if next_positive > 0 or next_negative > 0:
        return min(to_positive, to_negative), 1 if to_positive <= to_negative else -1
    return 0.0, 0


@compiled
def dies_out(near, restitution, shaking, time_step, i, tau, speed, peak):
    """Whether the chain of impacts that starts with `speed` provably ends before the ground can lift the structure.

    near: (k, 8) by side, of the motion near rest: an arc; up to it the least and the largest G̃, the largest |B̃|,
    |dG̃/dq| and |dB̃/dq|, a speed, the slope of ties. shaking: ü_g and ü_v (n,), their factors, g. peak: the arc that
    the chain must not exceed. While ü_g and ü_v stay below bounds, a flight from speed v decelerates by at least d: it
    lasts 2v/d and rises v²/2d at most. Within it the deceleration varies by Δ at most, so it lands with at most
    v (1 + Δ/2d), and each flight multiplies v by at most ρ = η (1 + Δ/2d). With ρ < 1 all flights together last
    2v/(d (1 − ρ)). The chain is over if those bounds hold for as long, and of no account below `peak`.
    """
    horizontal, vertical, factor, lift, gravity = shaking
    eta = max(restitution[0], restitution[1])
    lightest, heaviest, strongest, steepest, steepest_up = np.inf, 0.0, 0.0, 0.0, 0.0
    for j in range(i, min(i + LOOK_AHEAD, horizontal.size - 1)):
        push, weight = factor * horizontal[j], gravity + lift * vertical[j]
        next_push, next_weight = factor * horizontal[j + 1], gravity + lift * vertical[j + 1]
        lightest, heaviest = min(lightest, weight, next_weight), max(heaviest, weight, next_weight)
        strongest = max(strongest, abs(push), abs(next_push))
        steepest = max(steepest, abs(next_push - push))
        steepest_up = max(steepest_up, abs(next_weight - weight))
        d, spread = np.inf, 0.0
        for k in range(near.shape[0]):
            d = min(d, near[k, 1] * lightest - near[k, 3] * strongest)
        if not d > 0:
            return False
        flight, rise = 2 * speed / d, speed * speed / (2 * d)
        for k in range(near.shape[0]):
            in_time = (near[k, 2] * steepest_up + near[k, 3] * steepest) / time_step * flight
            in_place = near[k, 4] * heaviest + near[k, 5] * strongest + near[k, 7]
            spread = max(spread, in_time + in_place * rise) if rise <= near[k, 0] else np.inf
        shrink = eta * (1 + spread / (2 * d))
        if rise > peak or shrink >= 1:
            return False
        if flight / (1 - shrink) <= (j + 1 - i) * time_step - tau:
            return True
    return False
