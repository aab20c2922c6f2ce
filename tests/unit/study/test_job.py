"""A study of records: what fails becomes a row, and costs neither its record nor the others."""

import hashlib
import json
import os
import re
from dataclasses import replace
from itertools import chain
from pathlib import Path

import numpy as np
import pytest

from rocking.assessment.assess import assess
from rocking.assessment.rows import (
    RECORD_TABLES,
    ComparisonRow,
    FailureRow,
    HistoryRow,
    PulseRow,
    RecordRows,
    TimingRow,
)
from rocking.assessment.scene import on_the_ground
from rocking.catalogue.catalogue import CatalogueRecord
from rocking.errors import ConfigurationError, RecordError, RockingError
from rocking.motion import integrate
from rocking.products.trade.rows import TradeMethod, TradeRow
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.reports.explore import RECORD_SCRIPT
from rocking.structures import Block
from rocking.study.job import Study, assess_catalogued, rows_of
from rocking.study.kept import Kept, keep, kept_in
from rocking.study.outputs import STEPS, kept_of, outcome_of, outputs_of, store_of
from rocking.study.own_files import OwnStation, assess_stations
from rocking.study.plan import MADE_FROM
from rocking.study.selection import opened
from rocking.study.settings import Settings, StudyTrade, settings_sha256
from rocking.study.summary import summarise
from rocking.study.summary_tables import write_summary
from rocking.tables import csv_lines, frame, read_rows, write_tables
from tests.refusals import refused
from tests.synthetic import SHIPPED, SyntheticRecord, at2_text
from tests.unit.assessment.made_rows import Impossible, filled
from tests.unit.study.made_jobs import keep_nothing, made_job, outcomes_in, take, worked

ROOT = Path(__file__).parents[3]
CONTENT = at2_text(SyntheticRecord(name="made", seed=1)).encode()


def _study(**structures: object) -> Study:
    settings = Settings(candidates=0, processing_variants=False, reports=False)
    return Study(on_the_ground(structures or {"block": Block.of_size(0.5, 3.0)}), settings, "made")


def _record(folder: Path, identifier: str = "made", content: bytes = CONTENT) -> CatalogueRecord:
    (folder / f"{identifier}.AT2").write_bytes(content)
    sha256 = hashlib.sha256(content).hexdigest()
    return CatalogueRecord(identifier, f"{identifier}.AT2", sha256, unit="g", folder=folder)


def _rows(record: CatalogueRecord, study: Study, opened=None) -> RecordRows:
    return rows_of(assess_catalogued(record, study, opened), record, study)


def _by_one_hash(text: str) -> str:
    """The text of a table with the hash of all settings in place of that of the step of pulses."""
    of_pulses = settings_sha256(_study().settings.only(MADE_FROM["pulses"]), {})
    return text.replace(of_pulses, _study().settings_sha256)


def _assessed(record: CatalogueRecord, study: Study, folder: Path) -> list[str]:
    """Write the tables of `record` into `folder` and return the sentences of what failed."""
    rows = _rows(record, study)
    write_tables(rows.tables, folder)
    return [failure.message for failure in rows.failures]


def test_a_structure_that_fails_does_not_take_the_record_with_it(tmp_path: Path) -> None:
    study = _study(impossible=Impossible(), block=Block.of_size(0.5, 3.0))
    assert _assessed(_record(tmp_path), study, tmp_path / "out") == ["it cannot stand."]
    (failure,) = read_rows(FailureRow, tmp_path / "out" / "failures.csv")
    assert (failure.structure, failure.stage) == ("impossible", "responses")
    assert _assessed(_record(tmp_path), _study(), tmp_path / "alone") == []
    for name in ("comparison.csv", "pulses.csv"):
        assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "alone" / name).read_bytes()


def test_a_record_that_fails_has_all_its_tables_and_says_why(tmp_path: Path) -> None:
    record = _record(tmp_path, content=b"not a record")
    (sentence,) = _assessed(record, _study(), tmp_path / "out")
    assert "made.AT2" in sentence
    for row_class in RECORD_TABLES:
        rows = frame(row_class, tmp_path / "out" / row_class.table.file_name)
        assert len(rows) == (1 if row_class.table.name in ("failures", "timings") else 0), (
            row_class.table.name
        )


def test_a_record_that_fails_has_every_output_of_its_rules_and_keeps_what_was_kept(tmp_path: Path) -> None:
    """Else its job would fail, and end the run of all others."""
    study = replace(_study(), settings=replace(_study().settings, reports=True))
    job = worked([_record(tmp_path, content=b"not a record")], study, tmp_path / "results")
    for step in STEPS:
        outputs = outputs_of(step, job.plan.settings, "made")
        assert [path for path in outputs.values() if not path.is_file()] == []
    kept = store_of(job.results, "integrate", "made")
    worked([_record(tmp_path)], study, tmp_path / "results")
    whole = kept.read_bytes()
    worked([_record(tmp_path, content=b"not a record")], study, tmp_path / "results")
    assert kept.read_bytes() == whole


