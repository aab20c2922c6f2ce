"""Drawings of structures and the figures of a record, read back from what matplotlib was given."""

import itertools
import math

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocking.assessment.verdict import Verdict
from rocking.records.measures import record_measures
from rocking.reports.drawings import draw_structure, fallen_rotation
from rocking.reports.record_figures import drawn_rotation, ground_figure, pulses_figure, strip_figure
from rocking.reports.style import MOST_POINTS, TEXT_WIDTH, thinned
from rocking.structures import Arch, Block, LoadedWall, Wall

from .conftest import fate

STRUCTURES = [Block.of_size(1.0, 4.0), Wall(1.6, 1.4, 0.4), Arch(10, 1.5, 2.75)]


@pytest.mark.parametrize("structure", STRUCTURES)
def test_the_drawn_rotations_exist(structure):
    side = structure.mechanism().positive
    assert side.critical_rotation < fallen_rotation(structure, 1) < side.end_rotation
    assert fallen_rotation(structure, -1) < 0
    one_sided = Block.of_size(0.6, 6.0, restitution=0.5, one_sided=True)
    assert fallen_rotation(one_sided, -1) == fallen_rotation(one_sided, 1) > 0


def test_a_structure_is_drawn_as_its_outline():
    axes = Figure().subplots()
    draw_structure(axes, STRUCTURES[1], 0.1)
    drawn = [patch.get_xy()[:-1] for patch in axes.patches]
    for points, outline in zip(drawn, [*STRUCTURES[1].outline(0.1), *STRUCTURES[1].outline()], strict=True):
        assert np.array_equal(points, outline)


def test_page_one_draws_a_structure_as_it_fell_rocked_or_stands():
    block, critical = STRUCTURES[0], STRUCTURES[0].mechanism().critical_rotation
    assert drawn_rotation(block, fate(Verdict.STANDS, 0.0)) == 0
    assert drawn_rotation(block, fate(Verdict.STANDS, 0.4, peak_side=-1)) == pytest.approx(-0.4 * critical)
    assert drawn_rotation(block, fate(Verdict.OVERTURNS, math.inf)) > critical
    assert drawn_rotation(block, fate(Verdict.UNDECIDED, math.inf, peak_side=-1)) < -critical


def test_a_thinned_trace_keeps_its_peaks_and_few_points():
    times = np.arange(200_000) * 0.005
    values = np.random.default_rng(1).normal(size=times.size)
    envelope_times, envelope = thinned(times, values)
    assert envelope.size <= MOST_POINTS and (envelope.min(), envelope.max()) == (values.min(), values.max())
    assert np.array_equal(np.interp(envelope_times, times, values), envelope)
    assert thinned(times[:100], values[:100])[1].size == 100


def test_a_wall_is_drawn_as_fallen_by_the_rotation_of_the_side_it_falls_to():
    wall = LoadedWall(1.6, 1.4, 0.4, 2e4, top_load=6e4, eccentricity=0.1, restitution=0.9)
    away, back = wall.mechanism().sides
    assert away.critical_rotation != pytest.approx(back.critical_rotation, rel=0.1)
    share = fallen_rotation(wall, 1) / away.critical_rotation
    assert fallen_rotation(wall, -1) == pytest.approx(-share * back.critical_rotation, rel=1e-12)


def test_every_panel_stands_in_its_figure_and_shows_all_of_what_it_draws(example):
    """No panel on another or over the edge; no point of a trace and no name of a strip beyond its limits."""
    (motion,) = example.motions
    measured = record_measures(motion.accelerogram).significant_times
    begin, end = min(measured[0], motion.pulses[0].start_time), max(measured[1], motion.pulses[0].end_time)
    margin = 0.15 * (end - begin)
    assert motion.span == pytest.approx((max(0.0, begin - margin), end + margin))
    several = [motion, motion]
    strip = strip_figure(example.fates, example.structures, example.labels, example.peak_acceleration)
    for figure in (ground_figure(several), pulses_figure(several), strip):
        assert figure.get_figwidth() * 25.4 == pytest.approx(TEXT_WIDTH)
        boxes = [axes.get_position() for axes in figure.axes]
        assert all(0 <= box.xmin < box.xmax <= 1 and 0 <= box.ymin < box.ymax <= 1 for box in boxes)
        assert not any(one.overlaps(other) for one, other in itertools.combinations(boxes, 2))
        for axes in figure.axes:
            (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
            heights = np.concatenate(
                [line.get_ydata() for line in axes.lines if line.get_transform() == axes.transData] or [[low]]
            )
            assert low <= heights.min() and heights.max() <= high
            places = [text.get_position()[0] for text in axes.texts if text.get_transform() == axes.transData]
            assert all(left <= place <= right for place in places)
    texts = {text.get_text() for text in strip.axes[0].texts}
    assert texts.issuperset(example.labels.values())
