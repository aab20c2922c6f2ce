"""Drawings of structures."""

import numpy as np
import pytest

from rocking.reports.record.structure_figures import drawn_rotation, round_length, structure_drawings
from rocking.structures import Arch, Block, Wall
from rocking.structures.structure_list import TYPES, structure_from_config

from .drawn import paths, texts

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
    svg = structure_drawings(STRUCTURES[:1]).svg()
    at_rest = next(line for line in paths(svg, "black") if len(line) == 4)
    bar = next(line for line in paths(svg, "black", stroke_width="52.9") if len(line) == 2)
    metres = float(
        next(each.text for each in texts(svg) if each.text.endswith(" m") and "=" not in each.text)[:-2]
    )
    # whole hundredths of a millimetre
    assert np.ptp(at_rest[:, 0]) / np.ptp(bar[:, 0]) * metres == pytest.approx(1.0, rel=0.01)


def test_no_drawing_leaves_the_paper_or_meets_its_neighbour():
    svg = structure_drawings(STRUCTURES * 4).svg()
    cells = {}
    for points in paths(svg, "#666666") + [line for line in paths(svg, "black") if len(line) > 2]:
        cells.setdefault((int(points[:, 0].mean() // 34), int(points[:, 1].mean() // 43)), []).append(points)
    assert len(cells) == 12
    for (column, row), parts in cells.items():
        points = np.vstack(parts)
        assert 34 * column <= points[:, 0].min() and points[:, 0].max() <= 34 * (column + 1)
        assert 43 * row <= points[:, 1].min() and points[:, 1].max() <= 43 * (row + 1)


def example_of(kind):
    example = {
        field.key: field.said.example
        for field in TYPES[kind].forms()[0].fields
        if field.required or field.unit
    }
    return structure_from_config({"type": kind, **example})


@pytest.mark.parametrize("kind", TYPES)
def test_every_type_is_drawn_with_the_letters_of_its_dimensions(kind):
    structure = example_of(kind)
    svg = structure_drawings([("one", structure)]).svg()
    written = {each.text for each in texts(svg)}
    assert {"one"} | {dimension.letter for dimension in structure.dimensions()} <= written
    assert hash(structure) == hash(example_of(kind))  # a study's drawings are kept by it
