"""A block on a moving base by LMGC90 (non-smooth contact dynamics): one case from standard input, its answer as JSON.

The shock law is inelastic (IQS_CLB) with more friction than the block needs, so that an impact keeps what Housner's
balance of angular momentum keeps. The method is of first order: three time steps are run and extrapolated.
"""

import json
import math
import sys
import time

import numpy as np

from rocking.calibration.comparison.extrapolation import limit_of

STEPS = (2e-3, 1e-3, 5e-4)
"""Time steps, s."""
FRICTION = 5.0
STILL = 6.0
"""How long still ground is followed, in units of 1/p."""
_FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def answer(given: dict) -> dict:
    """Return rotation_ratio, error_bar and duration of a case."""
    start = time.process_time()
    ratios = [_largest(given, step) for step in STEPS]
    spent = time.process_time() - start
    ratio, bar = limit_of(ratios)
    reason = "" if not math.isnan(ratio) else "The verdict depends on the time step."
    return {"rotation_ratio": ratio, "error_bar": bar, "duration": spent, "reason": reason}


def _largest(given: dict, step: float) -> float:
    from compas_lmgc90.solver import Solver

    breadth, height, critical = given["breadth"], given["height"], given["critical_rotation"]
    solver = Solver(dt=step, theta=0.5, density=2000.0)
    solver.geometry_from_v_f(
        [_box(-5 * breadth, 5 * breadth, -0.5, 0.0), _box(-breadth / 2, breadth / 2, 0, height)]
    )
    times, speed = _base(given, step)
    for component in ("Vy", "Vz", "Rx", "Ry", "Rz"):
        solver.apply_velocity(0, component, 0.0)
    solver.apply_velocity(0, "Vx", np.array([[*times, times[-1] + 1], [*speed, speed[-1]]]))
    solver.contact_law("IQS_CLB", FRICTION, alert=1e-2)
    solver.preprocess()
    largest = 0.0
    for _ in range(times.size - 1):
        frame = np.array(solver.lmgc90.compute_one_step().body_frames[1]).reshape(3, 3)
        largest = max(largest, abs(math.atan2(frame[0, 2], frame[0, 0])))
        if largest > 1.2:
            break
    solver.finalize()
    return math.inf if largest > 1.2 else largest / critical


def _base(given: dict, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Times and velocity of the base, the acceleration linear between its samples."""
    acceleration, sample = np.array(given["acceleration"]), given["time_step"]
    velocity = np.concatenate([[0.0], np.cumsum((acceleration[1:] + acceleration[:-1]) / 2 * sample)])
    end = (acceleration.size - 1) * sample + STILL / given["frequency_parameter"]
    times = np.arange(int(end / step) + 2) * step
    place = np.minimum((times / sample).astype(int), acceleration.size - 2)
    inside = np.minimum(times - place * sample, sample)
    slope = (acceleration[place + 1] - acceleration[place]) / sample
    return times, velocity[place] + inside * (acceleration[place] + slope * inside / 2)


def _box(left: float, right: float, low: float, high: float) -> dict:
    corners = [[x, y, z] for x in (left, right) for y in (-0.5, 0.5) for z in (low, high)]
    return {"vertices": corners, "faces": _FACES}


if __name__ == "__main__":
    print("\n" + json.dumps(answer(json.load(sys.stdin))))
