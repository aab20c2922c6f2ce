"""Drawings of structures and of the ground, read back from what was drawn."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocking.reports.drawings import MOST_POINTS, draw_structure, fallen_rotation, sketch, thinned
from rocking.reports.explore import drawings
from rocking.reports.record import ground_strip, structure_row
from rocking.reports.style import COMMON, glyphs
from rocking.signal.measures import record_measures
from rocking.structures import Arch, Block, Facade, LoadedWall, Wall, structure_from_config
from rocking.structures.building_parts import FreeWall

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
    assert [patch.get_fill() for patch in axes.patches] == [True, True, False, False]


def test_a_figure_draws_leaves_the_rest_of_a_wall_a_front_and_an_arc():
    axes, front, arch = Figure().subplots(3)
    leaves = FreeWall.of_size(0.5, 3.0, leaves=(0.25, 0.25), bonders=(0.8,))
    draw_structure(axes, leaves, rest=[np.eye(3, 2)])
    assert len(axes.lines) == sum("<polyline" in shape for shape in sketch(leaves, 0.0, 12, 14)) == 3
    assert len(axes.patches) == 2
    gable = structure_from_config({"type": "gable", "height_m": 3.0, "thickness_m": 0.5})
    assert len(gable.plot(axes=front, dimensions=True).patches) == 2
    assert STRUCTURES[2].plot(axes=arch, dimensions=True).texts


def _lines(svg):
    """The points (k, 2) of each line of a picture, upwards from its lower left corner, mm."""
    height = float(re.search(r'height="([\d.]+)mm"', svg)[1])
    for points in re.findall(r'points="([^"]*)"', svg):
        places = np.array([[float(part) for part in point.split(",")] for point in points.split()])
        yield places * [1, -1] + [0, height]


def test_the_strip_shows_the_motion_while_it_shakes_and_its_pulse_at_one_scale(example):
    strip = ground_strip(example.motion)
    motion, _, pulse = _lines(strip.svg)  # the sine on white
    record, (sine, *_) = example.motion.accelerogram, example.motion.pulses
    assert motion[[0, -1], 0] == pytest.approx([0, 118], abs=1)  # a sample or two
    peak = np.abs(motion[:, 1] - 10).max()
    assert peak == pytest.approx(10 / 1.05, abs=1e-3)
    assert np.abs(pulse[:, 1] - 10).max() / peak == pytest.approx(
        abs(sine.amplitude) / record.peak_acceleration, rel=1e-3
    )
    begin, end = example.motion.span
    assert pulse[-1, 0] - pulse[0, 0] == pytest.approx(
        118 * (sine.end_time - sine.start_time) / (end - begin), abs=1e-2
    )


PRESSED = LoadedWall(1.6, 1.4, 0.4, 2e4, top_load=6e4, eccentricity=0.1, restitution=0.9)
TIED = Facade(
    (4.0,), (0.5,), 18e3, restitution=0.8, behind="cross_walls", tie_heights=(3.8,), tie_stiffness=5e6, tie_strength=5e3
)  # fmt: skip


@pytest.mark.parametrize(("structure", "parts", "hinges", "heads", "marks"), [
    (PRESSED, 2, 3, 1, {"stroke-width=\"0.78\"": 4, "#009E73": 1}),  # four supports, and the load with its head
    (TIED, 1, 1, 0, {"#0072B2": 3}),  # a tie with its two plates
])  # fmt: skip
def test_a_sketch_has_the_parts_turned_and_at_rest_the_hinges_and_what_acts(
    structure, parts, hinges, heads, marks
):
    shapes = sketch(structure, 0.1, 12, 14)
    polygons = [shape for shape in shapes if shape.startswith("<polygon")]
    looks = (
        ("#c7c7c7", parts),
        ("stroke-dasharray", parts),
        ('fill="white"', hinges),
        ('fill="#009E73"', heads),
    )
    assert [sum(look in shape for shape in polygons) for look, _ in looks] == [count for _, count in looks]
    lines = [shape for shape in shapes if shape.startswith("<polyline")]
    assert {look: sum(look in shape for shape in lines) for look in marks} == marks
    assert len(polygons) + len(lines) == len(shapes) == 2 * parts + hinges + heads + sum(marks.values())
    for head, arrow in zip(polygons[len(polygons) - heads :], lines, strict=False):
        (tip, *barbs), (tail, end) = (next(iter(_lines(f'height="0mm" {shape}'))) for shape in (head, arrow))
        assert tip == pytest.approx(end) and np.dot(np.mean(barbs, axis=0) - tip, tail - tip) > 0


def test_common_letters_need_no_font_of_the_machine():
    assert set(COMMON) <= glyphs()


def test_page_one_draws_the_mechanism_at_four_fifths_of_the_critical_rotation_on_its_side(example):
    """The dashed outline at rest is drawn after the turned one; both are as like as pictures of two sizes."""
    name = "block 4 m"
    (conclusion,) = (
        one_conclusion for one_conclusion in example.conclusions if one_conclusion.row.structure == name
    )
    block = example.structures[name]
    critical = block.mechanism().critical_rotation
    for side in (1, -1):
        turned = replace(conclusion, row=replace(conclusion.row, peak_side=side))
        row = structure_row(turned, example.structures[turned.row.structure])
        drawn, at_rest, *_ = _lines(row.drawing[0].svg)
        outlines = [block.outline(rotation)[0] for rotation in (0.8 * side * critical, 0.0)]
        scale = np.ptp(drawn, axis=0) / np.ptp(outlines[0], axis=0)
        assert scale[0] == pytest.approx(scale[1], rel=2e-3)  # rounded to a micrometre
        moved = drawn[0] - scale[0] * outlines[0][0]
        for points, outline in zip((drawn, at_rest), outlines, strict=True):
            np.testing.assert_allclose(points, scale[0] * outline + moved, atol=0.02)
            assert (points > 0).all() and (points < [12, 14]).all()


def test_a_thinned_trace_keeps_its_peaks_and_few_points():
    times = np.arange(200_000) * 0.005
    values = np.random.default_rng(1).normal(size=times.size)
    envelope_times, envelope = thinned(times, values)
    assert envelope.size <= MOST_POINTS and (envelope.min(), envelope.max()) == (values.min(), values.max())
    assert np.array_equal(np.interp(envelope_times, times, values), envelope)
    assert thinned(times[:100], values[:100])[1].size == 100


def test_a_wall_is_drawn_as_fallen_by_the_rotation_of_the_side_it_falls_to():
    away, back = PRESSED.mechanism().sides
    assert away.critical_rotation != pytest.approx(back.critical_rotation, rel=0.1)
    share = fallen_rotation(PRESSED, 1) / away.critical_rotation
    assert fallen_rotation(PRESSED, -1) == pytest.approx(-share * back.critical_rotation, rel=1e-12)


def test_a_trace_spans_the_shaking_and_its_pulse_with_a_margin(example):
    (motion,) = example.motions
    measured = record_measures(motion.accelerogram).significant_times
    begin, end = min(measured[0], motion.pulses[0].start_time), max(measured[1], motion.pulses[0].end_time)
    margin = 0.15 * (end - begin)
    assert motion.span == pytest.approx((max(0.0, begin - margin), end + margin))


def test_a_front_is_drawn_on_its_way_down_to_three_times_the_critical_rotation_of_each_side():
    """Two leaves of 0.6 and 0.3 m, each 3 m high: their middle lies 0.25 m from the outer face, 2.5 m up."""
    front = Facade((3.0, 3.0), (0.6, 0.3), 20e3, crack_height=0.0)
    rotations = [frame["rotation"] for frame in drawings(front)]
    assert max(rotations) == pytest.approx(3 * math.atan2(0.25, 2.5), rel=1e-9)
    assert min(rotations) == pytest.approx(-3 * math.atan2(0.35, 2.5), rel=1e-9)
