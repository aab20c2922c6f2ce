"""What a product of a study is: its files, what it is made from, and the description of one over all records.

It is data, and loads nothing: every command, its help and the plan read it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rocking.study.settings import Settings

KEPT = ".kept"
"""The folder in the results that holds what jobs leave for other products, and for the next run."""
KEPT_ROWS = f"{KEPT}/rows/{{rule}}.json"
"""What summary and terminal show of a rule over all records."""
TOLD = ("study", "client", "project_number", "author", "date", "display_units")
"""The settings that the head of every document prints."""


def draws(settings: "Settings") -> bool:
    """Return whether the figures of a document lie next to it in an archive."""
    return settings.figures != "none"


@dataclass(frozen=True)
class Output:
    """One file of a rule.

    path: from the folder of the results; {record} is the name of a record. when: whether the settings ask for it.
    is_store: whether it serves the next run alone, so that nobody misses it. is_measured: whether it holds measured
    times: alone of all it may differ between two runs of the same input. label, category: its place in the page that
    snakemake --report makes; "" for none.
    """

    path: str
    when: Callable[["Settings"], bool] = lambda _settings: True
    is_store: bool = False
    is_measured: bool = False
    label: str = ""
    category: str = ""


@dataclass(frozen=True)
class Product:
    """What is made of all records of a study besides the summary, which shows it: the description of a work.

    Parameters
    ----------
    name : str
        Of its rule, its log and its verb.
    does : str
        What its job does, in words: the help of the verb, and what snakemake says of the rule.
    work : str
        Module and name of its `rocking.study.work.Work`, which is imported where it works: "module:Name".
    rows : str
        Module of the rows of its tables.
    tables : tuple[str, ...]
        Names of its tables, each of which is a CSV file.
    files : tuple[str, ...]
        Names of the files besides these.
    settings : tuple[str, ...]
        Settings, sections of settings and section.name that it is made from, besides those that change a number.
    pool : str
        The one that names another catalogue, the records of which it reads; "" for none.
    in_every_run : Callable[[Settings], bool]
        Whether every run of a study makes it, rather than its verb alone.
    folder : str
        In the results, where its files lie.
    opens_records : bool
        Whether it reads the files of the records.
    after_records : bool
        Whether it is made from the outcomes of the records.
    is_measured : bool
        Whether its files hold measured times.
    refusal : Callable[[Settings], str]
        Why these settings cannot make it, in a sentence; "" where they can.
    stays : bool
        Whether its files stay where no run of the study makes it, as what its verb has made does.
    """

    name: str
    does: str
    work: str
    rows: str
    tables: tuple[str, ...]
    files: tuple[str, ...]
    settings: tuple[str, ...]
    in_every_run: Callable[["Settings"], bool]
    pool: str = ""
    folder: str = "summary"
    opens_records: bool = False
    after_records: bool = False
    is_measured: bool = False
    refusal: Callable[["Settings"], str] = lambda _settings: ""
    stays: bool = False

    @property
    def outputs(self) -> tuple[Output, ...]:
        """All that its job writes: its files, the figures of its documents where they are asked for, and its rows."""
        names = (*(f"{table}.csv" for table in self.tables), *self.files)
        figures = (name.replace(".pdf", "_figures.zip") for name in self.files if name.endswith(".pdf"))
        return (
            *(Output(f"{self.folder}/{name}", is_measured=self.is_measured) for name in names),
            *(Output(f"{self.folder}/{name}", draws) for name in figures),
            Output(KEPT_ROWS.format(rule=self.name)),
        )
