"""Draw the figure of the README from the shipped example: python workflow/report/example.py"""

import math
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking import Accelerogram, Pulse, extract_pulses, integrate, predict_maximum, read
from rocking.assessment.listed import load_scenes
from rocking.reports.style import new_figure, styled
from rocking.structures import Structure

ROOT = Path(__file__).parents[2]
SHOWN = ("arch 10 m", "spire", "storey wall")
STRONG_PHASE = (46, 62)
"""Seconds of the record that are drawn."""


@styled
def example_figure(record: Accelerogram, pulse: Pulse, structures: dict[str, Structure]) -> Figure:
    """Return the record with its dominant pulse, and below the response of each structure, integrated and predicted."""
    figure = new_figure(100, margins=(16, 3, 10, 2))
    grid = figure.add_gridspec(2, len(structures), hspace=0.85, wspace=0.3)
    ground = figure.add_subplot(grid[0, :])
    ground.plot(record.times, record.acceleration, color="0.35", linewidth=0.6, label=record.station)
    curve = pulse.acceleration(record.times)
    ground.plot(record.times, curve, color="#D55E00", linewidth=1.6, label="dominant pulse")
    ground.set(xlim=STRONG_PHASE, xlabel="time [s]", ylabel="acceleration\n[m/s²]")
    ground.legend(loc="upper right")
    for place, (name, structure) in enumerate(structures.items()):
        panel = figure.add_subplot(grid[1, place])
        _draw_response(panel, name, structure, record, pulse)
        if place == 0:
            panel.set_ylabel("rotation over\ncritical rotation [-]")
            figure.legend(
                *panel.get_legend_handles_labels(), loc="center", bbox_to_anchor=(0.5, 0.5), ncols=2
            )
    return figure


def _draw_response(panel: Axes, name: str, structure: Structure, record: Accelerogram, pulse: Pulse) -> None:
    mechanism = structure.mechanism()
    response = integrate(mechanism, record, history=True)
    shares = response.rotation / mechanism.critical_rotation
    panel.plot(response.times, shares, color="black", linewidth=0.8, label="integrated under the record")
    predicted = predict_maximum(mechanism.equivalent_block(), pulse).rotation_ratio
    for side in (predicted, -predicted):
        label = "closed form under the pulse" if side > 0 else None
        panel.axhline(side, color="#0072B2", linewidth=1.2, linestyle="-.", label=label)
    ratio = response.rotation_ratio
    outcome = f"largest {ratio:.2f}" if math.isfinite(ratio) else "falls"
    panel.set_title(f"{name}: {outcome},\nclosed form {predicted:.2f}")
    panel.set(xlim=STRONG_PHASE, ylim=(-1, 1), yticks=(-1, -0.5, 0, 0.5, 1), xlabel="time [s]")


if __name__ == "__main__":
    record = read(ROOT / "records" / "20161113_110259_WTMC_20.V2A")[0]
    listed = load_scenes(ROOT / "workflow" / "structures.yaml")
    drawn = example_figure(
        record, extract_pulses(record).dominant, {name: listed[name].structure for name in SHOWN}
    )
    drawn.savefig(Path(__file__).with_suffix(".png"), dpi=150, metadata={"Software": None})
