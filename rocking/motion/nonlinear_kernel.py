"""The compiled integration of a mechanism by Taylor series, one member or many at a call.

A mechanism is followed in the arc q = ∫ √(I(φ)/I(0)) dφ, in which J drops out of the equation of motion:

    q'' = −G̃(q) (g + ü_v) − s B̃(q) ü_g ,   G̃ = G/√(I I(0)) , B̃ = B/√(I I(0))

G̃ and B̃ are piecewise polynomials, ü_g and ü_v are linear within a sample (or ü_g is a sine), so the Taylor
coefficients of q(t) follow from one recursion. A step is a polynomial of degree 8 (order 7), or of degree 6 where that
is accurate enough, and its events are the roots of that polynomial: nothing is interpolated or stepped twice.

numba stores compiled code under the file that defines it and looks at no other: functions that call each other stand
in one file, and so do the tuples that they take.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.motion import runs
from rocking.motion.runs import compiled, entry, part

SHORT_SHARE = 0.1
"""Share of a step's tolerance that the short series may take.

Its estimate is sharper than that of the long one, which overrates the error a thousandfold. With this share as many
responses keep to the tolerance as with the long series alone; with all of it, fewer do."""


class Ties(NamedTuple):
    """n ties on each side k of a mechanism, as functions of the arc on the pieces of its table.

    pieces: (k n, m, 24) D̃ = u'/√(I I(0)) and u D̃ alternating, then u, which is how far the tie's point has moved; a
    tension T pulls back with T D̃. law: (k, n, 8) stiffness, pretension, strength, u where it yields, the arcs where it
    yields and breaks, the largest stiffness · u'²/I, and D̃ at rest. The forces are times g, and in the unit of G per m.
    """

    pieces: np.ndarray
    law: np.ndarray


class Sides(NamedTuple):
    """A mechanism's table, by side k (one if they mirror, else the positive first), in the arc.

    pieces: (k, m, 16) G̃ and B̃ alternating, by power of the distance from the centre of a piece. grid: (k, 9) end of
    the inner zone, then width, count and room of the pieces of the inner and of the outer zone, then the inverse
    widths. lift: (k, 2) G̃(0), B̃(0). hold: (k, m) the ground acceleration in units of gravity that cannot bring the
    side back from that piece or beyond. critical, end: (k,) arc of φ_cr and of the end. rest_speed: (k,) the speed at
    which rocking rests. longest_step: (k,) s. near: (k, 8) an arc near rest; up to it the least and the largest G̃, the
    largest |B̃|, the largest |dG̃/dq| and |dB̃/dq|, the speed that reaches it over still ground, the slope of ties.
    kinks: (k, m + 1) arcs at which the pieces of a G̃ with kinks end, from 0 to inf; None where G̃ is smooth, and its
    pieces lie as `grid` says.
    """

    pieces: np.ndarray
    grid: np.ndarray
    lift: np.ndarray
    hold: np.ndarray
    critical: np.ndarray
    end: np.ndarray
    rest_speed: np.ndarray
    longest_step: np.ndarray
    near: np.ndarray
    one_sided: bool
    ties: Ties | None = None
    kinks: np.ndarray | None = None


CURVE = 6
"""Coefficients of a curve that joins samples of a smooth motion."""


class GroundSamples(NamedTuple):
    """A ground motion: (n,) samples, or a sine of one period.

    horizontal, vertical: ü_g and ü_v at the samples; a sine has its amplitude and 0 there. lightest: the smallest ü_v
    from each sample to the end. strongest: the largest |ü_g| from each `stretch` of samples to the end, and from the
    last sample. time_step: s, the period of a sine.
    circular_frequency: rad/s, 0 for samples. gravity: g. curves: (c, CURVE) ü_g over every `stretch` samples, by power
    of the time since the first of them; none where it is linear between samples.
    """

    horizontal: np.ndarray
    vertical: np.ndarray
    strongest: np.ndarray
    lightest: np.ndarray
    time_step: float
    circular_frequency: float
    gravity: float
    curves: np.ndarray = np.empty((0, CURVE))
    stretch: int = 1


class Member(NamedTuple):
    """The inputs that vary between the members of an ensemble.

    horizontal, vertical: factors of ü_g and of ü_v. restitution: η of the positive and of the negative side.
    """

    horizontal: float
    vertical: float
    restitution: tuple[float, float]


class RockingState(NamedTuple):
    """The state of a motion.

    interval, offset: of the ground motion, and s into it. arc, speed: outward. side: 0 is rest. farthest, fastest: the
    largest arc and speed of the present flight.
    """

    interval: int
    offset: float
    arc: float
    speed: float
    side: int
    farthest: float
    fastest: float


class Step(NamedTuple):
    """A step: its series, length, arc and speed at its end, when it turns and lands (−1: not), how it `_leaves`."""

    series: tuple[float, ...]
    length: float
    arc: float
    speed: float
    turn: float
    landing: float
    leaves: int


@compiled
def _margins(sides, held, ground, gravity):
    """Acceleration along the arc that would lift the structure, held by its ties, to the positive and negative side."""
    lift, last = sides.lift, sides.lift.shape[0] - 1
    negative = lift[last, 1] * ground - lift[last, 0] * gravity - held[1]
    return lift[0, 1] * -ground - lift[0, 0] * gravity - held[0], -np.inf if sides.one_sided else negative


@compiled
def _accelerations(ground, member, i):
    """ü_g and g + ü_v at a sample."""
    return member.horizontal * ground.horizontal[i], ground.gravity + member.vertical * ground.vertical[i]


@compiled
def _over(ground, i):
    """Whether the ground motion has no interval i."""
    return i >= (1 if ground.circular_frequency > 0 else ground.horizontal.size - 1)


@compiled
def _uplift(sides, ground, member, i, tau, held):
    """First instant from (interval i, offset tau) on that lifts: interval, offset, side (0 if none does)."""
    count = ground.horizontal.size - 1
    if i >= count:
        return i, 0.0, 0
    share = tau / ground.time_step
    push, weight = _accelerations(ground, member, i)
    next_push, next_weight = _accelerations(ground, member, i + 1)
    push, weight = push + share * (next_push - push), weight + share * (next_weight - weight)
    positive, negative = _margins(sides, held, push, weight)
    if positive > 0 or negative > 0:
        return i, tau, (1 if positive >= negative else -1)
    while i < count:
        next_push, next_weight = _accelerations(ground, member, i + 1)
        next_positive, next_negative = _margins(sides, held, next_push, next_weight)
        share, side = runs.crossing(positive, negative, next_positive, next_negative)
        if side != 0:
            return i, tau + share * (ground.time_step - tau), side
        positive, negative, tau = next_positive, next_negative, 0.0
        i += 1
    return i, 0.0, 0


@compiled
def _next_uplift(sides, phase, ground, member, i, tau):
    """First instant from (interval i, offset tau) on that lifts, of a record or of a sine; side 0 if none does."""
    held, lift, omega = (phase[0, HELD], phase[1, HELD]), sides.lift, ground.circular_frequency
    if omega == 0:
        return _uplift(sides, ground, member, i, tau, held)
    amplitude = member.horizontal * ground.horizontal[0]
    for half in range(2):
        push = -amplitude if half else amplitude
        side = -1 if push > 0 else 1
        if i > 0 or push == 0 or (sides.one_sided and side < 0):
            continue
        k = 0 if side > 0 else lift.shape[0] - 1
        holds = lift[k, 0] * ground.gravity + held[0 if side > 0 else 1]
        ratio = holds / (lift[k, 1] * abs(amplitude))
        if ratio < 1:
            angle = math.asin(ratio)
            if tau < ((half + 1) * math.pi - angle) / omega:
                return i, max(tau, (half * math.pi + angle) / omega), side
    return i, tau, 0


@compiled
def _place(grid, k, arc):
    """Index of the piece of side k that holds an arc, its centre, and the room beyond it."""
    if arc < grid[k, 0]:
        j = max(int(arc * grid[k, 7]), 0)
        return j, (j + 0.5) * grid[k, 1], grid[k, 3]
    j = int(min((arc - grid[k, 0]) * grid[k, 8], grid[k, 5] - 1))
    return int(grid[k, 2]) + j, grid[k, 0] + (j + 0.5) * grid[k, 4], grid[k, 6]


@compiled
def _piece(kinks, grid, phase, slot, k, arc):
    """As `_place`; where G̃ has kinks the piece of the present phase, which is good beyond its ends."""
    if kinks is None:
        return _place(grid, k, arc)
    j = int(phase[slot, PIECE])
    return j, kinks[k, j], np.inf


@compiled
def _polynomial(pieces, k, j, g, b):
    """Piece j of row k of g G̃ + b B̃, by power of the distance from its centre."""
    e0, e1 = g * pieces[k, j, 0] + b * pieces[k, j, 1], g * pieces[k, j, 2] + b * pieces[k, j, 3]
    e2, e3 = g * pieces[k, j, 4] + b * pieces[k, j, 5], g * pieces[k, j, 6] + b * pieces[k, j, 7]
    e4, e5 = g * pieces[k, j, 8] + b * pieces[k, j, 9], g * pieces[k, j, 10] + b * pieces[k, j, 11]
    e6, e7 = g * pieces[k, j, 12] + b * pieces[k, j, 13], g * pieces[k, j, 14] + b * pieces[k, j, 15]
    return e0, e1, e2, e3, e4, e5, e6, e7


@part
def _every_other(pieces, k, j, n):
    """The same of G̃ (n = 0) or B̃ (n = 1) alone."""
    low = pieces[k, j, n], pieces[k, j, n + 2], pieces[k, j, n + 4], pieces[k, j, n + 6]
    return *low, pieces[k, j, n + 8], pieces[k, j, n + 10], pieces[k, j, n + 12], pieces[k, j, n + 14]


@compiled
def _shift(e, u):
    """Taylor coefficients 0 to 6 of a polynomial about the place u."""
    e0, e1, e2, e3, e4, e5, e6, e7 = e
    a0 = e0 + u * (e1 + u * (e2 + u * (e3 + u * (e4 + u * (e5 + u * (e6 + u * e7))))))
    a1 = e1 + u * (2 * e2 + u * (3 * e3 + u * (4 * e4 + u * (5 * e5 + u * (6 * e6 + u * 7 * e7)))))
    a2 = e2 + u * (3 * e3 + u * (6 * e4 + u * (10 * e5 + u * (15 * e6 + u * 21 * e7))))
    a3 = e3 + u * (4 * e4 + u * (10 * e5 + u * (20 * e6 + u * 35 * e7)))
    a4 = e4 + u * (5 * e5 + u * (15 * e6 + u * 35 * e7))
    a5 = e5 + u * (6 * e6 + u * 21 * e7)
    return a0, a1, a2, a3, a4, a5, e6 + u * 7 * e7


@part
def _short_shift(e, u):
    """Its coefficients 0 to 4, with powers in pairs (Estrin), so that few operations wait for each other."""
    e0, e1, e2, e3, e4, e5, e6, e7 = e
    u2 = u * u
    u4 = u2 * u2
    a0 = e0 + u * e1 + u2 * (e2 + u * e3) + u4 * (e4 + u * e5 + u2 * (e6 + u * e7))
    a1 = e1 + u * 2 * e2 + u2 * (3 * e3 + u * 4 * e4) + u4 * (5 * e5 + u * 6 * e6 + u2 * 7 * e7)
    a2 = e2 + u * 3 * e3 + u2 * (6 * e4 + u * 10 * e5) + u4 * (15 * e6 + u * 21 * e7)
    a3 = e3 + u * 4 * e4 + u2 * (10 * e5 + u * 20 * e6) + u4 * 35 * e7
    return a0, a1, a2, a3, e4 + u * 5 * e5 + u2 * (15 * e6 + u * 35 * e7)


LARGEST, LOW, HIGH, YIELDING, LEFT, TAUT, STIFF, HELD, PIECE = range(9)
"""Places in a row of `phase`: the largest arc when last looked at, between which arcs the present phase holds, whether
a tie yields, how many are not broken and taut, the square of their frequency, what they hold with at rest; and the
piece of a G̃ with kinks."""

FIRST, EACH = 9, 6
"""The first place of the first tie, and the number of places of each: c and s of its tension c + s u in this phase,
whether it is broken, its plastic elongation, the arc below which that leaves it slack, and the largest arc of both."""


def memory(ties: Ties | None) -> np.ndarray:
    """Return room for the phase of n ties, (2, 9 + 6 n), a row for each side of rocking."""
    return np.empty((2, FIRST + (0 if ties is None else EACH * ties.law.shape[1])))


STIFFNESS, PRETENSION, STRENGTH, YIELD_STRETCH, YIELD_ARC, RUPTURE_ARC, SQUARE, AT_REST = range(8)
"""Places in the law of a tie."""


@compiled
def _forget(ties, phase):
    """Begin the memory of the ties, a row for the positive and one for the negative side."""
    for slot in range(2):
        for place in range(phase.shape[1]):
            phase[slot, place] = 0.0
    if ties is None:
        return
    for slot in range(2):
        for n in range(ties.law.shape[1]):
            law, at = ties.law[min(slot, ties.law.shape[0] - 1), n], FIRST + EACH * n
            phase[slot, at + 4] = -np.inf
            if law[STIFFNESS] == 0 and law[PRETENSION] == 0:
                phase[slot, at + 2] = 1  # fills the table of a side with fewer ties
            else:
                phase[slot, LEFT] += 1
                phase[slot, HELD] += law[PRETENSION] * law[AT_REST]


@compiled
def _stretch(ties, grid, k, row, arc):
    """u of a tie and its slope at an arc of side k."""
    j, centre, _ = _place(grid, k, arc)
    value, slope, at = 0.0, 0.0, arc - centre
    for power in range(7, -1, -1):
        slope = value + at * slope
        value = ties.pieces[row, j, 16 + power] + at * value
    return value, slope


@compiled
def _slack_arc(ties, grid, k, row, target, high):
    """The arc up to `high` at which u of a tie is `target` > 0, to rounding."""
    low, arc = 0.0, high
    for _ in range(100):
        value, slope = _stretch(ties, grid, k, row, arc)
        if value > target:
            high = arc
        else:
            low = arc
        new = arc - (value - target) / slope
        if not low <= new <= high:
            new = 0.5 * (low + high)
        move, arc = abs(new - arc), new
        if move <= runs.SETTLED * arc:
            break
    return arc


@compiled
def _stretch_for_good(ties, grid, row, k, n):
    """Note the plastic elongation of a tie, and the arc below which that leaves it slack."""
    law, place, at, largest = ties.law[k, n], k * ties.law.shape[1] + n, FIRST + EACH * n, row[LARGEST]
    row[at + 5] = largest
    row[at + 3] = max(_stretch(ties, grid, k, place, largest)[0] - law[YIELD_STRETCH], 0.0)
    if law[STIFFNESS] * row[at + 3] > law[PRETENSION]:
        slack = row[at + 3] - law[PRETENSION] / law[STIFFNESS]
        row[at + 4] = _slack_arc(ties, grid, k, place, slack, largest)


@compiled
def _enter_piece(kinks, phase, slot, k, arc, way):
    """Enter the piece of a G̃ with kinks that begins at an arc outward (way > 0), or ends there."""
    if kinks is None:
        return
    j = 0
    while arc > kinks[k, j + 1] or (way > 0 and arc == kinks[k, j + 1]):
        j += 1
    phase[slot, PIECE] = j
    phase[slot, LOW], phase[slot, HIGH] = kinks[k, j] if j > 0 else -np.inf, kinks[k, j + 1]


@compiled
def _enter(sides, phase, side, k, arc, way):
    """Enter what holds from an arc outward (way > 0) or back: a piece between kinks, or a phase of the ties."""
    _enter_piece(sides.kinks, phase, 0 if side > 0 else 1, k, arc, way)
    _enter_ties(sides.ties, sides.grid, phase, side, k, arc, way)


@compiled
def _enter_ties(ties, grid, phase, side, k, arc, way):
    """Set the tension of every tie as a function of u, and how far it holds, from an arc outward (way > 0) or back."""
    if ties is None:
        return
    row = phase[0 if side > 0 else 1]
    on_the_way_out = way > 0 and arc >= row[LARGEST]
    row[LARGEST] = max(row[LARGEST], arc)
    low, high, yielding, left, taut, stiff, held = -np.inf, np.inf, 0, 0, 0, 0.0, 0.0
    for n in range(ties.law.shape[1]):
        law, at = ties.law[k, n], FIRST + EACH * n
        row[at], row[at + 1] = 0.0, 0.0
        if on_the_way_out and arc >= law[RUPTURE_ARC]:
            row[at + 2] = 1
        if row[at + 2] != 0:
            continue
        left += 1
        if on_the_way_out and arc >= law[YIELD_ARC]:
            row[at], yielding, taut, high = law[STRENGTH], 1, taut + 1, min(high, law[RUPTURE_ARC])
            continue
        if row[LARGEST] > max(law[YIELD_ARC], row[at + 5]):
            _stretch_for_good(ties, grid, row, k, n)
        force, slack_arc = law[PRETENSION] - law[STIFFNESS] * row[at + 3], row[at + 4]
        held += max(force, 0.0) * law[AT_REST]
        if arc < slack_arc or (arc == slack_arc and way < 0):
            high = min(high, slack_arc)
            continue
        row[at], row[at + 1], taut, stiff = force, law[STIFFNESS], taut + 1, stiff + law[SQUARE]
        low, high = max(low, slack_arc), min(high, max(row[LARGEST], law[YIELD_ARC]))
    row[LOW], row[HIGH], row[YIELDING] = low, high, yielding
    row[LEFT], row[TAUT], row[STIFF], row[HELD] = left, taut, stiff, held


@compiled
def _with_ties(ties, phase, slot, k, j, e):
    """The polynomial of piece j that pulls back, with the taut ties' added to that of G̃ and B̃."""
    if ties is None:
        return e
    if phase[slot, TAUT] == 0:
        return e
    count = ties.law.shape[1]
    e0, e1, e2, e3, e4, e5, e6, e7 = e
    for n in range(count):
        c, s = phase[slot, FIRST + EACH * n], phase[slot, FIRST + EACH * n + 1]
        if c != 0 or s != 0:
            a0, a1, a2, a3, a4, a5, a6, a7 = _polynomial(ties.pieces, k * count + n, j, c, s)
            e0, e1, e2, e3 = e0 + a0, e1 + a1, e2 + a2, e3 + a3
            e4, e5, e6, e7 = e4 + a4, e5 + a5, e6 + a6, e7 + a7
    return e0, e1, e2, e3, e4, e5, e6, e7


