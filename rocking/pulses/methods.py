"""The pulse methods: ways to say which pulse of a record predicts, and their registry, the default first."""

import math
from collections.abc import Mapping

from rocking.pulses.extraction import PulseSearch
from rocking.pulses.pulse import Pulse, PulseEvidence, PulseMethod, PulseSettings
from rocking.pulses.velocity_pulse import LONGEST_PERIOD, SHORTEST_PERIOD, largest_velocity_pulse
from rocking.signal.accelerogram import Accelerogram

DEMAND_CANDIDATES = 5
"""Best-ranked sines among which that of largest demand is chosen."""
PERIOD_OF_SINE = 1.93
"""T_p of the wavelet that fits a sine cycle of acceleration best, over the period of the cycle."""


def sine_of_velocity_pulse(accelerogram: Accelerogram) -> PulseEvidence:
    """Return the sine of most energy gain within half a period and half an octave of the largest velocity pulse.

    The closed form needs a sine of acceleration, and the period T_p of a velocity pulse (Shahi & Baker 2014) is not
    its period: so the velocity pulse only says where to look, and the sine is fitted there. The largest velocity pulse
    is taken whether or not the indicator, which depends on the size of the motion, calls it one.
    Raises PulseError when the record is still or too short for a velocity pulse.
    """
    settings = PulseSettings(
        lowest_frequency=1 / LONGEST_PERIOD, highest_frequency=2 * PERIOD_OF_SINE / SHORTEST_PERIOD
    )
    velocity_period, centre = largest_velocity_pulse(accelerogram)
    period = velocity_period / PERIOD_OF_SINE
    there = Pulse(amplitude=1.0, circular_frequency=2 * math.pi / period, start_time=centre - period / 2)
    return PulseSearch.of(accelerogram, settings).near(there, accelerogram.acceleration)


DEFAULT_PULSE_METHOD = "energy"
PULSE_METHODS: Mapping[str, PulseMethod] = {
    method.name: method
    for method in (
        PulseMethod(
            DEFAULT_PULSE_METHOD,
            "the sine that explains most of the record's acceleration energy",
            lambda analysis: (analysis.evidence,),
        ),
        PulseMethod(
            "demand",
            f"of the {DEMAND_CANDIDATES} best-ranked sines the one that turns the structure farthest",
            lambda analysis: analysis.ranked[:DEMAND_CANDIDATES],
        ),
        PulseMethod(
            "velocity",
            "the sine of acceleration in the velocity pulse of the component",
            lambda analysis: (sine_of_velocity_pulse(analysis.accelerogram),),
        ),
    )
}
