"""Motions: what a structure meets under one record, one component with its pulses, or a pair in all its directions.

A motion stands for several: its directions, its processings, with the vertical motion, on the ground or on a support.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from functools import cached_property, lru_cache
from types import MappingProxyType
from typing import Protocol

import numpy as np

from rocking.assessment.settings import PredictingPulse
from rocking.errors import PulseError, RecordError
from rocking.hashes import sha256_of
from rocking.motion.table import forcing_of
from rocking.pulses import (
    PULSE_METHODS,
    PulseAnalysis,
    PulseEvidence,
    VelocityPulse,
    extract_pulses,
    velocity_pulse,
)
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.signal import RotD, rotd
from rocking.signal.processing import process, variants
from rocking.signal.rotation import aligned, azimuth_of_axis, rotate
from rocking.warnings import RockingWarning

AS_IT_IS = "unchanged"
"""Name of the processing that leaves a record as it is."""
DIRECTIONS = 8
"""Directions of the motion of two components, spread evenly over half a turn; the other half is that of the sign. The
target `calibrate_ensemble` holds their verdicts against draws over three times as many directions."""


@lru_cache(maxsize=2)  # the two components of a record
def processed(accelerogram: Accelerogram) -> Mapping[str, Accelerogram]:
    """Return the record after each variant of the processing, by name, but for those that do not fit the record.

    The one AS_IT_IS is the same object. The variants are computed once.
    """
    records = {}
    for name, processing in variants().items():
        with suppress(RecordError):
            records[name] = process(accelerogram, processing)
    return MappingProxyType(records)


Sampling = tuple[int, int]
"""Samples of a motion on a support: their number to each of the record, and those of still ground after it."""


class MovingSupport(Protocol):
    """What carries a structure above the ground, as far as a case needs it: equal ones make equal motions."""

    @property
    def first_period(self) -> float:
        """Its period, s, which is the place on the axis of a result."""

    def sampling(self, records: Sequence[Accelerogram]) -> Sampling:
        """Return the samples that its motions under the components of one record have in common."""

    def motion(self, record: Accelerogram, sampling: Sampling | None = None) -> Accelerogram:
        """Return the motion that it makes of one component of the ground, on these samples."""


FLOOR_BYTES = 40_000_000
"""Bytes of the samples of motions on a support that are kept. A raw pair of 150 s at 100 Hz stands for 48 motions of up
to 2.2 MB; to make one again takes less than to follow a structure through it."""


class _FloorMotions:
    """The motions on one support after the other, of which the first ones are kept as long as there is room.

    Who goes through all of them again and again, as the stages of an ensemble do, so meets some that are kept, where
    the last ones would have been given up each time before they are met.
    """

    def __init__(self) -> None:
        self._kept: dict[tuple[MovingSupport, Accelerogram, Sampling], Accelerogram] = {}

    def motion(self, support: MovingSupport, ground: Accelerogram, sampling: Sampling) -> Accelerogram:
        """Return the motion that the support makes of one component of the ground."""
        key = support, ground, sampling
        found = self._kept.get(key)
        if found is None:
            if any(other != support for other, _, _ in self._kept):
                self._kept.clear()
            found = support.motion(ground, sampling)
            kept = sum(motion.acceleration.nbytes for motion in self._kept.values())
            if kept + found.acceleration.nbytes <= FLOOR_BYTES:
                self._kept[key] = found
        return found


_FLOOR_MOTIONS = _FloorMotions()


@dataclass(frozen=True, eq=False)
class _Made(Mapping[tuple[str, str], Accelerogram]):
    """What is made of horizontal motions, each when it is asked for."""

    motions: Mapping[tuple[str, str], Accelerogram]
    make: Callable[[Accelerogram], Accelerogram]

    def __getitem__(self, of: tuple[str, str]) -> Accelerogram:
        return self.make(self.motions[of])

    def __iter__(self) -> Iterator[tuple[str, str]]:
        return iter(self.motions)

    def __len__(self) -> int:
        return len(self.motions)


@dataclass(frozen=True, eq=False)
class GroundMotions:
    """The possible motions of the ground: at least one horizontal by direction and processing, and the vertical one.

    All have the same samples.
    """

    horizontal: Mapping[tuple[str, str], Accelerogram]
    vertical: Accelerogram | None = None

    @classmethod
    def of(
        cls, *components: Accelerogram, vertical: Accelerogram | None = None, processing: bool = False
    ) -> "GroundMotions":
        """Return the motions of one component, or of two and the directions between them, DIRECTIONS in all.

        vertical: with one component it must have the same samples. processing: whether raw components enter after each
        variant of their processing. Raises RecordError for components that do not belong together.
        """
        raw = all(component.source.path and component.processed is False for component in components)
        variants_of = [
            processed(component) if processing and raw else {"": component} for component in components
        ]
        names = [name for name in variants_of[0] if all(name in variants for variants in variants_of)]
        ends = {0: components[0].component or "first", DIRECTIONS // 2: components[-1].component or "second"}
        horizontal = {}
        for name in names:
            first, *others = (variants[name] for variants in variants_of)
            if not others:
                horizontal[first.component, name] = first
            for second in others:
                for place in range(DIRECTIONS):
                    motion = rotate(first, second, angle=np.pi * place / DIRECTIONS)
                    horizontal[ends.get(place, motion.component), name] = motion
        if vertical is not None and len(components) > 1:
            vertical = aligned(vertical, next(iter(horizontal.values())))
        return cls(horizontal, vertical)

    @cached_property
    def excitation(self) -> float:
        """The largest acceleration in all of them, over gravity with the vertical motion; inf where nothing presses."""
        return max(forcing_of(motion, self.vertical).excitation for motion in self.horizontal.values())

    def lift_at(self, multiplier: float) -> float:
        """Return the factor on all of them, the vertical one as well, at which what a multiplier λ lifts may lift.

        f |ü_g| = λ (g + f ü_v) with the largest |ü_g| and the least ü_v, whatever their phase; inf where ü_g is zero.
        """
        forcings = [forcing_of(motion, self.vertical).ground for motion in self.horizontal.values()]
        strongest = max(float(ground.strongest[0]) for ground in forcings)
        unloading = max(-float(ground.lightest[0]) for ground in forcings)
        if not strongest > 0 or math.isinf(multiplier):
            return math.inf
        return multiplier / (strongest / GRAVITY + multiplier * max(unloading, 0.0) / GRAVITY)

    @property
    def directions(self) -> tuple[str, ...]:
        """The directions of the horizontal motion, by name."""
        return tuple(dict.fromkeys(direction for direction, _ in self.horizontal))

    @property
    def processings(self) -> tuple[str, ...]:
        """The processings of the horizontal motion, by name; "" for the one that the record has."""
        return tuple(dict.fromkeys(processing for _, processing in self.horizontal))

    def on(self, support: MovingSupport | None) -> "GroundMotions":
        """Return the motions as they arrive on a support; None: on the ground, as they are."""
        if support is None:
            return self
        vertical = None if self.vertical is None else replace(self.vertical, vertical=True)
        acting = [*self.horizontal.values(), *([] if vertical is None else [vertical])]
        sampling = support.sampling(acting)
        if vertical is not None:
            vertical = support.motion(vertical, sampling)
        return GroundMotions(
            _Made(self.horizontal, lambda ground: _FLOOR_MOTIONS.motion(support, ground, sampling)), vertical
        )

    def scaled(self, factor: float) -> "GroundMotions":
        """Return the motions times a factor, the vertical one with the horizontal ones."""
        vertical = None if self.vertical is None else self.vertical.scaled(factor)
        return GroundMotions(_Made(self.horizontal, lambda motion: motion.scaled(factor)), vertical)


@dataclass(frozen=True)
class Motion:
    """The motion that a structure meets: one horizontal component of the ground or a pair, the vertical one, a support.

    Motions of the same accelerograms on equal supports are equal, so that what they stand for is made once.

    components: one or two, with the same samples where they are two. vertical: sample by sample as the components; None
    where none acts. support: takes them to where the structure stands; None on the ground.
    """

    components: tuple[Accelerogram, ...]
    vertical: Accelerogram | None = None
    support: MovingSupport | None = None

    @cached_property
    def fingerprint(self) -> str:
        """Hash of the samples and of all that is known of them; where the file lies is left out."""
        names = sorted({attribute.name for attribute in fields(Accelerogram)} - {"acceleration", "source"})

        def content(motion: Accelerogram) -> tuple[object, ...]:
            """The samples by their hash; whether it came from a file, not from which."""
            return motion.sha256, bool(motion.source.path), {name: getattr(motion, name) for name in names}

        contents = [motion and content(motion) for motion in (*self.components, self.vertical)]
        return sha256_of(*contents, self.support)


@lru_cache(maxsize=4)  # of two components, each as recorded and after every processing
def ground_motions(motion: Motion, processing: bool) -> GroundMotions:
    """Return the motions that one motion stands for, for all structures and for their reserves.

    Those of the ground are made once. Those of a support, of twenty times as many samples, are made when they are asked
    for, one support after the other; see FLOOR_BYTES. Raises RecordError for components that are no pair.
    """
    return _of_ground(replace(motion, support=None), processing).on(motion.support)


@lru_cache(maxsize=4)
def _of_ground(motion: Motion, processing: bool) -> GroundMotions:
    return GroundMotions.of(*motion.components, vertical=motion.vertical, processing=processing)


def arrived(motion: Motion) -> GroundMotions:
    """Return the motion of one component as recorded, where it arrives: on its support, or on the ground as it is."""
    return ground_motions(motion, processing=False)


@dataclass(frozen=True)
class HorizontalMotion:
    """The motion of a pair of horizontal components, or of one that stands alone.

    velocity_pulse: None where the motion is still or too short for one. velocity_pulse_azimuth: of its axis, degrees
    clockwise from north in [0, 180); None where a component does not state its own. rotd: None of one component alone.
    """

    velocity_pulse: VelocityPulse | None = None
    velocity_pulse_azimuth: float | None = None
    rotd: RotD | None = None


@dataclass(frozen=True, eq=False)
class Component:
    """One horizontal component of a record as it acts.

    vertical: the component that acts with it, with the same samples; None where none does. motion: of the pair that it
    belongs to, or of itself alone. analysis: None where the search for pulses failed. candidates: the pulses that the
    chosen method offers for prediction, none where it fails. failure: why, in a sentence; "" where nothing failed.
    support: on which this is the motion. ground: the same component of the ground. Both None on the ground itself.
    """

    accelerogram: Accelerogram
    vertical: Accelerogram | None
    motion: HorizontalMotion
    analysis: PulseAnalysis | None
    candidates: tuple[PulseEvidence, ...]
    failure: str = ""
    support: MovingSupport | None = None
    ground: "Component | None" = None

    @property
    def of_ground(self) -> Motion:
        """Its motion as the ground had it, and what takes that to where it acts."""
        ground = self.ground or self
        return Motion((ground.accelerogram,), ground.vertical, self.support)


@dataclass(frozen=True, eq=False)
class ComponentPulses:
    """The pulses of one component without its samples, as a store keeps them; no pulse without `ranked`."""

    motion: HorizontalMotion
    ranked: tuple[PulseEvidence, ...]
    sequence: tuple[PulseEvidence, ...]
    flags: tuple[RockingWarning, ...]
    band: tuple[float, float]
    candidates: tuple[PulseEvidence, ...]
    failure: str

    def component_of(self, accelerogram: Accelerogram, vertical: Accelerogram | None) -> Component:
        """Return the component again."""
        analysis = None
        if self.ranked:
            analysis = PulseAnalysis(accelerogram, self.ranked, self.sequence, self.flags, self.band)
        return Component(accelerogram, vertical, self.motion, analysis, self.candidates, self.failure)

    def on(self, support: MovingSupport, ground: Component) -> Component:
        """Return the component `ground` as it arrives on a support, where these are its pulses."""
        arriving = arrived(Motion((ground.accelerogram,), ground.vertical, support))
        (accelerogram,) = arriving.horizontal.values()
        there = self.component_of(accelerogram, arriving.vertical)
        return replace(there, support=support, ground=ground)


def on_support(
    support: MovingSupport, grounds: Sequence[Component], pulses: Sequence[ComponentPulses]
) -> tuple[Component, ...]:
    """Return the components of the ground as they arrive on a support, where these are the pulses of each."""
    return tuple(found.on(support, ground) for found, ground in zip(pulses, grounds, strict=True))


def by_name(components: Sequence[Component]) -> dict[str, Component]:
    """Return the components by their names, or by numbers where two have the same name or one of two has none."""
    names = [component.accelerogram.component for component in components]
    if len(names) > 1 and (len(set(names)) < len(names) or not all(names)):
        names = [f"component {place}" for place, _ in enumerate(names, start=1)]
    return dict(zip(names, components, strict=True))


def pulses_of(
    accelerogram: Accelerogram, settings: PredictingPulse, motion: HorizontalMotion
) -> ComponentPulses:
    """Return the pulses of a component. motion: of the pair that it belongs to, where it is needed."""
    analysis = None
    candidates: tuple[PulseEvidence, ...] = ()
    failure = ""
    try:
        analysis = extract_pulses(accelerogram, settings=settings)
        candidates = PULSE_METHODS[settings.choice].candidates(analysis)
    except PulseError as error:
        failure = str(error)
    return ComponentPulses(
        motion=motion,
        ranked=analysis.ranked if analysis else (),
        sequence=analysis.sequence if analysis else (),
        flags=analysis.flags if analysis else (),
        band=analysis.band if analysis else (0.0, 0.0),
        candidates=candidates,
        failure=failure,
    )


def horizontal_motions(accelerograms: Sequence[Accelerogram]) -> list[HorizontalMotion]:
    """Return the motion that each of the horizontal components of a record belongs to.

    Two components that share time step and start are a pair; fewer, more or others stand each alone.
    """
    groups: list[Sequence[Accelerogram]] = [[accelerogram] for accelerogram in accelerograms]
    peaks = None
    if len(accelerograms) == 2:
        with suppress(RecordError):  # two that do not belong together stand alone
            first, second = accelerograms
            peaks = rotd(first, second)
            groups = [accelerograms]
    motions = []
    for first, *others in groups:
        motion = HorizontalMotion(rotd=peaks)
        with suppress(PulseError):  # the motion holds none, which is no failure of the record
            pulse = velocity_pulse(first, *others)
            azimuth = first.azimuth
            for second in others:
                azimuth = azimuth_of_axis(first=first.azimuth, second=second.azimuth, angle=pulse.orientation)
            motion = HorizontalMotion(pulse, None if azimuth is None else azimuth % 180, peaks)
        motions += [motion] * (1 + len(others))
    return motions
