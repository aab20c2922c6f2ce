"""The cores of a record: what it gives is the same on any number of them, to the byte."""

import threading
import time
from contextlib import closing
from itertools import count, islice

import numpy as np
import pytest

from rocking import Accelerogram, Spire
from rocking.assessment.contacts import contact_share
from rocking.assessment.cores import in_order, on_cores
from rocking.assessment.motions import GroundMotions
from rocking.contacts.dynamics import follow_stack


@pytest.mark.parametrize("cores", [1, 2, 3])
def test_what_ends_first_comes_in_its_place_and_an_error_where_it_was_raised(cores):
    def work(item: int) -> int:
        time.sleep(0.004 * (item % 3 == 0))  # every third one ends after those behind it
        if item == 7:
            raise ValueError("seven")
        return item

    got = []
    with on_cores(cores), pytest.raises(ValueError, match="seven"):
        for result in in_order(work, range(20)):
            got.append(result)
    assert got == list(range(7))


def test_so_many_run_at_once_and_no_more_than_one_waits_for_them():
    """Both parties of a barrier have to come, which one thread alone cannot do; and nothing is begun far ahead."""
    meet = threading.Barrier(2, timeout=30)
    begun = []

    def work(item: int) -> int:
        begun.append(item)
        return meet.wait() and item

    threads = threading.active_count()
    with on_cores(2), closing(in_order(work, count())) as results:
        assert len(list(islice(results, 4))) == 4
        meet.abort()
    assert len(begun) <= 4 + 2 and threading.active_count() == threads


def test_within_a_thread_and_behind_it_one_thing_comes_after_the_other():
    """Threads that wait for threads of the same pool would wait for ever."""
    inner = lambda item: [threading.get_ident() for _ in in_order(str, range(3))]  # noqa: E731
    with on_cores(2):
        assert [len(set(result)) for result in in_order(inner, range(4))] == [1] * 4
    own = threading.get_ident()
    assert set(in_order(lambda _: threading.get_ident(), range(3))) == {own}


def test_contact_dynamics_gives_the_same_on_any_number_of_cores(monkeypatch):
    """Falls, and how many runs that took, of a spire whose stacks fall at some amplitudes and stand at others."""
    times = np.arange(0, 2, 0.01)
    wave = 10.0 * np.sin(2 * np.pi * times / 0.7) * np.exp(-(((times - 1.0) / 0.5) ** 2))
    motions = GroundMotions.of(Accelerogram(wave, 0.01))
    turns: dict[tuple[float, float], bytes] = {}

    def noted(stack, motion, step, **others):
        response = follow_stack(stack, motion, step, **others)
        found = turns.setdefault((motion.peak_acceleration, step), response.largest_turns.tobytes())
        assert found == response.largest_turns.tobytes()
        return response

    monkeypatch.setattr("rocking.assessment.contacts.follow_stack", noted)
    spire = Spire(width=3.0, height=15.0, wall_thickness=0.25, courses=4)
    shares = []
    for cores in (1, 2, 4):
        with on_cores(cores):
            shares.append(contact_share(spire, motions))
    assert shares[0] == shares[1] == shares[2] and 0 < shares[0].falls < shares[0].runs
