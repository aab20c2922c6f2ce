"""The compiled scan: energy gain of every one-cycle sine at every onset, its maxima, and their refinement.

All compiled functions of the extractor stand in this one file, because the cache of numba notices an edit in
the file of a function only.
"""

import math

import numpy as np
from numba import njit

MAXIMUM_STEPS = 60
"""Newton steps of one refinement; ten are usual, the rest serve maxima that sit on a sample's kink."""
FLAT_STEP = 1e-7
"""Below this step the score no longer resolves an improvement (it is quadratic), so Newton's step is trusted."""
FLAT_LOSS = 1e-14
"""Loss of score that is rounding when Newton's step is trusted."""
PROBES = (2.0, 1.0, 0.5)
"""Samples by which start and end of a refined cycle are moved to look beyond the kinks around it."""
LEAST_CLIMB = 1e-9
"""Gain of score for which a climb goes on; smaller ones are rounding at a kink."""


@njit(cache=True)
def energy_gains(samples, time_step, angles, first, last, gains):
    """Fill gains[first:last, i] with ⟨a, s⟩²/⟨s, s⟩ of the sine of angles[i] rad per sample, by onset.

    samples: (n,) m/s². gains: (n, m) m²/s³; 0 where the cycle does not fit in the record. S_j = Σ a e^{iω(t − t_j)}
    over the cycle is a difference of cumulative sums, C[j + T] − C[j], turned back by ω t_j; it is carried from one
    onset to the next, which is the same sum without the large common part.
    """
    n, m = samples.size, angles.size
    counts = np.empty(m, np.int64)
    longest = 0
    for i in range(m):
        counts[i] = int(2 * math.pi / angles[i] + 1e-9) + 1
        longest = max(longest, counts[i])
    padded = np.zeros(n + longest + 1)
    padded[:n] = samples
    turn_re, turn_im = np.cos(angles), np.sin(angles)
    enter_re, enter_im = np.empty(m), np.empty(m)
    real, imaginary, weight = np.empty(m), np.empty(m), np.empty(m)
    for i in range(m):
        norm, re, im = 0.0, 0.0, 0.0
        for k in range(counts[i] - 1, -1, -1):
            norm += math.sin(k * angles[i]) ** 2
            re, im = (
                re * turn_re[i] - im * turn_im[i] + padded[first + k],
                re * turn_im[i] + im * turn_re[i],
            )
        real[i], imaginary[i], weight[i] = re, im, time_step / norm
        enter_re[i] = math.cos((counts[i] - 1) * angles[i])
        enter_im[i] = math.sin((counts[i] - 1) * angles[i])
    for j in range(first, last):
        leaving = padded[j]
        row = gains[j]
        for i in range(m):
            fits = 1.0 if j + counts[i] <= n else 0.0
            row[i] = imaginary[i] * imaginary[i] * weight[i] * fits
            entering = padded[j + counts[i]]
            re = real[i] - leaving
            im = imaginary[i]
            real[i] = re * turn_re[i] + im * turn_im[i] + entering * enter_re[i]
            imaginary[i] = im * turn_re[i] - re * turn_im[i] + entering * enter_im[i]


@njit(cache=True)
def local_maxima(gains, floor):
    """Return (onset, frequency) indices, (k, 2), of the maxima of gains above `floor` among their eight neighbours."""
    n, m = gains.shape
    found = []
    for j in range(n):
        for i in range(m):
            gain = gains[j, i]
            if gain <= floor:
                continue
            if i > 0 and gains[j, i - 1] >= gain:
                continue
            if i < m - 1 and gains[j, i + 1] > gain:
                continue
            highest = True
            for jj in (j - 1, j + 1):
                if jj < 0 or jj >= n:
                    continue
                for ii in range(max(i - 1, 0), min(i + 2, m)):
                    other = gains[jj, ii]
                    if other > gain or (other == gain and jj < j):
                        highest = False
            if highest:
                found.append((j, i))
    indices = np.empty((len(found), 2), np.int64)
    for k in range(len(found)):
        indices[k, 0], indices[k, 1] = found[k]
    return indices


