"""The sample behind a figure: stations within earthquakes, and the intervals that follow from how they scatter.

The stations of one earthquake have its source in common, so that many of them say less about another earthquake than as
many scattered ones. Every interval over records is therefore one over earthquakes, and is made by `ClusterSample`: its
`interval` of any statistic (in two stages: earthquakes are drawn, and stations within each), `share_bounds` of a share,
and `spread` for the laws of a mean. Components, directions and processings of a station are one station.
"""

import math
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cached_property
from typing import Protocol

import numpy as np

from rocking.earthquakes.kinds import SampleKind
from rocking.errors import ConfigurationError
from rocking.quantities import counted
from rocking.warnings import Phrase, RockingWarning

FEWEST = 5
"""Earthquakes below which nothing is resampled: the interval is then Student's, or Clopper and Pearson's, on them."""
CORRELATION = 0.2
"""Least intraclass correlation of what stations of one earthquake show, where less is seen: few estimate it poorly."""
REPLICATES = 1000
"""Samples that are drawn for an interval."""
TAIL = 0.05
"""Beyond either end of an interval of 90 %."""
MADE = "Synthetic, not recorded"
"""In place of the earthquake of a record that nobody recorded: what comes of it is counted apart."""
UNNAMED = "not named"
"""The one earthquake of all records whose earthquake neither a catalogue nor a header names."""

_LETTERS = 4
"""First letters in which the names of one earthquake are alike, whatever follows: Northridge-01, NORTHRIDGE EQ."""
_AT_ONCE = 300.0
"""Seconds within which two origin times are of one earthquake: catalogues locate it by different stations."""
_A_DAY = 86_400.0
"""Seconds by which the days of one earthquake may differ, in universal and in local time."""
_GENERIC = frozenset(("event", "earthquake", "quake", "record", "run", "the"))


class Recorded(Protocol):
    """What names a record: an accelerogram, or its row in a table."""

    @property
    def event(self) -> str: ...
    @property
    def station(self) -> str: ...
    @property
    def event_time(self) -> str: ...


@dataclass(frozen=True)
class _Earthquake:
    """An earthquake as one record names it.

    stem: letters that its name begins with, or the whole of a name without words. number: after the name, as in the
    PEER databases. year, instant: s since 1970, at noon of a day without an hour (`has_hour`); None where not said.
    """

    stem: str
    number: str
    year: int | None
    instant: float | None
    has_hour: bool

    @classmethod
    def named(cls, event: str, event_time: str) -> "_Earthquake":
        words = [word for word in re.findall(r"[^\W\d_]{3,}", event.lower()) if word not in _GENERIC]
        stem = "".join(words)[:_LETTERS] or re.sub(r"\W", "", (event or event_time).lower())
        # After a figure it is the end of a date, or an hour.
        number = re.search(r"[A-Za-z]-(\d\d)(?!\d|-)|(?<!\d)[\s_#-](\d{1,3})$", event)
        which = (number[1] or number[2]).lstrip("0") or "0" if number else ""
        instant, has_hour = _instant(event_time)
        if instant is None:
            instant, has_hour = _instant(event)
        # A day before a year: an hour follows it, KOBE 01/16/95 2046.
        short = re.search(r"\b\d{1,2}/\d{1,2}/(\d\d)\b", event)
        year = re.search(r"\b(1[89]\d\d|20\d\d)(?!\d)", event)
        stated_year = int(year[1]) if year else None
        if short:
            stated_year = int(short[1]) + (1900 if int(short[1]) >= 30 else 2000)
        if stated_year is None and instant is not None:
            stated_year = datetime.fromtimestamp(instant, UTC).year
        return cls(stem, which, stated_year, instant, has_hour)

    def is_of(self, other: "_Earthquake") -> bool:
        """Whether both are one: of one time, or of one name that neither number, year nor day contradicts."""
        apart = math.nan
        if self.instant is not None and other.instant is not None:
            apart = abs(self.instant - other.instant)
            if self.has_hour and other.has_hour:
                return apart <= _AT_ONCE
        if not (self.stem and other.stem) or apart > _A_DAY:
            return False
        if self.number and other.number and self.number != other.number:
            return False
        if self.year and other.year and self.year != other.year:
            return False
        shorter, longer = sorted((self.stem, other.stem), key=len)
        return longer == shorter or (shorter.isalpha() and longer.isalpha() and longer.startswith(shorter))


