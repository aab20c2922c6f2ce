"""Intensity measures against pyrotd, a filter and windows written out, and closed forms."""

import math
import sys
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module, metadata
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

import rocking
from rocking.catalogue import load_catalogue, open_station
from rocking.errors import ConfigurationError
from rocking.fragility.measures import (
    CORNER,
    INTENSITY_MEASURES,
    SPELLINGS,
    compared,
    intensity_measure,
    per_velocity,
)
from rocking.products.fragility.rows import stations_for
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, EquivalentBlock
from tests.oracles.incremental_velocity import fiv3
from tests.refusals import refused

ROOT = Path(__file__).parents[3]
BLOCK = Block.of_size(0.6, 3.0)
MECHANISM = BLOCK.mechanism()
STEP = 0.01
TIMES = np.arange(0, 12, STEP)
NAMED = [spelling.replace("T1,T2", "0.2,2.0").replace("(T)", "(0.5)") for spelling in SPELLINGS]


@pytest.fixture(scope="module")
def records(real_records) -> list[Accelerogram]:
    """Ten stations of FEMA P-695, one component each, followed by zeros: pyrotd wraps the end round to the start."""
    chosen = load_catalogue(ROOT / "records" / "fema_p695.csv")[:20:2]
    read = [open_station(name, real_records).horizontal[0] for name in chosen]
    return [
        Accelerogram(np.append(channel.acceleration, np.zeros(6000)), channel.time_step) for channel in read
    ]


@pytest.fixture(scope="module")
def pyrotd() -> Iterator[ModuleType]:
    """pyrotd 0.6.1, which asks pkg_resources for its own version at import; setuptools no longer has that module."""
    version = SimpleNamespace(get_distribution=lambda name: SimpleNamespace(version=metadata.version(name)))
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "pkg_resources", version)
        yield import_module("pyrotd")


def _by_pyrotd(pyrotd: ModuleType, record: Accelerogram, periods: np.ndarray) -> np.ndarray:
    accelerations = record.acceleration / GRAVITY
    return pyrotd.calc_spec_accels(record.time_step, accelerations, 1 / periods, 0.05).spec_accel


@pytest.mark.real_records
@pytest.mark.parametrize(
    ("name", "periods"),
    [
        ("SA(0.5)", np.array([0.5])),
        ("SA(2)", np.array([2.0])),
        ("Sa_avg2(1.0)", np.linspace(0.2, 2.0, 10)),
        ("Sa_avg3(1.0)", np.linspace(0.2, 3.0, 10)),
        ("AvgSA(0.3,2.4)", np.geomspace(0.3, 2.4, 20)),
    ],
)
def test_spectral_measures_are_those_of_pyrotd(records, pyrotd, name, periods):
    # pyrotd takes the largest of a response interpolated to a finer step, ours that of 20 steps a period at least: a
    # peak between two of them is missed by up to 1.2 %.
    for record in records:
        expected = np.exp(np.log(_by_pyrotd(pyrotd, record, periods)).mean())
        assert intensity_measure(name).of(record, MECHANISM) == pytest.approx(expected, rel=1.2e-2)


@pytest.mark.real_records
@pytest.mark.parametrize("period", [0.2, 0.7, 2.0])
def test_the_filtered_incremental_velocity_is_that_of_the_oracle(records, period):
    for record in records[:4]:
        found = intensity_measure(f"FIV3({period})").of(record, MECHANISM)
        expected = fiv3(record.acceleration.tolist(), record.time_step, period, 0.7, CORNER)
        # both are sums of some thousand products in another order
        assert found == pytest.approx(expected, rel=1e-9)


def test_of_slow_shaking_the_filtered_incremental_velocity_is_three_times_that_of_half_a_cycle():
    """A sine that is 20 times as long as T passes the filter; over 0.7 T it gains a·0.7 T sinc(0.7 T/τ) at a peak."""
    period, slow = 0.5, 10.0
    times = np.arange(0, 60, STEP)
    record = Accelerogram(np.sin(2 * np.pi * times / slow), STEP)
    gained = 0.7 * period * np.sinc(0.7 * period / slow)
    # The low-pass of second order lets |H| = (1 + (T/(βτ))⁴)^−½ through, 1 − 6e-6 here; peaks lie within half a step.
    assert intensity_measure(f"FIV3({period})").of(record, MECHANISM) == pytest.approx(3 * gained, rel=1e-4)


@pytest.mark.parametrize("name", NAMED)
def test_a_measure_grows_with_the_motion_to_its_power(name):
    record = Accelerogram(np.sin(2 * np.pi * TIMES / 0.9) * np.exp(-((TIMES - 3) ** 2)), STEP)
    measure = intensity_measure(name, MECHANISM)
    once, twice = (measure.of(record.scaled(factor), MECHANISM) for factor in (1.0, 2.0))
    assert twice == pytest.approx(2**measure.power * once, rel=1e-9)


