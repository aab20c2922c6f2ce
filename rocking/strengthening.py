"""What holds it: the smallest tie, thickness or load that can be shown to hold under records, by dynamics.

The rule is fixed before anything is followed: the smallest of GRID values such that at it and at all larger ones the
upper bound of the share that overturns, by earthquakes, is at or below the target. The least value at which the records
at hand show a share below the target would only just hold on them, and fail on others.
"""

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property, partial
from time import process_time
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import betaincinv

from rocking.assessment.assessor import Assessor, Store
from rocking.assessment.cracks import cracks
from rocking.assessment.decide import Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import Component, HorizontalMotion, Motion
from rocking.assessment.scene import Scene
from rocking.assessment.settings import AssessmentSettings
from rocking.codes.check import CodeTerms
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.static_check import kinematic_check
from rocking.drawn import Drawn
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import ConfigurationError, DoesNotStandError, RockingError, StructureError
from rocking.hashes import sha256_of_content
from rocking.progress import bar
from rocking.quantities import GRAVITY, counted, finite, kind_of, percents, shown
from rocking.records import Accelerogram
from rocking.structures import Structure, structure_from_config
from rocking.structures.description import article, nearest
from rocking.structures.fields import Field

if TYPE_CHECKING:
    from pandas import DataFrame

GRID = 15
"""Values that are tried, in equal ratios from end to end of the range."""
CONFIDENCE = 0.9
"""Of the one-sided bounds of a share."""
LEAST_STATIONS = 6
"""Stations below which nothing is said."""
RISES = 0.99
"""Confidence at which a share is said to rise with the value: one-sided, by the differences of the stations."""
_MOST_NEEDED = 10_000
"""Stations up to which it is said how many are needed."""
_TIE = "tie_strength"


def stations_needed(*, share: float, target: float) -> float:
    """Return the number of stations, each of another earthquake, from which on the upper bound of this `share` is at
    or below the target.

    nan where more than 10 000 are needed, as where the share is not below the target.
    """
    numbers = np.arange(1, _MOST_NEEDED + 1)
    bounds = betaincinv(share * numbers + 1, (1 - share) * numbers, CONFIDENCE)
    too_few = np.flatnonzero(bounds > target)
    needed = int(too_few[-1]) + 2 if too_few.size else 1
    return float(needed) if needed <= _MOST_NEEDED and share < target else math.nan


@dataclass(frozen=True, eq=False)
class Tried:
    """One value that was tried.

    value: in SI; nan where the structure states none. shares: (n,) of each station, the mean over its components of the
    share of the decision, nan of a station under which it was not followed; what is undecided counts as 1. sample: of
    the n stations. governing: what overturns most often, or turns where nothing does; "" of a structure with one
    mechanism. undecided: components under which it cannot be decided. slid: (n,) the part of `shares` that is
    undecided because it slides before it lifts.
    """

    value: float
    shares: np.ndarray
    sample: ClusterSample
    governing: str = ""
    undecided: int = 0
    slid: np.ndarray | None = None

    @cached_property
    def followed(self) -> np.ndarray:
        """(n,): the stations under which it was followed."""
        followed: np.ndarray = ~np.isnan(self.shares)
        return followed

    @property
    def share(self) -> float:
        """The mean over these stations."""
        return float(self.shares[self.followed].mean())

    @property
    def overturns(self) -> np.ndarray:
        """(n,): the shares without what slides, nan of a station under which it was not followed."""
        return self.shares if self.slid is None else self.shares - self.slid

    @cached_property
    def interval(self) -> tuple[float, float]:
        """The one-sided 90 % bounds of the share, each by itself."""
        return _bounds(self.shares, self.sample)

    def fails_by_sliding(self, target: float) -> bool:
        """Whether the upper bound is above the target only by what slides."""
        return self.interval[1] > target >= _bounds(self.overturns, self.sample)[1]

    @property
    def in_words(self) -> str:
        """The share with its bounds, and the stations of one that was given up: "3 % (1–8 %)"."""
        share = f"{percents(self.share)} ({percents(*self.interval)})"
        return (
            share
            if self.followed.all()
            else f"{share} at the first {counted(int(self.followed.sum()), 'station')}"
        )


