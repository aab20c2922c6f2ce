"""What changes the answer for a structure: where it cracks, and how the record was processed."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from rocking.assessment.ensemble import Ensemble, design, drawn, ensemble
from rocking.assessment.ground_motions import AS_IT_IS, GroundMotions
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.verdict import Verdict
from rocking.errors import RockingError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import integrate
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Mechanism, Structure

CRACKS = 11
"""Number of mechanisms that are followed where more than one may form."""
IN_DOUBT = 0.3
"""Rotation ratio of a member beyond which it is in doubt that a mechanism other than that of statics stands."""


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


def ensemble_over_cracks(
    structure: Structure | Mechanism,
    motions: GroundMotions,
    settings: AssessmentSettings,
    *,
    verdict_only: bool = False,
    exhaustive: bool = False,
) -> Ensemble:
    """Return the ensemble of the mechanism that statics chooses, of least λ, with what other cracks may change.

    Where it stands, the members of the worst mechanism that `screened` leaves in doubt are followed, and where that one
    does not stand, it is `elsewhere`. exhaustive: every mechanism is followed, one after the other, until one does not
    stand. docs/pages/validation.md counts what the screen misses. verdict_only: as `ensemble` takes it. Raises
    MotionError as `integrate` does.
    """
    how: Any = {"settings": settings.ensemble, "tolerance": settings.tolerance}
    (description, mechanism), *others = cracks(structure)
    headline = ensemble(mechanism, motions, verdict_only=verdict_only, **how)
    if not others or isinstance(structure, Mechanism):
        return headline
    headline = replace(headline, crack=description)
    if headline.verdict is not Verdict.STANDS:
        return headline
    worst = others if exhaustive else screened(others, headline, motions, settings)[:1]
    for crack, other in worst:
        there = ensemble(other, motions, whether_it_stands=True, **how)
        if there.verdict is not Verdict.STANDS:
            return replace(headline, elsewhere=replace(there, crack=crack))
    return headline


def screened(
    mechanisms: Sequence[tuple[str, Mechanism]],
    headline: Ensemble,
    motions: GroundMotions,
    settings: AssessmentSettings,
) -> list[tuple[str, Mechanism]]:
    """Return those of other `mechanisms` that may not stand, the worst first.

    Each meets three members of the `headline`, the ensemble of statics: the two that rotate most, and the middle one.
    One that turns beyond IN_DOUBT of its critical rotation there, or cannot be followed, is left in doubt.
    """
    if np.all(headline.rotation_ratios == 0):
        return []  # no other mechanism lifts earlier than that of least λ
    order = np.argsort(-headline.rotation_ratios, kind="stable")
    few = design(settings.ensemble)[order[[0, 1, order.size // 2]]]
    severity = {}
    for each in mechanisms:
        members = drawn(each[1], motions, few, settings.ensemble, tolerance=settings.tolerance)
        ratios = np.nan_to_num(members.rotation_ratios, nan=np.inf, posinf=np.inf)
        if ratios.max() > IN_DOUBT:
            severity[each] = int(np.isinf(ratios).sum()), float(ratios.min())
    return sorted(severity, key=severity.__getitem__, reverse=True)


@lru_cache(maxsize=256)
def cracks(structure: Structure | Mechanism) -> tuple[tuple[str, Mechanism], ...]:
    """Return the mechanisms that may form, each with what opens in words; the one that statics chooses first."""
    if isinstance(structure, Mechanism):
        return (("", structure),)
    return tuple((each.description, each.structure.mechanism()) for each in structure.candidates(CRACKS))


def candidates(
    structure: Structure,
    accelerogram: Accelerogram,
    pulse: Pulse | None,
    count: int,
    settings: AssessmentSettings,
) -> list[Variation]:
    """Return `count` candidates of a structure, the lowest crack first; [] where there is one mechanism.

    Raises RockingError where one of them cannot be followed.
    """
    others = sorted(structure.candidates(count) if count else (), key=lambda each: each.position)
    if len(others) < 2:
        return []
    integrated = _rotation_ratios([each.structure for each in others], accelerogram, settings)
    variations = []
    for each, ratio in zip(others, integrated, strict=True):
        if math.isnan(ratio):
            integrate(each.structure, accelerogram, settings.tolerance)  # raises the reason
        block = each.structure.mechanism().equivalent_block(settings.acceleration_scale)
        predicted = predict_maximum(block, pulse).rotation_ratio if pulse else math.nan
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
    tolerance = settings.tolerance
    return integrate_batch(structures, record, tolerance=tolerance, vertical=vertical, workers=1)[
        :, 0
    ].tolist()
