"""The dominant sine pulse of a record, its rivals, and the evidence to trust or refuse it."""

from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.evidence import Light, light
from rocking.pulses.extraction import extract_pulses
from rocking.pulses.flags import Flag
from rocking.pulses.pulse import Pulse
from rocking.pulses.settings import PulseSettings

__all__ = [
    "Flag",
    "Light",
    "Pulse",
    "PulseAnalysis",
    "PulseEvidence",
    "PulseSettings",
    "extract_pulses",
    "light",
]
