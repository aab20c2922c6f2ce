"""The compiled scan: the energy gain of every one-cycle sine at every onset, its maxima, and the climb from a maximum.

The compiled functions have one signature each, which read-only and writable samples both meet, and hold plain loops
only: what allocates and prepares is numpy, for compiling array expressions takes longer than running them ever does.
"""

import math
from functools import lru_cache, partial
from typing import Any

import numpy as np
from numba import njit, types

HELD_ROWS = 64
"""Onsets of the energy map held at a time: enough to spread the cost of a call, few enough for the fast cache."""
WORD = 8
"""Bytes of the mask of candidates that are looked at together."""
MAXIMUM_STEPS = 60
"""Newton steps of one refinement; ten are usual, the rest serve maxima that sit on a sample's kink."""
FLAT_STEP = 1e-7
"""Below this step the score no longer resolves an improvement (it is quadratic), so Newton's step is trusted."""
FLAT_LOSS = 1e-12
"""Loss of score that is rounding when Newton's step is trusted."""
PROBES = (2.0, 1.0, 0.5)
"""Samples by which start and end of a refined cycle are moved to look beyond the kinks around it."""
LEAST_CLIMB = 1e-9
"""Gain of score for which a climb goes on; smaller ones are rounding at a kink."""
HIGHEST_DAMPING = 1e10
"""Damping at which a climb ends: its step is then below the rounding of the score, at a kink as elsewhere."""

_OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "no_cfunc_wrapper": True}
entry = partial(njit, **_OPTIONS)
compiled = partial(njit, **{**_OPTIONS, "no_cpython_wrapper": True})
"""The compiler of functions that Python does not call: a wrapper for them takes long to compile."""

_VECTOR, _MATRIX, _CUBE = types.float64[::1], types.float64[:, ::1], types.float64[:, :, ::1]
_COUNTS, _MASK = types.int64[::1], types.uint8[::1]
_SAMPLES = types.Array(types.float64, 1, "C", readonly=True)
_REAL, _WHOLE, _PAIR = types.float64, types.int64, types.UniTuple(types.float64, 2)
_SUMS = types.UniTuple(types.float64, 12)
_SCAN = (_MATRIX, _COUNTS, _COUNTS, _MATRIX, _VECTOR, _CUBE)


def _prepared(
    samples: np.ndarray, time_step: float, angles: np.ndarray, first: int
) -> tuple[np.ndarray, ...]:
    """Return what carries the scan of samples (c, n) from one onset to the next, at onset `first`.

    padded: (c, n + longest cycle) samples. counts: (m,) samples of each cycle. last_onsets: (m,) samples, at which the
    cycle still fits. turning: (4, m), real and imaginary part of e^{iω dt} and of the e^{iω(t − t_j)} of the sample
    that enters. weights: (m,) dt/⟨s, s⟩. sums: (c, 2, m), S_j of each component.
    """
    steps, counts, turning, norms = _cycles(angles.tobytes())
    padded = np.zeros((samples.shape[0], samples.shape[1] + counts[0] + 1))
    padded[:, : samples.shape[1]] = samples
    sums = np.empty((samples.shape[0], 2, angles.size))
    _start(padded, first, counts, turning, sums)
    return padded, counts, samples.shape[1] - 1 - steps, turning, time_step / norms, sums


@lru_cache(maxsize=256)
def _cycles(angles: bytes) -> tuple[np.ndarray, ...]:
    """Return of the cycles of so many rad per sample, ascending: steps within, samples, turning, Σ sin².

    Records of one time step ask for the same ones again and again.
    """
    own = np.frombuffer(angles)
    lengths = 2 * math.pi / own
    counts = (lengths + 1e-9).astype(np.int64) + 1
    last = (counts - 1) * own
    turning = np.array([np.cos(own), np.sin(own), np.cos(last), np.sin(last)])
    # Σ sin²(kω) over the cycle, in closed form
    norms = counts / 2 - np.sin(counts * own) * np.cos(last) / (2 * np.sin(own))
    return np.ceil(lengths - 1e-9).astype(np.int64), counts, turning, norms


