"""Structures against published and independently derived numbers."""

import numpy as np
import pytest

from rocking.quantities import GRAVITY
from rocking.structures.arch import Arch
from rocking.structures.block import Block
from rocking.structures.frame import Frame
from rocking.structures.wall import Wall

# Thirty-digit derivation of the four-hinge arch; the last row is Oppenheim's arch (1992), as in DeJong and
# Dimitrakopoulos, section 3.2. β and hinges A, B, C in degrees from the left springing; D is the right
# springing.
ARCHES = [
    # β, t/r, voussoirs, (A, B, C), λ, φ_cr, p √(r/g), a_sc, a_sc,alt, λ_lin/λ
    (180, 0.12, None, (31.77189, 87.35942, 142.94695),
     0.046119509283, 0.007971099443, 2.191692250710, 0.181649127546, 0.172835738435, 0.951481247228),
    (180, 0.15, None, (24.01353, 81.78741, 139.56130),
     0.144326436325, 0.031047597499, 1.939291872532, 0.251699421676, 0.215120654879, 0.854672821442),
    (180, 0.20, None, (13.75297, 74.16023, 134.56750),
     0.283721231673, 0.081394115753, 1.651109790214, 0.383085435110, 0.286880594986, 0.748868447332),
    (157.5, 0.15, 7, (0, 67.5, 112.5),
     0.370009738022, 0.069064693539, 1.859863994992, 0.280404501561, 0.186656421284, 0.665668419174),
]  # fmt: skip
HALF_A_DIGIT = 0.5e-12 * (1 + 1e-3)  # half a unit of the twelfth decimal printed, and rounding


@pytest.mark.parametrize("row", ARCHES, ids=lambda row: f"{row[0]}-{row[1]}-{row[2]}")
def test_arch_table(row):
    embrace, thickness, voussoirs, hinges, multiplier, critical, frequency, scale, alternative, ratio = row
    arch = Arch(1.0, thickness, np.radians(embrace), voussoirs)
    mechanism = arch.mechanism()
    block = mechanism.equivalent_block("linearised")
    np.testing.assert_allclose(np.degrees(arch.onset.hinges), (*hinges, embrace), atol=0.5e-5 * 1.001)
    assert arch.onset.multiplier == pytest.approx(multiplier, abs=HALF_A_DIGIT)
    assert mechanism.uplift_multiplier == pytest.approx(multiplier, abs=HALF_A_DIGIT)
    assert mechanism.critical_rotation == pytest.approx(critical, abs=HALF_A_DIGIT)
    assert block.frequency_parameter / np.sqrt(GRAVITY) == pytest.approx(frequency, abs=HALF_A_DIGIT)
    assert block.acceleration_scale == pytest.approx(scale, abs=HALF_A_DIGIT)
    at_uplift = mechanism.equivalent_block("uplift").acceleration_scale
    assert at_uplift == pytest.approx(alternative, abs=HALF_A_DIGIT)
    assert block.uplift_multiplier / mechanism.uplift_multiplier == pytest.approx(ratio, abs=HALF_A_DIGIT)


@pytest.mark.parametrize("ratio", [0.0, 0.5, 2.0, 20.0])
@pytest.mark.parametrize("slenderness", [0.1, 0.2])
def test_frame_of_makris_and_vassiliou(slenderness, ratio):
    """Makris and Vassiliou 2013, Planar rocking response of free-standing columns capped with a rigid beam:
    p² = (1 + 2γ)/(1 + 3γ) · 3g/4R, λ = tan α, and the ratio of angular velocities
    (1 − 1.5 sin²α + 3γ cos 2α)/(1 + 3γ)."""
    mechanism = Frame(Block(2.5, slenderness), 2, ratio).mechanism()
    squared = (1 + 2 * ratio) / (1 + 3 * ratio) * 3 * GRAVITY / (4 * 2.5)
    restitution = (1 - 1.5 * np.sin(slenderness) ** 2 + 3 * ratio * np.cos(2 * slenderness)) / (1 + 3 * ratio)
    assert mechanism.positive.frequency_parameter == pytest.approx(np.sqrt(squared), rel=1e-14)
    assert mechanism.uplift_multiplier == pytest.approx(np.tan(slenderness), rel=1e-14)
    assert mechanism.restitution == pytest.approx(restitution, rel=1e-14)


def test_frequency_parameter_of_the_wall_grows_with_the_height_of_the_upper_block():
    """Not largest at h₂/h₁ = 0.74, as the misprinted Eq. 14 has it: at fixed height it only grows."""
    ratios = np.linspace(0.2, 5.0, 40)
    walls = [Wall(6 / (1 + x), 6 * x / (1 + x), 0.3, restitution=0.9) for x in ratios]
    assert (np.diff([wall.mechanism().positive.frequency_parameter for wall in walls]) > 0).all()
