"""Evidence against walls that are held: they turn far, an anchor slides out, their ties give."""

import math
from dataclasses import replace

from rocking.assessment.contacts import directions
from rocking.assessment.decide import Limit, Verdict
from rocking.assessment.evidence.asked import Asked, Evidence
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.floors.place import swinging
from rocking.motion.integration import Members, integrate_members, strict
from rocking.quantities import GRAVITY
from rocking.structures import Structure
from rocking.structures.leaves import parts_of
from rocking.structures.tied import held
from rocking.warnings import RockingWarning

BEYOND = 0.4
"""Share of the critical rotation beyond which a chain of a held wall may fall though its mechanism stands (theory:
section on ties)."""


class TurnsFar:
    """A held wall some member of which goes beyond 0.4 of its critical rotation, so that its mechanism may predict too
    little: at best *probably stands*, until 64 stacks say otherwise.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return asked.moves(verdict) and not asked.slides_throughout and asked.case.ensembles is not None

    def look(self, asked: Asked) -> Limit | None:
        walls = ((name, held(part)) for name, part in parts_of(asked.structure))
        parts = {name for name, wall in walls if wall and wall.held_wall.holds}
        assert asked.case.ensembles is not None
        far = any(
            crack.counts and crack.facts.farthest > BEYOND and crack.part in parts
            for crack in asked.case.ensembles.followed
        )
        return Limit(warning=RockingWarning(AssessmentKind.HELD_BEYOND)) if far else None


class Anchors:
    """The anchor of a tie that slides out with the course that it grips, also before anything lifts: at best *probably
    stands*, until 64 stacks whose ties pull no more than their anchors give say otherwise.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return verdict.badness < Verdict.CANNOT_BE_TOLD.badness and not asked.is_settled

    def look(self, asked: Asked) -> Limit | None:
        if not anchors_slide(asked.structure, asked.motions):
            return None
        settles = (RockingWarning(AssessmentKind.ANCHORS),)
        return Limit(warning=RockingWarning(AssessmentKind.ANCHOR_GIVES), settles=settles, at_rest=True)


def anchors_slide(structure: Structure, motions: GroundMotions) -> bool:
    """Whether an anchor of one part slides out."""
    walls = (held(part) for _, part in parts_of(structure))
    level = min((wall.anchors_slide_at for wall in walls if wall), default=math.inf)
    return math.isfinite(level) and motions.excitation > level


class TiesGive:
    """Ties that stretch so far that, under the motion that they let through, the wall between them turns beyond 0.4 of
    its critical rotation, also where the ground lifts nothing: at best *probably stands*, until 64 stacks say
    otherwise.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return verdict is Verdict.STANDS and not asked.is_settled

    def look(self, asked: Asked) -> Limit | None:
        gives = any(ties_give(part, asked.motions, asked.settings) for _, part in parts_of(asked.structure))
        return Limit(warning=RockingWarning(AssessmentKind.TIES_GIVE), at_rest=True) if gives else None


def held_all_along(structure: Structure) -> Structure:
    """Return a structure where what anchors grip holds it between its ties, too, as a plane stack takes it to."""
    wall = held(structure)
    if wall is None or not wall.ties_apart:
        return structure
    return replace(wall, held_between="floor", anchor_width=wall.anchor_width or wall.unit_length)


def tie_swing(structure: Structure) -> tuple[float, Structure] | None:
    """Return the period [s] with which a wall swings on its ties, and the weakest bulge that they hold; else None."""
    tied = held(structure)
    if tied is None or not tied.tie_stiffness:
        return None
    wall = tied.held_wall
    ties = {hold.height for hold in wall.holds if hold.kind == "tie"}
    hanging = (
        candidate.structure
        for candidate in tied.mechanisms()
        if (way := candidate.opening) and way.hinge is not None and way.outwards
        if not candidate.refusal and (way.foot in ties or way.hold in ties)
    )
    bulge = next(hanging, None)
    if bulge is None:
        return None
    stiffness = tied.tie_stiffness * sum(height**2 for height in tied.tie_heights)
    inertia = sum(storey.weight * (storey.high**3 - storey.low**3) / 3 for storey in wall.storeys)
    inertia += sum(load.weight * load.z**2 for load in wall.loads if load.rides)
    return 2 * math.pi * math.sqrt(inertia / (GRAVITY * stiffness)), bulge


def ties_give(structure: Structure, motions: GroundMotions, settings: AssessmentSettings) -> bool:
    """Whether one part turns beyond BEYOND under the motion that its ties let through.

    Its mechanisms stand on ties and lean on them as if these did not stretch. Until it cracks, such a wall swings on
    them as one body, and its bulge is shaken by the absolute acceleration of that oscillator: the bulge of least λ that
    a tie holds or bears is followed under it, with both signs of every direction. What cannot be followed counts.
    """
    swing = tie_swing(structure)
    if swing is None:
        return False
    own_period, bulge = swing
    both = Members(1 + settings.ensemble.amplitude_range, polarity=[1.0, -1.0])
    for motion in (motions.horizontal[direction] for direction in directions(motions)):
        # Below two samples of the record it cannot be distinguished from one that moves with the ground.
        period = own_period if own_period >= 2 * motion.time_step else 0.0
        through_ties = swinging(period).motion(motion)
        try:
            followed = integrate_members(bulge, through_ties, both, strict(settings.tolerance))
        except RockingError:
            return True
        if not (followed.rotation_ratio <= BEYOND).all():
            return True
    return False


EVIDENCE: tuple[Evidence, ...] = (TurnsFar(), TiesGive(), Anchors())
"""In the order of looking."""
