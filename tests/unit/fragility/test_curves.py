"""Fragility: fits against scipy's maximum, intervals against known truths, rates against a closed form."""

import math
import statistics
from dataclasses import replace

import numpy as np
import pandas
import pytest
from scipy.optimize import minimize
from scipy.stats import norm

import rocking
from rocking.assessment.ensemble import drawn
from rocking.assessment.settings import EnsembleSettings
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import ConfigurationError
from rocking.fragility import curves
from rocking.fragility.curves import Fragility, IncrementalDynamicAnalysis, fragility, fragility_of
from rocking.fragility.hazard import Hazard, rate_interval
from rocking.fragility.measures import INTENSITY_MEASURES
from rocking.motion import integrate
from rocking.motion.batch import integrate_batch
from rocking.products.fragility.rows import ida_rows
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block
from tests.refusals import refused

STEP, TIMES = 0.01, np.arange(0, 4, 0.01)
BLOCK = Block(2.0, 0.2, restitution=0.9)
LEVELS = np.geomspace(0.2, 5.0, 20)


def _record(period: float, station: str) -> Accelerogram:
    wave = np.sin(2 * np.pi * TIMES / period) * np.exp(-((TIMES - 1.5) ** 2))
    return Accelerogram(wave, STEP, component="made", event="made", station=station)


PEAK = int(_record(0.9, "").acceleration.argmax())
RECORDS = [_record(period, f"{k // 2}") for k, period in enumerate((0.6, 0.7, 0.9, 1.0, 1.3, 1.5))]


def _scattered(count: int) -> ClusterSample:
    return ClusterSample.scattered(list(map(str, range(count))))


def _counted(levels: list[float], shares: list[float], stations: int) -> Fragility:
    """The curve of records, one a station, of which the first `shares` overturn."""
    exceedance = np.arange(stations)[:, None] < stations * np.array(shares)
    return fragility_of(np.array(levels), exceedance.astype(float), _scattered(stations))


def test_the_fit_is_the_maximum_that_scipy_finds():
    rng = np.random.default_rng(3)
    for _ in range(4):
        over = (np.log(LEVELS / 0.9) / 0.45 > rng.standard_normal((12, LEVELS.size))).astype(float)

        def negative(free, over=over):
            eta = np.log(LEVELS / math.exp(free[0])) / math.exp(free[1])
            return -(over * norm.logcdf(eta) + (1 - over) * norm.logsf(eta)).sum()

        best = minimize(negative, (0.0, -1.0), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12})
        curve = fragility_of(LEVELS, over, _scattered(12))
        # The likelihood is flat to its rounding within the root of the machine precision of the best.
        assert curve.lognormal_median == pytest.approx(math.exp(best.x[0]), rel=1e-6)
        assert curve.dispersion == pytest.approx(math.exp(best.x[1]), rel=1e-6)


