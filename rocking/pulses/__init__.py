"""The dominant sine pulse of a record, its rivals, and the evidence to trust or refuse it."""

from rocking.pulses.extraction import extract_pulses as extract_pulses
from rocking.pulses.methods import DEFAULT_PULSE_METHOD as DEFAULT_PULSE_METHOD
from rocking.pulses.methods import DEMAND_CANDIDATES as DEMAND_CANDIDATES
from rocking.pulses.methods import PULSE_METHODS as PULSE_METHODS
from rocking.pulses.pulse import Pulse as Pulse
from rocking.pulses.pulse import PulseAnalysis as PulseAnalysis
from rocking.pulses.pulse import PulseEvidence as PulseEvidence
from rocking.pulses.pulse import PulseSettings as PulseSettings
from rocking.pulses.pulse import predicting_pulse as predicting_pulse
from rocking.pulses.velocity_pulse import VelocityPulse as VelocityPulse
from rocking.pulses.velocity_pulse import velocity_pulse as velocity_pulse
