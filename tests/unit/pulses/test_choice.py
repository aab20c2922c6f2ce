"""The choice of a pulse by demand."""

import numpy as np

from rocking.pulses import Pulse, chosen_by_demand, extract_pulses
from rocking.records.accelerogram import Accelerogram

TIMES = np.arange(3000) * 0.01
SAMPLES = Pulse(3, 2 * np.pi / 0.6, 5).acceleration(TIMES) + Pulse(1, 2 * np.pi / 3, 15).acceleration(TIMES)
ANALYSIS = extract_pulses(Accelerogram(SAMPLES, 0.01))


def test_the_pulse_of_largest_demand_is_chosen():
    assert ANALYSIS.dominant.period < 1
    chosen = chosen_by_demand(ANALYSIS, lambda pulse: abs(pulse.amplitude) * pulse.period**2)
    assert abs(chosen.pulse.period - 3) < 1e-6


def test_without_a_difference_the_dominant_pulse_stays():
    assert chosen_by_demand(ANALYSIS, lambda pulse: 0.0) is ANALYSIS.evidence
    assert chosen_by_demand(ANALYSIS, lambda pulse: np.inf) is ANALYSIS.evidence


def test_only_the_first_are_asked():
    assert chosen_by_demand(ANALYSIS, lambda pulse: pulse.period, among=1) is ANALYSIS.evidence
