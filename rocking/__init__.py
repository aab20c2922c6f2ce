"""Rocking structures under recorded earthquakes: SI units and radians inside.

The public names and their types stand in `__init__.pyi`, and nowhere else. Each is imported when it is first used, so
that a script pays only for what it needs.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
