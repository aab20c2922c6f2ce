"""The spectra of a record beside that of the design level."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from rocking.records.design_spectrum import DesignSpectrum
from rocking.records.measures import response_spectrum
from rocking.reports.record_figures import Trace
from rocking.reports.style import PULSE, new_figure, plain_logarithmic, styled

_PERIODS = np.geomspace(0.04, 4.0, 60)


@styled
def design_figure(motions: Sequence[Trace], level: DesignSpectrum) -> Figure:
    """Draw the spectrum of each component, for the damping of the design level, and that of the level."""
    figure = new_figure(52.0)
    axes = figure.subplots()
    periods = _PERIODS[level.longest_period >= _PERIODS]
    for place, motion in enumerate(motions):
        spectrum = response_spectrum(motion.accelerogram, periods, level.damping)
        line = ("-", "--", ":")[place % 3]
        name = motion.accelerogram.component or "record"
        axes.plot(periods, spectrum.pseudo_acceleration, line, color="0.35", label=name)
    axes.plot(periods, level.acceleration(periods), color=PULSE, label="design level")
    plain_logarithmic(axes, "x")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.set(xlabel="period [s]", ylabel="spectral acceleration [m/s²]")
    axes.legend()
    return figure
