"""A value that is let pass without pydantic is one that pydantic lets pass, as the same value."""

import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rocking.assessment.settings import EnsembleSettings
from rocking.catalogue import CatalogueRecord
from rocking.described import Described, described_values, parts_of
from rocking.study.settings import Settings


def declared(kind: type) -> list[Described]:
    """Every described value of a class and of its parts."""
    of_parts = [item for name in parts_of(kind) for item in declared(type(getattr(kind, name)))]
    return [*described_values(kind).values(), *of_parts]


DECLARED = [*declared(Settings), *declared(CatalogueRecord)]
PLAIN = [
    *(
        Described("value", kind, "", bounds=bounds)
        for kind in (float, int)
        for bounds in ({}, {"gt": 0, "le": 2})
    ),
    *(Described("value", kind, "") for kind in (bool, str, float | None, str | float, float | str | None)),
]
VALUES = [
    *(
        value
        for number in (-1, 0, 1, 2, 3, 64, 4096)
        for value in (number, float(number), np.float64(number), str(number))
    ),
    *(
        True,
        False,
        None,
        "",
        "auto",
        "full",
        "a;b",
        math.nan,
        math.inf,
        10**400,
        -1e308,
        0.05,
        [],
        (),
        [1.0],
        {},
    ),
]


def ends(value: Described) -> list[object]:
    """The bounds of a value and their neighbours, and every choice."""
    numbers = [bound for bound in value.bounds.values() if isinstance(bound, int | float)]
    near = [float(np.nextafter(number, end)) for number in numbers for end in (-math.inf, math.inf)]
    return [*numbers, *near, *(value.one_of() if value.one_of else ())]


@pytest.mark.parametrize("value", [*DECLARED, *PLAIN], ids=lambda value: f"{value.name} {value.kind}"[:60])
def test_what_passes_without_pydantic_passes_with_it_as_the_same(value: Described) -> None:
    for given_value in (*VALUES, *ends(value)):
        if value._is_plainly_allowed(given_value):
            same = value._adapter.validate_python(given_value)
            checked = value.checked(given_value)
            assert (type(checked), repr(checked)) == (type(same), repr(same)), given_value


@given(st.floats() | st.integers() | st.text(max_size=3) | st.booleans() | st.none())
@example(10**301)
def test_the_same_of_any_value(given_value: object) -> None:
    for value in PLAIN:
        if value._is_plainly_allowed(given_value):
            same = value._adapter.validate_python(given_value)
            assert repr(value.checked(given_value)) == repr(same), (value.kind, given_value)


def test_usual_values_need_no_pydantic() -> None:
    """Numbers within their bounds, truths, choices and texts: else it is imported by every command."""
    usual = {
        "members": 256,
        "amplitude_range": 0.1,
        "polarity": False,
        "fidelity": "quick",
        "study": "A tower",
    }
    found = described_values(EnsembleSettings) | described_values(Settings)
    assert [name for name, value in usual.items() if not found[name]._is_plainly_allowed(value)] == []
