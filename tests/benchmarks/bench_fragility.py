"""Do the 90 % intervals of a fragility cover the truth?

Two truths: outcomes drawn from a known lognormal, with two components a station that share half of its variance; and a
block under sine pulses of scattered frequency, whose overturning the closed form knows exactly and whose curve is no
lognormal.
"""

import numpy as np
from scipy.stats import norm

import rocking
from rocking.assessment.fragility import fragility_of
from rocking.quantities import GRAVITY

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


def covered(truth: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """Share of the levels, where the truth is open, at which the interval holds it."""
    middle = (truth > 0.02) & (truth < 0.98)
    return float(((low <= truth) & (truth <= high))[middle].mean())


def main() -> None:
    """Print the shares that are covered."""
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
