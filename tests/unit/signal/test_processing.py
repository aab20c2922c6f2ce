"""Processing: each step against its own mathematics, recorded, off by default for processed records."""

import re

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicHermiteSpline
from scipy.signal import butter, sosfiltfilt

import rocking
from rocking.errors import RecordError
from rocking.records import Accelerogram
from rocking.signal import processing as steps
from rocking.signal.processing import Processing, adaptive_baseline, displacement, process, velocity
from tests.refusals import refused
from tests.synthetic import SHIPPED, synthetic_record

DT = 0.01


def record(values: np.ndarray, **fields) -> Accelerogram:
    return Accelerogram(values, DT, **fields)


def sine(frequency: float, seconds: float = 40.0) -> np.ndarray:
    return np.sin(2 * np.pi * frequency * np.arange(0, seconds, DT))


def test_nothing_is_done_to_a_processed_record_unless_asked() -> None:
    raw, done = record(0.5 + sine(1.0)), record(0.5 + sine(1.0), processed=True)
    assert process(done) is done
    treated = process(raw)
    assert len(treated.processing) == 3 and abs(treated.acceleration.mean()) < 0.01
    assert np.array_equal(process(done, steps.UNPROCESSED_DEFAULT).acceleration, treated.acceleration)
    assert process(raw, Processing()) is raw


def test_pre_event_mean() -> None:
    values = np.concatenate([np.full(200, 0.3), 0.3 + sine(1.0)])
    treated = process(record(values), Processing(pre_event=2.0))
    assert np.abs(treated.acceleration[:200]).max() < 1e-15
    assert "0.3 m/s²" in treated.processing[0] and "first 2 s" in treated.processing[0]


def test_a_line_is_removed_exactly_and_only_a_line() -> None:
    t = np.arange(4000) * DT
    treated = process(record(0.2 - 0.01 * t), Processing(baseline="linear"))
    assert np.abs(treated.acceleration).max() < 1e-13
    wave = sine(0.7) ** 3
    level = process(record(wave), Processing(baseline="linear")).acceleration
    assert np.allclose(level, wave - np.polynomial.Polynomial.fit(t, wave, 1)(t), atol=1e-12)


def test_the_zeros_of_a_filter_are_stripped() -> None:
    values = sine(1.0)
    assert process(record(values), Processing(high_pass=0.1)).acceleration.size == values.size
    assert process(record(values), Processing(high_pass=0.1)).high_pass_frequency == 0.1


def test_resampling() -> None:
    wave = record(sine(1.0))
    finer = process(wave, Processing(time_step=DT / 2))
    assert np.array_equal(finer.acceleration[::2], wave.acceleration) and finer.time_step == DT / 2
    assert process(wave, Processing(time_step=DT * (1 + 1e-13))) is wave


def test_what_would_fold_is_gone_and_what_is_kept_is_whole() -> None:
    """The low-pass against aliasing halves at 0.8 of the new Nyquist frequency, 20 Hz, and is 8th order, run both ways.

    Its gain is 1/(1 + (tan(πf/2f_N)/tan(πf_c/2f_N))^16) with f_N = 50 Hz: 0.996 at 15 Hz, 1/2 at 20 Hz, 0.006 at 25 Hz.
    """
    middle = slice(500, 1500)
    for frequency in (15.0, 18.0, 20.0, 22.0):
        wave = sine(frequency)
        got = process(record(wave), Processing(time_step=0.02)).acceleration[middle]
        ratio = np.tan(np.pi * frequency / 100) / np.tan(np.pi * 20 / 100)
        assert np.abs(got - wave[::2][middle] / (1 + ratio**16)).max() < 2e-3
    # 45 Hz would fold to 5 Hz at full amplitude
    coarser = process(record(sine(1.0) + sine(45.0)), Processing(time_step=0.02))
    assert np.abs(coarser.acceleration[middle] - sine(1.0)[::2][middle]).max() < 1e-3
    assert "aliasing" in coarser.processing[0]


