"""OpenQuake reads the fragility that we write, and its integral over a hazard curve of its own is ours."""

import csv
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rocking import Block, Fragility, Hazard, Pulse, fragility
from rocking.records import Accelerogram

ENGINE = Path(sys.prefix) / "openquake" / "bin" / "oq"
LEVELS = np.geomspace(0.05, 40.0, 400)
"""m/s, so dense that OpenQuake's sum over them is its integral, and so far that nothing is left that it leaves out."""
SLOPE = 2.2
RATES = 1e-3 * (LEVELS / 0.2) ** -SLOPE

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not ENGINE.is_file(), reason="OpenQuake is not installed; make openquake"),
]

JOB = """[general]
description = rocking
calculation_mode = classical_damage
[exposure]
exposure_file = exposure.xml
[hazard]
hazard_curves_file = hazard.csv
investigation_time = 1.0
[vulnerability]
structural_fragility_file = fragility.xml
[risk]
risk_investigation_time = 1.0
"""
EXPOSURE = """<?xml version="1.0" encoding="UTF-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <exposureModel id="one" category="buildings" taxonomySource="rocking">
    <description>one pier</description>
    <conversions><costTypes><costType name="structural" type="per_asset" unit="EUR"/></costTypes></conversions>
    <occupancyPeriods></occupancyPeriods>
    <assets>exposure.csv</assets>
  </exposureModel>
</nrml>
"""


@pytest.fixture(scope="module")
def curve() -> Fragility:
    step = 0.01 * np.arange(600)
    pulses = [
        Pulse(amplitude=3.0, circular_frequency=omega, start_time=0.5) for omega in np.linspace(3.0, 9.0, 12)
    ]
    records = [Accelerogram(pulse.acceleration(step), 0.01) for pulse in pulses]
    return fragility(records, Block(2.0, 0.2), stations=[f"S{k}" for k in range(12)])


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A calculation of OpenQuake without its fragility."""
    (tmp_path / "job.ini").write_text(JOB)
    (tmp_path / "exposure.xml").write_text(EXPOSURE)
    (tmp_path / "exposure.csv").write_text("id,lon,lat,taxonomy,number,structural\na1,10.0,45.0,pier,1,1\n")
    facts = "generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=1.0, imt='PGV'"
    names = ",".join(f"poe-{100 * level:.7f}" for level in LEVELS)
    values = ",".join(f"{probability:.10e}" for probability in -np.expm1(-RATES))
    lines = f'#,,,"{facts}"\nlon,lat,depth,{names}\n10.0,45.0,0.0,{values}\n'
    (tmp_path / "hazard.csv").write_text(lines)
    return tmp_path


def _rate(folder: Path) -> float:
    """The annual rate of the one damage state by OpenQuake."""
    environment = {**os.environ, "OQ_DATADIR": str(folder / "data"), "HOME": str(folder)}
    environment.pop("PYTHONPATH", None)
    command = [str(ENGINE), "engine", "--run", "job.ini", "--exports", "csv"]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    tables = sorted(folder.glob("damages-rlz*.csv"))
    assert tables, done.stderr[-2000:]
    with tables[0].open(encoding="utf-8") as stream:
        next(stream)
        (row,) = csv.DictReader(stream)
    return -math.log1p(-float(row["structural-overturning"]))


def test_the_integral_over_the_discrete_curve_is_ours(folder, curve):
    curve.to_nrml(folder / "fragility.xml", name="pier")
    ours = curve.annual_rate(Hazard.read(folder / "hazard.csv")).value
    assert _rate(folder) == pytest.approx(ours, rel=0.01)  # both sum over steps of 2 % of the level


def test_the_integral_over_the_lognormal_is_its_closed_form(folder, curve):
    """1e-3 (m/0.2)^−k exp(k²β²/2) under a power law of slope k."""
    curve.to_nrml(folder / "fragility.xml", name="pier", lognormal=True)
    spread = math.exp(SLOPE**2 * curve.dispersion**2 / 2)
    exact = 1e-3 * (curve.lognormal_median / 0.2) ** -SLOPE * spread
    assert _rate(folder) == pytest.approx(exact, rel=0.01)
