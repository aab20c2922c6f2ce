"""The trade: what accuracy costs on a user's own records and structures: method by error by processor time."""

import math
import platform
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time
from typing import TypeVar

from rocking.assessment.ensemble import ensemble
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.earthquakes.sample import ClusterSample, interval_words
from rocking.errors import PulseError, RockingError
from rocking.motion import integrate
from rocking.motion.response import Response
from rocking.products.trade.rows import TimedAnswer, TradeMethod, TradeRow, trade_row
from rocking.pulses import DEMAND_CANDIDATES, PulseEvidence, extract_pulses
from rocking.pulses.pulse import DOMINATES
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_as_printed, predict_maximum
from rocking.structures import EquivalentBlock, Mechanism, Structure

TOLERANCES = {TradeMethod.MECHANISM: 1e-6, TradeMethod.COARSE: 1e-3}
REFERENCE_TOLERANCE = 1e-12
REPEATS = 3
"""Timed runs of each response, after one that is not; an ensemble is run once."""

_BY_SINES = (TradeMethod.PRINTED, TradeMethod.ONE_SINE, TradeMethod.SINES)
"""The methods that a search for the sines of a record comes before."""

T = TypeVar("T")


def trade(
    records: Iterable[Accelerogram],
    structures: Mapping[str, Structure],
    *,
    settings: AssessmentSettings | None = None,
    tell: Callable[[str], None] = lambda _line: None,
) -> list[TradeRow]:
    """Return a row for each method and structure, and one for each method over all structures.

    Every structure is met by every record with every method, one response at a time.

    Times are processor times of this machine, in s.

    Parameters
    ----------
    records : iterable of Accelerogram
        Horizontal components, each by itself.
    structures : mapping of str to Structure
        Structures by name.
    settings : AssessmentSettings or None, optional
        Settings of the assessment; None: the default.
    tell : callable, optional
        Takes a line for each record, and one for each case that cannot be followed.

    Returns
    -------
    list of TradeRow
        A row for each method and structure, and one for each method over all structures.

    Examples
    --------
    >>> pier = rocking.Block.of_size(0.8, 6.0, 0.9)
    >>> rows = rocking.trade(rocking.read("records/synthetic_strong_pulse.AT2"), {"pier": pier})
    >>> [str(row.method) for row in rows if row.structure == "pier" and row.wrong_verdicts]
    ['Eq. 15 as printed', 'one sine', 'one sine, half the energy', 'five sines']
    """
    cases = [TradeCase(structure=name, mechanism=body.mechanism()) for name, body in structures.items()]
    tried: list[Accelerogram] = []

    def met() -> Iterator[tuple[GroundMotions, list[TradeCase]]]:
        for record in records:
            tried.append(record)
            yield GroundMotions.of(record), cases

    return trade_of_cases(met(), lambda: ClusterSample.of(tried), structures, settings=settings, tell=tell)


@dataclass(frozen=True, eq=False, kw_only=True)
class TradeCase:
    """A structure that meets a motion. mechanism: with the crack that governs.

    reference: the rotation ratio that methods are held against, with the time of the fall, s; nan where it is still to
    be computed, at a tolerance of 1e-12. found: the rotation ratios that a study has found by method, which count
    instead of those computed here. is_late: whether the pulse behind these begins after the fall.
    """

    structure: str
    mechanism: Mechanism
    reference: float = math.nan
    fall_time: float = math.nan
    found: Mapping[TradeMethod, float] = field(default_factory=dict)
    is_late: bool = False

    def held_against(self, motions: GroundMotions) -> "TradeCase":
        """Return it with its reference."""
        if not math.isnan(self.reference):
            return self
        response = _followed(self.mechanism, motions, REFERENCE_TOLERANCE, history=True)
        return replace(self, reference=response.rotation_ratio, fall_time=response.fall_time)


