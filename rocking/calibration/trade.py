"""The trade of error for time, measured on a user's own records and structures, and what it comes down to."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np

from rocking.assessment.rows.of_trade import (
    MultiFidelityRow,
    TradeFragilityRow,
    TradeMethod,
    TradeMethodRow,
    TradeRow,
)
from rocking.assessment.verdict import rests, rocks
from rocking.calibration.accuracy import (
    DEFAULT_TOLERANCE,
    SCIPY_METHODS,
    Pulses,
    TradeCase,
    choose_cases,
    scipy_rows,
    whole_record_rows,
)
from rocking.calibration.fragility_trade import Suite, trade_fragility_rows
from rocking.calibration.settings import TradeSettings
from rocking.errors import RockingError
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.tables import Row, write_tables

MOST_RECORDS = 70
"""Records that are tried, spread evenly over the catalogue."""
Tell = Callable[[str], None]


def write_trade(
    records: Mapping[str, Callable[[], list[Accelerogram]]],
    structures: Mapping[str, Structure],
    settings: TradeSettings,
    folder: Path,
    tell: Tell,
    intensity_measure: str = "pgv",
) -> None:
    """Write the tables of the trade into `folder`, with their description. records: each given by what opens it.

    tell: is told of each part as it is finished, and of what could not be used.
    """
    motions = list(_opened(records, tell))
    pulses = [Pulses.of(motion, settings.assessment.pulse) for _, motion in motions]
    rows = list(_whole_records(motions, pulses, structures, settings, tell))
    cases = choose_cases(motions, structures, settings)
    for number, case in enumerate(cases, start=1):
        found = list(scipy_rows(case, settings.budget_s))
        tell(f"{number} of {len(cases)}: {case.record}, {case.structure}, beside scipy")
        rows += found
    suite = Suite([motion for _, motion in motions], pulses, intensity_measure, settings.assessment.ensemble)
    fragilities, samples = _fragilities(suite, structures, tell)
    tables: Mapping[type[Row], Sequence[Row]] = {
        TradeRow: rows,
        TradeFragilityRow: fragilities,
        MultiFidelityRow: samples,
        TradeMethodRow: list(method_rows(rows, fragilities)),
    }
    write_tables(tables, folder, "rocking-trade", "trade.json")


def method_rows(
    rows: Sequence[TradeRow], fragilities: Sequence[TradeFragilityRow]
) -> Iterator[TradeMethodRow]:
    """Yield a row for each method that was tried, at the default tolerance."""
    usual = [row for row in rows if math.isnan(row.tolerance) or row.tolerance == DEFAULT_TOLERANCE]
    of_method = {
        method: [
            row for row in usual if row.method == method and (row.beside_scipy == (method in SCIPY_METHODS))
        ]
        for method in TradeMethod
    }
    curves = {method: [row for row in fragilities if row.method == method] for method in TradeMethod}
    dear = _median([row.cpu_s for row in of_method[TradeMethod.MECHANISM]])
    dear_curve = _median([_each_record(row) for row in curves[TradeMethod.MECHANISM]])
    for method in TradeMethod:
        if of_method[method] or curves[method]:
            yield _method_row(method, of_method[method], curves[method], dear, dear_curve)


def _method_row(
    method: TradeMethod,
    rows: Sequence[TradeRow],
    curves: Sequence[TradeFragilityRow],
    dear: float,
    dear_curve: float,
) -> TradeMethodRow:
    """dear, dear_curve: what the mechanism takes for a response, and for a record in a fragility."""
    moving = [row for row in rows if not (rests(row.rotation_ratio) and rests(row.reference_rotation_ratio))]
    once, each = (_median([getattr(row, name) for row in rows]) for name in ("preparation_record_s", "cpu_s"))
    errors = [abs(row.error) for row in curves]
    once_curve = _median([row.preparation_s / row.records for row in curves])
    return TradeMethodRow(
        method=method,
        cases=sum(row.verdict_agrees is not None for row in moving),
        error=_median([row.error for row in moving if rocks(row.reference_rotation_ratio)]),
        wrong_verdicts=sum(row.verdict_agrees is False for row in moving),
        fragility_structures=len(curves),
        fragility_error=_median(errors),
        fragility_error_worst=max(errors, default=math.nan),
        cpu_s=each,
        preparation_record_s=once,
        preparation_structure_s=_median([row.preparation_structure_s for row in rows]),
        fragility_cpu_s=_median([row.cpu_s for row in curves]),
        pays_from=pays_from(once, each, dear),
        pays_from_fragility=pays_from(once_curve, _median([_each_record(row) for row in curves]), dear_curve),
    )


def _each_record(row: TradeFragilityRow) -> float:
    return row.cpu_s / row.records


def pays_from(once: float, each: float, dear: float) -> float:
    """Return the least number of structures for which once + number × each < number × dear; inf where none is."""
    if math.isnan(each) or math.isnan(dear):
        return math.nan
    return float(math.floor(once / (dear - each)) + 1) if each < dear else math.inf


def _median(values: Sequence[float]) -> float:
    known = [value for value in values if not math.isnan(value)]
    return float(np.median(known)) if known else math.nan


def _opened(
    records: Mapping[str, Callable[[], list[Accelerogram]]], tell: Tell
) -> Iterator[tuple[str, Accelerogram]]:
    names = list(records)
    places = np.unique(np.linspace(0, len(names) - 1, min(MOST_RECORDS, len(names))).astype(int))
    for name in (names[place] for place in places):
        try:
            yield from ((name, accelerogram) for accelerogram in records[name]())
        except RockingError as error:
            tell(f"{name}: {error}")


def _whole_records(
    motions: Sequence[tuple[str, Accelerogram]],
    pulses: Sequence[Pulses],
    structures: Mapping[str, Structure],
    settings: TradeSettings,
    tell: Tell,
) -> Iterator[TradeRow]:
    for (record, motion), found in zip(motions, pulses, strict=True):
        for name, structure in structures.items():
            case = TradeCase(record, motion, name, structure.mechanism())
            try:
                yield from whole_record_rows(case, found, settings.assessment.ensemble)
            except RockingError as error:
                tell(f"{record}, {name}: {error}")


def _fragilities(
    suite: Suite, structures: Mapping[str, Structure], tell: Tell
) -> tuple[list[TradeFragilityRow], list[MultiFidelityRow]]:
    _warm(suite, structures)
    fragilities: list[TradeFragilityRow] = []
    samples: list[MultiFidelityRow] = []
    for name, structure in structures.items():
        try:
            found, sampled = trade_fragility_rows(name, structure.mechanism(), suite)
        except RockingError as error:
            tell(f"no fragility of {name}: {error}")
            continue
        tell(f"fragility of {name}")
        fragilities += found
        samples += sampled
    return fragilities, samples


def _warm(suite: Suite, structures: Mapping[str, Structure]) -> None:
    """Run every method once under two records, so that none is charged for loading what is compiled."""
    first = {(record.event, record.station): k for k, record in reversed(list(enumerate(suite.records)))}
    kept = sorted(first.values())[:2]
    few = replace(suite, records=[suite.records[k] for k in kept], pulses=[suite.pulses[k] for k in kept])
    with suppress(RockingError):  # told where it is measured
        trade_fragility_rows("", next(iter(structures.values())).mechanism(), few)
