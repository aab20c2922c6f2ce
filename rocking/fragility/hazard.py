"""Hazard curves, of OpenQuake or plain, and the annual rate at which a fragility is exceeded under one."""

import csv
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rocking.earthquakes.sample import ClusterSample, students
from rocking.errors import ConfigurationError
from rocking.fragility.measures import intensity_measure, of_openquake
from rocking.quantities import ACCELERATION_UNITS, GRAVITY, VELOCITY_UNITS, acceleration_unit, velocity_unit
from rocking.tables import read_whole

_STEPS = 400
"""Steps of the integral over the hazard curve, in equal parts of the logarithm of the level."""
_LARGEST_HAZARD = 1_000_000
"""Bytes of a hazard curve; fifty points take about one thousand."""
REACHING = 0.9
"""Least share of the stations that must reach the level at which half of a rate is made for it to be reported."""
_SAME_PLACE = 1e-4
"""Degrees within which a site is the one that is asked for: ten metres."""

_IN_UNIT = re.compile(
    r"(?P<stem>.+?)(?:\s*[\[(](?P<bracket>[^][()]+)[])]|[_ ](?P<end>%?g|mg|gal|[cm]?m(?:/|_|_per_)s(?:\^?2|²)?))",
    re.IGNORECASE,
)
"""The head of a column with its unit: "PGA (g)", "SA(0.5) [m/s2]", "level_cm_s"."""
_FACT = re.compile(r"""(\w+)=('[^']*'|"[^"]*"|[^,'"]+)""")


@dataclass(frozen=True, eq=False)
class Hazard:
    """A hazard curve of one site: the annual rate at which levels of an intensity measure are exceeded.

    Parameters
    ----------
    levels : ndarray
        (k,) levels, ascending, in our unit of the measure.
    annual_rates : ndarray
        (k,) rates of exceedance, 1/year, not rising, above 0.
    measure : str, default ''
        OpenQuake's name of the measure; empty where a plain file does not say it.
    quantiles : mapping of float to ndarray, optional
        (k,) rates by the share of the hazard model's branches that lie below.
    unit : str, default ''
        "g" or "m/s" of levels whose file says their unit and not their measure.

    Examples
    --------
    >>> hazard = rocking.Hazard(np.array([0.1, 1.0]), np.array([1e-2, 1e-4]))
    >>> hazard.annual_rates.tolist()
    [0.01, 0.0001]
    """

    levels: np.ndarray
    annual_rates: np.ndarray
    measure: str = ""
    quantiles: Mapping[float, np.ndarray] = field(default_factory=dict)
    unit: str = ""

    def __post_init__(self) -> None:
        for rates in (self.annual_rates, *self.quantiles.values()):
            _check("the hazard curve", self.levels, rates)

    @classmethod
    def read(
        cls, path: str | Path, *quantiles: str | Path, site: tuple[float, float] | None = None
    ) -> "Hazard":
        """Return the hazard curve of a CSV of OpenQuake, with its quantiles, or of a plain one.

        A plain file has the columns annual_rate and intensity, in our unit of its measure, or one whose head ends in
        its unit, as "level_m_s2" or "PGA (g)", by which it is converted. One of OpenQuake says the intensity measure
        and the time of its probabilities in its first line; its levels of a probability of 0 or 1 tell no rate and are
        left out. quantiles: files of OpenQuake for the same measure, site and levels. site: longitude and latitude,
        degrees, where a file holds several. Raises ConfigurationError for what is no hazard curve, in one sentence.
        """
        path = Path(path)
        text = read_whole(path, _LARGEST_HAZARD, ConfigurationError).decode("utf-8-sig", errors="replace")
        if not text.startswith("#"):
            levels, rates, measure, unit = _plain(path, text)
            _check(str(path), levels, rates)
            if rates[0] >= 1:
                raise ConfigurationError(
                    f"{path} says {rates[0]:g} a year at {levels[0]:g}, but annual_rate must be below 1 where no time "
                    "is said; divide what is of more years by them, or give the file of OpenQuake.",
                    annual_rate=float(rates[0]),
                )
            return cls(levels, rates, measure, unit=unit)
        mean = _OfOpenQuake.read(path, text, site)
        others = [
            _OfOpenQuake.read(
                Path(file),
                read_whole(Path(file), _LARGEST_HAZARD, ConfigurationError).decode(errors="replace"),
                site,
            )
            for file in quantiles
        ]
        for other in others:
            is_alike = other.imt == mean.imt and np.array_equal(other.levels, mean.levels)
            if not (other.quantile and is_alike):
                raise ConfigurationError(
                    f"{other.path} is {other.kind!r} of {other.imt}, but must be a quantile of {mean.imt} at the "
                    f"levels of {path}.",
                    quantile=other.kind,
                )
        measure, scale = _measure(mean)
        # A probability of 1 has no rate, and one of 0 no logarithm.
        telling = np.all([(curve.rates > 0) & np.isfinite(curve.rates) for curve in (mean, *others)], axis=0)
        levels = mean.levels[telling] / scale
        _check(str(path), levels, mean.rates[telling])
        return cls(
            levels,
            mean.rates[telling],
            measure,
            {curve.quantile: curve.rates[telling] for curve in others if curve.quantile},
        )

    def is_of(self, name: str) -> bool:
        """Return whether it is of the measure `name`, as far as it says."""
        if self.measure:
            return of_openquake(name)[0] == self.measure
        return not self.unit or self.unit == _unit_of(name)

    def check_measure(self, name: str) -> None:
        """Raise ConfigurationError where the curve says that it is of another measure than `name`."""
        if not self.is_of(name):
            raise ConfigurationError(
                f"the hazard curve is {f'of {self.measure}' if self.measure else f'in {self.unit}'}, but the intensity "
                f"measure is {name}; take one for the other.",
                intensity_measure=name,
            )


