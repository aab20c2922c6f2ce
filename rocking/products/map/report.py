"""Stations on a plane in km, coloured by what becomes of a structure: no tiles and no network."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.assessment.decide import worst_first
from rocking.assessment.rows import VerdictRow
from rocking.products.map.geojson import epicentres
from rocking.products.map.rows import StationRow
from rocking.reports.pages import Panel, Section
from rocking.reports.printing import LOOKS, cell_text
from rocking.reports.style import elided, new_figure, picture, styled

MOST_DRAWN = 4
"""Structures that have a map in the summary, the worst first; the page to explore has all."""
_DEGREE = 111.195
"""Length of a degree of a great circle, km, on a sphere of the mean radius of the earth."""
_LABEL = 0.22, 0.07
"""Width and height of a sign with its share, as part of the extent of a map."""
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.3, "alpha": 0.8}
_LEAST = 2.0
"""Least extent of a map, km: of one station, or of several in one place."""


def drawn_together(stations: Sequence[StationRow]) -> list[StationRow]:
    """Return the stations of the earthquake that has most; none where several earthquakes have one each.

    Stations of several earthquakes may lie half the earth apart, and say nothing of where one of them did most.
    """
    of_each: dict[str, list[StationRow]] = {}
    for station in stations:
        of_each.setdefault(station.event, []).append(station)
    most = max(of_each.values(), key=len, default=[])
    return most if len(most) > 1 or len(of_each) == 1 else []


def map_panel(stations: Sequence[StationRow], verdicts: Sequence[VerdictRow]) -> Panel:
    """Return a map of each of the worst structures at stations of one earthquake.

    verdicts: of each record and structure one.
    """
    here = {station.record for station in stations}
    worst = worst_first((row.structure, row.severity) for row in verdicts if row.record in here)
    figure = map_figure(stations, verdicts, worst[:MOST_DRAWN])
    epicentre = "; the star is the epicentre" if epicentres(stations) else ""
    event = f" of {stations[0].event}" if stations[0].event else ""
    caption = (
        f"The stations{event}, each in the colour of the verdict on a structure under its record, with its sign and "
        f"the share that overturns where there is room{epicentre}. stations.geojson holds every structure and station, "
        "for a GIS; study.html has a map of each structure."
    )
    drawn = picture(figure, "The stations on a map, by what becomes of a structure.")
    return Panel("Where it happened", (Section(pictures=(drawn,), caption=caption),))


def plane(
    longitudes: np.ndarray, latitudes: np.ndarray, origin: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Return places east and north of an origin (longitude, latitude), km, of coordinates (k,) in degrees.

    The equirectangular projection: exact along the parallel of the origin, and some percent long or short 500 km from
    it. The way round the earth is the shorter one.
    """
    turn = (np.asarray(longitudes) - origin[0] + 180) % 360 - 180
    east = _DEGREE * turn * math.cos(math.radians(origin[1]))
    return east, _DEGREE * (np.asarray(latitudes) - origin[1])


def origin_of(stations: Sequence[StationRow]) -> tuple[float, float]:
    """Return longitude and latitude of the middle of the stations, degrees, also where they lie about ±180°."""
    first = stations[0].station_longitude_deg
    turns = [
        ((_known(station.station_longitude_deg) - _known(first) + 180) % 360 - 180) for station in stations
    ]
    latitudes = [_known(station.station_latitude_deg) for station in stations]
    longitude = _known(first) + (min(turns) + max(turns)) / 2
    return (longitude + 180) % 360 - 180, (min(latitudes) + max(latitudes)) / 2


def _known(value: float | None) -> float:
    return math.nan if value is None else value


@styled
def map_figure(
    stations: Sequence[StationRow], verdicts: Sequence[VerdictRow], structures: Sequence[str]
) -> Figure:
    """Return a map for each structure. verdicts: of each record and structure one."""
    by_case = {(row.record, row.structure): row for row in verdicts}
    columns = min(len(structures), 2)
    rows = math.ceil(len(structures) / 2)
    figure = new_figure(72.0 * rows, margins=(13.0, 3.0, 9.0, 5.0))
    figure.subplots_adjust(hspace=0.3, wspace=0.25)
    panels = np.atleast_1d(figure.subplots(rows, columns, squeeze=False).ravel())
    for axes, structure in zip(panels, structures, strict=False):
        _draw(axes, stations, [by_case.get((station.record, structure)) for station in stations])
        axes.set_title(elided(structure, 42), fontsize=8, fontweight="bold", loc="left")
    for axes in panels[len(structures) :]:
        axes.set_axis_off()
    return figure


def _draw(axes: Axes, stations: Sequence[StationRow], verdicts: Sequence[VerdictRow | None]) -> None:
    """Draw the stations with the verdict of one structure, the worst on top, and the epicentres.

    A share is written where no worse one stands so near.
    """
    origin = origin_of(stations)
    east, north = plane(
        np.array([_known(station.station_longitude_deg) for station in stations]),
        np.array([_known(station.station_latitude_deg) for station in stations]),
        origin,
    )
    extent = max(np.ptp(east), np.ptp(north), _LEAST)
    labels: list[tuple[float, float]] = []
    worst_first = sorted(range(len(stations)), key=lambda place: -_badness(verdicts[place]))
    for place in worst_first:
        row = verdicts[place]
        here = float(east[place]), float(north[place])
        on_top = 2 + (_badness(row) + 1) / 100
        if row is None:
            axes.plot(*here, "x", color="0.5", markersize=4, zorder=on_top)
            continue
        _, fill, _, hatch = LOOKS[row.decision.verdict]
        edge = (0, (1.5, 1)) if hatch else "-"
        axes.scatter(*here, s=38, c=fill, edgecolors="black", linewidths=0.6, linestyle=edge, zorder=on_top)
        near = (max(abs(there[k] - here[k]) / extent / _LABEL[k] for k in (0, 1)) < 1 for there in labels)
        if not any(near):
            labels.append(here)
            label = cell_text(row.decision)
            axes.annotate(label, here, (4, 3), textcoords="offset points", fontsize=6, bbox=_PAPER, zorder=3)
    for _, longitude, latitude in epicentres(stations):
        there = plane(np.array([longitude]), np.array([latitude]), origin)
        axes.plot(
            *there, marker="*", color="white", markeredgecolor="black", markersize=9, linestyle="", zorder=4
        )
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.15)
    for low, high, widen in ((*axes.get_xlim(), axes.set_xlim), (*axes.get_ylim(), axes.set_ylim)):
        if high - low < _LEAST:
            widen((low + high - _LEAST) / 2, (low + high + _LEAST) / 2)
    north_or_south = "S" if origin[1] < 0 else "N"
    east_or_west = "W" if origin[0] < 0 else "E"
    middle = f"{abs(origin[1]):.2f}° {north_or_south}, {abs(origin[0]):.2f}° {east_or_west}"
    axes.set_xlabel(f"east of {middle} [km]")
    axes.set_ylabel("north [km]")


def _badness(row: VerdictRow | None) -> float:
    return -1.0 if row is None else float(row.decision.verdict.badness)