def trade_of_cases(
    met: Iterable[tuple[GroundMotions, Sequence[TradeCase]]],
    sample: Callable[[], ClusterSample],
    structures: Iterable[str],
    *,
    settings: AssessmentSettings | None = None,
    tell: Callable[[str], None] = lambda _line: None,
    within: Callable[[str], AbstractContextManager[None]] = lambda _structure: nullcontext(),
) -> list[TradeRow]:
    """Return the rows of `trade` for the cases that are met under motions of one component.

    sample: of these motions, once all were met. structures: names, in the order of their rows. within: gives what
    surrounds the work on a structure, by its name, or on a record (an empty text), and may keep errors from the rest.
    """
    chosen = settings or AssessmentSettings()
    answers: dict[tuple[TradeMethod, str], list[TimedAnswer]] = {}
    for number, (motions, cases) in enumerate(met, start=1):
        sines: tuple[PulseEvidence, ...] | None = None
        with within(""):
            (record,) = motions.horizontal.values()
            sines, searched_s = _timed(partial(best_sines, record, chosen))
        if sines is None:
            continue
        for case in cases:
            name = case.structure
            try:
                with within(name):
                    for method, answer in list(_answers(case, motions, sines, searched_s, chosen)):
                        for whose in ("", name):
                            answers.setdefault((method, whose), []).append(replace(answer, record=number - 1))
            except RockingError as error:
                tell(f"record {number}, {name}: {error}")
        tell(f"record {number}: {len(cases)} structures")
    machine = machine_in_words()
    of_motions = sample()
    return [
        trade_row(
            method,
            structure,
            answers[method, structure],
            answers.get((TradeMethod.MECHANISM, structure), []),
            machine,
            of_motions,
        )
        for structure in ("", *structures)
        for method in TradeMethod
        if (method, structure) in answers
    ]


def _answers(
    case: TradeCase,
    motions: GroundMotions,
    sines: Sequence[PulseEvidence],
    searched_s: float,
    settings: AssessmentSettings,
) -> Iterator[tuple[TradeMethod, TimedAnswer]]:
    """Yield the answer of each method to one case. searched_s: processor time of the search for the sines."""
    case = case.held_against(motions)
    begins_late = bool(sines) and sines[0].pulse.start_time > case.fall_time
    for method, run in _runs(case, motions, sines, settings).items():
        rotation_ratio, cpu_s = _timed(run, 0 if method is TradeMethod.ENSEMBLE else REPEATS)
        by_first = method in (TradeMethod.PRINTED, TradeMethod.ONE_SINE)
        rotation_ratio = case.found.get(method, rotation_ratio)
        if math.isnan(rotation_ratio):
            continue
        answer = TimedAnswer(
            rotation_ratio=rotation_ratio,
            reference=case.reference,
            cpu=cpu_s,
            preparation=searched_s if method in _BY_SINES else 0.0,
            is_late=by_first and (case.is_late if method in case.found else begins_late),
        )
        yield method, answer
        if method is TradeMethod.ONE_SINE and sines[0].explained_energy >= DOMINATES:
            yield TradeMethod.DOMINANT_SINE, answer


def _runs(
    case: TradeCase, motions: GroundMotions, sines: Sequence[PulseEvidence], settings: AssessmentSettings
) -> dict[TradeMethod, Callable[[], float]]:
    """The computation of the largest rotation by each method; no closed form for a record without pulses.

    Of five sines those count that begin before the fall.
    """
    mechanism = case.mechanism
    block = mechanism.equivalent_block("exact_at_rest")

    def worst(some: Sequence[PulseEvidence]) -> float:
        return max((predict_maximum(block, one.pulse).rotation_ratio for one in some), default=0.0)

    def rotation(structure: EquivalentBlock | Mechanism, tolerance: float) -> float:
        return _followed(structure, motions, tolerance).rotation_ratio

    def middle() -> float:
        members = ensemble(mechanism, motions, settings.ensemble)
        return math.inf if members.overturning_share > 0.5 else members.rotation_ratio_median

    def as_printed() -> float:
        printed = predict_as_printed(mechanism, sines[0].pulse)
        return math.nan if printed is None else printed.rotation_ratio

    in_time = [one for one in sines if not one.pulse.start_time > case.fall_time]
    by_sines = {TradeMethod.ONE_SINE: sines[:1], TradeMethod.SINES: in_time} if sines else {}
    return {
        **({TradeMethod.PRINTED: as_printed} if sines else {}),
        **{method: partial(worst, some) for method, some in by_sines.items()},
        TradeMethod.BLOCK: partial(rotation, block, 1e-6),
        **{method: partial(rotation, mechanism, tolerance) for method, tolerance in TOLERANCES.items()},
        TradeMethod.ENSEMBLE: middle,
    }


