"""A catalogue from a folder of files: each is listed with what was read, and those of one station share a row."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from datetime import datetime
from itertools import chain, count, islice
from pathlib import Path
from typing import Any

import numpy as np

from rocking.errors import CatalogueError, RecordError, UndeclaredError
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue import is_safe_id, read_rows, stays_inside
from rocking.records.formats.format import plain
from rocking.records.joining import why_apart
from rocking.records.processing import process, velocity
from rocking.records.read import bare_text, bytes_of, is_unnamed, printable, read, recognise, unpack
from rocking.tables import read_start

Row = dict[str, str]

_ONLY_VERTICAL = "it holds no horizontal component at the surface."
_SIDEWAYS = "The file's name says {}, but {} is taken as horizontal."
_BAD_NAME = "its name holds a character that a catalogue does not allow, or a blank at its end; rename it."

_STAND_INS: dict[str, Any] = {"unit": "mm/s2", "time_step": 0.01}
"""With which a file that declares none is looked at; the unit is small enough for counts."""
_UPWARDS = re.compile(r"(?:^|[-_. ])(UP|UD|DN|DWN|DOWN|VER|VERT|VERTICAL)(?=[-_. ]|$)", re.I)
_FORMULA = "=+-@"  # signs that make a spreadsheet compute what comes after them
_ENDING = re.compile(r"\.(at2|txt|csv|asc|dat|acc|gz)$", re.I)
_RSN = re.compile(r"(RSN\d+)_")
_SQUARE = 5.0  # degrees by which two components may be off a right angle without a word


@dataclass
class ListedFile:
    """One file of a folder as it was read, and the id of the catalogue row it stands in, "" if it cannot be used.

    channels: with two of their samples, so that many fit into memory; sizes: number of samples of each; peaks: PGA, g,
    and PGV, m/s, of each as it is listed. doubts: what is plausibly wrong, one sentence each. refusal: why it gets no
    row; separation: why it does not share the row of other files of its station, or "". blanks: the cells that its row
    leaves blank and that must be filled; declarations: those that hold what its header does not say. companions: number
    of other files in its row. is_repeat: whether it has the content of an earlier file.
    """

    file: str
    channels: Sequence[Accelerogram] = ()
    sizes: Sequence[int] = ()
    peaks: Sequence[tuple[str, str]] = ()
    refusal: str = ""
    doubts: tuple[str, ...] = ()
    declarations: Row = field(default_factory=dict)
    blanks: tuple[str, ...] = ()
    separation: str = ""
    record: str = ""
    companions: int = 0
    is_repeat: bool = False

    @property
    def status(self) -> str:
        """What there is to say of the file, in one line."""
        if self.refusal:
            return f"not read: {self.refusal}"
        parts = [f"to fill: {', '.join(self.blanks)}"] if self.blanks else list(self.doubts)
        if self.companions:
            parts.append(f"Joined with {self.companions} more as {self.record}.")
        return " ".join(filter(None, [*parts, self.separation])) or "read"


def list_folder(
    folder: str | Path,
    *,
    unit: str | None = None,
    time_step: float | None = None,
    catalogue: Iterable[Mapping[str, str]] = (),
) -> tuple[list[ListedFile], list[Row]]:
    """Return every file under `folder` as it can be read, in the order of names, and the rows of a catalogue for them.

    Files of one event, station and start share a row, the vertical component among them. unit and time_step [s] are
    used only where a file does not declare them. catalogue: rows that exist already; their files get no other.
    Catalogues, and files whose name starts with a dot, are passed over. Raises RecordError when there is no folder.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise RecordError(f"{folder}: this is no folder; give the folder that holds the records.")
    records = {name.strip(): row["id"] for row in catalogue for name in row["file"].split(";")}
    ids = {record.lower() for record in records.values()}
    listed = [_listed(path, folder, {"unit": unit, "time_step": time_step}) for path in _files(folder)]
    originals: dict[str, str] = {}
    for file in listed:
        file.record = records.get(file.file, "") or records.get(f"./{file.file}", "")
        if file.channels and not file.refusal:
            original = originals.setdefault(file.channels[0].source.sha256, file.file)
            file.is_repeat = original != file.file
            if file.is_repeat:
                file.doubts += (f"Its content is that of {original}: as two records it would count twice.",)
    rows = []
    for group in _stations([file for file in listed if not (file.refusal or file.record)]):
        level = [channel for file in group for channel in file.channels if channel.is_horizontal]
        if level:
            rows.append(_row(group, level, ids))
            ids.add(rows[-1]["id"].lower())
        for file in group:
            file.record = rows[-1]["id"] if level else ""
            file.companions = len(group) - 1
            file.refusal = "" if level else f"{_ONLY_VERTICAL} {file.separation}".strip()
    return listed, rows


