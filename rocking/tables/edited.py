"""Tables that people edit: CSV in UTF-8, or as a spreadsheet of a country of decimal commas saves it, or XLSX."""

import csv
from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from difflib import get_close_matches
from io import StringIO
from pathlib import Path

from rocking.errors import RockingError, about
from rocking.quantities import shown
from rocking.tables.files import read_start, read_whole
from rocking.tables.sheets import csv_text, is_workbook, sheets

_LARGEST = 16 * 2**20
"""Bytes: a hundred thousand rows."""
_MOST_NAMED = 40
"""Columns that a sentence names, and characters of a name that is compared with them."""


def read_edited(
    path: Path,
    error: type[RockingError],
    columns: Sequence[str],
    required: Collection[str],
    numbers: Collection[str] = (),
) -> list[tuple[int, dict[str, str]]]:
    """Return line and cells of each row of the table at `path`, with `columns`, of which some are `required`.

    Rows without a filled cell, and columns without a name or a filled cell, are passed over. numbers: the columns in
    which a comma can only be a decimal sign. Raises `error` for what is no such table.
    """
    content = read_whole(path, _LARGEST, error)
    if is_workbook(content):
        with about(str(path)), sheets(content, error, "save the sheet as CSV") as rows_of:
            content = csv_text(next(iter(rows_of.values()))).encode()
    separator = _separator(content)
    try:
        text = StringIO(_decoded(content, separator), newline="")
        reader = csv.DictReader(text, restkey="", restval="", strict=True, delimiter=separator)
        rows = [
            (reader.line_num, row) for row in reader if any("".join(cell).strip() for cell in row.values())
        ]
        names = [name for name in reader.fieldnames or () if name]
    except (ValueError, csv.Error) as fault:
        sentence = f"{path}: the {path.stem} cannot be read as UTF-8 CSV, {fault}."
        raise error(sentence, file=path.name) from None
    if names and not set(names) & set(columns):
        raise error(
            f"{path.name}: its first line, which begins with {shown(names[0])}, names no column; write the names of "
            f"the columns above the rows, as in {','.join(required)}.",
            columns=names,
        )
    defects = [_unknown(name, columns) for name in names if name not in columns]
    defects += [f"column {shown(name)} stands {n} times" for name, n in Counter(names).items() if n > 1]
    defects += [f"column {shown(name)} is missing" for name in required if name not in names]
    defects += [
        f"line {line} has more cells than there are columns (a number with a comma?)"
        for line, row in rows
        if "".join(row.get("") or ())
    ]
    if defects:
        allowed = f"; the columns are {', '.join(columns)}" if len(columns) <= _MOST_NAMED else ""
        raise error(f"{path.name}: {'; '.join(defects)}{allowed}.", columns=defects)
    if separator == ";":
        for _, row in rows:
            row |= {name: row[name].replace(",", ".") for name in numbers if row.get(name)}
    return rows


def _unknown(name: str, columns: Sequence[str]) -> str:
    near = get_close_matches(name[:_MOST_NAMED], columns, n=1)
    return f"column {shown(name)} is not known ({f'did you mean {near[0]}?' if near else 'remove it'})"


def _separator(content: bytes) -> str:
    """Return what parts the cells: a comma, or the semicolon of a spreadsheet in a country of decimal commas."""
    head = content.partition(b"\n")[0]
    return ";" if head.count(b";") > head.count(b",") else ","


def _decoded(content: bytes, separator: str) -> str:
    """Return the text: UTF-8, or where semicolons part it Windows' own characters. Raises ValueError for another."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        if separator == ",":
            raise
        return content.decode("cp1252")


def edited_text(
    rows: Iterable[Mapping[str, str]],
    columns: Sequence[str],
    like: Path | None = None,
    numbers: Collection[str] = (),
) -> str:
    """Return `rows` as the text of a table, parted as the one at `like` is, if that stands there."""
    separator = _separator(read_start(like, 4096)) if like is not None and like.exists() else ","
    text = StringIO(newline="")
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n", delimiter=separator)
    writer.writeheader()
    for row in rows:
        decimal = {name: row[name].replace(".", ",") for name in numbers if row.get(name)}
        writer.writerow({**row, **decimal} if separator == ";" else row)
    return text.getvalue()
