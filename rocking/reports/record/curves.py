"""The figures of a record's report as the template takes them: SVG, alternative text and what the caption adds."""

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_record import PulseRow
from rocking.assessment.verdict import NEGLIGIBLE, Agreement
from rocking.motion.response import Response
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.reports import printing
from rocking.reports.paper.canvas import TEXT_WIDTH, Canvas
from rocking.reports.record.ground_figure import ground_motion
from rocking.reports.record.history_figure import History, response_histories
from rocking.reports.record.pulse_figures import energy_map
from rocking.reports.record.spectrum_figure import rocking_spectrum_figure
from rocking.reports.record.structure_figures import structure_drawings
from rocking.structures.mechanism import Mechanism
from rocking.structures.structure import Structure

Picture = dict[str, str]

MOST_DRAWN = 15
"""Structures that are drawn; the tables hold all."""
MOST_HISTORIES = 12
"""Responses that are drawn for one component, the most demanding ones; the tables hold all."""
SPECTRUM_POINTS = 32
MOTION_HEIGHTS = (62.0, 38.0)
"""Height of the time histories of the ground, mm: of a single component, and of each of several."""
"""Width of an energy map that stands beside others, mm."""
PAIRED_WIDTH = 83.0
"""Width of a figure that stands beside another, mm."""
_MAP_COLUMNS = 240


def motion_picture(
    accelerogram: Accelerogram, rows: Sequence[PulseRow], structures: Mapping[str, Structure], height: float
) -> Picture:
    """Return acceleration and residual of one component."""
    pulses = ranked_pulses(rows)
    uplift = [GRAVITY * structure.mechanism().uplift_multiplier for structure in structures.values()]
    figure = ground_motion(accelerogram, pulses[0] if pulses else None, uplift, height)
    return component_picture(
        accelerogram, figure, "Time histories of component {}: acceleration, pulse and residual."
    )


def component_picture(accelerogram: Accelerogram, figure: Canvas, alt: str, **more: str) -> Picture:
    """Return a figure of one component. alt: the alternative text, with {} for its name. more: for the caption."""
    component = printing.words(accelerogram.component)
    return {"component": component, "svg": figure.svg(), "alt": alt.replace("{}", component), **more}


def ranked_pulses(rows: Sequence[PulseRow]) -> list[Pulse]:
    """The ranked pulses, the dominant one first."""
    return [row.pulse for row in sorted(rows, key=lambda row: row.rank) if row.ranked]


