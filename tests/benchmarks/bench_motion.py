"""Speed and error of the integration beside scipy's DOP853 with events, in one run. Run it as a script.

Prints times, ratios and exponents; nothing is asserted.
"""

import sys
import time
from pathlib import Path

import numpy as np
from clock import least_cpu, shaking
from scipy.constants import g

sys.path.append(str(Path(__file__).parents[1] / "unit" / "motion"))

from oracle import Oracle

from rocking import Accelerogram, Arch, Block, integrate, rocking_spectrum
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.motion import integrate_batch
from rocking.structures import load_structures
from rocking.structures.mechanism import Mechanism

STRUCTURES = Path(__file__).parents[2] / "workflow" / "structures.yaml"
BLOCK = Block(3.0, 0.2, restitution=0.9)


def lively(mechanism: Mechanism, seconds: float, rounds: int = 1) -> Accelerogram:
    """The strongest of some records, played so often, under which the structure stands; then still ground."""
    for strength in (3.0, 2.5, 2.2, 2.0, 1.8, 1.6, 1.5, 1.4, 1.3, 1.2, 1.1):
        motion = shaking(seconds, strength * g * mechanism.uplift_multiplier, period=0.3)
        samples = np.append(np.tile(motion.acceleration, rounds), np.zeros(2000))
        if integrate(mechanism, played := Accelerogram(samples, motion.time_step)).outcome == "rocks":
            return played
    raise RuntimeError("the structure stands under none of the records")


def beside_scipy() -> None:
    """One response with its error against a run at 1e-13, and the same by the oracle of the tests with its own."""
    for name, structure in (("block", BLOCK), ("arch", Arch(20.0, 2.4, np.pi))):
        mechanism = structure.mechanism()
        motion = lively(mechanism, 4)
        truth = integrate(mechanism, motion, 1e-13).rotation_ratio
        response = integrate(mechanism, motion)
        (here,) = least_cpu(lambda m=mechanism, r=motion: integrate(m, r))
        error = abs(response.rotation_ratio / truth - 1)
        print(f"{name}, 4 s at 200 Hz: {here * 1e3:.3f} ms, {response.impacts} impacts, error {error:.0e}")
        for tolerance in (1e-6, 1e-8):
            started = time.process_time()
            peak, _ = Oracle(mechanism, tolerance).run(motion.acceleration, motion.time_step)
            times = (time.process_time() - started) / here
            print(f"  DOP853 at {tolerance:g}: error {abs(peak / truth - 1):.0e}, {times:,.0f} times as long")


def growth() -> None:
    """Exponent of the cost against samples and against structures, and the cost of a record spectrum."""
    block = BLOCK.mechanism()
    records = [lively(block, 10, rounds) for rounds in (4, 40, 400)]
    sizes = [record.acceleration.size for record in records]
    taken = least_cpu(*(lambda r=r: integrate(block, r) for r in records), repeats=5)
    print(f"cost ~ samples^{np.polyfit(np.log(sizes), np.log(taken), 1)[0]:.3f}")
    short, counts = lively(block, 4), np.array([100, 1000, 10_000])
    taken = least_cpu(*(lambda n=n: integrate_batch([block] * n, short) for n in counts), repeats=3)
    print(f"cost ~ structures^{np.polyfit(np.log(counts), np.log(taken), 1)[0]:.3f}")
    frequencies, multipliers = np.linspace(0.5, 5, 100), np.linspace(0.05, 0.45, 100)
    (spent,) = least_cpu(lambda: rocking_spectrum(short, frequencies, multipliers, 0.9), repeats=3)
    print(f"100 x 100 record spectrum of {short.acceleration.size} samples: {spent:.2f} s")


def ensembles() -> None:
    """The ensemble of each shipped structure over one integration of it under the same record."""
    for name, structure in load_structures(STRUCTURES).items():
        mechanism = structure.mechanism()
        motion = shaking(20, 2.5 * g * mechanism.uplift_multiplier, step=0.01)
        motions = GroundMotions.of(motion)
        whole, one = least_cpu(
            lambda m=mechanism, of=motions: ensemble(m, of), lambda m=mechanism, r=motion: integrate(m, r)
        )
        members = ensemble(mechanism, motions).members
        print(f"{name}: ensemble of {members} in {whole * 1e3:.2f} ms = {whole / one:.0f} integrations")


if __name__ == "__main__":
    beside_scipy()
    ensembles()
    growth()
