"""Draw the figure of the README from the shipped records: python workflow/report/example.py"""

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking import Accelerogram, Arch, extract_pulses, integrate, predict_maximum, read
from rocking.reports.style import new_figure, styled
from rocking.structures import Structure

RECORDS = Path(__file__).parents[2] / "records"
ARCH = Arch(radius=15.0, thickness=1.575, embrace_angle=np.radians(157.5), restitution=0.9)
"""Slender enough (t/r = 0.105, λ = 0.19) that both records make it rock."""
SHOWN = (
    ("One pulse dominates: the prediction holds", "np01002p_4225c_a.smc"),
    ("No pulse dominates: the prediction fails", "20161113_110259_WTMC_20.V2A"),
)
"""The title, and the file."""
BEFORE, AFTER = 3.5, 9.0
"""Seconds that are drawn before and after the beginning of the pulse."""
PULSE, PREDICTED, BAND = "#D55E00", "#0072B2", "#DAE9F2"
_EDGE = 1.05
"""Rotation over the critical one at which a fall leaves the picture."""


@styled
def example_figure(structure: Structure) -> Figure:
    """Return one structure under each record: above its pulse, below the closed form and the integration."""
    figure = new_figure(72, margins=(4, 4, 6, 9))
    grid = figure.add_gridspec(2, len(SHOWN), height_ratios=(1, 1.9), hspace=0.05, wspace=0.12)
    records = [read(RECORDS / file)[0] for _, file in SHOWN]
    largest = max(record.peak_acceleration for record in records)
    for place, ((title, _), record) in enumerate(zip(SHOWN, records, strict=True)):
        ground = figure.add_subplot(grid[0, place])
        below = figure.add_subplot(grid[1, place])
        ground.set_title(title, loc="left", fontsize=9, fontweight="bold")
        ground.set_ylim(-1.1 * largest, 1.35 * largest)
        below.set_ylim(-0.6, 1.1 * _EDGE)
        _draw(ground, below, structure, record)
        for axes in (ground, below):
            axes.set_axis_off()
    return figure


def _draw(ground: Axes, below: Axes, structure: Structure, record: Accelerogram) -> None:
    found = extract_pulses(record)
    pulse = found.dominant
    for axes in (ground, below):
        axes.set_xlim(pulse.start_time - BEFORE, pulse.start_time + AFTER)
    cycle = np.linspace(pulse.start_time, pulse.end_time, 200)
    ground.plot(record.times, record.acceleration, color="0.45", linewidth=0.5)
    ground.plot(cycle, pulse.acceleration(cycle), color=PULSE, linewidth=1.8)
    told = f"its best sine: {100 * found.explained_energy:.0f} % of the energy"
    ground.text(1, 0.98, told, color=PULSE, ha="right", va="top", fontsize=8, transform=ground.transAxes)

    mechanism = structure.mechanism()
    predicted = predict_maximum(mechanism.equivalent_block(), pulse).rotation_ratio
    below.axhspan(-predicted, predicted, facecolor=BAND, zorder=0)
    for side in (predicted, -predicted):
        below.axhline(side, color=PREDICTED, linewidth=1.0)
    below.text(
        pulse.start_time + AFTER,
        -predicted - 0.04,
        f"closed form: {predicted:.2f}",
        color=PREDICTED,
        fontweight="bold",
        ha="right",
        va="top",
        fontsize=9,
    )
    response = integrate(mechanism, record, history=True)
    shares = response.rotation / mechanism.critical_rotation
    inside = np.abs(shares) <= _EDGE
    last = shares.size if inside.all() else int(np.argmin(inside)) + 1
    if math.isfinite(response.rotation_ratio):
        place = int(np.argmax(np.abs(shares)))
        told = f"integrated: {response.rotation_ratio:.2f}"
        below.hlines(
            0.0, response.times[-1], response.times[-1] + AFTER, color="black", linewidth=0.9
        )  # it rests
    else:
        place = last - 1
        shares[place] = np.copysign(_EDGE, shares[place])
        told = "integrated: overturns"
    below.plot(response.times[:last], shares[:last], color="black", linewidth=0.9)
    spot = response.times[place], float(shares[place])
    below.plot(*spot, "o", color="black", markersize=5)
    below.annotate(told, spot, (7, 2), textcoords="offset points", fontsize=9, fontweight="bold")


if __name__ == "__main__":
    drawn = example_figure(ARCH)
    drawn.savefig(Path(__file__).with_suffix(".png"), dpi=150, metadata={"Software": None})
