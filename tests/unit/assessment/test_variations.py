"""Candidates over the height and variants of the processing."""

import numpy as np
import pytest

from rocking.assessment.assess import AssessmentSettings
from rocking.assessment.ensemble import processed
from rocking.assessment.variations import candidates, processed_variants
from rocking.motion import integrate
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Block, Wall

STEP = 0.01
PULSE = Pulse(2.5, 2 * np.pi / 0.9, 3.0)
RECORD = Accelerogram(PULSE.acceleration(np.arange(2000) * STEP), STEP)
SETTINGS = AssessmentSettings()
WALL = Wall(2.0, 2.0, 0.3)


def test_the_middle_candidate_is_the_wall_itself():
    variations = candidates(WALL, RECORD, PULSE, 5, SETTINGS)
    middle = variations[2]
    assert middle.position == pytest.approx(2.0)
    assert middle.integrated_rotation_ratio == integrate(WALL, RECORD).rotation_ratio


def test_a_higher_hinge_lifts_earlier():
    # λ = 2 tan α₁ falls as the lower block grows, so a shaking that leaves low hinges shut opens high ones.
    lifted = [
        c.integrated_rotation_ratio > 0 for c in candidates(WALL, RECORD.scaled(0.8), None, 9, SETTINGS)
    ]
    assert lifted == sorted(lifted)
    assert lifted[-1]
    assert not lifted[0]


def test_processing_that_changes_nothing_changes_no_answer():
    records = processed(RECORD)
    assert "unchanged" in records
    variations = processed_variants({"": Block(2.0, 0.2)}, records, SETTINGS)[""]
    ratios = {each.processing: each.integrated_rotation_ratio for each in variations}
    assert ratios["unchanged"] == integrate(Block(2.0, 0.2), RECORD).rotation_ratio
    assert ratios["high-pass 0.2 Hz"] != ratios["unchanged"]
