"""A study of records: what fails becomes a row, and costs neither its record nor the others."""

import hashlib
import math
import pickle
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import pytest

from rocking.assessment.method import Method
from rocking.assessment.rows.of_case import ComparisonRow, MaximumRow
from rocking.assessment.rows.of_folder import PER_RECORD
from rocking.assessment.rows.of_record import FailureRow, PulseRow
from rocking.assessment.rows.of_study import structure_rows
from rocking.errors import RockingError, StructureError
from rocking.records.catalogue import CatalogueRecord
from rocking.records.synthetic import SyntheticRecord, at2_text
from rocking.structures import Block
from rocking.study.parts import IN_PARTS, copy_tables, part, read_part, remove_other_parts
from rocking.study.run import Study, assess_record, assess_records
from rocking.study.settings import Settings
from rocking.study.summary import write_summary
from rocking.tables import csv_lines, read_rows, write_rows

ROOT = Path(__file__).parents[3]
CONTENT = at2_text(SyntheticRecord("made", 1, 4.0, 0.6, 1.0, 1.0, 6.0, 0.01)).encode()


@dataclass(frozen=True)
class Impossible:
    """A structure that cannot be described."""

    def mechanism(self) -> None:
        raise StructureError("it cannot stand.")


def _study(**structures: object) -> Study:
    settings = Settings(candidates=0, processing_variants=False)
    return Study(structures or {"block": Block.of_size(0.5, 3.0)}, settings, "made")


def _record(
    folder: Path, identifier: str = "made", content: bytes = CONTENT, **cells: object
) -> CatalogueRecord:
    (folder / f"{identifier}.AT2").write_bytes(content)
    made = {"sha256": hashlib.sha256(content).hexdigest(), "unit": "g", "folder": folder} | cells
    return CatalogueRecord(identifier, f"{identifier}.AT2", **made)


def _assessed(record: CatalogueRecord, study: Study, folder: Path) -> list[str]:
    """Write the tables of `record` into `folder` and return the sentences of what failed."""
    tables = assess_record(record, study)
    tables.write(folder)
    return [failure.message for failure in tables.failures]


def test_a_structure_that_fails_does_not_take_the_record_with_it(tmp_path: Path) -> None:
    study = _study(impossible=Impossible(), block=Block.of_size(0.5, 3.0))
    assert _assessed(_record(tmp_path), study, tmp_path / "out") == ["it cannot stand."]
    (failure,) = read_rows(FailureRow, tmp_path / "out" / "failures.csv")
    assert (failure.structure, failure.stage) == ("impossible", "responses")
    alone = _assessed(_record(tmp_path), _study(), tmp_path / "alone")
    assert alone == []
    for name in ("maxima.csv", "comparison.csv", "pulses.csv"):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "alone" / name).read_bytes()


def test_a_record_that_fails_has_all_its_tables_and_says_why(tmp_path: Path) -> None:
    record = _record(tmp_path, content=b"not a record")
    (sentence,) = _assessed(record, _study(), tmp_path / "out")
    assert "made.AT2" in sentence
    for each in PER_RECORD:
        rows = list(read_rows(each, tmp_path / "out" / each.table.file_name))
        assert len(rows) == (1 if each.table.name in ("failures", "timings") else 0), each.table.name


def test_a_file_is_not_read_before_its_hash_is_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import rocking.records.catalogue as catalogue

    monkeypatch.setattr(catalogue, "read", lambda *_, **__: pytest.fail("read before its hash was checked"))
    (sentence,) = _assessed(_record(tmp_path, sha256="0" * 64), _study(), tmp_path / "out")
    assert "sha256" in sentence


class _Trap:
    def __reduce__(self) -> tuple[object, tuple[str]]:
        return Path.touch, (Path("/tmp/rocking_ran_a_pickle"),)


@pytest.mark.parametrize("head", [b"", b"obspy.core.stream"])
def test_a_pickle_is_never_opened(tmp_path: Path, head: bytes) -> None:
    """obspy.read would: it unpickles whatever says obspy.core.stream in its first 100 bytes."""
    trap = Path("/tmp/rocking_ran_a_pickle")
    content = pickle.dumps((head.decode(), _Trap()), protocol=0)
    (sentence,) = _assessed(_record(tmp_path, content=content), _study(), tmp_path / "out")
    assert not trap.exists()
    assert "made.AT2" in sentence


