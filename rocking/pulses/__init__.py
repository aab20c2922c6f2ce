"""The dominant sine pulse of a record, its rivals, and the evidence to trust or refuse it."""

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.extraction import energy_map, extract_pulses
from rocking.pulses.flags import Flag
from rocking.pulses.interval import PulseInterval, pulse_interval
from rocking.pulses.method import PulseMethod, predicting_pulse
from rocking.pulses.methods import DEFAULT_PULSE_METHOD, PULSE_METHODS
from rocking.pulses.orientation import OrientedAnalysis, extract_pulses_oriented
from rocking.pulses.pulse import Pulse
from rocking.pulses.settings import PulseSettings
from rocking.pulses.velocity_pulse import VelocityPulse, velocity_pulse

__all__ = [
    "DEFAULT_PULSE_METHOD",
    "PULSE_METHODS",
    "Flag",
    "OrientedAnalysis",
    "Pulse",
    "PulseAnalysis",
    "PulseEvidence",
    "PulseInterval",
    "PulseMethod",
    "PulseSettings",
    "VelocityPulse",
    "energy_map",
    "extract_pulses",
    "extract_pulses_oriented",
    "predicting_pulse",
    "pulse_interval",
    "velocity_pulse",
]
