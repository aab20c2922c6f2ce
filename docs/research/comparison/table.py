"""The comparison of codes as a table and a report: work against precision."""

import math
import random
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from matplotlib.figure import Figure

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
from docs.research.reference import reference_landings
from rocking.errors import MotionError
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.printing import number
from rocking.reports.style import new_figure, picture, shared_legend, styled
from rocking.structures import Mechanism
from rocking.tables import Row, column, row, write_tables, write_whole

REFERENCE = "scipy DOP853, 1e-12 (reference)"
REFERENCE_BUDGET = 120.0
"""Seconds of processor time that the reference may take for one case."""
SAMPLED = {LMGC90: {"block": 24, "frame": 24, "arch": 12}, ROCKING_BC: {"block": 8}}
"""Cases of each structure that a slow code is run on, drawn with the seed of the cases from those that rock visibly."""
VISIBLE = (0.02, 0.95)
"""Rotation ratios between which a block is said to do so."""
SMALLEST_ERROR = 1e-15
"""Smaller errors, down to none, are drawn here."""


@row(
    "codes",
    "One row per case and code: error against scipy's DOP853 at 1e-12, and work; times differ between runs",
)
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
    reference_impacts: int = column(
        "Impacts of the reference while the ground moves, faster than p φ_cr/1000"
    )
    missed_impacts: int | None = column("Those without an impact of the code within 0.02/p; empty: untold")
    reference_restitution: float = column("Restitution of the reference")
    restitution: float = column("Of a reversal on still ground: root of the ratio of energies of excursions")
    restitution_error: float = column("Half width of its error bar")
    same_restitution_rotation_ratio: float = column("Rotation ratio by this package with that restitution")
    outside_hinges: float = column("Share of all joint rotation outside the hinges of the mechanism")
    reason: str = column("Why there is no number")

    @property
    def rocks(self) -> bool:
        """Whether there is an error to speak of: both rock."""
        return not math.isnan(self.error) and 0 < self.reference_rotation_ratio < math.inf


def write_comparison(
    records: Sequence[Accelerogram], folder: Path, tell: Callable[[str], None], share: float = 1.0
) -> None:
    """Write codes.csv, its description and comparison.pdf into `folder`; tell: is given a line for each case.

    share: of the cases, in (0, 1], for a shorter run.
    """
    cases = [
        *pulse_cases(math.ceil(share * PULSES)),
        *record_cases(records, math.ceil(share * RECORDS)),
    ]
    slow, rows = slow_cases(cases, share), []
    for case in cases:
        rows += code_rows(case, {**inner_codes(), **slow.get(case.name, {})})
        tell(case.name)
    write_tables({CodeRow: rows}, folder, "rocking-comparison")
    write_whole(folder / "comparison.pdf", compile_document("plain.typ", report_data(rows)))


def code_rows(case: CodeCase, codes: Mapping[str, Code]) -> Iterator[CodeRow]:
    """Yield the rows of one case, the reference first; the reference alone where it has no answer in its time."""
    start = time.process_time()
    try:
        truth, landings = reference_landings(case.mechanism, case.motion, REFERENCE_BUDGET)
    except MotionError as error:
        yield _row(case, REFERENCE, Answer(math.nan, math.nan, reason=str(error)), math.nan, np.empty(0))
        return
    spent, side = time.process_time() - start, case.mechanism.positive
    forced = landings[landings[:, 0] <= case.motion.duration]
    fast = forced[forced[:, 1] > SLOWEST * side.frequency_parameter * side.critical_rotation, 0]
    yield _row(case, REFERENCE, Answer(truth, spent, landings=fast), truth, fast)
    for name, code in codes.items():
        yield _row(case, name, code(case), truth, fast)


def missed(landings: np.ndarray, expected: np.ndarray, within: float) -> int:
    """Return how many of the instants `expected` (k,) have none of `landings` (n,) within a time [s]."""
    if not expected.size or not landings.size:
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


