"""The equivalent block under one full sine pulse: exact maximum, regime and spectrum; Eqs. 15 and 16 as printed."""

from rocking.sine_pulse.maxima import overturning_amplitudes, overturning_margins, predict_maxima
from rocking.sine_pulse.maximum import Maximum, Regime, predict_maximum
from rocking.sine_pulse.printed import printed_maximum, pulse_end_energy
from rocking.sine_pulse.spectrum import pulse_spectrum

__all__ = [
    "Maximum",
    "Regime",
    "overturning_amplitudes",
    "overturning_margins",
    "predict_maxima",
    "predict_maximum",
    "printed_maximum",
    "pulse_end_energy",
    "pulse_spectrum",
]
