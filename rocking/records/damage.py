"""Damage that the samples themselves tell of: a struck sample, gaps, lines exchanged, repeated or copied elsewhere.

Each test asks whether what stands there could be chance, in so long a record; none of the real files is accused.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.remarks import Kind, Remark

_ODDS = 100.0
"""The odds of damage against chance that a warning asks, over all places of a record at which it could stand."""


def damage_warnings(record: Accelerogram, per_line: int) -> tuple[Remark, ...]:
    """Return a warning for each kind of damage in a record, of whose samples `per_line` stand on a line of its file."""
    tests = (
        _sample_alone(record),
        _zeros_in_shaking(record),
        _still_stretch(record),
        _exchanged_lines(record, per_line),
        _copied_stretch(record, per_line),
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


_ORDER = 6
"""Samples from which the next is foretold."""
_FITTED = 6000
"""Samples, the strongest of the record, to which the foretelling is fitted."""
_AROUND = 51
"""Samples whose mean square is the motion around one."""
_FEWEST_ROWS = 8


def _exchanged_lines(record: Accelerogram, per_line: int) -> Remark | None:
    """Return a warning where two neighbouring lines of `per_line` samples seem to be exchanged.

    Each sample is foretold from those before it by coefficients fitted to the record. What the first samples of a line
    are off by tells whether it follows the line before: of the two orders of a pair of lines, the likelihood ratio is
    (S as they stand / S exchanged)^(n/2) for n samples at three borders whose squared errors sum to S. That of a whole
    file is below its number of lines with such odds as are asked for; of 180 real files none reaches a fifth of that.
    """
    order = min(_ORDER, per_line)
    rows = record.acceleration.size // max(1, per_line)
    if per_line < 4 or rows < _FEWEST_ROWS or record.acceleration.size < _SHORTEST:
        return None
    if not record.acceleration.any():
        return None
    table = record.acceleration[: rows * per_line].reshape(rows, per_line)
    weights = _foretelling(record.acceleration, order)
    following = _surprise(table[:-1], table[1:], weights)
    skipping = _surprise(table[:-2], table[2:], weights)
    backwards = _surprise(table[1:], table[:-1], weights)
    usual = _usual(following) + order * _rounding(record.acceleration, weights)
    as_it_stands = following[:-2] + following[1:-1] + following[2:]
    exchanged = skipping[:-1] + backwards[1:-1] + skipping[1:]
    ratio = (as_it_stands + usual[1:-1]) / (exchanged + usual[1:-1])
    at = int(ratio.argmax())
    if 1.5 * order * math.log(float(ratio[at])) < math.log(_ODDS * rows):
        return None
    time = (at + 2) * per_line * record.time_step
    return Remark.of(Kind.LINES_EXCHANGED, time_s=time)


def _foretelling(values: np.ndarray, order: int) -> np.ndarray:
    """Return the weights (order,), the latest first, by which a sample follows from those before it, least squares.

    Each sample counts by the motion around it, so that the quiet parts count as much as the strong ones.
    """
    # The stretch of `size` samples with most energy.
    size = min(values.size, _FITTED)
    energy = np.concatenate([[0.0], np.cumsum(np.square(values))])
    start = int(np.argmax(energy[size:] - energy[:-size]))
    part = values[start : start + size]

    window = np.full(_AROUND, 1 / _AROUND)
    around = np.sqrt(np.convolve(np.square(part), window, "same"))
    scale = (around + 1e-3 * np.abs(part).max())[order:]

    # The normal equations, steadied where samples before say the same as others.
    columns = [part[order - lag : size - lag] / scale for lag in range(1, order + 1)]
    known = np.array([[np.sum(a * b) for b in columns] for a in columns])
    wanted = np.array([np.sum(a * part[order:] / scale) for a in columns])
    steadied = known + 1e-9 * np.trace(known) / order * np.eye(order)
    weights: np.ndarray = np.linalg.solve(steadied, wanted)
    return weights


def _surprise(before: np.ndarray, after: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Return the squared errors (m,), summed, of the first samples of lines `after` (m, k) foretold from `before`."""
    order = weights.size
    joint = np.concatenate([before[:, -order:], after[:, :order]], axis=1)
    off = np.zeros((2 * order, order))  # what each of the first samples is less what was foretold of it
    for place in range(order):
        off[place : place + order, place] = -weights[::-1]
        off[place + order, place] = 1.0
    total: np.ndarray = np.square(np.einsum("ij,jk", joint, off)).sum(axis=1)
    return total