@entry(types.void(_MATRIX, types.int64, _COUNTS, _MATRIX, _CUBE))
def _start(padded, first, counts, turning, sums):
    """Fill sums with S_j at onset `first`."""
    m = counts.size
    for c in range(padded.shape[0]):
        real, imaginary = np.zeros(m), np.zeros(m)
        for k in range(counts[0] - 1, -1, -1):
            sample = padded[c, first + k]
            # frequencies ascend: the longest cycles reach this sample first
            for i in range(m):
                if counts[i] <= k:
                    break
                re, im = real[i], imaginary[i]
                real[i] = re * turning[0, i] - im * turning[1, i] + sample
                imaginary[i] = re * turning[1, i] + im * turning[0, i]
        sums[c, 0], sums[c, 1] = real, imaginary


@entry(types.void(_MATRIX, types.int64, types.int64, types.int64, *_SCAN))
def _fill_rows(rows, begin, end, first, padded, counts, last_onsets, turning, weights, sums):
    """Fill rows[begin:end] with the gains at onsets from `first` and carry the sums past them."""
    m = counts.size
    # copies of one function alone let the compiler see that nothing overlaps, and vectorise the inner loop
    lengths, weight, real, imaginary = np.empty(m, np.int64), np.empty(m), np.empty(m), np.empty(m)
    turn_re, turn_im, enter_re, enter_im = np.empty(m), np.empty(m), np.empty(m), np.empty(m)
    for i in range(m):
        lengths[i], weight[i] = counts[i], weights[i]
        turn_re[i], turn_im[i] = turning[0, i], turning[1, i]
        enter_re[i], enter_im[i] = turning[2, i], turning[3, i]
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
            # frequencies ascend: the longest cycles stop fitting first
            if first + b - begin <= last_onsets[i]:
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


@compiled(types.boolean(_MATRIX, types.int64, types.int64))
def _is_maximum(rows, b, i):
    """Whether rows[b, i] tops its eight neighbours; of equal ones the first counts."""
    gain, m = rows[b, i], rows.shape[1]
    if (i > 0 and rows[b, i - 1] >= gain) or (i < m - 1 and rows[b, i + 1] > gain):
        return False
    for k in range(max(i - 1, 0), min(i + 2, m)):  # noqa: SIM110 (a generator would not compile)
        if rows[b - 1, k] >= gain or rows[b + 1, k] > gain:
            return False
    return True


@compiled(types.void(_MATRIX, types.int64, types.float64, _MASK))
def _mark(rows, b, floor, mask):
    """Mark the gains of rows[b] above `floor` that top those of the onsets before and after."""
    for i in range(rows.shape[1]):
        gain = rows[b, i]
        mask[i] = (gain > floor) & (gain > rows[b - 1, i]) & (gain >= rows[b + 1, i])


@compiled(types.int64(_MATRIX, types.int64, types.int64, _MASK, types.int64[:, ::1], _VECTOR, types.int64))
def _collected(rows, b, onset, mask, places, gains, k):
    """Append the maxima among the marked gains of rows[b] to the first k of places and gains; return how many."""
    words = mask.view(np.uint64)
    for w in range(words.size):
        if words[w] == 0:
            continue
        for i in range(w * WORD, w * WORD + WORD):
            if mask[i] and _is_maximum(rows, b, i):
                places[k, 0], places[k, 1], gains[k] = onset, i, rows[b, i]
                k += 1
    return k


