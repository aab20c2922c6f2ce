"""Accelerogram: what every reader returns. An acceleration history and where it came from, nothing else."""

from contextlib import nullcontext
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from rocking.drawn import Drawn
from rocking.errors import RecordError, about
from rocking.hashes import sha256_of_bytes
from rocking.quantities import GRAVITY, UNPRINTABLE, finite, four_digits, positive
from rocking.signal.kinds import SignalKind
from rocking.warnings import RockingWarning

if TYPE_CHECKING:
    from pandas import DataFrame

    from rocking import RecordMeasures

LARGEST_PEAK = 5 * GRAVITY
"""m/s²; the largest recorded so far is 4.4 g (Iwate-Miyagi 2008, IWTH25), so what is above is a wrong unit."""
RARE_PEAK = 3 * GRAVITY
"""m/s²; a handful of records of the world exceed it."""
WEAK_PEAK = 0.001 * GRAVITY
"""m/s²; no folder of records whose pages say nothing lies below as a whole."""

SHORTEST_STEP = 1e-4
"""s; no accelerograph has a shorter one."""
LONGEST_STEP = 0.1
"""s; a longer one leaves out what makes a structure rock."""
_AT_BIRTH = (SignalKind.STEP_UNUSUAL, SignalKind.PEAK_IMPOSSIBLE)
"""The warnings that an accelerogram has by its own step and peak."""

SAME_STEP = 1e-6
"""Share by which the time steps of one station's components may differ: the rounding of their headers."""


@dataclass(frozen=True)
class Source:
    """The origin of the numbers of an accelerogram; unit: theirs, as declared or as the format defines it.

    answer: by which a table was read, and whose it was; "" where nothing had to be answered.
    """

    path: str = ""
    format: str = ""
    sha256: str = ""
    unit: str = ""
    answer: str = ""


