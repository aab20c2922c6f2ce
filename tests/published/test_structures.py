"""Structures against published and independently derived numbers."""

import numpy as np
import pytest

from rocking.structures.arch import Arch
from rocking.structures.arch_onset import minimum_thickness
from rocking.units import GRAVITY

# Thirty-digit derivation of the four-hinge arch; the last row is Oppenheim's arch (1992), as in DeJong and
# Dimitrakopoulos, section 3.2. β and hinges A, B, C in degrees from the left springing; D is the right
# springing.
ARCHES = [
    # β, t/r, voussoirs, (A, B, C), λ, φ_cr, p √(r/g), a_sc, a_sc,alt, λ_lin/λ
    (
        180,
        0.12,
        None,
        (31.77189, 87.35942, 142.94695),
        0.046119509283,
        0.007971099443,
        2.191692250710,
        0.181649127546,
        0.172835738435,
        0.951481247228,
    ),
    (
        180,
        0.15,
        None,
        (24.01353, 81.78741, 139.56130),
        0.144326436325,
        0.031047597499,
        1.939291872532,
        0.251699421676,
        0.215120654879,
        0.854672821442,
    ),
    (
        180,
        0.20,
        None,
        (13.75297, 74.16023, 134.56750),
        0.283721231673,
        0.081394115753,
        1.651109790214,
        0.383085435110,
        0.286880594986,
        0.748868447332,
    ),
    (
        157.5,
        0.15,
        7,
        (0, 67.5, 112.5),
        0.370009738022,
        0.069064693539,
        1.859863994992,
        0.280404501561,
        0.186656421284,
        0.665668419174,
    ),
]
HALF_A_DIGIT = 0.5e-12 * (1 + 1e-3)  # half a unit of the twelfth decimal printed, and rounding


@pytest.mark.parametrize("row", ARCHES, ids=lambda row: f"{row[0]}-{row[1]}-{row[2]}")
def test_arch_table(row):
    embrace, thickness, voussoirs, hinges, multiplier, critical, frequency, scale, alternative, ratio = row
    arch = Arch(1.0, thickness, np.radians(embrace), voussoirs)
    mechanism = arch.mechanism()
    block = mechanism.equivalent_block()
    np.testing.assert_allclose(np.degrees(arch.onset.hinges), (*hinges, embrace), atol=0.5e-5 * 1.001)
    assert arch.onset.multiplier == pytest.approx(multiplier, abs=HALF_A_DIGIT)
    assert mechanism.uplift_multiplier == pytest.approx(multiplier, abs=HALF_A_DIGIT)
    assert mechanism.critical_rotation == pytest.approx(critical, abs=HALF_A_DIGIT)
    assert block.frequency_parameter / np.sqrt(GRAVITY) == pytest.approx(frequency, abs=HALF_A_DIGIT)
    assert block.acceleration_scale == pytest.approx(scale, abs=HALF_A_DIGIT)
    assert mechanism.equivalent_block("uplift").acceleration_scale == pytest.approx(
        alternative, abs=HALF_A_DIGIT
    )
    assert block.uplift_multiplier / mechanism.uplift_multiplier == pytest.approx(ratio, abs=HALF_A_DIGIT)


def test_minimum_thickness_of_the_semicircle():
    """Milankovitch 1907 (radial joints); Makris and Alexakis 2013: t/r = 0.107478."""
    assert minimum_thickness(np.pi) == pytest.approx(0.107478038, abs=0.5e-9)


def test_arch_scales_with_its_radius():
    small, large = (Arch(r, 0.15 * r, np.radians(157.5)).mechanism() for r in (1.0, 15.0))
    assert large.uplift_multiplier == pytest.approx(small.uplift_multiplier, rel=1e-14)
    assert large.critical_rotation == pytest.approx(small.critical_rotation, rel=1e-14)
    ratio = small.positive.frequency_parameter / large.positive.frequency_parameter
    assert ratio == pytest.approx(np.sqrt(15), rel=1e-14)