def _bounds(shares: np.ndarray, sample: ClusterSample) -> tuple[float, float]:
    """The one-sided 90 % bounds of shares (n,) over the stations of a sample, nan where one was not followed."""
    followed = np.flatnonzero(~np.isnan(shares))
    low, high = sample.part(followed).share_bounds(shares[followed], 1 - CONFIDENCE)
    return float(low), float(high)


@dataclass(frozen=True, eq=False, repr=False)
class Strengthening(Drawn):
    """The smallest value of one size of a structure that can be shown to hold, and what was tried.

    `plot` draws the share over the value with its bounds.

    Parameters
    ----------
    field : Field
        Size of the structure that varies.
    target : float
        Share that overturns at the most.
    sample : ClusterSample
        The n stations that count, and their earthquakes.
    tried : tuple of Tried
        The values, smallest first.
    given : Tried
        The structure as it was given.
    static_tie : float, default nan
        Least strength of a tie by the linear check of the code, N/m; nan of another size, and where none of
        the range is enough.
    still : int, default 0
        Stations at which nothing lifts it with any value, which say nothing of the share and do not count.

    Examples
    --------
    >>> step = 0.01 * np.arange(600)
    >>> pulses = [
    ...     rocking.Pulse(amplitude=3.0, circular_frequency=omega, start_time=0.5)
    ...     for omega in np.linspace(4.0, 8.0, 30)
    ... ]
    >>> records = [rocking.Accelerogram(pulse.acceleration(step), 0.01) for pulse in pulses]
    >>> parapet = rocking.Block.of_size(breadth=0.25, height=2.0)
    >>> names = [f"earthquake {place}" for place, _ in enumerate(records)]
    >>> held = rocking.strengthen(records, parapet, "breadth", between=(0.25, 1.5), events=names)
    >>> round(held.value, 2), round(held.share, 3), held.monotone
    (0.54, 0.015, True)
    """

    field: Field
    target: float
    sample: ClusterSample
    tried: tuple[Tried, ...]
    given: Tried
    static_tie: float = math.nan
    still: int = 0

    @property
    def stations(self) -> tuple[str, ...]:
        """(n,): the stations that count."""
        return self.sample.station_names

    @property
    def key(self) -> str:
        """The name of the size."""
        return self.field.name

    @cached_property
    def chosen(self) -> Tried | None:
        """What was tried with the value that can be shown to hold; None where none can."""
        place = self._place
        return None if place is None else self.tried[place]

    @cached_property
    def decided(self) -> tuple[Tried, ...]:
        """The values without those at the top that cannot be decided, because they slide before they lift."""
        number = len(self.tried)
        while number > 1 and self.tried[number - 1].fails_by_sliding(self.target):
            number -= 1
        return self.tried[:number]

    @cached_property
    def _place(self) -> int | None:
        place = len(self.decided)
        while place > 0 and self.tried[place - 1].interval[1] <= self.target:
            place -= 1
        return place if place < len(self.decided) else None

    @property
    def value(self) -> float:
        """The smallest that can be shown to hold, as all larger ones of `decided` can, in SI; nan where none can."""
        return self.chosen.value if self.chosen else math.nan

    def holds(self, tried: Tried) -> bool:
        """Whether one of `tried` and all larger ones of `decided` can be shown to hold."""
        return tried in self.decided and tried.value >= self.value

    def frame(self) -> "DataFrame":
        """Return a pandas frame with one row per value tried, in the unit of its key, with its share and bounds."""
        from pandas import DataFrame  # which takes half a second to import

        return DataFrame(
            {
                self.field.key: self.field.outward(tried.value),
                "share": tried.share,
                "share_low": tried.interval[0],
                "share_high": tried.interval[1],
                "stations": int(tried.followed.sum()),
                "holds": self.holds(tried),
            }
            for tried in self.tried
        )

    @property
    def share(self) -> float:
        """The share that overturns at this value; nan where none can be shown to hold."""
        return self.chosen.share if self.chosen else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """Its one-sided 90 % bounds, of which the upper one is at or below the target; nan where there is no value."""
        return self.chosen.interval if self.chosen else (math.nan, math.nan)

    @property
    def below(self) -> Tried | None:
        """What was tried one step below the value; None where there is no value, or no step below it."""
        return self.tried[self._place - 1] if self._place else None

    @property
    def needed_stations(self) -> float:
        """About how many stations of as many earthquakes show a share as at the value, or at the largest one where none
        can be shown.

        nan where the share there is not below the target, so that no number of stations shows it.
        """
        return stations_needed(share=(self.chosen or self.decided[-1]).share, target=self.target)

    @property
    def monotone(self) -> bool:
        """Whether no larger value overturns more than a smaller one, beyond what the stations leave to chance."""
        return math.isnan(self.harmful)

    @cached_property
    def harmful(self) -> float:
        """The value at which the share has risen most above that of a smaller one, in SI; nan where it does not rise.

        It rises where the mean of the differences of the stations is above 0 with a confidence of 99 %, by earthquakes.
        What slides overturns nothing.
        """
        worst = 0.0
        found = math.nan
        least = self.decided[0]
        for tried in self.decided[1:]:
            both = np.flatnonzero(tried.followed & least.followed)
            rises = (tried.overturns - least.overturns)[both]
            rise = float(rises.mean()) if both.size else 0.0
            if rise > worst and rise > self.sample.part(both).spread(rises).reach(1 - RISES):
                worst = rise
                found = tried.value
            if tried.share < least.share:
                least = tried
        return found

    def as_typed(self, value: float) -> str:
        """Return a value in the unit of a list of structures, with it: "12 kN/m"."""
        return f"{self.field.outward(value):.3g}{self.field.suffix}"

    @property
    def words(self) -> str:
        """What was found, in sentences."""
        stations = self.sample.words
        target = percents(self.target)
        first = self.decided[0]
        last = self.decided[-1]
        as_given = self.given.in_words
        if self.given.governing:
            as_given += f", mostly {self.given.governing}"
        if self.chosen is None:
            finding = (
                f"{self.key}: no value from {self.as_typed(first.value)} to {self.as_typed(last.value)} can be shown "
                f"to keep the share that overturns at or below {target}: at the largest one it is {last.in_words}, one "
                f"step below it, {self.as_typed(self.decided[-2].value)}, {self.decided[-2].in_words}; {stations}, "
            )
            needed = self.needed_stations
            finding += (
                "give larger values"
                if math.isnan(needed)
                else f"about {needed:.0f} of as many earthquakes are needed"
            )
        else:
            finding = (
                f"{self.key}: {self.as_typed(self.value)} can be shown to hold, as all larger values can: "
                f"{self.chosen.in_words} overturn by {stations}, against a target of {target}"
            )
            if self.chosen.governing:
                finding += f", what is left mostly {self.chosen.governing}"
            if self.below:
                finding += f"; one step below, {self.as_typed(self.below.value)}, {self.below.in_words}"
            else:
                finding += "; every value of the range holds, so that smaller ones may, too: give them"
        sentences = [finding, f"As given {as_given} overturn"]
        if self.still:
            sentences.append(
                f"Nothing lifts it with any value at {counted(self.still, 'further station')}, which show nothing and "
                "do not count"
            )
        if len(self.decided) < len(self.tried):
            least = self.tried[len(self.decided)]
            sentences.append(
                f"From {self.as_typed(least.value)} on it slides before it lifts, and nothing can be shown: these "
                "values are left out, and what holds is shown below them alone"
            )
        if not self.monotone:
            sentences.append(
                f"A larger value harms: more overturn at {self.as_typed(self.harmful)} than below it"
            )
        if undecided := (self.chosen or last).undecided:
            sentences.append(
                f"Under {counted(undecided, 'component')} it cannot be told, which counts as overturning"
            )
        if not math.isnan(self.static_tie):
            sentences.append(f"The linear check of the code asks for {self.as_typed(self.static_tie)}")
        warnings = "".join(f" {warning}" for warning in self.sample.warnings)
        return ". ".join(sentences) + f".{warnings}"

    def __repr__(self) -> str:
        return f"<{self.words}>"


