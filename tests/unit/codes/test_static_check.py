"""The linear and nonlinear check beside calculations by hand, from the formulas of the code and their own geometry.

Nothing of the product is used to expect a number: weights, virtual displacements, zeros and the spectrum are written
out here. All agree to 1e-9, as both are sums of a few terms and one root each.
"""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

import rocking
from rocking import Arch, Block, DesignSpectrum, Facade, LoadedWall, Mode, Spire, Support, Wall
from rocking.codes import static_check
from rocking.codes.check import Check, CodeTerms
from rocking.codes.kinds import CheckKind
from rocking.codes.static_check import elastic_period, kinematic_check
from rocking.errors import ConfigurationError, RecordError, StructureError
from rocking.products.checks.rows import code_check_rows
from tests.made_structures import HELD
from tests.refusals import refused

G = 9.80665
BY_HAND = 1e-9
LEVEL, F0, TC = 2.0, 2.5, 0.35
SPECTRUM = DesignSpectrum.ntc(LEVEL, F0, TC)


def displacement_demand(period, ag, damping):
    """S_De on soil A, S_T = 1: plateau to T_C = T_C*, then 1/T, beyond T_D constant."""
    eta = max(math.sqrt(10 / (5 + 100 * damping)), 0.55)
    t_d = 4 * ag / G + 1.6
    ordinate = ag * eta * F0 * min(1.0, TC / period) * min(1.0, t_d / period)
    assert period > TC / 3
    return ordinate * (period / (2 * math.pi)) ** 2


@dataclass
class ByHand:
    """α(φ) and the displacement of the control point, with Σ P, Σ P δ and Σ P δ² at rest, and δ of that point."""

    alpha: object
    moved: object
    total: float
    first: float
    second: float
    control: float

    @property
    def mass_ratio(self):
        return self.first**2 / (self.total * self.second)

    def linear(self, factor=1.35, q=2.0):
        return q * self.alpha(0.0) * G / (self.mass_ratio * factor)

    def nonlinear(self, limit, share=0.4, period_factor=1.68, damping=0.08, factor=1.35, largest=math.inf):
        """limit: rotation at which a vanishes; largest: displacement d at which a tie breaks."""
        scale = self.second / (self.control * self.first)
        d = min(share * self.moved(limit) * scale, largest)
        rotation = brentq(lambda phi: self.moved(phi) * scale - d, 0, limit, xtol=1e-17, rtol=1e-15)
        a = self.alpha(rotation) * G / (self.mass_ratio * factor)
        period = period_factor * math.pi * math.sqrt(d / a)
        level = brentq(
            lambda ag: displacement_demand(period, ag, damping) - d, 1e-6, 500, xtol=1e-16, rtol=1e-14
        )
        return max(level, self.linear(factor, 1.0))


def parapet(height=1.6, thickness=0.3):
    """One weight at its middle; the control point is the inner upper corner, (−t, h) from the toe."""
    alpha = math.atan(thickness / height)
    return alpha, ByHand(
        alpha=lambda phi: math.tan(alpha - phi),
        moved=lambda phi: height * math.sin(phi) + thickness * (1 - math.cos(phi)),
        total=1.0,
        first=height / 2,
        second=(height / 2) ** 2,
        control=height,
    )


def test_a_parapet_by_hand():
    slenderness, by_hand = parapet()
    check = kinematic_check(Block.of_size(0.3, 1.6), SPECTRUM)
    assert check.linear.capacity == pytest.approx(by_hand.linear(), rel=BY_HAND)
    assert check.nonlinear.capacity == pytest.approx(by_hand.nonlinear(slenderness), rel=BY_HAND)
    assert check.linear.demand == LEVEL
    assert check.linear.ratio == pytest.approx(by_hand.linear() / LEVEL, rel=BY_HAND)
    collapse = kinematic_check(
        Block.of_size(0.3, 1.6), SPECTRUM, CodeTerms(limit_state="SLC", confidence_factor=1.0)
    )
    expected = by_hand.nonlinear(slenderness, 0.6, 1.56, 0.10, 1.0)
    assert collapse.nonlinear.capacity == pytest.approx(expected, rel=BY_HAND)
    assert collapse.linear is None


