"""The one style of the figures, how a figure becomes bytes, and names cut to the room that they have."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Sequence
from functools import cache, wraps
from importlib.util import find_spec
from itertools import accumulate
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np

from rocking.reports.pages import Picture
from rocking.tables import Document

if TYPE_CHECKING:  # matplotlib takes half a second to import, and page one is drawn without it
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

P = ParamSpec("P")
T = TypeVar("T")

TEXT_WIDTH = 170.0
"""Width of the text of a page, mm."""
RECORD = "0.35"
"""Colour of a recorded motion."""
PULSE = "#D55E00"
"""Colour of its sine pulse."""
PREDICTED = "#0072B2"
"""Colour of a closed form."""
SMALL_LETTER = 0.6
"""Width of a usual small letter of the figures over the size of the font."""
_TRIES = 8
"""Largest number of times that a drawing is shrunk to make room for its texts."""
FONT_FOLDER = Path(str(getattr(find_spec("matplotlib"), "origin", ""))).parent / "mpl-data" / "fonts" / "ttf"
COMMON = {
    *range(0x20, 0x7F),
    *range(0xA0, 0x250),
    *range(0x2010, 0x2028),
    *map(ord, "αβηλξφψωΓΔΣ⁰⁴⁵⁶⁷⁸⁹⁻₀₁₂→↔≈≤≥−∞√∫△▲○●■□½"),
}
"""Code points that the fonts of the figures and of the page surely hold: to ask those takes a tenth of a second."""
_MILLIMETRES_PER_INCH = 25.4

_STYLE = Path(__file__).with_name("rocking.mplstyle")


def styled(draw: Callable[P, T]) -> Callable[P, T]:
    """Decorate a function that draws: it does so inside the package's style, whatever the caller's own settings are."""

    @wraps(draw)
    def within(*arguments: P.args, **named: P.kwargs) -> T:
        from matplotlib import rc_context

        with rc_context(_parameters()):
            return draw(*arguments, **named)

    return within


@cache
def _parameters() -> Any:
    from matplotlib import rc_params_from_file

    return rc_params_from_file(_STYLE, use_default_template=False)


def new_figure(
    height: float, width: float = TEXT_WIDTH, margins: Sequence[float] = (14.0, 2.0, 8.5, 4.0)
) -> Figure:
    """Return an empty figure of `width` by `height` mm with the margins left, right, bottom and top of its panels, mm.

    Margins are given, not searched: searching them costs more than drawing.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / _MILLIMETRES_PER_INCH, height / _MILLIMETRES_PER_INCH))
    left, right, bottom, top = margins
    figure.subplots_adjust(left / width, bottom / height, 1 - right / width, 1 - top / height)
    return figure


def panel_at(figure: Figure, left: float, top: float, width: float, height: float) -> Axes:
    """Return new axes whose box stands at `left` and `top` of the figure, in mm from its upper left corner."""
    wide, high = (size * _MILLIMETRES_PER_INCH for size in figure.get_size_inches())
    return figure.add_axes((left / wide, 1 - (top + height) / high, width / wide, height / high))


_SYMBOL = re.compile(r"\b([adST])_(SLV|SLC|SLD|g|C\*|T|b)(?![\w*])(?=[^<>]*</text>)")
"""A symbol with an index in a text of an SVG, as layout.typ knows them."""
_WITH_INDEX = r'<tspan font-style="italic">\1</tspan><tspan baseline-shift="sub" font-size="5.6">\2</tspan>'


@styled
def svg(figure: Figure) -> str:
    """Return the figure as SVG text, the same bytes at every run; its labels stay text, with their indices lowered."""
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": "rocking"})
    return _SYMBOL.sub(_WITH_INDEX, stream.getvalue())


PICTURE = Document("figure", ".svg", lambda content: b"<dc:title>rocking</dc:title>" in content)
"""The mark is the creator that `svg` names."""


def picture(figure: Figure, alt: str) -> Picture:
    """Return a figure as the templates take it."""
    return Picture(svg=svg(figure), alt=alt)


