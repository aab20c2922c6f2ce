"""The one style of every figure, and how a figure becomes bytes."""

import io
import itertools
from collections.abc import Callable
from functools import cache, wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import get_font
from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter

TEXT_WIDTH = 170.0
"""Width of the text on the page, mm; a figure is set at its own size, so its type keeps its size."""
MAXIMUM_POINTS = 4000
"""Points of the longest trace that is drawn."""
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


def thinned(
    times: np.ndarray, values: np.ndarray, limit: int = MAXIMUM_POINTS
) -> tuple[np.ndarray, np.ndarray]:
    """Return the envelope of a trace in at most `limit` points: least and largest value of each stretch, in order."""
    if values.size <= limit:
        return times, values
    edges = np.linspace(0, values.size, limit // 2 + 1).astype(int)
    low = [begin + int(values[begin:end].argmin()) for begin, end in itertools.pairwise(edges)]
    high = [begin + int(values[begin:end].argmax()) for begin, end in itertools.pairwise(edges)]
    kept = np.unique(np.concatenate([low, high]))
    return times[kept], values[kept]


@cache
def glyphs() -> frozenset[int]:
    """Return the code points that the fonts of the figures and of the page hold."""
    return frozenset(
        get_font(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf").get_charmap()
    )


def elided(text: str, length: float) -> str:
    """Return `text` as a figure can show it: cut to the width of about `length` small letters, the last one an
    ellipsis if something was cut, and a box for each character that no font of the figure holds.
    """
    width = 0.0
    shown = "".join(letter if ord(letter) in glyphs() else "□" for letter in text)
    for place, letter in enumerate(shown):
        width += 1.0 if letter.isascii() and not letter.isupper() else 1.6
        if width > length:
            return shown[: max(place - 1, 0)] + "…"
    return shown


def plain_logarithmic(panel: Axes, which: str) -> None:
    """Give the x or y axis of `panel` a logarithmic scale with ticks at 1, 2, 5 and plain numbers on them."""
    axis = panel.xaxis if which == "x" else panel.yaxis
    panel.set(**{f"{which}scale": "log"})
    axis.set_major_locator(LogLocator(subs=(1, 2, 3, 5, 7)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_locator(NullLocator())
