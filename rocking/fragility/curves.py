"""Fragility: the probability that a structure overturns, or turns far, at a level of shaking.

From records scaled to common levels (incremental dynamic analysis) or left as recorded (cloud): the empirical curve and
the lognormal one, with intervals by earthquake; and how well an intensity measure explains which record overturns when.
"""

import math
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy.special import erfcx, ndtr, stdtr, stdtrit

from rocking.assessment.cracks import cracks, never_overturns_because, sliding_first
from rocking.assessment.ensemble import drawn, lattice
from rocking.assessment.falls import Falls, Model, falls_along
from rocking.assessment.motions import GroundMotions
from rocking.assessment.reserve import rising_curve
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.drawn import Drawn
from rocking.earthquakes.sample import ClusterSample, interval_words
from rocking.errors import ConfigurationError, StructureError
from rocking.floors.support import Support
from rocking.fragility.exchange import CURVE, NRML, curve_frame, nrml
from rocking.fragility.hazard import AnnualRate, Hazard, annual_rate
from rocking.fragility.measures import IntensityMeasure, check_name, per_velocity
from rocking.fragility.measures import intensity_measure as measure_named
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import Rocking, reduce
from rocking.progress import bar
from rocking.quantities import GRAVITY, counted, listed
from rocking.records import Accelerogram
from rocking.signal.measures import peak_velocity
from rocking.structures import EquivalentBlock, Mechanism, Structure
from rocking.structures.structure import Mechanisms
from rocking.structures.unknown_geometry import as_structure
from rocking.tables import check_target, write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

