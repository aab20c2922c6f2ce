"""Strong-motion formats, each a recogniser and a reader; FORMATS lists them all.

A new format is a new file here that makes a Format, and its name in _FILES.
"""

from importlib import import_module

from rocking.records.formats.format import Format, Options

_FILES = "peer", "volumes", "europe", "americas", "pacific", "by_obspy", "tables"
_MODULES = [import_module(f"{__name__}.{file}") for file in _FILES]

FORMATS = tuple(form for module in _MODULES for form in vars(module).values() if isinstance(form, Format))
"""Every format there is. Exactly one recognises a file; the order does not matter."""

__all__ = ["FORMATS", "Format", "Options"]
