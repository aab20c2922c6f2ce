"""The inner functions of the kernels, which have no wrapper for Python, made callable for the tests."""

from functools import cache
from types import ModuleType, SimpleNamespace

import numba


@cache
def callable_parts(module: ModuleType) -> SimpleNamespace:
    """The names of a kernel; what is compiled is called by way of a function of the test's own."""
    compiled = type(numba.njit(lambda: None))

    def wrapped(part):
        return numba.njit(lambda *given: part(*given))

    names = vars(module).items()
    return SimpleNamespace(
        **{name: wrapped(value) if isinstance(value, compiled) else value for name, value in names}
    )