def test_no_source_loads_more_than_data() -> None:
    """No pickle, no YAML loader but a safe one, no eval: neither in the package nor in the workflow."""
    forbidden = re.compile(
        r"import pickle|pickle\.load|allow_pickle=True|yaml\.(unsafe_load|full_load|Loader|FullLoader|UnsafeLoader)|"
        r"yaml\.load\(|(?<![\w.])(eval|exec)\(|os\.system\(|shell=True"
    )
    roots = (ROOT / "rocking", ROOT / "workflow")
    sources = [path for root in roots for end in ("py", "smk") for path in root.rglob(f"*.{end}")]
    assert len(sources) > 50
    assert not [path for path in sources if forbidden.search(path.read_text(encoding="utf-8"))]


@pytest.fixture
def of_four(tmp_path: Path) -> tuple[Path, list[CatalogueRecord]]:
    """Results of four records, one of which is none, and the records in the order of their catalogue."""
    contents = {"one": CONTENT, "bad": b"no record", "three": CONTENT, "two": CONTENT}
    records = [_record(tmp_path, name, content) for name, content in contents.items()]
    worked(records[::-1], _study(), tmp_path / "results")
    return tmp_path / "results", records


def test_the_summary_holds_every_row_of_every_record_in_its_order(of_four) -> None:
    results, records = of_four
    write_summary(outcomes_in(results, records), Study({}), results / "summary")
    for row_class in (PulseRow, ComparisonRow, FailureRow):
        found = [getattr(_rows(record, _study()), row_class.table.name) for record in records]
        lines = list(csv_lines(row_class, chain.from_iterable(found)))
        written = (results / "summary" / row_class.table.file_name).read_text(encoding="utf-8")
        assert "".join(lines) == _by_one_hash(written)
        assert row_class is FailureRow or len(lines) > 3


def test_an_outcome_holds_the_rows_to_the_last_digit(of_four) -> None:
    results, records = of_four
    for record in records:
        kept = next(outcomes_in(results, [record])).rows
        computed = _rows(record, _study()).tables
        assert set(kept) == set(computed)
        for row_class in set(kept) - {TimingRow}:
            lines = "".join(csv_lines(row_class, kept[row_class]))
            assert _by_one_hash(lines) == "".join(csv_lines(row_class, computed[row_class])), row_class


@pytest.mark.parametrize("damaged", [b"", b"{", b"[]", b'{"rows": {}}'])
def test_a_damaged_outcome_is_told_with_its_path(of_four, damaged) -> None:
    path = outcome_of(of_four[0], "one")
    path.write_bytes(damaged)
    with refused(RockingError, "path", path):
        kept_in(path, RECORD_TABLES)


@pytest.mark.parametrize("in_summary", [False, True])
def test_a_summary_draws_the_trade_where_its_study_measures_it(tmp_path, monkeypatch, in_summary) -> None:
    """Whether or not an earlier run has left its rows."""
    trades: list[list] = []
    monkeypatch.setattr(
        "rocking.reports.summary.summary_data",
        lambda *values: trades.append(values[5]) or {},
    )
    monkeypatch.setattr("rocking.reports.printing.compile_document", lambda *_: b"")
    results = tmp_path / "results"
    changed = {"reports": True, "trade": StudyTrade(in_summary=in_summary), "results": str(results)}
    study = replace(_study(), settings=replace(_study().settings, **changed))
    job = worked([_record(tmp_path)], study, results)
    row = filled(
        TradeRow,
        method=TradeMethod.MECHANISM,
        preparation_record_s=1e-3,
        cases=1,
        wrong_verdicts=0,
        unsafe_verdicts=0,
        falls=0,
        falls_found=0,
        false_alarms=0,
        stations=1,
        earthquakes=1,
        error=1e-7,
        cpu_s=1e-3,
    )
    fault = filled(FailureRow, record="", structure="pier", stage="fault", message="a fault.")
    keep(kept_of(results, "trade"), Kept({TradeRow: [row], FailureRow: [fault]}))
    keep_nothing(results, "map")
    summarise(job)
    assert len(trades[0]) == in_summary
    assert kept_in(job.kept, ()).opened[0] == "summary/summary.pdf"
    told = read_rows(FailureRow, results / "summary" / "failures.csv")
    assert [(fault.structure, fault.message) for fault in told] == [("pier", "a fault.")] * in_summary