def _files(folder: Path) -> Iterator[Path]:
    """Yield the files under `folder` in the order of names, but for hidden ones and catalogues."""
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        head = read_start(path, 11).removeprefix(b"\xef\xbb\xbf")
        is_catalogue = path.suffix.lower() == ".csv" and head.startswith(b"id,file")
        if not (path.name.startswith(".") or is_catalogue):
            yield path


def _stations(files: Sequence[ListedFile]) -> list[list[ListedFile]]:
    """Return the files that share a row, in the order of their first; those of a station that do not fit say why."""
    groups: dict[object, list[ListedFile]] = {}
    for file in files:
        groups.setdefault(_station_key(file) or file.file, []).append(file)
    stations = []
    for group in (part for of_one in groups.values() for part in _simultaneous(of_one)):
        level = [file for file in group if file.channels[0].is_horizontal]
        together = next((files for files in (group, level) if not _why_apart(files)), [])
        for file in group:
            if file not in together:
                file.separation = f"Not joined with the other files of its station: {_why_apart(group)}."
                stations.append([file])
        stations += [together] if together else []
    places = {file.file: place for place, file in enumerate(files)}
    return sorted(stations, key=lambda group: places[group[0].file])


def _station_key(file: ListedFile) -> object:
    """Return what the files of one station and event have in common; None where a header does not name the station."""
    first = file.channels[0]
    folder, _, name = file.file.rpartition("/")
    number = _RSN.match(name)
    is_named = number or (first.station and (first.event or first.start_time))
    if len(file.channels) > 1 or not is_named or first.borehole or file.is_repeat:
        return None
    of_header = (first.network, first.station, first.location, first.event)
    return folder, first.source.format, number[1] if number else of_header, file.blanks


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
            end = starts[place] + files[place].sizes[0] * files[place].channels[0].time_step
        parts[-1].append(place)
    return [[files[place] for place in sorted(part)] for part in parts]


def _why_apart(group: Sequence[ListedFile]) -> str:
    """Return why the files of one station cannot share a row, or ""."""
    if len(group) == 1:
        return ""
    channels = [channel for file in group for channel in file.channels]
    level = [channel for channel in channels if not channel.vertical]
    unnamed = (file.file for file in group for channel in file.channels if is_unnamed(channel.component))
    if file := next(unnamed, ""):
        return f"{file} does not name its component"
    if why := why_apart(channels, [size for file in group for size in file.sizes]):
        return why
    if len(level) > 2 or len(channels) - len(level) > 1:
        return f"it has {len(level)} horizontal and {len(channels) - len(level)} vertical components"
    if any(each.declarations != group[0].declarations for each in group):
        return "not all of them declare unit and time step"
    if (angle := _angle(level)) is not None and min(angle, 180 - angle) < _SQUARE:
        return f"components {level[0].component} and {level[1].component} point the same way"
    return ""


def _angle(level: Sequence[Accelerogram]) -> float | None:
    """Return the angle between two horizontal components, degrees in [0, 180), None where it is unknown."""
    if len(level) != 2 or level[0].azimuth is None or level[1].azimuth is None:
        return None
    return (level[1].azimuth - level[0].azimuth) % 180


def _listed(path: Path, folder: Path, declared: Mapping[str, Any]) -> ListedFile:
    name = path.relative_to(folder).as_posix()
    file = printable(name)
    for missing in ((), ("unit",), ("time_step",), ("unit", "time_step")):  # no more than the file leaves out
        try:
            channels = read(path, **{each: declared[each] or _STAND_INS[each] for each in missing})
            break
        except RecordError as error:
            if not isinstance(error, UndeclaredError) or len(missing) == 2:
                return ListedFile(file, refusal=printable(str(error)))
    reason = ""
    if not stays_inside(name) or name != name.strip() or name != file:
        reason = _BAD_NAME
    elif not path.resolve().is_relative_to(folder.resolve()):
        reason = "it is a link that leads out of the folder; copy the file instead."
    doubts: dict[str, list[str]] = {}
    upwards = _UPWARDS.search(path.stem)
    for channel in channels:
        level = [_SIDEWAYS.format(upwards[1], channel.component)] if upwards and not channel.vertical else []
        for sentence in (*channel.warnings, *level):
            doubts.setdefault(sentence, []).append(channel.component)
    remarks = tuple(s if len(of) == len(channels) else f"{', '.join(of)}: {s}" for s, of in doubts.items())
    declarations = {_CELLS[name]: f"{declared[name]}" for name in missing if declared[name]}
    blanks = tuple(_CELLS[name] for name in missing if not declared[name])
    own = [replace(channel, acceleration=channel.acceleration[:2]) for channel in channels]
    sizes = [channel.acceleration.size for channel in channels]
    peaks = [("", "") if blanks else _peaks(channel) for channel in channels]
    return ListedFile(file, own, sizes, peaks, reason, remarks, declarations, blanks)


