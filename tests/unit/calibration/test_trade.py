"""The trade of error for time: its tables, what they come down to, and the document that says which method to buy."""

import json
import math

import numpy as np
import pytest

from rocking.assessment.rows.of_trade import (
    TRADE_TABLES,
    MultiFidelityRow,
    TradeFragilityRow,
    TradeMethod,
    TradeMethodRow,
    TradeRow,
)
from rocking.calibration.multifidelity import Answers, multi_fidelity_rows, two_level_gain
from rocking.calibration.settings import TradeSettings
from rocking.calibration.trade import method_rows, pays_from, write_trade
from rocking.errors import RecordError
from rocking.records import Accelerogram
from rocking.reports.trade.report import conclusion, write_trade_report
from rocking.structures import Block, Wall
from rocking.tables import read_rows

STEP = 0.02
STRUCTURES = {"block": Block(1.0, 0.2), "wall": Wall(1.5, 1.5, 0.16)}


def record(peak: float, frequency: float, station: str) -> Accelerogram:
    """Two cycles that swell and fade, with a higher tone on top."""
    times = np.arange(120) * STEP
    shape = np.sin(np.pi * times / times[-1]) ** 2
    tones = np.sin(2 * np.pi * frequency * times) + 0.3 * np.sin(2 * np.pi * 3.1 * frequency * times)
    return Accelerogram(peak * shape * tones, STEP, component="H1", event="made", station=station)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    def broken():
        raise RecordError("b.AT2: 3 samples are missing.")

    def opener(k: int):
        return lambda: [record(2.0 + 0.2 * k, 1.0 + 0.3 * k, str(k))]

    made = tmp_path_factory.mktemp("trade")
    told: list[str] = []
    records = {f"r{k}": opener(k) for k in range(5)} | {"b": broken}
    write_trade(records, STRUCTURES, TradeSettings(cases=2, samples=80), made, told.append)
    (made / "told").write_text("\n".join(told), encoding="utf-8")
    return made


def read(folder, kind):
    return list(read_rows(kind, folder / kind.table.file_name))


def test_a_record_that_cannot_be_read_costs_no_other(folder):
    told = (folder / "told").read_text(encoding="utf-8")
    assert "b: b.AT2: 3 samples are missing." in told and "2 of 2: r" in told and "fragility of wall" in told
    assert {row.record for row in read(folder, TradeRow)} == {f"r{k}" for k in range(5)}
    described = json.loads((folder / "trade.json").read_text(encoding="utf-8"))["resources"]
    assert [each["path"] for each in described] == [kind.table.file_name for kind in TRADE_TABLES.values()]


def test_every_method_comes_down_to_a_row(folder):
    rows = {row.method: row for row in read(folder, TradeMethodRow)}
    assert list(rows) == list(TradeMethod)
    mechanism, block, sine = (
        rows[name] for name in (TradeMethod.MECHANISM, TradeMethod.BLOCK, TradeMethod.ONE_SINE)
    )
    assert mechanism.error < 1e-6 and mechanism.wrong_verdicts == 0 and mechanism.fragility_error < 1e-3
    assert mechanism.error < block.error < sine.error
    assert sine.preparation_record_s > mechanism.cpu_s, (
        "the search for the pulse takes longer than a response"
    )
    assert rows[TradeMethod.DOP853].cpu_s > 100 * mechanism.cpu_s
    assert rows[TradeMethod.MULTI_FIDELITY].fragility_structures == 2


def test_a_fragility_of_every_method_stands_at_the_same_levels(folder):
    rows = read(folder, TradeFragilityRow)
    for row in rows:
        assert row.error == pytest.approx(row.median / row.reference_median - 1)
        assert (row.records, row.stations) == (5, 5)
    by_method = {(row.structure, row.method): row for row in rows}
    assert (
        by_method["block", TradeMethod.SINES].responses == 5 * by_method["block", TradeMethod.BLOCK].responses
    )


