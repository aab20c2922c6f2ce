"""A catalogue from a folder of files: each is listed with what was read, and those of one station share a row."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass
from itertools import chain, count, islice
from pathlib import Path
from typing import Any

from rocking.catalogue.catalogue import NAMED, is_safe_id, read_rows
from rocking.catalogue.grouping import named_channel, rsn_of, stations, without_direction
from rocking.catalogue.joining import SQUARE
from rocking.catalogue.listing import CELLS, ListedChannel, ListedFile, listed_file, trials, warnings_of
from rocking.catalogue.readings import Readings
from rocking.errors import CatalogueError, RecordError
from rocking.quantities import acceleration_factor, is_number, listed
from rocking.records.archive import is_archive, members
from rocking.records.claims import without_ending
from rocking.records.direction import angle_between, names_no_direction, pair_warning
from rocking.records.formats.format import plain
from rocking.records.formats.layouts import NAME, Layouts
from rocking.records.formats.text import day_of
from rocking.records.kinds import RecordKind
from rocking.records.read import bare_text, bytes_of, printable, recognise, unpack
from rocking.tables import read_start
from rocking.warnings import RockingWarning

Row = dict[str, str]

_ONLY_VERTICAL = "it holds no horizontal component at the surface."
_FORMULA = "=+-@"  # signs that make a spreadsheet compute what comes after them


@dataclass(frozen=True)
class FolderCatalogue:
    """The rows that a folder of files gives for its catalogue.

    files: every file, in the order of names. existing: the rows that the catalogue holds already, with the new names of
    files that were renamed, and without the request to fill in what was typed. new: the rows of the other files.
    warnings: what there is to say beyond the files. layouts: the text of layouts.csv with the questions that are new,
    None where none is.
    """

    files: list[ListedFile]
    existing: list[Row]
    new: list[Row]
    warnings: tuple[RockingWarning, ...] = ()
    layouts: str | None = None


NOTHING_DECLARED: Mapping[str, str | float | None] = {"unit": None, "time_step": None}


def catalogue_of_folder(
    folder: str | Path,
    *,
    declared: Mapping[str, str | float | None] = NOTHING_DECLARED,
    existing: Iterable[Mapping[str, str]] = (),
    keeps_readings: bool = False,
    answers: Path | None = None,
    watched: Callable[[Sequence[Path]], Iterable[Path]] = iter,
) -> FolderCatalogue:
    """Return the catalogue of the files under `folder`: its `existing` rows, and new ones for files that none names.

    Files of one event, station and start share a row, the vertical component among them. declared: unit and time_step
    [s], used only where neither a file nor its row declares them. keeps_readings: whether what was read of each file is
    cached in the folder for the next time. answers: the folder of layouts.csv, by default this one. watched: gives the
    files again, to who waits for them. Catalogues, and files whose name starts with a dot, are passed over. Raises
    RecordError when there is no folder.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise RecordError(
            f"{folder}: this is no folder; give the folder that holds the records.", folder=folder
        )
    rows = [dict(row) for row in existing]
    rows_of = {_bare(name): row for row in rows for name in row["file"].split(";")}
    layouts = Layouts(answers or folder)
    readings = Readings(folder, layouts, is_cached=keeps_readings)
    listed = []
    signatures = []
    lines: dict[str, tuple[int, float]] = {}
    for path in watched(list(files_in(folder))):
        own = _declared_in(rows_of.get(path.relative_to(folder).as_posix()), declared)
        reading = readings.of(path, own)
        listed.append(listed_file(reading, path, folder, own))
        signatures += [reading.signature] if reading.signature else []
        lines[listed[-1].file] = layouts.own(reading.signature)
    readings.save()
    tried = trials(listed, lines, layouts)
    for file in listed:
        trial = tried.get(lines[file.file][0])
        if file.channels and trial and not trial.may_hold:
            file.refusal, file.channels = f"{file.channels[0].answer}: {trial.words}", ()
    renamed = tuple(_follow_renamed(rows, rows_of, listed))
    for file in listed:
        if file.file in rows_of:
            for (
                cell,
                declared_now,
            ) in file.declarations.items():  # what the caller declares for the whole folder
                rows_of[file.file][cell] = rows_of[file.file].get(cell) or declared_now
            file.record = rows_of[file.file]["id"]
            file.direction = _direction_in(rows_of[file.file], file)
    _mark_repeats(listed)
    apart = tuple(_rows_to_join(listed))
    by_answer = {file.record: file.channels[0].answer for file in listed if file.channels and not file.blanks}
    for row in rows:
        _clear_filled(row, by_answer.get(row["id"], ""))
    new = rows_of_files(listed, (row["id"].lower() for row in rows))
    of_store = [readings.warning] if readings.warning else []
    idle = [
        RockingWarning.of(RecordKind.ANSWER_IDLE, NAME, line=answer.line, answer=answer.text)
        for answer in layouts.idle(signatures)
    ]
    asked = layouts.text(((file.file, file.question) for file in listed if file.question), tried)
    return FolderCatalogue(listed, rows, new, (*of_store, *renamed, *apart, *idle), asked)