def test_no_source_loads_more_than_data() -> None:
    """No pickle, no YAML loader but a safe one, no eval: neither in the package nor in the workflow."""
    forbidden = (
        "import pickle",
        "pickle.load",
        "allow_pickle=True",
        "yaml.unsafe_load",
        "yaml.full_load",
        "yaml.Loader",
    )
    forbidden += ("yaml.FullLoader", "yaml.UnsafeLoader", " eval(", " exec(", "os.system(", "shell=True")
    sources = [*(ROOT / "rocking").rglob("*.py"), *(ROOT / "workflow").rglob("*.py"), ROOT / "Snakefile"]
    sources += (ROOT / "workflow").rglob("*.smk")
    assert len(sources) > 50
    found = [
        (path.name, word)
        for path in sources
        for word in forbidden
        if word in path.read_text(encoding="utf-8")
    ]
    assert not found
    loads = [
        line
        for path in sources
        for line in path.read_text(encoding="utf-8").splitlines()
        if "yaml.load(" in line
    ]
    assert all("_StrictLoader" in line for line in loads), "a subclass of SafeLoader, tested with the plan"


def test_the_log_has_a_line_for_each_record(tmp_path: Path) -> None:
    records = [_record(tmp_path, "good"), _record(tmp_path, "bad", b"no record")]
    assess_records(records, _study(), tmp_path / "out", tmp_path / "log")
    good, bad = (tmp_path / "log").read_text().splitlines()
    assert good.startswith("good: ") and "block" in good
    assert bad.startswith("bad: failed: ") and "bad.AT2" in bad


def test_two_assessments_of_the_same_record_are_equal_byte_for_byte(tmp_path: Path) -> None:
    for name in ("one", "two"):
        _assessed(_record(tmp_path), _study(), tmp_path / name)
    for path in (tmp_path / "one").iterdir():
        if path.name != "timings.csv":
            assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes()


@pytest.fixture
def in_two_jobs(tmp_path: Path) -> tuple[Path, list[CatalogueRecord]]:
    """Results with the parts of two jobs, and the records in the order of their catalogue: no job has neighbours."""
    contents = {"one": CONTENT, "bad": b"no record", "three": CONTENT, "two": CONTENT}
    records = [_record(tmp_path, name, content) for name, content in contents.items()]
    for place in (0, 1):
        folder = part(tmp_path / "results", f"0000{place}_of_00002")
        assess_records(records[place::2], _study(), folder, tmp_path / "log")
    return tmp_path / "results", records


def _parts(results: Path) -> list[Path]:
    return [part(results, f"0000{place}_of_00002") for place in (1, 0)]


def test_the_summary_holds_every_row_of_every_record_in_its_order(in_two_jobs) -> None:
    results, records = in_two_jobs
    write_summary(_parts(results), [record.id for record in records], {}, results / "summary")
    for each in (PulseRow, ComparisonRow, MaximumRow, FailureRow):
        found = [getattr(assess_record(record, _study()), each.table.name) for record in records]
        lines = list(csv_lines(each, chain.from_iterable(found)))
        assert "".join(lines) == (results / "summary" / each.table.file_name).read_text(encoding="utf-8")
        assert each is FailureRow or len(lines) > 3


def test_the_records_of_a_job_are_read_one_after_another(in_two_jobs) -> None:
    results, records = in_two_jobs
    for folder, expected in zip(_parts(results), (records[1::2], records[0::2]), strict=True):
        found = dict(read_part(folder))
        assert list(found) == [record.id for record in expected]
        for record in expected:
            again = assess_record(record, _study())
            for each in (PulseRow, ComparisonRow, FailureRow):
                lines = [
                    list(csv_lines(each, getattr(one, each.table.name))) for one in (found[record.id], again)
                ]
                assert lines[0] == lines[1]


