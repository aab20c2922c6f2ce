"""How far a dominant pulse may be trusted: the light of one record × structure, from thresholds that are data."""

import csv
from collections.abc import Iterable
from dataclasses import dataclass, fields
from enum import StrEnum
from pathlib import Path

from rocking.errors import PulseError
from rocking.quantities import finite


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


@dataclass(frozen=True)
class Thresholds:
    """Least share of energy explained and least amplitude ratio of each light, and where they come from."""

    green_explained_energy: float
    amber_explained_energy: float
    amplitude_ratio: float
    evidence: str


def read_thresholds(lines: Iterable[str]) -> Thresholds:
    """Return the one row of a CSV text with the columns of Thresholds. Raises PulseError for any defect."""
    rows = list(csv.DictReader(lines))
    names = [field.name for field in fields(Thresholds)]
    if len(rows) != 1 or list(rows[0]) != names:
        raise PulseError(f"The thresholds must be one row with the columns {', '.join(names)}.")
    numbers = [finite(PulseError, name, float(rows[0][name])) for name in names[:3]]
    return Thresholds(numbers[0], numbers[1], numbers[2], rows[0]["evidence"])


THRESHOLDS = read_thresholds(
    Path(__file__).with_name("thresholds.csv").read_text(encoding="utf-8").splitlines()
)
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
