"""The tables and sentences of the summary, from the rows of its CSV tables."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from rocking.assessment.rows import AgreementRow, ComparisonRow, FailureRow, PulseRow, RecordRow
from rocking.reports import printing
from rocking.reports.printing import Cell, number, ratio, strong, table, whole, words
from rocking.tables import Row, rows_of

if TYPE_CHECKING:
    from pandas import DataFrame

R = TypeVar("R", bound=Row)

MOST_LISTED = 40
"""Rows of the longest list of single cases or failures; the CSV tables hold all."""
MOST_RECORDS = 200
"""Rows of the longest list of records."""


@dataclass(frozen=True)
class Listing(Generic[R]):
    """The first of some rows, and how many there are."""

    first: list[R]
    total: int

    @classmethod
    def of(cls, row_class: type[R], table: "DataFrame", most: int = MOST_LISTED) -> "Listing[R]":
        """Keep the first rows of `table`."""
        return cls(list(rows_of(row_class, table.head(most))), len(table))

    def rest(self, noun: str, file: str) -> str:
        """Return what is left out, as a sentence or nothing."""
        more = self.total - len(self.first)
        return f" Another {printing.counted(more, noun)} in {file}." if more > 0 else ""


def expert_sentences(agreement: Sequence[AgreementRow]) -> list[str]:
    """Return the three sentences that somebody who knows the method would say about this run."""
    rows = {row.light: row for row in agreement}
    if rows["all"].cases == 0:
        return [
            "There is no case with both a prediction and an integration, so nothing can be said about the closed form."
        ]
    return [_trust(rows), _overturning(rows), _undecided(rows)]


def _trust(rows: Mapping[str, AgreementRow]) -> str:
    green, every, red = rows["green"], rows["all"], rows["red"]
    said = f"One pulse can stand for the record (green) in {green.cases} of {every.cases} cases"
    if green.both_rock:
        said += (
            f"; where both rock there, the closed form is within a factor of two in {green.within_factor_two} of "
            f"{green.both_rock}, with a median ratio of {number(green.median_ratio)}"
        )
    if red.both_rock:
        said += f" (red: {red.within_factor_two} of {red.both_rock}, median {number(red.median_ratio)})"
    return f"{said}."


def _overturning(rows: Mapping[str, AgreementRow]) -> str:
    every, red = rows["all"], rows["red"]
    false = printing.counted(every.overturning_false, "case")
    if every.overturning == 0:
        return f"Nothing overturns in the full integration; the closed form overturns {false}."
    return (
        f"Of {every.overturning} overturnings in the full integration the closed form finds "
        f"{every.overturning_found} and misses {every.overturning_missed}, {red.overturning_missed} of these "
        f"under a red light; it overturns {false} that stay up."
    )


def _undecided(rows: Mapping[str, AgreementRow]) -> str:
    return (
        f"{printing.sentence(printing.counted(rows['all'].fragile, 'verdict'))} stand so close to a change that they "
        f"are not decided; {printing.counted(rows['red'].cases, 'case')} have a red light, where only the full "
        "integration may be used."
    )


def notices(records: "DataFrame", comparison: "DataFrame", failures: int) -> list[dict[str, object]]:
    """Return the warnings that stand above everything."""
    integrated = comparison["integrated_rotation_ratio"]
    found = []
    if records.empty:
        found.append("No record could be read, so there is no result; the failures below say why.")
    elif comparison.empty:
        found.append("No structure could be assessed under any record; the failures below say why.")
    elif (integrated == 0).all():
        found.append("No structure uplifts under any record.")
    spared = int((integrated.isna() & comparison["answer_rotation_ratio"].notna()).sum())
    if spared:
        found.append(
            f"{printing.sentence(printing.counted(spared, 'case'))} answered by a cheaper method than the full "
            "integration and left out of what compares the two; see answer_method in comparison.csv."
        )
    if failures:
        found.append(f"{printing.sentence(printing.counted(failures, 'failure'))}, listed below.")
    scaled = sorted(records.loc[records["scale_factor"] != 1, "record"].unique())
    if scaled:
        named = printing.listed(scaled, most=20)
        found.append(f"Accelerations multiplied by a declared factor, not as recorded: {named}.")
    return [{"strong": True, "text": text} for text in found]


def agreement_table(agreement: Sequence[AgreementRow]) -> dict[str, object]:
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
    return table(columns, [_agreement_row(row) for row in agreement])


def _agreement_row(row: AgreementRow) -> list[Cell]:
    return [
        printing.lamp(row.light),
        whole(row.records),
        whole(row.cases),
        whole(row.both_rock),
        whole(row.within_factor_two),
        number(row.median_ratio),
        whole(row.overturning),
        whole(row.overturning_found),
        strong(whole(row.overturning_missed), row.overturning_missed > 0),
        whole(row.overturning_false),
        whole(row.fragile),
    ]


def record_table(records: Listing[RecordRow], pulses: "DataFrame") -> dict[str, object]:
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
    dominant = pulses[(pulses["kind"] == "alternative") & (pulses["rank"] == 1)]
    known = dominant[dominant["record"].isin([row.record for row in records.first])]
    by_component = {(row.record, row.component): row for row in rows_of(PulseRow, known)}
    return table(
        columns, [_record_row(row, by_component.get((row.record, row.component))) for row in records.first]
    )


def _record_row(row: RecordRow, pulse: PulseRow | None) -> list[Cell]:
    scaled = row.scale_factor != 1
    return [
        row.record,
        words(row.component),
        strong(("×\u00a0" if scaled else "") + printing.given(row.scale_factor), scaled),
        number(row.peak_acceleration_m_s2),
        number(row.peak_velocity_m_s),
        number(pulse.amplitude_m_s2 if pulse else None),
        number(pulse.period_s if pulse else None),
        number(pulse.explained_energy if pulse else None),
        words(pulse.flags if pulse else None),
    ]


def case_table(cases: Listing[ComparisonRow]) -> dict[str, object]:
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


def _case_row(row: ComparisonRow) -> list[Cell]:
    return [
        row.record,
        words(row.component),
        row.structure,
        printing.lamp(row.light),
        ratio(row.predicted_rotation_ratio),
        strong(ratio(row.integrated_rotation_ratio)),
        words(row.regime),
        number(row.sensitivity),
        printing.yes_or_no(row.fragile),
    ]


def failure_table(failures: Listing[FailureRow]) -> dict[str, object]:
    """Return what gave no result, and why."""
    columns = [
        ("Record", "1", "l"),
        ("Comp.", "0.5", "l"),
        ("Structure", "0.8", "l"),
        ("Stage", "0.6", "l"),
        ("Why", "3", "l"),
    ]
    return table(
        columns,
        [
            [words(text) for text in (row.record, row.component, row.structure, row.stage, row.message)]
            for row in failures.first
        ],
    )
