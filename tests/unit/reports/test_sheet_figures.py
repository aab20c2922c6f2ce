"""The record sheet: what it shows of a record, and that it is drawn for every record there can be."""

import math

import numpy as np
import pytest
from scipy.constants import g

from rocking.pulses import Pulse
from rocking.records.accelerogram import Accelerogram
from rocking.records.measures import record_measures
from rocking.records.response_spectrum import response_spectrum
from rocking.reports.record.sheet_figures import RecordSheet, _labelled, record_sheet
from rocking.reports.style import svg

STEP = 0.01
PULSE = Pulse(3.0, 2 * math.pi / 0.9, 4.0)
VELOCITY_PULSE = (1.7, 4.5)
MOVING = Accelerogram(PULSE.acceleration(np.arange(2000) * STEP), STEP)


def sheet(accelerogram=MOVING, pulse=PULSE, velocity_pulse=VELOCITY_PULSE, structures=(("1", 2.0, 0.2),)):
    measures, spectrum = record_measures(accelerogram), response_spectrum(accelerogram)
    return RecordSheet(accelerogram, measures, spectrum, pulse, velocity_pulse, structures)


def test_the_structures_stand_at_their_period_and_uplift_acceleration():
    spectrum, zoom, *_ = record_sheet(sheet()).axes
    marks = next(line for line in spectrum.lines if line.get_marker() == "o")
    assert marks.get_xydata() == pytest.approx(np.array([[2 * math.pi / 2.0, g * 0.2]]))
    drawn = spectrum.lines[0].get_xydata()
    assert drawn == pytest.approx(
        np.column_stack((sheet().spectrum.periods, sheet().spectrum.pseudo_acceleration))
    )
    assert zoom.get_xlim() == pytest.approx((4.45 - 1.8, 4.45 + 1.8))
    assert {"$T_g$", "$T_p$", "1"} <= {text.get_text() for text in spectrum.texts}


def test_the_peaks_are_those_of_the_measures():
    shown = sheet()
    *_, velocity, displacement = record_sheet(shown).axes
    peaks = [float(panel.texts[0].get_text()) for panel in (velocity, displacement)]
    assert peaks == pytest.approx([shown.measures.peak_velocity, shown.measures.peak_displacement], rel=5e-3)


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
    assert svg(record_sheet(shown)) == svg(record_sheet(shown))


def test_neighbours_share_a_label():
    places = [(3.0, 2.0), (3.1, 2.1), (0.5, 2.0), (3.0, 0.2)]
    assert sorted(_labelled(places, "abcd")) == [("a, b", (3.1, 2.1)), ("c", (0.5, 2.0)), ("d", (3.0, 0.2))]
