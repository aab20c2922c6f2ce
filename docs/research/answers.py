"""What `fidelity: auto` does on sites that its tiers have not seen: where it stops, what it costs, where it errs."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from time import process_time
from typing import TypeVar

from docs.research import scores
from docs.research.tier_cases import TierCase, structures_tried
from docs.research.tier_fit import fit_tier, known, ratios_of, sites_of
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.fidelity import Answer, Limits, cheapest_answer, find_limits
from rocking.assessment.intensity import Shape
from rocking.assessment.method import Method
from rocking.assessment.tiers import Tier, TierFit
from rocking.assessment.verdict import Verdict
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.tables import Row, column, row

RISK = 0.01
FACTORS = (0.5, 1.0, 2.0)
REPLICATES = 500

Found = TypeVar("Found")


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
    """One structure under one record: what answered, the truths, and the CPU time of each [s].

    alone: where the mechanism is the last that is asked. beside: where an ensemble follows. truth: rotation ratio of
    the case as given. share: of the members of its ensemble that overturn. quick_verdict: of one that may end early.
    """

    site: str
    alone: Answer
    beside: Answer
    truth: float
    share: float
    verdict: Verdict
    quick_verdict: Verdict
    alone_s: float
    beside_s: float
    mechanism_s: float
    ensemble_s: float
    quick_s: float


def try_answers(
    records: Iterable[tuple[str, str, Accelerogram]], cases: Sequence[TierCase]
) -> Iterator[AnswerTrial]:
    """Yield a trial of each structure at each factor on the first component of each site, with tiers fitted without it.

    records: as `independent` gives them. cases: of all of them.
    """
    mechanisms = [structure.mechanism() for structure in structures_tried().values()]
    ratios, sites = ratios_of(cases), sites_of(cases)
    terms = {tier: known(cases, tier) for tier in (Tier.PEAK_VELOCITY, Tier.BLOCK_AT_FIVE_SCALES)}
    first = {site: record for _, site, record in reversed(list(records))}
    for site, record in first.items():
        kept = sites != site
        fits = {tier: fit_tier(tier, each[kept], ratios[kept], sites[kept]) for tier, each in terms.items()}
        limits = [find_limits(mechanism, RISK, fits) for mechanism in mechanisms]
        for factor in FACTORS:
            motion = record.scaled(factor)
            started = process_time()
            shape = Shape.of(motion)
            each = (process_time() - started) / len(mechanisms)
            for mechanism, own in zip(mechanisms, limits, strict=True):
                yield _trial(site, mechanism, shape, own, fits, each)


def _trial(
    site: str,
    mechanism: Mechanism,
    shape: Shape,
    limits: Limits,
    fits: Mapping[Tier, TierFit],
    shape_s: float,
) -> AnswerTrial:
    record = shape.accelerogram
    truth, whole_s = _timed(lambda: integrate(mechanism, record))
    alone, alone_s = _timed(lambda: cheapest_answer(mechanism, shape, risk=RISK, limits=limits))
    beside, beside_s = _timed(
        lambda: cheapest_answer(mechanism, shape, risk=RISK, ensemble_follows=True, limits=limits, fits=fits)
    )
    motions = GroundMotions.of(record)
    sure, many_s = _timed(lambda: ensemble(mechanism, motions))
    quick, quick_s = _timed(lambda: ensemble(mechanism, motions, verdict_only=True))
    return AnswerTrial(
        site=site,
        alone=alone,
        beside=beside,
        truth=truth.rotation_ratio,
        share=sure.overturning_probability,
        verdict=sure.verdict,
        quick_verdict=quick.verdict,
        alone_s=alone_s + shape_s,
        beside_s=beside_s + shape_s,
        mechanism_s=whole_s,
        ensemble_s=many_s,
        quick_s=quick_s,
    )


def _timed(call: Callable[[], Found]) -> tuple[Found, float]:
    """What a call returns, and its CPU time the second time."""
    call()
    started = process_time()
    return call(), process_time() - started


Measure = Callable[[Sequence[AnswerTrial]], float]


def answer_scores(trials: Sequence[AnswerTrial], replicates: int = REPLICATES) -> list[AnswerScore]:
    """Return every measure with its interval."""
    sites = [trial.site for trial in trials]
    draws = scores.resampled(sites, replicates)
    counts = {"trials": len(trials), "sites": len(set(sites))}
    return [
        AnswerScore(
            measure=name, **scores.scored(scores.of_cases(measure, trials), len(trials), draws), **counts
        )
        for name, measure in MEASURES.items()
    ]


def _share(
    which: Callable[[AnswerTrial], float], among: Callable[[AnswerTrial], bool] = lambda trial: True
) -> Measure:
    def measure(trials: Sequence[AnswerTrial]) -> float:
        chosen = [trial for trial in trials if among(trial)]
        return sum(map(which, chosen)) / len(chosen) if chosen else math.nan

    return measure


def _by(method: Method) -> Callable[[AnswerTrial], bool]:
    return lambda trial: trial.beside.method is method


def _settled(trial: AnswerTrial) -> bool:
    return trial.beside.method in (Method.PEAK_VELOCITY, Method.BLOCK_ON_RECORD)


def _overturns(answer: Answer) -> bool:
    return math.isinf(answer.rotation_ratio)


def _wrong(trial: AnswerTrial) -> bool:
    return _overturns(trial.beside) != math.isinf(trial.truth)


def _unsafe(trial: AnswerTrial) -> bool:
    return _wrong(trial) and not _overturns(trial.beside)


def _members_against(trial: AnswerTrial) -> float:
    return 1 - trial.share if _overturns(trial.beside) else trial.share


def _opposite(trial: AnswerTrial) -> bool:
    return trial.verdict is (Verdict.STANDS if _overturns(trial.beside) else Verdict.OVERTURNS)


def _saved_of_mechanism(trials: Sequence[AnswerTrial]) -> float:
    return 1 - sum(t.alone_s for t in trials) / sum(t.mechanism_s for t in trials)


def _saved_of_ensemble(trials: Sequence[AnswerTrial]) -> float:
    """With the ensemble asked for: it is made, ending early, where nothing cheap settled the case."""
    made = [t.quick_s if t.beside.method is Method.MECHANISM_ON_RECORD else 0.0 for t in trials]
    spent = sum(t.beside_s for t in trials) + sum(made)
    return 1 - spent / sum(t.mechanism_s + t.ensemble_s for t in trials)


MEASURES: dict[str, Measure] = {
    "share at rest": _share(_by(Method.NOTHING_TO_INTEGRATE)),
    "share settled by the peak velocity": _share(_by(Method.PEAK_VELOCITY)),
    "share settled by the block": _share(_by(Method.BLOCK_ON_RECORD)),
    "members against the verdict where the peak velocity settles": _share(
        _members_against, _by(Method.PEAK_VELOCITY)
    ),
    "members against the verdict where the block settles": _share(
        _members_against, _by(Method.BLOCK_ON_RECORD)
    ),
    "wrong verdicts among all without an ensemble": _share(
        lambda trial: _overturns(trial.alone) != math.isinf(trial.truth)
    ),
    "wrong verdicts among those settled": _share(_wrong, _settled),
    "overturnings called standing among those settled": _share(_unsafe, _settled),
    "opposite verdict of the ensemble among those settled": _share(_opposite, _settled),
    "undecided in the ensemble among those settled": _share(
        lambda trial: trial.verdict is Verdict.UNDECIDED, _settled
    ),
    "verdicts of the ensemble that its early end changes": _share(
        lambda trial: trial.quick_verdict is not trial.verdict
    ),
    "CPU saved of the mechanism for all": _saved_of_mechanism,
    "CPU saved of mechanism and ensemble for all": _saved_of_ensemble,
}
"""Name, and how it is computed."""
