"""The tables behind the verdicts of a record's report, from the rows of its CSV tables and nothing else."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rocking.assessment.method import Method
from rocking.assessment.rows.of_case import CandidateRow, ComparisonRow, MaximumRow
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import PulseRow, RecordRow
from rocking.assessment.rows.of_study import StructureRow
from rocking.assessment.rows.shared import CaseRow
from rocking.pulses import Flag
from rocking.reports import printing
from rocking.reports.printing import (
    Cell,
    number,
    percent,
    ratio,
    short,
    strong,
    table,
    table_of,
    with_unit,
    words,
)
from rocking.reports.record.verdict import contact_failure
from rocking.tables import Row

NO_BLOCK = 1.0
"""Defect from which on the block means nothing: it is as large as what is described."""


def structure_numbers(structures: Iterable[str], comparison: Iterable[CaseRow]) -> dict[str, str]:
    """Return the number by which each structure is called in the report, from 1, by name."""
    names = dict.fromkeys([*structures, *(row.structure for row in comparison)])
    return {name: str(place) for place, name in enumerate(names, start=1)}


def identity_table(rows: Sequence[RecordRow]) -> dict[str, object]:
    """Return what was read and done."""
    return facts_table(rows, _IDENTITY)


def facts_table(
    rows: Sequence[RecordRow], known: Mapping[str, Callable[[RecordRow], str]]
) -> dict[str, object]:
    """Return what is known by label: one column per component, or two columns of facts for a single one."""
    facts = [[label, *[show(row) for row in rows]] for label, show in known.items()]
    facts = [fact for fact in facts if set(fact[1:]) != {printing.NOTHING}]
    if len(rows) == 1:
        facts += [["", ""]] * (len(facts) % 2)
        half = len(facts) // 2
        columns = [("", "auto", "l"), ("", "1", "l"), ("", "auto", "l"), ("", "1", "l")]
        return table(columns, [left + right for left, right in zip(facts[:half], facts[half:], strict=True)])
    return table(
        [("", "auto", "l"), *[(f"Component {words(row.component)}", "1", "l") for row in rows]], facts
    )


_IDENTITY: dict[str, Callable[[RecordRow], str]] = {
    "Event": lambda row: words(row.event),
    "Station": lambda row: words(row.station),
    "File": lambda row: words(row.file),
    "Format": lambda row: words(row.format),
    "Unit in the file": lambda row: words(row.unit),
    "Licence": lambda row: words(row.licence),
    "Vertical component": lambda row: words(row.vertical_component),
    "Vertical peak acceleration": lambda row: with_unit(
        number(row.vertical_peak_acceleration_m_s2, 4), "m/s²"
    ),
    "Declared scale factor": lambda row: printing.given(row.scale_factor),
    "Samples": lambda row: printing.whole(row.samples),
    "Time step": lambda row: with_unit(printing.given(row.time_step_s), "s"),
    "Duration": lambda row: with_unit(printing.given(row.duration_s), "s"),
    "Peak acceleration": lambda row: with_unit(number(row.peak_acceleration_m_s2, 4), "m/s²"),
    "High-pass corner, known": lambda row: with_unit(printing.given(row.high_pass_frequency_hz), "Hz"),
    "Processing": lambda row: words(row.processing or "none"),
    "Noticed by the reader": lambda row: words(row.warnings),
}


def pulse_table(rows: Sequence[PulseRow]) -> dict[str, object]:
    """Return the pulses of one component."""
    return table_of(
        rows,
        ("Kind", "auto", "l", lambda row: row.kind),
        ("Rank", "auto", "r", lambda row: printing.whole(row.rank)),
        ("Amplitude [m/s²]", "1.2", "r", lambda row: number(row.amplitude_m_s2)),
        ("Period [s]", "1.2", "r", lambda row: number(row.period_s)),
        ("Circular frequency [rad/s]", "1.1", "r", lambda row: number(row.circular_frequency_rad_s)),
        ("Start [s]", "0.7", "r", lambda row: number(row.start_time_s)),
        ("Gain ratio [-]", "0.7", "r", lambda row: number(row.gain_ratio)),
        ("Explained energy [-]", "0.8", "r", lambda row: number(row.explained_energy)),
        ("Effective length [m]", "0.8", "r", lambda row: number(row.effective_length_m)),
    )


def pulse_sentences(rows: Sequence[PulseRow]) -> list[str]:
    """Return the doubts about the dominant pulse, in sentences."""
    known = {flag.value: flag.sentence for flag in Flag}
    flags = [flag for row in rows[:1] for flag in row.flags]
    return [known.get(flag, printing.sentence(f"{flag}.")) for flag in flags]


def structure_table(rows: Iterable[StructureRow], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the structures with their equivalent blocks."""
    return table_of(
        rows,
        ("No.", "auto", "r", lambda row: numbers[row.structure]),
        ("Structure", "1.4", "l", lambda row: short(row.structure)),
        ("Type and geometry", "2.6", "l", _geometry),
        ("p [rad/s]", "auto", "r", lambda row: number(row.frequency_parameter_rad_s, 4)),
        ("Critical rotation [rad]", "0.7", "r", lambda row: number(row.critical_rotation_rad, 4)),
        ("Uplift λ [g]", "0.55", "r", lambda row: number(row.uplift_multiplier, 4)),
        ("Scale, linear\u00adised [-]", "0.6", "r", lambda row: number(row.acceleration_scale_linearised, 4)),
        ("Scale, uplift [-]", "0.55", "r", lambda row: number(row.acceleration_scale_uplift, 4)),
        ("Resti\u00adtution [-]", "0.55", "r", lambda row: number(row.restitution, 4)),
    )