def test_rows_out_of_place_are_said(in_two_jobs) -> None:
    folder = _parts(in_two_jobs[0])[1]
    rows = list(read_rows(PulseRow, folder / "pulses.csv"))
    write_rows(PulseRow, reversed(rows), folder / "pulses.csv")
    with pytest.raises(RockingError, match=r"pulses\.csv holds one out of place"):
        list(read_part(folder))


def test_the_tables_of_one_record_are_those_that_it_has_alone(in_two_jobs, tmp_path: Path) -> None:
    results, records = in_two_jobs
    for record in records:
        written = copy_tables(results, record.id, tmp_path / "copy" / record.id)
        assert [path.name for path in written] == [each.table.file_name for each in PER_RECORD]
        _assessed(record, _study(), tmp_path / "alone")
        for path in written:
            if path.name != "timings.csv":
                assert path.read_bytes() == (tmp_path / "alone" / path.name).read_bytes()
    with pytest.raises(RockingError, match="holds no tables of 'four'"):
        copy_tables(results, "four", tmp_path)


def test_a_job_that_breaks_off_leaves_nothing(tmp_path: Path) -> None:
    class Broken(Block):
        def mechanism(self) -> None:
            raise MemoryError

    with pytest.raises(MemoryError):
        assess_records(
            [_record(tmp_path)], _study(broken=Broken(1.0, 0.2)), tmp_path / "part", tmp_path / "log"
        )
    assert not list((tmp_path / "part").iterdir())


def test_parts_of_jobs_that_are_no_more_are_removed(in_two_jobs) -> None:
    results, _ = in_two_jobs
    (part(results, "mine") / "notes.txt").parent.mkdir()
    remove_other_parts(results, ["00001_of_00002"])
    assert {path.name for path in part(results, "").iterdir()} == {"00001_of_00002", "mine"}
    assert {path.stem for path in part(results, "00001_of_00002").iterdir()} == {
        each.table.name for each in IN_PARTS
    }


def test_the_error_of_each_method_is_against_the_mechanism_on_the_record(tmp_path: Path) -> None:
    study = _study(stout=Block.of_size(1.0, 3.0))
    maxima = {row.method: row for row in assess_record(_record(tmp_path), study).maxima}
    reference = maxima.pop(Method.MECHANISM_ON_RECORD)
    assert 0 < reference.rotation_ratio < 1, "the record was made so that the block rocks"
    assert math.isnan(reference.error)
    for row in maxima.values():
        if not math.isnan(row.error):
            assert row.error == pytest.approx(row.rotation_ratio / reference.rotation_ratio - 1, rel=1e-12)
    closed = maxima[Method.CLOSED_FORM]
    assert not math.isnan(closed.error) or closed.rotation_ratio in (0, math.inf)


def test_the_structures_table_carries_the_block_of_the_closed_form() -> None:
    """λ = tan α, φ_cr = α and p² = 3g/4R of a single block, in numbers that were worked out by hand."""
    (row,) = structure_rows({"block": Block.of_size(0.5, 3.0)})
    assert row.uplift_multiplier == pytest.approx(0.5 / 3.0, rel=1e-14)
    assert row.critical_rotation_rad == pytest.approx(0.16514867741462683, rel=1e-14)
    assert row.frequency_parameter_rad_s == pytest.approx(
        (0.75 * 9.80665 / 1.5206906325745548) ** 0.5, rel=1e-14
    )


def _followed(tables):
    """The integrations."""
    return [row for row in tables.maxima if row.steps is not None]


def test_auto_computes_what_settles_the_verdict_and_a_report_everything(tmp_path: Path) -> None:
    record = _record(tmp_path, "good")
    for reports, methods in ((False, 1), (True, 4)):
        settings = Settings(fidelity="auto", reports=reports)
        tables = assess_record(record, Study({"block": Block(1.0, 0.2)}, settings))
        assert {row.structure for row in tables.comparison} == {"block"}
        assert len({row.method for row in _followed(tables)}) <= methods
        assert bool(tables.comparison[0].answer_reason) is not reports
    assert len({row.method for row in _followed(tables)}) > 1
