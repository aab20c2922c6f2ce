"""The pen of dimension lines and marks on axes of matplotlib."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from rocking.reports.dimension_lines import Across, Along

_THIN = {"color": "0.35", "linewidth": 0.4}
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.4}
_ARROW = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0}
_HEAD = _ARROW | _THIN | {"mutation_scale": 4}
_LOAD = _ARROW | {"color": "C3", "linewidth": 1.0, "mutation_scale": 7}


@dataclass(frozen=True)
class AxesPen:
    """A pen of rocking.reports.dimension_lines; places are in the units of the axes."""

    axes: Axes

    def thin(self, line: np.ndarray) -> None:
        self.axes.plot(*line, **_THIN)  # type: ignore[arg-type]

    def head(self, tip: np.ndarray, before: np.ndarray) -> None:
        self.axes.annotate("", tuple(tip), tuple(before), arrowprops=_HEAD)

    def arrow(self, tail: np.ndarray, tip: np.ndarray) -> None:
        self.axes.annotate("", tuple(tip), tuple(tail), arrowprops=_LOAD, zorder=5)
        self.axes.plot(*tail, alpha=0)  # arrows do not widen the limits of the axes

    def tie(self, ends: np.ndarray) -> None:
        self.axes.plot(*ends, color="C0", linewidth=1.0, zorder=3)
        for place, size in zip(ends.T, (7, 5), strict=True):
            self.axes.plot(*place, marker="|", color="C0", markersize=size, markeredgewidth=1.6)

    def letters(self, place: np.ndarray, text: str, across: Across, along: Along, paper: bool) -> None:
        ha, va = ("center" if side == "middle" else side for side in (across, along))
        self.axes.text(
            place[0], place[1], text, ha=ha, va=va, zorder=4 if paper else 3, bbox=_PAPER if paper else None
        )