LEVELS = 40
"""Levels in all."""
COARSE = 20
"""Levels that are spread evenly over the range of the curve at first."""
MOST_SPREAD = 30
"""Levels at the most that are spread evenly, where the curve reaches farther. The rest are put where it moves."""
SEVERE = 3.0
"""p PGV/(gλ) from which nearly every structure overturns under nearly every record."""
NEARLY_ALL = 0.95
"""Share that overturns at the highest level."""
LARGEST_FACTOR = 10.0
"""Largest factor on a record. A weak record that is scaled farther has neither the duration nor the periods of shaking
that strong, and the noise of its instrument is scaled with it."""
MEMBERS = 16
"""Members of each ensemble."""
DISPERSIONS = (0.02, 3.0)
"""Bounds of a dispersion: outcomes that a level parts cleanly would fit ever smaller ones."""
_FARTHEST = 8.0
"""Standard deviations beyond which a probability is 0 or 1 to double precision."""
_RIDGE = 1e-9
"""Penalty on standardised slopes per case: keeps those finite that no case contradicts."""


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Fragility(Drawn):
    """P(rotation ratio > threshold | intensity) of one structure; the threshold inf is overturning.

    `plot` draws the empirical curve with its interval and the lognormal one.

    Parameters
    ----------
    levels : ndarray
        (k,) levels of the intensity.
    probability : ndarray
        (k,) empirical curve, each station with the same weight; nan where nothing was tried.
    probability_low : ndarray
        (k,) lower end of its 90 % interval, point by point.
    probability_high : ndarray
        (k,) upper end.
    median : float
        Level at which the rising curve next to the empirical one crosses one half; inf where it does not.
    interval : tuple of (float, float)
        90 % interval of the median.
    lognormal : ndarray
        (k,) lognormal curve.
    lognormal_median : float
        Its median, by maximum likelihood.
    dispersion : float
        Its dispersion, by maximum likelihood.
    misfit : float
        Largest distance of the lognormal curve from the empirical one.
    exceedance : ndarray
        (r, k) share of the members of each record above the threshold.
    sample : ClusterSample
        Which records are of one station, and which stations of one earthquake.
    measure : str, default ''
        Name of the intensity measure.
    unit : str, default ''
        Unit of the intensity.
    threshold : float, default inf
        Rotation ratio that is exceeded; inf: overturning.
    analysis : IncrementalDynamicAnalysis or None, optional
        Responses behind the curve; None of outcomes alone.
    unreached : tuple of float, default ()
        Levels that were asked for and left out, because no two stations reach them.
    upper : Fragility or None, optional
        The curve in which what cannot be told falls, where that is another one: the truth lies between both.
    by : str, default 'mechanism'
        What the curve is of: the mechanism, contact dynamics where that was asked, or the mechanism alone, which is
        the lower end.

    Examples
    --------
    >>> records = rocking.read("records/20161113_110259_WTMC_20.V2A")[:2]
    >>> curve = rocking.fragility(records, rocking.Block(2.0, 0.2), stations=["a", "b"], levels=[0.2, 0.6, 1.0])
    >>> curve.sample.words
    '2 stations of 1 earthquake'
    >>> (curve.measure, curve.levels.tolist(), curve.probability.tolist())
    ('pgv', [0.2, 0.6, 1.0], [0.0, 0.0, 1.0])
    """

    levels: np.ndarray
    probability: np.ndarray
    probability_low: np.ndarray
    probability_high: np.ndarray
    median: float
    interval: tuple[float, float]
    lognormal: np.ndarray
    lognormal_median: float
    dispersion: float
    misfit: float
    exceedance: np.ndarray
    sample: ClusterSample
    measure: str = ""
    unit: str = ""
    threshold: float = np.inf
    analysis: "IncrementalDynamicAnalysis | None" = None
    unreached: tuple[float, ...] = ()
    upper: "Fragility | None" = None
    by: str = "mechanism"

    def __repr__(self) -> str:
        low, high = self.interval
        unit = f" {self.unit}" if self.unit else ""
        interval = f"{interval_words(self.sample.earthquakes)}: {low:.3g} to {high:.3g}"
        unreached = listed([f"{level:g}" for level in self.unreached])
        if (gap := self.gap) is not None:
            interval = f"between levels {gap[0]:.3g} and {gap[1]:.3g}, too far apart for an interval"
        median = f"{self.median:.3g}"
        if self.upper is not None and self.upper.median < self.median:
            median = f"from {self.upper.median:.3g} to {median}"
        return (
            f"<Fragility by {self.by}: median {self.measure} {median}{unit} ({interval}), "
            f"{counted(len(self.stations), 'record')} of {self.sample.words}"
            f"{f'; no two stations reach {unreached}' if unreached else ''}>"
        )

    @property
    def stations(self) -> tuple[str, ...]:
        """(r,): the station of each record."""
        return self.sample.stations

    @property
    def gap(self) -> tuple[float, float] | None:
        """The two levels, next to each other, between which the whole interval of the median lies; None where the
        levels are near enough to each other to give it.
        """
        place, last = np.searchsorted(self.levels, self.interval)
        is_between = place == last and 0 < place < self.levels.size
        return (float(self.levels[place - 1]), float(self.levels[place])) if is_between else None

    def annual_rate(self, hazard: Hazard) -> AnnualRate:
        """Return the annual rate of exceedance under a hazard curve, with its 90 % interval by earthquakes; nan with
        both ends where too few stations reach the level at which half of it is made.

        With it come the rates under the quantiles of the hazard. Raises ConfigurationError for a hazard curve that
        says another intensity measure.
        """
        if self.measure:
            hazard.check_measure(self.measure)
        rate = annual_rate(self.levels, self.probability, self.exceedance, self.sample, hazard)
        if self.upper is None:
            return rate
        # What cannot be told falls, or does not: the rate lies between both ends, and is neither.
        most = self.upper.annual_rate(hazard)
        return replace(
            rate,
            value=math.nan,
            high=most.high,
            remainder=max(rate.remainder, most.remainder),
            of_quantiles=dict.fromkeys(rate.of_quantiles, math.nan),
        )

    def to_nrml(self, path: str | Path, *, name: str = "structure", lognormal: bool = False) -> None:
        """Write the curve as a fragility model of OpenQuake, NRML 0.5: discrete, or with two parameters of a lognormal.

        name: of the function, by which an exposure model names its class. Levels are in OpenQuake's unit. Raises
        ConfigurationError for a measure that OpenQuake lacks, and for a file that exists and is no such model.
        """
        write_whole(check_target(path, NRML), nrml({name: self}, lognormal))

    def to_csv(self, path: str | Path) -> None:
        """Write the curve as a CSV: a row per level, with the measure and its unit in each.

        Raises ConfigurationError for a file that exists and is no such table.
        """
        content = self.frame().to_csv(index=False, lineterminator="\n")
        write_whole(check_target(path, CURVE), content.encode())

    def frame(self) -> "DataFrame":
        """Return a pandas frame with one row per level, as `to_csv` writes it."""
        return curve_frame(self)

    def reaching(self, level: float) -> int:
        """Return how many stations have a record that was tried at `level` or above, within the largest factor."""
        places = np.flatnonzero(self.levels >= level * (1 - 1e-9))
        if not places.size:
            return 0
        reaches = np.isfinite(self.exceedance[:, places[0] :]).any(axis=1)
        return len({name for name, is_reached in zip(self.stations, reaches, strict=True) if is_reached})

    @property
    def reversals(self) -> np.ndarray:
        """The times that each record, scaled up, lets stand again what it had overturned, (r,)."""
        falls = [shares[np.isfinite(shares)] > 0.5 for shares in self.exceedance]
        return np.array([int((np.diff(steps.astype(int)) < 0).sum()) for steps in falls])