def test_a_parapet_that_is_free_to_vibrate_by_hand():
    """Its onset is felt at T_0, and the elastic branch bounds its capacity: with a soft modulus that decides."""
    slenderness, by_hand = parapet()
    for modulus in (1e9, 1e7):
        period = 6.2 * (1.6 / 0.3) * 1.6 * math.sqrt(18e3 / (modulus * G))
        assert elastic_period(1.6, 0.3, 18e3, modulus) == pytest.approx(period, rel=BY_HAND)
        spanning = elastic_period(1.6, 0.3, 18e3, modulus, cantilever=False)
        assert spanning == pytest.approx(period * 2.2 / 6.2, rel=BY_HAND)
        check = kinematic_check(Block.of_size(0.3, 1.6), SPECTRUM, CodeTerms(elastic_period=period))
        onset = by_hand.alpha(0.0) * G / 1.35
        amplified = (
            F0 * (min(1.0, period / (TC / 3)) + max(0.0, 1 - period / (TC / 3)) / F0) * min(1, TC / period)
        )
        assert check.damage_level == pytest.approx(onset / amplified, rel=BY_HAND)
        d = 0.4 * by_hand.moved(slenderness) * 0.5
        rotation = brentq(lambda phi, d=d: by_hand.moved(phi) * 0.5 - d, 0, slenderness, xtol=1e-17)
        a = min(by_hand.alpha(rotation) * G / 1.35, 4 * math.pi**2 * d / period**2)
        secant = 1.68 * math.pi * math.sqrt(d / a)
        level = brentq(lambda ag: displacement_demand(secant, ag, 0.08) - d, 1e-6, 500, xtol=1e-16)  # noqa: B023
        assert check.nonlinear.capacity == pytest.approx(max(level, onset / amplified), rel=BY_HAND)


def test_a_wall_between_floors_with_an_eccentric_load_by_hand():
    """Two halves of a wall of 3.4 m hinged at 2 m, .3 m thick, with 9 kN/m at .08 m inwards from its middle on top.

    The lower block turns by φ about its outer toe, at x = .15 m; the upper one by ψ back about the hinge at the inner
    face, so that its top stays above the base. The load moves up only.
    """
    lower, upper, thickness, load, inwards = 2.0, 1.4, 0.3, 9e3, 0.08
    weights = 19e3 * thickness * np.array([lower, upper])

    def places(phi):
        """The middles of both blocks and the bearing, complex, with the inner face where the hinge opens."""
        toe = thickness / 2
        hinge = toe + (complex(-thickness, lower)) * np.exp(-1j * phi)
        along = complex(0.0, upper)  # of the upper block, from its lower inner to its upper inner corner

        def top(psi):
            return (hinge + (along + thickness) * np.exp(1j * psi)).real - toe

        psi = brentq(top, 0.0, 1.0, xtol=1e-16)
        turned = np.exp(1j * psi)
        first = toe + complex(-thickness / 2, lower / 2) * np.exp(-1j * phi)
        second = hinge + complex(thickness / 2, upper / 2) * turned
        bearing = hinge + complex(thickness / 2 - inwards, upper) * turned
        return np.array([first, second, bearing]), hinge, hinge + (along + thickness) * turned

    def velocity(phi):
        """The lower block turns by 1 about its toe; the top corner, whose support slides, moves up and down only."""
        (first, second, bearing), hinge, top = places(phi)
        at_hinge = -1j * (hinge - thickness / 2)
        back = at_hinge.real / (top - hinge).imag
        return np.array(
            [
                -1j * (first - thickness / 2),
                at_hinge + 1j * back * (second - hinge),
                at_hinge + 1j * back * (bearing - hinge),
            ]
        )

    def at_rest():
        """Exact: the lower block turns by 1, the upper one back by its height over that of the upper."""
        back = lower / upper
        first = -1j * complex(-thickness / 2, lower / 2)
        hinge = -1j * complex(-thickness, lower)
        second = hinge + 1j * back * complex(thickness / 2, upper / 2)
        bearing = hinge + 1j * back * complex(thickness / 2 - inwards, upper)
        return np.array([first, second, bearing])

    def alpha(phi):
        moving = at_rest() if phi == 0 else velocity(phi)
        up = weights @ moving[:2].imag + load * moving[2].imag
        return up / (weights @ moving[:2].real)

    at_once = at_rest()
    by_hand = ByHand(
        alpha=alpha,
        moved=lambda phi: places(phi)[1].real + thickness / 2,
        total=weights.sum(),
        first=weights @ at_once[:2].real,
        second=weights @ at_once[:2].real ** 2,
        control=lower,
    )
    wall = LoadedWall(lower, upper, thickness, 19e3, top_load=load, eccentricity=inwards, crack="known")
    check = kinematic_check(wall, SPECTRUM)
    outwards = check.mechanisms[0]
    assert outwards.onset_multiplier == pytest.approx(alpha(0.0), rel=BY_HAND)
    assert outwards.participating_mass_ratio == pytest.approx(by_hand.mass_ratio, rel=BY_HAND)
    limit = brentq(alpha, 0.05, 0.25, xtol=1e-15)
    scale = by_hand.second / (by_hand.control * by_hand.first)
    corner = places(limit)[1].real + thickness / 2
    assert outwards.ultimate_displacement == pytest.approx(corner * scale, rel=BY_HAND)
    alone = LoadedWall(
        lower, upper, thickness, 19e3, top_load=load, eccentricity=inwards, crack="known",
        one_sided=True, restitution=0.5,
    )  # fmt: skip
    checked = kinematic_check(alone, SPECTRUM)
    assert checked.linear.capacity == pytest.approx(by_hand.linear(), rel=BY_HAND)
    assert checked.nonlinear.capacity == pytest.approx(by_hand.nonlinear(limit), rel=BY_HAND)


