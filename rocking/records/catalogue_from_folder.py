"""A catalogue from a folder of files: every one that reads becomes a row, every other is named with the reason.

`python -m rocking.records.catalogue_from_folder FOLDER CATALOGUE.csv [--unit g] [--time-step 0.01]`
"""

import argparse
import csv
import re
import sys
from pathlib import Path

from rocking.errors import RecordError, UndeclaredError
from rocking.records.accelerogram import Accelerogram
from rocking.records.catalogue import COLUMNS
from rocking.records.read import read

Row = dict[str, str]


def catalogue_from_folder(
    folder: str | Path, *, unit: str | None = None, time_step: float | None = None
) -> tuple[list[Row], list[tuple[str, str]]]:
    """Return (rows, unread): a catalogue row for each file under `folder` that reads, (file, reason) for others.

    unit and time_step [s] are used only where a file does not declare them. Files whose name starts with a dot are
    passed over. Paths are relative to `folder`: the catalogue belongs there, or `folder` serves as its mirror.
    Raises RecordError when `folder` is no folder.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise RecordError(f"{folder}: this is no folder; give the folder that holds the records.")
    rows: list[Row] = []
    unread: list[tuple[str, str]] = []
    for path in sorted(p for p in folder.rglob("*") if p.is_file() and not p.name.startswith(".")):
        file = path.relative_to(folder).as_posix()
        try:
            channels, declared = _read(path, unit, time_step)
        except RecordError as error:
            unread.append((file, str(error)))
            continue
        if not any(not c.vertical and not c.borehole for c in channels):
            unread.append((file, "it holds no horizontal component at the surface."))
            continue
        rows.append(_row(file, channels, declared, {row["id"].lower() for row in rows}))
    return rows, unread


def write_catalogue(rows: list[Row], path: str | Path) -> None:
    """Write `rows` as a catalogue, by way of a temporary file so that nothing half-written is left."""
    path = Path(path)
    temporary = path.with_name(path.name + ".part")
    with temporary.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    temporary.replace(path)


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


def main(arguments: list[str] | None = None) -> int:
    """Write the catalogue and name on stderr what could not be read; 0 if at least one record stands in it."""
    parser = argparse.ArgumentParser(
        prog="python -m rocking.records.catalogue_from_folder", description=__doc__
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("catalogue", type=Path)
    parser.add_argument("--unit", help="unit of files that declare none")
    parser.add_argument("--time-step", type=float, help="time step in s of files that declare none")
    given = parser.parse_args(arguments)
    rows, unread = catalogue_from_folder(given.folder, unit=given.unit, time_step=given.time_step)
    for file, reason in unread:
        print(f"not read: {file}: {reason}", file=sys.stderr)
    print(f"{len(rows)} records written, {len(unread)} files not read.", file=sys.stderr)
    if rows:
        write_catalogue(rows, given.catalogue)
    return 0 if rows else 1


if __name__ == "__main__":
    raise SystemExit(main())
