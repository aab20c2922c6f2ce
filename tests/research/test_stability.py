"""Words beside those of many members: what a trial holds, and what its scores count."""

from dataclasses import replace

import numpy as np
import pytest

from docs.research import stability
from docs.research.stability import KINDS, StabilityTrial, stability_scores, stability_trials
from rocking.assessment.decide import Verdict, step
from rocking.records import Accelerogram
from rocking.structures import Block, Spire, Wall

TIMES = np.arange(0, 4, 0.01)
PAIR = [
    Accelerogram(peak * np.sin(2 * np.pi * TIMES / period) * (TIMES < 2), 0.01, component)
    for component, peak, period in (("EW", 3.0, 0.8), ("NS", 2.0, 0.5))
]
PAIR[1] = replace(PAIR[1], acceleration=np.append(PAIR[1].acceleration, 0.0))  # as files end


def test_a_trial_holds_the_word_of_its_own_share(monkeypatch):
    monkeypatch.setattr(stability, "MEMBERS", 256)
    structures = {"block": Block(2.0, 0.2), "wall": Wall.of_size(4.0, 0.4)}
    trials = list(stability_trials("a site", "an earthquake", PAIR, structures))
    assert [one_trial.kind for one_trial in trials] == [kind for kind in KINDS for _ in range(2)]
    for trial in trials:
        if trial.structure == "block":
            assert trial.true_verdict is step(
                falls=round(256 * trial.true_share), members=256, farthest=np.inf
            )
            assert abs(trial.share - trial.true_share) <= 4 / 64
            assert trial.members in (16, 64, 256, 1024)
    assert list(stability_trials("a site", "an earthquake", PAIR, structures)) == trials


def test_what_contact_dynamics_says_is_not_held_against_members(monkeypatch):
    """The courses of a spire that lifts may be thrown, which no number of members of its mechanisms tells."""
    monkeypatch.setattr(stability, "MEMBERS", 64)
    trials = list(stability_trials("a site", "an earthquake", PAIR, {"spire": Spire(3.0, 15.0, 0.25)}))
    limited = [trial for trial in trials if trial.verdict is not trial.of_members]
    assert limited and all(abs(part.classes_off) <= 1 for part in limited)


def test_a_site_on_which_the_rule_was_chosen_takes_no_part_under_another_name():
    ew, ns = (replace(component, event="Manjil", station="Abbar") for component in PAIR)
    renamed = replace(ew, station="Mangil")
    other = replace(ns, station="Rudbar")
    left = stability.left_out_of([("a", ew), ("b", ns)], [("c", renamed), ("d", other.scaled(2.0))])
    assert [part.identifier for part in left] == ["d"]


def test_the_scores_count_what_they_name():
    base = {"record": "r", "structure": "block", "scale_factor": 1.0, "kind": "pair", "members": 64}
    base |= {"earthquake": "one", "verdict": Verdict.UNCERTAIN, "share": 0.5, "true_share": 0.5}
    first = StabilityTrial(site="a", of_members=Verdict.UNCERTAIN, true_verdict=Verdict.UNCERTAIN, **base)
    unsafe = replace(first, site="b", of_members=Verdict.PROBABLY_STANDS)
    worse = replace(first, site="c", of_members=Verdict.STANDS, true_share=0.4)
    safe = replace(first, site="d", of_members=Verdict.OVERTURNS)
    sure = replace(first, site="e", of_members=Verdict.STANDS, true_verdict=Verdict.STANDS, true_share=0.0)
    held = replace(sure, site="f", verdict=Verdict.CANNOT_OVERTURN)
    untold = replace(
        first, site="g", verdict=Verdict.CANNOT_BE_TOLD, true_verdict=None, share=np.nan, true_share=np.nan
    )
    found = {
        row.measure: row.value
        for row in stability_scores([first, unsafe, worse, safe, sure, held, untold])
        if row.part == "all"
    }
    assert found == pytest.approx(
        {
            "share that cannot be told": 1 / 7,
            "share in the class of its word (0.95 is asked)": 3 / 6,
            "the same where members disagree": 1 / 4,
            "one class off on the unsafe side": 1 / 6,
            "two classes off on the unsafe side or more (0 is asked)": 1 / 6,
            "off on the safe side": 1 / 6,
            "members of all cracks": 64,
        }
    )
    assert replace(held, true_share=0.1).classes_off == -np.inf