def _made(rng: np.random.Generator, stations: int, median: float = 1.0, dispersion: float = 0.5):
    """Thresholds of two components at each station, half of whose variance they share, as outcomes at LEVELS."""
    shared, own = rng.standard_normal((stations, 1)), rng.standard_normal((stations, 2))
    threshold = median * np.exp(dispersion * (shared + own) / 2**0.5)
    exceedance = (threshold.reshape(-1, 1) < LEVELS).astype(float)
    return exceedance, ClusterSample.scattered([str(k // 2) for k in range(2 * stations)])


@pytest.mark.parametrize(("trials", "scatter"), [(16, 0.12), pytest.param(60, 0.08, marks=pytest.mark.slow)])
def test_the_intervals_cover_a_known_curve(trials, scatter):
    rng = np.random.default_rng(5)
    truth = norm.cdf(np.log(LEVELS) / 0.5)
    middle = (truth > 0.02) & (truth < 0.98)
    covered, medians = [], []
    for _ in range(trials):
        curve = fragility_of(LEVELS, *_made(rng, 25))
        inside = (curve.probability_low <= truth) & (truth <= curve.probability_high)
        covered.append(inside[middle].mean())
        medians.append(curve.interval[0] <= 1.0 <= curve.interval[1])
    # 60 trials of a coverage of 0.9 scatter by 0.04, 16 by 0.075; three deviations of a single proportion are 0.12. It
    # may be more: where few stations fall, or nearly all, the bound is that of Clopper and Pearson, which is wide.
    assert np.mean(covered) >= 0.9 - scatter and np.mean(medians) >= 0.78


def test_a_curve_that_is_no_lognormal_has_the_median_of_the_rising_curve_beside_it():
    """Half fall at 0.5 and stand again up to 1.5: pooled over the levels of the dip, the curve is one half there."""
    levels, share = [0.25, 0.5, 1.0, 2.0, 4.0], [0.0, 0.8, 0.3, 0.9, 1.0]
    curve = _counted(levels, share, 20)
    # isotonic: 0, 0.55, 0.55, 0.9, 1; one half lies at 0.5/0.55 of the octave from 0.25 to 0.5
    assert curve.median == pytest.approx(0.25 * 2 ** (0.5 / 0.55), rel=1e-12)
    lognormal = norm.cdf(np.log(curve.levels / curve.lognormal_median) / curve.dispersion)
    assert curve.misfit == pytest.approx(np.abs(share - lognormal).max(), rel=1e-9)
    assert (curve.reversals > 0).sum() == 10


def test_a_record_overturns_at_a_level_where_more_than_half_of_its_members_do():
    shares = np.array([[0.6, 0.5, 0.6], [0.5, 0.4, 0.5], [0.6, 0.7, 0.4]])
    curve = fragility_of(np.array([1.0, 2.0, 3.0]), shares, ClusterSample.scattered("abc"))
    assert curve.reversals.tolist() == [1, 0, 1]


def test_outcomes_are_those_of_single_responses():
    curve = fragility(RECORDS, BLOCK, intensity_measure="pga", levels=[0.3, 0.6, 1.2])
    for row, record in zip(curve.exceedance, RECORDS, strict=True):
        for level, exceeds in zip(curve.levels, row, strict=True):
            scaled = record.scaled(level * 9.80665 / record.peak_acceleration)
            assert exceeds == math.isinf(integrate(BLOCK, scaled).rotation_ratio)


def test_levels_of_their_own_reach_from_rest_to_overturning():
    curve = rocking.fragility(RECORDS, BLOCK, intensity_measure="pgv", largest_factor=100.0)
    assert curve.levels.size == 40 and np.all(np.diff(curve.levels) > 0)
    assert curve.probability[0] == 0 and curve.probability[-1] == 1
    assert curve.levels[0] < curve.median < curve.levels[-1]
    # half of the levels at least lie where the share moves, of 18 or more that are spread evenly
    flat = (curve.probability == 0) | (curve.probability == 1)
    assert (~flat).sum() + 2 >= 20
    assert curve.interval[0] < curve.median < curve.interval[1]
    assert curve.sample.count == 3
    assert curve.plot().get_xlabel() == "pgv [m/s]"


def test_levels_lie_where_the_curve_rises_and_where_it_falls(monkeypatch):
    """All overturn from 0.3 to 0.6 m/s and above 1.2 m/s; the levels are closest about each of the three."""
    measure = INTENSITY_MEASURES["pgv"]

    def banded(structures, record, factors, **how):
        velocities = measure.of(record, structures[0]) * np.asarray(factors)
        return np.where((velocities > 0.3) & (velocities < 0.6) | (velocities > 1.2), math.inf, 0.1)[None]

    monkeypatch.setattr(curves, "integrate_batch", banded)
    levels = fragility(RECORDS, BLOCK).levels
    steps = np.diff(np.log(levels))
    for edge in (0.3, 0.6, 1.2):
        assert steps[np.searchsorted(levels, edge) - 1] < 0.5 * steps.max()


@pytest.mark.parametrize("ensemble", [None, EnsembleSettings()])
def test_a_case_without_an_answer_counts_as_one_that_falls_and_costs_no_other(ensemble, monkeypatch):
    levels = [0.2, 0.3]
    whole = fragility(RECORDS, BLOCK, levels=levels, ensemble=ensemble)
    assert not whole.exceedance.any()

    def failing_batch(structures, record, factors, **how):
        ratios = integrate_batch(structures, record, factors, **how)
        return np.where(record is RECORDS[2], np.nan, ratios)

    def failing_members(structure, motions, *more, **how):
        made = drawn(structure, motions, *more, **how)
        (motion,) = motions.horizontal.values()
        lost = np.isclose(motion.acceleration, motion.acceleration.max()).argmax() == PEAK
        ratios = np.where(lost & (np.arange(16) == 3), np.nan, made.rotation_ratios)
        return replace(made, rotation_ratios=ratios)

    monkeypatch.setattr(curves, "integrate_batch", failing_batch)
    monkeypatch.setattr(curves, "drawn", failing_members)
    curve = fragility(RECORDS, BLOCK, levels=levels, ensemble=ensemble)
    assert curve.exceedance[2].tolist() == [1.0 if ensemble is None else 1 / 16] * 2
    assert not np.delete(curve.exceedance, 2, axis=0).any()


def test_members_make_shares_of_the_outcomes():
    levels = np.geomspace(0.2, 2, 12)
    plain = fragility(RECORDS, BLOCK, levels=levels)
    settings = EnsembleSettings(amplitude_range=0.0, restitution_range=0.0)
    fixed = fragility(RECORDS, BLOCK, levels=levels, ensemble=settings)
    assert np.array_equal(fixed.exceedance, plain.exceedance, equal_nan=True)
    spread = fragility(RECORDS, BLOCK, levels=levels, ensemble=EnsembleSettings(amplitude_range=0.3))
    assert ((spread.exceedance > 0) & (spread.exceedance < 1)).any()


@pytest.mark.parametrize("intensity_measure", ["arias", "SA(0.5)", "FIV3(0.7)"])
def test_a_record_is_scaled_to_a_level_of_any_measure(intensity_measure):
    """At every level the record, multiplied by its factor, has that level, also where it grows with the square."""
    curve = fragility(RECORDS, BLOCK, intensity_measure=intensity_measure)
    analysis = curve.analysis
    for place in (0, 20, 39):
        record = RECORDS[1].scaled(analysis.factors[1, place])
        level = analysis.measure.of(record, BLOCK.mechanism())
        assert level == pytest.approx(curve.levels[place], rel=1e-9)
    rows = list(ida_rows("block", [str(place) for place, _ in enumerate(RECORDS)], analysis))
    assert max(row.scale_factor for row in rows) <= 10 * (1 + 1e-9)


@pytest.mark.parametrize("members", [1, 2, 3, 4])
def test_a_row_of_the_analysis_tells_the_lower_median_of_its_members(members):
    ratios = np.array([0.4, 0.1, math.inf, 0.2])[None, None, :members]
    measure = INTENSITY_MEASURES["pgv"]
    analysis = IncrementalDynamicAnalysis(
        measure, np.ones(1), ratios, np.full(1, 0.5), ClusterSample.scattered(["one"])
    )
    (row,) = ida_rows("block", ["record"], analysis)
    assert row.rotation_ratio_median == statistics.median_low(ratios[0, 0])
    assert (row.members, row.scale_factor) == (members, 2.0)


def test_a_cloud_keeps_the_records_as_they_are():
    records = [record.scaled(factor) for factor, record in zip(np.linspace(2, 12, 6), RECORDS, strict=True)]
    curve = fragility(records, BLOCK, method="cloud", intensity_measure="pga")
    assert sorted(curve.levels) == pytest.approx(sorted(r.peak_acceleration / 9.80665 for r in records))
    falls = {r.peak_acceleration: math.isinf(integrate(BLOCK, r).rotation_ratio) for r in records}
    assert np.nansum(curve.exceedance) == sum(falls.values())
    assert curve.probability.tolist() == [float(falls[peak]) for peak in sorted(falls)]


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"levels": [0.5, 0.3]}, ("levels", 0.3)),
        ({"levels": [0.5]}, ("levels",)),
        ({"levels": [0.5, math.nan]}, ("levels",)),
        ({"stations": ["one"] * 6}, ("records", 1)),
        ({"stations": ["one", "two"]}, ("stations", 2)),
        ({"events": ["one", "two"]}, ("events", 2)),
        ({"intensity_measure": "mmi"}, ("intensity_measure", "mmi")),
        ({"intensity_measure": "SA"}, ("intensity_measure", "SA")),
        ({"method": "cloud", "levels": [0.1, 0.2]}, ("levels", "given")),
    ],
)
def test_bad_input_is_one_sentence(changed, named):
    with refused(ConfigurationError, *named):
        fragility(RECORDS, BLOCK, **changed)


