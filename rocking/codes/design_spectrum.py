"""Design spectrum: the motion that a code asks a structure to bear, and what elastic parts above the ground feel of it.

NTC 2018, 3.2.3.2, by its parameters, or any spectrum by its points. S_De(T) = S_e(T) (T/2π)².
"""

import csv
import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from io import StringIO
from itertools import pairwise
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import ConfigurationError
from rocking.quantities import GRAVITY, finite, positive, within
from rocking.signal.measures import damping_factor
from rocking.tables import read_whole

SOILS = {
    "A": (1.00, 0.00, 1.00, 1.00, 1.00, 0.00),
    "B": (1.40, 0.40, 1.00, 1.20, 1.10, -0.20),
    "C": (1.70, 0.60, 1.00, 1.50, 1.05, -0.33),
    "D": (2.40, 1.50, 0.90, 1.80, 1.25, -0.50),
    "E": (2.00, 1.10, 1.00, 1.60, 1.15, -0.40),
}
"""The coefficients by soil (NTC 2018, Tab. 3.2.IV).

S_S = first − second · F0 a_g/g within the next two; C_C = fifth · T_C*^sixth.
"""

TOPOGRAPHIES = (1.0, 1.4)
"""Least and largest topographic factor S_T (NTC 2018, Tab. 3.2.V)."""

LONGEST_FIRST_PERIOD = 0.05
"""s; what a spectrum by its points must reach down to, so that its first ordinate may stand for the peak."""


LARGEST_LEVEL = 3 * GRAVITY
"""m/s²; a design level above it is a number in another unit."""

_LARGEST_FILE = 2**20
_PERIODS_TRIED = 401
"""Periods at which the largest displacement of a spectrum by its points is searched for, in addition to the points."""
_ACCELERATIONS = {"acceleration_m_s2": 1.0, "acceleration_g": GRAVITY}


