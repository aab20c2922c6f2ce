"""The map: GeoJSON by the rules of RFC 7946, the rows behind it, and a plane that keeps distances."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.assessment.rows import VerdictRow
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import EnsembleSettings
from rocking.catalogue.catalogue import CatalogueRecord
from rocking.catalogue.place import Coordinates
from rocking.products.map.geojson import geojson
from rocking.products.map.report import drawn_together, map_figure, map_panel, origin_of, plane
from rocking.products.map.rows import StationRow
from rocking.products.map.work import Map
from rocking.structures import Block
from rocking.study.job import Study
from rocking.study.settings import Settings
from rocking.study.work import Rows
from rocking.tables import read_table, rows_of
from tests.synthetic import SyntheticRecord, at2_text
from tests.unit.study.made_jobs import made_job, worked

EPICENTRE = {"epicentre_latitude": 42.35, "epicentre_longitude": 13.38}
PLACES = {
    "near": {"station_latitude": 42.37, "station_longitude": 13.34} | EPICENTRE,
    "far": {"station_latitude": 42.70, "station_longitude": 13.9} | EPICENTRE,
    "swapped": {"station_latitude": 113.0, "station_longitude": 42.0},
    "nowhere": {},
}
STRUCTURES = {"slender": Block.of_size(0.5, 3.0), "stout": Block.of_size(1.5, 3.0)}


@pytest.fixture(scope="module")
def made(tmp_path_factory) -> tuple[Path, Rows, list[str]]:
    """The folder of the map of four records, its rows and what its job told; two of them are at a place."""
    folder = tmp_path_factory.mktemp("map")
    records = []
    for seed, (name, place) in enumerate(PLACES.items()):
        recipe = SyntheticRecord(name=name, seed=seed, pulse_amplitude=4.0 / (1 + seed), pulse_period=0.8)
        (folder / f"{name}.AT2").write_text(at2_text(recipe))
        cells = {"unit": "g", "event": "L'Aquila", "station": name, "folder": folder}
        records.append(CatalogueRecord(name, f"{name}.AT2", **cells, **place))
    settings = Settings(
        ensemble=EnsembleSettings(members=16, reserve=0),
        processing_variants=False,
        reports=False,
        histories=True,
    )
    study = Study(on_the_ground(STRUCTURES), settings, "made")
    worked(records, study, folder / "results")
    told: list[str] = []
    job = made_job(records, study, folder / "results", "map")
    job.folder.mkdir(parents=True, exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("rocking.study.job.tell", told.append)
        return job.folder, Map().make(job).rows, told


def features(content: bytes) -> list[dict]:
    """The features of a GeoJSON text of points, checked by the rules of RFC 7946 that such a text can break."""
    text = content.decode("utf-8")
    assert not text.startswith("\ufeff"), "section 12: no byte order mark"
    parsed = json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert parsed["type"] == "FeatureCollection" and isinstance(parsed["features"], list), "3.3"
    assert not {"crs", "coordinates", "geometry", "properties"} & set(parsed), "4 and 7.1"
    for feature in parsed["features"]:
        assert feature["type"] == "Feature" and isinstance(feature["properties"], dict), "3.2"
        assert not {"coordinates", "geometries", "features"} & set(feature), "7.1"
        assert set(feature["geometry"]) == {"type", "coordinates"} and feature["geometry"]["type"] == "Point"
        longitude, latitude = feature["geometry"]["coordinates"]  # 3.1.1: in this order
        assert -180 <= longitude <= 180 and -90 <= latitude <= 90, "4: WGS 84 in degrees"
    return parsed["features"]


def test_each_station_with_coordinates_is_a_point_with_its_row_and_its_words(made):
    folder, rows, told = made
    found = features((folder / "stations.geojson").read_bytes())
    stations = {
        feature["properties"]["record"]: feature
        for feature in found
        if feature["properties"]["kind"] == "station"
    }
    assert list(stations) == ["near", "far"] and ["2 stations" in line for line in told] == [True]
    by_name = {row.record: row for row in read_table(StationRow, folder)}
    verdicts = rows_of(VerdictRow, rows)
    for record, feature in stations.items():
        place = PLACES[record]
        row, properties = by_name[record], feature["properties"]
        assert feature["geometry"]["coordinates"] == [place["station_longitude"], place["station_latitude"]]
        assert properties["peak_acceleration_m_s2"] == row.peak_acceleration_m_s2 > 0
        shares = {
            verdict.structure: verdict.overturning_share for verdict in verdicts if verdict.record == record
        }
        assert properties["expected_falls"] == pytest.approx(sum(shares.values()))
        for structure, share in shares.items():
            assert properties[f"{structure}: share"] == share
        words = {
            verdict.structure: str(verdict.decision.verdict)
            for verdict in verdicts
            if verdict.record == record
        }
        assert {name: properties[f"{name}: verdict"] for name in STRUCTURES} == words
    (star,) = [feature for feature in found if feature["properties"]["kind"] == "epicentre"]
    assert star["geometry"]["coordinates"] == [13.38, 42.35], "once, though two rows give it"


def station(record: str, latitude: float, longitude: float, event: str = "one") -> StationRow:
    return StationRow(
        record=record,
        station=record,
        event=event,
        station_latitude_deg=latitude,
        station_longitude_deg=longitude,
        epicentre_latitude_deg=math.nan,
        epicentre_longitude_deg=math.nan,
        peak_acceleration_m_s2=1.0,
        peak_velocity_m_s=0.1,
        structures=2,
        expected_falls=math.nan,
    )


def test_what_is_not_known_is_null_and_without_stations_the_collection_is_empty():
    assert features(geojson([], [])) == []
    (feature,) = features(geojson([station("a", 1.0, 2.0)], []))
    assert feature["properties"]["expected_falls"] is None


def test_the_plane_keeps_distances_also_across_the_date_line():
    """To a percent within 100 km, by the great circle."""
    random = np.random.default_rng(69)
    for longitude in (13.0, 179.9, -180.0):
        for latitude in (-44.0, 0.0, 60.0):
            spread = random.uniform(-0.4, 0.4, (8, 2))
            easts = (longitude + spread[:, 0] + 180) % 360 - 180
            rows = [station(str(k), latitude + spread[k, 1], easts[k]) for k in range(8)]
            origin = origin_of(rows)
            east, north = plane(easts, latitude + spread[:, 1], origin)
            assert np.abs(east).max() < 100 and abs(east.max() + east.min()) < 1e-6
            for k in range(1, 8):
                one, other = (
                    Coordinates(latitude=latitude + spread[place, 1], longitude=easts[place])
                    for place in (0, k)
                )
                flat = math.hypot(east[k] - east[0], north[k] - north[0])
                assert flat == pytest.approx(one.distance_to(other), rel=0.015, abs=0.1)


def test_stations_of_one_earthquake_are_drawn_together_and_those_of_many_not():
    here = [station("a", 1.0, 2.0), station("b", 1.1, 2.0)]
    away = station("c", 50.0, 90.0, "another")
    assert drawn_together([*here, away]) == here
    assert drawn_together([here[0], away]) == []
    assert drawn_together(here[:1]) == here[:1], "the only one"
    assert drawn_together([]) == []


@pytest.mark.parametrize("count", [1, 2, 60])
def test_every_station_is_drawn_where_it_is_in_the_colour_of_its_word(made, count):
    _, rows, _ = made
    of_near = next(verdict for verdict in rows_of(VerdictRow, rows) if verdict.structure == "slender")
    stations = [station(f"s{k}", 42 + 0.01 * k, 13 - 0.02 * k) for k in range(count)]
    verdicts = [replace(of_near, record=station.record) for station in stations]
    axes = map_figure(stations, verdicts, ["slender"]).axes[0]
    drawn = np.array([collection.get_offsets()[0] for collection in axes.collections])
    origin = origin_of(stations)
    expected = np.column_stack(plane(-0.02 * np.arange(count) + 13, 0.01 * np.arange(count) + 42, origin))
    assert sorted(map(tuple, drawn.round(6))) == sorted(map(tuple, expected.round(6)))
    low, high = axes.get_xlim()
    assert low < drawn[:, 0].min() and drawn[:, 0].max() < high and 1 <= len(axes.texts) <= count


@pytest.mark.parametrize(("latitude", "longitude", "middle"), [
    (42.125, 13.5, "42.12° N, 13.50° E"), (-33.5, -70.6, "33.50° S, 70.60° W"), (0.0, 0.0, "0.00° N, 0.00° E"),
])  # fmt: skip
def test_the_axes_of_a_map_say_from_where_they_count(latitude, longitude, middle):
    axes = map_figure([station("a", latitude, longitude)], [], ["slender"]).axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == (f"east of {middle} [km]", "north [km]")


def test_the_summary_shows_the_worst_structures_and_no_map_without_stations(made):
    _, rows, _ = made
    panel = Map().panel(rows)
    assert (
        panel is not None
        and "<svg" in panel.parts[0].pictures[0].svg
        and "L'Aquila" in panel.parts[0].caption
    )
    assert Map().panel({**rows, StationRow: []}) is None
    alone = map_panel(rows_of(StationRow, rows)[:1], rows_of(VerdictRow, rows))
    assert "epicentre" in alone.parts[0].caption
