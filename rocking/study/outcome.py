"""What came of records, in a few lines: which structures overturn, what failed, and where to read on."""

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_ensemble import EnsembleRow, governing_ensembles
from rocking.assessment.rows.of_record import FailureRow
from rocking.assessment.verdict import Verdict, rests, rocks
from rocking.errors import RecordError
from rocking.quantities import counted
from rocking.tables import read_rows, read_table

_ORDER = (Verdict.OVERTURNS, Verdict.UNDECIDED, "rocks", Verdict.STANDS, "rests", Verdict.UNKNOWN)
_MOST = 6
"""Rows of a list at the end; a screen should hold it beside the lines of a dozen records."""


@dataclass(frozen=True)
class CameOf:
    """The cases, failures and ensembles in the tables of a record or of a summary."""

    cases: Iterable[ComparisonRow]
    failures: Sequence[FailureRow] = ()
    ensembles: Iterable[EnsembleRow] = ()

    @classmethod
    def read(cls, folder: Path) -> "CameOf":
        """Read the tables in `folder`, cases and ensembles one at a time as they are asked for."""
        return cls(
            read_rows(ComparisonRow, folder / ComparisonRow.table.file_name),
            read_table(FailureRow, folder),
            read_rows(EnsembleRow, folder / EnsembleRow.table.file_name),
        )

    def verdicts(self) -> dict[tuple[str, str], tuple[str, float, str]]:
        """Verdict, rotation ratio of the worst component, and what stands behind a doubt, by record and structure.

        The verdict is that of the ensemble; without one it is what the worst component does by itself.
        """
        worst: dict[tuple[str, str], float] = {}
        for case in self.cases:
            key = case.record, case.structure
            worst[key] = max(worst.get(key, 0.0), case.found_rotation_ratio, key=_severity)
        ensembles = governing_ensembles(self.ensembles)
        return {key: _verdict(ratio, ensembles.get(key)) for key, ratio in worst.items()}


def _severity(ratio: float) -> tuple[int, float]:
    """What is not known may overturn, and so counts for more than any rocking."""
    return 2 if math.isinf(ratio) else int(math.isnan(ratio)), ratio


def _verdict(ratio: float, found: EnsembleRow | None) -> tuple[str, float, str]:
    if found is None:
        named = {"rests": rests(ratio), "rocks": rocks(ratio), Verdict.OVERTURNS: math.isinf(ratio)}
        return next((word for word, holds in named.items() if holds), Verdict.UNKNOWN), ratio, ""
    doubtful = found.verdict is Verdict.UNDECIDED
    return found.verdict, ratio, f"{found.overturning_members} of {found.members}" if doubtful else ""


def record_line(came: CameOf) -> str:
    """Say in one line what came of a record: "overturns: pier; undecided: wall (12 of 64); stands: arch 0.31".

    The numbers are members of the ensemble that overturn, or the largest rotation over the critical one of the worst
    component. What could not be assessed comes first.
    """
    parts: dict[str, list[str]] = {word: [] for word in _ORDER}
    for (_, name), (word, ratio, behind) in came.verdicts().items():
        number = f" ({behind})" if behind else f" {ratio:.2g}" if rocks(ratio) else ""
        parts[word].append(name + number)
    verdicts = [f"{word}: {', '.join(names)}" for word, names in parts.items() if names]
    failures = came.failures
    failed = " ".join(_sentence(failure) for failure in failures)
    return "; ".join([f"failed: {failed}", *verdicts] if failed else verdicts)


def closing_lines(came: CameOf) -> list[str]:
    """Return the table of what overturns, or may, under which records, and which records failed."""
    under: dict[str, dict[str, bool]] = {}
    read = set()
    for (record, structure), (word, _, _) in came.verdicts().items():
        read.add(record)
        if word in (Verdict.OVERTURNS, Verdict.UNDECIDED, Verdict.UNKNOWN):
            under.setdefault(structure, {})[record] = word != Verdict.OVERTURNS
    failed = sorted({failure.record for failure in came.failures})
    told = f"{counted(len(failed), 'record')} failed, wholly or in part: {', '.join(failed)}"
    return [*_overturned(under, len(read)), *([told] if failed else [])]


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
    yield f"Overturns under how many of {counted(read, 'record')} (? where that is undecided):"
    ordered = sorted(under.items(), key=lambda item: -len(item[1]))
    width = max(len(name) for name, _ in ordered[:_MOST])
    for name, records in ordered[:_MOST]:
        names = ", ".join(record + ("?" if doubtful else "") for record, doubtful in records.items())
        yield f"  {name:<{width}}  {len(records):>3}  {names}"
    if len(ordered) > _MOST:
        left = counted(len(ordered) - _MOST, "more structure")
        yield f"  and {left}, in {ComparisonRow.table.file_name}"


def _sentence(failure: FailureRow) -> str:
    of = f"{failure.structure}: " if failure.structure else ""
    return of + failure.message.removeprefix(f"{failure.record}: ")
