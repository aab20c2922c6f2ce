"""Pulse: one full sine cycle of acceleration. A signal, nothing else."""

from dataclasses import dataclass

import numpy as np

from rocking.drawn import Drawn
from rocking.errors import PulseError
from rocking.quantities import GRAVITY, finite, four_digits, positive


@dataclass(frozen=True, repr=False)
class Pulse(Drawn):
    """a(t) = amplitude · sin(circular_frequency · (t − start_time)) for one period, zero outside.

    amplitude: m/s², signed. circular_frequency: rad/s, > 0. start_time: s. `plot` draws the cycle against time.
    Raises PulseError when a value is not finite or the frequency not positive.

    >>> from rocking import Pulse
    >>> Pulse(amplitude=3.0, circular_frequency=5.0).acceleration(np.array([0.0, 0.3, 9.0])).round(2)
    array([0.  , 2.99, 0.  ])
    """

    amplitude: float
    circular_frequency: float
    start_time: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", finite(PulseError, "amplitude", self.amplitude, "m/s²"))
        frequency = positive(PulseError, "circular_frequency", self.circular_frequency, "rad/s")
        object.__setattr__(self, "circular_frequency", frequency)
        object.__setattr__(self, "start_time", finite(PulseError, "start_time", self.start_time, "s"))

    def __repr__(self) -> str:
        size = f"{four_digits(self.amplitude, 'm/s²')} = {four_digits(self.amplitude / GRAVITY, 'g')}"
        return f"Pulse({size}, period {four_digits(self.period, 's')}, start {four_digits(self.start_time, 's')})"

    @property
    def period(self) -> float:
        """T = 2π/ω, s."""
        return 2 * np.pi / self.circular_frequency

    @property
    def end_time(self) -> float:
        """Time at which the cycle is complete, s."""
        return self.start_time + self.period

    def acceleration(self, times: np.ndarray) -> np.ndarray:
        """Return the acceleration in m/s² at `times` (any shape, s)."""
        phase = self.circular_frequency * (np.asarray(times, dtype=float) - self.start_time)
        inside = (phase >= 0) & (phase <= 2 * np.pi)
        return np.where(inside, self.amplitude * np.sin(phase), 0.0)
