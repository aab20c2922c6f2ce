"""Hashes of rows added by hand: filled in at the first reading, checked from then on."""

import csv
from collections.abc import Iterable
from dataclasses import replace
from io import StringIO
from pathlib import Path

from rocking.errors import RecordError
from rocking.records.catalogue import load_catalogue
from rocking.records.catalogue_record import CatalogueRecord
from rocking.records.fetch import fetch
from rocking.records.read import hash_of
from rocking.tables import write_whole


def fill_hashes(path: str | Path, mirror: str | Path | None = None) -> tuple[str, ...]:
    """Write the sha256 of each file into the rows of the catalogue at `path` that leave it blank; return their ids.

    A row whose file is not there stays blank: opening it says so. The other cells stay as they are, and nothing is
    written when nothing is to be filled. Raises CatalogueError for a catalogue with defects.
    """
    path = Path(path)
    found = {record.id: cells for record in load_catalogue(path) if (cells := _blanks(record, mirror))}
    if not found:
        return ()
    with path.open(encoding="utf-8-sig", newline="") as stream:
        reader = csv.DictReader(stream)
        rows = list(reader)
    names = list(reader.fieldnames or ())
    names += [name for name in ("sha256", "vertical_sha256") if name not in names and _has(found, name)]
    text = StringIO(newline="")
    writer = csv.DictWriter(text, names, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(row | found.get(row["id"].strip(), {}) for row in rows)
    write_whole(path, text.getvalue().encode())
    return tuple(found)


def filled(record: CatalogueRecord, mirror: str | Path | None = None) -> CatalogueRecord:
    """Return `record` as it stands in the catalogue once fill_hashes has been there."""
    cells = _blanks(record, mirror)
    return replace(
        record,
        sha256=cells.get("sha256", record.sha256),
        vertical_sha256=cells.get("vertical_sha256", record.vertical_sha256),
    )


def repeated(records: Iterable[CatalogueRecord]) -> tuple[str, ...]:
    """Return a sentence for each record that is an earlier one again: one content and scale, a component in common."""
    sentences: list[str] = []
    known: dict[tuple[str, float], list[CatalogueRecord]] = {}
    for record in records:
        if not record.sha256:
            continue
        same = known.setdefault((record.sha256, record.scale_factor), [])
        if earlier := next((other for other in same if _overlap(record, other)), None):
            sentences.append(
                f"{record.id} ({record.file}): its content is that of {earlier.id} ({earlier.file}), "
                "so that one motion counts twice; leave one of them out."
            )
        same.append(record)
    return tuple(sentences)


def _overlap(one: CatalogueRecord, other: CatalogueRecord) -> bool:
    """Whether two rows of the same content take a component in common; a row that names none takes all."""
    chosen = set(one.components), set(other.components)
    return not all(chosen) or bool(chosen[0] & chosen[1])


def _has(found: dict[str, dict[str, str]], name: str) -> bool:
    return any(name in cells for cells in found.values())


def _blanks(record: CatalogueRecord, mirror: str | Path | None) -> dict[str, str]:
    """Return the blank hashes of a row by their columns, as far as the files are there."""
    wanted = {}
    if not record.sha256:
        wanted["sha256"] = record
    if record.vertical_file and not record.vertical_sha256:
        wanted["vertical_sha256"] = record.of_vertical
    cells = {}
    for column, of in wanted.items():
        try:
            cells[column] = hash_of(fetch(of, mirror))
        except RecordError:
            continue
    return cells
