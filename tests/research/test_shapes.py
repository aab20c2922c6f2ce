"""The fit of each shape of pulse finds the one that was planted, and tells the shapes apart."""

import math

import numpy as np
import pytest

from docs.research.shapes import BAND, SHAPES, Case, fitted, scores_of
from rocking import Accelerogram, Pulse

STEP = 0.01
TIMES = np.arange(3000) * STEP


@pytest.mark.parametrize("shape", SHAPES)
def test_a_planted_pulse_is_found_by_its_shape_and_explains_all(shape):
    cycles, phase = SHAPES[shape]
    frequency = BAND[0] * 2 ** (60 / 24)  # on the grid
    planted = Pulse(
        amplitude=-2.0, circular_frequency=2 * math.pi * frequency, start_time=6.0, cycles=cycles, phase=phase
    )
    record = Accelerogram(planted.acceleration(TIMES), STEP)
    found = {name: fitted(record, *SHAPES[name]) for name in SHAPES}
    own = found[shape]
    # 118 samples a cycle: of a cosine, which jumps at both ends, the window holds up to two that the pulse does not
    assert own.pulse.amplitude == pytest.approx(-2.0, rel=0.02)
    assert own.pulse.start_time == pytest.approx(6.0, abs=STEP)
    assert own.explained == pytest.approx(1.0, abs=0.02)
    assert own.explained == max(item.explained for item in found.values())


def test_a_verdict_is_wrong_where_one_falls_and_the_other_does_not():
    cases = [
        Case(
            "a",
            "one",
            math.inf,
            {"one sine": 0.4, "half sine": 0.2},
            {"one sine": 0.3, "half sine": math.inf},
        ),
        Case("b", "other", 0.5, {"one sine": 0.4, "half sine": 0.2}, {"one sine": 0.4, "half sine": 0.5}),
    ]
    scores = {(score.subject, score.part, score.measure): score.value for score in scores_of(cases)}
    assert scores["one sine", "all records", "wrong verdicts"] == 0.5
    assert scores["one sine", "all records", "unsafe verdicts"] == 0.5
    assert scores["one sine", "all records", "median error of the rotation"] == pytest.approx(0.2)
    assert scores["half sine", "all records", "wrong verdicts"] == 0.0
    assert scores["the best of each record", "all records", "wrong verdicts"] == 0.5
