"""What accuracy costs: every method's error against its time, on a user's own records and structures.

Records are cut to their strongest stretch, because the reference takes seconds for what the kernel does in less than
a millisecond; every method is given the same stretch.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, product
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np

from rocking.assessment.method import Method
from rocking.assessment.rows import TradeRow
from rocking.assessment.verdict import Agreement, agreement, ratio, rocks
from rocking.calibration.settings import TradeSettings
from rocking.errors import MotionError, PulseError, RockingError
from rocking.motion.integration import integrate
from rocking.motion.reference import REFERENCE_TOLERANCE, Scipy, event_maximum, reference_maximum
from rocking.motion.table import table_of
from rocking.pulses import PulseSettings, extract_pulses
from rocking.quantities import counted
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum, printed_maximum
from rocking.structures import Mechanism, Structure
from rocking.structures.mechanism import Scale
from rocking.tables import data_package, write_rows, write_whole

TOLERANCES = tuple(10.0**-power for power in range(2, 11))
"""Of the mechanism on the record."""
SCIPY_METHODS: tuple[Scipy, ...] = ("RK45", "DOP853")
SCIPY_TOLERANCES = (1e-3, 1e-6, 1e-9)
REPEATS = 7
"""Timed runs of each method, after one that is not; scipy's, which take seconds, are run once."""
MOST_RECORDS = 40
"""Records among which the cases are sought, spread evenly over the catalogue."""
LEAST_ROTATION = 0.01
"""Rotation ratio below which a case says nothing that matters to anyone."""


@dataclass(frozen=True)
class TradeCase:
    """One record, cut to its strongest stretch, and one structure that rocks under it visibly."""

    record: str
    accelerogram: Accelerogram
    structure: str
    mechanism: Mechanism
    sensitivity: float


@dataclass(frozen=True)
class Timed:
    """What one method said: its answer (nan if it failed), what it took [s] and how often, and what went before."""

    method: str
    tolerance: float
    rotation_ratio: float
    duration: float = math.nan
    repeats: int = 0
    preparation: float = 0.0
    reason: str = ""


def write_trade(
    records: Mapping[str, Callable[[], list[Accelerogram]]],
    structures: Mapping[str, Structure],
    settings: TradeSettings,
    table: Path,
    log: Path,
) -> None:
    """Write the table of cases chosen among `records`, each given by what opens it, and a line for each into `log`.

    Beside the table comes its description, a Frictionless data package of the same name.
    """
    with log.open("w", encoding="utf-8") as stream:

        def motions() -> Iterator[tuple[str, Accelerogram]]:
            names = list(records)
            places = np.unique(np.linspace(0, len(names) - 1, min(MOST_RECORDS, len(names))).astype(int))
            for name in (names[place] for place in places):
                try:
                    yield from ((name, accelerogram) for accelerogram in records[name]())
                except RockingError as error:
                    print(f"{name}: {error}", file=stream, flush=True)

        def rows() -> Iterator[TradeRow]:
            cases = choose_cases(motions(), structures, settings.cases, settings.samples)
            for number, case in enumerate(cases, start=1):
                where = f"{number} of {len(cases)}: {case.record}, {case.structure}"
                found = list(trade_rows(case, settings))
                print(f"{where}: {counted(len(found), 'run')}", file=stream, flush=True)
                yield from found

        write_rows(TradeRow, rows(), table)
    write_whole(
        table.with_suffix(".json"),
        data_package("rocking-trade", {TradeRow.table.name: (TradeRow.table, table.name)}),
    )


def strongest_stretch(accelerogram: Accelerogram, samples: int) -> Accelerogram:
    """Return the `samples` successive samples of `accelerogram` that hold most of its acceleration energy."""
    if accelerogram.acceleration.size <= samples:
        return accelerogram
    spent = np.concatenate([[0.0], np.cumsum(accelerogram.acceleration**2)])
    start = int(np.argmax(spent[samples:] - spent[:-samples]))
    kept = accelerogram.acceleration[start : start + samples]
    return accelerogram.processed_by(kept, f"cut to the {samples} samples from sample {start}")


def choose_cases(
    motions: Iterable[tuple[str, Accelerogram]], structures: Mapping[str, Structure], count: int, samples: int
) -> list[TradeCase]:
    """Return `count` cases that rock: the most sensitive of all, then each structure in turn from its median one."""
    found: dict[str, list[TradeCase]] = {name: [] for name in structures}
    for record, accelerogram in motions:
        stretch = strongest_stretch(accelerogram, samples)
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
    return [*chosen, *(case for case in turns if case not in chosen)][:count]


