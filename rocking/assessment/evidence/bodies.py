"""Evidence in which nothing can be told of any body: a mechanism not followed, courses thrown, contacts that open."""

import math
from collections.abc import Iterable
from contextlib import suppress
from itertools import product

import numpy as np

from rocking.assessment.contacts import directions, signs
from rocking.assessment.cracks import weakest_not_followed
from rocking.assessment.decide import Limit, Verdict
from rocking.assessment.evidence.asked import Asked, Evidence
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.integration import integrate, strict
from rocking.motion.response import check_model
from rocking.records import Accelerogram
from rocking.structures import Structure
from rocking.structures.leaves import parts_of
from rocking.structures.linkage import Turning
from rocking.warnings import RockingWarning


class NotFollowed:
    """A mechanism of least λ that cannot be followed, and that the motion reaches: it *cannot be told* until contact
    dynamics follows it.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return asked.may_be_untold(verdict)

    def look(self, asked: Asked) -> Limit | None:
        weakest = [weakest_not_followed(part) for _, part in parts_of(asked.structure)]
        reached = asked.motions.excitation * (1 + asked.settings.ensemble.amplitude_range)
        if not any(unknown and reached > unknown.uplift_multiplier for unknown in weakest):
            return None
        return Limit.untold(RockingWarning(AssessmentKind.NOT_FOLLOWED))


class Thrown:
    """Courses that grow smaller upwards above a body that lifts: impacts may throw them, and it *cannot be told* until
    contact dynamics follows it.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return asked.may_be_untold(verdict)

    def look(self, asked: Asked) -> Limit | None:
        tapering = (name for name, part in parts_of(asked.structure) if part.joints.courses_taper)
        lifts = any(asked.case.largest_of_part(name) > 0 for name in tapering)
        return Limit.untold(RockingWarning(AssessmentKind.COURSES_THROWN)) if lifts else None


LEAST_KEPT = 0.3
"""Restitution by the balance of momentum below which joints close one after the other (theory: section 11)."""


class ContactsOpen:
    """A contact that would have to pull, or an impact that keeps less than 0.3 of the velocity: bodies bounce, and it
    *cannot be told* until contact dynamics follows it.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return asked.may_be_untold(verdict)

    def look(self, asked: Asked) -> Limit | None:
        kinds = (
            why_open(
                part,
                asked.motions,
                asked.case.largest_of_part(name),
                asked.settings,
                None if name else asked.bounces,
            )
            for name, part in parts_of(asked.structure)
        )
        kind = next((kind for kind in kinds if kind is not None), None)
        return None if kind is None else Limit.untold(RockingWarning(kind))


def why_open(
    structure: Structure,
    motions: GroundMotions,
    rotation_ratio: float,
    settings: AssessmentSettings,
    bounces: bool | None = None,
) -> AssessmentKind | None:
    """Return why contacts of one part may open; None where nothing speaks for it.

    rotation_ratio: the largest of its runs. bounces: whether a contact opens in the run as recorded, where that is
    known. Of the members those are asked that land fastest: with the crack that statics chooses, in every direction and
    sign, at the largest amplitude; what cannot be followed there is in doubt, too. Where the balance of momentum keeps
    less than LEAST_KEPT of the velocity, the impact itself opens contacts. What rests has no contact to open; a single
    body on the ground lands too slowly below a fall of more than a radian; and the bulge of a wall that is held is left
    to `TurnsFar` and `TiesGive`: what they let stand did not fall as a stack (docs, validation).
    """
    if structure.joints.courses_taper or not rotation_ratio > NEGLIGIBLE:
        return None
    if bounces:
        return AssessmentKind.CONTACTS_OPEN
    forming = structure.candidates().of_all
    bulges = [bulge.structure for bulge in forming.bulges]
    first = [crack.structure for crack in forming.cracks[:1]]
    asked = [body for body in first if not all(isinstance(part, Turning) for part in body.linkages)]
    for body, sign, direction in product(asked, signs(structure, settings), directions(motions)):
        strongest = motions.horizontal[direction].scaled(sign * (1 + settings.ensemble.amplitude_range))
        if _opens(body, strongest, motions.vertical, strict(settings.tolerance)):
            return AssessmentKind.CONTACTS_OPEN
    return AssessmentKind.IMPACT_OPENS if any(map(_keeps_little, [*asked, *bulges])) else None


def _opens(
    structure: Structure, motion: Accelerogram, vertical: Accelerogram | None, tolerance: float
) -> bool:
    """Whether a contact would have to pull, or the motion cannot be followed, so that nobody knows."""
    try:
        response = integrate(structure, motion, tolerance, history=True, vertical=vertical)
    except RockingError:
        return True
    return check_model(structure, response, motion, vertical).bounces is True


def _keeps_little(structure: Structure) -> bool:
    """Whether its balance of momentum keeps less than LEAST_KEPT of the velocity at an impact."""
    if structure.restitution_is_typed:
        return False
    return any(side.restitution < LEAST_KEPT for side in structure.mechanism().sides)


def friction_needed(
    bodies: Iterable[Structure], motions: GroundMotions, settings: AssessmentSettings
) -> float:
    """Return the friction coefficient that a contact of the mechanisms needs where it has less; nan where none does.

    bodies: the structure with each crack that is asked. Followed as recorded in every direction and sign, at every
    sample at which they rock below the critical rotation; inf where nothing presses a contact there. What cannot be
    followed, or has contacts of which nothing is known, says nothing.
    """
    largest = math.nan
    for body, direction in product(bodies, directions(motions)):
        motion = motions.horizontal[direction]
        for sign in signs(body, settings):
            acting = motion.scaled(sign)
            with suppress(RockingError):
                response = integrate(
                    body, acting, settings.tolerance, history=True, vertical=motions.vertical
                )
                check = check_model(body, response, acting, motions.vertical)
                if check.slides(body.joints.friction):
                    largest = float(np.fmax(largest, check.required_friction))
    return largest


EVIDENCE: tuple[Evidence, ...] = (NotFollowed(), Thrown(), ContactsOpen())
"""In the order of looking."""
