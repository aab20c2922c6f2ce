"""The dominant sine pulse of a record, its rivals, and the evidence to trust or refuse it."""

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.choice import chosen_by_demand
from rocking.pulses.evidence import THRESHOLDS, Light, Thresholds, light
from rocking.pulses.extraction import energy_map, extract_pulses
from rocking.pulses.flags import Flag
from rocking.pulses.interval import PulseInterval, pulse_interval
from rocking.pulses.orientation import OrientedAnalysis, extract_pulses_oriented
from rocking.pulses.pulse import Pulse
from rocking.pulses.settings import PulseSettings
from rocking.pulses.velocity_pulse import VelocityPulse, velocity_pulse

__all__ = [
    "THRESHOLDS",
    "Flag",
    "Light",
    "OrientedAnalysis",
    "Pulse",
    "PulseAnalysis",
    "PulseEvidence",
    "PulseInterval",
    "PulseSettings",
    "Thresholds",
    "VelocityPulse",
    "chosen_by_demand",
    "energy_map",
    "extract_pulses",
    "extract_pulses_oriented",
    "light",
    "pulse_interval",
    "velocity_pulse",
]
