"""How far a dominant pulse may be trusted: the light of one record × structure, from thresholds that are data."""

from enum import StrEnum
from pathlib import Path

from rocking.errors import PulseError
from rocking.quantities import finite
from rocking.tables import Row, column, read_rows, row


class Light(StrEnum):
    """Whether one pulse can stand for one record on one structure. Red is the unsafe side: it under-predicts."""

    GREEN = "green"
    AMBER = "amber"
    RED = "red"

    @property
    def sentence(self) -> str:
        """One sentence for the reader."""
        return _SENTENCES[self]


_SENTENCES = {
    Light.GREEN: "One pulse dominates the record and lifts the structure, so its prediction can stand.",
    Light.AMBER: "One pulse lifts the structure but explains little of the record; read the prediction with its band.",
    Light.RED: "One pulse does not stand for this record on this structure; its prediction is too low, often by far.",
}


@row("thresholds", "One row: what a record and a structure must reach for each light")
class Thresholds(Row):
    """Least share of energy explained and least amplitude ratio of each light, and where they come from."""

    green_explained_energy: float = column("Least share of energy explained of green")
    amber_explained_energy: float = column("Least share of energy explained of amber")
    amplitude_ratio: float = column("Least pulse amplitude over g times uplift multiplier of both")
    evidence: str = column("What stands behind them")


def read_thresholds(path: Path) -> Thresholds:
    """Return the one row of a table of thresholds. Raises RockingError for any defect."""
    rows = list(read_rows(Thresholds, path))
    if len(rows) != 1:
        raise PulseError(f"{path}: the thresholds must be one row, but are {len(rows)}.")
    for name in ("green_explained_energy", "amber_explained_energy", "amplitude_ratio"):
        finite(PulseError, f"{path}, {name}", getattr(rows[0], name))
    return rows[0]


THRESHOLDS = read_thresholds(Path(__file__).with_name("thresholds.csv"))
"""Made by `snakemake calibrate` from the real records of records/near_fault.csv."""


def light(explained_energy: float, amplitude_ratio: float, thresholds: Thresholds = THRESHOLDS) -> Light:
    """Return the light of a record × structure.

    explained_energy: EVa of the dominant pulse. amplitude_ratio: η_a = |a_g|/(g λ), of pulse and structure.
    Raises PulseError when a number is not finite.
    """
    energy = finite(PulseError, "explained_energy", explained_energy)
    ratio = abs(finite(PulseError, "amplitude_ratio", amplitude_ratio))
    if ratio < thresholds.amplitude_ratio or energy < thresholds.amber_explained_energy:
        return Light.RED
    return Light.GREEN if energy >= thresholds.green_explained_energy else Light.AMBER
