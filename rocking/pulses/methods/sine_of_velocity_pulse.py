"""The sine of acceleration where, and about as long as, the velocity pulse (Shahi & Baker 2014) of a component is.

The closed form asks for a sine of acceleration, and the period T_p of a velocity pulse is not its period: the wavelet
of a sine cycle is 1.93 times as long. So the velocity pulse only says where to look, and the sine is fitted there.
"""

import math

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence, evidence_of
from rocking.pulses.method import PulseMethod
from rocking.pulses.pulse import Pulse
from rocking.pulses.search import PulseSearch, searched_band
from rocking.pulses.settings import PulseSettings
from rocking.pulses.velocity_pulse import LONGEST_PERIOD, SHORTEST_PERIOD, largest_velocity_pulse
from rocking.records.accelerogram import Accelerogram

PERIOD_OF_SINE = 1.93
"""T_p of the wavelet that fits a sine cycle of acceleration best, over the period of the cycle."""
SEARCH = PulseSettings(
    lowest_frequency=1 / LONGEST_PERIOD, highest_frequency=2 * PERIOD_OF_SINE / SHORTEST_PERIOD
)


def _candidates(analysis: PulseAnalysis) -> tuple[PulseEvidence, ...]:
    return (evidence_of(sine_of_velocity_pulse(analysis.accelerogram), analysis.accelerogram),)


def sine_of_velocity_pulse(accelerogram: Accelerogram) -> Pulse:
    """Return the sine of largest energy gain within half a period and half an octave of the largest velocity pulse.

    The largest pulse is taken whether or not the indicator, which depends on the size of the motion, calls it one.
    Raises PulseError when the record is still or too short for a velocity pulse.
    """
    velocity_period, centre = largest_velocity_pulse(accelerogram)
    period = velocity_period / PERIOD_OF_SINE
    there = Pulse(1.0, 2 * math.pi / period, centre - period / 2)
    search = PulseSearch(accelerogram.time_step, searched_band(accelerogram, SEARCH), SEARCH)
    window = search.window(there, accelerogram.acceleration.size)
    return search.near(there, accelerogram.acceleration[window], window)


METHOD = PulseMethod(
    "velocity", "the sine of acceleration in the velocity pulse of the component", _candidates
)
