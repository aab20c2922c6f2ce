"""The report over all records, and the agreement that is counted for it."""

import json
import math
import re

from rocking.assessment.agreement import agreement_rows
from rocking.assessment.columns import AGREEMENT, SUMMARY_TABLES
from rocking.reports.style import svg
from rocking.reports.summary.figures import prediction_scatter
from rocking.reports.summary.report import summary_data, summary_report
from rocking.tables import StoredRows, csv_cells, csv_lines, write_table

from .conftest import SETTINGS


def case(
    light: str, predicted: str, integrated: str, record: str = "one", fragile: str = "false"
) -> dict[str, str]:
    """One row of the comparison table, as much of it as the summary reads."""
    both = "INF" not in (predicted, integrated) and float(predicted) > 0 and float(integrated) > 0
    ratio = float(predicted) / float(integrated) if both else math.nan
    fell = (predicted == "INF") - (integrated == "INF")
    return {
        "record": record,
        "component": "EW",
        "structure": "block",
        "light": light,
        "predicted_rotation_ratio": predicted,
        "integrated_rotation_ratio": integrated,
        "prediction_over_integration": repr(ratio) if both else "",
        "within_factor_two": str(0.5 <= ratio <= 2).lower() if both else "",
        "verdict": {-1: "unsafe", 0: "agree", 1: "safe"}[fell],
        "regime": "Eq. 15 exact",
        "sensitivity": "2.5",
        "fragile": fragile,
    }


CASES = [
    case("green", "0.5", "0.4"),
    case("green", "INF", "INF"),
    case("amber", "INF", "0.8", "two"),
    case("red", "0.1", "INF", "two"),
    case("red", "0.1", "0.7", "three", "true"),
]


def summary_tables(comparison, **others):
    return {name: [] for name in ("record", "pulses", "maxima", "structures", "failures")} | {
        "comparison": comparison,
        "agreement": [csv_cells(AGREEMENT, row) for row in agreement_rows(comparison)],
        **others,
    }


def _summarised(tables):
    counted = [csv_cells(AGREEMENT, row) for row in agreement_rows(tables["comparison"])]
    return tables | {"maxima": [], "agreement": counted}


def test_agreement_counts_each_light_and_all():
    rows = {row["light"]: row for row in agreement_rows(CASES)}
    assert [rows[light]["cases"] for light in ("green", "amber", "red", "all")] == [2, 1, 2, 5]
    assert rows["all"] | {"median_ratio": None} == {
        "light": "all",
        "records": 3,
        "cases": 5,
        "both_rock": 2,
        "within_factor_two": 1,
        "median_ratio": None,
        "overturning": 2,
        "overturning_found": 1,
        "overturning_missed": 1,
        "overturning_false": 1,
        "fragile": 1,
    }
    assert rows["green"]["median_ratio"] == 1.25
    assert len(list(csv_lines(AGREEMENT, rows.values()))) == 5


def test_the_three_sentences_say_the_counts():
    sentences = summary_data(summary_tables(CASES), SETTINGS)["sentences"]
    assert len(sentences) == 3
    assert "green) in 2 of 5 cases" in sentences[0]
    assert "Of 2 overturnings" in sentences[1] and "misses 1, 1 of these under a red light" in sentences[1]
    assert "Two cases have a red light" in sentences[2] or "two cases have a red light" in sentences[2]


def test_unsafe_and_fragile_cases_are_listed():
    data = summary_data(summary_tables(CASES), SETTINGS)
    assert len(data["unsafe"]["rows"]) == len(data["fragile"]["rows"]) == 1
    assert data["unsafe"]["rows"][0][5] == {"text": "overturns", "strong": True}


def test_a_study_without_a_readable_record_says_so_first():
    failure = {
        "record": "bad",
        "component": "",
        "structure": "",
        "stage": "read",
        "message": "bad.at2: is empty.",
    }
    tables = summary_tables([], failures=[failure])
    assert "No record could be read" in summary_data(tables, SETTINGS)["notices"][0]["text"]
    assert summary_report(tables, SETTINGS).startswith(b"%PDF")