def test_two_levels_are_enough():
    assert fragility(RECORDS, BLOCK, levels=[0.2, 0.3]).levels.tolist() == [0.2, 0.3]


def test_a_record_without_the_measure_is_named():
    still = Accelerogram(np.zeros(400), STEP, station="still")
    with refused(ConfigurationError, "pgv", 0.0):
        fragility([*RECORDS, still], BLOCK)


@pytest.mark.parametrize(
    ("share", "median"),
    [
        ([0.2, 0.4, 0.6, 0.8], 2**1.5),
        ([0.2, 0.5, 0.5, 0.8], 2**1.5),
        ([0.1, 0.3, 0.7, 0.9], 2**1.5),
        ([0.6, 0.7, 0.8, 0.9], 1.0),
        ([0.0, 0.2, 0.45, 0.45], math.inf),
        ([0.0, 0.2, 0.5, 0.5], math.inf),
    ],
)
def test_the_median_is_linear_in_the_logarithm_of_levels_and_the_middle_of_a_flat_half(share, median):
    curve = _counted([1.0, 2.0, 4.0, 8.0], share, 20)
    assert curve.median == pytest.approx(median, rel=1e-12)
    assert math.isinf(curve.interval[1]) == math.isinf(median) and curve.interval[0] >= 1.0