def _instant(text: str) -> tuple[float | None, bool]:
    """The time in a text, 2016-10-30T06:40:18 or 20161030, s since 1970, and whether it says the hour."""
    found = re.search(r"(?<!\d)(\d{4})([-/]?)(\d\d)\2(\d\d)(?!\d)(?:[T ](\d\d:\d\d(?::\d\d)?))?", text)
    if not found:
        return None, False
    year, _, month, day, hour = found.groups()
    try:
        at = datetime.fromisoformat(f"{year}-{month}-{day}T{hour or '12:00'}+00:00")
    except ValueError:
        return None, False
    return at.timestamp(), hour is not None


def earthquakes_of(records: Iterable[Recorded]) -> list[str]:
    """Return the earthquake of each record, (r,), as the first that is of it names it; "" where nothing says it.

    Names are alike in their first four letters where neither number, year nor day says otherwise, and whatever they
    are where both say one time to five minutes.
    """
    known: list[tuple[_Earthquake, str]] = []
    named = []
    for record in records:
        if not (record.event.strip() or record.event_time.strip()):
            named.append("")
            continue
        own = _Earthquake.named(record.event, record.event_time)
        name = next((name for earlier, name in known if own.is_of(earlier)), None)
        if name is None:
            name = record.event.strip() or record.event_time.strip()
            taken = {name for _, name in known}
            if name in taken:  # one name for two earthquakes of other days
                name = f"{name}, {record.event_time.strip() or len(taken)}"
        known.append((own, name))
        named.append(name)
    return named


def stations_of(
    records: Sequence[Recorded], earthquakes: Sequence[str], rows: Sequence[str] | None = None
) -> list[str]:
    """Return the station of each record in its earthquake, (r,); of one that names none, its row of a catalogue, or
    the record by itself.

    Catalogues differ in how much they add to a name: those of one earthquake are one station whose words begin alike,
    as far as the shorter name goes.
    """
    known: dict[str, list[tuple[list[str], str]]] = {}
    named = []
    for place, (record, earthquake) in enumerate(zip(records, earthquakes, strict=True)):
        words = re.findall(r"\w+", record.station.lower())
        if not words:
            named.append(rows[place] if rows is not None else f"record {place}")
            continue
        earlier = known.setdefault(earthquake, [])
        alike = (
            name
            for of_station, name in earlier
            if all(one == other for one, other in zip(of_station, words, strict=False))
        )
        name = next(alike, f"{record.event}; {record.station}")
        earlier.append((words, name))
        named.append(name)
    return named


@dataclass(frozen=True)
class Spread:
    """How a mean over stations scatters by earthquakes.

    values, weights: (e,) the mean of the stations of each earthquake, and the share of all stations that are of it.
    """

    values: np.ndarray
    weights: np.ndarray

    @property
    def mean(self) -> float:
        """The mean over the stations."""
        return float(self.weights @ self.values)

    @property
    def count(self) -> float:
        """As many earthquakes with the same number of stations each give as much information (Kish)."""
        return float(1 / (self.weights**2).sum())

    @property
    def deviation(self) -> float:
        """The standard deviation of the earthquakes; nan of one."""
        free = 1 - float((self.weights**2).sum())
        if free <= 0:
            return math.nan
        return math.sqrt(float(self.weights @ (self.values - self.mean) ** 2) / free)

    @property
    def error(self) -> float:
        """The standard error of the mean, by the earthquakes; nan of one."""
        return self.deviation / math.sqrt(self.count)

    def of(self, values: np.ndarray) -> "Spread":
        """Return the same earthquakes with other values (e,)."""
        return Spread(values, self.weights)

    def part(self, chosen: np.ndarray) -> "Spread":
        """Return some of the earthquakes, (e,) of bool."""
        return Spread(self.values[chosen], self.weights[chosen] / self.weights[chosen].sum())

    def reach(self, tail: float = TAIL) -> float:
        """Return how far the mean may be from the truth, with this risk to either side (Student); inf of one."""
        if self.values.size < 2:
            return math.inf
        return students(freedom=self.count - 1, tail=tail) * self.error


INTERVAL = f"interval (90 % from {FEWEST} earthquakes on)"
"""What the columns of tables call an interval, which do not know over how many earthquakes it will be."""


