"""Errors: the places that they are about stand before the sentence, and can be left out where they are named anyway."""

import pickle

import numpy as np
import pytest

import rocking
from rocking.errors import RecordError, UndeclaredError, about
from tests.refusals import refused


def test_the_places_of_an_error_stand_before_its_sentence_and_no_place_is_read_out_of_it():
    with pytest.raises(RecordError) as caught, about("one"), about("a: b.AT2"):
        raise RecordError("one: is no number.")
    error = caught.value
    assert str(error) == "one: a: b.AT2: one: is no number."
    assert error.without_place("one") == "a: b.AT2: one: is no number."
    assert error.without_place("a") == str(error)


def test_an_error_keeps_its_places_from_one_process_to_another():
    error = UndeclaredError("unit is not declared.", unit=None)
    error.places = ("one", "a.AT2")
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.field) == ("one: a.AT2: unit is not declared.", "unit")


@pytest.mark.parametrize(
    "asked",
    [
        rocking.extract_pulses,
        rocking.record_measures,
        rocking.response_spectrum,
        lambda motion: rocking.rotd(motion, motion),
        lambda motion: rocking.follow_stack(rocking.Block(2.0, 0.2).stack(), motion),
    ],
)
def test_the_list_that_read_returns_is_refused_where_one_component_is_asked_for(asked):
    record = rocking.Accelerogram(np.sin(np.arange(100.0)), time_step=0.01)
    with pytest.raises(
        rocking.RockingError, match=r"is a list, but must be an Accelerogram; give one of its items\.$"
    ):
        asked([record])
    asked(record)


def test_a_value_of_several_lines_is_repeated_in_one():
    with pytest.raises(rocking.RockingError) as caught:
        rocking.Block(np.zeros((3, 2)), 0.2)
    assert "\n" not in str(caught.value)


def test_a_sample_beyond_all_floats_is_refused():
    with refused(rocking.RecordError, "acceleration", "list"):
        rocking.Accelerogram([10**400, 0], time_step=0.01)
