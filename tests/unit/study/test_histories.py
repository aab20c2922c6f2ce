"""Rotation histories on request: what stands in histories.csv of a record."""

import numpy as np
import pytest

import rocking
from rocking.assessment.rows.of_case import HistoryRow
from rocking.records.catalogue import CatalogueRecord
from rocking.structures import Block
from rocking.study.histories import write_histories
from rocking.study.run import Study
from rocking.study.settings import Settings
from rocking.tables import frame, read_rows

STRUCTURES = {
    "falls": Block.of_size(0.2, 2.0),
    "rocks": Block.of_size(1.0, 4.0),
    "rests": Block.of_size(3.0, 3.0, restitution=0.5),
}


@pytest.fixture(scope="module")
def written(tmp_path_factory, shipped):
    """The histories of a shipped record and of one that is not there."""
    folder = tmp_path_factory.mktemp("histories")
    records = [
        CatalogueRecord(
            id="moves",
            file=shipped.name,
            sha256=rocking.read(shipped)[0].source.sha256,
            folder=shipped.parent,
        ),
        CatalogueRecord(id="gone", file="gone.AT2", sha256="ab" * 32, folder=shipped.parent),
    ]
    write_histories(records, Study(STRUCTURES, Settings()), folder, folder / "log")
    return folder


@pytest.fixture(scope="module")
def shipped():
    from pathlib import Path

    return Path(__file__).parents[3] / "records" / "synthetic_strong_pulse.AT2"


def test_a_history_is_that_of_the_response(written, shipped):
    (record,) = rocking.read(shipped)
    table = frame(HistoryRow, written / "moves" / "histories.csv")
    assert list(table["structure"].unique()) == list(STRUCTURES)
    for name, structure in STRUCTURES.items():
        of_it = table[table["structure"] == name]
        mechanism, response = structure.mechanism(), rocking.integrate(structure, record)
        reached = of_it["rotation_rad"].abs().max() / mechanism.critical_rotation
        if np.isfinite(response.rotation_ratio):
            # the largest rotation lies between two steps: φ'' Δt²/8 below it at most, a thousandth at these periods
            assert reached == pytest.approx(response.rotation_ratio, rel=2e-3, abs=1e-12)
        else:
            assert reached > 1
        assert of_it["time_s"].is_monotonic_increasing and of_it["time_s"].iloc[0] == 0.0


def test_the_velocity_is_the_derivative_of_the_rotation(written):
    """By the trapezoidal rule over the steps, whose error is φ''' Δt³/12 each; impacts change no rotation."""
    table = frame(HistoryRow, written / "moves" / "histories.csv")
    rocks = table[table["structure"] == "rocks"]
    steps = np.diff(rocks["time_s"])
    rise = np.diff(rocks["rotation_rad"])
    velocity = rocks["angular_velocity_rad_s"].to_numpy()
    smooth = np.sign(rocks["rotation_rad"].to_numpy()[1:]) == np.sign(rocks["rotation_rad"].to_numpy()[:-1])
    gained = steps * (velocity[1:] + velocity[:-1]) / 2
    assert smooth.sum() > 100
    assert np.abs(gained - rise)[smooth].max() <= 1e-3 * np.abs(rocks["rotation_rad"]).max()


def test_a_record_that_cannot_be_read_has_a_head_and_a_line_in_the_log(written):
    assert list(read_rows(HistoryRow, written / "gone" / "histories.csv")) == []
    assert "gone: no histories: " in (written / "log").read_text()
