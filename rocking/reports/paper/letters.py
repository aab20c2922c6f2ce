"""The letters of a figure: which there are, how wide they are, and names cut to the room they have."""

from functools import cache
from pathlib import Path

import matplotlib
from matplotlib.ft2font import FT2Font

FONT_FOLDER = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
MILLIMETRES_PER_POINT = 25.4 / 72
_FONT = FONT_FOLDER / "DejaVuSans.ttf"
_UNIT = 2048
"""Units of the font to its size."""


@cache
def _font() -> FT2Font:
    return FT2Font(str(_FONT))


@cache
def glyphs() -> frozenset[int]:
    """Return the code points that the fonts of the figures and of the page hold."""
    return frozenset(_font().get_charmap())


def shown(text: str) -> str:
    """Return `text` with a box for each character that no font of the figure holds."""
    return "".join(letter if ord(letter) in glyphs() else "□" for letter in text)


def elided(text: str, length: float) -> str:
    """Return `text` as a figure can show it: cut to the width of about `length` small letters, the last one an
    ellipsis if something was cut, and a box for each character that no font of the figure holds.
    """
    width = 0.0
    readable = shown(text)
    for place, letter in enumerate(readable):
        width += 1.0 if letter.isascii() and not letter.isupper() else 1.6
        if width > length:
            return readable[: max(place - 1, 0)] + "…"
    return readable


def text_width(text: str, size: float) -> float:
    """Return the width of `text` at `size` points, mm, without kerning."""
    return sum(map(_advance, text)) / _UNIT * size * MILLIMETRES_PER_POINT


@cache
def _advance(letter: str) -> int:
    from matplotlib.ft2font import LoadFlags

    return int(_font().load_char(ord(letter), flags=LoadFlags.NO_SCALE).horiAdvance)
