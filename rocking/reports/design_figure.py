"""The spectra of records with that of the design level."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from rocking.reports.printing import unit_of
from rocking.reports.style import PULSE, new_figure, plain_logarithmic, styled
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.measures import response_spectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from rocking.codes.design_spectrum import DesignSpectrum

_PERIODS = np.geomspace(0.04, 4.0, 60)
MOST_LINES = 60
"""Spectra that are drawn one by one; of more their quantiles."""
_QUANTILES = (0.05, 0.5, 0.95)


def spectrum_periods(level: DesignSpectrum) -> np.ndarray:
    """Return the periods at which spectra are compared with that of the design level, (k,) s."""
    return _PERIODS[level.longest_period >= _PERIODS]


def component_spectra(
    components: Iterable[Accelerogram], level: DesignSpectrum
) -> Mapping[str, Sequence[float]]:
    """Return the spectral accelerations [m/s²] of each component, at the periods and the damping of the level."""
    periods = spectrum_periods(level)
    spectra = {}
    for place, component in enumerate(components, start=1):
        spectrum = response_spectrum(component, periods, level.damping)
        name = component.component or f"component {place}"
        spectra[name] = [float(f"{ordinate:.4g}") for ordinate in spectrum.pseudo_acceleration]
    return spectra


@styled
def design_summary_figure(spectra: Sequence[Sequence[float]], level: DesignSpectrum) -> Figure:
    """Draw the spectra [m/s²] of all components, or the quantiles of many, and their mean with the design level.

    spectra: at the periods of `spectrum_periods`.
    """
    figure = new_figure(70.0)
    axes = figure.subplots()
    periods = spectrum_periods(level)
    values = np.array(spectra) / unit_of("m/s²").size
    if len(values) <= MOST_LINES:
        for place, spectrum in enumerate(values):
            label = "components" if place == 0 else None
            axes.plot(periods, spectrum, color="0.75", linewidth=0.5, label=label)
    else:
        low, middle, high = np.quantile(values, _QUANTILES, axis=0)
        axes.fill_between(periods, low, high, color="0.85", label="5 to 95 % of the components")
        axes.plot(periods, middle, "--", color="0.45", label="median")
    axes.plot(periods, values.mean(axis=0), color="black", label=f"mean of {len(values)}")
    _draw_level(axes, level)
    return figure


def _draw_level(axes: Axes, level: DesignSpectrum) -> None:
    periods = spectrum_periods(level)
    unit = unit_of("m/s²")
    axes.plot(periods, level.acceleration(periods) / unit.size, color=PULSE, label="design level")
    plain_logarithmic(axes, "x")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.set(xlabel="period [s]", ylabel=f"spectral acceleration [{unit.name}]")
    axes.legend()
