"""The tables of a record hold the counts and quantiles of its members."""

import numpy as np

from rocking.assessment import rows
from rocking.assessment.assessor import Assessor
from rocking.assessment.scene import on_the_ground
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Block


def test_the_counts_and_quantiles_of_rows_are_those_of_the_members():
    """A block that a part of its members overturns; the members are counted anew."""
    motion = Pulse(amplitude=3.5, circular_frequency=2 * np.pi / 0.8, start_time=2.0).acceleration(
        np.arange(1000) * 0.01
    )
    record = Accelerogram(motion, 0.01, component="H1")
    result = Assessor().assess("made", [record], on_the_ground({"block": Block(2.0, 0.2)}))
    (case,) = result.periods[0].cases.values()
    ratios = case.ensembles.governing.ensemble.rotation_ratios
    falls = int(np.isposinf(ratios).sum())
    assert 0 < falls < ratios.size / 2

    tables = rows.rows_of_record(result)
    for row in tables.verdicts:
        assert (row.overturning_members, row.members) == (falls, ratios.size)
        assert row.overturning_share == falls / ratios.size
        ordered = np.sort(ratios)
        assert ordered[0] <= row.rotation_ratio_low < ordered[ratios.size // 8]
        assert ordered[ratios.size // 2 - 1] <= row.rotation_ratio_median
        assert row.rotation_ratio_median <= ordered[ratios.size // 2]
        assert row.rotation_ratio_high == np.inf  # more than a twentieth of the members overturn
    (verdict,) = tables.verdicts
    assert 0 < verdict.reserve_low < verdict.reserve_median < verdict.reserve_high <= verdict.reserve_limit


def test_the_comparison_leads_with_what_is_compared_and_every_row_names_its_input():
    columns = rows.ComparisonRow.table.column_names
    assert columns[:9] == (
        "record",
        "structure",
        "component",
        "printed_rotation_ratio",
        "predicted_rotation_ratio",
        "block_on_record_rotation_ratio",
        "integrated_rotation_ratio",
        "overturning_share",
        "verdict",
    )
    of_record = (rows.RecordRow, rows.PulseRow, rows.ComparisonRow, rows.VerdictRow, rows.VariationRow)
    for kind in of_record:
        assert kind.table.column_names[-2:] == ("record_sha256", "settings_sha256")