def facade(thrust=1.5e3, strength=6e3, stiffness=4e5):
    return Facade(
        (3.5, 3.0), (0.6, 0.5), 20e3, floor_loads=(12e3, 6e3), eccentricity=0.05, thrust=thrust, thrust_height=6.2,
        tie_heights=(6.0,), tie_stiffness=stiffness, tie_strength=strength, crack_storey=1, crack="known",
        behind="cross_walls", restitution=0.6,
    )  # fmt: skip


def facade_by_hand(thrust=1.5e3, strength=6e3, stiffness=4e5):
    """Storeys of 42 and 30 kN/m, floors of 12 and 6 kN/m .05 m inwards of their walls' middles, about the outer toe."""
    weights = np.array([42e3, 30e3, 12e3, 6e3])
    points = np.array([-0.3 + 1.75j, -0.25 + 5j, -0.35 + 3.5j, -0.3 + 6.5j])
    breaks = math.asin(strength / stiffness / 6.0)  # the tie at x = 0 moves by 6 m sin φ

    def restoring(phi, tied=True):
        lift = (-1j * points * np.exp(-1j * phi)).imag
        tie = stiffness * 6.0 * math.sin(phi) * 6.0 * math.cos(phi) if tied and phi <= breaks else 0.0
        return weights @ lift - thrust * 6.2 * math.cos(phi) + tie

    def across(phi):
        return weights @ (-1j * points * np.exp(-1j * phi)).real

    by_hand = ByHand(
        alpha=lambda phi: restoring(phi) / across(phi),
        moved=lambda phi: 6.5 * math.sin(phi) + 0.5 * (1 - math.cos(phi)),
        total=weights.sum(),
        first=weights @ points.imag,
        second=weights @ points.imag**2,
        control=6.5,
    )
    untied = brentq(lambda phi: restoring(phi, tied=False), 0.0, 0.3, xtol=1e-17, rtol=1e-15)
    return by_hand, untied, breaks


def test_a_two_storey_facade_with_thrust_and_a_tie_that_breaks_by_hand():
    by_hand, untied, breaks = facade_by_hand()
    check = kinematic_check(facade(), SPECTRUM)
    # L_i: 6 kN/m at 6 m, over Σ P δ
    onset = by_hand.alpha(0.0) + 6e3 * 6.0 / by_hand.first
    linear = 2 * onset * G / (by_hand.mass_ratio * 1.35)
    assert check.linear.capacity == pytest.approx(linear, rel=BY_HAND)
    scale = by_hand.second / (by_hand.control * by_hand.first)
    at_break = by_hand.moved(breaks) * scale
    assert at_break < 0.4 * by_hand.moved(untied) * scale, "the tie breaks before .4 d₀"
    assert by_hand.alpha(breaks * (1 + 1e-9)) < 0.5 * by_hand.alpha(breaks)
    # what is left after the break bears more, and the start, half the linear one, more than either here or not
    broken, alone = by_hand.nonlinear(untied, largest=at_break * (1 - 1e-12)), by_hand.nonlinear(untied)
    assert broken < alone
    assert str(check.limit.reason) == "0.4 d₀"
    assert check.nonlinear.capacity == pytest.approx(max(alone, linear / 2), rel=BY_HAND)


