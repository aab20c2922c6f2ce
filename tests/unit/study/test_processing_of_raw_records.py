"""Which records of a study are processed."""

from dataclasses import replace

import numpy as np

from rocking.records import CatalogueRecord
from rocking.records.synthetic import SHIPPED, at2_text
from rocking.study.job import Study
from rocking.study.settings import Settings

RAW = CatalogueRecord("STNA", "obspy:STNA.20020722.044649.evt.gz", scale_factor=50.0)
"""The Kinemetrics file that obspy installs: counts of a recorder, offset included; weak, therefore multiplied."""


def _processed(record, apply="raw"):
    settings = Settings(processing=replace(Settings().processing, apply=apply))
    return Study({}, settings).open(record)[0][0]


def test_a_processed_file_and_one_that_cannot_say_are_left_as_they_are_unless_always(tmp_path):
    (tmp_path / "a.AT2").write_text(at2_text(SHIPPED))
    values = np.sin(np.arange(4000) * 0.05) + 0.3
    (tmp_path / "c.txt").write_text("\n".join(f"{i * 0.01:.2f} {v:.6f}" for i, v in enumerate(values)))
    for record in (
        CatalogueRecord("a", "a.AT2", folder=tmp_path),
        CatalogueRecord("c", "c.txt", unit="m/s2", folder=tmp_path),
    ):
        assert _processed(record).processing == ()
        assert any("Butterworth highpass" in step for step in _processed(record, "always").processing)


def test_a_raw_file_is_processed_unless_never():
    assert len(_processed(RAW).processing) > len(_processed(RAW, "never").processing)
    assert _processed(RAW).high_pass_frequency == 0.1
