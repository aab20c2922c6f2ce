"""Do the 90 % intervals of a fragility cover the truth? Run it as a script; nothing is asserted.

Two truths: outcomes drawn from a known lognormal, with two components a station that share half of its variance; and a
block under sine pulses of scattered frequency, whose overturning the closed form knows exactly and whose curve is no
lognormal.
"""

import numpy as np
from scipy.stats import norm

from rocking import Block, Pulse
from rocking.assessment.fragility import fragility_of
from rocking.quantities import GRAVITY
from rocking.sine_pulse import predict_maxima

TRIALS = 500
LEVELS = np.geomspace(0.2, 5.0, 20)
PULSE_LEVELS = np.geomspace(1.5, 40.0, 20)


def lognormal_outcomes(rng: np.random.Generator, stations: int) -> np.ndarray:
    """Outcomes of two components a station at LEVELS, of a lognormal of median 1 and dispersion 0.5."""
    shared, own = rng.standard_normal((stations, 1)), rng.standard_normal((stations, 2))
    thresholds = np.exp(0.5 * (shared + own) / 2**0.5).reshape(-1, 1)
    return (thresholds < LEVELS).astype(float)


def pulse_outcomes(rng: np.random.Generator, count: int) -> np.ndarray:
    """Overturning of a block by pulses of PULSE_LEVELS times gλ, about six times as fast as p, by the closed form."""
    block = Block(2.0, 0.2, restitution=0.9).mechanism().equivalent_block("rest")
    frequencies = block.frequency_parameter * 6 * np.exp(0.4 * rng.standard_normal(count))
    amplitudes = GRAVITY * block.uplift_multiplier * PULSE_LEVELS
    pulses = [Pulse(float(a), float(w), 0.0) for w in frequencies for a in amplitudes]
    return np.isinf(predict_maxima([block], pulses)[0]).reshape(count, -1).astype(float)


def covered(truth: np.ndarray, low: np.ndarray, high: np.ndarray) -> float:
    """Share of the levels, where the truth is open, at which the interval holds it."""
    middle = (truth > 0.02) & (truth < 0.98)
    return float(((low <= truth) & (truth <= high))[middle].mean())


def main() -> None:
    """Print the shares that are covered."""
    truth = norm.cdf(np.log(LEVELS) / 0.5)
    for stations in (8, 20, 35):
        rng, names = np.random.default_rng(stations), [str(k // 2) for k in range(2 * stations)]
        trials = [fragility_of(LEVELS, lognormal_outcomes(rng, stations), names) for _ in range(TRIALS)]
        curve = np.mean([covered(truth, each.probability_low, each.probability_high) for each in trials])
        median = np.mean([each.interval[0] <= 1.0 <= each.interval[1] for each in trials])
        print(f"lognormal, {stations} stations: curve {curve:.3f}, median {median:.3f} of {TRIALS}")
    rng, names = np.random.default_rng(0), [str(k) for k in range(40)]
    every = pulse_outcomes(rng, 5_000)
    trials = [fragility_of(PULSE_LEVELS, rng.choice(every, 40), names) for _ in range(TRIALS)]
    curve = np.mean(
        [covered(every.mean(axis=0), each.probability_low, each.probability_high) for each in trials]
    )
    print(f"pulses, 40 stations: curve {curve:.3f} of {TRIALS}")


if __name__ == "__main__":
    main()
