"""The synthetic record that is shipped."""

from pathlib import Path

import numpy as np

from rocking.quantities import GRAVITY
from rocking.records import read
from tests.synthetic import SHIPPED, at2_text, synthetic_record

FILE = Path(__file__).parents[2] / "records" / f"{SHIPPED.name}.AT2"


def test_the_shipped_file_is_what_the_generator_makes_and_calls_itself_synthetic() -> None:
    content = FILE.read_bytes()
    assert content == at2_text(SHIPPED).encode() and b"NOT RECORDED" in content[:80]
    (record,) = read(FILE)
    # eight digits are printed
    assert np.abs(record.acceleration - synthetic_record(SHIPPED).acceleration).max() < 1e-7 * GRAVITY
    assert record.time_step == SHIPPED.time_step and "synthetic" in record.station.lower()
