"""Fragility: intensity measures, curves over them, and annual rates."""

import sys
from types import ModuleType
from typing import Any


class _Fragility(ModuleType):
    """The package, which answers a call as `rocking.fragility` does: Python binds that name to it on import."""

    def __call__(self, *arguments: Any, **settings: Any) -> Any:
        """See `rocking.fragility.curves.fragility`."""
        from rocking.fragility.curves import fragility

        return fragility(*arguments, **settings)


sys.modules[__name__].__class__ = _Fragility