def fragility_of(levels: np.ndarray, exceedance: np.ndarray, sample: ClusterSample) -> Fragility:
    """Return the curve of outcomes at `levels` (k,) > 0, ascending.

    exceedance: (r, k) shares in [0, 1], one row a record, nan where it was not tried. sample: of the records; those of
    one station weigh as much as one. Where all or none overturn the median of the lognormal lies at the edge of what
    the levels can tell.

    >>> outcomes = np.array([[0, 0, 1, 1], [0, 1, 1, 1], [0, 0, 0, 1]])
    >>> sample = ClusterSample.scattered(["A", "B", "C"])
    >>> round(fragility_of(np.array([0.1, 0.2, 0.4, 0.8]), outcomes, sample).median, 3)
    0.283
    """
    tried = np.isfinite(exceedance)
    over = sample.by_station(np.where(tried, exceedance, 0.0))
    trials = sample.by_station(tried.astype(float))
    ever = np.flatnonzero(trials.any(axis=1))
    over = over[ever]
    trials = trials[ever]
    telling = sample.part(ever)
    low, high = telling.share_bounds(over, tried=trials)
    with np.errstate(invalid="ignore"):
        probability = np.clip(over.sum(axis=0) / trials.sum(axis=0), 0.0, 1.0)
    logs = np.log(levels)
    middle = logs.mean()
    (offset, slope), _ = _probit([np.broadcast_to(logs - middle, exceedance.shape)], exceedance, sample)
    dispersion = float(np.clip(1 / slope if slope > 0 else np.inf, *DISPERSIONS))
    lognormal = ndtr((logs - middle) / dispersion + offset)
    return Fragility(
        levels=levels,
        probability=probability,
        probability_low=low,
        probability_high=high,
        median=crossing(levels, over.sum(axis=0), trials.sum(axis=0)),
        interval=telling.interval(lambda weights: crossing(levels, weights @ over, weights @ trials)),
        lognormal=lognormal,
        lognormal_median=float(np.exp(middle - offset * dispersion)),
        dispersion=dispersion,
        misfit=float(np.nanmax(np.abs(probability - lognormal))),
        exceedance=exceedance,
        sample=sample,
    )


def crossing(levels: np.ndarray, over: np.ndarray, trials: np.ndarray) -> float:
    """Return the level at which the rising curve nearest to over/trials (k,) crosses one half, linear in the logarithm.

    Where the curve is one half over a range, the middle of it; the first level where all lie above, inf where all lie
    below.
    """
    tried = trials > 0
    logs = np.log(levels[tried])
    rising = rising_curve(over[tried] / trials[tried], trials[tried])
    rising[np.abs(rising - 0.5) < 1e-12] = 0.5  # but for rounding
    places = []
    for above in (int(np.searchsorted(rising, 0.5, side)) for side in ("left", "right")):
        if above == rising.size:
            return float("inf")
        below = max(above - 1, 0)
        rise = rising[above] - rising[below]
        part = (0.5 - rising[below]) / rise if rise > 0 else 0.0
        places.append(logs[below] + part * (logs[above] - logs[below]))
    return float(np.exp(np.mean(places)))


