"""Place: where a structure stands, the ground or a support with its periods, and how a list describes a support.

The period of a support is ignorance, not chance: a range of periods is an axis of every result, and none of its values
is mixed with another.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

import numpy as np

from rocking.errors import ConfigurationError, RecordError
from rocking.floors.kinds import FloorKind
from rocking.floors.spectrum import FLOOR_DAMPING, floor_spectrum, has_code_spectrum, spectrum_of
from rocking.floors.support import Mode, Support
from rocking.quantities import finite
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

TYPE_NAME = "support"
"""The `type` of an entry of a structure list that is a support."""
PERIODS = 9
"""Periods into which a range is divided, at equal steps of the logarithm; a record need not follow all."""
ELASTIC_DAMPING = 0.05
"""Damping ratio of a building that stays elastic, where none is given."""
YIELDING_DAMPING = 0.10
"""Damping ratio of a masonry building at the ultimate limit state, where none is given.

The lower end, which is the safe one, of the 10 to 20 % of the Circolare 7/2019, C7.2.3.
"""
YIELDING_STRETCH = (1.5, 2.0)
"""The factors on the first period of a masonry building at the ultimate limit state (the same place)."""
HEAVY = 0.01
"""Mass ratio above which what the structure gives back to its support changes rotations by more than a per cent."""

_MODE_KEYS = {"period_s", "damping_ratio", "participation"}
_STOREY_KEYS = {"storeys", "height_m", "building_height_m"}
_KEYS = {"name", "type", "modes", "yielding_masonry", "mass_ratio", *_MODE_KEYS, *_STOREY_KEYS}


@dataclass(frozen=True)
class FloorMeasures:
    """Measures of the motion that a support makes of one component of the ground.

    peak_acceleration: on the support, m/s². amplification: that over the peak of the ground; nan of still ground.
    spectral_acceleration: of the motion there at its first period and FLOOR_DAMPING, m/s². code_spectral_acceleration:
    the same by the code's formula. Both are nan on the ground itself, the last where the formula has no value, too.
    """

    peak_acceleration: float
    amplification: float
    spectral_acceleration: float
    code_spectral_acceleration: float


@dataclass(frozen=True)
class Place:
    """The ground, or a support of a structure list.

    supports: the support, once for each period that it may have, ascending; none on the ground. mass_ratio: of a
    structure to the support; None where it is not given.
    """

    name: str
    supports: tuple[Support, ...] = ()
    mass_ratio: float | None = None

    @property
    def axis(self) -> tuple[Support | None, ...]:
        """The supports along which a structure may be followed; first None, the ground, as what to compare with."""
        return (None, *self.supports)

    def period_of(self, support: Support | None) -> float | None:
        """Return the place on the axis of a result: the first period, s; 0 of the ground below a support.

        None where the place is the ground itself, which has no such axis.
        """
        if not self.supports:
            return None
        return support.first_period if support else 0.0

    def support_of(self, period: float | None) -> Support | None:
        """Return the support of a place on that axis; None on the ground."""
        return next((support for support in self.supports if period and support.first_period == period), None)

    def measures(self, period: float, *, ground: Accelerogram, there: Accelerogram) -> FloorMeasures:
        """Return what the support of this first period makes of the ground, as the motion `there`; 0: the ground."""
        spectral_acceleration = math.nan
        by_code = math.nan
        support = self.support_of(period)
        if support is not None:
            spectral_acceleration = spectrum_of(there)(period, FLOOR_DAMPING)
            if has_code_spectrum(support):
                places = np.array([period])
                by_code = float(floor_spectrum(support, places, FLOOR_DAMPING, spectrum_of(ground))[0])
        peak = there.peak_acceleration
        return FloorMeasures(
            peak_acceleration=peak,
            amplification=peak / ground.peak_acceleration if ground.peak_acceleration else math.nan,
            spectral_acceleration=spectral_acceleration,
            code_spectral_acceleration=by_code,
        )

    def warning(self, structure: str) -> RockingWarning | None:
        """Return that a structure is too heavy for the support to be followed alone; None where it is not."""
        if self.mass_ratio is None or self.mass_ratio <= HEAVY:
            return None
        return RockingWarning.of(
            FloorKind.HEAVY_ON_SUPPORT, structure, ratio=self.mass_ratio, support=self.name, limit=HEAVY
        )


GROUND = Place("ground")
"""The place of a structure unless the list says otherwise."""


def swinging(period: float) -> Support:
    """Return masonry that swings as one body of this period [s], as a support of its parts; 0: with the ground.

    >>> swinging(0.2).modes[0].damping_ratio
    0.1
    """
    return Support((Mode(period=period, damping_ratio=YIELDING_DAMPING, participation=1.0),))


def place_from_config(mapping: Mapping[str, Any]) -> Place:
    """Return the support that an entry of a structure list describes. Raises ConfigurationError for what it cannot be.

    It has one mode, by period_s, damping_ratio and participation (Γψ where the structure stands), or several in
    `modes`. A period is a number or a range [low, high], s. In place of the participation, storeys, height_m and
    building_height_m give the code's own, 3n/(2n + 1) · z/H (C7.2.10). yielding_masonry: the period is that of the
    elastic building, and 1.5 to 2 times as long when it yields.

    >>> roof = {"name": "roof", "period_s": 0.3, "storeys": 3, "height_m": 9.0, "building_height_m": 9.0}
    >>> round(place_from_config(roof).supports[0].modes[0].participation, 3)
    1.286
    """
    _check_keys(mapping)
    yields = mapping.get("yielding_masonry") or False
    if not isinstance(yields, bool):
        raise ConfigurationError(f"yielding_masonry is {yields!r}, but must be true or false.")
    modes = _modes(mapping)
    ranges = [_period_range(mode, yields) for mode in modes]
    count = PERIODS if any(low < high for low, high in ranges) else 1
    periods = [np.geomspace(low, high, count) if low < high else np.full(count, low) for low, high in ranges]
    damping = YIELDING_DAMPING if yields else ELASTIC_DAMPING
    try:
        supports = tuple(
            Support(
                tuple(
                    Mode(
                        period=float(f"{of_mode[place]:.6g}"),
                        damping_ratio=mode.get("damping_ratio", damping),
                        participation=mode["participation"],
                    )
                    for of_mode, mode in zip(periods, modes, strict=True)
                )
            )
            for place in range(count)
        )
    except RecordError as error:
        raise ConfigurationError(str(error)) from None
    return Place(str(mapping["name"]), supports, _mass_ratio(mapping))


def _check_keys(mapping: Mapping[str, Any]) -> None:
    """Refuse a key that a support has not."""
    for key in mapping:
        if key not in _KEYS:
            near = get_close_matches(str(key), sorted(_KEYS), n=1, cutoff=0.5)
            hint = f"did you mean {near[0]}?" if near else f"use {', '.join(sorted(_KEYS - {'type'}))}."
            raise ConfigurationError(f"{key} is not a key of a support; {hint}")


def _mass_ratio(mapping: Mapping[str, Any]) -> float | None:
    given = mapping.get("mass_ratio")
    if given is None:
        return None
    ratio = finite(ConfigurationError, "mass_ratio", given)
    if ratio < 0:
        raise ConfigurationError(f"mass_ratio is {given!r}, but must be 0 or more.")
    return ratio


def _modes(mapping: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The modes with period_s and participation each, as the entry gives them or the code does."""
    listed = mapping.get("modes")
    if listed is None:
        mode = {key: mapping[key] for key in _MODE_KEYS if mapping.get(key) is not None}
        return [_complete(mode, _by_storeys(mapping))]
    surplus = sorted((_MODE_KEYS | _STOREY_KEYS) & set(mapping))
    if surplus:
        raise ConfigurationError(
            f"a support is given {', '.join(surplus)} together with modes; give one of the two."
        )
    if not isinstance(listed, list) or not listed:
        raise ConfigurationError(f"modes is {listed!r}, but must be a list of at least one mode.")
    for mode in listed:
        if not isinstance(mode, Mapping) or not set(mode) <= _MODE_KEYS:
            allowed = ", ".join(sorted(_MODE_KEYS))
            raise ConfigurationError(f"a mode is {mode!r}, but must be a mapping of {allowed}.")
    return [_complete(dict(mode), None) for mode in listed]


