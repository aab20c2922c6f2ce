"""The vertical component that goes with a horizontal one, sample by sample."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue import as_declared, channels_of, vertical_of
from rocking.records.catalogue_record import CatalogueRecord


def open_vertical(
    record: CatalogueRecord, mirror: str | Path | None = None, cache: str | Path | None = None
) -> Accelerogram | None:
    """Return the vertical accelerogram of `record`, scaled as the row says; None where there is none.

    It comes from the row's vertical_file, which lies beside the catalogue or in the mirror, else from the file itself.
    Raises RecordError naming record and file.
    """
    other = record.of_vertical
    channels = channels_of(other, mirror, cache)
    found = vertical_of(channels, other)
    if found is None and record.vertical_file:
        if len(channels) > 1:
            raise RecordError(
                f"{record.id} ({other.file}): no channel says that it is vertical; name it in vertical_component."
            )
        found = channels[0]
    return None if found is None else as_declared(found, record)


def aligned(vertical: Accelerogram, horizontal: Accelerogram) -> Accelerogram:
    """Return `vertical` with as many samples as `horizontal`: cut, or still after its end.

    Raises RecordError when their time steps differ by more than rounding.
    """
    if not np.isclose(vertical.time_step, horizontal.time_step, rtol=1e-9, atol=0):
        raise RecordError(
            f"time_step of the vertical component is {vertical.time_step!r} s, but must equal that of the horizontal "
            f"one, {horizontal.time_step!r} s; resample one of them."
        )
    size = horizontal.acceleration.size
    samples = np.zeros(size)
    kept = min(size, vertical.acceleration.size)
    samples[:kept] = vertical.acceleration[:kept]
    return replace(vertical, acceleration=samples, time_step=horizontal.time_step)
