"""Many structures, each at many scales of one record, on all cores."""

import math
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from rocking.errors import MotionError, RockingError
from rocking.motion.forcing import GroundMotion, forcing_of
from rocking.motion.integration import TOLERANCES, Rocking, reduce
from rocking.motion.many_blocks import all_solvable, follow_blocks
from rocking.motion.members import Members, follow_factors
from rocking.quantities import within
from rocking.records.accelerogram import Accelerogram

_SMALLEST_CHUNK = 16
"""Responses below which a chunk costs more to hand to a thread than it gains."""


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
    factors, forcing = Members(scale_factors).scale_factor, forcing_of(record, vertical)
    ratios = np.full((len(structures), factors.size), math.nan)
    if factors.size == 1 and len(structures) > 1 and all_solvable(structures, forcing):
        return follow_blocks(structures, forcing.scaled(factors[0]))[:, None]
    workers = workers or os.cpu_count() or 1
    chunk = _chunk(len(structures), factors.size, workers)

    def run(job: tuple[int, int]) -> None:
        index, start = job
        columns = slice(start, start + chunk)
        try:
            own = factors[columns]
            lift = own if forcing.vertical else None
            found = follow_factors(reduce(structures[index]), forcing, own, lift, None, tolerance)
        except RockingError:
            return
        ratios[index, columns] = found.rotation_ratio

    jobs = [(index, start) for index in range(len(structures)) for start in range(0, factors.size, chunk)]
    if workers == 1 or len(jobs) == 1:
        for job in jobs:
            run(job)
    else:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(run, jobs))
    return ratios


def _chunk(structures: int, factors: int, workers: int) -> int:
    """Factors per call: all of a structure's, unless there are too few structures to keep the workers busy."""
    parts = max(1, -(-2 * workers // max(structures, 1))) if workers > 1 else 1
    return max(_SMALLEST_CHUNK, -(-factors // parts))
