"""Fragility from few runs of the mechanism: the equivalent block under every record says where they are worth most.

The block is followed at every level of every record, the mechanism in cases drawn at random. What the block says of a
case, y, is corrected by what the mechanism says in those drawn, (z − y)/π with π the probability of being drawn, so
that the expectation of the curve is that of the mechanism in every case, whatever the block says (the difference
estimator of Särndal, Swensson & Wretman 1992, section 6.3). π goes with the deviation that the outcomes of the block at
the levels around lead one to expect (Neyman's allocation), and the cases are drawn systematically, which spreads them
over the records and the levels.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import process_time

import numpy as np
from scipy.special import ndtr

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility.analysis import IncrementalDynamicAnalysis, measured
from rocking.assessment.fragility.cases import MEMBERS, Cases
from rocking.assessment.fragility.curve import Fragility, fragility_of
from rocking.assessment.fragility.settings import FEWEST_RUNS
from rocking.errors import ConfigurationError
from rocking.motion.integration import Rocking
from rocking.records import Accelerogram

_SPANS = (0.05, 0.15, 0.4)
"""Of the logarithm of the level, over which the outcomes of the block are averaged: from what differs between it and
the mechanism for the same record to what differs between records."""
_LEAST_DEVIATION = 0.1
"""Of a case in which the block never differs around: what it cannot foresee is drawn too, with weights of at most five
times those of the most doubtful cases."""


@dataclass(frozen=True, eq=False, repr=False)
class MultiFidelityAnalysis:
    """The block in every case, (r, k), and the mechanism in those that were drawn.

    block: of the equivalent block. inclusion: (r, k) probability of being drawn. rotation_ratios: (r, k) of the
    mechanism, or of one member of its ensemble; nan where it was not drawn. block_seconds, mechanism_seconds: CPU time.
    """

    block: IncrementalDynamicAnalysis
    inclusion: np.ndarray
    rotation_ratios: np.ndarray
    block_seconds: float
    mechanism_seconds: float

    @property
    def followed(self) -> IncrementalDynamicAnalysis:
        """The mechanism where it was followed."""
        return replace(self.block, rotation_ratios=self.rotation_ratios[:, :, None])

    @property
    def mechanism_runs(self) -> int:
        """How often the mechanism was followed."""
        return int((~np.isnan(self.rotation_ratios)).sum())

    def fragility(self, threshold: float = np.inf) -> Fragility:
        """Return the curve of exceeding a rotation ratio; inf: of overturning."""
        blocks = _exceeds(self.block.rotation_ratios[:, :, 0], threshold)
        drawn = ~np.isnan(self.rotation_ratios)
        outcomes = np.where(drawn, _exceeds(self.rotation_ratios, threshold), 0.0)
        expected = corrected(self.block.levels, blocks, drawn, outcomes, self.inclusion)
        found = fragility_of(
            self.block.levels,
            expected,
            self.block.stations,
            measure=self.block.measure.name,
            unit=self.block.measure.unit,
            threshold=threshold,
            sampled_of=self.block.fragility(threshold),
        )
        return replace(
            found, exceedance=np.where(drawn, outcomes, blocks), mechanism_runs=self.mechanism_runs
        )


def multi_fidelity_analysis(
    records: Sequence[Accelerogram],
    structure: Rocking,
    mechanism_runs: int,
    *,
    intensity_measure: str = "pga",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    ensemble: EnsembleSettings | None = None,
    tolerance: float = 1e-6,
    seed: int = 0,
) -> MultiFidelityAnalysis:
    """Follow the block of `structure` through `records` at every level, and the mechanism in `mechanism_runs` cases.

    With an ensemble each case drawn is one of its members, by chance. seed: of the draw. The rest is as for
    `incremental_dynamic_analysis`, levels adapting to the block. Raises ConfigurationError, also for fewer than
    FEWEST_RUNS runs, or more than there are cases.
    """
    mechanism, measure, intensities, names = measured(records, structure, intensity_measure, stations)
    started = process_time()
    cheap = Cases(records, mechanism.equivalent_block("rest"), intensities, None, tolerance)
    chosen, ratios = cheap.at(levels)
    block = IncrementalDynamicAnalysis(measure, chosen, ratios, intensities, names)
    halfway = process_time()
    rng = np.random.default_rng(seed)
    chance = inclusion(chosen, _exceeds(ratios[:, :, 0], np.inf), _checked_runs(mechanism_runs, ratios))
    drawn = systematic_draw(chance, rng)
    dear = Cases(records, mechanism, intensities, ensemble, tolerance)
    found = _followed(dear, chosen, drawn, rng.integers(MEMBERS, size=drawn.shape))
    return MultiFidelityAnalysis(block, chance, found, halfway - started, process_time() - halfway)


def inclusion(levels: np.ndarray, blocks: np.ndarray, runs: int) -> np.ndarray:
    """Return the probability of each case to be drawn, (r, k), their sum being `runs`; blocks: 1 where it exceeds."""
    share = _averaged(levels, blocks)
    size = np.maximum(np.sqrt(share * (1 - share)), _LEAST_DEVIATION)
    chance = size * (runs / size.sum())
    while np.any(chance > 1 + 1e-12):
        certain = chance >= 1
        rest = (runs - certain.sum()) / size[~certain].sum()
        chance = np.where(certain, 1.0, size * rest)
    return np.asarray(chance)


def systematic_draw(chance: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Draw as many cases as the sum of `chance` (r, k), each with its own, spread over records in random order."""
    order = rng.permutation(len(chance))
    passed = np.concatenate([[0.0], np.cumsum(chance[order])])
    steps = np.floor(passed + rng.random())
    drawn = np.empty(chance.shape, dtype=bool)
    drawn[order] = (np.diff(steps) > 0).reshape(chance.shape)
    return drawn


