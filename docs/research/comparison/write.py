"""The comparison as a table."""

import math
import random
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from docs.research.comparison.cases import PULSES, RECORDS, SEED, CodeCase, pulse_cases, record_cases
from docs.research.comparison.codes import (
    ANOTHER_MODEL,
    LMGC90,
    ROCKING_BC,
    SLOWEST,
    Answer,
    Code,
    inner_codes,
    outer_codes,
)
from docs.research.comparison.report import comparison_report
from docs.research.comparison.rows import CodeRow
from docs.research.reference import reference_landings
from rocking.errors import MotionError
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.tables import write_tables, write_whole

REFERENCE = "scipy DOP853, 1e-12 (reference)"
REFERENCE_BUDGET = 120.0
"""Seconds of processor time that the reference may take for one case."""
SAMPLED = {
    LMGC90: {"block": 24, "frame": 24, "arch": 12},
    ROCKING_BC: {"block": 8, "frame": 1},
}
"""Cases of each structure that a slow code is run on, drawn with the seed of the cases from those that rock visibly."""
VISIBLE = (0.02, 0.95)
"""Rotation ratios between which a block is said to do so."""


def write_comparison(
    records: Sequence[Accelerogram], folder: Path, tell: Callable[[str], None], share: float = 1.0
) -> None:
    """Write codes.csv and its description and comparison.pdf into `folder`; tell: is given a line for each case.

    share: of the cases, in (0, 1], for a shorter run.
    """
    cases = [
        *pulse_cases(math.ceil(share * PULSES)),
        *record_cases(records, math.ceil(share * RECORDS)),
    ]
    slow = slow_cases(cases, share)

    def rows() -> Iterator[CodeRow]:
        for case in cases:
            found = list(code_rows(case, {**inner_codes(), **slow.get(case.name, {})}))
            tell(f"{case.name}: {len(found)} codes")
            yield from found

    write_tables({CodeRow: rows()}, folder, "rocking-comparison")
    write_whole(folder / "comparison.pdf", comparison_report(folder))


def code_rows(case: CodeCase, codes: Mapping[str, Code]) -> Iterator[CodeRow]:
    """Yield the rows of one case, the reference first; the reference alone where it has no answer in its time."""
    start = time.process_time()
    try:
        truth, landings = reference_landings(case.mechanism, case.motion, REFERENCE_BUDGET)
    except MotionError as error:
        yield _row(case, REFERENCE, Answer(math.nan, math.nan, reason=str(error)), math.nan, np.empty(0))
        return
    spent = time.process_time() - start
    forced = landings[landings[:, 0] <= case.motion.duration]
    fast = forced[forced[:, 1] > SLOWEST * _speed(case), 0]
    yield _row(case, REFERENCE, Answer(truth, spent, landings=fast), truth, fast)
    for name, code in codes.items():
        yield _row(case, name, code(case), truth, fast)


def missed(landings: np.ndarray, expected: np.ndarray, within: float) -> int:
    """Return how many of the instants `expected` (k,) have none of `landings` (n,) within a time [s]."""
    if not expected.size:
        return 0
    if not landings.size:
        return expected.size
    return int((np.abs(expected[:, None] - landings).min(axis=1) > within).sum())


def slow_cases(cases: Sequence[CodeCase], share: float = 1.0) -> Mapping[str, Mapping[str, Code]]:
    """Return by case the slow codes that take it, of each code that share of its sample."""
    rocking: dict[str, list[str]] = {}
    for case in cases:
        if VISIBLE[0] < integrate(case.mechanism, case.motion).rotation_ratio < VISIBLE[1]:
            rocking.setdefault(case.structure, []).append(case.name)
    chosen: dict[str, dict[str, Code]] = {}
    for name, code in outer_codes().items():
        for structure, most in SAMPLED[name].items():
            names = rocking.get(structure, [])
            for case_name in random.Random(SEED).sample(names, min(math.ceil(share * most), len(names))):
                chosen.setdefault(case_name, {})[name] = code
    return chosen


def _speed(case: CodeCase) -> float:
    side = case.mechanism.positive
    return side.frequency_parameter * side.critical_rotation


def _row(case: CodeCase, code: str, answer: Answer, truth: float, expected: np.ndarray) -> CodeRow:
    ratio, other = answer.rotation_ratio, (case.structure, code) in ANOTHER_MODEL
    known = not math.isnan(ratio) and not math.isnan(truth)
    agrees = _kind(ratio) == _kind(truth) if known else None
    rocks = agrees and 0 < truth < math.inf
    within = 0.02 / case.mechanism.positive.frequency_parameter
    found = None if other else answer.landings
    return CodeRow(
        case=case.name,
        structure=case.structure,
        motion=case.kind,
        code=code,
        another_model=other,
        rotation_ratio=ratio,
        rotation_ratio_error=answer.error_bar,
        reference_rotation_ratio=truth,
        error=math.nan if other else abs(ratio / truth - 1) if rocks else 0.0 if agrees else math.nan,
        verdict_agrees=agrees,
        duration_s=answer.duration,
        reference_impacts=expected.size,
        missed_impacts=None if found is None else missed(found, expected, within),
        reference_restitution=case.mechanism.positive.restitution,
        restitution=answer.restitution,
        restitution_error=answer.restitution_error,
        same_restitution_rotation_ratio=_with_restitution(case, answer.restitution),
        outside_hinges=answer.outside_hinges,
        reason=answer.reason,
    )


def _with_restitution(case: CodeCase, restitution: float) -> float:
    """Return φ_max/φ_cr of this package with another restitution; nan where that is none."""
    if not 0 <= restitution <= 1:
        return math.nan
    side = replace(case.mechanism.positive, restitution=restitution)
    return integrate(Mechanism(side), case.motion).rotation_ratio


def _kind(ratio: float) -> int:
    """0 at rest, 1 rocking, 2 overturned; a rotation beyond 1.5 critical ones at the end of a run has overturned."""
    return 0 if ratio == 0 else 2 if ratio > 1.5 else 1
