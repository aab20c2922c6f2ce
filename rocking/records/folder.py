"""A catalogue from a folder of files: each is listed with what was read and what is doubtful, and may get a row."""

import csv
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from io import StringIO
from pathlib import Path

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue_record import COLUMNS, is_safe_id, stays_inside
from rocking.records.processing import process, velocity
from rocking.records.read import plain, printable, read

Row = dict[str, str]

_STAND_IN = "mm/s2"
"""Unit in which a file that declares none is looked at, small enough for counts: for its step and number of samples."""
_UPWARDS = re.compile(r"(?:^|[-_. ])(UP|UD|DN|DWN|DOWN|VER|VERT|VERTICAL)(?=[-_. ]|$)", re.I)
_FORMULA = "=+-@"


@dataclass(frozen=True)
class ListedChannel:
    """One channel as it was read: time_step in s, peak_acceleration in m/s², peak_velocity in m/s; None if unknown."""

    component: str
    format: str
    time_step: float | None
    samples: int
    peak_acceleration: float | None
    peak_velocity: float | None


@dataclass(frozen=True)
class ListedFile:
    """One file of a folder: its channels, the catalogue row it gets (None if it cannot be used) and its status.

    doubts: what is plausibly wrong with it, one sentence each. unread: why it gets no row, or "".
    to_fill: the cells that the row leaves blank and that must be filled before it can be used.
    """

    file: str
    channels: tuple[ListedChannel, ...] = ()
    row: Row | None = None
    doubts: tuple[str, ...] = ()
    unread: str = ""
    to_fill: tuple[str, ...] = ()

    @property
    def status(self) -> str:
        """What there is to say of the file, in one line."""
        if self.unread:
            return f"not read: {self.unread}"
        if self.to_fill:
            return f"to fill: {', '.join(self.to_fill)}"
        return " ".join(self.doubts) or "read"