def test_measures_of_a_sine_by_their_definitions():
    """Of a sin over n cycles of T: ∫|a| dt = 2 a n T/π and π/(2g) ∫a² dt = π a² n T/(4g)."""
    amplitude, period, cycles = 2.0, 1.0, 5
    times = np.arange(round(cycles * period / STEP) + 1) * STEP
    record = Accelerogram(amplitude * np.sin(2 * np.pi * times / period), STEP)
    # the trapezoidal rule of |sin| misses (2π dt/T)²/12 of each half cycle
    cav = 2 * amplitude * cycles * period / math.pi
    assert INTENSITY_MEASURES["cav"].of(record, MECHANISM) == pytest.approx(cav, rel=4e-4)
    arias = math.pi * amplitude**2 * cycles * period / (4 * GRAVITY)
    assert INTENSITY_MEASURES["arias"].of(record, MECHANISM) == pytest.approx(arias, rel=1e-9)


@pytest.mark.parametrize(
    ("theirs", "ours", "scale"),
    [
        ("PGV", "pgv", 100),
        ("PGA", "pga", 1),
        ("IA", "arias", 1),
        ("CAV", "cav", 1 / 9.80665),
        ("FIV3(0.7)", "FIV3(0.7)", 100),
        ("SA(1)", "SA(1.0)", 1),
        ("Sa_avg2(0.5)", "Sa_avg2(0.5)", 1),
    ],
)
def test_the_names_and_units_of_openquake(theirs, ours, scale):
    """Units of the docstrings of openquake.hazardlib.imt: cm/s, g, m/s, g s."""
    measure = rocking.intensity_measure(theirs)
    assert measure.name == ours and measure.openquake_scale == pytest.approx(scale, rel=1e-12)
    assert measure.openquake == theirs.replace("(1)", "(1.0)")


def test_periods_follow_from_the_structure_alone():
    """0.18 to 1.30 times 2π/p of the block exact at rest, where p² = 3g/(4R)."""
    period = 2 * math.pi / math.sqrt(3 * GRAVITY / (4 * math.hypot(0.3, 1.5)))
    first, last = (float(f"{share * period:.3g}") for share in (0.18, 1.30))
    # p is that of the linear block on the arc of the block: α by sin α, 0.3 % here
    found = intensity_measure("AvgSA", BLOCK).periods
    assert found == pytest.approx((first, last), rel=5e-3)
    one_swing = (
        Block.of_size(0.6, 6.0, one_sided=True, restitution=0.9),
        Block.of_size(0.75, 3.0, restitution=0.79),
    )
    for structure in one_swing:
        assert {intensity_measure(choice, structure).name for choice in ("AvgSA", "FIV3")} == {"pgv"}
    assert intensity_measure("AvgSA", Block.of_size(1.2, 3.0, restitution=0.5)).name.startswith("AvgSA(")
    assert [row.name for row in compared(MECHANISM)][: len(INTENSITY_MEASURES)] == list(INTENSITY_MEASURES)


@pytest.mark.parametrize(
    "name",
    ["mmi", "pga(1)", "SA", "AvgSA", "SA(-1)", "SA(nan)", "AvgSA(2,1)", "FIV3(fast)"],
)
def test_a_name_that_is_none_is_refused(name):
    with refused(ConfigurationError, "intensity_measure", name):
        rocking.intensity_measure(name)


@pytest.mark.parametrize(
    ("name", "measure"),
    [("SA(6.0)", "SA(6.0)"), ("AvgSA(0.01,2)", "AvgSA(0.01,2.0)"), ("FIV3(7)", "FIV3(7.0)")],
)
def test_a_period_beyond_the_band_of_a_record_is_refused(name, measure):
    record = Accelerogram(np.sin(TIMES), STEP, station="LCN", high_pass_frequency=0.16)
    with refused(ConfigurationError, measure):
        rocking.intensity_measure(name).of(record, MECHANISM)


def test_of_a_record_that_is_still_or_short_there_is_no_measure():
    still = Accelerogram(np.zeros(200), STEP, station="LCN")
    with refused(ConfigurationError, "AvgSA(0.2,2.0)", 0.0):
        rocking.intensity_measure("AvgSA(0.2,2)").of(still, MECHANISM)
    with refused(ConfigurationError, "FIV3(3.0)"):
        rocking.intensity_measure("FIV3(3)").of(still, MECHANISM)


def test_the_stations_that_a_median_needs_are_enough():
    """Sample medians of as many lognormal levels lie within a factor of 1.2 in nine of ten; counted, 20 000 of them."""
    count = stations_for(0.4)
    medians = np.median(np.random.default_rng(0).normal(0, 0.4, (20_000, count)), axis=1)
    # The law of the median is that of many; of 21 stations it is met to 1 %, and counting errs by 0.4 %.
    assert np.mean(np.abs(medians) <= math.log(1.2)) == pytest.approx(0.9, abs=0.015)
    assert stations_for(math.nan) is None


def test_the_velocity_counts_against_the_side_that_lifts_first():
    """Of unlike sides the weaker one: p PGV/(gλ) with the smaller λ, in whatever order they stand."""
    strong = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=0.5, restitution=0.9
    )
    weak = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.1, acceleration_scale=0.5, restitution=0.9
    )
    assert (strong.uplift_multiplier, weak.uplift_multiplier) == (0.4, 0.2)
    for block in (replace(strong, other_side=weak), replace(weak, other_side=strong)):
        assert per_velocity(block) == pytest.approx(2.0 / (9.80665 * 0.2), rel=1e-12)