def _row(case: CodeCase, code: str, answer: Answer, truth: float, expected: np.ndarray) -> CodeRow:
    ratio, other, side = (
        answer.rotation_ratio,
        (case.structure, code) in ANOTHER_MODEL,
        case.mechanism.positive,
    )
    agrees = None if math.isnan(ratio) or math.isnan(truth) else _kind(ratio) == _kind(truth)
    error = abs(ratio / truth - 1) if agrees and 0 < truth < math.inf else 0.0 if agrees else math.nan
    landings = None if other else answer.landings
    same = math.nan
    if 0 <= answer.restitution <= 1:
        same = integrate(Mechanism(replace(side, restitution=answer.restitution)), case.motion).rotation_ratio
    return CodeRow(
        case=case.name,
        structure=case.structure,
        motion=case.kind,
        code=code,
        another_model=other,
        rotation_ratio=ratio,
        rotation_ratio_error=answer.error_bar,
        reference_rotation_ratio=truth,
        error=math.nan if other else error,
        verdict_agrees=agrees,
        duration_s=answer.duration,
        reference_impacts=expected.size,
        missed_impacts=None
        if landings is None
        else missed(landings, expected, 0.02 / side.frequency_parameter),
        reference_restitution=side.restitution,
        restitution=answer.restitution,
        restitution_error=answer.restitution_error,
        same_restitution_rotation_ratio=same,
        outside_hinges=answer.outside_hinges,
        reason=answer.reason,
    )


def _kind(ratio: float) -> int:
    """0 at rest, 1 rocking, 2 overturned; a rotation beyond 1.5 critical ones at the end of a run has overturned."""
    return 0 if ratio == 0 else 2 if ratio > 1.5 else 1


