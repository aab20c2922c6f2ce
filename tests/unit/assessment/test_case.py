"""One verdict for one structure under one record, whoever asks; and what a motion is recognised by."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocking.assessment.case import Motion
from rocking.assessment.variations import Variation
from rocking.assessment.verdict import Verdict
from rocking.records import Accelerogram
from tests.unit.assessment.made_rows import broken, case, station, verdicts


@pytest.mark.parametrize(
    ("ratios", "verdict"),
    [([0.97], Verdict.STANDS), ([math.inf], Verdict.OVERTURNS), ([0.2, math.inf], Verdict.OVERTURNS)],
)
def test_without_an_ensemble_the_single_run_of_the_worst_component_decides(ratios, verdict):
    result = station(*(case(str(place), ratio, side=place) for place, ratio in enumerate(ratios)))
    assert result.verdict is verdict and result.members == 0 and result.count == ""
    assert result.peak_side == ratios.index(max(ratios))
    assert result.direction == ("1" if len(ratios) == 2 else ""), "of the worst, where there are several"


def test_the_ensemble_over_all_directions_decides_before_those_of_the_components():
    alone = case("EW", 0.3, falls=0), case("NS", math.inf, falls=64)
    result = station(*alone)
    assert (result.verdict, result.component) == (Verdict.OVERTURNS, "NS")
    result = station(*alone, falls_in_directions=32)
    assert (result.verdict, result.component, result.count) == (Verdict.UNDECIDED, "both", "32 of 64")
    assert result.leaning == "leans to overturns, overturns in 32 of 64", "of two alike the worse"
    assert math.isinf(result.rotation_ratio), "of the worst component as recorded"


def test_a_component_that_failed_leaves_the_verdict_unknown_unless_another_overturns():
    result = station(case("EW", 0.3), broken("NS"), falls_in_directions=0)
    assert result.verdict is Verdict.STANDS, "of all directions"
    result = station(case("EW", 0.3, falls=0), broken("NS"))
    assert result.verdict is Verdict.UNKNOWN and "NS" in result.why
    assert station(case("EW", math.inf, falls=64), broken("NS")).verdict is Verdict.OVERTURNS
    for ratio, verdict in ((0.2, Verdict.UNKNOWN), (math.inf, Verdict.OVERTURNS)):
        assert station(case("EW", ratio), broken("NS")).verdict is verdict


def test_a_crack_that_overturns_leaves_undecided_what_stands_as_given():
    fallen = replace(case("EW", 0.3), variations=(Variation(math.inf, crack="crack at 3 m"),))
    result = station(fallen)
    assert result.verdict is Verdict.UNDECIDED
    assert result.leaning == "leans to stands, overturns with the crack at 3 m"


def test_a_structure_that_failed_under_every_component_is_unknown_and_says_why():
    arch = station(broken("EW", "arch"), broken("NS", "arch"))
    assert (arch.structure, arch.verdict, arch.why) == ("arch", Verdict.UNKNOWN, "No.")


def test_the_worst_of_several_comes_last_by_severity_in_memory_and_read_back():
    several = [
        station(case("EW", 0.9, falls=0)),
        station(broken("EW")),
        station(case("EW", 0.1, falls=5)),
        station(case("EW", 0.05, falls=60)),
        station(case("EW", math.inf, falls=64)),
    ]
    assert sorted(several[3:] + several[:3], key=lambda each: each.severity) == several
    for result, row in zip(several, verdicts(several), strict=True):
        assert (row.severity, row.count, row.leaning) == (result.severity, result.count, result.leaning)


def test_a_motion_is_recognised_by_its_samples_and_all_that_is_said_of_them():
    record = Accelerogram(np.sin(np.arange(100.0)), 0.01, "EW", azimuth=90.0)
    other = Accelerogram(np.cos(np.arange(100.0)), 0.01, "NS", azimuth=0.0)
    same = Accelerogram(np.sin(np.arange(100.0)), 0.01, "EW", azimuth=90.0)
    assert Motion((record,)).fingerprint == Motion((same,)).fingerprint
    different = [
        Motion((record,)),
        Motion((record.scaled(1 + 1e-15),)),
        Motion((replace(record, azimuth=91.0),)),
        Motion((replace(record, processed=True),)),
        Motion((record, other)),
        Motion((other, record)),
        Motion((record,), other),
    ]
    assert len({each.fingerprint for each in different}) == len(different)