@compiled
def _beyond(ties, kinks, phase, slot, arc):
    """1 where an arc is above the present phase, −1 below it, 0 within."""
    if ties is None and kinks is None:
        return 0
    return 1 if arc > phase[slot, HIGH] else -1 if arc < phase[slot, LOW] else 0


@compiled
def _longest_step(ties, phase, slot, longest):
    """The shortest time of the structure, `longest` without ties, with those that are taut in the present phase."""
    if ties is None:
        return longest
    return 1 / math.sqrt(1 / (longest * longest) + phase[slot, STIFF])


@part
def _push_terms(pieces, k, j, u, bent):
    """Coefficients of B̃ about u, by which a ground acceleration acts that is `bent`; zeros where it is linear."""
    if bent[0] == 0.0 and bent[1] == 0.0 and bent[2] == 0.0 and bent[3] == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    b0, b1, b2, b3, b4, _, _ = _shift(_polynomial(pieces, k, j, 0.0, 1.0), u)
    return b0, b1, b2, b3, b4


@part
def _series(pieces, k, j, u, v, side, a0, a1, g0, g1, bent, ties, phase):
    """Taylor coefficients (v, x2, ..., x8) of the arc, at the place u of piece j of side k.

    Ground acceleration a0 + a1 t and bent[n] t^(n + 2), n up to 4; gravity g0 + g1 t. Beside them, what the fifth power
    of the ground acceleration by itself adds to x7.
    """
    s0, s1, slot = side * a0, side * a1, 0 if side > 0 else 1
    own = _polynomial(pieces, k, j, g0, s0)
    w0, w1, w2, w3, w4, w5, w6 = _shift(_with_ties(ties, phase, slot, k, j, own), u)
    r0, r1, r2, r3, r4, r5, _ = _shift(_polynomial(pieces, k, j, g1, s1), u)
    b0, b1, b2, b3, b4 = _push_terms(pieces, k, j, u, bent)
    s2, s3, s4, s5, s6 = side * bent[0], side * bent[1], side * bent[2], side * bent[3], side * bent[4]
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
    return (v, x2, x3, x4, x5, x6, x7, x8), s5 * b0 * (-1 / 42)


