"""The trade of fragilities: the mechanism is its own reference. Their medians: a symmetric population has no bias."""

import numpy as np
import pytest

from docs.research import fragilities
from docs.research.fragilities import population_scores, trade_fragility
from docs.research.report import Target
from docs.research.scores import Score
from rocking.products.trade.measure import TradeMethod
from rocking.records import Accelerogram
from rocking.structures import Block
from rocking.tables import read_table

TIMES = np.arange(0, 4, 0.01)


def test_the_mechanism_is_its_own_reference(tmp_path):
    records = []
    for name, period in zip("abcd", (0.6, 0.8, 1.0, 1.3), strict=True):
        sine = np.sin(2 * np.pi * TIMES / period) * (period > TIMES)
        records.append((name, Accelerogram(sine, 0.01, event="made", station=name)))
    lines: list[str] = []
    trade_fragility(Target(tmp_path, lines.append, [records], {"block": Block(2.0, 0.15)}))
    rows = read_table(Score, tmp_path)
    errors = {row.subject: row.value for row in rows if row.measure == "error of the median"}
    assert lines == ["fragility of block"] and (tmp_path / "report.pdf").is_file()
    assert list(errors) == ["one sine", "five sines", "block on record", "mechanism on record", "ensemble"]
    assert errors[TradeMethod.MECHANISM] == pytest.approx(0, abs=1e-6)
    assert abs(errors[TradeMethod.ONE_SINE]) < 0.1, "each record is one sine"
    assert {row.sites for row in rows} == {4}


def test_the_median_of_a_known_population(monkeypatch):
    """Of a lognormal of median 1; 40 intervals of 90 % miss it in 4, and in ten or more once in 500 studies."""
    monkeypatch.setattr(fragilities, "STATIONS", (20,))
    monkeypatch.setattr(fragilities, "TRIALS", 40)
    monkeypatch.setattr(fragilities, "ESTIMATES", 1000)
    monkeypatch.setattr(fragilities, "MANY", 100_000)
    held, bias = population_scores("lognormal")
    assert held.value > 0.75 and held.cases == 40
    assert abs(bias.value) < 0.06, "a step of the levels"
