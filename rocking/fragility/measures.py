"""Intensity measures: one number for a record, or for a record and a structure. One registry names them all.

A measure is plain (`pgv`), has periods (`SA(0.5)`, `AvgSA(0.2,2.0)`), or takes them from a structure (`AvgSA`, `FIV3`).
OpenQuake's names and units of them are understood, and written where files go there.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from rocking.errors import ConfigurationError, RecordError, RockingError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.signal.measures import peak_velocity, record_measures, response_spectrum
from rocking.signal.processing import integral
from rocking.structures import EquivalentBlock, Mechanism, Structure

LONGEST_PERIOD = 20.0
"""s; beyond it no accelerograph says what the ground did."""
CORNER_MARGIN = 1.25
"""Least usable frequency over the corner of the high-pass, as in the flat files of PEER."""
AVERAGED = 20
"""Periods, equal in ratio, whose spectral accelerations AvgSA(T1,T2) averages."""
AVERAGED_BY_OPENQUAKE = 10
"""Periods, equally far apart, whose spectral accelerations Sa_avg2 and Sa_avg3 average (Aristeidou et al. 2024)."""
WINDOW = 0.7
"""α of Dávalos and Miranda (2019): over so many periods the filtered acceleration is integrated."""
CORNER = 0.85
"""β of Dávalos and Miranda (2019): corner of the low-pass times the period."""
RANGE_BY_PERIOD = (0.18, 1.30)
"""Range of AvgSA over 2π/p."""
ONE_SWING_MULTIPLIER = 0.3
ONE_SWING_RESTITUTION = 0.8
"""Largest λ, and the η below which such a structure keeps PGV: it lifts early and loses much at each impact, so that
every swing starts nearly from rest. One that rocks to one side alone is thrown back at each impact, and likewise never
swings up. What decides is the strongest single pulse of the ground, of any period, which PGV measures."""
FIV3_BY_PERIOD = 0.30
"""Period of FIV3 over 2π/p."""


def per_velocity(block: EquivalentBlock) -> float:
    """Return p/(gλ) of the side that lifts first, s/m."""
    return block.frequency_parameter / (GRAVITY * min(side.uplift_multiplier for side in block.sides))


@dataclass(frozen=True)
class IntensityMeasure:
    """A measure of how strong a motion is for a structure: a figure of the record over one of the mechanism.

    Parameters
    ----------
    name : str
        Name, as settings and tables have it.
    unit : str
        Unit; empty of a ratio.
    meaning : str
        Meaning, for axes.
    of_record : callable
        The figure of the record, which grows as the accelerations to `power`.
    per : callable, optional
        The figure of the mechanism.
    power : int, default 1
        Power with which the figure of the record grows as its accelerations.
    openquake : str, default ''
        OpenQuake's name; empty where it has none.
    openquake_scale : float, default 1.0
        A value in OpenQuake's unit over the same in `unit`.
    periods : tuple of (float, float) or None, optional
        Range of periods that it needs, s.

    Examples
    --------
    >>> record = rocking.Accelerogram(np.sin(np.arange(500) * 0.05), 0.01)
    >>> round(rocking.intensity_measure("PGA").of(record, rocking.Block(2.0, 0.2).mechanism()), 3)
    0.102
    """

    name: str
    unit: str
    meaning: str
    of_record: Callable[[Accelerogram], float]
    per: Callable[[Mechanism], float] = lambda _mechanism: 1.0
    power: int = 1
    openquake: str = ""
    openquake_scale: float = 1.0
    periods: tuple[float, float] | None = None

    def of(self, record: Accelerogram, mechanism: Mechanism) -> float:
        """Return the measure of `record`. Raises ConfigurationError where the record has none."""
        name = record.source.path or record.station or "a record"
        try:
            self._check_band(record)
            value = self.remembered(record)
        except RockingError as error:
            raise ConfigurationError(f"{name} has no {self.name}: {error}", **{self.name: None}) from None
        if not (np.isfinite(value) and value > 0):
            raise ConfigurationError(
                f"{name} has a {self.name} of {value!r}, but must have one greater than 0; leave the record out.",
                **{self.name: value},
            )
        return value / self.per(mechanism)

    def _check_band(self, record: Accelerogram) -> None:
        """Raise RecordError where a period lies outside of what the record can tell."""
        if self.periods is None:
            return
        shortest = 2 * record.time_step
        corner = record.high_pass_frequency
        longest = 1 / (CORNER_MARGIN * corner) if corner else math.inf
        for period in self.periods:
            if not shortest <= period <= longest * (1 + 1e-9):
                raise RecordError(
                    f"it needs a period of {period:.3g} s, but the record can be used from {shortest:.3g} to "
                    f"{longest:.3g} s (two time steps; 1/{CORNER_MARGIN:g} of the period of its high-pass); choose "
                    "another period, or leave the record out.",
                    period=period,
                )

    def remembered(self, record: Accelerogram) -> float:
        """Return the figure of the record, measured once as long as the record lives: many structures ask for it."""
        of_record = _REMEMBERED.setdefault(record, {})
        if self.name not in of_record:
            of_record[self.name] = self.of_record(record)
        return of_record[self.name]


_REMEMBERED: WeakKeyDictionary[Accelerogram, dict[str, float]] = WeakKeyDictionary()


def _average(record: Accelerogram, periods: np.ndarray) -> float:
    """The geometric mean of the spectral accelerations at `periods`, g."""
    accelerations = response_spectrum(record, periods).pseudo_acceleration / GRAVITY
    if not accelerations.all():
        return 0.0
    return float(np.exp(np.log(accelerations).mean()))


def _incremental_velocity(record: Accelerogram, period: float) -> float:
    """FIV3, m/s: of the three largest maxima or minima of the integral of the filtered acceleration over a window
    (Dávalos and Miranda 2019, EESD 48, 1384-1405, Eqs 2 and 3), the greater sum. Fewer count where there are fewer.
    """
    from scipy import signal  # which takes half a second to import

    step = record.time_step
    times = np.arange(record.acceleration.size) * step
    starts = times[times <= times[-1] - WINDOW * period]
    if starts.size < 3:
        raise RecordError(
            f"it lasts {times[-1]:.3g} s, but must last longer than {WINDOW * period:.3g} s.",
            duration=float(times[-1]),
        )
    corner = min(CORNER / period, 0.49 / step)  # a corner beyond that of the samples filters nothing
    low_pass = signal.butter(2, corner, fs=1 / step)
    velocity = integral(signal.lfilter(*low_pass, record.acceleration), step)
    gained = np.interp(starts + WINDOW * period, times, velocity) - velocity[: starts.size]
    sums = []
    for way in (gained, -gained):
        peaks = way[signal.find_peaks(way)[0]]
        sums.append(abs(float(np.sort(peaks)[-3:].sum())))
    return max(sums)


def _spectral(period: float) -> IntensityMeasure:
    name = f"SA({period})"
    return IntensityMeasure(
        name,
        "g",
        f"spectral acceleration at {period:g} s, 5 % damping",
        lambda record: _average(record, np.array([period])),
        openquake=name,
        periods=(period, period),
    )


def _averaged(first: float, last: float) -> IntensityMeasure:
    return IntensityMeasure(
        f"AvgSA({first},{last})",
        "g",
        f"geometric mean of the spectral accelerations from {first:g} to {last:g} s, 5 % damping",
        lambda record: _average(record, np.geomspace(first, last, AVERAGED)),
        openquake="AvgSA",
        periods=(first, last),
    )


def _averaged_up_to(times: int) -> Callable[[float], IntensityMeasure]:
    def averaged(period: float) -> IntensityMeasure:
        name = f"Sa_avg{times}({period})"
        ends = 0.2 * period, times * period
        return IntensityMeasure(
            name,
            "g",
            f"geometric mean of the spectral accelerations from {ends[0]:g} to {ends[1]:g} s, 5 % damping",
            lambda record: _average(record, np.linspace(*ends, AVERAGED_BY_OPENQUAKE)),
            openquake=name,
            periods=ends,
        )

    return averaged


def _filtered(period: float) -> IntensityMeasure:
    name = f"FIV3({period})"
    return IntensityMeasure(
        name,
        "m/s",
        f"filtered incremental velocity at {period:g} s",
        lambda record: _incremental_velocity(record, period),
        openquake=name,
        openquake_scale=100.0,
        periods=(period, period),
    )


INTENSITY_MEASURES: dict[str, IntensityMeasure] = {
    measure.name: measure
    for measure in (
        IntensityMeasure(
            "pgv", "m/s", "peak ground velocity", peak_velocity, openquake="PGV", openquake_scale=100.0
        ),
        IntensityMeasure(
            "pga",
            "g",
            "peak ground acceleration",
            lambda record: record.peak_acceleration / GRAVITY,
            openquake="PGA",
        ),
        IntensityMeasure(
            "p_pgv",
            "",
            "p·PGV/(gλ)",
            peak_velocity,
            lambda m: 1 / per_velocity(m.equivalent_block("exact_at_rest")),
        ),
        IntensityMeasure(
            "arias",
            "m/s",
            "Arias intensity",
            lambda record: record_measures(record).arias_intensity,
            power=2,
            openquake="IA",
        ),
        IntensityMeasure(
            "cav",
            "m/s",
            "cumulative absolute velocity",
            lambda record: float(integral(np.abs(record.acceleration), record.time_step)[-1]),
            openquake="CAV",
            openquake_scale=1 / GRAVITY,
        ),
    )
}
"""The intensity measures without a period, by name; the first is the default."""
WITH_PERIODS: dict[str, tuple[int, Callable[..., IntensityMeasure]]] = {
    "SA": (1, _spectral),
    "AvgSA": (2, _averaged),
    "Sa_avg2": (1, _averaged_up_to(2)),
    "Sa_avg3": (1, _averaged_up_to(3)),
    "FIV3": (1, _filtered),
}
"""How many periods a measure of each name has, and what makes it of them."""
FROM_STRUCTURE = ("AvgSA", "FIV3")
"""The measures that take their periods from the structure where none are said."""
SPELLINGS = (
    *INTENSITY_MEASURES,
    *(f"{name}({'T' if count == 1 else 'T1,T2'})" for name, (count, _) in WITH_PERIODS.items()),
    *FROM_STRUCTURE,
)
"""What settings may say."""
MEASURES_IN_WORDS = (
    ", ".join(f"{measure.name} [{measure.unit or '-'}]" for measure in INTENSITY_MEASURES.values())
    + ", SA(T), AvgSA(T1,T2), Sa_avg2(T), Sa_avg3(T) [g], FIV3(T) [m/s]; AvgSA and FIV3 alone: at the periods of the "
    "structure"
)
"""Names with units, for the meanings of settings and columns."""
_SPELLED = re.compile(r"\s*(\w+)\s*(?:\(([^()]*)\))?\s*")
_BY_OPENQUAKE = {measure.openquake: measure for measure in INTENSITY_MEASURES.values() if measure.openquake}


def intensity_measure(name: str, structure: Structure | Mechanism | None = None) -> IntensityMeasure:
    """Return the measure of that name, ours or OpenQuake's.

    AvgSA and FIV3 without periods take those of `structure`, and are PGV where one swing decides about it.

    Parameters
    ----------
    name : str
        Name, such as "pgv", "SA(0.5)" or "AvgSA".
    structure : Structure, Mechanism or None, optional
        Structure from which a measure takes the periods that its name leaves out.

    Returns
    -------
    IntensityMeasure
        The measure.

    Raises
    ------
    ConfigurationError
        For a measure that there is not, a period that is none, or none of a structure.

    Examples
    --------
    >>> rocking.intensity_measure("SA(0.5)").unit
    'g'
    >>> rocking.intensity_measure("AvgSA", rocking.Block.of_size(0.6, 3.0)).name
    'AvgSA(0.517,3.74)'
    """
    stem, periods = _parsed(name)
    known = INTENSITY_MEASURES.get(stem) or _BY_OPENQUAKE.get(stem)
    if known:
        return known
    if periods:
        return WITH_PERIODS[stem][1](*periods)
    mechanism = structure.mechanism() if isinstance(structure, Structure) else structure
    measure = _from_structure(stem, mechanism)
    return INTENSITY_MEASURES["pgv"] if mechanism and _is_one_swing(mechanism) else measure


def of_openquake(name: str) -> tuple[str, float]:
    """Return OpenQuake's name of a measure, and a value in its unit there over the same in ours.

    Raises ConfigurationError for one that there is not, or that OpenQuake lacks. AvgSA does not say its range there.
    """
    if _parsed(name)[0] == "AvgSA":
        return "AvgSA", 1.0
    measure = intensity_measure(name)
    if not measure.openquake:
        raise ConfigurationError(
            f"intensity_measure is {name!r}, which OpenQuake lacks; take another, such as pgv.",
            intensity_measure=name,
        )
    return measure.openquake, measure.openquake_scale


def check_name(name: str) -> None:
    """Raise ConfigurationError unless it is the name of a measure; one that takes its periods from a structure is."""
    stem, periods = _parsed(name)
    if stem in WITH_PERIODS and not periods and stem not in FROM_STRUCTURE:
        _from_structure(stem, None)


def _parsed(name: str) -> tuple[str, tuple[float, ...]]:
    """The name without its periods, and the periods, s; none where it says none."""
    spelled = _SPELLED.fullmatch(name)
    stem, inside = spelled.groups() if spelled else (name, None)
    if inside is None and (stem in INTENSITY_MEASURES or stem in _BY_OPENQUAKE or stem in WITH_PERIODS):
        return stem, ()
    if stem not in WITH_PERIODS:
        raise ConfigurationError(
            f"intensity_measure is {name!r}, but must be one of {', '.join(SPELLINGS)}.",
            intensity_measure=name,
        )
    count = WITH_PERIODS[stem][0]
    try:
        periods = [float(period) for period in (inside or "").split(",")]
    except ValueError:
        periods = []
    is_range = all(0 < period <= LONGEST_PERIOD for period in periods) and periods == sorted(set(periods))
    if len(periods) != count or not is_range:
        must = "a period in s" if count == 1 else "two ascending periods in s, parted by a comma,"
        raise ConfigurationError(
            f"intensity_measure is {name!r}, but {stem} must have {must} above 0 and up to {LONGEST_PERIOD:g}.",
            intensity_measure=name,
        )
    return stem, tuple(periods)


def _from_structure(stem: str, mechanism: Mechanism | None) -> IntensityMeasure:
    """AvgSA or FIV3 at the periods that follow from a structure alone, to three digits."""
    count, made = WITH_PERIODS[stem]
    if mechanism is None or stem not in FROM_STRUCTURE:
        raise ConfigurationError(
            f"intensity_measure is {stem!r}, but must say its {'period' if count == 1 else 'periods'} here, as in "
            f"{stem}({'0.5' if count == 1 else '0.2,2.0'}).",
            intensity_measure=stem,
        )
    period = 2 * math.pi / mechanism.equivalent_block("exact_at_rest").frequency_parameter
    shares = RANGE_BY_PERIOD if stem == "AvgSA" else (FIV3_BY_PERIOD,)
    return made(*(float(f"{share * period:.3g}") for share in shares))


def _is_one_swing(mechanism: Mechanism) -> bool:
    loses_much = (
        mechanism.uplift_multiplier <= ONE_SWING_MULTIPLIER and mechanism.restitution < ONE_SWING_RESTITUTION
    )
    return mechanism.one_sided or loses_much


def compared(mechanism: Mechanism) -> tuple[IntensityMeasure, ...]:
    """Return the measures whose scatter is reported for a structure: all without a period, and three with."""
    from_structure = (_from_structure(definition, mechanism) for definition in FROM_STRUCTURE)
    return *INTENSITY_MEASURES.values(), _spectral(1.0), *from_structure
