"""What both kernels share: how they are compiled, how a run ends, and what is written down of it.

numba compiles a kernel anew when the kernel's own file changes: after a change here both must be touched.
"""

import math
from typing import Any

from numba import njit

ROCKS, OVERTURNS, TOO_MANY_IMPACTS, NOT_FINITE = 1, 2, 3, 4
"""How a run ends; 0 is no uplift."""

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
"""Of what is called from one place: inlined there, so that nothing is handed over by way of memory."""


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
