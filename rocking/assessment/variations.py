"""What the answer depends on besides the structure as given: where it cracks, and how the record was processed."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rocking.assessment.ensemble.ground_motions import AS_IT_IS
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.batch import integrate_batch
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
    """Return `count` candidates of a structure over what it may crack at (its `moved`); [] where nothing is.

    Raises RockingError where one of them cannot be followed.
    """
    moved = _moved(structure, count)
    integrated = _rotation_ratios(list(moved.values()), accelerogram, settings)
    for other, ratio in zip(moved.values(), integrated, strict=True):
        if math.isnan(ratio):
            integrate(other, accelerogram, settings.tolerance)  # raises the reason
    return [
        Candidate(position, _predicted(other, pulse, settings), ratio)
        for (position, other), ratio in zip(moved.items(), integrated, strict=True)
    ]


def governing(values: list[float]) -> int:
    """Return the index of the largest of `values`, the first of several that overturn; −1 where none is above 0."""
    known = np.nan_to_num(np.array(values, dtype=float), nan=0.0, posinf=np.inf)
    return int(np.argmax(known)) if known.size and known.max() > 0 else -1


def processed_variants(
    structures: Mapping[str, Structure],
    records: Mapping[str, Accelerogram],
    settings: AssessmentSettings,
    as_it_is: Mapping[str, Response] | None = None,
    vertical: Accelerogram | None = None,
) -> dict[str, list[Variant]]:
    """Return the responses of each of `structures` to each of `records`, which `processed` gives, by structure.

    as_it_is: of a structure to the record itself, where it is known. vertical: acts with each. A response that cannot
    be followed is left out.
    """
    found: dict[str, list[Variant]] = {name: [] for name in structures}
    for processing, record in records.items():
        known = as_it_is or {} if processing == AS_IT_IS else {}
        ratios = {name: response.rotation_ratio for name, response in known.items()}
        rest = [name for name in structures if name not in ratios]
        with suppress(RockingError):
            computed = _rotation_ratios([structures[name] for name in rest], record, settings, vertical)
            ratios |= zip(rest, computed, strict=True)
        for name in structures:
            if not math.isnan(ratio := ratios.get(name, math.nan)):
                variant = Variant(processing, record.peak_acceleration, ratio, Outcome.at(ratio))
                found[name].append(variant)
    return found


def _rotation_ratios(
    structures: Sequence[Structure],
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> list[float]:
    """The largest rotation ratio of each, nan where it cannot be followed; one thread, as a job has one core."""
    tolerance = settings.tolerance
    return integrate_batch(structures, record, vertical=vertical, tolerance=tolerance, workers=1)[
        :, 0
    ].tolist()


@lru_cache(maxsize=64)
def _moved(structure: Structure, count: int) -> dict[float, Structure]:
    """All candidates take the restitution of the structure: their own momentum balance may be unphysical."""
    if not structure.crack_name:
        return {}
    fixed = replace(structure, restitution=structure.mechanism().restitution)  # type: ignore[type-var,call-arg]
    found = sorted(fixed.candidates(count), key=lambda each: each.position)
    return {each.position: each.structure for each in found if np.isfinite(each.position)}


def _predicted(structure: Structure, pulse: Pulse | None, settings: AssessmentSettings) -> float:
    if pulse is None:
        return np.nan
    block = structure.mechanism().equivalent_block(settings.acceleration_scale)
    return predict_maximum(block, pulse).rotation_ratio
