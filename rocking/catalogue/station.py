"""Station: what the files of one row of a catalogue hold, wherever they lie, on one span of time."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import date, timedelta
from pathlib import Path, PurePosixPath
from typing import Any

from rocking.catalogue.catalogue import CatalogueRecord, RecordFile
from rocking.catalogue.files import in_catalogue_folder, path_of
from rocking.catalogue.joining import joined
from rocking.catalogue.place import Coordinates, place_of
from rocking.earthquakes.sample import MADE
from rocking.errors import RecordError, about
from rocking.hashes import sha256_of_bytes
from rocking.records.direction import (
    directed,
    names_no_direction,
    pair_warning,
    vertical_warning,
    warnings_of_channel,
)
from rocking.records.doors import through
from rocking.records.formats import Options
from rocking.records.formats.layouts import Layouts
from rocking.records.formats.text import day_of, iso_date
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import same_motion
from rocking.records.read import bytes_of, read_raw
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.scaling import ScalingTarget, scaled, scaled_to
from rocking.warnings import RockingWarning


@dataclass(frozen=True)
class Station:
    """The record of one earthquake at one station: its horizontal components, and the vertical one, None if unknown."""

    horizontal: tuple[Accelerogram, ...]
    vertical: Accelerogram | None = None


def open_station(record: CatalogueRecord, mirror: str | Path | None = None) -> Station:
    """Return the components of `record`, each of its files read once, those of several on their common span.

    Horizontal are the components it names, else every one at the surface that is not vertical. scale_factor or
    scale_to, station, event, high_pass, magnitude and distance of the row are applied. Raises RecordError naming record
    and file.
    """
    with about(record.id):
        inventory = in_catalogue_folder(record, record.inventory, mirror) if record.inventory else None
        if record.inventory and inventory is None:
            raise RecordError(
                f"inventory {record.inventory!r} is missing; correct the row or add the file.",
                inventory=record.inventory,
            )
        channels: list[Accelerogram] = []
        for file in record.files:
            channels += _channels_of(record, file, inventory, mirror)
        return station_of(channels, record)


def _channels_of(
    record: CatalogueRecord, file: RecordFile, inventory: Path | None, mirror: str | Path | None
) -> list[Accelerogram]:
    """Return every channel of one file of the row, once its content is what the catalogue says."""
    path = path_of(record, file, mirror)
    raw = bytes_of(path)
    sha256 = sha256_of_bytes(raw)
    if file.sha256 and sha256 != file.sha256:
        hashes = f"file {path} has sha256 {sha256}, but the catalogue says {file.sha256}"
        raise RecordError(f"{hashes}; it is another version.", sha256=sha256)
    layouts = Layouts(record.folder, PurePosixPath(file.name).parent.as_posix())
    options = Options(
        record.unit or None,
        record.time_step,
        inventory,
        path.parent,
        layouts=layouts,
        scale_factor=record.scale_factor,
    )
    with through("catalogue"):
        channels = read_raw(raw, path, options)
    return [replace(channel, source=replace(channel.source, path=file.name)) for channel in channels]


def station_of(channels: Sequence[Accelerogram], record: CatalogueRecord) -> Station:
    """Return the components that open_station returns, from all `channels` of the record's files."""
    with about(record.file):
        channels = _named_by_row(channels, record)
        if len(record.files) > 1:
            channels = joined(channels)
        upwards = (channel for channel in channels if channel.vertical and not channel.borehole)
        named = record.vertical_component
        vertical = _called(named, channels) if named else next(upwards, None)
        horizontal = _horizontal(channels, record, vertical)
        horizontal, vertical = _counted_once(horizontal, vertical)
        if record.components:
            horizontal = [
                replace(channel, warnings=tuple(w for w in channel.warnings if w.kind not in _ANSWERED))
                for channel in horizontal
            ]
        elif warning := vertical_warning([*horizontal, *filter(None, [vertical])]):
            raise RecordError(str(warning))
        if warning := pair_warning(horizontal):
            horizontal = [channel.warned(warning) for channel in horizontal]
        declared = [_as_declared(channel, record) for channel in horizontal]
        upright = None if vertical is None else _as_declared(vertical, record)
        if record.scale_to:
            declared, upright = scaled_to(ScalingTarget.parse(record.scale_to), declared, upright)
        return Station(tuple(declared), upright)


def _named_by_row(channels: Sequence[Accelerogram], record: CatalogueRecord) -> Sequence[Accelerogram]:
    """Return the channels with the names that the row gives, file by file, where the files give none of their own."""
    is_one_each = len(record.files) == len(channels) == len(record.components)
    if not is_one_each or not all(names_no_direction(channel.component) for channel in channels):
        return channels
    return [_called_now(channel, name) for channel, name in zip(channels, record.components, strict=True)]


def _called_now(channel: Accelerogram, name: str) -> Accelerogram:
    """Return a channel with another name, and with what is in doubt of the direction that this one says."""
    others = tuple(
        warning for warning in channel.warnings if warning.kind is not RecordKind.DIRECTION_UNKNOWN
    )
    named = replace(channel, **directed({"component": name}), warnings=others)
    return named.warned(*warnings_of_channel(named))


_ANSWERED = (RecordKind.SOME_MAY_BE_VERTICAL, RecordKind.LONE_MAY_BE_VERTICAL)
"""What is no longer in doubt once a row names the horizontal components."""


