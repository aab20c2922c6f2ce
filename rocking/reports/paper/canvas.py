"""A sheet of paper that is drawn on in millimetres and becomes SVG, the same bytes for the same strokes."""

import base64
from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape

import numpy as np

from rocking.reports.paper.letters import MILLIMETRES_PER_POINT, shown, text_width

TEXT_WIDTH = 170.0
"""Width of the text on the page, mm; a figure is set at its own size, so its type keeps its size."""
UNITS = 100
"""SVG units to the millimetre: a hundredth of a millimetre is less than a printer sets, so whole numbers do."""
SIZE = 7.5
"""Points of a letter where nothing else is said; none is smaller than 7."""
SMALL = 7.0
_DASHES = {"": (), "dotted": (1.0, 1.6), "dashed": (3.7, 1.6), "dash-dot": (6.4, 1.6, 1.0, 1.6)}
_RISES = {"bottom": -0.24, "middle": 0.36, "top": 0.78}
"""From where a text stands to its base line, in letter sizes."""


@dataclass(frozen=True)
class Box:
    """A part of the paper: left, top, right and bottom edge, mm from the upper left corner."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def width(self) -> float:
        return self.right - self.left

    @property
    def height(self) -> float:
        return self.bottom - self.top

    def meets(self, other: "Box") -> bool:
        """Whether the two share a place."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.top < other.bottom
            and other.top < self.bottom
        )

    def holds(self, other: "Box") -> bool:
        """Whether `other` lies within."""
        return (
            self.left <= other.left
            and other.right <= self.right
            and self.top <= other.top
            and other.bottom <= self.bottom
        )


@dataclass(eq=False)
class Canvas:
    """A figure of `width` by `height` mm."""

    width: float
    height: float
    _parts: list[str] = field(default_factory=list)
    _clips: int = 0

    def path(
        self,
        points: np.ndarray,
        colour: str = "none",
        width: float = 0.8,
        dash: str = "",
        fill: str = "none",
        closed: bool = False,
        clip: str = "",
    ) -> None:
        """Draw a line through `points` (k, 2), or with `closed` an area. width: points. clip: name of clip()."""
        drawn = _steps(np.asarray(points, dtype=float), closed)
        if drawn:
            self._parts.append(f'<path d="{drawn}"{_pen(colour, width, dash)} fill="{fill}"{_within(clip)}/>')

    def areas(self, outlines: Sequence[np.ndarray], fill: str, clip: str = "") -> None:
        """Fill several outlines (k, 2) as one area, one inside another being a hole."""
        drawn = "".join(_steps(outline, closed=True) for outline in outlines)
        if drawn:
            self._parts.append(f'<path d="{drawn}" fill="{fill}" fill-rule="evenodd"{_within(clip)}/>')

    def rectangle(self, box: Box, fill: str, opacity: float = 1.0) -> None:
        """Fill a box."""
        faint = f' opacity="{opacity:g}"' if opacity < 1 else ""
        self._parts.append(f'<rect {_extent(box)} fill="{fill}"{faint}/>')

    def circle(self, place: np.ndarray, radius: float, edge: str, fill: str = "white") -> None:
        """Draw a mark. radius: mm."""
        x, y = _units(place)
        self._parts.append(
            f'<circle cx="{x}" cy="{y}" r="{round(radius * UNITS)}"{_pen(edge, 0.8, "")} fill="{fill}"/>'
        )

    def text(
        self,
        place: np.ndarray | tuple[float, float],
        text: str,
        size: float = SIZE,
        across: str = "left",
        along: str = "bottom",
        colour: str = "black",
        paper: bool = False,
        turned: bool = False,
    ) -> None:
        """Write one line. across: whether left, middle or right of it stands at `place`; along: bottom, middle or top.

        paper: white behind it. turned: it runs upwards.
        """
        if paper:
            self.rectangle(text_box(place, text, size, across, along), "white", 0.8)
        x, y = _units(place)
        rise = round(_RISES[along] * size * MILLIMETRES_PER_POINT * UNITS)
        anchor = {"left": "start", "middle": "middle", "right": "end"}[across]
        turn = f' transform="rotate(-90 {x} {y})"' if turned else ""
        letters = round(size * MILLIMETRES_PER_POINT * UNITS)
        self._parts.append(
            f'<text x="{x}" y="{y + rise}" font-size="{letters}" text-anchor="{anchor}" fill="{colour}"{turn}>'
            f"{_set(text)}</text>"
        )

    def picture(self, box: Box, png: bytes) -> None:
        """Set a PNG picture into a box."""
        source = base64.b64encode(png).decode()
        self._parts.append(
            f'<image {_extent(box)} preserveAspectRatio="none" image-rendering="optimizeSpeed" '
            f'href="data:image/png;base64,{source}"/>'
        )

    def hatching(self) -> str:
        """Return a fill of slanting lines."""
        step = round(1.2 * UNITS)
        self._parts.append(
            f'<defs><pattern id="hatch" width="{step}" height="{step}" patternUnits="userSpaceOnUse">'
            f'<path d="M0 {step}L{step} 0"{_pen("#595959", 0.4, "")}/></pattern></defs>'
        )
        return "url(#hatch)"

    def clip(self, box: Box) -> str:
        """Return the name under which what leaves `box` is cut off."""
        self._clips += 1
        name = f"clip{self._clips}"
        self._parts.append(f'<defs><clipPath id="{name}"><rect {_extent(box)}/></clipPath></defs>')
        return name

    def svg(self) -> str:
        """Return the figure as SVG text; its labels stay text."""
        size = [round(length / MILLIMETRES_PER_POINT, 3) for length in (self.width, self.height)]
        span = [round(length * UNITS) for length in (self.width, self.height)]
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{size[0]:g}pt" height="{size[1]:g}pt" '
            f'viewBox="0 0 {span[0]} {span[1]}" font-family="DejaVu Sans">\n'
            + "\n".join(self._parts)
            + "\n</svg>\n"
        )