@part
def _short_series(pieces, k, j, u, v, s0, s1, g0, g1, ties, phase, slot, bent):
    """The first coefficients (v, x2, ..., x7) of `_series`, and the parts of x5, x6 and x7 that bound the remainder.

    s0, s1: of the ground acceleration against the side. bent: as there, None where it is linear. A curve ends with its
    fifth power, so that what it pushes by itself is whole with x7, which holds nothing else.
    """
    if ties is None:
        p0, p1, p2, p3, p4 = _short_shift(_every_other(pieces, k, j, 0), u)
        q0, q1, q2, q3, q4 = _short_shift(_every_other(pieces, k, j, 1), u)
        still = g0 * p0 + s0 * q0, g0 * p1 + s0 * q1, g0 * p2 + s0 * q2, g0 * p3 + s0 * q3, g0 * p4 + s0 * q4
        growing = g1 * p0 + s1 * q0, g1 * p1 + s1 * q1, g1 * p2 + s1 * q2, g1 * p3 + s1 * q3, 0.0
    else:
        own = _with_ties(ties, phase, slot, k, j, _polynomial(pieces, k, j, g0, s0))
        still, growing = _short_shift(own, u), _short_shift(_polynomial(pieces, k, j, g1, s1), u)
    w0, w1, w2, w3, w4 = still
    r0, r1, r2, r3, _ = growing
    square = v * v
    x2 = -0.5 * w0
    x3 = (w1 * v + r0) * (-1 / 6)
    p4 = p5 = p6 = p7 = cross5 = cross6 = beyond = 0.0
    if bent is not None:
        b0, b1, b2, _, _ = _short_shift(_every_other(pieces, k, j, 1), u)
        s2, s3, s4, s5, _ = bent
        p4, p5, p6, p7 = s2 * b0 * (-1 / 12), s3 * b0 * (-1 / 20), s4 * b0 * (-1 / 30), s5 * b0 * (-1 / 42)
        d1, d2 = b1 * v, b1 * x2 + b2 * square
        cross5, cross6, beyond = s2 * d1, s2 * d2 + s3 * d1, (abs(w1 * p5) + abs(s4 * d1)) * (1 / 42)
    x4 = (w1 * x2 + w2 * square + r1 * v) * (-1 / 12) + p4
    double = 2 * v * x2
    x5 = (w1 * x3 + w2 * double + w3 * square * v + r1 * x2 + r2 * square + cross5) * (-1 / 20)
    still = w1 * x4 + w2 * (2 * v * x3 + x2 * x2) + 3 * w3 * square * x2 + w4 * square * square
    x6 = (still + r1 * x3 + r2 * double + r3 * square * v + cross6) * (-1 / 30)
    return (v, x2, x3, x4, x5 + p5, x6 + p6, p7), (abs(x5), abs(x6), beyond)


