"""Structures on supports: the same motion as a record gives the same rows, and one row for each period."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rocking.assessment.assessor import Assessor, with_histories
from rocking.assessment.case import QUIET, SceneResult
from rocking.assessment.rows import rows_of_record, verdicts_at, worst_period_each
from rocking.assessment.scene import Scene, on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.store import RecordStore
from rocking.floors.place import Place, place_from_config
from rocking.fragility.curves import fragility
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Block
from tests.unit.assessment import made_rows
from tests.unit.assessment.made_rows import case, verdicts

STEP = 0.01
BODY = Block(semi_diagonal=0.5, slenderness=0.25)
FULL = Assessor(AssessmentSettings(fidelity="full", ensemble=EnsembleSettings(members=16, reserve=0.0)))
ROOF = {"name": "roof", "damping_ratio": 0.05, "participation": 1.3}


def motion(component="HNE", seed=8, vertical=False):
    rng = np.random.default_rng(seed)
    times = np.arange(400) * STEP
    waves = sum(np.sin(2 * np.pi * rng.uniform(0.5, 4.0) * times + rng.uniform(0, 6.3)) for _ in range(9))
    return Accelerogram(
        0.6 * waves * np.sin(np.pi * times / 4) ** 2, STEP, component=component, vertical=vertical
    )


def on_roof(period, body=BODY):
    return {"parapet": Scene("parapet", body, place_from_config(ROOF | {"period_s": period}))}


def test_the_floors_motion_as_a_record_gives_the_same_rows():
    record = motion()
    carried = on_roof(0.3)
    (support,) = carried["parapet"].place.supports
    there = FULL.assess("r", [record], carried)
    given = FULL.assess("r", [support.motion(record)], on_the_ground({"parapet": BODY}))
    for table in ("comparison", "verdicts"):
        ours, theirs = (getattr(rows_of_record(each), table)[-1] for each in (there, given))
        for name in ours.values() if isinstance(ours, dict) else type(ours).__dataclass_fields__:
            first, second = getattr(ours, name), getattr(theirs, name)
            if name == "support_period_s":
                assert (first, second) == (0.3, None)
            elif isinstance(first, float):
                assert first == pytest.approx(second, rel=1e-12, nan_ok=True), name
            else:
                assert first == second, name


def test_on_the_ground_it_is_what_it_is_without_a_support():
    record = motion()
    rows = rows_of_record(FULL.assess("r", [record], on_roof(0.3))).verdicts
    alone = rows_of_record(FULL.assess("r", [record], on_the_ground({"parapet": BODY}))).verdicts
    assert replace(rows[0], support_period_s=None) == alone[0]
    assert [row.support_period_s for row in rows] == [0.0, 0.3]
    assert (
        rows[1].overturning_share != rows[0].overturning_share
        or rows[1].rotation_ratio_median != rows[0].rotation_ratio_median
    )


def test_a_pair_and_its_vertical_component_go_through_the_support():
    first, second, up = motion(), motion("HNN", 9), motion("HNZ", 10, vertical=True)
    result = FULL.assess("r", [first, second], on_roof([0.2, 0.6]), up)
    assert len(result.stations) > 3
    for station in result.stations:
        assert station.directions is not None
        assert station.directions.ensemble is not None
        assert not station.directions.failures
        assert len(station.cases) == 2
        if support := station.support:
            floor = result.components_under(station)["HNE"]
            assert floor.support == support
            assert floor.vertical is not None
            assert floor.vertical.peak_acceleration == pytest.approx(up.peak_acceleration)
            exact = support.motion(first).peak_acceleration
            assert floor.accelerogram.peak_acceleration == pytest.approx(exact, rel=1e-3)


def test_a_support_that_the_record_is_too_coarse_for_costs_no_other():
    coarse = replace(motion(), time_step=0.1)
    result = FULL.assess("r", [coarse], on_roof(0.15) | on_the_ground({"pier": BODY}))
    ground, lost, pier = result.stations
    assert (lost.structure, lost.support_period_s, str(lost.verdict)) == ("parapet", 0.15, "cannot be told")
    assert "at least two samples of the record, 0.2 s" in lost.decision.why
    assert "cannot be told" not in (str(pier.verdict), str(ground.verdict))
    rows = rows_of_record(result)
    assert [row.support_period_s for row in rows.supports] == [0.0]
    assert [(row.structure, row.support_period_s) for row in rows.failures] == [("parapet", 0.15)]
    assert with_histories(result, 1e-6).scenes.keys() == result.scenes.keys()


def test_a_stored_case_of_one_support_is_not_taken_for_another(tmp_path):
    record, store = motion(), RecordStore(tmp_path / "cases")
    first = replace(FULL, store=store).assess("r", [record], on_roof([0.2, 0.6]))
    again = replace(FULL, store=store).assess("r", [record], on_roof([0.2, 0.6]))
    alone = FULL.assess("r", [record], on_roof([0.2, 0.6]))
    assert len({station.overturning_share for station in first.stations}) > 1
    assert len(first.stations) > 3
    for other in (again, alone):
        for station, same in zip(first.stations, other.stations, strict=True):
            assert same.overturning_share == station.overturning_share
            assert same.rotation_ratio == station.rotation_ratio


def test_the_ground_sets_no_word_of_what_stands_on_a_floor():
    """It overturns on the ground and stands on the floor, or the other way round: the floor's word is told."""
    falls = made_rows.station(case("EW", math.inf, falls=64))
    stands = made_rows.station(case("EW", 0.1, falls=0))
    for ground, floor in ((falls, stands), (stands, falls)):
        rows = [
            replace(row, support_period_s=period)
            for period, row in zip((0.0, 0.25), verdicts([ground, floor]), strict=True)
        ]
        assert [each.support_period_s for each in worst_period_each(rows)] == [0.25]
        along = [
            SimpleNamespace(support_period_s=each.support_period_s, severity=each.severity) for each in rows
        ]
        assert SceneResult(ground.scene, tuple(along)).worst.support_period_s == 0.25