def _points(levels, rates) -> Hazard:
    return Hazard(np.asarray(levels), np.asarray(rates))


def test_the_rate_is_that_of_the_closed_form():
    """ν = k₀ x⁻ᵏ and a lognormal of median m and dispersion β: rate = k₀ m⁻ᵏ exp(k²β²/2) (Cornell 1996)."""
    slope, scale, median, dispersion = 2.5, 1e-3, 1.2, 0.4
    levels = np.geomspace(0.02, 50.0, 400)
    thresholds = median * np.exp(dispersion * norm.ppf((np.arange(300) + 0.5) / 300))
    curve = fragility_of(levels, (thresholds[:, None] < levels).astype(float), _scattered(300))
    rates = curve.annual_rate(_points(levels[[0, -1]], scale * levels[[0, -1]] ** -slope))
    exact = scale * median**-slope * math.exp(slope**2 * dispersion**2 / 2)
    # Steps of 2 % in the level, half a step of lag in a curve that is counted: 2.5 x 1 % of the rate.
    assert rates.value == pytest.approx(exact, rel=0.03)
    assert rates.low < rates.value < rates.high


@pytest.mark.parametrize("slope", [1.5, 2.5, 3.5])
@pytest.mark.parametrize("count", [8, 20, 35])
def test_the_interval_of_a_rate_holds_the_truth_of_a_made_population(slope, count):
    """Levels that overturn are lognormal, so that the mean of their rates is known. Of 400 intervals 90 % are asked,
    and the 99.9 % quantiles of the binomial lie 4.9 % beside that."""
    dispersion = 0.35
    truth = math.exp((slope * dispersion) ** 2 / 2)
    draws = np.exp(slope * dispersion * np.random.default_rng(count).standard_normal((400, count)))
    ends = [rate_interval(draw, _scattered(draw.size)) for draw in draws]
    assert 0.85 <= np.mean([low <= truth <= high for low, high in ends]) <= 0.95


def test_the_interval_of_a_rate_holds_the_truth_where_rates_are_no_lognormal():
    """Rates that are a power of Weibull's have a gamma function as their mean. Of 400 intervals 90 % are asked, and the
    0.1 % quantile of the binomial lies 4.9 % below; the method for lognormals alone holds it in 81 %."""
    draws = np.random.default_rng(7).weibull(2.5, (400, 35)) ** 3.5
    truth = math.gamma(1 + 3.5 / 2.5)
    ends = [rate_interval(draw, _scattered(draw.size)) for draw in draws]
    assert np.mean([low <= truth <= high for low, high in ends]) >= 0.85


def test_no_record_is_scaled_beyond_the_largest_factor_and_the_weak_are_counted_out():
    weak, *strong = (_record(0.9, "").scaled(value) for value in (0.02, 2.0, 3.0))
    curve = fragility([weak, *strong], BLOCK, stations=list("abc"), intensity_measure="pga")
    factors = curve.levels / curve.analysis.intensities[:, None]
    assert np.nanmax(np.where(np.isfinite(curve.exceedance), factors, np.nan)) <= 10 * (1 + 1e-9)
    assert np.isnan(curve.exceedance[0]).all(), "a record that would need a factor of 100 says nothing"
    assert np.isfinite(curve.probability).all() and np.isfinite(curve.median)
    rows = list(ida_rows("pier", list("abc"), curve.analysis))
    assert {row.record for row in rows} == {"b", "c"} and max(row.scale_factor for row in rows) <= 10 * (
        1 + 1e-9
    )
    with refused(ConfigurationError, "levels", 1000.0):
        fragility([weak, *strong], BLOCK, stations=list("abc"), levels=[1e3, 1e4])


