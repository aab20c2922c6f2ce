"""The compiled course of an equivalent block under a sine pulse: flight by flight, exactly.

The pulse is the sine between two phases: one full sine from 0 to 2π, half a one to π, n cycles to 2πn, and one cycle of
cosine from π/2 to 5π/2.

On one side, with x = φ/φ_cr (or what the block measures in its stead), time t in units of 1/p and the forcing
f = a sin θ (a signed: positive where the ground lifts this side), θ = θ₀ + ωt, the block obeys x'' = x − 1 + f
(Eq. 10), and from x = 0, x' = v

    x = P (cosh t − 1) + Q sinh t + [f₀ (1 − cos ωt) − k sin ωt] / (1 + ω²) ,   k = a cos θ₀ ,
    P = (f₀ − 1 − ω²) / (1 + ω²) ,   Q = v + ωk / (1 + ω²) .

The zeros of x' are isolated exactly. With the homogeneous part h = P sinh t + Q cosh t and c = a cos θ,
(x'/c)' has the sign of r = h'c + ωhf, and r' = (1 + ω²) h c: between zeros of h and c, r is monotonic; between those
of r as well, x'/c is; between those of x', x is. No sampling, so no extreme and no contact can be missed.

numba stores compiled code under the file that defines it and looks at no other: functions that call each other stand
in one file, and so do the tuples that they take.
"""

import math
from typing import Any, NamedTuple

from numba import njit

LONGEST_TIME = 60.0
"""Flight time, in 1/p, after which e^t outweighs every term of the pulse by more than doubles can hold."""

REST_ENERGY = 1e-24
"""An impact that leaves less than this share of the energy needed to overturn leaves the block at rest."""

MOST_IMPACTS = 10_000
"""Impacts followed during the pulse before the prediction gives up; only a restitution within 1e-3 of 1 gets here."""

FULL_SINE = 0.0, 2 * math.pi
"""The phases at which one full sine begins and ends."""

_SHORT, _VERY_SHORT = 0.3, 1e-3
"""Below these values of max(t, ωt) the motion is summed as a power series of 14 and of 8 terms."""

_CONVERGED = 1e-10
"""A Newton step of this relative size is the last: the error after it is its square."""

_EQUAL = 1 + 1e-12
"""The ratio of two peaks up to which they count as equal, and the first is taken."""

# Of floats, because numba compiles what is called with an integer constant once for each.
_POSITION, _VELOCITY, _MONOTONY, _FALLING, _RISING = 0.0, 1.0, 2.0, 1.0, -1.0

_OPTIONS: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}
entry = njit(**_OPTIONS)
compiled = njit(**{**_OPTIONS, "no_cpython_wrapper": True})
"""The compiler of functions that Python does not call: a wrapper for them takes long to compile."""


class PulseSide(NamedTuple):
    """One side of a block under one pulse; ω = ω_g/p, a = |a_g|/(gλ), η of the impact that ends rocking here.

    end: x beyond which the mechanism ends. exists: whether the block rocks to this side at all.
    """

    frequency_ratio: float
    amplitude_ratio: float
    restitution: float
    velocity_scale: float
    end: float
    exists: bool


class PulseHistory(NamedTuple):
    """The course of the motion, by side: 0 the one that the pulse's first half lifts, 1 the other.

    peaks: largest x, inf overturns. peak_impacts: impacts before it, −1 where the side never rocks. contacts: impacts
    during the pulse. impacts: all that were followed. margin: smallest 1 − x − x' at the start of a flight after the
    pulse. unresolved: too many impacts.
    """

    peaks: tuple[float, float]
    peak_impacts: tuple[int, int]
    contacts: int
    impacts: int
    margin: float
    unresolved: bool


class Flight(NamedTuple):
    """The motion from φ = 0 at phase θ₀ with velocity v ≥ 0. excess: f₀ − 1. slope: k = a cos θ₀. P and Q."""

    omega: float
    amplitude: float
    phase: float
    velocity: float
    excess: float
    slope: float
    share: float
    cosine: float
    sine: float


@compiled
def flight(omega, amplitude, phase, velocity, excess, slope):
    """The flight with its coefficients."""
    share = 1 / (1 + omega * omega)
    cosine, sine = (excess - omega * omega) * share, velocity + omega * slope * share
    return Flight(omega, amplitude, phase, velocity, excess, slope, share, cosine, sine)


