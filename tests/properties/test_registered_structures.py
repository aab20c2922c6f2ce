"""What every registered structure promises: a new type is held to it from the day it is registered."""

import dataclasses
import functools
import pickle
import re
import tempfile
from pathlib import Path

import jsonschema
import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from rocking.assessment.scene import load_scenes, scenes_schema
from rocking.errors import StructureError
from rocking.motion import integrate
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.structures import Arch, Facade, Spire
from rocking.structures.crackable import Crackable
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import MotionState, UnknownContacts
from rocking.structures.structure_list import TYPES, structure_from_config

SCHEMA = jsonschema.validators.validator_for(scenes_schema())(scenes_schema())
UNCHECKED = [HealthCheck.too_slow, HealthCheck.filter_too_much]
FEW = settings(
    max_examples=settings.default.max_examples // 24,
    deadline=None,
    derandomize=True,
    suppress_health_check=UNCHECKED,
)
OF_LEAVES = {"bonders_m", "thrown_back", "loaded_leaf"}
"""Keys that only say something beside the leaves of a wall."""
REGISTERED = [
    pytest.param(kind, form, id=f"{kind} {number}")
    for kind, of_kind in TYPES.items()
    for number, form in enumerate(of_kind, start=1)
    if kind != "capacity_curve"  # it has no geometry, and tests of its own
]


@st.composite
def varied(draw, kind, form):
    """A structure of a registered form: its examples' numbers changed by up to a fifth, its options there or not."""
    mapping = {"type": kind}
    for field in form.fields:
        if not field.required and draw(st.booleans()):
            continue
        if field.key in OF_LEAVES and "leaves_m" not in mapping:
            continue
        factor = draw(st.floats(0.8, 1.1) if "restitution" in field.key else st.floats(0.8, 1.25))
        value = field.value.example
        if isinstance(value, list):
            value = [factor * item for item in value]
        mapping[field.key] = factor * value if isinstance(value, float) else value
    try:
        structure = structure_from_config(mapping)
        structure.mechanism()
    except StructureError:
        assume(False)
    return structure


@functools.cache
def drawn(kind, number):
    """Random structures of a registered form: to build them takes longer than most tests of them."""
    structures = []
    FEW(given(varied(kind, TYPES[kind][number]))(lambda structure: structures.append(structure)))()
    return structures


def registered(test):
    """Run `test(structure)` for random structures of every registered form."""

    @pytest.mark.parametrize(("kind", "form"), REGISTERED)
    @pytest.mark.filterwarnings("ignore::rocking.errors.StructureWarning")
    def run(kind, form):
        for structure in drawn(kind, TYPES[kind].index(form)):
            test(structure)

    run.__doc__, run.__name__ = test.__doc__, test.__name__
    return run


def differentiated(function, at, step):
    """First derivative by central differences of eighth order."""
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    return sum(w * (function(at + k * step) - function(at - k * step)) for k, w in weights.items()) / step


def held_work(linkage, at):
    """Work against the constant forces and, on the way out, the ties of a linkage."""
    total = np.zeros(at.shape)
    for item in linkage.hung:
        moved = linkage.carried(item.part, item.start, linkage.motion(at)).moved
        total -= (item.force.conjugate() * moved).real
        if tie := item.tie:
            stretch = np.minimum(moved.real, tie.rupture_stretch)
            elastic = np.minimum(stretch, tie.yield_stretch)
            total += tie.pretension * elastic + tie.stiffness * elastic**2 / 2
            total += np.where(stretch > elastic, tie.strength, 0.0) * (stretch - elastic)
    return total


def smooth(side, at, reach):
    """Those of the rotations `at` within `reach` of which no tie yields or breaks."""
    return at[[all(abs(bend - place) > reach for bend in side.bends) for place in at]]


