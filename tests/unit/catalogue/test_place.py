"""Places: what a catalogue gives of them, what is wrong with it, and how far two are apart."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rocking
from rocking.catalogue import CatalogueRecord, open_station
from rocking.catalogue.place import Coordinates, place_of
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning

STEP = 0.01
FILE = "one.csv"
SHIPPED = Path(rocking.__file__).parents[1] / "records"


@pytest.mark.parametrize(
    ("latitude", "longitude", "kind"),
    [
        (137.5, 200.0, RecordKind.PLACE_IMPOSSIBLE),
        (95.0, 170.0, RecordKind.PLACE_IMPOSSIBLE),
        (42.0, -180.5, RecordKind.PLACE_IMPOSSIBLE),
        (173.05, -42.62, RecordKind.PLACE_SWAPPED),
        (-42.62, None, RecordKind.PLACE_HALF),
        (None, 0.0, RecordKind.PLACE_HALF),
    ],
)
def test_what_is_wrong_is_said_with_the_columns(latitude, longitude, kind):
    for of in ("station", "epicentre"):
        found = place_of(latitude=latitude, longitude=longitude, of=of)
        assert isinstance(found, RockingWarning) and found.kind is kind
        assert f"{of}_latitude_deg" in str(found) and f"{of}_longitude_deg" in str(found)


def test_what_can_be_is_a_place_to_the_poles_and_the_date_line():
    assert place_of(latitude=None, longitude=None) is None
    for latitude, longitude in ((90.0, 180.0), (-90.0, -180.0), (0.0, 0.0)):
        assert place_of(latitude=latitude, longitude=longitude) == Coordinates(
            latitude=latitude, longitude=longitude
        )


def test_distances_are_those_of_the_cosine_rule_of_spherical_trigonometry():
    """By another formula; and a quarter of the meridian is a quarter of the circumference."""
    random = np.random.default_rng(69)
    for _ in range(50):
        a, b = (
            Coordinates(latitude=random.uniform(-85, 85), longitude=random.uniform(-180, 180))
            for _ in range(2)
        )
        p, q, turn = (math.radians(case) for case in (a.latitude, b.latitude, a.longitude - b.longitude))
        angle = math.acos(math.sin(p) * math.sin(q) + math.cos(p) * math.cos(q) * math.cos(turn))
        assert a.distance_to(b) == pytest.approx(6371.0088 * angle, rel=1e-9)
    assert Coordinates(latitude=0.0, longitude=179.0).distance_to(
        Coordinates(latitude=90.0, longitude=3.0)
    ) == pytest.approx(6371.0088 * math.pi / 2)
    assert (
        Coordinates(latitude=10.0, longitude=179.99).distance_to(
            Coordinates(latitude=10.0, longitude=-179.99)
        )
        < 3.0
    )


@pytest.fixture
def row(tmp_path) -> CatalogueRecord:
    """A row whose file states no coordinates."""
    times = np.arange(0, 4, STEP)
    values = "\n".join(f"{item:.6f}" for item in 2 * np.sin(6 * times))
    (tmp_path / FILE).write_text(f"{values}\n", encoding="utf-8")
    return CatalogueRecord("one", FILE, unit="m/s2", time_step=STEP, component="N", folder=tmp_path)


def test_a_row_places_the_station_and_what_cannot_be_costs_the_record_nothing(row):
    (placed,) = open_station(replace(row, station_latitude=-42.6, station_longitude=173.1)).horizontal
    assert (placed.latitude, placed.longitude) == (-42.6, 173.1)
    assert not any(warning.kind.name.startswith("PLACE") for warning in placed.warnings)
    wrong = {"station_latitude": 173.1, "station_longitude": -42.6, "epicentre_latitude": 42.0}
    (kept,) = open_station(replace(row, **wrong)).horizontal
    told = [one_warning.kind for one_warning in kept.warnings if one_warning.kind.name.startswith("PLACE")]
    assert told == [RecordKind.PLACE_SWAPPED, RecordKind.PLACE_HALF]
    assert kept.latitude is None and np.array_equal(kept.acceleration, placed.acceleration)


def test_a_place_unlike_that_of_the_file_is_used_and_told_with_both():
    here = {"station_latitude": -42.6194, "station_longitude": 173.0536}
    shipped = CatalogueRecord("w", "20161113_110259_WTMC_20.V2A", folder=SHIPPED)
    stated = open_station(shipped).horizontal[0]
    for shift, is_told in ((0.0, False), (0.005, False), (0.5, True)):
        moved = here | {"station_latitude": here["station_latitude"] + shift}
        found = open_station(replace(shipped, **moved)).horizontal[0]
        told = [warning for warning in found.warnings if warning.kind is RecordKind.PLACE_UNLIKE_FILE]
        assert bool(told) == is_told and found.latitude == moved["station_latitude"]
    apart = Coordinates(latitude=stated.latitude, longitude=stated.longitude).distance_to(
        Coordinates(latitude=found.latitude, longitude=found.longitude)
    )
    assert apart == pytest.approx(0.5 * 111.195, rel=1e-3) and f"{apart:.3g} km" in str(told[0])
