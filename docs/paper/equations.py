"""The equations that the source paper prints with a slip: printed, corrected, and the number that decides.

The deciding numbers share nothing with either form: they come from the drawing of the structure (where its parts are
at two neighbouring rotations) or from the integration.
"""

import math

import numpy as np

from docs.paper.curves import HEIGHT_RATIOS, hinge_height_curves, printed_frequency_parameter
from rocking.motion.integration import integrate
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.sine_pulse import predict_maximum, printed_maximum
from rocking.structures.block import Block
from rocking.structures.mechanism import EquivalentBlock
from rocking.structures.structure import Structure
from rocking.structures.wall import Wall
from rocking.tables import Row, column, row


@row(
    "equations", "One row per equation that the source paper prints with a slip, with the number that decides"
)
class EquationRow(Row):
    """One slip, both forms, and the number that decides between them."""

    equation: str = column("Number of the equation in the paper")
    printed: str = column("What the paper prints")
    corrected: str = column("What is right")
    quantity: str = column("The number by which it is decided, with its unit")
    printed_number: float = column("That number by the printed form; INF if it overturns")
    corrected_number: float = column("That number by the corrected form; INF if it overturns")
    deciding_number: float = column("That number from something that uses neither; INF if it overturns")
    decided_by: str = column("Where the deciding number comes from")


_ALPHA = 0.2
_EQUAL = Wall(2 * math.cos(_ALPHA), 2 * math.cos(_ALPHA), 2 * math.sin(_ALPHA))
"""Two equal blocks of semi-diagonal 1 m and slenderness 0.2 rad."""
_UNEQUAL = Wall(1.0, 2.0, 0.3)
"""A wall hinged at a third of its height."""
_DRAWING = "positions of the parts in the drawing, at neighbouring rotations"


def equation_rows() -> list[EquationRow]:
    """Return the equations."""
    return [*_sign_rows(), *_inertia_rows(), *_hinge_rows(), *_pulse_rows()]


def _row(
    equation: str, forms: tuple[str, str], quantity: str, numbers: tuple[float, float, float], by: str
) -> EquationRow:
    names = ("printed_number", "corrected_number", "deciding_number")
    values = dict(zip(names, map(float, numbers), strict=True))
    return EquationRow(
        equation=equation, printed=forms[0], corrected=forms[1], quantity=quantity, decided_by=by, **values
    )


def _sign_rows() -> list[EquationRow]:
    block = Block(1.0, _ALPHA)
    released = -GRAVITY * drawn_gravity(block, 0.0) / drawn_inertia(block, 0.0)
    linear = 0.75 * GRAVITY * _ALPHA  # p² θ_cr of a block of semi-diagonal 1 m
    quantity = "angular acceleration of a block released at rest (R = 1 m, α = 0.2 rad) [rad/s²]"
    forms = ("p² (θ_cr − θ − ü/g)", "p² (θ − θ_cr − ü/g)")
    rows = [_row("3", forms, quantity, (linear, -linear, released), _DRAWING)]
    wall = -GRAVITY * drawn_gravity(_EQUAL, 0.0) / drawn_inertia(_EQUAL, 0.0)
    quantity = "angular acceleration of a wall released at rest (R = 1 m, α = 0.2 rad) [rad/s²]"
    right = GRAVITY * math.sin(_ALPHA) / (2 / 3 + 2 * math.sin(_ALPHA) ** 2)
    forms = ("+J φ'² − G g", "−J φ'² + G g, with J and G of Eq. 6")
    rows.append(_row("5 with 6", forms, quantity, (right, -right, wall), _DRAWING))
    linear = GRAVITY * _ALPHA / (2 / 3)
    forms = ("+G_eq (φ − φ_cr) g", "−G_eq (φ − φ_cr) g")
    return [*rows, _row("8, 9", forms, f"{quantity}, linearised", (linear, -linear, wall), _DRAWING)]


def _inertia_rows() -> list[EquationRow]:
    sine = math.sin(_ALPHA) ** 2
    forms = ("I_O/(2mR) + 6R sin²(α − φ)", "I_O/(2mR) + 2R sin²(α − φ)")
    # the equation stands divided by 4mR, and the drawing has mass 1 m² per block of 4 sin α cos α m²
    drawn = drawn_inertia(_EQUAL, 0.0) / (4 * 4 * math.sin(_ALPHA) * math.cos(_ALPHA))
    quantity = "I at φ = 0 (R = 1 m, α = 0.2 rad) [m]"
    return [_row("4, 6", forms, quantity, (2 / 3 + 6 * sine, 2 / 3 + 2 * sine, drawn), _DRAWING)]


