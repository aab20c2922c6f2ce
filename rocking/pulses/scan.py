"""The compiled scan: the energy gain of every one-cycle sine at every onset, its maxima, and the shape beneath one."""

import math

import numpy as np
from numba import njit

HELD_ROWS = 64
"""Onsets of the energy map held at a time: enough to spread the cost of a call, few enough for the fast cache."""


@njit(cache=True)
def _prepared(samples, time_step, angles, first):
    """Return what carries the scan from one onset to the next, at onset `first`.

    padded: (c, n + longest cycle) samples. lengths, counts: (m,) of each cycle, in steps and in samples. turning:
    (4, m), real and imaginary part of e^{iω dt} and of the e^{iω(t − t_j)} of the sample that enters. sums:
    (c, 2, m), S_j of each component. weights: (m,) dt/⟨s, s⟩.
    """
    m = angles.size
    lengths = 2 * math.pi / angles
    counts = (lengths + 1e-9).astype(np.int64) + 1
    padded = np.zeros((samples.shape[0], samples.shape[1] + counts.max() + 1))
    padded[:, : samples.shape[1]] = samples
    turning, sums, weights = np.empty((4, m)), np.empty((samples.shape[0], 2, m)), np.empty(m)
    for i in range(m):
        turn_re, turn_im = math.cos(angles[i]), math.sin(angles[i])
        turning[0, i], turning[1, i] = turn_re, turn_im
        turning[2, i], turning[3, i] = (
            math.cos((counts[i] - 1) * angles[i]),
            math.sin((counts[i] - 1) * angles[i]),
        )
        norm = 0.0
        for k in range(counts[i]):
            norm += math.sin(k * angles[i]) ** 2
        weights[i] = time_step / norm
        for c in range(samples.shape[0]):
            re, im = 0.0, 0.0
            for k in range(counts[i] - 1, -1, -1):
                re, im = re * turn_re - im * turn_im + padded[c, first + k], re * turn_im + im * turn_re
            sums[c, 0, i], sums[c, 1, i] = re, im
    return padded, lengths, counts, turning, sums, weights


@njit(cache=True)
def _fill_rows(rows, begin, end, first, count, prepared):
    """Fill rows[begin:end] with the gains at onsets from `first`, of `count` samples, and carry the sums past them."""
    padded, lengths, counts, turning, sums, weights = prepared
    counts, weights = counts.copy(), weights.copy()
    lengths = np.ceil(lengths - 1e-9)
    turn_re, turn_im = turning[0].copy(), turning[1].copy()
    enter_re, enter_im = turning[2].copy(), turning[3].copy()
    for c in range(padded.shape[0]):
        # copies of one function alone let the compiler see that nothing overlaps, and vectorise the inner loop
        samples, real, imaginary = padded[c], sums[c, 0].copy(), sums[c, 1].copy()
        for b in range(begin, end):
            j = first + b - begin
            leaving = samples[j]
            for i in range(counts.size):
                fits = 1.0 if j + lengths[i] <= count - 1 else 0.0
                re, im, entering = real[i] - leaving, imaginary[i], samples[j + counts[i]]
                gain = im * im * weights[i] * fits
                rows[b, i] = gain if c == 0 else rows[b, i] + gain
                real[i] = re * turn_re[i] + im * turn_im[i] + entering * enter_re[i]
                imaginary[i] = im * turn_re[i] - re * turn_im[i] + entering * enter_im[i]
        sums[c, 0], sums[c, 1] = real, imaginary


@njit(cache=True)
def energy_gains(samples, time_step, angles):
    """Return ⟨a, s⟩²/⟨s, s⟩, (n, m) m²/s³, of the sine of angles[i] rad per sample with onset at each sample.

    samples: (c, n) m/s²; the gains of c components are added. 0 where the cycle does not fit in the record.
    S_j = Σ a e^{iω(t − t_j)} over the cycle is a difference of cumulative sums, C[j + T] − C[j], turned back by ω t_j;
    it is carried from one onset to the next, which is the same sum without the large common part.
    """
    gains = np.empty((samples.shape[1], angles.size))
    _fill_rows(gains, 0, samples.shape[1], 0, samples.shape[1], _prepared(samples, time_step, angles, 0))
    return gains


@njit(cache=True)
def _is_maximum(rows, b, i):
    """Whether rows[b, i] tops its eight neighbours; of equal ones the first counts."""
    gain, m = rows[b, i], rows.shape[1]
    if (i > 0 and rows[b, i - 1] >= gain) or (i < m - 1 and rows[b, i + 1] > gain):
        return False
    for k in range(max(i - 1, 0), min(i + 2, m)):  # noqa: SIM110 (a generator would not compile)
        if rows[b - 1, k] >= gain or rows[b + 1, k] > gain:
            return False
    return True


@njit(cache=True)
def _collected(rows, b, onset, floor, places, found, k):
    """Append the maxima of rows[b] above `floor` to the first k of places and found; return how many there are."""
    for i in range(rows.shape[1]):
        if rows[b, i] > floor and _is_maximum(rows, b, i):
            places[k, 0], places[k, 1], found[k] = onset, i, rows[b, i]
            k += 1
    return k


@njit(cache=True)
def local_maxima(samples, time_step, angles, first, last, share):
    """Return (places, gains) of the maxima of the energy gains with onset in [first, last), by onset.

    samples: (c, n) m/s². places: (k, 2) onset sample and index of frequency. gains: (k,) m²/s³. Maxima below `share`
    of the largest gain before them are left out. A few rows of the map are held at a time, never the whole.
    """
    count, m = samples.shape[1], angles.size
    begin, end = max(first - 1, 0), min(last + 1, count)
    prepared = _prepared(samples, time_step, angles, begin)
    held = np.zeros((HELD_ROWS + 3, m))
    places, found, largest, k = np.empty((4 * m, 2), np.int64), np.empty(4 * m), 0.0, 0
    filled = 0
    for start in range(begin, end, HELD_ROWS):
        held[:2] = held[filled : filled + 2].copy()
        filled = min(HELD_ROWS, end - start)
        _fill_rows(held, 2, filled + 2, start, count, prepared)
        held[filled + 2] = 0.0
        for b in range(1, filled + 2 if start + filled == end else filled + 1):
            onset = start + b - 2
            if onset < first or onset >= last:
                continue
            largest = max(largest, held[b].max())
            if k + m > found.size:
                places, found = np.concatenate((places, places)), np.concatenate((found, found))
            k = _collected(held, b, onset, share * largest, places, found, k)
    return places[:k], found[:k]


@njit(cache=True)
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
