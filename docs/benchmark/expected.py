"""The expected values of the benchmark, by numpy and scipy alone: `python expected.py` prints them as a CSV.

No code of any rocking program is used. Every case is derived as its row of cases.csv says: by a formula, by quadrature
of the energy, by limit analysis as a linear program, or by Runge-Kutta steps whose impacts and turns are found by
bisection, at steps so short that half of them change nothing within the tolerance.
"""

import csv
import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, linprog

HERE = Path(__file__).parent
GRAVITY = 9.80665
BREADTH, HEIGHT = 0.6, 3.0
"""The block of most cases, m."""
RESTITUTION = 1 - 1.5 * BREADTH**2 / (BREADTH**2 + HEIGHT**2)
"""Its ratio of angular velocities after and before an impact, by the balance of momentum (Housner 1963)."""
TIME_STEP = 0.005
"""Of every motion, s."""
SUBSTEPS = 8
"""Runge-Kutta steps within one sample of a motion."""
STILL = 1e-9
"""Angular velocity after an impact below which rocking has ended, rad/s."""


def motion(name: str) -> np.ndarray:
    """Return the accelerations of motions/NAME.csv, (n,) m/s², at equal steps of 0.005 s."""
    return np.loadtxt(HERE / "motions" / f"{name}.csv", delimiter=",", skiprows=1)[:, 1]


@dataclass(frozen=True)
class Body:
    """I φ'' = −G(φ) (g + ü_v) − s B(φ) ü_g on the side s = ±1, φ ≥ 0; all per mass."""

    inertia: float
    gravity: Callable[[float], float]
    ground: Callable[[float], float]
    restitution: float
    one_sided: bool = False


def block(breadth: float, height: float, restitution: float, one_sided: bool = False) -> Body:
    """Return a homogeneous block: I = 4R²/3, G = R sin(α − φ), B = R cos(α − φ) (Housner 1963)."""
    radius = math.hypot(breadth, height) / 2
    slenderness = math.atan2(breadth, height)
    return Body(
        4 / 3 * radius**2,
        lambda rotation: radius * math.sin(slenderness - rotation),
        lambda rotation: radius * math.cos(slenderness - rotation),
        restitution,
        one_sided,
    )


@dataclass(frozen=True)
class Sample:
    """The ground between two samples: acceleration and gravity as they are at its begin, and how they change."""

    across: float
    across_rate: float
    weight: float
    weight_rate: float

    def at(self, time: float) -> tuple[float, float]:
        """Return ü_g and g + ü_v at a time since its begin."""
        return self.across + time * self.across_rate, self.weight + time * self.weight_rate


def samples(ground: np.ndarray, vertical: np.ndarray | None) -> Iterator[Sample]:
    """Yield a motion sample by sample, and 3 s of still ground."""
    still = np.zeros(int(3 / TIME_STEP))
    across = np.append(ground, still)
    weight = GRAVITY + (np.zeros(across.size) if vertical is None else np.append(vertical, still))
    for k in range(across.size - 1):
        rates = (across[k + 1] - across[k]) / TIME_STEP, (weight[k + 1] - weight[k]) / TIME_STEP
        yield Sample(across[k], rates[0], weight[k], rates[1])


def largest_rotation(
    body: Body, ground: np.ndarray, vertical: np.ndarray | None = None, substeps: int = SUBSTEPS
) -> float:
    """Return the largest |φ| [rad] under accelerations that are straight between samples; inf: it falls."""
    rotation, speed, side, largest = 0.0, 0.0, 0, 0.0
    for sample in samples(ground, vertical):
        time = 0.0
        while time < TIME_STEP - 1e-12:
            if side == 0:
                side, time = _uplift(body, sample, time)
                continue
            step = min(TIME_STEP / substeps, TIME_STEP - time)
            run = partial(_runge_kutta, body, sample, side, time, rotation, speed)
            after, pull = run(step)
            if after < 0:  # it lands within the step
                step = _bisected(lambda part, run=run: run(part)[0], step)
                rotation, speed = 0.0, -body.restitution * run(step)[1]
                side = side if body.one_sided else -side
                side = side if speed > STILL else 0
                time += max(step, 1e-12)
                continue
            if speed > 0 >= pull:  # it turns within the step
                turn = _bisected(lambda part, run=run: run(part)[1], step)
                largest = max(largest, run(turn)[0])
            rotation, speed = after, pull
            time += step
            if rotation > math.pi / 2:
                return math.inf
    return largest


