"""A ground motion and a Mechanism as the kernel sees them.

The motion is samples joined by lines or curves, or one exact sine pulse. A mechanism is its sides as piecewise
polynomials of the arc, stacked and remembered.

In the arc q the term J φ'² drops out of the equation of motion (J = I'/2), and what is left of it is
G̃ = G/√(I I(0)) and B̃ = B/√(I I(0)). For a rigid body I is constant and q = φ.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from threading import RLock
from weakref import WeakKeyDictionary, ref

import numpy as np
from numpy.polynomial.polynomial import polyvander

from rocking.errors import MotionError, StructureError
from rocking.motion import runs
from rocking.motion.nonlinear_kernel import CURVE, GroundSamples, Sides, Ties
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY, kind_of
from rocking.signal.accelerogram import Accelerogram
from rocking.structures.equivalent_block import Arc, Function, RotationMap
from rocking.structures.mechanism import CUTS, EquivalentBlock, Mechanism, Side, SideTie

GroundMotion = Accelerogram | Pulse

CURVE_ERROR = 1e-6
"""Largest distance of a curve from the samples that it joins, over the peak of the motion: where one is farther, lines
join them all."""

FORCING_BYTES = 32_000_000
"""Bytes of what is kept of records in addition to their samples, those used last: of 250 components of 150 s at 100 Hz,
and of the eight directions of such a pair on a support after each of six processings."""


@dataclass(frozen=True, eq=False)
class Forcing:
    """The ground motion as the kernel takes it.

    start_time: s, added to every time of the response. vertical: whether it has a vertical component. weightless:
    whether g + ü_v falls below zero. excitation: the largest |ü_g|/(g + ü_v), whatever the phase of the two; inf where
    gravity may vanish.
    """

    ground: GroundSamples
    start_time: float
    vertical: bool
    weightless: bool
    excitation: float

    @property
    def own_bytes(self) -> int:
        """Bytes of what it does not share with the record or with other forcings."""
        return self.ground.strongest.nbytes + self.ground.curves.nbytes


def forcing_of(motion: GroundMotion, vertical: Accelerogram | None = None) -> Forcing:
    """Return what the kernel takes of a record, with its vertical component, or of a pulse.

    Those of records that live are remembered, the ones that were made last.
    Raises MotionError when `motion` is neither or a pulse that is no full sine, or `vertical` does not fit its samples.
    """
    if not isinstance(motion, Accelerogram | Pulse):
        raise MotionError(
            f"the ground motion is {kind_of(motion)}, but must be an Accelerogram or a Pulse.", motion=motion
        )
    if isinstance(motion, Pulse) and not motion.is_full_sine:
        raise MotionError(
            f"the ground motion is {motion!r}, but of pulses one full sine alone is integrated as it stands; give its "
            "samples: Accelerogram(pulse.acceleration(times), time_step).",
            motion=motion,
        )
    if vertical is None:
        return _of_pulse(motion) if isinstance(motion, Pulse) else _FORCINGS.of(motion, None)
    if isinstance(motion, Pulse):
        raise MotionError(
            "vertical is given with a pulse, but needs a record of the same samples; leave it out.",
            vertical=vertical,
        )
    if not isinstance(vertical, Accelerogram):
        raise MotionError(f"vertical is {kind_of(vertical)}, but must be an Accelerogram.", vertical=vertical)
    if vertical.acceleration.size != motion.acceleration.size:
        raise MotionError(
            f"vertical has {vertical.acceleration.size} samples, but must have the {motion.acceleration.size} of the "
            "horizontal component; cut or resample it first.",
            vertical=vertical,
        )
    if abs(vertical.time_step - motion.time_step) > 1e-9 * motion.time_step:
        raise MotionError(
            f"vertical has a time step of {vertical.time_step!r} s, but must have the {motion.time_step!r} s of the "
            "horizontal component; resample it first.",
            vertical=vertical,
        )
    return _FORCINGS.of(motion, vertical)


def _curves(motion: Accelerogram) -> np.ndarray:
    """Return the curves (c, CURVE) through samples of every smooth stretch, by power of the time in it.

    None, (0, CURVE), where there is no stretch, or where one is farther than CURVE_ERROR from a sample between those.
    """
    stretch = motion.smooth_steps
    coefficients = min(CURVE, stretch - 1)
    if coefficients < 3 or (motion.acceleration.size - 1) % stretch:
        return np.empty((0, CURVE))
    count = (motion.acceleration.size - 1) // stretch

    def samples(places: np.ndarray) -> np.ndarray:
        return np.stack([motion.acceleration[place:][::stretch][:count] for place in places])

    # Close together at both ends, as Chebyshev's: what is between them departs most in the middle between two.
    through = np.rint(stretch * (1 - np.cos(np.linspace(0, np.pi, coefficients))) / 2).astype(int)
    between = np.setdiff1d((through[1:] + through[:-1]) // 2, through)
    powers = np.linalg.inv(np.vander(through / stretch, increasing=True)) @ samples(through)
    there = np.vander(between / stretch, coefficients, increasing=True) @ powers
    if not np.abs(there - samples(between)).max() <= CURVE_ERROR * motion.peak_acceleration:
        return np.empty((0, CURVE))
    curves = np.zeros((count, CURVE))
    curves[:, :coefficients] = powers.T / (stretch * motion.time_step) ** np.arange(coefficients)
    return curves


@lru_cache(maxsize=64)
def _of_pulse(pulse: Pulse) -> Forcing:
    still = _still(1)
    ground = GroundSamples(
        horizontal=_read_only(np.array([pulse.amplitude])),
        vertical=still,
        strongest=_read_only(np.array([abs(pulse.amplitude)])),
        lightest=still,
        time_step=pulse.period,
        circular_frequency=pulse.circular_frequency,
        gravity=GRAVITY,
    )
    return _forcing(ground, pulse.start_time, vertical=False)


def _of_record(record: Accelerogram, vertical: Accelerogram | None) -> Forcing:
    """What the kernel takes of a record: its samples themselves, and what is found from them."""
    size = record.acceleration.size
    lift = _still(size) if vertical is None else vertical.acceleration
    curves = _curves(record)
    stretch = record.smooth_steps if curves.size else 1
    largest = np.abs(record.acceleration)
    if stretch > 1:
        largest = np.append(largest[:-1].reshape(-1, stretch).max(axis=1), largest[-1])
    ground = GroundSamples(
        horizontal=record.acceleration,
        vertical=lift,
        strongest=_read_only(np.maximum.accumulate(largest[::-1])[::-1].copy()),
        lightest=lift if vertical is None else _lightest(vertical),
        time_step=record.time_step,
        circular_frequency=0.0,
        gravity=GRAVITY,
        curves=curves,
        stretch=stretch,
    )
    return _forcing(ground, 0.0, vertical is not None)


def _forcing(ground: GroundSamples, start_time: float, vertical: bool) -> Forcing:
    least = GRAVITY + float(ground.lightest[0])
    return Forcing(
        ground,
        start_time=start_time,
        vertical=vertical,
        weightless=least < 0,
        excitation=float(ground.strongest[0] / least) if least > 0 else math.inf,
    )


def _read_only(array: np.ndarray) -> np.ndarray:
    """The array as a record's own samples are: the kernel is compiled once more for one that can be written to."""
    array.flags.writeable = False
    return array


