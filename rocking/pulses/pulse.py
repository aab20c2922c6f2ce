"""One sine pulse; and of a record what is searched, what is found with its doubts, and which of it may predict."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from rocking.described import check_described, described
from rocking.drawn import Drawn, in_a_notebook
from rocking.errors import PulseError
from rocking.quantities import GRAVITY, counted, finite, four_digits, positive, within
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

if TYPE_CHECKING:
    from pandas import DataFrame

MOST = 200
"""Most pulses of a search: each takes about 1 ms, and a record has no more cycles that count."""


MOST_CYCLES = 1000.0
"""Cycles of a pulse; no ground and no floor moves so long at one period."""


@dataclass(frozen=True, repr=False, kw_only=True)
class Pulse(Drawn):
    """A sine of so many cycles, zero outside: amplitude · sin(circular_frequency · (t − start_time) + phase).

    Parameters
    ----------
    amplitude : float
        Amplitude of the acceleration, m/s², signed.
    circular_frequency : float
        ω_g, rad/s, > 0.
    start_time : float, default 0.0
        Time at which the pulse begins, s.
    cycles : float, default 1.0
        Number of cycles, up to 1000: 1 of a full sine, as records are searched for; 0.5 of a half sine.
    phase : float, default 0.0
        Phase at the start, rad, 0 to 2π; π/2 of a cosine.

    Raises
    ------
    PulseError
        When a value is not finite or outside what is allowed.

    Examples
    --------
    >>> from rocking import Pulse
    >>> Pulse(amplitude=3.0, circular_frequency=5.0).acceleration(np.array([0.0, 0.3, 9.0])).round(2)
    array([0.  , 2.99, 0.  ])
    >>> Pulse(amplitude=3.0, circular_frequency=5.0, cycles=0.5)
    Pulse(3 m/s² = 0.3059 g, period 1.257 s, start 0 s, 0.5 cycles)
    """

    amplitude: float
    circular_frequency: float
    start_time: float = 0.0
    cycles: float = 1.0
    phase: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "amplitude", finite(PulseError, "amplitude", self.amplitude, "m/s²"))
        frequency = positive(PulseError, "circular_frequency", self.circular_frequency, "rad/s")
        object.__setattr__(self, "circular_frequency", frequency)
        object.__setattr__(self, "start_time", finite(PulseError, "start_time", self.start_time, "s"))
        cycles = within(
            PulseError, "cycles", positive(PulseError, "cycles", self.cycles), low=0, high=MOST_CYCLES
        )
        object.__setattr__(self, "cycles", cycles)
        object.__setattr__(self, "phase", within(PulseError, "phase", self.phase, low=0, high=2 * np.pi))

    def __repr__(self) -> str:
        size = f"{four_digits(self.amplitude, 'm/s²')} = {four_digits(self.amplitude / GRAVITY, 'g')}"
        parts = [
            size,
            f"period {four_digits(self.period, 's')}",
            f"start {four_digits(self.start_time, 's')}",
        ]
        parts += [f"{self.cycles:g} cycles"] * (self.cycles != 1)
        parts += [f"phase {self.phase:.4g} rad"] * (self.phase != 0)
        return f"Pulse({', '.join(parts)})"

    @property
    def period(self) -> float:
        """T = 2π/ω, s."""
        return 2 * np.pi / self.circular_frequency

    @property
    def end_time(self) -> float:
        """Time at which it ends, s."""
        return self.start_time + self.cycles * self.period

    @property
    def phases(self) -> tuple[float, float]:
        """Phase at which it begins and at which it ends, rad."""
        return self.phase, self.phase + 2 * np.pi * self.cycles

    @property
    def is_full_sine(self) -> bool:
        """Whether it is one full sine, for which the closed form is printed."""
        return self.cycles == 1 and self.phase == 0

    def acceleration(self, times: np.ndarray) -> np.ndarray:
        """Return the acceleration in m/s² at `times` (any shape, s)."""
        phase = self.circular_frequency * (np.asarray(times, dtype=float) - self.start_time)
        inside = (phase >= 0) & (phase <= 2 * np.pi * self.cycles)
        return np.where(inside, self.amplitude * np.sin(phase + self.phase), 0.0)


@dataclass(frozen=True, kw_only=True)
class PulseSettings:
    """The range of the search for pulses in a record, and the number that is reported.

    Frequencies in Hz are those of the band of 1/T.

    Parameters
    ----------
    lowest_frequency : float, default 0.15
        Lowest 1/T of the search, Hz.
    highest_frequency : float, default 5.0
        Highest 1/T of the search, Hz.
    candidates : int, default 10
        Number of maxima of the scan that are refined.
    alternatives : int, default 5
        Number of pulses that are reported in addition to the dominant one.
    pursuit : int, default 3
        Number of pulses of the pursuit, each found in what the ones before it left.

    Raises
    ------
    PulseError
        When a value is outside what is allowed.

    Examples
    --------
    >>> from rocking import PulseSettings
    >>> PulseSettings(lowest_frequency=0.3).highest_frequency
    5.0
    """

    lowest_frequency: float = described(0.15, "lowest frequency of the search for pulses", "Hz", gt=0)
    highest_frequency: float = described(5.0, "highest frequency of the search for pulses", "Hz", gt=0)
    candidates: int = described(10, "number of maxima that the search refines", ge=1, le=MOST)
    alternatives: int = described(5, "number of ranked pulses in the report", ge=1, le=MOST)
    pursuit: int = described(3, "number of pulses of the pursuit sequence", ge=1, le=MOST)

    def __post_init__(self) -> None:
        check_described(PulseError, self)
        if self.highest_frequency <= self.lowest_frequency:
            raise PulseError(
                f"highest_frequency is {self.highest_frequency:g} Hz, but must be above lowest_frequency "
                f"({self.lowest_frequency:g} Hz).",
                highest_frequency=self.highest_frequency,
            )


DOMINATES = 0.5
"""Share of a record's energy from which on its best sine is said to dominate it."""