def interval_words(earthquakes: int, noun: str = "interval") -> Phrase:
    """Return what an interval, or its bounds, over so many earthquakes is called, wherever one is printed.

    From FEWEST on it holds nine times in ten; of fewer it is computed alike, and holds less often; of one there is
    none.

    >>> interval_words(3), interval_words(7)
    ('interval of 3 earthquakes, which holds less than nine times in ten', '90 % interval')
    """
    if earthquakes >= FEWEST:
        return Phrase(f"90 % {noun}")
    if earthquakes < 2:
        return Phrase(f"{noun}, which one earthquake does not give")
    text = f"{noun} of {{earthquakes}} earthquakes, which holds less than nine times in ten"
    return Phrase(text, earthquakes=earthquakes)


def students(*, freedom: float, tail: float = TAIL) -> float:
    """Return the quantile of Student's law that is exceeded with the risk `tail`; inf where nothing is free."""
    from scipy.special import stdtrit  # slow to import for the main job of a study

    return float(stdtrit(freedom, 1 - tail)) if freedom > 0 else math.inf


@dataclass(frozen=True, eq=False)
class ClusterSample:
    """A two-stage cluster sample: which records are of one station, and which stations of one earthquake.

    stations, events: (r,) names. warnings: what there is to say of the names. Raises ConfigurationError unless each
    record has one of both.

    >>> sample = ClusterSample(("a", "a", "b", "c"), ("Kobe", "Kobe", "Kobe", "Landers"))
    >>> sample.words
    '3 stations of 2 earthquakes'
    """

    stations: tuple[str, ...]
    events: tuple[str, ...]
    warnings: tuple[RockingWarning, ...] = field(default=())

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.events):
            raise ConfigurationError(
                f"events names {len(self.events)}, but must name one for each of {len(self.stations)} records.",
                events=len(self.events),
            )

    @classmethod
    def of(
        cls,
        records: Sequence[Recorded],
        stations: Sequence[str] | None = None,
        events: Sequence[str] | None = None,
        *,
        rows: Sequence[str] | None = None,
        each_unnamed: bool = False,
    ) -> "ClusterSample":
        """Return the sample of records, by what they name or by given names, (r,).

        rows: of a catalogue, whose components are of one station where they name none. each_unnamed: declares that what
        names no earthquake is of one each; else all of it counts as one. Raises ConfigurationError unless there is one
        name a record.
        """
        for name, given in (("stations", stations), ("events", events)):
            if given is not None and len(given) != len(records):
                raise ConfigurationError(
                    f"{name} names {len(given)}, but must name one for each of {len(records)} records.",
                    **{name: len(given)},
                )
        of_records = list(map(str, events)) if events is not None else earthquakes_of(records)
        own = list(map(str, stations)) if stations is not None else stations_of(records, of_records, rows)
        warnings = []
        unnamed = [place for place, event in enumerate(of_records) if not event]
        if unnamed and not each_unnamed:
            of_rows = rows or range(len(records))  # the components of a row are one record
            count = len({of_rows[place] for place in unnamed})
            warnings.append(
                RockingWarning.of(SampleKind.EARTHQUAKES_UNNAMED, records=count, all=len(set(of_rows)))
            )
        filled = [
            event or (own[place] if each_unnamed else UNNAMED) for place, event in enumerate(of_records)
        ]
        for event, other in _named_twice(records, filled) if events is None else ():
            warnings.append(RockingWarning.of(SampleKind.EARTHQUAKE_NAMED_TWICE, first=event, second=other))
        first_of: dict[str, str] = {}
        for station, event in zip(own, filled, strict=True):
            first = first_of.setdefault(station, event)
            if first != event:
                warnings.append(
                    RockingWarning.of(
                        SampleKind.STATION_OF_TWO_EARTHQUAKES, station, first=first, second=event
                    )
                )
        of_station = [first_of[station] for station in own]
        made = cls(tuple(own), tuple(of_station))
        if made.earthquakes == 1 < made.count and not unnamed:
            warnings.append(RockingWarning.of(SampleKind.EARTHQUAKE_ONE, stations=made.count))
        elif 1 < made.earthquakes < FEWEST:
            warnings.append(
                RockingWarning.of(SampleKind.EARTHQUAKES_FEW, earthquakes=made.earthquakes, fewest=FEWEST)
            )
        return cls(made.stations, made.events, tuple(dict.fromkeys(warnings)))

    @classmethod
    def scattered(cls, stations: Sequence[str]) -> "ClusterSample":
        """Return stations (r,) of which each is of another earthquake."""
        return cls(tuple(map(str, stations)), tuple(map(str, stations)))

    @classmethod
    def named(cls, names: Iterable[tuple[str, str]]) -> "ClusterSample":
        """Return the sample of records by the station and the earthquake of each."""
        pairs = list(names)
        return cls(tuple(station for station, _ in pairs), tuple(event for _, event in pairs))

    @cached_property
    def station_names(self) -> tuple[str, ...]:
        """(s,): the stations, each once, in the order of the records."""
        return tuple(dict.fromkeys(self.stations))

    @cached_property
    def of_record(self) -> np.ndarray:
        """(r,): the place of the station of each record."""
        places = {name: place for place, name in enumerate(self.station_names)}
        return np.array([places[name] for name in self.stations], dtype=int)

    @cached_property
    def event_names(self) -> tuple[str, ...]:
        """(s,): the earthquake of each station."""
        return tuple(dict(zip(self.stations, self.events, strict=True)).values())

    @cached_property
    def of_station(self) -> np.ndarray:
        """(s,): the place of the earthquake of each station."""
        places = {name: place for place, name in enumerate(dict.fromkeys(self.event_names))}
        return np.array([places[name] for name in self.event_names], dtype=int)

    @property
    def count(self) -> int:
        """The number of stations."""
        return len(self.station_names)

    @cached_property
    def sizes(self) -> np.ndarray:
        """(e,): the number of stations of each earthquake."""
        return np.bincount(self.of_station)

    @property
    def earthquakes(self) -> int:
        """The number of earthquakes."""
        return self.sizes.size

    @property
    def words(self) -> str:
        """Both: "22 stations of 6 earthquakes"."""
        return f"{counted(self.count, 'station')} of {counted(self.earthquakes, 'earthquake')}"

    def part(self, places: Sequence[int] | np.ndarray) -> "ClusterSample":
        """Return some of the stations, by their places, each with one record; one that comes twice counts as two."""
        names = [self.station_names[place] for place in places]
        again = [f"{name} {turn}" if names.index(name) != turn else name for turn, name in enumerate(names)]
        return ClusterSample(tuple(again), tuple(self.event_names[place] for place in places))

    def of_records(self, chosen: np.ndarray) -> "ClusterSample":
        """Return the sample of some of the records, by their places or (r,) of bool."""
        return ClusterSample(
            tuple(np.asarray(self.stations, dtype=object)[chosen]),
            tuple(np.asarray(self.events, dtype=object)[chosen]),
        )

    def by_station(self, values: np.ndarray) -> np.ndarray:
        """Return the mean over the records of each station, (s, ...), of values (r, ...)."""
        values = np.asarray(values, dtype=float)
        summed = np.zeros((self.count, *values.shape[1:]))
        np.add.at(summed, self.of_record, values)
        records = np.bincount(self.of_record).reshape(-1, *(1,) * (values.ndim - 1))
        return summed / records

    def spread(self, values: np.ndarray) -> Spread:
        """Return how the mean of the values (s,) of the stations scatters by earthquakes."""
        means = np.bincount(self.of_station, weights=np.asarray(values, dtype=float)) / self.sizes
        return Spread(means, self.sizes / self.count)

    def redrawn(self, replicates: int = REPLICATES, seed: int = 0) -> np.ndarray:
        """Return how often each station is drawn, (replicates, s): earthquakes first, and stations within each."""
        rng = np.random.default_rng(seed)
        count = self.earthquakes
        of_events = rng.multinomial(count, np.full(count, 1 / count), replicates)
        drawn = np.zeros((replicates, self.count))
        # By name, so that the order of the records draws no other samples.
        names = list(zip(self.event_names, self.station_names, strict=True))
        by_name = np.array(sorted(range(self.count), key=names.__getitem__), dtype=int)
        for column, event in enumerate(dict.fromkeys(self.of_station[by_name].tolist())):
            members = by_name[self.of_station[by_name] == event]
            again = of_events[:, column] * members.size
            drawn[:, members] = rng.multinomial(again, np.full(members.size, 1 / members.size))
        return drawn

    @cached_property
    def _drawn(self) -> np.ndarray:
        return self.redrawn()

    def interval(
        self, statistic: Callable[[np.ndarray], float], replicates: int = REPLICATES
    ) -> tuple[float, float]:
        """Return the 90 % interval of a statistic above 0, which takes the weights (s,) of the stations.

        replicates: how many samples are drawn, REPLICATES at most; those for which the statistic is nan do not count.

        From five earthquakes on by resampling in two stages. Its ends lie farther out than 5 and 95 %, by what the
        scatter of few hides: the expanded percentile interval of Hesterberg (2015), What teachers should know about the
        bootstrap, Am. Stat. 69, 371-386. Of fewer, Student's for the logarithms of the statistic of each earthquake by
        itself. One earthquake says nothing of others: 0 to inf.
        """
        from scipy.special import ndtr, stdtrit

        count = self.earthquakes
        if count < 2:
            return 0.0, math.inf
        if count < FEWEST:
            own = [statistic((self.of_station == event).astype(float)) for event in range(count)]
            middle = statistic(np.ones(self.count))
            if not all(0 < result < math.inf for result in (*own, middle)):
                return 0.0, math.inf
            # A wide one overflows: nothing is known then.
            reach = min(Spread(np.log(own), self.sizes / self.count).reach(), 700.0)
            return middle * math.exp(-reach), middle * math.exp(reach)
        tail = float(ndtr(-((count / (count - 1)) ** 0.5) * stdtrit(count - 1, 1 - TAIL)))
        values = np.array([statistic(weights) for weights in self._drawn[:replicates]])
        ordered = np.sort(values[~np.isnan(values)])
        if not ordered.size:
            return math.nan, math.nan
        outer = int(np.floor(tail * (ordered.size - 1)))
        return float(ordered[outer]), float(ordered[-1 - outer])

    def share_bounds(
        self, shares: np.ndarray, tail: float = TAIL, tried: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the lower and the upper bound (...) of the mean of shares (s, ...), each with the risk `tail`.

        tried: (s, ...) how much of each share was tried, 1 or less; None: all of it. The bounds are those of Clopper
        and Pearson for as many independent stations as tell as much: n/(1 + (m − 1)ρ) of n stations, m of an
        earthquake, with the intraclass correlation ρ that they show and at least CORRELATION, less what so few
        earthquakes leave unknown (Korn & Graubard 1998, Surv. Methodol. 24, 193-201); of fewer than five earthquakes,
        for as many as they are. Where all or none fall, the bound there is 1 or 0; nan where nothing was tried.
        """
        from scipy.special import betaincinv, stdtrit

        shares = np.asarray(shares, dtype=float)
        weights = np.ones(shares.shape) if tried is None else np.asarray(tried, dtype=float)
        total = weights.sum(axis=0)
        counting = weights > 0
        stations = counting.sum(axis=0)
        of_event = np.zeros((self.earthquakes, *shares.shape[1:]))
        np.add.at(of_event, self.of_station, counting.astype(float))
        events = (of_event > 0).sum(axis=0)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.clip(shares.sum(axis=0) / total, 0.0, 1.0)
            residuals = np.zeros(of_event.shape)
            np.add.at(residuals, self.of_station, shares - share * weights)
            scatter = (residuals**2).sum(axis=0) * events / np.maximum(events - 1, 1) / total**2
            effect = scatter * stations / (share * (1 - share))
            together = (of_event**2).sum(axis=0) / stations  # stations of the earthquake of a station
            seen = np.where(np.isfinite(effect) & (together > 1), (effect - 1) / (together - 1), 0.0)
            alike = np.clip(seen, CORRELATION, 1.0)
            number = stations / (1 + (together - 1) * alike)
            unknown = stdtrit(np.maximum(stations - 1, 1), 1 - tail) / stdtrit(
                np.maximum(events - 1, 1), 1 - tail
            )
            number = number * unknown**2
            number = np.where(events < FEWEST, events, number)
            low = betaincinv(share * number, (1 - share) * number + 1, tail)
            high = betaincinv(share * number + 1, (1 - share) * number, 1 - tail)
        low = np.where((share == 0) | (events < 2), 0.0, low)
        high = np.where((share == 1) | (events < 2), 1.0, high)
        untried = total == 0
        return np.where(untried, np.nan, low), np.where(untried, np.nan, high)


def _named_twice(records: Sequence[Recorded], events: Sequence[str]) -> Iterable[tuple[str, str]]:
    """Yield the names of the earthquakes of which two records hold the same motion."""
    first_of: dict[bytes, str] = {}
    for record, event in zip(records, events, strict=True):
        motion = getattr(record, "acceleration", None)
        if motion is None:
            continue
        first = first_of.setdefault(np.ascontiguousarray(motion).tobytes(), event)
        if first != event:
            yield first, event
