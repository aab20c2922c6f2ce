"""What `fidelity: auto` does on sites that its tiers have not seen: where it stops, what it costs, where it errs."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from time import process_time
from typing import Protocol, TypeVar

import numpy as np

from docs.research import scores
from docs.research.sites import structures_tried
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.fidelity import Answer, cheapest_answer
from rocking.assessment.intensity import peak_velocity
from rocking.assessment.method import Method
from rocking.assessment.tiers import Tier, TierFit
from rocking.assessment.verdict import Verdict
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism

RISK = 0.01
FACTORS = (0.5, 1.0, 2.0)

T = TypeVar("T")


class Fits(Protocol):
    """Cases at sites (n,) to which a tier can be fitted, or to some of them."""

    sites: np.ndarray

    def fit(self, tier: Tier, kept: np.ndarray) -> TierFit: ...


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


def try_answers(records: Iterable[tuple[str, str, Accelerogram]], cases: Fits) -> Iterator[AnswerTrial]:
    """Yield a trial of each structure at each factor on the first component of each site, with tiers fitted without it.

    records: as `independent` gives them. cases: of all of them.
    """
    mechanisms = [structure.mechanism() for structure in structures_tried().values()]
    first = {site: record for _, site, record in reversed(list(records))}
    for site, record in first.items():
        fits = {
            tier: cases.fit(tier, cases.sites != site)
            for tier in (Tier.PEAK_VELOCITY, Tier.BLOCK_AT_FIVE_SCALES)
        }
        for factor in FACTORS:
            motion = record.scaled(factor)
            _, velocity_s = _timed(partial(peak_velocity, motion))
            for mechanism in mechanisms:
                yield _trial(site, mechanism, motion, fits, velocity_s / len(mechanisms))


def _trial(
    site: str,
    mechanism: Mechanism,
    record: Accelerogram,
    fits: Mapping[Tier, TierFit],
    velocity_s: float,
) -> AnswerTrial:
    truth, mechanism_s = _timed(lambda: integrate(mechanism, record))
    alone, alone_s = _timed(lambda: cheapest_answer(mechanism, record, risk=RISK, fits=fits))
    beside, beside_s = _timed(
        lambda: cheapest_answer(mechanism, record, risk=RISK, ensemble_follows=True, fits=fits)
    )
    motions = GroundMotions.of(record)
    whole, ensemble_s = _timed(lambda: ensemble(mechanism, motions))
    quick, quick_s = _timed(lambda: ensemble(mechanism, motions, verdict_only=True))
    return AnswerTrial(
        site=site,
        alone=alone,
        beside=beside,
        truth=truth.rotation_ratio,
        share=whole.overturning_share,
        verdict=whole.verdict,
        quick_verdict=quick.verdict,
        alone_s=alone_s + velocity_s,
        beside_s=beside_s + velocity_s,
        mechanism_s=mechanism_s,
        ensemble_s=ensemble_s,
        quick_s=quick_s,
    )


def _timed(run: Callable[[], T]) -> tuple[T, float]:
    started = process_time()
    return run(), process_time() - started


def answer_scores(trials: Sequence[AnswerTrial], replicates: int = scores.REPLICATES) -> list[scores.Score]:
    """Return every measure with its interval."""
    measures: dict[str, scores.Measure] = {
        f"share answered by {method}": scores.mean(_each(trials, lambda t, m=method: t.beside.method is m))
        for method in (Method.NOTHING_TO_INTEGRATE, *SETTLING)
    }
    measures |= {
        f"members against the verdict of {method}": scores.mean(_each(trials, _members_against, (method,)))
        for method in SETTLING
    }
    measures |= {
        name: scores.mean(_each(trials, which, SETTLING)) for name, which in OF_THOSE_SETTLED.items()
    }
    measures["wrong verdicts among all without an ensemble"] = scores.mean(
        _each(trials, lambda t: _overturns(t.alone) != math.isinf(t.truth))
    )
    measures["verdicts of the ensemble that its early end changes"] = scores.mean(
        _each(trials, lambda t: t.quick_verdict is not t.verdict)
    )
    alone, beside, usual, dear = (
        np.array([getattr(t, name) for t in trials])
        for name in ("alone_s", "beside_s", "mechanism_s", "ensemble_s")
    )
    quick = _each(trials, lambda t: t.quick_s if t.beside.method is Method.MECHANISM_ON_RECORD else 0.0)
    measures["CPU saved of the mechanism for all"] = lambda rows: 1 - alone[rows].sum() / usual[rows].sum()
    measures["CPU saved of mechanism and ensemble for all"] = lambda rows: (
        1 - (beside + quick)[rows].sum() / (usual + dear)[rows].sum()
    )
    return scores.scored("fidelity: auto", "sites left out", measures, [t.site for t in trials], replicates)


def _each(
    trials: Sequence[AnswerTrial],
    which: Callable[[AnswerTrial], float],
    methods: Sequence[Method] = tuple(Method),
) -> np.ndarray:
    """Return (n,) of what `which` says of each trial, nan of those that none of `methods` answered."""
    return np.array([float(which(t)) if t.beside.method in methods else math.nan for t in trials])


def _overturns(answer: Answer) -> bool:
    return math.isinf(answer.rotation_ratio)


def _members_against(trial: AnswerTrial) -> float:
    return 1 - trial.share if _overturns(trial.beside) else trial.share


def _wrong(trial: AnswerTrial) -> bool:
    return _overturns(trial.beside) != math.isinf(trial.truth)


SETTLING = (Method.PEAK_VELOCITY, Method.BLOCK_ON_RECORD)
OF_THOSE_SETTLED: Mapping[str, Callable[[AnswerTrial], float]] = {
    "wrong verdicts among those settled": _wrong,
    "overturnings called standing among those settled": lambda t: _wrong(t) and not _overturns(t.beside),
    "opposite verdict of the ensemble among those settled": lambda t: (
        t.verdict is (Verdict.STANDS if _overturns(t.beside) else Verdict.OVERTURNS)
    ),
    "undecided in the ensemble among those settled": lambda t: t.verdict is Verdict.UNDECIDED,
}
