"""What came of records, in a few lines: which structures overturn, what failed, and where to read on."""

from collections.abc import Collection, Iterable, Iterator
from pathlib import Path

from rocking.assessment.rows import ComparisonRow, FailureRow
from rocking.assessment.verdict import rests, rocks
from rocking.errors import RecordError
from rocking.quantities import counted
from rocking.tables import read_rows

_MOST = 6
"""Rows of a list at the end; a screen should hold it beside the lines of a dozen records."""


def came_of(folder: Path) -> tuple[Iterator[ComparisonRow], list[FailureRow]]:
    """Return the cases, one at a time, and the failures in the tables of a record or of a summary in `folder`."""
    return (
        read_rows(ComparisonRow, folder / ComparisonRow.table.file_name),
        list(read_rows(FailureRow, folder / FailureRow.table.file_name)),
    )


def record_line(cases: Iterable[ComparisonRow], failures: Iterable[FailureRow]) -> str:
    """Say in one line what came of a record: "overturns: pier; rocks: wall 0.55; rests: arch".

    The worst of its components counts for each structure. What could not be assessed comes first.
    """
    worst: dict[str, tuple[float, bool]] = {}
    for case in cases:
        found = case.found_rotation_ratio, bool(case.fragile)
        worst[case.structure] = max(worst.get(case.structure, (0.0, False)), found)
    parts: dict[str, list[str]] = {word: [] for word in ("overturns", "rocks", "rests")}
    for name, (ratio, fragile) in worst.items():
        number = f" {ratio:.2g}" if rocks(ratio) else ""
        parts[_word(ratio)].append(f"{name}{number}{' (fragile)' if fragile else ''}")
    verdicts = [f"{word}: {', '.join(names)}" for word, names in parts.items() if names]
    failed = " ".join(_sentence(failure) for failure in failures)
    return "; ".join([f"failed: {failed}", *verdicts] if failed else verdicts)


def closing_lines(cases: Iterable[ComparisonRow], failures: Iterable[FailureRow]) -> list[str]:
    """Return the table of what overturns under which records, and which records failed."""
    under: dict[str, dict[str, bool]] = {}
    read = set()
    for case in cases:
        read.add(case.record)
        if _word(case.found_rotation_ratio) == "overturns":
            records = under.setdefault(case.structure, {})
            records[case.record] = bool(case.fragile) and records.get(case.record, True)
    failed = sorted({failure.record for failure in failures})
    told = f"{counted(len(failed), 'record')} failed, wholly or in part: {', '.join(failed)}"
    return [*_overturned(under, len(read)), *([told] if failed else [])]


def check_any_read(summary: str | Path, records: Collection[str]) -> None:
    """Raise RecordError when the summary in a folder says of each of `records` that it could not be read.

    Without a summary, as where another target was asked for, nothing is said.
    """
    table = Path(summary) / FailureRow.table.file_name
    unread = (
        {row.record: row for row in read_rows(FailureRow, table) if row.stage == "read"}
        if table.is_file()
        else {}
    )
    if set(unread) >= set(records):
        first = next(iter(unread.values()))
        raise RecordError(
            f"none of {counted(len(records), 'record')} could be read; the first: {first.message}"
        )


def paths_to_read(results: Path) -> Iterator[str]:
    """Yield a line for each of the files that come next for a reader."""
    summary = results / "summary"
    yield from (f"Page to explore: {page}" for page in sorted(summary.glob("*.html")))
    yield f"Summary: {report if (report := summary / 'summary.pdf').is_file() else summary}"


def _overturned(under: dict[str, dict[str, bool]], read: int) -> Iterator[str]:
    if not read:
        return
    if not under:
        yield f"Nothing overturns under {counted(read, 'record')}."
        return
    yield f"Overturns under how many of {counted(read, 'record')} (? where a small change flips it):"
    ordered = sorted(under.items(), key=lambda item: -len(item[1]))
    width = max(len(name) for name, _ in ordered[:_MOST])
    for name, records in ordered[:_MOST]:
        names = ", ".join(record + ("?" if fragile else "") for record, fragile in records.items())
        yield f"  {name:<{width}}  {len(records):>3}  {names}"
    if len(ordered) > _MOST:
        left = counted(len(ordered) - _MOST, "more structure")
        yield f"  and {left}, in {ComparisonRow.table.file_name}"


def _word(ratio: float) -> str:
    return "rests" if rests(ratio) else "rocks" if rocks(ratio) else "overturns"


def _sentence(failure: FailureRow) -> str:
    of = f"{failure.structure}: " if failure.structure else ""
    return of + failure.message.removeprefix(f"{failure.record}: ")