@dataclass(frozen=True, eq=False, repr=False)
class Accelerogram(Drawn):
    """One component of ground acceleration, uniformly sampled, in m/s²; `plot` draws it against time.

    What is not known is an empty text or None.

    Parameters
    ----------
    acceleration : ndarray
        (n,) m/s², n ≥ 2, finite, stored as a read-only float64 copy.
    time_step : float
        Time between two samples, s.
    component : str, default ''
        Name of the component.
    station : str, default ''
        Station.
    event : str, default ''
        Earthquake.
    source : Source, optional
        File and format that it was read from.
    scale_factor : float, default 1.0
        What the file's numbers were multiplied by, beyond their unit.
    processing : tuple of str, optional
        Steps that made these numbers from those of the file, in order.
    warnings : tuple of RockingWarning, optional
        What the reader noticed that a user must know.
    high_pass_frequency : float or None, optional
        Corner of a high-pass that is known to have been applied, Hz.
    network : str, default ''
        Code of the network.
    location : str, default ''
        Code that distinguishes the instruments of one station.
    start_time : str, default ''
        Time of the first sample, ISO 8601 in universal time.
    azimuth : float or None, optional
        Direction of positive acceleration, degrees clockwise from north.
    vertical : bool, default False
        Whether it is a vertical component.
    borehole : bool, default False
        Whether the instrument is down-hole.
    magnitude : float or None, optional
        Magnitude of the earthquake, as the file prints it.
    magnitude_type : str, default ''
        Scale of the magnitude: Mw, Ms, ML, mb or M.
    event_time : str, default ''
        Time of the earthquake, as the file prints it.
    latitude : float or None, optional
        Latitude of the station, degrees north.
    longitude : float or None, optional
        Longitude of the station, degrees east.
    elevation : float or None, optional
        Height of the station above the sea, m.
    epicentral_distance : float or None, optional
        Distance of the station from the epicentre, m.
    processed : bool or None, default False
        Whether the file says that its numbers are corrected, None where it cannot.
    initial_velocity : float, default 0.0
        Velocity of the ground at the first sample, m/s, where what a filter put before the record was cut
        off.
    initial_displacement : float, default 0.0
        Displacement of the ground at the first sample, m, likewise.
    smooth_steps : int, default 1
        Time steps within which the motion is smooth, one after another from the start; 1 of a record, which
        is linear between its samples.

    Raises
    ------
    RecordError
        For what is no accelerogram.
    """

    acceleration: np.ndarray
    time_step: float
    component: str = ""
    station: str = ""
    event: str = ""
    source: Source = field(default_factory=Source)
    scale_factor: float = 1.0
    processing: tuple[str, ...] = ()
    warnings: tuple[RockingWarning, ...] = ()
    high_pass_frequency: float | None = None
    network: str = ""
    location: str = ""
    start_time: str = ""
    azimuth: float | None = None
    vertical: bool = False
    borehole: bool = False
    magnitude: float | None = None
    magnitude_type: str = ""
    event_time: str = ""
    latitude: float | None = None
    longitude: float | None = None
    elevation: float | None = None
    epicentral_distance: float | None = None
    processed: bool | None = False
    initial_velocity: float = 0.0
    initial_displacement: float = 0.0
    smooth_steps: int = 1

    def __post_init__(self) -> None:
        with about(self.source.path) if self.source.path else nullcontext():
            for name in ("component", "station", "event", "network", "location"):
                if UNPRINTABLE.search(str(text := getattr(self, name))):
                    raise RecordError(
                        f"{name} is {text!r}, but must hold printable characters only.", **{name: text}
                    )
            object.__setattr__(self, "acceleration", _samples(self.acceleration))
            object.__setattr__(self, "time_step", positive(RecordError, "time_step", self.time_step, "s"))
            object.__setattr__(self, "scale_factor", finite(RecordError, "scale_factor", self.scale_factor))
            whole = isinstance(self.smooth_steps, int) and not isinstance(self.smooth_steps, bool)
            if not (whole and self.smooth_steps >= 1):
                raise RecordError(
                    f"smooth_steps is {self.smooth_steps!r}, but must be a whole number from 1 on.",
                    smooth_steps=self.smooth_steps,
                )
        warnings = []
        if not SHORTEST_STEP <= self.time_step <= LONGEST_STEP:
            limits = {"shortest_s": SHORTEST_STEP, "longest_s": LONGEST_STEP}
            warnings.append(
                RockingWarning.of(SignalKind.STEP_UNUSUAL, "", time_step_s=self.time_step, **limits)
            )
        if self.peak_acceleration > LARGEST_PEAK:
            warnings.append(RockingWarning(SignalKind.PEAK_IMPOSSIBLE))
        # A copy with another factor or step has none of the first one's.
        still = [warning for warning in self.warnings if warning.kind not in _AT_BIRTH or warning in warnings]
        new = (warning for warning in warnings if warning not in still)
        object.__setattr__(self, "warnings", (*still, *new))

    def __repr__(self) -> str:
        names = [name for name in (self.component, self.station, self.event) if name]
        size = f"{self.acceleration.size} samples at {four_digits(self.time_step, 's')}"
        peak = self.peak_acceleration
        peaks = f"peak {four_digits(peak, 'm/s²')} = {four_digits(peak / GRAVITY, 'g')}"
        return f"Accelerogram({', '.join([*names, size, peaks])})"

    @property
    def is_horizontal(self) -> bool:
        """Whether it is a horizontal component at the surface."""
        return not self.vertical and not self.borehole

    @property
    def times(self) -> np.ndarray:
        """(n,) s, from 0."""
        return np.arange(self.acceleration.size) * self.time_step

    @property
    def duration(self) -> float:
        """Time from the first to the last sample, s."""
        return (self.acceleration.size - 1) * self.time_step

    @cached_property
    def peak_acceleration(self) -> float:
        """Largest magnitude of the samples, m/s²."""
        return max(abs(float(self.acceleration.max())), abs(float(self.acceleration.min())))

    @cached_property
    def measures(self) -> "RecordMeasures":
        """Peak acceleration, velocity and displacement, Arias intensity and D5–95, as record_measures returns them.

        >>> record = rocking.read("records/20161113_110259_WTMC_20.V2A")[0]
        >>> round(record.measures.peak_velocity, 2)
        1.02
        """
        from rocking import record_measures  # which imports this

        return record_measures(self)

    @cached_property
    def sha256(self) -> str:
        """Hash of the time step and the samples (not of the file)."""
        return sha256_of_bytes(np.float64(self.time_step).tobytes(), self.acceleration.tobytes())

    def scaled(self, factor: float) -> "Accelerogram":
        """Return this accelerogram with its acceleration multiplied by `factor`, remembered in scale_factor.

        >>> rocking.Accelerogram(np.ones(101), time_step=0.01).scaled(2.0).peak_acceleration
        2.0
        """
        factor = finite(RecordError, "factor", factor)
        names = "acceleration", "scale_factor", "initial_velocity", "initial_displacement"
        return replace(self, **{name: getattr(self, name) * factor for name in names})

    def processed_by(self, acceleration: np.ndarray, step: str, **changes: Any) -> "Accelerogram":
        """Return a copy with new samples and one more processing sentence."""
        changes = {"smooth_steps": 1} | changes
        return replace(self, acceleration=acceleration, processing=(*self.processing, step), **changes)

    def warned(self, *warnings: RockingWarning) -> "Accelerogram":
        """Return a copy with more warnings."""
        return replace(self, warnings=(*self.warnings, *warnings)) if warnings else self

    def to_obspy(self) -> Any:
        """Return an obspy Trace of the acceleration, m/s², from which from_obspy makes this accelerogram again.

        What obspy has no field for is in `stats.rocking`.
        """
        from obspy import Trace, UTCDateTime  # which takes a second to import

        more = {name: getattr(self, name) for name in OBSPY_EXTRAS}
        header = {"delta": self.time_step, "rocking": more | {"unit": "m/s2", "format": self.source.format}}
        header |= {name: getattr(self, name) for name in ("network", "station", "location")}
        if self.start_time:
            header["starttime"] = UTCDateTime(self.start_time)
        return Trace(self.acceleration.copy(), header=header | {"channel": self.component})

    def frame(self) -> "DataFrame":
        """Return a pandas frame of the columns time_s and acceleration_m_s2."""
        from pandas import DataFrame  # which takes half a second to import

        return DataFrame({"time_s": self.times, "acceleration_m_s2": self.acceleration})


