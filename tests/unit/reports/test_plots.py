"""What `.plot()` draws is what is there: the lines hold the numbers, the axes say the units; frames likewise."""

import matplotlib
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import rocking
from rocking.assessment.rows import ComparisonRow, PulseRow
from rocking.reports.design_figure import design_summary_figure, spectrum_periods
from rocking.reports.panels import draw_rotation
from rocking.reports.scatter import prediction_scatter
from rocking.reports.style import (
    elided,
    new_figure,
    plain_logarithmic,
    room_for_texts,
    svg,
    wrapped,
)
from tests.refusals import refused
from tests.unit.assessment.made_rows import filled

TIMES = np.arange(3000) * 0.01
PULSE = rocking.Pulse(amplitude=4.0, circular_frequency=2 * np.pi / 0.9, start_time=5.0)
RECORD = rocking.Accelerogram(PULSE.acceleration(TIMES), 0.01, "NS", "$x^$", "event")
BLOCK = rocking.Block.of_size(0.6, 3.0)
WHOLE = rocking.integrate(BLOCK, RECORD.scaled(0.55), history=True)
FREQUENCIES, MULTIPLIERS = np.geomspace(0.5, 8, 12), np.geomspace(0.05, 0.6, 10)
SPECTRUM = rocking.rocking_spectrum(RECORD, FREQUENCIES, MULTIPLIERS, 0.9)
PLOTTED = {
    "record": RECORD,
    "pulse": PULSE,
    "analysis": rocking.extract_pulses(RECORD),
    "response": WHOLE,
    "spectrum": SPECTRUM,
    "mechanism": BLOCK.mechanism(),
    "capacity": BLOCK.capacity_curve(),
    "structure": rocking.Arch(10.0, 1.5, np.radians(157.5)),
    "response spectrum": rocking.response_spectrum(RECORD),
}
RECORDED = "time [s]", "ground acceleration [m/s²]"
WRITTEN: dict[str, tuple[str, str, list[str], list[float]]] = {
    "record": (*RECORDED, [r"event, \$x^\$, NS"], []),
    "pulse": (*RECORDED, ["sine pulse, T = 0.9 s"], []),
    "analysis": (*RECORDED, ["record", "dominant pulse"], []),
    "response": ("time [s]", "rotation [rad]", ["rotation"], [0]),
    "spectrum": ("frequency parameter p [rad/s]", "uplift multiplier λ [-]", [], []),
    "mechanism": ("rotation [rad]", "over the value at rest [-]", ["I", "G", "B"], [0]),
    "capacity": (
        "horizontal displacement of the control point [m]",
        "load multiplier G/B [g]",
        ["control point (-0.3, 3) m"],
        [0],
    ),
    "structure": ("[m]", "[m]", ["thrust line at uplift"], []),
    "response spectrum": ("period [s]", "pseudo-acceleration [m/s²]", ["damping 5%"], []),
}
"""Of each picture: what is along and up, in which unit, the names of its lines, and the levels of those without one."""


@pytest.fixture(autouse=True)
def no_window():
    """Figures go nowhere, and are closed."""
    with matplotlib.rc_context({"backend": "agg"}):
        from matplotlib import pyplot

        yield
        pyplot.close("all")


def lines(axes: Axes) -> dict[str, np.ndarray]:
    return {str(line.get_label()): line.get_ydata() for line in axes.lines}


@pytest.mark.parametrize("name", PLOTTED)
def test_it_returns_the_axes_it_was_given_or_new_ones_with_units(name):
    own = Figure().subplots()
    assert PLOTTED[name].plot(axes=own) is own
    new = PLOTTED[name].plot()
    assert isinstance(new, Axes) and new.figure is not own.figure
    along, up, named, levels = WRITTEN[name]
    assert (new.get_xlabel(), new.get_ylabel(), new.get_legend_handles_labels()[1]) == (along, up, named)
    unnamed = [line.get_ydata() for line in new.lines if str(line.get_label()).startswith("_")]
    assert [values[0] for values in unnamed if list(values) == [values[0]] * 2] == levels
    new.figure.canvas.draw()  # markup in a name stays text


