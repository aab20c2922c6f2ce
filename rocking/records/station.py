"""Station: what the files of one row of a catalogue hold, wherever they lie, on one span of time."""

import hashlib
import time
import urllib.request
from collections import Counter
from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np

from rocking.errors import RecordError, about
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue import CatalogueRecord, RecordFile, catalogue_text, load_catalogue, read_rows
from rocking.records.formats import Options
from rocking.records.formats.binary import MINISEED
from rocking.records.instrument import directed
from rocking.records.plausibility import scaled
from rocking.records.read import LARGEST_FILE, bytes_of, is_unnamed, read_raw
from rocking.records.traces import first_line
from rocking.tables import write_whole

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
    channels: list[Accelerogram] = []
    with about(record.id):
        inventory = _beside(record, record.inventory, mirror) if record.inventory else None
        if record.inventory and inventory is None:
            raise RecordError(f"inventory {record.inventory!r} is missing; mend the row or add the file.")
        for file in record.files:
            path = path_of(record, file, mirror)
            raw = bytes_of(path)
            if file.sha256 and (sha256 := hashlib.sha256(raw).hexdigest()) != file.sha256:
                hashes = f"file {path} has sha256 {sha256}, but the catalogue says {file.sha256}"
                raise RecordError(f"{hashes}; it is another version.")
            options = Options(record.unit or None, record.time_step, inventory, path.parent)
            opened = read_raw(raw, path, options)
            channels += [replace(each, source=replace(each.source, path=file.name)) for each in opened]
        return station_of(channels, record)


def open_record(record: CatalogueRecord, mirror: str | Path | None = None) -> list[Accelerogram]:
    """Return the horizontal components of `record`, as open_station does."""
    return list(open_station(record, mirror).horizontal)


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
        is_one_each = len(record.files) == len(channels) == len(record.components)
        if is_one_each and all(is_unnamed(channel.component) for channel in channels):
            names = ({"component": name} for name in record.components)
            channels = [replace(each, **directed(name)) for each, name in zip(channels, names, strict=True)]
        channels = joined(channels) if len(record.files) > 1 else channels
        names_in_file = ", ".join(channel.component or "(unnamed)" for channel in channels)
        of = {channel.component: channel for channel in reversed(channels)}
        for name in filter(None, (*record.components, record.vertical_component)):
            if name not in of:
                raise RecordError(f"component is {name!r}, but the file holds {names_in_file}.")
        upwards = (channel for channel in channels if channel.vertical and not channel.borehole)
        vertical = of[record.vertical_component] if record.vertical_component else next(upwards, None)
        horizontal = [of[name] for name in record.components]
        if horizontal and len(record.files) == 1:  # a vertical one that is asked for will shake sideways
            horizontal = [c.warned(_SIDEWAYS.format(c.component)) if c.vertical else c for c in horizontal]
        else:
            sideways = horizontal or [channel for channel in channels if not channel.borehole]
            horizontal = [channel for channel in sideways if channel is not vertical and not channel.vertical]
        if not horizontal:
            raise RecordError(f"the file holds no horizontal component, only {names_in_file}; name one.")
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


_RETRIES = 3
_PIECE = 2**16
LONGEST_DOWNLOAD, _SILENCE = 300.0, 30.0
"""s; of one file with all its tries, and without a byte."""
_RAW = "https://raw.githubusercontent.com/{repository}/{commit}/{path}"


def path_of(record: CatalogueRecord, file: RecordFile, mirror: str | Path | None = None) -> Path:
    """Return where `file` of the record lies, downloaded into the user's cache folder if need be.

    mirror: a folder that is looked into first. Raises RecordError naming the file when it cannot be had.
    """
    if record.example_name is not None:
        from obspy.core.util.base import get_example_file  # which takes a second to import

        try:
            return Path(get_example_file(record.example_name))
        except (OSError, ValueError):
            raise RecordError(f"obspy installs no example file {record.example_name!r}.") from None
    if path := _beside(record, file.name, mirror):
        return path
    if record.is_remote:
        source = record.source_repository, record.source_commit, file.source_path
        return download(file.name, *source, sha256=file.sha256)
    places = " or ".join(str(folder) for folder in (mirror, record.folder) if folder)
    raise RecordError(f"file {file.name!r} is not in {places}; mend the catalogue or add the file.")


