"""What every target writes: its tables, and one report of the scores among them."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
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
    scores = [each for each in tables[Score] if isinstance(each, Score)]
    classes = [each for each in scores if each.measure in (STATED, HAPPENED)]
    others = [each for each in scores if each not in classes]
    shown = [*parts, *(_score_table(others, part) for part in dict.fromkeys(each.part for each in others))]
    if classes:
        drawn = picture(reliability_figure(classes), "Share that overturned against the stated probability.")
        shown.append(drawn | {"caption": "Reliability, with 90 % intervals by resampling sites."})
    data = {"title": title, "subtitle": subtitle, "parts": shown}
    write_whole(folder / "report.pdf", compile_document("plain.typ", data))


def _score_table(scores: Sequence[Score], part: str) -> dict[str, object]:
    """A line for each measure and subject of one part of the cases."""
    own = sorted((each for each in scores if each.part == part), key=lambda each: each.measure)
    names = "measure=2 subject=1.6 value value_low value_high cases sites"
    columns = printing.columns_of(Score, names, "0.6")
    caption = f"{printing.sentence(part)}; 90 % intervals by resampling sites."
    return {**printing.table_of(own, *columns), "caption": caption}


@styled
def reliability_figure(classes: Sequence[Score]) -> Figure:
    """Draw the share that overturned against the probability that was stated, a panel for each subject."""
    subjects = list(dict.fromkeys(each.subject for each in classes))
    figure = new_figure(72, margins=(13, 3, 11, 6))
    panels = figure.subplots(1, len(subjects), squeeze=False)[0]
    for panel, subject in zip(panels, subjects, strict=True):
        stated = {
            each.part: each.value for each in classes if (each.subject, each.measure) == (subject, STATED)
        }
        own = [each for each in classes if (each.subject, each.measure) == (subject, HAPPENED)]
        places = [stated[each.part] for each in own]
        shares = np.array([each.value for each in own])
        ends = np.array([(each.value_low, each.value_high) for each in own]).T
        panel.plot([0, 1], [0, 1], color="0.6", linewidth=0.7)
        panel.errorbar(places, shares, np.abs(ends - shares), fmt="o", color="#0072B2", linewidth=0.9)
        for each, place in zip(own, places, strict=True):
            panel.annotate(str(each.cases), (place, each.value), (3, 3), textcoords="offset points")
        panel.set(title=subject, xlabel="stated probability of overturning")
        panel.set(xlim=(-0.04, 1.04), ylim=(-0.09, 1.09), aspect="equal")
    panels[0].set_ylabel("share that overturned")
    return figure