@lru_cache(maxsize=2)
def _still(size: int) -> np.ndarray:
    """No vertical motion, (size,), the same for all motions of a record."""
    return _read_only(np.zeros(size))


_LIGHTEST: WeakKeyDictionary[Accelerogram, np.ndarray] = WeakKeyDictionary()


def _lightest(vertical: Accelerogram) -> np.ndarray:
    """The smallest ü_v from each sample to the end, (n,), the same for all directions and processings."""
    if vertical not in _LIGHTEST:
        lightest = np.minimum.accumulate(vertical.acceleration[::-1])[::-1].copy()
        _LIGHTEST[vertical] = _read_only(lightest)
    return _LIGHTEST[vertical]


class _Forcings:
    """The forcings of records that were made last, as long as the records live and FORCING_BYTES hold them."""

    def __init__(self) -> None:
        self._kept: dict[ref[Accelerogram], dict[int, Forcing]] = {}
        self._bytes = 0
        self._lock = RLock()  # which what forgets a record may find its own thread to hold

    def of(self, record: Accelerogram, vertical: Accelerogram | None) -> Forcing:
        """Return that of a record with its vertical component."""
        # A forcing holds these samples, so that no others have their place while it is kept.
        place = 0 if vertical is None else id(vertical.acceleration)
        found = self._kept.get(ref(record), {}).get(place)
        if found is not None:
            return found
        made = _of_record(record, vertical)
        with self._lock:
            self._kept.setdefault(ref(record, self._forget), {})[place] = made
            self._bytes += made.own_bytes
            while self._bytes > FORCING_BYTES:
                self._forget(next(iter(self._kept)))
        return made

    def _forget(self, record: "ref[Accelerogram]") -> None:
        with self._lock:
            self._bytes -= sum(kept.own_bytes for kept in self._kept.pop(record, {}).values())