@part
def _curve(ground, i, tau, factor):
    """`factor` times the curve of an interval, by power of the time since `tau` in it: two terms and what is bent."""
    n = i // ground.stretch
    t = (i - n * ground.stretch) * ground.time_step + tau
    c1, c2, c3 = ground.curves[n, 1], ground.curves[n, 2], ground.curves[n, 3]
    c4, c5 = ground.curves[n, 4], ground.curves[n, 5]
    s0 = ground.curves[n, 0] + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5))))
    s1 = c1 + t * (2 * c2 + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))
    s2 = c2 + t * (3 * c3 + t * (6 * c4 + t * 10 * c5))
    s3, s4 = c3 + t * (4 * c4 + t * 10 * c5), c4 + t * 5 * c5
    return factor * s0, factor * s1, (factor * s2, factor * s3, factor * s4, factor * c5, 0.0)


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
def _accurate(x, sure, h, arc, farthest, fastest, tolerance):
    """Whether the last two terms of the series, which bound its remainder, are within the tolerance.

    They are measured against the largest arc and the largest speed of the present flight, so that small motions are as
    accurate as large ones. sure: the part of x7 after which nothing comes.
    """
    square = h * h
    tail = square * square * square * (abs(x[6] - sure) + h * abs(x[7]))
    if tail * h <= tolerance * farthest and 8 * tail <= tolerance * fastest:
        return True
    largest, quickest = max(farthest, abs(arc + _displacement(x, h))), max(fastest, abs(_speed(x, h)))
    return tail * h <= tolerance * largest and 8 * tail <= tolerance * quickest


