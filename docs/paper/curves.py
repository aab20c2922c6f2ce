"""The curves of the source paper's figures, computed here; each is a row of data before it is a line on paper."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from docs.paper.equivalence import (
    block_overturning_time,
    block_period,
    natural_period,
    overturning_time,
    uplift_ratio,
)
from rocking.quantities import GRAVITY
from rocking.sine_pulse import overturning_amplitudes
from rocking.structures.arch import Arch
from rocking.structures.block import Spire
from rocking.structures.mechanism import Scale, Side
from rocking.structures.structure import Candidate
from rocking.structures.wall import Wall
from rocking.tables import Row, column, row

WALL_SLENDERNESS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3)
"""α of the walls of Figs. 3 and 4, rad."""
ARCH_THICKNESS = (0.11, 0.13, 0.16, 0.20, 0.25)
"""t/r of the semicircular arches of Figs. 6 and 7."""
AMPLITUDES = np.linspace(0.02, 0.98, 33)
ACCELERATIONS = np.geomspace(1.1, 10, 17)
HEIGHT_RATIOS = np.geomspace(0.2, 5, 241)
"""h₂/h₁ of the curves of Eq. 14."""

PERIODS = np.linspace(0.4, 4.4, 81)
"""Of the sines of the envelope, s."""
ENVELOPE_CRACKS = 41
"""Heights at which the spire of the envelope may crack."""

PULSE_PERIOD = "period of the sine [s]"
OVERTURNS_AT = "least amplitude that overturns [g]"
AMPLITUDE = "amplitude / critical rotation [-]"
PERIOD = "period, block / structure [-]"
UPLIFT = "uplift, linearised / true [-]"
ACCELERATION = "ground acceleration / uplift acceleration [-]"
OVERTURNING = "time to overturn, block / structure [-]"
ROTATION = "rotation / critical rotation [-]"


@row("curves", "The curves of a figure, one row per point")
class CurveRow(Row):
    """One point of one curve."""

    panel: str = column("Panel of the figure")
    curve: str = column("Label of the curve in the legend")
    x_quantity: str = column("What x is, with its unit")
    x: float = column("Abscissa")
    y_quantity: str = column("What y is, with its unit")
    y: float = column("Ordinate")


@dataclass(frozen=True, eq=False)
class Curve:
    """One line of one panel: what x and y are (with unit), and their values (k,). An empty style takes its turn."""

    panel: str
    label: str
    x_quantity: str
    y_quantity: str
    x: np.ndarray
    y: np.ndarray
    style: str = ""


@cache
def wall_sides() -> dict[str, Side]:
    """Return the walls of Figs. 3 and 4, hinged at mid-height, by label."""
    return {
        f"α = {slenderness:g} rad": _wall(slenderness).mechanism().positive
        for slenderness in WALL_SLENDERNESS
    }


def printed_wall_sides() -> dict[str, Side]:
    """Return the same walls with the inertia of Eq. 4 as printed: 6R sin²(α − φ) where 2R sin²(α − φ) is right."""
    return {label: with_printed_inertia(side) for label, side in wall_sides().items()}


def with_printed_inertia(side: Side) -> Side:
    """Return the side of an equal-halves wall with I and J of Eq. 4 as printed, divided like the side itself.

    I_O/(2mR) + 2R sin² is I(φ_cr) + (I(φ) − I(φ_cr)); the misprint triples the second part.
    """
    critical = side.at("inertia", side.critical_rotation)
    return replace(
        side,
        inertia=lambda rotation: critical + 3 * (side.inertia(rotation) - critical),
        inertia_slope=lambda rotation: 3 * side.inertia_slope(rotation),
    )


@cache
def arch_sides() -> dict[str, Side]:
    """Return the semicircular arches of Figs. 6 and 7, by label."""
    return {
        f"t/r = {thickness:g}": Arch(1.0, thickness, np.pi).mechanism().positive
        for thickness in ARCH_THICKNESS
    }


def period_curves(sides: dict[str, Side], panel: str, scale: Scale = "linearised") -> list[Curve]:
    """Return block over true period of free rocking against amplitude (Figs. 3a and 6a)."""
    curves = []
    for label, side in sides.items():
        true = [natural_period(side, u * side.critical_rotation) for u in AMPLITUDES]
        block = [block_period(side, u, scale) for u in AMPLITUDES]
        curves.append(Curve(panel, label, AMPLITUDE, PERIOD, AMPLITUDES, np.divide(block, true)))
    return curves


def overturning_curves(sides: dict[str, Side], scale: Scale, panel: str) -> list[Curve]:
    """Return block over true time to φ_cr under constant acceleration (Figs. 4 and 7)."""
    curves = []
    for label, side in sides.items():
        true = np.array([overturning_time(side, ratio) for ratio in ACCELERATIONS])
        block = np.array([block_overturning_time(side, ratio, scale) for ratio in ACCELERATIONS])
        both = np.isfinite(true) & np.isfinite(block)
        curves.append(
            Curve(panel, label, ACCELERATION, OVERTURNING, ACCELERATIONS[both], (block / true)[both])
        )
    return curves


def wall_uplift_curve(panel: str) -> Curve:
    """Return λ_lin/λ of the wall against its slenderness (Fig. 3b)."""
    slenderness = np.linspace(0.02, 0.4, 39)
    ratios = np.array([uplift_ratio(_wall(alpha).mechanism().positive) for alpha in slenderness])
    return Curve(panel, "wall, hinge at mid-height", "slenderness α [rad]", UPLIFT, slenderness, ratios)


def arch_uplift_curve(panel: str) -> Curve:
    """Return λ_lin/λ of the semicircular arch against its thickness (Fig. 6b)."""
    thickness = np.linspace(0.109, 0.28, 30)
    ratios = np.array([uplift_ratio(Arch(1.0, t, np.pi).mechanism().positive) for t in thickness])
    return Curve(panel, "semicircular arch", "thickness / radius [-]", UPLIFT, thickness, ratios)


def hinge_height_curves(thickness_ratio: float = 0.1) -> list[Curve]:
    """Return p √(H/g) against h₂/h₁ at fixed height H, by Eq. 14 as printed and as corrected."""
    scale = np.sqrt(1 / GRAVITY)
    printed = [printed_frequency_parameter(_hinged(x, thickness_ratio)) for x in HEIGHT_RATIOS]
    right = [_hinged(x, thickness_ratio).mechanism().positive.frequency_parameter for x in HEIGHT_RATIOS]
    names = ("Eq. 14 as printed", "Eq. 14 corrected")
    return [
        Curve("a", name, "h₂/h₁ [-]", "p √(H/g) [-]", HEIGHT_RATIOS, scale * np.array(values), style)
        for name, values, style in zip(names, (printed, right), ("--", "-"), strict=True)
    ]


def printed_frequency_parameter(wall: Wall) -> float:
    """p_eq of Eq. 14 exactly as the paper prints it, rad/s."""
    x = wall.upper_height / wall.lower_height
    r1, r2 = (np.hypot(height, wall.thickness) / 2 for height in (wall.lower_height, wall.upper_height))
    return float(np.sqrt(3 * GRAVITY / (4 * r1) * (1 + 2 * x + x * r1 / r2) / (1 + x * (r2 / r1) ** 2)))


def _wall(slenderness: float) -> Wall:
    # restitution plays no part in these figures; a number keeps the squat walls from asking for one
    return Wall(1.0, 1.0, float(np.tan(slenderness)), restitution=0.9)


def _hinged(height_ratio: float, thickness_ratio: float) -> Wall:
    return Wall.of_size(1.0, thickness_ratio, 1 / (1 + height_ratio), restitution=0.9)


@cache
def envelope_cracks() -> tuple[Candidate, ...]:
    """Return the cracks that may form in the spire of the envelope, from its base up."""
    spire = Spire(width=3.0, height=15.0, wall_thickness=0.25)
    return tuple(sorted(spire.candidates(ENVELOPE_CRACKS), key=lambda candidate: candidate.position))


def overturning_spectra() -> np.ndarray:
    """Return the least amplitude [m/s²] of one sine of each of PERIODS that overturns each crack, (cracks, periods)."""
    blocks = [
        candidate.structure.mechanism().equivalent_block("exact_at_rest") for candidate in envelope_cracks()
    ]
    return overturning_amplitudes(blocks, 2 * np.pi / PERIODS)


def envelope_curves() -> list[Curve]:
    """Return the overturning spectra of single cracks and their envelope (a), and the crack that governs (b)."""
    cracks, spectra = envelope_cracks(), overturning_spectra() / GRAVITY
    heights = np.array([crack.position for crack in cracks])
    lines = []
    for name, place in (("tip", -1), ("lower quarter", int(np.abs(heights - 3.75).argmin())), ("base", 0)):
        label = f"crack at {heights[place]:.3g} m ({name})"
        lines.append(Curve("a", label, PULSE_PERIOD, OVERTURNS_AT, PERIODS, spectra[place]))
    least = spectra.min(axis=0)
    lines.append(Curve("a", "envelope of all cracks", PULSE_PERIOD, OVERTURNS_AT, PERIODS, least, "-"))
    governing = heights[spectra.argmin(axis=0)]
    lines.append(
        Curve("b", "crack that governs", PULSE_PERIOD, "height of the crack [m]", PERIODS, governing, "-")
    )
    return lines


def rows_of(curves: Sequence[Curve]) -> list[CurveRow]:
    """Return all points of all curves."""
    return [
        CurveRow(
            panel=curve.panel,
            curve=curve.label,
            x_quantity=curve.x_quantity,
            x=x,
            y_quantity=curve.y_quantity,
            y=y,
        )
        for curve in curves
        for x, y in zip(curve.x.tolist(), curve.y.tolist(), strict=True)
    ]
