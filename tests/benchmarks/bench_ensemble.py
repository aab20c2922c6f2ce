"""CPU of ensembles beside the bare kernel, and of the cheapest answers beside the mechanism. Run it as a script.

Prints ratios within one run; nothing is asserted.
"""

import math
from collections.abc import Callable
from pathlib import Path
from time import process_time

import numpy as np
from bench_motion import record
from scipy.constants import g

from rocking.assessment.ensemble import CAUSES, EnsembleSettings, GroundMotions, ensemble
from rocking.assessment.ensemble.design import lattice
from rocking.assessment.fidelity import cheapest_answer, limits_of
from rocking.assessment.intensity import Shape
from rocking.assessment.method import Method
from rocking.motion import integrate
from rocking.motion import nonlinear_kernel as kernel
from rocking.motion.forcing import forcing_of
from rocking.motion.nonlinear import STEP_SHARE
from rocking.motion.table import table_of
from rocking.records import Accelerogram
from rocking.structures import Mechanism, load_structures

STRUCTURES = load_structures(Path(__file__).parents[2] / "workflow" / "structures.yaml")
SETTINGS = EnsembleSettings()
REPEATS = 60


def cpu(*calls: Callable[[], object], repeats: int = REPEATS) -> list[float]:
    """Least CPU time of each call, s, taken in turns after one that warms up."""
    least = [math.inf] * len(calls)
    for k in range(repeats + 1):
        for place, call in enumerate(calls):
            started = process_time()
            call()
            if k:
                least[place] = min(least[place], process_time() - started)
    return least


def bare(mechanism: Mechanism, motion: Accelerogram, members: int) -> Callable[[], None]:
    """The compiled kernel alone, with everything it takes prepared: the first `members` of the ensemble."""
    amplitude, restitution, polarity = lattice(256, CAUSES)[:members, :3].T
    factor = 1 + SETTINGS.amplitude_range * (2 * amplitude - 1)
    sign = np.where((polarity < 0.5) & (not mechanism.symmetric), -1.0, 1.0)
    own = np.array([mechanism.sides[0].restitution, mechanism.sides[-1].restitution])
    eta = np.clip(own + SETTINGS.restitution_range * (2 * restitution - 1)[:, None], 0, 1)
    table, forcing = table_of(mechanism), forcing_of(motion)
    side = table.kernel_of(forcing)
    vertical, tolerance = np.zeros(members), STEP_SHARE * 1e-6

    def run() -> None:
        status, impacts = np.zeros(members, dtype=np.int64), np.zeros(members, dtype=np.int64)
        peaks = np.zeros((members, 2))
        kernel.rock_members(
            side, forcing.ground, factor * sign, vertical, eta, tolerance, status, peaks, impacts
        )

    return run


def ensembles() -> None:
    """The ensemble over the kernel's own time for as many members, at 20 s / 100 Hz and 40 s / 200 Hz."""
    print("ensemble over the bare kernel, same members")
    for seconds, step in ((20, 0.01), (40, 0.005)):
        ratios = []
        for name, structure in STRUCTURES.items():
            mechanism = structure.mechanism()
            motion = record(seconds, 2.5 * g * mechanism.uplift_multiplier, step=step)
            motions = GroundMotions.of(motion)
            members = ensemble(mechanism, motions).members
            whole, alone = cpu(
                lambda m=mechanism, of=motions: ensemble(m, of), bare(mechanism, motion, members)
            )
            ratios.append(whole / alone)
            print(
                f"  {seconds} s, {1 / step:.0f} Hz, {name}: {members} members, {1e3 * whole:.2f} ms, "
                f"{1e6 * alone / members:.0f} µs a member, ratio {ratios[-1]:.2f}"
            )
        print(f"  {seconds} s: largest ratio {max(ratios):.2f}, median {np.median(ratios):.2f}")


def answers() -> None:
    """fidelity: auto over the mechanism alone, case by case, without an ensemble; and over mechanism and ensemble."""
    alone, beside, settled = [], [], 0
    for structure in STRUCTURES.values():
        mechanism = structure.mechanism()
        limits_of(mechanism, 0.01)  # found once for each structure of a study
        for strength in (0.9, 1.3, 2.0, 4.0, 8.0):
            motion = record(20, strength * g * mechanism.uplift_multiplier, step=0.01)
            shape, motions = Shape.of(motion), GroundMotions.of(motion)
            answer = cheapest_answer(mechanism, shape, ensemble_follows=True)
            settled += answer.method is not Method.MECHANISM_ON_RECORD
            cheapest, whole, block, many = cpu(
                lambda m=mechanism, s=shape: cheapest_answer(m, s),
                lambda m=mechanism, r=motion: integrate(m, r),
                lambda m=mechanism, s=shape: cheapest_answer(m, s, ensemble_follows=True),
                lambda m=mechanism, of=motions: ensemble(m, of),
            )
            alone.append(cheapest / whole)
            spent = block + (many if answer.method is Method.MECHANISM_ON_RECORD else 0.0)
            beside.append(spent / (whole + many))
    print("cheapest answer over the mechanism, case by case (the search of the peaks of a record apart)")
    print(f"  largest ratio {max(alone):.2f}, median {np.median(alone):.2f}, cases {len(alone)}")
    print("cheapest answer over mechanism and ensemble, case by case")
    print(f"  largest ratio {max(beside):.2f}, median {np.median(beside):.3f}, settled {settled}")


if __name__ == "__main__":
    ensembles()
    answers()
