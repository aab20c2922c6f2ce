"""The tiers: what a cheap figure says of overturning, fitted to real records and judged by leaving sites out."""

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.special import expit, logit

from docs.research import scores
from docs.research.answers import answer_scores, try_answers
from docs.research.report import publish
from docs.research.scores import Score
from docs.research.sites import independent, structures_tried
from rocking.assessment import fidelity
from rocking.assessment.ensemble import GroundMotions, drawn, lattice
from rocking.assessment.fidelity import NUDGES, Tier, TierFit, stays_at_rest
from rocking.assessment.fidelity import write_tiers as write_fits
from rocking.assessment.settings import EnsembleSettings
from rocking.motion import integrate_batch
from rocking.records import Accelerogram
from rocking.structures import Structure

FACTORS = (0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8)
"""On each record, so that it speaks for weaker and stronger shaking of the same shape."""
MEMBERS = 64
"""Of the ensemble of a case."""
BINS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0)


@dataclass(frozen=True, eq=False)
class TierCase:
    """A structure under a record times a factor: what is known of it by measure, and what becomes of it.

    share: of the members of its ensemble that overturn.
    """

    record: str
    site: str
    structure: str
    factor: float
    measures: Mapping[str, float]
    share: float


@dataclass(frozen=True, eq=False)
class TierCases:
    """All cases, and what they are as arrays."""

    cases: Sequence[TierCase]

    @cached_property
    def shares(self) -> np.ndarray:
        """(n,) share of the members that overturn."""
        return np.array([case.share for case in self.cases])

    @cached_property
    def sites(self) -> np.ndarray:
        """(n,) site of each."""
        return np.array([case.site for case in self.cases])

    def terms(self, tier: Tier) -> np.ndarray:
        """Return (n, k) of the terms that `tier` takes."""
        return np.array([[case.measures[term] for term in tier.terms] for case in self.cases])

    def fit(self, tier: Tier, kept: np.ndarray | slice = slice(None)) -> TierFit:
        """Return `tier` fitted to the cases `kept`, one of which weighs as much as another."""
        terms = self.terms(tier)[kept]
        centre, spread = terms.mean(axis=0), terms.std(axis=0)
        spread = np.where(spread > 0, spread, 1.0)
        design = np.column_stack([np.ones(len(terms)), (terms - centre) / spread])
        shares = self.shares[kept]
        fitted = scores.logistic(design, shares, self.sites[kept])
        lapse = scores.lapse(expit(design @ fitted[0]), shares)
        frequencies = [case.measures["frequency_parameter"] for case in self.cases]
        ends = min(frequencies), max(frequencies)
        return TierFit(tier, centre, spread, terms.min(axis=0), terms.max(axis=0), *fitted, ends, lapse)


def tier_cases(
    records: Iterable[tuple[str, str, Accelerogram]], structures: Mapping[str, Structure] | None = None
) -> Iterator[TierCase]:
    """Yield the cases of each record, as `independent` gives them, but those that rest as given, which is certain."""
    mechanisms = {name: s.mechanism() for name, s in (structures or structures_tried()).items()}
    blocks = [mechanism.equivalent_block("rest") for mechanism in mechanisms.values()]
    nudged = np.outer(FACTORS, NUDGES)
    for name, site, record in records:
        on_block = integrate_batch(blocks, record, nudged.ravel()).reshape(len(blocks), *nudged.shape)
        for k, (structure, mechanism) in enumerate(mechanisms.items()):
            own = fidelity.of_structure(mechanism)
            for i, factor in enumerate(FACTORS):
                motion = record.scaled(factor)
                if stays_at_rest(mechanism, motion):
                    continue
                points = lattice(MEMBERS)
                members = drawn(mechanism, GroundMotions.of(motion), points, EnsembleSettings())
                if not members.failed_members:
                    measures = fidelity.of_velocity(motion, blocks[k])
                    measures |= fidelity.from_nudged(on_block[k, i])
                    yield TierCase(name, site, structure, factor, own | measures, members.overturning_share)


def left_out(tier: Tier, cases: TierCases) -> np.ndarray:
    """Return the share (n,) that `tier` estimates of each case when it is fitted without the site of the case."""
    stated, terms = np.empty(len(cases.cases)), cases.terms(tier)
    for site in np.unique(cases.sites):
        out = cases.sites == site
        fit = cases.fit(tier, ~out)
        stated[out] = (1 - fit.lapse) * expit(fit.log_odds(terms[out])[0])
    return stated


def tier_scores(cases: TierCases, replicates: int = scores.REPLICATES) -> Iterator[Score]:
    """Yield the scores and the reliability of each tier on sites left out."""
    overturned, part = cases.shares, "sites left out"
    for tier in Tier:
        stated = left_out(tier, cases)
        odds = logit(stated)
        measures: dict[str, scores.Measure] = {
            "Brier skill": lambda rows, stated=stated: scores.brier_skill(stated[rows], overturned[rows]),
            "Brier skill of the shares themselves": lambda rows: scores.brier_skill(
                overturned[rows], overturned[rows]
            ),
            "calibration slope": lambda rows, odds=odds: scores.logit_slope(odds[rows], overturned[rows]),
        }
        yield from scores.scored(tier, part, measures, cases.sites, replicates)
        yield from scores.reliability(tier, part, stated, overturned, cases.sites, BINS, replicates)


def write_tiers(
    records: Iterable[tuple[str, Accelerogram]], folder: Path, replicates: int = scores.REPLICATES
) -> None:
    """Fit and judge every tier on `records`; write the fits and the scores into `folder`; tiers.json is what ships."""
    counted = list(independent(records))
    cases = TierCases(list(tier_cases(counted)))
    found = [*tier_scores(cases, replicates), *answer_scores(list(try_answers(counted, cases)), replicates)]
    about: dict[str, object] = {
        "records": len({case.record for case in cases.cases}),
        "sites": len(set(cases.sites)),
        "cases": len(cases.cases),
    }
    told = ", ".join(f"{many} {name}" for name, many in about.items())
    publish(folder, "What a cheap figure says of overturning", f"{told}.", {Score: found})
    hashes = "\n".join(sorted({record.source.sha256 for _, _, record in counted}))
    about["records_sha256"] = hashlib.sha256(hashes.encode()).hexdigest()
    write_fits(folder / "tiers.json", {tier: cases.fit(tier) for tier in Tier}, about)
