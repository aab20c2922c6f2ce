"""The first page of a record's report: what becomes of the buildings, by name, and how sure that is."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version

from rocking.assessment.fate import ORDER, Fate
from rocking.assessment.rows.of_case import CandidateRow
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import RecordRow
from rocking.assessment.rows.of_study import StructureRow
from rocking.assessment.verdict import Verdict, rests
from rocking.reports import printing
from rocking.reports.printing import NOTHING, Cell, strong, table_of, words

_RESTS = "rests"


@dataclass(frozen=True)
class Line:
    """One structure on page one: its fate, and what stands beside it.

    crack: what opens, in a word. candidate: its governing height, None without candidates.
    processed: smallest and largest rotation ratio over the processings of the record.
    """

    fate: Fate
    geometry: str
    crack: str
    candidate: CandidateRow | None
    processed: tuple[float, float] | None

    @property
    def overturns_elsewhere(self) -> bool:
        """Whether it stays up as given and overturns when hinged or cracked at another height."""
        stays = self.fate.rotation_ratio < math.inf
        return stays and self.candidate is not None and math.isinf(self.candidate.integrated_rotation_ratio)


def fate_lines(tables: RecordTables, structures: Sequence[StructureRow]) -> list[Line]:
    """Return what becomes of each structure, in the order of the comparison table."""
    known = {row.structure: row for row in structures}
    lines = []
    for fate in tables.verdicts:
        name = fate.structure
        heights = [row for row in tables.candidates if row.structure == name and row.governs_record]
        done = [row.rotation_ratio for row in tables.processing if row.structure == name]
        done = [ratio for ratio in done if not math.isnan(ratio)]
        own = known.get(name)
        lines.append(
            Line(
                fate,
                own.geometry if own else "",
                (own.crack if own else "") or "hinge",
                max(heights, key=lambda row: _known(row.integrated_rotation_ratio), default=None),
                (min(done), max(done)) if done else None,
            )
        )
    return lines


def page_one_data(
    tables: RecordTables, structures: Sequence[StructureRow], numbers: Mapping[str, str]
) -> dict[str, object]:
    """Return what the template of the first page is given."""
    found = fate_lines(tables, structures)
    return {
        "origin": origin(tables.record),
        "headlines": headlines(found),
        "remarks": remarks(found),
        "fates": fate_table(found, numbers),
    }


def headlines(found: Sequence[Line]) -> list[dict[str, str]]:
    """Return the first lines of the report: each verdict with the structures that it is of, the worst first."""
    groups: dict[str, list[Line]] = {verdict: [] for verdict in ORDER}
    for line in sorted(found, key=lambda line: line.fate.severity, reverse=True):
        groups[line.fate.verdict].append(line)
    named = {verdict: [_named(line) for line in group] for verdict, group in groups.items()}
    return printing.headlines(named)


def remarks(found: Sequence[Line]) -> list[str]:
    """Return what the verdicts leave out and a reader has to know beside them, in sentences."""
    elsewhere = [
        f"{line.fate.structure} ({line.crack} at {printing.number(line.candidate.position_m)} m)"
        for line in found
        if line.candidate and line.overturns_elsewhere
    ]
    processed = [
        line.fate.structure
        for line in found
        if line.processed and math.isinf(line.processed[1]) and math.isfinite(line.processed[0])
    ]
    said = [
        (elsewhere, "Stays up as given and overturns with another height of hinge or crack: {}."),
        (processed, "Whether it overturns depends on the processing of the record: {}."),
    ]
    return [text.format(printing.listed(names)) for names, text in said if names]


def fate_table(found: Sequence[Line], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the table of page one: one row per structure, without the columns that are empty for all."""
    columns: list[tuple[str, str, str, Callable[[Line], Cell]]] = [
        ("No.", "auto", "r", lambda line: numbers.get(line.fate.structure, NOTHING)),
        ("Structure", "2.1", "l", lambda line: strong(line.fate.structure, below=line.geometry)),
        ("Verdict", "auto", "l", _verdict),
        ("Over\u00adturns in", "auto", "l", lambda line: _members(line.fate)),
        ("5–95 %, of the critical rotation", "1.5", "c", _strip),
        ("from – to", "0.95", "l", _range),
        ("As given", "0.75", "l", lambda line: _printed(line.fate.rotation_ratio, line.fate)),
        ("Worst hinge or crack", "0.9", "l", _height),
        ("Processing of the record", "1", "l", lambda line: _from_to(line.fate, line.processed)),
        ("Worst direction, sign", "0.75", "l", _direction),
    ]
    kept = [
        column
        for place, column in enumerate(columns)
        if place < 3 or any(column[3](line) != NOTHING for line in found)
    ]
    return table_of(found, *kept)


