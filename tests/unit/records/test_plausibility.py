"""The gates: peaks against headers and against what ground can do, with the factor that explains the difference."""

from dataclasses import replace

import numpy as np
import pytest

import rocking
from rocking.errors import RecordError
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram, Source
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import agree_with_header, pass_limits
from rocking.signal.kinds import SignalKind
from rocking.warnings import RockingWarning
from tests.refusals import refused


def record(peak: float) -> Accelerogram:
    """A record whose peak is `peak` m/s²."""
    source = Source(path="file.x", unit="g")
    return Accelerogram(np.array([0.0, peak, -peak / 2]), 0.01, component="NS", source=source)


def test_the_header_is_believed_within_one_percent() -> None:
    agree_with_header(record(1.0), 1.0099 / GRAVITY, "g")
    agree_with_header(record(1.0), -99.1, "gal")
    agree_with_header(record(1.0), None, "g")
    agree_with_header(record(1.0), 0.0, "g")
    agree_with_header(record(0.0014), 0.001, "m/s2", half_digit=5e-4)
    with refused(RecordError, "peak", 1.02):
        agree_with_header(record(1.0), 1.02, "m/s2")


@pytest.mark.parametrize(("ratio", "named"), [
    (980.665, ("peak", 1.0)), (1 / 980.665, ("peak", 1.0)),
    (9.80665, ("peak", 1.0)), (100.0, ("peak", 1.0)),
    (10.0, ("peak", 1.0)), (1000.0, ("peak", 1.0)), (3.7, ("peak", 1.0)),
])  # fmt: skip
def test_the_factor_is_explained(ratio: float, named: tuple) -> None:
    with refused(RecordError, *named):
        agree_with_header(record(ratio), 1.0, "m/s2")


def test_limits() -> None:
    assert pass_limits(record(2.99 * GRAVITY)) == () == pass_limits(record(1.01e-5 * GRAVITY))
    for peak in (3.01, 4.99):
        (rare,) = pass_limits(record(peak * GRAVITY))
        assert rare.kind is RecordKind.PEAK_RARE and rare["peak_g"] == pytest.approx(peak)
    with refused(RecordError, "peak", "peak acceleration is 5e+06 g"):
        pass_limits(record(5e6 * GRAVITY))
    (told,) = pass_limits(record(8e-6 * GRAVITY))
    assert told.kind is RecordKind.PEAK_TINY_BY_UNIT and told["peak_g"] == pytest.approx(8e-6)
    assert told["factors"].startswith("by 980.665 ")
    assert pass_limits(record(0.0)) == (RockingWarning.of(RecordKind.PEAK_TINY, peak_g=0.0),)


SHAKING = np.sin(np.arange(400) / 5) * np.hanning(400)


def test_steps_and_peaks_that_no_instrument_gives_are_told_of_arrays_as_of_files() -> None:
    for step in (1e-9, 0.11, 6.01, 1e3):
        (warning,) = Accelerogram(SHAKING, step).warnings
        assert warning.kind is SignalKind.STEP_UNUSUAL and warning["time_step_s"] == step
    assert Accelerogram(SHAKING * 1000, 0.01).warnings == (RockingWarning(SignalKind.PEAK_IMPOSSIBLE),)
    assert len(replace(Accelerogram(SHAKING * 1000, 1e-9), station="A").warnings) == 2
    assert not Accelerogram(SHAKING * 5 * GRAVITY, 1e-4).warnings + Accelerogram(SHAKING, 0.1).warnings


@pytest.mark.parametrize(
    ("stated", "is_told"),
    [
        ("0.1", False),
        ("0.05", False),
        ("0.054", False),
        ("0.0541", False),
        ("0.0546", True),
        ("0.05450", True),
    ],
)
def test_a_stated_peak_may_be_off_by_half_of_the_last_digit_that_is_printed(tmp_path, stated, is_told):
    """Of 0.0541 g, which the first four are rounded from; the others are within 1 %, beyond which it is refused."""
    path = tmp_path / "a.AT2"
    samples = " ".join(["0.0 0.0541 -0.02 0.01 0.0"] * 40)
    path.write_text(
        f"PEER\nMade 1/1/2000, A, 90, PGA={stated} G\nACCELERATION IN UNITS OF G\nNPTS= 200, DT= .01 SEC\n{samples}\n"
    )
    (read,) = rocking.read(path)
    assert (RecordKind.PEAK_UNLIKE_HEADER in {warning.kind for warning in read.warnings}) is is_told