def test_a_tie_that_hardly_matters_as_it_breaks_leaves_the_limit_where_it_is():
    by_hand, untied, _ = facade_by_hand(strength=300.0, stiffness=2e4)
    check = kinematic_check(facade(strength=300.0, stiffness=2e4), SPECTRUM)
    assert str(check.limit.reason) == "0.4 d₀"
    assert check.nonlinear.capacity == pytest.approx(by_hand.nonlinear(untied), rel=BY_HAND)


def test_an_arch_by_hand():
    """Seven voussoirs, 157.5°, t/r = .15 (Oppenheim 1992): hinges at 0, 67.5, 112.5 and 157.5° from the left.

    Three bars of a four-bar linkage, their centroids those of annular sectors; a hinge circle is cut with another.
    """
    radius, ratio, embrace = 5.0, 0.15, math.radians(157.5)
    thickness = ratio * radius
    hinge_angles = np.radians([0.0, 67.5, 112.5, 157.5])
    left = math.pi / 2 + embrace / 2

    def on_ring(angle, at):
        return at * np.exp(1j * (left - angle))

    inside, outside = radius - thickness / 2, radius + thickness / 2
    a, b, c, d = (
        on_ring(t, at) for t, at in zip(hinge_angles, (inside, outside, inside, outside), strict=True)
    )
    spans = np.diff(hinge_angles)
    weights = spans  # of sectors of one thickness
    reach = (outside**3 - inside**3) / (outside**2 - inside**2) * 2 / 3
    middles = np.array([
        on_ring((one + other) / 2, reach * math.sin((other - one) / 2) / ((other - one) / 2))
        for one, other in pairwise(hinge_angles)
    ])  # fmt: skip

    def posed(phi):
        """Middles of the bars as AB turns clockwise by φ about A."""
        b_now = a + (b - a) * np.exp(-1j * phi)
        apart = d - b_now
        along = (abs(c - b) ** 2 - abs(c - d) ** 2 + abs(apart) ** 2) / (2 * abs(apart))
        beside = math.sqrt(abs(c - b) ** 2 - along**2)
        side = 1 if ((c - b) / (d - b)).imag > 0 else -1
        c_now = b_now + apart / abs(apart) * complex(along, side * beside)
        turned = [np.exp(-1j * phi), (c_now - b_now) / (c - b), (c_now - d) / (c - d)]
        fixed, now = (a, b, d), (a, b_now, d)
        return np.array(
            [n + (m - f) * t for m, f, n, t in zip(middles, fixed, now, turned, strict=True)]
        ), c_now

    def moving(phi):
        """AB turns by 1 about A; the spins of BC and CD are such that C moves with both."""
        now, c_now = posed(phi)
        b_now = a + (b - a) * np.exp(-1j * phi)
        at_b = -1j * (b_now - a)
        along_bc, along_cd = 1j * (c_now - b_now), 1j * (c_now - d)
        table = np.array([[along_cd.real, -along_bc.real], [along_cd.imag, -along_bc.imag]])
        spin_cd, spin_bc = np.linalg.solve(table, [at_b.real, at_b.imag])
        return np.array(
            [-1j * (now[0] - a), at_b + 1j * spin_bc * (now[1] - b_now), 1j * spin_cd * (now[2] - d)]
        )

    def at_rest():
        """By instantaneous centres: AB about A, BC about the point where AB and DC meet, CD about D."""
        ab, dc = b - a, c - d
        along = ((d - a) * dc.conjugate()).imag / (ab * dc.conjugate()).imag
        centre = a + along * ab
        spin = -1.0
        spin_bc = spin * ((b - a) / (b - centre)).real
        spin_cd = spin_bc * ((c - centre) / (c - d)).real
        centres, spins = np.array([a, centre, d]), np.array([spin, spin_bc, spin_cd])
        return 1j * spins * (middles - centres)

    once = at_rest()
    alpha_0 = weights @ once.imag / (weights @ once.real)
    assert alpha_0 == pytest.approx(0.370009738022, rel=1e-11)  # published
    first, second = weights @ once.real, weights @ once.real**2
    arch = Arch(radius, thickness, embrace, voussoirs=7)
    check = kinematic_check(arch, SPECTRUM)
    mass_ratio = first**2 / (weights.sum() * second)
    assert check.mechanisms[0].participating_mass_ratio == pytest.approx(mass_ratio, rel=BY_HAND)
    assert check.linear.capacity == pytest.approx(2 * alpha_0 * G / (mass_ratio * 1.35), rel=BY_HAND)
    limit = brentq(lambda phi: weights @ moving(phi).imag, 0.03, 0.1, xtol=1e-15)
    assert limit == pytest.approx(0.069064693539, rel=1e-11)  # published

    # the control point is the corner of the drawing that moves furthest: that it is on BC, where it is at rest
    static = check.mechanisms[0].static
    corner = complex(*static.place)
    b_now = a + (b - a) * np.exp(-1j * limit)
    turn = (posed(limit)[1] - b_now) / (c - b)
    part = static.control_part
    turns = [np.exp(-1j * limit), turn, (posed(limit)[1] - d) / (c - d)]
    moved = ([a, b_now, d][part] + (corner - [a, b, d][part]) * turns[part] - corner).real
    assert float(static.displacement(static.side.critical_rotation)) == pytest.approx(moved, rel=BY_HAND)
    assert check.nonlinear.capacity >= check.damage_level