def test_the_tables_of_one_record_are_those_that_it_has_alone(of_four, tmp_path: Path) -> None:
    results, records = of_four
    for record in records:
        _assessed(record, _study(), tmp_path / "alone")
        for row_class in {*RECORD_TABLES} - {TimingRow}:
            name = row_class.table.file_name
            assert (results / record.id / name).read_bytes() == (tmp_path / "alone" / name).read_bytes()


class Broken(Block):
    error: type[BaseException] = MemoryError

    def mechanism(self) -> None:
        raise self.error("of the machine")


class Faulty(Broken):
    error = ZeroDivisionError


def test_a_job_that_breaks_off_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(MemoryError):
        worked([_record(tmp_path)], _study(broken=Broken(1.0, 0.2)), tmp_path / "results")
    left = {path.name for path in (tmp_path / "results").rglob("*.json")}
    assert left == {"motion.json", "pulses.json", "made.json"}, "of the steps before it"


def test_a_fault_of_this_package_costs_no_other_record_and_asks_to_be_reported(tmp_path, monkeypatch) -> None:
    """Whatever is raised becomes a row of its structure, and the traceback stands in the log that the row names."""
    results = tmp_path / "results"
    records = [_record(tmp_path, "first"), _record(tmp_path, "second")]
    job = made_job(records, _study(faulty=Faulty(1.0, 0.2)), results)
    monkeypatch.setattr("rocking.errors.LOGS", [job.log])
    results.mkdir()
    take(records[0], job)
    take(records[1], replace(job, study=replace(job.study, scenes=_study().scenes)))
    monkeypatch.setattr(Study, "open", lambda *_: 1 / 0)
    records.append(_record(tmp_path, "third"))
    take(records[2], job)
    first, second, third = (outcome.rows for outcome in outcomes_in(results, records))
    assert "ZeroDivisionError: division by zero" in third[FailureRow][0].message
    assert {failure.structure for failure in first[FailureRow]} == {"faulty"}
    for failure in first[FailureRow]:
        assert "faulty (ZeroDivisionError: of the machine)" in failure.message
        assert str(job.log) in failure.message
    assert "ZeroDivisionError: of the machine" in job.log.read_text() and "Traceback" in job.log.read_text()
    assert not second[FailureRow] and second[ComparisonRow]


@pytest.mark.parametrize("fidelity", ["standard", "quick"])
def test_a_pair_has_the_ensemble_over_its_directions_that_assess_has(tmp_path: Path, fidelity: str) -> None:
    times = np.arange(0, 4, 0.01)
    waves = [a * np.sin(7 * times) * np.exp(-((times - 1.5) ** 2)) for a in (3.0, 4.0)]
    pair = [Accelerogram(wave, 0.01, name) for wave, name in zip(waves, "xy", strict=True)]
    block = Block(2.0, 0.2, restitution=0.9)
    study = _study(block=block)
    study = replace(study, settings=replace(study.settings, fidelity=fidelity))
    (both,) = _rows(_record(tmp_path), study, (pair, None)).verdicts
    joined = assess(pair, block)
    assert both.component == "both" and both.verdict is joined.verdict
    if fidelity == "standard":
        same = ("members", "overturning_members", "rotation_ratio_low", "rotation_ratio_high")
        assert all(getattr(both, name) == getattr(joined, name) for name in same)


def test_a_job_reads_each_file_once_and_writes_all_from_what_it_has(tmp_path: Path, monkeypatch) -> None:
    """Report, tables beside it, histories and the page come from the responses of the tables."""
    record, study = _record(tmp_path, "made"), _study()
    study = replace(study, settings=replace(study.settings, reports=True, histories=True))
    opened, real = [], os.open
    monkeypatch.setattr(
        os, "open", lambda path, *more, **named: opened.append(str(path)) or real(path, *more, **named)
    )
    worked([record], study, tmp_path / "results")
    assert opened.count(str(tmp_path / "made.AT2")) == 1
    folder = tmp_path / "results" / "made"
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
    assert {row_class.table.file_name for row_class in RECORD_TABLES} <= {
        path.name for path in folder.iterdir()
    }
    (outcome,) = outcomes_in(tmp_path / "results", [record])
    assert outcome.page["cases"]["block"]["moves"]
    own = json.loads((folder / RECORD_SCRIPT).read_text().removeprefix("rockingRecord(").removesuffix(");\n"))
    assert own["cases"]["block"]["history"] and own["motions"]


