"""Rigid bodies on a moving base by LMGC90 (non-smooth contact dynamics): a case from standard input, answered in JSON.

The shock law is inelastic (IQS_CLB) with more friction than the bodies need, so that an impact keeps what the balance
of angular momentum keeps. The method is of first order: three time steps are run and extrapolated.
"""

import math
from collections.abc import Sequence

import numpy as np
from scipy.integrate import cumulative_trapezoid

from docs.research.comparison.bodies import RigidBodies, rigid_bodies
from docs.research.comparison.codes import (
    STILL,
    Answer,
    Question,
    StructureQuestion,
    landings,
    run_of,
    serve,
    still_from,
    structures,
)
from rocking.contacts.kernel import ALERT
from rocking.quantities import GRAVITY
from rocking.structures.stack import ROUGH

STEPS = (2e-3, 1e-3, 5e-4)
"""Time steps, s."""
FALLEN = 6.0
"""Turn of a body, in critical rotations, from which nothing comes back."""


def run(case: StructureQuestion, step: float) -> Answer:
    """Return the run of a case with a time step."""
    bodies = rigid_bodies(structures()[case["structure"]])
    times, turns, centres = follow(case, bodies, step)
    rotation, critical = bodies.rotation(turns), case["critical_rotation"]
    largest = int(np.abs(rotation).argmax())
    if np.abs(turns[-1]).max() > FALLEN * critical:
        return Answer(math.inf, landings=landings(times, rotation))
    # Energy relative to the ground, per density and thickness, from differences over two steps.
    masses, _, gyrations = bodies.properties
    masses = masses.copy()
    masses[list(bodies.driven)] = 0.0
    moved = centres - centres[:, bodies.driven[:1]]
    velocity, spin = np.gradient(moved, times, axis=0), np.gradient(turns, times, axis=0)
    moving = ((velocity**2).sum(axis=2) + gyrations * spin**2) @ masses / 2
    energy = moving + GRAVITY * (centres[:, :, 1] - centres[0, :, 1]) @ masses
    return run_of(case, times, rotation, energy, bodies.outside_hinges(turns[largest]))


def follow(
    case: Question, bodies: RigidBodies, step: float, friction: float = ROUGH
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times (n,), counterclockwise turns (n, bodies) and centres of mass (n, bodies, 2), until the end or a fall.

    friction: coefficient of every contact.
    """
    from compas_lmgc90.solver import Solver

    solver = Solver(dt=step, theta=0.5, density=2000.0)
    depths = bodies.depths or (1.0,) * len(bodies.polygons)
    solver.geometry_from_v_f(list(map(_prism, bodies.polygons, depths)))
    times, speed = base_speed(case, step)
    for body in (*bodies.driven, *bodies.guided):
        for component in ("Vy", "Vz", "Rx", "Ry", "Rz"):
            if component != "Vz" or body in bodies.driven:
                solver.apply_velocity(body, component, 0.0)
        solver.apply_velocity(body, "Vx", np.array([[*times, times[-1] + 1], [*speed, speed[-1]]]))
    solver.contact_law("IQS_CLB", friction, alert=ALERT)
    solver.preprocess()
    # LMGC90 turns the frame of a body into its principal axes before it starts.
    axes = np.array(solver.init_frame)
    fallen = FALLEN * case["critical_rotation"]
    # On still ground the energy only falls: what has turned little for a second stays up.
    second, still = round(1 / step), still_from(case) / step
    turns, centres = [np.zeros(len(bodies.polygons))], [np.array(solver.init_coor)]
    for _ in range(times.size - 1):
        state = solver.lmgc90.compute_one_step()
        turned = np.array(state.body_frames).reshape(-1, 3, 3).transpose(0, 2, 1) @ axes
        turns.append(np.arctan2(turned[:, 2, 0], turned[:, 0, 0]))
        centres.append(np.array(state.bodies))
        rests = len(turns) > still + second and np.abs(turns[-second:]).max() < case.get("settled", 0.0)
        if rests or np.abs(turns[-1]).max() > fallen:
            break
    solver.finalize()
    return times[: len(turns)], np.array(turns), np.array(centres)[:, :, [0, 2]]


def base_speed(case: Question, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Return times [s] and velocity [m/s] of the base (n,), the acceleration linear between its samples."""
    acceleration, sample = np.array(case["acceleration"]), case["time_step"]
    velocity = cumulative_trapezoid(acceleration, dx=sample, initial=0.0)
    end = still_from(case) + STILL / case["frequency_parameter"]
    times = np.arange(int(end / step) + 2) * step
    place = np.minimum((times / sample).astype(int), acceleration.size - 2)
    inside = np.minimum(times - place * sample, sample)
    slope = (acceleration[place + 1] - acceleration[place]) / sample
    return times, velocity[place] + inside * (acceleration[place] + slope * inside / 2)


def _prism(polygon: np.ndarray, depth: float) -> dict[str, Sequence[Sequence[float]]]:
    """The polygon as a body of some depth [m], its faces wound outwards."""
    count = len(polygon)
    corners = [[x, y, z] for y in (-depth / 2, depth / 2) for x, z in polygon.tolist()]
    ends = [list(range(count)), list(range(2 * count - 1, count - 1, -1))]
    sides = [[k, count + k, count + (k + 1) % count, (k + 1) % count] for k in range(count)]
    return {"vertices": corners, "faces": ends + sides}


if __name__ == "__main__":
    serve(run, STEPS, "The verdict depends on the time step.")
