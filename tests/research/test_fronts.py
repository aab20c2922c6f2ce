"""Fronts with floors: a trial is the same at every call, and shares are counted among what they are shares of."""

import numpy as np

from docs.research.fronts import FrontTrial, front, front_scores, front_trial
from docs.research.sites import SiteRecord
from rocking import Accelerogram, Pulse

PULSE = Pulse(amplitude=3.0, circular_frequency=2 * np.pi / 0.8, start_time=0.5)
RECORD = Accelerogram(PULSE.acceleration(np.arange(600) * 0.01), 0.01)
COMPONENT = SiteRecord("made", "site", "made", RECORD)


def test_a_trial_is_the_same_at_every_call_and_every_other_front_is_tied():
    trials = [front_trial(COMPONENT, place) for place in range(6)]
    assert [front_trial(COMPONENT, place) for place in range(6)] == trials
    assert [trial.is_tied for trial in trials] == [False, True] * 3
    assert all(trial.falls or not trial.falls_inwards for trial in trials)
    drawn = front(np.random.default_rng(1), True)
    assert len(drawn.tie_heights) == 1 and all(drawn.floor_loads)


def test_shares_are_counted_among_falls_outwards_and_among_what_stands():
    def trial(site, falls, inwards, one_side):
        return FrontTrial(
            record=site,
            site=site,
            earthquake=site,
            structure="front",
            scale_factor=1.0,
            is_tied=False,
            falls=falls,
            falls_inwards=inwards,
            falls_half=one_side,
            falls_seven_tenths=True,
            falls_nine_tenths=False,
        )

    trials = [
        trial("a", True, False, True),
        trial("b", True, False, False),
        trial("c", True, True, False),
        trial("d", False, False, True),
    ]
    values = {score.measure: score.value for score in front_scores(trials)}
    assert values["falls where it rocks both ways"] == 0.75
    assert values["of these, inwards"] == 1 / 3
    assert values["falls outwards both ways and not on one side, η 0.5"] == 0.5
    assert values["falls outwards both ways and not on one side, η 0.7"] == 0.0
    assert values["stands both ways and falls on one side, η 0.5"] == 1.0
    assert values["stands both ways and falls on one side, η 0.9"] == 0.0
