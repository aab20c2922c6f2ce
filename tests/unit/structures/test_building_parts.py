"""Parts of buildings: rows over block, rigid_body and spire, against integrals over their masonry."""

import numpy as np
import pytest

import rocking
from rocking.errors import ConfigurationError, StructureError
from rocking.structures.building_parts import PARTS
from rocking.structures.other_names import OTHER_NAMES, OtherName, answer
from rocking.structures.structure_list import TYPES
from tests.refusals import refused

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
    own, other = (case.positive.inertia(angles) / case.positive.gravity(angles) for case in (chimney, block))
    np.testing.assert_allclose(own, other, rtol=1e-12)


def test_a_gable_is_drawn_as_a_triangle_beside_its_section():
    gable = part("gable")
    assert len(gable.described.front) == 3 and np.ptp(gable.described.front, axis=0) == pytest.approx(
        [0.9, 3.0]
    )
    assert np.ptp(np.vstack(gable.outline()), axis=0) == pytest.approx([0.6, 3.0])
    without = rocking.structure_from_config({"type": "gable", "height_m": 3.0, "thickness_m": 0.6})
    assert len(without.described.front) == 3
    assert np.ptp(without.described.front, axis=0) == pytest.approx([6.0, 3.0])  # under a roof of 45°
    wall = rocking.structure_from_config({"type": "free_wall", "height_m": 3.0, "thickness_m": 0.6})
    assert len(wall.described.front) == 0
    assert {path.letter for path in part("free_wall").dimensions()} == {"h", "t", "b"}


@pytest.mark.parametrize("typed", ["boundary wall", "boundary_wall", "Boundary wall"])
def test_a_boundary_wall_is_answered_with_a_free_wall(typed):
    with refused(ConfigurationError, "type", typed) as caught:
        part(typed)
    assert OTHER_NAMES["boundary wall"] == OtherName("free_wall")
    assert OTHER_NAMES["boundary wall"].words in str(caught.value)


def test_what_it_is_called_besides_is_no_type_and_is_answered_by_one_or_none():
    assert not set(OTHER_NAMES) & {one_name.replace("_", " ") for one_name in TYPES} - {"capacity curve"}
    for name, answered in OTHER_NAMES.items():
        assert answered.type in TYPES or (not answered.type and answered.but), name
        with pytest.raises(ConfigurationError) as refused:
            part(name)
        assert answered.words in str(refused.value)


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("column", "column"),
        ("drum-column", "drum column"),
        ("Vault", "vault"),
        ("domes", "dome"),
        ("retaining_wall", "retaining wall"),
    ],
)
def test_a_name_is_answered_by_its_meaning_however_it_is_spelt(typed, name):
    with refused(ConfigurationError, "type", typed) as caught:
        part(typed)
    assert answer(typed) is OTHER_NAMES[name] and OTHER_NAMES[name].words in str(caught.value)


@pytest.mark.parametrize("typed", ["party wall", "archive", "wall tie", "wainscot"])
def test_what_only_has_like_letters_is_not_guessed(typed):
    with pytest.raises(ConfigurationError) as refused:
        part(typed)
    assert "did you mean wall" not in str(refused.value) and "described" not in str(refused.value)


@pytest.mark.parametrize(
    ("kind", "key", "value", "shown"),
    [
        ("chimney", "wall_thickness_m", 0.3, "0.3"),
        ("free_wall", "thickness_m", -0.2, "-0.2"),
        ("free_wall", "width_m", 0.2, 0.2),
        ("pinnacle", "crack_height_m", 4.0, "4.0"),
    ],
)
def test_a_bad_size_is_one_sentence_by_its_own_key(kind, key, value, shown):
    with refused((StructureError, ConfigurationError), key, shown) as caught:
        part(kind, **{key: value})
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


def test_a_wall_is_drawn_held_at_floor_and_ceiling_and_a_free_wall_is_not():
    wall = rocking.Wall.of_size(3.2, 0.25)
    for rotation in (0.0, 0.1, -0.1):
        levels = {round(float(mark.line[1, 1]), 9) for mark in wall.marks(rotation) if mark.kind == "support"}
        assert levels == {0.0, round(float(wall.hinges(rotation)[-1, 1]), 9)}
    assert part("free_wall").marks() == ()