def trade_rows(case: TradeCase, settings: TradeSettings) -> Iterator[TradeRow]:
    """Yield the rows for one case; none but the reference's where that has no answer within its budget.

    What the reference leaves of the budget is scipy's.
    """
    scale, pulse, budget = (
        settings.assessment.acceleration_scale,
        settings.assessment.pulse,
        settings.budget_s,
    )
    started = perf_counter()
    try:
        truth = reference_maximum(case.mechanism, case.accelerogram, budget)
    except MotionError as error:
        yield _row(case, Timed("reference", REFERENCE_TOLERANCE, math.nan, reason=str(error)), math.nan)
        return
    taken = perf_counter() - started
    yield _row(case, Timed("reference", REFERENCE_TOLERANCE, truth, taken, 1), truth)
    runs = (_closed_forms(case, scale, pulse), _integrations(case, scale), _scipy(case, budget - taken))
    for timed in chain.from_iterable(runs):
        yield _row(case, timed, truth)


def _closed_forms(case: TradeCase, scale: Scale, settings: PulseSettings) -> Iterator[Timed]:
    block = case.mechanism.equivalent_block(scale)
    started = perf_counter()
    try:
        pulse = extract_pulses(case.accelerogram, settings=settings).dominant
    except PulseError as error:
        for method in (Method.PRINTED, Method.CLOSED_FORM):
            yield Timed(method, math.nan, math.nan, reason=str(error))
        return
    once = perf_counter() - started
    printed = _timed(Method.PRINTED, math.nan, lambda: printed_maximum(block, pulse), once)
    overturns = math.isnan(printed.rotation_ratio)  # a negative radicand, which the paper reads so
    yield replace(printed, rotation_ratio=math.inf) if overturns else printed
    yield _timed(Method.CLOSED_FORM, math.nan, lambda: predict_maximum(block, pulse).rotation_ratio, once)


def _integrations(case: TradeCase, scale: Scale) -> Iterator[Timed]:
    block, motion = case.mechanism.equivalent_block(scale), case.accelerogram
    yield _timed(Method.BLOCK_ON_RECORD, math.nan, lambda: integrate(block, motion).rotation_ratio)
    started = perf_counter()
    table_of(replace(case.mechanism))  # an equal object whose table is not remembered
    once = perf_counter() - started
    for tolerance in TOLERANCES:

        def run(tolerance: float = tolerance) -> float:
            return integrate(case.mechanism, motion, tolerance).rotation_ratio

        yield _timed(Method.MECHANISM_ON_RECORD, tolerance, run, once)


def _scipy(case: TradeCase, budget: float) -> Iterator[Timed]:
    end = perf_counter() + budget
    for tolerance, method in product(SCIPY_TOLERANCES, SCIPY_METHODS):
        started = perf_counter()
        try:
            found = event_maximum(case.mechanism, case.accelerogram, method, tolerance, end - started)
        except MotionError as error:
            yield Timed(f"scipy {method}", tolerance, math.nan, reason=str(error))
        else:
            yield Timed(f"scipy {method}", tolerance, found, perf_counter() - started, 1)


def _timed(method: str, tolerance: float, run: Callable[[], float], preparation: float = 0.0) -> Timed:
    try:
        found = run()
    except RockingError as error:
        return Timed(method, tolerance, math.nan, reason=str(error))
    durations = []
    for _ in range(REPEATS):
        started = perf_counter()
        run()
        durations.append(perf_counter() - started)
    return Timed(method, tolerance, found, median(durations), REPEATS, preparation)


def _row(case: TradeCase, timed: Timed, truth: float) -> TradeRow:
    said = agreement(timed.rotation_ratio, truth)
    agrees = said is Agreement.SAME
    miss = abs(ratio(timed.rotation_ratio, truth) - 1)
    return TradeRow(
        record=case.record,
        component=case.accelerogram.component,
        structure=case.structure,
        samples=case.accelerogram.acceleration.size,
        time_step_s=case.accelerogram.time_step,
        sensitivity=case.sensitivity,
        method=timed.method,
        tolerance=timed.tolerance,
        rotation_ratio=timed.rotation_ratio,
        reference_rotation_ratio=truth,
        error=0.0 if agrees and not rocks(truth) else miss,
        verdict_agrees=None if said is Agreement.UNKNOWN else agrees,
        duration_s=timed.duration,
        repeats=timed.repeats,
        preparation_s=timed.preparation,
        reason=timed.reason,
    )


def _from_the_median(cases: Sequence[TradeCase]) -> list[TradeCase]:
    """Sort by how far the sensitivity's rank lies from the median's."""
    ranked = sorted(cases, key=lambda case: abs(case.sensitivity))
    middle = (len(ranked) - 1) / 2
    return [ranked[k] for k in sorted(range(len(ranked)), key=lambda k: (abs(k - middle), k))]