def test_what_curve_and_hazard_leave_out_is_said():
    """One half of a rate that occurs at and above the level where a curve ends at one half; all below the hazard."""
    curve = _counted([1.0, 2.0], [0.0, 0.5], 200)
    points = _points([0.5, 8.0], [0.16, 0.01])  # rate 0.08/x
    rates = curve.annual_rate(points)
    # above 2.0 there occurs 0.04 a year, of which the curve counts a half; the steps of the integral are 0.7 %
    assert rates.remainder == pytest.approx(0.02, rel=0.02)
    # the same where the hazard curve ends at the last level: all that is rarer occurs beyond it
    ended = curve.annual_rate(_points([0.5, 2.0], [0.16, 0.04]))
    assert ended.remainder == pytest.approx(0.02, rel=1e-9)
    falling = fragility_of(np.array([0.1, 0.2]), np.ones((4, 2)), ClusterSample.scattered("abcd"))
    # between 0.1 and 0.5, which the hazard curve does not reach, there occurs 0.8 − 0.16
    assert falling.annual_rate(points).remainder == pytest.approx(0.64, rel=0.02)


def test_a_level_at_the_largest_factor_itself_is_reached():
    """Quotients are rounded: a record that needs the largest factor but for rounding does not leave the level."""
    records = [_record(period, str(k)) for k, period in enumerate((0.7, 0.9, 1.3))]
    scaled = [record.scaled(0.1 * GRAVITY / record.peak_acceleration) for record in records]
    levels = 0.1 * 7 * np.array([0.5, 1 + 5e-10, 1 + 1e-6])
    curve = fragility(scaled, BLOCK, intensity_measure="pga", levels=levels, largest_factor=7.0)
    assert curve.levels.tolist() == levels[:2].tolist()
    assert not np.isnan(curve.analysis.rotation_ratios).any()


def test_stations_that_say_the_same_have_an_interval_of_one_number():
    """The shares of 20 stations add up to more than 1 by rounding, which once left the root of a number below 0."""
    assert rate_interval(np.full(20, 0.01), _scattered(20)) == pytest.approx((0.01, 0.01))


def test_a_frame_of_a_curve_is_its_csv(tmp_path):
    curve = fragility(RECORDS, BLOCK, levels=LEVELS)
    curve.to_csv(tmp_path / "curve.csv")
    read_again = pandas.read_csv(tmp_path / "curve.csv", keep_default_na=True)
    pandas.testing.assert_frame_equal(read_again, curve.frame(), check_dtype=False)
    assert curve.frame().probability.tolist() == curve.probability.tolist()


def test_levels_out_of_reach_and_too_far_apart_are_said():
    curve = fragility(RECORDS, BLOCK, levels=LEVELS)
    assert curve.unreached == tuple(LEVELS[len(curve.levels) :]) != ()
    assert f"no two stations reach {curve.unreached[0]:g}, " in repr(curve)
    assert not fragility(RECORDS, BLOCK, levels=curve.levels).unreached
    names = [f"{place}" for place, _ in enumerate(RECORDS)]
    slender = Block(2.0, 0.1, restitution=0.9)
    own = {"stations": names, "events": names, "largest_factor": 100.0}
    near = fragility(RECORDS, slender, levels=np.geomspace(0.05, 20, 25), **own)
    assert near.gap is None and "too far apart" not in repr(near)
    far = fragility(RECORDS, slender, levels=[0.1, 5.0], **own)
    assert far.gap == (0.1, 5.0) and "too far apart for an interval" in repr(far)
    assert 0.1 < near.interval[0] < near.interval[1] < 5.0  # which the two levels would hide


def test_a_level_itself_is_reached_by_the_records_that_were_tried_at_it():
    """Of three stations one was tried at the last of three levels, and two at the second, both ends of rounding."""
    exceedance = np.array([[0.0, 1.0, 1.0], [0.0, 0.0, np.nan], [0.0, np.nan, np.nan]])
    curve = fragility_of(np.array([0.1, 0.3, 0.9]), exceedance, _scattered(3))
    assert [curve.reaching(level) for level in (0.1, 3 * 0.1, 0.3, 0.31, 0.9, 1.0)] == [3, 2, 2, 1, 1, 0]
