"""Parts of buildings: rows over block, rigid_body and spire, against integrals over their masonry."""

import numpy as np
import pytest

import rocking
from rocking.errors import ConfigurationError, StructureError
from rocking.structures.building_parts import PARTS
from rocking.structures.other_names import OTHER_NAMES
from rocking.structures.structure_list import TYPES

SIZES = {"height_m": 3.0, "thickness_m": 0.6, "breadth_m": 0.9}


def part(kind, **more):
    return rocking.structure_from_config({"type": kind, **SIZES, **more})


def inside(kind, x, y, z):
    """Whether a point of the masonry, x along the thickness, y across and z up from the middle of the foot, m."""
    h, t, b = SIZES.values()
    left = 1 - z / h
    box = (abs(x) <= t / 2) & (abs(y) <= b / 2)
    return {
        "gable": (abs(x) <= t / 2) & (abs(y) <= b / 2 * left),
        "pinnacle": (abs(x) <= t / 2 * left) & (abs(y) <= b / 2 * left),
        "chimney": box & ~((abs(x) < t / 2 - 0.12) & (abs(y) < b / 2 - 0.12)),
    }.get(kind, box)


@pytest.mark.parametrize("kind", PARTS)
def test_its_mechanism_is_that_of_its_masonry_point_by_point(kind):
    """λ, and inertia over restoring moment as it lifts about its edge, summed over a grid of points."""
    h, t, b = SIZES.values()
    steps = 60, 90, 240
    x, y, z = np.meshgrid(
        *(
            (np.arange(n) + 0.5) / n * size - shift
            for n, size, shift in zip(steps, (t, b, h), (t / 2, b / 2, 0), strict=True)
        ),
        indexing="ij",
    )
    points = inside(kind, x, y, z)
    centre = z[points].mean()
    about_edge = ((x[points] - t / 2) ** 2 + z[points] ** 2).mean()
    found = part(kind, **({"wall_thickness_m": 0.12} if kind == "chimney" else {})).mechanism()
    # the grid resolves a thickness of 0.01 m
    assert found.uplift_multiplier == pytest.approx(t / 2 / centre, rel=5e-3)
    at_rest = np.zeros(1)
    own = found.positive.inertia(at_rest) / found.positive.gravity(at_rest)
    assert own == pytest.approx(about_edge / (t / 2), rel=5e-3)


def test_a_solid_chimney_rocks_as_the_block_of_its_size():
    block = rocking.Block.of_size(breadth=0.6, height=3.0).mechanism()
    chimney = part("chimney").mechanism()
    assert chimney.uplift_multiplier == pytest.approx(block.uplift_multiplier, rel=1e-12)
    angles = np.linspace(0, 0.15, 5)
    own, other = (each.positive.inertia(angles) / each.positive.gravity(angles) for each in (chimney, block))
    np.testing.assert_allclose(own, other, rtol=1e-12)


def test_a_gable_is_drawn_as_a_triangle_beside_its_section():
    gable = part("gable")
    assert len(gable.described.front) == 3 and np.ptp(gable.described.front, axis=0) == pytest.approx(
        [0.9, 3.0]
    )
    assert np.ptp(np.vstack(gable.outline()), axis=0) == pytest.approx([0.6, 3.0])
    without = rocking.structure_from_config({"type": "gable", "height_m": 3.0, "thickness_m": 0.6})
    assert len(without.described.front) == 3
    wall = rocking.structure_from_config({"type": "free_wall", "height_m": 3.0, "thickness_m": 0.6})
    assert len(wall.described.front) == 0
    assert {each.letter for each in part("free_wall").dimensions()} == {"h", "t", "b"}


@pytest.mark.parametrize("typed", ["boundary wall", "boundary_wall", "Boundary wall"])
def test_a_boundary_wall_is_answered_with_a_free_wall(typed):
    with pytest.raises(ConfigurationError, match="it is described as a free wall, type: free_wall"):
        part(typed)


def test_what_it_is_called_besides_is_no_type_and_is_answered_by_one_or_none():
    assert not set(OTHER_NAMES) & {each.replace("_", " ") for each in TYPES} - {"capacity curve"}
    for name, answered in OTHER_NAMES.items():
        assert answered.type in TYPES or (not answered.type and answered.but), name
        with pytest.raises(ConfigurationError) as refused:
            part(name)
        assert answered.words in str(refused.value)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("column", "it is described as a block, type: block; it rocks in one piece"),
        ("drum-column", "not modelled: drums open and slide"),
        ("Vault", "type: arch; one metre of it"),
        ("domes", "not modelled: a dome is held by its rings"),
        ("retaining_wall", "not modelled: earth or water"),
        ("cavity_wall", "type: wall; give the thickness of its leaves from outside in, leaves_m"),
    ],
)
def test_a_name_is_answered_by_its_meaning(typed, words):
    with pytest.raises(ConfigurationError, match=words):
        part(typed)


@pytest.mark.parametrize("typed", ["party wall", "archive", "wall tie", "wainscot"])
def test_what_only_has_like_letters_is_not_guessed(typed):
    with pytest.raises(ConfigurationError) as refused:
        part(typed)
    assert "did you mean wall" not in str(refused.value) and "described" not in str(refused.value)


@pytest.mark.parametrize(
    ("kind", "more", "said"),
    [
        (
            "chimney",
            {"wall_thickness_m": 0.3},
            "wall_thickness_m is 0.3 m, but must be less than half the smaller",
        ),
        ("free_wall", {"thickness_m": -0.2}, "thickness_m is -0.2 m, but must be"),
        ("free_wall", {"width_m": 0.2}, "width_m is not a key of a free wall"),
        ("pinnacle", {"crack_height_m": 4.0}, "crack_height_m is 4.0 m, but must lie on"),
    ],
)
def test_a_bad_size_is_one_sentence_by_its_own_key(kind, more, said):
    with pytest.raises((StructureError, ConfigurationError), match=said.replace("(", r"\(")) as refused:
        part(kind, **more)
    assert "\n" not in str(refused.value) and str(refused.value).endswith(".")


def test_a_wall_is_drawn_held_at_floor_and_ceiling_and_a_free_wall_is_not():
    wall = rocking.Wall.of_size(3.2, 0.25)
    for rotation in (0.0, 0.1, -0.1):
        levels = {round(float(mark.line[1, 1]), 9) for mark in wall.marks(rotation) if mark.kind == "support"}
        assert levels == {0.0, round(float(wall.hinges(rotation)[-1, 1]), 9)}
    assert part("free_wall").marks() == ()
