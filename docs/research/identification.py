"""What is not known of a structure, identified from tests of it that ended standing or overturned."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import qmc

from docs.research.mixture import Mixture, fit_mixture
from rocking.errors import ConfigurationError
from rocking.motion import integrate_batch
from rocking.records import Accelerogram
from rocking.structures import EquivalentBlock

PARAMETERS = (
    "uplift_multiplier_positive",
    "uplift_multiplier_negative",
    "frequency_parameter",
    "restitution",
)
"""What is identified of a block with two sides."""
LEVELS = (0.05, 0.5, 0.95)
"""Quantiles that a range gives."""
Motion = Callable[[Accelerogram], Accelerogram]
"""What a record goes through before a structure meets it."""


@dataclass(frozen=True)
class BlockPrior:
    """What may be true of a rigid body on two contact lines before any test: a box, even in the logarithms (η: even).

    uplift_multiplier: λ, geometric mean of the two sides, -. frequency_parameter: p, rad/s, the same on both sides.
    side_ratio: largest λ of one side over the other's, ≥ 1. restitution: η. Each but the ratio (lowest, highest).
    size: number of blocks that fill the box, evenly (Sobol), a power of two.
    """

    uplift_multiplier: tuple[float, float]
    frequency_parameter: tuple[float, float]
    side_ratio: float = 1.5
    restitution: tuple[float, float] = (0.7, 0.99)
    size: int = 2048

    def parameters(self) -> np.ndarray:
        """Return (size, 4): PARAMETERS of each block."""
        share = qmc.Sobol(4, seed=0).random(self.size)
        (low, high), (slow, fast) = self.uplift_multiplier, self.frequency_parameter
        lift = low * (high / low) ** share[:, 0]
        ratio = np.sqrt(self.side_ratio) ** (2 * share[:, 1] - 1)
        frequency = slow * (fast / slow) ** share[:, 2]
        least, most = self.restitution
        return np.column_stack([lift * ratio, lift / ratio, frequency, least + share[:, 3] * (most - least)])


@dataclass(frozen=True, eq=False)
class Identification:
    """What the tests say of a structure: candidates and the share of each in the population.

    parameters: (m, 4) PARAMETERS of the candidates. mixture: their weights, and how the fit was made. processed: what
    each record went and goes through.
    """

    parameters: np.ndarray
    mixture: Mixture
    processed: Motion

    def overturning_probabilities(self, records: Iterable[Accelerogram]) -> np.ndarray:
        """Return (n,) P of overturning under each of `records`; every candidate is followed, by its weight."""
        blocks = [two_sided_block(*row) for row in self.parameters.tolist()]
        return self.mixture.probability(overturning_table(blocks, map(self.processed, records)))

    def ranges(self) -> Mapping[str, tuple[float, float, float]]:
        """Return 5 %, 50 % and 95 % of PARAMETERS over the population."""
        ends = np.quantile(
            self.parameters, LEVELS, axis=0, weights=self.mixture.weights, method="inverted_cdf"
        )
        return {name: tuple(own) for name, own in zip(PARAMETERS, ends.T.tolist(), strict=True)}


def identify(
    records: Sequence[Accelerogram],
    outcomes: Sequence[bool],
    prior: BlockPrior,
    *,
    motions: Sequence[str] | None = None,
    processed: Motion = lambda record: record,
) -> Identification:
    """Identify a structure from tests that ended standing (False) or overturned (True).

    records: (n,) what the base of the structure did in each test. motions: (n,) label of the input motion of each
    test; tests with one label are left out together when the fit chooses how far to trust itself (default: each test is
    a motion of its own). processed: what each record goes through first, here and in predictions.

    Every candidate is followed through every record; the weights are those of docs.research.mixture. With few tests, or
    tests that nearly all end alike, the ranges stay near the prior's. What was identified holds for motions like those
    of the tests. Raises ConfigurationError when the sequences differ in length or are empty.
    """
    labels = list(motions or map(str, range(len(records))))
    if not len(records) == len(outcomes) == len(labels) > 0:
        raise ConfigurationError(
            f"there are {len(records)} records, {len(outcomes)} outcomes and {len(labels)} motions, but there must be "
            "one of each for every test, and at least one test."
        )
    parameters = prior.parameters()
    blocks = [two_sided_block(*row) for row in parameters.tolist()]
    table = overturning_table(blocks, map(processed, records))
    return Identification(parameters, fit_mixture(table, np.asarray(outcomes, dtype=bool), labels), processed)


def overturning_table(blocks: Sequence[EquivalentBlock], motions: Iterable[Accelerogram]) -> np.ndarray:
    """Return (n, m) whether each block overturns under each motion; the motions may come one by one."""
    rows = [np.isinf(integrate_batch(blocks, motion)[:, 0]) for motion in motions]
    return np.array(rows, dtype=bool).reshape(len(rows), len(blocks))


def two_sided_block(
    positive_multiplier: float, negative_multiplier: float, frequency_parameter: float, restitution: float
) -> EquivalentBlock:
    """Return the block that lifts at λ of each side; φ_cr = atan λ, as of a rigid body on two contact lines."""
    positive, negative = (
        EquivalentBlock(
            frequency_parameter,
            critical_rotation=float(np.arctan(each)),
            acceleration_scale=float(np.arctan(each)) / each,
            restitution=restitution,
        )
        for each in (positive_multiplier, negative_multiplier)
    )
    return replace(positive, other_side=negative)
