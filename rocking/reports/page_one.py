"""Page one of a record's report: one row for each structure, all of them, with closed form, block and integration."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from rocking.assessment.conclusion import Conclusion
from rocking.assessment.cracks import cracked
from rocking.assessment.decide import ORDER, Verdict
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import PulseRow
from rocking.quantities import listed, percents
from rocking.remarks import Kind
from rocking.reports.drawings import sketch
from rocking.reports.panels import Trace
from rocking.reports.printing import chip, number
from rocking.reports.style import PULSE, drawn_by_hand, svg_path, thinned
from rocking.structures import Structure

DOMINATES = 0.5
"""Share of the energy of a record from which on one sine is said to dominate it. What the closed form is worth rises
with that share without a step (`rocking.pulses.pulse.WORTH`), so that the edge is a choice."""
MOST_ROWS = 12
"""Structures that have a row, the worst first; the others are named by their words below."""
UNSAID = (Kind.NOTHING_TO_DO, Kind.NOTHING_DECIDES)
"""Remarks of which a row says nothing."""
_MOST_NAMED = 20
"""Names of a word below the rows."""
_UNIT = 27.0
"""Length of a rotation ratio of 1 on the scale, mm."""
_FARTHEST = 1.2
"""Rotation ratio at the end of the scale; what came back from beyond it stands there."""
_FALLEN = {"form": 36.5, "block": 41.5, "whole": 46.5, "line": 48.5}
"""Where on the scale stands what falls, mm: within its grey zone, a place for each mark."""
_DRAWN = 0.8
"""Rotation ratio at which a structure is drawn."""
_STRIP = 118.0, 20.0
"""Width and height of the strip of the record, mm."""
_POINTS = 1200


def page_one(
    conclusions: Sequence[Conclusion],
    structures: Mapping[str, Structure],
    motion: Trace | None,
    pulse: PulseRow | None,
) -> dict[str, object]:
    """Return what the template of page one is given below its title.

    conclusions: of all structures, the worst first. motion: the component that stands for the record, None without one;
    pulse: its dominant pulse.
    """
    drawn, others = conclusions[:MOST_ROWS], conclusions[MOST_ROWS:]
    words = {each.decision.word for each in conclusions}
    return {
        "trace": [_trace(motion)] if motion else [],
        "sine": _sine(pulse),
        "rows": [_row(each, structures.get(each.structure)) for each in drawn],
        "others": [
            {"word": str(word), "names": listed(names, _MOST_NAMED)}
            for word in ORDER
            if (names := [each.structure for each in others if each.decision.word is word])
        ],
        "untold": Verdict.CANNOT_BE_TOLD in words,
    }


def _sine(pulse: PulseRow | None) -> dict[str, object]:
    """The share of the energy in one sine, and whom to trust where closed form and integration differ."""
    if pulse is None:
        return {"share": "", "clause": "No sine was found: there are no rings."}
    dominates = pulse.explained_energy >= DOMINATES
    return {
        "share": percents(pulse.explained_energy),
        "clause": "One sine dominates: rings and dots mostly agree."
        if dominates
        else "No sine dominates: trust the dots, not the rings.",
    }


def _row(conclusion: Conclusion, structure: Structure | None) -> dict[str, object]:
    decision = conclusion.decision
    verdict = conclusion.verdict
    band = [_place(each, "line") for each in (verdict.rotation_ratio_low, verdict.rotation_ratio_high)]
    period = verdict.support_period_s
    below = "" if period is None else f"T_b {period:.3g} s" if period else "on the ground"
    return chip(decision.word, decision.share_in_words) | {
        "drawing": [_drawing(structure, conclusion)] if structure else [],
        "name": conclusion.structure,
        "below": below,
        "marks": {
            "form": _place(conclusion.closed_form, "form"),
            "block": _place(conclusion.block, "block"),
            "whole": _place(conclusion.integrated, "whole"),
            "line": band if None not in band else [],
        },
        "reserve": reserve_in_figures(verdict.reserve),
        "alone": bool(verdict.reserve_doubts),
        "remark": "" if conclusion.remark.kind in UNSAID else conclusion.remark.brief,
    }


def _place(ratio: float, mark: str) -> float | None:
    """The place of a rotation ratio on the scale, mm; None where there is none."""
    if math.isnan(ratio):
        return None
    return _FALLEN[mark] if ratio == math.inf else _UNIT * min(ratio, _FARTHEST)


def reserve_in_figures(reserve: Reserve | None) -> str:
    """Return the factors at which 5 % and half of the members overturn: "0.28–0.54", "2.5–3+" or "3+"; "" without."""
    if reserve is None:
        return ""
    beyond = f"{reserve.limit:g}+"
    low, median = (beyond if math.isnan(each) else number(each, 2) for each in (reserve.low, reserve.median))
    return low if low == median else f"{low}–{median}"


def _trace(motion: Trace) -> dict[str, str]:
    """The acceleration of a component while it shakes, and its dominant pulse, without axes."""
    width, height = _STRIP
    record = motion.accelerogram
    begin, end = motion.span
    reach = 1.05 * max(record.peak_acceleration, 1e-9)

    def line(times: np.ndarray, acceleration: np.ndarray, look: str) -> str:
        across = width * (times - begin) / (end - begin)
        up = height / 2 * (1 + acceleration / reach)
        return svg_path(np.stack([across, up], axis=1), height, look)

    inside = (record.times >= begin) & (record.times <= end)
    times, acceleration = thinned(record.times[inside], record.acceleration[inside], _POINTS)
    lines = [line(times, acceleration, 'fill="none" stroke="#595959" stroke-width="0.21"')]
    for pulse in motion.pulses[:1]:
        cycle = np.linspace(pulse.start_time, pulse.end_time, 121)
        look = f'fill="none" stroke="{PULSE}" stroke-width="0.53"'
        lines.append(line(cycle, pulse.acceleration(cycle), look))
    alt = "Acceleration of the ground and the sine that explains most of its energy."
    return drawn_by_hand(lines, width, height, alt)


def _drawing(structure: Structure, conclusion: Conclusion) -> dict[str, str]:
    """The mechanism that governs at _DRAWN of its critical rotation, and dashed at rest."""
    broken = cracked(structure, conclusion.verdict.crack)
    side = -1 if conclusion.verdict.peak_side == -1 else 1
    sides = broken.mechanism().sides
    rotation = side * _DRAWN * sides[0 if side > 0 else -1].critical_rotation
    width, height = 12.0, 14.0
    alt = f"{conclusion.structure}, turned, and at rest."
    return drawn_by_hand(sketch(broken, rotation, width, height), width, height, alt)
