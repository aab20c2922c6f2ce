"""Everything compiled: the Taylor-series integration of a mechanism, and the exact response of an equivalent block.

A mechanism is followed in the arc q = ∫ √(I(φ)/I(0)) dφ, in which J drops out of the equation of motion:

    q'' = −G̃(q) (g + ü_v) − s B̃(q) ü_g ,   G̃ = G/√(I I(0)) , B̃ = B/√(I I(0))

G̃ and B̃ are piecewise polynomials, ü_g and ü_v are linear within a sample (or ü_g is a sine), so the Taylor
coefficients of q(t) follow from one recursion. A step is a polynomial of degree 8 (order 7), and its events are the
roots of that polynomial: nothing is interpolated and nothing is stepped twice.
"""

import math

import numpy as np
from numba import njit

ROCKS, OVERTURNS, TOO_MANY_IMPACTS, NOT_FINITE = 1, 2, 3, 4
"""How a run ends; 0 is no uplift."""

REST_ENERGY = 1e-14
"""Rocking ends at an impact that leaves less than this share of the energy that reaches φ_cr.

The next flight would rise to about half this share of φ_cr, less than ten roundings of φ_cr."""

SETTLED = 1e-10
"""A root is found by Newton's method when its last move is below this share: the next would be its square."""

IMPACT_LIMIT = 5_000_000

INSTANT, PAUSE = 1e-14, 1e-9
"""A landing sooner than INSTANT after an uplift is a rounding: it rests for PAUSE. Both are shares of a sample."""

# Contraction to fused multiply-adds changes roundings only; infinities and NaN keep their meaning.
compiled = njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})


@compiled
def _margin(lift, push, gravity):
    """Acceleration along the arc that a push towards a side gives the structure at rest."""
    return lift[1] * push - lift[0] * gravity


@compiled
def _margins(lift, one_sided, ground, gravity):
    """Acceleration that would lift the structure at rest to the positive and to the negative side."""
    negative = -np.inf if one_sided else _margin(lift[lift.shape[0] - 1], ground, gravity)
    return _margin(lift[0], -ground, gravity), negative


@compiled
def _uplift(lift, one_sided, ground, gravity, time_step, i, tau):
    """First instant from (interval i, offset tau) on that lifts: interval, offset, side (0 if none does)."""
    count = ground.size - 1
    if i >= count:
        return i, 0.0, 0
    share = tau / time_step
    now = ground[i] + share * (ground[i + 1] - ground[i])
    weight = gravity[i] + share * (gravity[i + 1] - gravity[i])
    positive, negative = _margins(lift, one_sided, now, weight)
    if positive > 0 or negative > 0:
        return i, tau, (1 if positive >= negative else -1)
    while i < count:
        next_positive, next_negative = _margins(lift, one_sided, ground[i + 1], gravity[i + 1])
        if next_positive > 0 or next_negative > 0:
            to_positive = positive / (positive - next_positive) if next_positive > 0 else 2.0
            to_negative = negative / (negative - next_negative) if next_negative > 0 else 2.0
            side = 1 if to_positive <= to_negative else -1
            return i, tau + min(to_positive, to_negative) * (time_step - tau), side
        positive, negative, tau = next_positive, next_negative, 0.0
        i += 1
    return i, 0.0, 0


@compiled
def _uplift_sine(lift, one_sided, amplitude, omega, gravity, tau):
    """First instant of the sine pulse from offset tau on that lifts: offset, side (0 if none does)."""
    for half in range(2):
        push = -amplitude if half else amplitude
        side = -1 if push > 0 else 1
        if push == 0 or (one_sided and side < 0):
            continue
        k = 0 if side > 0 else lift.shape[0] - 1
        ratio = lift[k, 0] * gravity / (lift[k, 1] * abs(amplitude))
        if ratio < 1:
            phase = math.asin(ratio)
            if tau < ((half + 1) * math.pi - phase) / omega:
                return max(tau, (half * math.pi + phase) / omega), side
    return tau, 0


