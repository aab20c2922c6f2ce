"""Numbers beside marks so that none stands on another: neighbours share one, and each finds a free place."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocking.reports.paper.canvas import SMALL, Box, Canvas, text_box

_RADII = (1.6, 2.4, 3.2, 4.5, 6.0, 8.0, 12.0, 20.0, 40.0, 400.0)
"""Nearness at which marks share a label, mm, tried in turn until every label has a place."""
_MARK = 0.9
"""Half the room of a mark, mm."""
_REACH, _STEP = 24.0, 1.5
"""How far from its mark a label is sought a place, and in what steps, mm."""
_ADJACENT = 1.3
"""Up to this distance a label needs no line to its mark, mm."""
_TRIED = 60
"""Free places whose line to the mark is looked at, the nearest first."""
_CROSSED = 3.0
"""What a point of a curve below a label counts, mm of distance from its mark."""


@dataclass(frozen=True)
class Label:
    """A text about its middle (mm of the paper), and the marks (k, 2) that it names."""

    text: str
    middle: tuple[float, float]
    marks: np.ndarray

    @property
    def box(self) -> Box:
        return text_box(self.middle, self.text, SMALL, "middle", "middle")

    @property
    def line(self) -> np.ndarray:
        """The line (2, 2) from the nearest mark to the label; none (0, 2) where it stands beside its only mark."""
        box = self.box
        ends = np.clip(self.marks, (box.left, box.top), (box.right, box.bottom))
        away = np.hypot(*(ends - self.marks).T)
        nearest = int(away.argmin())
        if len(self.marks) == 1 and away[nearest] <= _ADJACENT:
            return np.empty((0, 2))
        return np.stack((self.marks[nearest], ends[nearest]))


def ranges(numbers: Sequence[int]) -> str:
    """Return whole numbers as ranges: 1–3, 5."""
    runs: list[list[int]] = []
    for number in sorted(numbers):
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(", ".join(map(str, run)) if len(run) < 3 else f"{run[0]}–{run[-1]}" for run in runs)


def placed_labels(
    places: np.ndarray,
    numbers: Sequence[int],
    box: Box,
    curve: np.ndarray | None = None,
    shared: float = _RADII[-1],
) -> list[Label]:
    """Return the labels of marks at `places` (k, 2) mm within `box`, none on another or on a mark.

    numbers: what each mark is called. curve: (m, 2) mm, points that a label had better not cover. shared: up to how
    near marks may share a label, mm; where that leaves some without a place, there is none at all.
    """
    shown = np.empty((0, 2)) if curve is None else curve
    for radius in _RADII if len(places) else ():
        if radius > shared:
            break
        groups = _groups(places, radius)
        texts = [ranges([numbers[each] for each in group]) for group in groups]
        found = _placed([places[group] for group in groups], texts, box, places, shown)
        if len(found) == len(groups):
            return found
    return []


def draw_labels(canvas: Canvas, labels: Sequence[Label]) -> None:
    """Write labels with the lines that lead to them."""
    for label in labels:
        canvas.path(label.line, "black", 0.3)
        canvas.text(label.middle, label.text, SMALL, "middle", "middle", paper=True)


def _groups(places: np.ndarray, radius: float) -> list[list[int]]:
    """Indices of marks, from left to right, each with the first group that begins within `radius` of it."""
    groups: list[list[int]] = []
    for mark in np.lexsort(places.T[::-1]).tolist():
        near = (group for group in groups if np.hypot(*(places[mark] - places[group[0]])) < radius)
        group = next(near, None)
        if group is None:
            groups.append([mark])
        else:
            group.append(mark)
    return [sorted(group) for group in groups]


def _placed(
    groups: Sequence[np.ndarray], texts: Sequence[str], box: Box, marks: np.ndarray, curve: np.ndarray
) -> list[Label]:
    """The labels that find a place clear of marks, labels and the lines to them; the longest chooses first."""
    found: list[Label] = []
    for which in sorted(range(len(groups)), key=lambda each: -len(texts[each])):
        label = _best(groups[which], texts[which], box, marks, curve, found)
        if label is None:
            break
        found.append(label)
    return found


def _best(
    group: np.ndarray, text: str, box: Box, marks: np.ndarray, curve: np.ndarray, others: Sequence[Label]
) -> Label | None:
    """The label of a group in the free place nearest to it; None where there is none."""
    about = text_box((0.0, 0.0), text, SMALL, "middle", "middle")
    reach = np.array([[about.left, about.top], [about.right, about.bottom]])
    lines = np.vstack([np.empty((0, 2)), *(_along(each.line) for each in others)])
    first = np.array([(each.box.left, each.box.top) for each in others]).reshape(-1, 2)
    last = np.array([(each.box.right, each.box.bottom) for each in others]).reshape(-1, 2)
    for middles in (_beside(group, reach), _around(group)):
        low, high = middles + reach[0], middles + reach[1]
        free = (low >= (box.left, box.top)).all(axis=1) & (high <= (box.right, box.bottom)).all(axis=1)
        meets = (low[:, np.newaxis] < last) & (high[:, np.newaxis] > first)
        free &= ~meets.all(axis=2).any(axis=1)
        middles, low, high = middles[free], low[free], high[free]
        free = (_covered(low - _MARK, high + _MARK, marks) == 0) & (_covered(low, high, lines) == 0)
        middles, low, high = middles[free], low[free], high[free]
        ends = np.clip(group, low[:, np.newaxis], high[:, np.newaxis])
        away = np.hypot(*np.moveaxis(ends - group, 2, 0)).min(axis=1)
        for place in np.argsort(away + _CROSSED * _covered(low, high, curve), kind="stable")[:_TRIED]:
            label = Label(text, (float(middles[place, 0]), float(middles[place, 1])), group)
            if not _covered(first, last, _along(label.line)).any():
                return label
    return None


def _beside(group: np.ndarray, reach: np.ndarray) -> np.ndarray:
    """Middles of the eight places about a group of marks, (8, 2). reach: of a label from its middle, (2, 2)."""
    low, high = group.min(axis=0) - reach[1] - _MARK - 0.1, group.max(axis=0) - reach[0] + _MARK + 0.1
    return np.array(
        [
            ((low[0], middle[0], high[0])[x + 1], (low[1], middle[1], high[1])[y + 1])
            for middle in [(low + high) / 2]
            for x in (1, 0, -1)
            for y in (-1, 0, 1)
            if x or y
        ]
    )


def _around(group: np.ndarray) -> np.ndarray:
    """Middles of a grid of places about a group of marks, (k, 2)."""
    steps = np.arange(-_REACH, _REACH + _STEP, _STEP)
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    return (group.min(axis=0) + group.max(axis=0)) / 2 + grid


def _covered(low: np.ndarray, high: np.ndarray, points: np.ndarray) -> np.ndarray:
    """How many of `points` (m, 2) lie in each box from `low` to `high`, (k, 2) each."""
    inside = (points > low[:, np.newaxis]) & (points < high[:, np.newaxis])
    return inside.all(axis=2).sum(axis=1)


def _along(line: np.ndarray) -> np.ndarray:
    """Points along a line, (k, 2)."""
    return np.linspace(line[0], line[1], 25) if len(line) else line
