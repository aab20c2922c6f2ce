"""What the peak velocity says of overturning, fitted to real records and judged by leaving sites out.

And what `fidelity: auto` does with it on those sites: where it stops, what it costs, where it errs.
"""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from scipy.special import expit, logit

from docs.research import scores, sites
from docs.research.report import Target
from rocking import Accelerogram, Mechanism, Outcome, Verdict, integrate
from rocking.assessment import fidelity
from rocking.assessment.decide import Facts, decide
from rocking.assessment.ensemble import drawn, ensemble, lattice
from rocking.assessment.fidelity import (
    STRUCTURE,
    TERMS,
    EstimateFit,
    cheapest_answer,
    peak_velocity,
    stays_at_rest,
)
from rocking.assessment.methods import Method
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import EnsembleSettings
from rocking.hashes import sha256_of_bytes
from rocking.structures import Structure
from rocking.tables import write_whole

FACTORS = (0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8)
"""On each record, so that it speaks for weaker and stronger shaking of the same shape."""
MEMBERS = 64
"""Of the ensemble of a case."""
BINS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0)
RISK = 0.01
"""Of the answers that are tried."""
ANSWERED_FACTORS = (0.5, 1.0, 2.0)
"""On each record for these."""
LEFT_OUT = "sites left out"
SUBJECT = "peak velocity"
"""What is judged, as the table names it."""


def calibrate(target: Target) -> None:
    """Fit and judge the estimate on the records of the target; estimate.json is what ships."""
    records = list(sites.independent(target.records))
    cases = pd.DataFrame(estimated_cases(records, sites.structures_tried()))
    rows = [*estimate_scores(cases), *answer_scores(pd.DataFrame(try_answers(records, cases)))]
    about: dict[str, object] = {"records": cases.record.nunique(), "sites": cases.site.nunique()}
    about["cases"] = len(cases)
    subtitle = ", ".join(f"{many} {name}" for name, many in about.items())
    target.publish("What a cheap figure says of overturning", f"{subtitle}.", {scores.Score: rows})
    hashes = "\n".join(sorted({component.accelerogram.source.sha256 for component in records}))
    about["records_sha256"] = sha256_of_bytes(hashes.encode())
    text = json.dumps({"about": about, "fit": vars(fit(cases))}, indent=1, default=np.ndarray.tolist)
    write_whole(target.folder / "estimate.json", (text + "\n").encode())


def estimated_cases(
    records: Iterable[sites.SiteRecord], structures: Mapping[str, Structure]
) -> Iterator[dict[str, object]]:
    """Yield the cases of each record but those that rest as given, which is certain: what is measured of each.

    share: of the members of its ensemble that overturn. The others name the case and are the terms of the estimate.
    """
    mechanisms = {name: structure.mechanism() for name, structure in structures.items()}
    blocks = [mechanism.equivalent_block("exact_at_rest") for mechanism in mechanisms.values()]
    for component in records:
        record = component.accelerogram
        for k, (structure, mechanism) in enumerate(mechanisms.items()):
            for factor in FACTORS:
                motion = record.scaled(factor)
                if stays_at_rest(mechanism, motion):
                    continue
                members = drawn(mechanism, GroundMotions.of(motion), lattice(MEMBERS), EnsembleSettings())
                if not members.failed_members:
                    case: dict[str, object] = {
                        "record": component.identifier,
                        "site": component.site,
                        "earthquake": component.earthquake,
                        "structure": structure,
                        "factor": factor,
                        "share": members.overturning_share,
                    }
                    terms = fidelity.of_structure(mechanism) | fidelity.of_velocity(motion, blocks[k])
                    yield case | terms


def fit(cases: pd.DataFrame) -> EstimateFit:
    """Return the estimate fitted to `cases`, one of which weighs as much as another."""
    terms, shares = _terms(cases), cases.share.to_numpy()
    centre, spread = terms.mean(axis=0), terms.std(axis=0)
    spread = np.where(spread > 0, spread, 1.0)
    design = np.column_stack([np.ones(len(terms)), (terms - centre) / spread])
    fitted = scores.logistic(design, shares, cases.site.to_numpy())
    lapse = scores.lapse(expit(design @ fitted[0]), shares)
    ranges = cases[[*STRUCTURE, "frequency_parameter"]].agg(["min", "max"]).to_dict("list")
    return EstimateFit(centre, spread, *fitted, ranges, lapse)


def _terms(cases: pd.DataFrame) -> np.ndarray:
    return np.ascontiguousarray(cases[list(TERMS)].to_numpy())


def left_out(cases: pd.DataFrame) -> np.ndarray:
    """Return the share (n,) that is estimated of each case when the estimate is fitted without the site of the case."""

    def estimates(others: np.ndarray, own: np.ndarray) -> np.ndarray:
        without = fit(cases.iloc[others])
        odds = without.design(_terms(cases.iloc[own])) @ without.coefficients
        stated: np.ndarray = (1 - without.lapse) * expit(odds)
        return stated

    return scores.left_out(cases.site.to_numpy(), estimates)