@compiled
def _series(f, t, terms):
    """Sum the power series of x, x', x'': yₙ tⁿ/n! with y₁ = v, y₂ = f₀ − 1 and y₍ₙ₊₂₎ = yₙ + f⁽ⁿ⁾."""
    y, following, square = f.velocity, f.excess, -f.omega * f.omega
    odd, even = f.slope * f.omega, (1 + f.excess) * square
    before, now = 0.0, 1.0  # tⁿ⁻²/(n−2)! and tⁿ⁻¹/(n−1)!
    x = velocity = acceleration = 0.0
    for n in range(1, terms):
        after = now * t / n
        x += y * after
        velocity += y * now
        acceleration += y * before
        before, now = now, after
        y, following, odd, even = following, y + odd, even, odd * square
    return x, velocity, acceleration


@compiled
def state(f, t):
    """x, x', x'' at time t ≥ 0."""
    u = f.omega * t
    if t < _SHORT and u < _SHORT:
        return _series(f, t, 8 if t < _VERY_SHORT and u < _VERY_SHORT else 14)
    half, sin, half_sin = math.sinh(t / 2), math.sin(u), math.sin(u / 2)
    rise, versine = 2 * half * half, 2 * half_sin * half_sin
    sinh = 2 * half * math.sqrt(1 + half * half)
    f0, k = 1 + f.excess, f.slope
    x = f.cosine * rise + f.sine * sinh + f.share * (f0 * versine - k * sin)
    forced = f.omega * f.share * (f0 * sin - k * (1 - versine))
    velocity = f.cosine * sinh + f.sine * (1 + rise) + forced
    return x, velocity, x - 1 + f0 * (1 - versine) + k * sin


@compiled
def _monotony(f, t):
    """r and r' of the module's docstring."""
    u = f.omega * t
    growing = math.exp(t)
    sinh, cosh = math.sinh(t), 0.5 * (growing + 1 / growing)
    sin, cos = math.sin(u), math.cos(u)
    h, rate = f.cosine * sinh + f.sine * cosh, f.cosine * cosh + f.sine * sinh
    f0 = 1 + f.excess
    c, force = f.slope * cos - f0 * sin, f0 * cos + f.slope * sin
    return rate * c + f.omega * h * force, h * c / f.share


@compiled
def root(f, kind, way, low, high, guess):
    """The time at which a value passes through zero between low and high: _FALLING below it, or _RISING above.

    Newton's iteration, kept inside the bracket and replaced by bisection where it does not halve the value.
    """
    t, last = guess, math.inf
    for _ in range(200):
        if kind == _MONOTONY:
            value, slope = _monotony(f, t)
        else:
            x, velocity, acceleration = state(f, t)
            value, slope = (x, velocity) if kind == _POSITION else (velocity, acceleration)
        if way * value > 0:
            low = t
        else:
            high = t
        newton = t - value / slope if slope != 0 else math.nan
        if abs(newton - t) <= _CONVERGED * t:
            return min(max(newton, low), high)
        bisect = not low <= newton <= high or abs(value) > last / 2
        t, last = ((low + high) / 2 if bisect else newton), abs(value)
        if high - low <= 4e-16 * high:
            break
    return t


@compiled
def _contact(f, low, high, guess, peak):
    """contact, time, x, x' and peak of a flight that lands between two times."""
    time = root(f, _POSITION, _FALLING, low, high, guess)
    x, velocity, _ = state(f, time)
    return True, time, x, velocity, peak


@compiled
def _zero_of_h(f):
    """The time at which h vanishes; infinity where it does not after the start."""
    zero = math.atanh(-f.sine / f.cosine) if abs(f.sine) < abs(f.cosine) else math.inf
    return zero if zero > 0 else math.inf


@compiled
def _follow(f, high, low, rising, peak):
    """Follow x' to the next time between which and the last x'/c is monotonic.

    Returns the way it ends (whether it lands in between, and that landing), the new low, whether it rises, and peak.
    """
    x, velocity, _ = state(f, high)
    landing = False, 0.0, x, velocity, peak
    if rising and velocity < 0:
        low = root(f, _VELOCITY, _FALLING, low, high, (low + high) / 2)
        peak, rising = max(peak, state(f, low)[0]), False
    elif not rising and velocity > 0:
        turn = root(f, _VELOCITY, _RISING, low, high, (low + high) / 2)
        if state(f, turn)[0] <= 0:
            return _contact(f, low, turn, (low + turn) / 2, peak), low, rising, peak
        low, rising = turn, True
    if not rising and x <= 0:
        return _contact(f, low, high, (low + high) / 2, peak), low, rising, peak
    return landing, high, rising, peak


