"""What `fidelity: auto` does on sites that its tiers have not seen: where it stops, what it costs, where it errs."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from time import process_time

import numpy as np

from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.fidelity import Limits, cheapest_answer, find_limits
from rocking.assessment.intensity import Shape
from rocking.assessment.method import Method
from rocking.assessment.tiers import Tier
from rocking.assessment.verdict import Verdict
from rocking.calibration.tier_cases import TierCase, structures_tried
from rocking.calibration.tier_fit import fit_tier, known, ratios_of, sites_of
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.tables import Row, column, row

RISK = 0.01
FACTORS = (0.5, 1.0, 2.0)
REPLICATES = 500
_CHEAP = (Method.NOTHING_TO_INTEGRATE, Method.PEAK_VELOCITY)


@row(
    "tier_answers",
    "One row per measure of fidelity: auto on sites left out, with a 90 % interval by site",
)
class AnswerScore(Row):
    """One measure."""

    measure: str = column("What was measured; CPU times differ between runs")
    value: float = column("Its value")
    value_low: float = column("5 % quantile over resampled sites")
    value_high: float = column("95 % quantile over resampled sites")
    trials: int = column("Records times structures times factors behind it")
    sites: int = column("Sites behind it")


@dataclass(frozen=True)
class AnswerTrial:
    """One structure under one record: what answered, the truths, and the CPU time of each [s]."""

    site: str
    method: Method
    overturns: bool
    truth: float
    ensemble: Verdict
    answer_s: float
    mechanism_s: float
    ensemble_s: float


def try_answers(
    records: Iterable[tuple[str, str, Accelerogram]], cases: Sequence[TierCase]
) -> Iterator[AnswerTrial]:
    """Yield a trial of each structure at each factor on the first component of each site, with tiers fitted without it.

    records: as `independent` gives them. cases: of all of them.
    """
    mechanisms = [structure.mechanism() for structure in structures_tried().values()]
    terms, ratios, sites = known(cases, Tier.PEAK_VELOCITY), ratios_of(cases), sites_of(cases)
    first = {site: record for _, site, record in reversed(list(records))}
    for site, record in first.items():
        kept = sites != site
        fits = {Tier.PEAK_VELOCITY: fit_tier(Tier.PEAK_VELOCITY, terms[kept], ratios[kept], sites[kept])}
        limits = [find_limits(mechanism, RISK, fits) for mechanism in mechanisms]
        for factor in FACTORS:
            motion = record.scaled(factor)
            started = process_time()
            shape = Shape.of(motion)
            each = (process_time() - started) / len(mechanisms)
            for mechanism, own in zip(mechanisms, limits, strict=True):
                yield _trial(site, mechanism, shape, own, each)


def _trial(site: str, mechanism: Mechanism, shape: Shape, limits: Limits, shape_s: float) -> AnswerTrial:
    record = shape.accelerogram
    truth = integrate(mechanism, record)
    times = [process_time()]
    integrate(mechanism, record)
    times.append(process_time())
    found = cheapest_answer(mechanism, shape, risk=RISK, limits=limits)
    times.append(process_time())
    sure = ensemble(mechanism, GroundMotions.of(record))
    times.append(process_time())
    whole, own, many = np.diff(times).tolist()
    return AnswerTrial(
        site=site,
        method=found.method,
        overturns=math.isinf(found.rotation_ratio),
        truth=truth.rotation_ratio,
        ensemble=sure.verdict,
        answer_s=own + shape_s,
        mechanism_s=whole,
        ensemble_s=many,
    )


def answer_scores(trials: Sequence[AnswerTrial], replicates: int = REPLICATES) -> list[AnswerScore]:
    """Return every measure with its interval."""
    groups = [[t for t in trials if t.site == site] for site in sorted({t.site for t in trials})]
    rng = np.random.default_rng(0)
    draws = [
        [t for place in rng.integers(len(groups), size=len(groups)) for t in groups[place]]
        for _ in range(replicates)
    ]
    scores = []
    for name, measure in MEASURES.items():
        values = [value for draw in draws if not math.isnan(value := measure(draw))]
        scores.append(
            AnswerScore(
                measure=name,
                value=measure(trials),
                value_low=float(np.quantile(values, 0.05)) if values else math.nan,
                value_high=float(np.quantile(values, 0.95)) if values else math.nan,
                trials=len(trials),
                sites=len(groups),
            )
        )
    return scores


def _share(which: Callable[[AnswerTrial], bool], among: Callable[[AnswerTrial], bool]):  # type: ignore[no-untyped-def]
    def measure(trials: Sequence[AnswerTrial]) -> float:
        chosen = [trial for trial in trials if among(trial)]
        return sum(map(which, chosen)) / len(chosen) if chosen else math.nan

    return measure


def _wrong(trial: AnswerTrial) -> bool:
    return trial.overturns != math.isinf(trial.truth)


def _unsafe(trial: AnswerTrial) -> bool:
    return _wrong(trial) and not trial.overturns


def _settled(trial: AnswerTrial) -> bool:
    return trial.method is Method.PEAK_VELOCITY


def _opposite(trial: AnswerTrial) -> bool:
    return trial.ensemble is (Verdict.STANDS if trial.overturns else Verdict.OVERTURNS)


def _undecided(trial: AnswerTrial) -> bool:
    return trial.ensemble is Verdict.UNDECIDED


def _any(_: AnswerTrial) -> bool:
    return True


def _saved_of_mechanism(trials: Sequence[AnswerTrial]) -> float:
    return 1 - sum(t.answer_s for t in trials) / sum(t.mechanism_s for t in trials)


def _saved_of_ensemble(trials: Sequence[AnswerTrial]) -> float:
    """With the ensemble asked for: it is made where nothing cheap settled the case."""
    spent = sum(t.answer_s + (t.ensemble_s if t.method not in _CHEAP else 0.0) for t in trials)
    return 1 - spent / sum(t.mechanism_s + t.ensemble_s for t in trials)


MEASURES: dict[str, Callable[[Sequence[AnswerTrial]], float]] = {
    "share at rest": _share(lambda t: t.method is Method.NOTHING_TO_INTEGRATE, _any),
    "share settled by the peak velocity": _share(_settled, _any),
    "wrong verdicts among those that the peak velocity settles": _share(_wrong, _settled),
    "wrong verdicts among all": _share(_wrong, _any),
    "overturnings called standing among all": _share(_unsafe, _any),
    "CPU saved of the mechanism for all": _saved_of_mechanism,
    "CPU saved of mechanism and ensemble for all": _saved_of_ensemble,
    "opposite verdict of the ensemble where the peak velocity settles": _share(_opposite, _settled),
    "undecided in the ensemble where the peak velocity settles": _share(_undecided, _settled),
}
"""Name, and how it is computed."""