def report_data(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return what the template is given."""
    cases = {row.case: row for row in rows}
    pulses = sum(row.motion == "pulse" for row in cases.values())
    groups: dict[tuple[str, str], list[CodeRow]] = {}
    for each in sorted(rows, key=lambda row: row.structure):
        groups.setdefault((each.structure, each.code), []).append(each)
    losses = [own for own in groups.values() if own[0].code in SAMPLED]
    shown = picture(work_figure(rows), "Median error against median processor time of every code.")
    return {
        "title": "Work against precision: the same cases through every code",
        "subtitle": f"{pulses} pulses and {len(cases) - pulses} stretches of records on a block, a frame and an arch "
        "of seven voussoirs; the reference is DOP853 of scipy at 1e-12, restarted at every sample and impact.",
        "parts": [
            {
                **shown,
                "caption": "Small marks: cases; large ones: medians of a code. No error is drawn at 1e-15.",
            },
            {**_work(groups.values()), "caption": _WORK},
            {"heading": "The other codes", "text": _OTHERS},
            {**_losses(losses), "caption": _LOSSES},
        ],
    }


_WORK = (
    "Errors of the largest rotation where both rock. Impacts missed: of those of the reference under moving ground, "
    "faster than p φ_cr/1000, how many have none of the code within 0.02/p."
)
_LOSSES = "What the other codes lose and give: median (least to largest); each case stands in codes.csv."
_OTHERS = (
    "LMGC90 follows rigid bodies with inelastic shocks and dry friction; its arch is another model: hinges open where "
    "they like, so a difference is no error of either. RockingBC is deformable and loses by damping. Each is run at "
    "three settings, halved each time, and extrapolated, on a sample of the cases that rock, drawn with a stated seed."
)


def _work(groups: Iterable[Sequence[CodeRow]]) -> dict[str, Any]:
    def error(share: float) -> Callable[[Sequence[CodeRow]], str]:
        return lambda own: _quantile([row.error for row in own if row.rocks], share)

    def impacts(own: Sequence[CodeRow]) -> str:
        told = [row for row in own if row.missed_impacts is not None]
        return printing.of(
            sum(row.missed_impacts or 0 for row in told), sum(r.reference_impacts for r in told)
        )

    return printing.table_of(
        groups,
        ("Structure", "0.6", "l", lambda own: own[0].structure),
        ("Code", "2", "l", lambda own: own[0].code),
        ("Cases", "0.45", "r", lambda own: printing.whole(len(own))),
        ("Rock", "0.4", "r", lambda own: printing.whole(sum(row.rocks for row in own))),
        ("Median error", "0.8", "r", error(0.5)),
        ("95 % error", "0.8", "r", error(0.95)),
        (
            "Other verdict",
            "0.7",
            "r",
            lambda own: printing.whole(sum(r.verdict_agrees is False for r in own)),
        ),
        ("No answer", "0.6", "r", lambda own: printing.whole(sum(math.isnan(r.rotation_ratio) for r in own))),
        ("Impacts missed", "0.9", "r", impacts),
        ("Time (ms)", "0.7", "r", lambda own: _quantile([1e3 * row.duration_s for row in own], 0.5)),
    )


def _losses(groups: Iterable[Sequence[CodeRow]]) -> dict[str, Any]:
    def over(expected: str) -> Callable[[Sequence[CodeRow]], str]:
        return lambda own: _range(_over(row, getattr(row, expected)) for row in own)

    def within_bar(own: Sequence[CodeRow]) -> str:
        barred = [row for row in own if not math.isnan(row.rotation_ratio_error) and not row.another_model]
        held = [abs(r.rotation_ratio - r.reference_rotation_ratio) <= r.rotation_ratio_error for r in barred]
        return printing.of(sum(held), len(held))

    return printing.table_of(
        groups,
        ("Structure", "0.8", "l", lambda own: own[0].structure),
        ("Code", "1.4", "l", lambda own: own[0].code),
        ("Cases", "0.5", "r", lambda own: printing.whole(len(own))),
        ("η of the reference", "0.8", "r", lambda own: number(own[0].reference_restitution)),
        ("η of the code", "1.4", "r", lambda own: _range(row.restitution for row in own)),
        ("φ over the reference's", "1.5", "r", over("reference_rotation_ratio")),
        ("φ over ours, same η", "1.5", "r", over("same_restitution_rotation_ratio")),
        ("Reference within bar", "0.7", "r", within_bar),
    )


def _quantile(values: Sequence[float], share: float) -> str:
    ranked = sorted(value for value in values if not math.isnan(value))
    return number(ranked[min(int(share * len(ranked)), len(ranked) - 1)], 2) if ranked else printing.NOTHING


def _over(row: CodeRow, expected: float) -> float:
    """Return how many times the rotation is as large, where both rock."""
    both = math.isfinite(row.rotation_ratio) and 0 < expected < math.inf
    return row.rotation_ratio / expected if both else math.nan


def _range(values: Iterable[float]) -> str:
    """Return the median, and in brackets the least and the largest."""
    told = [value for value in values if not math.isnan(value)]
    return (
        f"{number(median(told))} ({number(min(told))} to {number(max(told))})" if told else printing.NOTHING
    )


@styled
def work_figure(rows: Sequence[CodeRow]) -> Figure:
    """Draw error against processor time: small marks are cases, large ones the medians of a code and structure."""
    figure = new_figure(112, margins=(17, 4, 29, 6))
    panels = figure.subplots(1, 3, sharex=True, sharey=True, gridspec_kw={"wspace": 0.06})
    names = [name for name in dict.fromkeys(row.code for row in rows) if name != REFERENCE]
    for panel, structure in zip(panels, ("block", "frame", "arch"), strict=True):
        for k, name in enumerate(names):
            own = [row for row in rows if (row.structure, row.code) == (structure, name) and row.rocks]
            if own:
                times, errors = [r.duration_s for r in own], [max(r.error, SMALLEST_ERROR) for r in own]
                look = {"color": f"C{k % 10}", "marker": "osD^vPXH"[k % 8], "linestyle": "none"}
                panel.plot(times, errors, markersize=1.8, alpha=0.35, **look)
                panel.plot(median(times), median(errors), markersize=6.5, label=name, **look)
        panel.set(xscale="log", yscale="log", title=structure, xlabel="processor time of a response (s)")
        panel.grid(True)
    panels[0].set_ylabel("relative error of the largest rotation")
    shared_legend(figure, names, ncols=3)
    return figure