def _complete(mode: dict[str, Any], participation: float | None) -> dict[str, Any]:
    if "period_s" not in mode:
        raise ConfigurationError("a support needs period_s, a number of seconds or a range; give it.")
    if participation is not None and "participation" in mode:
        raise ConfigurationError(
            "a support is given participation together with storeys and heights, which give it; give one of the two."
        )
    if participation is None and "participation" not in mode:
        raise ConfigurationError(
            "a support needs participation, Γψ of the mode where the structure stands; give it, or for one mode "
            "storeys, height_m and building_height_m."
        )
    return {"participation": participation, **mode}


def _by_storeys(mapping: Mapping[str, Any]) -> float | None:
    """Γψ of the first mode of a building by C7.2.10; None where the entry does not ask for it."""
    given = _STOREY_KEYS & {key for key, value in mapping.items() if value is not None}
    if not given:
        return None
    if missing := sorted(_STOREY_KEYS - given):
        them = "it" if len(missing) == 1 else "them"
        raise ConfigurationError(
            f"a support with {', '.join(sorted(given))} needs {' and '.join(missing)}; give {them}."
        )
    storeys = finite(ConfigurationError, "storeys", mapping["storeys"])
    if storeys < 1 or storeys != int(storeys):
        raise ConfigurationError(f"storeys is {mapping['storeys']!r}, but must be a whole number from 1 on.")
    top = finite(ConfigurationError, "building_height_m", mapping["building_height_m"], "m")
    height = finite(ConfigurationError, "height_m", mapping["height_m"], "m")
    if top <= 0:
        raise ConfigurationError(f"building_height_m is {top:g} m, but must be greater than 0.")
    if not 0 <= height <= top:
        raise ConfigurationError(
            f"height_m is {height:g} m, but must lie between 0 and building_height_m, {top:g} m."
        )
    return 3 * storeys / (2 * storeys + 1) * height / top


