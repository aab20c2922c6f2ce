"""The tables and sentences of the summary, from the rows of its CSV tables."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_record import FailureRow, PulseRow, RecordRow
from rocking.assessment.rows.of_study import AgreementRow
from rocking.reports import printing
from rocking.reports.printing import Cell, number, ratio, strong, table_of, whole, words
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
    """Return what the comparison of closed form and integration amounts to, in sentences."""
    every = agreement[0]
    if every.cases == 0:
        return [
            "There is no case with both a prediction and an integration, so nothing can be said about the closed form."
        ]
    return [_trust(every), _overturning(every)]


def _trust(every: AgreementRow) -> str:
    if not every.both_rock:
        return f"In none of {every.cases} cases do both the closed form and the integration rock."
    return (
        "Where both rock, the closed form is within a factor of two of the integration in "
        f"{every.within_factor_two} of {every.both_rock} cases, with a median ratio of {number(every.median_ratio)}."
    )


def _overturning(every: AgreementRow) -> str:
    false = printing.counted(every.overturning_false, "case")
    if every.overturning == 0:
        return f"Nothing overturns in the full integration; the closed form overturns {false}."
    return (
        f"Of {every.overturning} overturnings in the full integration the closed form finds "
        f"{every.overturning_found} and misses {every.overturning_missed}; it overturns {false} "
        f"that {'stays' if every.overturning_false == 1 else 'stay'} up."
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
    spared = int((integrated.isna() & (comparison["answer_outcome"] != "failed")).sum())
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
    """Return how often the closed form was right, by structure."""
    return table_of(
        agreement,
        ("Structure", "1.6", "l", lambda row: row.structure or "all"),
        ("Records", "0.8", "r", lambda row: whole(row.records)),
        ("Cases", "0.8", "r", lambda row: whole(row.cases)),
        ("Both rock", "0.8", "r", lambda row: whole(row.both_rock)),
        ("within factor 2", "0.8", "r", lambda row: whole(row.within_factor_two)),
        ("Median ratio [-]", "0.8", "r", lambda row: number(row.median_ratio)),
        ("Overturn", "0.9", "r", lambda row: whole(row.overturning)),
        ("found", "0.7", "r", lambda row: whole(row.overturning_found)),
        ("missed", "0.7", "r", lambda row: strong(whole(row.overturning_missed), row.overturning_missed > 0)),
        ("only predicted", "0.9", "r", lambda row: whole(row.overturning_false)),
    )


def record_table(records: Listing[RecordRow], pulses: "DataFrame") -> dict[str, object]:
    """Return the records with their dominant pulses."""
    dominant = pulses[(pulses["kind"] == "alternative") & (pulses["rank"] == 1)]
    known = dominant[dominant["record"].isin([row.record for row in records.first])]
    by_component = {(row.record, row.component): row for row in rows_of(PulseRow, known)}

    return table_of(
        ((row, by_component.get((row.record, row.component))) for row in records.first),
        ("Record", "1.6", "l", lambda each: each[0].record),
        ("Comp.", "0.8", "l", lambda each: words(each[0].component)),
        ("Declared factor", "0.7", "r", lambda each: _factor(each[0].scale_factor)),
        ("Peak acceleration [m/s²]", "1", "r", lambda each: number(each[0].peak_acceleration_m_s2)),
        ("Peak velocity [m/s]", "0.9", "r", lambda each: number(each[0].peak_velocity_m_s)),
        ("Pulse amplitude [m/s²]", "0.9", "r", lambda each: number(each[1] and each[1].amplitude_m_s2)),
        ("Pulse period [s]", "0.8", "r", lambda each: number(each[1] and each[1].period_s)),
        ("Explained energy [-]", "0.9", "r", lambda each: number(each[1] and each[1].explained_energy)),
        ("Flags", "1.2", "l", lambda each: words(each[1] and each[1].flags)),
    )


def _factor(scale_factor: float) -> Cell:
    scaled = scale_factor != 1
    return strong(("×\u00a0" if scaled else "") + printing.given(scale_factor), scaled)


def case_table(cases: Listing[ComparisonRow]) -> dict[str, object]:
    """Return single cases of the comparison table."""
    return table_of(
        cases.first,
        ("Record", "1.4", "l", lambda row: row.record),
        ("Comp.", "0.7", "l", lambda row: words(row.component)),
        ("Structure", "1.4", "l", lambda row: row.structure),
        ("Closed form", "auto", "r", lambda row: ratio(row.predicted_rotation_ratio)),
        ("Full integration", "auto", "r", lambda row: strong(ratio(row.integrated_rotation_ratio))),
        ("Regime of the closed form", "1.4", "l", lambda row: words(row.regime)),
        ("The closed form is", "1.2", "l", lambda row: words(row.prediction_in_words)),
    )


def failure_table(failures: Listing[FailureRow]) -> dict[str, object]:
    """Return what gave no result, and why."""
    return table_of(
        failures.first,
        ("Record", "1", "l", lambda row: words(row.record)),
        ("Comp.", "0.5", "l", lambda row: words(row.component)),
        ("Structure", "0.8", "l", lambda row: words(row.structure)),
        ("Stage", "0.6", "l", lambda row: words(row.stage)),
        ("Why", "3", "l", lambda row: words(row.message)),
    )