def strengthen(
    records: Sequence[Accelerogram],
    structure: Structure,
    key: str,
    *,
    between: tuple[float, float],
    target: float = 0.10,
    stations: Sequence[str] | None = None,
    events: Sequence[str] | None = None,
    early: bool = True,
) -> Strengthening:
    """Return the smallest value of `key` that can be shown to hold `structure` under records as they are given.

    15 values between (low, high), in equal ratios, are tried. The one that is returned is the smallest such
    that at it and at all larger ones the upper one-sided 90 % bound (Jeffreys) of the share that overturns is
    at or below the target. Each station counts once, with the mean over its components of the share that
    overturns; one that cannot be decided counts as 1, as does a value with which the structure does not stand at
    rest.

    Of the strength of a tie it gives the static one, too: the least by the linear check (C8.7.1.2.1.7, q = 2, FC =
    1.35) at the mean peak acceleration of the records.

    Parameters
    ----------
    records : sequence of Accelerogram
        Horizontal components, each by itself.
    structure : Structure
        The structure as it is.
    key : str
        Size that varies: a length, an angle, a force or a stiffness, in SI, as the constructor has it, such
        as `tie_strength` [N/m], `thickness` or `top_load`.
    between : tuple of (float, float)
        Least and largest value that is tried, in SI.
    target : float, default 0.1
        Share that may overturn at the most.
    stations : sequence of str or None, optional
        (r,) stations; None: those that the records name.
    events : sequence of str or None, optional
        (r,) earthquakes; None: those that the records name. All that name no earthquake count as of one, from
        which nothing can be shown.
    early : bool, default True
        Whether a value is given up once its bound cannot be met any more, whatever the stations that are left
        say.

    Returns
    -------
    Strengthening
        The smallest value that can be shown to hold, its share and interval, and what was tried.

    Raises
    ------
    ConfigurationError
        For a key that the structure lacks, a range or a target that is none, fewer than 6 stations, and a
        value with which there is no such structure.

    Examples
    --------
    >>> times = 0.01 * np.arange(600)
    >>> pulses = [
    ...     rocking.Pulse(amplitude=3.0, circular_frequency=omega, start_time=0.5)
    ...     for omega in np.linspace(4.0, 8.0, 6)
    ... ]
    >>> records = [rocking.Accelerogram(pulse.acceleration(times), 0.01) for pulse in pulses]
    >>> names = [f"earthquake {place}" for place, _ in enumerate(records)]
    >>> few = rocking.strengthen(records, rocking.Block(2.0, 0.2), "breadth", between=(1.0, 3.0), events=names)
    >>> few.value, few.needed_stations
    (nan, 22.0)
    """
    if isinstance(records, Accelerogram | str | bytes) or not isinstance(records, Sequence):
        raise ConfigurationError(
            f"records is {kind_of(records)}, but must be a list of accelerograms.", records=records
        )
    if odd := [record for record in records if not isinstance(record, Accelerogram)]:
        raise ConfigurationError(
            f"records hold a {type(odd[0]).__name__}, but must hold accelerograms.", records=odd[0]
        )
    if not isinstance(structure, Structure):
        raise ConfigurationError(
            f"structure is {kind_of(structure)}, but must be a structure with sizes, as rocking.Block or "
            "rocking.Facade."
        )
    if getattr(structure, "opening", None) is not None:
        raise ConfigurationError(
            "structure is one of the mechanisms of a wall, but must be the wall itself, which may open elsewhere once "
            "its sizes change."
        )
    size = size_named(structure, key, {size.name: size for size in sizes(structure)})
    sample = ClusterSample.of(records, stations, events)
    return strengthen_scene(
        records, Scene("structure", structure), size, between, target, sample, early=early
    )