OBSPY_EXTRAS = tuple(
    fact.name
    for fact in fields(Accelerogram)
    if fact.name
    not in ("acceleration", "time_step", "station", "network", "location", "start_time", "source")
)
"""The facts for which a trace of obspy has no place."""


def _samples(values: np.ndarray) -> np.ndarray:
    if np.ma.is_masked(values):
        raise RecordError(
            "the samples are masked in places; fill or cut the gap before use.", acceleration="masked"
        )
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "iufO":
            raise TypeError
        # What owns its samples and cannot be written to needs no copy, and is copied at every change of a name else.
        frozen = array.dtype == np.float64 and array.base is None and not array.flags.writeable
        samples = array if frozen else np.array(array, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise RecordError(
            "the samples are not all real numbers; give a one-dimensional array.",
            acceleration=type(values).__name__,
        ) from None
    if samples.ndim != 1 or samples.size < 2:
        raise RecordError(
            f"the samples have shape {samples.shape}, but must be one row of at least 2.",
            acceleration=samples.shape,
        )
    if not np.isfinite(samples).all():
        bad = np.flatnonzero(~np.isfinite(samples))
        first = f"sample {bad[0]} is {samples[bad[0]]}, one of {bad.size} that are not finite"
        raise RecordError(f"{first}; fill or cut the gap before use.", acceleration=float(samples[bad[0]]))
    samples.flags.writeable = False
    return samples
