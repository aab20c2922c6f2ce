"""The page to explore a study: one HTML file with a cell per case, and beside it a file per record with the rest.

A page that is opened from disk may not fetch: it loads the file of a record by a script element, once it is asked for.
"""

import base64
import json
import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from html import escape
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rocking.assessment.case import PeriodResult, RecordResult
from rocking.assessment.conclusion import conclusion_in_words, conclusions, worst_cases
from rocking.assessment.decide import ONE_RUN, Verdict, worse, worst_first
from rocking.assessment.rows import ComparisonRow, RecordRow, RecordRows, WarningRow
from rocking.assessment.scene import placed
from rocking.errors import FaultError, one_structure
from rocking.quantities import GRAVITY, counted
from rocking.reports.against import (
    HEADS,
    LEGEND,
    TITLE,
    Moving,
    compared_in_words,
    comparison_of,
    peak_of,
    sine_facts,
    sizes_of,
    traces_of,
)
from rocking.reports.drawings import fallen_rotation
from rocking.reports.pages import Strip
from rocking.reports.panels import moving_span
from rocking.reports.printing import LOOKS, SHARES, band_text, cell_text, known_crack, ratio, sentence
from rocking.reports.record import warnings_of
from rocking.reports.variants import strips_in_html
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.processing import displacement
from rocking.structures import Structure

Content = dict[str, Any]
"""The content that JSON can hold."""

RECORD_SCRIPT = "explore.js"
"""In the folder of a record: what the page says of it beyond its cells."""
BINS = 600
"""Points on the page of a trace."""
GROUND_BINS = 2400
"""Points of an acceleration, of which a case may show a short piece."""
PULSE_BINS = 60
"""Points of a pulse."""
FRAMES = 24
"""Drawings of a structure for each side; between two of them the page interpolates."""
_HOW_TO_READ = (
    "A single run has no number, nor has a cell too narrow for it. The worst comes first; click a heading to sort by "
    "its column. Arrow keys move between cells, Enter selects one."
)
_OF_DRAWING = (
    f"The curves show the largest value in each of {BINS} intervals (acceleration: {GROUND_BINS}). The ground moves by "
    "the record integrated twice, less a straight line, for the drawing only. Green: loads; blue: ties; rings: hinges."
)
_NONE = [-9.0, 0.0, 0.0, 0.0]
"""The severity of a case without a result."""
_HERE = Path(__file__).parent
_EXTREME = 1e9
"""What stands for inf, which JSON cannot hold."""
_MOST = 32767
_BEYOND = 3.0
"""Times the critical rotation up to which a fall is followed and drawn, but no further than a fallen structure."""


def record_content(result: RecordResult, rows: RecordRows, structures: Mapping[str, Structure]) -> Content:
    """Return what the page says of one record, and of each structure under the component that turns it farthest.

    Of a structure on a support it is said of the period that is worst.
    The responses of the mechanism under the record hold their histories; a case without one is shown without its
    motion.
    """
    worst = worst_cases(rows.comparison)
    components = {row.component for row in worst.values()}
    concluded = conclusions(rows.verdicts, rows.comparison)
    comparison = comparison_of(concluded, structures, result, traces_of(result, rows))
    moving = {moving.case.structure: moving for moving in comparison.moving} if comparison else {}
    several = comparison is not None and comparison.several
    failure = " ".join(["no result.", *(failure.message for failure in rows.failures)])
    nothing = {"verdict": Verdict.CANNOT_BE_TOLD, "cell": cell_text(None), "text": failure, "severity": _NONE}
    cases: dict[str, Content] = {}
    for period_result in result.worst_periods:
        name = period_result.structure
        if name in structures:
            row = worst.get((result.record, name, period_result.support_period_s))
            # One that cannot be shown costs no other: the page says that it has no result.
            with suppress(FaultError), one_structure(name):
                cases[name] = _case(period_result, row)
                if name in moving:
                    cases[name] |= _moving(moving[name], structures[name], several)
    peaks = [(row.peak_acceleration_m_s2 / GRAVITY, row.peak_velocity_m_s) for row in rows.record]
    pga, pgv = np.max(peaks, axis=0) if peaks else (math.nan, math.nan)
    return {
        "id": result.record,
        "warnings": list(warnings_of(rows)),
        "pga": _number(pga),
        "pgv": _number(pgv),
        "motions": {
            accelerogram.component: _motion(accelerogram, rows)
            for accelerogram in result.accelerograms
            if accelerogram.component in components
        },
        "cases": {name: cases.get(name, nothing) for name in structures},
        "span": [_number(end) for end in comparison.span] if comparison else [],
        "at_rest": comparison.at_rest if comparison else "",
        **_where(rows.record),
    }


