"""Which crack governs: statics against a dense scan, and dynamics against statics."""

from dataclasses import replace

import numpy as np
import pytest

from rocking.errors import DoesNotStandError, StructureError
from rocking.motion import Members, integrate_members
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.structures import Arch, Facade, LoadedWall, Spire, Wall
from rocking.structures.structure_list import structure_from_config
from tests.refusals import refused


@pytest.mark.parametrize(
    "options",
    [
        {"top_load": 30e3},
        {"top_load": 30e3, "top_slab": "flat"},
        {"tie_heights": (1.2, 3.0), "tie_stiffness": 5e4, "tie_strength": 4e3, "top_load": 10e3},
    ],
)
def test_statics_puts_the_hinge_where_the_multiplier_is_least(options):
    """Against 90 hinges: λ is no larger than theirs, and as small as a parabola between them allows."""
    wall = LoadedWall.of_size(3.2, 0.25, 20e3, restitution=0.8, **options)
    heights = np.linspace(1.2, 2.7, 90)
    scanned = [wall.cracked_at(float(height)).linkages[0] for height in heights]
    multipliers = np.array([float(pulse.gravity(0.0) / pulse.ground(0.0)) for pulse in scanned])
    assert wall.static_multiplier == pytest.approx(wall.mechanism().uplift_multiplier, rel=1e-8)
    assert multipliers.min() * (1 - 1e-3) < wall.static_multiplier < multipliers.min() * (1 + 1e-6)
    assert wall.hinge_height == pytest.approx(heights[multipliers.argmin()], abs=0.02)


def test_each_crack_has_its_own_balance_where_no_restitution_is_given():
    wall = Wall.of_size(3.2, 0.25)
    for one_candidate in wall.candidates():
        alone = Wall.of_size(3.2, 0.25, one_candidate.position, crack="known")
        balance = max(alone._momentum_balance(False), 0.0)
        assert one_candidate.structure.mechanism().restitution == pytest.approx(balance)
    given = Wall.of_size(3.2, 0.25, restitution=0.7)
    assert {candidate.structure.mechanism().restitution for candidate in given.candidates()} == {0.7}


def least_overturning(mechanism, period):
    """Amplitude in g of the weakest single sine of that period that overturns, to one part in fifty."""
    scales = np.geomspace(0.2, 6.0, 170)
    ratios = integrate_members(
        mechanism, Pulse(amplitude=GRAVITY, circular_frequency=2 * np.pi / period), Members(scales)
    ).rotation_ratio
    return scales[np.argmax(np.isinf(ratios))] if np.isinf(ratios).any() else np.inf


def test_the_base_of_a_spire_governs_statically_and_under_long_pulses_its_top_under_short_ones():
    """The paper, section 3.1: dynamics chooses another mechanism than statics where the pulse is short."""
    cracks = Spire(3.0, 15.0, wall_thickness=0.25).candidates(6)
    assert cracks[0].position == 0
    for period, lowest in ((0.6, 14.25), (1.0, 14.25), (4.0, 0.0), (8.0, 0.0)):
        least = [least_overturning(crack.structure.mechanism(), period) for crack in cracks]
        assert cracks[int(np.argmin(least))].position == lowest


def test_a_facade_cracked_within_a_storey_is_the_facade_that_stands_above_the_crack():
    """Whatever holds it, all heights taken from the crack; in the mirror too, and as a stack of courses."""
    held = {"floor_loads": (12e3, 6e3), "thrust": 1e3, "eccentricity": 0.1}
    held |= {"tie_stiffness": 5e4, "tie_strength": 4e3}
    whole = Facade((3.5, 3.0), (0.6, 0.5), 20e3, **held, tie_heights=(3.4,), crack_height=1.2, crack="known")
    above = Facade((2.3, 3.0), (0.6, 0.5), 20e3, **held, tie_heights=(2.2,), crack_storey=1, crack="known")
    rotations = np.linspace(0.0, 0.2, 41)
    for one, other in zip(whole.linkages, above.linkages, strict=True):
        for name in ("inertia", "gravity", "gravity_slope", "ground"):
            assert getattr(one, name)(rotations) == pytest.approx(getattr(other, name)(rotations), rel=1e-12)
    assert whole.mechanism().restitution == pytest.approx(above.mechanism().restitution, rel=1e-12)
    free = {"tie_heights": (), "tie_stiffness": 0.0, "tie_strength": None}
    (course,), (same,) = (replace(case, **free).stack().courses for case in (whole, above))
    assert (course.mass, course.inertia) == pytest.approx((same.mass, same.inertia), rel=1e-12)
    assert whole.outline()[0][:, 1].max() == whole.outline()[1][:, 1].min() == 1.2


