"""What has a picture: the method `plot`, by which it is drawn."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Drawn:
    """A thing with one picture; the docstring of its class says what is drawn."""

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw it on `axes` or on new ones, and return the axes, so that title, limits and labels can be changed.

        Raises the error of its class where it holds nothing that can be drawn.
        """
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)
