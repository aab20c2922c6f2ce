"""What a fragility costs beside its kernel, and do its 90 % intervals cover the truth?

The cost is that of the shipped structures under the FEMA P-695 suite, where ROCKING_RECORDS names a mirror that holds
it, else under synthetic records. Two truths: outcomes drawn from a known lognormal, with two components a station that
share half of its variance; and a block under sine pulses of scattered frequency, whose overturning the closed form
knows exactly and whose curve is no lognormal.
"""

import os
from pathlib import Path
from time import perf_counter, process_time

import numpy as np
from scipy.stats import norm

import rocking
from rocking.assessment.fragility import fragility_of, incremental_dynamic_analysis
from rocking.assessment.fragility.multifidelity import corrected, inclusion, systematic_draw
from rocking.motion import nonlinear_kernel as kernel
from rocking.motion.forcing import forcing_of
from rocking.motion.nonlinear import STEP_SHARE
from rocking.motion.table import table_of
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram, load_catalogue, open_record
from rocking.records.synthetic import SyntheticRecord, synthetic_record
from rocking.structures import Structure, load_structures

ROOT = Path(__file__).parents[2]

TRIALS = 500
LEVELS = np.geomspace(0.2, 5.0, 20)
BLOCK = rocking.Block(2.0, 0.2, restitution=0.9)