@registered
def test_the_standard_form_is_that_of_its_moving_masses(structure):
    """I, G and B by virtual work of the bodies' own positions, differentiated numerically, up to one factor of mass."""
    side = structure.mechanism().positive
    # near the end of its geometry a linkage locks, and differences say little
    last = min(side.critical_rotation, 0.8 * side.end_rotation)
    step = 3e-3 * last  # with three times as much, the flat block above a high hinge shows truncation of 2e-9
    at = smooth(side, last * np.linspace(0.05, 0.95, 9), 4 * step)
    if not at.size:
        return
    linkage = structure.linkages[0]
    masses, inertias = linkage.masses, linkage.inertias
    velocity = differentiated(lambda phi: linkage.motion(phi).centroids, at, step)
    spin = differentiated(lambda phi: linkage.motion(phi).angles, at, step)
    expected = {
        "inertia": masses @ np.abs(velocity) ** 2 + inertias @ spin**2,
        "gravity": masses @ velocity.imag + differentiated(lambda phi: held_work(linkage, phi), at, step),
        "ground": masses @ velocity.real,
    }
    factor = expected["inertia"] / side.inertia(at)
    # differences of eighth order: no truncation to speak of, and the rounding of the positions over the step
    rounding = 8e-16 * masses.sum() * np.abs(linkage.motion(at).centroids).max() / step
    np.testing.assert_allclose(factor, factor[0], rtol=1e-9 + rounding / np.sqrt(expected["inertia"].min()))
    for name in ("gravity", "ground"):
        values, bound = getattr(side, name)(at) * factor[0], 1e-9 * np.abs(expected[name]).max() + rounding
        np.testing.assert_allclose(values, expected[name], rtol=0, atol=bound)


@registered
def test_slopes_are_derivatives(structure):
    """J = I'/2 needs I' to be the derivative of I."""
    side = structure.mechanism().positive
    at = smooth(side, side.critical_rotation * np.linspace(0.05, 0.95, 9), 2e-2 * side.critical_rotation)
    if not at.size:
        return
    for name in ("inertia", "gravity"):
        slope = differentiated(getattr(side, name), at, 3e-3 * side.critical_rotation)
        size = np.abs(getattr(side, name)(np.append(0.0, at))).max()
        bound = 1e-9 * np.abs(slope).max() + 1e-14 * size / (3e-3 * side.critical_rotation)
        np.testing.assert_allclose(getattr(side, f"{name}_slope")(at), slope, rtol=0, atol=bound)


@pytest.mark.parametrize(("kind", "form"), REGISTERED)
@pytest.mark.filterwarnings("ignore::rocking.errors.StructureWarning")
def test_energy_of_free_rocking_is_kept_until_the_impact(kind, form):
    """Without forcing, I φ'²/2 + g ∫ G dφ of the integrated flight is the energy it was released with."""
    fields = {attribute.key: attribute.value.example for attribute in form.fields}
    structure = structure_from_config({"type": kind, **fields})
    side = structure.mechanism().positive
    start = 0.5 * side.critical_rotation
    still = Pulse(amplitude=1e-9, circular_frequency=20 * np.pi, start_time=0.0)
    found = integrate(structure, still, 1e-12, history=True, initial_rotation=start)
    flight = np.arange(np.argmax(found.rotation <= 0))
    phi, speed = found.rotation[flight], found.angular_velocity[flight]
    nodes, weights = np.polynomial.legendre.leggauss(40)
    potential = GRAVITY * phi / 2 * (side.gravity(phi[:, None] / 2 * (nodes + 1)) @ weights)
    energy = side.inertia(phi) * speed**2 / 2 + potential
    assert len(flight) > 5 and speed[-1] < 0
    # the pulse of 1e-9 m/s² does work of 1e-10 of that energy
    np.testing.assert_allclose(energy, energy[0], rtol=1e-9)


def distance(polygon, point):
    """That of `point` from the edges of a polygon."""
    start = polygon
    along = np.roll(polygon, -1, axis=0) - start
    share = np.clip(((point - start) * along).sum(axis=1) / (along**2).sum(axis=1), 0, 1)
    return np.linalg.norm(start + share[:, None] * along - point, axis=1).min()


