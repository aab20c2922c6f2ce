"""The outcome of the records of a run, in the lines that a terminal shows."""

import math
from collections.abc import Iterable, Iterator, Sequence
from textwrap import wrap

from rocking.assessment.conclusion import (
    Conclusion,
    conclusion_in_words,
    conclusions,
    fallen_in_one_run,
    falls_in_words,
    falls_seen_in_words,
    to_check,
    worst_of_each,
)
from rocking.assessment.decide import Verdict
from rocking.assessment.methods import rocks
from rocking.assessment.rows import (
    AgreementRow,
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    VerdictRow,
    WarningRow,
)
from rocking.assessment.scene import placed
from rocking.quantities import counted, listed

_WORST = 5
"""Structures of the table at the end."""
_NAMED = 8
"""Names of a list; a line is to be read at a glance."""
WIDTH = 104
"""Characters of a line at the end."""


def verdicts_in_words(verdicts: Iterable[VerdictRow]) -> str:
    """Say what becomes of each structure under its worst record: "overturns: pier (100 %); stands: arch 0.31".

    The numbers are the shares that overturn, or of a structure that stands the largest rotation over the critical
    one. At most _NAMED structures are named, the worst first.
    """
    return _in_words(worst_of_each(conclusions(verdicts, [])), _NAMED)


def _in_words(worst: Sequence[Conclusion], most: int) -> str:
    """Name the worst `most` structures by verdict; the others are counted."""
    by_verdict: dict[Verdict, list[str]] = {}
    for conclusion in worst[:most]:
        row = conclusion.row
        share = row.decision.share_in_words
        number = f" ({share})" if share else ""
        if row.decision.verdict.stays_up:
            number = f" {row.rotation_ratio:.2g}" if rocks(row.rotation_ratio) else ""
        name = placed(row.structure, row.support_period_s)
        if "," in name or ";" in name:
            name = f'"{name}"'  # else one structure reads as two
        by_verdict.setdefault(row.decision.verdict, []).append(name + number)
    texts = [f"{verdict}: {', '.join(names)}" for verdict, names in by_verdict.items()]
    if (more := len(worst) - most) > 0:
        texts.append(f"{counted(more, 'structure')} more in {VerdictRow.table.file_name}")
    return "; ".join(texts)


def record_line(verdicts: Iterable[VerdictRow], failures: Iterable[FailureRow]) -> str:
    """Say in one line what came of a record; what could not be assessed comes first."""
    reasons = [": ".join(filter(None, (failure.structure, failure.message))) for failure in failures]
    failed = f"failed: {' '.join(dict.fromkeys(reasons))}" if reasons else ""
    return "; ".join(filter(None, (failed, verdicts_in_words(verdicts))))


def closing_lines(
    verdicts: Sequence[VerdictRow],
    comparison: Sequence[ComparisonRow],
    failures: Sequence[FailureRow],
    expected: Sequence[ExpectedFallsRow] = (),
    warnings: Iterable[WarningRow] = (),
    agreed: Sequence[AgreementRow] = (),
) -> Iterator[str]:
    """Yield the conclusion on all structures and the worst of them by every method, what failed, and what has to be
    checked of what was typed.

    expected: how many fall, by record and of all. warnings: on the study and on its records. agreed: the counts of the
    closed form against the integration, of all first.
    """
    worst = worst_of_each(conclusions(verdicts, comparison))
    records = len({verdict.record for verdict in verdicts})  # one that failed gives none
    if worst:
        words = {conclusion.row.structure: conclusion.row.decision.verdict for conclusion in worst}
        of_all = conclusion_in_words(words, records, fallen_in_one_run(worst))
        count = f"{counted(records, 'record')}, {counted(len(worst), 'structure')}"
        for sentence in (f"{count}. {of_all}", falls_in_words(expected)):
            yield from wrapped(sentence)
        yield from _by_every_method(worst[:_WORST])
        if others := _in_words(worst[_WORST:], _NAMED - _WORST):
            yield from wrapped(f"Others  {others}")
    if agreed and agreed[0].overturning:
        false = counted(agreed[0].overturning_false_alarms, "false alarm")
        yield from wrapped(f"The closed form {falls_seen_in_words(agreed)}; {false}.")
    yield from failing_lines(failures)
    for sentence in to_check(warnings):
        yield from wrapped(sentence)


def _by_every_method(worst: Sequence[Conclusion]) -> Iterator[str]:
    """Yield a table of structures under their worst records: closed form, block, integration, reserve and verdict."""
    yield "Rotation over critical rotation of the worst structures, each under its worst record; the first by"
    yield "verdict, share, then reserve (5 and 50 % overturn at × the record):"
    yield f"{'':<16}  {'record':<18}  closed  block  integrated     reserve  verdict, share"
    for conclusion in worst:
        row = conclusion.row
        closed, block, integrated = map(_rotation, conclusion.ratios)
        reserve = row.reserve.in_figures if row.reserve else "–"
        names = f"{_cut(row.structure, 16):<16}  {_cut(row.record, 18):<18}"
        numbers = f"{closed:>6}  {block:>5}  {integrated:>10}  {reserve:>10}"
        yield f"{names}  {numbers}  {row.decision.verdict} {row.decision.share_in_words}".rstrip()


def _rotation(ratio: float) -> str:
    """A rotation ratio in a column: "0.44", "falls", or a dash."""
    return "–" if math.isnan(ratio) else "falls" if ratio == math.inf else f"{ratio:.2f}"


def _cut(name: str, width: int) -> str:
    """The name, with an ellipsis where it is longer than `width`."""
    return name if len(name) <= width else f"{name[: width - 1]}…"


def failing_lines(failures: Sequence[FailureRow]) -> Iterator[str]:
    """The records that failed, with the first reason, and the sentences on structures that did over all records."""
    sentences = dict.fromkeys(
        f"{failure.structure}: {failure.message}" for failure in failures if not failure.record
    )
    for sentence in list(sentences)[:_NAMED]:
        yield from wrapped(sentence.removeprefix(": "))
    if of_records := [failure for failure in failures if failure.record]:
        failed = sorted({failure.record for failure in of_records})
        count = f"{counted(len(failed), 'record')} failed, wholly or in part: {listed(failed, _NAMED)}"
        yield from wrapped(f"{count}; the first: {of_records[0].message}")


def wrapped(sentence: str) -> list[str]:
    """Return the lines of a sentence; none where it says nothing."""
    return wrap(sentence, WIDTH, subsequent_indent=" " * 8)
