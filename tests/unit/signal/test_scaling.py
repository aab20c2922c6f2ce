"""Scaling a record to a measure: one factor on all of its components."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.catalogue import CatalogueRecord, open_station
from rocking.catalogue.catalogue import repeated
from rocking.errors import CatalogueError, ConfigurationError, RecordError
from rocking.quantities import GRAVITY
from rocking.signal.kinds import SignalKind
from rocking.signal.scaling import ScalingTarget
from rocking.study.job import Study
from rocking.study.settings import Settings, read_settings
from tests.refusals import refused

TIMES = np.arange(3000) * 0.01
MOTIONS = {
    "NS": 0.8 * np.sin(7 * TIMES) * np.exp(-((TIMES - 12) ** 2) / 9),
    "EW": 1.7 * np.sin(5 * TIMES) * np.exp(-((TIMES - 13) ** 2) / 9) + 0.05,
    "UD": 2.9 * np.sin(20 * TIMES) * np.exp(-((TIMES - 11) ** 2) / 9),
}


@pytest.fixture
def record(tmp_path: Path) -> CatalogueRecord:
    rows = zip(TIMES, *MOTIONS.values(), strict=True)
    text = "time,NS (m/s2),EW (m/s2),UD (m/s2)\n" + "".join(
        "{:.2f},{:.7f},{:.7f},{:.7f}\n".format(*row) for row in rows
    )
    (tmp_path / "r.csv").write_text(text)
    return CatalogueRecord("r", "r.csv", folder=tmp_path)


@pytest.mark.parametrize(("text", "value"), [
    ("pga 0.35 g", 0.35 * GRAVITY), ("PGA .35g", 0.35 * GRAVITY), ("pga 340 cm/s2", 3.4), ("pgv 50 cm/s", 0.5),
    ("pgv 0.5 m/s", 0.5), ("pga 3.5e-1 g", 0.35 * GRAVITY),
])  # fmt: skip
def test_a_target_in_its_unit(text: str, value: float) -> None:
    assert ScalingTarget.parse(text).value == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("text", [
    "0.35 g", "pga 0.35", "pga 0,35 g", "pga 0 g", "pga -1 g", "pga 1e400 g", "pgv 3 g", "pga 3 furlong", "pga nan g",
    "sa 0.3 g",
])  # fmt: skip
def test_what_is_no_target_is_refused(text: str) -> None:
    with pytest.raises(RecordError) as caught:
        ScalingTarget.parse(text)
    assert caught.value.field in ("scale_to", "unit")
    with refused(CatalogueError, "record"):
        CatalogueRecord("r", "r.csv", scale_to=text)
    with pytest.raises(ConfigurationError):
        read_settings({"scale_to": text})


def test_all_components_get_one_factor(record: CatalogueRecord) -> None:
    as_is = open_station(record)
    station = open_station(replace(record, scale_to="pga .35 g"))
    components = [*station.horizontal, station.vertical]
    factors = {component.scale_factor for component in components}
    assert len(factors) == 1 and factors.pop() == pytest.approx(
        0.35 * GRAVITY / as_is.horizontal[1].peak_acceleration
    )
    peaks = [one_component.peak_acceleration / GRAVITY for one_component in components]
    assert peaks[1] == pytest.approx(0.35, rel=1e-12) and peaks[0] < 0.2 and peaks[2] > 0.35
    assert all(
        "so that the larger PGA of the horizontal ones is .35 g" in other_component.processing[-1]
        for other_component in components
    )


@pytest.mark.parametrize("apply", ["always", "never"])
def test_a_study_scales_the_motion_that_acts(record: CatalogueRecord, apply: str) -> None:
    """After processing, which changes the peak; a row's own target comes before that of the study."""
    settings = read_settings({"scale_to": "pga 0.35 g", "vertical": True, "processing": {"apply": apply}})
    horizontal, vertical = Study({}, settings).open(replace(record, scale_factor=3.0))
    assert max(component.peak_acceleration for component in horizontal) == pytest.approx(
        0.35 * GRAVITY, rel=1e-12
    )
    assert (
        vertical is not None
        and len({other_component.scale_factor for other_component in (*horizontal, vertical)}) == 1
    )
    horizontal, _ = Study({}, settings).open(replace(record, scale_to="pga 0.1 g"))
    assert max(one_component.peak_acceleration for one_component in horizontal) == pytest.approx(
        0.1 * GRAVITY, rel=1e-12
    )
    assert Study({}, Settings()).open(record)[0][0].scale_factor == 1


def test_a_factor_beyond_ten_is_told(record: CatalogueRecord) -> None:
    for text, is_told in (("pga 1.7 g", False), ("pga 1.9 g", True), ("pga 0.01 g", True)):
        (north, _) = open_station(replace(record, scale_to=text)).horizontal
        assert (SignalKind.SCALED_FAR in {warning.kind for warning in north.warnings}) == is_told, text


def test_a_velocity_is_reached(record: CatalogueRecord) -> None:
    station = open_station(replace(record, scale_to="pgv 30 cm/s"))
    assert max(component.measures.peak_velocity for component in station.horizontal) == pytest.approx(
        0.3, rel=1e-9
    )


def test_what_cannot_be_scaled_is_refused(record: CatalogueRecord, tmp_path: Path) -> None:
    with refused(CatalogueError, "record"):
        replace(record, scale_to="pga 1 g", scale_factor=2.0)
    (tmp_path / "r.csv").write_text("time,NS (m/s2)\n" + "".join(f"{t:.2f},0.0\n" for t in TIMES))
    with refused(RecordError, "scale_to", "pga 1 g"):
        open_station(replace(record, scale_to="pga 1 g"))


def test_two_targets_of_one_file_are_two_motions(record: CatalogueRecord) -> None:
    rows = [replace(record, id=f"r{i}", sha256="1" * 64, scale_to=f"pga 0.{i} g") for i in (1, 2)]
    assert repeated(rows) == () and len(repeated([rows[0], replace(rows[0], id="again")])) == 1