def cells_of(content: Content) -> Content:
    """Return what a study's page holds of a `record_content`: what its cells show, and where its station is."""
    cells = {
        name: {key: case[key] for key in ("verdict", "cell", "severity")} | {"moves": "history" in case}
        for name, case in content["cases"].items()
    }
    return {key: part for key, part in content.items() if key not in _OF_CASES} | {"cases": cells}


_OF_CASES = ("warnings", "motions", "span", "at_rest")
"""What a page needs of a record only for the case that is looked at."""


def record_script(content: Content) -> bytes:
    """Return the file of a record that gives its `record_content` to the page of the study."""
    return f"rockingRecord({json.dumps(content, allow_nan=False, separators=(',', ':'))});\n".encode()


def _where(components: Sequence[RecordRow]) -> Content:
    """The earthquake and the station of a record, and where both are, longitude and latitude in degrees."""
    if not components:
        return {}
    first = components[0]
    station = first.station_longitude_deg, first.station_latitude_deg
    epicentre = first.epicentre_longitude_deg, first.epicentre_latitude_deg
    where: Content = {"event": first.event, "station": first.station}
    if None not in station:
        where["place"] = list(station)
    if not math.isnan(epicentre[0]):
        where["epicentre"] = list(epicentre)
    return where


def _warnings_of(name: str, structures: Collection[str], warnings: Iterable[WarningRow]) -> list[str]:
    """The warnings on one structure, and those on the settings, which are about no structure."""
    sentences = []
    for row in warnings:
        about = row.about.partition(": ")[0]
        if about == name or about not in structures:
            sentences.append(row.sentence)
    return sentences


def explore_page(
    records: Iterable[Content],
    structures: Mapping[str, Structure],
    title: str = "",
    conclusions: Sequence[str] = (),
    notes: Mapping[str, Sequence[str]] = MappingProxyType({}),
    strips: Sequence[Strip] = (),
    warnings: Sequence[WarningRow] = (),
) -> bytes:
    """Return the page as UTF-8 HTML; it stands in a folder beside those of the records, and loads their RECORD_SCRIPT.

    records: their `cells_of`, or their whole `record_content`, in the order of the catalogue. title: of the study.
    conclusions, notes: of the products over all records, and on each structure by its name. strips: of the variants of
    structures. warnings: on the study itself.
    """
    of_records = list(records)
    of_structures = [
        {
            "name": name,
            "size": structure.described.size,
            "below": sizes_of(name, structure),
            "type": structure.described.type_name,
            "warnings": [
                *(f"{sentence(known)}." for known in [known_crack(structure)] if known),
                *notes.get(name, ()),
                *_warnings_of(name, structures, warnings),
            ],
            "frames": _frames(name, structure),
        }
        for name, structure in structures.items()
    ]
    cases = [
        (record["id"], name, tuple(case["severity"]))
        for record in of_records
        for name, case in record["cases"].items()
    ]
    both: Content = {
        "against": {"title": TITLE, "heads": [[head.name, head.below] for head in HEADS]},
        "verdicts": {sign: verdict for verdict, (sign, *_) in LOOKS.items()},
        "records": _ranked(
            map(_without_verdicts, of_records), "id", worst_first((record, key) for record, _, key in cases)
        ),
        "structures": _ranked(of_structures, "name", worst_first((name, key) for _, name, key in cases)),
    }
    content = json.dumps(both, allow_nan=False, separators=(",", ":"), ensure_ascii=False)
    colours = "".join(
        f".{_css(verdict)} {{ background: {fill}; fill: {fill}; color: {ink};"
        f"{' border-style: dashed; stroke-dasharray: 3 2;' if hatch else ''} }}\n"
        for verdict, (_, fill, ink, hatch) in LOOKS.items()
    )
    legend = (
        f'<span><span class="cell {_css(verdict)}">{sign}</span> {verdict}</span>'
        for verdict, (sign, *_) in LOOKS.items()
    )
    pieces = {
        "title": escape(title or "Rocking of structures under recorded earthquakes"),
        "conclusion": escape(" ".join([_conclusion(of_records), *conclusions])),
        "count": f"{counted(len(_judged(of_records)), 'record')}, {counted(len(structures), 'structure')}",
        "verdicts": "".join(f"<option>{verdict}</option>" for verdict in LOOKS),
        "legend": "\n".join(legend),
        "shares": escape(f"{SHARES} {_HOW_TO_READ}"),
        "strip": escape(LEGEND),
        "drawing": escape(_OF_DRAWING),
        "variants": strips_in_html(strips) if strips else "",
        "style": (_HERE / "explore.css").read_text(encoding="utf-8") + colours,
        "script": (_HERE / "explore.js").read_text(encoding="utf-8").replace("RECORD_SCRIPT", RECORD_SCRIPT),
        # no text of a user can end the element that holds it
        "content": content.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029"),
    }
    page = (_HERE / "explore.html").read_text(encoding="utf-8")
    filled = re.sub(r"{{ (\w+) }}", lambda name: pieces[name[1]], page)
    return filled.encode(errors="backslashreplace")  # half a letter of a name becomes its escape in JSON


