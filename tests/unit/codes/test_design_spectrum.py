"""Design spectra: the branches of NTC 2018, 3.2.3.2 by identities and by hand, points from a file, and refusals."""

import math

import numpy as np
import pytest

from rocking import DesignSpectrum
from rocking.errors import ConfigurationError
from rocking.quantities import GRAVITY
from rocking.signal.measures import damping_factor
from tests.refusals import refused

ROUNDING = 1e-12


@pytest.mark.parametrize("soil", "ABCDE")
@pytest.mark.parametrize("ag", [0.5, 2.5, 5.0])
def test_the_branches_meet_and_have_the_shape_of_the_code(soil, ag):
    spectrum = DesignSpectrum.ntc(ag, 2.45, 0.32, soil, 1.2)
    t_b, t_c, t_d = spectrum.corner_periods
    assert t_b == pytest.approx(t_c / 3, rel=ROUNDING)
    assert t_d == pytest.approx(4 * ag / GRAVITY + 1.6, rel=ROUNDING)
    plateau = ag * spectrum.soil_factor * 2.45
    assert spectrum.acceleration(0.0) == pytest.approx(ag * spectrum.soil_factor, rel=ROUNDING)
    assert spectrum.acceleration(t_b / 2) == pytest.approx((plateau / 2.45 + plateau) / 2, rel=ROUNDING)
    for corner in (t_b, t_c, t_d):
        left, right = spectrum.acceleration(corner * np.array([1 - 1e-9, 1 + 1e-9]))
        assert left == pytest.approx(right, rel=1e-8)  # the slopes times the distance of 2e-9
    assert spectrum.acceleration((t_b + t_c) / 2) == pytest.approx(plateau, rel=ROUNDING)
    assert spectrum.acceleration(t_d) == pytest.approx(plateau * t_c / t_d, rel=ROUNDING)
    assert spectrum.acceleration(2 * t_d) == pytest.approx(plateau * t_c / t_d / 4, rel=ROUNDING)
    assert spectrum.displacement(3 * t_d) == pytest.approx(spectrum.displacement(t_d), rel=ROUNDING)


def test_ordinates_at_the_corners_by_hand():
    """a_g = .2 g, F0 = 2.4, T_C* = .3 s on soil C: S_S = 1.7 − .6 · 2.4 · .2 = 1.412, T_D = 4 · .2 + 1.6 = 2.4 s."""
    g = 9.80665
    spectrum = DesignSpectrum.ntc(0.2 * g, 2.4, 0.3, "C")
    constant = 1.05 * 0.3 ** (1 - 0.33)
    ground = 0.2 * g * 1.412
    by_hand = {
        0.0: ground,
        constant / 3: ground * 2.4,
        constant: ground * 2.4,
        1.0: ground * 2.4 * constant,
        2.4: ground * 2.4 * constant / 2.4,
        4.0: ground * 2.4 * constant * 2.4 / 16,
    }
    for period, expected in by_hand.items():
        assert spectrum.acceleration(period) == pytest.approx(expected, rel=ROUNDING)
    damped = math.sqrt(10 / 13)  # 8 %
    assert spectrum.acceleration(constant, 0.08) == pytest.approx(ground * 2.4 * damped, rel=ROUNDING)
    assert spectrum.displacement(4.0) == pytest.approx(spectrum.displacement(2.4), rel=ROUNDING)


def test_soil_factors_by_hand():
    """a_g = .2 g, F0 = 2.4, T_C* = .3 s: F0 a_g/g = .48."""
    by_hand = {
        "A": (1.0, 0.3),
        "B": (1.2, 1.10 * 0.3**0.8),  # 1.40 − .192 = 1.208, at most 1.20
        "C": (1.412, 1.05 * 0.3**0.67),
        "D": (1.68, 1.25 * 0.3**0.5),
        "E": (1.472, 1.15 * 0.3**0.6),
    }
    for soil, (factor, constant) in by_hand.items():
        spectrum = DesignSpectrum.ntc(0.2 * GRAVITY, 2.4, 0.3, soil)
        assert spectrum.soil_factor == pytest.approx(factor, rel=ROUNDING)
        assert spectrum.corner_periods[1] == pytest.approx(constant, rel=ROUNDING)


