"""The work of a product over all records: how it is made, and what summary, page to explore and terminal show of it."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import ClassVar

from rocking.assessment.rows import FailureRow
from rocking.reports.pages import Panel
from rocking.reports.printing import Figures, faults_in_words
from rocking.reports.style import new_figure, svg
from rocking.study.documents import write_reason
from rocking.study.job import Job, costs_no_other
from rocking.study.kept import Kept, Rows
from rocking.study.product import Product
from rocking.tables import Row, write_whole


class Work(ABC):
    """What a product does. Each method but `make` is given the rows of `shown`, and may say nothing."""

    shown: ClassVar[tuple[type[Row], ...]] = ()
    """The tables that the summary and the verb show something of, with the faults (FailureRow)."""
    sheets: ClassVar[tuple[type[Row], ...]] = ()
    """Those of them that are sheets of study.xlsx."""

    @abstractmethod
    def make(self, job: Job) -> Kept:
        """Write the files of the product into `job.folder`; return its rows, those of faults and its conclusion."""

    def panel(self, rows: Rows) -> Panel | None:
        """Return what the summary shows; None for nothing."""
        return None

    def notes(self, rows: Rows) -> Mapping[str, str]:
        """Return a sentence on each structure that it has something to say of, for strips and the page to explore."""
        return {}

    def lines(self, rows: Rows) -> Iterator[str]:
        """Yield the lines of the terminal after its verb, without the conclusion."""
        yield from ()


def work_of(product: Product) -> Work:
    """Import and return the work of a product."""
    module, _, name = product.work.partition(":")
    made: Work = getattr(import_module(module), name)()
    return made


def write_documents(
    write: Callable[[Path, Path, Figures], None] | None, pdf: Path, image: Path, job: Job, faults: list[Row]
) -> None:
    """Let `write` set a document over all records as the files `pdf` and `image` (SVG).

    None has nothing to show. In both that case and that of a fault, of which `faults` gets a row, the page says why.
    """
    figures = job.study.settings.figures
    if write:
        with costs_no_other(faults, job.log, pdf.name):
            write(pdf, image, figures)
            return
    write_reason(pdf, faults_in_words({FailureRow: faults}), figures)
    write_whole(image, svg(new_figure(20)).encode())