@compiled
def land(f, duration):
    """Follow the flight for `duration` (1/p) at most, or to its first contact: contact, time, x, x', highest peak."""
    start, before = 0.0, _monotony(f, 0.0)[0]
    low, rising, peak = 0.0, True, 0.0
    x = velocity = 0.0
    zero = _zero_of_h(f)
    quarter = math.floor(f.phase / math.pi + 0.5)  # c vanishes at each odd quarter of a cycle
    while True:
        crest = ((quarter + 0.5) * math.pi - f.phase) / f.omega
        if crest <= start:
            quarter += 1
            continue
        high = min(crest, duration)
        if start < zero < high:
            high = zero
        after = _monotony(f, high)[0]
        if before * after < 0:
            way = _FALLING if before > 0 else _RISING
            node = root(f, _MONOTONY, way, start, high, (start + high) / 2)
            landing, low, rising, peak = _follow(f, node, low, rising, peak)
            if landing[0]:
                return landing
        landing, low, rising, peak = _follow(f, high, low, rising, peak)
        if landing[0]:
            return landing
        _, _, x, velocity, _ = landing
        if high == duration:
            break
        start, before = high, after
    return False, duration, x, velocity, max(peak, x)


@compiled
def hop(f, duration, peak):
    """Follow a short flight whose acceleration is proved negative throughout: whether it can be proved, and the rest.

    With d = 1 − f₀ > 0, f changing by at most d/2 and x ≤ d/4 within the time 8v/d, x'' ≤ −d/4 there: the flight
    lands within that time, no higher than 2v²/d, and is in the air at v/d, since x'' ≥ −3d/2 as well.
    The peak is sought only where it can exceed `peak`.
    """
    d, v = -f.excess, f.velocity
    none = False, 0.0, 0.0, 0.0, 0.0
    if d <= 0 or v * v > d * d / 8:
        return False, none
    latest = 8 * v / d
    if latest > duration or abs(f.amplitude) * f.omega * latest > d / 2:
        return False, none
    if 2 * v * v / d > peak:
        peak = state(f, root(f, _VELOCITY, _FALLING, 0.0, latest, v / d))[0]
    bend = 2 * v / (3 * d * d) * (v + f.omega * f.slope)
    return True, _contact(f, v / d, latest, 2 * v / d * (1 + bend), peak)


@compiled
def _uplift_slope(side):
    """s = √(a² − 1), the slope of a sin θ where it reaches 1."""
    a = side.amplitude_ratio
    return math.sqrt((a - 1) * (a + 1))


@compiled
def _next_uplift(sides, phase, end):
    """The phase, at or after `phase`, at which a resting block is lifted, and the side; −1 where it is not by `end`."""
    first, index = end, -1
    for k in range(2):
        side = sides[k]
        if not side.exists or side.amplitude_ratio <= 1:
            continue
        uplift = math.atan2(1.0, _uplift_slope(side))
        half = k  # of the sine, each of which pushes to one side
        while phase >= (half + 1) * math.pi - uplift:
            half += 2
        start = max(phase, half * math.pi + uplift)
        if start < first:
            first, index = start, k
    return first, index


@compiled
def _flight_of(side, index, phase, velocity):
    """The flight of a side from rest at its uplift, or from an impact."""
    amplitude = side.amplitude_ratio * (1 - 2 * index)
    slope = _uplift_slope(side) if side.amplitude_ratio > 1 else 0.0
    half = index + 2 * math.floor((phase - index * math.pi) / (2 * math.pi) + 1e-9)
    if velocity == 0 and side.amplitude_ratio > 1 and phase == half * math.pi + math.atan2(1.0, slope):
        return flight(side.frequency_ratio, amplitude, phase, velocity, 0.0, slope)
    excess = amplitude * math.sin(phase) - 1
    return flight(side.frequency_ratio, amplitude, phase, velocity, excess, amplitude * math.cos(phase))


