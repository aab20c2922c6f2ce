"""Every file that obspy and this package both read gives the same record by either way, and its calibration once."""

import io
import os
import warnings
from pathlib import Path

import made_files
import numpy as np
import obspy
import pytest
from made_files import MADE, STEP, TRUE, by_obspy, knet
from made_files import evt as made_evt

import rocking
from rocking.errors import RecordError, RockingError, UndeclaredError
from rocking.records.formats import Options
from rocking.records.kinds import RecordKind
from rocking.records.read import read_content
from tests.refusals import refused

FACTS = (
    "component", "azimuth", "vertical", "borehole", "station", "network", "location", "processed", "latitude",
    "longitude", "elevation",
)  # fmt: skip
DECLARED = ({}, {"unit": "m/s2"}, {"unit": "nm/s2"})


def opened(content: bytes) -> obspy.Stream | None:
    """The stream that obspy reads, None where it reads none."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return obspy.read(io.BytesIO(content))
        except Exception:
            return None


def assert_same(content: bytes) -> int:
    """Compare what both ways give of a content, for each declaration that both take; return how many these are."""
    stream = opened(content)
    count = 0
    for declared in DECLARED if stream is not None else ():
        try:
            by_file = read_content(content, "made", Options(**declared))
            by_stream = rocking.from_obspy(stream, calibration="apply", **declared)
        except RockingError:
            continue
        count += 1
        assert len(by_file) == len(by_stream)
        for one, other in zip(by_file, by_stream, strict=True):
            assert np.allclose(one.acceleration, other.acceleration, rtol=1e-12, atol=1e-13)
            assert one.time_step == other.time_step
            assert one.start_time[:19] == other.start_time[:19]
            assert {name: getattr(one, name) for name in FACTS} == {
                name: getattr(other, name) for name in FACTS
            }
    return count


@pytest.mark.parametrize("name", MADE)
def test_a_made_file_of_each_format(name: str) -> None:
    content = made_files.MADE[name][0]()
    assert_same(content if isinstance(content, bytes) else content.encode())


@pytest.mark.parametrize("form", ["SAC", "MSEED", "GSE2", "SLIST", "TSPAIR"])
def test_what_obspy_writes_is_compared_at_least_once(form: str) -> None:
    counts = np.round(1e4 * TRUE).astype(np.int32)
    assert assert_same(by_obspy(form, counts.astype(np.float32) if form == "SAC" else counts)) >= 1


def files_by_kind() -> dict[str, list[Path]]:
    """The files that obspy installs for its tests and the real records, the smallest first, by their folders."""
    own = Path(obspy.__file__).parent / "io"
    folders = {folder.name: folder / "tests" / "data" for folder in sorted(own.iterdir())}
    real = real_records()
    folders |= {folder.name: folder for folder in sorted(real.iterdir())} if real else {}
    return {
        name: sorted(
            (path for path in folder.rglob("*") if path.is_file() and path.stat().st_size < 2**22),
            key=lambda path: (path.stat().st_size, path.name),
        )
        for name, folder in folders.items()
    }


OF_BOTH = {"ascii", "gse2", "kinemetrics", "mseed", "nied", "reftek", "sac", "seisan", "win"}
"""The readers of obspy whose formats this package reads as well."""


@pytest.mark.slow
def test_every_example_of_obspy_and_every_real_record() -> None:
    """Hundreds of files of thirty formats, as institutes write them; of each of obspy's some are read by both ways."""
    read = {
        name: sum(assert_same(path.read_bytes()) for path in paths) for name, paths in files_by_kind().items()
    }
    assert sum(read.values()) >= 50 and all(read[name] for name in OF_BOTH)


def real_records() -> Path | None:
    """The folder of real records, None where there is none."""
    folder = os.environ.get("ROCKING_RECORDS")
    return Path(folder) if folder else None


def sac(scale: float, depth: float | None = None) -> bytes:
    """A SAC file in gal over `scale`, with an offset of 3 gal, of an instrument so far below the surface, m."""
    samples = ((100 * TRUE + 3) / scale).astype(np.float32)
    trace = obspy.Trace(samples, {"delta": STEP, "channel": "HNE", "station": "A"})
    trace.stats.calib = scale
    trace.stats.sac = {} if depth is None else {"stdp": depth}
    content = io.BytesIO()
    trace.write(content, format="SAC")
    return content.getvalue()


