"""What came of records, in a few lines: which structures overturn, what failed, and where to read on."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

from rocking.assessment.fate import ORDER, Fate
from rocking.assessment.rows.of_record import FailureRow
from rocking.assessment.verdict import Verdict, rocks
from rocking.errors import RecordError
from rocking.quantities import counted
from rocking.tables import read_table

_MOST = 6
"""Rows of a list at the end; a screen should hold it beside the lines of a dozen records."""
_MARKS = {Verdict.UNDECIDED: "?", Verdict.UNKNOWN: "–"}


def record_line(verdicts: Iterable[Fate], failures: Iterable[FailureRow]) -> str:
    """Say in one line what came of a record: "overturns: pier; undecided: wall (12 of 64); stands: arch 0.31".

    The numbers are members of the ensemble that overturn, or the largest rotation over the critical one of the worst
    component. What could not be assessed comes first.
    """
    parts: dict[str, list[str]] = {word: [] for word in ORDER}
    for fate in sorted(verdicts, key=lambda fate: fate.severity, reverse=True):
        number = f" {fate.rotation_ratio:.2g}" if rocks(fate.rotation_ratio) else ""
        parts[fate.verdict].append(fate.structure + (f" ({fate.leaning})" if fate.leaning else number))
    verdicts_line = [f"{word}: {', '.join(names)}" for word, names in parts.items() if names]
    failed = " ".join(_sentence(failure) for failure in failures)
    return "; ".join([f"failed: {failed}", *verdicts_line] if failed else verdicts_line)


def closing_lines(verdicts: Iterable[Fate], failures: Sequence[FailureRow]) -> list[str]:
    """Return the table of what overturns, is undecided or unknown under how many records, and which records failed."""
    under: dict[str, list[Fate]] = {}
    records = set()
    for fate in verdicts:
        records.add(fate.record)
        of_structure = under.setdefault(fate.structure, [])
        if fate.verdict is not Verdict.STANDS:
            of_structure.append(fate)
    failed = sorted({failure.record for failure in failures})
    told = f"{counted(len(failed), 'record')} failed, wholly or in part: {', '.join(failed)}"
    return [*_table(under, len(records)), *([told] if failed else [])]


def check_any_read(summary: str | Path, records: Collection[str]) -> None:
    """Raise RecordError when the summary in a folder says of each of `records` that it could not be read.

    Without a summary, as where another target was asked for, nothing is said.
    """
    if not (Path(summary) / FailureRow.table.file_name).is_file():
        return
    unread = {row.record: row for row in read_table(FailureRow, Path(summary)) if row.stage == "read"}
    if set(unread) >= set(records):
        first = next(iter(unread.values()))
        raise RecordError(
            f"none of {counted(len(records), 'record')} could be read; the first: {first.message}"
        )


def paths_to_read(results: Path, verdicts: Iterable[Fate]) -> Iterator[str]:
    """Yield a line for each of the files that come next for a reader, the report of the worst record among them."""
    summary = results / "summary"
    yield from (f"Page to explore: {page}" for page in sorted(summary.glob("*.html")))
    yield f"Summary: {report if (report := summary / 'summary.pdf').is_file() else summary}"
    worst = max(verdicts, key=lambda fate: fate.severity, default=None)
    if worst and (report := results / worst.record / "report.pdf").is_file():
        yield f"Report of the worst record: {report}"


def _table(under: dict[str, list[Fate]], records: int) -> Iterator[str]:
    """A row for each structure that does not stand everywhere: two counts, and the names of the records."""
    worst = {name: fates for name, fates in under.items() if fates}
    if not records:
        return
    if not worst:
        yield f"Every structure stands under {counted(records, 'record')}."
        return
    overturning = {name: sum(fate.verdict is Verdict.OVERTURNS for fate in worst[name]) for name in worst}
    ordered = sorted(worst, key=lambda name: (-overturning[name], -len(worst[name])))
    shown = ordered[:_MOST]
    width = max(9, *map(len, shown))
    yield f"Of {counted(records, 'record')}:"
    yield f"  {'':<{width}}  overturns  undecided  records (?: undecided, –: unknown)"
    for name in shown:
        fates = sorted(worst[name], key=lambda fate: fate.severity, reverse=True)
        undecided = sum(fate.verdict is Verdict.UNDECIDED for fate in fates)
        names = ", ".join(fate.record + _MARKS.get(fate.verdict, "") for fate in fates)
        yield f"  {name:<{width}}  {overturning[name]:>9}  {undecided:>9}  {names}"
    if len(ordered) > _MOST:
        yield f"  and {counted(len(ordered) - _MOST, 'more structure')}, in {Fate.table.file_name}"


def _sentence(failure: FailureRow) -> str:
    of = f"{failure.structure}: " if failure.structure else ""
    return of + failure.message.removeprefix(f"{failure.record}: ")
