"""What the kinematic checks owe, whatever the structure, the soil and the support."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rocking import Block, DesignSpectrum, Facade, LoadedWall, Mode, Spire, Support, Wall
from rocking.codes.check import CodeTerms
from rocking.codes.static_check import kinematic_check

G = 9.80665
ROUNDING = 1e-12

THICKNESSES = st.floats(0.15, 0.9)
SLENDERNESSES = st.floats(2.5, 15.0)
BLOCKS = st.builds(lambda t, s: Block.of_size(t, t * s), THICKNESSES, SLENDERNESSES)
WALLS = st.builds(lambda t, s: Wall.of_size(t * s, t), THICKNESSES, st.floats(5.0, 20.0))
LOADED = st.builds(
    lambda t, load: LoadedWall(2.0, 1.4, t, 19e3, top_load=load, eccentricity=t / 4, crack="known"),
    st.floats(0.2, 0.5),
    st.floats(0.0, 40e3),
)
SPIRES = st.builds(
    lambda width, s: Spire(width, width * s, restitution=0.8), st.floats(0.8, 3.0), SLENDERNESSES
)
FACADES = st.builds(
    lambda t, load, strength: Facade(
        (3.5, 3.0), (t, 0.8 * t), 20e3, floor_loads=(load, load / 2), eccentricity=t / 10, tie_heights=(6.0,),
        tie_stiffness=4e5, tie_strength=strength, crack_storey=1, crack="known", behind="cross_walls", restitution=0.6,
    ),
    st.floats(0.4, 0.9),
    st.floats(1e3, 20e3),
    st.floats(500.0, 30e3),
)  # fmt: skip
STRUCTURES = st.one_of(BLOCKS, WALLS, LOADED, SPIRES, FACADES)
SPECTRA = st.builds(
    DesignSpectrum.ntc,
    st.floats(0.2, 6.0),
    st.floats(2.2, 3.0),
    st.floats(0.2, 0.5),
    st.sampled_from("ABCDE"),
)
SUPPORTS = st.one_of(
    st.none(),
    st.builds(
        lambda period, damping, share: Support(
            (Mode(period=period, damping_ratio=damping, participation=share),)
        ),
        st.floats(0.05, 1.0),
        st.floats(0.02, 0.2),
        st.floats(0.3, 1.6),
    ),
)
UNCHECKED = settings(
    max_examples=settings.default.max_examples // 3,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)


@UNCHECKED
@given(
    STRUCTURES, SPECTRA, SUPPORTS, st.sampled_from([0.0, 0.08, 0.3]), st.floats(1.0, 1.5), st.floats(1.0, 3.0)
)
def test_no_check_of_collapse_is_reached_before_damage(
    structure, spectrum, support, period, confidence, behaviour
):
    """a_g,SLV ≥ a_g,SLD: the linear one is q times it, and the nonlinear one is never below it."""
    shared = {"support": support, "elastic_period": period, "confidence_factor": confidence}
    damage = kinematic_check(structure, spectrum, CodeTerms(limit_state="SLD", **shared))
    safety = kinematic_check(structure, spectrum, CodeTerms(behaviour_factor=behaviour, **shared))
    collapse = kinematic_check(structure, spectrum, CodeTerms(limit_state="SLC", **shared))
    level = damage.linear.capacity
    assert safety.linear.capacity == pytest.approx(behaviour * level, rel=ROUNDING)
    assert safety.linear.capacity >= level * (1 - ROUNDING)
    assert safety.nonlinear.capacity >= level * (1 - ROUNDING)
    assert collapse.nonlinear.capacity >= level * (1 - ROUNDING)


@UNCHECKED
@given(STRUCTURES, SPECTRA, st.floats(1.01, 1.5))
def test_more_confidence_never_makes_a_capacity_smaller(structure, spectrum, factor):
    cautious = kinematic_check(structure, spectrum, CodeTerms(confidence_factor=factor))
    sure = kinematic_check(structure, spectrum, CodeTerms(confidence_factor=1.0))
    assert sure.linear.capacity >= cautious.linear.capacity
    assert sure.nonlinear.capacity >= cautious.nonlinear.capacity * (1 - ROUNDING)


@UNCHECKED
@given(BLOCKS, st.floats(0.2, 6.0))
def test_on_rock_the_linear_check_of_a_block_is_its_slenderness(block, level):
    """α_0 = b/h and e* = 1 of one weight: a_g,SLV = 2 (b/h) g/1.35 on soil A, at every design level."""
    corners = block.outline()[0]
    breadth, height = corners.max(axis=0) - corners.min(axis=0)
    check = kinematic_check(block, DesignSpectrum.ntc(level, 2.5, 0.35))
    assert check.linear.capacity == pytest.approx(2 * breadth / height * G / 1.35, rel=1e-9)