def local_files(record: CatalogueRecord, mirror: str | Path | None = None) -> list[Path]:
    """Return the files on this machine that opening `record` would read; none that leads out of its folder.

    Its own files and the StationXML it names; for a miniSEED file, packed or not, that names none and declares no unit,
    every XML file beside it, among which the reader looks.
    """
    own = [] if record.example_name else [file.name for file in record.files]
    paths: list[Path] = []
    beside: list[Path] = []
    for name in filter(None, [*own, record.inventory]):
        with suppress(RecordError):
            paths += filter(None, [_beside(record, name, mirror)])
    for path in () if record.inventory or record.unit else paths:
        with suppress(OSError), path.open("rb") as stream:
            head = stream.read(256)
            if head.startswith(b"\x1f\x8b") or MINISEED.recognise(head):
                beside += sorted(path.parent.glob("*.xml"))
    return paths + beside


def _beside(record: CatalogueRecord, file: str, mirror: str | Path | None) -> Path | None:
    """Return `file` in the mirror or the catalogue's folder, refusing links that lead out of it."""
    for folder in (mirror, record.folder):
        if folder is None or not (path := Path(folder) / file).is_file():
            continue
        if not path.resolve().is_relative_to(Path(folder).resolve()):
            raise RecordError(f"file {file!r} leads out of {folder}; keep it inside.")
        return path
    return None


def download(file: str, repository: str, commit: str, path: str, *, sha256: str = "") -> Path:
    """Return where the user's cache keeps `path` of a GitHub repository, downloaded if need be.

    sha256: checked if given. Raises RecordError naming `file` when it cannot be had.
    """
    import pooch  # which only a download needs

    name = f"{(sha256 or commit)[:16]}-{Path(path).name}"
    address = _RAW.format(repository=repository, commit=commit, path=quote(path, safe="/"))
    store = pooch.create(
        path=pooch.os_cache("rocking"), base_url="",
        registry={name: f"sha256:{sha256}" if sha256 else None}, urls={name: address}, retry_if_failed=_RETRIES,
    )  # fmt: skip
    pooch.get_logger().setLevel("WARNING")
    try:
        return Path(store.fetch(name, downloader=_Downloader()))
    except Exception as error:
        failed = f"file {file!r} cannot be fetched from {address}, {first_line(error)}"
        raise RecordError(f"{failed}; try again or give a mirror folder.") from error


class _Direct(urllib.request.HTTPRedirectHandler):
    """Follow a redirect to https only: what comes over http may have been changed on the way."""

    def redirect_request(self, req, fp, code, msg, headers, newurl):
        if not newurl.startswith("https://"):
            raise RecordError(f"the server redirects to {newurl[:100]}, which is not https")
        return super().redirect_request(req, fp, code, msg, headers, newurl)


class _Downloader:
    """Download for pooch, within a size that a record can have and a time, both for all tries together."""

    def __init__(self) -> None:
        self.ends = time.monotonic() + LONGEST_DOWNLOAD

    def __call__(self, address: str, target: str, _: object) -> None:
        request = urllib.request.Request(address, headers={"User-Agent": "rocking"})
        opener = urllib.request.build_opener(_Direct)
        with (
            opener.open(request, timeout=self._remaining_time()) as answer,
            Path(target).open("wb") as stream,
        ):
            size = 0
            while piece := answer.read1(_PIECE):
                size += len(piece)
                if size > LARGEST_FILE:
                    raise RecordError(f"the file is larger than {LARGEST_FILE} bytes, which no record is")
                stream.write(piece)
                self._remaining_time()

    def _remaining_time(self) -> float:
        remaining = self.ends - time.monotonic()
        if remaining <= 0:
            raise RecordError(f"the download took more than {LONGEST_DOWNLOAD:g} s")
        return min(remaining, _SILENCE)


def fill_hashes(path: str | Path, mirror: str | Path | None = None) -> tuple[str, ...]:
    """Write the sha256 of each file into the rows of the catalogue at `path` that leave it blank; return their ids.

    A file that is not there stays blank: opening it says so. The other cells stay as they are, and nothing is written
    when nothing is to be filled. Raises CatalogueError for a catalogue with defects.
    """
    path = Path(path)
    records = {record.id: (record, with_hashes(record, mirror)) for record in load_catalogue(path)}
    cells = {name: {"sha256": new.sha256} for name, (old, new) in records.items() if new != old}
    if cells:
        rows = [row for _, row in read_rows(path)]
        columns = list(dict.fromkeys([*rows[0], "sha256"]))
        text = catalogue_text((row | cells.get(row["id"].strip(), {}) for row in rows), columns)
        write_whole(path, text.encode())
    return tuple(cells)


def with_hashes(record: CatalogueRecord, mirror: str | Path | None = None) -> CatalogueRecord:
    """Return `record` as it stands in the catalogue once fill_hashes has been there."""
    hashes = [file.sha256 for file in record.files]
    for i, file in enumerate(record.files):
        with suppress(RecordError):
            hashes[i] = file.sha256 or hashlib.sha256(bytes_of(path_of(record, file, mirror))).hexdigest()
    return replace(record, sha256=";".join(hashes)) if any(hashes) else record
