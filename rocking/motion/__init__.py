"""Motion: a structure followed through a ground motion, exactly or to a tolerance."""

from importlib import import_module

_MODULE_OF = {
    "Response": "rocking.motion.response",
    "integrate": "rocking.motion.integration",
    "integrate_many": "rocking.motion.integration",
}

__all__ = ["Response", "integrate", "integrate_many"]


def __getattr__(name: str) -> object:
    """Import a public name when it is first used: only `integrate` needs the compiled kernel."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'rocking.motion' has no attribute {name!r}")
    return getattr(import_module(_MODULE_OF[name]), name)
