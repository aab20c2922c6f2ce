"""The objects that have a picture: the method `plot`, by which they are drawn."""

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame


def in_a_notebook(sentence: str, table: "DataFrame") -> str:
    """Return what a notebook shows of a result: its sentence, and its table below."""
    return f"<p>{escape(sentence)}</p>{table.to_html(index=False, float_format='{:.3g}'.format)}"


class Drawn:
    """A thing with one picture; the docstring of its class says what is drawn."""

    def plot(self, axes: "Axes | None" = None, **options: bool) -> "Axes":
        """Draw it on `axes` or on new ones, and return the axes, so that title, limits and labels can be changed.

        options: those of its picture, which the docstring of its class names.
        Raises the error of its class where it holds nothing that can be drawn.
        """
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes, **options)
