"""Identity: which record, component and settings a row belongs to."""

from dataclasses import dataclass

from rocking.records import Accelerogram


@dataclass(frozen=True)
class Identity:
    """Which record, component and settings a row belongs to."""

    record: str
    accelerogram: Accelerogram
    settings_sha256: str

    @property
    def head(self) -> dict[str, object]:
        """The first columns of every row."""
        return {"record": self.record, "component": self.accelerogram.component}

    @property
    def provenance(self) -> dict[str, object]:
        """The last columns of every row."""
        return {
            "scale_factor": self.accelerogram.scale_factor,
            "record_sha256": self.accelerogram.source.sha256,
            "settings_sha256": self.settings_sha256,
        }
