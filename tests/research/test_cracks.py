"""The governing crack: what a stack weighs, where statics cracks it, and what the rule says of its joints."""

import numpy as np
import pytest

from docs.research import cracks
from docs.research.cracks import KINDS, CrackRow, Member, crack_scores, ruled, stack
from docs.research.screening import screening_scores, screening_trials
from rocking.assessment.verdict import Verdict
from rocking.motion import integrate
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, Wall

TIMES = np.arange(0, 3, 0.01)


def pulse(peak: float, period: float = 1.5) -> Accelerogram:
    """One sine, m/s² and s."""
    return Accelerogram(peak * np.sin(2 * np.pi * TIMES / period) * (TIMES / period < 1), 0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_statics_chooses_the_crack_that_theory_names(kind):
    """Theory, section 10: the wall near its top by the slab (λ = .244), the column at its base (b/h = .125)."""
    multipliers = {joint: each.uplift_multiplier for joint, each in KINDS[kind](20).mechanisms.items()}
    static = min(multipliers, key=multipliers.__getitem__)
    assert (static == 0) == (kind not in ("slab only", "floor load", "spire"))
    if kind == "slab only":
        assert 15 <= static <= 19 and multipliers[static] < 0.25
        assert multipliers[10] == pytest.approx(0.344, abs=5e-4)


def test_a_column_is_the_block_that_it_is_cut_from():
    column = KINDS["column"](6).mechanisms
    for joint in (0, 3):
        block = Block.of_size(0.6, 4.8 * (1 - joint / 6)).mechanism()
        assert column[joint].positive.frequency_parameter == pytest.approx(block.positive.frequency_parameter)
        assert column[joint].restitution == pytest.approx(block.restitution)


def test_the_rule_stands_only_where_every_joint_does():
    mechanisms = KINDS["column"](6).mechanisms
    lift = mechanisms[0].uplift_multiplier * GRAVITY
    assert ruled(mechanisms, 0, pulse(0.9 * lift))[0] is Verdict.STANDS
    assert ruled(mechanisms, 0, pulse(12 * lift))[0] is Verdict.OVERTURNS
    verdict, shares = ruled({0: mechanisms[0], 5: mechanisms[5]}, 5, pulse(3 * lift))
    assert shares[0] == 1 and shares[5] == 0 and verdict is Verdict.UNDECIDED


def test_the_scores_count_what_they_name():
    base = {"kind": "column", "courses": 6, "record": "r", "scale_factor": 1.0, "static_joint": 0}
    base |= {"static_share": 0.0, "largest_share": 0.0, "falls_in_lmgc90": False}
    cases = [(Verdict.STANDS, False, 0), (Verdict.STANDS, True, 3), (Verdict.OVERTURNS, True, 0)]
    cases += [(Verdict.UNDECIDED, True, 0)]
    rows = [
        CrackRow(verdict=verdict, falls=falls, opened=opened, site=str(k), **base)
        for k, (verdict, falls, opened) in enumerate(cases)
    ]
    values = [row.value for row in crack_scores(rows) if row.part == "column"]
    assert values == pytest.approx([0.5, 0.0, 0.25, 2 / 3, 0.25])


def test_a_study_goes_on_where_it_was_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(cracks, "stack", lambda member, motion: np.zeros(member.courses + 1))
    monkeypatch.setattr(cracks, "TIMEOUT", 0.0)
    records = [("r", pulse(3.0))]
    cracks.write_cracks(records, tmp_path, print)
    written = (tmp_path / "cracks.csv").read_text()
    monkeypatch.setattr(cracks, "crack_row", None)
    cracks.write_cracks(records, tmp_path, print)
    assert (tmp_path / "cracks.csv").read_text() == written and written.count("\n") == 15


BLOCK = Member("block", cracks.straight(0.6, 0.6, 1), 3.0, np.ones(1))
WALL = Member("wall", cracks.straight(0.25, 0.25, 2), 3.2, np.ones(2), slab=0.6)


@pytest.mark.parametrize(("member", "joint", "peak"), [(BLOCK, 0, 2.5), (BLOCK, 0, 4.0), (WALL, 1, 8.0)])
def test_a_stack_with_one_joint_rocks_as_its_mechanism_does(member, joint, peak):
    """Time stepping is of first order: with a tenth of the step, a tenth of what is missing is left."""
    mechanism, motion = member.mechanisms[joint], pulse(peak, 0.6)
    rotation = integrate(mechanism, motion).rotation_ratio * mechanism.critical_rotation
    missing = [1 - np.abs(stack(member, motion, step)).max() / rotation for step in (1e-3, 1e-4)]
    assert 0 < missing[1] < missing[0] / 4 and missing[1] < 0.015


@pytest.mark.parametrize("kind", KINDS)
def test_a_stack_stays_whole_below_uplift_and_falls_far_above_it(kind):
    member = KINDS[kind](6)
    lift = min(each.uplift_multiplier for each in member.mechanisms.values()) * GRAVITY
    assert np.abs(stack(member, pulse(0.9 * lift), 1e-3)).max() < 1e-3
    assert np.abs(stack(member, pulse(12 * lift), 1e-3)).max() > cracks.TURN


def test_lmgc90_sees_the_same_column_fall():
    pytest.importorskip("compas_lmgc90", reason="install the extra compare to run this test")
    column = KINDS["column"](6)
    lift = column.mechanisms[0].uplift_multiplier * GRAVITY
    assert [cracks.falls_in_lmgc90(column, pulse(factor * lift)) for factor in (0.9, 6)] == [False, True]


def test_the_verdict_over_all_cracks_is_that_of_the_ensembles_of_all():
    """Of a wall that may crack anywhere; a block has one mechanism and is no trial."""
    made = {"wall": Wall(1.6, 1.6, 0.25), "block": Block(2.0, 0.2)}
    trials = list(screening_trials("r", "s", pulse(3.0), made))
    assert [(each.structure, each.verdict) for each in trials] == [("wall", e.exhaustive) for e in trials]
    values = {each.measure: each.value for each in screening_scores(trials) if each.part == "wall"}
    assert values["other verdict than that of all cracks"] == 0
    assert values['share of "stands"'] == float(trials[0].verdict is Verdict.STANDS)
