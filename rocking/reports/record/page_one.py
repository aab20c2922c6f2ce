"""The first page of a record's report: what becomes of the buildings, by name, and how sure that is."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version

from rocking.assessment.rows.of_ensemble import EnsembleRow, governing_ensembles
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import RecordRow
from rocking.assessment.rows.of_study import StructureRow
from rocking.assessment.rows.of_variation import CandidateRow
from rocking.assessment.verdict import Verdict, rests, rocks
from rocking.reports import printing
from rocking.reports.printing import NOTHING, Cell, strong, table_of, words

_ROCKS, _RESTS = "rocks and stays up", "rests"
_ORDER = (Verdict.OVERTURNS, Verdict.UNDECIDED, _ROCKS, Verdict.STANDS, _RESTS, Verdict.UNKNOWN)


@dataclass(frozen=True)
class Fate:
    """What is known of one structure under one record, all components considered.

    rotation_ratio: of the case as given, the worst component. direction: the worst one, and the worse sign of the
    motion where the sides differ. ensemble: None where none was asked for.
    crack: "crack" of a spire, else "hinge". candidate: its governing height, None without candidates.
    processed: smallest and largest rotation ratio over the processings of the record.
    """

    structure: str
    rotation_ratio: float
    direction: str
    geometry: str
    crack: str
    ensemble: EnsembleRow | None
    candidate: CandidateRow | None
    processed: tuple[float, float] | None

    @property
    def verdict(self) -> str:
        """That of the ensemble, or without one what the case as given does."""
        if self.ensemble is not None:
            return self.ensemble.verdict
        if math.isnan(self.rotation_ratio):
            return Verdict.UNKNOWN
        word = _RESTS if rests(self.rotation_ratio) else _ROCKS if rocks(self.rotation_ratio) else ""
        return word or Verdict.OVERTURNS

    @property
    def followed(self) -> EnsembleRow | None:
        """The ensemble, if any of its members could be followed."""
        return self.ensemble if self.ensemble and self.ensemble.members else None

    @property
    def overturns_elsewhere(self) -> bool:
        """Whether it stays up as given and overturns when hinged or cracked at another height."""
        stays = self.rotation_ratio < math.inf
        return stays and self.candidate is not None and math.isinf(self.candidate.integrated_rotation_ratio)


def fates(tables: RecordTables, structures: Sequence[StructureRow]) -> list[Fate]:
    """Return what becomes of each structure, in the order of the comparison table."""
    ensembles = {structure: found for (_, structure), found in governing_ensembles(tables.ensemble).items()}
    known = {row.structure: row for row in structures}
    several = len({row.component for row in tables.comparison}) > 1
    found = []
    for name in dict.fromkeys(row.structure for row in tables.comparison):
        cases = [row for row in tables.comparison if row.structure == name]
        worst = max(cases, key=lambda row: _known(row.found_rotation_ratio))
        heights = [row for row in tables.candidates if row.structure == name and row.governs_record]
        done = [row.rotation_ratio for row in tables.processing if row.structure == name]
        done = [ratio for ratio in done if not math.isnan(ratio)]
        ensemble, own = ensembles.get(name), known.get(name)
        direction = (ensemble.worst_direction if ensemble else "") or (worst.component if several else "")
        polarity = ensemble.worst_polarity if ensemble else ""
        found.append(
            Fate(
                name,
                worst.found_rotation_ratio,
                ", ".join(filter(None, (direction, polarity))),
                own.geometry if own else "",
                "crack" if own and "spire" in own.type.lower() else "hinge",
                ensemble,
                max(heights, key=lambda row: _known(row.integrated_rotation_ratio), default=None),
                (min(done), max(done)) if done else None,
            )
        )
    return found


def page_one_data(
    tables: RecordTables, structures: Sequence[StructureRow], numbers: Mapping[str, str]
) -> dict[str, object]:
    """Return what the template of the first page is given."""
    found = fates(tables, structures)
    return {
        "origin": origin(tables.record),
        "headlines": headlines(found),
        "remarks": remarks(found),
        "fates": fate_table(found, numbers),
    }


def headlines(found: Sequence[Fate]) -> list[dict[str, str]]:
    """Return the first lines of the report: each verdict with the structures that it is of, the worst first."""
    groups: dict[str, list[Fate]] = {verdict: [] for verdict in _ORDER}
    for fate in found:
        groups[fate.verdict].append(fate)
    named = {
        verdict: [_named(fate) for fate in sorted(group, key=_rank)] for verdict, group in groups.items()
    }
    return printing.headlines(named)


def remarks(found: Sequence[Fate]) -> list[str]:
    """Return what the verdicts leave out and a reader has to know beside them, in sentences."""
    elsewhere = [
        f"{fate.structure} ({fate.crack} at {printing.number(fate.candidate.position_m)} m)"
        for fate in found
        if fate.candidate and fate.overturns_elsewhere
    ]
    processed = [
        fate.structure
        for fate in found
        if fate.processed and math.isinf(fate.processed[1]) and math.isfinite(fate.processed[0])
    ]
    said = [
        (elsewhere, "Stays up as given and overturns with another height of hinge or crack: {}."),
        (processed, "Whether it overturns depends on the processing of the record: {}."),
    ]
    return [text.format(printing.listed(names)) for names, text in said if names]


def fate_table(found: Sequence[Fate], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the table of page one: one row per structure, without the columns that are empty for all."""
    columns: list[tuple[str, str, str, Callable[[Fate], Cell]]] = [
        ("No.", "auto", "r", lambda fate: numbers[fate.structure]),
        ("Structure", "2.1", "l", lambda fate: strong(fate.structure, below=fate.geometry)),
        ("Verdict", "auto", "l", lambda fate: strong(fate.verdict, fate.verdict != Verdict.STANDS)),
        ("Over\u00adturns in", "auto", "l", _members),
        ("5–95 %, of the critical rotation", "1.5", "c", _strip),
        ("from – to", "0.95", "l", _range),
        ("As given", "0.75", "l", lambda fate: _printed(fate.rotation_ratio, fate.ensemble)),
        ("Worst hinge or crack", "0.9", "l", _height),
        ("Processing of the record", "1", "l", lambda fate: _from_to(fate, fate.processed)),
        ("Worst direction, sign", "0.75", "l", lambda fate: words(fate.direction)),
    ]
    kept = [
        column
        for place, column in enumerate(columns)
        if place < 3 or any(column[3](fate) != NOTHING for fate in found)
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


def _rank(fate: Fate) -> tuple[float, float]:
    probability = fate.ensemble.overturning_probability if fate.ensemble else 0.0
    return -_known(probability), -_known(fate.rotation_ratio)


def _named(fate: Fate) -> str:
    notes = []
    if fate.verdict == Verdict.UNDECIDED:
        notes.append(f"overturns in {_members(fate)}")
    if fate.candidate is not None and not rests(fate.candidate.integrated_rotation_ratio):
        at = f"{fate.crack} at {printing.number(fate.candidate.position_m)}\u00a0m"
        notes.append(f"as given; with the {at} it overturns" if fate.overturns_elsewhere else f"{at} governs")
    return fate.structure + (f" ({', '.join(notes)})" if notes else "")


def _members(fate: Fate) -> str:
    found = fate.followed
    return printing.of(found.overturning_members, found.members) if found else NOTHING


def _strip(fate: Fate) -> Cell:
    found = fate.followed
    if found is None:
        return NOTHING
    places = found.rotation_ratio_low, found.rotation_ratio_median, found.rotation_ratio_high
    return printing.strip(places, found.overturning_probability)


def _range(fate: Fate) -> str:
    found = fate.followed
    return _from_to(fate, (found.rotation_ratio_low, found.rotation_ratio_high) if found else None)


def _from_to(fate: Fate, ends: tuple[float, float] | None) -> str:
    """A range of rotation ratios, closed up between numbers."""
    if ends is None:
        return NOTHING
    low, high = (_printed(value, fate.ensemble) for value in ends)
    if low == high:
        return low
    return f"{low}–{high}" if high[0].isdigit() and low[0].isdigit() else f"{low} – {high}"


def _printed(ratio: float, found: EnsembleRow | None) -> str:
    """A rotation ratio with no more digits than the spread of the ensemble leaves a meaning."""
    if math.isnan(ratio):
        return NOTHING
    if math.isinf(ratio):
        return "overturns"
    if rests(ratio):
        return _RESTS
    low, high = (found.rotation_ratio_low, found.rotation_ratio_high) if found else (ratio, ratio)
    return printing.to_spread(ratio, high - low)


def _height(fate: Fate) -> Cell:
    if fate.candidate is None or rests(fate.candidate.integrated_rotation_ratio):
        return NOTHING
    said = _printed(fate.candidate.integrated_rotation_ratio, fate.ensemble)
    return strong(
        f"{fate.crack} {printing.number(fate.candidate.position_m)}\u00a0m: {said}", fate.overturns_elsewhere
    )