def _direction_in(row: Row, file: ListedFile) -> str:
    """Return what the row of a file calls its one component, "" where the file itself says where it points."""
    files = [_bare(name) for name in row["file"].split(";")]
    names = (row.get("component") or "").split(";")
    is_open = len(file.channels) == 1 and names_no_direction(file.channels[0].component)
    return names[files.index(file.file)].strip() if is_open and len(names) == len(files) else ""


def _bare(name: str) -> str:
    """Return the name of a file as a folder lists it: without the ./ that keeps it from being a formula."""
    return name.strip().removeprefix("./")


def _declared_in(row: Row | None, declared: Mapping[str, Any]) -> dict[str, Any]:
    """Return unit and time step [s] that the row of a file declares, else those of the whole folder."""
    unit, step = (((row or {}).get(cell) or "").strip() for cell in CELLS.values())
    with suppress(RecordError):
        acceleration_factor(unit)
        declared = {**declared, "unit": unit}
    return {
        "unit": declared["unit"],
        "time_step": float(step) if is_number(step) and float(step) > 0 else declared["time_step"],
    }


def _follow_renamed(
    rows: Iterable[Row], rows_of: dict[str, Row], listed: Iterable[ListedFile]
) -> Iterator[RockingWarning]:
    """Write the new names of renamed files into their rows, and say so: known by their sha256, the old name is gone."""
    present = {file.file for file in listed}
    strangers = {file.sha256: file.file for file in listed if file.sha256 and file.file not in rows_of}
    for row in rows:
        names = row["file"].split(";")
        hashes = (row.get("sha256") or "").split(";")
        for place, (name, sha256) in enumerate(zip(names, hashes, strict=False)):
            now = strangers.get(sha256.strip(), "")
            if _bare(name) in present or not now:
                continue
            names[place] = _as_cell(now)
            rows_of[now] = row
            del strangers[sha256.strip()]
            yield RockingWarning.of(RecordKind.FILE_RENAMED, row["id"], before=name.strip(), now=now)
        row["file"] = ";".join(names)


def _as_cell(name: str) -> str:
    """Return the name of a file so that no spreadsheet takes it for a formula."""
    return f"./{name}" if name[0] in _FORMULA else name


def _mark_repeats(listed: Iterable[ListedFile]) -> None:
    """Mark the files that have the content of an earlier one."""
    originals: dict[str, str] = {}
    for file in listed:
        if file.channels and not file.refusal:
            original = originals.setdefault(file.sha256, file.file)
            file.is_repeat = original != file.file
            if file.is_repeat:
                file.warnings += (RockingWarning.of(RecordKind.CONTENT_REPEATED, original=original),)


def _rows_to_join(listed: Sequence[ListedFile]) -> Iterator[RockingWarning]:
    """Yield a warning on each station of which a component has a separate row: a person may make them one."""
    sizes = Counter(file.record for file in listed)
    single = [
        copy(file) for file in listed if not file.refusal and (not file.record or sizes[file.record] == 1)
    ]
    for group in stations(single):
        if len(group) > 1 and any(file.record for file in group):
            cell = ";".join(_as_cell(file.file) for file in group)
            rows = " and ".join(file.record for file in group if file.record)
            yield RockingWarning.of(RecordKind.ROWS_TO_JOIN, files=cell, rows=rows)


_FILL = "Fill in {}."


def _clear_filled(row: Row, answer: str) -> None:
    """Take the request to fill in a cell out of the note of a row once the cell is filled, or its layout answered."""
    note = row.get("note") or ""
    for names in (("unit", "time_step_s"), ("unit",), ("time_step_s",)):
        request = _FILL.format(" and ".join(names))
        if request in note:
            missing = [name for name in names if not (row.get(name) or "").strip()]
            rest = _FILL.format(" and ".join(missing)) if missing else ""
            rest = f"{answer[0].upper()}{answer[1:]}." if answer else rest
            row["note"] = plain(note.replace(request, rest))
            return


def rows_of_files(listed: Sequence[ListedFile], taken: Iterable[str] = ()) -> list[Row]:
    """Return the rows of the files that have none yet, and note in each file which row it got, or why none."""
    ids = set(taken)
    rows = []
    for group in stations([file for file in listed if not (file.refusal or file.record)]):
        channels = list(map(named_channel, group)) if len(group) > 1 else group[0].channels
        level = [channel for channel in channels if channel.is_horizontal]
        if level:
            rows.append(_row(group, level, ids))
            ids.add(rows[-1]["id"].lower())
        for file in group:
            file.record = rows[-1]["id"] if level else ""
            file.companions = len(group) - 1
            by_name = [
                str(warning) for warning in file.warnings if warning.kind is RecordKind.VERTICAL_BY_NAME
            ]
            why = filter(None, (_ONLY_VERTICAL, file.separated, *by_name))
            file.refusal = "" if level else " ".join(why)
    return rows


