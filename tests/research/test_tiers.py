"""The fit of the tiers and what it is judged by: against scipy, planted truths and real records it has not seen."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import minimize

from docs.research.scores import logistic, logit_slope
from docs.research.sites import independent, structures_tried
from docs.research.tiers import TierCases, left_out, tier_cases, tier_scores
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.tiers import Tier
from rocking.records import Accelerogram, load_catalogue, open_record
from rocking.structures import Block


def planted(many: int, sites: int = 20) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A design, outcomes of log odds 2 x − 1, and groups."""
    rng = np.random.default_rng(7)
    x = rng.normal(size=many)
    fallen = rng.random(many) < 1 / (1 + np.exp(1 - 2 * x))
    return np.column_stack([np.ones(many), x]), fallen, rng.integers(sites, size=many)


def test_the_fit_is_the_maximum_of_the_likelihood():
    """Of scipy's simplex, which knows no derivative; the penalty moves it by less than its tolerance."""
    design, fallen, groups = planted(2000)
    signs = np.where(fallen, -1, 1)
    oracle = minimize(
        lambda b: np.logaddexp(0, signs * (design @ b)).sum(),
        np.zeros(2),
        method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-9},
    )
    assert logistic(design, fallen, groups)[0] == pytest.approx(oracle.x, abs=1e-3)


def test_the_covariance_is_that_of_the_coefficients():
    """Of independent cases, each its own group: the spread over many samples, within what 300 of them tell (±8 %)."""
    rng = np.random.default_rng(3)
    x = rng.normal(size=400)
    design = np.column_stack([np.ones(400), x])
    odds = 1 / (1 + np.exp(-x))
    fits = [logistic(design, rng.random(400) < odds, np.arange(400)) for _ in range(300)]
    spread = np.cov(np.array([coefficients for coefficients, _ in fits]).T)
    said = np.mean([covariance for _, covariance in fits], axis=0)
    assert np.diag(said) == pytest.approx(np.diag(spread), rel=0.25)


def test_what_is_said_as_it_is_has_slope_one():
    design, fallen, _ = planted(20_000)
    odds = 2 * design[:, 1] - 1
    # the standard error of the slope is 0.02 here
    assert logit_slope(odds, fallen.astype(float)) == pytest.approx(1.0, abs=0.06)
    assert logit_slope(2 * odds, fallen.astype(float)) == pytest.approx(0.5, abs=0.03)


def record(event: str, station: str, component: str) -> Accelerogram:
    return Accelerogram(np.sin(np.arange(300) / 10), 0.01, component, event=event, station=station)


def test_a_site_under_two_names_counts_once():
    found = independent(
        [
            ("a", record("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS", "228")),
            ("b", record("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS", "318")),
            ("c", record("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS", "228")),
            ("d", record("NORTHRIDGE EQ 1/17/94", "Rinaldi Receiving Sta", "x")),
            ("e", record("NORTHRIDGE EQ 1/17/94", "CANYON COUNTRY", "y")),
            ("f", record("Landers", "Rinaldi Receiving Sta", "y")),
        ]
    )
    assert [name for name, _, _ in found] == ["a", "b", "e", "f"]


STRUCTURES = {"low": Block(1.0, 0.2), "high": Block(2.0, 0.12)}


def made_records(sites: int = 12) -> list[tuple[str, Accelerogram]]:
    """Noise of several sizes."""
    rng = np.random.default_rng(5)
    window = np.exp(-(((np.arange(1000) - 300) / 150) ** 2))
    noise = (np.convolve(rng.normal(size=1000), np.ones(25) / 5, "same") for _ in range(sites))
    return [(f"r{k}", Accelerogram(samples * window, 0.01)) for k, samples in enumerate(noise)]


@pytest.fixture(scope="module")
def cases():
    """Each record at a site of its own, under two blocks."""
    return TierCases(
        list(tier_cases(((name, f"s {name}", record) for name, record in made_records()), STRUCTURES))
    )


def test_a_case_holds_what_the_mechanism_does(cases):
    for case in cases.cases[::7]:
        assert set(case.measures) >= {term for tier in Tier for term in tier.terms}
        assert all(math.isfinite(value) for value in case.measures.values())
        block, record = STRUCTURES[case.structure], dict(made_records())[case.record].scaled(case.factor)
        whole = ensemble(block, GroundMotions.of(record)).rotation_ratios[:64]  # it goes on near a limit
        assert case.share == np.isinf(whole).mean()


def test_a_site_left_out_took_no_part(cases):
    """What is said of a site does not change when all of its own outcomes do."""
    site = cases.cases[0].site
    turned = [replace(case, share=1 - case.share) if case.site == site else case for case in cases.cases]
    own = cases.sites == site
    before, after = (left_out(Tier.BLOCK_AT_FIVE_SCALES, each) for each in (cases, TierCases(turned)))
    assert np.array_equal(before[own], after[own]) and not np.array_equal(before[~own], after[~own])


@pytest.mark.real_records
def test_the_block_is_worth_what_is_said_on_real_records_left_out(real_records):
    """Every other component under a third of the structures; a cut-down calibration, so less is asked of it."""
    catalogue = load_catalogue(Path(__file__).parents[2] / "records" / "near_fault.csv")
    opened = [(r.id, a) for r in catalogue for a in open_record(r, mirror=real_records)]
    chosen = list(independent(opened))[::2]
    structures = dict(list(structures_tried().items())[::4])
    scores = {
        s.measure: s
        for found, _ in tier_scores(TierCases(list(tier_cases(chosen, structures))), 50)
        for s in found
        if s.subject == Tier.BLOCK_AT_FIVE_SCALES
    }
    assert scores["Brier skill"].value > 0.85 * scores["Brier skill of the shares themselves"].value
    assert scores["calibration slope"].value == pytest.approx(1.0, abs=0.2)
