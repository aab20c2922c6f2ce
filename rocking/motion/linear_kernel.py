"""The compiled exact response of an equivalent block to a record, one member or many at a call.

On one side, with x = φ/φ_cr (or what the block measures in its stead) and time in 1/p, x'' = x − 1 − s ü_g/(gλ). The
ground acceleration is linear within a sample, so each sample has a closed form; only event times are iterated.

numba stores compiled code under the file that defines it and looks at no other: functions that call each other stand
in one file, and so do the tuples that they take.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.motion import runs
from rocking.motion.runs import compiled, entry, part
from rocking.quantities import GRAVITY

NEAR = 1 / 16
"""Largest x of a chain of impacts that is looked at as a whole."""


class Blocks(NamedTuple):
    """An equivalent block, by side k (one if they mirror, else the positive first), or a row of each of many alike.

    frequency: (k,) p, rad/s. push: (k,) 1/(gλ). span: (k,) angular velocity at φ = 0 per x'. near: (k, 8) what
    `runs.dies_out` takes of it. one_sided: it leans.
    """

    frequency: np.ndarray
    push: np.ndarray
    span: np.ndarray
    near: np.ndarray
    one_sided: bool


class Samples(NamedTuple):
    """A record: ü_g (n,), the time step, and what the rest of it can take back, from `_takeback`.

    takeable: (k, 2, n), of side k where positive ü_g pushes it back, then where negative ü_g does; filled when it is
    needed where its last value is negative.
    """

    ground: np.ndarray
    time_step: float
    takeable: np.ndarray


class LinearState(NamedTuple):
    """The state of a motion: sample, time into it [s], x, x'/p, and side; side 0 is rest."""

    interval: int
    offset: float
    x: float
    w: float
    side: int


class Sample(NamedTuple):
    """A sample in which something may happen: x'' + 1 − x at its begin and end, and x and x'/p at its end if not."""

    drive: float
    final: float
    x: float
    w: float


@compiled
def _margins(blocks, ground):
    """The excess of the push to the positive and to the negative side over the uplift acceleration, over it."""
    last = blocks.push.shape[0] - 1
    return -ground * blocks.push[0] - 1, -np.inf if blocks.one_sided else ground * blocks.push[last] - 1


@compiled
def _uplift(blocks, ground, factor, time_step, i, tau):
    """First instant from (interval i, offset tau) on that lifts: interval, offset, side (0 if none does)."""
    count = ground.size - 1
    if i >= count:
        return i, 0.0, 0
    now = ground[i] + (tau / time_step) * (ground[i + 1] - ground[i])
    positive, negative = _margins(blocks, factor * now)
    if positive > 0 or negative > 0:
        return i, tau, (1 if positive >= negative else -1)
    while i < count:
        next_positive, next_negative = _margins(blocks, factor * ground[i + 1])
        share, side = runs.crossing(positive, negative, next_positive, next_negative)
        if side != 0:
            return i, tau + share * (time_step - tau), side
        positive, negative, tau = next_positive, next_negative, 0.0
        i += 1
    return i, 0.0, 0


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
    """The zero of w (of_velocity > 0) or of x between two scaled times where it is `first` and `last`, to rounding."""
    y = low + (high - low) * (first / (first - last))
    for _ in range(100):
        a, b, c = _exact(x, w, drive, ramp, y)
        value, slope = (b, c) if of_velocity > 0 else (a, b)
        if (value > 0) == (last > 0):
            high = y
        else:
            low = y
        new = y - value / slope
        if not low <= new <= high:
            new = 0.5 * (low + high)
        move, y = abs(new - y), new
        if move <= runs.SETTLED * y:
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
    for half in range(2):
        if half == 1:
            if bound == span:
                break
            bound = span
        height, end, _ = _exact(x, w, drive, ramp, bound)
        if speed > 0 >= end:
            turn = _exact_root(x, w, drive, ramp, low, bound, speed, end, 1.0)
            floor, _, _ = _exact(x, w, drive, ramp, turn)
            if floor > peak:
                peak, at = floor, turn
            low = turn
        elif speed < 0 <= end:
            turn = _exact_root(x, w, drive, ramp, low, bound, speed, end, 1.0)
            bottom, _, _ = _exact(x, w, drive, ramp, turn)
            if bottom <= 0:
                return _exact_root(x, w, drive, ramp, low, turn, floor, bottom, 0.0), peak, at
        if height <= 0 and end < 0:
            return _exact_root(x, w, drive, ramp, low, bound, floor, height, 0.0), peak, at
        low, floor, speed = bound, height, end
    return -1.0, peak, at


