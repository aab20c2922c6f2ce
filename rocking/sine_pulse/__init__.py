"""The equivalent block under one full sine pulse: exact maximum, regime and spectrum; Eqs. 15 and 16 as printed."""

from rocking.sine_pulse.maximum import Maximum as Maximum
from rocking.sine_pulse.maximum import Regime as Regime
from rocking.sine_pulse.maximum import overturning_amplitudes as overturning_amplitudes
from rocking.sine_pulse.maximum import overturning_margins as overturning_margins
from rocking.sine_pulse.maximum import predict_maxima as predict_maxima
from rocking.sine_pulse.maximum import predict_maximum as predict_maximum
from rocking.sine_pulse.maximum import printed_maximum as printed_maximum
from rocking.sine_pulse.maximum import pulse_end_energy as pulse_end_energy
from rocking.sine_pulse.maximum import pulse_spectrum as pulse_spectrum
