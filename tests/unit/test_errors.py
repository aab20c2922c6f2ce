"""Errors: the places that they are about stand before the sentence, and can be left out where they are named anyway."""

import pickle

import pytest

from rocking.errors import RecordError, UndeclaredError, about


def test_the_places_of_an_error_stand_before_its_sentence_and_no_place_is_read_out_of_it():
    with pytest.raises(RecordError) as caught, about("one"), about("a: b.AT2"):
        raise RecordError("one: is no number.")
    error = caught.value
    assert str(error) == "one: a: b.AT2: one: is no number."
    assert error.beside("one") == "a: b.AT2: one: is no number."
    assert error.beside("a") == str(error)


def test_an_error_keeps_its_places_from_one_process_to_another():
    error = UndeclaredError("unit is not declared.", "unit")
    error.places = ("one", "a.AT2")
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.field) == ("one: a.AT2: unit is not declared.", "unit")
