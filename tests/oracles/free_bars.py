"""Arches under fill and on piers as free bars pinned at their hinges: masses by quadrature, λ by virtual work."""

import numpy as np
from multibody import Bar, Multibody, Pin

from rocking.quantities import GRAVITY
from rocking.structures import Arch, ArchOnPiers

NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def ring_part(arch, first, last):
    """Masses and places of the ring and its fill between two angles from the vertical, by quadrature: (k,), (k, 2)."""
    inner, outer = arch.radius - arch.thickness / 2, arch.radius + arch.thickness / 2
    angle = (last - first) / 2 * NODES + (last + first) / 2
    radius = (outer - inner) / 2 * NODES + (outer + inner) / 2
    r, v = np.meshgrid(radius, angle)
    mass = np.outer(WEIGHTS * (last - first) / 2, WEIGHTS * (outer - inner) / 2) * r
    masses, places = [mass.ravel()], [np.stack([(r * np.sin(v)).ravel(), (r * np.cos(v)).ravel()], axis=1)]
    if arch.fill_depth is not None:
        x, y = outer * np.sin(angle), outer * np.cos(angle)
        column = (outer + arch.fill_depth - y) * arch.fill_density_ratio
        masses.append(column * outer * np.cos(angle) * WEIGHTS * (last - first) / 2)
        places.append(np.stack([x, y], axis=1))
    return np.concatenate(masses), np.concatenate(places)


def pier_part(arch, side):
    """The same of a pier; its four quarters' Gauss points, exact for its inertia."""
    left, low, width, height = pier_box(arch, side)
    nodes, weights = np.polynomial.legendre.leggauss(2)
    x, y = np.meshgrid(left + width * (nodes + 1) / 2, low + height * (nodes + 1) / 2)
    mass = np.outer(weights, weights) / 4 * width * height * arch.pier_density_ratio
    return mass.ravel(), np.stack([x.ravel(), y.ravel()], axis=1)


def pier_box(arch, side):
    inner = (arch.radius - arch.thickness / 2) * np.sin(arch.embrace_angle / 2)
    top = (arch.radius - arch.thickness / 2) * np.cos(arch.embrace_angle / 2)
    left = inner if side > 0 else -inner - arch.pier_width
    return left, top - arch.pier_height, arch.pier_width, arch.pier_height


def bar(parts):
    masses, places = np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])
    centre = masses @ places / masses.sum()
    return Bar(masses.sum(), float(masses @ ((places - centre) ** 2).sum(axis=1)), centre)


def hinge_point(arch, place, intrados):
    """place: an angle from the vertical, or "left" or "right" for a foot."""
    if isinstance(place, str):
        left, low, width, _ = pier_box(arch, 1 if place == "right" else -1)
        inner_is_left = place == "right"
        return np.array([left if inner_is_left == intrados else left + width, low])
    radius = arch.radius + (-1 if intrados else 1) * arch.thickness / 2
    return radius * np.array([np.sin(place), np.cos(place)])


def free_bars(arch, places):
    """Free bars pinned at four hinges A (intrados), B, C, D; feet carry their pier."""
    half = arch.embrace_angle / 2
    angles = [-half if p == "left" else half if p == "right" else p for p in places]
    bars = []
    for k in range(3):
        parts = [ring_part(arch, angles[k], angles[k + 1])]
        if k == 0 and places[0] == "left":
            parts.append(pier_part(arch, -1))
        if k == 2 and places[3] == "right":
            parts.append(pier_part(arch, 1))
        bars.append(bar(parts))
    points = [hinge_point(arch, place, k % 2 == 0) for k, place in enumerate(places)]
    pins = (Pin(points[0], 0), Pin(points[1], 1, 0), Pin(points[2], 2, 1), Pin(points[3], 2))
    return Multibody(tuple(bars), pins, GRAVITY)


def multiplier(arch, places):
    """λ of one mechanism by virtual work; inf where a hinge would have to close."""
    system = free_bars(arch, places)
    with np.errstate(all="ignore"):
        spins = system.spins_for(np.zeros(3), -1.0)
    opening = np.diff(np.concatenate([[0.0], spins, [0.0]])) * np.array([1, -1, 1, -1])
    if not np.isfinite(spins).all() or (opening > 1e-9).any():
        return np.inf
    points = [pin.point for pin in system.pins]
    speeds = []
    pivots, velocity = [points[0], points[1], points[3]], [np.zeros(2), None, np.zeros(2)]
    velocity[1] = spins[0] * np.array([-(points[1] - points[0])[1], (points[1] - points[0])[0]])
    for spin, pivot, base, one_spin in zip(spins, pivots, velocity, system.bars, strict=True):
        arm = one_spin.centre - pivot
        speeds.append(one_spin.mass * (base + spin * np.array([-arm[1], arm[0]])))
    across, up = np.sum(speeds, axis=0)
    return up / across if across > 1e-12 else np.inf


def places_of(arch):
    half = arch.embrace_angle / 2
    sections = arch.onset.hinges - half
    return ["left" if s < -half - 0.5 else "right" if s > half + 0.5 else float(s) for s in sections]


FILLED = Arch(5.0, 0.9, np.radians(160), 8, fill_depth=0.4, fill_density_ratio=0.8)
SMOOTH = Arch(5.0, 0.7, np.radians(150), fill_depth=0.3, fill_density_ratio=0.75)
ONE = ArchOnPiers(5.0, 0.8, np.radians(150), 7, pier_width=2.2, pier_height=4.0)
BOTH = ArchOnPiers(4.0, 1.8, np.radians(100), 7, pier_width=2.0, pier_height=2.0)
UNDER_FILL = ArchOnPiers(
    5.0, 0.8, np.radians(160), fill_depth=0.4, pier_width=2.6, pier_height=4.0, pier_density_ratio=0.9
)
