"""The governing crack: what a stack weighs, where statics cracks it, and what the rule says of its joints."""

import numpy as np
import pytest

from docs.research import cracks
from docs.research.cracks import KINDS, CrackRow, Member, crack_scores, members, ruled, stack
from docs.research.report import Target
from rocking.assessment.decide import Verdict
from rocking.motion import integrate
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block

TIMES = np.arange(0, 3, 0.01)


def pulse(peak: float, period: float = 1.5) -> Accelerogram:
    """One sine, m/s² and s."""
    return Accelerogram(peak * np.sin(2 * np.pi * TIMES / period) * (TIMES / period < 1), 0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_statics_chooses_the_crack_that_theory_names(kind):
    """Theory, section 10: the wall near its top by the slab (λ = .244), the column at its base (b/h = .125)."""
    multipliers = {
        joint: mechanism.uplift_multiplier for joint, mechanism in members(20)[kind].mechanisms.items()
    }
    static = min(multipliers, key=multipliers.__getitem__)
    assert (static == 0) == (kind not in ("wall with a slab only", "wall with a floor load", "spire"))
    if kind == "wall with a slab only":
        assert 15 <= static <= 19 and multipliers[static] < 0.25
        assert multipliers[10] == pytest.approx(0.344, abs=5e-4)


def test_a_column_is_the_block_that_it_is_cut_from():
    column = members(6)["column"].mechanisms
    for joint in (0, 3):
        block = Block.of_size(0.6, 4.8 * (1 - joint / 6)).mechanism()
        assert column[joint].positive.frequency_parameter == pytest.approx(block.positive.frequency_parameter)
        assert column[joint].restitution == pytest.approx(block.restitution)


def test_the_rule_stands_only_where_every_joint_does():
    mechanisms = members(6)["column"].mechanisms
    lift = mechanisms[0].uplift_multiplier * GRAVITY
    assert ruled(mechanisms, 0, pulse(0.9 * lift))[0].verdict is Verdict.STANDS
    assert ruled(mechanisms, 0, pulse(12 * lift))[0].verdict is Verdict.OVERTURNS
    decision, shares = ruled({0: mechanisms[0], 5: mechanisms[5]}, 5, pulse(3 * lift))
    assert shares[0] == 1 and shares[5] == 0 and decision.verdict is Verdict.UNCERTAIN


def test_the_scores_count_what_they_name():
    base = {"structure": "column", "courses": 6, "record": "r", "scale_factor": 1.0, "static_joint": 0}
    base |= {"static_share": 0.0, "largest_share": 0.0, "falls_in_lmgc90": False}
    cases = [(Verdict.STANDS, False, 0), (Verdict.STANDS, True, 3), (Verdict.OVERTURNS, True, 0)]
    cases += [(Verdict.UNCERTAIN, True, 0)]
    rows = [
        CrackRow(verdict=verdict, falls=falls, opened=opened, site=str(k), earthquake=str(k), **base)
        for k, (verdict, falls, opened) in enumerate(cases)
    ]
    values = [row.value for row in crack_scores(rows) if row.part == "column"]
    assert values == pytest.approx([0.5, 0.0, 0.25, 2 / 3, 0.25])


def test_a_study_goes_on_where_it_was_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(cracks, "stack", lambda member, motion: np.zeros(member.courses))
    monkeypatch.setattr(cracks, "TIMEOUT", 0.0)
    target = Target(tmp_path, print, [[("r", pulse(3.0))]])
    cracks.govern(target)
    written = (tmp_path / "cracks.csv").read_text()
    monkeypatch.setattr(cracks, "crack_row", None)
    cracks.govern(target)
    assert (tmp_path / "cracks.csv").read_text() == written and written.count("\n") == 15


BLOCK = Member("block", cracks.straight(0.6, 0.6, 1), 3.0)
WALL = Member("wall", cracks.straight(0.25, 0.25, 2), 3.2, slab=0.6)


@pytest.mark.parametrize(("member", "joint", "peak"), [(BLOCK, 0, 2.5), (BLOCK, 0, 4.0), (WALL, 1, 8.0)])
def test_a_stack_with_one_joint_rocks_as_its_mechanism_does(member, joint, peak):
    """Time stepping is of first order: with a tenth of the step, a tenth of what is missing is left."""
    mechanism, motion = member.mechanisms[joint], pulse(peak, 0.6)
    rotation = integrate(mechanism, motion).rotation_ratio * mechanism.critical_rotation
    missing = [1 - np.abs(stack(member, motion, step)).max() / rotation for step in (1e-3, 1e-4)]
    assert 0 < missing[1] < missing[0] / 4 and missing[1] < 0.015


@pytest.mark.parametrize("kind", KINDS)
def test_a_stack_stays_whole_below_uplift_and_falls_far_above_it(kind):
    member = members(6)[kind]
    lift = min(mechanism.uplift_multiplier for mechanism in member.mechanisms.values()) * GRAVITY
    assert np.abs(stack(member, pulse(0.9 * lift), 1e-3)).max() < 1e-3
    assert np.abs(stack(member, pulse(12 * lift), 1e-3)).max() > cracks.TURN


def test_lmgc90_sees_the_same_column_fall():
    pytest.importorskip("compas_lmgc90", reason="install the extra compare to run this test")
    column = members(6)["column"]
    lift = column.mechanisms[0].uplift_multiplier * GRAVITY
    assert [cracks.falls_in_lmgc90(column, pulse(factor * lift)) for factor in (0.9, 6)] == [False, True]