@compiled
def _place(grid, arc):
    """Index of the piece that holds an arc, its centre, and the room beyond it."""
    if arc < grid[0]:
        j = max(int(arc * grid[7]), 0)
        return j, (j + 0.5) * grid[1], grid[3]
    j = int(min((arc - grid[0]) * grid[8], grid[5] - 1))
    return int(grid[2]) + j, grid[0] + (j + 0.5) * grid[4], grid[6]


@compiled
def _shift(piece, g, b, u):
    """Taylor coefficients 0 to 6, about the place u of a piece, of g G̃ + b B̃."""
    e0, e1 = g * piece[0] + b * piece[1], g * piece[2] + b * piece[3]
    e2, e3 = g * piece[4] + b * piece[5], g * piece[6] + b * piece[7]
    e4, e5 = g * piece[8] + b * piece[9], g * piece[10] + b * piece[11]
    e6, e7 = g * piece[12] + b * piece[13], g * piece[14] + b * piece[15]
    a0 = e0 + u * (e1 + u * (e2 + u * (e3 + u * (e4 + u * (e5 + u * (e6 + u * e7))))))
    a1 = e1 + u * (2 * e2 + u * (3 * e3 + u * (4 * e4 + u * (5 * e5 + u * (6 * e6 + u * 7 * e7)))))
    a2 = e2 + u * (3 * e3 + u * (6 * e4 + u * (10 * e5 + u * (15 * e6 + u * 21 * e7))))
    a3 = e3 + u * (4 * e4 + u * (10 * e5 + u * (20 * e6 + u * 35 * e7)))
    a4 = e4 + u * (5 * e5 + u * (15 * e6 + u * 35 * e7))
    a5 = e5 + u * (6 * e6 + u * 21 * e7)
    return a0, a1, a2, a3, a4, a5, e6 + u * 7 * e7


@compiled
def _series(piece, u, v, side, a0, a1, g0, g1, square):
    """Taylor coefficients (v, x2, ..., x8) of the arc, at the place u of one piece of the table.

    Ground acceleration a0 + a1 t (or the sine that starts so, with the squared frequency `square`), gravity g0 + g1 t.
    """
    s0, s1 = side * a0, side * a1
    w0, w1, w2, w3, w4, w5, w6 = _shift(piece, g0, s0, u)
    r0, r1, r2, r3, r4, r5, _ = _shift(piece, g1, s1, u)
    b0 = b1 = b2 = b3 = b4 = 0.0
    s2 = s3 = s4 = s5 = s6 = 0.0
    if square != 0.0:
        b0, b1, b2, b3, b4, _, _ = _shift(piece, 0.0, 1.0, u)
        s2, s3 = -square * s0 / 2, -square * s1 / 6
        s4, s5, s6 = -square * s2 / 12, -square * s3 / 20, square * square * s2 / 360
    # pkn: coefficient n of the k-th power of the displacement within the step.
    x2 = -0.5 * w0
    x3 = (w1 * v + r0) * (-1 / 6)
    p22, p23 = v * v, 2 * v * x2
    x4 = (w1 * x2 + w2 * p22 + r1 * v + s2 * b0) * (-1 / 12)
    p24 = 2 * v * x3 + x2 * x2
    p33, p34 = p22 * v, 3 * p22 * x2
    d1 = b1 * v
    x5 = (w1 * x3 + w2 * p23 + w3 * p33 + r1 * x2 + r2 * p22 + s2 * d1 + s3 * b0) * (-1 / 20)
    p25 = 2 * (v * x4 + x2 * x3)
    p35 = v * p24 + x2 * p23 + x3 * p22
    p44, p45 = p22 * p22, 4 * p33 * x2
    d2 = b1 * x2 + b2 * p22
    driven = s2 * d2 + s3 * d1 + s4 * b0
    still = w1 * x4 + w2 * p24 + w3 * p34 + w4 * p44
    x6 = (still + r1 * x3 + r2 * p23 + r3 * p33 + driven) * (-1 / 30)
    p26 = 2 * (v * x5 + x2 * x4) + x3 * x3
    p36 = v * p25 + x2 * p24 + x3 * p23 + x4 * p22
    p46 = 2 * p22 * p24 + p23 * p23
    p55, p56 = p44 * v, 5 * p44 * x2
    d3 = b1 * x3 + b2 * p23 + b3 * p33
    driven = s2 * d3 + s3 * d2 + s4 * d1 + s5 * b0
    still = w1 * x5 + w2 * p25 + w3 * p35 + w4 * p45 + w5 * p55
    x7 = (still + r1 * x4 + r2 * p24 + r3 * p34 + r4 * p44 + driven) * (-1 / 42)
    d4 = b1 * x4 + b2 * p24 + b3 * p34 + b4 * p44
    driven = s2 * d4 + s3 * d3 + s4 * d2 + s5 * d1 + s6 * b0
    still = w1 * x6 + w2 * p26 + w3 * p36 + w4 * p46 + w5 * p56 + w6 * p33 * p33
    x8 = (still + r1 * x5 + r2 * p25 + r3 * p35 + r4 * p45 + r5 * p55 + driven) * (-1 / 56)
    return v, x2, x3, x4, x5, x6, x7, x8


