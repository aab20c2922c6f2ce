"""What the answer depends on besides the structure as given: where it cracks, and how the record was processed."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rocking.assessment.processings import AS_IT_IS
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.integration import integrate
from rocking.motion.response import Response
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Structure
from rocking.structures.outcome import Outcome


@dataclass(frozen=True)
class Candidate:
    """A structure cracked at `position` [m] instead: rotation ratio under the pulse (nan: none) and the record."""

    position: float
    predicted: float
    integrated: float


@dataclass(frozen=True)
class Variant:
    """A structure under the record processed otherwise."""

    processing: str
    peak_acceleration: float
    rotation_ratio: float
    outcome: Outcome


def candidates(
    structure: Structure,
    accelerogram: Accelerogram,
    pulse: Pulse | None,
    count: int,
    settings: AssessmentSettings,
) -> list[Candidate]:
    """Return `count` candidates of a structure over what it may crack at (its `moved`); [] where nothing is."""
    moved = _moved(structure, count)
    return [
        Candidate(
            position,
            _predicted(other, pulse, settings),
            integrate(other, accelerogram, settings.tolerance).rotation_ratio,
        )
        for position, other in moved.items()
    ]


def governing(values: list[float]) -> int:
    """Return the index of the largest of `values`, the first of several that overturn; −1 where none is above 0."""
    known = np.nan_to_num(np.array(values, dtype=float), nan=0.0, posinf=np.inf)
    return int(np.argmax(known)) if known.size and known.max() > 0 else -1


def processed_variants(
    structure: Structure,
    records: Mapping[str, Accelerogram],
    settings: AssessmentSettings,
    as_it_is: Response | None = None,
    vertical: Accelerogram | None = None,
) -> Iterator[Variant]:
    """Yield the response of `structure` to each of `records`, which `processed` gives.

    as_it_is: to the record itself, where it is known. vertical: acts with each.
    """
    for name, record in records.items():
        with suppress(RockingError):
            known = as_it_is if name == AS_IT_IS else None
            response = known or integrate(structure, record, settings.tolerance, vertical=vertical)
            yield Variant(name, record.peak_acceleration, response.rotation_ratio, response.outcome)


@lru_cache(maxsize=64)
def _moved(structure: Structure, count: int) -> dict[float, Structure]:
    """All candidates take the restitution of the structure: their own momentum balance may be unphysical."""
    if not structure.moved:
        return {}
    fixed = replace(structure, restitution=structure.mechanism().restitution)  # type: ignore[type-var,call-arg]
    return dict(fixed.candidates(fixed.candidate_positions(count)))


def _predicted(structure: Structure, pulse: Pulse | None, settings: AssessmentSettings) -> float:
    if pulse is None:
        return np.nan
    block = structure.mechanism().equivalent_block(settings.acceleration_scale)
    return predict_maximum(block, pulse).rotation_ratio
