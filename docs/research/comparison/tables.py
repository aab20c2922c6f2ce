"""The tables of the comparison of codes."""

import math
from collections.abc import Callable, Iterable, Sequence
from statistics import median

from docs.research.comparison.rows import CodeRow
from rocking.reports import printing
from rocking.reports.printing import number

STRUCTURES = ("block", "frame", "arch")
_Columns = tuple[tuple[str, str, str, Callable[[CodeRow], str]], ...]
_FOUND: _Columns = (
    ("η found ± bar", "1.1", "r", lambda row: _with_bar(row.restitution, row.restitution_error)),
    ("Ours, η found", "0.8", "r", lambda row: printing.ratio(row.same_restitution_rotation_ratio)),
)
_SPENT: _Columns = (
    ("Time (s)", "0.6", "r", lambda row: number(row.duration_s, 2)),
    ("Note", "1.4", "l", lambda row: printing.words(row.reason)),
)


def work(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return the table of error and time of every structure and code."""
    return printing.table_of(
        _groups(rows),
        ("Structure", "0.6", "l", lambda own: own[0].structure),
        ("Code", "2", "l", lambda own: own[0].code),
        ("Cases", "0.45", "r", lambda own: printing.whole(len(own))),
        ("Rock", "0.4", "r", lambda own: printing.whole(sum(map(rocks, own)))),
        ("Median error", "0.8", "r", lambda own: _quantile(own, 0.5)),
        ("95 % error", "0.8", "r", lambda own: _quantile(own, 0.95)),
        (
            "Other verdict",
            "0.7",
            "r",
            lambda own: printing.whole(sum(r.verdict_agrees is False for r in own)),
        ),
        ("No answer", "0.6", "r", lambda own: printing.whole(sum(math.isnan(r.rotation_ratio) for r in own))),
        ("Impacts not found", "0.9", "r", _missed),
        ("Time (ms)", "0.7", "r", _time),
    )


def losses(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return the table of what the slow codes lose and find, of every structure and code."""
    return printing.table_of(
        _groups(rows),
        ("Structure", "0.8", "l", lambda own: own[0].structure),
        ("Code", "1.4", "l", lambda own: _short(own[0])),
        ("Cases", "0.5", "r", lambda own: printing.whole(len(own))),
        ("η of reference", "0.8", "r", lambda own: number(own[0].reference_restitution)),
        ("η found", "1.4", "r", lambda own: _range(row.restitution for row in own)),
        ("φ over reference", "1.5", "r", lambda own: _range(map(_over_reference, own))),
        ("φ over ours, η found", "1.5", "r", lambda own: _range(map(_over_same, own))),
        ("Within bar", "0.7", "r", _within_bar),
    )


def case_by_case(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return the table of the slow codes, case by case."""
    return printing.table_of(
        rows,
        ("Case", "1.2", "l", lambda row: row.case),
        ("Code", "1.4", "l", _short),
        ("Reference", "0.8", "r", lambda row: printing.ratio(row.reference_rotation_ratio)),
        ("Extrapolated ± bar", "1.1", "r", _rotation),
        *_FOUND,
        *_SPENT,
    )


def another_model(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return the table of what solves another model, case by case: a ratio, never an error."""
    return printing.table_of(
        rows,
        ("Case", "1.2", "l", lambda row: row.case),
        ("Reference", "0.8", "r", lambda row: printing.ratio(row.reference_rotation_ratio)),
        ("Another model ± bar", "1.2", "r", _rotation),
        ("Its φ over reference", "0.9", "r", lambda row: number(_over_reference(row))),
        *_FOUND,
        ("Outside hinges", "0.7", "r", lambda row: number(row.outside_hinges, 2)),
        *_SPENT,
    )


def _rotation(row: CodeRow) -> str:
    return _with_bar(row.rotation_ratio, row.rotation_ratio_error)


def _short(row: CodeRow) -> str:
    """Return the name of a code without what runs it."""
    return row.code.split(" (")[0]


def _groups(rows: Sequence[CodeRow]) -> list[list[CodeRow]]:
    """Return the rows of every structure and code."""
    groups: dict[tuple[str, str], list[CodeRow]] = {}
    for row in rows:
        groups.setdefault((row.structure, row.code), []).append(row)
    return [groups[key] for key in sorted(groups, key=lambda key: STRUCTURES.index(key[0]))]


def _over_reference(row: CodeRow) -> float:
    return _quotient(row.rotation_ratio, row.reference_rotation_ratio)


def _over_same(row: CodeRow) -> float:
    return _quotient(row.rotation_ratio, row.same_restitution_rotation_ratio)


def _quotient(found: float, expected: float) -> float:
    """Return how many times the rotation is as large, where both rock."""
    return found / expected if math.isfinite(found) and 0 < expected < math.inf else math.nan


def _range(values: Iterable[float]) -> str:
    """Return the median, and in brackets the least and the largest."""
    known = [value for value in values if not math.isnan(value)]
    if not known:
        return printing.NOTHING
    return f"{number(median(known))} ({number(min(known))} to {number(max(known))})"


def _with_bar(value: float, bar: float) -> str:
    if math.isnan(bar) or not math.isfinite(value):
        return printing.ratio(value)
    return f"{printing.ratio(value)} ± {number(bar, 2)}"


def _within_bar(rows: Sequence[CodeRow]) -> str:
    """Return in how many cases that rock the error bar holds the reference."""
    barred = [row for row in rows if not math.isnan(row.rotation_ratio_error) and not row.another_model]
    if not barred:
        return printing.NOTHING
    held = sum(abs(r.rotation_ratio - r.reference_rotation_ratio) <= r.rotation_ratio_error for r in barred)
    return f"{held} of {len(barred)}"


def rocks(row: CodeRow) -> bool:
    """Whether there is an error to speak of: both rock."""
    return row.error == row.error and 0 < row.reference_rotation_ratio < math.inf


def _quantile(rows: Sequence[CodeRow], share: float) -> str:
    errors = sorted(row.error for row in rows if rocks(row))
    return number(errors[min(int(share * len(errors)), len(errors) - 1)], 2) if errors else printing.NOTHING


def _missed(rows: Sequence[CodeRow]) -> str:
    counted = [row for row in rows if row.missed_impacts is not None]
    if not counted:
        return printing.NOTHING
    return f"{sum(row.missed_impacts or 0 for row in counted)} of {sum(row.reference_impacts for row in counted)}"


def _time(rows: Sequence[CodeRow]) -> str:
    spent = [row.duration_s for row in rows if row.duration_s == row.duration_s]
    return number(1e3 * median(spent), 2) if spent else printing.NOTHING
