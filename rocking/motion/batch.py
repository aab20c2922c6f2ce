"""Many structures, each at many scales of one record, on all cores; rocking spectra."""

import math
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from rocking.drawn import Drawn
from rocking.errors import MotionError, RockingError
from rocking.motion.integration import (
    LARGEST_GROWTH,
    LARGEST_TOLERANCE,
    LEAST_TOLERANCE,
    Members,
    Rocking,
    Runs,
    concluded,
    follow_blocks,
    follow_runs,
    reduce,
    solvable_exactly,
)
from rocking.motion.table import Forcing, GroundMotion, forcing_of
from rocking.quantities import kind_of, within
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import EquivalentBlock

if TYPE_CHECKING:
    from pandas import DataFrame

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

    inf overturns, 0 does not lift, nan failed; `integrate` of that structure and the scaled record raises the
    reason.

    Parameters
    ----------
    structures : sequence of Mechanism, EquivalentBlock or Structure
        (m,) structures, each as `integrate` takes it.
    record : Accelerogram or Pulse
        Accelerogram, linear between its samples, or Pulse, exact.
    scale_factors : sequence of float or ndarray, optional
        (n,) factors, > 0, of the horizontal and the vertical component.
    vertical : Accelerogram or None, optional
        Vertical acceleration ü_v, sample by sample as the horizontal motion; gravity becomes g + ü_v.
    tolerance : float, default 1e-06
        Relative tolerance of the largest rotation; an EquivalentBlock without vertical motion is exact.
    workers : int or None, optional
        Number of threads; None: all cores. The result does not depend on it.

    Returns
    -------
    ndarray
        (m, n) φ_max/φ_cr; inf overturns, 0 does not lift, nan failed: `integrate` of that structure and the
        scaled record raises the reason.

    Raises
    ------
    MotionError
        For a setting that is wrong for every case.

    Examples
    --------
    >>> from rocking import Block, Pulse, integrate_batch
    >>> blocks = [Block(semi_diagonal=size, slenderness=0.2) for size in (0.5, 2.0)]
    >>> integrate_batch(blocks, Pulse(amplitude=3.0, circular_frequency=6.0), [0.5, 1.0, 2.0]).shape
    (2, 3)
    """
    tolerance = within(MotionError, "tolerance", tolerance, low=LEAST_TOLERANCE, high=LARGEST_TOLERANCE)
    if not isinstance(structures, Sequence) or isinstance(structures, str):
        raise MotionError(
            f"structures is {kind_of(structures)}, but must be a list of structures; integrate follows one.",
            structures=structures,
        )
    factors = Members(scale_factors).scale_factor
    forcing = forcing_of(record, vertical)
    ratios = np.full((len(structures), factors.size), math.nan)
    workers = workers or os.cpu_count() or 1

    def run(job: Sequence[tuple[int, slice]]) -> None:
        places = [index for index, _ in job]
        some = job[0][1]
        if blocks := _plain_blocks([structures[index] for index in places], forcing):
            responses = concluded(blocks[0].sides, follow_blocks(blocks, forcing, Runs(factors[some])))
            ratios[places, some] = responses.rotation_ratio.reshape(len(places), -1)
            return
        for index in places:
            with suppress(RockingError):
                lift = factors[some] if forcing.vertical else None
                reduced = reduce(structures[index])
                responses = follow_runs(reduced, forcing, Runs(factors[some], lift), tolerance)
                ratios[index, some] = responses.rotation_ratio

    jobs = _shared_out(len(structures), factors.size, workers)
    with ThreadPoolExecutor(workers) as pool:
        list((map if workers == 1 or len(jobs) == 1 else pool.map)(run, jobs))
    return ratios


def _plain_blocks(structures: Sequence[Rocking], forcing: Forcing) -> list[EquivalentBlock]:
    """The structures, where they are blocks that one call can follow: alike, exact, and without a rotation_map."""
    blocks = [
        structure for structure in structures if not forcing.vertical and solvable_exactly(structure, forcing)
    ]
    kinds = {(len(block.sides), block.one_sided) for block in blocks}
    mapped = any(side.rotation_map for block in blocks for side in block.sides)
    return blocks if len(blocks) == len(structures) and len(kinds) == 1 and not mapped else []


def _shared_out(structures: int, factors: int, workers: int) -> list[list[tuple[int, slice]]]:
    """Jobs of calls, each a structure's place and which factors, the same ones within a job.

    As many calls as are worth a thread, and jobs as keep all of them busy.
    """
    # Two calls for each worker, so that none waits long for the last.
    parts = math.ceil(2 * workers / max(structures, 1)) if workers > 1 else 1
    chunk = max(_SMALLEST_CHUNK, math.ceil(factors / parts))
    slices = [slice(start, start + chunk) for start in range(0, factors, chunk)]
    calls = list(product(range(structures), slices))
    calls_of_a_job = max(1, _SMALLEST_CHUNK // min(chunk, factors))
    return [calls[start : start + calls_of_a_job] for start in range(0, len(calls), calls_of_a_job)]


class RockingSpectrum(Drawn, np.ndarray):
    """φ_max/φ_cr, (m, n): an array that knows its axes.

    frequency_parameters: p (m,), rad/s. uplift_multipliers: λ (n,). A part of it keeps the axes of the whole.
    `plot` draws lines of equal ratio; it raises MotionError for a part, or for fewer than two values on either axis.
    """

    frequency_parameters: np.ndarray
    uplift_multipliers: np.ndarray

    def __array_finalize__(self, of: np.ndarray | None) -> None:
        self.frequency_parameters = getattr(of, "frequency_parameters", np.empty(0))
        self.uplift_multipliers = getattr(of, "uplift_multipliers", np.empty(0))

    def frame(self) -> "DataFrame":
        """Return a pandas frame with one row per block: its p, its λ and its rotation ratio.

        Raises MotionError for a part of a spectrum.
        """
        from pandas import DataFrame  # which takes half a second to import

        whole = self.frequency_parameters.size, self.uplift_multipliers.size
        if self.shape != whole:
            raise MotionError(
                f"the spectrum has shape {self.shape}, but a frame needs the whole of it, {whole}.",
                shape=self.shape,
            )
        return DataFrame(
            {
                "frequency_parameter_rad_s": np.repeat(self.frequency_parameters, whole[1]),
                "uplift_multiplier": np.tile(self.uplift_multipliers, whole[0]),
                "rotation_ratio": np.ravel(self),
            }
        )


def rocking_spectrum(
    accelerogram: Accelerogram,
    frequency_parameters: Sequence[float] | np.ndarray,
    uplift_multipliers: Sequence[float] | np.ndarray,
    restitution: float,
    workers: int | None = None,
) -> RockingSpectrum:
    """Return φ_max/φ_cr, (m, n), of the equivalent blocks of p [rad/s] (m,) and λ (n,) under one record; inf overturns.

    Exact (linear between samples), on all cores or on `workers` threads.

    Parameters
    ----------
    accelerogram : Accelerogram
        The ground motion.
    frequency_parameters : sequence of float or ndarray
        (m,) p, rad/s.
    uplift_multipliers : sequence of float or ndarray
        (n,) λ.
    restitution : float
        η of the angular velocity, in [0, 1].
    workers : int or None, optional
        Number of threads; None: all cores.

    Returns
    -------
    RockingSpectrum
        Largest rotation ratio of each block, (m, n).

    Raises
    ------
    MotionError
        When p or λ is not positive, or the restitution lies outside [0, 1].

    Examples
    --------
    >>> from rocking import read, rocking_spectrum
    >>> record = read("records/synthetic_strong_pulse.AT2")[0]
    >>> rocking_spectrum(record, [1.0, 2.0, 3.0], [0.1, 0.3], 0.9).shape
    (3, 2)
    """
    if not isinstance(accelerogram, Accelerogram):
        raise MotionError(
            f"accelerogram is {kind_of(accelerogram)}, but must be an Accelerogram; "
            "pulse_spectrum takes a pulse.",
            accelerogram=accelerogram,
        )
    frequencies = _positive("frequency_parameters", frequency_parameters)
    multipliers = _positive("uplift_multipliers", uplift_multipliers)
    restitution = within(MotionError, "restitution", restitution, low=0, high=1)
    step = accelerogram.time_step
    if frequencies.size and frequencies.max() * step > LARGEST_GROWTH:
        raise MotionError(
            f"frequency_parameters reach {frequencies.max()!r} rad/s, but at a time step of {step!r} s "
            f"must stay below {LARGEST_GROWTH / step:g}.",
            frequency_parameters=float(frequencies.max()),
        )
    # The block of λ under the record responds as the one of λ = 1 under the record over λ.
    blocks = [
        EquivalentBlock(
            frequency_parameter=p, critical_rotation=1.0, acceleration_scale=1.0, restitution=restitution
        )
        for p in frequencies.tolist()
    ]
    ratios = integrate_batch(blocks, accelerogram, 1 / multipliers, workers=workers).view(RockingSpectrum)
    ratios.frequency_parameters = frequencies
    ratios.uplift_multipliers = multipliers
    return ratios


def _positive(field: str, values: Sequence[float] | np.ndarray) -> np.ndarray:
    array = np.array(values, dtype=float)
    if array.ndim != 1 or not array.size or not np.all(np.isfinite(array) & (array > 0)):
        raise MotionError(
            f"{field} must be a one-dimensional array of finite numbers greater than 0.", **{field: array}
        )
    return array