@entry(
    types.Tuple((types.int64, types.int64, types.int64, types.float64))(
        *(_MATRIX, _MASK, types.int64, types.int64, types.int64, types.int64, types.int64),
        *(types.float64, types.float64, types.int64[:, ::1], _VECTOR, *_SCAN),
    )
)
def _searched(
    held,
    mask,
    start,
    filled,
    end,
    first,
    last,
    largest,
    share,
    places,
    gains,
    padded,
    counts,
    last_onsets,
    turning,
    weights,
    sums,
):
    """Search the onsets from `start` to `end` until places might overflow.

    held: rows of the energy map, `filled` of them from the onsets before. Returns (maxima counted, next start, rows
    filled, largest gain of a maximum); the search goes on with what it returns.
    """
    k = 0
    while start < end and k + HELD_ROWS * counts.size <= gains.size:
        for i in range(counts.size):
            held[0, i], held[1, i] = held[filled, i], held[filled + 1, i]
        filled = min(HELD_ROWS, end - start)
        _fill_rows(held, 2, filled + 2, start, padded, counts, last_onsets, turning, weights, sums)
        # the last row is no maximum yet: it waits for the next, or lies at `last`, or where no cycle fits
        for b in range(1, filled + 1):
            onset = start + b - 2
            if onset >= first and onset < last:
                _mark(held, b, share * largest, mask)
                before, k = k, _collected(held, b, onset, mask, places, gains, k)
                for n in range(before, k):
                    largest = max(largest, gains[n])
        start += filled
    return k, start, filled, largest


