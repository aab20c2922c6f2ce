"""Rows of tables with what a test is about, else empty: the structure pier under record a, unless said.

And a structure that cannot be described.
"""

from dataclasses import dataclass

from rocking.assessment.rows.of_record import ComparisonRow, EnsembleRow, FailureRow
from rocking.assessment.verdict import Verdict
from rocking.errors import StructureError
from rocking.structures import Outcome


@dataclass(frozen=True)
class Impossible:
    def mechanism(self) -> None:
        raise StructureError("it cannot stand.")


def case(component: str, ratio: float, structure: str = "pier", record: str = "a", **more) -> ComparisonRow:
    ratios = {"integrated_rotation_ratio": ratio, "answer_outcome": Outcome.at(ratio), "answer_reason": ""}
    return ComparisonRow.of(record=record, structure=structure, component=component, **ratios | more)


def ensemble(component: str, verdict: Verdict, overturning: int, structure: str = "pier") -> EnsembleRow:
    """Of 64 members."""
    counts = {"overturning_members": overturning, "overturning_share": overturning / 64, "members": 64}
    values = counts | {"verdict": verdict, "rotation_ratio_high": 0.5}
    return EnsembleRow.of(record="a", structure=structure, component=component, **values)


def failure(component: str, structure: str = "pier", message: str = "No.", record: str = "a") -> FailureRow:
    return FailureRow.of(
        record=record, component=component, structure=structure, stage="responses", message=message
    )
