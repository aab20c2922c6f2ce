"""PulseEvidence and PulseAnalysis: the pulses of one record and what the record says for them."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rocking.errors import PulseError
from rocking.pulses.flags import Flag
from rocking.pulses.pulse import Pulse
from rocking.quantities import counted
from rocking.records.accelerogram import Accelerogram

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame


@dataclass(frozen=True)
class PulseEvidence:
    """One pulse and what the record says for it.

    gain: ‖a‖² − ‖a − s‖², m²/s³, the acceleration energy ∫a² dt that the pulse takes out of the record; ⟨a, s⟩²/⟨s, s⟩
    at the amplitude of least squares.
    explained_energy: 1 − ‖a − s‖²/‖a‖² of the record it was sought in.
    phase: rad in (−π, π], shape of the motion where its envelope at ω_g is largest, within half a cycle of the pulse:
    0 for a sine, π for its negative, ±π/2 for a cosine.
    """

    pulse: Pulse
    gain: float
    explained_energy: float
    phase: float

    @property
    def effective_length(self) -> float:
        """L_e = |a_g| T_g², m: the length scale of the pulse."""
        return abs(self.pulse.amplitude) * self.pulse.period**2

    @property
    def interval(self) -> tuple[float, float]:
        """Times at which the cycle starts and ends, s."""
        return self.pulse.start_time, self.pulse.end_time


def evidence_of(pulse: Pulse, accelerogram: Accelerogram) -> PulseEvidence:
    """Return what the record says for any pulse, also one that was not fitted to it; its gain may then be negative."""
    from rocking.pulses.scan import envelope_phase

    samples, step = accelerogram.acceleration, accelerogram.time_step
    left = samples - pulse.acceleration(accelerogram.times)
    energy, gain = float(np.square(samples).sum()), float((np.square(samples) - np.square(left)).sum())
    phase = envelope_phase(samples, round(pulse.start_time / step), pulse.circular_frequency * step)
    return PulseEvidence(pulse, gain * step, gain / energy, phase)


@dataclass(frozen=True, eq=False, repr=False)
class PulseAnalysis:
    """The pulses of one record.

    ranked: maxima of the energy gain on the record, by gain, that do not cover one another; the first is dominant.
    sequence: the pursuit, each pulse sought in what the ones before it left.
    residual: (n,) m/s², the record less the dominant pulse.
    flags: reasons to doubt the dominant pulse.
    Raises PulseError without a pulse.
    """

    accelerogram: Accelerogram
    ranked: tuple[PulseEvidence, ...]
    sequence: tuple[PulseEvidence, ...]
    residual: np.ndarray
    flags: tuple[Flag, ...]
    band: tuple[float, float]
    """Lowest and highest frequency that were searched, Hz."""

    def __post_init__(self) -> None:
        if not self.ranked:
            raise PulseError("ranked is empty, but must hold at least the dominant pulse.")

    def __repr__(self) -> str:
        share = f"explains {100 * self.explained_energy:.0f} % of the energy"
        flags = [f"flags: {', '.join(self.flags)}"] if self.flags else []
        rivals = counted(len(self.alternatives), "alternative")
        return f"PulseAnalysis({', '.join([f'dominant {self.dominant!r}', share, rivals, *flags])})"

    @property
    def dominant(self) -> Pulse:
        """The pulse of largest energy gain."""
        return self.ranked[0].pulse

    @property
    def evidence(self) -> PulseEvidence:
        """The dominant pulse with its evidence."""
        return self.ranked[0]

    @property
    def alternatives(self) -> tuple[PulseEvidence, ...]:
        """The rivals of the dominant pulse, by gain."""
        return self.ranked[1:]

    @property
    def explained_energy(self) -> float:
        """EVa: share of the record's acceleration energy that the dominant pulse explains."""
        return self.ranked[0].explained_energy

    @property
    def gain_ratio(self) -> float:
        """G₂/G₁, second gain over first; 0 when the record holds one maximum only."""
        return self.ranked[1].gain / self.ranked[0].gain if len(self.ranked) > 1 else 0.0

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the record with its dominant pulse, on `axes` or on new ones, and return the axes."""
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)

    def frame(self) -> "DataFrame":
        """Return a pandas frame with one row per pulse, by gain, the dominant one first."""
        from pandas import DataFrame

        rows = [
            {
                "amplitude_m_s2": found.pulse.amplitude,
                "period_s": found.pulse.period,
                "start_time_s": found.pulse.start_time,
                "gain_m2_s3": found.gain,
                "explained_energy": found.explained_energy,
            }
            for found in self.ranked
        ]
        return DataFrame(rows)
