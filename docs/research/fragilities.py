"""What accuracy costs in a fragility: its median by every method at the same levels, and the time of each."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from time import process_time
from typing import TypeVar

import numpy as np

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility import Fragility, fragility_of, incremental_dynamic_analysis
from rocking.assessment.rows.of_trade import TradeMethod
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.trade import best_sines
from rocking.motion import integrate_batch
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maxima
from rocking.structures import EquivalentBlock, Structure
from rocking.tables import Row, column, row, write_tables

TIGHT = 1e-9
"""Tolerance of the reference."""

T = TypeVar("T")


@row("trade_fragility", "One row per structure and method: error and time of a whole fragility")
class TradeFragilityRow(Row):
    """One method for one structure."""

    structure: str = column("Name of the structure")
    method: str = column("What was computed with")
    records: int = column("Components that were scaled")
    stations: int = column("Stations they come from")
    median: float = column("Peak ground velocity at which half overturn, m/s")
    reference_median: float = column("The same of the mechanism at 1e-9, m/s")
    error: float = column("Median over that of the reference, less one")
    curve_error: float = column("Mean error of P(overturns) over the levels where it is open")
    cpu_s: float = column("Processor time of all responses")
    preparation_s: float = column("Processor time spent on the pulses of all records before")


def write_fragilities(
    records: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    folder: Path,
    tell: Callable[[str], None],
) -> None:
    """Write trade_fragility.csv and its description into `folder`; tell: is given a line for each structure."""
    sines, searched = _timed(lambda: [best_sines(record, AssessmentSettings()) for record in records])
    rows: list[TradeFragilityRow] = []
    for name, structure in structures.items():
        rows += fragility_rows(name, structure, records, sines, searched)
        tell(f"fragility of {name}")
    write_tables({TradeFragilityRow: rows}, folder, "rocking-trade-fragility", "trade_fragility.json")


def fragility_rows(
    name: str,
    structure: Structure,
    records: Sequence[Accelerogram],
    sines: Sequence[Sequence[Pulse]],
    searched_s: float,
) -> Iterator[TradeFragilityRow]:
    """Yield the rows of one structure. sines: of each record, best first; their search took searched_s."""
    analysis = partial(incremental_dynamic_analysis, records, structure, intensity_measure="pgv")
    reference = analysis(tolerance=TIGHT)
    levels, exact = reference.levels, reference.fragility()
    factors = levels / reference.intensities[:, None]
    block = structure.mechanism().equivalent_block("rest")
    runs: dict[TradeMethod, Callable[[], np.ndarray | Fragility]] = {
        TradeMethod.ONE_SINE: lambda: _by_sines(block, [each[:1] for each in sines], factors),
        TradeMethod.SINES: lambda: _by_sines(block, sines, factors),
        TradeMethod.BLOCK: lambda: np.isinf(
            [integrate_batch([block], *pair, workers=1)[0] for pair in zip(records, factors, strict=True)]
        ),
        TradeMethod.MECHANISM: lambda: analysis(levels=levels).fragility(),
        TradeMethod.ENSEMBLE: lambda: analysis(levels=levels, ensemble=EnsembleSettings()).fragility(),
    }
    is_open = (exact.probability > 0.02) & (exact.probability < 0.98)
    for method, run in runs.items():
        found, cpu_s = _timed(run)
        if not isinstance(found, Fragility):
            found = fragility_of(levels, found.astype(float), reference.stations)
        yield TradeFragilityRow(
            structure=name,
            method=method,
            records=len(records),
            stations=len(set(reference.stations)),
            median=found.median,
            reference_median=exact.median,
            error=found.median / exact.median - 1,
            curve_error=float(np.abs(found.probability - exact.probability)[is_open].mean()),
            cpu_s=cpu_s,
            preparation_s=searched_s if method in (TradeMethod.ONE_SINE, TradeMethod.SINES) else 0.0,
        )


def _by_sines(block: EquivalentBlock, sines: Sequence[Sequence[Pulse]], factors: np.ndarray) -> np.ndarray:
    """Whether the worst sine of each record overturns the block, (r, k), at `factors` (r, k); never without any."""
    overturns = np.zeros(factors.shape, dtype=bool)
    for place, (own, scales) in enumerate(zip(sines, factors, strict=True)):
        scaled = [Pulse(p.amplitude * f, p.circular_frequency, p.start_time) for p in own for f in scales]
        if scaled:
            overturns[place] = np.isinf(predict_maxima([block], scaled)[0].reshape(-1, scales.size)).any(
                axis=0
            )
    return overturns


def _timed(run: Callable[[], T]) -> tuple[T, float]:
    started = process_time()
    return run(), process_time() - started
