"""Figures on paper: scales, thinning, letters, labels that leave one another alone, and the SVG they become."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.textpath import TextPath

from rocking.reports.paper.canvas import Box, Canvas, Symbol, text_box
from rocking.reports.paper.labels import placed_labels, ranges
from rocking.reports.paper.letters import elided, text_width
from rocking.reports.paper.panel import RESOLVED, Panel, thinned
from rocking.reports.paper.scales import Scale

from .drawn import paths, texts, tree

PAPER = Box(10, 5, 80, 50)


def test_a_thinned_trace_keeps_its_extremes_and_its_order():
    times = np.arange(100_000) * 0.01
    values = np.sin(times) + 0.1 * np.random.default_rng(0).normal(size=times.size)
    few, kept = thinned(times, values, 150.0)
    assert few.size <= 2 * math.ceil(150.0 / RESOLVED)
    assert (kept.max(), kept.min()) == (values.max(), values.min())
    assert np.all(np.diff(few) > 0)
    assert np.isin(few, times).all()


@given(st.integers(10, 5000), st.floats(1.0, 40.0), st.integers(0, 2**32 - 1))
def test_a_thinned_trace_is_nowhere_farther_from_the_trace_than_paper_shows(size, width, seed):
    """Each sample lies between two kept ones that stand within the stretches beside it."""
    values = np.random.default_rng(seed).normal(size=size)
    times = np.arange(size, dtype=float)
    few, kept = thinned(times, values, width)
    reach = 2 * (math.ceil(size * RESOLVED / width) + 1)
    for place in range(0, size, max(1, size // 50)):
        near = kept[np.abs(few - place) <= reach]
        assert near.min() <= values[place] <= near.max()


def test_a_short_trace_is_not_thinned():
    values = np.arange(1000.0)
    assert thinned(values, values, 80.0)[1] is values


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e6), st.integers(1, 12))
def test_ticks_are_few_round_and_on_the_axis(low, length, most):
    scale = Scale(low, low + length)
    if scale.high - scale.low < 1e-9 * abs(low):
        return
    ticks = scale.ticks(most)
    assert 1 <= len(ticks) <= most + 1
    if len(ticks) > 1:
        # the values are rounded to 12 digits
        assert all(low - 1e-6 * length - 1e-12 <= tick <= low + length * (1 + 1e-6) + 1e-12 for tick in ticks)
        assert np.ptp(np.diff(ticks)) <= 1e-6 * length


@given(st.floats(1e-6, 1e4), st.floats(1.2, 1e8), st.integers(2, 12))
def test_logarithmic_ticks_are_round_and_on_the_axis(low, factor, most):
    ticks = Scale(low, low * factor, logarithmic=True).ticks(most)
    assert 1 <= len(ticks) <= most
    assert ticks == sorted(ticks)
    if len(ticks) > 1:
        assert low * (1 - 1e-6) <= ticks[0] and ticks[-1] <= low * factor * (1 + 1e-6)
        assert all(f"{tick:.0e}"[0] in "12357" for tick in ticks)


@pytest.mark.parametrize("ends", [(1.0, 1.0), (2.0, 1.0)])
def test_an_axis_without_room_is_refused(ends):
    with pytest.raises(ValueError, match="no room"):
        Scale(*ends)


@pytest.mark.parametrize("text", ["rotation", "0.25", "Ж Ω", "frequency parameter p [rad/s]"])
def test_a_text_is_as_wide_as_its_letters(text):
    """Against the outlines of the letters, which lack the air before the first and after the last one."""
    outline = TextPath((0, 0), text, size=10).get_extents().width * 25.4 / 72
    assert 0 <= text_width(text, 10) - outline <= 0.15 * 10 * 25.4 / 72 * 2


def test_an_elided_text_is_a_beginning_with_an_ellipsis():
    assert elided("short", 10) == "short"
    assert elided("a" * 30, 10) == "a" * 9 + "…"
    assert len(elided("Ж" * 30, 10)) < 10


def test_what_no_font_of_the_figure_holds_becomes_a_box():
    assert elided("Ж中文", 10) == "Ж□□"


@pytest.mark.parametrize("text", ["$x^$", "#panic(1)", "<b>&amp;", "Ω Ж", 'a "quoted" name', "T_g"])
def test_a_text_is_text_and_not_markup(text):
    canvas = Canvas(50, 20)
    canvas.text((10, 10), text)
    (written,) = texts(canvas.svg())
    assert written.text == text and (written.x, written.size) == (10.0, pytest.approx(7.5, rel=2e-3))


def test_a_symbol_has_an_index():
    canvas = Canvas(50, 20)
    canvas.text((10, 10), Symbol("I_A = 3 m/s, D_5–95 = 7 s"))
    assert texts(canvas.svg())[0].text == "IA = 3 m/s, D5–95 = 7 s"


def test_a_line_goes_through_its_values_and_stays_finite():
    canvas = Canvas(100, 60)
    panel = Panel(canvas, PAPER, Scale(0, 10), Scale(1, 100, logarithmic=True))
    panel.line(np.array([0.0, 5.0, 7.0, 10.0]), np.array([1.0, 10.0, np.nan, 1e300]), "black")
    (line,) = paths(canvas.svg(), "black")
    assert line[:2] == pytest.approx(np.array([[10, 50], [45, 27.5]]))
    assert len(line) == 3 and np.abs(line).max() < 1e4
    assert tree(canvas.svg()).get("viewBox") == "0 0 10000 6000"


def test_numbers_in_a_row_are_a_range():
    assert ranges([3, 1, 2, 7, 9, 10]) == "1–3, 7, 9, 10"


def _spread(kind: str, many: int) -> np.ndarray:
    random = np.random.default_rng(many)
    shares = {
        "anywhere": random.random((many, 2)),
        "in a heap": 0.5 + 0.02 * random.normal(size=(many, 2)),
        "in a row": np.column_stack((np.linspace(0.05, 0.95, many), np.full(many, 0.4))),
        "at one place": np.full((many, 2), 0.3),
        "in a corner": 1 - 0.05 * random.random((many, 2)),
    }[kind]
    return np.array([PAPER.left, PAPER.top]) + shares * np.array([PAPER.width, PAPER.height])


@pytest.mark.parametrize("kind", ["anywhere", "in a heap", "in a row", "at one place", "in a corner"])
@pytest.mark.parametrize("many", [1, 3, 10, 40])
def test_every_mark_is_named_once_and_no_label_stands_on_another(kind, many):
    labels = placed_labels(_spread(kind, many), range(1, many + 1), PAPER)
    boxes = [text_box(label.middle, label.text, 7.0, "middle", "middle") for label in labels]
    for place, box in enumerate(boxes):
        assert PAPER.holds(box)
        assert not any(box.meets(other) for other in boxes[:place])
    named: list[int] = []
    for part in ", ".join(label.text for label in labels).split(", "):
        first, _, last = part.partition("–")
        named += range(int(first), int(last or first) + 1)
    assert sorted(named) == list(range(1, many + 1))