def _probit(
    terms: Sequence[np.ndarray], outcomes: np.ndarray, sample: ClusterSample
) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients (q,) of the shares (r, k) as Φ of an intercept and terms (r, k), each station with the same weight,
    by Fisher scoring; and their covariance by the scatter between the earthquakes (Liang & Zeger 1986).

    outcomes: nan where there is none.
    """
    place = sample.of_record
    records = np.bincount(place)
    tried = np.isfinite(outcomes)
    station = np.broadcast_to(place[:, None], outcomes.shape)[tried]
    weight = 1 / records[station]
    design = np.stack([np.ones(outcomes.shape), *terms], axis=-1)[tried]
    varies = design.std(axis=0) > 0
    scale = np.where(varies, design.std(axis=0), 1.0)
    rows = design / scale
    over = outcomes[tried] * weight
    penalty = weight.sum() * np.where(varies, _RIDGE, 0.0)
    coefficients = np.zeros(scale.size)
    for _ in range(100):
        eta = np.clip(rows @ coefficients, -_FARTHEST, _FARTHEST)
        # The normal density over Φ(η) and over Φ(−η).
        above, below = (np.sqrt(2 / np.pi) / erfcx(sign * eta / np.sqrt(2)) for sign in (-1, 1))
        scores = rows * (over * above - (weight - over) * below)[:, None]
        curvature = (rows * (weight * above * below)[:, None]).T @ rows
        curvature += np.diag(penalty + 1e-12 * weight.sum())
        step = np.linalg.solve(curvature, scores.sum(axis=0) - penalty * coefficients)
        coefficients = coefficients + step * min(1.0, 2.0 / max(np.abs(step).sum(), 1e-300))
        if np.abs(step).sum() < 1e-10:
            break
    count = sample.earthquakes
    of_earthquakes = np.zeros((count, scale.size))
    np.add.at(of_earthquakes, sample.of_station[station], scores)
    inverse = np.linalg.inv(curvature)
    covariance = inverse @ (of_earthquakes.T @ of_earthquakes) @ inverse * count / max(count - scale.size, 1)
    return coefficients / scale, covariance / np.outer(scale, scale)


@dataclass(frozen=True, kw_only=True)
class Explanation:
    """How well levels of an intensity measure, together with a figure of the record, explain which records overturn.

    efficiency: standard deviation of the logarithm of the level that overturns. slope: change of that logarithm for one
    standard deviation of the figure. p_value: of no change. power: share of samples of as many earthquakes that would
    show such a slope at 5 %. The last three are nan for fewer than four earthquakes or equal figures.
    """

    efficiency: float
    slope: float = math.nan
    p_value: float = math.nan
    power: float = math.nan


def explanation(
    log_levels: np.ndarray, exceedance: np.ndarray, figures: np.ndarray, sample: ClusterSample
) -> Explanation:
    """Return how well the levels (r, k), together with the `figures` (r,), explain the outcomes (r, k).

    A record that was tried at no level says nothing, and a figure that differs in such a record alone is equal. Every
    outcome counts, also of records that never overturn or that stand again above the level that overturned them. The
    error of the slope is that between earthquakes, so that two stations of one are no two observations, and the slope
    over it is compared with Student's law for the number of earthquakes less three.
    """
    tried = np.isfinite(exceedance).any(axis=1)
    log_levels = log_levels[tried]
    exceedance = exceedance[tried]
    figures = figures[tried]
    sample = sample.of_records(tried)
    (_, steepness), _ = _probit([log_levels], exceedance, sample)
    efficiency = float(1 / steepness) if steepness > 0 else math.nan
    freedom = sample.earthquakes - 3
    if freedom < 1 or np.ptp(figures) == 0:
        return Explanation(efficiency=efficiency)
    scaled = (figures - figures.mean()) / figures.std()
    figure_of_each = np.broadcast_to(scaled[:, None], log_levels.shape)
    (_, level, figure), covariance = _probit([log_levels, figure_of_each], exceedance, sample)
    t = abs(figure) / np.sqrt(covariance[2, 2])
    limit = stdtrit(freedom, 0.975)
    return Explanation(
        efficiency=efficiency,
        slope=float(-figure / level),
        p_value=float(2 * stdtr(freedom, -t)),
        power=float(ndtr(t - limit) + ndtr(-t - limit)),
    )


@dataclass(frozen=True, eq=False)
class IncrementalDynamicAnalysis:
    """The largest rotations of a structure under records at levels of an intensity measure.

    measure: of the levels. levels: (k,) ascending. rotation_ratios: (r, k, m) of every record, level and member, with
    the crack that governs there; inf overturns or cannot be followed, nan where a cloud holds no such case.
    intensities: (r,) of the records as they are. sample: their stations and earthquakes. falls: of each record (r) at
    each level (k); None where no level was tried.
    """

    measure: IntensityMeasure
    levels: np.ndarray
    rotation_ratios: np.ndarray
    intensities: np.ndarray
    sample: ClusterSample
    falls: Sequence[Sequence[Falls | None]] = ()

    @property
    def stations(self) -> tuple[str, ...]:
        """(r,): the station of each record."""
        return self.sample.stations

    @property
    def factors(self) -> np.ndarray:
        """The factors (r, k) on the records that take them to the levels."""
        return factors_to(self.levels, self.intensities, self.measure.power)

    def fragility(self, threshold: float = np.inf) -> Fragility:
        """Return the curve of exceeding a rotation ratio; inf: of overturning."""
        ratios = self.rotation_ratios
        above = np.isinf(ratios) | (ratios > threshold)
        exceedance = np.where(np.isnan(ratios), np.nan, above).mean(axis=2)
        upper = None
        by = "mechanism"
        if math.isinf(threshold) and self.falls:
            ends = np.array(
                [
                    [(np.nan, np.nan) if one is None else (one.low, one.high) for one in of_record]
                    for of_record in self.falls
                ]
            )
            exceedance = ends[:, :, 0]
            upper = self._curve(ends[:, :, 1], threshold) if (ends[:, :, 1] > exceedance).any() else None
            models = {one.by for of_record in self.falls for one in of_record if one is not None}
            if upper is not None:
                by = "mechanism alone, the lower end"
            elif Model.CONTACTS in models:
                by = "mechanism and contact dynamics"
        curve = self._curve(exceedance, threshold)
        if upper is None:
            return replace(curve, by=by)
        # A lognormal curve of one end is none of both, and the median lies between the outer ends.
        unknown = np.full(self.levels.size, np.nan)
        if upper.median < curve.median:
            curve = replace(
                curve, lognormal=unknown, lognormal_median=math.nan, dispersion=math.nan, misfit=math.nan
            )
        return replace(curve, upper=upper, by=by, interval=(upper.interval[0], curve.interval[1]))

    def _curve(self, exceedance: np.ndarray, threshold: float) -> Fragility:
        """The curve of shares (r, k) of the members of each record."""
        curve = fragility_of(self.levels, exceedance, self.sample)
        name = self.measure.name
        unit = self.measure.unit
        return replace(curve, measure=name, unit=unit, threshold=threshold, analysis=self)


def fragility(
    records: Sequence[Accelerogram],
    structure: Rocking,
    *,
    threshold: float = np.inf,
    intensity_measure: str = "pgv",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    events: Sequence[str] | None = None,
    method: Literal["scaling", "cloud"] = "scaling",
    ensemble: EnsembleSettings | None = None,
    over_cracks: bool = True,
    largest_factor: float = LARGEST_FACTOR,
    tolerance: float = 1e-6,
    support: Support | None = None,
    contacts: bool = True,
) -> Fragility:
    """Return the fragility of `structure` under `records`.

    It is that of what governs, and says of overturning what the decision would: where that asks for contact dynamics,
    some stacks are followed; what cannot be told falls in its `upper` alone. What cannot be followed counts as
    overturning.

    Parameters
    ----------
    records : sequence of Accelerogram
        (r,) horizontal components, each by itself.
    structure : Mechanism, EquivalentBlock or Structure
        What rocks.
    threshold : float, default inf
        Rotation ratio that is exceeded; inf: overturning.
    intensity_measure : str, default 'pgv'
        Name that `rocking.intensity_measure` knows; AvgSA and FIV3 also without periods.
    levels : sequence of float, ndarray or None, optional
        Levels of the intensity, ascending, in the unit of the measure; None: 40 that lie where the
        probability of overturning moves. Those that no two stations reach are left out, as the curve says.
    stations : sequence of str or None, optional
        (r,) stations; None: those that the records name.
    events : sequence of str or None, optional
        (r,) earthquakes; None: those that the records name. All that name no earthquake count as of one, from
        which no interval follows.
    method : {'scaling', 'cloud'}, default 'scaling'
        Scaling takes every record to every level; cloud leaves it as recorded, and the levels are then those
        of the records.
    ensemble : EnsembleSettings or None, optional
        Ranges of the uncertain inputs; each case then has MEMBERS members.
    over_cracks : bool, default True
        Whether the crack counts that governs at each level; False: the one that statics chooses.
    largest_factor : float, default 10.0
        Largest factor on a record; one that would need more to reach a level is left out of that level.
    tolerance : float, default 1e-06
        Relative tolerance of the largest rotation.
    support : Support or None, optional
        Support on which the structure stands and whose motion it meets; the intensity stays that of the
        ground.
    contacts : bool, default True
        Whether contact dynamics follows what the decision would not leave to mechanisms; False: it cannot be told.

    Returns
    -------
    Fragility
        The curve with its interval; its `analysis` holds the responses.

    Raises
    ------
    ConfigurationError
        For fewer than two stations, levels out of order or out of reach, or a measure that a record lacks.
    StructureError
        For a structure that cannot overturn.

    Examples
    --------
    >>> pulses = [
    ...     rocking.Pulse(amplitude=1.0, circular_frequency=frequency, start_time=0.5)
    ...     for frequency in (4.0, 6.0, 9.0)
    ... ]
    >>> times = np.arange(400) * 0.01
    >>> records = [rocking.Accelerogram(pulse.acceleration(times), 0.01) for pulse in pulses]
    >>> rocking.fragility(records, rocking.Block(2.0, 0.2), levels=[0.2, 0.4, 0.8, 1.6]).probability.tolist()
    [0.0, 0.0, 0.0, 1.0]
    """
    if method == "cloud" and levels is not None:
        raise ConfigurationError(
            "levels are given, but a cloud has those of its records; leave them out.", levels="given"
        )
    reduced = reduce(structure)
    check_name(intensity_measure)
    if isinstance(reduced, EquivalentBlock):
        raise ConfigurationError(
            "structure is an equivalent block, but must be a structure or a mechanism.",
            structure="equivalent block",
        )
    sample = checked_sample(ClusterSample.of(records, stations, events))
    body = as_structure(structure if isinstance(structure, Structure) else reduced)
    counting = cracks(body).counting
    first, *others = counting
    mechanism = first.mechanism
    if why := never_overturns_because(body):
        raise StructureError(f"the structure cannot overturn, and has no fragility: it {why}.", structure=why)
    measure = measure_named(intensity_measure, mechanism)
    intensities = np.array([measure.of(record, mechanism) for record in records])
    carried = records if support is None else [support.motion(record) for record in records]
    follow = partial(_rotation_ratios, carried, ensemble, tolerance)
    if method == "cloud":
        order = np.argsort(intensities, kind="stable")
        places = np.arange(order.size)
        # Equal intensities are moved apart by rounding size, so that each stays a level of its own.
        chosen = intensities[order] * (1 + 1e-12 * places)
        factors = np.full((order.size, order.size), np.nan)
        factors[order, places] = 1.0
        ratios = follow(mechanism, factors)
    else:
        scaling = _Scaling(intensities, sample.stations, largest_factor, measure.power)
        chosen, ratios = _at_levels(partial(follow, mechanism), mechanism, carried, scaling, levels)
        factors = scaling.factors(chosen)
    if over_cracks and others:
        left_out = _left_out(counting, carried, factors)
        ratios = np.where(left_out[0, ..., None], 0.0, ratios)
        for other, is_out in zip(others, left_out[1:], strict=True):
            ratios = follow(other.mechanism, np.where(is_out, np.nan, factors), ratios)
    varied = AssessmentSettings(ensemble=ensemble or EnsembleSettings(), tolerance=tolerance)
    follow_record = partial(falls_along, body, varied, contacts=contacts)
    falls: list[list[Falls | None]] = []
    if over_cracks:
        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            found = pool.map(follow_record, carried, factors, ratios)
            falls = list(bar(found, "record", len(carried)))
    analysis = IncrementalDynamicAnalysis(measure, chosen, ratios, intensities, sample, falls)
    beyond = () if levels is None else tuple(float(level) for level in levels if level > chosen[-1])
    return replace(analysis.fragility(threshold), unreached=beyond)


def checked_sample(sample: ClusterSample) -> ClusterSample:
    """Return the sample. Raises ConfigurationError for fewer than two stations."""
    if sample.count < 2:
        raise ConfigurationError(
            f"the records come from {sample.count} station, but a fragility needs at least 2; add records.",
            records=sample.count,
        )
    return sample


def _rotation_ratios(
    records: Sequence[Accelerogram],
    ensemble: EnsembleSettings | None,
    tolerance: float,
    mechanism: Mechanism,
    factors: np.ndarray,
    other: np.ndarray | None = None,
) -> np.ndarray:
    """The rotation ratios (r, k, m) of every record at its factors (r, k), or those of another mechanism that governs.

    It governs where more of its members overturn, or as many and one turns farther: only one crack opens. What has the
    factor nan, or all of whose members overturn with the other, is not followed. A member without an answer counts as
    one that overturns.
    """
    points = lattice(MEMBERS)
    if other is None:
        nothing = np.where(np.isnan(factors), np.nan, 0.0)
        other = np.repeat(nothing[..., None], MEMBERS if ensemble else 1, axis=2)

    def follow(record: Accelerogram, scales: np.ndarray, own: np.ndarray) -> np.ndarray:
        is_open = ~(np.isinf(own).all(axis=1) | np.isnan(scales))
        if not is_open.any():
            return own
        if ensemble is None:
            single = integrate_batch([mechanism], record, scales[is_open], tolerance=tolerance, workers=1)
            followed = single[0][:, None]
        else:
            motions = [GroundMotions.of(record.scaled(float(scale))) for scale in scales[is_open]]
            members = [drawn(mechanism, motion, points, ensemble, tolerance=tolerance) for motion in motions]
            followed = np.array([member.rotation_ratios for member in members])
        ratios = own.copy()
        ratios[is_open] = np.nan_to_num(followed, nan=np.inf, posinf=np.inf)
        falls, own_falls = np.isinf(ratios).sum(axis=1), np.isinf(own).sum(axis=1)
        governs = (falls > own_falls) | ((falls == own_falls) & (ratios.max(axis=1) > own.max(axis=1)))
        return np.where(governs[:, None], ratios, own)

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        of_records = pool.map(follow, records, factors, other)
        return np.array(list(bar(of_records, "record", len(records))))


def _left_out(counting: Mechanisms, records: Sequence[Accelerogram], factors: np.ndarray) -> np.ndarray:
    """Whether each crack is left out at the factors (r, k), (c, r, k): it slides before it lifts, and another lifts."""
    left_out = np.zeros((len(counting), *factors.shape), dtype=bool)
    for place, step in np.argwhere(~np.isnan(factors)).tolist():
        motions = GroundMotions.of(records[place].scaled(float(factors[place, step])))
        sliding = sliding_first(counting, motions)
        if len(sliding) < len(counting):
            left_out[:, place, step] = [crack in sliding for crack in counting]
    return left_out


def factors_to(levels: np.ndarray, intensities: np.ndarray, power: int) -> np.ndarray:
    """Return the factors (r, k) on records that take them from their intensities (r,) to the levels (k,)."""
    factors: np.ndarray = (levels / intensities[:, None]) ** (1 / power)
    return factors


@dataclass(frozen=True, eq=False)
class _Scaling:
    """The scaling that takes records to levels. intensities: (r,) of the records as they are. stations: (r,).

    power: with which the intensity grows.
    """

    intensities: np.ndarray
    stations: tuple[str, ...]
    largest_factor: float
    power: int

    def factors(self, levels: np.ndarray) -> np.ndarray:
        """Return the factors (r, k) that take every record to each level; nan beyond the largest."""
        factors = factors_to(levels, self.intensities, self.power)
        return np.where(factors <= self.largest_factor * (1 + 1e-9), factors, np.nan)

    @property
    def highest(self) -> float:
        """The highest level that records of two stations reach."""
        reach: dict[str, float] = {}
        for name, intensity in zip(self.stations, self.intensities.tolist(), strict=True):
            reach[name] = max(reach.get(name, 0.0), intensity * self.largest_factor**self.power)
        return sorted(reach.values())[-2]


def _at_levels(
    follow: Callable[[np.ndarray], np.ndarray],
    mechanism: Mechanism,
    records: Sequence[Accelerogram],
    scaling: _Scaling,
    levels: Sequence[float] | np.ndarray | None,
) -> tuple[np.ndarray, np.ndarray]:
    """The levels and (r, k, m) of what `follow` gives at the factors (r, k) that take every record to each of them.

    By default LEVELS: spread from the first uplift to where nearly all overturn, or to the highest that two stations
    reach, and the rest where the share moves.
    """

    def at(some: np.ndarray) -> np.ndarray:
        return follow(scaling.factors(some))

    if levels is not None:
        chosen = _checked_levels(levels)
        if chosen[0] > scaling.highest:
            raise ConfigurationError(
                f"levels begin at {chosen[0]:g}, but within a factor of {scaling.largest_factor:g} two stations reach "
                f"{scaling.highest:.3g} at the most; take stronger records.",
                levels=float(chosen[0]),
            )
        chosen = chosen[chosen <= scaling.highest * (1 + 1e-9)]
        return chosen, at(chosen)
    chosen = _spread_levels(mechanism, records, scaling)
    ratios = at(chosen)
    while _share_that_overturns(ratios)[-1] < NEARLY_ALL and chosen.size < MOST_SPREAD:
        more = chosen[-1] * np.array([1.5, 2.25]) ** scaling.power
        more = more[more <= scaling.highest]
        if not more.size:
            break
        ratios = np.hstack([ratios, at(more)])
        chosen = np.append(chosen, more)
    between = _where_it_moves(chosen, _share_that_overturns(ratios), LEVELS - chosen.size)
    ratios = np.hstack([ratios, at(between)])
    chosen = np.append(chosen, between)
    order = np.argsort(chosen)
    return chosen[order], ratios[:, order]


def _spread_levels(mechanism: Mechanism, records: Sequence[Accelerogram], scaling: _Scaling) -> np.ndarray:
    """The first COARSE levels, from the first uplift to where all should overturn, or to the highest within reach."""
    peaks = np.array([record.peak_acceleration for record in records])
    uplifts = mechanism.uplift_multiplier * GRAVITY / peaks
    within_reach = uplifts <= scaling.largest_factor
    reach = scaling.highest
    lowest = float((scaling.intensities * uplifts**scaling.power)[within_reach].min(initial=reach / 2))
    severities = per_velocity(mechanism.equivalent_block("exact_at_rest")) * np.array(
        list(map(peak_velocity, records))
    )
    highest = min(float((scaling.intensities * (SEVERE / severities) ** scaling.power).max()), reach)
    levels: np.ndarray = np.geomspace(
        lowest, min(max(highest, 2 * lowest), max(reach, 1.01 * lowest)), COARSE
    )
    return levels


def _share_that_overturns(ratios: np.ndarray) -> np.ndarray:
    """The share (k,) of ratios (r, k, m) that are inf, of those that were tried; 0 where none was."""
    tried = np.isfinite(ratios) | np.isinf(ratios)
    over = np.isinf(ratios).sum(axis=(0, 2))
    return np.asarray(over / np.maximum(tried.sum(axis=(0, 2)), 1))


def _where_it_moves(levels: np.ndarray, share: np.ndarray, count: int) -> np.ndarray:
    """`count` levels at equal steps of how far the curve has moved, up or down."""
    moved = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(share)) + 1e-3)])
    places = (np.arange(count) + 0.5) / count * moved[-1]
    return np.asarray(np.exp(np.interp(places, moved, np.log(levels))))


def _checked_levels(levels: Sequence[float] | np.ndarray) -> np.ndarray:
    """The levels as an array. Raises ConfigurationError unless they ascend and are greater than 0."""
    array = np.asarray(levels, dtype=float)
    if array.ndim != 1 or array.size < 2 or not np.all(np.isfinite(array) & (array > 0)):
        raise ConfigurationError("levels must be at least two finite numbers greater than 0.", levels=levels)
    for before, level in pairwise(array):
        if level <= before:
            raise ConfigurationError(
                f"levels hold {level:g} after {before:g}, but must ascend; sort them.", levels=float(level)
            )
    return array