def size_named(structure: Structure, name: str, allowed: Mapping[str, Field]) -> Field:
    """Return the size of a structure of that name. Raises ConfigurationError with those that are `allowed`."""
    if name not in allowed:
        kind = article(structure.described.type_name)
        raise ConfigurationError(
            f"key is {shown(name)}, but {kind} has no such size{nearest(name, allowed)}; it has {', '.join(allowed)}."
        )
    return allowed[name]


def sizes(structure: Structure) -> list[Field]:
    """Return the fields of a structure that may be varied: those with a unit, and of lists those with one value."""
    described = structure.described
    lists = {
        given.field.name: given.value for given in described.values if isinstance(given.value, list | tuple)
    }
    return [
        size
        for size in described.form.fields
        if size.unit and (not size.is_list or len(lists.get(size.name, ())) == 1)
    ]


def strengthen_scene(
    records: Sequence[Accelerogram],
    scene: Scene,
    size: Field,
    between: tuple[float, float],
    target: float,
    sample: ClusterSample,
    settings: AssessmentSettings | None = None,
    spectrum: DesignSpectrum | None = None,
    terms: CodeTerms | None = None,
    *,
    early: bool = True,
    store: Store | None = None,
    show_line: Callable[[str], object] = lambda _line: None,
) -> Strengthening:
    """Return what `strengthen` does, for a scene: on a support its worst period counts.

    size: one of its `sizes`. between: in SI. sample: of the records. settings: of the ensemble and tolerance.
    spectrum, terms: at which a tie is sized by the code; without a spectrum, the mean peak of the records. store: keeps
    the outcome of each value under each record. show_line: takes what it will cost.
    """
    if not (isinstance(between, tuple | list) and len(between) == 2):
        raise ConfigurationError(f"between is {shown(between)}, but must be two values, the lower one first.")
    low, high = (finite(ConfigurationError, "between", bound) for bound in between)
    if not 0 < low < high:
        raise ConfigurationError(
            f"between is {low:g} to {high:g}, but must go from above 0 to a larger value."
        )
    if not 0 < finite(ConfigurationError, "target", target) < 1:
        raise ConfigurationError(
            f"target is {target:g}, but must be above 0 and below 1: no number of stations shows a share of 0, and "
            "every value keeps one of 1."
        )
    if sample.count < LEAST_STATIONS:
        raise ConfigurationError(
            f"the records come from {counted(sample.count, 'station')}, but at least {LEAST_STATIONS} are needed; add "
            "records."
        )
    settings = settings or AssessmentSettings()
    if settings.fidelity != "contact":
        settings = replace(settings, fidelity="quick")

    values = np.geomspace(low, high, GRID).tolist()
    changed = {f"{value!r}": with_value(scene.structure, size, value) for value in values}
    scenes = {
        name: replace(scene, name=name, structure=structure)
        for name, structure in changed.items()
        if structure
    }
    scenes[""] = replace(scene, name="")
    following = _Following(records, scenes, settings, sample, target, early, store, show_line)
    outcomes = following.outcomes()
    # A station at which no value lets it lift says nothing of what stronger shaking would do.
    moves = np.flatnonzero(sample.by_station(_lifting(records, scenes.values(), settings).astype(float)) > 0)
    counting = replace(sample.part(moves), warnings=sample.warnings)

    def tried(value: float, name: str) -> Tried:
        if name not in scenes:
            return Tried(value, np.ones(moves.size), counting, "what acts on it at rest")
        return _tried(value, [own.get(name) for own in outcomes], sample, moves, counting)

    given = {
        described_value.field.name: described_value for described_value in scene.structure.described.values
    }.get(size.name)
    own = math.nan
    if given is not None:
        own = float(np.ravel(np.asarray(size.inward(given.value)))[0])
    made = Strengthening(
        field=size,
        target=float(target),
        sample=counting,
        tried=tuple(tried(value, f"{value!r}") for value in values),
        given=tried(own, ""),
        still=sample.count - moves.size,
    )
    if size.name != _TIE:
        return made
    if spectrum is None:
        peak = float(np.mean([record.peak_acceleration for record in records]))
        spectrum = DesignSpectrum.ntc(ag=peak, f0=2.5, tc_star=0.5)
    return replace(made, static_tie=static_tie(scene.structure, size, (low, high), spectrum, terms))


