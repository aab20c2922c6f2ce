"""The reserve: held against a scan of every level by single integrations, and what it owes whatever the motion."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import isotonic_regression

import rocking
from rocking.assessment import reserve
from rocking.assessment.assessor import Assessor
from rocking.assessment.case import PeriodResult
from rocking.assessment.ensemble import CAUSES, lattice
from rocking.assessment.motions import GroundMotions
from rocking.assessment.reserve import Reserve, Stage, _worth_following, reserve_of_members, rising_curve
from rocking.assessment.scene import Scene
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.assessment.store import RecordStore
from rocking.errors import ConfigurationError
from rocking.floors.place import place_from_config
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, Outcome
from tests.refusals import refused

STEP = 0.01
TIMES = np.arange(0, 20, STEP)
BLOCK = Block(2.0, 0.2, restitution=0.9)


def _record(amplitude: float, seed: int = 0) -> Accelerogram:
    """Filtered noise of 20 s that grows and fades."""
    noise = np.fft.rfft(np.random.default_rng(seed).standard_normal(TIMES.size))
    frequencies = np.fft.rfftfreq(TIMES.size, STEP)
    shaped = np.fft.irfft(noise * frequencies**0.5 / (1 + (frequencies / 1.2) ** 2), TIMES.size)
    wave = shaped * (TIMES / 4) ** 2 * np.exp(-TIMES / 2)
    return Accelerogram(amplitude * wave / np.abs(wave).max(), STEP)


def _rising(shares: list[float]) -> list[float]:
    """The rising curve nearest to the shares: whatever falls is pooled with what comes before it."""
    pools: list[list[float]] = []
    for share in shares:
        pools.append([share])
        while len(pools) > 1 and np.mean(pools[-2]) > np.mean(pools[-1]):
            pools[-2:] = [pools[-2] + pools[-1]]
    return [float(np.mean(pool)) for pool in pools for _ in pool]


def _scanned(block: Block, record: Accelerogram, settings: EnsembleSettings) -> list[float]:
    """The factors by following every member through every level, one member after the other."""
    first, second = lattice(128)[:, 0], lattice(128)[:, 1]
    amplitudes = 1 + settings.amplitude_range * (2 * first - 1)
    offsets = settings.restitution_range * (2 * second - 1)
    lowest = np.tan(block.slenderness) * 9.80665 / record.peak_acceleration / amplitudes.max()
    levels = lowest * 1.06 ** np.arange(math.ceil(math.log(settings.reserve / lowest, 1.06)))
    falls = [
        np.isinf(
            rocking.integrate_batch(
                [replace(block, restitution=0.9 + offset)], record, (levels * amplitude).tolist()
            )[0]
        )
        for amplitude, offset in zip(amplitudes, offsets, strict=True)
    ]
    curve = _rising(np.mean(falls, axis=0).tolist())
    return [float(np.exp(np.interp(share, curve, np.log(levels)))) for share in (0.05, 0.5, 0.95)]


RECORDS = {
    "one": lambda: _record(3.0, 0),
    "another": lambda: _record(3.0, 1),
    "real": lambda: rocking.read("records/20161113_110259_WTMC_20.V2A")[0],
}


@pytest.mark.parametrize(
    "name", ["one", *(pytest.param(name, marks=pytest.mark.slow) for name in ("another", "real"))]
)
@pytest.mark.process
def test_it_is_what_a_scan_of_every_member_at_every_level_gives(name):
    """The scan follows 128 members at every level; the reserve, few.

    Single samples of either scatter by some 4 % at the low factor and by more at the high one, where a structure stands
    again between levels: the mean of eight is compared, which leaves the scatter of one scan, 10 % in nine of ten.
    """
    settings = EnsembleSettings(reserve=6.0)
    shifts = np.random.default_rng(1).random((8, len(CAUSES)))
    record = RECORDS[name]()
    motions = GroundMotions.of(record)
    samples = [reserve_of_members(BLOCK.mechanism(), motions, settings, shift=shift) for shift in shifts]
    mean = np.exp(np.mean(np.log([(sample.low, sample.median, sample.high) for sample in samples]), axis=0))
    ratios = mean / np.array(_scanned(BLOCK, record, settings))
    assert np.abs(np.log(ratios)) == pytest.approx(0.0, abs=np.log(1.1))


def test_where_one_amplitude_divides_falls_from_the_rest_it_is_that_of_the_uniform_distribution():
    """Under half a sine a block with one restitution overturns from one amplitude A on. Members have 1 ± r times the
    motion, so that a share s of them overturns at the factor A/(1 + r (1 − 2 s))."""
    pulse = 4.0 * np.sin(np.pi * TIMES / 0.6) * (TIMES < 0.6)
    record = Accelerogram(pulse, STEP)
    factors = np.linspace(0.5, 3.0, 2501)
    falls = np.isinf(rocking.integrate_batch([BLOCK], record, factors.tolist())[0])
    assert np.all(np.diff(falls.astype(int)) >= 0) and 0 < falls.sum() < falls.size
    limit_amplitude = factors[falls.argmax()]
    for spread in (0.1, 0.3):
        settings = EnsembleSettings(amplitude_range=spread, restitution_range=0.0, reserve=6.0)
        own = reserve_of_members(BLOCK.mechanism(), GroundMotions.of(record), settings)
        expected = [limit_amplitude / (1 + spread * (1 - 2 * share)) for share in (0.05, 0.5, 0.95)]
        assert [own.low, own.median, own.high] == pytest.approx(expected, rel=0.01)


def test_a_stronger_record_has_as_much_less():
    once, twice = (
        reserve_of_members(
            BLOCK.mechanism(), GroundMotions.of(_record(value)), EnsembleSettings(reserve=10.0 * 3 / value)
        )
        for value in (3.0, 6.0)
    )
    assert (once.low, once.median) == pytest.approx((2 * twice.low, 2 * twice.median), rel=0.02)
    assert once.low < once.median < once.high


def test_up_to_the_limit_and_no_farther():
    motions = GroundMotions.of(_record(0.5))
    found = reserve_of_members(BLOCK.mechanism(), motions, EnsembleSettings(reserve=1.0))
    assert math.isnan(found.low) and math.isnan(found.median) and found.limit == 1.0
    assert str(found) == "fewer than 5 % of members fall up to 1 × this record"
    farther = reserve_of_members(BLOCK.mechanism(), motions, EnsembleSettings(reserve=30.0))
    assert 1.0 < farther.low < farther.median <= 30.0
    assert str(Reserve(low=0.8, median=math.nan, high=math.nan, limit=3.0)).endswith(
        "fewer than half up to 3 × this record"
    )


def test_still_ground_has_none():
    still = Accelerogram(np.zeros(500), STEP)
    assert math.isnan(reserve_of_members(BLOCK.mechanism(), GroundMotions.of(still)).low)


def test_a_setting_turns_it_off_and_a_result_has_it():
    record = _record(3.0)
    assert isinstance(rocking.assess(record, BLOCK).reserve, Reserve)
    off = AssessmentSettings(ensemble=EnsembleSettings(reserve=0.0))
    assert rocking.assess(record, BLOCK, settings=off).reserve is None
    with refused(ConfigurationError, "reserve", -1.0):
        EnsembleSettings(reserve=-1.0)


def test_on_a_support_it_is_sought_on_the_ground_and_at_the_worst_period_alone(tmp_path, monkeypatch):
    """There it is that of a structure whose list has this period and no other, and a store gives it back."""
    record = _record(1.5, 1)
    body = Block(0.6, 0.25)
    settings = AssessmentSettings(ensemble=EnsembleSettings(members=16, reserve=30.0))

    def assessed(
        period: float | list[float], store: RecordStore | None = None
    ) -> dict[float | None, PeriodResult]:
        roof = place_from_config({"name": "roof", "period_s": period, "participation": 1.3})
        scenes = {"parapet": Scene("parapet", body, roof)}
        result = Assessor(settings, store=store).assess("made", [record], scenes)
        return {one_period.support_period_s: one_period for one_period in result.periods}

    store = RecordStore(tmp_path / "cases")
    stations = assessed([0.15, 0.6], store)
    store.save()
    worst = max((period for period in stations if period), key=lambda period: stations[period].severity)
    sought = {period: station.reserve for period, station in stations.items() if station.reserve is not None}
    assert set(sought) == {0.0, worst}
    alone = assessed(worst)
    assert {period: part.reserve for period, part in alone.items()} == sought

    monkeypatch.setattr("rocking.assessment.one_case.reserve", None)
    again = assessed([0.15, 0.6], RecordStore(tmp_path / "cases"))
    assert {period: item.reserve for period, item in again.items() if item.reserve is not None} == sought


def test_what_falls_as_soon_as_it_lifts_has_the_factors_at_which_it_lifts():
    """Under an acceleration that stays it never comes back: the least factor is that of the largest amplitude."""
    logs = np.linspace(0.0, 1.0, 50)
    all_fall = reserve._crossings(logs, np.ones(50), -1.0, 0.05, logs[10:])
    assert all_fall == pytest.approx([math.exp(logs[10])] * 3)
    record = Accelerogram(np.where(TIMES < 19.5, 1.0, 0.0), STEP)
    lifts = np.tan(BLOCK.slenderness) * 9.80665
    for spread in (0.05, 0.2):
        settings = EnsembleSettings(amplitude_range=spread, reserve=6.0)
        own = reserve_of_members(BLOCK.mechanism(), GroundMotions.of(record), settings)
        expected = [lifts / (1 + spread * (1 - 2 * share)) for share in (0.05, 0.5, 0.95)]
        assert [own.low, own.median, own.high] == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("count", [1, 2, 7, 200])
def test_the_rising_curve_is_the_isotonic_regression_of_scipy(count):
    generator = np.random.default_rng(count)
    values = np.round(generator.normal(size=count) + np.linspace(0, 2, count), 1)  # with some that are equal
    weights = generator.integers(1, 9, count)
    expected = isotonic_regression(values, weights=weights).x
    assert rising_curve(values, weights) == pytest.approx(expected, rel=1e-12, abs=1e-12)


def test_rungs_are_followed_about_what_falls_below_the_median_or_stands_above_it():
    """Of a ladder on which all fall from a factor of 2 on, but one rung far below it falls and one far above stands."""
    logs = np.log(0.5) + np.arange(2500) / 1024
    falls = (logs >= np.log(2.0)).astype(float)
    below, above = (int(np.searchsorted(logs, np.log(factor))) for factor in (1.2, 3.5))
    falls[below] = 1.0
    falls[above] = 0.0
    followed = np.zeros(falls.size, dtype=bool)
    followed[::16] = followed[[below, above]] = True
    around = 0.1
    found = np.where(followed, falls, np.nan)
    wanted = _worth_following(Stage(1, 0.0, around, shares=()), logs, found, [1.9, 2.0, 2.1], 0.05)
    distance = np.abs(logs[:, None] - logs[[below, above]]).min(axis=1)
    assert wanted.tolist() == (distance < around).tolist()


@pytest.mark.parametrize(
    ("low", "median", "figures"),
    [
        (0.4, math.nan, "0.40–3+"),
        (0.284, 0.542, "0.28–0.54"),
        (math.nan, math.nan, "3+"),
        (11.6, 12.2, "12"),
    ],
)
def test_the_reserve_in_figures(low, median, figures):
    assert Reserve(low=low, median=median, high=math.nan, limit=3.0).in_figures == figures


def test_at_the_reserve_so_many_members_of_the_ensemble_overturn():
    record = _record(3.0, 2)
    found = reserve_of_members(BLOCK.mechanism(), GroundMotions.of(record), EnsembleSettings(reserve=20.0))
    low = rocking.assess(record.scaled(0.8 * found.low), BLOCK).overturning_share
    median = rocking.assess(record.scaled(found.median), BLOCK).overturning_share
    high = rocking.assess(record.scaled(1.3 * found.high), BLOCK).overturning_share
    assert low <= 0.1 and 0.2 <= median <= 0.8 and high >= 0.9


@pytest.mark.parametrize("unloading", [0.0, 0.5, 1.2])
def test_the_reserve_begins_where_the_motion_lifts_also_with_a_vertical_one(unloading: float) -> None:
    """Both are scaled: at 3 times 0.5 g nothing presses, while 0.1 g alone lifts the block at 2.03 times only."""
    horizontal, vertical = _record(0.1 * GRAVITY), _record(1.0, seed=1)
    vertical = vertical.scaled(-unloading * GRAVITY / vertical.acceleration.min()) if unloading else None
    motions = GroundMotions.of(horizontal, vertical=vertical)
    multiplier = BLOCK.mechanism().uplift_multiplier
    lift = motions.lift_at(multiplier)
    assert lift == pytest.approx(multiplier / (0.1 + multiplier * unloading))
    assert motions.scaled(0.999 * lift).excitation < multiplier < motions.scaled(1.001 * lift).excitation
    found = reserve_of_members(BLOCK.mechanism(), motions, EnsembleSettings(reserve=8.0))
    levels = [factor for factor in lift * 1.03 ** np.arange(60) if factor < 8]
    falls = [
        rocking.integrate(
            BLOCK, horizontal.scaled(factor), vertical=vertical and vertical.scaled(factor)
        ).outcome
        is Outcome.OVERTURNS
        for factor in levels
    ]
    assert lift / 1.05 <= found.low <= 1.02 * levels[falls.index(True)]
