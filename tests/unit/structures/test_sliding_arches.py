"""The multiplier of arches on joints that slide: by the line of thrust, and by the equilibrium of each voussoir."""

from itertools import pairwise

import blocks
import numpy as np
import pytest

from rocking import Accelerogram, Arch, ArchOnPiers, Verdict
from rocking.assessment.decide import Decision, decide
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.motions import Motion
from rocking.assessment.one_case import compute_case
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.arch_mechanism import multiplier_on_friction

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


def by_blocks(arch: Arch, friction: float) -> float:
    inner = arch.radius - arch.thickness / 2
    edges = np.linspace(-arch.embrace_angle / 2, arch.embrace_angle / 2, arch.voussoirs + 1)
    sectors = [
        blocks.sector(inner, inner + arch.thickness, first, last) for first, last in pairwise(edges.tolist())
    ]
    masses = np.array([area for area, _ in sectors])
    centres = np.array([centre for _, centre in sectors])
    radial = np.stack([np.sin(edges), np.cos(edges)], axis=1)
    joints = np.stack([inner * radial, (inner + arch.thickness) * radial], axis=1)
    return blocks.greatest_multiplier(joints, masses, centres, friction)


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
        assert np.isnan(arch.slides_at(friction)) == (found >= 0.99 * arch.onset.multiplier)
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
    assert others[0].multiplier > first.multiplier
    for each in (first, *others):
        assert each.structure.slides_at(0.4) == SLIDES.slides_at(0.4) > 0


def test_what_slides_before_it_lifts_cannot_be_told_by_its_mechanism():
    """Though the motion stays below the acceleration at which that lifts; fidelity: auto follows no stones."""
    slides_at = SLIDES.slides_at(0.4)
    assert slides_at < 0.9 * SLIDES.static_multiplier
    times = np.arange(0, 3, 0.005)
    shape = np.sin(2 * np.pi * times / 0.5)

    def told(peak: float, friction: float) -> Decision:
        settings = AssessmentSettings(friction_coefficient=friction, fidelity="auto")
        motion = Motion((Accelerogram(peak * GRAVITY * shape, 0.005),))
        case = compute_case(CaseInputs(motion=motion, structure=SLIDES, settings=settings))
        return decide(case.facts(SLIDES))

    between = 0.9 * SLIDES.static_multiplier
    assert told(between, 0.6).word is told(0.9 * slides_at, 0.4).word is Verdict.STANDS
    sliding = told(between, 0.4)
    assert sliding.word is Verdict.CANNOT_BE_TOLD
    assert sliding.why == f"slides before it lifts, at {slides_at:.2g} g"
    apart = told(between, 0.1)
    assert (apart.word, apart.why) == (Verdict.CANNOT_BE_TOLD, "slides apart at rest")
