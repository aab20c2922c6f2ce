"""The cases of the comparison: a block, a frame and an arch of seven voussoirs under pulses and records."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Arch, Block, Frame, Mechanism, Structure

SEED = 20
"""Of the drawn pulses and scales."""
PULSES = 201
"""Cases under a pulse."""
RECORDS = 42
"""Cases under a record."""
SAMPLES = 200
"""Of the strongest stretch of a record that every code is given."""
PER_PERIOD = 48
"""Samples of a pulse; between them every code sees straight lines, so that all are given the same motion."""


def structures() -> dict[str, Structure]:
    """Return the structures by name: m, rad."""
    return {
        "block": Block.of_size(breadth=0.6, height=3.0),
        "frame": Frame(Block.of_size(breadth=0.5, height=4.0), 2, 1.0),
        "arch": Arch(radius=5.0, thickness=0.75, embrace_angle=math.radians(157.5), voussoirs=7),
    }


def strongest_stretch(accelerogram: Accelerogram, samples: int) -> Accelerogram:
    """Return the `samples` successive samples of `accelerogram` that hold most of its acceleration energy."""
    spent = np.concatenate([[0.0], np.cumsum(accelerogram.acceleration**2)])
    start = int(np.argmax(spent[samples:] - spent[:-samples]))
    kept = accelerogram.acceleration[start : start + samples]
    return accelerogram.processed_by(kept, f"cut to the {samples} samples from sample {start}")


@dataclass(frozen=True)
class CodeCase:
    """One structure and one motion; kind: pulse or record."""

    name: str
    structure: str
    kind: str
    mechanism: Mechanism
    motion: Accelerogram


def pulse_cases(count: int = PULSES) -> Iterator[CodeCase]:
    """Yield sine pulses of 1.1 to 4 times the acceleration of uplift and 2 to 12 times p, evenly in the logarithm."""
    draw = np.random.default_rng(SEED)
    kinds = [(name, structure.mechanism()) for name, structure in structures().items()]
    for k in range(count):
        name, mechanism = kinds[k % len(kinds)]
        amplitude = mechanism.uplift_multiplier * GRAVITY * math.exp(draw.uniform(math.log(1.1), math.log(4)))
        frequency = mechanism.positive.frequency_parameter * math.exp(draw.uniform(math.log(2), math.log(12)))
        pulse = Pulse(amplitude, frequency, 0.0)
        step = pulse.period / PER_PERIOD
        samples = pulse.acceleration(np.arange(PER_PERIOD) * step)
        motion = Accelerogram(np.concatenate([samples, np.zeros(3)]), step)
        yield CodeCase(f"{name} pulse {k}", name, "pulse", mechanism, motion)


def record_cases(records: Sequence[Accelerogram], count: int = RECORDS) -> Iterator[CodeCase]:
    """Yield the strongest stretches of `records`, each scaled to 1.3 to 4 times the acceleration of uplift."""
    draw = np.random.default_rng(SEED + 1)
    kinds = [(name, structure.mechanism()) for name, structure in structures().items()]
    for k in range(count if records else 0):
        name, mechanism = kinds[k % len(kinds)]
        stretch = strongest_stretch(records[(k // len(kinds)) % len(records)], SAMPLES)
        ratio = math.exp(draw.uniform(math.log(1.3), math.log(4)))
        factor = ratio * mechanism.uplift_multiplier * GRAVITY / stretch.peak_acceleration
        yield CodeCase(f"{name} record {k}", name, "record", mechanism, stretch.scaled(factor))
