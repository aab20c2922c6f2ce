"""Motion: a structure followed through a ground motion, exactly or to a tolerance.

The names stand in `__init__.pyi` and are imported when they are first used: only some need the compiled kernel.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