def pictures(draw: Callable[..., Figure], things: Sequence[Any], alt: str, *more: Any) -> tuple[Picture, ...]:
    """Return the figure that `draw` makes of `things`, or nothing where there are none."""
    return (picture(draw(things, *more), alt),) if things else ()


def plain_logarithmic(panel: Axes, which: str) -> None:
    """Give the x or y axis of `panel` a logarithmic scale with ticks at 1, 2, 5 and plain numbers on them."""
    from matplotlib.ticker import LogLocator, NullLocator, StrMethodFormatter

    axis = panel.xaxis if which == "x" else panel.yaxis
    panel.set(**{f"{which}scale": "log"})
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_locator(NullLocator())


def room_for_texts(figure: Figure, axes: Axes) -> None:
    """Widen the limits of a drawing in `figure`, to one scale both ways, until its texts stand within its panel.

    Texts keep their size while the drawing shrinks, so that the second or third try is the last one.
    """
    for _ in range(_TRIES):
        figure.draw_without_rendering()
        boxes = [text.get_window_extent() for text in axes.texts if text.get_text()]
        panel = axes.bbox
        left = max([panel.x0 - box.x0 for box in boxes], default=0.0)
        right = max([box.x1 - panel.x1 for box in boxes], default=0.0)
        if max(left, right) <= 0:
            return
        low, high = axes.get_xlim()
        pixel = (high - low) / panel.width
        axes.set_xlim(low - max(left, 0.0) * pixel, high + max(right, 0.0) * pixel)
        # As much of the height, so that one metre stays as long both ways.
        grown = np.diff(axes.get_xlim())[0] / (high - low)
        foot, head = axes.get_ylim()
        middle = (foot + head) / 2
        axes.set_ylim(middle + (foot - middle) * grown, middle + (head - middle) * grown)


@cache
def glyphs() -> frozenset[int]:
    """Return the code points that the fonts of the figures and of the page hold."""
    from matplotlib.ft2font import FT2Font

    return frozenset(FT2Font(str(FONT_FOLDER / "DejaVuSans.ttf")).get_charmap())


@cache
def _width(letter: str) -> float:
    """Return the width of a letter of the figures' font over that of a usual small one, SMALL_LETTER."""
    from matplotlib.ft2font import FT2Font

    font = FT2Font(str(FONT_FOLDER / "DejaVuSans.ttf"))
    font.set_size(100, 72)  # an em of 100 pixels
    advance: int = font.load_char(ord(letter)).linearHoriAdvance  # 65536ths of a pixel
    return advance / 65536 / 100 / SMALL_LETTER


def elided(text: str, length: float) -> str:
    """Return `text` as a figure can show it: cut to the width of `length` small letters, the last one an ellipsis if
    something was cut, and a box for each character that no font of the figure holds.

    A small letter is SMALL_LETTER of the size of the font wide.
    """
    readable = "".join(letter if ord(letter) in glyphs() else "□" for letter in text)
    ends = list(accumulate(map(_width, readable)))
    if not ends or ends[-1] <= length:
        return readable
    room = length - _width("…")
    return readable[: sum(end <= room for end in ends)] + "…"


def wrapped(text: str, length: float, most: int) -> str:
    """Return `text` on at most `most` lines, each as wide as `elided` makes it, and the last one cut where it must be.

    Lines end between words, unless that would leave half of a line empty: then the word is divided.
    """
    lines: list[str] = []
    rest = text
    while rest and len(lines) < most - 1:
        shown = elided(rest, length)
        if not shown.endswith("…") or shown == rest:
            break
        fits = len(shown)  # as many characters as fit, for the ellipsis takes the room of one
        space = rest.rfind(" ", fits // 2, fits)
        end = space if space > 0 else fits - 1
        hyphen = "" if space > 0 else "-"
        lines.append(elided(rest[:end] + hyphen, length))
        rest = rest[end:].lstrip()
    return "\n".join([*lines, elided(rest, length)])