def origin(rows: Sequence[RecordRow]) -> str:
    """Say which version made the report of which file of which time. The time of the run is left out."""
    files = dict.fromkeys(
        f"{words(row.file)}, SHA-256 {row.record_sha256[:16]}…" for row in rows if row.record_sha256
    )
    times = dict.fromkeys(row.start_time for row in rows if row.start_time)
    when = f"Recorded {', '.join(times)}. " if times else "The file does not state when it was recorded. "
    settings = dict.fromkeys(row.settings_sha256[:16] for row in rows if row.settings_sha256)
    return (
        when
        + (f"File: {'; '.join(files)}. " if files else "")
        + f"rocking {version('rocking')}"
        + (f", settings and structures {', '.join(settings)}…." if settings else ".")
    )


def _known(ratio: float) -> float:
    return -1.0 if math.isnan(ratio) else ratio


def _verdict(line: Line) -> Cell:
    return strong(line.fate.verdict, line.fate.verdict != Verdict.STANDS)


def _direction(line: Line) -> str:
    return words(", ".join(filter(None, (line.fate.direction, line.fate.polarity))))


def _named(line: Line) -> str:
    notes = [line.fate.leaning.replace(line.fate.count, _members(line.fate))] if line.fate.leaning else []
    if line.candidate is not None and not rests(line.candidate.integrated_rotation_ratio):
        at = f"{line.crack} at {printing.number(line.candidate.position_m)}\u00a0m"
        notes.append(f"as given; with the {at} it overturns" if line.overturns_elsewhere else f"{at} governs")
    return line.fate.structure + (f" ({', '.join(notes)})" if notes else "")


def _members(fate: Fate) -> str:
    return printing.of(fate.overturning_members, fate.members)


def _strip(line: Line) -> Cell:
    fate = line.fate
    places = fate.rotation_ratio_low, fate.rotation_ratio_median, fate.rotation_ratio_high
    return printing.strip(places, fate.overturning_share)


def _range(line: Line) -> str:
    fate = line.fate
    return _from_to(fate, (fate.rotation_ratio_low, fate.rotation_ratio_high) if fate.members else None)


def _from_to(fate: Fate, ends: tuple[float, float] | None) -> str:
    """A range of rotation ratios, closed up between numbers."""
    if ends is None:
        return NOTHING
    low, high = (_printed(value, fate) for value in ends)
    if low == high:
        return low
    return f"{low}–{high}" if high[0].isdigit() and low[0].isdigit() else f"{low} – {high}"


def _printed(ratio: float, fate: Fate) -> str:
    """A rotation ratio with no more digits than the spread of the ensemble leaves a meaning."""
    if math.isnan(ratio):
        return NOTHING
    if math.isinf(ratio):
        return "overturns"
    if rests(ratio):
        return _RESTS
    spread = fate.rotation_ratio_high - fate.rotation_ratio_low if fate.members else 0.0
    return printing.to_spread(ratio, spread)


def _height(line: Line) -> Cell:
    if line.candidate is None or rests(line.candidate.integrated_rotation_ratio):
        return NOTHING
    said = _printed(line.candidate.integrated_rotation_ratio, line.fate)
    return strong(
        f"{line.crack} {printing.number(line.candidate.position_m)}\u00a0m: {said}", line.overturns_elsewhere
    )
