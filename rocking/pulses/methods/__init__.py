"""The registry of pulse methods: the values of the setting pulse.choice, the default first."""

from collections.abc import Mapping

from rocking.errors import PulseError
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


def pulse_method(name: str) -> PulseMethod:
    """Return the method of that name. Raises PulseError with the names there are."""
    if name not in PULSE_METHODS:
        raise PulseError(f"The pulse method is {name!r}, but must be one of {', '.join(PULSE_METHODS)}.")
    return PULSE_METHODS[name]
