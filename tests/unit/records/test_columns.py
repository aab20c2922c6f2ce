"""Columns of numbers: what runs along rows and what along columns, what names say, and what is no record."""

from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.records import Accelerogram, read
from rocking.records.formats.layouts import AskedError
from rocking.records.kinds import RecordKind
from tests.refusals import refused
from tests.unit.records.test_layouts import answered

TIMES = np.arange(600) * 0.01
WAVES = [
    np.sin(4 * TIMES + phase) * np.exp(-((TIMES - 3) ** 2)) * size
    for phase, size in ((0, 2), (1, 1.5), (2, 0.7))
]


def written(folder: Path, rows, head: str = "", parted: str = " ", digits: str = ".6f") -> Path:
    path = folder / "made.txt"
    lines = [parted.join(f"{value:{digits}}" for value in row) for row in rows]
    path.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
    return path


def opened(path: Path, **options) -> list[Accelerogram]:
    return read(path, **{"unit": "m/s2", "time_step": 0.01} | options)


def test_three_columns_without_names_are_three_channels(tmp_path):
    path = written(tmp_path, np.transpose(WAVES))
    with pytest.raises(AskedError) as asked:
        opened(path)
    answered(tmp_path, asked.value.question, "a, a, a m/s2")
    records = opened(path)
    for record, wave in zip(records, WAVES, strict=True):
        assert np.allclose(record.acceleration, wave, atol=1e-6)
    assert [record.component for record in records] == ["channel 1", "channel 2", "channel 3"]
    assert all(record.azimuth is None for record in records)


@pytest.mark.parametrize("width", [3, 4, 5, 6, 8, 10])
def test_a_series_that_is_wrapped_is_one_series(tmp_path, width):
    whole = WAVES[0][: 600 - 600 % width]
    (record,) = opened(written(tmp_path, whole.reshape(-1, width)))
    assert np.allclose(record.acceleration, WAVES[0][: record.acceleration.size], atol=1e-6)


@pytest.mark.parametrize("parted", [",", ";"])
def test_of_few_rows_commas_or_semicolons_say_that_columns_are_channels(tmp_path, parted):
    rows = WAVES[0][250:285].reshape(7, 5)
    (record,) = opened(written(tmp_path, rows))
    assert record.acceleration.size == 35
    with pytest.raises(AskedError):
        opened(written(tmp_path, rows, parted=parted))


def test_names_and_units_in_a_comment_are_read(tmp_path):
    head = "# made by a program\n# time(sec) N-S(cm/s/s) E-W(cm/s/s) U-D(cm/s/s)\n"
    records = read(written(tmp_path, np.transpose([TIMES, *WAVES]), head))
    assert [record.component for record in records] == ["N-S", "E-W", "U-D"]
    assert [record.vertical for record in records] == [False, False, True]
    assert records[0].peak_acceleration == pytest.approx(np.abs(WAVES[0]).max() / 100, abs=1e-8)


@pytest.mark.parametrize("head", [
    "Period (s),SA (g)\n", "Frequency [Hz], FAS [m/s]\n", "T (s),PSA (g)\n", "f (Hz),A (g)\n", "f,A (m/s2)\n",
    "Frequency [Hz],amplitude\n",
])  # fmt: skip
def test_a_spectrum_is_no_record(tmp_path, head):
    with refused(RecordError, "quantity", "spectrum"):
        read(written(tmp_path, np.transpose([TIMES, np.abs(WAVES[0])]), head, parted=","))


@pytest.mark.parametrize(
    ("label", "factor"),
    [("time (ms)", 1e-3), ("time (min)", 60.0), ("time [s]", 1.0), ("t (ms)", 1e-3), ("X [msec]", 1e-3)],
)
def test_the_unit_of_times_is_read(tmp_path, label, factor):
    path = written(tmp_path, np.transpose([TIMES / factor, WAVES[0]]), f"{label},acc (%g)\n", ",", ".12g")
    (record,) = read(path)
    assert record.time_step == pytest.approx(0.01)
    assert record.peak_acceleration == pytest.approx(np.abs(WAVES[0]).max() * 0.0980665, rel=1e-9)


@pytest.mark.parametrize("label", ["time_s*10", "Time, samples", "t (days)", "time x0.01 s", "Time 1/100 s"])
def test_times_in_another_unit_are_no_seconds(tmp_path, label):
    path = written(tmp_path, np.transpose([TIMES, WAVES[0]]), f"{label};acc (g)\n", ";", ".12g")
    with pytest.raises(RecordError, match="the times are in"):
        read(path)


@pytest.mark.parametrize("above", ["# dt = 5\n# units: g\n", "t;acc (g)\n"])
def test_a_step_that_no_recorder_has_is_in_milliseconds(tmp_path, above):
    columns = [WAVES[0]] if "dt" in above else [500 * TIMES, WAVES[0]]
    with pytest.raises(AskedError, match="convert what is in ms"):
        read(written(tmp_path, np.transpose(columns), above, ";", ".12g"))


@pytest.mark.parametrize("above", [[600], [600, 0.01]])
def test_a_count_above_the_samples_is_no_sample(tmp_path, above):
    path = written(tmp_path, [[value] for value in (*above, *WAVES[0])], digits=".9g")
    (record,) = opened(path) if len(above) == 1 else read(path, unit="m/s2")
    assert record.acceleration.size == 600 and record.time_step == 0.01
    assert record.peak_acceleration == pytest.approx(np.abs(WAVES[0]).max())
    (told,) = (warning for warning in record.warnings if warning.kind is RecordKind.FIRST_NUMBERS)
    assert told["what"] == (
        "the number of samples, the time step" if len(above) == 2 else "the number of samples"
    )
