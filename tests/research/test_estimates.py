"""The estimate: cases hold what the mechanism does, what is stated of a site left out does not know it, and what each
measure of the cheapest answers counts."""

import numpy as np
import pandas as pd
import pytest

from docs.research.estimates import answer_scores, estimated_cases, left_out
from docs.research.sites import SiteRecord, structures_tried
from rocking.assessment import fidelity
from rocking.assessment.decide import Verdict
from rocking.assessment.ensemble import ensemble
from rocking.assessment.fidelity import TERMS, read_fit
from rocking.assessment.methods import Method
from rocking.assessment.motions import GroundMotions
from rocking.records import Accelerogram
from rocking.structures import Block

STRUCTURES = {"low": Block(1.0, 0.2), "high": Block(2.0, 0.12)}


def made_records(sites: int = 12) -> list[tuple[str, Accelerogram]]:
    """Noise of several sizes."""
    rng = np.random.default_rng(5)
    window = np.exp(-(((np.arange(1000) - 300) / 150) ** 2))
    noise = (np.convolve(rng.normal(size=1000), np.ones(25) / 5, "same") for _ in range(sites))
    return [(f"r{k}", Accelerogram(samples * window, 0.01)) for k, samples in enumerate(noise)]


@pytest.fixture(scope="module")
def cases() -> pd.DataFrame:
    """Each record at a site of its own, under two blocks."""
    records = [SiteRecord(name, f"s {name}", name, record) for name, record in made_records()]
    return pd.DataFrame(estimated_cases(records, STRUCTURES))


def test_a_case_holds_what_the_mechanism_does(cases):
    assert np.isfinite(cases[list(TERMS)]).all(axis=None)
    for case in cases[::7].itertuples():
        block, record = STRUCTURES[case.structure], dict(made_records())[case.record].scaled(case.factor)
        whole = ensemble(block, GroundMotions.of(record)).rotation_ratios[:64]  # it goes on near a limit
        assert case.share == np.isinf(whole).mean()


def test_a_site_left_out_took_no_part(cases):
    """What is stated of a site does not change when all of its own outcomes do."""
    own = cases.site == cases.site[0]
    turned = cases.assign(share=cases.share.where(~own, 1 - cases.share))
    before, after = (left_out(each) for each in (cases, turned))
    assert np.array_equal(before[own], after[own]) and not np.array_equal(before[~own], after[~own])


def test_the_structures_tried_are_those_behind_the_fit_that_ships():
    of_each = pd.DataFrame([fidelity.of_structure(each.mechanism()) for each in structures_tried().values()])
    ranges = read_fit().ranges
    assert ranges
    for name, ends in ranges.items():
        assert of_each[name].agg(["min", "max"]).tolist() == pytest.approx(ends, rel=1e-6, abs=1e-9)


def trial(site: str, method: Method, overturns: bool, share: float) -> dict[str, object]:
    """An answer that costs a tenth of the mechanism where it settles the case, and a tenth more where it does not."""
    spent = 1.1 if method is Method.MECHANISM_ON_RECORD else 0.1
    verdict = {0.0: Verdict.STANDS, 1.0: Verdict.OVERTURNS}.get(share, Verdict.UNCERTAIN)
    case = {
        "site": site,
        "earthquake": site,
        "method": method,
        "overturns": overturns,
        "overturning_share": share,
    }
    case["settled_overturns"] = share == 1
    case |= {"verdict": verdict, "quick_verdict": verdict, "cheapest_s": spent}
    return case | {"mechanism_s": 1.0, "whole_s": 40.0, "quick_s": 10.0}


def test_each_measure_of_the_cheapest_answers_counts_what_it_names():
    trials = [
        trial("a", Method.NOTHING_TO_INTEGRATE, False, 0.0),
        trial("a", Method.PEAK_VELOCITY, False, 0.0),
        trial("b", Method.PEAK_VELOCITY, False, 0.5),
        trial("b", Method.MECHANISM_ON_RECORD, False, 0.3),
        trial("c", Method.PEAK_VELOCITY, True, 1.0)
        | {"settled_overturns": False, "quick_verdict": Verdict.UNCERTAIN},
    ]
    rows = list(answer_scores(pd.DataFrame(trials)))
    assert {(row.cases, row.sites) for row in rows} == {(5, 3)}
    assert {row.measure: row.value for row in rows} == pytest.approx(
        {
            "share at rest": 1 / 5,
            "share settled by the peak velocity": 3 / 5,
            "members against the verdict of the peak velocity": 0.5,
            "wrong verdicts among those settled": 1 / 3,
            "opposite verdict of the ensemble among those settled": 1 / 3,
            "open in the ensemble among those settled": 1 / 3,
            "verdicts of the ensemble that its early end changes": 1 / 5,
            "CPU saved of the mechanism for all": 1 - 1.5 / 5,
            "CPU saved of mechanism and ensemble for all": 1 - 11.5 / 205,
        }
    )
