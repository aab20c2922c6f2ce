"""The work of a product over all records: how it is made, and what summary, page to explore and terminal show of it."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from importlib import import_module
from typing import ClassVar

from rocking.reports.pages import Panel
from rocking.study.job import Job
from rocking.study.kept import Kept, Rows
from rocking.study.product import Product
from rocking.tables import Row


class Work(ABC):
    """What a product does. Each method but `make` is given the rows of `shown`, and may say nothing."""

    shown: ClassVar[tuple[type[Row], ...]] = ()
    """The tables that the summary and the verb show something of, with the faults (FailureRow)."""
    sheets: ClassVar[tuple[type[Row], ...]] = ()
    """Those of them that are sheets of study.xlsx."""

    @abstractmethod
    def make(self, job: Job) -> Kept:
        """Write the files of the product into `job.folder`; return its rows, those of faults, conclusion and lines."""

    def panel(self, rows: Rows) -> Panel | None:
        """Return what the summary shows; None for nothing."""
        return None

    def notes(self, rows: Rows) -> Mapping[str, str]:
        """Return a sentence on each structure that it has something to say of, for strips and the page to explore."""
        return {}


def work_of(product: Product) -> Work:
    """Import and return the work of a product."""
    module, _, name = product.work.partition(":")
    made: Work = getattr(import_module(module), name)()
    return made