@dataclass(frozen=True, eq=False)
class DesignSpectrum(ABC):
    """An elastic acceleration spectrum at a level; make one by `ntc` or `read`.

    Parameters
    ----------
    damping : float
        Share of the critical damping, of the spectrum as it is given.
    """

    damping: float

    @staticmethod
    def ntc(
        ag: float | None = None,
        f0: float | None = None,
        tc_star: float | None = None,
        soil: str = "A",
        topography: float = 1.0,
        damping: float = 0.05,
    ) -> "NtcSpectrum":
        """Return the horizontal elastic spectrum of NTC 2018, 3.2.3.2.

        ag: a_g on rock, m/s². f0: F0. tc_star: T_C*, s. soil: A to E. topography: S_T. damping: a share.
        The code tabulates the first three for each site: none has a default. Raises ConfigurationError for one that is
        missing or out of range.

        >>> spectrum = rocking.DesignSpectrum.ntc(ag=1.5, f0=2.5, tc_star=0.3)
        >>> float(spectrum.acceleration(0.2))
        3.75
        """
        if ag is None or f0 is None or tc_star is None:
            values = {"ag": ag, "f0": f0, "tc_star": tc_star}
            missing = [name for name, value in values.items() if value is None]
            raise ConfigurationError(
                f"{', '.join(missing)} of the design spectrum is missing; give it as the code has it for the site.",
                **{", ".join(missing): None},
            )
        _check_level("ag", ag)
        return NtcSpectrum(damping=damping, ag=ag, f0=f0, tc_star=tc_star, soil=soil, topography=topography)

    @staticmethod
    def read(path: str | Path, damping: float = 0.05) -> "PointSpectrum":
        """Return the spectrum in a CSV file with the columns period_s and acceleration_m_s2 or acceleration_g.

        damping: of the spectrum in the file, a share. Raises ConfigurationError naming the file and what is wrong.
        """
        periods, accelerations = _read_points(Path(path))
        try:
            _check_level("the first acceleration", accelerations[0] if accelerations else 1.0)
            return PointSpectrum(damping, tuple(periods), tuple(accelerations))
        except ConfigurationError as error:
            raise ConfigurationError(f"{path}: {error}") from None

    @property
    @abstractmethod
    def level(self) -> float:
        """The peak acceleration that names the level, m/s²: a_g on rock, or of points their first ordinate."""

    @abstractmethod
    def at(self, level: float) -> Self:
        """Return the spectrum of the same site and shape at another `level` [m/s²]."""

    @abstractmethod
    def ordinates(self, period: ArrayLike, level: ArrayLike, damping: float) -> np.ndarray:
        """Return S_e [m/s²] at `period` [s] were the level `level` [m/s²]; the two broadcast."""

    @property
    @abstractmethod
    def longest_period(self) -> float:
        """The longest period for which it says something, s; inf where a formula goes on."""

    @property
    @abstractmethod
    def words(self) -> str:
        """The name of the spectrum, for a reader."""

    def acceleration(self, period: ArrayLike, damping: float | None = None) -> np.ndarray:
        """Return S_e(T, ξ), m/s², at `period` ≥ 0 [s], of any shape; damping: a share, None for its own.

        Raises ConfigurationError for a period that is negative or beyond the points.
        """
        return self.ordinates(self._checked(period), self.level, self._damping(damping))

    def displacement(self, period: ArrayLike, damping: float | None = None) -> np.ndarray:
        """Return S_De(T, ξ) = S_e(T, ξ) (T/2π)², m, as `acceleration`."""
        periods = self._checked(period)
        displacement: np.ndarray = self.acceleration(periods, damping) * (periods / (2 * math.pi)) ** 2
        return displacement

    @abstractmethod
    def largest_displacement(
        self, shortest: float, longest: ArrayLike, level: ArrayLike, damping: float
    ) -> np.ndarray:
        """Return the largest S_De [m] at periods from `shortest` to `longest` [s], were the level `level` [m/s²].

        The last two broadcast. Raises ConfigurationError for a period beyond the points.
        """

    def _damping(self, damping: float | None) -> float:
        if damping is None:
            return self.damping
        return within(ConfigurationError, "damping", damping, low=0, high=0.5)

    def _checked(self, period: ArrayLike) -> np.ndarray:
        periods = np.asarray(period, dtype=float)
        if not (np.isfinite(periods) & (periods >= 0)).all():
            raise ConfigurationError(
                "a period is negative or no number, but must be 0 s or more.", period=periods
            )
        if periods.size and periods.max() > self.longest_period:
            raise ConfigurationError(
                f"a period of {periods.max():.4g} s is asked for, but the spectrum ends at "
                f"{self.longest_period:.4g} s; give one that goes on to longer periods.",
                period=float(periods.max()),
            )
        return periods