def _unit_of(name: str) -> str:
    """The unit of a measure, whatever its periods, which a structure may give."""
    return {"AvgSA": "g", "FIV3": "m/s"}.get(name) or intensity_measure(name).unit


def _plain(path: Path, text: str) -> tuple[np.ndarray, np.ndarray, str, str]:
    """Levels and rates of a plain file in our units, and measure and unit, "" where its head does not say them."""
    first, *lines = csv.reader(text.splitlines() or [""])
    heads = [head.strip() for head in first]
    others = [head for head in heads if head != "annual_rate"]
    head = others[0] if len(heads) == 2 and len(others) == 1 else ""
    spelt = _IN_UNIT.fullmatch(head)
    stem, unit = (spelt["stem"], spelt["bracket"] or spelt["end"]) if spelt else ("", "")
    acceleration, velocity = acceleration_unit(unit), velocity_unit(unit)
    if head == "intensity":
        factor, ours = 1.0, ""
    elif acceleration:
        factor, ours = ACCELERATION_UNITS[acceleration] / GRAVITY, "g"
    elif velocity:
        factor, ours = VELOCITY_UNITS[velocity], "m/s"
    else:
        raise ConfigurationError(
            f"{path} has the columns {', '.join(heads)[:80]!r}, but must have annual_rate and levels with their unit "
            "in the head, such as level_m_s2 or PGA (g), or intensity in the unit of its measure here (m/s of pgv, g "
            "of pga and SA); rename them.",
            columns=heads,
        )
    points = []
    for number, cells in enumerate(lines, start=2):
        try:
            values = dict(zip(heads, map(float, cells), strict=True))
        except ValueError:
            raise ConfigurationError(
                f"{path}, line {number}, holds {','.join(cells)[:80]!r}, but must hold two numbers.",
                line=number,
            ) from None
        points.append((factor * values[head], values["annual_rate"]))
    levels, rates = np.array(points).reshape(-1, 2).T
    try:
        measure = of_openquake(stem)[0] if ours else ""
        is_of_unit = not measure or _unit_of(stem) == ours
    except ConfigurationError:
        return levels, rates, "", ours  # a word such as "level"
    if not is_of_unit:
        raise ConfigurationError(
            f"{path} has the column {head!r}, but {stem} is in {_unit_of(stem)}; correct the unit.", unit=head
        )
    return levels, rates, measure, ours