@pytest.mark.parametrize(
    ("ag", "factors"),
    [
        (0.05, {"A": 1, "B": 1.2, "C": 1.5, "D": 1.8, "E": 1.6}),
        (0.6, {"A": 1, "B": 1, "C": 1, "D": 0.9, "E": 1}),
    ],
)
def test_soil_factors_are_held_within_the_limits_of_the_code(ag, factors):
    """Tab. 3.2.IV: F0 a_g/g of .125 and of 1.5 leads beyond either limit of every soil."""
    for soil, factor in factors.items():
        assert DesignSpectrum.ntc(ag * GRAVITY, 2.5, 0.3, soil).soil_factor == pytest.approx(
            factor, rel=ROUNDING
        )


def test_damping_reduces_the_plateau_and_not_the_ground():
    spectrum = DesignSpectrum.ntc(2.0, 2.5, 0.35)
    assert damping_factor(0.08) == pytest.approx(math.sqrt(10 / 13), rel=ROUNDING)
    assert damping_factor(0.4) == 0.55
    assert spectrum.acceleration(0.3, 0.08) == pytest.approx(math.sqrt(10 / 13) * 5.0, rel=ROUNDING)
    assert spectrum.acceleration(0.0, 0.08) == pytest.approx(2.0, rel=ROUNDING)


def test_another_level_is_that_of_the_same_parameters():
    spectrum = DesignSpectrum.ntc(1.0, 2.45, 0.32, "D")
    other = DesignSpectrum.ntc(3.0, 2.45, 0.32, "D")
    periods = np.linspace(0.01, 4, 30)
    np.testing.assert_allclose(
        spectrum.at(3.0).acceleration(periods), other.acceleration(periods), rtol=ROUNDING
    )


def write(folder, text):
    path = folder / "site.csv"
    path.write_text(text)
    return path


def test_points_of_a_file_and_the_lines_between_them(tmp_path):
    spectrum = DesignSpectrum.read(write(tmp_path, "period_s,acceleration_g\n0,0.2\n0.1,0.5\n2,0.1\n"))
    assert spectrum.level == pytest.approx(0.2 * GRAVITY, rel=ROUNDING)
    assert spectrum.words == "3 points from 0 to 2 s, first ordinate 0.2 g, damping 0.05"
    np.testing.assert_allclose(
        spectrum.acceleration([0.05, 1.05]), [0.35 * GRAVITY, 0.3 * GRAVITY], rtol=ROUNDING
    )
    assert spectrum.acceleration(1.05, 0.08) == pytest.approx(
        0.3 * GRAVITY * math.sqrt(10 / 13), rel=ROUNDING
    )
    assert spectrum.acceleration(0.0, 0.08) == spectrum.level
    half_damped = 0.35 * GRAVITY * (1 + math.sqrt(10 / 13)) / 2
    assert spectrum.acceleration(0.05, 0.08) == pytest.approx(half_damped, rel=ROUNDING)
    doubled = spectrum.at(2 * spectrum.level)
    assert doubled.acceleration(1.0) == pytest.approx(2 * spectrum.acceleration(1.0), rel=ROUNDING)
    in_metres = DesignSpectrum.read(write(tmp_path, "period_s,acceleration_m_s2\n0,2\n1,3\n"))
    assert in_metres.acceleration(0.5) == pytest.approx(2.5, rel=ROUNDING)


