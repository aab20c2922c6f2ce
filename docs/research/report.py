"""What every target is given, and what it writes: its tables, and one report of the scores among them."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import TypeVar

import pandas as pd
from matplotlib.figure import Figure

from docs.research.scores import HAPPENED, STATED, Score
from docs.research.sites import NamedRecord, Records
from rocking.reports import printing
from rocking.reports.pages import PlainPage, Section
from rocking.reports.printing import compile_document
from rocking.reports.style import new_figure, picture, styled
from rocking.structures import Structure
from rocking.tables import Row, read_rows, write_rows, write_tables, write_whole

R = TypeVar("R", bound=Row)
Tables = Mapping[type[Row], Sequence[Row]]
"""The rows of each table that a target writes."""


@dataclass(frozen=True)
class Target:
    """What a target is given: the records of each catalogue, structures by name, and where its results go.

    tell: is given a line of progress.
    """

    folder: Path
    tell: Callable[[str], None]
    catalogues: Sequence[Records] = ()
    structures: Mapping[str, Structure] = field(default_factory=dict)

    @property
    def records(self) -> Iterator[NamedRecord]:
        """The records of all catalogues, one catalogue after the other."""
        return chain.from_iterable(self.catalogues)

    def kept(self, row_class: type[R], name: str, trials: Iterable[R]) -> list[R]:
        """Return the rows of a file in the folder, which is written of `trials` where an earlier run left none."""
        path = self.folder / "trials" / f"{name}.csv"
        if not path.is_file():
            write_rows(row_class, trials, path)
        return list(read_rows(row_class, path))

    def publish(self, title: str, subtitle: str, tables: Tables, text: str = "") -> None:
        """Write `tables`, datapackage.json and report.pdf into the folder. text: stands before the scores."""
        write_tables(tables, self.folder, f"rocking-{self.folder.name}")
        scores = pd.DataFrame(tables[Score])
        is_class = scores.measure.isin((STATED, HAPPENED))
        parts = [Section(text=text)] if text else []
        for part, own in scores[~is_class].groupby("part", sort=False):
            rows = [Score(**row) for row in own.sort_values("measure", kind="stable").to_dict("records")]
            columns = printing.columns_of(
                Score, "measure=2 subject=1.6 value value_low value_high sites earthquakes cases", "0.6"
            )
            caption = f"{printing.sentence(str(part))}; 90 % intervals by resampling earthquakes."
            parts.append(Section(table=printing.table_of(rows, *columns), caption=caption))
        if is_class.any():
            drawn = picture(
                reliability_figure(scores[is_class]), "Overturning share against the stated probability."
            )
            caption = "Reliability, with 90 % intervals by resampling earthquakes."
            parts.append(Section(pictures=(drawn,), caption=caption))
        page = PlainPage(title=title, subtitle=subtitle, parts=tuple(parts))
        write_whole(self.folder / "report.pdf", compile_document(page))


@styled
def reliability_figure(classes: pd.DataFrame) -> Figure:
    """Draw the share that overturned against the probability that was stated, a panel for each subject."""
    subjects = classes.groupby("subject", sort=False)
    figure = new_figure(72, margins=(13, 3, 11, 6))
    panels = figure.subplots(1, len(subjects), squeeze=False)[0]
    for panel, (subject, own) in zip(panels, subjects, strict=True):
        stated, shares = (own[own.measure == measure].set_index("part") for measure in (STATED, HAPPENED))
        ends = shares.value - shares.value_low, shares.value_high - shares.value
        panel.plot([0, 1], [0, 1], color="0.6", linewidth=0.7)
        panel.errorbar(stated.value, shares.value, ends, fmt="o", color="#0072B2", linewidth=0.9)
        for cases, *place in zip(shares.cases, stated.value, shares.value, strict=True):
            panel.annotate(str(cases), place, (3, 3), textcoords="offset points")
        panel.set(title=subject, xlabel="stated probability of overturning")
        panel.set(xlim=(-0.04, 1.04), ylim=(-0.09, 1.09), aspect="equal")
    panels[0].set_ylabel("share that overturned")
    return figure
