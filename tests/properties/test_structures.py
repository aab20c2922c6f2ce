"""What must hold for every structure, over random geometries."""

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from kinematic_onset import kinematic_onset

from rocking.errors import RockingError
from rocking.structures.arch import Arch
from rocking.structures.arch_mechanism import maximum_thickness, minimum_thickness
from rocking.structures.block import Block, RigidBody
from rocking.structures.frame import Frame
from rocking.structures.spire import Spire
from rocking.structures.structure_list import TYPES, structure_from_config
from rocking.structures.wall import Wall

LENGTH = st.floats(0.1, 20.0)
SHARE = st.floats(0.02, 0.98)
FEW = settings(max_examples=20, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
MANY = settings(
    max_examples=50, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)


@st.composite
def arches(draw):
    """An arch anywhere between its least and its largest thickness."""
    embrace = draw(st.floats(np.radians(60), np.radians(240)))
    voussoirs = draw(st.one_of(st.none(), st.integers(5, 40)))
    least, most = minimum_thickness(embrace, voussoirs), maximum_thickness(embrace, voussoirs)
    assume(least < most)
    radius = draw(st.floats(5.0, 50.0))
    return Arch(radius, radius * (least + draw(st.floats(1e-4, 0.95)) * (most - least)), embrace, voussoirs)


walls = st.builds(Wall, LENGTH, LENGTH, st.floats(0.05, 2.0), restitution=st.just(0.9))
blocks = st.builds(Block, LENGTH, st.floats(0.01, 1.5), restitution=st.just(0.9))
bodies = st.builds(RigidBody, LENGTH, LENGTH, LENGTH, st.floats(0.01, 50.0), restitution=st.just(0.9))
frames = st.builds(Frame, blocks, st.integers(2, 9), st.floats(0.0, 30.0), restitution=st.just(0.9))
spires = st.builds(
    lambda width, height, wall, plan, crack: Spire(
        width, height, wall * width / 2, plan, crack * height, 0.9
    ),
    LENGTH,
    LENGTH,
    SHARE,
    st.sampled_from(["circular", "square"]),
    SHARE,
)
structures = st.one_of(arches(), walls, blocks, bodies, frames, spires)


@MANY
@given(structures)
def test_standard_form(structure):
    """G restores up to φ_cr and topples beyond it, I and B stay positive up to there, slopes are derivatives."""
    for side in structure.mechanism().sides:
        critical, end = side.critical_rotation, side.end_rotation
        before, after = (
            np.linspace(0, 0.999, 40) * critical,
            critical + np.linspace(0.001, 1, 40) * (end - critical),
        )
        assert (side.gravity(before) > 0).all()
        assert (side.gravity(after) < 0).all()
        for rotation in (before, after):
            assert np.isfinite(side.inertia_slope(rotation)).all()
            assert (side.inertia(rotation) > 0).all()
        assert (side.ground(before) > 0).all()
        step = 1e-5 * end
        middle = np.linspace(0.01, 0.98, 20) * end
        for name in ("inertia", "gravity"):
            function = getattr(side, name)
            slope = getattr(side, f"{name}_slope")(middle)
            difference = (function(middle + step) - function(middle - step)) / (2 * step)
            scale = np.abs(slope).max() + np.abs(function(middle)).max() / end
            # rounding 1e-16/1e-5 and truncation (1e-5)² of a function that may be steep in a tenth of its range
            np.testing.assert_allclose(slope, difference, rtol=0, atol=1e-6 * scale)


@FEW
@given(arches(), st.floats(0.1, 10.0))
def test_similar_arches_differ_in_p_only(arch, factor):
    larger = Arch(arch.radius * factor, arch.thickness * factor, arch.embrace_angle, arch.voussoirs)
    one, other = arch.mechanism(), larger.mechanism()
    # the scaled t/r is another float: λ and φ_cr vanish at the least thickness and feel its rounding absolutely
    assert other.uplift_multiplier == pytest.approx(one.uplift_multiplier, rel=1e-9, abs=1e-13)
    assert other.critical_rotation == pytest.approx(one.critical_rotation, rel=1e-9, abs=1e-13)
    ratio = one.positive.frequency_parameter / other.positive.frequency_parameter
    assert ratio == pytest.approx(np.sqrt(factor), rel=1e-7)


@FEW
@given(arches())
def test_no_mechanism_of_the_arch_is_weaker(arch):
    """The kinematic minimum with D at the springing is the static maximum; the linkage starts at it."""
    assert arch.mechanism().uplift_multiplier == pytest.approx(arch.onset.multiplier, rel=1e-9, abs=1e-12)
    assert kinematic_onset(arch.ring).multiplier == pytest.approx(arch.onset.multiplier, rel=1e-9, abs=1e-9)


@MANY
@given(LENGTH, SHARE, st.floats(0.05, 2.0))
def test_wall_lifts_at_twice_the_slope_of_its_lower_block(height, share, thickness):
    wall = Wall.hinged_at(height, share * height, thickness, restitution=0.9)
    assert wall.mechanism().uplift_multiplier == pytest.approx(2 * thickness / (share * height), rel=1e-12)


@MANY
@given(structures, st.floats(0.01, 1.0))
def test_rotated_parts_keep_their_size_and_their_supports(structure, share):
    rotation = share * structure.mechanism().positive.end_rotation
    for before, after in zip(structure.outline(0.0), structure.outline(rotation), strict=True):
        size = np.ptp(before, axis=0).max()
        edges = [np.linalg.norm(part - np.roll(part, 1, axis=0), axis=1) for part in (before, after)]
        np.testing.assert_allclose(*edges, atol=1e-10 * size)
    at_rest, displaced = structure.hinges(0.0), structure.hinges(rotation)
    np.testing.assert_allclose(displaced[0], at_rest[0], rtol=1e-12, atol=1e-12)


@MANY
@given(st.floats(0.05, 5.0), st.floats(0.05, 5.0), LENGTH, st.floats(0.01, 50.0))
def test_momentum_balance_of_a_body_never_gains_energy(left, right, height, inertia):
    assume(inertia + height**2 > left * right)  # otherwise it is not physical, and says so
    for side in RigidBody(left, right, height, inertia).mechanism().sides:
        assert 0 <= side.restitution < 1
    mirrored = RigidBody(right, left, height, inertia).mechanism()
    assert [s.restitution for s in mirrored.sides][::-1] == [
        s.restitution for s in RigidBody(left, right, height, inertia).mechanism().sides
    ] or mirrored.symmetric


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


@settings(max_examples=400, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
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
