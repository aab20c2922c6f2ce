"""Validation: the campaign read as measured, scores and baselines against what is known, no test sees its motion."""

import gzip
import hashlib
import io
import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_campaign import made_motion, write_campaign
from scipy.special import logit

from docs.research import scores
from docs.research.validation import campaign as campaigns
from docs.research.validation import source, write
from docs.research.validation.baselines import fit_logistic, fit_threshold
from docs.research.validation.campaign import Campaign
from docs.research.validation.predictions import (
    IDENTIFIED,
    TABLE_PRIOR,
    Measured,
    identified,
    left_out,
    measure,
)
from docs.research.validation.specimen import specimen_from_mesh
from docs.research.validation.write import contradictions, write_validation
from rocking.errors import RecordError
from rocking.quantities import GRAVITY
from rocking.structures import Block, RigidBody
from rocking.tables import read_rows

CATALOGUE = Path(__file__).parents[3] / "records" / "shake_table.csv"


@pytest.fixture(scope="module")
def shake_table() -> Campaign:
    """The real campaign beside the folder of real records, or a skip that says what to set."""
    records = os.environ.get("ROCKING_RECORDS")
    if not records or not (Path(records).parent / "shake_table" / campaigns.TESTS).is_file():
        pytest.skip(
            "there is no folder shake_table beside ROCKING_RECORDS; put the campaign there to run this test"
        )
    return Campaign.open(CATALOGUE, Path(records))


# ---- a small campaign made here


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> tuple[Path, Path]:
    """A catalogue and a folder of 32 tests; the specimens overturn where the motion is strong enough."""
    folder = tmp_path_factory.mktemp("campaign")
    catalogue = folder / "catalogue.csv"
    write_campaign(folder, catalogue, tests=32)
    return catalogue, folder


@pytest.fixture(scope="module")
def measured(made) -> Measured:
    return measure(Campaign.open(made[0], made[1]), replace(TABLE_PRIOR, size=128), workers=1)


def test_a_test_is_read_as_it_was_measured(made):
    opened = Campaign.open(made[0], made[1])
    test = opened.tests[5]
    motion = opened.table_motion(test)
    assert (test.number, test.motion, test.overturned) == (6, "motion_1", (False, False))
    assert test.peak_velocity == pytest.approx(0.1 * 0.2 * GRAVITY)
    assert test.published == ({"dem_a": True}, {})
    assert np.array_equal(motion.acceleration, made_motion(1, 0.2).astype(float) * GRAVITY)
    assert motion.time_step == 0.005


@pytest.mark.parametrize("place", ["", "shake_table"])
def test_the_folder_is_found_inside_or_beside_the_mirror(made, tmp_path, place):
    (tmp_path / "records").mkdir()
    (tmp_path / "shake_table").symlink_to(made[1])
    inside = tmp_path if place else tmp_path / "records"
    assert len(Campaign.open(made[0], inside).tests) == 32


def test_without_a_folder_the_message_says_where_it_was_sought(made, tmp_path):
    with pytest.raises(RecordError, match=r"no tests\.csv of the shake-table campaign in .*shake_table"):
        Campaign.open(made[0], tmp_path)
    with pytest.raises(RecordError, match="the setting mirror, which is null"):
        Campaign.open(made[0], None)


def test_samples_of_another_version_are_refused(made):
    opened = Campaign.open(made[0], made[1])
    wrong = dict(opened.catalogue)
    wrong[1] = replace(wrong[1], samples_sha256="0" * 64)
    with pytest.raises(RecordError, match="test 1: the samples have sha256"):
        replace(opened, catalogue=wrong).table_motion(opened.tests[0])


def test_a_bad_verdict_is_refused_with_its_line(made, tmp_path):
    text = (made[1] / "tests.csv").read_text().replace(",0,0,1\n", ",0,2,1\n", 1)
    (tmp_path / "tests.csv").write_text(text)
    with pytest.raises(RecordError, match=r"line 2: verdict '2'"):
        Campaign.open(made[0], tmp_path)


def test_a_file_of_the_source_converts_to_the_numbers_of_the_mirror(made):
    """One header line, eight columns, the second the acceleration along the table; tabs and blanks mixed."""
    samples = made_motion(0, 0.08)[:50]
    lines = ["Time [s] - Plot 0\tAmplitude - Plot 0\tTime [s] - Plot 1\tAmplitude - Plot 1\t"]
    lines += [
        f"{k / 200}\t{a!r}\t{k / 200}\t9.9\t        {k / 200}\t-8\t" for k, a in enumerate(samples.tolist())
    ]
    found = source.converted("\n".join(lines).encode() + b"\n", "Test001.txt")
    assert found.dtype == np.dtype("<f4")
    assert np.array_equal(found, samples)
    with pytest.raises(RecordError, match=r"Test002\.txt: the file is no table of a test"):
        source.converted(b"head\nonly\n", "Test002.txt")


