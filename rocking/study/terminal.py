"""The outcome of the records of a run, in the lines that a terminal shows."""

import math
from collections import Counter
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from rocking.assessment.conclusion import (
    conclusion_in_words,
    conclusions,
    fallen_in_one_run,
    falls_in_words,
    to_check,
    worst_of_each,
)
from rocking.assessment.decide import ORDER, Verdict, worst_first
from rocking.assessment.methods import rocks
from rocking.assessment.rows import (
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    VerdictRow,
    WarningRow,
    counted_cases,
    worst_period_each,
)
from rocking.errors import RecordError
from rocking.quantities import counted, listed
from rocking.tables import read_table

if TYPE_CHECKING:  # else planning a study would load numba
    from rocking.assessment.case import SceneResult

_WORST = 5
"""Structures of the table at the end."""
COUNTED = ", a structure on a support at the period of its verdict"
"""Which cases of it are counted; see `counted_cases`."""
_NAMED = 8
"""Names of a list; a line is to be read at a glance."""
NO_BREAK = "\u00a0"
WIDTH = 104
"""Characters of a line at the end."""


def record_line(scenes: Iterable["SceneResult"], failures: Iterable[FailureRow]) -> str:
    """Say in one line what came of a record: "overturns: pier (100 %); uncertain: wall (19 %); stands: arch 0.31".

    The numbers are the shares that overturn, or of what stands the largest rotation over the critical one of the worst
    component. What could not be assessed comes first. Structures on supports stand at the end in a sentence each. At
    most _NAMED are named, the worst first.
    """
    reasons = (
        (f"{failure.structure}: " if failure.structure else "") + failure.message for failure in failures
    )
    parts: dict[Verdict, list[str]] = {verdict: [] for verdict in ORDER}
    scenes = sorted(scenes, key=lambda scene: scene.worst.severity, reverse=True)
    on_the_ground = [scene.worst for scene in scenes if not scene.scene.place.supports]
    for result in on_the_ground:
        decision = result.decision
        share = decision.share_in_words
        number = f" ({share})" if share else ""
        if decision.verdict.stays_up:
            number = f" {result.rotation_ratio:.2g}" if rocks(result.rotation_ratio) else ""
        divided = "," in result.structure or ";" in result.structure
        name = f'"{result.structure}"' if divided else result.structure
        parts[decision.verdict].append(name + number)
    named = {"failed": " ".join(reasons)} | _named(parts, _NAMED)
    lines = [f"{verdict}: {text}" for verdict, text in named.items() if text]
    left = max(0, _NAMED - len(on_the_ground))
    carried = [scene.sentence for scene in scenes if scene.scene.place.supports]
    if len(carried) > left:
        more = counted(len(carried) - left, "structure")
        carried[left:] = [f"{more}{' more' if left else ''} on supports, in {VerdictRow.table.file_name}"]
    return "; ".join([*lines, *carried])


def closing_lines(
    verdicts: Sequence[VerdictRow],
    comparison: Iterable[ComparisonRow],
    failures: Sequence[FailureRow],
    expected: Sequence[ExpectedFallsRow] = (),
    warnings: Iterable[WarningRow] = (),
    made: Container[str] = (),
) -> Iterator[str]:
    """Yield the conclusion on all structures, the worst with closed form, block and integration, and the others' words.

    Below them stand what the closed form saw of the falls among `counted_cases`, the records that failed, and what has
    to be checked of what was typed. comparison: is gone through once, and not kept. expected: how many fall, by record
    and of all. warnings: on the study and on its records, which are gone through once as well. made: the
    records that nobody recorded. At most _NAMED structures are named.
    """
    worst = worst_of_each(conclusions(verdicts, []))
    records = len({verdict.record for verdict in verdicts})  # one that failed gives none
    shown = {(conclusion.row.record, conclusion.row.structure): conclusion for conclusion in worst[:_WORST]}
    taken = worst_period_each(verdicts)
    carried = any(verdict.support_period_s is not None for verdict in taken)
    of_shown: list[ComparisonRow] = []
    of_recorded, of_made = Counter[tuple[str, str]](), Counter[tuple[str, str]]()
    for row in counted_cases(comparison, taken):
        if (row.record, row.structure) in shown:
            of_shown.append(row)
        (of_made if row.record in made else of_recorded)[row.record, _end(row)] += 1
    if worst:
        count = f"{counted(records, 'record')}, {counted(len(worst), 'structure')}. "
        words = {conclusion.row.structure: conclusion.row.decision.verdict for conclusion in worst}
        said_of_all = conclusion_in_words(words, records, fallen_in_one_run(worst))
        for said in (count + said_of_all, falls_in_words(expected)):
            yield from wrap(said, WIDTH)
        yield "Rotation over critical rotation of the worst structures, each under its worst record; the first by"
        yield "verdict, share, then reserve (5 and 50 % overturn at × the record):"
        yield f"{'':<16}  {'record':<18}  closed  block  integrated     reserve  verdict, share"
    own = (row for row in taken if (row.record, row.structure) in shown)
    for conclusion in conclusions(own, of_shown):
        ratios = map(_rotation, conclusion.ratios)
        marks = "  ".join(f"{text:>{width}}" for text, width in zip(ratios, (6, 5, 10), strict=True))
        reserve = conclusion.row.reserve.in_figures if conclusion.row.reserve else "–"
        line = (
            f"{_cut(conclusion.row.structure, 16):<16}  {_cut(conclusion.row.record, 18):<18}  {marks}  "
            f"{reserve:>10}  "
        )
        yield f"{line}{conclusion.row.decision.verdict} {conclusion.row.decision.share_in_words}".rstrip()
    if any("–" in conclusion.row.decision.share_in_words for conclusion in worst[:_WORST]):
        yield "A range: two cracks disagree."
    others = [
        (conclusion.row.decision.verdict, _cut(conclusion.row.structure, 30)) for conclusion in worst[_WORST:]
    ]
    if names := {verdict: [name for its, name in others if its is verdict] for verdict, _ in others}:
        text = "; ".join(map(": ".join, _named(names, _NAMED - _WORST).items()))
        yield from wrap(text, WIDTH, initial_indent="Others  ", subsequent_indent=" " * 8)
    of_what = COUNTED if carried else ""
    yield from _closed_form_lines(
        of_recorded or of_made, of_made if of_recorded else Counter(), records > 1, of_what
    )
    yield from failing_lines(failures)
    for sentence in to_check(warnings):
        yield from wrap(sentence, WIDTH, subsequent_indent=" " * 8)