@dataclass(frozen=True, kw_only=True)
class PulseEvidence:
    """One pulse and what the record says for it.

    gain: ‖a‖² − ‖a − s‖², m²/s³, the acceleration energy ∫a² dt that the pulse takes out of the record; ⟨a, s⟩²/⟨s, s⟩
    at the amplitude of least squares.
    explained_energy: 1 − ‖a − s‖²/‖a‖² of the record in which it was found.
    phase: rad in (−π, π], shape of the motion where its envelope at ω_g is largest, within half a cycle of the pulse:
    0 for a sine, π for its negative, ±π/2 for a cosine.
    """

    pulse: Pulse
    gain: float
    explained_energy: float
    phase: float


@dataclass(frozen=True, eq=False, repr=False)
class PulseAnalysis(Drawn):
    """The pulses of one record; `plot` draws it with the dominant one.

    Parameters
    ----------
    accelerogram : Accelerogram
        The record.
    ranked : tuple of PulseEvidence
        Maxima of the energy gain on the record, one at least, by gain, that do not cover one another; the
        first is dominant.
    sequence : tuple of PulseEvidence
        The pursuit, each pulse found in what the ones before it left.
    flags : tuple of RockingWarning
        Reasons to doubt the dominant pulse.
    band : tuple of (float, float)
        Lowest and highest frequency that were searched, Hz.

    Examples
    --------
    >>> from rocking import extract_pulses, read
    >>> analysis = extract_pulses(read("records/synthetic_strong_pulse.AT2")[0])
    >>> round(analysis.dominant.period, 2), round(analysis.explained_energy, 2), len(analysis.alternatives)
    (1.03, 0.9, 3)
    """

    accelerogram: Accelerogram
    ranked: tuple[PulseEvidence, ...]
    sequence: tuple[PulseEvidence, ...]
    flags: tuple[RockingWarning, ...]
    band: tuple[float, float]

    def __repr__(self) -> str:
        share = f"explains {100 * self.explained_energy:.0f} % of the energy"
        flags = [f"flags: {', '.join(flag.kind for flag in self.flags)}"] if self.flags else []
        rivals = counted(len(self.alternatives), "alternative")
        return f"PulseAnalysis({', '.join([f'dominant {self.dominant!r}', share, rivals, *flags])})"

    @cached_property
    def residual(self) -> np.ndarray:
        """(n,) m/s², the record less the dominant pulse."""
        residual: np.ndarray = self.accelerogram.acceleration - self.dominant.acceleration(
            self.accelerogram.times
        )
        residual.flags.writeable = False
        return residual

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

    def frame(self) -> "DataFrame":
        """Return a pandas frame with one row per pulse, by gain, the dominant one first."""
        from pandas import DataFrame  # which takes half a second to import

        return DataFrame(
            {
                "amplitude_m_s2": evidence.pulse.amplitude,
                "period_s": evidence.pulse.period,
                "start_time_s": evidence.pulse.start_time,
                "gain_m2_s3": evidence.gain,
                "explained_energy": evidence.explained_energy,
            }
            for evidence in self.ranked
        )

    def _repr_html_(self) -> str:
        return in_a_notebook(repr(self).strip("<>"), self.frame())


@dataclass(frozen=True)
class PulseMethod:
    """The choice of pulses that may stand for a record; of several, each structure meets the one of largest demand.

    name: its value of the setting pulse.choice. description: one clause for the reader.
    candidates: the pulses that may stand for a record, the best first; raises PulseError where there is none.
    """

    name: str
    description: str
    candidates: Callable[[PulseAnalysis], tuple[PulseEvidence, ...]]


Demand = Callable[[Pulse], float]
"""A prediction of the rotation ratio φ_max/φ_cr under one pulse; infinite where the structure overturns."""


def predicting_pulse(candidates: Sequence[PulseEvidence], demand: Demand) -> PulseEvidence:
    """Return the candidate of largest demand; of equal demands the first. Raises PulseError without a candidate."""
    if not candidates:
        raise PulseError(
            "There is no pulse to predict with, but at least one is needed; check the pulse method."
        )
    if len(candidates) == 1:
        return candidates[0]
    return max(candidates, key=lambda evidence: demand(evidence.pulse))
