"""Results and rows with what a test is about, else empty: the structure pier under record a, unless said.

And a structure that cannot be described.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any, TypeVar

import numpy as np

from rocking.assessment.case import CaseResult, Failure, PeriodResult
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack
from rocking.assessment.decide import Decision
from rocking.assessment.ensemble import Ensemble
from rocking.assessment.methods import BOTH_COMPONENTS, Method
from rocking.assessment.motions import Component, HorizontalMotion, pulses_of
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import (
    ComparisonRow,
    FailureRow,
    Identity,
    VerdictRow,
    verdict_row,
)
from rocking.assessment.scene import Scene
from rocking.assessment.settings import EnsembleSettings, PredictingPulse
from rocking.errors import StructureError
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Block, Outcome
from rocking.tables.rows import Row

R = TypeVar("R", bound=Row)


@dataclass(frozen=True)
class Impossible:
    """What a structure says of itself, but not how it moves."""

    described = SimpleNamespace(entry={"type": "impossible"})

    def mechanism(self) -> None:
        raise StructureError("it cannot stand.")

    def on_joints(self, joints) -> "Impossible":
        return self

    def restraints(self) -> tuple[()]:
        return ()


def filled(row_class: type[R], **values: Any) -> R:
    """A row of `values`; what is left out is empty."""
    for column in row_class.table.columns:
        if values.get(column.name) is None:
            of_type = {float: math.nan, str: "", tuple: ()}
            values[column.name] = None if column.optional else of_type.get(column.holds)
    return row_class(**values)


def case(component: str, ratio: float, structure: str = "pier", side: int = 0, falls: int | None = None):
    """A case by the rotation ratio as recorded. falls: members that overturn, of 64; None: without an ensemble."""
    outcome = Outcome.at(ratio)
    response = Response(rotation_ratio=ratio, outcome=outcome, peak_side=side)
    return CaseResult(
        structure=structure,
        component=component,
        responses={Method.MECHANISM_ON_RECORD: response},
        ensembles=None if falls is None else of_one_crack(members(falls)),
    )


def compared(component: str, ratio: float, structure: str = "pier", **more: Any) -> ComparisonRow:
    """A row of the comparison by the rotation ratio of the integration."""
    own = {"integrated_rotation_ratio": ratio, "record": "a"}
    return filled(ComparisonRow, component=component, structure=structure, **own | more)


def members(falls: int, high: float = 0.5) -> Ensemble:
    """Of 64, so many overturn, and the others rotate to `high`."""
    return Ensemble(np.where(np.arange(64) < falls, np.inf, high), {}, EnsembleSettings())


def of_one_crack(ensemble: Ensemble, description: str = "") -> CrackEnsembles:
    """The ensembles of a structure of which one mechanism was followed."""
    return CrackEnsembles((FollowedCrack(description, math.nan, ensemble),))


def broken(component: str, structure: str = "pier", message: str = "No.") -> CaseResult:
    """A case that gave no result."""
    return CaseResult(structure=structure, component=component, failures=(Failure("responses", message),))


def station(*cases: CaseResult, falls_in_directions: int | None = None) -> PeriodResult:
    """What became of a structure, from the cases of its components; with an ensemble over directions of 64."""
    directions = None
    if falls_in_directions is not None:
        directions = replace(
            CaseResult(structure=cases[0].structure, component=BOTH_COMPONENTS),
            ensembles=of_one_crack(members(falls_in_directions)),
        )
    by_component = {case.component: case for case in cases}
    return PeriodResult.of(Scene(cases[0].structure, Block(2.0, 0.2)), by_component, directions)


def decided(decision: Decision, reserve: Reserve | None = None, **values: Any) -> VerdictRow:
    """The row of a structure of which so much was decided."""
    own = {
        "record": "a",
        "structure": "pier",
        "verdict": decision.verdict,
        "overturning_share": decision.share,
    }
    return filled(VerdictRow, decision=decision, reserve=reserve, **own | values)


def verdicts(stations: Sequence[PeriodResult], record: str = "a") -> list[VerdictRow]:
    """Their rows."""
    return [
        verdict_row(
            Identity(record=record, component=station.component, record_sha256="", settings_sha256=""),
            station,
        )
        for station in stations
    ]


def failure(component: str, structure: str = "pier", message: str = "No.", record: str = "a") -> FailureRow:
    return FailureRow(
        record=record, component=component, structure=structure, stage="responses", message=message
    )


def component_of(
    accelerogram: Accelerogram, settings: PredictingPulse, vertical: Accelerogram | None = None
) -> Component:
    """Return a component that stands alone with its pulses."""
    return pulses_of(accelerogram, settings, HorizontalMotion()).component_of(accelerogram, vertical)
