"""Grouping: which files of a folder are the components of one station in one earthquake."""

import re
from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime
from itertools import combinations

import numpy as np

from rocking.catalogue.joining import SQUARE, why_apart
from rocking.catalogue.listing import ListedChannel, ListedFile
from rocking.records.claims import direction_in_name, without_ending
from rocking.records.direction import angle_between, directed, names_no_direction
from rocking.records.formats.text import day_of
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning

_RSN = re.compile(r"(RSN\d+)_")
"""Number of a record in the databases of PEER, with which the names of its files begin."""
_BAND = re.compile(r"([A-Z][HNGL])[A-Z\d]")


def rsn_of(name: str) -> str:
    """Return the RSN that the name of a file begins with, "" where it begins with none."""
    number = _RSN.match(name.rpartition("/")[2])
    return number[1] if number else ""


def stations(files: Sequence[ListedFile]) -> list[list[ListedFile]]:
    """Return the files that share a row, in the order of their first; those of a station that do not fit say why."""
    groups: dict[object, list[ListedFile]] = {}
    for file in files:
        groups.setdefault(_station_key(file) or file.file, []).append(file)
    found = []
    for group in (part for of_one in groups.values() for part in _simultaneous(of_one)):
        joined = list(filter(None, map(_together, _alike(group))))
        taken = {file.file for together in joined for file in together}
        found += joined
        for together in joined:
            for file in together:
                file.direction = _direction(file)
        for file in group:
            if file.file not in taken:
                file.separation = _why_apart(group)
                found.append([file])
    places = {file.file: place for place, file in enumerate(files)}
    return sorted(found, key=lambda group: places[group[0].file])


def _station_key(file: ListedFile) -> object:
    """Return what the files of one station and event have in common; None where neither header nor name says it."""
    first = file.channels[0]
    if len(file.channels) > 1 or first.borehole or file.is_repeat:
        return None
    folder, _, name = file.file.rpartition("/")
    header = [first.network, first.station, first.location, first.event]
    known = first.station and (first.event or first.start_time)
    base = "" if known else without_direction(file)
    if not (known or base):
        return None
    band = _BAND.fullmatch(first.component)
    return (
        folder,
        first.format,
        rsn_of(name),
        *("".join(filter(str.isalnum, text)).casefold() for text in header),
        day_of(first.event_time),
        base,
        band[1] if band else "",
        first.processed,  # raw and corrected motion are no pair, nor are two kinds of sensor
        file.blanks,
    )


def without_direction(file: ListedFile) -> str:
    """Return the file's name before the direction at its end, "" where there is none."""
    name = file.file.rpartition("/")[2]
    component = file.channels[0].component
    if names_no_direction(component):
        return direction_in_name(name)[0]
    stem = without_ending(name)
    ends_in_component = stem.lower().endswith(component.lower())
    return stem[: -len(component)].rstrip("-_. ") if ends_in_component else ""


def _direction(file: ListedFile) -> str:
    """Return the direction that only the file's name says, "" where its header does."""
    if names_no_direction(file.channels[0].component):
        return direction_in_name(file.file.rpartition("/")[2])[1]
    return ""


def _simultaneous(files: list[ListedFile]) -> list[list[ListedFile]]:
    """Return `files` of one station parted where one begins after the end of the first, as far as starts are known."""
    if not all(file.channels[0].start_time for file in files):
        return [files]
    starts = [datetime.fromisoformat(file.channels[0].start_time).timestamp() for file in files]
    parts: list[list[int]] = []
    end = 0.0
    for place in np.argsort(starts, kind="stable").tolist():
        if not parts or starts[place] >= end:
            parts.append([])
            first = files[place].channels[0]
            end = starts[place] + first.samples * first.time_step
        parts[-1].append(place)
    return [[files[place] for place in sorted(part)] for part in parts]


def _alike(group: Sequence[ListedFile]) -> list[list[ListedFile]]:
    """Return `group` parted by time step and by what is declared of it: one odd file parts no others."""
    parts: dict[object, list[ListedFile]] = {}
    for file in group:
        step = f"{file.channels[0].time_step:.6g}"
        parts.setdefault((step, *file.declarations.items()), []).append(file)
    return list(parts.values())


def named_channel(file: ListedFile) -> ListedChannel:
    """Return the one channel of a file, called as the file's name says where its header does not."""
    (channel,) = file.channels
    if direction := _direction(file):
        named = {"component": direction}
        is_open = channel.azimuth is None and not channel.vertical
        return replace(channel, **(directed(named) if is_open else named))
    return channel


def _together(group: list[ListedFile]) -> list[ListedFile]:
    """Return the files of a group that are one station's components: all, else a pair that no other rivals, else none.

    A vertical component that does not fit is left out, and so is a file that makes no pair. Where two pairs could be
    meant, none is taken.
    """
    if len(group) == 1:
        return []
    if not _why_apart(group):
        return group
    level = [file for file in group if named_channel(file).is_horizontal]
    pairs = [list(pair) for pair in combinations(level, 2) if not _why_apart(pair)]
    if len(pairs) > 1:
        angles = [angle_between(*map(named_channel, pair)) for pair in pairs]
        known = zip(pairs, angles, strict=True)
        pairs = [pair for pair, angle in known if angle is not None and abs(angle - 90) <= SQUARE]
    if len(pairs) != 1:
        return []
    (pair,) = pairs
    with_vertical = [[*pair, file] for file in group if file not in level and not _why_apart([*pair, file])]
    chosen = with_vertical[0] if len(with_vertical) == 1 else pair
    return [file for file in group if file in chosen]


def _why_apart(group: Sequence[ListedFile]) -> RockingWarning | None:
    """Return why the files of one station cannot share a row; None where they can."""
    if len(group) == 1:
        return None
    channels = [named_channel(file) for file in group]
    by_name = [file for file in group if names_no_direction(file.channels[0].component)]
    unnamed = [file for file in by_name if not _direction(file)]
    if unnamed or len(by_name) not in (0, len(group)):
        return RockingWarning(RecordKind.COMPONENT_NOT_NAMED, (unnamed or by_name)[0].file)
    if why := why_apart(channels):
        return why
    level = [channel for channel in channels if not channel.vertical]
    if len(level) > 2 or len(channels) - len(level) > 1:
        return RockingWarning.of(
            RecordKind.TOO_MANY_COMPONENTS, horizontal=len(level), vertical=len(channels) - len(level)
        )
    if any(file.declarations != group[0].declarations for file in group):
        return RockingWarning(RecordKind.DECLARED_BY_SOME)
    return _why_no_pair(group, level)


def _why_no_pair(group: Sequence[ListedFile], level: Sequence[ListedChannel]) -> RockingWarning | None:
    """Return why two horizontal components are no pair; None where they are, or are not two."""
    if len(level) != 2:
        return None
    first, second = (channel.component for channel in level)
    angle = angle_between(*level)
    if angle is not None and min(angle, 180 - angle) < SQUARE:
        return RockingWarning.of(RecordKind.POINT_THE_SAME_WAY, first=first, second=second)
    by_name = any(_direction(file) for file in group)
    if by_name and (angle is None or abs(angle - 90) > SQUARE):
        return RockingWarning.of(RecordKind.NOT_SQUARE_BY_NAME, first=first, second=second)
    return None