def test_the_record_and_the_pulse_are_drawn_as_they_are():
    assert np.array_equal(lines(RECORD.plot())[r"event, \$x^\$, NS"], RECORD.acceleration)
    drawn = lines(PLOTTED["analysis"].plot())
    assert np.array_equal(drawn["record"], RECORD.acceleration)
    # one of the 121 points stands at a quarter of the period
    assert np.abs(drawn["dominant pulse"]).max() == pytest.approx(4.0, rel=1e-9)


def test_the_response_is_drawn_while_it_moves_with_its_largest_rotation_marked():
    axes = WHOLE.plot()
    rotation, _, mark = (line.get_ydata() for line in axes.lines)
    drawn = np.isin(WHOLE.times, axes.lines[0].get_xdata())
    assert np.array_equal(rotation, WHOLE.rotation[drawn])
    assert np.abs(WHOLE.rotation[~drawn]).max() < 0.01 * np.abs(rotation).max()
    assert axes.lines[0].get_xdata()[0] > 0.9 * PULSE.start_time, "before it the ground is still"
    critical = BLOCK.mechanism().critical_rotation
    # the history has the steps of the integration, between which the peak lies
    assert abs(mark[0]) / critical == pytest.approx(WHOLE.rotation_ratio, rel=1e-3)


def test_the_mechanism_is_drawn_over_its_values_at_rest():
    side = BLOCK.mechanism().positive
    drawn = lines(BLOCK.mechanism().plot())
    assert drawn["G"][0] == 1 and drawn["G"][-1] == pytest.approx(0, abs=1e-12)
    assert drawn["B"][-1] == pytest.approx(1 / np.cos(side.critical_rotation), rel=1e-12)
    assert np.all(drawn["I"] == 1)
    unlike = rocking.RigidBody(left=0.3, right=0.5, centre_height=1.5, inertia=1.0, restitution=0.9)
    *curves, _ = unlike.mechanism().plot().lines  # three for each side and the line at 0
    away, back = (one_side.critical_rotation for one_side in unlike.mechanism().sides)
    assert [line.get_xdata()[-1] for line in curves] == [away] * 3 + [-back] * 3


def test_a_block_starts_its_capacity_at_its_slenderness_and_an_arch_carries_its_thrust_above_its_centre():
    assert BLOCK.capacity_curve().plot().lines[0].get_xydata()[0] == pytest.approx((0.0, 0.2), abs=1e-12)
    assert lines(PLOTTED["structure"].plot())["thrust line at uplift"].min() > 0


def test_the_spectrum_is_hatched_where_it_overturns():
    hatched = SPECTRUM.plot().collections[0].get_paths()
    inner = [
        [any(path.contains_point((p, multiplier)) for path in hatched) for multiplier in MULTIPLIERS[1:-1]]
        for p in FREQUENCIES[1:-1]
    ]
    assert np.array_equal(inner, np.isinf(SPECTRUM[1:-1, 1:-1])) and np.any(inner)


@pytest.mark.parametrize(("left", "right"), [(0.3, 0.5), (0.5, 0.3)])
def test_a_rotation_is_drawn_over_the_critical_one_of_its_side(left, right):
    body = rocking.RigidBody(left=left, right=right, centre_height=1.5, inertia=1.0, restitution=0.9)
    response = rocking.integrate(body, RECORD.scaled(0.8), history=True)
    ratios = response.relative_rotation
    assert 0 < np.abs(ratios).max() == pytest.approx(response.rotation_ratio, rel=1e-3)


def test_a_history_is_drawn_with_its_impacts_and_the_band_of_its_members_up_to_a_ratio_of_1():
    axes = Figure().subplots()
    times, ratio = np.arange(5.0), np.array([0.0, 0.5, -0.25, -0.5, -0.1])
    draw_rotation(axes, (times, ratio), band=(0.2, 1.7))
    rest, history, impacts = axes.lines
    assert np.array_equal(history.get_ydata(), ratio) and list(rest.get_ydata()) == [0, 0]
    assert (impacts.get_xdata().tolist(), impacts.get_ydata().tolist()) == ([2.0], [0.0])
    bars = [patch.get_window_extent().transformed(axes.transData.inverted()) for patch in axes.patches]
    assert [[bar.ymin, bar.ymax] for bar in bars] == [pytest.approx([0.2, 1.0]), pytest.approx([-1.0, -0.2])]