@compiled
def _displacement(x, t):
    """Change of the arc after the time t."""
    return t * (x[0] + t * (x[1] + t * (x[2] + t * (x[3] + t * (x[4] + t * (x[5] + t * (x[6] + t * x[7])))))))


@compiled
def _speed(x, t):
    """Speed along the arc after the time t."""
    high = 5 * x[4] + t * (6 * x[5] + t * (7 * x[6] + t * 8 * x[7]))
    return x[0] + t * (2 * x[1] + t * (3 * x[2] + t * (4 * x[3] + t * high)))


@compiled
def _acceleration(x, t):
    """Acceleration along the arc after the time t."""
    return 2 * x[1] + t * (
        6 * x[2] + t * (12 * x[3] + t * (20 * x[4] + t * (30 * x[5] + t * (42 * x[6] + t * 56 * x[7]))))
    )


@compiled
def _monotone(x, h):
    """Whether the speed provably has at most one zero within the step."""
    p, q, r = abs(x[1]), abs(x[2]), abs(x[3])
    high = h * (20 * abs(x[4]) + h * (30 * abs(x[5]) + h * (42 * abs(x[6]) + h * 56 * abs(x[7]))))
    if abs(x[0]) > h * (2 * p + h * (3 * q + h * (4 * r + h * high / 4))):
        return True
    if 2 * p > h * (6 * q + h * (12 * r + h * high)):
        return True
    return x[1] * x[2] >= 0 and 6 * q > h * (24 * r + 3 * h * high)


@compiled
def _stride(x, h, room, arc, reach, haste, tolerance):
    """Largest step up to h that is accurate, stays within reach of its piece, and turns at most once.

    The last two terms of the series bound its remainder; they are measured against the largest arc and the largest
    speed of the present flight, so that small motions are as accurate as large ones.
    """
    for _ in range(200):
        square = h * h
        tail = square * square * square * (abs(x[6]) + h * abs(x[7]))
        if h * (abs(x[0]) + h * (abs(x[1]) + h * (abs(x[2]) + h * abs(x[3])))) <= room:
            accurate = tail * h <= tolerance * reach and 8 * tail <= tolerance * haste
            if not accurate:
                largest = max(reach, abs(arc + _displacement(x, h)))
                fastest = max(haste, abs(_speed(x, h)))
                accurate = tail * h <= tolerance * largest and 8 * tail <= tolerance * fastest
            if accurate:
                break
        h *= 0.8
    least = 1e-6 * h
    while h > least and not _monotone(x, h):
        h *= 0.5
    return h


