"""The compiled scan: the energy gain of every one-cycle sine at every onset, its maxima, and the shape beneath one.

The compiled functions have one signature each, which read-only and writable samples both meet, and hold plain loops
only: what allocates and prepares is numpy, for compiling array expressions takes longer than running them ever does.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit, types

HELD_ROWS = 64
"""Onsets of the energy map held at a time: enough to spread the cost of a call, few enough for the fast cache."""
WORD = 8
"""Bytes of the mask of candidates that are looked at together."""

_VECTOR, _MATRIX, _CUBE = types.float64[::1], types.float64[:, ::1], types.float64[:, :, ::1]
_COUNTS, _MASK = types.int64[::1], types.uint8[::1]
_SAMPLES = types.Array(types.float64, 1, "C", readonly=True)
_SCAN = (_MATRIX, _COUNTS, _COUNTS, _MATRIX, _VECTOR, _CUBE)


class _Scan(NamedTuple):
    """What carries the scan from one onset to the next.

    padded: (c, n + longest cycle) samples. counts: (m,) samples of each cycle. last_onsets: (m,) samples, at which the
    cycle still fits. turning: (4, m), real and imaginary part of e^{iω dt} and of the e^{iω(t − t_j)} of the sample
    that enters. weights: (m,) dt/⟨s, s⟩. sums: (c, 2, m), S_j of each component.
    """

    padded: np.ndarray
    counts: np.ndarray
    last_onsets: np.ndarray
    turning: np.ndarray
    weights: np.ndarray
    sums: np.ndarray


def _prepared(samples: np.ndarray, time_step: float, angles: np.ndarray, first: int) -> _Scan:
    """Return the scan of samples (c, n) at onset `first`."""
    lengths = 2 * math.pi / angles
    counts = (lengths + 1e-9).astype(np.int64) + 1
    padded = np.zeros((samples.shape[0], samples.shape[1] + counts.max() + 1))
    padded[:, : samples.shape[1]] = samples
    last = (counts - 1) * angles
    turning = np.array([np.cos(angles), np.sin(angles), np.cos(last), np.sin(last)])
    # Σ sin²(kω) over the cycle, in closed form
    norms = counts / 2 - np.sin(counts * angles) * np.cos(last) / (2 * np.sin(angles))
    last_onsets = samples.shape[1] - 1 - np.ceil(lengths - 1e-9).astype(np.int64)
    sums = np.empty((samples.shape[0], 2, angles.size))
    _start(padded, first, counts, turning, sums)
    return _Scan(padded, counts, last_onsets, turning, time_step / norms, sums)


@njit(types.void(_MATRIX, types.int64, _COUNTS, _MATRIX, _CUBE), cache=True)
def _start(padded, first, counts, turning, sums):
    """Fill sums with S_j at onset `first`."""
    for c in range(padded.shape[0]):
        for i in range(counts.size):
            turn_re, turn_im, re, im = turning[0, i], turning[1, i], 0.0, 0.0
            for k in range(counts[i] - 1, -1, -1):
                re, im = re * turn_re - im * turn_im + padded[c, first + k], re * turn_im + im * turn_re
            sums[c, 0, i], sums[c, 1, i] = re, im


@njit(types.void(_MATRIX, types.int64, types.int64, types.int64, *_SCAN), cache=True)
def _fill_rows(rows, begin, end, first, padded, counts, last_onsets, turning, weights, sums):
    """Fill rows[begin:end] with the gains at onsets from `first` and carry the sums past them."""
    m = counts.size
    # copies of one function alone let the compiler see that nothing overlaps, and vectorise the inner loop
    lengths, weight, real, imaginary = np.empty(m, np.int64), np.empty(m), np.empty(m), np.empty(m)
    turn_re, turn_im, enter_re, enter_im = np.empty(m), np.empty(m), np.empty(m), np.empty(m)
    for i in range(m):
        lengths[i], weight[i] = counts[i], weights[i]
        turn_re[i], turn_im[i], enter_re[i], enter_im[i] = (
            turning[0, i],
            turning[1, i],
            turning[2, i],
            turning[3, i],
        )
    for c in range(padded.shape[0]):
        for i in range(m):
            real[i], imaginary[i] = sums[c, 0, i], sums[c, 1, i]
        for b in range(begin, end):
            j = first + b - begin
            leaving = padded[c, j]
            for i in range(m):
                re, im, entering = real[i] - leaving, imaginary[i], padded[c, j + lengths[i]]
                gain = im * im * weight[i]
                rows[b, i] = gain if c == 0 else rows[b, i] + gain
                real[i] = re * turn_re[i] + im * turn_im[i] + entering * enter_re[i]
                imaginary[i] = im * turn_re[i] - re * turn_im[i] + entering * enter_im[i]
        for i in range(m):
            sums[c, 0, i], sums[c, 1, i] = real[i], imaginary[i]
    for b in range(begin, end):
        for i in range(m):
            if (
                first + b - begin <= last_onsets[i]
            ):  # frequencies ascend: the longest cycles stop fitting first
                break
            rows[b, i] = 0.0


def energy_gains(samples: np.ndarray, time_step: float, angles: np.ndarray) -> np.ndarray:
    """Return ⟨a, s⟩²/⟨s, s⟩, (n, m) m²/s³, of the sine of angles[i] rad per sample with onset at each sample.

    samples: (c, n) m/s²; the gains of c components are added. angles: (m,) ascending. 0 where the cycle does not fit
    in the record. S_j = Σ a e^{iω(t − t_j)} over the cycle is a difference of cumulative sums, C[j + T] − C[j], turned
    back by ω t_j; it is carried from one onset to the next, which is the same sum without the large common part.
    """
    gains = np.empty((samples.shape[1], angles.size))
    _fill_rows(gains, 0, samples.shape[1], 0, *_prepared(samples, time_step, angles, 0))
    return gains


@njit(types.boolean(_MATRIX, types.int64, types.int64), cache=True)
def _is_maximum(rows, b, i):
    """Whether rows[b, i] tops its eight neighbours; of equal ones the first counts."""
    gain, m = rows[b, i], rows.shape[1]
    if (i > 0 and rows[b, i - 1] >= gain) or (i < m - 1 and rows[b, i + 1] > gain):
        return False
    for k in range(max(i - 1, 0), min(i + 2, m)):  # noqa: SIM110 (a generator would not compile)
        if rows[b - 1, k] >= gain or rows[b + 1, k] > gain:
            return False
    return True


@njit(types.void(_MATRIX, types.int64, types.float64, _MASK), cache=True)
def _mark(rows, b, floor, mask):
    """Mark the gains of rows[b] above `floor` that top those of the onsets before and after."""
    for i in range(rows.shape[1]):
        gain = rows[b, i]
        mask[i] = (gain > floor) & (gain > rows[b - 1, i]) & (gain >= rows[b + 1, i])


@njit(
    types.int64(_MATRIX, types.int64, types.int64, _MASK, types.int64[:, ::1], _VECTOR, types.int64),
    cache=True,
)
def _collected(rows, b, onset, mask, places, found, k):
    """Append the maxima among the marked gains of rows[b] to the first k of places and found; return how many."""
    words = mask.view(np.uint64)
    for w in range(words.size):
        if words[w] == 0:
            continue
        for i in range(w * WORD, w * WORD + WORD):
            if mask[i] and _is_maximum(rows, b, i):
                places[k, 0], places[k, 1], found[k] = onset, i, rows[b, i]
                k += 1
    return k


@njit(
    types.Tuple((types.int64, types.int64, types.int64, types.float64))(
        *(_MATRIX, _MASK, types.int64, types.int64, types.int64, types.int64, types.int64),
        *(types.float64, types.float64, types.int64[:, ::1], _VECTOR, *_SCAN),
    ),
    cache=True,
)
def _searched(
    held, mask, start, filled, end, first, last, largest, share, places, found,
    padded, counts, last_onsets, turning, weights, sums,
):  # fmt: skip
    """Search the onsets from `start` to `end` until places might overflow.

    held: rows of the energy map, `filled` of them from the onsets before. Returns (maxima found, next start, rows
    filled, largest gain of a maximum); the search goes on with what it returns.
    """
    k = 0
    while start < end and k + HELD_ROWS * counts.size <= found.size:
        for i in range(counts.size):
            held[0, i], held[1, i] = held[filled, i], held[filled + 1, i]
        filled = min(HELD_ROWS, end - start)
        _fill_rows(held, 2, filled + 2, start, padded, counts, last_onsets, turning, weights, sums)
        # the last row is no maximum yet: it waits for the next, or lies at `last`, or where no cycle fits
        for b in range(1, filled + 1):
            onset = start + b - 2
            if onset >= first and onset < last:
                _mark(held, b, share * largest, mask)
                before, k = k, _collected(held, b, onset, mask, places, found, k)
                for n in range(before, k):
                    largest = max(largest, found[n])
        start += filled
    return k, start, filled, largest


def local_maxima(
    samples: np.ndarray, time_step: float, angles: np.ndarray, first: int, last: int, share: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return (places, gains) of the maxima of the energy gains with onset in [first, last), by onset.

    samples: (c, n) m/s². places: (k, 2) onset sample and index of frequency. gains: (k,) m²/s³. Maxima below `share`
    of the largest maximum before them are left out. A few rows of the map are held at a time, never the whole.
    """
    m, start, end = angles.size, max(first - 1, 0), min(last + 1, samples.shape[1])
    scan = _prepared(samples, time_step, angles, start)
    held, mask = np.zeros((HELD_ROWS + 2, m)), np.zeros(-(-m // WORD) * WORD, np.uint8)
    room = 2 * HELD_ROWS * m
    found, filled, largest = [], 0, 0.0
    while start < end:
        places, gains = np.empty((room, 2), np.int64), np.empty(room)
        k, start, filled, largest = _searched(
            held, mask, start, filled, end, first, last, largest, share, places, gains, *scan
        )
        found.append((places[:k], gains[:k]))
    return np.concatenate([places for places, _ in found]), np.concatenate([gains for _, gains in found])


@njit(types.float64(_SAMPLES, types.int64, types.float64), cache=True)
def envelope_phase(samples, onset, angle):
    """Return atan2(Re S, Im S) where |S|, S = Σ a e^{iω(t − t_j)} over one cycle, is largest near `onset`.

    Onsets j within half a cycle of `onset` are tried. At the best onset of a sine Re S is zero by optimality; the
    largest envelope is where sine and cosine together fit best, so there the phase tells them apart.
    """
    count = int(2 * math.pi / angle + 1e-9) + 1
    first = max(0, min(onset - count // 2, samples.size - count))
    last = max(first, min(onset + count // 2, samples.size - count))
    turn = complex(math.cos(angle), math.sin(angle))
    entering = complex(math.cos((count - 1) * angle), math.sin((count - 1) * angle))
    total = 0j
    for k in range(min(count, samples.size - first) - 1, -1, -1):
        total = total * turn + samples[first + k]
    best, phase = -1.0, 0.0
    for j in range(first, last + 1):
        size = total.real * total.real + total.imag * total.imag
        if size > best:
            best, phase = size, math.atan2(total.real, total.imag)
        if j < last:
            total = (total - samples[j]) * turn.conjugate() + samples[j + count] * entering
    return phase