_FORCINGS = _Forcings()


_NEAR = 1 / 64
"""Share of the arc of φ_cr within which a chain of impacts is looked at as a whole."""

_STILL = 0.1
"""A tie whose point moves less, in m, is as accurate as one that moves so far: its motion is a difference of lengths,
rounded as they are, and nothing is left of it where the point stands still, as the top of a wall that a floor holds."""

_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(40)


@dataclass(frozen=True, eq=False, kw_only=True)
class SideTable:
    """One side, in two zones of equal pieces: an inner one up to 2 φ_cr, and an outer one up to the end.

    kernel: what the kernel takes of it, an array of one side each. rotation_map: φ of the arc; None where φ = q. Ties
    that are kept apart are not in G̃, nor in what follows from it.
    """

    kernel: Sides
    restitution: float
    critical_rotation: float
    rotation_map: RotationMap | None

    @property
    def end(self) -> float:
        """The arc at which the table ends."""
        return float(self.kernel.end[0])

    def arc(self, rotation: float) -> float:
        """Return the arc at one rotation [rad]; that of the end beyond it."""
        return rotation if self.rotation_map is None else self.rotation_map.arc(rotation)

    def rotation(self, arcs: np.ndarray) -> np.ndarray:
        """Return the rotation [rad] at `arcs`, any shape; inf beyond the end of the rotation_map."""
        return arcs if self.rotation_map is None else self.rotation_map.rotation(arcs)

    def rotation_ratio(self, arc: float) -> float:
        """Return φ/φ_cr of one arc."""
        rotation = arc if self.rotation_map is None else self.rotation_map.rotation_at(arc)
        return rotation / self.critical_rotation

    def rotation_ratios(self, arcs: np.ndarray) -> np.ndarray:
        """The same of many, any shape."""
        return self.rotation(arcs) / self.critical_rotation

    def slope(self, arcs: np.ndarray) -> np.ndarray:
        """Return dφ/dq at `arcs`, any shape."""
        return np.ones_like(arcs) if self.rotation_map is None else self.rotation_map.slope(arcs)


def linear_side(block: EquivalentBlock) -> SideTable:
    """Return the table of one side of an equivalent block: exact, and endless unless its rotation_map ends."""
    square = block.frequency_parameter**2 / GRAVITY
    critical = block.critical_arc
    scale = critical / block.uplift_multiplier
    width = critical / 8
    count = 513  # the last one is the outer zone, which has no end
    starts = np.arange(count) * width
    pieces = np.zeros((count, 2 * DEGREE + 2))
    pieces[:, 0] = square * (critical - starts - width / 2)
    pieces[:, 1] = square * scale
    pieces[:, 2] = -square
    near = np.array([[critical, (1 - _NEAR) * critical], [scale, scale]]) * square
    kernel = _kernel(
        pieces=pieces,
        grid=(starts[-1], width, count - 1, np.inf, width, 1, np.inf, 1 / width, 1 / width),
        lift=(square * critical, square * scale),
        hold=(starts - critical) / scale,
        critical=critical,
        end=np.inf if block.rotation_map is None else block.rotation_map.end,
        rest_speed=block.velocity_scale * runs.REST_ENERGY**0.5,
        longest_step=1 / block.frequency_parameter,
        near=(*_near_rest(critical * _NEAR, near), 0.0),
    )
    return SideTable(
        kernel=kernel,
        restitution=block.restitution,
        critical_rotation=block.critical_rotation,
        rotation_map=block.rotation_map,
    )