@compiled
def _turning(x, h):
    """The zero of the speed within the step, to rounding."""
    low, high, end = 0.0, h, _speed(x, h)
    t = h * x[0] / (x[0] - end)
    for _ in range(100):
        speed = _speed(x, t)
        if (speed > 0) == (end > 0):
            high = t
        else:
            low = t
        new = t - speed / _acceleration(x, t)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        move, t = abs(new - t), new
        if move <= SETTLED * t:
            break
    return t


@compiled
def _landing(x, arc, low, high):
    """The zero of the arc between the times low (above zero) and high (at or below), to rounding."""
    t = high
    for _ in range(100):
        height = arc + _displacement(x, t)
        if height > 0:
            low = t
        else:
            high = t
        new = t - height / _speed(x, t)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        move, t = abs(new - t), new
        if move <= SETTLED * t:
            break
    return t


@compiled
def _write(log, logged, time, arc, speed):
    """Write one line of history where there is room; the count tells how much room was needed."""
    if logged < log.shape[0]:
        log[logged, 0], log[logged, 1], log[logged, 2] = time, arc, speed
    return logged + 1


@compiled
def rock(
    pieces, grid, lift, hold, critical, end, restitution, rest_speed, pace, one_sided,
    ground, gravity, threat, still, time_step, omega, arc, speed, side, tolerance, log,
):  # fmt: skip
    """Follow a mechanism through a ground motion and on until no larger peak can come.

    Per side (k,): pieces (k, m, 16), G̃ and B̃ alternating, by power of the distance from the centre of a piece; grid
    (k, 9), end of the inner zone, then width, count and room of the pieces of the inner and of the outer zone, then
    the inverse widths; lift (k, 2) G̃(0), B̃(0); hold (k, m), the ground acceleration in units of gravity that cannot
    bring the side back from that piece or beyond; pace, longest step in s; arc of φ_cr and of the end, η, and the
    speed at which rocking rests. ground, gravity, threat: (n,) ü_g, g + ü_v, and the largest |ü_g|/(g + ü_v) from
    there on; with omega > 0, ground[0] is the amplitude of a sine of one period time_step. still: g after the record.
    arc, speed, side: the state at the start, side 0 at rest. log: (m, 3) for the history, or of no rows.
    Returns status, peak arcs (2,), their times (2,), impacts, uplift time, last side, steps, lines of log.
    """
    count = 1 if omega > 0 else ground.size - 1
    last, rate = pieces.shape[0] - 1, 1 / time_step
    best, when = np.zeros(2), np.full(2, np.nan)
    i, tau, status, impacts, steps, logged, turns = 0, 0.0, 0, 0, 0, 0, 0
    uplift, reach, haste = np.nan, arc, abs(speed)
    if side != 0:
        status, uplift = ROCKS, 0.0
        best[0 if side > 0 else 1], when[0 if side > 0 else 1] = arc, 0.0
    keep = log.shape[0] > 0
    if keep:
        logged = _write(log, logged, 0.0, side * arc, side * speed)
    while True:
        if side == 0:
            if i >= count:
                break
            if omega > 0:
                tau, side = _uplift_sine(lift, one_sided, ground[0], omega, still, tau)
            else:
                i, tau, side = _uplift(lift, one_sided, ground, gravity, time_step, i, tau)
            if side == 0:
                break
            arc = speed = reach = haste = 0.0
            if status == 0:
                status, uplift = ROCKS, i * time_step + tau
            if keep:
                logged = _write(log, logged, i * time_step + tau, 0.0, 0.0)
        k = 0 if side > 0 else last
        a0, a1, g0, g1, square, left = 0.0, 0.0, still, 0.0, 0.0, np.inf
        if i < count:
            left = time_step - tau
            if left <= 0:
                i, tau = i + 1, 0.0
                continue
            if omega > 0:
                a0, a1 = ground[0] * math.sin(omega * tau), ground[0] * omega * math.cos(omega * tau)
                square = omega * omega
            else:
                a1 = (ground[i + 1] - ground[i]) * rate
                g1 = (gravity[i + 1] - gravity[i]) * rate
                a0, g0 = ground[i] + tau * a1, gravity[i] + tau * g1
        j, centre, room = _place(grid[k], arc)
        x = _series(pieces[k, j], arc - centre, speed, side, a0, a1, g0, g1, square)
        if arc == 0 and speed == 0 and x[1] < 0:  # uplift where the acceleration is zero to rounding
            x = (x[0], 0.0, x[2], x[3], x[4], x[5], x[6], x[7])
        h = _stride(x, min(left, pace[k]), room, arc, reach, haste, tolerance)
        steps += 1
        new, pull = arc + _displacement(x, h), _speed(x, h)
        start = i * time_step + tau
        landing, turn = -1.0, 0.0
        if speed > 0 >= pull:
            turn = _turning(x, h)
            peak = arc + _displacement(x, turn)
            slot = 0 if side > 0 else 1
            if peak > best[slot]:
                best[slot], when[slot] = peak, start + turn
            if keep:
                logged = _write(log, logged, start + turn, side * peak, 0.0)
            if i >= count:
                turns += 1
                if turns > last:
                    break
        elif speed < 0 <= pull:
            turn = _turning(x, h)
            if arc + _displacement(x, turn) <= 0:
                landing = _landing(x, arc, 0.0, turn)
        if landing < 0 and not new > 0:
            if not abs(new) < np.inf:
                status = NOT_FINITE
                break
            if pull < 0:
                landing = _landing(x, arc, turn, h)
        if landing < 0:
            arc, speed = new, pull
            reach, haste = max(reach, arc), max(haste, abs(speed))
            i, tau = (i + 1, 0.0) if h == left else (i, tau + h)
            if keep:
                logged = _write(log, logged, start + h, side * arc, side * speed)
            if arc > critical[k] and speed > 0:
                j, _, _ = _place(grid[k], arc)
                if arc >= end[k] or hold[k, j] > (threat[i] if i < count else 0.0):
                    status = OVERTURNS
                    break
            continue
        impacts += 1
        tau += landing
        speed = -_speed(x, landing)
        if keep:
            logged = _write(log, logged, start + landing, 0.0, -side * speed)
        speed *= restitution[k]
        if not one_sided:
            side, k = -side, last - k
        if keep:
            logged = _write(log, logged, start + landing, 0.0, side * speed)
        arc, reach, haste = 0.0, 0.0, speed
        if not speed > rest_speed[k]:
            side = 0
            if landing <= INSTANT * time_step:
                tau += PAUSE * time_step
        if impacts >= IMPACT_LIMIT:
            status = TOO_MANY_IMPACTS
            break
    return status, best, when, impacts, uplift, side, steps, logged


