"""Evidence: what speaks against the verdict of the mechanisms, each kind a row, in the order of looking.

The verdict of the mechanisms comes first and is asked once. Each kind of evidence then says whether it is due, given
the verdict so far, looks, and sets a limit: no safer than this, with this warning, until so many runs of contact
dynamics say otherwise. A limit only ever makes a verdict worse, so that the last verdict is that of the mechanisms, of
every limit and of the runs together (`decide`).
"""

from dataclasses import replace

from rocking.assessment.case import CaseResult
from rocking.assessment.cracks import slides_at
from rocking.assessment.decide import Limit, decide, worse
from rocking.assessment.evidence import bodies, runs, walls
from rocking.assessment.evidence.asked import Asked

EVIDENCE = (*bodies.EVIDENCE, *walls.EVIDENCE, *runs.EVIDENCE)
"""Every kind, in the order of looking: what is cheap or ends the search comes first."""


def gathered(asked: Asked) -> CaseResult:
    """Return the case with what every kind of evidence that was due has found."""
    case = asked.case
    if asked.slides_throughout:
        case = replace(case, slides_at=slides_at(asked.counting[0]))
    asked.facts = case.facts(asked.structure)
    verdict = decide(asked.facts).verdict
    for evidence in EVIDENCE:
        found = evidence.look(asked) if evidence.due(verdict, asked) else None
        if isinstance(found, Limit):
            asked.limits.append(found)
            verdict = worse(verdict, found.at_best)
        elif found is not None:
            asked.contact = found
    return replace(case, limits=tuple(asked.limits), contact=asked.contact)


def cannot_be_told(asked: Asked) -> bool:
    """Whether nothing can be told of what lifts and does not fall, until contact dynamics follows it."""
    return any(evidence.look(asked) is not None for evidence in bodies.EVIDENCE)
