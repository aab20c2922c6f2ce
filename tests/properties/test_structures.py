"""What must hold for every structure, over random geometries."""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from kinematic_onset import kinematic_onset

from rocking.errors import RockingError
from rocking.structures.arch import Arch
from rocking.structures.arch_mechanism import NoMechanism, TooThin, limiting_thickness
from rocking.structures.arch_ring import Ring
from rocking.structures.block import RigidBody
from rocking.structures.structure_list import TYPES, structure_from_config
from rocking.structures.wall import Wall

LENGTH = st.floats(0.1, 20.0)
SHARE = st.floats(0.02, 0.98)
SLOW = {"derandomize": True, "suppress_health_check": [HealthCheck.too_slow]}


@st.composite
def arches(draw):
    """An arch anywhere between its least and its largest thickness."""
    embrace = draw(st.floats(np.radians(60), np.radians(240)))
    voussoirs = draw(st.one_of(st.none(), st.integers(5, 40)))
    ring = Ring(1.0, embrace, voussoirs)
    least, most = (limiting_thickness(ring, failure) for failure in (TooThin, NoMechanism))
    assume(least < most)
    radius = draw(st.floats(5.0, 50.0))
    return Arch(radius, radius * (least + draw(st.floats(1e-4, 0.95)) * (most - least)), embrace, voussoirs)


@settings(max_examples=8, **SLOW)
@given(arches())
def test_no_mechanism_of_the_arch_is_weaker(arch):
    """The kinematic minimum with D at the springing is the static maximum; the linkage starts at it."""
    assert arch.mechanism().uplift_multiplier == pytest.approx(arch.onset.multiplier, rel=1e-9, abs=1e-12)
    assert kinematic_onset(arch.ring).multiplier == pytest.approx(arch.onset.multiplier, rel=1e-9, abs=1e-9)


@settings(max_examples=50, **SLOW)
@given(LENGTH, SHARE, st.floats(0.05, 2.0))
def test_wall_lifts_at_twice_the_slope_of_its_lower_block(height, share, thickness):
    wall = Wall.hinged_at(height, share * height, thickness, restitution=0.9)
    assert wall.mechanism().uplift_multiplier == pytest.approx(2 * thickness / (share * height), rel=1e-12)


@settings(max_examples=50, **SLOW)
@given(st.floats(0.05, 5.0), st.floats(0.05, 5.0), LENGTH, st.floats(0.01, 50.0))
def test_momentum_balance_of_a_body_never_gains_energy(left, right, height, inertia):
    assume(inertia + height**2 > left * right)  # otherwise it is not physical, and says so
    for side in RigidBody(left, right, height, inertia).mechanism().sides:
        assert 0 <= side.restitution < 1


nasty = st.sampled_from(
    [None, "", "1", "wide", np.nan, np.inf, -1, 0, True, [], {}, 1e308, 1e-308, 1e20, 10**400, 1j, 1e-4, 1e5]
)
values = st.one_of(st.floats(0.05, 60.0), st.integers(1, 9), nasty)


@st.composite
def descriptions(draw):
    """A mapping with the keys of one form and values good and bad."""
    kind = draw(st.sampled_from(sorted(TYPES)))
    form = draw(st.sampled_from(TYPES[kind].forms()))
    return {"type": kind, **{key: draw(values) for key in form.keys if draw(st.integers(0, 9))}}


@settings(max_examples=400, **SLOW)
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
