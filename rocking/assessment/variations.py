"""What the answer depends on besides the structure as given: where it cracks, and how the record was processed."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np

from rocking.assessment.ensemble import Ensemble, GroundMotions, ensemble
from rocking.assessment.ensemble.ground_motions import AS_IT_IS
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.verdict import Verdict
from rocking.errors import RockingError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import integrate
from rocking.motion.response import Response
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Mechanism, Outcome, Structure
from rocking.structures.structure import Candidate


@dataclass(frozen=True)
class CrackResponse:
    """A crack that may form, in words and by its height [m]: rotation ratios under pulse (nan: none) and record."""

    description: str
    position: float
    predicted: float
    integrated: float


def ensemble_over_cracks(
    structure: Structure | Mechanism,
    motions: GroundMotions,
    settings: AssessmentSettings,
    *,
    nominal: float = math.nan,
    verdict_only: bool = False,
) -> Ensemble:
    """Return the ensemble of the mechanism that statics chooses, of least λ, with what other cracks may change.

    Where it stands, every other mechanism that may form is followed, the worst under the strongest motion first, until
    one does not stand: that one is `elsewhere`. One that stays far from overturning in the first members ends early.
    nominal, verdict_only: as `ensemble` takes them. Raises MotionError as `integrate` does.
    """
    follow = partial(ensemble, motions=motions, settings=settings.ensemble, tolerance=settings.tolerance)
    (description, mechanism), *others = cracks(structure)
    headline = follow(mechanism, nominal=nominal, verdict_only=verdict_only)
    if not others:
        return headline
    headline = replace(headline, crack=description)
    if headline.verdict is not Verdict.STANDS:
        return headline
    strongest = max(motions.horizontal.values(), key=lambda motion: motion.peak_acceleration)
    mechanisms = [each for _, each in others]
    ratios = integrate_batch(mechanisms, strongest, tolerance=settings.tolerance, workers=1)[:, 0]
    for place in np.argsort(-np.nan_to_num(ratios, nan=math.inf), kind="stable"):
        other = follow(mechanisms[place], verdict_only=True)
        if other.verdict is not Verdict.STANDS:
            return replace(headline, elsewhere=replace(other, crack=others[place][0]))
    return headline


@lru_cache(maxsize=256)
def cracks(structure: Structure | Mechanism) -> tuple[tuple[str, Mechanism], ...]:
    """Return the mechanisms that may form, each with what opens in words; the one that statics chooses first."""
    if isinstance(structure, Mechanism):
        return (("", structure),)
    return tuple((each.description, each.structure.mechanism()) for each in structure.candidates())


@dataclass(frozen=True)
class Variant:
    """A structure under the record processed otherwise."""

    processing: str
    rotation_ratio: float
    outcome: Outcome


def candidates(
    structure: Structure,
    accelerogram: Accelerogram,
    pulse: Pulse | None,
    count: int,
    settings: AssessmentSettings,
) -> list[CrackResponse]:
    """Return `count` candidates of a structure over what it may crack at (its `moved`); [] where nothing is.

    Raises RockingError where one of them cannot be followed.
    """
    others = _moved(structure, count)
    structures = [each.structure for each in others]
    integrated = _rotation_ratios(structures, accelerogram, settings)
    for other, ratio in zip(structures, integrated, strict=True):
        if math.isnan(ratio):
            integrate(other, accelerogram, settings.tolerance)  # raises the reason
    return [
        CrackResponse(each.description, each.position, _predicted(each.structure, pulse, settings), ratio)
        for each, ratio in zip(others, integrated, strict=True)
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
                variant = Variant(processing, ratio, Outcome.at(ratio))
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
def _moved(structure: Structure, count: int) -> tuple[Candidate, ...]:
    """The cracks that may form, the lowest first; none where there is one mechanism or `count` is 0."""
    others = structure.candidates(count) if count else ()
    return tuple(sorted(others, key=lambda each: each.position)) if len(others) > 1 else ()


def _predicted(structure: Structure, pulse: Pulse | None, settings: AssessmentSettings) -> float:
    if pulse is None:
        return np.nan
    block = structure.mechanism().equivalent_block(settings.acceleration_scale)
    return predict_maximum(block, pulse).rotation_ratio