@compiled
def _impact(sides, index, speed):
    """The side and the velocity after landing on side `index` with `speed`."""
    following = 1 - index if sides[1 - index].exists else index
    scale = sides[index].velocity_scale / sides[following].velocity_scale
    return following, sides[index].restitution * speed * scale


@compiled
def _largest_force(amplitude_ratio, start, end):
    """The largest a |sin θ| for θ in [start, end], rad."""
    if (math.floor(start / math.pi + 0.5) + 0.5) * math.pi < end:
        return amplitude_ratio
    return amplitude_ratio * max(abs(math.sin(start)), abs(math.sin(end)))


@compiled
def _settles(sides, phase, index, velocity, unseen, pulse_end):
    """A phase by which the chain of impacts is proved to be over, or −1 if that is not proved.

    Halfway to the next uplift, d bounds 1 − f on both sides from below. A flight launched with v² ≤ d²/2 has
    x'' ≤ −d/2: it lasts 4v/d at most, rises v²/d at most, and lands with at most v √(1 + 8aωv/d²), so two flights
    multiply the velocity by ρ² = η₁η₂ (1 + 8aωv/d²) at most. If ρ² < 1 the times of all flights sum to
    8v/(d (1 − ρ²)). The chain is over if that ends in time and v²/d does not exceed the peak on record.
    """
    following, lifted = _next_uplift(sides, phase, pulse_end)
    end = pulse_end if lifted < 0 else phase + (following - phase) / 2
    least, v, omega, steepest, restitution = math.inf, 0.0, 0.0, 0.0, 1.0
    for k in range(2):
        side = sides[k] if sides[k].exists else sides[1 - k]
        least = min(least, 1 - _largest_force(side.amplitude_ratio, phase, end))
        v = max(v, velocity * (sides[index].velocity_scale / side.velocity_scale))
        omega = max(omega, side.frequency_ratio)
        steepest = max(steepest, side.amplitude_ratio * side.frequency_ratio)
        restitution *= side.restitution
    if least <= 0 or v * v > least * least / 2 or v * v / least > unseen:
        return -1.0
    shrink = restitution * (1 + 8 * steepest * v / (least * least))
    over = shrink < 1 and phase + 8 * omega * v / (least * (1 - shrink)) <= end
    return end if over else -1.0


@compiled
def _raised(peaks, impacts_then, index, peak, impacts):
    """The peaks and their impacts with one more peak of a side; of equal ones the first stays."""
    if impacts_then[index] >= 0 and not peak > peaks[index] * _EQUAL:
        return peaks, impacts_then
    if index == 0:
        return (peak, peaks[1]), (impacts, impacts_then[1])
    return (peaks[0], peak), (impacts_then[0], impacts)


@compiled
def _after_pulse(sides, index, x, velocity, peaks, at, impacts, margin):
    """The free motion from the pulse's end: x − 1 + x' > 0 overturns, else (x − 1)² − x'² is conserved."""
    energy = x * (2 - x) + velocity * velocity
    unstable, rising = x + velocity, velocity > 0
    for turn in range(3):
        margin = min(margin, 1 - unstable)
        if unstable > 1:
            peaks, at = _raised(peaks, at, index, math.inf, impacts)
            break
        if rising or turn > 0:
            peak = energy / (1 + math.sqrt(max(1 - energy, 0.0)))
            peaks, at = _raised(peaks, at, index, peak, impacts)
        if turn == 2:
            break
        impacts += 1
        index, velocity = _impact(sides, index, math.sqrt(max(energy, 0.0)))
        energy, unstable = velocity * velocity, velocity
    return peaks, at, impacts, margin


@compiled
def _ended(first, second, peaks, margin):
    """Peaks and margin with an overturning where a peak passes the end of the mechanism."""
    one = math.inf if peaks[0] > first.end else peaks[0]
    other = math.inf if peaks[1] > second.end else peaks[1]
    unproved = max(one, other) == math.inf and max(peaks) != math.inf
    return (one, other), -math.inf if unproved else margin