def _uplift(body: Body, sample: Sample, time: float) -> tuple[int, float]:
    """The side to which it lifts within a sample from a time on, and when; 0 and its end where it does not lift."""
    onset = body.gravity(0.0) / body.ground(0.0)
    found = [(TIME_STEP, 0)]
    for side in (1,) if body.one_sided else (1, -1):
        first, last = (
            -side * across - onset * weight for across, weight in map(sample.at, (time, TIME_STEP))
        )
        if first > 0:
            return side, time
        if last > 0:
            found.append((time + (TIME_STEP - time) * first / (first - last), side))
    when, side = min(found)
    return side, when


def _runge_kutta(
    body: Body, sample: Sample, side: int, time: float, rotation: float, speed: float, step: float
) -> tuple[float, float]:
    """Rotation and angular velocity after one step of the classical method."""

    def acceleration(later: float, turned: float) -> float:
        across, weight = sample.at(time + later)
        return -(body.gravity(turned) * weight + side * body.ground(turned) * across) / body.inertia

    half = step / 2
    first = acceleration(0.0, rotation)
    second = acceleration(half, rotation + half * speed)
    third = acceleration(half, rotation + half * (speed + half * first))
    fourth = acceleration(step, rotation + step * (speed + half * second))
    after = rotation + step * (speed + step / 6 * (first + second + third))
    return after, speed + step / 6 * (first + 2 * second + 2 * third + fourth)


def _bisected(function: Callable[[float], float], high: float) -> float:
    """The place up to `high` at which a function changes its sign from + to −."""
    low = 0.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) > 0 else (low, middle)
    return high


def free_quarter() -> float:
    """θ'²/2 = (g R/I) (cos(α − θ_0) − cos(α − θ)); θ = θ_0 − s² takes the singular end away."""
    radius, slenderness = math.hypot(BREADTH, HEIGHT) / 2, math.atan2(BREADTH, HEIGHT)
    released = slenderness / 2
    square = 3 * GRAVITY / (4 * radius)

    def slowness(s: float) -> float:
        fallen = math.cos(slenderness - released) - math.cos(slenderness - released + s * s)
        return (
            2 * s / math.sqrt(2 * square * fallen)
            if s
            else 2 / math.sqrt(2 * square * math.sin(slenderness / 2))
        )

    return quad(slowness, 0.0, math.sqrt(released), epsabs=1e-13)[0]


def free_peak(restitution: float) -> float:
    """cos(α − θ_1) − cos α = η² (cos(α − θ_0) − cos α)."""
    slenderness = math.atan2(BREADTH, HEIGHT)
    raised = math.cos(slenderness / 2) - math.cos(slenderness)
    return slenderness - math.acos(math.cos(slenderness) + restitution**2 * raised)


def half_sine_threshold(frequency: float) -> float:
    """Return the amplitude over g α of a half sine, of `frequency` times p, that just overturns a slender block.

    x = φ/α − 1 obeys x'' = p² (x + A sin ωt) from the uplift at A sin ωt_0 = 1 on, with x = −1. What grows is
    z = x + x'/p, z' = p (z + A sin ωt): it overturns where z reaches 0 as the pulse ends (Makris and Roussos 2000).
    """

    def at_end(amplitude: float) -> float:
        start, end = math.asin(1 / amplitude), math.pi
        grown = quad(
            lambda angle: math.exp((end - angle) / frequency) * math.sin(angle), start, end, epsabs=1e-13
        )[0]
        return amplitude * grown / frequency - math.exp((end - start) / frequency)

    return brentq(at_end, 1.0, 50.0, xtol=1e-12)


def double_impulse(breadth: float, height: float, restitution: float) -> float:
    """Return the velocity V [m/s] from which on two opposite impulses overturn a block, the second as it lands.

    An impulse V of the ground gives a body that stands on one edge the angular momentum m R V cos α about it, so that
    it leaves with θ' = 3 V cos α/(4 R), as I = 4 m R²/3. It lands as fast, keeps e θ', and the second impulse adds θ'
    once more. It reaches its balance where I ((1 + e) θ')²/2 = m g R (1 − cos α): V = 4 R p √(2 (1 − cos α)) /
    (3 cos α (1 + e)), Nabeshima, Taniguchi, Kojima and Takewaki 2016, Frontiers in Built Environment.
    """
    radius = math.hypot(breadth, height) / 2
    slenderness = math.atan2(breadth, height)
    inertia = 4 / 3 * radius**2
    needed = math.sqrt(2 * GRAVITY * radius * (1 - math.cos(slenderness)) / inertia)
    each = radius * math.cos(slenderness) / inertia
    return needed / (each * (1 + restitution))


