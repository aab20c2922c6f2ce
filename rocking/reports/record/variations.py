"""What the answer owes to where a structure cracks and to how the record was processed: tables and sentences."""

from collections.abc import Mapping, Sequence

from rocking.assessment.rows.of_variation import CandidateRow, ProcessingRow
from rocking.reports import printing
from rocking.reports.printing import number, ratio, short, table, table_of, words


def candidate_table(rows: Sequence[CandidateRow], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the governing height of each structure with candidates, under the pulse and under the record."""
    pulse = {row.case: row for row in rows if row.governs_pulse}
    record = {row.case: row for row in rows if row.governs_record}
    governed = [case for case in dict.fromkeys(row.case for row in rows) if case in pulse or case in record]
    return table_of(
        [(*case, pulse.get(case), record.get(case)) for case in governed],
        ("No.", "auto", "r", lambda each: numbers[each[1]]),
        ("Comp.", "0.6", "l", lambda each: words(each[0])),
        ("Structure", "1.4", "l", lambda each: short(each[1])),
        ("Governing height, pulse [m]", "1.1", "r", lambda each: number(each[2] and each[2].position_m)),
        ("Closed form there", "1", "r", lambda each: ratio(each[2] and each[2].predicted_rotation_ratio)),
        ("Governing height, record [m]", "1.1", "r", lambda each: number(each[3] and each[3].position_m)),
        (
            "Full integration there",
            "1",
            "r",
            lambda each: ratio(each[3] and each[3].integrated_rotation_ratio),
        ),
    )


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