def _end(row: ComparisonRow) -> str:
    """What the closed form makes of a fall: it is "seen" or "missed", or "false" where nothing falls; else ""."""
    if math.isnan(row.predicted_rotation_ratio) or math.isnan(row.integrated_rotation_ratio):
        return ""
    if row.integrated_rotation_ratio == math.inf:
        return "seen" if row.sees_fall else "missed"
    return "false" if row.predicted_rotation_ratio == math.inf else ""


def _closed_form_lines(
    ends: Counter[tuple[str, str]], of_made: Counter[tuple[str, str]], several: bool, of_what: str
) -> Iterator[str]:
    """What the closed form saw of the falls, where there is one.

    ends: cases by record and `_end`. of_made: those under made records beside them. several: whether there are several
    records.
    """
    missed, seen, false = (
        Counter({record: count for (record, end), count in ends.items() if end == wanted})
        for wanted in ("missed", "seen", "false")
    )
    falls = missed.total() + seen.total()
    if not falls:
        return
    most = missed.most_common(1) if several else []
    where = "".join(f" ({count} of them in {_cut(record, 24)})" for record, count in most)
    text = (
        f"Closed form against integration{of_what}: {seen.total()} of {counted(falls, 'fall')} seen, "
        f"{missed.total()} missed{where}, {counted(false.total(), 'false alarm').replace(' ', NO_BREAK)}"
    )
    made = Counter(end for (_, end), count in of_made.items() for _ in range(count))
    if made["seen"] + made["missed"]:
        text += f"; under made records {made['seen']} of {made['seen'] + made['missed']} seen"
    yield from (line.replace(NO_BREAK, " ") for line in wrap(text, WIDTH, subsequent_indent=" " * 8))


def failing_lines(failures: Sequence[FailureRow]) -> Iterator[str]:
    """The records that failed, and the sentences on structures that did over all records."""
    sentences = dict.fromkeys(
        f"{failure.structure}: {failure.message}" for failure in failures if not failure.record
    )
    for sentence in list(sentences)[:_NAMED]:
        yield from wrap(sentence.removeprefix(": "), WIDTH, subsequent_indent=" " * 8)
    if failed := sorted({failure.record for failure in failures} - {""}):
        text = f"{counted(len(failed), 'record')} failed, wholly or in part: {listed(failed, _NAMED)}"
        yield from wrap(text, WIDTH, subsequent_indent=" " * 8)


def conclusion_lines(sentence: str) -> list[str]:
    """Return the lines of what a product over all records comes down to; none where it says nothing."""
    return wrap(sentence, WIDTH, subsequent_indent=" " * 8)


def _rotation(ratio: float) -> str:
    """A rotation ratio in a column: "0.44", "falls", or a dash."""
    return "–" if math.isnan(ratio) else "falls" if ratio == math.inf else f"{ratio:.2f}"


def _cut(name: str, width: int) -> str:
    """The name, with an ellipsis where it is longer than `width`."""
    return name if len(name) <= width else f"{name[: width - 1]}…"


def _named(by_word: Mapping[Verdict, Sequence[str]], left: int) -> dict[str, str]:
    """By verdict the names, `left` of all together, and of each verdict how many more there are."""
    texts: dict[str, str] = {}
    for verdict, names in by_word.items():
        more = len(names) - left
        texts[verdict] = ", ".join(
            [*names[:left], f"{more} more" if left else str(more)] if more > 0 else names
        )
        left = max(0, -more)
    return texts


def check_any_read(summary: Path, records: Collection[str]) -> None:
    """Raise RecordError when a summary, where one was asked for, says of each record that it could not be read."""
    if not (summary / FailureRow.table.file_name).is_file():
        return
    unread = {row.record: row.message for row in read_table(FailureRow, summary) if row.stage == "read"}
    if set(unread) >= set(records):
        number = counted(len(records), "record")
        record, message = next(iter(unread.items()))
        raise RecordError(f"none of {number} could be read; the first: {record}: {message}")


def paths_to_read(
    results: Path, verdicts: Iterable[VerdictRow], reports: bool, opened: Mapping[Path, str]
) -> Iterator[str]:
    """Yield a line for each of the files that come next for a reader, the report of the worst record among them.

    reports: whether the study makes reports. opened: files of the products over all records, and what each is. A file
    that lies there of a former run, and that this one does not make, is not named: it would not say what the tables
    say.
    """
    summary = results / "summary"
    records = worst_first((verdict.record, verdict.severity) for verdict in worst_period_each(verdicts))
    first = summary / "summary.pdf" if reports else summary
    files = {first: "all records"}
    if records and reports:
        files[results / records[0] / "report.pdf"] = "every structure under the worst record"
    files |= opened
    if reports:
        files[summary / "study.html"] = "to explore"
    width = max(len(str(path)) for path in files)
    for path, what in files.items():
        yield f"{'Open' if path == first else '':<8}{path!s:<{width}}  {what}"