@part
def _stride(x, sure, h, room, arc, farthest, fastest, tolerance):
    """Largest step up to h that is accurate, stays within reach of its piece, and turns at most once."""
    for _ in range(200):
        travel = h * (abs(x[0]) + h * (abs(x[1]) + h * (abs(x[2]) + h * abs(x[3]))))
        if travel <= room and _accurate(x, sure, h, arc, farthest, fastest, tolerance):
            break
        h *= 0.8
    least = 1e-6 * h
    while h > least and not _monotone(x, h):
        h *= 0.5
    return h


@part
def _eventless(x, bounds, h, share, arc, room, farthest, fastest, tolerance):
    """Whether the short series is accurate over h; whether the speed keeps its sign and the arc its piece; arc and
    speed after it; whether it may be accurate over 2h as well.

    Each term of the series is about `share` = h/τ of the one before it, τ being the shortest time of the structure. So
    the last term bounds the remainder; that share of the one before guards against a last term that happens to vanish.
    """
    v, x2, x3, x4, x5, x6, x7 = x
    fifth, sixth, beyond = bounds
    fourth = h * h * h * h
    tail = fourth * (h * (sixth + h * beyond) + share * fifth)
    bend = h * (3 * abs(x3) + h * (4 * abs(x4) + h * (5 * abs(x5) + h * (6 * abs(x6) + h * 7 * abs(x7)))))
    bend = h * (2 * abs(x2) + bend)
    new = arc + h * (v + h * (x2 + h * (x3 + h * (x4 + h * (x5 + h * (x6 + h * x7))))))
    pull = v + h * (2 * x2 + h * (3 * x3 + h * (4 * x4 + h * (5 * x5 + h * (6 * x6 + h * 7 * x7)))))
    allowed = SHORT_SHARE * tolerance
    of_arc, of_speed = allowed * max(farthest, new), allowed * max(fastest, abs(pull))
    accurate = tail * h <= of_arc and 6 * tail <= of_speed
    spare = 128 * tail * h <= of_arc and 384 * tail <= of_speed
    return accurate, bend < abs(v) and h * (abs(v) + bend) <= room, new, pull, spare


