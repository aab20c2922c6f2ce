"""The style sheet, and the bytes of a figure that matplotlib draws."""

import pytest
from matplotlib.figure import Figure

from rocking.reports.style import new_figure, styled, svg


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