def arch_multiplier(radius: float, thickness: float, embrace: float, voussoirs: int) -> float:
    """The largest λ for which a line of thrust fits the joints, with compression in each."""
    angles = np.linspace(-embrace / 2, embrace / 2, voussoirs + 1)
    inner, outer = radius - thickness / 2, radius + thickness / 2
    centres, weights = [], []
    for start, end in pairwise(angles):
        half = (end - start) / 2
        weights.append(half * (outer**2 - inner**2))
        arm = 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2) * math.sin(half) / half
        middle = (start + end) / 2
        centres.append((arm * math.sin(middle), arm * math.cos(middle)))
    # Unknown: force (x, y) and moment about the origin that the left support exerts, and λ.
    rows = []
    for k, angle in enumerate(angles):
        across, up, moment = np.zeros(4), np.zeros(4), np.zeros(4)
        across[0] = up[1] = moment[2] = 1.0
        for weight, (_, y) in zip(weights[:k], centres[:k], strict=True):
            across[3] += weight
            moment[3] -= weight * y
        fixed = sum(weights[:k]), sum(w * x for w, (x, _) in zip(weights[:k], centres[:k], strict=True))
        normal = across * math.cos(angle) - up * math.sin(angle)
        normal_fixed = fixed[0] * math.sin(angle)
        for end, sign in ((inner, 1.0), (outer, -1.0)):
            # Moment about an end of the joint, of which both have one sign while the thrust passes between them.
            about = moment - end * (math.sin(angle) * up - math.cos(angle) * across)
            about_fixed = -fixed[1] + end * math.sin(angle) * fixed[0]
            rows.append((sign * about, -sign * about_fixed))
        rows.append((-normal, normal_fixed))
    matrix, limits = np.array([row for row, _ in rows]), np.array([limit for _, limit in rows])
    found = linprog([0, 0, 0, -1], matrix, limits, bounds=[(None, None)] * 3 + [(0, None)])
    return float(-found.fun)


def values() -> dict[str, float]:
    """Return the expected value of every case of cases.csv."""
    slenderness = math.atan2(BREADTH, HEIGHT)
    two_sided = block(BREADTH, HEIGHT, RESTITUTION)
    one_sided = block(BREADTH, HEIGHT, 0.7, one_sided=True)
    pulse, record, vertical = map(motion, ("pulse", "record", "vertical"))
    return {
        "free_quarter_period": free_quarter(),
        "free_first_peak": free_peak(RESTITUTION),
        "free_one_sided_first_peak": free_peak(0.7),
        "half_sine_threshold": half_sine_threshold(3.0),
        "double_impulse_threshold": double_impulse(BREADTH, HEIGHT, RESTITUTION),
        "pulse_two_sided": largest_rotation(two_sided, pulse) / slenderness,
        "pulse_one_sided": largest_rotation(one_sided, pulse) / slenderness,
        "record_two_sided": largest_rotation(two_sided, record) / slenderness,
        "record_one_sided": largest_rotation(one_sided, record) / slenderness,
        "record_vertical": largest_rotation(two_sided, record, vertical) / slenderness,
        # p² = 3 g/(4 R) (1 + 2γ)/(1 + 3γ) (Makris and Vassiliou 2013), with γ = 0.3
        "frame_frequency": math.sqrt(3 * GRAVITY / (4 * math.hypot(1.1, 8.0) / 2) * 1.6 / 1.9),
        "arch_multiplier": arch_multiplier(10.0, 1.05, math.radians(157.5), 7),
        # 4 t/h: the halves turn by 1 and −1, their weights rise by t/2 and 3 t/2 and move by h/4
        "wall_multiplier": 4 * 0.25 / 3.2,
        # 4 t/h (1 + 3/2 N/W), as what rests on the middle of the top rises by 3 t/2
        "loaded_wall_multiplier": 4 * 0.25 / 3.2 * (1 + 1.5 * 20e3 / (18e3 * 0.25 * 3.2)),
        # (W t/2 + F z)/(W h/2) about the outer edge of the foot
        "tied_facade_multiplier": (20e3 * 0.6 * 6.0 * 0.3 + 8e3 * 5.8) / (20e3 * 0.6 * 6.0 * 3.0),
        # the upper storey alone: t/h
        "two_storey_facade_multiplier": 0.25 / 3.0,
    }


if __name__ == "__main__":
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["case", "value"])
    table.writerows((case, f"{value:.10g}") for case, value in values().items())