@part
def _glide(sides, phase, ground, member, k, motion, tolerance, leap, log):
    """Advance by the short series, up to a place from which something may happen, or to the end.

    From sample to sample where lines join them, else over as many as the series is accurate for: `leap` at first; how
    many at last comes back with the motion.
    """
    i, tau, arc, speed, side, farthest, fastest = motion
    pieces, grid, h = sides.pieces, sides.grid, ground.time_step
    horizontal, vertical, slot = ground.horizontal, ground.vertical, 0 if side > 0 else 1
    factor, longest = side * member.horizontal, _longest_step(sides.ties, phase, slot, sides.longest_step[k])
    last, rate = horizontal.size - 1, 1 / h
    if h > longest:
        return motion, leap
    while i < last:
        steps = min(leap, ground.stretch - i % ground.stretch) if leap > 1 else 1
        weight = ground.gravity + member.vertical * vertical[i]
        heavier = (ground.gravity + member.vertical * vertical[i + 1] - weight) * rate
        j, centre, room = _piece(sides.kinks, grid, phase, slot, k, arc)
        u, memory_of_ties = arc - centre, (sides.ties, phase, slot)
        if ground.stretch > 1:
            span, weight = steps * h - tau, weight + tau * heavier
            push, steeper, bent = _curve(ground, i, tau, factor)
            series = _short_series(
                pieces, k, j, u, speed, push, steeper, weight, heavier, *memory_of_ties, bent
            )
        else:
            span, push = h, factor * horizontal[i]
            steeper = (factor * horizontal[i + 1] - push) * rate
            series = _short_series(
                pieces, k, j, u, speed, push, steeper, weight, heavier, *memory_of_ties, None
            )
        accurate, plain, new, pull, spare = _eventless(
            *series, span, span / longest, arc, room, farthest, fastest, tolerance
        )
        if steps > 1 and not (accurate and span <= longest):
            leap = steps // 2
            continue
        out = new > sides.critical[k] and pull > 0
        if (
            not (accurate and plain and new > 0)
            or out
            or _beyond(sides.ties, sides.kinks, phase, slot, new) != 0
        ):
            break
        i, tau, arc, speed = i + steps, 0.0, new, pull
        farthest, fastest = max(farthest, arc), max(fastest, abs(speed))
        if spare and leap < ground.stretch:
            leap = min(2 * leap, ground.stretch)
        runs.write(log, i * h, side * arc, side * speed)
    return RockingState(i, tau, arc, speed, side, farthest, fastest), leap


@compiled
def _zero(x, arc, low, high, t, last, of_speed):
    """When the speed (of_speed > 0), or the arc, passes zero between two times, from t on, to rounding.

    last: a value of its sign at `high`.
    """
    for _ in range(100):
        speed = _speed(x, t)
        value, slope = (speed, _acceleration(x, t)) if of_speed > 0 else (arc + _displacement(x, t), speed)
        if (value > 0) == (last > 0):
            high = t
        else:
            low = t
        new = t - value / slope
        if not low <= new <= high:
            new = 0.5 * (low + high)
        move, t = abs(new - t), new
        if move <= runs.SETTLED * t:
            break
    return t


@compiled
def _turning(x, h, pull):
    """When the step turns; pull: the speed at its end, h."""
    return _zero(x, 0.0, 0.0, h, h * x[0] / (x[0] - pull), pull, 1.0)


@compiled
def _landing(x, arc, low, high):
    """When the arc passes zero between the times low, where it is above, and high, where it is at zero or below."""
    return _zero(x, arc, low, high, high, -1.0, 0.0)


@part
def _events(x, h, arc, speed, new, pull):
    """When the step turns and when it lands; −1 where it does not."""
    turn = landing = -1.0
    if speed > 0 >= pull:
        turn = _turning(x, h, pull)
    elif speed < 0 <= pull:
        turn = _turning(x, h, pull)
        if arc + _displacement(x, turn) <= 0:
            return turn, _landing(x, arc, 0.0, turn)
    if not new > 0 and pull < 0:
        landing = _landing(x, arc, max(turn, 0.0), h)
    return turn, landing


@part
def _leaves(ties, kinks, phase, slot, x, h, arc, speed, new, turn, landing):
    """When a step leaves the present phase, and how: 1 outward, −1 inward, 2 turning while a tie yields; 0 not."""
    if ties is None and kinks is None:
        return h, 0
    low, high, yields = phase[slot, LOW], phase[slot, HIGH], phase[slot, YIELDING] != 0
    if yields and speed <= 0 and new < arc:
        return 0.0, 2
    start, from_arc = 0.0, arc
    if turn >= 0:
        peak = arc + _displacement(x, turn)
        if peak > high:
            return _landing(_back(x), high - arc, 0.0, turn), 1
        if yields and speed > 0:
            return turn, 2
        if peak < low:
            return _landing(x, arc - low, 0.0, turn), -1
        start, from_arc = turn, peak
    end, last = (h, new) if landing < 0 else (landing, 0.0)
    if last > high and last > from_arc:
        return _landing(_back(x), high - arc, start, end), 1
    if last < low and last < from_arc:
        return _landing(x, arc - low, start, end), -1
    return h, 0


@compiled
def _back(x):
    """The series of the motion reversed in sign."""
    return -x[0], -x[1], -x[2], -x[3], -x[4], -x[5], -x[6], -x[7]


@part
def _drive(ground, member, i, tau):
    """ü_g, its slope, g + ü_v, its slope, and the further coefficients of ü_g, at an offset of an interval."""
    straight = 0.0, 0.0, 0.0, 0.0, 0.0
    if _over(ground, i):
        return 0.0, 0.0, ground.gravity, 0.0, straight
    if ground.circular_frequency > 0:
        omega, amplitude = ground.circular_frequency, member.horizontal * ground.horizontal[0]
        square, value, slope = omega * omega, math.sin(omega * tau), omega * math.cos(omega * tau)
        a0, a1 = amplitude * value, amplitude * slope
        a2, a3 = -square * a0 / 2, -square * a1 / 6
        bent = a2, a3, -square * a2 / 12, -square * a3 / 20, square * square * a2 / 360
        return a0, a1, ground.gravity, 0.0, bent
    push, weight = _accelerations(ground, member, i)
    next_push, next_weight = _accelerations(ground, member, i + 1)
    rate = 1 / ground.time_step
    push_rate, weight_rate = (next_push - push) * rate, (next_weight - weight) * rate
    if ground.stretch > 1:
        a0, a1, bent = _curve(ground, i, tau, member.horizontal)
        return a0, a1, weight + tau * weight_rate, weight_rate, bent
    return push + tau * push_rate, push_rate, weight + tau * weight_rate, weight_rate, straight


