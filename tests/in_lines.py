"""What a study makes as lines that a person reads, and by which two versions of the package are compared.

A picture is its words and the sums of its places; a long list its length and sums, as is what a long table leaves out.
"""

import base64
import csv
import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from openpyxl import load_workbook

from rocking.reports.pages import Page, as_data

TOLERANCE = 2e-6
"""Of a number: cells are rounded to seven digits."""
OF_SUMS = 2e-4
"""Of a sum, which is rounded to five digits."""
ROUNDING = 1e-12
"""What is left of a zero by another order of addition, in SI units."""
_LONG = 24
"""Numbers of a list from which it is summed."""
_EVERY_FRAME = 16
"""Of the drawings between which a page interpolates, one in so many is compared."""
_MOST_ROWS = 40
"""Rows of a table that are written out."""
_OF_THE_MACHINE = ("sha256", "hash", "version", "package", "libraries")
_HASH = re.compile(r"(?<=settings and structures )[0-9a-f]{16}")
_NUMBER = re.compile(r"(?<![\w.#])[-−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])")


def lines_of(path: Path) -> list[str]:
    """The lines of a file of the results."""
    if path.suffix == ".csv":
        return list(_table(path))
    if path.suffix == ".xlsx":
        sheets = load_workbook(path)
        return [
            f"{sheet.title} {sheet.dimensions}: {' | '.join(str(cell.value) for cell in next(sheet.iter_rows()))}"
            for sheet in sheets
        ]
    text = path.read_text(encoding="utf-8")
    if path.suffix in (".json", ".geojson", ".pdf"):
        return list(_tree(json.loads(text)))
    if path.suffix == ".js":
        return list(_tree(json.loads(text[text.index("(") + 1 : text.rindex(")")])))
    if path.suffix == ".html":
        content = re.search(r'<script type="application/json"[^>]*>(.*?)</script>', text, re.S)
        seen = re.sub(
            r"<[^>]*>", "\n", re.sub(r"<(script|style).*?</\1>|<svg.*?</svg>", "", text, flags=re.S)
        )
        lines = list(_tree(json.loads(content[1]))) if content else []
        return [*filter(None, map(str.strip, seen.splitlines())), *lines]
    return text.splitlines()


def page_in_json(page: Page) -> bytes:
    """What the template of a page is given, in place of the PDF that it would make."""
    return json.dumps(as_data(page), ensure_ascii=False).encode()


def draw_in_lines(figure: Figure, stream: Any, **_: Any) -> None:
    """Write the words of a figure and the sums of what it draws, in place of an image."""
    stream.write("\n".join(["figure", *_figure(figure)]))


def differences(expected: Sequence[str], found: Sequence[str]) -> list[str]:
    """The lines that differ by more than what is left of rounding."""
    pairs = zip(expected, found, strict=False)
    unlike = [f"{one!r} is now {other!r}" for one, other in pairs if not _alike(one, other)]
    if len(expected) != len(found):
        unlike.insert(0, f"{len(found)} lines in place of {len(expected)}")
    return unlike


def _alike(one: str, other: str) -> bool:
    if one == other:
        return True
    words, others = (_NUMBER.sub("#", line) for line in (one, other))
    tolerance = OF_SUMS if " numbers " in one else TOLERANCE
    numbers = zip(_NUMBER.findall(one), _NUMBER.findall(other), strict=False)
    return words == others and all(
        math.isclose(_value(number), _value(number_now), rel_tol=tolerance, abs_tol=ROUNDING)
        for number, number_now in numbers
    )


def _value(number: str) -> float:
    return float(number.replace("−", "-"))


def _table(path: Path) -> Iterator[str]:
    with path.open(encoding="utf-8", newline="") as stream:
        heads, *rows = csv.reader(stream)
    kept = [place for place, head in enumerate(heads) if not head.endswith(_OF_THE_MACHINE)]
    every = math.ceil(len(rows) / _MOST_ROWS)
    for row in [heads, *rows[:: max(every, 1)]]:
        yield " | ".join(_cell(row[place]) for place in kept)
    if every > 1:
        columns = ((heads[place], [row[place] for row in rows]) for place in kept)
        yield " | ".join(f"{head}: {_summed(_finites(cells))}" for head, cells in columns)


def _cell(text: str) -> str:
    number = _finite(text)
    return text if number is None or len(text) < 8 else f"{number:.7g}"


