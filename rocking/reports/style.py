"""The one style of the figures that matplotlib draws, and how such a figure becomes bytes."""

import io
from collections.abc import Callable, Sequence
from functools import cache, wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

import matplotlib
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter

from rocking.reports.paper.canvas import TEXT_WIDTH

Margins = tuple[float, float, float, float]
MARGINS: Margins = (14.0, 2.0, 8.5, 4.0)
"""Left, right, bottom, top, mm: room for tick labels and one line of axis label."""
_MILLIMETRES_PER_INCH = 25.4

P = ParamSpec("P")
R = TypeVar("R")


@cache
def _style() -> matplotlib.RcParams:
    path = Path(__file__).with_name("rocking.mplstyle")
    return matplotlib.rc_params_from_file(path, use_default_template=False)


def styled(function: Callable[P, R]) -> Callable[P, R]:
    """Draw inside the package's style, whatever the caller's own settings are."""

    @wraps(function)
    def inside(*args: P.args, **kwargs: P.kwargs) -> R:
        with matplotlib.rc_context(_style()):
            return function(*args, **kwargs)

    return inside


def new_figure(height: float, width: float = TEXT_WIDTH, margins: Margins = MARGINS) -> Figure:
    """Return an empty figure of `width` by `height` mm with the margins left, right, bottom and top of its panels, mm.

    Margins are given, not found: finding them costs more than drawing.
    """
    figure = Figure(figsize=(width / _MILLIMETRES_PER_INCH, height / _MILLIMETRES_PER_INCH))
    left, right, bottom, top = margins
    figure.subplots_adjust(left / width, bottom / height, 1 - right / width, 1 - top / height)
    return figure


@styled
def svg(figure: Figure) -> str:
    """Return the figure as SVG text, the same bytes at every run; its labels stay text."""
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def picture(figure: Figure, alt: str) -> dict[str, str]:
    """Return a figure as the templates take it: SVG and alternative text."""
    return {"svg": svg(figure), "alt": alt}


def shared_legend(figure: Figure, names: Sequence[str], ncols: int) -> None:
    """Name the lines of all panels once, below them, in the order of `names`."""
    handles: dict[str, Artist] = {}
    for panel in figure.axes:
        handles |= dict(zip(*panel.get_legend_handles_labels()[::-1], strict=True))
    shown = [name for name in names if name in handles]
    figure.legend([handles[name] for name in shown], shown, loc="lower center", ncols=ncols)


def plain_logarithmic(panel: Axes, which: str) -> None:
    """Give the x or y axis of `panel` a logarithmic scale with ticks at 1, 2, 5 and plain numbers on them."""
    axis = panel.xaxis if which == "x" else panel.yaxis
    panel.set(**{f"{which}scale": "log"})
    axis.set_major_locator(LogLocator(subs=(1, 2, 3, 5, 7)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_locator(NullLocator())