def test_at_a_height_by_hand():
    """One mode of .4 s and 5 %, γψ = 1.2 · .8, and T_SLV above 1.1 T_1; ξ_k is a ratio in p and in per cent in a_Z."""
    slenderness, by_hand = parapet(2.4, 0.3)
    support = Support((Mode(period=0.4, damping_ratio=0.05, participation=-0.96),))
    check = kinematic_check(Block.of_size(0.3, 2.4), SPECTRUM, CodeTerms(support=support))
    per_level = F0 * (0.35 / 0.4) * 0.96 * math.sqrt(1 + 0.0004 * 25)
    onset = by_hand.alpha(0.0) * G / 1.35
    assert check.damage_level == pytest.approx(onset / per_level, rel=BY_HAND)
    d = 0.4 * by_hand.moved(slenderness) * 0.5
    rotation = brentq(lambda phi: by_hand.moved(phi) * 0.5 - d, 0, slenderness, xtol=1e-17)
    secant = 1.68 * math.pi * math.sqrt(d / (by_hand.alpha(rotation) * G / 1.35))
    assert secant > 1.1 * 0.4
    eta = math.sqrt(10 / 13)
    p = 1.1 * 0.05**-0.5 * eta

    def demand(ag):
        floor = ag * per_level * p / (1 + (p - 1) * (secant / 0.44 - 1) ** 1.2)
        ground = displacement_demand(secant, ag, 0.08) / (secant / (2 * math.pi)) ** 2
        at_resonance = ag * per_level * p * (0.44 / (2 * math.pi)) ** 2
        return max(max(floor, ground) * (secant / (2 * math.pi)) ** 2, at_resonance)

    level = brentq(lambda ag: demand(ag) - d, 1e-6, 500, xtol=1e-16)
    assert check.nonlinear.capacity == pytest.approx(max(level, check.damage_level), rel=BY_HAND)


def test_a_support_that_is_lost_early_limits_the_displacement():
    whole = kinematic_check(Block.of_size(0.5, 3.0), SPECTRUM, CodeTerms(limit_state="SLC"))
    early = kinematic_check(Block.of_size(0.5, 3.0), SPECTRUM, CodeTerms(limit_state="SLC", support_loss=0.1))
    assert "carries falls" in str(early.limit.reason)
    assert early.limit.displacement == pytest.approx(0.05, rel=BY_HAND)  # d* is half of the top's
    assert early.nonlinear.capacity < whole.nonlinear.capacity


@pytest.mark.parametrize("height", [2.8, 3.2, 3.6, 4.0])
@pytest.mark.parametrize("thickness", [0.2, 0.25, 0.3])
def test_a_hinge_that_is_typed_makes_no_check_better_unless_it_is_known(height, thickness):
    """At mid-height 9 of these 12 walls are verified with that hinge alone, which no survey may have found."""
    spectrum = DesignSpectrum.ntc(0.2 * G, 2.4, 0.35)
    plain = kinematic_check(Wall.of_size(height, thickness), spectrum)
    typed = kinematic_check(Wall.of_size(height, thickness, height / 2), spectrum)
    known = kinematic_check(Wall.of_size(height, thickness, height / 2, crack="known"), spectrum)
    for check in plain.checks:
        (of_typed,) = (one for one in typed.checks if one.clause == check.clause)
        (of_known,) = (one for one in known.checks if one.clause == check.clause)
        assert of_typed.ratio == pytest.approx(check.ratio, rel=BY_HAND)
        assert of_typed.ratio < of_known.ratio
        assert known.with_any_crack(of_known).ratio == of_typed.ratio
    assert typed.verified is plain.verified
    assert typed.were_it_unknown is None
    assert [mechanism.description for mechanism in known.mechanisms] == [f"hinge at {height / 2:g} m"]

    rows = {row.clause: row for row in code_check_rows("wall", known)}
    assert rows["C8.7.1.2.1.8"].ratio_with_any_crack == plain.nonlinear.ratio
    assert rows["C8.7.1.2.1.8"].weakest_of_any_crack == plain.nonlinear.mechanism
    if (height, thickness) == (3.2, 0.25):
        assert (round(plain.nonlinear.ratio, 3), round(known.nonlinear.ratio, 2)) == (0.888, 1.35)
        assert known.verified and not typed.verified


