"""The cheapest method that answers for one structure under one record."""

from dataclasses import dataclass

from rocking.assessment.method import Method
from rocking.motion.forcing import forcing_of
from rocking.motion.integration import integrate
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.structures.outcome import Outcome


@dataclass(frozen=True)
class Answer:
    """What answered, and its largest rotation over the critical one; response is None without an integration."""

    method: Method
    rotation_ratio: float
    outcome: Outcome
    response: Response | None

    @property
    def integrated(self) -> Method:
        """The integration that `response` stands for: of a structure at rest, that of the mechanism."""
        return self.method if self.method is Method.BLOCK_ON_RECORD else Method.MECHANISM_ON_RECORD


def stays_at_rest(
    mechanism: Mechanism, accelerogram: Accelerogram, vertical: Accelerogram | None = None
) -> bool:
    """Whether the ground never reaches the uplift acceleration, whatever its phase with the vertical component."""
    return forcing_of(accelerogram, vertical).excitation <= mechanism.uplift_multiplier


def cheapest_answer(
    mechanism: Mechanism,
    accelerogram: Accelerogram,
    integration_tolerance: float = 1e-6,
    vertical: Accelerogram | None = None,
) -> Answer:
    """Return that nothing lifts, where the ground cannot lift it, and else the answer of the mechanism."""
    if stays_at_rest(mechanism, accelerogram, vertical):
        return Answer(Method.NOTHING_TO_INTEGRATE, 0.0, Outcome.NO_UPLIFT, Response(0.0, Outcome.NO_UPLIFT))
    whole = integrate(mechanism, accelerogram, integration_tolerance, history=True, vertical=vertical)
    return Answer(Method.MECHANISM_ON_RECORD, whole.rotation_ratio, whole.outcome, whole)
