"""The checks of a local mechanism that the Italian code asks for: Circolare 7/2019, C8.7.1.2.1, to the NTC 2018.

Linear and nonlinear kinematics here; the dynamic check, C8.7.1.2.1.9, is that of `dynamic_check`. What crosses over
from the structure is its capacity by virtual work (`StaticCapacity`): α(d_C), e* and d of C8.7.1.1, 4 and 5. Masses Q
that push without resting on the chain are not implemented, nor are other codes.
"""

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from rocking.codes.check import Check, CodeTerms, StructureCheck
from rocking.codes.code_capacity import LIMIT_STATES, CodeCapacity, LimitState
from rocking.codes.crossings import Crossings
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.floor_demand import FloorDemand
from rocking.codes.kinds import CheckKind
from rocking.errors import ConfigurationError, DoesNotStandError, StructureError
from rocking.quantities import GRAVITY, kind_of, positive
from rocking.structures import Structure
from rocking.structures.crackable import Crackable
from rocking.structures.joints import USUAL
from rocking.structures.leaves import parts_of
from rocking.structures.structure import AS_DESCRIBED, Candidate, Mechanisms
from rocking.structures.tied import held
from rocking.warnings import Phrase, RockingWarning

_SAME = 1e-9
"""Relative difference below which two levels are one but for rounding: the mechanism that is named first decides."""


def elastic_period(
    length: float,
    thickness: float,
    unit_weight: float,
    elastic_modulus: float,
    *,
    cantilever: bool = True,
) -> float:
    """Return T_0 = κ λ L √(W/(E g)), s (C8.7.1.7), of a part that is free to vibrate, λ = L/t.

    length, thickness: m. unit_weight: W, N/m³. elastic_modulus: E, Pa. cantilever: κ = 6.2, else between two supports,
    2.2. Raises ConfigurationError for what is not above zero.

    >>> from rocking.codes.static_check import elastic_period
    >>> round(elastic_period(2.0, 0.3, 18e3, 1e9), 4)
    0.112
    """
    given = {
        "length": length,
        "thickness": thickness,
        "unit_weight": unit_weight,
        "elastic_modulus": elastic_modulus,
    }
    for name, value in given.items():
        positive(ConfigurationError, name, value)
    factor = 6.2 if cantilever else 2.2
    slenderness = length / thickness
    return factor * slenderness * length * math.sqrt(unit_weight / (elastic_modulus * GRAVITY))


def kinematic_check(
    structure: Structure, spectrum: DesignSpectrum, terms: CodeTerms | None = None
) -> StructureCheck:
    """Return the linear and the nonlinear check of `structure`; see `check`."""
    terms = terms or CodeTerms()
    made = _kinematic_check(structure, spectrum, terms)
    if not isinstance(structure, Crackable) or not structure.crack_is_known:
        return made
    with suppress(DoesNotStandError):
        return replace(
            made, were_it_unknown=_kinematic_check(replace(structure, crack=None), spectrum, terms)
        )
    return made


def _kinematic_check(structure: Structure, spectrum: DesignSpectrum, terms: CodeTerms) -> StructureCheck:
    """The checks with the crack that is known, or with all that may form."""
    if isinstance(structure, Structure):
        structure = structure.on_joints(USUAL)
    mechanisms = _capacities(structure, terms)
    floor = FloorDemand(spectrum, terms.support)
    starts = _starts(mechanisms, floor)
    first = _lowest(starts.capacities)  # all feel the same motion as they start
    wall = held(structure)
    restraints = wall.restraints if wall else ()
    made = StructureCheck(
        limit_state=terms.limit_state,
        damage_level=float(starts.levels(np.array([first]))[0]),
        mechanisms=mechanisms,
        governing=mechanisms[first],
        restraints=restraints,
        warning=next((restraint.warning for restraint in restraints if restraint.ties == math.inf), None),
    )
    if terms.limit_state == "SLD":
        clause = "C8.7.1.9" if made.governing.elastic_period else "C8.7.1.8"
        return replace(made, linear=_level_check(made, spectrum, clause, made.damage_level))
    if terms.limit_state == "SLV":
        # Of the mechanism that starts first: a_g,SLV = q a_g,SLD.
        level = terms.behaviour_factor * made.damage_level
        made = replace(made, linear=_level_check(made, spectrum, "C8.7.1.2.1.7", level))
    mechanisms = _on_the_better_branch(mechanisms, floor, LIMIT_STATES[terms.limit_state])
    made = replace(made, mechanisms=mechanisms)
    collapses = _collapses(mechanisms, floor, LIMIT_STATES[terms.limit_state])
    weakest, level = _weakest(starts, collapses)
    if math.isinf(level):
        why = mechanisms[first].candidate.mechanism.never_overturns_because
        return replace(made, warning=RockingWarning.of(CheckKind.NO_DISPLACEMENT, why=why))
    made = replace(made, governing=mechanisms[weakest])
    return replace(made, nonlinear=_level_check(made, spectrum, "C8.7.1.2.1.8", level))


def _level_check(made: StructureCheck, spectrum: DesignSpectrum, clause: str, capacity: float) -> Check:
    """The check that holds the a_g `capacity` [m/s²] against that of the spectrum."""
    return Check(
        clause=clause,
        limit_state=made.limit_state,
        capacity=capacity,
        demand=spectrum.level,
        mechanism=made.governing.description,
    )


def _capacities(structure: Structure, terms: CodeTerms) -> tuple[CodeCapacity, ...]:
    """The mechanisms of the structure that may open, with the values of the check in them."""
    parts = dict(parts_of(structure)) if isinstance(structure, Structure) else {}
    return tuple(
        CodeCapacity(
            candidate,
            static=candidate.structure.static_capacity(candidate.sign),
            confidence_factor=float(terms.confidence_factor),
            elastic_period=terms.elastic_period,
            support_loss=terms.support_loss,
            one_sided=parts[candidate.part].one_sided,
        )
        for candidate in _opening(structure)
    )