def with_value(structure: Structure, size: Field, value: float) -> Structure | None:
    """Return the structure with another `value` [SI] of one size; None where what acts on it at rest turns it over.

    Raises ConfigurationError where there is no such structure.
    """
    outside = size.outward((value,) if size.is_list else value)
    try:
        return structure_from_config({**structure.described.entry, size.key: outside}).on_joints(
            structure.joints
        )
    except DoesNotStandError:
        return None
    except StructureError as error:
        raise ConfigurationError(
            f"with {size.key} = {size.outward(value):.4g} there is no such structure: {error}"
        ) from None


@dataclass(frozen=True)
class _Outcome:
    """The outcome of one component: the share that overturns, nan where it cannot be decided, and what governs.

    slides: whether it cannot be decided because it slides before it lifts.
    """

    share: float
    governing: str = ""
    slides: bool = False


_BATCH = 6
"""Stations that are followed before it is asked again which values can still be shown to hold."""


@dataclass(frozen=True, eq=False)
class _Following:
    """What follows every scene under the records, station after station, as far as it can still be shown to hold."""

    records: Sequence[Accelerogram]
    scenes: Mapping[str, Scene]
    settings: AssessmentSettings
    sample: ClusterSample
    target: float
    early: bool
    store: Store | None
    show_line: Callable[[str], object]

    def outcomes(self) -> list[dict[str, _Outcome]]:
        """Return the outcome of the scenes that were followed under each record, by name."""
        found: list[dict[str, _Outcome]] = [{} for _ in self.records]
        # One station of each earthquake after another, so that the first ones speak for all.
        turns = np.zeros(self.sample.count, dtype=int)
        seen: dict[int, int] = {}
        for place, event in enumerate(self.sample.of_station.tolist()):
            turns[place] = seen.setdefault(event, 0)
            seen[event] += 1
        order = np.argsort(turns, kind="stable")
        open_scenes = dict(self.scenes)
        cases = len(self.scenes) * len(self.records)
        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            for first in bar(range(0, order.size, _BATCH), "round"):
                started = process_time()
                batch = np.flatnonzero(np.isin(self.sample.of_record, order[first : first + _BATCH])).tolist()
                under = partial(self._under, scenes=open_scenes)
                for place, own in zip(batch, pool.map(under, [self.records[k] for k in batch]), strict=True):
                    found[place] = own
                if first == 0:
                    spent = (process_time() - started) * len(self.records) / len(batch)
                    self.show_line(
                        f"{counted(len(self.scenes), 'value')} under {counted(len(self.records), 'component')}: "
                        f"{cases} cases, at most about {spent:.0f} s of processor time."
                    )
                followed = order[: first + _BATCH]
                if self.early:
                    open_scenes = {
                        name: scene
                        for name, scene in open_scenes.items()
                        if self._can_hold(name, found, followed)
                    }
                if not open_scenes:
                    break
        return found

    def _can_hold(self, name: str, found: Sequence[Mapping[str, _Outcome]], followed: np.ndarray) -> bool:
        """Whether the bound can be met if nothing overturns at the stations that are left."""
        places = np.isin(self.sample.of_record, followed)
        shares = [
            own[name].share if is_followed and not math.isnan(own[name].share) else 0.0
            for is_followed, own in zip(places, found, strict=True)
        ]
        return _bounds(self.sample.by_station(np.array(shares)), self.sample)[1] <= self.target

    def _under(self, record: Accelerogram, scenes: Mapping[str, Scene]) -> dict[str, _Outcome]:
        """The outcome of scenes under one record, as far as the store has none."""
        kept: dict[str, _Outcome] = {}
        keys: dict[str, str] = {}
        for name, scene in scenes.items():
            if self.store is not None:
                motion = Motion((record,))
                keys[name] = sha256_of_content(
                    (motion.fingerprint, scene.place, scene.structure, self.settings)
                )
                if (own := self.store.find(_Outcome, keys[name])) is not None:
                    kept[name] = own
        wanted = {name: scene for name, scene in scenes.items() if name not in kept}
        if not wanted:
            return kept
        # No pulse is searched for: no closed form is asked for.
        component = Component(record, None, HorizontalMotion(), None, ())
        for name, of_scene in Assessor(self.settings).integrate("", (component,), wanted, {}).scenes.items():
            worst = of_scene.worst
            decision = worst.decision
            undecided = decision.verdict is Verdict.CANNOT_BE_TOLD
            kept[name] = _Outcome(
                share=decision.share,
                governing=worst.ensembles.governing.description if worst.ensembles else "",
                slides=undecided
                and any(warning.kind is AssessmentKind.FRICTION for warning in decision.would_settle),
            )
            if self.store is not None:
                self.store.keep(keys[name], kept[name], {})
        return kept