def test_what_the_mirror_lacks_is_fetched_and_checked(made, tmp_path, monkeypatch):
    samples = made_motion(0, 0.08)
    file = tmp_path / "Test001.txt"
    file.write_text("head\n" + "".join(f"0\t{float(a)!r}\n" for a in samples))
    monkeypatch.setattr(source, "download", lambda *_: file)
    (tmp_path / "tests.csv").write_bytes((made[1] / "tests.csv").read_bytes())
    opened = Campaign.open(made[0], tmp_path)
    assert np.array_equal(opened.table_motion(opened.tests[0]).acceleration, samples.astype(float) * GRAVITY)
    with pytest.raises(RecordError, match="test 2: the samples have sha256"):
        opened.table_motion(opened.tests[1])
    assert not file.exists()


# ---- scores


def test_scores_of_a_known_forecast():
    probability, outcomes = np.array([0.9, 0.2, 0.6, 0.1]), np.array([True, False, False, True])
    assert scores.accuracy(probability, outcomes) == 0.5
    assert scores.brier(probability, outcomes) == pytest.approx((0.01 + 0.04 + 0.36 + 0.81) / 4)


def test_a_forecast_that_means_what_it_says_has_slopes_of_one():
    draw = np.random.default_rng(1)
    probability = draw.beta(0.5, 0.5, size=40_000)
    outcomes = draw.random(40_000) < probability
    assert scores.calibration_slope(probability, outcomes) == pytest.approx(1, abs=0.02)
    assert scores.logit_slope(logit(probability), outcomes) == pytest.approx(1, abs=0.03)
    sure = probability**2 / (probability**2 + (1 - probability) ** 2)
    assert scores.logit_slope(logit(sure), outcomes) == pytest.approx(0.5, abs=0.03)


def test_intervals_draw_whole_motions():
    """Ten tests of one motion are one draw: the interval is as wide as for ten times fewer tests."""
    draw = np.random.default_rng(2)
    one = draw.random(40)
    many = np.repeat(one, 10)
    narrow, wide = (
        scores.interval(lambda rows: many[rows].mean(), scores.resampled(labels, 2000), (0.025, 0.975))
        for labels in (np.arange(400), np.repeat(np.arange(40), 10))
    )
    assert (wide[1] - wide[0]) / (narrow[1] - narrow[0]) == pytest.approx(np.sqrt(10), rel=0.15)
    assert wide[1] - wide[0] == pytest.approx(2 * 1.96 * one.std() / np.sqrt(40), rel=0.15)