def test_a_facade_may_open_at_the_foot_of_every_storey_and_between():
    facade = Facade((3.5, 3.0), (0.6, 0.2), 20e3)
    places = sorted(candidate.position for candidate in facade.candidates(11))
    assert {0.0, 3.5} <= set(places)
    assert np.diff(places).max() <= 0.0951 * 6.5 and max(places) == pytest.approx(0.95 * 6.5)
    assert {one_candidate.structure.crack_position for one_candidate in facade.candidates(11)} == set(places)
    weakest = facade.candidates(11)[0]
    assert (weakest.position, weakest.structure.crack_storey) == (3.5, 2)
    known = Facade((3.5, 3.0), (0.6, 0.2), 20e3, crack_height=1.0, crack="known")
    assert known.candidates(11)[0].position == 1.0


@pytest.mark.parametrize(
    ("plain", "typed"),
    [
        (Facade((3.5, 3.0), (0.6, 0.2), 20e3), {"crack_storey": 1}),
        (Facade((3.5, 3.0), (0.6, 0.2), 20e3), {"crack_height": 1.1}),
        (Spire(3.0, 15.0, wall_thickness=0.25), {"crack_height": 5.0}),
        (
            LoadedWall.of_size(3.2, 0.25, 20e3, top_load=30e3, top_slab="flat"),
            {"lower_height": 1.6, "upper_height": 1.6},
        ),
        (Wall.of_size(3.2, 0.25), {"lower_height": 1.6, "upper_height": 1.6}),
        (Arch(5.0, 0.8, np.radians(150)), {"hinge_angles": tuple(np.radians([0.0, 40.0, 100.0, 150.0]))}),
    ],
)
def test_a_crack_that_is_typed_is_one_more_candidate_and_decides_only_where_it_is_known(plain, typed):
    """It takes none of the others away, whatever key types it: the first is that of least λ, and every one counts."""
    at_a_place = replace(plain, **typed)
    places = {this_candidate.description for this_candidate in at_a_place.candidates()}
    without = {candidate.description for candidate in plain.candidates()}
    assert places - without <= {at_a_place.crack_in_words}, (
        "but for the place that is typed they are the same"
    )
    assert at_a_place.crack_in_words in places
    if not isinstance(
        plain, Wall | LoadedWall
    ):  # of which the place of statics is the one of their description
        assert without <= places
    assert all(one_candidate.counts for one_candidate in at_a_place.candidates())
    assert at_a_place.candidates()[0].mechanism.uplift_multiplier == min(
        other_candidate.mechanism.uplift_multiplier for other_candidate in at_a_place.candidates()
    )
    assert at_a_place.static_multiplier == pytest.approx(plain.static_multiplier, rel=1e-12)

    known = replace(at_a_place, crack="known")
    first, *beside = known.candidates()
    # but for a top that slips, which it may wherever the wall is cracked
    assert (
        first.counts and beside and not any(neighbour.counts for neighbour in beside if not neighbour.bulges)
    )
    assert first.description == at_a_place.crack_in_words and first.structure is known
    assert first.mechanism.uplift_multiplier == at_a_place.mechanism().uplift_multiplier
    assert known.static_multiplier == pytest.approx(first.mechanism.uplift_multiplier, rel=1e-12)
    if isinstance(plain, Arch):
        return  # no file states the angles of hinges
    for case in (at_a_place, known):
        again = structure_from_config(case.described.entry)
        assert again == case and again.crack_is_known is case.crack_is_known


@pytest.mark.parametrize("word", ["given", "unknown"])
def test_a_crack_is_known_or_nothing_is_said_of_it(word):
    entry = {"type": "wall", "height_m": 3.2, "thickness_m": 0.25, "hinge_height_m": 1.6, "crack": word}
    with refused(StructureError, "crack", repr(word)):
        structure_from_config(entry)


def test_a_known_crack_stands_where_another_one_would_not():
    """The upper storey, pushed outwards, falls at rest about its own foot; about the ground the whole stands."""
    pushed = {"thrust": 1e3, "thrust_height": 6.5}
    with pytest.raises(DoesNotStandError):
        Facade((3.5, 3.0), (0.6, 0.2), 20e3, **pushed)
    known = Facade((3.5, 3.0), (0.6, 0.2), 20e3, **pushed, crack_storey=1, crack="known")
    assert all(candidate.structure.mechanism().uplift_multiplier > 0 for candidate in known.candidates())
