"""The compiled refinement: from one scanned maximum of the energy gain to the maximum on the continuous sine."""

import math

import numpy as np
from numba import njit, types

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

_REAL, _WHOLE, _PAIR = types.float64, types.int64, types.UniTuple(types.float64, 2)
_SUMS = types.UniTuple(types.float64, 12)
_SAMPLES = types.Array(types.float64, 1, "C", readonly=True)


@njit(types.Tuple((_WHOLE, _WHOLE, _REAL))(_WHOLE, _WHOLE, _REAL, _REAL), cache=True)
def _cycle(count, origin, angle, shift):
    """Return (first sample, end, phase θ there) of the cycle θ = angle (k − origin) − shift in [0, 2π]."""
    begin = max(origin + math.ceil(shift / angle), 0)
    end = min(origin + math.floor((shift + 2 * math.pi) / angle), count - 1) + 1
    return begin, end, angle * (begin - origin) - shift


@njit(_REAL(_SAMPLES, _WHOLE, _REAL, _REAL), cache=True)
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


@njit(_SUMS(_SAMPLES, _WHOLE, _REAL, _REAL), cache=True)
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


@njit(types.Tuple((types.boolean, _REAL, _REAL))(_SUMS, _REAL), cache=True)
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


@njit(_PAIR(_REAL, _REAL, _WHOLE, _WHOLE, _PAIR), cache=True)
def _allowed(u, v, origin, count, limits):
    """Clip (ln ω, ω t₀) to the limits of ln ω, to a quarter cycle about the scanned onset and to the record."""
    u = min(max(u, limits[0]), limits[1])
    omega = math.exp(u)
    highest = min(omega * (count - 1 - origin) - 2 * math.pi, math.pi / 2)
    return u, max(min(v, highest), -omega * origin, -math.pi / 2)


@njit(types.UniTuple(_REAL, 3)(_SAMPLES, _WHOLE, _REAL, _REAL, _PAIR), cache=True)
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


@njit(types.UniTuple(_REAL, 4)(_SAMPLES, _WHOLE, _REAL, _REAL, _REAL, _REAL), cache=True)
def refine(samples, onset, angle, lowest, highest, reach):
    """Climb to the maximum of the energy gain near one scanned maximum, by damped Newton in (ln ω, ω t₀).

    The amplitude is projected out. angle: rad per sample, held in [lowest, highest] and within `reach` in ln ω;
    the onset stays within a quarter of a cycle and the whole cycle inside the record. The gain has a kink wherever
    a sample enters or leaves the cycle; so start and end are also moved by samples, and the climb goes on from there.
    Returns (angle, onset in samples, ⟨a, s⟩, ⟨s, s⟩) as sums over samples.
    """
    last = samples.size - 1
    longest = (
        min(last, (last - onset) / 0.75) if onset < last else last
    )  # with the onset a quarter cycle earlier
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
