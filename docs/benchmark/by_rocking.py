"""The benchmark by the Python package rocking: `python by_rocking.py > answers/rocking.csv`."""

import csv
import math
import sys
from pathlib import Path

import numpy as np

import rocking
from rocking.codes.code_capacity import CodeCapacity

HERE = Path(__file__).parent


def motion(name: str) -> rocking.Accelerogram:
    """Return motions/NAME.csv."""
    return rocking.Accelerogram(
        np.loadtxt(HERE / "motions" / f"{name}.csv", delimiter=",", skiprows=1)[:, 1], 0.005
    )


def answers() -> dict[str, float]:
    """Return this package's answer to every case of cases.csv."""
    block = rocking.Block.of_size(breadth=0.6, height=3.0)
    one_sided = rocking.Block.of_size(0.6, 3.0, restitution=0.7, one_sided=True)
    pulse, record, vertical = map(motion, ("pulse", "record", "vertical"))
    still = rocking.Pulse(amplitude=1e-9, circular_frequency=60.0, start_time=0.0)

    def largest(
        structure: rocking.Block, shaking: rocking.Accelerogram, up: rocking.Accelerogram | None = None
    ) -> float:
        return rocking.integrate(structure, shaking, 1e-9, vertical=up).rotation_ratio

    def released(structure: rocking.Block) -> rocking.Response:
        half = structure.slenderness / 2
        return rocking.integrate(structure, still, 1e-12, history=True, initial_rotation=half)

    free = released(block)
    landing = int(np.argmax(np.asarray(free.rotation) <= 0))
    return {
        "free_quarter_period": float(free.times[landing]),
        "free_first_peak": _peak_after_landing(free),
        "free_one_sided_first_peak": _peak_after_landing(released(one_sided)),
        "half_sine_threshold": _threshold(),
        "double_impulse_threshold": 2 * double_impulse(block, 2000) - double_impulse(block, 1000),
        "pulse_two_sided": largest(block, pulse),
        "pulse_one_sided": largest(one_sided, pulse),
        "record_two_sided": largest(block, record),
        "record_one_sided": largest(one_sided, record),
        "record_vertical": largest(block, record, vertical),
        "frame_frequency": rocking.Frame(rocking.Block.of_size(1.1, 8.0), 4, 0.3)
        .mechanism()
        .positive.frequency_parameter,
        "arch_multiplier": _multiplier(rocking.Arch(10.0, 1.05, math.radians(157.5), voussoirs=7)),
        "wall_multiplier": _multiplier(rocking.Wall(1.6, 1.6, 0.25)),
        "loaded_wall_multiplier": _multiplier(
            rocking.LoadedWall.of_size(3.2, 0.25, 18e3, 1.6, top_load=20e3, restitution=0.5)
        ),
        "tied_facade_multiplier": _tied(),
        "two_storey_facade_multiplier": rocking.Facade(
            (3.0, 3.0), (0.6, 0.25), 18e3, restitution=0.9
        ).static_multiplier,
    }


def _multiplier(structure) -> float:
    return structure.mechanism().uplift_multiplier


def _peak_after_landing(response: rocking.Response) -> float:
    rotation = np.asarray(response.rotation)
    landing = int(np.argmax(rotation <= 0))
    return float(np.abs(rotation[landing:]).max())


def _threshold() -> float:
    block = rocking.Block.of_size(breadth=0.1, height=5.0, restitution=0.9)
    mechanism = block.mechanism()
    frequency = 3.0 * mechanism.positive.frequency_parameter
    time = np.arange(0.0, 2 * math.pi / frequency, 1e-3)
    sine = np.where(frequency * time <= math.pi, np.sin(frequency * time), 0.0)
    low, high = 1.0, 10.0
    while high - low > 1e-5:
        middle = (low + high) / 2
        motion = rocking.Accelerogram(middle * mechanism.uplift_multiplier * 9.80665 * sine, 1e-3)
        falls = math.isinf(rocking.integrate(mechanism, motion).rotation_ratio)
        low, high = (low, middle) if falls else (middle, high)
    return high


def double_impulse(block: rocking.Block, samples: int) -> float:
    """Return the velocity V [m/s] of two impulses from which on they overturn a block, the second as it lands.

    samples: from one to the other. Each is a triangle over two of them, and the time step is such that the block lands
    as the second one begins.
    """
    radius = block.semi_diagonal
    step = math.sqrt(4 * radius / (3 * 9.80665)) / samples
    low, high = 0.0, 4 * math.sqrt(9.80665 * radius)
    while high - low > 1e-8 * high:
        middle = (low + high) / 2
        for _ in range(20):
            landing = _landing(block, middle, step, samples)
            if not 0 < landing < math.inf:
                break
            last, step = step, landing / samples
            if abs(step - last) <= 1e-12 * step:
                break
        if not 0 < landing < math.inf:  # the first impulse alone does not lift it, or overturns it
            low, high = (low, middle) if landing else (middle, high)
            continue
        impulses = np.zeros(samples + 4)
        impulses[[1, samples + 1]] = middle / step, -middle / step
        motion = rocking.Accelerogram(impulses, step)
        falls = math.isinf(rocking.integrate(block, motion, 1e-9).rotation_ratio)
        low, high = (low, middle) if falls else (middle, high)
    return high


def _landing(block: rocking.Block, velocity: float, step: float, samples: int) -> float:
    """The time at which a block lands after one impulse, s; 0 where it does not lift, inf where it overturns."""
    impulse = np.zeros(2 * samples)
    impulse[1] = velocity / step
    response = rocking.integrate(block, rocking.Accelerogram(impulse, step), 1e-9, history=True)
    if response.rotation_ratio in (0, math.inf):
        return response.rotation_ratio
    rotation = np.asarray(response.rotation)
    away = int(np.argmax(rotation < 0))
    return float(response.times[away + int(np.argmax(rotation[away:] >= 0))])


def _tied() -> float:
    wall = rocking.Facade(
        (6.0,), (0.6,), 20e3, restitution=0.7, behind="cross_walls", crack_storey=1, crack="known",
        tie_heights=(5.8,), tie_stiffness=1e6, tie_strength=8e3,
    )  # fmt: skip
    by_code = CodeCapacity(wall.candidates()[0], wall.static_capacity(), confidence_factor=1.0)
    return by_code.onset_multiplier


if __name__ == "__main__":
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["case", "value"])
    table.writerows((case, f"{value:.10g}") for case, value in answers().items())
