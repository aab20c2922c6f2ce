"""Variations of a case: one run with another crack, or with another processing of the record."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass

from rocking.assessment.ground_motions import AS_IT_IS
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import integrate, strict
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Structure


@dataclass(frozen=True)
class Variation:
    """A case with another crack or another processing of the record: its rotation ratios under record and pulse.

    predicted_rotation_ratio: nan without a pulse. crack, position: what opens, in words, and its height, m.
    """

    integrated_rotation_ratio: float
    predicted_rotation_ratio: float = math.nan
    crack: str = ""
    position: float = math.nan
    processing: str = ""


def candidates(
    structure: Structure,
    accelerogram: Accelerogram,
    pulse: Pulse | None,
    count: int,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> list[Variation]:
    """Return `count` candidates of a structure, the lowest crack first; [] where there is one mechanism.

    vertical: acts with the accelerogram. Raises RockingError where one of them cannot be followed.
    """
    others = sorted(structure.candidates(count) if count else (), key=lambda each: each.position)
    if len(others) < 2:
        return []
    integrated = _rotation_ratios([each.structure for each in others], accelerogram, settings, vertical)
    variations = []
    for each, ratio in zip(others, integrated, strict=True):
        if math.isnan(ratio):
            # Raises the reason.
            integrate(each.structure, accelerogram, strict(settings.tolerance), vertical=vertical)
        mechanism = each.structure.mechanism()
        predicted = math.nan
        if pulse and mechanism.can_overturn:
            block = mechanism.equivalent_block(settings.acceleration_scale)
            predicted = predict_maximum(block, pulse).rotation_ratio
        variations.append(Variation(ratio, predicted, each.description, each.position))
    return variations


def processed_variants(
    structure: Structure,
    records: Mapping[str, Accelerogram],
    settings: AssessmentSettings,
    as_it_is: float = math.nan,
    vertical: Accelerogram | None = None,
) -> list[Variation]:
    """Return a structure under each of `records`; one under which it cannot be followed is left out.

    records: as `processed` gives them. as_it_is: the ratio under the record itself, which needs no integration; nan
    where it is not known. vertical: acts with each.
    """
    variations = []
    for processing, record in records.items():
        ratio = as_it_is if processing == AS_IT_IS else math.nan
        if math.isnan(ratio):
            with suppress(RockingError):
                (ratio,) = _rotation_ratios([structure], record, settings, vertical)
        if not math.isnan(ratio):
            variations.append(Variation(ratio, processing=processing))
    return variations


def _rotation_ratios(
    structures: Sequence[Structure],
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> list[float]:
    """The largest rotation ratio of each, nan where it cannot be followed; one thread, as a job has one core."""
    tolerance = strict(settings.tolerance)
    ratios = integrate_batch(structures, record, tolerance=tolerance, vertical=vertical, workers=1)
    return [float(ratio) for ratio in ratios[:, 0]]
