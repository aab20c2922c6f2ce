"""The table of the stations that have coordinates."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from rocking.assessment.rows import ExpectedFallsRow, RecordRow
from rocking.tables import Columns, RowOf, row


@dataclass(frozen=True)
class Recorded:
    """What a station recorded of one earthquake: the rows of its components, and what is expected to fall there."""

    components: tuple[RecordRow, ...]
    falls: ExpectedFallsRow | None

    @property
    def first(self) -> RecordRow:
        """The row of its first component."""
        return self.components[0]

    @property
    def peak_acceleration(self) -> float:
        """The largest of its horizontal components, m/s²."""
        return max(component.peak_acceleration_m_s2 for component in self.components)

    @property
    def peak_velocity(self) -> float:
        """The largest of its horizontal components, m/s."""
        return max(component.peak_velocity_m_s for component in self.components)


of_station = Columns(Recorded)
of_first = of_station.part(lambda of: of.first)
of_falls = of_station.optional(lambda of: of.falls)


@row("stations")
class StationRow(RowOf[Recorded]):
    """One row per record whose station has coordinates: where it stands, how it shook, and what is expected to fall."""

    record: str = of_first("Record", lambda first: first.record)
    station: str = of_first("Recording station", lambda first: first.station)
    event: str = of_first("Earthquake", lambda first: first.event)
    station_latitude_deg: float | None = of_first(
        "Latitude of the station, north", lambda first: first.station_latitude_deg
    )
    station_longitude_deg: float | None = of_first(
        "Longitude of the station, east", lambda first: first.station_longitude_deg
    )
    epicentre_latitude_deg: float = of_first(
        "Latitude of the epicentre, north, as the catalogue declares it",
        lambda first: first.epicentre_latitude_deg,
    )
    epicentre_longitude_deg: float = of_first(
        "Longitude of the epicentre, east, as the catalogue declares it",
        lambda first: first.epicentre_longitude_deg,
    )
    peak_acceleration_m_s2: float = of_station(
        "Largest magnitude of the acceleration of its horizontal components", lambda of: of.peak_acceleration
    )
    peak_velocity_m_s: float = of_station(
        "Largest magnitude of the velocity of its horizontal components", lambda of: of.peak_velocity
    )
    structures: int | None = of_falls("Number of structures", lambda falls: falls.structures)
    expected_falls: float = of_falls(
        "Sum of the shares that overturn, of the structures that have one", lambda falls: falls.expected_falls
    )


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
            rows.append(StationRow.of(Recorded(components, falls.get(first.record))))
    return rows
