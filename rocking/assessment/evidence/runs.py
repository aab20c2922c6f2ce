"""Evidence of contact dynamics: stones, stacks, what nobody followed so; and contacts that slide, of which it tells."""

import math

from rocking.assessment.contacts import ContactShare
from rocking.assessment.cracks import cracked
from rocking.assessment.decide import UNANIMOUS, Limit, Verdict
from rocking.assessment.evidence.asked import Asked, Evidence
from rocking.assessment.evidence.bodies import friction_needed
from rocking.assessment.evidence.walls import held_all_along
from rocking.assessment.kinds import AssessmentKind
from rocking.warnings import RockingWarning


class AsStones:
    """An arch or a portal that does not stand as a mechanism, or that only its stones may say to stand: no better than
    its runs as stones; with `fidelity: contact` always, unless it rests or overturns as a mechanism.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        fidelity = asked.settings.fidelity
        if fidelity == "quick" or not asked.structure.joints.as_stones or not asked.moves(verdict):
            return False
        return fidelity == "contact" or asked.structure.joints.need_stones or verdict is not Verdict.STANDS

    def look(self, asked: Asked) -> ContactShare:
        return asked.contacts()


class StonesMissing:
    """An arch on piers that was not followed as stones, as which it may fall where its mechanism stands: at best
    *probably stands*.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        return asked.structure.joints.need_stones and asked.moves(verdict) and not asked.is_settled

    def look(self, asked: Asked) -> Limit:
        return Limit(warning=RockingWarning(AssessmentKind.STONES_TELL), lifted_by=1)


class Friction:
    """A contact that needs more friction than it has while it rocks: at best *probably stands*, until 64 stacks on that
    friction say otherwise, or stones.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        exempt = asked.structure.joints.friction >= asked.structure.joints.stand_on_friction
        return verdict in (Verdict.STANDS, Verdict.PROBABLY_STANDS) and not exempt and not asked.is_settled

    def look(self, asked: Asked) -> Limit | None:
        lifting = next(candidate for candidate in asked.counting if candidate not in asked.sliding)
        ensembles = asked.case.ensembles
        governing = [ensembles.governing.description] if ensembles else []
        bodies = [cracked(asked.structure, name) for name in dict.fromkeys([lifting.description, *governing])]
        needed = friction_needed(bodies, asked.motions, asked.settings)
        if math.isnan(needed):
            return None
        return Limit(
            warning=RockingWarning(AssessmentKind.FRICTION_SHORT),
            settles=(RockingWarning(AssessmentKind.FRICTION),),
            # Stones stand or slide on what they have.
            lifted_by=1 if asked.structure.joints.as_stones else UNANIMOUS,
            value=needed,
        )


class Anchored:
    """An anchor that slides out: no better than 24 stacks whose ties pull no more than their anchors give; with
    `fidelity: contact` 64, and with `quick` none.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        slides_out = any(limit.warning.kind is AssessmentKind.ANCHOR_GIVES for limit in asked.limits)
        return slides_out and asked.settings.fidelity != "quick" and not asked.is_settled

    def look(self, asked: Asked) -> ContactShare | None:
        plane = held_all_along(asked.structure)
        share = asked.contacts(plane)
        # Of how it falls between its ties a plane stack that stands says nothing, and lifts no other limit.
        lifts_others = plane is not asked.structure and len(asked.limits) > 1 and not share.falls
        return None if lifts_others else share


class Stacks:
    """What contact dynamics would settle where nothing else can tell, or contacts lack friction: no better than 24 runs
    of it; with `fidelity: contact` 64 runs, and also of what *probably stands* for a limit above.
    """

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        fidelity = asked.settings.fidelity
        would_settle = [limit for limit in asked.limits if limit.by_contacts]
        if fidelity == "quick" or asked.is_settled or asked.contact or not asked.facts.stackable:
            return False
        open_ = (Verdict.CANNOT_BE_TOLD, Verdict.PROBABLY_STANDS)[: 2 if fidelity == "contact" else 1]
        return any(verdict in open_ or limit.value > 0 for limit in would_settle)

    def look(self, asked: Asked) -> ContactShare:
        return asked.contacts()


EVIDENCE: tuple[Evidence, ...] = (AsStones(), StonesMissing(), Friction(), Anchored(), Stacks())
"""In the order of looking."""