def _kinked_side(side: Side) -> SideTable:
    """Return the table of a side whose G runs straight from kink to kink, with constant I and B: exact.

    Beyond φ_cr, where G goes on as it comes, further pieces give the acceleration of the ground that brings the side
    back.
    """
    critical = side.critical_rotation
    further = np.linspace(critical, side.end_rotation, 65)
    starts = np.array([0.0, *(kink for kink in side.kinks if kink < critical), *further[:-1]])
    ends = np.append(starts[1:], side.end_rotation)
    inertia = side.at("inertia", 0.0)
    push = side.at("ground", 0.0) / inertia
    gravity = side.gravity(starts) / inertia
    slopes = (side.gravity(ends) / inertia - gravity) / (ends - starts)
    pieces = np.zeros((starts.size, 2 * DEGREE + 2))
    pieces[:, 0] = gravity
    pieces[:, 1] = push
    pieces[:, 2] = slopes
    reach = min(_NEAR * critical, ends[0])
    near = np.array([gravity[0] + slopes[0] * np.array([0.0, reach]), [push, push]])
    kernel = _kernel(
        kinks=np.append(starts, np.inf)[None],
        pieces=pieces,
        grid=(0.0,) * 9,
        lift=(gravity[0], push),
        hold=-gravity
        / push,  # of falling G the least at the start of each piece; it is needed beyond φ_cr alone
        critical=critical,
        end=side.end_rotation,
        rest_speed=_reaching_speed(side, inertia) * runs.REST_ENERGY**0.5,
        longest_step=1 / np.sqrt(GRAVITY * max(np.abs(slopes).max(), gravity[0] / critical)),
        near=(*_near_rest(reach, near), 0.0),
    )
    return SideTable(
        kernel=kernel, restitution=side.restitution, critical_rotation=critical, rotation_map=None
    )


def _kernel(
    ties: Ties | None = None,
    kinks: np.ndarray | None = None,
    **values: np.ndarray | float | tuple[float, ...],
) -> Sides:
    """The Sides of one side."""
    arrays = {name: np.array([value], dtype=float) for name, value in values.items()}
    return Sides(**arrays, one_sided=False, ties=ties, kinks=kinks)


def side_table(side: Side, apart: bool) -> SideTable:
    """Return the table of a side, up to where it can be tabulated. apart: keep its ties apart from G.

    Raises MotionError when it cannot be.
    """
    if side.kinks:
        return _kinked_side(side)
    try:
        arc, inverse = side.arc
    except StructureError as error:
        raise MotionError(str(error)) from None
    for cut in CUTS:
        last = side.end_rotation - cut * (side.end_rotation - side.critical_rotation)
        if last <= arc.last:
            with np.errstate(all="ignore"):
                table = _tabulated(side, arc, inverse, last, apart)
            if table is not None:
                return table
    raise MotionError(
        f"the mechanism's functions cannot be tabulated to {ACCURACY:g} of their maximum up to a rotation of "
        f"{last!r} rad; they must be smooth up to there.",
        mechanism=last,
    )


