"""The trials on supports: every period once, the closed form under a pulse itself, and outcomes that turn back."""

import math

import numpy as np
import pytest

from docs.research.floors import BODIES, PERIODS, FloorTrial, closed_form_scores, course_scores, floor_trials
from docs.research.sites import SiteRecord
from rocking.pulses import Pulse
from rocking.records import Accelerogram


def test_trials_of_a_pulse():
    pulse = Pulse(amplitude=3.0, circular_frequency=2 * math.pi / 0.8, start_time=0.5)
    record = Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    trials = list(floor_trials(SiteRecord("made", "site", "made", record)))
    assert len(trials) == len(BODIES) * (1 + PERIODS.size)
    on_ground = [trial for trial in trials if trial.support_period_s == 0]
    assert {scene.amplification for scene in on_ground} == {1.0}
    # on the ground the record is the pulse, so that the closed form misses no more than its samples do
    for one_scene in on_ground:
        if 0.01 < one_scene.integrated_rotation_ratio < math.inf:
            assert one_scene.predicted_rotation_ratio == pytest.approx(
                one_scene.integrated_rotation_ratio, rel=0.1
            )


def trial(site: str, period: float, ratio: float, predicted: float = 0.0) -> FloorTrial:
    return FloorTrial(
        record=site,
        site=site,
        earthquake=site,
        structure="parapet",
        support_period_s=period,
        amplification=1.0,
        integrated_rotation_ratio=ratio,
        predicted_rotation_ratio=predicted,
    )


def test_the_worth_of_the_closed_form_counts_each_outcome_once():
    """Two fall, of which it sees one; three stand, of which it lets one fall, and two rock, at twice and half."""
    fall = math.inf
    outcomes = {"a": (fall, fall), "b": (fall, 0.4), "c": (0.1, fall), "d": (0.1, 0.2), "e": (0.4, 0.2)}
    trials = [trial(site, 0.3, ratio, predicted) for site, (ratio, predicted) in outcomes.items()]
    trials.append(trial("a", 0.0, 0.0))

    scores = {
        score.measure: score.value for score in closed_form_scores(trials) if score.part == "on supports"
    }
    assert scores == {
        "share that overturns": 2 / 5,
        "closed form overturns too, where it overturns": 1 / 2,
        "closed form overturns, where it stands": 1 / 3,
        "closed form over integration, median": pytest.approx((2 + 1 / 2) / 2),
    }


def test_what_turns_back_is_counted_by_site():
    trials = [trial("a", 0.0, 0.1), trial("a", 0.3, math.inf), trial("a", 0.5, 0.2)]
    trials += [trial("b", 0.0, 0.1), trial("b", 0.3, 0.1), trial("b", 0.5, math.inf)]
    scores = [one_score for one_score in course_scores([*trials]) if one_score.subject == "parapet"]
    (back,) = [score for score in scores if score.part == "over the periods"]
    assert (back.value, back.sites) == (0.5, 2)
