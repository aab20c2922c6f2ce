"""Rows of rotation histories: each case of a record as it moves."""

from collections.abc import Iterator, Mapping, Sequence

from rocking.assessment.rows import meanings
from rocking.errors import RockingError
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.records.rotation import aligned
from rocking.structures import Structure
from rocking.tables import Row, column, row


@row(
    "histories",
    "One row per component, structure and step: the rotation as it was integrated, until it overturns",
)
class HistoryRow(Row):
    """One step of one response."""

    record: str = column(meanings.RECORD)
    component: str = column(meanings.COMPONENT)
    structure: str = column(meanings.STRUCTURE)
    time_s: float = column("Time after the first sample")
    rotation_rad: float = column("Rotation, signed by the side; zero before uplift")
    angular_velocity_rad_s: float = column("Its derivative, after the impact where there is one")


def history_rows(
    record: str,
    accelerograms: Sequence[Accelerogram],
    structures: Mapping[str, Structure],
    tolerance: float,
    vertical: Accelerogram | None = None,
) -> Iterator[HistoryRow]:
    """Yield the history of the mechanism of each structure under each component, as responses.csv sums it up.

    tolerance: of the integration, relative to the critical rotation. vertical: the vertical component, where it acts.
    A structure that cannot be integrated has no rows; failures.csv says why.
    """
    for accelerogram in accelerograms:
        beside = None if vertical is None else aligned(vertical, accelerogram)
        for name, structure in structures.items():
            try:
                mechanism = structure.mechanism()
                response = integrate(mechanism, accelerogram, tolerance, history=True, vertical=beside)
            except RockingError:
                continue
            if response.times is None or response.rotation is None or response.angular_velocity is None:
                continue
            steps = (response.times, response.rotation, response.angular_velocity)
            for time, rotation, velocity in zip(*(each.tolist() for each in steps), strict=True):
                yield HistoryRow(
                    record=record,
                    component=accelerogram.component,
                    structure=name,
                    time_s=time,
                    rotation_rad=rotation,
                    angular_velocity_rad_s=velocity,
                )