@compiled
def _dies_out(sides, ground, member, i, tau, speed, best):
    """Whether the chain of impacts that starts with `speed` provably ends, below the peaks on record, in time."""
    peak = best[0] if sides.one_sided else min(best[0], best[1])
    if sides.near.shape[0] == 1 and sides.ties is None:
        peak = max(best[0], best[1])
    shaking = ground.horizontal, ground.vertical, member.horizontal, member.vertical, ground.gravity
    return runs.dies_out(sides.near, member.restitution, shaking, ground.time_step, i, tau, speed, peak)


@compiled
def _strongest(ground, i):
    """The largest |ü_g| from the sample i to the end."""
    if ground.stretch == 1:
        return ground.strongest[i]
    n = i // ground.stretch + 1
    strongest = ground.strongest[n]
    for k in range(i, n * ground.stretch):
        strongest = max(strongest, abs(ground.horizontal[k]))
    return strongest


@part
def _lost(sides, phase, ground, member, k, motion):
    """Whether a motion has overturned: outward past φ_cr, and past its end or what the ground can still do.

    The latter is known where no tie is left.
    """
    arc = motion.arc
    if not (arc > sides.critical[k] and motion.speed > 0):
        return False
    if arc >= sides.end[k]:
        return True
    slot = 0 if motion.side > 0 else 1
    if phase[slot, LEFT] > 0:
        return False
    if _over(ground, motion.interval):
        excitation = 0.0
    else:
        least = ground.gravity + member.vertical * ground.lightest[motion.interval]
        strongest = abs(member.horizontal) * _strongest(ground, motion.interval)
        excitation = strongest / least if least > 0 else np.inf
    j, _, _ = _piece(sides.kinks, sides.grid, phase, slot, k, arc)
    return sides.hold[k, j] > excitation


@part
def _left(ground, i, tau):
    """The time from an offset of an interval to where the ground motion next loses its smoothness."""
    if _over(ground, i):
        return np.inf
    return (ground.stretch - i % ground.stretch) * ground.time_step - tau


@part
def _later(ground, i, tau, h, left):
    """The interval and the offset after the time h, of `left` as `_left` gives it."""
    if h == left:
        return i + ground.stretch - i % ground.stretch, 0.0
    tau += h
    if ground.stretch > 1:
        passed = int(tau / ground.time_step)
        return i + passed, tau - passed * ground.time_step
    return i, tau


@part
def _row(sides, side):
    """The row of a side in the table."""
    return 0 if side > 0 else sides.pieces.shape[0] - 1


@part
def _begin(sides, phase, start, best, log):
    """Forget what `best` and the ties held, and write down the start."""
    _forget(sides.ties, phase)
    runs.forget(best, start.side, start.arc)
    side = start.side
    if side != 0:
        _enter(sides, phase, side, _row(sides, side), start.arc, 1.0)
        if start.speed < 0:  # it came that far and turned: what yielded there lets go elastically
            _enter(sides, phase, side, _row(sides, side), start.arc, -1.0)
    runs.write(log, 0.0, side * start.arc, side * start.speed)


@part
def _lift(sides, phase, ground, member, motion, log):
    """The motion at its next uplift; at rest still if there is none."""
    i, tau, side = _next_uplift(sides, phase, ground, member, motion.interval, motion.offset)
    if side != 0:
        runs.write(log, i * ground.time_step + tau, 0.0, 0.0)
        _enter(sides, phase, side, _row(sides, side), 0.0, 1.0)
    return RockingState(i, tau, 0.0, 0.0, side, 0.0, 0.0)


@part
def _step(sides, phase, ground, member, k, motion, tolerance, left):
    """The step up to `left` over which the series is accurate, and which turns once and keeps its phase of the ties."""
    i, tau, arc, speed, side, farthest, fastest = motion
    slot = 0 if side > 0 else 1
    a0, a1, g0, g1, bent = _drive(ground, member, i, tau)
    j, centre, room = _piece(sides.kinks, sides.grid, phase, slot, k, arc)
    x, last = _series(sides.pieces, k, j, arc - centre, speed, side, a0, a1, g0, g1, bent, sides.ties, phase)
    # an uplift where the acceleration is zero to rounding does not fall
    if arc == 0 and speed == 0 and x[1] < 0:
        x = x[0], 0.0, x[2], x[3], x[4], x[5], x[6], x[7]
    longest = min(left, _longest_step(sides.ties, phase, slot, sides.longest_step[k]))
    sure = last if ground.stretch > 1 else 0.0  # a sine goes on, a curve ends
    h = _stride(x, sure, longest, room, arc, farthest, fastest, tolerance)
    new, pull = arc + _displacement(x, h), _speed(x, h)
    turn, landing = _events(x, h, arc, speed, new, pull)
    until, leaves = _leaves(sides.ties, sides.kinks, phase, slot, x, h, arc, speed, new, turn, landing)
    if leaves != 0:
        h = until
        if leaves != 2 and until <= runs.INSTANT * ground.time_step:
            # a rounding: what is beyond is entered after a moment
            h, leaves = min(runs.PAUSE * ground.time_step, left), 0
        new, pull, landing = arc + _displacement(x, h), _speed(x, h), -1.0
        turn = turn if turn <= h else -1.0
    return Step(x, h, new, pull, turn, landing, leaves)