@dataclass(frozen=True, eq=False, kw_only=True)
class NtcSpectrum(DesignSpectrum):
    """The horizontal elastic spectrum of NTC 2018, 3.2.3.2. ag: m/s² on rock; tc_star: s."""

    ag: float
    f0: float
    tc_star: float
    soil: str
    topography: float

    def __post_init__(self) -> None:
        numbers = {
            "ag": positive(ConfigurationError, "ag", self.ag, "m/s²"),
            "f0": positive(ConfigurationError, "f0", self.f0),
            "tc_star": positive(ConfigurationError, "tc_star", self.tc_star, "s"),
            "topography": within(
                ConfigurationError, "topography", self.topography, low=TOPOGRAPHIES[0], high=TOPOGRAPHIES[1]
            ),
            "damping": within(ConfigurationError, "damping", self.damping, low=0, high=0.5),
        }
        for name, number in numbers.items():
            object.__setattr__(self, name, number)
        if self.soil not in SOILS:
            raise ConfigurationError(
                f"soil is {self.soil!r}, but must be one of {', '.join(SOILS)}.", soil=self.soil
            )

    @property
    def level(self) -> float:
        """a_g on rock, m/s²."""
        return self.ag

    @property
    def longest_period(self) -> float:
        """inf: beyond T_D its displacement is constant."""
        return math.inf

    @property
    def corner_periods(self) -> tuple[float, float, float]:
        """T_B, T_C and T_D, s."""
        constant = self._constant_until
        return constant / 3, constant, float(self._long_from(self.ag))

    @property
    def soil_factor(self) -> float:
        """S = S_S S_T."""
        return float(self._amplification(self.ag))

    @property
    def words(self) -> str:
        """Its parameters."""
        return (
            f"NTC 2018, 3.2.3.2: a_g = {self.ag / GRAVITY:.4g} g, F0 = {self.f0:.4g}, T_C* = {self.tc_star:.4g} s, "
            f"soil {self.soil}, S_T = {self.topography:.4g}, damping {self.damping:.3g}"
        )

    def at(self, level: float) -> Self:
        """Return it with another a_g [m/s²] and the same F0 and T_C*; S_S and T_D follow a_g."""
        return replace(self, ag=level)

    @property
    def _constant_until(self) -> float:
        *_, factor, exponent = SOILS[self.soil]
        return float(factor * self.tc_star**exponent * self.tc_star)

    @staticmethod
    def _long_from(ag: ArrayLike) -> np.ndarray:
        return 4 * np.asarray(ag, dtype=float) / GRAVITY + 1.6

    def _amplification(self, ag: ArrayLike) -> np.ndarray:
        most, slope, low, high, _, _ = SOILS[self.soil]
        shaking = self.f0 * np.asarray(ag, dtype=float) / GRAVITY
        of_soil = np.minimum(np.maximum(most - slope * shaking, low), high)
        amplification: np.ndarray = self.topography * of_soil
        return amplification

    def largest_displacement(
        self, shortest: float, longest: ArrayLike, level: ArrayLike, damping: float
    ) -> np.ndarray:
        """Return S_De at `longest` [s], as it never falls with the period."""
        periods = self._checked(longest)
        return self.ordinates(periods, level, damping) * (periods / (2 * math.pi)) ** 2

    def ordinates(self, period: ArrayLike, level: ArrayLike, damping: float) -> np.ndarray:
        """Return S_e by the four branches of Eq. 3.2.2."""
        periods = np.asarray(period, dtype=float)
        ag = np.asarray(level, dtype=float)
        factor = damping_factor(damping)
        constant = self._constant_until
        rising = constant / 3
        long = np.maximum(self._long_from(ag), constant)
        plateau = ag * self._amplification(ag) * factor * self.f0
        share = np.minimum(periods / rising, 1.0)
        first = share + (1 - share) / (factor * self.f0)
        with np.errstate(divide="ignore"):
            velocity = np.minimum(constant / periods, 1.0)
            displacement = np.minimum(long / periods, 1.0)
        return np.asarray(plateau * first * velocity * displacement)


@dataclass(frozen=True, eq=False)
class PointSpectrum(DesignSpectrum):
    """A spectrum by its points, straight between them, as a site study gives it.

    periods, accelerations: (n,), s and m/s². Below the first period the ordinate is the first one. At another damping
    the ordinates are reduced by η over that of their own damping from the period of the largest ordinate on, and below
    it less, in proportion to the period, as the peak of the ground has no damping.
    """

    periods: tuple[float, ...]
    accelerations: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(
            self, "damping", within(ConfigurationError, "damping", self.damping, low=0, high=0.5)
        )
        _check_points(self.periods, self.accelerations)

    @property
    def level(self) -> float:
        """The first ordinate, m/s²."""
        return self.accelerations[0]

    @property
    def longest_period(self) -> float:
        """The period of the last point, s."""
        return self.periods[-1]

    @property
    def words(self) -> str:
        """Its extent."""
        return (
            f"{len(self.periods)} points from {self.periods[0]:.4g} to {self.periods[-1]:.4g} s, "
            f"first ordinate {self.level / GRAVITY:.4g} g, damping {self.damping:.3g}"
        )

    def at(self, level: float) -> Self:
        """Return it with all ordinates scaled so that the first one is `level` [m/s²]."""
        factor = level / self.level
        return replace(
            self, accelerations=tuple(factor * acceleration for acceleration in self.accelerations)
        )

    def largest_displacement(
        self, shortest: float, longest: ArrayLike, level: ArrayLike, damping: float
    ) -> np.ndarray:
        """Return that among many periods and the points within the range; it is in proportion to the level."""
        ends = self._checked(longest)
        begins = np.minimum(shortest, ends)
        even = np.linspace(begins, ends, _PERIODS_TRIED, axis=-1)
        points = np.clip(np.array(self.periods), begins[..., None], ends[..., None])
        periods = np.concatenate([even, points], axis=-1)
        shapes = self.ordinates(periods, self.level, damping) / self.level * (periods / (2 * math.pi)) ** 2
        largest: np.ndarray = np.asarray(level, dtype=float) * shapes.max(axis=-1)
        return largest

    def ordinates(self, period: ArrayLike, level: ArrayLike, damping: float) -> np.ndarray:
        """Return S_e between the points."""
        periods = np.asarray(period, dtype=float)
        shape = np.interp(periods, self.periods, self.accelerations) / self.level
        reduction = damping_factor(damping) / damping_factor(self.damping)
        peak_period = self.periods[int(np.argmax(self.accelerations))]
        share = np.minimum(periods / peak_period, 1.0) if peak_period else np.ones_like(periods)
        scaled = np.asarray(level, dtype=float) * shape
        return np.asarray(scaled * (1 + share * (reduction - 1)))