def _check(name: str, levels: np.ndarray, rates: np.ndarray) -> None:
    """Raise ConfigurationError unless levels ascend and rates do not rise, all above 0, and there are two at least."""
    if len(levels) < 2:
        raise ConfigurationError(
            f"{name} holds {len(levels)} points, but must hold at least 2.", points=len(levels)
        )
    before: tuple[float, float] | None = None
    for level, rate in zip(levels.tolist(), rates.tolist(), strict=True):
        at = f"{rate:g} a year at {level:g}"
        if not (0 < level < math.inf and 0 < rate < math.inf):
            raise ConfigurationError(
                f"{name} holds {at}, but both must be above 0 and finite.", annual_rate=(level, rate)
            )
        if before and level <= before[0]:
            raise ConfigurationError(
                f"{name} holds {level:g} after {before[0]:g}, but intensity must ascend; sort it.",
                intensity=level,
            )
        if before and rate > before[1]:
            raise ConfigurationError(
                f"{name} says {at}, more than {before[1]:g} at {before[0]:g}, but annual_rate must not rise.",
                annual_rate=rate,
            )
        before = level, rate


@dataclass(frozen=True)
class _OfOpenQuake:
    """One file of hazard curves: a first line of facts, and a row for each site, of probabilities in a time."""

    path: Path
    kind: str
    imt: str
    levels: np.ndarray
    rates: np.ndarray

    @property
    def quantile(self) -> float:
        """The share of a file of a quantile; 0 of another."""
        found = re.fullmatch(r"quantile-([0-9.]+)", self.kind)
        return float(found[1]) if found else 0.0

    @classmethod
    def read(cls, path: Path, text: str, site: tuple[float, float] | None) -> "_OfOpenQuake":
        first, *lines = text.splitlines()
        comment = next(reversed(next(csv.reader([first]))))  # the last cell, with its quotes taken off
        facts = {name: value.strip("'\"") for name, value in _FACT.findall(comment)}
        for fact in ("investigation_time", "imt"):
            if fact not in facts:
                raise ConfigurationError(
                    f"{path} does not say {fact} in its first line, but must, as OpenQuake's do.", header=fact
                )
        rows = list(csv.DictReader(lines))
        columns = [name for name in (rows[0] if rows else {}) if name and name.startswith("poe-")]
        try:
            years = float(facts["investigation_time"])
            levels = np.array([float(name.removeprefix("poe-")) for name in columns])
            places = [(float(row["lon"]), float(row["lat"])) for row in rows]
            probabilities = np.array([[float(row[name]) for name in columns] for row in rows])
        except (KeyError, TypeError, ValueError):
            raise ConfigurationError(
                f"{path} is no hazard curve of OpenQuake: it must hold lon, lat and probabilities poe-LEVEL as "
                "numbers.",
                format="OpenQuake",
            ) from None
        chosen = [
            place
            for place, (longitude, latitude) in enumerate(places)
            if site is None or max(abs(longitude - site[0]), abs(latitude - site[1])) <= _SAME_PLACE
        ]
        if len(chosen) != 1:
            asked = f" at {site[0]:g}, {site[1]:g}" if site else ""
            raise ConfigurationError(
                f"{path} holds {len(chosen)} sites{asked}, but one is needed; give site=(longitude, latitude).",
                site=len(chosen),
            )
        own = probabilities[chosen[0]]
        if not (years > 0 and own.size and np.all((own >= 0) & (own <= 1))):
            raise ConfigurationError(
                f"{path} holds probabilities in {years:g} years that are none; they must lie from 0 to 1, and the time "
                "above 0.",
                probabilities=years,
            )
        with np.errstate(divide="ignore"):
            rates = -np.log1p(-own) / years
        return cls(path, facts.get("kind", ""), facts["imt"], levels, rates)


