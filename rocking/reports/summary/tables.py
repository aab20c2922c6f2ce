"""The tables and sentences of the summary, from the rows of its CSV tables."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import islice

from rocking.reports import printing
from rocking.reports.printing import Cell, Row, number, ratio, strong, table, whole, words

Rows = Iterable[Row]
"""Rows that can be gone through again and again."""
Tables = Mapping[str, Rows]

MOST_LISTED = 40
"""Rows of the longest list of single cases or failures; the CSV tables hold all."""
MOST_RECORDS = 200
"""Rows of the longest list of records."""


@dataclass(frozen=True)
class Listing:
    """The first of some rows, and how many there are."""

    first: list[Row]
    total: int

    @classmethod
    def of(cls, rows: Rows, most: int = MOST_LISTED) -> "Listing":
        """Go through `rows` once and keep the first ones."""
        remaining = iter(rows)
        first = list(islice(remaining, most))
        return cls(first, len(first) + sum(1 for _ in remaining))

    def rest(self, noun: str, file: str) -> str:
        """Return what is left out, as a sentence or nothing."""
        more = self.total - len(self.first)
        return f" Another {printing.counted(more, noun)} in {file}." if more > 0 else ""


def expert_sentences(tables: Tables) -> list[str]:
    """Return the three sentences that somebody who knows the method would say about this run."""
    rows = {row["light"]: row for row in tables["agreement"]}
    if int(rows["all"]["cases"]) == 0:
        return [
            "There is no case with both a prediction and an integration, so nothing can be said about the closed form."
        ]
    return [_trust(rows), _overturning(rows), _undecided(rows)]


def _trust(rows: Mapping[str, Row]) -> str:
    green, every = rows["green"], rows["all"]
    said = f"One pulse can stand for the record (green) in {green['cases']} of {every['cases']} cases"
    if int(green["both_rock"]):
        said += (
            f"; where both rock there, the closed form is within a factor of two in {green['within_factor_two']} of "
            f"{green['both_rock']}, with a median ratio of {number(green['median_ratio'])}"
        )
    red = rows["red"]
    if int(red["both_rock"]):
        said += (
            f" (red: {red['within_factor_two']} of {red['both_rock']}, median {number(red['median_ratio'])})"
        )
    return f"{said}."


def _overturning(rows: Mapping[str, Row]) -> str:
    every, red = rows["all"], rows["red"]
    false = _cases(every["overturning_false"])
    if int(every["overturning"]) == 0:
        return f"Nothing overturns in the full integration; the closed form overturns {false}."
    return (
        f"Of {every['overturning']} overturnings in the full integration the closed form finds "
        f"{every['overturning_found']} and misses {every['overturning_missed']}, {red['overturning_missed']} of these "
        f"under a red light; it overturns {false} that stay up."
    )


def _undecided(rows: Mapping[str, Row]) -> str:
    fragile, red = rows["all"]["fragile"], rows["red"]["cases"]
    return (
        f"{printing.sentence(_cases(fragile, 'verdict'))} stand so close to a change that they are not decided; "
        f"{_cases(red)} have a red light, where only the full integration may be used."
    )


def _cases(many: str, noun: str = "case") -> str:
    return printing.counted(int(many), noun)


def notices(tables: Tables, failures: int) -> list[dict[str, object]]:
    """Return the warnings that stand above everything."""
    found = []
    if not any(True for _ in tables["record"]):
        found.append("No record could be read, so there is no result; the failures below say why.")
    elif not any(True for _ in tables["comparison"]):
        found.append("No structure could be assessed under any record; the failures below say why.")
    elif all(row["integrated_rotation_ratio"] == "0.0" for row in tables["comparison"]):
        found.append("No structure uplifts under any record.")
    spared = sum(
        bool(not row["integrated_rotation_ratio"] and row.get("answer_rotation_ratio"))
        for row in tables["comparison"]
    )
    if spared:
        found.append(
            f"{printing.sentence(printing.counted(spared, 'case'))} answered by a cheaper method than the full "
            "integration and left out of what compares the two; see answer_method in comparison.csv."
        )
    if failures:
        found.append(f"{printing.sentence(printing.counted(failures, 'failure'))}, listed below.")
    scaled = sorted({row["record"] for row in tables["record"] if float(row["scale_factor"] or 1) != 1})
    if scaled:
        named = printing.listed(scaled, most=20)
        found.append(f"Accelerations multiplied by a declared factor, not as recorded: {named}.")
    return [{"strong": True, "text": text} for text in found]


def agreement_table(tables: Tables) -> dict[str, object]:
    """Return how often the closed form was right, by light."""
    columns = [
        ("Light", "1", "l"),
        ("Records", "0.8", "r"),
        ("Cases", "0.8", "r"),
        ("Both rock", "0.8", "r"),
        ("within factor 2", "0.8", "r"),
        ("Median ratio [-]", "0.8", "r"),
        ("Overturn", "0.9", "r"),
        ("found", "0.7", "r"),
        ("missed", "0.7", "r"),
        ("only predicted", "0.9", "r"),
        ("Fragile", "0.7", "r"),
    ]
    return table(columns, [_agreement_row(row) for row in tables["agreement"]])


def _agreement_row(row: Row) -> list[Cell]:
    before = ("records", "cases", "both_rock", "within_factor_two")
    after = ("overturning", "overturning_found", "overturning_missed", "overturning_false", "fragile")
    cells: list[Cell] = [printing.lamp(row["light"]), *(whole(row[name]) for name in before)]
    cells += [number(row["median_ratio"]), *(whole(row[name]) for name in after)]
    cells[8] = (
        strong(whole(row["overturning_missed"])) if row["overturning_missed"] not in ("", "0") else cells[8]
    )
    return cells


def record_listing(tables: Tables) -> Listing:
    """Return the records, one row a component."""
    return Listing.of(tables["record"], MOST_RECORDS)


def record_table(records: Listing, pulses: Rows) -> dict[str, object]:
    """Return the records with their dominant pulses."""
    columns = [
        ("Record", "1.6", "l"),
        ("Comp.", "0.8", "l"),
        ("Declared factor", "0.7", "r"),
        ("Peak acceleration [m/s²]", "1", "r"),
        ("Peak velocity [m/s]", "0.9", "r"),
        ("Pulse amplitude [m/s²]", "0.9", "r"),
        ("Pulse period [s]", "0.8", "r"),
        ("Explained energy [-]", "0.9", "r"),
        ("Flags", "1.2", "l"),
    ]
    listed = {_component(row) for row in records.first}
    dominant = {
        _component(row): row
        for row in pulses
        if row["kind"] == "alternative" and row["rank"] == "1" and _component(row) in listed
    }
    return table(columns, [_record_row(row, dominant.get(_component(row), {})) for row in records.first])


def _component(row: Row) -> tuple[str, str]:
    return row["record"], row["component"]


def _record_row(row: Row, pulse: Row) -> list[Cell]:
    factor = printing.given(row["scale_factor"])
    return [
        row["record"],
        words(row["component"]),
        factor if factor in ("1", printing.NOTHING) else strong(f"×\u00a0{factor}"),
        number(row["peak_acceleration_m_s2"]),
        number(row["peak_velocity_m_s"]),
        number(pulse.get("amplitude_m_s2", "")),
        number(pulse.get("period_s", "")),
        number(pulse.get("explained_energy", "")),
        words(pulse.get("flags", "")),
    ]


def case_table(cases: Listing) -> dict[str, object]:
    """Return single cases of the comparison table."""
    columns = [
        ("Record", "1.4", "l"),
        ("Comp.", "0.7", "l"),
        ("Structure", "1.4", "l"),
        ("Light", "auto", "l"),
        ("Closed form", "auto", "r"),
        ("Full integration", "auto", "r"),
        ("Regime of the closed form", "1.4", "l"),
        ("Sensi\u00adtivity", "0.6", "r"),
        ("Fragile", "auto", "l"),
    ]
    return table(columns, [_case_row(row) for row in cases.first])


def _case_row(row: Row) -> list[Cell]:
    return [
        row["record"],
        words(row["component"]),
        row["structure"],
        printing.lamp(row["light"]),
        ratio(row["predicted_rotation_ratio"]),
        strong(ratio(row["integrated_rotation_ratio"])),
        words(row["regime"]),
        number(row["sensitivity"]),
        "YES" if row["fragile"] == "true" else {"false": "no"}.get(row["fragile"], printing.NOTHING),
    ]


def failure_table(failures: Listing) -> dict[str, object]:
    """Return what gave no result, and why."""
    columns = [
        ("Record", "1", "l"),
        ("Comp.", "0.5", "l"),
        ("Structure", "0.8", "l"),
        ("Stage", "0.6", "l"),
        ("Why", "3", "l"),
    ]
    names = ("record", "component", "structure", "stage", "message")
    return table(columns, [[words(row[name]) for name in names] for row in failures.first])
