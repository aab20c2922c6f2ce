"""Figures of the pulse's evidence: where in onset and period the record's energy can be taken out by one sine."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.pulses.pulse import Pulse
from rocking.reports.style import TEXT_WIDTH, elided, new_figure, plain_logarithmic, styled


@styled
def energy_map(
    onsets: np.ndarray,
    periods: np.ndarray,
    gains: np.ndarray,
    pulses: Sequence[Pulse],
    width: float = TEXT_WIDTH,
) -> Figure:
    """Draw energy gains (n, m) [m²/s³] over onset (n,) [s] and period (m,) [s], with the ranked pulses.

    At the full width of the text the largest gain of each period stands beside the map.
    """
    figure = new_figure(54, width)
    share = gains / max(float(gains.max()), np.finfo(float).tiny)
    if width < TEXT_WIDTH:
        _map(figure.subplots(), onsets, periods, share, pulses)
        return figure
    figure.subplots_adjust(wspace=0.06)
    panel, profile = figure.subplots(1, 2, sharey=True, width_ratios=[4, 1])
    _map(panel, onsets, periods, share, pulses)
    profile.plot(share.max(axis=0), periods, color="black")
    profile.set_xlim(0, 1.05)
    profile.set_xlabel("gain / largest gain [-]")
    return figure


def _map(
    panel: Axes, onsets: np.ndarray, periods: np.ndarray, share: np.ndarray, pulses: Sequence[Pulse]
) -> None:
    # the root lifts the weaker maxima out of the white
    drawn = panel.pcolormesh(
        onsets, periods, np.sqrt(share).T, cmap="Greys", vmin=0, vmax=1.2, shading="nearest"
    )
    drawn.set_rasterized(True)
    _ranks(panel, pulses)
    plain_logarithmic(panel, "y")
    panel.set_ylim(periods.min(), periods.max())
    panel.set_xlim(onsets[0], onsets[-1])
    panel.set_xlabel("onset of the pulse [s]")
    panel.set_ylabel("period [s]")


def _ranks(panel: Axes, pulses: Sequence[Pulse]) -> None:
    for rank, pulse in enumerate(pulses, start=1):
        panel.plot(
            pulse.start_time, pulse.period, "o", color="white", markeredgecolor="#D55E00", markersize=4
        )
        panel.annotate(
            str(rank),
            (pulse.start_time, pulse.period),
            xytext=(4, 3),
            textcoords="offset points",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85},
        )


@styled
def orientation(angles: np.ndarray, gains: np.ndarray, best: float, components: tuple[str, str]) -> Figure:
    """Draw energy gains over the angle [rad] from the first component towards the second, and the best axis."""
    figure = new_figure(54, 50, margins=(7, 7, 7, 7))
    panel = figure.add_subplot(projection="polar")
    panel.plot(angles, gains / max(float(gains.max()), np.finfo(float).tiny), color="black")
    panel.plot([best, best + np.pi], [1, 1], color="#D55E00", linestyle="-.", linewidth=1.2)
    one, two = (elided(name, 8) for name in components)
    labels = [one, "45°", two, "135°", f"−{one}", "225°", f"−{two}", "315°"]
    panel.set_xticks(np.arange(8) * np.pi / 4, labels)
    panel.set_yticks([0.5, 1.0], ["0.5", "1"])
    panel.spines["polar"].set_linewidth(0.4)
    panel.grid(linewidth=0.3, color="0.8")
    return figure
