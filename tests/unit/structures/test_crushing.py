"""Hinges that move in as the edges of joints crush, c = N/(1.7 f_c): calculations by hand, to rounding."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import rocking
from rocking.errors import DoesNotStandError, StructureError
from rocking.quantities import GRAVITY
from rocking.structures import Arch, ArchOnPiers, Block, Facade, Frame, LoadedWall, RigidBody, Spire, Wall
from rocking.structures.building_parts import PARTS
from rocking.structures.crackable import crushing
from rocking.structures.held_wall import Opening
from rocking.structures.linkage import MotionState
from tests.refusals import refused

FC = 1.5e6
SOFT = {"compressive_strength": FC, "unit_weight": 18e3}


def close(value):
    return pytest.approx(value, rel=1e-9)


def test_block_turns_about_a_point_within_its_foot():
    b, h = 0.9, 5.0
    c = 18e3 * b * h / (1.7 * FC)
    block = Block.of_size(b, h, **SOFT)
    mechanism, lean = block.mechanism(), math.atan2(b / 2 - c, h / 2)
    assert mechanism.uplift_multiplier == close((b / 2 - c) / (h / 2))
    assert mechanism.critical_rotation == close(lean)
    curve = block.capacity_curve(count=7)
    np.testing.assert_allclose(curve.multiplier, np.tan(lean - curve.rotation), rtol=1e-9, atol=1e-12)
    # the body turns about points b − 2 c apart: momentum about the next one, as for any body with two corners
    inertia = (b**2 + h**2) / 12 + (b / 2 - c) ** 2 + h**2 / 4
    assert mechanism.restitution == close(1 - 2 * (b / 2 - c) ** 2 / inertia)
    assert block.hinges()[0] == pytest.approx([b / 2 - c, 0.0], rel=1e-12)
    # the outline is not what crushes, and the contact bears the weight
    assert np.vstack(block.outline())[:, 0].max() == pytest.approx(b / 2)
    assert float(
        block.contact_forces(MotionState.of(block.mechanism(), 1e-9, 0.0, 0.0)).normal[0, 0]
    ) == pytest.approx(GRAVITY)


def test_frame_crushes_at_feet_and_heads():
    b, h, ratio = 1.1, 8.0, 0.4
    weight = 18e3 * b * h
    foot, head = weight * (1 + ratio) / (1.7 * FC), weight * ratio / (1.7 * FC)
    frame = Frame(Block.of_size(b, h), 4, ratio, **SOFT).mechanism()
    by_hand = ((b / 2 - foot) + ratio * (b - foot - head)) / (h / 2 + ratio * h)
    assert frame.uplift_multiplier == close(by_hand)


@pytest.mark.parametrize(
    ("plan", "thickness"), [("square", None), ("circular", None), ("square", 0.3), ("circular", 0.3)]
)
def test_spire_is_pressed_over_a_strip_of_its_section(plan, thickness):
    """Weight and centroid by quadrature over heights, the strip by bisection and quadrature over its depth."""
    spire = Spire(3.0, 15.0, thickness, plan, crack_height=4.0, **SOFT)
    half = 1.5 * (1 - 4 / 15)

    def chord(radius, x):
        if abs(x) >= radius:
            return 0.0
        return 2 * radius if plan == "square" else 2 * math.sqrt(radius**2 - x**2)

    def area(z):
        outer = 1.5 * (1 - z / 15)
        inner = max(outer - (thickness or outer), 0.0)
        return (4 if plan == "square" else math.pi) * (outer**2 - inner**2)

    kink = [] if thickness is None else [15 * (1 - thickness / 1.5)]
    volume = quad(area, 4, 15, points=kink, epsabs=1e-13)[0]
    centre = quad(lambda z: (z - 4) * area(z), 4, 15, points=kink, epsabs=1e-13)[0] / volume
    inner = 0.0 if thickness is None else half - thickness

    def pressed(depth, power=0):
        def width(s):
            return (chord(half, half - s) - chord(inner, half - s)) * s**power

        return quad(width, 0, depth, points=[thickness] if thickness and depth > thickness else None,
                    epsabs=1e-14, epsrel=1e-13)[0]  # fmt: skip

    target = 18e3 * volume / (0.85 * FC)
    low, high = 0.0, half
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if pressed(middle) < target else (low, middle)
    c = pressed(low, 1) / pressed(low)
    assert 0.02 < c < 0.6
    assert spire.mechanism().uplift_multiplier == close((half - c) / centre)


def test_wall_with_a_hinge_moves_two_hinges_in():
    """Of a wall without load the top bears nothing."""
    h1, h2, t = 2.0, 1.4, 0.3
    gamma = 18e3
    c1, c2 = gamma * t * (h1 + h2) / (1.7 * FC), gamma * t * h2 / (1.7 * FC)
    wall = Wall(h1, h2, t, **SOFT)
    # the upper body turns by h₁/h₂ about the edge of its top, the lower one by 1
    lower, upper = h1 * (t / 2 - c1), h2 * (t / 2 - c1) + h2 * (t / 2 - c2) * (1 + h1 / h2)
    pushed = h1 * h1 / 2 + h2 * h1 / 2
    assert wall.mechanism().uplift_multiplier == close((lower + upper) / pushed)
    assert wall.mechanism().restitution > Wall(h1, h2, t).mechanism().restitution


@pytest.mark.parametrize(
    ("slab", "soft", "hard"),
    [("hinged", (31736.179, 1.166085), 1.320473), ("flat", (44481.277, 1.634380), 1.834877)],
)
def test_loaded_wall_is_that_of_the_worked_example(slab, soft, hard):
    """Section 12.8, six digits: 3.60 m, t .35, 18 kN/m³, hinge at 2.40 m, N = 40 kN/m."""
    values = {"top_load": 40e3, "top_slab": slab, "restitution": 0.5, "crack": "known"}
    stiff = LoadedWall(2.4, 1.2, 0.35, 18e3, **values)
    wall = LoadedWall(2.4, 1.2, 0.35, 18e3, **values, compressive_strength=FC)
    restoring, pushed = wall.held_wall.virtual_work(Opening(foot=0.0, hinge=2.4, hold=3.6).kinks)
    assert restoring == pytest.approx(soft[0], rel=1e-7)
    assert pushed == close(27216.0)
    assert wall.mechanism().uplift_multiplier == pytest.approx(soft[1], abs=5e-7)
    assert stiff.mechanism().uplift_multiplier == pytest.approx(hard, abs=5e-7)
    pressing = np.array([62680.0, 47560.0, 40000.0][: 2 + (slab == "flat")])
    side = wall.mechanism().positive
    by_hand = 49938.0 if slab == "flat" else 35938.0
    turns = np.array([1.0, 3.0, 2.0])[: pressing.size]  # of the joints, where the lower part turns by 1
    assert restoring == close(by_hand - (turns * pressing**2).sum() / (1.7 * FC))
    assert side.critical_rotation < stiff.mechanism().critical_rotation


def test_facade_turns_about_a_point_within_its_toe():
    """α₀ and the whole capacity: a body that turns has G = M cos φ − S sin φ and B = S cos φ + M sin φ."""
    facade = Facade(
        (3.5, 3.0), (0.5, 0.4), 18e3, floor_loads=(12e3, 8e3), top_slab="flat", compressive_strength=FC
    )
    weights = np.array([18e3 * 3.5 * 0.5, 18e3 * 3.0 * 0.4, 12e3, 8e3])
    c, top = weights.sum() / (1.7 * FC), 8e3 / (1.7 * FC)
    across = np.array([0.25, 0.2, 0.25, 0.4 - top]) - c
    up = np.array([1.75, 5.0, 3.5, 6.5])
    restoring, pushed = weights @ across, weights @ up
    curve = facade.capacity_curve(count=9)
    by_hand = (restoring * np.cos(curve.rotation) - pushed * np.sin(curve.rotation)) / (
        pushed * np.cos(curve.rotation) + restoring * np.sin(curve.rotation)
    )
    np.testing.assert_allclose(curve.multiplier, by_hand, rtol=1e-9, atol=1e-12)
    inwards = np.array([0.25, 0.2, 0.25, 0.4 - top]) - c  # alike here: each load bears in the middle
    negative = facade.mechanism().sides[1].uplift_multiplier
    inner = np.array([-0.25 + 0.5, -0.2 + 0.5, -0.25 + 0.5, 0.5 - top]) - c
    assert negative == close(weights @ inner / pushed)
    assert inwards.min() > 0


@pytest.mark.parametrize(
    "arch",
    [
        Arch(10, 1.5, math.radians(157.5), 7, **SOFT),
        Arch(8, 0.9, math.radians(150), fill_depth=0.4, **SOFT),
        ArchOnPiers(5.0, 0.9, math.pi, pier_width=2.0, pier_height=4.0, **SOFT),
    ],
    ids=["voussoirs", "with fill", "on piers"],
)
def test_hinges_of_an_arch_lie_where_their_own_thrust_presses(arch):
    """The thrust from the balance of the bars as they start to move, not from the line that chose the hinges."""
    side = arch.mechanism().positive
    assert side.uplift_multiplier == pytest.approx(arch.onset.multiplier, rel=1e-11)
    pushed = -arch.onset.multiplier * GRAVITY
    forces = arch.contact_forces(MotionState.of(arch.mechanism(), 1e-13, 0.0, 0.0, pushed))
    weight = 18e3 * arch.thickness * arch.radius * arch.ring.mass
    pressing = forces.normal[:, 0] / GRAVITY * weight
    whole = Arch if type(arch) is Arch else ArchOnPiers
    assert pressing.min() > 0 and whole
    edges = arch.radius * arch.ring.contact_points(
        arch.onset.hinges - arch.embrace_angle / 2, np.array([1, -1, 1, -1])
    )
    hinges = arch.hinges() @ [1, 1j]
    np.testing.assert_allclose(np.abs(edges - hinges), pressing / (1.7 * FC), rtol=1e-7)


def test_strength_without_end_changes_nothing():
    """In the limit, to 1e-6: c falls as 1/f_c."""
    far = {"compressive_strength": 1e14, "unit_weight": 18e3}
    held = {"compressive_strength": 1e14}
    pairs = [
        (Block.of_size(0.9, 5.0, **far), Block.of_size(0.9, 5.0)),
        (Wall(2.0, 1.4, 0.3, **far), Wall(2.0, 1.4, 0.3)),
        (
            LoadedWall(2.0, 1.4, 0.3, 18e3, top_load=5e3, **held),
            LoadedWall(2.0, 1.4, 0.3, 18e3, top_load=5e3),
        ),
        (
            Facade((3.0, 3.0), (0.5, 0.4), 18e3, (5e3, 4e3), **held),
            Facade((3.0, 3.0), (0.5, 0.4), 18e3, (5e3, 4e3)),
        ),
        (Spire(3.0, 15.0, 0.25, "square", **far), Spire(3.0, 15.0, 0.25, "square")),
        (Arch(10, 1.5, 2.75, **far), Arch(10, 1.5, 2.75)),
    ]
    for soft, hard in pairs:
        for side, other in zip(soft.mechanism().sides, hard.mechanism().sides, strict=True):
            for name in ("uplift_multiplier", "critical_rotation", "frequency_parameter", "restitution"):
                assert getattr(side, name) == pytest.approx(getattr(other, name), rel=1e-6), (
                    type(soft),
                    name,
                )


def test_what_is_typed_wrong_is_said_in_a_sentence():
    assert "check the unit" in repr(Block.of_size(0.9, 5.0, compressive_strength=1e9, unit_weight=18e3))
    with refused(StructureError, "unit_weight"):
        Block.of_size(0.9, 5.0, compressive_strength=2e6)
    for make in (
        lambda: Block.of_size(0.9, 5.0, compressive_strength=2e3, unit_weight=18e3),  # kPa for Pa
        lambda: Wall(2.0, 1.4, 0.3, compressive_strength=2e3, unit_weight=18e3),
        lambda: LoadedWall(2.0, 1.4, 0.3, 18e3, compressive_strength=2e3),
        lambda: Facade((3.0,), (0.4,), 18e3, compressive_strength=2e3),
        lambda: Spire(3.0, 15.0, compressive_strength=2e3, unit_weight=18e3),
        lambda: Frame(Block.of_size(1.0, 8.0), 4, 0.3, compressive_strength=2e3, unit_weight=18e3),
        lambda: Arch(10, 1.5, 2.75, compressive_strength=2e3, unit_weight=18e3),
    ):
        with refused(DoesNotStandError, "compressive_strength"):
            make()


def test_a_list_gives_it_in_megapascal():
    given = {
        "type": "block",
        "breadth_m": 0.9,
        "height_m": 5.0,
        "compressive_strength_MPa": 1.5,
        "unit_weight_kN_m3": 18.0,
    }
    block = rocking.structure_from_config(given)
    assert (
        block.mechanism().uplift_multiplier == Block.of_size(0.9, 5.0, **SOFT).mechanism().uplift_multiplier
    )


@pytest.mark.parametrize("flue", [None, 0.12])
def test_chimney_and_gable_turn_about_points_within_their_feet(flue):
    """By hand: a chimney presses γ A h/b on its edge, a gable γ t h/2; λ = (t/2 − N/(1.7 f_c))/z."""
    sizes = {"height": 6.0, "thickness": 0.6, "breadth": 0.9, "wall_thickness": flue}
    masonry = {"unit_weight": 18e3, "compressive_strength": 1.2e6}
    chimney = PARTS["chimney"].construct(**sizes, **masonry)
    area = 0.6 * 0.9 - (0.0 if flue is None else (0.6 - 0.24) * (0.9 - 0.24))
    aside = 18e3 * area * 6.0 / 0.9 / (1.7 * 1.2e6)
    assert chimney.mechanism().uplift_multiplier == pytest.approx((0.3 - aside) / 3.0, rel=1e-9)
    gable = PARTS["gable"].construct(height=4.0, thickness=0.4, **masonry)
    aside = 18e3 * 0.4 * 4.0 / 2 / (1.7 * 1.2e6)
    assert gable.mechanism().uplift_multiplier == pytest.approx((0.2 - aside) / (4.0 / 3), rel=1e-9)
    with refused(StructureError, "unit_weight"):
        PARTS["gable"].construct(height=4.0, thickness=0.4, compressive_strength=1.2e6)
    with refused(StructureError, "section"):
        RigidBody(0.4, 0.4, 1.5, 1.0, **masonry)


def test_what_a_strength_would_change_is_asked_of_masonry_that_states_none():
    """Of a block λ falls by 2c/b, c = γ b h/(1.7 f_c)."""
    block = Block.of_size(0.6, 4.0, unit_weight=18e3)
    ratio = crushing(block, 2e6).mechanism().uplift_multiplier / block.mechanism().uplift_multiplier
    assert ratio == pytest.approx(1 - 2 * 18e3 * 4.0 / (1.7 * 2e6), rel=1e-9)
    assert crushing(Block.of_size(0.6, 4.0), 2e6).unit_weight == 20e3
    assert crushing(Block.of_size(0.6, 4.0, **SOFT), 2e6) is None
    assert crushing(RigidBody(0.4, 0.4, 1.5, 1.0), 2e6) is None  # nobody knows what it weighs
    assert crushing(Block.of_size(0.6, 200.0), 2e6) is None  # it would not stand
