"""The registry of pulse methods: the values of the setting pulse.choice, the default first."""

from collections.abc import Mapping

from rocking.pulses.method import PulseMethod
from rocking.pulses.methods import sine_by_demand, sine_by_energy, sine_of_velocity_pulse

PULSE_METHODS: Mapping[str, PulseMethod] = {
    method.name: method
    for method in (
        sine_by_energy.METHOD,
        sine_by_demand.METHOD,
        sine_of_velocity_pulse.METHOD,
    )
}
DEFAULT_PULSE_METHOD = sine_by_energy.METHOD.name