def lognormal_outcomes(rng: np.random.Generator, stations: int) -> tuple[np.ndarray, list[str]]:
    """Outcomes of a lognormal of median 1 and dispersion 0.5 at LEVELS."""
    shared, own = rng.standard_normal((stations, 1)), rng.standard_normal((stations, 2))
    thresholds = np.exp(0.5 * (shared + own) / 2**0.5).reshape(-1, 1)
    return (thresholds < LEVELS).astype(float), [str(k // 2) for k in range(2 * stations)]


def pulse_outcomes(rng: np.random.Generator, count: int) -> np.ndarray:
    """Overturning of the block by pulses of 1 to 8 times gλ, about six times as fast as p, by the closed form."""
    block = BLOCK.mechanism().equivalent_block("rest")
    frequencies = block.frequency_parameter * 6 * np.exp(0.4 * rng.standard_normal(count))
    amplitudes = GRAVITY * block.uplift_multiplier * PULSE_LEVELS
    pulses = [rocking.Pulse(float(a), float(w), 0.0) for w in frequencies for a in amplitudes]
    return np.isinf(rocking.predict_maxima([block], pulses)[0]).reshape(count, -1).astype(float)


PULSE_LEVELS = np.geomspace(1.5, 40.0, 20)


def few_runs(stations: int, truth: np.ndarray) -> None:
    """Print the shares for one run in ten of a mechanism whose block parts from it by a tenth."""
    rng = np.random.default_rng(100 + stations)
    curves, medians = [], []
    for _ in range(TRIALS):
        shared, own = rng.standard_normal((stations, 1)), rng.standard_normal((stations, 2))
        logs = 0.5 * ((shared + own) / 2**0.5).reshape(-1, 1)
        outcomes, names = (np.exp(logs) < LEVELS).astype(float), [str(k // 2) for k in range(2 * stations)]
        blocks = (np.exp(logs + 0.1 * rng.standard_normal(logs.shape)) < LEVELS).astype(float)
        chance = inclusion(LEVELS, blocks, outcomes.size // 10)
        said = corrected(LEVELS, blocks, systematic_draw(chance, rng), outcomes, chance)
        found = fragility_of(LEVELS, said, names, sampled_of=fragility_of(LEVELS, blocks, names))
        curves.append(covered(truth, found.probability_low, found.probability_high))
        medians.append(found.interval[0] <= 1.0 <= found.interval[1])
    print(
        f"one run in ten, {stations} stations: curve {np.mean(curves):.3f}, median {np.mean(medians):.3f} of {TRIALS}"
    )


def covered(truth: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """Share of the levels, where the truth is open, at which the interval holds it."""
    middle = (truth > 0.02) & (truth < 0.98)
    return float(((low <= truth) & (truth <= high))[middle].mean())


def suite() -> list[Accelerogram]:
    """Seventy components of 35 stations."""
    mirror = os.environ.get("ROCKING_RECORDS")
    if mirror:
        listed = load_catalogue(ROOT / "records" / "fema_p695.csv")
        return [each for record in listed for each in open_record(record, mirror=Path(mirror))]
    rng = np.random.default_rng(0)
    recipes = [
        SyntheticRecord(f"made {k}", k, rng.uniform(1, 6), rng.uniform(0.3, 2), 5.0, 2.0, 30.0, 0.01)
        for k in range(70)
    ]
    return [synthetic_record(recipe) for recipe in recipes]


def bare(structure: Structure, records: list[Accelerogram], levels: np.ndarray, found: np.ndarray) -> float:
    """CPU time of the compiled kernel alone, in the same cases with everything at hand."""
    table, spent = table_of(structure.mechanism()), 0.0
    for record, intensity in zip(records, found, strict=True):
        forcing, count = forcing_of(record, None), levels.size
        ready = table.kernel_of(forcing), forcing.ground, levels / intensity, np.zeros(count)
        status, peaks, impacts = np.zeros(count, np.int64), np.zeros((count, 2)), np.zeros(count, np.int64)
        restitution = np.ascontiguousarray(np.tile(table.restitution, (count, 1)))
        started = process_time()
        kernel.rock_members(*ready, restitution, STEP_SHARE * 1e-6, status, peaks, impacts)
        spent += process_time() - started
    return spent


def cost() -> None:
    """Print the wall and CPU time of all structures, and CPU over that of the kernel alone."""
    records, structures = suite(), load_structures(ROOT / "workflow" / "structures.yaml")
    stations = [str(k // 2) for k in range(len(records))]
    incremental_dynamic_analysis(records[:2], BLOCK, stations=["a", "b"], levels=[0.1, 0.2])
    for structure in structures.values():
        table_of(structure.mechanism())
    wall, whole, curve, alone, cases = 0.0, 0.0, 0.0, 0.0, 0
    for structure in structures.values():
        began, started = perf_counter(), process_time()
        found = incremental_dynamic_analysis(records, structure, stations=stations, intensity_measure="pgv")
        answered = process_time()
        found.fragility()
        curve += process_time() - answered
        whole, wall = whole + process_time() - started, wall + perf_counter() - began
        alone += bare(structure, records, found.levels, found.intensities)
        cases += found.rotation_ratios.size
    print(
        f"{len(structures)} structures x {len(records)} components x 40 levels: {wall:.1f} s wall, {whole:.1f} s CPU, "
        f"{1e3 * whole / cases:.3f} ms a response, {whole / alone:.2f} times the kernel alone, "
        f"{(whole - curve) / alone:.2f} without the curves"
    )


def main() -> None:
    """Print what it costs, and the shares that are covered."""
    cost()
    truth = norm.cdf(np.log(LEVELS) / 0.5)
    for stations in (8, 20, 35):
        rng = np.random.default_rng(stations)
        curves, medians = [], []
        for _ in range(TRIALS):
            found = fragility_of(LEVELS, *lognormal_outcomes(rng, stations))
            curves.append(covered(truth, found.probability_low, found.probability_high))
            medians.append(found.interval[0] <= 1.0 <= found.interval[1])
        print(
            f"lognormal, {stations} stations: curve {np.mean(curves):.3f}, median {np.mean(medians):.3f} of {TRIALS}"
        )
    for stations in (20, 35):
        few_runs(stations, truth)
    rng = np.random.default_rng(0)
    every = pulse_outcomes(rng, 5_000)
    exact = every.mean(axis=0)
    curves, called = [], []
    for _ in range(TRIALS):
        found = fragility_of(PULSE_LEVELS, rng.choice(every, 40), [str(k) for k in range(40)])
        curves.append(covered(exact, found.probability_low, found.probability_high))
        called.append(not found.lognormal_holds)
    print(
        f"pulses, 40 stations: curve {np.mean(curves):.3f} of {TRIALS}; called not lognormal {np.mean(called):.2f}"
    )


if __name__ == "__main__":
    main()