class Symbol(str):
    """A text whose words T_g are a letter with an index."""


def text_box(
    place: np.ndarray | tuple[float, float],
    text: str,
    size: float = SIZE,
    across: str = "left",
    along: str = "bottom",
) -> Box:
    """Return the room that a text takes at `place`, with a hair of air about it."""
    x, y = float(place[0]), float(place[1])
    width, letter, air = text_width(shown(text), size), size * MILLIMETRES_PER_POINT, 0.15
    left = x - {"left": 0.0, "middle": width / 2, "right": width}[across]
    base = y + _RISES[along] * letter
    return Box(left - air, base - 0.78 * letter - air, left + width + air, base + 0.24 * letter + air)


def _set(text: str) -> str:
    return _indexed(text) if isinstance(text, Symbol) else escape(shown(text), quote=False)


def _indexed(text: str) -> str:
    parts, lowered = [], False
    for place, word in enumerate(text.split(" ")):
        letter, _, index = word.partition("_")
        slant = ' font-style="italic"' if index else ""
        back = ' dy="-0.19em"' if lowered else ""
        parts.append(f"<tspan{slant}{back}>{' ' if place else ''}{escape(letter)}</tspan>")
        lowered = bool(index)
        if index:
            parts.append(f'<tspan font-size="75%" dy="0.25em">{escape(index)}</tspan>')
    return "".join(parts)


def _units(place: np.ndarray | tuple[float, float]) -> tuple[int, int]:
    return round(float(place[0]) * UNITS), round(float(place[1]) * UNITS)


def _extent(box: Box) -> str:
    x, y = _units((box.left, box.top))
    return f'x="{x}" y="{y}" width="{round(box.width * UNITS)}" height="{round(box.height * UNITS)}"'


def _within(clip: str) -> str:
    return f' clip-path="url(#{clip})"' if clip else ""


def _pen(colour: str, width: float, dash: str) -> str:
    if colour == "none":
        return ""
    unit = MILLIMETRES_PER_POINT * UNITS
    dashes = " ".join(f"{length * width * unit:.0f}" for length in _DASHES[dash])
    broken = f' stroke-dasharray="{dashes}"' if dashes else ""
    return f' stroke="{colour}" stroke-width="{width * unit:.3g}" stroke-linejoin="round"{broken}'


def _steps(points: np.ndarray, closed: bool) -> str:
    """The path through `points`, in whole units from point to point; points of one place are one."""
    units = np.rint(points[np.isfinite(points).all(axis=1)] * UNITS).astype(np.int64)
    moves = np.diff(units, axis=0)
    moves = moves[moves.any(axis=1)]
    if not len(moves):
        return ""
    begin = f"M{units[0, 0]} {units[0, 1]}l"
    return begin + " ".join(map(str, moves.ravel().tolist())) + ("z" if closed else "")