def estimate_scores(cases: pd.DataFrame) -> Iterator[scores.Score]:
    """Yield the scores and the reliability of the estimate on sites left out."""
    overturned = cases.share.to_numpy()
    sample = sites.sample_of(cases.site, cases.earthquake)
    stated = left_out(cases)
    measures = {
        "Brier skill": scores.brier_skill(stated, overturned),
        "Brier skill of the shares themselves": scores.brier_skill(overturned, overturned),
        "calibration slope": scores.logit_slope(logit(stated), overturned),
    }
    yield from scores.scored(SUBJECT, LEFT_OUT, measures, sample)
    yield from scores.reliability(SUBJECT, LEFT_OUT, stated, overturned, sample, BINS)


def try_answers(records: Iterable[sites.SiteRecord], cases: pd.DataFrame) -> Iterator[dict[str, object]]:
    """Yield a trial of each structure at each factor on the first component of each site, by a fit without that site.

    cases: those of `estimated_cases` under `records`.
    """
    mechanisms = [structure.mechanism() for structure in sites.structures_tried().values()]
    first = sites.one_of_each(records)
    for mechanism in mechanisms:  # no time counts that is spent on its table and on compiled code
        integrate(mechanism, first[0].accelerogram)
    for component in first:
        others = cases[cases.site != component.site]
        own_fit = fit(others)
        for motion in map(component.accelerogram.scaled, ANSWERED_FACTORS):
            _, velocity_s = sites.timed(partial(peak_velocity, motion))
            for mechanism in mechanisms:
                trial = _answer_trial(mechanism, motion, own_fit, velocity_s / len(mechanisms))
                yield {"site": component.site, "earthquake": component.earthquake, **trial}


def _answer_trial(
    mechanism: Mechanism, record: Accelerogram, fitted: EstimateFit, velocity_s: float
) -> dict[str, object]:
    """What answered, the truths, and the CPU time of each [s].

    cheapest: the first answer that settles the case. mechanism: the case as recorded. whole: its ensemble. quick: one
    that may end early.
    """
    motions = GroundMotions.of(record)
    runs: dict[str, Callable[[], Any]] = {
        "mechanism": partial(integrate, mechanism, record),
        "cheapest": partial(cheapest_answer, mechanism, record, risk=RISK, fit=fitted),
        "whole": partial(ensemble, mechanism, motions),
        "quick": partial(ensemble, mechanism, motions, verdict_only=True),
    }
    answers, times = {}, {}
    for name, run in runs.items():
        answers[name], times[f"{name}_s"] = sites.timed(run)
    times["cheapest_s"] += velocity_s
    return times | {
        "method": answers["cheapest"].method,
        "overturns": answers["mechanism"].outcome is Outcome.OVERTURNS,
        "settled_overturns": answers["cheapest"].outcome is Outcome.OVERTURNS,
        "overturning_share": answers["whole"].overturning_share,
        "verdict": decide(Facts(cracks=(answers["whole"].facts(),))).word,
        "quick_verdict": decide(Facts(cracks=(answers["quick"].facts(),))).word,
    }


def answer_scores(trials: pd.DataFrame) -> Iterator[scores.Score]:
    """Yield every measure of the trials with its interval."""
    settled = trials.method == Method.PEAK_VELOCITY
    wrong = trials.settled_overturns != trials.overturns
    against = trials.overturning_share.where(~trials.settled_overturns, 1 - trials.overturning_share)
    opposite = trials.settled_overturns.map({True: Verdict.STANDS, False: Verdict.OVERTURNS})
    paid = trials.mechanism_s + trials.whole_s
    spent = trials.cheapest_s + trials.quick_s * (trials.method == Method.MECHANISM_ON_RECORD)
    measures = {
        "share at rest": trials.method == Method.NOTHING_TO_INTEGRATE,
        "share settled by the peak velocity": settled,
        "members against the verdict of the peak velocity": against.where(settled),
        "wrong verdicts among those settled": wrong.where(settled),
        "opposite verdict of the ensemble among those settled": (trials.verdict == opposite).where(settled),
        "open in the ensemble among those settled": (~trials.verdict.map(lambda word: word.is_sure)).where(
            settled
        ),
        "verdicts of the ensemble that its early end changes": trials.quick_verdict != trials.verdict,
        "CPU saved of the mechanism for all": scores.share_of(
            trials.mechanism_s - trials.cheapest_s, trials.mechanism_s
        ),
        "CPU saved of mechanism and ensemble for all": scores.share_of(paid - spent, paid),
    }
    yield from scores.scored(
        "fidelity: auto", LEFT_OUT, measures, sites.sample_of(trials.site, trials.earthquake)
    )
