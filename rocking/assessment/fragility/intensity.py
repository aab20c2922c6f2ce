"""Intensity measures: one number for a record, or for a record and a structure. The registry knows them all."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rocking.errors import ConfigurationError, RockingError
from rocking.pulses import extract_pulses
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.measures import record_measures
from rocking.records.response_spectrum import response_spectrum
from rocking.structures import Mechanism

SPECTRAL_PERIOD = 1.0
"""Of the spectral acceleration, s."""


@dataclass(frozen=True)
class IntensityMeasure:
    """name: as settings and tables say it. unit: "" for a ratio. meaning: for axes. value: of a record; it must grow
    in proportion to the accelerations."""

    name: str
    unit: str
    meaning: str
    value: Callable[[Accelerogram, Mechanism], float]

    def of(self, record: Accelerogram, mechanism: Mechanism) -> float:
        """Return the measure of `record`. Raises ConfigurationError where the record has none."""
        try:
            found = self.value(record, mechanism)
        except RockingError as error:
            raise ConfigurationError(
                f"{record.source.path or record.station or 'a record'} has no {self.name}: {error}"
            ) from None
        if not (np.isfinite(found) and found > 0):
            raise ConfigurationError(
                f"{record.source.path or record.station or 'a record'} has a {self.name} of {found!r}, but must have "
                "one greater than 0; leave the record out."
            )
        return found


def _velocity(record: Accelerogram, mechanism: Mechanism) -> float:
    return record_measures(record).peak_velocity


def _velocity_ratio(record: Accelerogram, mechanism: Mechanism) -> float:
    """p·PGV/(gλ), with p of the block that is exact at rest."""
    block = mechanism.equivalent_block("rest")
    return block.frequency_parameter * _velocity(record, mechanism) / (GRAVITY * block.uplift_multiplier)


def _pulse_amplitude(record: Accelerogram, mechanism: Mechanism) -> float:
    return abs(extract_pulses(record).dominant.amplitude) / (GRAVITY * mechanism.uplift_multiplier)


def _spectral(record: Accelerogram, mechanism: Mechanism) -> float:
    found = response_spectrum(record, np.array([SPECTRAL_PERIOD]))
    return float(found.pseudo_acceleration[0]) / GRAVITY


INTENSITY_MEASURES: dict[str, IntensityMeasure] = {
    each.name: each
    for each in (
        IntensityMeasure(
            "pga", "g", "peak ground acceleration", lambda record, _: record.peak_acceleration / GRAVITY
        ),
        IntensityMeasure("pgv", "m/s", "peak ground velocity", _velocity),
        IntensityMeasure("p_pgv", "", "p·PGV/(gλ)", _velocity_ratio),
        IntensityMeasure("pulse", "", "amplitude of the dominant sine pulse over gλ", _pulse_amplitude),
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
