"""The sheets of a workbook that people edit (XLSX), and one of them as the text of a table."""

import csv
import io
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from rocking.errors import RockingError

_PARTS = "xl/workbook.xml"
_LARGEST_PART = 64 * 2**20
"""Bytes of a part of a workbook, unpacked."""


def is_workbook(raw: bytes) -> bool:
    """Whether `raw` is a workbook as spreadsheets have written it since 2007 (.xlsx)."""
    try:
        return raw.startswith(b"PK\x03\x04") and _PARTS in zipfile.ZipFile(io.BytesIO(raw)).namelist()
    except (zipfile.BadZipFile, ValueError, NotImplementedError):
        return False


@contextmanager
def sheets(
    raw: bytes, error: type[RockingError], advice: str
) -> Iterator[dict[str, Iterator[Sequence[Any]]]]:
    """Give the rows of cells of each sheet of a workbook, by its title.

    Raises `error`, also for what is read within, where it is damaged or unpacks to too much; advice: what to do.
    """
    from openpyxl import load_workbook  # which a workbook alone needs

    try:
        parts = zipfile.ZipFile(io.BytesIO(raw)).infolist()
        if max(part.file_size for part in parts) > _LARGEST_PART:
            raise error(
                f"a part of the workbook unpacks to more than {_LARGEST_PART} bytes; {advice}.",
                size=_LARGEST_PART,
            )
        book = load_workbook(io.BytesIO(raw), read_only=True, data_only=True)
        yield {sheet.title: sheet.iter_rows(values_only=True) for sheet in book.worksheets}
    except RockingError:
        raise
    except Exception as fault:  # zipfile and openpyxl raise what they like for what is damaged
        raise error(
            f"the workbook cannot be read, {type(fault).__name__}; {advice}.", format="workbook"
        ) from fault


def csv_text(rows: Iterable[Sequence[Any]]) -> str:
    """Return rows of cells as CSV, empty cells and numbers as they are."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(
        ["" if cell is None else cell for cell in row] for row in rows
    )
    return text.getvalue()