@pytest.mark.parametrize(
    ("quiet", "periods"),
    [
        ("qqqqqqqqq", "0 4 8"),
        # what is quiet at the three is not asked elsewhere
        ("qqqlqqqqq", "0 4 8"),
        ("lqqqqqqqq", "0 1 2 3 4 5 6 7 8"),
        ("qqqqlqqqq", "0 1 2 3 4 5 6 7 8"),
        ("lllllllll", "0 1 2 3 4 5 6 7 8"),
        ("q", "0"),
        ("l", "0"),
    ],
)
def test_all_periods_are_followed_unless_it_is_quiet_at_three(quiet, periods):
    """Whether a structure is quiet (q) at each period is known beforehand here: which of them are asked for?"""
    span = 0.3 if len(quiet) == 1 else [0.1, 0.9]
    place = place_from_config(ROOF | {"period_s": span})
    told = {}
    while asked := place.to_follow(told):
        assert not told.keys() & set(asked)
        told |= {support: quiet[place.supports.index(support)] == "q" for support in asked}
    assert sorted(map(place.supports.index, told)) == [int(each) for each in periods.split()]


@pytest.mark.parametrize(("factor", "followed"), [(1.0, 9), (0.25, 3)])
def test_what_is_followed_is_as_if_all_periods_were(factor, followed, monkeypatch):
    """Rows at the periods followed equal those of all nine, and the sentence says how many were."""
    record, scenes = motion().scaled(factor), on_roof([0.2, 0.6])
    some = FULL.assess("r", [record], scenes)
    monkeypatch.setattr(Place, "to_follow", lambda self, told: tuple(self.supports) if not told else ())
    every = FULL.assess("r", [record], scenes)
    rows = {row.support_period_s: row for row in rows_of_record(some).verdicts}
    of_all = {row.support_period_s: row for row in rows_of_record(every).verdicts}
    assert len(of_all) == 10 and len(rows) == 1 + followed
    assert [replace(of_all[period], reserve_doubts=()) for period in rows] == list(rows.values())
    said = " (3 of 9 periods followed, where it stays below 10 % of its critical rotation)"
    assert some.scenes["parapet"].sentence.endswith(said) == (followed < 9)
    assert "followed" not in every.scenes["parapet"].sentence
    worst = max(row.rotation_ratio_high for row in rows.values())
    assert (worst <= QUIET) == (followed < 9)


def test_the_verdict_at_a_period_that_was_not_followed_is_the_worse_one_beside_it():
    falls, stands = (
        replace(row, support_period_s=period, reserve_limit=3.0)
        for row, period in zip(
            verdicts(
                [
                    made_rows.station(case("EW", math.inf, falls=30)),
                    made_rows.station(case("EW", 0.9, falls=25)),
                ]
            ),
            (0.2, 0.4),
            strict=True,
        )
    )
    ground = replace(stands, support_period_s=0.0)
    rows = [ground, falls, stands]
    (between,) = verdicts_at(rows, 0.3)
    assert between.overturning_share == falls.overturning_share and between.reserve is None
    assert verdicts_at(rows, 0.4) == [stands] and verdicts_at(rows, 0.0) == [ground]
    assert verdicts_at(rows, 0.1) == verdicts_at(rows, 0.5) == []  # no support was followed beyond


def test_fragility_is_against_the_intensity_of_the_ground():
    """Of floors given as records, each intensity is the floor's; on the support it is the ground's."""
    records = [motion(seed=seed) for seed in (8, 9, 10)]
    (support,) = on_roof(0.3)["parapet"].place.supports
    levels = [0.05, 0.1, 0.2, 0.4]
    how = {"levels": levels, "stations": ["a", "b", "c"], "intensity_measure": "pga"}
    there = fragility(records, BODY, support=support, **how).analysis
    floors = [support.motion(each) for each in records]
    factors = np.array([[level / each.peak_acceleration for level in levels] for each in records])
    factors *= 9.80665 if there.measure.unit == "g" else 1.0
    expected = [
        [integrate(BODY, floor.scaled(factor)).rotation_ratio for factor in row]
        for floor, row in zip(floors, factors, strict=True)
    ]
    assert there.rotation_ratios[:, :, 0] == pytest.approx(np.array(expected), rel=1e-6)
    on_ground = fragility(records, BODY, **how).analysis
    assert on_ground.intensities == pytest.approx(there.intensities)
    assert np.median(there.rotation_ratios[:, -1]) > np.median(on_ground.rotation_ratios[:, -1])
