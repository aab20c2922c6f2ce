"""The trade: what accuracy costs on a user's own records and structures: method by error by processor time."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from statistics import median
from time import process_time
from typing import TypeVar

from rocking.assessment.ensemble import ensemble
from rocking.assessment.motions import GroundMotions
from rocking.assessment.rows import TimedAnswer, TradeMethod, TradeRow, TriedMethod
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import PulseError, RockingError
from rocking.motion import integrate
from rocking.pulses import DEMAND_CANDIDATES, Pulse, extract_pulses
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import EquivalentBlock, Mechanism, Structure

TOLERANCES = {TradeMethod.COARSE: 1e-3, TradeMethod.MECHANISM: 1e-6, TradeMethod.FINE: 1e-9}
REFERENCE_TOLERANCE = 1e-12
REPEATS = 3
"""Timed runs of each response, after one that is not; an ensemble is run once."""

T = TypeVar("T")


def trade(
    records: Iterable[Accelerogram],
    structures: Mapping[str, Structure],
    *,
    settings: AssessmentSettings | None = None,
    tell: Callable[[str], None] = lambda line: None,
) -> list[TradeRow]:
    """Return a row for each method and structure, and one for each method over all structures.

    Every structure is met by every record with every method, one response at a time. tell: takes a line for each
    record, and one for each case that cannot be followed. Times are processor times of this machine, in s.

    >>> pier = rocking.Block.of_size(0.8, 6.0, 0.9)
    >>> rows = rocking.trade(rocking.read("records/synthetic_strong_pulse.AT2"), {"pier": pier})
    >>> [str(row.method) for row in rows if row.structure == "pier" and row.wrong_verdicts]
    ['one sine', 'five sines']
    """
    chosen = settings or AssessmentSettings()
    mechanisms = {name: structure.mechanism() for name, structure in structures.items()}
    answers: dict[tuple[TradeMethod, str], list[TimedAnswer]] = {}
    for number, record in enumerate(records, start=1):
        sines, searched_s = _timed(partial(best_sines, record, chosen))
        for name, mechanism in mechanisms.items():
            try:
                reference = integrate(mechanism, record, REFERENCE_TOLERANCE).rotation_ratio
                for method, run in _runs(mechanism, record, sines, chosen).items():
                    rotation_ratio, cpu_s = _timed(run, 0 if method is TradeMethod.ENSEMBLE else REPEATS)
                    record_s = searched_s if method in (TradeMethod.ONE_SINE, TradeMethod.SINES) else 0.0
                    for whose in ("", name):
                        answer = TimedAnswer(rotation_ratio, reference, cpu_s, record_s)
                        answers.setdefault((method, whose), []).append(answer)
            except RockingError as error:
                tell(f"record {number}, {name}: {error}")
        tell(f"record {number}: {len(mechanisms)} structures")
    return [
        TradeRow.of(TriedMethod(method, structure, answers[method, structure]))
        for structure in ("", *mechanisms)
        for method in TradeMethod
        if (method, structure) in answers
    ]


def _runs(
    mechanism: Mechanism, record: Accelerogram, sines: Sequence[Pulse], settings: AssessmentSettings
) -> dict[TradeMethod, Callable[[], float]]:
    """The computation of the largest rotation by each method; no closed form for a record without pulses."""
    block = mechanism.equivalent_block("rest")

    def worst(some: Sequence[Pulse]) -> float:
        return max(predict_maximum(block, pulse).rotation_ratio for pulse in some)

    def rotation(structure: EquivalentBlock | Mechanism, tolerance: float) -> float:
        return integrate(structure, record, tolerance).rotation_ratio

    def middle() -> float:
        members = ensemble(mechanism, GroundMotions.of(record), settings.ensemble)
        return math.inf if members.overturning_share > 0.5 else members.rotation_ratio_median

    by_sines = {TradeMethod.ONE_SINE: sines[:1], TradeMethod.SINES: sines} if sines else {}
    return {
        **{method: partial(worst, some) for method, some in by_sines.items()},
        TradeMethod.BLOCK: partial(rotation, block, 1e-6),
        **{method: partial(rotation, mechanism, tolerance) for method, tolerance in TOLERANCES.items()},
        TradeMethod.ENSEMBLE: middle,
    }


def best_sines(record: Accelerogram, settings: AssessmentSettings) -> tuple[Pulse, ...]:
    """Return the best-ranked sines of a record; none where it has none."""
    try:
        ranked = extract_pulses(record, settings=settings.pulse).ranked
    except PulseError:
        return ()
    return tuple(each.pulse for each in ranked[:DEMAND_CANDIDATES])


def _timed(run: Callable[[], T], repeats: int = 0) -> tuple[T, float]:
    """Return what `run` gives, and its processor time, s: of the first run, or the median of the repeats after it."""
    spent: list[float] = []
    for _ in range(1 + repeats):
        started = process_time()
        answer = run()
        spent.append(process_time() - started)
    return answer, median(spent[1:] or spent)