def _followed(
    structure: EquivalentBlock | Mechanism, motions: GroundMotions, tolerance: float, *, history: bool = False
) -> Response:
    """The response to one component, and to the vertical one where that acts."""
    (record,) = motions.horizontal.values()
    return integrate(structure, record, tolerance, vertical=motions.vertical, history=history)


def best_sines(record: Accelerogram, settings: AssessmentSettings) -> tuple[PulseEvidence, ...]:
    """Return the best-ranked sines of a record; none where it has none.

    What the first one leaves is not searched: no prediction asks for it.
    """
    try:
        ranked = extract_pulses(record, settings=replace(settings.pulse, pursuit=1)).ranked
    except PulseError:
        return ()
    return tuple(ranked[:DEMAND_CANDIDATES])


def _timed(run: Callable[[], T], repeats: int = 0) -> tuple[T, float]:
    """Return what `run` gives, and its processor time, s: of the first run, or the median of the repeats after it."""
    spent: list[float] = []
    for _ in range(1 + repeats):
        started = process_time()
        answer = run()
        spent.append(process_time() - started)
    return answer, median(spent[1:] or spent)


def what_follows(rows: Iterable[TradeRow]) -> Iterator[str]:
    """Yield, in a sentence each, what the rows over all structures say of the closed form against the integration."""
    of_all = {row.method: row for row in rows if row.structure == ""}
    sine = of_all.get(TradeMethod.ONE_SINE)
    mechanism = of_all.get(TradeMethod.MECHANISM)
    if sine is None or mechanism is None:
        return
    upto = f"below {sine.break_even_in_words}" if sine.break_even < math.inf else "for any number"
    yield (
        f"One sine takes {1e3 * sine.cpu_s:.2g} ms per structure, and {1e3 * sine.preparation_record_s:.2g} ms per "
        f"record for its search, the mechanism on the record {1e3 * mechanism.cpu_s:.2g} ms: {upto} the closed form is "
        f"the slower method, and never the more accurate one: {_in_words(sine)}."
    )
    others = [
        f"{name}: {_in_words(of_all[method])}"
        for method, name in _BESIDE.items()
        if method in of_all and of_all[method].cases
    ]
    if others:
        yield f"{'; '.join(others)}.".capitalize()
    yield (
        "Use it without a record (design curves, spectra of pulses), for many structures under one motion, and where "
        "the sine explains most of the energy."
    )
    if coarse := of_all.get(TradeMethod.COARSE):
        yield (
            f"Loosening the tolerance saves little: at 1e-3 the integration takes {1e3 * coarse.cpu_s:.2g} ms, with "
            f"{_in_words(coarse)}."
        )


_BESIDE = {
    TradeMethod.DOMINANT_SINE: "where one sine dominates",
    TradeMethod.BLOCK: "the block on the record",
}


def _in_words(row: TradeRow) -> str:
    """How often a method is wrong, and by how much."""
    unsafe = f", {row.unsafe_verdicts} of them unsafe" if row.wrong_verdicts else ""
    error = f", median error {100 * row.error:.2g} %" if row.error >= 0 else ""
    bounds = ""
    if row.earthquakes > 1:
        share = f"{100 * row.wrong_share_low:.0f}–{100 * row.wrong_share_high:.0f} %"
        bounds = f" ({interval_words(row.earthquakes)}: {share} of such cases)"
    return f"{row.wrong_verdicts} of {row.cases} verdicts wrong{bounds}{unsafe}{error}"


def machine_in_words() -> str:
    """Return the name of the processor of this machine, and its system."""
    info = Path("/proc/cpuinfo")
    named = re.search(r"model name\s*: (.+)", info.read_text()) if info.is_file() else None
    name = named[1] if named else platform.processor() or platform.machine()
    return f"{' '.join(name.split())}, {platform.system()}"