@part
def _carry_on(sides, phase, ground, member, k, motion, step, left, log):
    """The motion after a step that does not land, and its status."""
    i, tau, _, _, side, farthest, fastest = motion
    arc, speed, h, leaves, slot = step.arc, step.speed, step.length, step.leaves, 0 if side > 0 else 1
    if not arc > 0 and not abs(arc) < np.inf:
        return motion, runs.NOT_FINITE
    now = i * ground.time_step + tau
    if leaves == 1 or leaves == -1:
        arc = phase[slot, HIGH if leaves > 0 else LOW]
    if leaves != 0 or _beyond(sides.ties, sides.kinks, phase, slot, arc) != 0:
        speed = min(speed, 0.0) if leaves == 2 else speed
        way = 1.0 if leaves == 1 or (leaves == 0 and speed > 0) else -1.0
        _enter(sides, phase, side, k, arc, way)
    i, tau = _later(ground, i, tau, h, left)
    runs.write(log, now + h, side * arc, side * speed)
    motion = RockingState(i, tau, arc, speed, side, max(farthest, arc), max(fastest, abs(speed)))
    return motion, runs.OVERTURNS if _lost(sides, phase, ground, member, k, motion) else runs.ROCKS


@part
def _strike(sides, phase, ground, member, k, motion, step, settle, best, log):
    """The motion after the impact that ends a step; at rest where it ends there."""
    i, tau, _, _, side, _, _ = motion
    landing, arrival = step.landing, -_speed(step.series, step.landing)
    now = i * ground.time_step + tau + landing
    i, tau = _later(ground, i, tau, landing, np.nan)
    runs.write(log, now, 0.0, -side * arrival)
    speed = arrival * member.restitution[0 if side > 0 else 1]
    if not sides.one_sided:
        side, k = -side, sides.pieces.shape[0] - 1 - k
    runs.write(log, now, 0.0, side * speed)
    _enter(sides, phase, side, k, 0.0, 1.0)
    if not speed > sides.rest_speed[k]:
        side = 0
        if landing <= runs.INSTANT * ground.time_step:
            tau += runs.PAUSE * ground.time_step
    elif settle and speed < sides.near[k, 6] and _dies_out(sides, ground, member, i, tau, speed, best[0]):
        side = 0
    return RockingState(i, tau, 0.0, speed, side, 0.0, speed)


@compiled
def _rock(sides, ground, member, start, tolerance, settle, phase, best, log):
    """Follow a mechanism through a ground motion and on. Returns status, impacts, uplift time, last side, steps."""
    time_step, motion = ground.time_step, start
    _begin(sides, phase, start, best, log)
    impacts, steps, turns, leap = 0, 0, 0, 1
    status, uplift = (runs.ROCKS, 0.0) if start.side != 0 else (0, np.nan)
    while status <= runs.ROCKS:
        if motion.side == 0:
            motion = _lift(sides, phase, ground, member, motion, log)
            if motion.side == 0:
                break
            if status == 0:
                status, uplift = runs.ROCKS, motion.interval * time_step + motion.offset
        k = _row(sides, motion.side)
        if time_step - motion.offset <= 0 and not _over(ground, motion.interval):
            _, _, arc, speed, side, farthest, fastest = motion
            motion = RockingState(motion.interval + 1, 0.0, arc, speed, side, farthest, fastest)
        whole = motion.offset == 0 or ground.stretch > 1
        if ground.circular_frequency == 0 and whole and not _over(ground, motion.interval):
            before = motion.interval
            motion, leap = _glide(sides, phase, ground, member, k, motion, tolerance, leap, log)
            steps += motion.interval - before
        left = _left(ground, motion.interval, motion.offset)
        step = _step(sides, phase, ground, member, k, motion, tolerance, left)
        steps += 1
        if motion.speed > 0 and step.turn >= 0:
            peak = motion.arc + _displacement(step.series, step.turn)
            when = motion.interval * time_step + motion.offset + step.turn
            runs.keep(best, log, motion.side, peak, 1.0, when)
            turns += _over(ground, motion.interval)
            if turns >= sides.pieces.shape[0]:
                break
        if step.landing < 0:
            motion, status = _carry_on(sides, phase, ground, member, k, motion, step, left, log)
        else:
            motion = _strike(sides, phase, ground, member, k, motion, step, settle, best, log)
            impacts += 1
            status = runs.TOO_MANY_IMPACTS if impacts >= runs.IMPACT_LIMIT else status
    return status, impacts, uplift, motion.side, steps


@entry
def rock(
    sides, ground, horizontal, vertical, restitution, start, tolerance, settle, phase, best, log, results
):
    """Follow a mechanism through a ground motion, until no larger peak can come, for every member: fill results (m, 9).

    horizontal, vertical: (m,) factors of ü_g and ü_v. restitution: (m, 2), η of the positive and of the negative side.
    settle: whether a chain of impacts that provably dies out is left out, with its impacts. phase: room for the memory
    of the ties. best: (2, 2), scratch for the largest arc of both sides and their times. log: (1 + m, 3) for the
    history, whose lines the first row counts, or no rows.
    """
    for m in range(horizontal.size):
        member = Member(horizontal[m], vertical[m], (restitution[m, 0], restitution[m, 1]))
        end = _rock(sides, ground, member, start, tolerance, settle, phase, best, log)
        runs.conclude(results[m], *end, best)
