"""What both kernels share: how they are compiled, and how a run ends.

numba compiles a kernel anew when the kernel's own file changes: after a change here both must be touched.
"""

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
