"""What `fidelity: auto` does on sites that its tiers have not seen: where it stops, what it costs, where it errs."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from docs.research import scores
from docs.research.sites import one_of_each, structures_tried, timed
from rocking.assessment.ensemble import Ensemble, GroundMotions, ensemble
from rocking.assessment.fidelity import Answer, Tier, TierFit, cheapest_answer
from rocking.assessment.intensity import peak_velocity
from rocking.assessment.verdict import Method, Verdict
from rocking.motion import integrate
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Mechanism, Outcome

RISK = 0.01
FACTORS = (0.5, 1.0, 2.0)
SETTLING = (Method.PEAK_VELOCITY, Method.BLOCK_ON_RECORD)


@dataclass(frozen=True)
class AnswerTrial:
    """One structure under one record: what answered, the truths, and the CPU time of each [s], by its name.

    alone: where the mechanism is the last that is asked. beside: where an ensemble follows. mechanism: the case as
    given. whole: its ensemble. quick: one that may end early.
    """

    site: str
    alone: Answer
    beside: Answer
    mechanism: Response
    whole: Ensemble
    quick: Ensemble
    seconds: Mapping[str, float]


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
    runs: dict[str, Callable[[], Any]] = {
        "mechanism": partial(integrate, mechanism, record),
        "alone": asked,
        "beside": partial(asked, ensemble_follows=True),
        "whole": partial(ensemble, mechanism, motions),
        "quick": partial(ensemble, mechanism, motions, verdict_only=True),
    }
    found = {name: timed(run) for name, run in runs.items()}
    beside_velocity = {"alone": velocity_s, "beside": velocity_s}
    seconds = {name: spent + beside_velocity.get(name, 0.0) for name, (_, spent) in found.items()}
    return AnswerTrial(site, **{name: answer for name, (answer, _) in found.items()}, seconds=seconds)


def answer_scores(trials: Sequence[AnswerTrial], replicates: int = scores.REPLICATES) -> list[scores.Score]:
    """Return every measure with its interval."""

    def share(which: Callable[[AnswerTrial], float], *methods: Method) -> scores.Measure:
        """The mean of `which` over the trials that one of `methods` answered; over all where none is named."""
        asked = [not methods or trial.beside.method in methods for trial in trials]
        each = [float(which(trial)) if one else math.nan for trial, one in zip(trials, asked, strict=True)]
        return scores.mean(np.array(each))

    seconds = {name: np.array([trial.seconds[name] for trial in trials]) for name in trials[0].seconds}
    asked_on = np.array([trial.beside.method is Method.MECHANISM_ON_RECORD for trial in trials])
    usual, spent = seconds["mechanism"], seconds["beside"] + seconds["quick"] * asked_on
    paid = usual + seconds["whole"]
    measures: dict[str, scores.Measure] = {
        "share at rest": share(lambda t: t.beside.method is Method.NOTHING_TO_INTEGRATE),
        "share settled by the peak velocity": share(lambda t: t.beside.method is Method.PEAK_VELOCITY),
        "share settled by the block": share(lambda t: t.beside.method is Method.BLOCK_ON_RECORD),
        "members against the verdict of the peak velocity": share(_members_against, Method.PEAK_VELOCITY),
        "members against the verdict of the block": share(_members_against, Method.BLOCK_ON_RECORD),
        "wrong verdicts among all without an ensemble": share(
            lambda t: _overturns(t.alone) != _overturns(t.mechanism)
        ),
        "wrong verdicts among those settled": share(
            lambda t: _overturns(t.beside) != _overturns(t.mechanism), *SETTLING
        ),
        "overturnings called standing among those settled": share(
            lambda t: _overturns(t.mechanism) and not _overturns(t.beside), *SETTLING
        ),
        "opposite verdict of the ensemble among those settled": share(
            lambda t: t.whole.verdict is (Verdict.STANDS if _overturns(t.beside) else Verdict.OVERTURNS),
            *SETTLING,
        ),
        "undecided in the ensemble among those settled": share(
            lambda t: t.whole.verdict is Verdict.UNDECIDED, *SETTLING
        ),
        "verdicts of the ensemble that its early end changes": share(
            lambda t: t.quick.verdict is not t.whole.verdict
        ),
        "CPU saved of the mechanism for all": lambda rows: (
            1 - seconds["alone"][rows].sum() / usual[rows].sum()
        ),
        "CPU saved of mechanism and ensemble for all": lambda rows: 1 - spent[rows].sum() / paid[rows].sum(),
    }
    return scores.scored("fidelity: auto", "sites left out", measures, [t.site for t in trials], replicates)


def _overturns(answer: Answer | Response) -> bool:
    return answer.outcome is Outcome.OVERTURNS


def _wrong(trial: AnswerTrial, answer: Answer) -> bool:
    return _overturns(answer) != _overturns(trial.mechanism)


def _members_against(trial: AnswerTrial) -> float:
    share = trial.whole.overturning_share
    return 1 - share if _overturns(trial.beside) else share
