"""Verdicts with and without contact dynamics beside stacks: what a trial holds, and what its scores count."""

from dataclasses import replace

import numpy as np
import pytest

from docs.research import stacks
from docs.research.report import Target
from docs.research.sites import SiteRecord
from docs.research.stacks import (
    DRAWN,
    KINDS,
    TAPERING,
    StackRow,
    judged_kinds,
    stack_row,
    stack_scores,
    words_of,
)
from rocking.assessment.decide import CrackFacts, Facts, Limit, Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.warnings import RockingWarning

TIMES = np.arange(0, 3, 0.01)
SINE = Accelerogram(3.0 * np.sin(2 * np.pi * TIMES / 0.8) * (TIMES < 1.6), 0.01)


@pytest.mark.filterwarnings("ignore::rocking.errors.StructureWarning")  # a drawn wall may be squat
@pytest.mark.parametrize("kind", KINDS)
def test_a_member_stays_whole_below_uplift_and_falls_far_above_it(kind):
    case = DRAWN[kind](np.random.default_rng(1))
    least = case.multiplier * GRAVITY / SINE.peak_acceleration
    below, above = SINE.scaled(0.9 * least), SINE.scaled(15 * least)
    assert words_of(*case.facts(below))[-1] is Verdict.STANDS
    assert words_of(*case.facts(above))[-1] is Verdict.OVERTURNS
    for courses in (6, 10):
        assert case.stack(courses).friction <= 0.6
        assert not stacks.follow_stack(case.stack(courses), below, 5e-4).falls
        assert stacks.follow_stack(case.stack(courses), above, 5e-4).falls


def test_contact_dynamics_decides_what_a_doubt_leaves_open():
    stands = Facts(cracks=(CrackFacts("", 0, 64, farthest=0.5),))
    doubted = [Limit.untold(RockingWarning(AssessmentKind.CONTACTS_OPEN))]
    untold = Verdict.CANNOT_BE_TOLD
    assert words_of(replace(stands, stacks=(0, 64)), doubted) == (Verdict.STANDS, untold, Verdict.STANDS)
    assert words_of(replace(stands, stacks=(0, 6)), doubted)[-1] is Verdict.PROBABLY_STANDS
    assert words_of(replace(stands, stacks=(1, 6)), doubted)[-1] is Verdict.UNCERTAIN
    assert words_of(stands, doubted)[-1] is untold
    assert set(words_of(stands)) == {Verdict.STANDS}
    short = [Limit(warning=RockingWarning(AssessmentKind.FRICTION_SHORT))]
    assert words_of(stands, short) == (Verdict.STANDS, Verdict.PROBABLY_STANDS, Verdict.PROBABLY_STANDS)
    assert words_of(replace(stands, stacks=(0, 64)), short)[-1] is Verdict.STANDS


def test_a_trial_is_the_same_at_every_call():
    component = SiteRecord("made", "a site", "made", SINE)
    one, again = (stack_row(component, "loaded wall", 3) for _ in range(2))
    assert one.scale_factor == again.scale_factor
    assert (one.mechanism, one.verdict, one.falls) == (again.mechanism, again.verdict, again.falls)


def test_the_scores_count_what_they_name():
    base = {"record": "r", "structure": "spire", "courses": 6, "scale_factor": 1.0, "velocity_ratio_s": 0.1}
    base |= {"contact_s": 0.1, "stack_falls": None, "stack_runs": None, "opened": 1}
    base |= {"opened_height_m": 1.0}
    stands, falls, open_ = Verdict.STANDS, Verdict.OVERTURNS, Verdict.CANNOT_BE_TOLD
    cases = [
        (stands, "thrown", open_, stands, False, 0.1, False),
        (stands, "thrown", open_, falls, True, 0.9, False),
        (stands, "thrown", open_, open_, True, 0.9, True),
        (falls, "", falls, falls, True, 0.9, True),
        (stands, "", stands, stands, False, 1e-6, False),
    ]
    rows = [
        StackRow(
            mechanism=mechanism,
            warning=warning,
            without=without,
            verdict=verdict,
            falls=fell,
            turn_rad=turn,
            opened_at_storey=at_storey,
            site=str(place),
            earthquake=str(place),
            **base,
        )
        for place, (mechanism, warning, without, verdict, fell, turn, at_storey) in enumerate(cases)
    ]
    found = {row.measure: (row.value, row.cases) for row in stack_scores(rows) if row.part == "spire"}
    assert found['falls among "stands" by mechanisms'] == (0.5, 4)
    assert found['falls among "stands" without contact dynamics'] == (0.0, 1)
    assert found['falls among "stands" with it'] == (0.0, 2)
    assert found['falls among "stands" with it whose stack lifts'] == (0.0, 1)
    assert found["trials whose stack lifts"] == (0.8, 5)
    assert found["stacks of storeys that open most between two feet"] == (0.5, 4)
    assert found['falls among "stands" with it that open most between two feet'] == (0.0, 1)
    assert found['survivals among "overturns" with it that open so'] == (0.0, 1)
    assert found["open without contact dynamics"] == (pytest.approx(0.6), 5)
    assert found["open with it"] == (pytest.approx(0.2), 5)
    assert found["open that contact dynamics settles"] == (pytest.approx(2 / 3), 3)
    assert found["right among those that it settles"] == (1.0, 2)


def test_each_kind_is_judged_on_one_half_of_the_sites():
    sites = [f"site {number}" for number in range(20)]
    for site in sites:
        assert set(judged_kinds(site)) in (set(TAPERING), set(KINDS) - set(TAPERING))
    assert len({tuple(judged_kinds(site)) for site in sites}) == 2


def test_the_target_goes_on_where_it_was_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(stacks, "TRIALS", {"loaded wall": 1, "gable": 1})
    monkeypatch.setattr(stacks, "judged_kinds", lambda _: ["loaded wall", "gable"])
    target = Target(tmp_path, print, [[("r", SINE)]])
    stacks.stand(target)
    written = (tmp_path / "stacks.csv").read_text()
    monkeypatch.setattr(stacks, "stack_row", None)
    stacks.stand(target)
    assert (tmp_path / "stacks.csv").read_text() == written
    assert written.count("\n") == 3
