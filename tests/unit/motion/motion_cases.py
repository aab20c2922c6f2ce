"""Structures and ground motions that the tests of motion share."""

from dataclasses import replace

import numpy as np
from scipy.constants import g

from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Arch, Block, Wall
from rocking.structures.mechanism import EquivalentBlock, Mechanism


def mechanisms() -> dict[str, Mechanism]:
    """One mechanism of each kind: constant and varying inertia, two different sides, one side only."""
    block, wall = Block(1.0, 0.25, restitution=0.85), Wall(2.0, 3.0, 0.5, restitution=0.8)
    return {
        "block": block.mechanism(),
        "wall": wall.mechanism(),
        "arch": Arch(10.0, 1.5, np.deg2rad(157.5), restitution=0.9).mechanism(),
        "two sides": Mechanism(block.mechanism().positive, wall.mechanism().positive),
        "one side": Block(0.5, 0.3, restitution=0.5, one_sided=True).mechanism(),
    }


MECHANISMS = mechanisms()


def noise(seed: int, count: int, step: float, peak: float, width: int = 12) -> Accelerogram:
    """Smoothed Gaussian noise with the given peak acceleration [m/s²]."""
    rng = np.random.default_rng(seed)
    samples = np.convolve(rng.normal(size=count + 40), np.hanning(width), "same")[:count]
    return Accelerogram(samples * peak / np.abs(samples).max(), step)


def random_case(rng: np.random.Generator) -> tuple[Mechanism, Accelerogram | Pulse]:
    """A random structure under a random record or pulse that lifts it."""
    if rng.random() < 0.5:
        block = Block(10 ** rng.uniform(-1.5, 1.5), rng.uniform(0.02, 0.5), restitution=rng.uniform(0.3, 1))
        mechanism = block.mechanism()
    else:
        mechanism = list(MECHANISMS.values())[rng.integers(5)]
    lift = g * max(side.uplift_multiplier for side in mechanism.sides)
    if rng.random() < 0.2:
        frequency = mechanism.positive.frequency_parameter * 10 ** rng.uniform(-1, 1.5)
        return mechanism, Pulse(
            amplitude=lift * rng.uniform(1.05, 6) * rng.choice([-1, 1]), circular_frequency=frequency
        )
    step = rng.choice([0.005, 0.01, 0.02, 0.05, 0.2])
    count, width = int(rng.integers(50, 600)), int(rng.integers(3, 40))
    return mechanism, noise(int(rng.integers(2**31)), count, step, lift * rng.uniform(1.05, 5), width)


def with_restitution(structure: Mechanism | EquivalentBlock, positive: float, negative: float):
    """The same with these η on its sides; a symmetric one gets two sides where they differ."""
    one_sided, alike = structure.one_sided, positive == negative
    if isinstance(structure, Mechanism):
        other = structure.negative or (None if one_sided or alike else structure.positive)
        other = other and replace(other, restitution=negative)
        return replace(structure, positive=replace(structure.positive, restitution=positive), negative=other)
    other = structure.other_side or (None if one_sided or alike else structure)
    other = other and replace(other, restitution=negative, other_side=None)
    return replace(structure, restitution=positive, other_side=other)


def bisected(low, high, falls):
    """The value between low and high at which `falls` changes, to rounding of the verdict."""
    first = falls(low)
    for _ in range(45):
        middle = (low + high) / 2
        low, high = (middle, high) if falls(middle) is first else (low, middle)
    return (low + high) / 2
