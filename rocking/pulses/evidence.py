"""How far a dominant pulse may be trusted: the light of one record × structure, from thresholds that are data."""

from dataclasses import dataclass
from enum import StrEnum

from rocking.checks import finite
from rocking.errors import PulseError


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


THRESHOLDS = Thresholds(
    green_explained_energy=0.35,
    amber_explained_energy=0.20,
    amplitude_ratio=1.3,
    evidence=(
        "87 horizontal components of recorded earthquakes and synthetic signals: prediction by the pulse within a "
        "factor 2 of the rotation under the record in 85–96 % (green), 74–83 % (amber), 20 % (red)."
    ),
)


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