def _period_range(mode: Mapping[str, Any], yields: bool) -> tuple[float, float]:
    given = mode["period_s"]
    both = given if isinstance(given, list) else [given, given]
    if len(both) != 2:
        raise ConfigurationError(f"period_s is {given!r}, but must be a number or a range of two.")
    low, high = (finite(ConfigurationError, "period_s", period, "s") for period in both)
    if not 0 < low <= high or (isinstance(given, list) and low == high) or math.isinf(high):
        raise ConfigurationError(
            f"period_s is {given!r} s, but must be above 0, and the first of a range below the second."
        )
    return (YIELDING_STRETCH[0] * low, YIELDING_STRETCH[1] * high) if yields else (low, high)


def place_schema(name: Mapping[str, object]) -> dict[str, object]:
    """Return the JSON schema of an entry. name: that of its name."""
    of_mode = _mode_schema()
    several_modes = {
        "type": "array",
        "minItems": 1,
        "items": {
            "type": "object",
            "additionalProperties": False,
            "required": ["period_s", "participation"],
            "properties": dict(of_mode),
        },
        "description": "Several modes, as of a tower, in place of one",
    }
    mass_ratio = {
        "type": "number",
        "minimum": 0,
        "description": f"Mass of a structure over that of the mode; a warning is given above {HEAVY:g}",
    }
    return {
        "description": "Support: a floor, a roof, a façade or a tower on which structures stand",
        "type": "object",
        "additionalProperties": False,
        "required": ["name", "type"],
        "properties": {
            "name": {**name, "description": "Name of the support, which stands_on of structures says"},
            "type": {"const": TYPE_NAME},
            **of_mode,
            **_building_schema(),
            "mass_ratio": mass_ratio,
            "modes": several_modes,
        },
        "examples": [_EXAMPLE],
    }


def _mode_schema() -> dict[str, object]:
    """The keys of a mode."""
    period = {
        "oneOf": [_POSITIVE, {"type": "array", "items": _POSITIVE, "minItems": 2, "maxItems": 2}],
        "description": f"Period of the support, s, or a range of it, of which 3 to {PERIODS} are followed",
    }
    damping = {
        "type": "number",
        "minimum": 0,
        "exclusiveMaximum": 1,
        "description": f"Share of the critical damping; {ELASTIC_DAMPING:g} where none is given, "
        f"{YIELDING_DAMPING:g} with yielding_masonry",
    }
    participation = {"type": "number", "description": "Γψ of the mode where the structures stand"}
    return {"period_s": period, "damping_ratio": damping, "participation": participation}


def _building_schema() -> dict[str, object]:
    """The keys of the building from which the participation follows."""
    return {
        "storeys": {
            "type": "integer",
            "minimum": 1,
            "description": "Storeys n of the building; Γ = 3n/(2n+1)",
        },
        "height_m": {"type": "number", "minimum": 0, "description": "Height z of the support, m; ψ = z/H"},
        "building_height_m": {**_POSITIVE, "description": "Height H of the building, m"},
        "yielding_masonry": {
            "type": "boolean",
            "description": "Whether the building yields: its period is then 1.5 to 2 times as long",
        },
    }


_POSITIVE: dict[str, object] = {"type": "number", "exclusiveMinimum": 0}
_EXAMPLE = {
    "name": "my roof",
    "type": TYPE_NAME,
    "period_s": [0.15, 0.6],
    "storeys": 3,
    "height_m": 9.0,
    "building_height_m": 9.0,
}