def _hinge_rows() -> list[EquationRow]:
    side = _UNEQUAL.mechanism().positive
    critical = math.atan2(_UNEQUAL.thickness, _UNEQUAL.lower_height)
    slope = _derivative(lambda rotation: drawn_gravity(_UNEQUAL, rotation), critical)
    frequency = math.sqrt(-GRAVITY * slope / drawn_inertia(_UNEQUAL, critical))
    scale = -drawn_ground(_UNEQUAL, critical) / slope
    uplift = drawn_gravity(_UNEQUAL, 0.0) / drawn_ground(_UNEQUAL, 0.0)
    wall = "(h₁ = 1 m, h₂ = 2 m, 2b = 0.3 m)"
    forms = ("denominator 1 + (h₂/h₁)(R₂/R₁)²", "denominator 1 + h₂/h₁")
    numbers = (printed_frequency_parameter(_UNEQUAL), side.frequency_parameter, frequency)
    rows = [_row("14, p", forms, f"p {wall} [rad/s]", numbers, _DRAWING)]
    rows.append(_largest_row())
    forms = ("a_sc = 0.5 for every hinge height", "(1 + x)/(1 + 2x + x R₁/R₂), x = h₂/h₁")
    rows.append(_row("14, a_sc", forms, f"a_sc {wall} [-]", (0.5, side.acceleration_scale, scale), _DRAWING))
    forms = ("2 α₁", "2 tan α₁")
    numbers = (2 * critical, side.uplift_multiplier, uplift)
    return [*rows, _row("14, λ", forms, f"uplift acceleration {wall} [g]", numbers, _DRAWING)]


def _largest_row() -> EquationRow:
    printed, right = (HEIGHT_RATIOS[int(np.argmax(curve.y))] for curve in hinge_height_curves())
    drawn = []
    coarse = HEIGHT_RATIOS[::20]
    for ratio in coarse:
        wall = Wall.of_size(1.0, 0.1, 1 / (1 + ratio), restitution=0.9)
        critical = math.atan2(wall.thickness, wall.lower_height)
        drawn.append(
            -_derivative(lambda at, wall=wall: drawn_gravity(wall, at), critical)
            / drawn_inertia(wall, critical)
        )
    forms = ("p is largest at h₂/h₁ = 0.74", "p grows with h₂/h₁")
    quantity = "h₂/h₁ of the largest p between 0.2 and 5, at fixed height (2b/H = 0.1) [-]"
    return _row("14, text", forms, quantity, (printed, right, coarse[int(np.argmax(drawn))]), _DRAWING)


def _pulse_rows() -> list[EquationRow]:
    rows = []
    for amplitude, frequency in ((3.0, 2.5), (10.0, 6.0), (1.5, 4.0)):
        block = EquivalentBlock(
            frequency_parameter=1.0, critical_rotation=1.0, acceleration_scale=1.0, restitution=0.9
        )  # λ = 1 g and p = 1 rad/s: the pulse carries a and ω
        pulse = Pulse(amplitude=amplitude * GRAVITY, circular_frequency=frequency)
        numbers = (
            printed_maximum(block, pulse),
            predict_maximum(block, pulse).rotation_ratio,
            integrate(block, pulse).rotation_ratio,
        )
        forms = (
            "Eq. 15 always",
            "Eq. 15 where no contact precedes the pulse's end and the peak follows the first impact",
        )
        quantity = f"φ_max/φ_cr at a = {amplitude:g}, ω = {frequency:g}, η = 0.9 [-]"
        rows.append(_row("15", forms, quantity, numbers, "integration of the equivalent block"))
    return rows


def drawn_inertia(structure: Structure, rotation: float) -> float:
    """Return Σ m|r'|² + I_c ω² from the drawing, for parts of mass 1 per m² [m⁴]."""
    total = 0.0
    for part in range(len(structure.outline())):
        area, _, spread = _section(structure.outline(rotation)[part])
        velocity = _derivative(lambda at, part=part: _section(structure.outline(at)[part])[1], rotation)
        spin = _derivative(lambda at, part=part: _direction(structure.outline(at)[part]), rotation)
        total += area * abs(velocity) ** 2 + spread * spin**2
    return total


def drawn_gravity(structure: Structure, rotation: float) -> float:
    """Return dV/dφ per g from the drawing [m³]."""
    return _derivative(lambda at: _moment(structure, at).imag, rotation)


def drawn_ground(structure: Structure, rotation: float) -> float:
    """Return Σ m x' from the drawing [m³]."""
    return _derivative(lambda at: _moment(structure, at).real, rotation)


def _moment(structure: Structure, rotation: float) -> complex:
    sections = (_section(part) for part in structure.outline(rotation))
    return sum(area * centroid for area, centroid, _ in sections)


def _derivative(function, at: float, step: float = 2e-3):
    """Six points, forward where the motion ends at 0; the error is of the order of step⁶."""
    if at > 3 * step:
        weights = {-3: -1 / 60, -2: 3 / 20, -1: -3 / 4, 1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
    else:
        weights = {0: -49 / 20, 1: 6, 2: -15 / 2, 3: 20 / 3, 4: -15 / 4, 5: 6 / 5, 6: -1 / 6}
    return sum(weight * function(at + place * step) for place, weight in weights.items()) / step


def _direction(polygon: np.ndarray) -> float:
    edge = polygon[1] - polygon[0]
    return math.atan2(edge[1], edge[0])


def _section(polygon: np.ndarray) -> tuple[float, complex, float]:
    """Area [m²], centroid (complex) [m] and polar second moment about it [m⁴] of a polygon."""
    points = polygon[:, 0] + 1j * polygon[:, 1]
    after = np.roll(points, -1)
    crosses = (points.conj() * after).imag
    area = crosses.sum() / 2
    centroid = ((points + after) * crosses).sum() / (6 * area)
    spread = ((abs(points) ** 2 + (points.conj() * after).real + abs(after) ** 2) * crosses).sum() / 12
    return abs(area), centroid, abs(spread) - abs(area) * abs(centroid) ** 2