def _lifting(
    records: Sequence[Accelerogram], scenes: Iterable[Scene], settings: AssessmentSettings
) -> np.ndarray:
    """Whether each record, (r,), lifts some crack of some of the scenes; on a support all do, as it may ring."""
    least = math.inf
    for scene in scenes:
        if scene.place.supports:
            return np.ones(len(records), dtype=bool)
        counting = cracks(scene.structure).counting
        least = min(least, *(crack.mechanism.uplift_multiplier for crack in counting))
    strongest = (1 + settings.ensemble.amplitude_range) / GRAVITY
    return np.array([strongest * record.peak_acceleration > least for record in records])


def _tried(
    value: float,
    outcomes: Sequence[_Outcome | None],
    sample: ClusterSample,
    moves: np.ndarray,
    counting: ClusterSample,
) -> Tried:
    """The outcome at one value, by station; None of a record under which it was not followed.

    moves: the places of the stations that count, which are those of `counting`.
    """
    shares = [
        math.nan if outcome is None else 1.0 if math.isnan(outcome.share) else outcome.share
        for outcome in outcomes
    ]
    slid = [0.0 if outcome is None else float(outcome.slides) for outcome in outcomes]
    weights: dict[str, float] = {}
    for share, outcome in zip(shares, outcomes, strict=True):
        if outcome is not None:
            # Where nothing overturns, what governs most often.
            weights[outcome.governing] = weights.get(outcome.governing, 0.0) + share + 1e-6
    return Tried(
        value=value,
        shares=sample.by_station(np.array(shares))[moves],
        sample=counting,
        governing=max(weights, key=weights.__getitem__, default=""),
        undecided=sum(outcome is not None and math.isnan(outcome.share) for outcome in outcomes),
        slid=sample.by_station(np.array(slid))[moves],
    )