def _tabulated(side: Side, arc: Arc, inverse: RotationMap, last: float, apart: bool) -> SideTable | None:
    """The table over the rotations up to `last`, ties apart or not, or None where it does not reach ACCURACY."""
    gravity = side.untied_gravity if apart and side.untied_gravity is not None else side.gravity
    ties = side.ties if apart else ()
    rest = side.at("inertia", 0.0)

    def rotation_at(arcs: np.ndarray) -> np.ndarray:
        """The rotation; the last of equal pieces may end a rounding error beyond the map."""
        return inverse.rotation(np.minimum(arcs, inverse.end))

    def functions(arcs: np.ndarray) -> np.ndarray:
        """(2 + 3 n, ...) G̃, B̃, and D̃, u D̃ and u of the n ties that are apart."""
        rotation = rotation_at(arcs)
        scale = np.sqrt(side.inertia(rotation) * rest)
        values = [gravity(rotation) / scale, side.ground(rotation) / scale]
        for tie in ties:
            stretch = tie.stretch(rotation)
            pull = tie.stretch_slope(rotation) / scale
            values += [pull, stretch * pull, stretch]
        return np.stack(values)

    end = float(arc.at(last))
    critical = float(arc.at(side.critical_rotation))
    split = min(2 * critical, (critical + end) / 2)
    largest = np.abs(functions(np.linspace(end / 1000, end, 1000))).max(axis=1)
    least = np.array([0.0] * 2 + [_STILL / rest, _STILL**2 / rest, _STILL] * len(ties))
    inner = fitted(functions, 0.0, split, largest, least)
    outer = fitted(functions, split, end, largest, least)
    if inner is None or outer is None:
        return None
    powers = np.concatenate([inner, outer], axis=1)
    widths = split / inner.shape[1], (end - split) / outer.shape[1]
    starts = np.concatenate(
        [np.arange(inner.shape[1]) * widths[0], split + np.arange(outer.shape[1] + 1) * widths[1]]
    )
    zones = (widths[0], inner.shape[1], ROOM * widths[0], widths[1], outer.shape[1], ROOM * widths[1])
    lift = float(gravity(np.asarray(0.0))) / rest, side.at("ground", 0.0) / rest
    near = functions(np.linspace(0, critical * _NEAR, 65))[:2]
    if apart:  # the steepest G̃ up to φ_cr, where it has ties no longer its own slope there
        slopes = np.gradient(functions(np.linspace(critical / 512, critical, 512))[0])
        steepest = float(np.abs(slopes).max() * 512 / critical)
    else:
        steepest = -side.at("gravity_slope", side.critical_rotation) / side.at(
            "inertia", side.critical_rotation
        )
    kernel = _kernel(
        ties=_ties(side, arc, powers[2:]) if ties else None,
        pieces=powers[:2].transpose(1, 2, 0).reshape(powers.shape[1], -1),
        grid=(split, *zones, 1 / widths[0], 1 / widths[1]),
        lift=lift,
        hold=_hold(gravity, side.ground, rotation_at, starts),
        critical=_first_unrestored(gravity, rotation_at, critical) if apart else critical,
        end=end,
        rest_speed=_reaching_speed(side, rest) * runs.REST_ENERGY**0.5,
        longest_step=1 / np.sqrt(GRAVITY * max(steepest, lift[0] / critical)),
        near=(
            *_near_rest(critical * _NEAR, near),
            sum(_slope_near_rest(side, tie, arc, critical * _NEAR) for tie in ties),
        ),
    )
    return SideTable(
        kernel=kernel,
        restitution=side.restitution,
        critical_rotation=side.critical_rotation,
        rotation_map=inverse,
    )


def _ties(side: Side, arc: Arc, powers: np.ndarray) -> Ties:
    """The ties of one side, from the polynomials (3 n, m, 8) of D̃, u D̃ and u of each."""
    count = powers.shape[0] // 3
    pieces = powers.shape[1]
    pulls, stretch = np.split(powers.reshape(count, 3, pieces, DEGREE + 1), [2], axis=1)
    pulls = pulls.transpose(0, 2, 3, 1).reshape(count, pieces, -1)
    laws = []
    rotations = np.linspace(0.0, arc.last, 129)
    for tie in side.ties:
        law = tie.tie
        ends = [tie.rotation(stretch, arc.last) for stretch in (law.yield_stretch, law.rupture_stretch)]
        yields, breaks = (float(arc.at(rotation)) if rotation < np.inf else np.inf for rotation in ends)
        stiffest = float(np.max(tie.stretch_slope(rotations) ** 2 / side.inertia(rotations)))
        forces = GRAVITY * law.stiffness, GRAVITY * law.pretension, GRAVITY * law.strength
        at_rest = float(tie.stretch_slope(np.asarray(0.0))) / side.at("inertia", 0.0)
        laws.append((*forces, law.yield_stretch, yields, breaks, forces[0] * stiffest, at_rest))
    return Ties(np.concatenate([pulls, stretch[:, 0]], axis=2), np.array(laws)[None])


def _first_unrestored(gravity: Function, rotation: Function, critical: float) -> float:
    """An arc up to `critical` below which `gravity` restores."""
    arcs = np.linspace(0.0, critical, 513)
    falls = np.flatnonzero(gravity(rotation(arcs)) <= 0)
    return float(arcs[max(falls[0] - 1, 0)]) if falls.size else critical


def _reaching_speed(side: Side, rest_inertia: float) -> float:
    """√(2 g ∫ G dφ / I(0)) from 0 to φ_cr, on the way out."""
    work = np.zeros(())
    for start, end in pairwise([0.0, *side.bends, side.critical_rotation]):
        half = (end - start) / 2
        work = work + 2 * GRAVITY * half * (_WEIGHTS @ side.gravity(start + half * (_GAUSS + 1)))
    return float(np.sqrt(work / rest_inertia))


