"""Variations of a case: one run with another crack, or with another processing of the record."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from types import MappingProxyType

from rocking.assessment.ground_motions import AS_IT_IS
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import RockingError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import integrate, strict
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Mechanism, Structure


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
    structures: Mapping[str, Structure],
    records: Mapping[str, Accelerogram],
    settings: AssessmentSettings,
    as_it_is: Mapping[str, float] = MappingProxyType({}),
    vertical: Accelerogram | None = None,
) -> dict[str, list[Variation]]:
    """Return each of `structures` under each of `records`, by structure; one that cannot be followed is left out.

    records: as `processed` gives them. as_it_is: the ratios under the record itself that need no integration, by
    structure. vertical: acts with each.
    """
    varied: dict[str, list[Variation]] = {name: [] for name in structures}
    for processing, record in records.items():
        ratios = dict.fromkeys(structures, math.nan)
        if processing == AS_IT_IS:
            ratios |= as_it_is
        rest = [name for name, ratio in ratios.items() if math.isnan(ratio)]
        with suppress(RockingError):
            computed = _rotation_ratios([structures[name] for name in rest], record, settings, vertical)
            ratios |= zip(rest, computed, strict=True)
        for name, ratio in ratios.items():
            if not math.isnan(ratio):
                varied[name].append(Variation(ratio, processing=processing))
    return varied


def _rotation_ratios(
    structures: Sequence[Structure | Mechanism],
    record: Accelerogram,
    settings: AssessmentSettings,
    vertical: Accelerogram | None = None,
) -> list[float]:
    """The largest rotation ratio of each, nan where it cannot be followed; one thread, as a job has one core."""
    tolerance = strict(settings.tolerance)
    ratios = integrate_batch(structures, record, tolerance=tolerance, vertical=vertical, workers=1)
    return [float(ratio) for ratio in ratios[:, 0]]
