"""A motion that is smooth within some of its steps, as on a floor: curves join its samples, or lines if none fits."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rocking.floors.support as floors
from rocking.errors import RecordError
from rocking.motion import Members, integrate, integrate_members, table
from rocking.motion.nonlinear_kernel import _strongest
from rocking.motion.table import CURVE_ERROR, forcing_of
from rocking.records import Accelerogram
from rocking.structures import Block, Wall
from tests.refusals import refused

STEP = 0.01
TIMES = np.arange(300) * STEP


def _record(seed: int, peak: float = 4.0) -> Accelerogram:
    rng = np.random.default_rng(seed)
    waves = sum(np.sin(2 * np.pi * rng.uniform(0.5, 6.0) * TIMES + rng.uniform(0, 6.3)) for _ in range(9))
    samples = waves * np.sin(np.pi * TIMES / 3) ** 2
    return Accelerogram(peak * samples / np.abs(samples).max(), STEP)


def _floor(record: Accelerogram, period: float = 0.2) -> Accelerogram:
    return floors.Support((floors.Mode(period=period, damping_ratio=0.05, participation=1.3),)).motion(record)


def _sampled_by_lines(
    record: Accelerogram, monkeypatch: pytest.MonkeyPatch, period: float = 0.2
) -> Accelerogram:
    """The motion of the same floor on so many samples that lines between them are as good as the motion itself."""
    with monkeypatch.context() as finer:
        finer.setattr(floors, "INTERPOLATION_ERROR", 1e-7)
        finer.setattr(floors, "SHORTEST_STEP", 1e-6)
        return replace(_floor(record, period), smooth_steps=1)


def test_a_curve_is_the_motion_between_the_samples(monkeypatch):
    record = _record(1)
    floor = _floor(record)
    ground = forcing_of(floor).ground
    assert ground.stretch == floor.smooth_steps > 5
    dense = _sampled_by_lines(record, monkeypatch)
    times = np.arange(record.acceleration.size * 40 - 40) * STEP / 40
    piece = np.minimum((times / STEP + 1e-9).astype(int), ground.curves.shape[0] - 1)
    since = times - piece * STEP
    found = sum(ground.curves[piece, power] * since**power for power in range(6))
    exact = np.interp(times, dense.times, dense.acceleration)
    assert np.abs(found - exact).max() <= 2 * CURVE_ERROR * floor.peak_acceleration


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize(
    "structure",
    [
        Block(1.5, 0.2),
        Block(1.0, 0.25, one_sided=True, restitution=0.5),
        Wall(3.2, 1.6, 0.25),
    ],
)
def test_the_response_is_that_of_lines_a_hundred_times_as_fine(structure, tolerance, monkeypatch):
    """Lines that come within 1e-7 of the peak of the motion; a rotation is up to ten times as sensitive."""
    for seed in (2, 3):
        record = _record(seed, 3.0)
        up = replace(_record(7, 1.0), vertical=True)
        pair = floors.Support((floors.Mode(period=0.2, damping_ratio=0.05, participation=1.3),)).motions(
            (record, up)
        )
        with monkeypatch.context() as finer:
            finer.setattr(floors, "INTERPOLATION_ERROR", 1e-7)
            finer.setattr(floors, "SHORTEST_STEP", 1e-6)
            dense = floors.Support((floors.Mode(period=0.2, damping_ratio=0.05, participation=1.3),)).motions(
                (record, up)
            )
        lines = replace(dense[0], smooth_steps=1)
        for vertical, exact_vertical in ((None, None), (pair[1], dense[1])):
            found = integrate(structure, pair[0], tolerance, vertical=vertical)
            exact = integrate(structure, lines, 1e-10, vertical=exact_vertical)
            assert exact.outcome == found.outcome == "rocks"
            assert found.rotation_ratio == pytest.approx(exact.rotation_ratio, rel=max(tolerance, 3e-6))


def test_what_lines_join_is_followed_as_before_where_no_curve_fits():
    """Noise is smooth over no steps, whatever is said of it."""
    rng = np.random.default_rng(4)
    noise = Accelerogram(rng.normal(size=801), 0.005)
    said = replace(noise, smooth_steps=8)
    assert forcing_of(said).ground.stretch == 1
    block = Block(1.0, 0.1)
    assert integrate(block, said).rotation_ratio == integrate(block, noise).rotation_ratio


def test_members_on_a_floor_are_the_single_runs():
    floor = _floor(_record(5))
    block = Block(1.0, 0.25)
    factors = np.linspace(0.5, 12.0, 12)
    together = integrate_members(block, floor, Members(factors)).rotation_ratio
    alone = [integrate(block, floor.scaled(factor)).rotation_ratio for factor in factors]
    np.testing.assert_allclose(together, alone, rtol=1e-6)
    assert np.isinf(together).any() and np.isfinite(together).any()


@pytest.mark.parametrize("steps", [0, -1, 1.5, math.nan, True, "8"])
def test_smooth_steps_are_a_whole_number(steps):
    with refused(RecordError, "smooth_steps", steps):
        Accelerogram(np.zeros(9), 0.01, smooth_steps=steps)


def test_the_largest_acceleration_still_to_come_is_that_of_every_sample():
    for motion in (_record(5), _floor(_record(5))):
        ground = forcing_of(motion).ground
        still_to_come = [
            np.abs(motion.acceleration[place:]).max() for place in range(motion.acceleration.size - 1)
        ]
        assert [_strongest.py_func(ground, place) for place in range(len(still_to_come))] == still_to_come


def test_a_forcing_holds_the_samples_of_its_record_and_is_forgotten_with_it():
    record, up = _record(6), replace(_record(7), vertical=True)
    alone, together = forcing_of(record), forcing_of(record, up)
    assert alone is forcing_of(record)
    assert together is forcing_of(record, up)
    assert alone is not together
    assert alone.ground.horizontal is record.acceleration
    assert together.ground.vertical is up.acceleration
    other = _record(8)
    assert forcing_of(other, up).ground.lightest is together.ground.lightest
    kept = len(table._FORCINGS._kept)
    del record, other, alone, together
    assert len(table._FORCINGS._kept) == kept - 2


def test_forcings_take_no_more_bytes_than_they_may(monkeypatch):
    forcings = table._Forcings()
    records = [_record(seed) for seed in range(6)]
    own = forcings.of(records[0], None).own_bytes
    assert own == records[0].acceleration.nbytes
    monkeypatch.setattr(table, "FORCING_BYTES", 3 * own)
    for record in records:
        forcings.of(record, None)
        assert forcings._bytes == own * len(forcings._kept) <= 3 * own
    assert [forcing() for forcing in forcings._kept] == records[3:]
    del record, records
    assert (forcings._bytes, len(forcings._kept)) == (0, 0)