def test_each_case_stands_in_the_quadrant_of_who_says_that_it_falls():
    """And what rocks in both at the logarithm of its rotation ratios; each quadrant says how many it holds."""
    predicted = [0.1, np.inf, 0.2, np.inf, 0.4, 0.4, np.inf]
    integrated = [0.5, np.inf, np.inf, 0.3, np.inf, 0.5, np.inf]
    cases = [
        filled(
            ComparisonRow,
            record="a",
            component=component,
            predicted_rotation_ratio=closed,
            integrated_rotation_ratio=whole,
        )
        for closed, whole, component in zip(predicted, integrated, "NNNEEEE", strict=True)
    ]
    pulses = [
        filled(PulseRow, record="a", component=component, kind="alternative", rank=1, explained_energy=share)
        for component, share in (("N", 0.2), ("E", 0.6))
    ]
    axes, key = prediction_scatter(cases, pulses).axes
    light, dark, late = (
        line.get_xydata() for line in axes.lines if str(line.get_label()).startswith("cases")
    )
    assert late.size == 0  # where the sine begins before each fall
    zone = 0.25  # from here on it falls
    assert [tuple(point > zone) for point in light] == [(False, False), (True, True), (False, True)]
    assert [tuple(point > zone) for point in dark] == [
        (True, False),
        (False, True),
        (False, False),
        (True, True),
    ]
    assert light[0] == pytest.approx(np.log10([0.1, 0.5])) and light[2][0] == pytest.approx(np.log10(0.2))
    texts = [text.get_text() for text in axes.texts]
    assert {"2 missed", "2 right", "1 false\nalarm", "2 rock in both,", "1 within factor two"} <= set(texts)
    assert (axes.get_xlabel(), axes.get_ylabel()) == (
        "closed form (1: critical)",
        "integration (1: critical)",
    )
    for ticks, labels in (
        (axes.get_xticks(), axes.get_xticklabels()),
        (axes.get_yticks(), axes.get_yticklabels()),
    ):
        (least, first), *known = zip(ticks, (label.get_text() for label in labels), strict=True)
        assert first == f"≤ {10**least:g}" and known[:2] == [(-1, "0.1"), (0, "1")] and known[2][1] == "falls"
    beside = [text.get_text().replace("\u00a0", " ") for text in key.texts]
    assert beside[1:5] == ["60 %", "misses 1 of 2", "20 %", "misses 1 of 2"]


def test_no_two_points_of_what_falls_stand_on_one_another():
    ratios = np.linspace(0.3, 0.31, 7)
    cases = [
        filled(ComparisonRow, predicted_rotation_ratio=closed, integrated_rotation_ratio=np.inf)
        for closed in (*ratios, *[np.inf] * 40)
    ]
    axes = prediction_scatter(cases).axes[0]
    points = np.vstack(
        [line.get_xydata() for line in axes.lines if str(line.get_label()).startswith("cases")]
    )
    assert len(points) == 47
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)[~np.eye(47, dtype=bool)]
    assert apart.min() > 0.07


@pytest.mark.parametrize("which", ["x", "y"])
def test_a_logarithmic_axis_names_one_two_and_five_in_plain_numbers_and_leaves_the_other_alone(which):
    panel = Figure().subplots()
    panel.set(xlim=(0.1, 10), ylim=(0.1, 10))
    plain_logarithmic(panel, which)
    axes = {"x": panel.xaxis, "y": panel.yaxis}
    chosen = axes.pop(which)
    places = [place for place in chosen.get_majorticklocs() if 0.1 <= place <= 10]
    assert chosen.get_major_formatter().format_ticks(places) == ["0.1", "0.2", "0.5", "1", "2", "5", "10"]
    assert chosen.get_scale() == "log" and not len(chosen.get_minorticklocs())
    assert [other.get_scale() for other in axes.values()] == ["linear"]


