"""Draw the figure of the README from the shipped example: python workflow/report/example.py"""

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking import Accelerogram, Pulse, extract_pulses, integrate, predict_maximum, read
from rocking.reports.style import new_figure, styled
from rocking.structures import Structure, load_structures

ROOT = Path(__file__).parents[2]
SHOWN = ("arch 15 m", "stone pier", "spire")


@styled
def example_figure(record: Accelerogram, pulse: Pulse, structures: dict[str, Structure]) -> Figure:
    """Return the record with its dominant pulse above the response of each structure, integrated and predicted."""
    figure = new_figure(100, margins=(16, 3, 10, 2))
    grid = figure.add_gridspec(2, len(structures), hspace=0.85, wspace=0.3)
    _record(figure.add_subplot(grid[0, :]), record, pulse)
    for place, (name, structure) in enumerate(structures.items()):
        panel = figure.add_subplot(grid[1, place])
        _response(panel, name, structure, record, pulse)
        if place == 0:
            panel.set_ylabel("rotation over\ncritical rotation [-]")
            figure.legend(
                *panel.get_legend_handles_labels(), loc="center", bbox_to_anchor=(0.5, 0.5), ncols=2
            )
    return figure


def _record(panel: Axes, record: Accelerogram, pulse: Pulse) -> None:
    panel.plot(record.times, record.acceleration, color="0.35", linewidth=0.6, label="synthetic record")
    panel.plot(
        record.times,
        pulse.acceleration(record.times),
        color="#D55E00",
        linewidth=1.6,
        label="its dominant pulse",
    )
    panel.set_xlim(0, 12)
    panel.set_xlabel("time [s]")
    panel.set_ylabel("acceleration\n[m/s²]")
    panel.legend(loc="upper right")


def _response(panel: Axes, name: str, structure: Structure, record: Accelerogram, pulse: Pulse) -> None:
    mechanism = structure.mechanism()
    response = integrate(mechanism, record, history=True)
    panel.plot(
        response.times,
        response.rotation / mechanism.critical_rotation,
        color="black",
        linewidth=0.8,
        label="integrated, whole record",
    )
    predicted = predict_maximum(mechanism.equivalent_block(), pulse).rotation_ratio
    if math.isfinite(predicted):
        for side in (predicted, -predicted):
            label = "predicted from the pulse" if side > 0 else None
            panel.axhline(side, color="#0072B2", linewidth=1.2, linestyle="-.", label=label)
    said = f"predicted {predicted:.2f}" if math.isfinite(predicted) else "predicted to fall"
    panel.set_title(f"{name}\n{said}, integrated {response.rotation_ratio:.2f}")
    panel.set_xlim(3, 12)
    panel.set_ylim(-1, 1)
    panel.set_yticks(np.linspace(-1, 1, 5))
    panel.set_xlabel("time [s]")


if __name__ == "__main__":
    (ground,) = read(ROOT / "records" / "synthetic_strong_pulse.AT2")
    listed = load_structures(ROOT / "workflow" / "structures.yaml")
    drawn = example_figure(ground, extract_pulses(ground).dominant, {name: listed[name] for name in SHOWN})
    drawn.savefig(Path(__file__).with_suffix(".png"), dpi=150, metadata={"Software": None})
