"""The report over all records, and the agreement that is counted for it."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import rocking
from rocking.assessment.methods import (
    Agreement,
    agreement,
    within_factor_two,
)
from rocking.assessment.rows import (
    ComparisonRow,
    FailureRow,
    RecordRow,
    RecordRows,
    TimingRow,
    VerdictRow,
    agreement_rows,
)
from rocking.fragility.measures import compared
from rocking.products.fragility.report import fragility_data, fragility_figure, fragility_table, ida_frame
from rocking.products.fragility.rows import FragilityRow, FragilitySummaryRow, IdaRow, IntensityMeasureRow
from rocking.products.fragility.work import Fragilities
from rocking.reports.design_figure import (
    MOST_LINES,
    component_spectra,
    design_summary_figure,
    spectrum_periods,
)
from rocking.reports.explore import explore_page
from rocking.reports.pages import Section, TableCell
from rocking.reports.scatter import prediction_scatter
from rocking.reports.style import svg
from rocking.reports.summary import outcomes_figure, severity_map, summary_data
from rocking.signal.measures import response_spectrum
from rocking.structures import Wall
from rocking.structures.kinds import StructureKind
from rocking.tables import frame
from rocking.warnings import RockingWarning
from tests.unit.assessment.made_rows import case as run
from tests.unit.assessment.made_rows import filled, station, verdicts

from .conftest import SETTINGS, summarised, summary_report


def case(structure: str, predicted: float, integrated: float, record: str = "one") -> ComparisonRow:
    """One row of the comparison table."""
    return filled(
        ComparisonRow,
        record=record,
        component="EW",
        structure=structure,
        predicted_rotation_ratio=predicted,
        integrated_rotation_ratio=integrated,
        within_factor_two=within_factor_two(predicted=predicted, integrated=integrated),
        agreement=agreement(predicted=predicted, integrated=integrated),
    )


CASES = [
    case("pier", 0.5, 0.4),
    case("pier", math.inf, math.inf),
    case("arch", math.inf, 0.8, "two"),
    case("wall", 0.1, math.inf, "two"),
    case("wall", 0.1, 0.7, "three"),
]


def summary_tables(comparison, **tables):
    return summarised(RecordRows(comparison=comparison, **tables), {})


def test_agreement_counts_all_and_each_structure():
    rows = {row.structure: row for row in agreement_rows(CASES, {})}
    assert {name: row.cases for name, row in rows.items()} == {"": 5, "pier": 2, "arch": 1, "wall": 2}
    content = summary_data(summary_tables(CASES), SETTINGS).agreement.table.rows
    # stations, earthquakes, cases, both rock, within a factor 2, median ratio; overturning, found, missed, false
    assert list(content[0]) == ["all", "3", "1", "5", "2", "1", "0.696", "2", "1", "1", "1"]
    assert rows[""].median_ratio == (0.5 / 0.4 + 0.1 / 0.7) / 2 and rows["pier"].median_ratio == 1.25
    more = [*CASES, case("pier", 0.8, 0.1, "two")]
    assert next(agreement_rows(more, {})).median_ratio == 1.25  # of 1/7, 5/4 and 8


def verdict(
    record: str, structure: str, ratio: float, falls: int, in_directions: int | None = None
) -> VerdictRow:
    """The row of a structure by the rotation ratio as recorded and the members that overturn, of 64."""
    result = station(run("EW", ratio, structure, falls=falls), falls_in_directions=in_directions)
    return verdicts([result], record)[0]


@pytest.mark.usefixtures("undrawn")
def test_the_summary_counts_the_verdicts_of_each_structure_and_names_its_worst_record():
    judged = [
        verdict("one", "pier", math.inf, 64, in_directions=20),
        verdict("two", "arch", 0.8, 0),
        verdict("two", "wall", math.inf, 64),
        verdict("three", "wall", 0.7, 12),
    ]
    data = summary_data(summary_tables(CASES, verdicts=judged), SETTINGS)
    rows = {row[0].text: row[1:] for row in data.structures.table.rows}
    assert list(data.structures.table.heads[1:5]) == [
        "Overturns",
        "Uncertain",
        "Probably stands",
        "Stands",
    ]
    assert list(rows["wall"][:6]) == ["1", "0", "1", "0", "two", "100\u00a0%"]
    assert list(rows["pier"][4:]) == ["one", "31\u00a0%", "overturns", "0.50 – overturns"]
    assert (
        data.conclusion
        == "1 of 3 structures overturns or probably does under some record; under its worst record 1 is uncertain."
    )
    assert data.outcomes.pictures == (), "three records stand beside each other"
    drawn = re.findall(
        r">(wall|pier|arch|▲ overturns|≈ uncertain|○ probably stands|● stands)<", svg(outcomes_figure(judged))
    )
    assert sorted(drawn[:3]) == ["arch", "pier", "wall"] and len(drawn) == 7


@pytest.mark.usefixtures("undrawn")
def test_the_summary_and_the_page_to_explore_say_whose_crack_is_known():
    wall = Wall.of_size(3.2, 0.25, 1.6)
    structures = {"known": replace(wall, crack="known"), "free": wall}
    judged = [verdict("one", name, 0.5, 4) for name in structures]
    data = summary_data(summary_tables(CASES, verdicts=judged), SETTINGS, structures=structures)
    known = str(RockingWarning.of(StructureKind.CRACK_KNOWN_AT, height_m=1.6))
    assert {row[0].text: row[0].below for row in data.structures.table.rows} == {"known": known, "free": ""}
    page = explore_page([], structures).decode()
    assert page.count(known[1:]) == 1


@pytest.mark.usefixtures("undrawn")
def test_the_map_holds_sign_and_share_with_the_worst_record_and_structure_first():
    alone = verdicts([station(run("EW", math.inf, "pier"))], "one")
    alone += verdicts([station(run("EW", 0.8, "arch"))], "two")
    judged = [*alone, verdict("two", "wall", math.inf, 60), verdict("three", "wall", 0.7, 0)]
    content = severity_map(judged, [])
    assert content.heads == ("wall", "pier", "arch"), "the worse word, not the larger share of one run"
    assert [row.record for row in content.rows] == ["two", "one", "three"]
    assert [[cell.text for cell in row.cells] for row in content.rows] == [
        ["△ 94\u00a0%", "?", "≈ one run"],
        ["?", "≈ one run", "?"],
        ["● 0\u00a0%", "?", "?"],
    ]


@pytest.mark.usefixtures("undrawn")
def test_the_matrix_holds_a_word_for_each_record_the_worst_structure_first_and_what_to_do():
    judged = [
        verdict("one", "pier", 0.8, 0),
        verdict("two", "pier", math.inf, 64),
        verdict("one", "wall", math.inf, 64),
        verdict("two", "wall", math.inf, 64),
        verdict("two", "arch", 0.4, 12),
    ]
    content = summary_data(summary_tables(CASES, verdicts=judged), SETTINGS).matrix
    assert [head.name for head in content.heads] == ["two", "one"]
    words = {row.name: [cell.verdict for cell in row.cells] for row in content.rows}
    assert list(words.items()) == [
        ("wall", ["overturns", "overturns"]),
        ("pier", ["overturns", "stands"]),
        ("arch", ["probably stands", ""]),
    ]
    assert [row.warning for row in content.rows] == ["", "", ""], "the words say it"


@pytest.mark.usefixtures("undrawn")
def test_of_many_records_each_has_a_line_of_the_map_and_the_worst_stand_on_the_first_page():
    judged = [verdict(f"record {number}", "pier", math.inf, number) for number in range(40)]
    data = summary_data(summary_tables(CASES, verdicts=judged), SETTINGS)
    assert data.matrix.rows == ()
    assert [row.record for row in data.map.rows] == [f"record {39 - number}" for number in range(12)]
    assert len(data.whole_map.rows) == 40
    few = summary_data(summary_tables(CASES, verdicts=judged[:10]), SETTINGS)
    assert few.map.rows == few.whole_map.rows == ()
    (row,) = few.matrix.rows
    assert few.matrix.upright and len(few.matrix.heads) == len(row.cells) == 10


def test_each_method_is_held_against_the_integration_and_no_time_is_told(example):
    """Two runs of the same study would else differ."""
    tables = summarised(example.tables, example.structures)
    timings = [TimingRow(record="one", stage="closed form", duration_s=0.002)]
    assert summary_report(tables | {TimingRow: timings}, SETTINGS) == summary_report(tables, SETTINGS)
    table = summary_data(tables, SETTINGS).methods.table
    rows = {row[0]: row[1:] for row in table.rows}
    assert rows["Mechanism, record"][0] == "5" and rows["Mechanism, record"][1] == "5\u00a0of\u00a05"
    missed = [row for row in example.tables.comparison if row.agreement is Agreement.TOO_LOW]
    unsafe = rows["Closed form, block"][2]
    assert (unsafe.text if isinstance(unsafe, TableCell) else unsafe) == str(len(missed))


def test_a_study_without_a_readable_record_says_so_first():
    failure = filled(FailureRow, record="bad", stage="read", message="bad.at2: is empty.")
    tables = summary_tables([], failures=[failure])
    assert "No record could be read" in summary_data(tables, SETTINGS).notices[0].text
    assert summary_report(tables, SETTINGS).startswith(b"%PDF")


def test_the_summary_of_a_record_is_the_same_twice_and_names_its_factor(hostile):
    tables = summarised(hostile.tables, hostile.structures)
    assert summary_report(tables, SETTINGS) == summary_report(tables, SETTINGS)
    assert any("declared factor" in notice.text for notice in summary_data(tables, SETTINGS).notices)


@pytest.mark.usefixtures("undrawn")
def test_long_lists_are_cut_and_say_how_much_was_left_out():
    unsafe = [case("wall", 0.0, place / 1000) for place in range(2, 102)]
    assert {row.agreement for row in unsafe} == {Agreement.TOO_LOW}
    fallen = [case("wall", 0.1, math.inf, "fallen")]
    names = [f"r{place}" for place in range(250)]
    records = [filled(RecordRow, record=name, component="EW", scale_factor=2.0, samples=1) for name in names]
    data = summary_data(summary_tables([*unsafe, *fallen], record=records), SETTINGS)
    names = [row[0] for row in data.unsafe.table.rows]
    assert names[0] == "fallen" and len(names) == 20
    assert data.unsafe.table.rows[1][4] == "0.101", "the worst first"
    assert data.unsafe.caption.endswith(" Another 81 cases in comparison.csv.")
    assert len(data.records.table.rows) == 200
    assert data.records.caption.endswith(" Another 50 components in record.csv.")
    assert "and 244 others" in data.notices[-1].text


@pytest.mark.usefixtures("undrawn")
def test_a_record_is_listed_with_its_dominant_pulse(example):
    (dominant,) = (row for row in example.tables.pulses if row.kind == "alternative" and row.rank == 1)
    others = [replace(row, period_s=9.0) for row in example.tables.pulses if row is not dominant]
    tables = summarised(replace(example.tables, pulses=[*others, dominant]), example.structures)
    (row,) = summary_data(tables, SETTINGS).records.table.rows
    assert {"9.00", "9.0", "9"}.isdisjoint(row)
    assert any(cell.startswith(f"{dominant.period_s:.1f}") for cell in row)


def test_the_design_level_stands_beside_the_spectra_of_the_records():
    """Each component is drawn at the level's damping; of many the quantiles; without a level there is no figure."""
    level = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    (record,) = rocking.read("records/synthetic_strong_pulse.AT2")
    (spectrum,) = component_spectra([record], level).values()
    periods = spectrum_periods(level)
    np.testing.assert_allclose(
        spectrum, response_spectrum(record, periods, 0.05).pseudo_acceleration, rtol=1e-3
    )
    tables = summary_tables(CASES)
    assert summary_data(tables, SETTINGS).design == Section()
    drawn = summary_data(tables, SETTINGS, design=(level, [spectrum, spectrum])).design
    assert len(drawn.pictures) == 1 and level.words in drawn.caption
    for count, label in ((2, "components"), (MOST_LINES + 1, "5 to 95 % of the components")):
        (axes,) = design_summary_figure([spectrum] * count, level).axes
        assert axes.get_legend().get_texts()[0].get_text() == label
        mean = next(line for line in axes.lines if line.get_label() == f"mean of {count}")
        np.testing.assert_allclose(mean.get_ydata(), spectrum, rtol=1e-12)
        design = next(line for line in axes.lines if line.get_label() == "design level")
        np.testing.assert_allclose(design.get_ydata(), level.acceleration(periods), rtol=1e-12)


