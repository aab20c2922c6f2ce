"""The record sheet: what it shows of a record, and that it is drawn for every record there can be."""

import math

import numpy as np
import pytest
from scipy.constants import g

from rocking.pulses import Pulse
from rocking.records.accelerogram import Accelerogram
from rocking.records.measures import record_measures, response_spectrum
from rocking.reports.record.sheet_figures import RecordSheet, record_sheet

from .drawn import circles, number, paths, read_axis, texts

STEP = 0.01
PULSE = Pulse(3.0, 2 * math.pi / 0.9, 4.0)
VELOCITY_PULSE = (1.7, 4.5)
MOVING = Accelerogram(PULSE.acceleration(np.arange(2000) * STEP), STEP)
MIDDLE = 85.0
SPECTRUM_FOOT = 57.0
"""Where the left half of the sheet ends, and the spectrum above the pulse, mm."""


def sheet(accelerogram=MOVING, pulse=PULSE, velocity_pulse=VELOCITY_PULSE, structures=(("1", 2.0, 0.2),)):
    measures, spectrum = record_measures(accelerogram), response_spectrum(accelerogram)
    return RecordSheet(accelerogram, measures, spectrum, pulse, velocity_pulse, structures)


def axes_of_the_spectrum(svg):
    """What the numbers beside the spectrum tell a reader: period of x, acceleration of y, both of mm."""
    written = [(each, number(each.text)) for each in texts(svg) if each.x < MIDDLE and each.colour == "black"]
    below = [
        (each.x, value)
        for each, value in written
        if value and each.anchor == "middle" and SPECTRUM_FOOT < each.y < 63
    ]
    beside = [
        (each.y, value)
        for each, value in written
        if value and each.anchor == "end" and each.y < SPECTRUM_FOOT and each.x < 14
    ]
    # a digit's middle is 0.36 of its size above its base line
    raised = 0.36 * 7 * 25.4 / 72
    return read_axis(below, True), read_axis([(y - raised, value) for y, value in beside], True)


def test_the_structures_stand_at_their_period_and_uplift_acceleration():
    svg = record_sheet(sheet(structures=[("1", 2.0, 0.2), ("2", 0.7, 0.35)])).svg()
    period, acceleration = axes_of_the_spectrum(svg)
    marks = circles(svg, "#0072B2")
    # a reader's ruler resolves a hundredth of a millimetre on decades of some 20 mm
    assert period(marks[:, 0]) == pytest.approx([2 * math.pi / 2.0, 2 * math.pi / 0.7], rel=5e-3)
    assert acceleration(marks[:, 1]) == pytest.approx([g * 0.2, g * 0.35], rel=2e-2)
    assert {"Tg", "Tp", "1", "2"} <= {each.text for each in texts(svg)}


def test_the_spectrum_is_that_of_the_record():
    shown = sheet()
    svg = record_sheet(shown).svg()
    period, _ = axes_of_the_spectrum(svg)
    curve = max((line for line in paths(svg, "black") if line[:, 0].max() < MIDDLE), key=len)
    largest = curve[curve[:, 1].argmin(), 0]
    expected = shown.spectrum.periods[shown.spectrum.pseudo_acceleration.argmax()]
    assert period(largest) == pytest.approx(expected, rel=0.03)  # a step of the periods


def test_the_peaks_are_those_of_the_measures():
    shown = sheet()
    peaks = circles(record_sheet(shown).svg(), "black")
    named = [
        number(
            min(texts(record_sheet(shown).svg()), key=lambda each: math.hypot(each.x - x, each.y - y)).text
        )
        for x, y in peaks
    ]
    assert named == pytest.approx([shown.measures.peak_velocity, shown.measures.peak_displacement], rel=5e-3)


@pytest.mark.parametrize(
    "shown",
    [
        sheet(structures=()),
        sheet(velocity_pulse=None),
        sheet(Accelerogram(np.zeros(500), STEP), None, None),
        sheet(Accelerogram(np.zeros(500), STEP), None, None, ()),
        sheet(structures=[(f"{i}", 1 + 0.01 * i, 0.2) for i in range(40)]),
    ],
    ids=["no structure", "no velocity pulse", "still", "still and no structure", "many structures"],
)
def test_it_is_drawn_the_same_at_every_run(shown):
    assert record_sheet(shown).svg() == record_sheet(shown).svg()
