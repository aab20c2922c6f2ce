"""Catalogue: the list of records a run uses, checked as a whole before the first file is opened."""

import csv
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from rocking.errors import CatalogueError, RecordError, RockingError, about
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue_record import COLUMNS, CatalogueRecord
from rocking.records.fetch import fetch, inventory_of
from rocking.records.formats.text import is_number
from rocking.records.instrument import azimuth, is_vertical
from rocking.records.plausibility import scaled
from rocking.records.read import is_unnamed, plain, read

_REQUIRED = ("id", "file")
_PROSE = ("event", "station", "licence", "note")
_NUMBERS = {
    "time_step_s": "time_step",
    "scale_factor": "scale_factor",
    "high_pass_hz": "high_pass_frequency",
    "magnitude": "magnitude",
    "epicentral_distance_km": "epicentral_distance",
}
"""Columns of numbers, which may be blank, and the fields that hold them."""
_LARGEST = 16 * 2**20
"""Bytes of a catalogue: a hundred thousand rows."""


def load_catalogue(path: str | Path, mirror: str | Path | None = None) -> tuple[CatalogueRecord, ...]:
    """Return the rows of the CSV file at `path`.

    mirror: a folder; if given, a file that is neither bundled, nor there, nor fetchable is a defect.
    Raises CatalogueError with every defect of the file in one message.
    """
    path = Path(path)
    rows = _rows(path)
    records, defects = [], []
    for line, row in rows:
        try:
            records.append(_record(row, path.parent))
        except RockingError as error:
            defects.append(f"line {line} ({row.get('id') or 'no id'}): {error}")
    defects += _duplicates(row.get("id", "") for _, row in rows)
    if mirror is not None:
        defects += [d for record in records for d in _absent(record, Path(mirror))]
    if defects:
        raise CatalogueError(f"{path.name} has {len(defects)} defects: " + " | ".join(defects))
    return tuple(records)


def open_record(
    record: CatalogueRecord, mirror: str | Path | None = None, cache: str | Path | None = None
) -> list[Accelerogram]:
    """Return the accelerograms of `record`: the components it names, else every horizontal one at the surface.

    scale_factor, station, event and high_pass_frequency of the row are applied.
    Raises RecordError naming record and file.
    """
    return horizontal_of(channels_of(record, mirror, cache), record)


def open_records(
    records: Collection[CatalogueRecord], mirror: str | Path | None, tell: Callable[[str], object]
) -> Iterator[tuple[str, Accelerogram]]:
    """Yield identifier and accelerogram of every component of `records`. tell: takes a line for each record."""
    for count, record in enumerate(records, start=1):
        tell(f"{count} of {len(records)}: {record.id}")
        for accelerogram in open_record(record, mirror=mirror):
            yield record.id, accelerogram


def horizontal_of(channels: list[Accelerogram], record: CatalogueRecord) -> list[Accelerogram]:
    """Return the channels that open_record returns, from all `channels` of the record's file."""
    with about(f"{record.id} ({record.file})"):
        return [as_declared(channel, record) for channel in _selected(channels, record)]


def channels_of(
    record: CatalogueRecord, mirror: str | Path | None = None, cache: str | Path | None = None
) -> list[Accelerogram]:
    """Return every channel of the record's file as it was read. Raises RecordError naming record and file."""
    path = fetch(record, mirror, cache)
    with about(record.id):  # the reader names the file
        channels = read(
            path, unit=record.unit or None, time_step=record.time_step, inventory=inventory_of(record, mirror)
        )
        if record.sha256 and channels[0].source.sha256 != record.sha256:
            raise RecordError(f"{path.name}: the file changed while it was read.")
        return channels


def vertical_of(channels: list[Accelerogram], record: CatalogueRecord) -> Accelerogram | None:
    """Return the vertical channel among `channels`: the one the row names, else the first that says it is."""
    named = [c for c in channels if c.component == record.vertical_component]
    spoken = [c for c in channels if c.vertical and not c.borehole]
    return next(iter(named if record.vertical_component else spoken), None)


def open_vertical(
    record: CatalogueRecord, mirror: str | Path | None = None, cache: str | Path | None = None
) -> Accelerogram | None:
    """Return the vertical accelerogram of `record`, scaled as the row says; None where there is none.

    It comes from the row's vertical_file, which lies beside the catalogue or in the mirror, else from the file itself.
    Raises RecordError naming record and file.
    """
    other = record.of_vertical
    channels = channels_of(other, mirror, cache)
    found = vertical_of(channels, other)
    if found is None and record.vertical_file:
        if len(channels) > 1:
            raise RecordError(
                f"{record.id} ({other.file}): no channel says that it is vertical; name it in vertical_component."
            )
        found = channels[0]
    return None if found is None else as_declared(found, record)


