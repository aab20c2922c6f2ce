"""Arches under fill and on piers: limits, brute virtual work over all hinges, motion of free bars, refusals."""

import dataclasses
import itertools

import numpy as np
import pytest
from multibody import Bar, Multibody, Pin
from scipy.integrate import solve_ivp

from rocking.quantities import GRAVITY
from rocking.structures import Arch
from rocking.structures.arch import ArchOnPiers

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


def bodies(arch, places):
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
    system = bodies(arch, places)
    with np.errstate(all="ignore"):
        spins = system.spins_for(np.zeros(3), -1.0)
    opening = np.diff(np.concatenate([[0.0], spins, [0.0]])) * np.array([1, -1, 1, -1])
    if not np.isfinite(spins).all() or (opening > 1e-9).any():
        return np.inf
    points = [pin.point for pin in system.pins]
    speeds = []
    pivots, velocity = [points[0], points[1], points[3]], [np.zeros(2), None, np.zeros(2)]
    velocity[1] = spins[0] * np.array([-(points[1] - points[0])[1], (points[1] - points[0])[0]])
    for spin, pivot, base, each in zip(spins, pivots, velocity, system.bars, strict=True):
        arm = each.centre - pivot
        speeds.append(each.mass * (base + spin * np.array([-arm[1], arm[0]])))
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


@pytest.mark.parametrize("arch", [FILLED, ONE, BOTH], ids=["fill", "one pier", "both piers"])
def test_no_mechanism_of_all_joints_and_feet_is_weaker(arch):
    """The static multiplier is the smallest over all alternating hinges, by virtual work of masses from quadrature."""
    half = arch.embrace_angle / 2
    joints = [float(angle) for angle in np.linspace(-half, half, arch.voussoirs + 1)]
    if isinstance(arch, ArchOnPiers):
        joints = ["left", *joints, "right"]
    found = {tuple(four): multiplier(arch, four) for four in itertools.combinations(joints, 4)}
    assert arch.onset.multiplier == pytest.approx(min(found.values()), rel=1e-9)


@pytest.mark.parametrize("arch", [FILLED, SMOOTH, ONE, BOTH, UNDER_FILL])
def test_the_linkage_starts_at_the_static_multiplier(arch):
    assert arch.mechanism().uplift_multiplier == pytest.approx(arch.onset.multiplier, rel=1e-9)
    assert multiplier(arch, places_of(arch)) == pytest.approx(arch.onset.multiplier, rel=1e-9)


@pytest.mark.parametrize("arch", [SMOOTH, ONE, BOTH, UNDER_FILL])
def test_motion_and_thrusts_are_those_of_free_bars_with_constraints(arch):
    system, mechanism = bodies(arch, places_of(arch)), arch.mechanism()
    times = np.linspace(0.0, 0.2, 11)
    reach = 0.5 * mechanism.critical_rotation
    speed = reach / 0.2

    def ground(time):
        return 1.5 * np.sin(7.0 * time + 0.4) - 0.8

    def vertical(time):
        return 2.0 * np.cos(11.0 * time)

    def rate(time, state):
        return [
            state[1],
            float(mechanism.angular_acceleration(state[0], state[1], ground(time), vertical(time))),
        ]

    motion = solve_ivp(rate, (0.0, times[-1]), [0.0, speed], "DOP853", times, rtol=1e-12, atol=1e-14)
    assert motion.y[0].min() >= 0 and motion.y[0].max() > 0.2 * mechanism.critical_rotation
    angles, _ = system.simulate(-speed, times, ground, vertical)
    np.testing.assert_allclose(-angles[:, 0], motion.y[0], rtol=0, atol=1e-8 * motion.y[0].max())
    contacts = arch.contact_forces(
        0.1 * reach, speed, mechanism.angular_acceleration(0.1 * reach, speed, 1.3, -2.0), 1.3, -2.0
    )
    state = arch.linkage.motion(0.1 * reach)
    _, forces = system.solve(state.angles, state.spins * speed, 1.3, -2.0)
    half = arch.embrace_angle / 2
    mass = ring_part(arch, -half, half)[0].sum()
    if isinstance(arch, ArchOnPiers):
        mass += sum(pier_part(arch, side)[0].sum() for side in (-1, 1))
    for hinge in range(4):
        size = np.hypot(*forces[2 * hinge : 2 * hinge + 2]) / mass
        assert np.hypot(contacts.normal[hinge, 0], contacts.tangential[hinge, 0]) == pytest.approx(
            size, rel=1e-8
        )


def test_without_fill_and_on_stout_piers_an_arch_is_an_arch():
    plain = Arch(10.0, 1.5, np.radians(157.5))
    others = (
        Arch(10.0, 1.5, np.radians(157.5), fill_depth=0.2, fill_density_ratio=0.0),
        ArchOnPiers(10.0, 1.5, np.radians(157.5), pier_width=30.0, pier_height=5.0),
    )
    for other in others:
        for name in ("uplift_multiplier", "critical_rotation", "frequency_parameter", "acceleration_scale"):
            assert getattr(other.mechanism().positive, name) == pytest.approx(
                getattr(plain.mechanism().positive, name), rel=1e-11
            )
    assert others[1].onset.hinges == pytest.approx(plain.onset.hinges, abs=1e-9)


@pytest.mark.parametrize("arch", [UNDER_FILL, dataclasses.replace(ONE, voussoirs=None)])
def test_thrust_line_runs_from_foot_to_foot_inside_arch_and_piers(arch):
    line = arch.thrust_line(2001)
    ring = np.linalg.norm(line[1:-1], axis=1)
    assert ring.min() > arch.radius - arch.thickness / 2 - 1e-9
    assert ring.max() < arch.radius + arch.thickness / 2 + 1e-9
    for end, side in ((0, -1), (-1, 1)):
        left, low, width, _ = pier_box(arch, side)
        assert left - 1e-9 <= line[end, 0] <= left + width + 1e-9
        assert line[end, 1] == pytest.approx(low)
    for hinge in arch.hinges(0.0):
        assert np.linalg.norm(line - hinge, axis=1).min() < 1e-2


@pytest.mark.parametrize("arch", [FILLED, ONE, UNDER_FILL], ids=["fill", "one pier", "piers under fill"])
def test_other_mechanisms_have_the_multiplier_of_virtual_work(arch):
    """Of masses from quadrature, with fill and with piers that turn or stand still."""
    found = arch.candidates(6)
    assert len(found) >= 4
    for each in found:
        assert each.multiplier == pytest.approx(multiplier(arch, places_of(each.structure)), rel=1e-9)


def test_a_pier_may_turn_about_its_springing_alone():
    """Hinge C at the springing leaves no ring to the pier; λ and φ_cr of another's derivation."""
    arch = ArchOnPiers(5.0, 0.8, np.radians(90), pier_width=1.5, pier_height=4.0)
    assert arch.mechanism().uplift_multiplier == pytest.approx(0.0484, abs=5e-5)
    assert arch.mechanism().uplift_multiplier == pytest.approx(multiplier(arch, places_of(arch)), rel=1e-9)
