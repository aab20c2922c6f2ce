"""What is not known of a structure, identified from tests of it that ended standing or overturned."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from docs.research.mixture import Mixture, equal_members, fit_mixture
from rocking.errors import ConfigurationError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import Rocking, reduce
from rocking.quantities import within
from rocking.records import Accelerogram
from rocking.records.processing import Processing, process
from rocking.structures import EquivalentBlock

MEMBERS = 25
"""Blocks that a prediction follows; an odd number, so that half of them never says yes."""
PARAMETERS = (
    "uplift_multiplier_positive",
    "uplift_multiplier_negative",
    "frequency_parameter",
    "restitution",
)
"""What is identified of a block with two sides, in the order of its ranges."""
LEVELS = (0.05, 0.5, 0.95)
"""Quantiles that a range gives."""


@dataclass(frozen=True)
class BlockPrior:
    """What may be true of a rigid body on two contact lines before any test: a box, even in the logarithms (η: even).

    uplift_multiplier: λ, geometric mean of the two sides, -. frequency_parameter: p, rad/s, the same on both sides.
    side_ratio: largest λ of one side over the other's, ≥ 1. restitution: η. Each but the ratio (lowest, highest).
    size: number of blocks that fill the box, evenly (Sobol), a power of two. seed: of their scrambling.
    Raises ConfigurationError for a range out of order or out of bounds.
    """

    uplift_multiplier: tuple[float, float]
    frequency_parameter: tuple[float, float]
    side_ratio: float = 1.5
    restitution: tuple[float, float] = (0.7, 0.99)
    size: int = 2048
    seed: int = 0

    def __post_init__(self) -> None:
        limits = {"uplift_multiplier": 10.0, "frequency_parameter": 1e3, "restitution": 1.0}
        for name, highest in limits.items():
            low, high = getattr(self, name)
            within(ConfigurationError, f"{name}, lowest", low, 1e-6, highest)
            within(ConfigurationError, f"{name}, highest", high, low, highest)
        within(ConfigurationError, "side_ratio", self.side_ratio, 1, 100)
        if self.size < 2 or self.size & (self.size - 1):
            raise ConfigurationError(f"size is {self.size!r}, but must be a power of two.")

    def parameters(self) -> np.ndarray:
        """Return (size, 4): PARAMETERS of each block."""
        from scipy.stats import qmc  # slow to import, and needed by the fit only

        share = qmc.Sobol(4, seed=self.seed).random(self.size)
        lift = _between(self.uplift_multiplier, share[:, 0])
        ratio = np.sqrt(self.side_ratio) ** (2 * share[:, 1] - 1)
        frequency = _between(self.frequency_parameter, share[:, 2])
        low, high = self.restitution
        return np.column_stack([lift * ratio, lift / ratio, frequency, low + share[:, 3] * (high - low)])

    def blocks(self) -> tuple[EquivalentBlock, ...]:
        """Return the blocks."""
        return tuple(two_sided_block(*row) for row in self.parameters().tolist())


@dataclass(frozen=True, eq=False)
class Identification:
    """What the tests say of a structure: a population of candidates, and the few that stand for it in predictions.

    candidates: (m,) everything that was tried. mixture: their weights, and how the fit was made. members: indices of
    the candidates that a prediction follows, all with the same weight. processing: what each record went and goes
    through; None: nothing.
    """

    candidates: tuple[Rocking, ...]
    mixture: Mixture
    members: np.ndarray
    processing: Processing | None = None

    def overturning_probability(self, record: Accelerogram) -> float:
        """Return P that the structure overturns under `record`, processed as those of the fit were."""
        return float(self.overturning_probabilities([record])[0])

    def overturning_probabilities(self, records: Iterable[Accelerogram]) -> np.ndarray:
        """Return (n,) P of overturning under each of `records`."""
        distinct, count = np.unique(self.members, return_counts=True)
        blocks = [self.candidates[j] for j in distinct]
        share = overturning_table(blocks, records, self.processing) @ (count / count.sum())
        return self.mixture.of_share(share)

    def parameters(self) -> np.ndarray:
        """Return (m, 4): PARAMETERS of each candidate, which must be an EquivalentBlock; else ConfigurationError."""
        return np.array([_parameters_of(candidate) for candidate in self.candidates])

    def ranges(self) -> Mapping[str, tuple[float, float, float]]:
        """Return, for equivalent blocks, 5 %, 50 % and 95 % of PARAMETERS over the population.

        Raises ConfigurationError when a candidate is no EquivalentBlock.
        """
        values = self.parameters()
        low, middle, high = (_quantile(values, self.mixture.weights, level) for level in LEVELS)
        ranges = zip(low.tolist(), middle.tolist(), high.tolist(), strict=True)
        return dict(zip(PARAMETERS, ranges, strict=True))


def identify(
    records: Sequence[Accelerogram],
    outcomes: Sequence[bool],
    prior: BlockPrior | Sequence[Rocking],
    *,
    motions: Sequence[str] | None = None,
    processing: Processing | None = None,
    members: int = MEMBERS,
    workers: int | None = None,
) -> Identification:
    """Identify a structure from tests that ended standing (False) or overturned (True).

    records: (n,) what the base of the structure did in each test. prior: blocks to be tried as a BlockPrior, or
    any structures, drawn so that they stand for what is held possible. motions: (n,) label of the input motion of
    each test; tests with one label are left out together when the fit chooses how far to trust itself (default: each
    test is a motion of its own). processing: what each record goes through first, here and in predictions.
    members: structures that a prediction follows. workers: threads.

    Every candidate is followed through every record (`integrate_batch`); the weights are those of
    `docs.research.mixture`. With few tests, or tests that nearly all end alike, the ranges stay near the prior's:
    look at them. What was identified holds for motions like those of the tests.
    Raises ConfigurationError when the sequences differ in length or are empty.
    """
    structures = prior.blocks() if isinstance(prior, BlockPrior) else tuple(prior)
    labels = [str(k) for k in range(len(records))] if motions is None else list(motions)
    if not len(records) == len(outcomes) == len(labels) > 0:
        raise ConfigurationError(
            f"there are {len(records)} records, {len(outcomes)} outcomes and {len(labels)} motions, but there must be "
            "one of each for every test, and at least one test."
        )
    table = overturning_table(structures, records, processing, workers)
    return identification_of(table, np.asarray(outcomes, dtype=bool), labels, structures, processing, members)


def identification_of(
    overturns: np.ndarray,
    outcomes: np.ndarray,
    motions: Sequence[str],
    candidates: tuple[Rocking, ...],
    processing: Processing | None = None,
    members: int = MEMBERS,
) -> Identification:
    """`identify` from a table of verdicts (n, m) that is there already."""
    mixture = fit_mixture(overturns, outcomes, motions)
    return Identification(candidates, mixture, equal_members(overturns, mixture.weights, members), processing)


def overturning_table(
    structures: Sequence[Rocking],
    records: Iterable[Accelerogram],
    processing: Processing | None = None,
    workers: int | None = None,
) -> np.ndarray:
    """Return (n, m) whether each structure overturns under each record; the records may come one by one.

    Raises ConfigurationError when a case cannot be integrated.
    """
    reduced = [reduce(structure) for structure in structures]
    rows = []
    for record in records:
        motion = record if processing is None else process(record, processing)
        ratios = integrate_batch(reduced, motion, workers=workers)[:, 0]
        if np.isnan(ratios).any():
            raise ConfigurationError(
                f"candidate {int(np.argmax(np.isnan(ratios)))} cannot be followed through "
                f"{record.source.path or 'a record'}; integrate says why."
            )
        rows.append(np.isinf(ratios))
    return np.array(rows, dtype=bool).reshape(len(rows), len(reduced))


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


def _parameters_of(candidate: Rocking) -> tuple[float, float, float, float]:
    if not isinstance(candidate, EquivalentBlock):
        raise ConfigurationError(
            f"a candidate is a {type(candidate).__name__}, but ranges are known of equivalent blocks only; "
            "weigh its own parameters with mixture.weights."
        )
    other = candidate.other_side or candidate
    multipliers = (candidate.uplift_multiplier, other.uplift_multiplier)
    return (*multipliers, candidate.frequency_parameter, candidate.restitution)


def _between(bounds: tuple[float, float], share: np.ndarray) -> np.ndarray:
    """Even in the logarithm."""
    low, high = bounds
    return low * (high / low) ** share


def _quantile(values: np.ndarray, weights: np.ndarray, level: float) -> np.ndarray:
    """Quantile of each column under the weights of the rows."""
    order = np.argsort(values, axis=0, kind="stable")
    reached = np.cumsum(weights[order], axis=0) >= level - 1e-9
    return np.take_along_axis(values, order, axis=0)[reached.argmax(axis=0), np.arange(values.shape[1])]
