"""What a report says of structures on supports: the first lines and the share by period."""

from dataclasses import replace
from types import SimpleNamespace

import matplotlib.pyplot as plt
import numpy as np
import pytest

from rocking.assessment.assessor import Assessor
from rocking.assessment.rows import rows_of_record
from rocking.assessment.scene import Scene, on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.floors.place import place_from_config
from rocking.records import Accelerogram
from rocking.reports.record import RecordReport
from rocking.reports.supports import shares_by_period_figure, support_panels
from rocking.structures import Block
from rocking.study.settings import Settings

STEP = 0.01


@pytest.fixture(scope="module")
def report():
    rng = np.random.default_rng(8)
    times = np.arange(400) * STEP
    waves = sum(np.sin(2 * np.pi * rng.uniform(0.5, 4.0) * times + rng.uniform(0, 6.3)) for _ in range(9))
    record = Accelerogram(0.6 * waves * np.sin(np.pi * times / 4) ** 2, STEP, component="HNE")
    roof = {"name": "roof", "period_s": [0.15, 0.6], "participation": 1.3}
    body = Block(semi_diagonal=0.5, slenderness=0.25)
    pier = Block(semi_diagonal=4.0, slenderness=0.25)
    scenes = {"parapet": Scene("parapet", body, place_from_config(roof)), **on_the_ground({"pier": pier})}
    structures = {"parapet": body, "pier": pier}
    settings = AssessmentSettings(fidelity="standard", ensemble=EnsembleSettings(members=16))
    result = Assessor(settings).assess("made", [record], scenes)
    settings = Settings(acceleration_scale="linearised").for_pages
    return RecordReport(result, rows_of_record(result), structures, settings)


def test_the_page_after_the_first_says_it_once_for_all_periods_and_page_one_names_the_worst(report):
    data = report.page()
    sentence = report.result.scenes["parapet"].sentence
    assert sentence.startswith("parapet on roof ")
    assert [
        text for topic in data.known.topics for text in topic.texts if text.startswith("parapet on roof")
    ] == [f"{sentence}."]
    (row,) = (one_row for one_row in data.page_one.rows if one_row.name == "parapet")
    carried = [verdict for verdict in report.tables.verdicts if verdict.support_period_s]
    worst = max(carried, key=lambda item: item.severity)
    assert row.below.endswith(f"; T_b {worst.support_period_s:.3g}\u00a0s")


def test_amplification_is_that_of_the_peaks(report):
    ground = report.result.components[0].accelerogram.peak_acceleration
    rows = report.tables.supports
    assert {row.support_period_s == 0 for row in rows} == {True, False}
    for row in rows:
        assert row.amplification == pytest.approx(row.floor_peak_acceleration_m_s2 / ground)
        assert (row.support_period_s == 0) == (row.amplification == 1)
        if row.support_period_s:
            # resonance: what stands there with the support's own period feels more than its peak
            assert row.floor_spectral_acceleration_m_s2 > row.floor_peak_acceleration_m_s2
            assert row.code_spectral_acceleration_m_s2 > row.floor_peak_acceleration_m_s2


def test_the_document_has_the_page(report):
    assert report.pdf().startswith(b"%PDF")


def test_the_first_four_supports_are_drawn_at_their_first_middle_and_last_period_under_the_largest_peak():
    class Made(SimpleNamespace):
        __hash__ = object.__hash__

    periods = {"e": [40, 41, 42], "d": [30, 31], "c": [20], "b": [10, 11, 12, 13], "a": [0, 1, 2, 3, 4]}
    places = {name: Made(supports=supports) for name, supports in periods.items()}
    scenes = [Made(scene=Made(place=places[name])) for name in "edcbab"]
    components = [Made(accelerogram=Made(peak_acceleration=peak)) for peak in (1.0, 3.0, 2.0)]
    result = Made(carried=scenes, components=components, floors={40, 41, 42, 30, 31, 20, 10, 12, 13, 0})
    result.components_on = lambda support: ["x", support, "y"]
    panels = support_panels(result)
    assert [panel.floors for panel in panels] == [[40, 41, 42], [30, 31], [20], [10, 12, 13]]
    assert [panel.structures for panel in panels] == [scenes[:1], scenes[1:2], scenes[2:3], scenes[3::2]]
    assert {panel.ground for panel in panels} == {components[1]}
    assert support_panels(Made(carried=scenes, components=[])) == []


def test_a_support_without_damping_has_no_spectrum_of_the_code():
    record = Accelerogram(np.sin(np.arange(300) / 5.0), STEP, component="HNE")
    body = Block(semi_diagonal=0.5, slenderness=0.25)
    roof = {"name": "roof", "period_s": 0.3, "participation": 1.3, "damping_ratio": 0}
    structures = {"parapet": body}
    scenes = {"parapet": Scene("parapet", body, place_from_config(roof))}
    few = AssessmentSettings(ensemble=EnsembleSettings(members=16, reserve=0.0))
    result = Assessor(few).assess("made", [record], scenes)
    rows = rows_of_record(result)
    assert np.isnan(rows.supports[-1].code_spectral_acceleration_m_s2)
    assert rows.supports[-1].floor_spectral_acceleration_m_s2 > 0
    assert RecordReport(result, rows, structures, Settings().for_pages).page().known.topics


def test_the_mean_share_over_the_records_stands_over_the_period_from_zero_on(report):
    rows = report.tables.supports
    figure = shares_by_period_figure(rows)
    (axes,) = figure.axes
    (line,) = axes.get_lines()
    assert list(line.get_xdata()) == sorted({row.support_period_s for row in rows})
    assert axes.get_ylim() == (0.0, 1.0) and axes.get_xlim()[0] == 0.0
    plt.close(figure)


def test_a_record_that_is_too_coarse_for_a_period_takes_no_part_in_the_mean_there(report):
    row = report.tables.supports[0]
    shares = {"a": {0.0: 0.0, 0.2: 0.4, 0.4: 0.6}, "b": {0.0: 0.0, 0.4: 0.3}}
    rows = [
        replace(row, record=record, support_period_s=period, overturning_share=share)
        for record, own in shares.items()
        for period, share in own.items()
    ]
    figure = shares_by_period_figure(rows)
    (line,) = figure.axes[0].get_lines()
    assert list(line.get_xdata()) == [0.0, 0.2, 0.4]
    np.testing.assert_allclose(line.get_ydata(), [0.0, 0.4, 0.45])
    plt.close(figure)