def _finite(text: str) -> float | None:
    try:
        return value if math.isfinite(value := float(text)) else None
    except ValueError:
        return None


def _finites(cells: Iterable[str]) -> Iterator[float]:
    return (value for value in map(_finite, cells) if value is not None)


def _summed(values: Iterable[float]) -> str:
    """A list by its length, its sum, and a sum that knows the order, of magnitudes: what cancels keeps no digits."""
    sizes = np.abs(np.fromiter(values, dtype=float))
    return f"{sizes.size} numbers {sizes.sum():.5g} {sizes @ np.arange(1, sizes.size + 1):.5g}"


def _tree(thing: Any, key: str = "", indent: str = "") -> Iterator[str]:
    """What JSON holds, a line for each text and each list of them; what is empty is left out."""
    if key.endswith(_OF_THE_MACHINE) or thing in ("", None, [], {}):
        return
    if isinstance(thing, Mapping) or (isinstance(thing, list) and not _is_plain(thing)):
        every = _EVERY_FRAME if key == "frames" else 1
        pairs = thing.items() if isinstance(thing, Mapping) else (("-", item) for item in thing[::every])
        yield f"{indent}{key}:"
        for name, value in pairs:
            yield from _tree(value, name, indent + " ")
    elif key == "svg":
        for line in _drawing(thing):
            yield f"{indent}{line}"
    elif key == "data":
        yield f"{indent}{key}: {_summed(_samples(thing))}"
    else:
        yield f"{indent}{key}: {_plain(thing)}"


def _is_plain(things: list[Any]) -> bool:
    """Whether a list holds texts and numbers alone, or nothing but numbers at any depth."""
    return not any(isinstance(thing, list | Mapping) for thing in things) or _numbers(things) is not None


def _numbers(thing: Any) -> list[float] | None:
    """All numbers of a list of lists; None where it holds anything else."""
    if isinstance(thing, list):
        parts = [_numbers(item) for item in thing]
        return None if None in parts else [number for part in parts for number in part or ()]
    return [float(thing)] if isinstance(thing, int | float) and not isinstance(thing, bool) else None


def _plain(thing: Any) -> str:
    if isinstance(thing, list):
        numbers = _numbers(thing)
        if numbers and len(numbers) > _LONG:
            return _summed(numbers)
        return " | ".join(map(_plain, thing))
    if isinstance(thing, float):
        return f"{thing:.7g}"
    return _HASH.sub("HASH", str(thing).replace("\n", " / "))


def _samples(text: str) -> np.ndarray:
    content = base64.b64decode(text)
    return np.frombuffer(content[: len(content) // 2 * 2], "<i2").astype(float)


def _drawing(svg: str) -> Iterator[str]:
    if svg.startswith("figure\n"):
        yield from svg.splitlines()
        return
    texts = re.findall(r"<text[^>]*>([^<]*)</text>", svg)
    yield f"drawing: {' | '.join(texts)} {svg.count('<')} shapes, {_summed(map(float, re.findall(_PLACE, svg)))}"


_PLACE = r"(?<![\w#.-])-?\d+(?:\.\d+)?(?![\w])"
"""A number of a drawing, but none of a colour."""


def _figure(figure: Figure) -> Iterator[str]:
    yield from (text.get_text() for text in figure.texts)
    for axes in figure.axes:
        yield f"axes {axes.get_xscale()} {axes.get_yscale()} {_plain([*axes.get_xlim(), *axes.get_ylim()])}"
        legend = axes.get_legend()
        texts = [
            axes.title,
            axes.xaxis.label,
            axes.yaxis.label,
            *axes.texts,
            *(legend.texts if legend else ()),
        ]
        yield from (f" {text.get_text()}".replace("\n", " / ") for text in texts if text.get_text())
        for line in axes.lines:
            yield f" line {line.get_color()} {line.get_linestyle()} {_finite_sum(line.get_xydata())}"
        for many in axes.collections:
            places = [many.get_offsets(), *(path.vertices for path in many.get_paths())]
            yield f" marks {_finite_sum(np.concatenate([np.asarray(place) for place in places]))}"
        yield f" {len(axes.patches)} patches"


def _finite_sum(points: Any) -> str:
    values = np.asarray(points, dtype=float).ravel()
    return _summed(values[np.isfinite(values)])
