"""Measures of the intensity of a record that engineers know it by, and its elastic response spectrum.

Of the libraries made for spectra, pyrotd 0.6.1 wraps the end of a record round to its start, and eqsig takes a second.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rocking.drawn import Drawn
from rocking.errors import RecordError
from rocking.quantities import GRAVITY, instance, positive, within
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.processing import displacement, integral, velocity

if TYPE_CHECKING:
    from pandas import DataFrame

SIGNIFICANT_SHARES = 0.05, 0.95
"""Shares of the Arias intensity at which the significant duration D5–95 begins and ends."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RecordMeasures:
    """The measures of a record.

    Parameters
    ----------
    peak_acceleration : float
        Largest magnitude of the acceleration, m/s².
    peak_velocity : float
        Largest magnitude of the velocity, m/s, by the trapezoidal rule from the record's initial motion.
    peak_displacement : float
        Largest magnitude of the displacement, m, by the same rule.
    arias_intensity : float
        π/(2g) ∫a² dt, m/s (Arias 1970).
    significant_times : tuple of (float, float)
        Times at which 5 and 95 % of it have been spent, s.

    Examples
    --------
    >>> round(rocking.Accelerogram(np.ones(101), time_step=0.01).measures.significant_duration, 3)
    0.9
    """

    peak_acceleration: float
    peak_velocity: float
    peak_displacement: float
    arias_intensity: float
    significant_times: tuple[float, float]

    @property
    def significant_duration(self) -> float:
        """D5–95, s (Trifunac & Brady 1975)."""
        return self.significant_times[1] - self.significant_times[0]


def record_measures(accelerogram: Accelerogram) -> RecordMeasures:
    """Return the measures of one component.

    Of a record that is zero throughout, nothing is ever spent.

    Parameters
    ----------
    accelerogram : Accelerogram
        The component.

    Returns
    -------
    RecordMeasures
        Peaks, Arias intensity and significant duration.

    Raises
    ------
    RecordError
        When it is no Accelerogram.

    Examples
    --------
    >>> rocking.record_measures(rocking.Accelerogram(np.ones(101), time_step=0.01)).peak_velocity
    1.0
    """
    instance(RecordError, "accelerogram", accelerogram, Accelerogram)
    spent = integral(np.square(accelerogram.acceleration), accelerogram.time_step)
    shares = spent / spent[-1] if spent[-1] > 0 else spent
    begin, end = (float(np.interp(share, shares, accelerogram.times)) for share in SIGNIFICANT_SHARES)
    return RecordMeasures(
        peak_acceleration=accelerogram.peak_acceleration,
        peak_velocity=float(np.abs(velocity(accelerogram)).max()),
        peak_displacement=float(np.abs(displacement(accelerogram)).max()),
        arias_intensity=math.pi / (2 * GRAVITY) * float(spent[-1]),
        significant_times=(begin, end),
    )


def peak_velocity(accelerogram: Accelerogram) -> float:
    """Return PGV by the trapezoidal rule from rest, m/s; measured once, as every structure asks for it."""
    return accelerogram.measures.peak_velocity


PERIODS = np.geomspace(0.04, 8.0, 70)
"""Periods of the oscillators, s: nine for each doubling."""
STEPS_PER_PERIOD = 20
"""Steps in which an oscillator's period is followed at least: a peak between two of them is then missed by 1.2 %."""


@dataclass(frozen=True, eq=False)
class ResponseSpectrum(Drawn):
    """Largest responses of linear oscillators to one component; `plot` draws the pseudo-acceleration over the period.

    Parameters
    ----------
    periods : ndarray
        (m,) undamped periods, s.
    displacement : ndarray
        (m,) largest displacement relative to the ground, m.
    damping : float
        Share of the critical damping.

    Examples
    --------
    >>> record = rocking.Accelerogram(np.ones(101), time_step=0.01)
    >>> rocking.response_spectrum(record, np.array([0.5])).pseudo_acceleration.round(1)
    array([1.9])
    """

    periods: np.ndarray
    displacement: np.ndarray
    damping: float

    @property
    def pseudo_acceleration(self) -> np.ndarray:
        """(m,) m/s²: ω² times the displacement."""
        pseudo: np.ndarray = (2 * math.pi / self.periods) ** 2 * self.displacement
        return pseudo

    def frame(self) -> "DataFrame":
        """Return a pandas frame: period_s, displacement_m, pseudo_acceleration_m_s2."""
        from pandas import DataFrame  # which takes half a second to import

        columns = {"period_s": self.periods, "displacement_m": self.displacement}
        return DataFrame(columns | {"pseudo_acceleration_m_s2": self.pseudo_acceleration})