def _conclusion(records: Sequence[Content]) -> str:
    """The sentence on all structures, each by its worst verdict under a record that gave one."""
    words: dict[str, Verdict] = {}
    fallen = set()
    judged = _judged(records)
    for record in judged:
        for name, case in record["cases"].items():
            if case["severity"] != _NONE:
                words[name] = worse(Verdict(case["verdict"]), words.get(name, Verdict.CANNOT_OVERTURN))
                if case["severity"][1] == 1 and case.get("cell", "").endswith(ONE_RUN):
                    fallen.add(name)
    return conclusion_in_words(words, len(judged), fallen)


def _judged(records: Sequence[Content]) -> list[Content]:
    """The records under which a structure has a verdict: one that failed is counted nowhere."""
    return [
        record for record in records if any(case["severity"] != _NONE for case in record["cases"].values())
    ]


def _ranked(contents: Iterable[Content], key: str, worst: Sequence[str]) -> list[Content]:
    """The records or structures, each with the place of its name among the `worst` first."""
    ranks = {name: rank for rank, name in enumerate(worst)}
    return [{**content, "rank": ranks.get(content[key], len(ranks))} for content in contents]


def _without_verdicts(record: Content) -> Content:
    """A record without what the sign of each cell says: of many thousand cells the verdicts are a quarter of a page."""
    cases = {
        name: {key: value for key, value in case.items() if key != "verdict"}
        for name, case in record["cases"].items()
    }
    return {**record, "cases": cases}


def _css(verdict: Verdict) -> str:
    """Return the class of a verdict's cells."""
    return verdict.replace(" ", "-")


def _case(period_result: PeriodResult, row: ComparisonRow | None) -> Content:
    """Return what became of a structure, in words and numbers."""
    predicted = row.predicted_rotation_ratio if row else math.nan
    closed = ratio(predicted, 2)
    band = (
        f" (5 to 95 % of the members: {band_text(period_result.ensemble, ' to ')})"
        if period_result.ensemble.members
        else ""
    )
    crack = f" Crack that governs: {period_result.crack}." if period_result.crack else ""
    reserve = f" Reserve: {period_result.reserve_in_words}." if period_result.reserve else ""
    decision = period_result.decision
    place = placed("", period_result.support_period_s).removeprefix(", ")
    place = f"At its worst, {place}: " if place else ""
    share = f", {decision.share_in_words}" if decision.share_in_words else ""
    warnings = f" Warning: {'; '.join(map(str, decision.warnings))}." if decision.warnings else ""
    case: Content = {
        "verdict": str(decision.verdict),
        "cell": cell_text(decision),
        "text": f"{place}{decision.verdict}{share}: {decision.why}.{warnings} As given: "
        f"{ratio(period_result.rotation_ratio, 2)}{band}; by the closed form: {closed} "
        "(rotation over the critical one)."
        f"{crack}{reserve}",
        "severity": [_number(float(np.clip(key, -_EXTREME, _EXTREME))) for key in period_result.severity],
        "component": row.component if row else "",
        "predicted": _number(min(predicted, _EXTREME)),
        "closed": closed,
    }
    return case


def _moving(moving: Moving, structure: Structure, several: bool) -> Content:
    """Return the history that moves the drawing of a structure, and its texts on page two of the record.

    several: whether its component is to be named.
    """
    ratios = np.clip(moving.ratios, -_BEYOND, _BEYOND)
    words = compared_in_words(moving, structure, several)
    return {
        "history": _trace(moving.times, ratios, *moving_span([(moving.times, ratios)])),
        "critical": [_number(structure.mechanism().sides[place].critical_rotation) for place in (0, -1)],
        "printed": _number(min(moving.case.printed_rotation_ratio, _EXTREME)),
        "outside": words.outside,
        "one_sided": moving.mechanism.one_sided,
        "numbers": [words.printed, words.form, words.whole],
        "beside": [" ".join(words.constants), words.note],
    }


