"""Sets of natural records whose mean spectrum is that of a design level, as NTC 2018, 3.2.3.6 asks for them.

Each record has one factor, whatever set it stands in: the one that brings the logarithms of its spectrum nearest to the
target, within limits. The mean of the set is then about 15 % above the target, amid what is allowed, as a mean lies
above a median. Sets are drawn at random, one pair of components a station, so that other sets can be asked what they
would have said.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.kinds import CheckKind
from rocking.drawn import Drawn
from rocking.earthquakes.sample import ClusterSample, earthquakes_of, stations_of
from rocking.errors import ConfigurationError
from rocking.quantities import positive
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.measures import response_spectrum
from rocking.warnings import RockingWarning

STATIONS = 20
"""The stations of a set: with 7 the verdict hangs on the choice for one wall in nine, with 20 for one in thirty-six."""

SETS = 200
"""Drawn in addition to the chosen one, to say what another would have said."""

BELOW = 0.10
"""The allowed deviation of the mean spectrum below the target (NTC 2018, 3.2.3.6)."""
ABOVE = 0.30
"""The allowed deviation above it (the same place)."""

_PATIENCE = 100_000
"""Sets none of which lay within the limits after which no more are drawn."""

_CHUNK = 2000
_PERIODS_PER_DOUBLING = 8


@dataclass(frozen=True, eq=False)
class ScaledPool:
    """Records, each with the factor that brings it nearest to a design spectrum.

    names, stations: (m,) of the pool. each_unnamed: whether records that name no earthquake are of one each, not all of
    one. pairs: its horizontal components, unscaled. factors: (m,), by which each is
    scaled. periods: (k,) s. target: (k,) m/s². spectra: (m, k) m/s², of each scaled pair the mean of its components,
    5 % damping or that of the design spectrum.
    """

    names: tuple[str, ...]
    stations: tuple[str, ...] = field(repr=False)
    pairs: tuple[tuple[Accelerogram, ...], ...] = field(repr=False)
    factors: np.ndarray = field(repr=False)
    periods: np.ndarray = field(repr=False)
    target: np.ndarray = field(repr=False)
    spectra: np.ndarray = field(repr=False)
    each_unnamed: bool = field(default=False, repr=False, kw_only=True)

    @cached_property
    def sample(self) -> ClusterSample:
        """The stations and the earthquakes of the records."""
        firsts = [first for first, *_ in self.pairs]
        return ClusterSample.of(firsts, self.stations, each_unnamed=self.each_unnamed)

    def scaled(self, place: int) -> tuple[Accelerogram, ...]:
        """Return the components of a record of the pool, scaled."""
        return tuple(component.scaled(float(self.factors[place])) for component in self.pairs[place])


@dataclass(frozen=True, eq=False)
class Selection(ScaledPool, Drawn):
    """Sets of records for a design spectrum; `plot` draws the chosen one against its target.

    Parameters
    ----------
    names : tuple of str
        Names of the records of the pool.
    stations : tuple of str
        Their stations.
    pairs : tuple of tuple of Accelerogram
        Their horizontal components.
    factors : ndarray
        (p,) factors by which they are scaled.
    periods : ndarray
        (k,) periods of the spectra, s.
    target : ndarray
        (k,) target spectrum, m/s².
    spectra : ndarray
        (p, k) spectra of the scaled records, m/s².
    sets : ndarray
        (s, n) places in the pool, each within the limits.
    chosen : ndarray
        (n,) places of the set whose mean lies nearest to the target.
    drawn : int
        Number of sets that were tried.
    below : float
        Share by which the mean may lie below the target.
    above : float
        Share by which it may lie above.
    each_unnamed : bool, default False
        Whether records that name no earthquake are of one each, not all of one.

    Examples
    --------
    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> pool = {"one": [record]}
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.4)
    >>> rocking.select(pool, spectrum, 1, below=0.9, above=9.0).chosen_names
    ('one',)
    """

    sets: np.ndarray = field(repr=False)
    chosen: np.ndarray = field(repr=False)
    drawn: int
    below: float
    above: float

    @property
    def mean(self) -> np.ndarray:
        """(k,) m/s²: the mean spectrum of the chosen set."""
        mean: np.ndarray = self.spectra[self.chosen].mean(axis=0)
        return mean

    @property
    def deviations(self) -> tuple[float, float]:
        """The deviation of the mean of the chosen set below and above the target, as shares."""
        ratio = self.mean / self.target
        return float(ratio.min() - 1), float(ratio.max() - 1)

    @property
    def chosen_names(self) -> tuple[str, ...]:
        """The records of the chosen set."""
        return tuple(self.names[place] for place in self.chosen)

    def redrawn(
        self, drawn: np.ndarray, rng: np.random.Generator, tries: int = 4000, most: int = SETS
    ) -> np.ndarray:
        """Return sets (s, n), s up to `most`, within the limits, where the stations of the pool are drawn again.

        drawn: how often each station of `sample` is. As often as one is drawn it counts as another; fewer of them than
        a set has make no set.
        """
        turns = [
            (record, turn * self.sample.count + station)
            for record, station in enumerate(self.sample.of_record.tolist())
            for turn in range(int(drawn[station]))
        ]
        places, labels = np.array(turns, dtype=int).reshape(-1, 2).T
        if np.unique(labels).size < self.chosen.size:
            return np.empty((0, self.chosen.size), dtype=int)
        ratios = self.spectra / self.target
        found: list[np.ndarray] = []
        for own in random_sets(labels, self.chosen.size, tries, rng):
            sets = places[own]
            means = ratios[sets].mean(axis=1)
            allowed = (means.min(axis=1) >= 1 - self.below) & (means.max(axis=1) <= 1 + self.above)
            found.append(sets[allowed])
            if sum(map(len, found)) >= most:
                break
        return np.concatenate(found)[:most]

    @cached_property
    def words(self) -> str:
        """The deviations and scale factors of the chosen set, in words."""
        low, high = self.deviations
        factors = self.factors[self.chosen]
        return (
            f"{self.chosen.size} records of as many stations out of {len(self.names)} of {self.sample.words}; "
            f"the mean spectrum lies between {100 * low:+.0f} and {100 * high:+.0f} % of the target from "
            f"{self.periods[0]:.3g} to {self.periods[-1]:.3g} s; factors from {factors.min():.3g} to "
            f"{factors.max():.3g}, median {np.median(factors):.3g}; {len(self.sets)} other sets within the limits, "
            f"of {self.drawn} drawn"
        )


def select(
    records: Mapping[str, Sequence[Accelerogram]],
    spectrum: DesignSpectrum,
    stations: int = STATIONS,
    *,
    periods: tuple[float, float] = (0.15, 2.0),
    factors: tuple[float, float] = (0.25, 4.0),
    below: float = BELOW,
    above: float = ABOVE,
    sets: int = SETS,
    tries: int = 1_000_000,
    seed: int = 0,
    each_unnamed: bool = False,
) -> Selection:
    """Return sets of `stations` records whose mean spectrum lies within the limits about `spectrum`.

    Parameters
    ----------
    records : mapping of str to sequence of Accelerogram
        The horizontal components of each, by name; those of one station, by what its files call it and as far
        as the shorter name goes, do not meet in a set.
    spectrum : DesignSpectrum
        The target, at the design level.
    stations : int, default 20
        Number of records of a set.
    periods : tuple of (float, float), optional
        Shortest and longest of the range that counts, s; the longest should be twice the secant period of the
        structure where that is more than 2 s.
    factors : tuple of (float, float), optional
        Least and largest factor on a record.
    below : float, default 0.1
        Share by which the mean spectrum may lie below the target.
    above : float, default 0.3
        Share by which it may lie above.
    sets : int, default 200
        Number of sets that are drawn in addition to the chosen one.
    tries : int, default 1000000
        Largest number of sets that are tried.
    seed : int, default 0
        Seed of the draw; the same one gives the same sets.
    each_unnamed : bool, default False
        Whether records that name no earthquake are of one each, not all of one.

    Returns
    -------
    Selection
        The sets, and the one whose mean lies nearest to the target.

    Raises
    ------
    ConfigurationError
        For fewer stations than asked for, a range or limits that are none, and where no set meets the limits:
        it says how near the best one came.

    Examples
    --------
    >>> spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.4)
    >>> (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    >>> scaled = [rocking.Accelerogram(f * record.acceleration, 0.01, station=str(f)) for f in (0.9, 1.0, 1.1, 1.2)]
    >>> pool = {record.station: [record] for record in scaled}
    >>> rocking.select(pool, spectrum, 3, below=0.9, above=9.0, sets=2).chosen.size
    3
    """
    for name, value in (("stations", stations), ("below", below), ("above", above), ("tries", tries)):
        positive(ConfigurationError, name, value)
    pool = scaled_pool(records, spectrum, periods, factors)
    draws = random_sets(np.array(pool.stations), stations, tries, np.random.default_rng(seed))
    found, chosen, drawn = search(pool.spectra / pool.target, draws, below, above, sets)
    of_pool = vars(pool) | {"each_unnamed": each_unnamed}
    return Selection(**of_pool, sets=found, chosen=chosen, drawn=drawn, below=below, above=above)


def scaled_pool(
    records: Mapping[str, Sequence[Accelerogram]],
    spectrum: DesignSpectrum,
    periods: tuple[float, float],
    factors: tuple[float, float],
) -> ScaledPool:
    """Return records with the factor that brings each nearest to `spectrum`, within the limits; as `select` does."""
    _check_ranges(periods, factors)
    shortest, longest = periods
    count = 1 + math.ceil(_PERIODS_PER_DOUBLING * math.log2(longest / shortest))
    grid = np.geomspace(shortest, longest, count)
    target = np.asarray(spectrum.acceleration(grid))
    means = [_mean_spectrum(pair, grid, spectrum.damping) for pair in records.values()]
    own = np.array(means).reshape(-1, count)
    scaling = np.clip(np.exp(np.log(target / own).mean(axis=1)), *factors)
    return ScaledPool(
        names=tuple(records),
        stations=_stations(records, own),
        pairs=tuple(tuple(pair) for pair in records.values()),
        factors=scaling,
        periods=grid,
        target=target,
        spectra=own * scaling[:, None],
    )


def _check_ranges(periods: tuple[float, float], factors: tuple[float, float]) -> None:
    shortest, longest = periods
    if not 0 < shortest < longest:
        raise ConfigurationError(
            f"periods is {shortest:g} to {longest:g} s, but must go from above 0 to a longer one.",
            periods=(shortest, longest),
        )
    least, most = factors
    if not 0 < least <= most:
        raise ConfigurationError(
            f"factors is {least:g} to {most:g}, but must go from above 0 to as much or more.", factors=factors
        )


def _mean_spectrum(pair: Sequence[Accelerogram], periods: np.ndarray, damping: float) -> np.ndarray:
    spectra = [response_spectrum(component, periods, damping).pseudo_acceleration for component in pair]
    mean: np.ndarray = np.mean(spectra, axis=0)
    return mean


def _stations(records: Mapping[str, Sequence[Accelerogram]], spectra: np.ndarray) -> tuple[str, ...]:
    """The identities of the stations of a pool, as `stations_of` has them; the name of a record that names none.

    Two whose spectra (m, k) are the same are one, too, as the motion is.
    """
    firsts = [first for first, *_ in records.values()]
    named = stations_of(firsts, earthquakes_of(firsts), list(records))
    of_motion: dict[bytes, str] = {}
    return tuple(
        of_motion.setdefault(np.round(np.log(spectrum), 9).tobytes(), name)
        for name, spectrum in zip(named, spectra, strict=True)
    )


# One loop draws, judges and remembers: a reader has to see all it carries from draw to draw.
def search(
    ratios: np.ndarray, draws: Iterable[np.ndarray], below: float, above: float, sets: int = SETS
) -> tuple[np.ndarray, np.ndarray, int]:
    """Return sets (s, count) of places whose mean ratio lies within the limits, the nearest one, and how many it drew.

    ratios: (m, k), spectrum over target. draws: sets of places, (c, count) each; all are asked for unless twice as
    many sets as wanted were within the limits, or of the first 100 000 none. The nearest one is the least in the mean
    square of its logarithms. Raises ConfigurationError where no set is within the limits.
    """
    found: list[np.ndarray] = []
    distances: list[np.ndarray] = []
    number = drawn = 0
    nearest = math.inf
    extremes = (0.0, 0.0)
    count = 0
    for places in draws:
        count = places.shape[1]
        means = ratios[places].mean(axis=1)
        low = means.min(axis=1) - 1
        high = means.max(axis=1) - 1
        excess = np.maximum(-below - low, high - above)
        best = int(np.argmin(excess))
        if excess[best] < nearest:
            nearest = float(excess[best])
            extremes = (float(low[best]), float(high[best]))
        within_limits = excess <= 0
        found.append(places[within_limits])
        distances.append((np.log(means[within_limits]) ** 2).mean(axis=1))
        drawn += len(places)
        number += int(within_limits.sum())
        if number > 2 * sets or (not number and drawn >= _PATIENCE):
            break
    if not number:
        raise ConfigurationError.saying(
            RockingWarning.of(
                CheckKind.NO_SET_WITHIN,
                count=count,
                drawn=drawn,
                below_percent=-100 * below,
                above_percent=100 * above,
                low_percent=100 * extremes[0],
                high_percent=100 * extremes[1],
            )
        )
    all_found = np.concatenate(found)
    chosen = int(np.argmin(np.concatenate(distances)))
    others = np.delete(all_found, chosen, axis=0)[:sets]
    return others, all_found[chosen], drawn


def random_sets(
    stations: np.ndarray, count: int, tries: int, rng: np.random.Generator
) -> Iterator[np.ndarray]:
    """Yield random sets of places, (c, count) each, `tries` in all, every one of as many stations.

    stations: of each place. Raises ConfigurationError where they are fewer than `count`.
    """
    names, of_record = np.unique(stations, return_inverse=True)
    if names.size < count:
        warning = RockingWarning.of(CheckKind.STATIONS_TOO_FEW, stations=int(names.size), count=count)
        raise ConfigurationError.saying(warning)
    order = np.argsort(of_record, kind="stable")
    sizes = np.bincount(of_record)
    begins = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    for start in range(0, tries, _CHUNK):
        rows = min(_CHUNK, tries - start)
        lots = rng.random((rows, sizes.size), dtype=np.float32)
        chosen = np.argpartition(lots, count - 1, axis=1)[:, :count]
        of_station = np.floor(rng.random((rows, count)) * sizes[chosen]).astype(int)
        yield np.sort(order[begins[chosen] + of_station], axis=1)
