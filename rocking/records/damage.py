"""Damage that the samples themselves tell of: a struck sample, gaps, a row that is repeated.

Each test asks whether what stands there could be chance, in so long a record; none of the real files is accused.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.remarks import Kind, Remark

_ODDS = 100.0
"""The odds of damage against chance that a warning asks, over all places of a record at which it could stand."""


def damage_warnings(record: Accelerogram) -> tuple[Remark, ...]:
    """Return a warning for each kind of damage in a record."""
    tests = (
        _sample_alone(record),
        _zeros_in_shaking(record),
        _still_stretch(record),
    )
    return tuple(each for each in tests if each is not None)


_ALONE = 3.0, 2.0
"""A sample alone: this many times the three beside it on each side, and the largest of all others.

Of the strongest real records a peak reaches 2.6 and 1.1, or 1.7 and 1.6 times.
"""
_NEIGHBOURS = 3
_SHORTEST = 100
"""Samples below which a record is too short for a remark on its course."""


def _sample_alone(record: Accelerogram) -> Remark | None:
    """Return a warning on a sample alone far above all others."""
    magnitudes = np.abs(record.acceleration)
    if magnitudes.size < _SHORTEST or not magnitudes.any():
        return None
    at = int(magnitudes.argmax())
    peak = float(magnitudes[at])
    others = np.delete(magnitudes, at)
    near = others[max(0, at - _NEIGHBOURS) : at + _NEIGHBOURS].max()
    if peak <= _ALONE[0] * near or peak <= _ALONE[1] * others.max():
        return None
    return Remark.of(
        Kind.SAMPLE_ALONE,
        time_s=at * record.time_step,
        peak_g=peak / GRAVITY,
        others_g=float(others.max()) / GRAVITY,
    )


_ZEROS = 50
"""Exact zeros in a row that no recorder writes while the ground shakes; real files hold at most 14."""


def _zeros_in_shaking(record: Accelerogram) -> Remark | None:
    """Return a warning on zeros within strong shaking, between 5 and 95 % of the energy."""
    magnitudes = np.abs(record.acceleration)
    if magnitudes.size < 2 * _ZEROS or not magnitudes.any():
        return None
    spent = np.cumsum(np.square(magnitudes))
    begin, end = np.searchsorted(spent, np.array([0.05, 0.95]) * spent[-1])
    moving = np.flatnonzero(magnitudes[begin : end + 1])
    longest = int(np.diff(moving).max(initial=0)) - 1
    if longest < _ZEROS:
        return None
    return Remark.of(Kind.ZEROS_IN_SHAKING, samples=longest)


_BESIDE = 100
"""Samples on each side of a stretch by which it is judged, at least a fifth of which must be there."""
_SHORT = 20
"""Samples in a row that may be the same at a crest, or where a trace was clipped, without a word."""
_LIVELY = 0.5
"""Share of the steps beside a still stretch that must change the value: in files of few digits even noise is still."""


def _still_stretch(record: Accelerogram) -> Remark | None:
    """Return a warning where the value stays what it is for longer than the samples on both sides allow.

    Where a share q of the steps beside it change the value, n steps in a row change nothing in (1 - q)ⁿ of cases.
    """
    values = record.acceleration
    changes = np.flatnonzero(np.diff(values))
    if changes.size < 2 * _BESIDE // 5:
        return None
    steps = np.diff(changes) - 1
    # Not of the longest alone: a record that begins or ends still has a longer one there.
    for place in np.argsort(steps, kind="stable")[::-1].tolist():
        if steps[place] < _SHORT:
            break
        first = int(changes[place]) + 1
        last = int(changes[place + 1])
        before = _share_of_changes(values[:first][-_BESIDE:])
        after = _share_of_changes(values[last + 1 :][:_BESIDE])
        share = min(before, after)
        by_chance = (last - first) * math.log1p(-min(share, 1 - 1 / _BESIDE)) + math.log(values.size)
        if share >= _LIVELY and by_chance <= -3 * math.log(_ODDS):
            return Remark.of(Kind.STILL_STRETCH, time_s=first * record.time_step, samples=last - first + 1)
    return None


def _share_of_changes(values: np.ndarray) -> float:
    """Return the share of the steps of `values` that change the value, 0 of too few."""
    return float(np.mean(np.diff(values) != 0)) if values.size >= _BESIDE // 5 else 0.0


_STILL = 1 / 200
"""Least share of steps without a change that is believed of a channel, from the two hundred beside."""


def repeated_rows(records: Sequence[Accelerogram]) -> Remark | None:
    """Return a warning where a row of numbers, one of each of several channels, stands twice in succession.

    By chance no channel changes in the product of the shares in which each does not, from the steps beside it.
    """
    sizes = {record.acceleration.size for record in records}
    if len(records) < 2 or len(sizes) > 1 or min(sizes) < 2 * _BESIDE:
        return None
    still = np.array([np.diff(record.acceleration) == 0 for record in records])
    at = next(_unlikely(still), None)
    if at is None:
        return None
    time = (at + 1) * records[0].time_step
    return Remark.of(Kind.ROW_REPEATED, time_s=time)


def _unlikely(still: np.ndarray) -> Iterator[int]:
    """Yield the steps in which no channel of `still` (channels, n) changes, where that is less than chance."""
    steps = still.shape[1]
    places = np.flatnonzero(still.all(axis=0))
    first = np.maximum(0, places - _BESIDE)
    end = np.minimum(steps, places + _BESIDE + 1)
    counted = np.pad(np.cumsum(still, axis=1), ((0, 0), (1, 0)))
    beside = counted[:, end] - counted[:, first] - 1  # but the step itself
    shares = np.maximum(beside / (end - first - 1), _STILL)
    yield from places[np.prod(shares, axis=0) * steps < 1 / _ODDS].tolist()
