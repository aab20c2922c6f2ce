"""One verdict for one structure under one record, whoever asks; and what a motion is recognised by."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rocking.assessment.case import Variation
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack
from rocking.assessment.decide import Limit
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import Motion
from rocking.records import Accelerogram
from rocking.reports.printing import cell_text
from rocking.structures import Wall
from rocking.warnings import RockingWarning
from tests.unit.assessment.made_rows import broken, case, members, station, verdicts


@pytest.mark.parametrize(
    ("ratios", "word", "share"),
    [
        ([0.3], "probably stands", 0.0),
        ([0.97], "uncertain", 0.0),
        ([math.inf], "uncertain", 1.0),
        ([0.2, math.inf], "uncertain", 1.0),
    ],
)
def test_without_an_ensemble_the_single_run_of_the_worst_component_decides_and_is_never_sure(
    ratios, word, share
):
    result = station(*(case(str(place), ratio, side=place) for place, ratio in enumerate(ratios)))
    assert (result.verdict, result.decision.share, result.ensemble.members) == (word, share, 0)
    assert result.decision.share_in_words == "one run"
    assert result.peak_side == ratios.index(max(ratios))
    assert result.direction == ("1" if len(ratios) == 2 else ""), "of the worst, where there are several"


def test_the_ensemble_over_all_directions_decides_before_those_of_the_components():
    alone = case("EW", 0.3, falls=0), case("NS", math.inf, falls=64)
    result = station(*alone)
    assert (result.verdict, result.component) == ("overturns", "NS")
    result = station(*alone, falls_in_directions=32)
    assert (result.verdict, result.component) == ("uncertain", "both")
    assert result.decision.why == "32 of 64 members overturn"
    assert result.decided_by == "nothing decides on its own"
    assert math.isinf(result.rotation_ratio), "of the worst component as recorded"


@pytest.mark.parametrize("order", [1, -1])
def test_of_components_that_are_no_pair_the_worse_word_counts_in_either_order(order):
    """A component whose word is worse may have the smaller share: what it does not follow adds to it."""
    doubtful = replace(
        case("EW", 0.3, falls=10), limits=(Limit.untold(RockingWarning(AssessmentKind.CONTACTS_OPEN)),)
    )
    result = station(*[doubtful, case("NS", 0.3, falls=30)][::order])
    assert (result.verdict, result.component) == ("cannot be told", "EW")
    assert result.decision.interval == (10 / 64, 1.0)


def test_a_component_that_failed_cannot_be_told_unless_another_overturns():
    result = station(case("EW", 0.3), broken("NS"), falls_in_directions=0)
    assert result.verdict == "stands", "of all directions"
    result = station(case("EW", 0.3, falls=0), broken("NS"))
    assert result.verdict == "cannot be told"
    assert result.decision.why == "the component NS gave no result: No.; 0 of 64 members overturn"
    assert station(case("EW", math.inf, falls=64), broken("NS")).verdict == "overturns"
    assert station(case("EW", 0.0), broken("NS")).verdict == "cannot be told", "though the other one rests"


def test_a_crack_that_overturns_in_one_run_is_the_worse_of_the_two():
    fallen = replace(
        case("EW", 0.2), variations=(Variation(integrated_rotation_ratio=math.inf, crack="crack at 3 m"),)
    )
    block = station(fallen)
    wall = Wall.of_size(6.0, 0.4, 3.0)
    result = replace(block, scene=replace(block.scene, structure=wall))
    assert (result.verdict, result.crack, result.decision.share) == ("uncertain", "crack at 3 m", 1.0)
    # beside a crack that is known it is told alone
    beside = replace(fallen, variations=(replace(fallen.variations[0], counts=False),))
    assert (station(beside).verdict, station(beside).crack) == ("probably stands", "")


def test_a_crack_that_stands_too_changes_neither_the_verdict_nor_the_crack():
    standing = replace(
        case("EW", 0.2), variations=(Variation(integrated_rotation_ratio=0.25, crack="crack at 3 m"),)
    )
    result = station(standing)
    assert result.verdict == "probably stands"
    assert (result.crack, result.decision.share) == ("", 0.0)


def test_a_fall_under_another_processing_is_no_fall_of_a_crack():
    fallen = replace(
        case("EW", 0.3),
        variations=(
            Variation(integrated_rotation_ratio=math.inf),
            Variation(integrated_rotation_ratio=0.4, crack="crack at 3 m"),
        ),
    )
    assert station(fallen).crack == ""


def test_the_worst_crack_gives_every_number_and_statics_stands_beside_it():
    static, worse, other = (
        FollowedCrack(f"crack at {height} m", height, members(falls))
        for height, falls in ((3.0, 0), (8.5, 40), (6.0, 2))
    )
    result = station(
        replace(case("EW", 0.3), ensembles=CrackEnsembles((static, worse, other))),
    )
    assert (result.verdict, result.crack) == ("uncertain", "crack at 8.5 m")
    assert result.decision.share == 40 / 64
    assert result.decision.interval == (0.0, 40 / 64)
    assert math.isinf(result.ensemble.rotation_ratio_high) and result.severity[1] == 40 / 64
    beside = result.ensembles.reported_statics
    assert (beside.description, beside.ensemble.overturning_members) == ("crack at 3.0 m", 0)
    why = "40 of 64 members overturn with the crack at 8.5 m, 0 of 64 with the crack at 3.0 m of statics"
    assert result.decision.why == why
    assert result.decided_by.startswith("nothing decides on its own, most which crack opens (")
    (row,) = verdicts([result])
    assert (row.crack, row.overturning_members, row.statics_members) == ("crack at 8.5 m", 40, 64)


def test_cracks_that_disagree_have_a_range_in_every_table():
    """ "uncertain, 100 %" would contradict itself."""
    static, worse = (
        FollowedCrack(f"crack at {height} m", height, members(falls))
        for height, falls in ((3.0, 0), (8.5, 64))
    )
    result = station(replace(case("EW", 0.3), ensembles=CrackEnsembles((static, worse))))
    (row,) = verdicts([result])
    assert row.decision == result.decision
    assert (row.verdict, row.decision.share_in_words) == ("uncertain", "0–100\u00a0%")
    assert cell_text(row.decision) == "≈ 0–100\u00a0%"


def test_a_structure_that_failed_under_every_component_cannot_be_told_and_says_why():
    arch = station(broken("EW", "arch"), broken("NS", "arch"))
    assert (arch.structure, arch.verdict, arch.decision.why) == ("arch", "cannot be told", "No.")


def test_the_worst_of_several_comes_last_by_severity_in_memory_and_read_back():
    several = [
        station(case("EW", 0.9, falls=0)),
        station(case("EW", 0.1, falls=5)),
        station(broken("EW")),
        station(case("EW", 0.05, falls=60)),
        station(case("EW", math.inf, falls=64)),
    ]
    assert sorted(several[3:] + several[:3], key=lambda item: item.severity) == several
    for result, row in zip(several, verdicts(several), strict=True):
        assert (row.severity, row.why) == (result.severity, result.decision.why)


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
    assert len({structure.fingerprint for structure in different}) == len(different)
