"""What the page to explore shows of one record, and the page of all of them."""

import math
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import detrend

from rocking.assessment.fate import Fate
from rocking.assessment.fragility.rows import FragilityRow
from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.verdict import NEGLIGIBLE
from rocking.motion.response import Response
from rocking.records import Accelerogram, displacement
from rocking.reports.explore.figures import fragility_curves, scatter
from rocking.reports.explore.packed import drawings, extremes, number, packed
from rocking.reports.explore.page import explore_page
from rocking.reports.style import svg
from rocking.structures import Mechanism, Structure
from rocking.tables import frame

Content = dict[str, Any]

_STILL = 0.01
"""Share of the largest rotation below which a history is cut."""
_BEFORE, _AFTER = 0.5, 1.0
"""s of rest that are kept before and after it."""
_FALLEN = 3.0
"""Rotation ratio beyond which a fall is not followed."""


def record_content(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tables: RecordTables,
    responses: Mapping[tuple[str, str], Response],
) -> Content:
    """Return what the page says of one record, and of each structure under its worse component, for JSON.

    responses: by component and structure, with their histories.
    """
    rows = _worse(tables.comparison, structures)
    verdicts = {fate.structure: fate for fate in tables.verdicts}
    used = {row.component for row in rows}
    cases = []
    for row in rows:
        case = _case(row, verdicts[row.structure])
        response = responses.get((row.component, row.structure))
        if row.integrated_rotation_ratio > NEGLIGIBLE and response is not None:
            case["history"] = _history(response, structures[row.structure].mechanism())
        cases.append(case)
    return {
        "id": record,
        "failure": " ".join(failure.message for failure in tables.failures),
        "motions": {
            each.component: _motion(each, tables) for each in accelerograms if each.component in used
        },
        "cases": cases,
    }


def study_page(contents: Sequence[Content], structures: Mapping[str, Structure], fragility: Path) -> bytes:
    """Return the page of a study. contents: of its records. fragility: its table of curves, where it was measured."""
    places = {name: place for place, name in enumerate(structures)}
    shown, cases = [], []
    for place, content in enumerate(contents):
        shown.append({name: value for name, value in content.items() if name != "cases"})
        for case in content["cases"]:
            cases.append({"record": place, **case, "structure": places[case["structure"]]})
    drawn = [
        {"name": name, "size": structure.size, "type": structure.type_name, "drawings": drawings(structure)}
        for name, structure in structures.items()
    ]
    return explore_page(shown, drawn, cases, {"scatter": _scatter(cases), "fragility": _fragility(fragility)})


def _worse(rows: Sequence[ComparisonRow], structures: Mapping[str, Structure]) -> list[ComparisonRow]:
    """Of each structure the row of the component that turns it farthest."""
    names = dict.fromkeys(row.structure for row in rows if row.structure in structures)
    return [max((row for row in rows if row.structure == name), key=_demand) for name in names]


def _demand(row: ComparisonRow) -> float:
    ratio = row.integrated_rotation_ratio
    return -1.0 if math.isnan(ratio) else ratio


def _case(row: ComparisonRow, fate: Fate) -> Content:
    case: Content = {
        "structure": row.structure,
        "component": row.component,
        "integrated": number(row.integrated_rotation_ratio),
        "found": number(row.integrated_rotation_ratio),
        "predicted": number(row.predicted_rotation_ratio),
        "verdict": str(fate.verdict),
    }
    if fate.members:
        case |= {
            "probability": number(fate.overturning_share),
            "members": fate.members,
            "low": number(fate.rotation_ratio_low),
            "high": number(fate.rotation_ratio_high),
        }
    return case


def _motion(accelerogram: Accelerogram, tables: RecordTables) -> Content:
    """Acceleration [m/s²] and its pulse, and the displacement [m] that moves the drawing, over the whole record."""
    times, acceleration = accelerogram.times, accelerogram.acceleration
    kept = partial(extremes, times, begin=0.0, end=accelerogram.duration)
    said: Content = {
        "duration": accelerogram.duration,
        "acceleration": packed(kept(acceleration)),
        "displacement": packed(kept(detrend(displacement(accelerogram)))),
    }
    ranked = [row for row in tables.pulses if row.component == accelerogram.component and row.ranked]
    if ranked:
        pulse = min(ranked, key=lambda row: row.rank).pulse
        inside = np.linspace(pulse.start_time, pulse.end_time, 61)
        span = [number(pulse.start_time), number(pulse.end_time)]
        said["pulse"] = {"span": span, "acceleration": packed(pulse.acceleration(inside))}
    return said


def _history(response: Response, mechanism: Mechanism) -> Content | None:
    """Rotation over critical rotation while it moves; None where there is none."""
    if response.times is None or response.rotation is None or response.times.size < 2:
        return None
    critical = np.where(
        response.rotation < 0, mechanism.sides[-1].critical_rotation, mechanism.sides[0].critical_rotation
    )
    times, ratio = response.times, np.clip(response.rotation / critical, -_FALLEN, _FALLEN)
    moving = np.flatnonzero(np.abs(ratio) > _STILL * np.abs(ratio).max())
    begin = max(float(times[0]), float(times[moving[0]]) - _BEFORE)
    end = min(float(times[-1]), float(times[moving[-1]]) + _AFTER)
    return {
        "span": [number(begin), number(end)],
        "ratio": packed(extremes(times, ratio, begin, end)),
        "critical": [
            number(mechanism.sides[0].critical_rotation),
            number(mechanism.sides[-1].critical_rotation),
        ],
    }


def _scatter(cases: Sequence[Content]) -> str:
    """The figure of every case that has both rotations and lifts; each of them learns its place among the points."""
    integrated: list[float] = []
    predicted: list[float] = []
    for case in cases:
        values = case["integrated"], case["predicted"]
        if None not in values and max(map(float, values)) > 0:
            case["point"] = len(integrated)
            integrated.append(float(values[0]))
            predicted.append(float(values[1]))
    return svg(scatter(integrated, predicted)) if integrated else ""


def _fragility(path: Path) -> str:
    """The figure of the fragility of this study, "" where it was not asked for."""
    if not path.exists():
        return ""
    curves = frame(FragilityRow, path)
    return svg(fragility_curves(curves)) if np.isinf(curves["rotation_ratio"]).any() else ""