@registered
def test_a_drawing_is_finite_closed_and_measured(structure):
    """Polygons with an area that move rigidly about points of their edges; dimensions say what was given."""
    sides = structure.mechanism().sides
    for sign in (1.0,) if structure.mechanism().one_sided else (1.0, -1.0):
        rotations = sign * 1e-300, sign * sides[0 if sign > 0 else -1].critical_rotation / 2
        for rotation in rotations:
            parts, hinges = structure.outline(rotation), structure.hinges(rotation)
            for part in parts:
                x, y = part.T
                assert part.shape[0] >= 3 and np.isfinite(part).all()
                assert abs((x * np.roll(y, -1) - np.roll(x, -1) * y).sum()) > 0
            corners = np.concatenate(parts)
            rounding = 1e-12 * np.abs(corners).max()
            # a corner, or a point of an edge where its edge crushes
            assert all(min(distance(part, hinge) for part in parts) < rounding for hinge in hinges)
        at_rest, turned = (structure.hinges(rotation)[0] for rotation in rotations)
        np.testing.assert_allclose(turned, at_rest, rtol=1e-12, atol=1e-12)
        for before, after in zip(*map(structure.outline, rotations), strict=True):
            for shift in (1, 2):
                edges = (np.abs((part - np.roll(part, shift, axis=0)) @ [1, 1j]) for part in (before, after))
                np.testing.assert_allclose(*edges, atol=1e-10 * np.ptp(before, axis=0).max())
    points = np.vstack([*structure.outline(), structure.described.front])
    size = np.ptp(points, axis=0).max()
    dimensions = structure.dimensions()
    assert len(dimensions) >= 2
    for dimension in dimensions:
        assert dimension.letter and any(character.isdigit() for character in dimension.text)
        assert (dimension.line > points.min(axis=0) - size).all()
        assert (dimension.line < points.max(axis=0) + size).all()
    lengths = [d for d in dimensions if d.text.endswith(" m") and len(d.line) == 2]
    for dimension in lengths:
        measured = np.linalg.norm(np.subtract(*dimension.feet))
        shift, along = np.subtract(dimension.line[0], dimension.feet[0]), np.subtract(*dimension.line)
        assert shift @ along == pytest.approx(0.0, abs=1e-9) and np.hypot(*along) == pytest.approx(measured)
        assert not shift.any() or 0.01 * size < np.hypot(*shift) < 0.2 * size
        assert measured == pytest.approx(float(dimension.text.removesuffix(" m")), rel=1e-5)


@registered
def test_a_structure_comes_back_from_its_description_a_file_and_another_process(structure):
    """And its description says every value with its unit, its repr what a person can read."""
    mapping = structure.described.entry
    form = structure.described.form
    assert len(form.keys) == len(form.fields)  # no key twice
    entry = {"name": "one", **mapping}
    SCHEMA.validate([entry])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "structures.yaml"
        path.write_text(yaml.safe_dump([entry], allow_unicode=True), encoding="utf-8")
        (scene,) = load_scenes(path).values()
    mechanism = structure.mechanism()
    for again in (structure_from_config(mapping), scene.structure, pickle.loads(pickle.dumps(structure))):
        assert again == structure and again.description == structure.description
        assert again.mechanism().uplift_multiplier == mechanism.uplift_multiplier
    assert pickle.loads(pickle.dumps(mechanism)).uplift_multiplier == mechanism.uplift_multiplier
    for field in structure.described.form.fields:
        value = mapping.get(field.key)
        if value is not None and not isinstance(value, bool):
            said = ", ".join(map(str, value)) if isinstance(value, list) else value
            assert f"{said}{field.suffix}" in structure.description
    assert structure.described.size and "=" not in structure.description
    for text in (repr(structure), repr(mechanism)):
        # what a description of some forty keys takes, and less than a printed array
        assert not re.search("lambda|array|function", text) and len(text) < 1200