def files_in(folder: Path) -> Iterator[Path]:
    """Yield the files under `folder`, in the order of names, those of archives too; no hidden ones and catalogues."""
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        if is_archive(path) and not path.name.startswith("."):
            try:
                yield from (path / name for name in members(path))
            except RecordError:
                yield path  # reading it says why
            continue
        head = read_start(path, 11).removeprefix(b"\xef\xbb\xbf")
        is_catalogue = path.suffix.lower() == ".csv" and head.startswith((b"id,file", b"id;file"))
        if not (path.name.startswith(".") or is_catalogue or path.name == NAME):
            yield path


def _row(group: Sequence[ListedFile], level: Sequence[ListedChannel], ids: set[str]) -> Row:
    """Return the row of files whose horizontal components are `level`."""
    first = level[0]
    fill = group[0].blanks
    is_named = any(file.direction for file in group)
    read_as = f", {first.answer}" if first.answer else ""
    head = f"{first.format}{read_as}.", _FILL.format(" and ".join(fill)) if fill else ""
    return {
        "id": _id(group, level, ids),
        "file": ";".join(_as_cell(file.file) for file in group),
        "component": ";".join(file.direction for file in group) if is_named else "",
        "event": first.event.lstrip(_FORMULA + " "),
        "station": first.station.lstrip(_FORMULA + " "),
        "sha256": ";".join(file.sha256 for file in group),
        **group[0].declarations,
        "note": plain(" ".join([*head, *map(str, _warnings(group, level)), group[0].separated])),
    }


def _warnings(group: Sequence[ListedFile], level: Sequence[ListedChannel]) -> Iterator[RockingWarning]:
    """Yield what is doubtful of the files of a row and of the directions of its components."""
    yield from dict.fromkeys(warning for file in group for warning in warnings_of(file))
    angle = angle_between(*level) if len(level) == 2 else None
    if angle is not None and abs(angle - 90) > SQUARE:
        first, second = (channel.component for channel in level)
        yield RockingWarning.of(
            RecordKind.NOT_SQUARE, first=first, second=second, angle_deg=min(angle, 180 - angle)
        )
    if warning := pair_warning(level):
        yield warning


_LONGEST_ID = 70
"""Characters of an identifier that is made of names; a number may follow."""


def _id(group: Sequence[ListedFile], level: Sequence[ListedChannel], ids: set[str]) -> str:
    """Return an identifier that is not in `ids`: the file's name, or event and station of files that share a row."""
    shares_a_row = len(group) > 1
    name = _of_station(group, level[0]) if shares_a_row else without_ending(Path(group[0].file).name)
    plain = re.sub(r"[^A-Za-z0-9._-]+", "_", name).replace("_-_", "_")
    base = plain[:_LONGEST_ID].strip("._-") or "record"
    if not is_safe_id(base):
        base = f"record_{base}"

    numbered = (f"{base}_{number}" for number in count(2))
    return next(free for free in chain([base], numbered) if free.lower() not in ids)


def _of_station(group: Sequence[ListedFile], first: ListedChannel) -> str:
    """Return what the headers of a station's files call event and station, else what the names of the files share."""
    event = day_of(first.event) or first.start_time[:10]
    if not (event and first.station):
        return without_direction(group[0])
    number = rsn_of(group[0].file)
    return "_".join(filter(None, (number, event, first.station)))


_LOOKED_AT = 200  # files next to a catalogue that are opened, at most, to see whether they are records


def unlisted(catalogue: Path) -> tuple[RockingWarning, ...]:
    """Return a warning when records lie next to `catalogue` that neither it nor another catalogue there names.

    But for those that a catalogue of the folder was asked to list, and which it refused: it would again.
    """
    folder = catalogue.parent
    catalogued: set[Path] = set()
    for path in folder.glob("*.csv"):
        with suppress(CatalogueError):
            names = (name.strip() for _, row in read_rows(path) for name in row["file"].split(";"))
            catalogued |= {folder / name for name in names}
    records = []
    for path in islice((path for path in files_in(folder) if path not in catalogued), _LOOKED_AT):
        with suppress(RecordError):
            recognise(bare_text(unpack(bytes_of(path), path.name)))
            records.append(path)
    if records:
        readings = Readings(folder, Layouts(folder))
        records = [path for path in records if not _was_refused(path, folder, readings)]
    if not records:
        return ()
    files = listed([printable(path.relative_to(folder).as_posix()) for path in records], NAMED)
    return (RockingWarning.of(RecordKind.FILES_UNLISTED, files=files, folder=str(folder)),)


def _was_refused(path: Path, folder: Path, readings: Readings) -> bool:
    """Whether the file was read for a catalogue as it is, and can get no row there whatever is answered."""
    listed = [listed_file(reading, path, folder, NOTHING_DECLARED) for reading in readings.cached_of(path)]
    return bool(listed) and all(
        not file.question and (file.refusal or not any(channel.is_horizontal for channel in file.channels))
        for file in listed
    )
