"""What may be wrong with a dominant pulse: each flag with its sentence for the reader and the rule that raises it."""

from enum import StrEnum

import numpy as np

from rocking.pulses.pulse import Pulse

AMBIGUOUS_GAIN_RATIO = 0.85
"""Second gain over first above which the choice between the two is not the record's."""
ADJOINING_PERIOD_CHANGE = 0.25
"""Relative change of period up to which a neighbouring cycle continues the same oscillation."""
ADJOINING_GAP = 0.25
"""Distance between the end of one cycle and the start of the next, in periods, up to which they adjoin."""
OSCILLATION_GAIN_RATIO = 0.7
"""Gain of the half-shifted twins over that of a cycle amid an oscillation: 1 in two full cycles, 0.25 in one."""
EDGE_ACCELERATION = 0.3
"""First or last acceleration over the pulse's amplitude from which the motion was cut, not quiet."""
EDGE_DISTANCE = 0.1
"""Distance from an end of the record, in periods, below which the cycle may have been cut."""
FILTERED_CYCLES = 0.2
"""Periods beyond this share of the longest period that a high-pass leaves are reduced by it."""
GAP_DURATION = 1.0
"""Run of identical samples, s, that looks like a filled gap."""


class Flag(StrEnum):
    """A reason to doubt a dominant pulse."""

    AMBIGUOUS = "ambiguous"
    MULTI_CYCLE = "multi_cycle"
    EDGE = "edge"
    FILTERED = "filtered"
    SYMMETRIC = "symmetric"
    BAND_LIMIT = "band_limit"
    SHORT_RECORD = "short_record"
    COARSE_SAMPLING = "coarse_sampling"
    GAP = "gap"

    @property
    def sentence(self) -> str:
        """One sentence for the reader."""
        return _SENTENCES[self]


_SENTENCES = {
    Flag.AMBIGUOUS: "A second pulse explains nearly as much energy as the dominant one; read both predictions.",
    Flag.MULTI_CYCLE: "The next cycle continues the pulse; one cycle predicts such a motion badly.",
    Flag.EDGE: "The pulse touches an end of the record, so part of it may be missing.",
    Flag.FILTERED: "The pulse is long enough that the record's high-pass filter has reduced it.",
    Flag.SYMMETRIC: "Two pulses of opposite sign, half a cycle apart, stand for the motion equally well.",
    Flag.BAND_LIMIT: "The period lies at a limit of the band that was searched, so the true pulse may lie outside it.",
    Flag.SHORT_RECORD: "The record is shorter than the longest period sought, so that period was left out.",
    Flag.COARSE_SAMPLING: "The sampling is too coarse for the upper frequency; shorter periods were left out.",
    Flag.GAP: "The record holds a run of identical samples longer than a second, which may be a gap that was filled.",
}


def ambiguous(gain_ratio: float) -> bool:
    """Whether the second gain over the first is too close to one."""
    return gain_ratio > AMBIGUOUS_GAIN_RATIO


def adjoins(pulse: Pulse, neighbour: Pulse) -> bool:
    """Whether `neighbour` begins where `pulse` ends, or ends where it begins, with nearly its period."""
    change = abs(neighbour.period / pulse.period - 1)
    gap = min(abs(neighbour.start_time - pulse.end_time), abs(pulse.start_time - neighbour.end_time))
    return change <= ADJOINING_PERIOD_CHANGE and gap <= ADJOINING_GAP * pulse.period


def oscillates(pulse: Pulse, strong_rivals: list[Pulse]) -> bool:
    """Whether twins of opposite sign lie half a cycle before and after: the middle cycle of a longer motion."""
    twins = [rival for rival in strong_rivals if _twin(pulse, rival)]
    return any(t.start_time < pulse.start_time for t in twins) and any(
        t.start_time > pulse.start_time for t in twins
    )


def at_edge(pulse: Pulse, samples: np.ndarray, time_step: float) -> bool:
    """Whether the cycle lies within a tenth of a period of an end, or within one of an end that is not quiet."""
    rooms = pulse.start_time / pulse.period, ((samples.size - 1) * time_step - pulse.end_time) / pulse.period
    cut = np.abs(samples[[0, -1]]) > EDGE_ACCELERATION * abs(pulse.amplitude)
    return any(room < (1.0 if loud else EDGE_DISTANCE) for room, loud in zip(rooms, cut, strict=True))


def filtered(pulse: Pulse, high_pass_frequency: float | None) -> bool:
    """Whether the period exceeds 0.2 / f_highpass; False when no high-pass is known."""
    return high_pass_frequency is not None and pulse.period > FILTERED_CYCLES / high_pass_frequency


def mirrored(pulse: Pulse, rival: Pulse, gain_ratio: float) -> bool:
    """Whether `rival` is the other solution of a symmetric shape: opposite sign, half a cycle away, as much gain."""
    return gain_ratio > AMBIGUOUS_GAIN_RATIO and _twin(pulse, rival)


def _twin(pulse: Pulse, rival: Pulse) -> bool:
    distance = abs(rival.start_time + rival.period / 2 - pulse.start_time - pulse.period / 2)
    return (
        rival.amplitude * pulse.amplitude < 0
        and abs(rival.period / pulse.period - 1) <= ADJOINING_PERIOD_CHANGE
        and abs(distance / pulse.period - 0.5) <= ADJOINING_GAP / 2
    )


def holds_gap(samples: np.ndarray, time_step: float) -> bool:
    """Whether other samples enclose a run of identical ones longer than a second; padding at the ends is no gap."""
    changes = np.flatnonzero(np.diff(samples))
    return bool((np.diff(changes).max(initial=1) - 1) * time_step > GAP_DURATION)
