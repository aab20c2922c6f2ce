"""The comparison of codes as a table and a report: work against precision.

Last run, 16 minutes of CPU on a shared machine. Errors at the 95 % quantile (medians stand on the page on validation):

    rocking, tolerance 1e-6 (1e-9)   block 4e-9 (2e-12), frame 3e-10 (2e-13), arch 2e-10 (2e-12)
    scipy RK45, DOP853 at 1e-6       block 4e-4, 5e-5, frame 3e-4, 6e-5, arch 7e-4, 9e-5
    LMGC90, extrapolated             block 22 %, frame 7 %
    RockingBC, extrapolated          one of eight blocks threefold

The restitution η at an impact, measured on still ground from two successive excursions: reference, median (range); the
largest rotation over that of the reference, and over ours with the η measured; cases whose error bar holds the former:

    LMGC90, block      0.942, 0.945 (0.936 to 0.969); 1.01 (0.21 to 1.22), 1.00 (0.23 to 1.19); 18 of 24
    RockingBC, block   0.942, 0.965 (0.962 to 0.965); 1.07 (1.03 to 3.02), 1.00 (0.99 to 2.65); 3 of 8
    LMGC90, frame      0.971, 0.974 (0.963 to 0.990); 1.00 (0.83 to 1.07), 1.00 (0.83 to 1.07); 17 of 24
    LMGC90, arch       0.9 given, 0.948 (0.920 to 1.000); 1.08 (0.24 to 1.26), 0.99 (0.40 to 1.15); another model

Of the arch a median of 17 % of the joint rotation is elsewhere than at our hinges at the largest rotation. With the η
that LMGC90 shows, ours is within 7 % in five of the eight cases where both have a number, and overturns in two where
LMGC90 does not.
"""

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby, islice
from operator import itemgetter

import numpy as np
import pandas as pd

from docs.research import reference, scores
from docs.research.comparison import codes
from docs.research.report import Tables, Target
from docs.research.sites import timed
from rocking import Mechanism, integrate
from rocking.assessment.cracks import cracks
from rocking.tables import Row, column, row

REFERENCE = "scipy DOP853, 1e-12 (reference)"
SAMPLED = {codes.LMGC90: {"block": 24, "frame": 24, "arch": 12}, codes.ROCKING_BC: {"block": 8}}
"""Cases of each structure that a slow code is run on, drawn with the seed of the cases from those that rock visibly."""
VISIBLE = (0.02, 0.95)
"""Rotation ratios between which a block is said to do so."""
COMPARED = (
    "Errors are those of the largest rotation where both rock. An impact of the reference under moving ground, faster "
    "than p φ_cr/1000, is missed where the code has none within 0.02/p. LMGC90 follows rigid bodies with inelastic "
    "shocks and dry friction; its arch is another model: hinges open where they like, so a difference is no error of "
    "either. RockingBC is deformable and loses by damping. Each is run at three settings, halved each time, and "
    "extrapolated, on a sample of the cases that rock, drawn with a stated seed. Intervals are by resampling cases."
)


@row("codes", "One row per case and code: error against scipy's DOP853 at 1e-12, and processor time")
class CodeRow(Row):
    """One code on one case."""

    case: str = column("Name of the case: structure, kind of motion and number")
    structure: str = column("block, frame or arch")
    motion: str = column("pulse or record")
    code: str = column("Code and setting")
    another_model: bool = column("Whether the code solves another motion, so that a difference is no error")
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")
    rotation_ratio_error: float = column("Half width of the error bar of the code's own extrapolation")
    reference_rotation_ratio: float = column("By DOP853 at 1e-12, restarted at each sample and impact")
    error: float = column("Relative error where both rock; 0 where neither does; empty for another model")
    verdict_agrees: bool | None = column("Whether it rocks, overturns or stays as the reference says")
    duration_s: float = column("Processor time of one response")
    reference_impacts: int = column("Impacts of the reference under moving ground, faster than p φ_cr/1000")
    missed_impacts: int | None = column("Those without an impact of the code within 0.02/p; empty: untold")
    reference_restitution: float = column("Restitution of the reference")
    restitution: float = column("Of a reversal on still ground: root of the ratio of energies of excursions")
    restitution_error: float = column("Half width of its error bar")
    same_restitution_rotation_ratio: float = column("Rotation ratio by this package with that restitution")
    envelope_rotation_ratio: float = column("Of another model: largest of ours over the cracks that may form")
    outside_hinges: float = column("Share of all joint rotation outside the hinges of the mechanism")
    reason: str = column("Why there is no number")


