"""Rotation: against the vector that was recorded, for any pair of azimuths."""

import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.records import Accelerogram
from rocking.signal.kinds import SignalKind
from rocking.signal.rotation import rotate, rotd
from rocking.warnings import RockingWarning
from tests.refusals import refused

RNG = np.random.default_rng(1)
NORTH, EAST = RNG.standard_normal(500), RNG.standard_normal(500)


def component(azimuth: float | None, n: int = 500, **fields) -> Accelerogram:
    angle = np.radians(azimuth or 0.0)
    values = (NORTH * np.cos(angle) + EAST * np.sin(angle))[:n]
    return Accelerogram(values, 0.01, azimuth=azimuth, **fields)


@pytest.mark.parametrize(("one", "two", "sense"), [(0, 90, 1), (228, 318, 1), (318, 228, -1), (334, 64, 1)])
@pytest.mark.parametrize("angle", [0.0, 0.7, 1.6, 4.0])
def test_a_pair_gives_the_motion_along_any_axis(one: float, two: float, sense: int, angle: float) -> None:
    turned = rotate(component(one), component(two), angle)
    assert turned.azimuth == pytest.approx((one + sense * np.degrees(angle)) % 360)
    assert np.allclose(turned.acceleration, component(turned.azimuth).acceleration, atol=1e-12)
    assert "towards component two" in turned.processing[-1]


def test_what_came_before_the_record_turns_with_it() -> None:
    """A motion along 30° from north, of which north sees √3/2 and east one half."""
    north, east = (
        component(azimuth, initial_velocity=0.4 * share, initial_displacement=-0.2 * share)
        for azimuth, share in ((0, 3**0.5 / 2), (90, 0.5))
    )
    for wanted, share in ((30, 1.0), (120, 0.0), (210, -1.0)):
        turned = rotate(north, east, np.radians(wanted))
        assert turned.initial_velocity == pytest.approx(0.4 * share, abs=1e-15)
        assert turned.initial_displacement == pytest.approx(-0.2 * share, abs=1e-15)


def test_unequal_lengths_are_cut_and_told() -> None:
    turned = rotate(component(0), component(90, n=490), 0.8)
    assert turned.acceleration.size == 490
    assert turned.warnings[-1] == RockingWarning.of(SignalKind.CUT_TO_THE_SHORTER, short=490, long=500)


@pytest.mark.parametrize(("one", "two"), [(0, 90), (318, 228), (260, 345), (10, 150)])
def test_components_at_any_angle_have_the_peaks_of_their_motion(one: float, two: float) -> None:
    peaks = rotd(component(one), component(two))
    along = [component(azimuth).peak_acceleration for azimuth in range(180)]
    assert (peaks.rotd50, peaks.rotd100) == pytest.approx((np.median(along), max(along)))
    assert peaks.azimuth == np.argmax(along)
    assert rotd(component(None), component(None)).rotd100 > 0


@pytest.mark.parametrize(("first", "second", "named"), [
    (component(0), component(10), ("azimuth",)),
    (component(0), component(181), ("azimuth",)),
    (component(0), component(90, vertical=True), ("vertical", True)),
    (component(0, start_time="a"), component(90, start_time="b"), ("start_time", ('a', 'b'))),
    (component(0), Accelerogram(NORTH, 0.02, azimuth=90), ("time_step", (0.01, 0.02))),
])  # fmt: skip
def test_pairs_that_do_not_fit(first: Accelerogram, second: Accelerogram, named: tuple) -> None:
    with refused(RecordError, *named):
        rotd(first, second)