def static_tie(
    structure: Structure,
    size: Field,
    between: tuple[float, float],
    spectrum: DesignSpectrum,
    terms: CodeTerms | None = None,
) -> float:
    """Return the least strength of a tie by the linear check of the code on the ground, to 1 %; nan where none does.

    Every mechanism that the tie holds, so that the work L_i of the tie raises its α_0 (C8.7.1.1), has
    α_0 g/(e* FC) ≥ a_g S/q (C8.7.1.2.1.7). What no tie holds, such as a fall inwards, is left out. Sought within
    `between`, of which it is the lower end where every value does.
    """
    terms = replace(terms or CodeTerms(), limit_state="SLV", support=None)  # the linear check is of SLV alone
    asked = float(spectrum.acceleration(0.0)) / terms.behaviour_factor

    def onsets(value: float) -> dict[str, float]:
        changed = with_value(structure, size, value)
        if changed is None:
            return {}
        mechanisms = kinematic_check(changed, spectrum, terms).mechanisms
        return {mechanism.description: mechanism.onset_acceleration for mechanism in mechanisms}

    low, high = between
    try:
        weak = onsets(low)
        strong = onsets(high)
        held = [name for name, onset in strong.items() if onset > weak.get(name, 0.0) * (1 + 1e-9)]
        if not held or min(strong[name] for name in held) < asked:
            return math.nan
        if all(weak.get(name, 0.0) >= asked for name in held):
            return low
        while high / low > 1.01:
            middle = math.sqrt(low * high)
            at_middle = onsets(middle)
            meets = all(at_middle.get(name, 0.0) >= asked for name in held)
            low, high = (low, middle) if meets else (middle, high)
    except RockingError:  # what the code cannot check it does not size
        return math.nan
    return high