@njit(cache=True)
def _moments(samples, origin, angle, shift, sums):
    """Fill `sums` over the cycle θ = angle (k − origin) − shift in [0, 2π], with φ = θ + shift.

    0 Σas, 1 Σac, 2 Σacφ, 3 Σasφ, 4 Σasφ², 5 Σs², 6 Σsc, 7 Σscφ, 8 Σ(c²−s²), 9 Σ(c²−s²)φ, 10 Σ(c²−s²)φ², 11 Σc²φ²
    """
    sums[:] = 0.0
    begin = max(origin + math.ceil(shift / angle), 0)
    end = min(origin + math.floor((shift + 2 * math.pi) / angle), samples.size - 1)
    for k in range(begin, end + 1):
        phi = angle * (k - origin)
        s, c, a = math.sin(phi - shift), math.cos(phi - shift), samples[k]
        cosine_squares = c * c - s * s
        sums[0] += a * s
        sums[1] += a * c
        sums[2] += a * c * phi
        sums[3] += a * s * phi
        sums[4] += a * s * phi * phi
        sums[5] += s * s
        sums[6] += s * c
        sums[7] += s * c * phi
        sums[8] += cosine_squares
        sums[9] += cosine_squares * phi
        sums[10] += cosine_squares * phi * phi
        sums[11] += c * c * phi * phi


@njit(cache=True)
def _score(sums):
    """ln(⟨a, s⟩²/⟨s, s⟩), the logarithm of the energy gain per time step."""
    if sums[0] == 0.0 or sums[5] == 0.0:
        return -np.inf
    return 2 * math.log(abs(sums[0])) - math.log(sums[5])


@njit(cache=True)
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


@njit(cache=True)
def _allowed(u, v, origin, count, limits):
    """Clip (ln ω, ω t₀) to the limits of ln ω, to a quarter cycle about the scanned onset and to the record."""
    u = min(max(u, limits[0]), limits[1])
    omega = math.exp(u)
    highest = min(omega * (count - 1 - origin) - 2 * math.pi, math.pi / 2)
    return u, max(min(v, highest), -omega * origin, -math.pi / 2)


@njit(cache=True)
def _climbed(samples, origin, u, v, limits, sums):
    """Return (u, v, score) at the end of damped Newton steps from (u, v); `sums` is left there."""
    trial = np.empty(sums.size)
    _moments(samples, origin, math.exp(u), v, sums)
    score, damping = _score(sums), 1e-3
    for _ in range(MAXIMUM_STEPS):
        solvable, step_u, step_v = _newton_step(sums, damping)
        if not solvable:
            damping = max(4 * damping, 1e-3)
            if damping > 1e12:
                break
            continue
        new_u, new_v = _allowed(u + step_u, v + step_v, origin, samples.size, limits)
        _moments(samples, origin, math.exp(new_u), new_v, trial)
        new_score = _score(trial)
        small = abs(new_u - u) + abs(new_v - v) < FLAT_STEP
        if new_score > score or (small and new_score >= score - FLAT_LOSS):
            u, v, score = new_u, new_v, new_score
            sums[:] = trial
            damping = damping / 10 if damping > 1e-12 else 0.0
            if small and damping < 1e-8:
                break
        else:
            damping = max(5 * damping, 1e-6)
            if damping > 1e14:
                break
    return u, v, score


@njit(cache=True)
def refine(samples, onset, angle, lowest, highest, reach):
    """Climb to the maximum of the energy gain near one scanned maximum, by damped Newton in (ln ω, ω t₀).

    The amplitude is projected out. angle: rad per sample, held in [lowest, highest] and within `reach` in ln ω;
    the onset stays within a quarter of a cycle and the whole cycle inside the record. The gain has a kink wherever
    a sample enters or leaves the cycle; so start and end are also moved by samples, and the climb goes on from there.
    Returns (angle, onset in samples, ⟨a, s⟩, ⟨s, s⟩) as sums over samples.
    """
    limits = (max(math.log(angle) - reach, math.log(lowest)), min(math.log(angle) + reach, math.log(highest)))
    sums, trial = np.empty(12), np.empty(12)
    u, v, score = _climbed(samples, onset, math.log(angle), 0.0, limits, sums)
    improved = True
    while improved:
        improved = False
        for probe in range(9 * len(PROBES)):
            omega, size = math.exp(u), PROBES[probe // 9]
            start = v / omega + size * (probe % 3 - 1)
            length = 2 * math.pi / omega + size * ((probe // 3) % 3 - probe % 3)
            near_u = math.log(2 * math.pi / length)
            near_u, near_v = _allowed(near_u, start * math.exp(near_u), onset, samples.size, limits)
            _moments(samples, onset, math.exp(near_u), near_v, trial)
            if _score(trial) > score + LEAST_CLIMB:
                u, v, score = _climbed(samples, onset, near_u, near_v, limits, sums)
                improved = True
    omega = math.exp(u)
    return omega, onset + v / omega, sums[0], sums[5]


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
