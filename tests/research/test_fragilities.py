"""The trade of fragilities: the mechanism is its own reference, and every method stands in a row."""

import numpy as np
import pytest

from docs.research.fragilities import TradeFragilityRow, write_fragilities
from rocking.assessment.rows.of_trade import TradeMethod
from rocking.records import Accelerogram
from rocking.structures import Block
from rocking.tables import read_table

TIMES = np.arange(0, 4, 0.01)


def test_the_mechanism_is_its_own_reference(tmp_path):
    records = [
        Accelerogram(
            np.sin(2 * np.pi * TIMES / period) * (period > TIMES), 0.01, event="made", station=str(k)
        )
        for k, period in enumerate((0.6, 0.8, 1.0, 1.3))
    ]
    told: list[str] = []
    write_fragilities(records, {"block": Block(2.0, 0.15)}, tmp_path, told.append)
    rows = {row.method: row for row in read_table(TradeFragilityRow, tmp_path)}
    assert told == ["fragility of block"] and (tmp_path / "trade_fragility.json").is_file()
    assert list(rows) == ["one sine", "five sines", "block on record", "mechanism, 1e-6", "ensemble"]
    assert rows[TradeMethod.MECHANISM].error == pytest.approx(0, abs=1e-6)
    assert abs(rows[TradeMethod.ONE_SINE].error) < 0.1, "each record is one sine"
    assert all(row.stations == 4 and row.cpu_s > 0 for row in rows.values())