def corrected(
    levels: np.ndarray, blocks: np.ndarray, drawn: np.ndarray, outcomes: np.ndarray, chance: np.ndarray
) -> np.ndarray:
    """Return what each case, (r, k), adds to the curve: what the block says, corrected where the mechanism was drawn.

    blocks, outcomes: 1 where block and mechanism exceed; the latter is read where drawn only.
    """
    said = (blocks + _averaged(levels, blocks)) / 2
    return np.asarray(said + np.where(drawn, (outcomes - said) / chance, 0.0))


def _averaged(levels: np.ndarray, blocks: np.ndarray) -> np.ndarray:
    """Share of the levels around each, in the logarithm, at which the block exceeds: the mean over _SPANS, (r, k)."""
    logs = np.log(levels)
    edges = np.concatenate([[-np.inf], (logs[1:] + logs[:-1]) / 2, [np.inf]])
    weights = sum(np.diff(ndtr((edges[None, :] - logs[:, None]) / span), axis=1) for span in _SPANS)
    return np.clip(blocks @ np.asarray(weights).T / len(_SPANS), 0.0, 1.0)


def _exceeds(ratios: np.ndarray, threshold: float) -> np.ndarray:
    return np.asarray(np.isinf(ratios) if np.isinf(threshold) else ratios > threshold, dtype=float)


def _followed(cases: Cases, levels: np.ndarray, drawn: np.ndarray, members: np.ndarray) -> np.ndarray:
    """(r, k) of the mechanism where drawn, nan elsewhere."""
    found = np.full(drawn.shape, np.nan)
    for record, here in enumerate(drawn):
        if here.any():
            ratios = cases.members_at(record, levels[here], members[record, here])
            found[record, here] = cases.followed(record, ratios)
    return found


def _checked_runs(runs: int, ratios: np.ndarray) -> int:
    cases = ratios.shape[0] * ratios.shape[1]
    if not FEWEST_RUNS <= runs <= cases:
        raise ConfigurationError(
            f"mechanism_runs is {runs}, but must lie between {FEWEST_RUNS} and the {cases} cases there are."
        )
    return int(runs)
