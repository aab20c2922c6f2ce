"""What every target writes: its tables, and one report of the scores among them."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pandas as pd
from matplotlib.figure import Figure

from docs.research.scores import HAPPENED, STATED, Score
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.style import new_figure, picture, styled
from rocking.tables import Row, write_tables, write_whole


def publish(
    folder: Path,
    title: str,
    subtitle: str,
    tables: Mapping[type[Row], Sequence[Row]],
    parts: Sequence[Mapping[str, object]] = (),
) -> None:
    """Write `tables`, datapackage.json and report.pdf into `folder`. parts: what plain.typ sets before the scores."""
    write_tables(tables, folder, f"rocking-{folder.name}")
    table = pd.DataFrame(tables[Score])
    is_class = table.measure.isin((STATED, HAPPENED))
    shown = [*parts, *(_score_table(part, own) for part, own in table[~is_class].groupby("part", sort=False))]
    if is_class.any():
        drawn = picture(
            reliability_figure(table[is_class]), "Overturning share against the stated probability."
        )
        shown.append(drawn | {"caption": "Reliability, with 90 % intervals by resampling sites."})
    data = {"title": title, "subtitle": subtitle, "parts": shown}
    write_whole(folder / "report.pdf", compile_document("plain.typ", data))


def _score_table(part: str, own: pd.DataFrame) -> dict[str, object]:
    """A line for each measure and subject of one part of the cases."""
    rows = [Score(**each) for each in own.sort_values("measure", kind="stable").to_dict("records")]
    names = "measure=2 subject=1.6 value value_low value_high cases sites"
    columns = printing.columns_of(Score, names, "0.6")
    caption = f"{printing.sentence(part)}; 90 % intervals by resampling sites."
    return {**printing.table_of(rows, *columns), "caption": caption}


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
