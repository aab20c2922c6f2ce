"""Speed and error of the prediction under one sine pulse beside a scipy loop, in one run. Run it as a script.

Prints seconds, microseconds per answer and ratios; nothing is asserted.
"""

import math
import time

import numpy as np
from clock import least_cpu
from scipy.constants import g
from scipy.integrate import solve_ivp

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import predict_maxima, pulse_spectrum
from rocking.structures import Arch, Block
from rocking.structures.mechanism import EquivalentBlock

ETA = 0.9
BLOCK = EquivalentBlock(1.0, 1.0, g, ETA)  # p = gλ = 1: a pulse's values are the ratios
FREQUENCIES, AMPLITUDES = np.linspace(0.2, 12, 200), np.linspace(0.2, 12, 200)
SAMPLE = 60


def stepped(a: float, omega: float, tolerance: float) -> float:
    """Largest φ/φ_cr by DOP853 with events for contact and crest, restarted at each impact; inf beyond 30."""
    if a <= 1:
        return 0.0
    t, side, y, peak, end, after = math.asin(1 / a) / omega, 1, np.zeros(2), 0.0, 2 * math.pi / omega, 0

    def motion(time, state):
        return (state[1], state[0] - 1 + side * (a * math.sin(omega * time) if time < end else 0.0))

    def contact(time, state):
        return state[0] if time > (math.pi - math.asin(1 / a)) / omega else 1.0

    def crest(time, state):
        return state[1]

    def fallen(time, state):
        return state[0] - 30

    contact.terminal = fallen.terminal = True
    contact.direction = crest.direction = -1
    while after < 2:
        horizon = end if t < end else t + 60
        out = solve_ivp(
            motion, (t, horizon), y, "DOP853", events=(contact, crest, fallen), rtol=tolerance, atol=1e-14
        )
        peak = max([peak, *(state[0] for state in out.y_events[1])])
        if out.t_events[2].size:
            return math.inf
        t, y = out.t[-1], out.y[:, -1]
        if out.t_events[0].size:
            after += t > end
            y, side = np.array([0.0, ETA * abs(y[1])]), -side
            if y[1] < 1e-6:
                return peak
    return peak


def many() -> None:
    """A million predictions in one call: blocks exact at rest by pulses."""
    blocks = [
        Arch(radius, 0.15 * radius, math.radians(157.5)).mechanism().equivalent_block()
        for radius in np.linspace(5, 20, 10)
    ] + [Block(height, 0.2).mechanism().equivalent_block() for height in np.linspace(1, 5, 90)]
    generator = np.random.default_rng(1)
    pulses = [
        Pulse(float(a), float(omega))
        for a, omega in zip(generator.uniform(0.5, 12, 10_000), generator.uniform(1, 30, 10_000), strict=True)
    ]
    predict_maxima(blocks[:1], pulses[:1])
    start = time.process_time()
    predict_maxima(blocks, pulses)
    print(
        f"{len(blocks) * len(pulses):,} predictions in one call: {time.process_time() - start:.2f} s of CPU"
    )


def spectrum() -> None:
    """The whole map, and the same cells by a scipy loop."""
    (seconds,) = least_cpu(lambda: pulse_spectrum(FREQUENCIES, AMPLITUDES, ETA), repeats=3)
    cells = FREQUENCIES.size * AMPLITUDES.size
    ratios = pulse_spectrum(FREQUENCIES, AMPLITUDES, ETA)
    print(
        f"pulse spectrum {ratios.shape[0]} x {ratios.shape[1]}: {seconds:.2f} s, {1e6 * seconds / cells:.1f} us a cell"
    )
    generator = np.random.default_rng(0)
    picked = [
        (generator.integers(FREQUENCIES.size), generator.integers(AMPLITUDES.size)) for _ in range(SAMPLE)
    ]
    for tolerance in (1e-6, 1e-10):
        start = time.process_time()
        found = [stepped(AMPLITUDES[j], FREQUENCIES[i], tolerance) for i, j in picked]
        each = (time.process_time() - start) / SAMPLE
        truth = [ratios[i, j] for i, j in picked]
        rocking = [
            abs(f / t - 1) for f, t in zip(found, truth, strict=True) if 0 < t < math.inf and f < math.inf
        ]
        flipped = sum(math.isinf(f) != math.isinf(t) for f, t in zip(found, truth, strict=True))
        print(
            f"scipy DOP853 at {tolerance:g}: {1e6 * each:.0f} us a cell, {each * cells / seconds:.0f} times slower, "
            f"largest difference {max(rocking):.1e}, verdicts that differ {flipped} of {SAMPLE}"
        )


if __name__ == "__main__":
    many()
    spectrum()
