"""The tables behind the verdicts of a record's report, from the rows of its CSV tables and nothing else."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeVar

from rocking.assessment.method import Method
from rocking.assessment.rows import (
    CaseRow,
    ComparisonRow,
    PredictionRow,
    PulseRow,
    RecordRow,
    RecordTables,
    ResponseRow,
    StructureRow,
)
from rocking.pulses.flags import Flag
from rocking.reports import printing
from rocking.reports.printing import Cell, number, ratio, strong, table, words
from rocking.reports.record.verdict import contact_failure

M = TypeVar("M", PredictionRow, ResponseRow)


def structure_numbers(structures: Iterable[str], comparison: Iterable[CaseRow]) -> dict[str, str]:
    """Return the number by which each structure is called in the report, from 1, by name."""
    names = dict.fromkeys([*structures, *(row.structure for row in comparison)])
    return {name: str(place) for place, name in enumerate(names, start=1)}


def identity_table(rows: Sequence[RecordRow]) -> dict[str, object]:
    """Return what was read and done: one column per component, or two columns of facts for a single one."""
    facts = [[label, *[show(row) for row in rows]] for label, show in _IDENTITY.items()]
    facts = [fact for fact in facts if set(fact[1:]) != {printing.NOTHING}]
    if len(rows) == 1:
        facts += [["", ""]] * (len(facts) % 2)
        half = len(facts) // 2
        columns = [("", "auto", "l"), ("", "1", "l"), ("", "auto", "l"), ("", "1", "l")]
        return table(columns, [left + right for left, right in zip(facts[:half], facts[half:], strict=True)])
    return table(
        [("", "auto", "l"), *[(f"Component {words(row.component)}", "1", "l") for row in rows]], facts
    )


def _with_unit(text: str, unit: str) -> str:
    return text if text == printing.NOTHING or not unit else f"{text} {unit}"


_IDENTITY: dict[str, Callable[[RecordRow], str]] = {
    "Event": lambda row: words(row.event),
    "Station": lambda row: words(row.station),
    "File": lambda row: words(row.file),
    "Format": lambda row: words(row.format),
    "Unit in the file": lambda row: words(row.unit),
    "Licence": lambda row: words(row.licence),
    "Vertical component": lambda row: words(row.vertical_component),
    "Vertical peak acceleration": lambda row: _with_unit(
        number(row.vertical_peak_acceleration_m_s2, 4), "m/s²"
    ),
    "Declared scale factor": lambda row: printing.given(row.scale_factor),
    "Samples": lambda row: printing.whole(row.samples),
    "Time step": lambda row: _with_unit(printing.given(row.time_step_s), "s"),
    "Duration": lambda row: _with_unit(printing.given(row.duration_s), "s"),
    "Peak acceleration": lambda row: _with_unit(number(row.peak_acceleration_m_s2, 4), "m/s²"),
    "Peak velocity": lambda row: _with_unit(number(row.peak_velocity_m_s, 4), "m/s"),
    "Peak displacement": lambda row: _with_unit(number(row.peak_displacement_m, 4), "m"),
    "High-pass corner, known": lambda row: _with_unit(printing.given(row.high_pass_frequency_hz), "Hz"),
    "Processing": lambda row: words(row.processing or "none"),
    "Noticed by the reader": lambda row: words(row.warnings),
}


def pulse_table(rows: Sequence[PulseRow]) -> dict[str, object]:
    """Return the pulses of one component."""
    columns = [
        ("Kind", "auto", "l"),
        ("Rank", "auto", "r"),
        ("Amplitude [m/s²]", "1.2", "r"),
        ("Period [s]", "1.2", "r"),
        ("Circular frequency [rad/s]", "1.1", "r"),
        ("Start [s]", "0.7", "r"),
        ("Gain ratio [-]", "0.7", "r"),
        ("Explained energy [-]", "0.8", "r"),
        ("Effective length [m]", "0.8", "r"),
    ]
    return table(columns, [_pulse_row(row) for row in rows])


def _pulse_row(row: PulseRow) -> list[Cell]:
    return [
        row.kind,
        printing.whole(row.rank),
        _with_interval(row.amplitude_m_s2, row.amplitude_low_m_s2, row.amplitude_high_m_s2),
        _with_interval(row.period_s, row.period_low_s, row.period_high_s),
        number(row.circular_frequency_rad_s),
        number(row.start_time_s),
        number(row.gain_ratio),
        number(row.explained_energy),
        number(row.effective_length_m),
    ]


def _with_interval(middle: float, low: float, high: float) -> str:
    known = not math.isnan(low + high)
    return f"{number(middle)} [{number(low)}, {number(high)}]" if known else number(middle)


def pulse_sentences(rows: Sequence[PulseRow]) -> list[str]:
    """Return the doubts about the dominant pulse, in sentences."""
    known = {flag.value: flag.sentence for flag in Flag}
    flags = [flag for row in rows[:1] for flag in row.flags]
    return [known.get(flag, printing.sentence(f"{flag}.")) for flag in flags]


def structure_table(rows: Iterable[StructureRow], numbers: Mapping[str, str]) -> dict[str, object]:
    """Return the structures with their equivalent blocks."""
    columns = [
        ("No.", "auto", "r"),
        ("Structure", "1.2", "l"),
        ("Type and geometry", "2.4", "l"),
        ("p [rad/s]", "auto", "r"),
        ("Critical rotation [rad]", "0.7", "r"),
        ("Uplift λ [g]", "0.55", "r"),
        ("Scale, linear\u00adised [-]", "0.6", "r"),
        ("Scale, uplift [-]", "0.55", "r"),
        ("Linear\u00adised λ / λ [-]", "0.6", "r"),
        ("Resti\u00adtution [-]", "0.55", "r"),
    ]
    return table(columns, [_structure_row(row, numbers) for row in rows])


def _structure_row(row: StructureRow, numbers: Mapping[str, str]) -> list[Cell]:
    return [
        numbers[row.structure],
        row.structure,
        f"{words(row.type)}: {printing.geometry(row.geometry)}",
        number(row.frequency_parameter_rad_s, 4),
        number(row.critical_rotation_rad, 4),
        number(row.uplift_multiplier, 4),
        number(row.acceleration_scale_linearised, 4),
        number(row.acceleration_scale_uplift, 4),
        number(row.linearised_over_true_uplift, 4),
        number(row.restitution, 4),
    ]


def method_table(tables: RecordTables, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return every method beside the others, one row per component and structure."""
    columns = [
        ("No.", "auto", "r"),
        ("Comp.", "auto", "l"),
        ("Eq. 15, printed", "1", "r"),
        ("Prediction", "1", "r"),
        ("Range over the interval", "1.95", "r"),
        ("Mechanism under the pulse", "1", "r"),
        ("Block under the record", "1", "r"),
        ("Mechanism under the record", "1", "r"),
        ("Rotation [rad]", "1", "r"),
        ("Peak at [s]", "0.7", "r"),
        ("Im\u00adpacts", "0.6", "r"),
    ]
    predictions = _by_case(tables.predictions, Method.CLOSED_FORM)
    responses = _by_case(tables.responses, Method.MECHANISM_ON_RECORD)
    return table(
        columns,
        [
            _method_row(row, predictions.get(row.case), responses.get(row.case), numbers)
            for row in tables.comparison
        ],
    )