def compare(target: Target) -> None:
    """Run every code through the pulses and stretches of the first records."""
    of_each = groupby(target.records, key=itemgetter(0))
    first = [next(components)[1] for _, components in islice(of_each, codes.RECORDS // 3)]
    cases = [*codes.pulse_cases(), *codes.record_cases(first)]
    slow = slow_cases(cases)
    rows: list[CodeRow] = []
    for case in cases:
        rows += code_rows(case, {**codes.inner_codes(), **slow.get(case.name, {})})
        target.tell(case.name)
    pulses = sum(case.kind == "pulse" for case in cases)
    subtitle = (
        f"{pulses} pulses and {len(cases) - pulses} stretches of records on a block, a frame and an arch of seven "
        "voussoirs; the reference is DOP853 of scipy at 1e-12, restarted at every sample and impact."
    )
    tables: Tables = {CodeRow: rows, scores.Score: list(code_scores(rows))}
    target.publish("Work against precision", subtitle, tables, COMPARED)


def code_rows(case: codes.CodeCase, others: Mapping[str, codes.Code]) -> Iterator[CodeRow]:
    """Yield the rows of one case, the reference first."""
    (truth, landings), spent = timed(lambda: reference.landings(case.mechanism, case.motion))
    side = case.mechanism.positive
    forced = landings[landings[:, 0] <= case.motion.duration]
    fast = forced[forced[:, 1] > codes.SLOWEST * side.frequency_parameter * side.critical_rotation, 0]
    yield _row(case, REFERENCE, codes.Answer(truth, spent, landings=fast), truth, fast)
    for name, code in others.items():
        yield _row(case, name, code(case), truth, fast)


def missed(landings: np.ndarray, expected: np.ndarray, within: float) -> int:
    """Return how many of the instants `expected` (k,) have none of `landings` (n,) within a time [s]."""
    if not expected.size or not landings.size:
        return expected.size
    return int((np.abs(expected[:, None] - landings).min(axis=1) > within).sum())


def slow_cases(cases: Sequence[codes.CodeCase]) -> Mapping[str, Mapping[str, codes.Code]]:
    """Return by case the slow codes that take it, of each code its sample."""
    visible = [
        case
        for case in cases
        if VISIBLE[0] < integrate(case.mechanism, case.motion).rotation_ratio < VISIBLE[1]
    ]
    chosen: dict[str, dict[str, codes.Code]] = {}
    for name, code in codes.outer_codes().items():
        for structure, most in SAMPLED[name].items():
            names = [case.name for case in visible if case.structure == structure]
            for case_name in random.Random(codes.SEED).sample(names, min(most, len(names))):
                chosen.setdefault(case_name, {})[name] = code
    return chosen


def _row(
    case: codes.CodeCase, code: str, answer: codes.Answer, truth: float, expected: np.ndarray
) -> CodeRow:
    ratio, side = answer.rotation_ratio, case.mechanism.positive
    # 0 at rest, 1 rocking, 2 overturned; a rotation beyond 1.5 critical ones at the end of a run has overturned.
    kind, true_kind = ((value > 0) + (value > 1.5) for value in (ratio, truth))
    agrees = None if math.isnan(ratio) else kind == true_kind
    error = abs(ratio / truth - 1) if agrees and 0 < truth < math.inf else 0.0 if agrees else math.nan
    another_model = (case.structure, code) in codes.ANOTHER_MODEL
    same_restitution = math.nan
    if 0 <= answer.restitution <= 1:
        same = Mechanism(replace(side, restitution=answer.restitution))
        same_restitution = integrate(same, case.motion).rotation_ratio
    envelope = math.nan
    missed_impacts = None
    if another_model:
        mechanisms = [crack.mechanism for crack in cracks(codes.structures()[case.structure])]
        envelope = max(integrate(mechanism, case.motion).rotation_ratio for mechanism in mechanisms)
        error = math.nan
    elif answer.landings is not None:
        missed_impacts = missed(answer.landings, expected, 0.02 / side.frequency_parameter)
    return CodeRow(
        case=case.name,
        structure=case.structure,
        motion=case.kind,
        code=code,
        another_model=another_model,
        rotation_ratio=ratio,
        rotation_ratio_error=answer.rotation_ratio_error,
        reference_rotation_ratio=truth,
        error=error,
        verdict_agrees=agrees,
        duration_s=answer.duration,
        reference_impacts=expected.size,
        missed_impacts=missed_impacts,
        reference_restitution=side.restitution,
        restitution=answer.restitution,
        restitution_error=answer.restitution_error,
        same_restitution_rotation_ratio=same_restitution,
        envelope_rotation_ratio=envelope,
        outside_hinges=answer.outside_hinges,
        reason=answer.reason,
    )


def code_scores(rows: Sequence[CodeRow]) -> Iterator[scores.Score]:
    """Yield error and work of every code on every structure, with intervals by case."""
    table = pd.DataFrame(rows).astype({"missed_impacts": float})
    moves = table.reference_rotation_ratio.between(0, math.inf, inclusive="neither")
    table["rocks"] = table.error.notna() & moves  # there is an error to speak of
    for (structure, code), own in table.groupby(["structure", "code"]):
        cases = own.case.tolist()
        yield from scores.scored(code, structure, _measures(own), cases)
        if code in SAMPLED:
            part = f"{structure}, what the other codes lose and give"
            yield from scores.scored(code, part, _losses(own), cases)


def _measures(own: pd.DataFrame) -> Mapping[str, scores.Measured]:
    """Errors where both rock; verdicts and impacts of all."""
    errors = own.error.where(own.rocks)
    impacts = own.reference_impacts.where(own.missed_impacts.notna(), 0)
    return {
        "median error": scores.median(errors),
        "95 % error": scores.median(errors, 0.95),
        "share that rocks": own.rocks,
        "share of other verdicts": own.verdict_agrees.eq(False),
        "share without an answer": own.rotation_ratio.isna(),
        "share of impacts missed": scores.share_of(own.missed_impacts.fillna(0), impacts),
        "processor time of a response, s": scores.median(own.duration_s),
    }


def _losses(own: pd.DataFrame) -> Mapping[str, scores.Measured]:
    """What a code keeps at an impact, and how many times its rotation is that of the reference, and ours with its η."""
    barred = own.rotation_ratio_error.notna() & ~own.another_model
    apart = (own.rotation_ratio - own.reference_rotation_ratio).abs()
    envelope = own.envelope_rotation_ratio
    return {
        "restitution of the reference": scores.median(own.reference_restitution),
        "restitution of the code": scores.median(own.restitution),
        "rotation over the reference's": scores.median(_over(own, own.reference_rotation_ratio)),
        "rotation over ours, same restitution": scores.median(
            _over(own, own.same_restitution_rotation_ratio)
        ),
        "rotation over the largest of ours over all cracks": scores.median(own.rotation_ratio / envelope),
        "share with a larger one of ours over all cracks": (envelope >= own.rotation_ratio).where(
            own.another_model
        ),
        "share with the reference within the bar": (apart <= own.rotation_ratio_error).where(barred),
    }


def _over(own: pd.DataFrame, expected: pd.Series) -> pd.Series:
    """How many times the rotation is as large, where both rock."""
    both = np.isfinite(own.rotation_ratio) & expected.between(0, math.inf, inclusive="neither")
    return (own.rotation_ratio / expected).where(both)
