"""What accuracy costs on a user's own records and structures: method by error by processor time."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from statistics import median
from time import process_time
from typing import TypeVar

import numpy as np

from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.rows.of_trade import TradeMethod, TradeRow
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.verdict import Agreement, agreement, ratio, rests
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


@dataclass(frozen=True)
class _Answer:
    """The rotation ratio that one method gives in one case, that of the reference, and the processor times, s."""

    method: TradeMethod
    structure: str
    rotation_ratio: float
    reference: float
    cpu_s: float
    record_s: float


def trade(
    records: Iterable[Accelerogram],
    structures: Mapping[str, Structure],
    *,
    settings: AssessmentSettings | None = None,
    tell: Callable[[str], None] = lambda line: None,
) -> list[TradeRow]:
    """Return a row for each method and structure, and one for each method over all structures.

    Every structure is met by every record with every method, one response at a time. tell: is given a line for each
    record, and one for each case that cannot be followed. Times are processor times of this machine, in s.

    >>> pier = rocking.Block.of_size(0.8, 6.0, 0.9)
    >>> rows = rocking.trade(rocking.read("records/synthetic_strong_pulse.AT2"), {"pier": pier})
    >>> [str(row.method) for row in rows if row.structure == "pier" and row.wrong_verdicts]
    ['one sine', 'five sines']
    """
    chosen = settings or AssessmentSettings()
    mechanisms = {name: structure.mechanism() for name, structure in structures.items()}
    answers: list[_Answer] = []
    for number, record in enumerate(records, start=1):
        sines, searched = _timed(partial(_sines, record, chosen))
        for name, mechanism in mechanisms.items():
            block = mechanism.equivalent_block("rest")
            prediction = {TradeMethod.ONE_SINE: sines[:1], TradeMethod.SINES: sines}
            runs = {
                **{method: partial(_worst, block, some) for method, some in prediction.items() if sines},
                TradeMethod.BLOCK: partial(_rotation, block, record),
                **{
                    method: partial(_rotation, mechanism, record, each) for method, each in TOLERANCES.items()
                },
                TradeMethod.ENSEMBLE: partial(_member_in_the_middle, mechanism, record, chosen),
            }
            try:
                reference = _rotation(mechanism, record, REFERENCE_TOLERANCE)
                for method, run in runs.items():
                    found, cpu_s = _timed(run, 0 if method is TradeMethod.ENSEMBLE else REPEATS)
                    record_s = searched if method in prediction else 0.0
                    answers.append(_Answer(method, name, found, reference, cpu_s, record_s))
            except RockingError as error:
                tell(f"record {number}, {name}: {error}")
        tell(f"record {number}: {len(mechanisms)} structures")
    return list(_rows(answers))


def _rows(answers: Sequence[_Answer]) -> Iterator[TradeRow]:
    """Yield the rows that the answers come down to, those over all structures first."""
    for structure in ("", *dict.fromkeys(answer.structure for answer in answers)):
        own = [answer for answer in answers if structure in ("", answer.structure)]
        usual = [answer.cpu_s for answer in own if answer.method is TradeMethod.MECHANISM]
        for method in TradeMethod:
            of_method = [answer for answer in own if answer.method is method]
            if of_method:
                yield _row(structure, method, of_method, _median(usual))


def _row(structure: str, method: TradeMethod, answers: Sequence[_Answer], usual_s: float) -> TradeRow:
    """usual_s: processor time of a response of the mechanism at the default tolerance, s."""
    moving = [each for each in answers if not (rests(each.rotation_ratio) and rests(each.reference))]
    verdicts = [agreement(each.rotation_ratio, each.reference) for each in moving]
    errors = [abs(ratio(each.rotation_ratio, each.reference) - 1) for each in moving]
    known = [error for error in errors if not math.isnan(error)]
    cpu_s, record_s = _median([each.cpu_s for each in answers]), _median([each.record_s for each in answers])
    return TradeRow(
        method=method,
        structure=structure,
        cases=len(moving),
        error=_median(known),
        error_high=float(np.quantile(known, 0.95)) if known else math.nan,
        wrong_verdicts=sum(each is not Agreement.SAME for each in verdicts),
        unsafe_verdicts=sum(each is Agreement.TOO_LOW for each in verdicts),
        cpu_s=cpu_s,
        preparation_record_s=record_s,
        pays_from=math.floor(record_s / (usual_s - cpu_s)) + 1.0 if cpu_s < usual_s else math.inf,
    )


def _sines(record: Accelerogram, settings: AssessmentSettings) -> tuple[Pulse, ...]:
    """The best-ranked sines of a record; none where it has none."""
    try:
        ranked = extract_pulses(record, settings=settings.pulse).ranked
    except PulseError:
        return ()
    return tuple(each.pulse for each in ranked[:DEMAND_CANDIDATES])


def _worst(block: EquivalentBlock, sines: Sequence[Pulse]) -> float:
    return max(predict_maximum(block, pulse).rotation_ratio for pulse in sines)


def _rotation(structure: EquivalentBlock | Mechanism, record: Accelerogram, tolerance: float = 1e-6) -> float:
    return integrate(structure, record, tolerance).rotation_ratio


def _member_in_the_middle(mechanism: Mechanism, record: Accelerogram, settings: AssessmentSettings) -> float:
    """The median of the ensemble; inf where overturning is likelier than not."""
    members = ensemble(mechanism, GroundMotions.of(record), settings.ensemble)
    return math.inf if members.overturning_share > 0.5 else members.median


def _timed(run: Callable[[], T], repeats: int = 0) -> tuple[T, float]:
    """Return what `run` gives, and its processor time, s: of the first run, or the median of the repeats after it."""
    spent: list[float] = []
    for _ in range(1 + repeats):
        started = process_time()
        found = run()
        spent.append(process_time() - started)
    return found, median(spent[1:] or spent)


def _median(values: Sequence[float]) -> float:
    return median(values) if values else math.nan