@compiled
def _hyperbolic(y):
    """cosh(y) − 1 and sinh(y) − y, without cancellation."""
    if y > 1:
        return math.cosh(y) - 1, math.sinh(y) - y
    z = y * y
    even = odd = 1.0
    if y > 0.1:
        even += z * (1 / 132) * (1 + z * (1 / 182) * (1 + z * (1 / 240) * (1 + z * (1 / 306))))
        odd += z * (1 / 156) * (1 + z * (1 / 210) * (1 + z * (1 / 272) * (1 + z * (1 / 342))))
    even = 1 + z * (1 / 12) * (1 + z * (1 / 30) * (1 + z * (1 / 56) * (1 + z * (1 / 90) * even)))
    odd = 1 + z * (1 / 20) * (1 + z * (1 / 42) * (1 + z * (1 / 72) * (1 + z * (1 / 110) * odd)))
    return 0.5 * z * even, y * z * (1 / 6) * odd


@compiled
def _weights(y):
    """Exact update over the scaled time y = p t: growth, decay, and what the two ends of a linear drive add."""
    even, odd = _hyperbolic(y)
    up, up_end = even + y + odd, (even + odd) / y
    if y > 1:
        down = -math.expm1(-y)
        down_end = 1 - down / y
    else:
        down, down_end = y + odd - even, (even - odd) / y
    return up + 1, 1 - down, up - up_end, up_end, down - down_end, down_end