@pytest.mark.parametrize(("predicted", "drawn"), [(0.3, 1), (math.nan, 0)])
def test_a_scatter_stands_where_three_cases_have_both_ratios(predicted, drawn):
    cases = [case("pier", 0.5, 0.4), case("arch", 0.9, 0.8, "two"), case("wall", predicted, 0.7, "three")]
    assert len(summary_data(summary_tables(cases), SETTINGS).scatter) == drawn


def test_a_scatter_of_many_cases_does_not_grow_with_them():
    many = [[case("wall", 0.1 + k / count, 0.5) for k in range(count)] for count in (5500, 22000)]
    sizes = [len(svg(prediction_scatter(part))) for part in many]
    assert sizes[1] < 1.5 * sizes[0] < 1.5 * 2e5


PIER = {"structure": "pier", "intensity_measure": "pgv", "threshold": math.inf}
SHARES = {"a": (0.0, 0.4, 1.0), "b": (0.2, 0.6, 0.3), "c": (0.0, 0.0, 0.1), "d": (1, 1, 1)}
MEDIAN = {
    "records": 4,
    "stations": 3,
    "median": 0.2,
    "median_low": 0.13,
    "median_high": 0.31,
    "reversals": 1,
    "stations_out": 0,
    "earthquakes": 3,
    "stations_at_median": 3,
    "stations_at_half_rate": 3,
}
FRAGILITY = {
    IdaRow: [
        filled(IdaRow, structure="pier", record=record, level=level, overturning_share=share)
        for record, shares in SHARES.items()
        for level, share in zip((0.1, 0.2, 0.4), shares, strict=True)
    ],
    FragilityRow: [
        filled(FragilityRow, **PIER, level=level, probability=level, stations=3) for level in (0.1, 0.2, 0.4)
    ],
    FragilitySummaryRow: [filled(FragilitySummaryRow, **PIER, **MEDIAN)],
}


