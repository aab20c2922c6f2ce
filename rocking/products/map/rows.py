"""The table of the stations that have coordinates."""

import math
from collections.abc import Iterable, Mapping

from rocking.assessment.rows import ExpectedFallsRow, RecordRow
from rocking.tables import Row, column, row


@row("stations")
class StationRow(Row):
    """One row per record whose station has coordinates: where it stands, how it shook, and what is expected to fall."""

    record: str = column("Record")
    station: str = column("Recording station")
    event: str = column("Earthquake")
    station_latitude_deg: float | None = column("Latitude of the station, north")
    station_longitude_deg: float | None = column("Longitude of the station, east")
    epicentre_latitude_deg: float = column("Latitude of the epicentre, north, as the catalogue declares it")
    epicentre_longitude_deg: float = column("Longitude of the epicentre, east, as the catalogue declares it")
    peak_acceleration_m_s2: float = column(
        "Largest magnitude of the acceleration of its horizontal components"
    )
    peak_velocity_m_s: float = column("Largest magnitude of the velocity of its horizontal components")
    structures: int | None = column("Number of structures")
    expected_falls: float = column("Sum of the shares that overturn, of the structures that have one")


def station_rows(
    records: Iterable[Iterable[RecordRow]], falls: Mapping[str, ExpectedFallsRow | None]
) -> list[StationRow]:
    """Return the rows of the records whose station has coordinates, in their order.

    records: of each the rows of its components. falls: by record.
    """
    rows = []
    for components in map(tuple, records):
        first = components[0] if components else None
        placed = first and None not in (first.station_latitude_deg, first.station_longitude_deg)
        if first and placed:
            expected = falls.get(first.record)
            rows.append(
                StationRow(
                    record=first.record,
                    station=first.station,
                    event=first.event,
                    station_latitude_deg=first.station_latitude_deg,
                    station_longitude_deg=first.station_longitude_deg,
                    epicentre_latitude_deg=first.epicentre_latitude_deg,
                    epicentre_longitude_deg=first.epicentre_longitude_deg,
                    peak_acceleration_m_s2=max(row.peak_acceleration_m_s2 for row in components),
                    peak_velocity_m_s=max(row.peak_velocity_m_s for row in components),
                    structures=expected.structures if expected else None,
                    expected_falls=expected.expected_falls if expected else math.nan,
                )
            )
    return rows
