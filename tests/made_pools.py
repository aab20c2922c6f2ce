"""Pools of made records: pairs of components of many stations, pulses of many periods in noise, by seed."""

import numpy as np

from rocking.codes.selection import Selection
from rocking.records import Accelerogram
from tests.synthetic import SyntheticRecord, noise, pulse

LEVEL = {"ag_g": 0.2, "f0": 2.5, "tc_star_s": 0.4}
SETS = {"stations": 3, "shortest_period_s": 0.6, "longest_period_s": 0.9}
DESIGN = {"design_spectrum": LEVEL, "checks": SETS}
"""The settings of a study at a design level that chooses three stations of such a pool."""


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
            of_it = {"component": name, "station": f"S{seed}-{number}", "event": f"EQ {number}"}
            components.append(Accelerogram(values, time_step, **of_it))
        pool[f"R{number}"] = components
    return pool


def made_answers(rng, stations, events, median, size=10):
    """Return sets of stations within earthquakes, (use, falls) of a wall at each, and the share of sets that meet it.

    The largest displacement over its limit is log-normal, of which the earthquake has a half of the variance; it falls
    beyond 2.5 times the limit, which is d_0 over d_SLV.
    """
    event = rng.integers(0, events, stations)
    use = np.exp(np.log(median) + 0.45 * (rng.normal(size=events)[event] + rng.normal(size=stations)))
    falls = use > 2.5
    use = np.where(falls, np.inf, use)
    ground = np.array([0.0, 1.0, 0.0])
    sets = np.array([rng.choice(stations, size, replace=False) for _ in range(200)])
    records = Selection(
        names=tuple(f"R{place}" for place in range(stations)),
        stations=tuple(f"S{place}" for place in range(stations)),
        pairs=tuple(
            (
                Accelerogram(
                    ground, 0.01, event=f"{chr(97 + item // 26)}{chr(97 + item % 26)}", station=f"S{place}"
                ),
            )
            for place, item in enumerate(event)
        ),
        factors=np.ones(stations),
        periods=np.ones(1),
        target=np.ones(1),
        spectra=np.ones((stations, 1)),
        sets=sets,
        chosen=sets[0],
        drawn=200,
        below=0.1,
        above=0.3,
    )
    met = (use[sets].mean(axis=1) <= 1) & ~falls[sets].any(axis=1)
    return records, use[None], falls[None].astype(int), float(met.mean())
