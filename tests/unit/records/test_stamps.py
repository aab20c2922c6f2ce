"""Times of day with which the rows of a table begin."""

from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError
from tests.refusals import refused
from tests.unit.records.test_labels import FIRST, WAVES, opened


def stamped(head: str, stamp: str, *columns: np.ndarray, first: float = 3590.0, step: float = 0.01) -> str:
    """A table whose rows begin with a time of day, `stamp` of hours, minutes and seconds from `first` s on."""
    rows = []
    for place, row in enumerate(np.transpose(columns)):
        at = first + step * place
        time = stamp.format(h=int(at // 3600) % 24, m=int(at // 60) % 60, s=at % 60)
        rows.append(",".join([time, *(f"{value:.6f}" for value in row)]))
    return head + "\n".join(rows) + "\n"


@pytest.mark.parametrize(
    ("head", "stamp"),
    [
        ("DateTime,NS (m/s2)\n", "2020-01-01T{h:02d}:{m:02d}:{s:06.3f}"),
        ("Time (UTC),NS (m/s2)\n", "2020-01-01 {h:02d}:{m:02d}:{s:06.3f}"),
        ("Time,NS (m/s2)\n", "{h:02d}:{m:02d}:{s:06.3f}"),
        ("timestamp,NS (m/s2)\n", "01/31/2020 {h:02d}:{m:02d}:{s:06.3f}"),
        ("timestamp,NS (m/s2)\n", "2020-01-01T{h:02d}:{m:02d}:{s:06.3f}Z"),
        ("timestamp,NS (m/s2)\n", '"2020-01-01T{h:02d}:{m:02d}:{s:06.3f}+02:00"'),
        ("# 10:00:00 start of the recorder\ntimestamp,NS (m/s2)\n", "{h:02d}:{m:02d}:{s:06.3f}"),
    ],
)
@pytest.mark.parametrize("first", [0.0, 3597.0, 86_398.0])
def test_times_of_day_are_times(tmp_path: Path, head, stamp, first):
    (record,) = opened(tmp_path, stamped(head, stamp, FIRST, first=first))
    assert record.time_step == pytest.approx(0.01, rel=1e-9)
    assert record.azimuth == 0.0
    assert record.acceleration == pytest.approx(FIRST, abs=1e-6)


def test_every_channel_beside_a_time_of_day_is_read(tmp_path: Path):
    head = "Time,EW (gal),NS (gal),UD (gal)\n"
    records = opened(tmp_path, stamped(head, "{h:02d}:{m:02d}:{s:06.3f}", *WAVES))
    assert [record.vertical for record in records] == [False, False, True]
    for record, wave in zip(records, WAVES, strict=True):
        assert record.acceleration == pytest.approx(wave / 100, abs=1e-8)


def test_times_of_day_in_whole_seconds_are_refused(tmp_path: Path):
    with refused(RecordError, "times", 0.0):
        opened(tmp_path, stamped("Time,NS (m/s2)\n", "{h:02d}:{m:02d}:{s:02.0f}", FIRST))
