"""The tiers: cases hold what the mechanism does, and what is said of a site left out does not know it."""

import math
from dataclasses import replace

import numpy as np
import pytest

from docs.research.tiers import TierCases, left_out, tier_cases
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.fidelity import Tier
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
