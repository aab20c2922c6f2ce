"""The motion of a pair of components: which two are a pair, and what it says of them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocking.assessment.rows.of_record import ComponentRow, horizontal_motions, record_row
from rocking.pulses import Pulse
from rocking.records import Accelerogram

STEP = 0.01
MOTION = Pulse(3.0, math.pi, 10.0).acceleration(np.arange(3000) * STEP)
IDENTITY = ComponentRow.of()


def component(share: float, name: str, azimuth: float | None = None, **changes) -> Accelerogram:
    return replace(Accelerogram(share * MOTION, STEP, name, azimuth=azimuth), **changes)


def test_a_pair_has_one_motion_and_its_axis_from_north():
    north, east = component(math.cos(0.3), "N", 0.0), component(math.sin(0.3), "E", 90.0)
    one, other = horizontal_motions([north, east])
    assert one is other
    assert one.velocity_pulse_azimuth == pytest.approx(math.degrees(0.3))
    assert one.velocity_pulse.orientation == pytest.approx(0.3)
    assert one.rotd.rotd100 == pytest.approx(3.0, rel=1e-3)
    written = record_row(IDENTITY, north, "", None, one, Pulse(1.0, math.pi))
    assert written.rotd50_peak_acceleration_m_s2 == one.rotd.rotd50
    assert written.rotd100_peak_acceleration_m_s2 == one.rotd.rotd100
    assert written.pulse_periods_unlike is one.velocity_pulse.is_unlike(Pulse(1.0, math.pi))
    assert written.pulse_period_ratio == pytest.approx(2.0 / one.velocity_pulse.period)
    alone = record_row(IDENTITY, north, "", component(0.1, ""), horizontal_motions([north])[0], None)
    assert math.isnan(alone.rotd100_peak_acceleration_m_s2) and math.isnan(alone.pulse_period_ratio)
    assert alone.vertical_component == "not named"


@pytest.mark.parametrize(
    "others",
    [[], [component(1, "E", time_step=0.02)], [component(1, "a"), component(1, "b")]],
    ids=["one", "another time step", "three"],
)
def test_what_is_no_pair_stands_alone(others):
    motions = horizontal_motions([component(1.0, "S", 200.0), *others])
    assert len(motions) == 1 + len(others)
    assert motions[0].rotd is None
    assert motions[0].velocity_pulse.period == pytest.approx(1.93 * 2.0, rel=0.02)
    assert motions[0].velocity_pulse_azimuth == 20.0


def test_a_still_or_short_record_has_no_velocity_pulse():
    for short in (Accelerogram(np.zeros(3000), STEP), Accelerogram(np.ones(50), STEP)):
        (motion,) = horizontal_motions([short])
        assert motion.velocity_pulse is None and motion.velocity_pulse_azimuth is None
        assert record_row(IDENTITY, short, "", None, motion, Pulse(1.0, 1.0)).pulse_periods_unlike is None


def test_periods_more_than_a_factor_2_apart_are_unlike():
    (motion,) = horizontal_motions([component(1.0, "N")])
    period = motion.velocity_pulse.period
    assert motion.velocity_pulse.is_unlike(Pulse(1.0, 2 * math.pi / (0.49 * period))) is True
    assert motion.velocity_pulse.is_unlike(Pulse(1.0, 2 * math.pi / (0.51 * period))) is False
