"""A record as other choices of its processing would leave it."""

from collections.abc import Mapping
from contextlib import suppress
from functools import lru_cache
from types import MappingProxyType

from rocking.errors import RecordError
from rocking.records import Accelerogram
from rocking.records.processing import process, variants

AS_IT_IS = "unchanged"
"""The variant that is the record itself."""


def is_raw(accelerogram: Accelerogram) -> bool:
    """Whether the record comes from a file that says it is uncorrected, whatever was done to it since."""
    return bool(accelerogram.source.path) and accelerogram.processed is False


@lru_cache(maxsize=2)  # the two components of a record
def processed(accelerogram: Accelerogram) -> Mapping[str, Accelerogram]:
    """Return the record as each variant of the processing leaves it, by name, made once; those that do not fit are left
    out. The one AS_IT_IS is the same object.
    """
    records = {}
    for name, processing in variants().items():
        with suppress(RecordError):
            records[name] = process(accelerogram, processing)
    return MappingProxyType(records)