def _measure(of: _OfOpenQuake) -> tuple[str, float]:
    try:
        return of_openquake(of.imt)
    except ConfigurationError as error:
        raise ConfigurationError(f"{of.path}: {error}", imt=of.imt) from None


@dataclass(frozen=True, kw_only=True)
class AnnualRate:
    """The annual rate of exceedance with its 90 % interval, and the most that it may lack, 1/year.

    Parameters
    ----------
    value : float
        Annual rate of exceedance, 1/year; nan where it cannot be told.
    low : float
        Lower end of its 90 % interval, 1/year.
    high : float
        Upper end, 1/year.
    remainder : float
        Most that the value may lack, as levels end, 1/year.
    of_quantiles : mapping of float to float, optional
        The rate under each quantile of the hazard, which the interval does not cover: that is of the records.
    reaching : int, default 0
        Stations that reach the level at which half of it is made within the largest factor, of `stations`.
        Where these are fewer than 90 %, nobody knows the others' part: value is nan, and the ends are those of
        both cases, that the others never overturn beyond what they reach, and that they do at once (`is_stated`).
    stations : int, default 0
        Number of stations.

    Examples
    --------
    >>> rate = rocking.AnnualRate(value=2e-3, low=1e-3, high=4e-3, remainder=0.0)
    >>> f"{rate.probability(50)[0]:.3f}"
    '0.095'
    """

    value: float
    low: float
    high: float
    remainder: float
    of_quantiles: Mapping[float, float] = field(default_factory=dict)
    reaching: int = 0
    stations: int = 0

    @property
    def is_stated(self) -> bool:
        """Whether enough stations reach the level at which half of the rate is made."""
        return self.reaching >= REACHING * self.stations

    def probability(self, years: float) -> tuple[float, float, float]:
        """Return the probability of at least one exceedance in so many years, with its interval (a Poisson process)."""
        value, low, high = (-math.expm1(-rate * years) for rate in (self.value, self.low, self.high))
        return value, low, high


def annual_rate(
    levels: np.ndarray,
    probability: np.ndarray,
    exceedance: np.ndarray,
    sample: ClusterSample,
    hazard: Hazard,
) -> AnnualRate:
    """Return ∫ P dν over the hazard curve ν; both are linear in the logarithm of the level between their points.

    levels: (k,). probability: (k,) of all stations. exceedance: (r, k) of each record. sample: of these. The rate is
    the mean over the stations of the rate of each. Below its levels a station's curve counts as 0, above them as its
    last value, and where it was not tried as the share of the others; beyond the last point of the hazard curve all is
    counted there. The interval is that of `rate_interval`. The remainder is the most that the rate may lack: because
    the curve ends below a probability of 1, and because levels below the first point of the hazard curve are left out,
    which occur as often as the hazard curve, continued by its first slope, says.
    """
    places = np.log(levels)
    logs = np.log(hazard.levels)
    log_rates = np.log(hazard.annual_rates)
    edges = np.linspace(logs[0], logs[-1], _STEPS + 1)
    middles = np.append((edges[1:] + edges[:-1]) / 2, edges[-1])

    def occurring(annual_rates: np.ndarray) -> np.ndarray:
        rates = np.exp(np.interp(edges, logs, np.log(annual_rates)))
        return np.append(rates[:-1] - rates[1:], rates[-1])

    tried = np.isfinite(probability)
    pooled = np.interp(places, places[tried], probability[tried])
    curves = _curves_of_stations(exceedance, sample)
    frequencies = occurring(hazard.annual_rates)

    def rates_of(filled: np.ndarray) -> np.ndarray:
        return np.array([np.interp(middles, places, own, left=0.0) for own in filled])

    at_middles = rates_of(np.where(np.isnan(curves), pooled, curves))
    of_stations = at_middles @ frequencies
    rate = float(of_stations.mean())
    low, high = rate_interval(of_stations, sample)

    made = np.cumsum(at_middles.mean(axis=0) * frequencies)
    half = float(np.exp(middles[int(np.searchsorted(made, made[-1] / 2))])) if rate > 0 else float(levels[-1])
    # Beyond the last level there is nothing to reach.
    needed = min(half, float(levels[-1])) * (1 - 1e-9)
    reaching = int((~np.isnan(curves[:, levels >= needed])).any(axis=1).sum())
    is_stated = reaching >= REACHING * sample.count
    if not is_stated:
        low = rate_interval(rates_of(_filled(curves, at_once=False)) @ frequencies, sample)[0]
        high = rate_interval(rates_of(_filled(curves, at_once=True)) @ frequencies, sample)[1]

    above = (1 - pooled[-1]) * frequencies[middles >= places[-1]].sum()
    slope = (log_rates[0] - log_rates[1]) / (logs[1] - logs[0])
    lower = np.linspace(min(places[0], logs[0]), logs[0], _STEPS + 1)
    continued = np.exp(log_rates[0] + slope * (logs[0] - lower))
    below = np.interp((lower[1:] + lower[:-1]) / 2, places, pooled, left=0.0) @ -np.diff(continued)
    of_quantiles = {
        share: float((at_middles @ occurring(rates)).mean()) for share, rates in hazard.quantiles.items()
    }
    most = float(hazard.annual_rates[0])
    return AnnualRate(
        value=rate if is_stated else math.nan,
        low=min(low, rate),
        high=max(rate, min(high, most)),
        remainder=float(above + below),
        of_quantiles=of_quantiles if is_stated else dict.fromkeys(of_quantiles, math.nan),
        reaching=reaching,
        stations=sample.count,
    )