def test_variants_differ_and_all_run() -> None:
    samples = np.concatenate([np.zeros(600), synthetic_record(SHIPPED).acceleration]) + 0.01
    wave = Accelerogram(samples, SHIPPED.time_step)
    results = {name: process(wave, settings) for name, settings in steps.variants().items()}
    assert {"unchanged", "adaptive baseline", "high-pass 0.1 Hz"} <= set(results)
    assert len({result.sha256 for result in results.values()}) == len(results) == 6


@pytest.mark.parametrize(("settings", "field"), [
    ({"pre_event": 0.0}, "pre_event"), ({"high_pass": -1.0}, "high_pass"), ({"low_pass": float("nan")}, "low_pass"),
    ({"taper": 0.6}, "taper"), ({"order": 0}, "order"), ({"order": 2.5}, "order"), ({"baseline": "magic"}, "baseline"),
    ({"high_pass": 3.0, "low_pass": 2.0}, "high_pass"), ({"time_step": 0.0}, "time_step"),
])  # fmt: skip
def test_settings_out_of_range(settings: dict, field: str) -> None:
    with refused(RecordError, field, settings[field]):
        Processing(**settings)


@pytest.mark.parametrize("pre_event", [5.0, 0.004])
def test_a_window_before_the_event_holds_a_sample_and_ends_within_the_record(pre_event: float) -> None:
    wave = Accelerogram(np.ones(500), 0.01)
    process(wave, Processing(pre_event=4.99, baseline="none"))
    with refused(RecordError, "pre_event", pre_event):
        process(wave, Processing(pre_event=pre_event, baseline="none"))


@pytest.mark.parametrize(
    ("kind", "corner", "order"),
    [("high_pass", 0.1, 4), ("high_pass", 0.2, 1), ("low_pass", 25.0, 4), ("low_pass", 10.0, 10)],
)
def test_a_filter_is_that_of_scipy_run_both_ways(kind: str, corner: float, order: int) -> None:
    values = np.random.default_rng(4).standard_normal(4001) * np.hanning(4001)
    pad = int(np.ceil(1.5 * order / corner / DT))
    sections = butter(order, corner, kind.replace("_", ""), fs=1 / DT, output="sos")
    expected = sosfiltfilt(sections, np.pad(values, pad), padlen=0)[pad:-pad]
    settings = {kind: corner} | ({} if order == 4 else {"order": order})  # 4 is the usual one
    filtered = process(record(values), Processing(**settings)).acceleration
    assert filtered == pytest.approx(expected, abs=1e-11)


def test_a_fast_length_is_the_least_product_of_a_power_of_two_and_one_of_five_numbers() -> None:
    products = sorted(base * 2**power for base in (1, 3, 5, 9, 15) for power in range(12))
    assert [steps.fast_length(count) for count in range(1, 2000)] == [
        next(product for product in products if product >= count) for count in range(1, 2000)
    ]


def test_the_displacement_of_a_filtered_record_is_that_with_its_pads() -> None:
    """Without what the filter put before the record, the displacement drifts."""
    rng = np.random.default_rng(2)
    raw = Accelerogram(rng.standard_normal(4000) * np.hanning(4000) + 0.05, 0.01)
    cut = process(raw, Processing(baseline="linear", high_pass=0.1))
    level = process(raw, Processing(baseline="linear")).acceleration
    pad = 12000  # twice 1.5 · 4/0.1 Hz
    high_pass = butter(4, 0.1, "highpass", fs=100, output="sos")
    padded = Accelerogram(sosfiltfilt(high_pass, np.pad(level, pad), padlen=0), 0.01)
    assert abs(velocity(padded)[-1]) < 1e-3 * np.abs(velocity(padded)).max(), "with its zeros it ends at rest"
    for integrated in (velocity, displacement):
        largest = np.abs(integrated(padded)).max()
        assert integrated(cut) == pytest.approx(integrated(padded)[pad:-pad], abs=5e-7 * largest)
        assert integrated(cut.scaled(-2.0)) == pytest.approx(-2.0 * integrated(cut))
    assert cut.measures.peak_displacement == np.abs(displacement(cut)).max()
    assert rocking.response_spectrum(cut, np.array([1.0])).displacement.shape == (1,)


