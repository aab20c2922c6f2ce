"""What is asked of a case: the inputs that every kind of evidence may look at, and what was found so far."""

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

from rocking.assessment.case import CaseResult
from rocking.assessment.contacts import MOST_RUNS, RUNS, ContactShare, contact_share
from rocking.assessment.cracks import cracks, sliding_first
from rocking.assessment.decide import Facts, Limit, Verdict
from rocking.assessment.methods import Method
from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.motion.response import Response
from rocking.structures import Outcome, Structure
from rocking.structures.structure import Mechanisms


@dataclass(eq=False)
class Asked:
    """A case whose members were followed, and what evidence has found of it so far.

    bounces: whether a contact opens in a run as recorded; None where that is not known.
    """

    case: CaseResult
    structure: Structure
    motions: GroundMotions
    settings: AssessmentSettings
    bounces: bool | None = None
    facts: Facts = field(default_factory=Facts)
    limits: list[Limit] = field(default_factory=list)
    contact: ContactShare | None = None

    @classmethod
    def of_run(
        cls, structure: Structure, motions: GroundMotions, settings: AssessmentSettings, rotation_ratio: float
    ) -> "Asked":
        """Return a case of which no more is known than how far it turns."""
        outcome = Outcome.OVERTURNS if rotation_ratio == math.inf else Outcome.ROCKS
        response = Response(rotation_ratio=rotation_ratio, outcome=outcome)
        case = CaseResult(component="", responses={Method.MECHANISM_ON_RECORD: response})
        return cls(case, structure, motions, settings)

    @cached_property
    def counting(self) -> Mechanisms:
        """The mechanisms that count."""
        return cracks(self.structure).counting

    @cached_property
    def sliding(self) -> Mechanisms:
        """Those that slide before they lift."""
        return sliding_first(cracks(self.structure), self.motions)

    @cached_property
    def slides_throughout(self) -> bool:
        """Whether every mechanism that counts does."""
        return all(candidate in self.sliding for candidate in self.counting)

    @property
    def is_settled(self) -> bool:
        """Whether nothing cheaper than contact dynamics is asked: it slides throughout, or its stones were followed."""
        return self.slides_throughout or bool(self.contact and self.contact.runs)

    def may_be_untold(self, verdict: Verdict) -> bool:
        """Whether something may show that nothing can be told of it, and nothing did so far."""
        falls = verdict.badness >= Verdict.PROBABLY_OVERTURNS.badness
        return not (falls or self.slides_throughout or self.limits)

    def moves(self, verdict: Verdict) -> bool:
        """Whether it lifts, and its mechanisms leave open what becomes of it."""
        return not self.facts.rests and verdict not in (Verdict.OVERTURNS, Verdict.CANNOT_OVERTURN)

    def contacts(self, structure: Structure | None = None) -> ContactShare:
        """Return how many runs of contact dynamics fall, of another `structure` in its place where one is given."""
        runs = MOST_RUNS if self.settings.fidelity == "contact" else RUNS
        return contact_share(structure or self.structure, self.motions, self.settings, runs)


class Evidence(Protocol):
    """One kind of evidence. Its docstring is its row in docs/pages/limits.md: what it is, a colon, what it says."""

    def due(self, verdict: Verdict, asked: Asked) -> bool:
        """Whether it is looked for, given the verdict so far: it may change that, and is worth what it costs."""

    def look(self, asked: Asked) -> Limit | ContactShare | None:
        """Return what was found; None where nothing speaks against the verdict."""