def test_a_response_spectrum_is_its_pseudo_acceleration():
    spectrum = PLOTTED["response spectrum"]
    (curve,) = spectrum.plot().lines
    assert np.array_equal(curve.get_xdata(), spectrum.periods) and curve.get_label() == "damping 5%"
    assert np.allclose(
        curve.get_ydata(), (2 * np.pi / spectrum.periods) ** 2 * spectrum.displacement, rtol=1e-14
    )


def test_a_notebook_shows_the_sentence_of_a_result_and_its_table():
    assessment = rocking.assess(RECORD, BLOCK, members=16)
    table = assessment.frame()
    assert set(table["verdict"]) == {str(assessment.verdict)}
    shown = assessment._repr_html_()
    assert str(assessment.verdict) in shown.partition("<table")[0] and "<&" not in shown
    assert (shown.count("<tr") == len(table) + 1 and "whole" in shown) or "record" in shown
    pulses = PLOTTED["analysis"]
    assert pulses._repr_html_().count("<tr") == len(pulses.ranked) + 1


def test_what_cannot_be_drawn_is_said():
    with refused(rocking.MotionError, "history", False):
        rocking.integrate(BLOCK, RECORD).plot()
    with refused(rocking.MotionError, "history", False):
        rocking.integrate(BLOCK, RECORD).frame()
    with refused(rocking.MotionError, "shape", (9, 10)):
        SPECTRUM[3:].plot()
    with refused(rocking.MotionError, "shape", (1, 10)):
        rocking.rocking_spectrum(RECORD, FREQUENCIES[:1], MULTIPLIERS, 0.9).plot()


def test_frames_hold_the_numbers_under_names_with_units():
    assert list(RECORD.frame().columns) == ["time_s", "acceleration_m_s2"]
    assert RECORD.frame().acceleration_m_s2.abs().max() == RECORD.peak_acceleration
    history = WHOLE.frame()
    assert np.array_equal(history.rotation_rad, WHOLE.rotation)
    assert list(history.columns) == ["time_s", "rotation_rad", "angular_velocity_rad_s"]
    pulses = PLOTTED["analysis"].frame()
    assert np.array_equal(pulses.gain_m2_s3, [found.gain for found in PLOTTED["analysis"].ranked])
    assert pulses.explained_energy[0] == PLOTTED["analysis"].explained_energy
    main = PLOTTED["analysis"].dominant
    assert (pulses.amplitude_m_s2[0], pulses.start_time_s[0]) == (main.amplitude, main.start_time)
    assert pulses.period_s[0] == pytest.approx(0.9, rel=1e-6)
    blocks = SPECTRUM.frame()
    assert len(blocks) == SPECTRUM.size
    of_one = blocks[
        (blocks.frequency_parameter_rad_s == FREQUENCIES[2]) & (blocks.uplift_multiplier == MULTIPLIERS[4])
    ]
    assert of_one.rotation_ratio.tolist() == [SPECTRUM[2, 4]]
    with refused(rocking.MotionError, "shape", (9, 10)):
        SPECTRUM[3:].frame()
    oscillators = PLOTTED["response spectrum"]
    assert np.array_equal(oscillators.frame().pseudo_acceleration_m_s2, oscillators.pseudo_acceleration)
    assert np.array_equal(oscillators.frame().period_s, oscillators.periods)
    assert np.array_equal(oscillators.frame().displacement_m, oscillators.displacement)


def test_a_response_is_drawn_over_the_critical_rotation_where_that_is_asked():
    (rotation, _), (relative, _) = WHOLE.plot().lines[:2], WHOLE.plot(relative=True).lines[:2]
    critical = BLOCK.mechanism().critical_rotation
    assert np.allclose(rotation.get_ydata() / critical, relative.get_ydata(), rtol=1e-12)
    assert np.abs(WHOLE.relative_rotation).max() == pytest.approx(WHOLE.rotation_ratio, rel=1e-3)


