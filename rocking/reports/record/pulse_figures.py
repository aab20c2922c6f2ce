"""Figures of the pulse's evidence: where in onset and period the record's energy can be taken out by one sine."""

import io
from collections.abc import Sequence

import numpy as np

from rocking.pulses.pulse import Pulse
from rocking.reports.paper.canvas import TEXT_WIDTH, Box, Canvas
from rocking.reports.paper.labels import draw_labels, placed_labels
from rocking.reports.paper.panel import Panel
from rocking.reports.paper.scales import Scale
from rocking.reports.record.ground_figure import PULSE

_HEIGHT = 54.0
_ROWS = 160
"""Rows of the picture of a map."""
_DARKEST = 213
"""Of 255: how dark the largest energy is."""


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
