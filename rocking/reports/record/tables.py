"""The tables behind the verdicts of a record's report, from the rows of its CSV tables and nothing else."""

from collections.abc import Mapping, Sequence

from rocking.pulses.flags import Flag
from rocking.reports import printing
from rocking.reports.printing import Cell, Row, number, of_component, ratio, strong, table, words
from rocking.reports.record.verdict import contact_failure

Rows = Sequence[Row]
Tables = Mapping[str, Rows]


def structure_numbers(tables: Tables) -> dict[str, str]:
    """Return the number by which each structure is called in the report, from 1, by name."""
    names = [row["structure"] for row in tables["structures"]]
    names += [row["structure"] for row in tables["comparison"] if row["structure"] not in names]
    return {name: str(place) for place, name in enumerate(dict.fromkeys(names), start=1)}


def identity_table(rows: Rows) -> dict[str, object]:
    """Return what was read and done: one column per component, or two columns of facts for a single one."""
    facts = [[label, *[show(row) for row in rows]] for label, show in _IDENTITY]
    facts = [fact for fact in facts if set(fact[1:]) != {printing.NOTHING}]
    if len(rows) == 1:
        facts += [["", ""]] * (len(facts) % 2)
        half = len(facts) // 2
        columns = [("", "auto", "l"), ("", "1", "l"), ("", "auto", "l"), ("", "1", "l")]
        return table(columns, [left + right for left, right in zip(facts[:half], facts[half:], strict=True)])
    return table(
        [("", "auto", "l"), *[(f"Component {words(row['component'])}", "1", "l") for row in rows]], facts
    )


def _plain(column: str):
    return lambda row: words(row[column])


def _rounded(column: str, unit: str, digits: int = 4):
    return lambda row: _with_unit(number(row[column], digits), unit)


def _chosen(column: str, unit: str):
    return lambda row: _with_unit(printing.given(row[column]), unit)


def _with_unit(text: str, unit: str) -> str:
    return text if text == printing.NOTHING or not unit else f"{text} {unit}"


_IDENTITY = (
    ("Event", _plain("event")),
    ("Station", _plain("station")),
    ("File", _plain("file")),
    ("Format", _plain("format")),
    ("Unit in the file", _plain("unit")),
    ("Licence", _plain("licence")),
    ("Vertical component", lambda row: words(row.get("vertical_component", ""))),
    (
        "Vertical peak acceleration",
        lambda row: _with_unit(number(row.get("vertical_peak_acceleration_m_s2", ""), 4), "m/s²"),
    ),
    ("Declared scale factor", _chosen("scale_factor", "")),
    ("Samples", lambda row: printing.whole(row["samples"])),
    ("Time step", _chosen("time_step_s", "s")),
    ("Duration", _chosen("duration_s", "s")),
    ("Peak acceleration", _rounded("peak_acceleration_m_s2", "m/s²")),
    ("Peak velocity", _rounded("peak_velocity_m_s", "m/s")),
    ("Peak displacement", _rounded("peak_displacement_m", "m")),
    ("High-pass corner, known", _chosen("high_pass_frequency_hz", "Hz")),
    ("Processing", lambda row: row["processing"] or "none"),
    ("Noticed by the reader", _plain("warnings")),
)


def pulse_table(rows: Rows) -> dict[str, object]:
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


def _pulse_row(row: Row) -> list[Cell]:
    return [
        row["kind"],
        printing.whole(row["rank"]),
        _with_interval(row, "amplitude", "_m_s2"),
        _with_interval(row, "period", "_s"),
        number(row["circular_frequency_rad_s"]),
        number(row["start_time_s"]),
        number(row["gain_ratio"]),
        number(row["explained_energy"]),
        number(row["effective_length_m"]),
    ]


def _with_interval(row: Row, quantity: str, unit: str) -> str:
    middle = number(row[quantity + unit])
    low, high = row[f"{quantity}_low{unit}"], row[f"{quantity}_high{unit}"]
    return f"{middle} [{number(low)}, {number(high)}]" if low and high else middle


def pulse_sentences(rows: Rows) -> list[str]:
    """Return the doubts about the dominant pulse, in sentences."""
    flags = [flag for row in rows[:1] for flag in row["flags"].split("; ") if flag]
    known = {flag.value: flag.sentence for flag in Flag}
    return [known.get(flag, printing.sentence(f"{flag}.")) for flag in flags]


def structure_table(rows: Rows, numbers: Mapping[str, str]) -> dict[str, object]:
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


def _structure_row(row: Row, numbers: Mapping[str, str]) -> list[Cell]:
    return [
        numbers[row["structure"]],
        row["structure"],
        f"{words(row['type'])}: {printing.geometry(row['geometry'])}",
        number(row["frequency_parameter_rad_s"], 4),
        number(row["critical_rotation_rad"], 4),
        number(row["uplift_multiplier"], 4),
        number(row["acceleration_scale_linearised"], 4),
        number(row["acceleration_scale_uplift"], 4),
        number(row["linearised_over_true_uplift"], 4),
        number(row["restitution"], 4),
    ]


def method_table(tables: Tables, numbers: Mapping[str, str]) -> dict[str, object]:
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
    return table(columns, [_method_row(tables, row, numbers) for row in tables["comparison"]])


def _method_row(tables: Tables, row: Row, numbers: Mapping[str, str]) -> list[Cell]:
    prediction = _of_method(tables["predictions"], row, "closed form")
    response = _of_method(tables["responses"], row, "mechanism on record")
    return [
        numbers[row["structure"]],
        words(row["component"]),
        ratio(row["printed_rotation_ratio"]),
        ratio(row["predicted_rotation_ratio"]),
        _range(
            ratio(prediction.get("rotation_ratio_low", "")), ratio(prediction.get("rotation_ratio_high", ""))
        ),
        ratio(row["pulse_rotation_ratio"]),
        ratio(row["block_rotation_ratio"]),
        strong(ratio(row["integrated_rotation_ratio"], 6)),
        number(response.get("rotation_rad", ""), 5),
        number(response.get("peak_time_s", ""), 4),
        printing.whole(response.get("impacts", "")),
    ]


def trust_table(tables: Tables, numbers: Mapping[str, str]) -> dict[str, object]:
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
    return table(columns, [_trust_row(tables, row, numbers) for row in tables["comparison"]])


def _trust_row(tables: Tables, row: Row, numbers: Mapping[str, str]) -> list[Cell]:
    prediction = _of_method(tables["predictions"], row, "closed form")
    response = _of_method(tables["responses"], row, "mechanism on record")
    failing = contact_failure(response)
    return [
        numbers[row["structure"]],
        words(row["component"]),
        printing.lamp(row["light"]),
        printing.whole(prediction.get("pulse_rank", "")),
        number(prediction.get("amplitude_ratio", "")),
        number(prediction.get("frequency_ratio", "")),
        number(row.get("reliability_within_factor_two", "")),
        number(row.get("reliability_overturnings_found", "")),
        printing.whole(row.get("reliability_records", "")),
        number(response.get("friction_needed", "")),
        strong(failing) if failing else {"false": "hold"}.get(response.get("slides", ""), printing.NOTHING),
    ]


def _range(low: str, high: str) -> str:
    return low if low == high else f"{low} to {high}"


def _of_method(rows: Rows, case: Row, method: str) -> Row:
    same = (row for row in of_component(rows, case["component"]) if row["structure"] == case["structure"])
    return next((row for row in same if row["method"] == method), {})
