"""Documents over all records: where one cannot be made, a page says why instead, and every table is written."""

from collections.abc import Callable
from html import escape
from pathlib import Path
from traceback import print_exception

from rocking.assessment.rows import FailureRow
from rocking.errors import fault_in_words
from rocking.reports.pages import PlainPage, Section
from rocking.reports.printing import Figures, write_document
from rocking.reports.style import new_figure, svg
from rocking.tables import write_whole
from rocking.tables.workbook import workbook


def made_or_failed(
    path: Path,
    make: Callable[[], object],
    log: Path | str,
    figures: Figures = "none",
    record: str = "",
    image: Path | None = None,
) -> list[FailureRow]:
    """Let `make` write the document `path`; where it cannot, write a page there that says why, and return its row.

    log: what holds the traceback. record: that the document is about; "" for all. image: the figure of the document,
    which is then an empty one. What is wrong with the machine passes.
    """
    try:
        make()
        return []
    except (OSError, MemoryError):
        raise
    except Exception as fault:
        print_exception(fault)
        sentence = fault_in_words(fault, log, path.name)
        for file in filter(None, (path, image)):
            write_reason(file, [sentence], figures)
        return [FailureRow(record=record, stage="document", message=sentence)]


def write_reason(path: Path, sentences: list[str], figures: Figures = "none") -> None:
    """Write a document that holds nothing but why it could not be made."""
    if path.suffix == ".html":
        items = "".join(f"<p>{escape(sentence)}</p>" for sentence in sentences)
        write_whole(path, f"<!DOCTYPE html><title>{escape(path.stem)}</title>{items}\n".encode())
    elif path.suffix == ".svg":
        write_whole(path, svg(new_figure(20)).encode())
    elif path.suffix == ".xlsx":
        rows = [FailureRow(stage="document", message=sentence) for sentence in sentences]
        write_whole(path, workbook({FailureRow: rows}))
    else:
        parts = (Section(sentences=tuple(sentences)),)
        title = path.stem.capitalize()
        page = PlainPage(title=title, subtitle="It could not be made.", parts=parts)
        write_document(path, page, figures)
