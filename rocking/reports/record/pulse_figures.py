"""Figures of the pulse's evidence: where in onset and period the record's energy can be taken out by one sine."""

import io
from collections.abc import Sequence

import numpy as np

from rocking.pulses.pulse import Pulse
from rocking.reports.paper.canvas import SMALL, TEXT_WIDTH, Box, Canvas
from rocking.reports.paper.labels import draw_labels, placed_labels
from rocking.reports.paper.letters import elided
from rocking.reports.paper.panel import Panel
from rocking.reports.paper.scales import Scale
from rocking.reports.record.ground_figure import PULSE

_HEIGHT = 54.0
_ROWS = 160
"""Rows of the picture of a map."""
_DARKEST = 213
"""Of 255: how dark the largest energy is."""
_RADIUS = 20.0
"""Of the circle of directions, mm."""


def energy_map(
    onsets: np.ndarray,
    periods: np.ndarray,
    gains: np.ndarray,
    pulses: Sequence[Pulse],
    width: float = TEXT_WIDTH,
) -> Canvas:
    """Draw energy gains (n, m) [m²/s³] over onset (n,) [s] and period (m,) [s], with the ranked pulses.

    At the full width of the text the largest gain of each period stands beside the map.
    """
    canvas = Canvas(width, _HEIGHT)
    share = gains / max(float(gains.max()), np.finfo(float).tiny)
    beside = width >= TEXT_WIDTH
    right = width - 38 if beside else width - 2
    time, period = (
        Scale(float(onsets[0]), float(onsets[-1])),
        Scale(periods.min(), periods.max(), logarithmic=True),
    )
    panel = Panel(canvas, Box(14, 4, right, _HEIGHT - 8.5), time, period)
    canvas.picture(panel.box, _shaded(share, periods, period))
    places = panel.places(*np.array([(pulse.start_time, pulse.period) for pulse in pulses]).reshape(-1, 2).T)
    panel.marks(places, PULSE)
    draw_labels(canvas, placed_labels(places, range(1, len(pulses) + 1), panel.box))
    panel.frame("onset of the pulse [s]", "period [s]")
    if beside:
        profile = Panel(canvas, Box(right + 4, 4, width - 2, _HEIGHT - 8.5), Scale(0, 1.05), period)
        profile.line(share.max(axis=0), periods, "black")
        profile.frame("gain / largest gain [-]", y_ticks=[(tick, "") for tick in period.ticks(9)])
    return canvas


def _shaded(share: np.ndarray, periods: np.ndarray, scale: Scale) -> bytes:
    """The map as a PNG, darker for more; its rows stand evenly on the axis of the periods, the longest on top."""
    from PIL import Image

    order = np.argsort(periods)
    rows = np.interp(np.linspace(1, 0, _ROWS), scale.shares(periods[order]), np.arange(periods.size))
    nearest = share[:, order[np.rint(rows).astype(int)]].T
    # the root lifts the weaker maxima out of the white
    grey = np.rint(255 - _DARKEST * np.sqrt(nearest)).astype(np.uint8)
    stream = io.BytesIO()
    Image.fromarray(grey).save(stream, format="png")
    return stream.getvalue()


def orientation(angles: np.ndarray, gains: np.ndarray, best: float, components: tuple[str, str]) -> Canvas:
    """Draw energy gains over the angle [rad] from the first component towards the second, and the best axis."""
    canvas = Canvas(50, _HEIGHT)
    middle = np.array([25.0, _HEIGHT / 2])
    for radius in (_RADIUS / 2, _RADIUS):
        canvas.path(_around(middle, radius, np.linspace(0, 2 * np.pi, 91)), "#cccccc", 0.4)
    one, two = (elided(name, 8) for name in components)
    names = [one, "45°", two, "135°", f"−{one}", "225°", f"−{two}", "315°"]
    for place, name in enumerate(names):
        rim = _around(middle, _RADIUS, np.array([place * np.pi / 4]))
        canvas.path(np.vstack((middle, rim)), "#cccccc", 0.3)
        across, up = np.round(np.cos(place * np.pi / 4)), -np.round(np.sin(place * np.pi / 4))
        sides = {0: "middle", 1: "left", -1: "right"}, {0: "middle", 1: "top", -1: "bottom"}
        canvas.text(
            rim[0] + 0.8 * np.array([across, up]), name, SMALL, sides[0][int(across)], sides[1][int(up)]
        )
    share = gains / max(float(gains.max()), np.finfo(float).tiny)
    canvas.path(_around(middle, _RADIUS * share, angles), "black")
    canvas.path(_around(middle, _RADIUS, np.array([best, best + np.pi])), PULSE, 1.2, "dash-dot")
    for level in (0.5, 1.0):
        place = _around(middle, _RADIUS * level, np.array([np.pi / 8]))[0]
        canvas.text(place, f"{level:g}", SMALL, "middle", "middle", paper=True)
    return canvas


def _around(middle: np.ndarray, radius: np.ndarray | float, angles: np.ndarray) -> np.ndarray:
    """Places on a circle of paper, counterclockwise from the right."""
    return middle + np.column_stack((radius * np.cos(angles), -radius * np.sin(angles)))
