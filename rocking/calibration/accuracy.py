"""What accuracy costs, case by case: every method's error and time, on a user's own records and structures.

Every method but scipy follows whole records, and is held against the mechanism at a tight tolerance. Scipy takes
seconds for what the kernel does in less than a millisecond, so that it is tried in few cases, cut to the strongest
stretch of their record; there it is the reference.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import product
from statistics import median
from time import process_time
from typing import Any

import numpy as np

from rocking.assessment.ensemble import EnsembleSettings, GroundMotions, ensemble
from rocking.assessment.rows.of_trade import TradeMethod, TradeRow
from rocking.assessment.verdict import Agreement, agreement, ratio, rocks
from rocking.calibration.settings import TradeSettings
from rocking.errors import MotionError, PulseError, RockingError
from rocking.motion.integration import integrate
from rocking.motion.reference import REFERENCE_TOLERANCE, Scipy, event_maximum, reference_maximum
from rocking.motion.table import table_of
from rocking.pulses import Pulse, PulseSettings, extract_pulses
from rocking.pulses.methods.sine_by_demand import CANDIDATES
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import EquivalentBlock, Mechanism, Structure

TOLERANCES = (1e-3, 1e-6, 1e-9)
"""Of the mechanism, and of scipy."""
DEFAULT_TOLERANCE = 1e-6
SCIPY_METHODS: Mapping[TradeMethod, Scipy] = {TradeMethod.RK45: "RK45", TradeMethod.DOP853: "DOP853"}
REPEATS = 5
"""Timed runs of each method, after one that is not; an ensemble is run once, and scipy."""
LEAST_ROTATION = 0.01
"""Rotation ratio below which a case says nothing that matters to anyone."""


@dataclass(frozen=True)
class TradeCase:
    """One record and one structure. sensitivity: of the largest rotation to the amplitude."""

    record: str
    accelerogram: Accelerogram
    structure: str
    mechanism: Mechanism
    sensitivity: float = math.nan


@dataclass(frozen=True)
class Pulses:
    """The best-ranked sines of a record, and the processor time that finding them took, s."""

    sines: tuple[Pulse, ...]
    cpu: float
    reason: str = ""

    @classmethod
    def of(cls, accelerogram: Accelerogram, settings: PulseSettings) -> "Pulses":
        """Find them; none where the record has none."""
        started = process_time()
        try:
            ranked = extract_pulses(accelerogram, settings=settings).ranked
        except PulseError as error:
            return cls((), process_time() - started, str(error))
        return cls(tuple(each.pulse for each in ranked[:CANDIDATES]), process_time() - started)


@dataclass(frozen=True)
class Timed:
    """What one method said: its answer (nan if it failed), and what it took, s."""

    method: str
    tolerance: float
    rotation_ratio: float
    cpu_s: float = math.nan
    preparation_record_s: float = 0.0
    preparation_structure_s: float = 0.0
    reason: str = ""


def whole_record_rows(case: TradeCase, pulses: Pulses, settings: EnsembleSettings) -> Iterator[TradeRow]:
    """Yield the rows of one case under its whole record. Raises MotionError where the mechanism cannot be followed."""
    truth = integrate(case.mechanism, case.accelerogram, REFERENCE_TOLERANCE).rotation_ratio
    block, block_cpu = _equivalent_block(case.mechanism)
    for timed in (
        *_sines(block, pulses, block_cpu),
        _timed(TradeMethod.BLOCK, lambda: _rotation(block, case), preparation_structure_s=block_cpu),
        *_mechanism(case),
        _ensemble(case, settings),
    ):
        yield trade_row(case, timed, truth, beside_scipy=False)


def scipy_rows(case: TradeCase, budget: float) -> Iterator[TradeRow]:
    """Yield scipy's rows and the mechanism's for a case that is cut; a row that says so where the budget, s, is spent.

    What the reference leaves of the budget is that of scipy at looser tolerances.
    """
    end = process_time() + budget
    try:
        truth = reference_maximum(case.mechanism, case.accelerogram, budget)
    except MotionError as error:
        yield trade_row(
            case, Timed(TradeMethod.DOP853, REFERENCE_TOLERANCE, math.nan, reason=str(error)), math.nan
        )
        return
    for timed in _mechanism(case):
        yield trade_row(case, timed, truth)
    for tolerance, (method, name) in product(TOLERANCES, SCIPY_METHODS.items()):
        started = process_time()
        try:
            found = event_maximum(case.mechanism, case.accelerogram, name, tolerance, end - started)
        except MotionError as error:
            yield trade_row(case, Timed(method, tolerance, math.nan, reason=str(error)), truth)
        else:
            yield trade_row(case, Timed(method, tolerance, found, process_time() - started), truth)


def strongest_stretch(accelerogram: Accelerogram, samples: int) -> Accelerogram:
    """Return the `samples` successive samples of `accelerogram` that hold most of its acceleration energy."""
    if accelerogram.acceleration.size <= samples:
        return accelerogram
    spent = np.concatenate([[0.0], np.cumsum(accelerogram.acceleration**2)])
    start = int(np.argmax(spent[samples:] - spent[:-samples]))
    kept = accelerogram.acceleration[start : start + samples]
    return accelerogram.processed_by(kept, f"cut to the {samples} samples from sample {start}")


def choose_cases(
    motions: Iterable[tuple[str, Accelerogram]], structures: Mapping[str, Structure], settings: TradeSettings
) -> list[TradeCase]:
    """Return the cases, cut, that rock: the most sensitive of all, then each structure in turn from its median one."""
    found: dict[str, list[TradeCase]] = {name: [] for name in structures}
    for record, accelerogram in motions:
        stretch = strongest_stretch(accelerogram, settings.samples)
        for name, structure in structures.items():
            response = integrate(structure, stretch, sensitivity=True)
            if response.rotation_ratio >= LEAST_ROTATION and math.isfinite(response.sensitivity):
                case = TradeCase(record, stretch, name, structure.mechanism(), response.sensitivity)
                found[name].append(case)
    queues = [_from_the_median(cases) for cases in found.values()]
    everything = [case for cases in queues for case in cases]
    chosen = [max(everything, key=lambda case: abs(case.sensitivity))] if everything else []
    longest = max((len(queue) for queue in queues), default=0)
    turns = [queue[turn] for turn in range(longest) for queue in queues if turn < len(queue)]
    return [*chosen, *(case for case in turns if case not in chosen)][: settings.cases]


def trade_row(case: TradeCase, timed: Timed, truth: float, *, beside_scipy: bool = True) -> TradeRow:
    """Return what the answer of one method is worth beside `truth`."""
    said = agreement(timed.rotation_ratio, truth)
    agrees = said is Agreement.SAME
    miss = abs(ratio(timed.rotation_ratio, truth) - 1)
    return TradeRow(
        record=case.record,
        component=case.accelerogram.component,
        structure=case.structure,
        samples=case.accelerogram.acceleration.size,
        beside_scipy=beside_scipy,
        reference_rotation_ratio=truth,
        error=0.0 if agrees and not rocks(truth) else miss,
        verdict_agrees=None if said is Agreement.UNKNOWN else agrees,
        **asdict(timed),
    )


def _equivalent_block(mechanism: Mechanism) -> tuple[EquivalentBlock, float]:
    """The block, made anew of an equal mechanism that remembers none, and the time that took."""
    fresh, started = replace(mechanism), process_time()
    block = fresh.equivalent_block("rest")
    return block, process_time() - started


def _sines(block: EquivalentBlock, pulses: Pulses, block_cpu: float) -> Iterator[Timed]:
    for method, many in ((TradeMethod.ONE_SINE, 1), (TradeMethod.SINES, CANDIDATES)):
        if not pulses.sines:
            yield Timed(method, math.nan, math.nan, reason=pulses.reason)
            continue

        run = partial(_worst, block, pulses.sines[:many])
        yield _timed(method, run, preparation_record_s=pulses.cpu, preparation_structure_s=block_cpu)


def _worst(block: EquivalentBlock, sines: Sequence[Pulse]) -> float:
    return max(predict_maximum(block, pulse).rotation_ratio for pulse in sines)


def _rotation(structure: EquivalentBlock | Mechanism, case: TradeCase, tolerance: float = 1e-6) -> float:
    return integrate(structure, case.accelerogram, tolerance).rotation_ratio


def _mechanism(case: TradeCase) -> Iterator[Timed]:
    started = process_time()
    table_of(replace(case.mechanism))  # an equal object whose table is not remembered
    once = process_time() - started
    for tolerance in TOLERANCES:
        run = partial(_rotation, case.mechanism, case, tolerance)
        yield _timed(TradeMethod.MECHANISM, run, tolerance, preparation_structure_s=once)


def _ensemble(case: TradeCase, settings: EnsembleSettings) -> Timed:
    """Its median; of the verdict that overturning is likelier than not."""
    started = process_time()
    found = ensemble(case.mechanism, GroundMotions.of(case.accelerogram), settings)
    taken = process_time() - started
    overturns = found.overturning_probability > 0.5
    return Timed(TradeMethod.ENSEMBLE, math.nan, math.inf if overturns else found.median, taken)


def _timed(
    method: TradeMethod, run: Callable[[], float], tolerance: float = math.nan, **prepared: Any
) -> Timed:
    try:
        found = run()
    except RockingError as error:
        return Timed(method, tolerance, math.nan, reason=str(error))
    durations = []
    for _ in range(REPEATS):
        started = process_time()
        run()
        durations.append(process_time() - started)
    return Timed(method, tolerance, found, median(durations), **prepared)


def _from_the_median(cases: Sequence[TradeCase]) -> list[TradeCase]:
    """Sort by how far the sensitivity's rank lies from the median's."""
    ranked = sorted(cases, key=lambda case: abs(case.sensitivity))
    middle = (len(ranked) - 1) / 2
    return [ranked[k] for k in sorted(range(len(ranked)), key=lambda k: (abs(k - middle), k))]