def test_a_hinge_that_is_typed_counts_where_it_is_the_weaker_one():
    """Beside that of statics: it starts later, but low in a wall whose load bears far outwards it may bear less."""
    held = {"top_load": 40e3, "top_slab": "hinged", "restitution": 0.8}
    plain = kinematic_check(LoadedWall.of_size(3.2, 0.25, 18e3, **held), SPECTRUM)
    for height in (0.8, 1.6, 2.4, 2.9):
        typed = kinematic_check(LoadedWall.of_size(3.2, 0.25, 18e3, height, **held), SPECTRUM)
        alone = kinematic_check(LoadedWall.of_size(3.2, 0.25, 18e3, height, crack="known", **held), SPECTRUM)
        least = min(plain.nonlinear.capacity, alone.nonlinear.capacity)
        assert typed.nonlinear.capacity <= least * (1 + BY_HAND)


def test_every_crack_that_may_open_is_checked():
    """A solid spire has the same λ at each crack, but the smaller the part above, the less displacement it bears."""
    unknown, known = (
        kinematic_check(Spire(2.0, 12.0, crack_height=0.0, crack=crack, restitution=0.8), SPECTRUM)
        for crack in (None, "known")
    )
    assert len(unknown.mechanisms) > 5
    assert unknown.linear.capacity == pytest.approx(known.linear.capacity, rel=BY_HAND)
    assert unknown.nonlinear.capacity < known.nonlinear.capacity
    assert unknown.governing.description == "crack at 11.4 m"


def test_what_cannot_be_checked_is_refused_in_a_sentence():
    block = Block.of_size(0.3, 1.6)
    with refused(StructureError, "structure"):
        kinematic_check(block.mechanism(), SPECTRUM)
    with refused(RecordError, "damping_ratio of the support", 0.0):
        kinematic_check(
            block,
            SPECTRUM,
            CodeTerms(support=Support((Mode(period=0.3, damping_ratio=0.0, participation=1.0),))),
        )
    with refused(ConfigurationError, "spectrum", 2.0):
        rocking.check(block, 2.0)
    with refused(ConfigurationError, "records", {}):
        rocking.check(block, SPECTRUM, records={})


def test_a_check_prints_its_numbers_the_verdict_and_the_ratio_of_each_clause():
    check = Check(clause="C8.7", limit_state="SLV", capacity=3.0, demand=2.0, mechanism="crack at 0 m")
    said = "C8.7, SLV: capacity 3 m/s², demand 2 m/s², ratio 1.5, met (crack at 0 m)"
    assert str(check) == said
    assert str(replace(check, demand=math.inf)).endswith("demand beyond d_0, ratio 0, not met (crack at 0 m)")
    spectrum = rocking.DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)
    for breadth, word in ((0.6, "met"), (0.15, "not met")):
        found = rocking.check(rocking.Block.of_size(breadth=breadth, height=2.0), spectrum)
        for check in found.checks:
            assert f"{check.clause} {word}, ratio {check.capacity / check.demand:#.3g}" in repr(found)


def test_the_linear_check_is_never_below_the_onset_and_the_nonlinear_neither():
    for structure in (Block.of_size(0.3, 1.0), Block.of_size(0.6, 9.0), facade(), Arch(5.0, 0.75, 2.6)):
        for soil in "ACD":
            check = kinematic_check(structure, DesignSpectrum.ntc(3.0, 2.4, 0.4, soil))
            assert check.linear.capacity >= check.damage_level
            assert check.nonlinear.capacity >= check.damage_level


def test_what_no_mechanism_overturns_is_checked_by_forces_alone(monkeypatch):
    first, *_ = static_check._opening(HELD)
    monkeypatch.setattr(static_check, "_opening", lambda structure: [first])
    found = kinematic_check(HELD, SPECTRUM)
    assert found.linear is not None and found.nonlinear is None
    assert found.warning.kind is CheckKind.NO_DISPLACEMENT and str(found.warning) in repr(found)