def _horizontal(
    channels: Sequence[Accelerogram], record: CatalogueRecord, vertical: Accelerogram | None
) -> list[Accelerogram]:
    """Return the components that the row names, else every horizontal one at the surface.

    A vertical one that the row of a single file names will shake sideways, with a warning. Raises RecordError where
    there is none.
    """
    named = [_called(name, channels) for name in record.components]
    if named and len(record.files) == 1:
        return [
            channel.warned(RockingWarning(RecordKind.VERTICAL_AS_HORIZONTAL, channel.component))
            if channel.vertical
            else channel
            for channel in named
        ]
    surface = named or [channel for channel in channels if not channel.borehole]
    horizontal = [channel for channel in surface if channel is not vertical and not channel.vertical]
    if not horizontal:
        names = _listed(channels)
        raise RecordError(f"the file holds no horizontal component, only {names}; name one.", component=names)
    return horizontal


def _counted_once(
    horizontal: Sequence[Accelerogram], vertical: Accelerogram | None
) -> tuple[list[Accelerogram], Accelerogram | None]:
    """Return the components without those that are copies of an earlier one, which says so.

    The vertical one may be among the horizontal ones, where the row names it as such: that is no copy.
    """
    distinct: list[Accelerogram] = []
    is_among = vertical is None or vertical.component in {channel.component for channel in horizontal}
    for channel in filter(None, (*horizontal, None if is_among else vertical)):
        place = next((at for at, other in enumerate(distinct) if same_motion(channel, other)), None)
        if place is None:
            distinct.append(channel)
        else:
            first = distinct[place]
            distinct[place] = first.warned(
                RockingWarning.of(RecordKind.SAME_MOTION, channel.component, other=first.component)
            )
    if not is_among and distinct[-1] is vertical:
        return distinct[:-1], vertical
    return distinct, vertical if is_among else None


def _called(name: str, channels: Sequence[Accelerogram]) -> Accelerogram:
    """Return the first channel of that name. Raises RecordError where no file holds it."""
    named = next((channel for channel in channels if channel.component == name), None)
    if named is None:
        raise RecordError(f"component is {name!r}, but the file holds {_listed(channels)}.", component=name)
    return named


def _listed(channels: Sequence[Accelerogram]) -> str:
    return ", ".join(channel.component or "(unnamed)" for channel in channels)


def _as_declared(channel: Accelerogram, record: CatalogueRecord) -> Accelerogram:
    """Return a channel with what its row says of name, scale, station, event, corner, magnitude and distance.

    Raises RecordError where the row names an earthquake of a motion that was made by what its file says.
    """
    if channel.event == MADE and record.event not in ("", MADE):
        raise RecordError(
            f"event is {record.event!r}, but the header of {channel.source.path} says that the motion was made; write "
            f"{MADE!r} in the column event, or correct the file.",
            event=record.event,
        )
    facts: dict[str, Any] = {
        "station": record.station or channel.station,
        "event": record.event or channel.event,
        "event_time": _event_time(channel, record),
        "high_pass_frequency": record.high_pass or channel.high_pass_frequency,
    }
    if record.magnitude is not None:
        facts |= {"magnitude": record.magnitude, "magnitude_type": ""}
    if record.epicentral_distance is not None:
        facts["epicentral_distance"] = 1000 * record.epicentral_distance
    place, warnings = _place(channel, record)
    if place is not None:
        facts |= {"latitude": place.latitude, "longitude": place.longitude}
    enlarged = channel if record.scale_factor == 1 else scaled(channel, record.scale_factor)
    return replace(enlarged, **facts).warned(*warnings)


_DAY = re.compile(r"\b(?:\d{4}-\d\d-\d\d|\d{1,2}/\d{1,2}/(?:\d{4}|\d\d))\b")


def _event_time(channel: Accelerogram, record: CatalogueRecord) -> str:
    """The time of the earthquake by the file, or its day by the row where that is another; zones differ by one day."""
    stated = _DAY.search(record.event)
    if stated is None:
        return channel.event_time
    day = iso_date(stated[0])
    try:
        apart = date.fromisoformat(day) - date.fromisoformat(day_of(channel.event_time))
    except ValueError:  # one of both is no day
        return channel.event_time
    return channel.event_time if abs(apart) <= timedelta(days=1) else day


_NEAR = 1.0
"""Distance of two places, km, up to which they are one: coordinates are often given to a hundredth of a degree."""


def _place(channel: Accelerogram, record: CatalogueRecord) -> tuple[Coordinates | None, list[RockingWarning]]:
    """The place of the station by its row, where it gives one that can be; what is wrong with it and the epicentre."""
    given = record.station_place
    warnings = [warning for warning in (given, record.epicentre) if isinstance(warning, RockingWarning)]
    if not isinstance(given, Coordinates):
        return None, warnings
    stated = place_of(latitude=channel.latitude, longitude=channel.longitude)
    if isinstance(stated, Coordinates) and (distance := stated.distance_to(given)) > _NEAR:
        warnings.append(
            RockingWarning.of(
                RecordKind.PLACE_UNLIKE_FILE, catalogue=str(given), file=str(stated), distance_km=distance
            )
        )
    return given, warnings
