"""Stations and epicentres as GeoJSON (RFC 7946), which QGIS and the libraries of geography open."""

import json
import math
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from rocking.assessment.rows import VerdictRow
from rocking.products.map.rows import StationRow

Properties = dict[str, Any]


def geojson(stations: Sequence[StationRow], verdicts: Sequence[VerdictRow]) -> bytes:
    """Return a point for each station, with its row, verdict and share of each structure, and one for each epicentre.

    verdicts: of each record and structure one. Longitude and latitude stand in this order, in degrees (WGS 84); what is
    not known is null. A share is the largest of those that make the verdict.
    """
    properties_of: dict[str, Properties] = {}
    for row in verdicts:
        of_record = properties_of.setdefault(row.record, {})
        of_record[f"{row.structure}: verdict"] = str(row.decision.verdict)
        of_record[f"{row.structure}: share"] = _number(row.overturning_share)
    features = [
        _point(
            longitude=station.station_longitude_deg,
            latitude=station.station_latitude_deg,
            properties={"kind": "station", **_cells(station), **properties_of.get(station.record, {})},
        )
        for station in stations
    ]
    features += [
        _point(longitude=longitude, latitude=latitude, properties={"kind": "epicentre", "event": event})
        for event, longitude, latitude in epicentres(stations)
    ]
    collection = {"type": "FeatureCollection", "features": features}
    return (json.dumps(collection, ensure_ascii=False, allow_nan=False, indent=1) + "\n").encode()


def epicentres(stations: Sequence[StationRow]) -> list[tuple[str, float, float]]:
    """Return event, longitude and latitude [degrees] of each epicentre that a row gives, once."""
    places = (
        (station.event, station.epicentre_longitude_deg, station.epicentre_latitude_deg)
        for station in stations
        if not math.isnan(station.epicentre_longitude_deg)
    )
    return list(dict.fromkeys(places))


def _cells(row: StationRow) -> Properties:
    places = (
        "station_latitude_deg",
        "station_longitude_deg",
        "epicentre_latitude_deg",
        "epicentre_longitude_deg",
    )
    names = (field.name for field in fields(row) if field.name not in places)
    return {name: _number(getattr(row, name)) for name in names}


def _number(value: Any) -> Any:
    """A value as JSON holds it: null for nan."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _point(*, longitude: float | None, latitude: float | None, properties: Properties) -> Properties:
    geometry = {"type": "Point", "coordinates": [longitude, latitude]}
    return {"type": "Feature", "geometry": geometry, "properties": properties}
