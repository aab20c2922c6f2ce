"""The multiplier of arches on joints that slide: by the line of thrust, and by the equilibrium of each voussoir."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import blocks
import numpy as np
import pytest

from rocking import Accelerogram, Arch, ArchOnPiers, Block, Frame, Verdict
from rocking.assessment.decide import Decision
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.motions import Motion
from rocking.assessment.one_case import compute_case
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.arch_mechanism import multiplier_on_friction
from rocking.structures.joints import Joints

SLIDES = Arch(5.0, 0.9, np.radians(150), 11)


def drawn(count: int) -> list[Arch]:
    """Arches of joints or without, some under fill, some on piers."""
    chance, arches = np.random.default_rng(5), []
    while len(arches) < count:
        radius, ratio, embrace = chance.uniform([3, 0.08, 100], [15, 0.2, 180])
        size = radius, ratio * radius, np.radians(embrace)
        number = int(chance.integers(5, 41))
        place = len(arches) % 4
        try:
            if place == 3:
                arch = ArchOnPiers(*size, number, pier_width=0.4 * radius, pier_height=0.5 * radius)
            else:
                arch = Arch(*size, None if place == 1 else number, fill_depth=0.1 if place == 2 else None)
        except StructureError:
            continue
        arches.append(arch)
    return arches


def by_blocks(structure: Arch | Frame, friction: float, spacing: float = 0.0) -> float:
    """Limit analysis of voussoirs, piers or columns and beam; masses per density and length, by quadrature.

    spacing: of columns, over their height; 0: as the package draws them.
    """
    if isinstance(structure, Frame):
        column = structure.column
        bodies = [blocks.rectangle(column.breadth, column.height) for _ in range(2)]
        beam = structure.beam_mass_ratio * 2 * column.breadth * column.height
        apart = spacing * column.height if spacing else max(0.6 * column.height, 2 * column.breadth)
        depth = beam / (apart + column.breadth)
        masses = np.array([bodies[0][0], beam, bodies[1][0]])
        middle = [apart / 2, column.height + depth / 2]
        centres = np.array([bodies[0][1], middle, bodies[1][1] + [apart, 0]])
        ends = np.array([-column.breadth / 2, column.breadth / 2])
        levels = [0.0, column.height, column.height, 0.0]
        joints = [
            [[place + end, level] for end in ends]
            for place, level in zip([0.0, 0.0, apart, apart], levels, strict=True)
        ]
        return blocks.greatest_multiplier(np.array(joints), masses, centres, friction)
    inner = structure.radius - structure.thickness / 2
    outer = inner + structure.thickness
    edges = np.linspace(-structure.embrace_angle / 2, structure.embrace_angle / 2, structure.voussoirs + 1)
    parts = []
    for first, last in pairwise(edges.tolist()):
        loads = [blocks.sector(inner, outer, first, last)]
        if structure.fill_depth is not None:
            level = outer + structure.fill_depth
            area, centre = blocks.columns(outer, level, first, last)
            loads.append((structure.fill_density_ratio * area, centre))
        parts.append(blocks.together(loads))
    radial = np.stack([np.sin(edges), np.cos(edges)], axis=1)
    joints = np.stack([inner * radial, outer * radial], axis=1)
    if isinstance(structure, ArchOnPiers):
        area, centre = blocks.rectangle(structure.pier_width, structure.pier_height)
        springing = joints[-1, 0]
        foot = springing[1] - structure.pier_height
        right = centre + np.array([springing[0] + structure.pier_width / 2, foot])
        pier = structure.pier_density_ratio * area
        parts = [(pier, right * [-1, 1]), *parts, (pier, right)]
        feet = np.array([[springing[0], foot], [springing[0] + structure.pier_width, foot]])
        joints = np.array([feet * [-1, 1], *joints, feet])
    masses, centres = (np.array(part) for part in zip(*parts, strict=True))
    return blocks.greatest_multiplier(joints, masses, centres, friction)


def drawn_of(kind: str, count: int) -> Iterator[tuple[Arch | Frame, float]]:
    """Structures of one kind that stand as mechanisms, and a friction of their joints."""
    chance = np.random.default_rng([11, len(kind)])
    found = 0
    while found < count:
        radius, ratio, embrace = chance.uniform([3, 0.08, 100], [15, 0.2, 180])
        size = radius, ratio * radius, np.radians(embrace), int(chance.integers(5, 28))
        width, height, depth, beam, slenderness = chance.uniform(
            [0.3, 0.3, 0.0, 0.1, 0.1], [0.8, 1.2, 0.3, 2.0, 0.4]
        )
        try:
            if kind == "frame":
                structure = Frame(Block.of_size(slenderness * radius, radius), 2, beam)
            elif kind == "arch on piers":
                structure = ArchOnPiers(*size, pier_width=width * radius, pier_height=height * radius)
            else:
                structure = Arch(*size, fill_depth=depth * radius if kind == "arch with fill" else None)
        except StructureError:
            continue
        found += 1
        yield structure, float(chance.uniform(0.1 if kind == "frame" else 0.3, 1.0))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["arch", "arch with fill", "arch on piers", "frame"])
def test_stones_bear_what_limit_analysis_says_of_a_hundred_of_each_kind(kind):
    """Arches, with fill or on piers, and portals, on joints of a drawn friction on which a good part slides first."""
    apart, slide = [], 0
    for structure, friction in drawn_of(kind, 100):
        expected = np.nan_to_num(by_blocks(structure, friction))
        stones = replace(structure.stones(), friction=friction).resting_multiplier
        apart.append(abs(stones - max(expected, 0.0)))
        slide += stones < 0.99 * structure.static_multiplier
    assert max(apart) < 1e-12
    assert 10 < slide < 90


def test_on_joints_that_do_not_slide_it_is_that_of_the_mechanism():
    for arch in drawn(60):
        assert multiplier_on_friction(arch.ring, 5.0) == pytest.approx(arch.onset.multiplier, rel=1e-11)


@pytest.mark.parametrize("friction", [0.3, 0.4, 0.5, 0.6])
def test_on_joints_that_slide_it_is_that_of_the_equilibrium_of_each_voussoir(friction):
    slide = 0
    for arch in (SLIDES, Arch(8.0, 1.5, np.radians(120), 9), Arch(10.0, 1.2, np.radians(170), 16)):
        expected = by_blocks(arch, friction)
        found = multiplier_on_friction(arch.ring, friction)
        assert found == pytest.approx(0.0 if np.isnan(expected) else expected, rel=1e-7)
        slide += found < 0.99 * arch.onset.multiplier
        assert np.isnan(arch.on_joints(Joints(friction)).slides_at()) == (
            found >= 0.99 * arch.onset.multiplier
        )
    assert slide > 0 or friction == 0.6


def test_more_friction_never_slides_at_less():
    for arch in drawn(8):
        found = [multiplier_on_friction(arch.ring, friction) for friction in np.linspace(0.2, 1.2, 11)]
        assert (np.diff(found) >= -1e-9).all()
        assert found[-1] <= arch.onset.multiplier * (1 + 1e-9)


def test_a_level_joint_below_a_pier_slides_at_its_friction():
    """Stocky piers below a flat arch: all stands on its feet, whose friction bears no more than μ of the weight."""
    arch = ArchOnPiers(5.0, 1.0, np.radians(170), 11, pier_width=12.0, pier_height=1.0)
    friction = 0.1
    assert multiplier_on_friction(arch.ring, friction) <= friction


def test_hinges_that_are_typed_slide_as_all_joints_do():
    first, *others = SLIDES.candidates(4)
    assert others[0].mechanism.uplift_multiplier > first.mechanism.uplift_multiplier
    for case in (first, *others):
        assert (
            case.structure.on_joints(Joints(0.4)).slides_at() == SLIDES.on_joints(Joints(0.4)).slides_at() > 0
        )


def test_what_slides_before_it_lifts_cannot_be_told_by_its_mechanism():
    """Though the motion stays below the acceleration at which that lifts; fidelity: quick follows no stones."""
    slides_at = SLIDES.on_joints(Joints(0.4)).slides_at()
    assert slides_at < 0.9 * SLIDES.static_multiplier
    times = np.arange(0, 3, 0.005)
    shape = np.sin(2 * np.pi * times / 0.5)

    def told(peak: float, friction: float) -> Decision:
        arch = SLIDES.on_joints(Joints(friction))
        motion = Motion((Accelerogram(peak * GRAVITY * shape, 0.005),))
        settings = AssessmentSettings(fidelity="quick")
        case = compute_case(CaseInputs(motion=motion, structure=arch, settings=settings))
        return case.decision(arch)

    between = 0.9 * SLIDES.static_multiplier
    assert told(between, 0.6).verdict is told(0.9 * slides_at, 0.4).verdict is Verdict.STANDS
    sliding = told(between, 0.4)
    assert sliding.verdict is Verdict.CANNOT_BE_TOLD
    assert sliding.why == f"slides before it lifts, at {slides_at:.2g} g"
    apart = told(between, 0.1)
    assert (apart.verdict, apart.why) == (Verdict.CANNOT_BE_TOLD, "slides apart at rest")
