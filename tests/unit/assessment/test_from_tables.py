"""The ratios of the closed forms, computed again from the cells of the CSV tables alone."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.constants import g
from scipy.integrate import simpson

from rocking.assessment.assessor import Assessor
from rocking.assessment.rows import StructureRow, rows_of_record, structure_rows
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_as_printed, predict_maximum
from rocking.structures import Arch, Block, Side, Wall
from rocking.tables import write_rows, write_tables
from tests.oracles.sine_on_block import largest_rotation

STRUCTURES = {
    "arch 10 m": Arch(10, 1.5, math.radians(157.5), restitution=0.9),
    "storey wall": Wall.of_size(3.2, 0.25, hinge_height=1.6),
    "block": Block.of_size(0.8, 2.4),
}
STEP = 0.005


def cells(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


@pytest.fixture(scope="module", params=["exact_at_rest", "linearised", "uplift", "mean"])
def folder(request, tmp_path_factory) -> Path:
    """Tables of a pulse of 0.45 g and 0.45 s, by each kind of equivalent block."""
    folder = tmp_path_factory.mktemp(request.param)
    motion = Pulse(amplitude=0.45 * g, circular_frequency=2 * math.pi / 0.45, start_time=1.0).acceleration(
        np.arange(1000) * STEP
    )
    settings = AssessmentSettings(acceleration_scale=request.param, ensemble=EnsembleSettings(members=0))
    result = Assessor(settings).assess("made", [Accelerogram(motion, STEP)], on_the_ground(STRUCTURES))
    write_tables(rows_of_record(result).tables, folder)
    write_rows(StructureRow, structure_rows(STRUCTURES), folder / "structures.csv")
    return folder


def arc(side: Side, rotation_ratio: float) -> float:
    """∫ √(I/I(0)) dφ up to a rotation over the critical one (theory: section 9), the x of a block exact at rest."""

    rotations = np.linspace(0.0, rotation_ratio * side.critical_rotation, 20001)
    return simpson(np.sqrt(side.inertia(rotations) / side.inertia(np.zeros(()))), x=rotations)


def pulse_of(folder: Path, row: dict[str, str]) -> tuple[float, float]:
    """Amplitude [m/s²] and circular frequency [rad/s] of the pulse that predicts."""
    (pulse,) = [
        cell
        for cell in cells(folder / "pulses.csv")
        if cell["kind"] == "alternative" and cell["rank"] == row["pulse_rank"]
    ]
    return float(pulse["amplitude_m_s2"]), float(pulse["circular_frequency_rad_s"])


def block_of(folder: Path, structure: str) -> tuple[float, float]:
    """Uplift multiplier and p of the block that predicts, by what structures.csv says of the structure."""
    (row,) = [cell for cell in cells(folder / "structures.csv") if cell["structure"] == structure]
    critical = float(row["critical_rotation_rad"])
    linearised = float(row["acceleration_scale_linearised"])
    uplift = float(row["acceleration_scale_uplift"])
    p = float(row["frequency_parameter_rad_s"])
    kinds = {
        "exact_at_rest": (float(row["uplift_multiplier"]), float(row["frequency_parameter_at_rest_rad_s"])),
        "linearised": (critical / linearised, p),
        "uplift": (critical / uplift, p),
        "mean": (critical / ((linearised + uplift) / 2), p),
    }
    return next(kinds[name] for name in kinds if folder.name.startswith(name))


def equation_15(a: float, omega: float, eta: float) -> float:
    """φ_max/φ_cr by Eqs. 15 and 16, typed by hand from the paper in the form that conserves energy; inf: overturning.

    D₀ = (ω/(ω²+1))² {ω² − 2a² + 1 + (s+ω) a/E + (s−ω) a E}, E = exp((2π − asin(1/a))/ω), s = √(a²−1).
    """
    slope = math.sqrt(a**2 - 1)
    grown = math.exp((2 * math.pi - math.asin(1 / a)) / omega)
    braces = omega**2 - 2 * a**2 + 1 + (slope + omega) * a / grown + (slope - omega) * a * grown
    radicand = 1 - eta**2 * (1 - (omega / (omega**2 + 1)) ** 2 * braces)
    return math.inf if radicand < 0 else 1 - math.sqrt(radicand)


def test_the_equation_as_printed_follows_from_the_tables_whatever_block_predicts(folder):
    """In its regime and out of it: λ of Eq. 7 and p of Eq. 11 stand in the row, the sine in pulses.csv."""
    for row in cells(folder / "comparison.csv"):
        amplitude, omega = pulse_of(folder, row)
        multiplier, p, eta = (
            float(row[name]) for name in ("uplift_multiplier", "frequency_parameter_rad_s", "restitution")
        )
        expected = equation_15(amplitude / (g * multiplier), omega / p, eta)
        assert float(row["printed_rotation_ratio"]) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("a", "omega", "holds", "printed"),
    [
        (1.5, 4.0, False, 0.76),
        (3.0, 2.5, False, 0.43),
        (10.0, 6.0, False, 0.46),
        (24.0, 8.0, False, -0.20),
        (3.0, 8.0, True, 0.25),
        (8.0, 7.0, True, 0.84),
        (6.0, 6.0, True, math.inf),
    ],
)
def test_the_equation_is_printed_in_and_out_of_its_regime(a, omega, holds, printed):
    """Against the equation by hand, at the points where theory.md tells what is wrong with it."""
    wall = Wall.of_size(3.2, 0.25, hinge_height=1.6, restitution=0.9).mechanism()
    side = wall.positive
    pulse = Pulse(
        amplitude=a * g * side.uplift_multiplier, circular_frequency=omega * side.frequency_parameter
    )
    told = predict_as_printed(wall, pulse)
    assert told.rotation_ratio == pytest.approx(equation_15(a, omega, 0.9), rel=1e-9)
    assert told.rotation_ratio == pytest.approx(printed, abs=0.006)
    assert told.holds is holds
    if holds:
        assert told.rotation_ratio == pytest.approx(
            predict_maximum(told.block, pulse).rotation_ratio, rel=1e-9
        )


def test_the_closed_form_follows_from_the_tables(folder):
    """x of the block by the flights of an oracle; where the block is linearised, x is the rotation ratio.

    1e-7: the search of the oracle for the instant of an impact, and its integral of the arc, carried on.
    """
    for row in cells(folder / "comparison.csv"):
        amplitude, omega = pulse_of(folder, row)
        multiplier, p = block_of(folder, row["structure"])
        a, w, eta = (float(row[name]) for name in ("amplitude_ratio", "frequency_ratio", "restitution"))
        assert 1 < a == pytest.approx(amplitude / (g * multiplier), rel=1e-12)
        assert w == pytest.approx(omega / p, rel=1e-12)
        x = largest_rotation(1.0, eta, a, w)
        assert 0.01 < x < math.inf
        rotation = float(row["predicted_rotation_ratio"])
        if folder.name.startswith("exact_at_rest"):
            side = STRUCTURES[row["structure"]].mechanism().positive
            assert arc(side, rotation) / arc(side, 1.0) == pytest.approx(x, rel=1e-7)
        else:
            assert rotation == pytest.approx(x, rel=1e-7)