@compiled
def _exact(x, w, drive, ramp, y):
    """x, its scaled velocity w and acceleration after the scaled time y, from x'' = x + drive + ramp y."""
    force = x + drive
    even, odd = _hyperbolic(y)
    if y <= 1:
        x += force * even + w * (y + odd) + ramp * odd
        w += w * even + force * (y + odd) + ramp * even
    else:
        growing = 0.5 * (force + w + ramp) * math.exp(y)
        decaying = 0.5 * (force - w - ramp) * math.exp(-y)
        x, w = growing + decaying - drive - ramp * y, growing - decaying - ramp
    return x, w, x + drive + ramp * y


@compiled
def _exact_root(x, w, drive, ramp, low, high, first, last, of_velocity):
    """The zero of w (or of x) between two scaled times where it is `first` and `last`, to rounding."""
    y = low + (high - low) * (first / (first - last))
    for _ in range(100):
        a, b, c = _exact(x, w, drive, ramp, y)
        value, slope = (b, c) if of_velocity else (a, b)
        if (value > 0) == (last > 0):
            high = y
        else:
            low = y
        new = y - value / slope
        if not low <= new <= high:
            new = 0.5 * (low + high)
        move, y = abs(new - y), new
        if move <= SETTLED * y:
            break
    return y


@compiled
def _sample_events(x, w, drive, ramp, span):
    """First landing within the scaled time span (−1 if none), and the largest peak before it with its time."""
    bound, peak, at = span, -1.0, 0.0
    force = x + drive
    if force * (_exact(x, w, drive, ramp, span)[2]) < 0:  # the velocity has an extreme, its only one
        bound = min(math.atanh(min(-force / (w + ramp), 1 - 1e-16)), span)
    low, floor, speed = 0.0, x, w
    for part in range(2):
        if part == 1:
            if bound == span:
                break
            bound = span
        height, end, _ = _exact(x, w, drive, ramp, bound)
        if speed > 0 >= end:
            turn = _exact_root(x, w, drive, ramp, low, bound, speed, end, True)
            floor, _, _ = _exact(x, w, drive, ramp, turn)
            if floor > peak:
                peak, at = floor, turn
            low = turn
        elif speed < 0 <= end:
            turn = _exact_root(x, w, drive, ramp, low, bound, speed, end, True)
            bottom, _, _ = _exact(x, w, drive, ramp, turn)
            if bottom <= 0:
                return _exact_root(x, w, drive, ramp, low, turn, floor, bottom, False), peak, at
        if height <= 0 and end < 0:
            return _exact_root(x, w, drive, ramp, low, bound, floor, height, False), peak, at
        low, floor, speed = bound, height, end
    return -1.0, peak, at


@compiled
def takeback(ground, time_step, frequency, side, out):
    """Fill out (n,) with what the rest of the record can take from the unstable coordinate x − 1 + x'/p.

    The largest, over all later instants T, of p ∫ s ü_g exp(−p (t − t_i)) dt up to T: a backward recursion. Divided by
    gλ it is the bound that proves overturning, so that one array serves every λ.
    """
    y = frequency * time_step
    decay, whole = math.exp(-y), -math.expm1(-y)
    even, odd = _hyperbolic(y)
    second = decay * (even + odd) / y
    first = whole - second
    last = ground.size - 1
    out[last] = 0.0
    for i in range(last - 1, -1, -1):
        now, then = side * ground[i], side * ground[i + 1]
        within = first * max(now, 0.0) + second * max(then, 0.0)
        out[i] = max(within, first * now + second * then + decay * out[i + 1])


