"""The kinds of warnings on the pulses of a record, with the sentence of each."""

from enum import auto

from rocking.warnings import Kind


class PulseKind(Kind):
    """A kind of warning on the pulses of a record."""

    # fmt: off
    # The dominant pulse of a record.
    PULSE_UNSTABLE = auto(), "The choice is unstable: another pulse often wins when the record is turned."
    PULSE_AT_AN_END = auto(), "The pulse touches an end of the record, so part of it may be missing."
    PULSE_FILTERED = auto(), "The pulse is long enough that the record's high-pass filter has reduced it."
    PULSE_SYMMETRIC = auto(), """Two pulses of opposite sign, half a cycle apart, represent the motion equally
        well."""
    PULSE_AT_BAND_LIMIT = auto(), """The period lies at a limit of the band that was searched, so the true
        pulse may lie outside it."""
    PULSE_RECORD_SHORT = auto(), """The record is shorter than the longest period searched for, so that period was
        left out."""
    PULSE_SAMPLING_COARSE = auto(), """The sampling is too coarse for the upper frequency; shorter periods
        were left out."""
    PULSE_NEXT_TO_GAP = auto(), """The record holds a run of identical samples longer than a second, which may
        be a gap that was filled."""
    # fmt: on