def _curves_of_stations(exceedance: np.ndarray, sample: ClusterSample) -> np.ndarray:
    """The curve of each station, (s, k): the mean of its records, nan where none was tried."""
    tried = np.isfinite(exceedance)
    trials = sample.by_station(tried.astype(float))
    with np.errstate(invalid="ignore"):
        curves: np.ndarray = sample.by_station(np.where(tried, exceedance, 0.0)) / trials
    return curves


def _filled(curves: np.ndarray, *, at_once: bool) -> np.ndarray:
    """The curves (s, k) with what was not tried: 1 at once, else as the level below left it, 0 below the first."""
    filled = curves.copy()
    for own in filled:
        last = 0.0
        for place, value in enumerate(own):
            if math.isnan(value):
                own[place] = 1.0 if at_once else last
            else:
                last = float(value)
    return filled


def rate_interval(of_stations: np.ndarray, sample: ClusterSample) -> tuple[float, float]:
    """Return the 90 % interval of the mean of the rates (s,) of the stations of a sample, by its earthquakes.

    Rates scatter by orders of magnitude, as the hazard curve raises a level to a power of 2 to 4. Resampling seldom
    meets the few that make up the mean, and its interval holds the truth in 56 to 92 % only. The interval is therefore
    that of the mean of a lognormal, by Student's law for few earthquakes (Cox's method: Zhou & Gao 1997, Confidence
    intervals for the log-normal mean, Stat. Med. 16, 783-790), times the share of the stations of earthquakes that have
    a rate at all. Where rates are no lognormal, that mean is not theirs; the interval therefore also holds that of the
    mean itself, by Student's law for its logarithm. What counts as one is an earthquake with the mean of its stations.
    """
    of_earthquakes = sample.spread(of_stations)
    positive = of_earthquakes.values > 0
    if positive.sum() < 2:
        return 0.0, math.inf
    share = min(float(of_earthquakes.weights[positive].sum()), 1.0)  # a sum of shares may round to more
    part = of_earthquakes.part(positive)
    logs = part.of(np.log(part.values))
    count = logs.count
    variance = logs.deviation**2
    middle = math.log(share) + logs.mean + variance / 2
    error = math.sqrt((1 - share) / count + variance / count + variance**2 / (2 * (count - 1)))
    reach = students(freedom=count - 1) * error

    mean = of_earthquakes.mean
    own_reach = of_earthquakes.reach() / mean

    low = min(middle - reach, math.log(mean) - own_reach)
    high = max(middle + reach, math.log(mean) + own_reach)
    return math.exp(max(low, -700.0)), math.exp(min(high, 700.0))