def test_a_history_is_that_of_the_response(tmp_path: Path) -> None:
    """The largest rotation lies between two steps, a thousandth below the peak at most at these periods."""
    study = _study(falls=Block.of_size(0.2, 2.0), rocks=Block.of_size(1.0, 4.0))
    study = replace(study, settings=replace(study.settings, histories=True))
    records = [_record(tmp_path), _record(tmp_path, "bad", b"no record")]
    worked(records, study, tmp_path / "results")
    assert list(read_rows(HistoryRow, tmp_path / "results" / "bad" / "histories.csv")) == []
    table = frame(HistoryRow, tmp_path / "results" / "made" / "histories.csv")
    (accelerogram,) = study.open(records[0])[0]
    for name, structure in study.structures.items():
        of_it, response = table[table["structure"] == name], integrate(structure, accelerogram)
        reached = of_it["rotation_rad"].abs().max() / structure.mechanism().critical_rotation
        if np.isfinite(response.rotation_ratio):
            assert reached == pytest.approx(response.rotation_ratio, rel=2e-3)
        else:
            assert reached > 1
        steps, rise = np.diff(of_it["time_s"]), np.diff(of_it["rotation_rad"])
        velocity, sign = of_it["angular_velocity_rad_s"].to_numpy(), np.sign(of_it["rotation_rad"].to_numpy())
        smooth = sign[1:] == sign[:-1]  # at an impact the velocity jumps; else the trapezoidal rule holds
        gained = steps * (velocity[1:] + velocity[:-1]) / 2
        assert np.abs(gained - rise)[smooth].max() <= 1e-3 * of_it["rotation_rad"].abs().max()


RAW = CatalogueRecord("STNA", "obspy:STNA.20020722.044649.evt.gz", scale_factor=50.0)
"""The Kinemetrics file that obspy installs: counts of a recorder, offset included; weak, therefore multiplied."""


def _opened(record: CatalogueRecord, apply: str = "raw") -> Accelerogram:
    settings = Settings(processing=replace(Settings().processing, apply=apply))
    return Study({}, settings).open(record)[0][0]


def test_a_processed_file_and_one_that_cannot_say_are_left_as_they_are_unless_always(tmp_path):
    (tmp_path / "a.AT2").write_text(at2_text(SHIPPED))
    values = np.sin(np.arange(4000) * 0.05) + 0.3
    (tmp_path / "c.txt").write_text("\n".join(f"{i * 0.01:.2f} {v:.6f}" for i, v in enumerate(values)))
    for record in (
        CatalogueRecord("a", "a.AT2", folder=tmp_path),
        CatalogueRecord("c", "c.txt", unit="m/s2", folder=tmp_path),
    ):
        assert _opened(record).processing == ()
        assert any("Butterworth highpass" in step for step in _opened(record, "always").processing)


def test_a_raw_file_is_processed_unless_never():
    assert len(_opened(RAW).processing) > len(_opened(RAW, "never").processing)
    assert _opened(RAW).high_pass_frequency == 0.1


@pytest.mark.parametrize(("settings", "fidelity"), [
    ({}, "standard"), ({"reports": False}, "quick"), ({"reports": False, "histories": True}, "standard"),
])  # fmt: skip
def test_what_is_drawn_is_followed_whole(settings: dict, fidelity: str) -> None:
    quick = Study({}, Settings(fidelity="quick", **settings)).assessment
    assert quick == replace(quick, fidelity=fidelity)


@pytest.mark.parametrize(("own", "of_study", "peak_g"), [
    ("pga 0.3 g", None, 0.3), (None, "pga 0.2 g", 0.2), ("pga 0.3 g", "pga 0.2 g", 0.3),
])  # fmt: skip
def test_a_record_is_scaled_as_its_row_says_and_else_the_study(tmp_path: Path, own, of_study, peak_g) -> None:
    study = Study({}, Settings(scale_to=of_study))
    horizontal, _ = study.open(replace(_record(tmp_path), scale_to=own or ""))
    assert max(record.peak_acceleration for record in horizontal) == pytest.approx(peak_g * GRAVITY)
    with pytest.raises(
        RecordError, match=r"none of 1 records could be read; the first: gone: file 'gone\.AT2' is"
    ):
        opened(study, [CatalogueRecord("gone", "gone.AT2", folder=tmp_path)])


def test_an_output_that_is_a_file_or_one_file_for_two_reports_is_refused_before_any_work(
    tmp_path: Path,
) -> None:
    station = OwnStation(_record(tmp_path), ())
    scenes = on_the_ground({"block": Block.of_size(0.5, 3.0)})
    for words, arguments in (
        ("structure is 'pier', but must be one of those in the list: block.", ("pier", None, None)),
        ("output is 'a.pdf', but is a folder; give the file as --pdf a.pdf.", (None, Path("a.pdf"), None)),
        ("but there are 2: made, made; give --output FOLDER.", (None, None, tmp_path / "a.pdf")),
    ):
        with pytest.raises(ConfigurationError) as caught:
            next(assess_stations([station, station], scenes, *arguments))
        assert words in str(caught.value)
