"""A capacity curve of another program as a structure, against its equation of motion integrated from kink to kink."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rocking import (
    Accelerogram,
    CapacityCurve,
    Facade,
    Pulse,
    Wall,
    integrate,
    structure_from_config,
)
from rocking.assessment.scene import load_scenes
from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.study.settings import structure_hashes
from tests.refusals import refused

KINKED = (0.0, 0.03, 0.06, 0.2, 0.5), (0.15, 0.19, 0.1, 0.08, -0.02)
RESTITUTION = 0.85


def _curve(one_sided: bool = False) -> CapacityCurve:
    return CapacityCurve(*KINKED, weight=40e3, restitution=RESTITUTION, one_sided=one_sided)


def _largest_displacement(curve: CapacityCurve, pulse: Pulse, end: float) -> float:
    """The largest |d*| [m] up to `end` [s], by solve_ivp that stops at every kink and every impact."""
    displacements = np.array(KINKED[0])
    bearing = GRAVITY * np.array(KINKED[1])
    slopes = np.diff(bearing) / np.diff(displacements)
    onset = bearing[0]
    # The pulse begins with ground acceleration to the negative side, that lifts it to the positive one.
    start = np.arcsin(onset / abs(pulse.amplitude)) / pulse.circular_frequency
    side = 1.0
    place, state, largest = 0, (0.0, 0.0), 0.0

    while start < end:

        def slope(time, y, side=side, place=place):
            borne = bearing[place] + slopes[place] * (y[0] - displacements[place])
            return y[1], -borne - side * float(pulse.acceleration(time))

        events = [lambda time, y, at=at: y[0] - at for at in displacements[[place, place + 1]]]
        for event, direction in zip(events, (-1, 1), strict=True):
            event.terminal = True
            event.direction = direction
        events.append(lambda time, y: y[1])
        run = solve_ivp(
            slope, (start, end), state, events=events, rtol=1e-11, atol=1e-14, max_step=0.01, method="DOP853"
        )
        largest = max([largest, *(float(turn[0]) for turn in run.y_events[2])])
        start = float(run.t[-1])
        displacement, speed = run.y[:, -1]
        if run.t_events[1].size:
            place += 1
        elif run.t_events[0].size and place:
            place -= 1
        elif run.t_events[0].size:
            if not curve.one_sided:
                side = -side
            displacement, speed = 0.0, -RESTITUTION * speed
            if speed < 1e-3:  # what follows stays far below the largest
                break
        state = (float(displacement), float(speed))
    return float(largest)


@pytest.mark.parametrize("one_sided", [False, True])
@pytest.mark.parametrize(
    ("amplitude", "circular_frequency"), [(2.2, 6.0), (2.2, 7.0), (2.0, 5.0), (2.0, 7.0)]
)
def test_a_curve_with_kinks_is_followed_as_its_equation_of_motion(amplitude, circular_frequency, one_sided):
    curve = _curve(one_sided)
    pulse = Pulse(amplitude=-amplitude, circular_frequency=circular_frequency)
    response = integrate(curve, pulse, 1e-10)
    oracle = _largest_displacement(curve, pulse, pulse.end_time + 3.0)
    assert response.rotation_ratio * 0.44 == pytest.approx(oracle, rel=1e-8)
    assert oracle < 0.44
    assert oracle > 0.06 or one_sided  # beyond two kinks at least


def test_kinks_in_line_change_nothing():
    straight = CapacityCurve((0.0, 0.1, 0.3, 0.4), (0.2, 0.15, 0.05, 0.0), weight=1e3, restitution=0.9)
    block = straight.mechanism().equivalent_block()
    rng = np.random.default_rng(1)
    motion = Accelerogram(np.convolve(rng.normal(0, 4.5, 3000), np.ones(40) / 40, "same"), 0.01)
    vertical = Accelerogram(np.convolve(rng.normal(0, 4, 3000), np.ones(10) / 10, "same"), 0.01)
    for own in (None, vertical):
        curve = integrate(straight, motion, 1e-10, vertical=own)
        exact = integrate(block, motion, 1e-10, vertical=own)
        assert curve.outcome == exact.outcome == "rocks"
        assert curve.rotation_ratio == pytest.approx(exact.rotation_ratio, rel=1e-8)


def test_any_curve_has_a_mechanism_that_overturns_where_it_comes_down_to_zero():
    """300 curves drawn at random, half of them in round numbers as a table has them, against their own segments."""
    rng = np.random.default_rng(65)
    for number in range(300):
        points = int(rng.integers(2, 9))
        displacements = [0.0, *np.cumsum(rng.uniform(1e-3, 0.4, points - 1))]
        multipliers = [*rng.uniform(0.01, 0.5, points - 1), rng.choice([0.0, -rng.uniform(0, 0.1)])]
        if number % 2:
            displacements = [
                round(displacement, 2) + 0.01 * place for place, displacement in enumerate(displacements)
            ]
            multipliers = [round(multiplier, 2) for multiplier in multipliers]
            multipliers[0] = max(multipliers[0], 0.01)
        curve = CapacityCurve(tuple(displacements), tuple(multipliers), weight=50e3, restitution=0.9)
        side = curve.mechanism().positive
        reach = curve.height * side.critical_rotation
        place = next(k for k, one_multiplier in enumerate(multipliers) if one_multiplier <= 0)
        start, end = displacements[place - 1 : place + 1]
        slope = (multipliers[place] - multipliers[place - 1]) / (end - start)
        assert start < reach <= end * (1 + 1e-15)
        assert multipliers[place - 1] + slope * (reach - start) == pytest.approx(0, abs=1e-12)
        # p² = −g G'/I of the segment that ends at zero
        assert side.frequency_parameter == pytest.approx(np.sqrt(-GRAVITY * slope), rel=1e-9)
        assert side.uplift_multiplier == multipliers[0]
        assert integrate(curve.mechanism(), Pulse(amplitude=1.0, circular_frequency=6.0)).rotation_ratio >= 0


def test_the_curve_that_ended_every_record_of_its_study_is_followed():
    """Its last point is missed by a rounding where the quotient is taken."""
    curve = CapacityCurve((0.0, 0.1, 0.3), (0.12, 0.08, 0.0), weight=50e3, restitution=0.9)
    assert curve.mechanism().positive.frequency_parameter == pytest.approx(np.sqrt(GRAVITY * 0.4))


def test_it_is_drawn_as_the_slender_body_that_leans_by_its_multiplier():
    """λ = .2 over d*_u = .3 m: a body .3 m broad and 1.5 m high, about its right corner."""
    curve = CapacityCurve((0.0, 0.1, 0.3), (0.2, 0.1, 0.0), 1e4, 0.9)
    corners = np.array([-0.3, 0.0, 1.5j, -0.3 + 1.5j])
    for rotation in (0.0, 0.05):
        (outline,) = curve.outline(rotation)
        turned = 0.15 + corners[[0, 1, 2, 3]] * np.exp(-1j * rotation)
        assert outline @ [1, 1j] == pytest.approx(turned)


def test_a_curve_that_bears_nothing_up_to_any_displacement_is_refused():
    with refused(StructureError, "multipliers", 5e-324):
        CapacityCurve((0.0, 0.1), (5e-324, -100.0), weight=1e3, restitution=0.9)


def test_a_curve_goes_on_from_where_its_multiplier_first_vanishes():
    curve = _curve()
    assert curve.mechanism().critical_rotation * curve.height == pytest.approx(0.2 + 0.3 * 0.08 / 0.1)
    assert curve.mechanism().uplift_multiplier == 0.15
    static = curve.capacity_curve()
    assert static.displacement[-1] == pytest.approx(0.44)
    assert static.multiplier.tolist() == [0.15, 0.19, 0.1, 0.08, 0.0]


@pytest.mark.parametrize(
    "structure", [Wall.of_size(3.0, 0.3, restitution=0.8), Facade((6.0,), (0.6,), 18e3, restitution=0.85)]
)
def test_the_curve_of_a_mechanism_is_followed_much_as_the_mechanism(structure):
    given = structure.capacity_curve(count=41)
    side = structure.mechanism().positive
    # d* = q Σ m δ²/Σ m δ, with the inertia of bodies that turn, which weights at their centroids leave out.
    per_rotation = side.at("inertia", 0.0) / side.at("ground", 0.0)
    curve = CapacityCurve(
        tuple((given.rotation * per_rotation).tolist()),
        tuple(given.multiplier.tolist()),
        weight=1e3,
        restitution=0.85 if isinstance(structure, Facade) else 0.8,
    )
    own = structure.mechanism()
    assert curve.mechanism().uplift_multiplier == pytest.approx(own.uplift_multiplier)
    for factor, frequency in ((1.2, 4.0), (1.5, 6.0), (1.8, 9.0)):
        circular_frequency = frequency * own.equivalent_block().frequency_parameter
        pulse = Pulse(
            amplitude=factor * GRAVITY * own.uplift_multiplier, circular_frequency=circular_frequency
        )
        ratio = integrate(structure, pulse).rotation_ratio
        # What it leaves out is how the inertia changes with the rotation.
        assert 0.01 < ratio < 1
        assert integrate(curve, pulse).rotation_ratio == pytest.approx(ratio, rel=0.05)


def _written(tmp_path, text: str):
    path = tmp_path / "curve.csv"
    path.write_text(text)
    return path


def test_every_unit_of_a_file_gives_the_same_curve(tmp_path):
    def read(text: str, **more: float) -> CapacityCurve:
        return CapacityCurve.read(_written(tmp_path, text), weight=50e3, restitution=0.8, **more)

    curve = read("displacement_m,multiplier\n0,0.2\n0.1,0.25\n0.4,0\n")
    assert curve == CapacityCurve((0.0, 0.1, 0.4), (0.2, 0.25, 0.0), 50e3, 0.8)
    assert read("force_kN;point;displacement_mm\n10;a;0\n12.5;b;100\n\n0;c;400\n") == curve
    in_g = read("displacement_cm,acceleration_g\n0,0.25\n10,0.3125\n40,0\n", mass_ratio=0.8)
    assert in_g.multipliers == curve.multipliers
    assert in_g.displacements == pytest.approx(curve.displacements)
    in_si = read("displacement_m,acceleration_m_s2\n0,1.96133\n0.1,2.4516625\n0.4,0\n")
    assert in_si.multipliers == pytest.approx(curve.multipliers)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("displacement_m,multiplier\n0,0.2\n0.1,0.1\n", "never reaches 0"),
        ("displacement_m,multiplier\n0,0.2\n0.2,0.1\n0.1,0\n", "0.1 m after 0.2 m, but they must ascend"),
        ("displacement_m,multiplier\n0.01,0.2\n0.1,0\n", "begins at a displacement of 0.01 m"),
        ("displacement_m,multiplier\n0,0\n0.1,0.2\n0.4,0\n", "begins with a multiplier of 0.0"),
        ("displacement_m,multiplier\n0,0.2\n0.1,none\n", "line 3, holds '0.1,none', but must hold a number"),
        ("displacement,multiplier\n0,0.2\n0.1,0\n", "must have one of displacement_cm, displacement_m"),
        ("displacement_m,force\n0,0.2\n0.1,0\n", "must have one of acceleration_g"),
        ("displacement_m,multiplier\n0,0.2\n", "two at least"),
        ("displacement_m,multiplier\n0,nan\n0.1,0\n", "multipliers is"),
        ("", "must have one of"),
    ],
)
def test_what_is_no_curve_is_refused_in_one_sentence(tmp_path, text, sentence):
    with pytest.raises(StructureError, match=r"^[^\n]*$") as error:
        CapacityCurve.read(_written(tmp_path, text), weight=50e3, restitution=0.8)
    assert sentence in str(error.value)


def test_millimetres_under_a_head_in_metres_get_a_warning(tmp_path):
    path = _written(tmp_path, "displacement_m,multiplier\n0,0.2\n400,0\n")
    (warning,) = CapacityCurve.read(path, weight=50e3, restitution=0.8).described.warnings
    assert warning.about == "displacements_m"
    path = _written(tmp_path, "displacement_mm,multiplier\n0,0.2\n400,0\n")
    assert not CapacityCurve.read(path, weight=50e3, restitution=0.8).described.warnings


def test_the_p_of_a_slender_block_follows_from_its_curve():
    """d* = 2 h φ/3 and α = b/h − φ of a homogeneous block, so that p² = 3 g/(2 h), as 3 g/(4 R) is for R = h/2."""
    curve = CapacityCurve((0.0, 2 / 3 * 0.6), (0.1, 0.0), weight=1e3, restitution=0.9)
    expected = np.sqrt(3 * GRAVITY / (2 * 6.0))
    assert curve.mechanism().positive.frequency_parameter == pytest.approx(expected, rel=1e-12)


def test_a_file_that_is_not_there_is_named(tmp_path):
    with refused(StructureError, "file", "none.csv"):
        CapacityCurve.read(tmp_path / "none.csv", weight=50e3, restitution=0.8)


def test_a_multiplier_takes_no_mass_ratio(tmp_path):
    path = _written(tmp_path, "displacement_m,multiplier\n0,0.2\n0.4,0\n")
    with refused(StructureError, "mass_ratio", 0.9):
        CapacityCurve.read(path, weight=50e3, restitution=0.8, mass_ratio=0.9)


def test_the_points_of_a_file_count_and_not_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    listed = tmp_path / "structures.yaml"
    listed.write_text(
        "- {name: front, type: capacity_curve, file: curve.csv, weight_kN: 50, restitution: 0.8}\n"
    )

    def hashes(text: str) -> dict[str, str]:
        _written(tmp_path, text)
        return structure_hashes(load_scenes(listed))

    first = hashes("displacement_m,multiplier\n0,0.2\n0.4,0\n")
    assert hashes("displacement_mm,multiplier\n0,0.2\n400,0\n") == first
    assert hashes("displacement_m,multiplier\n0,0.2\n0.5,0\n") != first

    (scene,) = load_scenes(listed).values()
    again = structure_from_config(scene.structure.described.entry)
    assert again == scene.structure
    assert "curve of 2 points from α 0.2 to 0 at 0.5 m" in scene.structure.description