def test_the_document_of_the_fragility_names_records_stations_units_and_what_governs(example):
    scatters = {"pgv": (0.3, 12), "AvgSA(0.5,3.7)": (0.16, 4), "pga": (math.nan, None)}
    measures = [
        filled(
            IntensityMeasureRow,
            structure="pier",
            intensity_measure=measure,
            figure=figure,
            efficiency=scatter,
            records=4,
            stations=3,
            earthquakes=3,
            stations_needed=count,
        )
        for measure, (scatter, count) in scatters.items()
        for figure in ("PGV/PGA", "magnitude")
    ]
    curves = frame(FragilityRow, FRAGILITY[FragilityRow])
    of_measures = frame(IntensityMeasureRow, measures)
    data = fragility_data(curves, FRAGILITY[FragilitySummaryRow], ida_frame(FRAGILITY), of_measures)
    assert data.subtitle == "4 records of 3 stations of 3 earthquakes; 1 structure."
    text, figure, table, scatter = data.parts
    assert scatter.table.rows == (
        ("pier", "AvgSA(0.5,3.7) 0.16, pgv 0.30, pga –", "4 with AvgSA(0.5,3.7), 12 with pgv"),
    )
    assert "With 3 stations of 3 earthquakes the curves are rough" in text.text
    assert "pgv [m/s]" in figure.pictures[0].svg and ">overturns</text>" in figure.pictures[0].svg
    (row,) = table.table.rows
    assert row[:2] == ("pier", "pgv 0.20 (0.13–0.31) m/s") and row[3:5] == ("3 of 3", "3 of 3")
    # d overturns it at 0.1 in all members, b at 0.2 in most of them, a at 0.4, and c nowhere
    assert row[5] == "d (0.10), b (0.20), a (0.40)"
    (part,) = Fragilities().panel(FRAGILITY).parts
    assert part.table.rows == (row,)
    assert Fragilities().panel({FragilitySummaryRow: [], IdaRow: []}) is None