@compiled
def _takeback(ground, time_step, frequency, side, out):
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
def _dies_out(blocks, ground, factor, time_step, restitution, i, tau, speed, best):
    """Whether the chain of impacts that starts with `speed` (angular) provably ends, below the peaks, in time."""
    span, peak = blocks.span, min(best[0], best[1])
    if span.shape[0] == 1:
        peak = max(best[0], best[1])
    peak *= min(span[0], span[span.shape[0] - 1])
    shaking = ground, ground, factor, 0.0, GRAVITY
    return runs.dies_out(blocks.near, restitution, shaking, time_step, i, tau, speed, peak)


@compiled
def _free(motion, time, blocks, restitution, best, log):
    """Follow the equivalent block over still ground from `time` until no larger peak can come, in closed form.

    (x − 1)² − w² is constant in each flight. Returns status, impacts, side.
    """
    _, _, x, w, side = motion
    frequency, span, last = blocks.frequency, blocks.span, blocks.frequency.size - 1
    impacts, turns, k = 0, 0, 0 if side > 0 else last
    for _ in range(last + 2):
        unstable, stable = x - 1 + w, x - 1 - w
        if unstable >= 0:
            return runs.OVERTURNS, impacts, side
        energy = w * w + x * (2 - x)
        if w > 0:
            peak = energy / (1 + math.sqrt(max(1 - energy, 0.0)))
            runs.keep(best, log, side, peak, span[k], time + 0.5 * math.log(stable / unstable) / frequency[k])
            turns += 1
            if turns > last:
                break
        arrival = math.sqrt(energy)
        time += math.log((-1 - arrival) / unstable) / frequency[k]
        runs.write(log, time, 0.0, -side * arrival * span[k] * frequency[k])
        impacts += 1
        w = arrival * restitution[0 if side > 0 else 1] * frequency[k] * span[k]
        if not blocks.one_sided:
            side, k = -side, last - k
        w /= frequency[k] * span[k]
        x = 0.0
        if w * w <= runs.REST_ENERGY:
            break
    return runs.ROCKS, impacts, side


@part
def _glide(ground, bound, time_step, p, scale, limit, full, motion, span, log):
    """Advance from sample to sample, exactly, until one in which something may happen, an overturning, or the end.

    x'' = x + drive in p t, with a drive that is linear within a sample. full: the weights of a whole sample. Returns
    where it is then, that sample, whether it overturned, samples passed.
    """
    i, tau, x, w, side = motion
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
            return LinearState(i, tau, x, w, side), Sample(drive, final, new, pull), False, passed
        i, tau, x, w, drive = i + 1, 0.0, new, pull, final
        growth, decay, up, up_end, down, down_end = full
        width = p * time_step
        passed += 1
        runs.write(log, i * time_step, span * x, span * w * p)
        fallen = q - 1 > limit * bound[i]
        if fallen or i == ground.size - 1:
            return LinearState(i, tau, x, w, side), Sample(drive, final, new, pull), fallen, passed


@part
def _begin(blocks, start, best, log):
    """Forget what `best` held, and write down the start."""
    runs.forget(best, start.side, start.x)
    k = 0 if start.side > 0 else blocks.frequency.size - 1
    rotation, velocity = start.side * start.x * blocks.span[k], start.side * start.w * blocks.span[k]
    runs.write(log, 0.0, rotation, velocity * blocks.frequency[k])


@part
def _lift(blocks, samples, factor, motion, log):
    """The motion at its next uplift; at rest still if there is none."""
    time_step = samples.time_step
    i, tau, side = _uplift(blocks, samples.ground, factor, time_step, motion.interval, motion.offset)
    if side != 0:
        runs.write(log, i * time_step + tau, 0.0, 0.0)
    return LinearState(i, tau, 0.0, 0.0, side)


@part
def _strike(blocks, samples, factor, restitution, k, motion, w, landing, settle, best, log):
    """The motion after the impact, met with w, at the scaled time `landing`."""
    i, tau, _, _, side = motion
    ground, time_step, span, p = samples.ground, samples.time_step, blocks.span, blocks.frequency
    instant = landing <= runs.INSTANT * (p[k] * (time_step - tau))
    tau += landing / p[k]
    runs.write(log, i * time_step + tau, 0.0, side * w * span[k] * p[k])
    w *= -restitution[0 if side > 0 else 1] * p[k] * span[k]
    if not blocks.one_sided:
        side, k = -side, p.size - 1 - k
    w /= p[k] * span[k]
    runs.write(log, i * time_step + tau, 0.0, side * w * span[k] * p[k])
    if not w * w > runs.REST_ENERGY or w < 0:
        side = 0
        tau += runs.PAUSE * time_step if instant else 0.0
    elif settle and w < NEAR:
        speed = w * p[k] * span[k]
        if _dies_out(blocks, ground, factor, time_step, restitution, i, tau, speed, best[0]):
            side = 0
    return LinearState(i, tau, 0.0, w, side)