def _peaks(record: Accelerogram) -> tuple[str, str]:
    """Return PGA, g, and PGV, m/s, as a study clears the record by default."""
    speed = ""
    with suppress(RecordError):  # it is too short to be processed
        speed = f"{abs(velocity(process(record))).max():.3g}"
    return f"{record.peak_acceleration / GRAVITY:.3g}", speed


_CELLS = {"unit": "unit", "time_step": "time_step_s"}


def _row(group: Sequence[ListedFile], level: Sequence[Accelerogram], ids: set[str]) -> Row:
    """Return the row of files whose horizontal components are `level`."""
    first = level[0]
    fill = group[0].blanks
    doubts = dict.fromkeys(doubt for file in group for doubt in file.doubts)
    remarks = [s for s in doubts if not fill or ("m/s" not in s and " g," not in s)]
    if (angle := _angle(level)) is not None and abs(angle - 90) > _SQUARE:
        names = f"{level[0].component} and {level[1].component}"
        remarks.append(f"Components {names} are {min(angle, 180 - angle):g}° apart, not at right angles.")
    head = f"{first.source.format}.", f"Fill in {' and '.join(fill)}." if fill else ""
    return {
        "id": _id(group, ids),
        "file": ";".join(f"./{file.file}" if file.file[0] in _FORMULA else file.file for file in group),
        "event": first.event.lstrip(_FORMULA + " "),
        "station": first.station.lstrip(_FORMULA + " "),
        "sha256": ";".join(file.channels[0].source.sha256 for file in group),
        **group[0].declarations,
        "note": plain(" ".join([*head, *remarks, group[0].separation])),
    }


def _id(group: Sequence[ListedFile], ids: set[str]) -> str:
    """Return the file's name, without its component where several share the row, as an identifier not in `ids`."""
    base = _ENDING.sub("", Path(group[0].file).name)
    component = group[0].channels[0].component
    if len(group) > 1:
        beside = [Path(file.file).name for file in group]
        same = next((i for i in range(len(base)) if len({name[i : i + 1] for name in beside}) > 1), len(base))
        if component and base.endswith(component):
            base = base.removesuffix(component)
        elif same > 2:
            base = base[:same]
    base = re.sub(r"[^A-Za-z0-9._-]+", "_", base)[:70].strip("._-") or "record"
    base = base if is_safe_id(base) else f"record_{base}"
    names = chain([base], (f"{base}_{number}" for number in count(2)))
    return next(name for name in names if name.lower() not in ids)


_HEAD = ("file", "component", "format", "step s", "samples", "PGA g", "PGV m/s", "status")
_WIDEST = (40, 16, 24, 9, 9, 9, 9, 400)
_ALIGNED = "<<<>>>><"


def listing_text(listed: Sequence[ListedFile]) -> str:
    """Return one line for each channel of each file: format, step, samples, PGA, PGV, component and status."""
    rows: list[tuple[str, ...]] = [_HEAD]
    for file in listed:
        start = len(rows)
        for record, size, peaks in zip(file.channels, file.sizes, file.peaks, strict=True):
            step = "" if "time_step_s" in file.blanks else f"{record.time_step:g}"
            rows.append(("", record.component, record.source.format, step, str(size), *peaks, ""))
        rows[start:] = rows[start:] or [("",) * len(_HEAD)]
        rows[start] = (file.file, *rows[start][1:-1], file.status)
    columns = []
    for column, widest, side in zip(zip(*rows, strict=True), _WIDEST, _ALIGNED, strict=True):
        cells = [cell if len(cell) <= widest else f"{cell[: widest - 1]}…" for cell in column]
        columns.append([f"{cell:{side}{max(map(len, cells))}}" for cell in cells])
    return "".join("  ".join(row).rstrip() + "\n" for row in zip(*columns, strict=True))


_LOOKED_AT = 200  # files beside a catalogue that are opened, at most, to see whether they are records


def unlisted(catalogue: Path) -> tuple[str, ...]:
    """Return a sentence when records lie beside `catalogue` that neither it nor another catalogue there names."""
    folder = catalogue.parent
    catalogued: set[Path] = set()
    for path in folder.glob("*.csv"):
        with suppress(CatalogueError):
            names = (name.strip() for _, row in read_rows(path) for name in row["file"].split(";"))
            catalogued |= {folder / name for name in names}
    records = []
    for path in islice((path for path in _files(folder) if path not in catalogued), _LOOKED_AT):
        with suppress(RecordError):
            form = recognise(bare_text(unpack(bytes_of(path), path.name)))
            records += [path.relative_to(folder).as_posix()] if form.name != "StationXML" else []
    if not records:
        return ()
    files = f"{printable(records[0])} is" if len(records) == 1 else f"{len(records)} files are"
    return (f"{files} not in the catalogue; rocking catalogue {folder} adds what is new.",)