def local_maxima(
    samples: np.ndarray, time_step: float, angles: np.ndarray, first: int, last: int, share: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return (places, gains) of the maxima of the energy gains with onset in [first, last), by onset.

    samples: (c, n) m/s². places: (k, 2) onset sample and index of frequency. gains: (k,) m²/s³. Maxima below `share`
    of the largest maximum before them are left out. A few rows of the map are held at a time, never the whole.
    """
    start = max(first - 1, 0)
    end = min(last + 1, samples.shape[1])
    scan = _prepared(samples, time_step, angles, start)
    held = np.zeros((HELD_ROWS + 2, angles.size))
    mask = np.zeros(-(-angles.size // WORD) * WORD, np.uint8)
    room = 2 * HELD_ROWS * angles.size
    parts = []
    filled = 0
    largest = 0.0
    while start < end:
        places = np.empty((room, 2), np.int64)
        gains = np.empty(room)
        k, start, filled, largest = _searched(
            held, mask, start, filled, end, first, last, largest, share, places, gains, *scan
        )
        parts.append((places[:k], gains[:k]))
    return np.concatenate([places for places, _ in parts]), np.concatenate([gains for _, gains in parts])


def apart(starts: np.ndarray, ends: np.ndarray, gains: np.ndarray, count: int, overlap: float) -> np.ndarray:
    """Return the places of the `count` largest gains, falling, of spans that share less than `overlap` of their time.

    starts, ends: (k,) s. Of equal gains the first is taken; fewer are returned where no more are left.
    """
    places = np.empty(count, np.int64)
    found = _chosen(starts, ends, gains.copy(), overlap, places)
    return places[:found]


@entry(types.int64(_VECTOR, _VECTOR, _VECTOR, types.float64, types.int64[::1]))
def _chosen(starts, ends, gains, overlap, places):
    """Fill places with those of `apart`, and gains with 0 where they are taken or overlap; return how many."""
    for n in range(places.size):
        best = -1
        for i in range(gains.size):
            if gains[i] > (gains[best] if best >= 0 else 0.0):
                best = i
        if best < 0:
            return n
        places[n] = best
        for i in range(gains.size):
            common = min(ends[i], ends[best]) - max(starts[i], starts[best])
            if common >= overlap * (max(ends[i], ends[best]) - min(starts[i], starts[best])):
                gains[i] = 0.0
    return places.size


@entry(types.float64(_SAMPLES, types.int64, types.float64))
def envelope_phase(samples, onset, angle):
    """Return atan2(Re S, Im S) where |S|, S = Σ a e^{iω(t − t_j)} over one cycle, is largest near `onset`.

    Onsets j within half a cycle of `onset` are tried. At the best onset of a sine Re S is zero by optimality; the
    largest envelope is where sine and cosine together fit best, so there the phase distinguishes them.
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


@compiled(types.Tuple((_WHOLE, _WHOLE, _REAL))(_WHOLE, _WHOLE, _REAL, _REAL))
def _cycle(count, origin, angle, shift):
    """Return (first sample, end, phase θ there) of the cycle θ = angle (k − origin) − shift in [0, 2π]."""
    begin = max(origin + math.ceil(shift / angle), 0)
    end = min(origin + math.floor((shift + 2 * math.pi) / angle), count - 1) + 1
    return begin, end, angle * (begin - origin) - shift


@compiled(_REAL(_SAMPLES, _WHOLE, _REAL, _REAL))
def _score(samples, origin, angle, shift):
    """ln(⟨a, s⟩²/⟨s, s⟩) over the cycle, the logarithm of the energy gain per time step."""
    begin, end, theta = _cycle(samples.size, origin, angle, shift)
    count = max(end - begin, 0)
    # even and odd samples apart: two recurrences that the processor runs side by side
    turn_s, turn_c = math.sin(2 * angle), math.cos(2 * angle)
    s, c, odd_s, odd_c = math.sin(theta), math.cos(theta), math.sin(theta + angle), math.cos(theta + angle)
    p = odd_p = 0.0
    for k in range(begin, end - 1, 2):
        p += samples[k] * s
        odd_p += samples[k + 1] * odd_s
        s, c = s * turn_c + c * turn_s, c * turn_c - s * turn_s
        odd_s, odd_c = odd_s * turn_c + odd_c * turn_s, odd_c * turn_c - odd_s * turn_s
    if count % 2 == 1:
        p += samples[end - 1] * s
    p += odd_p
    q = count / 2 - math.sin(count * angle) * math.cos(2 * theta + (count - 1) * angle) / (
        2 * math.sin(angle)
    )
    return 2 * math.log(abs(p)) - math.log(q) if p != 0.0 and q != 0.0 else -np.inf


@compiled(_SUMS(_SAMPLES, _WHOLE, _REAL, _REAL))
def _moments(samples, origin, angle, shift):
    """Return sums over the cycle, with φ = θ + shift, that its score and the score's derivatives are made of.

    0 Σas, 1 Σac, 2 Σacφ, 3 Σasφ, 4 Σasφ², 5 Σs², 6 Σsc, 7 Σscφ, 8 Σ(c²−s²), 9 Σ(c²−s²)φ, 10 Σ(c²−s²)φ², 11 Σc²φ²
    """
    begin, end, theta = _cycle(samples.size, origin, angle, shift)
    s, c, turn_s, turn_c = math.sin(theta), math.cos(theta), math.sin(angle), math.cos(angle)
    m0 = m1 = m2 = m3 = m4 = m5 = m6 = m7 = m8 = m9 = m10 = m11 = 0.0
    for k in range(begin, end):
        phi, a, squares = angle * (k - origin), samples[k], c * c - s * s
        m0 += a * s
        m1 += a * c
        m2 += a * c * phi
        m3 += a * s * phi
        m4 += a * s * phi * phi
        m5 += s * s
        m6 += s * c
        m7 += s * c * phi
        m8 += squares
        m9 += squares * phi
        m10 += squares * phi * phi
        m11 += c * c * phi * phi
        s, c = s * turn_c + c * turn_s, c * turn_c - s * turn_s
    return m0, m1, m2, m3, m4, m5, m6, m7, m8, m9, m10, m11


@compiled(types.Tuple((types.boolean, _REAL, _REAL))(_SUMS, _REAL))
def _newton_step(sums, damping):
    """Return (solvable, step in ln ω, step in ω t₀) of the damped Newton iteration on the score."""
    p, q = sums[0], sums[5]
    if p == 0.0 or q == 0.0:
        return False, 0.0, 0.0
    p_u, p_v = sums[2] / p, -sums[1] / p
    p_uu, p_uv, p_vv = (sums[2] - sums[4]) / p, sums[3] / p, -1.0
    q_u, q_v = 2 * sums[7] / q, -2 * sums[6] / q
    q_uu, q_uv, q_vv = 2 * (sums[10] + sums[7]) / q, -2 * sums[9] / q, 2 * sums[8] / q
    slope_u, slope_v = 2 * p_u - q_u, 2 * p_v - q_v
    m_uu = -(2 * (p_uu - p_u * p_u) - q_uu + q_u * q_u) + damping * 2 * sums[11] / q
    m_uv = -(2 * (p_uv - p_u * p_v) - q_uv + q_u * q_v)
    m_vv = -(2 * (p_vv - p_v * p_v) - q_vv + q_v * q_v) + damping * 2
    determinant = m_uu * m_vv - m_uv * m_uv
    if m_uu <= 0.0 or determinant <= 1e-12 * m_uu * m_vv:
        return False, 0.0, 0.0
    return (
        True,
        (m_vv * slope_u - m_uv * slope_v) / determinant,
        (m_uu * slope_v - m_uv * slope_u) / determinant,
    )


@compiled(_PAIR(_REAL, _REAL, _WHOLE, _WHOLE, _PAIR))
def _allowed(u, v, origin, count, limits):
    """Clip (ln ω, ω t₀) to the limits of ln ω, to a quarter cycle about the scanned onset and to the record."""
    u = min(max(u, limits[0]), limits[1])
    omega = math.exp(u)
    highest = min(omega * (count - 1 - origin) - 2 * math.pi, math.pi / 2)
    return u, max(min(v, highest), -omega * origin, -math.pi / 2)


@compiled(types.UniTuple(_REAL, 3)(_SAMPLES, _WHOLE, _REAL, _REAL, _PAIR))
def _climbed(samples, origin, u, v, limits):
    """Return (u, v, score) at the end of damped Newton steps from (u, v)."""
    score, damping = _score(samples, origin, math.exp(u), v), 1e-3
    sums = _moments(samples, origin, math.exp(u), v)
    for _ in range(MAXIMUM_STEPS):
        if damping > HIGHEST_DAMPING:
            break
        solvable, step_u, step_v = _newton_step(sums, damping)
        if not solvable:
            damping = max(4 * damping, 1e-3)
            continue
        new_u, new_v = _allowed(u + step_u, v + step_v, origin, samples.size, limits)
        new_score = _score(samples, origin, math.exp(new_u), new_v)
        small = abs(new_u - u) + abs(new_v - v) < FLAT_STEP
        if new_score > score or (small and new_score >= score - FLAT_LOSS):
            u, v, score = new_u, new_v, new_score
            if small and damping < 1e-4:
                break
            sums = _moments(samples, origin, math.exp(u), v)
            damping = damping / 10
        else:
            damping = max(10 * damping, 1e-4)
    return u, v, score


@entry(types.UniTuple(_REAL, 4)(_SAMPLES, _WHOLE, _REAL, _REAL, _REAL, _REAL))
def refine(samples, onset, angle, lowest, highest, reach):
    """Climb to the maximum of the energy gain near one scanned maximum, by damped Newton in (ln ω, ω t₀).

    The amplitude is projected out. angle: rad per sample, held in [lowest, highest] and within `reach` in ln ω;
    the onset stays within a quarter of a cycle and the whole cycle inside the record. The gain has a kink wherever
    a sample enters or leaves the cycle; so start and end are also moved by samples, and the climb goes on from there.
    Returns (angle, onset in samples, ⟨a, s⟩, ⟨s, s⟩) as sums over samples.
    """
    last = samples.size - 1
    # with the onset a quarter cycle earlier
    longest = min(last, (last - onset) / 0.75) if onset < last else last
    low = max(math.log(angle) - reach, math.log(lowest), math.log(2 * math.pi / longest))
    limits = (low, min(math.log(angle) + reach, math.log(highest)))
    u, v, score = _climbed(samples, onset, math.log(angle), 0.0, limits)
    improved = True
    while improved:
        improved = False
        for probe in range(9 * len(PROBES)):
            omega, size = math.exp(u), PROBES[probe // 9]
            start = v / omega + size * (probe % 3 - 1)
            length = 2 * math.pi / omega + size * ((probe // 3) % 3 - probe % 3)
            near_u = math.log(2 * math.pi / length)
            near_u, near_v = _allowed(near_u, start * math.exp(near_u), onset, samples.size, limits)
            if _score(samples, onset, math.exp(near_u), near_v) > score + LEAST_CLIMB:
                u, v, score = _climbed(samples, onset, near_u, near_v, limits)
                improved = True
    sums = _moments(samples, onset, math.exp(u), v)
    return math.exp(u), onset + v / math.exp(u), sums[0], sums[5]