def response_spectrum(
    accelerogram: Accelerogram, periods: np.ndarray | None = None, damping: float = 0.05
) -> ResponseSpectrum:
    """Return the response spectrum of an acceleration that is linear between its samples and zero outside them.

    The oscillators start at rest and are followed for half a period beyond the record.

    Parameters
    ----------
    accelerogram : Accelerogram
        The component.
    periods : ndarray or None, optional
        (m,) undamped periods, s; None: 70 of them, evenly spaced on a logarithmic axis.
    damping : float, default 0.05
        Share of the critical damping, in [0, 1).

    Returns
    -------
    ResponseSpectrum
        Largest responses of linear oscillators.

    Raises
    ------
    RecordError
        When a period is not above zero or the damping not in [0, 1).

    Examples
    --------
    >>> rocking.response_spectrum(rocking.Accelerogram(np.ones(101), time_step=0.01)).periods.size
    70
    """
    instance(RecordError, "accelerogram", accelerogram, Accelerogram)
    periods = np.array(PERIODS if periods is None else periods, dtype=float)
    for period in periods:
        positive(RecordError, "period", period, "s")
    damping = within(RecordError, "damping", damping, low=0, high=0.999)
    largest = np.array([_largest_displacement(accelerogram, period, damping) for period in periods])
    for values in (periods, largest):
        values.flags.writeable = False
    return ResponseSpectrum(periods, largest, damping)


def _largest_displacement(accelerogram: Accelerogram, period: float, damping: float) -> float:
    """Largest |Im q|/ω_d of q' = λq − a, with the pole λ = ω(−ζ + i√(1 − ζ²)) of the oscillator and ω_d = Im λ.

    Over a step in which a is linear, q is exactly e^z q + φ₁ a₀ + φ₂ (a₁ − a₀) but for its sign, with z = λ dt,
    φ₁ = (e^z − 1)/λ and φ₂ = (φ₁ − dt)/z (Nigam & Jennings 1969 in complex form).
    """
    from scipy.signal import lfilter  # which takes half a second to import

    finer = max(1, math.ceil(STEPS_PER_PERIOD * accelerogram.time_step / period))
    step = accelerogram.time_step / finer
    pole = 2 * math.pi / period * complex(-damping, math.sqrt(1 - damping**2))
    first = np.expm1(pole * step) / pole
    second = (first - step) / (pole * step)
    after = math.ceil(0.5 * period / step)
    samples = accelerogram.acceleration
    places = np.arange(0, samples.size - 1 + 0.5 / finer, 1 / finer)
    ground = np.pad(np.interp(places, np.arange(samples.size), samples), (0, after))
    response = lfilter([second, first - second], [1.0, -np.exp(pole * step)], ground)
    return float(np.abs(response.imag).max()) / pole.imag


def end_of_shaking(acceleration: np.ndarray) -> int:
    """Return the number of samples of an `acceleration`, (n,), up to the end of its significant duration D5–95."""
    spent = np.cumsum(np.square(acceleration))
    return int(np.searchsorted(spent, SIGNIFICANT_SHARES[1] * spent[-1])) + 1


LEAST_DAMPING_FACTOR = 0.55
"""Below it η does not fall, however large the damping (NTC 2018, 3.2.3.2.1)."""


def damping_factor(damping: float) -> float:
    """Return η = √(10/(5 + ξ)) ≥ 0.55, with ξ in per cent of the critical damping; `damping`: as a share.

    >>> from rocking.signal.measures import damping_factor
    >>> damping_factor(0.05)
    1.0
    """
    return max(math.sqrt(10 / (5 + 100 * damping)), LEAST_DAMPING_FACTOR)
