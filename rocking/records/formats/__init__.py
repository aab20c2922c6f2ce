"""One file per strong-motion format, each a recogniser and a reader; FORMATS lists them all.

A new format is a new file here that makes a Format, and its name in _FILES.
"""

from importlib import import_module

from rocking.records.formats.format import Format, Options

_FILES = (
    "peer",
    "cosmos",
    "csmip",
    "smc",
    "usc",
    "knet",
    "dyna",
    "afad",
    "resorce",
    "geonet",
    "unam",
    "bhrc",
    "renadic",
    "cwb",
    "csmnc",
    "evt",
    "sac",
    "miniseed",
    "titled",
    "columns",
)

FORMATS: tuple[Format, ...] = tuple(
    found
    for file in _FILES
    for found in vars(import_module(f"{__name__}.{file}")).values()
    if isinstance(found, Format)
)
"""Every format there is. Exactly one recognises a file; the order does not matter."""

__all__ = ["FORMATS", "Format", "Options"]
