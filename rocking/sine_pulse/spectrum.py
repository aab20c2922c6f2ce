"""The rocking spectrum of one full sine pulse: the largest rotation over ω = ω_g/p and a = a_g/(gλ)."""

import numpy as np

from rocking.errors import PulseError, StructureError
from rocking.quantities import within
from rocking.sine_pulse.flight import LONGEST_TIME
from rocking.sine_pulse.maximum import maximum_of
from rocking.sine_pulse.ratios import LARGEST_RATIO, Ratios


def pulse_spectrum(
    frequency_ratios: np.ndarray, amplitude_ratios: np.ndarray, restitution: float
) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of every symmetric equivalent block under one full sine pulse, exactly.

    frequency_ratios: ω = ω_g/p in [1e-12, 1e12], (m,). amplitude_ratios: a = |a_g|/(gλ) in [0, 1e12], (n,).
    restitution: η in [0, 1].
    inf where the block overturns, 0 where it does not lift, nan where `predict_maximum` says it is unresolved.
    A cell whose first flight outlasts the pulse is closed form, all of them at once; the others are followed one
    by one. Raises PulseError or StructureError.
    """
    frequencies = _axis("frequency_ratios", frequency_ratios, 1 / LARGEST_RATIO)
    amplitudes = _axis("amplitude_ratios", amplitude_ratios, 0.0)
    eta = within(StructureError, "restitution", restitution, 0, 1)
    omega, a = (axis.ravel() for axis in np.meshgrid(frequencies, amplitudes, indexing="ij"))
    maxima = np.zeros(omega.size)
    lifted = np.flatnonzero(a > 1)
    maxima[lifted] = _lifted_maxima(omega[lifted], a[lifted], eta)
    return maxima.reshape(frequencies.size, amplitudes.size)


def _lifted_maxima(omega: np.ndarray, a: np.ndarray, eta: float) -> np.ndarray:
    """Largest rotations for a > 1.

    Once f has fallen below 1 it stays there until the pulse ends. So a block that lands before that would go on
    falling if the ground were not there: it lands if and only if the free formula gives x < 0 at the pulse's end.
    """
    flight = _FirstFlights(omega, a)
    endless = flight.end > LONGEST_TIME
    x, velocity, _ = flight.state(np.minimum(flight.end, LONGEST_TIME))
    maxima = np.full(omega.size, np.inf)
    contact = np.where(endless, flight.slope <= omega, x < 0)
    for cell in np.flatnonzero(contact):
        side = Ratios(float(omega[cell]), float(a[cell]), eta)
        maxima[cell] = maximum_of(side, side, 1, True).rotation_ratio
    rocks = np.flatnonzero(~contact & ~endless & (x + velocity <= 1))
    maxima[rocks] = _flown_maxima(flight.of(rocks), x[rocks], velocity[rocks], eta)
    return maxima


def _flown_maxima(flight: "_FirstFlights", x: np.ndarray, velocity: np.ndarray, eta: float) -> np.ndarray:
    """Largest rotations of blocks off the ground at the pulse's end with x + x' ≤ 1.

    While f falls (θ < 3π/2) or x < 1 with f < 0, x' changes its sign only from + to −; with x > 1 and rising the block
    would overturn. So the peak before the first impact lies after the pulse if x' > 0 at its end, else it is the only
    zero of x'.
    """
    energy = x * (2 - x) + velocity**2
    before = _free_peak(np.minimum(energy, 1))
    falling = np.flatnonzero(velocity <= 0)
    before[falling] = flight.of(falling).crest()
    rebound = eta**2 * energy
    after = np.where(rebound > 1, np.inf, _free_peak(np.minimum(rebound, 1)))
    return np.maximum(before, after)


def _free_peak(energy: np.ndarray) -> np.ndarray:
    return energy / (1 + np.sqrt(1 - energy))


class _FirstFlights:
    """Many first flights, from rest at θ = asin(1/a): `rocking.sine_pulse.flight.Flight` with f₀ = 1, v = 0."""

    def __init__(self, omega: np.ndarray, a: np.ndarray) -> None:
        self.omega, self.amplitude = omega, a
        self.slope = np.sqrt((a - 1) * (a + 1))
        self.uplift = np.arctan2(1.0, self.slope)
        self.end = (2 * np.pi - self.uplift) / omega
        self.share = 1 / (1 + omega**2)

    def of(self, cells: np.ndarray) -> "_FirstFlights":
        """Return the flights of some cells."""
        return _FirstFlights(self.omega[cells], self.amplitude[cells])

    def state(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return x, x', x'' at t, one time for each flight."""
        omega, slope = self.omega, self.slope
        sinh, rise = np.sinh(t), 2 * np.sinh(t / 2) ** 2
        sin, versine = np.sin(omega * t), 2 * np.sin(omega * t / 2) ** 2
        x = self.share * (omega * (slope * sinh - omega * rise) + versine - slope * sin)
        velocity = self.share * omega * (slope * (rise + versine) - omega * sinh + sin)
        return x, velocity, x - versine + slope * sin

    def crest(self) -> np.ndarray:
        """Return x where x' falls through zero between the end of the upward push and the pulse's end."""
        low, high = (np.pi - 2 * self.uplift) / self.omega, self.end
        t, last = (low + high) / 2, np.full(low.size, np.inf)
        for _ in range(200):
            _, velocity, acceleration = self.state(t)
            low, high = np.where(velocity > 0, t, low), np.where(velocity > 0, high, t)
            with np.errstate(divide="ignore", invalid="ignore"):
                newton = t - velocity / acceleration
            converged = np.abs(newton - t) <= 1e-8 * t
            bisect = ~((low <= newton) & (newton <= high)) | (np.abs(velocity) > last / 2)
            t = np.where(bisect & ~converged, (low + high) / 2, np.clip(newton, low, high))
            last = np.abs(velocity)
            if np.all(converged | (high - low <= 4e-16 * high)):
                break
        return self.state(t)[0]


def _axis(field: str, values: np.ndarray, lowest: float) -> np.ndarray:
    array = np.asarray(values, dtype=float)
    if array.ndim != 1 or array.size == 0:
        raise PulseError(f"{field} has the shape {array.shape}, but must be a list of at least one number.")
    wrong = array[~((array >= lowest) & (array <= LARGEST_RATIO))]
    if wrong.size:
        raise PulseError(
            f"{field} holds {wrong[0]!s}, but every value must lie between {lowest:g} and {LARGEST_RATIO:g}."
        )
    return array
