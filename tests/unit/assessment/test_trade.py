"""The trade of error for time: what each row says is what the methods themselves say."""

import numpy as np
import pytest

import rocking
from rocking.assessment.rows import TradeRow
from rocking.assessment.trade import TradeMethod
from rocking.reports.trade import write_trade_report
from rocking.tables import write_tables

STRUCTURES = {"block": rocking.Block(2.0, 0.15), "stout": rocking.Block(2.0, 0.7)}


@pytest.fixture(scope="module")
def records():
    """A sine that lifts the block, one that overturns it, and one that lifts nothing."""
    times = np.arange(0, 4, 0.01)
    sine = np.where(times < 1.0, np.sin(2 * np.pi * times), 0.0)
    return [rocking.Accelerogram(peak * sine, 0.01) for peak in (2.0, 9.0, 0.2)]


@pytest.fixture(scope="module")
def rows(records):
    lines = []
    rows_of_all = rocking.trade(records, STRUCTURES, tell=lines.append)
    assert [line.partition(":")[0] for line in lines] == ["record 1", "record 2", "record 3"]
    return {(row.method, row.structure): row for row in rows_of_all}


def test_every_method_has_a_row_for_each_structure_and_for_all(rows):
    assert list(rows) == [(method, name) for name in ("", *STRUCTURES) for method in TradeMethod]


def test_errors_are_those_of_the_methods(rows, records):
    block = STRUCTURES["block"]
    reference, answer = (rocking.integrate(block, records[0], each).rotation_ratio for each in (1e-12, 1e-3))
    assert 0.001 < reference < 1
    assert rows[TradeMethod.COARSE, "block"].error == pytest.approx(abs(answer / reference - 1), rel=1e-9)
    assert rows[TradeMethod.FINE, "block"].error < 1e-6
    assert rows[TradeMethod.MECHANISM, "block"].cases == 2, "under the weakest sine it rests"
    assert rows[TradeMethod.MECHANISM, "block"].wrong_verdicts == 0


def test_times_are_told_and_the_search_for_pulses_apart(rows):
    usual = rows[TradeMethod.MECHANISM, ""].cpu_s
    for (method, _), row in rows.items():
        assert row.cpu_s > 0
        assert (row.preparation_record_s > 0) == (method in (TradeMethod.ONE_SINE, TradeMethod.SINES))
    assert rows[TradeMethod.ENSEMBLE, ""].cpu_s > usual


def test_the_report_says_what_the_table_says_in_percent_and_milliseconds(tmp_path, monkeypatch):
    documents = []
    monkeypatch.setattr(
        "rocking.reports.trade.compile_document", lambda _, data: documents.append(data) or b"%PDF"
    )
    values = {"error": 0.01234, "error_high": 0.3, "cpu_s": 0.002512, "preparation_record_s": 0.125}
    counts = {"cases": 200, "wrong_verdicts": 3, "unsafe_verdicts": 1}
    row = TradeRow(method=TradeMethod.COARSE, structure="", **values, **counts)
    write_tables({TradeRow: [row]}, tmp_path)
    write_trade_report(tmp_path, tmp_path / "trade.pdf", tmp_path / "trade.svg")
    picture, table = documents[0]["parts"]
    assert picture["conclusion"] == f"{TradeMethod.COARSE}: 2.5 ms, 3\u00a0of\u00a0200 verdicts wrong."
    assert table["rows"] == [[TradeMethod.COARSE, "all", "200", "1.2", "30", "3", "1", "2.5", "125"]]
