"""The report of the validation: its numbers are those of the tables, and a lost comparison is said."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from docs.research.validation.report import _verdict, validation_data, validation_report
from docs.research.validation.rows import (
    ROW_CLASSES,
    ConfusionRow,
    FailureRow,
    IdentifiedRow,
    MemberRow,
    PredictionRow,
    ReliabilityRow,
    ScoreRow,
    TimingRow,
)
from rocking.tables import write_rows

OURS = ScoreRow(
    specimen=1, method="identified population", tests=40, motions=8, accuracy=0.925, accuracy_low=0.85,
    accuracy_high=0.975, brier=0.0625, brier_low=0.04, brier_high=0.09, missed=2, false=1, accuracy_gain=0.0,
    accuracy_gain_low=0.0, accuracy_gain_high=0.0, brier_gain=0.0, brier_gain_low=0.0, brier_gain_high=0.0,
    calibration_slope=1.03, logit_slope=1.1,
)  # fmt: skip
THRESHOLD = replace(
    OURS, method="threshold on peak velocity", accuracy=0.85, brier=0.15, accuracy_gain=0.075,
    brier_gain=0.0875, brier_gain_low=0.02,
)  # fmt: skip
TIMING = TimingRow(specimen=1, tests=40, members=21, duration_s=0.00123)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    rows = {
        ScoreRow: [OURS, THRESHOLD],
        ReliabilityRow: [
            ReliabilityRow(specimen=1, tests=20, stated=0.1, observed=0.05, observed_low=0.0, observed_high=0.2),
            ReliabilityRow(specimen=1, tests=20, stated=0.9, observed=0.95, observed_low=0.8, observed_high=1.0),
        ],
        ConfusionRow: [
            ConfusionRow(
                specimen=1, lowest_peak_velocity_m_s=0.2, highest_peak_velocity_m_s=float("inf"), stood=18,
                overturned=19, missed=2, false=1,
            )
        ],
        FailureRow: [
            FailureRow(
                specimen=1, test=77, motion="A_MOTION", peak_velocity_m_s=0.25, probability=0.3, overturned=True,
                contradicted=True, candidates_right=0.4,
            )
        ],
        IdentifiedRow: [
            IdentifiedRow(
                specimen=1, parameter=name, low=0.1, median=0.2, high=0.3, prior_low=0.05, prior_high=0.4,
                mesh_low=0.15, mesh_high=0.25,
            )
            for name in (
                "uplift_multiplier_positive", "uplift_multiplier_negative", "frequency_parameter", "restitution",
            )
        ],
        MemberRow: [
            MemberRow(
                specimen=1, share=1.0, uplift_multiplier_positive=0.1, uplift_multiplier_negative=0.1,
                frequency_parameter_rad_s=4.5, restitution=0.9, unexplained=0.05, iterations=40, sharpness=1.25,
            )
        ],
        TimingRow: [TIMING],
        PredictionRow: [],
    }  # fmt: skip
    for kind in ROW_CLASSES:
        write_rows(kind, rows[kind], tmp_path / kind.table.file_name)
    return tmp_path


def test_the_report_is_a_pdf_with_the_numbers_of_the_tables(folder):
    content = validation_report(folder)
    assert content.startswith(b"%PDF")
    assert content == validation_report(folder)
    told = json.dumps(validation_data(folder), ensure_ascii=False)
    for number in ("0.925", "0.0625", "A_MOTION", "+0.087 (+0.020, +0.000)"):
        assert number in told


def test_a_won_comparison_is_told_with_its_count():
    told = _verdict([OURS, THRESHOLD], [TIMING])
    assert "sure at 95 % over 1 of 1 others" in told
    assert "21 blocks in 1.2 ms" in told


def test_a_lost_comparison_is_told():
    better = replace(THRESHOLD, accuracy=0.95)
    told = _verdict([OURS, better], [TIMING])
    assert (
        "does not win everywhere: as good or better in one of the two scores: threshold on peak velocity"
        in told
    )
