"""The vertical component of a record."""

import hashlib

import numpy as np
import pytest

from rocking.errors import CatalogueError, RecordError
from rocking.records import Accelerogram
from rocking.records.catalogue import open_vertical
from rocking.records.catalogue_record import CatalogueRecord
from rocking.records.rotation import aligned

VALUES = np.sin(np.arange(300) * 0.3)


def _written(folder, name, values):
    text = "\n".join(f"{i * 0.01:.2f} {v:.8f}" for i, v in enumerate(values))
    (folder / name).write_text(text + "\n")
    return hashlib.sha256((folder / name).read_bytes()).hexdigest()


def _record(folder, **changes):
    horizontal = _written(folder, "h.txt", VALUES)
    vertical = _written(folder, "v.txt", 0.5 * VALUES[:250])
    given = {
        "vertical_file": "v.txt",
        "vertical_sha256": vertical,
        "unit": "m/s2",
        "scale_factor": 2.0,
    } | changes
    return CatalogueRecord("a", "h.txt", horizontal, folder=folder, **given)


def test_it_is_read_from_its_own_file_and_scaled_like_the_record(tmp_path):
    vertical = open_vertical(_record(tmp_path))
    assert vertical.acceleration == pytest.approx(VALUES[:250], abs=1e-8)


def test_there_may_be_none(tmp_path):
    assert open_vertical(_record(tmp_path, vertical_file="", vertical_sha256="")) is None


def test_its_hash_is_checked(tmp_path):
    with pytest.raises(RecordError, match="sha256"):
        open_vertical(_record(tmp_path, vertical_sha256="0" * 64))
    with pytest.raises(CatalogueError, match="vertical_sha256"):
        _record(tmp_path, vertical_sha256="ABC")


def test_a_path_out_of_the_folder_is_refused(tmp_path):
    with pytest.raises(CatalogueError, match="vertical_file"):
        _record(tmp_path, vertical_file="../v.txt")


def test_it_is_still_after_its_end_and_cut_at_the_end_of_the_other():
    short, long = Accelerogram(np.ones(5), 0.01), Accelerogram(np.zeros(8), 0.01)
    assert aligned(short, long).acceleration.tolist() == [1.0] * 5 + [0.0] * 3
    assert aligned(long, short).acceleration.tolist() == [0.0] * 5


def test_another_time_step_is_refused():
    with pytest.raises(RecordError, match="time_step"):
        aligned(Accelerogram(np.ones(5), 0.02), Accelerogram(np.zeros(8), 0.01))