def _usual(surprises: np.ndarray, reach: int = 8) -> np.ndarray:
    """Return the median (m,) of each of `surprises` (m,) and the `reach` before and after it."""
    padded = np.pad(surprises, reach, mode="edge")
    medians: np.ndarray = np.median(sliding_window_view(padded, 2 * reach + 1), axis=1)
    return medians


def _rounding(values: np.ndarray, weights: np.ndarray) -> float:
    """Return the square by which a foretold sample is off because the file rounds its numbers to a digit."""
    levels = np.unique(values[:_FITTED])
    digit = float(np.diff(levels).min(initial=np.inf))
    return digit**2 / 6 * (1 + float(np.sum(np.square(weights)))) if math.isfinite(digit) else 0.0


_LEAST_COPY = 8
"""Samples that no ground repeats digit by digit, where lines are longer."""
_LOUD = 0.005
"""Share of the peak that a stretch must span: in noise of few digits the same numbers come again and again."""
_RIVALS = 3.0
"""The least length of a copy over that of the next longest: what repeats often is coarse, or made by a formula."""
_LARGEST_SHARE = 0.3


def _copied_stretch(record: Accelerogram, per_line: int) -> Remark | None:
    """Return a warning where one stretch of the samples stands in the record twice, digit by digit."""
    values = record.acceleration
    size = per_line if 4 <= per_line <= _LEAST_COPY else _LEAST_COPY
    if values.size < _SHORTEST:
        return None
    first, second = _same_windows(values, size)
    if not first.size:
        return None
    starts, lengths = _runs(first, second)
    longest = _loud_runs(values, starts, lengths + size - 1, _LOUD * record.peak_acceleration)
    place, length = next(longest, (0, 0))
    _, rival = next(longest, (0, 0))
    if not length or length < _RIVALS * rival or length > _LARGEST_SHARE * values.size:
        return None
    one, two = (sample * record.time_step for sample in starts[place])
    return Remark.of(Kind.STRETCH_COPIED, samples=length, time_s=two, first_s=one)


def _loud_runs(
    values: np.ndarray, starts: Sequence[tuple[int, int]], lengths: np.ndarray, least: float
) -> Iterator[tuple[int, int]]:
    """Yield place and length [samples] of the runs whose samples span more than `least`, the longest first.

    Of the whole run: while the ground moves slowly, eight samples of a copy may span little.
    """
    for place in np.argsort(lengths, kind="stable")[::-1].tolist():
        begin = starts[place][0]
        length = int(lengths[place])
        if np.ptp(values[begin : begin + length]) > least:
            yield place, length


def _same_windows(values: np.ndarray, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the places (m,) and (m,) of each two neighbouring windows, in the order of content, that are the same."""
    bits = np.ascontiguousarray(values + 0.0).view(np.uint64)  # adding zero makes one zero of the two
    mixed = (bits ^ (bits >> np.uint64(29))) * np.uint64(0x9E3779B97F4A7C15)
    sums = np.zeros(values.size - size + 1, dtype=np.uint64)
    for place in range(size):
        sums = sums * np.uint64(6364136223846793005) + mixed[place : place + sums.size]
    ascending = np.sort(sums)
    twice = np.unique(ascending[1:][ascending[1:] == ascending[:-1]])
    if not twice.size:
        return np.empty(0, dtype=int), np.empty(0, dtype=int)
    nearest = np.minimum(np.searchsorted(twice, sums), twice.size - 1)
    places = np.flatnonzero(twice[nearest] == sums)
    order = places[np.argsort(sums[places], kind="stable")]
    same = np.flatnonzero(sums[order][1:] == sums[order][:-1])
    return order[same], order[same + 1]


def _runs(first: np.ndarray, second: np.ndarray) -> tuple[list[tuple[int, int]], np.ndarray]:
    """Return the start and the length of each run of windows that are the same at one distance from one another."""
    order = np.lexsort((first, second - first))
    places = first[order]
    apart = (second - first)[order]
    begins = np.flatnonzero((np.diff(places, prepend=-2) != 1) | (np.diff(apart, prepend=-1) != 0))
    lengths = np.diff(begins, append=places.size)
    starts = [(int(places[at]), int(places[at] + apart[at])) for at in begins]
    return starts, lengths


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
