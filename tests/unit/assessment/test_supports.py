"""Structures on supports: the same motion as a record gives the same rows, and one row for each period."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rocking.assessment import motions as kept_motions
from rocking.assessment.assessor import Assessor, with_histories
from rocking.assessment.case import SceneResult
from rocking.assessment.methods import Method
from rocking.assessment.motions import GroundMotions
from rocking.assessment.rows import rows_of_record, worst_period_each
from rocking.assessment.scene import Scene, on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.store import RecordStore
from rocking.floors.place import place_from_config
from rocking.fragility.curves import fragility
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Block
from tests.unit.assessment import made_rows
from tests.unit.assessment.made_rows import case, verdicts

STEP = 0.01
BODY = Block(semi_diagonal=0.5, slenderness=0.25)
FULL = Assessor(AssessmentSettings(fidelity="standard", ensemble=EnsembleSettings(members=16, reserve=0.0)))
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
        ours, theirs = (getattr(rows_of_record(case), table)[-1] for case in (there, given))
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
    result = replace(FULL, motion_measures=True).assess("r", [first, second], on_roof([0.2, 0.6]), up)
    assert len(result.periods) > 3
    of_all = {"velocity pulse", "pulses", "supports", "directions", "responses", "variations"}
    assert result.durations.keys() == of_all | {*Method}
    for station in result.periods:
        assert station.directions is not None
        assert station.directions.ensembles is not None
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
    ground, lost, pier = result.periods
    assert (lost.structure, lost.support_period_s, str(lost.verdict)) == ("parapet", 0.15, "cannot be told")
    assert "at least two samples of the record, 0.2 s" in lost.decision.why
    assert "cannot be told" not in (str(pier.verdict), str(ground.verdict))
    rows = rows_of_record(result)
    assert [(row.support, row.support_period_s) for row in rows.supports] == [("roof", 0.0)]
    assert [(row.structure, row.support_period_s) for row in rows.failures] == [("parapet", 0.15)]
    assert with_histories(result, 1e-6).scenes.keys() == result.scenes.keys()


def test_a_stored_case_of_one_support_is_not_taken_for_another(tmp_path):
    record, store = motion(), RecordStore(tmp_path / "cases")
    first = replace(FULL, store=store).assess("r", [record], on_roof([0.2, 0.6]))
    again = replace(FULL, store=store).assess("r", [record], on_roof([0.2, 0.6]))
    alone = FULL.assess("r", [record], on_roof([0.2, 0.6]))
    assert len({station.decision.share for station in first.periods}) > 1
    assert len(first.periods) > 3
    for other in (again, alone):
        for station, same in zip(first.periods, other.periods, strict=True):
            assert same.decision.share == station.decision.share
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
        assert [item.support_period_s for item in worst_period_each(rows)] == [0.25]
        along = [
            SimpleNamespace(support_period_s=one_row.support_period_s, severity=one_row.severity)
            for one_row in rows
        ]
        assert SceneResult(ground.scene, tuple(along)).worst.support_period_s == 0.25


def test_a_period_at_which_it_falls_is_found_where_it_stands_at_the_ends_and_in_the_middle():
    """Under waves of one period, which only a support of that period magnifies: none may be passed over."""
    times = np.arange(2000) * STEP
    waves = 0.5 * np.sin(2 * np.pi * times / 0.52) * np.sin(np.pi * times / 20) ** 2
    result = FULL.assess("r", [Accelerogram(waves, STEP)], on_roof([0.1, 0.9]))
    ground, *carried = result.periods
    assert len(carried) == 9
    falls = [station.decision.share for station in carried]
    assert ground.decision.share == falls[0] == falls[4] == falls[8] == 0 < max(falls)


def test_fragility_is_against_the_intensity_of_the_ground():
    """Of floors given as records, each intensity is the floor's; on the support it is the ground's."""
    records = [motion(seed=seed) for seed in (8, 9, 10)]
    (support,) = on_roof(0.3)["parapet"].place.supports
    levels = [0.05, 0.1, 0.2, 0.4]
    how = {"levels": levels, "stations": ["a", "b", "c"], "intensity_measure": "pga"}
    there = fragility(records, BODY, support=support, **how).analysis
    floors = [support.motion(record) for record in records]
    factors = np.array([[level / one_record.peak_acceleration for level in levels] for one_record in records])
    factors *= 9.80665 if there.measure.unit == "g" else 1.0
    expected = [
        [integrate(BODY, floor.scaled(factor)).rotation_ratio for factor in row]
        for floor, row in zip(floors, factors, strict=True)
    ]
    assert there.rotation_ratios[:, :, 0] == pytest.approx(np.array(expected), rel=1e-6)
    on_ground = fragility(records, BODY, **how).analysis
    assert on_ground.intensities == pytest.approx(there.intensities)
    assert np.median(there.rotation_ratios[:, -1]) > np.median(on_ground.rotation_ratios[:, -1])


def test_the_bytes_that_are_kept_change_no_number(monkeypatch):
    """Motions that find no room are made again, to the bit."""
    first, second = motion(), motion("HNN", 9)
    carried = on_roof([0.2, 0.6])
    rows = []
    for room in (48_000_000, 0):
        monkeypatch.setattr(kept_motions, "FLOOR_BYTES", room)
        monkeypatch.setattr(kept_motions, "_FLOOR_MOTIONS", kept_motions._FloorMotions())
        kept_motions.ground_motions.cache_clear()
        result = FULL.assess("r", [first, second], carried)
        ratios = [period.ensembles.governing.ensemble.rotation_ratios for period in result.periods]
        floors = [
            component.accelerogram.sha256
            for station in result.periods
            for component in components(result, station)
        ]
        rows.append((np.concatenate(ratios).tobytes(), floors))
    assert rows[0] == rows[1]
    assert len(set(rows[0][1])) == len(rows[0][1])


def components(result, station):
    return result.components_under(station).values()


def test_the_motions_of_one_support_alone_are_kept_and_no_more_than_have_room(monkeypatch):
    ground = GroundMotions.of(motion(), motion("HNN", 9))
    (short,) = on_roof(0.2)["parapet"].place.supports
    (long,) = on_roof(0.6)["parapet"].place.supports
    store = kept_motions._FloorMotions()
    monkeypatch.setattr(kept_motions, "_FLOOR_MOTIONS", store)
    eager = short.motions(list(ground.horizontal.values()))
    monkeypatch.setattr(kept_motions, "FLOOR_BYTES", 3 * eager[0].acceleration.nbytes)
    for _ in range(2):
        made = ground.on(short).horizontal
        assert list(made) == list(ground.horizontal)
        for own, other in zip(made.values(), eager, strict=True):
            assert own.acceleration.tobytes() == other.acceleration.tobytes()
            assert (own.time_step, own.smooth_steps, own.processing) == (
                other.time_step,
                other.smooth_steps,
                other.processing,
            )
        assert len(store._kept) == 3
    next(iter(ground.on(long).horizontal.values()))
    assert {support for support, _, _ in store._kept} == {long}
