"""Real records by site and earthquake: what counts, the structures that are tried under them, and at what scale."""

import re
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import chain
from operator import itemgetter
from time import process_time
from typing import TypedDict, TypeVar

import numpy as np

from rocking.earthquakes.sample import UNNAMED, ClusterSample, earthquakes_of
from rocking.errors import RockingError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Arch, Block, Structure, Wall
from rocking.tables import Row, column, row

T = TypeVar("T")

MOST_COMPONENTS = 2
"""Of a site that count."""
NamedRecord = tuple[str, Accelerogram]
"""Identifier and accelerogram of a component."""
Records = Iterable[NamedRecord]
UPLIFTS = (1.3, 8.0)
"""Range of peak acceleration over the least uplift acceleration to which records are scaled, log-uniform."""


@dataclass(frozen=True)
class SiteRecord:
    """A component that counts.

    identifier: in the catalogue. site: event and station, as what came first names them. earthquake: as the first
    record of it names it.
    """

    identifier: str
    site: str
    earthquake: str
    accelerogram: Accelerogram

    @property
    def named(self) -> "Named":
        """What a trial under it says of it."""
        return {"record": self.identifier, "site": self.site, "earthquake": self.earthquake}

    @property
    def catalogue(self) -> str:
        """The catalogue that it is of: that on which thresholds were read off, or another one."""
        return "fema_p695" if self.identifier.startswith("P695") else "near_fault"


class Named(TypedDict):
    """The columns of a trial that name its component."""

    record: str
    site: str
    earthquake: str


@row()
class Trial(Row):
    """A structure under a record of a scale that lifts it."""

    record: str = column("Identifier of the record in the catalogue")
    site: str = column("Event and station")
    earthquake: str = column("Earthquake, as the first record of it names it")
    structure: str = column("Name of the structure")
    scale_factor: float = column("What the record was multiplied by")


def structures_tried() -> dict[str, Structure]:
    """Return blocks, walls and arches of p from 0.86 to 4.07 rad/s, from no defect to a forcing that grows by 30 %."""
    blocks = [(1.0, 0.2), (2.0, 0.12), (2.0, 0.4), (5.0, 0.15), (10.0, 0.1)]
    walls = [(1.5, 1.5, 0.4), (2.0, 1.0, 0.3)]
    arches = [(157.5, 0.15), (140.0, 0.15), (150.0, 0.10), (120.0, 0.15)]
    made: dict[str, Structure] = {f"block R {r:g} m, {a:g} rad": Block(r, a) for r, a in blocks}
    made |= {f"wall {h:g} + {k:g} m, {t:g} m": Wall(h, k, t) for h, k, t in walls}
    for degrees, share in arches:
        made[f"arch {degrees:g}°, t/r {share:g}"] = Arch(10.0, 10.0 * share, np.radians(degrees))
    made["one-sided block"] = Block.of_size(0.6, 6.0, one_sided=True, restitution=0.5)
    return made


def independent(records: Records) -> Iterator[SiteRecord]:
    """Yield the components that count, none under two names.

    A site is an earthquake and a station; stations are alike where the words of one begin with all those of the other,
    as catalogues differ in how much they add. What comes first names the site; a file of another catalogue for the same
    site, or of a direction that is there already, does not count.
    """
    sites: list[_Site] = []
    every = list(records)
    earthquakes = earthquakes_of(record for _, record in every)
    for (identifier, record), earthquake in zip(every, earthquakes, strict=True):
        words = re.findall(r"[a-z0-9]+", record.station.lower())
        site = next((site for site in sites if site.is_of(earthquake, words)), None)
        if site is None:
            site = _Site(earthquake, words, site_of(record))
            sites.append(site)
        direction: object = record.component or identifier
        if record.azimuth is not None:
            direction = round(record.azimuth) % 180
        is_same_catalogue = site_of(record) == site.name
        is_new = direction not in site.directions and len(site.directions) < MOST_COMPONENTS
        if is_same_catalogue and is_new:
            site.directions.add(direction)
            yield SiteRecord(identifier, site.name, earthquake or UNNAMED, record)


@dataclass(frozen=True)
class _Site:
    """A site as the first record names it. directions: of the components that count, degrees modulo 180 or names."""

    earthquake: str
    words: list[str]
    name: str
    directions: set[object] = field(default_factory=set)

    def is_of(self, earthquake: str, words: list[str]) -> bool:
        """Whether an earthquake and the words of a station are those of the site."""
        begins_alike = words[: len(self.words)] == self.words[: len(words)]
        return self.earthquake == earthquake and begins_alike and bool(words) and bool(self.words)


def sample_of(names: Iterable[str], earthquakes: Iterable[str]) -> ClusterSample:
    """Return the sample of cases by the site and the earthquake of each."""
    return ClusterSample.named(zip(names, earthquakes, strict=True))


def one_of_each(records: Iterable[SiteRecord]) -> list[SiteRecord]:
    """Return the first component of each site of records as `independent` gives them."""
    first = {component.site: component for component in reversed(list(records))}
    return list(reversed(first.values()))


def trials_under(
    components: Iterable[SiteRecord],
    trial: Callable[..., T],
    places: Sequence[tuple[str | int, ...]],
    tell: Callable[[str], None],
    found: Callable[[Sequence[T]], str] = lambda _: "",
) -> list[T]:
    """Return `trial` of each component and each of `places`, which say what is drawn; none of what cannot stand.

    tell: takes a line after each component. found: what the line says of the trials so far.
    """
    trials: list[T] = []
    for component in components:
        for place in places:
            with suppress(RockingError):
                trials.append(trial(component, *place))
        tell(f"{component.identifier}: {len(trials)} trials{found(trials)}")
    return trials


def spread(catalogues: Sequence[Records], most: int) -> list[list[NamedRecord]]:
    """Return of each catalogue what counts of at most so many sites: the first of each earthquake, then the second.

    A share of the sites so has as many earthquakes as it can, which are the sample.
    """
    motions = [list(records) for records in catalogues]
    components = list(independent(chain.from_iterable(motions)))
    turns: dict[str, dict[str, int]] = {}
    for component in components:
        of_earthquake = turns.setdefault(component.earthquake, {})
        of_earthquake.setdefault(component.site, len(of_earthquake))
    places = [(turn, site) for sites in turns.values() for site, turn in sites.items()]
    chosen = {site for _, site in sorted(places, key=itemgetter(0))[:most]}
    kept = {id(component.accelerogram) for component in components if component.site in chosen}
    return [[(name, record) for name, record in records if id(record) in kept] for records in motions]


def lifting_factor(
    record: Accelerogram, multiplier: float, uplifts: tuple[float, float], draw: np.random.Generator
) -> float:
    """Draw what `record` is multiplied by, so that its peak is within `uplifts` times what lifts, log-uniform.

    multiplier: uplift acceleration over g.
    """
    return float(multiplier * GRAVITY * np.exp(draw.uniform(*np.log(uplifts))) / record.peak_acceleration)


def draw_of(name: str, *place: int) -> np.random.Generator:
    """Return the draws of a record, or of one of its trials, the same at every call."""
    return np.random.default_rng([zlib.crc32(name.encode()), *place])


def timed(run: Callable[[], T]) -> tuple[T, float]:
    """Return what `run` returns, and the processor time that it took, s."""
    started = process_time()
    return run(), process_time() - started


def site_of(record: Accelerogram) -> str:
    """Return the event and the station of a record, which name its site."""
    return f"{record.event}, {record.station}"
