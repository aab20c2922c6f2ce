"""Error against time: which cases are tried, what a row says, and what the figure shows."""

import json
import math

import numpy as np
import pytest

from rocking.assessment.assess import Method
from rocking.assessment.rows import TradeRow
from rocking.calibration.accuracy import (
    SCIPY_METHODS,
    SCIPY_TOLERANCES,
    TOLERANCES,
    TradeCase,
    TradeSettings,
    choose_cases,
    strongest_stretch,
    trade_rows,
    write_trade,
)
from rocking.errors import ConfigurationError, RecordError
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.reports.summary.trade_figures import write_trade_figure
from rocking.structures import Block, Wall
from rocking.tables import frame, read_rows

STEP = 0.02
BLOCK, WALL = Block(1.0, 0.2), Wall(1.5, 1.5, 0.16)
STRUCTURES = {"block": BLOCK, "wall": WALL}


def record(peak: float, frequency: float = 1.2, count: int = 80) -> Accelerogram:
    """Two cycles that swell and fade, with a higher tone on top."""
    times = np.arange(count) * STEP
    shape = np.sin(np.pi * times / times[-1]) ** 2
    return Accelerogram(
        peak
        * shape
        * (np.sin(2 * np.pi * frequency * times) + 0.3 * np.sin(2 * np.pi * 3.1 * frequency * times)),
        STEP,
        component="H1",
    )


@pytest.fixture(scope="module")
def rows():
    motion = record(3.0)
    case = TradeCase("one", motion, "block", BLOCK.mechanism(), 1.0)
    return list(trade_rows(case, TradeSettings()))


def test_every_method_is_measured(rows):
    expected = [("reference", 1e-12), (Method.PRINTED, None), (Method.CLOSED_FORM, None)]
    expected += [(Method.BLOCK_ON_RECORD, None)]
    expected += [(Method.MECHANISM_ON_RECORD, tolerance) for tolerance in TOLERANCES]
    expected += [(f"scipy {method}", rtol) for rtol in SCIPY_TOLERANCES for method in SCIPY_METHODS]
    found = [(r.method, None if math.isnan(r.tolerance) else r.tolerance) for r in rows]
    assert found == expected
    assert min(TOLERANCES) == pytest.approx(1e-10)
    assert max(TOLERANCES) == pytest.approx(1e-2)
    assert all(row.duration_s > 0 for row in rows)


def test_the_mechanism_keeps_three_times_its_tolerance(rows):
    for row in rows:
        if row.method == Method.MECHANISM_ON_RECORD:
            assert row.error <= 3 * row.tolerance


def test_eq_15_without_a_number_counts_as_overturning(rows):
    """Here its radicand is negative, which the paper reads as overturning; the block only rocks."""
    printed = next(row for row in rows if row.method == Method.PRINTED)
    assert math.isinf(printed.rotation_ratio)
    assert printed.verdict_agrees is False


def test_errors_are_those_of_the_numbers_beside_them(rows):
    for row in rows:
        assert 0 < row.reference_rotation_ratio < 1
        if row.verdict_agrees:
            ratio = row.rotation_ratio / row.reference_rotation_ratio
            assert row.error == pytest.approx(abs(ratio - 1), abs=1e-15)


def test_the_closed_form_errs_where_the_pulse_is_not_the_record(rows):
    """The record is no sine pulse, so a closed form that is exact for one cannot be right to 1e-6."""
    closed = next(row for row in rows if row.method == Method.CLOSED_FORM)
    assert not closed.error < 1e-6


def test_a_case_beyond_its_budget_says_so():
    case = TradeCase("one", record(3.0, count=2000), "wall", WALL.mechanism(), 1.0)
    settings = TradeSettings(budget_s=1.0)
    (row,) = trade_rows(case, settings)
    assert row.method == "reference"
    assert "budget" in row.reason
    assert math.isnan(row.error)


def test_the_strongest_stretch_holds_most_energy():
    acceleration = np.concatenate([np.full(50, 0.1), np.full(30, 2.0), np.full(50, 0.1)])
    stretch = strongest_stretch(Accelerogram(acceleration, STEP), 30)
    assert stretch.acceleration.tolist() == [2.0] * 30
    assert stretch.time_step == STEP
    whole = Accelerogram(acceleration, STEP)
    assert strongest_stretch(whole, 1000) is whole


def test_cases_begin_with_the_most_sensitive_and_cover_the_structures():
    motions = [(f"r{k}", record(2.5 + 0.1 * k)) for k in range(6)]
    found = {
        (name, label): abs(integrate(structure, motion, sensitivity=True).sensitivity)
        for name, motion in motions
        for label, structure in STRUCTURES.items()
    }
    cases = choose_cases(motions, STRUCTURES, 5, 100)
    sensitive = max((key for key in found if math.isfinite(found[key])), key=lambda key: found[key])
    assert (cases[0].record, cases[0].structure) == sensitive
    assert {case.structure for case in cases} == set(STRUCTURES)
    assert len({(case.record, case.structure) for case in cases}) == len(cases) == 5
    again = choose_cases(motions, STRUCTURES, 5, 100)
    assert [(c.record, c.structure) for c in cases] == [(c.record, c.structure) for c in again]


def test_a_record_that_cannot_be_read_costs_no_other(tmp_path):
    def broken():
        raise RecordError("b.AT2: 3 samples are missing.")

    records = {"a": lambda: [record(3.0)], "b": broken}
    table, log = tmp_path / "trade.csv", tmp_path / "trade.log"
    write_trade(records, {"block": BLOCK}, TradeSettings(cases=2), table, log)
    assert "b: b.AT2: 3 samples are missing." in log.read_text(encoding="utf-8")
    assert {row.record for row in read_rows(TradeRow, table)} == {"a"}
    described = json.loads(table.with_suffix(".json").read_text(encoding="utf-8"))["resources"][0]
    assert [field["name"] for field in described["schema"]["fields"]] == list(frame(TradeRow, table))

    figures = [tmp_path / "trade.pdf", tmp_path / "trade.svg"]
    write_trade_figure(table, *figures)
    first = [figure.read_bytes() for figure in figures]
    assert first[0].startswith(b"%PDF")
    for name in (
        "Eq. 15 as printed",
        "closed form, exact",
        "mechanism on the record",
        "scipy RK45",
        "1 cases",
        "wrong verdict in 1 of 1",
    ):
        assert name in first[1].decode()
    write_trade_figure(table, *figures)
    assert [figure.read_bytes() for figure in figures] == first


def test_nothing_that_rocks_still_gives_a_table_and_a_figure(tmp_path):
    write_trade(
        {"a": lambda: [record(0.1)]}, {"block": BLOCK}, TradeSettings(), tmp_path / "t.csv", tmp_path / "log"
    )
    assert list(read_rows(TradeRow, tmp_path / "t.csv")) == []
    write_trade_figure(tmp_path / "t.csv", tmp_path / "t.svg")
    assert "0 cases" in (tmp_path / "t.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize("wrong", [{"cases": 0}, {"samples": 5}, {"budget_s": 0.0}])
def test_settings_out_of_range_are_refused(wrong):
    with pytest.raises(ConfigurationError, match=next(iter(wrong))):
        TradeSettings(**wrong)
