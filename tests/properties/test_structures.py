"""What must hold for every structure, over random geometries."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocking.errors import RockingError
from rocking.structures.structure_list import TYPES, structure_from_config

SLOW = {"derandomize": True, "suppress_health_check": [HealthCheck.too_slow]}


nasty = st.sampled_from(
    [None, "", "1", "wide", np.nan, np.inf, -1, 0, True, [], {}, 1e308, 1e-308, 1e20, 10**400, 1j, 1e-4, 1e5]
)
values = st.one_of(st.floats(0.05, 60.0), st.integers(1, 9), nasty)


@st.composite
def descriptions(draw):
    """A mapping with the keys of one form and values good and bad."""
    kind = draw(st.sampled_from(sorted(TYPES)))
    form = draw(st.sampled_from(TYPES[kind]))
    return {"type": kind, **{key: draw(values) for key in form.keys if draw(st.integers(0, 9))}}


@settings(max_examples=4 * settings.default.max_examples, **SLOW)
@given(descriptions())
@pytest.mark.filterwarnings("ignore::rocking.errors.StructureWarning")
def test_a_description_makes_a_structure_or_one_sentence(mapping):
    try:
        structure = structure_from_config(mapping)
        mechanism = structure.mechanism()
    except RockingError as error:
        assert str(error).endswith(".")
        assert "\n" not in str(error)
    else:
        assert mechanism.uplift_multiplier > 0
        assert len(structure.outline(0.5 * mechanism.critical_rotation)) > 0
        for side in mechanism.sides:  # G restores up to φ_cr and topples beyond it; I and B stay positive
            before = np.linspace(0, 0.999, 40) * side.critical_rotation
            after = np.linspace(side.critical_rotation, side.end_rotation, 40)[1:]
            assert (side.gravity(before) > 0).all() and (side.gravity(after) < 0).all()
            assert (side.inertia(np.append(before, after)) > 0).all() and (side.ground(before) > 0).all()
            assert np.isfinite(side.inertia_slope(np.append(before, after))).all()
