"""A catalogue from a folder of files: every one that reads becomes a row, every other is named with the reason."""

import csv
import re
from io import StringIO
from pathlib import Path

from rocking.errors import RecordError, UndeclaredError
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue_record import COLUMNS, stays_inside
from rocking.records.read import bytes_of, read

Row = dict[str, str]


def catalogue_from_folder(
    folder: str | Path, *, unit: str | None = None, time_step: float | None = None
) -> tuple[list[Row], list[tuple[str, str]]]:
    """Return (rows, unread): a catalogue row for each file under `folder` that reads, (file, reason) for others.

    unit and time_step [s] are used only where a file does not declare them. Catalogues, and files whose name
    starts with a dot, are passed over. Paths are relative to `folder`: the catalogue belongs there, or `folder`
    serves as its mirror. Raises RecordError when `folder` is no folder.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise RecordError(f"{folder}: this is no folder; give the folder that holds the records.")
    rows: list[Row] = []
    unread: list[tuple[str, str]] = []
    for path in sorted(p for p in folder.rglob("*") if p.is_file() and not _passed_over(p)):
        file = path.relative_to(folder).as_posix()
        try:
            channels, declared = _read(path, unit, time_step)
        except RecordError as error:
            unread.append((file, str(error)))
            continue
        if not stays_inside(file):
            unread.append((file, "its name holds a character that a catalogue does not allow; rename it."))
            continue
        if not any(not c.vertical and not c.borehole for c in channels):
            unread.append((file, "it holds no horizontal component at the surface."))
            continue
        rows.append(_row(file, channels, declared, {row["id"].lower() for row in rows}))
    return rows, unread


def _passed_over(path: Path) -> bool:
    is_table = path.suffix.lower() == ".csv" and path.stat().st_size > 0
    return path.name.startswith(".") or (is_table and bytes_of(path).startswith(b"id,file,"))


def write_catalogue_rows(rows: list[Row]) -> str:
    """Return `rows` as the text of a catalogue."""
    text = StringIO(newline="")
    writer = csv.DictWriter(text, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _read(path: Path, unit: str | None, time_step: float | None) -> tuple[list[Accelerogram], Row]:
    """Return (channels, the cells that had to be declared), declaring no more than the file leaves out."""
    offers: tuple[dict, ...] = (
        {},
        {"unit": unit},
        {"time_step": time_step},
        {"unit": unit, "time_step": time_step},
    )
    for offer in offers[:-1]:
        try:
            return read(path, **offer), _cells(offer)
        except UndeclaredError:
            continue
    return read(path, **offers[-1]), _cells(offers[-1])


def _cells(offer: dict) -> Row:
    names = {"unit": "unit", "time_step": "time_step_s"}
    return {names[key]: f"{value}" for key, value in offer.items() if value is not None}


def _row(file: str, channels: list[Accelerogram], declared: Row, taken: set[str]) -> Row:
    first = next(c for c in channels if not c.vertical and not c.borehole)
    return {
        "id": _id(file, taken),
        "file": file,
        "event": first.event,
        "station": first.station,
        "sha256": first.source.sha256,
        "note": " ".join((f"{first.source.format}.", *first.warnings)),
        **declared,
    }


def _id(file: str, taken: set[str]) -> str:
    """Return the file's name as a safe identifier that is not taken yet."""
    base = re.sub(r"[^A-Za-z0-9._-]+", "_", Path(file).name).strip("._-")[:70] or "record"
    base = re.sub(r"\.(at2|txt|csv|asc|dat|acc|gz)$", "", base, flags=re.I) or "record"
    name, number = base, 2
    while name.lower() in taken:
        name, number = f"{base}_{number}", number + 1
    return name