@pytest.mark.parametrize(("kind", "accuracy"), [("code", ROUNDING), ("points", 1e-4)])
def test_the_largest_displacement_is_that_at_some_period_of_the_range(tmp_path, kind, accuracy):
    """Of the points it may be one within the range; of the code it is that at its end, to rounding."""
    points = write(tmp_path, "period_s,acceleration_g\n0,0.2\n0.1,0.5\n1,0.4\n1.5,0.1\n4,0.01\n")
    spectrum = DesignSpectrum.read(points) if kind == "points" else DesignSpectrum.ntc(2.0, 2.5, 0.35, "C")
    for shortest, level in ((0.1, 1.0), (1.2, 2.0)):
        longest = np.array([0.05, 0.7, 1.3, 3.0])
        found = spectrum.largest_displacement(shortest, longest, level, 0.08)
        for end, largest in zip(longest, found, strict=True):
            periods = np.linspace(min(shortest, end), end, 5001)
            displacements = (periods / (2 * np.pi)) ** 2 * spectrum.at(level).acceleration(periods, 0.08)
            np.testing.assert_allclose(
                spectrum.at(level).displacement(periods, 0.08), displacements, rtol=ROUNDING
            )
            assert largest == pytest.approx(displacements.max(), rel=accuracy)
            alone = spectrum.largest_displacement(shortest, end, level, 0.08)
            assert alone == pytest.approx(largest, rel=ROUNDING)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("period_s,acceleration_g\n0,0.2\n2,0.1\n1,0.3\n", "period 1 s follows 2 s, but periods must ascend"),
        ("period_s,acceleration_g\n-1,0.2\n2,0.1\n", "period is -1.0 s, but must be 0 or more"),
        (
            "period_s,acceleration_g\n0,0.2\n2,-0.1\n",
            "line 3: acceleration_g is -0.1, but must be greater than 0.",
        ),
        (
            "period_s,acceleration_m_s2\n0,150\n2,90\n",
            "the first acceleration is 150 m/s², which is 15.3 g, but",
        ),
        ("period_s,acceleration_g\n0,0.2\n2,\n", "line 3: acceleration_g is '', but must be a number"),
        ("period_s,acceleration_g\n0,0.2\n", "has 1 periods and 1 accelerations, but must have at least 2"),
        ("period,sa\n0,0.2\n", "columns are period, sa, but must be period_s and one of"),
        ("period_s,acceleration_g\n0.2,0.2\n1,0.1\n", "first period is 0.2 s, but must be 0.05 s or less"),
        ("period_s,acceleration_g\n0,0.2\n" + " " * 2**20, "1048576"),
        ('period_s,acceleration_g\n"0,0.2\n', "the spectrum cannot be read as UTF-8 CSV"),
    ],
)
def test_a_file_that_is_no_spectrum_is_refused_in_a_sentence(tmp_path, text, sentence):
    with pytest.raises(ConfigurationError, match=r"site\.csv") as error:
        DesignSpectrum.read(write(tmp_path, text))
    assert sentence in str(error.value)


@pytest.mark.parametrize(
    "values",
    [
        {"f0": "2.5"},
        {"tc_star": 0},
    ],
)
def test_parameters_out_of_range_are_refused(values):
    ((field, value),) = values.items()
    with refused(ConfigurationError, field, value):
        DesignSpectrum.ntc(**{"ag": 2.0, "f0": 2.5, "tc_star": 0.3} | values)


def test_a_period_beyond_the_points_or_below_zero_is_refused(tmp_path):
    spectrum = DesignSpectrum.read(write(tmp_path, "period_s,acceleration_g\n0,0.2\n2,0.1\n"))
    with refused(ConfigurationError, "period", 2.5):
        spectrum.displacement(2.5)
    with refused(ConfigurationError, "period", [-1.0]):
        spectrum.acceleration([-1.0])


def test_what_the_code_has_of_a_site_is_asked_for():
    with refused(ConfigurationError, "f0", None):
        DesignSpectrum.ntc(ag=1.5, tc_star=0.3)
    with refused(ConfigurationError, "ag, f0, tc_star", None):
        DesignSpectrum.ntc()