def list_folder(
    folder: str | Path, *, unit: str | None = None, time_step: float | None = None
) -> list[ListedFile]:
    """Return every file under `folder`, as it can be read, in the order of names.

    unit and time_step [s] are used only where a file does not declare them. Catalogues, and files whose name
    starts with a dot, are passed over. Raises RecordError when `folder` is no folder.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise RecordError(f"{folder}: this is no folder; give the folder that holds the records.")
    listed: list[ListedFile] = []
    taken: set[str] = set()
    known: dict[str, str] = {}
    for path in sorted(p for p in folder.rglob("*") if p.is_file() and not _passed_over(p)):
        found = _listed(path, folder, unit, time_step, taken)
        if found.row:
            taken.add(found.row["id"].lower())
            first = known.setdefault(found.row["sha256"], found.file)
            found = found if first == found.file else _repeated(found, found.row, first)
        listed.append(found)
    return listed


def _repeated(found: ListedFile, row: Row, first: str) -> ListedFile:
    sentence = f"Its content is that of {first}: as two records it would count twice."
    note = {"note": f"{row['note']} {sentence}"}
    return replace(found, row=row | note, doubts=(*found.doubts, sentence))


def write_catalogue_rows(rows: Iterable[Row]) -> str:
    """Return `rows` as the text of a catalogue."""
    text = StringIO(newline="")
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: plain(value) for name, value in row.items()} for row in rows)
    return text.getvalue()


def _listed(
    path: Path, folder: Path, unit: str | None, time_step: float | None, taken: set[str]
) -> ListedFile:
    name = path.relative_to(folder).as_posix()
    file = printable(name)
    try:
        channels, declared, to_fill = _read(path, unit, time_step)
    except RecordError as error:
        return ListedFile(file, unread=printable(str(error)))
    told = tuple(_channel(channel, to_fill) for channel in channels)
    if reason := _unusable(path, folder, name, channels):
        return ListedFile(file, told, unread=reason)
    doubts = _together([(channel.component, _doubts(channel, name)) for channel in channels])
    row = _row(name, channels, declared, taken) | {"note": _note(channels[0], doubts, to_fill)}
    return ListedFile(file, told, row, doubts, to_fill=to_fill)


def _unusable(path: Path, folder: Path, name: str, channels: Sequence[Accelerogram]) -> str:
    """Return why a file that reads cannot stand in a catalogue, or ""."""
    if not stays_inside(name) or name != name.strip() or name != printable(name):
        return "its name holds a character that a catalogue does not allow, or begins or ends with a blank; rename it."
    if not path.resolve().is_relative_to(folder.resolve()):
        return "it is a link that leads out of the folder; copy the file instead."
    if not any(not c.vertical and not c.borehole for c in channels):
        return "it holds no horizontal component at the surface."
    return ""


def _passed_over(path: Path) -> bool:
    if path.name.startswith("."):
        return True
    try:
        with path.open("rb") as stream:
            return path.suffix.lower() == ".csv" and stream.read(11).removeprefix(b"\xef\xbb\xbf").startswith(
                b"id,file"
            )
    except OSError:
        return False


def _read(
    path: Path, unit: str | None, time_step: float | None
) -> tuple[list[Accelerogram], Row, tuple[str, ...]]:
    """Return (channels, cells that had to be declared, cells to fill), declaring no more than the file leaves out."""
    for declared in ({}, {"unit": unit}, {"time_step": time_step}, {"unit": unit, "time_step": time_step}):
        try:
            return read(path, **declared), _cells(declared), ()
        except UndeclaredError:
            continue
    stand_ins: dict = {"unit": unit or _STAND_IN, "time_step": time_step or 1.0}
    for missing in (("unit",), ("time_step",), ("unit", "time_step")):
        try:
            channels = read(path, **{name: stand_ins[name] for name in missing})
        except UndeclaredError:
            continue
        given = {
            name: value
            for name, value in (("unit", unit), ("time_step", time_step))
            if name in missing and value
        }
        return channels, _cells(given), tuple(_CELLS[name] for name in missing if name not in given)
    raise UndeclaredError(f"{printable(path.name)}: neither unit nor time step is declared.")


_CELLS = {"unit": "unit", "time_step": "time_step_s"}


def _cells(declared: dict) -> Row:
    return {_CELLS[key]: f"{value}" for key, value in declared.items() if value is not None}


def _channel(record: Accelerogram, to_fill: tuple[str, ...]) -> ListedChannel:
    known = not to_fill
    return ListedChannel(
        component=record.component,
        format=record.source.format,
        time_step=None if "time_step_s" in to_fill else record.time_step,
        samples=record.acceleration.size,
        peak_acceleration=record.peak_acceleration if known else None,
        peak_velocity=_peak_velocity(record) if known else None,
    )


def _peak_velocity(record: Accelerogram) -> float | None:
    """Return the largest velocity, m/s, of a record cleared as a study does by default; None when it is too short."""
    try:
        return float(abs(velocity(process(record))).max())
    except RecordError:
        return None


def _doubts(record: Accelerogram, file: str) -> tuple[str, ...]:
    said = _UPWARDS.search(Path(file).stem)
    if said and not record.vertical:
        name = record.component
        return (*record.warnings, f"The file's name says {said[1]}, but {name} is taken as horizontal.")
    return record.warnings


def _together(told: Sequence[tuple[str, tuple[str, ...]]]) -> tuple[str, ...]:
    """Return each sentence once, behind the components that it is of where it is not of all."""
    of: dict[str, list[str]] = {}
    for component, sentences in told:
        for sentence in sentences:
            of.setdefault(sentence, []).append(component)
    return tuple(s if len(names) == len(told) else f"{', '.join(names)}: {s}" for s, names in of.items())


def _note(first: Accelerogram, doubts: tuple[str, ...], to_fill: tuple[str, ...]) -> str:
    fill = f"Fill in {' and '.join(to_fill)}." if to_fill else ""
    told = tuple(s for s in doubts if "m/s" not in s and " g," not in s) if to_fill else doubts
    return " ".join(part for part in (f"{first.source.format}.", fill, *told) if part)


def _row(file: str, channels: Sequence[Accelerogram], declared: Row, taken: set[str]) -> Row:
    first = next(c for c in channels if not c.vertical and not c.borehole)
    return {
        "id": _id(file, taken),
        "file": f"./{file}" if file[0] in _FORMULA else file,
        "event": _no_formula(first.event),
        "station": _no_formula(first.station),
        "sha256": first.source.sha256,
        **declared,
    }


def _no_formula(text: str) -> str:
    """Return `text` without the signs that make a spreadsheet compute what comes after them."""
    return text.lstrip(_FORMULA + " ")


def _id(file: str, taken: set[str]) -> str:
    """Return the file's name as a safe identifier that is not taken yet."""
    base = re.sub(r"\.(at2|txt|csv|asc|dat|acc|gz)$", "", Path(file).name, flags=re.I)
    base = re.sub(r"[^A-Za-z0-9._-]+", "_", base)[:70].strip("._-") or "record"
    base = base if is_safe_id(base) else f"record_{base}"
    name, number = base, 2
    while name.lower() in taken:
        name, number = f"{base}_{number}", number + 1
    return name


_HEAD = ("file", "component", "format", "step s", "samples", "PGA g", "PGV m/s", "status")
_WIDEST = (40, 16, 24, 9, 9, 9, 9, 400)
_RIGHT = range(3, 7)


def listing_text(listed: Sequence[ListedFile]) -> str:
    """Return one line for each channel of each file: format, step, samples, PGA, PGV, component and status."""
    rows = [_HEAD, *(line for file in listed for line in _lines(file))]
    cells = [[_short(text, width) for text, width in zip(row, _WIDEST, strict=True)] for row in rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(_HEAD))]
    return (
        "\n".join("  ".join(_placed(row, i, widths[i]) for i in range(len(_HEAD))).rstrip() for row in cells)
        + "\n"
    )


def _lines(file: ListedFile) -> list[tuple[str, ...]]:
    if not file.channels:
        return [(file.file, "", "", "", "", "", "", file.status)]
    return [
        (file.file if i == 0 else "", *_measures(channel), file.status if i == 0 else "")
        for i, channel in enumerate(file.channels)
    ]


def _measures(channel: ListedChannel) -> tuple[str, ...]:
    peak = channel.peak_acceleration
    return (
        channel.component,
        channel.format,
        _number(channel.time_step),
        str(channel.samples),
        "" if peak is None else f"{peak / GRAVITY:.3g}",
        _number(channel.peak_velocity, "{:.3g}"),
    )


def _number(value: float | None, form: str = "{:g}") -> str:
    return "" if value is None else form.format(value)


def _short(text: str, width: int) -> str:
    return text if len(text) <= width else text[: width - 1] + "…"


def _placed(row: Sequence[str], i: int, width: int) -> str:
    return row[i].rjust(width) if i in _RIGHT else row[i].ljust(width)
