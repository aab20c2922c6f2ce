"""Station: the components that one row of a catalogue names, from one file or several, on one span of time."""

import hashlib
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from rocking.errors import RecordError, about
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue import CatalogueRecord
from rocking.records.fetch import inventory_of, path_of
from rocking.records.formats import Options
from rocking.records.instrument import directed
from rocking.records.plausibility import scaled
from rocking.records.read import bytes_of, is_unnamed, read_raw

_SIDEWAYS = "Component {} is vertical, but the catalogue takes it as horizontal."
_OFF_GRID = 0.1  # share of a time step by which the samples of two files may lie between one another


@dataclass(frozen=True)
class Station:
    """What a station recorded of one earthquake: its horizontal components, and the vertical one, None if unknown."""

    horizontal: tuple[Accelerogram, ...]
    vertical: Accelerogram | None = None


def open_station(record: CatalogueRecord, mirror: str | Path | None = None) -> Station:
    """Return the components of `record`, each of its files read once, those of several on their common span.

    Horizontal are the components it names, else every one at the surface that is not vertical. scale_factor, station,
    event, high_pass, magnitude and distance of the row are applied. Raises RecordError naming record and file.
    """
    inventory = inventory_of(record, mirror)
    channels: list[Accelerogram] = []
    with about(record.id):
        for file in record.files:
            path = path_of(record, file, mirror)
            raw = bytes_of(path)
            if file.sha256 and (sha256 := hashlib.sha256(raw).hexdigest()) != file.sha256:
                hashes = f"file {path} has sha256 {sha256}, but the catalogue says {file.sha256}"
                raise RecordError(f"{hashes}; it is another version.")
            options = Options(record.unit or None, record.time_step, inventory, path.parent)
            for channel in read_raw(raw, path, options):
                channels.append(replace(channel, source=replace(channel.source, path=file.name)))
        return station_of(channels, record)


def open_record(record: CatalogueRecord, mirror: str | Path | None = None) -> list[Accelerogram]:
    """Return the horizontal components of `record`, as open_station does."""
    return list(open_station(record, mirror).horizontal)


def _named(channels: Sequence[Accelerogram], record: CatalogueRecord) -> list[Accelerogram]:
    """Return channels that their files leave unnamed, one in each, under the names that the row gives them."""
    one_each = len(record.files) == len(channels) == len(record.components)
    if not one_each or not all(is_unnamed(channel.component) for channel in channels):
        return list(channels)
    names = ({"component": name} for name in record.components)
    return [replace(channel, **directed(name)) for channel, name in zip(channels, names, strict=True)]


def why_apart(channels: Sequence[Accelerogram], samples: Collection[int]) -> str:
    """Return why channels of several files, of so many samples, cannot be one station's, or ""."""
    names = Counter(channel.component for channel in channels if not channel.borehole)
    if twice := next((name for name, n in names.items() if n > 1), ""):
        return f"component {twice} comes {names[twice]} times"
    steps = [channel.time_step for channel in channels]
    if max(steps) / min(steps) - 1 > 1e-6:
        return f"their time steps are {min(steps):g} and {max(steps):g} s"
    if min(samples) < max(samples) and not all(channel.start_time for channel in channels):
        return f"they hold {min(samples)} and {max(samples)} samples and do not all say when they begin"
    return ""


def joined(channels: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return the channels of several files on their common span. Raises RecordError when they do not fit together."""
    if why := why_apart(channels, [channel.acceleration.size for channel in channels]):
        raise RecordError(f"its files do not fit together: {why}; give each file a row of its own.")
    if not all(channel.start_time for channel in channels):
        return list(channels)
    starts = [datetime.fromisoformat(channel.start_time).timestamp() for channel in channels]
    step = channels[0].time_step
    late = (max(starts) - np.array(starts)) / step
    first = np.round(late).astype(int).tolist()
    off = np.abs(late - first).max()
    if off > _OFF_GRID:
        raise RecordError(f"resample the files: their samples lie {off:.2g} of a step between one another.")
    size = min(channel.acceleration.size - place for channel, place in zip(channels, first, strict=True))
    if size < 2:
        raise RecordError("the files have no span of time in common; give each file a row of its own.")
    begin = channels[int(np.argmax(starts))].start_time
    sentence = f"Cut to the span common to the station's files, {size * step:g} s from {begin} on."
    cut = []
    for channel, place in zip(channels, first, strict=True):
        samples = channel.acceleration[place : place + size]
        is_whole = samples.size == channel.acceleration.size
        cut.append(channel if is_whole else channel.processed_by(samples, sentence, start_time=begin))
    return cut


def station_of(channels: Sequence[Accelerogram], record: CatalogueRecord) -> Station:
    """Return the components that open_station returns, from all `channels` of the record's files."""
    with about(record.file):
        channels = _named(channels, record)
        channels = joined(channels) if len(record.files) > 1 else channels
        held = ", ".join(channel.component or "(unnamed)" for channel in channels)
        of = {channel.component: channel for channel in reversed(channels)}
        for name in filter(None, (*record.components, record.vertical_component)):
            if name not in of:
                raise RecordError(f"component is {name!r}, but the file holds {held}.")
        upwards = (channel for channel in channels if channel.vertical and not channel.borehole)
        vertical = of[record.vertical_component] if record.vertical_component else next(upwards, None)
        horizontal = [of[name] for name in record.components]
        if horizontal and len(record.files) == 1:  # a vertical one that is asked for will shake sideways
            horizontal = [c.warned(_SIDEWAYS.format(c.component)) if c.vertical else c for c in horizontal]
        else:
            sideways = horizontal or [channel for channel in channels if not channel.borehole]
            horizontal = [channel for channel in sideways if channel is not vertical and not channel.vertical]
        if not horizontal:
            raise RecordError(f"the file holds no horizontal component, only {held}; name one.")
        declared = tuple(_as_declared(channel, record) for channel in horizontal)
        return Station(declared, None if vertical is None else _as_declared(vertical, record))


def _as_declared(channel: Accelerogram, record: CatalogueRecord) -> Accelerogram:
    """Return a channel with what its row says of name, scale, station, event, corner, magnitude and distance."""
    facts: dict[str, Any] = {"station": record.station or channel.station}
    facts["event"] = record.event or channel.event
    facts["high_pass_frequency"] = record.high_pass or channel.high_pass_frequency
    if record.magnitude is not None:
        facts |= {"magnitude": record.magnitude, "magnitude_type": ""}
    if record.epicentral_distance is not None:
        facts["epicentral_distance"] = 1000 * record.epicentral_distance
    return replace(scaled(channel, record.scale_factor) if record.scale_factor != 1 else channel, **facts)