@registered
def test_contacts_are_finite_or_refused_in_words(structure):
    """What refuses them has no limit by friction as it rocks, and says so among its cautions."""
    mechanism = structure.mechanism()
    rotation = mechanism.critical_rotation * np.array([0.2, 0.6])
    try:
        state = MotionState.of(structure.mechanism(), rotation, [0.1, -0.1], ground=[0.5, -0.5])
        found = structure.contact_forces(state)
    except UnknownContacts as why:
        assert len(str(why).split()) > 4
        told = {warning.kind for warning in structure.cautions}
        assert told & {StructureKind.FRAME_CONTACTS, StructureKind.CURVE_ALONE}
    else:
        assert np.isfinite(found.normal).all() and np.isfinite(found.tangential).all()


def _with_its_crack_typed(structure):
    """It, with the place of its description typed, as one that is known has to be."""
    if isinstance(structure, Arch):
        return dataclasses.replace(structure, hinge_angles=tuple(structure.onset.hinges))
    return (
        structure.cracked_at(structure.crack_position) if isinstance(structure, Facade | Spire) else structure
    )


@registered
def test_candidates_stand_and_the_weakest_comes_first(structure):
    """Of the same kind, each with its own crack, that of the description among them; a bulge is no crack."""
    fixed = dataclasses.replace(structure, restitution=0.9, restitution_range=0.03)
    known_limit = -np.inf
    if isinstance(structure, Crackable):
        fixed = dataclasses.replace(_with_its_crack_typed(fixed), crack="known")
        own = [candidate for candidate in fixed.candidates(5) if not candidate.part]
        cracked = [member for member in own if not getattr(member.structure, "opening", None)]
        assert cracked[0].structure.mechanism() is fixed.mechanism(), "what is known decides"
        assert not any(item.counts for item in cracked[1:]), "and no other counts"
        known_limit = cracked[0].uplift_multiplier
        fixed = dataclasses.replace(fixed, crack=None)
    candidates = fixed.candidates(5)
    weakest = {}
    for candidate in candidates:
        weakest.setdefault(candidate.part, candidate.uplift_multiplier)
    assert weakest.keys() == {"", *(name for name, _ in fixed.leaves_alone)}
    assert (np.diff(list(weakest.values())) >= 0).all(), "the weakest part comes first"
    found = [candidate for candidate in candidates if not candidate.part]
    turning = [row for row in found if getattr(row.structure, "opening", None) is None]
    multipliers = [one_side.structure.mechanism().uplift_multiplier for one_side in turning]
    # Of a held wall by limit analysis, in which ties pull with the force at which they yield.
    least = min(this_candidate.uplift_multiplier for this_candidate in fixed.candidates())
    # Of a smooth least, which two grids find apart by the square root of the rounding.
    assert fixed.static_multiplier == pytest.approx(least, rel=1.5e-8)
    openings = [one_item.uplift_multiplier for one_item in found if one_item not in turning]
    # Ties may keep every crack shut, or a top slip before it: then something weaker is left.
    if not turning:
        assert openings
        return
    by_limit = [side.uplift_multiplier for side in turning]
    assert (np.diff(by_limit) > -1e-8 * by_limit[-1]).all()
    assert multipliers[0] > 0
    given = fixed.mechanism().uplift_multiplier
    if not any(opening < known_limit for opening in openings):
        assert min(abs(multiplier - given) for multiplier in multipliers) < 1e-9 * given
    if not isinstance(structure, Crackable):
        assert len(turning) == 1
        return
    for other_side in turning:
        assert type(other_side.structure) is type(structure) and other_side.structure.crack == "known"
        assert (other_side.structure.restitution_range, other_side.structure.mechanism().restitution) == (
            0.03,
            0.9,
        )
        if np.isfinite(other_side.position):
            own = other_side.structure.crack_position
            assert own == pytest.approx(other_side.position, abs=1e-12)
