"""What `fidelity: auto` does on sites that its tiers have not seen: where it stops, what it costs, where it errs."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from docs.research import scores
from docs.research.sites import one_of_each, structures_tried, timed
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.fidelity import Answer, Tier, TierFit, cheapest_answer
from rocking.assessment.intensity import peak_velocity
from rocking.assessment.verdict import Method, Verdict
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism, Outcome

RISK = 0.01
FACTORS = (0.5, 1.0, 2.0)
SETTLING = (Method.PEAK_VELOCITY, Method.BLOCK_ON_RECORD)


@dataclass(frozen=True)
class AnswerTrial:
    """One structure under one record: what answered, the truths, and the CPU time of each [s].

    alone: where the mechanism is the last that is asked. beside: where an ensemble follows. overturns: of the case as
    given. share: of the members of its ensemble that overturn. quick_verdict: of one that may end early.
    """

    site: str
    alone: Answer
    beside: Answer
    overturns: bool
    share: float
    verdict: Verdict
    quick_verdict: Verdict
    alone_s: float
    beside_s: float
    mechanism_s: float
    ensemble_s: float
    quick_s: float


def try_answers(records: Iterable[tuple[str, str, Accelerogram]], cases: Any) -> Iterator[AnswerTrial]:
    """Yield a trial of each structure at each factor on the first component of each site, with tiers fitted without it.

    records: as `independent` gives them. cases: the TierCases of all of them.
    """
    mechanisms = [structure.mechanism() for structure in structures_tried().values()]
    for _, site, record in one_of_each(records):
        fits = {tier: cases.fit(tier, cases.sites != site) for tier in Tier}
        for motion in map(record.scaled, FACTORS):
            _, velocity_s = timed(lambda motion=motion: peak_velocity(motion))
            for mechanism in mechanisms:
                yield _trial(site, mechanism, motion, fits, velocity_s / len(mechanisms))


def _trial(
    site: str, mechanism: Mechanism, record: Accelerogram, fits: Mapping[Tier, TierFit], velocity_s: float
) -> AnswerTrial:
    motions = GroundMotions.of(record)
    asked = partial(cheapest_answer, mechanism, record, risk=RISK, fits=fits)
    truth, mechanism_s = timed(lambda: integrate(mechanism, record))
    alone, alone_s = timed(asked)
    beside, beside_s = timed(lambda: asked(ensemble_follows=True))
    whole, ensemble_s = timed(lambda: ensemble(mechanism, motions))
    quick, quick_s = timed(lambda: ensemble(mechanism, motions, verdict_only=True))
    return AnswerTrial(
        site=site,
        alone=alone,
        beside=beside,
        overturns=truth.outcome is Outcome.OVERTURNS,
        share=whole.overturning_share,
        verdict=whole.verdict,
        quick_verdict=quick.verdict,
        alone_s=alone_s + velocity_s,
        beside_s=beside_s + velocity_s,
        mechanism_s=mechanism_s,
        ensemble_s=ensemble_s,
        quick_s=quick_s,
    )


def answer_scores(trials: Sequence[AnswerTrial], replicates: int = scores.REPLICATES) -> list[scores.Score]:
    """Return every measure with its interval."""

    def share(which: Callable[[AnswerTrial], float], *methods: Method) -> scores.Measure:
        """The mean of `which` over the trials that one of `methods` answered; over all where none is named."""
        asked = [not methods or trial.beside.method in methods for trial in trials]
        each = [float(which(trial)) if one else math.nan for trial, one in zip(trials, asked, strict=True)]
        return scores.mean(np.array(each))

    alone, beside, usual, dear = (
        np.array([getattr(trial, name) for trial in trials])
        for name in ("alone_s", "beside_s", "mechanism_s", "ensemble_s")
    )
    quick = np.array([t.quick_s if t.beside.method is Method.MECHANISM_ON_RECORD else 0.0 for t in trials])
    spent, paid = beside + quick, usual + dear
    measures: dict[str, scores.Measure] = {
        "share at rest": share(lambda t: t.beside.method is Method.NOTHING_TO_INTEGRATE),
        "share settled by the peak velocity": share(lambda t: t.beside.method is Method.PEAK_VELOCITY),
        "share settled by the block": share(lambda t: t.beside.method is Method.BLOCK_ON_RECORD),
        "members against the verdict of the peak velocity": share(_members_against, Method.PEAK_VELOCITY),
        "members against the verdict of the block": share(_members_against, Method.BLOCK_ON_RECORD),
        "wrong verdicts among all without an ensemble": share(lambda t: _overturns(t.alone) != t.overturns),
        "wrong verdicts among those settled": share(lambda t: _overturns(t.beside) != t.overturns, *SETTLING),
        "overturnings called standing among those settled": share(
            lambda t: t.overturns and not _overturns(t.beside), *SETTLING
        ),
        "opposite verdict of the ensemble among those settled": share(
            lambda t: t.verdict is (Verdict.STANDS if _overturns(t.beside) else Verdict.OVERTURNS), *SETTLING
        ),
        "undecided in the ensemble among those settled": share(
            lambda t: t.verdict is Verdict.UNDECIDED, *SETTLING
        ),
        "verdicts of the ensemble that its early end changes": share(
            lambda t: t.quick_verdict is not t.verdict
        ),
        "CPU saved of the mechanism for all": lambda rows: 1 - alone[rows].sum() / usual[rows].sum(),
        "CPU saved of mechanism and ensemble for all": lambda rows: 1 - spent[rows].sum() / paid[rows].sum(),
    }
    return scores.scored("fidelity: auto", "sites left out", measures, [t.site for t in trials], replicates)


def _overturns(answer: Answer) -> bool:
    return answer.outcome is Outcome.OVERTURNS


def _members_against(trial: AnswerTrial) -> float:
    return 1 - trial.share if _overturns(trial.beside) else trial.share
