"""The style sheet, thinning and the bytes of a figure."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from rocking.reports.style import elided, new_figure, styled, svg, thinned


def test_a_thinned_trace_keeps_its_extremes_and_its_order():
    times = np.arange(100_000) * 0.01
    values = np.sin(times) + 0.1 * np.random.default_rng(0).normal(size=times.size)
    few, kept = thinned(times, values)
    assert few.size <= 4000
    assert (kept.max(), kept.min()) == (values.max(), values.min())
    assert np.all(np.diff(few) > 0)


def test_a_short_trace_is_not_thinned():
    values = np.arange(4000.0)
    assert thinned(values, values)[1] is values


@styled
def _drawing(label: str) -> Figure:
    figure = new_figure(40)
    panel = figure.subplots()
    panel.plot([0, 1], [0, 1])
    panel.set_title(label)
    return figure


@pytest.mark.parametrize("label", ["$x^$", "#panic(1)", "<b>", "Ω Ж"])
def test_a_label_is_text_and_not_markup(label):
    drawn = svg(_drawing(label))
    escaped = label.replace("<", "&lt;").replace(">", "&gt;")
    assert f">{escaped}</text>" in drawn


def test_a_figure_gives_the_same_bytes_twice():
    assert svg(_drawing("a")) == svg(_drawing("a"))


def test_an_elided_text_is_a_beginning_with_an_ellipsis():
    assert elided("short", 10) == "short"
    assert elided("a" * 30, 10) == "a" * 9 + "…"
    assert len(elided("Ж" * 30, 10)) < 10


def test_what_no_font_of_the_figure_holds_becomes_a_box():
    assert elided("Ж中文", 10) == "Ж□□"