@part
def _meet(blocks, samples, factor, restitution, k, motion, sample, unstable, takeable, settle, best, log):
    """The motion after a sample in which it may turn and land, its status, and whether it has landed."""
    i, tau, x, w, side = motion
    p, span = blocks.frequency[k], blocks.span[k]
    y = p * (samples.time_step - tau)
    ramp = (sample.final - sample.drive) / y
    landing, peak, at = _sample_events(x, w, sample.drive, ramp, y)
    if peak > 0:
        runs.keep(best, log, side, peak, span, i * samples.time_step + tau + at / p)
    if landing >= 0:
        _, w, _ = _exact(x, w, sample.drive, ramp, landing)
        motion = _strike(blocks, samples, factor, restitution, k, motion, w, landing, settle, best, log)
        return motion, runs.ROCKS, 1
    if not abs(sample.x) < np.inf:
        return motion, runs.NOT_FINITE, 0
    runs.write(log, (i + 1) * samples.time_step, side * sample.x * span, side * sample.w * span * p)
    falls = sample.x + sample.w - 1 > unstable * takeable[i + 1]
    return LinearState(i + 1, 0.0, sample.x, sample.w, side), runs.OVERTURNS if falls else runs.ROCKS, 0


@compiled
def _rock(blocks, samples, factor, restitution, start, settle, best, log):
    """Follow an equivalent block through a record and on. Returns status, impacts, uplift time, last side, steps."""
    ground, time_step, last = samples.ground, samples.time_step, blocks.frequency.size - 1
    whole = _weights(blocks.frequency[0] * time_step), _weights(blocks.frequency[last] * time_step)
    _begin(blocks, start, best, log)
    motion, impacts, steps, count = start, 0, 0, ground.size - 1
    status, uplift = (runs.ROCKS, 0.0) if start.side != 0 else (0, np.nan)
    while motion.interval < count and status <= runs.ROCKS:
        if motion.side == 0:
            motion = _lift(blocks, samples, factor, motion, log)
            if motion.side == 0:
                break
            if status == 0:
                status, uplift = runs.ROCKS, motion.interval * time_step + motion.offset
        i, tau, x, w, side = motion
        if time_step - tau <= 0:
            motion = LinearState(i + 1, 0.0, x, w, side)
            continue
        k = 0 if side > 0 else last
        p, push, span = blocks.frequency[k], blocks.push[k], blocks.span[k]
        pushed = 0 if side * factor > 0 else 1
        unstable, takeable = push * abs(factor) * (1 + 1e-12), samples.takeable[k, pushed]
        if takeable[-1] < 0:
            _takeback(ground, time_step, p, 1 - 2 * pushed, takeable)
        motion, sample, fallen, passed = _glide(
            ground, takeable, time_step, p, side * push * factor, unstable, whole[k], motion, side * span, log
        )
        steps += passed
        if fallen:
            status = runs.OVERTURNS
        elif motion.interval < count:
            motion, status, landed = _meet(
                blocks, samples, factor, restitution, k, motion, sample, unstable, takeable, settle, best, log
            )
            steps, impacts = steps + 1, impacts + landed
            status = runs.TOO_MANY_IMPACTS if impacts >= runs.IMPACT_LIMIT else status
    if motion.side == 0 or status != runs.ROCKS or motion.interval < count:
        return status, impacts, uplift, motion.side, steps
    status, bounces, side = _free(motion, count * time_step, blocks, restitution, best, log)
    return status, impacts + bounces, uplift, side, steps


@entry
def rock_linear(blocks, samples, factors, restitution, start, settle, best, log, results):
    """Follow b blocks through a record times each of m factors, and on, exactly: fill results (b m, 9).

    blocks: of (b, k). factors: (m,) of ü_g. restitution: (b, m, 2), η of the positive and of the negative side.
    settle: whether a chain of impacts that provably dies out is left out, with its impacts. best: (2, 2), scratch for
    the largest x of both sides and their times. log: (1 + m, 3) for the history, whose lines the first row counts, or
    no rows.
    """
    count = factors.size
    for b in range(blocks.frequency.shape[0]):
        for k in range(blocks.frequency.shape[1]):
            samples.takeable[k, 0, -1] = samples.takeable[k, 1, -1] = -1.0
        own = Blocks(blocks.frequency[b], blocks.push[b], blocks.span[b], blocks.near[b], blocks.one_sided)
        for m in range(count):
            eta = restitution[b, m, 0], restitution[b, m, 1]
            end = _rock(own, samples, factors[m], eta, start, settle, best, log)
            runs.conclude(results[b * count + m], *end, best)
