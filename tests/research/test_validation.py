"""Validation: the campaign read as measured, scores and baselines against what is known, no test sees its motion."""

from dataclasses import replace
from pathlib import Path
from urllib.request import Request

import numpy as np
import pytest
from made_campaign import made_motion, write_campaign

from docs.research import shake_table
from docs.research.shake_table import Campaign
from docs.research.validation import IDENTIFIED, PRIOR, Measured, left_out, measure
from rocking.catalogue import files
from rocking.errors import RecordError
from rocking.quantities import GRAVITY
from tests.refusals import refused


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> tuple[Path, Path]:
    """A catalogue and a folder of 32 tests; the specimens overturn where the motion is strong enough."""
    folder = tmp_path_factory.mktemp("campaign")
    write_campaign(folder, folder / "catalogue.csv", tests=32)
    return folder / "catalogue.csv", folder


@pytest.fixture(scope="module")
def measured(made) -> Measured:
    return measure(Campaign.open(*made), replace(PRIOR, size=128), print)


def test_a_test_is_read_as_it_was_measured(made):
    opened = Campaign.open(*made)
    test = opened.tests.loc[5]
    motion = opened.table_motion(6)
    assert (test.test, test.motion, test.specimen_1_dem_a) == (6, "motion_1", True)
    assert not test.overturned_specimen_1 and not test.overturned_specimen_2
    assert test.nominal_peak_velocity == pytest.approx(0.1 * 0.2 * GRAVITY)
    assert np.array_equal(motion.acceleration, made_motion(1, 0.2).astype(float) * GRAVITY)
    assert motion.time_step == 0.005


def test_what_is_no_campaign_is_refused(made, tmp_path):
    with refused(RecordError, "mirror", tmp_path):
        Campaign.open(made[0], tmp_path)
    opened = Campaign.open(*made)
    wrong = {**opened.catalogue, 1: replace(opened.catalogue[1], samples_sha256="0" * 64)}
    with refused(RecordError, "samples_sha256", "0" * 64):
        replace(opened, catalogue=wrong).table_motion(1)
    text = (made[1] / "tests.csv").read_text().replace(",0,0,1\n", ",0,2,1\n", 1)
    (tmp_path / "tests.csv").write_text(text)
    with refused(RecordError, "overturned_specimen_2", "2"):
        Campaign.open(made[0], tmp_path)
    (tmp_path / "tests.csv").write_text("test,dt\n1,0.01\n")
    with refused(RecordError, "pga_g", "missing"):
        Campaign.open(made[0], tmp_path)


def test_what_the_folder_lacks_is_fetched_and_checked(made, tmp_path, monkeypatch):
    """One header line, eight columns, the second the acceleration along the table; tabs and blanks mixed."""
    samples = made_motion(0, 0.08)
    file = tmp_path / "Test001.txt"
    lines = (f"{k / 200}\t{a!r}\t0\t9.9\t   0\t-8\t\n" for k, a in enumerate(samples.tolist()))
    file.write_text("head\n" + "".join(lines))
    monkeypatch.setattr(shake_table, "download", lambda *_: file)
    (tmp_path / "tests.csv").write_bytes((made[1] / "tests.csv").read_bytes())
    opened = Campaign.open(made[0], tmp_path)
    assert np.array_equal(opened.table_motion(1).acceleration, samples.astype(float) * GRAVITY)
    with refused(RecordError, "samples_sha256", opened.catalogue[2].samples_sha256):
        opened.table_motion(2)
    assert not file.exists(), "a file of another version is not kept"
    file.write_text("head\nonly\n")
    with refused(RecordError, "file", "Test001.txt"):
        opened.table_motion(1)
    assert not file.exists()


def test_a_redirect_to_http_is_refused():
    asked = Request("https://example.org/Test001.txt")
    with refused(RecordError, "newurl", "http://example.org/a"):
        files._Direct().redirect_request(asked, None, 302, "Found", {}, "http://example.org/a")


def test_no_prediction_sees_the_outcomes_of_its_motion(measured):
    """Turning the outcomes of one motion around changes no prediction of it, by any method that is fitted."""
    inside = (measured.tests.motion == "motion_2").to_numpy()
    turned = measured.tests.overturned_specimen_1 ^ inside
    before = left_out(measured, 1)
    after = left_out(replace(measured, tests=measured.tests.assign(overturned_specimen_1=turned)), 1)
    for method in before:
        assert np.array_equal(before[method][inside], after[method][inside]), method
    assert not np.array_equal(before[IDENTIFIED][~inside], after[IDENTIFIED][~inside])