def test_the_scale_of_a_sac_file_is_applied_once() -> None:
    content = sac(0.01)
    (by_file,) = read_content(content, "made", Options(unit="gal"))
    assert by_file.acceleration == pytest.approx(TRUE - TRUE.mean(), abs=1e-6)
    raw, scaled = obspy.read(io.BytesIO(content)), obspy.read(io.BytesIO(content), apply_calib=True)
    for stream in (raw, scaled):
        with refused(UndeclaredError, "calibration") as asked:
            rocking.from_obspy(stream, unit="gal")
        assert asked.value.field == "calibration"
    (first,) = rocking.from_obspy(raw, unit="gal", calibration="apply")
    (second,) = rocking.from_obspy(scaled, unit="gal", calibration="done")
    assert first.acceleration == pytest.approx(by_file.acceleration, rel=1e-12)
    assert second.acceleration == pytest.approx(by_file.acceleration, abs=1e-6)  # in single precision
    assert (
        {warning.kind for warning in first.warnings}
        == {RecordKind.SCALE_APPLIED}
        != {one_warning.kind for one_warning in second.warnings}
    )


@pytest.mark.parametrize("step", [
    "ObsPy 1.5: remove_response(inventory=x::output='ACC')", "ObsPy 1.5: remove_sensitivity(inventory=x)",
])  # fmt: skip
@pytest.mark.parametrize("calibration", [None, "apply", "done"])
def test_after_the_response_is_removed_no_calibration_is_due(step: str, calibration: str | None) -> None:
    trace = obspy.Trace(TRUE.copy(), {"delta": STEP, "channel": "HNE", "calib": 0.01, "processing": [step]})
    (record,) = rocking.from_obspy(trace, unit="m/s2", calibration=calibration)
    assert record.acceleration == pytest.approx(TRUE - TRUE.mean() * ("sensitivity" in step), abs=1e-12)


def test_whole_numbers_are_multiplied_by_no_calibration_yet() -> None:
    counts = np.round(1e4 * TRUE).astype(np.int32)
    trace = obspy.Trace(counts, {"delta": STEP, "channel": "HNE", "calib": 1e-4})
    for samples in (counts, counts.astype(float)):
        trace.data = samples
        (record,) = rocking.from_obspy(trace, unit="m/s2")
        assert record.acceleration == pytest.approx(1e-4 * counts, rel=1e-12)


def test_k_net_and_kinemetrics_need_neither_unit_nor_answer() -> None:
    """Their samples are whole numbers, and their calibration leads to m/s²."""
    for content in (knet().encode(), made_evt()):
        (by_file,) = read_content(content, "made", Options())
        (by_stream,) = rocking.from_obspy(obspy.read(io.BytesIO(content)))
        assert by_stream.acceleration == pytest.approx(by_file.acceleration, rel=1e-12)
        with refused(RecordError, "unit", "g"):
            rocking.from_obspy(obspy.read(io.BytesIO(content)), unit="g")
        scaled = obspy.read(io.BytesIO(content), apply_calib=True)
        (done,) = rocking.from_obspy(scaled, calibration="done")
        assert done.acceleration == pytest.approx(by_file.acceleration, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("depth", [0.0, 4.0, 100.0])
def test_a_sac_file_down_hole_is_one_by_both_ways(depth: float) -> None:
    content = sac(1.0, depth)
    (by_file,) = read_content(content, "made", Options(unit="gal"))
    (by_stream,) = rocking.from_obspy(obspy.read(io.BytesIO(content)), unit="gal")
    assert by_file.borehole is by_stream.borehole is (depth >= 5)


def test_counts_that_are_multiplied_are_none_for_a_response() -> None:
    stream = obspy.read(io.BytesIO(sac(0.01)), apply_calib=True)
    inventory = obspy.read_inventory("records/CI.CCC.xml")
    with refused(UndeclaredError, "calibration"):
        rocking.from_obspy(stream, inventory)
    with refused(RecordError, "calibration", "done"):
        rocking.from_obspy(stream, inventory, calibration="done")


def test_the_unit_of_a_trace_of_this_package_is_not_overruled() -> None:
    record = rocking.Accelerogram(TRUE, STEP, "N")
    with refused(RecordError, "unit", "g"):
        rocking.from_obspy(record.to_obspy(), unit="g")
