"""Every column of every table holds something somewhere: a misspelt one would stay empty without a word."""

import csv
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

from rocking.records.catalogue import CatalogueRecord
from rocking.structures import load_structures
from rocking.study.job import Study, run_job
from rocking.study.settings import Settings, StudyFragility
from rocking.study.summary import write_fragility, write_summary
from tests.workflow.conftest import ROOT

STRUCTURES = """
- {name: facade, type: block, breadth_m: 0.5, height_m: 6.0, one_sided: true, restitution: 0.5}
- {name: wall, type: wall, height_m: 3.2, thickness_m: 0.25}
"""
EMPTY: dict[tuple[str, str], str] = {}
"""Columns that stay empty here, with the reason."""


def test_every_column_is_filled_somewhere(tmp_path: Path) -> None:
    """By a raw record with all its channels, one of two components, a pulse that nothing survives, and no record."""
    (tmp_path / "structures.yaml").write_text(STRUCTURES, encoding="utf-8")
    (tmp_path / "broken.txt").write_bytes(b"no record")
    records = [
        CatalogueRecord(
            "raw", "obspy:STNA.20020722.044649.evt.gz", scale_factor=50.0, licence="free", note="raw"
        ),
        CatalogueRecord("WTMC_2016", "20161113_110259_WTMC_20.V2A", folder=ROOT / "records"),
        CatalogueRecord("synthetic", "synthetic_strong_pulse.AT2", folder=ROOT / "records", unit="g"),
        CatalogueRecord("broken", "broken.txt", folder=tmp_path),
    ]
    settings = Settings(reports=False, histories=True, vertical=True, fragility=StudyFragility(members=False))
    study = Study(load_structures(tmp_path / "structures.yaml"), settings, "made")
    part = tmp_path / "summary" / "jobs" / "00000_of_00001"
    run_job(records, study, part, tmp_path)
    write_summary([part], [record.id for record in records], study.structures, tmp_path / "summary")
    quick = replace(settings, fidelity="auto", histories=False)
    run_job(records[1:3], replace(study, settings=quick), tmp_path / "auto", tmp_path)
    write_fragility(records[1:3], study, tmp_path / "fragility")
    empty: dict[tuple[str, str], bool] = defaultdict(lambda: True)
    for path in tmp_path.rglob("*.csv"):
        with path.open(encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream):
                for name, text in row.items():
                    empty[path.name, name] &= text == ""
    assert {column for column, nothing in empty.items() if nothing} == set(EMPTY)
    assert len({name for name, _ in empty}) > 15
