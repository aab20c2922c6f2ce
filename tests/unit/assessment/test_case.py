"""One verdict for one structure under one record, whoever asks; and what a motion is recognised by."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocking.assessment.case import Motion
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack
from rocking.assessment.variations import Variation
from rocking.assessment.verdict import Verdict
from rocking.records import Accelerogram
from rocking.reports.printing import cell_text
from tests.unit.assessment.made_rows import broken, case, members, station, verdicts


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
    assert result.why == "32 of 64 members overturn; nothing decides by itself"
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
    assert result.why == "one run as recorded stands, and with the crack at 3 m it overturns"
    assert (result.crack, result.overturning_share) == ("crack at 3 m", 1.0), (
        "the worse of the two is what counts"
    )


def test_a_crack_that_stands_too_changes_neither_the_verdict_nor_the_crack():
    standing = replace(case("EW", 0.3), variations=(Variation(0.4, crack="crack at 3 m"),))
    result = station(standing)
    assert result.verdict is Verdict.STANDS
    assert (result.crack, result.overturning_share) == ("", 0.0)


def test_a_fall_under_another_processing_is_no_fall_of_a_crack():
    fallen = replace(case("EW", 0.3), variations=(Variation(math.inf), Variation(0.4, crack="crack at 3 m")))
    assert station(fallen).crack == ""


def test_the_worst_crack_gives_every_number_and_statics_stands_beside_it():
    static, worse, other = (
        FollowedCrack(f"crack at {height} m", height, members(falls))
        for height, falls in ((3.0, 0), (8.5, 40), (6.0, 2))
    )
    result = station(
        replace(case("EW", 0.3), ensembles=CrackEnsembles((static, worse, other))),
    )
    assert (result.verdict, result.crack, result.count) == (Verdict.UNDECIDED, "crack at 8.5 m", "40 of 64")
    assert result.overturning_share == 40 / 64 == result.governing.overturning_share
    assert math.isinf(result.rotation_ratio_high) and result.severity[1] == 40 / 64
    assert (result.statics_crack, result.statics_overturning_members) == ("crack at 3.0 m", 0)
    why = "the cracks disagree: 40 of 64 members overturn with the crack at 8.5 m, 0 of 64 with the crack at 3.0 m"
    assert result.why == f"{why} of statics; {result.decided_by}"
    assert result.decided_by.startswith("nothing decides by itself, most which crack opens (")
    (row,) = verdicts([result])
    assert (row.crack, row.overturning_members, row.statics_members) == ("crack at 8.5 m", 40, 64)
    assert row.counts == row.count == "40 of 64"


def test_where_all_fall_with_one_crack_an_undecided_case_says_which_crack_disagrees():
    """ "undecided, 64 of 64" would contradict itself."""
    static, worse = (
        FollowedCrack(f"crack at {height} m", height, members(falls))
        for height, falls in ((3.0, 16), (8.5, 64))
    )
    result = station(replace(case("EW", 0.3), ensembles=CrackEnsembles((static, worse))))
    (row,) = verdicts([result])
    for judgement in (result, row):
        assert (judgement.verdict, judgement.count) == (Verdict.UNDECIDED, "64 of 64")
        assert judgement.counts == "64 of 64 with the crack at 8.5 m, 16 of 64 with the crack at 3.0 m"
        assert judgement.counts_in_brief == "64 of 64, by statics 16 of 64"
        assert cell_text(judgement) == "? 25–100\u00a0%"
    both = CrackEnsembles((replace(static, ensemble=members(64)),))
    (fallen,) = verdicts([station(replace(case("EW", 0.3), ensembles=both))])
    assert (fallen.verdict, fallen.counts) == (Verdict.OVERTURNS, "64 of 64")


@pytest.mark.parametrize(
    ("of_statics", "of_other", "verdict", "share"),
    [
        (0, 0, Verdict.STANDS, 0.0),
        (64, 0, Verdict.OVERTURNS, 1.0),
        (10, 40, Verdict.UNDECIDED, 40 / 64),
        (40, 10, Verdict.UNDECIDED, 40 / 64),
        (0, 64, Verdict.UNDECIDED, 1.0),
    ],
)
def test_a_crack_that_contradicts_statics_leaves_it_undecided(of_statics, of_other, verdict, share):
    both = (FollowedCrack("a", 1.0, members(of_statics)), FollowedCrack("b", 2.0, members(of_other)))
    ensembles = CrackEnsembles(both)
    assert (ensembles.verdict, ensembles.governing.ensemble.overturning_share) == (verdict, share)
    assert ensembles.disagree == (of_statics == 0 and of_other > 0)


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
        assert (row.severity, row.count, row.why) == (result.severity, result.count, result.why)


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