@compiled
def _free_linear(
    x, w, side, k, time, frequency, span, restitution, one_sided, best, when, impacts, log, logged
):
    """Follow the equivalent block over still ground until no larger peak can come, in closed form.

    (x − 1)² − w² is constant in each flight. Returns status, impacts, side, logged.
    """
    last = frequency.size - 1
    turns = 0
    for _ in range(last + 2):
        unstable, stable = x - 1 + w, x - 1 - w
        if unstable >= 0:
            return OVERTURNS, impacts, side, logged
        energy = w * w + x * (2 - x)
        if w > 0:
            peak = energy / (1 + math.sqrt(max(1 - energy, 0.0)))
            at = time + 0.5 * math.log(stable / unstable) / frequency[k]
            logged = _write(log, logged, at, side * peak * span[k], 0.0)
            slot = 0 if side > 0 else 1
            if peak > best[slot]:
                best[slot], when[slot] = peak, at
            turns += 1
            if turns > last:
                break
        arrival = math.sqrt(energy)
        time += math.log((-1 - arrival) / unstable) / frequency[k]
        logged = _write(log, logged, time, 0.0, -side * arrival * span[k] * frequency[k])
        impacts += 1
        w = arrival * restitution[k] * frequency[k] * span[k]
        if not one_sided:
            side, k = -side, last - k
        w /= frequency[k] * span[k]
        x = 0.0
        if w * w <= REST_ENERGY:
            break
    return ROCKS, impacts, side, logged


@compiled
def _glide(ground, bound, time_step, p, scale, limit, full, i, tau, x, w, span, log, logged):
    """Advance from sample to sample, exactly, until one in which something may happen, an overturning, or the end.

    x'' = x + drive in p t, with a drive that is linear within a sample. full: the weights of a whole sample. Returns
    interval and offset, x and w there, drive there and at the end of the sample, x and w at the end of the sample,
    whether it overturned, samples passed, lines of log.
    """
    growth, decay, up, up_end, down, down_end = full
    drive = -1 - scale * (ground[i] + (tau / time_step) * (ground[i + 1] - ground[i]))
    if x == 0 and w == 0:  # uplift where the drive is zero to rounding
        drive = max(drive, 0.0)
    width = p * (time_step - tau)
    if tau > 0:
        growth, decay, up, up_end, down, down_end = _weights(width)
    q, r, passed = x + w, x - w, 0
    while True:
        final = -1 - scale * ground[i + 1]
        q = growth * q + drive * up + final * up_end
        r = decay * r - drive * down - final * down_end
        new, pull = 0.5 * (q + r), 0.5 * (q - r)
        force, later = x + drive, new + final
        # |x''| is largest at an end of the sample, so a velocity beyond y |x''| has no zero within it.
        same = force * later >= 0 or abs(w) > width * max(abs(force), abs(later))
        if not (new > 0 and w * pull > 0 and same):
            return i, tau, x, w, drive, final, new, pull, False, passed, logged
        i, tau, x, w, drive = i + 1, 0.0, new, pull, final
        growth, decay, up, up_end, down, down_end = full
        width = p * time_step
        passed += 1
        if log.shape[0] > 0:
            logged = _write(log, logged, i * time_step, span * x, span * w * p)
        fallen = q - 1 > limit * bound[i]
        if fallen or i == ground.size - 1:
            return i, tau, x, w, drive, final, new, pull, fallen, passed, logged