def _near_rest(reach: float, values: np.ndarray) -> tuple[float, ...]:
    """Bounds of G̃ and B̃ (2, n), taken at equal distances over the arcs [0, reach]; see `Sides`.

    Widened by the largest change between neighbouring samples, and slopes by half, for what lies between samples.
    """
    gravity, ground = values
    gravity_change, ground_change = np.abs(np.diff(values, axis=1)).max(axis=1)
    least_gravity = gravity.min() - gravity_change
    largest_gravity = gravity.max() + gravity_change
    largest_ground = np.abs(ground).max() + ground_change

    intervals = values.shape[1] - 1
    gravity_slope = 1.5 * gravity_change * intervals / reach
    ground_slope = 1.5 * ground_change * intervals / reach

    # v²/2 = g G̃ q: over still ground a slower start turns back within the arc, by the least G̃ that it meets.
    speed = np.sqrt(2 * GRAVITY * max(least_gravity, 0.0) * reach)
    bounds = (reach, least_gravity, largest_gravity, largest_ground, gravity_slope, ground_slope, speed)
    return tuple(float(bound) for bound in bounds)


def _hold(gravity: Function, ground: Function, rotation: Function, starts: np.ndarray) -> np.ndarray:
    """(m,) smallest −G/|B| from each piece on, lowered by the largest change between neighbouring samples."""
    widths = np.diff(starts)
    arcs = starts[:-1, None] + widths[:, None] * np.linspace(0, 1, 9)
    rotations = rotation(arcs)
    push = np.maximum(np.abs(ground(rotations)), 1e-300)
    balance = -gravity(rotations) / push
    changes = np.abs(np.diff(balance, axis=1)).max(axis=1)
    lowest = balance.min(axis=1) - changes
    # The smallest of each piece and of all after it.
    return np.minimum.accumulate(lowest[::-1])[::-1]


def _slope_near_rest(side: Side, tie: SideTie, arc: Arc, reach: float) -> float:
    """Return a bound of |d(T D̃)/dq| at arcs up to `reach`, from equal steps and widened for those between."""
    inertia_at_rest = side.at("inertia", 0.0)
    rotations = arc.rotation(np.linspace(0.0, reach, 65))
    pull = tie.stretch_slope(rotations) / np.sqrt(side.inertia(rotations) * inertia_at_rest)
    stretch = tie.stretch(rotations)
    largest_force = tie.tie.pretension + tie.tie.stiffness * stretch[-1]

    intervals = rotations.size - 1
    steepest_stretch = np.abs(np.diff(stretch)).max() * intervals / reach
    steepest_pull = np.abs(np.diff(pull)).max() * intervals / reach
    # The product rule: T' D̃ + T D̃'.
    slope = tie.tie.stiffness * steepest_stretch * np.abs(pull).max() + largest_force * steepest_pull
    return float(1.5 * GRAVITY * slope)


DEGREE = 7
ACCURACY = 1e-12
"""Largest error of a table, relative to the largest magnitude of the quantity."""

ROOM = 0.25
"""A piece is accurate up to this share of its width beyond its ends; a step goes no further."""

AIM = 2e-14
"""Error at which no more pieces are made, relative likewise."""

_FEWEST_PIECES = 8
"""Hardly a zone needs fewer."""

_MOST_PIECES = 4096
_NODES = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
_PROBES = np.linspace(-0.99, 0.99, 16)


def fitted(
    functions: Function,
    start: float,
    end: float,
    largest: np.ndarray,
    least: np.ndarray | float,
) -> np.ndarray | None:
    """Polynomials (f, m, 8) of f functions on m equal pieces of [start, end], good to ROOM beyond its ends, or None.

    Pieces are halved, as often at once as the order of the error, DEGREE + 1, says is needed, until the error is
    AIM of the zone's own maximum, or no longer falls because it is the rounding of the functions themselves; it must
    then be within ACCURACY of `largest` (f,), the maxima over the whole side. Maxima below `least` (f,) count as that.
    """
    best = None
    best_error = np.inf
    good = False
    count = _FEWEST_PIECES
    while count <= _MOST_PIECES:
        powers, errors, zone = _fit(functions, start, end, count)
        if not np.all(np.isfinite(errors)):
            return None
        error = (errors / np.maximum(zone, least)).max()
        if error < best_error:
            best = powers
            best_error = error
            good = bool(np.all(errors <= ACCURACY * np.maximum(largest, least)))
        elif good:
            break
        if best_error <= AIM:
            break
        count <<= max(1, round(np.log2(error / AIM) / (DEGREE + 1)))
    return best if good else None


