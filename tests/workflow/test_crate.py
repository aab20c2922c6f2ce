"""A finished study as an RO-Crate, by the report plug-in of the extra crate, which needs no network."""

import json
import shutil
from pathlib import Path

import pytest

import rocking
from rocking.study.cli import main

ROOT = Path(rocking.__file__).parents[1]
LICENCE = "https://spdx.org/licenses/CC0-1.0"


@pytest.mark.slow
def test_a_finished_study_is_described_as_a_crate(tmp_path):
    pytest.importorskip("snakemake_report_plugin_fairscape", reason="the plug-in comes with the extra crate")
    folder = tmp_path / "study"
    assert main(["start", str(folder)]) == 0
    pier = "- {name: pier, type: block, breadth_m: 2.0, height_m: 9.0}\n"
    (folder / "structures.yaml").write_text(pier, encoding="utf-8")
    shutil.copy(ROOT / "records" / "synthetic_strong_pulse.AT2", folder / "records")
    assert main(["catalogue", str(folder / "records")]) == 0
    assert main(["run", str(folder), "--", "--cores", "1", "--quiet"]) == 0
    reporter = ["--reporter", "fairscape", "--report-fairscape-license", LICENCE]
    assert main(["run", str(folder), "--", *reporter]) == 0
    graph = json.loads((folder / "ro-crate-metadata.json").read_text(encoding="utf-8"))["@graph"]
    (root,) = (entity for entity in graph if "Dataset" in entity["@type"] and "hasPart" in entity)
    assert root["license"] == LICENCE
    names = {entity["name"] for entity in graph if "name" in entity}
    assert {"maxima.csv", "report.pdf", "synthetic_strong_pulse.AT2", "assess_00000_of_00001"} <= names
