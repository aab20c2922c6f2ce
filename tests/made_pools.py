"""Pools of made records: pairs of components of many stations, pulses of many periods in noise, by seed."""

import numpy as np

from rocking.records import Accelerogram
from rocking.records.synthetic import SyntheticRecord, noise, pulse

DESIGN = {
    "ag_g": 0.2,
    "f0": 2.5,
    "tc_star_s": 0.4,
    "stations": 3,
    "shortest_period_s": 0.6,
    "longest_period_s": 0.9,
}
"""The design level of a study that chooses three stations of such a pool."""


def made_pool(stations, seed=0, duration=12.0, time_step=0.02):
    """Return pairs of components by name, of as many stations."""
    rng = np.random.default_rng(seed)
    pool = {}
    for number in range(stations):
        period = float(np.exp(rng.uniform(np.log(0.4), np.log(2.5))))
        amplitude = rng.uniform(0.3, 2.5)
        components = []
        for name in ("H1", "H2"):
            recipe = SyntheticRecord(
                name=f"S{number}",
                seed=int(rng.integers(1 << 30)),
                pulse_amplitude=amplitude * rng.uniform(0.3, 1.0),
                pulse_period=period,
                pulse_start=3.0,
                noise_peak=rng.uniform(1.5, 3.0),
                duration=duration,
                time_step=time_step,
            )
            times = np.arange(round(duration / time_step)) * time_step
            values = pulse(recipe, times) + noise(recipe, times.size)
            components.append(Accelerogram(values, time_step, component=name, station=f"S{seed}-{number}"))
        pool[f"R{number}"] = components
    return pool
