"""What the closed form under a record's best sine is worth, by the share of the energy that the sine explains.

The integration under the whole record is the truth; a fall is found where the sine begins before it. The records
took no part in the choice of the classes, which are round numbers, nor did the structures, the shipped ones.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from docs.research.report import Target
from docs.research.scores import Measured, Score, scored
from docs.research.sites import SiteRecord, independent, sample_of
from rocking.assessment.methods import Acts, Agreement, acts, agreement, rests
from rocking.errors import PulseError
from rocking.motion.integration import integrate
from rocking.pulses import extract_pulses
from rocking.sine_pulse import predict_maximum
from rocking.structures import Structure

FACTORS = (0.7, 1.4, 2.8)
"""On each record, so that some structures rest, some rock and some overturn."""
ENERGIES = (0.5, 0.3, 0.2, 0.1, 0.0)
"""Least share of the energy of each class."""


@dataclass(frozen=True)
class Case:
    """One structure under one record.

    explained: share of its energy in its best sine; then the rotation ratios. acts: when that acts beside a fall.
    """

    site: str
    earthquake: str
    explained: float
    integrated: float
    predicted: float
    acts: Acts | None = None


def worth(target: Target) -> None:
    """Score the closed form by classes of explained energy."""
    structures = {name: body for name, body in target.structures.items() if body.mechanism().can_overturn}
    cases: list[Case] = []
    for component in independent(target.records):
        cases += cases_of(component, structures)
        target.tell(f"{component.identifier}: {len(cases)} cases")
    target.publish("What one sine is worth", f"{len(cases)} cases.", {Score: list(worth_scores(cases))})


def cases_of(component: SiteRecord, structures: Mapping[str, Structure]) -> Iterator[Case]:
    """Yield the structures that a record moves, or that its best sine does."""
    try:
        evidence = extract_pulses(component.accelerogram).ranked[0]
    except PulseError:
        return
    for factor in FACTORS:
        record = component.accelerogram.scaled(factor)
        pulse = replace(evidence.pulse, amplitude=factor * evidence.pulse.amplitude)
        for structure in structures.values():
            mechanism = structure.mechanism()
            response = integrate(mechanism, record, history=True)
            integrated = response.rotation_ratio
            block = mechanism.equivalent_block()
            predicted = predict_maximum(block, pulse).rotation_ratio
            acting = acts(
                start=pulse.start_time,
                end=pulse.end_time,
                fall=response.fall_time,
                frequency_parameter=block.frequency_parameter,
            )
            if not (rests(integrated) and rests(predicted)):
                yield Case(
                    component.site,
                    component.earthquake,
                    evidence.explained_energy,
                    integrated,
                    predicted,
                    acting,
                )


def worth_scores(cases: Sequence[Case]) -> Iterator[Score]:
    """Yield for each class of energy how often both end alike, and which falls the closed form sees."""
    for most, least in pairwise((math.inf, *ENERGIES)):
        own = [case for case in cases if least <= case.explained < most]
        if not own:
            continue
        falls = np.isinf([row.integrated for row in own])
        said = np.isinf([row.predicted for row in own])
        late = np.array([row.acts is Acts.AFTER for row in own])
        alike = [
            agreement(predicted=row.predicted, integrated=row.integrated) is Agreement.SAME for row in own
        ]
        measures: dict[str, Measured] = {
            "same outcome": np.array(alike, dtype=float),
            "falls found": np.where(falls, said & ~late, np.nan),
            "falls over before the sine begins": np.where(falls, late, np.nan),
        }
        sample = sample_of([row.site for row in own], [row.earthquake for row in own])
        yield from scored(
            "closed form under the best sine", f"{least:g} or more of the energy", measures, sample
        )