def _fit(
    functions: Function, start: float, end: float, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Interpolate on `count` pieces; also the largest error between the nodes, and the largest value, (f,) each."""
    half = (end - start) / count / 2
    centres = start + (2 * np.arange(count)[:, None] + 1) * half

    # In half widths from its centre each piece reaches ROOM beyond its ends, but not beyond the zone.
    low = np.maximum(start - centres, -(1 + 2 * ROOM) * half) / half
    high = np.minimum(end - centres, (1 + 2 * ROOM) * half) / half
    middle = (low + high) / 2
    reach = (high - low) / 2
    places = middle + reach * _NODES
    probes = middle + reach * _PROBES
    everywhere = functions(centres + half * np.concatenate([places, probes], axis=1))
    values = everywhere[..., : _NODES.size]
    between = everywhere[..., _NODES.size :]

    powers = np.linalg.solve(polyvander(places, DEGREE), np.moveaxis(values, 0, -1))
    powers = np.moveaxis(powers, -1, 0)
    fit = np.einsum("fmp,mqp->fmq", powers, polyvander(probes, DEGREE))
    errors = np.abs(fit - between).max(axis=(1, 2))
    return powers / half ** np.arange(DEGREE + 1), errors, np.abs(values).max(axis=(1, 2))


@dataclass(frozen=True, eq=False)
class MechanismTable:
    """The sides of a mechanism (positive first; one if they mirror), and stacked what the kernel takes of them."""

    sides: tuple[SideTable, ...]
    kernel: Sides


_REMEMBERED: WeakKeyDictionary[Mechanism, dict[bool, MechanismTable]] = WeakKeyDictionary()


def table_of(mechanism: Mechanism | EquivalentBlock, vertical: bool = False) -> MechanismTable:
    """Return the table of a mechanism, remembered as long as the mechanism lives, or of an equivalent block.

    vertical: for a vertical component, with which ties do not grow and fall. Ties are then kept apart from G, as they
    are where they yield or break.
    Raises MotionError when it cannot be tabulated.
    """
    if isinstance(mechanism, EquivalentBlock):
        return linear_table(mechanism)
    apart = mechanism.remembers or (vertical and mechanism.tied)
    tables = _REMEMBERED.setdefault(mechanism, {})
    if apart not in tables:
        tables[apart] = _stacked(
            tuple(side_table(side, apart) for side in mechanism.sides), mechanism.one_sided
        )
    return tables[apart]


@lru_cache(maxsize=1024)
def linear_table(block: EquivalentBlock) -> MechanismTable:
    """Return the table of an equivalent block: exact, and without an end unless its rotation_map has one."""
    return _stacked(tuple(linear_side(side) for side in block.sides), block.one_sided)


def _stacked(sides: tuple[SideTable, ...], one_sided: bool) -> MechanismTable:
    most = max(side.kernel.hold.shape[1] for side in sides)
    arrays = {}
    for name in set(Sides._fields) - {"one_sided", "ties", "kinks"}:
        rows = [getattr(side.kernel, name) for side in sides]
        if name in ("pieces", "hold"):  # the shorter table is filled up with zeros
            rows = [
                np.pad(row, [(0, 0), (0, most - row.shape[1])] + [(0, 0)] * (row.ndim - 2)) for row in rows
            ]
        arrays[name] = np.concatenate(rows)
    kernel = Sides(
        **arrays,
        one_sided=one_sided,
        ties=stacked_ties([side.kernel.ties for side in sides], most),
        kinks=sides[0].kernel.kinks,  # a mechanism with kinks has one side
    )
    return MechanismTable(sides, kernel)


def stacked_ties(sides: Sequence[Ties | None], pieces: int) -> Ties | None:
    """Return the ties of one side or two with as many pieces each; a tie that one side lacks has no force there."""
    count = max((ties.law.shape[1] for ties in sides if ties is not None), default=0)
    if not count:
        return None
    pieces_of = np.zeros((len(sides) * count, pieces, 24))
    law = np.zeros((len(sides), count, 8))
    law[:, :, 2:6] = np.inf
    for k, ties in enumerate(sides):
        if ties is not None:
            own = ties.law.shape[1]
            pieces_of[k * count : k * count + own, : ties.pieces.shape[1]] = ties.pieces
            law[k, :own] = ties.law[0]
    return Ties(pieces_of, law)
