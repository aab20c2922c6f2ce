"""What the answer owes to where a structure cracks and to how the record was processed: tables and sentences."""

from collections.abc import Mapping, Sequence

from rocking.reports import printing
from rocking.reports.printing import Cell, Row, number, of_component, ratio, table, words

Rows = Sequence[Row]


def candidate_table(rows: Rows, numbers: Mapping[str, str]) -> dict[str, object]:
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
    keys = dict.fromkeys(map(_key, rows))
    return table(columns, [_candidate_row(rows, *key, numbers) for key in keys])


def _candidate_row(rows: Rows, component: str, structure: str, numbers: Mapping[str, str]) -> list[Cell]:
    own = [row for row in of_component(rows, component) if row["structure"] == structure]
    pulse: Row = next((row for row in own if row["governs_pulse"] == "true"), {})
    record: Row = next((row for row in own if row["governs_record"] == "true"), {})
    return [
        numbers[structure],
        words(component),
        structure,
        number(pulse.get("position_m", "")),
        ratio(pulse.get("predicted_rotation_ratio", "")),
        number(record.get("position_m", "")),
        ratio(record.get("integrated_rotation_ratio", "")),
    ]


def processing_table(rows: Rows, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the largest rotation ratio of each component and structure under each processing."""
    processings = printing.distinct(rows, "processing")
    columns = [("No.", "auto", "r"), ("Comp.", "auto", "l"), *((name, "1", "r") for name in processings)]
    keys = dict.fromkeys(map(_key, rows))
    found = {(*_key(row), row["processing"]): ratio(row["rotation_ratio"]) for row in rows}
    shown = [
        [numbers[key[1]], words(key[0]), *(found.get((*key, name), printing.NOTHING) for name in processings)]
        for key in keys
    ]
    return table(columns, shown)


def _key(row: Row) -> tuple[str, str]:
    return row["component"], row["structure"]


def processing_sentences(rows: Rows) -> list[str]:
    """Return the structures whose outcome the processing of the record decides, as a sentence or nothing."""
    outcomes: dict[str, set[str]] = {}
    for row in rows:
        outcomes.setdefault(row["structure"], set()).add(row["outcome"])
    undecided = [name for name, found in outcomes.items() if len(found) > 1]
    if not undecided:
        return []
    return [f"The outcome depends on the processing of the record for {printing.listed(undecided)}."]