def shaken(seed: int, seconds: float = 40.0) -> np.ndarray:
    """Ten seconds of noise after five of near rest, then a tilt that stays."""
    rng, t = np.random.default_rng(seed), np.arange(0, seconds, DT)
    noise = np.convolve(rng.normal(size=t.size), np.hanning(15) / 8, "same")
    return noise * (1e-3 + ((t > 5) & (t < 15))) + 0.02 * (t > rng.uniform(7, 12)) + 1e-4 * (t - 20)


KICKED = np.where(np.arange(600) == 3, 5.0, shaken(7, 6.0) * 1e-3)
"""One sample holds nearly all the energy, so that shaking gets the 16 samples that it has at least."""


def drift_of(velocity: np.ndarray, onset: int, end: int, degree: int) -> np.ndarray:
    """A line to `onset`, a polynomial from `end`, and between them the cubic that meets both in value and slope."""
    t = np.linspace(0, 1, velocity.size)
    before, after = np.polyfit(t[:onset], velocity[:onset], 1), np.polyfit(t[end:], velocity[end:], degree)
    ends, lines = (t[onset], t[end]), (before, after)
    values = [np.polyval(line, x) for line, x in zip(lines, ends, strict=True)]
    slopes = [np.polyval(np.polyder(line), x) for line, x in zip(lines, ends, strict=True)]
    bridge = CubicHermiteSpline(ends, values, slopes)(t[onset:end])
    return np.concatenate([np.polyval(before, t[:onset]), bridge, np.polyval(after, t[end:])])


@pytest.mark.parametrize("values", [*(shaken(seed) for seed in range(4)), shaken(4, 15.0), KICKED])
def test_the_drift_that_leaves_the_smallest_displacement_is_removed(values: np.ndarray) -> None:
    velocity = cumulative_trapezoid(values, dx=DT, initial=0)
    passed = np.cumsum(values**2) / np.sum(values**2)
    onset = max(8, int(np.argmax(passed >= 1e-3)))
    strong = max(onset + 16, int(np.argmax(passed >= 0.95)))
    last = min(strong + int(0.85 * (values.size - strong)), values.size - 16)
    ends = {int(end) for end in np.linspace(strong, last, 20)}
    places = [(end, degree) for end in ends for degree in (1, 2)]
    drifts = {place: drift_of(velocity, onset, *place) for place in places}
    left = {place: np.abs(np.cumsum(velocity - drift)).max() for place, drift in drifts.items()}
    corrected, sentence = adaptive_baseline(values, DT)
    told = re.search(r"before (\S+) s and after (\S+) s \(degree (\d)\)", sentence)
    assert told and round(float(told[1]) / DT) == onset
    chosen = round(float(told[2]) / DT), int(told[3])
    assert left[chosen] <= min(left.values()) * (1 + 1e-6)
    removed = np.gradient(drifts[chosen], DT)
    # Two ways to the same least squares: rounding only.
    assert np.abs(values - corrected - removed).max() < 1e-9 * np.abs(values).max()


def test_shaking_that_lasts_to_the_end_leaves_no_baseline_to_fit() -> None:
    """95 % of a steady motion have passed when 5 % of its samples are left: 16 of 320, and of 280 fewer."""
    for size, stays in ((280, True), (400, False)):
        values = np.tile([1.1, -1.0], size // 2)
        corrected, sentence = adaptive_baseline(values, DT)
        assert np.array_equal(corrected, values) == stays == ("left the record as it is" in sentence)


@pytest.mark.parametrize("values", [np.zeros(200), shaken(1)[600:663]])
def test_without_motion_or_with_few_samples_there_is_none(values: np.ndarray) -> None:
    with refused(RecordError, "samples"):
        adaptive_baseline(values, DT)
