"""Speed and error of the integration beside scipy's DOP853 with events, in one run. Run it as a script.

Prints times, ratios and exponents; nothing is asserted.
"""

import time
from pathlib import Path

import numpy as np
from clock import least_cpu, shaking
from scipy.constants import g
from scipy.integrate import solve_ivp

from rocking import Accelerogram, Arch, Block, integrate, rocking_spectrum
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.motion import integrate_batch
from rocking.structures import load_structures
from rocking.structures.mechanism import Mechanism

STRUCTURES = Path(__file__).parents[2] / "workflow" / "structures.yaml"


def scipy_peak(mechanism: Mechanism, motion: Accelerogram, tolerance: float) -> float:
    """Largest φ/φ_cr by DOP853, restarted at every sample while it rocks, landings by its own event location."""
    body, eta, critical = mechanism.positive, mechanism.restitution, mechanism.critical_rotation
    ground, step, lift = motion.acceleration, motion.time_step, mechanism.uplift_multiplier * g
    side, y, peak = 0, np.zeros(2), 0.0

    def equation(t, state, start, slope, s):
        push = -s * body.ground(state[0]) * (start + slope * t) - body.gravity(state[0]) * g
        return state[1], float(
            (push - body.inertia_slope(state[0]) / 2 * state[1] ** 2) / body.inertia(state[0])
        )

    def landing(t, state, *_):
        return state[0] if t > started else 1.0

    def crest(t, state, *_):
        return state[1]

    landing.terminal, landing.direction, crest.direction = True, -1, -1
    for i in range(ground.size - 1):
        t, slope = 0.0, (ground[i + 1] - ground[i]) / step
        while t < step:
            if side == 0:
                if abs(ground[i + 1]) <= lift:
                    break
                t = max(t, min(step, (lift * np.sign(ground[i + 1]) - ground[i]) / slope)) if slope else t
                side, y = -int(np.sign(ground[i + 1])), np.zeros(2)
            started = t
            out = solve_ivp(
                equation, (t, step), y, "DOP853", args=(ground[i], slope, side), events=(landing, crest),
                rtol=tolerance, atol=1e-3 * tolerance * critical,
            )  # fmt: skip
            t, y = out.t[-1], out.y[:, -1]
            peak = max([peak, *(state[0] for state in out.y_events[1])])
            if y[0] > 5 * critical:
                return np.inf
            if out.t_events[0].size:
                y, side = np.array([0.0, -eta * y[1]]), -side
                if y[1] < 1e-5 * critical:
                    side = 0
    return peak / critical


def lively(mechanism: Mechanism, seconds: float, rounds: int = 1) -> Accelerogram:
    """The strongest of some records, played so often, under which the structure stands; then still ground."""
    for strength in (3.0, 2.5, 2.2, 2.0, 1.8, 1.6, 1.5, 1.4, 1.3, 1.2, 1.1):
        motion = shaking(seconds, strength * g * mechanism.uplift_multiplier, period=0.3)
        samples = np.append(np.tile(motion.acceleration, rounds), np.zeros(2000))
        if integrate(mechanism, played := Accelerogram(samples, motion.time_step)).outcome == "rocks":
            return played
    raise RuntimeError("the structure stands under none of the records")


def beside_scipy() -> None:
    """One response with its error against a run at 1e-13, and the same by scipy with its own error."""
    for name, structure in (("block", Block(3.0, 0.2, restitution=0.9)), ("arch", Arch(20.0, 2.4, np.pi))):
        mechanism = structure.mechanism()
        motion = lively(mechanism, 4)
        truth = integrate(mechanism, motion, 1e-13).rotation_ratio
        response = integrate(mechanism, motion)
        (here,) = least_cpu(lambda m=mechanism, r=motion: integrate(m, r))
        error = abs(response.rotation_ratio / truth - 1)
        print(f"{name}, 4 s at 200 Hz: {here * 1e3:.3f} ms, {response.impacts} impacts, error {error:.0e}")
        for tolerance in (1e-6, 1e-8):
            started = time.process_time()
            error = abs(scipy_peak(mechanism, motion, tolerance) / truth - 1)
            taken = time.process_time() - started
            print(
                f"  DOP853 at {tolerance:g}: {taken:.2f} s, error {error:.0e}, {taken / here:,.0f} times as long"
            )


def growth() -> None:
    """Exponent of the cost against samples and against structures."""
    block = Block(3.0, 0.2, restitution=0.9).mechanism()
    records = [lively(block, 10, rounds) for rounds in (4, 40, 400)]
    sizes = [record.acceleration.size for record in records]
    taken = least_cpu(*(lambda r=r: integrate(block, r) for r in records), repeats=5)
    print(f"cost ~ samples^{np.polyfit(np.log(sizes), np.log(taken), 1)[0]:.3f}")
    short, counts = lively(block, 4), np.array([100, 1000, 10_000])
    taken = least_cpu(*(lambda n=n: integrate_batch([block] * n, short) for n in counts), repeats=3)
    print(f"cost ~ structures^{np.polyfit(np.log(counts), np.log(taken), 1)[0]:.3f}")


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


def many() -> None:
    """Ten thousand nonlinear responses, and a record spectrum."""
    shapes = [(size, alpha) for size in np.geomspace(1, 10, 25) for alpha in np.linspace(0.15, 0.3, 20)]
    blocks = [Block(size, alpha, restitution=0.9).mechanism() for size, alpha in shapes]
    motions = [shaking(40, 3.0, seed) for seed in range(20)]
    integrate_batch(blocks, motions[0])
    started = time.process_time()
    ratios = np.hstack([integrate_batch(blocks, motion) for motion in motions])
    print(
        f"{ratios.size} responses of 40 s: {time.process_time() - started:.2f} s, {np.mean(ratios > 0):.0%} lifted"
    )
    frequencies, multipliers = np.linspace(0.5, 5, 100), np.linspace(0.05, 0.45, 100)
    (taken,) = least_cpu(lambda: rocking_spectrum(motions[0], frequencies, multipliers, 0.9), repeats=3)
    print(f"100 x 100 record spectrum of {motions[0].acceleration.size} samples: {taken:.2f} s")


if __name__ == "__main__":
    beside_scipy()
    ensembles()
    growth()
    many()
