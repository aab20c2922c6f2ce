"""What several rows share: whose row it is, and where it came from."""

from dataclasses import dataclass
from typing import Any

from rocking.assessment.rows import meanings
from rocking.records import Accelerogram
from rocking.tables import Row, column, row


@row()
class ComponentRow(Row):
    """A row about one component of one record."""

    record: str = column(meanings.RECORD)
    component: str = column(meanings.COMPONENT)
    scale_factor: float = column(meanings.SCALE_FACTOR, last=True)
    record_sha256: str = column(meanings.RECORD_SHA256, last=True)
    settings_sha256: str = column(
        "SHA-256 of the settings, the structure list and the package that made this row", last=True
    )


@row()
class CaseRow(ComponentRow):
    """A row about one structure under one component of one record."""

    structure: str = column(meanings.STRUCTURE)

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
