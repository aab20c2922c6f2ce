"""The matrix of a summary: what becomes of each structure under each record, in words on their colours."""

import math
from collections.abc import Sequence
from dataclasses import replace

from rocking.assessment.conclusion import UNSAID, Conclusion, worst_of_each
from rocking.assessment.decide import ORDER, Verdict, worst_first
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.rows import PulseRow, RecordRow
from rocking.quantities import GRAVITY, listed, percents
from rocking.reports.pages import Chip, Matrix, MatrixHead, MatrixRow
from rocking.reports.printing import NOTHING, chip, number

MOST_RECORDS = 12
"""Records next to each other; of more the map has a line each."""
MOST_STRUCTURES = 20
"""Structures below each other, the worst first; verdicts.csv holds all."""
MOST_IN_WORDS = 2
"""Records up to which a cell has room for its verdict and a range; of more it holds the share alone on the colour of
the verdict, with a legend."""
MOST_WITH_ALL = 5
"""Records up to which a page has room for their peaks, for what there is to know of each structure, and for the cells
of what (probably) stands or cannot be told, which beyond it the colour and the hatch say alone."""
_UNSAID = (AssessmentKind.STRENGTHEN, *UNSAID)
"""Warnings that the verdict itself says."""


def matrix(made: Sequence[Conclusion], records: Sequence[RecordRow], pulses: Sequence[PulseRow]) -> Matrix:
    """Return heads and rows: a column for each record, a row for each structure, both the worst first.

    Without rows where there are more records than stand next to each other. made: the conclusions on all. The legend is
    empty where the cells hold their words.
    """
    every = worst_first((conclusion.row.record, conclusion.severity) for conclusion in made)
    turned = {conclusion.row.record for conclusion in made if conclusion.row.rotation_ratio != 0}
    columns = [record for record in every if record in turned] or every
    still = [record for record in every if record not in columns]
    by_pair = {(conclusion.row.record, conclusion.row.structure): conclusion for conclusion in made}
    worst = {conclusion.row.structure: conclusion for conclusion in worst_of_each(made)}
    names = worst_first((conclusion.row.structure, conclusion.severity) for conclusion in made)
    if not 0 < len(every) <= MOST_RECORDS:
        return Matrix()
    shown = names[:MOST_STRUCTURES]
    has_room = len(columns) <= MOST_WITH_ALL
    in_words = len(columns) <= MOST_IN_WORDS
    present = {by_pair[pair].row.decision.verdict for pair in by_pair if pair[1] in shown}
    return Matrix(
        legend=() if in_words else tuple(chip(verdict) for verdict in ORDER if verdict in present),
        upright=not has_room,
        heads=tuple(
            MatrixHead(name=name, below=_head(name, records, pulses, in_words) if has_room else "")
            for name in columns
        ),
        rows=tuple(
            MatrixRow(
                name,
                tuple(_cell(by_pair.get((record, name)), len(columns)) for record in columns),
                _warning(worst[name]) if has_room else "",
            )
            for name in shown
        ),
        note=" ".join(filter(None, _note(in_words, len(names) - len(shown), still))),
    )


def _note(in_words: bool, more: int, still: Sequence[str]) -> tuple[str, ...]:
    """What the cells mean, how many structures have no row, and which records no column, for nothing lifts there."""
    share = "Share: the largest that overturns, of members or stacks." if in_words else ""
    return (
        share,
        "Range: cracks disagree.",
        f"Another {more} in verdicts.csv." if more > 0 else "",
        f"Nothing lifts under {listed(still)}." if still else "",
    )


def _head(record: str, records: Sequence[RecordRow], pulses: Sequence[PulseRow], in_words: bool) -> str:
    """The peak of a record, and where there is room the share of the energy in its sine: "0.99 g; sine 11–13 %"."""
    peaks = [row.peak_acceleration_m_s2 for row in records if row.record == record]
    energy = sorted(row.explained_energy for row in pulses if row.record == record and row.is_dominant)
    text = f"{number(max(peaks, default=math.nan) / GRAVITY, 2)} g"
    if energy and in_words:
        text += f"; sine {percents(*energy)}"
    return text


def _cell(conclusion: Conclusion | None, records: int) -> Chip:
    if conclusion is None:
        return Chip(verdict="", share="", fill="#ffffff", ink="#000000", hatched=False)
    decision = conclusion.row.decision
    unknown = decision.verdict is Verdict.CANNOT_BE_TOLD
    if records > MOST_IN_WORDS:
        share = decision.share_in_a_cell.removesuffix("\u00a0%").replace("≥ ", "≥")
        if records > MOST_WITH_ALL and decision.verdict.badness <= Verdict.PROBABLY_STANDS.badness:
            share = ""
        elif not share and records <= MOST_WITH_ALL:
            share = "?" if unknown else NOTHING
        return replace(chip(decision.verdict, share), verdict="")
    return chip(decision.verdict, "" if unknown else decision.share_in_words)


def _warning(conclusion: Conclusion) -> str:
    warning = conclusion.warning
    return "" if warning.kind in _UNSAID else warning.brief