def _geometry(row: StructureRow) -> Cell:
    """Type and sizes, and below them how far the structure is from the block that is exact at rest."""
    said = {"text": f"{words(row.type)}: {row.geometry}", "strong": False}
    if math.isnan(row.restoring_defect + row.forcing_defect):
        return {**said}
    restoring, forcing = (f"{percent(each)}\u00a0%" for each in (row.restoring_defect, row.forcing_defect))
    word = "no block, which misses" if row.restoring_defect >= NO_BLOCK else "a block to"
    return {**said, "below": f"{word} {restoring} in restoring and {forcing} in forcing"}


def method_table(tables: RecordTables, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return every method beside the others, one row per component and structure."""
    return table_of(
        _cases(tables),
        ("No.", "auto", "r", lambda case: numbers[case.row.structure]),
        ("Comp.", "auto", "l", lambda case: words(case.row.component)),
        (
            "Eq. 15, printed",
            "1",
            "r",
            lambda case: case.ratio(Method.PRINTED),
        ),
        ("Prediction", "1", "r", lambda case: ratio(case.row.predicted_rotation_ratio)),
        (
            "Mechanism under the pulse",
            "1",
            "r",
            lambda case: case.ratio(Method.MECHANISM_ON_PULSE),
        ),
        (
            "Block under the record",
            "1",
            "r",
            lambda case: case.ratio(Method.BLOCK_ON_RECORD),
        ),
        (
            "Mechanism under the record",
            "1",
            "r",
            lambda case: strong(ratio(case.row.integrated_rotation_ratio, 6)),
        ),
        (
            "Rotation [rad]",
            "1",
            "r",
            lambda case: number(_of(case.response, "rotation_rad"), 5),
        ),
        (
            "Peak at [s]",
            "0.7",
            "r",
            lambda case: number(_of(case.response, "peak_time_s"), 4),
        ),
        (
            "Im\u00adpacts",
            "0.6",
            "r",
            lambda case: printing.whole(_of(case.response, "impacts")),
        ),
    )


def trust_table(tables: RecordTables, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return what stands behind each prediction, and whether the contacts hold along each response."""
    return table_of(
        _cases(tables),
        ("No.", "auto", "r", lambda case: numbers[case.row.structure]),
        ("Comp.", "auto", "l", lambda case: words(case.row.component)),
        (
            "Pulse rank",
            "0.6",
            "r",
            lambda case: printing.whole(_of(case.prediction, "pulse_rank")),
        ),
        (
            "Amplitude ratio [-]",
            "1",
            "r",
            lambda case: number(_of(case.prediction, "amplitude_ratio")),
        ),
        (
            "Frequency ratio [-]",
            "1",
            "r",
            lambda case: number(_of(case.prediction, "frequency_ratio")),
        ),
        (
            "Friction needed [-]",
            "1",
            "r",
            lambda case: number(_of(case.response, "friction_needed")),
        ),
        ("Contacts", "1.1", "l", lambda case: _contacts(case.response)),
    )


def _of(row: Row | None, column: str) -> Any:
    return None if row is None else getattr(row, column)


def _contacts(response: MaximumRow | None) -> Cell:
    failing = contact_failure(response) if response else ""
    holding = "hold" if response and response.slides is False else printing.NOTHING
    return strong(failing or holding, bool(failing))


@dataclass(frozen=True)
class _Case:
    """One case with what each method says of it."""

    row: ComparisonRow
    maxima: dict[Method, MaximumRow]

    @property
    def prediction(self) -> MaximumRow | None:
        return self.maxima.get(Method.CLOSED_FORM)

    @property
    def response(self) -> MaximumRow | None:
        return self.maxima.get(Method.MECHANISM_ON_RECORD)

    def ratio(self, method: Method) -> str:
        return ratio(_of(self.maxima.get(method), "rotation_ratio"))


def _cases(tables: RecordTables) -> list[_Case]:
    by_method = {method: tables.by_method(method) for method in Method}
    return [
        _Case(row, {method: rows[row.case] for method, rows in by_method.items() if row.case in rows})
        for row in tables.comparison
    ]


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


def processing_table(rows: Sequence[MaximumRow], numbers: Mapping[str, str]) -> dict[str, object]:
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