@compiled
def rock_linear(
    frequency, push, span, restitution, one_sided, ground, gravity, takeable, time_step, x, w, side, log
):  # fmt: skip
    """Follow an equivalent block through a record and on, exactly: per sample in closed form, events by iteration.

    Per side (k,): p, push = 1/(g λ), span = φ_cr, restitution. takeable: (2, n) from `takeback`, for the positive and
    the negative side. x = φ/φ_cr, w = x'/p. Returns what `rock` returns, with the peaks as ratios to φ_cr.
    """
    count, last = ground.size - 1, frequency.size - 1
    best, when = np.zeros(2), np.full(2, np.nan)
    lift = np.ones((last + 1, 2))
    lift[:, 1] = push
    whole = _weights(frequency[0] * time_step), _weights(frequency[last] * time_step)
    i, tau, status, impacts, steps, logged, uplift = 0, 0.0, 0, 0, 0, 0, np.nan
    if side != 0:
        status, uplift = ROCKS, 0.0
        best[0 if side > 0 else 1], when[0 if side > 0 else 1] = x, 0.0
    keep = log.shape[0] > 0
    k = 0 if side > 0 else last
    if keep:
        logged = _write(log, logged, 0.0, side * x * span[k], side * w * span[k] * frequency[k])
    while i < count:
        if side == 0:
            i, tau, side = _uplift(lift, one_sided, ground, gravity, time_step, i, tau)
            if side == 0:
                break
            x = w = 0.0
            if status == 0:
                status, uplift = ROCKS, i * time_step + tau
            if keep:
                logged = _write(log, logged, i * time_step + tau, 0.0, 0.0)
        k = 0 if side > 0 else last
        if time_step - tau <= 0:
            i, tau = i + 1, 0.0
            continue
        p, row = frequency[k], 0 if side > 0 else 1
        i, tau, x, w, drive, final, new, pull, fallen, passed, logged = _glide(
            ground, takeable[row], time_step, p, side * push[k], push[k] * (1 + 1e-12), whole[k],
            i, tau, x, w, side * span[k], log, logged,
        )  # fmt: skip
        steps += passed
        if fallen:
            status = OVERTURNS
            break
        if i == count:
            break
        steps += 1
        y = p * (time_step - tau)
        landing, peak, at = _sample_events(x, w, drive, (final - drive) / y, y)
        if peak > best[row]:
            best[row], when[row] = peak, i * time_step + tau + at / p
        if keep and peak > 0:
            logged = _write(log, logged, i * time_step + tau + at / p, side * peak * span[k], 0.0)
        if landing < 0:
            if not abs(new) < np.inf:
                status = NOT_FINITE
                break
            i, tau, x, w = i + 1, 0.0, new, pull
            if keep:
                logged = _write(log, logged, i * time_step, side * x * span[k], side * w * span[k] * p)
            if x + w - 1 > push[k] * takeable[row, i] * (1 + 1e-12):
                status = OVERTURNS
                break
            continue
        _, w, _ = _exact(x, w, drive, (final - drive) / y, landing)
        tau += landing / p
        impacts += 1
        if keep:
            logged = _write(log, logged, i * time_step + tau, 0.0, side * w * span[k] * p)
        w *= -restitution[k] * p * span[k]
        if not one_sided:
            side, k = -side, last - k
        w /= frequency[k] * span[k]
        x = 0.0
        if keep:
            logged = _write(log, logged, i * time_step + tau, 0.0, side * w * span[k] * frequency[k])
        if not w * w > REST_ENERGY or w < 0:
            side = 0
            if landing <= INSTANT * y:
                tau += PAUSE * time_step
        if impacts >= IMPACT_LIMIT:
            status = TOO_MANY_IMPACTS
            break
    if side != 0 and status == ROCKS and i >= count:
        time = count * time_step
        status, impacts, side, logged = _free_linear(
            x, w, side, k, time, frequency, span, restitution, one_sided, best, when, impacts, log, logged
        )
    return status, best, when, impacts, uplift, side, steps, logged


@compiled
def spectrum_row(frequency, pushes, restitution, ground, gravity, takeable, time_step, ratios):
    """Fill ratios (n,) with the peak of the symmetric block of one frequency for each push = 1/(g λ); inf overturns."""
    p, one, eta = np.array([frequency]), np.ones(1), np.array([restitution])
    none = np.empty((0, 3))
    for j in range(pushes.size):
        status, best, _, _, _, _, _, _ = rock_linear(
            p, pushes[j : j + 1], one, eta, False, ground, gravity, takeable, time_step, 0.0, 0.0, 0, none
        )
        ratios[j] = np.inf if status == OVERTURNS else max(best[0], best[1])
        if status > OVERTURNS:
            ratios[j] = np.nan