def _opening(structure: Structure) -> Iterator[Candidate]:
    """The mechanisms that may open, each to one side, which stands in its description.

    Those of `Structure.mechanisms` whose motion can be followed; of hinges between supports that which limit analysis
    finds and one that is typed, of other cracks all, and where the crack is known no other. What ties keep shut to one
    side opens to the other alone. Behind them those of each leaf that may part, which is named first.
    """
    if not isinstance(structure, Structure):
        raise StructureError(
            f"the structure is {kind_of(structure)}, which has no capacity curve; give a structure with a "
            "geometry, as rocking.Block or rocking.Facade.",
            structure=structure,
        )
    cracked = structure.candidates().of_all.counting.cracks
    if isinstance(structure, Crackable) and structure.statics_chooses:
        typed = structure.crack_in_words
        cracked = Mechanisms([*cracked[:1], *(one for one in cracked[1:] if one.description == typed)])
    bulges = structure.mechanisms().of_all.bulges.followed
    opens_elsewhere = bulges and not (isinstance(structure, Crackable) and structure.crack_is_known)
    for candidate in cracked:
        body = candidate.structure
        wall = held(body)
        shut = opens_elsewhere and wall is not None and not wall.lets_go
        for sign, side in _sides(body):
            if shut and sign > 0:
                continue
            opens = candidate.description
            if not body.symmetric:
                opens = side if opens == AS_DESCRIBED else Phrase("{opens}, {side}", opens=opens, side=side)
            yield replace(candidate, description=opens, sign=sign)
    for candidate in bulges:
        opens = candidate.name
        if candidate.opening is not None and candidate.opening.hinge is not None:
            hinge = Phrase("hinge at {height:.4g} m", height=candidate.opening.hinge)
            opens = Phrase("{does}, {opens}", does=opens, opens=hinge)
        yield replace(candidate, description=opens)
    for leaf in structure.leaves_alone:
        yield from leaf.named(_opening(leaf.structure))


def _sides(body: Structure) -> Iterator[tuple[int, str]]:
    """The sides to which a body falls, by sign and in words."""
    signs = (1,) if body.symmetric or body.one_sided else (1, -1)
    names = ("outwards", "inwards") if held(body) else ("to the right", "to the left")
    yield from zip(signs, names, strict=False)


def _lowest(levels: np.ndarray, then: np.ndarray | None = None) -> int:
    """The place of the least of `levels` (n,); of those that are the same but for rounding that of the least `then`.

    The first one where they are the same in both, or nothing more is given.
    """
    least = levels <= levels.min() * (1 + _SAME)
    if then is None:
        return int(np.argmax(least))
    return _lowest(np.where(least, then, np.inf))


def _starts(mechanisms: Sequence[CodeCapacity], floor: FloorDemand) -> Crossings:
    """The levels at which each mechanism starts: C8.7.1.8, or C8.7.1.9 of a part that is free to vibrate."""
    period = mechanisms[0].elastic_period

    def felt(_: np.ndarray, levels: np.ndarray) -> np.ndarray:
        if not period:
            return floor.peak(levels)
        return floor.acceleration(period, levels, floor.spectrum.damping)

    onsets = np.array([capacity.onset_acceleration for capacity in mechanisms])
    return Crossings.of(felt, onsets, floor.spectrum.level)


def _collapses(mechanisms: Sequence[CodeCapacity], floor: FloorDemand, state: LimitState) -> Crossings:
    """The levels at which the displacement demand at the secant period of each mechanism is that of the limit state."""
    points = [capacity.limit(state) for capacity in mechanisms]
    periods = np.array([point.period for point in points])
    shortest = mechanisms[0].elastic_period

    def asked(places: np.ndarray, levels: np.ndarray) -> np.ndarray:
        return floor.displacement(shortest, periods[places, None], levels, state.damping)

    displacements = np.array([point.displacement for point in points])
    return Crossings.of(asked, displacements, floor.spectrum.level)


def _on_the_better_branch(
    mechanisms: Sequence[CodeCapacity], floor: FloorDemand, state: LimitState
) -> tuple[CodeCapacity, ...]:
    """The mechanisms, each with its limit state where a tie breaks or behind that, whichever bears the larger a_g.

    What is left after the break is a chain of its own (C8.7.1.2.1.6), so that a tie takes nothing from it.
    """
    better = []
    for capacity in mechanisms:
        ruptures = len(capacity.limiting_ruptures) if state.ends_with_ties else 0
        branches = [replace(capacity, released=passed) for passed in range(ruptures + 1)]
        best = 0
        if ruptures:
            levels = _collapses(branches, floor, state).levels(np.arange(ruptures + 1))
            best = int(np.argmax(levels))
        better.append(branches[best])
    return tuple(better)


def _weakest(starts: Crossings, collapses: Crossings) -> tuple[int, float]:
    """The place of the mechanism that reaches the limit state at the least a_g, and that a_g, m/s²; inf: none does.

    a_g,SLV is never below a_g,SLD. Of mechanisms that reach it as they start, all at once, it is the one that bears
    least beyond.
    """
    low = np.maximum(starts.low, collapses.low)
    high = np.maximum(starts.high, collapses.high)
    places = np.flatnonzero(low <= high.min())
    of_collapse = collapses.levels(places)
    levels = np.maximum(starts.levels(places), of_collapse)
    place = _lowest(levels, of_collapse)
    return int(places[place]), float(levels[place])