def _method_row(
    row: ComparisonRow,
    prediction: PredictionRow | None,
    response: ResponseRow | None,
    numbers: Mapping[str, str],
) -> list[Cell]:
    return [
        numbers[row.structure],
        words(row.component),
        ratio(row.printed_rotation_ratio),
        ratio(row.predicted_rotation_ratio),
        _range(prediction),
        ratio(row.pulse_rotation_ratio),
        ratio(row.block_rotation_ratio),
        strong(ratio(row.integrated_rotation_ratio, 6)),
        number(response.rotation_rad if response else None, 5),
        number(response.peak_time_s if response else None, 4),
        printing.whole(response.impacts if response else None),
    ]


def trust_table(tables: RecordTables, numbers: Mapping[str, str]) -> dict[str, object]:
    """Return what stands behind each prediction, and whether the contacts hold along each response."""
    columns = [
        ("No.", "auto", "r"),
        ("Comp.", "auto", "l"),
        ("Light", "auto", "l"),
        ("Pulse rank", "0.6", "r"),
        ("Amplitude ratio [-]", "1", "r"),
        ("Frequency ratio [-]", "1", "r"),
        ("Within factor 2 [-]", "1", "r"),
        ("Overturnings found [-]", "1.2", "r"),
        ("Records behind", "0.8", "r"),
        ("Friction needed [-]", "1", "r"),
        ("Contacts", "1.1", "l"),
    ]
    predictions = _by_case(tables.predictions, Method.CLOSED_FORM)
    responses = _by_case(tables.responses, Method.MECHANISM_ON_RECORD)
    return table(
        columns,
        [
            _trust_row(row, predictions.get(row.case), responses.get(row.case), numbers)
            for row in tables.comparison
        ],
    )


def _trust_row(
    row: ComparisonRow,
    prediction: PredictionRow | None,
    response: ResponseRow | None,
    numbers: Mapping[str, str],
) -> list[Cell]:
    failing = contact_failure(response) if response else ""
    holding = "hold" if response and response.slides is False else printing.NOTHING
    return [
        numbers[row.structure],
        words(row.component),
        printing.lamp(row.light),
        printing.whole(prediction.pulse_rank if prediction else None),
        number(prediction.amplitude_ratio if prediction else None),
        number(prediction.frequency_ratio if prediction else None),
        number(row.reliability_within_factor_two),
        number(row.reliability_overturnings_found),
        printing.whole(row.reliability_records),
        number(response.friction_needed if response else None),
        strong(failing or holding, bool(failing)),
    ]


def _range(prediction: PredictionRow | None) -> str:
    if prediction is None:
        return printing.NOTHING
    low, high = ratio(prediction.rotation_ratio_low), ratio(prediction.rotation_ratio_high)
    return low if low == high else f"{low} to {high}"


def _by_case(rows: Iterable[M], method: Method) -> dict[tuple[str, str], M]:
    return {row.case: row for row in rows if row.method is method}
