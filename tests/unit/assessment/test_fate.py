"""One verdict for one case, whoever asks."""

import math

import pytest

from rocking.assessment.fate import fates
from rocking.assessment.rows.of_record import VariationRow
from rocking.assessment.verdict import Verdict
from tests.unit.assessment.made_rows import case, ensemble, failure


@pytest.mark.parametrize(
    ("ratios", "verdict"),
    [([0.97], Verdict.STANDS), ([math.inf], Verdict.OVERTURNS), ([0.2, math.inf], Verdict.OVERTURNS)],
)
def test_without_an_ensemble_the_single_run_of_the_worst_component_decides(ratios, verdict):
    cases = [case(str(place), ratio, peak_side=place) for place, ratio in enumerate(ratios)]
    (fate,) = fates(cases)
    assert fate.verdict is verdict and fate.members == 0 and fate.count == ""
    assert fate.peak_side == ratios.index(max(ratios))
    assert fate.direction == ("1" if len(ratios) == 2 else ""), "of the worst, where there are several"


def test_the_ensemble_over_all_directions_decides_before_those_of_the_components():
    cases = [case("EW", 0.3), case("NS", math.inf)]
    alone = [ensemble("EW", Verdict.STANDS, 0), ensemble("NS", Verdict.OVERTURNS, 64)]
    (fate,) = fates(cases, alone)
    assert (fate.verdict, fate.component) == (Verdict.OVERTURNS, "NS")
    (fate,) = fates(cases, [*alone, ensemble("both", Verdict.UNDECIDED, 32)])
    assert (fate.verdict, fate.component, fate.count) == (Verdict.UNDECIDED, "both", "32 of 64")
    assert fate.leaning == "leans to overturns, overturns in 32 of 64", "of two alike the worse"
    assert math.isinf(fate.rotation_ratio), "of the worst component as recorded"


def test_a_component_that_failed_leaves_the_verdict_unknown_unless_another_overturns():
    (fate,) = fates([case("EW", 0.3)], [ensemble("both", Verdict.STANDS, 0)], [failure("NS")])
    assert fate.verdict is Verdict.STANDS, "of all directions"
    (fate,) = fates([case("EW", 0.3)], [ensemble("EW", Verdict.STANDS, 0)], [failure("NS")])
    assert fate.verdict is Verdict.UNKNOWN and "NS" in fate.why
    (fate,) = fates([case("EW", math.inf)], [ensemble("EW", Verdict.OVERTURNS, 64)], [failure("NS")])
    assert fate.verdict is Verdict.OVERTURNS
    for ratio, verdict in ((0.2, Verdict.UNKNOWN), (math.inf, Verdict.OVERTURNS)):
        (fate,) = fates([case("EW", ratio)], failures=[failure("NS")])
        assert fate.verdict is verdict


def test_a_crack_that_overturns_leaves_undecided_what_stands_as_given():
    crack = {"crack": "crack at 3 m", "integrated_rotation_ratio": math.inf}
    fallen = VariationRow.of(record="a", structure="pier", **crack)
    (fate,) = fates([case("EW", 0.3)], variations=[fallen])
    assert fate.verdict is Verdict.UNDECIDED
    assert fate.leaning == "leans to stands, overturns with the crack at 3 m"


def test_a_structure_that_failed_under_every_component_is_unknown_and_says_why():
    pier, arch = fates([case("EW", 0.3)], failures=[failure("EW", "arch"), failure("NS", "arch")])
    assert pier.verdict is Verdict.STANDS
    assert (arch.structure, arch.verdict, arch.why) == ("arch", Verdict.UNKNOWN, "No.")


def test_the_worst_of_several_comes_last_by_severity():
    several = [
        *fates([case("EW", 0.9)], [ensemble("EW", Verdict.STANDS, 0)]),
        *fates([], failures=[failure("EW")]),
        *fates([case("EW", 0.1)], [ensemble("EW", Verdict.UNDECIDED, 5)]),
        *fates([case("EW", 0.05)], [ensemble("EW", Verdict.UNDECIDED, 60)]),
        *fates([case("EW", math.inf)], [ensemble("EW", Verdict.OVERTURNS, 63)]),
    ]
    assert sorted(several[3:] + several[:3], key=lambda fate: fate.severity) == several
