"""Many structures, each at many scales of one record, on all cores."""

import math
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import numpy as np

from rocking.errors import MotionError, RockingError
from rocking.motion.forcing import Forcing, GroundMotion, forcing_of
from rocking.motion.integration import TOLERANCES, Rocking, reduce
from rocking.motion.many_blocks import all_solvable, follow_blocks
from rocking.motion.members import Members, follow_factors, stepped_ratios
from rocking.motion.table import table_of
from rocking.quantities import within
from rocking.records.accelerogram import Accelerogram
from rocking.structures.mechanism import Mechanism

_SMALLEST_CHUNK = 16
"""Responses below which a job costs more to hand to a thread than it gains."""


def integrate_batch(
    structures: Sequence[Rocking],
    record: GroundMotion,
    scale_factors: Sequence[float] | np.ndarray = (1.0,),
    *,
    vertical: Accelerogram | None = None,
    tolerance: float = 1e-6,
    workers: int | None = None,
) -> np.ndarray:
    """Return φ_max/φ_cr, (structures, factors), of every structure under the record times every factor.

    inf overturns, 0 does not lift, nan failed; `integrate` of that structure and the scaled record raises the reason.
    structures: as `integrate` takes them. scale_factors: (n,), > 0, of both components. tolerance: relative, of the
    largest rotation; an EquivalentBlock without vertical motion is exact. workers: threads, all cores if None. The
    result does not depend on them.
    Raises MotionError for a setting that is wrong for every case.
    """
    tolerance = within(MotionError, "tolerance", tolerance, *TOLERANCES)
    factors, forcing = _factors(scale_factors), forcing_of(record, vertical)
    ratios = np.full((len(structures), factors.size), math.nan)
    if factors.size == 1 and len(structures) > 1 and all_solvable(structures, forcing):
        return follow_blocks(structures, forcing.scaled(factors[0]))[:, None]
    workers = workers or os.cpu_count() or 1

    def run(job: Sequence[tuple[int, slice]]) -> None:
        for index, some in job:
            with suppress(RockingError):
                ratios[index, some] = _ratios(structures[index], forcing, factors[some], tolerance)

    jobs = _shared_out(len(structures), factors.size, workers)
    if workers == 1 or len(jobs) == 1:
        for job in jobs:
            run(job)
    else:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(run, jobs))
    return ratios


def _ratios(
    structure: Rocking, forcing: Forcing, factors: np.ndarray, tolerance: float
) -> np.ndarray | list[float]:
    """The rotation ratios of one structure at `factors` (n,) of the motion."""
    reduced, lift = reduce(structure), factors if forcing.vertical else None
    if isinstance(reduced, Mechanism):
        up = np.zeros(factors.size) if lift is None else lift
        return stepped_ratios(table_of(reduced), forcing, factors, up, tolerance)
    return follow_factors(reduced, forcing, factors, lift, None, tolerance).rotation_ratio


def _factors(given: Sequence[float] | np.ndarray) -> np.ndarray:
    factors = np.array(given, dtype=float, ndmin=1)
    if factors.ndim == 1 and factors.size and factors.min() > 0 and factors.max() < math.inf:
        return factors
    return Members(given).scale_factor  # says what is wrong


def _shared_out(structures: int, factors: int, workers: int) -> list[list[tuple[int, slice]]]:
    """Jobs of calls: place of the structure, and which factors.

    A call takes all factors of a structure, unless there are too few structures to keep the workers busy; a job takes
    as many calls as are worth a thread.
    """
    parts = max(1, -(-2 * workers // max(structures, 1))) if workers > 1 else 1
    chunk = max(_SMALLEST_CHUNK, -(-factors // parts))
    calls = [
        (index, slice(start, start + chunk))
        for index in range(structures)
        for start in range(0, factors, chunk)
    ]
    size = max(1, _SMALLEST_CHUNK // min(chunk, factors))
    return [calls[k : k + size] for k in range(0, len(calls), size)]
