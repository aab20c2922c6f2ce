"""The page to explore a study, from its tables, its records and its structures."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import detrend

from rocking.assessment.fate import Fate
from rocking.assessment.fragility.rows import FragilityRow
from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.verdict import NEGLIGIBLE
from rocking.errors import RockingError
from rocking.motion.integration import integrate
from rocking.records import Accelerogram, displacement
from rocking.records.catalogue import CatalogueRecord
from rocking.records.rotation import aligned
from rocking.reports.explore.figures import fragility_curves, scatter
from rocking.reports.explore.packed import drawings, extremes, number, packed
from rocking.reports.explore.page import explore_page
from rocking.reports.style import svg
from rocking.structures import Structure
from rocking.study.parts import read_part
from rocking.study.run import Opened, Study
from rocking.tables import frame, write_whole

Content = dict[str, Any]

_STILL = 0.01
"""Share of the largest rotation below which a history is cut."""
_BEFORE, _AFTER = 0.5, 1.0
"""s of rest that are kept before and after it."""
_FALLEN = 3.0
"""Rotation ratio beyond which a fall is not followed."""


def write_explore(
    records: Sequence[CatalogueRecord],
    study: Study,
    parts: Iterable[Path],
    results: Path,
    target: Path,
    tell: Callable[[str], object],
) -> None:
    """Write the page of a study in `results`, with its tables in `parts`, to `target`.

    tell: takes a line for each record.
    """
    by_identifier = {record.id: record for record in records}
    known: dict[str, tuple[Content, list[Content]]] = {}
    for identifier, tables in chain.from_iterable(map(read_part, parts)):
        known[identifier] = _record(by_identifier[identifier], study, tables)
        tell(f"{identifier}: {len(known[identifier][1])} cases on the page")
    shown: list[Content] = []
    cases: list[Content] = []
    for said, found in (known[record.id] for record in records):
        cases += [{"record": len(shown), **each} for each in found]
        shown.append(said)
    structures = [
        {"name": name, "size": structure.size, "type": structure.type_name, "drawings": drawings(structure)}
        for name, structure in study.structures.items()
    ]
    places = {name: place for place, name in enumerate(study.structures)}
    for case in cases:
        case["structure"] = places[case["structure"]]
    figures = {"scatter": _scatter(cases), "fragility": _fragility(results / "fragility" / "fragility.csv")}
    write_whole(target, explore_page(shown, structures, cases, figures))


def _record(record: CatalogueRecord, study: Study, tables: RecordTables) -> tuple[Content, list[Content]]:
    """What the page says of one record, and of each structure under its worse component."""
    rows = _worse(tables.comparison, study.structures)
    said: Content = {
        "id": record.id,
        "failure": " ".join(failure.message for failure in tables.failures),
        "motions": {},
    }
    verdicts = {fate.structure: fate for fate in tables.verdicts}
    cases = [_case(row, verdicts[row.structure]) for row in rows]
    if rows:
        try:
            opened = study.open(record)
        except RockingError as error:
            return said | {"failure": str(error)}, cases
        used = {row.component for row in rows}
        said["motions"] = {
            each.component: _motion(each, tables) for each in opened[0] if each.component in used
        }
        for row, case in zip(rows, cases, strict=True):
            if row.integrated_rotation_ratio > NEGLIGIBLE:
                case["history"] = _history(row, opened, study)
    return said, cases


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


def _history(row: ComparisonRow, opened: Opened, study: Study) -> Content | None:
    """Rotation over critical rotation while it moves; None where there is none."""
    accelerograms, vertical = opened
    record = next(each for each in accelerograms if each.component == row.component)
    mechanism = study.structures[row.structure].mechanism()
    beside = None if vertical is None else aligned(vertical, record)
    try:
        response = integrate(mechanism, record, study.assessment.tolerance, history=True, vertical=beside)
    except RockingError:  # the tables say why
        return None
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