def _motion(accelerogram: Accelerogram, rows: RecordRows) -> Content:
    """Acceleration [m/s²] and its pulse, and the displacement [m] that moves the drawing, over the whole record."""
    times = accelerogram.times
    duration = accelerogram.duration
    path = displacement(accelerogram)
    line = np.polyval(np.polyfit(times, path, 1), times)
    motion = {
        "duration": duration,
        "facts": [peak_of(accelerogram), *sine_facts(accelerogram.component, rows.pulses)],
        "acceleration": _trace(times, accelerogram.acceleration, 0.0, duration, GROUND_BINS),
        "displacement": _trace(times, path - line, 0.0, duration),
    }
    ranked = [row for row in rows.pulses if row.component == accelerogram.component and row.ranked]
    if ranked:
        pulse = min(ranked, key=lambda row: row.rank).pulse
        inside = np.linspace(pulse.start_time, pulse.end_time, PULSE_BINS)
        ends = pulse.start_time, pulse.end_time
        motion["pulse"] = _trace(inside, pulse.acceleration(inside), *ends, PULSE_BINS)
    return motion


def _trace(times: np.ndarray, values: np.ndarray, begin: float, end: float, bins: int = BINS) -> Content:
    """Return `values` from `begin` to `end` [s], as `extremes` has them."""
    return {"span": [_number(begin), _number(end)]} | packed(extremes(times, values, begin, end, bins))


def _frames(name: str, structure: Structure) -> list[Content]:
    """The drawings of a structure; one without a line where they fail, which costs no other structure its own."""
    with suppress(FaultError), one_structure(name):
        return drawings(structure)
    return [{"rotation": 0.0, "parts": [], "hinges": 0, "marks": [], "points": packed([])}]


def drawings(structure: Structure) -> list[Content]:
    """Return outline, hinges, loads and ties of `structure` at FRAMES rotations of each side that it has.

    Each is a rotation [rad, signed], how many points each part has, the number of hinges, the kinds of the marks, of
    two points each, and x and y [m] of all these points in this order.
    """
    mechanism = structure.mechanism()
    frames = []
    for sign in (1,) if mechanism.one_sided else (1, -1):
        side = mechanism.sides[0 if sign > 0 else -1]
        end = min(abs(fallen_rotation(structure, sign)), _BEYOND * side.critical_rotation)
        for rotation in sign * end * np.linspace(1e-6, 1.0, FRAMES):
            parts = structure.outline(rotation)
            marks = structure.marks(rotation)
            hinges = np.reshape(structure.hinges(rotation), (-1, 2))
            frame = {
                "rotation": rotation,
                "parts": [len(part) for part in parts],
                "hinges": len(hinges),
                "marks": [mark.kind for mark in marks],
                "points": packed(np.vstack([*parts, hinges, *(mark.line for mark in marks)])),
            }
            frames.append(frame)
    return frames


def packed(values: ArrayLike) -> Content:
    """Return `values`, any shape, flattened into a scale and base64 of little-endian 16-bit integers.

    This loses 1/32767 of the largest.
    """
    flat = np.asarray(values, dtype=float).ravel()
    scale = float(np.abs(flat).max(initial=0.0)) / _MOST or 1.0
    whole = np.round(flat / scale).astype("<i2")
    return {"scale": scale, "data": base64.b64encode(whole.tobytes()).decode()}


def extremes(times: np.ndarray, values: np.ndarray, begin: float, end: float, bins: int = BINS) -> np.ndarray:
    """Return the value farthest from zero in each of `bins` equal stretches of [begin, end] s, (bins,): peaks stay.

    A stretch without a sample takes the value interpolated at its middle.
    """
    edges = np.linspace(begin, end, bins + 1)
    of_bins: np.ndarray = np.interp((edges[:-1] + edges[1:]) / 2, times, values)
    inside = (times >= begin) & (times <= end)
    place = np.minimum(np.searchsorted(edges, times[inside], side="right") - 1, bins - 1)
    samples = values[inside]
    order = np.argsort(np.abs(samples), kind="stable")
    of_bins[place[order]] = samples[order]  # the last one written, the farthest, stays
    return of_bins


def _number(value: float) -> float | None:
    """Return `value` as JSON can hold it: null for nan, else six digits."""
    return None if math.isnan(value) else float(f"{value:.6g}")