@entry
def course(first, second, begin, end):
    """Follow the block from rest at the pulse's start to its last relevant flight.

    first: the side that the first half of a sine lifts; second: the other one. begin, end: phases of the pulse, rad.
    """
    sides, velocity = (first, second), 0.0
    alike = not (first.exists and second.exists) or first == second
    peaks, at, contacts, impacts, margin, _ = PulseHistory((0.0, 0.0), (-1, -1), 0, 0, 1.0, False)
    phase, index = _next_uplift(sides, begin, end)
    while index >= 0:
        f = _flight_of(sides[index], index, phase, velocity)
        remaining = max(0.0, (end - f.phase) / f.omega)
        duration = min(remaining, LONGEST_TIME)
        unseen = max(peaks) if alike else min(peaks)
        short, landing = hop(f, duration, unseen)
        if not short:
            landing = land(f, duration)
        contact, time, x, speed, peak = landing
        peaks, at = _raised(peaks, at, index, peak, impacts)
        if not contact:
            speed = speed if duration == remaining else math.inf
            peaks, at, impacts, margin = _after_pulse(sides, index, x, speed, peaks, at, impacts, margin)
            break
        phase += f.omega * time
        impacts, contacts = impacts + 1, contacts + 1
        index, velocity = _impact(sides, index, -speed)
        unseen = max(peaks) if alike else min(peaks)
        rest = (
            phase
            if velocity * velocity <= REST_ENERGY
            else _settles(sides, phase, index, velocity, unseen, end)
        )
        if rest >= 0:
            velocity = 0.0
            phase, index = _next_uplift(sides, rest, end)
        elif impacts >= MOST_IMPACTS:
            return PulseHistory(peaks, at, contacts, impacts, math.nan, True)
    peaks, margin = _ended(first, second, peaks, margin)
    return PulseHistory(peaks, at, contacts, impacts, margin, False)


@entry
def courses(rows, signs, frequencies, amplitudes, begins, ends, peaks, margins):
    """`course` of every block (m,) under every pulse (n,): fill peaks (m, n, 2), positive side first, and margins.

    rows: (m, 2, 6) p, gλ, η, velocity scale, end and existence of the positive and of the negative side. signs: (n,) +1
    where the first half of a sine lifts the positive side, else −1. frequencies, amplitudes: (n,) ω_g, |a_g|. begins,
    ends: (n,) phases of the pulse, rad. nan: unresolved.
    """
    for i in range(rows.shape[0]):
        for j in range(frequencies.size):
            first = 0 if signs[j] > 0 else 1
            result = _course_of(rows[i], first, frequencies[j], amplitudes[j], begins[j], ends[j])
            peaks[i, j, first], peaks[i, j, 1 - first] = result.peaks
            margins[i, j] = result.margin
            if result.unresolved:
                peaks[i, j, 0] = peaks[i, j, 1] = math.nan


@compiled
def _course_of(rows, first, frequency, amplitude, begin, end):
    """The `course` of the block of two rows under one pulse, where the first half of a sine lifts row `first`."""
    one, other = rows[first], rows[1 - first]
    return course(
        PulseSide(frequency / one[0], amplitude / one[1], one[2], one[3], one[4], one[5] != 0),
        PulseSide(frequency / other[0], amplitude / other[1], other[2], other[3], other[4], other[5] != 0),
        begin,
        end,
    )


@entry
def thresholds(rows, sign, frequencies, amplitudes):
    """Fill amplitudes (m, n) with the smallest one at which each block (m,) overturns under a sine of each frequency.

    rows, sign: as `courses` takes them. In steps of 2 % from the uplift acceleration, then by halving.
    """
    first = 0 if sign > 0 else 1
    for i in range(rows.shape[0]):
        positive, negative = rows[i, 0], rows[i, 1]
        lift = min(positive[1], negative[1]) if negative[5] != 0 else positive[1]
        for j in range(frequencies.size):
            low, high = lift / 1.02, lift
            while high <= 1000 * lift and not _overturns(rows[i], first, frequencies[j], high):
                low, high = high, high * 1.02
            while high <= 1000 * lift and high - low > 1e-9 * high:
                middle = 0.5 * (low + high)
                if _overturns(rows[i], first, frequencies[j], middle):
                    high = middle
                else:
                    low = middle
            amplitudes[i, j] = high if high <= 1000 * lift else math.inf


@compiled
def _overturns(rows, first, frequency, amplitude):
    """Whether a block overturns under one full sine."""
    begin, end = FULL_SINE
    return max(_course_of(rows, first, frequency, amplitude, begin, end).peaks) == math.inf