def test_the_summary_of_a_record_is_the_same_twice_and_names_its_factor(hostile):
    tables = _summarised(hostile.tables)
    assert summary_report(tables, SETTINGS) == summary_report(tables, SETTINGS)
    assert any("declared factor" in notice["text"] for notice in summary_data(tables, SETTINGS)["notices"])


def test_the_trade_is_drawn_where_it_was_measured():
    case = {
        "record": "one",
        "component": "EW",
        "structure": "block",
        "tolerance": "",
        "verdict_agrees": "true",
    }
    trade = [
        case | {"method": "printed", "error": "0.5", "duration_s": "5e-6"},
        case | {"method": "block on record", "error": "0.02", "duration_s": "2e-5"},
    ]
    (drawn,) = summary_data(summary_tables(CASES, trade=trade), SETTINGS)["trade"]
    assert "Eq. 15 as printed" in drawn["svg"] and "equivalent block on the record" in drawn["svg"]
    assert summary_data(summary_tables(CASES), SETTINGS)["trade"] == []
    assert summary_report(summary_tables(CASES, trade=trade), SETTINGS).startswith(b"%PDF")


def test_rows_read_anew_from_a_file_give_the_report_of_rows_in_memory(example, tmp_path):
    tables = _summarised(example.tables)
    stored = {}
    for name in ("record", "pulses", "comparison", "failures"):
        path = tmp_path / f"{name}.csv"
        table = {table.name: table for table in SUMMARY_TABLES}[name]
        write_table(table, [dict(row) for row in tables[name]], path)
        stored[name] = StoredRows(path)
    assert summary_data(tables | stored, SETTINGS) == summary_data(tables, SETTINGS)


def test_long_lists_are_cut_and_say_how_much_was_left_out():
    unsafe = [case("red", "0.0", f"0.{place:03d}") | {"verdict": "unsafe"} for place in range(1, 101)]
    fallen = [case("red", "0.1", "INF", "fallen")]
    records = [
        {"record": f"r{k}", "component": "EW", "scale_factor": "2"}
        | dict.fromkeys(("peak_acceleration_m_s2", "peak_velocity_m_s"), "1.0")
        for k in range(250)
    ]
    data = summary_data(summary_tables([*unsafe, *fallen], record=records), SETTINGS)
    names = [row[0] for row in data["unsafe"]["rows"]]
    assert names[0] == "fallen" and len(names) == 40
    assert data["unsafe"]["rows"][1][5] == {"text": "0.100", "strong": True}, "the worst first"
    assert data["unsafe-note"] == " Another 61 cases in comparison.csv."
    assert (
        len(data["records"]["rows"]) == 200
        and data["records-note"] == " Another 50 components in record.csv."
    )
    assert "and 230 others" in data["notices"][-1]["text"]


def test_a_scatter_of_many_cases_does_not_grow_with_them():
    sizes = [
        len(svg(prediction_scatter([case("red", repr(0.1 + k / number), "0.5") for k in range(number)])))
        for number in (6000, 60000)
    ]
    assert sizes[1] < 1.5 * sizes[0] < 1.5 * 2e5


def test_the_scatter_marks_the_lights_by_shape(example):
    data = summary_data(_summarised(example.tables), SETTINGS)
    drawn = data["scatter"][0]["svg"]
    assert {"green light", "amber light", "red light"} <= set(re.findall(r"\w+ light", drawn))
    assert json.dumps(data)


def test_a_case_without_a_prediction_is_not_counted_in_the_scatter():
    unknown = case("green", "0.5", "0.5") | {"predicted_rotation_ratio": ""}
    figure = prediction_scatter([unknown, case("green", "0.4", "0.5"), case("red", "INF", "0.5")])
    labels = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert labels == ["green light (1)", "amber light (0)", "red light (1)"]
