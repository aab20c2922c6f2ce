"""Drawings of structures."""

import numpy as np
import pytest

from rocking.reports.record.structure_figures import drawn_rotation, round_length, structure_drawings
from rocking.structures import Arch, Block, Wall

STRUCTURES = [
    ("block", Block.of_size(1.0, 4.0)),
    ("wall", Wall(1.6, 1.4, 0.4)),
    ("arch", Arch(10, 1.5, 2.75)),
]


@pytest.mark.parametrize(("length", "rounded"), [(1.0, 1.0), (4.9, 2.0), (5.0, 5.0), (0.199, 0.1), (37, 20)])
def test_scale_bars_are_one_two_or_five(length, rounded):
    assert round_length(length) == pytest.approx(rounded, rel=1e-12)


@pytest.mark.parametrize("structure", [structure for _, structure in STRUCTURES])
def test_the_drawn_rotation_exists(structure):
    assert 0 < drawn_rotation(structure) < structure.mechanism().positive.end_rotation


def test_a_structure_is_drawn_to_the_scale_of_its_bar():
    """A block 1 m wide at rest is as many bar lengths wide as the bar says."""
    panel = structure_drawings(STRUCTURES[:1]).axes[0]
    at_rest = next(patch for patch in panel.patches if not patch.get_fill())
    width = np.ptp(at_rest.get_xy()[:, 0])
    bar = next(line for line in panel.lines if line.get_linewidth() == 1.5)
    metres = float(
        next(text.get_text() for text in panel.texts if text.get_text().endswith(" m")).removesuffix(" m")
    )
    assert width / np.ptp(bar.get_xdata()) * metres == pytest.approx(1.0, rel=1e-9)


def test_no_drawing_leaves_the_paper_or_meets_its_neighbour():
    figure = structure_drawings(STRUCTURES * 4)
    panel = figure.axes[0]
    cells = {}
    for patch in panel.patches:
        points = patch.get_xy()
        cell = int(points[:, 0].mean() // 34), int(-points[:, 1].mean() // 43)
        cells.setdefault(cell, []).append(points)
    assert len(cells) == 12
    for (column, row), parts in cells.items():
        points = np.vstack(parts)
        assert 34 * column <= points[:, 0].min() and points[:, 0].max() <= 34 * (column + 1)
        assert -43 * (row + 1) <= points[:, 1].min() and points[:, 1].max() <= -43 * row
