"""What the answer owes to where a structure cracks and to how the record was processed: tables and sentences."""

import math
from collections.abc import Mapping, Sequence

from rocking.assessment.rows import CandidateRow, ProcessingRow
from rocking.reports import printing
from rocking.reports.printing import Cell, number, ratio, table, words


def candidate_table(rows: Sequence[CandidateRow], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the governing height of each structure with candidates, under the pulse and under the record."""
    columns = [
        ("No.", "auto", "r"),
        ("Comp.", "0.6", "l"),
        ("Structure", "1.4", "l"),
        ("Governing height, pulse [m]", "1.1", "r"),
        ("Closed form there", "1", "r"),
        ("Governing height, record [m]", "1.1", "r"),
        ("Full integration there", "1", "r"),
    ]
    by_case: dict[tuple[str, str], list[CandidateRow]] = {}
    for row in rows:
        by_case.setdefault(row.case, []).append(row)
    return table(columns, [_candidate_row(found, numbers) for found in by_case.values()])


def _candidate_row(rows: Sequence[CandidateRow], numbers: Mapping[str, str]) -> list[Cell]:
    component, structure = rows[0].case
    pulse = next((row for row in rows if row.governs_pulse), None)
    record = next((row for row in rows if row.governs_record), None)
    return [
        numbers[structure],
        words(component),
        structure,
        number(pulse.position_m if pulse else None),
        ratio(pulse.predicted_rotation_ratio if pulse else math.nan),
        number(record.position_m if record else None),
        ratio(record.integrated_rotation_ratio if record else math.nan),
    ]


def processing_table(rows: Sequence[ProcessingRow], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the largest rotation ratio of each component and structure under each processing."""
    processings = list(dict.fromkeys(row.processing for row in rows))
    columns = [("No.", "auto", "r"), ("Comp.", "auto", "l"), *((name, "1", "r") for name in processings)]
    found = {(*row.case, row.processing): ratio(row.rotation_ratio) for row in rows}
    shown = [
        [
            numbers[case[1]],
            words(case[0]),
            *(found.get((*case, name), printing.NOTHING) for name in processings),
        ]
        for case in dict.fromkeys(row.case for row in rows)
    ]
    return table(columns, shown)


def processing_sentences(rows: Sequence[ProcessingRow]) -> list[str]:
    """Return the structures whose outcome the processing of the record decides, as a sentence or nothing."""
    outcomes: dict[str, set[str]] = {}
    for row in rows:
        outcomes.setdefault(row.structure, set()).add(row.outcome)
    undecided = [name for name, found in outcomes.items() if len(found) > 1]
    if not undecided:
        return []
    return [f"The outcome depends on the processing of the record for {printing.listed(undecided)}."]
