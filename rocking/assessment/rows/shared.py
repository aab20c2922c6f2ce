"""What several rows share: whose row it is, where it came from, and the meanings that more than one table names."""

from dataclasses import dataclass
from typing import Any

from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.tables import Row, column, row

ROTATION_RATIO = "Largest rotation over critical rotation; INF if it overturns, 0 without uplift"
ROTATION = "Largest rotation; INF if it overturns"
PROBABILITY = (
    "Of overturning, from closed form, PGV, PGA and structure: calibrated on real records (tiers.csv)"
)
METHOD = "How the number was computed"
OUTCOME = "no uplift, rocks, overturns or failed"
REGIME = "Regime of the closed form in which the prediction was made"
IMPACTS = "Number of impacts"
SENSITIVITY = "d ln(largest rotation) / d ln(ground acceleration)"
RECORD = "Identifier of the record in the catalogue"
COMPONENT = "Component of the ground motion, as the file names it"
STRUCTURE = "Name of the structure in the structure list"
SCALE_FACTOR = "What the accelerations of the file were multiplied by, beyond their unit"
RECORD_SHA256 = "SHA-256 of the file the record was read from"
FREQUENCY_PARAMETER = "p of the equivalent block"
RESTITUTION = "Ratio of angular velocities after and before an impact"


@row()
class ComponentRow(Row):
    """A row about one component of one record."""

    record: str = column(RECORD)
    component: str = column(COMPONENT)
    scale_factor: float = column(SCALE_FACTOR, last=True)
    record_sha256: str = column(RECORD_SHA256, last=True)
    settings_sha256: str = column(
        "SHA-256 of the settings, the structure list and the package that made this row", last=True
    )


@row()
class CaseRow(ComponentRow):
    """A row about one structure under one component of one record."""

    structure: str = column(STRUCTURE)

    @property
    def case(self) -> tuple[str, str]:
        """Component and structure."""
        return self.component, self.structure


@dataclass(frozen=True)
class Identity:
    """Which record, component and settings a row belongs to."""

    record: str
    accelerogram: Accelerogram
    settings_sha256: str

    @property
    def columns(self) -> dict[str, Any]:
        """What every ComponentRow holds."""
        return {
            "record": self.record,
            "component": self.accelerogram.component,
            "scale_factor": self.accelerogram.scale_factor,
            "record_sha256": self.accelerogram.source.sha256,
            "settings_sha256": self.settings_sha256,
        }


def rotation(mechanism: Mechanism, rotation_ratio: float, side: int) -> float:
    """Return the rotation in rad that `rotation_ratio` means on `side` (+1 or −1) of `mechanism`."""
    return rotation_ratio * mechanism.sides[0 if side >= 0 else -1].critical_rotation
