"""Intensity measures: one number for a record, or for a record and a structure. The registry names them all."""

from collections.abc import Callable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from rocking.assessment.fidelity import peak_velocity, per_velocity
from rocking.errors import ConfigurationError, RockingError
from rocking.pulses import extract_pulses
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.measures import response_spectrum
from rocking.structures import Mechanism

SPECTRAL_PERIOD = 1.0
"""Period of the spectral acceleration, s."""


@dataclass(frozen=True)
class IntensityMeasure:
    """A measure of how strong a motion is for a structure: a figure of the record over one of the mechanism.

    name: as settings and tables have it. unit: "" for a ratio. meaning: for axes. of_record: the figure of the record,
    which grows in proportion to the accelerations. per: the figure of the mechanism.
    """

    name: str
    unit: str
    meaning: str
    of_record: Callable[[Accelerogram], float]
    per: Callable[[Mechanism], float] = lambda mechanism: 1.0

    def of(self, record: Accelerogram, mechanism: Mechanism) -> float:
        """Return the measure of `record`. Raises ConfigurationError where the record has none."""
        name = record.source.path or record.station or "a record"
        try:
            value = self.remembered(record)
        except RockingError as error:
            raise ConfigurationError(f"{name} has no {self.name}: {error}") from None
        if not (np.isfinite(value) and value > 0):
            raise ConfigurationError(
                f"{name} has a {self.name} of {value!r}, but must have one greater than 0; leave the record out."
            )
        return value / self.per(mechanism)

    def remembered(self, record: Accelerogram) -> float:
        """Return the figure of the record, measured once as long as the record lives: many structures ask for it."""
        of_record = _REMEMBERED.setdefault(record, {})
        if self.name not in of_record:
            of_record[self.name] = self.of_record(record)
        return of_record[self.name]


_REMEMBERED: WeakKeyDictionary[Accelerogram, dict[str, float]] = WeakKeyDictionary()


def _spectral(record: Accelerogram) -> float:
    spectrum = response_spectrum(record, np.array([SPECTRAL_PERIOD]))
    return float(spectrum.pseudo_acceleration[0]) / GRAVITY


INTENSITY_MEASURES: dict[str, IntensityMeasure] = {
    each.name: each
    for each in (
        IntensityMeasure("pgv", "m/s", "peak ground velocity", peak_velocity),
        IntensityMeasure(
            "pga", "g", "peak ground acceleration", lambda record: record.peak_acceleration / GRAVITY
        ),
        IntensityMeasure(
            "p_pgv", "", "p·PGV/(gλ)", peak_velocity, lambda m: 1 / per_velocity(m.equivalent_block("rest"))
        ),
        IntensityMeasure(
            "pulse",
            "",
            "amplitude of the dominant sine pulse over gλ",
            lambda record: abs(extract_pulses(record).dominant.amplitude),
            lambda mechanism: GRAVITY * mechanism.uplift_multiplier,
        ),
        IntensityMeasure("sa1", "g", "spectral acceleration at 1 s, 5 % damping", _spectral),
    )
}
"""The intensity measures by name; the first is the default."""
MEASURES_IN_WORDS = ", ".join(f"{each.name} [{each.unit or '-'}]" for each in INTENSITY_MEASURES.values())
"""Names with units, for the meanings of settings and columns."""


def intensity_measure(name: str) -> IntensityMeasure:
    """Return the measure of that name. Raises ConfigurationError naming those there are."""
    if name not in INTENSITY_MEASURES:
        raise ConfigurationError(
            f"intensity_measure is {name!r}, but must be one of {', '.join(INTENSITY_MEASURES)}."
        )
    return INTENSITY_MEASURES[name]