def _check_level(name: str, level: float) -> None:
    """Refuse a level that stands in another unit."""
    if positive(ConfigurationError, name, level, "m/s²") > LARGEST_LEVEL:
        raise ConfigurationError(
            f"{name} is {level:g} m/s², which is {level / GRAVITY:.3g} g, but must be {LARGEST_LEVEL:.3g} m/s² or "
            "less; check the unit.",
            **{name: level},
        )


def _check_points(periods: Sequence[float], accelerations: Sequence[float]) -> None:
    if len(periods) < 2 or len(periods) != len(accelerations):
        raise ConfigurationError(
            f"the spectrum has {len(periods)} periods and {len(accelerations)} accelerations, but must have at least 2 "
            "points, each with both."
        )
    for period in periods:
        if finite(ConfigurationError, "period", period, "s") < 0:
            raise ConfigurationError(f"period is {period!r} s, but must be 0 or more.")
    for acceleration in accelerations:
        positive(ConfigurationError, "acceleration", acceleration, "m/s²")
    for before, after in pairwise(periods):
        if not after > before:
            raise ConfigurationError(
                f"the period {after:g} s follows {before:g} s, but periods must ascend; sort the rows."
            )
    if periods[0] > LONGEST_FIRST_PERIOD:
        raise ConfigurationError(
            f"the first period is {periods[0]:g} s, but must be {LONGEST_FIRST_PERIOD:g} s or less, as the first "
            "ordinate stands for the peak of the ground; add it."
        )


def _read_points(path: Path) -> tuple[list[float], list[float]]:
    content = read_whole(path, _LARGEST_FILE, ConfigurationError)
    try:
        reader = csv.DictReader(StringIO(content.decode("utf-8-sig"), newline=""), strict=True)
        rows = [(reader.line_num, row) for row in reader]
        names = list(reader.fieldnames or ())
    except (ValueError, csv.Error) as error:
        raise ConfigurationError(f"{path}: the spectrum cannot be read as UTF-8 CSV, {error}.") from None
    given = [name for name in _ACCELERATIONS if name in names]
    if "period_s" not in names or len(given) != 1:
        raise ConfigurationError(
            f"{path}: the columns are {', '.join(names) or 'none'}, but must be period_s and one of "
            f"{' or '.join(_ACCELERATIONS)}."
        )
    column = given[0]
    periods = [_number(path, line, "period_s", row["period_s"]) for line, row in rows]
    typed = [_number(path, line, column, row[column]) for line, row in rows]
    for (line, _), number in zip(rows, typed, strict=True):
        positive(ConfigurationError, f"{path}, line {line}: {column}", number)
    return periods, [_ACCELERATIONS[column] * number for number in typed]


def _number(path: Path, line: int, name: str, cell: str | None) -> float:
    try:
        return float(cell or "")
    except ValueError:
        raise ConfigurationError(f"{path}, line {line}: {name} is {cell!r}, but must be a number.") from None
