"""A rigid block that rocks on a linear support and pushes back, by Runge–Kutta of fixed steps, many cases at once.

Written from the momenta of the two bodies. It shares nothing with the package: neither the filter, for the support is a
state of its own here, nor the kernel.
"""

from dataclasses import dataclass

import numpy as np

G = 9.80665


@dataclass(frozen=True)
class Cases:
    """One array each, (m,), of blocks, their supports, and a factor on the ground's motion."""

    semi_diagonal: np.ndarray
    slenderness: np.ndarray
    restitution: np.ndarray
    period: np.ndarray
    damping: np.ndarray
    mass_ratio: np.ndarray
    factor: np.ndarray


def largest_rotations(cases, ground, time_step, seconds, step=5e-4):
    """Largest |rotation| over slenderness, (m,); inf overturns. ground: (n,) m/s², linear between its samples."""
    R, alpha, mu = cases.semi_diagonal, cases.slenderness, cases.mass_ratio
    omega = 2 * np.pi / cases.period
    times = np.arange(ground.size + 1) * time_step
    whole = np.append(ground, 0.0)

    def rates(t, state, side):
        """side: 0 at rest on the support, else the sign of the rotation."""
        theta, spin, drift, speed = state
        a = cases.factor * np.interp(t, times, whole, right=0.0)
        # Centre of mass from the corner: x = −s R sin(α − s θ), z = R cos(α − s θ); x' = R cos(…) θ', and so on.
        angle = alpha - side * theta
        lever, height = side * R * np.sin(angle), R * np.cos(angle)
        own = -(omega**2) * drift - 2 * cases.damping * omega * speed  # of the support, per its mass
        # Support: A = own − μ (A + x''), block: 4/3 R² θ'' = −G lever − height A, x'' = height θ'' + lever θ'².
        moved = side != 0
        flow = lever * spin**2
        inertia = 4 / 3 * R**2
        carried = 1 + mu - mu * height**2 / inertia * moved
        total = (own + mu * moved * (height * G * lever / inertia - flow)) / carried
        turning = np.where(moved, (-G * lever - height * total) / inertia, 0.0)
        return np.array([spin * moved, turning, speed, total - a]), total

    def advanced(t, state, side, h):
        one, _ = rates(t, state, side)
        two, _ = rates(t + h / 2, state + h / 2 * one, side)
        three, _ = rates(t + h / 2, state + h / 2 * two, side)
        four, _ = rates(t + h, state + h * three, side)
        return state + h / 6 * (one + 2 * two + 2 * three + four)

    state = np.zeros((4, R.size))
    side = np.zeros(R.size)
    largest = np.zeros(R.size)
    for k in range(round(seconds / step)):
        t = k * step
        _, felt = rates(t, state, side)
        lifts = (side == 0) & (np.abs(felt) > G * np.tan(alpha))
        side = np.where(lifts, -np.sign(felt), side)
        new = advanced(t, state, side, step)
        struck = (side != 0) & (side * new[0] < 0)
        if struck.any():
            new, side = _impact(advanced, cases, t, state, new, side, struck, step)
        state = new
        largest = np.maximum(largest, np.abs(state[0]) / alpha)
        fallen = np.abs(state[0]) > 1.5
        state[:2, fallen], side[fallen], largest[fallen] = 0.0, 0.0, np.inf
    return np.where(largest > 1, np.inf, largest)


def _impact(advanced, cases, t, state, new, side, struck, step):
    low, high = np.zeros(struck.size), np.full(struck.size, step)
    for _ in range(30):  # halving, to a billionth of a step
        middle = (low + high) / 2
        past = side * advanced(t, state, side, middle)[0] < 0
        low, high = np.where(past, low, middle), np.where(past, middle, high)
    before = advanced(t, state, side, high)
    after = before.copy()
    after[0] = 0.0
    after[1] = cases.restitution * before[1]
    # Horizontal momentum of both bodies is kept; the centre of mass has the height R cos α over both corners.
    height = cases.semi_diagonal * np.cos(cases.slenderness)
    after[3] = before[3] + cases.mass_ratio / (1 + cases.mass_ratio) * height * (before[1] - after[1])
    turned = np.where(struck, -side, side)
    rest = struck & (np.abs(after[1]) < 1e-3)  # turns it by less than 1e-5 of its slenderness any more
    turned = np.where(rest, 0.0, turned)
    after[1] = np.where(rest, 0.0, after[1])
    on = advanced(t + high, after, turned, step - high)
    return np.where(struck, on, new), turned