def test_the_row_of_a_curve_says_what_stations_reach_and_both_ends_of_what_is_not_known():
    def of_curve(**values):
        (row,) = fragility_table(
            [filled(FragilitySummaryRow, **PIER, **MEDIAN | values)], ida_frame(FRAGILITY)
        ).table.rows
        return row

    for values, at, cell in (
        ({"median_low": 0.0}, 1, "pgv 0.20 (–) m/s"),
        ({"median_upper": 0.2}, 1, "pgv 0.20 (0.13–0.31) m/s"),
        ({"median_upper": 0.15, "by": "stones"}, 1, "pgv 0.15 to 0.20, by the stones (0.13–0.31) m/s"),
        ({"dispersion": 0.456}, 2, "0.46"),
        ({"stations_at_median": 2, "factor_for_median": 23.4}, 4, "2 of 3 (factor 23)"),
        ({"stations_at_median": 2}, 4, "2 of 3"),
        ({"stations": 10, "stations_at_median": 9, "factor_for_median": 2.0}, 4, "9 of 10"),
        ({"stations": 10, "stations_at_median": 8, "factor_for_median": 2.0}, 4, "8 of 10 (factor 2.0)"),
        (
            {"annual_rate": 1e-3, "annual_rate_low": 4e-4, "annual_rate_high": 2e-3},
            7,
            "0.0010 (0.00040–0.0020)",
        ),
        ({"annual_rate_low": 4e-4, "annual_rate_high": 2e-3}, 7, "0.00040–0.0020"),
    ):
        assert of_curve(**values)[at] == cell
    assert [len(of_curve(annual_rate_high=rate)) for rate in (0.0, 1e-9)] == [7, 8]


@pytest.mark.parametrize(("values", "told"), [
    ({}, ""), ({"largest_scale_factor": 12.3}, " Records are scaled by 12 at the most."),
    ({"largest_scale_factor": 12.3, "stations_out": 1},
     " Records are scaled by 12 at the most; 1 station does not reach the highest level so."),
    ({"annual_rate_high": 1e-3}, " A rate is given by both ends alone where fewer than nine in ten"),
])  # fmt: skip
def test_the_caption_of_the_curves_says_how_far_records_were_scaled(values, told):
    row = filled(FragilitySummaryRow, **PIER, **MEDIAN | values)
    after = fragility_table([row], ida_frame(FRAGILITY)).caption.partition("let it stand again.")[2]
    assert after.startswith(told) and bool(after) is bool(told)


@pytest.mark.parametrize(
    "measure", [one_row.name for one_row in compared(rocking.Block(2.0, 0.2).mechanism())]
)
def test_every_intensity_measure_is_drawn_with_its_unit(measure):
    curves = frame(FragilityRow, FRAGILITY[FragilityRow]).assign(intensity_measure=measure)
    assert f">{measure} [" in svg(fragility_figure(curves))
