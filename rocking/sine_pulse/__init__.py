"""The equivalent block under one full sine pulse: exact maximum, regime and spectrum; Eqs. 15 and 16 as printed.

The names stand in `__init__.pyi` and are imported when they are first used: only some need the compiled kernel.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