def test_medians_leave_out_what_rests_and_what_scipy_was_given(folder):
    rows = read(folder, TradeRow)
    own = [row for row in rows if row.method == TradeMethod.BLOCK]
    (said,) = [row for row in method_rows(rows, []) if row.method == TradeMethod.BLOCK]
    moving = [row for row in own if max(row.rotation_ratio, row.reference_rotation_ratio) > 1e-3]
    assert said.cases == len(moving) and said.wrong_verdicts == sum(not row.verdict_agrees for row in moving)
    rocking = [row for row in moving if 1e-3 < row.reference_rotation_ratio < math.inf]
    assert said.error == np.median([row.error for row in rocking if not math.isnan(row.error)])


@pytest.mark.parametrize(
    ("once", "each", "dear", "least"), [(1.0, 0.1, 0.35, 5), (0.0, 0.1, 0.2, 1), (0.0, 0.2, 0.2, math.inf)]
)
def test_a_method_pays_from_the_first_number_at_which_it_costs_less(once, each, dear, least):
    assert pays_from(once, each, dear) == least
    if math.isfinite(least):
        assert once + least * each < least * dear
        assert least == 1 or once + (least - 1) * each >= (least - 1) * dear


def test_the_document_says_which_method_to_buy(folder):
    target = folder / "out"
    target.mkdir()
    files = target / "trade.pdf", target / "trade.svg"
    write_trade_report(folder, *files)
    first = [file.read_bytes() for file in files]
    assert first[0].startswith(b"%PDF") and TradeMethod.BLOCK in first[1].decode()
    write_trade_report(folder, *files)
    assert [file.read_bytes() for file in files] == first
    said = conclusion(read(folder, TradeMethodRow))
    assert said.startswith("The mechanism on the record takes") and said.endswith(".")
    assert "the closed form explains, but does not predict" in said


def test_nothing_that_rocks_still_gives_tables_and_a_document(tmp_path):
    told: list[str] = []
    still = {"a": lambda: [record(0.1, 1.0, "a")]}
    write_trade(still, {"block": STRUCTURES["block"]}, TradeSettings(), tmp_path, told.append)
    assert any("a fragility needs at least 2" in line for line in told)
    write_trade_report(tmp_path, tmp_path / "t.pdf", tmp_path / "t.svg")
    assert "every method agrees" in conclusion(read(tmp_path, TradeMethodRow))


def made_answers() -> Answers:
    """Sixty records whose block parts from the mechanism by a tenth, and a sine that knows nothing."""
    rng, levels = np.random.default_rng(0), np.geomspace(0.2, 5, 30)
    threshold = np.exp(0.5 * rng.standard_normal((60, 1)))
    block = threshold * np.exp(0.1 * rng.standard_normal((60, 1)))
    sine = np.exp(0.5 * rng.standard_normal((60, 1)))
    said = [(each < levels).astype(float) for each in (threshold, block, sine)]
    return Answers(levels, *said, mechanism_cpu=1.0, block_cpu=0.25)


def test_what_few_runs_buy_is_that_of_fewer_records():
    """The share of n of N records scatters by p(1 - p)(1/n - 1/N), whose 90 % are 3.29 wide."""
    answers = made_answers()
    rows: list[MultiFidelityRow] = list(multi_fidelity_rows("made", answers))
    assert [row.runs for row in rows] == [64, 129, 257]
    truth = answers.mechanism.mean(axis=0)
    is_open = (truth > 0.1) & (truth < 0.9)
    for row in rows:
        records = row.curve_gain * row.runs / answers.levels.size
        width = 3.29 * np.sqrt((truth * (1 - truth))[is_open] * (1 / records - 1 / 60)).mean()
        # Both widths are quantiles of 200 samples of coarse shares: a tenth each.
        assert row.curve_width == pytest.approx(width, rel=0.25)
        assert row.curve_bias < 0.1 and row.curve_gain > 4 and row.median_gain > 4
        assert row.correlation_block > 0.7 > 0.3 > row.correlation_sine


def test_two_levels_gain_what_the_best_share_of_runs_gives():
    """Against a search over shares: variance (1 - c²)/n + c²/m at the cost n + m w, over that of plain sampling."""
    correlation, cost = 0.95, 0.1
    shares = np.geomspace(1, 1e3, 100_001)
    product = ((1 - correlation**2) + correlation**2 / shares) * (1 + shares * cost)
    assert two_level_gain(correlation, cost) == pytest.approx(1 / product.min(), rel=1e-6)