def _rows(path: Path) -> list[tuple[int, dict[str, str]]]:
    try:
        if path.stat().st_size > _LARGEST:
            raise CatalogueError(f"{path}: the file is larger than {_LARGEST} bytes, which no catalogue is.")
        with path.open(encoding="utf-8-sig", newline="") as stream:
            reader = csv.DictReader(stream, restkey="", restval="", strict=True)
            rows = [(reader.line_num, row) for row in reader]
            names = list(reader.fieldnames or ())
    except (OSError, ValueError, csv.Error) as error:
        raise CatalogueError(f"{path}: the catalogue cannot be read as UTF-8 CSV, {error}.") from None
    defects = [f"column {name!r} is not known" for name in names if name not in COLUMNS]
    defects += [f"column {name!r} stands {n} times" for name, n in Counter(names).items() if n > 1]
    defects += [f"column {name!r} is missing" for name in _REQUIRED if name not in names]
    defects += [f"line {line} has more cells than there are columns" for line, row in rows if row.get("")]
    if defects:
        raise CatalogueError(f"{path.name}: {'; '.join(defects)}; the columns are {', '.join(COLUMNS)}.")
    if not rows:
        raise CatalogueError(f"{path.name}: the catalogue has no rows; give at least one record.")
    return rows


def _record(row: dict[str, str], folder: Path) -> CatalogueRecord:
    cells: dict[str, Any] = {name: (value or "").strip() for name, value in row.items() if name}
    cells |= {name: plain(cells[name]) for name in _PROSE if name in cells}
    for column, field in _NUMBERS.items():
        if cell := cells.pop(column, ""):
            cells[field] = _number(cell, column)
    if "epicentral_distance" in cells:
        cells["epicentral_distance"] *= 1000
    return CatalogueRecord(**cells, folder=folder)


def _number(cell: str, column: str) -> float:
    if not is_number(cell):
        raise CatalogueError(f"{column} is {cell!r}, but must be a number.")
    return float(cell)


def _duplicates(ids: Iterable[str]) -> list[str]:
    counts = Counter(name.strip().lower() for name in ids)
    return [
        f"id {name!r} stands {n} times (upper and lower case count as one)"
        for name, n in counts.items()
        if n > 1 and name
    ]


def _absent(record: CatalogueRecord, mirror: Path) -> Iterable[str]:
    here = record.example_name or record.is_remote
    if not here and not any((folder / record.file).is_file() for folder in (mirror, record.folder)):
        yield f"{record.id}: file {record.file!r} is neither in {mirror} nor in {record.folder}."


def _selected(channels: list[Accelerogram], record: CatalogueRecord) -> list[Accelerogram]:
    held = ", ".join(c.component or "(unnamed)" for c in channels)
    if len(channels) == len(record.components) == 1 and is_unnamed(channels[0]):
        return [_named(channels[0], record.component.strip())]
    if record.components:
        missing = [name for name in record.components if name not in {c.component for c in channels}]
        if missing:
            raise RecordError(f"component is {missing[0]!r}, but the file holds {held}.")
        return [_asked_for(next(c for c in channels if c.component == name)) for name in record.components]
    vertical = vertical_of(channels, record)
    chosen = [c for c in channels if c is not vertical and not c.vertical and not c.borehole]
    if not chosen:
        raise RecordError(
            f"the file holds no horizontal component at the surface, only {held}; name a component."
        )
    return chosen


def _asked_for(channel: Accelerogram) -> Accelerogram:
    """Return a channel that the catalogue names, with a warning when it is vertical: it will shake sideways."""
    if not channel.vertical:
        return channel
    sentence = f"Component {channel.component} is vertical, but the catalogue takes it as horizontal."
    return replace(channel, warnings=(*channel.warnings, sentence))


def _named(channel: Accelerogram, component: str) -> Accelerogram:
    """Return a channel that its file leaves unnamed under the name that the catalogue gives it."""
    return replace(channel, component=component, azimuth=azimuth(component), vertical=is_vertical(component))


def as_declared(channel: Accelerogram, record: CatalogueRecord) -> Accelerogram:
    """Return a channel with what its row says of name, scale, station, event, corner, magnitude and distance."""
    channel = scaled(channel, record.scale_factor) if record.scale_factor != 1 else channel
    return replace(
        channel,
        source=replace(channel.source, path=record.file),
        station=record.station or channel.station,
        event=record.event or channel.event,
        high_pass_frequency=record.high_pass_frequency or channel.high_pass_frequency,
        magnitude=channel.magnitude if record.magnitude is None else record.magnitude,
        epicentral_distance=(
            channel.epicentral_distance if record.epicentral_distance is None else record.epicentral_distance
        ),
    )