@pytest.mark.parametrize(("count", "labels"), [
    (1, ["components", "mean of 1", "design level"]), (60, ["components", "mean of 60", "design level"]),
    (61, ["5 to 95 % of the components", "median", "mean of 61", "design level"]),
])  # fmt: skip
def test_of_more_spectra_than_can_be_told_apart_the_quantiles_are_drawn_at_the_design_level(count, labels):
    level = rocking.DesignSpectrum.ntc(2.0, 2.5, 0.3)
    periods = spectrum_periods(level)
    assert periods[[0, -1]] == pytest.approx([0.04, min(4.0, level.longest_period)], rel=0.1)
    spectra = np.random.default_rng(count).uniform(0, 5, (count, periods.size))
    (axes,) = design_summary_figure(spectra.tolist(), level).axes
    assert sorted(axes.get_legend_handles_labels()[1]) == sorted(labels)
    *drawn, mean, design = (line.get_ydata() for line in axes.lines)
    assert mean == pytest.approx(spectra.mean(axis=0)) and design == pytest.approx(
        level.acceleration(periods)
    )
    assert np.array(drawn) == pytest.approx(spectra if count <= 60 else np.median(spectra, axis=0)[None])
    for band in axes.collections:
        edges = band.get_paths()[0].vertices[1 : periods.size + 1, 1], np.quantile(spectra, 0.05, axis=0)
        assert edges[0] == pytest.approx(edges[1])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("period [s]", "spectral acceleration [m/s²]")


def test_a_name_is_cut_by_its_width_and_not_by_its_letters():
    """By the widths of the font: i and l are half as wide as n, W as wide as one and a half."""
    assert elided("illi" * 5, 12) == "illi" * 5
    assert elided("WWWW" * 5, 12).endswith("…")
    assert len(elided("n" * 20, 12)) < 12 < len(elided("i" * 40, 12))


def test_a_long_name_is_wrapped_before_it_is_cut():
    """Between words; a word is divided where half of a line would stay empty, and only the last line is cut."""
    name = "nave of the abbey church with its two piers"
    assert wrapped(name, 60, 3) == name
    lines = wrapped(name, 20, 3).split("\n")
    assert " ".join(lines) == name and len(lines) == 3
    first, second = wrapped(name, 20, 2).split("\n")
    assert name.startswith(first) and second.endswith("…") and name[len(first) + 1 :].startswith(second[:-1])
    first, second = wrapped("4 Donaudampfschifffahrtsgesellschaft", 20, 2).split("\n")
    assert first.endswith("-") and len(first) > 12
    assert all(elided(line, 20) == line for value in (3, 2) for line in wrapped(name, 20, value).split("\n"))


def test_a_drawing_makes_room_for_its_texts_and_keeps_its_scale():
    figure = new_figure(60.0)
    axes = figure.add_axes((0.1, 0.1, 0.3, 0.8))
    axes.plot([0, 1, 1, 0, 0], [0, 0, 2, 2, 0])
    axes.text(1.0, 1.0, "h = 4 m")
    axes.text(0.0, 0.5, "t = 0.8 m", ha="right")
    axes.set_aspect("equal", adjustable="datalim")
    room_for_texts(figure, axes)
    figure.draw_without_rendering()
    boxes = [text.get_window_extent() for text in axes.texts]
    # Half a pixel: texts are placed on whole ones.
    assert all(axes.bbox.x0 - 0.5 <= box.x0 and box.x1 <= axes.bbox.x1 + 0.5 for box in boxes)
    corners = axes.transData.transform([(0, 0), (1, 2)])
    width, height = corners[1] - corners[0]
    assert height == pytest.approx(2 * width)
    assert all(axes.bbox.x0 <= x <= axes.bbox.x1 for x, _ in corners)


def test_the_thickness_of_a_hollow_spire_is_drawn_level_at_its_base_and_inwards():
    spire = rocking.Spire(width=3.0, height=15.0, wall_thickness=0.25)
    (thickness,) = (path for path in spire.dimensions() if path.text.startswith("0.25"))
    assert thickness.feet[:, 0] == pytest.approx([1.25, 1.5]) and thickness.feet[:, 1] == pytest.approx(0.0)


def test_the_index_of_a_symbol_is_lowered_in_a_figure_and_no_other_underscore():
    figure = Figure()
    figure.text(0, 0, "parapet, T_b 0.3 s; a_g; RSN_T_b_1; T_beam; d_SLV*")
    drawn = svg(figure)
    assert drawn.count("<tspan") == 2 * 2
    assert "RSN_T_b_1; T_beam; d_SLV*" in drawn
