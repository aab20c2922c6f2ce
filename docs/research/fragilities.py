"""What accuracy costs in a fragility: its median by every method at the same levels, and the time of each."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from docs.research import scores
from docs.research.report import publish
from docs.research.scores import Score
from docs.research.sites import timed
from rocking.assessment.fragility import _crossing, incremental_dynamic_analysis
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.trade import TradeMethod, best_sines
from rocking.motion import integrate_batch
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maxima
from rocking.structures import EquivalentBlock, Structure

TIGHT = 1e-9
"""Tolerance of the reference."""
OPEN = (0.02, 0.98)
"""Probabilities between which the error of a curve counts."""


def write_fragilities(
    records: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    folder: Path,
    tell: Callable[[str], None],
) -> None:
    """Write the scores of every method into `folder`; tell: is given a line for each structure."""
    sines, searched_s = timed(lambda: [best_sines(record, AssessmentSettings()) for record in records])
    found: list[Score] = []
    for name, structure in structures.items():
        found += method_scores(name, structure, records, sines)
        tell(f"fragility of {name}")
    subtitle = f"{len(records)} components; the sines of all took {searched_s:.0f} s of processor time."
    publish(folder, "What accuracy costs in a fragility", subtitle, {Score: found})


def method_scores(
    name: str, structure: Structure, records: Sequence[Accelerogram], sines: Sequence[Sequence[Pulse]]
) -> Iterator[Score]:
    """Yield the scores of every method for one structure, against the mechanism at TIGHT. sines: best first."""
    analysis = partial(incremental_dynamic_analysis, records, structure, intensity_measure="pgv")
    reference = analysis(tolerance=TIGHT)
    levels, exact = reference.levels, np.isinf(reference.rotation_ratios).mean(axis=2)
    factors = levels / reference.intensities[:, None]
    block = structure.mechanism().equivalent_block("rest")
    runs: dict[TradeMethod, Callable[[], np.ndarray]] = {
        TradeMethod.ONE_SINE: lambda: _by_sines(block, [each[:1] for each in sines], factors),
        TradeMethod.SINES: lambda: _by_sines(block, sines, factors),
        TradeMethod.BLOCK: lambda: np.array(
            [integrate_batch([block], *pair, workers=1)[0] for pair in zip(records, factors, strict=True)]
        )[..., None],
        TradeMethod.MECHANISM: lambda: analysis(levels=levels).rotation_ratios,
        TradeMethod.ENSEMBLE: lambda: analysis(levels=levels, ensemble=EnsembleSettings()).rotation_ratios,
    }
    for method, run in runs.items():
        ratios, cpu_s = timed(run)
        shares = np.isinf(ratios).mean(axis=2)
        measures = {
            "error of the median": partial(_median_error, levels, shares, exact),
            "mean error of the curve": partial(_curve_error, shares, exact),
            "processor time of all, s": scores.mean(np.full(len(shares), cpu_s)),
        }
        yield from scores.scored(method, name, measures, reference.stations)


def median_of(levels: np.ndarray, shares: np.ndarray) -> float:
    """Return the median of a fragility whose stations overturn by `shares` (n, k) at `levels` (k,)."""
    return _crossing(levels, shares.sum(axis=0), np.full(levels.size, float(len(shares))))


def _median_error(levels: np.ndarray, shares: np.ndarray, exact: np.ndarray, rows: np.ndarray) -> float:
    return median_of(levels, shares[rows]) / median_of(levels, exact[rows]) - 1


def _curve_error(shares: np.ndarray, exact: np.ndarray, rows: np.ndarray) -> float:
    truth = exact[rows].mean(axis=0)
    is_open = (truth > OPEN[0]) & (truth < OPEN[1])
    return float(np.abs(shares[rows].mean(axis=0) - truth)[is_open].mean()) if is_open.any() else np.nan


def _by_sines(block: EquivalentBlock, sines: Sequence[Sequence[Pulse]], factors: np.ndarray) -> np.ndarray:
    """The largest rotation ratio under any sine of each record, (r, k, 1), at `factors` (r, k); 0 without any."""
    ratios = np.zeros((*factors.shape, 1))
    for place, (own, scales) in enumerate(zip(sines, factors, strict=True)):
        scaled = [Pulse(p.amplitude * f, p.circular_frequency, p.start_time) for p in own for f in scales]
        if scaled:
            ratios[place, :, 0] = predict_maxima([block], scaled)[0].reshape(-1, scales.size).max(axis=0)
    return ratios