def map_picture(accelerogram: Accelerogram, rows: Sequence[PulseRow], width: float = TEXT_WIDTH) -> Picture:
    """Return the energy of a sine pulse over onset and period."""
    from rocking.pulses.extraction import energy_map as energy_gains

    gains, frequencies = energy_gains(accelerogram)
    stretch = max(1, gains.shape[0] // _MAP_COLUMNS)
    starts = np.arange(0, gains.shape[0], stretch)
    pooled = np.maximum.reduceat(gains, starts, axis=0)
    figure = energy_map(starts * accelerogram.time_step, 1 / frequencies, pooled, ranked_pulses(rows), width)
    alt = "Map of the energy that one sine pulse explains in component {}, over onset and period."
    return component_picture(accelerogram, figure, alt)


def drawing_pictures(structures: Mapping[str, Structure], numbers: Mapping[str, str]) -> list[Picture]:
    """Return the drawings of the first structures, or nothing when there is none."""
    drawn = [(f"{number} {name}", structures[name]) for name, number in numbers.items() if name in structures]
    shown = drawn[:MOST_DRAWN]
    if not shown:
        return []
    caption = "The structures, each to the scale of its own bar: at rest (dashed), displaced (grey), hinges as circles."
    if len(drawn) > len(shown):
        caption += " The others are like these in kind and stand in the table alone."
    alt = f"Drawings to scale of {printing.counted(len(shown), 'structure')} at rest and displaced, with hinges."
    return [{"svg": _drawn(tuple(shown)), "alt": alt, "caption": caption}]


@lru_cache(maxsize=4)
def _drawn(structures: tuple[tuple[str, Structure], ...]) -> str:
    """The drawings, which are the same for every record of a study."""
    return structure_drawings(structures).svg()


def history_picture(
    accelerogram: Accelerogram,
    structures: Mapping[str, Structure],
    rows: Sequence[ComparisonRow],
    numbers: Mapping[str, str],
    tolerance: float,
    vertical: Accelerogram | None = None,
) -> Picture | None:
    """Return the response histories of one component, the most demanding first chosen; None when nothing moves."""
    from rocking.motion.integration import integrate
    from rocking.records.rotation import aligned

    moving = [
        row for row in rows if row.integrated_rotation_ratio > NEGLIGIBLE and row.structure in structures
    ]
    chosen = sorted(moving, key=_demand, reverse=True)[:MOST_HISTORIES]
    chosen = [row for row in rows if row in chosen]
    if not chosen:
        return None
    beside = None if vertical is None else aligned(vertical, accelerogram)
    histories = []
    for row in chosen:
        mechanism = structures[row.structure].mechanism()
        response = integrate(mechanism, accelerogram, tolerance, history=True, vertical=beside)
        label = f"{numbers[row.structure]} {row.structure}"
        histories.append(_history(label, row, mechanism, response))
    figure = response_histories(histories)
    left_out = len(rows) - len(chosen)
    note = (
        f" Not drawn: {printing.counted(left_out, 'structure')}, not lifted or hardly so, or less demanding."
        if left_out
        else ""
    )
    alt = f"Rotation histories of {printing.counted(len(chosen), 'structure')} under component {{}}."
    return component_picture(accelerogram, figure, alt, note=note)


def _demand(row: ComparisonRow) -> tuple[bool, float]:
    return row.agreement is Agreement.TOO_LOW, row.integrated_rotation_ratio


def _history(label: str, row: ComparisonRow, mechanism: Mechanism, response: Response) -> History:
    assert response.times is not None and response.rotation is not None  # asked for
    negative = mechanism.negative or mechanism.positive
    critical = np.where(response.rotation < 0, negative.critical_rotation, mechanism.critical_rotation)
    predicted = row.predicted_rotation_ratio
    overturns = math.isinf(row.integrated_rotation_ratio)
    remark = _remark(predicted, overturns)
    return History(label, response.times, response.rotation / critical, predicted, remark)


def _remark(predicted: float, overturns: bool) -> str:
    if math.isinf(predicted):
        return "overturns, as predicted" if overturns else "predicted: overturns"
    said = "predicted: no uplift" if predicted == 0 else ""
    return "; ".join(text for text in ("overturns" if overturns else "", said) if text)


def spectrum_picture(
    accelerogram: Accelerogram,
    structures: Mapping[str, Structure],
    numbers: Mapping[str, str],
    width: float = TEXT_WIDTH,
) -> Picture | None:
    """Return the rocking spectrum with the structures on it; None where all rest."""
    from rocking.motion.batch import rocking_spectrum

    placed = placed_structures(structures, numbers)
    if not placed:
        return None
    frequency_parameters = _around([place[1] for place in placed])
    uplift_multipliers = _around([place[2] for place in placed])
    restitution = sorted(each.mechanism().restitution for each in structures.values())[len(placed) // 2]
    ratios = rocking_spectrum(accelerogram, frequency_parameters, uplift_multipliers, restitution)
    if not ratios.any():
        return None
    figure = rocking_spectrum_figure(frequency_parameters, uplift_multipliers, ratios, placed, width)
    alt = "Rocking spectrum of component {} over p and uplift acceleration, with the structures."
    return component_picture(accelerogram, figure, alt, restitution=printing.number(restitution))


def placed_structures(
    structures: Mapping[str, Structure], numbers: Mapping[str, str]
) -> list[tuple[str, float, float]]:
    """Number, p and λ of each structure."""
    found = []
    for name, structure in structures.items():
        mechanism = structure.mechanism()
        found.append((numbers[name], mechanism.positive.frequency_parameter, mechanism.uplift_multiplier))
    return found


def _around(values: Sequence[float]) -> np.ndarray:
    """A grid that holds every value with room to both sides."""
    return np.geomspace(min(values) / 1.8, max(values) * 1.8, SPECTRUM_POINTS)
