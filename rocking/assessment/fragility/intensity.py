"""Intensity measures: one number for a record, or for a record and a structure. The registry knows them all."""

from collections.abc import Callable
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from rocking.errors import ConfigurationError, RockingError
from rocking.pulses import extract_pulses
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.measures import record_measures, response_spectrum
from rocking.structures import Mechanism

SPECTRAL_PERIOD = 1.0
"""Of the spectral acceleration, s."""


@dataclass(frozen=True)
class IntensityMeasure:
    """name: as settings and tables say it. unit: "" for a ratio. meaning: for axes. of_record: what it takes of a
    record; it must grow in proportion to the accelerations. per: what it is divided by, of a mechanism."""

    name: str
    unit: str
    meaning: str
    of_record: Callable[[Accelerogram], float]
    per: Callable[[Mechanism], float] = lambda mechanism: 1.0

    def of(self, record: Accelerogram, mechanism: Mechanism) -> float:
        """Return the measure of `record`. Raises ConfigurationError where the record has none."""
        try:
            found = self.remembered(record)
        except RockingError as error:
            raise ConfigurationError(
                f"{record.source.path or record.station or 'a record'} has no {self.name}: {error}"
            ) from None
        if not (np.isfinite(found) and found > 0):
            raise ConfigurationError(
                f"{record.source.path or record.station or 'a record'} has a {self.name} of {found!r}, but must have "
                "one greater than 0; leave the record out."
            )
        return found / self.per(mechanism)

    def remembered(self, record: Accelerogram) -> float:
        """Of the record alone, measured once as long as it lives: many structures ask for it."""
        known = _REMEMBERED.setdefault(record, {})
        if self.name not in known:
            known[self.name] = self.of_record(record)
        return known[self.name]


_REMEMBERED: WeakKeyDictionary[Accelerogram, dict[str, float]] = WeakKeyDictionary()


def _velocity(record: Accelerogram) -> float:
    return record_measures(record).peak_velocity


def _spectral(record: Accelerogram) -> float:
    found = response_spectrum(record, np.array([SPECTRAL_PERIOD]))
    return float(found.pseudo_acceleration[0]) / GRAVITY


def _rest_velocity(mechanism: Mechanism) -> float:
    """gλ/p, m/s, with p of the block that is exact at rest."""
    block = mechanism.equivalent_block("rest")
    return GRAVITY * block.uplift_multiplier / block.frequency_parameter


INTENSITY_MEASURES: dict[str, IntensityMeasure] = {
    each.name: each
    for each in (
        IntensityMeasure(
            "pga", "g", "peak ground acceleration", lambda record: record.peak_acceleration / GRAVITY
        ),
        IntensityMeasure("pgv", "m/s", "peak ground velocity", _velocity),
        IntensityMeasure("p_pgv", "", "p·PGV/(gλ)", _velocity, _rest_velocity),
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
"""By name."""


def intensity_measure(name: str) -> IntensityMeasure:
    """Return the measure of that name. Raises ConfigurationError naming those there are."""
    if name not in INTENSITY_MEASURES:
        raise ConfigurationError(
            f"intensity_measure is {name!r}, but must be one of {', '.join(INTENSITY_MEASURES)}."
        )
    return INTENSITY_MEASURES[name]
