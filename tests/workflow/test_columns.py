"""Every column of every table holds something somewhere: a misspelt one would stay empty without a word."""

import csv
from dataclasses import replace
from pathlib import Path

import pytest

from rocking.assessment.scene import load_scenes, on_the_ground
from rocking.assessment.settings import EnsembleSettings
from rocking.catalogue.catalogue import CatalogueRecord
from rocking.floors.place import Place
from rocking.floors.support import Mode, Support
from rocking.products.fragility.work import write_fragility
from rocking.study.job import Study
from rocking.study.settings import Settings, StudyFragility
from rocking.study.summary_tables import write_summary
from tests.unit.assessment.made_rows import Impossible
from tests.unit.study.made_jobs import outcomes_in, worked
from tests.workflow.conftest import ROOT

STRUCTURES = """
- {name: facade, type: block, breadth_m: 0.5, height_m: 6.0, one_sided: true, restitution: 0.5}
- {name: stocky, type: block, breadth_m: 2.0, height_m: 4.0}
- {name: wall, type: wall, height_m: 3.2, thickness_m: 0.25}
- {name: spire, type: spire, width_m: 3.0, height_m: 15.0, wall_thickness_m: 0.25, crack_height_m: 5.0}
- {name: tied, type: facade, storey_heights_m: [3.5, 3.0], thicknesses_m: [0.6, 0.5], unit_weight_kN_m3: 20,
   floor_loads_kN_m: [12, 6], tie_heights_m: [3.4], tie_stiffness_kN_m2: 1000, tie_strength_kN_m: 4}
- {name: parapet, type: block, breadth_m: 0.4, height_m: 1.5, stands_on: roof}
- {name: roof, type: support, period_s: 0.3, participation: 1.3}
"""
EMPTY = {("intensity_measures.csv", name) for name in ("p_value", "power", "slope")}
"""What stays empty here: a regression needs more stations than two."""


def _write_tables(records: list[CatalogueRecord], study: Study, results: Path) -> None:
    worked(records, study, results)
    described = {name: scene for name, scene in study.scenes.items() if name != "impossible"}
    write_summary(outcomes_in(results, records), replace(study, scenes=described), results / "summary")


@pytest.mark.slow
def test_every_column_is_filled_somewhere(tmp_path: Path) -> None:
    """By a raw record with all its channels, one of two components, a pulse that nothing survives, and no record."""
    (tmp_path / "structures.yaml").write_text(STRUCTURES, encoding="utf-8")
    (tmp_path / "broken.txt").write_bytes(b"no record")
    (tmp_path / "hazard.txt").write_text("intensity,annual_rate\n0.01,0.1\n10,0.00001\n")
    pulse = CatalogueRecord("pulse", "synthetic_strong_pulse.AT2", folder=ROOT / "records", unit="g")
    records = [
        CatalogueRecord(
            "raw", "obspy:STNA.20020722.044649.evt.gz", scale_factor=5.0, licence="free", note="raw"
        ),
        CatalogueRecord(
            "pair",
            "20161113_110259_WTMC_20.V2A",
            folder=ROOT / "records",
            epicentre_latitude=-42.737,
            epicentre_longitude=173.054,
        ),
        pulse,
        CatalogueRecord("broken", "broken.txt", folder=tmp_path),
    ]
    fragility = StudyFragility(members=False, hazard=str(tmp_path / "hazard.txt"))
    settings = Settings(
        reports=False,
        histories=True,
        vertical=True,
        candidates=2,
        ensemble=EnsembleSettings(members=8),
        fragility=fragility,
    )
    scenes = load_scenes(tmp_path / "structures.yaml")
    spire = {name: scenes[name] for name in ("spire", "stocky")}
    study = Study({name: scene for name, scene in scenes.items() if name != "spire"}, settings, "made")
    worked(records, study, tmp_path)
    write_summary(outcomes_in(tmp_path, records), study, tmp_path / "summary")
    alone = replace(settings, fidelity="quick", histories=False, ensemble=EnsembleSettings(members=0))
    # On joints of half the friction the stocky block lifts before it slides, and needs more while it rocks.
    contact = replace(settings, fidelity="contact", histories=False, friction_coefficient=0.51)
    _write_tables([pulse], Study(spire, contact), tmp_path / "contact")
    failing = on_the_ground({"facade": study.structures["facade"], "impossible": Impossible()})
    too_stiff = Place("rack", (Support((Mode(period=1e-3, damping_ratio=0.05, participation=1.0),)),))
    failing["instrument"] = replace(failing["facade"], name="instrument", place=too_stiff)
    _write_tables([records[1], replace(pulse, scale_factor=6.0)], Study(failing, alone), tmp_path / "auto")
    standing = {name: study.scenes[name] for name in ("wall", "parapet")}
    write_fragility(records[1:3], Study(standing, settings), tmp_path / "fragility")
    columns, filled = set(), set()
    for path in tmp_path.rglob("*.csv"):
        with path.open(encoding="utf-8", newline="") as stream:
            rows = csv.DictReader(stream)
            columns |= {(path.name, name) for name in rows.fieldnames or ()}
            filled |= {(path.name, name) for row in rows for name, text in row.items() if text}
    assert columns - filled == EMPTY, sorted(columns - filled - EMPTY)
    assert len({name for name, _ in columns}) == 19
