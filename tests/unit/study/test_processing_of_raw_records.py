"""Which records of a study are processed."""

import hashlib
from dataclasses import replace

import numpy as np
import pytest

from rocking.records import CatalogueRecord
from rocking.records.synthetic import SHIPPED, at2_text
from rocking.study.job import Study
from rocking.study.settings import Settings

STUDY = Study({})
RAW = CatalogueRecord("STNA", "obspy:STNA.20020722.044649.evt.gz", scale_factor=50.0)
"""The Kinemetrics file that obspy installs: counts of a recorder, offset included; weak, therefore multiplied."""


def _applied(which):
    return Study({}, Settings(processing=replace(Settings().processing, apply=which)))


@pytest.fixture
def at2(tmp_path):
    (tmp_path / "a.AT2").write_text(at2_text(SHIPPED))
    sha256 = hashlib.sha256((tmp_path / "a.AT2").read_bytes()).hexdigest()
    return CatalogueRecord("a", "a.AT2", sha256, folder=tmp_path)


@pytest.fixture
def columns(tmp_path):
    values = np.sin(np.arange(4000) * 0.05) + 0.3
    (tmp_path / "c.txt").write_text("\n".join(f"{i * 0.01:.2f} {v:.6f}" for i, v in enumerate(values)))
    sha256 = hashlib.sha256((tmp_path / "c.txt").read_bytes()).hexdigest()
    return CatalogueRecord("c", "c.txt", sha256, unit="m/s2", folder=tmp_path)


def _steps(study, record):
    return study.open(record)[0][0].processing


def test_a_processed_file_is_left_as_it_is_unless_always(at2):
    assert _steps(STUDY, at2) == ()
    assert any("Butterworth highpass" in step for step in _steps(_applied("always"), at2))


def test_a_file_that_cannot_say_is_left_as_it_is(columns):
    assert _steps(STUDY, columns) == ()


def test_a_raw_file_is_processed_unless_never():
    raw = _applied("never").open(RAW)[0][0]
    done = STUDY.open(RAW)[0][0]
    assert len(done.processing) > len(raw.processing)
    assert done.high_pass_frequency == 0.1
