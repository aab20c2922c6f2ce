"""The map of a study: the stations that have coordinates as table and GeoJSON, and drawn for the summary."""

from rocking.assessment.rows import ExpectedFallsRow, RecordRow, VerdictRow, falls_under, worst_period_each
from rocking.products.map.geojson import geojson
from rocking.products.map.report import drawn_together, map_panel
from rocking.products.map.rows import StationRow, station_rows
from rocking.quantities import counted
from rocking.reports.pages import Panel
from rocking.study.job import Job
from rocking.study.kept import Kept, Rows
from rocking.study.work import Work
from rocking.tables import rows_of, write_tables, write_whole


class Map(Work):
    """Where it happened."""

    shown = (StationRow, VerdictRow)
    sheets = (StationRow,)

    def make(self, job: Job) -> Kept:
        """Write the stations as table and GeoJSON."""
        instead = [name for name, scene in job.study.scenes.items() if scene.variant_of]
        records: list[list[RecordRow]] = []
        verdicts: list[VerdictRow] = []
        falls: dict[str, ExpectedFallsRow | None] = {}
        for outcome in job.outcomes():
            of_record = rows_of(VerdictRow, outcome.rows)
            records.append(rows_of(RecordRow, outcome.rows))
            verdicts += worst_period_each(of_record)
            falls |= {record_row.record: falls_under(of_record, instead) for record_row in of_record[:1]}
        stations = station_rows(records, falls)
        write_tables({StationRow: stations}, job.folder, "rocking-map", "stations.json")
        write_whole(job.folder / "stations.geojson", geojson(stations, verdicts))
        if missing := sum(map(bool, records)) - len(stations):
            job.show_line(f"{counted(missing, 'station')} without coordinates, which the map leaves out")
        placed = {station.record for station in stations}
        return Kept({StationRow: stations, VerdictRow: [row for row in verdicts if row.record in placed]})

    def panel(self, rows: Rows) -> Panel | None:
        """Return a map of each of the worst structures at the stations of one earthquake; None without one to draw."""
        stations = drawn_together(rows_of(StationRow, rows))
        return map_panel(stations, rows_of(VerdictRow, rows)) if stations else None
