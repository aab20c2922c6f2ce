"""Numbers beside marks so that none stands on another: neighbours share one, and each finds a free place."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from rocking.reports.paper.canvas import SMALL, Box, Canvas, text_box

_RADII = (1.6, 2.4, 3.6, 5.5, 8.0, 12.0, 20.0, 40.0, 400.0)
"""Nearness at which marks share a label, mm, tried in turn until every label has a place."""
_DISTANCES = (1.1, 3.0, 6.0, 10.0)
"""From a group of marks to its label, mm; beyond the first a line leads there."""
_SIDES = (
    ("left", "bottom", 1, -1),
    ("right", "bottom", -1, -1),
    ("left", "top", 1, 1),
    ("right", "top", -1, 1),
)
_AXES = (
    ("middle", "bottom", 0, -1),
    ("left", "middle", 1, 0),
    ("right", "middle", -1, 0),
    ("middle", "top", 0, 1),
)
_MARK = 0.9
"""Half the room of a mark, mm."""
_CROSSED = 0.3
"""What a point of a curve below a label counts, when a mark below it counts 1."""


@dataclass(frozen=True)
class Label:
    """A text at a place of the paper (mm), and where the line begins that leads to it (None: it stands beside)."""

    text: str
    place: tuple[float, float]
    across: str
    along: str
    leader: tuple[float, float] | None

    @property
    def box(self) -> Box:
        return text_box(self.place, self.text, SMALL, self.across, self.along)


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
    places: np.ndarray, numbers: Sequence[int], box: Box, curve: np.ndarray | None = None
) -> list[Label]:
    """Return the labels of marks at `places` (k, 2) mm within `box`, none on another.

    numbers: what each mark is called. curve: (m, 2) mm, points that a label had better not cover.
    """
    if not len(places):
        return []
    for radius in _RADII:
        groups = _groups(places, radius)
        found = _placed(
            [places[group] for group in groups],
            [ranges([numbers[each] for each in group]) for group in groups],
            box,
            places,
            curve,
        )
        if len(found) == len(groups):
            return found
    return found


def draw_labels(canvas: Canvas, labels: Sequence[Label], colour: str = "black") -> None:
    """Write labels with the lines that lead to them."""
    for label in labels:
        if label.leader is not None:
            ends = np.array([label.leader, _nearest(label.box, label.leader)])
            canvas.path(ends, colour, 0.3)
        canvas.text(label.place, label.text, SMALL, label.across, label.along, colour, paper=True)


def _groups(places: np.ndarray, radius: float) -> list[list[int]]:
    """Indices of marks that a chain of steps of `radius` joins."""
    near = np.hypot(*(places[:, np.newaxis] - places[np.newaxis]).transpose(2, 0, 1)) < radius
    left, groups = set(range(len(places))), []
    while left:
        group, reached = set(), {min(left)}
        while reached:
            group |= reached
            reached = {int(each) for each in np.flatnonzero(near[list(reached)].any(axis=0))} - group
        left -= group
        groups.append(sorted(group))
    return groups


def _placed(
    groups: Sequence[np.ndarray], texts: Sequence[str], box: Box, marks: np.ndarray, curve: np.ndarray | None
) -> list[Label]:
    """The labels that find a place, those of the groups with the least room first."""
    found: list[Label] = []
    for which in sorted(range(len(groups)), key=lambda each: -len(texts[each])):
        candidates = [each for each in _candidates(groups[which], texts[which]) if box.holds(each.box)]
        free = [each for each in candidates if not any(each.box.meets(other.box) for other in found)]
        if not free:
            return found
        found.append(min(free, key=lambda each: _cost(each, marks, curve)))
    return found


def _candidates(group: np.ndarray, text: str) -> Iterator[Label]:
    (left, top), (right, bottom) = group.min(axis=0), group.max(axis=0)
    middle = ((left + right) / 2, (top + bottom) / 2)
    for distance in _DISTANCES:
        for across, along, x, y in (*_SIDES, *_AXES):
            away = distance / np.hypot(x, y)
            edge = (
                right if x > 0 else left if x < 0 else middle[0],
                bottom if y > 0 else top if y < 0 else middle[1],
            )
            place = (float(edge[0] + x * away), float(edge[1] + y * away))
            near = group[np.hypot(*(group - place).T).argmin()]
            leader = (
                None if distance == _DISTANCES[0] and len(group) == 1 else (float(near[0]), float(near[1]))
            )
            yield Label(text, place, across, along, leader)


def _cost(label: Label, marks: np.ndarray, curve: np.ndarray | None) -> float:
    """Marks and points of the curve below a label, and how far it stands from its own mark."""
    box = label.box
    covered = float(_within(box, marks, _MARK)) + (
        0.0 if curve is None else _CROSSED * _within(box, curve, 0.0)
    )
    away = 0.0 if label.leader is None else float(np.hypot(*np.subtract(label.place, label.leader)))
    return covered + 0.1 * away


def _within(box: Box, points: np.ndarray, air: float) -> int:
    x, y = points.T
    inside = (x > box.left - air) & (x < box.right + air) & (y > box.top - air) & (y < box.bottom + air)
    return int(inside.sum())


def _nearest(box: Box, place: tuple[float, float]) -> tuple[float, float]:
    return min(max(place[0], box.left), box.right), min(max(place[1], box.top), box.bottom)