def test_reliability_counts_every_test_once():
    draw = np.random.default_rng(3)
    probability = draw.random(200)
    draws = scores.resampled([str(k // 5) for k in range(200)], 200)
    classes = list(scores.reliability(probability, draw.random(200) < probability, write.EDGES, draws))
    assert sorted(np.concatenate([each.rows for each in classes])) == list(range(200))
    assert all(each.low <= each.observed <= each.high for each in classes)


# ---- baselines


def test_the_threshold_gets_most_right():
    measure_, outcomes = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]), np.array([0, 0, 1, 0, 1, 1], bool)
    found = fit_threshold(measure_, outcomes)
    best = max(((measure_ > t) == outcomes).sum() for t in np.arange(0, 7, 0.5))
    assert ((measure_ > found) == outcomes).sum() == best
    assert not (measure_ > fit_threshold(measure_, np.zeros(6, bool))).any()
    assert (measure_ > fit_threshold(measure_, np.ones(6, bool))).all()


def test_the_regression_finds_the_line_it_was_made_with():
    draw = np.random.default_rng(4)
    measure_ = np.exp(draw.normal(size=20_000))
    outcomes = draw.random(20_000) < 1 / (1 + np.exp(-(0.5 + 2 * np.log(measure_))))
    found = fit_logistic(measure_, outcomes)
    assert found.intercept == pytest.approx(0.5, abs=0.06)
    assert found.slope == pytest.approx(2, abs=0.08)


def test_contradictions_are_pairs_of_one_motion():
    speed = np.array([0.1, 0.2, 0.3, 0.1, 0.3])
    fell = np.array([True, False, True, False, True])
    motions = np.array(["a", "a", "a", "b", "b"])
    assert contradictions(speed, fell, motions).tolist() == [True, True, False, False, False]


# ---- specimens


def box(breadth: float, depth: float, height: float, faces: bool = True) -> str:
    corners = [(x, y, z) for x in (0, breadth) for y in (0, depth) for z in (3, 3 + height)]
    quads = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
    triangles = [f"f {a}//1 {b}//1 {c}//1" for a, b, c, d in map(str.split, quads)]
    triangles += [f"f {a}//1 {c}//1 {d}//1" for a, b, c, d in map(str.split, quads)]
    return "\n".join([*("v {} {} {} 1 1 1".format(*c) for c in corners), *(triangles if faces else [])])


@pytest.mark.parametrize("faces", [True, False])
def test_a_box_has_the_block_s_p_and_restitution(faces):
    pytest.importorskip("trimesh")
    body = specimen_from_mesh(box(0.2, 0.2, 1.0, faces))
    block = Block.of_size(breadth=0.2, height=1.0)
    assert body.closed is faces
    assert body.volume == pytest.approx(0.04)
    assert body.centre_height == pytest.approx(0.5)
    assert body.frequency_parameter(0.2)[0] == pytest.approx(
        block.mechanism().positive.frequency_parameter, rel=1e-9
    )
    assert body.uplift_multiplier()[0] == pytest.approx(0.2)
    rigid = RigidBody(
        left=0.1, right=0.1, centre_height=0.5, inertia=(0.2**2 + 1) / 12, restitution="momentum"
    )
    assert body.restitution(0.2, 0.2)[0] == pytest.approx(rigid.mechanism().restitution, rel=1e-9)


# ---- the fit left out by motion


def test_no_prediction_sees_the_outcomes_of_its_motion(measured):
    """Turning the outcomes of one motion around changes no prediction of it, by any method that is fitted."""
    turned = replace(
        measured,
        tests=tuple(
            replace(test, overturned=tuple(not each for each in test.overturned))
            if test.motion == "motion_2"
            else test
            for test in measured.tests
        ),
    )
    before, after = left_out(measured, 1), left_out(turned, 1)
    inside = measured.motions == "motion_2"
    for method in before:
        assert np.array_equal(before[method][inside], after[method][inside]), method
    assert not np.array_equal(before[IDENTIFIED][~inside], after[IDENTIFIED][~inside])


def test_a_clear_campaign_is_predicted(measured):
    outcomes = measured.outcomes(1)
    assert scores.accuracy(left_out(measured, 1)[IDENTIFIED], outcomes) > 0.85


def test_the_tables_are_written_whole(made, tmp_path, monkeypatch):
    pytest.importorskip("trimesh")
    mesh = box(0.1, 0.1, 0.6).encode()
    record = replace(source.SPECIMENS[0], sha256=hashlib.sha256(mesh).hexdigest())
    for module in (campaigns, source):
        monkeypatch.setattr(module, "SPECIMENS", (record, record))
    for k in (1, 2):
        (made[1] / f"specimen_{k}.obj.gz").write_bytes(gzip.compress(mesh))
    monkeypatch.setattr("docs.research.validation.write.TABLE_PRIOR", replace(TABLE_PRIOR, size=64))
    monkeypatch.setattr(write, "RESAMPLES", 50)
    told: list[str] = []
    write_validation(made[0], made[1], tmp_path, workers=1, tell=told.append)
    assert told[0].startswith("1 of 32: test ") and told[31].startswith("32 of 32: ")
    assert told[32].startswith("32 tests")
    package = json.loads((tmp_path / "datapackage.json").read_text())
    assert {each["path"] for each in package["resources"]} == {path.name for path in tmp_path.glob("*.csv")}
    from docs.research.validation.rows import PredictionRow, ScoreRow

    rows = list(read_rows(ScoreRow, tmp_path / "scores.csv"))
    predictions = list(read_rows(PredictionRow, tmp_path / "predictions.csv"))
    assert {row.tests for row in rows} == {32}
    assert len(predictions) == 32 * len(rows)
    first = rows[0]
    own = [row for row in predictions if row.method == first.method and row.specimen == first.specimen]
    assert first.accuracy == np.mean([(row.probability > 0.5) == row.overturned for row in own])


# ---- the real campaign


@pytest.mark.real_records
def test_the_catalogue_lists_the_tests_of_the_campaign(shake_table):
    assert len(shake_table.tests) >= 384
    assert set(shake_table.catalogue) <= {test.number for test in shake_table.tests}
    assert "motion" in io.StringIO((shake_table.folder / "tests.csv").read_text()).readline()
    for test in shake_table.tests[::60]:
        assert shake_table.table_motion(test).acceleration.size == shake_table.catalogue[test.number].samples


@pytest.mark.real_records
def test_the_meshes_hold_boulders_of_granite(shake_table):
    pytest.importorskip("trimesh")
    bodies = [specimen_from_mesh(shake_table.mesh_text(k)) for k in (1, 2)]
    assert [body.closed for body in bodies] == [True, False]
    for body in bodies:
        assert 4.3 < body.frequency_parameter(0.1)[0] < body.frequency_parameter(0.1)[1] < 4.7


@pytest.mark.real_records
def test_a_few_real_motions_left_out_beat_chance(shake_table):
    """Five motions and 128 candidates: the machinery end to end, not the figures of the report."""
    kept = sorted({test.motion for test in shake_table.tests})[::9]
    few = replace(shake_table, tests=tuple(test for test in shake_table.tests if test.motion in kept))
    seen = measure(few, replace(TABLE_PRIOR, size=128))
    probability, outcomes = left_out(seen, 1)[IDENTIFIED], seen.outcomes(1)
    share = outcomes.mean()
    assert scores.brier(probability, outcomes) < 0.6 * share * (1 - share)
    assert identified(seen, 1).mixture.weights.sum() == pytest.approx(1, abs=1e-5)


def test_tests_without_motion_are_refused(made, tmp_path):
    (tmp_path / "tests.csv").write_text("test,dt\n1,0.01\n")
    with pytest.raises(RecordError, match="'pga_g' is missing"):
        Campaign.open(made[0], tmp_path)
